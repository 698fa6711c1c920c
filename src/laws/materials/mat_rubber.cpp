// Rubber by the stretches without their change of volume: *MAT_OGDEN_RUBBER and *MAT_HYPERELASTIC_RUBBER.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "keyword/common_rules.hpp"
#include "laws/strength/stretch_rubber.hpp"

namespace courant {

namespace {

class StretchRubber : public StrengthLaw {
 public:
  Real bulk_modulus() const override { return K_; }
  Real shear_modulus() const override { return G_; }
  std::vector<HistoryVariable> history() const override { return {left_cauchy_green}; }
  bool stiffens() const override { return true; }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i)
      answer_stretches(block, i, K_, ro, [this](const Vec& l) { return forces(l); });
  }

 protected:
  /// `l`: with product 1.
  virtual PrincipalForces forces(const Vec& l) const = 0;
  void set_moduli(Real density, Real G, Real nu) {
    ro = density, G_ = G, K_ = 2 * G * (1 + nu) / (3 * (1 - 2 * nu));
  }

 private:
  Real G_ = 0, K_ = 0;
};

/// What the cards of both have alike.
struct RubberCard : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, pr = 0, g = 0, sigf = 0, sgl = 0, sw = 0, st = 0, data = 1, bstart = 0, tramp = 0;
  int n = 0, nv = 6, ref = 0;
  Id lcid1 = 0, lcid2 = 0;
  std::vector<Real> gi{}, betai{};

  void check_rubber(const Deck& deck, Diagnostics& diagnostics, Real G, const char* field,
                    const char* of) const {
    if (!(pr < 0.5))
      deck.error(diagnostics, *this, "PR", fmt::format("expected a number < 0.5, got '{:g}'", pr),
                 "0.49 to 0.4995 is rubber that hardly changes its volume");
    if (n > 0)
      deck.error(diagnostics, *this, "N", fmt::format("'{}' is not supported: no constants are fitted", n),
                 "give constants, with N = 0");
    if (n == 0 && !(G > 0))
      deck.error(diagnostics, *this, field, fmt::format("the shear modulus would be {:g}", G), of);
  }
};

template <class C>
std::vector<FieldOf<C>> first_rubber_fields() {
  return {{"MID", &C::mid, "-", "id that *PART refers to", rules::required_id},
          {"RO", &C::ro, "M/L3", "density", rules::required_positive},
          {"PR", &C::pr, "-", "Poisson ratio at rest, below 0.5", rules::required_positive},
          {"N",
           &C::n,
           "-",
           "0: constants are below; above 0, fits to curves, which are refused",
           {.check = Check::not_negative}},
          {"NV", &C::nv, "-", "terms of a fit of relaxation", no_effect_but(6)},
          {"G", &C::g, "M/LT2", "damping that does not depend on the frequency", unsupported},
          {"SIGF", &C::sigf, "M/LT2", "limit of that damping", no_effect},
          {"REF",
           &C::ref,
           "-",
           "1: solids are strained from *INITIAL_FOAM_REFERENCE_GEOMETRY to where they start",
           {.allowed = {0, 1}}}};
}
/// With N > 0, which is refused.
template <class C>
CardOf<C> fit_card() {
  return {.fields =
              {{"SGL", &C::sgl, "L", "gauge length of the specimen", no_effect},
               {"SW", &C::sw, "L", "its width", no_effect},
               {"ST", &C::st, "L", "its thickness", no_effect},
               {"LCID1", &C::lcid1, "-", "its curve", {.honour = Honour::ignored, .refers = IdSpace::curve}},
               {"DATA", &C::data, "-", "kind of the test", no_effect_but(1)},
               {"LCID2",
                &C::lcid2,
                "-",
                "curve of relaxation",
                {.honour = Honour::ignored, .refers = IdSpace::curve}},
               {"BSTART", &C::bstart, "-", "of the fit of relaxation", no_effect},
               {"TRAMP", &C::tramp, "T", "of the fit of relaxation", no_effect}},
          .when = [](const C& card) { return card.n > 0; }};
}
/// Relaxation, which is refused.
template <class C>
std::vector<FieldOf<C>> relaxation_fields() {
  return {{"GI", &C::gi, "M/LT2", "modulus that relaxes", {.honour = Honour::no}},
          {"BETAI", &C::betai, "1/T", "its rate", no_effect}};
}

