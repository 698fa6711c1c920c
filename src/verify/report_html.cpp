// report.html: plain elements, one style sheet, no script.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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

constexpr std::string_view page_style = R"(
:root{color-scheme:light dark;--page:#fff;--ink:#1c1f23;--soft:#5a626b;--line:#d5d9de;--panel:#f5f6f8;--link:#0060a8;
--good:#00695c;--good-panel:#e2f3ef;--bad:#b00020;--bad-panel:#fdeaed}
@media screen and (prefers-color-scheme:dark){:root{--page:#16191d;--ink:#e4e4e4;--soft:#a3abb4;--line:#3a4048;
--panel:#1f2429;--link:#7cc0ff;--good:#5fd0b5;--good-panel:#12302a;--bad:#ff8a94;--bad-panel:#3a1a1f}}
*{box-sizing:border-box}
body{margin:0 auto;padding:16px 24px 48px;max-width:1240px;background:var(--page);color:var(--ink);
font:16px/1.5 system-ui,-apple-system,"Segoe UI","Liberation Sans",Arial,sans-serif;overflow-wrap:anywhere}
h1{font-size:1.7em;line-height:1.2;margin:.4em 0}h2{font-size:1.35em;line-height:1.25;margin:2.2em 0 .4em;padding-top:.6em;border-top:2px solid var(--line)}
h3{font-size:1.05em;margin:1.4em 0 .4em}p{max-width:75ch;margin:.5em 0}a{color:var(--link)}
.verdict{padding:10px 14px;border-left:6px solid var(--good);background:var(--good-panel);font-weight:600;max-width:none}
.verdict.missed{border-color:var(--bad);background:var(--bad-panel)}
.badge{display:inline-block;font-size:.62em;font-weight:700;vertical-align:middle;padding:2px 9px;border-radius:10px;background:var(--good-panel);color:var(--good)}
.badge.missed{background:var(--bad);color:var(--page)}.badge.none{background:var(--panel);color:var(--soft)}
.bad{color:var(--bad);font-weight:600}
.facts{display:grid;grid-template-columns:max-content 1fr;gap:2px 14px;margin:1em 0;font-size:.93em}.facts dt{color:var(--soft)}.facts dd{margin:0}
.figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,360px),1fr));gap:20px;align-items:start}
figure{margin:0;min-width:0}figcaption{font-size:.93em}figcaption strong{display:block;margin-bottom:2px}
.figures figure{border:1px solid var(--line);border-radius:6px;padding:10px 12px}
.figures ul,.notes{margin:.4em 0;padding-left:1.2em;font-size:.93em}.notes{color:var(--soft)}
.scroll{overflow-x:auto;max-width:100%}.chart{display:block;width:100%;height:auto;max-width:560px}
.choose{font-size:.93em;font-weight:600;margin-top:.5em}.wide .chart{max-width:none}.figures figure:has(.wide){grid-column:1/-1}
.picture img{display:block;width:100%;max-width:560px;height:auto}
table{border-collapse:collapse;font-size:.87em;line-height:1.35;font-variant-numeric:tabular-nums;overflow-wrap:normal}
th,td{padding:4px 9px;border-bottom:1px solid var(--line);text-align:left;vertical-align:top;white-space:nowrap}
th{vertical-align:bottom;white-space:normal;background:var(--panel);min-width:5em}td.long{white-space:normal;min-width:16em}nav td:first-child{white-space:normal;min-width:9em}
.n{text-align:right}tr.bad td{background:var(--bad-panel);color:inherit;font-weight:400}tr.bad td.missed{font-weight:700}summary{cursor:pointer;margin:.4em 0}
@media (max-width:600px){body{padding:8px 12px 32px}.figures figure{border:0;padding:0}h1{font-size:1.4em}h2{font-size:1.2em}
.facts{grid-template-columns:1fr}.facts dd{margin:0 0 4px}}
@media print{body{max-width:none;padding:0;font-size:10.5pt}h2{break-after:avoid}figure,tr{break-inside:avoid}.scroll{overflow:visible}
table{font-size:7.5pt}th,td{white-space:normal;padding:2px 4px;min-width:0!important}a{color:inherit;text-decoration:none}
.verdict,.badge,th,tr.bad td,.chart{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)";

constexpr std::size_t long_cell = 44;  // longer texts are broken into lines

std::string table_html(const Table& table, const std::vector<std::string>& links = {}) {
  std::string out = R"(<div class="scroll" tabindex="0"><table><thead><tr>)";
  for (const Table::Column& c : table.columns)
    out += fmt::format("<th scope=\"col\"{}>{}</th>", c.numeric ? " class=\"n\"" : "", escape_xml(c.head));
  out += "</tr></thead><tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const Table::Row& row = table.rows[r];
    out += row.bad ? "<tr class=\"bad\">" : "<tr>";
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      const bool broken = length(row.cells[c]) > long_cell, stands_out = row.cells[c].starts_with("MISSED");
      const std::string_view css = table.columns[c].numeric ? " class=\"n\""
                                   : stands_out             ? " class=\"missed\""
                                   : broken                 ? " class=\"long\""
                                                            : "";
      std::string text = escape_xml(row.cells[c]);
      if (c == 0 && r < links.size()) text = fmt::format("<a href=\"#{}\">{}</a>", links[r], text);
      out += fmt::format("<td{}>{}</td>", css, text);
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string paragraphs_html(const std::string& text) {
  std::string out;
  for (const std::string& p : paragraphs(text)) out += "<p>" + escape_xml(p) + "</p>\n";
  return out;
}

std::string list_html(const std::vector<std::string>& items, std::string_view css) {
  if (items.empty()) return {};
  std::string out = css.empty() ? "<ul>" : fmt::format("<ul class=\"{}\">", css);
  for (const std::string& item : items) out += "<li>" + escape_xml(item) + "</li>";
  return out + "</ul>\n";
}

/// A map that is wider than charts keeps its letters readable: it scrolls in its box.
std::string drawing_html(const std::string& svg) {
  const std::string_view key = " width=\"";
  const std::size_t at = svg.find(key);
  const int width = at == std::string::npos ? chart_width : std::stoi(svg.substr(at + key.size(), 9));
  if (width <= chart_width) return svg;
  return fmt::format(
      "<div class=\"scroll\" tabindex=\"0\"><div class=\"wide\" style=\"width:{}px\">{}</div></div>",
      width * 9 / 10, svg);
}

std::string figure_html(const Figure& figure) {
  return "<figure><figcaption><strong>" + escape_xml(figure.title) + "</strong></figcaption>\n" +
         drawing_html(figure.svg) + "\n" +
         (figure.advice.empty() ? ""
                                : "<div class=\"choose\">Cheapest run (CPU time) for an error of</div>\n") +
         list_html(figure.advice, "") + list_html(figure.notes, "notes") + "</figure>\n";
}

std::string badge(const CaseResult& c) {
  if (c.checks.empty()) return R"(<span class="badge none">no bounds</span>)";
  const std::size_t bad = missed(c);
  if (bad > 0)
    return fmt::format(R"(<span class="badge missed">{} of {} missed</span>)", bad, c.checks.size());
  return fmt::format(R"(<span class="badge">{} of {} met</span>)", c.checks.size(), c.checks.size());
}

std::string observations_html(const SuiteCase& definition) {
  Table table{{{"observed"}, {"reference"}, {"norm"}, {"bound", true}, {"least order", true}}, {}};
  for (const SuiteObservation& o : definition.observations)
    table.rows.push_back({{title_of(o), reference_text(o.reference), o.norm, o.bound ? percent(*o.bound) : "",
                           o.least_order ? number(*o.least_order, 3) : ""},
                          false});
  return table.rows.empty() ? "" : "<h3>What is observed, and against what</h3>\n" + table_html(table);
}

std::string choice_html(const CaseResult& c) {
  const std::optional<std::size_t> cheapest = cheapest_within_bounds(c);
  if (!cheapest) return {};
  const RunResult& run = c.runs[*cheapest];
  return fmt::format(
      "<p>Cheapest run within the bounds on all errors: <strong>{}</strong>, {} of CPU time.</p>\n",
      escape_xml(run_name(run)), seconds(run.cpu_seconds));
}

std::string picture_html(const ReportPicture& picture) {
  const std::string title = escape_xml(picture.title);
  return fmt::format(
      "<figure class=\"picture\"><figcaption><strong>{0}</strong></figcaption><img alt=\"{0}\" "
      "src=\"data:image/png;base64,{1}\"><figcaption>Colours from {2} (dark) to {3} "
      "(light)</figcaption></figure>\n",
      title, base64(picture.png), escape_xml(picture.low), escape_xml(picture.high));
}

/// A long table is folded; what stands out in it is shown above.
std::string folded_html(const Table& table, std::string_view what) {
  if (table.rows.size() <= most_open_rows) return table_html(table);
  Table bad{table.columns, {}};
  std::copy_if(table.rows.begin(), table.rows.end(), std::back_inserter(bad.rows),
               [](const auto& r) { return r.bad; });
  return (bad.rows.empty() ? "" : table_html(bad)) +
         fmt::format("<details><summary>All {} {}</summary>\n{}</details>\n", table.rows.size(), what,
                     table_html(table));
}

std::string case_html(const CaseResult& c, const std::string& id) {
  const std::string& title = c.definition.title.empty() ? c.definition.name : c.definition.title;
  std::string out = fmt::format("<section id=\"{}\">\n<h2>{} {}</h2>\n", id, escape_xml(title), badge(c));
  out += paragraphs_html(c.definition.about) + observations_html(c.definition);
  out += "<h3>Results</h3>\n";
  if (c.runs.empty()) out += "<p class=\"bad\">There is no run.</p>\n";
  out += choice_html(c) + "<div class=\"figures\">\n";
  for (const Figure& figure : figures(c)) out += figure_html(figure);
  if (c.picture) out += picture_html(*c.picture);
  out += "</div>\n";
  if (!c.checks.empty()) out += "<h3>Bounds</h3>\n" + folded_html(checks_table(c), "bounds");
  if (!c.runs.empty()) out += "<h3>Runs</h3>\n" + folded_html(runs_table(c), "runs");
  return out + "</section>\n";
}

std::string verdict_html(const SuiteResult& result, const std::vector<std::string>& ids) {
  std::string out = fmt::format("<p class=\"verdict{}\" id=\"verdict\">{}</p>\n",
                                result.ok() ? "" : " missed", escape_xml(verdict(result)));
  if (result.ok()) return out;
  out += "<ul>\n";
  for (std::size_t i = 0; i < result.cases.size(); ++i)
    for (const BoundCheck& check : result.cases[i].checks)
      if (!check.met)
        out += fmt::format("<li><a href=\"#{}\">{}</a>: <span class=\"bad\">{}</span></li>\n", ids[i],
                           escape_xml(result.cases[i].definition.title), escape_xml(check_text(check)));
  return out + "</ul>\n";
}

std::string facts_html(const SuiteResult& result) {
  const auto fact = [](const std::string& name, const std::string& value) {
    return "<dt>" + name + "</dt><dd>" + escape_xml(value) + "</dd>";
  };
  return "<dl class=\"facts\">" + fact("Suite", result.suite.file.filename().string()) +
         fact("Courant", result.version) + fact("Machine", result.machine) + fact("Date", result.date) +
         fact("Time", fmt::format("{}, {} at a time", seconds(result.wall_seconds),
                                  result.jobs == 1 ? "one run" : fmt::format("{} runs", result.jobs))) +
         "</dl>\n";
}

std::string changes_html(const ReportChanges& changes) {
  if (changes.earlier.empty()) return {};
  std::string out = "<section id=\"changes\">\n<h2>Changes</h2>\n<p>Compared with " +
                    escape_xml(changes.earlier) + ".</p>\n";
  if (changes.changes.empty()) return out + "<p>Nothing has changed.</p></section>\n";
  out += "<ul>\n";
  for (const ReportChanges::Change& change : changes.changes)
    out += fmt::format("<li{}>{}{}</li>\n", change.worse ? " class=\"bad\"" : "",
                       change.worse ? "Worse: " : "", escape_xml(change.text));
  return out + "</ul></section>\n";
}

}  // namespace

std::string verdict(const SuiteResult& result) {
  std::size_t all = 0, bad = 0;
  for (const CaseResult& c : result.cases) all += c.checks.size(), bad += missed(c);
  if (all == 0) return "The suite states no bounds.";
  if (bad > 0) return fmt::format("{} of {} bounds {} missed.", bad, all, bad == 1 ? "is" : "are");
  return all == 1 ? "The one bound is met." : fmt::format("All {} bounds are met.", all);
}

std::string html(const SuiteResult& result, const ReportChanges& changes) {
  const std::string title =
      escape_xml(result.suite.title.empty() ? result.suite.file.stem().string() : result.suite.title);
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < result.cases.size(); ++i)
    ids.push_back(fmt::format("case-{}-{}", i + 1, file_stem(result.cases[i].definition.name)));
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" "
      "content=\"light dark\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>" +
      title + "</title>\n<style>";
  ((out += page_style) += chart_style()) += "</style>\n</head>\n<body>\n<h1>" + title + "</h1>\n";
  out += verdict_html(result, ids) + facts_html(result) + paragraphs_html(result.suite.about);
  if (!changes.earlier.empty()) out += "<p><a href=\"#changes\">Changes since the earlier report</a></p>\n";
  out += "<nav aria-label=\"Cases\">\n" + table_html(overview_table(result), ids) + "</nav>\n";
  out += changes_html(changes);
  for (std::size_t i = 0; i < result.cases.size(); ++i) out += case_html(result.cases[i], ids[i]);
  return out + "</body>\n</html>\n";
}

}  // namespace report

void write_reports(const SuiteResult& result, const std::filesystem::path& folder,
                   const ReportChanges& changes) {
  make_folder(folder);
  write_file(folder / "report.html", report::html(result, changes));
}

}  // namespace courant
