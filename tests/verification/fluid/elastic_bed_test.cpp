// Water on a block of elastic solids: contact acts on faces that deform and move.
#include <gtest/gtest.h>

#include "solid_decks.hpp"

using namespace courant;
using test::simulation_of;
using test::SolidDeck;

namespace {

constexpr auto nothing = [](World&, const Clock&, const std::string&) {};
constexpr Real L = 0.2, W = 0.08, H = 0.1, E = 1e7, nu = 0.3, rho_s = 2000, rho_w = 1000, g = 9.81, c0 = 20;

/// Particles of spacing dx in a box that starts at `low`.
void add_water(SolidDeck& deck, const Vec& low, const Vec& size, Real dx, Real touch) {
  const std::size_t first = deck.nodes.size() + 1;
  std::array<int, 3> n;
  for (int k = 0; k < 3; ++k) n[std::size_t(k)] = int(std::lround(size[k] / dx));
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) deck.nodes.push_back(low + dx * Vec(i + 0.5, j + 0.5, k + 0.5));
  deck.particles = "*ELEMENT_SPH\n";
  for (std::size_t p = first; p <= deck.nodes.size(); ++p)
    deck.particles += fmt::format("{:8}{:8}{:16.9e}\n", p, 1, rho_w * dx * dx * dx);
  deck.cards += fmt::format(
      "*PART\nwater\n         1         1         1         1         1\n*PART\nblock\n         2         2  "
      "       2\n"
      "*CONTROL_SPH\n         1         0    1.0e20         3\n*MAT_NULL\n         1{:10.4g}    -1e20\n"
      "*EOS_LINEAR_POLYNOMIAL\n         1         0{:10.4g}\n         0       1.0\n"
      "*SECTION_SPH\n         1       1.2       1.0       1.0\n"
      "*HOURGLASS\n         1         0         0         0     1e-20       0.1\n"
      "*SECTION_SOLID\n         2         1\n*MAT_ELASTIC\n         2{:10.4g}{:10.4g}{:10.4g}\n"
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n         1         2         3         3\n       0.0       0.0\n"
      "      10.0       1.0{:10.4g}\n",
      rho_w, rho_w * c0 * c0, rho_s, E, nu, touch);
}

/// Between mirrors, so that there is no halo; gravity grows over 0.1 s, the block's motion is damped.
std::string pool(Real dx, Real mesh) {
  SolidDeck deck;
  const int n = int(std::lround(W / mesh));
  deck.block(Vec(W, W, L), n, n, int(std::lround(L / mesh)), 2);
  deck.node_set(1, [](const Vec&) { return true; });
  deck.node_set(2, [](const Vec& x) { return x[2] < 1e-9; });
  add_water(deck, Vec(0, 0, L), Vec(W, W, H), dx, dx);
  deck.cards += fmt::format(
      "*BOUNDARY_SPC_SET\n         1         0         1         1         0\n         2         0         0 "
      "        0"
      "         1\n*LOAD_BODY_Z\n         1       1.0\n*DEFINE_CURVE\n         "
      "1\n{0:20}{0:20}\n{1:20}{2:20}\n"
      "              1000.0{2:20}\n*DAMPING_PART_MASS\n         2         2       1.0\n*DEFINE_CURVE\n       "
      "  2\n"
      "                 0.0                60.0\n              1000.0                60.0\n",
      0.0, 0.1, g);
  for (const char* axis : {"x", "y"})
    for (const bool far : {false, true}) {
      const Vec n_in = (far ? -1 : 1) * (*axis == 'x' ? Vec::UnitX() : Vec::UnitY());
      const Vec tail = far ? Vec(-W * n_in) : Vec(Vec::Zero()), head = tail + n_in;
      deck.cards +=
          fmt::format("*BOUNDARY_SPH_SYMMETRY_PLANE\n{:10.4g}{:10.4g}{:10.4g}{:10.4g}{:10.4g}{:10.4g}\n",
                      tail[0], tail[1], tail[2], head[0], head[1], head[2]);
    }
  return deck.text(1);
}

struct Settled {
  Real top = 0;                      ///< of the expected settlement [-]
  Real face_low = 1, face_high = 1;  ///< force on a face over its share of the weight [-]
};

