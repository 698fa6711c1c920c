// *MAT_SAMP-1: polymers. Kolling, Haufe, Feucht & Du Bois 2005.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyword/expectations.hpp"
#include "laws/failure/fracture_strain.hpp"
#include "laws/materials/mat_piecewise_linear_plasticity.hpp"
#include "laws/strength/hardening.hpp"
#include "laws/strength/pressure_surface.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/root_below.hpp"

namespace courant {

namespace {

constexpr Real root3 = 1.7320508075688772;

struct MatSamp1 : MatSamp1Fields {
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  void check_yield(const Deck& deck, const Model& model, const char* field, Id id, bool tables,
                   Diagnostics& diagnostics) const;
  void check_surface(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  bool fails() const { return incfail >= 0 && (epfail < 0 || epfail < first_that_never_fails); }
  static constexpr Real first_that_never_fails = 1e5;  ///< of EPFAIL
};

/// The plastic Poisson ratio over plastic strain e of tension, and what follows from it for other tests.
class PlasticRatio {
 public:
  PlasticRatio(Real constant, const Curve* curve) : constant_(constant) {
    if (!curve) return;
    curve_ = IndexedPieces(curve->abscissa, curve->ordinate, IndexedPieces::Beyond::constant);
    strain_ = {0}, sum_ = {0};
    for (const Real e : curve->abscissa)
      if (e > 0) sum_.push_back(integral(e)), strain_.push_back(e);
  }
  Real operator()(Real e) const { return curve_.empty() ? constant_ : curve_(e); }
  /// Plastic strain of the tensor in shear, and of one direction in biaxial tension. [-]
  Real in_shear(Real e) const { return (e + integral(e)) / root3; }
  Real in_biaxial_tension(Real e) const { return e - integral(e); }

 private:
  /// Over e from 0 on.
  Real integral(Real e) const {
    if (curve_.empty()) return constant_ * e;
    const auto above = std::upper_bound(strain_.begin(), strain_.end(), e);
    const auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - strain_.begin() - 1, 0));
    return sum_[k] + 0.5 * (curve_(strain_[k]) + curve_(e)) * (e - strain_[k]);
  }
  Real constant_;
  IndexedPieces curve_{};
  std::vector<Real> strain_{}, sum_{};  ///< points of the curve, and its integral there
};

/// The surface over plastic strain and its rate, as the given tests have it.
class PolymerYield {
 public:
  PolymerYield(const MatSamp1& card, const Model& model)
      : ratio(card.nuep, find(model, card.lcid_p)),
        raised_(card.iconv == 1 ? card.asaf : 0),
        biaxial_compression_(card.rbcfac) {
    if (const auto table = model.tables.find(card.lcid_t); table != model.tables.end()) {
      for (const Id one : table->second.curve) tension_.push_back(pieces(model, one));
      rates_ = table->second.value;
      logarithmic_ = !rates_.empty() && rates_.front() < 0;
    } else {
      tension_.push_back(pieces(model, card.lcid_t));
    }
    compression_ = pieces(model, card.lcid_c), shear_ = pieces(model, card.lcid_s);
    biaxial_ = pieces(model, card.lcid_b);
    if (card.lcid_d < 0) damage_ = CurveOrTable(model, -card.lcid_d);
  }
  static const Curve* find(const Model& model, Id id) {
    const auto found = model.curves.find(id);
    return found == model.curves.end() ? nullptr : &found->second;
  }
  static IndexedPieces pieces(const Model& model, Id id) {
    const Curve* curve = find(model, id);
    return curve ? IndexedPieces(curve->abscissa, curve->ordinate) : IndexedPieces();
  }

  PlasticRatio ratio;

