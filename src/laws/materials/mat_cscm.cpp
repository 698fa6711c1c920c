// Concrete by a surface of three invariants with a cap, damage and rates: *MAT_CSCM. Murray 2007
// (FHWA-HRT-05-062); I = -tr sigma, s = sqrt(J2) here.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <limits>

#include "keyword/expectations.hpp"
#include "laws/materials/mat_cscm.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/root_below.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

constexpr Real unbounded = std::numeric_limits<Real>::infinity();
constexpr Real root_of_3 = 1.7320508075688772;
constexpr Real most_damage = most_cscm_damage;

/// alpha - lambda e^(-beta I) + theta I: a strength [M/LT2], or the ratio of two [-].
struct Meridian {
  Real alpha = 0, theta = 0, lambda = 0, beta = 0;
  Real operator()(Real I) const { return alpha - lambda * std::exp(-beta * I) + theta * I; }
  Real slope(Real I) const { return lambda * beta * std::exp(-beta * I) + theta; }
};

/// ConcreteSoftening d = dmax/b ((1 + b)/(1 + b e^(-k z)) - 1) over z = tau - r0; its area is that of the
/// fracture energy.
struct ConcreteSoftening {
  Real b, dilogarithm;  ///< -Li2(-b) [-]
  explicit ConcreteSoftening(Real shape) : b(shape), dilogarithm(0) {
    // the integral of w/(1 - e^-w) from 0 to ln(1 + b), by Simpson's rule
    constexpr int pieces = 400;
    const Real width = std::log1p(b) / pieces;
    const auto at = [](Real w) { return w > 0 ? w / -std::expm1(-w) : Real(1); };
    for (int k = 0; k < pieces; ++k)
      dilogarithm += width / 6 * (at(k * width) + 4 * at((k + 0.5) * width) + at((k + 1) * width));
  }
  Real damage(Real z, Real k, Real most) const {
    return z > 0 && k > 0 ? most / b * ((1 + b) / (1 + b * std::exp(-k * z)) - 1) : 0;
  }
  /// Where tau = sqrt(E) strain: r0 L (1 + b)/(k b) ln(1 + b) = energy.
  Real brittle_rate(Real r0, Real length, Real energy) const {
    return r0 * length * (1 + b) / (b * energy) * std::log1p(b);
  }
  /// Where tau^2 = stress strain/2, at a steady stress: 4 L (1 + b)/b (r0 ln(1 + b)/k - Li2(-b)/k^2) =
  /// energy.
  Real ductile_rate(Real r0, Real length, Real energy) const {
    if (!(length > 0)) return 0;
    const Real half = 0.5 * r0 * std::log1p(b), area = energy * b / (4 * length * (1 + b));
    return (half + std::sqrt(half * half + dilogarithm * area)) / area;
  }
};

class Cscm : public StrengthLaw {
 public:
  explicit Cscm(const MatCscmFields& card)
      : c_(card),
        compression_{card.alpha, card.theta, card.lamda, card.beta},
        torsion_{card.alpha1, card.theta1, card.lamda1, card.beta1},
        extension_{card.alpha2, card.theta2, card.lamda2, card.beta2},
        brittle_(card.d),
        ductile_(card.b),
        E_(9 * card.k * card.g / (3 * card.k + card.g)) {
    ro = card.ro;
    if (!(compression_.lambda * compression_.beta > 0) && !(compression_.theta > 0)) return;
    Real low = 1;
    while (compression_(-low) > 0) low *= 2;
    apex_ = -root_below(low, [&](Real x) { return compression_(-x); });
  }
  Real bulk_modulus() const override { return c_.k; }
  Real shear_modulus() const override { return c_.g; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    return {{"compaction", "-"},     {"brittle_threshold", "M/LT2"},
            {"brittle_damage", "-"}, {"ductile_threshold", "M/LT2"},
            {"ductile_damage", "-"}, {"damage", "-"},
            {"failure_ratio", "-"},  {element_size, "L"},
            {"strain", "-", 6}};
  }
  std::string failure_variable() const override { return "failure_ratio"; }
  Real failure_limit() const override { return c_.erode >= 1 ? 1 : unbounded; }

