#include "app/report/verdict.hpp"
#include "app/run/app_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "app/report/range_warnings.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

const FieldRules share{.check = Check::not_negative};

const RegisterKeyword<VerdictCard> verdict_card{courant_verdict_table()};

/// Of the maxima of the run; nothing where none was noted.
std::optional<Real> largest(const Summary& s, const char* name) {
  const auto found = s.maxima.find(name);
  return found == s.maxima.end() ? std::nullopt : std::optional(found->second);
}

/// What walls did beyond their penalty matters where it took energy.
void add_held(const Summary& s, std::vector<Finding>& out) {
  const Real share = largest(s, "contact_held_energy").value_or(0) / s.energy.scale();
  if (!(share > s.limits.residual_doubtful)) return;
  out.push_back(
      {false,
       fmt::format("walls stopped particles that their penalty could not hold, which took {:.3g} % of the "
                   "scene's energy as a plastic impact does: make the contact stiffer (SFSA, SLSFAC, SOFT 1) "
                   "where the rebound matters",
                   100 * share)});
}

/// The run began with what was not at rest.
void add_relaxation(const Summary& s, std::vector<Finding>& out) {
  const auto ratio = largest(s, "relaxation_ratio"), best = largest(s, "relaxation_factor");
  if (!ratio) return;
  const std::string factor = best ? fmt::format("a DRFCTR of {:.6g}, by its lowest frequency", *best)
                                  : "a DRFCTR of 1 - 2 w dt, w the lowest frequency";
  out.push_back({false, fmt::format("the dynamic relaxation before the run ended with {:.2g} of its largest "
                                    "kinetic energy, and was not at rest: what follows swings about "
                                    "the preloaded state; give it a later DRTERM, or {}",
                                    *ratio, factor)});
}

constexpr const char* with_drilling = "give BWC 1 of *CONTROL_SHELL, or ELFORM 16";

/// Shells that have no stiffness where they meet. In curved shells that are right it is below 0.007, in those
/// that are 20 to 50 % too soft from 0.07 on (docs/reliability.md).
void add_curvature(const Summary& s, std::vector<Finding>& out) {
  constexpr Real doubtful = 0.03;
  const Real share = largest(s, "unresisted_curvature").value_or(0);
  if (!(share > doubtful)) return;
  out.push_back(
      {false, fmt::format("shells of formulation 2 bent without the moments of their curvature, {:.3g} % of "
                          "their energy: without a stiffness about the normal curved surfaces and open "
                          "sections deform too far; {}",
                          100 * share, with_drilling)});
}

/// Solids of one point that bend in modes which nothing resists. Beams of n elements over their depth miss
/// 1/(n^2 - 1), by which they are too soft: 7 % with four, 13 % with three, 33 % with two.
void add_modes(const Summary& s, std::vector<Finding>& out) {
  const Real share = largest(s, "unresisted_modes").value_or(0);
  if (!(share > s.limits.hourglass_doubtful)) return;
  const std::string effect = share < 1
                                 ? fmt::format("displacements are too large by up to {:.3g} %", 100 * share)
                                 : std::string("almost nothing resists bending, or forces on single nodes");
  out.push_back(
      {false,
       fmt::format("solids of part {:.0f} bend in hourglass modes that hourglass control does not hold "
                   "as the material would: {}; take IHQ 6 with QM 1 of *HOURGLASS where they stay "
                   "elastic, or at least four elements over the depth",
                   largest(s, "unresisted_modes_part").value_or(0), effect)});
}

/// What yields keeps what it overshoots by.
void add_overshoot(const Summary& s, std::vector<Finding>& out) {
  const auto strain = largest(s, "relaxation_plastic_strain");
  if (!strain) return;
  out.push_back(
      {false, fmt::format("material yielded, to a plastic strain of {:.2g}, in a dynamic relaxation "
                          "whose load acts at once: it swings beyond its rest there, and keeps "
                          "what that bent; let the curve of the load rise over some periods of "
                          "the lowest frequency",
                          *strain)});
}

/// At rest by its energy, but something moves on.
void add_creep(const Summary& s, std::vector<Finding>& out) {
  const auto ahead = largest(s, "relaxation_ahead");
  if (!ahead) return;
  out.push_back(
      {false,
       fmt::format("the dynamic relaxation ended at rest by its kinetic energy, but nodes still crept, with "
                   "{:.2g} of their displacement ahead: hold what is loose, or give a DRFCTR nearer to 1",
                   *ahead)});
}

