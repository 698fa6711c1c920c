// *INTEGRATION_BEAM: points of sections, against closed solutions of beams.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "beam_decks.hpp"
#include "elements/beam/standard_section.hpp"
#include "elements/element_report.hpp"
#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using namespace courant::test::beams;
using test::do_nothing;
using test::simulation_of;

namespace {

struct Moments {
  Real A = 0, s = 0, t = 0, ss = 0, tt = 0, st = 0;
};
Moments moments_of(const StandardSection& section) {
  Moments out;
  for (const SectionCell& c : section.cells)
    out.A += c.area, out.s += c.area * c.s, out.t += c.area * c.t, out.ss += c.area * c.s * c.s,
        out.tt += c.area * c.t * c.t, out.st += c.area * c.s * c.t;
  return out;
}
/// Of rectangles s0 s1 t0 t1.
Moments moments_of(const std::vector<std::array<Real, 4>>& rectangles) {
  Moments out;
  for (const auto& [s0, s1, t0, t1] : rectangles) {
    const Real b = s1 - s0, h = t1 - t0, A = b * h, s = (s0 + s1) / 2, t = (t0 + t1) / 2;
    out.A += A, out.s += A * s, out.t += A * t, out.st += A * s * t;
    out.ss += A * (s * s + b * b / 12), out.tt += A * (t * t + h * h / 12);
  }
  return out;
}
void expect_same(const Moments& a, const Moments& b, const char* what) {
  for (const auto& [x, y] : {std::pair(a.A, b.A), std::pair(a.s, b.s), std::pair(a.t, b.t),
                             std::pair(a.ss, b.ss), std::pair(a.tt, b.tt), std::pair(a.st, b.st)})
    EXPECT_NEAR(x, y, 1e-12) << what;
}

const std::string by_rule = "         1       1.0        -7         2\n\n";
const std::string rule_i = "*INTEGRATION_BEAM\n7,0,0.0,1\n0.05,0.008,0.1,0.005\n";  // W 50, TF 8, D 100, TW 5
constexpr Real area_i = 2 * 0.05 * 0.008 + 0.084 * 0.005;
const Real about_s = 0.05 * 0.001 / 12 - 0.045 * std::pow(0.084, 3) / 12;
const Real about_t = 2 * 0.008 * std::pow(0.05, 3) / 12 + 0.084 * std::pow(0.005, 3) / 12;

/// A cantilever along x of length 2 and `n` beams, s along y; the deflection of its end under a load there.
Real deflection(const std::string& section, const std::string& more, int n, int dof, Real load,
                const std::string& material = "*MAT_ELASTIC\n         1      78.5   2.1E+08       0.3\n") {
  BeamDeck deck;
  deck.part(1, section, material);
  deck.line(n, 2, [](int k) { return k == 0 ? ",7,7" : ""; });
  deck.cards += more + fmt::format(
                           "*LOAD_NODE_POINT\n{},{},1,{}\n*DEFINE_CURVE\n1\n0.0,0.0\n1.0,1.0\n90.0,1.0\n"
                           "*DAMPING_GLOBAL\n0,16.0\n",
                           n + 1, dof, load);
  auto s = simulation_of(deck.text(20));
  if (!s) return 0;
  while (s->clock().t < 2.2) s->step(do_nothing);
  return s->world().nodes.x.data(dof - 1)[n];
}

}  // namespace

TEST(BeamRules, StandardSectionsHaveTheirMoments) {
  const Real w = 0.5, tf = 0.1, d = 0.8, tw = 0.06;
  const std::array<Real, 4> dimensions{w, tf, d, tw};
  std::string why;
  const auto section = [&](int icst) { return moments_of(standard_section(icst, dimensions, 1, why)); };
  const Real a = w / 2, b = d / 2;
  expect_same(section(1),
              moments_of({{-a, a, b - tf, b}, {-a, a, -b, -b + tf}, {-tw / 2, tw / 2, -b + tf, b - tf}}),
              "I");
  expect_same(section(2),
              moments_of({{-a, a, b - tf, b}, {-a, a, -b, -b + tf}, {-a, -a + tw, -b + tf, b - tf}}),
              "channel");
  expect_same(section(3), moments_of({{-a, a, -b, -b + tf}, {-a, -a + tw, -b + tf, b}}), "angle");
  expect_same(section(4), moments_of({{-a, a, b - tf, b}, {-tw / 2, tw / 2, -b, b - tf}}), "T");
  expect_same(section(5),
              moments_of({{-a, a, b - tf, b},
                          {-a, a, -b, -b + tf},
                          {-a, -a + tw, -b + tf, b - tf},
                          {a - tw, a, -b + tf, b - tf}}),
              "box tube");
  expect_same(
      section(6),
      moments_of({{-a, tw / 2, b - tf, b}, {-tw / 2, a, -b, -b + tf}, {-tw / 2, tw / 2, -b + tf, b - tf}}),
      "Z");
  expect_same(moments_of(standard_section(11, {0.3, 0.7, 0, 0}, 1, why)),
              moments_of({{-0.15, 0.15, -0.35, 0.35}}), "box");
  const Moments trapezoid = moments_of(standard_section(7, {0.6, 0.2, 0.9, 0}, 1, why));
  EXPECT_NEAR(trapezoid.A, 0.36, 1e-12);
  EXPECT_NEAR(trapezoid.t / trapezoid.A, 0.9 / 3 * (0.6 + 0.4) / 0.8 - 0.45, 1e-12);
  const Moments tube = moments_of(standard_section(9, {0.5, 0.3, 0, 0}, 1, why)),
                circle = moments_of(standard_section(8, {0.5, 0, 0, 0}, 1, why));
  EXPECT_NEAR(tube.A, pi * 0.16, 1e-12);
  EXPECT_NEAR(tube.ss, pi / 4 * (std::pow(0.5, 4) - std::pow(0.3, 4)), 1e-12);
  EXPECT_NEAR(circle.tt, pi / 4 * std::pow(0.5, 4), 1e-12);
  EXPECT_NEAR(circle.A, pi * 0.25, 1e-12);
}

