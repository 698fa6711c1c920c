// What parts, sections and contacts tell adds up.
#include <gtest/gtest.h>

#include <cmath>

#include "beam_decks.hpp"
#include "elements/histories/cross_section.hpp"
#include "elements/histories/secforc.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/shared_fields.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;

namespace part_sums_test {
namespace {

/// Of all nodes, with their rotations, at the velocities of now.
Real kinetic_of_nodes(const World& world) {
  const auto* spin = shared_fields::angular_velocity.find(world.nodes.fields);
  const auto* inertia = shared_fields::rotary_inertia.find(world.nodes.fields);
  Real sum = 0;
  for (Index n = 0; n < world.nodes.size(); ++n) {
    sum += 0.5 * world.nodes.m[n] * world.nodes.v.vec(n).squaredNorm();
    if (spin) sum += 0.5 * (*inertia)[n] * spin->vec(n).squaredNorm();
  }
  return sum;
}
void expect_parts_to_have_all(Simulation& s) {
  Field<Real>* spin = shared_fields::angular_velocity.find(s.world().nodes.fields);
  for (Index n = 0; n < s.world().nodes.size(); ++n) {
    s.world().nodes.v.set(n, Vec(std::sin(n), 0.1 * n, -1));
    if (spin) spin->set(n, Vec(90, 70 * std::cos(n), -50));
  }
  s.step([&](World& world, const Clock&, const std::string& who) {
    const Sample sample = s.sample(who);
    Real kinetic = 0, mass = 0, of_nodes = 0;
    Vec momentum = Vec::Zero(), all = Vec::Zero();
    for (const PartSample& part : sample.parts)
      kinetic += part.kinetic, momentum += part.momentum, mass += part.mass;
    for (Index n = 0; n < world.nodes.size(); ++n)
      all += world.nodes.m[n] * world.nodes.v.vec(n), of_nodes += world.nodes.m[n];
    EXPECT_NEAR(mass / of_nodes, 1, 1e-12);
    EXPECT_NEAR(kinetic / kinetic_of_nodes(world), 1, 1e-12);
    EXPECT_NEAR((momentum - all).norm(), 0, 1e-12 * all.norm());
  });
}

}  // namespace

// Of each kind of element alone and of two parts that share nodes.
TEST(PartSums, KineticEnergyOfPartsIsThatOfNodesWithTheirRotations) {
  for (const bool triangles : {false, true}) {
    ShellDeck deck;
    deck.plate(1, 0.8, 3, 2, 1, nullptr, triangles);
    deck.part(1, 0.1, "*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n");
    expect_parts_to_have_all(*simulation_of(deck.text(1)));
  }
  for (const test::CellShape cells : {test::CellShape::hexahedron, test::CellShape::tetrahedra}) {
    test::SolidDeck deck;
    deck.cells = cells;
    deck.block(Vec(1, 0.8, 0.6), 2, 2, 1, 1);
    deck.cards = "*SECTION_SOLID\n1,1\n*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E9,0.3\n";
    expect_parts_to_have_all(*simulation_of(deck.text(1)));
  }
  for (const bool discrete : {false, true}) {
    test::beams::BeamDeck deck;
    deck.part(1, test::beams::square_1, test::beams::steel_of_beams);
    deck.line(3, 0.3, [](int) { return ""; });
    if (discrete)
      deck.cards =
          "*PART\nbeams\n1,1,1\n*SECTION_BEAM\n1,6,,,,0\n1.0,0.4\n"
          "*MAT_LINEAR_ELASTIC_DISCRETE_BEAM\n1,2.0,100.0,200.0,300.0,20.0,40.0,60.0\n0.0\n";
    expect_parts_to_have_all(*simulation_of(deck.text(1)));
  }
}

// Of four shells side by side under a plane one goes: three quarters of the area are left.
TEST(PartSums, DeletedShellsHaveNoSection) {
  ShellDeck deck;
  deck.plate(0.1, 0.4, 1, 4, 1);
  deck.part(1, 0.01, "*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n*MAT_ADD_EROSION\n1\n0.0,0.0,0.0,0.05\n");
  deck.node_set(1, [](const Vec& x) { return x[0] > 0.05 && x[1] < 1e-9; });
  deck.cards +=
      "*INITIAL_VELOCITY\n1\n20.0,0.0,0.0\n"
      "*DATABASE_CROSS_SECTION_PLANE\n0,0.05,0.0,0.0,1.0,0.0,0.0\n0.0,0.0,0.0,0.0,0.0\n";
  auto s = simulation_of(deck.text(1));
  const auto area = [&] {
    return s->world().passes.all<const CrossSections>().front()->sections.front().force(s->world()).area;
  };
  EXPECT_NEAR(area(), 0.4 * 0.01, 1e-12);
  for (int k = 0; k < 400 && s->world().counters["deleted_elements"] == 0; ++k) s->step(do_nothing);
  ASSERT_EQ(s->world().counters["deleted_elements"], 1);
  EXPECT_NEAR(area(), 0.3 * 0.01, 2e-4 * 0.01);
}

// What deleted elements held is reported their parts: the ledger lost just that.
TEST(PartSums, EnergyOfDeletedElementsIsToldOfTheirPart) {
  const auto expect = [](const std::string& text) {
    auto s = simulation_of(text);
    test::start_ledger(*s);
    for (int k = 0; k < 2000 && s->world().counters["deleted_elements"] < 1; ++k) s->step(do_nothing);
    ASSERT_GE(s->world().counters["deleted_elements"], 1);
    s->step([&](World& world, const Clock&, const std::string& who) {
      const Sample sample = s->sample(who);
      Real eroded = 0;
      for (const PartSample& part : sample.parts) eroded += part.eroded_internal + part.eroded_hourglass;
      EXPECT_GT(eroded, 0);
      EXPECT_NEAR(eroded / world.energy.dissipated, 1, 1e-12);
    });
  };
  ShellDeck deck;
  deck.plate(0.1, 0.4, 1, 4, 1);
  deck.part(1, 0.01,
            "*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n*MAT_ADD_EROSION\n1\n0.0,0.0,0.0,0.05\n*CONTROL_HOURGLASS\n4,"
            "0.05\n");
  deck.velocity(
      [](const Vec& x) { return Vec(x[1] < 1e-9 ? 400 * (x[0] - 0.05) : 0, 0, x[0] * x[1] > 0 ? 3 : 0); });
  expect(deck.text(1));
  test::beams::BeamDeck beams;
  beams.part(1, test::beams::square_1,
             "*MAT_ELASTIC\n1,7850.0,2.1E+11,0.3\n*MAT_ADD_EROSION\n1\n0.0,0.0,0.0,0.005\n*CONTROL_"
             "TIMESTEP\n0.0,0.1\n");
  beams.line(2, 0.2, [](int k) { return k == 0 ? ",7,7" : ""; });
  beams.velocity([](int n) { return Vec(n == 3 ? 40 : 0, 0, 0); });
  expect(beams.text(1));
}

}  // namespace part_sums_test
