#include "generate/generate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "../temporary_folder.hpp"
#include "generate/scene.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

const std::string decks = std::string(SOURCE_DIR) + "/keyword_decks/";

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class Generate : public test::TemporaryFolder {
 protected:
  /// The deck of a scene given as text; messages go to `messages_` with the folder taken off.
  std::string deck(const std::string& scene, const std::map<std::string, std::string>& params = {}) {
    std::ofstream(folder_ / "scene.yaml") << scene;
    Diagnostics diagnostics;
    ok_ =
        generate_deck((folder_ / "scene.yaml").string(), (folder_ / "deck.k").string(), params, diagnostics);
    messages_ = diagnostics.text();
    for (std::size_t at; (at = messages_.find(folder_.string() + "/")) != std::string::npos;)
      messages_.erase(at, folder_.string().size() + 1);
    EXPECT_EQ(ok_, fs::exists(folder_ / "deck.k"));
    EXPECT_FALSE(fs::exists(folder_ / "deck.k.part"));
    return read(folder_ / "deck.k");
  }
  void refused(const std::string& scene, const std::string& message,
               const std::map<std::string, std::string>& params = {}) {
    deck(scene, params);
    EXPECT_FALSE(ok_);
    EXPECT_NE(messages_.find(message), std::string::npos) << messages_;
  }

  std::string messages_;
  bool ok_ = false;
};

const char* small = R"(title: two by one, c0 = ${c0}
parameters:
  c0: 10
  dx: 1 / 2
parts:
  - id: 3
    title: water
    section: 1
    material: 2
    eos: 4
    velocity: [c0 / 5, 0]
    lattices:
      - {low: [-1, 0], high: [0, dx], spacing: dx}
  - id: 7
    section: 5
    material: 6
    merge: true
    plates:
      - {origin: [0, 0, 0], edge1: [1, 0, 0], edge2: [0, 0, dx], mesh: dx}
      - {origin: [1, 0, 0], edge1: [0, 0.6, 0], edge2: [0, 0, dx], mesh: dx}
keywords: |
  *CONTROL_TERMINATION
  $#  endtim
  ${c0 * dx:10}
)";

TEST_F(Generate, WritesFixedColumns) {
  const std::string text = deck(small);
  ASSERT_TRUE(ok_) << messages_;
  EXPECT_EQ(text, R"($ Written by `courant generate scene.yaml`: change the scene, not this file.
$ Parameters:
$   c0 = 10
$   dx = 0.5
$ Parts:
$   3 water: 2 particles
$   7 part 7: 4 shells
*KEYWORD
*TITLE
two by one, c0 = 10
*CONTROL_TERMINATION
$#  endtim
         5
*PART
$# heading
water
$#     pid     secid       mid     eosid      hgid
         3         1         2         4         0
*PART
$# heading
part 7
$#     pid     secid       mid     eosid      hgid
         7         5         6         0         0
*INITIAL_VELOCITY_GENERATION
$#      id      styp     omega        vx        vy        vz     ivatn      icid
         3         2         0         2         0         0         0         0
$#      xc        yc        zc        nx        ny        nz     phase    irigid
         0         0         0         0         0         0         0         0
*NODE
$#   nid               x               y               z      tc      rc
       1           -0.75            0.25               0
       2           -0.25            0.25               0
       3               0               0               0
       4               0               0             0.5
       5             0.5               0               0
       6             0.5               0             0.5
       7               1               0               0
       8               1               0             0.5
       9               1             0.3               0
      10               1             0.3             0.5
      11               1             0.6               0
      12               1             0.6             0.5
*ELEMENT_SPH
$#   nid     pid            mass    nend   (mass < 0: volume)
       1       3           -0.25
       2       3           -0.25
*ELEMENT_SHELL
$#   eid     pid      n1      n2      n3      n4
       1       7       3       5       6       4
       2       7       5       7       8       6
       3       7       7       9      10       8
       4       7       9      11      12      10
*END
)");
}

TEST_F(Generate, OverridesParametersAndWhatFollowsFromThem) {
  const std::string text = deck(small, {{"dx", "c0 / 40"}});
  ASSERT_TRUE(ok_) << messages_;
  EXPECT_NE(text.find("$   3 water: 4 particles"), std::string::npos) << text.substr(0, 300);
}

std::string with(std::string from, const std::string& old, const std::string& now) {
  const auto at = from.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return from.replace(at, old.size(), now);
}

