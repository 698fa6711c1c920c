#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/indexed_pieces.hpp"
#include "keyword/expectations.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/hardening.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/rate_factor.hpp"
#include "laws/strength/strength.hpp"
#include "laws/strength/yield_return.hpp"

namespace courant {

namespace {

/// Yield stress over plastic strain, and its factor over the rate; empty: none.
struct SideOfZero {
  IndexedPieces stress{}, factor{};
};

/// J2 plasticity whose yield stress is that of compression below the mean stress -PC, of tension above PT,
/// and straight between.
class CompressionTension : public StrengthLaw {
 public:
  CompressionTension(Real density, Real E, Real nu, SideOfZero compression, SideOfZero tension, Real pc,
                     Real pt)
      : sides_{std::move(compression), std::move(tension)}, pc_(pc), pt_(pt) {
    law_.lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), law_.G = E / (2 * (1 + nu));
    ro = density;
  }
  void depend_on(YieldRate rate, const CowperSymonds& term) { law_.rate = rate, rate_term_ = term; }
  Real bulk_modulus() const override { return law_.lambda + 2 * law_.G / 3; }
  Real shear_modulus() const override { return law_.G; }
  std::vector<HistoryVariable> history() const override { return {{"plastic_strain", "-"}}; }
  Real failure_limit() const override { return fails_at; }
  LeastStep least_step() const override { return {shortest_step, 0}; }
  Real fails_at = std::numeric_limits<Real>::infinity();  ///< plastic strain [-]
  Real shortest_step = 0;                                 ///< elements with a smaller one fail [T]

  void update(const PointBlock& block) const override {
    PlasticTrial trial;
    go_elastically(law_.lambda, law_.G, block, FixedCentre{}, trial);
    Real tension[block_size];  // flow keeps the mean stress of the trial
    const auto& s = block.stress;
    for (Index i = 0; i < block.count; ++i) tension[i] = share((s[0][i] + s[1][i] + s[2][i]) / 3);
    Real* plastic = block.history[0];
    find_increments(loops_, law_, block, plastic, trial, [&](YieldPoints& points) { at(points, tension); });
    for (Index i = 0; i < block.count; ++i) plastic[i] += trial.plastic[i];
    constexpr Real none = 1e-300;  // there is no increment where q is 0
    return_radially(law_.G, 0, none, block, FixedCentre{}, trial);
    keep_stiffness(block, sound_speed());
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    if (!(block.dt > 0)) return StrengthLaw::update_in_plane_stress(block, rate_zz);
    // Flow keeps the sign of the trial's mean stress and takes some of it away: the stress before the step,
    // where it is smaller, is nearer to the one after it.
    Real tension[block_size];
    const Real both = plane_sum() * block.dt;
    for (Index i = 0; i < block.count; ++i) {
      const Real before = (block.stress[0][i] + block.stress[1][i]) / 3,
                 trial = before + both * (block.rate[0][i] + block.rate[1][i]) / 3;
      const bool between = trial > 0 ? before > 0 && before < trial : before < 0 && before > trial;
      tension[i] = share(between ? before : trial);
    }
    update_in_plane(loops_, law_, block, nullptr, rate_zz, [&](YieldPoints& points) { at(points, tension); });
    keep_stiffness(block, sound_speed());
  }

 private:
  /// Sum of the stresses in the plane over that of the strains: E/(1 - nu). [M/LT2]
  Real plane_sum() const { return 2 * law_.G * (3 * law_.lambda + 2 * law_.G) / (law_.lambda + 2 * law_.G); }
  /// Where PC and PT are 0 it jumps, and round-off of a mean stress of 0 would choose the curve: so it goes
  /// over a millionth of Young's modulus at least.
  Real share(Real mean) const {
    const Real E = law_.G * (3 * law_.lambda + 2 * law_.G) / (law_.lambda + law_.G);
    const Real half = 0.5 * std::max(pt_ + pc_, 1e-6 * E), middle = 0.5 * (pt_ - pc_);
    return std::clamp((mean - middle + half) / (2 * half), Real(0), Real(1));
  }
  void at(YieldPoints& points, const Real* tension) const {
    for (Index i = 0; i < points.count; ++i) {
      points.stress[i] = points.by_strain[i] = points.by_rate[i] = 0;
      for (std::size_t k = 0; k < 2; ++k) {
        const Real weight = k == 1 ? tension[i] : 1 - tension[i];
        if (weight == 0) continue;
        Real slope, by_rate = 0;
        const Real stress = sides_[k].stress(points.plastic[i], slope);
        const Real factor = sides_[k].factor.empty() ? 1 : sides_[k].factor(points.rate[i], by_rate);
        points.stress[i] += weight * factor * stress, points.by_strain[i] += weight * factor * slope;
        points.by_rate[i] += weight * by_rate * stress;
      }
    }
    if (rate_term_.counts()) rates_.scale(rate_term_, points);
  }

