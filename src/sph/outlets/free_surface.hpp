#pragma once
// A level surface that open boundaries have, and the hydrostatic pressure below it.
#include <algorithm>
#include <optional>

#include "loads/body_acceleration.hpp"
#include "model/model.hpp"

namespace courant {

struct FreeSurface {
  bool on = false;
  Vec point = Vec::Zero();  ///< on it, where `level` is 0 or none [L]
  Vec up = Vec::UnitZ();    ///< against gravity
  Curve level{};            ///< height of the surface above `point` over time [L]; empty: 0
  BodyAcceleration gravity{};

  /// Of a position below the surface; < 0 above it. [L]
  Real depth(const Vec& x, Real t) const {
    return up.dot(point - x) + (level.abscissa.empty() ? 0 : level(t));
  }
  /// |g| depth: the pressure over the density; 0 above the surface. [L2/T2]
  Real head(const Vec& x, Real t, Index part) const {
    return gravity(x, t, part).norm() * std::max(Real(0), depth(x, t));
  }
  /// Share of a cell of height `cell` around a position in a plane with this normal that is below the
  /// surface.
  Real filled(const Vec& x, Real t, Real cell, const Vec& normal) const;
};

/// Against the acceleration of particles of a part at a position: at time t or, for a gravity that starts
/// from nothing, at the end. Nothing where there is none.
std::optional<Vec> upward(const BodyAcceleration& gravity, const Vec& x, Real t, Real endtim, Index part);

}  // namespace courant
