// *MAT_SAMP-1 against its tests: tension, compression, shear, biaxial tension, in space and in the plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "driven_point.hpp"
#include "law_from_cards.hpp"

namespace samp_test {

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

namespace {

constexpr Real E = 2000, nu = 0.4, G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));
Real T(Real e) {
  return 40 + 30 * e;
}
Real C(Real e) {
  return 55 + 20 * e;
}
Real S(Real e) {
  return 28 + 20 * e;
}
Real B(Real e) {
  return 37 + 15 * e;
}
const std::string curves =
    "*DEFINE_CURVE\n1\n0.0,40.0\n1.0,70.0\n*DEFINE_CURVE\n2\n0.0,55.0\n1.0,75.0\n*DEFINE_CURVE\n3\n0.0,28.0\n"
    "1.0,48.0\n*DEFINE_CURVE\n4\n0.0,37.0\n1.0,52.0\n";
std::string samp(const std::string& tests, Real nuep, const std::string& rest = "\n", Real rbcfac = 0) {
  return fmt::format("1,1.2e-9,0,0,{},{},{}\n{},{}\n{}{}", E, nu, rbcfac, tests, nuep, rest, curves);
}
std::shared_ptr<StrengthLaw> law(const std::string& cards) {
  return law_from_cards("MAT_SAMP-1", cards);
}
enum class Kind { tension, compression, shear, biaxial_tension, biaxial_compression };

struct Drawn {
  Real stress, strain, across;  ///< plastic strains along and across the test
};
/// `steps` of a test with strains of `size`; `across`: about the Poisson ratio.
Drawn drawn(DrivenPoint& point, Kind test, int steps, Real size, Real across = nu) {
  const Real sign = test == Kind::compression || test == Kind::biaxial_compression ? -1 : 1;
  std::array<Real, 6> sum{};
  for (int k = 0; k < steps; ++k) {
    std::array<Real, 6> step{};
    std::vector<std::size_t> free;
    if (test == Kind::shear) {
      step[3] = size;
    } else if (test == Kind::tension || test == Kind::compression) {
      step = {sign * size, -across * sign * size, -across * sign * size};
      free = {1, 2};
    } else {
      step = {sign * size, sign * size, -2 * across / (1 - across) * sign * size};
      free = {2};
    }
    if (point.plane && !free.empty()) free.pop_back();
    step = free.empty() ? (point.strain(step), step) : point.strain_with_free(step, free);
    if (point.plane) step[2] = point.rate_zz;
    for (std::size_t c = 0; c < 6; ++c) sum[c] += step[c];
  }
  if (test == Kind::shear) return {point.stress[3], sum[3] - point.stress[3] / (2 * G), 0};
  const Real s = point.stress[0];
  if (test == Kind::tension || test == Kind::compression)
    return {sign * s, sign * (sum[0] - s / E), sign * (sum[2] + nu * s / E)};
  return {sign * s, sign * (sum[0] - (1 - nu) * s / E), sign * (sum[2] + 2 * nu * s / E)};
}

