// Cards that decks carry out of habit: supports for a time, planes of symmetry, interior contact, nodes tied
// until they fail, contacts without thickness and of forming, laminated shells.
#include <gtest/gtest.h>

#include "app/run/simulation.hpp"
#include "model/build_model.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

#include "elements/shell/shells.hpp"

using namespace courant;
using test::do_nothing;
using test::energy_error;
using test::energy_error_of_a_step;
using test::ShellDeck;
using test::simulation_of;
using test::SolidDeck;
using test::started;

namespace habitual_cards_test {
namespace {

const std::string elastic = "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E7,0.0\n";
const std::string gravity = "*LOAD_BODY_Z\n9,10.0\n*DEFINE_CURVE\n9\n0.0,1.0\n9.0,1.0\n";

void run_to(Simulation& s, Real t) {
  while (s.clock().t < t) s.step(do_nothing);
}

Vec momentum_of(const World& world) {
  Vec out = Vec::Zero();
  for (Index n = 0; n < world.nodes.size(); ++n) out += world.nodes.m[n] * world.nodes.v.vec(n);
  return out;
}
Vec angular_momentum_of(const World& world) {
  Vec out = Vec::Zero();
  for (Index n = 0; n < world.nodes.size(); ++n)
    out += world.nodes.m[n] * world.nodes.x.vec(n).cross(world.nodes.v.vec(n));
  return out;
}
Real mass_of(const World& world) {
  Real out = 0;
  for (Index n = 0; n < world.nodes.size(); ++n) out += world.nodes.m[n];
  return out;
}

SolidDeck cube(const std::string& cards) {
  SolidDeck deck;
  deck.block(Vec(0.1, 0.1, 0.1), 1, 1, 1, 1);
  deck.cards = elastic + cards;
  deck.node_set(1, [](const Vec&) { return true; });
  return deck;
}

}  // namespace

// All nodes are held until 0.02: then the cube falls, v = -g (t - 0.02), to a step.
TEST(HabitualCards, ASupportLetsGoAtItsDeath) {
  auto s = simulation_of(cube(gravity + "*BOUNDARY_SPC_SET_BIRTH_DEATH\n1,0,1,1,1\n0.0,0.02\n").text(1));
  while (s->clock().t < 0.02) {
    EXPECT_EQ(momentum_of(s->world()).norm(), 0) << s->clock().t;
    s->step(do_nothing);
  }
  run_to(*s, 0.05);
  const Real half = s->clock().t - 0.5 * s->clock().dt_old,
             v = momentum_of(s->world())[2] / mass_of(s->world());
  EXPECT_NEAR(v, -10 * (half - 0.02), 10 * s->clock().dt_old);
  EXPECT_LT(v, -0.25);
}

// The cube falls until 0.02, and is stopped there: what it had of kinetic energy is booked.
TEST(HabitualCards, ASupportHoldsFromItsBirth) {
  auto s = started(cube(gravity + "*BOUNDARY_SPC_SET_BIRTH_DEATH_ID\n7,late\n1,0,1,1,1\n0.02\n").text(1));
  run_to(*s, 0.019);
  EXPECT_LT(momentum_of(s->world())[2], -0.15 * mass_of(s->world()));
  run_to(*s, 0.03);
  EXPECT_EQ(momentum_of(s->world()).norm(), 0);
  const Real booked = s->world().energy.dissipated / (0.5 * mass_of(s->world()) * 0.2 * 0.2);
  EXPECT_GE(booked, 1);  // it stops at the first step from 0.02 on
  EXPECT_LE(booked, std::pow(1 + s->clock().dt_old / 0.02, 2));
  EXPECT_LT(energy_error_of_a_step(*s), 0.02);
}

TEST(HabitualCards, SupportsForATimeHaveTheSameBits) {
  test::expect_same_bits(cube(gravity + "*BOUNDARY_SPC_SET_BIRTH_DEATH\n1,0,1,0,1\n0.001,0.003\n").text(0.01),
                         40, 12);
}

// A plane and a card of nodes on it say the same.
TEST(HabitualCards, PlanesHoldWhatSupportsHold) {
  const auto bits = [](const std::string& card) {
    SolidDeck deck;
    deck.block(Vec(0.2, 0.1, 0.1), 2, 1, 1, 1);
    deck.cards = elastic + gravity + card;
    deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
    deck.node_set(2, [](const Vec& x) { return x[2] < 1e-9; });
    auto s = simulation_of(deck.text(1));
    run_to(*s, 0.005);
    return test::state_of(s->world());
  };
  const auto set = bits("*BOUNDARY_SPC_SET\n1,0,1,0,0,0,1,1\n2,0,0,0,1,1,1,0\n");
  EXPECT_EQ(
      set,
      bits("*BOUNDARY_SPC_SYMMETRY_PLANE\n1,0,0.0,0.05,0.05,1.0,0.0,0.0\n\n2,1,0.0,0.0,0.0,0.0,0.0,-2.0\n"
           "0.001\n"));
  EXPECT_EQ(set, bits("*CONSTRAINED_GLOBAL\n1,5,1,0.0,0.0,0.0\n3,4,3,0.0,0.0,0.0,1.0E-4\n"));
}

namespace {

/// A cube of foam that yields at next to no stress, whose opposite faces come together.
SolidDeck pressed(const std::string& interior, const std::function<Vec(const Vec&)>& velocity) {
  SolidDeck deck;
  deck.block(Vec(0.1, 0.1, 0.1), 1, 1, 1, 1);
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nfoam\n1,1,1\n*MAT_CRUSHABLE_FOAM\n1,100.0,1.0E6,0.0,6,1.0E4\n"
      "*DEFINE_CURVE\n6\n0.0,1.0E4\n1.0,1.0E4\n"
      "*CONTROL_BULK_VISCOSITY\n1.0E-20,1.0E-20\n*CONTROL_HOURGLASS\n1,1.0E-20\n"
      "*CONTROL_TIMESTEP\n0.0,0.2\n" +
      interior + "*INITIAL_VELOCITY_NODE\n";
  for (std::size_t n = 0; n < deck.nodes.size(); ++n) {
    const Vec v = velocity(deck.nodes[n]);
    deck.cards += fmt::format("{},{:.6f},{:.6f},{:.6f}\n", n + 1, v[0], v[1], v[2]);
  }
  return deck;
}
const std::string interior = "*CONTACT_INTERIOR\n5\n*SET_PART_LIST\n5,2.0,0.2,4.0E5\n1\n";

Real least_height(const World& world) {
  Real low = 1, high = -1;
  for (Index n = 0; n < world.nodes.size(); ++n)
    low = std::min(low, world.nodes.x.vec(n)[2]), high = std::max(high, world.nodes.x.vec(n)[2]);
  return high - low;
}

}  // namespace

// Energy M F^2 V (s/F - 1 - ln(s/F)) of the thickness s = h/H < F, to rounding, with DA1 2, DA2 0.2, DA3 4e5.
// Small steps (TSSFAC 0.2): the usual ones take four in a bounce, which loses 3.5 % of the energy.
TEST(HabitualCards, InteriorContactHoldsAThickness) {
  const auto crush = [](const Vec& x) { return Vec(0, 0, x[2] > 0.05 ? -15.0 : 15.0); };
  auto s = started(pressed(interior, crush).text(1));
  Real least = 1, compared = 0;
  for (int k = 0; k < 4000 && s->clock().t < 0.03; ++k) {
    s->step([&](World& world, const Clock&, const std::string&) {
      const Real share = least_height(world) / 0.1;
      least = std::min(least, share);
      sample_energy(world, s->clock());
      if (share < 0.19) {
        const Real M = 2 * 4e5, F = 0.2, V = 1e-3, s_F = share / F;
        EXPECT_NEAR(world.energy.contact / (M * F * F * V * (s_F - 1 - std::log(s_F))), 1, 1e-9);
        ++compared;
      }
    });
  }
  EXPECT_GT(compared, 10);
  EXPECT_LT(least, 0.15);
  EXPECT_GT(least, 0.001);
  EXPECT_LT(momentum_of(s->world()).norm(), 1e-12);
  EXPECT_LT(energy_error_of_a_step(*s), 0.01);
}

// A cube that spins while it is sheared and pressed keeps its momentum and angular momentum.
TEST(HabitualCards, InteriorContactKeepsAngularMomentum) {
  const auto tumble = [](const Vec& x) {
    const Vec r = x - Vec::Constant(0.05);
    return Vec(Vec(3, 5, -2).cross(r) + Vec(1.5 * r[2] / 0.05, 0, x[2] > 0.05 ? -16.0 : 16.0));
  };
  auto s = started(pressed(interior, tumble).text(1));
  const auto about_the_middle = [&] {  // positions at the half step, as velocities
    Vec out = Vec::Zero();
    const World& world = s->world();
    for (Index n = 0; n < world.nodes.size(); ++n)
      out +=
          world.nodes.m[n] *
          (world.nodes.x.vec(n) - 0.5 * s->clock().dt_old * world.nodes.v.vec(n)).cross(world.nodes.v.vec(n));
    return out;
  };
  s->step(do_nothing);
  const Vec before = about_the_middle();
  Real most = 0;
  while (s->clock().t < 0.02) {
    s->step(do_nothing);
    sample_energy(s->world(), s->clock());
    most = std::max(most, s->world().energy.contact);
  }
  EXPECT_GT(most, 0.02 * s->world().energy.initial);
  EXPECT_LT((about_the_middle() - before).norm(), 2e-3 * before.norm());
  EXPECT_LT(momentum_of(s->world()).norm(), 1e-12);
}

TEST(HabitualCards, InteriorContactHasTheSameBits) {
  test::expect_same_bits(
      pressed(interior, [](const Vec& x) { return Vec(0, 0, x[2] > 0.05 ? -15.0 : 15.0); }).text(0.03), 200,
      90);
}

namespace {

const std::string plastic =
    "*SECTION_SOLID\n1,1\n*PART\nbar\n1,1,1\n*MAT_PLASTIC_KINEMATIC\n"
    "1,7.8E-9,2.0E5,0.3,200.0,2000.0\n";

/// A bar of two halves, stretched at its end; `apart`: each half has nodes of its own at the joint, numbered
/// on.
SolidDeck stretched_bar(bool apart, const std::string& cards) {
  SolidDeck deck;
  if (apart) {
    deck.block(Vec(10, 2, 2), 5, 1, 1, 1);
    deck.block(Vec(10, 2, 2), 5, 1, 1, 1, [](const Vec& x) { return Vec(x + Vec(10, 0, 0)); });
  } else {
    deck.block(Vec(20, 2, 2), 10, 1, 1, 1);
  }
  deck.cards = plastic + cards +
               "*BOUNDARY_SPC_SET\n1,0,1,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,0,8,1.0\n"
               "*DEFINE_CURVE\n8\n0.0,0.0\n1.0E-5,4000.0\n1.0,4000.0\n"
               "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,7\n*DEFINE_CURVE\n7\n0.0,2.0E-7\n1.0,2.0E-7\n";
  deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
  deck.node_set(2, [](const Vec& x) { return x[0] > 20 - 1e-9; });
  if (apart) deck.node_set(3, [](const Vec& x) { return std::abs(x[0] - 10) < 1e-9; });
  return deck;
}

std::vector<Real> positions_along(const World& world) {
  std::vector<std::pair<Real, Real>> at;
  for (Index n = 0; n < world.nodes.size(); ++n)
    at.emplace_back(world.nodes.v.vec(n)[0], world.nodes.x.vec(n)[0]);
  std::sort(at.begin(), at.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  at.erase(std::unique(at.begin(), at.end(),
                       [](const auto& a, const auto& b) { return std::abs(a.second - b.second) < 1e-9; }),
           at.end());
  std::vector<Real> out;
  for (const auto& [v, x] : at) out.push_back(x);
  return out;
}

}  // namespace

// Tied nodes move as those of one mesh, until the plastic strain at the joint reaches EPPF: then they part.
TEST(HabitualCards, TiedNodesArePartOfOneMeshUntilTheyFail) {
  const std::string card = "*CONSTRAINED_TIED_NODES_FAILURE\n3,0.02,1\n";
  auto tied = simulation_of(stretched_bar(true, card).text(1)),
       whole = simulation_of(stretched_bar(false, "").text(1));
  const auto gap = [](const World& world) {
    return world.nodes.x.vec(24)[0] - world.nodes.x.vec(5)[0];  // nodes 25 and 6 at the joint
  };
  ASSERT_NEAR(gap(tied->world()), 0, 1e-12);
  const auto parted = [&] { return tied->world().counters.at("tied_nodes_parted"); };
  while (parted() == 0 && tied->clock().t < 4e-4) {
    tied->step(do_nothing), whole->step(do_nothing);
    EXPECT_LT(std::abs(gap(tied->world())), 1e-10);
  }
  const std::vector<Real> a = positions_along(tied->world()), b = positions_along(whole->world());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-8) << k;
  EXPECT_GT(parted(), 0);
  EXPECT_NEAR((whole->world().nodes.x.vec(10)[0] - 20) / 20, 0.021, 0.008);  // strain of the bar then
  for (int k = 0; k < 300; ++k) tied->step(do_nothing);
  EXPECT_EQ(parted(), 8);
  EXPECT_GT(gap(tied->world()), 0.01);
}

TEST(HabitualCards, TiedNodesHaveTheSameBits) {
  test::expect_same_bits(stretched_bar(true, "*CONSTRAINED_TIED_NODES_FAILURE\n3,0.002,1\n").text(2e-4), 400,
                         250);
}

namespace {

const std::string steel_plate = "*MAT_RIGID\n2,7800.0,2.0E11,0.3\n1,7,7\n";

/// A cube that comes down on a rigid plate of thickness 0.02 from `height` above the plane of its nodes.
SolidDeck dropped(const std::string& contact, Real height, const std::string& cards = "") {
  SolidDeck deck;
  deck.block(Vec(0.1, 0.1, 0.1), 1, 1, 1, 1, [&](const Vec& x) { return Vec(x + Vec(0, 0, height)); });
  deck.cards =
      "*SECTION_SOLID\n1,2\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n"
      "*PART\nplate\n2,2,2\n*SECTION_SHELL\n2,2\n0.02\n" +
      steel_plate + cards + contact + "*INITIAL_VELOCITY_GENERATION\n1,2,0.0,0.0,0.0,-1.0\n\n";
  deck.particles =
      "*NODE\n101,-0.2,-0.2,0.0\n102,0.3,-0.2,0.0\n103,0.3,0.3,0.0\n104,-0.2,0.3,0.0\n"
      "*ELEMENT_SHELL\n101,2,101,102,103,104\n";
  return deck;
}
const std::string sides = "1,2,3,3\n0.0\n1.0\n";

std::vector<Real> speeds(const SolidDeck& deck) {
  auto s = simulation_of(deck.text(1));
  std::vector<Real> out;
  if (!s) return out;
  while (s->clock().t < 0.03) {
    s->step(do_nothing);
    out.push_back(momentum_of(s->world())[2]);
  }
  return out;
}
void expect_alike(const std::vector<Real>& a, const std::vector<Real>& b) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  EXPECT_GT(*std::max_element(a.begin(), a.end()), 0.5);  // it came back
  for (std::size_t k = 0; k < a.size(); ++k) ASSERT_NEAR(a[k], b[k], 1e-7) << k;
}

}  // namespace

