// elout in binout and history.h5.
#include <fmt/format.h>

#include "elements/histories/elout_text.hpp"

namespace courant {
namespace {

constexpr const char* axes[] = {"xx", "yy", "zz", "xy", "yz", "zx"};

/// A point with its element: binout has arrays over the points of all elements.
struct EloutPoint {
  const EloutElement* element;
  const PointReport* point;
};

/// Number of a state in `states` of the metadata, from 1 on.
int state_of(const EloutPoint& one) {
  return one.element->report.deleted ? 3 : one.point->plastic > 0 ? 2 : 1;
}

void add_points(const std::string& folder, const std::vector<EloutPoint>& points, ElementKind kind,
                HistoryNumbers& to) {
  std::vector<HistoryArray>& state = to.folder(folder).state;
  const auto add = [&](const std::string& name, const auto& of) {
    std::vector<Real> values;
    for (const EloutPoint& one : points) values.push_back(of(one) + 0.0);  // no -0
    state.push_back({name, std::move(values)});
  };
  if (kind == ElementKind::beam) {
    constexpr std::pair<const char*, std::size_t> names[] = {
        {"sigma_11", 0}, {"sigma_12", 3}, {"sigma_31", 5}};
    for (const auto& [name, k] : names)
      add(name, [k = k](const EloutPoint& one) { return one.point->stress[k]; });
    return add("plastic_eps", [](const EloutPoint& one) { return one.point->plastic; });
  }
  std::vector<std::int64_t> states;
  for (const EloutPoint& one : points) states.push_back(state_of(one));
  state.push_back({"state", std::move(states)});
  for (std::size_t k = 0; k < 6; ++k)
    add(fmt::format("sig_{}", axes[k]), [k](const EloutPoint& one) { return one.point->stress[k]; });
  if (kind == ElementKind::shell)
    return add("plastic_strain", [](const EloutPoint& one) { return one.point->plastic; });
  add("effsg", [](const EloutPoint& one) { return effective_stress(one.point->stress); });
  add("yield", [](const EloutPoint& one) { return one.point->plastic; });
}

void add_history(const std::string& folder, const std::vector<EloutPoint>& points, int count,
                 HistoryNumbers& to) {
  for (int k = 0; k < count; ++k) {
    std::vector<Real> values;
    const auto at = static_cast<std::size_t>(k);
    for (const EloutPoint& one : points)
      values.push_back(at < one.point->history.size() ? one.point->history[at] + 0.0 : 0);
    to.folder(folder).state.push_back({fmt::format("history_{}", k + 1), std::move(values)});
  }
}

/// Datasets of history.h5 of the points of an element; their names are those of the field files.
template <class Rows>
void add_datasets(Rows& rows, std::size_t row, const ElementReport& report, ElementKind kind,
                  const EloutContent& content) {
  const int history = content.history;
  const bool strains = content.strains && kind == ElementKind::solid;
  const std::size_t count = report.points.size();
  for (std::size_t p = 0; p < count; ++p) {
    const PointReport& point = report.points[p];
    const std::string of = count == 1 ? "" : fmt::format("_of_point_{}", p + 1);
    if (kind == ElementKind::beam)
      rows.value(row, "beam_stress" + of, "M/LT2", {point.stress[0], point.stress[3], point.stress[5]});
    else
      rows.value(row, "stress" + of, "M/LT2", {point.stress.begin(), point.stress.end()});
    rows.value(row, "plastic_strain" + of, "-", {point.plastic});
    if (strains) rows.value(row, "strain" + of, "-", {point.strain.begin(), point.strain.end()});
    for (std::size_t k = 0; k < static_cast<std::size_t>(history) && k < point.history.size(); ++k)
      rows.value(row, fmt::format("history_{}{}", k + 1, of), "-", {point.history[k]});
  }
}

/// Of shells at the lowest and at the uppermost point.
template <class Rows>
void add_outer_strains(const std::vector<EloutElement>& elements, Rows& rows) {
  for (const bool upper : {false, true}) {
    const std::string side = upper ? "upper" : "lower";
    const auto strain = [upper](const EloutElement& e) {
      if (e.report.points.empty()) return std::array<Real, 6>{};
      return (upper ? e.report.points.back() : e.report.points.front()).strain;
    };
    for (std::size_t k = 0; k < 6; ++k)
      rows.real(fmt::format("{}_eps_{}", side, axes[k]),
                [&strain, k](const EloutElement& e) { return strain(e)[k]; });
    std::size_t row = 0;
    for (const EloutElement& e : elements) {
      const std::array<Real, 6> tensor = strain(e);
      rows.value(row++, "strain_" + side, "-", {tensor.begin(), tensor.end()});
    }
  }
}

}  // namespace

void add_elout_numbers(ElementKind kind, const std::vector<EloutElement>& elements,
                       const EloutContent& content, HistoryNumbers& to) {
  using E = EloutElement;
  constexpr const char* folders[] = {"solid", "beam", "shell"};
  const std::string folder = folders[static_cast<std::size_t>(kind)];
  HistoryRows rows(to, folder, elements, &E::id, folder + "s");
  rows.integer("ids", &E::id).integer(kind == ElementKind::solid ? "mtype" : "mat", &E::part);
  rows.integer("nip", [](const E& e) { return e.report.points.size(); });
  std::vector<HistoryArray>& fixed = to.folder(folder).fixed;
  if (kind == ElementKind::beam) {
    rows.integer("mtype", &E::material);
    constexpr const char* names[] = {"axial", "shear_s", "shear_t", "moment_s", "moment_t", "torsion"};
    for (std::size_t k = 0; k < 6; ++k)
      rows.real(
          names[k], [k](const E& e) { return e.report.resultants[k]; }, k < 3 ? "ML/T2" : "ML2/T2");
  } else {
    fixed.push_back({"states", std::string("elastic,plastic,failed")});
    fixed.push_back(
        {"system", std::string(content.local && kind == ElementKind::shell ? "local " : "global")});
  }
  if (kind == ElementKind::shell) rows.integer("iop", [](const E&) { return 1; });
  std::vector<EloutPoint> points;
  std::size_t row = 0;
  for (const E& e : elements) {
    for (const PointReport& point : e.report.points) points.push_back({&e, &point});
    rows.value(row, "deleted", "-", {Real(e.report.deleted)});
    add_datasets(rows, row++, e.report, kind, content);
  }
  if (content.strains && kind == ElementKind::shell) add_outer_strains(elements, rows);
  if (points.empty()) return;
  add_points(folder, points, kind, to);
  add_history(folder, points, content.history, to);
  for (std::size_t k = 0; content.strains && kind == ElementKind::solid && k < 6; ++k) {
    std::vector<Real> values;
    for (const EloutPoint& one : points) values.push_back(one.point->strain[k] + 0.0);
    to.folder(folder).state.push_back({fmt::format("eps_{}", axes[k]), std::move(values)});
  }
}

}  // namespace courant
