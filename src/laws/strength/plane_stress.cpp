#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "laws/most_history.hpp"
#include "laws/strength/beam_stress.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

/// What a trial step must leave as it was: stress and history of the points of a block.
class SavedPoints {
 public:
  explicit SavedPoints(const PointBlock& block) : block_(block) {
    if (block.history.size() > most_history)
      throw std::logic_error("plane stress of a law with too many history numbers");
    for (std::size_t k = 0; k < 6; ++k) std::copy_n(block.stress[k], block.count, stress_[k].data());
    for (std::size_t k = 0; k < block.history.size(); ++k)
      std::copy_n(block.history[k], block.count, history_[k].data());
  }
  void give_back() const {
    for (std::size_t k = 0; k < 6; ++k) std::copy_n(stress_[k].data(), block_.count, block_.stress[k]);
    for (std::size_t k = 0; k < block_.history.size(); ++k)
      std::copy_n(history_[k].data(), block_.count, block_.history[k]);
  }

 private:
  using Numbers = std::array<Real, block_size>;
  const PointBlock& block_;
  std::array<Numbers, 6> stress_;
  std::array<Numbers, most_history> history_;
};

/// Largest component of the stress of a point, by which the remaining zz is judged.
Real size_of_stress(const PointBlock& block, Index i) {
  Real most = 0;
  for (const Real* s : block.stress) most = std::max(most, std::abs(s[i]));
  return most;
}

}  // namespace

// Of each point a root of stress zz (rate zz): the elastic guess, a step with the elastic modulus, then
// secants. A point that is done keeps its rate, so that every trial of the block gives the same for it.
void StrengthLaw::update_in_plane_stress(const PointBlock& block, Real* rate_zz) const {
  constexpr int most_trials = 30;
  constexpr Real close = 1e-10;
  const Real K = bulk_modulus(), G = shear_modulus(), modulus = K + 4 * G / 3;
  const Real share = (K - 2 * G / 3) / modulus;  // nu/(1 - nu)
  std::array<Real, block_size> old_rate{}, old_stress{};
  std::array<char, block_size> done{};
  PointBlock trial = block;
  trial.rate[2] = rate_zz;
  for (Index i = 0; i < block.count; ++i) rate_zz[i] = -share * (block.rate[0][i] + block.rate[1][i]);
  const SavedPoints kept(block);
  Real* zz = block.stress[2];
  for (int k = 0;; ++k) {
    update(trial);
    if (!(block.dt > 0) || k == most_trials) break;
    bool all_done = true;
    for (Index i = 0; i < block.count; ++i) {
      if (done[static_cast<std::size_t>(i)]) continue;
      const auto at = static_cast<std::size_t>(i);
      const Real stress = zz[i], rate = rate_zz[i], before = old_stress[at];
      done[at] = !(std::abs(stress) > close * size_of_stress(block, i));
      const Real slope = k > 0 && stress != before ? (stress - before) / (rate - old_rate[at]) : 0;
      if (!done[at]) rate_zz[i] -= stress / (slope > 0 ? slope : modulus * block.dt);
      old_rate[at] = rate, old_stress[at] = stress;
      all_done = all_done && done[at];
    }
    if (all_done) break;
    kept.give_back();
  }
  std::fill(zz, zz + block.count, 0);
}

// As above, of the sum of stress yy and zz, which answers to both rates at once.
void update_in_beam(const StrengthLaw& law, const PointBlock& block, Real* rate_yy) {
  constexpr int most_trials = 30;
  constexpr Real close = 1e-10;
  const Real K = law.bulk_modulus(), G = law.shear_modulus(), modulus = 2 * K + 2 * G / 3;
  const Real share = (K - 2 * G / 3) / modulus;  // nu
  std::array<Real, block_size> old_rate{}, old_stress{}, none{};
  std::array<char, block_size> done{};
  PointBlock trial = block;
  trial.rate[1] = trial.rate[2] = rate_yy, trial.rate[4] = none.data();
  for (Index i = 0; i < block.count; ++i) rate_yy[i] = -share * block.rate[0][i];
  const SavedPoints kept(block);
  Real *yy = block.stress[1], *zz = block.stress[2];
  for (int k = 0;; ++k) {
    law.update(trial);
    if (!(block.dt > 0) || k == most_trials) break;
    bool all_done = true;
    for (Index i = 0; i < block.count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (done[at]) continue;
      const Real stress = 0.5 * (yy[i] + zz[i]), rate = rate_yy[i], before = old_stress[at];
      done[at] = !(std::abs(stress) > close * size_of_stress(block, i));
      const Real slope = k > 0 && stress != before ? (stress - before) / (rate - old_rate[at]) : 0;
      if (!done[at]) rate_yy[i] -= stress / (slope > 0 ? slope : modulus * block.dt);
      old_rate[at] = rate, old_stress[at] = stress;
      all_done = all_done && done[at];
    }
    if (all_done) break;
    kept.give_back();
  }
  for (const std::size_t k : {1, 2, 4}) std::fill(block.stress[k], block.stress[k] + block.count, 0);
}

}  // namespace courant
