#include "rigid/bodies/replaced_velocity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "model/conditions/given_velocity.hpp"
#include "rigid/bodies/nodal_bodies.hpp"

namespace courant {

namespace {

constexpr Id all_in_box = -1, all_bodies = -2;  // IRIGID of *INITIAL_VELOCITY

Matrix velocity_axes(const Model& model, Id icid) {
  const auto system = model.coordinate_systems.find(icid);
  return system == model.coordinate_systems.end() ? Matrix(Matrix::Identity()) : system->second.axes;
}

bool is_member(const std::map<Id, std::vector<Index>>& sets, Id id, Index member) {
  const auto set = sets.find(id);
  return set != sets.end() && std::find(set->second.begin(), set->second.end(), member) != set->second.end();
}

bool names(const InitialVelocityCard& card, const Model& model, const InertiaBody& body, const Vec& centre) {
  if (card.irigid == 0) return false;
  if (card.irigid == all_bodies) return true;
  const auto box = model.boxes.find(card.boxid);
  if (box != model.boxes.end() && !box->second.contains(centre)) return false;
  return card.irigid == all_in_box || is_member(model.part_sets, card.irigid, body.part);
}

bool names(const InitialVelocityGenerationCard& card, const Model& model, const World& world,
           const InertiaBody& body) {
  constexpr int by_part_set = 1, by_part = 2;
  if (card.irigid == 0) return false;
  if (card.id == 0) return true;
  const auto all = [&](const auto& holds) {
    return !body.nodes.empty() && std::all_of(body.nodes.begin(), body.nodes.end(), holds);
  };
  if (card.styp == by_part_set || card.styp == by_part) {
    const auto one = model.part_of_id.find(card.id);
    const auto has_part = [&](Index part) {
      return card.styp == by_part ? one != model.part_of_id.end() && part == one->second
                                  : is_member(model.part_sets, card.id, part);
    };
    return body.part >= 0 ? has_part(body.part) : all([&](Index n) { return has_part(world.nodes.part[n]); });
  }
  const auto set = model.node_sets.find(card.id);
  if (set == model.node_sets.end()) return false;
  std::unordered_set<Id> ids;
  for (const Index n : set->second) ids.insert(model.nodes[static_cast<std::size_t>(n)].id);
  return all([&](Index n) { return ids.contains(world.nodes.id[n]); });
}

template <class Card>
void note_idle(const Deck& deck, Diagnostics& diagnostics) {
  for (const Card& card : deck.all<Card>())
    if (card.irigid != 0)
      diagnostics.note(
          deck.where(card, "IRIGID"),
          deck.describe(card, "IRIGID") +
              ": no *PART_INERTIA or *CONSTRAINED_NODAL_RIGID_BODY_INERTIA gives a velocity that "
              "it could replace, so that it changes nothing");
}

}  // namespace

std::optional<BodyStart> replaced_start(const Deck& deck, const Model& model, const World& world,
                                        const InertiaBody& body, const Vec& centre) {
  std::optional<BodyStart> out;
  for (const auto& card : deck.all<InitialVelocityCard>())
    if (names(card, model, body, centre))
      out = BodyStart{velocity_axes(model, card.icid) * Vec(card.vx, card.vy, card.vz)};
  for (const auto& card : deck.all<InitialVelocityGenerationCard>())
    if (names(card, model, world, body)) {
      const GivenVelocity given = given_velocity(card, velocity_axes(model, card.icid));
      out = BodyStart{given.at(centre), given.omega};
    }
  return out;
}

void check_irigid(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  for (const auto& card : deck.all<InitialVelocityCard>()) {
    if (card.irigid < all_bodies)
      deck.error(diagnostics, card, "IRIGID",
                 fmt::format("expected a part set, -1 or -2, got '{}'", card.irigid),
                 "-1 replaces the velocities of bodies in the box, -2 of all");
    if (card.irigid > 0 && !model.part_sets.contains(card.irigid))
      deck.error(diagnostics, card, "IRIGID", fmt::format("part set {} does not exist", card.irigid),
                 "define it with *SET_PART");
  }
  Diagnostics reported_with_bodies;
  const auto bodies = nodal_bodies(deck, model, reported_with_bodies);
  if (deck.all<PartInertiaCard>().empty() &&
      std::none_of(bodies.begin(), bodies.end(),
                   [](const NodalBody& body) { return body.given.has_value(); })) {
    note_idle<InitialVelocityCard>(deck, diagnostics);
    note_idle<InitialVelocityGenerationCard>(deck, diagnostics);
  }
}

}  // namespace courant
