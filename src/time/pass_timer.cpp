#include "time/pass_timer.hpp"

namespace courant {

std::size_t PassTimer::row(const std::string& name) {
  for (std::size_t k = 0; k < table_.size(); ++k)
    if (table_[k].name == name) return k;
  table_.push_back({name});
  return table_.size() - 1;
}

}  // namespace courant
