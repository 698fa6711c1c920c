// Observations against their references.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verify/formula.hpp"
#include "verify/observe.hpp"
#include "verify/reference.hpp"

namespace courant {
namespace {

constexpr std::size_t points_of_report = 400;

/// Rows of the table in the units of the observation.
Series scaled_table(const SuiteReference& reference, const Variables& variables, std::string& why) {
  Diagnostics faults;
  const ReferenceTable table = read_table(reference.csv, reference.csv_x, reference.csv_y, faults);
  if (!faults.ok()) why = faults.all().front().text();
  const Real scale_x = constant_value(reference.scale_x, variables, why),
             scale_y = constant_value(reference.scale_y, variables, why),
             offset_x = constant_value(reference.offset_x, variables, why),
             offset_y = constant_value(reference.offset_y, variables, why);
  if (scale_x == 0) why = "scale_x is 0";
  if (!why.empty()) return {};
  Series out;
  for (std::size_t i = 0; i < table.x.size(); ++i) {
    out.x.push_back(scale_x * table.x[i] + offset_x);
    out.y.push_back(scale_y * table.y[i] + offset_y);
  }
  if (scale_x < 0) {
    std::reverse(out.x.begin(), out.x.end());
    std::reverse(out.y.begin(), out.y.end());
  }
  return out;
}

/// Points at the same place, as particles of a row have them, become their mean.
Series merged(const Series& s) {
  Series out;
  const Real slack = s.size() > 1 ? 1e-6 * (s.x.back() - s.x.front()) : 0;
  for (std::size_t i = 0; i < s.size();) {
    std::size_t end = i;
    Real x = 0, y = 0;
    for (; end < s.size() && s.x[end] <= s.x[i] + slack; ++end) x += s.x[end], y += s.y[end];
    const Real n = static_cast<Real>(end - i);
    out.x.push_back(x / n);
    out.y.push_back(y / n);
    i = end;
  }
  return out;
}

/// The reference as values at points of the observation.
struct AtPoints {
  std::vector<Real> y, reference;  ///< where the reference is known
  Series shown;                    ///< the reference for the report
  std::string why;
};

AtPoints formula_at_points(const SuiteObservation& o, const Measured& m, const Variables& variables) {
  AtPoints out;
  out.reference = m.formula;
  if (o.kind != SuiteObservation::Kind::profile) {
    Formula formula(o.reference.formula, {"t"}, variables);
    if (!formula.ok()) return {{}, {}, {}, formula.error()};
    for (const Real t : m.series.x) out.reference.push_back(formula({t}));
  }
  out.y = m.series.y;
  for (std::size_t i = 0; i < out.reference.size(); ++i)
    if (!std::isfinite(out.reference[i]))
      return {{}, {}, {}, fmt::format("the reference is not finite at {:.6g}", m.series.x[i])};
  out.shown = thinned({m.series.x, out.reference}, points_of_report);
  return out;
}

AtPoints curve_at_points(const Measured& m, const Series& reference) {
  AtPoints out;
  if (reference.size() == 0 || m.series.size() == 0) return out;
  for (std::size_t i = 0; i < m.series.size(); ++i) {
    const auto value = value_at(reference, m.series.x[i]);
    if (!value) continue;
    out.y.push_back(m.series.y[i]);
    out.reference.push_back(*value);
  }
  out.shown = thinned(window(reference, m.series.x.front(), m.series.x.back()), points_of_report);
  if (out.shown.size() == 0) out.shown = thinned(reference, points_of_report);
  if (out.y.empty())
    out.why = fmt::format(
        "the reference, from {:.6g} to {:.6g}, and the observation, from {:.6g} to {:.6g}, "
        "have no place in common",
        reference.x.front(), reference.x.back(), m.series.x.front(), m.series.x.back());
  return out;
}

/// What the error is divided by: the scale of the suite, or `otherwise`.
Real scale_of(const SuiteObservation& o, const Variables& variables, Real otherwise, std::string& why) {
  const Real scale =
      o.scale.empty() ? std::abs(otherwise) : std::abs(constant_value(o.scale, variables, why));
  if (scale == 0) why = o.scale.empty() ? "the reference is 0: give a 'scale' for its error" : "'scale' is 0";
  return scale;
}

/// The curve shifted so that it first reaches the y of a row of the reference, counted from 1, at its x.
Series aligned(Series series, const Series& reference, int row, std::string& why) {
  const std::size_t k = static_cast<std::size_t>(row) - 1;
  if (k >= reference.size()) {
    why = fmt::format("'align': the reference has no row {}", row);
    return series;
  }
  const Real level = reference.y[k];
  for (std::size_t i = 0; i + 1 < series.size(); ++i) {
    const Real a = series.y[i] - level, b = series.y[i + 1] - level;
    if (a * b > 0 || a == b) continue;
    const Real x = series.x[i] + (series.x[i + 1] - series.x[i]) * a / (a - b);
    for (Real& each : series.x) each += reference.x[k] - x;
    return series;
  }
  why = fmt::format("the curve never reaches {:.6g}, row {} of the reference", level, row);
  return series;
}

void compare_curve(const SuiteObservation& o, const Measured& measured, const Variables& variables,
                   const Measured* finest, Observed& out) {
  Measured m = measured;
  AtPoints at;
  if (o.reference.kind == SuiteReference::Kind::formula) at = formula_at_points(o, m, variables);
  if (o.reference.kind == SuiteReference::Kind::csv) {
    std::string why;
    const Series table = scaled_table(o.reference, variables, why);
    if (o.align > 0 && why.empty()) {
      m.series = aligned(std::move(m.series), table, o.align, why);
      const Series shown = thinned(m.series, points_of_report);
      out.curve.x = shown.x, out.curve.y = shown.y;
    }
    at = curve_at_points(m, table);
    if (!why.empty()) at.why = why;
  }
  if (o.reference.kind == SuiteReference::Kind::finest) at = curve_at_points(m, merged(finest->series));
  out.curve.reference_x = std::move(at.shown.x), out.curve.reference_y = std::move(at.shown.y);
  out.why = at.why;
  if (!out.why.empty()) return;
  std::vector<Real> difference;
  for (std::size_t i = 0; i < at.y.size(); ++i) difference.push_back(at.y[i] - at.reference[i]);
  const Real scale = scale_of(o, variables, norm_of(at.reference, o.norm), out.why);
  if (out.why.empty()) out.error = norm_of(difference, o.norm) / scale;
}

std::optional<Real> number_of_table(const SuiteObservation& o, const Measured& m, const Variables& variables,
                                    std::string& why) {
  const Series table = scaled_table(o.reference, variables, why);
  if (!why.empty()) return std::nullopt;
  const MeasuredTimes range = window_of(o, variables);
  if (o.take == "final" || o.take == "at") {
    const Real x = o.take == "at" ? *range.at : m.series.x.back();
    const auto value = value_at(table, x);
    if (!value) why = fmt::format("the reference does not reach {:.6g}", x);
    return value;
  }
  const Taken taken = take_number(window(table, range.from, range.to), o.take, range.at);
  if (!taken.value) why = "reference: " + taken.why;
  return taken.value;
}

void compare_number(const SuiteObservation& o, const Measured& m, const Variables& variables,
                    const Measured* finest, Observed& out) {
  if (o.reference.kind == SuiteReference::Kind::formula) {
    Formula formula(o.reference.formula, {"t"}, variables);
    if (!formula.ok()) {
      out.why = formula.error();
      return;
    }
    const Real value = formula({o.take == "at" ? *window_of(o, variables).at : m.series.x.back()});
    if (std::isfinite(value))
      out.reference = value;
    else
      out.why = "the reference is not finite";
  } else if (o.reference.kind == SuiteReference::Kind::csv) {
    out.reference = number_of_table(o, m, variables, out.why);
  } else {
    out.reference = finest->value;
  }
  if (!out.reference) return;
  const Real scale = scale_of(o, variables, *out.reference, out.why);
  if (out.why.empty()) out.error = std::abs(*m.value - *out.reference) / scale;
}

}  // namespace

Observed compare_observation(const SuiteObservation& o, const Measured& m, const Variables& variables,
                             const Measured* finest) {
  Observed out;
  out.name = o.name;
  out.found = m.found;
  out.why = m.why;
  if (!m.found) return out;
  const Series shown = thinned(m.series, points_of_report);
  out.curve.x = shown.x, out.curve.y = shown.y;
  out.value = m.value;
  using Reference = SuiteReference::Kind;
  if (o.reference.kind == Reference::none) return out;
  if (o.reference.kind == Reference::finest) {
    if (!finest) return out;  // this is the finest run
    if (!finest->found) {
      out.why = "the finest run has no value: " + finest->why;
      return out;
    }
  }
  if (o.take == "curve")
    compare_curve(o, m, variables, finest, out);
  else
    compare_number(o, m, variables, finest, out);
  return out;
}

}  // namespace courant