// P L^3/(3 EI) + P L/(SHRF G A), about the strong and the weak axis; one point along each beam.
TEST(BeamRules, AnIBeamBends) {
  const Real E = 2.1e8, G = E / 2.6, L = 2;
  for (const auto& [dof, I] : {std::pair(3, about_s), std::pair(2, about_t)}) {
    std::array<Real, 2> error{};
    for (const int n : {10, 20}) {
      const Real load = 0.02 * 3 * E * I / (L * L * L);
      const Real seen = deflection(by_rule, rule_i, n, dof, load);
      const Real exact = load * L * L * L / (3 * E * I) + load * L / (G * area_i);
      error[n == 20] = std::abs(seen / exact - 1);
    }
    EXPECT_LT(error[1], 0.01) << dof;
    EXPECT_LT(error[1], error[0]) << dof;
  }
}

// Points by hand: four points of Gauss on half the area of TS x TT bend as the whole under twice the load.
TEST(BeamRules, PointsByHandAreThoseOfGauss) {
  const std::string points =
      "*INTEGRATION_BEAM\n7,4,0.5,0\n-0.57735026919,-0.57735026919,0.25\n0.57735026919,-0.57735026919,0.25\n"
      "-0.57735026919,0.57735026919,0.25\n0.57735026919,0.57735026919,0.25\n";
  const std::string widths = "      0.05      0.05      0.08      0.08\n";
  const Real by_rule = deflection("         1       1.0        -7         2\n" + widths, points, 5, 3, 10),
             by_gauss = deflection("         1       1.0         2         0\n" + widths, "", 5, 3, 20);
  EXPECT_NE(by_rule, 0);
  EXPECT_NEAR(by_rule / by_gauss, 1, 1e-7);
}

// Under a axial force through the middle of its box a T bends: w'' = M/(EI) with M = P e, e to its centroid.
TEST(BeamRules, PullOffTheCentroidBends) {
  const Real E = 2.1e8, L = 2, P = 200;
  const std::string rule = "*INTEGRATION_BEAM\n7,0,0.0,4\n0.05,0.008,0.06,0.005\n";
  const Moments m = moments_of({{-0.025, 0.025, 0.022, 0.03}, {-0.0025, 0.0025, -0.03, 0.022}});
  const Real e = m.t / m.A, I = m.tt - m.A * e * e;
  constexpr int n = 10;
  BeamDeck deck;
  deck.part(1, by_rule, "*MAT_ELASTIC\n         1      78.5   2.1E+08       0.3\n");
  deck.line(n, L, [](int k) { return k == 0 ? ",7,7" : ""; });
  deck.cards += rule + fmt::format(
                           "*LOAD_NODE_POINT\n{},1,1,{}\n*DEFINE_CURVE\n1\n0.0,0.0\n1.0,1.0\n90.0,1.0\n"
                           "*DAMPING_GLOBAL\n0,16.0\n",
                           n + 1, P);
  auto s = simulation_of(deck.text(20));
  ASSERT_NE(s, nullptr);
  while (s->clock().t < 2.2) s->step(do_nothing);
  // the axial force straightens the bow, too: a beam with M = P e at its ends under P, k^2 = P/EI
  const Real k = std::sqrt(P / (E * I)), exact = e * (1 - 1 / std::cosh(k * L));
  EXPECT_NEAR(s->world().nodes.x.data(2)[n] / exact, 1, 0.01);
}

