#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/left_cauchy_green.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// With the invariants I1, I2 and I3 = J^2 of b
///   sigma = 2/J ((A + B I1) b - B b^2 + I3 (2 D (I3 - 1) - 2 C I3^-3) 1).
class MooneyRivlin : public StrengthLaw {
 public:
  MooneyRivlin(Real density, Real A, Real B, Real nu)
      : A_(A), B_(B), C_(0.5 * A + B), D_((A * (5 * nu - 2) + B * (11 * nu - 5)) / (2 * (1 - 2 * nu))) {
    ro = density;
  }
  // the modulus of uniaxial strain at rest is 2 A + 4 B + 20 C + 8 D
  Real bulk_modulus() const override { return 2 * A_ + 4 * B_ + 20 * C_ + 8 * D_ - 4 * shear_modulus() / 3; }
  Real shear_modulus() const override { return 2 * (A_ + B_); }
  std::vector<HistoryVariable> history() const override { return {left_cauchy_green}; }
  bool stiffens() const override { return true; }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Symmetric b = strained(block, i);
      const Symmetric b2 = b.squared();
      const Real I1 = b.trace(), I3 = b.determinant(), J = std::sqrt(I3);
      const Real linear = 2 / J * (A_ + B_ * I1), square = 2 / J * B_;
      const Real mean = 2 / J * I3 * (2 * D_ * (I3 - 1) - 2 * C_ / (I3 * I3 * I3));
      const Real s[6] = {linear * b.xx - square * b2.xx + mean, linear * b.yy - square * b2.yy + mean,
                         linear * b.zz - square * b2.zz + mean, linear * b.xy - square * b2.xy,
                         linear * b.yz - square * b2.yz,        linear * b.zx - square * b2.zx};
      for (std::size_t k = 0; k < 6; ++k) block.stress[k][i] = s[k];
      block.sound_speed[i] = std::sqrt(stiffest(b, b2, I3) / ro);
    }
  }

 private:
  /// rho0 c^2 of a wave along a principal axis with stretch l: l^2 d2W/dl2 = 2 A l^2 + 2 B l^2 (I1 - l^2) +
  /// 20 C/I3^2 + D (12 I3^2 - 4 I3), with a bound of the largest l^2.
  Real stiffest(const Symmetric& b, const Symmetric& b2, Real I3) const {
    const Real I1 = b.trace(), deviator2 = std::max(b2.trace() - I1 * I1 / 3, Real(0));
    const Real l2 = I1 / 3 + std::sqrt(2.0 / 3 * deviator2), at = std::min(l2, 0.5 * I1);
    return 2 * A_ * l2 + 2 * B_ * at * (I1 - at) + 20 * C_ / (I3 * I3) + D_ * (12 * I3 * I3 - 4 * I3);
  }

  Real A_, B_, C_, D_;
};

struct MatMooneyRivlinRubber : MatMooneyRivlinRubberFields {
  std::shared_ptr<StrengthLaw> law() const { return std::make_shared<MooneyRivlin>(ro, a, b, pr); }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    if (!(pr < 0.5))
      deck.error(diagnostics, *this, "PR", fmt::format("expected a number < 0.5, got '{:g}'", pr),
                 "0.49 to 0.495 is rubber that hardly changes its volume");
    if (!(a + b > 0))
      deck.error(diagnostics, *this, "A", fmt::format("expected A + B > 0, got '{:g}'", a + b),
                 lcid != 0 ? "a fit to the curve of LCID is not supported: give A and B"
                           : "the shear modulus is 2 (A + B)");
  }
};

// By hand. Step exp about x: D dt = (2/3, 0, 0): A = 2, b = (4, 1, 1), I1 = 6, I3 = 4, J = 2. A = 1, B = 0,
// PR 0.4: C = 1/2, D = 0: sigma = b - 1/16. A = B = 1, PR 0.45: C = 3/2, D = 1: 7 b - b^2 + 4 (6 - 3/64).
// From there back by (-2/3, 0, 0) to rest.
const RegisterStrength<MatMooneyRivlinRubber> mat_mooney_rivlin{
    "W = A (I1 - 3) + B (I2 - 3) + C (1/I3^2 - 1) + D (I3 - 1)^2, C = A/2 + B, D = (A (5 PR - 2) + B (11 PR "
    "- "
    "5))/(2 (1 - 2 PR)); sigma = 2/J b dW/db",
    "Mooney 1940, Rivlin 1948; volume as in LS-DYNA",
    {{"1,2.0,0.4,1.0,0.0\n", {2.0 / 3}, {}, {3.9375, 0.9375, 0.9375}, {}, {3, 0, 0, 0, 0, 0}},
     {"1,2.0,0.45,1.0,1.0\n", {2.0 / 3}, {}, {35.8125, 29.8125, 29.8125}, {}, {3, 0, 0, 0, 0, 0}},
     {"1,2.0,0.45,1.0,1.0\n", {-2.0 / 3}, {9, 9, 9}, {0, 0, 0}, {3, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}}},
    mat_mooney_rivlin_rubber_table()};

}  // namespace

}  // namespace courant
