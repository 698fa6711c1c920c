#include <algorithm>
#include <cmath>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/left_cauchy_green.hpp"

namespace courant {

namespace {

/// W = G/2 (I1 - 3 + (1 - 2 nu)/nu (J^(-2 nu/(1 - 2 nu)) - 1)) with nu = 0.463:
///   sigma = G (b/J - J^(-1/(1 - 2 nu)) 1).
class BlatzKo : public StrengthLaw {
 public:
  BlatzKo(Real density, Real G) : G_(G) { ro = density; }
  Real bulk_modulus() const override { return 2 * G_ * (1 + nu) / (3 * (1 - 2 * nu)); }
  Real shear_modulus() const override { return G_; }
  std::vector<HistoryVariable> history() const override { return {left_cauchy_green}; }
  bool stiffens() const override { return true; }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Symmetric b = strained(block, i);
      const Real J = std::sqrt(b.determinant()), linear = G_ / J, mean = G_ * std::pow(J, -1 / (1 - 2 * nu));
      block.stress[0][i] = linear * b.xx - mean, block.stress[1][i] = linear * b.yy - mean;
      block.stress[2][i] = linear * b.zz - mean, block.stress[3][i] = linear * b.xy;
      block.stress[4][i] = linear * b.yz, block.stress[5][i] = linear * b.zx;
      block.sound_speed[i] = std::sqrt(stiffest(b, J) / ro);
    }
  }

 private:
  static constexpr Real nu = 0.463;
  /// rho0 c^2 of a wave along a principal axis with stretch l: l^2 d2W/dl2 = G (l^2 + J^-m (1 + m)), m = 2
  /// nu/(1 - 2 nu), with a bound of the largest l^2.
  Real stiffest(const Symmetric& b, Real J) const {
    constexpr Real m = 2 * nu / (1 - 2 * nu);
    const Real I1 = b.trace(), deviator2 = std::max(b.squared().trace() - I1 * I1 / 3, Real(0));
    return G_ * (I1 / 3 + std::sqrt(2.0 / 3 * deviator2) + std::pow(J, -m) * (1 + m));
  }
  Real G_;
};

using Blatz = struct MatBlatzKoRubber;
struct MatBlatzKoRubber : MatBlatzKoRubberFields {
  std::shared_ptr<StrengthLaw> law() const { return std::make_shared<BlatzKo>(ro, g); }
};

// By hand. Steps exp: D dt = (2/3, -2/5, 0): A = (2, 2/3, 1), b = (4, 4/9, 1), J = 4/3; J^(-1/0.074) =
// (3/4)^13.5135135...
const Real blatz_mean = std::pow(0.75, 1 / 0.074);
const RegisterStrength<Blatz> mat_blatz_ko_rubber{
    "sigma = G (b/V - V^(-1/(1 - 2 nu)) 1), nu = 0.463, V the ratio of volumes",
    "Blatz & Ko 1962, the form for polyurethane rubber that keeps its volume",
    {{"1,2.0,2.0\n",
      {2.0 / 3, -0.4},
      {},
      {6 - 2 * blatz_mean, 2.0 / 3 - 2 * blatz_mean, 1.5 - 2 * blatz_mean}}},
    mat_blatz_ko_rubber_table()};

}  // namespace

}  // namespace courant
