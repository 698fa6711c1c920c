// *MAT_GURSON: metal with voids. Gurson 1977; Tvergaard & Needleman 1984; nucleation: Chu & Needleman 1980.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/indexed_pieces.hpp"
#include "keyword/expectations.hpp"
#include "laws/materials/mat_piecewise_linear_plasticity.hpp"
#include "laws/strength/hardening.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/root_below.hpp"

namespace courant {

namespace {

/// A number, or a curve over the size of the element.
struct BySize {
  Real value = 0;
  IndexedPieces over{};
  Real at(Real size) const { return over.empty() ? value : over(size); }
};

struct MatGurson : MatGursonFields {
  std::shared_ptr<StrengthLaw> law(const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  Hardening points() const {
    Hardening out{{eps1, eps2, eps3, eps4, eps5, eps6, eps7, eps8}, {es1, es2, es3, es4, es5, es6, es7, es8}};
    drop_blank_points(out);
    return out;
  }
  /// L and FF; blank ones behind the last are left out.
  Curve failure_points() const {
    Curve out;
    const Real l[] = {l1, l2, l3, l4}, ff[] = {ff1, ff2, ff3, ff4};
    for (std::size_t k = 0; k < 4; ++k)
      if (ff[k] > 0) out.abscissa.push_back(l[k]), out.ordinate.push_back(ff[k]);
    return out;
  }
};

/// Shares of voids and nucleation at a point.
struct Voids {
  Real first, joins, fails, forms, mean, deviation;
};

/// q^2/Y^2 + 2 F cosh(3/2 Q2 m/Y) - 1 - F^2 = 0, F = Q1 f*, with the mean stress m and the matrix's yield
/// stress Y at the end of the step and the voids at its start.
class Gurson : public StrengthLaw {
 public:
  Gurson(const MatGurson& card, const Model& model)
      : c_(card), K_(card.E / (3 * (1 - 2 * card.pr))), G_(card.E / (2 * (1 + card.pr))) {
    ro = card.ro, failing_layers = static_cast<int>(card.numint);
    const auto curve = [&](Id id) {
      const auto found = model.curves.find(id);
      return found == model.curves.end() ? IndexedPieces() : of(found->second);
    };
    const auto or_curve = [&](Real x) { return x < 0 ? BySize{0, curve(static_cast<Id>(-x))} : BySize{x}; };
    first_ = {card.f0, curve(card.lcf0)}, joins_ = {card.fc, curve(card.lcfc)},
    forms_ = {card.fn, curve(card.lcfn)};
    mean_ = or_curve(card.en), deviation_ = or_curve(card.sn);
    fails_ = {card.ff0, card.lclf != 0 ? curve(card.lclf) : of(card.failure_points())};
    for (const BySize* one : {&first_, &joins_, &forms_, &mean_, &deviation_, &fails_})
      sized_ = sized_ || !one->over.empty();
    if (card.lcss != 0) {
      if (const auto found = model.curves.find(card.lcss); found != model.curves.end())
        yield_ = IndexedPieces(found->second.abscissa, found->second.ordinate);
    } else if (card.atyp == 3) {
      const Hardening table = card.points();
      yield_ = IndexedPieces(table.strain, table.stress);
    }
  }
  Real bulk_modulus() const override { return K_; }
  Real shear_modulus() const override { return G_; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{"plastic_strain", "-"}, {"void_growth", "-"}, {"failure_ratio", "-"}};
    if (sized_) out.push_back({element_size, "L"});
    return out;
  }
  std::string failure_variable() const override { return "failure_ratio"; }
  Real failure_limit() const override {
    return fails_.value > 0 || !fails_.over.empty() ? 1 : std::numeric_limits<Real>::infinity();
  }

  void update(const PointBlock& block) const override {
    PlasticTrial trial;
    go_elastically(K_ - 2 * G_ / 3, G_, block, FixedCentre{}, trial);
    for (Index i = 0; i < block.count; ++i) flow(block, i, trial.q[i]);
    keep_stiffness(block, sound_speed());
  }

 private:
  static IndexedPieces of(const Curve& curve) {
    return {curve.abscissa, curve.ordinate, IndexedPieces::Beyond::constant};
  }
  Real yield(Real e) const {
    if (!yield_.empty()) return std::max(yield_(e), Real(0));
    if (c_.atyp == 2) return c_.sigy + c_.E * c_.etan / (c_.E - c_.etan) * e;
    return c_.sigy * std::pow(1 + e * c_.E / c_.sigy, 1 / c_.n);
  }
  Voids voids(const PointBlock& block, Index i) const {
    const Real size = sized_ ? block.history[3][i] : 0;
    return {first_.at(size), joins_.at(size), fails_.at(size),
            forms_.at(size), mean_.at(size),  deviation_.at(size)};
  }
  /// Q1 f*: voids that join count for more, up to 1 where the material fails.
  Real weakness(const Voids& v, Real f) const {
    const bool join = v.fails > v.joins && v.joins > 0 && f > v.joins;
    const Real counts = join ? v.joins + (1 / c_.q1 - v.joins) / (v.fails - v.joins) * (f - v.joins) : f;
    return std::min(c_.q1 * counts, Real(1));
  }

