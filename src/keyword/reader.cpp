// read_deck: keyword lines, includes and parameters; the cards of each keyword are read by CardReader.
#include <fmt/format.h>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "keyword/card_reader.hpp"

namespace courant {

namespace {

/// Requests that have no influence on the physics: read over with a warning instead of an error.
bool is_output_request(const std::string& name) {
  for (const char* prefix :
       {"DATABASE_", "CONTROL_OUTPUT", "CONTROL_PARALLEL", "CONTROL_MPP_", "CONTROL_UNITS"})
    if (name.rfind(prefix, 0) == 0) return true;
  return false;
}

class Reader {
 public:
  Reader(const ReadOptions& options, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), parameters_(options), cards_(deck_, parameters_, diagnostics) {}

  Deck read(const std::string& path) {
    auto source = load_source(path);
    if (!source) {
      deck_.files.push_back(path);
      deck_.sources.push_back(nullptr);
      diagnostics_.error({path, 0, 0}, "cannot read the deck",
                         "is the name right, and is it a readable file?");
      return std::move(deck_);
    }
    read_file(path, std::move(source), true);
    if (cards_.full())
      diagnostics_.note({path, 0, 0}, fmt::format("reading stopped after {} errors", CardReader::max_errors));
    else
      parameters_.check_overrides(path, diagnostics_);
    return std::move(deck_);
  }

 private:
  struct File {
    std::int32_t index = 0;
    std::shared_ptr<SourceText> source;
    const std::string& name;
  };

  void read_file(const std::string& name, std::shared_ptr<SourceText> source, bool main) {
    const auto index = static_cast<std::int32_t>(deck_.files.size());
    deck_.files.push_back(name);
    deck_.sources.push_back(source);
    open_files_.push_back(identity(name));
    const File file{index, std::move(source), name};
    const std::size_t count = file.source->lines.size();
    std::size_t line = skip_text_before_keywords(file, main);
    bool ended = false;
    while (line < count && !ended && !cards_.full()) {
      ended = read_keyword(file, line);
      ++line;
      while (line < count && (file.source->lines[line].empty() || file.source->lines[line][0] != '*')) ++line;
    }
    if (main && !ended && !cards_.full() && !deck_.keyword_counts.empty())
      diagnostics_.warning({name, static_cast<int>(count), 0}, "*END is missing: is the deck complete?");
    open_files_.pop_back();
  }

  std::size_t skip_text_before_keywords(const File& file, bool main) {
    DataLines data(*file.source, 0);
    const bool text = !data.only_blanks_left();
    if (text)
      diagnostics_.error({file.name, static_cast<int>(data.index()) + 1, 1}, "text before the first keyword",
                         "is this a keyword deck? Only comments ($) may stand there");
    while (!data.done()) data.step();
    if (main && !text && data.index() == file.source->lines.size())
      diagnostics_.error({file.name, 0, 0}, "the deck holds no keyword");
    return data.index();
  }

  /// True at *END.
  bool read_keyword(const File& file, std::size_t line) {
    const KeywordLine keyword = parse_keyword_line(file.source->lines[line], file.source->format);
    const Location where{file.name, static_cast<int>(line) + 1, 1};
    ++deck_.keyword_counts[keyword.name];
    const std::string& name = keyword.name;
    if (name == "END") return true;
    if (name == "KEYWORD")
      read_format(file, keyword, where);
    else if (name == "TITLE")
      read_title(file, line);
    else if (name == "PARAMETER")
      read_parameters(file, line, keyword.format);
    else if (name == "INCLUDE")
      read_includes(file, line);
    else if (name != "COMMENT")
      read_cards(file, line, keyword, where);
    return false;
  }

