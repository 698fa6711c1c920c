#pragma once
// *DAMPING_FREQUENCY_RANGE: relaxation mechanisms that damp a range of frequencies alike.
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Relaxation mechanisms with the times tau_k and the shares c_k. Of stress (_DEFORM): springs of c_k times
/// the stiffness in series with dashpots. Of motion: masses of c_k m that dashpots couple to the node.
struct FrequencyRange {
  std::vector<Real> time{};   ///< [T]
  std::vector<Real> share{};  ///< [-]
  bool any() const { return !time.empty(); }
  Real sum() const;  ///< of the shares [-]

  static constexpr std::size_t most = 10;
  struct Step {
    std::array<Real, most> left, mean;  ///< exp(-dt/tau), and the mean of exp(-s/tau) over 0 < s < dt [-]
  };
  /// Of each mechanism in a step: the remainder, and the share of a change that is steady in the step.
  Step step(Real dt) const;
};

/// Shares so that a mode of any frequency f, flow <= f <= fhigh [1/T], has the fraction `cdamp` of critical
/// damping, within some per cent of it. docs/theory_structures.md. A share below 0: `cdamp` is too large.
FrequencyRange fitted_range(Real cdamp, Real flow, Real fhigh, bool of_stress);

/// By part of the model: of *DAMPING_FREQUENCY_RANGE_DEFORM (`of_stress`) or *DAMPING_FREQUENCY_RANGE.
/// `why_not`: why a part cannot be damped so, empty: it can. Refuses by name: such parts where PSID names
/// them (else a warning), parts that are named twice, empty ranges.
std::vector<FrequencyRange> frequency_ranges(const Deck& deck, const Model& model, bool of_stress,
                                             const std::function<std::string(std::size_t)>& why_not,
                                             Diagnostics& diagnostics);

}  // namespace courant
