#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "laws/materials/strength_cards.hpp"
#include "laws/strength/linear_hardening.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/rate_factor.hpp"
#include "laws/strength/strength.hpp"
#include "laws/strength/yield_return.hpp"

namespace courant {

namespace {

/// J2 plasticity with linear isotropic and kinematic hardening: s_tr = s + 2 G dev(D) dt is returned along
/// xi_tr = s_tr - alpha, with de = (q_tr - sigma_y)/(3 G + Ep) where the rate has no influence. Trial and
/// return have no branches, so that they go through registers of several points.
class PlasticKinematic : public StrengthLaw {
 public:
  PlasticKinematic(Real density, const LinearHardening& data) : a_(data) {
    ro = density;
    rate_term_.C = a_.C, rate_term_.P = a_.C > 0 ? a_.P : 1;
    law_ = {.lambda = a_.lambda, .G = a_.G, .kinematic = a_.kinematic};
    if (a_.C > 0) law_.rate = YieldRate::of_flow;
    law_.smooth = true;
  }
  Real bulk_modulus() const override { return a_.lambda + 2 * a_.G / 3; }
  Real shear_modulus() const override { return a_.G; }
  Real failure_limit() const override { return a_.fails_at; }
  Real failure_time() const override { return a_.fails_at_time; }
  std::vector<HistoryVariable> history() const override {
    std::vector<HistoryVariable> out{{"plastic_strain", "-"}};
    if (a_.kinematic > 0) out.push_back({"back_stress", "M/LT2", 6});
    return out;
  }

  void update(const PointBlock& block) const override {
    if (a_.kinematic > 0)
      update(block, MovingCentre{block.history.data() + 1});
    else
      update(block, FixedCentre{});
    keep_stiffness(block, sound_speed());
  }

  void update_in_plane_stress(const PointBlock& block, Real* rate_zz) const override {
    if (!(block.dt > 0)) return StrengthLaw::update_in_plane_stress(block, rate_zz);
    update_in_plane(loops_, law_, block, a_.kinematic > 0 ? block.history.data() + 1 : nullptr, rate_zz,
                    [this](YieldPoints& points) { at(points); });
    keep_stiffness(block, sound_speed());
  }

 private:
  template <class Centre>
  void update(const PointBlock& block, const Centre& centre) const {
    PlasticTrial trial;
    go_elastically(a_.lambda, a_.G, block, centre, trial);
    harden(block, trial);
    return_radially(a_.G, a_.kinematic, a_.yield, block, centre, trial);
  }

  /// The increments of plastic strain.
  void harden(const PointBlock& block, PlasticTrial& trial) const {
    const Real stiffness = 3 * a_.G + a_.isotropic + a_.kinematic;
    Real* plastic = block.history[0];
    if (a_.C > 0 && block.dt > 0)
      find_increments(loops_, law_, block, plastic, trial, [this](YieldPoints& points) { at(points); });
    else
#pragma omp simd
      for (Index i = 0; i < block.count; ++i)
        trial.plastic[i] = std::max(trial.q[i] - a_.yield - a_.isotropic * plastic[i], Real(0)) / stiffness;
#pragma omp simd
    for (Index i = 0; i < block.count; ++i) plastic[i] += trial.plastic[i];
  }

  /// sigma_y = (1 + (rate/C)^(1/P)) (SIGY + BETA Ep e)
  void at(YieldPoints& points) const {
#pragma omp simd
    for (Index i = 0; i < points.count; ++i)
      points.stress[i] = a_.yield + a_.isotropic * points.plastic[i], points.by_strain[i] = a_.isotropic;
    if (a_.C > 0) rates_.scale(rate_term_, points);
  }

