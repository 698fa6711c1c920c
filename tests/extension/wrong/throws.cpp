// Fails while it is loaded.
#include <stdexcept>

namespace {

struct Thrower {
  Thrower() { throw std::runtime_error("no licence for this law"); }
};
const Thrower thrower;

}  // namespace
