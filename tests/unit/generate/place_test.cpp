// Expressions of place in scenes: where, jitter, velocity, pressure.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "generate/deck_writer.hpp"
#include "generate/lattice.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

const char* patch = R"(title: patch
parameters:
  U: 2
  dx: 0.25
parts:
  - id: 1
    title: water
    section: 1
    material: 1
    lattices:
      - {low: [0, 0], high: [1, 1], spacing: dx}
)";

struct Written {
  std::string deck, messages;
  Scene scene;
};

Written written(const std::string& text) {
  const fs::path file =
      fs::temp_directory_path() / (std::string("courant_place_") +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml");
  std::ofstream(file) << text;
  Diagnostics diagnostics;
  Written out;
  out.scene = read_scene(file.string(), {}, diagnostics);
  if (diagnostics.ok()) out.deck = deck_text(out.scene, "scene.yaml", diagnostics);
  out.messages = diagnostics.text();
  for (std::size_t at; (at = out.messages.find(file.string())) != std::string::npos;)
    out.messages.replace(at, file.string().size(), "scene.yaml");
  fs::remove(file);
  return out;
}

std::string with(const std::string& added) {
  return patch + added;
}
std::string lattice_with(const std::string& added) {
  std::string s = patch;
  return s.replace(s.rfind("dx}"), 3, "dx, " + added + "}");
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

/// Numbers of the lines of a keyword.
std::vector<std::vector<double>> cards(const std::string& deck, const std::string& keyword) {
  std::vector<std::vector<double>> out;
  std::stringstream lines(deck);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '*') inside = line == keyword;
    if (!inside || line[0] == '*' || line[0] == '$') continue;
    std::stringstream numbers(line);
    out.emplace_back();
    for (double a; numbers >> a;) out.back().push_back(a);
  }
  return out;
}

TEST(Place, KeepsParticlesWhereTheExpressionIsPositive) {
  const Written out = written(lattice_with("where: '0.6^2 - x^2 - y^2'"));
  EXPECT_EQ(out.messages, "");
  const auto nodes = cards(out.deck, "*NODE");
  ASSERT_EQ(nodes.size(), 4u);  // r of the centres: 0.177, 0.395 (twice), 0.530, then 0.637
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_EQ(nodes[i][0], double(i + 1));
    EXPECT_LT(std::hypot(nodes[i][1], nodes[i][2]), 0.6);
  }
  EXPECT_NE(out.deck.find("$   1 water: 4 particles"), std::string::npos);
  EXPECT_EQ(cards(out.deck, "*ELEMENT_SPH").size(), 4u);
}

TEST(Place, GivesEachParticleItsVelocityAndPressure) {
  const Written out =
      written(with("    velocity: ['U * x / ${dx}', -U * y]\n    pressure: 1000 * (1 - y) + x / 3\n"));
  EXPECT_EQ(out.messages, "");
  EXPECT_EQ(out.deck.find("*INITIAL_VELOCITY_GENERATION"), std::string::npos);
  const auto nodes = cards(out.deck, "*NODE"), v = cards(out.deck, "*INITIAL_VELOCITY_NODE +"),
             sigma = cards(out.deck, "*INITIAL_STRESS_SPH +");
  ASSERT_EQ(nodes.size(), 16u);
  ASSERT_EQ(v.size(), 16u);
  ASSERT_EQ(sigma.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) {
    const double x = nodes[i][1], y = nodes[i][2], p = 1000 * (1 - y) + x / 3;
    EXPECT_EQ(v[i][0], nodes[i][0]);
    EXPECT_NEAR(v[i][1], 8 * x, 1e-12);
    EXPECT_NEAR(v[i][2], -2 * y, 1e-12);
    EXPECT_EQ(v[i][3], 0);
    EXPECT_EQ(sigma[i][0], nodes[i][0]);
    for (std::size_t k = 1; k < 4; ++k) EXPECT_NEAR(sigma[i][k], -p, 1e-12 * p);
  }
}

TEST(Place, VelocityWithoutPlaceStaysOneCard) {
  const Written out = written(with("    velocity: [U, exp(0)]\n"));
  EXPECT_EQ(out.messages, "");
  EXPECT_NE(out.deck.find("*INITIAL_VELOCITY_GENERATION"), std::string::npos);
  EXPECT_EQ(out.deck.find("*INITIAL_VELOCITY_NODE"), std::string::npos);
}