/// A test strained to a plastic strain of its own bears `stress` of it, and nothing across.
void expect_bears(const std::string& cards, Kind test, const std::function<Real(Real)>& stress, Real ratio) {
  for (const bool plane : {false, true}) {
    DrivenPoint point(law(cards), plane);
    std::array<Real, 6> old{};
    for (int k = 0; k <= 40; ++k) {
      const Real own = 2e-3 * k, s = stress(own);
      std::array<Real, 6> now{}, bears{};
      Real e = own;
      if (test == Kind::shear) {
        now[3] = own + s / (2 * G), bears[3] = s, e = std::sqrt(3.0) / (1 + ratio) * own;
      } else if (test == Kind::tension || test == Kind::compression) {
        const Real sign = test == Kind::tension ? 1 : -1, across = -sign * (ratio * own + nu * s / E);
        now = {sign * (own + s / E), across, across}, bears[0] = sign * s;
      } else {
        const Real sign = test == Kind::biaxial_tension ? 1 : -1, along = sign * (own + (1 - nu) * s / E);
        e = own / (1 - ratio);
        now = {along, along, -sign * 2 * (ratio * e + nu * s / E)}, bears[0] = bears[1] = sign * s;
      }
      std::array<Real, 6> step = now;
      for (std::size_t c = 0; c < 6; ++c) step[c] -= old[c];
      point.strain(step);
      for (std::size_t c = 0; c < 6; ++c)
        EXPECT_NEAR(point.stress[c], bears[c], 1e-8 * s) << cards << int(test) << plane << k << " " << c;
      EXPECT_NEAR(point.of("plastic_strain"), e, 1e-10);
      if (plane) {
        EXPECT_NEAR(point.rate_zz, step[2], 1e-10);
      }
      old = now;
    }
  }
}

}  // namespace

// Each given curve is met in its own test, with the plastic Poisson ratio of the card across.
TEST(Samp, BearsWhatItsTestsDid) {
  for (const Real r : {0.2, 0.3, 0.5}) {
    for (const char* given : {"1", "1,2", "1,0,3", "1,0,0,4", "1,2,3", "1,2,0,4", "1,0,3,4", "1,2,3,4"}) {
      const std::string name = given;
      const bool has_c = name.find('2') != std::string::npos, has_s = name.find('3') != std::string::npos,
                 has_b = name.find('4') != std::string::npos;
      std::string tests = name;
      for (auto commas = std::count(name.begin(), name.end(), ','); commas < 3; ++commas) tests += ",0";
      const std::string cards = samp(tests, r, "\n", has_c && has_s && has_b ? 1.1 : 0);
      expect_bears(cards, Kind::tension, T, r);
      if (has_c) expect_bears(cards, Kind::compression, C, r);
      if (has_s) expect_bears(cards, Kind::shear, S, r);
      if (has_b) expect_bears(cards, Kind::biaxial_tension, B, r);
    }
  }
}

// What follows for the other tests: von Mises of tension alone; q straight over p of two tests; the biaxial
// compression of four.
TEST(Samp, OtherTestsFollow) {
  const Real r = 0.5, root3 = std::sqrt(3.0);
  expect_bears(samp("1,0,0,0", r), Kind::compression, T, r);
  expect_bears(
      samp("1,0,0,0", r), Kind::biaxial_tension, [](Real e) { return T(2 * e); }, r);
  expect_bears(
      samp("1,0,0,0", r), Kind::shear, [&](Real e) { return T(e * root3 / 1.5) / root3; }, r);
  expect_bears(
      samp("1,2,0,0", r), Kind::shear,
      [&](Real s) {
        const Real e = s * root3 / 1.5, t = T(e), c = C(e);
        return 2 * t * c / (root3 * (t + c));
      },
      r);
  expect_bears(
      samp("1,0,3,0", r), Kind::compression,
      [&](Real e) {
        const Real t = T(e), s = S(1.5 / root3 * e);
        return root3 * t * s / (2 * t - root3 * s);
      },
      r);
  expect_bears(
      samp("1,0,0,4", r), Kind::compression,
      [&](Real e) {
        const Real t = T(e), b = B(0.5 * e);
        return t * b / (3 * b - 2 * t);
      },
      r);
  expect_bears(
      samp("1,2,3,4", r, "\n", 1.1), Kind::biaxial_compression, [](Real e) { return 1.1 * C(2 * e); }, r);
}

