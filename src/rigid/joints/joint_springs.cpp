#include "rigid/joints/joint_springs.hpp"

namespace courant {

void JointSprings::add(Index row, Real stiffness, Real damping, Real rest) {
  stiffness_[at(row)] = stiffness, damping_[at(row)] = damping, rest_[at(row)] = rest;
}

Real JointSprings::give(Index row, const Clock& clock) const {
  return 1 / (0.25 * stiffness_[at(row)] + 0.5 * damping_[at(row)] / clock.dt);
}

Real JointSprings::wrong(Index row, Real c, Real change, Real force, const Clock& clock) const {
  const std::size_t i = at(row);
  const Real without =
      stiffness_[i] * (c - rest_[i] - 0.25 * last_[i]) + 0.5 * damping_[i] * last_rate(i, clock);
  return change + give(row, clock) * (force + without);
}

// By mean accelerations the spring has k/2 (c - rest)^2 of the means of c over half steps.
void JointSprings::remember(const std::vector<JointRow>& rows, const std::vector<Real>& changes,
                            const Clock& clock) {
  stored_ = lost_ = 0;
  for (std::size_t i = 0; i < stiffness_.size(); ++i) {
    if (stiffness_[i] == 0) continue;
    const Real before = rows[i].c - rest_[i] - 0.5 * last_[i];
    const Real rate = 0.5 * (changes[i] / clock.dt + last_rate(i, clock));
    stored_ += 0.5 * stiffness_[i] * before * before;
    lost_ += damping_[i] * rate * rate * clock.dt_mean();
    last_[i] = changes[i];
  }
}

void JointSprings::keep(Archive& archive) {
  archive("stiffness", stiffness_), archive("damping", damping_);
  archive("rest", rest_), archive("last", last_);
  archive("stored", stored_), archive("lost", lost_);
}

}  // namespace courant
