// *COURANT_TURBULENCE against closed forms and a finite volume solution on a line.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "../../verification/run/same_bits.hpp"
#include "../app/small_scene.hpp"
#include "shear_layer.hpp"
#include "sph/core/fields.hpp"
#include "sph/walls/wall_distance.hpp"
#include "sph/walls/wall_law.hpp"

namespace courant {
namespace {

using namespace test::shear_layer;
using test::run;

TEST(WallDistance, IsThatOfTheNearestPointAlsoBesideEdgesAndCorners) {
  for (const int dim : {2, 3}) {
    test::SmallScene scene;
    scene.dim = dim, scene.n = 3;
    scene.extra = test::floor_cards(0, 1, dim == 3 ? "0" : "1,7,7");  // from -2 to 3 along x and z
    const auto s = test::build(scene);
    World& world = s->world();
    for (Index n = 0; n < world.nodes.size(); ++n)  // turns about z
      world.nodes.v.set(n, Vec(-world.nodes.x.vec(n)[1], world.nodes.x.vec(n)[0], 0));
    WallDistance walls({0}, 10, 0.1, {}, world);
    EXPECT_EQ(walls.any_moves(), dim == 3);
    const NearestWall above = walls.nearest(Vec(1, 0.4, 0)), beside = walls.nearest(Vec(4, 1, 0));
    EXPECT_NEAR(above.distance, 0.4, 1e-12);
    EXPECT_NEAR((above.normal - Vec::UnitY()).norm(), 0, 1e-12);
    EXPECT_NEAR((above.velocity - Vec(0, dim == 3 ? 1 : 0, 0)).norm(), 0, 1e-12);
    EXPECT_NEAR(beside.distance, std::sqrt(2), 1e-12);
    EXPECT_NEAR((beside.normal - Vec(1, 1, 0) / std::sqrt(2)).norm(), 0, 1e-12);
    EXPECT_NEAR((beside.velocity - Vec(0, dim == 3 ? 3 : 0, 0)).norm(), 0, 1e-12);
    EXPECT_NEAR(walls.nearest(Vec(1, -0.4, 0)).normal[1], -1, 1e-12);
    EXPECT_EQ(walls.nearest(Vec(1, 10.5, 0)).segment, -1);
    if (dim == 3) EXPECT_NEAR(walls.nearest(Vec(4, 1, 4)).distance, std::sqrt(3), 1e-12);
  }
}

/// Cells in which particles stand know the faces next to them: the answer is that of a search again, bit by
/// bit.
TEST(WallDistance, OfHeldWallsIsTheSameFromCellsThatAreKnown) {
  for (const int dim : {2, 3})
    for (const Real cell : {0.03, 0.4}) {
      test::SmallScene scene;
      scene.dim = dim, scene.n = 4;
      scene.extra = test::floor_cards(-0.07, 1) +
                    "*NODE\n9011,0.13,-2.,-2.\n9012,0.31,3.,-2.\n9013,0.31,3.,3.\n9014,0.13,-2.,3.\n"
                    "*ELEMENT_SHELL\n9002,2,9011,9012,9013,9014\n";
      const auto s = test::build(scene);
      World& world = s->world();
      for (const Real reach : {0.1, 1.0}) {
        WallDistance known({0, 1}, reach, cell, {}, world), anew({0, 1}, reach, cell, {}, world);
        known.follow(world, 1);
        const Particles& p = world.particles;
        int near = 0;
        for (Index i = 0; i < p.size(); ++i)
          for (int k = 0; k < 20; ++k) {  // in and beside its cell
            const Vec x = p.x.vec(i) + 0.013 * Vec(k % 5 - 2, k / 5 - 1.5, dim == 3 ? k % 3 - 1 : 0);
            const NearestWall a = known.nearest(x), b = anew.nearest(x);
            EXPECT_EQ(a.segment, b.segment) << x.transpose();
            EXPECT_EQ(a.distance, b.distance) << x.transpose();
            EXPECT_EQ(a.normal, b.normal);
            near += a.segment >= 0;
          }
        EXPECT_GT(near, 50);
      }
    }
}

std::string turbulence(const std::string& card1, const std::string& card2 = "") {
  return "*COURANT_TURBULENCE\n" + card1 + "\n" + (card2.empty() ? "" : card2 + "\n");
}

/// Runs until then, with the laws, too, which follow motion.
void run_whole(Simulation& s, Real until) {
  run(s, until);
  std::string who;
  s.evaluate(who);
}

struct KEpsilon {
  Real k, epsilon;
};

TEST(WallLaw, IsThatOfSmoothAndOfRoughWalls) {
  const Real nu = 1e-6, us = 0.05;
  const auto back = [&](Real plus, Real y, Real ks) { return friction_velocity(plus * us, y, nu, ks) / us; };
  EXPECT_NEAR(back(5.3 + std::log(500.) / 0.41, 500 * nu / us, 0), 1, 1e-3);  // Nikuradse, smooth
  EXPECT_NEAR(back(8.5 + std::log(40.) / 0.41, 40 * 2e-3, 2e-3), 1, 1e-2);    // fully rough
  EXPECT_NEAR(back(5, 5 * nu / us, 0), 1, 1e-12);                             // viscous sublayer
  EXPECT_EQ(friction_velocity(0, 1, nu, 0), 0);
  EXPECT_NEAR(friction_velocity(1, 1e-3, 0, 1), 0.41, 1e-12);  // the roughness swallows the distance: ln = 1
  WallFriction constant{.cf = 0.02};
  EXPECT_NEAR(friction_velocity(constant, 3, 1, 1), 0.3, 1e-12);
}

TEST(Turbulence, KAndEpsilonDecayAsTheClosedFormSays) {
  const Real k0 = 0.02, eps0 = 0.05, C2 = 1.92;
  const auto s = test::build_deck(
      layer([](Real) { return 0; }, turbulence("2", fmt::format(",,,,{},{}", k0, eps0))), false);
  run_whole(*s, 2);
  Particles& p = s->world().particles;
  const Real fallen = 1 + (C2 - 1) * eps0 * s->clock().t / k0;
  const Real k = k0 * std::pow(fallen, -1 / (C2 - 1)), epsilon = eps0 * std::pow(fallen, -C2 / (C2 - 1));
  for (Index i = 0; i < p.active; ++i) {
    ASSERT_NEAR(sph_fields::turbulent_energy(p)[i], k, 0.01 * k);
    ASSERT_NEAR(sph_fields::turbulent_dissipation(p)[i], epsilon, 0.01 * epsilon);
    ASSERT_NEAR(sph_fields::eddy_viscosity(p)[i], 0.09 * k * k / epsilon, 0.02 * 0.09 * k * k / epsilon);
  }
  EXPECT_LT(k, 0.2 * k0);
}

/// With epsilon held by a length, k is that of one equation: dk/dt = -c_mu^(3/4) k^(3/2)/LMAX.
TEST(Turbulence, EddiesNoLongerThanToldDecayAsThoseOfOneEquation) {
  const Real k0 = 0.02, length = 0.05;
  const auto s =
      test::build_deck(layer([](Real) { return 0; }, turbulence("2,,,0.05", ",,,,0.02,1e-4")), false);
  run_whole(*s, 2);
  Particles& p = s->world().particles;
  const Real c = std::pow(0.09, 0.75) / length;
  const Real k = std::pow(1 / std::sqrt(k0) + 0.5 * c * s->clock().t, -2), epsilon = c * std::pow(k, 1.5);
  for (Index i = 0; i < p.active; ++i) {
    ASSERT_NEAR(sph_fields::turbulent_energy(p)[i], k, 0.01 * k);
    ASSERT_NEAR(sph_fields::turbulent_dissipation(p)[i], epsilon, 0.02 * epsilon);
  }
  EXPECT_LT(k, 0.5 * k0);
}

/// Of a line of cells between y = -6 and 6: u, k, epsilon by finite volumes, explicit in small steps.
/// `limited`: LIMIT 1.
class Line {
 public:
  Line(int n, const std::function<Real(Real)>& u, KEpsilon start, bool limited = false)
      : n_(n), limited_(limited), dy_(12. / n) {
    for (int i = 0; i < n; ++i) u_.push_back(u(y(i)));
    k_.assign(u_.size(), start.k), e_.assign(u_.size(), start.epsilon);
  }
  Real y(int i) const { return (i + 0.5) * dy_ - 6; }
  Real t() const { return t_; }
  Real u_at(Real y) const { return at(u_, y); }
  Real k_at(Real y) const { return at(k_, y); }
  void advance(Real until) {
    while (t_ < until) step(std::min({until - t_, 2e-3, 0.2 * dy_ * dy_ / most_eddy()}));
  }
  /// Between where (u - u_low)/(u_high - u_low) squared is 0.1 and 0.9.
  Real width() const { return place(std::sqrt(0.9)) - place(std::sqrt(0.1)); }

