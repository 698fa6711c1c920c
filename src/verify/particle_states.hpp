#pragma once
// Expressions over the particles of field states.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "post/results.hpp"
#include "verify/formula.hpp"

namespace courant {

/// The variables of particle_variables() for all particles of a state.
class StateTable {
 public:
  using Used = std::array<bool, particle_variable_count>;
  /// Reads the variables in `used`, and with `all` what else the file has. Faults, also numbers that are not
  /// finite, go to `diagnostics`.
  StateTable(const StateFiles& state, const Used& used, bool all, Diagnostics& diagnostics);

  std::size_t size() const { return n_; }
  Real t() const { return t_; }
  bool active(std::size_t i) const { return columns_[active_column][i] > 0; }
  Real volume(std::size_t i) const { return volume_[i]; }
  Real length(std::size_t i) const { return h_[i]; }  ///< smoothing length [L]
  /// Values of particle i; those not read are 0.
  std::array<Real, particle_variable_count> row(std::size_t i) const;

 private:
  static constexpr std::size_t active_column = 15;
  void fill(const ParticleFrame& frame);
  std::size_t n_ = 0;
  Real t_ = 0;
  std::array<std::vector<Real>, particle_variable_count> columns_;
  std::vector<Real> volume_, h_;
};

/// Adds to `used` what a formula over particle_variables() uses.
void note_used(const Formula& formula, StateTable::Used& used);

/// Which particles count: those that are active, unless `where` or `of` asks for `active` itself, and for
/// which `where` > 0.
class Selection {
 public:
  Selection(const std::string& where, const Formula& of, const Variables& variables);
  bool ok() const { return where_.ok(); }
  const Formula& formula() const { return where_; }
  bool counts(const StateTable& state, std::size_t i, const Real* row);

 private:
  Formula where_;
  bool all_ = false;  // inactive ones, too
};

/// mean (by volume), sum, min, max, count, median, p01 or p99 of values; shape of both: (n). Of no values sum
/// and count are 0, the others NaN. Percentiles are interpolated between neighbours in order.
Real reduce(const std::string& how, std::vector<Real> values, const std::vector<Real>& volumes);

/// The state whose time is nearest to t, if none is missing there: |t_state - t| is at most half the largest
/// distance of two states. Index in `states`, or -1.
int nearest_state(const std::vector<StateFiles>& states, Real t);

}  // namespace courant
