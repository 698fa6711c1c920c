// Tied contact against theory: constant stress, bars and strips of two meshes, kept momenta and energy.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rigid/bodies/rigid.hpp"
#include "same_bits.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/tied_mass.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;
using test::SolidDeck;

namespace {

constexpr Real bar_E = 1e9, bar_rho = 1000;

/// Parts 1 and 2 of one elastic material.
std::string two_parts(Real nu) {
  return fmt::format(
      "*SECTION_SOLID\n         1         1\n*PART\none\n         1         1         1\n*PART\ntwo\n        "
      " 2  "
      "       1         1\n*MAT_ELASTIC\n         1{:10.4g}{:10.4g}{:10.4g}\n*CONTROL_HOURGLASS\n         4  "
      "   "
      " 0.05\n",
      bar_rho, bar_E, nu);
}
/// Nodes of part 2 on faces of part 1.
std::string tie(const std::string& option, const std::string& third_card = "\n") {
  return "*CONTACT_TIED_" + option + "_ID\n         7glue\n         2         1         3         3\n\n" +
         third_card;
}
std::string velocities(const std::vector<Vec>& nodes, const std::function<Vec(const Vec&)>& velocity) {
  std::string out = "*INITIAL_VELOCITY_NODE\n";
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Vec v = velocity(nodes[n]);
    out += fmt::format("{},{:.16g},{:.16g},{:.16g}\n", n + 1, v[0], v[1], v[2]);
  }
  return out;
}

/// A bar of 2 x 1 x 1 along x, its halves of n cells a unit and m cells a unit.
SolidDeck bar(int n, int m, Real nu, Real gap = 0) {
  SolidDeck deck;
  deck.block(Vec(1, 1, 1), n, n, n, 1);
  deck.block(Vec(1, 1, 1), m, m, m, 2, [&](const Vec& x) { return Vec(x + Vec(1 + gap, 0, 0)); });
  deck.cards = two_parts(nu);
  return deck;
}

/// Of all that moves: momentum, and angular momentum about the origin, of the half step.
std::pair<Vec, Vec> tied_momenta(const Simulation& s) {
  const Nodes& nodes = s.world().nodes;
  const Field<Real>* carried = shared_fields::tied_mass.find(nodes.fields);
  const Field<Real>* inertia = shared_fields::rotary_inertia.find(nodes.fields);
  const Field<Index>* none = shared_fields::no_rotation.find(nodes.fields);
  Vec p = Vec::Zero(), L = Vec::Zero();
  for (Index n = 0; n < nodes.size(); ++n) {
    if (nodes.follow[n] == 1) continue;
    const Real m = nodes.m[n] - (carried ? (*carried)[n] : 0);  // each mass where it is
    p += m * nodes.v.vec(n), L += m * nodes.x.vec(n).cross(nodes.v.vec(n));
    if (inertia && (*none)[n] == 0)
      L += (*inertia)[n] * shared_fields::angular_velocity.find(nodes.fields)->vec(n);
  }
  if (s.bodies())
    for (const RigidBody& b : s.bodies()->bodies()) p += b.m * b.v, L += b.L + b.m * b.x.cross(b.v);
  return {p, L};
}

/// Ties the nodes at x = 1 + gap of a bar (set 1) to part 1, however large the gap.
std::string tie_over_gap(SolidDeck& deck, Real gap) {
  deck.node_set(1, [&](const Vec& x) { return std::abs(x[0] - 1 - gap) < 1e-9; });
  return fmt::format(
      "*CONTACT_TIED_NODES_TO_SURFACE_CONSTRAINED_OFFSET\n         1         1         4         3\n\n"
      "                    {:10.3g}\n",
      -2 * gap);
}

/// Largest force on a node that should have none, over the force of the stress on an element's face; strained
/// uniformly along x.
Real force_of_constant_stress(int n, int m, const std::string& contact) {
  const Real nu = 0.3, rate = 1e-3;
  SolidDeck deck = bar(n, m, nu);
  deck.cards += contact;
  deck.cards += velocities(
      deck.nodes, [&](const Vec& x) { return Vec(rate * x[0], -nu * rate * x[1], -nu * rate * x[2]); });
  auto s = simulation_of(deck.text(1));
  s->step(do_nothing);
  Real most = 0, stress = 0;
  s->step([&](World& world, const Clock& clock, const std::string&) {
    stress = bar_E * rate * clock.t;
    for (Index k = 0; k < world.nodes.size(); ++k) {
      const Real x = world.nodes.x.data(0)[k];
      if (x < 1e-3 || x > 1.999 || world.nodes.follow[k]) continue;
      most = std::max(most, world.nodes.f.vec(k).norm());
    }
  });
  return most / (stress / (n * n));
}

/// From the times at which a coordinate passes where it was at the start, until some of them are known; the
/// first is half a period behind the start. 0: too few.
Real frequency_of(Simulation& s, const Field<Real>& x, int axis, Index node, Real longest,
                  std::size_t count) {
  const Real start = x.data(axis)[node];
  std::vector<Real> at{0};
  Real before = 0;
  while (s.clock().t < longest && at.size() <= count) {
    const Real t = s.clock().t;
    s.step(do_nothing);
    const Real now = x.data(axis)[node] - start;
    if (before * now < 0) at.push_back(t + before / (before - now) * (s.clock().t - t));
    before = now;
  }
  return at.size() <= count ? 0 : 0.5 * static_cast<Real>(count) / at.back();
}

