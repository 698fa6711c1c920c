// Plasticity with damage, with curves of compression and tension, and metal foam, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "driven_point.hpp"
#include "law_from_cards.hpp"

using namespace courant;
using test::DrivenPoint;
using test::law_from_cards;

// 081 in tension: (1 - D)(yield stress), D = (e - EPPF)/(EPPFR - EPPF), in space and in the plane; unloading
// by (1
// - D) E.
TEST(PlasticityWithDamage, StressFallsToNothing) {
  const auto law =
      law_from_cards("MAT_PLASTICITY_WITH_DAMAGE", "1,2.0,200.0,0.3,0.2,1.0,0.02\n,,,,0.10\n\n\n");
  for (const bool plane : {false, true}) {
    DrivenPoint point(law, plane);
    const std::vector<std::size_t> free =
        plane ? std::vector<std::size_t>{1} : std::vector<std::size_t>{1, 2};
    for (int n = 0; n < 80; ++n) {
      point.strain_with_free({1e-3, -4e-4, -4e-4, 0, 0, 0}, free);
      const Real e = point.of("plastic_strain"), D = std::max((e - 0.02) / 0.08, 0.0);
      EXPECT_NEAR(point.of("damage"), D, 1e-12);
      EXPECT_NEAR(point.stress[0], (1 - D) * (0.2 + 200.0 / 199 * e), 1e-9) << n;
      EXPECT_NEAR(point.of("failure_ratio"), D, 1e-12);
    }
    const Real before = point.stress[0], D = point.of("damage");
    EXPECT_GT(D, 0.5);
    point.strain_with_free({-1e-4, 0, 0, 0, 0, 0}, free);
    EXPECT_NEAR(before - point.stress[0], (1 - D) * 200 * 1e-4, 1e-9);
    for (int n = 0; n < 100; ++n) point.strain({1e-3, -5e-4, -5e-4, 0, 0, 0});
    EXPECT_EQ(point.of("damage"), 1);
    EXPECT_EQ(point.stress[0], 0);
    EXPECT_GE(point.of("failure_ratio"), law->failure_limit());
  }
}

// 105 without hardening: Y = sigma_y^2/(2 E) f of the triaxiality, so that D is straight over the plastic
// strain beyond EPSD. In tension f = 1, in shear 2/3 (1 + PR); in compression nothing happens.
TEST(Damage2, GrowsByElasticEnergy) {
  const std::string curve = "*DEFINE_CURVE\n3\n0.0,0.2\n1.0,0.2\n";
  const auto law = law_from_cards("MAT_DAMAGE_2", "1,2.0,200.0,0.3\n,,3\n0.01,0.001,0.4\n\n\n" + curve);
  const Real in_tension = 0.04 / 400 / 0.001;
  for (const bool plane : {false, true}) {
    const std::vector<std::size_t> free =
        plane ? std::vector<std::size_t>{1} : std::vector<std::size_t>{1, 2};
    DrivenPoint pulled(law, plane), pressed(law, plane), sheared(law, plane);
    for (int n = 0; n < 300; ++n) {
      pulled.strain_with_free({1e-3, -5e-4, -5e-4, 0, 0, 0}, free);
      pressed.strain_with_free({-1e-3, 5e-4, 5e-4, 0, 0, 0}, free);
      sheared.strain({0, 0, 0, 1e-3, 0, 0});
    }
    const Real e = pulled.of("plastic_strain"), D = in_tension * (e - 0.01);
    EXPECT_NEAR(pulled.of("damage"), D, 1e-9);
    EXPECT_NEAR(pulled.stress[0], (1 - D) * 0.2, 1e-9);
    EXPECT_NEAR(pulled.of("failure_ratio"), D / 0.4, 1e-8);
    EXPECT_GT(pressed.of("plastic_strain"), 0.2);
    EXPECT_EQ(pressed.of("damage"), 0);
    const Real in_shear = in_tension * 2.0 / 3 * 1.3;
    EXPECT_NEAR(sheared.of("damage"), in_shear * (sheared.of("plastic_strain") - 0.01), 1e-9);
  }
}

