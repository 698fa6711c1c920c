// Concrete with up to three cracks across each other, a surface of strength over all invariants, and
// compaction by a table: Broadhouse & Neilson 1987, Broadhouse 1995; Ottosen 1977. Pressures p are > 0 in
// compression.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Eigenvalues>
#include <optional>

#include "keyword/expectations.hpp"
#include "laws/eos/volume_table.hpp"
#include "laws/materials/concrete_cards.hpp"
#include "laws/materials/ottosen_surface.hpp"
#include "laws/strength/curves_over_rate.hpp"
#include "laws/strength/material_axes.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/root_below.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// Units of a deck in those of the SI; 0: not known. [kg], [m], [s] for each
struct UnitsOfDeck {
  Real mass = 0, length = 0, time = 0;
};

/// Stress of a crack over its opening: 1 at 0, straight to (knee, level), from there to (end, 0). [L], [-]
struct CrackCurve {
  Real knee, level, end;
  Real operator()(Real opening) const {
    if (opening < knee) return 1 - (1 - level) * opening / knee;
    return opening < end ? level * (end - opening) / (end - knee) : 0;
  }
};

/// What a card amounts to.
struct WinfrithNumbers {
  Real ro, K, G, fc, ft;  ///< [M/L3], [M/LT2]
  CrackCurve crack;
  Real interlock;    ///< opening at which a crack bears half of its shear stress [L]
  VolumeTable C;     ///< pressure of first loading over -ln V
  bool rates;        ///< strengths grow with the rate
  UnitsOfDeck unit;  ///< of stresses and rates, where `rates`
};

/// Strength over that at rest: CEB 1988, by the cube strength in MPa. Beyond 30/s it goes on with the third
/// root.
struct RateOfConcrete {
  explicit RateOfConcrete(Real MPa)
      : tension_(1.016 / (10 + 0.5 * MPa)), compression_(1.026 / (5 + 0.75 * MPa)) {}
  static constexpr Real still = 3e-6;  ///< rate below which there is none, in tension [1/s]
  Real tension(Real per_second) const { return factor(per_second, still, tension_); }
  Real compression(Real per_second) const { return factor(per_second, 30e-6, compression_); }

 private:
  static Real factor(Real rate, Real least, Real power) {
    constexpr Real fast = 30;
    if (!(rate > least)) return 1;
    return std::pow(std::min(rate, fast) / least, power) * std::cbrt(std::max(rate / fast, Real(1)));
  }
  Real tension_, compression_;
};