TEST(Place, JitterShiftsWithinItsFractionAndIsTheSameEachTime) {
  const Written out = written(lattice_with("jitter: 0.2")), again = written(lattice_with("jitter: 0.2"));
  EXPECT_EQ(out.deck, again.deck);
  const auto now = cards(out.deck, "*NODE"), before = cards(written(patch).deck, "*NODE");
  ASSERT_EQ(now.size(), before.size());
  double largest = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    for (std::size_t k = 1; k < 3; ++k) {
      EXPECT_NE(now[i][k], before[i][k]);
      largest = std::max(largest, std::abs(now[i][k] - before[i][k]));
    }
    EXPECT_EQ(now[i][3], 0);
  }
  EXPECT_LE(largest, 0.05);
  EXPECT_GT(largest, 0.04);
}

TEST(Place, ScatteredNumbersAreEvenAndHaveKnownBits) {
  double sum = 0, squares = 0, pairs = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double a = scattered(1000, i);
    ASSERT_TRUE(a >= -1 && a < 1);
    sum += a, squares += a * a, pairs += a * scattered(1000, i + 1);
  }
  EXPECT_NEAR(sum / n, 0, 0.02);  // 5 standard errors of the mean
  EXPECT_NEAR(squares / n, 1.0 / 3, 0.011);
  EXPECT_NEAR(pairs / n, 0, 0.012);
  EXPECT_NE(scattered(1000, 0), scattered(1001, 0));
  EXPECT_EQ(scattered(1000, 7), -0.9127648904505807);  // from the generator's published constants, in Python
}

TEST(Place, RefusesFaultsWithTheirPlace) {
  EXPECT_EQ(written(lattice_with("where: '1 / (x - 0.125)'")).messages,
            "scene.yaml:11:57: error: where: division by zero at x = 0.125, y = 0.125, z = 0, got '1 / (x - "
            "0.125)'\n");
  EXPECT_NE(written(lattice_with("where: 'x - w'")).messages.find("unknown parameter 'w' at x = 0.125"),
            std::string::npos);
  EXPECT_EQ(written(lattice_with("where: '-x'")).messages,
            "scene.yaml:6:5: error: part 1 has no particles: 'where' leaves none\n  hint: a particle is kept "
            "where the expression is > 0\n");
  EXPECT_EQ(written(lattice_with("jitter: 0.5")).messages,
            "scene.yaml:11:58: error: jitter: expected a fraction of the spacing from 0 to below 0.5, got "
            "0.5\n");
  EXPECT_NE(written(lattice_with("jitter: -0.1")).messages.find("got -0.1"), std::string::npos);
  std::string hidden = with("    velocity: [x, 0]\n");
  hidden.replace(hidden.find("U: 2"), 4, "x: 2");
  EXPECT_EQ(written(hidden).messages,
            "scene.yaml:12:16: error: velocity: x is the place of a particle here, and a parameter of the "
            "scene\n  hint: give the parameter another name\n");
}

TEST(Place, ShellsHaveNoPressureAndOneVelocity) {
  const std::string plate = R"(title: plate
parts:
  - id: 1
    section: 1
    material: 1
    plates:
      - {origin: [0, 0, 0], edge1: [1, 0, 0], edge2: [0, 0, 1], mesh: 1}
)";
  EXPECT_EQ(written(plate + "    pressure: 1\n").messages,
            "scene.yaml:8:15: error: pressure: only particles have one, and the part has none\n");
  EXPECT_EQ(written(plate + "    velocity: [x, 0]\n").messages,
            "scene.yaml:8:15: error: velocity: x, y, z are the place of a particle, and the part has none\n  "
            "hint: parts of shells move with one velocity\n");
}

TEST(Place, NamesAreWholeWords) {
  EXPECT_EQ(named_places("max(x1, exp(2)) * dy"), (std::array<bool, 3>{}));
  EXPECT_EQ(named_places("${x} - 2*z"), (std::array<bool, 3>{true, false, true}));
}

