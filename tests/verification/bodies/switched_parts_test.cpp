// *DEFORMABLE_TO_RIGID_AUTOMATIC: parts that are rigid for a while.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;
using test::SolidDeck;
using test::start_ledger;

namespace {

const std::string solid_part = "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000.0,1.0E6,0.3\n";
const std::string all_as_set = "*SET_NODE_LIST_GENERATE\n1\n1,100000\n";

/// A switch of part 1: `first` is CODE, TIME1, ...
std::string switch_of(int number, const std::string& first, bool to_rigid) {
  return fmt::format("*DEFORMABLE_TO_RIGID_AUTOMATIC\n{},{}\n0,0,0,0.0,{},{}\n{}\n", number, first,
                     int(to_rigid), int(!to_rigid), to_rigid ? "1,0,PART" : "1,PART");
}

struct Momenta {
  Vec p = Vec::Zero(), L = Vec::Zero();  ///< about the origin
  Real kinetic = 0;
};
Momenta motion_of(const World& world) {
  Momenta out;
  const auto* omega = shared_fields::angular_velocity.find(world.nodes.fields);
  const auto* inertia = shared_fields::rotary_inertia.find(world.nodes.fields);
  for (Index n = 0; n < world.nodes.size(); ++n) {
    const Real m = world.nodes.m[n];
    const Vec v = world.nodes.v.vec(n);
    out.p += m * v, out.L += m * world.nodes.x.vec(n).cross(v), out.kinetic += 0.5 * m * v.squaredNorm();
    if (!omega) continue;
    out.L += (*inertia)[n] * omega->vec(n);
    out.kinetic += 0.5 * (*inertia)[n] * omega->vec(n).squaredNorm();
  }
  return out;
}

/// By how much the distances of nodes differ from those in `before`, at most.
Real change_of_shape(const World& world, const std::vector<Vec>& before) {
  Real most = 0;
  for (std::size_t n = 1; n < before.size(); ++n)
    most = std::max(most, std::abs((world.nodes.x.vec(static_cast<Index>(n)) - world.nodes.x.vec(0)).norm() -
                                   (before[n] - before[0]).norm()));
  return most;
}
std::vector<Vec> places_of_nodes(const World& world) {
  std::vector<Vec> out;
  for (Index n = 0; n < world.nodes.size(); ++n) out.push_back(world.nodes.x.vec(n));
  return out;
}

/// Velocities that turn a body and make it swing.
void shake(World& world) {
  for (Index n = 0; n < world.nodes.size(); ++n) {
    const Vec x = world.nodes.x.vec(n);
    world.nodes.v.set(n, Vec(1, 2, -1) + Vec(0.3, -2, 1).cross(x) +
                             0.2 * Vec(std::sin(9 * x[0]), std::cos(7 * x[1]), x[2] * x[0]));
  }
}

std::string plate_or_block(bool plate, const std::string& cards) {
  if (plate) {
    ShellDeck deck;
    deck.plate(1, 0.6, 4, 3, 1);
    deck.cards =
        "*PART\nplate\n1,1,1\n*SECTION_SHELL\n1,2\n0.05,0.05,0.05,0.05\n*MAT_ELASTIC\n1,1000.0,1.0E6,0.3\n" +
        cards;
    return deck.text(1);
  }
  SolidDeck deck;
  deck.block(Vec(0.5, 0.3, 0.2), 3, 2, 2, 1);
  deck.cards = solid_part + cards;
  return deck.text(1);
}

}  // namespace

