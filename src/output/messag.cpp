#include "output/messag.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "base/utf8.hpp"

namespace courant {

namespace {

std::string date_and_time() {
  return fmt::format("{:%m/%d/%y %H:%M:%S}", fmt::localtime(std::time(nullptr)));
}

}  // namespace

std::string status_line(std::int64_t cycle, Real t, Real dt, std::string_view what, std::string_view stamp) {
  return fmt::format("{:8d} t {:10.4E} dt {:8.2E} {:<28} {}", cycle, t, dt, what, stamp);
}

Messag::Messag(const std::filesystem::path& file, Echo echo, bool append)
    : file_(file, append), echo_(std::move(echo)) {}

void Messag::line(std::string_view text) {
  keep(text);
  if (echo_) echo_(without_controls(text));
}

void Messag::keep(std::string_view text) {
  file_.write(without_controls(text) + "\n");
}

void Messag::keep_status(std::int64_t cycle, Real t, Real dt, std::string_view what) {
  keep(status_line(cycle, t, dt, what, date_and_time()));
}

void Messag::status(std::int64_t cycle, Real t, Real dt, std::string_view what) {
  line(status_line(cycle, t, dt, what, date_and_time()));
}

void Messag::banner(std::string_view text) {
  line(fmt::format("{:<50} {}", text, date_and_time()));
}

}  // namespace courant
