// Places that go with faces: what a force there does to the corners.
#include "contact/tied/face_point.hpp"

#include <gtest/gtest.h>

#include <random>

#include "contact/tied/ties.hpp"

namespace courant {
namespace {

/// Corners of warped quadrilaterals or triangles, and a point beside each.
struct RandomFace {
  Nodes nodes;
  ContactFace face;
  FacePoint point;
  Vec place = Vec::Zero();

  RandomFace(int seed, int corners) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<Real> some(-0.2, 0.2);
    const auto vec = [&] { return Vec(some(random), some(random), some(random)); };
    nodes.fields.resize(4);
    const Vec flat[4] = {Vec(0, 0, 0), Vec(1, 0, 0), Vec(1, 1, 0), Vec(0, 1, 0)};
    for (Index n = 0; n < 4; ++n) nodes.x.set(n, flat[n] + vec()), nodes.v.set(n, 5 * vec());
    face.node = {0, 1, 2, corners == 3 ? 2 : 3}, face.corners = corners;
    const FaceCorners x = corners_of(face, nodes.x);
    place = (corners == 3 ? Vec((x[0] + x[1] + x[2]) / 3) : Vec(0.25 * (x[0] + x[1] + x[2] + x[3]))) +
            0.5 * vec();
    const Projection at = project(x, corners, place);
    EXPECT_TRUE(at.over);
    point = face_point(face, at, at.n.dot(place - at.q));
  }
};

}  // namespace

// The position is the one that it was made from, forces keep their sum and moment, and their power in any
// motion is that of the force at the point.
TEST(FacePoint, ForcesOnCornersDoTheSameAsTheForceAtThePoint) {
  for (const int corners : {3, 4})
    for (int seed = 0; seed < 20; ++seed) {
      const RandomFace f(seed, corners);
      EXPECT_NEAR((place_of(f.point, f.nodes.x) - f.place).norm(), 0, 1e-7);
      const Vec force(1, -2, 3);
      const auto on = on_corners(f.point, f.nodes.x, force);
      Vec sum = Vec::Zero(), moment = Vec::Zero();
      Real power = 0;
      for (std::size_t e = 0; e < static_cast<std::size_t>(corners); ++e) {
        const Index n = f.point.node[e];
        sum += on[e], moment += f.nodes.x.vec(n).cross(on[e]), power += on[e].dot(f.nodes.v.vec(n));
      }
      EXPECT_NEAR((sum - force).norm(), 0, 1e-12);
      EXPECT_NEAR((moment - place_of(f.point, f.nodes.x).cross(force)).norm(), 0, 1e-12);
      EXPECT_NEAR(power, force.dot(velocity_of(f.point, f.nodes.x, f.nodes.v)), 1e-12);
    }
}

// v = dx/dt, by a difference.
TEST(FacePoint, VelocityIsThatOfThePlace) {
  for (const int corners : {3, 4})
    for (int seed = 0; seed < 20; ++seed) {
      RandomFace f(seed, corners);
      const Vec v = velocity_of(f.point, f.nodes.x, f.nodes.v), before = place_of(f.point, f.nodes.x);
      constexpr Real dt = 1e-6;
      for (Index n = 0; n < 4; ++n) f.nodes.x.add(n, dt * f.nodes.v.vec(n));
      EXPECT_NEAR(((place_of(f.point, f.nodes.x) - before) / dt - v).norm(), 0, 1e-4);
    }
}

TEST(FacePoint, SharesOfMassAreNotNegativeAndSumToOne) {
  FacePoint beyond{.N = {0.55, 0.48, -0.02, -0.01}};
  const auto share = mass_shares(beyond);
  EXPECT_NEAR(share[0] + share[1] + share[2] + share[3], 1, 1e-15);
  EXPECT_EQ(share[2], 0);
  EXPECT_EQ(share[3], 0);
}

// 0.05 of the shortest diagonal, 0.6 of the thicknesses, or what is given; and no further than 2.5 % over an
// edge.
TEST(Ties, TakeTheNearestFaceWithinTheTolerance) {
  Nodes nodes;
  nodes.fields.resize(9);
  const Vec x[9] = {Vec(0, 0, 0),       Vec(1, 0, 0),        Vec(1, 1, 0),
                    Vec(0, 1, 0),       Vec(0.5, 0.5, 0.07), Vec(0.5, 0.5, 0.071),
                    Vec(1.012, 0.5, 0), Vec(1.014, 0.5, 0),  Vec(0.25, 0.75, -0.02)};
  for (Index n = 0; n < 9; ++n) nodes.x.set(n, x[n]);
  TieFace low, high;
  low.node = high.node = {0, 1, 2, 3}, low.area = high.area = 1, low.k = 5, high.segment = 1;
  const auto tied = [&](Real thickness, Real given) {
    std::vector<TieNode> all;
    for (Index n = 3; n < 9; ++n) all.push_back({.node = n, .thickness = thickness, .own = {}});
    std::vector<Index> out;
    for (const Tie& tie : find_ties(all, {low}, given, nodes.x)) out.push_back(tie.node);
    return out;
  };
  // 0.05 sqrt(2) = 0.0707; node 3 is a corner, node 7 is beside the face
  EXPECT_EQ(tied(0, 0), (std::vector<Index>{4, 6, 8}));
  EXPECT_EQ(tied(0.12, 0), (std::vector<Index>{4, 5, 6, 8}));
  EXPECT_EQ(tied(0.12, 0.01), (std::vector<Index>{6}));
  const auto ties = find_ties({{.node = 8, .thickness = 0, .own = {}}}, {low}, 0, nodes.x);
  ASSERT_EQ(ties.size(), 1u);
  EXPECT_NEAR(ties[0].at.gap, -0.02, 1e-15);
  EXPECT_NEAR(ties[0].at.N[3], 0.75 * 0.75, 1e-12);
  EXPECT_EQ(ties[0].k, 5.0 / 4);  // a quarter of the face
  // corners of a face are tied to no other one, and are reported
  TieFace other;
  other.node = {5, 6, 7, 8}, other.corners = 4, other.area = 1;
  std::vector<Index> near;
  EXPECT_TRUE(find_ties({{.node = 8, .thickness = 0, .own = {}}}, {low, other}, 0, nodes.x, &near).empty());
  EXPECT_EQ(near, (std::vector<Index>{8}));
}

}  // namespace courant
