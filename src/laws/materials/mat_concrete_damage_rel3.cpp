// Concrete of Karagozian & Case, release 3: three strength surfaces, a damage function, compaction, rates.
// Malvar, Crawford, Wesevich & Simons 1997. Pressures are > 0 in compression, and q = sqrt(3 J2).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "keyword/expectations.hpp"
#include "laws/eos/volume_table.hpp"
#include "laws/materials/concrete_damage.hpp"
#include "laws/materials/strength_cards.hpp"
#include "laws/strength/radial_return.hpp"
#include "laws/strength/root_below.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

namespace {

/// What a card and the equation of state of its parts amount to.
struct ConcreteNumbers {
  Real ro, nu;
  ConcreteSurfaces surfaces;
  DamageFunction damage;
  Real b1, b2, b3, omega, edrop;
  Real width;                  ///< over which the damage function holds; 0: that of each element [L]
  VolumeTable C, K;            ///< as CompactionCurves [M/LT2]
  std::optional<Curve> rates;  ///< of the factor of the strength
};

class DamagedConcrete : public StrengthLaw {
 public:
  explicit DamagedConcrete(ConcreteNumbers numbers)
      : c_(std::move(numbers)),
        peak_(c_.damage.lambda[c_.damage.peak()]),
        shear_(1.5 * (1 - 2 * c_.nu) / (1 + c_.nu)) {
    ro = c_.ro;
  }
  Real bulk_modulus() const override { return std::max(c_.K.held(0), c_.C.slope(0)); }
  Real shear_modulus() const override { return shear_ * bulk_modulus(); }
  bool in_sheets() const override { return false; }
  bool takes_equation_of_state() const override { return true; }
  std::vector<HistoryVariable> history() const override {
    return {{"plastic_strain", "-"}, {"logarithmic_volume", "-"}, {"damage", "-"},  {"modified_strain", "-"},
            {"dilation", "-"},       {"compaction", "-"},         {"opening", "-"}, {element_size, "L"}};
  }

  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      Point at(block, i);
      if (block.dt > 0) advance(at);
      const Real stiff = std::max(c_.K.held(at.kept(compaction)), c_.C.slope(at.kept(compaction)));
      const Real dense = block.compression ? 1 + block.compression[i] : 1;
      block.sound_speed[i] = std::sqrt(stiff * (1 + 4 * shear_ / 3) / (ro * dense));
    }
  }

 private:
  enum Kept : std::size_t { plastic_strain, volume, damage, lambda, dilation, compaction, opening, size };

  struct Point {
    Point(const PointBlock& of, Index number) : block(of), i(number) {}
    const PointBlock& block;
    Index i;
    Real& kept(Kept what) const { return block.history[what][i]; }
    Real& stress(std::size_t k) const { return block.stress[k][i]; }
    Real strain(std::size_t k) const { return block.dt * block.rate[k][i]; }
  };

  /// Pressure over compaction, of which there was `most`. [M/LT2]
  struct Pressures {
    const VolumeTable& C;
    Real most, top, back;  ///< [-], [M/LT2]
    Real operator()(Real e) const { return e > most ? C(e) : top + back * (e - most); }
  };
  /// What the surface depends on besides p and lambda.
  struct State {
    Real rate;    ///< factor of the strength [-]
    Real cosine;  ///< of the Lode angle
    Real size;    ///< of the element [L]
  };

  /// lambda as the damage function knows it: behind the peak it counts by the size of the element, so that
  /// the work over an area of crack is that of the width.
  Real counted(Real modified, Real element) const {
    if (modified <= peak_ || !(c_.width > 0) || !(element > 0)) return modified;
    return peak_ + (modified - peak_) * element / c_.width;
  }
  /// The surface of a point, in triaxial compression.
  StrengthAt surface(Real p, Real modified, const State& of) const {
    const Real x = p / of.rate, now = counted(modified, of.size), eta = c_.damage(now);
    const StrengthAt above = c_.surfaces.greatest(x);
    const StrengthAt below = now <= peak_ ? c_.surfaces.first(x) : c_.surfaces.residual(x);
    return {std::max(of.rate * (eta * (above.q - below.q) + below.q), Real(0)),
            eta * (above.slope - below.slope) + below.slope};
  }
  Real lode(Real p, const State& of) const {
    return lode_factor(c_.surfaces.ratio(p / of.rate).q, of.cosine);
  }
  /// That of the rate of the deviator; in tension below no pressure, in compression from fc/3 on.
  Real factor_of_rate(const Point& at, Real p) const {
    if (!c_.rates) return 1;
    const Real rate = effective_rate(at.block, at.i, true);
    const Real share = std::clamp(3 * p / c_.surfaces.compression(), Real(0), Real(1));
    return (1 - share) * (*c_.rates)(-rate) + share * (*c_.rates)(rate);
  }
  /// Of shear, by a bulk modulus between those of loading, on the curve, and of unloading: Malvar and others
  /// 1997.
  Real shear_at(const Pressures& pressures, Real e) const {
    const Real gone = std::max(pressures.most - e, Real(0));
    const Real left = std::max(pressures(e) + c_.surfaces.tension(), Real(0)) / pressures.back;
    const Real phi = gone > 0 ? gone / (gone + left) : 0;
    constexpr Real fast = 5.55;
    const Real loading = c_.C.slope(pressures.most);
    return shear_ * (pressures.back + (loading - pressures.back) * std::exp(-fast * phi));
  }
  /// d lambda over that of plastic strain at pressure p. [-]
  Real weight(Real p, Real rate) const {
    constexpr Real least = 1e-3;  // in triaxial tension, where it grows without bound
    const Real x = std::max(1 + p / (rate * c_.surfaces.tension()), least);
    return 1 / (rate * std::pow(x, p < 0 ? c_.b2 : c_.b1));
  }

  void advance(const Point& at) const {
    const Real before = at.kept(dilation) - at.kept(volume);
    at.kept(volume) += at.strain(0) + at.strain(1) + at.strain(2);
    const Real most = at.kept(compaction);
    const Pressures pressures{c_.C, most, c_.C(most), c_.K.held(most)};
    const Real e = at.kept(dilation) - at.kept(volume), elastic = pressures(e);
    State of{factor_of_rate(at, elastic), 0.5, at.kept(size)};
    const Real modified = at.kept(lambda), known = counted(modified, of.size);
    const Real eta = known <= peak_ ? 1 : c_.damage(known);
    const Real least = -of.rate * eta * c_.surfaces.tension();
    const bool open = elastic < least;

    Real s[6];
    const Real G = shear_at(pressures, e), old = shear_at(pressures, before), p = open ? least : elastic;
    // a modulus that falls again, as pressure comes back, leaves the elastic energy as it is
    const Real q = trial_deviator(at, G, G < old ? std::sqrt(G / old) : 1, s, of.cosine);
    const Returned on = return_to_surface(pressures, e, p, q, G, open, modified, of);
    at.kept(plastic_strain) += on.flow, at.kept(dilation) += on.dilation, at.kept(lambda) += on.lambda;
    const Real now = e + on.dilation;
    at.kept(compaction) = std::max(most, now);
    const Real end = open ? least : std::max(pressures(now), least);
    if (open) open_crack(at, (least - elastic) / pressures.back, q > 0 ? on.q / -least : 0);
    const Real scale = q > 0 ? on.q / q : 1;
    for (std::size_t k = 0; k < 6; ++k) at.stress(k) = scale * s[k] - (k < 3 ? end : 0);
    const Real last = counted(at.kept(lambda), of.size);
    at.kept(damage) = peak_ + last > 0 ? 2 * last / (last + peak_) : 0;
  }

  /// `s`: the deviator without flow, of `share` of the old one. Returns its q; `cosine`: of its Lode angle.
  static Real trial_deviator(const Point& at, Real G, Real share, Real* s, Real& cosine) {
    const Real mean = (at.stress(0) + at.stress(1) + at.stress(2)) / 3,
               grown = (at.strain(0) + at.strain(1) + at.strain(2)) / 3;
    for (std::size_t k = 0; k < 6; ++k)
      s[k] = share * (at.stress(k) - (k < 3 ? mean : 0)) + 2 * G * (at.strain(k) - (k < 3 ? grown : 0));
    const Real J2 = 0.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) + s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
    if (!(J2 > 0)) return 0;
    const Real J3 = s[0] * (s[1] * s[2] - s[4] * s[4]) - s[3] * (s[3] * s[2] - s[4] * s[5]) +
                    s[5] * (s[3] * s[4] - s[1] * s[5]);
    const Real angle = std::acos(std::clamp(1.5 * std::sqrt(3 / J2) * J3 / J2, Real(-1), Real(1))) / 3;
    cosine = std::cos(angle);
    return std::sqrt(3 * J2);
  }

  struct Returned {
    Real q, flow = 0, dilation = 0, lambda = 0;
  };
  /// q_tr - 3 G x = r(p(x)) surface(p(x), lambda(x)); x of the deviator's plastic strain dilates by OMEGA
  /// times the slope of the surface x.
  Returned return_to_surface(const Pressures& pressures, Real e, Real p, Real q, Real G, bool open,
                             Real modified, const State& of) const {
    Returned out{q};
    const StrengthAt first = surface(p, modified, of);
    const Real r = lode(p, of);
    if (!(q > r * first.q)) return out;
    const Real known = counted(modified, of.size);
    const Real share = known <= peak_ ? c_.omega : c_.omega * std::pow(c_.damage(known), c_.edrop);
    const Real dilates = open ? 0 : share * r * std::max(first.slope, Real(0));
    const Real strain = std::sqrt(1 + 2.0 / 9 * dilates * dilates), grows = weight(p, of.rate) * strain;
    const auto excess = [&](Real x) {
      const Real now = open ? p : pressures(e + dilates * x);
      return q - 3 * G * x - lode(now, of) * surface(now, modified + grows * x, of).q;
    };
    const Real x = root_below(q / (3 * G), excess);
    out.q = std::max(q - 3 * G * x, Real(0));
    out.flow = strain * x, out.dilation = dilates * x, out.lambda = grows * x;
    return out;
  }

  /// A crack that opens further than ever without much shear counts as damage. `ratio`: q over the tension.
  void open_crack(const Point& at, Real by, Real ratio) const {
    constexpr Real little = 0.1;
    const Real further = by - at.kept(opening);
    if (!(further > 0)) return;
    at.kept(opening) = by;
    if (ratio < little) at.kept(lambda) += c_.b3 * (1 - ratio / little) * further;
  }

  ConcreteNumbers c_;
  Real peak_;   ///< lambda at which eta is 1
  Real shear_;  ///< G/K [-]
};

