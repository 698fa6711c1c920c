// *CONSTRAINED_INTERPOLATION: a node goes with the weighted mean of others.
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "same_bits.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;
using test::start_ledger;

namespace {

/// A cube of side 1 kg and 1 m, nodes 1 to 8, whose corners move node 9 at `place`; more nodes behind it.
SolidDeck interpolated_cube(const Vec& place, const std::string& independent, const std::string& cards) {
  SolidDeck deck;
  deck.block({1, 1, 1}, 1, 1, 1, 1);
  deck.nodes.push_back(place);
  deck.cards =
      "*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1.0,1.0E5,0.3\n*CONSTRAINED_INTERPOLATION\n1,"
      "9\n" +
      independent + cards;
  return deck;
}
const std::string all_corners = "1\n2\n3\n4\n5\n6\n7\n8\n";
const std::string constant_curve_of_9 = "*DEFINE_CURVE\n9\n0.0,1.0\n9.0,1.0\n";

/// Forces on nodes 1 to 8 at the start.
std::vector<Vec> forces_at_start(const std::string& deck) {
  auto s = simulation_of(deck);
  std::string who;
  s->evaluate(who);
  std::vector<Vec> out;
  for (Index n = 0; n < 8; ++n) out.push_back(s->world().nodes.f.vec(n));
  return out;
}

}  // namespace

// F at x, off the centre c: w (F + theta x r), J theta = (x - c) x F; of a unit cube J = 1/2. Weights 3 and 1
// move c to x = 1/4.
TEST(Interpolation, SpreadsForcesByWeight) {
  for (const bool weighted : {false, true}) {
    std::string independent;
    for (const char* n : {"1", "3", "5", "7"}) independent += std::string(n) + (weighted ? ",,3.0\n" : "\n");
    for (const char* n : {"2", "4", "6", "8"}) independent += std::string(n) + "\n";
    const Vec place(2, 0.5, 0.7), F(0.3, -0.2, 1);
    std::string loads;
    for (int k = 0; k < 3; ++k) loads += fmt::format("*LOAD_NODE_POINT\n9,{},9,{}\n", k + 1, F[k]);
    const SolidDeck deck = interpolated_cube(place, independent, loads + constant_curve_of_9);
    const std::vector<Vec> found = forces_at_start(deck.text(1));
    Vec force = Vec::Zero(), moment = Vec::Zero(), c = Vec::Zero();
    const auto w = [&](std::size_t n) { return weighted ? (n % 2 == 0 ? 3.0 : 1.0) / 16 : 0.125; };
    for (std::size_t n = 0; n < 8; ++n) c += w(n) * deck.nodes[n];
    for (std::size_t n = 0; n < 8; ++n) force += found[n], moment += (deck.nodes[n] - place).cross(found[n]);
    EXPECT_LT((force - F).norm(), 1e-14);
    EXPECT_LT(moment.norm(), 1e-14);
    EXPECT_NEAR(c[0], weighted ? 0.25 : 0.5, 1e-14);
    Matrix J = Matrix::Zero();
    for (std::size_t n = 0; n < 8; ++n) {
      const Vec r = deck.nodes[n] - c;
      J += w(n) * (r.squaredNorm() * Matrix::Identity() - r * r.transpose());
    }
    if (!weighted) {
      EXPECT_LT((J - 0.5 * Matrix::Identity()).norm(), 1e-14);
    }
    const Vec theta = J.inverse() * (place - c).cross(F);
    for (std::size_t n = 0; n < 8; ++n)
      EXPECT_LT((found[n] - w(n) * (F + theta.cross(Vec(deck.nodes[n] - c)))).norm(), 1e-14) << n;
  }
}

// A cube tumbles by more than a turn: node 9 stays where it is in it.
TEST(Interpolation, TurnsWithTheOthers) {
  SolidDeck deck = interpolated_cube({2, 0.5, 0.7}, all_corners, "");
  auto s = simulation_of(deck.text(10));
  Nodes& nodes = s->world().nodes;
  const Vec omega(1, -2, 4), centre(0.5, 0.5, 0.5);
  for (Index n = 0; n < 9; ++n) nodes.v.set(n, Vec(0.3, 0, 0) + omega.cross(Vec(nodes.x.vec(n) - centre)));
  while (s->clock().t < 2) s->step(do_nothing);
  Matrix axes;
  for (int k = 0; k < 3; ++k)
    axes.col(k) = nodes.x.vec(std::array<Index, 3>{1, 2, 4}[static_cast<std::size_t>(k)]) - nodes.x.vec(0);
  Vec c = Vec::Zero();
  for (Index n = 0; n < 8; ++n) c += nodes.x.vec(n) / 8;
  const Eigen::JacobiSVD<Matrix> parts(
      axes, Eigen::ComputeFullU | Eigen::ComputeFullV);  // it is stretched a little
  const Matrix turned = parts.matrixU() * parts.matrixV().transpose();
  EXPECT_LT((nodes.x.vec(8) - (c + turned * Vec(1.5, 0, 0.2))).norm(), 1e-8);
  EXPECT_NEAR((nodes.x.vec(8) - c).norm(), Vec(1.5, 0, 0.2).norm(), 1e-9);
}

namespace {

/// A discrete beam joins node 9, which a cube moves, to node 10, which flies.
std::string cube_and_beam() {
  SolidDeck deck = interpolated_cube({1.5, 0.5, 0.5}, all_corners,
                                     "*PART\nbeam\n2,2,2\n*SECTION_BEAM\n2,6,,,,-3\n0.2,0.04\n"
                                     "*MAT_066\n2,1.0,300.0,200.0,100.0,20.0,20.0,20.0\n0.0\n"
                                     "*ELEMENT_BEAM\n       1       2       9      10\n");
  deck.nodes.push_back({2.5, 0.8, 0.4});
  deck.cards += "*INITIAL_VELOCITY_NODE\n9,0.0,0.4,0.0\n10,0.5,1.0,-0.7\n*CONTROL_TIMESTEP\n0.0,0.2\n";
  return deck.text(10);
}

}  // namespace

