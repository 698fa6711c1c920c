// METHOD 1 of *COURANT_WALL_SUPPORT: what particles see beside walls, against what a whole kernel holds.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "sph/kernel/kernel.hpp"
#include "sph/walls/images/wall_paths.hpp"
#include "sph/walls/wall_edge_loops.hpp"
#include "sph/walls/wall_tables.hpp"

namespace courant::wall_paths_test {
namespace {

constexpr Real h = 0.12, dx = 0.1, fine = 0.003;

/// Walls of one shell each along lines in the plane, one wide.
void add_plates(World& world, const std::vector<std::array<Vec, 4>>& plates, int dim) {
  world.dim = dim;
  world.nodes.fields.resize(4 * static_cast<Index>(plates.size()));
  world.segments.fields.resize(static_cast<Index>(plates.size()));
  for (Index s = 0; s < static_cast<Index>(plates.size()); ++s) {
    for (Index e = 0; e < 4; ++e) world.nodes.x.set(4 * s + e, plates[s][e]), world.nodes.held[4 * s + e] = 1;
    world.segments.node0[s] = 4 * s, world.segments.node1[s] = 4 * s + 1;
    world.segments.node2[s] = 4 * s + 2, world.segments.node3[s] = 4 * s + 3;
  }
}
std::array<Vec, 4> line(const Vec& a, const Vec& b) {
  const Vec z(0, 0, 0.5);
  return {Vec(a - z), Vec(b - z), Vec(b + z), Vec(a + z)};
}
Vec at_angle(Real degrees, Real r) {
  return r * Vec(std::cos(degrees * pi / 180), std::sin(degrees * pi / 180), 0);
}

struct Sums {
  Real fill = 0;            ///< int W dV, 1 where nothing is missing
  Vec slope = Vec::Zero();  ///< int grad W dV, 0 there
  Real stretch = 0;         ///< of a velocity that walls do not hinder: its divergence
  int paths = 0;
};

/// What x sees of a liquid all over the positions that `wet` tells, in small pieces.
template <class Wet>
Sums look(const World& world, const Vec& x, int dim, Real piece, const Wet& wet) {
  std::vector<Index> all(static_cast<std::size_t>(world.segments.size()));
  for (Index s = 0; s < world.segments.size(); ++s) all[s] = s;
  const WallSurface surface(world, all, h / 4, 2.1 * h + dx);
  const WallPaths paths(surface, dim, WallPaths::usual_width * dx);
  const auto sheets = paths.seen_from(x);
  Sums sums;
  const int n = static_cast<int>(2 * h / piece) + 1, deep = dim == 3 ? n : 0;
  const Real volume = dim == 3 ? piece * piece * piece : piece * piece;
  const auto add = [&](const Vec& d, Real weight) {
    const Real R = d.norm() / h;
    if (R >= 2) return;
    const Real scale = dim == 3 ? h * h * h : h * h;
    sums.fill += weight * volume * CubicSpline::C(dim) * CubicSpline::shape(R) / scale;
    sums.slope += weight * volume * CubicSpline::C(dim) * CubicSpline::slope(R) / (scale * h * R * h) * d;
  };
  std::vector<WallPath> found;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -deep; k <= deep; ++k) {
        const Vec y = x + piece * Vec(i + 0.37, j + 0.41, dim == 3 ? k + 0.43 : 0);
        if (!wet(y)) continue;
        add(x - y, 1);
        found.clear();
        paths.add(sheets, 0, x, 1, y, 2 * h, found);
        for (const WallPath& path : found) add(path.d, path.weight);
        sums.paths += static_cast<int>(found.size());
      }
  return sums;
}

TEST(WallPaths, FillTheKernelInCornersOfAnyAngle) {
  for (const Real angle : {45.0, 60.0, 75.0, 90.0, 110.0, 120.0, 150.0}) {
    World world;
    add_plates(world, {line(Vec::Zero(), at_angle(0, 1)), line(Vec::Zero(), at_angle(angle, 1))}, 2);
    const auto wet = [&](const Vec& y) {
      const Real a = std::atan2(y[1], y[0]) * 180 / pi;
      return a > 0 && a < angle;
    };
    for (const Real turn : {0.2, 0.5, 0.7})
      for (const Real r : {0.06, 0.12, 0.2}) {
        const Sums s = look(world, at_angle(turn * angle, r), 2, fine, wet);
        EXPECT_NEAR(s.fill, 1, 0.025) << angle << " " << turn << " " << r;
        EXPECT_LT(s.slope.norm() * h, 0.04) << angle << " " << turn << " " << r;
        EXPECT_GT(s.paths, 100);
      }
  }
}

TEST(WallPaths, FillTheKernelOverAStepAndBesideTheEndOfAPlate) {
  // the solid is x < 0, y < 0
  World step;
  add_plates(step, {line(Vec(-1, 0, 0), Vec::Zero()), line(Vec::Zero(), Vec(0, -1, 0))}, 2);
  const auto over_step = [](const Vec& y) { return y[0] > 0 || y[1] > 0; };
  World plate;
  add_plates(plate, {line(Vec(-1, 0, 0), Vec::Zero())}, 2);
  const auto everywhere = [](const Vec&) { return true; };
  for (const Vec& x : {Vec(-0.05, 0.05, 0), Vec(-0.15, 0.05, 0), Vec(0.05, 0.05, 0), Vec(0.05, -0.05, 0),
                       Vec(0.02, 0.11, 0)}) {
    EXPECT_NEAR(look(step, x, 2, fine, over_step).fill, 1, 0.02) << x.transpose();
    EXPECT_NEAR(look(plate, x, 2, fine, everywhere).fill, 1, 0.02) << x.transpose();
  }
}

// Many short walls, each of which sees several others: what the paths by two of them and more leave open is
// little.
TEST(WallPaths, FillTheKernelInAndAroundRoundWalls) {
  constexpr int sides = 24;
  constexpr Real R = 0.5;
  World world;
  std::vector<std::array<Vec, 4>> plates;
  for (int k = 0; k < sides; ++k)
    plates.push_back(line(at_angle(360.0 * k / sides, R), at_angle(360.0 * (k + 1) / sides, R)));
  add_plates(world, plates, 2);
  const auto is_in = [&](const Vec& y) {
    for (int k = 0; k < sides; ++k)
      if (y.dot(at_angle(360.0 * (k + 0.5) / sides, 1)) > R * std::cos(pi / sides)) return false;
    return true;
  };
  for (const Real off : {0.05, 0.1, 0.15})
    for (const Real angle : {1.0, 7.5, 12.0, 14.9}) {
      const Sums in = look(world, at_angle(angle, R - off), 2, fine, is_in),
                 out = look(world, at_angle(angle, R + off), 2, fine, [&](const Vec&y) { return !is_in(y); });
      std::printf("%.2f %.1f: %.4f %.4f, %.4f %.4f\n", off, angle, in.fill, out.fill, in.slope.norm() * h,
                  out.slope.norm() * h);
      EXPECT_NEAR(in.fill, 1, 0.01) << off << " " << angle;
      EXPECT_NEAR(out.fill, 1, 0.01) << off << " " << angle;
    }
}

TEST(WallPaths, FillTheKernelInACornerOfThreeWalls) {
  const Real L = 1;
  const std::array<Vec, 4> floor{Vec(0, 0, 0), Vec(L, 0, 0), Vec(L, L, 0), Vec(0, L, 0)},
      left{Vec(0, 0, 0), Vec(0, L, 0), Vec(0, L, L), Vec(0, 0, L)},
      front{Vec(0, 0, 0), Vec(L, 0, 0), Vec(L, 0, L), Vec(0, 0, L)};
  World world;
  add_plates(world, {floor, left, front}, 3);
  const auto wet = [](const Vec& y) { return y.minCoeff() > 0; };
  for (const Vec& x : {Vec(0.05, 0.05, 0.05), Vec(0.05, 0.15, 0.07), Vec(0.4, 0.05, 0.05)}) {
    const Sums s = look(world, x, 3, 0.006, wet);
    EXPECT_NEAR(s.fill, 1, 0.04) << x.transpose();
    EXPECT_LT(s.slope.norm() * h, 0.06) << x.transpose();
  }
}

TEST(WallPaths, HideWhatIsBehindAPlate) {
  World world;
  add_plates(world, {line(Vec(-1, 0, 0), Vec(1, 0, 0))}, 2);
  const Vec x(0.01, 0.05, 0);
  const Sums s = look(world, x, 2, fine, [](const Vec&) { return true; });
  EXPECT_NEAR(s.fill, 1, 0.025);
  EXPECT_LT(s.slope.norm() * h, 0.02);
  // water on the far side alone is out of sight
  EXPECT_NEAR(look(world, x, 2, fine, [](const Vec& y) { return y[1] < 0; }).fill, 0, 1e-12);
}

TEST(WallPaths, AreTheSameBothWays) {
  World world;
  add_plates(world,
             {line(Vec(-1, 0, 0), Vec::Zero()), line(Vec::Zero(), at_angle(-70, 1)),
              line(at_angle(-70, 1), at_angle(-70, 1) + Vec(1, 0, 0))},
             2);
  const WallSurface surface(world, {0, 1, 2}, h / 4, 2.1 * h + dx);
  const WallPaths paths(surface, 2, WallPaths::usual_width * dx);
  int count = 0;
  for (int k = 0; k < 700; ++k) {
    const Vec x(0.2 * std::sin(1.3 * k) + 0.1, 0.2 * std::cos(2.1 * k), 0);
    const Vec y = x + Vec(0.15 * std::sin(5.7 * k), 0.15 * std::cos(3.3 * k), 0);
    std::vector<WallPath> there, back;
    paths.add(paths.seen_from(x), 0, x, 1, y, 2 * h, there);
    paths.add(paths.seen_from(y), 1, y, 0, x, 2 * h, back);
    ASSERT_EQ(there.size(), back.size()) << k << ": " << x.transpose() << " to " << y.transpose();
    const auto power = [](const std::vector<WallPath>& all) {
      Real sum = 0;
      for (const WallPath& p : all) sum += p.weight * p.d.squaredNorm();
      return sum;
    };
    EXPECT_NEAR(power(there), power(back), 1e-5 * h * h) << k;
    Vec slope = Vec::Zero(), other = Vec::Zero();
    for (const WallPath& p : there) slope += p.by_i + 2 * p.by_j;
    for (const WallPath& p : back) other += p.by_j + 2 * p.by_i;
    EXPECT_LT((slope - other).norm() * dx, 1e-6) << k;
    count += static_cast<int>(there.size());
  }
  EXPECT_GT(count, 200);
}

/// Lines of wall, and whether a position is in the water.
struct Place {
  std::string name;
  std::vector<std::pair<Vec, Vec>> lines;
  std::function<bool(const Vec&)> wet;
  /// And so far from walls as particles stand.
  bool holds(const Vec& y) const {
    return wet(y) && std::all_of(lines.begin(), lines.end(), [&](const auto& l) {
             const Vec along = l.second - l.first;
             const Real t = std::clamp((y - l.first).dot(along) / along.squaredNorm(), Real(0), Real(1));
             return (y - l.first - t * along).norm() > 0.5 * dx;
           });
  }
};
std::vector<Place> places() {
  const Vec o = Vec::Zero(), left(-1, 0, 0), right(1, 0, 0), up(0, 1, 0), down(0, -1, 0), low(0, -0.15, 0);
  return {
      {"step", {{left, o}, {o, down}}, [](const Vec& y) { return y[0] > 0 || y[1] > 0; }},
      {"end of a plate", {{down, o}}, [](const Vec&) { return true; }},
      {"foot of a plate", {{left, right}, {o, up}}, [](const Vec& y) { return y[1] > 0; }},
      {"gate", {{left, right}, {Vec(0, 0.13, 0), up}}, [](const Vec& y) { return y[1] > 0; }},
      {"low step",
       {{left, o}, {o, low}, {low, right + low}},
       [](const Vec& y) { return y[1] > (y[0] > 0 ? -0.15 : 0); }},
      {"wedge",
       {{o, at_angle(60, 1)}, {o, at_angle(120, 1)}},
       [](const Vec& y) { return y[1] > std::abs(y[0]) * std::tan(pi / 3); }},
  };
}

/// Sum of shares times the kernel, and how it changes with the positions of both ends.
struct Seen {
  Real sum = 0;
  Vec by_x = Vec::Zero(), by_y = Vec::Zero();
};
Seen see(const WallPaths& paths, const Vec& x, const Vec& y) {
  std::vector<WallPath> found{{.i = 0, .j = 1, .weight = 1, .d = x - y}};
  paths.add(paths.seen_from(x), 0, x, 1, y, 2 * h, found);
  Seen out;
  for (const WallPath& p : found) {
    const Real R = p.d.norm() / h;
    if (R >= 2) continue;
    const Real W = CubicSpline::shape(R);
    const Vec slope = CubicSpline::slope(R) / (h * R * h) * p.d;
    out.sum += p.weight * W;
    out.by_x += p.weight * slope + W * p.by_i;
    out.by_y += -p.weight * (p.turn.transpose() * slope) + W * p.by_j;
  }
  return out;
}

/// The walls of a position, held; their segments.
std::vector<Index> add_lines(World& world, const Place& place) {
  std::vector<Index> all;
  std::vector<std::array<Vec, 4>> plates;
  for (const auto& [a, b] : place.lines) {
    all.push_back(static_cast<Index>(plates.size()));
    plates.push_back(line(a, b));
  }
  add_plates(world, plates, 2);
  return all;
}

// Density then depends on positions alone, not on the path there: what a pair gains on any path is the
// difference of what it has at its ends.
TEST(WallPaths, GiveAndTakeShareWithoutJumps) {
  for (const Place& place : places()) {
    World world;
    const std::vector<Index> all = add_lines(world, place);
    const WallSurface surface(world, all, h / 4, 2.1 * h + dx);
    const WallPaths paths(surface, 2, WallPaths::usual_width * dx);
    int tried = 0, changed = 0;
    for (int k = 0; k < 40000; ++k) {
      const Vec x(0.25 * std::sin(1.3 * k), 0.25 * std::cos(2.1 * k + 1), 0),
          y(0.25 * std::sin(5.7 * k + 2), 0.25 * std::cos(3.3 * k), 0);
      const Vec dx_ = 0.004 * dx * Vec(std::sin(0.7 * k), std::cos(0.7 * k), 0),
                dy = 0.004 * dx * Vec(std::sin(1.9 * k), std::cos(1.9 * k), 0);
      if (!place.holds(x) || !place.holds(y) || !place.holds(x + dx_) || !place.holds(y + dy)) continue;
      if ((x - y).norm() > 1.9 * h) continue;
      ++tried;
      const Seen from = see(paths, x, y), to = see(paths, x + dx_, y + dy);
      const Real gain = 0.5 * (from.by_x + to.by_x).dot(dx_) + 0.5 * (from.by_y + to.by_y).dot(dy);
      EXPECT_NEAR(to.sum - from.sum, gain, 4e-4)
          << place.name << ": " << x.transpose() << " and " << y.transpose();
      changed += std::abs(gain) > 1e-3;
    }
    EXPECT_GT(tried, 100) << place.name;
    EXPECT_GT(changed, 50) << place.name;
  }
}

/// What `see` sees, as the walls that move make it, and what it changes by with those of each body.
struct SeenByWalls {
  Seen seen;
  Real by_walls = 0;                              ///< times their velocities
  Vec force = Vec::Zero(), moment = Vec::Zero();  ///< on all ends of what it depends on
};
SeenByWalls see_moving(const WallPaths& paths, WallPaths::Sheets sheets, const Vec& x, const Vec& y) {
  paths.update(sheets);
  std::vector<WallPath> found{{.i = 0, .j = 1, .weight = 1, .d = x - y}};
  std::vector<WallDerivative> at_edges;
  paths.add(sheets, 0, x, 1, y, 2 * h, found, &at_edges);
  SeenByWalls out;
  const auto count = [&](const WallDerivative& derivative, Real times) {
    const Vec n = paths.face(derivative.face).n, v = paths.velocity(derivative.face, derivative.at);
    out.by_walls += times * (derivative.force.dot(v) +
                             n.dot(paths.velocity(derivative.face, derivative.at + derivative.lever) - v));
    out.force += times * derivative.force;
    out.moment +=
        times * ((derivative.at - paths.shift()).cross(derivative.force) + derivative.lever.cross(n));
  };
  for (const WallPath& p : found) {
    const Real R = p.d.norm() / h;
    if (R >= 2) continue;
    const Real W = CubicSpline::shape(R);
    const Vec slope = CubicSpline::slope(R) / (h * R * h) * p.d, by_x = p.weight * slope + W * p.by_i,
              by_y = -p.weight * (p.turn.transpose() * slope) + W * p.by_j;
    out.seen.sum += p.weight * W, out.seen.by_x += by_x, out.seen.by_y += by_y;
    out.force += by_x + by_y, out.moment += x.cross(by_x) + y.cross(by_y);
    for (Index k = p.derivatives; k < p.derivatives_end; ++k) count(at_edges[k], W);
    std::vector<WallDerivative> derivatives;
    if (p.moves) paths.add_image_derivatives(sheets, p, y, p.weight * slope, derivatives);
    for (const WallDerivative& derivative : derivatives) count(derivative, 1);
  }
  return out;
}

// As a wall moves and turns, what a pair gains is the difference again; forces by it add up to nothing with
// those on the pair where all walls in reach are of bodies that move, and so do their moments.
TEST(WallPaths, GoAlongWithWallsThatMoveAndPullThem) {
  for (const Place& place : places())
    for (std::size_t moves = 0; moves < 4; ++moves) {
      // walls that turn away from each other at an edge must stay together
      if (moves != 2 && (place.name == "step" || place.name == "low step")) continue;
      World world;
      const std::vector<Index> all = add_lines(world, place);
      // the first, the last, all as one body, or each as its own; each has a motion of its own
      for (Index s = 0; s < world.segments.size(); ++s) {
        const bool goes = moves >= 2 || s == (moves == 0 ? 0 : world.segments.size() - 1);
        const Index body = moves == 2 ? 0 : s;
        world.segments.part[s] = body;
        if (!goes) continue;
        const Vec about(0.3 * body, -0.2, 0), v(0.4 - 0.9 * body, 0.7 * body - 0.3, 0);
        for (const Index n : world.segments.nodes(s)) {
          const Vec r = world.nodes.x.vec(n) - about;
          world.nodes.held[n] = 0;
          world.nodes.v.set(n, v + (1.3 - 2.1 * body) * Vec(-r[1], r[0], 0));
        }
      }
      const WallSurface surface(world, all, h / 4, 2.1 * h + dx);
      const WallPaths searched(surface, 2, WallPaths::usual_width * dx);
      WallPaths before = searched, after = searched, now = searched;
      constexpr Real step = 2e-5;
      before.take_along(world, step), after.take_along(world, -step), now.take_along(world, 0);
      int tried = 0, changed = 0;
      for (int k = 0; k < 40000; ++k) {
        const Vec x(0.25 * std::sin(1.3 * k), 0.25 * std::cos(2.1 * k + 1), 0),
            y(0.25 * std::sin(5.7 * k + 2), 0.25 * std::cos(3.3 * k), 0);
        if (!place.holds(x) || !place.holds(y) || (x - y).norm() > 1.9 * h) continue;
        ++tried;
        const WallPaths::Sheets sheets = searched.seen_from(x);
        const Real gain =
            see_moving(after, sheets, x, y).seen.sum - see_moving(before, sheets, x, y).seen.sum;
        const SeenByWalls at = see_moving(now, sheets, x, y);
        EXPECT_NEAR(gain / (2 * step), at.by_walls, 0.02 + 0.01 * std::abs(at.by_walls))
            << place.name << " " << moves << ": " << x.transpose() << " and " << y.transpose();
        changed += std::abs(at.by_walls) > 0.1;
        if (moves < 2) continue;
        EXPECT_LT(at.force.norm(), 1e-10) << place.name << " " << moves;
        EXPECT_LT(at.moment.norm(), 1e-5) << place.name << " " << moves;
      }
      EXPECT_GT(tried, 100) << place.name;
      EXPECT_GT(changed, 5) << place.name << " " << moves;
    }
}

// In a corner the path to oneself and back goes through the edge, for some walls always.
TEST(WallPaths, ShowAParticleToItselfInCorners) {
  for (const auto& [angle, images] : {std::pair{90, 3}, std::pair{60, 5}, std::pair{45, 7}}) {
    World world;
    add_plates(world, {line(Vec::Zero(), at_angle(0, 1)), line(Vec::Zero(), at_angle(angle, 1))}, 2);
    const WallSurface surface(world, {0, 1}, h / 4, 2.1 * h + dx);
    const WallPaths paths(surface, 2, WallPaths::usual_width * dx);
    for (const Real turn : {0.3, 0.5, 0.61}) {
      const Vec x = at_angle(turn * angle, 0.9 * h);
      std::vector<WallPath> found;
      paths.add(paths.seen_from(x), 0, x, 0, x, 2 * h, found);
      EXPECT_EQ(found.size(), images) << angle << " " << turn;
      for (const WallPath& p : found) EXPECT_EQ(p.weight, 1) << angle << " " << turn;
    }
  }
}

/// Particles beside walls, each a neighbour of all, as the loops over sub-domains take them.
struct Crowd {
  std::vector<Real> x[3], v[3], V, p, rho, drhodt, f[3], wall_force[3], edge_loss, edge_sum[2];
  std::vector<const WallSubDomain*> domain;
  std::vector<WallSubDomain> domains;
  std::vector<const WallEdge*> edge;
  std::vector<WallEdge> edges;
  std::vector<char> skipped;
  std::vector<Index> list, start, doubt;
  std::vector<unsigned char> lanes;
  Index doubts = 0;
  Vec at(std::size_t i) const { return Vec(x[0][i], x[1][i], x[2][i]); }
  Vec velocity(std::size_t i) const { return Vec(v[0][i], v[1][i], v[2][i]); }
  /// Of what a pair's share changes by.
  Real kept(std::size_t i, std::size_t j) const { return (1 - edge_loss[i]) * (1 - edge_loss[j]); }
  bool is_doubtful(std::size_t i, std::size_t j) const {
    for (Index k = 0; k < doubts; ++k) {
      const Index entry = doubt[static_cast<std::size_t>(k)];
      const std::size_t group = static_cast<std::size_t>(entry) / V.size();
      if (group == i / 8 && list[static_cast<std::size_t>(entry)] == static_cast<Index>(j) &&
          (lanes[static_cast<std::size_t>(k)] >> i % 8 & 1) != 0)
        return true;
    }
    return false;
  }
  WallMirrorArrays arrays(const Vec& aside) {
    WallMirrorArrays a{};
    for (int c = 0; c < 3; ++c) {
      a.x[c] = x[c].data(), a.v[c] = v[c].data(), a.f[c] = f[c].data();
      a.wall_force[c] = wall_force[c].data(), a.aside[c] = aside[c];
    }
    a.V = V.data(), a.rho = rho.data(), a.p = p.data(), a.drhodt = drhodt.data();
    a.h = h, a.half_step = 1e-3, a.width = WallPaths::usual_width * dx;
    a.edge_loss = edge_loss.data();
    for (int k = 0; k < 2; ++k) a.edge_sum[k] = edge_sum[k].data();
    a.domain = domain.data(), a.edge = edge.data(), a.skipped = skipped.data();
    a.doubt = doubt.data(), a.doubt_lanes = lanes.data(), a.doubts = &doubts;
    a.kernel = &any_kernel(KernelChoice::cubic_spline);
    return a;
  }
};
template <class Wet>
Crowd crowd_about(const WallPaths& paths, int dim, Real wide, const Wet& wet) {
  Crowd out;
  for (int k = 0; out.V.size() < 64; ++k) {
    const Vec x(wide * std::sin(1.3 * k), wide * std::cos(2.1 * k + 1),
                dim == 3 ? wide * std::sin(3.7 * k) : 0);
    if (!wet(x)) continue;
    for (int c = 0; c < 3; ++c)
      out.x[c].push_back(x[c]), out.v[c].push_back(c < dim ? std::sin(k + 2.0 * c) : 0);
    out.V.push_back(1 + 0.5 * std::sin(k)), out.p.push_back(2 + std::cos(3 * k)), out.rho.push_back(1);
    out.edge_loss.push_back(0.3 + 0.3 * std::sin(5 * k));
  }
  const std::size_t n = out.V.size();
  for (auto* to : {&out.drhodt, &out.f[0], &out.f[1], &out.f[2], &out.wall_force[0], &out.wall_force[1],
                   &out.wall_force[2], &out.edge_sum[0], &out.edge_sum[1]})
    to->assign(n, 0);
  out.domains.resize(n), out.domain.resize(n), out.skipped.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    for (const OpenSubDomain& r :
         paths.sub_domains_about(paths.sheets_around(out.at(i), 2.2 * h + dx), out.at(i), 0, 2 * h))
      if (r.holds_open(out.at(i), 0.6 * dx)) out.domains[i] = r.open, out.domain[i] = &out.domains[i];
  out.edges.resize(n), out.edge.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    if (const auto edge = paths.edge_about(paths.sheets_around(out.at(i), 2.2 * h + dx), out.at(i), 2 * h))
      out.edges[i] = *edge, out.edge[i] = &out.edges[i];
  for (std::size_t g = 0; g <= n / 8; ++g) out.start.push_back(static_cast<Index>(g * n));
  for (std::size_t g = 0; g < n / 8; ++g)
    for (std::size_t j = 0; j < n; ++j) out.list.push_back(static_cast<Index>(j));
  out.doubt.resize(out.list.size()), out.lanes.resize(out.list.size());
  return out;
}

/// Walls, and where water is.
struct Plates {
  const char* name;
  int dim;
  std::vector<std::array<Vec, 4>> walls;
  bool (*wet)(const Vec&);
};

// What the loops add of pairs that they do not doubt is what the paths between them are, in corners and
// beside the ends of walls.
TEST(WallPaths, AreThoseOfRoomsWhereWaysLeaveNone) {
  const Real L = 1;
  const Plates places[] = {
      {"corner",
       2,
       {line(Vec::Zero(), Vec(1, 0, 0)), line(Vec::Zero(), Vec(0, 1, 0))},
       [](const Vec& y) { return y[0] > 0 && y[1] > 0; }},
      {"step",
       2,
       {line(Vec(-1, 0, 0), Vec::Zero()), line(Vec::Zero(), Vec(0, -1, 0))},
       [](const Vec& y) { return y[0] > 0 || y[1] > 0; }},
      {"plate", 2, {line(Vec(-1, 0, 0), Vec(0.05, 0, 0))}, [](const Vec&) { return true; }},
      {"tilted corner",
       2,
       {line(Vec::Zero(), at_angle(20, 1)), line(Vec::Zero(), at_angle(110, 1))},
       [](const Vec& y) { return at_angle(110, 1).dot(y) > 0 && at_angle(20, 1).dot(y) > 0; }},
      {"corner of three",
       3,
       {{Vec(0, 0, 0), Vec(L, 0, 0), Vec(L, L, 0), Vec(0, L, 0)},
        {Vec(0, 0, 0), Vec(0, L, 0), Vec(0, L, L), Vec(0, 0, L)},
        {Vec(0, 0, 0), Vec(L, 0, 0), Vec(L, 0, L), Vec(0, 0, L)}},
       [](const Vec& y) { return y.minCoeff() > 0; }},
      {"block on a floor",
       3,
       {{Vec(-L, -L, -0.1), Vec(L, -L, -0.1), Vec(L, L, -0.1), Vec(-L, L, -0.1)},
        {Vec(0, -L, -0.1), Vec(0, L, -0.1), Vec(0, L, 0.1), Vec(0, -L, 0.1)},
        {Vec(0, -L, 0.1), Vec(0, L, 0.1), Vec(L, L, 0.1), Vec(L, -L, 0.1)}},
       [](const Vec& y) { return y[2] > -0.1 && (y[0] < 0 || y[2] > 0.1); }}};
  for (const Plates& place : places) {
    World world;
    add_plates(world, place.walls, place.dim);
    std::vector<Index> all(place.walls.size());
    for (std::size_t s = 0; s < all.size(); ++s) all[s] = static_cast<Index>(s);
    const WallSurface surface(world, all, h / 4, 2.1 * h + dx, {}, nullptr, nullptr, 0.3 * h + dx);
    const WallPaths paths(surface, place.dim, WallPaths::usual_width * dx);
    Crowd crowd = crowd_about(paths, place.dim, 0.3, place.wet);
    const WallMirrorArrays a = crowd.arrays(paths.shift());
    const NeighbourLists lists{crowd.list.data(), crowd.start.data(), 0, static_cast<Index>(crowd.V.size())};
    mirror_rates_loop(KernelChoice::cubic_spline, place.dim)(a, lists);
    mirror_forces_loop(KernelChoice::cubic_spline, place.dim)(a, lists);
    const WallTables table(KernelChoice::cubic_spline, place.dim);
    int looked = 0, count = 0;
    for (std::size_t i = 0; i < crowd.V.size(); ++i) {
      if (!crowd.domain[i] || crowd.skipped[i] != 0) continue;
      ++looked;
      Real rate = 0;
      Vec force = Vec::Zero();
      const auto sheets = paths.sheets_around(crowd.at(i), 2.2 * h + dx);
      for (std::size_t j = 0; j < crowd.V.size(); ++j) {
        if (j == i || crowd.is_doubtful(i, j)) continue;  // oneself is seen from other positions aside
        const auto slope = [&](const Vec& d) {
          return table.slope(d.norm() / h) / (d.norm() * h * (place.dim == 2 ? h * h : h * h * h));
        };
        std::vector<WallPath> earlier, now;
        const auto back = [&](std::size_t k) { return Vec(crowd.at(k) - 1e-3 * crowd.velocity(k)); };
        paths.add(sheets, static_cast<Index>(i), back(i), static_cast<Index>(j), back(j), 2 * h, earlier);
        for (const WallPath& path : earlier)
          rate += crowd.V[j] * path.weight * slope(path.d) *
                  (crowd.velocity(i) - path.turn * crowd.velocity(j)).dot(path.d);
        paths.add(sheets, static_cast<Index>(i), crowd.at(i), static_cast<Index>(j), crowd.at(j), 2 * h, now);
        for (const WallPath& path : now) {
          EXPECT_TRUE(path.by_i.isZero()) << place.name << " " << crowd.at(i).transpose();
          force -= crowd.V[i] * crowd.V[j] * (crowd.p[i] + crowd.p[j]) * path.weight * slope(path.d) * path.d;
        }
        count += static_cast<int>(now.size());
      }
      const Real scale = 1e-4 / (h * h * h * (place.dim == 2 ? 1 : h));
      // what oneself adds, from one position aside
      WallSubDomain domain = *crowd.domain[i];
      const Vec x = crowd.at(i) + paths.shift(), earlier = x - 1e-3 * crowd.velocity(i),
                u = crowd.velocity(i);
      for (int S = 1; S < 1 << domain.walls && !crowd.is_doubtful(i, i); ++S) {
        Vec d = Vec::Zero(), before = d, over = d;
        for (int k = 0; k < domain.walls; ++k) {
          if ((S >> k & 1) == 0) continue;
          const Vec n(domain.n[k][0], domain.n[k][1], domain.n[k][2]);
          d += 2 * (n.dot(x) - domain.offset[k]) * n, before += 2 * (n.dot(earlier) - domain.offset[k]) * n;
          over += 2 * n.dot(u) * n;
        }
        const auto slope = [&](const Vec& e) {
          return table.slope(e.norm() / h) / (e.norm() * h * (place.dim == 2 ? h * h : h * h * h));
        };
        rate += crowd.V[i] * slope(before) * over.dot(before);
        force -= crowd.V[i] * crowd.V[i] * 2 * crowd.p[i] * slope(d) * d;
      }
      EXPECT_NEAR(crowd.drhodt[i], rate, scale) << place.name << ": " << crowd.at(i).transpose();
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(crowd.f[c][i], force[c], 4 * scale) << place.name;
    }
    EXPECT_GT(looked, 10) << place.name;
    EXPECT_GT(count, 20) << place.name;
  }
}

/// What paths by WallPaths add to the rate of density of a particle and the force on it, and its edge_sum.
struct ByPaths {
  Real rate = 0;
  Vec force = Vec::Zero();
  std::array<Real, 2> sum{};
};
ByPaths by_paths(const WallPaths& paths, const Crowd& crowd, std::size_t i, int dim) {
  const WallTables table(KernelChoice::cubic_spline, dim);
  const Real volume = dim == 2 ? h * h : h * h * h;
  const auto slope = [&](const Vec& d) { return table.slope(d.norm() / h) / (d.norm() * h * volume); };
  const auto kernel = [&](const Vec& d) { return table.kernel(d.norm() / h) / volume; };
  const auto sheets = paths.sheets_around(crowd.at(i), 2.2 * h + dx);
  ByPaths out;
  for (std::size_t j = 0; j < crowd.V.size(); ++j) {
    std::vector<WallPath> earlier, now;
    const auto back = [&](std::size_t k) { return Vec(crowd.at(k) - 1e-3 * crowd.velocity(k)); };
    paths.add(sheets, static_cast<Index>(i), back(i), static_cast<Index>(j), back(j), 2 * h, earlier);
    for (const WallPath& path : earlier) {
      if (path.weight > 0 || path.across)
        out.sum[path.weight > 0 ? 0 : 1] += crowd.V[j] * kernel(path.d) * path.by_i.norm();
      out.rate += crowd.V[j] * (path.weight * slope(path.d) *
                                    (crowd.velocity(i) - path.turn * crowd.velocity(j)).dot(path.d) +
                                crowd.kept(i, j) * kernel(path.d) *
                                    (path.by_i.dot(crowd.velocity(i)) + path.by_j.dot(crowd.velocity(j))));
    }
    paths.add(sheets, static_cast<Index>(i), crowd.at(i), static_cast<Index>(j), crowd.at(j), 2 * h, now);
    for (const WallPath& path : now)
      out.force -= crowd.V[i] * crowd.V[j] * (crowd.p[i] + crowd.p[j]) *
                   (path.weight * slope(path.d) * path.d + crowd.kept(i, j) * kernel(path.d) * path.by_i);
  }
  return out;
}

// What the loops over edges add is what all paths of these particles do, those that pass the edge and those
// that it hides among them.
TEST(WallPaths, AreThoseOfEdgesInTheirLoops) {
  const auto anywhere = [](const Vec&) { return true; };
  const Plates places[] = {
      {"step",
       2,
       {line(Vec(-1, 0, 0), Vec::Zero()), line(Vec::Zero(), Vec(0, -1, 0))},
       [](const Vec& y) { return y[0] > 0 || y[1] > 0; }},
      {"step that is wet inside, too",
       2,
       {line(Vec(-1, 0, 0), Vec::Zero()), line(Vec::Zero(), Vec(0, -1, 0))},
       anywhere},
      {"blunt edge",
       2,
       {line(Vec::Zero(), at_angle(100, 1)), line(Vec::Zero(), at_angle(-30, 1))},
       [](const Vec& y) { return at_angle(10, 1).dot(y) < 0 || at_angle(60, 1).dot(y) > 0; }},
      {"end of a plate", 2, {line(Vec(-1, 0, 0), Vec(0.05, 0, 0))}, anywhere},
      {"edge in space",
       3,
       {{Vec(-1, -1, 0), Vec(0, -1, 0), Vec(0, 1, 0), Vec(-1, 1, 0)},
        {Vec(0, -1, 0), Vec(0, 1, 0), Vec(0, 1, -1), Vec(0, -1, -1)}},
       [](const Vec& y) { return y[0] > 0 || y[2] > 0; }},
      {"end of a plate in space",
       3,
       {{Vec(-1, -1, 0), Vec(0, -1, 0), Vec(0, 1, 0.5), Vec(-1, 1, 0.5)}},
       anywhere}};
  for (const Plates& place : places) {
    World world;
    add_plates(world, place.walls, place.dim);
    std::vector<Index> all(place.walls.size());
    for (std::size_t s = 0; s < all.size(); ++s) all[s] = static_cast<Index>(s);
    const WallSurface surface(world, all, h / 4, 2.1 * h + dx, {}, nullptr, nullptr, 0.3 * h + dx);
    const WallPaths paths(surface, place.dim, WallPaths::usual_width * dx);
    Crowd crowd = crowd_about(paths, place.dim, 0.2, place.wet);
    const WallMirrorArrays a = crowd.arrays(paths.shift());
    const NeighbourLists lists{crowd.list.data(), crowd.start.data(), 0, static_cast<Index>(crowd.V.size())};
    edge_rates_loop(KernelChoice::cubic_spline, place.dim)(a, lists);
    edge_forces_loop(KernelChoice::cubic_spline, place.dim)(a, lists);
    int looked = 0;
    Real most = 0;
    for (std::size_t i = 0; i < crowd.V.size(); ++i) {
      if (!crowd.edge[i] || crowd.skipped[i] != 0) continue;
      ++looked;
      const auto [rate, force, sum] = by_paths(paths, crowd, i, place.dim);
      const Real scale = 1e-4 / (h * h * h * (place.dim == 2 ? 1 : h));
      most = std::max(most, std::abs(rate));
      EXPECT_NEAR(crowd.drhodt[i], rate, 4 * scale) << place.name << ": " << crowd.at(i).transpose();
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(crowd.f[c][i], force[c], 8 * scale) << place.name << ": " << crowd.at(i).transpose();
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(crowd.edge_sum[k][i], sum[k], 4 * scale) << place.name << ": " << crowd.at(i).transpose();
    }
    EXPECT_GT(looked, 30) << place.name;
    EXPECT_GT(most, 1e3 * 1e-4 / (h * h * h)) << place.name;
  }
}

/// What particle i does to a body that moves, and what it gets.
struct Exchange {
  Real rate = 0;
  Vec force = Vec::Zero(), on_wall = Vec::Zero(), moment = Vec::Zero();
  void give(const WallPaths& paths, const WallDerivative& derivative, Real times) {
    on_wall += times * derivative.force;
    moment += times * ((derivative.at - paths.shift()).cross(derivative.force) +
                       derivative.lever.cross(paths.face(derivative.face).n));
  }
};

/// As WallImages follows the paths of particle i one by one where walls move.
Exchange by_moving_paths(const WallPaths& middle, const WallPaths& end, const WallPaths::Sheets& around,
                         const Crowd& crowd, std::size_t i, int dim) {
  const AnyKernel& kernel = any_kernel(KernelChoice::cubic_spline);
  const Real norm = kernel.C(dim) / (dim == 2 ? h * h : h * h * h);
  const auto W = [&](const Vec& d) { return norm * kernel.shape(d.norm() / h); };
  const auto slope = [&](const Vec& d) {
    return norm * kernel.gradient_factor * kernel.gradient(d.norm() / h) / (d.norm() * h);
  };
  auto then = around, now = around;
  middle.update(then), end.update(now);
  Exchange out;
  for (std::size_t j = 0; j < crowd.V.size(); ++j) {
    const auto back = [&](std::size_t k) { return Vec(crowd.at(k) - 1e-3 * crowd.velocity(k)); };
    const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
    std::vector<WallPath> found;
    std::vector<WallDerivative> derivatives;
    middle.add(then, a, back(i), b, back(j), 2 * h, found, &derivatives);
    bool at_edge = false;
    for (const WallPath& path : found) {
      Real turns = path.by_i.dot(crowd.velocity(i)) + path.by_j.dot(crowd.velocity(j));
      for (Index k = path.derivatives; k < path.derivatives_end; ++k) {
        const Vec v = middle.velocity(derivatives[k].face, derivatives[k].at),
                  farther = middle.velocity(derivatives[k].face, derivatives[k].at + derivatives[k].lever);
        turns += derivatives[k].force.dot(v) + middle.face(derivatives[k].face).n.dot(farther - v);
      }
      const Vec u = crowd.velocity(i) - path.turn * crowd.velocity(j) - path.drift;
      out.rate +=
          crowd.V[j] * (path.weight * slope(path.d) * u.dot(path.d) + crowd.kept(i, j) * W(path.d) * turns);
      at_edge |= std::abs(path.weight) < 1;
    }
    if (at_edge)
      found.clear(), derivatives.clear(),
          end.add(now, a, crowd.at(i), b, crowd.at(j), 2 * h, found, &derivatives);
    for (WallPath& path : found) {
      if (path.moves)
        end.bring(now, crowd.at(i), crowd.at(j), path);
      else
        path.d = crowd.at(i) - crowd.at(j);
      const Real pressure = -crowd.V[i] * crowd.V[j] * (crowd.p[i] + crowd.p[j]);
      const Vec along = pressure * path.weight * slope(path.d) * path.d;
      const Real goes_over = pressure * crowd.kept(i, j) * W(path.d);
      out.force += along + goes_over * path.by_i;
      for (Index k = path.derivatives; k < path.derivatives_end; ++k)
        out.give(end, derivatives[k], 0.5 * goes_over);
      std::vector<WallDerivative> images;
      if (path.moves) end.add_image_derivatives(now, path, crowd.at(j), -along, images);
      for (const WallDerivative& derivative : images) out.give(end, derivative, -0.5);
    }
  }
  return out;
}

/// What a particle at x does to its edge, as the loops have it.
Exchange of_edge(const WallEdge& edge, const WallEdgeReaction& derivative, const Vec& x) {
  const auto vec = [](const Real(&of)[3]) { return Vec(of[0], of[1], of[2]); };
  Exchange out;
  const Vec axis = vec(edge.n[0]).cross(vec(edge.m[0])), from = vec(edge.at),
            place = from + axis.dot(x - from) * axis;
  for (int k = 0; k < edge.walls; ++k) {
    const Vec n = vec(edge.n[k]), m = vec(edge.m[k]), foot = x - n.dot(x - from) * n,
              at_edge = derivative.edge[k][0] * n + derivative.edge[k][1] * m;
    out.on_wall += derivative.push[k] * n + at_edge;
    out.moment += foot.cross(derivative.push[k] * n) +
                  (derivative.inward[k] * m + derivative.along[k] * axis).cross(n) + place.cross(at_edge) +
                  axis.cross(derivative.edge_along[k][0] * n + derivative.edge_along[k][1] * m);
  }
  return out;
}

// The same where the body goes along and turns: rates, forces, and what the body gets.
TEST(WallPaths, AreThoseOfEdgesThatMoveInTheirLoops) {
  const Plates places[] = {
      {"step",
       2,
       {line(Vec(-1, 0, 0), Vec::Zero()), line(Vec::Zero(), Vec(0, -1, 0))},
       [](const Vec& y) { return y[0] > 0.02 || y[1] > 0.02; }},
      {"end of a plate", 2, {line(Vec(-1, 0, 0), Vec(0.05, 0, 0))}, [](const Vec&) { return true; }},
      {"edge in space",
       3,
       {{Vec(-1, -1, 0), Vec(0, -1, 0), Vec(0, 1, 0), Vec(-1, 1, 0)},
        {Vec(0, -1, 0), Vec(0, 1, 0), Vec(0, 1, -1), Vec(0, -1, -1)}},
       [](const Vec& y) { return y[0] > 0.02 || y[2] > 0.02; }}};
  for (const Plates& place : places) {
    World world;
    add_plates(world, place.walls, place.dim);
    std::vector<Index> all;
    const Vec spin = place.dim == 2 ? Vec(0, 0, 1.7) : Vec(0.8, -1.1, 1.7);
    Matrix turn = Matrix::Identity();  // as a rigid body where it is in the middle of the step
    for (int c = 0; c < 3; ++c) turn.col(c) += 1e-3 * spin.cross(Vec(Vec::Unit(c)));
    for (Index n = 0; n < world.nodes.size(); ++n) {
      world.nodes.held[n] = 0;
      const Vec v = Vec(0.4, -0.7, place.dim == 2 ? 0 : 0.3) + spin.cross(world.nodes.x.vec(n));
      world.nodes.v.set(n, turn.inverse() * v);
    }
    for (Index s = 0; s < world.segments.size(); ++s) all.push_back(s), world.segments.part[s] = 0;
    const WallSurface surface(world, all, h / 4, 2.1 * h + dx, {}, nullptr, nullptr, 0.3 * h + dx);
    const WallPaths searched(surface, place.dim, WallPaths::usual_width * dx);
    WallPaths middle = searched, end = searched;
    middle.take_along(world, 1e-3), end.take_along(world, 0);
    Crowd crowd = crowd_about(searched, place.dim, 0.2, place.wet);
    const std::size_t n = crowd.V.size();
    std::vector<WallPaths::Sheets> sheets(n);
    std::vector<std::optional<WallPaths::LoneEdge>> edges(n);
    const auto place_edges = [&](const WallPaths& paths) {
      for (std::size_t i = 0; i < n; ++i) {
        if (!edges[i]) continue;
        paths.update(sheets[i]);
        crowd.edges[i] = paths.current(*edges[i], sheets[i]), crowd.edge[i] = &crowd.edges[i];
      }
    };
    for (std::size_t i = 0; i < n; ++i) {
      sheets[i] = searched.sheets_around(crowd.at(i), 2.2 * h + dx);
      edges[i] = searched.moving_edge_about(sheets[i], crowd.at(i), 2 * h);
    }
    WallMirrorArrays a = crowd.arrays(searched.shift());
    std::vector<WallEdgeReaction> derivatives(n);
    std::vector<std::uint32_t> edge_paths(crowd.list.size());
    a.reaction = derivatives.data(), a.edge_paths = edge_paths.data();
    const NeighbourLists lists{crowd.list.data(), crowd.start.data(), 0, static_cast<Index>(n)};
    place_edges(middle), edge_rates_loop(KernelChoice::cubic_spline, place.dim)(a, lists);
    place_edges(end), edge_forces_loop(KernelChoice::cubic_spline, place.dim)(a, lists);
    int looked = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (!edges[i] || crowd.skipped[i] != 0) continue;
      ++looked;
      const Exchange exact = by_moving_paths(middle, end, sheets[i], crowd, i, place.dim),
                     edge = of_edge(crowd.edges[i], derivatives[i], crowd.at(i));
      const Real scale =
          1e-4 / (h * h * h * (place.dim == 2 ? 1 : h));  // oneself is seen from positions aside
      EXPECT_NEAR(crowd.drhodt[i], exact.rate, 4 * scale) << place.name << ": " << crowd.at(i).transpose();
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(crowd.f[c][i], exact.force[c], 8 * scale) << place.name;
        EXPECT_NEAR(edge.on_wall[c], exact.on_wall[c], 8 * scale) << place.name;
        EXPECT_NEAR(edge.moment[c], exact.moment[c], 2 * scale) << place.name;
      }
    }
    EXPECT_GT(looked, 30) << place.name;
  }
}

