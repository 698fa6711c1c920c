// Crushable foam whose yield stresses in uniaxial and in even compression are curves of their own: an ellipse
// over the pressure p and q = sqrt(3/2 s:s).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>

#include "base/straight_pieces.hpp"
#include "keyword/expectations.hpp"
#include "laws/materials/foam_cards.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// Yield stresses of a foam at one volume and rate. [M/LT2]
struct FoamLimits {
  Real pressure, uniaxial;  ///< in even and in uniaxial compression
  Real cutoff, tension;     ///< tensile pressure, and principal tension
  /// The share of a stress, at most 1, that is on the ellipse through (-cutoff, 0), (uniaxial/3, uniaxial),
  /// (pressure, 0).
  Real share(Real p, Real q) const {
    const Real centre = 0.5 * (pressure - cutoff), half = 0.5 * (pressure + cutoff);
    const Real off = (uniaxial / 3 - centre) / half, height = uniaxial / std::sqrt(1 - off * off);
    const Real square = p * p / (half * half) + q * q / (height * height);
    const Real linear = p * centre / (half * half), inside = pressure * cutoff / (half * half);
    if (!(square - 2 * linear > inside)) return 1;
    return (linear + std::sqrt(linear * linear + square * inside)) / square;
  }
};

struct MatBilkhuDuboisFoam : MatBilkhuDuboisFoamFields {
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  void check_curves(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

/// Elastic below the ellipse. Plastic strain has the Poisson ratio of the elastic one, so that stress returns
/// along its ray.
class BilkhuDuboisFoam : public StrengthLaw {
 public:
  BilkhuDuboisFoam(const MatBilkhuDuboisFoam& card, const Model& model)
      : card_(card),
        lambda_(card.ym * card.pr / ((1 + card.pr) * (1 - 2 * card.pr))),
        G_(card.ym / (2 * (1 + card.pr))),
        pressure_(pieces(model, card.lcpy)),
        uniaxial_(pieces(model, card.lcuys)),
        factor_(pieces(model, card.lcrate)) {
    ro = card.ro;
    if (!pressure_.empty()) cutoff_ = card.pc > 0 ? card.pc : 0.1 * pressure_(0);
  }
  Real bulk_modulus() const override { return lambda_ + 2 * G_ / 3; }
  Real shear_modulus() const override { return G_; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{"logarithmic_volume", "-"}};
    if (!factor_.empty()) out.push_back({"mean_crush_rate", "1/T"});
    return out;
  }

  void update(const PointBlock& block) const override {
    const auto& D = block.rate;
    for (Index i = 0; i < block.count; ++i) {
      const Real opens = D[0][i] + D[1][i] + D[2][i];
      for (std::size_t k = 0; k < 6; ++k)
        block.stress[k][i] += block.dt * ((k < 3 ? lambda_ * opens : 0) + 2 * G_ * D[k][i]);
      block.history[0][i] += block.dt * opens;
      const FoamLimits limits = limits_at(block, i, opens);
      scale(block, i, limits);
      if (cut_tension(block, i, limits.tension)) scale(block, i, limits);
    }
    keep_stiffness(block, sound_speed());
  }

 private:
  static StraightPieces pieces(const Model& model, Id id) {
    const auto found = model.curves.find(id);
    if (id == 0 || found == model.curves.end()) return {};
    return {found->second.abscissa, found->second.ordinate};
  }
  FoamLimits limits_at(const PointBlock& block, Index i, Real opens) const {
    Real factor = 1;
    if (!factor_.empty()) {
      Real& mean = block.history[1][i];
      if (block.dt > 0) mean += 2 / (card_.ncycle + 1) * (-opens - mean);
      factor = factor_(std::max(mean, Real(0)));
    }
    const Real crushed = std::max(-block.history[0][i], Real(0));
    const Real p = factor * pressure_(crushed), y = factor * uniaxial_(crushed);
    return {p, y, card_.vpc > 0 ? card_.vpc * p : cutoff_, card_.vtsc > 0 ? card_.vtsc * y : card_.tsc};
  }
  static void scale(const PointBlock& block, Index i, const FoamLimits& limits) {
    const auto& s = block.stress;
    const Real p = -(s[0][i] + s[1][i] + s[2][i]) / 3;
    const Real a = s[0][i] + p, b = s[1][i] + p, c = s[2][i] + p;
    const Real q = std::sqrt(1.5 * (a * a + b * b + c * c) +
                             3 * (s[3][i] * s[3][i] + s[4][i] * s[4][i] + s[5][i] * s[5][i]));
    const Real share = limits.share(p, q);
    if (share < 1)
      for (std::size_t k = 0; k < 6; ++k) s[k][i] *= share;
  }
  static bool cut_tension(const PointBlock& block, Index i, Real tension) {
    const auto& s = block.stress;
    const Real mean = (s[0][i] + s[1][i] + s[2][i]) / 3;
    const Real a = s[0][i] - mean, b = s[1][i] - mean, c = s[2][i] - mean;
    const Real J2 = 0.5 * (a * a + b * b + c * c) + s[3][i] * s[3][i] + s[4][i] * s[4][i] + s[5][i] * s[5][i];
    if (mean + std::sqrt(4 * J2 / 3) <= tension) return false;  // a bound of the largest principal stress
    Matrix stress;
    stress << s[0][i], s[3][i], s[5][i], s[3][i], s[1][i], s[4][i], s[5][i], s[4][i], s[2][i];
    const Eigen::SelfAdjointEigenSolver<Matrix> principal(stress);
    const Vec values = principal.eigenvalues(), held = values.cwiseMin(tension);
    if (held == values) return false;
    const Matrix now = principal.eigenvectors() * held.asDiagonal() * principal.eigenvectors().transpose();
    s[0][i] = now(0, 0), s[1][i] = now(1, 1), s[2][i] = now(2, 2);
    s[3][i] = now(0, 1), s[4][i] = now(1, 2), s[5][i] = now(0, 2);
    return true;
  }

  MatBilkhuDuboisFoam card_;
  Real lambda_, G_;  ///< [M/LT2]
  Real cutoff_ = 0;  ///< [M/LT2]
  StraightPieces pressure_, uniaxial_, factor_;
};

std::shared_ptr<StrengthLaw> MatBilkhuDuboisFoam::law(const Model& model) const {
  return std::make_shared<BilkhuDuboisFoam>(*this, model);
}

void MatBilkhuDuboisFoam::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  expect(pr < 0.5, "PR", "a number < 0.5", pr, "a material that keeps its volume has no finite bulk modulus");
  expect(ncycle >= 1 && ncycle <= 100, "NCYCLE", "a number from 1 to 100", ncycle, "1: the rate of the step");
  if (vc != 0)
    deck.warning(diagnostics, *this, "VC",
                 "the viscous stress of the foam is left out: stresses at high rates are lower",
                 "bulk viscosity (*CONTROL_BULK_VISCOSITY) and hourglass control act as on all solids");
  check_curves(deck, model, diagnostics);
}