/// Joints that were drawn apart, of the size of the smaller body: beyond 1e-4 they become springs, or the run
/// stops. Springs are meant to open a little.
void add_joint_gap(const Summary& s, std::vector<Finding>& out) {
  constexpr Real doubtful = 1e-5, doubtful_spring = 0.01;
  if (const Real share = largest(s, "joint_spring_gap_share").value_or(0); share > doubtful_spring)
    out.push_back(
        {false,
         fmt::format("a joint of rigid bodies, a penalty spring, opened by {:.2g} of the size of its "
                     "smaller body: give it a larger RPS, or make positions and axes of the joints fit",
                     share)});
  if (largest(s, "joint_spring_gap_share")) return;  // what exact joints opened by made springs of them
  const Real share = largest(s, "joint_gap_share").value_or(0);
  if (!(share > doubtful)) return;
  out.push_back(
      {false, fmt::format("a joint of rigid bodies opened by {:.2g} of the size of its smaller body: "
                          "what drives or holds its bodies, or axes that are askew in a closed loop, "
                          "do not let it hold",
                          share)});
}

/// Momentum that came or went where nothing outside acts, of the largest sum of the momenta of parts.
void add_momentum(const Summary& s, std::vector<Finding>& out) {
  constexpr Real doubtful = 1e-3;
  const Real share = largest(s, "momentum_change_share").value_or(0);
  if (!(share > doubtful)) return;
  out.push_back(
      {false, fmt::format("total momentum changed by {:.2g} % of that of the parts, though nothing outside "
                          "acts on them: what joins them, or contact, pushes one of two bodies only",
                          100 * share)});
}

void add_energy(const Summary& s, std::vector<Finding>& out) {
  const EnergyLedger& e = s.energy;
  const Real error = e.error();
  if (!std::isfinite(e.total()) || !std::isfinite(error)) {
    out.push_back({true, "the energy is no finite number"});
    return;
  }
  if (!(std::abs(error) > std::min(s.limits.residual_doubtful, s.limits.residual_broken))) return;
  out.push_back(
      {std::abs(error) > s.limits.residual_broken,
       fmt::format("the energy balance does not close: {:.4g} [ML2/T2] {}, {:.3g} % of the {:.4g} that the "
                   "scene held and passed; lower TSSFAC, and look at contact stiffness (SFSA, SLSFAC) and at "
                   "where particles leave the box",
                   std::abs(e.unexplained()), error > 0 ? "came from nowhere" : "were lost",
                   100 * std::abs(error), e.scale())});
}

std::int64_t counted(const Summary& s, const char* name) {
  const auto found = s.counters.find(name);
  return found == s.counters.end() ? std::int64_t(0) : found->second;
}

/// Nodes of elements that contact could not keep in front of a face, or edges on the side they came from.
void add_leaked(const Summary& s, const char* what, const char* through, std::vector<Finding>& out) {
  const std::int64_t leaked = counted(s, fmt::format("leaked_{}s", what).c_str());
  if (leaked <= 0) return;
  const std::int64_t all = counted(s, fmt::format("contact_{}s", what).c_str());
  const Real part = static_cast<Real>(leaked) / static_cast<Real>(std::max(all, leaked));
  if (!(part > std::min(s.limits.leaks_doubtful, s.limits.leaks_broken))) return;
  out.push_back({part > s.limits.leaks_broken,
                 fmt::format("{} {}{} went through {}, {:.2g} % of those in contacts: make the contact "
                             "stiffer (SFSA, SLSFAC, SOFT 1), or the mesh finer where bodies meet",
                             leaked, what, leaked == 1 ? "" : "s", through, 100 * part)});
}

void add_leaks(const Summary& s, std::vector<Finding>& out) {
  if (s.leaked_particles <= 0) return;
  const Real part = static_cast<Real>(s.leaked_particles) /
                    static_cast<Real>(std::max<std::int64_t>(s.particles, s.leaked_particles));
  if (!(part > std::min(s.limits.leaks_doubtful, s.limits.leaks_broken))) return;
  out.push_back(
      {part > s.limits.leaks_broken,
       fmt::format("{} particle{} leaked through a wall, {:.2g} % of all: make the contact stiffer (SFSA, "
                   "SLSFAC), or lower TSSFAC for what hits the wall so fast",
                   s.leaked_particles, s.leaked_particles == 1 ? "" : "s", 100 * part)});
}

/// Particles that left the scene, as through a gap between walls, which no wall sees.
void add_outside(const Summary& s, std::vector<Finding>& out) {
  const std::int64_t outside = counted(s, "outside_the_scene");
  if (outside <= 0) return;
  const Real part =
      static_cast<Real>(outside) / static_cast<Real>(std::max<std::int64_t>(s.particles, outside));
  if (!(part > s.limits.leaks_broken)) return;
  out.push_back({false, fmt::format("{} particle{} left the scene, {:.2g} % of all: farther from all nodes "
                                    "than these reach; look for a gap between walls or an edge that is too "
                                    "low, or end the scene there (BOXID of *CONTROL_SPH)",
                                    outside, outside == 1 ? "" : "s", 100 * part)});
}

