// Writes the reports of a made suite, for report.py: make_report FOLDER
#include <iostream>

#include "../unit/verify/made_suite.hpp"
#include "verify/report.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_report FOLDER\n";
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  const courant::SuiteResult result = courant::made::whole_suite();
  courant::write_reports(
      result, folder,
      {"an earlier report <of yesterday>", {{"wave is slower by 12 %", true}, {"strange is faster", false}}});
  courant::write_page(result, folder / "page.md", folder / "page");
  return 0;
}
