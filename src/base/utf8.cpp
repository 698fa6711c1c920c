#include "base/utf8.hpp"

namespace courant {

std::string valid_utf8(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return static_cast<unsigned char>(k < text.size() ? text[k] : 0);
    };
    const unsigned char first = byte(i);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xC2 ? 0
                               : first < 0xE0 ? 2
                               : first < 0xF0 ? 3
                               : first < 0xF5 ? 4
                                              : 0;
    bool whole = length > 0;
    for (std::size_t k = 1; k < length; ++k) whole = whole && (byte(i + k) & 0xC0) == 0x80;
    if (first == 0xE0) whole = whole && byte(i + 1) >= 0xA0;  // nothing longer than it must be,
    if (first == 0xED) whole = whole && byte(i + 1) < 0xA0;   // no halves of pairs,
    if (first == 0xF0) whole = whole && byte(i + 1) >= 0x90;
    if (first == 0xF4) whole = whole && byte(i + 1) < 0x90;  // nothing beyond U+10FFFF
    out += whole ? text.substr(i, length) : std::string_view("\xEF\xBF\xBD");
    i += whole ? length : 1;
  }
  return out;
}

std::string without_controls(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  const auto is_continuation = [&](std::size_t k) {
    return k < text.size() && (static_cast<unsigned char>(text[k]) & 0xC0) == 0x80;
  };
  std::size_t of_character = 0;  // bytes that go on with the character before
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool goes_on = of_character > 0 && is_continuation(i);
    of_character = goes_on ? of_character - 1 : byte < 0xC2 ? 0 : byte < 0xE0 ? 1 : byte < 0xF0 ? 2 : 3;
    const bool ascii = (byte < 0x20 && byte != '\n') || byte == 0x7F;
    const bool latin = byte >= 0x80 && byte < 0xA0 && (!goes_on || out.back() == '\xC2');
    if (latin && goes_on) out.pop_back();
    out += ascii || latin ? '?' : text[i];
  }
  return out;
}

std::string_view cut_utf8(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80) --most;
  return text.substr(0, most);
}

}  // namespace courant