  /// A rate counts in all tests by the factor that it has in tension.
  PressureSurface operator()(Real e, Real rate) const {
    Real tension = of_rate(e, rate), factor = tension_.size() > 1 ? tension / tension_.front()(e) : 1;
    if (!damage_.empty()) {
      const Real whole = 1 / (1 - damage_(e));
      tension *= whole, factor *= whole;
    }
    const bool has_c = !compression_.empty(), has_s = !shear_.empty(), has_b = !biaxial_.empty();
    const Real c = has_c ? factor * compression_(e) : tension;
    Real s = has_s ? factor * shear_(ratio.in_shear(e)) : 0;
    if (raised_ > 0 && has_c && has_s) s = std::max(s, raised_ * std::sqrt(tension * c / 3));
    const Real b = has_b ? factor * biaxial_(ratio.in_biaxial_tension(e)) : 0;
    const PressurePoint in_t{-tension / 3, tension}, in_c{c / 3, c}, in_s{0, root3 * s}, in_b{-2 * b / 3, b};
    if (has_c && has_s && has_b) {
      const Real k = biaxial_compression_ * c;
      return PressureSurface::straight({in_b, in_t, in_s, in_c, {2 * k / 3, k}});
    }
    if (has_s && has_b) return PressureSurface::square(in_b, in_t, in_s);
    if (has_c && has_b) return PressureSurface::square(in_b, in_t, in_c);
    if (has_c && has_s) return PressureSurface::square(in_t, in_s, in_c);
    if (has_s) return PressureSurface::straight({in_t, in_s});
    if (has_b) return PressureSurface::straight({in_b, in_t});
    return PressureSurface::straight({in_t, in_c});
  }
  bool has_rates() const { return tension_.size() > 1; }

 private:
  Real of_rate(Real e, Real rate) const {
    if (tension_.size() == 1) return tension_.front()(e);
    const Real at = logarithmic_ ? std::log(rate) : rate;
    const auto above = std::upper_bound(rates_.begin(), rates_.end(), at);
    const auto k = static_cast<std::size_t>(above - rates_.begin());
    if (k == 0) return tension_.front()(e);
    if (k == rates_.size()) return tension_.back()(e);
    const Real share = (at - rates_[k - 1]) / (rates_[k] - rates_[k - 1]);
    return (1 - share) * tension_[k - 1](e) + share * tension_[k](e);
  }

  std::vector<IndexedPieces> tension_{};
  std::vector<Real> rates_{};  ///< of the curves [1/T], or their logarithms
  bool logarithmic_ = false;
  IndexedPieces compression_{}, shear_{}, biaxial_{};
  CurveOrTable damage_{};
  Real raised_, biaxial_compression_;
};

/// With x from 0 to 1 along the flow and r = K alpha/(3 G), alpha of the plastic Poisson ratio: q = (1 - x)
/// q_tr, p = (1 - x)/(1 - x + r x) p_tr; the deviator flows by x q_tr/(3 G).
class Samp : public StrengthLaw {
 public:
  Samp(const MatSamp1& card, const Model& model)
      : c_(card),
        K_(card.emod / (3 * (1 - 2 * card.nue))),
        G_(card.emod / (2 * (1 + card.nue))),
        yield_(card, model),
        damage_(model, std::abs(card.lcid_d)),
        by_state_(model, card.lcid_tri),
        by_size_(model, card.lcid_lc),
        by_rate_(model, card.epfail < 0 ? static_cast<Id>(-card.epfail) : 0) {
    ro = card.ro, failing_layers = static_cast<int>(card.numint);
  }
  Real bulk_modulus() const override { return K_; }
  Real shear_modulus() const override { return G_; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{"plastic_strain", "-"}};
    if (c_.fails()) out.push_back({"failure_ratio", "-"});
    if (c_.fails() && !by_size_.empty()) out.push_back({element_size, "L"});
    return out;
  }
  std::string failure_variable() const override { return c_.fails() ? "failure_ratio" : "plastic_strain"; }
  /// 1 where failure begins, 2 where nothing is left.
  Real failure_limit() const override {
    return !c_.fails() ? std::numeric_limits<Real>::infinity() : c_.deprpt > 0 ? 2 : 1;
  }

