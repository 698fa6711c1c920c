#include "laws/strength/johnson_cook.hpp"

#include <algorithm>
#include <cmath>

#include "laws/strength/radial_return.hpp"

namespace courant {

namespace {

/// Trial stress by Hooke's law, returned to the flow stress at the end of the step, of whose temperature that
/// at its start counts.
class JohnsonCook : public StrengthLaw {
 public:
  JohnsonCook(Real density, const JohnsonCookData& data) : a_(data) { ro = density; }
  bool deviator_only() const override { return !(a_.K > 0); }
  Real bulk_modulus() const override { return a_.K; }
  Real shear_modulus() const override { return a_.G; }
  Real pressure_cutoff() const override { return a_.spall.cutoff(); }
  std::string failure_variable() const override { return a_.damages() ? "damage" : "plastic_strain"; }
  Real failure_limit() const override {
    return a_.damages() ? (a_.keeps_elements ? JohnsonCookData::never : 1) : a_.fails_at;
  }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{"plastic_strain", "-"}};
    if (a_.heat > 0) out.push_back({"temperature_rise", "-"});
    if (a_.damages()) out.push_back({"damage", "-"});
    if (a_.spall.keeps()) out.push_back({"spalled", "-"});
    return out;
  }

  void update(const PointBlock& block) const override {
    BlockHistory kept(block, a_);
    PlasticTrial trial;
    go_elastically(a_.K - 2 * a_.G / 3, a_.G, block, FixedCentre{}, trial);
    for (Index i = 0; i < block.count; ++i) flow(block, i, kept, trial);
    return_radially(a_.G, 0, std::numeric_limits<Real>::min(), block, FixedCentre{}, trial);
    if (a_.damages()) damage(block, kept, trial);
    keep_stiffness(block, sound_speed());
    if (kept.spalled) a_.spall.look(block, kept.spalled);
  }

 private:
  /// The history of a block; null where there is none.
  struct BlockHistory {
    Real *plastic, *heated = nullptr, *damage = nullptr, *spalled = nullptr;
    Real rate[block_size], warmth[block_size];  ///< of this step: rate of strain [1/T], T* [-]
    BlockHistory(const PointBlock& block, const JohnsonCookData& a) {
      std::size_t at = 0;
      plastic = block.history[at++];
      if (a.heat > 0) heated = block.history[at++];
      if (a.damages()) damage = block.history[at++];
      if (a.spall.keeps()) spalled = block.history[at++];
    }
  };

  /// The increment of plastic strain of a point, and what follows from it.
  void flow(const PointBlock& block, Index i, BlockHistory& kept, PlasticTrial& trial) const {
    const Real warmth = kept.heated ? std::min(kept.heated[i] / a_.melting, Real(1)) : 0;
    const Real cold = warmth > 0 ? 1 - std::pow(warmth, a_.M) : 1;
    const Real all = effective_rate(block, i, true), q = trial.q[i];
    const Real de = increment(q, kept.plastic[i], cold, all, block.dt);
    kept.rate[i] = a_.of_plastic_rate ? (block.dt > 0 ? de / block.dt : 0) : all;
    kept.warmth[i] = warmth;
    trial.plastic[i] = de;
    kept.plastic[i] += de;
    if (kept.heated) kept.heated[i] += a_.heat * (q - 3 * a_.G * de) * de;
  }

  /// q - 3 G de = flow stress at e + de. Both sides are monotone: Newton's method, held between bounds.
  Real increment(Real q, Real e, Real cold, Real all, Real dt) const {
    if (a_.of_plastic_rate && !(dt > 0)) return 0;
    const Real three_g = 3 * a_.G;
    const auto excess = [&](Real de, Real& slope) {
      const Flow f = flow_stress(e + de, a_.of_plastic_rate ? de / dt : all);
      slope = -three_g - cold * (f.over_strain + (a_.of_plastic_rate ? f.over_rate / dt : 0));
      return q - three_g * de - cold * f.stress;
    };
    Real slope = 0;
    const Real over = excess(0, slope);
    if (!(over > 0)) return 0;
    Real low = 0, high = q / three_g, de = std::min(over / three_g, high);
    constexpr int rounds = 200;
    constexpr Real close = 1e-13;
    for (int k = 0; k < rounds; ++k) {
      const Real left = excess(de, slope);
      (left > 0 ? low : high) = de;
      const Real newton = de - left / slope, before = de;
      de = newton > low && newton < high ? newton : 0.5 * (low + high);
      if (std::abs(de - before) <= close * de) break;
    }
    return de;
  }

