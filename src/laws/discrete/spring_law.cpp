#include "laws/discrete/spring_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/straight_pieces.hpp"
#include "keyword/registry.hpp"
#include "laws/discrete/discrete_law_cards.hpp"

namespace courant {

namespace {

/// Stretches that the next step may reach, too.
constexpr Real ahead = 2;

struct Elastic : SpringLaw {
  Real k;
  explicit Elastic(Real stiffness) : k(stiffness) {}
  SpringAnswer answer(const SpringMotion& m, Real*) const override { return {k * m.stretch, std::abs(k), 0}; }
};

struct Viscous : SpringLaw {
  Real c;
  explicit Viscous(Real damping) : c(damping) {}
  SpringAnswer answer(const SpringMotion& m, Real*) const override { return {c * m.rate, 0, std::abs(c)}; }
};

/// Isotropic hardening: the limit FY grows with the plastic stretch s by K KT/(K - KT). State: force, s.
struct Elastoplastic : SpringLaw {
  Real k, hardening, yield;
  Elastoplastic(Real stiffness, Real tangent, Real fy)
      : k(stiffness), hardening(stiffness * tangent / (stiffness - tangent)), yield(fy) {}
  SpringAnswer answer(const SpringMotion& m, Real* state) const override {
    const Real trial = state[0] + k * m.change, beyond = std::abs(trial) - (yield + hardening * state[1]);
    state[0] = trial;
    if (beyond > 0) {
      const Real plastic = beyond / (k + hardening);
      state[0] -= std::copysign(k * plastic, trial);
      state[1] += plastic;
    }
    return {state[0], k, 0};
  }
};

struct NonlinearElastic : SpringLaw {
  StraightPieces force, by_rate;
  NonlinearElastic(const Curve& f, const Curve* factor) : force(f.abscissa, f.ordinate) {
    if (factor) by_rate = {factor->abscissa, factor->ordinate};
  }
  SpringAnswer answer(const SpringMotion& m, Real*) const override {
    const Real reach = ahead * std::abs(m.change), f = force(m.stretch);
    SpringAnswer out{f, force.steepest(m.stretch - reach, m.stretch + reach), 0};
    if (!by_rate.empty()) {
      const Real factor = by_rate(m.rate),
                 steep = by_rate.steepest(std::min(m.rate, Real(0)), std::max(m.rate, Real(0)));
      out = {f * factor, out.stiffness * std::abs(factor), std::abs(f) * steep};
    }
    return out;
  }
};

struct NonlinearViscous : SpringLaw {
  StraightPieces force;
  explicit NonlinearViscous(const Curve& f) : force(f.abscissa, f.ordinate) {}
  SpringAnswer answer(const SpringMotion& m, Real*) const override {
    const Real reach = ahead * std::abs(m.rate);
    return {force(m.rate), 0, force.steepest(m.rate - reach, m.rate + reach)};
  }
};

/// Force KI times stretch, and beside it a spring of stiffness K0 - KI whose force decays with BETA. State:
/// the force of that.
struct Maxwell : SpringLaw {
  Real short_time, long_time, decay;
  Maxwell(Real k0, Real ki, Real beta) : short_time(k0), long_time(ki), decay(beta) {}
  SpringAnswer answer(const SpringMotion& m, Real* state) const override {
    const Real x = decay * m.dt, mean = x > 0 ? -std::expm1(-x) / x : 1;  // of exp(-BETA t) over the step
    state[0] = std::exp(-x) * state[0] + (short_time - long_time) * mean * m.change;
    return {long_time * m.stretch + state[0], std::max(short_time, long_time), 0};
  }
};

/// A spring that holds in compression (side -1) or tension (1) alone: along the curve where it yields, along
/// a straight line where it unloads. State: the stretch at which the line comes to zero.
struct Inelastic : SpringLaw {
  StraightPieces force;
  Real unload, side;
  Inelastic(const Curve& f, Real ku, Real of) : force(f.abscissa, f.ordinate), side(of) {
    const Real steepest = force.steepest(f.abscissa.front(), f.abscissa.back());
    unload = std::max(ku, steepest);
  }
  SpringAnswer answer(const SpringMotion& m, Real* state) const override {
    const Real c = side * m.stretch, most = std::max(force(c), Real(0));
    Real f = std::max(unload * (c - state[0]), Real(0));
    if (f > most) f = most, state[0] = c - f / unload;
    return {side * f, unload, 0};
  }
};

/// Where the cards of materials find their curves.
struct Reader {
  const Deck& deck;
  const Model& model;
  Diagnostics& diagnostics;
  const Curve* curve(const Entry& card, const char* field, Id id) const {
    const auto found = model.curves.find(id);
    const auto error = [&](std::string what, const char* hint) {
      deck.error(diagnostics, card, field, std::move(what), hint);
      return nullptr;
    };
    if (found == model.curves.end())
      return error(fmt::format("curve {} does not exist", id), "define it with *DEFINE_CURVE");
    const std::vector<Real>& x = found->second.abscissa;
    if (x.size() < 2) return error(fmt::format("curve {} has one point", id), "a spring needs two or more");
    if (std::adjacent_find(x.begin(), x.end(), [](Real a, Real b) { return !(b > a); }) != x.end())
      return error(fmt::format("curve {} jumps: a spring would be infinitely stiff there", id),
                   "give its points increasing abscissae");
    return &found->second;
  }
};

struct MatSpringElastic : MatSpringElasticFields {
  std::shared_ptr<SpringLaw> law(const Reader&) const { return std::make_shared<Elastic>(k); }
};
struct MatDamperViscous : MatDamperViscousFields {
  std::shared_ptr<SpringLaw> law(const Reader&) const { return std::make_shared<Viscous>(dc); }
};
struct MatSpringElastoplastic : MatSpringElastoplasticFields {
  std::shared_ptr<SpringLaw> law(const Reader& reader) const {
    if (kt < k) return std::make_shared<Elastoplastic>(k, kt, fy);
    reader.deck.error(reader.diagnostics, *this, "KT",
                      fmt::format("expected less than K = {:g}, got '{:g}'", k, kt),
                      "it is the slope of force over stretch beyond FY");
    return nullptr;
  }
};
struct MatSpringNonlinearElastic : MatSpringNonlinearElasticFields {
  std::shared_ptr<SpringLaw> law(const Reader& reader) const {
    const Curve* force = reader.curve(*this, "LCD", lcd);
    const Curve* factor = lcr == 0 ? nullptr : reader.curve(*this, "LCR", lcr);
    if (!force || (lcr != 0 && !factor)) return nullptr;
    return std::make_shared<NonlinearElastic>(*force, factor);
  }
};
struct MatDamperNonlinearViscous : MatDamperNonlinearViscousFields {
  std::shared_ptr<SpringLaw> law(const Reader& reader) const {
    const Curve* force = reader.curve(*this, "LCDR", lcdr);
    return force ? std::make_shared<NonlinearViscous>(*force) : nullptr;
  }
};

struct MatSpringMaxwell : MatSpringMaxwellFields {
  std::shared_ptr<SpringLaw> law(const Reader& reader) const {
    if (tc == 0 || tc >= never) return std::make_shared<Maxwell>(k0, ki, beta);
    reader.deck.error(reader.diagnostics, *this, "TC",
                      fmt::format("'{:g}' (a constant force from then on) is not supported", tc),
                      "leave the field blank");
    return nullptr;
  }
  static constexpr Real never = 1e20;
};
struct MatSpringInelastic : MatSpringInelasticFields {
  std::shared_ptr<SpringLaw> law(const Reader& reader) const {
    const Curve* force = reader.curve(*this, "LCFD", lcfd);
    if (!force) return nullptr;
    if (!(force->abscissa.front() >= 0) || !(force->ordinate.back() > 0)) {
      reader.deck.error(reader.diagnostics, *this, "LCFD",
                        fmt::format("curve {} is not of positive stretches and forces", lcfd),
                        "give magnitudes from 0 on: CTF states whether they are of compression or tension");
      return nullptr;
    }
    auto law = std::make_shared<Inelastic>(*force, ku, ctf == -1 ? 1 : -1);
    if (law->unload > 0) return law;
    reader.deck.error(reader.diagnostics, *this, "KU", "a level curve gives no stiffness to unload with",
                      "give KU");
    return nullptr;
  }
};

const RegisterKeyword<MatSpringElastic> s01{mat_spring_elastic_table()};
const RegisterKeyword<MatDamperViscous> s02{mat_damper_viscous_table()};
const RegisterKeyword<MatSpringElastoplastic> s03{mat_spring_elastoplastic_table()};
const RegisterKeyword<MatSpringNonlinearElastic> s04{mat_spring_nonlinear_elastic_table()};
const RegisterKeyword<MatDamperNonlinearViscous> s05{mat_damper_nonlinear_viscous_table()};
const RegisterKeyword<MatSpringMaxwell> s07{mat_spring_maxwell_table()};
const RegisterKeyword<MatSpringInelastic> s08{mat_spring_inelastic_table()};

template <class Card>
void add_laws(const Reader& reader, std::map<Id, std::shared_ptr<SpringLaw>>& laws) {
  for (const Card& card : reader.deck.all<Card>()) laws[card.mid] = card.law(reader);
}

}  // namespace

std::map<Id, std::shared_ptr<SpringLaw>> find_spring_laws(const Deck& deck, const Model& model,
                                                          Diagnostics& diagnostics) {
  const Reader reader{deck, model, diagnostics};
  std::map<Id, std::shared_ptr<SpringLaw>> laws;
  add_laws<MatSpringElastic>(reader, laws);
  add_laws<MatDamperViscous>(reader, laws);
  add_laws<MatSpringElastoplastic>(reader, laws);
  add_laws<MatSpringNonlinearElastic>(reader, laws);
  add_laws<MatDamperNonlinearViscous>(reader, laws);
  add_laws<MatSpringMaxwell>(reader, laws);
  add_laws<MatSpringInelastic>(reader, laws);
  return laws;
}

const char* spring_keywords() {
  return "*MAT_SPRING_ELASTIC, *MAT_DAMPER_VISCOUS, *MAT_SPRING_ELASTOPLASTIC, "
         "*MAT_SPRING_NONLINEAR_ELASTIC, *MAT_DAMPER_NONLINEAR_VISCOUS, *MAT_SPRING_MAXWELL, "
         "*MAT_SPRING_INELASTIC";
}

}  // namespace courant
