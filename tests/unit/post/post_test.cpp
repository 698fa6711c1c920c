#include "post/post.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "../output/output_test.hpp"
#include "output/field_writer.hpp"
#include "output/summary.hpp"
#include "parallel/parallel.hpp"
#include "post/recipe.hpp"

namespace courant {
namespace {

using test::ScratchFolder;

const std::string jump_recipe = std::string(SOURCE_DIR) + "/keyword_decks/hydraulic_jump/post.yaml";

std::filesystem::path write(const ScratchFolder& dir, const std::string& text) {
  write_file(dir / "recipe.yaml", text);
  return dir / "recipe.yaml";
}

/// A channel 1.1 m long whose water stands at 4 rows upstream of x_jump and 16 rows downstream of it.
void fill_channel(World& world, Real x_jump) {
  const Real dx = 0.005;
  std::vector<Vec> x;
  for (int i = 0; i < 220; ++i)
    for (int k = 0; k < ((i + 0.5) * dx < x_jump ? 4 : 16); ++k)
      x.emplace_back((i + 0.5) * dx, (k + 0.5) * dx, 0);
  Particles& p = world.particles;
  p.fields.resize(static_cast<Index>(x.size()));
  p.active = p.moving = p.size();
  for (Index i = 0; i < p.size(); ++i) {
    const Vec& at = x[static_cast<std::size_t>(i)];
    p.x.set(i, at);
    p.v.set(i, {at.x() < x_jump ? 1.5 : 0.35, 0, 0});
    p.m[i] = 1000 * dx * dx;
    p.rho[i] = 1000;
    p.h[i] = 1.2 * dx;
    p.id[i] = i + 1;
    p.state[i] = particle_active;
  }
}

/// One state whose jump stands at x = 0.5.
void write_state(const ScratchFolder& dir) {
  FieldWriter writer(dir.path(), {.part_ids = {1}});
  World world;
  fill_channel(world, 0.5);
  writer.write(world, 0, 0);
}

/// The jump stands at x = 1.2 (outside) before 1 s, then goes upstream from 0.9 at 0.1 m/s; a state every 0.1
/// s.
void write_run(const ScratchFolder& dir, const std::string& title, int states = 51) {
  FieldWriter writer(dir.path(), {.part_ids = {1}});
  for (int s = 0; s < states; ++s) {
    World world;
    fill_channel(world, s < 10 ? 1.2 : 0.9 - 0.01 * (s - 10));
    writer.write(world, 0.1 * s, s);
  }
  Summary summary;
  summary.title = title;
  write_summary(dir / "summary.yaml", summary);
}

TEST(Post, HydraulicJumpFromFieldFilesToResults) {
  ScratchFolder dir;
  write_run(dir, "Hydraulic jump d1/4");
  Diagnostics diagnostics;
  std::string said;
  ASSERT_TRUE(run_post(
      jump_recipe, dir.path(), [&](std::string_view text) { said += text; }, diagnostics))
      << diagnostics.text();

  const YAML::Node results = YAML::LoadFile((dir / "results.yaml").string());
  EXPECT_EQ(results["case"].as<std::string>(), "d1/4");
  const YAML::Node interval = results["jump"]["intervals"][0];
  const double ratio = 0.08 / 0.0863;  // 16 rows against Belanger
  EXPECT_EQ(interval["states"].as<int>(), 26);
  EXPECT_NEAR(interval["A"].as<double>(), ratio, 0.01);
  EXPECT_NEAR(interval["P"].as<double>(), 1 - ratio, 0.01);
  EXPECT_EQ(interval["published"][0]["A"].as<double>(), 0.969);
  EXPECT_EQ(results["jump"]["intervals"][1]["states"].as<int>(), 0);
  EXPECT_NEAR(results["jump"]["front"]["time"].as<double>(), 1.0, 1e-6);
  EXPECT_NEAR(results["jump"]["toe_at_end"].as<double>(), 0.5, 0.011);
  EXPECT_NE(said.find("Case: d1/4; 51 states"), std::string::npos) << said;

  const std::string csv = test::read_text(dir / "depth.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "t,depth,depth_over_theory,toe,front_depth");
  if (diagnostics.warnings() == 0) {  // python3 with matplotlib is there
    EXPECT_GT(std::filesystem::file_size(dir / "depth.png"), 10000u);
    EXPECT_GT(std::filesystem::file_size(dir / "velocity.png"), 10000u);
  } else {
    EXPECT_NE(diagnostics.text().find("matplotlib was not found"), std::string::npos) << diagnostics.text();
  }
}

TEST(Post, ProbeOnTheLine) {
  ScratchFolder dir;
  write_state(dir);
  Diagnostics diagnostics;
  ASSERT_TRUE(run_post(
      write(dir, "probes: [{name: gauge, x: 0.8}]\n"), dir.path(), [](std::string_view) {}, diagnostics))
      << diagnostics.text();
  const YAML::Node results = YAML::LoadFile((dir / "results.yaml").string());
  EXPECT_NEAR(results["probes"][0]["last_depth"].as<double>(), 0.08, 5e-4);
}

TEST(Post, PicturesAloneReadTheirStates) {
  ScratchFolder dir;
  write_state(dir);
  Diagnostics diagnostics;
  ASSERT_TRUE(run_post(
      write(dir, "snapshots: {times: [0]}\n"), dir.path(), [](std::string_view) {}, diagnostics))
      << diagnostics.text();
  const std::string csv = test::read_text(dir / "snapshots.csv");
  // the channel has 100 columns of 4 and 120 of 16 particles
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 100 * 4 + 120 * 16);
}

TEST(Post, FolderWithoutResults) {
  ScratchFolder dir;
  Diagnostics diagnostics;
  EXPECT_FALSE(run_post(
      jump_recipe, dir.path(), [](std::string_view) {}, diagnostics));
  EXPECT_NE(diagnostics.text().find("fields.pvd: error: no results here"), std::string::npos)
      << diagnostics.text();
}

TEST(Post, TruncatedFieldFile) {
  ScratchFolder dir;
  write_state(dir);
  const auto file = dir / "fields/particles_0000.vtp";
  const auto size = std::filesystem::file_size(file);
  for (const auto left :
       {size - size / 4, std::uintmax_t(700), std::uintmax_t(0)}) {  // in the data, in the head, empty
    std::filesystem::resize_file(file, left);
    Diagnostics diagnostics;
    EXPECT_FALSE(run_post(
        jump_recipe, dir.path(), [](std::string_view) {}, diagnostics))
        << left;
    EXPECT_NE(diagnostics.text().find("particles_0000.vtp: error: not a field file"), std::string::npos)
        << left << diagnostics.text();
  }
}

TEST(Post, DamagedFieldFiles) {
  ScratchFolder dir;
  write_state(dir);
  const auto file = dir / "fields/particles_0000.vtp";
  const std::string whole = test::read_text(file);
  const auto refused = [&](const std::string& damaged) {
    write_file(file, damaged);
    Diagnostics diagnostics;
    const bool done = run_post(
        jump_recipe, dir.path(), [](std::string_view) {}, diagnostics);
    return !done &&
           diagnostics.text().find("particles_0000.vtp: error: not a field file") != std::string::npos;
  };
  const auto with = [&](const std::string& before, std::size_t skip, const std::string& bytes) {
    std::string out = whole;
    const std::size_t at = whole.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    return out.replace(at + before.size() + skip, bytes.size(), bytes);
  };
  // where the data of an array begin: blocks, bytes of a block, bytes of the last one, packed bytes of each
  const std::string offset = "Name=\"mass\" NumberOfComponents=\"1\" format=\"appended\" offset=\"",
                    data = "<AppendedData encoding=\"raw\">\n_";
  const auto mass = std::stoul(whole.substr(whole.find(offset) + offset.size()));
  const std::string huge = "\xff\xff\xff\x7f", nought(4, '\0');
  EXPECT_TRUE(refused(with(data, mass, huge))) << "blocks";
  EXPECT_TRUE(refused(with(data, mass, nought))) << "no block";
  EXPECT_TRUE(refused(with(data, mass + 4, nought))) << "blocks of nothing, by which VTK's reader divides";
  EXPECT_TRUE(refused(with(data, mass + 4, huge))) << "a block of 2 GB";
  EXPECT_TRUE(refused(with(data, mass + 8, huge))) << "the last block";
  EXPECT_TRUE(refused(with(data, mass + 12, huge))) << "a packed block beyond the end";
  EXPECT_TRUE(refused(with(data, mass + 24, huge))) << "packed data";
  EXPECT_TRUE(refused(with("NumberOfPoints=\"", 0, "9"))) << "more points than values";
  std::string crowd = whole;
  EXPECT_TRUE(refused(crowd.insert(whole.find("NumberOfPoints=\"") + 16, "9999999"))) << "memory";
  EXPECT_TRUE(refused(with(offset, 0, "9999999"))) << "data beyond the end";
  EXPECT_TRUE(refused(with("header_type=\"", 0, "UInt64"))) << "what no run writes";
  EXPECT_FALSE(refused(whole));
}

TEST(Post, IndexThatIsNoXml) {
  ScratchFolder dir;
  write_file(dir / "fields.pvd", "<VTKFile><Coll");
  Diagnostics diagnostics;
  EXPECT_FALSE(run_post(
      jump_recipe, dir.path(), [](std::string_view) {}, diagnostics));
  EXPECT_NE(diagnostics.text().find("fields.pvd: error:"), std::string::npos) << diagnostics.text();
}

TEST(Recipe, AllFaultsAtOnceWithTheirPlaces) {
  ScratchFolder dir;
  Diagnostics diagnostics;
  const auto file = write(dir,
                          "jump:\n"
                          "  x: one\n"
                          "  v1: -1.5\n"
                          "  dd1: 0.02\n"
                          "  intervals: [[5, 2.5]]\n"
                          "snapshots: {times: 3}\n");
  EXPECT_FALSE(read_recipe(file, diagnostics).has_value());
  const std::string text = diagnostics.text(), name = file.string();
  EXPECT_NE(text.find(name + ":2:6: error: 'jump.x' must be a number, got 'one'"), std::string::npos) << text;
  EXPECT_NE(text.find(name + ":3:7: error: 'jump.v1' must be greater than 0"), std::string::npos) << text;
  EXPECT_NE(text.find(name + ":4:3: error: 'jump' does not know the key 'dd1'"), std::string::npos) << text;
  EXPECT_NE(text.find("'jump' lacks the key 'd1'"), std::string::npos) << text;
  EXPECT_NE(text.find(":5:15: error: 'jump.intervals': the first number must be less"), std::string::npos)
      << text;
  EXPECT_NE(text.find(":6:20: error: 'snapshots.times' must be a list"), std::string::npos) << text;
}

TEST(Recipe, FaultsOfAnalysesWithTheirPlaces) {
  ScratchFolder dir;
  const auto message = [&](const std::string& text) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_recipe(write(dir, text), diagnostics)) << text;
    std::string out = diagnostics.text();
    const std::string name = (dir / "recipe.yaml").string();
    for (auto at = out.find(name); at != std::string::npos; at = out.find(name))
      out.replace(at, name.size(), "R");
    return out;
  };
  const auto analysis = [&](const std::string& keys) { return message("analyses:\n  - {" + keys + "}\n"); };
  const std::string nameless = message("analyses:\n  - {kind: surface, x: 1}\n  - {kind: surface, x: 2}\n");
  EXPECT_NE(nameless.find("R:2:5: error: 'analyses' lacks the key 'name'"), std::string::npos) << nameless;
  EXPECT_NE(nameless.find("R:3:5: error: 'analyses' lacks the key 'name'"), std::string::npos) << nameless;
  EXPECT_EQ(analysis("kind: surfce, name: a, x: 1"),
            "R:2:12: error: there is no kind of analysis 'surfce'\n"
            "  hint: did you mean surface? kinds: probe, surface, grid, profile, spectrum, flux, history, "
            "force, toe, "
            "roller\n");
  EXPECT_EQ(analysis("kind: surface, name: a/b, x: 1"),
            "R:2:27: error: the name 'a/b' of an analysis must be of letters, digits, - and _\n"
            "  hint: files are named after it\n");
  EXPECT_EQ(analysis("kind: surface, name: a, x: {from: 1, to: 0, step: 0.1}"),
            "R:2:33: error: 'a.x' must go upwards in at most 100000 steps\n");
  EXPECT_EQ(analysis("kind: spectrum, name: s, of: depth"),
            "R:2:35: error: 's.of': there is no analysis 'depth' above it\n"
            "  hint: analyses are worked through from top to bottom\n");
  EXPECT_EQ(analysis("kind: profile, name: p, of: [u], x: 1, y: 1"),
            "R:2:35: error: 'p.of': unknown name 'u'\n  hint: it may use x, y, z, vx, vy, vz, speed, p, rho, "
            "h, m, V, e, "
            "part, id, active, t\n");
  EXPECT_EQ(analysis("kind: profile, name: p, of: [p], x: 1, y: 1, interpolation: msl"),
            "R:2:66: error: 'p.interpolation' cannot be 'msl'\n  hint: it is one of shepard, mls\n");
  EXPECT_EQ(analysis("kind: surface, name: a, x: 1, link: 3"),
            "R:2:42: error: 'a.link' must be at most 2, got 3\n"
            "  hint: particles further apart than 2 h do not know each other\n");
  EXPECT_EQ(message("folder: ../out\nanalyses: [{kind: surface, name: a, x: 1}]\n"),
            "R:1:9: error: 'recipe.folder' must be a folder within the run's\n  hint: for example post\n");
}

