#pragma once
#include <array>

#include "laws/point_block.hpp"
#include "state/access.hpp"
#include "state/entities.hpp"

namespace courant {

/// Strain at the points of a group where STRFLG requests it: the integral of D over time, turned with the
/// stress; no law reads it. Solids have it along global axes, shells along those of the element. [-]
class PointStrains {
 public:
  /// Adds the field to the group, unless a failure criterion has added it: component 6 p + k of point p.
  PointStrains(const ElementGroup& group, int points)
      : field_(group.fields.add<Real>(
            {.name = "strain_of_points", .dimension = "-", .components = 6 * points})) {}
  Field<Real>& field() { return field_; }
  void declare(Accesses& a) const { a.updates(field_); }
  /// Behind the law. `rate_zz`: of shells, from the law; null: that of the points. [1/T]
  void advance(int point, Index begin, const PointBlock& points, const Real* rate_zz = nullptr) const {
    for (int k = 0; k < 6; ++k) {
      Real* strain = field_.data(6 * point + k) + begin;
      const Real* rate = k == 2 && rate_zz ? rate_zz : points.rate[static_cast<std::size_t>(k)];
      for (Index i = 0; i < points.count; ++i) strain[i] += rate[i] * points.dt;
    }
  }
  std::array<Real, 6> at(int point, Index e) const {
    std::array<Real, 6> out;
    for (std::size_t k = 0; k < 6; ++k) out[k] = field_.data(6 * point + static_cast<int>(k))[e];
    return out;
  }

 private:
  Field<Real>& field_;
};

}  // namespace courant
