// *MAT_FRAZER_NASH_RUBBER_MODEL: Kenchington 1988, with constants given.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/eigenvalues.hpp"
#include "keyword/expectations.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/left_cauchy_green.hpp"

namespace courant {

namespace {

struct MatFrazerNashRubber : MatFrazerNashRubberFields {
  /// At rest: the terms of the second degree, with those of -C100 ln J.
  Real shear() const { return c100 - 0.5 * c010; }
  Real bulk() const { return 2 * shear() * (1 + pr) / (3 * (1 - 2 * pr)); }
  /// Factor of (J - 1)^2/2, so that the bulk modulus is the one above.
  Real volumetric() const { return bulk() - 2 * c200 - 2 * (c100 + c010) / 3; }
  std::shared_ptr<StrengthLaw> law() const;
  void check(const Deck& deck, Diagnostics& diagnostics) const;
};

/// First and second derivatives of U by the invariants. [M/LT2]
struct Slopes {
  Real u1, u2, u11, u12, u22;
};

/// U(I1, I2) + f(J), f = -C100 ln J + volumetric (J - 1)^2/2, I1 and I2 of the Green strain (b - 1)/2:
///   sigma = ((u1 + u2 (I1 + 1/2)) b - u2/2 b^2)/J + f' 1.
class FrazerNash : public StrengthLaw {
 public:
  explicit FrazerNash(const MatFrazerNashRubber& card)
      : c_(card), K_(card.bulk()), G_(card.shear()), volumetric_(card.volumetric()) {
    ro = card.ro;
  }
  Real bulk_modulus() const override { return K_; }
  Real shear_modulus() const override { return G_; }
  std::vector<HistoryVariable> history() const override { return {left_cauchy_green}; }
  bool stiffens() const override { return true; }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Symmetric b = strained(block, i), b2 = b.squared();
      const Real trace = b.trace(), J = std::sqrt(b.determinant());
      const Real I1 = 0.5 * (trace - 3);
      const Real squares = 0.25 * (b2.trace() - 2 * trace + 3), I2 = 0.5 * (I1 * I1 - squares);
      const Slopes u = slopes(I1, I2);
      const Real linear = (u.u1 + u.u2 * (I1 + 0.5)) / J, square = 0.5 * u.u2 / J;
      const Real mean = volumetric_ * (J - 1) - c_.c100 / J;
      const Real s[6] = {linear * b.xx - square * b2.xx + mean, linear * b.yy - square * b2.yy + mean,
                         linear * b.zz - square * b2.zz + mean, linear * b.xy - square * b2.xy,
                         linear * b.yz - square * b2.yz,        linear * b.zx - square * b2.zx};
      for (std::size_t k = 0; k < 6; ++k) block.stress[k][i] = s[k];
      block.sound_speed[i] = std::sqrt(std::max(stiffest(b, u, I1, J), K_ + 4 * G_ / 3) / ro);
    }
  }

 private:
  Slopes slopes(Real x, Real y) const {
    const MatFrazerNashRubber& c = c_;
    return {c.c100 + x * (2 * c.c200 + x * (3 * c.c300 + x * 4 * c.c400)) + (c.c110 + 2 * c.c210 * x) * y,
            c.c010 + x * (c.c110 + c.c210 * x) + 2 * c.c020 * y,
            2 * c.c200 + x * (6 * c.c300 + x * 12 * c.c400) + 2 * c.c210 * y, c.c110 + 2 * c.c210 * x,
            2 * c.c020};
  }
  /// rho0 c^2 of a wave along a principal axis: l^2 d2W/dl2 = b S + b^2 dS/dE + J^2 f'', S = u1 + u2 (I1 -
  /// E).
  Real stiffest(const Symmetric& b, const Slopes& u, Real I1, Real J) const {
    const Matrix at = b.matrix();
    const Real least = least_eigenvalue(at), largest = -least_eigenvalue(Matrix(-at));
    const Real along[3] = {least, b.trace() - least - largest, largest};
    Real most = 0;
    for (const Real l2 : along) {
      const Real rest = I1 - 0.5 * (l2 - 1);
      most = std::max(most,
                      l2 * (u.u1 + u.u2 * rest) + l2 * l2 * (u.u11 + 2 * u.u12 * rest + u.u22 * rest * rest));
    }
    return most + c_.c100 + volumetric_ * J * J;
  }

  MatFrazerNashRubber c_;
  Real K_, G_, volumetric_;  ///< [M/LT2]
};

std::shared_ptr<StrengthLaw> MatFrazerNashRubber::law() const {
  return std::make_shared<FrazerNash>(*this);
}

void MatFrazerNashRubber::check(const Deck& deck, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  expect(pr < 0.5, "PR", "a number < 0.5", pr, "0.49 to 0.495 is rubber that hardly changes its volume");
  expect(shear() > 0, "C100", "C100 - C010/2 > 0", shear(), "it is the shear modulus at rest");
  expect(pr >= 0.5 || !(shear() > 0) || volumetric() > 0, "PR", "a number nearer to 0.5", pr,
         "C100, C200 and C010 alone give a bulk modulus above that of PR");
  if (exit == 1 && (emax != 0 || emin != 0))
    deck.warning(diagnostics, *this, "EXIT", "the run goes on beyond the strains EMAX and EMIN",
                 "the law is the same there; *MAT_ADD_EROSION deletes elements at a strain");
}

// By hand. Step exp about x: D dt = (2/3, 0, 0): A = 2, b = (4, 1, 1), J = 2, E = (3/2, 0, 0): I1 = 3/2, I2 =
// 0. C100 = 1: G = 1, PR 0.25: K = 5/3, volumetric 1: sigma = b/2 + 1 - 1/2. With C010 = 1, C200 = 1/2, C110
// = 2, C300 = 1/9, C210 = C020 = 1 and C400 = 2/27 besides: G = 1/2; PR 0.45: K = 29/6, volumetric 2.5; u1 =
// 1
// + 3/2 + 3/4 + 1, u2 = 1 + 3 + 9/4: sigma = ((4.25 + 12.5) b - 3.125 b^2)/2 + 2.5 - 1/2.
const RegisterStrength<MatFrazerNashRubber> mat_frazer_nash_rubber{
    "W = C100 I1 + C200 I1^2 + C300 I1^3 + C400 I1^4 + C110 I1 I2 + C210 I1^2 I2 + C010 I2 + C020 I2^2 - "
    "C100 ln J + k (J - 1)^2/2, I1, I2 of the Green strain; k of PR",
    "Kenchington 1988; volume: ours",
    {{"1,2.0,0.25,1.0\n\n", {2.0 / 3}, {}, {2.5, 1, 1}, {}, {3, 0, 0, 0, 0, 0}},
     {"1,2.0,0.45,1.0,0.5,0.1111111111111111,0.07407407407407407\n2.0,1.0,1.0,1.0\n",
      {2.0 / 3},
      {},
      {10.5, 8.8125, 8.8125},
      {},
      {3, 0, 0, 0, 0, 0}},
     {"1,2.0,0.25,1.0\n\n", {-2.0 / 3}, {9, 9, 9}, {0, 0, 0}, {3, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}}},
    mat_frazer_nash_rubber_model_table()};

}  // namespace

}  // namespace courant