  std::array<SideOfZero, 2> sides_;  ///< compression, tension
  Real pc_, pt_;                     ///< [M/LT2]
  ReturnLaw law_;
  CowperSymonds rate_term_{};
  ReturnLoops loops_ = return_loops();
  RateLoops rates_ = rate_loops();
};

struct MatPlasticityCompressionTension : MatPlasticityCompressionTensionFields {
  static const Curve* curve_of(const Model& model, Id id) {
    const auto found = model.curves.find(id);
    return found == model.curves.end() ? nullptr : &found->second;
  }
  static SideOfZero side(const Model& model, Id of_strain, Id of_rate) {
    SideOfZero out;
    if (const Curve* c = curve_of(model, of_strain)) out.stress = IndexedPieces(c->abscissa, c->ordinate);
    if (const Curve* c = curve_of(model, of_rate))
      out.factor = IndexedPieces(c->abscissa, c->ordinate, IndexedPieces::Beyond::constant);
    return out;
  }
  bool depends_on_rate() const { return c > 0 || lcsrc != 0 || lcsrt != 0; }
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    auto out = std::make_shared<CompressionTension>(ro, E, pr, side(model, lcidc, lcsrc),
                                                    side(model, lcidt, lcsrt), pc, pt);
    if (depends_on_rate())
      out->depend_on(srflag == 0 ? YieldRate::of_flow_and_volume : YieldRate::of_flow, {c, c > 0 ? p : 1});
    if (fail > 0 && fail < never_fails) out->fails_at = fail;
    out->shortest_step = tdel;
    return out;
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  void check_curve(const Deck& deck, const Model& model, const char* field, Id id,
                   Diagnostics& diagnostics) const;
  void check_factor(const Deck& deck, const Model& model, const char* field, Id id,
                    Diagnostics& diagnostics) const;
};

using CT = MatPlasticityCompressionTension;

void CT::check_curve(const Deck& deck, const Model& model, const char* field, Id id,
                     Diagnostics& diagnostics) const {
  const char* hint = "a *DEFINE_CURVE of the yield stress over effective plastic strain, from 0 on";
  const Curve* curve = curve_of(model, id);
  if (!curve)
    return deck.error(diagnostics, *this, field,
                      model.tables.count(id) > 0 ? fmt::format("table {} is not supported", id)
                                                 : fmt::format("curve {} does not exist", id),
                      hint);
  const Hardening points{curve->abscissa, curve->ordinate};
  if (points.strain.size() < 2)
    return deck.error(diagnostics, *this, field, fmt::format("curve {} has less than two points", id), hint);
  const SteepestFall fall = steepest_fall(model, mid, E, pr);
  for (std::size_t k = 0; k < points.strain.size(); ++k) {
    if (!(points.stress[k] > 0) || (k > 0 && !(points.strain[k] > points.strain[k - 1])))
      return deck.error(diagnostics, *this, field,
                        fmt::format("curve {}: expected rising strains and stresses > 0, got ({:g}, {:g}) at "
                                    "point {}",
                                    id, points.strain[k], points.stress[k], k + 1),
                        hint);
    if (k > 0 && !(points.slope(k - 1) > fall.slope))
      return deck.error(diagnostics, *this, field,
                        fmt::format("curve {} behind point {}: {}", id, k, fall.too_fast));
  }
  if (points.slope(points.strain.size() - 2) < 0)
    deck.error(diagnostics, *this, field, fmt::format("curve {} falls beyond its last point, to below 0", id),
               "let it end with a piece that does not fall");
}

void CT::check_factor(const Deck& deck, const Model& model, const char* field, Id id,
                      Diagnostics& diagnostics) const {
  if (id == 0) return;
  const Curve* curve = curve_of(model, id);
  const char* hint = "a *DEFINE_CURVE of the factor of the yield stress over the rate of strain";
  if (!curve)
    deck.error(diagnostics, *this, field, fmt::format("curve {} does not exist", id), hint);
  else if (*std::min_element(curve->ordinate.begin(), curve->ordinate.end()) <= 0)
    deck.error(diagnostics, *this, field, fmt::format("curve {} has factors that are not > 0", id), hint);
}

void CT::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  expect(pr < 0.5, "PR", "a number < 0.5", pr, "a material that keeps its volume has no finite bulk modulus");
  expect((c > 0) == (p > 0), c > 0 ? "P" : "C", "a number > 0", 0,
         "the rate of strain counts by C and P together; leave both blank where it does not");
  expect(fail >= 0, "FAIL", "a number >= 0", fail, "failure by a subroutine of one's own is not supported");
  expect(srflag == 0 || srflag == 1 || srflag == 2, "SRFLAG", "0, 1 or 2", srflag,
         "rate of all strain (0), of its deviator (1), of plastic strain (2)");
  check_curve(deck, model, "LCIDC", lcidc, diagnostics),
      check_curve(deck, model, "LCIDT", lcidt, diagnostics);
  check_factor(deck, model, "LCSRC", lcsrc, diagnostics),
      check_factor(deck, model, "LCSRT", lcsrt, diagnostics);
}

