#pragma once
// A law that keeps numbers behind those of another one, which it calls, and fails by a ratio of its own.
#include <memory>
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
    ro = of_->ro, failing_layers = of_->failing_layers;
    for (const HistoryVariable& h : of_->history()) kept_ += static_cast<std::size_t>(h.components);
  }
  Real bulk_modulus() const override { return of_->bulk_modulus(); }
  Real shear_modulus() const override { return of_->shear_modulus(); }
  std::vector<HistoryVariable> history() const override {
    auto out = of_->history();
    out.insert(out.end(), more_.begin(), more_.end());
    out.push_back({"failure_ratio", "-"});
    return out;
  }
  Real failure_limit() const override { return 1; }
  std::string failure_variable() const override { return "failure_ratio"; }
  LeastStep least_step() const override { return of_->least_step(); }
  const MaterialAxes* axes() const override { return of_->axes(); }
  bool stiffens() const override { return of_->stiffens(); }
  bool in_sheets() const override { return of_->in_sheets(); }
  Real plane_modulus() const override { return of_->plane_modulus(); }
  Real failure_time() const override { return of_->failure_time(); }
  std::pair<Real, Real> volume_range() const override { return of_->volume_range(); }

 protected:
  /// The block as `of` knows it.
  PointBlock of_law(const PointBlock& block) const {
    PointBlock out = block;
    out.history = block.history.first(kept_);
    return out;
  }

  std::shared_ptr<StrengthLaw> of_;
  std::size_t kept_ = 0;

 private:
  std::vector<HistoryVariable> more_;
};

}  // namespace courant
