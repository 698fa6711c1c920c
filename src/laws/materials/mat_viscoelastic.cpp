#include <fmt/format.h>

#include "keyword/expectations.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/materials/viscoelastic_cards.hpp"
#include "laws/strength/prony_series.hpp"

namespace courant {

namespace {

/// The standard linear solid in shear: GI beside a Maxwell element of G0 - GI.
std::shared_ptr<StrengthLaw> standard_solid(Real ro, Real bulk, Real g0, Real gi, Real rate) {
  return std::make_shared<PronySeries>(ro, std::vector<PronyTerm>{{gi, 0}, {g0 - gi, rate}},
                                       std::vector<PronyTerm>{{bulk, 0}});
}

struct MatViscoelastic : MatViscoelasticFields {
  std::shared_ptr<StrengthLaw> law() const { return standard_solid(ro, bulk, g0, gi, beta); }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    if (!(gi <= g0))
      deck.error(diagnostics, *this, "GI", fmt::format("expected a number <= G0, got '{:g}'", gi),
                 "G(t) = GI + (G0 - GI) exp(-BETA t) falls with time");
  }
};

// By hand. BULK = 5/3, G0 = 3, GI = 1, BETA = 2 ln 2, dt = 1/2: f = 1/2, (1 - f)/(BETA dt) = 1/(2 ln 2). Of
// the deviator (2, -1, -1): m = 2/ln 2 of it, and 2 of it stay. Without strain m is halved. Of the volume
// alone, D dt = (1, 1, 1): 5.
constexpr Real relaxing_part = 2.8853900817779268;
std::vector<StrengthReference> relaxes(const std::string& cards) {
  return {{cards,
           {2, -1, -1},
           {},
           {2 * (2 + relaxing_part), -2 - relaxing_part, -2 - relaxing_part},
           {},
           {2 * relaxing_part, -relaxing_part, -relaxing_part, 0, 0, 0}},
          {cards,
           {},
           {6, -3, -3, 2, 0, 0},
           {5, -2.5, -2.5, 1.5, 0, 0},
           {2, -1, -1, 1, 0, 0},
           {1, -0.5, -0.5, 0.5, 0, 0}},
          {"1,2.0,1.6666666666666667,3.0,1.0\n", {1, 1, 1, 0.5, 0, 0}, {}, {5, 5, 5, 3, 0, 0}}};
}
const RegisterStrength<MatViscoelastic> mat_viscoelastic{
    "s = 2 int G(t - u) dev(D)(u) du, G(t) = GI + (G0 - GI) exp(-BETA t), turned with the body; pressure by "
    "BULK",
    "Herrmann & Peterson 1968", relaxes("1,2.0,1.6666666666666667,3.0,1.0,1.3862943611198906\n"),
    mat_viscoelastic_table()};

/// FO 0: ds/dt by the exponential; FO 1: ds/dt + s/DC = 2 G0 de/dt + 2 GI e/DC, which is the same with a rate
/// of 1/DC.
struct MatKelvinMaxwellViscoelastic : MatKelvinMaxwellViscoelasticFields {
  std::shared_ptr<StrengthLaw> law() const {
    return standard_solid(ro, bulk, g0, gi, fo == 0 || dc == 0 ? dc : 1 / dc);
  }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    const auto expect = expectations_of(*this, deck, diagnostics);
    expect(gi <= g0, "GI", "a number <= G0", gi, "the shear modulus falls with time");
    expect(fo == 0 || fo == 1, "FO", "0 or 1", fo, "0: Maxwell, 1: Kelvin");
    if (fo == 1) expect(dc > 0, "DC", "a number > 0", dc, "the time in which stress relaxes");
  }
};

const RegisterStrength<MatKelvinMaxwellViscoelastic> mat_kelvin_maxwell_viscoelastic{
    "s = 2 int G(t - u) dev(D)(u) du, G(t) = GI + (G0 - GI) exp(-t DC) or exp(-t/DC), turned with the body; "
    "pressure "
    "by BULK",
    "Herrmann & Peterson 1968; the solid of three parameters",
    [] {
      auto out = relaxes("1,2.0,1.6666666666666667,3.0,1.0,1.3862943611198906\n");
      for (StrengthReference& kelvin : relaxes("1,2.0,1.6666666666666667,3.0,1.0,0.72134752044448170,1.0\n"))
        if (!kelvin.new_history.empty()) out.push_back(std::move(kelvin));
      return out;
    }(),
    mat_kelvin_maxwell_viscoelastic_table()};

}  // namespace

std::string convert_decay(MatKelvinMaxwellViscoelasticFields& card, const Conversion& conversion) {
  card.dc *= conversion.units.of(card.fo == 0 ? "1/T" : "T");
  return "";
}

}  // namespace courant
