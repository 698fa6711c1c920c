#pragma once
// Equations of state p = A(mu) + B(mu) E with mu = rho/rho0 - 1 and E the internal energy per reference
// volume. A law is a small struct with A, B and their derivatives; one file per law registers it with its
// card, and nothing else is edited.
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "keyword/deck.hpp"
#include "keyword/registry.hpp"
#include "materials/material_pass.hpp"

namespace courant {

/// A law read from the deck, or made for a test.
class EosLaw {
 public:
  virtual ~EosLaw() = default;
  virtual Real pressure(Real mu, Real E) const = 0;                 ///< [M/LT2]
  virtual Real slope(Real mu, Real E) const = 0;                    ///< dp/dmu at constant E [M/LT2]
  virtual Real sound_speed2(Real rho0, Real mu, Real E) const = 0;  ///< dp/drho at constant entropy [L2/T2]
  virtual bool uses_energy() const = 0;
  virtual Real mu_limit() const = 0;  ///< the law holds below; infinite if it always holds
  /// The same law for a material with another reference density than 1; nullptr where that makes no
  /// difference.
  virtual std::shared_ptr<EosLaw> at_density(Real rho0) const = 0;
  virtual std::shared_ptr<Material> make_pass(EosPart part, World& world) const = 0;
  Real E0 = 0;           ///< initial internal energy per reference volume [M/LT2]
  Real V0 = 1;           ///< initial relative volume rho0/rho
  Real specific_E0 = 0;  ///< added to E0, times the reference density [L2/T2]
};

/// A value that a law must give, computed by hand from its formula: the generic test checks it.
struct EosReference {
  std::string deck;  ///< the keyword's cards, as in a deck
  Real mu, E, p;
  Real rho0 = 1;
};

struct EosEntry {
  std::string keyword, equation, source;
  std::vector<EosReference> references;
  std::function<std::vector<std::pair<Id, std::shared_ptr<EosLaw>>>(const Deck&)>
      all;  ///< every law of this kind in a deck
};

std::vector<EosEntry>& eos_registry();

template <class Law>
class EosLawOf : public EosLaw {
 public:
  explicit EosLawOf(Law law) : law_(law) {}
  Real pressure(Real mu, Real E) const override { return law_.A(mu) + law_.B(mu) * E; }
  Real sound_speed2(Real rho0, Real mu, Real E) const override {
    return sound_speed2_of(law_, rho0, mu, E, pressure(mu, E));
  }
  Real slope(Real mu, Real E) const override { return law_.dA(mu) + law_.dB(mu) * E; }
  bool uses_energy() const override { return law_.uses_energy(); }
  Real mu_limit() const override { return mu_limit_of(law_); }
  std::shared_ptr<EosLaw> at_density(Real rho0) const override {
    if constexpr (requires { law_.at_density(rho0); })
      return with_law(law_.at_density(rho0), rho0);
    else
      return specific_E0 == 0 ? nullptr : with_law(law_, rho0);
  }
  std::shared_ptr<Material> make_pass(EosPart part, World& world) const override {
    return std::make_shared<EosPass<Law>>(law_, std::move(part), world);
  }

 private:
  std::shared_ptr<EosLaw> with_law(Law law, Real rho0) const {
    auto out = std::make_shared<EosLawOf<Law>>(law);
    out->E0 = E0 + rho0 * specific_E0;
    out->V0 = V0;
    return out;
  }
  Law law_;
};

/// Card must have members eosid and functions law(), e0(), v0(), and may have specific_e0(). A law whose
/// formula holds the reference density gives A and dA for the density 1 and has at_density(rho0); one that
/// ends somewhere in compression has mu_limit().
template <class Card>
struct RegisterEos {
  RegisterEos(std::string equation, std::string source, std::vector<EosReference> references,
              KeywordOf<Card> keyword) {
    EosEntry entry;
    entry.keyword = keyword.names.front();
    entry.equation = std::move(equation);
    entry.source = std::move(source);
    entry.references = std::move(references);
    entry.all = [](const Deck& deck) {
      std::vector<std::pair<Id, std::shared_ptr<EosLaw>>> laws;
      for (const Card& card : deck.all<Card>()) {
        auto law = std::make_shared<EosLawOf<decltype(card.law())>>(card.law());
        law->E0 = card.e0();
        law->V0 = card.v0();
        if constexpr (requires { card.specific_e0(); }) law->specific_E0 = card.specific_e0();
        laws.emplace_back(card.eosid, law);
      }
      return laws;
    };
    eos_registry().push_back(std::move(entry));
    register_keyword(make_keyword_spec<Card>(std::move(keyword)));
  }
};

}  // namespace courant
