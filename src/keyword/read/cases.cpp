#include "keyword/read/cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "keyword/read/number.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

/// Calls of(line, number from 1) for each line, without its end.
template <class F>
void for_lines(std::string_view text, const F& of) {
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    of(text.substr(at, end - at), ++number);
    at = end + 1;
  }
}

/// What a keyword line says of cases.
struct CaseLine {
  enum class Kind { none, list, begin, end, wrong } kind = Kind::none;
  Id subcase = 0;
};
CaseLine case_line(std::string_view line) {
  if (line.size() < 5 || line[0] != '*') return {};
  const std::string word = upper_case(trimmed(line.substr(1)));
  const std::string name = word.substr(0, word.find_first_of(" \t"));
  if (name == "CASE" || name == "CASE_TITLE")
    return {name == "CASE" ? CaseLine::Kind::list : CaseLine::Kind::wrong};
  for (const auto& [begin, kind] : {std::pair{std::string_view("CASE_BEGIN_"), CaseLine::Kind::begin},
                                    {"CASE_END_", CaseLine::Kind::end}}) {
    if (name.rfind(begin, 0) != 0) continue;
    Id n = 0;
    const bool number = parse_integer(std::string_view(name).substr(begin.size()), n) && n > 0;
    return {number ? kind : CaseLine::Kind::wrong, n};
  }
  return {name.rfind("CASE", 0) == 0 ? CaseLine::Kind::wrong : CaseLine::Kind::none};
}

/// The fields of a line, by commas or columns of 10.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> out;
  if (line.find(',') != std::string_view::npos) {
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t end = std::min(line.find(',', at), line.size());
      out.emplace_back(trimmed(line.substr(at, end - at)));
      at = end + 1;
    }
    return out;
  }
  for (std::size_t at = 0; at < line.size(); at += 10) out.emplace_back(trimmed(line.substr(at, 10)));
  return out;
}
bool all_integers(const std::vector<std::string>& fields) {
  Id n = 0;
  bool some = false;
  for (const std::string& field : fields) {
    if (field.empty()) continue;
    if (!parse_integer(field, n)) return false;
    some = true;
  }
  return some;
}

/// COMMANDS that change no result: memory, and how many processors there are.
bool asks_for_machine_alone(std::string_view line) {
  const std::string text = upper_case(trimmed(line));
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" ,", at), text.size());
    const std::string word = text.substr(at, std::min(text.find('=', at), end) - at);
    if (!word.empty() && word != "MEMORY" && word != "MEMORY2" && word != "NCPU" && word != "PARA")
      return false;
    at = end + 1;
  }
  return true;
}

class CaseScan {
 public:
  CaseScan(std::string file, Diagnostics& diagnostics) : file_(std::move(file)), diagnostics_(diagnostics) {}