class WinfrithConcrete : public StrengthLaw {
 public:
  explicit WinfrithConcrete(WinfrithNumbers numbers)
      : c_(std::move(numbers)),
        at_rest_(c_.ft / c_.fc),
        of_rates_(c_.rates ? c_.fc * c_.unit.mass / (c_.unit.length * c_.unit.time * c_.unit.time) * 1e-6
                           : 0) {
    ro = c_.ro;
  }
  Real bulk_modulus() const override { return c_.K; }
  Real shear_modulus() const override { return c_.G; }
  bool in_sheets() const override { return false; }
  std::vector<HistoryVariable> history() const override {
    return {{"plastic_strain", "-"},       {"logarithmic_volume", "-"},
            {"compaction", "-"},           {"cracks", "-"},
            {"crack_strain_1", "-"},       {"crack_strain_2", "-"},
            {"crack_strain_3", "-"},       {"largest_crack_1", "-"},
            {"largest_crack_2", "-"},      {"largest_crack_3", "-"},
            {"crack_strength_1", "M/LT2"}, {"crack_strength_2", "M/LT2"},
            {"crack_strength_3", "M/LT2"}, {"mean_rate", "1/T"},
            {element_size, "L"},           {"crack_directions", "-", 6}};
  }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      Point at(block, i);
      if (block.dt > 0) advance(at);
      const Real stiff = std::max(c_.K, c_.C.slope(at.kept(compaction)));
      const Real dense = block.compression ? 1 + block.compression[i] : 1;
      block.sound_speed[i] = std::sqrt((stiff + 4 * c_.G / 3) / (ro * dense));
    }
  }

 private:
  enum Kept : std::size_t {
    plastic_strain,
    volume,
    compaction,
    cracks,
    strain,
    largest = strain + 3,
    strength = largest + 3,
    mean_rate = strength + 3,
    size,
    directions
  };

  struct Point {
    Point(const PointBlock& of, Index number) : block(of), i(number) {}
    const PointBlock& block;
    Index i;
    Real& kept(std::size_t what) const { return block.history[what][i]; }
    Real grown(std::size_t k) const { return block.dt * block.rate[k][i]; }
  };
  /// A point within a step: what is not kept of it.
  struct State {
    OttosenSurface surface;            ///< at the present rate
    Matrix s = Matrix::Zero();         ///< deviator with the present cracks [M/LT2]
    Real p = 0;                        ///< [M/LT2]
    Matrix axes = Matrix::Identity();  ///< of cracks, as columns
    Real most = 0, top = 0, back = 0;  ///< of compaction [-], [M/LT2]
    Real fc = 0, ft = 0;               ///< at the present rate [M/LT2]
    Real compacted = 0;                ///< -ln V without cracks [-]
  };

  Real pressure(const State& now, Real e) const {
    return e > now.most ? c_.C(e) : now.top + now.back * (e - now.most);
  }

  void advance(const Point& at) const {
    State now = trial(at);
    open_and_close(at, now);
    while (may_crack(now) && new_crack(at, now)) open_and_close(at, now);
    // flow changes the stress across cracks, which changes what flows
    constexpr int rounds = 40;
    slip_of_cracks(at, now);
    for (int round = 0; flow(at, now) && at.kept(cracks) > 0 && round < rounds; ++round)
      open_and_close(at, now), slip_of_cracks(at, now);
    for (std::size_t k = 0; k < 3; ++k)
      at.kept(largest + k) = std::max(at.kept(largest + k), at.kept(strain + k));
    Real& most = at.kept(compaction);
    most = std::max(most, now.compacted);
    const auto& s = at.block.stress;
    const Index i = at.i;
    s[0][i] = now.s(0, 0) - now.p, s[1][i] = now.s(1, 1) - now.p, s[2][i] = now.s(2, 2) - now.p;
    s[3][i] = now.s(0, 1), s[4][i] = now.s(1, 2), s[5][i] = now.s(0, 2);
  }

  /// The step without new strains of cracks.
  State trial(const Point& at) const {
    State now{.surface = at_rest_};
    const auto& t = at.block.stress;
    const Index i = at.i;
    const Real mean = (t[0][i] + t[1][i] + t[2][i]) / 3;
    const Real opens = at.grown(0) + at.grown(1) + at.grown(2);
    constexpr int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 6; ++k) {
      const Real now_s = t[static_cast<std::size_t>(k)][i] - (k < 3 ? mean : 0) +
                         2 * c_.G * (at.grown(static_cast<std::size_t>(k)) - (k < 3 ? opens / 3 : 0));
      now.s(row[k], column[k]) = now.s(column[k], row[k]) = now_s;
    }
    at.kept(volume) += opens;
    now.most = at.kept(compaction), now.top = c_.C(now.most);
    now.back = std::max(c_.K, c_.C.slope(now.most));
    now.compacted = -at.kept(volume);
    for (std::size_t k = 0; k < 3; ++k) now.compacted += at.kept(strain + k);
    now.p = pressure(now, now.compacted);
    now.fc = c_.fc, now.ft = c_.ft;
    if (c_.rates) {
      Real& rate = at.kept(mean_rate);
      rate += weight_of_step * (effective_rate(at.block, i, true) - rate);
      const Real per_second = rate / c_.unit.time;
      now.fc *= of_rates_.compression(per_second), now.ft *= of_rates_.tension(per_second);
      if (per_second > RateOfConcrete::still) now.surface = OttosenSurface(now.ft / now.fc);
    }
    if (at.kept(cracks) > 0) {
      std::array<Real, 6> tensor;
      for (std::size_t k = 0; k < 6; ++k) tensor[k] = at.kept(directions + k);
      now.axes = directions_of_tensor(tensor);
    }
    return now;
  }

  Real stress_across(const State& now, int k) const {
    const Vec n = now.axes.col(k);
    return n.dot(now.s * n) - now.p;
  }
  /// Adds `by` to the strain of crack k.
  void open(const Point& at, State& now, int k, Real by) const {
    const Vec n = now.axes.col(k);
    now.s -= 2 * c_.G * by * (n * n.transpose() - Matrix::Identity() / 3);
    now.compacted += by, now.p = pressure(now, now.compacted);
    at.kept(strain + static_cast<std::size_t>(k)) += by;
  }
  /// What crack k bears when its strain is e. Below the largest so far the line to the origin. [M/LT2]
  Real borne(const Point& at, std::size_t k, Real e) const {
    const Real most = at.kept(largest + k), f = at.kept(strength + k);
    if (most > 0 && e < most) return f * c_.crack(most * at.kept(size)) * e / most;
    return f * c_.crack(e * at.kept(size));
  }
  /// Strains of cracks such that each bears its stress, one after another until none changes.
  void open_and_close(const Point& at, State& now) const {
    constexpr int rounds = 60;
    constexpr Real close = 1e-11;
    const int count = static_cast<int>(at.kept(cracks));
    Real whole = 0;
    for (int round = 0; round < rounds && count > 0; ++round) {
      Real change = 0;
      for (int k = 0; k < count; ++k) change = std::max(change, std::abs(open_or_close(at, now, k)));
      whole = std::max(whole, change);
      if (count == 1 || change <= close * whole) break;
    }
  }
  /// Of crack k alone. Returns by how much its strain changes.
  Real open_or_close(const Point& at, State& now, int k) const {
    const auto number = static_cast<std::size_t>(k);
    const Real old = at.kept(strain + number);
    const Real s = stress_across(now, k) + now.p + 4 * c_.G / 3 * old;  // deviator with the crack closed
    const Real e0 = now.compacted - old;
    const auto excess = [&](Real e) {
      return s - 4 * c_.G / 3 * e - pressure(now, e0 + e) - borne(at, number, e);
    };
    const Real closed = s - pressure(now, e0);
    Real e = 0;
    if (excess(0) > 0) e = root_below(3 * closed / (4 * c_.G), excess);
    open(at, now, k, e - old);
    return e - old;
  }

  /// A bound of the largest principal stress is above the least strength.
  static bool may_crack(const State& now) {
    return std::sqrt(Real(2) / 3) * now.s.norm() - now.p > residual * now.ft;
  }

  /// Across the largest principal stress, where that is above the strength; with cracks, in the directions
  /// that they leave. Strength falls with compression across: LS-DYNA's TENPWR 1, TENRSD 0.01.
  bool new_crack(const Point& at, State& now) const {
    const int count = static_cast<int>(at.kept(cracks));
    if (count > 2) return false;
    const Matrix stress = now.s - now.p * Matrix::Identity();
    const Eigen::SelfAdjointEigenSolver<Matrix> principal(stress);
    const Real least = principal.eigenvalues()[0];
    const Real f = now.ft * std::max(1 - std::max(-least, Real(0)) / now.fc, residual);
    Matrix axes = now.axes;
    if (count == 0) {
      axes.col(0) = principal.eigenvectors().col(2), axes.col(1) = principal.eigenvectors().col(1);
    } else if (count == 1) {
      const Vec b = axes.col(1), c = axes.col(2);
      const Real angle = 0.5 * std::atan2(2 * b.dot(stress * c), b.dot(stress * b) - c.dot(stress * c));
      axes.col(1) = std::cos(angle) * b + std::sin(angle) * c;
    }
    axes.col(2) = axes.col(0).cross(axes.col(1));
    const Vec n = axes.col(count);
    if (!(n.dot(stress * n) > f)) return false;
    now.axes = axes;
    at.kept(strength + static_cast<std::size_t>(count)) = f;
    at.kept(cracks) = count + 1;
    const std::array<Real, 6> tensor = direction_tensor(axes);
    for (std::size_t k = 0; k < 6; ++k) at.kept(directions + k) = tensor[k];
    return true;
  }

  /// Shear stress on a crack is limited by the interlock of its faces, and by friction where it is closed.
  void slip_of_cracks(const Point& at, State& now) const {
    const int count = static_cast<int>(at.kept(cracks));
    if (count == 0) return;
    Matrix s = now.axes.transpose() * now.s * now.axes;
    for (int k = 0; k < count; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const Real shear = std::hypot(s(k, a), s(k, b));
      const Real opening = at.kept(strain + static_cast<std::size_t>(k)) * at.kept(size);
      const Real limit =
          largest_shear * c_.ft / (1 + opening / c_.interlock) + std::max(now.p - s(k, k), Real(0));
      if (!(shear > limit)) continue;
      for (const int other : {a, b}) s(k, other) *= limit / shear, s(other, k) = s(k, other);
    }
    now.s = now.axes * s * now.axes.transpose();
  }

  /// The deviator returns to the surface of its pressure and Lode angle. Whether it was outside.
  bool flow(const Point& at, State& now) const {
    now.p = std::max(now.p, -now.surface.tip() * now.fc / 3);
    const Real J2 = 0.5 * now.s.squaredNorm();
    if (!(J2 > 0)) return false;
    const Real root = std::sqrt(J2), cosine = 1.5 * std::sqrt(Real(3)) * now.s.determinant() / (J2 * root);
    const Real limit = now.fc * now.surface.root_j2(-3 * now.p / now.fc, cosine);
    if (!(root > limit)) return false;
    at.kept(plastic_strain) += (root - limit) / (std::sqrt(Real(3)) * c_.G);
    now.s *= limit / root;
    constexpr Real close = 1e-5;  // what is left flows in the next step
    return root > (1 + close) * limit;
  }

  static constexpr Real residual = 0.01;        ///< of the tensile strength beside compression of fc
  static constexpr Real largest_shear = 1.161;  ///< of a crack that is closed, over ft
  WinfrithNumbers c_;
  OttosenSurface at_rest_;
  RateOfConcrete of_rates_;
};