// Momentum and angular momentum go through both switches; the energy of what nodes moved against each other
// is lost in the first, nothing in the second, up to terms of the step squared; in between nothing changes
// its shape.
TEST(SwitchedParts, KeepMomentaAndBookTheLoss) {
  for (const bool plate : {false, true}) {
    std::vector<Real> errors;
    for (const Real tssfac : {0.9, 0.3}) {
      auto s = simulation_of(plate_or_block(plate, fmt::format("*CONTROL_TIMESTEP\n0.0,{}\n", tssfac) +
                                                       switch_of(7, "0,0.01", true) +
                                                       switch_of(8, "0,0.05", false)));
      World& world = s->world();
      std::string who;
      s->evaluate(who);
      shake(world);
      start_ledger(*s);
      const auto switches = [&] { return world.counters["rigid_switches"]; };
      const Momenta first = motion_of(world);
      Real shape = 0, error = 0;
      std::vector<Vec> rigid;
      while (s->clock().t < 0.08) {
        s->step([&](World& w, const Clock& clock, const std::string&) {
          // chords of the turn in a step: less than omega by a sixth of the square of its angle
          EXPECT_NEAR((motion_of(w).L - first.L).norm() / first.L.norm(), 0, 5e-5) << plate;
          if (switches() == 1 && rigid.empty()) rigid = places_of_nodes(w);
          if (switches() == 1) shape = std::max(shape, change_of_shape(w, rigid));
          error = std::max(error, test::energy_error(w, clock));
        });
        EXPECT_NEAR((motion_of(world).p - first.p).norm() / first.p.norm(), 0, 1e-12) << plate;
      }
      EXPECT_EQ(switches(), 2);
      EXPECT_GT(world.energy.dissipated, 3e-3 * first.kinetic) << plate;
      EXPECT_LT(shape, 1e-13) << plate;
      EXPECT_GT(change_of_shape(world, rigid), 1e-5) << plate;
      errors.push_back(error);
    }
    EXPECT_LT(errors[1], errors[0] / 5) << plate;
    EXPECT_LT(errors[1], 5e-4) << plate;
  }
}

// A block that tumbles freely goes where one of *MAT_RIGID with the same masses at its nodes goes.
TEST(SwitchedParts, TumbleAsARigidBody) {
  const auto places = [](const std::string& cards) {
    SolidDeck deck;
    deck.block(Vec(0.5, 0.3, 0.2), 3, 2, 2, 1);
    deck.cards = cards + "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,9\n*DEFINE_CURVE\n9\n0.0,0.001\n9.0,0.001\n" +
                 all_as_set + "*INITIAL_VELOCITY_GENERATION\n1,2,3.0,1.0,0.0,0.0\n0.0,0.0,0.0,0.3,0.2,1.0\n" +
                 "*SET_PART_LIST\n1\n1\n";
    auto s = simulation_of(deck.text(9));
    for (int k = 0; k < 1000; ++k) s->step(do_nothing);
    return places_of_nodes(s->world());
  };
  const auto body = places(
      "*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_RIGID\n1,1000.0,1.0E6,0.3\n*COURANT_RIGID_"
      "INERTIA\n1\n");
  const auto part = places(solid_part + "*DEFORMABLE_TO_RIGID\n1\n" + switch_of(1, "0,5.0", false));
  Real most = 0;
  for (std::size_t n = 0; n < body.size(); ++n) most = std::max(most, (body[n] - part[n]).norm());
  EXPECT_LT(most, 1e-10);
}