/// Frequency of a free bar of length 2 whose halves start with cos(z x) and -cos(z (2 - x)), over c/4, that
/// of z = pi/2, its first axial mode.
Real axial_frequency(int n, int m, const std::string& contact, Real z = std::acos(0.0)) {
  SolidDeck deck = bar(n, m, 0);
  deck.cards += contact;
  deck.cards += velocities(deck.nodes, [&](const Vec& x) {
    const bool first = &x - deck.nodes.data() < (n + 1) * (n + 1) * (n + 1);
    return Vec(first ? std::cos(z * x[0]) : -std::cos(z * (2 - x[0])), 0, 0);
  });
  auto s = simulation_of(deck.text(10));
  const Real period = 4 / std::sqrt(bar_E / bar_rho);
  return period * frequency_of(*s, s->world().nodes.x, 0, 0, 10 * period, 4);
}

/// First frequency of a cantilever of two strips of shells, n cells along half of it, over that of Euler's
/// beam.
Real strip_frequency(int n, const std::string& contact) {
  ShellDeck deck;
  deck.plate(0.5, 0.1, n, 2, 1);
  deck.plate(0.5, 0.1, n + 1, 3, 2, [](const Vec& x) { return Vec(x + Vec(0.5, 0, 0)); });
  deck.part(1, 0.01, "*MAT_ELASTIC\n         1    7850.0   2.1E+11       0.0\n");
  deck.part(2, 0.01, "*MAT_ELASTIC\n         2    7850.0   2.1E+11       0.0\n");
  deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9; });
  deck.cards += contact;
  deck.velocity([](const Vec& x) {
    const Real s = 1.8751 * x[0], ratio = 0.7341;
    return Vec(0, 0, 0.01 * (std::cosh(s) - std::cos(s) - ratio * (std::sinh(s) - std::sin(s))));
  });
  auto s = simulation_of(deck.text(1));
  const Real euler = 8.3546;  // 1.8751^2/(2 pi) sqrt(E I/(rho A)), L = 1
  const Index tip = s->world().nodes.size() - 1;
  return frequency_of(*s, s->world().nodes.x, 2, tip, 1.2 / euler, 2) / euler;
}

}  // namespace

// Trapezoids integrate what is linear in each cell of the finer mesh: faces whose corners are nodes of it
// carry a constant stress without a force. Else they cannot, as of all nodes on faces: forces of some 10 to
// 30 % remain.
TEST(TiedContact, CarriesConstantStress) {
  EXPECT_LT(force_of_constant_stress(2, 4, tie("SURFACE_TO_SURFACE")), 1e-6);
  EXPECT_LT(force_of_constant_stress(3, 3, tie("NODES_TO_SURFACE")), 1e-6);
  EXPECT_LT(force_of_constant_stress(1, 5, tie("SURFACE_TO_SURFACE_CONSTRAINED_OFFSET")), 1e-6);
  const Real other = force_of_constant_stress(2, 3, tie("SURFACE_TO_SURFACE"));
  EXPECT_GT(other, 1e-3);
  EXPECT_LT(other, 0.3);
}

// c/(2 L); the stress is largest at the interface. Errors fall as the square of the cells where the finer
// mesh has the nodes of the other one, else a little slower.
TEST(TiedContact, ABarOfTwoMeshesHasTheFrequencyOfOne) {
  const auto errors = [&](const char* name, const std::function<int(int)>& finer) {
    std::vector<Real> out;
    for (const int n : {2, 4, 8}) {
      const Real f = axial_frequency(n, finer(n), tie("SURFACE_TO_SURFACE"));
      RecordProperty(fmt::format("{}_n{}", name, n), fmt::format("{:.6f}", f));
      out.push_back(std::abs(f - 1));
    }
    return out;
  };
  const std::vector<Real> twice = errors("twice", [](int n) { return 2 * n; });
  EXPECT_LT(twice[0], 0.026);  // (pi/2 h)^2/24 of a mesh of cells h
  EXPECT_LT(twice[2], 0.0017);
  EXPECT_GT(std::log2(twice[0] / twice[2]) / 2, 1.9);
  const std::vector<Real> half_more = errors("half_more", [](int n) { return n + n / 2; });
  EXPECT_LT(half_more[0],
            0.036);  // 0.0305 if corners had the masses of what is tied, which loses angular momentum
  EXPECT_LT(half_more[2], 0.003);
  EXPECT_GT(std::log2(half_more[0] / half_more[2]) / 2, 1.6);
}

// Rotations go over the edge where they are tied, else there is a hinge.
TEST(TiedContact, AStripOfTwoMeshesBendsAsOne) {
  for (const int n : {4, 10}) {
    const Real f = strip_frequency(n, tie("SHELL_EDGE_TO_SURFACE"));
    RecordProperty(fmt::format("strip_n{}", n), fmt::format("{:.6f}", f));
    EXPECT_NEAR(f, 1, n == 4 ? 0.02 : 0.005) << n;
  }
  EXPECT_LT(strip_frequency(4, tie("NODES_TO_SURFACE")), 0.5);
}

