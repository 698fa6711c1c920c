// *MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM
#include "laws/discrete/discrete_beam_cards.hpp"

namespace courant {

namespace {

struct NonlinearElasticBeam : DiscreteBeamCard {
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
    mat_nonlinear_elastic_discrete_beam_table()};

}  // namespace

}  // namespace courant
