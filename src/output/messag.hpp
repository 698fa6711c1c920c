#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "base/real.hpp"
#include "output/file.hpp"

namespace courant {

/// One of LS-DYNA's status lines, `%8d t %10.4E dt %8.2E %-28s MM/DD/YY HH:MM:SS`, without line end.
/// stamp: date and time as text. t, dt: [T]
std::string status_line(std::int64_t cycle, Real t, Real dt, std::string_view what, std::string_view stamp);

/// The file `messag`: all messages of a run. Lines can be passed on to a callback, with which the program
/// shows them.
class Messag {
 public:
  using Echo = std::function<void(std::string_view line)>;

  /// Starts an empty file, or appends to it. Throws OutputError.
  explicit Messag(const std::filesystem::path& file, Echo echo = {}, bool append = false);
  /// Adds a line; `text` has no line end. Throws OutputError.
  void line(std::string_view text);
  /// Adds a line that is not passed on: details that are rarely needed during the run. Throws OutputError.
  void keep(std::string_view text);
  /// Adds a status line with the present date and time. Throws OutputError.
  void status(std::int64_t cycle, Real t, Real dt, std::string_view what);
  /// The same, and it is not passed on. Throws OutputError.
  void keep_status(std::int64_t cycle, Real t, Real dt, std::string_view what);
  /// Adds a line with the present date and time behind it. Throws OutputError.
  void banner(std::string_view text);

 private:
  TextFile file_;
  Echo echo_;
};

}  // namespace courant
