// Soil and foam: compaction by a table, and a strength by pressure (Krieg 1972). Pressures are > 0 in
// compression.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "keyword/expectations.hpp"
#include "laws/eos/volume_table.hpp"
#include "laws/materials/soil_cards.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// What a card amounts to.
struct SoilNumbers {
  Real ro, G, bulk;     ///< [M/L3], [M/LT2]
  Real a0, a1, a2;      ///< [M2/L2T4], [M/LT2], [-]
  Real cutoff;          ///< least pressure [M/LT2]
  bool crushes, tears;  ///< unloading by `bulk`; no tension behind `cutoff`
  VolumeTable C;        ///< pressure of first loading over -ln V
  Real back(Real most) const { return crushes ? std::max(bulk, C.slope(most)) : C.slope(most); }
  /// The largest J2; where A2 > 0 that of the vertex below it. [M2/L2T4]
  Real strength(Real p) const {
    const Real x = a2 > 0 ? std::max(p, -0.5 * a1 / a2) : p;
    return std::max(a0 + x * (a1 + x * a2), Real(0));
  }
};

class SoilAndFoam : public StrengthLaw {
 public:
  explicit SoilAndFoam(SoilNumbers numbers) : c_(std::move(numbers)) { ro = c_.ro; }
  Real bulk_modulus() const override { return std::max(c_.back(0), c_.C.slope(0)); }
  Real shear_modulus() const override { return c_.G; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{
        {"plastic_strain", "-"}, {"logarithmic_volume", "-"}, {"compaction", "-"}};
    if (c_.tears) out.push_back({"torn", "-"});
    return out;
  }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Real grown = block.dt * (block.rate[0][i] + block.rate[1][i] + block.rate[2][i]);
      const auto& s = block.stress;
      const Real mean = (s[0][i] + s[1][i] + s[2][i]) / 3, p = pressure(block, i, grown);
      for (std::size_t k = 0; k < 6; ++k)
        s[k][i] += 2 * c_.G * block.dt * block.rate[k][i] - (k < 3 ? mean + 2 * c_.G * grown / 3 : 0);
      const Real J2 = 0.5 * (s[0][i] * s[0][i] + s[1][i] * s[1][i] + s[2][i] * s[2][i]) + s[3][i] * s[3][i] +
                      s[4][i] * s[4][i] + s[5][i] * s[5][i];
      const Real most = c_.strength(p);
      if (J2 > most) {
        const Real root = std::sqrt(J2), limit = std::sqrt(most);
        block.history[0][i] += (root - limit) / (root_3 * c_.G);
        for (std::size_t k = 0; k < 6; ++k) s[k][i] *= limit / root;
      }
      for (std::size_t k = 0; k < 3; ++k) s[k][i] -= p;
      const Real stiff = std::max(c_.back(block.history[2][i]), c_.C.slope(block.history[2][i]));
      const Real dense = block.compression ? 1 + block.compression[i] : 1;
      block.sound_speed[i] = std::sqrt((stiff + 4 * c_.G / 3) / (ro * dense));
    }
  }

 private:
  static constexpr Real root_3 = 1.7320508075688772;
  /// What is torn below the cut-off opens without stress, and closes at the volume at which it opened.
  Real pressure(const PointBlock& block, Index i, Real grown) const {
    Real &volume = block.history[1][i], &most = block.history[2][i];
    volume += grown;
    const Real e = -volume;
    const Real elastic = e > most ? c_.C(e) : c_.crushes ? c_.C(most) + c_.back(most) * (e - most) : c_.C(e);
    most = std::max(most, e);
    if (!c_.tears) return std::max(elastic, c_.cutoff);
    Real& torn = block.history[3][i];
    if (elastic < c_.cutoff) torn = 1;
    return std::max(elastic, torn > 0 ? 0 : c_.cutoff);
  }

  SoilNumbers c_;
};