  /// Mean stress, q, and the strain of the matrix on the surface of a yield stress Y.
  struct Returned {
    Real mean, q, strain;
  };
  /// By Newton's method within bounds, of the normality of the flow; `mean` and `q` of the trial stress.
  Returned on_surface(Real mean, Real q, Real Y, Real F, Real f) const {
    const Real size = std::abs(mean), b = 1.5 * c_.q2 / Y;
    const Real tip = F > 0 ? std::acosh((1 + F * F) / (2 * F)) / b : size;
    Real low = 0, high = std::min(size, tip), m = high, left = 0;
    const auto q_at = [&](Real x) {
      return Y * std::sqrt(std::max(1 + F * F - 2 * F * std::cosh(b * x), Real(0)));
    };
    constexpr int most_rounds = 100;
    constexpr Real round_off = 1e-15;
    for (int k = 0; k < most_rounds && high - low > round_off * high; ++k) {
      left = q_at(m);
      const Real S = F * std::sinh(b * m), C = F * std::cosh(b * m);
      const Real over = (size - m) / K_ * 2 * left - (q - left) / G_ * c_.q2 * Y * S;
      (over > 0 ? low : high) = m;
      const Real by = left > 0 ? -Y * Y * S * b / left : 0;
      const Real slope =
          -2 * left / K_ + (size - m) / K_ * 2 * by + (by * S - (q - left) * C * b) / G_ * c_.q2 * Y;
      const Real next = left > 0 && slope < 0 ? m - over / slope : -1;
      if (over == 0 || std::abs(next - m) <= round_off * m) break;
      m = next > low && next < high ? next : 0.5 * (low + high);
    }
    left = q_at(m);
    const Real work = m * (size - m) / K_ + left * (q - left) / (3 * G_);
    return {mean < 0 ? -m : m, left, work / ((1 - f) * Y)};
  }

  void flow(const PointBlock& block, Index i, Real q) const {
    const auto& s = block.stress;
    Real &plastic = block.history[0][i], &growth = block.history[1][i], &ratio = block.history[2][i];
    const Voids v = voids(block, i);
    const Real mean = (s[0][i] + s[1][i] + s[2][i]) / 3, f = v.first + growth, F = weakness(v, f),
               old = plastic;
    if (!(F < 1)) {  // nothing is left
      for (Real* stress : s) stress[i] = 0;
      return;
    }
    const Real Y = yield(old),
               level = q * q / (Y * Y) + 2 * F * std::cosh(1.5 * c_.q2 * mean / Y) - 1 - F * F;
    if (level <= 0) return;
    const auto excess = [&](Real e) { return on_surface(mean, q, yield(old + e), F, f).strain - e; };
    const Real most = excess(0), e = most > 0 ? root_below(most, excess) : 0;
    const Returned on = on_surface(mean, q, yield(old + e), F, f);
    const Real volume = (mean - on.mean) / K_;
    plastic += e;
    grow(v, f, volume, old, e, growth);
    if (v.fails > 0) ratio = std::max(ratio, (v.first + growth) / v.fails);
    const Real scale = q > 0 ? on.q / q : 1;
    for (std::size_t k = 0; k < 6; ++k)
      s[k][i] = scale * (s[k][i] - (k < 3 ? mean : 0)) + (k < 3 ? on.mean : 0);
  }
  void grow(const Voids& v, Real f, Real volume, Real plastic, Real e, Real& growth) const {
    constexpr Real per_root = 0.3989422804014327;  // 1/sqrt(2 pi)
    if (volume > 0 || c_.vgtyp != 1) growth += (1 - f) * volume;
    growth = std::max(growth, c_.vgtyp == 2 ? -v.first : std::min(f - v.first, Real(0)));
    if (!(v.forms > 0) || !(v.deviation > 0)) return;
    const Real x = (plastic + 0.5 * e - v.mean) / v.deviation;
    growth += v.forms * per_root / v.deviation * std::exp(-0.5 * x * x) * e;
  }

