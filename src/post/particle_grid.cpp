#include "post/particle_grid.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

ParticleGrid::ParticleGrid(const ParticleFrame& frame, const std::vector<char>& taken)
    : dim_(frame.dim), t_(frame.t) {
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (taken[i])
      particles_.push_back({{frame.x[i], frame.y[i], dim_ == 3 ? frame.z[i] : 0}, frame.V[i], frame.h[i], i});
  sort();
}

ParticleGrid::ParticleGrid(const ParticleGrid& from, const std::vector<char>& taken)
    : dim_(from.dim_), t_(from.t_) {
  for (std::size_t k = 0; k < from.particles_.size(); ++k)
    if (taken[k]) particles_.push_back(from.particles_[k]);
  sort();
}

void ParticleGrid::sort() {
  if (particles_.empty()) return;
  Point high = low_ = particles_.front().x;
  for (const Particle& p : particles_) {
    h_max_ = std::max(h_max_, p.h);
    for (std::size_t a = 0; a < 3; ++a) {
      low_[a] = std::min(low_[a], p.x[a]);
      high[a] = std::max(high[a], p.x[a]);
    }
  }
  // a few particles that flew far away must not cost a table as large as the space between
  const Real most_cells = 8 * static_cast<Real>(particles_.size()) + 1e5;
  Real cells = 0;
  for (side_ = 2 * h_max_;; side_ *= 2) {
    cells = 1;
    for (std::size_t a = 0; a < 3; ++a) cells *= std::floor((high[a] - low_[a]) / side_) + 1;
    if (cells <= most_cells) break;
  }
  for (std::size_t a = 0; a < 3; ++a)
    n_[a] = static_cast<std::size_t>(std::floor((high[a] - low_[a]) / side_)) + 1;

  first_.assign(n_[0] * n_[1] * n_[2] + 1, 0);
  std::vector<std::size_t> at(particles_.size());
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    std::array<std::size_t, 3> c{};
    for (std::size_t a = 0; a < 3; ++a) c[a] = static_cast<std::size_t>(cell(particles_[k].x[a], a));
    at[k] = (c[2] * n_[1] + c[1]) * n_[0] + c[0];
    ++first_[at[k] + 1];
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  std::vector<Particle> sorted(particles_.size());
  for (std::size_t k = 0; k < particles_.size(); ++k) sorted[next[at[k]]++] = particles_[k];
  particles_ = std::move(sorted);
}

std::ptrdiff_t ParticleGrid::cell(Real x, std::size_t axis) const {
  if (dim_ == 2 && axis == 2) return 0;  // in a plane flow z does not matter
  // far outside the cells there is nothing, and the number must fit the integer
  const Real at = std::floor((x - low_[axis]) / side_), last = static_cast<Real>(n_[axis]);
  return static_cast<std::ptrdiff_t>(std::clamp<Real>(at, -2, last + 1));
}

}  // namespace courant
