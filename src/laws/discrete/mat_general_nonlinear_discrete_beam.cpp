// *MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM, _1DOF_DISCRETE_BEAM, as far as they unload along their loading
// curve.
#include <fmt/format.h>

#include "laws/discrete/discrete_beam_law.hpp"
#include "laws/discrete/discrete_law_cards.hpp"

namespace courant {

namespace {

/// Of both cards; r comes first. Curves of unloading do nothing with UNLDOPT 0.
struct GeneralBeam : GeneralBeamFields {
  std::shared_ptr<DiscreteBeamLaw> law_by(const std::array<const char*, 6>& forces,
                                          const std::array<const char*, 6>& dampings, const Deck& deck,
                                          const Model& model, Diagnostics& diagnostics) const {
    auto out = std::make_shared<DiscreteBeamLaw>();
    out->ro = ro;
    out->limits.displacement = {utfailr, utfails, utfailt, wtfailr, wtfails, wtfailt};
    out->limits.negative = {ucfailr, ucfails, ucfailt, wcfailr, wcfails, wcfailt};
    out->limits.apart = fcrit == 0;
    bool good = true;
    const auto take = [&](const char* field, Id id, ForceCurve& to) {
      if (id == 0) return;
      const Curve* curve = beam_curve(deck, model, *this, field, id, diagnostics);
      if (curve)
        to = ForceCurve(*curve);
      else
        good = false;
    };
    const std::array of_force{lcidtr, lcidts, lcidtt, lcidrr, lcidrs, lcidrt};
    const std::array of_rate{lcidtdr, lcidtds, lcidtdt, lcidrdr, lcidrds, lcidrdt};
    for (std::size_t d = 0; d < 6; ++d)
      take(forces[d], of_force[d], out->springs[d].force),
          take(dampings[d], of_rate[d], out->springs[d].damping);
    if (dampf > 0 && (kt > 0 || kr > 0)) {
      deck.error(
          diagnostics, *this, "DAMPF",
          fmt::format("'{:g}' is not supported beside an unloading stiffness: its scale is not known", dampf),
          "leave KT and KR blank, where it has no effect, or give curves of damping");
      good = false;
    }
    return good ? out : nullptr;
  }
};

struct GeneralBeam6 : GeneralBeam {
  std::shared_ptr<DiscreteBeamLaw> law(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    return law_by({"LCIDTR", "LCIDTS", "LCIDTT", "LCIDRR", "LCIDRS", "LCIDRT"},
                  {"LCIDTDR", "LCIDTDS", "LCIDTDT", "LCIDRDR", "LCIDRDS", "LCIDRDT"}, deck, model,
                  diagnostics);
  }
};
const RegisterDiscreteBeam<GeneralBeam6> mat_general_nonlinear_6dof{
    mat_general_nonlinear_6dof_discrete_beam_table()};

struct GeneralBeam1 : GeneralBeam {
  std::shared_ptr<DiscreteBeamLaw> law(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    return law_by({"LCIDT", "", "", "", "", ""}, {"LCIDTD", "", "", "", "", ""}, deck, model, diagnostics);
  }
};
const RegisterDiscreteBeam<GeneralBeam1> mat_general_nonlinear_1dof{
    mat_general_nonlinear_1dof_discrete_beam_table()};

}  // namespace

}  // namespace courant
