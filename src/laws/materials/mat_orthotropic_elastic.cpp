#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>

#include "keyword/common_rules.hpp"
#include "laws/strength/material_axes.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

struct MatOrthotropicElastic : DirectionsCard {
  std::string title;
  Id mid = 0;
  Real ro = 0, ea = 0, eb = 0, ec = 0, prba = 0, prca = 0, prcb = 0, gab = 0, gbc = 0, gca = 0;
  Real g = 0, sigf = 0, beta = 0, ref = 0;
  int macf = 1, ihis = 0;

  /// Strain by stress along a, b, c. [LT2/M]
  Matrix compliance() const {
    Matrix S;
    S << 1 / ea, -prba / eb, -prca / ec, -prba / eb, 1 / eb, -prcb / ec, -prca / ec, -prcb / ec, 1 / ec;
    return S;
  }
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  /// Of parts with this material: which elements they have.
  bool any_part(const Model& model, bool ModelPart::*has) const {
    return std::any_of(model.parts.begin(), model.parts.end(),
                       [&](const ModelPart& part) { return part.mid == mid && part.*has; });
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    if (any_part(model, &ModelPart::has_solid))
      check_in_solids(deck, model, diagnostics);
    else
      check_axes(deck, model, diagnostics);
    const Matrix S = compliance();
    const bool plane = S(0, 0) * S(1, 1) > S(0, 1) * S(0, 1);
    if (!plane || !(S.determinant() > 0))
      deck.error(diagnostics, *this, plane ? "PRCA" : "PRBA",
                 "the material would give energy away: its stiffness is not positive definite",
                 "PRBA^2 < EB/EA, PRCA^2 < EC/EA, PRCB^2 < EC/EB");
  }
  void check_in_solids(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    check_axes_in_solids(deck, model, diagnostics);
    if (any_part(model, &ModelPart::has_shell))
      deck.error(diagnostics, *this, "MID",
                 "shells and solids with one material of directions are not supported",
                 "give the solids a material of their own");
    if (beta != 0)
      deck.error(diagnostics, *this, "BETA", "an angle in solids is not supported",
                 "turn A and D, or V, instead");
  }
};

/// Linear between the rates of strain and of stress, both by the directions of the material.
class Orthotropic : public StrengthLaw {
 public:
  Orthotropic(const MatOrthotropicElastic& card, const MaterialAxes& axes)
      : axes_(axes),
        S_(card.compliance()),
        C_(S_.inverse()),
        sheet_(card.ea, card.eb, card.prba),
        shear_{card.gab, card.gbc, card.gca} {
    ro = card.ro;
  }
  Real bulk_modulus() const override { return 1 / S_.sum(); }
  Real shear_modulus() const override { return std::max({shear_[0], shear_[1], shear_[2]}); }
  const MaterialAxes* axes() const override { return &axes_; }
  Real plane_modulus() const override { return sheet_.largest(shear_[0]); }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Vec d = block.dt * Vec(block.rate[0][i], block.rate[1][i], block.rate[2][i]);
      const Vec ds = C_ * d;
      for (int k = 0; k < 3; ++k) block.stress[static_cast<std::size_t>(k)][i] += ds[k];
    }
    finish(block);
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    const Real *daa = block.rate[0], *dbb = block.rate[1];
    Real* __restrict aa = block.stress[0], * __restrict bb = block.stress[1], * __restrict zz = rate_zz;
    for (Index i = 0; i < block.count; ++i) {
      const Real a = sheet_.aa * daa[i] + sheet_.ab * dbb[i], b = sheet_.ab * daa[i] + sheet_.bb * dbb[i];
      aa[i] += block.dt * a, bb[i] += block.dt * b;
      zz[i] = S_(2, 0) * a + S_(2, 1) * b;
    }
    finish(block);
  }

 protected:
  const Matrix& stiffness() const { return C_; }
  Real shear(std::size_t k) const { return shear_[k]; }

 private:
  void finish(const PointBlock& block) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const Real twice = 2 * shear_[k] * block.dt;
      const Real* d = block.rate[3 + k];
      Real* __restrict s = block.stress[3 + k];
      for (Index i = 0; i < block.count; ++i) s[i] += twice * d[i];
    }
    keep_stiffness(block, std::sqrt(C_.diagonal().maxCoeff() / ro));
  }

  MaterialAxes axes_;
  Matrix S_, C_;
  SheetStiffness sheet_;
  std::array<Real, 3> shear_;  ///< ab, bc, ca
};

/// The same in solids, by directions that turn with the body.
class OrthotropicInSolids : public Orthotropic {
 public:
  using Orthotropic::Orthotropic;
  bool in_sheets() const override { return false; }
  Real sound_speed() const override { return fastest(); }
  std::vector<HistoryVariable> history() const override { return {{material_directions, "-", 6}}; }
  void update(const PointBlock& block) const override {
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (Index i = 0; i < block.count; ++i) {
      std::array<Real, 6> tensor;
      Matrix D;
      for (std::size_t k = 0; k < 6; ++k) {
        tensor[k] = block.history[k][i];
        D(row[k], column[k]) = D(column[k], row[k]) = block.dt * block.rate[k][i];
      }
      const Matrix Q = directions_of_tensor(tensor), d = Q.transpose() * D * Q;
      Matrix ds = Matrix::Zero();
      ds.diagonal() = stiffness() * d.diagonal();
      for (std::size_t k = 3; k < 6; ++k)
        ds(row[k], column[k]) = ds(column[k], row[k]) = 2 * shear(k - 3) * d(row[k], column[k]);
      ds = Q * ds * Q.transpose();
      for (std::size_t k = 0; k < 6; ++k) block.stress[k][i] += ds(row[k], column[k]);
    }
    keep_stiffness(block, fastest());
  }

