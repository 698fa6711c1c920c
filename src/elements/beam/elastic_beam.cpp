#include "elements/beam/elastic_beam.hpp"

namespace courant {

namespace {

constexpr std::size_t at6(Part6 k) {
  return static_cast<std::size_t>(k);
}

}  // namespace

Six resultant_end_forces(const ElasticBeam& beam, const BeamMeasures& m, const Six& d) {
  const Real L = beam.L;
  const auto bend = [&](Real I, Real mine, Real other) {
    const Real phi = m.shear_area > 0 ? 12 * beam.E * I / (beam.G * m.shear_area * L * L) : 0;
    return beam.E * I / (L * (1 + phi)) * ((4 + phi) * mine + (2 - phi) * other);
  };
  Six g{};
  g[elongation] = beam.E * m.A / L * d[elongation], g[twist] = beam.G * m.J / L * d[twist];
  g[turn1_s] = bend(m.Iss, d[turn1_s], d[turn2_s]), g[turn2_s] = bend(m.Iss, d[turn2_s], d[turn1_s]);
  g[turn1_t] = bend(m.Itt, d[turn1_t], d[turn2_t]), g[turn2_t] = bend(m.Itt, d[turn2_t], d[turn1_t]);
  return g;
}

Six integrated_end_forces(const ElasticBeam& beam, const BeamPart& part, const BeamMeasures& m,
                          const Six& d) {
  const Real L = beam.L;
  Six g{};
  g[elongation] = beam.E * m.A / L * d[elongation];
  if (part.kind == BeamKind::truss) return g;
  Real ss = 0, tt = 0;  // second moments of the points
  for (const SectionPoint& p : part.points) {
    ss += p.share * m.A * (p.t * m.half_t) * (p.t * m.half_t);
    tt += p.share * m.A * (p.s * m.half_s) * (p.s * m.half_s);
  }
  g[twist] = beam.G * (ss + tt) / L * d[twist];
  const auto bend = [&](Real I, Part6 one, Part6 two) {
    const Real curved = beam.E * I / L * (d[at6(two)] - d[at6(one)]);
    const Real sheared = 0.25 * beam.G * m.shear_area * L * (d[at6(one)] + d[at6(two)]);
    g[at6(one)] = sheared - curved, g[at6(two)] = sheared + curved;
  };
  bend(ss, turn1_s, turn2_s), bend(tt, turn1_t, turn2_t);
  return g;
}

}  // namespace courant
