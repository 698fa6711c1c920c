#include "verify/reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "base/nearest_word.hpp"

namespace courant {
namespace {

std::string trimmed(std::string_view text) {
  const auto blank = " \t\r\"";
  const std::size_t begin = text.find_first_not_of(blank);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(blank) - begin + 1));
}

std::vector<std::string> cells_of(const std::string& line, bool commas) {
  std::vector<std::string> cells;
  for (std::size_t at = 0; at <= line.size();) {
    if (!commas) at = std::min(line.find_first_not_of(" \t\r", at), line.size());
    if (!commas && at == line.size()) break;
    const std::size_t end =
        std::min(commas ? line.find(',', at) : line.find_first_of(" \t\r", at), line.size());
    cells.push_back(trimmed(std::string_view(line).substr(at, end - at)));
    at = end + 1;
  }
  return cells;
}

std::optional<Real> number_in(const std::string& cell) {
  Real value = 0;
  const char* begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
  const auto [stop, code] = std::from_chars(begin, cell.data() + cell.size(), value);
  if (code != std::errc{} || stop != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

class TableReader {
 public:
  TableReader(const std::filesystem::path& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  ReferenceTable read(const std::string& column_x, const std::string& column_y) {
    std::ifstream stream(file_);
    if (!stream) {
      diagnostics_.error({file_.string()}, "cannot read the table",
                         "check the path; it counts from the suite");
      return {};
    }
    std::string line;
    bool first = true;
    for (line_ = 1; std::getline(stream, line); ++line_) {
      const std::string text = trimmed(line);
      if (text.empty() || text[0] == '#') continue;
      if (first) commas_ = line.find(',') != std::string::npos;
      const std::vector<std::string> cells = cells_of(line, commas_);
      if (std::exchange(first, false)) {
        const auto is_text = [](const std::string& cell) { return !cell.empty() && !number_in(cell); };
        const bool head = std::any_of(cells.begin(), cells.end(), is_text);
        if (head) names_ = cells;
        const auto x = column(column_x, cells.size()), y = column(column_y, cells.size());
        if (!x || !y) return {};
        x_ = *x, y_ = *y;
        // a first row may be values beside a column of text: then the wanted ones are numbers, and not asked
        // for by name
        const bool values =
            number_in(cells[x_]) && number_in(cells[y_]) && cells[x_] != column_x && cells[y_] != column_y;
        if (head && !values) continue;
      }
      add_row(cells);
    }
    if (rows_.size() < 2 && diagnostics_.ok())
      diagnostics_.error({file_.string()}, "the table has fewer than two rows with both columns");
    ReferenceTable out;
    for (const auto& [x, sum] : rows_) {
      out.x.push_back(x);
      out.y.push_back(sum.first / sum.second);
    }
    return out;
  }

 private:
  std::optional<std::size_t> column(const std::string& wanted, std::size_t count) {
    const auto named = std::find(names_.begin(), names_.end(), wanted);
    if (named != names_.end()) return static_cast<std::size_t>(named - names_.begin());
    const auto number = number_in(wanted);
    if (number && *number >= 1 && *number <= static_cast<Real>(count) && *number == std::floor(*number))
      return static_cast<std::size_t>(*number) - 1;
    const std::string near = nearest_word(wanted, names_);
    diagnostics_.error(
        {file_.string(), line_}, fmt::format("the table has no column '{}'", wanted),
        names_.empty()
            ? fmt::format("its {} columns have no names; give a number from 1", count)
            : fmt::format("{}its columns: {}", near.empty() ? "" : fmt::format("did you mean {}? ", near),
                          fmt::join(names_, ", ")));
    return std::nullopt;
  }

  void add_row(const std::vector<std::string>& cells) {
    Real values[2] = {0, 0};
    const std::size_t columns[2] = {x_, y_};
    for (int k = 0; k < 2; ++k) {
      const std::string cell = columns[k] < cells.size() ? cells[columns[k]] : std::string();
      if (cell.empty()) return;
      const auto value = number_in(cell);
      if (!value) {
        diagnostics_.error({file_.string(), line_}, fmt::format("expected a number, got '{}'", cell));
        return;
      }
      values[k] = *value;
    }
    auto& [sum, count] = rows_[values[0]];
    sum += values[1];
    count += 1;
  }

  std::filesystem::path file_;
  Diagnostics& diagnostics_;
  std::vector<std::string> names_;
  std::map<Real, std::pair<Real, Real>> rows_;  // by x: sum of y, rows
  std::size_t x_ = 0, y_ = 0;
  bool commas_ = true;
  int line_ = 0;
};

}  // namespace

ReferenceTable read_table(const std::filesystem::path& file, const std::string& column_x,
                          const std::string& column_y, Diagnostics& diagnostics) {
  return TableReader(file, diagnostics).read(column_x, column_y);
}

}  // namespace courant
