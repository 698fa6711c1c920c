// Where fixed ghost particles are behind shells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sph/walls/ghosts/ghost_lattice.hpp"

namespace courant {
namespace {

constexpr Real dx = 0.1, reach = 0.4;
using Line = std::pair<Vec, Vec>;

/// Water in a plane and shells, one wide, along lines of it.
class Tank {
 public:
  Tank(const std::vector<Line>& lines, const std::vector<std::pair<Vec, Vec>>& blocks) {
    world_.dim = 2;
    world_.nodes.fields.resize(4 * static_cast<Index>(lines.size()));
    world_.segments.fields.resize(static_cast<Index>(lines.size()));
    for (Index s = 0; s < static_cast<Index>(lines.size()); ++s) {
      const auto& [a, b] = lines[static_cast<std::size_t>(s)];
      const Vec z(0, 0, 0.5);
      const Vec corners[4] = {a - z, b - z, b + z, a + z};
      for (Index e = 0; e < 4; ++e) world_.nodes.x.set(4 * s + e, corners[e]);
      world_.segments.node0[s] = 4 * s, world_.segments.node1[s] = 4 * s + 1;
      world_.segments.node2[s] = 4 * s + 2, world_.segments.node3[s] = 4 * s + 3;
      world_.segments.part[s] = s;
      segments_.push_back(s);
    }
    moves_.assign(lines.size(), 0);
    std::vector<Vec> positions;
    for (const auto& [low, high] : blocks)
      for (Real y = low[1] + dx / 2; y < high[1]; y += dx)
        for (Real x = low[0] + dx / 2; x < high[0]; x += dx) positions.emplace_back(x, y, 0);
    world_.particles.fields.resize(static_cast<Index>(positions.size()));
    for (std::size_t i = 0; i < positions.size(); ++i)
      world_.particles.x.set(static_cast<Index>(i), positions[i]);
  }
  /// These lines are one part that moves.
  Tank& move(const std::vector<Index>& lines) {
    for (const Index s : lines)
      moves_[static_cast<std::size_t>(s)] = 1, world_.segments.part[s] = lines.front();
    return *this;
  }
  /// The scene ends at these planes.
  Tank& between(std::vector<GhostPlane> planes) {
    planes_ = std::move(planes);
    return *this;
  }
  LaidGhosts lay() const {
    return lay_wall_ghosts(world_, segments_, moves_,
                           {2, world_.particles.x.vec(0), dx, reach, Vec(0, 1, 0), planes_});
  }

