#pragma once
// Stops a failed run before it writes wrong results.
#include <functional>

#include "state/ranges.hpp"
#include "state/restartable.hpp"
#include "state/world.hpp"

namespace courant {

/// Checks the whole state at intervals: NaN, created energy, extremes of speeds and densities. A check reads
/// some twenty arrays once, so its cost is small against `interval` steps.
class Guard : public Restartable {
 public:
  static constexpr int interval = 64;         ///< steps between checks
  static constexpr Real least_share = 1e-12;  ///< of the rest energy: less counts as zero

  /// parts: rho0, c0, liquid and number of each part of the model. endeng: percent, 0 none
  /// (CONTROL_TERMINATION). rest_energy: sum of m c^2 over all that may move, of which energies below 1e-12
  /// are round-off [ML2/T2].
  explicit Guard(Ranges parts, Real endeng = 0, Real rest_energy = 0)
      : ranges_(std::move(parts)), endeng_(endeng), least_energy_(least_share * rest_energy) {}

  /// At t^n, with forces and pressures known. At cycle 0 it sets the initial energy of the ledger; the amount
  /// of energy is checked at multiples of `interval` only. Throws RunError, which names the quantity.
  void look(World& world, const Clock& clock);
  /// The first part of it: particles, nodes and bodies hold finite numbers only. Throws RunError.
  static void stop_for_numbers(const World& world, const Clock& clock);
  /// Records extremes of speed and density; numbers that are not finite are ignored.
  void note_ranges(const World& world, const Clock& clock);
  const Ranges& ranges() const { return ranges_; }
  void keep(Archive& archive) override;

 private:
  void start(EnergyLedger& e);
  void note_peak(EnergyLedger& e) const;
  void stop_for_energy(const EnergyLedger& e, const Clock& clock);

  Ranges ranges_;
  Real endeng_;
  Real least_energy_;           ///< below it is round-off [ML2/T2]
  Real initial_size_ = 0;       ///< of the initial energies except potential [ML2/T2]
  Real initial_potential_ = 0;  ///< [ML2/T2]
  Real initial_internal_ = 0;   ///< [ML2/T2]
  Real entered_ = 0;            ///< largest energy input found by a check [ML2/T2]
  std::vector<char> beaten_;    ///< blocks of particles with one beyond a range
};

/// Percent by which the energy ratio of glstat differs from 1: 100 residual / (initial energy + external work
/// and work of gravity), as ENDENG counts. 0 where the residual is round-off only.
Real energy_ratio_change(const EnergyLedger& e);

}  // namespace courant
