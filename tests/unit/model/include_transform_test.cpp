// One scene written in metres, and the same scene as an included file in other units, with other ids, moved
// back into place: both must build to the same model and the same world.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../keyword/decks_in_memory.hpp"
#include "app/run/simulation.hpp"
#include "contact/cards.hpp"
#include "model/build_model.hpp"
#include "model/cards.hpp"
#include "model/sets/set_cards.hpp"
#include "model/transforms/included_entries.hpp"
#include "rigid/bodies/mat_rigid.hpp"
#include "sph/cards.hpp"
#include "transformed_scene.hpp"

namespace courant {

namespace {

constexpr Real tolerance = 1e-12;

const std::string control = "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*CONTROL_SPH\n, , , 3\n";

std::string include_transform(const std::string& file, const Writing& w, Id tranid) {
  const IdOffsets& o = w.offsets;
  return fmt::format(
      "*INCLUDE_TRANSFORM\n{}\n{}, {}, {}, {}, {}, {}, {}\n{}\n{:.17g}, {:.17g}, {:.17g}\n{}\n", file, o.node,
      o.element, o.part, o.material, o.set, o.curve, o.definition, o.other, w.units.mass, w.units.time,
      w.units.length, tranid);
}

std::string number_list(const Affine& m) {
  std::string out = "MATRIX\n";
  for (int row = 0; row < 4; ++row) {
    for (int k = 0; k < 3; ++k)
      out += fmt::format("{:.17g}, ", row < 3 ? m.linear()(k, row) : m.translation()[k]);
    out += fmt::format("{}{}", row < 3 ? 0 : 1, row % 2 == 0 ? ", " : "\n");
  }
  return out;
}

struct Built {
  Deck deck;
  Model model;
  std::unique_ptr<Simulation> simulation;
};

/// The deck main.k, its files moved.
Deck moved_deck(DecksInMemory& decks, Diagnostics& diagnostics) {
  Deck deck = decks.read("main.k", diagnostics);
  move_included_entries(deck, diagnostics);
  return deck;
}
Model model_of(DecksInMemory decks, Diagnostics& diagnostics) {
  return build_model(moved_deck(decks, diagnostics), diagnostics);
}

Built built(DecksInMemory decks) {
  Built out;
  Diagnostics diagnostics;
  out.deck = moved_deck(decks, diagnostics);
  out.model = build_model(out.deck, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  Diagnostics again;
  out.simulation = Simulation::build("main.k", decks.options(), again);
  EXPECT_EQ(again.text(), "");
  return out;
}

void expect_near(Real a, Real b, const char* what) {
  EXPECT_LE(std::abs(a - b), tolerance * std::max({Real(1), std::abs(a), std::abs(b)}))
      << what << " " << a << " " << b;
}

void expect_near(const Vec& a, const Vec& b, const char* what) {
  EXPECT_LT((a - b).norm(), tolerance * std::max(Real(1), a.norm()))
      << what << " " << a.transpose() << ", " << b.transpose();
}

void expect_same_mesh(const Model& a, const Model& b) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t n = 0; n < a.nodes.size(); ++n) {
    EXPECT_EQ(a.nodes[n].id, b.nodes[n].id);
    expect_near(a.nodes[n].x, b.nodes[n].x, "x");
    expect_near(a.nodes[n].v, b.nodes[n].v, "v");
    EXPECT_EQ(a.nodes[n].fixed, b.nodes[n].fixed) << a.nodes[n].id;
  }
  ASSERT_EQ(a.sph.size(), b.sph.size());
  for (std::size_t i = 0; i < a.sph.size(); ++i) {
    EXPECT_EQ(a.sph[i].node, b.sph[i].node);
    expect_near(a.sph[i].mass, b.sph[i].mass, "mass");
  }
  ASSERT_EQ(a.shells.size(), b.shells.size());
  for (std::size_t i = 0; i < a.shells.size(); ++i) {
    EXPECT_EQ(a.shells[i].id, b.shells[i].id);
    EXPECT_EQ(a.shells[i].node, b.shells[i].node);
  }
}

void expect_same_definitions(const Model& a, const Model& b) {
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t p = 0; p < a.parts.size(); ++p) {
    EXPECT_EQ(a.parts[p].id, b.parts[p].id);
    EXPECT_EQ(a.parts[p].secid, b.parts[p].secid);
    EXPECT_EQ(a.parts[p].mid, b.parts[p].mid);
    EXPECT_EQ(a.parts[p].eosid, b.parts[p].eosid);
    EXPECT_EQ(a.parts[p].hgid, b.parts[p].hgid);
  }
  EXPECT_EQ(a.node_sets, b.node_sets);
  EXPECT_EQ(a.part_sets, b.part_sets);
  ASSERT_EQ(a.boxes.size(), b.boxes.size());
  for (const auto& [id, box] : a.boxes) {
    expect_near(box.low, b.boxes.at(id).low, "low");
    expect_near(box.high, b.boxes.at(id).high, "high");
  }
  ASSERT_EQ(a.body_loads.size(), b.body_loads.size());
  for (std::size_t i = 0; i < a.body_loads.size(); ++i)
    for (const Real t : {0.0, 1.0, 5.0})
      expect_near(a.body_loads[i].sf * a.body_loads[i].curve(t),
                  b.body_loads[i].sf * b.body_loads[i].curve(t), "load");
  EXPECT_EQ(a.output.history_sph, b.output.history_sph);
  expect_near(a.output.history("glstat").interval, b.output.history("glstat").interval, "glstat");
  expect_near(a.endtim, b.endtim, "endtim");
}

