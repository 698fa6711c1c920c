#pragma once
// Inlets of *COURANT_INFLOW with SURF 3: a level upstream is held, and the discharge follows from the flow
// inside.
#include <memory>
#include <span>
#include <vector>

#include "search/ghosts.hpp"
#include "search/inlet_plane.hpp"
#include "sph/materials/materials.hpp"
#include "state/shared_fields.hpp"
#include "state/world.hpp"

namespace courant {

struct CourantInflow;
struct Injection;
struct Injections;

/// What SURF 3 adds to an inlet. Its positions fill an upright rectangle on a level bed.
struct HeldLevel {
  Entry card{};
  bool on = false;
  bool energy = false;  ///< the level is that of the energy head, not of the surface at the inlet
  Real distance = 0;    ///< from the plane to where depth and velocity are measured [L]
  Real tau = 0;         ///< relaxation time of the velocity [T]
  Real most = 0;        ///< discharge; in 2D per unit of depth; infinity: no limit [L3/T]
  Vec upright = Vec::UnitY(), side = Vec::Zero();  ///< unit vectors in the plane; side: 0 in 2D
  Real low = 0;                                    ///< lower edge, along `upright` [L]
  Real left = 0, right = 0;                        ///< edges along `side` [L]
  Real fastest = 0;                                ///< largest velocity in the run [L/T]

  Real width(int dim) const { return dim == 2 ? 1 : right - left; }
};

namespace held_level_fields {
/// Particles made for such an inlet, with n the index into its positions: n + 1 until it is decided whether
/// the position is below the surface, then -(n + 1). Others: 0.
inline const SharedField<Index> position{{.name = "inlet_position", .dimension = "-"}};
}  // namespace held_level_fields

/// Velocity with which water comes in where depth `h` and mean velocity `u` are measured downstream, from the
/// invariant u - 2 sqrt(g h) of the characteristic that leaves the flow through the inlet, and the energy
/// head h + u^2/(2 g) held there [L]. < 0: water would flow out; at most that of critical flow. [L/T]
/// Henderson 1966, section 8.2.
Real velocity_at_head(Real u, Real h, Real head, Real g);

/// Critical velocity for an energy head: the fastest subcritical inflow. [L/T]
Real critical_velocity(Real head, Real g);

/// The depth at an inlet of an energy head, from which water comes in with velocity u. [L]
Real depth_at_inlet(Real head, Real u, Real g);

/// Completes `held` of an inlet with positions, surface and gravity; what cannot be held is reported.
void read_held_level(const Deck& deck, const Model& model, const CourantInflow& card, Injection& inlet,
                     Diagnostics& diagnostics);

/// Refuses gases, inlets above no bed, and measurements outside of the computational box. Call once the
/// entities exist.
void check_held_levels(const Deck& deck, const Injections& injections, std::span<const GhostPlane> planes,
                       const std::vector<PartMaterial>& materials, const SphSettings& settings,
                       const World& world, Diagnostics& diagnostics);

/// The pass that moves the waiting particles of such inlets, sets their pressure, and closes positions above
/// the surface. `flow` null: none. Call before the passes that read volumes of particles are added.
void add_held_levels(const Injections& injections, const std::vector<PartMaterial>& materials,
                     std::shared_ptr<InletFlow> flow, World& world);

}  // namespace courant
