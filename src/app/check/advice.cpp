#include "app/check/advice.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace courant {

namespace {

/// A penetration at the start matters this many steps at most.
constexpr std::int64_t early = 2000;

bool set_by_contact(const StopFacts& f) {
  return f.dt_set_by.rfind("contact", 0) == 0;
}

std::string modulus_of(const StopFacts& f) {
  return f.stiffness_field.empty() ? "the bulk modulus" : f.stiffness_field;
}

std::string advice_for_start(const StopFacts& f) {
  if (f.tssfac > 1)
    return fmt::format(
        "TSSFAC = {:.3g} of *CONTROL_TIMESTEP makes steps longer than the stable one; 0.9 or "
        "less is usual",
        f.tssfac);
  if (f.initial_penetrations > 0 && f.cycle < early)
    return fmt::format(
        "{} particles started within the contact distance of a wall, up to {:.3g} [L] deep at "
        "a spacing of {:.3g}: move them off the wall, or lower the thickness SAST, SBST",
        f.initial_penetrations, f.initial_depth, f.spacing);
  if (f.start_speed > f.sound_speed)
    return fmt::format(
        "speeds of {:.4g} [L/T] at the start are above the sound speed of {:.4g}: check the "
        "units of velocities against those of RO and {}; an impact this fast also "
        "needs the real bulk modulus",
        f.start_speed, f.sound_speed, modulus_of(f));
  if (f.fall_speed > 0.5 * f.sound_speed)
    return fmt::format(
        "gravity gives speeds of {:.4g} [L/T] over the height of the scene, the sound speed is "
        "{:.4g}: check the units of *LOAD_BODY against those of RO and {}, or raise the modulus",
        f.fall_speed, f.sound_speed, modulus_of(f));
  return "";
}

std::string advice_for_flow(const StopFacts& f) {
  if (f.has_contact && set_by_contact(f))
    return fmt::format(
        "{} set the step: its penalty is stiff for particles this light; lower SLSFAC of "
        "*CONTROL_CONTACT or SFSA of the contact",
        f.dt_set_by);
  // what LCTM says is applied to the last step, and hides what would have set it
  const bool told = !f.dt_set_by.empty() && f.dt_set_by != "load curve";
  if (f.has_contact && told && f.contact_share > 0.95)
    return fmt::format(
        "{} set the step, and contact allows hardly more: its penalty is stiff for particles this light; "
        "lower SLSFAC of *CONTROL_CONTACT or SFSA of the contact",
        f.dt_set_by);
  if (f.leaked > 0)
    return fmt::format(
        "{} particles went through a wall: make the contact stiffer (SFSA), the wall thicker, "
        "or the step shorter (TSSFAC)",
        f.leaked);
  if (f.density_high > 2)
    return fmt::format(
        "the density reached {:.3g} RO: an impact too fast for this equation of state; raise {}, or lower "
        "the speed",
        f.density_high, modulus_of(f));
  if (f.tension && (f.cause == StopCause::density || f.density_low < 0.5))
    return fmt::format(
        "the density fell to {:.3g} RO in tension, which PC < 0 of *MAT_NULL allows: set PC = 0, "
        "or near it, so that the fluid parts instead",
        f.density_low);
  if (f.strength && f.cause == StopCause::density && f.density_low < 0.5)
    return fmt::format(
        "the density fell to {:.3g} RO: pieces of a solid fly apart; use FORM 0 of *CONTROL_SPH if it is "
        "another, or lower TSSFAC",
        f.density_low);
  if (f.cause == StopCause::step_size && told)
    return fmt::format(
        "{} set the step: look at its speed and sound speed there; MAXV of *CONTROL_SPH limits "
        "what single particles do",
        f.dt_set_by);
  return "";
}

}  // namespace

std::string advice(const StopFacts& f) {
  if (f.cause == StopCause::other) return f.hint;
  std::string text = advice_for_start(f);
  if (text.empty()) text = f.hint;
  if (text.empty()) text = advice_for_flow(f);
  if (text.empty())
    text = fmt::format(
        "lower TSSFAC of *CONTROL_TIMESTEP (now {:.3g}), or {}, and see where it begins in the "
        "last states",
        f.tssfac,
        f.particles ? "raise the artificial viscosity (*HOURGLASS Q1, Q2)"
                    : "make contact softer (SFSA, SLSFAC)");
  return text;
}

StopFacts facts_at_start(Simulation& s) {
  StopFacts f;
  World& w = s.world();
  const Particles& p = w.particles;
  f.tssfac = s.model().tssfac;
  f.particles = p.size() > 0;
  f.spacing = s.sph().spacing;
  f.has_contact = !s.contacts().empty();
  f.sound_speed = std::numeric_limits<Real>::infinity();
  for (const PartRange& part : s.guard().ranges())
    if (part.c0 > 0) f.sound_speed = std::min(f.sound_speed, part.c0);
  for (const PartMaterial& m : s.materials()) {
    f.strength |= m.strength != nullptr, f.tension |= m.found && !m.strength && m.pc < 0;
    if (f.stiffness_field.empty()) f.stiffness_field = m.stiffness_field();
  }
  Vec low = p.size() > 0 ? p.x.vec(0) : Vec::Zero(), high = low;
  for (Index i = 0; i < p.size(); ++i) {
    f.start_speed = std::max(f.start_speed, p.v.vec(i).norm());
    low = low.cwiseMin(p.x.vec(i)), high = high.cwiseMax(p.x.vec(i));
  }
  for (Index k = 0; k < w.nodes.size(); ++k) f.start_speed = std::max(f.start_speed, w.nodes.v.vec(k).norm());
  const BodyAcceleration::At loads = acceleration_of_particles(s.model()).at(0);
  Vec g = Vec::Zero();
  for (Index i = 0; i < p.size(); ++i) g = g.cwiseMax(loads(p.x.vec(i), p.part[i]).cwiseAbs());
  f.fall_speed = std::sqrt(2 * std::abs((high - low).cwiseProduct(g).cwiseAbs().sum()));
  const auto counter = w.counters.find("initial_penetrations");
  if (counter == w.counters.end() || counter->second == 0) return f;
  f.initial_penetrations = counter->second;
  for (const auto& contact : s.contacts())
    f.initial_depth = std::max(f.initial_depth, contact->penetrations(w).deepest);
  return f;
}

void add_facts_at_stop(StopFacts& f, Simulation& s, const RunError& error, const std::string& dt_set_by) {
  const World& w = s.world();
  f.cause = error.cause, f.hint = error.hint;
  f.cycle = s.clock().cycle;
  f.dt_set_by = dt_set_by;
  for (const auto& contact : s.contacts()) {
    const Real allowed = contact->limit(w, s.clock()).dt;
    f.contact_share = std::max(f.contact_share, s.clock().dt / allowed);
  }
  for (const PartRange& part : s.guard().ranges()) {
    if (!part.seen) continue;
    f.density_low = std::min(f.density_low, part.density_low.value);
    f.density_high = std::max(f.density_high, part.density_high.value);
  }
  const auto leaked = w.counters.find("leaked_particles");
  if (leaked != w.counters.end()) f.leaked = leaked->second;
}

}  // namespace courant
