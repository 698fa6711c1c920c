// Layers of *MAT_058: the curve of stress over strain in each direction against its closed form
// (Matzenmiller, Lubliner & Taylor 1995), surfaces of failure, unloading, and what takes layers away.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "law_from_cards.hpp"
#include "ply_point.hpp"

using namespace courant;
using test::OnePoint;

namespace {

struct FabricCards {
  Real ea = 60, eb = 40, ec = 0, prba = 0, prca = 0, tau1 = 0, gamma1 = 0, gab = 4;
  Real slimt1 = 0.1, slimc1 = 1, slimt2 = 0, slimc2 = 0.5, slims = 0.25;
  Real tsize = 0, erods = 0, soft = 1, fs = -1, epsf = 0, epsr = 0;
  Real e11c = 0.015, e11t = 0.017, e22c = 0.02, e22t = 0.015, gms = 0.08;
  Real xc = 0.65, xt = 0.8, yc = 0.6, yt = 0.5, sc = 0.11;
  OnePoint point() const {
    return OnePoint(test::law_from_cards(
        "MAT_LAMINATED_COMPOSITE_FABRIC",
        fmt::format(
            "1,1.0,{},{},{},{},{},{}\n{},3.0,2.0,{},{},{},{},{}\n0.0,{},{},{},{},{},{},0.8\n,,,,,,{}\n\n"
            "{},{},{},{},{}\n{},{},{},{},{}\n",
            ea, eb, ec, prba, tau1, gamma1, gab, slimt1, slimc1, slimt2, slimc2, slims, tsize, erods, soft,
            fs, epsf, epsr, prca, e11c, e11t, e22c, e22t, gms, xc, xt, yc, yt, sc)));
  }
};

/// Stress over a growing strain, with `left` of the strength behind the peak.
Real softening(Real strain, Real E, Real X, Real at_strength, Real left) {
  const Real m = 1 / std::log(at_strength * E / X), r = strain * E / X;
  const Real stress = E * strain * std::exp(-std::pow(r, m) / (m * std::exp(1.0)));
  return strain > at_strength ? std::max(stress, left * X) : stress;
}

const std::vector<Real> shares = {0.1, 0.5, 0.9, 1, 1.1, 1.5, 2, 3};  // of the strain at the strength

}  // namespace

TEST(Fabric, FollowsTheClosedFormInEachDirection) {
  const FabricCards c;
  for (const Real fs : {-1.0, 0.0, 1.0}) {
    FabricCards cards = c;
    cards.fs = fs;
    OnePoint at = cards.point(), ac = cards.point(), bt = cards.point(), bc = cards.point(),
             s = cards.point();
    Real before = 0;
    for (const Real share : shares) {
      const Real more = share - before;
      at.strain(more * c.e11t, 0, 0, 3), ac.strain(-more * c.e11c, 0, 0, 3);
      bt.strain(0, more * c.e22t, 0, 3), bc.strain(0, -more * c.e22c, 0, 3);
      s.strain(0, 0, more * c.gms / 2, 3);
      EXPECT_NEAR(at.stress[0], softening(share * c.e11t, c.ea, c.xt, c.e11t, c.slimt1), 1e-12) << share;
      EXPECT_NEAR(ac.stress[0], -softening(share * c.e11c, c.ea, c.xc, c.e11c, c.slimc1), 1e-12) << share;
      EXPECT_NEAR(bt.stress[1], softening(share * c.e22t, c.eb, c.yt, c.e22t, c.slimt2), 1e-12) << share;
      EXPECT_NEAR(bc.stress[1], -softening(share * c.e22c, c.eb, c.yc, c.e22c, c.slimc2), 1e-12) << share;
      EXPECT_NEAR(s.stress[3], softening(share * c.gms, c.gab, c.sc, c.gms, c.slims), 1e-12) << share;
      if (share == 1) {
        EXPECT_NEAR(at.stress[0], c.xt, 1e-12);
        EXPECT_NEAR(s.stress[3], c.sc, 1e-12);
      }
      before = share;
    }
  }
}

// Stress falls along the line to the origin, comes back along it, and the other sign knows nothing of it.
TEST(Fabric, UnloadsToTheOrigin) {
  const FabricCards c;
  OnePoint p = c.point();
  p.strain(1.2 * c.e11t, 0, 0, 5);
  const Real most = p.stress[0];
  p.strain(-0.6 * c.e11t, 0, 0, 5);
  EXPECT_NEAR(p.stress[0], most / 2, 1e-12);
  p.strain(0.6 * c.e11t, 0, 0, 5);
  EXPECT_NEAR(p.stress[0], most, 1e-12);
  p.strain(-1.7 * c.e11t, 0, 0, 5);
  EXPECT_NEAR(p.stress[0], -softening(0.5 * c.e11t, c.ea, c.xc, c.e11c, c.slimc1), 1e-12);
}

