#pragma once
#include <stdexcept>
#include <string>

namespace courant {

/// A run cannot be continued from a restart file. The text names the file or what of it does not fit, and
/// says what to do.
struct RestartError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace courant
