#pragma once
// How the reports write numbers and words.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/real.hpp"

namespace courant::report {

/// Text that may stand between the tags and in the attributes of HTML and SVG. What is not UTF-8 and control
/// characters become '?', as one wrong byte would make an SVG file unreadable.
std::string escape_xml(std::string_view text);

/// Text without meaning to Markdown (GitHub's dialect), on one line, also within tables.
std::string escape_markdown(std::string_view text);

/// Paragraphs of a text: parts between blank lines.
std::vector<std::string> paragraphs(std::string_view text);

/// Characters (not bytes) of UTF-8 text.
std::size_t length(std::string_view text);
/// The text, or its first characters and an ellipsis if it has more than `most`.
std::string shorten(std::string_view text, std::size_t most);

std::string number(Real value, int digits = 4);  ///< significant digits; "not a number", "infinite"
std::string percent(Real fraction);  ///< with a blank that does not break: 0.012 -> "1.2 %"; very small and
                                     ///< large ones: "1.2e-7"
std::string seconds(double value);   ///< "3.1 s", "12 min 4 s"
std::string integer(std::int64_t value);    ///< groups of three digits
std::string megabytes(std::int64_t bytes);  ///< "12.3", without unit

/// A name for a file: letters, digits and '-'; never empty.
std::string file_stem(std::string_view text);

std::string base64(std::string_view bytes);

}  // namespace courant::report
