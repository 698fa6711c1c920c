// Rules of single elements against closed forms: triads of discrete beams, shells that fail.
#include <gtest/gtest.h>

#include <cmath>

#include "beam_decks.hpp"
#include "output/fields/field_data.hpp"
#include "shell_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::do_nothing;
using test::ShellDeck;
using test::simulation_of;
using test::beams::BeamDeck;

namespace elements_by_hand_test {
namespace {

const std::string springs =
    "*MAT_LINEAR_ELASTIC_DISCRETE_BEAM\n1,2.0,100.0,200.0,300.0,20.0,40.0,60.0\n0.0\n";

/// One discrete beam along x, of length 1; `driven`: cards of motions.
std::unique_ptr<Simulation> driven_beam(int scoor, const std::string& codes, const std::string& driven) {
  BeamDeck deck;
  deck.at({0, 0, 0}, codes.c_str()), deck.at({1, 0, 0}, codes.c_str());
  deck.beam(1, 1, 2);
  deck.cards = fmt::format("*PART\nbeams\n1,1,1\n*SECTION_BEAM\n1,6,,,,{}\n1.0,0.4\n", scoor) + springs +
               driven + "*DEFINE_CURVE\n1\n0.0,0.0\n1.0,0.5\n*DEFINE_CURVE\n2\n0.0,0.0\n9.0,0.0\n";
  return simulation_of(deck.text(1));
}
Eigen::Quaterniond triad_of(const Simulation& s) {
  const auto* q = dynamic_cast<const Field<Real>*>(s.world().groups.at(0)->fields.find("triad"));
  return {q->data(0)[0], q->data(1)[0], q->data(2)[0], q->data(3)[0]};
}

}  // namespace

// Driven about z at the rate 0.5 t at one end, the triad turns with the end that SCOOR names, by t^2/4; with
// 0 by the mean of both.
TEST(ElementsByHand, TriadsTurnWithTheirEnd) {
  for (const int end : {1, 2})
    for (const auto& [scoor, share] :
         {std::pair(-1, end == 1 ? 1.0 : 0.0), {1, end == 2 ? 1.0 : 0.0}, {0, 0.5}}) {
      auto s = driven_beam(
          scoor, ",7,4", fmt::format("*BOUNDARY_PRESCRIBED_MOTION_NODE\n{},7,0,1\n{},7,0,2\n", end, 3 - end));
      while (s->clock().t < 0.8) s->step(do_nothing);
      const Real t = s->clock().t - s->clock().dt, angle = 2 * triad_of(*s).z();
      EXPECT_NEAR(angle, share * t * t / 4, 4e-3) << scoor << " " << end;
    }
}

// SCOOR 2: r stays along the line of the ends, here turned by atan(u/1) as end 2 moves across.
TEST(ElementsByHand, TriadsFollowTheLineOfTheirEnds) {
  for (const int scoor : {2, 0}) {
    auto s = driven_beam(scoor, ",0,7",
                         "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,2,2,1\n2,1,2,2\n1,1,2,2\n1,2,2,2\n"
                         "1,3,2,2\n2,3,2,2\n");
    while (s->clock().t < 0.8) s->step(do_nothing);
    const Real u = 0.5 * (s->clock().t - s->clock().dt);
    const Vec r = triad_of(*s) * Vec::UnitX();
    EXPECT_NEAR(std::atan2(r[1], r[0]), scoor == 2 ? std::atan(u) : 0, 4e-3);
  }
}

// Stretched along x, free across: of the strain e the effective one is 2/3 (1 + nu) e, thinning with it.
TEST(ElementsByHand, EffectiveStrainOfShellsHasThatAcrossTheThickness) {
  for (const Real nu : {0.0, 0.4}) {
    ShellDeck deck;
    deck.plate(1, 1, 1, 1, 1);
    deck.part(1, 0.1, fmt::format("*MAT_ELASTIC\n1,1000.0,1.0E6,{}\n*MAT_ADD_EROSION\n1,,,,0.1\n0.0\n", nu));
    deck.node_set(1, [](const Vec& x) { return x[0] < 0.5; });
    deck.node_set(2, [](const Vec& x) { return x[0] > 0.5; });
    deck.node_set(3, [](const Vec& x) { return x[1] < 0.5; });
    deck.cards +=
        "*BOUNDARY_SPC_SET\n1,0,1,0,1\n3,0,0,1,0\n*BOUNDARY_PRESCRIBED_MOTION_SET\n2,1,2,1\n"
        "*DEFINE_CURVE\n1\n0.0,0.0\n1.0,0.5\n*CONTROL_TIMESTEP\n0.0,0.2\n";
    auto s = simulation_of(deck.text(1));
    while (s->clock().t < 1 && s->world().counters["deleted_elements"] == 0) s->step(do_nothing);
    ASSERT_EQ(s->world().counters["deleted_elements"], 1);
    const Real strain = std::log(s->world().nodes.x.data(0)[1]), effective = 2.0 / 3 * (1 + nu) * strain;
    EXPECT_NEAR(effective, 0.1, 4e-3) << nu;
  }
}

// What is deleted is not among the cells that are written.
TEST(ElementsByHand, FieldsHaveNoDeletedShells) {
  ShellDeck deck;
  deck.plate(0.1, 0.4, 1, 4, 1);
  deck.part(1, 0.01, "*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n*MAT_ADD_EROSION\n1\n0.0,0.0,0.0,0.05\n");
  deck.node_set(1, [](const Vec& x) { return x[0] > 0.05 && x[1] < 1e-9; });
  deck.cards += "*INITIAL_VELOCITY\n1\n20.0,0.0,0.0\n";
  auto s = simulation_of(deck.text(1));
  const auto head = [&] {
    FieldWriterOptions options;
    options.part_ids = {1};
    return shell_data(s->world(), options).sizes;
  };
  EXPECT_NE(head().find("NumberOfCells=\"4\""), std::string::npos) << head();
  for (int k = 0; k < 400 && s->world().counters["deleted_elements"] == 0; ++k) s->step(do_nothing);
  ASSERT_EQ(s->world().counters["deleted_elements"], 1);
  EXPECT_NE(head().find("NumberOfCells=\"3\""), std::string::npos) << head();
}

}  // namespace elements_by_hand_test
