#pragma once
// End forces of elastic beams.
#include <array>

#include "elements/beam/beams.hpp"

namespace courant {

/// Deformations of a beam and the conjugate forces: elongation and axial force, twist and torsion, rotations
/// of end 1 and 2 about s, about t, against the line between the ends, and the moments that hold them.
enum Part6 { elongation, twist, turn1_s, turn2_s, turn1_t, turn2_t, count6 };
using Six = std::array<Real, count6>;

/// Properties of an elastic beam.
struct ElasticBeam {
  Real E, G;  ///< [M/LT2]
  Real L;     ///< at the start [L]
};

/// Linear in elongation, twist and rotations of the ends, of the beam of Euler and Bernoulli, or with a shear
/// area of Timoshenko. docs/theory_structures.md
Six resultant_end_forces(const ElasticBeam& beam, const BeamMeasures& m, const Six& d);
/// The same where no moment passes hinges, and no axial force an end that slides: the ends of the beam turn
/// and move there as they would alone.
Six released_end_forces(const ElasticBeam& beam, const BeamMeasures& m, const BeamReleases& releases,
                        const Six& d);
/// The same of a beam with points in the section of its middle, or a truss.
Six integrated_end_forces(const ElasticBeam& beam, const BeamPart& part, const BeamMeasures& m, const Six& d);

}  // namespace courant
