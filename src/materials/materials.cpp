#include "materials/materials.hpp"

#include <map>

#include <fmt/format.h>

#include "materials/mat_null.hpp"

namespace courant {

std::vector<EosEntry>& eos_registry() {
  static std::vector<EosEntry> registry;
  return registry;
}

void stop_for_density(const World& world, const Clock& clock, Index i) {
  const Particles& p = world.particles;
  const Vec x = p.x.vec(i);
  throw RunError(fmt::format("density of particle {} became {:.4g} [M/L3] at time {:.6g}, cycle {}, x = ({:.5g}, {:.5g}, {:.5g})",
                             p.id[i], p.rho[i], clock.t, clock.cycle, x[0], x[1], x[2]));
}

namespace {

using LawOfId = std::map<Id, std::shared_ptr<EosLaw>>;

LawOfId all_laws(const Deck& deck, Diagnostics& diagnostics) {
  LawOfId laws;
  for (const EosEntry& kind : eos_registry())
    for (const auto& [id, law] : kind.all(deck))
      if (!laws.emplace(id, law).second)
        deck.error(diagnostics, *kind.entry(deck, id), "EOSID", fmt::format("id {} is used twice", id), "ids must be unique");
  return laws;
}

std::string known_laws() {
  std::string names;
  for (const EosEntry& kind : eos_registry()) names += (names.empty() ? "*" : ", *") + kind.keyword;
  return names;
}

}  // namespace

std::vector<PartMaterial> find_materials(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  const LawOfId laws = all_laws(deck, diagnostics);
  std::map<Id, const MatNull*> nulls;
  for (const MatNull& m : deck.all<MatNull>())
    if (!nulls.emplace(m.mid, &m).second)
      deck.error(diagnostics, m, "MID", fmt::format("id {} is used twice", m.mid), "ids must be unique");
  std::vector<PartMaterial> out(model.parts.size());
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const ModelPart& part = model.parts[k];
    if (!part.has_sph) continue;
    const auto null = nulls.find(part.mid);
    const auto law = laws.find(part.eosid);
    if (null == nulls.end())
      diagnostics.error(part.where, fmt::format("*PART {}: its particles need a *MAT_NULL, there is none with id {}", part.id, part.mid),
                        "add the material or correct MID of the part");
    if (law == laws.end())
      diagnostics.error(part.where,
                        fmt::format("*PART {}: its particles need an equation of state, there is none with id {}", part.id, part.eosid),
                        "add one of " + known_laws() + " or correct EOSID of the part");
    if (null == nulls.end() || law == laws.end()) continue;
    out[k] = {true, null->second->ro, null->second->pc, null->second->mu, law->second};
    const Real c2 = law->second->sound_speed2(out[k].ro, 1 / law->second->V0 - 1, law->second->E0);
    if (!(c2 > 0))
      diagnostics.error(part.where, fmt::format("*PART {}: its equation of state gives no sound speed (c^2 = {:.4g})", part.id, c2),
                        "give C1 = rho0 c0^2 (or K0 and GAMMA) > 0");
  }
  return out;
}

void add_eos_passes(World& world, const Model& model, const std::vector<PartMaterial>& materials) {
  Particles& p = world.particles;
  for (Index i = 0; i < p.size(); ++i) {
    const PartMaterial& m = materials[p.part[i]];
    const Real mu = p.rho[i] / m.ro - 1;
    p.E[i] = m.eos->E0;
    p.p[i] = std::max(m.eos->pressure(mu, m.eos->E0), m.pc);
    p.c[i] = std::sqrt(m.eos->sound_speed2(m.ro, mu, m.eos->E0));
  }
  std::map<EosLaw*, EosPart> parts_of_law;
  std::vector<EosLaw*> order;
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    if (!materials[k].found) continue;
    EosPart& mine = parts_of_law[materials[k].eos.get()];
    if (mine.mine.empty()) {
      order.push_back(materials[k].eos.get());
      mine.mine.assign(model.parts.size(), 0);
      mine.rho0.assign(model.parts.size(), 0);
      mine.pc.assign(model.parts.size(), 0);
    }
    mine.mine[k] = 1;
    mine.rho0[k] = materials[k].ro;
    mine.pc[k] = materials[k].pc;
  }
  for (EosLaw* law : order) {
    parts_of_law[law].all_parts = order.size() == 1;
    world.materials.push_back(law->make_pass(parts_of_law[law], world));
  }
}

}  // namespace courant