  void update(const PointBlock& block) const override {
    const Real* damage = block.history[damage_now];
    for (Real* stress : block.stress)
      for (Index i = 0; i < block.count; ++i) stress[i] /= 1 - damage[i];
    for (std::size_t k = 0; k < 6; ++k)
      for (Index i = 0; i < block.count; ++i) block.history[strain + k][i] += block.dt * block.rate[k][i];
    PlasticTrial trial;
    go_elastically(c_.k - 2 * c_.g / 3, c_.g, block, FixedCentre{}, trial);
    for (Index i = 0; i < block.count; ++i) answer(block, i, trial.q[i] / root_of_3);
    keep_stiffness(block, sound_speed());
  }

 private:
  static constexpr Real eroded_damage = 0.99;
  enum Kept : std::size_t {
    compaction,
    brittle_threshold,
    brittle_damage,
    ductile_threshold,
    ductile_damage,
    damage_now,
    failed,
    size,
    strain
  };

  /// Where the cap meets the shear surface, and the axis. [M/LT2]
  struct Cap {
    Real kappa, X;
  };
  /// After this plastic compaction: c = W (1 - exp(-D1 (X - X0) - D2 (X - X0)^2)), X = kappa + R F(kappa).
  Cap cap_of(Real c) const {
    if (!(c < c_.w)) return {unbounded, unbounded};
    const Real L = -std::log1p(-c / c_.w);
    const Real X = c_.xd + (L > 0 ? 2 * L / (c_.d1 + std::sqrt(c_.d1 * c_.d1 + 4 * c_.d2 * L)) : 0);
    Real kappa = std::max(X - c_.r * compression_(X), apex_);
    constexpr int most_rounds = 60;
    for (int k = 0; k < most_rounds; ++k) {  // rises to the root
      const Real step = (X - kappa - c_.r * compression_(kappa)) / (1 + c_.r * compression_.slope(kappa));
      if (!(step > 1e-15 * std::abs(X))) break;
      kappa += step;
    }
    return {kappa, X};
  }

  /// Rubin 1991: the strength at a Lode angle over that in triaxial compression, where sin 3 beta is 1; under
  /// high pressure the surface is round. [-]
  Real ratio(Real I, Real sin3) const {
    const Real Q1 = I < 0 ? 1 / root_of_3 : std::min(torsion_(I), Real(1));
    const Real Q2 = I < 0 ? 0.5 : std::min(extension_(I), Real(1));
    const Real a1 = root_of_3 * Q2 + 2 * Q1 * (Q2 - 1), a0 = 2 * Q1 * Q1 * (Q2 - 1);
    const Real a = (-a1 + std::sqrt(a1 * a1 - 4 * Q2 * a0)) / (2 * Q2), b = (2 * Q1 + a) * (2 * Q1 + a) - 3;
    const Real angle = std::asin(std::clamp(sin3, Real(-1), Real(1))) / 3;
    const Real sine = std::sin(angle), along = std::cos(angle) - a * sine;
    const Real b0 = -(3 + b - a * a) / 4, b1 = a * along, b2 = along * along + b * sine * sine;
    return -2 * b0 / (b1 + std::sqrt(b1 * b1 - 4 * b2 * b0));
  }

