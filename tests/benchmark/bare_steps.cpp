#include "bare_steps.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "loads/point_motion.hpp"
#include "model/build_model.hpp"
#include "sph/core/pair_passes.hpp"
#include "sph/materials/materials.hpp"
#include "sph/skin.hpp"

namespace courant::benchmarks {

namespace {

ReadOptions reader_of(const std::string& text) {
  return {.parameters = {}, .open = [text](const std::string& path) {
            return path == "square.k" ? std::optional(text) : std::nullopt;
          }};
}

void stop_for(const Diagnostics& diagnostics) {
  if (!diagnostics.ok()) throw std::runtime_error(diagnostics.text());
}

}  // namespace

std::string SquareOfWater::deck() const {
  const Real dx = 1.0 / n;
  std::string nodes, particles;
  for (int k = 0; k < n * n; ++k) {
    nodes += fmt::format("{},{:.10f},{:.10f},0.\n", k + 1, (k % n + 0.5) * dx, (k / n + 0.5) * dx);
    particles += fmt::format("{},1,{:.10f}\n", k + 1, 1000 * dx * dx);
  }
  return "*KEYWORD\n*NODE\n" + nodes + "*ELEMENT_SPH\n" + particles +
         "*PART\nwater\n1,1,1,1,1\n*SECTION_SPH\n1,1.2," + h_bounds + "\n*MAT_NULL\n1,1000.,-1.E20," + mu +
         "\n*EOS_LINEAR_POLYNOMIAL\n1,0.,2.5E6,0.,0.," + c4 +
         "\n*HOURGLASS\n1,0,0,0,1.E-20,0.1\n*CONTROL_SPH\n" +
         fmt::format("1,{},1.E20,2,150,0,0.,{}\n0,0,0,0,0,0,{}\n", box, maxv, iavis) +
         "*CONTROL_TERMINATION\n1.E6\n*INITIAL_VELOCITY\n0\n1.,0.,0.\n" + keywords + "*END\n";
}

std::unique_ptr<Simulation> build(const SquareOfWater& water) {
  Diagnostics diagnostics;
  auto s = Simulation::build("square.k", reader_of(water.deck()), diagnostics);
  stop_for(diagnostics);
  return s;
}

BareSteps::BareSteps(const SquareOfWater& water, bool ledger) {
  Diagnostics diagnostics;
  const Deck deck = read_deck("square.k", reader_of(water.deck()), diagnostics);
  const Model model = build_model(deck, diagnostics);
  const auto materials = find_materials(deck, model, diagnostics);
  stop_for(diagnostics);
  const auto material = [&](Index part) { return materials[part].for_particles(); };
  const SphSettings settings = build_particles(deck, model, material, world_, diagnostics);
  stop_for(diagnostics);
  const Real h = world_.particles.h[0];
  neighbours_ = std::make_shared<Neighbours>(first_skin * h, settings.region);
  neighbours_->adapt_skin(least_skin * h, most_skin * h, skin_weight);
  if (!settings.evolving_h) neighbours_->keep_h();
  add_equations_of_state(world_, model, materials, settings);
  world_.passes.add(make_clear_forces(points_of(world_.particles)));
  world_.passes.add(make_point_motion(points_of(world_.particles)));
  world_.passes.add(make_kinetic_energy(points_of(world_.particles)));
  add_sph_time_limit(settings, model, world_);
  const auto geometry = std::make_shared<PairGeometry>(neighbours_, settings.uniform_h);
  const auto volumes = make_pair_volumes(world_);
  const PairPasses pairs = make_plain_passes(settings, world_, geometry, volumes);
  for (const auto& pass : pairs.rates) world_.passes.add(pass);
  for (const auto& pass : pairs.forces) world_.passes.add(pass);
  if (ledger) world_.passes.add(make_sph_energy(settings, world_, neighbours_));
  stepper_ = std::make_unique<Stepper>(world_, neighbours_.get(), StepRules{}, timer_);
}

double BareSteps::take(int steps) {
  double done = 0;
  for (int k = 0; k < steps; ++k) {
    stepper_->step(clock_, [](World&, const Clock&, const std::string&) {});
    done += world_.particles.active;
  }
  return done;
}

}  // namespace courant::benchmarks
