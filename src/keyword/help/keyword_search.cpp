// `courant keywords NAME`.
#include <fmt/format.h>
#include <algorithm>

#include "keyword/help/families.hpp"
#include "keyword/help/keyword_state.hpp"
#include "keyword/registry.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

struct MatchingKeyword {
  std::string name;
  const KeywordSpec* spec = nullptr;
};

std::string listed(const std::vector<MatchingKeyword>& found) {
  std::string out;
  for (const MatchingKeyword& f : found)
    out += fmt::format("*{:<44} {:<10} {}\n", f.name, state_word(support_of(*f.spec).state), f.spec->purpose);
  return out;
}

/// Whether the words of `part` stand one behind the other in `name`.
bool has_words(const std::string& name, const std::string& part) {
  for (std::size_t at = name.find(part); at != std::string::npos; at = name.find(part, at + 1)) {
    const std::size_t end = at + part.size();
    if ((at == 0 || name[at - 1] == '_') && (end == name.size() || name[end] == '_')) return true;
  }
  return false;
}

std::vector<MatchingKeyword> names_with(const std::string& words, const KeywordSpec* but) {
  std::vector<MatchingKeyword> found;
  for (const auto& spec : keyword_registry())
    for (const std::string& name : spec->names)
      if (spec.get() != but && has_words(name, words)) found.push_back({name, spec.get()});
  std::sort(found.begin(), found.end(),
            [](const MatchingKeyword& a, const MatchingKeyword& b) { return a.name < b.name; });
  return found;
}

}  // namespace

KeywordAnswer find_keywords(const std::string& name) {
  std::string wanted = upper_case(trimmed(name));
  if (!wanted.empty() && wanted[0] == '*') wanted.erase(0, 1);
  while (!wanted.empty() && wanted.back() == '_') wanted.pop_back();
  if (wanted.empty()) return {true, keyword_list(), ""};
  const KeywordMatch match = KeywordIndex().match(wanted);
  const KeywordSpec* spec =
      match.keyword < 0 ? nullptr : keyword_registry()[static_cast<std::size_t>(match.keyword)].get();
  const std::vector<MatchingKeyword> others = names_with(wanted, spec);
  if (spec) {
    std::string text = keyword_help(wanted);
    if (!others.empty()) text += "\nOther keywords with this name in theirs:\n" + listed(others);
    return {true, text, ""};
  }
  if (!others.empty()) return {true, listed(others), ""};
  if (is_output_request(wanted))
    return {false,
            fmt::format("*{}: this request is not supported; decks with it run, with a warning", wanted), ""};
  const Refusal why = Families().refusal(wanted);
  return {false,
          why.lacking.empty() ? fmt::format("'{}' is not a supported keyword", name)
                              : fmt::format("*{}: {}", wanted, not_supported(why.lacking)),
          why.hint};
}

}  // namespace courant