// On any path q^2 = A0 + A1 p + A2 p^2 by the formulae of Kolling et al., and the plastic strain is along the
// normal of q^2 + alpha p^2.
TEST(Samp, FlowsAlongItsPotential) {
  const Real r = 0.2, alpha = 4.5 * (1 - 2 * r) / (1 + r);
  DrivenPoint point(law(samp("1,2,3,0", r)));
  std::array<Real, 6> old{};
  int flown = 0;
  for (int k = 0; k < 300; ++k) {
    const Real a = 0.05 * k;
    const std::array<Real, 6> step = {4e-3 * std::cos(a),        3e-3 * std::sin(1.7 * a),
                                      -2e-3 * std::sin(0.6 * a), 2e-3 * std::sin(0.9 * a),
                                      1e-3 * std::cos(1.3 * a),  -1e-3 * std::sin(a)};
    const Real before = point.of("plastic_strain");
    point.strain(step);
    const Real e = point.of("plastic_strain");
    const auto& s = point.stress;
    const Real p = -(s[0] + s[1] + s[2]) / 3, d_p = -(old[0] + old[1] + old[2]) / 3;
    Real q = 0;
    for (std::size_t c = 0; c < 6; ++c) {
      const Real dev = s[c] + (c < 3 ? p : 0);
      q += (c < 3 ? 1.5 : 3) * dev * dev;
    }
    q = std::sqrt(q);
    if (e > before) {
      ++flown;
      const Real t = T(e), c = C(e), sh = S((1 + r) / std::sqrt(3.0) * e);
      const Real A0 = 3 * sh * sh, A1 = 9 * sh * sh * (c - t) / (c * t),
                 A2 = 9 * (c * t - 3 * sh * sh) / (c * t);
      EXPECT_NEAR(q * q, A0 + A1 * p + A2 * p * p, 1e-8 * A0) << k;
      const Real k_flow = (e - before) * (1 + r) / 1.5 / q;  // of the deviator over q
      const Real trace = step[0] + step[1] + step[2] + (p - d_p) / K;
      EXPECT_NEAR(trace, -alpha * p * k_flow, 1e-10) << k;
      for (std::size_t j = 0; j < 6; ++j) {
        const Real mean = j < 3 ? (step[0] + step[1] + step[2]) / 3 : 0;
        const Real dev = s[j] + (j < 3 ? p : 0), old_dev = old[j] + (j < 3 ? d_p : 0);
        EXPECT_NEAR(step[j] - mean - (dev - old_dev) / (2 * G), 1.5 * dev * k_flow, 1e-10) << k << " " << j;
      }
    }
    old = s;
  }
  EXPECT_GT(flown, 60);
}

// A path in the plane is that in space with the stress across at 0.
TEST(Samp, PlaneStressIsThatOfSpace) {
  for (const char* tests : {"1,2,3,0", "1,2,0,0", "1,0,0,0"}) {
    const auto cards = samp(tests, 0.3, "0,0.3,0.2\n");
    DrivenPoint plane(law(cards), true), space(law(cards));
    for (int k = 0; k < 200; ++k) {
      const Real a = 0.07 * k;
      const std::array<Real, 6> step = {
          3e-3 * std::cos(a),       3e-3 * std::sin(1.7 * a), 0,
          2e-3 * std::sin(0.9 * a), 5e-4 * std::cos(a),       5e-4 * std::sin(2 * a)};
      plane.strain(step);
      std::array<Real, 6> full = step;
      full[2] = plane.rate_zz;
      space.strain(full);
      for (std::size_t j = 0; j < 6; ++j) EXPECT_NEAR(plane.stress[j], space.stress[j], 1e-9) << tests << k;
      for (std::size_t h = 0; h < plane.history.size(); ++h)
        EXPECT_NEAR(plane.history[h], space.history[h], 1e-11) << k;
    }
    EXPECT_GT(plane.of("plastic_strain"), 0.1);
  }
}

