// Tetrahedra whose pressure is averaged over nodes (ELFORM 13).
#include <gtest/gtest.h>

#include <random>

#include "same_bits.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"

using namespace courant;
using test::CellShape;
using test::do_nothing;
using test::expect_no_force_inside;
using test::expect_same_bits;
using test::simulation_of;
using test::SolidDeck;
using test::start_ledger;

namespace {

std::string nodal_part(int elform, const std::string& material) {
  return fmt::format("*PART\nblock\n1,1,1\n*SECTION_SOLID\n1,{}\n*{}\n", elform, material);
}

/// Tetrahedra of a block whose corners are moved at random.
SolidDeck random_tetrahedra(std::mt19937& random, Real distortion, const std::string& cards) {
  std::uniform_real_distribution<Real> number(-distortion, distortion);
  SolidDeck deck;
  deck.cells = CellShape::tetrahedra;
  deck.block(Vec(3, 3, 3), 3, 3, 3, 1,
             [&](const Vec& x) { return Vec(x + Vec(number(random), number(random), number(random))); });
  deck.cards = cards;
  return deck;
}

/// Shift of the inner face of a tube, inner radius 1, outer 2, between two plates (plane strain), under an
/// inner pressure, over that of Lame's solution; n cells through the wall.
Real widening_of_tube(int n, int elform, Real nu, CellShape cells) {
  const Real pressure = 1e-4;
  SolidDeck deck;
  deck.cells = cells;
  const int around = 2 * n;
  deck.block(Vec(1, 1, 1), n, around, 1, 1, [&](const Vec& x) {
    const Real r = 1 + x[0], angle = 0.5 * pi * x[1];
    return Vec(r * std::cos(angle), r * std::sin(angle), x[2] / n);
  });
  deck.cards = nodal_part(elform, fmt::format("MAT_ELASTIC\n1,1.0,1.0,{}", nu));
  deck.node_set(1, [](const Vec& x) { return std::abs(x[0]) < 1e-9; });
  deck.node_set(2, [](const Vec& x) { return std::abs(x[1]) < 1e-9; });
  deck.node_set(3, [](const Vec&) { return true; });
  deck.cards +=
      "*BOUNDARY_SPC_SET\n1,0,1,0,0\n2,0,0,1,0\n3,0,0,0,1\n*DAMPING_GLOBAL\n0,1.2\n"
      "*DEFINE_CURVE\n1\n0.0,1.0\n1000.0,1.0\n*LOAD_SEGMENT\n";
  const auto node = [&](int j, int k) { return 1 + (n + 1) * (j + (around + 1) * k); };
  for (int j = 0; j < around; ++j)
    deck.cards += fmt::format("1,{},0.0,{},{},{},{}\n", pressure, node(j, 0), node(j, 1), node(j + 1, 1),
                              node(j + 1, 0));
  auto s = simulation_of(deck.text(1e9));
  const auto radius = [&] {
    Real sum = 0;
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j <= around; ++j) sum += s->world().nodes.x.vec(node(j, k) - 1).head<2>().norm();
    return sum / (2 * (around + 1));
  };
  const Real start = radius();
  while (s->clock().t < 20) s->step(do_nothing);
  const Real exact = pressure * (1 + nu) / 3 * (1 - 2 * nu + 4);
  return (radius() - start) / exact;
}

}  // namespace

// An affine motion: one stress, that of Hooke's law, and no force on nodes inside.
TEST(NodalPressure, PassesThePatchTest) {
  std::mt19937 random(5);
  const SolidDeck deck = random_tetrahedra(
      random, 0.2, nodal_part(13, "MAT_ELASTIC\n1,1.0,2.5,0.25") + "*CONTROL_BULK_VISCOSITY\n1e-9,1e-9\n");
  auto s = simulation_of(deck.text(1e9));
  Nodes& nodes = s->world().nodes;
  Matrix L;
  L << 1, 2, -1, 0.5, -2, 3, 1, 0, 2;
  L *= 1e-7;  // strains of a step are differences of volumes, to round-off
  for (Index i = 0; i < nodes.size(); ++i) nodes.v.set(i, L * nodes.x.vec(i));
  for (int k = 0; k < 2; ++k) s->step(do_nothing);
  const Matrix D = 0.5 * (L + L.transpose()),
               stress = s->clock().dt_old * (D.trace() * Matrix::Identity() + 2 * D);
  const ElementGroup& group = *s->world().groups.at(0);
  const auto& found = dynamic_cast<const Field<Real>&>(*group.fields.find("stress"));
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (Index e = 0; e < group.size(); ++e)
    for (int c = 0; c < 6; ++c)
      EXPECT_NEAR(found.data(c)[e], stress(row[c], column[c]), 1e-6 * stress.norm());
  expect_no_force_inside(group, nodes.size(), 1e-6 * stress.norm());
}

