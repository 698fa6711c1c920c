#pragma once
#include "base/real.hpp"
#include "model/cards.hpp"

namespace courant {

/// The field v + omega x (x - centre) of *INITIAL_VELOCITY_GENERATION, in global axes. XC, YC, ZC are global,
/// also with ICID.
struct GivenVelocity {
  Vec v = Vec::Zero(), omega = Vec::Zero(), centre = Vec::Zero();  ///< [L/T], [1/T], [L]
  Vec at(const Vec& x) const { return v + omega.cross(x - centre); }
};

/// `axes`: those of ICID, as columns. NX, NY, NZ must not all be 0 where OMEGA is given.
inline GivenVelocity given_velocity(const InitialVelocityGenerationCard& card, const Matrix& axes) {
  GivenVelocity out{.v = axes * Vec(card.vx, card.vy, card.vz), .centre = Vec(card.xc, card.yc, card.zc)};
  if (card.omega != 0) out.omega = card.omega * (axes * Vec(card.nx, card.ny, card.nz)).normalized();
  return out;
}

}  // namespace courant