// A block that is rigid in flight and deforms when it hits a wall, or another block, does as one that is
// never rigid: released in time, by the wall's force, by the contact's.
TEST(SwitchedParts, HitAsIfTheyHadNeverBeenRigid) {
  enum class By { nothing, time, force };
  const auto speed = [](bool wall, By by) {
    SolidDeck deck;
    deck.block(Vec(0.5, 0.2, 0.2), 5, 2, 2, 1, [](const Vec& x) { return Vec(x + Vec(0.1, 0.03, 0.02)); });
    const std::size_t first = deck.nodes.size();
    // one step for all: bulk viscosity respects the sign of round-off
    deck.cards = solid_part +
                 "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,9\n*DEFINE_CURVE\n9\n0.0,0.001\n9.0,0.001\n" +
                 fmt::format("*SET_NODE_LIST_GENERATE\n1\n1,{}\n*INITIAL_VELOCITY\n1\n-2.0,0.0,0.0\n", first);
    if (wall) {
      deck.cards += "*RIGIDWALL_PLANAR_ID\n5,wall\n0\n0.0,0.0,0.0,1.0,0.0,0.0\n";
    } else {
      deck.block(Vec(0.3, 0.3, 0.3), 3, 3, 3, 2, [](const Vec& x) { return Vec(x - Vec(0.3, 0, 0)); });
      deck.cards +=
          "*PART\nother\n2,1,1\n*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n5,pair\n1,2,3,3\n0.0\n1.0\n";
    }
    if (by != By::nothing)
      deck.cards += "*DEFORMABLE_TO_RIGID\n1\n" + switch_of(1,
                                                            by == By::time ? "0,0.045"
                                                            : wall         ? "3,0.0,9.0,0.0,5"
                                                                           : "4,0.0,9.0,0.0,5",
                                                            false);
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    std::array<Real, 3> out{};
    while (s->clock().t < 0.12) s->step(do_nothing);
    for (Index n = 0; n < static_cast<Index>(first); ++n)
      out[0] += s->world().nodes.m[n] * s->world().nodes.v.vec(n)[0];
    for (const auto& group : s->world().groups) {
      const auto* e = dynamic_cast<const Field<Real>*>(group->fields.find("internal_energy"));
      if (e) out[1] += sum(group->size(), [&](Index k) { return (*e)[k]; });
    }
    out[2] = static_cast<Real>(s->world().counters["rigid_switches"]);
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
    return out;
  };
  for (const bool wall : {true, false}) {
    const auto never = speed(wall, By::nothing), timed = speed(wall, By::time),
               forced = speed(wall, By::force);
    EXPECT_GT(never[0], 0) << wall;
    EXPECT_EQ(timed[2], 1) << wall;
    EXPECT_EQ(forced[2], 1) << wall;
    for (const auto& one : {timed, forced}) {
      EXPECT_NEAR(one[0] / never[0], 1, 1e-8) << wall;
      EXPECT_NEAR(one[1] / never[1], 1, 1e-8) << wall;
    }
  }
}

// A pair: rigid when the contact does not push, deformable when it does, again and again.
TEST(SwitchedParts, GoToAndFroInPairs) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 1, [](const Vec& x) { return Vec(x + Vec(0.05, 0.05, 0.02)); });
  const std::size_t first = deck.nodes.size();
  deck.block(Vec(0.3, 0.3, 0.1), 3, 3, 1, 2, [](const Vec& x) { return Vec(x - Vec(0, 0, 0.1)); });
  deck.cards = solid_part +
               "*PART\nfloor\n2,2,2\n*SECTION_SOLID\n2,1\n*MAT_RIGID\n2,1000.0,1.0E6,0.3\n1.0,7,7\n" +
               fmt::format("*SET_NODE_LIST_GENERATE\n1\n1,{}\n*INITIAL_VELOCITY\n1\n0.0,0.0,-1.0\n", first) +
               "*LOAD_BODY_Z\n9,9.0\n*DEFINE_CURVE\n9\n0.0,1.0\n9.0,1.0\n"
               "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID\n5,floor\n1,2,3,3\n0.0\n1.0\n" +
               switch_of(20, "2,0.0,9.0,0.0,5,10,1", true) + switch_of(10, "4,0.0,9.0,0.0,5,20,-1", false);
  auto s = simulation_of(deck.text(1));
  start_ledger(*s);
  std::vector<Vec> before;  // of the block
  Real in_flight = 0;
  s->step(do_nothing);
  std::int64_t acted = s->world().counters["rigid_switches"];
  EXPECT_EQ(acted, 1) << "nothing touches at the start";
  before = places_of_nodes(s->world()), before.resize(first);
  bool rigid = true;
  while (s->clock().t < 0.5) {
    s->step(do_nothing);
    const auto now = s->world().counters["rigid_switches"];
    rigid = now % 2 == 1;  // the first one makes it rigid
    if (rigid && now == acted) in_flight = std::max(in_flight, change_of_shape(s->world(), before));
    if (now != acted || !rigid) before = places_of_nodes(s->world()), before.resize(first);
    acted = now;
  }
  EXPECT_GE(acted, 5);
  EXPECT_LT(in_flight, 1e-12);
  EXPECT_LT(test::energy_error_of_a_step(*s), 0.02);
}