struct MatWinfrithConcrete : MatWinfrithConcreteFields {
  UnitsOfDeck units() const {
    if (made_of_flag) return *made_of_flag;
    if (conm == -1) return {175.126835, 0.0254, 1};
    if (conm == -2) return {1e-3, 1e-2, 1e-6};
    if (conm == -3) return {1e-3, 1e-3, 1e-3};
    if (conm == -4) return {1e3, 1e-3, 1};
    if (conm == -5) return {1, 1e-3, 1e-3};
    return {conm, conl, cont};
  }
  bool has_units() const { return conm < 0 || (conm > 0 && conl > 0 && cont > 0); }
  /// Young's modulus over 3 (1 - 2 PR).
  Real bulk() const { return tm / (3 * (1 - 2 * pr)); }
  bool gives_compaction() const;
  VolumeTable compaction() const;
  CrackCurve crack() const;
  Real interlock() const;
  std::shared_ptr<StrengthLaw> law() const;
  void check(const Deck& deck, Diagnostics& diagnostics) const;
  void check_compaction(const Deck& deck, Diagnostics& diagnostics) const;
  std::array<Real, 8> strains() const { return {eps1, eps2, eps3, eps4, eps5, eps6, eps7, eps8}; }
  std::array<Real, 8> pressures() const { return {p1, p2, p3, p4, p5, p6, p7, p8}; }

