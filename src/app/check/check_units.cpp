#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "app/check/units.hpp"

namespace courant {

namespace {

struct System {
  const char* name;
  const char* derived;  ///< units of force and pressure
  const char *mass, *length, *time;
  Real kg = 1, m = 1, s = 1;  ///< of one unit of mass, length, time
};

constexpr System systems[] = {
    {"kg-m-s", "N, Pa", "kg", "m", "s", 1, 1, 1},
    {"tonne-mm-s", "N, MPa", "t", "mm", "s", 1e3, 1e-3, 1},
    {"kg-mm-ms", "kN, GPa", "kg", "mm", "ms", 1, 1e-3, 1e-3},
    {"g-mm-ms", "N, MPa", "g", "mm", "ms", 1e-3, 1e-3, 1e-3},
    {"g-cm-us", "1e7 N, Mbar", "g", "cm", "us", 1e-3, 1e-2, 1e-6},
    {"g-cm-s", "dyn, dyn/cm2", "g", "cm", "s", 1e-3, 1e-2, 1},
    {"kg-mm-s", "mN, kPa", "kg", "mm", "s", 1, 1e-3, 1},
    {"g-mm-s", "uN, Pa", "g", "mm", "s", 1e-3, 1e-3, 1},
    {"slug-ft-s", "lbf, lbf/ft2", "slug", "ft", "s", 14.5939, 0.3048, 1},
    {"lbf s2/in-in-s", "lbf, psi", "lbf s2/in", "in", "s", 175.127, 0.0254, 1},
};

struct Substance {
  const char* name;
  Real low, high;  ///< range of a property
};

/// Densities at room conditions [kg/m3]
constexpr Substance densities[] = {
    {"air", 1.1, 1.35},       {"wood", 450, 700},        {"ice", 910, 922},        {"water", 990, 1035},
    {"concrete", 2300, 2500}, {"aluminium", 2640, 2850}, {"titanium", 4400, 4540}, {"steel", 7600, 8050},
    {"copper", 8850, 8980},   {"lead", 11200, 11400}};
/// Young's moduli [Pa]
constexpr Substance moduli[] = {{"aluminium", 6.6e10, 7.5e10},
                                {"titanium", 1.05e11, 1.2e11},
                                {"copper", 1.15e11, 1.35e11},
                                {"steel", 1.9e11, 2.15e11}};
/// Sound speeds [m/s]
constexpr Substance sounds[] = {{"air", 325, 350}, {"water", 1400, 1560}, {"steel", 4900, 6000}};

template <std::size_t N>
const char* named(const Substance (&table)[N], Real value) {
  for (const Substance& one : table)
    if (value >= one.low && value <= one.high) return one.name;
  return nullptr;
}

std::string with_name(Real value, const char* name) {
  return fmt::format("{:.4g}{}", value, name ? fmt::format(" ({})", name) : "");
}

std::vector<Real> distinct(std::vector<Real> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](Real v) { return !(v > 0); }), values.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// The deck's numbers in one system, in SI, and how well they fit.
struct Fit {
  const System* system = nullptr;
  Real score = 0;
  std::vector<std::string> reasons{};  ///< what speaks for the system
  std::vector<std::string> densities{};
  Real gravity = 0, size = 0, end = 0;
  std::vector<Real> sound{};
};

struct Evidence {
  std::vector<Real> ro, E, c;
  Real gravity = 0, size = 0, end = 0;
};

// Weights: a density is the strongest sign, and gravity, where there is some; scales only decide between
// systems that agree in these.
constexpr Real of_density = 3, of_gravity = 4, of_modulus = 2, of_sound = 1, of_scale = 0.5;

void judge_material(const Evidence& e, Fit& fit) {
  const System& u = *fit.system;
  Real densities_found = 0;
  for (const Real ro : e.ro) {
    const Real si = ro * u.kg / (u.m * u.m * u.m);
    const char* name = named(densities, si);
    fit.densities.push_back(with_name(si, name));
    if (!name) continue;
    densities_found += 1;
    fit.reasons.push_back(fmt::format("RO = {:g} is {}", ro, name));
  }
  if (!e.ro.empty()) fit.score += of_density * densities_found / static_cast<Real>(e.ro.size());
  for (const Real E : e.E)
    if (const char* name = named(moduli, E * u.kg / (u.m * u.s * u.s))) {
      fit.score += of_modulus / static_cast<Real>(e.E.size());
      fit.reasons.push_back(fmt::format("E = {:g} is {}", E, name));
    }
}

Fit fit_of(const System& u, const Evidence& e) {
  Fit fit{.system = &u};
  fit.gravity = e.gravity * u.m / (u.s * u.s);
  constexpr Real earth = 9.81, tolerance = 0.02;
  if (e.gravity > 0) {
    const bool fits = std::abs(fit.gravity / earth - 1) < tolerance;
    fit.score += fits ? of_gravity : -of_gravity / 4;
    if (fits) fit.reasons.push_back(fmt::format("the acceleration {:g} is gravity", e.gravity));
  }
  judge_material(e, fit);
  for (const Real c : e.c) {
    fit.sound.push_back(c * u.m / u.s);
    if (const char* name = named(sounds, fit.sound.back())) {
      fit.score += of_sound;
      fit.reasons.push_back(fmt::format("the sound speed {:g} is that of {}", c, name));
    }
    constexpr Real slowest = 1, fastest = 2e4;  // of fluids made softer for SPH, of solids
    if (fit.sound.back() < slowest || fit.sound.back() > fastest) fit.score -= of_density;
  }
  fit.size = e.size * u.m;
  fit.end = e.end * u.s;
  if (e.size > 0 && (fit.size < 1e-5 || fit.size > 1e4)) fit.score -= of_scale;
  if (e.end > 0 && (fit.end < 1e-8 || fit.end > 1e5)) fit.score -= of_scale;
  return fit;
}

std::string first_two(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t k = 0; k < std::min<std::size_t>(2, words.size()); ++k)
    out += (k > 0 ? ", " : "") + words[k];
  return words.size() > 2 ? out + ", .." : words.empty() ? "-" : out;
}

