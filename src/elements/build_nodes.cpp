#include "elements/build_nodes.hpp"

namespace courant {

std::vector<Index> build_nodes(const Model& model, const std::vector<Index>& more, World& world) {
  std::vector<Index> node_of(model.nodes.size(), -1), part(model.nodes.size(), 0);
  const auto use = [&](Index node, Index of_part) {
    if (node < 0 || node_of[node] == 0) return;
    node_of[node] = 0, part[node] = of_part;
  };
  const auto of_shells = [&](bool null) {
    for (const ModelShell& shell : model.shells)
      if (model.parts[shell.part].null == null)
        for (const Index n : shell.node) use(n, shell.part);
  };
  of_shells(false);
  for (const ModelSolid& solid : model.solids)
    for (const Index n : solid.node) use(n, solid.part);
  for (const ModelBeam& beam : model.beams)
    for (const Index n : beam.node) use(n, beam.part);
  of_shells(true);  // a coat leaves nodes to what it covers
  std::vector<char> particle(more.empty() ? 0 : model.nodes.size(), 0);
  if (!more.empty())
    for (const ModelSph& s : model.sph) particle[s.node] = 1;
  for (const Index n : more)
    if (!particle[n]) use(n, -1);
  Index count = 0;
  for (Index& n : node_of)
    if (n == 0) n = count++;
  Nodes& nodes = world.nodes;
  nodes.fields.resize(count);
  for (std::size_t k = 0; k < node_of.size(); ++k) {
    const Index n = node_of[k];
    if (n < 0) continue;
    nodes.x.set(n, model.nodes[k].x);
    nodes.v.set(n, model.nodes[k].v);
    nodes.id[n] = model.nodes[k].id;
    nodes.part[n] = part[k];
  }
  return node_of;
}

}  // namespace courant