// With a gap, and turning by more than a right angle: nothing is strained, and all momenta are kept.
TEST(TiedContact, AGapGoesAlongWithoutForce) {
  SolidDeck deck = bar(2, 3, 0.3, 0.03);
  deck.cards += tie("SURFACE_TO_SURFACE_CONSTRAINED_OFFSET");
  const Vec omega(0, 3, 20);
  deck.cards += velocities(deck.nodes, [&](const Vec& x) { return Vec(omega.cross(x)); });
  auto s = simulation_of(deck.text(10));
  const auto [p, L] = tied_momenta(*s);
  const Nodes& nodes = s->world().nodes;
  const Real apart = (nodes.x.vec(13) - nodes.x.vec(nodes.size() - 30)).norm();
  while (s->clock().t < 0.1) s->step(do_nothing);
  const auto [p_now, L_now] = tied_momenta(*s);
  EXPECT_NEAR((p_now - p).norm(), 0, 1e-12 * p.norm());
  EXPECT_NEAR((L_now - L).norm(), 0, 1e-12 * L.norm());
  EXPECT_NEAR((nodes.x.vec(13) - nodes.x.vec(nodes.size() - 30)).norm(), apart, 0.01 * apart);
  sample_energy(s->world(), s->clock());
  EXPECT_LT(s->world().energy.internal, 0.01 * s->world().energy.kinetic);
}

// Blocks that are struck at one corner: momentum to round-off, energy to 0.1 %.
TEST(TiedContact, KeepsMomentaAndEnergy) {
  for (const char* option :
       {"SURFACE_TO_SURFACE", "SURFACE_TO_SURFACE_CONSTRAINED_OFFSET", "SURFACE_TO_SURFACE_OFFSET"}) {
    SolidDeck deck = bar(2, 3, 0.3, 0.02);
    deck.cards += tie(option) + "*CONTROL_TIMESTEP\n       0.0       0.1\n";
    deck.cards += velocities(deck.nodes, [&](const Vec& x) {
      const Real a = std::exp(-3 * (x - Vec(2, 1, 1)).squaredNorm());
      return Vec(-20 * a, 10 * a, 30 * a);
    });
    auto s = simulation_of(deck.text(10));
    test::start_ledger(*s);
    s->step(do_nothing);
    const auto [p, L] = tied_momenta(*s);
    Real worst = 0, deformed = 0;
    while (s->clock().t < 0.02) {
      s->step(do_nothing);
      sample_energy(s->world(), s->clock());
      deformed = std::max(deformed, s->world().energy.internal / s->world().energy.kinetic);
      const auto [p_now, L_now] = tied_momenta(*s);
      EXPECT_NEAR((p_now - p).norm(), 0, 1e-12 * p.norm()) << option;
      worst = std::max(worst, (L_now - L).norm() / L.norm());
    }
    EXPECT_LT(worst, 1e-12) << option;
    EXPECT_GT(deformed, 0.1) << option;
    EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3) << option;
  }
}

// Two bodies with a gap between them that turn freely, at any gap, speed and step: the centre of their masses
// goes straight on, momentum and angular momentum stay to round-off, and no energy is lost.
TEST(TiedContact, SpinsFreelyAcrossAGap) {
  for (const Real gap : {0.0, 0.02, 0.3})
    for (const Real speed : {1.0, 20.0})
      for (const Real tssfac : {0.2, 0.9}) {
        SolidDeck deck = bar(2, 3, 0.3, gap);
        deck.cards += gap > 0 ? tie_over_gap(deck, gap) : tie("SURFACE_TO_SURFACE");
        deck.cards += fmt::format("*CONTROL_TIMESTEP\n       0.0{:10}\n", tssfac);
        const Vec omega = speed * Vec(0.3, 0.5, 0.8);
        deck.cards +=
            velocities(deck.nodes, [&](const Vec& x) { return Vec(Vec(1, 2, 3) + omega.cross(x)); });
        auto s = simulation_of(deck.text(10));
        test::start_ledger(*s);
        const auto centre = [&] {
          Vec sum = Vec::Zero();
          Real mass = 0;
          const Field<Real>& carried = *shared_fields::tied_mass.find(s->world().nodes.fields);
          for (Index n = 0; n < s->world().nodes.size(); ++n) {
            const Real m = s->world().nodes.m[n] - carried[n];
            sum += m * s->world().nodes.x.vec(n), mass += m;
          }
          return std::pair(Vec(sum / mass), mass);
        };
        const Vec start = centre().first;
        const auto [p, L] = tied_momenta(*s);
        for (int k = 0; k < 400; ++k) s->step(do_nothing);
        const auto [p_now, L_now] = tied_momenta(*s);
        const auto [x, mass] = centre();
        EXPECT_LT((p_now - p).norm(), 1e-13 * p.norm()) << gap << " " << speed;
        if (gap > 0)  // else the corners have shares of the masses
          EXPECT_LT((L_now - L).norm(), 1e-13 * L.norm()) << gap << " " << speed;
        EXPECT_LT((x - start - s->clock().t * p / mass).norm(), 1e-12) << gap << " " << speed;
        EXPECT_LT(test::energy_error_of_a_step(*s), 2e-3) << gap << " " << speed;
      }
}

