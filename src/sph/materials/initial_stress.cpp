// *INITIAL_STRESS_SPH: particles that start under pressure.
#include "sph/materials/initial_stress.hpp"
#include "sph/materials/material_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/sets/id_index.hpp"

namespace courant {

namespace {

const RegisterKeyword<InitialStressSph> initial_stress_sph_keyword{initial_stress_sph_table()};

/// Grows from a toward b until f changes sign between them; false if it does not. f(a) != 0 on entry.
template <class F>
bool bracket(const F& f, Real step, Real low, Real high, Real& a, Real& b) {
  const Real side = f(a);
  for (int k = 0; k < 200; ++k, step *= 1.5) {
    b = std::clamp(a + step, low, high);
    const Real there = f(b);
    if (!std::isfinite(there)) return false;
    if ((there > 0) != (side > 0)) return true;
    if (b == low || b == high) return false;
    a = b;
  }
  return false;
}

class Pressures {
 public:
  Pressures(const Deck& deck, const Model& model, const std::vector<PartMaterial>& materials, World& world,
            Diagnostics& diagnostics)
      : deck_(deck), model_(model), materials_(materials), world_(world), diagnostics_(diagnostics) {}

  void set() {
    Id lowest = 0, highest = 0;
    for (const ModelSph& s : model_.sph) {
      const Id id = model_.nodes[s.node].id;
      lowest = &s == model_.sph.data() ? id : std::min(lowest, id);
      highest = std::max(highest, id);
    }
    particle_of_id_ = IdIndex(lowest, highest, model_.sph.size());
    for (std::size_t i = 0; i < model_.sph.size(); ++i)
      particle_of_id_.insert(model_.nodes[model_.sph[i].node].id, static_cast<Index>(i));
    std::vector<const InitialStressSph*> card_of(model_.sph.size(), nullptr);
    for (const InitialStressSph& card : deck_.all<InitialStressSph>()) {
      const Index i = particle(card);
      if (i < 0 || !isotropic(card)) continue;
      if (const auto* first = card_of[static_cast<std::size_t>(i)])
        error(card, "EID",
              fmt::format("particle {} has a stress already, given at {}", card.eid, deck_.place(*first)),
              "keep one of the two");
      else
        card_of[static_cast<std::size_t>(i)] = &card, set(card, i);
    }
    if (errors_ > most_errors)
      diagnostics_.note(
          deck_.where(deck_.all<InitialStressSph>().front()),
          fmt::format("{} more faults of *INITIAL_STRESS_SPH are not shown", errors_ - most_errors));
  }

 private:
  void error(const InitialStressSph& card, std::string_view field, std::string message, std::string hint) {
    if (++errors_ <= most_errors) deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  Index particle(const InitialStressSph& card) {
    const Index i = particle_of_id_.find(card.eid);
    if (i < 0)
      error(card, "EID", fmt::format("there is no particle {}", card.eid),
            "define it with *ELEMENT_SPH: a particle has the id of its node");
    return i;
  }

  bool isotropic(const InitialStressSph& card) {
    const Real sigma[] = {card.sigxx, card.sigyy, card.sigzz};
    const char* names[] = {"SIGXX", "SIGYY", "SIGZZ"};
    for (int k = 1; k < 3; ++k) {
      if (sigma[k] == sigma[0]) continue;
      error(card, names[k], fmt::format("expected SIGXX = {:g}, got '{:g}'", sigma[0], sigma[k]),
            "a fluid at rest bears a pressure alone: SIGXX = SIGYY = SIGZZ = -p");
      return false;
    }
    return true;
  }

  void set(const InitialStressSph& card, Index i) {
    const PartMaterial& m = materials_[static_cast<std::size_t>(model_.sph[i].part)];
    if (!m.eos || m.strength) {
      error(card, "EID",
            fmt::format("particle {} is of a material with strength, whose stress starts at 0", card.eid),
            "particles of *MAT_NULL alone can start under pressure");
      return;
    }
    const Real p = -card.sigxx;
    if (p < m.pc) {
      error(card, "SIGXX",
            fmt::format("the pressure {:g} is below PC = {:g}, the largest tension of the material", p, m.pc),
            "give a pressure from PC on, or lower PC of *MAT_NULL");
      return;
    }
    const auto mu = compression_at(*m.eos, m.ro, p);
    if (mu)
      world_.particles.rho[i] = m.ro * (1 + *mu);
    else
      error(
          card, "SIGXX",
          fmt::format("the equation of state of part {} has no density with the pressure {:g} and the energy "
                      "E0 = {:g}",
                      model_.parts[static_cast<std::size_t>(model_.sph[i].part)].id, p, m.eos->E0),
          "check the pressure and its units");
  }

  const Deck& deck_;
  const Model& model_;
  const std::vector<PartMaterial>& materials_;
  World& world_;
  Diagnostics& diagnostics_;
  IdIndex particle_of_id_;
  int errors_ = 0;
  static constexpr int most_errors = 20;
};

}  // namespace

std::optional<Real> compression_at(const EosLaw& law, Real rho0, Real p) {
  // Beyond 100-fold compression no law of a liquid or solid means anything.
  const Real low = -1 + 1e-9, high = std::min((1 - 1e-9) * law.mu_limit(), Real(100));
  const auto f = [&](Real mu) { return law.pressure(mu, law.E0) - p; };
  const Real start = 1 / law.V0 - 1;
  Real a = start, b = start;
  if (f(a) != 0) {
    const Real slope = law.slope(a, law.E0);
    if (!(slope > 0)) return std::nullopt;
    const Real step = -f(a) / slope;
    if (!bracket(f, step, low, high, a, b)) return std::nullopt;
  }
  if (f(a) > 0) std::swap(a, b);  // from here on f(a) <= 0 <= f(b)
  Real mu = std::abs(f(a)) < std::abs(f(b)) ? a : b;
  for (int k = 0; k < 200; ++k) {
    const Real value = f(mu);
    (value < 0 ? a : b) = mu;
    Real next = mu - value / law.slope(mu, law.E0);
    constexpr Real round_off = 1e-16;  // of 1 + mu
    if (std::abs(next - mu) <= round_off || std::abs(a - b) <= round_off) break;
    if (!((next - a) * (next - b) < 0)) next = 0.5 * (a + b);  // Newton leaves the bracket: halve it
    mu = next;
  }
  if (!(law.sound_speed2(rho0, mu, law.E0) > 0)) return std::nullopt;
  return mu;
}

void set_initial_pressures(const Deck& deck, const Model& model, const std::vector<PartMaterial>& materials,
                           World& world, Diagnostics& diagnostics) {
  if (!deck.all<InitialStressSph>().empty()) Pressures(deck, model, materials, world, diagnostics).set();
}

void release_initial_stresses(Deck& deck) {
  deck.release<InitialStressSph>();
}

}  // namespace courant