  /// The state on the surface. `sheared`: not on the part of the cap that compacts.
  struct Returned {
    Real I, s, compaction;
    bool flows = false, sheared = false;
  };
  /// Flow along the normal in the plane of I and s, with the Lode angle and the ratio as they are: I = I_tr +
  /// 9 K x r F', s = s_tr - G x.
  Returned return_to_surface(Real I, Real s, Real sin3, Real compacted) const {
    Returned out{I, s, compacted};
    const Cap cap = cap_of(compacted);
    const Real w = std::max((I - cap.kappa) / (cap.X - cap.kappa), Real(0)), left = 1 - w * w;
    if (I > apex_ && left > 0) {
      const Real F = compression_(I) * std::sqrt(left);
      if (s <= (I < 0 ? 0.5 : std::min(extension_(I), Real(1))) * F || s <= ratio(I, sin3) * F) return out;
    }
    out.flows = true;
    const bool dilates =
        left > 0 && compression_.slope(I) * left - compression_(I) * w / (cap.X - cap.kappa) >= 0;
    if (dilates)
      dilate(cap, sin3, out);
    else
      compact(cap, sin3, out);
    return out;
  }
  void dilate(const Cap& cap, Real sin3, Returned& out) const {
    out.sheared = true;
    const Real from = std::max(out.I, apex_), I = out.I, s = out.s;
    const auto excess = [&](Real x) {
      const Real at = from + x, w = std::max((at - cap.kappa) / (cap.X - cap.kappa), Real(0));
      const Real left = std::max(1 - w * w, Real(0)), root = std::sqrt(left), F = compression_(at);
      const Real r = ratio(at, sin3), slope = compression_.slope(at) * left - F * w / (cap.X - cap.kappa);
      return (s - r * F * root) * 9 * c_.k * r * slope - c_.g * (at - I) * root;
    };
    if (!(excess(0) > 0)) {
      if (I < apex_)
        out.I = apex_, out.s = 0;  // no cohesion is left
      else
        out.s = ratio(I, sin3) * compression_(I);
      return;
    }
    const Real to_cap = cap.kappa - from;
    const Real most = to_cap > 0 && !(excess(to_cap) > 0) ? to_cap : cap.X - from;
    out.I = from + root_below(most, excess);
    const Real w = std::max((out.I - cap.kappa) / (cap.X - cap.kappa), Real(0));
    out.s = ratio(out.I, sin3) * compression_(out.I) * std::sqrt(std::max(1 - w * w, Real(0)));
  }
  void compact(const Cap& cap, Real sin3, Returned& out) const {
    const Real I = out.I, s = out.s, compacted = out.compaction, from = cap.kappa;
    Real strength = 0;
    const auto excess = [&](Real x) {
      const Real at = from + x, back = c_.g * (I - at);
      const Cap now = cap_of(compacted + (I - at) / (3 * c_.k));
      const Real length = now.X - now.kappa;
      if (at <= now.kappa || !(length < unbounded)) return strength = s, back;
      const Real w = (at - now.kappa) / length;
      if (w >= 1) return strength = 0, c_.g * (now.X - at);
      const Real left = 1 - w * w, root = std::sqrt(left), F = compression_(at), r = ratio(at, sin3);
      const Real slope = compression_.slope(at) * left - F * w / length;
      strength = r * F * root;
      if (slope >= 0 || strength >= s) return back * root;
      return (s - strength) * 9 * c_.k * r * slope + back * root;
    };
    out.I = from + root_below(I - from, excess);
    excess(out.I - from);
    out.s = std::min(strength, s);
    constexpr Real round_off = 1e-15;  // the root is below W
    out.compaction = std::min(compacted + (I - out.I) / (3 * c_.k), c_.w * (1 - round_off));
  }

