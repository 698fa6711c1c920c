#include "laws/strength/johnson_cook.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>

#include "laws/strength/radial_return.hpp"
#include "laws/strength/rate_factor.hpp"
#include "laws/strength/yield_return.hpp"

namespace courant {

namespace {

/// Trial stress by Hooke's law, returned to the flow stress at the end of the step, of whose temperature that
/// at its start counts.
class JohnsonCook : public StrengthLaw {
 public:
  JohnsonCook(Real density, const JohnsonCookData& data) : a_(data) {
    ro = density;
    if (a_.rate != JohnsonCookData::Rate::log_quadratic && a_.rate != JohnsonCookData::Rate::cowper_symonds)
      a_.second = 0;
    rate_term_.C = a_.C, rate_term_.P = a_.second;
    law_ = {.lambda = a_.K - 2 * a_.G / 3, .G = a_.G, .steep = true};
    if (a_.C != 0 || a_.second != 0) law_.rate = YieldRate::of_flow;
  }
  bool deviator_only() const override { return !(a_.K > 0); }
  Real bulk_modulus() const override { return a_.K; }
  Real shear_modulus() const override { return a_.G; }
  Real pressure_cutoff() const override { return a_.spall.cutoff(); }
  std::string failure_variable() const override {
    if (a_.has_limits()) return "failure_ratio";
    return a_.damages() ? "damage" : "plastic_strain";
  }
  Real failure_limit() const override {
    if (a_.has_limits()) return 1;
    return a_.damages() ? (a_.keeps_elements ? JohnsonCookData::never : a_.critical) : a_.fails_at;
  }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{"plastic_strain", "-"}};
    if (a_.heat > 0) out.push_back({"temperature_rise", "-"});
    if (a_.damages()) out.push_back({"damage", "-"});
    if (a_.spall.keeps()) out.push_back({"spalled", "-"});
    if (a_.has_limits()) out.push_back({"failure_ratio", "-"});
    return out;
  }

  void update(const PointBlock& block) const override {
    BlockHistory kept(block, a_);
    PlasticTrial trial;
    if (a_.coupling > 0) weigh(block, kept.damage, true);
    go_elastically(a_.K - 2 * a_.G / 3, a_.G, block, FixedCentre{}, trial);
    Real cold[block_size];
    cool(block, kept, cold);
    find_increments(loops_, law_, block, kept.plastic, trial,
                    [&](YieldPoints& points) { at(points, kept.heated ? cold : nullptr); });
    for (Index i = 0; i < block.count; ++i) kept.plastic[i] += trial.plastic[i];
    if (kept.heated) heat(block, kept, trial);
    return_radially(a_.G, 0, std::numeric_limits<Real>::min(), block, FixedCentre{}, trial);
    if (a_.damages()) damage(block, kept, trial);
    if (a_.coupling > 0) weigh(block, kept.damage, false);
    if (a_.has_limits()) compare(block, kept);
    keep_stiffness(block, sound_speed());
    if (kept.spalled) a_.spall.look(block, kept.spalled);
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    if (history().size() > 1 || !(block.dt > 0)) return StrengthLaw::update_in_plane_stress(block, rate_zz);
    update_in_plane(loops_, law_, block, nullptr, rate_zz,
                    [this](YieldPoints& points) { at(points, nullptr); });
    keep_stiffness(block, sound_speed());
  }

 private:
  /// The history of a block; null where there is none.
  struct BlockHistory {
    Real *plastic, *heated = nullptr, *damage = nullptr, *spalled = nullptr, *ratio = nullptr;
    Real warmth[block_size];  ///< T* of this step [-]
    BlockHistory(const PointBlock& block, const JohnsonCookData& a) {
      std::size_t at = 0;
      plastic = block.history[at++];
      if (a.heat > 0) heated = block.history[at++];
      if (a.damages()) damage = block.history[at++];
      if (a.spall.keeps()) spalled = block.history[at++];
      if (a.has_limits()) ratio = block.history[at++];
    }
  };

  /// T*, and the factor of the flow stress by it.
  void cool(const PointBlock& block, BlockHistory& kept, Real* cold) const {
    for (Index i = 0; i < block.count; ++i) {
      kept.warmth[i] =
          kept.heated ? std::clamp((a_.warm + kept.heated[i]) / a_.melting, Real(0), Real(1)) : 0;
      cold[i] = kept.warmth[i] > 0 ? 1 - std::pow(kept.warmth[i], a_.M) : 1;
    }
  }

  /// Flow stresses; `cold`: the factor of temperature, by point.
  void at(YieldPoints& points, const Real* cold) const {
    using Rate = JohnsonCookData::Rate;
    rates_.power_hardening({a_.A, a_.B, a_.n, a_.most}, points);
    for (const JohnsonCookData::Voce& voce : a_.voce)
      if (voce.Q != 0) rates_.voce(voce.Q, voce.C, points);
    if (law_.rate == YieldRate::none)
      std::fill_n(points.by_rate, points.count, 0.0);
    else if (a_.rate == Rate::cowper_symonds)
      rates_.scale(rate_term_, points);
    else if (a_.rate == Rate::power)
      rates_.power_of_rate(a_.rate0, a_.C, points);
    else if (a_.rate == Rate::above_1)
      rates_.power_above_1(a_.rate0, a_.C, points);
    else
      rates_.logarithmic(a_.rate0, a_.C, a_.second, points);
    if (cold || a_.saturates < JohnsonCookData::never) rates_.limit(a_.saturates, cold, points);
  }

