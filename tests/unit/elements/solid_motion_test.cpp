// Solids of each formulation in motions whose stress is known: a large turn within one step, and rest.
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/structures/solid_decks.hpp"
#include "elements/element_report.hpp"

using namespace courant;

namespace solid_motion_test {
namespace {

using test::CellShape;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

struct Formulation {
  int elform;
  CellShape cells;
  bool on_edges = false;
};
const Formulation formulations[] = {{1, CellShape::hexahedron},       {1, CellShape::wedges},
                                    {2, CellShape::hexahedron},       {2, CellShape::wedges},
                                    {10, CellShape::tetrahedra},      {13, CellShape::tetrahedra},
                                    {16, CellShape::tetrahedra, true}};
constexpr Real dt = 1e-5;

/// Two cells of 0.2 x 0.3 x 0.25, somewhat distorted, in steps of 1e-5.
std::unique_ptr<Simulation> solids(const Formulation& f, const std::string& material) {
  SolidDeck deck;
  deck.cells = f.cells, deck.on_edges = f.on_edges;
  deck.block(Vec(0.4, 0.3, 0.25), 2, 1, 1, 1, [](const Vec& x) {
    return Vec(x[0] + 0.1 * x[1], x[1] + 0.2 * x[2] * x[0], x[2] - 0.1 * x[0]);
  });
  deck.cards = fmt::format(
                   "*CONTROL_TIMESTEP\n0.0,0.9,0,0.0,0.0,99\n*DEFINE_CURVE\n99\n0.0,{0}\n9.0,{0}\n"
                   "*SECTION_SOLID\n1,{1}\n",
                   dt, f.elform) +
               material;
  return simulation_of(deck.text(1));
}
/// Nodes move so that x becomes A x at the end of the step, then `look` gets the points.
template <class Look>
void move_by(Simulation& s, const Matrix& A, const Look& look) {
  s.step(do_nothing);                                           // the length of the step before counts, too
  s.step([&](World& world, const Clock&, const std::string&) {  // elements have seen the step before
    Nodes& nodes = world.nodes;
    for (Index n = 0; n < nodes.size(); ++n) nodes.v.set(n, (A - Matrix::Identity()) * nodes.x.vec(n) / dt);
  });
  int seen = 0;
  s.step([&](World& world, const Clock&, const std::string&) {
    for (const auto* solids : world.passes.all<const ElementReporter>())
      for (Index e = 0; e < solids->reported().size(); ++e, ++seen)
        for (const PointReport& point : solids->report_element(world, e, {.all_points = true}).points)
          look(world, point);
  });
  EXPECT_GE(seen, 2);
}

}  // namespace

// A turn of 0.6 within a step: the rate of strain belongs to the middle of the step, where that of a turn is
// none. With the positions at either end it is a strain of some tenths.
TEST(SolidMotion, ATurnWithinAStepGivesNoStress) {
  const Matrix turn = Eigen::AngleAxisd(0.6, Vec(1, 2, -2) / 3).toRotationMatrix();
  for (const Formulation& f : formulations) {
    const auto s = solids(f, "*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1.0E6,1.0E5,0.3\n");
    ASSERT_NE(s, nullptr) << f.elform;
    move_by(*s, turn, [&](const World&, const PointReport& point) {
      for (const Real stress : point.stress)
        // of 1E5 times the strain; nodes are 1e-4 off by the kick of what v at a point adds up
        // to
        EXPECT_NEAR(stress, 0, 1) << f.elform << " " << static_cast<int>(f.cells);
    });
  }
}

// A homogeneous stretch in a step: of the middle, 2 (F - 1)(F + 1)^-1, exact to third order for its
// logarithm.
TEST(SolidMotion, AStretchGivesItsStress) {
  const Vec stretch(1.02, 0.99, 1.01);
  for (const Formulation& f : formulations) {
    const auto s = solids(f, "*PART\nblock\n1,1,1\n*MAT_ELASTIC\n1,1.0E6,1.0E5,0.3\n");
    ASSERT_NE(s, nullptr) << f.elform;
    move_by(*s, stretch.asDiagonal(), [&](const World&, const PointReport& point) {
      const Real lambda = 1e5 * 0.3 / (1.3 * 0.4), shear = 1e5 / 2.6;
      const Vec strain = stretch.array().log();
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(point.stress[k], lambda * strain.sum() + 2 * shear * strain[static_cast<Index>(k)], 3)
            << f.elform << " " << static_cast<int>(f.cells) << " " << k;
      for (std::size_t k = 3; k < 6; ++k) EXPECT_NEAR(point.stress[k], 0, 3) << f.elform << " " << k;
    });
  }
}

// The pressure of a liquid is that of its volume over that at the start, and at the start there is none.
TEST(SolidMotion, LiquidsHaveThePressureOfTheirVolume) {
  for (const Formulation& f : formulations)
    for (const bool compressed : {false, true}) {
      if (f.cells != CellShape::hexahedron && f.elform != 13) continue;
      const auto s = solids(f,
                            "*PART\nblock\n1,1,1,1\n*MAT_NULL\n1,1.0E6,-1.0E20\n*EOS_LINEAR_POLYNOMIAL\n"
                            "1,0.0,1.0E5\n");
      ASSERT_NE(s, nullptr) << f.elform;
      const Real ratio = compressed ? 0.95 * 0.98 * 0.99 : 1, mu = 1 / ratio - 1;
      move_by(*s, compressed ? Vec(0.95, 0.98, 0.99).asDiagonal() : Vec(1, 1, 1).asDiagonal(),
              [&](const World&, const PointReport& point) {
                for (std::size_t k = 0; k < 3; ++k)
                  EXPECT_NEAR(point.stress[k], -1e5 * mu, compressed ? 1 : 1e-7) << f.elform;
              });
    }
}

}  // namespace solid_motion_test
