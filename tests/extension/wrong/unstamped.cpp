// Does not say which headers it was compiled against; ends the program if any of its code runs.
#include <cstdlib>

namespace {

struct Crash {
  Crash() { std::abort(); }
};
const Crash crash;

}  // namespace