  MatGurson c_;
  Real K_, G_;  ///< [M/LT2]
  IndexedPieces yield_;
  BySize first_, joins_, fails_, forms_, mean_, deviation_;
  bool sized_ = false;
};

std::shared_ptr<StrengthLaw> MatGurson::law(const Model& model) const {
  return std::make_shared<Gurson>(*this, model);
}

void MatGurson::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  const auto curve = [&](Real number, const char* field, const char* hint) {
    const Id id = static_cast<Id>(number);
    const auto found = model.curves.find(id);
    if (id == 0 || (found != model.curves.end() && found->second.abscissa.size() > 0)) return;
    deck.error(diagnostics, *this, field, fmt::format("curve {} does not exist", id), hint);
  };
  expect(pr < 0.5, "PR", "a number < 0.5", pr, "a material that keeps its volume has no finite bulk modulus");
  expect(atyp == 1 || atyp == 2 || atyp == 3, "ATYP", "1, 2 or 3", atyp,
         "1 by N, 2 by ETAN, 3 by EPS and ES");
  expect(vgtyp == 0 || vgtyp == 1 || vgtyp == 2, "VGTYP", "0, 1 or 2", vgtyp, "how voids shrink");
  expect(f0 * q1 < 1, "F0", "a number below 1/Q1", f0, "the material would have failed at the start");
  expect(ff0 == 0 || ff0 > fc, "FF0", "a number above FC", ff0, "voids join from FC to FF0");
  expect(fn == 0 || sn != 0, "SN", "a number > 0", sn, "voids form around EN with this deviation");
  check_failing_layers(deck, *this, numint, diagnostics);
  const char* over_size = "a *DEFINE_CURVE over the element's size";
  for (const auto& [field, id] : {std::pair{"LCLF", lclf}, {"LCF0", lcf0}, {"LCFC", lcfc}, {"LCFN", lcfn}})
    curve(static_cast<Real>(id), field, over_size);
  curve(std::max(-en, Real(0)), "EN", over_size), curve(std::max(-sn, Real(0)), "SN", over_size);
  const SteepestFall no_fall{0, "the yield stress of the matrix must not fall"};
  if (lcss != 0) {
    curve(static_cast<Real>(lcss), "LCSS", "a *DEFINE_CURVE of yield stress over effective plastic strain");
    if (const auto found = model.curves.find(lcss); found != model.curves.end()) {
      const Hardening points{found->second.abscissa, found->second.ordinate};
      for (std::size_t k = 0; k < points.strain.size(); ++k)
        if (!(points.stress[k] > 0) ||
            (k > 0 && (!(points.strain[k] > points.strain[k - 1]) || points.slope(k - 1) < no_fall.slope)))
          return deck.error(
              diagnostics, *this, "LCSS",
              fmt::format("curve {}: expected rising strains and stresses > 0 that do not fall, got "
                          "({:g}, {:g}) at point {}",
                          lcss, points.strain[k], points.stress[k], k + 1),
              "yield stress of the matrix over its plastic strain");
    }
  } else if (atyp == 3) {
    const Hardening table = points();
    if (table.strain.empty())
      expect(false, "EPS2", "points of the yield stress", 0, "with ATYP 3 by EPS and ES");
    else
      check_points(deck, *this, table, {-std::numeric_limits<Real>::min(), no_fall.too_fast}, diagnostics);
  } else {
    expect(sigy > 0, "SIGY", "a number > 0", sigy, "the yield stress at the start");
    expect(atyp != 1 || n >= 1, "N", "a number of 1 or more", n, "with ATYP 1 the exponent is 1/N");
    expect(etan < E, "ETAN", "a number below E", etan, "beyond the yield stress the material is softer");
  }
}

// By hand. E = 2.5, PR = 1/4: G = 1, K = 5/3. Without voids as *MAT_PIECEWISE_LINEAR_PLASTICITY with ETAN
// 1/2: SIGY 3, de = 24/29. Pulled alike in all directions by 0.9: mean 4.5. Q1 = Q2 = 1, F0 = e^(-3/2):
// cosh(3/2 m/Y) = (1 + F^2)/(2 F) at m = Y = 3: volume 1.5/K = 0.9 of plastic strain, of the matrix 0.9/(1 -
// F0).
constexpr Real first_voids = 0.22313016014842982;
const RegisterStrength<MatGurson> mat_gurson{
    "q^2/Y^2 + 2 Q1 f* cosh(3 Q2 mean/(2 Y)) - 1 - (Q1 f*)^2 <= 0; plastic strain along its normal; (1 - f) "
    "Y de = its "
    "work; df = (1 - f) tr(de_p) + FN/(SN sqrt(2 pi)) exp(-((e - EN)/SN)^2/2) de; f* = f up to FC, straight "
    "to 1/Q1 at FF0",
    "Gurson 1977; Tvergaard & Needleman 1984; Chu & Needleman 1980",
    {{"1,2.0,2.5,0.25,3.0,0.0,1.5,1.0\n0.0,0.0,0.0,0.0,0.0,0.5,2.0\n\n\n",
      {2, -1, -1},
      {},
      {68.0 / 29, -34.0 / 29, -34.0 / 29},
      {0},
      {24.0 / 29, 0, 0}},
     {"1,2.0,2.5,0.25,3.0,0.0,1.0,1.0\n0.0,0.22313016014842982,0.0,0.0,0.0,0.0,2.0\n\n\n",
      {0.9, 0.9, 0.9},
      {},
      {3, 3, 3},
      {0},
      {0.9 / (1 - first_voids), 0.9 * (1 - first_voids), 0}}},
    mat_gurson_table()};

}  // namespace

}  // namespace courant
