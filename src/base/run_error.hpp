#pragma once
#include <stdexcept>

namespace courant {

/// The run cannot go on: negative density, NaN, a step below DTMIN. The text names time, particle, part or
/// term.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace courant
