// *MAT_CSCM_CONCRETE: the parameters of *MAT_CSCM by the strength and the aggregate of normal concrete.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "keyword/common_rules.hpp"
#include "keyword/expectations.hpp"
#include "laws/materials/mat_cscm.hpp"

namespace courant {

namespace {

/// A x^2 + B x + C of a strength x.
struct Quadratic {
  Real A, B, C;
  Real operator()(Real x) const { return (A * x + B) * x + C; }
};

/// Of normal concrete, by its strength.
struct MatCscmConcrete : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, incre = 0, erode = 0, recov = 0, pred = 0, fpc = 0, dagg = 0;
  int nplot = 0, irate = 0, itretrc = 0, units = 0;
  // of the deck over the file's, where *INCLUDE_TRANSFORM converts it
  Real to_stress = 1, to_length = 1, to_time = 1;

  static constexpr Real standard_strength = 30, standard_aggregate = 19;  ///< [MPa], [mm]
  /// Units of the deck for 1 MPa, 1 mm, 1 s.
  struct Units {
    Real stress, length, time;
  };
  Units of_deck() const {
    constexpr Real psi = 145.0377377, inch = 25.4;
    constexpr Units all[] = {{1e-3, 1, 1e3}, {1, 1, 1e3}, {1, 1, 1}, {psi, 1 / inch, 1}, {1e6, 1e-3, 1}};
    Units out = all[std::clamp(units, 0, 4)];
    out.stress *= to_stress, out.length *= to_length, out.time *= to_time;
    return out;
  }
  Real strength() const {
    return fpc > 0 ? fpc * to_stress / of_deck().stress : standard_strength;
  }  ///< [MPa]
  Real density() const {
    const Units to = of_deck();
    return ro * 1e12 * to.length * to.length / (to.stress * to.time * to.time);
  }  ///< [kg/m3]
  Real aggregate() const { return dagg > 0 ? dagg * to_length / of_deck().length : standard_aggregate; }

