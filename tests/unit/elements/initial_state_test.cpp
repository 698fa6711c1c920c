// Stresses at the start and axial forces of beams until a time, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "../app/same_after_restart.hpp"
#include "../app/small_scene.hpp"
#include "app/run/relaxation.hpp"
#include "elements/element_report.hpp"

namespace courant {
namespace {

using test::build_deck;
using test::run;

Index node(const Simulation& s, Id id) {
  const Nodes& n = s.world().nodes;
  for (Index k = 0; k < n.size(); ++k)
    if (n.id[k] == id) return k;
  return -1;
}
ElementReport report(const Simulation& s, Id id, bool all_points = true) {
  for (const auto* pass : s.world().passes.all<const ElementReporter>())
    for (Index e = 0; e < pass->reported().size(); ++e)
      if (pass->reported().id[e] == id) return pass->report_element(s.world(), e, {.all_points = all_points});
  return {};
}
std::string refusal(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(Simulation::build("deck.k", in_memory(text), diagnostics));
  return diagnostics.text();
}

constexpr Real E = 1e9, rho = 1000, sigma = 1e5;

const std::string steel = "*MAT_ELASTIC\n1,1000.,1.E9,0.\n";

/// A cube of side 1 that moves along x at its face x = 1 alone.
std::string cube(const std::string& stress, int elform = 1, const std::string& material = steel,
                 const std::string& part = "1,1,1") {
  return "*KEYWORD\n*NODE\n1,0.,0.,0.,7\n2,1.,0.,0.,5\n3,1.,1.,0.,5\n4,0.,1.,0.,7\n"
         "5,0.,0.,1.,7\n6,1.,0.,1.,5\n7,1.,1.,1.,5\n8,0.,1.,1.,7\n"
         "*ELEMENT_SOLID\n1,1,1,2,3,4,5,6,7,8\n*PART\ncube\n" +
         part + "\n*SECTION_SOLID\n1," + std::to_string(elform) + "\n" + material +
         "*CONTROL_BULK_VISCOSITY\n0.,1.E-20\n*CONTROL_TERMINATION\n1.\n*CONTROL_TIMESTEP\n0.,0.1\n" +
         stress + "*END\n";
}

/// Half the mass on a spring E A/L: it swings about where it is free of stress.
void expect_swing(const std::string& deck) {
  const auto s = build_deck(deck, false);
  ASSERT_TRUE(s);
  std::string limit;
  s->evaluate(limit);
  EXPECT_NEAR(s->sample("").energy.internal, 0.5 * sigma * sigma / E, 1e-9 * sigma * sigma / E);
  const Real half_period = pi / std::sqrt(2 * E / rho);
  const Index n = node(*s, 2);
  run(*s, half_period);
  // strains of 2e-4 change the stiffness by as much; steps of a tenth of the stable one
  EXPECT_NEAR(s->world().nodes.x.vec(n)[0] - 1, -2 * sigma / E, 0.005 * 2 * sigma / E);
  run(*s, 2 * half_period);
  EXPECT_NEAR(s->world().nodes.x.vec(n)[0] - 1, 0, 0.01 * 2 * sigma / E);
}

TEST(InitialStressOfSolids, ReleasesItsEnergy) {
  const std::string line = "1.E5,0.,0.,0.,0.,0.,0.\n";
  expect_swing(cube("*INITIAL_STRESS_SOLID\n1,1\n" + line));
  expect_swing(cube("*INITIAL_STRESS_SOLID\n1,1\n" + line, 2));
  std::string eight = "*INITIAL_STRESS_SOLID\n1,8\n";
  for (int k = 0; k < 8; ++k) eight += line;
  expect_swing(cube(eight, 2));
  expect_swing(cube("*SET_SOLID\n5\n1\n*INITIAL_STRESS_SOLID_SET\n5,1\n" + line));
}

TEST(InitialStressOfSolids, LargeFormatHasSixteenColumnsAndNumbersMore) {
  std::string deck = "*INITIAL_STRESS_SOLID\n         1         1         2         1\n";
  deck += "     1.00000E+05     0.00000E+00     0.00000E+00     0.00000E+00     0.00000E+00\n";
  deck += "     0.00000E+00     0.00000E+00     0.00000E+00     0.00000E+00\n";
  expect_swing(cube(deck));
}

TEST(InitialStressOfSolids, PointsAreNearTheNodes) {
  std::string lines = "*INITIAL_STRESS_SOLID\n1,8\n";
  for (int k = 1; k <= 8; ++k) lines += std::to_string(k) + ".,0.,0.,0.,0.,0.,0.\n";
  const auto s = build_deck(cube(lines, 2), false);
  ASSERT_TRUE(s);
  const ElementReport points = report(*s, 1);
  ASSERT_EQ(points.points.size(), 8U);
  const Real at[] = {1, 2, 4, 3, 5, 6, 8, 7};  // points by xi, eta, zeta
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(points.points[k].stress[0], at[k]);
}

TEST(InitialStressOfSolids, PlasticStrainIsKnownToTheMaterial) {
  const std::string plastic = "*MAT_PLASTIC_KINEMATIC\n1,1000.,1.E9,0.,1.E5,1.E8\n";
  const auto s =
      build_deck(cube("*INITIAL_STRESS_SOLID\n1,1\n1.E5,0.,0.,0.,0.,0.,0.25\n", 1, plastic), false);
  ASSERT_TRUE(s);
  EXPECT_EQ(report(*s, 1).points.at(0).plastic, 0.25);
}

TEST(InitialStressOfSolids, RefusesWhatCannotHaveIt) {
  const std::string given = "*INITIAL_STRESS_SOLID\n1,1\n1.E5,0.,0.,0.,0.,0.,0.\n";
  EXPECT_NE(refusal(cube(given, 1, "*MAT_BLATZ-KO_RUBBER\n1,1000.,1.E6\n"))
                .find("the stress of element 1 follows from its deformation alone"),
            std::string::npos);
  EXPECT_NE(refusal(cube(given, 1,
                         "*MAT_ELASTIC_PLASTIC_HYDRO\n1,1000.,1.E8,1.E6\n*EOS_LINEAR_POLYNOMIAL\n1,0.,1.E9\n",
                         "1,1,1,1"))
                .find("a pressure that follows from an equation of state"),
            std::string::npos);
  EXPECT_NE(refusal(cube("*INITIAL_STRESS_SOLID\n9,1\n1.E5,0.,0.,0.,0.,0.,0.\n")).find("9"),
            std::string::npos);
  EXPECT_NE(
      refusal(cube("*INITIAL_STRESS_SOLID\n1,1\n1.E5,0.,0.,0.,0.,0.,0.1\n")).find("has no plastic strain"),
      std::string::npos);
}

TEST(InitialStressOfSolids, SaysThatTheMaterialYields) {
  Diagnostics diagnostics;
  const std::string plastic = "*MAT_PLASTIC_KINEMATIC\n1,1000.,1.E9,0.,1.E4,1.E8\n";
  EXPECT_TRUE(Simulation::build(
      "deck.k", in_memory(cube("*INITIAL_STRESS_SOLID\n1,1\n1.E5,0.,0.,0.,0.,0.,0.\n", 1, plastic)),
      diagnostics));
  EXPECT_NE(diagnostics.text().find("the stress of 1 points is beyond what the material yields at"),
            std::string::npos)
      << diagnostics.text();
}

/// A square of side 1, 0.1 thick, in the plane through x and `up`, that moves along x at x = 1 alone; "yz":
/// in that plane, along y.
std::string sheet(const std::string& stress, const std::string& up = "y", int elform = 2, int nip = 5) {
  const auto at = [&](int x, int y) {
    return up == "y"   ? fmt::format("{}.,{}.,0.", x, y)
           : up == "z" ? fmt::format("{}.,0.,{}.", x, y)
                       : fmt::format("0.,{}.,{}.", x, y);
  };
  const std::string free = up == "yz" ? ",6,7\n" : ",5,7\n";
  return "*KEYWORD\n*NODE\n1," + at(0, 0) + ",7,7\n2," + at(1, 0) + free + "3," + at(1, 1) + free + "4," +
         at(0, 1) + ",7,7\n*ELEMENT_SHELL\n1,1,1,2,3,4\n*PART\nsheet\n1,1,1\n" +
         fmt::format("*SECTION_SHELL\n1,{},1.,{}\n0.1\n", elform, nip) + steel +
         "*CONTROL_TERMINATION\n1.\n*CONTROL_TIMESTEP\n0.,0.1\n" + stress + "*END\n";
}

TEST(InitialStressOfShells, ReleasesItsEnergy) {
  for (const int elform : {2, 16})
    for (const std::string up : {"y", "z", "yz"}) {
      const int along = up == "yz";
      const std::string stress = along == 1 ? "0.,0.,1.E5,0.,0.,0.,0.,0.\n" : "0.,1.E5,0.,0.,0.,0.,0.,0.\n";
      const auto s = build_deck(sheet("*INITIAL_STRESS_SHELL\n1,1,1\n" + stress, up, elform), false);
      ASSERT_TRUE(s);
      std::string limit;
      s->evaluate(limit);
      EXPECT_NEAR(s->sample("").energy.internal, 0.1 * 0.5 * sigma * sigma / E, 1e-9 * sigma * sigma / E);
      run(*s, pi / std::sqrt(2 * E / rho));
      EXPECT_NEAR(s->world().nodes.x.vec(node(*s, 2))[along] - 1, -2 * sigma / E, 0.005 * 2 * sigma / E);
    }
}

TEST(InitialStressOfShells, LinesThroughTheThickness) {
  // two points of Gauss on a straight line, shells with five
  const auto s = build_deck(sheet("*INITIAL_STRESS_SHELL\n1,1,2\n-0.5,-50.,0.,0.,0.,0.,0.,0.\n"
                                  "0.5,150.,0.,0.,0.,0.,0.,0.\n"),
                            false);
  ASSERT_TRUE(s);
  const ElementReport points = report(*s, 1);
  const Real zeta[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
  ASSERT_EQ(points.points.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(points.points[k].stress[0], 50 + 200 * zeta[k], 1e-9);
}

TEST(InitialStressOfShells, NumbersMoreAndSeveralElements) {
  const std::string deck =
      "*INITIAL_STRESS_SHELL\n         1         1         2         9         0         0\n"
      "      -0.5       1.0       0.0       0.0       0.0       0.0       0.0       0.0\n"
      "       0.0       0.0       0.0       0.0       0.0       0.0       0.0       0.0\n       0.0\n"
      "       0.5       1.0       0.0       0.0       0.0       0.0       0.0       0.0\n"
      "       0.0       0.0       0.0       0.0       0.0       0.0       0.0       0.0\n       0.0\n"
      "         1         1         1         0         0         1\n"
      "     0.00000E+00     3.00000E+00     0.00000E+00     0.00000E+00     0.00000E+00\n"
      "     0.00000E+00     0.00000E+00     0.00000E+00\n";
  const auto s = build_deck(sheet(deck), false);
  ASSERT_TRUE(s);
  EXPECT_EQ(report(*s, 1).points.at(2).stress[0], 3);  // the later one counts
}

TEST(InitialStressOfShells, StressAcrossTheShellIsRefused) {
  EXPECT_NE(refusal(sheet("*INITIAL_STRESS_SHELL\n1,1,1\n0.,0.,0.,1.E5,0.,0.,0.,0.\n"))
                .find("shell 1 has a stress of 1e+05 across itself"),
            std::string::npos);
}

/// A bolt and a sleeve, both trusses of E A/L = 1e5, between held nodes 1 and 3 and node 2, which is damped.
std::string bolt(const std::string& more, int elform = 3, Real density = 1000) {
  return "*KEYWORD\n*NODE\n1,0.,0.,0.,7,7\n2,1.,0.,0.,5,7\n3,2.,0.,0.,7,7\n4,0.,5.,0.,7,7\n"
         "*ELEMENT_BEAM\n1,1,1,2,4\n2,2,2,3,4\n*PART\nbolt\n1,1,1\n*PART\nsleeve\n2,2,1\n" +
         (elform == 3 ? std::string("*SECTION_BEAM\n1,3\n1.E-4\n")
                      : fmt::format("*SECTION_BEAM\n1,{},1.,2,0\n0.01,0.01,0.01,0.01\n", elform)) +
         "*SECTION_BEAM\n2,3\n1.E-4\n" + fmt::format("*MAT_ELASTIC\n1,{:.1f},1.E9,0.\n", density) +
         "*DAMPING_GLOBAL\n0,2000.\n*CONTROL_TERMINATION\n1.\n*SET_BEAM\n1\n1\n"
         "*DEFINE_CURVE\n1\n0.,0.\n0.01,1.\n0.03,1.\n" +
         more + "*END\n";
}

TEST(AxialPreload, HoldsAndThenGoesOn) {
  const std::string load = "*DEFINE_CURVE\n2\n0.,0.\n0.04,0.\n0.05,1.\n1.,1.\n*LOAD_NODE_POINT\n2,1,2,30.\n";
  for (const int elform : {3, 1}) {
    const auto s = build_deck(bolt("*INITIAL_AXIAL_FORCE_BEAM\n1,1,100.\n" + load, elform), false);
    ASSERT_TRUE(s);
    run(*s, 0.029);
    EXPECT_NEAR(report(*s, 1).resultants[0], 100, 1e-9);
    EXPECT_NEAR(report(*s, 2).resultants[0], 100, 0.01);  // the sleeve is in balance with it
    EXPECT_NEAR(s->world().nodes.x.vec(node(*s, 2))[0], 1 - 100 / 1e5, 1e-6);
    run(*s, 0.04);
    EXPECT_NEAR(report(*s, 1).resultants[0], 100, 0.05);
    run(*s, 0.09);  // both are as stiff: each takes half of the load; strains of 1e-3
    EXPECT_NEAR(report(*s, 1).resultants[0], 115, 0.05);
    EXPECT_NEAR(report(*s, 2).resultants[0], 85, 0.05);
  }
}

TEST(AxialPreload, EndsWhereTheCurveFallsToZero) {
  const auto s = build_deck(bolt("*DEFINE_CURVE\n3\n0.,0.\n0.01,1.\n0.02,1.\n0.03,0.\n1.,0.\n*INITIAL_AXIAL_"
                                 "FORCE_BEAM\n1,3,100.,1\n"),
                            false);
  ASSERT_TRUE(s);
  run(*s, 0.06);
  EXPECT_NEAR(report(*s, 1).resultants[0], 100, 0.05);
}

TEST(AxialPreload, BendingStaysWithKbend) {
  // a bent beam of ELFORM 1: KBEND 1 keeps the gradient over the section, 0 does not
  for (const int kbend : {0, 1}) {
    const auto s = build_deck(
        "*KEYWORD\n*NODE\n1,0.,0.,0.,7,7\n2,1.,0.,0.,0,0\n4,0.,5.,0.,7,7\n*ELEMENT_BEAM\n1,1,1,2,4\n"
        "*PART\nbeam\n1,1,1\n*SECTION_BEAM\n1,1,1.,2,0\n0.1,0.1,0.1,0.1\n*MAT_ELASTIC\n1,1000.,1.E9,0.\n"
        "*CONTROL_TERMINATION\n1.\n*SET_BEAM\n1\n1\n*DEFINE_CURVE\n1\n0.,1.\n1.,1.\n"
        "*INITIAL_VELOCITY_NODE\n2,0.,0.1,0.\n*INITIAL_AXIAL_FORCE_BEAM\n1,1,100.," +
            std::to_string(kbend) + "\n*END\n",
        false);
    ASSERT_TRUE(s);
    run(*s, 0.002);
    Real least = 1e30, most = -1e30;
    for (const PointReport& p : report(*s, 1).points)
      least = std::min(least, p.stress[0]), most = std::max(most, p.stress[0]);
    EXPECT_NEAR(report(*s, 1).resultants[0], 100, 1e-9);
    if (kbend == 0)
      EXPECT_NEAR(most - least, 0, 1e-6);
    else
      EXPECT_GT(most - least, 100);
  }
}

TEST(AxialPreload, RefusesByName) {
  EXPECT_NE(refusal(bolt("*INITIAL_AXIAL_FORCE_BEAM\n7,1,100.\n")).find("beam set 7 does not exist"),
            std::string::npos);
  EXPECT_NE(
      refusal(
          "*KEYWORD\n*NODE\n1,0.,0.,0.,7,7\n2,1.,0.,0.,0,0\n4,0.,5.,0.,7,7\n*ELEMENT_BEAM\n1,1,1,2,4\n"
          "*PART\nbeam\n1,1,1\n*SECTION_BEAM\n1,2\n0.01,1.E-5,1.E-5,2.E-5\n*MAT_ELASTIC\n1,1000.,1.E9,0.\n"
          "*CONTROL_TERMINATION\n1.\n*SET_BEAM\n1\n1\n*DEFINE_CURVE\n1\n0.,1.\n1.,1.\n"
          "*INITIAL_AXIAL_FORCE_BEAM\n1,1,100.\n*END\n")
          .find("beam 1 has ELFORM 2, whose section has no points"),
      std::string::npos);
}

TEST(InitialStressOfSolids, SameBitsAfterARestart) {
  test::expect_same_after_restart(cube("*INITIAL_STRESS_SOLID\n1,1\n1.E5,0.,0.,0.,0.,0.,0.\n", 2), 20, 20);
}

TEST(AxialPreload, SameBitsAfterARestart) {
  test::expect_same_after_restart(bolt("*INITIAL_AXIAL_FORCE_BEAM\n1,1,100.\n", 1), 20, 100);
}

TEST(AxialPreload, OfADynamicRelaxation) {
  // SIDR 1: the relaxation alone puts it on, and the run begins with it, at rest
  const std::string deck = bolt(
      "*DEFINE_CURVE\n3,1\n0.,0.\n0.001,1.\n1.,1.\n*INITIAL_AXIAL_FORCE_BEAM\n1,3,100.\n"
      "*CONTROL_DYNAMIC_RELAXATION\n50,1.E-6,0.99\n0\n100,0\n0,0\n");
  const auto run_of = build_deck(deck, false);
  ASSERT_TRUE(run_of && run_of->relaxation().asked);
  Diagnostics diagnostics;
  const auto relaxing =
      Simulation::build("deck.k", in_memory(deck), diagnostics, nullptr, RunPhase::relaxation);
  ASSERT_TRUE(relaxing) << diagnostics.text();
  EXPECT_TRUE(relax(
                  *relaxing, [] { return false; }, [](const std::string&) {})
                  .converged);
  run_of->start_from(*relaxing);
  for (const Real until : {0.0, 0.02}) {
    run(*run_of, until);
    EXPECT_NEAR(report(*run_of, 1).resultants[0], 100, 0.1) << until;
    EXPECT_NEAR(report(*run_of, 2).resultants[0], 100, 0.1) << until;
  }
}

}  // namespace
}  // namespace courant
