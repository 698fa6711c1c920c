// Rigid parts that are one body, and rigid bodies of nodes, against inertia by hand and kept momenta.
#include <gtest/gtest.h>

#include <string>

#include "rigid/bodies/rigid.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace {

std::string rigid_part(int id, Real ro) {
  return fmt::format(
      "*PART\nrigid\n{0:10}         1{0:10}\n*MAT_RIGID\n{0:10}{1:10.1f}     1.0E9       0.3\n", id, ro);
}
std::string soft_part(int id) {
  return fmt::format(
      "*PART\nsoft\n{0:10}         1{0:10}\n*MAT_ELASTIC\n{0:10}    1000.0     1.0E6       0.3\n", id);
}
const std::string section_1 = "*SECTION_SOLID\n         1         1\n";

std::string start_of(const SolidDeck& deck, const std::function<Vec(const Vec&)>& velocity) {
  std::string out = "*INITIAL_VELOCITY_NODE\n";
  for (std::size_t n = 0; n < deck.nodes.size(); ++n) {
    const Vec v = velocity(deck.nodes[n]);
    out += fmt::format("{},{:.16g},{:.16g},{:.16g}\n", n + 1, v[0], v[1], v[2]);
  }
  return out;
}

/// m/12 (b^2 + c^2, ...) about the centre of a brick, and m (r^2 - r r^T) for a centre at r.
Matrix inertia_of_brick(Real m, const Vec& edges, const Vec& r) {
  const Vec e = edges.cwiseProduct(edges);
  Matrix out = (m / 12 * (e.sum() * Vec::Ones() - e)).asDiagonal();
  return out + m * (r.squaredNorm() * Matrix::Identity() - r * r.transpose());
}

/// Momentum and angular momentum about the origin, of the half step, of bodies and of nodes that no body
/// moves.
std::pair<Vec, Vec> momenta_of(const Simulation& s) {
  const Nodes& nodes = s.world().nodes;
  Vec p = Vec::Zero(), L = Vec::Zero();
  for (const RigidBody& b : s.bodies()->bodies()) p += b.m * b.v, L += b.L + b.m * b.x.cross(b.v);
  for (Index n = 0; n < nodes.size(); ++n)
    if (!nodes.follow[n])
      p += nodes.m[n] * nodes.v.vec(n), L += nodes.m[n] * nodes.x.vec(n).cross(nodes.v.vec(n));
  return {p, L};
}

const Vec slab(0.2, 0.4, 0.6), cube(0.2, 0.2, 0.2), shift(0.7, 0.1, 0.0);
constexpr Real m_slab = 48, m_cube = 16;

/// A slab of part 1 and a cube of part 2, apart from each other.
SolidDeck two_bricks() {
  SolidDeck deck;
  deck.block(slab, 2, 2, 2, 1);
  deck.block(cube, 1, 1, 1, 2, [](const Vec& x) { return Vec(x + shift); });
  deck.cards = section_1 + rigid_part(1, 1000) + rigid_part(2, 2000);
  return deck;
}

}  // namespace

