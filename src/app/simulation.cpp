#include "app/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "app/build_nodes.hpp"
#include "app/field_options.hpp"
#include "app/scene_warnings.hpp"
#include "app/skin.hpp"
#include "contact/cards.hpp"
#include "contact/contact_numbers.hpp"
#include "contact/nodes/build.hpp"
#include "contact/tied/build.hpp"
#include "elements/beam/cables.hpp"
#include "elements/beam/discrete_beams.hpp"
#include "elements/erosion.hpp"
#include "elements/histories/secforc.hpp"
#include "elements/nodal_assembly.hpp"
#include "elements/nodal_rotations.hpp"
#include "elements/node_inertias.hpp"
#include "elements/stiffness_damping.hpp"
#include "extension/additions.hpp"
#include "laws/fluid/mat_null.hpp"
#include "loads/idle_parts.hpp"
#include "loads/interpolation.hpp"
#include "loads/loads.hpp"
#include "loads/sensor_force.hpp"
#include "loads/sensors.hpp"
#include "model/build_model.hpp"
#include "model/mesh/plane_strain.hpp"
#include "model/transforms/included_entries.hpp"
#include "parallel/parallel.hpp"
#include "rigid/build_joints.hpp"
#include "rigid/joint_stiffness.hpp"
#include "rigid/nodal_bodies.hpp"
#include "rigid/switched_parts.hpp"
#include "rigid/time_limit.hpp"
#include "shell/shell.hpp"
#include "sph/boundaries/frozen_outlet.hpp"
#include "sph/boundaries/level_outlet.hpp"
#include "sph/materials/initial_stress.hpp"
#include "surfaces/skin.hpp"
#include "time/point_motion.hpp"

