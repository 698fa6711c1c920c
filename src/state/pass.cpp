#include "state/pass.hpp"

#include <algorithm>
#include <map>

#include "state/world.hpp"

namespace courant {

namespace {

/// Whether `second` must come behind `first` for one resource.
bool comes_behind(const Access& first, const Access& second) {
  if (!first.changes() && !second.changes()) return false;
  if (first.mode == second.mode) return false;
  return static_cast<int>(first.mode) < static_cast<int>(second.mode);
}

bool comes_behind(const Accesses& first, const Accesses& second) {
  for (const Access& a : first.all())
    for (const Access& b : second.all())
      if (a.what == b.what && comes_behind(a, b)) return true;
  return false;
}

}  // namespace

const FieldSet& BlockPass::over(const World& world) const {
  return world.particles.fields;
}

std::vector<BlockPass*> PassList::in_phase(Phase phase, const World& world) const {
  std::vector<BlockPass*> waiting, ordered;
  std::map<const BlockPass*, Accesses> declared;
  for (BlockPass* pass : all<BlockPass>())
    if (pass->phase() == phase) waiting.push_back(pass), pass->declare(world, declared[pass]);
  while (!waiting.empty()) {
    const auto free = std::find_if(waiting.begin(), waiting.end(), [&](const BlockPass* pass) {
      return std::none_of(waiting.begin(), waiting.end(), [&](const BlockPass* other) {
        return other != pass && comes_behind(declared[other], declared[pass]);
      });
    });
    if (free == waiting.end()) {
      std::string names;
      for (const BlockPass* pass : waiting) names += (names.empty() ? "" : ", ") + pass->name();
      throw std::logic_error("passes wait for each other in phase " + std::string(name_of(phase)) + ": " +
                             names);
    }
    ordered.push_back(*free);
    waiting.erase(free);
  }
  return ordered;
}

}  // namespace courant
