// What the cards of a contact make of thickness, stiffness and its law, each number by hand.
#include "contact/nodes/measures.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>

#include "state/shared_fields.hpp"

using namespace courant;

namespace {

/// A quadrilateral of 2 x 1 of a shell, the same of a rigid one, a triangle of a shell, and a face of a solid
/// of volume 6, of the parts 0 to 3.
struct Faces {
  World world;
  Deck deck;
  Model model;
  Diagnostics diagnostics;
  static constexpr Index shell = 0, rigid = 1, triangle = 2, solid = 3;

  explicit Faces(const std::string& cards) {
    ReadOptions options;
    options.open = [&](const std::string&) {
      return std::optional<std::string>("*KEYWORD\n" + cards + "*END\n");
    };
    deck = read_deck("m.k", options, diagnostics);
    EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
    world.nodes.fields.resize(4);
    const Vec x[] = {Vec(0, 0, 0), Vec(2, 0, 0), Vec(2, 1, 0), Vec(0, 1, 0)};
    for (Index n = 0; n < 4; ++n) world.nodes.x.set(n, x[n]);
    Segments& g = world.segments;
    g.fields.resize(4);
    for (Index s = 0; s < 4; ++s) {
      g.node0[s] = 0, g.node1[s] = 1, g.node2[s] = 2, g.node3[s] = s == triangle ? 2 : 3;
      g.thickness[s] = 0.3, g.K[s] = 7, g.part[s] = static_cast<int>(s), g.volume[s] = s == solid ? 6 : 0;
      ModelPart part;
      part.id = s + 1, part.rigid = s == rigid;
      model.parts.push_back(part);
    }
  }
  ContactMeasures measures() {
    ContactMeasures out(deck, model, 0.8, world, diagnostics);
    out.take(deck.all<ContactCard>().front());
    return out;
  }
};
std::string contact(const std::string& name, const std::string& third = "", const std::string& a = "",
                    const std::string& b = "", const std::string& c = "") {
  std::string out = "*CONTACT_" + name + "\n1,2,3,3\n0.5,0.3,11.0,13.0,17.0,,0.25,0.75\n";
  const std::string* cards[] = {&third, &a, &b, &c};
  for (const std::string* card : cards) out += *card + "\n";
  return out;
}

}  // namespace

TEST(ContactMeasures, TheLawHasEveryNumberOfItsCards) {
  Faces faces("*CONTROL_CONTACT\n0.19,,,,2,,,1\n" + contact("AUTOMATIC_SURFACE_TO_SURFACE",
                                                            "1.5,2.5,,,,,0.4,0.6", "1,0.23", ",,,,,,,",
                                                            ",,,0.125"));
  const NodeContactLaw law = faces.measures().law();
  EXPECT_EQ(law.slsfac, 0.19);
  EXPECT_EQ(law.penopt, 2);
  EXPECT_EQ(law.enmass, 1);
  EXPECT_EQ(law.sfs[0], 1.5);
  EXPECT_EQ(law.sfs[1], 2.5);
  EXPECT_DOUBLE_EQ(law.fs, 0.5 * 0.4);
  EXPECT_DOUBLE_EQ(law.fd, 0.3 * 0.4);
  EXPECT_EQ(law.dc, 11);
  EXPECT_DOUBLE_EQ(law.vc, 13 * 0.6);
  EXPECT_EQ(law.vdc, 17);
  EXPECT_EQ(law.birth, 0.25);
  EXPECT_EQ(law.death, 0.75);
  EXPECT_EQ(law.soft, 1);
  EXPECT_EQ(law.sofscl, 0.23);
  EXPECT_EQ(law.dtstif, 0.125);
  EXPECT_EQ(law.tssfac, 0.8);
  EXPECT_FALSE(law.with_edges);
  EXPECT_FALSE(law.single);
  Faces single(contact("AUTOMATIC_SINGLE_SURFACE", "", "2,,,,,5"));
  EXPECT_TRUE(single.measures().law().single);
  EXPECT_TRUE(single.measures().law().with_edges);
}

// Half of the thickness of a shell times the scale of its side, or half of SAST or SBST, which no scale
// meets; half of SLDTHK of a solid.
TEST(ContactMeasures, ThicknessesAreScaledByTheCardOfTheirSide) {
  Faces faces(contact("AUTOMATIC_SURFACE_TO_SURFACE", ",,,,0.5,0.25", ",,,,,,,", ",,,,,,0.08"));
  const ContactMeasures scaled = faces.measures();
  EXPECT_DOUBLE_EQ(scaled.half_thickness(0, Faces::shell), 0.5 * 0.3 * 0.5);
  EXPECT_DOUBLE_EQ(scaled.half_thickness(1, Faces::shell), 0.5 * 0.3 * 0.25);
  EXPECT_DOUBLE_EQ(scaled.half_thickness(1, Faces::rigid), 0.5 * 0.3 * 0.25);
  EXPECT_DOUBLE_EQ(scaled.half_thickness(0, Faces::solid), 0.04);
  EXPECT_DOUBLE_EQ(scaled.half_thickness(1, Faces::solid), 0.04);
  EXPECT_DOUBLE_EQ(scaled.beam_radius(0, std::numbers::pi * 0.09), 0.5 * 0.3);
  Faces with_own(contact("AUTOMATIC_SURFACE_TO_SURFACE", ",,0.2,0.6,0.5,0.25"));
  const ContactMeasures given = with_own.measures();
  EXPECT_DOUBLE_EQ(given.half_thickness(0, Faces::shell), 0.1);
  EXPECT_DOUBLE_EQ(given.half_thickness(1, Faces::shell), 0.3);
  EXPECT_EQ(given.half_thickness(0, Faces::solid), 0);
  EXPECT_DOUBLE_EQ(given.beam_radius(0, std::numbers::pi * 0.09), 0.1);
}

