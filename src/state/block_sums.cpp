#include "state/block_sums.hpp"

#include <algorithm>

namespace courant {

BlockSums::BlockSums(const Field<Index>& node, Index elements, const std::string& set)
    : force({.name = "force_of_blocks", .dimension = "ML/T2", .components = 3, .restart = false}, set),
      moment({.name = "moment_of_blocks", .dimension = "ML2/T2", .components = 3, .restart = false}, set),
      first_{0},
      place_(static_cast<std::size_t>(node.info().components)) {
  for (auto& of_corner : place_) of_corner.resize(static_cast<std::size_t>(elements));
  std::vector<Index> own;
  for (Index begin = 0; begin < elements; begin += block_size) {
    const Index end = std::min(begin + block_size, elements);
    own.clear();
    for (int c = 0; c < node.info().components; ++c)
      own.insert(own.end(), node.data(c) + begin, node.data(c) + end);
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (std::size_t c = 0; c < place_.size(); ++c)
      for (Index e = begin; e < end; ++e)
        place_[c][static_cast<std::size_t>(e)] = static_cast<std::uint16_t>(
            std::lower_bound(own.begin(), own.end(), node.data(static_cast<int>(c))[e]) - own.begin());
    nodes_.insert(nodes_.end(), own.begin(), own.end());
    first_.push_back(static_cast<Index>(nodes_.size()));
  }
  nodes_.shrink_to_fit();
  force.resize(first_.back()), moment.resize(first_.back());
}

void BlockSums::set(Field<Real>& sums, Index begin, Index count, const Real (*of_corners)[block_size]) const {
  const auto block = static_cast<std::size_t>(begin / block_size);
  for (int k = 0; k < 3; ++k) {
    Real* const to = sums.data(k) + first_[block];
    std::fill(to, sums.data(k) + first_[block + 1], 0);
    for (std::size_t c = 0; c < place_.size(); ++c) {
      const std::uint16_t* place = place_[c].data() + begin;
      const Real* from = of_corners[3 * c + static_cast<std::size_t>(k)];
      for (Index i = 0; i < count; ++i) to[place[i]] += from[i];
    }
  }
}

}  // namespace courant
