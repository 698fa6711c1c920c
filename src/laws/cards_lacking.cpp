// Materials and equations of state without a law here: their cards are read and checked, and the deck is
// refused by name. Temperatures have no unit, as factors of units know none.
#include <string>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

using namespace rules;

namespace {

struct MatPlasticKinematic : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, e = 0, pr = 0, sigy = 0, etan = 0, beta = 0, src = 0, srp = 0, fs = 0, vp = 0;
};
KeywordOf<MatPlasticKinematic> mat_plastic_kinematic() {
  using T = MatPlasticKinematic;
  return {.names = {"MAT_PLASTIC_KINEMATIC", "MAT_003"},
          .purpose = "plasticity with linear hardening and rates by Cowper-Symonds",
          .id_space = IdSpace::material,
          .title_option = true,
          .title = &T::title,
          .lacking = "plastic materials",
          .cards = {{.fields = {{"MID", &T::mid, "-", "material id, referenced by *PART", required_id},
                                {"RO", &T::ro, "M/L3", "mass density"},
                                {"E", &T::e, "M/LT2", "Young's modulus"},
                                {"PR", &T::pr, "-", "Poisson ratio"},
                                {"SIGY", &T::sigy, "M/LT2", "initial yield stress"},
                                {"ETAN", &T::etan, "M/LT2", "tangent (hardening) modulus"},
                                {"BETA", &T::beta, "-", "0 kinematic  to  1 isotropic hardening"}}},
                    {.fields = {{"SRC", &T::src, "1/T", "Cowper-Symonds C (0 = no rate effect)"},
                                {"SRP", &T::srp, "-", "Cowper-Symonds P"},
                                {"FS", &T::fs, "-", "failure plastic strain, erodes element"},
                                {"VP", &T::vp, "-", "0 scale yield; 1 viscoplastic"}}}}};
}
const RegisterKeyword<MatPlasticKinematic> mat_plastic_kinematic_keyword{mat_plastic_kinematic()};

struct MatViscoelastic : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, bulk = 0, g0 = 0, gi = 0, beta = 0;
};
KeywordOf<MatViscoelastic> mat_viscoelastic() {
  using T = MatViscoelastic;
  return {.names = {"MAT_VISCOELASTIC", "MAT_006"},
          .purpose = "linear viscoelasticity",
          .id_space = IdSpace::material,
          .title_option = true,
          .title = &T::title,
          .lacking = "viscoelastic materials",
          .cards = {{.fields = {{"MID", &T::mid, "-", "material id, referenced by *PART", required_id},
                                {"RO", &T::ro, "M/L3", "mass density"},
                                {"BULK", &T::bulk, "M/LT2", "bulk modulus"},
                                {"G0", &T::g0, "M/LT2", "short-time shear modulus"},
                                {"GI", &T::gi, "M/LT2", "long-time shear modulus"},
                                {"BETA", &T::beta, "1/T", "decay constant"}}}}};
}
const RegisterKeyword<MatViscoelastic> mat_viscoelastic_keyword{mat_viscoelastic()};

