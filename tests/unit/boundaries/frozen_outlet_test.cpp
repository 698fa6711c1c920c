// *COURANT_FROZEN_OUTLET: what it does to what leaves, and only to that.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "../app/small_scene.hpp"
#include "parallel/parallel.hpp"

namespace courant {
namespace {

using test::run;
using test::SmallScene;
using test::steps;

/// The block flies out of a box that ends at `low` and `high` along x.
SmallScene leaving(const std::string& start, const std::string& cards, double low = -9, double high = 0.7) {
  return {
      .start = start,
      .box = "1",
      .extra = fmt::format("*DEFINE_BOX\n1,{},{},-9.,9.,-9.,9.\n", low, high) + test::gravity_cards + cards};
}

struct Left {
  Vec v = Vec::Zero();
  Real y = 0, p = 0, rho = 0;
};
std::map<Id, Left> that_left(Simulation& s, Real t) {
  run(s, t);
  std::map<Id, Left> out;
  const Particles& p = s.world().particles;
  for (Index i = p.active; i < p.size(); ++i)
    out[p.id[i]] = {p.v.vec(i), p.place(i, s.clock().t)[1], p.p[i], p.rho[i]};
  return out;
}

TEST(FrozenOutlet, GivesWhatLeavesTheVelocityAndTheHeadOfTheTailwater) {
  for (const int side : {1, -1}) {
    const SmallScene scene = leaving(fmt::format("{},0.,0.", 3 * side),
                                     fmt::format("*COURANT_FROZEN_OUTLET\n{},0.5,0,0.,0.4,0.\n", side),
                                     side > 0 ? -9 : -0.1, side > 0 ? 0.7 : 9);
    const auto s = test::build(scene);
    ASSERT_TRUE(s);
    const auto left = that_left(*s, 0.15);
    ASSERT_GT(left.size(), 8u);
    int above = 0, below = 0;
    for (const auto& [id, one] : left) {
      EXPECT_EQ(one.v, Vec(0.5 * side, 0, 0)) << id;
      const Real head = std::max(0.0, 9.81 * (0.4 - one.y));
      EXPECT_NEAR(one.p, 1000 * head, 1e-9 * 4000) << id;
      EXPECT_NEAR(9.e5 * (one.rho / 1000 - 1), one.p, 1e-6 * 4000) << id;
      ++(head > 0 ? below : above);
    }
    EXPECT_GT(above, 0);
    EXPECT_GT(below, 0);
  }
}

TEST(FrozenOutlet, FollowsItsCurvesAtTheMomentOfLeaving) {
  const SmallScene scene =
      leaving("3.,0.,0.",
              "*COURANT_FROZEN_OUTLET\n1,0.5,5,0.,0.,0.,6\n*DEFINE_CURVE\n5\n0.,1.\n1.,11.\n"
              "*DEFINE_CURVE\n6\n0.,0.4\n1.,1.4\n");
  const auto s = test::build(scene);
  ASSERT_TRUE(s);
  const auto left = that_left(*s, 0.2);
  ASSERT_GT(left.size(), 12u);
  Real first = 9, last = 0;
  for (const auto& [id, one] : left) {
    const Real t = (one.v[0] / 0.5 - 1) / 10;  // when it left
    first = std::min(first, t), last = std::max(last, t);
    EXPECT_NEAR(one.p, 1000 * std::max(0.0, 9.81 * (0.4 + t - one.y)), 1e-6 * 4000) << id;
  }
  EXPECT_LT(first, 0.1);
  EXPECT_GT(last, first + 0.02);
}

TEST(FrozenOutlet, LeavesOtherFacesAlone) {
  const auto s = test::build(leaving("3.,0.,0.", "*COURANT_FROZEN_OUTLET\n2,0.5,0,0.,0.4,0.\n"));
  ASSERT_TRUE(s);
  const auto left = that_left(*s, 0.15);
  ASSERT_GT(left.size(), 8u);
  for (const auto& [id, one] : left) EXPECT_GT(one.v[0], 2) << id;
}

/// A stream of uniform depth keeps depth and discharge between an inlet under its own head and the outlet.
TEST(FrozenOutlet, StreamStaysAsItIs) {
  constexpr Real dx = 0.05, depth = 8 * dx, v = 1.2, length = 2;
  std::string nodes = "*NODE\n", particles = "*ELEMENT_SPH\n", stress = "*INITIAL_STRESS_SPH\n";
  Id id = 0;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < length / dx; ++i) {
      nodes += fmt::format("{},{},{},0.\n", ++id, (i + 0.5) * dx, (j + 0.5) * dx);
      particles += fmt::format("{},1,{}\n", id, -dx * dx);
      const Real p = 1000 * 9.81 * (depth - (j + 0.5) * dx);
      stress += fmt::format("{},{},{},{}\n", id, -p, -p, -p);
    }
  const std::string deck =
      "*KEYWORD\n" + nodes + particles + stress +
      "*PART\nwater\n1,1,1,1,1\n*SECTION_SPH\n1,1.2,1.,1.\n*MAT_NULL\n1,1000.,-1.E20\n"
      "*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E5\n*HOURGLASS\n1,0,0,0,1.E-20,0.05\n*CONTROL_SPH\n1,1,1.E20,2\n"
      "*CONTROL_TERMINATION\n3.\n*INITIAL_VELOCITY\n0\n1.2,0.,0.\n*DEFINE_BOX\n1,-9.,2.,-9.,9.,-9.,9.\n"
      "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.,0.,0.,0.,1.,0.\n*PART\ninflow\n2,1,1,1,1\n"
      "*DEFINE_SPH_INJECTION_SIMPLIFIED\n2,1.2,0.2,0.05\n0.,0.2,0.,1.,0.,0.\n*COURANT_INFLOW\n2,1\n"
      "*COURANT_FROZEN_OUTLET\n1,1.2,0,0.,0.4,0.\n*COURANT_DENSITY_DIFFUSION\n0.1\n" +
      test::gravity_cards + "*END\n";
  const auto s = test::build_deck(deck, false);
  ASSERT_TRUE(s);
  Real lowest = 9, highest = 0;
  for (const Real t : {1.5, 2.0, 2.5, 3.0}) {  // the stream went through twice
    run(*s, t);
    const Particles& p = s->world().particles;
    for (const Real from : {0.1, 0.5, 1.0, 1.5}) {
      Real volume = 0;
      for (Index i = 0; i < p.active; ++i) {
        const Real x = p.x.vec(i)[0];
        if (x > from && x < from + 0.4) volume += p.m[i] / p.rho[i];
      }
      lowest = std::min(lowest, volume / 0.4), highest = std::max(highest, volume / 0.4);
    }
    Real flow = 0, volume = 0;
    for (Index i = 0; i < p.active; ++i)
      volume += p.m[i] / p.rho[i], flow += p.m[i] / p.rho[i] * p.v.vec(i)[0];
    EXPECT_NEAR(flow / volume, v, 0.02 * v);
  }
  EXPECT_GT(lowest, 0.96 * depth);
  EXPECT_LT(highest, 1.04 * depth);
}

TEST(FrozenOutlet, SameBitsOnAnyNumberOfThreads) {
  const SmallScene scene = leaving("3.,0.,0.", "*COURANT_FROZEN_OUTLET\n1,0.5,0,0.,0.4,0.\n");
  std::map<Id, Left> first;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    const auto s = test::build(scene);
    const auto left = that_left(*s, 0.1);
    if (first.empty()) first = left;
    ASSERT_EQ(first.size(), left.size());
    for (const auto& [id, one] : left)
      EXPECT_TRUE(one.v == first[id].v && one.p == first[id].p && one.y == first[id].y);
  }
  set_threads(0);
}

}  // namespace
}  // namespace courant
