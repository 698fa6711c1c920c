#pragma once
#include "state/access.hpp"
#include "state/world.hpp"

namespace courant {

/// A pass over beams with their axes.
struct BeamAxes {
  virtual ~BeamAxes() = default;
  virtual const ElementGroup& beams() const = 0;
  /// Whether it has s and t besides r: trusses do not.
  virtual bool knows_section() const = 0;
  virtual void declare_axes(const World& world, Accesses& a) const = 0;
  /// r, s, t at the end of the step, as columns.
  virtual Matrix axes_of(const World& world, Index e) const = 0;
};

}  // namespace courant