  void update(const PointBlock& block) const override { advance(block, nullptr); }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    if (!(block.dt > 0)) return StrengthLaw::update_in_plane_stress(block, rate_zz);
    PointBlock own = block;
    const Real none[block_size] = {};
    own.rate[2] = none;
    advance(own, rate_zz);
  }

 private:
  /// The trial stress of a point, in the plane for a strain zz of 0.
  struct Trial {
    Real q, p, zz;  ///< zz of the deviator
    bool plane;
  };
  struct Flown {
    Real z, q, p, strain;  ///< strain zz; of the stress; of the deviator's flow
  };
  /// In the plane z is such that the stress zz is 0.
  Flown flown(const Trial& tr, Real r, Real x) const {
    const Real c = 1 - x + r * x;
    Flown out{0, tr.q, tr.p, 0};
    if (tr.plane) {
      const Real z = (tr.p - c * tr.zz) / (4 * G_ / 3 * c + K_);
      out.z = z, out.p = tr.p - K_ * z;
      out.q = std::sqrt(std::max(tr.q * tr.q + 6 * G_ * z * tr.zz + 4 * G_ * G_ * z * z, Real(0)));
    }
    out.strain = x * out.q / (3 * G_), out.q *= 1 - x;
    if (c > 0) out.p *= (1 - x) / c;
    return out;
  }

  void advance(const PointBlock& block, Real* rate_zz) const {
    PlasticTrial trial;
    Real left[block_size];
    const auto& s = block.stress;
    for (Index i = 0; i < block.count; ++i) {
      left[i] = strength_left(block, i);
      for (Real* stress : s) stress[i] = left[i] > 0 ? stress[i] / left[i] : 0;
    }
    go_elastically(K_ - 2 * G_ / 3, G_, block, FixedCentre{}, trial);
    for (Index i = 0; i < block.count; ++i) {
      const Real mean = (s[0][i] + s[1][i] + s[2][i]) / 3;
      const Trial tr{trial.q[i], -mean, s[2][i] - mean, rate_zz != nullptr};
      const Real z = flow(block, i, tr);
      if (rate_zz) rate_zz[i] = z / block.dt, s[2][i] = 0;
      left[i] = strength_left(block, i);
      for (Real* stress : s) stress[i] *= left[i];
    }
    keep_stiffness(block, sound_speed());
  }

  /// Stress without damage and strain zz, at the end of the step.
  Real flow(const PointBlock& block, Index i, const Trial& tr) const {
    Real& plastic = block.history[0][i];
    const Real nu = yield_.ratio(plastic), r = K_ / (3 * G_) * 4.5 * (1 - 2 * nu) / (1 + nu);
    const Real in_tension = 1.5 / (1 + nu), old = plastic;  // of strain of the deviator
    const auto surface = [&](Real de) { return yield_(old + de, yield_.has_rates() ? de / block.dt : 0); };
    const auto excess = [&](Real x) {
      const Flown f = flown(tr, r, x);
      return f.q - surface(in_tension * f.strain)(f.p);
    };
    const bool flows = block.dt > 0 && excess(0) > 0;
    const Real x = !flows ? 0 : excess(1) > 0 ? 1 : root_below(1, excess);
    const Flown f = flown(tr, r, x);
    const Real de = in_tension * f.strain;
    Real p = f.p;
    if (flows && !(x < 1)) p = surface(de).within(p);  // without a change of volume beyond the tip
    set(block, i, tr, f.z, 1 - x, p);
    if (!flows) return f.z;
    plastic += de;
    if (c_.fails()) fail(block, i, de, f.q > 0 ? p / f.q : 0);
    return f.z;
  }
  void set(const PointBlock& block, Index i, const Trial& tr, Real z, Real scale, Real p) const {
    const auto& s = block.stress;
    const Real added[3] = {-2 * G_ * z / 3, -2 * G_ * z / 3, 4 * G_ * z / 3};
    for (std::size_t k = 0; k < 3; ++k) s[k][i] = scale * (s[k][i] + tr.p + added[k]) - p;
    for (std::size_t k = 3; k < 6; ++k) s[k][i] *= scale;
  }

  /// The ratio grows by de over the strain of failure up to 1, then by de/DEPRPT.
  void fail(const PointBlock& block, Index i, Real de, Real pressure) const {
    Real& ratio = block.history[1][i];
    Real limit = by_rate_.empty() ? c_.epfail : by_rate_(de / block.dt);
    if (!by_state_.empty()) limit *= by_state_(pressure);
    if (!by_size_.empty()) limit *= by_size_(block.history[2][i]);
    const Real before = std::max(1 - ratio, Real(0)) * limit;
    ratio += std::min(de, before) / limit;
    if (de > before && c_.deprpt > 0) ratio = std::max(ratio, Real(1)) + (de - before) / c_.deprpt;
  }
  /// 1 - D, and what has not faded beyond failure.
  Real strength_left(const PointBlock& block, Index i) const {
    Real left = damage_.empty() ? 1 : 1 - std::min(damage_(block.history[0][i]), Real(1));
    if (c_.fails()) left *= std::clamp(2 - block.history[1][i], Real(0), Real(1));
    return left;
  }

  MatSamp1 c_;
  Real K_, G_;  ///< [M/LT2]
  PolymerYield yield_;
  CurveOrTable damage_, by_state_, by_size_, by_rate_;
};

