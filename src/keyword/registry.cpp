#include "keyword/registry.hpp"

namespace courant {

namespace {

// inside a function, so that it exists whichever file's registrations run first
std::vector<std::shared_ptr<const KeywordSpec>>& mutable_registry() {
  static std::vector<std::shared_ptr<const KeywordSpec>> registry;
  return registry;
}

}  // namespace

const std::vector<std::shared_ptr<const KeywordSpec>>& keyword_registry() {
  return mutable_registry();
}

void register_keyword(std::shared_ptr<const KeywordSpec> spec) {
  mutable_registry().push_back(std::move(spec));
}

}  // namespace courant