// An edge alone: no corner that looks in, no narrow wedge, which hides more, nothing else in sight.
TEST(WallPaths, FindEdgesThatStandAlone) {
  const auto edge_at = [](const Vec& x, const std::vector<std::array<Vec, 4>>& walls) {
    World world;
    add_plates(world, walls, 2);
    std::vector<Index> all(walls.size());
    for (std::size_t s = 0; s < all.size(); ++s) all[s] = static_cast<Index>(s);
    const WallSurface surface(world, all, h / 4, 2.1 * h + dx, {}, nullptr, nullptr, 0.3 * h + dx);
    const WallPaths paths(surface, 2, WallPaths::usual_width * dx);
    return paths.edge_about(paths.sheets_around(x, 2.2 * h + dx), x, 2 * h);
  };
  const auto side = [](Real angle) { return line(Vec::Zero(), at_angle(angle, 1)); };
  const Vec x = at_angle(200, 0.1);
  EXPECT_TRUE(edge_at(x, {side(0), side(100)}));
  EXPECT_TRUE(edge_at(x, {side(0), side(90)}));
  EXPECT_TRUE(edge_at(x, {side(0)}));
  EXPECT_FALSE(edge_at(x, {side(0), side(60)})) << "narrow";
  EXPECT_FALSE(edge_at(at_angle(45, 0.1), {side(0), side(90)})) << "between the walls";
  EXPECT_FALSE(edge_at(at_angle(90, 0.1), {line(Vec(-1, 0, 0), Vec(1, 0, 0))})) << "no end";
  EXPECT_FALSE(edge_at(x, {side(0), line(Vec(-0.3, -1, 0), Vec(-0.3, 1, 0))})) << "another wall";
  EXPECT_FALSE(edge_at(x, {line(Vec::Zero(), Vec(0.1, 0, 0))})) << "both ends";
}

}  // namespace
}  // namespace courant::wall_paths_test
