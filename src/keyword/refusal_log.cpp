#include "keyword/refusal_log.hpp"

#include <fmt/format.h>
#include <utility>

namespace courant {

bool RefusalLog::is_first(const std::string& name, const Diagnostics& diagnostics) {
  const auto [it, is_new] = told_.try_emplace(name, Told{.message = diagnostics.all().size()});
  if (!is_new) ++it->second.more;
  return is_new;
}

void RefusalLog::close(Diagnostics& diagnostics) const {
  std::map<std::size_t, int> more_of_message;
  for (const auto& [name, told] : told_)
    if (told.more > 0) more_of_message[told.message] = told.more;
  if (more_of_message.empty()) return;
  Diagnostics out;
  for (std::size_t k = 0; k < diagnostics.all().size(); ++k) {
    Diagnostic d = diagnostics.all()[k];
    if (const auto it = more_of_message.find(k); it != more_of_message.end())
      d.message += fmt::format(" (here and in {} more place{})", it->second, it->second == 1 ? "" : "s");
    out.add(std::move(d));
  }
  diagnostics = std::move(out);
}

}  // namespace courant
