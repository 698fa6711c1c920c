// What elements bring into a world: nodes, masses, forces, and the motion of nodes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "elements/beam/beams.hpp"
#include "elements/build_nodes.hpp"
#include "elements/discrete/discrete.hpp"
#include "elements/discrete_beam/cables.hpp"
#include "elements/discrete_beam/discrete_beams.hpp"
#include "elements/element_laws.hpp"
#include "elements/erosion.hpp"
#include "elements/histories/secforc.hpp"
#include "elements/mass_scaling.hpp"
#include "elements/nodal_assembly.hpp"
#include "elements/nodal_rotations.hpp"
#include "elements/node_inertias.hpp"
#include "elements/shell/shells.hpp"
#include "elements/shell_faces/shell_faces.hpp"
#include "elements/solid/reference_geometry.hpp"
#include "elements/solid/solids.hpp"
#include "elements/stiffness_damping.hpp"
#include "extension/builders.hpp"
#include "extension/part_values.hpp"
#include "laws/fluid/mat_null.hpp"
#include "loads/loads.hpp"
#include "loads/non_reflecting.hpp"
#include "loads/point_motion.hpp"
#include "model/mesh/plane_strain.hpp"
#include "model/requests/output_cards.hpp"
#include "surfaces/skin.hpp"

namespace courant {

namespace {

/// Of each node of the model the node of the world, -1: none.
struct NodeMap {
  std::vector<Index> of_model{};
};

void find_null_parts(const Deck& deck, Model& model, Diagnostics& diagnostics, const RigidParts&,
                     PartKinds&) {
  for (ModelPart& part : model.parts) part.null = is_null(deck, model, part);
  check_null_parts(deck, model, diagnostics);
}

void find_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics, const PartKinds&,
                std::vector<ShellPart>& shells, std::vector<BeamPart>& beams, std::vector<CablePart>& cables,
                std::vector<DiscreteBeamPart>& discrete) {
  shells = find_shell_parts(deck, model, diagnostics);
  beams = find_beam_parts(deck, model, diagnostics);
  cables = find_cable_parts(deck, model, diagnostics);
  discrete = find_discrete_beam_parts(deck, model, diagnostics);
}

void find_nodes(const Deck& deck, const Model& model, const std::vector<ShellPart>& shells, MoreNodes& more,
                Movers& movers) {
  const std::vector<Index> springs = discrete_nodes(deck, model);
  for (const auto& nodes : {beam_nodes(model), springs})
    more.nodes.insert(more.nodes.end(), nodes.begin(), nodes.end());
  const bool shells_deform =
      std::any_of(shells.begin(), shells.end(), [](const ShellPart& part) { return part.law != nullptr; });
  movers.any |= shells_deform || !model.solids.empty() || !model.beams.empty() || !springs.empty();
}

void make_nodes(Model& model, World& world, Diagnostics& diagnostics, const MoreNodes& more, NodeMap& nodes) {
  if (world.dim == 2) hold_in_plane(model, diagnostics);
  nodes.of_model = build_nodes(model, more.nodes, world);
}

void make_shell_faces(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                      const NodeMap& nodes, const RigidParts& rigid, const std::vector<ShellPart>& shells) {
  const auto material = [&](Index part, Index layup) -> std::optional<ShellMaterial> {
    const auto k = static_cast<std::size_t>(part);
    if (const auto& m = rigid.of_part[k]) return ShellMaterial{m->ro, m->E, m->pr};
    if (shells[k].faulty) return ShellMaterial{1, 1, 0};  // which is reported: nothing more of it
    if (!shells[k].law) return std::nullopt;
    const ShellPart& one = shells[k].of(layup);
    const ElasticConstants of_laws = elastic_constants(one);
    return ShellMaterial{one.density(), of_laws.E, of_laws.nu};
  };
  build_segments(deck, model, material, nodes.of_model, world, diagnostics);
}

void find_laws(const Deck& deck, const Model& model, Diagnostics& diagnostics, const RigidParts& rigid,
               const std::vector<ShellPart>& shells, const std::vector<BeamPart>& beams,
               const std::vector<CablePart>& cables, std::vector<SolidPart>& solids, ElementLaws& laws,
               BulkModuli& bulk_moduli, MassGrowth& growth) {
  solids = find_solid_parts(deck, model, diagnostics);
  bulk_moduli.of_part.resize(model.parts.size());
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const auto& law = solids[k].law ? solids[k].law : shells[k].law ? shells[k].law : beams[k].law;
    laws.of_part.push_back(law);
    laws.sound_speed.push_back(!law ? 0 : solids[k].law ? solids[k].sound_speed() : law->sound_speed());
    Real& bulk_modulus = bulk_moduli.of_part[k];
    if (law)
      bulk_modulus = model.parts[k].ssf * (solids[k].law ? solids[k].bulk_modulus() : law->bulk_modulus());
    else if (rigid.of_part[k] && bulk_modulus == 0)
      bulk_modulus = model.parts[k].ssf * rigid.of_part[k]->bulk_modulus();
  }
  for (const CablePart& part : cables)
    if (!part.area.empty() && part.area[0] > 0)
      bulk_moduli.of_part[static_cast<std::size_t>(part.part)] =
          model.parts[static_cast<std::size_t>(part.part)].ssf * part.bulk_modulus();
  check_mass_scaling(deck, diagnostics);
  const MassScaling scaling = mass_scaling_of(deck);
  growth.in_run = scaling.step > 0 && !scaling.once;
}

