// Layered shells against laminate theory (Jones 1975, chapters 2 and 4), and plies against their strengths.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <random>
#include <string>
#include <vector>

#include "elements/shell/shells.hpp"
#include "free_patches.hpp"
#include "laminates.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;
using test::start_ledger;

using namespace courant::test::laminates;

TEST(Composites, StretchBendingAndCouplingOfAnUnsymmetricLaminate) {
  const Laminate plies = {{7, 0.002, 0}, {7, 0.003, 90}, {7, 0.001, 30}, {7, 0.002, -45}};
  const auto expected = laminate_stiffness(plies);
  for (const auto& [count, bound] : {std::pair(1, 0.1), {2, 0.025}, {4, 0.0063}, {10, 0.00101}}) {
    const auto found = measured_stiffness(
        one_shell(composite_part(divided(plies, count), count == 10) + orthotropic(7)).text(1));
    EXPECT_LT(worst(found, expected), bound) << count << "\n" << found << "\n\n" << expected;
    const Eigen::Matrix3d A = found.topLeftCorner(3, 3), exact = expected.topLeftCorner(3, 3),
                          B = found.topRightCorner(3, 3);
    EXPECT_LT((A - exact).norm(), 1e-5 * exact.norm());
    EXPECT_GT(B.norm(), 0.05 * 0.008 * A.norm());
  }
}

// All ways to say that a lies 30 degrees from x.
TEST(Composites, AnglesAndDirectionsSayTheSame) {
  const Eigen::Matrix3d expected = 0.01 * turned_stiffness(30);
  const std::string v = "0.5,-0.8660254037844386,0.0", a = "0.8660254037844386,0.5,3.0";  // v x ez is along a
  const std::string part = "*PART\nplate\n1,1,7\n";
  const std::string plain = part + "*SECTION_SHELL\n1,2,1.0,3\n0.01\n";
  const auto with_element = [&](const std::string& keyword, const std::string& line,
                                const std::string& cards) {
    std::string text = one_shell(cards).text(1);
    const std::size_t at = text.find("*ELEMENT_SHELL\n"), end = text.find("*END");
    const std::size_t first = text.find('\n', at) + 1;
    return text.substr(0, at) + keyword + "\n" + text.substr(first, end - first) + line + "\n*END\n";
  };
  const std::string none = "0.0,0.0,0.0";
  const std::vector<std::pair<std::string, std::string>> decks = {
      {"BETA", one_shell(plain + orthotropic(7, "0.0", none, none, 30)).text(1)},
      {"AOPT 2", one_shell(plain + orthotropic(7, "2.0", a)).text(1)},
      {"AOPT 3", one_shell(plain + orthotropic(7, "3.0", none, v)).text(1)},
      {"AOPT 3 and BETA", one_shell(plain + orthotropic(7, "3.0", none, "0.0,-1.0,0.0", 30)).text(1)},
      {"AOPT < 0", one_shell(plain + orthotropic(7, "-5.0") +
                             "*DEFINE_COORDINATE_VECTOR\n5,0.8660254037844386,0.5,0.0,0.0,1.0,0.0\n")
                       .text(1)},
      {"ICOMP", one_shell(part + "*SECTION_SHELL\n1,2,1.0,3,1.0,0,1\n0.01\n30.0,30.0,30.0\n" + orthotropic(7))
                    .text(1)},
      {"ICOMP and BETA", one_shell(part + "*SECTION_SHELL\n1,2,1.0,3,1.0,0,1\n0.01\n20.0,20.0,20.0\n" +
                                   orthotropic(7, "0.0", none, none, 10))
                             .text(1)},
      {"rule", one_shell(part + "*PART\nother\n2,1,8\n*SECTION_SHELL\n1,2,1.0,2,1.0,-3,1\n0.01\n30.0,30.0\n" +
                         orthotropic(7) + orthotropic(8) + "*INTEGRATION_SHELL\n3,2\n-0.6,0.4,2\n0.4,0.6\n")
                   .text(1)},
      {"ESOP", one_shell(part + "*SECTION_SHELL\n1,2,1.0,12,1.0,-3,1\n0.01\n" +
                         std::string("30.,30.,30.,30.,30.,30.,30.,30.\n") + "30.0,30.0,30.0,30.0\n" +
                         orthotropic(7) + "*INTEGRATION_SHELL\n3,12,1\n")
                   .text(1)},
      {"layers",
       one_shell(composite_part({{7, 0.004, 30}, {7, 0.004, 30}, {7, 0.002, 30}}) + orthotropic(7)).text(1)},
      {"_BETA",
       with_element("*ELEMENT_SHELL_BETA",
                    "            0.01            0.01            0.01            0.01            30.0",
                    plain + orthotropic(7, "0.0", none, none, 77))},
      {"INN 2",
       one_shell("*CONTROL_ACCURACY\n0,2\n" + plain + orthotropic(7, "0.0", none, none, 30)).text(1)},
  };
  for (const auto& [name, deck] : decks) {
    const auto found = measured_stiffness(deck);
    EXPECT_LT((found.topLeftCorner(3, 3) - expected).norm(), 1e-5 * expected.norm()) << name << "\n" << found;
  }
}

