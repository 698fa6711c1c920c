#include "extension/builders.hpp"

#include <algorithm>
#include <stdexcept>

namespace courant {

namespace {

bool waits_for(const WorldBuilder& late, const WorldBuilder& early) {
  if (&late == &early || late.phase != early.phase) return false;
  return std::any_of(late.reads.begin(), late.reads.end(), [&](const std::type_index& type) {
    return std::find(early.fills.begin(), early.fills.end(), type) != early.fills.end();
  });
}

}  // namespace

std::vector<WorldBuilder>& world_builders() {
  static std::vector<WorldBuilder> registry;
  return registry;
}

std::vector<const WorldBuilder*> in_order(const std::vector<WorldBuilder>& all) {
  std::vector<const WorldBuilder*> waiting, out;
  for (const WorldBuilder& builder : all) waiting.push_back(&builder);
  // files register in an order that the linker chooses
  std::sort(waiting.begin(), waiting.end(), [](const WorldBuilder* a, const WorldBuilder* b) {
    return a->phase != b->phase ? a->phase < b->phase : a->name < b->name;
  });
  while (!waiting.empty()) {
    const auto next = std::find_if(waiting.begin(), waiting.end(), [&](const WorldBuilder* late) {
      return late->phase == waiting.front()->phase &&
             std::none_of(waiting.begin(), waiting.end(),
                          [&](const WorldBuilder* early) { return waits_for(*late, *early); });
    });
    if (next == waiting.end()) {
      std::string names;
      for (const WorldBuilder* builder : waiting)
        if (builder->phase == waiting.front()->phase) names += (names.empty() ? "" : ", ") + builder->name;
      throw std::logic_error("builders wait for each other: " + names);
    }
    out.push_back(*next);
    waiting.erase(next);
  }
  return out;
}

void build(Assembly& assembly, BuildPhase from, BuildPhase to) {
  for (const WorldBuilder* builder : in_order(world_builders()))
    if (builder->phase >= from && builder->phase <= to)
      if (builder->goes_on || assembly.of<Diagnostics>().ok()) builder->run(assembly);
}

}  // namespace courant