  MatCscmFields parameters() const;
  std::shared_ptr<StrengthLaw> law() const { return make_cscm(parameters()); }
  void check(const Deck& deck, Diagnostics& diagnostics) const;
};

// Murray 2007, chapter 3: fits for strengths from 20 to 58 MPa. Fracture energy by CEB-FIP Model Code
// 1990, 2.1.3.3.2.
MatCscmFields MatCscmConcrete::parameters() const {
  const Units to = of_deck();
  const Real f = strength(), psi = 145.0377377 * f, S = to.stress;
  MatCscmFields c;
  c.mid = mid, c.ro = ro, c.irate = irate, c.erode = erode, c.recov = recov, c.pred = pred;
  const Real E = 18275 * std::cbrt(f / 10) * S, nu = 0.15;
  c.g = E / (2 * (1 + nu)), c.k = E / (3 * (1 - 2 * nu));
  c.alpha = Quadratic{-0.003, 0.3169747, 7.7047}(f)*S, c.lamda = 10.5 * S, c.beta = 1.929e-2 / S;
  c.theta = Quadratic{1.3216e-5, 2.3548e-3, 0.2140058}(f);
  c.alpha1 = 0.74735, c.lamda1 = 0.17, c.beta1 = Quadratic{-1.9972e-5, 2.2655e-4, 8.1748e-2}(f) / S;
  c.theta1 = Quadratic{-4.0856e-7, -1.2132e-6, 1.5593e-3}(f) / S;
  c.alpha2 = 0.66, c.lamda2 = 0.16, c.beta2 = Quadratic{-1.9972e-5, 2.2655e-4, 8.2748e-2}(f) / S;
  c.theta2 = Quadratic{-4.8697e-7, -1.8883e-6, 1.8822e-3}(f) / S;
  c.r = 5, c.xd = Quadratic{8.769178e-3, -7.3302306e-2, 84.85}(f)*S;
  c.w = 0.05, c.d1 = 2.5e-4 / S, c.d2 = 3.49e-7 / (S * S);
  c.gft = (0.021 + 5.357e-4 * aggregate()) * std::pow(f / 10, 0.7) * S * to.length;
  c.gfs = c.gft, c.gfc = 100 * c.gft, c.b = 100, c.d = 0.1, c.pwrc = 5, c.pwrt = 1, c.pmod = 0;
  c.nc = 0.78,
  c.eta0c = Quadratic{1.2772337e-11, -1.0613722e-7, 3.203497e-4}(psi)*std::pow(to.time, 1 - c.nc);
  c.nt = 0.48,
  c.eta0t = Quadratic{8.0614774e-13, -9.77736719e-10, 5.0752351e-5}(psi)*std::pow(to.time, 1 - c.nt);
  c.overc = c.overt = Quadratic{1.309663e-2, -0.3927659, 21.45}(f)*S, c.srate = c.repow = 1;
  return c;
}

void MatCscmConcrete::check(const Deck& deck, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  check_cscm_state(*this, expect);
  constexpr Real least = 5, low = 20, high = 58, most = 120, fine = 4, coarse = 64;
  const Real f = strength(), d = aggregate();
  expect(f >= least && f <= most, "FPC", "a strength from 5 to 120 MPa in the units of UNITS", fpc,
         "UNITS: 0 GPa, 1 and 2 MPa, 3 psi, 4 Pa");
  expect(d >= fine && d <= coarse, "DAGG", "a size from 4 to 64 mm in the units of UNITS", dagg,
         "UNITS: 0, 1 and 2 mm, 3 inch, 4 m");
  if (f >= least && f <= most && (f < low || f > high))
    deck.warning(diagnostics, *this, "FPC",
                 fmt::format("{:.4g} MPa is outside of what the parameters are fitted to", f),
                 "20 to 58 MPa; give the parameters by *MAT_CSCM beyond it");
  constexpr Real usual = 2300, wide = 10;  // wide enough for light concrete and for scaled masses
  if (ro > 0 && (density() > wide * usual || density() < usual / wide))
    deck.warning(diagnostics, *this, "RO",
                 fmt::format("{:.4g} is {:.4g} kg/m3 in the units of UNITS {}", ro, density(), units),
                 "concrete has some 2300 kg/m3: UNITS is for another system than that of the deck");
}

/// Factors of units are kept: UNITS names those of the file.
std::string keep_units(MatCscmConcrete& card, const Conversion& conversion) {
  card.to_stress *= conversion.units.of("M/LT2"), card.to_length *= conversion.units.of("L");
  card.to_time *= conversion.units.of("T");
  return "";
}

using CscmConcrete = MatCscmConcrete;
// As a body of E = 18.275 GPa cbrt(3), nu = 0.15, by a strain along x, far below its strength.
constexpr Real elastic_along = 18.275 * 1.4422495703074083 * 0.85 / (1.15 * 0.7),
               elastic_across = 18.275 * 1.4422495703074083 * 0.15 / (1.15 * 0.7);
const RegisterStrength<CscmConcrete> mat_cscm_concrete{
    "as MAT_CSCM, with parameters from FPC and DAGG: polynomials of FPC, E = 18.275 GPa (FPC/10 MPa)^(1/3), "
    "PR 0.15, "
    "GFT = (0.021 + 0.0005357 DAGG/mm) (FPC/10 MPa)^0.7 N/mm, GFS = GFT, GFC = 100 GFT",
    "Murray 2007, FHWA-HRT-05-062; CEB-FIP Model Code 1990",
    {{"1,2.3e-6\n0.0\n0.03,19.0,0\n",
      {-1e-5},
      {},
      {-1e-5 * elastic_along, -1e-5 * elastic_across, -1e-5 * elastic_across},
      {},
      {0}}},
    {.names = {"MAT_CSCM_CONCRETE", "MAT_159_CONCRETE"},
     .purpose = "concrete by a smooth cap surface with damage and rates, with parameters from its strength",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &CscmConcrete::title,
     .cards =
         {{.fields = {{"MID", &CscmConcrete::mid, "-", "id that *PART refers to", rules::required_id},
                      {"RO", &CscmConcrete::ro, "M/L3", "density", rules::required_positive},
                      {"NPLOT", &CscmConcrete::nplot, "-", "what is shown as plastic strain", no_effect},
                      {"INCRE", &CscmConcrete::incre, "-", "strain of sub-increments: the return needs none",
                       no_effect},
                      {"IRATE", &CscmConcrete::irate, "-", "rates of strain count: 1"},
                      {"ERODE",
                       &CscmConcrete::erode,
                       "-",
                       "elements fail at damage 0.99 and a principal strain above ERODE - 1; below 1: never",
                       {.check = Check::not_negative}},
                      {"RECOV", &CscmConcrete::recov, "-",
                       "share of brittle damage that stays under pressure"},
                      {"ITRETRC", &CscmConcrete::itretrc, "-", "the cap moves back: 1", unsupported}}},
          {.fields =
               {{"PRED", &CscmConcrete::pred, "-", "damage at the start", {.check = Check::not_negative}}}},
          {.fields = {{"FPC",
                       &CscmConcrete::fpc,
                       "-",
                       "strength in compression, in the units of UNITS; 0: 30 MPa",
                       {.check = Check::not_negative}},
                      {"DAGG",
                       &CscmConcrete::dagg,
                       "-",
                       "largest aggregate, in the units of UNITS; 0: 19 mm",
                       {.check = Check::not_negative}},
                      {"UNITS",
                       &CscmConcrete::units,
                       "-",
                       "0 GPa mm ms, 1 MPa mm ms, 2 MPa mm s, 3 psi inch s, 4 Pa m s",
                       {.allowed = {0, 1, 2, 3, 4}}}}}},
     .convert = keep_units}};

}  // namespace

}  // namespace courant