 private:
  World world_;
  std::vector<Index> segments_;
  std::vector<char> moves_;
  std::vector<GhostPlane> planes_;
};

Vec at(Real x, Real y) {
  return {x, y, 0};
}
/// An open tank of length 1 with walls of height 1.2.
std::vector<Line> open_tank() {
  return {{at(0, 0), at(1, 0)}, {at(0, 0), at(0, 1.2)}, {at(1, 0), at(1, 1.2)}};
}
Index within(const LaidGhosts& laid, const Vec& low, const Vec& high) {
  return static_cast<Index>(std::count_if(laid.ghosts.begin(), laid.ghosts.end(), [&](const WallGhost& g) {
    return (g.x - low).minCoeff() > -1e-9 && (high - g.x).minCoeff() > -1e-9;
  }));
}

TEST(GhostLattice, GoesOnBehindTheWallsOfAnOpenTankAndRoundItsCorners) {
  const LaidGhosts laid = Tank(open_tank(), {{at(0, 0), at(1, 0.6)}}).lay();
  // four rows below the floor, four behind each wall, in each corner 13 points within 0.4 of it
  EXPECT_EQ(laid.ghosts.size(), 10U * 4 + 2 * 12 * 4 + 2 * 13);
  EXPECT_EQ(within(laid, at(0, 0), at(1, 2)), 0);
  EXPECT_EQ(within(laid, at(-2, 1.2), at(3, 3)), 0);
  EXPECT_TRUE(laid.wet_on_both_sides.empty());
  EXPECT_TRUE(laid.dry.empty());
  EXPECT_TRUE(laid.thin.empty());
  for (const WallGhost& g : laid.ghosts) {
    const Real along_x = std::round((g.x[0] - 0.05) / dx), along_y = std::round((g.x[1] - 0.05) / dx);
    EXPECT_NEAR(g.x[0], 0.05 + along_x * dx, 1e-9);
    EXPECT_NEAR(g.x[1], 0.05 + along_y * dx, 1e-9);
  }
}

// The whole scene has a corner at the plane, whose ghosts belong to a shell and to the copy of one.
TEST(GhostLattice, OfHalfASceneIsHalfOfThatOfTheWhole) {
  const Line left{at(0.5, 0), at(-0.5, 1)}, right{at(0.5, 0), at(1.5, 1)};
  const auto wedge = [](Real low, Real high) {
    std::vector<std::pair<Vec, Vec>> blocks;
    for (Real x = low; x < high - 1e-9; x += dx) {
      const Real deep = std::abs(x + dx / 2 - 0.5) + dx / 2;
      blocks.push_back({at(x, std::round(deep / dx) * dx), at(x + dx, 0.8)});
    }
    return blocks;
  };
  const GhostPlane mirror{GhostPlane::Kind::mirror, at(0.5, 0), at(1, 0), 0};
  const LaidGhosts whole = Tank({left, right}, wedge(-0.2, 1.2)).lay();
  const LaidGhosts half = Tank({right}, wedge(0.5, 1.2)).between({mirror}).lay();
  EXPECT_GT(half.ghosts.size(), 30U);
  EXPECT_EQ(2 * half.ghosts.size(), whole.ghosts.size());
  for (const WallGhost& g : half.ghosts) EXPECT_EQ(within(whole, g.x, g.x), 1);
  // shells of the other half do no harm
  EXPECT_EQ(Tank({left, right}, wedge(0.5, 1.2)).between({mirror}).lay().ghosts.size(), half.ghosts.size());
}

TEST(GhostLattice, BetweenPeriodicPlanesHasNoEnds) {
  const GhostPlane periodic{GhostPlane::Kind::periodic, at(0, 0), at(1, 0), 1};
  const LaidGhosts laid = Tank({{at(0, 0), at(1, 0)}}, {{at(0, 0), at(1, 0.6)}}).between({periodic}).lay();
  EXPECT_EQ(laid.ghosts.size(), 10U * 4);
  EXPECT_TRUE(laid.dry.empty());
}

TEST(GhostLattice, LeavesNoRoomInAPlateThatIsWetOnBothSides) {
  auto lines = open_tank();
  lines.emplace_back(at(0.5, 0), at(0.5, 0.3));
  const LaidGhosts laid = Tank(lines, {{at(0, 0), at(1, 0.6)}}).lay();
  ASSERT_EQ(laid.wet_on_both_sides.size(), 1U);
  EXPECT_EQ(laid.wet_on_both_sides[0], 3);
}

TEST(GhostLattice, FillsABodyInTheWaterAndNothingBesideIt) {
  auto lines = open_tank();
  lines.insert(lines.end(), {{at(0.3, 0.2), at(0.7, 0.2)},
                             {at(0.7, 0.2), at(0.7, 0.5)},
                             {at(0.7, 0.5), at(0.3, 0.5)},
                             {at(0.3, 0.5), at(0.3, 0.2)}});
  const std::vector<std::pair<Vec, Vec>> water{{at(0, 0), at(1, 0.2)},
                                               {at(0, 0.2), at(0.3, 0.5)},
                                               {at(0.7, 0.2), at(1, 0.5)},
                                               {at(0, 0.5), at(1, 0.6)}};
  for (const bool moves : {false, true}) {
    Tank tank(lines, water);
    if (moves) tank.move({3, 4, 5, 6});
    const LaidGhosts laid = tank.lay();
    EXPECT_EQ(within(laid, at(0, 0), at(1, 2)), 4 * 3);
    EXPECT_EQ(within(laid, at(0.3, 0.2), at(0.7, 0.5)), 4 * 3);
    EXPECT_TRUE(laid.wet_on_both_sides.empty());
  }
}

// Over its rim, which is above the water, points are wet as air is: they are not before the shells below.
TEST(GhostLattice, KeepsAnOpenHullDry) {
  auto lines = open_tank();
  lines.insert(lines.end(),
               {{at(0.3, 0.2), at(0.7, 0.2)}, {at(0.7, 0.2), at(0.7, 0.9)}, {at(0.3, 0.9), at(0.3, 0.2)}});
  const std::vector<std::pair<Vec, Vec>> water{
      {at(0, 0), at(1, 0.2)}, {at(0, 0.2), at(0.3, 0.5)}, {at(0.7, 0.2), at(1, 0.5)}};
  const LaidGhosts laid = Tank(lines, water).move({3, 4, 5}).lay();
  EXPECT_TRUE(laid.wet_on_both_sides.empty());
  EXPECT_TRUE(laid.dry.empty());
  EXPECT_EQ(within(laid, at(0.3, 0.2), at(0.7, 0.9)), 4 * 7);
}

TEST(GhostLattice, WarnsOfABodyThatIsThinnerThanHalfOfTheReach) {
  auto lines = open_tank();
  lines.insert(lines.end(), {{at(0.5, 0.2), at(0.6, 0.2)},
                             {at(0.6, 0.2), at(0.6, 0.5)},
                             {at(0.6, 0.5), at(0.5, 0.5)},
                             {at(0.5, 0.5), at(0.5, 0.2)}});
  const LaidGhosts laid = Tank(lines, {{at(0, 0), at(0.5, 0.6)}, {at(0.6, 0), at(1, 0.6)}}).lay();
  EXPECT_FALSE(laid.thin.empty());
  for (const Index s : laid.thin) EXPECT_GE(s, 3);
}

// Shells much shorter than the spacing have no point of the lattice straight over them.
TEST(GhostLattice, DoesNotDependOnTheLengthOfShells) {
  const auto cut = [](const std::vector<Line>& lines, int n) {
    std::vector<Line> out;
    for (const auto& [a, b] : lines)
      for (int k = 0; k < n; ++k) out.emplace_back(Vec(a + (b - a) * k / n), Vec(a + (b - a) * (k + 1) / n));
    return out;
  };
  std::vector<Line> lines{{at(0, 0.8), at(0.5, 0)}, {at(0.5, 0), at(1, 0)}, {at(1, 0), at(1.5, 0.8)}};
  const std::vector<std::pair<Vec, Vec>> water{{at(0.5, 0), at(1, 0.6)}};
  const LaidGhosts whole = Tank(lines, water).lay();
  EXPECT_GT(whole.ghosts.size(), 80U);
  for (const int n : {7, 60}) {
    const LaidGhosts fine = Tank(cut(lines, n), water).lay();
    EXPECT_EQ(fine.ghosts.size(), whole.ghosts.size()) << n;
    EXPECT_TRUE(fine.dry.empty()) << n;
    EXPECT_TRUE(fine.wet_on_both_sides.empty()) << n;
  }
}

TEST(GhostLattice, SurroundsWaterInACircle) {
  for (const int n : {24, 200}) {
    std::vector<Line> circle;
    const auto on = [n](int k) { return at(std::cos(2 * M_PI * k / n), std::sin(2 * M_PI * k / n)); };
    for (int k = 0; k < n; ++k) circle.emplace_back(on(k), on(k + 1));
    const LaidGhosts laid = Tank(circle, {{at(-0.5, -0.5), at(0.5, 0)}}).lay();
    const Real inner = 1 - 0.49 * dx, ring = M_PI * (1.4 * 1.4 - inner * inner);  // with what water keeps off
    EXPECT_NEAR(static_cast<Real>(laid.ghosts.size()) * dx * dx, ring, 0.05 * ring) << n;
    EXPECT_TRUE(laid.dry.empty()) << n;
  }
}

// The bed behind a gate is wet as soon as the gate is open: it has ghosts below it, and none above.
TEST(GhostLattice, TakesAGateForNoObstacleOfTheBed) {
  const std::vector<Line> lines{
      {at(0, 0), at(2, 0)}, {at(0, 0), at(0, 1)}, {at(2, 0), at(2, 1)}, {at(1, 0), at(1, 1)}};
  const LaidGhosts laid = Tank(lines, {{at(0, 0), at(1, 0.6)}}).move({3}).lay();
  EXPECT_EQ(within(laid, at(0, -0.4), at(2, 0)), 20 * 4);
  EXPECT_TRUE(laid.dry.empty());
  EXPECT_TRUE(laid.wet_on_both_sides.empty());
  // those of the gate are behind it
  EXPECT_EQ(within(laid, at(1, 0), at(1.4, 1)), 10 * 4);
  EXPECT_EQ(within(laid, at(0, 0), at(1, 1)), 0);
}

TEST(GhostLattice, DoesNotClimbOverTheRimOfATankOnATable) {
  auto lines = open_tank();
  lines[0] = {at(0, 0), at(1, 0)};
  lines.emplace_back(at(-1, 0), at(0, 0));
  lines.emplace_back(at(1, 0), at(2, 0));
  const LaidGhosts laid = Tank(lines, {{at(0, 0), at(1, 0.6)}}).lay();
  EXPECT_TRUE(laid.wet_on_both_sides.empty());
  EXPECT_EQ(laid.dry.size(), 2U);
  EXPECT_GE(within(laid, at(-0.4, 0), at(0, 1.2)), 12 * 4);
}

TEST(GhostLattice, IsTightWhereShellsMeetWithASmallGap) {
  auto lines = open_tank();
  lines[0] = {at(0.04, 0), at(0.97, 0)};
  const LaidGhosts laid = Tank(lines, {{at(0, 0), at(1, 0.6)}}).lay();
  EXPECT_TRUE(laid.wet_on_both_sides.empty());
  EXPECT_EQ(within(laid, at(0, 0), at(1, 1.2)), 0);
}

// Water falls past the end of the bed, where no ghost may be.
TEST(GhostLattice, EndsWhereAFreeEdgeDoes) {
  const std::vector<Line> lines{{at(0, 0), at(1, 0)}, {at(0, 0), at(0, 1)}};
  const LaidGhosts laid = Tank(lines, {{at(0, 0), at(0.5, 0.6)}}).lay();
  EXPECT_EQ(within(laid, at(1, -2), at(3, 2)), 0);
  EXPECT_EQ(within(laid, at(0, -0.4), at(1, 0)), 10 * 4);
}

}  // namespace
}  // namespace courant
