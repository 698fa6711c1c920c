// What shells tell of their layers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "elements/element_report.hpp"
#include "elements/point_strains.hpp"
#include "elements/shell/shells.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

class ShellReport : public Pass, public ElementReporter, public FieldFiller {
 public:
  ShellReport(const ShellPart& part, const ElementGroup& group, bool shown, bool strains)
      : group_(group),
        zeta_(part.zeta),
        share_(part.share),
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
    if (strains) strains_.emplace(group, static_cast<int>(history_.size()));
    if (shown) add_shown_fields(part);
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

  /// Stress of the outer points in global axes, resultants in those of the element.
  void fill_fields(World& world) override {
    if (!shown_stress_[0]) return;
    for (Index e = 0; e < group_.size(); ++e) {
      const Matrix axes = axes_of(world, e);
      for (std::size_t side = 0; side < 2; ++side) {
        const auto s = [&](int k) { return mean_of_layer(side == 0 ? 0 : layers_ - 1, k, e); };
        Matrix local;
        local << s(0), s(3), s(5), s(3), s(1), s(4), s(5), s(4), 0;
        shown_stress_[side]->set_tensor(e, axes * local * axes.transpose());
      }
      show_resultants(e);
      for (const auto& [to, points] : shown_history_) {
        Real most = points.front()->data()[e];
        for (const Field<Real>* point : points) most = std::max(most, point->data()[e]);
        (*to)[e] = most;
      }
    }
  }

 private:
  void add_shown_fields(const ShellPart& part) {
    const auto add = [&](const char* name, const char* dimension, int components) {
      return &group_.fields.add<Real>(
          {.name = name, .dimension = dimension, .components = components, .output = true, .restart = false});
    };
    shown_stress_ = {add("stress_lower", "M/LT2", 6), add("stress_upper", "M/LT2", 6)};
    shown_force_ = add("membrane_force", "M/T2", 3), shown_moment_ = add("bending_moment", "ML/T2", 3);
    std::map<std::string, std::size_t> shown;  // by name, where it stands
    for (std::size_t p = 0; p < history_.size(); ++p) {
      const std::vector<HistoryVariable> kinds = part.law_of(p % layers_).history();
      for (std::size_t h = 0; h < kinds.size(); ++h) {
        if (kinds[h].components != 1) continue;
        const auto [place, is_new] = shown.emplace(kinds[h].name, shown_history_.size());
        if (is_new) shown_history_.push_back({add(kinds[h].name.c_str(), kinds[h].dimension.c_str(), 1), {}});
        shown_history_[place->second].points.push_back(history_[p][h]);
      }
    }
  }
  /// Over the positions in the plane; component k is not zz.
  Real mean_of_layer(std::size_t layer, int k, Index e) const {
    Real sum = 0;
    for (std::size_t q = 0; q < places_; ++q)
      sum += stress_.data(at_layer(static_cast<int>(q * layers_ + layer), k))[e];
    return sum / static_cast<Real>(places_);
  }
  /// N and M xx yy xy, means over the plane.
  void show_resultants(Index e) {
    const Field<Real>* const of_shells = offset_of_shells(group_);
    const Real t = thickness_[e], offset = of_shells ? (*of_shells)[e] : 0;
    for (int m = 0; m < 3; ++m) {
      Real force = 0, moment = 0;
      for (std::size_t layer = 0; layer < layers_; ++layer) {
        const Real part = share_[layer] * t * mean_of_layer(layer, m == 2 ? 3 : m, e);
        force += part, moment += 0.5 * t * (zeta_[layer] + offset) * part;
      }
      shown_force_->data(m)[e] = force, shown_moment_->data(m)[e] = moment;
    }
  }

  PointReport point(std::size_t p, Index e) const {
    PointReport out;
    for (const int k : {0, 1, 3, 4, 5})
      out.stress[static_cast<std::size_t>(k)] = stress_.data(at_layer(static_cast<int>(p), k))[e];
    for (const Field<Real>* h : history_[p])
      for (int k = 0; k < h->info().components; ++k) out.history.push_back(h->data(k)[e]);
    if (strains_) out.strain = strains_->at(static_cast<int>(p), e);
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
      for (auto* tensor : {&point.stress, &point.strain}) {
        auto& s = *tensor;
        Matrix local;
        local << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
        const Matrix t = axes * local * axes.transpose();
        s = {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)};
      }
    }
  }

  /// The largest value over the points.
  struct Largest {
    Field<Real>* to;
    std::vector<const Field<Real>*> points;
  };
  const ElementGroup& group_;
  std::vector<Real> zeta_, share_;
  std::size_t layers_, places_;
  bool invariant_axes_;
  const Field<Real>&stress_, &thickness_;
  std::vector<std::vector<const Field<Real>*>> history_;  ///< of each point
  std::vector<int> plastic_;                    ///< of each layer, among the numbers of its law; -1: none
  std::optional<PointStrains> strains_;         ///< none: not requested
  std::array<Field<Real>*, 2> shown_stress_{};  ///< null: nothing is shown
  Field<Real>*shown_force_ = nullptr, *shown_moment_ = nullptr;
  std::vector<Largest> shown_history_;
};

}  // namespace

PointReport mean_of(const std::vector<PointReport>& points) {
  PointReport out = points.front();
  const auto add = [](auto& to, const auto& from) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
  };
  for (std::size_t p = 1; p < points.size(); ++p)
    add(out.stress, points[p].stress), add(out.strain, points[p].strain), add(out.history, points[p].history);
  const auto n = static_cast<Real>(points.size());
  for (Real& s : out.stress) s /= n;
  for (Real& s : out.strain) s /= n;
  for (Real& h : out.history) h /= n;
  return out;
}

Field<Real>& layer_stress_of(const ElementGroup& group, int points) {
  return group.fields.add<Real>({.name = "layer_stress", .dimension = "M/LT2", .components = 5 * points});
}

Field<Real>& layer_history_of(const ElementGroup& group, const HistoryVariable& kind, int point) {
  return group.fields.add<Real>({.name = fmt::format("{}_of_layer_{}", kind.name, point + 1),
                                 .dimension = kind.dimension,
                                 .components = kind.components});
}

std::shared_ptr<Pass> make_shell_report(const ShellPart& part, const ElementGroup& group, bool shown,
                                        bool strains) {
  return std::make_shared<ShellReport>(part, group, shown, strains);
}

}  // namespace courant
