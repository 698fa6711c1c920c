#include "elements/beam/elastic_beam.hpp"

namespace courant {

namespace {

constexpr std::size_t at6(Part6 k) {
  return static_cast<std::size_t>(k);
}

/// Moments over rotations of the ends about one axis: `near` of its own end, `far` of the other.
struct Bending {
  Real near, far;  ///< EI/(L (1 + phi)) times 4 + phi, 2 - phi [ML2/T2]
};
Bending bending(const ElasticBeam& beam, const BeamMeasures& m, Real I) {
  const Real L = beam.L;
  const Real phi = m.shear_area > 0 ? 12 * beam.E * I / (beam.G * m.shear_area * L * L) : 0;
  const Real k = beam.E * I / (L * (1 + phi));
  return {k * (4 + phi), k * (2 - phi)};
}

}  // namespace

Six resultant_end_forces(const ElasticBeam& beam, const BeamMeasures& m, const Six& d) {
  const Real L = beam.L;
  Six g{};
  g[elongation] = beam.E * m.A / L * d[elongation], g[twist] = beam.G * m.J / L * d[twist];
  const Bending s = bending(beam, m, m.Iss), t = bending(beam, m, m.Itt);
  g[turn1_s] = s.near * d[turn1_s] + s.far * d[turn2_s],
  g[turn2_s] = s.near * d[turn2_s] + s.far * d[turn1_s];
  g[turn1_t] = t.near * d[turn1_t] + t.far * d[turn2_t],
  g[turn2_t] = t.near * d[turn2_t] + t.far * d[turn1_t];
  return g;
}

// A hinge's end turns so that its moment is 0: of the other one near - far^2/near is left.
Six released_end_forces(const ElasticBeam& beam, const BeamMeasures& m, const BeamReleases& releases,
                        const Six& d) {
  Six g = resultant_end_forces(beam, m, d);
  if (releases.pull) g[elongation] = 0;
  if (releases.twist()) g[twist] = 0;
  const auto release = [&](Real I, std::size_t axis, Part6 one, Part6 two) {
    const std::array<Part6, 2> at{one, two};
    const std::array<bool, 2> hinge{releases.turns[0][axis], releases.turns[1][axis]};
    if (!hinge[0] && !hinge[1]) return;
    const Bending b = bending(beam, m, I);
    for (std::size_t c = 0; c < 2; ++c)
      g[at6(at[c])] = hinge[c] ? 0 : (b.near - b.far * b.far / b.near) * d[at6(at[c])];
  };
  release(m.Iss, 1, turn1_s, turn2_s), release(m.Itt, 2, turn1_t, turn2_t);
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
