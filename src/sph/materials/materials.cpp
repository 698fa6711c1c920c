#include "sph/materials/materials.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "laws/eos/find_eos.hpp"
#include "laws/fluid/mat_null.hpp"
#include "sph/core/fields.hpp"
#include "sph/materials/equation_of_state.hpp"
#include "sph/materials/explosive.hpp"
#include "sph/materials/strength.hpp"

namespace courant {

namespace {

/// Materials that SPH parts may have, by their ids.
struct ParticleMaterials {
  std::map<Id, const MatNull*> fluids;
  std::map<Id, const MatHighExplosive*> explosives;
  std::map<Id, std::shared_ptr<StrengthLaw>> strengths;
  ParticleMaterials(const Deck& deck, const Model& model) {
    for (const MatNull& m : deck.all<MatNull>()) fluids.emplace(m.mid, &m);
    for (const MatHighExplosive& m : deck.all<MatHighExplosive>()) explosives.emplace(m.mid, &m);
    for (const StrengthEntry& kind : strength_registry())
      for (const auto& [id, law] : kind.all(deck, model)) strengths.emplace(id, law);
  }
};

/// Cards that the tables of their keywords cannot judge; those of strength only where particles have it.
void check_cards(const Deck& deck, const Model& model, const ParticleMaterials& known,
                 Diagnostics& diagnostics) {
  for (const EosEntry& kind : eos_registry()) kind.check(deck, model, diagnostics);
  const bool strong = std::any_of(model.parts.begin(), model.parts.end(), [&](const ModelPart& part) {
    return part.has_sph && known.strengths.count(part.mid) > 0;
  });
  const bool solids = std::any_of(model.parts.begin(), model.parts.end(), [](const ModelPart& part) {
    return part.has_solid && !part.rigid;
  });  // which check them, too
  if (strong && !solids)
    for (const StrengthEntry& kind : strength_registry()) kind.check(deck, model, diagnostics);
}

/// Particles stay.
void refuse_erosion(const Deck& deck, const ModelPart& part, const MatNull& m, Diagnostics& diagnostics) {
  for (const auto& [field, value] : {std::pair{"TEROD", m.terod}, std::pair{"CEROD", m.cerod}})
    if (value != 0)
      deck.error(diagnostics, m, field,
                 fmt::format("'{:g}' asks for deletion, and the particles of "
                             "part {} cannot fail",
                             value, part.id),
                 "leave the field blank");
}

/// The name of a history variable in a text.
std::string spelled(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

Real PartMaterial::c0() const {
  const Real bulk = eos ? eos->sound_speed2(ro, 1 / eos->V0 - 1, eos->E0) : 0;
  const Real strong = strength ? strength->sound_speed() : 0;
  return std::sqrt(bulk + strong * strong);
}

bool PartMaterial::starts_at_rest() const {
  if (!eos) return true;
  constexpr Real small = 0.1;
  const Real mu = 1 / eos->V0 - 1;
  return std::abs(eos->pressure(mu, eos->E0)) < small * ro * eos->sound_speed2(ro, mu, eos->E0);
}

// A gas has no pressure without heat; solids have a law of strength.
std::string PartMaterial::stiffness_field() const {
  return found && eos && !strength && holds_cold() && starts_at_rest() ? eos->stiffness_field()
                                                                       : std::string();
}

SphMaterial PartMaterial::for_particles() const {
  if (!found) return {};
  return {ro, eos ? eos->V0 : 1, pc, mu, eos && eos->uses_energy(), strength};
}

std::vector<PartMaterial> find_materials(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  const ParticleMaterials known(deck, model);
  check_cards(deck, model, known, diagnostics);
  PartEos laws(deck, model);
  std::vector<PartMaterial> out(model.parts.size());
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const ModelPart& part = model.parts[k];
    if (!part.has_sph) continue;
    const auto fluid = known.fluids.find(part.mid);
    const auto strength = known.strengths.find(part.mid);
    const auto explosive = known.explosives.find(part.mid);
    const bool burns = explosive != known.explosives.end();
    const bool missing = fluid == known.fluids.end() && strength == known.strengths.end() && !burns;
    const bool alone = strength != known.strengths.end() && !strength->second->deviator_only();
    if (missing)
      deck.error(
          diagnostics, part.card, "MID",
          fmt::format("the particles of part {} need a *MAT_NULL or a material with strength, id {}; {}",
                      part.id, part.mid, deck.found_instead(IdSpace::material, part.mid)),
          "add the material, or correct the id here");
    const bool unused_eos = alone && part.eosid != 0 && !strength->second->takes_equation_of_state();
    if (unused_eos)
      deck.error(diagnostics, part.card, "EOSID",
                 fmt::format("expected 0, got '{}': the material of part {} has a pressure of its own",
                             part.eosid, part.id),
                 "leave the field blank, or use a material that gives the "
                 "deviator only");
    const bool known_eos = alone || laws.exists(deck, part, "particles", diagnostics);
    if (missing || !known_eos || unused_eos) continue;
    PartMaterial& m = out[k];
    m.found = true;
    if (fluid != known.fluids.end()) {
      m.ro = fluid->second->ro, m.pc = fluid->second->pc, m.mu = fluid->second->mu;
      refuse_erosion(deck, part, *fluid->second, diagnostics);
    } else if (burns) {
      m.ro = explosive->second->ro, m.pc = no_cutoff;
      explosive->second->check(deck, diagnostics);
    } else {
      m.strength = strength->second;
      if (m.strength->axes())
        deck.error(
            diagnostics, part.card, "MID",
            fmt::format("directions of a material in particles, as those of part {}, are not supported",
                        part.id),
            "particles take isotropic materials");
      if (std::isfinite(m.strength->failure_limit()))
        deck.error(diagnostics, part.card, "MID",
                   fmt::format("the material of part {} fails at a {} of {:g}, "
                               "and particles cannot fail",
                               part.id, spelled(m.strength->failure_variable()), m.strength->failure_limit()),
                   "leave FS or FAIL of the material blank, or set EROD of "
                   "*MAT_JOHNSON_COOK");
      m.ro = m.strength->ro, m.pc = m.strength->pressure_cutoff();
    }
    if (alone) continue;
    m.eos = laws.find(deck, part, m.ro, "particles", diagnostics);
    if (burns && m.eos && !m.eos->uses_energy())
      deck.error(diagnostics, part.card, "EOSID",
                 fmt::format("the explosive of part {} needs an equation of state that depends on its energy",
                             part.id),
                 "give *EOS_JWL with OMEG > 0 and E0");
  }
  return out;
}

std::string parts_of_several_materials(const Model& model) {
  const ModelPart* first = nullptr;
  for (const ModelPart& part : model.parts) {
    if (!part.has_sph) continue;
    if (first == nullptr) first = &part;
    if (part.mid != first->mid || part.eosid != first->eosid)
      return fmt::format("parts {} and {} differ in MID or EOSID", first->id, part.id);
  }
  return {};
}

namespace {

const Field<Real>& set_least_pressures(const std::vector<PartMaterial>& materials, Particles& p) {
  Field<Real>& least = sph_fields::least_pressure(p);
  for (Index i = 0; i < p.size(); ++i) least[i] = std::max(materials[p.part[i]].pc, no_cutoff);
  return least;
}

}  // namespace

void add_equations_of_state(World& world, const Model& model, const std::vector<PartMaterial>& materials,
                            const SphSettings& s) {
  Particles& p = world.particles;
  const Field<Real>* burnt = burn_fraction.find(p.fields);
  for (Index i = 0; i < p.size(); ++i) {
    const PartMaterial& m = materials[p.part[i]];
    if (!m.eos) continue;
    const Real mu = p.rho[i] / m.ro - 1;
    p.E[i] = m.eos->E0;
    p.p[i] = std::max((burnt ? (*burnt)[i] : 1) * m.eos->pressure(mu, m.eos->E0), m.pc);
    p.c[i] = std::sqrt(m.eos->sound_speed2(m.ro, mu, m.eos->E0));
  }
  const bool warm = !s.heat_in_internal.empty(), strong = !s.strength.empty();
  std::vector<const Field<Real>*> heat{warm ? &add_viscous_heat(s, world) : &sph_fields::dissipation(p)};
  if (!s.mu.empty()) heat.push_back(&sph_fields::viscous_dissipation(p));
  const Field<Real>* least_pressure = warm && strong ? &set_least_pressures(materials, p) : nullptr;
  std::map<EosLaw*, EosParts> parts_of_law;
  std::vector<std::shared_ptr<EosLaw>> order;
  bool some_without = false;
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    some_without |= materials[k].found && !materials[k].eos;
    if (!materials[k].eos) continue;
    EosParts& mine = parts_of_law[materials[k].eos.get()];
    if (mine.mine.empty()) {
      order.push_back(materials[k].eos);
      mine.mine.assign(model.parts.size(), 0);
      mine.rho0.assign(model.parts.size(), 0);
      mine.pc.assign(model.parts.size(), 0);
      mine.least_pressure = least_pressure, mine.burnt = burnt;
    }
    mine.mine[k] = 1;
    mine.rho0[k] = materials[k].ro;
    mine.pc[k] = materials[k].pc;
  }
  for (const auto& law : order) {
    parts_of_law[law.get()].all_parts = order.size() == 1 && !some_without;
    world.passes.add(std::make_shared<EquationOfState>(law, parts_of_law[law.get()], heat, world));
  }
}

}  // namespace courant
