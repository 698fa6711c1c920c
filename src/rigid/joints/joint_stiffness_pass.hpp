#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rigid/joints/joint_stiffness.hpp"

namespace courant {

/// Moments that resist the turning of bodies against each other: springs and dampers by curves, friction that
/// yields elastically up to its largest moment, stops.
class JointStiffnesses : public Impact, public EnergyTerm, public TimeLimit, public Restartable {
 public:
  JointStiffnesses(std::vector<JointStiffness> joints, std::shared_ptr<RigidBodies> bodies)
      : joints_(std::move(joints)),
        bodies_(std::move(bodies)),
        moment_(joints_.size(), Vec::Zero()),
        damping_(joints_.size(), Vec::Zero()) {}
  std::string name() const override { return "joint stiffness"; }
  const std::vector<JointStiffness>& all() const { return joints_; }
  /// Throws RunError where theta comes to 90 degrees and the other two angles are resisted.
  void strike(World& world, const Clock& clock) override;
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override;
  Limit limit(const World& world, const Clock& clock) override;
  void keep(Archive& archive) override;

 private:
  std::vector<JointStiffness> joints_;
  std::shared_ptr<RigidBodies> bodies_;
  std::vector<Vec> moment_, damping_;  ///< on A, the opposite on B [ML2/T2]
  Real slipped_ = 0;                   ///< lost to friction since the step before [ML2/T2]
};

}  // namespace courant
