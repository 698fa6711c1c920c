// How far the penalty of solids lets a block sink in: k = SLSFAC SFS K A^2/V of each node of one side.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "solid_decks.hpp"

namespace courant::test::penalty_depth {

namespace {

constexpr Real E = 1e7, ro = 1000, g = 10;

/// Depths of the lowest nodes of a block of height 1 on held rigid solids of its own mesh, n elements a
/// side, at rest under its weight; the floor is `floor` times as stiff.
std::pair<Real, Real> depths(const std::string& kind, int n, Real sfs, Real floor) {
  SolidDeck deck;
  deck.cards = fmt::format(
      "*PART\nblock\n1,1,1\n*PART\nfloor\n2,1,2\n*SECTION_SOLID\n1,1\n*MAT_ELASTIC\n1,{0},{1},0.0\n"
      "*MAT_RIGID\n2,{0},{2},0.0\n1,7,7\n*LOAD_BODY_Z\n1,{3}\n*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n"
      "*DAMPING_GLOBAL\n0,72.0\n"
      "*CONTACT_AUTOMATIC_{5}SURFACE_TO_SURFACE\n1,2,3,3\n0.0\n{4},{4}\n",
      ro, E, floor * E, g, sfs, kind);
  deck.block({1, 1, 1}, n, n, n, 1);
  deck.block({1, 1, 1.0 / n}, n, n, 1, 2, [&](const Vec& x) { return Vec(x - Vec(0, 0, 1.0 / n)); });
  auto s = simulation_of(deck.text(1));
  while (s->clock().t < 0.7) s->step(do_nothing);
  const Nodes& nodes = s->world().nodes;
  std::pair<Real, Real> out{1, 0};
  for (Index i = 0; i < (n + 1) * (n + 1); ++i) {
    out.first = std::min(out.first, -nodes.x.data(2)[i]);
    out.second = std::max(out.second, -nodes.x.data(2)[i]);
  }
  return out;
}

}  // namespace

// The pressure p = ro g H of the weight makes the depth p V/(A SLSFAC SFS K), which goes to 0 with the size
// of elements; half where nodes of both sides push. At PENOPT 1 the softer of both solids counts: the
// block's.
TEST(PenaltyDepth, IsThatOfTheFormula) {
  constexpr Real K = E / 3, slsfac = 0.1;
  for (const int n : {2, 4, 8})
    for (const Real sfs : {1.0, 10.0}) {
      const Real depth = ro * g / (n * slsfac * sfs * K);
      const auto [least, most] = depths("ONE_WAY_", n, sfs, 4);
      EXPECT_NEAR(least / depth, 1, 0.01) << n << " " << sfs;
      EXPECT_NEAR(most / depth, 1, 0.01) << n << " " << sfs;
      const auto [both_least, both_most] = depths("", n, sfs, 1);
      EXPECT_NEAR(both_least / depth, 0.5, 0.005) << n << " " << sfs;
      EXPECT_NEAR(both_most / depth, 0.5, 0.005) << n << " " << sfs;
    }
}

}  // namespace courant::test::penalty_depth