TEST(MergedBodies, HaveMassCentreInertiaAndMomentaOfBoth) {
  SolidDeck deck = two_bricks();
  deck.cards += "*CONSTRAINED_RIGID_BODIES\n         1         2\n";
  deck.cards += start_of(deck, [](const Vec& x) { return x[0] > 0.5 ? Vec(0, 1, 2) : Vec(0, 0, 0); });
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  ASSERT_EQ(s->bodies()->bodies().size(), 1u);
  const RigidBody& b = s->bodies()->bodies().front();
  const Vec c1 = 0.5 * slab, c2 = shift + 0.5 * cube, c = (m_slab * c1 + m_cube * c2) / (m_slab + m_cube);
  const Vec v2(0, 1, 2);
  EXPECT_EQ(b.part, 1);
  EXPECT_EQ(b.nodes.size(), 27u + 8u);
  EXPECT_NEAR(b.m, 64, 1e-11);
  EXPECT_NEAR((b.x - c).norm(), 0, 1e-12);
  const Matrix J = inertia_of_brick(m_slab, slab, c1 - c) + inertia_of_brick(m_cube, cube, c2 - c);
  EXPECT_NEAR((b.J0 - J).norm(), 0, 1e-11 * J.norm());
  EXPECT_NEAR((b.v - m_cube / 64 * v2).norm(), 0, 1e-12);
  // reduced mass times arm times relative velocity
  const Vec L = m_slab * m_cube / 64 * (c2 - c1).cross(v2);
  EXPECT_NEAR((b.L - L).norm(), 0, 1e-10 * L.norm());
  const Real energy = b.kinetic_energy();
  const Nodes& nodes = s->world().nodes;
  const Real apart = (nodes.x.vec(0) - nodes.x.vec(34)).norm();
  while (s->clock().t < 1) s->step(do_nothing);
  EXPECT_GT(b.q.angularDistance(Eigen::Quaterniond::Identity()), 0.5);
  EXPECT_NEAR((b.L - L).norm(), 0, 1e-10 * L.norm());
  EXPECT_NEAR(b.kinetic_energy(), energy, 1e-4 * energy);
  EXPECT_NEAR((nodes.x.vec(0) - nodes.x.vec(34)).norm(), apart, 1e-12);
}

// A chain of three, of which the last two share the nodes of a face.
TEST(MergedBodies, FormChainsAndMayShareNodes) {
  SolidDeck deck = two_bricks();
  const auto first = static_cast<int>(deck.nodes.size()) - 7;  // of the cube; its face at large x
  for (const Vec& x : {Vec(1.1, 0.1, 0), Vec(1.1, 0.3, 0), Vec(1.1, 0.1, 0.2), Vec(1.1, 0.3, 0.2)})
    deck.nodes.push_back(x);
  const int n = first + 8;
  deck.elements += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}\n", 100, 3, first + 1, n, n + 1,
                               first + 3, first + 5, n + 2, n + 3, first + 7);
  deck.cards +=
      rigid_part(3, 500) + "*CONSTRAINED_RIGID_BODIES\n         2         3\n         1         2\n";
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  ASSERT_EQ(s->bodies()->bodies().size(), 1u);
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_EQ(b.parts, (std::vector<Index>{0, 1, 2}));
  const Vec c1 = 0.5 * slab, c2 = shift + 0.5 * cube, c3(1.0, 0.2, 0.1);
  const Real m3 = 500 * 0.2 * 0.2 * 0.2, m = 64 + m3;
  const Vec c = (m_slab * c1 + m_cube * c2 + m3 * c3) / m;
  EXPECT_NEAR(b.m, m, 1e-11);
  EXPECT_NEAR((b.x - c).norm(), 0, 1e-12);
  const Matrix J = inertia_of_brick(m_slab, slab, c1 - c) + inertia_of_brick(m_cube, cube, c2 - c) +
                   inertia_of_brick(m3, Vec(0.2, 0.2, 0.2), c3 - c);
  EXPECT_NEAR((b.J0 - J).norm(), 0, 1e-11 * J.norm());
}

// With *PART_INERTIA of the lead, IFLAG states whether the other part is in it.
TEST(MergedBodies, GivenInertiaStandsForAllUnlessIflagAdds) {
  for (const int iflag : {0, 1}) {
    SolidDeck deck;
    deck.block(slab, 2, 2, 2, 1);
    deck.block(cube, 1, 1, 1, 2, [](const Vec& x) { return Vec(x + shift); });
    deck.cards =
        section_1 + rigid_part(2, 2000) +
        "*PART_INERTIA\nlead\n         1         1         1\n       0.1       0.2       0.3      10.0\n"
        "       2.0       0.0       0.0       3.0       0.0       4.0\n       0.0\n*MAT_RIGID\n"
        "         1    1000.0     1.0E9       0.3\n";
    deck.cards += fmt::format("*CONSTRAINED_RIGID_BODIES\n         1         2{:10}\n", iflag);
    const auto s = simulation_of(deck.text(1));
    ASSERT_NE(s, nullptr);
    const RigidBody& b = s->bodies()->bodies().front();
    const Vec c1(0.1, 0.2, 0.3), c2 = shift + 0.5 * cube;
    const Real more = iflag * m_cube;
    const Vec c = (10 * c1 + more * c2) / (10 + more), r = c1 - c;
    EXPECT_NEAR(b.m, 10 + more, 1e-12);
    EXPECT_NEAR((b.x - c).norm(), 0, 1e-12);
    const Matrix J = Matrix(Vec(2, 3, 4).asDiagonal()) +
                     Matrix(10 * (r.squaredNorm() * Matrix::Identity() - r * r.transpose())) +
                     inertia_of_brick(more, cube, c2 - c);
    EXPECT_NEAR((b.J0 - J).norm(), 0, 1e-11);
    EXPECT_EQ(b.nodes.size(), 35u);
  }
}