// Springs of 0.1 SFSA K/h per area, K = E/3 and h of the cells, between halves of the bar that start as in
// their own mode: z tan z = 2 k L/E for half the length.
TEST(TiedContact, SpringsMakeABarALittleSofter) {
  const Real h = 0.125, k = 0.1 * 10 * (bar_E / 3) / h;
  Real z = 1;
  for (int it = 0; it < 1000; ++it) z += 0.1 * (std::atan(2 * k / (bar_E * z)) - z);
  const Real exact = z / std::acos(0.0);
  const Real f = axial_frequency(8, 8, tie("SURFACE_TO_SURFACE_OFFSET", "      10.0      10.0\n"), z);
  RecordProperty("frequency", fmt::format("{:.6f} of {:.6f}", f, exact));
  EXPECT_NEAR(f, exact, 0.005 * exact);
  EXPECT_LT(exact, 0.95);
}

// Faces that may fail, and contacts that may die, are tied exactly until then: the same step and the same
// motion.
TEST(TiedContact, WhatMayFailIsTiedExactly) {
  const auto positions_after = [](const std::string& cards) {
    SolidDeck deck = bar(3, 4, 0.3, 0.02);
    deck.cards +=
        cards + velocities(deck.nodes, [](const Vec& x) { return Vec(std::sin(3 * x[1]), x[0], 1); });
    auto s = simulation_of(deck.text(1));
    for (int k = 0; k < 50; ++k) s->step(do_nothing);
    std::vector<Real> out{s->clock().t};
    for (Index n = 0; n < s->world().nodes.size(); ++n)
      for (int a = 0; a < 3; ++a) out.push_back(s->world().nodes.x.data(a)[n]);
    return out;
  };
  const std::vector<Real> exact = positions_after(tie("SURFACE_TO_SURFACE"));
  EXPECT_EQ(positions_after(tie("SURFACE_TO_SURFACE") +
                            "*MAT_ADD_EROSION\n         1       0.0\n       0.0     1.0E6\n"),
            exact);
  EXPECT_EQ(positions_after("*CONTACT_TIED_SURFACE_TO_SURFACE_ID\n7,glue\n2,1,3,3\n,,,,,,,0.5\n\n"), exact);
}

namespace {

/// Two struck halves that are tied up to t = 0.005, until 0.01.
void expect_release(const SolidDeck& deck, const std::string& what) {
  auto s = simulation_of(deck.text(10));
  test::start_ledger(*s);
  s->step(do_nothing);
  const auto tied = [&] {
    Index count = 0;
    for (Index n = 0; n < s->world().nodes.size(); ++n) count += s->world().nodes.follow[n] == 2;
    return count;
  };
  const Index at_start = tied();
  EXPECT_GT(at_start, 0) << what;
  const auto [p, L] = tied_momenta(*s);
  Real worst = 0;
  while (s->clock().t < 0.01) {
    s->step(do_nothing);
    const auto [p_now, L_now] = tied_momenta(*s);
    EXPECT_LT((p_now - p).norm(), 1e-12 * p.norm()) << what;
    worst = std::max(worst, (L_now - L).norm() / L.norm());
    if (s->clock().t < 0.005) EXPECT_EQ(tied(), at_start) << what;
  }
  EXPECT_LT(worst, 1e-12) << what;
  EXPECT_EQ(tied(), 0) << what;
  EXPECT_EQ(s->world().counters["broken_ties"], at_start) << what;
  for (const auto* reporter : s->world().passes.all<InterfaceReporter>())
    EXPECT_EQ(reporter->report().on_surfa.norm(), 0) << what;
  const Field<Real>& carried = *shared_fields::tied_mass.find(s->world().nodes.fields);
  Real left = 0, mass = 0;
  for (Index n = 0; n < s->world().nodes.size(); ++n)
    left = std::max(left, std::abs(carried[n])), mass = std::max(mass, s->world().nodes.m[n]);
  EXPECT_LT(left, 1e-13 * mass) << what;
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3) << what;
}

}  // namespace

TEST(TiedContact, ReleasesNodesAtItsDeathAndWithTheirFaces) {
  for (const bool by_death : {true, false}) {
    SolidDeck deck = bar(2, 3, 0.3, 0.02);
    deck.cards += by_death ? "*CONTACT_TIED_SURFACE_TO_SURFACE_ID\n7,glue\n2,1,3,3\n,,,,,,,0.005\n\n"
                           : tie("SURFACE_TO_SURFACE");
    deck.cards += "*CONTROL_TIMESTEP\n       0.0       0.1\n";
    if (!by_death)
      for (const int e : {2, 4, 6, 8})
        deck.cards += fmt::format("*DEFINE_ELEMENT_DEATH_SOLID\n{},0.005\n", e);
    deck.cards += velocities(deck.nodes, [&](const Vec& x) {
      const Real a = std::exp(-3 * (x - Vec(2, 1, 1)).squaredNorm());
      return Vec(-20 * a, 10 * a, 30 * a);
    });
    expect_release(deck, by_death ? "death" : "deleted faces");
  }
}

