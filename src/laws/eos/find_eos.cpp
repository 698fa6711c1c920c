#include "laws/eos/find_eos.hpp"

#include <fmt/format.h>

namespace courant {

namespace {

std::string known_laws() {
  std::string names;
  for (const EosEntry& kind : eos_registry()) names += (names.empty() ? "*" : ", *") + kind.keyword;
  return names;
}

/// The equation of state must give the part a density and a sound speed at the start.
void check_start(const Deck& deck, const ModelPart& part, const EosLaw& eos, Real ro,
                 Diagnostics& diagnostics) {
  const Real mu = 1 / eos.V0 - 1, c2 = eos.sound_speed2(ro, mu, eos.E0);
  if (!(mu < eos.mu_limit()))
    deck.error(
        diagnostics, part.card, "EOSID",
        fmt::format("part {} starts beyond the end of equation of state {}: rho/RO = {:g}, the law ends "
                    "at {:g}",
                    part.id, part.eosid, 1 + mu, 1 + eos.mu_limit()),
        "correct V0 of the equation of state");
  else if (!(c2 > 0))
    deck.error(
        diagnostics, part.card, "EOSID",
        fmt::format("equation of state {} gives part {} no sound speed: c^2 = {:.4g} [L2/T2] at the start",
                    part.eosid, part.id, c2),
        eos.name() == "jwl" ? "products of a detonation begin with the energy E0 of *EOS_JWL, and A > 0"
                            : "give it a bulk modulus > 0: C1 = RO c0^2 of *EOS_LINEAR_POLYNOMIAL, K0 and "
                              "GAMMA of *EOS_MURNAGHAN");
}

}  // namespace

PartEos::PartEos(const Deck& deck, const Model& model) : model_(model) {
  for (const EosEntry& kind : eos_registry())
    for (const auto& [id, law] : kind.all(deck, model)) laws_.emplace(id, law);
}

std::shared_ptr<EosLaw> PartEos::at_density(Id id, const std::shared_ptr<EosLaw>& law, Real ro) {
  auto& found = of_density_[{id, ro}];
  if (!found) found = law->at_density(ro);
  return found ? found : found = law;
}

bool PartEos::exists(const Deck& deck, const ModelPart& part, const char* what,
                     Diagnostics& diagnostics) const {
  if (laws_.count(part.eosid) > 0) return true;
  if (!missing_.emplace(part.mid, part.eosid, what).second) return false;
  std::string parts;
  for (const ModelPart& other : model_.parts)
    if (other.mid == part.mid && other.eosid == part.eosid && other.has_sph == part.has_sph &&
        other.has_solid == part.has_solid)
      parts += fmt::format("{}{}", parts.empty() ? " " : ", ", other.id);
  if (parts.find(',') != std::string::npos) parts.insert(0, "s");
  deck.error(diagnostics, part.card, "EOSID",
             part.eosid == 0
                 ? fmt::format("the {} of part{} need an equation of state, got none", what, parts)
                 : fmt::format("there is no equation of state with id {} for the {} of part{}", part.eosid,
                               what, parts),
             "add one of " + known_laws() + " and give its id here");
  return false;
}

std::shared_ptr<EosLaw> PartEos::find(const Deck& deck, const ModelPart& part, Real ro, const char* what,
                                      Diagnostics& diagnostics) {
  if (!exists(deck, part, what, diagnostics)) return nullptr;
  auto out = at_density(part.eosid, laws_.at(part.eosid), ro);
  check_start(deck, part, *out, ro, diagnostics);
  return out;
}

}  // namespace courant
