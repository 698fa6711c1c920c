#include "keyword/read/number.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <system_error>

namespace courant {

namespace {

/// "d-3", "D3", "-3", "+3" as "e-3", ...; empty if it is none of these.
std::string exponent_of(std::string_view tail) {
  if (tail.empty()) return {};
  if (tail[0] == 'd' || tail[0] == 'D')
    tail.remove_prefix(1);
  else if (tail[0] != '+' && tail[0] != '-')
    return {};
  std::string out = "e";
  if (!tail.empty() && (tail[0] == '+' || tail[0] == '-')) {
    out += tail[0];
    tail.remove_prefix(1);
  }
  if (tail.empty()) return {};
  for (const char c : tail)
    if (!is_digit(c)) return {};
  return out.append(tail);
}

}  // namespace

bool parse_real(std::string_view text, Real& value) {
  if (parse_plain_real(text.data(), text.data() + text.size(), value)) return true;
  if (!text.empty() && text[0] == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text[0] == '-') return false;
  }
  const std::size_t first = !text.empty() && text[0] == '-';
  // from_chars would also take "inf" and "nan"
  if (text.size() <= first || !(is_digit(text[first]) || text[first] == '.')) return false;
  const char* end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, value);
  if (fault != std::errc{}) return false;
  if (stop == end) return true;
  const std::string exponent = exponent_of({stop, static_cast<std::size_t>(end - stop)});
  const std::string_view mantissa(text.data(), static_cast<std::size_t>(stop - text.data()));
  if (exponent.empty() || mantissa.find_first_of("eE") != std::string_view::npos) return false;
  const std::string whole = std::string(mantissa) + exponent;
  const auto [stop2, fault2] = std::from_chars(whole.data(), whole.data() + whole.size(), value);
  return fault2 == std::errc{} && stop2 == whole.data() + whole.size();
}

bool parse_integer(std::string_view text, Id& value) {
  if (parse_plain_integer(text.data(), text.data() + text.size(), value)) return true;
  const std::string_view digits = !text.empty() && text[0] == '+' ? text.substr(1) : text;
  const char* end = digits.data() + digits.size();
  const auto [stop, fault] = std::from_chars(digits.data(), end, value);
  if (fault == std::errc{} && stop == end) return digits.size() == text.size() || digits[0] != '-';
  Real real = 0;
  constexpr Real exact = 9007199254740992.0;  // 2^53: above it a double no longer holds every integer
  if (!parse_real(text, real) || real != std::floor(real) || std::abs(real) > exact) return false;
  value = static_cast<Id>(real);
  return true;
}

}  // namespace courant
