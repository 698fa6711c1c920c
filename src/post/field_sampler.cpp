#include "post/field_sampler.hpp"

#include <cmath>

#include "parallel/parallel.hpp"

namespace courant {

void FieldSampler::read(const MapReader& map, const PostUnits& units) {
  of = read_quantities(map, units);
  where = read_where(map);
  spray = read_spray(map);
  interpolation = read_choice(map, "interpolation", {"shepard", "mls"}) == 0 ? Interpolation::shepard
                                                                             : Interpolation::mls;
  map.positive("wet", wet);
}

void FieldSampler::note_needs(std::vector<ParticleArray>& arrays) const {
  for (const Quantity& quantity : of) note_arrays(quantity.of, arrays);
  note_arrays(where.of, arrays);
}

FieldSampler::Sample FieldSampler::sample(const PostState& state, const std::vector<Point>& points) const {
  const ParticleGrid& water = state.water(where.text, where.of, spray);
  std::vector<std::vector<Real>> of_particles;
  for (const Quantity& quantity : of) of_particles.push_back(evaluate(quantity.of, state.frame));
  Sample out;
  out.values.assign(of.size(), std::vector<Real>(points.size(), std::nan("")));
  out.wet.assign(points.size(), 0);
  out.colour.assign(points.size(), 0);
  std::vector<char> fallback(points.size(), 0);
  for_each(static_cast<Index>(points.size()), [&](Index i) {
    const auto p = static_cast<std::size_t>(i);
    const PointWeights weights = interpolate(water, points[p], interpolation);
    out.colour[p] = weights.colour;
    if (!(weights.colour >= wet)) return;
    out.wet[p] = 1;
    fallback[p] = weights.fallback;
    for (std::size_t q = 0; q < of.size(); ++q) out.values[q][p] = weighted(water, weights, of_particles[q]);
  });
  for (char one : fallback) out.fallbacks += one != 0;
  return out;
}

}  // namespace courant