TEST(Interpolation, KeepsMomentumAndAngularMomentum) {
  auto s = simulation_of(cube_and_beam());
  const Nodes& nodes = s->world().nodes;
  const Field<Real>& w = *shared_fields::angular_velocity.find(nodes.fields);
  start_ledger(*s);
  const auto sums = [&] {
    const Field<Real>& carried = *shared_fields::tied_mass.find(nodes.fields);
    const Field<Real>& inertia = *shared_fields::rotary_inertia.find(nodes.fields);
    Vec p = Vec::Zero(), L = inertia[8] * w.vec(8) + inertia[9] * w.vec(9);
    for (Index n = 0; n < 10; ++n) {
      const Real m = nodes.m[n] - carried[n];  // that of node 9 is where it is
      p += m * nodes.v.vec(n), L += m * nodes.x.vec(n).cross(nodes.v.vec(n));
    }
    return std::pair(p, L);
  };
  const auto [p, L] = sums();
  EXPECT_NEAR(p[1], 0.1 * (1.0 + 0.4), 1e-14);
  while (s->clock().t < 3) s->step(do_nothing);
  const auto [p_end, L_end] = sums();
  EXPECT_GT(nodes.v.vec(0).norm(), 0.01);
  EXPECT_LT((p_end - p).norm(), 1e-13);
  EXPECT_LT((L_end - L).norm(), 1e-12);
  EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
}

TEST(Interpolation, SameBitsOnThreadsAndAfterARestart) {
  test::expect_same_bits(cube_and_beam(), 60, 25);
}

// A load on the dependent node, off the centre, lifts and turns the cube: m v = F t, and its work is theirs.
TEST(Interpolation, LoadsOnTheNodeDoWork) {
  SolidDeck deck =
      interpolated_cube({2, 0.5, 0.7}, all_corners,
                        "*LOAD_NODE_POINT\n9,3,9,0.5\n*CONTROL_TIMESTEP\n0.0,0.2\n" + constant_curve_of_9);
  auto s = simulation_of(deck.text(10));
  start_ledger(*s);
  while (s->clock().t < 0.5) s->step(do_nothing);
  const Nodes& nodes = s->world().nodes;
  Vec p = Vec::Zero();
  Real kinetic = 0;
  for (Index n = 0; n < 8; ++n) {
    p += nodes.m[n] * nodes.v.vec(n);
    kinetic += 0.5 * nodes.m[n] * nodes.v.vec(n).squaredNorm();
  }
  EXPECT_NEAR(p[2], 0.5 * s->clock().t, 2 * 0.5 * s->clock().dt);
  EXPECT_NEAR(s->world().energy.external_work, kinetic, 0.01 * kinetic);
  EXPECT_LT(test::energy_error_of_a_step(*s), 0.01);
}

// What hangs on the node weighs once, where the node is: all fall with g, also with mass scaling of the
// start, and the ledger knows the work.
TEST(Interpolation, WhatHangsOnTheNodeFallsAsTheRest) {
  for (const char* scaling : {"", "*CONTROL_TIMESTEP\n0.0,0.2,0,0.0,-1.0E-3,0,0,1\n"}) {
    SolidDeck deck =
        interpolated_cube({0.5, 0.5, 0.5}, all_corners,
                          "*ELEMENT_MASS\n1,9,20.0\n*LOAD_BODY_Z\n9,10.0\n" + constant_curve_of_9 + scaling);
    auto s = simulation_of(deck.text(10));
    start_ledger(*s);
    while (s->clock().t < 0.2) s->step(do_nothing);
    const World& world = s->world();
    for (Index n = 0; n < 8; ++n)
      EXPECT_NEAR(world.nodes.v.vec(n)[2], -10 * (s->clock().t - 0.5 * s->clock().dt_old),
                  10 * s->clock().dt_old)
          << scaling;
    EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3) << scaling;
  }
}

// A node of 500 kg on an arm of 4.5 m turns a brick whose upper corners are held along z, by SPC or by a
// motion of speed 0: the same problem, with the same inertia along x and y.
TEST(Interpolation, InertiaStaysAlongAxesThatNothingDrives) {
  std::array<Vec, 2> moved;
  for (const bool driven : {false, true}) {
    SolidDeck deck = interpolated_cube(Vec(5, 0.5, 1), "5,123\n6,123\n7,123\n8,123\n", "");
    deck.cards =
        "*PART\ncube\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,1000.0,1.0E6,0.3\n"
        "*CONSTRAINED_INTERPOLATION\n1,9,123\n5,123\n6,123\n7,123\n8,123\n" +
        constant_curve_of_9 + "*LOAD_NODE_POINT\n9,2,9,1000.0\n*SET_NODE\n2\n5,6,7,8\n" +
        (driven ? "*DEFINE_CURVE\n2\n0,0\n10,0\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,3,0,2\n"
                : "*BOUNDARY_SPC_SET\n2,0,0,0,1\n");
    deck.particles = "*ELEMENT_MASS\n1,9,500.0\n";
    auto s = simulation_of(deck.text(1));
    start_ledger(*s);
    while (s->clock().t < 0.3) s->step(do_nothing);
    moved[driven] = s->world().nodes.x.vec(8) - Vec(5, 0.5, 1);
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.1) << driven;
  }
  EXPECT_NEAR((moved[1] - moved[0]).norm() / moved[0].norm(), 0, 0.05) << moved[0] << "\n" << moved[1];
}
