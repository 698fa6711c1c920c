// Registers nothing.
#include "extension/compiled_against.hpp"

int nothing() {
  return 0;
}
