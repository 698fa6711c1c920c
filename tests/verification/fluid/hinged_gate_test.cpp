// Water behind a rigid gate on a revolute joint with a spring: tests/verification/scenes/hinged_gate.yaml.
#include <cmath>
#include <cstdio>

#include "same_bits.hpp"
#include "scenes.hpp"
#include "shell_decks.hpp"

using namespace courant;

namespace hinged_gate_test {
namespace {

constexpr Real rho = 1000, g = 9.81, depth = 0.2, width = 0.3, reach = 0.24, mass = 2, stiffness = 654;

template <class F>
Real root(const F& f, Real a, Real b) {
  const bool sign = f(a) > 0;
  for (int k = 0; k < 100; ++k) {
    const Real c = 0.5 * (a + b);
    ((f(c) > 0) == sign ? a : b) = c;
  }
  return 0.5 * (a + b);
}

/// Moment of inertia that water adds to a wall hinged at its foot which swings with `omega`: linear waves in
/// a basin, one wave and those that fade, cosh(q y) and cos(q y), with g q tanh(q H) = -g q tan(q H) =
/// omega^2.
Real added_inertia(Real omega) {
  const Real nu = omega * omega / g, H = depth;
  Real q = root([&](Real k) { return k * std::tanh(k * H) - nu; }, 1e-9, 10 * nu + 100);
  const Real norm = 0.5 * H + std::sinh(2 * q * H) / (4 * q),
             lever = H * std::sinh(q * H) / q - (std::cosh(q * H) - 1) / (q * q);
  Real sum = -rho * lever * lever / norm / (std::tan(q * width) * q);
  for (int n = 1; n < 500; ++n) {
    q = root([&](Real k) { return k * std::tan(k * H) + nu; }, ((n - 0.5) * pi + 1e-9) / H, n * pi / H);
    const Real size = 0.5 * H + std::sin(2 * q * H) / (4 * q),
               arm = H * std::sin(q * H) / q + (std::cos(q * H) - 1) / (q * q);
    sum += rho * arm * arm / size / (std::tanh(q * width) * q);
  }
  return sum;
}

Real period() {
  const Real own = mass * reach * reach / 3;
  const Real omega = root(
      [&](Real w) { return stiffness - 0.5 * mass * g * reach - w * w * (own + added_inertia(w)); }, 50, 70);
  return 2 * pi / omega;
}

/// k angle = rho g h^3/6 and the weight of the gate; the level falls as it opens.
Real angle_at_rest() {
  Real angle = 0;
  for (int k = 0; k < 50; ++k) {
    const Real h = depth - angle * depth * depth / (2 * width);
    angle = (rho * g * h * h * h / 6 + 0.5 * mass * g * reach * std::sin(angle)) / stiffness;
  }
  return angle;
}

Real angle(const Simulation& s) {
  const Matrix R = s.bodies()->bodies().back().q.toRotationMatrix();
  return -std::atan2(R(1, 0), R(0, 0));
}

}  // namespace

TEST(HingedGate, OpensUntilItsSpringBearsTheWater) {
  const struct {
    const char* n;
    Real bound;
  } cases[] = {{"10", 0.05}, {"20", 0.03}};
  for (const auto& one : cases) {
    const auto s = test::simulation_of(
        test::deck_of_scene("hinged_gate", {{"n", one.n}, {"damper", "10"}, {"endtim", "1.4"}}));
    Real sum = 0, time = 0;
    while (s->clock().t < 1.4) {
      s->step(test::do_nothing);
      if (s->clock().t < 0.75) continue;  // the longest wave of the basin takes 0.64 s
      sum += s->clock().dt_old * angle(*s), time += s->clock().dt_old;
    }
    std::printf("%s: angle %.4f of hydrostatics\n", one.n, sum / time / angle_at_rest());
    EXPECT_NEAR(sum / time / angle_at_rest(), 1, one.bound) << one.n;
    EXPECT_EQ(s->world().counters.at("leaked_particles"), 0);
  }
}

TEST(HingedGate, SwingsWithTheWaterThatGoesWithIt) {
  const struct {
    const char* n;
    Real bound;
  } cases[] = {{"10", 0.06}, {"20", 0.03}};
  for (const auto& one : cases) {
    const auto s = test::simulation_of(test::deck_of_scene("hinged_gate", {{"n", one.n}}));
    test::start_ledger(*s);
    std::vector<Real> up;
    Real before = -angle_at_rest();
    while (s->clock().t < 0.5) {
      const Real t = s->clock().t;
      s->step(test::do_nothing);
      const Real now = angle(*s) - angle_at_rest();
      if (before <= 0 && now > 0) up.push_back(t - (s->clock().t - t) * before / (now - before));
      before = now;
    }
    ASSERT_GE(up.size(), 4u);
    const Real measured = (up.back() - up.front()) / static_cast<Real>(up.size() - 1);
    const Real error = test::energy_error_of_a_step(*s);
    std::printf("%s: period %.4f of linear waves'; energy %.1e\n", one.n, measured / period(), error);
    EXPECT_NEAR(measured / period(), 1, one.bound) << one.n;
    EXPECT_LT(error, 0.01);
  }
}

TEST(HingedGate, SameBitsOnThreadsAndAfterARestart) {
  test::expect_same_bits(test::deck_of_scene("hinged_gate", {{"n", "10"}}), 60, 25);
}

}  // namespace hinged_gate_test
