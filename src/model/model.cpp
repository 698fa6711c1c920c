#include "model/model.hpp"

#include <algorithm>
#include <iterator>

#include "model/mesh/solid_edges.hpp"

namespace courant {

Real Curve::operator()(Real a) const {
  if (abscissa.empty() || silent) return 0;
  const auto above = std::upper_bound(abscissa.begin(), abscissa.end(), a);
  if (above == abscissa.begin()) return ordinate.front();
  if (above == abscissa.end()) return ordinate.back();
  const auto i = static_cast<std::size_t>(above - abscissa.begin());
  const Real s = (a - abscissa[i - 1]) / (abscissa[i] - abscissa[i - 1]);
  return ordinate[i - 1] + s * (ordinate[i] - ordinate[i - 1]);
}

namespace {

/// The different ones of a solid's corners, in the order in which they come first; how many there are.
int collect_corners(const ModelSolid& solid, std::array<Index, 8>& out) {
  auto end = out.begin();
  for (auto n = solid.node.begin();
       n != solid.node.begin() + (solid.has_nodes_on_edges() ? solid.first_on_edge() : 8); ++n)
    if (*n >= 0 && std::find(out.begin(), end, *n) == end) *end++ = *n;
  return static_cast<int>(end - out.begin());
}

}  // namespace

std::array<Index, 8> ModelSolid::corners() const {
  std::array<Index, 8> out{}, different{};
  std::copy_n(node.begin(), out.size(), out.begin());
  if (collect_corners(*this, different) != 4) return out;
  const auto [a, b, c, d] = std::array{different[0], different[1], different[2], different[3]};
  return {a, b, c, c, d, d, d, d};
}

std::span<const SolidEdge> ModelSolid::edges_with_nodes() const {
  if (!has_nodes_on_edges()) return {};
  if (is_hexahedron_of_twenty()) return edges_of_hexahedron;
  return edges_of_tetrahedron;
}

std::array<Index, 20> ModelSolid::all_corners() const {
  if (has_nodes_on_edges()) return node;
  std::array<Index, 20> out{};
  out.fill(-1);
  const std::array<Index, 8> own = corners();
  std::copy(own.begin(), own.end(), out.begin());
  return out;
}

std::map<std::array<Index, 2>, Index> nodes_on_edges(const std::vector<ModelSolid>& solids) {
  std::map<std::array<Index, 2>, Index> out;
  for (const ModelSolid& solid : solids)
    for (std::size_t k = 0; k < solid.edges_with_nodes().size(); ++k) {
      const auto& [from, to] = solid.edges_with_nodes()[k];
      const auto [a, b] =
          std::minmax(solid.node[static_cast<std::size_t>(from)], solid.node[static_cast<std::size_t>(to)]);
      out[{a, b}] = solid.node[solid.first_on_edge() + k];
    }
  return out;
}

int ModelSolid::different_corners() const {
  std::array<Index, 8> different{};
  return collect_corners(*this, different);
}

Real ModelLayup::thickness() const {
  Real sum = 0;
  for (const ModelPly& ply : plies) sum += ply.thickness;
  return sum;
}

void Model::release_mesh() {
  std::vector<ModelNode>().swap(nodes);  // clear() would keep the memory
  std::vector<ModelSph>().swap(sph);
  std::vector<ModelShell>().swap(shells);
  std::vector<ModelSolid>().swap(solids);
  std::vector<ModelBeam>().swap(beams);
  std::vector<ModelSegment>().swap(segments);
  shell_thickness.clear();
  shell_beta.clear();
  shell_offset.clear();
  shell_layup.clear();
  held_rotations.clear();
  angular_velocity.clear();
  node_sets.clear();
  shell_sets.clear();
  solid_sets.clear();
  segment_sets.clear();
}

}  // namespace courant