// Undamaged: plane stress by EA, EB, PRBA. With w_a = 1/2 Poisson's ratio falls with it.
TEST(Fabric, PoissonsRatioFallsWithDamage) {
  FabricCards c;
  c.prba = 0.2;
  OnePoint p = c.point();
  p.strain(1e-6, 2e-6, 0);
  const Real f = 1 / (1 - 0.04 * c.ea / c.eb);
  EXPECT_NEAR(p.stress[0], f * (c.ea * 1e-6 + 0.2 * c.ea * 2e-6), 1e-10);
  EXPECT_NEAR(p.stress[1], f * (0.2 * c.ea * 1e-6 + c.eb * 2e-6), 1e-10);
  OnePoint torn = c.point();
  const Real strain = 1.3 * c.e11t, w = softening(strain, c.ea, c.xt, c.e11t, c.slimt1) / (c.ea * strain);
  torn.strain(strain, 0, 0, 10);
  const Real g = 1 / (1 - w * 0.04 * c.ea / c.eb);
  EXPECT_NEAR(torn.stress[0], g * w * c.ea * strain, 1e-12);
  EXPECT_NEAR(torn.stress[1], g * w * 0.2 * c.ea * strain, 1e-12);
}

// On rays of stress the most that is borne lies on (s_a/XT)^2 + (tau/SC)^2 = 1 with FS 1, and s_b alike with
// FS 1 and 0, where all curves are alike; with FS -1 in the corner of the rectangle.
TEST(Fabric, SurfacesOfFailure) {
  FabricCards c;
  c.e11t = 1.4 * c.xt / c.ea, c.e22t = 1.4 * c.yt / c.eb, c.gms = 1.4 * c.sc / c.gab;
  for (const Real fs : {-1.0, 0.0, 1.0})
    for (const bool along_a : {true, false})
      for (const Real angle : {0.3, pi / 4, 1.2}) {
        FabricCards cards = c;
        cards.fs = fs;
        OnePoint p = cards.point();
        const Real e = std::cos(angle) * (along_a ? c.xt / c.ea : c.yt / c.eb),
                   g = std::sin(angle) * c.sc / c.gab;
        Real most_s = 0, most_tau = 0, most_r = 0;
        for (int k = 0; k < 4000; ++k) {
          p.strain(along_a ? e / 500 : 0, along_a ? 0 : e / 500, g / 1000);
          const Real s = along_a ? p.stress[0] / c.xt : p.stress[1] / c.yt, tau = p.stress[3] / c.sc;
          most_s = std::max(most_s, s), most_tau = std::max(most_tau, tau);
          most_r = std::max(most_r, std::hypot(s, tau));
        }
        const bool smooth = fs == 1 || (fs == 0 && !along_a);
        if (smooth) {
          EXPECT_NEAR(most_r, 1, 1e-5) << fs << " " << angle;
        } else {
          EXPECT_NEAR(most_s, 1, 1e-5) << fs << " " << angle;
          EXPECT_NEAR(most_tau, 1, 1e-5) << fs << " " << angle;
        }
      }
}

// FS -1: the first branch of shear is largest at GAMMA1, the second a straight line to SC at GMS.
TEST(Fabric, ShearOfTwoBranches) {
  FabricCards c;
  c.tau1 = 0.05, c.gamma1 = 0.02;
  OnePoint p = c.point();
  Real before = 0;
  for (const Real gamma : {0.005, 0.015, 0.02, 0.05, 0.08, 0.0801, 0.2}) {
    p.strain(0, 0, (gamma - before) / 2, 2);
    const Real expected = gamma <= 0.02   ? softening(gamma, c.gab, c.tau1, c.gamma1, 0)
                          : gamma <= 0.08 ? 0.05 + (c.sc - 0.05) * (gamma - 0.02) / 0.06
                                          : c.slims * c.sc;
    EXPECT_NEAR(p.stress[3], expected, 1e-12) << gamma;
    before = gamma;
  }
}

TEST(Fabric, ShearAcrossFallsFromEpsfToEpsr) {
  FabricCards c;
  c.epsf = 0.02, c.epsr = 0.06;
  OnePoint p = c.point();
  p.strain(0, 0, 0, 1, 0.005, 0);  // gamma 0.01
  EXPECT_NEAR(p.stress[4], 0.03, 1e-14);
  p.strain(0, 0, 0, 1, 0.015, 0);  // 0.04: half of TSMD = 0.8 is gone
  EXPECT_NEAR(p.stress[4], 0.6 * 3 * 0.04, 1e-14);
  p.strain(0, 0, 0, 1, 0.06, 0);
  EXPECT_NEAR(p.stress[4], 0.2 * 3 * 0.16, 1e-14);
}

// Uniaxial strain e: sqrt(4/3) e as if the volume were kept in the plane, 2/3 e of all strains.
TEST(Fabric, LayersFailByTheirEffectiveStrain) {
  for (const auto& [erods, at] : {std::pair(0.02, 0.02 / std::sqrt(4.0 / 3)), {-0.02, 0.03}}) {
    FabricCards c;
    c.erods = erods;
    OnePoint p = c.point();
    EXPECT_EQ(p.law->failure_limit(), 1);
    p.strain(0.99 * at, 0, 0, 10);
    EXPECT_GT(p.stress[0], 0.01);
    EXPECT_EQ(p.of("failed_layer"), 0);
    p.strain(0.02 * at, 0, 0);
    EXPECT_EQ(p.stress[0], 0);
    EXPECT_EQ(p.of("failed_layer"), 1);
  }
  EXPECT_FALSE(std::isfinite(FabricCards().point().law->failure_limit()));
}

TEST(Fabric, IsWeakerBesideDeletedElements) {
  FabricCards c;
  c.soft = 0.5;
  OnePoint p = c.point();
  p.strain(0.1 * c.e11t, 0, 0);
  p.at(beside_deleted) = 1;
  p.strain(0.9 * c.e11t, 0, 0);
  EXPECT_NEAR(p.stress[0], 0.5 * c.xt, 1e-12);
}