  /// What a rate does to a point: overstress E rate eta and the share of the step's flow that happens.
  struct Viscosity {
    Real overstress = 0, share = 1;
  };
  /// `x`: I/sqrt(3 J2) of the trial state.
  Viscosity viscosity_at(const PointBlock& block, Index i, Real x) const {
    // of the deviator; where nearly all changes the volume alone, of that, else the cap would never flow
    const Real volumetric = std::abs(block.rate[0][i] + block.rate[1][i] + block.rate[2][i]);
    const Real rate =
        c_.irate != 0 ? std::max(effective_rate(block, i, true), std::sqrt(2.0) / 3 * volumetric) : 0;
    if (!(rate > 0) || !(block.dt > 0)) return {};
    const Real tension = c_.eta0t * std::pow(rate, -c_.nt), shear = c_.srate * tension;
    const Real axial = x < 0 ? tension : c_.eta0c * std::pow(rate, -c_.nc), t = transition(x);
    const Real most = x < 0 ? c_.overt : c_.overt + t * (c_.overc - c_.overt);
    Real eta = shear + t * (axial - shear);
    if (most > 0) eta = std::min(eta, most / (E_ * rate));
    return {E_ * rate * eta, block.dt / (eta + block.dt)};
  }
  /// From pure shear, 0, to one axis, 1.
  Real transition(Real x) const {
    return std::pow(std::min(std::abs(x), Real(1)), x < 0 ? c_.pwrt : c_.pwrc);
  }

  void answer(const PointBlock& block, Index i, Real s) const {
    const auto& stress = block.stress;
    const Real mean = (stress[0][i] + stress[1][i] + stress[2][i]) / 3, I = -3 * mean;
    const Real a = stress[0][i] - mean, b = stress[1][i] - mean, c = stress[2][i] - mean, d = stress[3][i],
               e = stress[4][i], f = stress[5][i];
    const Real J3 = a * (b * c - e * e) - d * (d * c - e * f) + f * (d * e - b * f);
    const Real sin3 = s > 0 ? -1.5 * root_of_3 * J3 / (s * s * s) : 0;
    const Returned on = return_to_surface(I, s, sin3, block.history[compaction][i]);
    const Real scale = s > 0 ? on.s / s : 1,
               x = s > 0 ? I / (root_of_3 * s) : (I < 0 ? -unbounded : unbounded);
    const Viscosity v = on.flows ? viscosity_at(block, i, x) : Viscosity{};
    block.history[compaction][i] += v.share * (on.compaction - block.history[compaction][i]);
    const Real now_I = I + v.share * (on.I - I), factor = 1 + v.share * (scale - 1);
    const Real dev[6] = {a, b, c, d, e, f};
    const Real left = 1 - damage(block, i, on, dev, scale, now_I, v.overstress);
    for (std::size_t k = 0; k < 6; ++k) stress[k][i] = left * (factor * dev[k] - (k < 3 ? now_I / 3 : 0));
  }