  LinearHardening a_;
  CowperSymonds rate_term_;
  ReturnLaw law_;
  ReturnLoops loops_ = return_loops();
  RateLoops rates_ = rate_loops();
};

struct MatPlasticKinematic : MatPlasticKinematicFields {
  std::shared_ptr<StrengthLaw> law() const {
    const Real Ep = E * etan / (E - etan);
    LinearHardening data{.lambda = E * pr / ((1 + pr) * (1 - 2 * pr)), .G = E / (2 * (1 + pr))};
    data.yield = sigy, data.isotropic = beta * Ep, data.kinematic = (1 - beta) * Ep;
    data.C = src, data.P = srp;
    if (fs > 0 && fs < never_fails) data.fails_at = fs;
    return linear_hardening_law(ro, data);
  }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    const auto expect = [&](bool holds, const char* field, const char* what, Real value, const char* hint) {
      if (!holds)
        deck.error(diagnostics, *this, field, fmt::format("expected a number {}, got '{:g}'", what, value),
                   hint);
    };
    expect(pr < 0.5, "PR", "< 0.5", pr, "a material that keeps its volume has no finite bulk modulus");
    expect(etan < E, "ETAN", "below E", etan, "beyond the yield stress the material is softer than before");
    expect(beta <= 1, "BETA", "from 0 to 1", beta, "0 is kinematic hardening, 1 isotropic");
    expect((src > 0) == (srp > 0), src > 0 ? "SRP" : "SRC", "> 0", 0,
           "the rate of strain counts by SRC and SRP together; leave both blank where it does not");
  }
};

// By hand. E = 2.5, PR = 1/4: lambda = G = 1, 3 G = 3. ETAN = 0.5: Ep = 2.5 0.5/2 = 5/8. SIGY = 3 and dev e =
// (2, -1, -1): xi = (4, -2, -2), q = 6, over by 3: de = 3/(3 + 5/8) = 24/29, and s loses 3 de/6 = 12/29 of
// xi: s = 17/29 (4, -2, -2). Kinematic: alpha = (5/8) de/6 xi = (5/58) xi for BETA 0, half of it for 1/2.
// A back stress 1 in shear: xi_xy = 2 - 1, q = sqrt(3) = sigma_y: no flow yet.
// Rates (dt = 1/2): shear e_xy = 3: s_xy = 6, q = 6 sqrt(3); SIGY = sqrt(3), ETAN = 0, SRC = 8/sqrt(3), SRP =
// 3: at a rate of flow SRC, de = 4/sqrt(3), sigma_y = 2 sqrt(3), as q = 6 sqrt(3) - 3 de: s_xy = 2. SIGY = 1,
// SRP = 1, ETAN = 0, C dt = 1/2: 6 - 3 de = 1 + 2 de: de = 1, q = 3, with VP 0 and 1.
const RegisterStrength<MatPlasticKinematic> mat_plastic_kinematic{
    "s_tr = s + 2 G dev(D) dt; q = sqrt(3/2 xi:xi) <= (1 + (rate/SRC)^(1/SRP)) (SIGY + BETA Ep e), xi = s - "
    "alpha, Ep = E ETAN/(E - ETAN); return along xi_tr; dalpha = (1 - BETA) Ep de xi/q; pressure by Hooke's "
    "law",
    "J2 plasticity, radial return with kinematic hardening: Krieg & Key 1976; rates: Cowper & Symonds 1957",
    {{"1,2.0,2.5,0.25,3.0,0.5,1.0\n", {0.1, 0, 0, 0, 0, 0}, {1, 1, 1}, {1.3, 1.1, 1.1, 0, 0, 0}, {0}, {0}},
     {"1,2.0,2.5,0.25,3.0,0.5,1.0\n",
      {2, -1, -1, 0, 0, 0},
      {},
      {68.0 / 29, -34.0 / 29, -34.0 / 29, 0, 0, 0},
      {0},
      {24.0 / 29}},
     {"1,2.0,2.5,0.25,3.0,0.5,0.0\n",
      {2, -1, -1, 0, 0, 0},
      {5, 5, 5},
      {5 + 68.0 / 29, 5 - 34.0 / 29, 5 - 34.0 / 29, 0, 0, 0},
      {0, 0, 0, 0, 0, 0, 0},
      {24.0 / 29, 10.0 / 29, -5.0 / 29, -5.0 / 29, 0, 0, 0}},
     {"1,2.0,2.5,0.25,3.0,0.5,0.5\n",
      {2, -1, -1, 0, 0, 0},
      {},
      {68.0 / 29, -34.0 / 29, -34.0 / 29, 0, 0, 0},
      {0, 0, 0, 0, 0, 0, 0},
      {24.0 / 29, 5.0 / 29, -2.5 / 29, -2.5 / 29, 0, 0, 0}},
     {"1,2.0,2.5,0.25,1.7320508075688774,0.5,0.0\n",
      {0, 0, 0, 0.5, 0, 0},
      {0, 0, 0, 1, 0, 0},
      {0, 0, 0, 2, 0, 0},
      {0.5, 0, 0, 0, 1, 0, 0},
      {0.5, 0, 0, 0, 1, 0, 0}},
     {"1,2.0,2.5,0.25,1.7320508075688772,0.0,1.0\n4.6188021535170063,3.0\n",
      {0, 0, 0, 3, 0, 0},
      {},
      {0, 0, 0, 2, 0, 0},
      {0},
      {2.3094010767585034}},
     {"1,2.0,2.5,0.25,1.0,0.0,1.0\n1.0,1.0,0.0,0\n", {2, -1, -1}, {}, {2, -1, -1, 0, 0, 0}, {0}, {1}},
     {"1,2.0,2.5,0.25,1.0,0.0,1.0\n1.0,1.0,0.0,1\n", {2, -1, -1}, {}, {2, -1, -1, 0, 0, 0}, {0}, {1}}},
    mat_plastic_kinematic_table()};

}  // namespace

std::shared_ptr<StrengthLaw> linear_hardening_law(Real density, const LinearHardening& data) {
  return std::make_shared<PlasticKinematic>(density, data);
}

}  // namespace courant
