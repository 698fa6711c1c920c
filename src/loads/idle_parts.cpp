#include "loads/idle_parts.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "model/cards.hpp"

namespace courant {

namespace {

bool has_points(const World& world, Index part) {
  const auto among = [&](const Field<Index>& of, Index size) {
    return std::find(of.data(), of.data() + size, part) != of.data() + size;
  };
  return among(world.nodes.part, world.nodes.size()) || among(world.particles.part, world.particles.size());
}

std::string why_idle(const ModelPart& part, const World& world, Index index) {
  if (part.has_shell || part.has_solid || part.has_beam)
    return fmt::format("part {} has no nodes of its own, all count to other parts", part.id);
  const bool springs = std::any_of(world.groups.begin(), world.groups.end(), [&](const auto& group) {
    return group->part == index && group->corners() > 1;
  });
  return springs ? fmt::format("part {} has springs and dampers alone, which have no mass", part.id)
                 : fmt::format("part {} has no elements", part.id);
}

}  // namespace

void warn_of_idle_parts(const Deck& deck, const Entry& card, const char* field,
                        const std::vector<Index>& parts, const Model& model, const World& world,
                        Diagnostics& diagnostics) {
  std::vector<Index> idle;
  std::copy_if(parts.begin(), parts.end(), std::back_inserter(idle),
               [&](Index part) { return !has_points(world, part); });
  if (idle.empty()) return;
  const Index first = idle.front();
  deck.warning(
      diagnostics, card, field,
      fmt::format("{}{}: nothing acts on it",
                  why_idle(model.parts[static_cast<std::size_t>(first)], world, first),
                  idle.size() > 1 ? fmt::format(", and {} more are alike", idle.size() - 1) : std::string()),
      "name parts with mass; what *ELEMENT_MASS gives to nodes counts to no part");
}

void check_gravity_of_parts(const Deck& deck, const Model& model, const World& world,
                            Diagnostics& diagnostics) {
  for (const LoadGravityPartCard& card : deck.all<LoadGravityPartCard>()) {
    std::vector<Index> parts;
    if (!card.of_sets()) {
      if (const auto part = model.part_of_id.find(card.pid); part != model.part_of_id.end())
        parts = {part->second};
    } else if (const auto set = model.part_sets.find(card.pid); set != model.part_sets.end()) {
      parts = set->second;
    }
    warn_of_idle_parts(deck, card, "PID", parts, model, world, diagnostics);
  }
}

}  // namespace courant
