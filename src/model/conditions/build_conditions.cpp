// Control, output requests, loads, constraints and initial velocities.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "model/conditions/given_velocity.hpp"
#include "model/conditions/relaxation.hpp"
#include "model/model_builder.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

std::vector<Index> sorted(std::vector<Index> indices) {
  std::sort(indices.begin(), indices.end());
  return indices;
}

}  // namespace

void ModelBuilder::build_control() {
  if (const auto* card = deck_.last<ControlTerminationCard>()) {
    model_.endtim = card->endtim;
    model_.endcyc = card->endcyc;
    model_.dtmin = card->dtmin;
    model_.endeng = card->endeng;
  } else {
    ++errors_;
    diagnostics_.error({deck_.files.empty() ? "" : deck_.files[0].name, 0, 0},
                       "*CONTROL_TERMINATION is missing: the run has no end time",
                       "add *CONTROL_TERMINATION with ENDTIM > 0");
  }
  if (const auto* card = deck_.last<ControlTimestepCard>()) {
    model_.dtinit = card->dtinit;
    model_.tssfac = card->tssfac;
    if (card->tssfac > 1)
      deck_.warning(diagnostics_, *card, "TSSFAC",
                    "steps may be longer than the stable one, and the run then stops",
                    "0.9 or less is usual");
    if (card->lctm != 0) {
      if (const Curve* found = curve(*card, "LCTM", card->lctm)) {
        model_.dt_max_given = true;
        model_.dt_max = *found;
        if (!found->ordinate.empty() &&
            *std::min_element(found->ordinate.begin(), found->ordinate.end()) <= 0)
          error(*card, "LCTM", fmt::format("curve {} gives a largest step that is not above 0", card->lctm));
      }
    }
  }
}

// Steps of a relaxation, and no limit by energies, which damping takes.
void ModelBuilder::build_relaxation() {
  if (model_.phase != RunPhase::relaxation) return;
  model_.tssfac = relaxation_tssfac(deck_, model_.tssfac);
  model_.endeng = 0;
}

void ModelBuilder::build_output() {
  OutputRequests& out = model_.output;
  if (const auto* card = deck_.last<DatabaseD3plotCard>()) {
    out.d3plot.interval = card->dt;
    out.d3plot_count = card->npltc;
    if (card->npltc > 0) out.d3plot.interval = model_.endtim / card->npltc;
    check_interval(*card, "DT", out.d3plot.interval, most_due);
    build_output_curve(*card, "LCDT", card->lcdt, std::max(card->ioopt, 1), out.d3plot);
    build_left_out_parts(*card, card->psetid);
  }
  build_field_output();
  build_histories();
}

void ModelBuilder::build_body_loads() {
  const std::vector<Index> parts = loaded_parts();
  const auto add = [&](const Entry& card, Id lcid, Id lciddr, BodyLoad load) {
    const Curve* found = curve(card, "LCID", lcid);
    if (!found) return;
    load.curve = *found;
    if (!take_relaxing(card, "LCIDDR", lciddr, load.curve)) return;
    load.parts = parts;
    model_.body_loads.push_back(std::move(load));
  };
  const auto in_system = [&](const LoadBodyCard& card, const Vec& v) -> Vec {
    const CoordinateSystem* const system = card.cid == 0 ? nullptr : coordinate_system(card, "CID", card.cid);
    if (!system) return v;
    if (system->moves)
      deck_.refuse(diagnostics_, card, "CID",
                   fmt::format("system {} moves, which is not supported", card.cid),
                   "give a system that stays (FLAG 0)");
    return system->axes * v;
  };
  for (const LoadBodyCard& card : deck_.all<LoadBodyCard>())
    add(card, card.lcid, card.lciddr, {.direction = in_system(card, Vec::Unit(card.name)), .sf = card.sf});
  for (const LoadBodyVectorCard& card : deck_.all<LoadBodyVectorCard>()) {
    const Vec v(card.v1, card.v2, card.v3);
    constexpr Real rounded = 0.01;
    if (v.norm() == 0) {
      error(card, "V1", "the load has no direction", "give V1, V2, V3, not all zero");
      continue;
    }
    if (std::abs(v.norm() - 1) > rounded)
      deck_.warning(
          diagnostics_, card, "V1",
          fmt::format("the vector gives the direction only, its length of {:g} has no effect", v.norm()),
          "SF and the curve give the acceleration; give a vector of length 1");
    add(card, card.lcid, card.lciddr, {.direction = in_system(card, v.normalized()), .sf = card.sf});
  }
  for (const LoadBodyRotationCard& card : deck_.all<LoadBodyRotationCard>())
    add(card, card.lcid, card.lciddr,
        {.kind = BodyLoad::Kind::rotation,
         .direction = Vec::Unit(card.name),
         .centre = Vec(card.xc, card.yc, card.zc),
         .sf = card.sf});
  build_gravity_of_parts();
}

