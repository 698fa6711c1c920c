// Passes over nodes: bodies, elements, springs, contact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "app/momentum_watch.hpp"
#include "app/simulation.hpp"
#include "contact/cards.hpp"
#include "contact/edges/build.hpp"
#include "contact/nodes/build.hpp"
#include "elements/nodal_assembly.hpp"
#include "elements/node_inertias.hpp"
#include "extension/additions.hpp"
#include "loads/node_sets.hpp"
#include "loads/non_reflecting.hpp"
#include "rigid/build_joints.hpp"
#include "rigid/joint_stiffness.hpp"
#include "rigid/time_limit.hpp"
#include "time/point_motion.hpp"

namespace courant {

namespace {

void warn_of_beams_that_touch_nothing(const Deck& deck, const Model& model, const NodeContactOptions& options,
                                      Diagnostics& diagnostics) {
  const ContactCard* of_faces = nullptr;
  for (const ContactCard& c : deck.all<ContactCard>()) {
    if (kind_of(c).edges) return;
    if (!of_faces && !options.with_particles.contains(c.cid)) of_faces = &c;
  }
  if (model.beams.empty() || !of_faces) return;
  diagnostics.warning(deck.where(*of_faces),
                      fmt::format("{}: beams take no part in contact, only the shells and solids beside them",
                                  deck.keyword(*of_faces)),
                      "use *CONTACT_AUTOMATIC_GENERAL, or give what must touch faces");
}

}  // namespace

// Nodes of elements move by their forces; those of rigid bodies with these.
void Simulation::add_node_passes(Diagnostics& diagnostics) {
  add_bodies();
  if (bodies_) bodies_->set_damping(damping_);
  world_.passes.add(std::make_shared<MomentumWatch>(is_free_system(deck_, model_, bodies_.get())));
  for (const Addition& addition : additions()) addition.build(deck_, model_, world_, diagnostics);
  const bool bodies_move = bodies_ && bodies_->any_moves();
  if (bodies_move || !world_.groups.empty())
    world_.passes.add(make_clear_forces(points_of(world_.nodes)));
  else
    left_out_.push_back({"forces on nodes", "no node moves"});
  if (const auto pressure = make_segment_pressure(
          deck_, model_, bodies_ ? bodies_->wall_bodies(world_) : WallBodies{}, world_, diagnostics))
    world_.passes.add(pressure);
  else
    left_out_.push_back({"pressure on segments", "no *LOAD_SEGMENT, no *LOAD_SHELL, no *LOAD_BLAST"});
  if (bodies_move && moves_all_by_bodies()) world_.passes.add(make_body_time_limit(bodies_, model_.endtim));
  add_contacts_of_nodes(diagnostics);
  if (!add_joint_stiffness(deck_, model_, bodies_, world_, diagnostics))
    left_out_.push_back({"joint stiffness", "no *CONSTRAINED_JOINT_STIFFNESS"});
  if (!add_joints(deck_, model_, bodies_, world_, diagnostics))
    left_out_.push_back({"joints", "no *CONSTRAINED_JOINT"});
  if (const auto sets = make_node_sets(deck_, model_, world_, diagnostics))
    world_.passes.add(sets);
  else
    left_out_.push_back({"node sets that move alike", "no *CONSTRAINED_NODE_SET"});
  if (world_.groups.empty()) {
    if (const auto loads = make_nodal_loads(nodal_loads_, model_, points_of(world_.nodes), world_))
      world_.passes.add(loads);
    return left_out_.push_back({"solids", "no *ELEMENT_SOLID"});
  }
  add_springs(diagnostics);
  const bool turn = has_rotations(world_.nodes);
  if (turn) world_.passes.add(make_clear_forces(rotations_of(world_.nodes)));
  add_inertia_tensors(deck_, model_, !damping_.empty(), world_, diagnostics);
  hold_massless_nodes(diagnostics);
  if (!diagnostics.ok()) return;
  world_.passes.add(make_nodal_assembly(world_));
  const auto speeds = [this](Index part) -> std::optional<WaveSpeeds> {
    const auto& law = law_of_elements(part);
    if (!law) return std::nullopt;
    return WaveSpeeds{law->ro, sound_speed_of_elements(part), std::sqrt(law->shear_modulus() / law->ro)};
  };
  if (const auto dampers = make_non_reflecting(deck_, model_, speeds, world_, diagnostics))
    world_.passes.add(dampers);
  add_loads(points_of(world_.nodes), BodyAcceleration(model_.body_loads));
  world_.passes.add(make_point_motion(points_of(world_.nodes)));
  world_.passes.add(make_kinetic_energy(points_of(world_.nodes)));
  if (turn) add_rotations();
}

/// Whether nothing but bodies, springs and lumped masses moves.
bool Simulation::moves_all_by_bodies() const {
  return world_.particles.size() == 0 &&
         std::all_of(world_.groups.begin(), world_.groups.end(), [](const auto& group) {
           return sum(group->size(), [&](Index e) { return group->mass[e]; }) == 0 || group->corners() == 1 ||
                  !group->pushes;
         });
}

void Simulation::add_springs(Diagnostics& diagnostics) {
  const bool alone = moves_all_by_bodies();
  if (springs_.empty() && !alone) return left_out_.push_back({"springs", "no *ELEMENT_DISCRETE"});
  SpringBodies bodies;
  if (bodies_) {
    bodies.walls = bodies_->wall_bodies(world_);
    bodies.turn = [this](Index body, const Vec& axis) {
      const RigidBody& b = bodies_->bodies()[static_cast<std::size_t>(body)];
      return axis.dot(b.turning_by(axis, b.q));
    };
  }
  const Real longest = alone ? model_.endtim / 1000 : std::numeric_limits<Real>::infinity();
  add_discrete_passes(deck_, std::move(springs_), std::move(bodies), model_.tssfac, longest, world_,
                      diagnostics);
}

/// What springs end at may lack a mass where it cannot follow a force: it gets one that does nothing.
void Simulation::hold_massless_nodes(Diagnostics& diagnostics) {
  for (Index n = 0; n < world_.nodes.size(); ++n)
    if (!world_.nodes.follow[n] && !(world_.nodes.m[n] > 0)) {
      const auto node = std::find_if(model_.nodes.begin(), model_.nodes.end(),
                                     [&](const ModelNode& m) { return m.id == world_.nodes.id[n]; });
      if (node != model_.nodes.end() && node->fixed == std::array{true, true, true}) {
        world_.nodes.m[n] = mass_of_held;
        continue;
      }
      return diagnostics.error({deck_.files[0].name},
                               fmt::format("node {} moves by its forces and has no mass", world_.nodes.id[n]),
                               "give it one by elements or *ELEMENT_MASS, or hold all of its translations");
    }
}

RigidWallPenalty Simulation::wall_penalty() {
  RigidWallPenalty out;
  if (bodies_) out.bodies = bodies_->wall_bodies(world_);
  if (const auto* control = deck_.last<ControlContact>())
    out.scale = std::abs(control->rwpnal), out.of_all_nodes = control->rwpnal < 0;
  return out;
}

void Simulation::add_contacts_of_nodes(Diagnostics& diagnostics) {
  NodeContactOptions options;
  options.bulk_modulus = [this](Index part) { return bulk_modulus(part); };
  if (bodies_) options.bodies = bodies_->wall_bodies(world_);
  options.tssfac = model_.tssfac;
  for (const auto& contact : contacts_) options.with_particles.insert(contact->report().id);
  warn_of_beams_that_touch_nothing(deck_, model_, options, diagnostics);
  const NodeContactsByCard nodes = add_node_contacts(deck_, model_, options, world_, diagnostics);
  add_edge_contacts(deck_, model_, options, nodes, world_, diagnostics);
}

}  // namespace courant
