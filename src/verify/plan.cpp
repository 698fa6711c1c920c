#include "verify/plan.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <set>

#include "generate/scene.hpp"
#include "verify/formula.hpp"

namespace courant {
namespace {

/// A name that every file system takes, told apart from those in `taken` by a number.
std::string folder_name(const std::string& text, std::set<std::string>& taken) {
  constexpr std::size_t longest = 60;
  std::string name;
  for (const char c : text.substr(0, longest)) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+';
    if (plain || name.empty() || name.back() != '_') name += plain ? c : '_';
  }
  if (name.empty() || name[0] == '.') name = '_' + name;
  std::string unique = name;
  for (int k = 2; !taken.insert(unique).second; ++k) unique = fmt::format("{}_{}", name, k);
  return unique;
}

/// A set of swept values and how it is called: "tssfac = 0.9, c0 = 30".
struct SweptValues {
  std::string name;
  SuiteParameters parameters;
};

std::vector<SweptValues> swept_values(const SuiteStability& stability) {
  std::vector<SweptValues> all{{}};
  for (const auto& [name, values] : stability.sweep) {
    std::vector<SweptValues> more;
    for (const SweptValues& before : all) {
      for (const std::string& value : values) {
        SweptValues one = before;
        one.name += fmt::format("{}{} = {}", before.name.empty() ? "" : ", ", name, value);
        one.parameters[name] = value;
        more.push_back(std::move(one));
      }
    }
    all = std::move(more);
  }
  return all;
}

class Planner {
 public:
  Planner(const Suite& suite, Diagnostics& diagnostics) : suite_(suite), diagnostics_(diagnostics) {}

  std::vector<PlannedRun> plan() {
    for (std::size_t c = 0; c < suite_.cases.size(); ++c) {
      taken_.clear();
      for (const SuiteSetting& setting : suite_.cases[c].settings) {
        if (suite_.cases[c].stability)
          plan_sweep(c, setting);
        else
          plan_resolutions(c, setting);
      }
    }
    return std::move(runs_);
  }

 private:
  void plan_resolutions(std::size_t c, const SuiteSetting& setting) {
    const SuiteCase& definition = suite_.cases[c];
    std::vector<std::string> resolutions =
        setting.resolutions.empty() ? definition.resolutions : setting.resolutions;
    if (resolutions.empty()) resolutions.emplace_back();
    Real before = 0;
    for (const std::string& resolution : resolutions) {
      PlannedRun run{.of_case = c, .setting = setting.name, .resolution = resolution};
      run.parameters = overrides_of(definition, setting, resolution);
      run.finest = &resolution == &resolutions.back();
      add(std::move(run), setting.name + (resolution.empty() ? "" : "-" + resolution));
      const Real size = runs_.back().size;
      if (before > 0 && size >= before)
        diagnostics_.error(definition.where,
                           fmt::format("case {}: {} = {} has the size {:.6g}, not less than {:.6g} before it",
                                       definition.name, definition.resolution, resolution, size, before),
                           "order the resolutions from coarse to fine");
      before = size;
    }
  }

  void plan_sweep(std::size_t c, const SuiteSetting& setting) {
    const SuiteCase& definition = suite_.cases[c];
    for (const SweptValues& swept : swept_values(*definition.stability)) {
      PlannedRun run{.of_case = c, .setting = setting.name};
      if (!swept.name.empty() && definition.settings.size() == 1)
        run.setting = swept.name;
      else if (!swept.name.empty())
        run.setting += ", " + swept.name;
      run.parameters = overrides_of(definition, setting, "");
      for (const auto& [name, value] : swept.parameters) run.parameters[name] = value;
      const std::string folder = run.setting;
      add(std::move(run), folder);
    }
  }

  void add(PlannedRun run, const std::string& folder) {
    const SuiteCase& definition = suite_.cases[run.of_case];
    run.folder = std::filesystem::path("runs") / definition.name / folder_name(folder, taken_);
    Diagnostics faults;
    run.variables = parameter_values(definition, run.parameters, faults);
    for (const Diagnostic& fault : faults.all())
      if (fault.severity == Severity::error)
        diagnostics_.error(definition.where,
                           fmt::format("case {}, {}: {}", definition.name, describe(run), fault.text()));
    if (faults.ok() && !definition.size.empty()) {
      std::string why;
      run.size = constant_value(definition.size, run.variables, why);
      if (!(run.size > 0))
        diagnostics_.error(definition.where,
                           fmt::format("case {}, {}: 'size' must be > 0{}", definition.name, describe(run),
                                       why.empty() ? fmt::format(", got {}", run.size) : ": " + why));
    }
    runs_.push_back(std::move(run));
  }

  std::string describe(const PlannedRun& run) const {
    const std::string& parameter = suite_.cases[run.of_case].resolution;
    return run.resolution.empty() ? run.setting
                                  : fmt::format("{}, {} = {}", run.setting, parameter, run.resolution);
  }

  const Suite& suite_;
  Diagnostics& diagnostics_;
  std::vector<PlannedRun> runs_;
  std::set<std::string> taken_;
};

}  // namespace

Variables parameter_values(const SuiteCase& definition, const SuiteParameters& overrides,
                           Diagnostics& diagnostics) {
  Variables out{{"pi", pi}};
  if (!definition.scene.empty()) {
    const Scene scene = read_scene(definition.scene.string(), overrides, diagnostics);
    for (const auto& [name, value] : scene.parameters) out[name] = value;
    return out;
  }
  for (const auto& [name, value] : overrides)
    if (const Evaluation number = evaluate(value, {}); number.ok()) out[name] = number.value;
  return out;
}

SuiteParameters overrides_of(const SuiteCase& definition, const SuiteSetting& setting,
                             const std::string& resolution) {
  SuiteParameters out = definition.parameters;
  for (const auto& [name, value] : setting.parameters) out[name] = value;
  if (!resolution.empty()) out[definition.resolution] = resolution;
  return out;
}

std::vector<PlannedRun> plan_runs(const Suite& suite, Diagnostics& diagnostics) {
  return Planner(suite, diagnostics).plan();
}

}  // namespace courant