void expect_same_world(Simulation& a, Simulation& b) {
  const Particles &p = a.world().particles, &q = b.world().particles;
  ASSERT_EQ(p.size(), q.size());
  std::map<Id, Index> of;
  for (Index i = 0; i < q.size(); ++i) of[q.id[i]] = i;
  for (Index i = 0; i < p.size(); ++i) {
    const Index j = of.at(p.id[i]);
    expect_near(p.x.vec(i), q.x.vec(j), "x");
    expect_near(p.v.vec(i), q.v.vec(j), "v");
    expect_near(p.m[i], q.m[j], "m");
    expect_near(p.rho[i], q.rho[j], "rho");
    expect_near(p.h[i], q.h[j], "h");
    expect_near(p.c[i], q.c[j], "c");
  }
  ASSERT_EQ(a.world().nodes.size(), b.world().nodes.size());
  for (Index n = 0; n < a.world().nodes.size(); ++n) {
    EXPECT_EQ(a.world().nodes.id[n], b.world().nodes.id[n]);
    expect_near(a.world().nodes.m[n], b.world().nodes.m[n], "node mass");
    expect_near(a.world().nodes.v.vec(n), b.world().nodes.v.vec(n), "node velocity");
  }
  std::string set_by, also_by;
  a.evaluate(set_by);
  b.evaluate(also_by);
  EXPECT_EQ(set_by, also_by);
  EXPECT_NEAR(a.clock().dt, b.clock().dt, 1e-10 * a.clock().dt);
}

void expect_same_cards(const Deck& a, const Deck& b) {
  const auto &c = a.all<ContactCard>()[0], &d = b.all<ContactCard>()[0];
  EXPECT_EQ(c.cid, d.cid);
  EXPECT_EQ(c.surfa, d.surfa);
  EXPECT_EQ(c.surfb, d.surfb);
  expect_near(c.dc, d.dc, "DC");
  expect_near(c.vc, d.vc, "VC");
  expect_near(c.sast, d.sast, "SAST");
  EXPECT_EQ(c.dt, d.dt);  // never
  EXPECT_EQ(a.all<SectionSph>()[0].death, b.all<SectionSph>()[0].death);
  const auto &m = a.all<MatRigid>()[0], &n = b.all<MatRigid>()[0];
  expect_near(m.E, n.E, "E");
  EXPECT_EQ(m.con1, n.con1);
  EXPECT_EQ(m.con2, n.con2);
}