TEST_F(Generate, RefusesBadScenesWithTheirPlace) {
  const std::string s = small;
  refused(with(s, "spacing: dx", "spacing: -dx"),
          "scene.yaml:13:48: error: spacing: expected a length > 0, got -0.5");
  refused(with(s, "high: [0, dx]", "high: [-1, dx]"),
          "scene.yaml:13:9: error: the lattice is empty: its extent along x is 0");
  refused(with(s, "low: [-1, 0]", "low: [-1.1, 0]"),
          "the extent 1.1 along x is 2.2 spacings, not a whole number");
}

TEST_F(Generate, RefusesUnknownAndRepeatedNames) {
  const std::string s = small;
  refused(with(s, "eos: 4", "eso: 4"),
          "scene.yaml:10:5: error: a part: unknown key 'eso'\n  hint: known keys: id, title");
  refused(with(s, "eos: 4", "section: 4"), "scene.yaml:10:5: error: a part: 'section' stands twice");
  refused(with(s, "dx: 1 / 2", "dx: 1 / resolution"),
          "scene.yaml:4:7: error: parameter dx: unknown parameter 'resolution'");
  refused(with(s, "${c0 * dx:10}", "${c1 * dx:10}"),
          "scene.yaml:24: error: in '${c1 * dx:10}': unknown parameter 'c1'");
  refused(with(s, "id: 7", "id: 3"), "scene.yaml:14:9: error: part 3 is there already");
  refused(s, "error: --param c1: the scene has no such parameter\n  hint: its parameters: c0, dx",
          {{"c1", "2"}});
  refused(s, "error: --param dx: unknown parameter 'half', got 'half'", {{"dx", "half"}});
}

TEST_F(Generate, RefusesBadPartsAndPlates) {
  const std::string s = small;
  refused(with(s, "id: 3", "id: 0"),
          "scene.yaml:6:9: error: id: expected a whole number from 1 to 99999999, got 0");
  refused(with(s, "id: 3", "id: 1.5"), "got 1.5");
  refused(with(s, "    material: 6\n", ""), "scene.yaml:14:5: error: 'material' is missing");
  refused(with(s, "edge2: [0, 0, dx]", "edge2: [2, 0, 0]"), "the plate has no area");
  refused(with(s, "merge: true", "merge: perhaps"), "merge: expected true or false");
  refused(with(s, "merge: true", "first_id: 2"), "part 7: ids from 2 on are taken by the parts above");
  refused(with(s, "merge: true", "first_id: 99999999"), "the format ends at 99999999");
  refused(with(s, "mesh: dx", "mesh: [dx, 0]"), "mesh: expected a length > 0, got 0");
  refused(with(s, "mesh: dx", "mesh: [dx]"), "mesh: expected a number");
  refused("title: x\n", "the scene has no parts");
  refused("title: [x\n", "not valid YAML");
  refused("- x\n", "a scene is a YAML map");
  refused("", "a scene is a YAML map");
}

TEST_F(Generate, PlatesMayHaveALengthForEachEdge) {
  const std::string plate = "edge1: [1, 0, 0], edge2: [0, 0, dx], mesh: dx}",
                    unlike = "edge1: [1, 0, 0], edge2: [0, 0, dx], mesh: [dx / 4, dx]}";
  const std::string text = deck(with(small, plate, unlike));
  ASSERT_TRUE(ok_) << messages_;
  EXPECT_NE(text.find("$   7 part 7: 10 shells\n"), std::string::npos) << text;
}

TEST_F(Generate, RefusesHugeLattices) {
  refused(with(small, "spacing: dx", "spacing: 1 / 2^20"), "the lattice would have");
  const std::string lattice = "      - {low: [-1, 0], high: [0, dx], spacing: dx}\n",
                    large = "      - {low: [0, 0], high: [6000, 6000], spacing: 1}\n";
  refused(with(small, lattice, large + large),
          "up to here the scene has room for 7.2e+07 particles and shells");
}

TEST_F(Generate, RefusesManyPlatesThatAreHugeTogether) {
  const std::string plate = "      - {origin: [0, 0, 0], edge1: [1, 0, 0], edge2: [0, 0, dx], mesh: dx}\n",
                    large =
                        "      - {origin: [0, 0, 0], edge1: [6000, 0, 0], edge2: [0, 0, 6000], mesh: 1}\n";
  refused(with(small, plate, large + large),
          "up to here the scene has room for 7.2e+07 particles and shells");
}

TEST_F(Generate, RefusesLatticesOfTwoAndOfThreeDimensions) {
  const std::string lattice = "      - {low: [-1, 0], high: [0, dx], spacing: dx}\n",
                    spatial = "      - {low: [1, 0, 0], high: [2, dx, 1], spacing: dx}\n";
  refused(with(small, lattice, lattice + spatial), "a lattice of 3 dimensions beside one of 2");
}