  struct Flow {
    Real stress, over_strain, over_rate;  ///< and its slopes
  };
  /// Without the factor of temperature.
  Flow flow_stress(Real e, Real rate) const {
    const Real grown = a_.n == 0 ? a_.B : a_.B * std::pow(e, a_.n);
    Flow out{a_.A + grown, e > 0 ? a_.n * grown / e : 0, 0};
    if (out.stress > a_.most) out.stress = a_.most, out.over_strain = 0;
    Real slope = 0;
    const Real factor = rate_factor(rate, slope);
    out.over_rate = out.stress * slope;
    out.stress *= factor, out.over_strain *= factor;
    if (out.stress > a_.saturates) out = {a_.saturates, 0, 0};
    return out;
  }
  Real log_of(Real rate) const { return rate > a_.rate0 ? std::log(rate / a_.rate0) : 0; }
  Real rate_factor(Real rate, Real& slope) const {
    using Rate = JohnsonCookData::Rate;
    const bool counts = rate > a_.rate0;
    const Real x = log_of(rate);
    switch (a_.rate) {
      case Rate::log_linear:
        slope = counts ? a_.C / rate : 0;
        return 1 + a_.C * x;
      case Rate::log_quadratic:
        slope = counts ? (a_.C + 2 * a_.second * x) / rate : 0;
        return 1 + x * (a_.C + a_.second * x);
      case Rate::power:
        slope = counts ? a_.C * std::exp(a_.C * x) / rate : 0;
        return std::exp(a_.C * x);
      case Rate::cowper_symonds:
        break;
    }
    const Real u = rate > 0 ? std::pow(rate / a_.C, 1 / a_.second) : 0;
    slope = rate > 0 ? u / (a_.second * rate) : 0;
    return 1 + u;
  }

  void damage(const PointBlock& block, const BlockHistory& kept, const PlasticTrial& trial) const {
    const auto& s = block.stress;
    for (Index i = 0; i < block.count; ++i) {
      if (trial.plastic[i] > 0) kept.damage[i] += trial.plastic[i] / fracture(block, kept, trial, i);
      if (!a_.keeps_elements || !(kept.damage[i] >= 1)) continue;
      const Real mean = deviator_only() ? 0 : (s[0][i] + s[1][i] + s[2][i]) / 3;
      for (std::size_t k = 0; k < 6; ++k) s[k][i] = k < 3 ? mean : 0;
    }
  }
  Real fracture(const PointBlock& block, const BlockHistory& kept, const PlasticTrial& trial, Index i) const {
    const auto& s = block.stress;
    const Real mean = block.pressure ? -block.pressure[i] : (s[0][i] + s[1][i] + s[2][i]) / 3;
    const Real flow = std::max(trial.q[i] - 3 * a_.G * trial.plastic[i], std::numeric_limits<Real>::min());
    const Real base = a_.d[0] + (a_.d[1] != 0 ? a_.d[1] * std::exp(a_.d[2] * mean / flow) : 0);
    const Real strain = base * (1 + a_.d[3] * log_of(kept.rate[i])) * (1 + a_.d[4] * kept.warmth[i]);
    return std::max(strain, a_.least_fracture);
  }

  JohnsonCookData a_;
};

}  // namespace

std::shared_ptr<StrengthLaw> make_johnson_cook(Real density, const JohnsonCookData& data) {
  return std::make_shared<JohnsonCook>(density, data);
}

}  // namespace courant
