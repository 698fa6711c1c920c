#pragma once
#include <memory>
#include <vector>

#include "contact/cards.hpp"
#include "contact/nodes/build.hpp"

namespace courant {

/// What it names is found as for contacts.
struct TransducerCard : ContactCard {};

/// *CONTACT_FORCE_TRANSDUCER_PENALTY: adds one interface for each, which tells the force that `contacts` do
/// to the nodes of its SURFA. Refuses by name: sets and parts that are not there, scenes with contacts of
/// particles, whose forces it would miss.
void add_force_transducers(const Deck& deck, const Model& model, const NodeContactOptions& options,
                           const std::vector<std::shared_ptr<const NodeContact>>& contacts, World& world,
                           Diagnostics& diagnostics);

}  // namespace courant
