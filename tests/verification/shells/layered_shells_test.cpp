// *ELEMENT_SHELL_COMPOSITE: shells with layers of their own, against laminate theory and against parts with
// the same layers.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "elements/shell/shells.hpp"
#include "laminates.hpp"
#include "laws/strength/strength.hpp"
#include "same_bits.hpp"
#include "state/reports.hpp"

using namespace courant;
using namespace courant::test::laminates;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;

namespace {

const std::string plain_part = "*PART\nplate\n1,1,7\n*SECTION_SHELL\n1,2,1.0\n0.5\n";

/// The layers below the line of an element.
std::string layers_of_element(const Laminate& plies, bool one_a_card) {
  std::string out;
  for (std::size_t k = 0; k < plies.size(); ++k) {
    const bool last = one_a_card || k % 2 == 1 || k + 1 == plies.size();
    out += fmt::format("{:10}{:10.5f}{:10.1f}{}", plies[k].mid, plies[k].thickness, plies[k].angle,
                       last ? "\n" : "          ");
  }
  return out;
}

/// The deck with its elements as those of `keyword`; `plies` of the element with this number from 1.
template <class Plies>
std::string with_layers(const ShellDeck& deck, const std::string& keyword, const Plies& plies) {
  std::string text = deck.text(1), out;
  const std::string plain = "*ELEMENT_SHELL\n";
  const std::size_t at = text.find(plain), first = at + plain.size(), end = text.find("*END");
  out = text.substr(0, at) + keyword + "\n";
  const bool one_a_card = keyword.find("LONG") != std::string::npos;
  int number = 0;
  for (std::size_t line = first; line < end;) {
    const std::size_t next = text.find('\n', line) + 1;
    out += text.substr(line, next - line);
    if (keyword.find("OFFSET") != std::string::npos) out += "             0.0\n";
    out += layers_of_element(plies(++number), one_a_card);
    line = next;
  }
  return out + "*END\n";
}

const Laminate unlike = {{7, 0.002, 0}, {7, 0.003, 90}, {7, 0.001, 30}};

}  // namespace

TEST(LayeredShells, AreAsStiffAsAPartWithTheSameLayers) {
  const auto of_part = measured_stiffness(one_shell(composite_part(unlike) + orthotropic(7)).text(1));
  for (const char* keyword : {"*ELEMENT_SHELL_COMPOSITE", "*ELEMENT_SHELL_COMPOSITE_LONG",
                              "*ELEMENT_SHELL_OFFSET_COMPOSITE", "*ELEMENT_SHELL_OFFSET_COMPOSITE_LONG"}) {
    const auto found = measured_stiffness(
        with_layers(one_shell(plain_part + orthotropic(7)), keyword, [](int) { return unlike; }));
    EXPECT_LT(worst(found, of_part), 1e-12) << keyword;
  }
}

// One point a layer misses t_k^3/12 of each: 18.19 % of the largest entry of D with three layers, and 1/n^2
// of that.
TEST(LayeredShells, FollowLaminateTheory) {
  const auto expected = laminate_stiffness(unlike);
  for (const auto& [count, bound] : {std::pair(1, 0.183), {2, 0.0457}, {4, 0.01143}, {10, 0.00183}}) {
    const auto found =
        measured_stiffness(with_layers(one_shell(plain_part + orthotropic(7)), "*ELEMENT_SHELL_COMPOSITE",
                                       [&, count = count](int) { return divided(unlike, count); }));
    EXPECT_LT(worst(found, expected), bound) << count;
  }
}

