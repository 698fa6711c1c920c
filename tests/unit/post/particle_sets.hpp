#pragma once
// Sets of particles with known fields.
#include <cmath>
#include <functional>

#include "post/particle_grid.hpp"

namespace courant::test {

/// A number in [-0.5, 0.5) that looks random, the same for the same i.
inline Real scatter(std::size_t i) {
  const Real s = std::sin(12.9898 * static_cast<Real>(i + 1)) * 43758.5453;
  return s - std::floor(s) - 0.5;
}

/// Particles of a lattice in [x0, x1] x [y0, y1], each moved by up to jitter spacings along each axis.
struct Lattice {
  Real dx = 0.005, x0 = 0, x1 = 1, y0 = 0, y1 = 0.1, jitter = 0;
};

inline void add(ParticleFrame& frame, Real x, Real y, Real dx, Real z = 0) {
  frame.x.push_back(x), frame.y.push_back(y), frame.z.push_back(z);
  frame.V.push_back(std::pow(dx, frame.dim)), frame.h.push_back(1.2 * dx);
  frame.arrays["mass"].push_back(1000 * frame.V.back());
  frame.arrays["density"].push_back(1000);
  frame.arrays["pressure"].push_back(0);
  frame.arrays["active"].push_back(1);
  for (int a = 0; a < 3; ++a) frame.arrays["velocity"].push_back(0);
}

inline void fill(ParticleFrame& frame, const Lattice& lattice) {
  const auto nx = std::lround((lattice.x1 - lattice.x0) / lattice.dx);
  const auto ny = std::lround((lattice.y1 - lattice.y0) / lattice.dx);
  for (long i = 0; i < nx; ++i)
    for (long k = 0; k < ny; ++k) {
      const std::size_t n = frame.size();
      add(frame, lattice.x0 + (static_cast<Real>(i) + 0.5 + lattice.jitter * scatter(2 * n)) * lattice.dx,
          lattice.y0 + (static_cast<Real>(k) + 0.5 + lattice.jitter * scatter(2 * n + 1)) * lattice.dx,
          lattice.dx);
    }
}

inline ParticleFrame water(const Lattice& lattice) {
  ParticleFrame frame;
  fill(frame, lattice);
  return frame;
}

inline ParticleGrid all_of(const ParticleFrame& frame) {
  return ParticleGrid(frame, std::vector<char>(frame.size(), 1));
}

}  // namespace courant::test
