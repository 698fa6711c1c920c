// Forces between particles in one of several steps of a structure: theory in docs/theory_sph.md.
#include <cstdio>
#include <numeric>

#include "same_bits.hpp"
#include "scenes.hpp"
#include "shell_decks.hpp"
#include "state/subcycle.hpp"

using namespace courant;

namespace subcycle_test {
namespace {

/// A square of water falls on a free strip of shells in the plane, whose step is several times shorter than
/// that of the water. `E`: of the strip.
std::string struck_strip(const std::string& E) {
  test::ShellDeck deck;
  const Real dx = 0.0025;
  deck.plate(0.08, 1, 32, 1, 2, [](const Vec& x) { return Vec(x[0], 0, x[1] - 0.5); });
  deck.part(2, 0.002, "*MAT_ELASTIC\n         2    1100.0" + E + "       0.4\n");
  const std::size_t first = deck.nodes.size() + 1;
  deck.particles = "*ELEMENT_SPH\n";
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i) {
      deck.nodes.push_back(Vec(0.02 + dx * (i + 0.5), 0.001 + dx * (j + 0.5), 0));
      deck.particles += fmt::format("{:8}{:8}{:16.9e}\n", deck.nodes.size(), 1, 1000 * dx * dx);
    }
  EXPECT_EQ(deck.nodes.size(), first + 143);
  deck.cards += fmt::format(
      "*PART\nwater\n1,1,1,1,1\n*CONTROL_SPH\n1,0,1.E20,2\n*MAT_NULL\n1,1000.,-1.E20\n"
      "*EOS_LINEAR_POLYNOMIAL\n1,0.,4.E5\n0.,1.\n*SECTION_SPH\n1,1.2,1.,1.\n*HOURGLASS\n1,0,0,0,1.E-20,0.1\n"
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.\n10.,1000.,{}\n"
      "*INITIAL_VELOCITY_GENERATION\n1,2,0.,0.3,-2.,0.\n\n",
      dx);
  return deck.text(1);
}

Vec momentum(const World& w) {
  Vec out = Vec::Zero();
  for (Index i = 0; i < w.particles.size(); ++i) out += w.particles.m[i] * w.particles.v.vec(i);
  for (Index n = 0; n < w.nodes.size(); ++n) out += w.nodes.m[n] * w.nodes.v.vec(n);
  return out;
}

std::string with(std::string deck, const std::string& cards) {
  return deck.insert(deck.rfind("*END"), cards);
}
const char* const off = "*COURANT_SUBCYCLE\n1\n";
const char* const most = "*COURANT_SUBCYCLE\n0\n";
const char* const stiff = "     2.0e8";

/// Steps over those that had pair forces.
Real mean_steps(Simulation& s) {
  return Real(s.clock().cycle) / Real(s.world().counters.at("pair_force_steps"));
}

}  // namespace

TEST(Subcycle, NoMomentumIsLostAndTheEnergyHolds) {
  Real errors[2];
  for (const bool on : {false, true}) {
    auto s = test::simulation_of(with(struck_strip(stiff), on ? most : off));
    test::start_ledger(*s);
    const Vec before = momentum(s->world());
    Real& error = errors[on];
    error = 0;
    while (s->clock().t < 0.006)
      s->step([&](World& world, const Clock& clock, const std::string&) {
        if (clock.cycle % 7 == 0) error = std::max(error, test::energy_error(world, clock));
      });
    const Real lost = (momentum(s->world()) - before).norm() / before.norm();
    std::printf("%s: momentum lost %.1e, energy %.1e\n", on ? "on" : "off", lost, error);
    EXPECT_LT(lost, 1e-12);
    if (on) EXPECT_GT(mean_steps(*s), 4);
  }
  // Of first order in the interval, here of 16 steps: 0.012, against 1e-4 with forces in each step. This is
  // why the card must ask for it.
  EXPECT_LT(errors[0], 1e-3);
  EXPECT_LT(errors[1], 0.02);
}

// In the middle of an interval, too.
TEST(Subcycle, GivesTheSameBitsOnAnyThreadsAndAfterARestart) {
  const std::string deck = with(struck_strip(stiff), most);
  auto s = test::simulation_of(deck);
  const test::WholeState reference = test::state_after(*s, 400);
  EXPECT_GT(mean_steps(*s), 4);
  for (const int at : {201, 202, 203, 204, 205, 206, 207}) {
    auto first = test::simulation_of(deck);
    while (first->clock().cycle < at) first->step(test::do_nothing);
    EXPECT_EQ(test::listed(test::differences(
                  reference, test::state_after_restart(deck, test::saved_state(*first), 400))),
              "")
        << at;
  }
  test::expect_same_bits(deck, 400, 203);
}

// Where the water's own step is shorter than two of the strip.
TEST(Subcycle, HasTheBitsOfEachStepWhereItDoesNotPay) {
  const std::string deck = struck_strip("     5.0e5");
  auto plain = test::simulation_of(deck), s = test::simulation_of(with(deck, most));
  EXPECT_EQ(Subcycle::of(plain->world()), nullptr);
  ASSERT_NE(Subcycle::of(s->world()), nullptr);
  for (int k = 0; k < 300; ++k) plain->step(test::do_nothing), s->step(test::do_nothing);
  EXPECT_EQ(mean_steps(*s), 1);
  const World &a = plain->world(), &b = s->world();
  for (Index n = 0; n < a.nodes.size(); ++n) ASSERT_EQ(a.nodes.x.vec(n), b.nodes.x.vec(n)) << n;
  for (Index i = 0; i < a.particles.size(); ++i) {
    ASSERT_EQ(a.particles.x.vec(i), b.particles.x.vec(i)) << i;
    ASSERT_EQ(a.particles.p[i], b.particles.p[i]) << i;
  }
}

TEST(Subcycle, IsLeftOutWhereSomethingNeedsEachStep) {
  for (const std::string& cards :
       {std::string(), std::string(off), most + std::string("*COURANT_VOLUME_CONTROL\n0.01\n"),
        most + std::string("*COURANT_XSPH\n0.5\n")}) {
    auto s = test::simulation_of(with(struck_strip(stiff), cards));
    EXPECT_EQ(Subcycle::of(s->world()), nullptr) << cards;
  }
  auto s = test::simulation_of(with(struck_strip(stiff), "*COURANT_SUBCYCLE\n3\n"));
  for (int k = 0; k < 301; ++k) s->step(test::do_nothing);
  EXPECT_EQ(s->world().counters.at("pair_force_steps"), 101);
}

}  // namespace subcycle_test