// A mirror x -> -x turns the normal round, and the sense of an angle about it: BETA stays, and the material
// lies as its mirror image, 30 degrees from -x.
TEST(Composites, MirroredShellsKeepTheirAngle) {
  const Eigen::Matrix3d expected = 0.01 * turned_stiffness(-30);
  const std::string plain = "*PART\nplate\n1,1,7\n*SECTION_SHELL\n1,2,1.0,3\n0.01\n", none = "0.0,0.0,0.0";
  for (const std::string& material :
       {orthotropic(7, "0.0", none, none, 30), orthotropic(7, "3.0", none, "-0.5,-0.8660254037844386,0.0"),
        orthotropic(7, "3.0", none, "0.0,-1.0,0.0", 30)}) {
    ShellDeck deck = one_shell(plain + material);
    for (Vec& x : deck.nodes) x[0] = -x[0];
    const auto found = measured_stiffness(deck.text(1));
    for (int mode = 0; mode < 3; ++mode)
      for (int k = 0; k < 2; ++k)  // what is along the axes has no sign to lose
        EXPECT_NEAR(found(k, mode), expected(k, mode), 1e-5 * expected.norm()) << material << mode;
  }
}

namespace {

/// A shell with a strip's freedom is pulled along x until its end has moved by `way`; the force over the
/// strain, and width 1.
struct PulledPly {
  Real stiffness, contraction;
};
PulledPly pulled_ply(const std::string& cards, Real way) {
  ShellDeck deck = one_shell(cards);
  deck.hold(1, "xzXYZ", [](const Vec& x) { return x[0] < 0.5; });
  deck.hold(2, "y", [](const Vec& x) { return x.norm() < 0.5; });
  deck.hold(4, "zXYZ", [](const Vec& x) { return x[0] > 0.5; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 0.5; });
  const Real end = 0.05, ramp = 0.04;  // a hundred periods, of which the last are at rest
  deck.cards += fmt::format(
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,2,9\n*DEFINE_CURVE\n9\n0.0,0.0\n{0},{1}\n{2},{1}\n*DAMPING_"
      "GLOBAL\n0,2000.0\n",
      ramp, way, end);
  auto s = simulation_of(deck.text(end));
  while (s->clock().t < end) s->step(do_nothing);
  const World& world = s->world();
  const ElementGroup& group = *world.groups[0];
  const Field<Real>& stress = layer_stress_of(group, 2);
  const Real force = (stress.data(at_layer(0, 0))[0] + stress.data(at_layer(1, 0))[0]) / 2;
  const Vec a = world.nodes.x.vec(0), b = world.nodes.x.vec(2);
  return {force / way, (1 - (b - a)[1]) / way};
}

}  // namespace

// 1/Ex = c^4/EA + (1/GAB - 2 nu/EA) s^2 c^2 + s^4/EB, where stress is along x alone.
TEST(Composites, ModulusOfATurnedPly) {
  for (const Real degrees : {0.0, 20.0, 45.0, 70.0, 90.0}) {
    const Real c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180), nu = PRBA * EA / EB;
    const Real expected =
        1 / (std::pow(c, 4) / EA + (1 / GAB - 2 * nu / EA) * s * s * c * c + std::pow(s, 4) / EB);
    const PulledPly found = pulled_ply("*PART\nply\n1,1,7\n*SECTION_SHELL\n1,2,1.0,2\n1.0\n" +
                                           orthotropic(7, "0.0", "0.0,0.0,0.0", "0.0,0.0,0.0", degrees),
                                       1e-5);
    EXPECT_NEAR(found.stiffness / expected, 1, 0.002) << degrees;
  }
}

