#include "keyword/registry.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

namespace courant {

namespace {

// inside a function, so that it exists whichever file's registrations run first
std::vector<std::shared_ptr<const KeywordSpec>>& mutable_registry() {
  static std::vector<std::shared_ptr<const KeywordSpec>> registry;
  return registry;
}

/// Takes one of _TITLE, _ID, _MPP and _COLLECT out of a name, the last that is there; each only once.
bool take_option(std::string& name, KeywordMatch& options) {
  for (std::size_t end = name.size(); end != std::string::npos && end > 0;) {
    const std::size_t begin = name.rfind('_', end - 1);
    if (begin == std::string::npos) return false;
    const std::string_view word(name.data() + begin, end - begin);
    bool* option = word == "_TITLE"     ? &options.title
                   : word == "_ID"      ? &options.id
                   : word == "_MPP"     ? &options.mpp
                   : word == "_COLLECT" ? &options.collect
                                        : nullptr;
    if (option && !*option) {
      *option = true;
      name.erase(begin, end - begin);
      return true;
    }
    end = begin;
  }
  return false;
}

}  // namespace

const std::vector<std::shared_ptr<const KeywordSpec>>& keyword_registry() {
  return mutable_registry();
}

void register_keyword(std::shared_ptr<const KeywordSpec> spec) {
  mutable_registry().push_back(std::move(spec));
}

KeywordIndex::KeywordIndex() {
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k)
    for (std::size_t n = 0; n < registry[k]->names.size(); ++n)
      by_name_.emplace(registry[k]->names[n],
                       KeywordMatch{.keyword = static_cast<int>(k), .name = static_cast<int>(n)});
}

KeywordMatch KeywordIndex::match(const std::string& name) const {
  if (const auto it = by_name_.find(name); it != by_name_.end()) return it->second;
  // the options in any order: at the end, as the manual has them, or, as some programs write them, before
  // others
  std::string base = name;
  KeywordMatch options;
  while (take_option(base, options)) {
    const auto it = by_name_.find(base);
    if (it == by_name_.end()) continue;
    const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(it->second.keyword)];
    // older decks write _TITLE where others write _ID: the same line of id and heading
    if (options.title && !spec.title_option && spec.id_option && !options.id)
      std::swap(options.title, options.id);
    if ((options.title && !spec.title_option) || (options.id && !spec.id_option) ||
        (options.mpp && !spec.mpp_option) || (options.collect && !spec.collect_option))
      return {};
    options.keyword = it->second.keyword;
    options.name = it->second.name;
    return options;
  }
  return {};
}

}  // namespace courant