// Without a thickness the block meets the plane of the nodes; with one, half of that above it.
TEST(HabitualCards, SurfacesWithoutThicknessMeetWhereTheirNodesAre) {
  const auto thick = speeds(dropped("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + sides, 0.013));
  expect_alike(speeds(dropped("*CONTACT_SURFACE_TO_SURFACE\n" + sides, 0.003)), thick);
  expect_alike(
      speeds(dropped("*CONTACT_SURFACE_TO_SURFACE\n" + sides, 0.013, "*CONTROL_CONTACT\n0.1,1.0,0,2\n")),
      thick);
}

// Tools of forming have no thickness unless SBST says so.
TEST(HabitualCards, FormingToolsHaveNoThickness) {
  const auto thick = speeds(dropped("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + sides, 0.013));
  expect_alike(speeds(dropped("*CONTACT_FORMING_SURFACE_TO_SURFACE\n" + sides, 0.003)), thick);
  expect_alike(
      speeds(dropped("*CONTACT_FORMING_SURFACE_TO_SURFACE\n1,2,3,3\n0.0\n1.0,1.0,0.0,0.02\n", 0.013)), thick);
}

// Single surfaces have the thickness of shells whatever SHLTHK says.
TEST(HabitualCards, SingleSurfacesHaveThickness) {
  expect_alike(speeds(dropped("*CONTACT_SINGLE_SURFACE\n0,0,5\n0.0\n1.0\n", 0.013)),
               speeds(dropped("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0,0,5\n0.0\n1.0\n", 0.013)));
}

namespace {

/// Shear factor of a laminate of plies of elastic materials: thickness and number of each.
Real shear_factor(const std::vector<std::pair<Real, int>>& plies, int lamsht) {
  std::string text =
      fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*CONTROL_SHELL\n20.0\n1.0,0,{}\n", lamsht);
  text += "*MAT_ELASTIC\n1,1000.0,1.0E10,0.0\n*MAT_ELASTIC\n2,100.0,1.0E6,0.0\n*PART_COMPOSITE\nplate\n1,2\n";
  for (std::size_t k = 0; k < plies.size(); ++k)
    text += fmt::format("{},{:g},0.0,0{}", plies[k].second, plies[k].first, k % 2 == 1 ? "\n" : ",");
  if (plies.size() % 2 == 1) text += "\n";
  text += "*NODE\n1,0.,0.,0.\n2,1.,0.,0.\n3,1.,1.,0.\n4,0.,1.,0.\n*ELEMENT_SHELL\n1,1,1,2,3,4\n*END\n";
  Diagnostics diagnostics;
  ReadOptions options;
  options.open = [text](const std::string&) { return text; };
  const Deck deck = read_deck("test.k", options, diagnostics);
  const Model model = build_model(deck, diagnostics);
  const auto parts = find_shell_parts(deck, model, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  return parts.empty() ? 0 : parts[0].control.shear_factor;
}

}  // namespace

// One material in three plies: 5/6. Stiff faces t on a soft core c: K = G (c + t)^2/c, to t/c.
TEST(HabitualCards, LaminatesShearAsEquilibriumAsks) {
  EXPECT_NEAR(shear_factor({{1e-3, 1}, {3e-3, 1}, {2e-3, 1}}, 1), 5.0 / 6, 1e-6);
  const Real t = 1e-4, c = 0.02, G1 = 5e9, G2 = 5e5;
  const Real K = G2 * (c + t) * (c + t) / c;
  EXPECT_NEAR(shear_factor({{t, 1}, {c, 2}, {t, 1}}, 1) / (K / (2 * t * G1 + c * G2)), 1, 0.01);
  EXPECT_NEAR(shear_factor({{t, 1}, {c, 2}, {t, 1}}, 0), 1, 1e-12);
}

}  // namespace habitual_cards_test
