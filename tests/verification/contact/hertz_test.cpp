// An elastic ball hits a rigid plane: Hertz's law of force and approach, by the motion that follows from it.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "solid_decks.hpp"

namespace courant::test::hertz {

namespace {

constexpr Real R = 0.01, E = 2.1e11, nu = 0.3, ro = 7800;

/// A ball of n^3 elements in its middle and six caps of n^2 m around, which touches z = 0 with a node. Sides
/// of elements grow from the middle of each cap.
class Ball {
 public:
  Ball(SolidDeck& deck, int n, int m) : deck_(deck), n_(n) {
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          std::array<Vec, 8> x;
          for (std::size_t c = 0; c < 8; ++c) {
            const int up[3] = {c % 4 == 1 || c % 4 == 2, c % 4 > 1, c > 3};
            x[c] = middle(Vec(at(i + up[0]), at(j + up[1]), at(k + up[2])));
          }
          element(x);
        }
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) cap(axis, side, m);
  }

 private:
  Real at(int i) const {
    const Real t = 2.0 * i / n_ - 1;
    return std::copysign(std::pow(std::abs(t), 1.3), t);
  }
  static Vec on_sphere(const Vec& v) {
    const Vec s = (0.25 * pi / v.cwiseAbs().maxCoeff() * v).array().tan().matrix();
    return s.normalized();
  }
  /// Of the core, a cube whose sides bulge.
  static Vec middle(const Vec& v) {
    constexpr Real core = 0.45, bulge = 0.35;
    const Real most = v.cwiseAbs().maxCoeff();
    if (most == 0) return Vec::Zero();
    return R * core * ((1 - bulge * most) * v + 1.25 * bulge * most * most * on_sphere(v));
  }
  void cap(int axis, int side, int m) {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    const auto place = [&](int i, int j, int k) -> Vec {
      Vec v;
      v[axis] = side, v[u] = at(side > 0 ? i : n_ - i), v[w] = at(j);
      const Vec inner = middle(v);
      return inner + (R * on_sphere(v) - inner) * k / m;
    };
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j)
        for (int k = 0; k < m; ++k) {
          std::array<Vec, 8> x;
          for (std::size_t c = 0; c < 8; ++c)
            x[c] = place(i + (c % 4 == 1 || c % 4 == 2), j + (c % 4 > 1), k + (c > 3));
          element(x);
        }
  }
  void element(const std::array<Vec, 8>& x) {
    deck_.elements += fmt::format("{:8}{:8}", ++elements_, 1);
    for (const Vec& corner : x) deck_.elements += fmt::format("{:8}", node(corner));
    deck_.elements += "\n";
  }
  std::size_t node(const Vec& x) {
    std::array<long, 3> key;
    for (std::size_t k = 0; k < 3; ++k) key[k] = std::lround(x[static_cast<Index>(k)] / R * 1e7);
    const auto [found, added] = numbers_.emplace(key, deck_.nodes.size() + 1);
    if (added) deck_.nodes.push_back(x + Vec(0, 0, R));
    return found->second;
  }

  SolidDeck& deck_;
  int n_, elements_ = 0;
  std::map<std::array<long, 3>, std::size_t> numbers_;
};

struct Hit {
  Real approach = 0, time = 0;  ///< of the centre of mass until it turns round
  Real mass = 0, rebound = 0;   ///< rebound: speed afterwards over that before
  Real energy_error = 0;
};
Hit hit_of(int n, int m, Real speed) {
  SolidDeck deck;
  const Ball ball(deck, n, m);
  deck.cards = fmt::format(
      "*PART\nball\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,{},{},{}\n*CONTROL_HOURGLASS\n5,0.05\n"
      "*INITIAL_VELOCITY\n0\n0.0,0.0,{}\n*RIGIDWALL_PLANAR\n0\n0.0,0.0,0.0,0.0,0.0,1.0\n",
      ro, E, nu, -speed);
  auto s = simulation_of(deck.text(1));
  start_ledger(*s);
  const Nodes& nodes = s->world().nodes;
  Hit out;
  for (Index i = 0; i < nodes.size(); ++i) out.mass += nodes.m[i];
  Real v = -speed, t = 0;
  for (Real apart = 0; t < 1e-3;) {
    s->step(do_nothing);
    t = s->clock().t;
    Real now = 0;
    for (Index i = 0; i < nodes.size(); ++i) now += nodes.m[i] * nodes.v.data(2)[i] / out.mass;
    apart += now * s->clock().dt_old;
    if (v < 0 && now >= 0) out.time = t - s->clock().dt_old * (0.5 + now / (now - v)), out.approach = -apart;
    v = now;
    if (out.time > 0 && t > 2.3 * out.time) break;
  }
  out.rebound = v / speed, out.energy_error = energy_error_of_a_step(*s);
  return out;
}

}  // namespace

// F = 4/3 E/(1 - nu^2) sqrt(R) delta^(3/2). So m v^2/2 = 2/5 F delta gives the largest approach, which is
// there after 1.4716 delta/v, half of the time of contact (Timoshenko & Goodier). The plane holds the nodes
// that touch it: these are some ten to forty, so that the force of few is rough. The ball is in contact for
// 25 times as long as a wave takes through it, and rings with a thousandth of its energy.
TEST(Hertz, ABallOnARigidPlane) {
  constexpr Real speed = 10;
  for (const auto& [n, m] : {std::pair(14, 8), {16, 9}, {20, 12}}) {
    const Hit hit = hit_of(n, m, speed);
    EXPECT_NEAR(hit.mass / (ro * 4.0 / 3 * pi * R * R * R), 1, 0.01) << n;
    const Real K = 4.0 / 3 * E / (1 - nu * nu) * std::sqrt(R);
    const Real approach = std::pow(1.25 * hit.mass * speed * speed / K, 0.4);
    const Real force = std::pow(approach / hit.approach, 2.5);  // over Hertz's, at the same approach
    EXPECT_NEAR(force, 1, 0.03) << n;
    EXPECT_NEAR(hit.time / (1.4716 * approach / speed), 1, 0.02) << n;
    EXPECT_NEAR(hit.rebound, 1, 0.003) << n;
    EXPECT_LT(hit.energy_error, 0.001) << n;
    RecordProperty(fmt::format("force_{}", n), fmt::format("{:.4f}", force));
    RecordProperty(fmt::format("time_{}", n), fmt::format("{:.4f}", hit.time / (1.4716 * approach / speed)));
  }
}

}  // namespace courant::test::hertz