void build_elements(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                    const NodeMap& nodes, const ElementLaws& laws, const BulkModuli& bulk_moduli,
                    const InnerFaces& inner, const std::vector<SolidPart>& solids,
                    const std::vector<ShellPart>& shells, std::vector<BeamPart>& beams,
                    const std::vector<CablePart>& cables, const std::vector<DiscreteBeamPart>& discrete,
                    std::vector<SpringPart>& springs) {
  const std::vector<Index>& node_of = nodes.of_model;
  build_solids(model, solids, node_of, world);
  build_shells(model, shells, node_of, world, diagnostics);
  std::vector<std::shared_ptr<StrengthLaw>> that_deform = laws.of_part;
  std::vector<bool> by_pressure;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (model.parts[k].null) that_deform[k] = nullptr;
    by_pressure.push_back(solids[k].pressure != nullptr ||
                          (solids[k].law && solids[k].formulation->nodal_pressure));
  }
  ElementOptions options{
      mass_scaling_of(deck), failure_rules(deck, model, that_deform, world.goes_on, diagnostics),
      stiffness_damping(deck, model, that_deform, by_pressure, diagnostics),
      stress_ranges(deck, model, that_deform, by_pressure, diagnostics), has_cross_sections(deck)};
  const auto* extent = deck.last<DatabaseExtentBinary>();
  options.strains = extent && extent->strflg != 0;
  add_solid_passes(model, solids, node_of,
                   reference_geometry(deck, model, solids, node_of, world, diagnostics), options, world,
                   diagnostics);
  add_shell_passes(model, shells, node_of, options, world);
  build_beams(model, beams, node_of, world, diagnostics);
  add_beam_passes(model, beams, options, world);
  build_cables(model, cables, node_of, options, world);
  build_discrete_beams(model, discrete, node_of, options, world, diagnostics);
  springs = build_discrete(deck, model, node_of, world, diagnostics);
  if (inner.wanted)
    for (const auto& group : options.eroding)
      if (!group->group().segment && group->group().corners() > 2)
        add_skin(world, {group->group().part, bulk_moduli(group->group().part), true});
  add_erosion(model, std::move(options.eroding), world);
}

void finish_masses(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                   const NodeMap& nodes, const UnweighedNodes& unweighed,
                   const std::vector<BeamPart>& beams) {
  take_back_added_mass(unweighed.nodes, world);
  if (diagnostics.ok()) {
    report_mass_scaling(deck, model, world, diagnostics);
    report_beam_scaling(deck, model, beams, world, diagnostics);
  }
  add_rotary_inertias(deck, model, world, diagnostics);
  start_rotations(model, nodes.of_model, world);
}

void clear_forces(World& world, LeftOut& left_out, const BodyPasses& bodies, const Additions&) {
  if (bodies.move || !world.groups.empty())
    world.passes.add(make_clear_forces(points_of(world.nodes)));
  else
    left_out.add("forces on nodes", "no node moves");
}

/// What springs end at may lack a mass where it cannot follow a force: it gets one that does nothing.
void hold_massless_nodes(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  for (Index n = 0; n < world.nodes.size(); ++n)
    if (!world.nodes.follow[n] && !(world.nodes.m[n] > 0)) {
      const auto node = std::find_if(model.nodes.begin(), model.nodes.end(),
                                     [&](const ModelNode& m) { return m.id == world.nodes.id[n]; });
      if (node != model.nodes.end() && node->fixed == std::array{true, true, true}) {
        world.nodes.m[n] = mass_of_held;
        continue;
      }
      return diagnostics.error({deck.files[0].name},
                               fmt::format("node {} moves by its forces and has no mass", world.nodes.id[n]),
                               "give it one by elements or *ELEMENT_MASS, or hold all of its translations");
    }
}