/// Hourglass energy below this share of all that the scene is about does no harm.
constexpr Real least_hourglass = 1e-3;
/// Internal energy below this share is negligible, in blocks that fall or slide: hourglass energy is judged
/// against a tenth of the scene's.
constexpr Real least_internal = 0.01;

void add_hourglass(const Summary& s, std::vector<Finding>& out) {
  const EnergyLedger& e = s.energy;
  // bending by assumed strains is no fault of the mesh
  const Real internal = std::max(std::abs(e.internal), e.most_internal) + e.assumed_bending;
  const Real hourglass = e.hourglass - e.assumed_bending;
  const bool negligible = internal < least_internal * e.scale();
  const Real share =
      hourglass / std::max(negligible ? 0.1 * e.scale() : internal, std::numeric_limits<Real>::min());
  if (!(hourglass > least_hourglass * e.scale()) ||
      !(share > std::min(s.limits.hourglass_doubtful, s.limits.hourglass_broken)))
    return;
  out.push_back(
      {share > s.limits.hourglass_broken,
       fmt::format(
           "hourglass energy is {:.3g} % of {}: {}, or choose another IHQ or QM of *HOURGLASS", 100 * share,
           negligible ? "a tenth of the scene's energy" : "the largest internal energy",
           largest(s, "angle_between_facets")
               ? fmt::format("shells of formulation 2 meet at angles, {}; refine the mesh", with_drilling)
               : "refine the mesh")});
}

/// Mass that scaling gave to nodes that move already.
void add_scaled_momentum(const Summary& s, std::vector<Finding>& out) {
  const Real added = largest(s, "momentum_of_added_mass").value_or(0),
             all = largest(s, "momentum_of_nodes").value_or(0);
  if (!(all > 0)) return;
  const Real share = added / all;
  if (!(share > s.limits.residual_doubtful)) return;
  out.push_back(
      {false, fmt::format("mass that DT2MS added during the run brought momentum with it, {:.3g} % of "
                          "that of all nodes: take a smaller |DT2MS|, or MS1ST 1",
                          100 * share)});
}

void add_clamps(const Summary& s, std::vector<Finding>& out) {
  const auto count = [&](const char* name) { return counted(s, name); };
  if (const auto n = count("sound_speed_clamped"); n > 0)
    out.push_back(
        {false, fmt::format("the sound speed was set to 0 {} times: the constants of the equation of "
                            "state do not suit these densities",
                            n)});
  if (const auto n = count("deactivated_by_maxv"); n > 0)
    out.push_back({false, fmt::format("{} particles were faster than MAXV and switched off", n)});
  if (const auto n = count("speed_clipped"); n > 0)
    out.push_back({false, fmt::format("speeds were cut to MAXV {} times", n)});
}

}  // namespace

std::vector<Finding> findings(const Summary& s) {
  std::vector<Finding> out;
  if (s.termination == "error") out.push_back({true, s.reason});
  add_leaks(s, out);
  add_outside(s, out);
  add_leaked(s, "node", "a face", out);
  add_leaked(s, "edge", "another", out);
  add_held(s, out);
  add_joint_gap(s, out);
  add_momentum(s, out);
  add_relaxation(s, out);
  add_creep(s, out);
  add_overshoot(s, out);
  add_curvature(s, out);
  add_modes(s, out);
  add_energy(s, out);
  add_hourglass(s, out);
  add_scaled_momentum(s, out);
  add_clamps(s, out);
  for (std::string& text : range_warnings(s.ranges, s.limits.mach_doubtful, s.limits.density_doubtful))
    out.push_back({false, std::move(text)});
  return out;
}

std::string verdict_of(const std::vector<Finding>& found) {
  if (found.empty()) return "sound";
  for (const Finding& f : found)
    if (f.breaks) return "broken";
  return "doubtful";
}

void judge(Summary& s) {
  const std::vector<Finding> found = findings(s);
  s.verdict = verdict_of(found);
  s.verdict_reasons.clear();
  for (const Finding& finding : found) s.verdict_reasons.push_back(finding.text);
}

VerdictLimits verdict_limits(const Deck& deck) {
  VerdictLimits out;
  for (const VerdictCard& card : deck.all<VerdictCard>()) {
    out.given = true;
    const auto take = [](Real field, Real& limit) {
      if (field > 0) limit = field;
    };
    take(card.resd, out.residual_doubtful), take(card.resb, out.residual_broken);
    take(card.leakd, out.leaks_doubtful), take(card.leakb, out.leaks_broken);
    take(card.hgd, out.hourglass_doubtful), take(card.hgb, out.hourglass_broken);
    take(card.machd, out.mach_doubtful), take(card.densd, out.density_doubtful);
  }
  return out;
}

std::string energy_line(const EnergyLedger& e) {
  return fmt::format("energy residual {:.3g} % of the {:.4g} [ML2/T2] that the scene held and passed",
                     100 * e.error(), e.scale());
}

}  // namespace courant