std::shared_ptr<StrengthLaw> MatSamp1::law(const Model& model) const {
  return std::make_shared<Samp>(*this, model);
}

void MatSamp1::check_yield(const Deck& deck, const Model& model, const char* field, Id id, bool tables,
                           Diagnostics& diagnostics) const {
  const auto before = diagnostics.errors();
  check_positive_curves(deck, model, *this, field, id, tables, "yield stresses over the plastic strain",
                        diagnostics);
  if (id == 0 || diagnostics.errors() != before) return;
  const auto fail = [&](const std::string& what, const char* hint) {
    deck.error(diagnostics, *this, field, what, hint);
  };
  const auto table = model.tables.find(id);
  const SteepestFall fall = steepest_fall(model, mid, emod, nue);
  for (const Id one : table == model.tables.end() ? std::vector<Id>{id} : table->second.curve) {
    const Hardening points{model.curves.at(one).abscissa, model.curves.at(one).ordinate};
    if (points.strain.size() < 2)
      return fail(fmt::format("curve {} has less than two points", one), "from a plastic strain of 0 on");
    for (std::size_t k = 0; k + 1 < points.strain.size(); ++k)
      if (!(points.slope(k) > fall.slope))
        return fail(fmt::format("curve {} behind point {}: {}", one, k + 1, fall.too_fast), "");
    if (points.slope(points.strain.size() - 2) < 0)
      return fail(fmt::format("curve {} falls beyond its last point, to below 0", one),
                  "let it end with a piece that does not fall");
  }
}

/// At strains from 0 to the ends of the curves.
void MatSamp1::check_surface(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const PolymerYield yield(*this, model);
  Real end = 0;
  for (const Id id : {lcid_t, lcid_c, lcid_s, lcid_b})
    if (const Curve* curve = PolymerYield::find(model, id)) end = std::max(end, curve->abscissa.back());
  constexpr int parts = 64;
  bool concave = false, ambiguous = false;
  for (int k = 0; k <= parts; ++k) {
    const Real e = end * k / parts;
    const PressureSurface surface = yield(e, 0);
    if (!surface.rises_in_order())
      return deck.error(diagnostics, *this, lcid_b != 0 ? "LCID-B" : "LCID-S",
                        fmt::format("no surface has these yield stresses at a plastic strain of {:g}", e),
                        "stresses that a material can have in tests of one and of two directions");
    concave = concave || !surface.is_convex();
    // compressed along one axis, or two: flow lowers q by 3 G q and p by K alpha p
    for (const Real p_of_q : {1.0 / 3, 2.0 / 3}) {
      Real q = surface(0);
      for (int round = 0; round < 40; ++round) q = surface(p_of_q * q);
      const Real p = p_of_q * q, nu = yield.ratio(e), alpha = 4.5 * (1 - 2 * nu) / (1 + nu);
      constexpr Real small = 1e-4;
      const Real slope = (surface((1 + small) * p) - surface((1 - small) * p)) / (2 * small * p);
      const Real of_q = 3 * emod / (2 * (1 + nue)) * q, of_p = emod / (3 * (1 - 2 * nue)) * alpha * p * slope;
      ambiguous = ambiguous || (std::isfinite(q) && q > 0 && !(of_q > of_p));
    }
  }
  if (ambiguous)
    deck.warning(diagnostics, *this, lcid_p != 0 ? "LCID-P" : "NUEP",
                 "stresses in compression are not unique: as it flows the strength falls with the pressure "
                 "faster than the stress",
                 "a larger plastic Poisson ratio, or tests whose yield stresses differ less");
  if (concave)
    deck.warning(diagnostics, *this, lcid_s != 0 ? "LCID-S" : "LCID-B",
                 "the yield surface is not convex: stresses between the tests are uncertain",
                 "ICONV 1 raises the shear yield stress where LCID-T, LCID-C and LCID-S are given");
}