/// `main` includes the scene as `w` writes it.
void expect_same_scene(const Writing& w, const std::string& main,
                       std::map<std::string, std::string> files = {}) {
  const Built plain = built({{{"main.k", control + scene({.along_axes = w.along_axes}) + "*END\n"}}});
  files["main.k"] = control + main + "*END\n";
  files["scene.k"] = scene(w);
  const Built included = built({files});
  expect_same_mesh(plain.model, included.model);
  expect_same_definitions(plain.model, included.model);
  expect_same_cards(plain.deck, included.deck);
  ASSERT_TRUE(plain.simulation && included.simulation);
  expect_same_world(*plain.simulation, *included.simulation);
}

const IdOffsets offsets{.node = 9000,
                        .element = 7000,
                        .part = 800,
                        .material = 500,
                        .set = 400,
                        .curve = 200,
                        .definition = 300,
                        .other = 600};
const UnitFactors mm_t_s{.mass = 1000, .time = 1, .length = 1e-3};
const UnitFactors mm_kg_ms{.mass = 1, .time = 1e-3, .length = 1e-3};

Affine turned(const Vec& axis, Real degrees, const Vec& centre = Vec::Zero()) {
  const Matrix m = Eigen::AngleAxisd(degrees * pi / 180, axis.normalized()).toRotationMatrix();
  Affine out = Affine::Identity();
  out.linear() = m;
  out.translation() = centre - m * centre;
  return out;
}

}  // namespace

TEST(IncludeTransform, ShiftsIds) {
  const Writing w{.offsets = offsets};
  expect_same_scene(w, include_transform("scene.k", w, 0));
}

