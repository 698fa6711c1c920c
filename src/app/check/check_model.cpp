// `courant check`, second part: what a run of a sound deck would compute.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "app/check/check.hpp"
#include "elements/element_laws.hpp"
#include "extension/additions.hpp"
#include "parallel/parallel.hpp"
#include "search/nearest_distance.hpp"
#include "sph/options/subcycle.hpp"
#include "state/subcycle.hpp"

namespace courant {

namespace {

using PartRow = ModelFacts::Part;
constexpr Real none = PartRow::none;

std::string cell(Real value) {
  return value == none ? fmt::format("{:>10}", "-") : fmt::format("{:10.4g}", value);
}

/// Nearest-neighbour distances within each part.
void measure_spacing(const Particles& p, std::vector<PartRow>& rows) {
  struct Points {
    std::vector<Real> x, y, z;
  };
  std::vector<Points> points(rows.size());
  for (Index i = 0; i < p.size(); ++i) {
    Points& of_part = points[p.part[i]];
    const Vec x = p.x.vec(i);
    of_part.x.push_back(x[0]), of_part.y.push_back(x[1]), of_part.z.push_back(x[2]);
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Points& of_part = points[k];
    for (const Real d : nearest_distance(of_part.x.data(), of_part.y.data(), of_part.z.data(),
                                         static_cast<Index>(of_part.x.size()))) {
      if (!std::isfinite(d)) continue;
      rows[k].spacing = std::max(rows[k].spacing, d);
      rows[k].nearest = std::min(rows[k].nearest, d);
    }
  }
}

void add_particles(const Simulation& s, std::vector<PartRow>& rows) {
  const Particles& p = s.world().particles;
  for (Index i = 0; i < p.size(); ++i) {
    PartRow& row = rows[p.part[i]];
    if (row.elements++ == 0) row.kind = "sph", row.mass = row.volume = 0;
    row.mass += p.m[i];
    row.volume += p.m[i] / p.rho[i];
    row.rho = std::max(row.rho, p.rho[i]), row.c = std::max(row.c, p.c[i]), row.h = std::max(row.h, p.h[i]);
    row.speed = std::max(row.speed, p.v.vec(i).norm());
  }
  measure_spacing(p, rows);
}

Real area_of(const World& world, Index segment) {
  const auto n = world.segments.nodes(segment);
  const auto x = [&](std::size_t k) { return world.nodes.x.vec(n[k]); };
  return n[2] == n[3] ? 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm()
                      : 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
}

void add_shells(const Simulation& s, std::vector<PartRow>& rows) {
  const World& world = s.world();
  std::vector<Real> area(rows.size(), 0);
  for (Index k = 0; k < world.segments.size(); ++k) {
    if (world.segments.volume[k] > 0) continue;  // the skin of solids
    const Index part = world.segments.part[k];
    PartRow& row = rows[part];
    if (row.elements++ == 0) row.kind = "shell", row.volume = 0;
    const Real a = area_of(world, k);
    area[part] += a;
    row.volume += a * world.segments.thickness[k];
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (area[k] == 0) continue;
    rows[k].spacing = std::sqrt(area[k] / rows[k].elements);
    if (const auto m = rigid_material(s.deck(), s.model(), static_cast<Index>(k))) rows[k].rho = m->ro;
  }
  if (s.bodies())
    for (const RigidBodyReport& body : s.bodies()->reports()) {
      const auto at = s.model().part_of_id.find(body.part);
      if (at == s.model().part_of_id.end()) continue;  // of nodes
      PartRow& row = rows[at->second];
      row.kind = "rigid";
      row.mass = body.mass;
      row.speed = body.v.norm();
    }
  if (s.bodies())
    for (const RigidBody& b : s.bodies()->bodies()) {
      for (const Index part : b.parts) rows[static_cast<std::size_t>(part)].kind = "rigid";
      if (b.solids == 0) continue;
      PartRow& row = rows[static_cast<std::size_t>(b.part_index)];
      row.elements = b.solids, row.volume = b.volume, row.rho = b.m / b.volume;
      row.spacing = std::cbrt(b.volume / b.solids);
    }
}

void add_speed(const World& world, const ElementGroup& group, PartRow& row) {
  for (int c = 0; c < group.corners(); ++c)
    for (Index e = 0; e < group.size(); ++e)
      row.speed = std::max(row.speed, world.nodes.v.vec(group.node.data(c)[e]).norm());
}

Real shortest_of(const World& world, const ElementGroup& lines) {
  return -maximum(lines.size(), [&](Index e) {
    return -(world.nodes.x.vec(lines.node.data(1)[e]) - world.nodes.x.vec(lines.node.data(0)[e])).norm();
  });
}

void add_solids(const Simulation& s, std::vector<PartRow>& rows) {
  const World& world = s.world();
  const ElementLaws& laws = s.get<ElementLaws>();
  for (const auto& group : world.groups) {
    if (group->part == no_part) continue;
    PartRow& row = rows[group->part];
    const auto& of_elements = laws.of_part[static_cast<std::size_t>(group->part)];
    if (!of_elements) {
      row = PartRow();
      row.elements = group->size(), row.kind = "spring", row.mass = 0;
      add_speed(world, *group, row);
      continue;
    }
    const StrengthLaw& law = *of_elements;
    if (group->segment) {  // counted with the faces
      row.rho = law.ro;
      if (group->pushes) row.c = law.sound_speed();
      if (row.mass == none) row.mass = 0;
      for (Index e = 0; e < group->size(); ++e) row.mass += group->mass[e];
      add_speed(world, *group, row);
      continue;
    }
    row = PartRow();
    const bool beams = group->corners() == 2;
    row.elements = group->size(), row.kind = beams ? "beam" : "solid", row.mass = row.volume = 0;
    row.rho = law.ro;
    if (group->pushes) row.c = laws.speed(group->part);
    for (Index e = 0; e < group->size(); ++e) row.mass += group->mass[e], row.volume += group->V0[e];
    row.spacing = std::cbrt(row.volume / row.elements);
    if (beams) row.spacing = shortest_of(world, *group);
    add_speed(world, *group, row);
  }
}

/// Of a body that can turn: what it has, and with all mass at its nodes.
std::string inertia_text(const Simulation& s, Id part) {
  if (!s.bodies()) return {};
  for (const RigidBody& b : s.bodies()->bodies()) {
    const Id lead = b.part;
    if (lead != part && b.has_part(s.model().part_of_id.at(part)))
      return fmt::format("  part {}: merged into part {}, whose row has the mass of both\n", part, lead);
    if (b.part != part || (b.no_turn[0] && b.no_turn[1] && b.no_turn[2])) continue;
    const Vec own = b.J0.diagonal(), lumped = b.J_lumped.diagonal();
    return fmt::format(
        "  part {}: Jxx, Jyy, Jzz {:.5g} {:.5g} {:.5g} [ML2]; were all mass at the nodes {:.5g} {:.5g} "
        "{:.5g}\n",
        part, own[0], own[1], own[2], lumped[0], lumped[1], lumped[2]);
  }
  return {};
}

std::string part_table(const Simulation& s, std::vector<PartRow>& rows) {
  rows.resize(s.model().parts.size());
  add_particles(s, rows);
  add_shells(s, rows);
  add_solids(s, rows);
  std::string text =
      fmt::format("Parts in the run\n{:>8} {:<15}{:>9} {:<5}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "part",
                  "title", "elements", "kind", "mass", "volume", "density", "sound", "spacing", "h");
  std::string remarks;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    PartRow& r = rows[k];
    const ModelPart& part = s.model().parts[k];
    r.id = part.id, r.title = part.title;
    text += fmt::format("{:>8} {:<15.15}{:>9} {:<5}{}{}{}{}{}{}\n", part.id, part.title, r.elements, r.kind,
                        cell(r.mass), cell(r.volume), cell(r.rho), cell(r.c), cell(r.spacing), cell(r.h));
    if (r.speed > 0)
      remarks += fmt::format("  part {}: initial speed up to {:.4g} [L/T]{}\n", part.id, r.speed,
                             r.c > 0 ? fmt::format(", {:.2g} of its sound speed", r.speed / r.c) : "");
    if (r.nearest < 0.9 * r.spacing)
      remarks += fmt::format("  part {}: nearest neighbours are {:.4g} to {:.4g} [L] apart\n", part.id,
                             r.nearest, r.spacing);
    remarks += inertia_text(s, part.id);
    if (r.elements == 0) remarks += fmt::format("  part {}: no elements\n", part.id);
  }
  return text + remarks;
}

Real mean_neighbours(const Simulation& s) {
  const Particles& p = s.world().particles;
  if (p.active == 0) return 0;
  return sum(p.active, [&](Index i) { return static_cast<Real>(s.neighbours().of(p, i).size()); }) / p.active;
}

std::string duration(double seconds) {
  if (seconds < 1.5) return "1 s";
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 172800) return fmt::format("{:.1f} h", seconds / 3600);
  return fmt::format("{:.1f} days", seconds / 86400);
}

