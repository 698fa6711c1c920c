#include "contact/facet.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "contact/facet_grid.hpp"
#include "contact/wall.hpp"

using namespace courant;

namespace {

World world_of(const std::vector<Corners>& quads) {
  World w;
  w.nodes.fields.resize(Index(4 * quads.size()));
  w.segments.fields.resize(Index(quads.size()));
  for (Index s = 0; s < Index(quads.size()); ++s) {
    for (int e = 0; e < 4; ++e) w.nodes.x.set(4 * s + e, quads[s][e]);
    w.segments.node0[s] = 4 * s, w.segments.node1[s] = 4 * s + 1, w.segments.node2[s] = 4 * s + 2;
    w.segments.node3[s] = quads[s][2] == quads[s][3] ? 4 * s + 2 : 4 * s + 3;
  }
  return w;
}

TEST(Facet, FlatQuadStaysWholeWarpedAndConcaveQuadsAreSplit) {
  World w = world_of({{Vec(0, 0, 0), Vec(1, 0, 0), Vec(1, 1, 0), Vec(0, 1, 0)},
                      {Vec(0, 0, 0), Vec(1, 0, 0.1), Vec(1, 1, 0), Vec(0, 1, 0.1)},
                      {Vec(0, 0, 0), Vec(1, 0, 0), Vec(0.2, 0.2, 0), Vec(0, 1, 0)},
                      {Vec(0, 0, 0), Vec(1, 0, 0), Vec(1, 1, 0), Vec(1, 1, 0)}});
  EXPECT_EQ(make_facets(w, {0}).size(), 1u);
  EXPECT_EQ(make_facets(w, {0})[0].corners, 4);
  EXPECT_EQ(make_facets(w, {1}).size(), 2u);
  const auto concave = make_facets(w, {2});
  ASSERT_EQ(concave.size(), 2u);
  EXPECT_GT(concave[0].n.dot(concave[1].n), 0.99);
  EXPECT_FALSE(is_over(concave[0], Vec(0.6, 0.6, 1)) || is_over(concave[1], Vec(0.6, 0.6, 1)));
  EXPECT_EQ(make_facets(w, {3})[0].corners, 3);
}

TEST(Facet, NearestOnRimMatchesSampling) {
  World w = world_of({{Vec(0, 0, 0), Vec(2, 0, 0), Vec(2.5, 1, 0), Vec(0, 1, 0)}});
  const Facet f = make_facets(w, {0})[0];
  for (const Vec& y : {Vec(3, -1, 0.3), Vec(1, 2, -0.2), Vec(-1, 0.5, 0), Vec(2.6, 0.5, 0.1)}) {
    ASSERT_FALSE(is_over(f, y));
    Real least = 1e9;
    for (int e = 0; e < 4; ++e)
      for (int k = 0; k <= 10000; ++k)
        least = std::min(least, (y - (f.x[e] + (f.x[(e + 1) % 4] - f.x[e]) * (k / 10000.0))).norm());
    EXPECT_NEAR((y - nearest_on_rim(f, y)).norm(), least, 1e-4);
  }
}

TEST(Facet, ShapeFunctionsReproducePositions) {
  World w = world_of({{Vec(0, 0, 0), Vec(2, 0, 0), Vec(2.5, 1, 0), Vec(0, 1.2, 0)},
                      {Vec(0, 0, 1), Vec(1, 0, 0), Vec(0, 1, 0), Vec(0, 1, 0)}});
  for (Index s = 0; s < 2; ++s) {
    const Facet f = make_facets(w, {s})[0];
    const Vec q = f.corners == 4 ? Vec(1.1, 0.7, 0) : Vec(0.2 * f.x[0] + 0.3 * f.x[1] + 0.5 * f.x[2]);
    const auto N = shape_functions(f, q);
    Vec back = Vec::Zero();
    Real sum = 0;
    for (int e = 0; e < f.corners; ++e) back += N[e] * f.x[e], sum += N[e];
    EXPECT_NEAR((back - q).norm(), 0, 1e-12);
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

// The way in which its nodes share a force is that in which they move the position of it; else a wall that
// warps does another work than it takes.
TEST(Facet, NodesOfAQuadThatDeformsShareForcesAsTheyMoveIt) {
  World w = world_of({{Vec(0, 0, 0), Vec(2, 0, 0.1), Vec(2.5, 1, 0), Vec(0, 1.2, 0.2)}});
  const std::vector<Facet> facets = make_facets(w, {0}, [](Index) { return true; });
  ASSERT_EQ(facets.size(), 4u);
  const Vec v[4] = {Vec(0.3, -0.2, 0.7), Vec(0.1, 0.5, -0.4), Vec(-0.6, 0.2, 0.9), Vec(0.4, 0.3, -0.8)};
  const Real step = 1e-6;
  for (const Facet& f : facets) {
    const Vec q = 0.5 * f.x[0] + 0.2 * f.x[1] + 0.3 * f.x[2], y = q + 0.3 * f.n;
    const auto N = shape_functions(f, q);
    Real along = 0;
    for (int e = 0; e < 4; ++e) along += N[e] * v[f.node[e]].dot(f.n);
    EXPECT_GT(*std::min_element(N.begin(), N.end()), 0);
    Facet moved[2] = {f, f};
    for (int way = 0; way < 2; ++way) {
      World other = world_of({{w.nodes.x.vec(0), w.nodes.x.vec(1), w.nodes.x.vec(2), w.nodes.x.vec(3)}});
      for (Index n = 0; n < 4; ++n)
        other.nodes.x.set(n, Vec(w.nodes.x.vec(n) + (way == 0 ? -step : step) * v[n]));
      update_facet(moved[way], other.nodes);
    }
    // the position itself goes with the facet, turning about q
    Real at[2];
    for (int way = 0; way < 2; ++way) at[way] = plane_distance(moved[way], y);
    Vec turned = Vec::Zero();
    for (int way = 0; way < 2; ++way) turned += (way == 0 ? -1 : 1) * moved[way].n / (2 * step);
    EXPECT_NEAR((at[1] - at[0]) / (2 * step), -along + turned.dot(y - q), 1e-8);
  }
}

TEST(Facet, PathThroughAMovingFacetIsSeen) {
  World w = world_of({{Vec(0, 0, 0), Vec(1, 0, 0), Vec(1, 1, 0), Vec(0, 1, 0)}});
  const Facet f = make_facets(w, {0})[0];
  Corners before = f.x;
  for (Vec& b : before) b.z() = -0.1;  // the facet rises by 0.1
  Real t = -1;
  EXPECT_TRUE(passes_through(f, before, 1, Vec(0.5, 0.5, -0.05), Vec(0.5, 0.5, -0.05), t));
  EXPECT_NEAR(t, 0.5, 1e-12);
  EXPECT_FALSE(passes_through(f, f.x, 1, Vec(0.5, 0.5, 0.2), Vec(0.5, 0.5, 0.1), t));
  EXPECT_FALSE(passes_through(f, f.x, 1, Vec(0.5, 1.3, 0.1), Vec(0.5, 1.1, -0.1), t));
  EXPECT_TRUE(passes_through(f, f.x, 1, Vec(0.5, 1.1, 0.1), Vec(0.5, 0.8, -0.1), t));
  // round-off put the start on the wrong side of the plane: still a passage
  EXPECT_TRUE(passes_through(f, f.x, 1, Vec(0.5, 0.5, -1e-18), Vec(0.5, 0.5, -0.1), t));
}

// Of two squares of a plane the later one yields along the edge that they share, and there only.
TEST(Wall, IsSurelyOverUpToItsOtherEdges) {
  World w = world_of({{Vec(0, 0, 0), Vec(1, 0, 0), Vec(1, 1, 0), Vec(0, 1, 0)},
                      {Vec(1, 1, 0), Vec(1, 0, 0), Vec(2, 0, 0), Vec(2, 1, 0)}});
  std::vector<Facet> facets = make_facets(w, {0, 1});
  ASSERT_EQ(facets.size(), 2u);
  for (Facet& f : facets) f.moves = false;
  std::vector<Wall> walls{make_wall(facets[0]), make_wall(facets[1])};
  const Real apart = 0.05;
  find_planes(facets, 0.1, 1e-6, apart, walls);
  ASSERT_GE(walls[1].plane, 0);
  EXPECT_EQ(walls[0].plane, walls[1].plane);
  EXPECT_TRUE(is_surely_over(walls[1], Vec(1.97, 0.5, 0.1)));
  EXPECT_TRUE(is_surely_over(walls[1], Vec(1.5, 0.03, 0.1)));
  EXPECT_FALSE(is_surely_over(walls[1], Vec(1.03, 0.5, 0.1))) << "here the other one may be nearer";
  EXPECT_TRUE(is_surely_over(walls[1], Vec(1.2, 0.5, 0.1)));
  EXPECT_FALSE(is_surely_over(walls[1], Vec(2.1, 0.5, 0.1)));
}

TEST(Wall, IsSurelyOverAtTheBorderItself) {
  Wall w;
  for (std::size_t e = 0; e < 4; ++e) w.inward[e] = Vec::UnitX(), w.sure[e] = 1;
  EXPECT_TRUE(is_surely_over(w, Vec(1, 0, 0)));
  EXPECT_FALSE(is_surely_over(w, Vec(0.999, 0, 0)));
}

TEST(FacetGrid, FindsEveryFacetInReach) {
  std::vector<Corners> quads;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) {
      const Real a = 0.1 * i, b = 0.1 * j, t = 0.3 * i;
      quads.push_back({Vec(a, b, t * 0.1), Vec(a + 0.1, b, t * 0.1), Vec(a + 0.1, b + 0.1, t * 0.1 + 0.05),
                       Vec(a, b + 0.1, t * 0.1 + 0.05)});
    }
  World w = world_of(quads);
  std::vector<Index> all(quads.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = Index(k);
  const auto facets = make_facets(w, all);
  const Real reach = 0.07;
  FacetGrid grid;
  grid.build(facets, reach);
  std::uint64_t seed = 1;
  const auto random = [&] {
    return Real((seed = seed * 6364136223846793005ull + 1442695040888963407ull) >> 11) / 9007199254740992.0;
  };
  int found = 0;
  for (int k = 0; k < 3000; ++k) {
    const Vec x(1.2 * random() - 0.1, 1.2 * random() - 0.1, 0.6 * random() - 0.1);
    const auto near = grid.near(x);
    for (Index s = 0; s < Index(facets.size()); ++s) {
      const Facet& f = facets[s];
      const Real d = is_over(f, x) ? std::abs(plane_distance(f, x)) : (x - nearest_on_rim(f, x)).norm();
      if (d > reach) continue;
      ++found;
      EXPECT_TRUE(std::find(near.begin(), near.end(), s) != near.end());
    }
  }
  EXPECT_GT(found, 1000);
}

}  // namespace
