#include <array>

#include "keyword/read/number.hpp"

namespace courant {

namespace {

/// Powers of ten that a double holds exactly.
constexpr std::array<Real, 23> exact_powers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

unsigned digit(char c) {
  return static_cast<unsigned>(static_cast<unsigned char>(c)) - '0';
}

/// The digits from `at` on, appended to `number`; returns where they end.
const char* read_digits(const char* at, const char* end, std::uint64_t& number) {
  for (; at < end && digit(*at) < 10; ++at) number = 10 * number + digit(*at);
  return at;
}

/// "e-3", "d+12", "E5", also without the letter; false if it is anything else.
bool read_exponent(const char* at, const char* end, int& exponent) {
  if (*at == 'e' || *at == 'E' || *at == 'd' || *at == 'D') {
    if (++at == end) return false;
  } else if (*at != '+' && *at != '-') {
    return false;
  }
  const bool negative = *at == '-';
  if (negative || *at == '+') ++at;
  if (at == end || end - at > 3) return false;
  std::uint64_t magnitude = 0;
  if (read_digits(at, end, magnitude) != end) return false;
  exponent += negative ? -static_cast<int>(magnitude) : static_cast<int>(magnitude);
  return true;
}

}  // namespace

bool parse_plain_real(const char* begin, const char* end, Real& value) {
  constexpr std::ptrdiff_t most_digits = 18;  // fit into 64 bits
  const bool negative = begin < end && *begin == '-';
  const char* at = begin + negative;
  std::uint64_t mantissa = 0;
  const char* const whole = at;
  at = read_digits(at, end, mantissa);
  std::ptrdiff_t digits = at - whole;
  int exponent = 0;
  if (at < end && *at == '.') {
    const char* const fraction = ++at;
    at = read_digits(at, end, mantissa);
    exponent = -static_cast<int>(at - fraction);
    digits += at - fraction;
  }
  if (digits == 0 || digits > most_digits) return false;
  if (at < end && !read_exponent(at, end, exponent)) return false;
  // below 2^53 and 10^22 both are exact, so that one multiplication or division rounds correctly
  constexpr std::uint64_t exact = std::uint64_t(1) << 53;
  if (mantissa > exact || exponent > 22 || exponent < -22) return false;
  const Real number = static_cast<Real>(mantissa);
  const Real power = exact_powers[static_cast<std::size_t>(exponent < 0 ? -exponent : exponent)];
  const Real magnitude = exponent < 0 ? number / power : number * power;
  value = negative ? -magnitude : magnitude;
  return true;
}

bool parse_plain_integer(const char* begin, const char* end, Id& value) {
  const bool negative = begin < end && *begin == '-';
  const char* at = begin + negative;
  if (at == end || end - at > 18) return false;
  std::uint64_t number = 0;
  if (read_digits(at, end, number) != end) return false;
  value = negative ? -static_cast<Id>(number) : static_cast<Id>(number);
  return true;
}

}  // namespace courant
