// Walls without slip and moving surfaces (LAW 2 of *COURANT_WALL_SUPPORT, *COURANT_WALL_BELT): what water and
// walls give each other, energy, bits.
#include <cmath>

#include "rigid/bodies/rigid.hpp"
#include "same_bits.hpp"
#include "scenes.hpp"

using namespace courant;

namespace wall_drag_test {
namespace {

using Parameters = std::map<std::string, std::string>;

/// Without what drives its walls.
std::string let_go(std::string text) {
  const auto from = text.find("*INITIAL_VELOCITY_RIGID"), to = text.find("*SECTION_SHELL");
  return text.erase(from, to - from);
}
std::unique_ptr<Simulation> begun(const std::string& text) {
  auto s = test::simulation_of(text);
  if (!s) return s;
  std::string who;
  s->evaluate(who);
  return s;
}
Vec momentum_of(const Simulation& s) {
  const Particles& p = s.world().particles;
  Vec sum = Vec::Zero();
  for (Index i = 0; i < p.active; ++i) sum += p.m[i] * p.v.vec(i);
  for (const RigidBody& b : s.bodies()->bodies()) sum += b.m * b.v;
  return sum;
}

/// Water that flows in a box which is free to go along: what it loses the walls get.
void expect_kept(const std::string& text, Real until) {
  const auto s = begun(text);
  ASSERT_TRUE(s);
  Particles& p = s->world().particles;
  Real size = 0;
  for (Index i = 0; i < p.size(); ++i) {
    const Vec x = p.x.vec(i);
    p.v.set(i, Vec(0.5 + 4 * (x[1] - 0.08), -4 * (x[0] - 0.1), 0));
    size += p.m[i] * p.v.vec(i).norm();
  }
  test::start_ledger(*s);
  const Vec before = momentum_of(*s);
  const Real energy = s->world().energy.total();
  while (s->clock().t < until) s->step(test::do_nothing);
  sample_energy(s->world(), s->clock());
  const Real residual = s->world().energy.residual() / energy;
  std::printf("lost %.1e, energy %.1e\n", (momentum_of(*s) - before).norm() / size, residual);
  EXPECT_LT((momentum_of(*s) - before).norm(), 1e-12 * size);
  EXPECT_LT(std::abs(residual), 0.01);
  EXPECT_GT(s->bodies()->bodies().back().v.norm(), 0.005);
}

}  // namespace

TEST(WallDrag, LosesNothingBetweenWaterAndBodies) {
  const Parameters free_box{{"lid", "0"}, {"n", "8"}, {"ro", "2000"}, {"law", "2"}, {"mu", "5"}, {"q1", "0"}};
  Parameters integrals = free_box;
  integrals["method"] = "0", integrals["thick"] = "0.9999";
  expect_kept(let_go(test::deck_of_scene("carried_box", free_box)), 0.05);
  expect_kept(let_go(test::deck_of_scene("carried_box", integrals)), 0.05);
  // corners of two bodies, which move against each other
  expect_kept(test::deck_of_scene("piston_box", {{"law", "2"}, {"mu", "5"}, {"q1", "0"}}), 0.02);
}

// Water that turns with its box goes on so.
TEST(WallDrag, LeavesWaterThatTurnsWithItsBoxAlone) {
  const auto s =
      begun(test::deck_of_scene("carried_box", {{"n", "8"}, {"omega", "6"}, {"law", "2"}, {"mu", "20"}}));
  ASSERT_TRUE(s);
  while (s->clock().t < 0.05) s->step(test::do_nothing);
  const Particles& p = s->world().particles;
  Real most = 0;
  for (Index i = 0; i < p.active; ++i) {
    const Vec x = p.x.vec(i) - 0.5 * s->clock().dt_old * p.v.vec(i);
    most = std::max(most, (p.v.vec(i) - 6 * Vec(0.08 - x[1], x[0] - 0.12, 0)).norm());
  }
  std::printf("off by %.4f of the corners' speed\n", most / (6 * std::hypot(0.12, 0.08)));
  EXPECT_LT(most, 0.05 * 6 * std::hypot(0.12, 0.08));
}

/// Stress of a moving surface on water at rest below it, over mu v/sqrt(pi nu t) of Stokes' first problem,
/// and the residual of the energy over the moving surface's work.
std::array<Real, 2> stokes(int method, int n) {
  const auto s = begun(test::deck_of_scene(
      "wall_channel",
      {{"force", "0"}, {"belt", "1.0e-5"}, {"method", std::to_string(method)}, {"n", std::to_string(n)}}));
  if (!s) return {};
  test::start_ledger(*s);
  const Real nu = 1e-6, L = 1e-3, wide = 10 * L / n, v = 1e-5;
  while (s->clock().t < 0.02) s->step(test::do_nothing);
  const Real momentum = momentum_of(*s)[0] / wide, t = s->clock().t;
  sample_energy(s->world(), s->clock());
  const EnergyLedger& e = s->world().energy;
  // int of mu v/sqrt(pi nu t) over t
  return {momentum / (2 * 1000 * v * std::sqrt(nu * t / pi)), e.residual() / e.external_work};
}

TEST(WallDrag, DragsWaterAlongAsStokesFirstProblemSays) {
  for (const int method : {0, 1})
    for (const int n : {20, 40}) {
      const auto [impulse, residual] = stokes(method, n);
      std::printf("METHOD %d, %d rows: impulse %.4f, energy %.1e\n", method, n, impulse, residual);
      EXPECT_NEAR(impulse, 1, 0.03);
      EXPECT_LT(std::abs(residual), 0.01);
    }
}

TEST(WallDrag, GivesTheSameBitsOnAnyThreadsAndAfterARestart) {
  for (const char* method : {"0", "1"}) {
    const std::string thick = *method == '0' ? "0.9999" : "0.4";
    test::expect_same_bits(
        test::deck_of_scene("wall_channel", {{"belt", "1.0e-5"}, {"method", method}, {"n", "16"}}), 60, 25);
    test::expect_same_bits(let_go(test::deck_of_scene("carried_box", {{"lid", "0"},
                                                                      {"n", "8"},
                                                                      {"law", "2"},
                                                                      {"mu", "5"},
                                                                      {"v", "0.5"},
                                                                      {"thick", thick},
                                                                      {"method", method}})),
                           30, 12);
  }
}
}  // namespace wall_drag_test
