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

const RegisterKeyword<MatSpringElastic> s01{mat_spring_elastic_table()};
const RegisterKeyword<MatDamperViscous> s02{mat_damper_viscous_table()};
const RegisterKeyword<MatSpringElastoplastic> s03{mat_spring_elastoplastic_table()};
const RegisterKeyword<MatSpringNonlinearElastic> s04{mat_spring_nonlinear_elastic_table()};
const RegisterKeyword<MatDamperNonlinearViscous> s05{mat_damper_nonlinear_viscous_table()};

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
  return laws;
}

const char* spring_keywords() {
  return "*MAT_SPRING_ELASTIC, *MAT_DAMPER_VISCOUS, *MAT_SPRING_ELASTOPLASTIC, "
         "*MAT_SPRING_NONLINEAR_ELASTIC, *MAT_DAMPER_NONLINEAR_VISCOUS";
}

}  // namespace courant