struct MatConcreteDamageRel3 : MatConcreteDamageRel3Fields {
  bool generates() const { return a0 < 0; }
  std::array<Real, 13> lambdas() const {
    return {lambda01, lambda02, lambda03, lambda04, lambda05, lambda06, lambda07,
            lambda08, lambda09, lambda10, lambda11, lambda12, lambda13};
  }
  std::array<Real, 13> etas() const {
    return {eta01, eta02, eta03, eta04, eta05, eta06, eta07, eta08, eta09, eta10, eta11, eta12, eta13};
  }
  bool gives_damage() const {
    const auto l = lambdas(), e = etas();
    const auto is_zero = [](Real x) { return x == 0; };
    return !std::all_of(l.begin(), l.end(), is_zero) || !std::all_of(e.begin(), e.end(), is_zero);
  }
  static constexpr Real psi_of_MPa = 145.0377377;
  Real megapascals(Real stress) const { return stress * ucf / psi_of_MPa; }
  Real nu() const { return generates() && pr == 0 ? 0.19 : pr; }
  ConcreteSurfaces surfaces() const;
  DamageFunction damage() const;
  CompactionCurves generated_compaction() const;
  std::optional<CompactionCurves> given_compaction(const Deck& deck, const Model& model) const;
  std::shared_ptr<StrengthLaw> law(const Deck& deck, const Model& model) const;
  void check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  void check_compaction(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  void check_damage(const Deck& deck, Diagnostics& diagnostics) const;
};

// Malvar and others 1997: a concrete of 45.4 MPa, scaled by the strength. In psi FT = 1.58 fc^(2/3).
ConcreteSurfaces MatConcreteDamageRel3::surfaces() const {
  const Real fc = -a0;
  const auto or_made = [&](Real given, Real made) { return generates() && given == 0 ? made : given; };
  const Real psi = ucf > 0 ? 1.58 * std::pow(fc * ucf, 2.0 / 3) / ucf : 0;
  return {{generates() ? 0.2956 * fc : a0, or_made(a1, 0.4463), or_made(a2, 0.0808 / fc)},
          {or_made(a0y, 0.2232 * fc), or_made(a1y, 0.625), or_made(a2y, 0.2575 / fc)},
          {0, or_made(a1f, 0.4417), or_made(a2f, 0.1183 / fc)},
          or_made(ft, psi)};
}

DamageFunction MatConcreteDamageRel3::damage() const {
  if (gives_damage()) return {lambdas(), etas()};
  return {{0, 8e-6, 2.4e-5, 4e-5, 5.6e-5, 7.2e-5, 8.8e-5, 3.2e-4, 5.2e-4, 5.7e-4, 1, 10, 1e10},
          {0, 0.85, 0.97, 0.99, 1, 0.99, 0.97, 0.5, 0.1, 0, 0, 0, 0}};
}

CompactionCurves MatConcreteDamageRel3::generated_compaction() const {
  const Real K = ucf > 0 ? 14620 * psi_of_MPa / ucf * std::sqrt(megapascals(std::abs(a0)) / 45.4) : 1;
  const std::vector<Real> strain{0, 0.0015, 0.0043, 0.0101, 0.0305, 0.0513, 0.0726, 0.0943, 0.174, 0.208};
  std::vector<Real> C{0, 1, 2.18, 3.5, 6.65, 10.03, 14.23, 21.77, 127.1, 194.4};
  std::vector<Real> back{1, 1, 1.014, 1.065, 1.267, 1.47, 1.672, 1.825, 4.106, 5};
  for (Real& p : C) p *= 0.0015 * K;
  for (Real& k : back) k *= K;
  return {{strain, std::move(C)}, {strain, std::move(back)}};
}

/// Of the first part with this material that has one.
std::optional<CompactionCurves> MatConcreteDamageRel3::given_compaction(const Deck& deck,
                                                                        const Model& model) const {
  for (const ModelPart& part : model.parts)
    if (part.mid == mid && part.eosid != 0) return compaction_curves(deck, model, part.eosid);
  return std::nullopt;
}

std::shared_ptr<StrengthLaw> MatConcreteDamageRel3::law(const Deck& deck, const Model& model) const {
  const auto or_made = [&](Real given, Real made) { return generates() && given == 0 ? made : given; };
  const auto given = given_compaction(deck, model);
  CompactionCurves compaction = given ? *given : generated_compaction();
  ConcreteNumbers out{.ro = ro,
                      .nu = nu(),
                      .surfaces = surfaces(),
                      .damage = damage(),
                      .b1 = or_made(b1, 1.6),
                      .b2 = or_made(b2, 1.35),
                      .b3 = or_made(b3, 1.15),
                      .omega = or_made(omega, 0.5),
                      .edrop = or_made(edrop, 1),
                      .width = 0,
                      .C = std::move(compaction.C),
                      .K = std::move(compaction.K),
                      .rates = std::nullopt};
  if (!gives_damage()) out.width = locwidth > 0 || !(rsize > 0) ? locwidth : 1 / rsize;
  if (const auto curve = model.curves.find(lcrate); curve != model.curves.end()) out.rates = curve->second;
  return std::make_shared<DamagedConcrete>(std::move(out));
}

void MatConcreteDamageRel3::check(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  const auto expect = expectations_of(*this, deck, diagnostics);
  const int errors = diagnostics.errors();
  expect(pr < 0.5, "PR", "a number below 0.5", pr, "the shear modulus follows from it");
  expect(a0 != 0, "A0", "a number that is not 0", a0,
         "-fc generates the parameters by the strength fc in uniaxial compression");
  expect(omega >= 0 && omega <= 1, "OMEGA", "a number from 0 to 1", omega, "1: associated flow");
  expect(b1 >= 0, "B1", "a number >= 0", b1, "pressure slows damage down");
  expect(slambda == 0 || slambda == 100, "SLAMBDA", "0 or 100", slambda,
         "a given damage function holds as it is, a generated one goes by LOCWIDTH and the size of elements");
  expect(npts == 0 || npts == 13, "NPTS", "13", npts, "the cards have 13 points");
  expect(
      lcrate >= 0, "LCRATE", "a curve", static_cast<Real>(lcrate),
      "a built-in influence of rates is not supported: give a curve of the factor of the strength over the "
      "rate of strain, < 0 in tension");
  if (generates()) {
    expect(ucf > 0 || ft > 0, "UCF", "a number > 0", ucf,
           "psi for the unit of stress, 145.04 with MPa: FT follows from -A0 in psi; or give FT");
    expect(gives_damage() || locwidth > 0 || rsize > 0, "LOCWIDTH", "a number > 0", locwidth,
           "the width over which the generated damage function holds, three times the largest aggregate; or "
           "give RSIZE, inches for the unit of length: one inch");
  } else if (a0 > 0) {
    for (const auto& [field, value] :
         {std::pair{"FT", ft}, {"A1", a1}, {"A1F", a1f}, {"A0Y", a0y}, {"A1Y", a1y}})
      expect(value > 0, field, "a number > 0", value, "with A0 > 0 all parameters are given");
    expect(gives_damage(), "LAMBDA02", "a number > 0", lambda02, "with A0 > 0 the damage function is given");
  }
  check_damage(deck, diagnostics);
  if (diagnostics.errors() > errors) return;
  const ConcreteSurfaces s = surfaces();
  const Real fc = s.compression();
  expect(fc > 0 && std::isfinite(fc), "A1", "a surface with a strength in uniaxial compression", a1,
         "q = A0 + p/(A1 + A2 p) is met by q = 3 p");
  expect(s.yield() > 0 && s.yield() < fc, "A0Y", "first flow in uniaxial compression below the strength",
         s.yield(), "q = A0Y + p/(A1Y + A2Y p), q = 3 p");
  expect(s.tension() < fc / 3, "FT", "a number below a third of the strength in compression", s.tension(),
         "the surface ends at the pressure -FT");
  for (const Real p : {fc / 3, fc, 3 * fc, 10 * fc})
    if (s.residual(p).q > s.greatest(p).q * (1 + 1e-9)) {
      deck.error(
          diagnostics, *this, "A1F",
          fmt::format("at the pressure {:.4g} the residual strength {:.4g} is above the greatest one, {:.4g}",
                      p, s.residual(p).q, s.greatest(p).q),
          "softening leads from the one to the other");
      break;
    }
  constexpr Real low = 5, high = 150;
  if (generates() && ucf > 0 && (megapascals(fc) < low || megapascals(fc) > high))
    deck.warning(diagnostics, *this, "UCF", fmt::format("by it the strength is {:.4g} MPa", megapascals(fc)),
                 "psi for the unit of stress: 145.04 with MPa, 1.4504e-4 with Pa, 1.4504e5 with GPa");
  if (const auto curve = model.curves.find(lcrate); lcrate > 0 && curve != model.curves.end()) {
    const auto& y = curve->second.ordinate;
    expect(std::all_of(y.begin(), y.end(), [](Real f) { return f > 0; }), "LCRATE", "a curve of factors > 0",
           static_cast<Real>(lcrate), "1 without rate");
    if (!(curve->second.abscissa.front() < 0))
      deck.warning(diagnostics, *this, "LCRATE",
                   fmt::format("curve {} has no rates below 0: in tension its first factor holds", lcrate),
                   "rates in tension are < 0");
  }
  check_compaction(deck, model, diagnostics);
}

void MatConcreteDamageRel3::check_damage(const Deck& deck, Diagnostics& diagnostics) const {
  if (!gives_damage()) return;
  const auto expect = expectations_of(*this, deck, diagnostics);
  const DamageFunction f = damage();
  bool rises = f.lambda[0] >= 0;
  for (std::size_t k = 1; k < DamageFunction::points; ++k) rises = rises && f.lambda[k] > f.lambda[k - 1];
  expect(rises, "LAMBDA02", "13 numbers that rise", lambda02, "the damage function is over them");
  expect(
      f.eta[f.peak()] == 1, "ETA01", "a largest value of 1", f.eta[f.peak()],
      "eta rises from that of first flow to 1, the greatest strength, and falls to that of crushed concrete");
  expect(f.peak() > 0, "ETA01", "a number below 1", eta01, "lambda is 0 at the start");
}

void MatConcreteDamageRel3::check_compaction(const Deck& deck, const Model& model,
                                             Diagnostics& diagnostics) const {
  Id of = 0;
  bool used = false, lacks = false;
  for (const ModelPart& part : model.parts) {
    if (part.mid != mid || (!part.has_solid && !part.has_sph)) continue;
    if (used && part.eosid != of)
      deck.error(diagnostics, part.card, "EOSID",
                 fmt::format("parts of material {} have different equations of state, {} and {}", mid, of,
                             part.eosid),
                 "give each a material of its own");
    used = true, of = part.eosid, lacks = lacks || part.eosid == 0;
  }
  if (!used) return;
  if (lacks) {
    const char* what = generates() ? "UCF" : "A0";
    if (!generates() || !(ucf > 0))
      deck.error(diagnostics, *this, what, "there is no compaction: its parts have no equation of state",
                 "add *EOS_TABULATED_COMPACTION to the parts; it is generated where A0 is < 0 and UCF > 0");
    return;
  }
  const auto curves = given_compaction(deck, model);
  const char* fault = nullptr;
  if (!curves)
    fault = "the equation of state of its parts is no *EOS_TABULATED_COMPACTION";
  else if (!curves->cold)
    fault = "GAMA and V0 of its equation of state are not supported";
  else if (curves->C.strain().size() < 2 || curves->C.strain().front() > 0 || curves->C(0) != 0 ||
           !(curves->C.slope(0) > 0) || !(curves->K.held(0) > 0))
    fault = "the curves of its equation of state do not rise from 0 at rest";
  if (fault)
    deck.error(diagnostics, *this, "MID", fault,
               "this material computes the pressure by the C and K of *EOS_TABULATED_COMPACTION alone");
}

// By hand. 45.4 MPa in units of 14620 MPa: K = 1, with PR 0.2 G = 0.75. Below first flow sxx = (K + 4 G/3) e
// = 2 e, syy = (K - 2 G/3) e = e/2. Squeezed to ln V = -0.0043: p = 2.18 0.0015; from there back along 1.014.
// Crushed (lambda 1): q = p/(0.4417 + 0.1183 p/fc) at that p, without dilation.
constexpr Real unit = 14620, fc45 = 45.4 / unit, p43 = 2.18 * 0.0015;
constexpr Real q43 = p43 / (0.4417 + 0.1183 / fc45 * p43);
const std::string concrete_45 = fmt::format(
    "1,2.0,0.2\n0.0,{:.16g},0,0,0.1,1e-9\n0,0,0,1.0,{:.16g}\n\n\n\n\n", -fc45, 145.0377377 * unit);
const RegisterStrength<MatConcreteDamageRel3> mat_concrete_damage_rel3{
    "q <= r(p, theta) f (eta (q1 - q2) + q2) at p/f, q1 = A0 + p/(A1 + A2 p), below fc/3 3/(2 psi) (p + FT); "
    "q2 "
    "before the peak A0Y + p/(A1Y + A2Y p), behind it p/(A1F + A2F p); eta over lambda, dlambda = de/(f (1 + "
    "p/(f "
    "FT))^b), b = B1, in tension B2, plus B3 (1 - 10 q/|p|) of cracks that open; dilation OMEGA dq/dp; p by "
    "the "
    "table of compaction, >= -eta f FT",
    "Malvar, Crawford, Wesevich & Simons 1997; Willam & Warnke 1975",
    {{concrete_45, {1e-5, 0, 0}, {}, {2e-5, 0.5e-5, 0.5e-5}},
     {concrete_45,
      {-0.0043 / 3, -0.0043 / 3, -0.0043 / 3},
      {},
      {-p43, -p43, -p43},
      {0},
      {0, -0.0043, 0, 0, 0, 0.0043}},
     {concrete_45,
      {1e-4, 1e-4, 1e-4},
      {-p43, -p43, -p43},
      {-p43 + 3e-4 * 1.014, -p43 + 3e-4 * 1.014, -p43 + 3e-4 * 1.014},
      {0, -0.0043, 0, 0, 0, 0.0043}},
     {concrete_45,
      {-0.02, 0.01, 0.01},
      {-p43, -p43, -p43},
      {-p43 - 2 * q43 / 3, -p43 + q43 / 3, -p43 + q43 / 3},
      {0, -0.0043, 0, 1, 0, 0.0043}}},
    mat_concrete_damage_rel3_table()};

}  // namespace

}  // namespace courant
