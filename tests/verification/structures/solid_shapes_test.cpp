// Pentahedra and tetrahedra beside hexahedra, small free blocks at TSSFAC 0.9, and rigid bodies of solids.
#include <gtest/gtest.h>

#include <random>

#include "parallel/parallel.hpp"
#include "rigid/bodies/rigid.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::CellShape;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace {

std::string part_of(const char* material, int elform = 1) {
  return fmt::format("*PART\nblock\n         1         1         1\n*SECTION_SOLID\n         1{:10}\n*{}\n",
                     elform, material);
}

Real energy_of(Simulation& s) {
  sample_energy(s.world(), s.clock());
  const EnergyLedger& e = s.world().energy;
  return e.kinetic + e.internal + e.hourglass + e.bulk_viscosity;
}

}  // namespace

// A bar that rings along itself: omega = pi sqrt(E/ro)/L of a free bar, less 0.1 % as its sides move (nu = 0:
// none). With n elements along it the lumped frequency is (2 n/pi) sin(pi/(2 n)) of that.
TEST(SolidShapes, ABarRingsAtItsFrequency) {
  for (const CellShape shape :
       {CellShape::hexahedron, CellShape::wedges, CellShape::wedges_from_quads, CellShape::tetrahedra}) {
    SolidDeck deck;
    deck.cells = shape;
    deck.block(Vec(1, 0.1, 0.1), 20, 2, 2, 1);
    deck.cards = part_of("MAT_ELASTIC\n         1    1000.0     1.0E9       0.0") +
                 "*CONTROL_BULK_VISCOSITY\n    1.0E-9    1.0E-9\n";
    auto s = simulation_of(deck.text(1));
    Nodes& nodes = s->world().nodes;
    for (Index i = 0; i < nodes.size(); ++i) nodes.v.data(0)[i] = 1e-3 * std::cos(pi * nodes.x.data(0)[i]);
    const Real half_period = std::sqrt(1000 / 1e9);
    Real before = 1, t_before = 0, turned = 0;
    while (turned == 0 && s->clock().t < 2 * half_period) {
      s->step(do_nothing);
      const Real v = nodes.v.data(0)[0], t = s->clock().t - 0.5 * s->clock().dt;
      if (v < 0) turned = t_before + before / (before - v) * (t - t_before);
      before = v, t_before = t;
    }
    // those that are no cubes are somewhat stiffer: their strains are coupled
    EXPECT_NEAR(turned / (0.5 * half_period), 1, shape == CellShape::hexahedron ? 0.005 : 0.01) << int(shape);
  }
}

// A single cube is stable to 0.734 of V/A_max over c at nu 0.3, a tetrahedron to less of its height.
TEST(SolidShapes, SmallFreeBlocksAreStableAtTssfac09) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> number(-1, 1);
  for (const CellShape shape : {CellShape::hexahedron, CellShape::wedges, CellShape::tetrahedra})
    for (const char* nu : {"0.0", "0.3", "0.495"})
      for (const auto& [nx, ny, nz] : {std::array{1, 1, 1}, {1, 1, 4}, {3, 3, 3}})
        for (const Real flat : {1.0, 0.1}) {
          SolidDeck deck;
          deck.cells = shape;
          deck.block(Vec(nx, ny, flat * nz), nx, ny, nz, 1, [&](const Vec& x) {
            return Vec(x[0] + 0.3 * x[1] + 0.1 * number(random), x[1] + 0.1 * number(random),
                       x[2] + 0.1 * flat * number(random));
          });
          deck.cards = part_of(fmt::format("MAT_ELASTIC\n         1       1.0       1.0{:>10}", nu).c_str()) +
                       "*CONTROL_BULK_VISCOSITY\n    1.0E-9    1.0E-9\n*HOURGLASS\n         1         3    "
                       "1.0E-9\n";
          auto s = simulation_of(deck.text(1e9));
          Nodes& nodes = s->world().nodes;
          for (Index i = 0; i < nodes.size(); ++i)
            nodes.v.set(i, 1e-8 * Vec(number(random), number(random), number(random)));
          // the energy of half steps swings by 1/(1 - (omega dt/2)^2)
          Real early = 0, late = 0;
          for (int k = 0; k < 3000; ++k) {
            s->step(do_nothing);
            if (k < 1000) early = std::max(early, energy_of(*s));
            if (k >= 2000) late = std::max(late, energy_of(*s));
          }
          EXPECT_LT(late, 1.5 * early) << int(shape) << " nu " << nu << " " << nx << ny << nz << " " << flat;
        }
}

