#pragma once
// What *SENSOR_DEFINE_CALC-MATH makes of the numbers of sensors.
#include <string>
#include <vector>

#include "base/real.hpp"

namespace courant {

using SensorMath = Real (*)(const std::vector<Real>&);

/// By CALC; null: there is none of this name. Of values at least one must be given.
SensorMath sensor_math(const std::string& calc);

}  // namespace courant
