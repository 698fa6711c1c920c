#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/left_cauchy_green.hpp"

namespace courant {

namespace {

/// Nominal stress over nominal strain e = l - 1 of each principal direction for itself: E e in tension, at
/// most TC, and -f(-e) in compression.
struct FoamCurve {
  Real E = 0, tension = 0;  ///< [M/LT2]
  bool tears = false;       ///< FAIL 1: beyond TC there is no tension
  Curve f{};                ///< over the nominal strain of compression, from (0, 0) on
  Real at(Real e) const {
    if (e < 0) return -f(-e);
    return E * e <= tension ? E * e : tears ? 0 : tension;
  }
  /// The larger of E and of the curve's slope where it is. [M/LT2]
  Real stiffness(Real e) const {
    const auto& x = f.abscissa;
    const auto above = std::upper_bound(x.begin(), x.end(), -e);
    if (e >= 0 || above == x.end() || above == x.begin()) return E;
    const auto k = static_cast<std::size_t>(above - x.begin());
    return std::max(E, (f.ordinate[k] - f.ordinate[k - 1]) / (x[k] - x[k - 1]));
  }
  /// Of compression to -e, of what is loaded for the first time. [M/LT2]
  Real energy(Real e) const {
    Real sum = 0;
    const auto& x = f.abscissa;
    for (std::size_t k = 1; k < x.size() && x[k - 1] < -e; ++k) {
      const Real to = std::min(x[k], -e);
      sum += 0.5 * (f(x[k - 1]) + f(to)) * (to - x[k - 1]);
    }
    return sum + std::max(-e - x.back(), Real(0)) * f.ordinate.back();
  }
};

/// Foam of low density, which comes back: sigma_k = tau(l_k - 1)/(l_i l_j) along the principal axes of b.
/// Where it has been compressed more, compression is (1 - d) tau, d = (1 - HU) (1 - (W/W_most)^SHAPE) with
/// the energy W of compression.
class LowDensityFoam : public StrengthLaw {
 public:
  LowDensityFoam(Real density, FoamCurve curve, Real HU, Real shape, bool viscous)
      : curve_(std::move(curve)), unloading_(HU), shape_(shape) {
    ro = density, bulk_viscosity = viscous;
  }
  // as of Hooke's law without lateral contraction
  Real bulk_modulus() const override { return curve_.E / 3; }
  Real shear_modulus() const override { return curve_.E / 2; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{left_cauchy_green};
    if (unloading_ < 1) out.push_back({"most_energy", "M/LT2"});
    return out;
  }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Eigen::SelfAdjointEigenSolver<Matrix> stretched(strained(block, i).matrix());
      const Vec l = stretched.eigenvalues().cwiseSqrt();
      const Real J = l.prod();
      const Unloading back = unloading_ < 1 ? unload(l, block.history[6][i]) : Unloading();
      Vec principal;
      Real stiffest = 0;
      for (int k = 0; k < 3; ++k) {
        const Real nominal = curve_.at(l[k] - 1);
        principal[k] = (nominal < 0 ? back.keeps * nominal : nominal) * l[k] / J;
        const Real steeper = nominal < 0 ? back.steeper * nominal * nominal : 0;
        stiffest = std::max(stiffest, l[k] * l[k] * (curve_.stiffness(l[k] - 1) + steeper));
      }
      const Matrix& axes = stretched.eigenvectors();
      const Matrix now = axes * principal.asDiagonal() * axes.transpose();
      block.stress[0][i] = now(0, 0), block.stress[1][i] = now(1, 1), block.stress[2][i] = now(2, 2);
      block.stress[3][i] = now(0, 1), block.stress[4][i] = now(1, 2), block.stress[5][i] = now(0, 2);
      block.sound_speed[i] = std::sqrt(stiffest / ro);
    }
  }

 private:
  /// d tau/de is keeps f' + steeper f^2, also where unloading is about to begin.
  struct Unloading {
    Real keeps = 1, steeper = 0;  ///< [-], [LT2/M]
  };
  Unloading unload(const Vec& l, Real& most) const {
    const Real W = curve_.energy(l[0] - 1) + curve_.energy(l[1] - 1) + curve_.energy(l[2] - 1);
    most = std::max(most, W);
    if (!(W > 0)) return {unloading_, 0};
    const Real left = std::pow(W / most, shape_);
    return {1 - (1 - unloading_) * (1 - left), (1 - unloading_) * shape_ * left / W};
  }
  FoamCurve curve_;
  Real unloading_, shape_;
};