// Nodes of elements move by their forces; those of rigid bodies with these.
void move_nodes(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                LeftOut& left_out, const PointLoads& loads, const WallBodies& bodies, const ElementLaws& laws,
                std::vector<SpringPart>& springs) {
  if (world.groups.empty()) {  // forces on nodes of bodies
    if (const auto forces = make_nodal_loads(loads.nodal, model, points_of(world.nodes), world))
      world.passes.add(forces);
    return left_out.add("solids", "no *ELEMENT_SOLID");
  }
  const bool alone = moves_all_by_bodies(world);
  if (springs.empty() && !alone)
    left_out.add("springs", "no *ELEMENT_DISCRETE");
  else
    add_discrete_passes(deck, std::move(springs), bodies, model.tssfac,
                        alone ? model.endtim / 1000 : std::numeric_limits<Real>::infinity(), world,
                        diagnostics);
  const bool turn = has_rotations(world.nodes);
  if (turn) world.passes.add(make_clear_forces(rotations_of(world.nodes)));
  add_inertia_tensors(deck, model, !loads.damping.empty(), world, diagnostics);
  hold_massless_nodes(deck, model, world, diagnostics);
  if (!diagnostics.ok()) return;
  world.passes.add(make_nodal_assembly(world));
  const auto speeds = [&](Index part) -> std::optional<WaveSpeeds> {
    const auto k = static_cast<std::size_t>(part);
    const auto& law = laws.of_part[k];
    if (!law) return std::nullopt;
    return WaveSpeeds{law->ro, laws.sound_speed[k], std::sqrt(law->shear_modulus() / law->ro)};
  };
  if (const auto dampers = make_non_reflecting(deck, model, speeds, world, diagnostics))
    world.passes.add(dampers);
  const Points nodes = points_of(world.nodes);
  if (model.body_loads.empty())
    left_out.add("body loads on nodes", "no *LOAD_BODY, *LOAD_GRAVITY_PART");
  else
    world.passes.add(make_body_load(BodyAcceleration(model.body_loads), nodes, world));
  add_loads(nodes, deck, model, loads, world, &left_out);
  world.passes.add(make_point_motion(nodes));
  world.passes.add(make_kinetic_energy(nodes));
  if (!turn) return;  // rotations obey the same equation as positions
  const Points rotations = rotations_of(world.nodes);
  add_loads(rotations, deck, model, loads, world, nullptr);
  world.passes.add(make_point_motion(rotations));
  world.passes.add(make_kinetic_energy(rotations));
}

void sum_rest_energy(const World& world, const ElementLaws& laws, NodeMap& nodes, RestEnergy& energy) {
  for (const auto& group : world.groups)
    if (const Real c = laws.speed(group->part); c > 0)
      energy.value += c * c * sum(group->size(), [&](Index k) { return group->mass[k]; });
  nodes = {};  // only set-up needs it
}

const RegisterBuilder null_parts(BuildPhase::parts, "null parts", find_null_parts, Errors::go_on);
const RegisterBuilder parts(BuildPhase::parts, "parts of elements", find_parts, Errors::go_on);
const RegisterBuilder nodes(BuildPhase::nodes, "nodes of elements", find_nodes, Errors::go_on);
const RegisterBuilder world_nodes(BuildPhase::nodes, "nodes", make_nodes, Errors::go_on);
const RegisterBuilder faces(BuildPhase::nodes, "shell faces", make_shell_faces, Errors::go_on);
const RegisterBuilder laws(BuildPhase::nodes, "solids and laws of elements", find_laws, Errors::go_on);
const RegisterBuilder elements(BuildPhase::elements, "elements", build_elements);
const RegisterBuilder masses(BuildPhase::bodies, "masses of nodes", finish_masses, Errors::go_on);
const RegisterBuilder clear(BuildPhase::body_passes, "clear forces", clear_forces, Errors::go_on);
const RegisterBuilder motion(BuildPhase::node_passes, "motion of nodes", move_nodes);
const RegisterBuilder energy(BuildPhase::checks, "rest energy of elements", sum_rest_energy);

}  // namespace

}  // namespace courant
