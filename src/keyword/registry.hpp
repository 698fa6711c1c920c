#pragma once
// The list of supported keywords. Files register theirs at start-up; nothing else is edited for a new one.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "keyword/card.hpp"
#include "keyword/deck.hpp"
#include "keyword/keyword_spec.hpp"

namespace courant {

/// All supported keywords. The order is that of registration; Entry::keyword is an index into it.
const std::vector<std::shared_ptr<const KeywordSpec>>& keyword_registry();
void register_keyword(std::shared_ptr<const KeywordSpec> spec);

/// Registers one keyword: `static const RegisterKeyword<T> name{{.names = {...}, ...}};` in a .cpp (see
/// card.hpp).
template <class T>
struct RegisterKeyword {
  explicit RegisterKeyword(KeywordOf<T> keyword) {
    register_keyword(make_keyword_spec<T>(std::move(keyword)));
  }
};

/// Cards of one keyword as text (`courant keywords NAME`), and the whole of docs/keywords.md.
std::string keyword_help(const std::string& name);  ///< empty if there is no such keyword
std::string keyword_list();
std::string keyword_markdown();

}  // namespace courant