  /// Damage after the step. `dev`: of the trial stress; `scale`: what the surface without rates leaves of it.
  Real damage(const PointBlock& block, Index i, const Returned& on, const Real* dev, Real scale, Real I,
              Real overstress) const {
    const auto& h = block.history;
    Real &brittle = h[brittle_damage][i], &ductile = h[ductile_damage][i];
    brittle = std::max(brittle, c_.pred), ductile = std::max(ductile, c_.pred);
    const bool tension = I < 0;
    const std::size_t of = tension ? brittle_threshold : ductile_threshold;
    Real longest = 0;
    if ((on.flows && on.sheared) || h[of][i] > 0) {
      const Real tau = tension ? std::sqrt(E_) * std::max(longest = largest_strain(block, i), Real(0))
                               : energy_norm(block, i, dev, scale, on.I);
      if (h[of][i] == 0) h[of][i] = tau + overstress / std::sqrt(E_);
      soften(block, i, tension, tau - h[of][i], on, overstress);
    }
    const Real volume = h[strain][i] + h[strain + 1][i] + h[strain + 2][i];
    const bool by_volume = c_.recov >= 10;
    const bool recovers = I > 0 && (!by_volume || volume < 0);
    const Real kept = recovers ? c_.recov - (by_volume ? 10 : 0) : 1;
    const Real now = std::min(std::max(ductile, kept * brittle), most_damage);
    h[damage_now][i] = now;
    if (c_.erode >= 1 && now > eroded_damage && (tension ? longest : largest_strain(block, i)) > c_.erode - 1)
      h[failed][i] = 1;
    return now;
  }
  void soften(const PointBlock& block, Index i, bool tension, Real z, const Returned& on,
              Real overstress) const {
    const auto& h = block.history;
    const Real r0 = h[tension ? brittle_threshold : ductile_threshold][i], s = on.s;
    const Real x = s > 0 ? on.I / (root_of_3 * s) : (on.I < 0 ? -unbounded : unbounded), t = transition(x);
    const Real strength = r0 * std::sqrt(tension ? E_ : 2 * E_);
    const Real faster = overstress > 0 && strength > 0 ? std::pow(1 + overstress / strength, c_.repow) : 1;
    const Real energy = faster * (c_.gfs + t * ((tension ? c_.gft : c_.gfc) - c_.gfs));
    if (tension) {
      const Real rate = brittle_.brittle_rate(r0, h[size][i], energy);
      h[brittle_damage][i] = std::max(h[brittle_damage][i], brittle_.damage(z, rate, most_damage));
      return;
    }
    const Real most = x > 1 ? std::min(std::pow(x, -1.5), most_damage) : most_damage;
    const Real rate = ductile_.ductile_rate(r0, h[size][i], energy) * std::pow(most + 1e-3, c_.pmod);
    h[ductile_damage][i] = std::max(h[ductile_damage][i], ductile_.damage(z, rate, most));
  }
  /// Principal, of the logarithmic strain. [-]
  Real largest_strain(const PointBlock& block, Index i) const {
    const auto at = [&](std::size_t k) { return block.history[strain + k][i]; };
    Matrix m;
    m << at(0), at(3), at(5), at(3), at(1), at(4), at(5), at(4), at(2);
    return Eigen::SelfAdjointEigenSolver<Matrix>(m, Eigen::EigenvaluesOnly).eigenvalues()[2];
  }
  /// sqrt(sigma:strain/2) of the stress without rates.
  Real energy_norm(const PointBlock& block, Index i, const Real* dev, Real scale, Real I) const {
    Real work = 0;
    for (std::size_t k = 0; k < 6; ++k)
      work += (k < 3 ? 1 : 2) * (scale * dev[k] - (k < 3 ? I / 3 : 0)) * block.history[strain + k][i];
    return std::sqrt(std::max(0.5 * work, Real(0)));
  }

  MatCscmFields c_;
  Meridian compression_, torsion_, extension_;
  ConcreteSoftening brittle_, ductile_;
  Real E_;                  ///< [M/LT2]
  Real apex_ = -unbounded;  ///< I at which the shear surface ends [M/LT2]
};

struct MatCscm : MatCscmFields {
  std::shared_ptr<StrengthLaw> law() const { return std::make_shared<Cscm>(*this); }
  void check(const Deck& deck, Diagnostics& diagnostics) const;
};

void MatCscm::check(const Deck& deck, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  check_cscm_state(*this, expect);
  expect(nh == 0 || nh == 1, "NH", "0 or 1", nh, "hardening before the failure surface is not supported");
  expect(alpha > lamda, "ALPHA", "a number above LAMDA", alpha, "without pressure concrete has a strength");
  expect(alpha1 > lamda1, "ALPHA1", "a number above LAMDA1", alpha1,
         "the ratio of strengths in torsion; 1 for a round surface");
  expect(alpha2 > lamda2, "ALPHA2", "a number above LAMDA2", alpha2,
         "the ratio of strengths in extension; 1 for a round surface");
  expect(d1 > 0 || d2 > 0, "D1", "a number > 0", d1, "the cap moves by D1 and D2");
  expect(gfs > 0, "GFS", "a number > 0", gfs, "fracture energy in shear");
  expect(irate == 0 || (eta0t > 0 && eta0c > 0), "ETA0T", "a number > 0", eta0t,
         "with IRATE 1 ETA0C and ETA0T are the viscosities");
}

