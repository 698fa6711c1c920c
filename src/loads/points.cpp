#include <unordered_map>

#include "loads/loads.hpp"

namespace courant {

std::vector<Index> model_nodes(const Model& model, const World& world, const Points& points) {
  std::vector<Index> out(static_cast<std::size_t>(points.set->size()), -1);
  if (points.set == &world.particles.fields) {
    for (std::size_t i = 0; i < out.size() && i < model.sph.size(); ++i) out[i] = model.sph[i].node;
    return out;
  }
  std::unordered_map<Id, std::size_t> point_of_id;
  for (std::size_t i = 0; i < out.size(); ++i) point_of_id[(*points.id)[static_cast<Index>(i)]] = i;
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    if (const auto found = point_of_id.find(model.nodes[n].id); found != point_of_id.end())
      out[found->second] = static_cast<Index>(n);
  return out;
}

}  // namespace courant