void MatSamp1::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  const auto before = diagnostics.errors();
  expect(nue < 0.5, "NUE", "a number < 0.5", nue,
         "a material that keeps its volume has no finite bulk modulus");
  expect(lcid_p != 0 || (nuep >= 0 && nuep <= 0.5), "NUEP", "a number from 0 to 0.5", nuep,
         "flow along the normal of the surface (NUEP < 0) is not supported; 0.5 keeps the volume");
  expect(deprpt >= 0, "DEPRPT", "a number >= 0", deprpt,
         "curves over the triaxiality (< 0) are not supported");
  check_failing_layers(deck, *this, numint, diagnostics);
  const bool all = lcid_c != 0 && lcid_s != 0 && lcid_b != 0;
  expect(!all || rbcfac > 0.5, "RBCFAC", "a number above 0.5 beside four curves", rbcfac,
         "the surface is straight between the tests; or leave out one of LCID-C, LCID-S, LCID-B");
  if (!all && rbcfac != 0)
    deck.warning(diagnostics, *this, "RBCFAC", "does nothing without all of LCID-C, LCID-S, LCID-B",
                 "three tests give a quadratic surface");
  if (iconv == 1 && (lcid_c == 0 || lcid_s == 0 || lcid_b != 0))
    deck.warning(diagnostics, *this, "ICONV", "does nothing without LCID-C and LCID-S alone beside LCID-T",
                 "the shear yield stress of a quadratic surface is raised");
  for (const auto& [field, id] :
       {std::pair{"LCID-T", lcid_t}, {"LCID-C", lcid_c}, {"LCID-S", lcid_s}, {"LCID-B", lcid_b}})
    check_yield(deck, model, field, id, id == lcid_t, diagnostics);
  const auto ranged = [&](const char* field, Id id, Real most, bool below, bool falls, const char* hint) {
    const Curve* curve = PolymerYield::find(model, id);
    if (id == 0) return;
    if (!curve || curve->abscissa.empty())
      return deck.error(diagnostics, *this, field, fmt::format("curve {} does not exist", id), hint);
    const std::vector<Real>&x = curve->abscissa, &y = curve->ordinate;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (!(x[k] >= 0) || (k > 0 && !(x[k] > x[k - 1])) || y[k] < 0 || y[k] > most ||
          (below && y[k] == most) || (!falls && k > 0 && y[k] < y[k - 1]))
        return deck.error(diagnostics, *this, field,
                          fmt::format("curve {}: got ({:g}, {:g}) at point {}", id, x[k], y[k], k + 1), hint);
  };
  ranged("LCID-P", lcid_p, 0.5, false, true,
         "rising plastic strains >= 0, plastic Poisson ratios from 0 to 0.5");
  ranged("LCID-D", std::abs(lcid_d), 1, lcid_d < 0, false,
         "rising plastic strains >= 0, damage from 0 to 1 that does not fall; below 1 with LCID-D < 0");
  const char* factor = "factors of the strain of failure";
  check_positive_curves(deck, model, *this, "LCID-TRI", lcid_tri, false, factor, diagnostics);
  check_positive_curves(deck, model, *this, "LCID_LC", lcid_lc, false, factor, diagnostics);
  if (epfail < 0)
    check_positive_curves(deck, model, *this, "EPFAIL", static_cast<Id>(-epfail), false,
                          "strains of failure over the rate of plastic strain", diagnostics);
  if (lcid_tri != 0 && incfail == 0)
    deck.error(diagnostics, *this, "LCID-TRI", "does not count with INCFAIL 0",
               "INCFAIL 1: failure is summed over the states of stress");
  if (diagnostics.errors() == before) check_surface(deck, model, diagnostics);
}