TEST_F(Generate, LeavesNothingWhereItCannotWrite) {
  std::ofstream(folder_ / "scene.yaml") << small;
  const auto fails = [&](const std::string& scene, const std::string& target) {
    Diagnostics diagnostics;
    EXPECT_FALSE(generate_deck(scene, target, {}, diagnostics));
    return diagnostics.text();
  };
  const std::string scene = (folder_ / "scene.yaml").string();
  EXPECT_NE(fails(scene, (folder_ / "missing/deck.k").string()).find("the deck cannot be written"),
            std::string::npos);
  EXPECT_NE(fails(scene, folder_.string()).find("it is no file"), std::string::npos);
  EXPECT_NE(fails((folder_ / "none.yaml").string(), (folder_ / "deck.k").string()).find("cannot be read"),
            std::string::npos);
  EXPECT_NE(fails(scene, (folder_ / "." / "scene.yaml").string()).find("would take the place of the scene"),
            std::string::npos);
  EXPECT_EQ(read(scene), small);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(Generate, VelocitiesOfManyDigitsHaveWideFields) {
  const std::string text = deck(with(small, "velocity: [c0 / 5, 0]", "velocity: [-1.23456789e-12, 2]"));
  EXPECT_TRUE(ok_) << messages_;
  const std::string heading = "*INITIAL_VELOCITY_GENERATION +\n$#                id";
  EXPECT_NE(text.find(heading), std::string::npos) << text;
  EXPECT_NE(text.find("     -1.23456789e-12                   2"), std::string::npos) << text;
  const std::string round = deck(with(small, "velocity: [c0 / 5, 0]", "velocity: [-1.23456e-3, 2]"));
  EXPECT_NE(round.find("        -0.00123456                   2"), std::string::npos) << round;
}

Id particles(const std::string& scene, const std::map<std::string, std::string>& params) {
  Diagnostics diagnostics;
  const Scene read = read_scene(decks + scene, params, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  Id n = 0;
  for (const ScenePart& part : read.parts)
    for (const SceneLattice& lattice : part.lattices) n += lattice.count();
  return n;
}

/// Whether the deck has a line with these fields of ten columns.
bool has_fields(const std::string& deck, std::initializer_list<const char*> fields) {
  std::string line = "\n";
  for (const char* field : fields) line += std::string(10 - std::string(field).size(), ' ') + field;
  return deck.find(line) != std::string::npos;
}

TEST_F(Generate, WaterInABoxNeedsNoCards) {
  const std::string text = deck(
      "title: box\nwater: {spacing: 0.1, density: 900, blocks: [{low: [0, 0], high: [0.4, 0.2]}]}\n"
      "box: {low: [0, 0], high: [1, 0.5], open: [top, right]}\ngravity: 10\nend: 3\n");
  ASSERT_TRUE(ok_) << messages_;
  EXPECT_NE(text.find("1 water: 8 particles"), std::string::npos) << text;
  // floor of 1 and wall of 0.5 in shells of half a spacing
  EXPECT_NE(text.find("11 walls: 30 shells"), std::string::npos) << text;
  // 20 sqrt(2 * 10 * 0.2) = 40
  EXPECT_TRUE(has_fields(text, {"1", "0", "1440000"})) << text;
  EXPECT_NE(text.find("*LOAD_BODY_Y"), std::string::npos);
}

TEST_F(Generate, WaterOfThreeDimensionsFallsAlongZ) {
  const std::string text = deck(
      "title: box\nwater: {spacing: 0.1, blocks: [{low: [0, 0, 0], high: [0.2, 0.2, 0.2]}], velocity: [3, 0, "
      "4]}\n"
      "box: {low: [0, 0, 0], high: [0.4, 0.4, 0.4]}\ngravity: 0\nend: 3\n");
  ASSERT_TRUE(ok_) << messages_;
  EXPECT_NE(text.find("11 walls: 24 shells"), std::string::npos) << text;
  EXPECT_TRUE(has_fields(text, {"1", "0", "1.0e7"}) || has_fields(text, {"1", "0", "1e7"}) ||
              has_fields(text, {"1", "0", "10000000"}))
      << text;  // 1000 (20 * 5)^2
  EXPECT_EQ(text.find("*LOAD_BODY"), std::string::npos);
  const std::string falls =
      deck("title: drop\nwater: {spacing: 0.1, blocks: [{low: [0, 0, 0], high: [0.2, 0.2, 0.2]}]}\nend: 3\n");
  EXPECT_NE(falls.find("*LOAD_BODY_Z"), std::string::npos);
  EXPECT_EQ(falls.find("*CONTACT"), std::string::npos);
}

TEST_F(Generate, FaultsOfWaterAreTold) {
  const std::string water = "water: {spacing: 0.1, blocks: [{low: [0, 0], high: [0.4, 0.2]}]}\n";
  refused("title: x\nend: 1\nparts: []\n",
          "scene.yaml:2:6: error: 'end' goes with 'water', which the scene has not");
  refused(water, "'end' is missing");
  refused(water + "end: 1\nbox: {low: [0, 0], high: [0.3, 1]}\n",
          "a block reaches from 0 to 0.4 along x, beyond the box from 0 to 0.3");
  refused(water + "end: 1\nbox: {low: [0, 0], high: [0.4, 0]}\n", "the box has no extent along y");
  refused(water + "end: 1\nbox: {low: [0, 0, 0], high: [1, 1, 1]}\n",
          "the water has 2 dimensions, and so must low and high");
  refused(water + "end: 1\nbox: {low: [0, 0], high: [1, 1], open: [front]}\n",
          "'front' is no side of the box\n  hint: its sides: left, right, bottom, top");
  refused(water + "end: 1\ngravity: 0\n", "'sound_speed' is missing");
  refused("water: {spacing: 0.1}\nend: 1\n", "water: 'blocks' is a list of");
  refused("water: {spacing: 0.1, block: []}\nend: 1\n", "unknown key 'block'");
  refused(water +
              "end: 1\nparts:\n  - id: 1\n    section: 1\n    material: 1\n"
              "    lattices: [{low: [0, 0], high: [1, 1], spacing: 1}]\n",
          "part 1 is there already");
}

TEST(CommittedScenes, HaveTheParticlesTheirGeometryGives) {
  const std::string jump = "hydraulic_jump/scene.yaml";
  EXPECT_EQ(particles(jump, {{"resolution", "4"}, {"endtim", "30"}}), 36880);
  EXPECT_EQ(particles(jump, {{"resolution", "5"}}), 10750);
  EXPECT_EQ(particles(jump, {{"resolution", "6"}}), 15480);
  EXPECT_EQ(particles(jump, {{"resolution", "10"}}), 43000);
  EXPECT_EQ(particles(jump, {}), 6880);
  EXPECT_EQ(particles("dam_break_3d/scene.yaml", {}), 16000);
  EXPECT_EQ(particles("still_water/scene.yaml", {}), 2500);
}

TEST_F(Generate, CommittedJumpIsWhatItsSceneGives) {
  Diagnostics diagnostics;
  const std::string now = (folder_ / "d4_5s.k").string();
  ASSERT_TRUE(generate_deck(decks + "hydraulic_jump/scene.yaml", now, {}, diagnostics)) << diagnostics.text();
  EXPECT_TRUE(read(now) == read(decks + "hydraulic_jump/d4_5s.k"))
      << "run: courant generate keyword_decks/hydraulic_jump/scene.yaml -o "
         "keyword_decks/hydraulic_jump/d4_5s.k";
}

/// The column after each word of a line.
std::vector<std::size_t> word_ends(const std::string& line) {
  std::vector<std::size_t> ends;
  for (std::size_t i = 1; i <= line.size(); ++i)
    if (line[i - 1] != ' ' && (i == line.size() || line[i] == ' ')) ends.push_back(i);
  return ends;
}

/// Data lines of the committed scenes fit 80 columns, and the numbers of a card end where their headings end.
TEST_F(Generate, CardsOfCommittedScenesFitTheirColumns) {
  for (const std::string name :
       {"hydraulic_jump/scene", "hydraulic_jump/supported_bed", "hydraulic_jump/smooth_bed",
        "hydraulic_jump/standing_level", "dam_break_3d/scene", "still_water/scene"}) {
    Diagnostics diagnostics;
    const std::string path = (folder_ / "scene.k").string();
    ASSERT_TRUE(generate_deck(decks + name + ".yaml", path, {}, diagnostics)) << diagnostics.text();
    std::stringstream lines(read(path));
    std::vector<std::size_t> heads;
    int checked = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("$#")) {
        const bool text = line.ends_with("heading") || line.ends_with("title");
        heads = text ? std::vector<std::size_t>() : word_ends(line);
      } else if (line[0] == '*') {
        heads.clear();
      } else if (line[0] != '$') {
        EXPECT_LE(line.size(), 80u) << line;
        if (heads.empty()) continue;
        for (const std::size_t end : word_ends(line))
          ASSERT_TRUE(std::find(heads.begin(), heads.end(), end) != heads.end())
              << path << ": column " << end << ": " << line;
        ++checked;
      }
    }
    EXPECT_GT(checked, 1000);
  }
}

}  // namespace
}  // namespace courant
