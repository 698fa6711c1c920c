// *KEYWORD: the format of a file's cards.
#include <fmt/format.h>
#include <algorithm>

#include "keyword/read/deck_reader.hpp"

namespace courant {

namespace {

struct Word {
  std::string key, value;  ///< of KEY=VALUE, in upper case
};

/// "LONG=Y memory = 20m, ncpu=-4 remark" -> LONG=Y, MEMORY=20M, NCPU=-4. Words without '=' are remarks.
std::vector<Word> words_of(std::string_view text) {
  constexpr std::string_view separators = " ,";
  const auto skip_blanks = [&](std::size_t at) {
    return std::min(text.find_first_not_of(' ', at), text.size());
  };
  std::vector<Word> words;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find_first_of(" ,=", at), text.size());
    const std::size_t equals = skip_blanks(end);
    if (end == at || equals == text.size() || text[equals] != '=') {
      at = std::max(end, at + 1);
      continue;
    }
    const std::size_t value = skip_blanks(equals + 1);
    const std::size_t value_end = std::min(text.find_first_of(separators, value), text.size());
    words.push_back(
        {upper_case(text.substr(at, end - at)), upper_case(text.substr(value, value_end - value))});
    at = value_end;
  }
  return words;
}

}  // namespace

bool DeckReader::read_keyword_keyword(const File& file, std::size_t line, const KeywordLine& keyword) {
  const std::string& name = keyword.name;
  if (name != "KEYWORD" && name != "KEYWORD_ID" && name != "KEYWORD_JOBID") return false;
  read_format(file, keyword, place(file, line));
  if (name != "KEYWORD")
    diagnostics_.warning(place(file, line),
                         fmt::format("*{}: a prefix of file names is not supported and has no effect", name),
                         "choose the folder of the results when you start the run");
  // the one card: memory and number of processors, or the prefix
  DataLines data(*file.source, line + 1);
  if (!data.done()) data.step();
  warn_of_more_lines(file, data, name);
  return true;
}

void DeckReader::read_format(const File& file, const KeywordLine& keyword, const Location& where) {
  bool is_long = false, is_i10 = false;
  for (const auto& [key, value] : words_of(keyword.rest)) {
    const std::string letter = value.substr(0, 1);  // YES is as good as Y
    if (key == "LONG") {
      is_long = letter == "Y";
      if (letter != "Y" && letter != "S" && letter != "K" && letter != "N")
        diagnostics_.error(where, fmt::format("*KEYWORD: LONG={} is not known", value),
                           "LONG=Y, LONG=S or LONG=K");
    } else if (key == "I10") {
      is_i10 = letter == "Y";
      if (letter != "Y" && letter != "N")
        diagnostics_.error(where, fmt::format("*KEYWORD: I10={} is not known", value), "I10=Y or I10=N");
    } else if (key != "MEMORY" && key != "MEMORY2" && key != "NCPU") {
      // LONG misspelt would move every column
      const std::string near = nearest_word(key, {"LONG", "I10", "MEMORY", "MEMORY2", "NCPU"});
      diagnostics_.warning(where, fmt::format("*KEYWORD: {}= is not known and has no effect", key),
                           near.empty() ? "" : fmt::format("did you mean {}=?", near));
    }
  }
  if (is_long && is_i10)
    diagnostics_.error(where, "*KEYWORD: LONG=Y and I10=Y exclude each other",
                       "keep the one that the cards follow");
  else if (is_long)
    file.source->format = CardFormat::long_fields;
  else if (is_i10)
    file.source->format = CardFormat::i10;
}

}  // namespace courant