// LRB of a part that is switched to rigid says the same.
TEST(MergedBodies, SwitchedPartsJoinTheirLead) {
  SolidDeck deck;
  deck.block(slab, 2, 2, 2, 1);
  deck.block(cube, 1, 1, 1, 2, [](const Vec& x) { return Vec(x + shift); });
  deck.cards =
      section_1 + rigid_part(1, 1000) + soft_part(2) + "*DEFORMABLE_TO_RIGID\n         2         1\n";
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  ASSERT_EQ(s->bodies()->bodies().size(), 1u);
  EXPECT_NEAR(s->bodies()->bodies().front().m, 56, 1e-11);
}

// Without LRB a switched part goes with the rigid part that it shares nodes with; of two switched ones that
// with the smaller id leads, whatever their order in the deck.
TEST(MergedBodies, SwitchedPartsJoinWhoSharesTheirNodes) {
  for (const bool both : {false, true})
    for (const int lead : {1, 2}) {
      SolidDeck deck;
      const int made = 3 - lead;
      deck.block(Vec(1, 1, 1), 1, 1, 1, lead);
      deck.nodes.insert(deck.nodes.end(), {Vec(2, 0, 0), Vec(2, 1, 0), Vec(2, 0, 1), Vec(2, 1, 1)});
      deck.elements +=
          fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}\n", 2, made, 2, 9, 10, 4, 6, 11, 12, 8);
      deck.cards = section_1 + (both ? soft_part(lead) : rigid_part(lead, 1000)) + soft_part(made) +
                   fmt::format("*DEFORMABLE_TO_RIGID\n{:10}\n*DEFORMABLE_TO_RIGID\n{:10}\n", made, lead);
      const auto s = simulation_of(deck.text(1));
      ASSERT_NE(s, nullptr);
      ASSERT_EQ(s->bodies()->bodies().size(), 1u);
      const RigidBody& b = s->bodies()->bodies().front();
      EXPECT_EQ(b.part, both ? 1 : lead);
      EXPECT_NEAR(b.m, 2000, 1e-9);
      EXPECT_NEAR((b.x - Vec(1, 0.5, 0.5)).norm(), 0, 1e-12);
      EXPECT_NEAR((b.J0 - inertia_of_brick(2000, Vec(2, 1, 1), Vec::Zero())).norm(), 0, 1e-9);
    }
}

