#pragma once
#include <vector>

#include "base/real.hpp"
#include "rigid/joints/joint_rows.hpp"
#include "state/pass.hpp"
#include "state/restartable.hpp"

namespace courant {

/// Penalty springs and dampers along equations of joints (RPS, DAMP; LMF 0), by mean accelerations (Newmark,
/// beta 1/4): f = -k (c_old/4 + c/2 + c_new/4 - rest) - d dc/dt with the mean rate of both half steps. So
/// they are stable at any step, and what they store comes back.
class JointSprings {
 public:
  /// `rows`: of all joints. None has a spring yet.
  explicit JointSprings(std::size_t rows) : stiffness_(rows, 0), damping_(rows), rest_(rows), last_(rows) {}
  bool has(Index row) const { return stiffness_[at(row)] > 0; }
  void add(Index row, Real stiffness, Real damping, Real rest);
  /// Change of the row over the coming step for a force of 1. [L T2/(M L)]
  Real give(Index row, const Clock& clock) const;
  /// By how much a change of the row over the coming step is more than its spring has it under this force.
  Real wrong(Index row, Real c, Real change, Real force, const Clock& clock) const;
  /// Behind the step: how the rows changed in it.
  void remember(const std::vector<JointRow>& rows, const std::vector<Real>& changes, const Clock& clock);
  Real stored() const { return stored_; }  ///< half a step before the last one began [ML2/T2]
  Real lost() const { return lost_; }      ///< to dampers in the last step [ML2/T2]
  void keep(Archive& archive);

 private:
  static std::size_t at(Index row) { return static_cast<std::size_t>(row); }
  Real last_rate(std::size_t row, const Clock& clock) const {
    return clock.dt_old > 0 ? last_[row] / clock.dt_old : 0;
  }
  std::vector<Real> stiffness_, damping_;  ///< of each row, 0: it holds exactly
  std::vector<Real> rest_, last_;          ///< c of no force; change in the last step
  Real stored_ = 0, lost_ = 0;
};

}  // namespace courant