TEST(IncludeTransform, ShiftsIdsByTheTypeBesideThem) {
  std::string text;
  for (const int styp : {1, 2, 3}) text += fmt::format("*INITIAL_VELOCITY_GENERATION\n5, {}\n\n", styp);
  for (const int type : {2, 3, 4, 5})
    text += fmt::format("*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n{}, 5, {}, {}\n\n\n", type == 5 ? 0 : 5, type,
                        type == 2 ? 2 : 3);
  DecksInMemory decks{
      {{"main.k", "*KEYWORD\n*INCLUDE_TRANSFORM\na.k\n1000, 0, 200, 0, 30\n*END\n"}, {"a.k", text}}};
  Diagnostics diagnostics;
  const Deck deck = decks.read("main.k", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  const auto& velocities = deck.all<InitialVelocityGenerationCard>();
  ASSERT_EQ(velocities.size(), 3u);
  EXPECT_EQ(velocities[0].id, 35);   // part set
  EXPECT_EQ(velocities[1].id, 205);  // part
  EXPECT_EQ(velocities[2].id, 35);   // node set
  const auto& contacts = deck.all<ContactCard>();
  ASSERT_EQ(contacts.size(), 4u);
  EXPECT_EQ(contacts[0].surfa, 35);
  EXPECT_EQ(contacts[0].surfb, 35);
  EXPECT_EQ(contacts[1].surfa, 205);
  EXPECT_EQ(contacts[1].surfb, 205);
  EXPECT_EQ(contacts[2].surfa, 35);
  EXPECT_EQ(contacts[3].surfa, 0);
}

TEST(IncludeTransform, ShiftsRangesOfParticles) {
  DecksInMemory decks{{{"main.k", "*KEYWORD\n*INCLUDE_TRANSFORM\na.k\n1000, 0, 200\n*END\n"},
                       {"a.k", "*ELEMENT_SPH\n1, 2, 3.0, 9\n*SET_NODE_GENERATE\n7\n1, 9, 21, 29\n"}}};
  Diagnostics diagnostics;
  const Deck deck = decks.read("main.k", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(deck.all<ElementSphCard>().size(), 1u);
  EXPECT_EQ(deck.all<ElementSphCard>()[0].nid, 1001);
  EXPECT_EQ(deck.all<ElementSphCard>()[0].nend, 1009);
  EXPECT_EQ(deck.all<ElementSphCard>()[0].pid, 202);
  EXPECT_EQ((deck.all<SetCardOf<SetKind::node, SetForm::generate>>()[0].ids),
            (std::vector<Id>{1001, 1009, 1021, 1029}));
}

TEST(IncludeTransform, ChangesUnits) {
  for (const UnitFactors& units : {mm_t_s, mm_kg_ms, UnitFactors{.mass = 3, .time = 7, .length = 11}}) {
    const Writing w{.units = units};
    expect_same_scene(w, include_transform("scene.k", w, 0));
  }
}

TEST(IncludeTransform, DoesBothAndReadsFixedColumns) {
  const Writing w{.units = mm_t_s, .offsets = offsets};
  expect_same_scene(w,
                    "*INCLUDE_TRANSFORM\nscene.k\n"
                    "      9000      7000       800       500       400       200       300\n"
                    "       600\n"
                    "    1000.0       1.0     0.001\n");
}

TEST(IncludeTransform, ReadsLongFields) {
  const Writing w{.units = mm_t_s, .offsets = {.node = 9000, .part = 800}};
  expect_same_scene(w,
                    "*INCLUDE_TRANSFORM+\nscene.k\n"
                    "                9000                   0                 800\n\n"
                    "              1000.0                 1.0               0.001\n\n");
}

TEST(IncludeTransform, Translates) {
  const Writing w{.moved = Affine(Eigen::Translation3d(5, -6, 7))};
  expect_same_scene(
      w, "*DEFINE_TRANSFORMATION\n1\nTRANSL, 5.0, -6.0, 7.0\n" + include_transform("scene.k", w, 1));
}

TEST(IncludeTransform, TakesATransformationThatStandsFurtherDown) {
  const Writing w{.moved = Affine(Eigen::Translation3d(5, -6, 7))};
  expect_same_scene(
      w, include_transform("scene.k", w, 1) + "*DEFINE_TRANSFORMATION\n1\nTRANSL, 5.0, -6.0, 7.0\n");
}

TEST(IncludeTransform, TurnsByQuarters) {
  const Writing w{.moved = turned({0, 0, 1}, 90, {1, 2, 3})};
  expect_same_scene(w, "*DEFINE_TRANSFORMATION\n1\nROTATE, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, 90.0\n" +
                           include_transform("scene.k", w, 1) + "$\n");
}

TEST(IncludeTransform, TurnsByAnyAngleWhatIsNotBoundToAxes) {
  const Writing w{.moved = turned({1, 2, -1}, 37, {1, 2, 3}), .along_axes = false};
  const std::string main = "*DEFINE_TRANSFORMATION\n1\nROTATE, 1.0, 2.0, -1.0, 1.0, 2.0, 3.0, 37.0\n" +
                           include_transform("scene.k", w, 1);
  Built plain = built({{{"main.k", control + scene({.along_axes = false}) + "*END\n"}}});
  Diagnostics diagnostics;
  DecksInMemory decks{{{"main.k", control + main + "*END\n"}, {"scene.k", scene(w)}}};
  expect_same_mesh(plain.model, model_of(decks, diagnostics));
  EXPECT_EQ(diagnostics.text(),
            "scene.k:76:1: warning: *LOAD_BODY_Z: the load stays along the global axis, although its file is "
            "turned "
            "by a transformation\n  included from main.k:10\n");
}

TEST(IncludeTransform, Mirrors) {
  Affine mirror = Affine::Identity();
  mirror.linear()(0, 0) = -1;
  mirror.translation()[0] = 3;  // plane x = 1.5
  const Writing w{.moved = mirror};
  expect_same_scene(w, "*DEFINE_TRANSFORMATION\n1\nMIRROR, 1.5, 0.0, 0.0, 4.0, 0.0, 0.0\n" +
                           include_transform("scene.k", w, 1));
}

TEST(IncludeTransform, DoesEverythingAtOnce) {
  const Writing w{.units = mm_t_s,
                  .offsets = offsets,
                  .moved = Affine(Eigen::Translation3d(0, 3, 0)) * turned({0, 0, 1}, 180)};
  expect_same_scene(
      w, "*DEFINE_TRANSFORMATION\n1\nROTATE, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 180.0\nTRANSL, 0.0, 3.0\n" +
             include_transform("scene.k", w, 1));
}

TEST(IncludeTransform, TakesPlainIncludesOfATransformedFile) {
  const Writing w{.units = mm_t_s, .offsets = offsets, .moved = Affine(Eigen::Translation3d(0, 3, 0))};
  expect_same_scene(w, "*DEFINE_TRANSFORMATION\n1\nTRANSL, 0.0, 3.0\n" + include_transform("outer.k", w, 1),
                    {{"outer.k", "*INCLUDE\nscene.k\n"}});
}

TEST(IncludeTransform, ComposesWhenNested) {
  // the inner file is in mm, turned and shifted by the outer one, which is in km and is shifted by the deck
  const UnitFactors km{.mass = 1, .time = 1, .length = 1000};
  const Affine inner = turned({0, 0, 1}, 90, {2000, 0, 0}), outer(Eigen::Translation3d(5, -6, 7));
  Writing in{.units = {.mass = 1000, .time = 1, .length = 1e-6},
             .offsets = {.node = 4000, .part = 100, .set = 50}};
  Writing out{.units = km,
              .offsets = {.node = 5000,
                          .element = 7000,
                          .part = 700,
                          .material = 500,
                          .set = 350,
                          .curve = 200,
                          .definition = 300,
                          .other = 600}};
  const Writing whole{
      .units = {.mass = 1000, .time = 1, .length = 1e-3}, .offsets = offsets, .moved = outer * inner};
  // transformation 2 is in the outer file: its centre is given in km, its id is shifted by IDDOFF
  expect_same_scene(
      whole, "*DEFINE_TRANSFORMATION\n1\nTRANSL, 5.0, -6.0, 7.0\n" + include_transform("outer.k", out, 1),
      {{"outer.k", "*DEFINE_TRANSFORMATION\n2\nROTATE, 0.0, 0.0, 1.0, 2.0, 0.0, 0.0, 90.0\n" +
                       include_transform("scene.k", in, 2)}});
}

TEST(IncludeTransform, TakesTheSameFileTwice) {
  DecksInMemory decks{{{"main.k", control +
                                      "*DEFINE_TRANSFORMATION\n1\nTRANSL, 10.0\n"
                                      "*INCLUDE\nscene.k\n*INCLUDE_TRANSFORM\nagain.k\n20000, 20000, 1000\n" +
                                      "0\n\n1\n*END\n"},
                       {"scene.k", scene({})},
                       {"again.k", mesh({})}}};
  // parts 1801 and 1802 do not exist: the copy needs its own
  Diagnostics diagnostics;
  const Deck deck = moved_deck(decks, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  build_model(deck, diagnostics);
  EXPECT_NE(diagnostics.text().find("part 1801 does not exist"), std::string::npos);
  decks.files["again.k"] += "*PART\ncopy\n801, 601, 501, 502, 602\n*PART\ncopy\n802, 603, 503\n";
  const Built twice = built(decks);
  ASSERT_EQ(twice.model.nodes.size(), 24u);
  EXPECT_EQ(twice.model.nodes[12].id, 29001);
  expect_near(twice.model.nodes[12].x, twice.model.nodes[0].x + Vec(10, 0, 0), "x");
  EXPECT_EQ(twice.model.sph.size(), 16u);
}

TEST(IncludeTransform, AddsPrefixAndSuffixToTitles) {
  DecksInMemory decks{{{"main.k", "*KEYWORD\n*INCLUDE_TRANSFORM\nouter.k\n\n, , left, 2\n*END\n"},
                       {"outer.k", "*INCLUDE_TRANSFORM\nparts.k\n\n                    deep      1\n"},
                       {"parts.k", "*PART\nwater\n1, 1, 1\n"}}};
  Diagnostics diagnostics;
  const Deck deck = decks.read("main.k", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(deck.all<PartCard>().size(), 1u);
  EXPECT_EQ(deck.all<PartCard>()[0].title, "left.deep.water.1.2");
}

TEST(IncludeTransform, TakesAFactorOfTemperatureThatChangesNothing) {
  DecksInMemory decks{
      {{"main.k",
        "*KEYWORD\n*INCLUDE_TRANSFORM\nmesh.k\n\n\n       1.0       1.0       1.0       1.0         1\n"
        "*INCLUDE_TRANSFORM\nmesh.k\n         1\n\n                                 2.0\n*END\n"},
       {"mesh.k", "*NODE\n1, 500.0\n"}}};
  Diagnostics diagnostics;
  decks.read("main.k", diagnostics);
  EXPECT_EQ(diagnostics.text(),
            "main.k:11:34: error: *INCLUDE_TRANSFORM card 4 field 4 (FCTTEM, change of temperature scale; "
            "only none "
            "(blank, 0 or 1) [-]): '2.0' is not supported\n  hint: leave the field blank\n");
}

TEST(IncludeTransform, TakesParameters) {
  DecksInMemory decks{{{"main.k",
                        "*KEYWORD\n*PARAMETER\nI shift, 100\nR mm, "
                        "0.001\n*INCLUDE_TRANSFORM\nmesh.k\n&shift\n\n, , &mm\n*END\n"},
                       {"mesh.k", "*NODE\n1, 500.0\n"}}};
  Diagnostics diagnostics;
  const Deck deck = decks.read("main.k", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(deck.all<NodeCard>().size(), 1u);
  EXPECT_EQ(deck.all<NodeCard>()[0].nid, 101);
  EXPECT_EQ(deck.all<NodeCard>()[0].x, 0.5);
}

TEST(IncludeTransform, ScalesGeometryWithoutParticles) {
  DecksInMemory decks{
      {{"main.k",
        "*KEYWORD\n*DEFINE_TRANSFORMATION\n1\nSCALE, 2.0, 3.0, "
        "1.0\n*INCLUDE_TRANSFORM\nmesh.k\n\n\n\n1\n*END\n"},
       {"mesh.k", "*NODE\n1, 1.0, 1.0, 1.0, 3\n*DEFINE_BOX\n1, 0.0, 1.0, -1.0, 1.0, 5.0, 6.0\n"}}};
  Diagnostics diagnostics;
  const Deck deck = moved_deck(decks, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  EXPECT_EQ(deck.all<NodeCard>()[0].x, 2);
  EXPECT_EQ(deck.all<NodeCard>()[0].y, 3);
  EXPECT_EQ(deck.all<NodeCard>()[0].tc, 3);
  EXPECT_EQ(deck.all<DefineBoxCard>()[0].xmx, 2);
  EXPECT_EQ(deck.all<DefineBoxCard>()[0].ymn, -3);
}

TEST(NodeTransform, MovesTheNodesOfASetAndWhatStandsOnThem) {
  const Affine moved = Affine(Eigen::Translation3d(5, -6, 7)) * turned({0, 0, 1}, 90);
  Writing w{.moved = Affine::Identity()};
  std::string text = scene(w);
  Built plain = built({{{"main.k", control + text + "*END\n"}}});
  Built out =
      built({{{"main.k", control + text +
                             "*DEFINE_TRANSFORMATION\n1\nROTATE, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 90.0\nTRANSL, "
                             "5.0, -6.0, 7.0\n*NODE_TRANSFORM\n1, 401\n*END\n"}}});
  for (std::size_t n = 0; n < plain.model.nodes.size(); ++n) {
    const bool in_set = plain.model.nodes[n].id == 9002 || plain.model.nodes[n].id == 9005;
    const Vec x = plain.model.nodes[n].x;
    expect_near(in_set ? Vec(moved * x) : x, out.model.nodes[n].x, "x");
    if (!in_set) expect_near(plain.model.nodes[n].v, out.model.nodes[n].v, "v");
  }
}

TEST(NodeTransform, CountsInTheFrameOfItsFile) {
  // the file is turned by a quarter about z: what it moves along its x moves along the deck's y
  DecksInMemory decks{
      {{"main.k",
        "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*DEFINE_TRANSFORMATION\n1\nROTATE, 0.0, 0.0, 1.0, 4.0, "
        "0.0, 0.0, 90.0\n*INCLUDE_TRANSFORM\nmesh.k\n\n\n, , 0.5\n1\n*END\n"},
       {"mesh.k",
        "*NODE\n1, 10.0\n2, 10.0\n*SET_NODE\n1\n2\n*DEFINE_TRANSFORMATION\n2\nTRANSL, 6.0\n"
        "*NODE_TRANSFORM\n2, 1, 1\n"}}};
  Diagnostics diagnostics;
  const Model model = model_of(decks, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  expect_near(model.nodes[0].x, Vec(4, 1, 0), "kept");
  expect_near(model.nodes[1].x, Vec(4, 4, 0), "moved");
}

TEST(IncludeTransform, MovesManyNodesQuickly) {
  // 20 000 nodes: no search per node
  std::string nodes = "*NODE\n";
  for (int k = 1; k <= 20000; ++k) nodes += fmt::format("{:8}{:16.6f}{:16.6f}\n", k, 0.1 * k, 1.0);
  DecksInMemory decks{
      {{"main.k", "*KEYWORD\n*DEFINE_TRANSFORMATION\n1\n" + number_list(turned({1, 0, 0}, 20)) +
                      "*INCLUDE_TRANSFORM\nmesh.k\n\n\n\n1\n*END\n"},
       {"mesh.k", nodes}}};
  Diagnostics diagnostics;
  const Deck deck = moved_deck(decks, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  const NodeCard& last = deck.all<NodeCard>().back();
  expect_near(Vec(last.x, last.y, last.z), turned({1, 0, 0}, 20) * Vec(2000, 1, 0), "x");
}

TEST(NodeTransform, TakesAlongSystemsAndVectorsOfItsNodes) {
  DecksInMemory decks{
      {{"main.k", control + "*NODE\n1, 1.0\n2, 2.0\n3, 1.0, 1.0\n*SET_NODE\n1\n1, 2, 3\n"
                            "*DEFINE_COORDINATE_NODES\n7, 1, 2, 3\n*DEFINE_VECTOR_NODES\n2, 1, 2\n"
                            "*DEFINE_TRANSFORMATION\n1\nROTATE, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, "
                            "90.0\n*NODE_TRANSFORM\n1, 1\n*END\n"}}};
  Diagnostics diagnostics;
  const Model model = model_of(decks, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  const CoordinateSystem& system = model.coordinate_systems.at(7);
  expect_near(system.origin, Vec(0, 1, 0), "origin");
  expect_near(system.axes.col(0), Vec(0, 1, 0), "x axis");
  expect_near(system.axes.col(1), Vec(-1, 0, 0), "y axis");
  expect_near(model.vectors.at(2).head, Vec(0, 2, 0), "head");
}

/// Places in a system move with the system, once.
TEST(IncludeTransform, PlacesInASystemMoveOnce) {
  const std::string system = "*DEFINE_COORDINATE_VECTOR\n7, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0\n",
                    vector = "*DEFINE_VECTOR\n1, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 7\n",
                    points = "*DEFINE_COORDINATE_SYSTEM\n8, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 7\n0.0, 1.0, 0.0\n";
  const auto built_with = [&](const std::string& operation, Diagnostics& diagnostics) {
    DecksInMemory decks{{{"main.k", control + "*DEFINE_TRANSFORMATION\n1\n" + operation + "\n" +
                                        include_transform("part.k", {}, 1) + "*END\n"},
                         {"part.k", system + vector + points}}};
    return model_of(decks, diagnostics);
  };
  Diagnostics diagnostics;
  const Model m = built_with("ROTATE, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 90.0", diagnostics);
  expect_near(m.vectors.at(1).head - m.vectors.at(1).tail, Vec(0, 1, 0), "vector");
  expect_near(m.coordinate_systems.at(8).axes.col(0), Vec(0, 1, 0), "x axis");
  expect_near(m.coordinate_systems.at(8).axes.col(1), Vec(-1, 0, 0), "y axis");
  Diagnostics scaled;
  built_with("SCALE, 2.0, 2.0, 2.0", scaled);
  EXPECT_NE(scaled.text().find("leaves open whether positions in a system are, too"), std::string::npos)
      << scaled.text();
  Diagnostics mirrored;
  built_with("MIRROR, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0", mirrored);
  EXPECT_NE(mirrored.text().find("the file is mirrored, and a system is right-handed"), std::string::npos)
      << mirrored.text();
  Diagnostics apart;
  DecksInMemory decks{{{"main.k", control + system + "*DEFINE_TRANSFORMATION\n1\nTRANSL, 1.0\n" +
                                      include_transform("part.k", {}, 1) + "*END\n"},
                       {"part.k", vector}}};
  model_of(decks, apart);
  EXPECT_NE(apart.text().find("system 7 is in a file that *INCLUDE_TRANSFORM moves otherwise"),
            std::string::npos)
      << apart.text();
}

}  // namespace courant