 private:
  /// A bound of waves in any direction: the largest stiffness of all strains. [L/T]
  Real fastest() const {
    const Real normal = Eigen::SelfAdjointEigenSolver<Matrix>(stiffness()).eigenvalues()[2];
    return std::sqrt(std::max({normal, 2 * shear(0), 2 * shear(1), 2 * shear(2)}) / ro);
  }
};

std::shared_ptr<StrengthLaw> MatOrthotropicElastic::law(const Model& model) const {
  if (any_part(model, &ModelPart::has_solid))
    return std::make_shared<OrthotropicInSolids>(*this, axes(model, 0));
  return std::make_shared<Orthotropic>(*this, axes(model, beta));
}

using OE = MatOrthotropicElastic;

// By hand: EA = 4, EB = EC = 1, PRBA = 1/4, PRCA = PRCB = 0: C aa = 4/(1 - 4/16) = 16/3, C ab = 4/3, C bb =
// 4/3, C cc = 1; GAB, GBC, GCA = 1, 2, 3.
const RegisterStrength<OE> mat_orthotropic_elastic{
    "dsigma/dt = C D by the directions a, b, c of the material; strain a = sigma_a/EA - PRBA sigma_b/EB - "
    "PRCA sigma_c/EC, b = -PRBA sigma_a/EB + sigma_b/EB - PRCB sigma_c/EC, c = ..., 2 D ab = "
    "(dtau_ab/dt)/GAB",
    "Hooke's law of orthotropic bodies between rates; Jones 1975, section 2.4",
    {{"1,2.0,4.0,1.0,1.0,0.25\n1.0,2.0,3.0\n\n\n",
      {0.3, 0, 0.5, 0.1, 0.2, 0.3},
      {1, 2, 3, 4, 5, 6},
      {1 + 1.6, 2 + 0.4, 3 + 0.5, 4 + 0.2, 5 + 0.8, 6 + 1.8}},
     {"1,2.0,4.0,1.0,1.0,0.25\n1.0,2.0,3.0\n\n\n", {0, 0.3, 0, 0, 0, 0}, {}, {0.4, 0.4, 0, 0, 0, 0}}},
    {.names = {"MAT_ORTHOTROPIC_ELASTIC", "MAT_002"},
     .purpose = "elasticity that differs along the directions of the material, as of plies, wood and bone",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &OE::title,
     .cards = {
         {.fields = {{"MID", &OE::mid, "-", "id that *PART refers to", rules::required_id},
                     {"RO", &OE::ro, "M/L3", "density", rules::required_positive},
                     {"EA", &OE::ea, "M/LT2", "Young's modulus along a", rules::required_positive},
                     {"EB", &OE::eb, "M/LT2", "along b", rules::required_positive},
                     {"EC", &OE::ec, "M/LT2", "along c, in shells through the thickness",
                      rules::required_positive},
                     {"PRBA", &OE::prba, "-", "strain along a over that along b of a stress along b"},
                     {"PRCA", &OE::prca, "-", "the same of a and c"},
                     {"PRCB", &OE::prcb, "-", "the same of b and c"}}},
         {.fields =
              {{"GAB", &OE::gab, "M/LT2", "shear modulus in the plane", rules::required_positive},
               {"GBC", &OE::gbc, "M/LT2", "across it along b", rules::required_positive},
               {"GCA", &OE::gca, "M/LT2", "across it along a", rules::required_positive},
               {"AOPT", &OE::aopt, "-",
                "direction a of shells: 0 along side 1-2, 2 along A, 3 along V x normal; in solids 0 by "
                "nodes 1, 2, 4, "
                "2 by A and D, 3 by V x n and n, the normal of the middle face; < 0: axes of system -AOPT"},
               {"G", &OE::g, "M/LT2", "damping that does not depend on the frequency", unsupported},
               {"SIGF", &OE::sigf, "M/LT2", "limit of that damping", no_effect}}},
         {.fields = with_fields<OE>(
              fields_of_a<OE>(),
              {{"MACF", &OE::macf, "-", "change of axes: 1 none", {.standard = 1, .allowed = {1}}},
               {"IHIS", &OE::ihis, "-", "moduli from *INITIAL_STRESS", unsupported}})},
         {.fields = with_fields<OE>(
              {{"V1", &OE::v1, "-", "direction v of AOPT 3, x", rules::direction},
               {"V2", &OE::v2, "-", "direction v, y"},
               {"V3", &OE::v3, "-", "direction v, z"},
               {"D1", &OE::d1, "-", "direction d of AOPT 2 in solids, c = a x d, x", rules::direction},
               {"D2", &OE::d2, "-", "direction d, y"},
               {"D3", &OE::d3, "-", "direction d, z"}},
              {{"BETA", &OE::beta, "-", "angle by which a is turned about the normal, degrees"},
               {"REF", &OE::ref, "-", "reference geometry", unsupported}})}}}};

}  // namespace

}  // namespace courant
