#pragma once
// What the loops over pairs read and write of a scene, for any source of gradients.
#include "sph/core/pair_loops.hpp"
#include "sph/core/pair_motion.hpp"
#include "sph/sph.hpp"

namespace courant {

/// q1 c of particles [begin, end), as pair loops read it of neighbours; q: of each part.
void work_out_viscous_speed(const std::vector<PartViscosity>& q, const Particles& p, Index begin, Index end,
                            Real* qc);

/// Of the rates: continuity, and what else needs the velocities of neighbours: Monaghan's viscosity and the
/// velocity gradient.
class RateFields {
 public:
  RateFields(const SphSettings& s, Particles& p);
  bool viscous() const { return viscous_speed_ != nullptr; }
  const Field<Real>& viscous_speed() const { return *viscous_speed_; }
  /// Viscosity has its quadratic part: no velocity is so high that less would matter. Decks cannot say 0.
  bool quadratic() const { return viscous() && q2_ > 1e-12; }
  bool gradient() const { return strain_ != nullptr; }
  PairArrays arrays(Particles& p, const PairVolumes& volumes) const;
  /// What the loop over pairs does with them, and what the reduction does.
  void declare_pairs(const Particles& p, const PairVolumes& volumes, Accesses& a) const;
  void declare_reduction(const Particles& p, Accesses& a) const;

 private:
  const AnyKernel* kernel_;
  PairMotion motion_;
  Field<Real>* heat_;
  Field<Real>* viscous_speed_ = nullptr;
  Field<Real>* strain_ = nullptr;
  Real q2_ = 0;
};

/// Of the forces: pressure and viscous stress of eq. 7, and what density diffusion will do; artificial
/// viscosity comes with the rates.
class ForceFields {
 public:
  ForceFields(const SphSettings& s, Particles& p);
  bool stress() const { return tau_ != nullptr; }
  bool diffusion() const { return diffusion_ != nullptr; }
  PairArrays arrays(Particles& p, const PairVolumes& volumes) const;
  void declare_pairs(const Particles& p, const PairVolumes& volumes, Accesses& a) const;
  void declare_reduction(const Particles& p, Accesses& a) const;

 private:
  const AnyKernel* kernel_;
  PairMotion motion_;
  Field<Real>* total_pressure_ = nullptr;
  Field<Real>* tau_ = nullptr;
  Field<Real>*diffusion_ = nullptr, *potential_ = nullptr;
  Real delta_;
};

}  // namespace courant