struct MatElasticPlasticHydroSpall : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, g = 0, sigy = 0, eh = 0, pc = 0, fs = 0, charl = 0, a1 = 0, a2 = 0, spall = 0, eps1 = 0,
       eps2 = 0, eps3 = 0, eps4 = 0, eps5 = 0, eps6 = 0, eps7 = 0, eps8 = 0, eps9 = 0, eps10 = 0, eps11 = 0,
       eps12 = 0, eps13 = 0, eps14 = 0, eps15 = 0, eps16 = 0, es1 = 0, es2 = 0, es3 = 0, es4 = 0, es5 = 0,
       es6 = 0, es7 = 0, es8 = 0, es9 = 0, es10 = 0, es11 = 0, es12 = 0, es13 = 0, es14 = 0, es15 = 0,
       es16 = 0;
};
KeywordOf<MatElasticPlasticHydroSpall> mat_elastic_plastic_hydro_spall() {
  using T = MatElasticPlasticHydroSpall;
  return {.names = {"MAT_ELASTIC_PLASTIC_HYDRO_SPALL", "MAT_010_SPALL"},
          .purpose = "elasticity and plasticity beside an equation of state, with spall",
          .id_space = IdSpace::material,
          .title_option = true,
          .title = &T::title,
          .lacking = "plastic materials",
          .cards = {{.fields = {{"MID", &T::mid, "-", "material id, referenced by *PART", required_id},
                                {"RO", &T::ro, "M/L3", "mass density"},
                                {"G", &T::g, "M/LT2", "shear modulus"},
                                {"SIGY", &T::sigy, "M/LT2", "initial yield stress"},
                                {"EH", &T::eh, "M/LT2", "plastic hardening modulus"},
                                {"PC", &T::pc, "M/LT2", "pressure cutoff <= 0 (0 = -infinity)"},
                                {"FS", &T::fs, "-", "failure strain"},
                                {"CHARL", &T::charl, "L", "2D boundary-element thickness for deletion"}}},
                    {.fields = {{"A1", &T::a1, "-", "pressure hardening, linear"},
                                {"A2", &T::a2, "-", "pressure hardening, square root"},
                                {"SPALL", &T::spall, "-", "kind of spall: 1, 2, 3"}}},
                    {.fields = {{"EPS1", &T::eps1, "-", "plastic-strain abscissae 1-8"},
                                {"EPS2", &T::eps2, "-", "plastic-strain abscissae 1-8"},
                                {"EPS3", &T::eps3, "-", "plastic-strain abscissae 1-8"},
                                {"EPS4", &T::eps4, "-", "plastic-strain abscissae 1-8"},
                                {"EPS5", &T::eps5, "-", "plastic-strain abscissae 1-8"},
                                {"EPS6", &T::eps6, "-", "plastic-strain abscissae 1-8"},
                                {"EPS7", &T::eps7, "-", "plastic-strain abscissae 1-8"},
                                {"EPS8", &T::eps8, "-", "plastic-strain abscissae 1-8"}}},
                    {.fields = {{"EPS9", &T::eps9, "-", "plastic-strain abscissae 9-16"},
                                {"EPS10", &T::eps10, "-", "plastic-strain abscissae 9-16"},
                                {"EPS11", &T::eps11, "-", "plastic-strain abscissae 9-16"},
                                {"EPS12", &T::eps12, "-", "plastic-strain abscissae 9-16"},
                                {"EPS13", &T::eps13, "-", "plastic-strain abscissae 9-16"},
                                {"EPS14", &T::eps14, "-", "plastic-strain abscissae 9-16"},
                                {"EPS15", &T::eps15, "-", "plastic-strain abscissae 9-16"},
                                {"EPS16", &T::eps16, "-", "plastic-strain abscissae 9-16"}}},
                    {.fields = {{"ES1", &T::es1, "M/LT2", "yield stress at EPS1-8"},
                                {"ES2", &T::es2, "M/LT2", "yield stress at EPS1-8"},
                                {"ES3", &T::es3, "M/LT2", "yield stress at EPS1-8"},
                                {"ES4", &T::es4, "M/LT2", "yield stress at EPS1-8"},
                                {"ES5", &T::es5, "M/LT2", "yield stress at EPS1-8"},
                                {"ES6", &T::es6, "M/LT2", "yield stress at EPS1-8"},
                                {"ES7", &T::es7, "M/LT2", "yield stress at EPS1-8"},
                                {"ES8", &T::es8, "M/LT2", "yield stress at EPS1-8"}}},
                    {.fields = {{"ES9", &T::es9, "M/LT2", "yield stress at EPS9-16"},
                                {"ES10", &T::es10, "M/LT2", "yield stress at EPS9-16"},
                                {"ES11", &T::es11, "M/LT2", "yield stress at EPS9-16"},
                                {"ES12", &T::es12, "M/LT2", "yield stress at EPS9-16"},
                                {"ES13", &T::es13, "M/LT2", "yield stress at EPS9-16"},
                                {"ES14", &T::es14, "M/LT2", "yield stress at EPS9-16"},
                                {"ES15", &T::es15, "M/LT2", "yield stress at EPS9-16"},
                                {"ES16", &T::es16, "M/LT2", "yield stress at EPS9-16"}}}}};
}
const RegisterKeyword<MatElasticPlasticHydroSpall> mat_elastic_plastic_hydro_spall_keyword{
    mat_elastic_plastic_hydro_spall()};

