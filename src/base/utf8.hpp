#pragma once
#include <string>
#include <string_view>

namespace courant {

/// The text with U+FFFD for bytes that are no UTF-8, as names of files may have them: no reader of YAML or
/// JSON takes others.
std::string valid_utf8(std::string_view text);

}  // namespace courant
