#include "verify/suite_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "verify/formula.hpp"
#include "verify/plan.hpp"
#include "verify/reference.hpp"

namespace courant {
namespace {

using Over = CheckedExpression::Over;
using Kind = SuiteObservation::Kind;

/// The fault of an expression, or nothing.
void check_expression(const CheckedExpression& e, const SuiteCase& definition, const Variables& parameters,
                      Diagnostics& diagnostics) {
  std::string text = e.text;
  std::vector<std::string> variables;
  if (e.over == Over::time) variables = {"t"};
  if (e.over == Over::particles) variables = particle_variables();
  if (e.over == Over::histories) {
    HistoryText history = find_history_names(text);
    text = history.text;
    variables = history.words;
    variables.push_back("t");
  }
  if (e.over == Over::outcome) {
    variables = outcome_names();
    for (const SuiteObservation& o : definition.observations) variables.push_back(o.name);
  }
  const Formula formula(text, variables, parameters);
  if (formula.ok()) return;
  std::string hint = formula.hint();
  if (hint.empty() && e.over == Over::histories && e.text.find('/') == std::string::npos)
    hint = "histories are named like global/kinetic, parts/1/mass or contacts/1/force.y";
  if (hint.empty() && !definition.deck.empty() && formula.error().starts_with("unknown name"))
    hint = "of a deck, those parameters are known to which the suite gives a number";
  diagnostics.error(e.where, fmt::format("'{}': {}", e.name, formula.error()), hint);
}

void check_settings(const MapReader& map, const SuiteCase& definition, Diagnostics& diagnostics) {
  std::set<std::string> settings, observations;
  for (const SuiteSetting& setting : definition.settings) {
    if (!settings.insert(setting.name).second)
      map.error(map.node(), fmt::format("two settings are called '{}'", setting.name));
    if (!setting.resolutions.empty() && definition.resolution.empty())
      map.error(map.node(), fmt::format("setting '{}' has resolutions, but the case does not name the "
                                        "parameter 'resolution'",
                                        setting.name));
    if (!definition.resolution.empty() && setting.resolutions.empty() && definition.resolutions.empty())
      map.error(map.node(), fmt::format("setting '{}' has no resolutions", setting.name),
                "give 'resolutions' to the case or the setting");
  }
  for (const SuiteObservation& o : definition.observations) {
    if (!observations.insert(o.name).second)
      map.error(map.node(), fmt::format("two observations are called '{}'", o.name));
    for (const std::string& name : o.bound_settings)
      if (!settings.contains(name))
        diagnostics.error(definition.where,
                          fmt::format("observation '{}': bound_settings names '{}', which is no "
                                      "setting",
                                      o.name, name),
                          fmt::format("settings: {}", fmt::join(settings, ", ")));
  }
}

/// Whether there are runs enough for what is asked of them.
void check_counts(const MapReader& map, const SuiteCase& definition) {
  for (const SuiteSetting& setting : definition.settings) {
    const std::size_t runs = std::max<std::size_t>(
        1, (setting.resolutions.empty() ? definition.resolutions : setting.resolutions).size());
    for (const SuiteObservation& o : definition.observations) {
      const bool finest = o.reference.kind == SuiteReference::Kind::finest;
      if (finest && runs < 2)
        map.error(map.node(),
                  fmt::format("observation '{}' is compared with the finest run, but setting '{}' has "
                              "one run",
                              o.name, setting.name));
      const bool counts =
          o.bound_settings.empty() ||
          std::find(o.bound_settings.begin(), o.bound_settings.end(), setting.name) != o.bound_settings.end();
      if (o.least_order && counts && runs < (finest ? 3u : 2u))
        map.error(map.node(), fmt::format("observation '{}': an order needs {} resolutions at least", o.name,
                                          finest ? 3 : 2));
    }
  }
  for (const SuiteObservation& o : definition.observations)
    if (o.least_order && definition.size.empty())
      map.error(map.node(), fmt::format("observation '{}': an order needs the 'size' of the case", o.name),
                "for example size: dx");
}

void check_stability(const MapReader& map, const SuiteCase& definition) {
  if (!definition.resolution.empty())
    map.error(map.node(), "a stability case has no 'resolution'", "sweep the parameter");
  for (const SuiteObservation& o : definition.observations)
    if (o.bound || o.least_order)
      map.error(map.node(),
                fmt::format("observation '{}': bounds of a stability case are its limits", o.name),
                fmt::format("write a limit with 'value: {}'", o.name));
}

}  // namespace

Over over_of_formula(const SuiteObservation& o) {
  if (o.kind == Kind::profile) return o.take == "curve" ? Over::particles : Over::nothing;
  return o.take == "curve" || o.take == "final" || o.take == "at" ? Over::time : Over::nothing;
}

const std::vector<std::string>& outcome_names() {
  static const std::vector<std::string> names = {"residual", "ratio", "leaked", "penetration", "steps"};
  return names;
}

void check_observation(const MapReader& map, const SuiteObservation& o) {
  const auto fault = [&](const char* key, const std::string& message) {
    map.error(map.has(key) ? *map.get(key, true) : map.node(), message);
  };
  const bool history = o.kind == Kind::history, profile = o.kind == Kind::profile;
  if (history && map.has("where")) fault("where", "'where' belongs to particles and profiles");
  if (!profile && map.has("along")) fault("along", "'along' belongs to profiles");
  if (o.kind != Kind::particles && o.bins == 0 && map.has("reduce"))
    fault("reduce", "'reduce' belongs to kind: particles, and to profiles with bins");
  if (!profile && map.has("bins")) fault("bins", "'bins' belongs to profiles");
  const bool simple = o.take == "mean" || o.take == "min" || o.take == "max";
  if (profile && o.take != "curve" && !(o.bins > 0 && simple))
    fault("take", "a profile can only be taken as a curve, one with bins also as mean, min or max");
  if (o.align && !(o.reference.kind == SuiteReference::Kind::csv && o.take == "curve"))
    fault("align", "'align' belongs to curves against a csv");
  if (profile && (o.from || o.to)) fault("from", "a profile has no window; use 'where'");
  if (o.take == "at" && !o.at) fault("take", "'take: at' needs the moment 'at'");
  if (o.at && o.take != "at" && !profile) fault("at", "'at' belongs to 'take: at' and to profiles");
  if (o.take != "curve" && map.has("norm")) fault("norm", "'norm' belongs to curves and profiles");
  const bool compared = o.reference.kind != SuiteReference::Kind::none;
  for (const char* key : {"norm", "scale", "bound", "bound_settings", "least_order"})
    if (!compared && map.has(key)) fault(key, fmt::format("'{}' needs a 'reference'", key));
}

void check_table(const MapReader& map, const SuiteReference& reference, Diagnostics& diagnostics) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(reference.csv, ignored)) return;  // told already
  Diagnostics faults;
  read_table(reference.csv, reference.csv_x, reference.csv_y, faults);
  for (const Diagnostic& fault : faults.all()) {
    diagnostics.add(fault);
    map.error(map.node(), "this reference uses a table that cannot be read, see above");
  }
}

