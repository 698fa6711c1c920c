// read_deck: files and keyword lines.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "keyword/help/families.hpp"
#include "keyword/read/deck_reader.hpp"
#include "keyword/read/number.hpp"
#include "keyword/read/repeated_cards.hpp"

namespace courant {

namespace {

bool is_blank(const SourceText& source) {
  return std::all_of(source.lines.begin(), source.lines.end(),
                     [](std::string_view line) { return trimmed(line).empty(); });
}

}  // namespace

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
  if (!options_.more.empty()) read_file({.name = "the call"}, make_source(options_.more));
  close_definitions();
  controls_.close(deck_, diagnostics_);
  close_requests();
  refusals_.close(diagnostics_);
  cards_.close();
  if (cards_.full())
    diagnostics_.note({path, 0, 0}, fmt::format("reading stopped after {} errors", CardReader::max_errors));
  else
    parameters_.check_overrides(path, diagnostics_);
  // a line that was refused may be the one that uses it
  if (diagnostics_.ok()) parameters_.check_unused(diagnostics_);
  deck_.parameters = parameters_.list();
  return std::move(deck_);
}

std::shared_ptr<SourceText> DeckReader::load(const std::string& path) const {
  if (!options_.open) return load_source(path);
  std::optional<std::string> text = options_.open(path);
  return text ? make_source(std::move(*text)) : nullptr;
}

void DeckReader::read_file(DeckFile deck_file, std::shared_ptr<SourceText> source) {
  const File file{static_cast<std::int32_t>(deck_.files.size()), std::move(source)};
  deck_file.source = file.source;
  deck_.files.push_back(std::move(deck_file));
  for (const SourceFault& fault : file.source->faults)
    diagnostics_.error(deck_.location(file.index, fault.line, fault.column), fault.message, fault.hint);
  if (!file.source->faults.empty()) return;
  const std::size_t count = file.source->lines.size();
  parameters_.enter_file();
  std::size_t line = skip_text_before_keywords(file);
  bool ended = false;
  while (line < count && !ended && !cards_.full()) {
    ended = read_keyword(file, line);
    line = file.source->next_keyword(line + 1);
  }
  parameters_.leave_file();
  if (!ended && !cards_.full() && count > 0) check_end(file);
}

/// A file that was cut off, by a full disk or a broken transfer, must not pass for a smaller one.
void DeckReader::check_end(const File& file) {
  const std::vector<std::string_view>& lines = file.source->lines;
  const std::size_t last = lines.size() - 1;
  const auto is_data = [&](std::size_t i) {
    return !trimmed(lines[i]).empty() && lines[i][0] != '*' && lines[i][0] != '$';
  };
  const bool within_data = file.source->ends_within_line && is_data(last);
  const bool shorter = within_data && last > 0 && is_data(last - 1) &&
                       lines[last].size() < lines[last - 1].size() &&
                       lines[last].find(',') == std::string_view::npos;
  if (file.index == 0 && shorter) {
    diagnostics_.error(place(file, last),
                       "the deck ends without *END and within a line that is shorter than the one above: is "
                       "it cut off?",
                       "if its last line is whole, end it, or end the deck with *END");
  } else if (file.index == 0 && within_data) {
    diagnostics_.warning(place(file, last), "the deck ends within a line and without *END: is it cut off?",
                         "if its last line is whole, end the deck with *END");
  } else if (file.index == 0 && !deck_.keywords.empty()) {
    diagnostics_.warning(place(file, last, 0), "*END is missing: is the deck complete?");
  } else if (shorter) {
    // included files need no *END, and some editors write no last line end
    diagnostics_.warning(
        place(file, last),
        "the last line has no line end and is shorter than the one above: is the file cut off?",
        "if it is whole, end the line");
  }
}

std::size_t DeckReader::skip_text_before_keywords(const File& file) {
  DataLines data(*file.source, 0);
  while (!data.done() && trimmed(data.line()).empty()) data.step();
  const std::size_t first = file.source->next_keyword(0);
  if (!data.done() && !file.source->encrypted_lines.empty() &&
      file.source->encrypted_lines.front() == data.index())
    diagnostics_.error(place(file, data.index()), "encrypted text before the first keyword cannot be read",
                       "ask its owner for plain text");
  else if (!data.done())
    diagnostics_.error(place(file, data.index()), "text before the first keyword",
                       "is this a keyword deck? Only comments ($) are allowed there");
  else if (first == file.source->lines.size() && file.index == 0)
    diagnostics_.error({deck_.files[0].name, 0, 0}, "the deck holds no keyword");
  else if (first == file.source->lines.size() && is_blank(*file.source))
    diagnostics_.warning(place(file, 0, 0), "the file is empty");
  return first;
}