// Lame's tube of a body that hardly changes its volume: linear tetrahedra lock, those with pressures of nodes
// do not.
TEST(NodalPressure, ATubeThatKeepsItsVolumeWidensAsInTheory) {
  for (const Real nu : {0.3, 0.499})
    for (const int n : {4, 8}) {
      const Real locked = widening_of_tube(n, 10, nu, CellShape::tetrahedra),
                 free = widening_of_tube(n, 13, nu, CellShape::tetrahedra);
      EXPECT_NEAR(free, 1, 0.5 / (n * n)) << nu;
      if (nu > 0.4) EXPECT_LT(locked, 0.82) << nu;
    }
}

// Free bodies that ring at large amplitude keep their energy, momentum and spin, and so do those that lose
// elements.
TEST(NodalPressure, KeepsEnergyAndMomentum) {
  for (const char* material :
       {"MAT_ELASTIC\n1,1000.0,1.0E7,0.49", "MAT_MOONEY-RIVLIN_RUBBER\n1,1000.0,0.495,1.0E6,3.0E5",
        "MAT_PLASTIC_KINEMATIC\n1,1000.0,1.0E7,0.3,1.0E5,1.0E6,1.0\n0.0,0.0,0.15"}) {
    std::mt19937 random(7);
    const SolidDeck deck =
        random_tetrahedra(random, 0.15, nodal_part(13, material) + "*CONTROL_TIMESTEP\n0.0,0.5\n");
    auto s = simulation_of(deck.text(1e9));
    Nodes& nodes = s->world().nodes;
    std::uniform_real_distribution<Real> number(-1, 1);
    for (Index i = 0; i < nodes.size(); ++i) {
      const Vec x = nodes.x.vec(i) - Vec(1.5, 1.5, 1.5);
      nodes.v.set(i,
                  Vec(8 * x[0], -8 * x[1], 4 * x[0]) + Vec(number(random), number(random), number(random)));
    }
    const auto momentum = [&] {
      Vec p = Vec::Zero(), spin = Vec::Zero();
      for (Index i = 0; i < nodes.size(); ++i) {
        const Vec p_i = nodes.m[i] * nodes.v.vec(i);
        p += p_i, spin += nodes.x.vec(i).cross(p_i);
      }
      return std::pair(p, spin);
    };
    const auto before = momentum();
    start_ledger(*s);
    Real worst = 0;
    for (int k = 0; k < 4000; ++k)
      s->step([&](World& world, const Clock& clock, const std::string&) {
        sample_energy(world, clock);
        worst = std::max(worst, std::abs(world.energy.total() / world.energy.initial - 1));
      });
    EXPECT_GT(worst, 0);
    EXPECT_LT(worst, 0.01) << material;  // kinetic energy of the start is that of half steps
    const auto after = momentum();
    EXPECT_LT((after.first - before.first).norm(), 1e-9 * 27000) << material;
    EXPECT_LT((after.second - before.second).norm(), 0.02 * before.second.norm()) << material;
  }
}

TEST(NodalPressure, HasTheSameBitsOnThreadsAndOverARestart) {
  std::mt19937 random(9);
  SolidDeck deck = random_tetrahedra(
      random, 0.15,
      nodal_part(13, "MAT_PLASTIC_KINEMATIC\n1,1000.0,1.0E7,0.3,1.0E5,1.0E6,1.0\n0.0,0.0,0.1") +
          "*INITIAL_VELOCITY_GENERATION\n1,2,20.0\n0.1,0.2,0.3,0.0,0.0,1.0\n*RIGIDWALL_PLANAR\n0\n-0.5,0.0,0."
          "0,1.0,0.0,0.0\n");
  expect_same_bits(deck.text(1e9), 400, 150);
}
