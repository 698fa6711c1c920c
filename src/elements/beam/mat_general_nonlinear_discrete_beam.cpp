// *MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM, _1DOF_DISCRETE_BEAM, as far as they unload along their loading
// curve.
#include <fmt/format.h>

#include "elements/beam/discrete_beam_cards.hpp"

namespace courant {

namespace {

/// Of both cards; r comes first. Curves of unloading do nothing with UNLDOPT 0.
struct GeneralBeam : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, kt = 0, kr = 0, offset = 0, dampf = 0;
  int unldopt = 0, iflag = 0;
  Id lcidtr = 0, lcidts = 0, lcidtt = 0, lcidrr = 0, lcidrs = 0, lcidrt = 0;
  Id lcidtur = 0, lcidtus = 0, lcidtut = 0, lcidrur = 0, lcidrus = 0, lcidrut = 0;
  Id lcidtdr = 0, lcidtds = 0, lcidtdt = 0, lcidrdr = 0, lcidrds = 0, lcidrdt = 0;
  Id lcidter = 0, lcidtes = 0, lcidtet = 0, lcidrer = 0, lcidres = 0, lcidret = 0;
  Real utfailr = 0, utfails = 0, utfailt = 0, wtfailr = 0, wtfails = 0, wtfailt = 0;
  Real ucfailr = 0, ucfails = 0, ucfailt = 0, wcfailr = 0, wcfails = 0, wcfailt = 0;
  Real iur = 0, ius = 0, iut = 0, iwr = 0, iws = 0, iwt = 0;