bool DeckReader::read_keyword(const File& file, std::size_t line) {
  const KeywordLine keyword = parse_keyword_line(file.source->lines[line], file.source->format);
  // an included file may count the same keyword while this one is being read
  Treatment treatment = Treatment::refused;
  if (!refuse_encrypted(file, line, keyword))
    treatment =
        read_deck_keyword(file, line, keyword) ? Treatment::honoured : read_cards(file, line, keyword);
  KeywordUse& use = deck_.keywords[keyword.name];
  ++use.blocks;
  use.entries += cards_.take_count();
  use.treatment = treatment;
  if (treatment != Treatment::honoured) note_refused(file, line, keyword.name, use);
  return keyword.name == "END";
}

bool DeckReader::refuse_encrypted(const File& file, std::size_t line, const KeywordLine& keyword) {
  const auto& blocks = file.source->encrypted_lines;
  const auto block = std::lower_bound(blocks.begin(), blocks.end(), line);
  if (keyword.name == "END" || block == blocks.end() || *block >= file.source->next_keyword(line + 1))
    return false;
  diagnostics_.error(place(file, *block), fmt::format("*{}: encrypted cards cannot be read", keyword.name),
                     "ask their owner for plain text");
  return true;
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
  if (name.rfind("CASE", 0) == 0) {  // runs of cases read the deck without these (cases.hpp)
    if (refusals_.is_first(name, diagnostics_))
      diagnostics_.error(place(file, line),
                         fmt::format("*{}: cases count where the deck itself has some", name),
                         "put a *CASE_BEGIN_n and its *CASE_END_n into the deck, around *INCLUDE or not");
    return true;
  }
  if (read_keyword_keyword(file, line, keyword)) return true;
  if (name == "TITLE") {
    read_title(file, line);
    return true;
  }
  return read_parameter_keyword(file, line, keyword) || read_include_keyword(file, line, keyword);
}

namespace {

/// Keywords to which no other one refers, so that the rest of the deck can be judged without them.
bool defines_nothing(const std::string& name) {
  for (const char* begin : {"AIRBAG", "BOUNDARY", "CONTROL", "DAMPING", "INITIAL", "LOAD", "PERTURBATION",
                            "RIGIDWALL", "SENSOR_CONTROL", "TERMINATION"})
    if (name.starts_with(begin)) return true;
  return false;
}

bool is_of_parallel_files(const std::string& name) {
  return name.starts_with("CONTROL_MPP_IO_");
}

/// Whether lines hold nothing but zeros, as 0, 0.0 or 0.000E+00.
bool all_zero(DataLines data) {
  for (; !data.done(); data.step())
    for (std::string_view left = data.line(); !left.empty();) {
      const std::string_view word = left.substr(0, left.find_first_of(" ,\t\r"));
      left.remove_prefix(std::min(word.size() + 1, left.size()));
      Real value = 0;
      if (!word.empty() && !(parse_real(word, value) && value == 0)) return false;
    }
  return true;
}

}  // namespace

Treatment DeckReader::read_cards(const File& file, std::size_t line, const KeywordLine& keyword) {
  const Location where = place(file, line);
  const KeywordMatch match = index_.match(keyword.name);
  const bool refused =
      match.keyword < 0 || !keyword_registry()[static_cast<std::size_t>(match.keyword)]->lacking.empty();
  if (refused && keyword.name.starts_with("CONTROL_") && !is_of_parallel_files(keyword.name) &&
      all_zero(DataLines(*file.source, line + 1))) {
    diagnostics_.note(where,
                      fmt::format("*{}: all fields are 0 or blank, which changes nothing", keyword.name));
    return Treatment::honoured;
  }
  if (match.keyword < 0) {
    for (DataLines data(*file.source, line + 1); !data.done(); data.step())
      parameters_.note_mentions(data.line());
    if (is_output_request(keyword.name)) return note_request(file, line, keyword, where);
    return defer_definition(file, line, keyword) ? Treatment::refused : refuse(keyword.name, where);
  }
  const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(match.keyword)];
  const CardReader::Block block{.file = file.index,
                                .source = file.source.get(),
                                .line = line,
                                .match = match,
                                .format = keyword.format};
  if (const ControlledPhysics* physics = controlled_physics(keyword.name); physics && spec.lacking.empty())
    cards_.read(block, controls_.held(keyword.name, *physics, where));
  else
    cards_.read(block, diagnostics_);
  if (spec.once) keep_last_cards(deck_, match.keyword, match.name, diagnostics_);
  if (spec.lacking.empty()) return Treatment::honoured;
  if (refusals_.is_first(keyword.name, diagnostics_))
    diagnostics_.add({Severity::error, where,
                      fmt::format("*{}: {}", keyword.name, not_supported(spec.lacking)), "",
                      defines_nothing(keyword.name)});
  return Treatment::refused;
}