/// More evaluations of the forces, timed. At the start no time has passed, so they give the same again. It is
/// the processor time of all threads, and the least of some: what else the machine does has no part in it.
double seconds_per_step(Simulation& s) {
  constexpr int most = 5;
  constexpr double enough = 0.5;  // seconds for all
  double least = std::numeric_limits<double>::infinity(), all = 0;
  for (int k = 0; k < most && all < enough; ++k) {
    const std::clock_t begin = std::clock();
    std::string who;
    s.evaluate(who);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    least = std::min(least, seconds), all += seconds;
  }
  constexpr double motion_and_lists = 1.3;  // what a step does besides, see docs/performance.md
  return motion_and_lists * least;
}

/// `limit`: of particles [T]
std::string subcycle_text(Simulation& s, Real limit) {
  const Subcycle* subcycle = Subcycle::of(s.world());
  if (const int steps = subcycle ? subcycle->steps_at(s.clock().dt) : 1; steps > 1)
    return fmt::format("  forces between particles are those of one step in {} (*COURANT_SUBCYCLE)\n", steps);
  std::string why = subcycle ? subcycle->why_off() : s.get<SubcycleChoice>().why_not;
  if (subcycle && why.empty()) why = "the springs of contact are too stiff";
  const Real ratio = std::floor(limit / s.clock().dt * (1 + 1e-9));
  if (!(ratio >= 2) || why.empty()) return {};
  return fmt::format("  note: forces between particles would be needed in one step of {:.0f}, but {}\n",
                     ratio, why);
}