namespace courant {

namespace {

/// Whether nodes stand where distances can be computed; the rest of the set-up would take for ever. Those
/// that motions bring there are told here, others by the model.
bool holds_places(const std::string& deck_path, const Model& model, Diagnostics& diagnostics) {
  for (const ModelNode& node : model.nodes) {
    if (node.x.cwiseAbs().maxCoeff() < largest_coordinate) continue;
    if (diagnostics.ok())
      diagnostics.error({deck_path, 0, 0},
                        fmt::format("node {} is moved to ({:g}, {:g}, {:g}), which is too large", node.id,
                                    node.x[0], node.x[1], node.x[2]));
    return false;
  }
  return true;
}

}  // namespace

std::unique_ptr<Simulation> Simulation::build(const std::string& deck_path, const ReadOptions& options,
                                              Diagnostics& diagnostics, const DeckRecord* before,
                                              RunPhase phase) {
  const double start = PassTimer::now();
  Deck deck = read_deck(deck_path, options, diagnostics);
  if (!diagnostics.broken()) move_included_entries(deck, diagnostics);
  const double read = PassTimer::now();
  auto s = from_deck(deck_path, std::move(deck), diagnostics, before, phase);
  if (!s) return s;
  s->note_read_seconds(read - start, PassTimer::now() - read);
  return s;
}

void Simulation::note_read_seconds(double reading, double building) {
  timer_.add(timer_.row("keyword reader"), reading);
  timer_.add(timer_.row("set-up"), building);
  read_seconds_ = reading + building;
}

std::unique_ptr<Simulation> Simulation::from_read_deck(const std::string& deck_path, Deck deck,
                                                       Diagnostics& diagnostics, const DeckRecord* before,
                                                       RunPhase phase) {
  std::unique_ptr<Simulation> s(new Simulation);
  for (const char* row : {"keyword reader", "set-up"}) s->timer_.row(row);  // stand first
  s->deck_ = std::move(deck);
  s->record_ = record_deck(s->deck_), s->world_.goes_on = before != nullptr;
  if (before) s->changes_ = compare_decks(*before, s->deck_, s->record_, diagnostics);
  s->model_ = build_model(s->deck_, diagnostics, phase);
  s->relaxation_ = relaxation_of(s->deck_, s->model_, !s->model_.sph.empty(), diagnostics);
  if (!holds_places(deck_path, s->model_, diagnostics)) return nullptr;
  release_mesh_cards(s->deck_);
  number_contacts(s->deck_, diagnostics);
  s->injections_ = add_injected_particles(s->deck_, s->model_, diagnostics);
  s->build_parts(diagnostics);
  const bool model_is_whole = diagnostics.errors() == 0;
  const bool bodies_move = s->bodies_ && s->bodies_->any_moves();
  const bool shells_deform = std::any_of(s->shells_.begin(), s->shells_.end(),
                                         [](const ShellPart& part) { return part.law != nullptr; });
  if (s->model_.sph.empty() && s->model_.solids.empty() && s->model_.beams.empty() && !shells_deform &&
      !bodies_move && added_nodes(s->deck_, s->model_).empty() &&
      discrete_nodes(s->deck_, s->model_).empty() && model_is_whole)
    diagnostics.error(
        {deck_path, 0, 0},
        "the deck has no *ELEMENT_SPH, no elements that deform and no rigid body that can move: there "
        "is nothing to compute",
        "give it particles, solids, shells, beams, or a rigid body that is not held in all directions");
  if (model_is_whole) s->add_passes(diagnostics);
  if (!diagnostics.ok()) return nullptr;
  warn_of_scene(*s, diagnostics);
  s->release_tables();
  return s;
}

// What only messages about the deck and the building of the world need, some 300 bytes per particle.
void Simulation::release_tables() {
  deck_.release_sources();
  release_initial_stresses(deck_);
  model_.release_mesh();
}

void Simulation::build_parts(Diagnostics& diagnostics) {
  for (ModelPart& part : model_.parts) {
    world_.part_ids.push_back(part.id);
    part.rigid = rigid_material(deck_, model_, model_.part_of_id.at(part.id)).has_value();
    part.null = is_null(deck_, model_, part);
  }
  check_null_parts(deck_, model_, diagnostics);
  materials_ = find_materials(deck_, model_, diagnostics);
  shells_ = find_shell_parts(deck_, model_, diagnostics);
  beams_ = find_beam_parts(deck_, model_, diagnostics);
  const std::vector<CablePart> cables = find_cable_parts(deck_, model_, diagnostics);
  const auto discrete_beams = find_discrete_beam_parts(deck_, model_, diagnostics);
  const auto shell_material = [&](Index part, Index layup) -> std::optional<ShellMaterial> {
    if (const auto m = rigid_material(deck_, model_, part)) return ShellMaterial{m->ro, m->E, m->pr};
    if (shells_[part].faulty) return ShellMaterial{1, 1, 0};  // which is told: nothing more of it
    if (!shells_[part].law) return std::nullopt;
    const ShellPart& shells = shells_[part].of(layup);
    const ElasticConstants of_laws = elastic_constants(shells);
    return ShellMaterial{shells.density(), of_laws.E, of_laws.nu};
  };
  const auto sph_material = [&](Index part) { return materials_[part].for_particles(); };
  sph_ = build_particles(deck_, model_, sph_material, world_,
                         diagnostics);  // sets world_.dim, which rigid bodies ask for
  if (world_.dim == 2) hold_in_plane(model_, diagnostics);
  std::vector<Index> more = added_nodes(deck_, model_);
  for (const auto& nodes : {beam_nodes(model_), discrete_nodes(deck_, model_)})
    more.insert(more.end(), nodes.begin(), nodes.end());
  Diagnostics told_with_bodies;
  for (const auto& [part, nodes] : extra_nodes(deck_, model_, told_with_bodies))
    for (const ExtraNode& extra : nodes) more.push_back(extra.node);
  for (const NodalBody& body : nodal_bodies(deck_, model_, told_with_bodies)) {
    more.insert(more.end(), body.nodes.begin(), body.nodes.end());
    if (body.output_node >= 0) more.push_back(body.output_node);
  }
  const std::vector<Index> node_of = build_nodes(model_, more, world_);
  build_segments(deck_, model_, shell_material, node_of, world_, diagnostics);
  solids_ = find_solid_parts(deck_, model_, diagnostics);
  if (diagnostics.ok()) {
    build_solids(model_, solids_, node_of, world_);
    build_shells(model_, shells_, node_of, world_, diagnostics);
    std::vector<std::shared_ptr<StrengthLaw>> laws;
    for (std::size_t k = 0; k < model_.parts.size(); ++k)
      laws.push_back(model_.parts[k].null ? nullptr : law_of_elements(static_cast<Index>(k)));
    std::vector<bool> by_pressure;
    for (const SolidPart& part : solids_) by_pressure.push_back(part.pressure != nullptr || part.nodal);
    ElementOptions options{mass_scaling_of(deck_), failure_rules(deck_, model_, laws, diagnostics),
                           stiffness_damping(deck_, model_, laws, by_pressure, diagnostics),
                           has_cross_sections(deck_)};
    add_solid_passes(model_, solids_, node_of, options, world_);
    add_shell_passes(model_, shells_, node_of, options, world_);
    build_beams(model_, beams_, node_of, world_, diagnostics);
    add_beam_passes(model_, beams_, options, world_);
    build_cables(model_, cables, node_of, options, world_);
    build_discrete_beams(model_, discrete_beams, node_of, options, world_, diagnostics);
    springs_ = build_discrete(deck_, model_, node_of, world_, diagnostics);
    add_inner_faces(options.eroding);
    add_erosion(model_, std::move(options.eroding), world_);
  }
  bodies_ = build_rigid_bodies(deck_, model_, world_, diagnostics);
  if (bodies_) take_back_added_mass(bodies_->unweighed_nodes(), world_);
  if (diagnostics.ok()) {
    report_mass_scaling(deck_, model_, world_, diagnostics);
    report_weld_scaling(model_, beams_, world_, diagnostics);
  }
  if (bodies_) rules_.share = bodies_->step_share();
  add_rotary_inertias(deck_, model_, world_, diagnostics);
  start_rotations(model_, node_of, world_);
  if (diagnostics.ok()) add_tied_contacts(diagnostics);
  read_supported_walls(deck_, model_, world_, sph_, diagnostics);
  read_turbulence(deck_, model_, world_, sph_, diagnostics);
}

void Simulation::add_tied_contacts(Diagnostics& diagnostics) {
  TiedOptions options;
  options.bulk_modulus = [this](Index part) { return bulk_modulus(part); };
  if (bodies_) {
    options.bodies = bodies_->wall_bodies(world_);
    options.give_body = [this](Index node, const Vec& place, Real mass, Real inertia) {
      return bodies_->add_mass_at(node, place, mass, inertia, world_);
    };
  }
  options.tssfac = model_.tssfac;
  const MassScaling scaling = mass_scaling_of(deck_);
  options.mass_grows = scaling.step > 0 && !scaling.once;
  rules_.share *= courant::add_tied_contacts(deck_, model_, options, world_, diagnostics);
  add_interpolations(deck_, model_, options.mass_grows, world_, diagnostics);
}

// Of solids that may fail, where a contact is to go on with what deletion lays bare.
void Simulation::add_inner_faces(const std::vector<std::shared_ptr<Erosion>>& eroding) {
  const std::vector<ContactCard> contacts(deck_.all<ContactCard>());
  if (std::none_of(contacts.begin(), contacts.end(),
                   [](const ContactCard& c) { return kind_of(c).eroding && c.erosop == 1; }))
    return;
  for (const auto& group : eroding)
    if (!group->group().segment && group->group().corners() > 2)
      add_skin(world_, {group->group().part, bulk_modulus(group->group().part), true});
}

void Simulation::add_passes(Diagnostics& diagnostics) {
  nodal_loads_ = nodal_loads(deck_, model_, world_, diagnostics);
  damping_ = damping_of(deck_, model_, world_, diagnostics);
  check_gravity_of_parts(deck_, model_, world_, diagnostics);
  const bool particles = world_.particles.size() > 0;
  if (particles)
    add_neighbours(diagnostics);
  else
    report_what_needs_particles(diagnostics);
  add_prescribed_motions(diagnostics);
  if (!add_rigid_walls(deck_, model_, wall_penalty(), world_, diagnostics))
    left_out_.push_back({"rigid walls", "no *RIGIDWALL"});
  else if (sph_.xsph > 0 || sph_.velocity_smoothing > 0 || sph_.shift.strength > 0)
    diagnostics.warning({deck_.files[0].name},
                        "rigid walls stop the velocity of particles, not what shifting or averaged "
                        "velocities move them by: they may get a little behind a wall",
                        "use neither, or plates with *CONTACT as walls");
  if (particles) add_particle_passes(diagnostics);
  if (!diagnostics.ok()) return;
  add_node_passes(diagnostics);
  if (diagnostics.ok()) check_sensors(deck_, world_, diagnostics);
  if (diagnostics.ok()) check_switches(deck_, world_, diagnostics);
  if (!diagnostics.ok()) return;
  rules_.dtinit = model_.dtinit;
  if (model_.dt_max_given) rules_.dt_max = model_.dt_max;
  rules_.dtmin = model_.dtmin;
  rules_.tssfac = model_.tssfac;
  rules_.guard = guard_ = std::make_shared<Guard>(reference_of_parts(), model_.endeng, rest_energy());
  stepper_ = std::make_unique<Stepper>(world_, neighbours_.get(), rules_, timer_);
}

void Simulation::report_what_needs_particles(Diagnostics& diagnostics) {
  left_out_.push_back({"particles", "no *ELEMENT_SPH"});
  for (const auto& [name, use] : deck_.keywords) {
    if (use.treatment != Treatment::honoured || name == "COURANT_OUTPUT") continue;
    for (const char* begin : {"COURANT_", "BOUNDARY_SPH_", "DEFINE_SPH_"})
      if (name.starts_with(begin))
        diagnostics.warning({deck_.files[0].name},
                            fmt::format("*{} does nothing: the deck has no particles", name),
                            "leave it out, or give the deck particles");
  }
  const FieldRequests& wanted = model_.output.fields;
  if (!wanted.fields.empty())
    deck_.warning(diagnostics, wanted.card, "FIELDS",
                  "chooses arrays of particles, of which the deck has none");
}

// Rotations of nodes of shells obey the same equation as places.
void Simulation::add_rotations() {
  const Points rotations = rotations_of(world_.nodes);
  if (const auto loads = make_nodal_loads(nodal_loads_, model_, rotations, world_)) world_.passes.add(loads);
  for (const auto& pass : {make_fixed_points(model_, rotations, world_, measures_supports(deck_)),
                           make_damping(damping_, rotations, world_)})
    if (pass) world_.passes.add(pass);
  if (model_.phase == RunPhase::relaxation)
    world_.passes.add(make_slow_points(rotations, relaxation_.factor));
  world_.passes.add(make_point_motion(rotations));
  world_.passes.add(make_kinetic_energy(rotations));
}

// For contact, times SSF of *PART_CONTACT; solids without a law have been reported.
Real Simulation::bulk_modulus(Index part) const {
  const Real scale = model_.parts[static_cast<std::size_t>(part)].ssf;
  if (const SolidPart& solids = solids_[static_cast<std::size_t>(part)]; solids.law)
    return scale * solids.bulk_modulus();
  const auto &own = law_of_elements(part), &law = own ? own : materials_[part].strength;
  if (law) return scale * law->bulk_modulus();
  const auto rigid = rigid_material(deck_, model_, part);
  return rigid ? scale * rigid->E / (3 * (1 - 2 * rigid->pr)) : 0;
}

// The same for everything that moves.
void Simulation::add_loads(const Points& points, const BodyAcceleration& acceleration) {
  const std::string& set = points.fields().name();
  const auto add = [&](const std::shared_ptr<BlockPass>& pass, const char* what, const char* keyword) {
    if (pass)
      world_.passes.add(pass);
    else
      left_out_.push_back({fmt::format("{} on {}", what, set), fmt::format("no {}", keyword)});
  };
  const bool particles = points.set == &world_.particles.fields;
  add(model_.body_loads.empty()
          ? nullptr
          : make_body_load(acceleration, points, world_, particles ? neighbours_ : nullptr),
      "body loads", "*LOAD_BODY, *LOAD_GRAVITY_PART");
  add(make_nodal_loads(nodal_loads_, model_, points, world_), "nodal forces", "*LOAD_NODE");
  add(make_fixed_points(model_, points, world_, measures_supports(deck_)), "SPC", "*BOUNDARY_SPC");
  add(make_damping(damping_, points, world_), "damping", "*DAMPING");
  if (model_.phase == RunPhase::relaxation) world_.passes.add(make_slow_points(points, relaxation_.factor));
}

void Simulation::add_neighbours(Diagnostics& diagnostics) {
  const Real h = maximum(world_.particles.size(), [&](Index i) { return world_.particles.h[i]; });
  neighbours_ = std::make_shared<Neighbours>(first_skin * h, sph_.region, kernel_support(sph_.kernel));
  neighbours_->adapt_skin(least_skin * h, most_skin * h,
                          sph_.geometry_eps > 0 ? skin_weight_of_windows : skin_weight);
  if (!sph_.evolving_h) neighbours_->keep_h();
  make_injected_wait(injections_, world_, *neighbours_);
  if (injections_.inlets.empty()) left_out_.push_back({"inlets", "no *DEFINE_SPH_INJECTION"});
  add_ghosts(h, diagnostics);
}

void Simulation::add_particle_passes(Diagnostics& diagnostics) {
  if (diagnostics.ok()) set_initial_pressures(deck_, model_, materials_, world_, diagnostics);
  if (diagnostics.ok()) set_inlet_pressures(injections_, deck_, model_, materials_, world_, diagnostics);
  if (diagnostics.ok()) add_equations_of_state(world_, model_, materials_, sph_);
  contacts_ = build_contacts(deck_, model_,
                             {.skip_inactive = sph_.skip_inactive_contact,
                              .thickness_from_volume = sph_.thickness_from_volume,
                              .bulk_modulus = [this](Index part) { return bulk_modulus(part); },
                              .bodies = bodies_ ? bodies_->wall_bodies(world_) : WallBodies{},
                              .reach_margin = neighbours_->largest_skin(),
                              .tssfac = model_.tssfac},
                             world_, diagnostics);
  if (!diagnostics.ok()) return;
  world_.passes.add(make_clear_forces(points_of(world_.particles)));
  world_.passes.add(make_point_motion(points_of(world_.particles)));
  world_.passes.add(make_kinetic_energy(points_of(world_.particles)));
  add_drifts(sph_, acceleration_of_particles(model_), world_);
  if (mirrors_) world_.passes.add(mirrors_);
  add_sph_time_limit(sph_, model_, world_);
  for (PassNote& note : add_sph_passes(world_, sph_, neighbours_)) left_out_.push_back(std::move(note));
  add_mirror_core(sph_, planes_, world_);
  add_loads(points_of(world_.particles), acceleration_of_particles(model_));
  if (!add_level_outlets(deck_, model_, sph_, planes_, world_, diagnostics))
    left_out_.push_back({"level outlet", "no *COURANT_LEVEL_OUTLET"});
  if (!add_frozen_outlets(deck_, model_, sph_, materials_, neighbours_, world_, diagnostics))
    left_out_.push_back({"frozen outlets", "no *COURANT_FROZEN_OUTLET"});
  for (auto& contact : contacts_) add_contact(world_, contact);
  if (contacts_.empty()) left_out_.push_back({"contact", "no *CONTACT"});
  check_field_names(deck_, model_.output.fields, world_, diagnostics);
}

// Before the first step, so that c0 is that of the material at rest.
Ranges Simulation::reference_of_parts() const {
  Ranges out(model_.parts.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].part = model_.parts[k].id;
    const PartMaterial& m = materials_[k];
    if (!m.found) continue;
    out[k].rho0 = m.ro;
    out[k].c0 = m.c0();
    // a gas has no pressure without heat; solids have a law of strength
    out[k].liquid = m.holds_cold() && m.starts_at_rest() && !m.strength;
  }
  return out;
}