Settled settle(Real dx, Real mesh) {
  auto s = simulation_of(pool(dx, mesh));
  World& w = s->world();
  const auto is_top = [&](Index k) {
    for (const Index n : w.segments.nodes(k))
      if (w.nodes.x.data(2)[n] < L - 0.5 * mesh) return false;
    return true;
  };
  std::vector<Index> top;
  for (Index k = 0; k < w.segments.size(); ++k)
    if (is_top(k)) top.push_back(k);
  std::vector<Real> force(top.size(), 0);
  Real sum = 0;
  int samples = 0;
  while (s->clock().t < 0.45)
    s->step([&](World& world, const Clock& clock, const std::string&) {
      if (clock.t < 0.25) return;
      ++samples;
      for (std::size_t k = 0; k < top.size(); ++k) {
        force[k] -= world.segments.contact_force->data(2)[top[k]];
        for (const Index n : world.segments.nodes(top[k]))
          sum += (L - world.nodes.x.data(2)[n]) / (4.0 * Real(top.size()));
      }
    });
  EXPECT_EQ(w.counters.at("leaked_particles"), 0);
  const Real stiff = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  Settled out{.top = sum / samples / ((rho_w * g * H * L + rho_s * g * L * L / 2) / stiff)};
  out.face_low = 1e9, out.face_high = 0;
  for (const Real f : force) {
    const Real share = f / samples / (rho_w * g * H * W * W / Real(top.size()));
    out.face_low = std::min(out.face_low, share), out.face_high = std::max(out.face_high, share);
  }
  return out;
}

}  // namespace

// Its top sinks by (rho_w g H L + rho_s g L^2/2)/E', and each face carries its share of the water.
TEST(ElasticBed, SettlesUnderWater) {
  for (const auto& [dx, mesh] : {std::pair(0.02, 0.04), {0.01, 0.02}}) {
    const Settled s = settle(dx, mesh);
    RecordProperty("settlement", fmt::format("{:.4f}", s.top));
    EXPECT_NEAR(s.top, 1, 0.02) << dx;
    EXPECT_GT(s.face_low, 0.95) << dx;
    EXPECT_LT(s.face_high, 1.05) << dx;
  }
}

// A free block, tilted and hit by water on one side, turns and deforms: no momentum is lost.
TEST(ElasticBed, MomentumStaysWhereABlockTurnsAndDeforms) {
  SolidDeck deck;
  const Real tilt = 0.3;
  deck.block(Vec(W, W, 0.06), 4, 4, 3, 2, [&](const Vec& x) {
    return Vec(std::cos(tilt) * x[0] - std::sin(tilt) * x[2], x[1],
               std::sin(tilt) * x[0] + std::cos(tilt) * x[2]);
  });
  const auto solids = Index(deck.nodes.size());
  add_water(deck, Vec(0.01, 0.02, 0.09), Vec(0.03, 0.04, 0.03), 0.01, 0.01);
  deck.node_set(
      3, [&](const Vec& x) { return x[2] > 0.09 + 1e-9 && x[0] > 0.01 && x[0] < 0.04 && x[1] > 0.02; });
  deck.cards += "*INITIAL_VELOCITY\n         3\n       0.0       0.0      -4.0\n";
  auto s = simulation_of(deck.text(1));
  World& w = s->world();
  ASSERT_EQ(w.nodes.size(), solids);
  const auto add = [](Vec& linear, Vec& angular, Real m, const Vec& x, const Vec& v) {
    linear += m * v, angular += m * x.cross(v);
  };
  const auto momenta = [&](Vec& linear, Vec& angular) {
    linear.setZero(), angular.setZero();
    for (Index i = 0; i < w.particles.size(); ++i)
      add(linear, angular, w.particles.m[i], w.particles.x.vec(i), w.particles.v.vec(i));
    for (Index n = 0; n < w.nodes.size(); ++n)
      add(linear, angular, w.nodes.m[n], w.nodes.x.vec(n), w.nodes.v.vec(n));
  };
  Vec linear, angular, p, l;
  momenta(linear, angular);
  while (s->clock().t < 0.03) s->step(nothing);
  momenta(p, l);
  EXPECT_GT(s->world().maxima.at("max_penetration"), 0) << "nothing touched";
  EXPECT_LT((p - linear).norm(), 1e-12 * linear.norm());
  // forces of a particle on a face act where it stands, half the contact distance off the face: along the
  // normal
  EXPECT_LT((l - angular).norm(), 1e-3 * std::max(angular.norm(), linear.norm() * W));
}