// Of four elements two have two layers, of different angles, one three and one, of another keyword, the
// section's thickness: each weighs what its layers do, and those that differ in angles alone are one group.
TEST(LayeredShells, EachHasItsOwn) {
  ShellDeck deck;
  deck.plate(2, 2, 2, 2, 1);
  deck.cards = plain_part + orthotropic(7) + "*MAT_ELASTIC\n8,2700.0,7.0E10,0.3\n";
  std::string text = with_layers(deck, "*ELEMENT_SHELL_COMPOSITE", [](int number) {
    return number == 1   ? Laminate{{7, 0.002, 0}, {7, 0.002, 90}}
           : number == 2 ? Laminate{{7, 0.002, 45}, {7, 0.002, -45}}
                         : Laminate{{7, 0.002, 0}, {8, 0.004, 0}, {7, 0.002, 0}};
  });
  const std::size_t last = text.find("       4       1");
  text = text.substr(0, last) + "*ELEMENT_SHELL\n" + text.substr(last, 49) + "*END\n";
  auto s = simulation_of(text);
  const World& world = s->world();
  ASSERT_EQ(world.groups.size(), 3U);
  EXPECT_EQ(world.groups[1]->size(), 2);
  EXPECT_NEAR(world.groups[0]->mass[0], 0.5 * RO, 1e-9);
  EXPECT_NEAR(world.groups[1]->mass[0], 0.004 * RO, 1e-12);
  EXPECT_NEAR(world.groups[2]->mass[0], 0.004 * RO + 0.004 * 2700, 1e-12);
  EXPECT_NEAR(world.segments.thickness[0], 0.5, 1e-15);  // plain ones come first
  EXPECT_NEAR(world.segments.thickness[1], 0.004, 1e-15);
  EXPECT_NEAR(world.segments.thickness[3], 0.008, 1e-15);
  const Field<Real>& directions = layer_directions_of(*world.groups[1], 2);
  EXPECT_NEAR(directions.data(0)[0], 1, 1e-14);
  EXPECT_NEAR(directions.data(0)[1], std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(directions.data(3)[1], -std::sqrt(0.5), 1e-14);
}

TEST(LayeredShells, SameBitsOnThreadsAndAfterARestart) {
  ShellDeck deck;
  deck.plate(0.1, 0.1, 8, 8, 1);
  deck.cards = plain_part + orthotropic(7, "2.0", "1.0,1.0,0.0") + "*MAT_ELASTIC\n8,2700.0,7.0E10,0.3\n";
  deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9 || x[0] > 0.1 - 1e-9; });
  deck.velocity([](const Vec& x) { return Vec(0, 0, 60 * std::sin(pi * x[0] / 0.1) * (1 + 5 * x[1])); });
  test::expect_same_bits(with_layers(deck, "*ELEMENT_SHELL_COMPOSITE",
                                     [](int number) {
                                       return number % 3 == 0
                                                  ? Laminate{{7, 0.001, 10.0 * number}, {8, 0.001, 0}}
                                                  : Laminate{{7, 0.0005, 45}, {8, 0.001, 0}, {7, 0.0005, 45}};
                                     }),
                         160, 70);
}

namespace {

/// A fabric along x of EA 60 GPa, XT 0.8 GPa at a strain of 0.017, SLIMT1 0.3; `third`: its third card from
/// TSIZE.
std::string fabric(int mid, const std::string& third) {
  return fmt::format(
      "*MAT_058\n{},1500.0,6.0E10,6.0E10,0.0,0.0\n4.2E9,3.0E9,3.0E9,0.3,1.0,0.3,1.0,1.0\n0.0,{}\n0.0\n0.0\n"
      "0.015,0.017,0.015,0.017,0.08\n6.5E8,8.0E8,6.5E8,8.0E8,1.1E8\n",
      mid, third);
}

/// One shell that is pulled along x at 20/s.
ShellDeck pulled_shell(const std::string& cards) {
  ShellDeck deck = one_shell(cards + "*CONTROL_TIMESTEP\n0.0,0.1\n");
  deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 0.5; });
  deck.hold(2, "yzXYZ", [](const Vec& x) { return x[0] > 0.5; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 0.5; });
  deck.cards += "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,9\n*DEFINE_CURVE\n9\n0.0,20.0\n1.0,20.0\n";
  return deck;
}

Real layers_deleted(const Simulation& s) {
  const auto found = s.world().counters.find("deleted_elements");
  return found == s.world().counters.end() ? 0 : found->second;
}

}  // namespace

TEST(LayeredShells, FabricIsPulledAlongItsCurve) {
  const Real EA = 60e9, XT = 0.8e9, at_strength = 0.017, m = 1 / std::log(at_strength * EA / XT);
  auto s = simulation_of(
      pulled_shell("*PART\nlayer\n1,1,7\n*SECTION_SHELL\n1,2,1.0,2\n1.0\n" + fabric(7, "0.0,0.05")).text(1));
  const ElementGroup& group = *s->world().groups[0];
  const Field<Real>&stress = layer_stress_of(group, 2), &thickness = thickness_of_shells(group);
  Real largest = 0;
  while (layers_deleted(*s) == 0) {
    const Real e = std::log(s->world().nodes.x.data(0)[1]), r = e * EA / XT;
    s->step(do_nothing);
    const Real found = thickness[0] * (stress.data(at_layer(0, 0))[0] + stress.data(at_layer(1, 0))[0]) / 2;
    if (layers_deleted(*s) > 0) break;
    const Real smooth = EA * e * std::exp(-std::pow(r, m) / (m * std::exp(1.0)));
    const Real expected = e > at_strength ? std::max(smooth, 0.3 * XT) : smooth;
    EXPECT_NEAR(found / XT, expected / XT, 2e-5) << e;
    largest = std::max(largest, found);
  }
  EXPECT_NEAR(largest / XT, 1, 1e-3);  // seen in steps of strain
  // ERODS 0.05: sqrt(4/3) times the strain
  EXPECT_NEAR(std::log(s->world().nodes.x.data(0)[1]), 0.05 / std::sqrt(4.0 / 3), 1e-3);
}

