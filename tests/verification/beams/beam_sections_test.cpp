// Sections, masses, steps and parts of beams, against closed solutions.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "beam_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;
using namespace courant::test::beams;
using test::simulation_of;

// Resultants answer by the length without stress, so that the step may not grow with the beam: thick ones, of
// which bending asks for the step, stretched to twice their length.
TEST(Beams, StretchedThickBeamsAreStable) {
  constexpr int n = 6;
  BeamDeck deck;
  deck.part(1, "         2\n      7.84   5.12213   5.12213  10.24427\n",
            "*MAT_ELASTIC\n         1       1.0       1.0       0.3\n");
  deck.line(n, n, [](int k) { return k == 0 ? ",7,7" : k == n ? ",5,7" : ""; });
  deck.velocity([](int k) -> Vec {
    return k == 1 || k > n ? Vec(Vec::Zero()) : Vec(0, 1e-6 * std::sin(3.0 * k), 1e-6 * std::cos(5.0 * k));
  });
  deck.cards += fmt::format(
      "*DEFINE_CURVE\n5\n0.0,0.0\n60.0,{0}.0\n999.0,{0}.0\n*BOUNDARY_PRESCRIBED_MOTION_NODE\n{1},1,2,5\n"
      "*CONTROL_TIMESTEP\n0.0,0.9\n",
      n, n + 1);
  auto s = simulation_of(deck.text(300));
  while (s->clock().t < 200) s->step(test::do_nothing);
  for (Index k = 0; k <= n; ++k)
    EXPECT_LT(std::hypot(s->world().nodes.x.data(1)[k], s->world().nodes.x.data(2)[k]), 1e-3) << k;
}

// Weight of a part and its damping act on the nodes of its beams, and a set of its nodes takes them: all
// three by the tip's deflection, w L^4/(8 EI) of the weight w by length, and P L^3/(3 EI).
TEST(Beams, NodesBelongToTheirPart) {
  for (const bool weight : {true, false}) {
    constexpr int n = 10;
    BeamDeck deck;
    deck.part(1, square_2, steel_of_beams);
    deck.line(n, 1, [](int k) { return k == 0 ? ",7,7" : ""; });
    deck.cards +=
        "*DEFINE_CURVE\n1\n0.0,0.0\n0.5,1.0\n9.0,1.0\n*DEFINE_CURVE\n2\n0.0,60.0\n9.0,60.0\n"
        "*DAMPING_PART_MASS\n1,2\n";
    deck.cards += weight ? "*LOAD_GRAVITY_PART\n1,3,1,10.0\n"
                         : "*SET_NODE_GENERAL\n7\nPART,1\n*LOAD_NODE_SET\n7,3,1,1.0\n";
    auto s = simulation_of(deck.text(2));
    while (s->clock().t < 1) s->step(test::do_nothing);
    // single forces P at all nodes k/n: the sum of P x^2 (3 - x)/6 EI
    Real of_forces = 0;
    for (int k = 1; k <= n; ++k) of_forces += std::pow(Real(k) / n, 2) * (3 - Real(k) / n) / (6 * 175.0);
    const Real w = 7850 * 1e-4 * 10, expected = weight ? -w / (8 * 175.0) : of_forces;
    EXPECT_NEAR(s->world().nodes.x.data(2)[n] / expected, 1, weight ? 0.01 : 0.002) << weight;
  }
}

namespace {

/// A cantilever of length 1 and ten beams, away from the origin, E = 2.1e11 / 1000 and G of PR 0.3, under a
/// load at its end along y (N3, s) or z (t). `card`: of one beam, with what follows. Where its end is.
Real end_of_cantilever(const std::string& section, const std::string& option, const std::string& third,
                       const std::string& more, int dof, Real load) {
  constexpr int n = 10;
  BeamDeck deck;
  deck.part(1, section, "*MAT_ELASTIC\n         1    7850.0   2.1E+08       0.3\n");
  for (int k = 0; k <= n; ++k) deck.at(Vec(2 + 0.1 * k, -1, 3), k == 0 ? ",7,7" : "");
  deck.at(Vec(2, 5, 3), ",7,7");
  for (int k = 1; k <= n; ++k) deck.elements += fmt::format("{0},1,{0},{1},{2}\n{3}", k, k + 1, third, more);
  deck.cards += fmt::format(
      "*LOAD_NODE_POINT\n{},{},1,{}\n*DEFINE_CURVE\n1\n0.0,0.0\n5.0,1.0\n90.0,1.0\n*DAMPING_GLOBAL\n0,3.0\n",
      n + 1, dof, load);
  std::string text = deck.text(20);
  const std::string plain = "*ELEMENT_BEAM\n";
  text.replace(text.find(plain), plain.size(), "*ELEMENT_BEAM" + option + "\n");
  auto s = simulation_of(text);
  while (s->clock().t < 12) s->step(test::do_nothing);
  return s->world().nodes.x.data(dof - 1)[n] - (dof == 2 ? -1 : 3);
}

}  // namespace