std::string step_text(Simulation& s, const std::string& who, ModelFacts& facts) {
  const double seconds = seconds_per_step(s);
  const Real dt = s.clock().dt, endtim = s.model().endtim;
  const double steps = std::ceil(endtim / dt);
  facts.dt = dt, facts.endtim = endtim, facts.set_by = who, facts.steps = steps;
  facts.seconds = steps * seconds;
  std::string text = fmt::format("First step {:.5g} [T], set by {}\n", dt, who);
  Real particles = 0;
  for (TimeLimit* limit : s.world().passes.all<TimeLimit>()) {
    const TimeLimit::Limit one = limit->limit(s.world(), s.clock());
    if (limit->name() == "sph time step") particles = one.dt;
    if (std::isfinite(one.dt) && one.who != who)
      text += fmt::format("  {} would allow {:.5g}\n", one.who, one.dt);
  }
  text += subcycle_text(s, particles);
  return text +
         fmt::format("  {:.0f} steps to ENDTIM = {:g} at this size; on one thread of this machine about {}\n",
                     steps, endtim, duration(steps * seconds));
}

}  // namespace

std::vector<Real> ModelFacts::sound_speeds() const {
  std::vector<Real> out;
  for (const Part& part : parts)
    if (part.c != Part::none) out.push_back(part.c);
  return out;
}

std::string model_text(Simulation& s, ModelFacts& facts) {
  std::string who;
  s.evaluate(who);
  const Particles& p = s.world().particles;
  std::string text = part_table(s, facts.parts);
  facts.dim = s.world().dim, facts.particles = p.size();
  if (p.size() > 0) {
    facts.spacing = s.sph().spacing, facts.active = p.active, facts.neighbours = mean_neighbours(s);
    text += fmt::format(
        "  {}D, spacing {:.6g} [L], {} particles of which {} are active now, {:.1f} neighbours each\n",
        facts.dim, facts.spacing, facts.particles, facts.active, facts.neighbours);
  }
  const auto& counters = s.world().counters;
  if (const auto found = counters.find("initial_penetrations"); found != counters.end())
    text += fmt::format("  initial penetrations: {}\n", found->second);
  const std::string passes = s.passes();
  text += step_text(s, who, facts);
  facts.advice = choice_advice(s, facts);
  return text + walls_text(s) + advice_text(facts.advice) + passes;
}

}  // namespace courant
