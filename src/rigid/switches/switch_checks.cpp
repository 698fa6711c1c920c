// Checks of parts that are rigid for a while, once the world is complete.
#include <fmt/format.h>

#include <map>
#include <set>
#include <string>

#include "loads/sensors/sensor_force.hpp"
#include "rigid/switches/switch_cards.hpp"
#include "rigid/switches/switched_parts.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

/// A node of the body whose motion is not that of its own forces alone, and why; a switch would change the
/// momentum of what is joined to it. Empty: none.
std::string joined_to_others(const std::vector<Index>& body, const World& world) {
  const FieldSet& nodes = world.nodes.fields;
  const Field<Real>* const carried = shared_fields::tied_mass.find(nodes);
  const Field<Index>* const joined = shared_fields::joined_nodes.find(nodes);
  std::map<Index, Index> inside;  // nodes of the body, by group
  const auto named = [&](Index n, const char* why) {
    return fmt::format("node {} {}", world.nodes.id[n], why);
  };
  for (const Index n : body) {
    if (carried && (*carried)[n] > 0)
      return named(n, "carries nodes, by an exact tie or *CONSTRAINED_INTERPOLATION");
    if (joined && (*joined)[n] < 0) return named(n, "is held by SPC for a time or along oblique axes");
    if (joined && (*joined)[n] > 0) ++inside[(*joined)[n]];
  }
  if (inside.empty()) return "";
  for (Index n = 0; n < world.nodes.size(); ++n)
    if (const auto group = inside.find((*joined)[n]); group != inside.end()) --group->second;
  for (const Index n : body)
    if ((*joined)[n] > 0 && inside[(*joined)[n]] < 0)
      return named(n, "is joined to nodes of other parts by linear equations, a node set or failing ties");
  return "";
}

}  // namespace

void check_switches(const Deck& deck, const World& world, Diagnostics& diagnostics) {
  for (const AutomaticSwitch& card : deck.all<AutomaticSwitch>()) {
    if (card.entno == 0 || (!card.of_wall() && !card.of_contact())) continue;
    if (card.of_wall() ? force_on_wall(world, card.entno).has_value()
                       : force_of_contact(world, card.entno).has_value())
      continue;
    deck.error(diagnostics, card, "ENTNO",
               fmt::format("{} {} does not exist, or pushes no nodes of elements",
                           card.of_wall() ? "rigid wall" : "contact", card.entno),
               "give the number of one that is there");
  }
  const auto& cards = deck.all<AutomaticSwitch>();
  const Location where = cards.empty() ? Location{deck.files[0].name} : deck.where(cards.front());
  std::map<Index, const SwitchedNodes*> taken;
  for (const auto* switched : world.passes.all<SwitchedNodes>())
    for (const std::vector<Index>& body : switched->nodes_of_bodies()) {
      if (const std::string why = joined_to_others(body, world); !why.empty())
        return diagnostics.error(
            where, switched->name() + ": " + why + ", so that it cannot be part of a rigid body for a while",
            "leave the part out of the switch or the node out of the weld, or tie it with _OFFSET");
      for (const Index n : body)
        if (const auto before = taken.try_emplace(n, switched).first->second; before != switched)
          return diagnostics.error(
              where,
              fmt::format("node {} belongs to {} and to {}", world.nodes.id[n], before->name(),
                          switched->name()),
              "leave the part out of the switch, or SN, SS and the time of failure blank");
    }
}

}  // namespace courant
