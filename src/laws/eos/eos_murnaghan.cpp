#include <cmath>

#include "laws/eos/eos.hpp"
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
};

struct EosMurnaghan : Entry {
  Id eosid = 0;
  Real gamma = 0, k0 = 0, V0 = 1;
  std::string title;
  Murnaghan law() const { return {gamma, k0}; }
  Real e0() const { return 0; }
  Real v0() const { return V0; }
};

const RegisterEos<EosMurnaghan> eos_murnaghan{
    "p = K0 ((rho/rho0)^GAMMA - 1)",
    "Murnaghan 1944; as Cole's law for water in Monaghan 1994: K0 = rho0 c0^2 / 7, GAMMA = 7",
    {{"         1       7.0     1.0E6       1.0\n", 0.0, 0, 0},
     {"         1       2.0     100.0       1.0\n", 0.1, 0, 21}},
    {.names = {"EOS_MURNAGHAN", "EOS_019"},
     .purpose = "stiff power law for weakly compressible water",
     .id_space = IdSpace::eos,
     .title_option = true,
     .title = &EosMurnaghan::title,
     .cards = {{.fields = {eosid_field<EosMurnaghan>(),
                           {"GAMMA",
                            &EosMurnaghan::gamma,
                            "-",
                            "exponent, 7 for water",
                            {.required = true, .check = Check::positive}},
                           {"K0",
                            &EosMurnaghan::k0,
                            "M/LT2",
                            "rho0 c0^2 / GAMMA",
                            {.required = true, .check = Check::positive}},
                           v0_field<EosMurnaghan>()}}}}};

}  // namespace

}  // namespace courant
