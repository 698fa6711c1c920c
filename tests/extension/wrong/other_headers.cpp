// As if compiled against the headers of another Courant; ends the program if any of its code runs.
#include <cstdlib>

namespace {

[[gnu::used]] const char compiled_against[] = "courant headers 0123456789abcdef";

struct Crash {
  Crash() { std::abort(); }
};
const Crash crash;

}  // namespace
