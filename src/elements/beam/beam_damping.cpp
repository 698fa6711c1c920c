#include "elements/beam/beam_damping.hpp"

namespace courant {

BeamDamping::BeamDamping(Real coef, FrequencyRange range, const ElementGroup& group)
    : coef_(coef), range_(std::move(range)) {
  const auto add = [&](const char* name, const char* dimension, int components) {
    return &group.fields.add<Real>({.name = name, .dimension = dimension, .components = components});
  };
  if (coef_ == 0 && !range_.any()) return;
  forces_ = add("damping_forces", "-", count6), beta_ = add("stiffness_damping_time", "T", 1);
  beta_->fill(coef_ < 0 ? -coef_ : 0);
  if (range_.any())
    mechanisms_ = add("forces_of_mechanisms", "-", count6 * static_cast<int>(range_.time.size()));
}

void BeamDamping::declare(Accesses& a) const {
  if (forces_) a.updates(*forces_).updates(*beta_);
  if (mechanisms_) a.updates(*mechanisms_);
}

Six BeamDamping::forces(const Clock& clock, Index e, const Six& change, const Six& elastic, Real& work) {
  const Real dt = clock.dt_old;
  const FrequencyRange::Step step = range_.step(dt);
  Six out;
  for (int c = 0; c < count6; ++c) {
    const auto k = static_cast<std::size_t>(c);
    out[k] = dt > 0 ? elastic[k] * (*beta_)[e] / dt : 0;
    for (std::size_t j = 0; j < range_.time.size(); ++j) {
      Real& f = mechanisms_->data(count6 * static_cast<int>(j) + c)[e];
      f = step.left[j] * f + range_.share[j] * step.mean[j] * elastic[k];
      out[k] += f;
    }
    work += 0.5 * (forces_->data(c)[e] + out[k]) * change[k];
    forces_->data(c)[e] = out[k];
  }
  return out;
}

void BeamDamping::shorten(Index e, Real& step) {
  (*beta_)[e] = coef_ > 0 ? coef_ * step : -coef_;
  step *= damped_share((*beta_)[e], step) * stiffened_share(range_);
}

}  // namespace courant
