#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "keyword/common_rules.hpp"
#include "laws/failure/spall.hpp"
#include "laws/strength/hardening.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// J2 plasticity with isotropic hardening beside an equation of state: s_tr = s
/// + 2 G dev(D) dt is returned along itself to q = sqrt(3/2 s:s) = yield stress
/// at e + de with q_tr - q = 3 G de. Pressure may raise the yield stress by (A1
/// + A2 p) max(p, 0).
class ElasticPlasticHydro : public StrengthLaw {
 public:
  struct Data {
    Real G, a1 = 0, a2 = 0;  ///< [M/LT2], [-], [LT2/M]
    Real fails_at = std::numeric_limits<Real>::infinity();
    Spall spall{};
  };
  ElasticPlasticHydro(Real density, const Data& data, Hardening hardening)
      : a_(data), shear_(data.G), hardening_(std::move(hardening)) {
    ro = density;
  }
  bool deviator_only() const override { return true; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{"plastic_strain", "-"}};
    if (a_.spall.keeps()) out.push_back({"spalled", "-"});
    return out;
  }
  Real bulk_modulus() const override { return 0; }
  Real shear_modulus() const override { return shear_; }
  Real pressure_cutoff() const override { return a_.spall.cutoff(); }
  Real failure_limit() const override { return a_.fails_at; }

  void update(const PointBlock& block) const override {
    const Real twice = 2 * shear_ * block.dt, c0 = sound_speed();
    for (Index i = 0; i < block.count; ++i) {
      const Real mean = (block.rate[0][i] + block.rate[1][i] + block.rate[2][i]) / 3;
      for (int k = 0; k < 6; ++k) block.stress[k][i] += twice * (block.rate[k][i] - (k < 3 ? mean : 0));
      return_to_yield(block, i);
      const Real mu = block.compression ? block.compression[i] : 0;
      block.sound_speed[i] = c0 / std::sqrt(1 + mu);
    }
    if (a_.spall.keeps()) a_.spall.look(block, block.history[1]);
  }

 private:
  void return_to_yield(const PointBlock& block, Index i) const {
    const auto& s = block.stress;
    const Real j2 = 0.5 * (s[0][i] * s[0][i] + s[1][i] * s[1][i] + s[2][i] * s[2][i]) + s[3][i] * s[3][i] +
                    s[4][i] * s[4][i] + s[5][i] * s[5][i];
    const Real q = std::sqrt(3 * j2);
    Real& plastic = block.history[0][i];
    const Real p = block.pressure ? std::max(block.pressure[i], Real(0)) : 0,
               raised = (a_.a1 + a_.a2 * p) * p;
    if (!(q > std::max(hardening_.at(plastic) + raised, Real(0)))) return;
    // softening ends at no strength at all, not beyond
    const Real de = std::min(hardening_.increment(q - raised, 3 * shear_, plastic), q / (3 * shear_));
    for (int k = 0; k < 6; ++k) s[k][i] *= 1 - 3 * shear_ * de / q;
    plastic += de;
  }

  Data a_;
  Real shear_;
  Hardening hardening_;
};

struct MatElasticPlasticHydro : Entry {
  static constexpr bool deviator_only = true;
  std::string title;
  Id mid = 0;
  Real ro = 0, G = 0, sigy = 0, eh = 0, pc = 0, fs = 0, charl = 0, a1 = 0, a2 = 0, spall = 1;
  Real eps1 = 0, eps2 = 0, eps3 = 0, eps4 = 0, eps5 = 0, eps6 = 0, eps7 = 0, eps8 = 0, eps9 = 0, eps10 = 0,
       eps11 = 0, eps12 = 0, eps13 = 0, eps14 = 0, eps15 = 0, eps16 = 0;
  Real es1 = 0, es2 = 0, es3 = 0, es4 = 0, es5 = 0, es6 = 0, es7 = 0, es8 = 0, es9 = 0, es10 = 0, es11 = 0,
       es12 = 0, es13 = 0, es14 = 0, es15 = 0, es16 = 0;

  /// The points of the table; none where the cards have none.
  Hardening table() const {
    Hardening out{{eps1, eps2, eps3, eps4, eps5, eps6, eps7, eps8, eps9, eps10, eps11, eps12, eps13, eps14,
                   eps15, eps16},
                  {es1, es2, es3, es4, es5, es6, es7, es8, es9, es10, es11, es12, es13, es14, es15, es16}};
    drop_blank_points(out);
    return out;
  }
  std::shared_ptr<StrengthLaw> law() const {
    Hardening hardening = table();
    if (hardening.strain.empty()) hardening = {{0, 1}, {sigy, sigy + eh}};
    ElasticPlasticHydro::Data data{.G = G, .a1 = a1, .a2 = a2};
    data.spall = {static_cast<int>(spall), Spall::limit_of(pc)};
    if (fs > 0 && fs < never_fails) data.fails_at = fs;
    return std::make_shared<ElasticPlasticHydro>(ro, data, std::move(hardening));
  }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    if (spall != 1 && spall != 2 && spall != 3)
      deck.error(diagnostics, *this, "SPALL", fmt::format("expected 1, 2 or 3, got '{:g}'", spall),
                 "1 limits the pressure, 2 and 3 spall");
    const Hardening points = table();
    if (!points.strain.empty())
      return check_points(deck, *this, points, steepest_fall_in_solids(G), diagnostics);
    if (!(sigy > 0))
      deck.error(diagnostics, *this, "SIGY", fmt::format("expected a number > 0, got '{:g}'", sigy),
                 "the yield stress comes from SIGY and EH, or from the table of EPS and ES");
  }
};

