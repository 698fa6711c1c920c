// Bounds of how far nodes are from faces, against points of these and feet on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

#include "base/instruction_set.hpp"
#include "contact/nodes/face.hpp"
#include "contact/nodes/face_bound_loops.hpp"

namespace courant {
namespace {

struct ManyFaces {
  std::array<std::vector<Real>, 3> x;
  std::vector<std::array<Index, 4>> face;
  Vec at(Index n) const {
    const auto k = static_cast<std::size_t>(n);
    return {x[0][k], x[1][k], x[2][k]};
  }
  FaceCorners corners(std::size_t f) const {
    return {at(face[f][0]), at(face[f][1]), at(face[f][2]), at(face[f][3])};
  }
};

/// Squares of width 1 whose corners are off by up to `noise`, every third a triangle.
ManyFaces random_faces(std::size_t count, Real noise, std::mt19937& random) {
  std::uniform_real_distribution<Real> off(-noise, noise);
  ManyFaces out;
  for (std::size_t f = 0; f < count; ++f) {
    std::array<Index, 4> node{};
    for (int e = 0; e < 4; ++e) {
      node[static_cast<std::size_t>(e)] = static_cast<Index>(out.x[0].size());
      const Real corner[3] = {e == 1 || e == 2 ? 1.0 : 0.0, e >= 2 ? 1.0 : 0.0, 0.0};
      for (std::size_t k = 0; k < 3; ++k) out.x[k].push_back(corner[k] + off(random));
    }
    if (f % 3 == 2) node[3] = node[2];
    out.face.push_back(node);
  }
  return out;
}

/// Least distance from points of a face that reaches `edge_margin` beyond its edges.
Real sampled_distance(const FaceCorners& x, bool triangle, const Vec& y) {
  constexpr int steps = 40;
  Real least = std::numeric_limits<Real>::infinity();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Real s = -edge_margin + (1 + 2 * edge_margin) * i / steps,
                 t = -edge_margin + (1 + 2 * edge_margin) * j / steps;
      if (triangle && s + t > 1 + edge_margin) continue;
      const Vec q =
          triangle ? Vec((1 - s - t) * x[0] + s * x[1] + t * x[2])
                   : Vec((1 - s) * (1 - t) * x[0] + s * (1 - t) * x[1] + s * t * x[2] + (1 - s) * t * x[3]);
      least = std::min(least, (y - q).norm());
    }
  return least;
}

TEST(FaceBounds, AreNeverTooFarForAnyFaceAndMotion) {
  const InstructionSet before = instruction_set();
  for (const InstructionSet set : instruction_sets()) {
    use_instruction_set(set);
    const FaceBoundLoops loops = face_bound_loops();
    std::mt19937 random(7);
    std::uniform_real_distribution<Real> within(-1.2, 2.2), unit(-1, 1);
    constexpr std::size_t count = 11;  // more than one pack, and no whole number of them
    int useful = 0, trials = 0;
    for (const Real noise : {0.0, 0.01, 0.05, 0.3})
      for (int round = 0; round < 150; ++round) {
        const ManyFaces nodes = random_faces(count, noise, random);
        const Vec y(within(random), within(random), round % 2 == 0 ? 0.1 * unit(random) : unit(random));
        std::vector<const Index*> corners;
        for (const auto& face : nodes.face) corners.push_back(face.data());
        const Real* const x[3] = {nodes.x[0].data(), nodes.x[1].data(), nodes.x[2].data()};
        std::array<Real, count> clear{}, beside{};
        loops.bounds(x, corners.data(), count, y.data(), clear.data(), beside.data());
        for (std::size_t f = 0; f < count; ++f, ++trials) {
          const bool triangle = nodes.face[f][2] == nodes.face[f][3];
          const Real distance = sampled_distance(nodes.corners(f), triangle, y);
          ASSERT_LE(clear[f], distance + 1e-9) << name_of(set);
          useful += clear[f] > 0.5 * distance || beside[f] > 0.1;
          for (int k = 0; k < 10 && beside[f] > 0; ++k) {
            FaceCorners moved = nodes.corners(f);
            const Vec centre = centre_of(moved, 4), n = plane_normal(moved), w = y - centre;
            const Vec aside = (w - w.dot(n) * n).normalized(), up = w.dot(n) < 0 ? Vec(-n) : n;
            // at random, or the face turns towards y as far as it can, and y comes over it
            const auto by = [&](const Vec& worst) {
              const Vec any(unit(random), unit(random), unit(random));
              return Vec(0.499 * beside[f] * (k == 0 ? worst : any).normalized());
            };
            for (Vec& corner : moved) corner += by((corner - centre).dot(aside) > 0 ? Vec(-up) : up);
            if (triangle) moved[3] = moved[2];
            ASSERT_FALSE(project_over(moved, triangle ? 3 : 4, y + by(-aside)).over)
                << name_of(set) << ", noise " << noise << ", beside " << beside[f];
          }
        }
      }
    EXPECT_GT(useful, trials / 2) << name_of(set);
  }
  use_instruction_set(before);
}

}  // namespace
}  // namespace courant
