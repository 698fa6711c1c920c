// Nodes on edges: their order in the deck, and those that *ELEMENT_SOLID_H8TOH20 and _TET4TOTET10 add.
#include <gtest/gtest.h>

#include "quadratic_decks.hpp"

using namespace courant;

namespace nodes_on_edges_test {

using test::CellShape;
using test::do_nothing;
using test::quadratic;
using test::simulation_of;
using test::SolidDeck;

using NodesOnEdges = test::QuadraticSolids;
INSTANTIATE_TEST_SUITE_P(Of, NodesOnEdges, ::testing::Values(CellShape::tetrahedra, CellShape::hexahedron));

// Programs differ in the order of nodes 13 to 20: that near the middles of the edges counts, also where a
// mirror turns the lower face into the upper one.
TEST(QuadraticHexahedra, TakeTheirNodesInAnyOrderOfFours) {
  SolidDeck deck = quadratic(CellShape::hexahedron, "MAT_ELASTIC\n1,1.0,1.0,0.3");
  deck.block(Vec(1, 2, 3), 1, 1, 1, 1);
  const auto nodes_of = [](const std::string& text) {
    auto s = simulation_of(text);
    std::vector<Index> out;
    for (int c = 0; c < 20; ++c) out.push_back(s->world().groups.at(0)->node.data(c)[0]);
    return out;
  };
  const std::vector<Index> expected = nodes_of(deck.text(1));
  const auto word = [](int n) { return fmt::format("{:8}", n); };
  std::string swapped = "       1       1\n";
  const std::string given = deck.elements.substr(swapped.size());
  const auto at = [&](int k) { return given.substr(static_cast<std::size_t>(8 * k + (k >= 10)), 8); };
  for (int k = 0; k < 20; ++k) {
    const int from = k < 12 ? k : k < 16 ? k + 4 : k - 4;
    swapped += at(from) + (k == 9 || k == 19 ? "\n" : "");
  }
  EXPECT_NE(swapped, deck.elements);
  EXPECT_EQ(word(1), at(0));
  SolidDeck other = deck;
  other.elements = swapped;
  EXPECT_EQ(nodes_of(other.text(1)), expected);
}

// _H8TOH20 and _TET4TOTET10 are the meshes with the nodes written, and hold them as their ends are.
TEST_P(NodesOnEdges, GetNodesOnTheirEdges) {
  const auto deck_of = [&](bool written) {
    SolidDeck deck = solids("MAT_ELASTIC\n1,1.0,1.0,0.3");
    deck.on_edges = written;
    deck.keyword = tetrahedra() ? "*ELEMENT_SOLID_TET4TOTET10" : "*ELEMENT_SOLID_H8TOH20";
    deck.block(Vec(2, 1, 1), 2, 1, 1, 1);
    if (written) {
      deck.keyword = "*ELEMENT_SOLID";
      deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
    } else {
      deck.node_set(1, [](const Vec& x) { return x[0] < 1e-9; });
    }
    deck.cards +=
        "*BOUNDARY_SPC_SET\n1,0,1,1,1\n*INITIAL_VELOCITY_GENERATION\n1,2,0.5,0.1,0.2,0.3\n1.0,0.5,0.5,0.0,0."
        "0,1.0\n";
    return deck.text(1e9);
  };
  auto written = simulation_of(deck_of(true)), made = simulation_of(deck_of(false));
  ASSERT_TRUE(written && made);
  ASSERT_EQ(written->world().nodes.size(), made->world().nodes.size());
  for (int k = 0; k < 50; ++k) written->step(do_nothing), made->step(do_nothing);
  const auto sorted = [](const Simulation& s) {
    std::vector<std::array<Real, 3>> out;
    for (Index n = 0; n < s.world().nodes.size(); ++n) {
      const Vec x = s.world().nodes.x.vec(n);
      out.push_back({std::round(1e9 * x[0]), std::round(1e9 * x[1]), std::round(1e9 * x[2])});
    }
    std::sort(out.begin(), out.end());
    return out;
  };
  EXPECT_GT(written->clock().t, 0.5);
  EXPECT_EQ(sorted(*written), sorted(*made));
}

}  // namespace nodes_on_edges_test
