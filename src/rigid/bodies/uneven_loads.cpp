#include "rigid/bodies/uneven_loads.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

namespace courant {

void refuse_uneven_loads(const RigidBody& b, const BodyMerges& merges, const Deck& deck, const Model& model,
                         const World& world, Diagnostics& diagnostics) {
  const BodyAcceleration loads(model.body_loads);
  if (b.fixed() || !loads.by_parts()) return;
  if (b.parts.size() > 1 && loads.on(b.parts).by_parts())
    return deck.error(diagnostics, merges.of(b.parts[1]).card, "",
                      fmt::format("body loads act on some of the parts merged into part {} only", b.part),
                      "let *LOAD_BODY_PARTS or *LOAD_GRAVITY_PART name all of them, or none");
  std::vector<Index> bring_mass = b.parts;  // extra nodes belong to parts that deform
  for (const Index n : b.nodes)
    if (const Index part = world.nodes.part[n];
        part >= 0 && std::find(b.unweighed.begin(), b.unweighed.end(), n) == b.unweighed.end())
      bring_mass.push_back(part);
  std::sort(bring_mass.begin(), bring_mass.end());
  bring_mass.erase(std::unique(bring_mass.begin(), bring_mass.end()), bring_mass.end());
  const auto other = std::find_if(bring_mass.begin(), bring_mass.end(), [&](Index part) {
    return loads.on(std::array{part, b.part_index}).by_parts();
  });
  if (other == bring_mass.end()) return;
  diagnostics.error(
      model.parts[static_cast<std::size_t>(b.part_index)].where,
      fmt::format(
          "*PART {}: nodes of part {} give their mass to the rigid body, and body loads act on one of "
          "the two parts only",
          b.part, model.parts[static_cast<std::size_t>(*other)].id),
      "let *LOAD_BODY_PARTS or *LOAD_GRAVITY_PART name both parts, or none");
}

}  // namespace courant