// All nodes of a soft block: its lumped masses 1/4, 1/2, 1/4 along each axis give <x^2> = a^2/8.
TEST(NodalBodies, SpinFreelyWithTheInertiaOfTheirNodes) {
  SolidDeck deck;
  deck.block(slab, 2, 2, 2, 1);
  deck.cards =
      section_1 + soft_part(1) + "*CONSTRAINED_NODAL_RIGID_BODY_TITLE\nall\n         9         0         1\n";
  deck.node_set(1, [](const Vec&) { return true; });
  const Vec c = 0.5 * slab, omega(0.1, 2, 0.2), v(0.3, 0, 0);  // about the middle axis: it tumbles
  deck.cards += start_of(deck, [&](const Vec& x) { return Vec(v + omega.cross(x - c)); });
  const auto s = simulation_of(deck.text(20));
  ASSERT_NE(s, nullptr);
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_EQ(b.part, 9);
  EXPECT_NEAR(b.m, m_slab, 1e-11);
  const Vec e = slab.cwiseProduct(slab);
  const Matrix J = (m_slab / 8 * (e.sum() * Vec::Ones() - e)).asDiagonal();
  EXPECT_NEAR((b.J0 - J).norm(), 0, 1e-11 * J.norm());
  EXPECT_NEAR((b.omega - omega).norm() + (b.v - v).norm(), 0, 1e-11);
  const Vec L = b.L;
  const Real energy = b.kinetic_energy();
  Real turn = 0;
  while (s->clock().t < 20) {
    s->step(do_nothing);
    turn = std::max(turn, (b.omega - omega).norm());
  }
  EXPECT_GT(turn, 1);
  EXPECT_NEAR((b.L - L).norm(), 0, 1e-9 * L.norm());
  EXPECT_NEAR(b.kinetic_energy(), energy, 1e-4 * energy);
  // the block inside of it feels nothing of it
  sample_energy(s->world(), s->clock());
  EXPECT_LT(s->world().energy.internal, 1e-6 * energy);
}

// A face of a soft block and one of another as one body: all of it keeps its momenta and its energy.
TEST(NodalBodies, JoinSoftBlocksAndKeepMomentaAndEnergy) {
  SolidDeck deck;
  deck.block(cube, 2, 2, 2, 1);
  deck.block(cube, 2, 2, 2, 1, [](const Vec& x) { return Vec(x + Vec(0.3, 0.05, 0)); });
  deck.cards = section_1 + soft_part(1) +
               "*CONSTRAINED_NODAL_RIGID_BODY\n         9         0         1\n"
               "*CONTROL_HOURGLASS\n         4      0.05\n*CONTROL_TIMESTEP\n       0.0       0.3\n";
  deck.node_set(1, [](const Vec& x) { return x[0] > 0.199 && x[0] < 0.301; });
  deck.cards += start_of(deck, [](const Vec& x) { return Vec(0, x[0] > 0.25 ? 1 : 0, 2 * x[0] * x[0]); });
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_EQ(b.nodes.size(), 18u);
  EXPECT_NEAR(b.m, 2 * 8.0 / 4, 1e-12);
  test::start_ledger(*s);
  s->step(do_nothing);
  const auto [p, L] = momenta_of(*s);
  Real worst = 0;
  Real deformed = 0;
  for (int n = 0; n < 1500; ++n) {
    s->step(do_nothing);
    sample_energy(s->world(), s->clock());
    deformed = std::max(deformed, s->world().energy.internal);
    const auto [p_now, L_now] = momenta_of(*s);
    EXPECT_NEAR((p_now - p).norm(), 0, 1e-10 * p.norm());
    worst = std::max(worst, (L_now - L).norm() / L.norm());
  }
  // x of the nodes and v of half a step before are not parallel; what they differ by swings and does not grow
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
  EXPECT_GT(deformed, 0.01 * s->world().energy.kinetic);
}

