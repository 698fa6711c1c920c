#pragma once
// The list of supported keywords. Files register theirs at start-up; nothing else is edited for a new one.
#include <concepts>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/nearest_word.hpp"
#include "keyword/card.hpp"
#include "keyword/deck.hpp"
#include "keyword/help/law_names.hpp"
#include "keyword/keyword_spec.hpp"

namespace courant {

/// All supported keywords. The order is that of registration; Entry::keyword is an index into it.
const std::vector<std::shared_ptr<const KeywordSpec>>& keyword_registry();
void register_keyword(std::shared_ptr<const KeywordSpec> spec);

/// Registers one keyword: `static const RegisterKeyword<T> name{{.names = {...}, ...}};` in a .cpp (see
/// card.hpp).
template <class T>
struct RegisterKeyword {
  explicit RegisterKeyword(KeywordOf<T> keyword) : RegisterKeyword(table_of(std::move(keyword))) {}
  template <std::same_as<KeywordTable> Made>
  explicit RegisterKeyword(Made table) {
    add_law_names(table.names);
    register_keyword(make_keyword_spec<T>(std::move(table)));
  }
};

/// Result of a look-up of a keyword line: the keyword in the registry, its name, and the options _TITLE, _ID,
/// _MPP and _COLLECT.
struct KeywordMatch {
  int keyword = -1;  ///< index into the registry, -1: unknown
  int name = 0;
  bool title = false, id = false, mpp = false, collect = false;
};

/// Look-up by name, for the keywords registered at its construction.
class KeywordIndex {
 public:
  KeywordIndex();
  KeywordMatch match(const std::string& name) const;  ///< `name` in upper case, without '*'

 private:
  std::unordered_map<std::string, KeywordMatch> by_name_;
};

/// "*PART card 1 field 2 (SECID, section id [-])", the beginning of every message about a field.
std::string describe_field(const KeywordSpec& spec, int name, std::size_t card, std::size_t field);

/// Cards of one keyword as text, and all of docs/keywords.md.
std::string keyword_help(const std::string& name);  ///< empty if there is no such keyword
std::string keyword_list();
/// Output of `courant keywords NAME`: the cards of that keyword, and the names that start with or contain it;
/// for names without a table the reason of the refusal, with `found` false.
struct KeywordAnswer {
  bool found = false;
  std::string text, hint;
};
KeywordAnswer find_keywords(const std::string& name);
std::string keyword_markdown();

}  // namespace courant