TEST(Post, FiguresThatNameWhatIsNotThere) {
  ScratchFolder dir;
  write_state(dir);
  const auto recipe = write(dir,
                            "analyses: [{kind: surface, name: depth, x: [0.2, 0.8]}]\n"
                            "figures:\n"
                            "  - {name: a, curves: [{table: dept, x: t, y: t}]}\n"
                            "  - {name: b, curves: [{table: depth_mean, x: x, y: meen}]}\n");
  Diagnostics diagnostics;
  EXPECT_FALSE(run_post(
      recipe, dir.path(), [](std::string_view) {}, diagnostics));
  const std::string text = diagnostics.text();
  EXPECT_NE(
      text.find(
          ":3:24: error: there is no table 'dept' for the figure\n  hint: there are: depth, depth_mean"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find(":4:24: error: 'y' of a curve from 'depth_mean': unknown name 'meen'"),
            std::string::npos)
      << text;
  EXPECT_GT(std::filesystem::file_size(dir / "post/depth_mean.csv"), 50u);
}

TEST(Post, SameTablesOnAnyNumberOfThreads) {
  ScratchFolder dir;
  write_run(dir, "jump", 12);
  const auto recipe =
      write(dir,
            "analyses:\n"
            "  - {kind: surface, name: s, x: {from: 0.1, to: 1, step: 0.05}, layers: true}\n"
            "  - {kind: profile, name: u, of: [vx, p], x: [0.3, 0.9], y: {from: 0.01, to: 0.08, step: 0.01}, "
            "interpolation: mls}\n"
            "  - {kind: spectrum, name: f, of: s}\n"
            "  - {kind: flux, name: q, at: [0.3, 0.9]}\n");
  std::map<std::string, std::string> first;
  for (int n : {1, 2, 4}) {
    set_threads(n);
    Diagnostics diagnostics;
    ASSERT_TRUE(run_post(
        recipe, dir.path(), [](std::string_view) {}, diagnostics))
        << diagnostics.text();
    for (const char* name : {"s", "s_mean", "s_layers", "u", "f", "f_peaks", "q", "q_mean"}) {
      const std::string text = test::read_text(dir / ("post/" + std::string(name) + ".csv"));
      EXPECT_GT(text.size(), 50u);
      EXPECT_EQ(first.emplace(name, text).first->second, text) << name << " on " << n << " threads";
    }
  }
  set_threads(0);
}

TEST(Recipe, ThePapersFiguresAreSound) {
  Diagnostics diagnostics;
  const auto recipe =
      read_recipe(std::string(SOURCE_DIR) + "/keyword_decks/hydraulic_jump/paper_figures.yaml", diagnostics);
  ASSERT_TRUE(recipe) << diagnostics.text();
  EXPECT_EQ(recipe->analyses.size(), 11u);
  EXPECT_EQ(recipe->figures.size(), 13u);
}

TEST(Recipe, BadFiles) {
  ScratchFolder dir;
  Diagnostics missing, broken, empty;
  EXPECT_FALSE(read_recipe(dir / "no.yaml", missing));
  EXPECT_NE(missing.text().find("no.yaml: error: cannot read the recipe"), std::string::npos)
      << missing.text();
  EXPECT_FALSE(read_recipe(write(dir, "jump: [1, 2\n"), broken));
  EXPECT_NE(broken.text().find("not valid YAML"), std::string::npos) << broken.text();
  EXPECT_FALSE(read_recipe(write(dir, "case: d1/4\n"), empty));
  EXPECT_NE(empty.text().find("asks for nothing"), std::string::npos) << empty.text();
}

TEST(Recipe, ThePapersRowsAreThere) {
  Diagnostics diagnostics;
  const auto recipe = read_recipe(jump_recipe, diagnostics);
  ASSERT_TRUE(recipe) << diagnostics.text();
  ASSERT_EQ(recipe->jump->published.size(), 5u);
  EXPECT_EQ(recipe->jump->published[3].A, 0.936);
  EXPECT_EQ(recipe->jump->published[4].interval.to, 30);
  EXPECT_EQ(recipe->snapshots->times.size(), 6u);
}

}  // namespace
}  // namespace courant
