#include "rigid/joints/joint_drive.hpp"

namespace courant {

Real JointDrive::until(Real t) const {
  if (!(t > 0)) return 0;
  switch (kind) {
    case PrescribedMotion::Kind::velocity:
      return sense * integral(curve, 0, t);
    case PrescribedMotion::Kind::displacement:
      return sense * rise(curve, 0, t);
    case PrescribedMotion::Kind::acceleration:
      return start_rate * t + sense * t * mean_of_integral(curve, 0, t);
  }
  return 0;
}

Real JointDrive::over(Real t, Real dt) const {
  switch (kind) {
    case PrescribedMotion::Kind::velocity:
      return sense * integral(curve, t, t + dt);
    case PrescribedMotion::Kind::displacement:
      return sense * rise(curve, t, t + dt);
    case PrescribedMotion::Kind::acceleration:
      return start_rate * dt + sense * dt * mean_of_integral(curve, t, t + dt);
  }
  return 0;
}

}  // namespace courant
