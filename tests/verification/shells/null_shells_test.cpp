// Shells and beams of *MAT_NULL: they weigh, touch and are pressed, and nothing else.
#include <gtest/gtest.h>

#include <cmath>

#include "same_bits.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;
using test::start_ledger;

namespace {

/// Solids of RO 1000 and E 1e6 along x, as part 1.
const std::string rod_part = "*PART\nrod\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000.0,1.0E6,0.0\n";

/// A part of shells with the thickness t.
std::string coat_part(int part, Real t, const std::string& material) {
  return fmt::format("*PART\ncoat\n{0},{0},{0}\n*SECTION_SHELL\n{0},2\n{1},{1},{1},{1}\n{2}", part, t,
                     material);
}

/// *MAT_NULL with a mass per area and YM.
std::string coat_of(int part, Real t, Real per_area, Real ym) {
  return coat_part(part, t, fmt::format("*MAT_NULL\n{},{},0.0,0.0,0.0,0.0,{},0.0\n", part, per_area / t, ym));
}

/// Shells on the faces x = `at` of a block of n x m x m elements whose first node is `first`; `side`: of the
/// grid, 0 or n.
std::string shells_across(int n, int m, int side, std::size_t first, int part) {
  std::string out;
  const auto id = [&](int j, int k) { return static_cast<int>(first) + side + (n + 1) * (j + (m + 1) * k); };
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      out += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}\n", 1000 * part + j + m * k, part, id(j, k), id(j + 1, k),
                         id(j + 1, k + 1), id(j, k + 1));
  return out;
}

/// A rod of length 1 held at x = 0, its other end covered.
SolidDeck covered_rod(int n, const std::string& cover) {
  SolidDeck deck;
  deck.block(Vec(1, 0.2, 0.2), n, 2, 2, 1);
  deck.cards = rod_part + cover;
  deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n1,0,1,1,1\n";
  return deck;
}

Vec end_velocity(const Simulation& s) {
  const Nodes& nodes = s.world().nodes;
  Vec sum = Vec::Zero();
  Real m = 0;
  for (Index n = 0; n < nodes.size(); ++n)
    if (nodes.x.vec(n)[0] > 0.99) sum += nodes.m[n] * nodes.v.vec(n), m += nodes.m[n];
  return sum / m;
}

/// Mass, momentum and kinetic energy of a part, by index.
PartSums sums_of(const Simulation& s, std::size_t part) {
  std::vector<PartSums> sums(s.model().parts.size());
  for (const auto* reporter : s.world().passes.all<const PartReporter>())
    reporter->report_part(s.world(), sums);
  return sums[part];
}

}  // namespace

// A rod with the mass M at its end swings along with omega L/c = b, b tan b = m/M: 0.8603 where the cover is
// as heavy as the rod. The step is that of the rod alone.
TEST(NullShells, WeighAtTheEndOfARod) {
  const Real c = std::sqrt(1000.0);
  std::vector<Real> error;
  for (const int n : {5, 10, 20}) {
    SolidDeck deck = covered_rod(n, coat_of(2, 0.01, 1000, 1e6));
    deck.particles = "*ELEMENT_SHELL\n" + shells_across(n, 2, n, 1, 2);
    auto alone = simulation_of(covered_rod(n, "").text(1));
    auto s = simulation_of(deck.text(1));
    start_ledger(*s), alone->step(do_nothing);
    World& world = s->world();
    for (Index k = 0; k < world.nodes.size(); ++k)
      world.nodes.v.set(k, Vec(0.01 * std::sin(0.860334 * world.nodes.x.vec(k)[0]), 0, 0));
    s->step(do_nothing);
    EXPECT_EQ(s->clock().dt, alone->clock().dt) << n;
    // the velocity of the first shape passes 0 after a quarter of its period
    Real before = 0, at = 0;
    while (end_velocity(*s)[0] > 0)
      before = end_velocity(*s)[0], at = s->clock().t - 0.5 * s->clock().dt, s->step(do_nothing);
    const Real now = end_velocity(*s)[0], quarter = at + s->clock().dt * before / (before - now);
    error.push_back(quarter / (0.5 * pi / (0.860334 * c)) - 1);
    EXPECT_NEAR(error.back() * n * n, 0, 0.06) << n;
    const PartSums coat = sums_of(*s, 1);
    EXPECT_NEAR(coat.mass, 40, 1e-10);
    EXPECT_NEAR(coat.momentum[0], 40 * now, 1e-9);
    EXPECT_EQ(coat.internal, 0);
    EXPECT_LT(test::energy_error_of_a_step(*s), 1e-9) << n;
  }
}

// Nodes count to what a coat covers, so that damping by parts and gravity of parts stay what they were.
TEST(NullShells, LeaveNodesToWhatTheyCover) {
  SolidDeck deck = covered_rod(2, coat_of(2, 0.01, 1, 1e6));
  deck.particles = "*ELEMENT_SHELL\n" + shells_across(2, 2, 2, 1, 2);
  auto s = simulation_of(deck.text(1));
  for (Index n = 0; n < s->world().nodes.size(); ++n) EXPECT_EQ(s->world().nodes.part[n], 0);
}

