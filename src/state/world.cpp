#include "state/world.hpp"

#include <stdexcept>

namespace courant {

Index World::elements() const {
  Index count = 0;
  for (const auto& group : groups) count += group->size();
  return count;
}

FieldSet& World::add_set(const std::string& name) {
  for (const FieldSet* set : sets())
    if (set->name() == name) throw std::logic_error("there is an entity set '" + name + "' already");
  return *other_sets.emplace_back(std::make_unique<FieldSet>(name));
}

std::vector<FieldSet*> World::sets() {
  std::vector<FieldSet*> out{&particles.fields, &nodes.fields, &segments.fields};
  for (const auto& set : other_sets) out.push_back(set.get());
  return out;
}

std::vector<const FieldSet*> World::sets() const {
  std::vector<const FieldSet*> out{&particles.fields, &nodes.fields, &segments.fields};
  for (const auto& set : other_sets) out.push_back(set.get());
  return out;
}

}  // namespace courant