// Sum of m c^2: far above all energies of a scene, and known before anything moves.
Real Simulation::rest_energy() const {
  const Particles& p = world_.particles;
  Real e = sum(p.size(), [&](Index i) {  // of inlets none, as their particles are made up to ENDTIM
    return p.state[i] == particle_waiting ? Real(0) : p.m[i] * std::pow(materials_[p.part[i]].c0(), 2);
  });
  for (const auto& group : world_.groups) {
    const Real c = sound_speed_of_elements(group->part);
    e += c * c * sum(group->size(), [&](Index k) { return group->mass[k]; });
  }
  return bodies_ ? e + bodies_->rest_energy() : e;
}

std::string Simulation::why_not_until(Real end) const {
  for (const auto& [id, curve] : model_.curves)
    if (end > model_.endtim && curve.by_formula)
      return fmt::format(
          "curve {} is a formula that was taken until ENDTIM = {:g} only: give the later end as "
          "ENDTIM",
          id, model_.endtim);
  for (const Injection& inlet : injections_.inlets)
    if (end > model_.endtim && inlet.end > model_.endtim)
      return fmt::format(
          "the particles of {} ({}) last until ENDTIM = {:g} only: give the later end as ENDTIM",
          deck_.keyword(inlet.card), deck_.place(inlet.card), model_.endtim);
  return "";
}

