#include <cmath>

#include <fmt/format.h>

#include "app/simulation.hpp"

namespace courant {

namespace {

struct PartTotals {
  Index particles = 0, shells = 0;
  Real mass = 0, rho = 0, c = 0, h = 0, speed = 0;
};

std::string part_table(const Simulation& s) {
  std::vector<PartTotals> totals(s.model().parts.size());
  const Particles& p = s.world().particles;
  for (Index i = 0; i < p.size(); ++i) {
    PartTotals& t = totals[p.part[i]];
    ++t.particles;
    t.mass += p.m[i];
    t.rho = std::max(t.rho, p.rho[i]), t.c = std::max(t.c, p.c[i]), t.h = std::max(t.h, p.h[i]);
    t.speed = std::max(t.speed, p.v.vec(i).norm());
  }
  for (const ModelShell& shell : s.model().shells) ++totals[shell.part].shells;
  if (s.bodies())
    for (const RigidBodyReport& body : s.bodies()->reports())
      totals[s.model().part_of_id.at(body.part)].mass = body.mass;
  std::string text =
      "     part particles    shells         mass      density  sound speed            h    max speed  "
      "title\n";
  for (std::size_t k = 0; k < totals.size(); ++k) {
    const PartTotals& t = totals[k];
    text += fmt::format("{:9}{:10}{:10}{:13.5g}{:13.5g}{:13.5g}{:13.5g}{:13.5g}  {}\n", s.model().parts[k].id,
                        t.particles, t.shells, t.mass, t.rho, t.c, t.h, t.speed, s.model().parts[k].title);
  }
  return text;
}

/// Reads the unit system from the density of the first fluid, if it looks like water in a common one.
std::string units(const Simulation& s) {
  struct System {
    Real rho;
    const char* name;
  };
  const System systems[] = {{1000, "kg, m, s: Pa, J"},
                            {1e-9, "tonne, mm, s: MPa, mJ"},
                            {1e-6, "kg, mm, ms: GPa, J"},
                            {1, "g, cm, us: Mbar"}};
  for (const PartMaterial& m : s.materials())
    if (m.found)
      for (const System& u : systems)
        if (std::abs(m.ro / u.rho - 1) < 0.05) return fmt::format("RO = {:g} is water in {}", m.ro, u.name);
  return "the densities are not water's in kg-m-s, tonne-mm-s, kg-mm-ms or g-cm-us: check the units";
}

}  // namespace

namespace {

Real mean_neighbours(const Simulation& s) {
  const Particles& p = s.world().particles;
  if (p.active == 0) return 0;
  return sum(p.active, [&](Index i) { return static_cast<Real>(s.neighbours().of(p, i).size()); }) / p.active;
}

}  // namespace

std::string check_report(Simulation& s) {
  std::string who;
  s.evaluate(who);
  const Particles& p = s.world().particles;
  std::string text = fmt::format("{}\nfiles read:\n", s.model().title);
  for (const DeckFile& file : s.deck().files) text += "  " + file.name + "\n";
  text += "keywords:\n";
  for (const auto& [name, use] : s.deck().keywords) text += fmt::format("  {:<44}{:8}\n", name, use.blocks);
  text += part_table(s);
  text += fmt::format(
      "{}D, spacing {:.6g} [L], {} particles of which {} are active now, {:.1f} neighbours each\n",
      s.world().dim, s.sph().spacing, p.size(), p.active, mean_neighbours(s));
  text += fmt::format("units: {}\n", units(s));
  text += fmt::format("first step {:.5g} [T], set by {}; {:.0f} steps to ENDTIM = {:g} at this size\n",
                      s.clock().dt, who, std::ceil(s.model().endtim / s.clock().dt), s.model().endtim);
  const auto& counters = s.world().counters;
  if (const auto found = counters.find("initial_penetrations"); found != counters.end())
    text += fmt::format("initial penetrations: {}\n", found->second);
  return text + s.passes();
}

}  // namespace courant