  std::optional<UnitsOfDeck> made_of_flag{};  ///< CONM < 0 in a file that was converted
};

bool MatWinfrithConcrete::gives_compaction() const {
  const auto e = strains(), p = pressures();
  const auto given = [](Real x) { return x != 0; };
  return std::any_of(e.begin(), e.end(), given) || std::any_of(p.begin(), p.end(), given);
}

/// By the points of the card, or by the strength: p1 = UCS/3 at p1/K, and multiples of it.
VolumeTable MatWinfrithConcrete::compaction() const {
  std::vector<Real> e{0}, p{0};
  if (gives_compaction()) {
    for (std::size_t k = 0; k < 8 && (strains()[k] != 0 || pressures()[k] != 0); ++k)
      e.push_back(-strains()[k]), p.push_back(pressures()[k]);
    return {std::move(e), std::move(p)};
  }
  constexpr Real strain[] = {0, 0.002, 0.004, 0.010, 0.020, 0.030, 0.041, 0.051, 0.062, 0.094};
  constexpr Real over_p1[] = {1, 1.5, 3, 4.8, 6, 7.5, 9.45, 11.55, 14.25, 25.05};
  const Real first = ucs / 3;
  for (std::size_t k = 0; k < std::size(strain); ++k)
    e.push_back(k == 0 ? first / bulk() : strain[k]), p.push_back(over_p1[k] * first);
  return {std::move(e), std::move(p)};
}