// Rotations of a shell whose edge is tied to a plate.
TEST(TiedContact, ReleasesRotations) {
  ShellDeck deck;
  deck.plate(1, 1, 2, 2, 1);
  deck.plate(0.4, 0.4, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(0.3, 0.3, 0.01)); });
  deck.part(1, 0.1, "*MAT_ELASTIC\n1,1000.0,1.0E8,0.3\n");
  deck.cards +=
      "*PART\nupper\n2,1,1\n*CONTACT_TIED_SHELL_EDGE_TO_SURFACE_CONSTRAINED_OFFSET_ID\n7,glue\n2,1,3,3\n"
      ",,,,,,,0.002\n\n*CONTROL_TIMESTEP\n       0.0       0.1\n";
  auto s = simulation_of(deck.text(1));
  Field<Real>& spin = *shared_fields::angular_velocity.find(s->world().nodes.fields);
  for (Index n = 0; n < 9; ++n) {
    const Vec x = s->world().nodes.x.vec(n);
    s->world().nodes.v.set(n, Vec(0.1 * x[1], -0.2 * x[0], x[0] * x[1]));
    spin.set(n, Vec(0.3 * x[0], 1, -0.5));
  }
  test::start_ledger(*s);
  s->step(do_nothing);
  const auto [p, L] = tied_momenta(*s);
  while (s->clock().t < 0.004) s->step(do_nothing);
  const auto [p_now, L_now] = tied_momenta(*s);
  EXPECT_EQ(s->world().counters["broken_ties"], s->world().counters["tied_nodes"]);
  EXPECT_LT((p_now - p).norm(), 1e-12 * p.norm());
  const Field<Index>& none = *shared_fields::no_rotation.find(s->world().nodes.fields);
  for (Index n = 0; n < s->world().nodes.size(); ++n) EXPECT_EQ(none[n], 0) << n;
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

// A rigid plate hangs on a soft block by springs; the faces are the plate's, or the block's.
TEST(TiedContact, SpringsHoldRigidBodies) {
  for (const char* sides : {"         2         1", "         1         2"}) {
    SolidDeck deck;
    deck.block(Vec(1, 1, 1), 2, 2, 2, 1);
    deck.block(Vec(1, 1, 0.5), 3, 3, 1, 2, [](const Vec& x) { return Vec(x + Vec(0, 0, 1)); });
    deck.cards =
        "*SECTION_SOLID\n         1         1\n*PART\nsoft\n         1         1         1\n*MAT_ELASTIC\n   "
        "     "
        " 1    1000.0     1.0E7       0.3\n*PART\nstiff\n         2         1         2\n*MAT_RIGID\n        "
        " 2   "
        " 2000.0     1.0E9       0.3\n*CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET\n" +
        std::string(sides) + "         3         3\n\n\n*CONTROL_TIMESTEP\n       0.0       0.1\n";
    deck.cards +=
        velocities(deck.nodes, [](const Vec& x) { return x[2] < 0.999 ? Vec(0, 0, -2) : Vec(0.5, 0, 0); });
    auto s = simulation_of(deck.text(10));
    test::start_ledger(*s);
    s->step(do_nothing);
    const auto [p, L] = tied_momenta(*s);
    Real stretched = 0;
    while (s->clock().t < 0.1) {
      s->step(do_nothing);
      stretched = std::max(stretched, s->world().nodes.x.data(2)[44] - 1);
    }
    const auto [p_now, L_now] = tied_momenta(*s);
    EXPECT_NEAR((p_now - p).norm(), 0, 1e-10 * p.norm());
    EXPECT_LT((L_now - L).norm(), 5e-3 * L.norm());
    EXPECT_LT(test::energy_error_of_a_step(*s), 2e-3);
    const RigidBody& b = s->bodies()->bodies().front();
    const Nodes& nodes = s->world().nodes;  // they are still together
    EXPECT_LT((nodes.x.vec(18) - nodes.x.vec(27)).norm(), 0.1);
    EXPECT_GT(b.v.norm(), 0.1);
  }
}

namespace {

/// All but viscosity, which takes, of the scene after many steps, over that of the start.
Real energy_left(Simulation& s, int steps) {
  test::start_ledger(s);
  const Real before = s.world().energy.kinetic;
  for (int k = 0; k < steps; ++k) s.step(do_nothing);
  sample_energy(s.world(), s.clock());
  const EnergyLedger& e = s.world().energy;
  return (e.kinetic + e.internal + e.contact) / before;
}

Vec wave(const Vec& x) {
  return {0.3 * std::sin(5 * x[1] + x[2]), 0.1 * x[0] * x[2], 0.2 * std::cos(3 * x[1] + 7 * x[0])};
}

}  // namespace