struct MatOgdenRubber : RubberCard {
  Real mu1 = 0, mu2 = 0, mu3 = 0, mu4 = 0, mu5 = 0, mu6 = 0, mu7 = 0, mu8 = 0;
  Real alpha1 = 0, alpha2 = 0, alpha3 = 0, alpha4 = 0, alpha5 = 0, alpha6 = 0, alpha7 = 0, alpha8 = 0;
  std::array<Real, 8> mu() const { return {mu1, mu2, mu3, mu4, mu5, mu6, mu7, mu8}; }
  std::array<Real, 8> alpha() const {
    return {alpha1, alpha2, alpha3, alpha4, alpha5, alpha6, alpha7, alpha8};
  }
  Real shear_modulus() const {
    Real sum = 0;
    for (std::size_t k = 0; k < 8; ++k) sum += 0.5 * mu()[k] * alpha()[k];
    return sum;
  }
  std::shared_ptr<StrengthLaw> law() const;
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    check_rubber(deck, diagnostics, shear_modulus(), "MU1", "it is half the sum of MU ALPHA");
    for (std::size_t k = 0; k < 8; ++k)
      if (mu()[k] != 0 && alpha()[k] == 0)
        deck.error(diagnostics, *this, fmt::format("ALPHA{}", k + 1), "there is no exponent to this MU",
                   "give one that is not 0");
  }
};

/// W = sum of MU/ALPHA (l1^ALPHA + l2^ALPHA + l3^ALPHA - 3).
class Ogden : public StretchRubber {
 public:
  explicit Ogden(const MatOgdenRubber& card) : mu_(card.mu()), alpha_(card.alpha()) {
    set_moduli(card.ro, card.shear_modulus(), card.pr);
  }

 protected:
  PrincipalForces forces(const Vec& l) const override {
    PrincipalForces out{Vec::Zero(), Vec::Zero()};
    for (std::size_t n = 0; n < mu_.size(); ++n) {
      if (mu_[n] == 0) continue;
      const Vec e = mu_[n] * l.array().pow(alpha_[n]);
      const Vec first = e - Vec::Constant(e.mean());
      out.first += first;
      out.second += alpha_[n] * (e + Vec::Constant(e.mean())) / 3 - first;
    }
    return out;
  }

 private:
  std::array<Real, 8> mu_, alpha_;
};

std::shared_ptr<StrengthLaw> MatOgdenRubber::law() const {
  return std::make_shared<Ogden>(*this);
}

struct MatHyperelasticRubber : RubberCard {
  Real c10 = 0, c01 = 0, c11 = 0, c20 = 0, c02 = 0, c30 = 0, therml = 0;
  std::vector<Real> gj{}, sigfj{};
  Real shear_modulus() const { return 2 * (c10 + c01); }
  std::shared_ptr<StrengthLaw> law() const;
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    check_rubber(deck, diagnostics, shear_modulus(), "C10", "it is 2 (C10 + C01)");
  }
};

/// W = sum of Cpq (J1 - 3)^p (J2 - 3)^q, J1 = sum of l^2, J2 = sum of l^-2.
class Hyperelastic : public StretchRubber {
 public:
  explicit Hyperelastic(const MatHyperelasticRubber& card) : c_(card) {
    set_moduli(card.ro, card.shear_modulus(), card.pr);
  }

 protected:
  PrincipalForces forces(const Vec& l) const override {
    const Vec up = l.cwiseAbs2(), down = up.cwiseInverse();
    const Real x = up.sum() - 3, y = down.sum() - 3;
    const Real W1 = c_.c10 + c_.c11 * y + 2 * c_.c20 * x + 3 * c_.c30 * x * x,
               W2 = c_.c01 + c_.c11 * x + 2 * c_.c02 * y;
    const Real W11 = 2 * c_.c20 + 6 * c_.c30 * x, W22 = 2 * c_.c02, W12 = c_.c11;
    // l dJ1/dl, l dJ2/dl
    const Vec a = 2 * (up - Vec::Constant(up.mean())), c = -2 * (down - Vec::Constant(down.mean()));
    const Vec first = W1 * a + W2 * c;
    const Vec second = W1 * (8 * up - 2 * a) / 3 + W2 * (8 * down + 2 * c) / 3 + W11 * a.cwiseAbs2() +
                       2 * W12 * a.cwiseProduct(c) + W22 * c.cwiseAbs2() - first;
    return {first, second};
  }

 private:
  MatHyperelasticRubber c_;
};

std::shared_ptr<StrengthLaw> MatHyperelasticRubber::law() const {
  return std::make_shared<Hyperelastic>(*this);
}

using Og = MatOgdenRubber;
using Hy = MatHyperelasticRubber;

// By hand. A step exp about x: D dt = (2/3, 0, 0): A = 2, stretches 2, 1, 1, J = 2, without it l^2 = 4/s,
// 1/s, 1/s, s = 4^(1/3). MU1 = 1, ALPHA1 = 2: l dW/dl = (4/s - 2/s, -1/s, -1/s); G = 1, PR 0.25: K = 5/3;
// sigma_x = 1/s + 5/6, sigma_y = -1/(2 s) + 5/6. C10 = 1/2 is the same.
const Real cube_root_of_4 = std::cbrt(Real(4));
const std::array<Real, 6> doubled = {1 / cube_root_of_4 + 5.0 / 6, -0.5 / cube_root_of_4 + 5.0 / 6,
                                     -0.5 / cube_root_of_4 + 5.0 / 6};
