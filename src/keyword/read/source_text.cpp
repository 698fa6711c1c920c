// From the bytes of a file to lines.
#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "keyword/source.hpp"

namespace courant {

namespace {

constexpr char nul = '\0';

std::string expand_tabs(const std::string& text) {
  constexpr std::size_t tab = 8;
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  std::size_t line_start = 0;
  for (const char c : text) {
    if (c == '\t') {
      out.append(tab - (out.size() - line_start) % tab, ' ');
    } else {
      out += c;
      if (c == '\n' || c == '\r') line_start = out.size();
    }
  }
  return out;
}

/// What a first look over all bytes shows, so that ordinary files need no second one.
struct Survey {
  std::size_t lines = 0;
  bool plain = true;  ///< no control characters but line feeds
};

Survey survey(std::string_view text) {
  // counts of one byte in short runs: compilers make of them instructions for 16 bytes or more at once
  Survey out;
  constexpr std::size_t run = 128;
  std::size_t controls = 0;
  for (std::size_t begin = 0; begin < text.size(); begin += run) {
    const std::string_view part = text.substr(begin, run);
    std::uint8_t feeds_here = 0, controls_here = 0;
    for (const char c : part) {
      feeds_here = static_cast<std::uint8_t>(feeds_here + (c == '\n'));
      controls_here = static_cast<std::uint8_t>(controls_here + (static_cast<unsigned char>(c) < 0x20));
    }
    out.lines += feeds_here;
    controls += controls_here;
  }
  out.plain = controls == out.lines;
  return out;
}

bool is_utf16(std::string_view text) {
  if (text.size() < 2) return false;
  const std::string_view mark = text.substr(0, 2);
  if (mark == "\xFF\xFE" || mark == "\xFE\xFF") return true;
  // without a byte order mark: every other byte of ASCII text is NUL
  return text.size() >= 4 && ((text[0] != nul && text[1] == nul && text[2] != nul && text[3] == nul) ||
                              (text[0] == nul && text[1] != nul && text[2] == nul && text[3] != nul));
}

SourceFault fault_at(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t feed = before.rfind('\n');
  const std::size_t line_start = feed == std::string_view::npos ? 0 : feed + 1;
  SourceFault out;
  out.line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
  out.column = static_cast<int>(at - line_start) + 1;
  return out;
}

/// Adds the fault if the bytes cannot be a deck at all.
bool is_binary(std::string_view text, std::vector<SourceFault>& faults) {
  if (is_utf16(text)) {
    faults.push_back({1, 0, "the file is UTF-16 text", "save it as UTF-8 or ASCII"});
    return true;
  }
  const std::size_t at = text.find(nul);
  if (at == std::string_view::npos) return false;
  SourceFault fault = fault_at(text, at);
  const auto count = std::count(text.begin(), text.end(), nul);
  fault.message = count == 1 ? std::string("the file holds a NUL byte")
                             : fmt::format("the file holds {} NUL bytes, the first here", count);
  fault.hint = "a deck is plain text; was the file damaged, or is it of another kind?";
  faults.push_back(std::move(fault));
  return true;
}

void add_line(SourceText& source, std::string_view line) {
  if (!line.empty()) {
    if (line[0] == '*') source.keyword_lines.push_back(source.lines.size());
    if (line[0] == '-' && line.rfind("-----BEGIN PGP", 0) == 0)
      source.encrypted_lines.push_back(source.lines.size());
  }
  source.lines.push_back(line);
}

/// A carriage return within a line ends it, as old Macintosh programs wrote it; those at its end belong to
/// its end, however many a faulty copy made of them.
void add_lines_with_returns(SourceText& source, std::string_view line) {
  while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  while (true) {
    const std::size_t end = line.find('\r');
    add_line(source, line.substr(0, end));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

}  // namespace

std::shared_ptr<SourceText> make_source(std::string text) {
  auto source = std::make_shared<SourceText>();
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);  // byte order mark of Windows editors
  const Survey seen = survey(text);
  if (!seen.plain || is_utf16(text)) {
    if (is_binary(text, source->faults)) return source;
    constexpr char end_of_file = 0x1A;  // of MS-DOS
    if (!text.empty() && text.back() == end_of_file) text.pop_back();
    if (text.find('\t') != std::string::npos) text = expand_tabs(text);
  }
  source->text = std::move(text);
  const std::string_view all = source->text;
  const bool returns = !seen.plain && all.find('\r') != std::string_view::npos;
  source->lines.reserve(seen.lines + 1);
  std::size_t begin = 0;
  while (begin < all.size()) {
    const std::size_t end = std::min(all.find('\n', begin), all.size());
    const std::string_view line = all.substr(begin, end - begin);
    if (returns)
      add_lines_with_returns(*source, line);
    else
      add_line(*source, line);
    begin = end + 1;
  }
  source->ends_within_line = !all.empty() && all.back() != '\n' && all.back() != '\r';
  return source;
}

std::shared_ptr<SourceText> load_source(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code fault;
  if (!fs::is_regular_file(path, fault)) return nullptr;
  const auto size = fs::file_size(path, fault);
  std::ifstream file(path, std::ios::binary);
  if (fault || !file) return nullptr;
  std::string text;
  const auto read_up_to = [&](std::uintmax_t bytes) {
    const std::size_t before = text.size();
    text.resize(static_cast<std::size_t>(bytes));
    file.read(text.data() + before, static_cast<std::streamsize>(text.size() - before));
    text.resize(before +
                static_cast<std::size_t>(file.gcount()));  // another program may shorten it meanwhile
  };
  // results of a run given by mistake may have many gigabytes: their beginning tells
  constexpr std::uintmax_t beginning = 1 << 16;
  read_up_to(std::min(size, beginning));
  if (size > beginning && !is_utf16(text) && text.find(nul) == std::string::npos) read_up_to(size);
  if (file.bad()) return nullptr;
  return make_source(std::move(text));
}

std::size_t SourceText::next_keyword(std::size_t first) const {
  const auto it = std::lower_bound(keyword_lines.begin(), keyword_lines.end(), first);
  return it == keyword_lines.end() ? lines.size() : *it;
}

}  // namespace courant