// 124: tension follows LCIDT, compression LCIDC; without PC and PT the sign of the mean stress decides, in
// shear that is 0 tension. With PC and PT straight between, as far as the mean stress itself goes.
TEST(CompressionTension, EachSideFollowsItsCurve) {
  const std::string curves =
      "*DEFINE_CURVE\n1\n0.0,0.3\n0.1,0.4\n*DEFINE_CURVE\n2\n0.0,0.2\n0.1,0.25\n*DEFINE_CURVE\n3\n0.0,1.0\n1."
      "0,2.0\n";
  const auto law =
      law_from_cards("MAT_PLASTICITY_COMPRESSION_TENSION", "1,2.0,200.0,0.3\n1,2\n0\n0\n" + curves);
  const auto between =
      law_from_cards("MAT_PLASTICITY_COMPRESSION_TENSION", "1,2.0,200.0,0.3\n1,2\n0.5,0.5\n0\n" + curves);
  for (const bool plane : {false, true}) {
    const std::vector<std::size_t> free =
        plane ? std::vector<std::size_t>{1} : std::vector<std::size_t>{1, 2};
    DrivenPoint pulled(law, plane), pressed(law, plane), weighed(between, plane);
    for (int n = 0; n < 50; ++n) {
      pulled.strain_with_free({1e-3, -5e-4, -5e-4, 0, 0, 0}, free);
      pressed.strain_with_free({-1e-3, 5e-4, 5e-4, 0, 0, 0}, free);
      weighed.strain_with_free({1e-4, -5e-5, -5e-5, 0, 0, 0}, free);
    }
    EXPECT_NEAR(pulled.stress[0], 0.2 + 0.5 * pulled.of("plastic_strain"), 1e-9);
    EXPECT_NEAR(pressed.stress[0], -0.3 - 1.0 * pressed.of("plastic_strain"), 1e-9);
    // s = w s_t + (1 - w) s_c, w = s/3 + 1/2
    const Real e = weighed.of("plastic_strain"), t = 0.2 + 0.5 * e, c = 0.3 + e;
    EXPECT_GT(e, 0);
    const Real expected = (0.5 * t + 0.5 * c) / (1 - (t - c) / 3);
    EXPECT_NEAR(weighed.stress[0], expected, plane ? 2e-5 : 1e-9);
  }
  // twice the rate of strain along the axis: the factor 1 + rate, of plastic strain
  for (const bool plane : {false, true}) {
    DrivenPoint fast(
        law_from_cards("MAT_PLASTICITY_COMPRESSION_TENSION", "1,2.0,200.0,0.3\n1,2,0,3,2\n0\n0\n" + curves),
        plane);
    const std::vector<std::size_t> free =
        plane ? std::vector<std::size_t>{1} : std::vector<std::size_t>{1, 2};
    fast.dt = 1e-3;
    Real last = 0, rate = 0;
    for (int n = 0; n < 100; ++n) {
      fast.strain_with_free({5e-4, -2e-4, -2e-4, 0, 0, 0}, free);
      rate = (fast.of("plastic_strain") - last) / fast.dt, last = fast.of("plastic_strain");
    }
    EXPECT_NEAR(fast.stress[0], (0.2 + 0.5 * last) * (1 + rate), 1e-7);
    EXPECT_NEAR(rate, 0.5, 0.01);
  }
}

// 154: a bar is crushed at its yield stress and keeps its width with ALPHA^2 = 9/2; all around at sqrt(1 +
// ALPHA^2/9)/ALPHA of it; in shear sqrt((1 + ALPHA^2/9)/3) of it. Deshpande & Fleck 2000, plastic Poisson
// ratio (1/2
// - (ALPHA/3)^2)/(1 + (ALPHA/3)^2).
TEST(DeshpandeFleck, IsCrushedAsItsSurfaceHasIt) {
  const auto yield = [](Real e) {
    const Real x = e / 1.5;
    return 2 + 0.5 * x + 3 * std::log(1 / (1 - std::pow(x, 2.5)));
  };
  for (const Real alpha : {std::sqrt(4.5), 1.2, 0.0}) {
    const auto law = law_from_cards("MAT_DESHPANDE_FLECK_FOAM",
                                    fmt::format("1,2.0,500.0,0.3,{:.16g},0.5\n1.5,3.0,2.5,2.0\n", alpha));
    DrivenPoint bar(law), around(law), sheared(law);
    Real across = 0;
    for (int n = 0; n < 500; ++n) {
      across += bar.strain_with_free({-2e-3, 0, 0, 0, 0, 0}, {1, 2})[1];
      around.strain({-1e-3, -1e-3, -1e-3, 0, 0, 0});
      sheared.strain({0, 0, 0, 1e-3, 0, 0});
    }
    const Real square = 1 + alpha * alpha / 9;
    const Real e = bar.of("plastic_strain");
    EXPECT_NEAR(-bar.stress[0], yield(e), 1e-9 * yield(e));
    const Real along = -1 + yield(e) / 500, elastic = 0.3 * yield(e) / 500;
    const Real poisson = (0.5 - alpha * alpha / 9) / square;
    EXPECT_NEAR(-(across - elastic) / along, poisson, 1e-4);
    if (alpha > 0) {
      EXPECT_NEAR(-around.stress[0], std::sqrt(square) / alpha * yield(around.of("plastic_strain")), 1e-9);
    }
    EXPECT_NEAR(sheared.stress[3], std::sqrt(square / 3) * yield(sheared.of("plastic_strain")), 1e-9);
    // it locks: EPSD is not reached
    for (int n = 0; n < 400; ++n) bar.strain_with_free({-2e-3, 0, 0, 0, 0, 0}, {1, 2});
    EXPECT_LE(bar.of("plastic_strain"), 1.5);
  }
}
