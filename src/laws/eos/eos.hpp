#pragma once
// Equations of state p = A(mu) + B(mu) E with mu = rho/rho0 - 1 and E the internal energy per reference
// volume. A law is a small struct with A, B and their derivatives; one file per law registers it with its
// card; nothing else is edited. Laws do not depend on particles, elements or world.
#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "keyword/deck.hpp"
#include "keyword/registry.hpp"
#include "laws/check_cards.hpp"
#include "model/model.hpp"

namespace courant {

/// Points of one material that a law evaluates at once, as plain arrays. [M/LT2], [-]
struct EosBlock {
  Index count = 0;
  const Real* mu = nullptr;  ///< rho/rho0 - 1
  Real *A = nullptr, *dA = nullptr;
  Real *B = nullptr, *dB = nullptr;  ///< null: not requested
  /// Memory of a law for each point (EosLaw::memory), which is updated; null: as at the start.
  Real* memory = nullptr;
};

/// A law with a memory of the greatest compression of a point: A(mu, most), dA(mu, most), and stiffness(mu,
/// most), dp/dmu of the steepest path from there, which gives the sound speed. `memory` is the name of the
/// field.
template <class Law>
concept RemembersCompression = requires {
  Law::memory;
};

/// A law read from the deck, or made for a test.
class EosLaw {
 public:
  virtual ~EosLaw() = default;
  virtual std::string name() const = 0;
  /// A and dA/dmu of a block, and B and dB/dmu where they are requested. For a law with a memory dA/dmu is
  /// that of the steepest further path.
  virtual void evaluate(const EosBlock& block) const = 0;
  /// Name of the memory of each point, the greatest mu so far; null: none.
  virtual const char* memory() const { return nullptr; }
  Real memory_at_start() const { return 1 / V0 - 1; }  ///< [-]
  // For a law with a memory, these are for a point without a greater compression before.
  virtual Real pressure(Real mu, Real E) const = 0;  ///< [M/LT2]
  virtual Real slope(Real mu, Real E) const = 0;     ///< dp/dmu at constant E [M/LT2]
  /// c^2 = dp/drho at constant entropy = (dp/dmu + B p / (1 + mu)^2) / rho0, from dE = -p dv with v = 1/(1 +
  /// mu). [L2/T2]
  virtual Real sound_speed2(Real rho0, Real mu, Real E) const = 0;
  virtual bool uses_energy() const = 0;
  virtual Real mu_limit() const = 0;  ///< the law holds below; infinite if it always holds
  /// The field that makes a nearly incompressible liquid stiffer, "C1"; empty where the law is made for large
  /// changes of volume: a shock curve, a table, a gas.
  virtual std::string stiffness_field() const = 0;
  /// The same law for a material with another reference density than 1; nullptr where that makes no
  /// difference.
  virtual std::shared_ptr<EosLaw> at_density(Real rho0) const = 0;
  Real E0 = 0;           ///< initial internal energy per reference volume [M/LT2]
  Real V0 = 1;           ///< initial relative volume rho0/rho
  Real specific_E0 = 0;  ///< added to E0, times the reference density [L2/T2]
};

/// A value that a law must return, computed by hand from its formula, for the generic test.
struct EosReference {
  std::string deck;  ///< the keyword's cards, as in a deck
  Real mu, E, p;
  Real rho0 = 1;
};

struct EosEntry {
  std::string keyword, equation, source;
  std::vector<EosReference> references;
  /// Every law of this kind in a deck. The model has the curves.
  std::function<std::vector<std::pair<Id, std::shared_ptr<EosLaw>>>(const Deck&, const Model&)> all;
  /// Checks of its cards beyond those of the table of the keyword.
  std::function<void(const Deck&, const Model&, Diagnostics&)> check;
};

std::vector<EosEntry>& eos_registry();

template <class Law>
class EosLawOf : public EosLaw {
 public:
  explicit EosLawOf(Law law) : law_(law) {}
  std::string name() const override { return Law::name; }
  void evaluate(const EosBlock& block) const override {
    const Law law = law_;
    const Real* mu = block.mu;
    Real *A = block.A, *dA = block.dA;
    if constexpr (RemembersCompression<Law>) {
      for (Index k = 0; k < block.count; ++k) {
        const Real most = std::max(block.memory ? block.memory[k] : memory_at_start(), mu[k]);
        A[k] = law.A(mu[k], most), dA[k] = law.stiffness(mu[k], most);
        if (block.memory) block.memory[k] = most;
      }
    } else {
#pragma omp simd
      for (Index k = 0; k < block.count; ++k) A[k] = law.A(mu[k]), dA[k] = law.dA(mu[k]);
    }
    if (!block.B) return;
    Real *B = block.B, *dB = block.dB;
    for (Index k = 0; k < block.count; ++k) B[k] = law.B(mu[k]), dB[k] = law.dB(mu[k]);
  }
  const char* memory() const override {
    if constexpr (RemembersCompression<Law>)
      return Law::memory;
    else
      return nullptr;
  }
  Real pressure(Real mu, Real E) const override {
    return first(mu).A + law_.B(mu) * E;
  }
  Real slope(Real mu, Real E) const override {
    return first(mu).dA + law_.dB(mu) * E;
  }
  Real sound_speed2(Real rho0, Real mu, Real E) const override {
    return (first(mu).stiffness + law_.dB(mu) * E + law_.B(mu) * pressure(mu, E) / ((1 + mu) * (1 + mu))) /
           rho0;
  }
  bool uses_energy() const override {
    return law_.uses_energy();
  }
  Real mu_limit() const override {
    if constexpr (requires { law_.mu_limit(); })
      return law_.mu_limit();
    else
      return std::numeric_limits<Real>::infinity();
  }
  std::string stiffness_field() const override {
    if constexpr (requires { law_.stiffness_field(); })
      return law_.stiffness_field();
    else
      return "its bulk modulus";
  }
  std::shared_ptr<EosLaw> at_density(Real rho0) const override {
    if constexpr (requires { law_.at_density(rho0); })
      return with_law(law_.at_density(rho0), rho0);
    else
      return specific_E0 == 0 ? nullptr : with_law(law_, rho0);
  }