TEST(SceneBase, GivesParametersAndKeywordsBelowTheScenesOwn) {
  const fs::path base = fs::temp_directory_path() / "courant_scene_base.yaml";
  write(base, "parameters:\n  U: 7\n  c0: 10 * U\nkeywords: |\n  *COMMENT\n  ${U} ${c0}\n");
  const Written w = written("base: courant_scene_base.yaml\n" + with("keywords: |\n  *END_OF_OWN\n"));
  EXPECT_EQ(w.messages, "");
  EXPECT_EQ(w.scene.variables.at("c0"), 20);
  ASSERT_EQ(w.scene.keywords.size(), 2u);
  EXPECT_EQ(w.scene.keywords[0], "*COMMENT\n2 20\n");
  EXPECT_EQ(w.scene.keywords[1], "*END_OF_OWN\n");
  write(base, "parameters:\n  c0: 10 * V\nbox: 1\n");
  const std::string messages = written("base: courant_scene_base.yaml\n" + with("")).messages;
  EXPECT_NE(messages.find("courant_scene_base.yaml:3:1: error: a base: unknown key 'box'"),
            std::string::npos);
  EXPECT_NE(messages.find("courant_scene_base.yaml:2:7: error: parameter c0: unknown parameter 'V'"),
            std::string::npos)
      << messages;
  write(base, "parameters: [\n");
  EXPECT_NE(
      written("base: courant_scene_base.yaml\n" + with("")).messages.find("base.yaml:2:1: error: not valid"),
      std::string::npos);
  fs::remove(base);
  EXPECT_NE(written("base: courant_scene_base.yaml\n" + with("")).messages.find("cannot be read"),
            std::string::npos);
}

TEST(SceneBase, MayHaveBasesOfItsOwn) {
  const fs::path folder = fs::temp_directory_path();
  const fs::path base = folder / "courant_nested_base.yaml", deep = folder / "courant_nested_deep.yaml";
  write(deep,
        "parameters:\n  U: 7\n  c0: 10 * U\n  last: 2 * width\nkeywords: |\n  *COMMENT\n  deep ${c0} "
        "${last}\n");
  write(base,
        "base: courant_nested_deep.yaml\nparameters:\n  U: 3 * speed\n  width: U + own\n"
        "keywords: |\n  *COMMENT\n  base\n");
  std::string text = "base: courant_nested_base.yaml\n" + with("keywords: |\n  *COMMENT\n  own ${seen}\n");
  text.replace(text.find("U: 2"), 4, "speed: 2\n  own: 1\n  seen: last");
  const Written w = written(text);
  EXPECT_EQ(w.messages, "");
  EXPECT_EQ(w.scene.keywords,
            (std::vector<std::string>{"*COMMENT\ndeep 60 14\n", "*COMMENT\nbase\n", "*COMMENT\nown 14\n"}));
  text.replace(text.find("courant_nested_base.yaml"), 24,
               "[courant_nested_base.yaml, courant_nested_deep.yaml]");
  EXPECT_EQ(written(text).scene.keywords, w.scene.keywords);  // each once
  write(deep, "base: courant_nested_base.yaml\n");
  EXPECT_NE(written("base: courant_nested_base.yaml\n" + with("")).messages.find("is a base of itself"),
            std::string::npos);
  fs::remove(base), fs::remove(deep);
}

TEST(SceneBase, GivesPartsAboveTheScenesOwn) {
  const fs::path base = fs::temp_directory_path() / "courant_parts_base.yaml";
  const auto plates = [](int id, const char* edge) {
    return fmt::format(
        "  - id: {}\n    section: 1\n    material: 1\n    plates:\n"
        "      - {{origin: [0, 0, 0], edge1: [{}, 0, 0], edge2: [0, 1, 0], mesh: 1}}\n",
        id, edge);
  };
  const std::string own = "base: courant_parts_base.yaml\nparameters:\n  length: 3\n";
  write(base, "parts:\n" + plates(8, "length"));
  const Written alone = written(own);
  EXPECT_EQ(alone.messages, "");
  ASSERT_EQ(alone.scene.parts.size(), 1u);
  const Written both = written(own + "parts:\n" + plates(9, "1"));
  EXPECT_EQ(both.messages, "");
  ASSERT_EQ(both.scene.parts.size(), 2u);
  EXPECT_EQ(both.scene.parts[0].id, 8);
  EXPECT_EQ(both.scene.parts[1].id, 9);
  EXPECT_NE(written(own + "parts:\n" + plates(8, "1")).messages.find("part 8 is there already"),
            std::string::npos);
  write(base, "parts:\n" + plates(8, "width"));
  EXPECT_NE(written(own).messages.find("courant_parts_base.yaml:6:"), std::string::npos);
  fs::remove(base);
}

TEST(Scene, KnowsPi) {
  EXPECT_EQ(written(with("") + "title: x\n").messages.find("pi"), std::string::npos);
  EXPECT_NE(written("parameters: {pi: 3}\n").messages.find("'pi' is there already"), std::string::npos);
}

}  // namespace
}  // namespace courant