void check_case(const MapReader& map, const SuiteCase& definition,
                const std::vector<CheckedExpression>& expressions, Diagnostics& diagnostics) {
  if (!map.node().IsMap()) return;
  if (definition.resolution.empty() && !definition.resolutions.empty())
    map.error(*map.get("resolutions", true),
              "'resolutions' need the parameter that they are values of: 'resolution'");
  if (definition.observations.empty() && !definition.stability)
    map.error(map.node(), "the case observes nothing", "give 'observations' or 'stability'");
  for (const char* key : {"picture_title", "picture_at", "picture_where"})
    if (definition.picture_of.empty() && map.has(key))
      map.error(*map.get(key, true), fmt::format("'case.{}' needs 'picture_of'", key));
  check_settings(map, definition, diagnostics);
  if (definition.stability)
    check_stability(map, definition);
  else
    check_counts(map, definition);
  if (!diagnostics.ok()) return;  // without files and names, expressions would seem wrong

  // The names of parameters are the same in all runs of a scene, so those of the first run tell them.
  const SuiteSetting& first = definition.settings.front();
  const auto& resolutions = first.resolutions.empty() ? definition.resolutions : first.resolutions;
  SuiteParameters overrides = overrides_of(definition, first, resolutions.empty() ? "" : resolutions.front());
  if (definition.stability)
    for (const auto& [name, values] : definition.stability->sweep) overrides[name] = values.front();
  Diagnostics faults;
  const Variables parameters = parameter_values(definition, overrides, faults);
  if (!faults.ok()) return;  // the plan of the runs reports it
  for (const CheckedExpression& e : expressions) check_expression(e, definition, parameters, diagnostics);
}

}  // namespace courant
