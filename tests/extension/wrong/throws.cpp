// Fails while it is loaded.
#include <stdexcept>

#include "extension/compiled_against.hpp"

namespace {

struct Thrower {
  Thrower() { throw std::runtime_error("no licence for this law"); }
};
const Thrower thrower;

}  // namespace
