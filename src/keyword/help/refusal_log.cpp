#include "keyword/help/refusal_log.hpp"

#include <fmt/format.h>

namespace courant {

bool RefusalLog::is_first(const std::string& name, const Diagnostics& diagnostics) {
  const auto [it, is_new] = told_.try_emplace(name, RefusalCount{.message = diagnostics.all().size()});
  if (!is_new) ++it->second.more;
  return is_new;
}

void RefusalLog::close(Diagnostics& diagnostics, const char* location) const {
  for (const auto& [name, count] : told_)
    if (count.more > 0)
      diagnostics.amend(count.message, fmt::format(" (here and at {} more {}{})", count.more, location,
                                                   count.more == 1 ? "" : "s"));
}

}  // namespace courant
