#pragma once
// A square of water that flies at 1/50 of its speed of sound, as a deck with one thing more or less, as a
// simulation, and as a stepper put together by hand from the passes that it needs.
#include <memory>
#include <string>

#include "app/run/simulation.hpp"

namespace courant::benchmarks {

struct SquareOfWater {
  int n = 32;  ///< particles along a side of 1 m
  std::string mu = "0.";
  std::string h_bounds = "1.,1.";  ///< HMIN, HMAX
  std::string maxv = "1.E15";
  std::string c4 = "0.";  ///< of EOS_LINEAR_POLYNOMIAL
  int iavis = 0, box = 0;
  std::string keywords = "";  ///< further ones

  std::string deck() const;
};

/// Throws std::runtime_error where the deck has faults.
std::unique_ptr<Simulation> build(const SquareOfWater& water);

/// The passes of a scene without anything else, called without `Simulation`: rates, equation of state, step
/// size, forces, motion; with `ledger` also the tally of dissipated energy.
class BareSteps {
 public:
  BareSteps(const SquareOfWater& water, bool ledger);
  double take(int steps);  ///< particle-steps taken
  World& world() { return world_; }

 private:
  World world_;
  Clock clock_;
  PassTimer timer_;
  std::shared_ptr<Neighbours> neighbours_;
  std::unique_ptr<Stepper> stepper_;
};

}  // namespace courant::benchmarks
