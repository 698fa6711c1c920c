#pragma once
#include <optional>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "rigid/bodies/mat_rigid.hpp"

namespace courant {

/// What *DEFORMABLE_TO_RIGID makes of the material of a part (index into Model::parts): density, modulus and
/// Poisson ratio of a *MAT_RIGID that nothing holds. Nothing where the part is not named, or its material has
/// none of these.
std::optional<MatRigid> switched_material(const Deck& deck, const Model& model, Index part);

/// LRB: the rigid part with which a switched one is one body.
struct SwitchedLead {
  Id lead = 0, part = 0;
  Entry card{};
};
std::vector<SwitchedLead> switched_leads(const Deck& deck, const Model& model);
/// Parts that *DEFORMABLE_TO_RIGID_AUTOMATIC makes deformable later, so that they are rigid for a while only.
std::vector<SwitchedLead> released_later(const Deck& deck, const Model& model);

/// The *DEFORMABLE_TO_RIGID without LRB of a part; null where there is none.
const Entry* switched_alone(const Deck& deck, Id part);

/// Refuses by name: parts that are not there or made of particles, materials without modulus.
void check_switched_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace courant
