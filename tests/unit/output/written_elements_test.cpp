// What beams and welds report of their forces, and which axes and points elout writes.
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/beams/beam_decks.hpp"
#include "../../verification/shells/shell_decks.hpp"
#include "../../verification/structures/solid_decks.hpp"
#include "elements/beam/weld.hpp"
#include "elements/element_report.hpp"
#include "extension/additions.hpp"
#include "output/ascii/ascii.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant::written_elements_test {
namespace {

using test::do_nothing;

std::string elout_of(Simulation& s) {
  std::string out;
  for (int k = 0; k < 3; ++k)
    s.step([&](World& world, const Clock& clock, const std::string&) {
      for (const AsciiHistory& one : ascii_histories())
        if (one.name == "elout") out = one.text(world, clock);
    });
  return out;
}
int count_of(const std::string& text, const std::string& word) {
  int n = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++n;
  return n;
}
/// Stress of the first point of the first element.
std::array<Real, 6> stress_in(const std::string& elout) {
  std::array<Real, 6> out{};
  const std::size_t at = elout.find("elastic");
  if (at == std::string::npos) return out;
  for (std::size_t k = 0; k < 6; ++k) out[k] = std::stod(elout.substr(at + 8 + 12 * k, 12));
  return out;
}
/// The first force that a weld 1.6 long along z has, of a motion of its upper end.
WeldForce first_force_of_weld(const Vec& velocity, const Vec& spin) {
  auto s = test::simulation_of(
      "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*PART\nweld\n1,1,1\n*SECTION_BEAM\n1,9,1.0\n5.0,5.0,0.0,0.0\n"
      "*NODE\n1,0.0,0.0,0.0,7,7\n2,0.0,0.0,1.6\n*ELEMENT_BEAM\n       1       1       1       2\n"
      "*MAT_SPOTWELD\n1,7.85e-9,205000.0,0.3,1.0e9\n*END\n");
  s->world().nodes.v.set(1, velocity);
  shared_fields::angular_velocity.find(s->world().nodes.fields)->set(1, spin);
  test::start_ledger(*s);
  std::vector<WeldForce> welds;
  for (int k = 0; k < 3; ++k) {
    s->step(do_nothing);
    welds.clear();
    for (const auto* pass : s->world().passes.all<const WeldReporter>())
      pass->report_welds(s->world(), welds);
    if (std::abs(welds.at(0).shear) + std::abs(welds.at(0).torsion) > 0) break;
  }
  return welds.at(0);
}

}  // namespace

// Welds are round: motions along x, y and across have the same shear and bending, and no torsion; turning
// about the weld is torsion alone. Small motions; the rest is of second order.
TEST(WrittenElements, WeldsAreAlikeInAllDirections) {
  const WeldForce x = first_force_of_weld(Vec(1, 0, 0), Vec::Zero());
  ASSERT_GT(x.shear, 0);
  ASSERT_GT(x.moment + 1e-9 * x.shear, 0);
  for (const Vec& shear : {Vec(0, 1, 0), Vec(0.6, 0.8, 0)}) {
    const WeldForce other = first_force_of_weld(shear, Vec::Zero());
    EXPECT_NEAR(other.shear, x.shear, 1e-6 * x.shear);
    EXPECT_NEAR(other.moment, x.moment, 1e-6 * x.shear);
    EXPECT_NEAR(other.torsion, 0, 1e-6 * x.shear);
  }
  const WeldForce about = first_force_of_weld(Vec::Zero(), Vec(0, 0, 1));
  EXPECT_GT(std::abs(about.torsion), 0);
  EXPECT_NEAR(about.moment, 0, 1e-6 * std::abs(about.torsion));
  const WeldForce a = first_force_of_weld(Vec::Zero(), Vec(1, 0, 0)),
                  b = first_force_of_weld(Vec::Zero(), Vec(0, 1, 0));
  EXPECT_GT(a.moment, 0);
  EXPECT_NEAR(a.moment, b.moment, 1e-6 * a.moment);
}

// Resultants are tension, shear along s and t, moments about s and t, torsion: each its stiffness times its
// motion, v (1, 2, 3) and w (1, 2, 3) over one step.
TEST(WrittenElements, DiscreteBeamsNameTheirForcesInOrder) {
  test::beams::BeamDeck deck;
  deck.at({0, 0, 0}, ",7,7"), deck.at({2, 0, 0});
  deck.beam(1, 1, 2);
  deck.cards =
      "*PART\nbeams\n1,1,1\n*SECTION_BEAM\n1,6,,,,0\n1.0,0.4\n*MAT_LINEAR_ELASTIC_DISCRETE_BEAM\n"
      "1,2.0,100.0,200.0,300.0,20.0,40.0,60.0\n0.0\n";
  auto s = test::simulation_of(deck.text(1));
  s->world().nodes.v.set(1, Vec(1e-4, 2e-4, 3e-4));
  shared_fields::angular_velocity.find(s->world().nodes.fields)->set(1, Vec(1e-4, 2e-4, 3e-4));
  std::array<Real, 6> found{};
  for (int k = 0; k < 3 && found[0] == 0; ++k) {
    s->step(do_nothing);
    for (const auto* pass : s->world().passes.all<const ElementReporter>())
      if (pass->kind() == ElementKind::beam) found = pass->report_element(s->world(), 0, {}).resultants;
  }
  ASSERT_NE(found[0], 0);
  const Real expected[] = {100, 400, 900, 80, 180, 20};
  for (std::size_t k = 1; k < 6; ++k) EXPECT_NEAR(found[k] / found[0], expected[k] / 100, 1e-3) << k;
}

