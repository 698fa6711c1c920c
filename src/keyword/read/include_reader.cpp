// *INCLUDE and its kin.
#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "keyword/read/deck_reader.hpp"
#include "keyword/read/include_card.hpp"
#include "keyword/read/number.hpp"

namespace courant {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_open_files = 100, most_files = 10000;
// A file may be read often, for copies of a body; beyond this, bytes, only as many times as a deck can mean.
constexpr std::size_t free_rereading = std::size_t(8) << 20, most_rereading = 500;
constexpr Id largest_offset = 1'000'000'000'000'000;  // ids in LONG format have no more digits

std::string identity(const std::string& path) {
  std::error_code fault;
  const auto full = fs::weakly_canonical(path, fault);
  return fault ? path : full.string();
}

/// FCTTEM is a word like FtoC. Some programs write a factor instead.
bool changes_temperatures(const std::string& fcttem) {
  Real factor = 0;
  return !fcttem.empty() && !(parse_real(fcttem, factor) && (factor == 0 || factor == 1));
}

Id largest(const IdOffsets& o) {
  return std::max({o.node, o.element, o.part, o.material, o.set, o.curve, o.definition, o.other});
}

}  // namespace

bool DeckReader::read_include_keyword(const File& file, std::size_t line, const KeywordLine& keyword) {
  if (keyword.name == "INCLUDE")
    read_includes(file, line);
  else if (keyword.name == "INCLUDE_PATH" || keyword.name == "INCLUDE_PATH_RELATIVE")
    read_include_paths(file, line, keyword.name == "INCLUDE_PATH_RELATIVE");
  else if (keyword.name == "INCLUDE_TRANSFORM")
    read_include_transform(file, line, keyword);
  else
    return false;
  return true;
}

void DeckReader::read_includes(const File& file, std::size_t line) {
  DataLines data(*file.source, line + 1);
  if (data.done() || data.only_blanks_left())
    diagnostics_.warning(place(file, line), "*INCLUDE names no file: nothing is included");
  while (!data.done() && !cards_.full()) {
    const std::size_t at = data.index();
    const std::string name = parameters_.with_texts(read_file_name(data));
    if (!name.empty()) include(name, file, at, {}, "*INCLUDE");
  }
}

void DeckReader::read_include_paths(const File& file, std::size_t line, bool relative_to_deck) {
  const fs::path deck_folder = fs::path(deck_.files[0].name).parent_path();
  for (DataLines data(*file.source, line + 1); !data.done();) {
    std::string name = parameters_.with_texts(read_file_name(data));
    if (name.empty()) continue;
    std::error_code fault;
    if (name.find('\\') != std::string::npos && !fs::exists(name, fault))
      std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path beside_deck = deck_folder / name;
    if (!relative_to_deck) include_paths_.push_back(name);
    if (relative_to_deck || beside_deck != name) include_paths_.push_back(beside_deck.string());
  }
}

void DeckReader::read_include_transform(const File& file, std::size_t line, const KeywordLine& keyword) {
  const int errors = diagnostics_.errors();
  cards_.read({.file = file.index,
               .source = file.source.get(),
               .line = line,
               .match = index_.match(keyword.name),
               .format = keyword.format},
              diagnostics_);
  cards_.take_count();  // else the included file's first keyword would count it
  if (diagnostics_.errors() > errors) return;
  const IncludeTransformCard card = deck_.store<IncludeTransformCard>().back();
  const Conversion conversion = card.conversion();
  const Conversion whole = deck_.files[static_cast<std::size_t>(file.index)].conversion.then(conversion);
  if (largest(whole.offsets) > largest_offset)
    deck_.error(diagnostics_, card, "IDNOFF",
                fmt::format("an offset, with those of the including files, is above {}", largest_offset));
  else if (changes_temperatures(card.fcttem))
    deck_.error(diagnostics_, card, "FCTTEM", fmt::format("'{}' is not supported", card.fcttem),
                "leave the field blank");
  else if (card.filename.empty())
    diagnostics_.error(place(file, line), "*INCLUDE_TRANSFORM: the file name is missing");
  else
    include(card.filename, file, static_cast<std::size_t>(card.line - 1), conversion, "*INCLUDE_TRANSFORM");
}

