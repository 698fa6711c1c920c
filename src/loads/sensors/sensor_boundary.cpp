// *SENSOR_DEFINE_FORCE of single point constraints and prescribed motions: sums of what spcforc and bndout
// print.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "loads/sensors/sensor_force.hpp"
#include "model/cards.hpp"
#include "model/conditions/prescribed_motion.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

using Kind = BoundaryForce::Kind;

std::vector<BoundaryForce> all_forces(const World& world, const Clock& clock) {
  std::vector<BoundaryForce> out;
  for (const auto* pass : world.passes.all<const BoundaryForceReporter>())
    pass->report_forces(world, clock, out);
  return out;
}

/// What the cards of one *BOUNDARY_SPC number hold: of each node, by its id, which axes.
struct Support {
  std::unordered_map<Id, std::array<bool, 3>> moves{}, turns{};
  bool local = false;  ///< holds some axes of a system of its own
};

class SupportReader {
 public:
  SupportReader(const Deck& deck, const Model& model) : deck_(deck), model_(model) {}

  Support read(Id number) const {
    Support out;
    for (const BoundarySpcNodeCard& card : deck_.all<BoundarySpcNodeCard>())
      if (card.id == number) add(card, card.nid, out);
    for (const BoundarySpcSetCard& card : deck_.all<BoundarySpcSetCard>()) {
      const auto set = model_.node_sets.find(card.nid);
      if (card.id != number || set == model_.node_sets.end()) continue;
      for (const Index n : set->second) add(card, model_.nodes[static_cast<std::size_t>(n)].id, out);
    }
    return out;
  }

 private:
  static void add(const BoundarySpcCard& card, Id node, Support& out) {
    const std::array<bool, 3> none{}, all{true, true, true};
    const std::array<bool, 3> moves{card.dofx == 1, card.dofy == 1, card.dofz == 1},
        turns{card.dofrx == 1, card.dofry == 1, card.dofrz == 1};
    for (const auto& held : {moves, turns}) out.local |= card.cid != 0 && held != none && held != all;
    const auto join = [&](std::unordered_map<Id, std::array<bool, 3>>& nodes,
                          const std::array<bool, 3>& held) {
      if (held == none) return;
      auto& known = nodes[node];
      for (std::size_t k = 0; k < 3; ++k) known[k] = known[k] || held[k];
    };
    join(out.moves, moves), join(out.turns, turns);
  }

  const Deck& deck_;
  const Model& model_;
};

/// The sum over nodes, along the axes that are held there.
Real force_of_support(const Support& support, const SensorAxis& axis, const World& world,
                      const Clock& clock) {
  Vec force = Vec::Zero(), moment = Vec::Zero();
  const auto add = [](const auto& nodes, Id id, const Vec& what, Vec& sum) {
    const auto held = nodes.find(id);
    if (held == nodes.end()) return;
    for (int k = 0; k < 3; ++k)
      if (held->second[static_cast<std::size_t>(k)]) sum[k] += what[k];
  };
  for (const BoundaryForce& one : all_forces(world, clock))
    if (one.kind == Kind::held_point)
      add(support.moves, one.id, one.force, force);
    else if (one.kind == Kind::held_rotation)
      add(support.turns, one.id, one.moment, moment);
  return axis.of(force, moment);
}

/// Whether each node of the world moves, or turns, by its forces: those of rigid bodies do not, and nobody
/// measures there.
bool all_there(const Support& support, bool moment, const World& world) {
  const auto& nodes = moment ? support.turns : support.moves;
  std::size_t count = 0, there = 0;
  for (const BoundaryForce& one : all_forces(world, {.dt = 1}))
    count += one.kind == (moment ? Kind::held_rotation : Kind::held_point) && nodes.contains(one.id);
  for (Index n = 0; n < world.nodes.size(); ++n) there += nodes.contains(world.nodes.id[n]);
  for (Index i = 0; i < world.particles.size(); ++i) there += nodes.contains(world.particles.id[i]);
  return count > 0 && count == there;
}

Sensor sensor_of_support(const SensorDefineForce& card, Support support, const SensorAxis& axis) {
  const auto held = std::make_shared<const Support>(std::move(support));
  return {.id = card.sensid,
          .value = [held, axis](const World& world,
                                const Clock& clock) { return force_of_support(*held, axis, world, clock); },
          .there = [held, axis](const World& world) { return all_there(*held, axis.moment, world); },
          .card = card};
}

