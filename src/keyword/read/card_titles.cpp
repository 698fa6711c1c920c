// Lines in front of the cards: headings, titles, _ID and _MPP.
#include <fmt/format.h>
#include <algorithm>

#include "keyword/read/card_reader.hpp"
#include "keyword/read/number.hpp"

namespace courant {

bool CardReader::read_title_lines(DataLines& data, EntrySink& sink) {
  const auto next = [&](const char* what) {
    if (data.done()) {
      missing(data, what);
      return false;
    }
    line_ = static_cast<int>(data.index()) + 1;
    return true;
  };
  if (spec_->heading) {
    sink.set_title(parameters_.title(data.line()));
    data.step();
  }
  if (block_.match.id) {
    if (!next("the line with ID and heading")) return false;
    read_id_line(data.line(), line_, sink);
    data.step();
  }
  if (block_.match.title) {
    if (!next("the title line")) return false;
    sink.set_title(parameters_.title(data.line()));
    data.step();
  }
  if (block_.match.mpp) {
    if (!next("the line of the option _MPP")) return false;
    const std::size_t first = data.index();
    skip_mpp_lines(data);
    for (std::size_t k = first; k < data.index(); ++k) parameters_.note_mentions(block_.source->lines[k]);
  }
  return true;
}

void CardReader::read_id_line(std::string_view line, int number, EntrySink& sink) {
  const std::size_t width = block_.format == CardFormat::long_fields ? 20 : 10;
  const std::size_t comma = next_comma(line, 0, has_brackets(line));
  // a heading may contain commas, so only one within the ID's columns separates
  const std::size_t end = std::min(comma < width ? comma : width, line.size());
  const std::string_view text = trimmed(line.substr(0, end));
  Id id = 0;
  std::string fault, hint = "the option _ID adds a line with the ID in columns 1-10 and a heading in 11-80";
  if (Parameters::is_reference(text)) {
    Parameters::Resolved value = parameters_.resolve(text);
    id = value.number.integer;
    if (value.failed) {
      if (!is_news(value)) value.error.clear();
      fault = value.error;
      hint = value.hint;
    } else if (value.type != 'I' || id < 0) {
      fault = fmt::format("expected an integer >= 0, got '{}', which is {}", text,
                          value.type == 'C'   ? "a text (C)"
                          : value.type == 'R' ? "a real (R)"
                                              : value.text);
      hint = value.origin;
    }
  } else if (!text.empty() && (!parse_integer(text, id) || id < 0)) {
    fault = fmt::format("expected an integer >= 0, got '{}'", text);
  }
  line_ = number;
  if (!fault.empty())
    diagnostics_->error(here(1),
                        fmt::format("*{}_ID field 1 (ID, number of the entry [-]): {}",
                                    spec_->names[static_cast<std::size_t>(block_.match.name)], fault),
                        hint);
  sink.set_id(id);
  sink.set_title(parameters_.title(line.substr(std::min(end + (comma < width ? 1 : 0), line.size()))));
}

}  // namespace courant
