// *DATABASE_EXTENT_BINARY: what integration points hold, in the field files.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "elements/element_report.hpp"
#include "extension/additions.hpp"
#include "model/requests/output_cards.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

/// A point that the files show, and what of the points of an element it is made of.
struct ShownPoint {
  std::string suffix;             ///< "_middle", "_of_point_3"
  std::vector<std::size_t> from;  ///< the mean of these
};

ShownPoint numbered(std::size_t k) {
  return {fmt::format("_of_point_{}", k + 1), {k}};
}

/// Points of elements that have `count`: with `three` lower, middle and upper, else the first `most`.
std::vector<ShownPoint> shown_points(std::size_t count, bool three, std::size_t most) {
  if (three) return {{"_lower", {0}}, {"_middle", {(count - 1) / 2, count / 2}}, {"_upper", {count - 1}}};
  std::vector<ShownPoint> out;
  for (std::size_t k = 0; k < std::min(count, most); ++k) out.push_back(numbered(k));
  return out;
}

class PointFields : public FieldFiller, public Pass {
 public:
  PointFields(const ElementReporter& reporter, std::vector<ShownPoint> points, ElementReportOptions options,
              std::size_t history)
      : reporter_(reporter), points_(std::move(points)), options_(options) {
    const bool beam = reporter.kind() == ElementKind::beam;
    const auto add = [&](std::string name, const char* dimension, int components) {
      return &reporter.reported().fields.add<Real>({.name = std::move(name),
                                                    .dimension = dimension,
                                                    .components = components,
                                                    .output = true,
                                                    .restart = false});
    };
    for (const ShownPoint& point : points_) {
      Shown& one = fields_.emplace_back();
      // the outermost stresses are there without being asked for
      if (beam)
        one.stress = add("beam_stress" + point.suffix, "M/LT2", 3);
      else if (point.suffix != "_lower" && point.suffix != "_upper")
        one.stress = add("stress" + point.suffix, "M/LT2", 6);
      one.plastic = add("plastic_strain" + point.suffix, "-", 1);
      for (std::size_t h = 0; h < history; ++h)
        one.history.push_back(add(fmt::format("history_{}{}", h + 1, point.suffix), "-", 1));
    }
  }
  std::string name() const override { return "points of " + reporter_.reported().fields.name(); }

  void fill_fields(World& world) override {
    for (Index e = 0; e < reporter_.reported().size(); ++e) {
      const ElementReport report = reporter_.report_element(world, e, options_);
      for (std::size_t p = 0; p < points_.size(); ++p) show(report, points_[p], fields_[p], e);
    }
  }

 private:
  struct Shown {
    Field<Real>*stress = nullptr, *plastic = nullptr;
    std::vector<Field<Real>*> history{};
  };
  void show(const ElementReport& report, const ShownPoint& point, const Shown& to, Index e) const {
    const auto mean = [&](const auto& of) {
      Real sum = 0;
      for (const std::size_t k : point.from) sum += of(report.points[k]);
      return sum / static_cast<Real>(point.from.size());
    };
    constexpr std::size_t of_beam[] = {0, 3, 5};
    for (int k = 0; to.stress && k < to.stress->info().components; ++k) {
      const auto c = static_cast<std::size_t>(k);
      const std::size_t at = reporter_.kind() == ElementKind::beam ? of_beam[c] : c;
      to.stress->data(k)[e] = mean([at](const PointReport& one) { return one.stress[at]; });
    }
    (*to.plastic)[e] = mean([](const PointReport& one) { return one.plastic; });
    for (std::size_t h = 0; h < to.history.size(); ++h)
      (*to.history[h])[e] =
          mean([h](const PointReport& one) { return h < one.history.size() ? one.history[h] : 0; });
  }

  const ElementReporter& reporter_;
  std::vector<ShownPoint> points_;
  ElementReportOptions options_;
  std::vector<Shown> fields_;
};

/// STRFLG: `strain_tensor` of solids, the mean over their points; `strain_lower`, `strain_upper` of shells.
class StrainFields : public FieldFiller, public Pass {
 public:
  explicit StrainFields(const ElementReporter& reporter) : reporter_(reporter) {
    const auto add = [&](const char* name) {
      fields_.push_back(&reporter.reported().fields.add<Real>(
          {.name = name, .dimension = "-", .components = 6, .output = true, .restart = false}));
    };
    if (reporter.kind() == ElementKind::solid)
      add("strain_tensor");
    else
      add("strain_lower"), add("strain_upper");
  }
  std::string name() const override { return "strains of " + reporter_.reported().fields.name(); }
  void fill_fields(World& world) override {
    for (Index e = 0; e < reporter_.reported().size(); ++e) {
      const std::vector<PointReport> points = reporter_.report_element(world, e, {}).points;
      for (std::size_t side = 0; side < fields_.size() && !points.empty(); ++side) {
        const auto& strain = (side == 0 ? points.front() : points.back()).strain;
        for (int k = 0; k < 6; ++k) fields_[side]->data(k)[e] = strain[static_cast<std::size_t>(k)];
      }
    }
  }

 private:
  const ElementReporter& reporter_;
  std::vector<Field<Real>*> fields_;
};

void build_point_fields(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  const auto* card = deck.last<DatabaseExtentBinary>();
  if (!card || (!model.output.d3plot.asked() && model.output.d3plot_count == 0)) return;
  const int maxint = card->maxint == 0 ? 3 : card->maxint;
  bool shells = false;
  for (const auto* reporter : world.passes.all<const ElementReporter>()) {
    if (reporter->reported().size() == 0) continue;
    const ElementReportOptions options{.all_points = card->nintsld == 8};
    const std::size_t count = reporter->report_element(world, 0, options).points.size();
    std::vector<ShownPoint> points;
    std::size_t history = 0;
    switch (reporter->kind()) {
      case ElementKind::shell:
        shells = true, history = static_cast<std::size_t>(card->neips);
        points = shown_points(count, maxint == 3, static_cast<std::size_t>(std::abs(maxint)));
        break;
      case ElementKind::beam:
        points = shown_points(count, false, static_cast<std::size_t>(card->beamip));
        break;
      case ElementKind::solid:
        if (count > 1) points = shown_points(count, false, count);
        break;
    }
    if (card->strflg != 0 && reporter->kind() != ElementKind::beam)
      world.passes.add(std::make_shared<StrainFields>(*reporter));
    if (!points.empty())
      world.passes.add(std::make_shared<PointFields>(*reporter, std::move(points), options, history));
  }
  if (shells && maxint < 0)
    deck.warning(diagnostics, *card, "MAXINT",
                 "points in the plane of shells are not distinguished: of each layer their mean is written");
}
const RegisterAddition point_fields{"fields of integration points", build_point_fields};

}  // namespace

}  // namespace courant