struct MatJohnsonCook : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, g = 0, e = 0, pr = 0, dtf = 0, vp = 0, rateop = 0, a = 0, b = 0, n = 0, c = 0, m = 0, tm = 0,
       tr = 0, epso = 0, cp = 0, pc = 0, spall = 0, it = 0, d1_beta = 0, d2_wc = 0, d3_dc = 0, d4_gamma = 0,
       d5 = 0, c2_p_xnp_d = 0, erod = 0, efmin = 0, numint = 0, k = 0, eps1 = 0, dmodel = 0;
};
KeywordOf<MatJohnsonCook> mat_johnson_cook() {
  using T = MatJohnsonCook;
  return {
      .names = {"MAT_JOHNSON_COOK", "MAT_015"},
      .purpose = "plasticity with strain rate, temperature and damage",
      .id_space = IdSpace::material,
      .title_option = true,
      .title = &T::title,
      .lacking = "plastic materials",
      .cards = {{.fields = {{"MID", &T::mid, "-", "material id, referenced by *PART", required_id},
                            {"RO", &T::ro, "M/L3", "mass density"},
                            {"G", &T::g, "M/LT2", "shear modulus"},
                            {"E", &T::e, "M/LT2", "only for shells"},
                            {"PR", &T::pr, "-", "only for shells"},
                            {"DTF", &T::dtf, "T", "minimum shell time step before deletion"},
                            {"VP", &T::vp, "-", "0 scale yield; 1 viscoplastic"},
                            {"RATEOP", &T::rateop, "-", "rate form 0 log-linear  to  5 Couque"}}},
                {.fields = {{"A", &T::a, "M/LT2", "A (negative: curve id)"},
                            {"B", &T::b, "M/LT2", "B"},
                            {"N", &T::n, "-", "n"},
                            {"C", &T::c, "-", "C"},
                            {"M", &T::m, "-", "m"},
                            {"TM", &T::tm, "-", "melt temperature"},
                            {"TR", &T::tr, "-", "room temperature"},
                            {"EPSO", &T::epso, "1/T", "reference strain rate (1/time)"}}},
                {.fields = {{"CP", &T::cp, "-", "specific heat"},
                            {"PC", &T::pc, "M/LT2", "tensile failure stress or pressure cutoff (<0)"},
                            {"SPALL", &T::spall, "-",
                             "1 pressure limit; 2 max-stress spall; 3 pressure spall", or_blank(2)},
                            {"IT", &T::it, "-", "1 iterate plastic strain"},
                            {"D1/BETA", &T::d1_beta, "-", "failure parameter D1 to D4"},
                            {"D2/WC", &T::d2_wc, "-", "failure parameter D1 to D4"},
                            {"D3/DC", &T::d3_dc, "-", "failure parameter D1 to D4"},
                            {"D4/GAMMA", &T::d4_gamma, "-", "failure parameter D1 to D4"}}},
                {.fields = {{"D5", &T::d5, "-", "failure parameter D5"},
                            {"C2/P/XNP/D", &T::c2_p_xnp_d, "-", "extra rate parameter"},
                            {"EROD", &T::erod, "-", "0 element erodes; else stress zeroed"},
                            {"EFMIN", &T::efmin, "-", "lower bound on fracture strain", or_blank(1e-6)},
                            {"NUMINT", &T::numint, "-", "failed points needed to delete shell"},
                            {"K", &T::k, "-", "Couque rate parameter"},
                            {"EPS1", &T::eps1, "1/T", "Couque reference rate"},
                            {"DMODEL", &T::dmodel, "-", "0 Johnson-Cook damage; 1,2 Cockcroft-Latham"}}}}};
}
const RegisterKeyword<MatJohnsonCook> mat_johnson_cook_keyword{mat_johnson_cook()};

