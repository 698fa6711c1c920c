// *EOS_EXAMPLE_STIFFENED_GAS: a gas that attraction holds together, for liquids under shocks.
#include "extension/compiled_against.hpp"
#include "laws/eos/eos.hpp"
#include "laws/eos/eos_fields.hpp"

namespace {

using namespace courant;

/// p = (GAMMA - 1) rho e - GAMMA PINF. With E counted from the state rho0, p = 0, where rho0 e = GAMMA
/// PINF/(GAMMA
/// - 1): p = GAMMA PINF mu + (GAMMA - 1) (1 + mu) E, and c^2 = GAMMA (p + PINF)/rho.
struct StiffenedGas {
  static constexpr const char* name = "stiffened gas";
  Real gamma, pinf;  // [-], [M/LT2]
  Real A(Real mu) const { return gamma * pinf * mu; }
  Real dA(Real) const { return gamma * pinf; }
  Real B(Real mu) const { return (gamma - 1) * (1 + mu); }
  Real dB(Real) const { return gamma - 1; }
  bool uses_energy() const { return true; }
};

struct Card : Entry {
  std::string title;
  Id eosid = 0;
  Real gamma = 0, pinf = 0, E0 = 0, V0 = 1;
  StiffenedGas law() const { return {gamma, pinf}; }
  Real e0() const { return E0; }
  Real v0() const { return V0; }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    if (!(gamma > 1)) deck.error(diagnostics, *this, "GAMMA", "expected a number > 1");
  }
};

// By hand: GAMMA = 4, PINF = 100, mu = 0.5, E = 10: p = 400 0.5 + 3 1.5 10
const RegisterEos<Card> registered{
    "p = GAMMA PINF mu + (GAMMA - 1) (1 + mu) E",
    "Harlow & Amsden 1971",
    {{"1,4.0,100.0\n", 0.5, 10, 245}},
    {.names = {"EOS_EXAMPLE_STIFFENED_GAS"},
     .purpose = "stiffened gas",
     .id_space = IdSpace::eos,
     .title_option = true,
     .title = &Card::title,
     .cards = {{.fields = {
                    eosid_field<Card>(),
                    {"GAMMA",
                     &Card::gamma,
                     "-",
                     "ratio of specific heats, above 1",
                     {.required = true, .check = Check::positive}},
                    {"PINF", &Card::pinf, "M/LT2", "stiffness", {.required = true, .check = Check::positive}},
                    {"E0", &Card::E0, "M/LT2", "energy above that of p = 0 at the start"},
                    v0_field<Card>()}}}}};

}  // namespace
