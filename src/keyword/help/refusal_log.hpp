#pragma once
// What is wrong at many locations is reported once, at the first one, with the number of further ones.
#include <map>
#include <string>

#include "base/diagnostic.hpp"

namespace courant {

class RefusalLog {
 public:
  /// True where `name` comes for the first time: then its message must be the next one in `diagnostics`.
  bool is_first(const std::string& name, const Diagnostics& diagnostics);
  bool holds(const std::string& name) const { return told_.contains(name); }
  /// Adds the number of further locations to the messages, once the deck has been read. `location`: "line".
  void close(Diagnostics& diagnostics, const char* location = "line") const;

 private:
  struct RefusalCount {
    std::size_t message = 0;  ///< index into Diagnostics::all()
    int more = 0;
  };
  std::map<std::string, RefusalCount> told_;
};

}  // namespace courant