struct MatPiecewiseLinearPlasticity : Entry {
  std::string title;
  Id mid = 0, lcss = 0, lcsr = 0;
  Real ro = 0, e = 0, pr = 0, sigy = 0, etan = 0, fail = 0, tdel = 0, c = 0, p = 0, vp = 0, rfiltf = 0,
       eps1 = 0, eps2 = 0, eps3 = 0, eps4 = 0, eps5 = 0, eps6 = 0, eps7 = 0, eps8 = 0, es1 = 0, es2 = 0,
       es3 = 0, es4 = 0, es5 = 0, es6 = 0, es7 = 0, es8 = 0;
};
KeywordOf<MatPiecewiseLinearPlasticity> mat_piecewise_linear_plasticity() {
  using T = MatPiecewiseLinearPlasticity;
  return {.names = {"MAT_PIECEWISE_LINEAR_PLASTICITY", "MAT_024"},
          .purpose = "plasticity with a hardening curve",
          .id_space = IdSpace::material,
          .title_option = true,
          .title = &T::title,
          .lacking = "plastic materials",
          .cards = {{.fields = {{"MID", &T::mid, "-", "material id, referenced by *PART", required_id},
                                {"RO", &T::ro, "M/L3", "mass density"},
                                {"E", &T::e, "M/LT2", "Young's modulus"},
                                {"PR", &T::pr, "-", "Poisson ratio"},
                                {"SIGY", &T::sigy, "M/LT2", "initial yield stress"},
                                {"ETAN", &T::etan, "M/LT2", "tangent modulus, unused with LCSS"},
                                {"FAIL", &T::fail, "-", "plastic strain at failure; <0 user routine; 0 none",
                                 or_blank(1e21)},
                                {"TDEL", &T::tdel, "T", "minimum time step for deletion"}}},
                    {.fields = {{"C", &T::c, "1/T", "Cowper-Symonds constants"},
                                {"P", &T::p, "-", "Cowper-Symonds constants"},
                                {"LCSS", &T::lcss, "-", "stress-plastic-strain curve or rate table",
                                 id_of(IdSpace::curve)},
                                {"LCSR", &T::lcsr, "-", "rate scaling curve", id_of(IdSpace::curve)},
                                {"VP", &T::vp, "-", "rate formulation -1,0,1,3,4"},
                                {},
                                {"RFILTF", &T::rfiltf, "-", "rate filter for VP=4"}}},
                    {.fields = {{"EPS1", &T::eps1, "-", "plastic-strain abscissae 1-8"},
                                {"EPS2", &T::eps2, "-", "plastic-strain abscissae 1-8"},
                                {"EPS3", &T::eps3, "-", "plastic-strain abscissae 1-8"},
                                {"EPS4", &T::eps4, "-", "plastic-strain abscissae 1-8"},
                                {"EPS5", &T::eps5, "-", "plastic-strain abscissae 1-8"},
                                {"EPS6", &T::eps6, "-", "plastic-strain abscissae 1-8"},
                                {"EPS7", &T::eps7, "-", "plastic-strain abscissae 1-8"},
                                {"EPS8", &T::eps8, "-", "plastic-strain abscissae 1-8"}}},
                    {.fields = {{"ES1", &T::es1, "M/LT2", "yield stress at EPS1-8"},
                                {"ES2", &T::es2, "M/LT2", "yield stress at EPS1-8"},
                                {"ES3", &T::es3, "M/LT2", "yield stress at EPS1-8"},
                                {"ES4", &T::es4, "M/LT2", "yield stress at EPS1-8"},
                                {"ES5", &T::es5, "M/LT2", "yield stress at EPS1-8"},
                                {"ES6", &T::es6, "M/LT2", "yield stress at EPS1-8"},
                                {"ES7", &T::es7, "M/LT2", "yield stress at EPS1-8"},
                                {"ES8", &T::es8, "M/LT2", "yield stress at EPS1-8"}}}}};
}
const RegisterKeyword<MatPiecewiseLinearPlasticity> mat_piecewise_linear_plasticity_keyword{
    mat_piecewise_linear_plasticity()};

