#pragma once
// The reports of `courant verify`: a page for the browser and one for the documentation.
#include <filesystem>
#include <string>
#include <vector>

#include "verify/results.hpp"

namespace courant {

/// What differs from an earlier report, as sentences for the reader.
struct ReportChanges {
  struct Change {
    std::string text;
    bool worse = false;
  };
  std::string earlier{};  ///< what it is compared with: file, date, version; blank: no section of changes
  std::vector<Change> changes{};  ///< none: nothing has changed
};

/// Writes folder/report.html: one file with its charts and pictures inside, which loads nothing else and
/// needs no script. `folder` is made if need be. Throws OutputError; an earlier report is then as it was.
void write_reports(const SuiteResult& result, const std::filesystem::path& folder,
                   const ReportChanges& changes = {});

/// Writes the same as a Markdown page (GitHub's dialect) with its charts as SVG files and its pictures as PNG
/// files in `picture_folder`, named CASE-OBSERVATION-KIND, which the page refers to by relative paths. The
/// page is written last. Throws OutputError; the page is then as it was.
void write_page(const SuiteResult& result, const std::filesystem::path& markdown_file,
                const std::filesystem::path& picture_folder);

namespace report {

/// The text of report.html.
std::string html(const SuiteResult& result, const ReportChanges& changes = {});

/// "All 12 bounds are met." and the like, one sentence.
std::string verdict(const SuiteResult& result);

}  // namespace report
}  // namespace courant