 private:
  struct Cold {
    Real A, dA, stiffness;
  };
  /// Without energy, for a point that was never more compressed.
  Cold first(Real mu) const {
    if constexpr (RemembersCompression<Law>) {
      const Real most = std::max(mu, memory_at_start());
      return {law_.A(mu, most), law_.dA(mu, most), law_.stiffness(mu, most)};
    } else {
      const Real slope = law_.dA(mu);
      return {law_.A(mu), slope, slope};
    }
  }
  std::shared_ptr<EosLaw> with_law(Law law, Real rho0) const {
    auto out = std::make_shared<EosLawOf<Law>>(law);
    out->E0 = E0 + rho0 * specific_E0;
    out->V0 = V0;
    return out;
  }
  Law law_;
};

/// Card must have members eosid and functions law(), e0(), v0(), and may have specific_e0(); law() takes the
/// model where it needs its curves. A law whose
/// formula holds the reference density gives A and dA for the density 1 and has at_density(rho0); one that
/// ends somewhere in compression has mu_limit(); one with stiffness_field() names a field, or none.
/// The card may have check(deck, diagnostics), or with the
/// model between both.
template <class Card>
struct RegisterEos {
  RegisterEos(std::string equation, std::string source, std::vector<EosReference> references,
              KeywordOf<Card> keyword)
      : RegisterEos(std::move(equation), std::move(source), std::move(references),
                    table_of(std::move(keyword))) {}
  template <std::same_as<KeywordTable> Made>
  RegisterEos(std::string equation, std::string source, std::vector<EosReference> references, Made keyword) {
    EosEntry entry;
    entry.keyword = keyword.names.front();
    entry.equation = std::move(equation);
    entry.source = std::move(source);
    entry.references = std::move(references);
    entry.all = [](const Deck& deck, const Model& model) {
      std::vector<std::pair<Id, std::shared_ptr<EosLaw>>> laws;
      for (const Card& card : deck.all<Card>()) {
        const auto make = [&] {
          if constexpr (requires { card.law(model); })
            return card.law(model);
          else
            return card.law();
        };
        auto law = std::make_shared<EosLawOf<decltype(make())>>(make());
        law->E0 = card.e0();
        law->V0 = card.v0();
        if constexpr (requires { card.specific_e0(); }) law->specific_E0 = card.specific_e0();
        laws.emplace_back(card.eosid, law);
      }
      return laws;
    };
    entry.check = &check_cards<Card>;
    eos_registry().push_back(std::move(entry));
    register_keyword(make_keyword_spec<Card>(std::move(keyword)));
  }
};

}  // namespace courant
