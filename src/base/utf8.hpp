#pragma once
#include <string>
#include <string_view>

namespace courant {

/// The text with U+FFFD for bytes that are no UTF-8, as names of files may have them: no reader of YAML or
/// JSON takes others.
std::string valid_utf8(std::string_view text);

/// The text with '?' for control characters, which could act on a terminal (those of ASCII but line feeds,
/// and those of Latin 1, as single bytes or as UTF-8).
std::string without_controls(std::string_view text);

/// The first bytes, `most` at most, without a part of a UTF-8 character at the end.
std::string_view cut_utf8(std::string_view text, std::size_t most);

}  // namespace courant
