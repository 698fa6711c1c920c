// *BOUNDARY_PRESCRIBED_MOTION in whole runs: places, energy, threads.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "../../generate_deck.hpp"
#include "app/run/simulation.hpp"
#include "parallel/parallel.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

const char* water = R"(title: driven
parts:
  - id: 1
    title: water
    section: 1
    material: 1
    eos: 1
    lattices:
      - {low: [0, 0], high: [0.8, 0.8], spacing: 0.1}
)";
const char* plate = R"(  - id: 2
    title: piston
    section: 2
    material: 2
    merge: true
    plates:
      - {origin: [-0.06, -0.1, -0.5], edge1: [0, 1, 0], edge2: [0, 0, 1], mesh: 1}
)";
const char* cards = R"(keywords: |
  *CONTROL_TERMINATION
  1.0
  *CONTROL_SPH
  1,0,1.0e20,2
  *CONTROL_TIMESTEP
  0,0.05
  *SECTION_SPH
  1,1.2,1.0,1.0
  *MAT_NULL
  1,1000.0,-1.0e20
  *EOS_LINEAR_POLYNOMIAL
  1,0.0,4.0e5
  *DEFINE_CURVE
  7
  0.0,0.0
  0.01,1.0
  0.03,-1.0
  0.06,-1.0
)";
const char* piston = R"(  *SECTION_SHELL
  2,2
  0.1
  *MAT_RIGID
  2,1000.0,2.1e11,0.3
  1,5,7
  *CONTACT_AUTOMATIC_NODES_TO_SURFACE
  1,2,3,3
  0.0
  10.0,10.0
)";

std::unique_ptr<Simulation> built(const std::string& scene) {
  const fs::path base = fs::temp_directory_path() / ("courant_driven_" + std::to_string(::getpid()));
  std::ofstream(base.string() + ".yaml") << scene;
  Diagnostics diagnostics;
  EXPECT_TRUE(test::generate_deck(base.string() + ".yaml", base.string() + ".k", {}, diagnostics))
      << diagnostics.text();
  auto s = Simulation::build(base.string() + ".k", {}, diagnostics);
  EXPECT_TRUE(s) << diagnostics.text();
  for (const char* end : {".k", ".yaml"}) fs::remove(base.string() + end);
  std::string who;
  s->evaluate(who);
  sample_energy(s->world(), s->clock());
  s->world().energy.initial = s->world().energy.total();
  return s;
}

/// The ledger at the last time level before the end.
EnergyLedger last_ledger(Simulation& s, Real until) {
  EnergyLedger last;
  while (s.clock().t < until)
    s.step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      last = world.energy;
    });
  return last;
}

Vec place(const Simulation& s, Id id) {
  const Particles& p = s.world().particles;
  for (Index i = 0; i < p.size(); ++i)
    if (p.id[i] == id) return p.x.vec(i);
  return Vec::Constant(NAN);
}

/// Integral of curve 7: up to t = 0.01 by 50 t^2, then down through 0 at t = 0.02.
Real integral_of_curve(Real t) {
  if (t < 0.01) return 50 * t * t;
  const Real s = std::min(t, 0.03) - 0.01;
  return 0.005 + s - 50 * s * s - std::max(t - 0.03, 0.0);
}

TEST(PrescribedParticles, StandWhereTheIntegralOfTheirCurveSays) {
  const auto s = built(std::string(water) + cards + R"(  *SET_NODE_LIST
  5
  1,2,3,4,5,6,7,8
  *BOUNDARY_PRESCRIBED_MOTION_SET
  5,1,0,7,2.0
  5,2,2,7,0.01
  *DEFINE_VECTOR
  3,0.0,0.0,0.0,3.0,4.0,0.0
  *BOUNDARY_PRESCRIBED_MOTION_NODE
  64,4,1,7,1.0,3
)");
  const Vec corner = place(*s, 1), other = place(*s, 64);
  EnergyLedger e;
  for (const Real until : {0.005, 0.02, 0.05}) {
    e = last_ledger(*s, until);
    const Real t = s->clock().t;
    const Vec moved = place(*s, 1) - corner;
    EXPECT_NEAR(moved[0], 2 * integral_of_curve(t), 1e-14);
    const Real ramp = t < 0.01 ? 100 * t : std::max(1 - 100 * (t - 0.01), -1.0);
    EXPECT_NEAR(moved[1], 0.01 * ramp, 1e-14);
    // of the other one, the component along (3, 4, 0) is driven: x = 100 t^3/6 at first
    if (t < 0.01) {
      EXPECT_NEAR((place(*s, 64) - other).dot(Vec(0.6, 0.8, 0)), 100 * t * t * t / 6, 1e-14);
    }
  }
  EXPECT_GT(e.external_work, 1);
  // What is left is half a step between kinetic and internal energy: it falls with TSSFAC, 0.05 here.
  EXPECT_LT(std::abs(e.residual()), 2e-3 * e.throughput);
}