// As far off as faces are wide, nodes have an inertia about the face that masses of its corners do not have.
TEST(TiedContact, HoldsNodesFarBesideTheirFaces) {
  for (const Real gap : {0.25, 0.5, 1.0}) {
    SolidDeck deck = bar(4, 5, 0.3, gap);
    deck.cards += velocities(deck.nodes, wave);
    const auto free = simulation_of(deck.text(10));
    deck.cards += tie_over_gap(deck, gap);
    auto s = simulation_of(deck.text(10));
    const auto momentum = [&](const World& world) {
      Vec p = Vec::Zero();
      for (Index n = 0; n < world.nodes.size(); ++n) p += free->world().nodes.m[n] * world.nodes.v.vec(n);
      return p;
    };
    const Vec p = momentum(free->world());
    EXPECT_NEAR((momentum(s->world()) - p).norm(), 0, 1e-10 * p.norm()) << gap;
    EXPECT_LT(energy_left(*s, 600), 1.02) << gap;
  }
}

// Nodes go with the face from the start, and what the face's support takes is reported as lost.
TEST(TiedContact, StartsAtRestOnAHeldFace) {
  SolidDeck deck = bar(2, 3, 0.3);
  deck.cards += tie("SURFACE_TO_SURFACE");
  deck.node_set(1, [&](const Vec& x) { return &x - deck.nodes.data() < 27; });
  deck.cards += "*BOUNDARY_SPC_SET\n         1         0         1         1         1\n";
  deck.cards += velocities(deck.nodes, [](const Vec&) { return Vec(1, 2, 3); });
  auto s = simulation_of(deck.text(1));
  const Nodes& nodes = s->world().nodes;
  for (Index n = 0; n < nodes.size(); ++n)
    if (n < 27 || nodes.follow[n]) EXPECT_EQ(nodes.v.vec(n), Vec(0, 0, 0)) << n;
}

// Of the parts that are named, whatever nodes of theirs are tied; with the moment about the face where there
// is a gap, and nothing for mass that scaling adds.
TEST(TiedContact, CarriesTheWeightOfPartsWhereTheyAre) {
  for (const int part : {1, 2})
    for (const bool scaled : {false, true}) {
      SolidDeck deck = bar(2, 3, 0.3, 0.02);
      deck.cards += tie("SURFACE_TO_SURFACE") +
                    fmt::format("*LOAD_GRAVITY_PART\n{:10}         2         1      10.0\n", part) +
                    "*DEFINE_CURVE\n         1\n0.0,1.0\n10.0,1.0\n";
      if (scaled)
        deck.cards +=
            "*CONTROL_TIMESTEP\n       0.0       0.9         0       0.0  -8.0e-04         0         0       "
            "  1\n";
      auto s = simulation_of(deck.text(10));
      while (s->clock().t < 0.05) s->step(do_nothing);
      const auto [p, L] = tied_momenta(*s);
      const Real t = s->clock().t - 0.5 * s->clock().dt_old;
      EXPECT_NEAR((p - Vec(0, -10 * 1000 * t, 0)).norm(), 0, 1e-9 * p.norm()) << part << scaled;
      EXPECT_NEAR(L[2], -10 * 1000 * t * (part == 1 ? 0.5 : 1.52), 2e-3 * L.norm()) << part << scaled;
      if (scaled) EXPECT_GT(s->world().maxima["added_mass"], 100);
      sample_energy(s->world(), s->clock());
    }
}

// Rotations that a support holds stay held where those of the face are free.
TEST(TiedContact, LeavesHeldRotationsHeld) {
  ShellDeck deck;
  deck.plate(1, 1, 4, 4, 1);
  deck.plate(1, 1, 5, 5, 2, [](const Vec& x) { return Vec(x + Vec(1, 0, 0)); });
  for (const int part : {1, 2})
    deck.part(part, 0.05, fmt::format("*MAT_ELASTIC\n{:10}    1000.0   1.0E+07       0.3\n", part));
  deck.hold(1, "XYZ", [&](const Vec& x) { return &x - deck.nodes.data() >= 25 && x[0] < 1 + 1e-9; });
  deck.cards += tie("SHELL_EDGE_TO_SURFACE");
  deck.velocity([](const Vec& x) { return Vec(0, 0, 0.3 * std::sin(3 * x[0])); });
  auto s = simulation_of(deck.text(1));
  while (s->clock().t < 0.1) s->step(do_nothing);
  const World& world = s->world();
  const auto& angle = *shared_fields::rotation.find(world.nodes.fields);
  int tied = 0;
  for (Index n = 25; n < world.nodes.size(); ++n) {
    if (!world.nodes.follow[n]) continue;
    ++tied;
    EXPECT_EQ(angle.vec(n).norm(), 0) << n;
  }
  EXPECT_EQ(tied, 6);
  EXPECT_GT(angle.vec(24).norm(), 1e-3);  // the faces turn
}

// Four contacts that hold the same nodes act at once.
TEST(TiedContact, SpringsOfSeveralContactsShareOneStep) {
  for (const int scale : {3, 30}) {
    SolidDeck deck = bar(4, 4, 0.3);
    for (int k = 0; k < 4; ++k)
      deck.cards += fmt::format(
          "*CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET\n         2         1         3         3\n\n"
          "{0:10}{0:10}\n",
          scale);
    deck.cards += velocities(deck.nodes, wave);
    EXPECT_LT(energy_left(*simulation_of(deck.text(10)), 400), 1.02) << scale;
  }
}