// TSIZE, TFAIL, and TFAIL above 0.1: of a shell that is pushed to a share x of its length the step is l/c, l
// shorter by x, and c by sqrt(x), as its density grows: 0.8 at x = 0.64.
TEST(LayeredShells, GoWhereTheirStepIsTooSmall) {
  const std::string part = "*PART\nlayer\n1,1,7\n*SECTION_SHELL\n1,2,1.0,2\n1.0\n";
  const auto ply = [](const std::string& tfail) {
    return "*MAT_054\n7,1500.0,6.0E10,6.0E10,0.0,0.0\n4.2E9,3.0E9,3.0E9\n\n\n" + tfail +
           ",0.0,1.0,0.0,2.0,9.0\n1.3E9,1.9E9,2.0E8,6.0E7,9.5E7\n";
  };
  auto free = simulation_of(pulled_shell(part + ply("0.0")).text(1));
  free->step(do_nothing);
  const Real first = free->clock().dt_old;
  for (const std::string& law : {fabric(7, fmt::format("{:.9g},0.0", 0.8 * first)), ply("0.8"),
                                 ply(fmt::format("{:.9g}", 0.8 * first))}) {
    ShellDeck deck = pulled_shell(part + law);
    const std::size_t at = deck.cards.find("0.0,20.0\n1.0,20.0");
    deck.cards.replace(at, 17, "0.0,-20.\n1.0,-20.");
    auto s = simulation_of(deck.text(1));
    while (layers_deleted(*s) == 0 && s->world().nodes.x.data(0)[1] > 0.3) s->step(do_nothing);
    EXPECT_EQ(layers_deleted(*s), 1) << law;
    EXPECT_NEAR(s->world().nodes.x.data(0)[1], 0.64, 0.002) << law;
  }
}

// A strip of plies: the shell in the middle is weaker and goes; what is beside it has SOFT times its
// strength.
TEST(LayeredShells, StrengthFallsBesideDeletedElements) {
  ShellDeck deck;
  deck.plate(3, 1, 3, 1, 1);
  deck.cards = "*PART\nlayer\n1,1,7\n*SECTION_SHELL\n1,2,1.0,2\n1.0\n";
  deck.cards +=
      "*MAT_054\n7,1500.0,6.0E10,6.0E10,0.0,0.0\n4.2E9,3.0E9,3.0E9\n\n0.0,0.0,0.0,0.0,0.0,0.0\n"
      "1.0E-9,0.0,0.5,0.0,2.0,0.0\n1.3E9,1.9E9,2.0E8,6.0E7,9.5E7\n";
  deck.hold(1, "yzXYZ", [](const Vec&) { return true; });
  deck.node_set(3, [](const Vec& x) { return x[0] > 1.5; });
  deck.node_set(4, [](const Vec& x) { return x[0] < 1.5; });
  deck.cards +=
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n3,1,0,9\n*BOUNDARY_PRESCRIBED_MOTION_SET\n4,1,0,9,-1.0\n"
      "*DEFINE_CURVE\n9\n0.0,20.0\n1.0,20.0\n";
  auto s = simulation_of(deck.text(1));
  while (layers_deleted(*s) == 0) s->step(do_nothing);
  const ElementGroup& group = *s->world().groups[0];
  const auto beside = [&](Index e) {
    const std::string name = std::string(beside_deleted) + "_of_layer_1";
    return dynamic_cast<const Field<Real>*>(group.fields.find(name))->data(0)[e];
  };
  EXPECT_EQ(beside(0), 1);
  EXPECT_EQ(beside(1), 0);  // that which went
  EXPECT_EQ(beside(2), 1);
}

TEST(LayeredShells, FabricsThatTearHaveTheSameBits) {
  ShellDeck deck;
  deck.plate(0.1, 0.1, 8, 8, 1);
  deck.cards = "*PART\nlayer\n1,1,7\n*SECTION_SHELL\n1,2,1.0,3\n0.002\n" + fabric(7, "0.0,0.03,0.6,0.0");
  deck.hold(1, "xyzXYZ", [](const Vec& x) { return x[0] < 1e-9 || x[0] > 0.1 - 1e-9; });
  deck.velocity([](const Vec& x) { return Vec(0, 0, 150 * std::sin(pi * x[0] / 0.1) * (1 + 5 * x[1])); });
  auto s = simulation_of(deck.text(1));
  int steps = 0;
  while (layers_deleted(*s) < 3 && steps < 2000) s->step(do_nothing), ++steps;
  ASSERT_GE(layers_deleted(*s), 3);
  test::expect_same_bits(deck.text(1), steps + 40, steps + 1);
}
