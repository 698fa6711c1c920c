#include "post/post.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "output/file.hpp"
#include "post/figures.hpp"
#include "post/free_surface.hpp"
#include "post/jump.hpp"
#include "post/pictures.hpp"
#include "post/recipe.hpp"
#include "post/results.hpp"
#include "post/run_analyses.hpp"

namespace courant {
namespace {

constexpr Real not_there = std::numeric_limits<Real>::quiet_NaN();

struct Measured {
  std::vector<Real> t;
  JumpSeries jump;
  std::vector<std::vector<Real>> probes;    // shape: (probes, states)
  std::string snapshots = "t,x,y,speed\n";  // CSV
};

Real toe(const FreeSurface& surface, const JumpRecipe& jump) {
  const Interval range = jump.toe_range;
  const Real step = 0.25 * jump.d1;
  const int n = static_cast<int>(std::floor((range.to - range.from) / step * (1 + 1e-12)));
  for (int k = 0; k <= n; ++k)
    if (surface.depth(range.from + k * step, jump.bed, jump.z) > jump.toe_threshold * jump.d1)
      return range.from + k * step;
  return not_there;
}

void measure_jump(const ParticleFrame& frame, const JumpRecipe& jump, JumpSeries& series) {
  const auto depth_at = [&](Real x) { return FreeSurface(frame, x, x).depth(x, jump.bed, jump.z); };
  series.t.push_back(frame.t);
  series.depth.push_back(depth_at(jump.x));
  if (jump.front_x) series.front.push_back(depth_at(*jump.front_x));
  const Interval range = jump.toe_range;
  if (range.from < range.to) series.toe.push_back(toe(FreeSurface(frame, range.from, range.to), jump));
}

void add_snapshot(const ParticleFrame& frame, Real t, const SnapshotRecipe& recipe, std::string& csv) {
  const auto within = [](Real a, const Interval& i) {
    return !(i.from < i.to) || (a >= i.from && a <= i.to);
  };
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (within(frame.x[i], recipe.x) && within(frame.y[i], recipe.y))
      csv += fmt::format("{:g},{:.6g},{:.6g},{:.5g}\n", t, frame.x[i], frame.y[i], frame.speed[i]);
}

/// Which state shows which wanted time: the nearest one. Where that is off by more than a tenth of what lies
/// between states, the picture has the state's own time.
std::multimap<std::size_t, Real> snapshot_states(const Recipe& recipe, const std::vector<StateFiles>& states,
                                                 Diagnostics& diagnostics) {
  std::multimap<std::size_t, Real> out;
  if (!recipe.snapshots) return out;
  const Real spacing =
      states.size() > 1 ? (states.back().t - states.front().t) / static_cast<Real>(states.size() - 1) : 0;
  for (Real t : recipe.snapshots->times) {
    const auto nearest = std::min_element(
        states.begin(), states.end(),
        [&](const StateFiles& a, const StateFiles& b) { return std::abs(a.t - t) < std::abs(b.t - t); });
    const Real off = std::abs(nearest->t - t);
    const auto state = static_cast<std::size_t>(nearest - states.begin());
    if (off <= 0.1 * spacing + 1e-12)
      out.emplace(state, t);
    else if (off <= spacing && out.count(state) == 0)
      out.emplace(state, nearest->t);
    else if (off > spacing)
      diagnostics.warning({recipe.file},
                          fmt::format("no picture of t = {:g}: the results go from {:g} to {:g}", t,
                                      states.front().t, states.back().t));
  }
  return out;
}

/// Looks at states for the jump, the depth probes and the snapshots; `out` and `wanted` must outlive it.
StateReader measuring_reader(const Recipe& recipe, const std::multimap<std::size_t, Real>& wanted,
                             Measured& out) {
  out.probes.resize(recipe.probes.size());
  const bool series = recipe.jump || !recipe.probes.empty();
  StateReader reader;
  reader.wants = [series, &wanted](std::size_t s) { return series || wanted.count(s) > 0; };
  reader.wants_speed = [&wanted](std::size_t s) { return wanted.count(s) > 0; };
  reader.take = [&recipe, &wanted, &out](std::size_t s, const ParticleFrame& frame) {
    out.t.push_back(frame.t);
    if (recipe.jump) measure_jump(frame, *recipe.jump, out.jump);
    for (std::size_t i = 0; i < recipe.probes.size(); ++i) {
      const ProbeRecipe& probe = recipe.probes[i];
      out.probes[i].push_back(FreeSurface(frame, probe.x, probe.x).depth(probe.x, probe.bed, probe.z));
    }
    const auto [first, last] = wanted.equal_range(s);
    for (auto w = first; w != last; ++w) add_snapshot(frame, w->second, *recipe.snapshots, out.snapshots);
  };
  return reader;
}

std::string read_title(const std::filesystem::path& dir, Diagnostics& diagnostics) {
  const std::string file = (dir / "summary.yaml").string();
  try {
    if (std::filesystem::is_directory(file)) return {};
    const YAML::Node summary = YAML::LoadFile(file);
    if (summary.IsMap() && summary["title"] && summary["title"].IsScalar()) return summary["title"].Scalar();
  } catch (const YAML::BadFile&) {  // a run that still goes on has none yet
  } catch (const YAML::ParserException& e) {
    diagnostics.warning({file, e.mark.line + 1, e.mark.column + 1}, "not valid YAML: " + e.msg);
  }
  return {};
}

std::string depth_csv(const Recipe& recipe, const Measured& measured, const std::optional<JumpResult>& jump) {
  std::string out = "t";
  if (jump) out += ",depth,depth_over_theory";
  if (jump && !jump->series.toe.empty()) out += ",toe";
  if (jump && !jump->series.front.empty()) out += ",front_depth";
  for (const ProbeRecipe& probe : recipe.probes) out += "," + probe.name;
  out += "\n";
  for (std::size_t i = 0; i < measured.t.size(); ++i) {
    out += fmt::format("{:.9g}", measured.t[i]);
    if (jump)
      out += fmt::format(",{:.6g},{:.6g}", jump->series.depth[i], jump->series.depth[i] / jump->d2_theory);
    if (jump && !jump->series.toe.empty()) out += fmt::format(",{:.6g}", jump->series.toe[i]);
    if (jump && !jump->series.front.empty()) out += fmt::format(",{:.6g}", jump->series.front[i]);
    for (const auto& probe : measured.probes) out += fmt::format(",{:.6g}", probe[i]);
    out += "\n";
  }
  return out;
}

/// A number with the digits that mean something.
std::string digits(Real value) {
  return fmt::format("{:.9g}", value);
}

YAML::Node jump_node(const JumpRecipe& recipe, const JumpResult& jump) {
  YAML::Node out;
  out["x"] = digits(recipe.x);
  out["Fr1"] = digits(jump.Fr1);
  out["d2_theory"] = digits(jump.d2_theory);
  for (const IntervalResult& r : jump.intervals) {
    YAML::Node row;
    row["from"] = digits(r.interval.from);
    row["to"] = digits(r.interval.to);
    row["states"] = r.states;
    row["complete"] = r.complete;
    if (r.states > 0) {
      row["A"] = digits(r.A);
      row["P"] = digits(r.P);
      row["mean_depth"] = digits(r.mean_depth);
    }
    for (const PublishedRow& p : r.published) {
      YAML::Node published;
      published["case"] = p.case_name;
      published["A"] = digits(p.A);
      published["P"] = digits(p.P);
      row["published"].push_back(published);
    }
    out["intervals"].push_back(row);
  }
  if (recipe.front_x) out["front"]["x"] = digits(*recipe.front_x);
  if (jump.front_time) out["front"]["time"] = digits(*jump.front_time);
  if (jump.turn) {
    out["turn"]["time"] = digits(jump.turn->first);
    out["turn"]["x"] = digits(jump.turn->second);
  }
  if (!jump.series.toe.empty() && !std::isnan(jump.series.toe.back()))
    out["toe_at_end"] = digits(jump.series.toe.back());
  return out;
}

std::string results_yaml(const Recipe& recipe, const std::string& title, const Measured& measured,
                         const std::optional<JumpResult>& jump) {
  YAML::Node out;
  out["recipe"] = recipe.file;
  out["title"] = title;
  if (jump) {
    out["case"] = jump->case_name;
    out["jump"] = jump_node(*recipe.jump, *jump);
  }
  for (std::size_t i = 0; i < recipe.probes.size(); ++i) {
    YAML::Node probe;
    probe["name"] = recipe.probes[i].name;
    probe["x"] = digits(recipe.probes[i].x);
    probe["last_depth"] = digits(measured.probes[i].back());
    out["probes"].push_back(probe);
  }
  for (const auto& analysis : recipe.analyses)
    for (const PostScalar& scalar : analysis->result().scalars) {
      YAML::Node number;
      number["value"] = std::isnan(scalar.value) ? ".nan" : digits(scalar.value);
      number["unit"] = scalar.unit;
      out["analyses"][analysis->name()][scalar.name] = number;
    }
  YAML::Emitter text;
  text << out;
  return std::string(text.c_str()) + "\n";
}

/// Settings of the plot script: JSON, which YAML's flow style with quoted texts is.
std::string plot_json(const Recipe& recipe, const std::string& title, const std::optional<JumpResult>& jump) {
  const auto pair = [](const Interval& i) {
    return i.from < i.to ? fmt::format("[{:g}, {:g}]", i.from, i.to) : std::string("null");
  };
  std::string out = fmt::format("{{\"title\": {}", json_quoted(title));
  if (jump) {
    out += fmt::format(", \"jump\": {{\"x\": {:g}, \"d2_theory\": {:.9g}, \"case\": {}, \"intervals\": [",
                       recipe.jump->x, jump->d2_theory, json_quoted(jump->case_name));
    const char* comma = "";
    for (const IntervalResult& r : jump->intervals) {
      if (r.states == 0) continue;
      out += fmt::format("{}{{\"from\": {:g}, \"to\": {:g}, \"A\": {:.6g}, \"P\": {:.6g}}}", comma,
                         r.interval.from, r.interval.to, r.A, r.P);
      comma = ", ";
    }
    out += "]}";
  }
  if (recipe.snapshots)
    out += fmt::format(", \"snapshots\": {{\"speed\": {}, \"x\": {}, \"y\": {}}}",
                       pair(recipe.snapshots->range), pair(recipe.snapshots->x), pair(recipe.snapshots->y));
  return out + "}\n";
}

std::string walls_csv(const std::vector<WallLine>& walls) {
  std::string out = "x0,y0,x1,y1\n";
  std::set<std::string> seen;  // shells side by side in z have the same trace
  for (const WallLine& w : walls) {
    std::string line = fmt::format("{:.6g},{:.6g},{:.6g},{:.6g}\n", w[0], w[1], w[2], w[3]);
    if (seen.insert(line).second) out += line;
  }
  return out;
}

/// Files of the jump, the probes and the snapshots in the run's folder.
void write_measured(const Recipe& recipe, const std::filesystem::path& dir, const Measured& measured,
                    const std::optional<JumpResult>& jump, const std::string& title,
                    const std::vector<WallLine>& walls, const std::function<void(std::string_view)>& say,
                    Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < recipe.probes.size(); ++i)
    say(fmt::format("Depth at {} (x = {:g} m): {:.4f} m at t = {:.3g} s, see depth.csv\n",
                    recipe.probes[i].name, recipe.probes[i].x, measured.probes[i].back(), measured.t.back()));
  if (jump || !recipe.probes.empty()) write_file(dir / "depth.csv", depth_csv(recipe, measured, jump));
  if (recipe.snapshots) {
    write_file(dir / "snapshots.csv", measured.snapshots);
    write_file(dir / "walls.csv", walls_csv(walls));
  }
  if (jump || recipe.snapshots) {
    write_file(dir / "plot.json", plot_json(recipe, title, jump));
    if (draw_pictures(dir, "plot.py", diagnostics)) say(fmt::format("Pictures: {}/*.png\n", dir.string()));
  }
}

void write_figures(const Recipe& recipe, const std::filesystem::path& folder, const std::string& title,
                   const std::vector<WallLine>& walls, const std::function<void(std::string_view)>& say,
                   Diagnostics& diagnostics) {
  std::vector<PostTable> tables;
  std::vector<PostImage> images;
  for (const auto& analysis : recipe.analyses) {
    const PostResult& result = analysis->result();
    tables.insert(tables.end(), result.tables.begin(), result.tables.end());
    images.insert(images.end(), result.images.begin(), result.images.end());
  }
  const std::string json =
      figures_json(recipe.figures, tables, images, walls, recipe.formats, title, diagnostics);
  write_file(folder / "figures.json", json);
  if (!diagnostics.ok()) return;  // a figure without one of its curves would mislead
  if (draw_pictures(folder, "plot_figures.py", diagnostics))
    say(fmt::format("{} figures: {}\n", recipe.figures.size(), folder.string()));
}

/// A recipe of histories alone, which also a folder without field states serves: LS-DYNA's, for example.
bool reads_histories_only(const Recipe& recipe) {
  return !recipe.jump && recipe.probes.empty() && !recipe.snapshots && !recipe.analyses.empty() &&
         std::none_of(recipe.analyses.begin(), recipe.analyses.end(),
                      [](const auto& analysis) { return analysis->needs_states(); });
}

/// Arrays of the field files that the analyses need.
std::vector<ParticleArray> needed_arrays(const Recipe& recipe) {
  std::vector<ParticleArray> out;
  for (const auto& analysis : recipe.analyses) {
    if (!analysis->needs_states()) continue;
    if (out.empty()) out.push_back({"active", 1});
    analysis->note_needs(out);
  }
  return out;
}

}  // namespace