const RegisterStrength<Og> mat_ogden_rubber{
    "W = sum MU/ALPHA (l1^ALPHA + l2^ALPHA + l3^ALPHA - 3) + K (J - 1 - ln J), l = J^(-1/3) stretch; K = 2 G "
    "(1 + "
    "PR)/(3 (1 - 2 PR)), G = sum MU ALPHA/2",
    "Ogden 1984, section 7.2; volume as in LS-DYNA",
    {{"1,2.0,0.25\n1.0\n2.0\n", {2.0 / 3}, {}, doubled, {}, {3, 0, 0, 0, 0, 0}}},
    {.names = {"MAT_OGDEN_RUBBER", "MAT_077_O"},
     .purpose = "rubber: Ogden hyperelasticity, constants given",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &Og::title,
     .many = false,
     .cards = {{.fields = first_rubber_fields<Og>()},
               fit_card<Og>(),
               {.fields = {{"MU1", &Og::mu1, "M/LT2", "modulus 1"},
                           {"MU2", &Og::mu2, "M/LT2", "modulus 2"},
                           {"MU3", &Og::mu3, "M/LT2", "modulus 3"},
                           {"MU4", &Og::mu4, "M/LT2", "modulus 4"},
                           {"MU5", &Og::mu5, "M/LT2", "modulus 5"},
                           {"MU6", &Og::mu6, "M/LT2", "modulus 6"},
                           {"MU7", &Og::mu7, "M/LT2", "modulus 7"},
                           {"MU8", &Og::mu8, "M/LT2", "modulus 8"}},
                .when = [](const Og& c) { return c.n <= 0; }},
               {.fields = {{"ALPHA1", &Og::alpha1, "-", "exponent 1"},
                           {"ALPHA2", &Og::alpha2, "-", "exponent 2"},
                           {"ALPHA3", &Og::alpha3, "-", "exponent 3"},
                           {"ALPHA4", &Og::alpha4, "-", "exponent 4"},
                           {"ALPHA5", &Og::alpha5, "-", "exponent 5"},
                           {"ALPHA6", &Og::alpha6, "-", "exponent 6"},
                           {"ALPHA7", &Og::alpha7, "-", "exponent 7"},
                           {"ALPHA8", &Og::alpha8, "-", "exponent 8"}},
                .when = [](const Og& c) { return c.n <= 0; }},
               {.fields = relaxation_fields<Og>(), .repeat = true}}}};

const RegisterStrength<Hy> mat_hyperelastic_rubber{
    "W = sum Cpq (J1 - 3)^p (J2 - 3)^q + K (J - 1 - ln J), J1 = sum l^2, J2 = sum l^-2, l = J^(-1/3) "
    "stretch; K as "
    "of Ogden, G = 2 (C10 + C01)",
    "Rivlin & Saunders 1951; Yeoh 1990",
    {{"1,2.0,0.25\n0.5\n", {2.0 / 3}, {}, doubled, {}, {3, 0, 0, 0, 0, 0}}},
    {.names = {"MAT_HYPERELASTIC_RUBBER", "MAT_077_H"},
     .purpose = "rubber: polynomials of the invariants, constants given",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &Hy::title,
     .many = false,
     .cards = {{.fields = first_rubber_fields<Hy>()},
               fit_card<Hy>(),
               {.fields = {{"C10", &Hy::c10, "M/LT2", "factor of J1 - 3"},
                           {"C01", &Hy::c01, "M/LT2", "of J2 - 3"},
                           {"C11", &Hy::c11, "M/LT2", "of their product"},
                           {"C20", &Hy::c20, "M/LT2", "of (J1 - 3)^2"},
                           {"C02", &Hy::c02, "M/LT2", "of (J2 - 3)^2"},
                           {"C30", &Hy::c30, "M/LT2", "of (J1 - 3)^3"},
                           {"THERML", &Hy::therml, "-", "thermal expansion", unsupported}},
                .when = [](const Hy& c) { return c.n <= 0; }},
               {.fields = {{"GI", &Hy::gi, "M/LT2", "modulus that relaxes", {.honour = Honour::no}},
                           {"BETAI", &Hy::betai, "1/T", "its rate", no_effect},
                           {"GJ", &Hy::gj, "M/LT2", "modulus of damping", {.honour = Honour::no}},
                           {"SIGFJ", &Hy::sigfj, "M/LT2", "its limit", no_effect}},
                .repeat = true}}}};

}  // namespace

}  // namespace courant