// f = 1.8751^2/(2 pi L^2) sqrt(1/(d xx m)), d the inverse of D: the moment is along the strip alone; m mass
// per area.
TEST(Composites, FrequencyOfALayeredCantilever) {
  const Laminate plies = divided({{7, 0.001, 0}, {7, 0.002, 90}, {7, 0.001, 0}}, 4);
  const Real L = 0.4, m = RO * 0.004;
  const Real expected =
      std::pow(1.8751, 2) / (2 * pi * L * L) *
      std::sqrt(1 / (laminate_stiffness(plies).bottomRightCorner<3, 3>().inverse()(0, 0) * m));
  for (const auto& [n, bound] : {std::pair(10, 0.02), {20, 0.01}}) {
    ShellDeck deck;
    deck.plate(L, L / 20, n, 1, 1);
    deck.cards = composite_part(plies) + orthotropic(7);
    deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
    deck.velocity([&](const Vec& x) { return Vec(0, 0, 0.01 * x[0] * x[0] / (L * L)); });
    auto s = simulation_of(deck.text(1));
    std::vector<Real> at;
    Real before = 0;
    while (at.size() < 5 && s->clock().t < 1) {
      s->step(do_nothing);
      const Real z = s->world().nodes.x.data(2)[n];
      if (before * z < 0) at.push_back(s->clock().t);
      before = z;
    }
    ASSERT_EQ(at.size(), 5U);
    EXPECT_NEAR(4 / (2 * (at.back() - at.front())) / expected, 1, bound) << n;
  }
}

namespace {

std::string ply_that_fails(int mid, const std::string& dfailt = "0.0") {
  return fmt::format(
      "*MAT_054\n{},{},{},{},0.0,{}\n{},{},{}\n\n\n0.0,0.0,0.0,0.0,0.0,{}\n1.3E9,1.9E9,2.0E8,6.0E7,9.5E7\n",
      mid, RO, EA, EB, PRBA, GAB, GBC, GCA, dfailt);
}
const std::string aluminium = "*MAT_ELASTIC\n8,2700.0,7.0E10,0.3\n";

/// Of one shell that is pulled along x: the strain at which it is deleted, 0 if it is not up to 5 %.
Real strain_of_deletion(const std::string& cards) {
  ShellDeck deck = one_shell(cards + "*CONTROL_TIMESTEP\n0.0,0.1\n");
  deck.hold(1, "xzXYZ", [](const Vec& x) { return x[0] < 0.5; });
  deck.hold(2, "yzXYZ", [](const Vec& x) { return x[1] < 0.5; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 0.5; });
  const Real speed = 20;
  deck.cards +=
      fmt::format("*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,9\n*DEFINE_CURVE\n9\n0.0,{0}\n1.0,{0}\n", speed);
  auto s = simulation_of(deck.text(0.05 / speed));
  while (s->clock().t < 0.05 / speed) {
    s->step(do_nothing);
    const auto deleted = s->world().counters.find("deleted_elements");
    if (deleted != s->world().counters.end() && deleted->second > 0)
      return std::log(1 + speed * (s->clock().t - s->clock().dt_old));
  }
  return 0;
}

}  // namespace

TEST(Composites, AShellGoesWithItsLastPly) {
  const Real of_ply = 1.9e9 / EA;  // without Poisson's ratio in the way
  const std::string part =
      "*PART\nplate\n1,1,7\n*SECTION_SHELL\n1,2,1.0,2,1.0,-3\n0.01\n*PART\ncore\n2,1,8\n";
  const auto rule = [](int failopt) {
    return fmt::format("*INTEGRATION_SHELL\n3,3,0,{}\n-0.8,0.2\n0.0,0.6,2\n0.8,0.2\n", failopt);
  };
  EXPECT_NEAR(strain_of_deletion(composite_part({{7, 0.002, 0}, {7, 0.002, 0}}) + ply_that_fails(7)) / of_ply,
              1, 0.01);
  EXPECT_NEAR(strain_of_deletion(part + rule(0) + ply_that_fails(7) + aluminium) / of_ply, 1, 0.02);
  EXPECT_EQ(strain_of_deletion(part + rule(1) + ply_that_fails(7) + aluminium), 0);
  EXPECT_NEAR(strain_of_deletion(composite_part({{7, 0.002, 0}, {8, 0.002, 0}}) + ply_that_fails(7, "0.03") +
                                 aluminium),
              0.03, 0.0005);
  // failure limits of different laws: plastic strain 0.01 of the one, the ply of the other, whichever is
  // later
  const std::string plastic = "*MAT_PIECEWISE_LINEAR_PLASTICITY\n8,2700.0,7.0E10,0.3,2.1E8,0.0,0.02\n\n\n\n";
  EXPECT_NEAR(
      strain_of_deletion(composite_part({{7, 0.002, 0}, {8, 0.002, 0}}) + ply_that_fails(7) + plastic),
      0.02 + 2.1e8 / 7e10, 0.003);
}

