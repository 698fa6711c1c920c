#pragma once
// Particles that move besides their velocity: shifting and XSPH.
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "loads/body_acceleration.hpp"
#include "search/ghosts.hpp"
#include "sph/options/drift_loops.hpp"
#include "state/world.hpp"

namespace courant {

/// What a kind of drift is called, and how far it may go.
struct DriftRules {
  std::string name;                                      ///< of the pass
  std::string statistics;                                ///< what its numbers in the summary begin with
  bool first = true;                                     ///< of several in a scene
  bool correct = false;                                  ///< the velocity changes to that of the new position
  Real longest = std::numeric_limits<Real>::infinity();  ///< in one step, of h [-]
};

/// x += u dt behind the motion by velocity, u the field `rules.statistics` + "_velocity" that a rate has set;
/// the velocity changes only where `rules.correct`, by its gradient; what the
/// density does is a rate of the next step. What stands near a wall of contact does not drift, nor do
/// particles that are held or driven; none drifts across a mirror. What potential and kinetic energy lose
/// counts as dissipated.
class Drift : public Relocation, public Refresh {
 public:
  Drift(DriftRules rules, std::vector<GhostPlane> mirrors, BodyAcceleration loads, World& world);
  std::string name() const override { return rules_.name; }
  void declare(const World& world, Accesses& a) const override;
  void start(World& world, const Clock& clock) override;
  void block(World& world, const Clock& clock, Index begin, Index end) override;
  void finish(World& world, const Clock& clock) override;
  /// Contact marks particles near its walls again.
  void refreshed(World& world, const Clock& clock, std::span<const Index> old_of_new) override;

 private:
  struct Sums {  ///< of a block
    Real potential = 0, kinetic = 0, farthest = 0;
    Index shortened = 0;
  };
  void correct(Particles& p, Index i, const Vec& shift, Sums& sums);
  Vec allowed(const Particles& p, Index i, const Vec& shift) const;
  /// Without the directions in which particle i is held.
  Vec where_free(Index i, Vec u) const;

  DriftRules rules_;
  std::vector<GhostPlane> mirrors_;
  BodyAcceleration loads_;
  BodyAcceleration::At now_;
  Field<Real>&velocity_, &drifted_;
  Field<Index>& near_wall_;
  std::array<Field<Real>*, 3> velocity_gradient_{};  ///< null: no corrections
  const Field<Index>*fixed_ = nullptr, *driven_ = nullptr;
  std::vector<Sums> sums_;
};

/// Density follows the positions also where these drift, as the mass of a particle is given. The work that
/// pressure does by it, p dV with the mean of both pressures, is not done on anything: it counts as
/// dissipated.
class DriftDensity : public Reduction, public EnergyTerm {
 public:
  explicit DriftDensity(World& world);
  std::string name() const override { return "drift work"; }
  void declare(const World& world, Accesses& a) const override;
  /// What `take_arrays` and `add` touch, for the rate that calls them.
  void declare_rate(const World& world, Accesses& a) const;
  /// Positions, velocities, drifts and densities for the loops.
  void take_arrays(Particles& p, const Clock& clock, DriftArrays& a);
  /// Among the rates: what the loop has found out.
  void add(Particles& p, Index begin, Index end);
  void start(World& world, const Clock& clock) override;
  void block(World& world, const Clock& clock, Index begin, Index end) override;
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  Field<Real>&drifted_, &rate_, &pressure_;
  std::vector<Real> work_;  ///< of each block, over the last step [ML2/T2]
};
/// Adds it to the reductions and to the terms of the ledger.
std::shared_ptr<DriftDensity> add_drift_density(World& world);

/// The field that a drift of that name reads [L/T].
inline Field<Real>& drift_velocity(Particles& p, const std::string& statistics) {
  return p.fields.add<Real>(
      {.name = statistics + "_velocity", .dimension = "L/T", .components = 3, .restart = false});
}
inline constexpr const char* shift_statistics = "shift";
inline constexpr const char* xsph_statistics = "xsph";

/// A particle that stands so near to a mirror that its own image matters drifts along it only.
Vec along_mirrors(const std::vector<GhostPlane>& mirrors, const Vec& x, Real h, Vec u);

/// The value of `statistic` that is farthest from 0 over the run.
void note_farthest(World& world, const std::string& statistic, Real value);

}  // namespace courant