// The springs' step is that of the body, not of the masses that its elements would have.
TEST(TiedContact, SpringsHoldBodiesThatAreLighterThanTheirElements) {
  for (const Real of_elements : {0.1, 1e-3}) {
    SolidDeck deck;
    deck.block(Vec(1, 1, 1), 4, 4, 4, 1);
    deck.block(Vec(1, 1, 0.5), 4, 4, 1, 2, [](const Vec& x) { return Vec(x + Vec(0, 0, 1)); });
    deck.cards =
        "*SECTION_SOLID\n         1         1\n*PART\nsoft\n         1         1         1\n*MAT_ELASTIC\n"
        "         1    1000.0     1.0E7       0.3\n*MAT_RIGID\n         2    1000.0     1.0E9       0.3\n" +
        fmt::format(
            "*PART_INERTIA\nlight\n         2         1         2\n       0.5       0.5      1.25{0:10.3g}\n"
            "{1:10.3g}       0.0       0.0{1:10.3g}       0.0{1:10.3g}\n\n",
            500 * of_elements, 50 * of_elements) +
        tie("SURFACE_TO_SURFACE_OFFSET");
    deck.cards +=
        velocities(deck.nodes, [](const Vec& x) { return Vec(0, 0.2 * x[0], x[2] < 1 - 1e-9 ? -1 : 0); });
    EXPECT_LT(energy_left(*simulation_of(deck.text(10)), 2000), 1.02) << of_elements;
  }
}

TEST(TiedContact, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const char* option : {"SURFACE_TO_SURFACE", "SURFACE_TO_SURFACE_OFFSET"}) {
    SolidDeck deck = bar(5, 7, 0.3, 0.01);
    deck.cards += tie(option);
    deck.cards += velocities(
        deck.nodes, [](const Vec& x) { return Vec(std::sin(3 * x[1]), x[0] * x[2], std::cos(x[0])); });
    test::expect_same_bits(deck.text(1), 40, 17);
  }
}

// Nodes are released before the restart.
TEST(TiedContact, ReleasedNodesHaveTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  SolidDeck deck = bar(5, 7, 0.3, 0.01);
  deck.cards += tie("SURFACE_TO_SURFACE");
  for (const int e : {5, 10, 60, 125})
    deck.cards += fmt::format("*DEFINE_ELEMENT_DEATH_SOLID\n{},0.0005\n", e);
  deck.cards += velocities(deck.nodes,
                           [](const Vec& x) { return Vec(std::sin(3 * x[1]), x[0] * x[2], std::cos(x[0])); });
  test::expect_same_bits(deck.text(1), 40, 17);
}

