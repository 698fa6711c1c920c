#pragma once
// SPH after Jonsson et al. 2016, eqs 6-18 (FORM 0 of LS-DYNA): the passes, and the set-up of particles from a
// deck.
#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <variant>

#include "extension/left_out.hpp"
#include "keyword/deck.hpp"
#include "loads/body_acceleration.hpp"
#include "model/model.hpp"
#include "search/neighbours.hpp"
#include "sph/kernel/kernel_choice.hpp"
#include "sph/turbulence/turbulence.hpp"
#include "sph/walls/wall_belts.hpp"
#include "sph/walls/wall_law.hpp"
#include "state/world.hpp"

namespace courant {

class StrengthLaw;
class WallGhosts;

/// Artificial viscosity between pairs (IAVIS 0), eqs 15-16; q1 is given per particle as viscous_speed = q1 c.
struct MonaghanViscosity {
  Real q2 = 0;
};
/// Pressure-like bulk viscosity (IAVIS 1): q = rho h (Q1 h d^2 - Q2 c d) where d = div v < 0, added to p.
struct BulkViscosity {};
/// No viscosity, only the dissipation of a Riemann problem between pairs (*COURANT_RIEMANN).
struct RiemannFlux {
  Real eta = 3;                                      ///< of the limiter; huge: none
  Real pc = -std::numeric_limits<Real>::infinity();  ///< tensile cut-off of the liquid's pressure [M/LT2]
};
/// Twice the excess of p* over the mean of both pressures, for a pair that approaches at speed `w` [M/LT2]
inline Real riemann_excess(const RiemannFlux& flux, Real rho, Real c, Real w) {
  return w > 0 ? rho * w * std::min(flux.eta * w, c) : 0;
}
using ArtificialViscosity = std::variant<MonaghanViscosity, BulkViscosity, RiemannFlux>;

/// Coefficients of one part, LS-DYNA's names swapped to the paper's: q1 linear (HOURGLASS Q2), q2 quadratic
/// (HOURGLASS Q1).
struct PartViscosity {
  Real q1 = 0.06, q2 = 1.5;
};

/// Properties that the material of an SPH part must give. [M/L3], [-], [M/LT2], [M/LT]
struct SphMaterial {
  Real ro = 0;
  Real v0 = 1;                    ///< initial relative volume: rho = ro / v0
  Real pc = 0;                    ///< tensile cut-off of the pressure, <= 0
  Real mu = 0;                    ///< dynamic viscosity
  bool heat_in_internal = false;  ///< the EOS uses energy, so viscous heat goes into E and is counted there
  std::shared_ptr<const StrengthLaw> strength{};  ///< null: a fluid
};

/// *COURANT_ARTIFICIAL_STRESS
struct ArtificialStressRules {
  Real eps = 0;  ///< 0: none
  int n = 4;
};

/// ISHIFT of *CONTROL_SPH with *COURANT_SHIFTING.
struct ShiftRules {
  Real strength = 0;     ///< A; 0: none
  Real pairing = 0;      ///< R
  Real surface = 0;      ///< div r of surfaces
  bool correct = false;  ///< the velocity changes to that of the new position
};

/// Shells that support particles, and their skin friction; none where `segments` is empty.
struct SupportedWalls {
  std::vector<Index> segments;
  std::vector<WallFriction> friction;  ///< by segment
  std::vector<GhostPlane> planes;      ///< behind which their images support, too
  bool images = false;                 ///< METHOD 1: as mirrors of the particles
  std::vector<Index> with_ghosts;      ///< METHOD 2: shells with fixed ghost particles behind them
  bool hold = false;                   ///< any by LAW 2: no slip
  WallBelts belts;                     ///< *COURANT_WALL_BELT
};

/// *COURANT_EDDY_VISCOSITY.
struct MixingLength {
  Real most = 0;  ///< LMAX; 0: no eddy viscosity [L]
  Real cmu = 0, kappa = 0;
  Vec wall = Vec::Zero(), normal = Vec::Zero();  ///< a point on the wall; its outward normal, 0: no wall
  Real length(const Vec& x) const {
    return normal.isZero() ? most : std::clamp(kappa * (x - wall).dot(normal), Real(0), most);
  }
};

/// *COURANT_DENSITY_REINITIALISATION.
struct ReinitialisationRules {
  int every = 0;        ///< NCYC; 0: never
  bool linear = false;  ///< METHOD 1
};

struct SphSettings {
  int dim = 3;
  KernelChoice kernel = KernelChoice::cubic_spline;
  bool renormalised = false;        ///< FORM: gradients corrected by the inverse moment matrix
  bool reverse_correction = false;  ///< *COURANT_RENORMALISATION: each pressure with the partner's matrix
  bool plain_pressure = false;      ///< *COURANT_RENORMALISATION: pressure forces are not corrected
  bool uniform_h = true;
  bool evolving_h = false;
  std::vector<Real> h_min_factor, h_max_factor;  ///< per part, of h/h0
  ArtificialViscosity viscosity = MonaghanViscosity{};
  std::vector<PartViscosity> q;        ///< per part
  std::vector<Real> mu;                ///< per part, dynamic viscosity; empty if no part has any
  std::vector<Real> ro;                ///< per part, RO of the material [M/L3]
  MixingLength mixing_length;          ///< where there is one, mu is not empty
  TurbulenceRules turbulence;          ///< *COURANT_TURBULENCE; where there is one, mu is not empty
  std::vector<char> heat_in_internal;  ///< per part; empty if in none
  /// Per part, null where it has none; empty if no part has any.
  std::vector<std::shared_ptr<const StrengthLaw>> strength;
  ArtificialStressRules artificial_stress;
  Real tssfac = 0.9;
  Real geometry_eps = 0;  ///< *COURANT_PAIR_GEOMETRY: relative motion, in h, over which gradients are frozen
  Real density_diffusion = 0;  ///< *COURANT_DENSITY_DIFFUSION: delta; 0: none
  BodyAcceleration loads;      ///< without the part along a period: for the diffusion of density
  Real volume_tau = 0;         ///< *COURANT_VOLUME_CONTROL: TAU [T]; 0: none
  SupportedWalls walls;        ///< *COURANT_WALL_SUPPORT
  ReinitialisationRules reinitialisation;
  ShiftRules shift;
  std::vector<GhostPlane> mirrors;  ///< symmetry planes; near them particles drift along the plane only
  Real xsph = 0;                    ///< *COURANT_XSPH: EPS; 0: none
  Real velocity_smoothing = 0;      ///< the same where VEL is 1
  bool xsph_normed = false;         ///< over the sum of the kernel (Shepard)
  Real maxv = 0;                    ///< 0: no limit; < 0: clip; > 0: switch off [L/T]
  std::optional<Neighbours::Region> region;
  bool hide_inactive = false;          ///< ISHOW
  bool skip_inactive_contact = false;  ///< ICONT
  bool thickness_from_volume = false;  ///< ITHK
  Real spacing = 0;                    ///< largest nearest-neighbour distance of all SPH parts [L]
  std::vector<Real> spacing_of_part;   ///< the same of each part [L]
  std::vector<Real> usual_spacing;     ///< median of these distances in each part, 0: none [L]

