#pragma once
// A keyword that is not supported is reported once, at the first location, with the number of further lines.
#include <map>
#include <string>

#include "base/diagnostic.hpp"

namespace courant {

class RefusalLog {
 public:
  /// True where `name` comes for the first time: then its message must be the next one in `diagnostics`.
  bool is_first(const std::string& name, const Diagnostics& diagnostics);
  /// Adds the number of further lines to the messages, once the deck has been read.
  void close(Diagnostics& diagnostics) const;

 private:
  struct RefusalCount {
    std::size_t message = 0;  ///< index into Diagnostics::all()
    int more = 0;
  };
  std::map<std::string, RefusalCount> told_;
};

}  // namespace courant
