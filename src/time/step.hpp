#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "search/neighbours.hpp"
#include "state/world.hpp"

namespace courant {

/// CPU-cheap wall-clock accounting per pass, for the timing table.
class PassTimer {
 public:
  template <class F>
  void measure(const std::string& name, F&& f) {
    const auto start = std::chrono::steady_clock::now();
    f();
    add(name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  struct Row {
    std::string name;
    double seconds = 0;
    std::int64_t calls = 0;
  };
  void add(const std::string& name, double seconds);
  const std::vector<Row>& table() const { return table_; }

 private:
  std::vector<Row> table_;
};

/// Told once per cycle when x, p and f all belong to t^n and dt is chosen, before the kick.
using AtTimeLevel = std::function<void(World&, const Clock&, const std::string& dt_controlled_by)>;

/// How the step size may change besides the limits of the passes.
struct StepRules {
  Real dtinit = 0;                               ///< first step, 0: from the limits [T]
  std::function<Real(Real t)> dt_max = nullptr;  ///< LCTM curve
};

/// One step of the staggered central difference,
///   v^{n+1/2} = v^{n-1/2} + a^n (dt_old + dt)/2,   x^{n+1} = x^n + v^{n+1/2} dt;
/// density and energy advance with the velocity of the last kick, before the pressure is used.
void step(World& world, Clock& clock, Neighbours& neighbours, const StepRules& rules, PassTimer& timer,
          const AtTimeLevel& at_time_level);

/// Moves active particles with their forces and rim particles with their velocity.
std::shared_ptr<Motion> make_particle_motion();

/// Evaluates everything up to the choice of dt, without moving: for `courant check`.
void evaluate(World& world, Clock& clock, Neighbours& neighbours, const StepRules& rules, PassTimer& timer,
              std::string& controlled_by);

/// Energies at t^n into world.energy (the accumulated ones stay).
void sample_energy(World& world, const Clock& clock);

}  // namespace courant