  /// An eddy viscosity adds to MU.
  bool has_eddies() const { return mixing_length.most > 0 || turbulence.on(); }
  /// Viscosity acts between pairs with a turbulence model and at walls without slip; otherwise by a stress of
  /// each particle.
  bool has_viscous_pairs() const { return !mu.empty() && (turbulence.on() || walls.hold); }
  bool has_viscous_stress() const { return !mu.empty() && !has_viscous_pairs(); }
  /// Terms other than the motion of particles change the density.
  bool has_density_sources() const {
    return density_diffusion > 0 || volume_tau > 0 || reinitialisation.every > 0;
  }
};

/// Reads SECTION_SPH, CONTROL_SPH, HOURGLASS, CONTROL_BULK_VISCOSITY; fills world.particles (x, v, m, rho, h,
/// id, part, state) and world.dim. p, c, E follow from the materials.
SphSettings build_particles(const Deck& deck, const Model& model,
                            const std::function<SphMaterial(Index part)>& material, World& world,
                            Diagnostics& diagnostics);

/// The kernel by SPHKERN of SECTION_SPH or by COURANT_KERNEL.
KernelChoice read_kernel(const Deck& deck, const Model& model, Diagnostics& diagnostics);

/// The planes of BOUNDARY_SPH_SYMMETRY_PLANE and _PERIODIC. `reach`: search radius of a particle [L].
/// Particles on the second of two periodic planes, which is the same position as the first, are moved to
/// that. Call it while particles are in the order of the model.
std::vector<GhostPlane> build_ghost_planes(const Deck& deck, const Model& model, const SphSettings& settings,
                                           Real reach, World& world, Diagnostics& diagnostics);

/// Adds the SPH passes of the settings to the world, and returns the omitted ones with the reason.
std::vector<PassNote> add_sph_passes(World& world, const SphSettings& settings,
                                     std::shared_ptr<Neighbours> neighbours,
                                     const std::shared_ptr<WallGhosts>& wall_ghosts);

/// Adds the repulsion of particles from mirrors among `planes`, if there are any. Call it after
/// `add_sph_passes`.
void add_mirror_core(const SphSettings& settings, const std::vector<GhostPlane>& planes, World& world);

class PairVolumes;
/// "sph rates", with the kernel where it is not the cubic spline.
std::string rates_name(const SphSettings&);
/// Adds to the motions of `world` the pass that stores q1 c for neighbours, where rates need it.
void add_viscous_speed(const SphSettings&, World&);
/// Adds them to the passes of `world`.
std::shared_ptr<PairVolumes> make_pair_volumes(World&);
/// Reads FORM of CONTROL_SPH. Call it after the other settings, which it may contradict.
void read_form(const Deck&, SphSettings&, Diagnostics&);
/// Adds to rates and forces the difference between corrected and plain gradients.
void add_renormalisation(const SphSettings&, World&, std::shared_ptr<Neighbours>,
                         std::shared_ptr<PairVolumes>);
/// Behind the other settings that it may contradict.
void read_riemann(const Deck&, const Model&, const std::function<SphMaterial(Index part)>&, SphSettings&,
                  Diagnostics&);
/// Adds the dissipation of momentum to the rates, after plain sums, and that of mass to the forces, for the
/// next rates (`add_density_diffusion`).
void add_riemann(const SphSettings&, World&, std::shared_ptr<Neighbours>, std::shared_ptr<PairVolumes>);
/// Adds to the rates the result of density diffusion, or of a Riemann flux, in the last forces.
void add_density_diffusion(const SphSettings&, World&);
/// Adds to the rates the relaxation of the density towards that of the particle positions.
void add_volume_control(const SphSettings&, World&, std::shared_ptr<Neighbours>,
                        std::shared_ptr<PairVolumes>);
/// Reads *COURANT_WALL_SUPPORT into the settings. Call when segments and bodies are built.
void read_supported_walls(const Deck& deck, const Model& model, const World& world, SphSettings& settings,
                          Diagnostics& diagnostics);
/// *COURANT_WALL_BELT, for walls that are read.
void read_wall_belts(const Deck& deck, const Model& model, const World& world, SphSettings& settings,
                     Diagnostics& diagnostics);
/// Adds the passes of supporting walls; call it directly after the pair rates. Add the returned pass after
/// the pair forces; null: none.
std::shared_ptr<Force> add_wall_support(const SphSettings&, World&, std::shared_ptr<Neighbours>,
                                        std::shared_ptr<PairVolumes>);
/// "parts 1 and 2 differ in MID or EOSID"; empty where SPH parts do not.
std::string parts_of_several_materials(const Model&);
ReinitialisationRules read_density_reinitialisation(const Deck&, const Model&, Diagnostics&);
/// Adds to the rates the smoothing of the density every few steps, after all other rates of density.
void add_density_reinitialisation(const SphSettings&, World&, std::shared_ptr<Neighbours>,
                                  std::shared_ptr<PairVolumes>);
/// Behind the other settings that it may contradict.
void read_xsph(const Deck&, SphSettings&, Diagnostics&);
/// *COURANT_XSPH with VEL 1: adds the smoothing of velocities, once the step is known.
void add_velocity_smoothing(World&);
/// Adds the drift of particles, after the motion by their velocity; `add_sph_passes` adds the passes that set
/// the drift velocities.
void add_drifts(const SphSettings&, const BodyAcceleration& loads, World&);
/// Adds to the rates the effect of the last drift on the density; `add_shifting` includes it.
void add_drift_rate(const SphSettings&, World&, std::shared_ptr<Neighbours>, std::shared_ptr<PairVolumes>);
/// Adds the shifting of particles to the rates.
void add_shifting(const SphSettings&, World&, std::shared_ptr<Neighbours>, std::shared_ptr<PairVolumes>);
/// Adds to the rates the smoothing of the velocities of motion.
void add_xsph(const SphSettings&, World&, std::shared_ptr<Neighbours>, std::shared_ptr<PairVolumes>);
std::shared_ptr<Material> make_bulk_viscosity(const SphSettings&, World&);
/// Call it after the viscosity MU of the materials.
void read_eddy_viscosity(const Deck&, const Model&, const Particles&, SphSettings&, Diagnostics&);
/// Call it before the viscous stress, which uses it.
std::shared_ptr<Material> make_eddy_viscosity(const SphSettings&, World&);
/// Reads *COURANT_TURBULENCE. Call it when segments and supported walls are known.
void read_turbulence(const Deck&, const Model&, const World&, SphSettings&, Diagnostics&);
/// Adds the sums over neighbours to the rates, and the model to the laws.
void add_turbulence(const SphSettings&, World&, std::shared_ptr<Neighbours>, std::shared_ptr<PairVolumes>);
std::shared_ptr<Material> make_viscous_stress(const SphSettings&, World&);
/// Adds MU between pairs, without a turbulence model.
void add_pair_viscosity(const SphSettings&, World&, std::shared_ptr<Neighbours>,
                        std::shared_ptr<PairVolumes>);
std::shared_ptr<Preparation> make_smoothing_length(const SphSettings&, World&);
/// Eq. 18; the first of the world's time limits.
void add_sph_time_limit(const SphSettings&, const Model&, World&);
std::shared_ptr<EnergyTerm> make_sph_energy(const SphSettings&, World&, std::shared_ptr<Neighbours>);
std::shared_ptr<Constraint> make_speed_limit(const SphSettings&, std::shared_ptr<Neighbours>);

}  // namespace courant