// OPTT of *PART_CONTACT is the thickness of shells, and of beams their diameter; SAST and SBST go before it.
TEST(ContactMeasures, PartsMayHaveAThicknessOfTheirOwn) {
  for (const bool given : {false, true}) {
    Faces faces(contact("AUTOMATIC_SINGLE_SURFACE", given ? ",,2.4,2.4,3.0,3.0" : ",,,,3.0,3.0"));
    faces.model.parts[0].optt = 0.7;
    shared_fields::contact_thickness.add(faces.world.segments.fields)[Faces::shell] = 0.7;
    const ContactMeasures m = faces.measures();
    EXPECT_DOUBLE_EQ(m.half_thickness(0, Faces::shell), given ? 1.2 : 0.5 * 0.7 * 3);
    EXPECT_DOUBLE_EQ(m.half_thickness(0, Faces::triangle), given ? 1.2 : 0.2);  // of the part without OPTT
    EXPECT_DOUBLE_EQ(m.beam_radius(0, 5), given ? 1.2 : 0.35 * 3);
  }
}

// 0.4 of the shortest edge, 1, in single surface contacts unless SSTHK is 1.
TEST(ContactMeasures, SingleSurfacesAreThinBesideTheirShortestEdge) {
  for (const auto& [control, name, expected] :
       {std::tuple{"0", "AUTOMATIC_SINGLE_SURFACE", 0.4}, std::tuple{"1", "AUTOMATIC_SINGLE_SURFACE", 0.9},
        std::tuple{"0", "AUTOMATIC_SURFACE_TO_SURFACE", 0.9}}) {
    Faces faces(std::string("*CONTROL_CONTACT\n,\n,,,,,") + control + "\n" + contact(name, ",,,,3.0,3.0"));
    EXPECT_DOUBLE_EQ(faces.measures().half_thickness(0, Faces::shell), 0.5 * expected) << name << control;
    EXPECT_DOUBLE_EQ(faces.measures().half_thickness(0, Faces::triangle), 0.5 * expected) << name << control;
  }
}

// Contacts that are not automatic: SHLTHK of the control, or with THKOPT 1 that of the card: 0 none, 1 but of
// rigid shells, 2 all; THKOPT 2 none.
TEST(ContactMeasures, OneSidedContactsCountThicknessByShlthk) {
  for (const int of_control : {0, 1, 2})
    for (const int thkopt : {0, 1, 2})
      for (const int of_card : {0, 1, 2}) {
        const int which = thkopt == 2 ? 0 : thkopt == 1 ? of_card : of_control;
        Faces faces("*CONTROL_CONTACT\n,,," + std::to_string(of_control) + "\n" +
                    contact("SURFACE_TO_SURFACE", "", ",,,,,,,",
                            "," + std::to_string(thkopt) + "," + std::to_string(of_card)));
        const ContactMeasures m = faces.measures();
        EXPECT_DOUBLE_EQ(m.half_thickness(0, Faces::shell), which >= 1 ? 0.15 : 0);
        EXPECT_DOUBLE_EQ(m.half_thickness(0, Faces::rigid), which == 2 ? 0.15 : 0);
      }
}

// K A^2/V of a solid, SLDSTF instead of K; K A over the longest diagonal of a shell, of a triangle its
// edge.
TEST(ContactMeasures, StiffnessIsThatOfWhatLiesBehindTheFace) {
  for (const bool own : {false, true}) {
    Faces faces(contact("AUTOMATIC_SURFACE_TO_SURFACE", "", ",,,,,,,", own ? ",,,,,,,29.0" : ""));
    faces.world.nodes.x.set(1, Vec(2.5, 0, 0));  // diagonals of sqrt(5) and sqrt(7.25)
    const ContactMeasures m = faces.measures();
    EXPECT_DOUBLE_EQ(m.stiffness(Faces::solid, 2.25), (own ? 29 : 7) * 2.25 * 2.25 / 6);
    EXPECT_DOUBLE_EQ(m.stiffness(Faces::shell, 2.25), 7 * 2.25 / std::sqrt(7.25));
    EXPECT_DOUBLE_EQ(m.stiffness(Faces::triangle, 1.25), 7 * 1.25 / 2.5);
  }
}
