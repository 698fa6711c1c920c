#include "laws/strength/barlat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/indexed_pieces.hpp"
#include "base/instruction_set.hpp"
#include "laws/strength/rate_factor.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(barlat_loops)

BarlatLoops barlat_loops() {
  return COURANT_VARIANT(barlat_loops)();
}

Real BarlatSurface::power(const std::array<Real, 3>& stress, std::array<Real, 3>& slope) const {
  constexpr Real none = 1e-150;
  const Real a = stress[0], b = H * stress[1], c = stress[2], K1 = 0.5 * (a + b), difference = 0.5 * (a - b);
  const Real K2 = std::sqrt(difference * difference + P * P * c * c) + none;
  const auto term = [this](Real factor, Real x) { return factor * x * std::pow(std::abs(x) + none, M - 2); };
  const Real plus = term(A, K1 + K2), minus = term(A, K1 - K2), twice = term(C, 2 * K2);
  const Real by_K1 = 0.5 * M * (plus + minus), by_K2 = M * (0.5 * (plus - minus) + twice) / K2;
  slope = {0.5 * (by_K1 + by_K2 * difference), 0.5 * H * (by_K1 - by_K2 * difference), by_K2 * P * P * c};
  return 0.5 * (plus * (K1 + K2) + minus * (K1 - K2) + twice * 2 * K2);
}

Real BarlatSurface::ratio(Real radians) const {
  const Real c = std::cos(radians), s = std::sin(radians);
  std::array<Real, 3> d;
  power({c * c, s * s, c * s}, d);
  // strain across the tension, over that through the thickness
  return -(s * s * d[0] + c * c * d[1] - s * c * d[2]) / (d[0] + d[1]);
}

BarlatSurface BarlatSurface::of_ratios(Real R00, Real R45, Real R90, Real M) {
  const Real along = R00 / (1 + R00), across = R90 / (1 + R90);
  BarlatSurface out{.C = 2 * std::sqrt(along * across), .H = std::sqrt(along / across), .M = M};
  out.A = 2 - out.C;
  // R45 rises with P
  constexpr int halvings = 200;
  Real low = 1e-3, high = 1e3;
  for (int k = 0; k < halvings && high > low; ++k) {
    out.P = std::sqrt(low * high);
    (out.ratio(pi / 4) < R45 ? low : high) = out.P;
  }
  return out;
}

namespace {

class BarlatSheet : public StrengthLaw {
 public:
  BarlatSheet(const SheetElasticity& elastic, const SheetSurface& surface, const MaterialAxes& axes,
              SheetHardening hardening)
      : surface_(surface), axes_(axes), hardening_(std::move(hardening)), E_(elastic.E), nu_(elastic.nu) {
    ro = elastic.ro;
    elastic_ = {E_ / (1 - nu_ * nu_), nu_ * E_ / (1 - nu_ * nu_), E_ / (2 * (1 + nu_))};
  }
  Real bulk_modulus() const override { return E_ / (3 * (1 - 2 * nu_)); }
  Real shear_modulus() const override { return elastic_[2]; }
  const MaterialAxes* axes() const override { return &axes_; }
  std::vector<HistoryVariable> history() const override { return {{"plastic_strain", "-"}}; }

  /// Only sheets have it: the stress stays plane.
  void update(const PointBlock& block) const override {
    std::array<Real, block_size> rate_zz;
    update_in_plane_stress(block, rate_zz.data());
  }
  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    BarlatPoints points;
    points.at.count = block.count;
    if (block.dt > 0) {
      loops_.go(elastic_, block, points);
      flow(block, points);
      loops_.settle(-nu_ / E_, block, points, rate_zz);
    }
    keep_stiffness(block, sound_speed());
  }

 private:
  void flow(const PointBlock& block, BarlatPoints& points) const {
    constexpr int most_rounds = 100, turns = 2, first_turn = 1;
    int turned = 0;
    for (int k = 0; k < most_rounds; ++k) {
      harden(points.at);
      const bool turning = k >= first_turn && turned < turns;
      turned += turning;
      if (!loops_.step(turning, surface_, elastic_, block, points)) break;
    }
  }
  void harden(YieldPoints& at) const {
    if (!hardening_.curve.empty())
      for (Index i = 0; i < at.count; ++i) at.stress[i] = hardening_.curve(at.plastic[i], at.by_strain[i]);
    else if (hardening_.K > 0)
      powers_.power_law(hardening_.K, hardening_.e0, hardening_.N, at), lower(at);
    else if (hardening_.top > 0)
      saturate(at);
    else
      for (Index i = 0; i < at.count; ++i)
        at.stress[i] = hardening_.yield + hardening_.slope * at.plastic[i],
        at.by_strain[i] = hardening_.slope;
  }

  void lower(YieldPoints& at) const {
    for (Index i = 0; hardening_.less != 0 && i < at.count; ++i) at.stress[i] -= hardening_.less;
  }
  void saturate(YieldPoints& at) const {
    const SheetHardening& h = hardening_;
    for (Index i = 0; i < at.count; ++i) {
      const Real e = at.plastic[i], x = e > 0 ? std::pow(e, h.power) : 0;
      const Real left = h.range * std::exp(-h.rate * x);
      at.stress[i] = h.top - left;
      at.by_strain[i] = e > 0 ? h.rate * h.power * x / e * left : (h.power == 1 ? h.rate * left : 0);
    }
  }

