#pragma once
#include <cstdint>
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace courant {

using Real = double;
using Vec = Eigen::Vector3d;  ///< a vector in space; a 2D scene (IDIM 2) lives in the plane z = constant
using Matrix = Eigen::Matrix3d;
using Index = std::int32_t;  ///< position of an entity in its field arrays; changes when particles are sorted
using Id = std::int64_t;     ///< the number an entity has in the deck; never changes

inline constexpr Real pi = 3.14159265358979323846;

}  // namespace courant