// By hand. K = 5/3, G = 1; a round surface (ratios 1), the cap far away. Pulled by dev e = (2, -1, -1) under
// I = 9: s = 2 root_of_3. LAMDA = THETA = 0, ALPHA = root_of_3: half of it is left, I stays. THETA = 0.2: I =
// 9 + 3 x, s = 2 root_of_3 - x = ALPHA + 0.2 I, with x = root_of_3/2: ALPHA = 1.2 root_of_3 - 1.8, s = 3/2
// root_of_3, I = 9 + 3/2 root_of_3. Squeezed by 0.6 in each direction: I = 9. X0 = 6, R = 0.1 and ALPHA = 10:
// L = 5. D1 = 1/3 and D2 = 0, W = 1: at X = 7 the compaction is 1 - exp(-1/3), so that I falls from 7 + 5 (1
// - exp(-1/3)) to 7: e = I/15.
constexpr Real compaction_at_7 = 0.28346868942621073;
const std::string round_cone =
    "1.0,0.0,0.0,0.0,1.0\n5.0,1000.0,0.5,1e-4,1e-8\n100.0,1.0,0.1,1.0,1.0,5.0,1.0\n\n";
const RegisterStrength<MatCscm> mat_cscm{
    "s <= R(I, beta) (ALPHA - LAMDA exp(-BETA I) + THETA I) sqrt(1 - max(I - L, 0)^2/(X - L)^2), I = -tr "
    "sigma, s = "
    "sqrt(J2); flow along the normal in I and s; compaction W (1 - exp(-D1 (X - XD) - D2 (X - XD)^2)); "
    "stress (1 - d) "
    "(trial + (dt/(eta + dt)) (surface - trial)); d brittle over sqrt(E) e1 under tension, ductile over "
    "sqrt(sigma:e/2) "
    "under pressure, by GFT, GFS, GFC over the element's size",
    "Murray 2007, FHWA-HRT-05-062; Rubin 1991; Simo, Kennedy & Govindjee 1988",
    {{"1,2.0\n0.0\n1.0,1.6666666666666667,1.7320508075688772,0.0,0.0,0.0\n1.0,0.0,0.0,0.0," + round_cone,
      {1.8, -1.2, -1.2},
      {-2, -2, -2},
      {-1, -4, -4},
      {},
      {0}},
     {"1,2.0\n0.0\n1.0,1.6666666666666667,0.27846096908265279,0.2,0.0,0.0\n1.0,0.0,0.0,0.0," + round_cone,
      {1.8, -1.2, -1.2},
      {-2, -2, -2},
      {-root_of_3 / 2, -4.5 - root_of_3 / 2, -4.5 - root_of_3 / 2},
      {},
      {0}},
     {"1,2.0\n0.0\n1.0,1.6666666666666667,10.0,0.0,0.0,0.0\n1.0,0.0,0.0,0.0,1.0\n0.1,6.0,1.0,0."
      "33333333333333333\n"
      "100.0,1.0,0.1,1.0,1.0,5.0,1.0\n\n",
      {-(7 + 5 * compaction_at_7) / 15, -(7 + 5 * compaction_at_7) / 15, -(7 + 5 * compaction_at_7) / 15},
      {},
      {-7.0 / 3, -7.0 / 3, -7.0 / 3},
      {},
      {compaction_at_7}}},
    mat_cscm_table()};

}  // namespace

std::shared_ptr<StrengthLaw> make_cscm(const MatCscmFields& card) {
  return std::make_shared<Cscm>(card);
}

/// Viscosities are times to a power of the card.
std::string convert_viscosities(MatCscmFields& card, const Conversion& conversion) {
  const Real time = conversion.units.of("T");
  card.eta0c *= std::pow(time, 1 - card.nc), card.eta0t *= std::pow(time, 1 - card.nt);
  return "";
}

}  // namespace courant
