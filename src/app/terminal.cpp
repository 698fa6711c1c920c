#include "app/terminal.hpp"

#include <unistd.h>

#include <cstdio>

#include <fmt/format.h>

namespace courant {

namespace {

bool is_terminal() {
  return isatty(STDOUT_FILENO) != 0;
}

}  // namespace

bool keyboard_is_terminal() {
  return isatty(STDIN_FILENO) != 0;
}

void clear_status_line() {
  if (is_terminal()) fmt::print("\r\033[K");
}

void print_line(const std::string& line) {
  clear_status_line();
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

std::function<void(const std::string&)> status_line() {
  if (!is_terminal()) return {};
  return [](const std::string& line) {
    fmt::print("\r\033[K{}", line);
    std::fflush(stdout);
  };
}

}  // namespace courant