struct MatSphViscous : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, pc = 0, mulo = 0, muhi = 0, rk = 0, rc = 0, rn = 0;
};
KeywordOf<MatSphViscous> mat_sph_viscous() {
  using T = MatSphViscous;
  return {
      .names = {"MAT_SPH_VISCOUS", "MAT_SPH_01"},
      .purpose = "fluid whose viscosity depends on the strain rate",
      .id_space = IdSpace::material,
      .title_option = true,
      .title = &T::title,
      .lacking = "viscosities that depend on the strain rate",
      .cards = {{.fields = {{"MID", &T::mid, "-", "material id, referenced by *PART", required_id},
                            {"RO", &T::ro, "M/L3", "mass density"},
                            {"PC", &T::pc, "M/LT2", "tensile pressure cutoff, must be <= 0"},
                            {"MULO", &T::mulo, "M/LT", "viscosity; 0 inviscid; <0 curve versus strain rate"},
                            {"MUHI", &T::muhi, "M/LT", "upper limit (power law); <0 user routine"},
                            {"RK", &T::rk, "-", "consistency (power-law multiplier)"},
                            {"RC", &T::rc, "-", "cross model switch (>0 on)"},
                            {"RN", &T::rn, "-", "power-law exponent"}}}}};
}
const RegisterKeyword<MatSphViscous> mat_sph_viscous_keyword{mat_sph_viscous()};

struct MatAleViscous : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, pc = 0, mulo = 0, muhi = 0, rk = 0, rn = 0;
};
KeywordOf<MatAleViscous> mat_ale_viscous() {
  using T = MatAleViscous;
  return {
      .names = {"MAT_ALE_VISCOUS"},
      .purpose = "fluid whose viscosity depends on the strain rate",
      .id_space = IdSpace::material,
      .title_option = true,
      .title = &T::title,
      .lacking = "viscosities that depend on the strain rate",
      .cards = {{.fields = {{"MID", &T::mid, "-", "material id, referenced by *PART", required_id},
                            {"RO", &T::ro, "M/L3", "mass density"},
                            {"PC", &T::pc, "M/LT2", "tensile pressure cutoff, must be <= 0"},
                            {"MULO", &T::mulo, "M/LT", "viscosity; 0 inviscid; <0 curve versus strain rate"},
                            {"MUHI", &T::muhi, "M/LT", "upper limit; <0 user routine"},
                            {"RK", &T::rk, "-", "power-law multiplier"},
                            {},
                            {"RN", &T::rn, "-", "power-law exponent"}}}}};
}
const RegisterKeyword<MatAleViscous> mat_ale_viscous_keyword{mat_ale_viscous()};

struct MatSphIncompressibleFluid : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, mu = 0, gamma1 = 0, gamma2 = 0, stens = 0, cp = 0, lambda = 0;
};
KeywordOf<MatSphIncompressibleFluid> mat_sph_incompressible_fluid() {
  using T = MatSphIncompressibleFluid;
  return {
      .names = {"MAT_SPH_INCOMPRESSIBLE_FLUID", "MAT_SPH_02", "MAT_SPH_IMPLICIT_FLUID"},
      .purpose = "fluid of the implicit incompressible formulation",
      .id_space = IdSpace::material,
      .title_option = true,
      .title = &T::title,
      .lacking = "incompressible particles",
      .cards = {
          {.fields = {{"MID", &T::mid, "-", "material id, referenced by *PART", required_id},
                      {"RO", &T::ro, "M/L3", "mass density"},
                      {"MU", &T::mu, "M/LT", "dynamic viscosity, must be nonzero; <0 curve of temperature"},
                      {"GAMMA1", &T::gamma1, "-", "numerical surface tension coefficient (IMAT=0)"},
                      {"GAMMA2", &T::gamma2, "-", "numerical surface tension coefficient (IMAT=0)"},
                      {"STENS", &T::stens, "M/T2", "physical surface tension (IMAT=1)"}}},
          {.fields = {{"CP", &T::cp, "-", "specific heat (IHTC=1)"},
                      {"LAMBDA", &T::lambda, "-", "thermal conductivity (IHTC=1)"}},
           .optional = true}}};
}
const RegisterKeyword<MatSphIncompressibleFluid> mat_sph_incompressible_fluid_keyword{
    mat_sph_incompressible_fluid()};