// P L^3/(3 EI), of ELFORM 1 less 1/(4 n^2), and P L/(G A_s) of shear, of sections that are not the same about
// s and t: 0.02 along s (y) and 0.01 along t (z), by N3, by a vector, by each element's own measures, by
// means of both ends; a tube; thick ones with a shear area.
TEST(Beams, SectionsBendAboutTheirAxes) {
  const std::string
      rectangle = "         1       1.0         2         0\n      0.02      0.02      0.01      0.01\n",
      tapered = "         1       1.0         2         0\n      0.01      0.03     0.005     0.015\n",
      other = "         1       1.0         2         0\n       0.1       0.1       0.1       0.1\n",
      resultants = "         2\n    2.0E-4 1.6667E-9 6.6667E-9\n",
      tube = "         1       1.0         2         1\n      0.02      0.02      0.01      0.01\n",
      thick = "         1       0.5         2         0\n       0.4       0.4       0.4       0.4\n",
      thick_2 = "         2\n      0.16 2.1333E-3 2.1333E-3 4.2667E-3      0.08\n";
  const std::string node = "12", vector = "0.5,2.0,0.0\n", own = "0.02,0.02,0.01,0.01\n", none;
  constexpr Real E = 2.1e8, G = E / 2.6, about_t = 6.6667e-9, about_s = 1.6667e-9;
  struct Case {
    const std::string &section, option, &third, &more;
    Real along_y, along_z;  // second moments that resist
    Real shear_area, load;
  };
  const Case cases[] = {{rectangle, "", node, none, about_t, about_s, 0, 1e-3},
                        {resultants, "", node, none, about_t, about_s, 0, 1e-3},
                        {rectangle, "_ORIENTATION", none, vector, about_t, about_s, 0, 1e-3},
                        {other, "_THICKNESS", node, own, about_t, about_s, 0, 1e-3},
                        {tapered, "", node, none, about_t, about_s, 0, 1e-3},
                        {tube, "", none, none, 7.3631e-9, 7.3631e-9, 0, 1e-3},
                        {thick, "", none, none, 2.1333e-3, 2.1333e-3, 0.08, 100},
                        {thick_2, "", none, none, 2.1333e-3, 2.1333e-3, 0.08, 100}};
  for (const Case& c : cases)
    for (const int dof : {2, 3}) {
      const Real I = dof == 2 ? c.along_y : c.along_z, one_point = c.section[9] == '1' ? 1 - 1.0 / 400 : 1;
      const Real expected =
          c.load * (one_point / (3 * E * I) + (c.shear_area > 0 ? 1 / (G * c.shear_area) : 0));
      EXPECT_NEAR(end_of_cantilever(c.section, c.option, c.third, c.more, dof, c.load) / expected, 1, 2e-3)
          << dof << c.option << c.section;
    }
}

// Mass of the material and NSM, half of it at each end.
TEST(Beams, MassBesidesTheMaterials) {
  BeamDeck deck;
  deck.part(1, "         3                                               0.1\n    1.0E-4\n", steel_of_beams);
  deck.line(4, 2, [](int) { return ""; });
  auto s = simulation_of(deck.text(1));
  for (Index k = 0; k <= 4; ++k)
    EXPECT_NEAR(s->world().nodes.m[k], (7850 * 1e-4 + 0.1) * 0.5 * (k == 0 || k == 4 ? 0.5 : 1), 1e-12) << k;
}

// Trusses that are six times as long as at the start: sigma = E ln 6 across is stiffer than E along, and asks
// for the step.
TEST(Beams, StringsAreStable) {
  constexpr int n = 6;
  BeamDeck deck;
  deck.part(1, "         3\n      0.01\n", "*MAT_ELASTIC\n         1       1.0       1.0       0.3\n");
  deck.line(n, n, [](int k) { return k == 0 ? ",7,7" : k == n ? ",5,7" : ""; });
  deck.velocity([](int k) -> Vec {
    return k == 1 || k > n ? Vec(Vec::Zero()) : Vec(0, 1e-6 * std::sin(3.0 * k), 1e-6 * std::cos(5.0 * k));
  });
  deck.cards += fmt::format(
      "*DEFINE_CURVE\n5\n0.0,0.0\n100.0,{0}.0\n9999.0,{0}.0\n*BOUNDARY_PRESCRIBED_MOTION_NODE\n{1},1,2,5\n"
      "*CONTROL_TIMESTEP\n0.0,0.9\n",
      5 * n, n + 1);
  auto s = simulation_of(deck.text(2000));
  while (s->clock().t < 600) s->step(test::do_nothing);
  for (Index k = 0; k <= n; ++k)
    EXPECT_LT(std::hypot(s->world().nodes.x.data(1)[k], s->world().nodes.x.data(2)[k]), 1e-3) << k;
}