/// Those of *LOAD_BODY_PARTS; none: all.
std::vector<Index> ModelBuilder::loaded_parts() {
  const auto* card = deck_.last<LoadBodyPartsCard>();
  if (!card) return {};
  const std::vector<Index>* members = part_set(*card, "PSID", card->psid);
  if (members && members->empty()) error(*card, "PSID", fmt::format("part set {} is empty", card->psid));
  return members ? sorted(*members) : std::vector<Index>{};
}

void ModelBuilder::build_gravity_of_parts() {
  for (const LoadGravityPartCard& card : deck_.all<LoadGravityPartCard>()) {
    static const Curve always{.abscissa = {0, 1e30}, .ordinate = {1, 1}};
    const Curve* found = card.lc == 0 ? &always : curve(card, "LC", card.lc);
    std::vector<Index> parts;
    if (!card.of_sets()) {
      if (const Index p = part(card, "PID", card.pid); p >= 0) parts = {p};
    } else if (const std::vector<Index>* members = part_set(card, "PID", card.pid)) {
      parts = sorted(*members);
      if (parts.empty()) error(card, "PID", fmt::format("part set {} is empty", card.pid));
    }
    if (!found || parts.empty() || card.dof < 1 || card.dof > 3) continue;
    model_.body_loads.push_back(
        {.direction = Vec::Unit(card.dof - 1), .curve = *found, .sf = card.accel, .parts = parts});
    take_relaxing(card, "LCDR", card.lcdr, model_.body_loads.back().curve);
  }
}

/// In the phase of relaxation the curve that is for it; false where there is none of that number.
bool ModelBuilder::take_relaxing(const Entry& card, const char* field, Id id, Curve& out) {
  if (id == 0) return true;
  const Curve* own = curve(card, field, id);
  if (own && model_.phase == RunPhase::relaxation) out = *own, out.silent = false;
  return own != nullptr;
}

namespace {

bool has_rigid_bodies(const Deck& deck) {
  return std::any_of(deck.keywords.begin(), deck.keywords.end(), [](const auto& use) {
    const std::string& name = use.first;
    return name.starts_with("MAT_020") ||
           (name.find("RIGID") != std::string::npos && !name.starts_with("RIGIDWALL_"));
  });
}

}  // namespace