  void read_cards(const File& file, std::size_t line, const KeywordLine& keyword, const Location& where) {
    const KeywordMatch match = index_.match(keyword.name);
    if (match.keyword < 0) {
      refuse(keyword.name, where);
      return;
    }
    const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(match.keyword)];
    const auto [first, is_new] = seen_.try_emplace({match.keyword, match.name}, where);
    if (spec.once && !is_new) {
      diagnostics_.error(where, fmt::format("*{} may stand only once in a deck, first at {}:{}", keyword.name,
                                            first->second.file, first->second.line));
      return;
    }
    cards_.read({.file = file.index,
                 .source = file.source.get(),
                 .line = line,
                 .match = match,
                 .format = keyword.format});
  }

  void refuse(const std::string& name, const Location& where) {
    std::string hint = index_.hint(name);
    if (is_output_request(name)) {
      diagnostics_.warning(where, fmt::format("*{}: this request is not supported and has no effect", name),
                           std::move(hint));
      return;
    }
    if (hint.empty()) hint = "`courant keywords` lists the supported keywords";
    diagnostics_.error(where, fmt::format("*{}: unknown keyword", name), std::move(hint));
  }

  void read_format(const File& file, const KeywordLine& keyword, const Location& where) {
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

  void read_title(const File& file, std::size_t line) {
    const DataLines data(*file.source, line + 1);
    if (!data.done()) deck_.title = trimmed(data.line());
  }

  void read_parameters(const File& file, std::size_t line, CardFormat format) {
    const int width = format == CardFormat::long_fields ? 20 : 10;
    for (DataLines data(*file.source, line + 1); !data.done(); data.step()) {
      const std::vector<Slice> slices = split_equal(data.line(), width, 8 * width);
      for (std::size_t i = 0; i < slices.size(); i += 2) {
        if (slices[i].text.empty()) continue;
        const Location where{file.name, static_cast<int>(data.index()) + 1, slices[i].column};
        parameters_.define(slices[i].text, i + 1 < slices.size() ? slices[i + 1].text : std::string_view{},
                           where, diagnostics_);
      }
    }
  }

  void read_includes(const File& file, std::size_t line) {
    DataLines data(*file.source, line + 1);
    if (data.done() || data.only_blanks_left())
      diagnostics_.error({file.name, static_cast<int>(line) + 1, 1}, "*INCLUDE: the file name is missing");
    while (!data.done() && !cards_.full()) {
      const Location where{file.name, static_cast<int>(data.index()) + 1, 1};
      std::string name;
      bool more = true;
      while (more && !data.done()) {
        std::string_view part = trimmed(data.line());
        more = part.size() >= 2 && part.substr(part.size() - 2) == " +";
        if (more) part.remove_suffix(2);
        name += trimmed(part);
        data.step();
      }
      if (!name.empty()) include(name, file.name, where);
    }
  }

  void include(const std::string& name, const std::string& from, const Location& where) {
    namespace fs = std::filesystem;
    const fs::path beside = fs::path(from).parent_path() / name;
    std::string path = beside.lexically_normal().string();
    auto source = load_source(path);
    if (!source) {
      path = name;
      source = load_source(path);
    }
    if (!source) {
      diagnostics_.error(where, fmt::format("*INCLUDE: cannot read '{}'", name),
                         "looked beside the including file and in the working directory");
      return;
    }
    const std::string id = identity(path);
    for (const std::string& open : open_files_) {
      if (open != id) continue;
      diagnostics_.error(where, fmt::format("*INCLUDE: '{}' includes itself", name));
      return;
    }
    read_file(path, std::move(source), false);
  }

  static std::string identity(const std::string& path) {
    std::error_code fault;
    const auto full = std::filesystem::weakly_canonical(path, fault);
    return fault ? path : full.string();
  }

  Deck deck_;
  Diagnostics& diagnostics_;
  Parameters parameters_;
  CardReader cards_;
  KeywordIndex index_;
  std::vector<std::string> open_files_;  // from the deck to the file being read
  std::map<std::pair<int, int>, Location> seen_;
};

}  // namespace

Deck read_deck(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics) {
  return Reader(options, diagnostics).read(path);
}

}  // namespace courant