void Simulation::add_ghosts(Real h, Diagnostics& diagnostics) {
  const Real reach = neighbours_->support() * h + neighbours_->largest_skin();
  planes_ = build_ghost_planes(deck_, model_, sph_, reach, world_, diagnostics);
  if (planes_.empty())
    return left_out_.push_back(
        {"ghost particles", "no *BOUNDARY_SPH_SYMMETRY_PLANE, no *BOUNDARY_SPH_PERIODIC"});
  for (const GhostPlane& plane : planes_) {
    if (plane.kind != GhostPlane::Kind::periodic) continue;
    sph_.loads = sph_.loads.without(plane.normal);  // along a period nothing rests on anything
    check_body_loads_periodic(deck_, plane.normal, diagnostics);
  }
  for (const GhostPlane& plane : planes_)
    if (plane.kind == GhostPlane::Kind::mirror) sph_.mirrors.push_back(plane);
  sph_.walls.planes = planes_;
  auto ghosts = std::make_shared<GhostParticles>(planes_);
  neighbours_->set_ghosts(ghosts);
  world_.passes.add(ghosts);
  mirrors_ = ghosts->make_mirrors(acceleration_of_particles(model_));
}

void Simulation::add_prescribed_motions(Diagnostics& diagnostics) {
  const auto motions = prescribed_motions(deck_, model_, diagnostics, relaxation_.asked);
  if (motions.empty()) left_out_.push_back({"prescribed motion", "no *BOUNDARY_PRESCRIBED_MOTION"});
  MotionLimits limits{.dim = sph_.dim, .boxed = sph_.region.has_value()};
  for (const GhostPlane& plane : planes_)
    if (plane.kind == GhostPlane::Kind::mirror) limits.mirrors.push_back(plane.normal);
  add_prescribed_points(motions, deck_, model_, limits, world_, diagnostics);
  RigidBodies none({});
  (bodies_ ? *bodies_ : none).follow(motions, deck_, model_, diagnostics);
}

