// read_deck: files and keyword lines.
#include <fmt/format.h>
#include <utility>

#include "keyword/deck_reader.hpp"
#include "keyword/families.hpp"

namespace courant {

Deck read_deck(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics) {
  return DeckReader(options, diagnostics).read(path);
}

Deck DeckReader::read(const std::string& path) {
  auto source = load(path);
  if (!source) {
    deck_.files.push_back({.name = path});
    diagnostics_.error({path, 0, 0}, "cannot read the deck", "is the name right, and is it a readable file?");
    return std::move(deck_);
  }
  read_file({.name = path}, std::move(source));
  refusals_.close(diagnostics_);
  if (cards_.full())
    diagnostics_.note({path, 0, 0}, fmt::format("reading stopped after {} errors", CardReader::max_errors));
  else
    parameters_.check_overrides(path, diagnostics_);
  return std::move(deck_);
}

std::shared_ptr<SourceText> DeckReader::load(const std::string& path) const {
  if (!options_.open) return load_source(path);
  std::optional<std::string> text = options_.open(path);
  return text ? make_source(std::move(*text)) : nullptr;
}

void DeckReader::read_file(DeckFile deck_file, std::shared_ptr<SourceText> source) {
  const File file{static_cast<std::int32_t>(deck_.files.size()), std::move(source)};
  const std::string name = deck_file.name;
  deck_file.source = file.source;
  deck_.files.push_back(std::move(deck_file));
  const std::size_t count = file.source->lines.size();
  std::size_t line = skip_text_before_keywords(file);
  bool ended = false;
  while (line < count && !ended && !cards_.full()) {
    ended = read_keyword(file, line);
    ++line;
    while (line < count && (file.source->lines[line].empty() || file.source->lines[line][0] != '*')) ++line;
  }
  if (file.index == 0 && !ended && !cards_.full() && !deck_.keywords.empty())
    diagnostics_.warning({name, static_cast<int>(count), 0}, "*END is missing: is the deck complete?");
}

std::size_t DeckReader::skip_text_before_keywords(const File& file) {
  DataLines data(*file.source, 0);
  const bool text = !data.only_blanks_left();
  if (text)
    diagnostics_.error(place(file, data.index()), "text before the first keyword",
                       "is this a keyword deck? Only comments ($) may stand there");
  while (!data.done()) data.step();
  if (file.index == 0 && !text && data.index() == file.source->lines.size())
    diagnostics_.error({deck_.files[0].name, 0, 0}, "the deck holds no keyword");
  return data.index();
}

bool DeckReader::read_keyword(const File& file, std::size_t line) {
  const KeywordLine keyword = parse_keyword_line(file.source->lines[line], file.source->format);
  // an included file may count the same keyword while this one is being read
  const Treatment treatment =
      read_deck_keyword(file, line, keyword) ? Treatment::honoured : read_cards(file, line, keyword);
  KeywordUse& use = deck_.keywords[keyword.name];
  ++use.blocks;
  use.entries += cards_.take_count();
  use.treatment = treatment;
  if (treatment != Treatment::honoured) note_refused(file, line, keyword.name, use);
  return keyword.name == "END";
}

void DeckReader::note_refused(const File& file, std::size_t line, const std::string& name, KeywordUse& use) {
  if (const KeywordMatch match = index_.match(name); match.keyword >= 0) {
    use.lacking = keyword_registry()[static_cast<std::size_t>(match.keyword)]->lacking;
    return;
  }
  if (use.blocks == 1 && use.treatment == Treatment::refused) use.lacking = families().refusal(name).lacking;
  for (DataLines data(*file.source, line + 1); !data.done(); data.step()) ++use.lines;
}

/// Made when the first keyword without a table comes.
const Families& DeckReader::families() {
  if (!families_) families_.emplace();
  return *families_;
}

/// Keywords that shape the deck itself.
bool DeckReader::read_deck_keyword(const File& file, std::size_t line, const KeywordLine& keyword) {
  const std::string& name = keyword.name;
  if (name == "END" || name == "COMMENT") return true;
  if (name == "KEYWORD") {
    read_format(file, keyword, place(file, line));
    return true;
  }
  if (name == "TITLE") {
    read_title(file, line);
    return true;
  }
  return read_parameter_keyword(file, line, keyword) || read_include_keyword(file, line, keyword);
}

Treatment DeckReader::read_cards(const File& file, std::size_t line, const KeywordLine& keyword) {
  const Location where = place(file, line);
  const KeywordMatch match = index_.match(keyword.name);
  if (match.keyword < 0) return refuse(keyword.name, where);
  const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(match.keyword)];
  const auto [first, is_new] = seen_.try_emplace({match.keyword, match.name}, where);
  if (spec.once && !is_new) {
    diagnostics_.error(where, fmt::format("*{} may stand only once in a deck, first at {}:{}", keyword.name,
                                          first->second.file, first->second.line));
    return Treatment::honoured;
  }
  cards_.read({.file = file.index,
               .source = file.source.get(),
               .line = line,
               .match = match,
               .format = keyword.format});
  if (spec.lacking.empty()) return Treatment::honoured;
  if (refusals_.is_first(keyword.name, diagnostics_))
    diagnostics_.error(where, fmt::format("*{}: {}", keyword.name, not_supported(spec.lacking)));
  return Treatment::refused;
}

Treatment DeckReader::refuse(const std::string& name, const Location& where) {
  const bool is_output = is_output_request(name);
  const Treatment treatment = is_output ? Treatment::output_only : Treatment::refused;
  if (!refusals_.is_first(name, diagnostics_)) return treatment;
  if (is_output) {
    diagnostics_.warning(where, fmt::format("*{}: this request is not supported and has no effect", name),
                         families().slip(name, 1));
    return treatment;
  }
  Refusal why = families().refusal(name);
  diagnostics_.error(
      where,
      fmt::format("*{}: {}", name, why.lacking.empty() ? "unknown keyword" : not_supported(why.lacking)),
      std::move(why.hint));
  return treatment;
}

void DeckReader::read_format(const File& file, const KeywordLine& keyword, const Location& where) {
  const std::string words = upper_case(keyword.rest);
  const auto value_of = [&](const std::string& key) -> std::string {
    const std::size_t at = words.find(key + "=");
    return at == std::string::npos ? "" : words.substr(at + key.size() + 1, 1);
  };
  if (const std::string v = value_of("LONG"); v == "Y")
    file.source->format = CardFormat::long_fields;
  else if (!v.empty() && v != "S" && v != "K" && v != "N")
    diagnostics_.error(where, fmt::format("*KEYWORD: LONG={} is not known", v), "LONG=Y, LONG=S or LONG=K");
  if (const std::string v = value_of("I10"); v == "Y")
    file.source->format = CardFormat::i10;
  else if (!v.empty() && v != "N")
    diagnostics_.error(where, fmt::format("*KEYWORD: I10={} is not known", v), "I10=Y or I10=N");
}

void DeckReader::read_title(const File& file, std::size_t line) {
  const DataLines data(*file.source, line + 1);
  if (!data.done()) deck_.title = trimmed(data.line());
}

}  // namespace courant
