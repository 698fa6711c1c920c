#pragma once
#include <memory>
#include <vector>

#include "contact/contact.hpp"
#include "state/subcycle.hpp"

namespace courant {

/// The vibration of particles on the springs of a contact that is built. `number`, `tracked`: as there.
std::shared_ptr<Springs> make_particle_springs(const ContactLaw& law, int number,
                                               const std::vector<bool>& tracked, const World& world);

}  // namespace courant