/// RATE 0: Wittmann's two lines, through a quarter of UTS, whose area is the fracture energy FE. Otherwise
/// one line to the opening FE.
CrackCurve MatWinfrithConcrete::crack() const {
  if (rate != 0) return {fe, 0, fe};
  return {0.75 * fe / uts, 0.25, 5 * fe / uts};
}

/// Vecchio & Collins 1986: 0.31 + 24 w/(d + 16 mm), d the diameter of the aggregate.
Real MatWinfrithConcrete::interlock() const {
  const Real mm = has_units() ? 1e-3 / units().length : 0;
  const Real diameter = rate == 2 ? asize / units().length : 2 * asize;
  return 0.31 / 24 * (diameter + 16 * mm);
}

std::shared_ptr<StrengthLaw> MatWinfrithConcrete::law() const {
  return std::make_shared<WinfrithConcrete>(WinfrithNumbers{.ro = ro,
                                                            .K = bulk(),
                                                            .G = tm / (2 * (1 + pr)),
                                                            .fc = ucs,
                                                            .ft = uts,
                                                            .crack = crack(),
                                                            .interlock = interlock(),
                                                            .C = compaction(),
                                                            .rates = rate == 0,
                                                            .unit = units()});
}

void MatWinfrithConcrete::check(const Deck& deck, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  expect(pr < 0.5, "PR", "a number below 0.5", pr, "the bulk modulus follows from it");
  expect(uts <= 0.2 * ucs && uts >= 0.05 * ucs, "UTS", "0.05 to 0.2 of UCS", uts,
         "Ottosen's surface is made for such ratios of tensile and compressive strength");
  expect(rate == 0 || rate == 1 || rate == 2, "RATE", "0, 1 or 2", rate,
         "8 adds curves, dilation and more of its own, which are not supported");
  const bool known =
      conm == 0 || conm == -1 || conm == -2 || conm == -3 || conm == -4 || conm == -5 || conm > 0;
  expect(known, "CONM", "a factor, or -1 to -5", conm, "mass in kg; or a flag of a system of units");
  if (conm > 0) {
    expect(conl > 0, "CONL", "a number > 0", conl, "CONM > 0: the unit of length in metres");
    expect(cont > 0, "CONT", "a number > 0", cont, "CONM > 0: the unit of time in seconds");
  }
  if (rate != 1)
    expect(conm != 0, "CONM", "the system of units", conm,
           "rates of strain, strengths in MPa (RATE 0) and aggregates in metres (RATE 2) need it");
  if (rate == 1 && conm == 0)
    deck.warning(diagnostics, *this, "CONM", "the unit of length is not known",
                 "shear across cracks counts by ASIZE alone, without the 16 mm of its formula; give CONM");
  if (rate == 0)
    deck.warning(diagnostics, *this, "RATE", "rates raise the strengths; Young's modulus stays as it is",
                 "LS-DYNA raises it, too, by about a third at 100/s, and does not conserve energy then");
  check_compaction(deck, diagnostics);
}

