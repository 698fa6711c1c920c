// *MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM
#include "elements/beam/discrete_beam_cards.hpp"

namespace courant {

namespace {

struct NonlinearElasticBeam : DiscreteBeamCard, BeamFailureFields {
  Id lcidtr = 0, lcidts = 0, lcidtt = 0, lcidrr = 0, lcidrs = 0, lcidrt = 0;
  Id lcidtdr = 0, lcidtds = 0, lcidtdt = 0, lcidrdr = 0, lcidrds = 0, lcidrdt = 0;

  /// Null behind an error.
  std::shared_ptr<DiscreteBeamLaw> law(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    constexpr std::array force_fields{"LCIDTR", "LCIDTS", "LCIDTT", "LCIDRR", "LCIDRS", "LCIDRT"};
    constexpr std::array damping_fields{"LCIDTDR", "LCIDTDS", "LCIDTDT", "LCIDRDR", "LCIDRDS", "LCIDRDT"};
    const std::array forces{lcidtr, lcidts, lcidtt, lcidrr, lcidrs, lcidrt};
    const std::array dampings{lcidtdr, lcidtds, lcidtdt, lcidrdr, lcidrds, lcidrdt};
    auto out = std::make_shared<DiscreteBeamLaw>();
    put_shared(*out), put_limits(*out);
    const auto take = [&](const char* field, Id id, ForceCurve& to) {
      if (id == 0) return true;
      const Curve* curve = beam_curve(deck, model, *this, field, id, diagnostics);
      if (curve) to = ForceCurve(*curve);
      return curve != nullptr;
    };
    bool good = true;
    for (std::size_t d = 0; d < 6; ++d) {
      good = take(force_fields[d], forces[d], out->springs[d].force) && good;
      good = take(damping_fields[d], dampings[d], out->springs[d].damping) && good;
    }
    return good ? out : nullptr;
  }
};

const RegisterDiscreteBeam<NonlinearElasticBeam> mat_nonlinear_elastic_discrete_beam{
    {.names = {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "MAT_067"},
     .purpose =
         "six springs and dampers by curves between the ends of beams with ELFORM 6; the other side of "
         "a curve that starts at 0, 0 is its mirror image",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &NonlinearElasticBeam::title,
     .cards = {
         first_card_of_beams<NonlinearElasticBeam>(
             {{"LCIDTR", &NonlinearElasticBeam::lcidtr, "-",
               "curve of the force over the displacement along r", rules::optional_id_of(IdSpace::curve)},
              {"LCIDTS", &NonlinearElasticBeam::lcidts, "-", "along s",
               rules::optional_id_of(IdSpace::curve)},
              {"LCIDTT", &NonlinearElasticBeam::lcidtt, "-", "along t",
               rules::optional_id_of(IdSpace::curve)},
              {"LCIDRR", &NonlinearElasticBeam::lcidrr, "-", "curve of the moment over the angle about r",
               rules::optional_id_of(IdSpace::curve)},
              {"LCIDRS", &NonlinearElasticBeam::lcidrs, "-", "about s",
               rules::optional_id_of(IdSpace::curve)},
              {"LCIDRT", &NonlinearElasticBeam::lcidrt, "-", "about t",
               rules::optional_id_of(IdSpace::curve)}}),
         {.fields =
              {{"LCIDTDR", &NonlinearElasticBeam::lcidtdr, "-",
                "curve of the damping force over the rate along r", rules::optional_id_of(IdSpace::curve)},
               {"LCIDTDS", &NonlinearElasticBeam::lcidtds, "-", "along s",
                rules::optional_id_of(IdSpace::curve)},
               {"LCIDTDT", &NonlinearElasticBeam::lcidtdt, "-", "along t",
                rules::optional_id_of(IdSpace::curve)},
               {"LCIDRDR", &NonlinearElasticBeam::lcidrdr, "-",
                "curve of the damping moment over the rate about r", rules::optional_id_of(IdSpace::curve)},
               {"LCIDRDS", &NonlinearElasticBeam::lcidrds, "-", "about s",
                rules::optional_id_of(IdSpace::curve)},
               {"LCIDRDT", &NonlinearElasticBeam::lcidrdt, "-", "about t",
                rules::optional_id_of(IdSpace::curve)}}},
         preload_of_beams<NonlinearElasticBeam>(),
         failure_forces_of_beams<NonlinearElasticBeam>(),
         failure_displacements_of_beams<NonlinearElasticBeam>()}}};

}  // namespace

}  // namespace courant
