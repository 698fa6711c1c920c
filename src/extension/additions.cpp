#include "extension/additions.hpp"

#include "extension/part_values.hpp"

namespace courant {

RegisterAddition::RegisterAddition(std::string name, Build build, FindNodes nodes) {
  if (nodes)
    world_builders().push_back({BuildPhase::nodes,
                                name,
                                true,
                                {typeid(MoreNodes), typeid(Movers)},
                                {},
                                [nodes = std::move(nodes)](Assembly& all) {
                                  const std::vector<Index> found = nodes(all.of<Deck>(), all.of<Model>());
                                  std::vector<Index>& more = all.of<MoreNodes>().nodes;
                                  more.insert(more.end(), found.begin(), found.end());
                                  all.of<Movers>().any |= !found.empty();
                                }});
  world_builders().push_back({BuildPhase::body_passes,
                              std::move(name),
                              true,
                              {typeid(Additions)},
                              {typeid(BodyPasses)},
                              [build = std::move(build)](Assembly& all) {
                                build(all.of<Deck>(), all.of<Model>(), all.of<World>(),
                                      all.of<Diagnostics>());
                              }});
}

std::vector<AsciiHistory>& ascii_histories() {
  static std::vector<AsciiHistory> registry;
  return registry;
}

}  // namespace courant
