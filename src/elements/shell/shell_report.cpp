// What shells tell of their layers.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "elements/element_report.hpp"
#include "elements/shell/shells.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

class ShellReport : public Pass, public ElementReporter {
 public:
  ShellReport(const ShellPart& part, const ElementGroup& group)
      : group_(group),
        layers_(part.zeta.size()),
        places_(part.full && group.corners() == 4 ? 4 : 1),
        invariant_axes_(part.control.invariant_axes),
        stress_(layer_stress_of(group, static_cast<int>(layers_ * places_))),
        thickness_(thickness_of_shells(group)),
        history_(layers_ * places_),
        plastic_(layers_) {
    for (std::size_t p = 0; p < history_.size(); ++p)
      for (const HistoryVariable& h : part.law_of(p % layers_).history())
        history_[p].push_back(&layer_history_of(group, h, static_cast<int>(p)));
    for (std::size_t k = 0; k < layers_; ++k) plastic_[k] = plastic_strain_of(part.law_of(k));
  }
  std::string name() const override { return "report of " + group_.fields.name(); }
  ElementKind kind() const override { return ElementKind::shell; }
  const ElementGroup& reported() const override { return group_; }
  Real cut_measure(Index e) const override { return thickness_[e]; }
  ElementReport report_element(const World& world, Index e,
                               const ElementReportOptions& options) const override {
    ElementReport out;
    const Field<Index>* eroded = shared_fields::eroded.find(group_.fields);
    out.deleted = eroded && (*eroded)[e] != 0;
    for (std::size_t layer = 0; layer < layers_; ++layer) {
      std::vector<PointReport> in_plane;
      for (std::size_t q = 0; q < places_; ++q) in_plane.push_back(point(q * layers_ + layer, e));
      out.points.push_back(mean_of(in_plane));
      PointReport& mean = out.points.back();
      if (plastic_[layer] >= 0) mean.plastic = mean.history[static_cast<std::size_t>(plastic_[layer])];
    }
    if (!options.local_axes) turn(axes_of(world, e), out.points);
    return out;
  }

 private:
  PointReport point(std::size_t p, Index e) const {
    PointReport out;
    for (std::size_t k = 0; k < 6; ++k) out.stress[k] = stress_.data(static_cast<int>(6 * p + k))[e];
    for (const Field<Real>* h : history_[p])
      for (int k = 0; k < h->info().components; ++k) out.history.push_back(h->data(k)[e]);
    return out;
  }
  Matrix axes_of(const World& world, Index e) const {
    std::array<Vec, 4> x;
    for (std::size_t c = 0; c < x.size(); ++c)
      x[c] = world.nodes.x.vec(group_.node.data(std::min(static_cast<int>(c), group_.corners() - 1))[e]);
    return shell_axes(x, group_.corners(), invariant_axes_);
  }
  static void turn(const Matrix& axes, std::vector<PointReport>& points) {
    for (PointReport& point : points) {
      auto& s = point.stress;
      Matrix local;
      local << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
      const Matrix t = axes * local * axes.transpose();
      s = {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)};
    }
  }

  const ElementGroup& group_;
  std::size_t layers_, places_;
  bool invariant_axes_;
  const Field<Real>&stress_, &thickness_;
  std::vector<std::vector<const Field<Real>*>> history_;  ///< of each point
  std::vector<int> plastic_;  ///< of each layer, among the numbers of its law; -1: none
};

}  // namespace

PointReport mean_of(const std::vector<PointReport>& points) {
  PointReport out = points.front();
  const auto add = [](auto& to, const auto& from) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
  };
  for (std::size_t p = 1; p < points.size(); ++p)
    add(out.stress, points[p].stress), add(out.history, points[p].history);
  const auto n = static_cast<Real>(points.size());
  for (Real& s : out.stress) s /= n;
  for (Real& h : out.history) h /= n;
  return out;
}

Field<Real>& layer_stress_of(const ElementGroup& group, int points) {
  return group.fields.add<Real>({.name = "layer_stress", .dimension = "M/LT2", .components = 6 * points});
}

Field<Real>& layer_history_of(const ElementGroup& group, const HistoryVariable& kind, int point) {
  return group.fields.add<Real>({.name = fmt::format("{}_of_layer_{}", kind.name, point + 1),
                                 .dimension = kind.dimension,
                                 .components = kind.components});
}

std::shared_ptr<Pass> make_shell_report(const ShellPart& part, const ElementGroup& group) {
  return std::make_shared<ShellReport>(part, group);
}

}  // namespace courant
