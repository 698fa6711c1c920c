#pragma once
// Values that elements report for histories, on request.
#include <array>
#include <vector>

#include "base/real.hpp"
#include "state/entities.hpp"
#include "state/world.hpp"

namespace courant {

enum class ElementKind { solid, beam, shell };  ///< in the order of elout

/// An integration point at t^n.
struct PointReport {
  std::array<Real, 6> stress{};  ///< Cauchy, xx yy zz xy yz zx; of beams along r, s, t: rr, rs, tr [M/LT2]
  Real plastic = 0;              ///< plastic strain, 0 where the law has none [-]
  std::array<Real, 6> strain{};  ///< as the stress, of the tensor; 0 unless STRFLG requests it [-]
  std::vector<Real> history{};   ///< what the law keeps, component by component, in its order
};

/// Of numbers and tensors in the same axes; not empty.
PointReport mean_of(const std::vector<PointReport>& points);

struct ElementReport {
  bool deleted = false;  ///< all numbers are 0 then
  /// Of solids one (the mean over its points) or all; of shells one for each layer from the lower face to
  /// the upper, the mean over the points in the plane; of beams those of the section, if it has any.
  std::vector<PointReport> points{};
  /// Of beams in their middle, with which the part on the side of end 2 acts on the other: pull, shear forces
  /// along s and t, moments about s and t, torsion about r. [ML/T2], [ML2/T2]
  std::array<Real, 6> resultants{};
};

struct ElementReportOptions {
  bool local_axes = false;  ///< stress of shells in the axes of the element, else in global ones
  bool all_points = false;  ///< the points of solids that have several, not their mean
};

/// A pass over a group of elements.
struct ElementReporter {
  virtual ~ElementReporter() = default;
  virtual ElementKind kind() const = 0;
  virtual const ElementGroup& reported() const = 0;
  virtual ElementReport report_element(const World& world, Index e,
                                       const ElementReportOptions& options) const = 0;
  /// What a cut through the element counts besides its points: of shells the thickness [L], of beams the area
  /// [L2], of solids 1.
  virtual Real cut_measure(Index e) const = 0;
  /// Of beams: false for axial forces only.
  virtual bool bends() const { return true; }
};

}  // namespace courant
