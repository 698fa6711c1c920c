// *MAT_WINFRITH_CONCRETE against closed forms: surface, cracks, compaction, rates, units.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "driven_point.hpp"
#include "law_from_cards.hpp"
#include "laws/materials/ottosen_surface.hpp"

namespace winfrith_test {

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

namespace {

constexpr Real E = 30e3, nu = 0.2, fc = 30, ft = 3, K = E / 1.8, G = E / 2.4, M = K + 4 * G / 3;
/// In t, mm, s. `fe` of RATE.
std::shared_ptr<StrengthLaw> concrete(Real fe, int rate = 1, const std::string& points = "\n\n") {
  return law_from_cards("MAT_WINFRITH_CONCRETE", fmt::format("1,2.4e-9,{},{},{},{},{},8.0\n,,,,{},-4\n{}", E,
                                                             nu, fc, ft, fe, rate, points));
}
/// A point in an element of this size.
DrivenPoint point(const std::shared_ptr<StrengthLaw>& law, Real size = 25) {
  DrivenPoint out(law);
  out.dt = 1;
  for (std::size_t k = 0; k < out.names.size(); ++k)
    if (out.names[k] == element_size) out.history[out.first[k]] = size;
  return out;
}
Real pressure(const DrivenPoint& p) {
  return -(p.stress[0] + p.stress[1] + p.stress[2]) / 3;
}
/// 0 on Ottosen's surface.
Real beyond(const OttosenSurface& S, const DrivenPoint& p, Real strength) {
  Matrix s;
  const auto& t = p.stress;
  s << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  const Real I1 = s.trace() / strength;
  s -= s.trace() / 3 * Matrix::Identity();
  const Real J2 = 0.5 * s.squaredNorm(), cosine = 1.5 * std::sqrt(3.0) * s.determinant() / std::pow(J2, 1.5);
  const Real angle = std::acos(std::clamp(S.k2 * std::abs(cosine), -1.0, 1.0)) / 3;
  const Real lambda = S.k1 * (cosine >= 0 ? std::cos(angle) : std::cos(pi / 3 - angle));
  return S.a * J2 / (strength * strength) + lambda * std::sqrt(J2) / strength + S.b * I1 - 1;
}
/// A bar longer by `step` whose sides are free.
void stretch(DrivenPoint& p, Real step) {
  const auto stress = p.stress;
  const auto history = p.history;
  Real low = -2 * std::abs(step), high = -low;
  for (int k = 0; k < 45; ++k) {
    const Real x = 0.5 * (low + high);
    p.stress = stress, p.history = history;
    p.strain({step, x, x, 0, 0, 0});
    (p.stress[1] > 0 ? high : low) = x;
  }
}
/// What a bar bears at most.
Real most_of_bar(DrivenPoint& bar, Real step, int steps) {
  Real most = 0;
  for (int n = 0; n < steps; ++n) {
    stretch(bar, step);
    most = std::max(most, std::abs(bar.stress[0]));
  }
  return most;
}

}  // namespace

// Ottosen 1977, table 1: the four numbers for three ratios of strengths.
TEST(Winfrith, SurfaceHasTheNumbersOfThePaper) {
  struct Row {
    Real ratio, a, b, k1, k2;
  };
  for (const Row& row : {Row{0.08, 1.8076, 4.0962, 14.4863, 0.9914},
                         {0.10, 1.2759, 3.1962, 11.7365, 0.9801},
                         {0.12, 0.9218, 2.5969, 9.9110, 0.9647}}) {
    const OttosenSurface S(row.ratio);
    EXPECT_NEAR(S.a, row.a, 1e-3 * row.a);
    EXPECT_NEAR(S.b, row.b, 1e-3 * row.b);
    EXPECT_NEAR(S.k1, row.k1, 1e-3 * row.k1);
    EXPECT_NEAR(S.k2, row.k2, 1e-3 * row.k2);
  }
}

TEST(Winfrith, BarsBearTheirStrengths) {
  const auto law = concrete(0.1);
  DrivenPoint pressed = point(law), torn = point(law);
  EXPECT_NEAR(most_of_bar(pressed, -1e-5, 400), fc, 2e-4 * fc);
  EXPECT_NEAR(-pressed.stress[0], fc, 2e-4 * fc);  // and go on to bear it
  EXPECT_NEAR(most_of_bar(torn, 1e-6, 400), ft, 0.012 * ft);
  // two sides pressed alike: 1.16
  DrivenPoint plate = point(law);
  for (int n = 0; n < 300; ++n) {
    const auto stress = plate.stress;
    const auto history = plate.history;
    Real low = -1e-4, high = 1e-4;
    for (int k = 0; k < 45; ++k) {
      const Real x = 0.5 * (low + high);
      plate.stress = stress, plate.history = history;
      plate.strain({-1e-5, -1e-5, x, 0, 0, 0});
      (plate.stress[2] > 0 ? high : low) = x;
    }
  }
  EXPECT_NEAR(-plate.stress[0], 1.16 * fc, 2e-4 * fc);
}

// Volume held after it was pressed: s on the surface of that pressure, in triaxial compression, extension and
// shears.
TEST(Winfrith, FlowsOnTheSurface) {
  const auto law = concrete(0.1);
  const OttosenSurface S(ft / fc);
  for (const Real first : {0.0008, 0.004, 0.02})
    for (const std::array<Real, 6>& step : {std::array<Real, 6>{-2e-5, 1e-5, 1e-5, 0, 0, 0},
                                            {2e-5, -1e-5, -1e-5, 0, 0, 0},
                                            {0, 0, 0, 1e-5, 2e-5, 0},
                                            {2e-5, -1e-5, -1e-5, 3e-5, 0, 1e-5}}) {
      DrivenPoint p = point(law);
      p.strain({-first / 3, -first / 3, -first / 3, 0, 0, 0});
      const Real before = pressure(p);
      for (int n = 0; n < 3000; ++n) p.strain(step);
      EXPECT_GT(p.of("plastic_strain"), 0);
      if (p.of("cracks") > 0) continue;  // shear beside little pressure
      EXPECT_NEAR(beyond(S, p, fc), 0, 1e-9);
      EXPECT_NEAR(pressure(p), before, 1e-9);
    }
}

// Torn with the sides held: M (strain - e) is what a crack of strain e bears, by its size.
TEST(Winfrith, CracksFollowTheirCurve) {
  for (const int rate : {1, 0})
    for (const Real size : {10.0, 25.0, 60.0}) {
      const Real fe = rate == 1 ? 0.08 : 0.1;  // mm, N/mm
      DrivenPoint p = point(concrete(fe, rate), size);
      p.dt = 1e6;  // no rate
      const auto borne = [&](Real w) {
        if (rate == 1) return w < fe ? ft * (1 - w / fe) : 0;
        const Real knee = 0.75 * fe / ft, end = 5 * fe / ft;
        return w < knee ? ft * (1 - 0.75 * w / knee) : w < end ? 0.25 * ft * (end - w) / (end - knee) : 0;
      };
      Real strain = 0, work = 0;
      while (strain * size < 0.22) {
        const Real before = p.stress[0];
        p.strain({1e-6, 0, 0, 0, 0, 0}), strain += 1e-6;
        work += 0.5 * (before + p.stress[0]) * 1e-6 * size;
        const Real e = p.of("crack_strain_1");
        if (p.of("cracks") == 0) continue;
        ASSERT_EQ(p.of("cracks"), 1);
        EXPECT_NEAR(p.stress[0], borne(e * size) * p.of("crack_strength_1") / ft, 1e-9);
        EXPECT_NEAR(p.stress[0], M * (strain - e), 1e-8);
      }
      EXPECT_NEAR(p.of("crack_strength_1"), ft, 1e-12);
      // the work of the crack is the fracture energy, or half of UTS times FE
      EXPECT_NEAR(work, rate == 1 ? 0.5 * ft * fe : fe, 2e-3 * work) << size;
    }
}

// Half open, closed, pressed, and opened again: to the origin, with the first stiffness, and back on its
// line.
TEST(Winfrith, CracksCloseAndOpen) {
  const Real size = 25, fe = 0.1;
  DrivenPoint p = point(concrete(fe), size);
  for (int n = 0; n < 1500; ++n) p.strain({1e-6, 0, 0, 0, 0, 0});
  const Real most = p.of("crack_strain_1"), top = p.stress[0];
  Real strain = 1.5e-3;
  while (strain > -5e-4) {
    p.strain({-1e-5, 0, 0, 0, 0, 0}), strain -= 1e-5;
    const Real e = p.of("crack_strain_1");
    EXPECT_NEAR(p.stress[0], strain > 0 ? top * e / most : M * strain, 1e-8);
    EXPECT_NEAR(e, strain > 0 ? strain / (1 + top / most / M) : 0, 1e-12);
  }
  while (strain < 1.5e-3 - 1e-9) p.strain({1e-5, 0, 0, 0, 0, 0}), strain += 1e-5;
  EXPECT_NEAR(p.stress[0], top, 1e-7);
  EXPECT_NEAR(p.of("crack_strain_1"), most, 1e-10);
}

// Torn along x, then y, then z: three cracks across each other, each with its own stress.
TEST(Winfrith, ThreeCracksAreAcrossEachOther) {
  const Real size = 25, fe = 0.05;
  DrivenPoint p = point(concrete(fe), size);
  Matrix R;
  R = Eigen::AngleAxis<Real>(0.7, Vec(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    const Matrix e = 2e-6 * R.col(axis) * R.col(axis).transpose();
    for (int n = 0; n < 400; ++n) p.strain({e(0, 0), e(1, 1), e(2, 2), e(0, 1), e(1, 2), e(2, 0)});
    EXPECT_EQ(p.of("cracks"), axis + 1);
  }
  Matrix s;
  const auto& t = p.stress;
  s << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  const Matrix seen = R.transpose() * s * R;
  const char* names[] = {"1", "2", "3"};
  for (int k = 0; k < 3; ++k) {
    const Real w = size * p.of(std::string("crack_strain_") + names[k]);
    const Real most = size * p.of(std::string("largest_crack_") + names[k]);
    EXPECT_GT(w, 0);
    EXPECT_LE(w, most);
    EXPECT_NEAR(seen(k, k),
                p.of(std::string("crack_strength_") + names[k]) * std::max(1 - most / fe, 0.0) * w / most,
                1e-6)
        << k;
    for (int j = 0; j < k; ++j) EXPECT_NEAR(seen(j, k), 0, 1e-9);
  }
}

// Beside a compression c the strength is ft (1 - c/fc).
TEST(Winfrith, CompressionAcrossLowersTheTensileStrength) {
  for (const Real share : {0.2, 0.5, 0.8}) {
    DrivenPoint p = point(concrete(0.1));
    while (-p.stress[0] < share * fc) stretch(p, -1e-5);
    const Real c = -p.stress[0];
    Real most = 0;
    while (p.of("cracks") == 0) {
      const Real by = 5e-8;  // of z, with x held: c grows by nu E/(1 - nu^2) of it at most
      p.strain_with_free({0, 0, by, 0, 0, 0}, {1});
      most = std::max(most, p.stress[2]);
    }
    EXPECT_NEAR(most, ft * (1 - c / fc), 0.02 * ft) << share;
  }
}

// A crack that is open by w bears 1.161 UTS 0.31/(0.31 + 24 w/(d + 16 mm)) of shear, d = 2 ASIZE.
TEST(Winfrith, ShearOfCracksFallsWithTheirOpening) {
  for (const Real w : {0.12, 0.3, 1.0}) {
    DrivenPoint p = point(concrete(0.1), 25);
    const int steps = 2000;
    for (int n = 0; n < steps; ++n) p.strain({w / 25 / steps, 0, 0, 0, 0, 0});
    const Real opening = 25 * p.of("crack_strain_1");
    for (int n = 0; n < 2000; ++n) p.strain({0, 0, 0, 1e-6, 0, 0});
    EXPECT_NEAR(p.stress[3], 1.161 * ft * 0.31 / (0.31 + 24 * opening / 32), 1e-6) << w;
  }
}

// A crack that was wide open, closed and pressed to 15 MPa bears shear as if it were not there.
TEST(Winfrith, ClosedCracksBearShearByFriction) {
  DrivenPoint p = point(concrete(0.1), 25);
  for (int n = 0; n < 1000; ++n) p.strain({6e-6, 0, 0, 0, 0, 0});
  EXPECT_NEAR(p.stress[0], 0, 1e-9);
  p.strain({-6e-3 - 15 / M, 0, 0, 0, 0, 0});
  EXPECT_NEAR(p.stress[0], -15, 1e-9);
  for (int n = 0; n < 200; ++n) p.strain({0, 0, 0, 1e-6, 0, 0});
  EXPECT_NEAR(p.stress[3], 2 * G * 2e-4, 1e-9);  // above 1.161 UTS
}

TEST(Winfrith, PressureIsThatOfTheTable) {
  // p1 = fc/3 at p1/K, then its multiples
  const Real strain[] = {0, 10 / K, 0.002, 0.004, 0.010, 0.020, 0.030, 0.041, 0.051, 0.062, 0.094};
  const Real made[] = {0, 1, 1.5, 3, 4.8, 6, 7.5, 9.45, 11.55, 14.25, 25.05};
  for (const bool given : {false, true}) {
    DrivenPoint p = point(given ? concrete(0.1, 1, "-0.001,-0.01,-0.1\n12.0,60.0,400.0\n") : concrete(0.1));
    const auto table = [&](Real e) {
      if (given)
        return e < 0.001 ? 12e3 * e : e < 0.01 ? 12 + 48 / 0.009 * (e - 0.001) : 60 + 340 / 0.09 * (e - 0.01);
      std::size_t k = 1;
      while (k < 10 && e > strain[k]) ++k;
      return 10 * (made[k - 1] + (made[k] - made[k - 1]) * (e - strain[k - 1]) / (strain[k] - strain[k - 1]));
    };
    Real e = 0;
    for (int n = 0; n < 500; ++n) {
      p.strain({-1e-4, -1e-4, -1e-4, 0, 0, 0}), e += 3e-4;
      EXPECT_NEAR(pressure(p), table(e), 1e-8);
      if (n % 100 != 99) continue;
      p.strain({1e-4, 1e-4, 1e-4, 0, 0, 0});
      EXPECT_NEAR(pressure(p), table(e) - K * 3e-4, 1e-8);
      p.strain({-1e-4, -1e-4, -1e-4, 0, 0, 0});
    }
  }
}

// CEB: (rate/still)^(1.026 alpha), alpha = 1/(5 + 3/4 fc), in tension 1.016/(10 + fc/2); the third root from
// 30/s on.
TEST(Winfrith, RatesRaiseTheStrengths) {
  const auto law = concrete(0.1, 0);
  for (const Real rate : {1e-3, 1.0, 30.0, 300.0}) {
    const Real slow = std::min(rate, 30.0), fast = std::cbrt(std::max(rate / 30, 1.0));
    const Real pressed = std::pow(slow / 30e-6, 1.026 / 27.5) * fast,
               torn = std::pow(slow / 3e-6, 1.016 / 25) * fast;
    // constant volume, so that the effective rate is that of the axis
    DrivenPoint p = point(law);
    p.dt = 1e-5 / rate;
    for (int n = 0; n < 600; ++n) p.strain({-1e-5, 5e-6, 5e-6, 0, 0, 0});
    EXPECT_NEAR(beyond(OttosenSurface(ft * torn / (fc * pressed)), p, fc * pressed), 0, 2e-4) << rate;
    DrivenPoint t = point(law);
    t.dt = 1e-7 / rate * 2 / 3;  // of uniaxial strain the effective rate is 2/3
    while (t.of("cracks") == 0) t.strain({1e-7, 0, 0, 0, 0, 0});
    EXPECT_NEAR(t.of("crack_strength_1"), ft * torn, 1e-6 * ft) << rate;
  }
}

// The same path in other units: SI by factors, mm, ms, kg by its flag.
TEST(Winfrith, DoesNotDependOnUnits) {
  struct Units {
    const char* flag;
    Real mass, length, time;  // of t, mm, s in them
  };
  std::array<Real, 6> reference{};
  for (const Units& u : {Units{"-4", 1, 1, 1},
                         {"1.0,1.0,1.0", 1e3, 1e-3, 1},
                         {"-5", 1e3, 1, 1e3},
                         {"-3", 1e6, 1, 1e3},
                         {"-2", 1e6, 0.1, 1e6},
                         {"-1", 1e3 / 175.126835, 1 / 25.4, 1}}) {
    const Real stress = u.mass / (u.length * u.time * u.time);
    const auto law = law_from_cards(
        "MAT_WINFRITH_CONCRETE",
        fmt::format("1,{:.16g},{:.16g},{},{:.16g},{:.16g},{:.16g},{:.16g}\n,,,,0,{}\n\n\n", 2.4e-9,
                    E * stress, nu, fc * stress, ft * stress, 0.1 * stress * u.length, 8 * u.length, u.flag));
    DrivenPoint p = point(law, 25 * u.length);
    p.dt = 1e-5 * u.time;
    for (int n = 0; n < 400; ++n) p.strain({4e-6, -1e-6, 0, 1e-6, 0, 0});
    for (int n = 0; n < 400; ++n) p.strain({-4e-6, -8e-6, 0, 3e-6, 1e-6, 0});
    EXPECT_GT(p.of("cracks"), 0);
    for (std::size_t k = 0; k < 6; ++k) {
      if (u.flag == std::string("-4"))
        reference[k] = p.stress[k];
      else
        EXPECT_NEAR(p.stress[k] / stress, reference[k], 2e-6 * fc) << u.flag << " " << k;
    }
  }
}

// Closed cycles of strain through cracks, flow and compaction never give work.
TEST(Winfrith, CyclesTakeWork) {
  for (int seed = 0; seed < 40; ++seed) {
    DrivenPoint p = point(concrete(0.1), 25);
    Real work = 0;
    const Real size = 2e-4 * (1 + seed % 7);
    const auto at = [&](int n, std::size_t k) {
      const Real a = 2 * pi * n / 400;
      return size *
             (std::sin((1 + (seed + k) % 3) * a + 0.7 * Real(seed * k)) - std::sin(0.7 * Real(seed * k)));
    };
    for (int n = 0; n < 1200; ++n) {
      if (n == 400) work = 0;  // the first one lays cracks
      std::array<Real, 6> step;
      for (std::size_t k = 0; k < 6; ++k) step[k] = at(n + 1, k) - at(n, k);
      const auto before = p.stress;
      p.strain(step);
      for (std::size_t k = 0; k < 6; ++k) work += (k < 3 ? 0.5 : 1) * (before[k] + p.stress[k]) * step[k];
    }
    EXPECT_GT(work, -1e-3 * fc * size) << seed;
  }
}

}  // namespace winfrith_test
