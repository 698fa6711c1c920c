#pragma once
#include "model/model.hpp"

namespace courant {

/// The first time an output is due, by its curve: 0, or the first abscissa that is not before 0. [T]
Real first_output(const OutputTimes& times);
/// The time due after `due`; infinity where there is none. [T]
Real next_output(const OutputTimes& times, Real due);

}  // namespace courant