void Simulation::add_bodies() {
  if (!bodies_ || !bodies_->any_moves()) {
    left_out_.push_back({"rigid bodies", bodies_ ? "all are held in every direction" : "no *MAT_RIGID"});
    return;
  }
  bodies_->set_loads(BodyAcceleration(model_.body_loads));
  add_body_passes(world_, bodies_);
}

void Simulation::step(const AtTimeLevel& at_time_level) {
  stepper_->step(clock_, at_time_level);
}

void Simulation::evaluate(std::string& dt_controlled_by) {
  stepper_->evaluate(clock_, dt_controlled_by);
}

std::vector<PassNote> Simulation::outputs(bool wanted) const {
  const OutputRequests& out = model_.output;
  const std::pair<PassNote, bool> all[] = {
      {{"field states", "no *DATABASE_BINARY_D3PLOT"}, out.d3plot.asked() || out.d3plot_count > 0},
      {{"glstat", "no *DATABASE_GLSTAT"}, out.glstat.asked()},
      {{"matsum", "no *DATABASE_MATSUM"}, out.matsum.asked()},
      {{"rcforc", "no *DATABASE_RCFORC"}, out.rcforc.asked()},
      {{"sleout", "no *DATABASE_SLEOUT"}, out.sleout.asked()},
      {{"sphout", "no *DATABASE_SPHOUT"}, out.sphout.asked()},
      {{"nodout", "no *DATABASE_NODOUT"}, out.nodout.asked()},
      {{"rbdout", "no *DATABASE_RBDOUT"}, out.rbdout.asked()},
      {{"bndout", "no *DATABASE_BNDOUT"}, out.bndout.asked()},
      {{"spcforc", "no *DATABASE_SPCFORC"}, out.spcforc.asked()},
      {{"rwforc", "no *DATABASE_RWFORC"}, out.rwforc.asked()},
  };
  std::vector<PassNote> notes;
  for (const auto& [note, on] : all)
    if (on == wanted) notes.push_back(note);
  return notes;
}

