#include <algorithm>

#include "keyword/expectations.hpp"
#include "laws/materials/viscoelastic_cards.hpp"
#include "laws/most_history.hpp"
#include "laws/strength/prony_series.hpp"

namespace courant {

namespace {

struct MatGeneralViscoelastic : MatGeneralViscoelasticFields {
  static std::vector<PronyTerm> terms(const std::vector<Real>& modulus, const std::vector<Real>& rate) {
    std::vector<PronyTerm> out;
    for (std::size_t k = 0; k < modulus.size(); ++k)
      if (modulus[k] != 0) out.push_back({modulus[k], rate[k]});
    return out;
  }
  std::vector<PronyTerm> shear() const { return terms(gi, betai); }
  std::vector<PronyTerm> volume() const {
    auto given = terms(ki, betaki);
    return given.empty() ? std::vector<PronyTerm>{{bulk, 0}} : given;
  }
  std::shared_ptr<StrengthLaw> law() const { return std::make_shared<PronySeries>(ro, shear(), volume()); }

  void check(const Deck& deck, Diagnostics& diagnostics) const {
    const auto expect = expectations_of(*this, deck, diagnostics);
    const auto decaying = [](const std::vector<PronyTerm>& of) {
      return std::count_if(of.begin(), of.end(), [](const PronyTerm& term) { return term.rate > 0; });
    };
    // stresses of terms turn with the body, and elements turn two tensors of a law
    constexpr long most_shear = 2, most_bulk = most_history - 6 * most_shear;
    expect(decaying(shear()) <= most_shear, "GI", "up to two terms with a BETAI",
           static_cast<Real>(decaying(shear())),
           "more are not supported; terms without BETAI are not limited");
    expect(decaying(terms(ki, betaki)) <= most_bulk, "KI", "up to twelve terms with a BETAKI",
           static_cast<Real>(decaying(terms(ki, betaki))), "more are not supported");
    const auto sum = [](const std::vector<PronyTerm>& of) {
      Real out = 0;
      for (const PronyTerm& term : of) out += term.modulus;
      return out;
    };
    for (const auto& [field, of] : {std::pair{"GI", gi}, {"KI", ki}})
      for (const Real modulus : of)
        if (!(modulus >= 0)) {
          expect(false, field, "moduli that are not negative", modulus, "a negative term creates energy");
          break;
        }
    expect(sum(shear()) > 0, "GI", "a shear modulus", 0, "give at least one term GI with its BETAI");
    expect(sum(volume()) > 0, "BULK", "a number > 0", bulk, "or give terms KI of the bulk modulus");
    if (!terms(ki, betaki).empty() && bulk != 0)
      deck.warning(diagnostics, *this, "BULK", "has no effect beside KI",
                   "the bulk modulus is the sum of the terms KI");
  }
};

// By hand. dt = 1/2. G: 1 that stays, 2 with a rate of 2 ln 2 (f = 1/2, (1 - f)/(2 ln 2) = 1/(4 ln 2) is what
// a unit rate leaves), 4 with a rate of 4 ln 2 (f = 1/4, 3/4 over 4 ln 2). Of D dt = (2, -1, -1), D = (4, -2,
// -2): m = 2 2/(4 ln 2) D = D/ln 2, and 2 4 3/(16 ln 2) D = 3/2 D/ln 2. K: 5/3 that stays, 3 with a rate of 2
// ln 2: of D dt = (1, 1, 1) 5 and 3/(4 ln 2) 6.
constexpr Real ln_2_of_terms = 0.69314718055994531;
const std::string two_rates_of_shear =
    "1,2.0,1.6666666666666667\n\n1.0\n2.0,1.3862943611198906\n4.0,2.7725887222397811\n";
const std::string rates_of_both = "1,2.0\n\n3.0,0.0,1.6666666666666667\n0.0,0.0,3.0,1.3862943611198906\n";
const RegisterStrength<MatGeneralViscoelastic> mat_general_viscoelastic{
    "s = 2 int G(t - u) dev(D)(u) du, -p = int K(t - u) tr(D)(u) du, G = sum GI exp(-BETAI t), K = BULK or "
    "sum KI "
    "exp(-BETAKI t), turned with the body",
    "Christensen 1980; Herrmann & Peterson 1968",
    {{two_rates_of_shear,
      {2, -1, -1},
      {},
      {4 + 10 / ln_2_of_terms, -2 - 5 / ln_2_of_terms, -2 - 5 / ln_2_of_terms},
      {},
      {4 / ln_2_of_terms, -2 / ln_2_of_terms, -2 / ln_2_of_terms, 0, 0, 0, 6 / ln_2_of_terms,
       -3 / ln_2_of_terms, -3 / ln_2_of_terms, 0, 0, 0}},
     {two_rates_of_shear,
      {},
      {3, -1, -2, 0, 5, 0},
      {1, 0, -1, 0, 1.75, 0},
      {1, 1, -2, 0, 2, 0, 2, -2, 0, 0, 3, 0},
      {0.5, 0.5, -1, 0, 1, 0, 0.5, -0.5, 0, 0, 0.75, 0}},
     {rates_of_both,
      {1, 1, 1, 0.5, 0, 0},
      {},
      {5 + 4.5 / ln_2_of_terms, 5 + 4.5 / ln_2_of_terms, 5 + 4.5 / ln_2_of_terms, 3, 0, 0},
      {},
      {4.5 / ln_2_of_terms}}},
    mat_general_viscoelastic_table()};

}  // namespace

}  // namespace courant
