#include "verify/report_text.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

namespace courant::report {
namespace {

/// Bytes of the UTF-8 character at the start of `text`; 0 if there is none.
std::size_t character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t bytes = first < 0x80   ? 1
                            : first < 0xc2 ? 0
                            : first < 0xe0 ? 2
                            : first < 0xf0 ? 3
                            : first < 0xf5 ? 4
                                           : 0;
  if (bytes > text.size()) return 0;
  for (std::size_t i = 1; i < bytes; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  if (bytes < 3) return bytes;
  // Longer than need be, surrogates, past the last character, or no character at all (U+FFFE, U+FFFF).
  const unsigned char second = byte(1);
  const bool wrong = (first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0) ||
                     (first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90) ||
                     (first == 0xef && second == 0xbf && byte(2) >= 0xbe);
  return wrong ? 0 : bytes;
}

/// Calls `use` with each character; what is none becomes "?".
template <class Use>
void each_character(std::string_view text, Use&& use) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t bytes = character(text.substr(i));
    const bool control = bytes == 1 && (static_cast<unsigned char>(text[i]) < 0x20 || text[i] == 0x7f);
    const bool blank = text[i] == '\n' || text[i] == '\t' || text[i] == '\r';
    use(bytes == 0 || (control && !blank) ? std::string_view("?") : text.substr(i, bytes));
    i += bytes == 0 ? 1 : bytes;
  }
}

/// "1e-05" -> "1e-5", "1.20e+06" -> "1.2e6"
std::string short_exponent(std::string text) {
  std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  for (; text.find('.') < e && (text[e - 1] == '0' || text[e - 1] == '.'); --e) text.erase(e - 1, 1);
  std::size_t digits = e + 2;
  while (digits + 1 < text.size() && text[digits] == '0') text.erase(digits, 1);
  if (text[e + 1] == '+') text.erase(e + 1, 1);
  return text;
}

}  // namespace

std::string escape_xml(std::string_view text) {
  std::string out;
  each_character(text, [&](std::string_view c) {
    if (c == "&")
      out += "&amp;";
    else if (c == "<")
      out += "&lt;";
    else if (c == ">")
      out += "&gt;";
    else if (c == "\"")
      out += "&quot;";
    else if (c == "'")
      out += "&#39;";
    else
      out += c;
  });
  return out;
}

std::string escape_markdown(std::string_view text) {
  std::string out;
  each_character(text, [&](std::string_view c) {
    const bool first = out.empty();
    if (c == "\n" || c == "\t" || c == "\r")
      out += ' ';
    else if (c == "&" || c == "<" || c == ">")
      out += c == "&" ? "&amp;" : c == "<" ? "&lt;" : "&gt;";
    else if (std::string_view("\\`*_{}[]|#~$").find(c) != std::string_view::npos ||
             (first && (c == "-" || c == "+")))
      (out += '\\') += c;
    else
      out += c;
  });
  return out;
}

std::vector<std::string> paragraphs(std::string_view text) {
  std::vector<std::string> all(1);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (line.find_first_not_of(" \t\r") == std::string_view::npos)
      all.emplace_back();
    else
      (all.back() += all.back().empty() ? "" : "\n") += line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  std::erase(all, "");
  return all;
}

std::size_t length(std::string_view text) {
  std::size_t n = 0;
  each_character(text, [&](std::string_view) { ++n; });
  return n;
}

std::string shorten(std::string_view text, std::size_t most) {
  if (length(text) <= most) return std::string(text);
  std::string out;
  std::size_t n = 0;
  each_character(text, [&](std::string_view c) {
    if (++n < most) out += c;
  });
  return out + "…";
}

std::string number(Real value, int digits) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  const Real size = std::abs(value);
  if (value == std::round(value) && size < 1e6) return fmt::format("{:.0f}", value + 0.0);
  if (size >= std::pow(Real(10), digits) && size < 1e6) return fmt::format("{:.0f}", value);
  if (size != 0 && size < 1e-3) return short_exponent(fmt::format("{:.{}e}", value, digits - 1));
  return short_exponent(fmt::format("{:.{}g}", value, digits));
}

std::string percent(Real fraction) {
  const Real size = std::abs(fraction);
  if (!std::isfinite(fraction)) return number(fraction);
  if (fraction == 0) return "0\u00a0%";
  if (size < 1e-6 || size >= 100) return number(fraction, 2);
  const Real value = 100 * fraction;
  return size >= 1 ? fmt::format("{:.0f}\u00a0%", value)
                   : fmt::format("{:.{}g}\u00a0%", value, size >= 0.1 ? 3 : 2);
}

std::string seconds(double value) {
  if (!std::isfinite(value)) return number(value);
  if (value < 9.95) return short_exponent(fmt::format("{:.2g}\u00a0s", value));
  if (value < 119.5) return fmt::format("{:.0f}\u00a0s", value);
  const auto whole = static_cast<long long>(std::llround(value));
  if (whole < 7200) return fmt::format("{}\u00a0min\u00a0{}\u00a0s", whole / 60, whole % 60);
  return fmt::format("{}\u00a0h\u00a0{}\u00a0min", whole / 3600, whole % 3600 / 60);
}

std::string integer(std::int64_t value) {
  std::string digits = fmt::format("{}", value);
  for (std::size_t i = digits.size(); i > 3 && std::isdigit(static_cast<unsigned char>(digits[i - 4]));) {
    i -= 3;
    digits.insert(i, "\u00a0");
    if (i <= 3) break;
  }
  return digits;
}

std::string megabytes(std::int64_t bytes) {
  const double value = static_cast<double>(bytes) / 1e6;
  return value < 99.95 ? fmt::format("{:.1f}", value) : fmt::format("{:.0f}", value);
}

std::string file_stem(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      out += c;
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out.empty() ? "unnamed" : out.substr(0, 80);
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace courant::report
