#include "keyword/registry.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numeric>

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

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
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
  bool title = false, id = false, mpp = false, collect = false;
  while (true) {
    if (!title && strip_suffix(base, "_TITLE"))
      title = true;
    else if (!id && strip_suffix(base, "_ID"))
      id = true;
    else if (!mpp && strip_suffix(base, "_MPP"))
      mpp = true;
    else if (!collect && strip_suffix(base, "_COLLECT"))
      collect = true;
    else
      return {};
    const auto it = by_name_.find(base);
    if (it == by_name_.end()) continue;
    const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(it->second.keyword)];
    if ((title && !spec.title_option) || (id && !spec.id_option) || (mpp && !spec.mpp_option) ||
        (collect && !spec.collect_option))
      return {};
    KeywordMatch out = it->second;
    out.title = title;
    out.id = id;
    out.mpp = mpp;
    out.collect = collect;
    return out;
  }
}

std::string KeywordIndex::hint(const std::string& name) const {
  std::string base;  // longest known name that `name` continues with an option
  std::vector<std::string> names;
  for (const auto& [known, match] : by_name_) {
    names.push_back(known);
    if (name.size() > known.size() && name.compare(0, known.size(), known) == 0 &&
        name[known.size()] == '_' && known.size() > base.size())
      base = known;
  }
  std::sort(names.begin(), names.end());
  const std::string near = nearest_word(name, names);
  if (!near.empty() && edit_distance(name, near) <= 2) return fmt::format("did you mean *{}?", near);
  if (!base.empty())
    return fmt::format("*{} is supported, its option {} is not", base, name.substr(base.size()));
  if (!near.empty()) return fmt::format("did you mean *{}?", near);
  return {};
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace courant
