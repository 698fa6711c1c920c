#include "contact/tied/not_exact.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Whether no solid and no shell, which mass scaling may make heavier, has one of the nodes.
bool of_beams(const std::vector<Tie>& ties, const Model& model, const World& world) {
  return std::all_of(ties.begin(), ties.end(), [&](const Tie& tie) {
    const Index part = world.nodes.part[tie.node];
    return part >= 0 && model.parts[static_cast<std::size_t>(part)].has_beam;
  });
}

}  // namespace

std::optional<WhyNotExact> why_not_exact(const ContactCard& c, const std::vector<Tie>& ties,
                                         const std::set<Index>& tied, const std::set<Index>& corners,
                                         const Model& model, const TiedOptions& options, const World& world) {
  const char* const springs = "use the contact with _OFFSET, where that is meant";
  const char* const exchange = "exchange SURFA and SURFB of one of the contacts, or use it with _OFFSET";
  std::set<Index> eroding;
  for (const auto& group : world.groups)
    if (shared_fields::eroded.find(group->fields)) eroding.insert(group->part);
  if (options.mass_grows && !of_beams(ties, model, world))
    return WhyNotExact{
        "", "nodes that are tied exactly get no mass from mass scaling (DT2MS) once the run goes on",
        "give MS1ST 1, or use the contact with _OFFSET"};
  for (const Tie& tie : ties) {
    const Id id = world.nodes.id[tie.node];
    const auto part = world.segments.part[tie.segment];
    if (options.bodies.body(tie.node) >= 0)
      return WhyNotExact{
          "SURFA", fmt::format("node {} belongs to a rigid body, which cannot be tied exactly", id), springs};
    if (!can_be_released(tie, world)) {
      if (c.dt < model.endtim)
        return WhyNotExact{
            "DT", fmt::format("node {} is tied to a rigid body, from which it could not be freed", id),
            springs};
      if (eroding.contains(part))
        return WhyNotExact{
            "SURFB",
            fmt::format("the elements of part {} may fail, and a rigid body has some of their nodes",
                        model.parts[static_cast<std::size_t>(part)].id),
            springs};
    }
    if (corners.contains(tie.node))
      return WhyNotExact{"SURFA", fmt::format("node {} is a corner of a face to which others are tied", id),
                         exchange};
    const auto n = std::find_if(tie.at.node.begin(), tie.at.node.end(),
                                [&](Index corner) { return tied.contains(corner); });
    if (n != tie.at.node.end())
      return WhyNotExact{
          "SURFB",
          fmt::format("node {}, a corner of the face next to node {}, is tied by an earlier contact",
                      world.nodes.id[*n], id),
          exchange};
  }
  return std::nullopt;
}

}  // namespace courant
