#pragma once
// Spot welds: beams whose section fails by the forces and moments in their middle.
#include <array>
#include <string>
#include <vector>

#include "laws/materials/mat_spotweld.hpp"
#include "state/access.hpp"
#include "state/entities.hpp"
#include "state/world.hpp"

namespace courant {

/// Of a section: axial force, torsion, moments about s and t, shear forces along s and t.
using SectionForces = std::array<Real, 6>;  ///< [ML/T2], [ML2/T2]

/// What the section of a weld carries.
struct WeldStrength {
  SectionForces most{};  ///< 0: does not count
  int filter = 0;        ///< NF: steps over which forces are averaged; 0, 1: none
  Real dt = 0;           ///< DT: the step that welds get by mass at the start; 0: none [T]
  bool fails() const;
  /// Sum of the squares of forces over what the section carries, of axial force only where it is > 0; the
  /// weld fails at 1. *MAT_SPOTWELD. [-]
  Real used(const SectionForces& forces) const;
};
WeldStrength weld_strength(const MatSpotweld& card);

/// Of one weld, for *DATABASE_SWFORC: magnitudes of shear force and of bending moment.
struct WeldForce {
  Id id = 0;
  Real axial = 0, shear = 0, moment = 0, torsion = 0, length = 0;
  Real failure_time = 0;  ///< 0: it holds [T]
};
/// The forces of the welds of a group, and of the last steps where they are averaged.
class WeldSections {
 public:
  WeldSections(const WeldStrength& strength, ElementGroup& group);
  void declare(Accesses& a) const;
  /// Of this step. Returns why the weld fails, else nothing.
  std::string look(Index e, const SectionForces& forces, Real t);
  /// For other reasons.
  void failed(Index e, Real t) { failure_time_[e] = t; }
  SectionForces forces(Index e) const;
  WeldForce report(Index e, Id id, Real length) const;
  /// 0: it holds. [T]
  Real failure_time(Index e) const { return failure_time_[e]; }
  Field<Real>& field() { return forces_; }

 private:
  SectionForces mean(Index e, const SectionForces& forces);
  WeldStrength strength_;
  Field<Real>&forces_, &failure_time_;
  Field<Real>* kept_ = nullptr;    ///< of the last steps, one after the other, the oldest is written over
  Field<Index>* count_ = nullptr;  ///< steps so far
};

/// A pass over welds.
struct WeldReporter {
  virtual ~WeldReporter() = default;
  virtual void report_welds(const World& world, std::vector<WeldForce>& out) const = 0;
};

}  // namespace courant
