#include "app/verify.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "app/terminal.hpp"
#include "output/file.hpp"
#include "verify/compare.hpp"
#include "verify/report.hpp"
#include "verify/result_files.hpp"
#include "verify/result_table.hpp"
#include "verify/verify.hpp"

namespace courant {
namespace {

enum ExitCode { exit_ok = 0, exit_input = 1, exit_missed = 2, exit_other = 3 };

void print_error(const std::string& text) {
  std::fflush(stdout);
  std::fputs(text.c_str(), stderr);
}

std::filesystem::path own_executable() {
  std::error_code unknown;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", unknown);
  return unknown ? std::filesystem::path("/proc/self/exe") : path;
}

VerifyOptions options_of(const VerifyCall& call, const std::filesystem::path& folder,
                         const std::atomic<bool>& stop) {
  VerifyOptions options;
  options.folder = folder;
  options.executable = own_executable();
  options.jobs = call.jobs;
  options.fresh = call.fresh;
  options.only = call.only;
  options.stop = &stop;
  options.print = print_line;
  options.progress = status_line();
  return options;
}

/// Prints what changed; true if something that was met is now missed.
bool show_changes(const Comparison& comparison, const std::string& earlier, ReportChanges& changes) {
  changes.earlier = earlier;
  fmt::print("Against {} ({} rows in both):\n", earlier, comparison.compared);
  for (const Comparison::Line& line : comparison.lines) {
    fmt::print("  {}  {}\n", line.worse ? "WORSE" : "     ", line.text);
    changes.changes.push_back({line.text, line.worse});
  }
  if (comparison.lines.empty()) fmt::print("  nothing has changed\n");
  return comparison.regressed;
}

int show_and_write(const VerifyCall& call, const SuiteResult& result, const std::filesystem::path& folder) {
  for (const CaseResult& one : result.cases) fmt::print("\n{}", case_table(one));
  fmt::print("\n{}", checks_text(result));
  write_result_files(result, folder);
  ReportChanges changes;
  bool missed = !result.ok();
  if (!call.compare.empty()) {
    Diagnostics diagnostics;
    const auto comparison = compare_with(result, call.compare, diagnostics);
    print_error(diagnostics.text());
    if (!comparison) return exit_input;
    missed = show_changes(*comparison, call.compare, changes);
  }
  write_reports(result, folder, changes);
  if (!call.page.empty()) write_page(result, call.page, std::filesystem::path(call.page).replace_extension());
  fmt::print("results are in {}: report.html, results.csv, results.yaml\n", folder.string());
  return missed ? exit_missed : exit_ok;
}

}  // namespace

int call_verify(const VerifyCall& call, const std::atomic<bool>& stop) {
  const std::filesystem::path folder =
      call.dir.empty() ? std::filesystem::path(std::filesystem::path(call.suite).stem().string() + "_verify")
                       : std::filesystem::path(call.dir);
  Diagnostics diagnostics;
  const Suite suite = read_suite(call.suite, diagnostics);
  if (!call.compare.empty() && !std::filesystem::is_regular_file(call.compare))
    diagnostics.error({call.compare}, "cannot read the earlier results",
                      "give the results.csv of an earlier call");
  std::optional<VerifyOutcome> outcome;
  try {
    if (diagnostics.ok()) outcome = verify_suite(suite, options_of(call, folder, stop), diagnostics);
    clear_status_line();
    print_error(diagnostics.text());
    if (!outcome) {
      print_error(fmt::format("{} error{}; nothing was run\n", diagnostics.errors(),
                              diagnostics.errors() == 1 ? "" : "s"));
      return exit_input;
    }
    if (outcome->interrupted) {
      print_error("\ninterrupted; the runs that ended are kept: call again to go on\n");
      return exit_missed;
    }
    return show_and_write(call, outcome->result, folder);
  } catch (const OutputError& error) {
    print_error(fmt::format("error: {}\n", error.what()));
    return exit_other;
  }
}

}  // namespace courant