TEST(NodalBodies, ConstraintsAndGivenInertiaAreTheirs) {
  SolidDeck deck;
  deck.block(slab, 2, 2, 2, 1);
  deck.cards = section_1 + soft_part(1) +
               "*CONSTRAINED_NODAL_RIGID_BODY_SPC_INERTIA\n         9         0         1\n"
               "       1.0         7         4\n       0.1       0.2       0.3       5.0\n"
               "       1.0       0.0       0.0       1.5       0.0       2.0\n"
               "       1.0       1.0       1.0       1.0       1.0       1.0\n";
  deck.node_set(1, [](const Vec&) { return true; });
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_EQ(b.m, 5);
  EXPECT_EQ(b.J0(1, 1), 1.5);
  EXPECT_EQ(b.held, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(b.no_turn, (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(b.v, Vec(0, 0, 0));
  EXPECT_NEAR((b.omega - Vec(0, 0, 1)).norm(), 0, 1e-14);
}

// Two nodes of blocks on a line have no inertia about it: they keep their distance, and all keeps its
// momentum.
TEST(NodalBodies, SpotweldsKeepTheirNodesApart) {
  SolidDeck deck;
  deck.block(cube, 2, 2, 2, 1);
  deck.block(cube, 2, 2, 2, 1, [](const Vec& x) { return Vec(x + Vec(0.25, 0, 0)); });
  deck.cards = section_1 + soft_part(1) + "*CONSTRAINED_SPOTWELD\n        15        40\n";
  deck.cards += start_of(deck, [](const Vec& x) { return x[0] > 0.22 ? Vec(0.1, 0.3, 0) : Vec(0, 0, 0); });
  const auto s = simulation_of(deck.text(1));
  ASSERT_NE(s, nullptr);
  const Nodes& nodes = s->world().nodes;
  EXPECT_NEAR((nodes.x.vec(14) - Vec(0.2, 0.1, 0.1)).norm() + (nodes.x.vec(39) - Vec(0.25, 0.1, 0.1)).norm(),
              0, 1e-12);
  const Vec p = momenta_of(*s).first;
  EXPECT_NEAR((p - 8 * Vec(0.1, 0.3, 0)).norm(), 0, 1e-12);
  test::start_ledger(*s);
  for (int n = 0; n < 1500; ++n) {
    s->step(do_nothing);
    ASSERT_NEAR((nodes.x.vec(14) - nodes.x.vec(39)).norm(), 0.05, 1e-12);
  }
  EXPECT_GT((nodes.x.vec(39) - nodes.x.vec(14)).normalized()[1], 0.05);  // it has turned
  EXPECT_NEAR((momenta_of(*s).first - p).norm(), 0, 1e-10);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

// Nodes of shells have rotary inertia besides. Mass of a plate of one shell is at its corners.
TEST(NodalBodies, OfShellsHaveTheirRotaryInertia) {
  SolidDeck deck;
  deck.nodes = {Vec(0, 0, 0), Vec(1, 0, 0), Vec(2, 0, 0), Vec(0, 1, 0), Vec(1, 1, 0), Vec(2, 1, 0)};
  deck.cards =
      "*PART\nplate\n         1         2         1\n*MAT_ELASTIC\n         1    1000.0     1.0E6       0.3\n"
      "*SECTION_SHELL\n         2         2\n       0.1\n*ELEMENT_SHELL\n       1       1       1       2    "
      "   5 "
      "      4\n       2       1       2       3       6       5\n"
      "*CONSTRAINED_NODAL_RIGID_BODY\n         9         0         1\n";
  deck.node_set(1, [](const Vec& x) { return x[0] > 0.5 && x[0] < 1.5; });
  std::string text = deck.text(1);
  text.erase(text.find("*ELEMENT_SOLID"), std::string("*ELEMENT_SOLID\n").size());
  const auto s = simulation_of(text);
  ASSERT_NE(s, nullptr);
  const RigidBody& b = s->bodies()->bodies().front();
  const auto& rotary = *shared_fields::rotary_inertia.find(s->world().nodes.fields);
  EXPECT_NEAR(b.m, 100, 1e-11);  // half of each shell
  EXPECT_GT(rotary[1], 0);
  const Real own = rotary[1] + rotary[4];
  const Matrix J = Matrix(Vec(100 * 0.25, 0, 100 * 0.25).asDiagonal()) + own * Matrix::Identity();
  EXPECT_NEAR((b.J0 - J).norm(), 0, 1e-11);
}

namespace {

/// Of all nodes of a slab, body 9; its mass is 8 times 1/8 of each of 8 cells: 48, and centre in the middle.
SolidDeck slab_as_body(const std::string& cards) {
  SolidDeck deck;
  deck.block(slab, 2, 2, 2, 1);
  deck.cards =
      section_1 + soft_part(1) + "*CONSTRAINED_NODAL_RIGID_BODY\n         9         0         1\n" + cards;
  deck.node_set(1, [](const Vec&) { return true; });
  return deck;
}
const std::string slab_ramp = "*DEFINE_CURVE\n         3\n0.0,0.0\n10.0,10.0\n";

}  // namespace

// x = F t^3/(6 m) under a force F t, and an angle of M t^3/(6 J).
TEST(NodalBodies, FollowForcesAndMoments) {
  SolidDeck deck = slab_as_body(
      "*LOAD_RIGID_BODY\n         9         2         3      12.0\n"
      "         9         5         3       0.5\n" +
      slab_ramp);
  auto s = simulation_of(deck.text(1));
  while (s->clock().t < 1 - 1e-12) s->step(do_nothing);
  const RigidBody& b = s->bodies()->bodies().front();
  const Real t = s->clock().t;
  EXPECT_NEAR(b.x[1] - 0.2, 12 * std::pow(t, 3) / (6 * m_slab), 1e-3 * 12 / (6 * m_slab));
  const Real J = b.J0(0, 0), angle = Eigen::AngleAxisd(b.q).angle();
  EXPECT_NEAR(angle, 0.5 * std::pow(t, 3) / (6 * J), 1e-3 * 0.5 / (6 * J));
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

// Along y as the curve tells, exactly; free along z, where it keeps what it starts with.
TEST(NodalBodies, FollowPrescribedMotionsAndStarts) {
  SolidDeck deck = slab_as_body(
      "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n         9         2         0         3       2.0\n"
      "*INITIAL_VELOCITY_RIGID_BODY\n         9       0.0       0.0       3.0       0.0       0.0       "
      "1.5\n" +
      slab_ramp);
  auto s = simulation_of(deck.text(1));
  const RigidBody& b = s->bodies()->bodies().front();
  EXPECT_NEAR((b.omega - Vec(0, 0, 1.5)).norm(), 0, 1e-14);
  EXPECT_NEAR(s->world().nodes.v.vec(0)[0], 1.5 * 0.2, 1e-14);  // omega x r
  test::start_ledger(*s);
  while (s->clock().t < 1 - 1e-12) s->step(do_nothing);
  const Real t = s->clock().t;
  EXPECT_NEAR(b.x[1] - 0.2, t * t, 1e-12);
  EXPECT_NEAR(b.x[2] - 0.3, 3 * t, 1e-12);
  EXPECT_NEAR(b.omega[2], 1.5, 1e-9);
  EXPECT_NEAR(b.drive_work, 0.5 * m_slab * 4, 0.02 * m_slab * 2);
  EXPECT_LT(test::energy_error_of_a_step(*s), 1e-3);
}

// A face that is made a hundredth as heavy lets the elements swing faster.
TEST(NodalBodies, ThatAreLighterThanTheirElementsShortenTheStep) {
  for (const Real of_elements : {1.0, 0.1, 0.01}) {
    SolidDeck deck;
    deck.block(cube, 2, 2, 2, 1);
    deck.block(cube, 2, 2, 2, 1, [](const Vec& x) { return Vec(x + Vec(0.3, 0, 0)); });
    const Real m = 4 * of_elements, J = 0.1 * of_elements;
    deck.cards = section_1 + soft_part(1) +
                 fmt::format(
                     "*CONSTRAINED_NODAL_RIGID_BODY_INERTIA\n         9         0         1\n"
                     "      0.25       0.1       0.1{0:10.3g}\n"
                     "{1:10.3g}       0.0       0.0{1:10.3g}       0.0{1:10.3g}\n\n",
                     m, J);
    deck.node_set(1, [](const Vec& x) { return x[0] > 0.199 && x[0] < 0.301; });
    deck.cards += start_of(deck, [](const Vec& x) { return Vec(0.1 * x[1], 0, 0.2 * std::sin(8 * x[0])); });
    auto s = simulation_of(deck.text(10));
    test::start_ledger(*s);
    const Real before = s->world().energy.kinetic;
    for (int k = 0; k < 1000; ++k) s->step(do_nothing);
    sample_energy(s->world(), s->clock());
    EXPECT_LT(s->world().energy.kinetic + s->world().energy.internal, 1.02 * before) << of_elements;
  }
}
