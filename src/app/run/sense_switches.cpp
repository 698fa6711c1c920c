#include <fmt/format.h>

#include "app/run/sense_switches.hpp"

#include <poll.h>
#include <unistd.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>

namespace courant {

std::optional<SenseSwitch> sense_switch_of(const std::string& text) {
  using Kind = SenseSwitch::Kind;
  static const std::map<std::string, Kind> kinds = {
      {"sw1", Kind::dump_and_stop}, {"sw2", Kind::tell},  {"sw3", Kind::dump},
      {"sw4", Kind::plot},          {"swa", Kind::flush}, {"swc", Kind::dump},
      {"swd", Kind::dump_and_stop}, {"stop", Kind::stop}, {"quit", Kind::stop}};
  std::istringstream words(text);
  SenseSwitch out;
  if (!(words >> out.text)) return std::nullopt;
  std::string word;
  for (const char letter : out.text)
    word += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  constexpr std::string_view end_time = "endtime=";
  if (word.rfind(end_time, 0) == 0) {
    const char *first = word.data() + end_time.size(), *last = word.data() + word.size();
    const auto [end, error] = std::from_chars(first, last, out.end_time);
    if (error == std::errc() && end == last && out.end_time >= 0 && std::isfinite(out.end_time))
      out.kind = Kind::end_time;
    return out;
  }
  if (word.ends_with('.')) word.pop_back();
  if (const auto found = kinds.find(word); found != kinds.end()) out.kind = found->second;
  return out;
}

std::optional<SenseSwitch> SenseSwitches::take() {
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_ < std::chrono::milliseconds(500)) return std::nullopt;
  looked_ = now;
  if (auto order = take_file(dir_ / "d3kil")) return order;
  if (auto order = take_file("d3kil")) return order;
  return keyboard_ ? take_line() : std::nullopt;
}

std::optional<SenseSwitch> SenseSwitches::take_file(const std::filesystem::path& file) {
  std::error_code missing;
  if (!std::filesystem::is_regular_file(file, missing)) return std::nullopt;  // a pipe would hold the run up
  std::ifstream stream(file);
  if (!stream) return std::nullopt;
  std::string line;
  std::getline(stream, line);
  auto order = sense_switch_of(line);
  if (!order) return order;  // the file was created and will be written
  std::error_code error;
  if (std::filesystem::remove(file, error)) return order;
  if (stuck_ == line) return std::nullopt;
  stuck_ = line;
  return order;
}

/// A line that is there already. A run in the background may not read: the system would stop it.
std::optional<SenseSwitch> SenseSwitches::take_line() {
  if (::tcgetpgrp(STDIN_FILENO) != ::getpgrp()) return std::nullopt;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (::poll(&input, 1, 0) <= 0 || !(input.revents & POLLIN)) return std::nullopt;
  char letters[256];
  const ssize_t n = ::read(STDIN_FILENO, letters, sizeof letters);
  if (n <= 0) {
    keyboard_ = false;  // the terminal is gone
    return std::nullopt;
  }
  return sense_switch_of(std::string(letters, static_cast<std::size_t>(n)));
}

std::string unknown_switch(const SenseSwitch& order) {
  return fmt::format(
      " *** Warning: sense switch '{}' is not known; known are sw1. (restart file, stop), sw2. "
      "(time), sw3. (restart file), sw4. (field state), swa. (flush), stop, endtime=T",
      order.text);
}

}  // namespace courant