std::string number_or_none(Real value) {
  return value > 0 ? fmt::format("{:.4g}", value) : "-";
}

std::string table(const std::vector<Fit>& fits) {
  std::string out = fmt::format("  {:<16}{:<40}{:>10}{:>12}{:>10}{:>10}\n", "read as", "densities [kg/m3]",
                                "g [m/s2]", "sound [m/s]", "size [m]", "end [s]");
  for (const Fit& fit : fits)
    out += fmt::format(
        "  {:<16}{:<40.39}{:>10}{:>12}{:>10}{:>10}\n", fit.system->name, first_two(fit.densities),
        number_or_none(fit.gravity),
        number_or_none(fit.sound.empty() ? 0 : *std::max_element(fit.sound.begin(), fit.sound.end())),
        number_or_none(fit.size), number_or_none(fit.end));
  return out;
}

constexpr Real least_score = 1.5;

bool fits_well(const Fit& fit) {
  return fit.score >= least_score && !fit.reasons.empty();
}

Evidence evidence_of(const DeckFacts& facts, const std::vector<Real>& sound_speeds) {
  Evidence e;
  for (const MaterialFacts& m : facts.materials) e.ro.push_back(m.ro), e.E.push_back(m.E);
  e.ro = distinct(e.ro), e.E = distinct(e.E), e.c = distinct(sound_speeds);
  e.gravity = facts.gravity;
  e.size = facts.nodes > 0 ? (facts.high - facts.low).maxCoeff() : 0;
  e.end = facts.endtim;
  return e;
}

/// Of all systems, the best first; none where nothing tells.
std::vector<Fit> fits_of(const Evidence& e) {
  std::vector<Fit> fits;
  if (e.ro.empty() && e.E.empty() && !(e.gravity > 0)) return fits;
  for (const System& u : systems) fits.push_back(fit_of(u, e));
  std::stable_sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.score > b.score; });
  return fits;
}

}  // namespace

std::optional<UnitNames> guess_units(const DeckFacts& facts, const std::vector<Real>& sound_speeds) {
  const std::vector<Fit> fits = fits_of(evidence_of(facts, sound_speeds));
  if (fits.empty() || !fits_well(fits[0]) || fits[1].score == fits[0].score) return std::nullopt;
  const System& u = *fits[0].system;
  return UnitNames{u.mass, u.length, u.time};
}

std::string units_text(const DeckFacts& facts, const std::vector<Real>& sound_speeds) {
  const Evidence e = evidence_of(facts, sound_speeds);
  std::vector<Fit> fits = fits_of(e);
  if (fits.empty()) return "Units: the deck has neither densities nor gravity to derive them from\n";
  if (!fits_well(fits[0])) {
    fits.resize(3);
    return "Units: no common system fits; are they consistent?\n" + table(fits);
  }
  std::string out = fmt::format("Units: {} ({})", fits[0].system->name, fits[0].system->derived);
  if (fits[1].score == fits[0].score)
    out += fmt::format(" or {} ({})", fits[1].system->name, fits[1].system->derived);
  out += "\n  ";
  for (std::size_t k = 0; k < std::min<std::size_t>(4, fits[0].reasons.size()); ++k)
    out += (k > 0 ? ", " : "") + fits[0].reasons[k];
  if (e.gravity > 0 && std::abs(fits[0].gravity / 9.81 - 1) >= 0.02)
    out += fmt::format("; but the acceleration {:g} is not the earth's", e.gravity);
  const auto doubtful =
      std::find_if(fits.begin() + 1, fits.end(), [](const Fit& f) { return !fits_well(f); });
  fits.erase(std::min(doubtful, fits.begin() + 3), fits.end());
  return out + "\n" + table(fits);
}

}  // namespace courant
