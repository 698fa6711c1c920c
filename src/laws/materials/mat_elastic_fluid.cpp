#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// A fluid with a bulk modulus: dp/dt = -K tr(D), no shear stress, tension up to the cavitation pressure.
class ElasticFluid : public StrengthLaw {
 public:
  ElasticFluid(Real density, Real K, Real cavitation) : bulk_(K), cavitation_(cavitation) { ro = density; }
  Real bulk_modulus() const override { return bulk_; }
  Real shear_modulus() const override { return 0; }

  void update(const PointBlock& block) const override {
    const Real *dxx = block.rate[0], *dyy = block.rate[1], *dzz = block.rate[2];
    Real *xx = block.stress[0], *yy = block.stress[1], *zz = block.stress[2];
    const Real K_dt = bulk_ * block.dt, c0 = sound_speed();
    for (Index i = 0; i < block.count; ++i) {
      const Real mean = (xx[i] + yy[i] + zz[i]) / 3 + K_dt * (dxx[i] + dyy[i] + dzz[i]);
      xx[i] = yy[i] = zz[i] = std::min(mean, cavitation_);
    }
    for (int k = 3; k < 6; ++k) std::fill_n(block.stress[k], block.count, 0.0);
    for (Index i = 0; i < block.count; ++i)
      block.sound_speed[i] = block.compression ? c0 / std::sqrt(1 + block.compression[i]) : c0;
  }

 private:
  Real bulk_, cavitation_;
};

struct MatElasticFluid : MatElasticFluidFields {
  Real bulk() const { return k > 0 ? k : E / (3 * (1 - 2 * pr)); }
  std::shared_ptr<StrengthLaw> law() const { return std::make_shared<ElasticFluid>(ro, bulk(), cp); }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    if (k > 0) return;
    if (!(E > 0))
      deck.error(diagnostics, *this, "K", "the fluid has no bulk modulus: K is 0, and so is E",
                 "give K, or E and PR");
    else if (!(pr < 0.5))
      deck.error(diagnostics, *this, "PR", fmt::format("expected a number < 0.5, got '{:g}'", pr),
                 "a material that keeps its volume has no finite bulk modulus");
  }
};

// By hand: K = 3, tr(D) dt = 0.1: p falls by 0.3. E = 3, PR = 1/4: K = 2. Cavitation at 0.5: tension of 0.9
// is cut.
const RegisterStrength<MatElasticFluid> mat_elastic_fluid{
    "dp/dt = -K tr(D), K = E/(3 (1 - 2 PR)) where it is 0; p >= -CP; no shear stress",
    "linear compressibility; Hooke's law without shear",
    {{"1,2.0,,,,,3.0\n\n", {0.1, 0, 0, 0.5, 0, 0}, {-1, -1, -1}, {-0.7, -0.7, -0.7}},
     {"1,2.0,3.0,0.25\n\n", {0, 0.1, 0.1, 0, 0, 0}, {-1, -1, -1}, {-0.6, -0.6, -0.6}},
     {"1,2.0,,,,,3.0\n,0.5\n", {0.3, 0, 0, 0, 0, 0}, {}, {0.5, 0.5, 0.5}}},
    mat_elastic_fluid_table()};

}  // namespace

}  // namespace courant