struct MatSphIncompressibleStructure : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, beta = 0, rough = 0, adh = 0;
};
KeywordOf<MatSphIncompressibleStructure> mat_sph_incompressible_structure() {
  using T = MatSphIncompressibleStructure;
  return {.names = {"MAT_SPH_INCOMPRESSIBLE_STRUCTURE", "MAT_SPH_03"},
          .purpose = "wall particles of the implicit incompressible formulation",
          .id_space = IdSpace::material,
          .title_option = true,
          .title = &T::title,
          .lacking = "incompressible particles",
          .cards = {{.fields = {{"MID", &T::mid, "-", "material id, referenced by *PART", required_id},
                                {"RO", &T::ro, "M/L3", "rest density of the fluid"},
                                {"BETA", &T::beta, "-", "numerical adhesion coefficient"},
                                {"ROUGH", &T::rough, "-", "friction scale, 0-10"},
                                {"ADH", &T::adh, "-", "adhesion scale (IMAT=1)"}}}}};
}
const RegisterKeyword<MatSphIncompressibleStructure> mat_sph_incompressible_structure_keyword{
    mat_sph_incompressible_structure()};

struct EosLinearPolynomialWithEnergyLeak : Entry {
  std::string title;
  Id eosid = 0, lcid = 0;
  Real c0 = 0, c1 = 0, c2 = 0, c3 = 0, c4 = 0, c5 = 0, c6 = 0, e0 = 0, v0 = 0;
};
KeywordOf<EosLinearPolynomialWithEnergyLeak> eos_linear_polynomial_with_energy_leak() {
  using T = EosLinearPolynomialWithEnergyLeak;
  return {.names = {"EOS_LINEAR_POLYNOMIAL_WITH_ENERGY_LEAK", "EOS_006"},
          .purpose = "linear polynomial with energy deposited over time",
          .id_space = IdSpace::eos,
          .title_option = true,
          .title = &T::title,
          .lacking = "equations of state with energy deposition",
          .cards = {
              {.fields = {{"EOSID", &T::eosid, "-", "equation-of-state id, referenced by *PART", required_id},
                          {"C0", &T::c0, "M/LT2", "pressure coefficient"},
                          {"C1", &T::c1, "M/LT2", "pressure coefficient"},
                          {"C2", &T::c2, "M/LT2", "pressure coefficient"},
                          {"C3", &T::c3, "M/LT2", "pressure coefficient"},
                          {"C4", &T::c4, "-", "energy coefficient"},
                          {"C5", &T::c5, "-", "energy coefficient"},
                          {"C6", &T::c6, "-", "energy coefficient"}}},
              {.fields = {{"E0", &T::e0, "M/LT2", "initial internal energy per unit reference volume"},
                          {"V0", &T::v0, "-", "initial relative volume (rho0/rho)"},
                          {"LCID", &T::lcid, "-", "energy deposition rate curve", id_of(IdSpace::curve)}}}}};
}
const RegisterKeyword<EosLinearPolynomialWithEnergyLeak> eos_linear_polynomial_with_energy_leak_keyword{
    eos_linear_polynomial_with_energy_leak()};

}  // namespace

}  // namespace courant
