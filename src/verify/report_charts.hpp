#pragma once
// What of a case is drawn, for the HTML report and the Markdown page alike.
#include <string>
#include <vector>

#include "verify/results.hpp"

namespace courant::report {

struct Figure {
  std::string stem;                 ///< part of a file's name, unique within the case
  std::string title;                ///< above the figure
  std::string svg;                  ///< empty: there is nothing to draw, the notes say why
  std::vector<std::string> notes;   ///< below it: what could not be drawn and why
  std::vector<std::string> advice;  ///< which run to choose, in sentences
};

/// Per observation: error against CPU time, then the curves of the first setting against the reference; last
/// the stability map. Never an empty list for a case with runs.
std::vector<Figure> figures(const CaseResult& result);

/// "formula sqrt(2 g h) (Ritter 1892)", "none"
std::string reference_text(const SuiteReference& reference);

/// Title of an observation, or its name.
std::string title_of(const SuiteObservation& observation);

}  // namespace courant::report