/// A motion of those with one number, and whom it drives.
struct MeasuredMotion {
  PrescribedMotion motion;
  std::unordered_set<Id> who{};  ///< nodes, or the part of a body
  Kind kind() const {
    return motion.body != 0 ? Kind::driven_body : motion.turns ? Kind::driven_rotation : Kind::driven_point;
  }
};

std::vector<MeasuredMotion> motions_with(Id number, const Deck& deck, const Model& model) {
  std::vector<MeasuredMotion> out;
  Diagnostics unused;  // the pass that drives by them reports
  for (PrescribedMotion& motion : prescribed_motions(deck, model, unused)) {
    if (motion.id != number) continue;
    MeasuredMotion one{std::move(motion)};
    if (one.motion.body != 0) one.who.insert(one.motion.body);
    for (const Index n : one.motion.nodes) one.who.insert(model.nodes[static_cast<std::size_t>(n)].id);
    out.push_back(std::move(one));
  }
  return out;
}

/// What drives a point or body at one time is at right angles, so that the part along a motion is its own.
Real force_of_motions(const std::vector<MeasuredMotion>& motions, const SensorAxis& axis, const World& world,
                      const Clock& clock) {
  Vec force = Vec::Zero(), moment = Vec::Zero();
  for (const BoundaryForce& one : all_forces(world, clock))
    for (const MeasuredMotion& m : motions) {
      if (one.kind != m.kind() || !m.who.contains(one.id) || !m.motion.drives(clock.t, clock.dt)) continue;
      const Vec& d = m.motion.direction;
      if (m.motion.turns)
        moment += one.moment.dot(d) * d;
      else
        force += one.force.dot(d) * d;
    }
  return axis.of(force, moment);
}

/// Whether all that the motions drive are listed; a body that is merged into another one is not.
bool all_driven(const std::vector<MeasuredMotion>& motions, const World& world) {
  const std::vector<BoundaryForce> forces = all_forces(world, {.dt = 1});
  return !motions.empty() && std::all_of(motions.begin(), motions.end(), [&](const MeasuredMotion& m) {
    const auto told = std::count_if(forces.begin(), forces.end(), [&](const BoundaryForce& one) {
      return one.kind == m.kind() && m.who.contains(one.id);
    });
    return told == static_cast<std::ptrdiff_t>(m.who.size());
  });
}

Sensor sensor_of_motions(const SensorDefineForce& card, std::vector<MeasuredMotion> motions,
                         const SensorAxis& axis) {
  const auto all = std::make_shared<const std::vector<MeasuredMotion>>(std::move(motions));
  return {.id = card.sensid,
          .value = [all, axis](const World& world,
                               const Clock& clock) { return force_of_motions(*all, axis, world, clock); },
          .there = [all](const World& world) { return all_driven(*all, world); },
          .card = card};
}

const RegisterSensors sensors_of_boundaries{[](const Deck& deck, const Model& model, const World&,
                                               Diagnostics& diagnostics) {
  std::vector<Sensor> out;
  for (const SensorDefineForce& card : deck.all<SensorDefineForce>()) {
    if (card.ftype != "SPC" && card.ftype != "PRESC-MOT") continue;
    const SensorAxis axis = sensor_axis(deck, model, card, true, diagnostics);
    if (card.ftype == "SPC") {
      Support support = SupportReader(deck, model).read(card.typeid_);
      if (support.local)
        deck.error(diagnostics, card, "TYPEID",
                   fmt::format("constraint {} holds some axes of a system of its own (CID)", card.typeid_),
                   "hold all three, or along the global axes without CID");
      out.push_back(sensor_of_support(card, std::move(support), axis));
      continue;
    }
    std::vector<MeasuredMotion> motions = motions_with(card.typeid_, deck, model);
    if (std::any_of(motions.begin(), motions.end(), [](const auto& m) { return m.motion.local; }))
      deck.error(diagnostics, card, "TYPEID",
                 fmt::format("motion {} is along axes that turn with its body (_LOCAL)", card.typeid_),
                 "measure a motion along global axes");
    out.push_back(sensor_of_motions(card, std::move(motions), axis));
  }
  return out;
}};

}  // namespace

bool measures_supports(const Deck& deck) {
  const auto& cards = deck.all<SensorDefineForce>();
  return std::any_of(cards.begin(), cards.end(), [](const auto& card) { return card.ftype == "SPC"; });
}

}  // namespace courant