/// Where a name may lead to, in the order in which they are tried. Names with the backslashes of Windows are
/// tried as they are, then with slashes.
std::vector<std::string> DeckReader::candidates(const std::string& name, const std::string& including) const {
  std::vector<std::string> names = {name};
  if (name.find('\\') != std::string::npos) {
    names.push_back(name);
    std::replace(names[1].begin(), names[1].end(), '\\', '/');
  }
  std::vector<fs::path> folders = {fs::path(including).parent_path(), fs::path()};
  folders.insert(folders.end(), include_paths_.begin(), include_paths_.end());
  std::vector<std::string> out;
  for (const std::string& one : names)
    for (const fs::path& folder : folders)
      if (std::string path = (folder / one).lexically_normal().string();
          std::find(out.begin(), out.end(), path) == out.end())
        out.push_back(std::move(path));
  return out;
}

/// Refuses cycles, and chains and numbers of files that only a faulty deck has.
bool DeckReader::may_include(const std::string& path, const Location& where, const char* keyword) {
  const std::string id = identity(path);
  if (id == identity(deck_.files[0].name) ||
      std::find(open_files_.begin(), open_files_.end(), id) != open_files_.end()) {
    diagnostics_.error(where, fmt::format("{}: '{}' includes itself", keyword, path));
  } else if (open_files_.size() + 1 >= most_open_files) {
    diagnostics_.error(
        where, fmt::format("{}: files include each other more than {} deep", keyword, most_open_files));
  } else if (deck_.files.size() >= most_files) {
    too_many_files_ = true;
    diagnostics_.error(where, fmt::format("{}: the deck has more than {} files", keyword, most_files),
                       "does a file that is included many times include others?");
  } else if (reread_bytes_ > free_rereading + most_rereading * distinct_bytes_) {
    too_many_files_ = true;
    diagnostics_.error(where,
                       fmt::format("{}: the same files are read more than {} times", keyword, most_rereading),
                       "does a file that is included many times include others?");
  } else {
    return true;
  }
  return false;
}

/// Shares the text of a file that was read before: it may be included many times.
std::shared_ptr<SourceText> DeckReader::load_once(const std::string& path) {
  if (const auto it = sources_.find(path); it != sources_.end()) {
    reread_bytes_ += it->second->text.size();
    it->second->format = CardFormat::standard;
    return it->second;
  }
  auto source = load(path);
  if (!source) return nullptr;
  distinct_bytes_ += source->text.size();
  sources_.emplace(path, source);
  return source;
}

void DeckReader::include(const std::string& name, const File& from, std::size_t line,
                         const Conversion& conversion, const char* keyword) {
  if (too_many_files_) return;  // said once; each file of a tree would say it again
  const DeckFile& parent = deck_.files[static_cast<std::size_t>(from.index)];
  std::shared_ptr<SourceText> source;
  const std::vector<std::string> paths = candidates(name, parent.name);
  auto found = paths.begin();
  while (found != paths.end() && !(source = load_once(*found))) ++found;
  if (!source) {
    diagnostics_.error(place(from, line), fmt::format("{}: cannot read '{}'", keyword, name),
                       name.find('&') == std::string::npos
                           ? fmt::format("looked for {}", fmt::join(paths, ", "))
                           : "only text parameters (C) that are defined above replace parts of a name");
    return;
  }
  if (!may_include(*found, place(from, line), keyword)) return;
  open_files_.push_back(identity(*found));
  read_file({.name = *found,
             .source = nullptr,
             .parent = from.index,
             .line = static_cast<int>(line) + 1,
             .conversion = parent.conversion.then(conversion)},
            std::move(source));
  open_files_.pop_back();
}

}  // namespace courant