  void line(std::string_view line, int number) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (!line.empty() && line[0] == '$') return;
    const CaseLine found = case_line(line);
    if (!line.empty() && line[0] == '*') close();
    using Kind = CaseLine::Kind;
    if (found.kind == Kind::wrong)
      error(number, fmt::format("{} is not understood", trimmed(line)),
            "known are *CASE, *CASE_BEGIN_n, *CASE_END_n");
    else if (found.kind == Kind::list)
      reading_ = number;
    else if (found.kind == Kind::begin)
      open(found.subcase, number);
    else if (found.kind == Kind::end && open_.erase(found.subcase) == 0)
      error(number, fmt::format("*CASE_END_{0} without a *CASE_BEGIN_{0} before it", found.subcase));
    else if (found.kind == Kind::none && reading_ > 0 && (line.empty() || line[0] != '*'))
      lines_.emplace_back(line);
  }
  std::vector<LoadCase> finish() {
    close();
    for (const auto& [n, line] : open_) error(line, fmt::format("*CASE_END_{} is missing", n));
    if (cases_.empty())
      for (const Id n : order_) cases_.push_back({n, fmt::format("CASE{}", n), {n}});
    std::set<std::string> names;
    for (const LoadCase& one : cases_) {
      const int line = line_of_[one.id];
      for (const Id n : one.subcases)
        if (blocks_.count(n) == 0)
          diagnostics_.warning(
              {file_, line, 1},
              fmt::format("*CASE: SCID {0}: there is no *CASE_BEGIN_{0}, which adds nothing", n),
              "a case names the blocks that it has");
      if (!names.insert(one.job).second)
        error(line, fmt::format("JOBID: two cases are named '{}'", one.job), "each has a folder of its own");
    }
    return std::move(cases_);
  }

 private:
  void error(int line, std::string message, std::string hint = {}) {
    diagnostics_.error({file_, line, 1}, std::move(message), std::move(hint));
  }
  void open(Id n, int number) {
    if (!open_.emplace(n, number).second) error(number, fmt::format("*CASE_BEGIN_{} within itself", n));
    if (blocks_.insert(n).second) order_.push_back(n);
  }
  /// CASEID and JOBID; COMMANDS; SCIDs up to the next keyword.
  void close() {
    if (reading_ == 0) return;
    const int at = std::exchange(reading_, 0);
    std::vector<std::string> lines = std::move(lines_);
    lines_.clear();
    const std::vector<std::string> first = lines.empty() ? std::vector<std::string>{} : fields_of(lines[0]);
    LoadCase one;
    if (first.empty() || !parse_integer(first[0], one.id) || one.id <= 0)
      return error(at, "*CASE: card 1 has no CASEID", "an integer > 0 in columns 1-10, and JOBID behind it");
    const std::size_t comma = lines[0].find(',');
    one.job = comma == std::string::npos ? std::string(trimmed(std::string_view(lines[0]).substr(
                                               std::min<std::size_t>(10, lines[0].size()))))
              : first.size() > 1         ? first[1]
                                         : "";
    if (one.job.empty()) one.job = fmt::format("CASE{}", one.id);
    if (one.job.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+.") !=
            std::string::npos ||
        one.job[0] == '.')
      return error(at + 1, fmt::format("*CASE: JOBID '{}' is no name of a folder", one.job),
                   "letters, digits, _ - + .");
    std::size_t from = 1;
    if (lines.size() > 1 && !all_integers(fields_of(lines[1]))) {
      if (!asks_for_machine_alone(lines[1]))
        return error(at + 2, "*CASE: COMMANDS other than MEMORY, MEMORY2, NCPU, PARA are not supported",
                     "leave card 2 blank, and give options to the call");
      from = 2;
    }
    for (std::size_t k = from; k < lines.size(); ++k)
      for (const std::string& field : fields_of(lines[k])) {
        Id n = 0;
        if (field.empty()) continue;
        if (!parse_integer(field, n) || n <= 0)
          return error(at, fmt::format("*CASE: SCID '{}' is no integer > 0", field));
        one.subcases.insert(n);
      }
    if (line_of_.count(one.id) > 0) return error(at, fmt::format("*CASE: case {} is defined twice", one.id));
    line_of_[one.id] = at;
    cases_.push_back(std::move(one));
  }

  std::string file_;
  Diagnostics& diagnostics_;
  int reading_ = 0;  ///< line of the *CASE whose cards these are
  std::vector<std::string> lines_;
  std::vector<LoadCase> cases_;
  std::map<Id, int> line_of_;  ///< of cases
  std::map<Id, int> open_;     ///< blocks, and where they begin
  std::set<Id> blocks_;
  std::vector<Id> order_;
};

}  // namespace

std::vector<LoadCase> cases_in(const std::string& file, std::string_view text, Diagnostics& diagnostics) {
  CaseScan scan(file, diagnostics);
  for_lines(text, [&](std::string_view line, int number) { scan.line(line, number); });
  return scan.finish();
}

std::string text_of_case(std::string_view text, const std::set<Id>& subcases) {
  std::string out;
  out.reserve(text.size());
  std::set<Id> open;
  bool list = false;
  for_lines(text, [&](std::string_view line, int) {
    const CaseLine found = case_line(line);
    if (!line.empty() && line[0] == '*') list = found.kind == CaseLine::Kind::list;
    if (found.kind == CaseLine::Kind::begin) open.insert(found.subcase);
    if (found.kind == CaseLine::Kind::end) open.erase(found.subcase);
    const bool acts =
        open.empty() || std::any_of(open.begin(), open.end(), [&](Id n) { return subcases.count(n) > 0; });
    const bool of_cases = list || (found.kind != CaseLine::Kind::none && found.kind != CaseLine::Kind::wrong);
    if (acts && !of_cases)
      out += line;
    else
      out += "$";
    out += '\n';
  });
  if (!text.empty() && text.back() != '\n' && !out.empty()) out.pop_back();
  return out;
}

std::optional<std::string> text_of_file(const std::string& path) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

bool has_cases(std::string_view text) {
  constexpr std::string_view word = "*CASE";
  for (std::size_t at = 0; at + word.size() <= text.size(); ++at) {
    if ((at == 0 || text[at - 1] == '\n') && upper_case(text.substr(at, word.size())) == word) return true;
    at = text.find('\n', at);
    if (at == std::string_view::npos) return false;
  }
  return false;
}

}  // namespace courant
