#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "search/neighbours.hpp"
#include "state/subcycle.hpp"
#include "state/world.hpp"
#include "time/guard.hpp"
#include "time/pass_timer.hpp"
#include "time/stage.hpp"
#include "time/steady_step.hpp"

namespace courant {

/// Called once per cycle when x, p and f are all at t^n and dt is chosen, before the kick.
using AtTimeLevel = std::function<void(World&, const Clock&, const std::string& dt_controlled_by)>;

/// Rules for the step size besides the limits of the passes.
struct StepRules {
  Real dtinit = 0;                               ///< first step, 0: from the limits [T]
  std::function<Real(Real t)> dt_max = nullptr;  ///< LCTM curve
  Real dtmin = 0;                                ///< stop below this times the first computed step
  Real tssfac = 1;                               ///< of most limits; a restart may change it
  Real share = 1;                          ///< fraction of the limits of passes; the rest is for constraints
  std::shared_ptr<Guard> guard = nullptr;  ///< checks the state at intervals
};

/// Takes steps of the staggered central difference,
///   v^{n+1/2} = v^{n-1/2} + a^n (dt_old + dt)/2,   x^{n+1} = x^n + v^{n+1/2} dt;
/// density and energy advance with the velocity of the last kick, before the pressure is used.
class Stepper : public Restartable {
 public:
  /// Adds the pass that monitors the lists to the passes of `world`, which must not change afterwards.
  /// `neighbours`: null where there are no particles.
  Stepper(World& world, Neighbours* neighbours, StepRules rules, PassTimer& timer);

  void step(Clock& clock, const AtTimeLevel& at_time_level);
  /// Everything up to the choice of dt and the impacts that depend on it, without moving: for `courant
  /// check`.
  void evaluate(Clock& clock, std::string& controlled_by);
  const std::string& stages() const { return stages_; }      ///< as text
  void forget_first_step() { first_dt_ = 0, steady_ = {}; }  ///< the next one is the first
  void keep(Archive& archive) override {
    archive("first_dt", first_dt_);
    archive("first_tssfac", first_tssfac_);
    steady_.keep(archive);
  }

 private:
  void evaluate_step(Clock& clock, std::string& controlled_by);
  TimeLimit::Limit choose_dt(Clock& clock, std::string& controlled_by);
  void stop_below_dtmin(const Clock& clock);

  World& world_;
  Neighbours* neighbours_;
  StepRules rules_;
  PassTimer& timer_;
  std::string stages_;
  std::vector<Exchanger*> exchangers_;
  std::vector<TimeLimit*> limits_;
  std::vector<Impact*> impacts_;
  std::vector<EnergyTerm*> terms_;
  std::vector<Stage> forces_, motion_;
  TimeLimit::Limit computed_{0, {}};  ///< limit of the passes, without DTINIT and LCTM
  SteadyStep steady_;
  Real first_dt_ = 0, first_tssfac_ = 1;  ///< of the first step: that [T], and TSSFAC
  Subcycle* subcycle_;                    ///< null: every pass runs in each step
  std::vector<Stage> inner_forces_;       ///< of steps without slow passes
  std::vector<Springs*> springs_;
};

/// Energies at t^n into world.energy (the accumulated ones stay).
void sample_energy(World& world, const Clock& clock);

}  // namespace courant
