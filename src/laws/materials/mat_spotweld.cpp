#include "laws/materials/mat_spotweld.hpp"

#include <fmt/format.h>

#include <cmath>

#include "keyword/common_rules.hpp"
#include "laws/strength/linear_hardening.hpp"

namespace courant {

namespace {

using W = MatSpotweld;
constexpr FieldRules limit{.check = Check::not_negative};

// By hand. E = 2.5, PR = 1/4: lambda = G = 1. EH = 5/8, SIGY = 3 and dev e = (2, -1, -1): the trial stress
// (4, -2, -2) has q = 6, over by 3: de = 3/(3 + 5/8) = 24/29, and s loses 3 de/6 of it: s = 17/29 (4, -2,
// -2).
const RegisterStrength<W> mat_spotweld{
    "s_tr = s + 2 G dev(D) dt; q = sqrt(3/2 s:s) <= SIGY + EH e; radial return; pressure by Hooke's law",
    "J2 plasticity with linear isotropic hardening, radial return: Krieg & Key 1976",
    {{"1,2.0,2.5,0.25,3.0,0.625\n", {0.1, 0, 0, 0, 0, 0}, {1, 1, 1}, {1.3, 1.1, 1.1, 0, 0, 0}, {0}, {0}},
     {"1,2.0,2.5,0.25,3.0,0.625\n",
      {2, -1, -1, 0, 0, 0},
      {},
      {68.0 / 29, -34.0 / 29, -34.0 / 29, 0, 0, 0},
      {0},
      {24.0 / 29}}},
    {.names = {"MAT_SPOTWELD", "MAT_SPOTWELD_DAMAGE-FAILURE", "MAT_100", "MAT_100_DAMAGE-FAILURE"},
     .purpose =
         "spot welds: elasticity and plasticity with linear isotropic hardening, and failure, of beams "
         "with ELFORM 9 and of solids",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &W::title,
     .cards = {
         {.fields =
              {{"MID", &W::mid, "-", "id that *PART refers to", {.required = true, .check = Check::positive}},
               {"RO", &W::ro, "M/L3", "density", rules::required_positive},
               {"E", &W::E, "M/LT2", "Young's modulus", rules::required_positive},
               {"PR", &W::pr, "-", "Poisson ratio, below 0.5", {.check = Check::not_negative}},
               {"SIGY", &W::sigy, "M/LT2", "yield stress at the start", rules::required_positive},
               {"EH", &W::eh, "M/LT2", "slope of the yield stress over plastic strain", limit},
               {"DT", &W::dt, "T", "beams with a smaller step get mass at the start, 0: none", limit},
               {"TFAIL", &W::tfail, "T", "time of failure, 0: never by that", limit}}},
         {.fields = {{"EFAIL", &W::efail, "-", "plastic strain at which points fail, 0: never", limit},
                     {"NRR", &W::nrr, "ML/T2", "largest axial force of the section, 0: does not count",
                      limit},
                     {"NRS", &W::nrs, "ML/T2", "largest shear force along s", limit},
                     {"NRT", &W::nrt, "ML/T2", "largest shear force along t", limit},
                     {"MRR", &W::mrr, "ML2/T2", "largest torsion", limit},
                     {"MSS", &W::mss, "ML2/T2", "largest moment about s", limit},
                     {"MTT", &W::mtt, "ML2/T2", "largest moment about t", limit},
                     {"NF",
                      &W::nf,
                      "-",
                      "steps over which forces and moments are averaged before they are compared, 0: none",
                      {.check = Check::not_negative}}},
          .optional = true},
         {.fields = {{"RS", &W::rs, "-", "plastic strain at rupture, behind damage from EFAIL on",
                      unsupported},
                     {"OPT", &W::opt, "-", "0: failure by resultants; other values are refused"},
                     {"FVAL", &W::fval, "-", "parameter of other OPT", no_effect},
                     {"TRUE_T", &W::true_t, "L", "true thickness of solids", unsupported},
                     {"ASFF", &W::asff, "-", "failure of assemblies of solids", no_effect},
                     {"BETA", &W::beta, "-", "decay of damage", no_effect},
                     {},
                     {"DMGOPT", &W::dmgopt, "-", "kind of damage", unsupported}},
          .optional = true,
          .when = [](const W& w) { return w.with_damage(); }}}}};

}  // namespace

std::shared_ptr<StrengthLaw> MatSpotweld::law() const {
  LinearHardening data{.lambda = E * pr / ((1 + pr) * (1 - 2 * pr)), .G = E / (2 * (1 + pr))};
  data.yield = sigy, data.isotropic = eh;
  if (efail > 0 && efail < never_fails) data.fails_at = efail;
  if (tfail > 0) data.fails_at_time = tfail;
  return linear_hardening_law(ro, data);
}

void MatSpotweld::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  if (!(pr < 0.5))
    deck.error(diagnostics, *this, "PR", fmt::format("expected a number < 0.5, got '{:g}'", pr),
               "a material that keeps its volume has no finite bulk modulus");
  if (opt != 0)
    deck.refuse(diagnostics, *this, "OPT", fmt::format("'{}' is not supported", opt),
                "0 is failure by forces and moments of beams");
  for (const ModelPart& part : model.parts) {
    if (part.mid != mid) continue;
    if (part.has_shell || part.has_sph)
      deck.error(diagnostics, part.card, "MID",
                 fmt::format("{} is for beams with ELFORM 9 and for solids, and part {} has {}",
                             deck.keyword(*this), part.id, part.has_shell ? "shells" : "particles"),
                 "*MAT_PLASTIC_KINEMATIC has the same plasticity");
    if (part.has_solid && opt == 0 && of_resultants())  // else the fields are stresses
      deck.error(diagnostics, *this, "NRR",
                 fmt::format("failure by forces and moments of the section (NRR to MTT) is not supported for "
                             "solids, as those of part {}",
                             part.id),
                 "solids fail by EFAIL, TFAIL or *MAT_ADD_EROSION; beams with ELFORM 9 have it");
    if (part.has_solid && (dt > 0 || nf > 0))
      deck.warning(diagnostics, *this, dt > 0 ? "DT" : "NF",
                   fmt::format("has no effect on solids, as those of part {}", part.id),
                   dt > 0 ? "DT2MS of *CONTROL_TIMESTEP adds mass to solids" : "leave it blank");
  }
}

}  // namespace courant