TEST(PrescribedParticles, TakeTheirKineticEnergyFromTheDrive) {
  // all of them alike, so that nothing is compressed: work is kinetic energy, to round-off
  const auto s = built(std::string(water) + cards + R"(  *SET_NODE_LIST_GENERATE
  5
  1,64
  *BOUNDARY_PRESCRIBED_MOTION_SET
  5,1,0,7,2.0
  5,2,1,7,50.0
)");
  const EnergyLedger e = last_ledger(*s, 0.008);
  EXPECT_GT(e.kinetic, 100);
  EXPECT_NEAR(e.external_work, e.kinetic, 1e-9 * e.kinetic);
}

TEST(PrescribedBodies, APistonPushesWaterAndTheLedgerCloses) {
  const auto s = built(std::string(water) + plate + cards + piston + R"(  *DEFINE_CURVE
  8
  0.0,1.0
  *BOUNDARY_PRESCRIBED_MOTION_RIGID
  2,1,0,8,2.0
)");
  const EnergyLedger e = last_ledger(*s, 0.05);
  const RigidBodyReport body = s->bodies()->reports()[0];
  EXPECT_NEAR(body.x[0], -0.06 + 2 * s->clock().t, 1e-14);
  EXPECT_EQ(body.v[0], 2);
  const Particles& p = s->world().particles;
  const Real momentum = sum(p.active, [&](Index i) { return p.m[i] * p.v.vec(i)[0]; });
  EXPECT_GT(momentum, 0.25 * 640 * 2);
  // of the work, what the body took to start (100 kg) and what the water has
  EXPECT_GT(e.external_work, 0.5 * 100 * 4 + 0.5 * momentum * momentum / 640);
  EXPECT_LT(std::abs(e.residual()), 2e-3 * e.throughput);
}

TEST(PrescribedBodies, TurnAndShiftAsTheirCurvesSay) {
  std::string body = piston;
  body.replace(body.find("1,5,7"), 5, "1,3,4");  // free: x and y, rotation about z
  const auto s = built(std::string(water) + plate + cards + body + R"(  *BOUNDARY_PRESCRIBED_MOTION_RIGID
  2,7,0,7,1.0
  2,1,1,7,-10.0
  2,2,2,7,-0.01
)");
  const Nodes& nodes = s->world().nodes;
  const Vec first = nodes.x.vec(0);
  const EnergyLedger e = last_ledger(*s, 0.008);
  const Real t = s->clock().t, angle = integral_of_curve(t);
  const Vec centre(-0.06, 0.4, 0), arm = first - centre;
  const Vec shift(-1000 * t * t * t / 6, -t, 0);
  const Vec turned(std::cos(angle) * arm[0] - std::sin(angle) * arm[1],
                   std::sin(angle) * arm[0] + std::cos(angle) * arm[1], arm[2]);
  EXPECT_NEAR((nodes.x.vec(0) - centre - shift - turned).norm(), 0, 1e-13);
  EXPECT_LT(std::abs(e.residual()), 2e-3 * e.throughput);
}

TEST(PrescribedMotions, HaveTheSameBitsOnAnyNumberOfThreads) {
  std::vector<Real> reference;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    const auto s = built(std::string(water) + plate + cards + piston + R"(  *BOUNDARY_PRESCRIBED_MOTION_RIGID
  2,1,0,7,2.0
  *BOUNDARY_PRESCRIBED_MOTION_NODE
  64,1,1,7,10.0
  60,2,0,7,1.0
)");
    last_ledger(*s, 0.02);
    const Particles& p = s->world().particles;
    std::vector<Real> state{s->clock().t, s->world().energy.total(), s->world().energy.external_work};
    for (const auto* f : {&p.x, &p.v})
      for (int k = 0; k < 3; ++k) state.insert(state.end(), f->data(k), f->data(k) + p.size());
    if (reference.empty()) reference = state;
    EXPECT_TRUE(reference == state) << n << " threads";
  }
  set_threads(0);
}

}  // namespace
}  // namespace courant