  std::shared_ptr<DiscreteBeamLaw> law_by(const std::array<const char*, 6>& forces,
                                          const std::array<const char*, 6>& dampings, const Deck& deck,
                                          const Model& model, Diagnostics& diagnostics) const {
    auto out = std::make_shared<DiscreteBeamLaw>();
    out->ro = ro;
    out->limits.displacement = {utfailr, utfails, utfailt, wtfailr, wtfails, wtfailt};
    out->limits.negative = {ucfailr, ucfails, ucfailt, wcfailr, wcfails, wcfailt};
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

constexpr FieldRules curve_of_force = rules::optional_id_of(IdSpace::curve);
constexpr FieldRules unused_curve{
    .check = Check::not_negative, .honour = Honour::ignored, .refers = IdSpace::curve};
constexpr FieldRules curve_of_scale{.honour = Honour::no, .refers = IdSpace::curve};

template <class Card>
CardOf<Card> first_card() {
  return {.fields = {{"MID", &Card::mid, "-", "id that *PART refers to", rules::required_id},
                     {"RO", &Card::ro, "M/L3", "density, of VOL of *SECTION_BEAM", rules::required_positive},
                     {"KT",
                      &Card::kt,
                      "M/T2",
                      "translational stiffness of unloading: none with UNLDOPT 0",
                      {.check = Check::not_negative}},
                     {"KR",
                      &Card::kr,
                      "ML2/T2",
                      "rotational stiffness of unloading: none with UNLDOPT 0",
                      {.check = Check::not_negative}},
                     {"UNLDOPT", &Card::unldopt, "-", "0: unloads along the loading curve", {.allowed = {0}}},
                     {"OFFSET", &Card::offset, "-", "permanent set of UNLDOPT 3", no_effect},
                     {"DAMPF",
                      &Card::dampf,
                      "-",
                      "damping that goes with an unloading stiffness",
                      {.check = Check::not_negative}},
                     {"IFLAG", &Card::iflag, "-", "0: curves over displacements", {.allowed = {0}}}}};
}

struct GeneralBeam6 : GeneralBeam {
  std::shared_ptr<DiscreteBeamLaw> law(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    return law_by({"LCIDTR", "LCIDTS", "LCIDTT", "LCIDRR", "LCIDRS", "LCIDRT"},
                  {"LCIDTDR", "LCIDTDS", "LCIDTDT", "LCIDRDR", "LCIDRDS", "LCIDRDT"}, deck, model,
                  diagnostics);
  }
};
using Six = GeneralBeam6;

const RegisterDiscreteBeam<Six> mat_general_nonlinear_6dof{
    {.names = {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "MAT_119"},
     .purpose =
         "six springs and dampers by curves between the ends of beams with ELFORM 6, with limits in tension "
         "and compression; the other side of a curve that starts at 0, 0 is its mirror image",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &Six::title,
     .cards = {first_card<Six>(),
               {.fields = {{"LCIDTR", &Six::lcidtr, "-", "curve of the force over the displacement along r",
                            curve_of_force},
                           {"LCIDTS", &Six::lcidts, "-", "along s", curve_of_force},
                           {"LCIDTT", &Six::lcidtt, "-", "along t", curve_of_force},
                           {"LCIDRR", &Six::lcidrr, "-", "curve of the moment over the angle about r",
                            curve_of_force},
                           {"LCIDRS", &Six::lcidrs, "-", "about s", curve_of_force},
                           {"LCIDRT", &Six::lcidrt, "-", "about t", curve_of_force}}},
               {.fields = {{"LCIDTUR", &Six::lcidtur, "-", "curve of unloading along r", unused_curve},
                           {"LCIDTUS", &Six::lcidtus, "-", "along s", unused_curve},
                           {"LCIDTUT", &Six::lcidtut, "-", "along t", unused_curve},
                           {"LCIDRUR", &Six::lcidrur, "-", "about r", unused_curve},
                           {"LCIDRUS", &Six::lcidrus, "-", "about s", unused_curve},
                           {"LCIDRUT", &Six::lcidrut, "-", "about t", unused_curve}}},
               {.fields = {{"LCIDTDR", &Six::lcidtdr, "-", "curve of the damping force over the rate along r",
                            curve_of_force},
                           {"LCIDTDS", &Six::lcidtds, "-", "along s", curve_of_force},
                           {"LCIDTDT", &Six::lcidtdt, "-", "along t", curve_of_force},
                           {"LCIDRDR", &Six::lcidrdr, "-",
                            "curve of the damping moment over the rate about r", curve_of_force},
                           {"LCIDRDS", &Six::lcidrds, "-", "about s", curve_of_force},
                           {"LCIDRDT", &Six::lcidrdt, "-", "about t", curve_of_force}}},
               {.fields = {{"LCIDTER", &Six::lcidter, "-", "scale of damping over the displacement along r",
                            curve_of_scale},
                           {"LCIDTES", &Six::lcidtes, "-", "along s", curve_of_scale},
                           {"LCIDTET", &Six::lcidtet, "-", "along t", curve_of_scale},
                           {"LCIDRER", &Six::lcidrer, "-", "about r", curve_of_scale},
                           {"LCIDRES", &Six::lcidres, "-", "about s", curve_of_scale},
                           {"LCIDRET", &Six::lcidret, "-", "about t", curve_of_scale}},
                .optional = true},
               {.fields = {{"UTFAILR", &Six::utfailr, "L",
                            "displacement along r above 0 that alone makes it fail; squares of shares sum up "
                            "to 1; 0: none",
                            beam_at_least_0},
                           {"UTFAILS", &Six::utfails, "L", "along s", beam_at_least_0},
                           {"UTFAILT", &Six::utfailt, "L", "along t", beam_at_least_0},
                           {"WTFAILR", &Six::wtfailr, "-", "angle about r", beam_at_least_0},
                           {"WTFAILS", &Six::wtfails, "-", "about s", beam_at_least_0},
                           {"WTFAILT", &Six::wtfailt, "-", "about t", beam_at_least_0}},
                .optional = true},
               {.fields = {{"UCFAILR", &Six::ucfailr, "L",
                            "the same of displacements below 0, as a number above 0", beam_at_least_0},
                           {"UCFAILS", &Six::ucfails, "L", "along s", beam_at_least_0},
                           {"UCFAILT", &Six::ucfailt, "L", "along t", beam_at_least_0},
                           {"WCFAILR", &Six::wcfailr, "-", "about r", beam_at_least_0},
                           {"WCFAILS", &Six::wcfails, "-", "about s", beam_at_least_0},
                           {"WCFAILT", &Six::wcfailt, "-", "about t", beam_at_least_0}},
                .optional = true},
               {.fields = {{"IUR", &Six::iur, "L", "displacement at the start along r", unsupported},
                           {"IUS", &Six::ius, "L", "along s", unsupported},
                           {"IUT", &Six::iut, "L", "along t", unsupported},
                           {"IWR", &Six::iwr, "-", "angle at the start about r", unsupported},
                           {"IWS", &Six::iws, "-", "about s", unsupported},
                           {"IWT", &Six::iwt, "-", "about t", unsupported}},
                .optional = true}}}};

struct GeneralBeam1 : GeneralBeam {
  std::shared_ptr<DiscreteBeamLaw> law(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    return law_by({"LCIDT", "", "", "", "", ""}, {"LCIDTD", "", "", "", "", ""}, deck, model, diagnostics);
  }
};
using One = GeneralBeam1;

const RegisterDiscreteBeam<One> mat_general_nonlinear_1dof{
    {.names = {"MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM", "MAT_121"},
     .purpose =
         "spring and damper by curves along beams with ELFORM 6, with limits in tension and compression; the "
         "other side of a curve that starts at 0, 0 is its mirror image",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &One::title,
     .cards = {
         {.fields = {{"MID", &One::mid, "-", "id that *PART refers to", rules::required_id},
                     {"RO", &One::ro, "M/L3", "density, of VOL of *SECTION_BEAM", rules::required_positive},
                     {"K",
                      &One::kt,
                      "M/T2",
                      "stiffness of unloading: none with UNLDOPT 0",
                      {.check = Check::not_negative}},
                     {"UNLDOPT", &One::unldopt, "-", "0: unloads along the loading curve", {.allowed = {0}}},
                     {"OFFSET", &One::offset, "-", "permanent set of UNLDOPT 3", no_effect},
                     {"DAMPF",
                      &One::dampf,
                      "-",
                      "damping that goes with an unloading stiffness",
                      {.check = Check::not_negative}}}},
         {.fields =
              {{"LCIDT", &One::lcidtr, "-", "curve of the force over the displacement", curve_of_force},
               {"LCIDTU", &One::lcidtur, "-", "curve of unloading", unused_curve},
               {"LCIDTD", &One::lcidtdr, "-", "curve of the damping force over the rate", curve_of_force},
               {"LCIDTE", &One::lcidter, "-", "scale of damping over the displacement", curve_of_scale}}},
         {.fields = {{"UTFAIL", &One::utfailr, "L", "displacement above 0 at which it fails; 0: none",
                      beam_at_least_0},
                     {"UCFAIL", &One::ucfailr, "L", "the same below 0, as a number above 0", beam_at_least_0},
                     {"IU", &One::iur, "L", "displacement at the start", unsupported}},
          .optional = true}}}};

}  // namespace

}  // namespace courant