// By hand. E = 2.5, PR = 1/4: lambda = G = 1, 3 G = 3, K = 5/3. dev e = (2, -1, -1), no change of volume: q =
// 6. Yield stress 4 in compression, 2 in tension; PC = 1, PT = 3. Mean stress 0: share of tension 1/4, 3.5:
// de = 5/6. Mean 5: 2, de = 4/3. Mean -5: 4, de = 2/3. LCSRT 1 + rate/4, SRFLAG 1, dt = 1/2: 6 - 3 de = 2
// (1 + de/2), de = 1.
const std::string iron_curves =
    "*DEFINE_CURVE\n1\n0.0,4.0\n1.0,4.0\n*DEFINE_CURVE\n2\n0.0,2.0\n1.0,2.0\n*DEFINE_CURVE\n3\n0.0,1.0\n"
    "8.0,3.0\n";
const std::array<Real, 6> iron_strain{2, -1, -1};
StrengthReference iron_flows(const std::string& cards, Real mean, Real q, Real plastic) {
  return {cards + "1.0,3.0\n0\n" + iron_curves,           iron_strain, {mean, mean, mean},
          {mean + 2 * q / 3, mean - q / 3, mean - q / 3}, {0},         {plastic}};
}
const RegisterStrength<CT> mat_plasticity_compression_tension{
    "s_tr = s + 2 G dev(D) dt; q = sqrt(3/2 s:s) <= w s_t(e) f_t(rate) + (1 - w) s_c(e) f_c(rate), w = (mean "
    "stress + PC)/(PT + PC) from 0 to 1; times 1 + (rate/C)^(1/P); return along s_tr; pressure by Hooke's "
    "law",
    "J2 plasticity with radial return: Krieg & Key 1976; rates: Cowper & Symonds 1957",
    {iron_flows("1,2.0,2.5,0.25\n1,2\n", 0, 3.5, 2.5 / 3), iron_flows("1,2.0,2.5,0.25\n1,2\n", 5, 2, 4.0 / 3),
     iron_flows("1,2.0,2.5,0.25\n1,2\n", -5, 4, 2.0 / 3), iron_flows("1,2.0,2.5,0.25\n1,2,0,3,1\n", 5, 3, 1)},
    mat_plasticity_compression_tension_table()};

}  // namespace

}  // namespace courant