TEST(Composites, LayersOfSeveralMaterialsWeighTheirMean) {
  auto s = simulation_of(
      one_shell(composite_part({{7, 0.002, 0}, {8, 0.006, 0}}) + orthotropic(7) + aluminium).text(1));
  EXPECT_NEAR(s->world().groups[0]->mass[0], 0.002 * RO + 0.006 * 2700, 1e-12);
  EXPECT_NEAR(s->world().nodes.m[0], (0.002 * RO + 0.006 * 2700) / 4, 1e-12);
}

// Thrown across with a speed at which plies fail; all forms of shells.
TEST(Composites, SameBitsOnThreadsAndAfterARestart) {
  for (const int elform : {2, 4, 16}) {
    ShellDeck deck;
    deck.plate(0.1, 0.1, 12, 12, 1, nullptr, elform == 4);
    std::string part = composite_part({{7, 0.0005, 0}, {8, 0.001, 0}, {7, 0.0005, 45}, {9, 0.0003, -30}});
    part.replace(part.find("1,2,"), 4, fmt::format("1,{},", elform));
    deck.cards = part + ply_that_fails(7) + aluminium + orthotropic(9, "2.0", "1.0,1.0,0.0");
    deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9 || x[0] > 0.1 - 1e-9; });
    deck.velocity([](const Vec& x) { return Vec(0, 0, 120 * std::sin(pi * x[0] / 0.1) * (1 + 5 * x[1])); });
    test::expect_same_bits(deck.text(1), 240, 110);
  }
}

// Free patches of layers that differ much do not grow at TSSFAC 0.9.
TEST(Composites, FreePatchesAreStable) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> number(-1, 1);
  for (const bool triangles : {false, true})
    for (const Laminate& plies :
         {Laminate{{7, 0.01, 0}}, {{7, 0.1, 45}, {8, 0.02, 0}, {7, 0.03, 90}}, {{7, 0.3, 20}}}) {
      ShellDeck deck;
      deck.plate(
          3, 3, 3, 3, 1, [&](const Vec& x) { return Vec(x + 0.2 * Vec(number(random), number(random), 0)); },
          triangles);
      deck.cards = composite_part(plies) + orthotropic(7) + aluminium;
      deck.cards +=
          "*CONTROL_BULK_VISCOSITY\n1.0E-9,1.0E-9\n*CONTROL_HOURGLASS\n4,0.1\n*CONTROL_TIMESTEP\n0.0,0.9\n";
      auto s = simulation_of(deck.text(1e9));
      const test::Growth noise = test::growth_of_noise(*s, random, number);
      EXPECT_LT(noise.late, 2 * noise.early) << triangles << " " << plies.size();
    }
}

// *ELEMENT_MASS_PART: by the area of the shells; _SET with MWD 1 by mass.
TEST(PartMasses, AreSpreadOverNodes) {
  const auto deck = [](const std::string& mass) {
    ShellDeck out;
    out.plate(1, 1, 1, 1, 1);
    out.plate(1, 2, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(5, 0, 0)); });
    out.part(1, 0.01, "*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n");
    out.part(2, 0.03, "*MAT_ELASTIC\n2,1000.0,1.0E9,0.3\n");
    out.cards += "*SET_PART_LIST\n5\n1,2\n" + mass;
    return out.text(1);
  };
  const auto masses = [&](const std::string& mass) {
    auto s = simulation_of(deck(mass));
    return std::array{s->world().nodes.m[0], s->world().nodes.m[4]};
  };
  const auto plain = masses("");
  EXPECT_NEAR(plain[0], 10.0 / 4, 1e-12);
  EXPECT_NEAR(plain[1], 60.0 / 4, 1e-12);
  const auto one = masses("*ELEMENT_MASS_PART\n1,8.0\n2,0.0,100.0\n");
  EXPECT_NEAR(one[0], 18.0 / 4, 1e-12);
  EXPECT_NEAR(one[1], 100.0 / 4, 1e-12);
  const auto by_area = masses("*ELEMENT_MASS_PART_SET\n5,21.0\n");
  EXPECT_NEAR(by_area[0], (10.0 + 7) / 4, 1e-12);
  EXPECT_NEAR(by_area[1], (60.0 + 14) / 4, 1e-12);
  const auto by_mass = masses("*ELEMENT_MASS_PART_SET\n5,21.0,0.0,0,1\n");
  EXPECT_NEAR(by_mass[0], (10.0 + 3) / 4, 1e-12);
  EXPECT_NEAR(by_mass[1], (60.0 + 18) / 4, 1e-12);
}
