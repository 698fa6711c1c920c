#include "sph/materials.hpp"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "laws/fluid/mat_null.hpp"
#include "sph/equation_of_state.hpp"
#include "sph/fields.hpp"

namespace courant {

namespace {

using LawOfId = std::map<Id, std::shared_ptr<EosLaw>>;
/// Parts with the same law and the same reference density share one pass.
using LawOfDensity = std::map<std::pair<Id, Real>, std::shared_ptr<EosLaw>>;

LawOfId all_laws(const Deck& deck) {
  LawOfId laws;
  for (const EosEntry& kind : eos_registry())
    for (const auto& [id, law] : kind.all(deck)) laws.emplace(id, law);
  return laws;
}

std::shared_ptr<EosLaw> law_at_density(LawOfDensity& known, Id id, const std::shared_ptr<EosLaw>& law,
                                       Real rho0) {
  auto& found = known[{id, rho0}];
  if (!found) found = law->at_density(rho0);
  return found ? found : found = law;
}

std::string known_laws() {
  std::string names;
  for (const EosEntry& kind : eos_registry()) names += (names.empty() ? "*" : ", *") + kind.keyword;
  return names;
}

}  // namespace

std::vector<PartMaterial> find_materials(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  for (const EosEntry& kind : eos_registry()) kind.check(deck, diagnostics);
  const LawOfId laws = all_laws(deck);
  LawOfDensity laws_of_density;
  std::map<Id, const MatNull*> nulls;
  for (const MatNull& m : deck.all<MatNull>()) nulls.emplace(m.mid, &m);
  std::vector<PartMaterial> out(model.parts.size());
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const ModelPart& part = model.parts[k];
    if (!part.has_sph) continue;
    const auto null = nulls.find(part.mid);
    const auto law = laws.find(part.eosid);
    if (null == nulls.end())
      deck.error(diagnostics, part.card, "MID",
                 fmt::format("the particles of part {} need a *MAT_NULL with id {}; {}", part.id, part.mid,
                             deck.found_instead(IdSpace::material, part.mid)),
                 "add the material, or correct the id here");
    if (law == laws.end())
      deck.error(diagnostics, part.card, "EOSID",
                 part.eosid == 0
                     ? fmt::format("the particles of part {} need an equation of state, got none", part.id)
                     : fmt::format("there is no equation of state with id {} for the particles of part {}",
                                   part.eosid, part.id),
                 "add one of " + known_laws() + " and give its id here");
    if (null == nulls.end() || law == laws.end()) continue;
    const MatNull& material = *null->second;
    const auto eos = law_at_density(laws_of_density, part.eosid, law->second, material.ro);
    out[k] = {true, material.ro, material.pc, material.mu, eos};
    const Real mu = 1 / eos->V0 - 1, c2 = eos->sound_speed2(out[k].ro, mu, eos->E0);
    if (!(mu < eos->mu_limit()))
      deck.error(
          diagnostics, part.card, "EOSID",
          fmt::format("part {} starts beyond the end of equation of state {}: rho/RO = {:g}, the law ends "
                      "at {:g}",
                      part.id, part.eosid, 1 + mu, 1 + eos->mu_limit()),
          "correct V0 of the equation of state");
    else if (!(c2 > 0))
      deck.error(
          diagnostics, part.card, "EOSID",
          fmt::format("equation of state {} gives part {} no sound speed: c^2 = {:.4g} [L2/T2] at the start",
                      part.eosid, part.id, c2),
          "give it a bulk modulus > 0: C1 = RO c0^2 of *EOS_LINEAR_POLYNOMIAL, K0 and GAMMA of "
          "*EOS_MURNAGHAN");
  }
  return out;
}

void add_equations_of_state(World& world, const Model& model, const std::vector<PartMaterial>& materials,
                            bool viscous) {
  Particles& p = world.particles;
  for (Index i = 0; i < p.size(); ++i) {
    const PartMaterial& m = materials[p.part[i]];
    const Real mu = p.rho[i] / m.ro - 1;
    p.E[i] = m.eos->E0;
    p.p[i] = std::max(m.eos->pressure(mu, m.eos->E0), m.pc);
    p.c[i] = std::sqrt(m.eos->sound_speed2(m.ro, mu, m.eos->E0));
  }
  std::vector<const Field<Real>*> heat{&sph_fields::dissipation(p)};
  if (viscous) heat.push_back(&sph_fields::viscous_dissipation(p));
  std::map<EosLaw*, EosParts> parts_of_law;
  std::vector<std::shared_ptr<EosLaw>> order;
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    if (!materials[k].found) continue;
    EosParts& mine = parts_of_law[materials[k].eos.get()];
    if (mine.mine.empty()) {
      order.push_back(materials[k].eos);
      mine.mine.assign(model.parts.size(), 0);
      mine.rho0.assign(model.parts.size(), 0);
      mine.pc.assign(model.parts.size(), 0);
    }
    mine.mine[k] = 1;
    mine.rho0[k] = materials[k].ro;
    mine.pc[k] = materials[k].pc;
  }
  for (const auto& law : order) {
    parts_of_law[law.get()].all_parts = order.size() == 1;
    world.passes.add(std::make_shared<EquationOfState>(law, parts_of_law[law.get()], heat, world));
  }
}

}  // namespace courant
