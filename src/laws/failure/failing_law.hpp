#pragma once
// A law that keeps numbers behind those of another one, which it calls, and fails by a ratio of its own.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "laws/strength/strength.hpp"

namespace courant {

/// Behind the history of `of` it has `more`, then how near the point is to failure: 1. `kept_`: numbers of
/// `of`, before them.
class FailingLaw : public StrengthLaw {
 public:
  FailingLaw(std::shared_ptr<StrengthLaw> of, std::vector<HistoryVariable> more)
      : of_(std::move(of)), more_(std::move(more)) {
    ro = of_->ro, bulk_viscosity = of_->bulk_viscosity, failing_layers = of_->failing_layers;
    std::vector<HistoryVariable> all = of_->history();
    for (const HistoryVariable& h : all) kept_ += static_cast<std::size_t>(h.components);
    more_.push_back({"failure_ratio", "-"});
    for (HistoryVariable& h : more_) {
      h.name = unused_name(h.name, all);
      all.push_back(h);
    }
  }
  Real bulk_modulus() const override { return of_->bulk_modulus(); }
  Real shear_modulus() const override { return of_->shear_modulus(); }
  bool takes_equation_of_state() const override { return of_->takes_equation_of_state(); }
  std::vector<HistoryVariable> history() const override {
    auto out = of_->history();
    out.insert(out.end(), more_.begin(), more_.end());
    return out;
  }
  Real failure_limit() const override { return 1; }
  std::string failure_variable() const override { return more_.back().name; }
  LeastStep least_step() const override { return of_->least_step(); }
  const MaterialAxes* axes() const override { return of_->axes(); }
  bool stiffens() const override { return of_->stiffens(); }
  bool in_sheets() const override { return of_->in_sheets(); }
  Real plane_modulus() const override { return of_->plane_modulus(); }
  Real failure_time() const override { return of_->failure_time(); }
  std::pair<Real, Real> volume_range() const override { return of_->volume_range(); }

 protected:
  /// The block in the form of `of`.
  PointBlock of_law(const PointBlock& block) const {
    PointBlock out = block;
    out.history = block.history.first(kept_);
    return out;
  }

  std::shared_ptr<StrengthLaw> of_;
  std::size_t kept_ = 0;

 private:
  /// Numbers of one name would be one number: a second damage is "damage_2".
  static std::string unused_name(const std::string& name, const std::vector<HistoryVariable>& used) {
    std::string out = name;
    for (int k = 2; std::any_of(used.begin(), used.end(), [&](const auto& h) { return h.name == out; }); ++k)
      out = name + "_" + std::to_string(k);
    return out;
  }

  std::vector<HistoryVariable> more_;
};

}  // namespace courant