// An element whose first side is along global y: its axes are y and -x: what is xx in global axes is yy
// in local ones.
TEST(WrittenElements, AxesOfElout) {
  std::array<Real, 6> of[2];
  for (const int local : {0, 1}) {
    test::ShellDeck deck;
    deck.nodes = {Vec(0, 0, 0), Vec(1, 0, 0), Vec(1, 1, 0), Vec(0, 1, 0)};
    deck.elements = "       1       1       2       3       4       1\n";
    deck.part(1, 0.1, "*MAT_ELASTIC\n         1       1.0    1000.0       0.3\n");
    deck.velocity([](const Vec& x) { return Vec(1e-3 * x[0], 0, 0); });
    deck.cards += fmt::format(
        "*CONTROL_OUTPUT\n0\n0,0,2,50,0,0,0,{}\n*DATABASE_HISTORY_SHELL\n1\n*DATABASE_ELOUT\n1e-9\n", local);
    of[local] = stress_in(elout_of(*test::started(deck.text(1))));
  }
  ASSERT_GT(std::abs(of[0][0] - of[0][1]), 0.1 * std::abs(of[0][0]));
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
    EXPECT_NEAR(of[1][k], of[0][1 - k], 1e-3 * std::abs(of[0][0]));
}

TEST(WrittenElements, PointsOfSolidsInElout) {
  for (const int points : {1, 8}) {
    test::SolidDeck deck;
    deck.block(Vec(1, 1, 1), 1, 1, 1, 1);
    deck.cards = fmt::format(
        "*PART\nsolid\n1,1,1\n*SECTION_SOLID\n1,2\n*MAT_ELASTIC\n1,1.0,1000.0,0.3\n"
        "*DATABASE_EXTENT_BINARY\n0\n0\n{}\n*DATABASE_HISTORY_SOLID\n1\n*DATABASE_ELOUT\n1e-9\n",
        points);
    EXPECT_EQ(count_of(elout_of(*test::started(deck.text(1))), "elastic"), points);
  }
}

// A stretched shell that turns at one side is plastic at one face more than at the other: each number of a
// layer is of that layer, and nodes are displaced by what they moved.
TEST(WrittenElements, FieldsOfLayersAndNodes) {
  test::ShellDeck deck;
  deck.plate(1, 1, 1, 1, 1);
  deck.part(1, 0.1, "*MAT_PLASTIC_KINEMATIC\n1,1.0,1000.0,0.3,0.5,10.0\n");
  deck.velocity([](const Vec& x) { return Vec(0.1 * x[0], 0, 0); });
  deck.cards += "*DATABASE_BINARY_D3PLOT\n0.1\n*DATABASE_EXTENT_BINARY\n0\n";
  auto s = test::started(deck.text(1));
  World& world = s->world();
  std::vector<Vec> start;
  for (Index n = 0; n < 4; ++n) start.push_back(world.nodes.x.vec(n));
  for (const Index n : {1, 3}) shared_fields::angular_velocity.find(world.nodes.fields)->set(n, Vec(0, 3, 0));
  for (int k = 0; k < 3; ++k) s->step(do_nothing);
  for (auto* pass : world.passes.all<FieldFiller>()) pass->fill_fields(world);
  auto* moved = dynamic_cast<Field<Real>*>(world.nodes.fields.find("displacement"));
  ASSERT_NE(moved, nullptr);
  for (Index n = 0; n < 4; ++n)
    EXPECT_EQ((moved->vec(n) - (world.nodes.x.vec(n) - start[static_cast<std::size_t>(n)])).norm(), 0);
  EXPECT_GT(moved->vec(1)[0], 0);
  for (const auto* shells : world.passes.all<const ElementReporter>()) {
    const auto points = shells->report_element(world, 0, {}).points;
    ASSERT_GE(points.size(), 2u);
    EXPECT_GT(std::abs(points.back().plastic - points.front().plastic), 1e-4);
    const auto shown = [&](const char* name) {
      auto* field = dynamic_cast<Field<Real>*>(shells->reported().fields.find(name));
      return field ? (*field)[0] : -1;
    };
    EXPECT_EQ(shown("plastic_strain_upper"), points.back().plastic);
    EXPECT_EQ(shown("plastic_strain_lower"), points.front().plastic);
  }
}

}  // namespace courant::written_elements_test