using LowDensity = struct MatLowDensityFoam;
struct MatLowDensityFoam : MatLowDensityFoamFields {
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    const auto curve = model.curves.find(lcid);
    return std::make_shared<LowDensityFoam>(
        ro,
        FoamCurve{.E = E,
                  .tension = tc,
                  .tears = fail == 1,
                  .f = curve == model.curves.end() ? Curve() : curve->second},
        hu, shape, bvflag == 1);
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

void LowDensity::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = [&](bool holds, const char* field, const std::string& what, const char* hint) {
    if (!holds) deck.error(diagnostics, *this, field, what, hint);
  };
  expect(hu <= 1, "HU", fmt::format("expected a number from 0 to 1, got '{:g}'", hu),
         "the share of stress that is left where all of it has been unloaded; 1: none is lost");
  expect(fail == 0 || fail == 1, "FAIL", fmt::format("expected 0 or 1, got '{:g}'", fail),
         "0: the tension stays TC; 1: it is gone beyond TC");
  expect(bvflag == 0 || bvflag == 1, "BVFLAG", fmt::format("expected 0 or 1, got '{:g}'", bvflag),
         "0: no bulk viscosity; 1: that of *CONTROL_BULK_VISCOSITY");
  if (damp != 0)
    deck.warning(diagnostics, *this, "DAMP",
                 "the viscous stress of the foam is left out: stresses at high rates are lower",
                 "BVFLAG 1 takes bulk viscosity (*CONTROL_BULK_VISCOSITY)");
  const auto found = model.curves.find(lcid);
  if (found == model.curves.end()) return;
  const std::vector<Real>&strain = found->second.abscissa, &stress = found->second.ordinate;
  expect(strain.size() > 1 && strain.front() == 0 && stress.front() == 0, "LCID",
         fmt::format("curve {} does not start at (0, 0)", lcid),
         "nominal stress over nominal strain of compression, both positive");
  const bool grows = std::is_sorted(strain.begin(), strain.end(), std::less_equal<>()) &&
                     *std::min_element(stress.begin(), stress.end()) >= 0;
  expect(grows, "LCID", fmt::format("curve {} jumps or has stresses below 0", lcid),
         "nominal stress over nominal strain of compression, both positive");
}

const std::string loading = "*DEFINE_CURVE\n5\n0.0,0.0\n0.25,1.0\n1.0,4.0\n";
// By hand. E = 10; f = 4 e. D dt = (-2/3, 0, 0): l = 1/2, J = 1/2: f = 2 over an area that is as it was, W =
// 1/2. From there by (2/5, 0, 0), A = 3/2, to l = 3/4, f = 1, W = 1/8: with HU = 0, SHAPE = 1/2 half of it is
// left. Pulled by 2/21: l = 1.1, 1.0. Compressed to l = 1/2 in y and z: sigma_y = -2/(1/2).
const RegisterStrength<LowDensity> mat_low_density_foam{
    "sigma_k = tau(l_k - 1)/(l_i l_j), tau = E e <= TC, in compression the curve; unloading (1 - d) tau, d = "
    "(1 - HU) (1 - "
    "(W/W_most)^SHAPE)",
    "LS-DYNA's MAT_057 without creep: principal stresses for themselves; unloading as its MAT_083 has it",
    {{"1,2.0,10.0,5\n" + loading, {-2.0 / 3}, {}, {-2, 0, 0}, {}, {-0.75, 0, 0, 0, 0, 0}},
     {"1,2.0,10.0,5\n" + loading, {0, -2.0 / 3, -2.0 / 3}, {}, {0, -4, -4}, {}, {0, -0.75, -0.75, 0, 0, 0}},
     {"1,2.0,10.0,5\n" + loading, {2.0 / 21}, {}, {1, 0, 0}, {}, {0.21, 0, 0, 0, 0, 0}},
     {"1,2.0,10.0,5,0.5\n" + loading, {2.0 / 21}, {}, {0.5, 0, 0}},
     {"1,2.0,10.0,5,0.5\n1.0,1.0\n" + loading, {2.0 / 21}, {}, {0, 0, 0}},
     {"1,2.0,10.0,5,,1e-20\n0.5\n" + loading,
      {0.4},
      {-2},
      {-0.5, 0, 0},
      {-0.75, 0, 0, 0, 0, 0, 0.5},
      {-0.4375, 0, 0, 0, 0, 0, 0.5}}},
    mat_low_density_foam_table()};

}  // namespace

}  // namespace courant
