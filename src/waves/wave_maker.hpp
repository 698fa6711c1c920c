#pragma once
// *COURANT_WAVE_MAKER: how a paddle moves.
#include "base/real.hpp"
#include "model/model.hpp"
#include "rigid/bodies/rigid.hpp"
#include "search/neighbours.hpp"
#include "sph/kernel/kernel_choice.hpp"

namespace courant {

/// A paddle above a level bed. Displacements are those at the still level, towards the water.
struct Paddle {
  enum class Kind { piston, flap };
  Kind kind = Kind::piston;
  Vec bed = Vec::Zero();                          ///< point of the paddle on the bed at the start [L]
  Vec along = Vec::UnitX(), up = Vec::UnitY();    ///< unit: towards the water, upwards
  Real depth = 1, hinge = 0;                      ///< of the still water; hinge above the bed [L]
  Real arm() const { return depth - hinge; }      ///< of a flap, from hinge to still level [L]
  Vec pivot() const { return bed + hinge * up; }  ///< [L]
  Vec axis() const { return up.cross(along); }    ///< of a flap, which turns by atan(displacement / arm)
  /// Depth over which the velocity at the still level moves the same volume: the whole depth for a piston.
  /// [L]
  Real moved_depth() const;
  /// Velocity at the still level over the elevation of a long wave that it makes. [1/T]
  ///   u = sqrt(g d)/moved_depth eta;  sqrt(g/d) eta for a piston
  /// Source: Schaffer and Klopman, J. Waterway Port Coastal Ocean Eng. 126 (2000), section 2; Didier and
  /// Neves, Int. J. Offshore Polar Eng. 22 (2012), eq. 9.
  Real long_wave_gain(Real g) const;
};

/// The water is at rest at the start. `layout`: of the card.
struct WaveMakerSettings {
  Id id = 0;  ///< of the part
  Paddle paddle;
  Curve displacement, elevation;  ///< empty: none
  Real sf = 1;
  Real g = 1;                  ///< gravity, where it absorbs [L/T2]
  Real gain = 0;               ///< velocity over the missing elevation; 0: no absorption [1/T]
  Real distance = 0;           ///< of the measured level from the paddle [L]
  Real filter = 0, drift = 0;  ///< time constants; 0: none [T]
  Real most = 0;               ///< largest displacement by absorption [L]
};

/// Moves body `body` of `bodies` in all directions that are not held. Throws RunError where there is no water
/// at the paddle, or where absorption goes beyond its limit.
std::shared_ptr<Pass> make_wave_maker(WaveMakerSettings settings, std::shared_ptr<RigidBodies> bodies,
                                      std::size_t body, KernelChoice kernel,
                                      std::shared_ptr<const Neighbours> neighbours);

}  // namespace courant