  SheetSurface surface_;
  MaterialAxes axes_;
  SheetHardening hardening_;
  Real E_, nu_;
  std::array<Real, 3> elastic_;
  BarlatLoops loops_ = barlat_loops();
  RateLoops powers_ = rate_loops();
};

}  // namespace

void BarlatCard::convert_stresses(const Conversion& conversion) {
  const Real factor = conversion.units.of("M/LT2");
  if (hr == 1) p2 *= factor;
  spi_is_stress_ = spi_is_stress_ || spi > largest_strain;
  if (spi_is_stress_) spi *= factor;
}

Real BarlatCard::first_strain() const {
  if (e0 > 0) return e0;
  if (spi_is_stress_ || spi > largest_strain) return std::pow(spi / p1, 1 / p2);
  return spi > 0 ? spi : std::pow(E / p1, 1 / (p2 - 1));
}

std::shared_ptr<StrengthLaw> BarlatCard::law_of(const Model& model, const BarlatSurface& surface) const {
  SheetHardening hardening;
  if (hr == 3) {
    if (const auto found = model.curves.find(lcid); found != model.curves.end())
      hardening.curve = IndexedPieces(found->second.abscissa, found->second.ordinate);
  } else if (hr == 2) {
    hardening.K = p1, hardening.N = p2, hardening.e0 = first_strain();
  } else {
    hardening.yield = p2, hardening.slope = E * p1 / (E - p1);
  }
  return make_sheet({ro, E, pr}, surface.sheet(), axes(model, beta), std::move(hardening));
}

std::shared_ptr<StrengthLaw> make_sheet(const SheetElasticity& elastic, const SheetSurface& surface,
                                        const MaterialAxes& axes, SheetHardening hardening) {
  return std::make_shared<BarlatSheet>(elastic, surface, axes, std::move(hardening));
}

void check_sheet_curve(const Deck& deck, const Model& model, const Entry& card, const char* field, Id id,
                       const char* hint, Diagnostics& diagnostics) {
  const auto found = model.curves.find(id);
  const auto fail = [&](const std::string& what) { deck.error(diagnostics, card, field, what, hint); };
  if (found == model.curves.end())
    return fail(model.tables.count(id) > 0 ? fmt::format("table {} is not supported", id)
                                           : fmt::format("curve {} does not exist", id));
  const std::vector<Real>&x = found->second.abscissa, &y = found->second.ordinate;
  if (x.size() < 2) return fail(fmt::format("curve {} has less than two points", id));
  for (std::size_t k = 0; k < x.size(); ++k)
    if (!(y[k] > 0) || (k > 0 && (!(x[k] > x[k - 1]) || y[k] < y[k - 1])))
      return fail(fmt::format(
          "curve {}: expected rising strains and stresses > 0 that do not fall, got ({:g}, {:g}) at "
          "point {}",
          id, x[k], y[k], k + 1));
}

void BarlatCard::expect(const Deck& deck, Diagnostics& diagnostics, bool holds, const char* field,
                        const char* what, Real value, const char* hint) const {
  if (!holds)
    deck.error(diagnostics, *this, field, fmt::format("expected {}, got '{:g}'", what, value), hint);
}

void BarlatCard::check_ratios(const Deck& deck, Diagnostics& diagnostics) const {
  for (const auto& [field, value] : {std::pair{"R00", r00}, std::pair{"R45", r45}, std::pair{"R90", r90}})
    expect(
        deck, diagnostics, value > 0, field, "a number > 0", value,
        "the ratio of the plastic strain across the tension to that through the thickness; curves (< 0) are "
        "not supported");
}

void BarlatCard::check_hardening(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  check_axes(deck, model, diagnostics);
  const auto check = [&](bool holds, const char* field, const char* what, Real value, const char* hint) {
    expect(deck, diagnostics, holds, field, what, value, hint);
  };
  check(pr < 0.5, "PR", "a number < 0.5", pr, "a material that keeps its volume has no finite bulk modulus");
  check(hr == 1 || hr == 2 || hr == 3, "HR", "1, 2 or 3", hr,
        "1 linear (P1 tangent modulus, P2 yield stress), 2 P1 (E0 + e)^P2, 3 the curve LCID");
  if (hr == 1) {
    check(p1 >= 0 && p1 < E, "P1", "a number from 0 to below E", p1, "with HR 1 the tangent modulus");
    check(p2 > 0, "P2", "a number > 0", p2, "with HR 1 the yield stress");
  } else if (hr == 2) {
    check(p1 > 0, "P1", "a number > 0", p1, "with HR 2 the factor of (E0 + e)^P2");
    check(p2 > 0 && p2 < 1, "P2", "a number between 0 and 1", p2, "with HR 2 the exponent of hardening");
  } else if (hr == 3) {
    check_sheet_curve(deck, model, *this, "LCID", lcid,
                      "with HR 3 a *DEFINE_CURVE of yield stress over effective plastic strain", diagnostics);
  }
}

}  // namespace courant
