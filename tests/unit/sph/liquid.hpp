#pragma once
// A linear liquid and a step of constant size, for clouds without a deck.
#include "sph/materials/equation_of_state.hpp"

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

/// The pass of a liquid of density 1000 and that stiffness, whose tension is not cut off.
inline std::shared_ptr<EquationOfState> liquid_pass(Real stiffness, World& world) {
  return std::make_shared<EquationOfState>(std::make_shared<EosLawOf<Liquid>>(Liquid{stiffness}),
                                           EosParts{{1}, true, {1000}, {-1e20}},
                                           std::vector<const Field<Real>*>{}, world);
}

}  // namespace courant::test
