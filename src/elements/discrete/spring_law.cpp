#include "elements/discrete/spring_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/straight_pieces.hpp"
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

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

struct SpringCard : Entry {
  std::string title;
  Id mid = 0;
};

struct MatSpringElastic : SpringCard {
  Real k = 0;
  std::shared_ptr<SpringLaw> law(const Reader&) const { return std::make_shared<Elastic>(k); }
};
struct MatDamperViscous : SpringCard {
  Real dc = 0;
  std::shared_ptr<SpringLaw> law(const Reader&) const { return std::make_shared<Viscous>(dc); }
};
struct MatSpringElastoplastic : SpringCard {
  Real k = 0, kt = 0, fy = 0;
  std::shared_ptr<SpringLaw> law(const Reader& reader) const {
    if (kt < k) return std::make_shared<Elastoplastic>(k, kt, fy);
    reader.deck.error(reader.diagnostics, *this, "KT",
                      fmt::format("expected less than K = {:g}, got '{:g}'", k, kt),
                      "it is the slope of force over stretch beyond FY");
    return nullptr;
  }
};
struct MatSpringNonlinearElastic : SpringCard {
  Id lcd = 0, lcr = 0;
  std::shared_ptr<SpringLaw> law(const Reader& reader) const {
    const Curve* force = reader.curve(*this, "LCD", lcd);
    const Curve* factor = lcr == 0 ? nullptr : reader.curve(*this, "LCR", lcr);
    if (!force || (lcr != 0 && !factor)) return nullptr;
    return std::make_shared<NonlinearElastic>(*force, factor);
  }
};
struct MatDamperNonlinearViscous : SpringCard {
  Id lcdr = 0;
  std::shared_ptr<SpringLaw> law(const Reader& reader) const {
    const Curve* force = reader.curve(*this, "LCDR", lcdr);
    return force ? std::make_shared<NonlinearViscous>(*force) : nullptr;
  }
};

template <class Card>
KeywordOf<Card> keyword(const char* name, const char* number, const char* purpose,
                        std::vector<FieldOf<Card>> fields) {
  KeywordOf<Card> out{.names = {name, number},
                      .purpose = purpose,
                      .id_space = IdSpace::material,
                      .title_option = true,
                      .title = &Card::title,
                      .cards = {{.fields = std::move(fields)}}};
  return out;
}

using rules::required_id;
using rules::required_id_of;
constexpr FieldRules at_least_0{.check = Check::not_negative};
constexpr FieldRules given{.required = true, .check = Check::not_negative};
constexpr FieldRules above_0{.required = true, .check = Check::positive};

using S1 = MatSpringElastic;
const RegisterKeyword<S1> s01{
    keyword<S1>("MAT_SPRING_ELASTIC", "MAT_S01", "spring: force K times stretch",
                {{"MID", &S1::mid, "-", "id that *PART refers to", required_id},
                 {"K", &S1::k, "M/T2", "stiffness; of torsional springs moment per radian", given}})};
using S2 = MatDamperViscous;
const RegisterKeyword<S2> s02{
    keyword<S2>("MAT_DAMPER_VISCOUS", "MAT_S02", "damper: force DC times the rate of the stretch",
                {{"MID", &S2::mid, "-", "id that *PART refers to", required_id},
                 {"DC", &S2::dc, "M/T", "damping; of torsional ones moment per radian and time", given}})};
using S3 = MatSpringElastoplastic;
const RegisterKeyword<S3> s03{keyword<S3>("MAT_SPRING_ELASTOPLASTIC", "MAT_S03",
                                          "spring that yields, with isotropic hardening",
                                          {{"MID", &S3::mid, "-", "id that *PART refers to", required_id},
                                           {"K", &S3::k, "M/T2", "elastic stiffness", above_0},
                                           {"KT", &S3::kt, "M/T2", "slope beyond FY", at_least_0},
                                           {"FY", &S3::fy, "ML/T2", "force at which it yields", above_0}})};
using S4 = MatSpringNonlinearElastic;
const RegisterKeyword<S4> s04{keyword<S4>(
    "MAT_SPRING_NONLINEAR_ELASTIC", "MAT_S04", "spring whose force is a curve of its stretch",
    {{"MID", &S4::mid, "-", "id that *PART refers to", required_id},
     {"LCD", &S4::lcd, "-", "force over stretch, linear beyond its ends", required_id_of(IdSpace::curve)},
     {"LCR", &S4::lcr, "-", "factor on it over the rate, 0 none", rules::optional_id_of(IdSpace::curve)}})};
using S5 = MatDamperNonlinearViscous;
const RegisterKeyword<S5> s05{keyword<S5>(
    "MAT_DAMPER_NONLINEAR_VISCOUS", "MAT_S05", "damper whose force is a curve of the rate",
    {{"MID", &S5::mid, "-", "id that *PART refers to", required_id},
     {"LCDR", &S5::lcdr, "-", "force over rate, linear beyond its ends", required_id_of(IdSpace::curve)}})};

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
