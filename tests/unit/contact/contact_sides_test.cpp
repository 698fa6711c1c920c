// Which nodes and faces the fields of a contact name: parts, sets, boxes, planes of symmetry.
#include <gtest/gtest.h>

#include "../../verification/structures/solid_decks.hpp"
#include "contact/nodes/node_contact.hpp"

using namespace courant;

namespace contact_sides_test {
namespace {

using test::simulation_of;
using test::SolidDeck;

/// A block of 2 x 1 x 1 of part 1, nodes 1 to 12, and a cube of side 1 of part 2 a bit above its left half,
/// nodes 13 to 20, whose node at the origin of both falls.
std::unique_ptr<Simulation> blocks(const std::string& contact, bool on_symmetry = false) {
  SolidDeck deck;
  deck.block(Vec(2, 1, 1), 2, 1, 1, 1);
  deck.block(Vec(1, 1, 1), 1, 1, 1, 2, [](const Vec& x) { return Vec(x + Vec(0, 0, 1.01)); });
  deck.cards =
      "*SECTION_SOLID\n1,1\n*PART\nlower\n1,1,1\n*PART\nupper\n2,1,1\n*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n"
      "*SET_PART\n5\n2\n*SET_PART\n6\n1,2\n*SET_SEGMENT\n5\n13,14,16,15\n*SET_NODE_LIST\n5\n13,14,16\n"
      "*DEFINE_BOX\n3,-1.0,3.0,-1.0,2.0,1.5,9.0\n*DEFINE_BOX\n4,-1.0,1.5,-1.0,2.0,0.5,1.1\n" +
      contact;
  if (on_symmetry) {
    deck.node_set(9, [](const Vec& x) { return x[2] > 1 && x[2] < 1.1; });
    deck.cards += "*BOUNDARY_SPC_SET\n9,0,0,0,1\n";
  }
  return simulation_of(deck.text(1));
}
Index tracked(const std::string& contact) {
  const auto s = blocks(contact);
  Index out = 0;
  for (const auto* one : s->world().passes.all<const NodeContact>()) out += one->tracked();
  return out;
}

}  // namespace

// Nodes of SURFA meet faces of SURFB, and those of SURFB faces of SURFA; NODES_TO_SURFACE only the first.
// Faces count with all corners in the box.
TEST(ContactSidesOfCards, AreThoseThatTheFieldsName) {
  struct Case {
    std::string name, fields;
    Index nodes;
  };
  const std::string both = "AUTOMATIC_SURFACE_TO_SURFACE", one = "AUTOMATIC_NODES_TO_SURFACE";
  for (const Case& c : {Case{both, "2,1,3,3", 8 + 12},
                        {both, "5,1,2,3", 8 + 12},
                        {both, "5,1,0,3", 4 + 12},
                        {both, "1,2,3,3", 12 + 8},
                        {both, "2,1,3,3,3,0", 4 + 12},
                        {both, "2,1,3,3,0,4", 8 + 4},
                        {one, "2,1,3,3", 8},
                        {one, "5,1,4,3", 3},
                        {one, "1,2,3,3", 12},
                        {one, "2,1,3,3,3,0", 4}})
    EXPECT_EQ(tracked("*CONTACT_" + c.name + "\n" + c.fields + "\n0.0\n1.0\n"), c.nodes)
        << c.name << c.fields;
  EXPECT_EQ(tracked("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0,0\n0.0\n1.0\n"), 20);
  EXPECT_EQ(tracked("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n2,0,3\n0.0\n1.0\n"), 8);
  EXPECT_EQ(tracked("*CONTACT_AUTOMATIC_SINGLE_SURFACE\n6,0,2\n0.0\n1.0\n"), 20);
}

// The cube falls onto the block: where its lower face counts it is stopped, else it goes on.
TEST(ContactSidesOfCards, NodesOfTheSetAreHeld) {
  for (const auto& [fields, holds] :
       {std::pair("2,1,3,3", true), {"5,1,0,3", true}, {"2,1,3,3,3,0", false}, {"2,1,3,3,0,4", true}}) {
    auto s = blocks(std::string("*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n") + fields +
                    "\n0.0\n1.0\n*INITIAL_VELOCITY_GENERATION\n2,2,0.0,0.0,0.0,-1.0\n0.0\n");
    ASSERT_NE(s, nullptr) << fields;
    Real force = 0;
    while (s->clock().t < 0.02)
      s->step([&](World& world, const Clock&, const std::string&) {
        for (auto* one : world.passes.all<NodeContact>()) force = std::max(force, one->report().on_surfa[2]);
      });
    EXPECT_EQ(force > 1, holds) << fields;
  }
}

}  // namespace contact_sides_test