void ModelBuilder::build_constraints() {
  struct HeldAxes {
    std::array<bool, 3> axes, turns;
  };
  // Where nodes do not turn, those of rigid bodies hold the body.
  const bool turn = model_.turns() || has_rigid_bodies(deck_);
  const auto held_by = [&](const BoundarySpcCard& card) {
    const std::array<bool, 3> none{}, turns = {card.dofrx == 1, card.dofry == 1, card.dofrz == 1};
    const int before = errors_;
    HeldAxes out{held_directions(card, {card.dofx == 1, card.dofy == 1, card.dofz == 1}, "translations"),
                 none};
    if (turn && turns != none && errors_ == before) out.turns = held_directions(card, turns, "rotations");
    return out;
  };
  const auto hold = [&](Index n, const HeldAxes& held) {
    auto& fixed = model_.nodes[static_cast<std::size_t>(n)].fixed;
    for (std::size_t k = 0; k < 3; ++k) fixed[k] = fixed[k] || held.axes[k];
    if (held.turns != std::array<bool, 3>{}) hold_rotations(n, held.turns);
  };
  for (const auto& card : deck_.all<BoundarySpcNodeCard>())
    if (holds_for_a_time(card, model_.endtim))
      node(card, "NID", card.nid);  // timed ones are passes of their own: oblique_supports.cpp
    else if (const Index n = node(card, "NID", card.nid); n >= 0)
      hold(n, held_by(card));
  for (const auto& card : deck_.all<BoundarySpcSetCard>()) {
    const std::vector<Index>* members = node_set(card, "NSID", card.nid);
    if (holds_for_a_time(card, model_.endtim)) continue;
    const HeldAxes held = held_by(card);
    if (!members) continue;
    for (const Index n : *members) hold(n, held);
  }
  hold_planes(turn);
  if (!turn) return;
  for (const NodeCard& card : deck_.all<NodeCard>())  // the first of each id is the node
    if (const Index n = card.rc == 0 ? -1 : node_of_id_.find(card.nid); n >= 0)
      hold_rotations(n, axes_of_code(card.rc));
}

void ModelBuilder::hold_rotations(Index n, const std::array<bool, 3>& held) {
  auto& turns = model_.held_rotations[n];
  for (std::size_t k = 0; k < 3; ++k) turns[k] = turns[k] || held[k];
}

/// The global directions that a card holds. In a system of its own that works as long as each held axis is
/// along a global one, or all are held.
std::array<bool, 3> ModelBuilder::held_directions(const BoundarySpcCard& card,
                                                  const std::array<bool, 3>& held, const char* what) {
  if (card.cid == 0 || held == std::array{true, true, true}) return held;
  std::array<bool, 3> out = {false, false, false};
  const CoordinateSystem* system = coordinate_system(card, "CID", card.cid);
  if (!system) return out;
  constexpr Real along = 1 - 1e-9;  // cosine
  for (std::size_t k = 0; k < 3; ++k) {
    if (!held[k]) continue;
    const Vec axis = system->axes.col(static_cast<Eigen::Index>(k)).cwiseAbs();
    Eigen::Index nearest = 0;
    const bool oblique = axis.maxCoeff(&nearest) < along;
    if (oblique && !system->moves && std::string_view(what) == "translations")
      continue;  // oblique_supports.cpp
    if (oblique || system->moves) {
      error(card, "CID",
            fmt::format("a constraint along the axes of system {} is not supported, as {}", card.cid,
                        system->moves ? "it turns with nodes" : "they are not along the global axes"),
            fmt::format("hold all three {}, or use a system along the global axes", what));
      return out;
    }
    out[static_cast<std::size_t>(nearest)] = true;
  }
  return out;
}

/// The columns are the directions in which a card gives its velocities.
Matrix ModelBuilder::axes_of(const Entry& card, Id icid) {
  const CoordinateSystem* system = icid == 0 ? nullptr : coordinate_system(card, "ICID", icid);
  return system ? system->axes : Matrix(Matrix::Identity());
}

void ModelBuilder::build_velocities() {
  for (const auto& card : deck_.all<InitialVelocityCard>()) set_velocity(card);
  for (const auto& card : deck_.all<InitialVelocityGenerationCard>()) set_velocity(card);
  for (const auto& card : deck_.all<InitialVelocityNodeCard>())
    if (const Index n = node(card, "NID", card.nid); n >= 0)
      model_.nodes[static_cast<std::size_t>(n)].v = axes_of(card, card.icid) * Vec(card.vx, card.vy, card.vz);
}