  Real log_of(Real rate) const { return rate > a_.rate0 ? std::log(rate / a_.rate0) : 0; }

  void heat(const PointBlock& block, BlockHistory& kept, const PlasticTrial& trial) const {
    for (Index i = 0; i < block.count; ++i) {
      const Real left = a_.coupling > 0 ? std::max(1 - a_.coupling * kept.damage[i], Real(0)) : 1;
      const Real rise = a_.heat * left * (trial.q[i] - 3 * a_.G * trial.plastic[i]) * trial.plastic[i];
      kept.heated[i] += rise;
      for (std::size_t k = 0; k < 3 && a_.expands != 0; ++k) block.stress[k][i] -= a_.expands * rise;
    }
  }
  /// To the stress without damage, or back.
  void weigh(const PointBlock& block, const Real* damage, bool without) const {
    for (Index i = 0; i < block.count; ++i) {
      const Real left = std::max(1 - a_.coupling * damage[i], Real(0));
      const Real factor = without ? (left > 0 ? 1 / left : 0) : left;
      for (Real* stress : block.stress) stress[i] *= factor;
    }
  }
  void compare(const PointBlock& block, const BlockHistory& kept) const {
    for (Index i = 0; i < block.count; ++i) {
      Real most = kept.damage ? kept.damage[i] / a_.critical : kept.plastic[i] / a_.fails_at;
      if (kept.heated) most = std::max(most, kept.heated[i] / a_.hottest);
      if (a_.most_shear < JohnsonCookData::never) {
        const Vec s = principal(block, i);
        most = std::max(most, 0.5 * (s[2] - s[0]) / a_.most_shear);
      }
      kept.ratio[i] = std::max(kept.ratio[i], most);
    }
  }
  /// Stresses, rising. [M/LT2]
  static Vec principal(const PointBlock& block, Index i) {
    const auto& s = block.stress;
    Matrix m;
    m << s[0][i], s[3][i], s[5][i], s[3][i], s[1][i], s[4][i], s[5][i], s[4][i], s[2][i];
    return Eigen::SelfAdjointEigenSolver<Matrix>(m, Eigen::EigenvaluesOnly).eigenvalues();
  }

  void damage(const PointBlock& block, const BlockHistory& kept, const PlasticTrial& trial) const {
    const auto& s = block.stress;
    for (Index i = 0; i < block.count; ++i) {
      kept.damage[i] += grown(block, kept, trial, i);
      if (!a_.keeps_elements || !(kept.damage[i] >= 1)) continue;
      const Real mean = deviator_only() ? 0 : (s[0][i] + s[1][i] + s[2][i]) / 3;
      for (std::size_t k = 0; k < 6; ++k) s[k][i] = k < 3 ? mean : 0;
    }
  }
  /// Damage of the step.
  Real grown(const PointBlock& block, const BlockHistory& kept, const PlasticTrial& trial, Index i) const {
    const Real flown = std::min(trial.plastic[i], kept.plastic[i] - a_.threshold);
    if (!(flown > 0)) return 0;
    if (a_.critical_work > 0) {
      const Real left = a_.coupling > 0 ? std::max(1 - a_.coupling * kept.damage[i], Real(0)) : 1;
      return left * std::max(principal(block, i)[2], Real(0)) * flown / a_.critical_work;
    }
    return a_.critical * flown / std::max(fracture(block, kept, trial, i) - a_.threshold, a_.least_fracture);
  }
  Real fracture(const PointBlock& block, const BlockHistory& kept, const PlasticTrial& trial, Index i) const {
    const auto& s = block.stress;
    const Real mean = block.pressure ? -block.pressure[i] : (s[0][i] + s[1][i] + s[2][i]) / 3;
    const Real flow = std::max(trial.q[i] - 3 * a_.G * trial.plastic[i], std::numeric_limits<Real>::min());
    const Real base = a_.d[0] + (a_.d[1] != 0 ? a_.d[1] * std::exp(a_.d[2] * mean / flow) : 0);
    const Real rate = a_.of_plastic_rate ? trial.plastic[i] / block.dt : effective_rate(block, i, true);
    const Real by_rate = a_.rate == JohnsonCookData::Rate::above_1 ? std::pow(1 + rate / a_.rate0, a_.d[3])
                                                                   : 1 + a_.d[3] * log_of(rate);
    return std::max(base * by_rate * (1 + a_.d[4] * kept.warmth[i]), a_.least_fracture);
  }

  JohnsonCookData a_;
  CowperSymonds rate_term_;
  ReturnLaw law_;
  RateLoops rates_ = rate_loops();
  ReturnLoops loops_ = return_loops();
};

}  // namespace

std::shared_ptr<StrengthLaw> make_johnson_cook(Real density, const JohnsonCookData& data) {
  return std::make_shared<JohnsonCook>(density, data);
}

}  // namespace courant