void MatBilkhuDuboisFoam::check_curves(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  bool good = true;
  const auto fail = [&](const char* field, const std::string& what, const char* hint) {
    deck.error(diagnostics, *this, field, what, hint), good = false;
  };
  for (const auto& [field, id] : {std::pair{"LCPY", lcpy}, {"LCUYS", lcuys}, {"LCRATE", lcrate}}) {
    const auto found = model.curves.find(id);
    if (id == 0 || found == model.curves.end()) continue;  // reported where ids are resolved
    const std::vector<Real>&x = found->second.abscissa, &y = found->second.ordinate;
    if (x.size() < 2) {
      fail(field, fmt::format("curve {} has less than two points", id), "give it two points or more");
      continue;
    }
    for (std::size_t k = 0; k < x.size(); ++k)
      if (!(y[k] > 0) || (k > 0 && !(x[k] > x[k - 1]))) {
        fail(field,
             fmt::format("curve {}: expected rising abscissae and values > 0, got ({:g}, {:g}) at point {}",
                         id, x[k], y[k], k + 1),
             "yield stresses and factors are > 0 in compression");
        break;
      }
    if (y.back() < y[y.size() - 2])
      fail(field, fmt::format("curve {} falls beyond its last point, to below 0", id),
           "curves go on straight beyond their ends: let it end level");
    if (std::string(field) == "LCRATE" && x.front() > 0 && y[1] > y[0])
      fail(field, fmt::format("curve {} falls below its first point, to below 0", id), "let it begin at 0");
    if (std::string(field) != "LCRATE" && x.front() > 0 &&
        !(y.front() - x.front() * (y[1] - y[0]) / (x[1] - x[0]) > 0))
      fail(field, fmt::format("curve {} falls below its first point, to below 0", id), "let it begin at 0");
    if (std::string(field) != "LCRATE" && x.front() < 0)
      fail(field, fmt::format("curve {} begins below 0: yield stresses in tension are not supported", id),
           "tension is limited by PC, VPC, TSC and VTSC");
  }
  const auto p = model.curves.find(lcpy), y = model.curves.find(lcuys);
  if (!good || p == model.curves.end() || y == model.curves.end()) return;
  const StraightPieces even(p->second.abscissa, p->second.ordinate),
      one(y->second.abscissa, y->second.ordinate);
  std::vector<Real> strains = p->second.abscissa;
  strains.insert(strains.end(), y->second.abscissa.begin(), y->second.abscissa.end());
  strains.push_back(0),
      strains.push_back(10 * std::max(even.last(), one.last()));  // and far beyond their ends
  std::sort(strains.begin(), strains.end());
  for (const Real strain : strains)
    if (!(one(strain) < 3 * even(strain))) {
      fail("LCUYS",
           fmt::format("at the strain {:g} the uniaxial yield stress {:g} is not below 3 times the yield "
                       "pressure {:g}",
                       strain, one(strain), even(strain)),
           "in uniaxial compression the pressure is a third of the stress");
      break;
    }
}