void MatWinfrithConcrete::check_compaction(const Deck& deck, Diagnostics& diagnostics) const {
  const auto fail = [&](const char* field, const std::string& what, const char* hint) {
    deck.error(diagnostics, *this, field, what, hint);
  };
  if (!gives_compaction()) {
    if (!(ucs / 3 / bulk() < 0.002))
      fail("UCS",
           fmt::format("a third of it over the bulk modulus is {:.4g}: no generated compaction",
                       ucs / 3 / bulk()),
           "that must be below 0.002, where the generated curve goes on; give EPS1 to P8");
    return;
  }
  const auto e = strains(), p = pressures();
  std::size_t count = 0;
  while (count < 8 && (e[count] != 0 || p[count] != 0)) ++count;
  for (std::size_t k = count; k < 8; ++k)
    if (e[k] != 0 || p[k] != 0)
      return fail("EPS1", "there are blank points between others", "points follow each other");
  if (count < 2) return fail("EPS1", "one point is no curve", "give two or more, without that of no strain");
  for (std::size_t k = 0; k < count; ++k)
    if (!(-e[k] > (k > 0 ? -e[k - 1] : 0)) || !(p[k] > (k > 0 ? p[k - 1] : 0)))
      return fail(
          "EPS1",
          fmt::format(
              "expected strains < 0 that fall and pressures > 0 that rise, got ({:g}, {:g}) at point {}",
              e[k], p[k], k + 1),
          "ln V is below 0 in compression; no point at 0 is given");
}

// By hand. TM = 9, PR = 1/8: K = 4, G = 4. Strengths far above: (K + 4 G/3) e, (K - 2 G/3) e. Pressed evenly
// through (0.05, 0.2) to 0.1: 0.2 + 2 0.05 = 0.3, and from there back by K. Torn by 0.15 with UTS = 1, FE =
// 1/4 and a size of 1, sides held: (K + 4 G/3) (0.15 - e) = 1 - 4 e, K + 4 G/3 = 28/3: 0.4 = 16/3 e; sides (K
// - 2 G/3) 0.075.
const std::string winfrith_points = "0,0,0,0,1.0,-4\n-0.05,-0.15\n0.2,0.4\n";
const std::string winfrith_9 = "1,2.0,9.0,0.125,1000.0,100.0,0.25,0.01\n" + winfrith_points;
const std::string winfrith_1 = "1,2.0,9.0,0.125,10.0,1.0,0.25,0.01\n" + winfrith_points;
const std::vector<Real> unit_size{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
const RegisterStrength<MatWinfrithConcrete> mat_winfrith_concrete{
    "a J2/fc^2 + lambda(theta) sqrt(J2)/fc + b I1/fc <= 1; cracks across principal stresses above UTS (1 - "
    "c/UCS), whose "
    "stress falls over the opening by FE; p by a table over -ln V + strains of cracks",
    "Broadhouse & Neilson 1987; Ottosen 1977; Wittmann, Rokugo, Bruehwiler, Mihashi & Simonin 1988; CEB "
    "1988; Vecchio & "
    "Collins 1986",
    {{winfrith_9, {0.3, 0, 0}, {}, {2.8, 0.4, 0.4}},
     {winfrith_9, {-0.1 / 3, -0.1 / 3, -0.1 / 3}, {}, {-0.3, -0.3, -0.3}, {}, {0, -0.1, 0.1}},
     {winfrith_9, {0.01, 0.01, 0.01}, {-0.3, -0.3, -0.3}, {-0.18, -0.18, -0.18}, {0, -0.1, 0.1}},
     {winfrith_1, {0.15}, {}, {0.7, 0.1, 0.1}, unit_size, {0, 0.15, 0, 1, 0.075, 0, 0, 0.075}}},
    mat_winfrith_concrete_table()};

}  // namespace

/// Flags of units no longer hold, and factors of units change.
std::string convert_units_of_concrete(MatWinfrithConcreteFields& fields, const Conversion& conversion) {
  auto& card = static_cast<MatWinfrithConcrete&>(fields);
  UnitsOfDeck unit = card.units();
  const Real fe_factor = conversion.units.of(card.rate == 0 ? "M/T2" : "L");
  card.fe *= fe_factor;
  if (card.rate != 2) card.asize *= conversion.units.of("L");
  unit.mass /= conversion.units.of("M"), unit.length /= conversion.units.of("L"),
      unit.time /= conversion.units.of("T");
  if (card.conm < 0)
    card.made_of_flag = unit;
  else
    card.conm = unit.mass, card.conl = unit.length, card.cont = unit.time;
  return "";
}

}  // namespace courant