void ModelBuilder::set_velocity(const InitialVelocityCard& card) {
  const Box* inside = card.boxid == 0 ? nullptr : box(card, "BOXID", card.boxid);
  const std::vector<Index>* set = card.nsid == 0 ? nullptr : node_set(card, "NSID", card.nsid);
  const std::vector<Index>* excepted = card.nsidex == 0 ? nullptr : node_set(card, "NSIDEX", card.nsidex);
  if ((card.boxid != 0 && !inside) || (card.nsid != 0 && !set) || (card.nsidex != 0 && !excepted)) return;
  const Matrix axes = axes_of(card, card.icid);
  const Vec v = axes * Vec(card.vx, card.vy, card.vz), ve = axes * Vec(card.vxe, card.vye, card.vze);
  const auto apply = [&](ModelNode& n) {
    if (!inside || inside->contains(n.x)) n.v = v;
  };
  if (set)
    for (const Index n : *set) apply(model_.nodes[static_cast<std::size_t>(n)]);
  else
    for (ModelNode& n : model_.nodes) apply(n);
  if (!excepted) return;
  for (const Index n : *excepted) model_.nodes[static_cast<std::size_t>(n)].v = ve;
}

void ModelBuilder::set_velocity(const InitialVelocityGenerationCard& card) {
  constexpr Real axis_by_nodes = -999;
  if (card.nx == axis_by_nodes) {
    error(card, "NX", "an axis given by two nodes (-999) is not supported", "give the direction of the axis");
    return;
  }
  if (card.omega != 0 && card.nx == 0 && card.ny == 0 && card.nz == 0) {
    error(card, "NX", "the axis of the rotation has no direction", "give NX, NY, NZ, not all zero");
    return;
  }
  const GivenVelocity given = given_velocity(card, axes_of(card, card.icid));
  for (const Index n : nodes_of(card)) {
    ModelNode& target = model_.nodes[static_cast<std::size_t>(n)];
    target.v = given.at(target.x);
    if (card.omega != 0 && model_.turns()) model_.angular_velocity[n] = given.omega;
  }
}

std::vector<Index> ModelBuilder::nodes_of(const InitialVelocityGenerationCard& card) {
  constexpr int by_part_set = 1, by_part = 2;
  std::vector<Index> parts;
  if (card.id == 0) {
    for (ModelPart& p : model_.parts) p.velocity_given = true;
    std::vector<Index> all(model_.nodes.size());
    for (std::size_t n = 0; n < all.size(); ++n) all[n] = static_cast<Index>(n);
    return all;
  }
  if (card.styp == by_part_set) {
    if (const auto* members = part_set(card, "ID", card.id)) parts = *members;
  } else if (card.styp == by_part) {
    if (const Index p = part(card, "ID", card.id); p >= 0) parts = {p};
  } else {
    const auto* members = node_set(card, "ID", card.id);
    return members ? *members : std::vector<Index>{};
  }
  for (const Index p : parts) model_.parts[static_cast<std::size_t>(p)].velocity_given = true;
  return nodes_of_parts(parts);
}

std::vector<Index> ModelBuilder::nodes_of_parts(const std::vector<Index>& parts) const {
  std::vector<bool> is_wanted(model_.parts.size(), false);
  for (const Index p : parts) is_wanted[static_cast<std::size_t>(p)] = true;
  const auto wanted = [&](Index p) { return is_wanted[static_cast<std::size_t>(p)]; };
  std::vector<Index> nodes;
  for (const ModelSph& sph : model_.sph)
    if (wanted(sph.part)) nodes.push_back(sph.node);
  for (const ModelShell& shell : model_.shells)
    if (wanted(shell.part)) nodes.insert(nodes.end(), shell.node.begin(), shell.node.end());
  for (const ModelSolid& solid : model_.solids)
    if (wanted(solid.part))
      std::copy_if(solid.node.begin(), solid.node.end(), std::back_inserter(nodes),
                   [](Index n) { return n >= 0; });
  for (const ModelBeam& beam : model_.beams)
    if (wanted(beam.part)) nodes.insert(nodes.end(), beam.node.begin(), beam.node.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace courant
