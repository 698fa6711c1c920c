#pragma once
// A linear liquid and a step of constant size, for clouds without a deck.
#include "state/world.hpp"

namespace courant::test {

struct ConstantStep : TimeLimit {
  explicit ConstantStep(Real dt) : dt_(dt) {}
  std::string name() const override { return "constant"; }
  Limit limit(const World&, const Clock&) override { return {dt_, "test"}; }

 private:
  Real dt_;
};

/// p = rho0 c^2 mu
struct Liquid {
  static constexpr const char* name = "liquid";
  Real stiffness;  ///< rho0 c^2
  Real A(Real mu) const { return stiffness * mu; }
  Real dA(Real) const { return stiffness; }
  Real B(Real) const { return 0; }
  Real dB(Real) const { return 0; }
  bool uses_energy() const { return false; }
};

}  // namespace courant::test
