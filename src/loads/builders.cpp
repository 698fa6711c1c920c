// What loads and constraints bring into a world.
#include "extension/builders.hpp"
#include "extension/part_values.hpp"
#include "loads/idle_parts.hpp"
#include "loads/interpolation.hpp"
#include "loads/loads.hpp"
#include "loads/node_sets.hpp"
#include "loads/sensors/sensor_force.hpp"
#include "loads/sensors/sensors.hpp"
#include "model/conditions/relaxation.hpp"

namespace courant {

namespace {

void find_relaxation(const Deck& deck, const Model& model, Diagnostics& diagnostics, Relaxation& relaxation) {
  relaxation = relaxation_of(deck, model, !model.sph.empty(), diagnostics);
}

void interpolate(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                 const MassGrowth& growth, const TiedNodes&) {
  add_interpolations(deck, model, growth.in_run, world, diagnostics);
}

void find_loads(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics,
                const Relaxation& relaxation, PointLoads& loads) {
  loads.nodal = nodal_loads(deck, model, world, diagnostics);
  loads.damping = damping_of(deck, model, world, diagnostics);
  loads.relaxation_factor = relaxation.factor;
  check_gravity_of_parts(deck, model, world, diagnostics);
}

void move_points(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                 LeftOut& left_out, const Relaxation& relaxation, const MotionLimits& limits,
                 std::vector<PrescribedMotion>& motions) {
  motions = prescribed_motions(deck, model, diagnostics, relaxation.asked);
  if (motions.empty()) left_out.add("prescribed motion", "no *BOUNDARY_PRESCRIBED_MOTION");
  add_prescribed_points(motions, deck, model, limits, world, diagnostics);
}

void put_up_walls(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                  LeftOut& left_out, const std::vector<PrescribedMotion>&, const WallBodies& bodies,
                  const RigidWallPenalty& asked, RigidWallsThere& walls) {
  RigidWallPenalty penalty = asked;
  penalty.bodies = bodies;
  walls.any = add_rigid_walls(deck, model, penalty, world, diagnostics);
  if (!walls.any) left_out.add("rigid walls", "no *RIGIDWALL");
}

void press_faces(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                 LeftOut& left_out, const BodyPasses&, const WallBodies& bodies) {
  if (const auto pressure = make_segment_pressure(deck, model, bodies, world, diagnostics))
    world.passes.add(pressure);
  else
    left_out.add("pressure on segments", "no *LOAD_SEGMENT, no *LOAD_SHELL, no *LOAD_BLAST");
}

void join_nodes(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                LeftOut& left_out) {
  if (const auto sets = make_node_sets(deck, model, world, diagnostics))
    world.passes.add(sets);
  else
    left_out.add("node sets that move alike", "no *CONSTRAINED_NODE_SET");
}

const RegisterBuilder relaxation(BuildPhase::model, "relaxation", find_relaxation, Errors::go_on);
const RegisterBuilder interpolation(BuildPhase::ties, "interpolation", interpolate);
const RegisterBuilder loads(BuildPhase::conditions, "loads on points", find_loads, Errors::go_on);
const RegisterBuilder motions(BuildPhase::conditions, "prescribed motion", move_points, Errors::go_on);
const RegisterBuilder walls(BuildPhase::conditions, "rigid walls", put_up_walls, Errors::go_on);
const RegisterBuilder pressure(BuildPhase::body_passes, "pressure on faces", press_faces, Errors::go_on);
const RegisterBuilder sets(BuildPhase::joints, "node sets", join_nodes, Errors::go_on);
const RegisterBuilder sensors(BuildPhase::checks, "sensors", check_sensors);

}  // namespace

void add_loads(const Points& points, const Deck& deck, const Model& model, const PointLoads& loads,
               World& world, LeftOut* left_out) {
  const auto add = [&](const std::shared_ptr<BlockPass>& pass, const char* what, const char* keyword) {
    if (pass)
      world.passes.add(pass);
    else if (left_out)
      left_out->add(std::string(what) + " on " + points.fields().name(), std::string("no ") + keyword);
  };
  add(make_nodal_loads(loads.nodal, model, points, world), "nodal forces", "*LOAD_NODE");
  add(make_fixed_points(model, points, world, measures_supports(deck)), "SPC", "*BOUNDARY_SPC");
  add(make_damping(loads.damping, points, world), "damping", "*DAMPING");
  if (model.phase == RunPhase::relaxation)
    world.passes.add(make_slow_points(points, loads.relaxation_factor));
}

}  // namespace courant
