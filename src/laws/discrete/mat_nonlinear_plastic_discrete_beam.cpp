// *MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM
#include <fmt/format.h>

#include "laws/discrete/discrete_beam_cards.hpp"

namespace courant {

namespace {

struct NonlinearPlasticBeam : DiscreteBeamCard {
  /// Null behind an error.
  std::shared_ptr<DiscreteBeamLaw> law(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    constexpr std::array fields{"LCPDR", "LCPDS", "LCPDT", "LCPMR", "LCPMS", "LCPMT"};
    const std::array curves{lcpdr, lcpds, lcpdt, lcpmr, lcpms, lcpmt};
    auto out = std::make_shared<DiscreteBeamLaw>();
    put_shared(*out), put_linear(*out), put_limits(*out);
    bool good = true;
    for (std::size_t d = 0; d < 6; ++d) {
      BeamSpring& spring = out->springs[d];
      if (curves[d] == 0 || spring.k == 0) continue;  // without a stiffness there is nothing that yields
      const Curve* curve = beam_curve(deck, model, *this, fields[d], curves[d], diagnostics);
      good = curve && yields(deck, fields[d], spring.k, *curve, diagnostics) && good;
      if (curve) spring.yield = YieldCurve(*curve);
    }
    return good ? out : nullptr;
  }

 private:
  bool yields(const Deck& deck, const char* field, Real k, const Curve& curve,
              Diagnostics& diagnostics) const {
    const auto error = [&](std::string what, std::string hint) {
      deck.error(diagnostics, *this, field, std::move(what), std::move(hint));
      return false;
    };
    const std::vector<Real>&x = curve.abscissa, &y = curve.ordinate;
    if (x[0] != 0 || !(y[0] > 0))
      return error(
          fmt::format("curve {} starts at {:g}, {:g}", curve.id, x[0], y[0]),
          "its first point is the plastic displacement 0 and the force, above 0, at which it yields");
    for (std::size_t p = 0; p + 1 < x.size(); ++p) {
      const Real slope = slope_of_piece(x, y, p);
      if (slope <= -k)
        return error(
            fmt::format("curve {} falls with {:g}, faster than the stiffness {:g}", curve.id, slope, k),
            "give it a smaller slope: the spring would tear at once");
      if (p + 2 == x.size() && slope < 0)
        return error(fmt::format("curve {} falls at its end, and would go on below 0", curve.id),
                     "let its last piece be level");
    }
    return true;
  }
};

const RegisterDiscreteBeam<NonlinearPlasticBeam> mat_nonlinear_plastic_discrete_beam{
    mat_nonlinear_plastic_discrete_beam_table()};

}  // namespace

}  // namespace courant
