#pragma once
// Particles of one state sorted into cells, to find those near a point.
#include <array>
#include <cstddef>
#include <vector>

#include "post/results.hpp"

namespace courant {

using Point = std::array<Real, 3>;

/// A selection of the particles of a state. Cells are at least as wide as the largest support, 2 h.
class ParticleGrid {
 public:
  struct Particle {
    Point x{};            ///< [L]
    Real V = 0, h = 0;    ///< m/rho [L3, in 2D L2], smoothing length [L]
    std::size_t row = 0;  ///< in the frame
  };

  /// Takes the particles with `taken[row]` != 0; shape of taken: (frame.size()).
  ParticleGrid(const ParticleFrame& frame, const std::vector<char>& taken);
  /// Takes the particles with `taken[k]` != 0; shape of taken: (from.particles().size()).
  ParticleGrid(const ParticleGrid& from, const std::vector<char>& taken);

  int dim() const { return dim_; }
  Real t() const { return t_; }
  Real largest_h() const { return h_max_; }
  const std::vector<Particle>& particles() const { return particles_; }  ///< sorted by cells

  /// Calls `use(k)` for all particles in the cells around a point: at least those closer than 2 largest_h().
  template <class Use>
  void near(const Point& x, const Use& use) const {
    std::array<std::ptrdiff_t, 3> low{}, high{};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::ptrdiff_t at = cell(x[a], a), last = static_cast<std::ptrdiff_t>(n_[a]) - 1;
      low[a] = at - 1 < 0 ? 0 : at - 1;
      high[a] = at + 1 > last ? last : at + 1;
    }
    visit(low, high, use);
  }
  /// The same around the line through x along an axis.
  template <class Use>
  void near_line(const Point& x, std::size_t axis, const Use& use) const {
    std::array<std::ptrdiff_t, 3> low{}, high{};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::ptrdiff_t at = cell(x[a], a), last = static_cast<std::ptrdiff_t>(n_[a]) - 1;
      low[a] = a == axis || at - 1 < 0 ? 0 : at - 1;
      high[a] = a == axis || at + 1 > last ? last : at + 1;
    }
    visit(low, high, use);
  }

 private:
  void sort();
  std::ptrdiff_t cell(Real x, std::size_t axis) const;
  template <class Use>
  void visit(const std::array<std::ptrdiff_t, 3>& low, const std::array<std::ptrdiff_t, 3>& high,
             const Use& use) const {
    for (std::ptrdiff_t k = low[2]; k <= high[2]; ++k)
      for (std::ptrdiff_t j = low[1]; j <= high[1]; ++j) {
        if (low[0] > high[0]) continue;
        const std::size_t row = (static_cast<std::size_t>(k) * n_[1] + static_cast<std::size_t>(j)) * n_[0];
        const std::size_t begin = first_[row + static_cast<std::size_t>(low[0])];
        const std::size_t end = first_[row + static_cast<std::size_t>(high[0]) + 1];
        for (std::size_t p = begin; p < end; ++p) use(p);
      }
  }

  int dim_ = 2;
  Real t_ = 0, h_max_ = 0, side_ = 1;
  Point low_{};
  std::array<std::size_t, 3> n_{1, 1, 1};
  std::vector<Particle> particles_;
  std::vector<std::size_t> first_{0, 0};  // of each cell, and the end
};

}  // namespace courant