std::string Simulation::passes() const {
  std::string text = "a step, by stages: phase, pass, the set it runs over\n" + stepper_->stages();
  const auto list = [&](const char* kind, const auto& passes) {
    for (const auto* pass : passes) text += fmt::format("  {:<13}{}\n", kind, pass->name());
  };
  list("exchange", world_.passes.all<Exchanger>());
  list("time limit", world_.passes.all<TimeLimit>());
  list("impact", world_.passes.all<Impact>());
  list("energy", world_.passes.all<EnergyTerm>());
  text += fmt::format("  {:<13}every {} steps\n", "guard", Guard::interval);
  for (const PassNote& output : outputs(true)) text += fmt::format("  {:<13}{}\n", "output", output.name);
  text += injections_text(injections_, model_);
  text += "not needed by this deck:\n";
  for (const PassNote& note : left_out_) text += fmt::format("  {:<28}{}\n", note.name, note.reason);
  for (const PassNote& note : outputs(false)) text += fmt::format("  {:<28}{}\n", note.name, note.reason);
  return text;
}

std::string Simulation::passes_in_short() const {
  std::istringstream lines(stepper_->stages());
  int active = 0;
  for (std::string line; std::getline(lines, line);)  // a pass is four columns in, no "-- threads wait"
    active += line.rfind("    ", 0) == 0 && line[4] != '-';
  return fmt::format("{} passes make a step, {} outputs are asked for, {} of both are left out", active,
                     outputs(true).size(), left_out_.size() + outputs(false).size());
}

}  // namespace courant
