// The Markdown page: what GitHub renders, with the charts as files beside it.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "output/file.hpp"
#include "verify/pareto.hpp"
#include "verify/report.hpp"
#include "verify/report_charts.hpp"
#include "verify/report_tables.hpp"
#include "verify/report_text.hpp"
#include "verify/svg_chart.hpp"

namespace courant {
namespace report {
namespace {

/// Where pictures go, and how the page names them.
struct Pictures {
  std::filesystem::path folder;
  std::string prefix;  ///< relative path from the page, with a slash at its end
  std::set<std::string> taken{};

  /// Writes a file with a name that no other one has. Returns what the page writes to show it.
  std::string add(const std::string& stem, const std::string& ending, std::string_view content,
                  const std::string& label) {
    std::string name = file_stem(stem);
    for (int n = 2; !taken.insert(name).second; ++n) name = file_stem(stem) + fmt::format("-{}", n);
    write_file(folder / (name + ending), content);
    return fmt::format("![{}](<{}{}{}>)", escape_markdown(label), prefix, name, ending);
  }
};

std::string table_markdown(const Table& table) {
  std::string out = "|", rule = "|";
  for (const Table::Column& c : table.columns) {
    out += " " + escape_markdown(c.head) + " |";
    rule += c.numeric ? "---:|" : "---|";
  }
  out += "\n" + rule + "\n";
  for (const Table::Row& row : table.rows) {
    out += "|";
    for (const std::string& cell : row.cells) {
      const std::string text = escape_markdown(cell);
      out += row.bad && !text.empty() ? " **" + text + "** |" : " " + text + " |";
    }
    out += "\n";
  }
  return out + "\n";
}

/// A long table is folded; what stands out in it is shown above.
std::string folded_markdown(const Table& table, std::string_view what) {
  if (table.rows.size() <= most_open_rows) return table_markdown(table);
  Table bad{table.columns, {}};
  std::copy_if(table.rows.begin(), table.rows.end(), std::back_inserter(bad.rows),
               [](const auto& r) { return r.bad; });
  return (bad.rows.empty() ? "" : table_markdown(bad)) +
         fmt::format("<details><summary>All {} {}</summary>\n\n{}</details>\n\n", table.rows.size(), what,
                     table_markdown(table));
}

std::string paragraphs_markdown(const std::string& text) {
  std::string out;
  for (const std::string& p : paragraphs(text)) out += escape_markdown(p) + "\n\n";
  return out;
}

std::string list_markdown(const std::vector<std::string>& items) {
  std::string out;
  for (const std::string& item : items) out += "- " + escape_markdown(item) + "\n";
  return items.empty() ? out : out + "\n";
}

std::string references_markdown(const SuiteCase& definition) {
  std::string out;
  for (const SuiteObservation& o : definition.observations) {
    if (o.reference.kind == SuiteReference::Kind::none) continue;
    out += "- " + escape_markdown(title_of(o) + ", reference: " + reference_text(o.reference)) + "\n";
  }
  return out.empty() ? out : out + "\n";
}

std::string case_markdown(const CaseResult& c, Pictures& pictures) {
  const std::string& title = c.definition.title.empty() ? c.definition.name : c.definition.title;
  std::string out = "## " + escape_markdown(title) + "\n\n" + paragraphs_markdown(c.definition.about) +
                    references_markdown(c.definition);
  if (c.runs.empty()) out += "**There is no run.**\n\n";
  if (const std::optional<std::size_t> cheapest = cheapest_within_bounds(c))
    out += fmt::format("Cheapest run within the bounds on all errors: **{}**, {} of CPU time.\n\n",
                       escape_markdown(run_name(c.runs[*cheapest])), seconds(c.runs[*cheapest].cpu_seconds));
  for (const Figure& figure : figures(c)) {
    out += "**" + escape_markdown(figure.title) + "**\n\n";
    if (!figure.svg.empty())
      out += pictures.add(c.definition.name + "-" + figure.stem, ".svg", standalone_svg(figure.svg),
                          figure.title) +
             "\n\n";
    if (!figure.advice.empty()) out += "Cheapest run (CPU time) for an error of\n\n";
    out += list_markdown(figure.advice) + list_markdown(figure.notes);
  }
  if (c.picture)
    out += "**" + escape_markdown(c.picture->title) + "**, colours from " + escape_markdown(c.picture->low) +
           " (dark) to " + escape_markdown(c.picture->high) + " (light)\n\n" +
           pictures.add(c.definition.name + "-picture", ".png", c.picture->png, c.picture->title) + "\n\n";
  if (!c.checks.empty()) out += folded_markdown(checks_table(c), "bounds");
  if (!c.runs.empty()) out += folded_markdown(runs_table(c), "runs");
  return out;
}

std::string head_markdown(const SuiteResult& result) {
  const std::string title =
      result.suite.title.empty() ? result.suite.file.stem().string() : result.suite.title;
  std::string out = "# " + escape_markdown(title) + "\n\n" + paragraphs_markdown(result.suite.about);
  out += "**" + verdict(result) + "**\n\n";
  for (const CaseResult& c : result.cases)
    for (const BoundCheck& check : c.checks)
      if (!check.met) out += "- " + escape_markdown(c.definition.title + ": " + check_text(check)) + "\n";
  if (!result.ok()) out += "\n";
  out += escape_markdown(fmt::format("Suite {}, version {}, on {}, {}; {}, {} at a time.",
                                     result.suite.file.filename().string(), result.version, result.machine,
                                     result.date, seconds(result.wall_seconds),
                                     result.jobs == 1 ? "one run" : fmt::format("{} runs", result.jobs)));
  return out + "\n\n" + table_markdown(overview_table(result));
}

}  // namespace
}  // namespace report

void write_page(const SuiteResult& result, const std::filesystem::path& markdown_file,
                const std::filesystem::path& picture_folder) {
  const std::filesystem::path page = std::filesystem::absolute(markdown_file).lexically_normal();
  make_folder(page.parent_path());
  make_folder(picture_folder);
  const std::filesystem::path there = std::filesystem::absolute(picture_folder).lexically_normal();
  const std::string relative = there.lexically_relative(page.parent_path()).generic_string();
  report::Pictures pictures{picture_folder, relative.empty() || relative == "."
                                                ? ""
                                                : relative + (relative.back() == '/' ? "" : "/")};
  std::string text = report::head_markdown(result);
  for (const CaseResult& c : result.cases) text += report::case_markdown(c, pictures);
  while (text.ends_with("\n\n")) text.pop_back();
  write_file(markdown_file, text);
}

}  // namespace courant
