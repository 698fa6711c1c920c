#include <fmt/format.h>
#include <cmath>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// Linear between the rates of strain and of (turned) stress: sigma += (lambda tr(D) 1 + 2 G D) dt.
class Elastic : public StrengthLaw {
 public:
  Elastic(Real density, Real E, Real nu)
      : lambda_(E * nu / ((1 + nu) * (1 - 2 * nu))), shear_(E / (2 * (1 + nu))) {
    ro = density;
  }
  Real bulk_modulus() const override { return lambda_ + 2 * shear_ / 3; }
  Real shear_modulus() const override { return shear_; }

  void update(const PointBlock& block) const override {
    const Real volumetric = lambda_ * block.dt, twice = 2 * shear_ * block.dt;
    const Real *dxx = block.rate[0], *dyy = block.rate[1], *dzz = block.rate[2];
    Real* __restrict xx = block.stress[0], * __restrict yy = block.stress[1], * __restrict zz = block.stress[2];
    for (Index i = 0; i < block.count; ++i) {
      const Real common = volumetric * (dxx[i] + dyy[i] + dzz[i]);
      xx[i] += common + twice * dxx[i];
      yy[i] += common + twice * dyy[i];
      zz[i] += common + twice * dzz[i];
    }
    for (int k = 3; k < 6; ++k) {
      const Real* d = block.rate[k];
      Real* __restrict s = block.stress[k];
      for (Index i = 0; i < block.count; ++i) s[i] += twice * d[i];
    }
    keep_stiffness(block, sound_speed());
  }

  /// D zz = -lambda/(lambda + 2 G) (D xx + D yy).
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    const Real thinning = -lambda_ / (lambda_ + 2 * shear_), twice = 2 * shear_ * block.dt;
    const Real volumetric = lambda_ * (1 + thinning) * block.dt;
    const Real *dxx = block.rate[0], *dyy = block.rate[1];
    Real* __restrict xx = block.stress[0], * __restrict yy = block.stress[1], * __restrict zz = rate_zz;
    for (Index i = 0; i < block.count; ++i) {
      const Real trace = dxx[i] + dyy[i];
      xx[i] += volumetric * trace + twice * dxx[i];
      yy[i] += volumetric * trace + twice * dyy[i];
      zz[i] = thinning * trace;
    }
    for (int k = 3; k < 6; ++k) {
      const Real* d = block.rate[k];
      Real* __restrict s = block.stress[k];
      for (Index i = 0; i < block.count; ++i) s[i] += twice * d[i];
    }
    keep_stiffness(block, sound_speed());
  }

 private:
  Real lambda_, shear_;
};

struct MatElastic : MatElasticFields {
  std::shared_ptr<StrengthLaw> law() const { return std::make_shared<Elastic>(ro, E, pr); }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    if (!(pr < 0.5))
      deck.error(diagnostics, *this, "PR", fmt::format("expected a number < 0.5, got '{:g}'", pr),
                 "a material that keeps its volume has no finite bulk modulus");
  }
};

// By hand: E = 2.5, PR = 1/4: lambda = G = 1, K = 5/3.
const RegisterStrength<MatElastic> mat_elastic{
    "dsigma/dt = lambda tr(D) 1 + 2 G D, turned with the body; lambda = E PR/((1 + PR)(1 - 2 PR)), G = E/(2 "
    "(1 + PR))",
    "Hooke's law between rates (hypoelastic), with the objective update of Hughes & Winget 1980",
    {{"1,2.0,2.5,0.25\n", {0.1, 0, 0, 0, 0, 0}, {1, 2, 3, 4, 5, 6}, {1.3, 2.1, 3.1, 4, 5, 6}},
     {"1,2.0,2.5,0.25\n", {0, 0, 0, 0.1, 0.2, 0.3}, {0, 0, 0, 0, 0, 0}, {0, 0, 0, 0.2, 0.4, 0.6}}},
    mat_elastic_table()};

}  // namespace

}  // namespace courant