#define EPS(k)                                                                                               \
  FieldOf<MatElasticPlasticHydro> {                                                                          \
    "EPS" #k, &MatElasticPlasticHydro::eps##k, "-", "effective plastic strain of point " #k " of the table", \
    {}                                                                                                       \
  }
#define ES(k)                                                                      \
  FieldOf<MatElasticPlasticHydro> {                                                \
    "ES" #k, &MatElasticPlasticHydro::es##k, "M/LT2", "yield stress at EPS" #k, {} \
  }

// By hand. G = 1, SIGY = 3, EH = 2, shear from rest: s_xy = 2 G e = 4, q = 4 sqrt(3). Perfect for EH = 0:
// s_xy = sqrt(3). With EH = 2: de = (4 sqrt(3) - 3)/5, s_xy = 4 - sqrt(3) de. Pulling by dev e = (2, -1, -1):
// s = (4, -2, -2), q = 6, de = 3/5, q = 6 - 9/5 = 4.2: s = 0.7 (4, -2, -2). Table (0, 3) (0.25, 4) (1.25, 4):
// at e = 0 the first piece, slope 4, would give de = 3/7 > 1/4, so the second: 6 - 3 de = 4, de = 2/3, s =
// 2/3 (4, -2, -2).
const Real root3 = 1.7320508075688772935;
const RegisterStrength<MatElasticPlasticHydro> mat_elastic_plastic_hydro{
    "s_tr = s + 2 G dev(D) dt; q = sqrt(3/2 s:s) <= SIGY + EH e, or the table ES(EPS); return along s_tr",
    "J2 plasticity with radial return: Wilkins 1964; hardening solved exactly, piece by piece",
    {{"1,2.0,1.0,3.0,0.0\n", {0, 0, 0, 2, 0, 0}, {}, {0, 0, 0, root3, 0, 0}},
     {"1,2.0,1.0,3.0,2.0\n",
      {0, 0, 0, 2, 0, 0},
      {},
      {0, 0, 0, 4 - root3*(4 * root3 - 3) / 5, 0, 0},
      {0},
      {(4 * root3 - 3) / 5}},
     {"1,2.0,1.0,3.0,2.0\n", {2.5, -0.5, -0.5, 0, 0, 0}, {}, {2.8, -1.4, -1.4, 0, 0, 0}, {0}, {0.6}},
     {"1,2.0,1.0,3.0,2.0\n", {0.5, 0.5, 0.5, 0, 0.5, 0}, {1, -1, 0}, {1, -1, 0, 0, 1, 0}, {0.1}, {0.1}},
     {"1,2.0,1.0\n0.0,0.25,1.25\n\n3.0,4.0,4.0\n\n",
      {2, -1, -1, 0, 0, 0},
      {},
      {8.0 / 3, -4.0 / 3, -4.0 / 3, 0, 0, 0},
      {0},
      {2.0 / 3}}},
    {.names = {"MAT_ELASTIC_PLASTIC_HYDRO", "MAT_010", "MAT_ELASTIC_PLASTIC_HYDRO_SPALL", "MAT_010_SPALL"},
     .purpose = "elasticity and plasticity beside an equation of state; "
                "_SPALL: with spall and a yield stress that "
                "pressure raises",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &MatElasticPlasticHydro::title,
     .cards = {
         {.fields = {{"MID",
                      &MatElasticPlasticHydro::mid,
                      "-",
                      "id that *PART refers to",
                      {.required = true, .check = Check::positive}},
                     {"RO", &MatElasticPlasticHydro::ro, "M/L3", "density", rules::required_positive},
                     {"G", &MatElasticPlasticHydro::G, "M/LT2", "shear modulus", rules::required_positive},
                     {"SIGY",
                      &MatElasticPlasticHydro::sigy,
                      "M/LT2",
                      "yield stress at the start, where there is no table",
                      {.check = Check::not_negative}},
                     {"EH",
                      &MatElasticPlasticHydro::eh,
                      "M/LT2",
                      "its slope over effective plastic strain",
                      {.check = Check::not_negative}},
                     {"PC",
                      &MatElasticPlasticHydro::pc,
                      "M/LT2",
                      "tensile pressure cut-off; 0: none",
                      {.check = Check::not_positive}},
                     {"FS",
                      &MatElasticPlasticHydro::fs,
                      "-",
                      "effective plastic strain at which elements fail; 0: never",
                      {.check = Check::not_negative}},
                     {"CHARL", &MatElasticPlasticHydro::charl, "L",
                      "thickness at failure, of a rezoned plane mesh", unsupported}}},
         {.fields = {{"A1", &MatElasticPlasticHydro::a1, "-", "yield stress rises by (A1 + A2 p) p, p > 0"},
                     {"A2", &MatElasticPlasticHydro::a2, "LT2/M", "the same"},
                     {"SPALL",
                      &MatElasticPlasticHydro::spall,
                      "-",
                      "1 pressure >= PC; a point spalls, 2: where a principal "
                      "stress is above -PC, 3: where the "
                      "pressure is below PC",
                      {.standard = 1}}},
          .when = [](const MatElasticPlasticHydro& m) { return m.name >= 2; }},
         {.fields = {EPS(1), EPS(2), EPS(3), EPS(4), EPS(5), EPS(6), EPS(7), EPS(8)}, .optional = true},
         {.fields = {EPS(9), EPS(10), EPS(11), EPS(12), EPS(13), EPS(14), EPS(15), EPS(16)},
          .optional = true},
         {.fields = {ES(1), ES(2), ES(3), ES(4), ES(5), ES(6), ES(7), ES(8)}, .optional = true},
         {.fields = {ES(9), ES(10), ES(11), ES(12), ES(13), ES(14), ES(15), ES(16)}, .optional = true}}}};
#undef EPS
#undef ES

}  // namespace

}  // namespace courant
