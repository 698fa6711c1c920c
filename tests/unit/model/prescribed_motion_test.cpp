#include "model/conditions/prescribed_motion.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "model/cards.hpp"
#include "model/transforms/included_entries.hpp"

using namespace courant;

namespace {

PrescribedMotion motion(PrescribedMotion::Kind kind, std::vector<Real> abscissa, std::vector<Real> ordinate) {
  PrescribedMotion m;
  m.kind = kind;
  m.curve.abscissa = std::move(abscissa);
  m.curve.ordinate = std::move(ordinate);
  m.direction = Vec(1, 0, 0);
  return m;
}

/// Where a leapfrog with steps of changing length brings something that starts with velocity v.
Real place(const PrescribedMotion& m, Real until, Real v) {
  Real t = 0, dt_old = 0, x = 0;
  for (int k = 0; t < until; ++k) {
    const Real dt = std::min(0.01 * (1 + 0.5 * (k % 3)), until - t);
    if (m.drives(t, dt)) v = m.velocity(t, dt, dt_old, v);
    x += v * dt;
    t += dt;
    dt_old = dt;
  }
  return x;
}

using Kind = PrescribedMotion::Kind;

}  // namespace

TEST(Curves, AreIntegratedExactlyBetweenTheirPoints) {
  const auto c = motion(Kind::velocity, {0, 1, 1, 3}, {2, 4, 0, 1}).curve;  // with a jump at 1
  EXPECT_DOUBLE_EQ(integral(c, 0, 1), 3);
  EXPECT_DOUBLE_EQ(integral(c, 0.5, 1), 1.75);
  EXPECT_DOUBLE_EQ(integral(c, 0.5, 2), 1.75 + 0.25);
  EXPECT_DOUBLE_EQ(integral(c, -1, 0), 2);  // constant beyond the ends
  EXPECT_DOUBLE_EQ(integral(c, 2, 5), 0.75 + 2);
  EXPECT_DOUBLE_EQ(integral(c, 1, 1), 0);
  EXPECT_DOUBLE_EQ(rise(c, 0.5, 2), 1 + 0.5);
  EXPECT_DOUBLE_EQ(rise(c, 3, 9), 0);
}

TEST(PrescribedMotion, BringsWhatItDrivesWhereTheIntegralSays) {
  // v = 2 t up to 1, then down to 0 at 2, and 0 for good
  const auto v = motion(Kind::velocity, {0, 1, 2}, {0, 2, 0});
  EXPECT_NEAR(place(v, 0.7, 5), 0.49, 1e-14);
  EXPECT_NEAR(place(v, 3, 5), 2, 1e-14);
  auto x = motion(Kind::displacement, {0, 1, 2}, {0.5, 2, -1});  // behind a relaxation from its first value
  EXPECT_NEAR(place(x, 1, 5), 1.5, 1e-14);
  EXPECT_NEAR(place(x, 3, 5), -1.5, 1e-14);
  x.jump = 0.5;  // else it is where the curve says, from the first step on
  EXPECT_NEAR(place(x, 0.01, 5), 0.515, 1e-14);
  EXPECT_NEAR(place(x, 1, 5), 2, 1e-14);
  EXPECT_NEAR(place(x, 3, 5), -1, 1e-14);
  // a = 6 t: x = v0 t + t^3; then a = 0: on with v0 + 3
  const auto a = motion(Kind::acceleration, {0, 1, 1}, {0, 6, 0});
  EXPECT_NEAR(place(a, 0.8, 5), 0.8 * 5 + 0.512, 1e-13);
  EXPECT_NEAR(place(a, 2, 5), 10 + 1 + 3, 1e-13);
}

TEST(PrescribedMotion, ScalesShiftsAndEnds) {
  auto v = motion(Kind::velocity, {0, 10}, {1, 1});
  v.sf = 3;
  v.birth = 0.5, v.death = 1;
  EXPECT_NEAR(place(v, 2, 0), 3 * 1.5, 0.031);  // on with the last velocity; a step at BIRTH counts whole
  auto x = motion(Kind::displacement, {0, 1}, {0, 2});
  x.birth = 0.505;  // within a step: the position at the end is exact all the same
  EXPECT_NEAR(place(x, 1.505, 0), 2, 1e-13);
  x.birth = 0.498;  // in the first half of a step, which is not driven: the next one makes up for it
  EXPECT_NEAR(place(x, 1.4, 0), 2 * (1.4 - 0.498), 1e-13);
}

TEST(PrescribedMotion, ClashesWhereTwoDriveOneDirection) {
  auto a = motion(Kind::velocity, {0}, {1}), b = a;
  EXPECT_NE(clash(a, b), "");
  b.direction = Vec(-1, 0, 0);
  EXPECT_NE(clash(a, b), "");
  b.direction = Vec(0.6, 0.8, 0);
  EXPECT_NE(clash(a, b), "");
  b.direction = Vec(0, 1, 0);
  EXPECT_EQ(clash(a, b), "");
  b = a;
  b.turns = true;
  EXPECT_EQ(clash(a, b), "");
  b = a;
  a.death = b.birth = 1;
  EXPECT_EQ(clash(a, b), "");
}

TEST(PrescribedMotion, CurvesOfIncludedFilesHaveTheUnitsOfWhatTheyDrive) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("courant_motion_units_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "main.k") << "*KEYWORD\n*INCLUDE_TRANSFORM\npart.inc\n\n\n1.0,10.0,1000.0\n\n*END\n";
  // of the included file: time 10, length 1000
  const std::pair<const char*, Real> cases[] = {{"1,0", 1e2}, {"1,1", 1e1},  {"1,2", 1e3},
                                                {"7,0", 0.1}, {"7,1", 0.01}, {"7,2", 1}};
  for (const auto& [dof_vad, factor] : cases) {
    std::ofstream(folder / "part.inc")
        << "*DEFINE_CURVE\n5\n0.0,1.0\n1.0,1.0\n*BOUNDARY_PRESCRIBED_MOTION_RIGID\n2," << dof_vad
        << ",5\n*END\n";
    Diagnostics diagnostics;
    Deck deck = read_deck((folder / "main.k").string(), {}, diagnostics);
    move_included_entries(deck, diagnostics);
    EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
    ASSERT_EQ(deck.all<DefineCurveCard>().size(), 1u);
    EXPECT_DOUBLE_EQ(deck.all<DefineCurveCard>()[0].sfa, 10);
    EXPECT_DOUBLE_EQ(deck.all<DefineCurveCard>()[0].sfo, factor) << dof_vad;
  }
  fs::remove_all(folder);
}
