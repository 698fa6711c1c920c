#pragma once
#include "keyword/deck.hpp"
#include "model/conditions/viscosity_cards.hpp"

namespace courant {

/// *SECTION_SPH: smoothing length of the parts that name it.
struct SectionSph : Entry {
  Id secid = 0;
  Real cslh = 0, hmin = 0, hmax = 0, sphini = 0, death = 0, start = 0;
  int sphkern = 0;
  std::string title;
};

/// *CONTROL_SPH
struct ControlSph : Entry {
  int ncbs = 0;
  Id boxid = 0;
  Real dt = 0;
  int idim = 0, nmneigh = 0, form = 0;
  Real start = 0, maxv = 0;
  int cont = 0, deriv = 0, ini = 0, ishow = 0, ierod = 0, icont = 0, iavis = 0, isymp = 0;
  int ithk = 0, istab = 0;
  Real ql = 0;
  int sphsort = 0, ishift = 0;
};

/// *COURANT_PAIR_GEOMETRY, ours.
struct CourantPairGeometry : Entry {
  Real eps = 0;
};

/// *COURANT_DENSITY_DIFFUSION, ours.
struct CourantDensityDiffusion : Entry {
  Real delta = 0;
};

/// *COURANT_KERNEL, ours.
struct CourantKernel : Entry {
  std::string name;
};

/// *COURANT_VOLUME_CONTROL, ours.
struct CourantVolumeControl : Entry {
  Real tau = 0;
};

/// *COURANT_WALL_SUPPORT, ours.
struct CourantWallSupport : Entry {
  Id surfb = 0;
  int surfbtyp = 3;
  Real cf = 0;
  int method = 0, law = 0;
  Real ks = 0;
};

/// *COURANT_DENSITY_REINITIALISATION, ours.
struct CourantDensityReinitialisation : Entry {
  int ncyc = 0, method = 0;
};

/// *COURANT_EDDY_VISCOSITY, ours.
struct CourantEddyViscosity : Entry {
  Real lmax = 0, cmu = 0, kappa = 0;
  Real vtx = 0, vty = 0, vtz = 0, vhx = 0, vhy = 0, vhz = 0;
};

/// *COURANT_RIEMANN, ours.
struct CourantRiemann : Entry {
  Real eta = 0;
};

/// *COURANT_SHIFTING, ours.
struct CourantShifting : Entry {
  Real strength = 0, pairing = 0, surface = 0;
  int correct = 0;
};

/// *COURANT_RENORMALISATION, ours.
struct CourantRenormalisation : Entry {
  int reverse = 0, pressure = 0;
};

/// *COURANT_XSPH, ours.
struct CourantXsph : Entry {
  Real eps = 0;
  int norm = 0, vel = 0;
};

}  // namespace courant
