#include <gtest/gtest.h>

#include <numeric>

#include "contact/cards.hpp"
#include "keyword/registry.hpp"
#include "scene.hpp"

using namespace courant;
using courant::test::Scene;

namespace {

/// A wall (part 2) and two particles (part 1), one of them 4 mm inside the wall's contact distance of 10 mm.
struct Case {
  Scene scene;
  Deck deck;
  Model model;
  Diagnostics diagnostics;
  ContactCard card;

  Case() {
    scene.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0));
    scene.x = {Vec(0.05, 0.05, 0.006), Vec(0.05, 0.05, 0.05)};
    scene.build();
    scene.world.segments.part[0] = 1;
    for (Id id = 1; id <= 2; ++id) {
      ModelNode node;
      node.id = id;
      model.nodes.push_back(node);
      ModelPart part;
      part.id = id;
      part.has_sph = id == 1, part.has_shell = id == 2;
      model.part_of_id[id] = Index(model.parts.size());
      model.parts.push_back(part);
    }
    model.part_sets[5] = {0};
    model.node_sets[6] = {0};
    card.surfa = 1, card.surfatyp = 3, card.surfb = 2, card.surfbtyp = 3;
  }
  std::vector<std::shared_ptr<Contact>> build() {
    deck.store<ContactCard>() = {card};
    return build_contacts(deck, model, {.reach_margin = 0.01}, scene.world, diagnostics);
  }
  std::string failure() {
    EXPECT_TRUE(build().empty());
    EXPECT_GE(diagnostics.errors(), 1);
    return diagnostics.text();
  }
};

TEST(BuildContacts, ReportsInitialPenetration) {
  Case c;
  const auto contacts = c.build();
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_TRUE(c.diagnostics.ok());
  EXPECT_EQ(c.diagnostics.warnings(), 1);
  EXPECT_NE(c.diagnostics.text().find("1 initial penetrations, deepest 0.004 [L] at particle 1"),
            std::string::npos);
  EXPECT_EQ(c.scene.world.counters.at("initial_penetrations"), 1);
  EXPECT_EQ(c.scene.world.counters.at("leaked_particles"), 0);
}

TEST(BuildContacts, NodeSetTracksItsParticlesOnly) {
  Case c;
  c.card.surfa = 6, c.card.surfatyp = 4;
  ASSERT_EQ(c.build().size(), 1u);
  const auto* k = dynamic_cast<Field<Real>*>(c.scene.world.particles.fields.find("contact_1_stiffness"));
  ASSERT_NE(k, nullptr);
  EXPECT_GT((*k)[0], 0);
  EXPECT_EQ((*k)[1], 0);
}

TEST(BuildContacts, BoxesRestrictBothSidesAtTheStart) {
  const auto add_box = [](Case& c, const Vec& low, const Vec& high) {
    c.model.boxes[7].id = 7, c.model.boxes[7].low = low, c.model.boxes[7].high = high;
  };
  Case of_one;  // the particle that is not within the contact distance
  add_box(of_one, Vec(0, 0, 0.04), Vec(0.1, 0.1, 0.1));
  of_one.card.saboxid = 7;
  ASSERT_EQ(of_one.build().size(), 1u);
  EXPECT_EQ(of_one.diagnostics.text(), "");
  const auto& k =
      dynamic_cast<Field<Real>&>(*of_one.scene.world.particles.fields.find("contact_1_stiffness"));
  EXPECT_EQ(k[0], 0);
  EXPECT_GT(k[1], 0);
  Case of_none;
  add_box(of_none, Vec(1, 0, 0), Vec(2, 1, 1));
  of_none.card.saboxid = 7;
  EXPECT_TRUE(of_none.build().empty());
  EXPECT_NE(of_none.diagnostics.text().find("no particle of SURFA is in box 7"), std::string::npos);
  Case of_plate;
  add_box(of_plate, Vec(0, 0, 0), Vec(0.1, 0.1, 0));
  of_plate.card.sbboxid = 7;
  EXPECT_EQ(of_plate.build().size(), 1u);
  Case of_part;  // of the plate
  add_box(of_part, Vec(0, 0, 0), Vec(0.09, 0.1, 0));
  of_part.card.sbboxid = 7;
  EXPECT_TRUE(of_part.build().empty());
  EXPECT_NE(of_part.diagnostics.text().find("no face of SURFB is in box 7"), std::string::npos);
  for (Id ContactCard::*box : {&ContactCard::saboxid, &ContactCard::sbboxid}) {
    Case c;
    c.card.*box = 9;
    EXPECT_NE(c.failure().find("box 9 does not exist"), std::string::npos);
  }
}

TEST(BuildContacts, MissingSidesAreNamed) {
  Case a;
  a.card.surfa = 9, a.card.surfatyp = 4;
  EXPECT_NE(a.failure().find("node set 9 does not exist"), std::string::npos);
  Case b;
  b.card.surfb = 9;
  EXPECT_NE(b.failure().find("part 9 does not exist"), std::string::npos);
  Case c;
  c.card.surfb = 9, c.card.surfbtyp = 2;
  EXPECT_NE(c.failure().find("part set 9 does not exist"), std::string::npos);
  Case d;
  d.card.surfb = 1;
  EXPECT_NE(d.failure().find("part 1 has no shells and no solids"), std::string::npos);
  Case f;
  f.card.fs = 2;
  EXPECT_NE(f.failure().find("friction table"), std::string::npos);
}

TEST(BuildContacts, CardsAreRegistered) {
  for (const char* name :
       {"CONTACT_AUTOMATIC_NODES_TO_SURFACE", "CONTROL_CONTACT", "SECTION_SHELL", "MAT_RIGID"})
    EXPECT_FALSE(keyword_help(name).empty()) << name;
}

}  // namespace
