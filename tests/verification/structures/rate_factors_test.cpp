// Yield stresses that depend on the rate of all strain (VP 0) at the step that TSSFAC gives: bars of solids
// and of shells, pulled to a strain of 0.3, against the closed form in windows of strain.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shell_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;

namespace rate_bars {

namespace {

/// A law by its cards in mm, ms, kg, GPa, and its yield stress over plastic strain and rate. [1/ms]
struct RateLaw {
  std::string name, cards;
  Real (*stress)(Real e, Real rate);
};
Real cowper_symonds(Real rate) {
  return 1 + std::pow(rate / 0.04, 0.2);
}
const std::string steel = "1,7.85e-6,210.0,0.3,";
const RateLaw laws[] = {
    {"024", "*MAT_PIECEWISE_LINEAR_PLASTICITY\n" + steel + "0.3,1.0\n0.04,5.0\n\n\n",
     [](Real e, Real rate) { return (0.3 + 210.0 / 209 * e) * cowper_symonds(rate); }},
    {"024, VP 1", "*MAT_PIECEWISE_LINEAR_PLASTICITY\n" + steel + "0.3,1.0\n0.04,5.0,,,1\n\n\n",
     [](Real e, Real rate) { return 0.3 * cowper_symonds(rate) + 210.0 / 209 * e; }},
    {"024, VP -1", "*MAT_PIECEWISE_LINEAR_PLASTICITY\n" + steel + "0.3,1.0\n0.04,5.0,,,-1\n\n\n",
     [](Real e, Real rate) { return (0.3 + 210.0 / 209 * e) * cowper_symonds(rate); }},
    {"024, table",
     "*MAT_PIECEWISE_LINEAR_PLASTICITY\n" + steel +
         "\n,,3\n\n\n*DEFINE_CURVE\n1\n0.0,0.3\n1.0,0.4\n*DEFINE_CURVE\n2\n0.0,0.9\n1.0,1.0\n"
         "*DEFINE_TABLE_2D\n3\n-6.9077552789821,1\n2.3025850929940,2\n",
     [](Real e, Real rate) { return 0.3 + 0.1 * e + 0.6 * std::log(rate / 1e-3) / std::log(1e4); }},
    {"003", "*MAT_PLASTIC_KINEMATIC\n" + steel + "0.3,1.0,0.5\n0.04,5.0\n",
     // the back stress is 3/2 of what kinematic hardening adds in uniaxial stress
     [](Real e, Real rate) { return (0.3 + 105.0 / 209 * e) * cowper_symonds(rate) + 105.0 / 209 * e; }},
    {"018", "*MAT_POWER_LAW_PLASTICITY\n" + steel + "0.6,0.2,0.04,5.0\n0.3\n",
     [](Real e, Real rate) { return 0.6 * std::pow(0.03125 + e, 0.2) * cowper_symonds(rate); }},
    {"098", "*MAT_SIMPLIFIED_JOHNSON_COOK\n" + steel + "0\n0.3,0.3,0.3,0.05,,,,1e-5\n",
     [](Real e, Real rate) { return (0.3 + 0.3 * std::pow(e, 0.3)) * (1 + 0.05 * std::log(rate / 1e-5)); }}};

/// Ends of a bar of 5 x 1 x 1 that is pulled, with what every bar has.
template <class Deck>
std::string pulled(Deck& deck, const std::string& material, Real length, Real rate, Real tssfac) {
  deck.cards += material + fmt::format("*CONTROL_TIMESTEP\n       0.0{:10.2f}\n", tssfac);
  deck.node_set(7, [](const Vec& x) { return x[0] < 1e-9; });
  deck.node_set(8, [&](const Vec& x) { return x[0] > length - 1e-9; });
  deck.node_set(9, [](const Vec& x) { return x[1] < 1e-9; });
  deck.cards +=
      "*BOUNDARY_SPC_SET\n         7         0         1\n         9         0         0         1\n";
  deck.cards += fmt::format(
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n         8         1         0         9{:10.3e}\n*DEFINE_CURVE\n9\n"
      "0.0,1.0\n1e6,1.0\n*INITIAL_VELOCITY_NODE\n",
      rate * length);
  for (std::size_t n = 0; n < deck.nodes.size(); ++n)
    deck.cards += fmt::format("{:10}{:10.3e}\n", n + 1, rate * deck.nodes[n][0]);
  return deck.text(1e6);
}
std::string solid_bar(const std::string& material, int cells, Real rate, Real tssfac) {
  test::SolidDeck deck;
  deck.block({Real(cells), 1, 1}, cells, 1, 1, 1);
  deck.cards += "*PART\nbar\n         1         1         1\n*SECTION_SOLID\n         1         1\n";
  deck.node_set(6, [](const Vec& x) { return x[2] < 1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n         6         0         0         0         1\n";
  return pulled(deck, material, cells, rate, tssfac);
}
std::string shell_bar(const std::string& material, int cells, Real rate, Real tssfac) {
  test::ShellDeck deck;
  deck.plate(cells, 1, cells, 1, 1);
  deck.part(1, 0.2, "", 2);
  deck.cards += "*CONTROL_SHELL\n,,,1\n";  // the thickness follows
  return pulled(deck, material, cells, rate, tssfac);
}

/// The largest deviation of the mean stress of windows of strain 0.02, from 0.02 on, by the work that came
/// in.
Real largest_deviation(const std::string& text, const RateLaw& law, Real volume, Real rate, Real most) {
  auto s = test::simulation_of(text);
  if (!s) return 1;
  Real out = 0, before = 0, expected = 0, next = 0.02, last = 0;
  while (next < most) {
    const Real strain = std::log(1 + rate * s->clock().t), now = rate / (1 + rate * s->clock().t);
    Real stress = law.stress(strain, now);
    stress = law.stress(strain - stress / 210, now);
    expected += stress * (strain - last);
    last = strain;
    if (strain < next) {
      s->step(test::do_nothing);
      continue;
    }
    s->step([](World& world, const Clock& clock, const std::string&) { sample_energy(world, clock); });
    const Real internal = s->world().energy.internal / volume;
    if (before > 0) out = std::max(out, std::abs((internal - before) / expected - 1));
    before = internal, expected = 0, next += 0.02;
  }
  return out;
}

}  // namespace

TEST(RateFactors, BarsFollowTheirCurveAtAnyStep) {
  for (const RateLaw& law : laws)
    for (const Real rate : {0.01, 1.0, 10.0})
      for (const Real tssfac : {0.9, 0.3})
        for (const int cells : {1, 5}) {
          const Real most = rate < 1 ? 0.09 : 0.3;
          const auto text = fmt::format("{}, rate {}, TSSFAC {}, {} cells: ", law.name, rate, tssfac, cells);
          const Real solids =
                         largest_deviation(solid_bar(law.cards, cells, rate, tssfac), law, cells, rate, most),
                     shells = largest_deviation(shell_bar(law.cards, cells, rate, tssfac), law, 0.2 * cells,
                                                rate, most);
          EXPECT_LT(solids, 0.01) << text << "solids";
          EXPECT_LT(shells, 0.01) << text << "shells";
        }
}

}  // namespace rate_bars
