#include "app/report/run_summary.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "app/run/resources.hpp"
#include "elements/element_laws.hpp"
#include "state/subcycle.hpp"

namespace courant {

namespace {

/// Contacts that never pushed anything, which may be meant, or not.
std::vector<std::string> idle_contacts(Simulation& s) {
  std::map<Id, std::pair<bool, std::string>> found;  // whether it acted, title
  const auto add = [&](const InterfaceForce& one, bool acted) {
    auto& of = found.try_emplace(one.id, false, one.title).first->second;
    of.first = of.first || acted;
  };
  for (const auto& contact : s.contacts()) add(contact->report(), contact->has_acted());
  for (const auto* one : s.world().passes.all<const InterfaceReporter>())
    add(one->report(), one->has_acted());
  std::vector<std::string> out;
  for (const auto& [id, of] : found)
    if (!of.first)
      out.push_back(
          fmt::format("contact {}{} never touched anything: if it should, look at the gap at the start, "
                      "at what SURFA and SURFB name, and at BT and DT",
                      id, of.second.empty() ? "" : " (" + of.second + ")"));
  return out;
}

/// Particles beyond the box of all nodes by more than its largest side: they fell past the walls.
std::int64_t outside_scene(const World& world) {
  if (world.nodes.size() == 0 || world.energy.potential == 0) return 0;
  Vec low = Vec::Constant(std::numeric_limits<Real>::max());
  Vec high = -low;
  for (Index i = 0; i < world.nodes.size(); ++i) {
    low = low.cwiseMin(world.nodes.x.vec(i));
    high = high.cwiseMax(world.nodes.x.vec(i));
  }
  const Real margin = (high - low).head(world.dim).maxCoeff();
  std::int64_t out = 0;
  for (Index i = 0; i < world.particles.active; ++i) {
    const Vec x = world.particles.x.vec(i);
    out += ((x - high).head(world.dim).maxCoeff() > margin || (low - x).head(world.dim).maxCoeff() > margin);
  }
  return out;
}

/// What outer steps spared, by what their passes took; empty where each step was one.
std::string subcycle_note(Simulation& s) {
  const World& world = s.world();
  const Subcycle* subcycle = Subcycle::of(world);
  const auto found = world.counters.find("pair_force_steps");
  if (!subcycle || found == world.counters.end()) return {};
  const auto outer = static_cast<Real>(found->second), all = static_cast<Real>(s.clock().cycle);
  if (!(outer > 0 && outer < all)) return {};
  std::set<std::string> slow;
  for (const BlockPass* pass : world.passes.all<BlockPass>())
    if (subcycle->is_slow(*pass)) slow.insert(pass->name());
  Real seconds = 0;
  for (const PassTimer::Row& row : s.timer().table()) seconds += slow.contains(row.name) ? row.seconds : 0;
  return fmt::format(
      "forces between particles were worked out in one of {:.1f} steps (*COURANT_SUBCYCLE), which spared "
      "some "
      "{:.2g} s",
      all / outer, seconds * (all - outer) / outer);
}

}  // namespace

std::optional<UnitNames> units_of(const Simulation& s) {
  std::vector<Real> speeds;
  for (const PartRange& part : s.guard().ranges()) speeds.push_back(part.c0);
  for (const auto& group : s.world().groups)
    if (group->pushes) speeds.push_back(s.get<ElementLaws>().speed(group->part));
  return guess_units(s.unit_facts(), speeds);
}

void note_end(Summary& y, Simulation& s) {
  const World& world = s.world();
  y.ranges = s.guard().ranges();
  y.time = s.clock().t, y.steps = s.clock().cycle;
  y.active_particles = world.particles.active;
  y.peak_memory_bytes = peak_memory();
  y.energy = world.energy;
  y.counters = world.counters;
  y.maxima = world.maxima;
  y.leaked_particles = y.counters.contains("leaked_particles") ? y.counters.at("leaked_particles") : 0;
  y.max_penetration = y.maxima.contains("max_penetration") ? y.maxima.at("max_penetration") : 0;
  if (const std::int64_t outside = outside_scene(world); outside > 0)
    y.counters["outside_the_scene"] = outside;
  if (!std::isfinite(y.dt_min)) y.dt_min = 0;
  y.notes = idle_contacts(s);
  if (std::string note = subcycle_note(s); !note.empty()) y.notes.push_back(std::move(note));
  if (s.has_particles()) y.counters["neighbour_rebuilds"] = s.neighbours().rebuilds();
  if (const auto units = units_of(s))
    y.mass = units->mass, y.length = units->length, y.time_unit = units->time;
}

void note_times(Summary& summary, const PassTimer& timer) {
  double sum = 0;
  for (const auto& row : timer.table()) {
    summary.passes.push_back({row.name, row.seconds, row.calls});
    sum += row.seconds;
    if (row.name == "output") summary.output.seconds = row.seconds;
  }
  summary.passes.push_back({"rest", summary.read_seconds + summary.wall_seconds - sum, 1});
}

}  // namespace courant