// By hand. PR = 0, YM = 10, level curves 2 and 3/2, PC = 1: an ellipse about 1/2, half as long and as high as
// 3/2. Crushed along x by 0.3: -1.5. Crushed evenly: -2. Sheared: (0 - 1/2)^2 + q^2 = 9/4, q = sqrt(2), s_xy
// = sqrt(2/3); with TSC = 1/2 the tension across is 1/2, inside of the ellipse. Torn by 0.3: TSC.
const std::string level_curves = "*DEFINE_CURVE\n5\n0.0,2.0\n1.0,2.0\n*DEFINE_CURVE\n6\n0.0,1.5\n1.0,1.5\n";
const std::string level_foam = "1,2.0,10.0,5,6,0.0,1.0\n0.5\n" + level_curves;
constexpr Real sheared_foam = 0.81649658092772603;
const RegisterStrength<MatBilkhuDuboisFoam> mat_bilkhu_dubois_foam{
    "x (sigma + C:D dt), x <= 1 on the ellipse over p and q through (-PC, 0), (LCUYS/3, LCUYS), (LCPY, 0), "
    "principal "
    "stresses <= TSC; curves over -ln V",
    "Bilkhu & Du Bois 1989, as LS-DYNA's MAT_075 describes it",
    {{level_foam, {-0.3}, {}, {-1.5}, {0}, {-0.3}},
     {level_foam, {-0.3, -0.3, -0.3}, {}, {-2, -2, -2}, {0}, {-0.9}},
     {level_foam,
      {0, 0, 0, 0.2, 0, 0},
      {},
      {0.25 - sheared_foam / 2, 0.25 - sheared_foam / 2, 0, 0.25 + sheared_foam / 2, 0, 0}},
     {level_foam, {0.3}, {}, {0.5}}},
    mat_bilkhu_dubois_foam_table()};

}  // namespace

}  // namespace courant
