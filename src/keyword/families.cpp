#include "keyword/families.hpp"

namespace courant {

bool is_output_request(const std::string& name) {
  for (const char* prefix :
       {"DATABASE_", "CONTROL_OUTPUT", "CONTROL_PARALLEL", "CONTROL_MPP_", "CONTROL_UNITS"})
    if (name.rfind(prefix, 0) == 0) return true;
  return false;
}

}  // namespace courant
