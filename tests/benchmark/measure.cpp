#include "measure.hpp"

#include <algorithm>
#include <ctime>

#include "base/narrow.hpp"
#include "scenes.hpp"
#include "sph/core/pair_geometry.hpp"

namespace courant::benchmarks {

namespace {

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void step_to_rebuild(Simulation& s, std::int64_t most_steps) {
  const std::int64_t before = s.neighbours().rebuilds();
  for (std::int64_t k = 0; k < most_steps && s.neighbours().rebuilds() == before; ++k) take_steps(s, 1);
}

Chunk take_chunk(Simulation& s, const Effort& effort) {
  Chunk c;
  const auto passes_before = s.timer().table();
  const double wall = PassTimer::now(), cpu = processor_seconds();
  const std::int64_t rebuilds = s.neighbours().rebuilds();
  for (bool rebuilt = false; c.steps < effort.most_steps;) {
    const std::int64_t before = s.neighbours().rebuilds();
    take_steps(s, 1);
    ++c.steps;
    c.particle_steps += s.world().particles.active;
    rebuilt = s.neighbours().rebuilds() != before;
    if (rebuilt && PassTimer::now() - wall >= effort.seconds) break;
  }
  c.cpu = processor_seconds() - cpu;
  c.wall = PassTimer::now() - wall;
  c.rebuilds = s.neighbours().rebuilds() - rebuilds;
  c.passes = s.timer().table();
  for (std::size_t k = 0; k < passes_before.size(); ++k) c.passes[k].seconds -= passes_before[k].seconds;
  return c;
}

}  // namespace

Measured measure(Simulation& s, const Effort& effort) {
  Measured m;
  step_to_rebuild(s, effort.most_steps);
  // two threads that are hardly quicker than one may have had but one core, beside work of others
  const auto in_doubt = [&] { return effort.rounds > 1 && m.two.wall_ns() > 0.9 * m.one.wall_ns(); };
  for (int round = 0; round < effort.rounds || (round < 3 * effort.rounds && in_doubt()); ++round)
    for (const int threads : {1, 2}) {
      use_threads(s, threads);
      Chunk c = take_chunk(s, effort);
      m.steps += c.steps;
      m.rebuilds += c.rebuilds;
      if (threads == 1 && (round == 0 || c.cpu_ns() < m.cpu_ns)) m.cpu_ns = c.cpu_ns();
      Chunk& best = threads == 1 ? m.one : m.two;
      if (round == 0 || c.wall_ns() < best.wall_ns()) best = std::move(c);
    }
  return m;
}

double entries_worked_on(const Particles& p, const Neighbours& lists, Gradients gradients) {
  double out = 0;
  for (Index i = 0; i < p.active; i += Neighbours::lanes) {
    const Index end = std::min(i + Neighbours::lanes, p.active);
    const Real reach = lists.support() * p.h[i];
    const Index b = i / block_size, g = i % block_size / Neighbours::lanes;
    const ListSections& at = lists.sections(b)[g];
    // windows look at each pair from both sides
    const Index last = gradients == Gradients::window ? lists.starts(b)[g + 1] : at.earlier;
    for (Index e = lists.starts(b)[g]; e < last; ++e) {
      const Index j = lists.list(b)[e];
      bool near = gradients != Gradients::window && e < at.beyond;
      for (Index k = i; k < end; ++k) near = near || (p.x.vec(k) - p.x.vec(j)).squaredNorm() < reach * reach;
      out += near;
    }
  }
  return out;
}

/// Counted for each of the two particles, where both are active.
double pairs_within_support(const Particles& p, const Neighbours& lists) {
  double out = 0;
  for (Index i = 0; i < p.active; i += Neighbours::lanes) {
    const Index end = std::min(i + Neighbours::lanes, p.active);
    const Index b = i / block_size, g = i % block_size / Neighbours::lanes;
    const ListSections& at = lists.sections(b)[g];
    for (Index e = lists.starts(b)[g]; e < at.earlier; ++e)
      for (Index k = i; k < end; ++k) {
        const Index j = lists.list(b)[e];
        if (j == k || (p.x.vec(k) - p.x.vec(j)).norm() >= lists.support() * std::max(p.h[k], p.h[j]))
          continue;
        out += e >= at.later && e < at.later_end ? 2 : 1;
      }
  }
  return out;
}

Sizes sizes_of(const Simulation& s) {
  const Particles& p = s.world().particles;
  const Neighbours& lists = s.neighbours();
  Sizes out;
  out.dim = s.world().dim;
  out.active = p.active;
  const double active = p.active;
  out.pairs = pairs_within_support(p, lists) / active;
  const double entries = static_cast<double>(lists.entries());
  const double room = static_cast<double>(lists.entries_once()) * Neighbours::lanes * sizeof(Real);
  if (s.sph().geometry_eps > 0)
    out.gradients = Gradients::window;
  else if (s.sph().uniform_h && room <= static_cast<double>(PairGeometry::most_kept_bytes))
    out.gradients = Gradients::kept;
  const double looked_at = entries_worked_on(p, lists, out.gradients);
  if (out.gradients == Gradients::window)  // gradients, the factor of linear viscosity (no benchmark has the
                                           // quadratic one), entry
    out.kept_bytes =
        looked_at * (Neighbours::lanes * (out.dim + 1) * sizeof(Fixed16) + sizeof(Index)) / active;
  if (out.gradients == Gradients::kept)
    out.kept_bytes = looked_at * (Neighbours::lanes * sizeof(Real) + sizeof(Index)) / active;
  out.entries = looked_at * Neighbours::lanes / active;
  out.field_bytes = static_cast<double>(p.fields.bytes_per_entity()) * p.moving / active;
  out.list_bytes = entries * sizeof(Index) / active;
  return out;
}

}  // namespace courant::benchmarks
