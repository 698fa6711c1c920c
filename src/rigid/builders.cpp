// What rigid bodies and joints bring into a world.
#include <map>

#include "extension/builders.hpp"
#include "extension/part_values.hpp"
#include "loads/loads.hpp"
#include "rigid/bodies/body_cards.hpp"
#include "rigid/bodies/nodal_bodies.hpp"
#include "rigid/bodies/replaced_velocity.hpp"
#include "rigid/bodies/rigid.hpp"
#include "rigid/bodies/time_limit.hpp"
#include "rigid/joints/build_joints.hpp"
#include "rigid/joints/joint_stiffness.hpp"
#include "rigid/switches/switched_parts.hpp"

namespace courant {

namespace {

void find_rigid_parts(const Deck& deck, Model& model, RigidParts& rigid, PartKinds&) {
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    rigid.of_part.push_back(rigid_material(deck, model, static_cast<Index>(k)));
    model.parts[k].rigid = rigid.of_part.back().has_value();
  }
}

void find_nodes(const Deck& deck, const Model& model, MoreNodes& more) {
  Diagnostics reported_with_bodies;
  for (const auto& [part, nodes] : extra_nodes(deck, model, reported_with_bodies))
    for (const ExtraNode& extra : nodes) more.nodes.push_back(extra.node);
  for (const NodalBody& body : nodal_bodies(deck, model, reported_with_bodies)) {
    more.nodes.insert(more.nodes.end(), body.nodes.begin(), body.nodes.end());
    if (body.output_node >= 0) more.nodes.push_back(body.output_node);
  }
}

void build_bodies(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                  std::shared_ptr<RigidBodies>& bodies, WallBodies& walls, UnweighedNodes& unweighed,
                  StepShare& share, Movers& movers) {
  check_irigid(deck, model, diagnostics);
  bodies = build_rigid_bodies(deck, model, world, diagnostics);
  if (!bodies) return;
  walls = bodies->wall_bodies(world);
  unweighed.nodes = bodies->unweighed_nodes();
  share.value = bodies->step_share();
  movers.any |= bodies->any_moves();
}

void drive_bodies(const Deck& deck, const Model& model, Diagnostics& diagnostics,
                  const std::vector<PrescribedMotion>& motions, std::shared_ptr<RigidBodies>& bodies) {
  RigidBodies none({});
  (bodies ? *bodies : none).follow(motions, deck, model, diagnostics);
}

/// Moments of *LOAD_NODE_POINT and _SET on nodes of bodies.
void add_moments(const Model& model, const World& world, const WallBodies& walls, const PointLoads& loads,
                 RigidBodies& bodies) {
  std::map<Id, Index> node_of_id;
  for (const NodalLoad& load : loads.nodal) {
    if (!load.turns) continue;
    if (node_of_id.empty())
      for (Index n = 0; n < world.nodes.size(); ++n) node_of_id[world.nodes.id[n]] = n;
    for (const Index n : load.nodes) {
      const auto node = node_of_id.find(model.nodes[static_cast<std::size_t>(n)].id);
      const Index body = node == node_of_id.end() ? -1 : walls.body(node->second);
      if (body < 0) continue;
      const auto k = static_cast<std::size_t>(body);
      bodies.add_load(k, {.body = bodies.bodies()[k].part,
                          .direction = load.direction,
                          .turns = true,
                          .curve = load.curve,
                          .sf = load.sf});
    }
  }
}

void add_passes(const Model& model, World& world, Diagnostics& diagnostics, LeftOut& left_out,
                const std::shared_ptr<RigidBodies>& bodies, const WallBodies& walls, const PointLoads& loads,
                BodyPasses& passes) {
  if (bodies) {
    bodies->set_damping(loads.damping, model, diagnostics);
    add_moments(model, world, walls, loads, *bodies);
  }
  if (!bodies || !bodies->any_moves())
    return left_out.add("rigid bodies", bodies ? "all are held in every direction" : "no *MAT_RIGID");
  passes.move = true;
  bodies->set_loads(BodyAcceleration(model.body_loads));
  add_body_passes(world, bodies);
  if (moves_all_by_bodies(world)) world.passes.add(make_body_time_limit(bodies, model.endtim));
}

void join_bodies(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                 LeftOut& left_out, const std::shared_ptr<RigidBodies>& bodies) {
  if (!add_joint_stiffness(deck, model, bodies, world, diagnostics))
    left_out.add("joint stiffness", "no *CONSTRAINED_JOINT_STIFFNESS");
  if (!add_joints(deck, model, bodies, world, diagnostics)) left_out.add("joints", "no *CONSTRAINED_JOINT");
}

void check(const Deck& deck, const World& world, Diagnostics& diagnostics,
           const std::shared_ptr<RigidBodies>& bodies, RestEnergy& energy) {
  check_switches(deck, world, diagnostics);
  if (bodies) energy.value += bodies->rest_energy();
}

const RegisterBuilder kinds(BuildPhase::parts, "rigid parts", find_rigid_parts, Errors::go_on);
const RegisterBuilder nodes(BuildPhase::nodes, "nodes of bodies", find_nodes, Errors::go_on);
const RegisterBuilder bodies(BuildPhase::bodies, "rigid bodies", build_bodies, Errors::go_on);
const RegisterBuilder drives(BuildPhase::conditions, "driven bodies", drive_bodies, Errors::go_on);
const RegisterBuilder passes(BuildPhase::body_passes, "passes of bodies", add_passes, Errors::go_on);
const RegisterBuilder joints(BuildPhase::joints, "joints", join_bodies, Errors::go_on);
const RegisterBuilder checks(BuildPhase::checks, "switched parts", check);

}  // namespace

}  // namespace courant
