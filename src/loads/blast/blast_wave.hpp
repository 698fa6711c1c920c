#pragma once
#include "base/real.hpp"

namespace courant {

/// A charge, in pounds, feet, milliseconds and pounds per square inch, the units of the fits.
enum class BlastKind {
  surface,  ///< a hemisphere on the ground
  air,      ///< a sphere in free air
};

/// What a charge does at a distance: p(t) = peak (1 - tau) exp(-decay tau), tau = (t - arrival)/duration, of
/// the wave that passes by and of the one that a wall at right angles throws back; behind tau = 1 the suction
/// falls faster where it would take back more than the wave gave (decay < 1).
struct BlastWave {
  Real arrival = 0, duration = 0;                    ///< [ms]
  Real incident = 0, reflected = 0;                  ///< peaks above the pressure of the air [psi]
  Real incident_decay = 0, reflected_decay = 0;      ///< [-]
  Real incident_impulse = 0, reflected_impulse = 0;  ///< of the positive phase [psi ms]

  /// On a face whose normal has the cosine c to the direction of the charge: reflected c^2 + incident (1 + c
  /// - 2 c^2), and incident alone where it looks away. `t`: since the detonation [ms]. `positive_only`: no
  /// suction behind the positive phase. [psi] Source: G. Randers-Pehrson, K. A. Bannister, Airblast loading
  /// model for DYNA2D and DYNA3D, ARL-TR-1310 (1997).
  Real pressure(Real t, Real c, bool positive_only) const;
  /// Its integral from the arrival to t. [psi ms]
  Real impulse(Real t, Real c, bool positive_only) const;
};

/// Scaled distances, feet over the cube root of pounds, between which the fits hold.
struct BlastRange {
  Real least, most;
};
BlastRange blast_range(BlastKind kind);

/// `mass` of TNT [lb], `distance` [ft], within the range.
/// Source: C. N. Kingery, G. Bulmash, Airblast parameters from TNT spherical air burst and hemispherical
/// surface burst, ARBRL-TR-02555 (1984): polynomials in u = a + b log10(Z) of the log10 of what is scaled by
/// the cube root of the mass.
BlastWave blast_wave(BlastKind kind, Real mass, Real distance);

}  // namespace courant
