// What particles bring into a world.
#include <fmt/format.h>

#include <cmath>

#include "extension/builders.hpp"
#include "extension/part_values.hpp"
#include "loads/body_acceleration.hpp"
#include "loads/loads.hpp"
#include "loads/point_motion.hpp"
#include "sph/inlets/injection.hpp"
#include "sph/materials/explosive.hpp"
#include "sph/materials/initial_stress.hpp"
#include "sph/materials/materials.hpp"
#include "sph/options/subcycle.hpp"
#include "sph/outlets/frozen_outlet.hpp"
#include "sph/outlets/level_outlet.hpp"
#include "sph/skin.hpp"
#include "sph/sph.hpp"
#include "sph/walls/ghosts/wall_ghosts.hpp"
#include "state/ranges.hpp"

namespace courant {

namespace {

/// Ghosts behind planes, and behind shells.
struct GhostsOfScene {
  std::vector<GhostPlane> planes{};
  std::shared_ptr<Relocation> mirrors{};   ///< null: none
  std::shared_ptr<WallGhosts> of_walls{};  ///< null: none
};

void add_inlets(const Deck& deck, Model& model, Diagnostics& diagnostics, Injections& injections) {
  injections = add_injected_particles(deck, model, diagnostics);
}

void find_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics, const PartKinds&,
                std::vector<PartMaterial>& materials) {
  materials = find_materials(deck, model, diagnostics);
}

void make_particles(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                    const std::vector<PartMaterial>& materials, SphSettings& settings,
                    BulkModuli& bulk_moduli, Movers& movers) {
  const auto material = [&](Index part) { return materials[static_cast<std::size_t>(part)].for_particles(); };
  settings = build_particles(deck, model, material, world, diagnostics);
  movers.any |= !model.sph.empty();
  bulk_moduli.of_part.resize(model.parts.size());
  for (std::size_t k = 0; k < materials.size(); ++k)
    if (const auto& law = materials[k].strength)
      bulk_moduli.of_part[k] = model.parts[k].ssf * law->bulk_modulus();
}

void read_settings(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                   SphSettings& settings) {
  read_supported_walls(deck, model, world, settings, diagnostics);
  read_turbulence(deck, model, world, settings, diagnostics);
}

constexpr std::string_view not_of_particles[] = {"COURANT_OUTPUT",      "COURANT_D3PLOT",
                                                 "COURANT_VERDICT",     "COURANT_RIGID_INERTIA",
                                                 "COURANT_GAUGE_FORCE", "COURANT_PROGRAM_FORCES"};

void report_what_needs_particles(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  for (const auto& [name, use] : deck.keywords) {
    const auto* const other = std::find(std::begin(not_of_particles), std::end(not_of_particles), name);
    if (use.treatment != Treatment::honoured || other != std::end(not_of_particles)) continue;
    for (const char* begin : {"COURANT_", "BOUNDARY_SPH_", "DEFINE_SPH_"})
      if (name.starts_with(begin))
        diagnostics.warning({deck.files[0].name},
                            fmt::format("*{} does nothing: the deck has no particles", name),
                            "leave it out, or give the deck particles");
  }
  const FieldRequests& wanted = model.output.fields;
  if (!wanted.fields.empty())
    deck.warning(diagnostics, wanted.card, "FIELDS",
                 "chooses arrays of particles, of which the deck has none");
}

void add_ghosts(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                LeftOut& left_out, Real h, Neighbours& neighbours, SphSettings& settings,
                GhostsOfScene& out) {
  const Real reach = neighbours.support() * h + neighbours.largest_skin();
  out.planes = build_ghost_planes(deck, model, settings, reach, world, diagnostics);
  if (out.planes.empty())
    return left_out.add("ghost particles", "no *BOUNDARY_SPH_SYMMETRY_PLANE, no *BOUNDARY_SPH_PERIODIC");
  for (const GhostPlane& plane : out.planes) {
    if (plane.kind != GhostPlane::Kind::periodic) continue;
    settings.loads = settings.loads.without(plane.normal);  // along a period nothing rests on anything
    check_body_loads_periodic(deck, plane.normal, diagnostics);
  }
  for (const GhostPlane& plane : out.planes)
    if (plane.kind == GhostPlane::Kind::mirror) settings.mirrors.push_back(plane);
  settings.walls.planes = out.planes;
  auto ghosts = std::make_shared<GhostParticles>(out.planes);
  neighbours.add_ghosts(ghosts);
  world.passes.add(ghosts);
  out.mirrors = ghosts->make_mirrors(acceleration_of_particles(model));
}

/// Behind those of planes, as they take on what copies of particles have, too.
void add_wall_ghosts(World& world, Neighbours& neighbours, const GhostsOfScene& ghosts) {
  std::shared_ptr<GhostParticles> copies;
  if (!ghosts.planes.empty()) copies = std::make_shared<GhostParticles>(ghosts.planes, ghosts.of_walls);
  ghosts.of_walls->set_lists(neighbours, copies);
  neighbours.add_ghosts(ghosts.of_walls);
  world.passes.add(ghosts.of_walls);
  if (!copies) return;
  neighbours.add_ghosts(copies);
  world.passes.add(copies);
}

void find_neighbours(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                     LeftOut& left_out, const Injections& injections, SphSettings& settings,
                     std::shared_ptr<Neighbours>& neighbours, GhostsOfScene& ghosts, MotionLimits& limits,
                     ParticleContactRules& rules) {
  limits = {settings.dim, settings.region.has_value(), {}};
  if (world.particles.size() == 0) {
    left_out.add("particles", "no *ELEMENT_SPH");
    return report_what_needs_particles(deck, model, diagnostics);
  }
  const Real h = maximum(world.particles.size(), [&](Index i) { return world.particles.h[i]; });
  neighbours = std::make_shared<Neighbours>(first_skin * h, settings.region, kernel_support(settings.kernel));
  neighbours->adapt_skin(least_skin * h, most_skin * h,
                         settings.geometry_eps > 0 ? skin_weight_of_windows : skin_weight);
  if (!settings.evolving_h) neighbours->keep_h();
  make_injected_wait(injections, world, *neighbours);
  if (injections.inlets.empty()) left_out.add("inlets", "no *DEFINE_SPH_INJECTION");
  add_ghosts(deck, model, world, diagnostics, left_out, h, *neighbours, settings, ghosts);
  ghosts.of_walls = build_wall_ghosts(deck, model, settings, world, diagnostics);
  if (ghosts.of_walls) add_wall_ghosts(world, *neighbours, ghosts);
  for (const GhostPlane& plane : settings.mirrors) limits.mirrors.push_back(plane.normal);
  rules = {true, settings.skip_inactive_contact, settings.thickness_from_volume, neighbours->largest_skin()};
}

void warn_of_walls(const Deck& deck, Diagnostics& diagnostics, const RigidWallsThere& walls,
                   const SphSettings& settings) {
  if (walls.any && (settings.xsph > 0 || settings.velocity_smoothing > 0 || settings.shift.strength > 0))
    diagnostics.warning({deck.files[0].name},
                        "rigid walls stop the velocity of particles, not what shifting or averaged "
                        "velocities move them by: they may get a little behind a wall",
                        "use neither, or plates with *CONTACT as walls");
}

void set_pressures(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                   const std::vector<PartMaterial>& materials, const Injections& injections,
                   const SphSettings& settings, ParticlePressures&) {
  if (world.particles.size() == 0) return;
  if (diagnostics.ok()) set_initial_pressures(deck, model, materials, world, diagnostics);
  if (diagnostics.ok()) set_inlet_pressures(injections, deck, model, materials, world, diagnostics);
  if (!diagnostics.ok()) return;
  add_burn(world, deck, model, diagnostics);
  add_equations_of_state(world, model, materials, settings);
}

void add_passes(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                LeftOut& left_out, const ParticlePressures&, const std::vector<PartMaterial>& materials,
                const SphSettings& settings, const GhostsOfScene& ghosts, const PointLoads& loads,
                const SubcycleChoice& subcycle, const std::shared_ptr<Neighbours>& neighbours, FlowPasses&) {
  if (!neighbours) return;
  const Points particles = points_of(world.particles);
  const BodyAcceleration acceleration = acceleration_of_particles(model);
  world.passes.add(make_clear_forces(particles));
  world.passes.add(make_point_motion(particles));
  world.passes.add(make_kinetic_energy(particles));
  add_drifts(settings, acceleration, world);
  if (ghosts.mirrors) world.passes.add(ghosts.mirrors);
  add_sph_time_limit(settings, model, world);
  for (PassNote& note : add_sph_passes(world, settings, neighbours, ghosts.of_walls))
    left_out.notes.push_back(std::move(note));
  add_mirror_core(settings, ghosts.planes, world);
  add_subcycle(subcycle, *neighbours, world);
  if (model.body_loads.empty())
    left_out.add("body loads on particles", "no *LOAD_BODY, *LOAD_GRAVITY_PART");
  else
    world.passes.add(make_body_load(acceleration, particles, world, neighbours));
  add_loads(particles, deck, model, loads, world, &left_out);
  if (!add_level_outlets(deck, model, settings, ghosts.planes, world, diagnostics))
    left_out.add("level outlet", "no *COURANT_LEVEL_OUTLET");
  if (!add_frozen_outlets(deck, model, settings, materials, neighbours, world, diagnostics))
    left_out.add("frozen outlets", "no *COURANT_FROZEN_OUTLET");
}

// Before the first step, so that c0 is that of the material at rest.
void find_reference(const Model& model, const World& world, const std::vector<PartMaterial>& materials,
                    Ranges& ranges, RestEnergy& energy) {
  ranges.resize(model.parts.size());
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    ranges[k].part = model.parts[k].id;
    const PartMaterial& m = materials[k];
    if (!m.found) continue;
    ranges[k].rho0 = m.ro;
    ranges[k].c0 = m.c0();
    ranges[k].stiffness_field = m.stiffness_field();
  }
  const Particles& p = world.particles;
  energy.value += sum(p.size(), [&](Index i) {  // of inlets none, as their particles are made up to ENDTIM
    return p.state[i] == particle_waiting ? Real(0) : p.m[i] * std::pow(materials[p.part[i]].c0(), 2);
  });
}

const RegisterBuilder inlets(BuildPhase::model, "inlets", add_inlets, Errors::go_on);
const RegisterBuilder parts(BuildPhase::parts, "materials of particles", find_parts, Errors::go_on);
const RegisterBuilder particles(BuildPhase::particles, "particles", make_particles, Errors::go_on);
const RegisterBuilder settings(BuildPhase::settings, "walls and turbulence", read_settings, Errors::go_on);
const RegisterBuilder lists(BuildPhase::conditions, "neighbours", find_neighbours, Errors::go_on);
const RegisterBuilder walls(BuildPhase::flow, "rigid walls of particles", warn_of_walls, Errors::go_on);
const RegisterBuilder pressures(BuildPhase::flow, "pressures", set_pressures, Errors::go_on);
const RegisterBuilder passes(BuildPhase::flow, "passes of particles", add_passes);
const RegisterBuilder cards(BuildPhase::checks, "release of initial stresses", release_initial_stresses);
const RegisterBuilder reference(BuildPhase::checks, "particles at rest", find_reference);

}  // namespace

}  // namespace courant
