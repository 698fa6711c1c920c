// *INITIAL_STRESS_SECTION: bars and bolts that a section tightens, against closed solutions.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "same_bits.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::simulation_of;
using test::start_ledger;

namespace {

/// A bar of 1 x 0.1 x 0.1 of ten solids, E 4e4, held at both ends; a plane across its fifth solid gives it
/// 100 from 0.1 to `until`.
std::string bar(int elform, const std::string& section, Real until, const std::string& more = "") {
  test::SolidDeck deck;
  deck.block({1, 0.1, 0.1}, 10, 1, 1, 1);
  deck.cards +=
      fmt::format("*PART\nbar\n         1         1         1\n*SECTION_SOLID\n         1{:10}\n", elform);
  deck.cards +=
      "*MAT_ELASTIC\n         1       1.0    4.0E+4       0.0\n*SET_PART_LIST\n         4\n         1\n";
  deck.cards +=
      "*DATABASE_CROSS_SECTION_PLANE_ID\n         7middle\n         0      0.45      0.05      0.05       "
      "1.0      0.05      0.05\n\n";
  deck.cards += section;
  deck.cards += fmt::format("*DEFINE_CURVE\n5\n0.0,0.0\n0.1,100.0\n{},100.0\n", until);
  deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9 || x[0] > 1 - 1e-9; });
  deck.cards += "*BOUNDARY_SPC_SET\n         1         0         1         1         1\n" + more;
  return deck.text(10);
}
const std::string damped = "*DAMPING_GLOBAL\n         0     600.0\n",
                  by_plane = "*INITIAL_STRESS_SECTION\n         1         7         5         4\n";

/// Of solids of part 1 at their first point.
Real stress(const Simulation& s, Index e, int component) {
  const FieldSet& set = s.world().groups.front()->fields;
  const FieldBase* const of_points = set.find("stress_of_points");
  return dynamic_cast<const Field<Real>&>(of_points ? *of_points : *set.find("stress")).data(component)[e];
}

}  // namespace

// While the curve lasts, the section shortens until the bar has its stress; then all is elastic, and it
// stays.
TEST(SectionStress, TightensABarBetweenWalls) {
  for (const int elform : {1, 2}) {
    auto s = simulation_of(bar(elform, by_plane, 0.3, damped));
    start_ledger(*s);
    for (const Real t : {0.29, 0.6}) {
      while (s->clock().t < t) s->step(test::do_nothing);
      const auto x = [&](Index n) { return s->world().nodes.x.data(0)[n]; };
      EXPECT_NEAR(x(4) - 0.4, 4 * 0.1 * 100 / 4e4, 1e-5) << elform << " " << t;
      EXPECT_NEAR(x(5) - 0.5, -5 * 0.1 * 100 / 4e4, 1e-5) << elform << " " << t;
      for (Index e = 0; e < 10; ++e)
        EXPECT_NEAR(stress(*s, e, 0), 100, 0.5) << elform << " " << t << " " << e;
    }
  }
}

// The end of the bar is driven sideways: no shear on the section until the curve ends, or with IZSHEAR 1 that
// of the bar.
TEST(SectionStress, HasShearAsAsked) {
  const std::string drive =
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n         2         2         0         6       "
      "1.0\n*DEFINE_CURVE\n6\n0.0,0.01\n9.0,0.01\n"
      "*SET_NODE_LIST\n         2\n         6        17        28        39\n" +
      damped;
  for (const int shear : {0, 1}) {
    const std::string card = fmt::format(
        "*INITIAL_STRESS_SECTION\n         1         7         5         4         0{:10}\n", shear);
    auto s = simulation_of(bar(1, card, 0.3, drive));
    while (s->clock().t < 0.29) s->step(test::do_nothing);
    EXPECT_NEAR(stress(*s, 4, 0), 100, 1) << shear;
    if (shear == 0)
      EXPECT_NEAR(stress(*s, 4, 3), 0, 0.1);
    else
      EXPECT_GT(std::abs(stress(*s, 4, 3)), 1);
  }
}

// A section by sets with its direction by VID, and two bars in one deck order: the same stress.
TEST(SectionStress, TakesSetsAndVectors) {
  const std::string by_set =
      "*DATABASE_CROSS_SECTION_SET_ID\n         9set\n         3         3\n*SET_NODE_LIST\n         3\n     "
      "    5        16        27        38\n"
      "*SET_SOLID\n         3\n         5\n*DEFINE_VECTOR\n         2       0.0       0.0       0.0       "
      "2.0\n"
      "*INITIAL_STRESS_SECTION\n         1         9         5         4         2\n";
  auto s = simulation_of(bar(1, by_set, 0.3, damped));
  while (s->clock().t < 0.29) s->step(test::do_nothing);
  for (Index e = 0; e < 10; ++e) EXPECT_NEAR(stress(*s, e, 0), 100, 0.5) << e;
}

// Energy: what the section takes from its own solids, the others have. No damping, so that the bar vibrates.
TEST(SectionStress, ClosesTheBalance) {
  for (const int elform : {1, 2}) {
    auto s = simulation_of(bar(elform, by_plane, 0.15));
    start_ledger(*s);
    Real most = 0;
    while (s->clock().t < 0.3)
      s->step([&](World& world, const Clock& clock, const std::string&) {
        sample_energy(world, clock);
        const EnergyLedger& e = world.energy;
        most =
            std::max(most, std::abs(e.kinetic + e.half_step + e.internal + e.bulk_viscosity + e.hourglass));
      });
    EXPECT_LT(most, 0.01 * 0.5 * 100 * 100 / 4e4 * 0.01) << elform;  // of the elastic energy of the bar
  }
}

TEST(SectionStress, HasTheSameBitsOnAnyNumberOfThreadsAndAfterARestart) {
  for (const int elform : {1, 2}) test::expect_same_bits(bar(elform, by_plane, 0.3), 40, 17);
}
