// Shells whose middle surface does not lie where their nodes are (NLOC, OFFSET), against laminate theory,
// beams under an eccentric pull, and shells without an offset.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "free_patches.hpp"
#include "laminates.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

namespace courant::test::offset_shells {

namespace {

using laminates::measured_stiffness;
using laminates::one_shell;

/// The deck with an OFFSET behind each of its shells.
std::string with_offsets(std::string text, Real offset) {
  const std::string keyword = "*ELEMENT_SHELL\n";
  std::size_t at = text.find(keyword);
  text.replace(at, keyword.size(), "*ELEMENT_SHELL_OFFSET\n");
  at = text.find('\n', at) + 1;
  while (text[at] != '*') {
    at = text.find('\n', at) + 1;
    const std::string line = fmt::format("{:16.9e}\n", offset);
    text.insert(at, line), at += line.size();
  }
  return text;
}

/// Gives the section of part `id` an NLOC.
void give_nloc(ShellDeck& deck, Real nloc, int id = 1) {
  const std::string section = fmt::format("*SECTION_SHELL\n{:10}", id);
  std::size_t at = deck.cards.find(section);
  ASSERT_NE(at, std::string::npos);
  at = deck.cards.find('\n', deck.cards.find('\n', at) + 1) + 1;
  at = deck.cards.find('\n', at);
  deck.cards.insert(at, fmt::format("{:>40.3g}", nloc));
}

/// [A, B + o A; B + o A, D + 2 o B + o^2 A]: stiffness about a plane that lies o below the middle.
Eigen::Matrix<Real, 6, 6> about_nodes(const Eigen::Matrix<Real, 6, 6>& middle, Real o) {
  Eigen::Matrix<Real, 6, 6> shift = Eigen::Matrix<Real, 6, 6>::Identity();
  shift.topRightCorner<3, 3>() = o * Eigen::Matrix3d::Identity();
  return shift.transpose() * middle * shift;
}

/// A strip along x, clamped at x = 0.
ShellDeck strip(Real L, Real b, int n) {
  ShellDeck deck;
  deck.plate(L, b, n, 1, 1);
  deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
  return deck;
}
const std::string without_contraction = "*MAT_ELASTIC\n         1    7850.0   2.1E+11       0.0\n";

Real swing(Simulation& s, Index node, int crossings) {
  std::vector<Real> at;
  Real before = 0, t_before = 0;
  while (static_cast<int>(at.size()) < crossings && s.clock().t < 10) {
    s.step(do_nothing);
    const Real z = s.world().nodes.x.data(2)[node], t = s.clock().t;
    if (before * z < 0) at.push_back(t_before + before / (before - z) * (t - t_before));
    before = z, t_before = t;
  }
  return static_cast<Real>(at.size() - 1) / (2 * (at.back() - at.front()));
}

}  // namespace

TEST(OffsetShells, StretchBendingAndCouplingAboutTheNodes) {
  const Real t = 0.01;
  const laminates::Laminate one = {{7, t, 20}};
  const auto middle = laminates::laminate_stiffness(one);
  const std::string angles = "20.0,20.0\n";
  for (const std::string options : {"", "*CONTROL_SHELL\n20.0,0,-1,0,2,1\n"})
    for (const int elform : {2, 16})
      for (const Real nloc : {1.0, -1.0, 0.4}) {
        const auto cards = [&](const std::string& in_section) {
          return options +
                 fmt::format("*PART\nplate\n1,1,7\n*SECTION_SHELL\n1,{},1.0,2,1.0,0,1\n{},0,0,0,{}\n", elform,
                             t, in_section) +
                 angles + laminates::orthotropic(7);
        };
        const auto expected = about_nodes(middle, -0.5 * nloc * t);
        const auto of_section = measured_stiffness(one_shell(cards(fmt::format("{}", nloc))).text(1));
        EXPECT_LT(laminates::worst(of_section, expected), 1e-5) << options << elform << " " << nloc;
        const auto of_element =
            measured_stiffness(with_offsets(one_shell(cards("0.3")).text(1), -0.5 * nloc * t));
        EXPECT_LT(laminates::worst(of_element, expected), 1e-5) << options << elform << " " << nloc;
      }
}

TEST(OffsetShells, LayersLieOverTheNodes) {
  const laminates::Laminate plies = laminates::divided({{7, 0.002, 0}, {7, 0.003, 90}, {7, 0.001, 30}}, 8);
  const Real t = 0.006;
  std::string cards = laminates::composite_part(plies) + laminates::orthotropic(7);
  const std::string card = "1,2,1\n";
  cards.replace(cards.find(card), card.size(), "1,2,1,-1.0\n");
  const auto expected = about_nodes(laminates::laminate_stiffness(plies), 0.5 * t);
  // the points are in the middle of layers: about (1/8)^2 of the bending of each
  EXPECT_LT(laminates::worst(measured_stiffness(one_shell(cards).text(1)), expected), 2e-3);
}

// A pull P in the plane of the nodes of a strip that is clamped there bends it by P o, o to its middle, and
// holds it straight: w = o (1 - 1/cosh(L sqrt(P/(E I)))) of a beam.
TEST(OffsetShells, AnEccentricPullBendsAStrip) {
  const Real L = 1, b = 0.1, t = 0.02, I = b * t * t * t / 12, E = 2.1e11;
  const Real P = 1e-3 * E * b * t * t / L;
  for (const Real nloc : {-1.0, 0.5}) {
    for (const int n : {10, 20}) {
      ShellDeck deck = strip(L, b, n);
      deck.part(1, t, without_contraction);
      give_nloc(deck, nloc);
      deck.node_set(2, [&](const Vec& x) { return x[0] > L - 1e-9; });
      deck.cards += fmt::format(
          "*LOAD_NODE_SET\n         2         1         1{:10.3e}\n*DEFINE_CURVE\n         "
          "1\n{:20}{:20}\n{:20}"
          "{:20}\n{:20}{:20}\n*DAMPING_GLOBAL\n         0     200.0\n",
          P / 2, 0.0, 0.0, 0.05, 1.0, 10.0, 1.0);
      auto s = simulation_of(deck.text(10));
      while (s->clock().t < 0.15) s->step(do_nothing);
      const Real o = -0.5 * nloc * t;
      const Real found =
          s->world().nodes.x.data(2)[n] / (o * (1 - 1 / std::cosh(L * std::sqrt(P / (E * I)))));
      EXPECT_NEAR(found, 1, 0.01) << nloc << " " << n;
    }
  }
}

// Two sheets on the same nodes, one above and one below, are one of twice the thickness.
TEST(OffsetShells, TwoSheetsAreOneOfTwiceTheThickness) {
  const auto frequency = [](bool two) {
    const int n = 20;
    ShellDeck deck = strip(1, 0.1, n);
    if (two) {
      for (int e = 1; e <= n; ++e)
        deck.elements += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}\n", n + e, 2, e, e + 1, e + n + 2, e + n + 1);
      std::string of_second = without_contraction;
      of_second.replace(of_second.find("         1"), 10, "         2");
      deck.part(1, 0.01, without_contraction), deck.part(2, 0.01, of_second);
      give_nloc(deck, 1, 1), give_nloc(deck, -1, 2);
    } else {
      deck.part(1, 0.02, without_contraction);
    }
    deck.velocity([](const Vec& x) {
      const Real a = x[0];
      return Vec(0, 0, 0.01 * (6 * a * a - 4 * a * a * a + a * a * a * a) / 3);
    });
    auto s = simulation_of(deck.text(10));
    start_ledger(*s);
    const Real out = swing(*s, n, 8);
    EXPECT_LT(energy_error(*s), 0.03);
    return out;
  };
  const Real one = frequency(false), two = frequency(true);
  EXPECT_NEAR(one / (2 * 8.35517), 1, 0.01);  // of Euler's beam
  EXPECT_NEAR(two / one, 1, 2e-3);
}

TEST(OffsetShells, SmallFreePatchesAreStableAtTssfac09) {
  for (const Real nloc : {1.0, -3.0}) expect_stable_patches([&](ShellDeck& deck) { give_nloc(deck, nloc); });
}

TEST(OffsetShells, AWarpedShellSpinsWithoutStrain) {
  expect_spin_without_strain([](ShellDeck& deck) {
    give_nloc(deck, 1);
    deck.cards += "*CONTROL_SHELL\n20.0,0,-1,0,2,1\n";
  });
}

TEST(OffsetShells, SameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  ShellDeck deck = strip(1, 0.4, 12);
  deck.part(1, 0.02, "*MAT_PLASTIC_KINEMATIC\n1,7850.0,2.1E11,0.3,2.0E8,1.0E9\n", 3);
  give_nloc(deck, 1);
  deck.cards += "*CONTROL_SHELL\n20.0,0,-1,1\n";
  deck.velocity([](const Vec& x) { return Vec(0, 0, 100 * x[0]); });
  expect_same_bits(with_offsets(deck.text(1), -0.004), 60, 27);
}

}  // namespace courant::test::offset_shells
