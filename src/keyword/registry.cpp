#include "keyword/registry.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace courant {

namespace {

// inside a function, so that it exists whichever file's registrations run first
std::vector<std::shared_ptr<const KeywordSpec>>& mutable_registry() {
  static std::vector<std::shared_ptr<const KeywordSpec>> registry;
  return registry;
}

bool strip_suffix(std::string& name, const std::string& suffix) {
  if (name.size() <= suffix.size() || name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0)
    return false;
  name.resize(name.size() - suffix.size());
  return true;
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
  std::string base = name;
  bool title = false, id = false, mpp = false;
  while (true) {
    if (!title && strip_suffix(base, "_TITLE"))
      title = true;
    else if (!id && strip_suffix(base, "_ID"))
      id = true;
    else if (!mpp && strip_suffix(base, "_MPP"))
      mpp = true;
    else
      return {};
    const auto it = by_name_.find(base);
    if (it == by_name_.end()) continue;
    const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(it->second.keyword)];
    if ((title && !spec.title_option) || (id && !spec.id_option) || (mpp && !spec.mpp_option)) return {};
    KeywordMatch out = it->second;
    out.title = title;
    out.id = id;
    out.mpp = mpp;
    return out;
  }
}

}  // namespace courant