// Turned at its end, an ideally plastic I-beam has a moment of SIGY Z: 2 (W TF (D - TF)/2) + TW (D/2 - TF)^2.
TEST(BeamRules, PlasticMomentOfAnI) {
  const Real sigy = 3e5, Z = 0.05 * 0.008 * 0.092 + 0.005 * 0.042 * 0.042;
  BeamDeck deck;
  deck.part(
      1, by_rule,
      "*MAT_PLASTIC_KINEMATIC\n         1    7850.0   2.1E+08       0.3     3.0E5       0.0       0.0\n\n");
  deck.line(1, 0.2, [](int k) { return k == 0 ? ",7,7" : ",2,6"; });
  deck.cards +=
      rule_i + "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,6,0,1,-1.0\n*DEFINE_CURVE\n1\n0.0,0.0\n1.0,0.05\n";
  auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  while (s->clock().t < 0.99) s->step(do_nothing);
  for (const auto* beams : s->world().passes.all<const ElementReporter>()) {
    const Real moment = std::abs(beams->report_element(s->world(), 0, {}).resultants[3]);
    EXPECT_NEAR(moment / (sigy * Z), 1, 0.01);
  }
}

// Free beams of all standard sections do not gain energy at the step that they ask for.
TEST(BeamRules, AllSectionsAreStable) {
  for (const int icst : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11}) {
    BeamDeck deck;
    deck.part(1, by_rule, "*MAT_ELASTIC\n         1    7850.0   2.1E+11       0.3\n");
    deck.line(6, 0.6, [](int) { return ""; });
    deck.velocity([](int k) -> Vec {
      return k > 7 ? Vec(Vec::Zero()) : Vec(std::sin(7.0 * k), std::sin(3.0 * k), std::cos(5.0 * k));
    });
    deck.cards += fmt::format(
        "*INTEGRATION_BEAM\n7,0,0.0,{}\n0.05,0.02,0.08,0.01\n*CONTROL_TIMESTEP\n0.0,0.95\n", icst);
    auto s = simulation_of(deck.text(1));
    ASSERT_NE(s, nullptr) << icst;
    test::start_ledger(*s);
    for (int k = 0; k < 4000; ++k) s->step(do_nothing);
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.02) << icst;
  }
}

TEST(BeamRules, AreRefusedByName) {
  const auto faults = [](const std::string& rule, const std::string& section) {
    BeamDeck deck;
    deck.part(1, section, steel_of_beams);
    deck.line(1, 1, [](int) { return ""; });
    deck.cards += rule;
    const std::string text = deck.text(1);
    Diagnostics diagnostics;
    ReadOptions options;
    options.open = [text](const std::string&) { return text; };
    Simulation::build("test.k", options, diagnostics);
    return diagnostics.text();
  };
  const std::string no_widths = "         1       1.0        -7         2\n";
  const std::string widths = "      0.05      0.05      0.08      0.08\n";
  const auto expect = [&](const std::string& rule, const char* message) {
    const std::string text =
        faults(rule, no_widths + (rule.find(",0,0.0,") == std::string::npos ? widths : "\n"));
    EXPECT_NE(text.find(message), std::string::npos) << message << "\n" << text;
  };
  expect("", "rule 7 does not exist");
  expect("*INTEGRATION_BEAM\n7,0,0.0,13\n0.05,0.01,0.1,0.01\n", "'13' is not supported: 1 to 9 and 11 are");
  expect("*INTEGRATION_BEAM\n7,0,0.0,1\n0.05,0.06,0.1,0.01\n", "flanges must be thinner than D");
  expect("*INTEGRATION_BEAM\n7,1,0.0,0\n0.0,0.0,1.0\n", "the section has no area");
  expect("*INTEGRATION_BEAM\n7,2,1.0,0\n0.0,0.0,1.0\n", "1 points are given, not 2");
  expect("*INTEGRATION_BEAM\n7,1,1.0,0\n0.0,1.5,1.0\n", "point 1 lies outside of the section");
  expect("*INTEGRATION_BEAM\n7,1,1.0,0\n0.0,0.5,0.5\n", "the weights sum up to 0.5");
  expect("*INTEGRATION_BEAM\n7,1,1.0,0\n0.0,0.5,1.0,1\n", "PID");
}

TEST(BeamRules, HaveTheSameBits) {
  BeamDeck deck;
  deck.part(
      1, by_rule,
      "*MAT_PLASTIC_KINEMATIC\n         1    7850.0   2.1E+11       0.3     3.0E6       0.0       0.0\n\n");
  deck.line(6, 0.6, [](int) { return ""; });
  deck.velocity([](int k) -> Vec {
    return k > 7 ? Vec(Vec::Zero()) : Vec(std::sin(7.0 * k), std::sin(3.0 * k), std::cos(5.0 * k));
  });
  deck.cards += "*INTEGRATION_BEAM\n7,0,0.0,2\n0.05,0.02,0.08,0.01\n";
  test::expect_same_bits(deck.text(1), 60, 23);
}