// Without a card of hourglass control: nothing of it may act on a rigid rotation, whatever the shape.
TEST(SolidShapes, FreeBlocksKeepTheirSpin) {
  for (const CellShape shape :
       {CellShape::hexahedron, CellShape::wedges, CellShape::wedges_from_quads, CellShape::tetrahedra}) {
    SolidDeck deck;
    deck.cells = shape;
    deck.block(Vec(1, 1, 1), 2, 2, 2, 1);
    deck.cards = part_of("MAT_ELASTIC\n         1    1000.0     1.0E8       0.3");
    auto s = simulation_of(deck.text(1));
    Nodes& nodes = s->world().nodes;
    for (Index i = 0; i < nodes.size(); ++i)
      nodes.v.set(i, Vec(0, 0, 2).cross(nodes.x.vec(i) - Vec(0.5, 0.5, 0.5)));
    const auto spin = [&] {
      return sum(nodes.size(), [&](Index i) { return nodes.m[i] * nodes.x.vec(i).cross(nodes.v.vec(i))[2]; });
    };
    const Real before = spin();
    while (s->clock().t < 0.5) s->step(do_nothing);
    EXPECT_NEAR(spin() / before, 1, 2e-3) << int(shape);
    sample_energy(s->world(), s->clock());
    EXPECT_LT(s->world().energy.hourglass, 1e-6 * s->world().energy.kinetic) << int(shape);
  }
}

TEST(RigidSolids, TurnAndFallAsTheyShould) {
  for (const CellShape shape : {CellShape::hexahedron, CellShape::wedges, CellShape::tetrahedra}) {
    SolidDeck deck;
    deck.cells = shape;
    deck.block(Vec(0.2, 0.4, 0.6), 2, 3, 4, 1);
    deck.cards =
        part_of("MAT_RIGID\n         1    1000.0     1.0E9       0.3") +
        "*LOAD_BODY_Z\n         1      10.0\n*DEFINE_CURVE\n         1\n                 0.0           "
        "      1.0\n                 1.0                 1.0\n"
        "*INITIAL_VELOCITY_GENERATION\n         1         2       3.0\n       0.1       0.2       0.3     "
        "  0.0       0.0       1.0\n";
    auto s = simulation_of(deck.text(0.5));
    ASSERT_TRUE(s && s->bodies());
    const RigidBody& b = s->bodies()->bodies().front();
    EXPECT_NEAR(b.m, 48, 1e-11);
    EXPECT_NEAR((b.x - Vec(0.1, 0.2, 0.3)).norm(), 0, 1e-14);
    EXPECT_NEAR((b.J0.diagonal() - 4 * Vec(0.16 + 0.36, 0.04 + 0.36, 0.04 + 0.16)).norm(), 0, 1e-12);
    EXPECT_NEAR((b.omega - Vec(0, 0, 3)).norm(), 0, 1e-12);
    const Vec corner = s->world().nodes.x.vec(0) - b.x;
    while (s->clock().t < 0.1) s->step(do_nothing);
    const Real t = s->clock().t;
    EXPECT_NEAR(b.x[2], 0.3 - 5 * t * t, 1e-12);
    const Matrix turn = Eigen::AngleAxisd(3 * t, Vec::UnitZ()).toRotationMatrix();
    EXPECT_NEAR((s->world().nodes.x.vec(0) - b.x - turn * corner).norm(), 0, 1e-12);
    EXPECT_EQ(s->world().segments.size(),
              2 * (2 * 3 + 3 * 4 + 2 * 4) * (shape == CellShape::tetrahedra ? 2 : 1) +
                  (shape == CellShape::wedges ? 2 * 2 * 3 : 0));
  }
}