template <class Fields, bool tears>
struct SoilCard : Fields {
  std::array<Real, 10> strains() const {
    return {this->eps1, this->eps2, this->eps3, this->eps4, this->eps5,
            this->eps6, this->eps7, this->eps8, this->eps9, this->eps10};
  }
  std::array<Real, 10> pressures() const {
    return {this->p1, this->p2, this->p3, this->p4, this->p5,
            this->p6, this->p7, this->p8, this->p9, this->p10};
  }
  /// Points of compaction as the deck gives them. Blank ones behind the last are none.
  std::pair<std::vector<Real>, std::vector<Real>> given(const Model& model) const {
    if (const auto curve = model.curves.find(this->lcid); this->lcid != 0 && curve != model.curves.end())
      return {curve->second.abscissa, curve->second.ordinate};
    const auto e = strains(), p = pressures();
    std::size_t count = 10;
    while (count > 0 && e[count - 1] == 0 && p[count - 1] == 0) --count;
    return {{e.begin(), e.begin() + static_cast<long>(count)},
            {p.begin(), p.begin() + static_cast<long>(count)}};
  }
  /// Over -ln V from 0 on. Strains of compression may have either sign.
  VolumeTable compaction(const Model& model) const {
    auto [e, p] = given(model);
    const auto negative = [](Real x) { return x < 0; };
    if (std::any_of(e.begin(), e.end(), negative))
      for (Real& x : e) x = -x;
    if (e.size() > 1 && e.front() > e.back())
      std::reverse(e.begin(), e.end()), std::reverse(p.begin(), p.end());
    if (e.empty() || e.front() > 0) e.insert(e.begin(), 0), p.insert(p.begin(), 0);
    return {std::move(e), std::move(p)};
  }
  std::shared_ptr<StrengthLaw> law(const Model& model) const {
    return std::make_shared<SoilAndFoam>(SoilNumbers{.ro = this->ro,
                                                     .G = this->g,
                                                     .bulk = this->bulk,
                                                     .a0 = this->a0,
                                                     .a1 = this->a1,
                                                     .a2 = this->a2,
                                                     .cutoff = this->pc,
                                                     .crushes = this->vcr == 0,
                                                     .tears = tears,
                                                     .C = compaction(model)});
  }
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
    const auto expect = expectations_of(*this, deck, diagnostics);
    expect(this->vcr == 0 || this->vcr == 1, "VCR", "0 or 1", this->vcr,
           "1: unloading along the curve of loading");
    if (this->vcr == 0)
      expect(this->bulk > 0, "BULK", "a number > 0", this->bulk, "with VCR 0 unloading takes it");
    if (this->a0 == 0 && this->a1 == 0 && this->a2 == 0)
      deck.warning(diagnostics, *this, "A0", "there is no strength: it flows as a fluid",
                   "J2 <= A0 + A1 p + A2 p^2");
    const char* field = this->lcid != 0 ? "LCID" : "EPS1";
    if (this->lcid != 0 && !model.curves.contains(this->lcid)) {
      deck.error(diagnostics, *this, field, fmt::format("there is no curve {}", this->lcid),
                 "tables over the temperature are not supported");
      return;
    }
    check_compaction(deck, field, compaction(model), diagnostics);
  }
  void check_compaction(const Deck& deck, const char* field, const VolumeTable& C,
                        Diagnostics& diagnostics) const {
    const char* hint = "pressures > 0 over ln V, which falls or rises from 0 on in compression";
    const std::vector<Real>&e = C.strain(), &p = C.value();
    if (e.size() < 2) return deck.error(diagnostics, *this, field, "there is no compaction", hint);
    Real steepest = 0;
    for (std::size_t k = 0; k < e.size(); ++k) {
      const bool rises = k == 0 ? e[0] == 0 && p[0] == 0 : e[k] > e[k - 1] && p[k] > p[k - 1];
      if (!rises)
        return deck.error(diagnostics, *this, field,
                          fmt::format("expected a curve that rises from 0, got ({:g}, {:g}) at point {}",
                                      e[k], p[k], k + 1),
                          hint);
      if (k > 0) steepest = std::max(steepest, (p[k] - p[k - 1]) / (e[k] - e[k - 1]));
    }
    if (this->vcr == 0 && this->bulk > 0 && this->bulk < steepest * (1 - 1e-9))
      deck.warning(
          diagnostics, *this, "BULK",
          fmt::format("is below the steepest slope of the curve, {:.4g}, which unloading takes where it is "
                      "larger",
                      steepest),
          "by a smaller modulus more work comes back than was done");
  }
};

using MatSoilAndFoam = SoilCard<MatSoilAndFoamFields, false>;
using MatSoilAndFoamFailure = SoilCard<MatSoilAndFoamFailureFields, true>;

// By hand. G = 4, BULK = 4, J2 <= 1 + 2 p. Torn along x by 0.03: mean 0.12, s = 8 0.02. Pressed evenly
// through (0.05, 0.2) to 0.1: 0.2 + 2 0.05; back by BULK. Sheared at p = 0.3: s_xy = sqrt(1.6). Torn evenly
// by 0.6: PC.
const std::string soil = "1,2.0,4.0,4.0,1.0,2.0,0.0,-0.5\n\n-0.05,-0.15\n\n0.2,0.4\n\n";
constexpr Real sheared_soil = 1.2649110640673518;
std::vector<StrengthReference> references_of_soil(Real torn) {
  return {{soil, {0.03}, {}, {0.28, 0.04, 0.04}},
          {soil, {-0.1 / 3, -0.1 / 3, -0.1 / 3}, {}, {-0.3, -0.3, -0.3}, {}, {0, -0.1, 0.1}},
          {soil, {0.01, 0.01, 0.01}, {-0.3, -0.3, -0.3}, {-0.18, -0.18, -0.18}, {0, -0.1, 0.1}},
          {soil,
           {0, 0, 0, 0.5, 0, 0},
           {-0.3, -0.3, -0.3},
           {-0.3, -0.3, -0.3, sheared_soil, 0, 0},
           {0, -0.1, 0.1},
           {(4 - sheared_soil) / (4 * 1.7320508075688772), -0.1, 0.1}},
          {soil, {0.2, 0.2, 0.2}, {}, {torn, torn, torn}}};
}
const RegisterStrength<MatSoilAndFoam> mat_soil_and_foam{
    "J2 <= A0 + A1 p + A2 p^2, s returned along itself; p by a table over -ln V, back by BULK, >= PC",
    "Krieg 1972", references_of_soil(0.5), mat_soil_and_foam_table()};
const RegisterStrength<MatSoilAndFoamFailure> mat_soil_and_foam_failure{
    "J2 <= A0 + A1 p + A2 p^2, s returned along itself; p by a table over -ln V, back by BULK, >= PC, and >= "
    "0 once it "
    "was PC",
    "Krieg 1972", references_of_soil(0), mat_soil_and_foam_failure_table()};

}  // namespace

}  // namespace courant
