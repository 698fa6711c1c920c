#pragma once
// A cloud of particles for tests, without a deck.
#include <memory>
#include <random>

#include "../run_pass.hpp"
#include "sph/core/pair_passes.hpp"
#include "sph/core/view.hpp"

namespace courant::test {

struct Cloud {
  World world;
  SphSettings settings;
  std::shared_ptr<Neighbours> neighbours;
  Clock clock;

  /// A lattice of n per direction with spacing dx, each particle moved by up to `jitter` dx.
  Cloud(int dim, int n, Real dx, Real jitter, Real h_over_dx = 1.2, unsigned seed = 1) {
    world.dim = settings.dim = dim;
    std::mt19937 random(seed);
    std::uniform_real_distribution<Real> shake(-jitter * dx, jitter * dx);
    const int nz = dim == 3 ? n : 1;
    Particles& p = world.particles;
    Field<Real>& volume = p.fields.add<Real>({.name = "reference_volume", .dimension = "L3"});
    p.fields.resize(n * n * nz);
    Index i = 0;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        for (int c = 0; c < nz; ++c, ++i) {
          p.x.set(i, {a * dx + shake(random), b * dx + shake(random), dim == 3 ? c * dx + shake(random) : 0});
          p.m[i] = 1000 * std::pow(dx, dim);
          volume[i] = std::pow(dx, dim);
          p.rho[i] = 1000;
          p.c[i] = 30;
          p.h[i] = h_over_dx * dx;
          p.id[i] = i + 1;
        }
    settings.q.assign(1, {0.1, 0.0});
    settings.h_min_factor.assign(1, 1);
    settings.h_max_factor.assign(1, 1);
    neighbours = std::make_shared<Neighbours>(0.25 * h_over_dx * dx, std::nullopt);
  }
  void refresh() { neighbours->refresh(world, clock); }
  /// The pair passes; make them before `refresh`.
  void make_pairs(bool keep_gradients = true) {
    pairs =
        make_plain_passes(settings, world,
                          std::make_shared<PairGeometry>(neighbours, settings.uniform_h,
                                                         keep_gradients ? PairGeometry::most_kept_bytes : -1),
                          make_pair_volumes(world));
  }
  /// The same, with gradients that are frozen over steps.
  void make_frozen_pairs() {
    pairs = make_frozen_passes(settings, world, neighbours, make_pair_volumes(world));
  }
  void run(BlockPass& pass) { test::run(pass, world, clock); }
  void run_rates() {
    for (const auto& pass : pairs.rates) run(*pass);
  }
  void run_forces() {
    for (const auto& pass : pairs.forces) run(*pass);
  }
  PairPasses pairs;
};

}  // namespace courant::test