 private:
  Real shear(int i) const {
    return std::abs(u_[std::min(i + 1, n_ - 1)] - u_[std::max(i - 1, 0)]) / (2 * dy_);
  }
  Real eddy(int i) const {
    const Real nu = 0.09 * k_[i] * k_[i] / e_[i], S = limited_ ? shear(i) : 0;
    return S > 0 ? std::min(nu, 0.3 * k_[i] / S) : nu;
  }
  Real most_eddy() const {
    Real most = 1e-6;
    for (int i = 0; i < n_; ++i) most = std::max(most, eddy(i));
    return most;
  }
  Real at(const std::vector<Real>& f, Real y) const {
    const Real s = (y + 6) / dy_ - 0.5;
    const int i = std::clamp(static_cast<int>(std::floor(s)), 0, n_ - 2);
    return f[i] + (s - i) * (f[i + 1] - f[i]);
  }
  Real place(Real share) const {
    const Real level = u_.front() + share * (u_.back() - u_.front());
    int i = 0;
    while (u_[i + 1] < level) ++i;
    return y(i) + dy_ * (level - u_[i]) / (u_[i + 1] - u_[i]);
  }
  void step(Real dt) {
    std::vector<Real> du(n_, 0), dk(n_, 0), de(n_, 0);
    for (int i = 0; i + 1 < n_; ++i) {
      const Real nu = 0.5 * (eddy(i) + eddy(i + 1)) * dt / (dy_ * dy_);
      const auto flow = [&](std::vector<Real>& d, const std::vector<Real>& f, Real sigma) {
        const Real q = nu / sigma * (f[i + 1] - f[i]);
        d[i] += q, d[i + 1] -= q;
      };
      flow(du, u_, 1), flow(dk, k_, 1), flow(de, e_, 1.3);
    }
    for (int i = 0; i < n_; ++i) {
      const Real S = shear(i);
      const Real P = std::min(eddy(i) * S * S, 0.3 * k_[i] * S), per_k = e_[i] / k_[i];
      dk[i] += dt * (P - e_[i]), de[i] += dt * per_k * (1.44 * P - 1.92 * e_[i]);
    }
    for (int i = 0; i < n_; ++i)
      u_[i] += du[i], k_[i] = std::max(k_[i] + dk[i], 1e-9), e_[i] = std::max(e_[i] + de[i], 1e-12);
    t_ += dt;
  }
  int n_;
  bool limited_;
  Real dy_, t_ = 0;
  std::vector<Real> u_, k_, e_;
};

TEST(Turbulence, AUniformShearFeedsKAsTheEquationsSay) {
  const Real shear = 0.5;
  const KEpsilon start{0.01, 0.004};
  const auto u = [&](Real y) { return shear * y; };
  const auto s =
      test::build_deck(layer(u, turbulence("2", fmt::format(",,,,{},{}", start.k, start.epsilon))), false);
  Real k = start.k, e = start.epsilon;
  const Real dt = 1e-3;
  for (int step = 0; step < 3000; ++step) {
    const Real P = std::min(0.09 * k * k / e * shear * shear, 0.3 * k * shear), per_k = e / k;
    k += dt * (P - e), e += dt * per_k * (1.44 * P - 1.92 * e);
  }
  run_whole(*s, 3);
  Particles& p = s->world().particles;
  int seen = 0;
  for (Index i = 0; i < p.active; ++i) {
    if (std::abs(p.x.vec(i)[1]) > 3) continue;  // mirrors turn the shear round
    ++seen;
    ASSERT_NEAR(sph_fields::turbulent_energy(p)[i], k, 0.02 * k);
    ASSERT_NEAR(sph_fields::turbulent_dissipation(p)[i], e, 0.02 * e);
  }
  EXPECT_GT(seen, 200);
}

class MixingLayer : public testing::TestWithParam<bool> {};

TEST_P(MixingLayer, GrowsAsOnALine) {
  const bool limited = GetParam();  // LIMIT 1; |S| k/epsilon begins at 5, the limit is from 10/3 on
  const auto u = [](Real y) { return std::tanh(y); };
  const KEpsilon start{0.1, 0.02};
  const auto s = test::build_deck(
      layer(u, turbulence("2", fmt::format(",,,,{},{},{}", start.k, start.epsilon, limited ? 1 : 0))), false);
  Line line(240, u, start, limited);
  run_whole(*s, 6), line.advance(s->clock().t);
  const Particles& p = s->world().particles;
  std::array<Real, 24> error{}, change{}, count{};  // by height, since particles get out of their rows
  for (Index i = 0; i < p.active; ++i) {
    const Real y = p.x.vec(i)[1];
    const auto bin = static_cast<std::size_t>(std::clamp((y + 6) * 2, Real(0), Real(23)));
    error[bin] += p.v.vec(i)[0] - line.u_at(y), change[bin] += line.u_at(y) - u(y), ++count[bin];
  }
  Real largest_error = 0, largest_change = 0;
  for (std::size_t bin = 0; bin < count.size(); ++bin) {
    largest_error = std::max(largest_error, std::abs(error[bin] / count[bin]));
    largest_change = std::max(largest_change, std::abs(change[bin] / count[bin]));
  }
  // Rows that slide along each other in order keep a ripple of 1 % and less.
  EXPECT_LT(largest_error, 0.02);
  EXPECT_GT(largest_change, limited ? 0.12 : 0.15);
  for (Index i = 0; i < p.active; ++i) {
    const Real k = line.k_at(p.x.vec(i)[1]);
    EXPECT_NEAR(sph_fields::turbulent_energy(s->world().particles)[i], k, 0.02 * k);
  }
  const EnergyLedger e = s->sample("").energy;
  EXPECT_NEAR(e.residual(), 0, 0.01 * e.dissipated);
}
INSTANTIATE_TEST_SUITE_P(ProductionAndStress, MixingLayer, testing::Values(false, true));

TEST(Turbulence, LimitedStressIsAShareOfK) {
  const Real shear = 0.5;
  const auto s =
      test::build_deck(layer([&](Real y) { return shear * y; }, turbulence("2", ",,,,0.01,0.001,1")), false);
  run_whole(*s, 0.05);
  Particles& p = s->world().particles;
  int seen = 0;
  for (Index i = 0; i < p.active; ++i) {
    if (std::abs(p.x.vec(i)[1]) > 3) continue;
    const Real k = sph_fields::turbulent_energy(p)[i];
    ASSERT_NEAR(sph_fields::eddy_viscosity(p)[i], 0.3 * k / shear, 0.01 * k / shear);  // not 0.09 k^2/epsilon
    ++seen;
  }
  EXPECT_GT(seen, 200);
}

TEST(Turbulence, OfKEpsilonHasTheGrowthOfAMixingLayerInBooks) {
  Line line(500, [](Real y) { return std::tanh(y / 0.1); }, {0.05, 0.1});
  line.advance(8);
  const Real early = line.width(), t = line.t();
  line.advance(14);
  // d delta/dx = 0.098 of a stream beside still water (Pope 2000, table 10.1) is 0.098 of half the difference
  // of speeds in time
  EXPECT_NEAR((line.width() - early) / (line.t() - t), 0.098, 0.0098);
}

class Algebraic : public testing::TestWithParam<bool> {};

TEST_P(Algebraic, ModelsHaveTheirLengths) {
  const bool smagorinsky = GetParam();
  const Real shear = 0.5, l = smagorinsky ? 0.17 * jet_dx : 0.4;
  const auto s = test::build_deck(
      layer([&](Real y) { return shear * y; }, turbulence(smagorinsky ? "3" : "1,0.09,0.41,0.4")), false);
  run(*s, 1e-6);
  Particles& p = s->world().particles;
  const Real nu = (smagorinsky ? 1 : 0.09) * l * l * shear;
  for (Index i = 0; i < p.active; ++i)
    if (std::abs(p.x.vec(i)[1]) < 5) ASSERT_NEAR(sph_fields::eddy_viscosity(p)[i], nu, 0.005 * nu);
}
INSTANTIATE_TEST_SUITE_P(MixingLengthAndSmagorinsky, Algebraic, testing::Values(false, true));

/// An open channel of `rows` rows over a floor of shells, depth 1, periodic along x, driven by gravity along
/// it as strong as u* = 1 asks; from the logarithmic law.
std::string open_channel(int rows, Real ks, const std::string& model) {
  const Real dx = 1. / rows, H = 1;
  const int columns = 6;
  const auto u = [&](Real y) { return std::log(32.6 * y / ks) / 0.41; };
  std::string text = fmt::format(
      "*KEYWORD\n*CONTROL_TERMINATION\n50.\n*CONTROL_SPH\n1,0,1e20,2\n*PART\nwater\n1,1,1,1,1\n"
      "*SECTION_SPH\n1,1.2,1,1\n*MAT_NULL\n1,1000.0,-1e20\n*EOS_LINEAR_POLYNOMIAL\n1,0,1.44e7\n\n"
      "*HOURGLASS\n1,0,0,0,1e-20,1e-20\n*PART\nfloor\n2,2,2\n*MAT_RIGID\n2,7850,2.1e11,0.3\n1,7,7\n0\n"
      "*SECTION_SHELL\n2,2\n{0},{0},{0},{0}\n*DEFINE_VECTOR\n1,0,0,0,1,0,0\n2,{1},0,0,0,0,0\n"
      "*BOUNDARY_SPH_PERIODIC\n1,2\n*LOAD_BODY_Y\n1,1\n*LOAD_BODY_X\n2,1\n*DEFINE_CURVE\n1\n0,50\n1e9,50\n"
      "*DEFINE_CURVE\n2\n0,-1\n1e9,-1\n*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0,0,0,0,0,0,0,1e20\n"
      "10,1000\n0,0.1,0,1.025,2,2,0,1\n*COURANT_DENSITY_DIFFUSION\n0.1\n"
      "*COURANT_WALL_SUPPORT\n2,3,0,0,1,{2}\n",
      dx, columns * dx, ks);
  text += model + "*NODE\n";
  std::string more = "*ELEMENT_SPH\n", v = "*INITIAL_VELOCITY_NODE\n", p = "*INITIAL_STRESS_SPH\n";
  int id = 0;
  for (int row = 0; row < rows; ++row)
    for (int c = 0; c < columns; ++c) {
      const Real y = (row + 0.5) * dx, pressure = 1000 * 50 * (H - y);
      text += fmt::format("{},{:.12g},{:.12g},0\n", ++id, (c + 0.5) * dx, y);
      more += fmt::format("{},1,{:.12g}\n", id, 1000 * dx * dx);
      v += fmt::format("{},{:.12g}\n", id, u(y));
      p += fmt::format("{0},{1:.8g},{1:.8g},{1:.8g}\n", id, -pressure);
    }
  std::string shells = "*ELEMENT_SHELL\n";
  for (int c = 0; c < columns + 5; ++c) {
    const int n = id + 1 + 2 * c;
    text += fmt::format("{},{:.12g},0,{:.12g}\n{},{:.12g},0,{:.12g}\n", n, (c - 2) * dx, -dx / 2, n + 1,
                        (c - 2) * dx, dx / 2);
    if (c < columns + 4) shells += fmt::format("{},2,{},{},{},{}\n", c + 1, n, n + 2, n + 3, n + 1);
  }
  return text + more + shells + v + p + "*END\n";
}

// The law of the wall up to a fifth of the depth; above it k-epsilon itself differs by up to 5 %.
TEST(Turbulence, AChannelOverARoughBedKeepsTheLogarithmicLaw) {
  const Real ks = 0.01;
  const auto s = test::build_deck(open_channel(20, ks, turbulence("2", ",,,,3.,5.")), false);
  run(*s, 0.7);
  const Particles& p = s->world().particles;
  int low = 0;
  for (Index i = 0; i < p.active; ++i) {
    const Real y = p.x.vec(i)[1], u = p.v.vec(i)[0];
    if (y > 0.2) continue;
    ++low;
    EXPECT_NEAR(u, std::log(32.6 * y / ks) / 0.41, 0.03 * u) << y;
  }
  EXPECT_EQ(low, 24);
}

TEST(Turbulence, LengthsEndAtTheNearestWallAndAtTheSurface) {
  const auto s = test::build_deck(open_channel(20, 0.01, turbulence("1,0.09,0.41,0.2,0.15")), false);
  run(*s, 1e-9);
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.active; ++i) {
    const Real y = p.x.vec(i)[1], nu = sph_fields::eddy_viscosity(p)[i];
    const Real l = std::min(0.41 * y, 0.2), shear = 1 / (0.41 * y);
    if (y > 0.2 && y < 0.8) EXPECT_NEAR(nu, 0.09 * l * l * shear, 0.04 * nu) << y;
    if (y > 0.96) EXPECT_LT(nu, 0.02 * 0.09 * 0.04 * shear) << y;
  }
}

TEST(Turbulence, EddiesAtTheSurfaceAreNoLongerThanTold) {
  const Real ls = 0.07, ks = 0.01;
  const auto s = test::build_deck(open_channel(20, ks, turbulence("2", ",,,,3.,5.,0,0.07")), false);
  const auto free = test::build_deck(open_channel(20, ks, turbulence("2", ",,,,3.,5.")), false);
  run_whole(*s, 0.02), run_whole(*free, 0.02);
  Particles &p = s->world().particles, &q = free->world().particles;
  for (Index i = 0; i < p.active; ++i) {
    const Real y = p.x.vec(i)[1], k = sph_fields::turbulent_energy(p)[i];
    const Real length = std::pow(0.09, 0.75) * std::pow(k, 1.5) / sph_fields::turbulent_dissipation(p)[i];
    if (y > 0.96) EXPECT_NEAR(length, ls, 1e-6) << y;
    if (y < 0.5)
      EXPECT_NEAR(sph_fields::turbulent_dissipation(p)[i], sph_fields::turbulent_dissipation(q)[i],
                  1e-3 * sph_fields::turbulent_dissipation(q)[i])
          << y;
  }
}

TEST(Turbulence, HasTheSameBitsOnAnyThreadsAndAfterARestart) {
  const auto u = [](Real y) { return std::tanh(y) + 0.01 * std::sin(9 * y); };
  for (const char* model : {"1,0.09,0.41,0.4,0.15", "3"})
    test::expect_same_bits(layer(u, turbulence(model)), 60, 25);
  test::expect_same_bits(layer(u, turbulence("2", ",,,,0.1,0.02")), 60, 25);
  test::expect_same_bits(open_channel(20, 0.01, turbulence("2", ",,,,3.,5.,1,0.07")), 60, 25);
}
}  // namespace
}  // namespace courant