// By hand. E = 2.5, PR = 1/4: G = 1, K = 5/3; dt = 1/2. By dev e = (2, -1, -1): q = 6, p = 0. Tension alone,
// NUEP 1/2: as *MAT_TABULATED_JOHNSON_COOK. Tension 2, compression 4, shear sqrt(8/3): q^2 = 8 + 6 p. At p =
// 0 q = sqrt(8), e = 3/2 (6 - sqrt(8))/3 with NUEP 0. Blown up by 0.9 in each direction p = -9/2, back to
// -4/3.
const std::string tests =
    "*DEFINE_CURVE\n1\n0.0,1.0\n1.0,1.0\n*DEFINE_CURVE\n2\n0.0,3.0\n1.0,3.0\n*DEFINE_CURVE\n5\n0.0,3.0\n0.25,"
    "4.0\n1.25,4.0\n*DEFINE_TABLE_2D\n6\n0.0,1\n8.0,2\n*DEFINE_CURVE\n7\n0.0,2.0\n1.0,2.0\n*DEFINE_CURVE\n8\n"
    "0.0,4.0\n1.0,4.0\n*DEFINE_CURVE\n9\n0.0,1.632993161855452\n1.0,1.632993161855452\n*DEFINE_CURVE\n10\n0."
    "0,"
    "0.0\n1.3333333333333333,1.0\n";
const std::array<Real, 6> stretched{2, -1, -1};
const Real root8 = std::sqrt(Real(8));
const RegisterStrength<MatSamp1> mat_samp_1{
    "q <= y(p): through the tests at e, square of y quadratic, or y straight; plastic strain along the "
    "normal "
    "of q^2 + "
    "9/2 (1 - 2 NUEP)/(1 + NUEP) p^2; e of tension; stress (1 - D(e)), fades over DEPRPT from EPFAIL on",
    "Kolling, Haufe, Feucht & Du Bois 2005",
    {{"1,2.0,0,0,2.5,0.25\n5,0,0,0,0.5\n\n" + tests,
      stretched,
      {},
      {8.0 / 3, -4.0 / 3, -4.0 / 3},
      {0},
      {2.0 / 3}},
     {"1,2.0,0,0,2.5,0.25\n6,0,0,0,0.5\n\n" + tests,
      stretched,
      {},
      {8.0 / 7, -4.0 / 7, -4.0 / 7},
      {0},
      {10.0 / 7}},
     {"1,2.0,0,0,2.5,0.25\n5,0,0,0,0.5\n10\n" + tests,
      stretched,
      {},
      {4.0 / 3, -2.0 / 3, -2.0 / 3},
      {0},
      {2.0 / 3}},
     {"1,2.0,0,0,2.5,0.25\n7,8,9\n\n" + tests,
      stretched,
      {},
      {2 * root8 / 3, -root8 / 3, -root8 / 3},
      {0},
      {(6 - root8) / 2}},
     {"1,2.0,0,0,2.5,0.25\n7,8,9\n\n" + tests, {0.9, 0.9, 0.9}, {}, {4.0 / 3, 4.0 / 3, 4.0 / 3}, {0}, {0}}},
    mat_samp_1_table()};

}  // namespace

}  // namespace courant
