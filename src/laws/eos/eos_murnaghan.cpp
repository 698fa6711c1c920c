#include <cmath>

#include "laws/eos/eos.hpp"
#include "laws/eos/eos_cards.hpp"
#include "laws/eos/eos_fields.hpp"

namespace courant {

namespace {

/// p = K0 ((rho/rho0)^GAMMA - 1)
struct Murnaghan {
  static constexpr const char* name = "murnaghan";
  Real gamma, k0;  // [-], [M/LT2]
  Real A(Real mu) const { return k0 * (std::pow(1 + mu, gamma) - 1); }
  Real dA(Real mu) const { return k0 * gamma * std::pow(1 + mu, gamma - 1); }
  Real B(Real) const { return 0; }
  Real dB(Real) const { return 0; }
  bool uses_energy() const { return false; }
  const char* stiffness_field() const { return "K0"; }
};

struct EosMurnaghan : EosMurnaghanFields {
  Murnaghan law() const { return {gamma, k0}; }
  Real e0() const { return 0; }
  Real v0() const { return V0; }
};

const RegisterEos<EosMurnaghan> eos_murnaghan{
    "p = K0 ((rho/rho0)^GAMMA - 1)",
    "Murnaghan 1944; as Cole's law for water in Monaghan 1994: K0 = rho0 c0^2 / 7, GAMMA = 7",
    {{"         1       7.0     1.0E6       1.0\n", 0.0, 0, 0},
     {"         1       2.0     100.0       1.0\n", 0.1, 0, 21}},
    eos_murnaghan_table()};

}  // namespace

}  // namespace courant
