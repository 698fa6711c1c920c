#pragma once
#include <array>
#include <memory>
#include <vector>

#include "rigid/bodies/rigid.hpp"
#include "state/restartable.hpp"

namespace courant {

/// What resists one of the three angles between two bodies.
struct AngleResistance {
  Curve stiffness{}, damping{};  ///< moment over angle, over rate [ML2/T2]; empty: none
  Real elastic = 0;              ///< of friction and stops [ML2/T2]
  Real friction = 0;             ///< the largest moment of friction, 0: none [ML2/T2]
  Real low = 0, high = 0;        ///< stop angles, 0: none [-]
  Real angle = 0, moment = 0;    ///< state: of the last step, and of friction [-], [ML2/T2]
};

/// *CONSTRAINED_JOINT_STIFFNESS_GENERALIZED between bodies A and B: three angles phi, theta, psi about x of
/// A, then the turned y, then z of B.
struct JointStiffness {
  Id id = 0;
  std::size_t a = 0, b = 0;
  Matrix axes_a = Matrix::Identity(), axes_b = Matrix::Identity();  ///< as columns, at t = 0
  std::array<AngleResistance, 3> about{};
};

/// The three angles, next to those of the step before, and the axes g_i with rate_i = g_i.(omega_B -
/// omega_A).
struct JointAngles {
  std::array<Real, 3> angle{};
  std::array<Vec, 3> axis{};
  Real cosine = 1;  ///< of theta; at 0 the other two are not defined
};
JointAngles angles_of(const JointStiffness& joint, const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

/// *CONSTRAINED_JOINT_STIFFNESS: adds the passes; false if there is none. In front of joints. Refuses by
/// name: parts that are not rigid or the same, systems and curves that are not there, curves of friction,
/// stops without a stiffness.
bool add_joint_stiffness(const Deck& deck, const Model& model, std::shared_ptr<RigidBodies> bodies,
                         World& world, Diagnostics& diagnostics);

}  // namespace courant
