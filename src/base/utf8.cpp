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

}  // namespace courant