// A pressure on the coat pushes as it does on the face below, by segments and by shells.
TEST(NullShells, PassPressureOn) {
  const auto speed = [](bool covered, bool by_shells) {
    SolidDeck deck = covered_rod(4, covered ? coat_of(2, 0.01, 1e-6, 0) : "");
    const std::string faces = shells_across(4, 2, 4, 1, 2);
    if (covered) deck.particles = "*ELEMENT_SHELL\n" + faces;
    deck.cards += "*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n";
    if (by_shells) {
      deck.cards += "*LOAD_SHELL_SET\n1,1,500.0\n*SET_SHELL_LIST_GENERATE\n1\n2000,2999\n";
    } else {
      deck.cards += "*LOAD_SEGMENT_SET\n1,1,500.0\n*SET_SEGMENT\n1\n";
      for (std::size_t line = 0; line < 4; ++line)
        for (std::size_t c = 0; c < 4; ++c)
          deck.cards += "  " + faces.substr(49 * line + 16 + 8 * c, 8) + (c == 3 ? "\n" : "");
    }
    auto s = simulation_of(deck.text(1));
    while (s->clock().t < 0.05) s->step(do_nothing);
    return end_velocity(*s)[0];
  };
  const Real bare = speed(false, false);
  EXPECT_GT(std::abs(bare), 1e-3);
  EXPECT_NEAR(speed(true, false) / bare, 1, 1e-8);
  EXPECT_NEAR(speed(true, true) / bare, 1, 1e-8);
}

// Two equal bars exchange their velocities through coats on the faces that meet, as they do without them.
TEST(NullShells, TouchForWhatTheyCover) {
  const auto after = [](int n, bool covered) {
    SolidDeck deck;
    const Real a = 2.0 / n, t = covered ? 1e-4 : 0;
    deck.block(Vec(1, a, a), n, 2, 2, 1);
    const std::size_t first = deck.nodes.size();
    deck.block(Vec(1, a, a), n, 2, 2, 2, [&](const Vec& x) { return Vec(x + Vec(1 + t + 1e-7, 0, 0)); });
    deck.cards = rod_part + "*PART\nother\n2,1,1\n" +
                 fmt::format("*SET_NODE_LIST_GENERATE\n1\n1,{}\n*INITIAL_VELOCITY\n1\n1.0,0.0,0.0\n", first);
    if (covered) {
      deck.cards += coat_of(3, t, 1e-6, 1e6) + "*PART\ncoat\n4,3,3\n";
      deck.particles =
          "*ELEMENT_SHELL\n" + shells_across(n, 2, n, 1, 3) + shells_across(n, 2, 0, first + 1, 4);
    }
    deck.cards += fmt::format("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n{},{},3,3\n0.0\n1.0\n", covered ? 3 : 1,
                              covered ? 4 : 2);
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    while (s->clock().t < 2.6 / std::sqrt(1000.0)) s->step(do_nothing);
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.01) << n;
    std::array<Real, 2> p{};
    const Nodes& nodes = s->world().nodes;
    for (Index k = 0; k < nodes.size(); ++k)
      p[k < static_cast<Index>(first) ? 0 : 1] += nodes.m[k] * nodes.v.vec(k)[0] / (1000 * a * a);
    return p;
  };
  for (const auto& [n, bound] : {std::pair(20, 0.08), {40, 0.04}}) {
    const auto bare = after(n, false), covered = after(n, true);
    EXPECT_NEAR(covered[0], 0, bound) << n;
    EXPECT_NEAR(covered[1], 1, bound) << n;
    EXPECT_NEAR(covered[0], bare[0], bound) << n;
  }
}

// A null beam weighs RO A L, half at each end, as *ELEMENT_MASS does there.
TEST(NullShells, BeamsWeighAsLumpedMasses) {
  const auto speed = [](bool beam) {
    SolidDeck deck = covered_rod(4, "");
    deck.cards += "*LOAD_NODE_POINT\n15,1,1,100.0\n*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n";
    if (beam) {
      deck.cards += "*PART\nbeam\n5,5,5\n*SECTION_BEAM\n5,3\n0.03\n*MAT_NULL\n5,2000.0\n";
      deck.particles = "*ELEMENT_BEAM\n       1       5      10      15       0\n";
    } else {
      deck.particles = "*ELEMENT_MASS\n       1      10             3.0\n       2      15             3.0\n";
    }
    auto s = simulation_of(deck.text(1));
    while (s->clock().t < 0.05) s->step(do_nothing);
    if (beam) EXPECT_NEAR(sums_of(*s, 1).mass, 6, 1e-9);
    return end_velocity(*s)[0];
  };
  EXPECT_NEAR(speed(true) / speed(false), 1, 1e-9);
}

TEST(NullShells, SameBitsWithThreadsAndRestart) {
  SolidDeck deck = covered_rod(6, coat_of(2, 0.01, 100, 1e6));
  deck.particles = "*ELEMENT_SHELL\n" + shells_across(6, 2, 6, 1, 2);
  deck.cards += "*INITIAL_VELOCITY\n0\n1.0,0.0,0.0\n";
  test::expect_same_bits(deck.text(1), 40, 20);
}