// Blown up without a change of volume in flow (NUEP 1/2) it bears the pressure of the tip; of a cone -2 t
// c/(3 (c - t)).
TEST(Samp, TipsBoundTension) {
  for (const Real r : {0.0, 0.45, 0.5}) {
    DrivenPoint cone(law(samp("1,2,0,0", r))), ball(law(samp("1,2,3,0", r)));
    for (int k = 0; k < 100; ++k)
      for (DrivenPoint* p : {&cone, &ball}) p->strain({1e-3, 1e-3, 1e-3, 0, 0, 0});
    EXPECT_NEAR(cone.stress[0], 2 * 40 * 55 / (3 * 15.0), 1e-8) << r;
    const Real A0 = 3 * 28 * 28, A1 = 9 * 28 * 28 * 15 / 2200.0, A2 = 9 * (2200 - A0) / 2200;
    EXPECT_NEAR(ball.stress[0], 2 * A0 / (A1 + std::sqrt(A1 * A1 - 4 * A0 * A2)), 1e-8) << r;
    EXPECT_NEAR(cone.of("plastic_strain"), 0, 1e-12);
    EXPECT_NEAR(cone.stress[3], 0, 1e-12);
  }
}

// LCID-P: the ratio of the strain at the start of the step; strains of shear are its integral.
TEST(Samp, PlasticRatioFollowsItsCurve) {
  DrivenPoint sheared(law(fmt::format(
      "1,1.2e-9,0,0,{},{}\n1,2,3,0,0,9\n\n*DEFINE_CURVE\n9\n0.0,0.5\n0.1,0.1\n{}", E, nu, curves)));
  const Drawn d = drawn(sheared, Kind::shear, 2000, 1e-4);
  const Real e = sheared.of("plastic_strain");
  EXPECT_GT(e, 0.12);
  const Real at = (e + 0.03 + 0.1 * (e - 0.1)) / std::sqrt(3.0);
  EXPECT_NEAR(d.stress, S(at), 1e-9);
  EXPECT_NEAR(d.strain, at, 1e-4);  // ratios of the starts of steps
}

// A table over the plastic rate, straight and over its logarithm; compression by the same factor.
TEST(Samp, RatesRaiseAllTestsAlike) {
  const std::string table = "*DEFINE_CURVE\n5\n0.0,60.0\n1.0,105.0\n";  // 1.5 T
  for (const bool logarithmic : {false, true}) {
    const std::string by_rate =
        logarithmic ? "*DEFINE_TABLE_2D\n6\n-4.0,1\n2.0,5\n" : "*DEFINE_TABLE_2D\n6\n0.0,1\n10.0,5\n";
    for (const Kind test : {Kind::tension, Kind::compression, Kind::shear}) {
      DrivenPoint point(law(samp("6,2,3,0", 0.3, "\n" + table + by_rate)));
      point.dt = 1e-3;
      drawn(point, test, 100, 1e-3);
      const Real before = point.of("plastic_strain");
      drawn(point, test, 1, 1e-3);
      const Real e = point.of("plastic_strain"), rate = (e - before) / 1e-3;
      const Real share = logarithmic ? (std::log(rate) + 4) / 6 : rate / 10;
      EXPECT_GT(rate, 0.5);
      const Real rest = test == Kind::tension       ? T(e)
                        : test == Kind::compression ? C(e)
                                                    : S(1.3 / std::sqrt(3.0) * e);
      EXPECT_NEAR(std::abs(point.stress[test == Kind::shear ? 3 : 0]), rest * (1 + 0.5 * share), 1e-7 * rest);
    }
  }
}

// LCID-D > 0: (1 - D) of the curves; < 0: the curves themselves. Both spring back with (1 - D) E.
TEST(Samp, DamageWeakens) {
  const std::string damage = "*DEFINE_CURVE\n8\n0.02,0.0\n0.12,0.5\n";
  for (const bool plane : {false, true})
    for (const int sign : {1, -1}) {
      DrivenPoint point(law(samp("1,2,3,0", 0.3, fmt::format("{}\n", 8 * sign) + damage)), plane);
      const Drawn d = drawn(point, Kind::tension, 100, 1e-3);
      const Real e = point.of("plastic_strain"), D = std::min(5 * (e - 0.02), 0.5);
      EXPECT_GT(D, 0.1);
      EXPECT_NEAR(d.stress, (sign > 0 ? 1 - D : 1) * T(e), 1e-6);
      drawn(point, Kind::tension, 1, -1e-4);
      EXPECT_NEAR(d.stress - point.stress[0], (1 - D) * E * 1e-4, 1e-8);
    }
}

