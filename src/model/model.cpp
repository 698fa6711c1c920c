#include "model/model.hpp"

#include <algorithm>

namespace courant {

Real Curve::operator()(Real a) const {
  if (abscissa.empty()) return 0;
  const auto above = std::upper_bound(abscissa.begin(), abscissa.end(), a);
  if (above == abscissa.begin()) return ordinate.front();
  if (above == abscissa.end()) return ordinate.back();
  const auto i = static_cast<std::size_t>(above - abscissa.begin());
  const Real s = (a - abscissa[i - 1]) / (abscissa[i] - abscissa[i - 1]);
  return ordinate[i - 1] + s * (ordinate[i] - ordinate[i - 1]);
}

void Model::release_mesh() {
  std::vector<ModelNode>().swap(nodes);  // clear() would keep the memory
  std::vector<ModelSph>().swap(sph);
  std::vector<ModelSolid>().swap(solids);
  std::vector<ModelSegment>().swap(segments);
  shell_thickness.clear();
  held_rotations.clear();
  angular_velocity.clear();
  node_sets.clear();
  shell_sets.clear();
  solid_sets.clear();
  segment_sets.clear();
}

}  // namespace courant