TEST(SwitchedParts, SameBitsWithThreadsAndRestart) {
  for (const int saved_at : {20, 60}) {
    SolidDeck deck;
    deck.block(Vec(0.5, 0.3, 0.2), 5, 4, 4, 1);
    deck.cards = solid_part + all_as_set +
                 "*INITIAL_VELOCITY_GENERATION\n1,2,3.0,1.0,0.0,0.0\n0.0,0.0,0.0,0.3,0.2,1.0\n" +
                 switch_of(1, "0,0.03", true) + switch_of(2, "0,0.08", false);
    test::expect_same_bits(deck.text(1), 100, saved_at);
  }
}

// *RIGID_DEFORMABLE: the same bits as the switch that acts by itself at the time of the restart; what comes
// behind goes on from a file of the second run as ever.
TEST(SwitchedParts, SwitchWhenARunIsTakenUpAgain) {
  SolidDeck block;
  block.block(Vec(0.5, 0.3, 0.2), 5, 4, 4, 1);
  const auto deck = [&](const std::string& cards) {
    block.cards = solid_part + all_as_set +
                  "*INITIAL_VELOCITY_GENERATION\n1,2,3.0,1.0,0.0,0.0\n0.0,0.0,0.0,0.3,0.2,1.0\n" + cards;
    return block.text(1);
  };
  const auto taken_up = [](Simulation& before, const std::string& text) {
    SavedState state;
    Archive save = Archive::saver(state);
    before.keep(save);
    auto after = simulation_of(text);
    Archive load = Archive::loader(state);
    after->keep(load);
    after->world().goes_on = true;
    return after;
  };
  const auto step = [](Simulation& s, int steps) {
    for (int k = 0; k < steps; ++k) s.step(do_nothing);
  };
  const std::string stiffen = "*RIGID_DEFORMABLE_D2R\n1\n*RIGID_DEFORMABLE_CONTROL\n0,0,0,1.0E-3\n";
  auto first = simulation_of(deck(stiffen));
  step(*first, 60);
  EXPECT_EQ(first->world().counters["rigid_switches"], 0) << "not before a restart";
  auto plain = simulation_of(deck(""));
  step(*plain, 60);
  EXPECT_EQ(test::state_of(first->world()), test::state_of(plain->world()));
  auto by_itself = taken_up(*plain, deck("*DEFORMABLE_TO_RIGID_AUTOMATIC\n7\n0,0,0,1.0E-3,1\n1,0,PART\n"));
  auto second = taken_up(*plain, deck(stiffen));
  const auto start = places_of_nodes(second->world());
  step(*by_itself, 40), step(*second, 40);
  EXPECT_EQ(second->world().counters["rigid_switches"], 1);
  EXPECT_LE(second->clock().dt, 1e-3);
  EXPECT_LT(change_of_shape(second->world(), start), 1e-13);
  EXPECT_EQ(test::state_of(second->world()), test::state_of(by_itself->world()));
  auto third = taken_up(*second, deck(stiffen));
  step(*second, 20), step(*third, 20);
  EXPECT_EQ(third->world().counters["rigid_switches"], 1) << "once";
  EXPECT_EQ(test::state_of(third->world()), test::state_of(second->world()));

  // later still it is freed again
  const auto shape_then = places_of_nodes(third->world());
  auto fourth = taken_up(*third, deck(stiffen + "*RIGID_DEFORMABLE_R2D\n1\n"));
  step(*fourth, 40);
  EXPECT_EQ(fourth->world().counters["rigid_switches"], 2);
  EXPECT_GT(change_of_shape(fourth->world(), shape_then), 1e-5);

  const std::string rigid = switch_of(1, "0,0.01", true);
  auto stiff = simulation_of(deck(rigid));
  step(*stiff, 60);
  auto freed = taken_up(*stiff, deck(rigid + "*RIGID_DEFORMABLE_R2D\n1\n"));
  auto timed = taken_up(*stiff, deck(rigid + switch_of(2, fmt::format("0,{}", stiff->clock().t), false)));
  const auto shape = places_of_nodes(freed->world());
  step(*freed, 40), step(*timed, 40);
  EXPECT_GT(change_of_shape(freed->world(), shape), 1e-5);
  EXPECT_EQ(test::state_of(freed->world()), test::state_of(timed->world()));
}