// An interval beyond the end of the run asks for nothing, nor do the files of parallel runs. Field 1 of other
// requests may be an id.
Treatment DeckReader::note_request(const File& file, std::size_t line, const KeywordLine& keyword,
                                   const Location& where) {
  const std::string& name = keyword.name;
  if (is_of_parallel_files(name)) return Treatment::honoured;
  const DataLines data(*file.source, line + 1);
  if (data.done() || !name.starts_with("DATABASE_BINARY_")) return refuse(name, where);
  Real interval = 0;
  parse_real(first_field(data, keyword), interval);
  if (!(interval > 0)) return refuse(name, where);
  requests_.push_back({name, where, interval});
  return Treatment::output_only;
}

std::string DeckReader::first_field(const DataLines& data, const KeywordLine& keyword) {
  const int width = keyword.format == CardFormat::long_fields ? 20 : 10;
  const std::vector<Slice> fields = split_equal(data.line(), width, width);
  if (fields.empty()) return "";
  const std::string_view text = fields.front().text;
  return std::string(Parameters::is_reference(text) ? parameters_.resolve(text).text : text);
}

void DeckReader::close_requests() {
  std::optional<Real> end;
  const std::int32_t termination = index_.match("CONTROL_TERMINATION").keyword;
  if (termination >= 0) {
    const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(termination)];
    spec.for_each(deck_, termination, [&](const Entry& entry) { end = spec.number_of(entry, 0, 0); });
  }
  const auto is_idle = [&](const Request& request) { return end && request.interval > *end; };
  for (const Request& request : requests_)
    if (is_idle(request)) deck_.keywords[request.name].treatment = Treatment::honoured;
  for (const Request& request : requests_)
    if (!is_idle(request)) deck_.keywords[request.name].treatment = refuse(request.name, request.where);
}

Treatment DeckReader::refuse(const std::string& name, const Location& where) {
  if (name.empty()) {
    diagnostics_.error(where, "a '*' in column 1 without the name of a keyword",
                       "the name follows it directly; a comment begins with $");
    return Treatment::refused;
  }
  if (const char* const reason = why_without_effect(name)) {
    if (refusals_.is_first(name, diagnostics_))
      diagnostics_.note(where, fmt::format("*{}: {}: no effect", name, reason));
    return Treatment::honoured;
  }
  const bool is_output = is_output_request(name);
  const Treatment treatment = is_output ? Treatment::output_only : Treatment::refused;
  if (is_output && diagnostics_.warnings() >= Diagnostics::max_warnings) {
    diagnostics_.warning(where, "");  // only counted: a hint would take a look at all keywords in vain
    return treatment;
  }
  if (controls_.holds(name)) return treatment;
  if (const ControlledPhysics* physics = controlled_physics(name))
    if (const Refusal why = families().refusal(name); !why.lacking.empty()) {
      controls_.held(name, *physics, where)
          .error(where, fmt::format("*{}: {}", name, not_supported(why.lacking)), why.hint);
      return treatment;
    }
  if (!refusals_.is_first(name, diagnostics_)) return treatment;
  if (is_output) {
    diagnostics_.warning(where, fmt::format("*{}: this request is not supported and has no effect", name),
                         families().slip(name, 1));
    return treatment;
  }
  Refusal why = families().refusal(name);
  diagnostics_.add(
      {Severity::error, where,
       fmt::format("*{}: {}", name, why.lacking.empty() ? "unknown keyword" : not_supported(why.lacking)),
       std::move(why.hint), defines_nothing(name)});
  return treatment;
}

void DeckReader::read_title(const File& file, std::size_t line) {
  DataLines data(*file.source, line + 1);
  if (data.done()) return;
  deck_.title = parameters_.title(data.line());
  if (const std::size_t length = trimmed(data.line()).size(); length > Parameters::longest_title)
    diagnostics_.warning(
        place(file, data.index()),
        fmt::format("*TITLE: the first {} of {} characters are taken", Parameters::longest_title, length));
  data.step();
  warn_of_more_lines(file, data, "TITLE");
}

void DeckReader::warn_of_more_lines(const File& file, DataLines data, const std::string& name) {
  while (!data.done() && trimmed(data.line()).empty()) data.step();
  if (!data.done())
    diagnostics_.warning(place(file, data.index()),
                         fmt::format("*{} has one card; this line is not read", name));
}

}  // namespace courant
