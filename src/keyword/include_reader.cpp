// *INCLUDE and its kin.
#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "keyword/deck_reader.hpp"

namespace courant {

namespace {

std::string identity(const std::string& path) {
  std::error_code fault;
  const auto full = std::filesystem::weakly_canonical(path, fault);
  return fault ? path : full.string();
}

}  // namespace

bool DeckReader::read_include_keyword(const File& file, std::size_t line, const KeywordLine& keyword) {
  if (keyword.name != "INCLUDE") return false;
  read_includes(file, line);
  return true;
}

void DeckReader::read_includes(const File& file, std::size_t line) {
  DataLines data(*file.source, line + 1);
  if (data.done() || data.only_blanks_left())
    diagnostics_.error(place(file, line), "*INCLUDE: the file name is missing");
  while (!data.done() && !cards_.full()) {
    const std::size_t at = data.index();
    const std::string name = parameters_.with_texts(read_file_name(data));
    if (!name.empty()) include(name, file, at, {});
  }
}

/// A name may go on in the next line, behind " +".
std::string DeckReader::read_file_name(DataLines& data) const {
  std::string name;
  for (bool more = true; more && !data.done(); data.step()) {
    std::string_view part = trimmed(data.line());
    more = part.size() >= 2 && part.substr(part.size() - 2) == " +";
    if (more) part.remove_suffix(2);
    name += trimmed(part);
  }
  return name;
}

void DeckReader::include(const std::string& name, const File& from, std::size_t line,
                         const Conversion& conversion) {
  namespace fs = std::filesystem;
  const DeckFile& parent = deck_.files[static_cast<std::size_t>(from.index)];
  std::string path = (fs::path(parent.name).parent_path() / name).lexically_normal().string();
  auto source = load(path);
  if (!source) {
    path = name;
    source = load(path);
  }
  if (!source) {
    diagnostics_.error(place(from, line), fmt::format("*INCLUDE: cannot read '{}'", name),
                       name.find('&') == std::string::npos
                           ? "looked beside the including file and in the working directory"
                           : "only text parameters (C) that are defined above stand for parts of a name");
    return;
  }
  const std::string id = identity(path);
  if (id == identity(deck_.files[0].name) ||
      std::find(open_files_.begin(), open_files_.end(), id) != open_files_.end()) {
    diagnostics_.error(place(from, line), fmt::format("*INCLUDE: '{}' includes itself", name));
    return;
  }
  open_files_.push_back(id);
  read_file({.name = path,
             .source = nullptr,
             .parent = from.index,
             .line = static_cast<int>(line) + 1,
             .conversion = parent.conversion.then(conversion)},
            std::move(source));
  open_files_.pop_back();
}

}  // namespace courant
