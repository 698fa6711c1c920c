#include "app/terminal.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace courant {

namespace {

bool is_terminal() {
  return isatty(STDOUT_FILENO) != 0;
}

}  // namespace

bool keyboard_is_terminal() {
  return isatty(STDIN_FILENO) != 0;
}

void print_text(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);  // fmt::print throws where this returns less
  std::fflush(stdout);
}

void clear_status_line() {
  if (is_terminal()) print_text("\r\033[K");
}

void print_line(const std::string& line) {
  clear_status_line();
  print_text(line + "\n");
}

std::function<void(const std::string&)> status_line() {
  if (!is_terminal()) return {};
  return [](const std::string& line) { print_text("\r\033[K" + line); };
}

bool ProgressTimes::take(double seconds) {
  if (seconds < next_) return false;
  constexpr double longest_gap = 60;
  for (; next_ <= seconds; gap_ = std::min(2 * gap_, longest_gap)) next_ += gap_;
  return true;
}

std::function<void(const std::string&)> progress_lines() {
  const auto start = std::chrono::steady_clock::now();
  return [start, times = ProgressTimes()](const std::string& line) mutable {
    if (times.take(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()))
      print_line(line);
  };
}

}  // namespace courant
