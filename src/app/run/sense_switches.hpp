#pragma once
// LS-DYNA's sense switches: short orders to a run that is going on.
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "base/real.hpp"

namespace courant {

/// An order, as text in a file `d3kil` in the folder of the run or the one it was started in, or typed.
struct SenseSwitch {
  enum class Kind { dump_and_stop, tell, dump, plot, flush, stop, end_time, unknown } kind = Kind::unknown;
  std::string text;   ///< as given: "sw1."
  Real end_time = 0;  ///< of endtime=t [T]
};

/// The order that a text gives; nothing for an empty one. The period may be missing.
std::optional<SenseSwitch> sense_switch_of(const std::string& text);

/// The message for an invalid order.
std::string unknown_switch(const SenseSwitch& order);

class SenseSwitches {
 public:
  /// keyboard: lines typed at the terminal are orders, too.
  SenseSwitches(std::filesystem::path dir, bool keyboard) : dir_(std::move(dir)), keyboard_(keyboard) {}
  /// An order that was given since the last call; checks twice a second at most. A file that gave it is
  /// removed, so that it acts once.
  std::optional<SenseSwitch> take();

 private:
  std::optional<SenseSwitch> take_file(const std::filesystem::path& file);
  std::optional<SenseSwitch> take_line();

  std::filesystem::path dir_;
  bool keyboard_;
  std::chrono::steady_clock::time_point looked_;
  std::string stuck_;  ///< text of a file that cannot be removed and has acted
};

}  // namespace courant