namespace {

/// A cube on another one, held below and drawn at the top along an axis, until all ties are broken; the
/// largest stress (of the ties' force over the interface) so far, and that of the end.
struct Torn {
  Real most = 0, after = 0, energy_error = 0, lost = 0;
  std::int64_t broken = 0;
  Real contact = 0;
};
std::string torn_deck(const std::string& contact, int axis, Real speed) {
  SolidDeck deck;
  deck.block(Vec(1, 1, 1), 2, 2, 2, 1);
  deck.block(Vec(1, 1, 1), 4, 4, 4, 2, [](const Vec& x) { return Vec(x + Vec(0, 0, 1)); });
  deck.cards = two_parts(0) + contact + "*CONTROL_TIMESTEP\n       0.0       0.2\n";
  deck.node_set(1, [](const Vec& x) { return x[2] < 1e-9; });
  deck.node_set(2, [](const Vec& x) { return x[2] > 2 - 1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n         1         0         1         1         1\n";
  deck.cards += fmt::format("*BOUNDARY_PRESCRIBED_MOTION_SET\n         2{:10}         0         1{:10.3e}\n",
                            axis, speed);
  deck.cards += fmt::format("*BOUNDARY_SPC_SET\n         2         0{:10}{:10}{:10}\n", axis == 1 ? 0 : 1,
                            axis == 2 ? 0 : 1, axis == 3 ? 0 : 1);
  deck.cards += "*DEFINE_CURVE\n         1\n0.0,0.0\n0.02,1.0\n10.0,1.0\n";
  return deck.text(10);
}
Torn tear(const std::string& contact, int axis, Real speed) {
  auto s = simulation_of(torn_deck(contact, axis, speed));
  test::start_ledger(*s);
  Torn out;
  const auto pull = [&] {
    Real force = 0;
    for (const auto* reporter : s->world().passes.all<InterfaceReporter>())
      force = std::max(force, reporter->report().on_surfa.norm());
    return force;
  };
  while (s->clock().t < 0.15) {
    s->step(do_nothing);
    out.most = std::max(out.most, pull());
  }
  for (const auto* reporter : s->world().passes.all<InterfaceReporter>())
    out.lost = std::max(out.lost, reporter->report().energy_damping);
  out.after = pull(), out.broken = s->world().counters["broken_ties"];
  out.energy_error = test::energy_error_of_a_step(*s);
  return out;
}
std::string tiebreak(const std::string& name, const std::string& card) {
  return "*CONTACT_" + name +
         "_ID\n         7glue\n         2         1         3         3\n\n      10.0      10.0\n" + card;
}

}  // namespace

// E v t/L grows to the strength, apart from waves of rho c v: 1e9 / 2 * 2.5e-4 * 0.1 = 12500; in shear with
// E/2.
TEST(TiebreakContact, BreaksAtTheGivenStress) {
  const std::string by_option =
      tiebreak("AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", "         2   10000.0    4000.0\n");
  const Torn pulled = tear(by_option, 3, 4e-4);
  EXPECT_NEAR(pulled.most, 1e4, 300);
  RecordProperty("stress", fmt::format("{:.1f}", pulled.most));
  EXPECT_EQ(pulled.broken, 25);
  EXPECT_LT(pulled.after, 10);           // rims that swing side by side
  EXPECT_LT(pulled.energy_error, 4e-3);  // it falls with the step: what is torn swings freely
  const Torn pushed = tear(by_option, 3, -4e-4);
  EXPECT_EQ(pushed.broken, 0);
  const Torn strong = tear(tiebreak("TIEBREAK_SURFACE_TO_SURFACE", "   20000.0   10000.0\n"), 3, 4e-4);
  EXPECT_EQ(strong.broken, 0);
  EXPECT_GT(strong.after, 1.2e4);
}

// Inner nodes have 1/16 of the interface and break first, at 16 times their force in all; those of the
// corners, with a quarter of that, may hold.
TEST(TiebreakContact, BreaksAtTheGivenForce) {
  const Torn torn =
      tear(tiebreak("TIEBREAK_NODES_TO_SURFACE", "     625.0     625.0       2.0       2.0\n"), 3, 4e-4);
  EXPECT_GE(torn.broken, 9);
  EXPECT_NEAR(torn.most, 1e4, 400);
  EXPECT_LE(torn.after, 4 * 625);
}

// Behind the strength the stress falls to nothing at the opening PARAM: sigma PARAM/2 per area are lost.
TEST(TiebreakContact, SoftensUpToTheGivenOpening) {
  for (const int option : {6, 8}) {
    const Torn torn = tear(tiebreak("AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK",
                                    fmt::format("{:10}   10000.0    4000.0    0.0010\n", option)),
                           3, 0.02);
    EXPECT_NEAR(torn.most, 1e4, 300);
    EXPECT_EQ(torn.broken, 25);
    EXPECT_NEAR(torn.lost, 0.5 * 1e4 * 1e-3, 0.02 * 5);
    EXPECT_LT(torn.energy_error, 4e-3);
    RecordProperty("lost", fmt::format("{:.4f}", torn.lost));
  }
  const Torn half =
      tear(tiebreak("AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", "         6   10000.0    4000.0    0.0100\n"), 3,
           0.02);
  EXPECT_EQ(half.broken, 0);
  EXPECT_GT(half.after, 1e3);
}

// FS and FD are stresses there, and nothing is left between the sides.
TEST(TiebreakContact, TiedSurfacesFailAtTheirStresses) {
  const std::string name =
      "*CONTACT_TIED_SURFACE_TO_SURFACE_FAILURE_ID\n         7glue\n         2         1         3         "
      "3\n";
  const std::string scales = "      10.0      10.0\n";
  const Torn pulled = tear(name + "   10000.0    4000.0\n" + scales, 3, 4e-4);
  EXPECT_NEAR(pulled.most, 1e4, 300);
  EXPECT_EQ(pulled.broken, 25);
  EXPECT_EQ(pulled.after, 0);
  const Torn sheared = tear(name + "   10000.0    4000.0\n" + scales, 1, 4e-4);
  EXPECT_EQ(sheared.broken, 25);
  EXPECT_EQ(tear(name + "   20000.0   20000.0\n" + scales, 3, 4e-4).broken, 0);
}

// The stress grows until then as it would without an end; the motion takes 0.02 to start.
TEST(TiedContact, SpringsEndAtTheirDeath) {
  const auto glue = [](Real death) {
    return "*CONTACT_TIED_SURFACE_TO_SURFACE_OFFSET_ID\n         7glue\n         2         1         3       "
           "  "
           "3\n" +
           fmt::format("{:>70}{:10}\n      10.0      10.0\n", "", death);
  };
  const Torn ends = tear(glue(0.06), 3, 4e-4), holds = tear(glue(1), 3, 4e-4);
  EXPECT_NEAR(ends.most / holds.most, 0.05 / 0.14, 0.01);
  EXPECT_EQ(ends.after, 0);
  EXPECT_GT(holds.after, 0.9 * holds.most);
  EXPECT_GT(ends.lost, 0);
  EXPECT_LT(ends.energy_error, 4e-3);
}

TEST(TiebreakContact, SofteningHasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  const std::string deck = torn_deck(
      tiebreak("AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", "         6   10000.0     100.0    0.0010\n"), 1,
      1.0);
  test::expect_same_bits(deck, 120, 80);
}

// In shear; ties are broken before the restart.
TEST(TiebreakContact, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  const std::string deck = torn_deck(
      tiebreak("AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", "         2   10000.0     100.0\n"), 1, 1.0);
  auto s = simulation_of(deck);
  int steps = 0;
  while (s->world().counters["broken_ties"] == 0 && steps < 200) s->step(do_nothing), ++steps;
  ASSERT_LT(steps, 200);
  test::expect_same_bits(deck, steps + 20, steps);
}