// From EPFAIL on the stress fades over DEPRPT; sizes, rates and states of stress scale EPFAIL.
TEST(Samp, FailsAndFades) {
  const std::string factors =
      "*DEFINE_CURVE\n11\n-1.0,0.5\n1.0,0.5\n*DEFINE_CURVE\n12\n1.0,1.0\n3.0,0.5\n*DEFINE_CURVE\n13\n0.0,0."
      "1\n1.0,"
      "0.1\n*DEFINE_CURVE\n14\n-0.4,0.6\n0.0,1.0\n0.4,2.0\n";
  const auto path = [&](const std::string& third, Kind test, Real limit, Real fade, Real size = 2) {
    DrivenPoint point(law(samp("1,2,3,0", 0.3, third + factors)));
    if (point.history.size() > 2) point.history[2] = size;
    bool gone = false;
    for (int k = 0; k < 400 && !gone; ++k) {
      drawn(point, test, 1, 1e-3);
      const Real e = point.of("plastic_strain"), s = std::abs(point.stress[test == Kind::shear ? 3 : 0]),
                 whole = test == Kind::tension       ? T(e)
                         : test == Kind::compression ? C(e)
                                                     : S(1.3 / std::sqrt(3.0) * e);
      const Real faded = fade > 0 ? std::clamp((e - limit) / fade, 0.0, 1.0) : 0;
      if (e > 0.002) {
        EXPECT_NEAR(s, (1 - faded) * whole, 1e-5 * whole) << third << k;
      }
      gone = point.of("failure_ratio") >= point.law->failure_limit();
      EXPECT_EQ(gone, e >= limit + fade) << third << e;
    }
    EXPECT_TRUE(gone);
  };
  path("0,0.1,0.04\n", Kind::tension, 0.1, 0.04);
  path("0,0.1\n", Kind::compression, 0.1, 0);
  path("0,-13,0.04\n", Kind::shear, 0.1, 0.04);
  path("0,0.1,0.04,0,12\n", Kind::tension, 0.075, 0.04);
  path("0,0.1,0.04,11\n0,0,0,1\n", Kind::tension, 0.05, 0.04);
  // at p/q -1/3, 0, 1/3
  path("0,0.1,0.04,14\n0,0,0,1\n", Kind::tension, 0.1 * (0.6 + 0.4 / 6), 0.04);
  path("0,0.1,0.04,14\n0,0,0,1\n", Kind::shear, 0.1, 0.04);
  path("0,0.1,0.04,14\n0,0,0,1\n", Kind::compression, 0.1 * (1 + 1 / 1.2), 0.04);
  const auto never = law(samp("1,2,3,0", 0.3, "0,0.1\n0,0,0,-1\n"));
  EXPECT_EQ(never->failure_limit(), std::numeric_limits<Real>::infinity());
  EXPECT_EQ(never->history().size(), 1u);
}

// ICONV 1: shear of at least ASAF sqrt(t c/3).
TEST(Samp, ShearIsRaisedUntilConvex) {
  const std::string cards = samp("1,2,7,0", 0.5, "\n0,0,0,0,1,1.05\n*DEFINE_CURVE\n7\n0.0,20.0\n1.0,25.0\n");
  expect_bears(cards, Kind::tension, T, 0.5);
  expect_bears(cards, Kind::compression, C, 0.5);
  expect_bears(
      cards, Kind::shear,
      [](Real s) {
        const Real e = s * std::sqrt(3.0) / 1.5;
        return 1.05 * std::sqrt(T(e) * C(e) / 3);
      },
      0.5);
}

}  // namespace samp_test
