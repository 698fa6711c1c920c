#include <cmath>

#include <fmt/format.h>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// The standard linear solid in shear: 2 GI of the deviator of strain beside a Maxwell element of G0 - GI,
/// whose stress m decays. Of a rate that is constant in the step
///   m_new = f m + 2 (G0 - GI) (1 - f)/BETA dev(D),  f = exp(-BETA dt),
/// is exact.
class Viscoelastic : public StrengthLaw {
 public:
  Viscoelastic(Real density, Real bulk, Real G0, Real GI, Real beta)
      : bulk_(bulk), short_(G0), long_(GI), beta_(beta) {
    ro = density;
  }
  Real bulk_modulus() const override { return bulk_; }
  Real shear_modulus() const override { return short_; }
  std::vector<HistoryVariable> history() const override { return {{"maxwell_stress", "M/LT2", 6}}; }

  void update(const PointBlock& block) const override {
    const auto& D = block.rate;
    const Real x = beta_ * block.dt, keeps = std::exp(-x);
    const Real grows = 2 * (short_ - long_) * block.dt * (x > 0 ? -std::expm1(-x) / x : 1);
    const Real stays = 2 * long_ * block.dt, volumetric = bulk_ * block.dt;
    for (Index i = 0; i < block.count; ++i) {
      const Real trace = D[0][i] + D[1][i] + D[2][i];
      for (std::size_t k = 0; k < 6; ++k) {
        const Real deviator = D[k][i] - (k < 3 ? trace / 3 : 0);
        Real& m = block.history[k][i];
        const Real now = keeps * m + grows * deviator;
        block.stress[k][i] += (k < 3 ? volumetric * trace : 0) + stays * deviator + now - m;
        m = now;
      }
    }
    keep_stiffness(block, sound_speed());
  }

 private:
  Real bulk_, short_, long_, beta_;
};

struct MatViscoelastic : MatViscoelasticFields {
  std::shared_ptr<StrengthLaw> law() const { return std::make_shared<Viscoelastic>(ro, bulk, g0, gi, beta); }
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
const RegisterStrength<MatViscoelastic> mat_viscoelastic{
    "s = 2 int G(t - u) dev(D)(u) du, G(t) = GI + (G0 - GI) exp(-BETA t), turned with the body; pressure by "
    "BULK",
    "Herrmann & Peterson 1968",
    {{"1,2.0,1.6666666666666667,3.0,1.0,1.3862943611198906\n",
      {2, -1, -1},
      {},
      {2 * (2 + relaxing_part), -2 - relaxing_part, -2 - relaxing_part},
      {},
      {2 * relaxing_part, -relaxing_part, -relaxing_part, 0, 0, 0}},
     {"1,2.0,1.6666666666666667,3.0,1.0,1.3862943611198906\n",
      {},
      {6, -3, -3, 2, 0, 0},
      {5, -2.5, -2.5, 1.5, 0, 0},
      {2, -1, -1, 1, 0, 0},
      {1, -0.5, -0.5, 0.5, 0, 0}},
     {"1,2.0,1.6666666666666667,3.0,1.0\n", {1, 1, 1, 0.5, 0, 0}, {}, {5, 5, 5, 3, 0, 0}}},
    mat_viscoelastic_table()};

}  // namespace

}  // namespace courant
