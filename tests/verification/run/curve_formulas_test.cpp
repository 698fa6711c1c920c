// Loads and motions by formulas: they act as the formula says, and leave bits to no chance.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "beam_decks.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;

namespace {

/// A lump of mass 1 on the x axis, driven or pushed.
std::string lump(const std::string& cards) {
  return "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*NODE\n1,0,0,0,7\n2,1.0,0,0,5\n*ELEMENT_MASS\n       2       "
         "2             1.0\n"
         "*PART\nspring\n1,1,1\n*SECTION_DISCRETE\n1\n*MAT_SPRING_ELASTIC\n1,1.0E-9\n*ELEMENT_DISCRETE\n     "
         "  1       1       1       2\n"
         "*CONTROL_TIMESTEP\n0.0,0.9\n" +
         cards + "*END\n";
}
Real place(Simulation& s, Real t) {
  while (s.clock().t < t) s.step(test::do_nothing);
  return s.world().nodes.x.data(0)[1] - 1;
}

}  // namespace

TEST(CurveFormulas, MoveANode) {
  // displacement, velocity and acceleration: places at t are those of the formula, its integral, and twice
  // that
  const std::string f = "*DEFINE_CURVE_FUNCTION\n1\n0.1*SIN(2*PI*\n 3*TIME)\n";
  const Real w = 6 * pi;
  for (const int vad : {2, 0, 1}) {
    auto s = test::simulation_of(lump(f + fmt::format("*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,{},1\n", vad)));
    for (const Real until : {0.11, 0.4, 0.77}) {
      const Real x = place(*s, until), t = s->clock().t;
      const Real theory = vad == 2   ? 0.1 * std::sin(w * t)
                          : vad == 0 ? 0.1 / w * (1 - std::cos(w * t))
                                     : 0.1 / w * (t - std::sin(w * t) / w);
      EXPECT_NEAR(x, theory, 2e-5 * (vad == 2 ? 1 : vad == 0 ? 1 / w : 1 / w)) << vad << " " << t;
    }
  }
}

TEST(CurveFormulas, GoTheWayOfASmoothCurve) {
  for (const std::string& card :
       {std::string("1,0,0.3,0.1,0.7,0.2\n"), std::string("1,0,0.3,0.1,0.0,0.2,0.75\n")}) {
    auto s = test::simulation_of(
        lump("*DEFINE_CURVE_SMOOTH\n" + card + "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,0,1\n"));
    EXPECT_NEAR(place(*s, 0.0999), 0, 1e-12);
    // in the middle half of the path, with DIST/(TEND - TSTART - TRISE)
    const Real x = place(*s, 0.4);
    EXPECT_NEAR(x, 0.15 + 0.75 * (s->clock().t - 0.4), 1e-6);
    EXPECT_NEAR(s->world().nodes.v.data(0)[1], 0.75, 1e-6);
    EXPECT_NEAR(place(*s, 0.8), 0.3, 1e-6);
    EXPECT_NEAR(s->world().nodes.v.data(0)[1], 0, 1e-9);
  }
}

TEST(CurveFormulas, PushANode) {
  // F = 6 t on a mass of 1: x = t^3
  const std::string load = "*LOAD_NODE_POINT\n2,1,1\n";
  for (const std::string& curve :
       {std::string("*DEFINE_FUNCTION\n1,push\nfloat push(float t)\n{\n  float a = 3*t; /* half */\n  return "
                    "2*a;\n}\n"),
        std::string("*DEFINE_FUNCTION\n1\nf(t)=6*t\n"),
        std::string("*PARAMETER\nR six,6.0\n*DEFINE_CURVE_FUNCTION\n1\n&six*TIME\n"),
        std::string("*DEFINE_CURVE_FUNCTION\n1,0,1.0,2.0,0.0,1.0\n3*TIME-1\n")}) {
    auto s = test::simulation_of(lump(load + curve));
    const Real x = place(*s, 0.5), t = s->clock().t;
    EXPECT_NEAR(x / (t * t * t), 1, 5e-3) << curve;
  }
}

TEST(CurveFormulas, HaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  using namespace test::beams;
  BeamDeck deck;
  deck.part(1, square_2, steel_of_beams);
  deck.line(80, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
  deck.cards +=
      "*LOAD_NODE_POINT\n        81         3         1\n*DEFINE_CURVE_FUNCTION\n         "
      "1\n5*SIN(1e5*TIME)+STEP(TIME,0,0,1e-5,1)\n";
  test::expect_same_bits(deck.text(1e-3), 40, 17);
}