bool run_post(const std::filesystem::path& recipe_file, const std::filesystem::path& dir,
              const std::function<void(std::string_view)>& say, Diagnostics& diagnostics,
              const std::function<void(const std::string&)>& progress) {
  const auto recipe = read_recipe(recipe_file, diagnostics);
  if (!recipe) return false;
  const bool without_states = reads_histories_only(*recipe) && !std::filesystem::exists(dir / "fields.pvd");
  const auto states = without_states ? std::vector<StateFiles>{} : read_states(dir, diagnostics);
  if (states.empty() && !without_states) return false;
  Measured measured;
  const auto wanted = snapshot_states(*recipe, states, diagnostics);
  const std::filesystem::path folder = dir / recipe->folder;
  const std::vector<StateReader> readers{measuring_reader(*recipe, wanted, measured),
                                         analysis_reader(recipe->analyses, states, folder)};
  if (!stream_states(states, readers, needed_arrays(*recipe), progress, diagnostics)) return false;

  const std::string title = read_title(dir, diagnostics);
  std::optional<JumpResult> jump;
  if (recipe->jump) {
    const std::string name =
        recipe->case_name.empty() ? find_case(title, recipe->jump->published) : recipe->case_name;
    jump = evaluate_jump(*recipe->jump, name, measured.jump);
    say(jump_text(*recipe->jump, *jump));
  }
  if (!recipe->analyses.empty()) finish_analyses(recipe->analyses, dir, folder, say, diagnostics);
  write_file(dir / "results.yaml", results_yaml(*recipe, title, measured, jump));
  const auto walls = without_states ? std::vector<WallLine>{} : read_walls(states.front(), diagnostics);
  write_measured(*recipe, dir, measured, jump, title, walls, say, diagnostics);
  if (!recipe->figures.empty()) write_figures(*recipe, folder, title, walls, say, diagnostics);
  return diagnostics.ok();
}

}  // namespace courant
