// docs/cannot_do.md: all that a deck may ask for and Courant has not, from the tables that refuse it.
#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "keyword/help/families.hpp"
#include "keyword/help/keyword_state.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

constexpr const char* cannot_do_introduction =
    "# What Courant cannot do\n\n"
    "Written by `courant keywords --cannot-do` from the tables by which the reader refuses decks; do not "
    "edit. What it can do: "
    "[keywords.md](keywords.md), where each keyword has its state.\n\n"
    "Nothing on this page is left out in silence: a deck that asks for it is refused with file, line and "
    "keyword, unless "
    "the page says that it gives a warning.\n\n"
    "At large: steps are explicit, without implicit or thermal analysis; one computer with threads that "
    "share memory, without MPI "
    "and without GPUs; results are VTK, HDF5 and, of LS-DYNA's, text files, binout and d3plot.\n";

using NamesByReason = std::map<std::string, std::vector<std::string>>;

std::string listed_names(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return fmt::format("`*{}`", fmt::join(names, "`, `*"));
}

std::string reasons_table(const NamesByReason& reasons, const char* heading) {
  std::string out = fmt::format("\n| {} | keywords |\n|---|---|\n", heading);
  for (const auto& [what, names] : reasons) out += fmt::format("| {} | {} |\n", what, listed_names(names));
  return out;
}

bool any_is_supported(const std::string& prefix) {
  for (const auto& spec : keyword_registry())
    for (const std::string& name : spec->names)
      if (spec->lacking.empty() && (name + "_").rfind(prefix + "_", 0) == 0) return true;
  return false;
}

/// Families of which nothing is supported, or with `some` those of which a part is.
NamesByReason families_by_reason(bool some) {
  NamesByReason out;
  for (const auto& [prefix, what] : refused_families())
    if (some == (what.rfind("this ", 0) == 0 || any_is_supported(prefix))) out[what].push_back(prefix);
  return out;
}

NamesByReason names_only_read() {
  NamesByReason out;
  for (const auto& spec : keyword_registry())
    if (!spec->lacking.empty()) out[spec->lacking].push_back(spec->names[0]);
  return out;
}

std::vector<const KeywordSpec*> supported_keywords() {
  std::vector<const KeywordSpec*> out;
  for (const auto& spec : keyword_registry())
    if (spec->lacking.empty()) out.push_back(spec.get());
  std::sort(out.begin(), out.end(), [](const auto* a, const auto* b) { return a->names < b->names; });
  return out;
}

std::string row_of_fields(const KeywordSpec& spec, const std::vector<std::string>& fields) {
  return fields.empty() ? std::string()
                        : fmt::format("| `*{}` | {} |\n", spec.names[0], fmt::join(fields, ", "));
}

}  // namespace

std::string cannot_do_markdown() {
  std::string out = cannot_do_introduction;
  out +=
      "\n## Physics and methods that are not there\n\n"
      "Keywords that begin with these words.\n";
  out += reasons_table(families_by_reason(false), "what");
  out += "\n## Of these only what keywords.md lists\n\nAny other keyword that begins so is refused.\n";
  out += reasons_table(families_by_reason(true), "refused as");
  out +=
      "\n## Keywords whose cards are read and then refused\n\n"
      "`courant check` counts their content.\n";
  out += reasons_table(names_only_read(), "lacking");
  std::string refused, limited, warned, idle;
  for (const KeywordSpec* spec : supported_keywords()) {
    const KeywordSupport support = support_of(*spec);
    refused += row_of_fields(*spec, support.refused), limited += row_of_fields(*spec, support.limited);
    if (support.state == KeywordState::no_effect)
      idle += fmt::format("| `*{}` | {} |\n", spec->names[0], spec->purpose);
    else
      warned += row_of_fields(*spec, support.warned);
  }
  const std::string fields = "\n| keyword | fields |\n|---|---|\n";
  out += "\n## Fields of which only the default is taken\n\nAnother value is refused.\n" + fields + refused;
  out += "\n## Fields that take some values only\n\nOthers are refused, where LS-DYNA has others.\n" +
         fields + limited;
  out += "\n## Fields that give a warning\n\nThey ask for output that is not written.\n" + fields + warned;
  out +=
      "\n## Keywords without effect\n\nThey cannot change results here.\n\n| keyword | why |\n|---|---|\n" +
      idle;
  out += fmt::format(
      "\n## Requests for output\n\nA keyword without a table that begins with one of these gives a warning, "
      "and the run goes on: {}.\n",
      listed_names(output_requests()));
  out += fmt::format(
      "\n## Definitions that nothing reads\n\nA keyword that begins with one of these gives a note: {}.\n",
      listed_names(keywords_without_effect()));
  return out;
}

}  // namespace courant
