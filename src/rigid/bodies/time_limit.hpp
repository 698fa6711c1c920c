#pragma once
#include <memory>

#include "rigid/bodies/rigid.hpp"

namespace courant {

/// For scenes of bodies alone, which nothing else limits: the smaller of a thousandth of ENDTIM and the time
/// in which a body turns by a hundredth of a radian. `endtim`: [T]
std::shared_ptr<TimeLimit> make_body_time_limit(std::shared_ptr<const RigidBodies> bodies, Real endtim);

}  // namespace courant
