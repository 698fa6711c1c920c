#include "model/model.hpp"

#include <algorithm>

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

/// The different nodes of a solid's first eight, in the order of their first places; how many there are.
int different_nodes(const ModelSolid& solid, std::array<Index, 8>& out) {
  auto end = out.begin();
  for (auto n = solid.node.begin(); n != solid.node.begin() + 8; ++n)
    if (*n >= 0 && std::find(out.begin(), end, *n) == end) *end++ = *n;
  return static_cast<int>(end - out.begin());
}

}  // namespace

std::array<Index, 8> ModelSolid::corners() const {
  std::array<Index, 8> out{}, different{};
  std::copy_n(node.begin(), out.size(), out.begin());
  if (different_nodes(*this, different) != 4) return out;
  const auto [a, b, c, d] = std::array{different[0], different[1], different[2], different[3]};
  return {a, b, c, c, d, d, d, d};
}

int ModelSolid::different_corners() const {
  std::array<Index, 8> different{};
  return different_nodes(*this, different);
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
