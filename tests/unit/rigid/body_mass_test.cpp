// Mass, centre and inertia of bodies of each kind of element, with what hangs on their nodes, and merged.
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/shells/shell_decks.hpp"
#include "../../verification/structures/solid_decks.hpp"
#include "rigid/bodies/body_mass.hpp"

using namespace courant;

namespace body_mass_test {
namespace {

using test::ShellDeck;
using test::simulation_of;
using test::SolidDeck;

struct Whole {
  Real m = 0;
  Vec x = Vec::Zero();
  Matrix J = Matrix::Zero();  ///< about x
  Whole operator+(const Whole& other) const {
    Whole out;
    out.m = m + other.m, out.x = (m * x + other.m * other.x) / out.m;
    for (const Whole* one : {this, &other}) {
      const Vec r = one->x - out.x;
      out.J += one->J + one->m * (r.squaredNorm() * Matrix::Identity() - r * r.transpose());
    }
    return out;
  }
};
Whole box(Real rho, const Vec& corner, const Vec& a) {
  Whole out;
  out.m = rho * a.prod(), out.x = corner + 0.5 * a;
  for (int k = 0; k < 3; ++k) out.J(k, k) = out.m / 12 * (a.squaredNorm() - a[k] * a[k]);
  return out;
}
Whole point(Real m, const Vec& x) {
  Whole out;
  out.m = m, out.x = x;
  return out;
}
void expect_body(const RigidBody& b, const Whole& w, const char* what) {
  EXPECT_NEAR(b.m, w.m, 1e-9 * w.m) << what;
  EXPECT_NEAR((b.x - w.x).norm(), 0, 1e-9) << what;
  EXPECT_NEAR((b.J0 - w.J).norm(), 0, 1e-8 * w.J.norm()) << what;
}
const std::string rigid = "*SECTION_SOLID\n1,1\n*PART\nrigid\n1,1,1\n*MAT_RIGID\n1,1000.0,1.0E9,0.3\n0\n0\n";
const std::string soft = "*PART\nsoft\n2,1,2\n*MAT_ELASTIC\n2,300.0,1.0E7,0.3\n";

}  // namespace

// A rigid brick of 0.2 x 0.3 x 0.4 and a soft one of 0.1 x 0.3 x 0.4 at its side: half of the soft mass is on
// the nodes of the body, equal parts of it on each; masses of nodes come on top.
TEST(BodyMass, OfSolidsWithWhatSharesTheirNodes) {
  for (const bool with_soft : {false, true})
    for (const bool with_masses : {false, true}) {
      SolidDeck deck;
      // two cells along x of different lengths
      const auto stretched = [](const Vec& x) {
        return Vec(x[0] > 0.25 ? 0.3 : x[0] > 0.1 ? 0.2 : x[0], x[1], x[2]);
      };
      deck.block(
          Vec(0.4, 0.3, 0.4), with_soft ? 2 : 1, 1, 1, 1,
          with_soft ? std::function<Vec(const Vec&)>(stretched)
                    : [](const Vec& x) { return Vec(0.5 * x[0], x[1], x[2]); });
      if (with_soft) deck.elements.replace(deck.elements.find('\n') + 9, 8, fmt::format("{:8}", 2));
      deck.cards = rigid + (with_soft ? soft : "") +
                   (with_masses ? "*ELEMENT_MASS\n       7       1             2.5\n" : "");
      const auto s = simulation_of(deck.text(1));
      ASSERT_NE(s, nullptr);
      ASSERT_EQ(s->bodies()->bodies().size(), 1u);
      Whole expected = box(1000, Vec::Zero(), Vec(0.2, 0.3, 0.4));
      for (const Real y : {0.0, 0.3})
        for (const Real z : {0.0, 0.4})
          if (with_soft) expected = expected + point(300 * 0.1 * 0.3 * 0.4 / 8, Vec(0.2, y, z));
      if (with_masses) expected = expected + point(2.5, Vec::Zero());
      expect_body(s->bodies()->bodies()[0], expected, with_soft ? "with soft" : "alone");
    }
}

// A rigid plate of 0.4 x 0.2, 0.05 thick.
TEST(BodyMass, OfShells) {
  ShellDeck deck;
  deck.plate(0.4, 0.2, 2, 1, 1);
  deck.part(1, 0.05, "*MAT_RIGID\n1,1000.0,1.0E9,0.3\n0\n0\n");
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  // through the thickness, too, or as a sheet
  const Whole thick = box(1000, Vec(0, 0, -0.025), Vec(0.4, 0.2, 0.05));
  const RigidBody& b = s->bodies()->bodies()[0];
  EXPECT_NEAR(b.m, 4, 1e-12);
  EXPECT_NEAR((b.x - thick.x).norm(), 0, 1e-12);
  EXPECT_NEAR((b.J0 - thick.J).norm(), 0, 1e-9);
}

// The lead takes mass, centre and inertia of what is merged into it; its velocity is that of both momenta.
TEST(BodyMass, OfMergedParts) {
  SolidDeck deck;
  deck.block(Vec(0.2, 0.3, 0.4), 1, 1, 1, 1);
  deck.block(Vec(0.1, 0.1, 0.2), 1, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(0.5, 0.6, 0.7)); });
  deck.cards =
      rigid + "*PART\nsecond\n2,1,2\n*MAT_RIGID\n2,500.0,1.0E9,0.3\n0\n0\n*CONSTRAINED_RIGID_BODIES\n1,2\n";
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  ASSERT_EQ(s->bodies()->bodies().size(), 1u);
  expect_body(s->bodies()->bodies()[0],
              box(1000, Vec::Zero(), Vec(0.2, 0.3, 0.4)) + box(500, Vec(0.5, 0.6, 0.7), Vec(0.1, 0.1, 0.2)),
              "merged");
  RigidBody a, b;
  a.m = 2, a.x = Vec(1, 2, 3), a.v = Vec(1, 0, -1), a.L = Vec(0.1, 0.2, 0.3),
  a.J0 = Vec(1, 2, 3).asDiagonal();
  b.m = 3, b.x = Vec(-1, 0, 5), b.v = Vec(2, 1, 4), b.L = Vec(0.4, -0.2, 0.5),
  b.J0 = Vec(3, 1, 2).asDiagonal();
  const auto about_origin = [](const RigidBody& one) { return Vec(one.L + one.m * one.x.cross(one.v)); };
  const Vec L = about_origin(a) + about_origin(b), p = a.m * a.v + b.m * b.v;
  const Whole both = Whole{a.m, a.x, a.J0} + Whole{b.m, b.x, b.J0};
  join_mass(a, b);
  expect_body(a, both, "joined");
  EXPECT_NEAR((a.m * a.v - p).norm(), 0, 1e-12);
  EXPECT_NEAR((about_origin(a) - L).norm(), 0, 1e-12);
}

// Rows of held turns do not count; a body without inertia about a free axis cannot turn.
TEST(BodyMass, WhatCanTurn) {
  RigidBody b;
  b.J0 = Vec(1, 2, 3).asDiagonal();
  EXPECT_TRUE(can_turn(b));
  b.J0(1, 1) = 0;
  EXPECT_FALSE(can_turn(b));
  b.no_turn = {false, true, false};
  EXPECT_TRUE(can_turn(b));
  b.no_turn = {true, false, true};
  EXPECT_FALSE(can_turn(b));
  b.J0.setZero(), b.no_turn = {true, true, true};
  EXPECT_TRUE(can_turn(b)) << "it need not";
}

}  // namespace body_mass_test
