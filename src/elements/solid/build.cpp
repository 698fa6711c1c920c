#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "elements/solid/section_solid.hpp"
#include "elements/solid/solid_axes.hpp"
#include "elements/solid/solids.hpp"
#include "laws/eos/find_eos.hpp"
#include "laws/fluid/mat_null.hpp"
#include "laws/strength/material_axes.hpp"

namespace courant {

namespace {

/// Laws of the materials that solids may have, by id.
class SolidLaws {
 public:
  SolidLaws(const Deck& deck, const Model& model) : eos_(deck, model) {
    for (const StrengthEntry& kind : strength_registry()) {
      const bool is_material = !kind.keyword.starts_with("MAT_ADD_");
      if (is_material && !tells_directions(kind.keyword)) known_ += "*" + kind.keyword + ", ";
      for (const auto& [id, law] : kind.all(deck, model)) laws_.emplace(id, law);
    }
    for (const MatNull& fluid : deck.all<MatNull>()) laws_.emplace(fluid.mid, fluid.law());
  }

  void take(const Deck& deck, const ModelPart& part, SolidPart& out, Diagnostics& diagnostics) {
    const auto law = laws_.find(part.mid);
    if (law == laws_.end()) {
      deck.error(diagnostics, part.card, "MID",
                 fmt::format("the solids of part {} need a *MAT_NULL or a material with strength, id {}; {}",
                             part.id, part.mid, deck.found_instead(IdSpace::material, part.mid)),
                 "add one of " + known_ + "*MAT_NULL, or a *MAT_RIGID, and give its id here");
      return;
    }
    if (law->second->axes() && law->second->in_sheets())
      deck.error(diagnostics, part.card, "MID",
                 fmt::format("this material in solids, as those of part {}, is not supported: its directions "
                             "are those of shells",
                             part.id),
                 "solids take isotropic materials, *MAT_HONEYCOMB and *MAT_ORTHOTROPIC_ELASTIC");
    if (law->second->deviator_only()) {
      const auto eos = eos_.find(deck, part, law->second->ro, "solids", diagnostics);
      if (!eos) return;
      out.pressure = std::make_shared<SolidPressure>(eos, law->second);
      const bool fluid = law->second->shear_modulus() == 0, one_point = out.formulation->points == 1;
      if (const char* whose = out.formulation->nodal_pressure      ? "volumes at their nodes"
                              : out.formulation->linear_dilatation ? "volumes of elements"
                                                                   : nullptr;
          fluid && whose)
        deck.warning(
            diagnostics, part.card, "SECID",
            fmt::format(
                "the solids of part {} are a fluid, and nothing resists motions that keep the mean {}",
                part.id, whose),
            "ELFORM 10 resists them");
      if (fluid && one_point && out.viscosity.ihq == 6)
        deck.error(diagnostics, part.card, "HGID",
                   fmt::format("the solids of part {} are a fluid, and IHQ 6 goes by moduli that it has not",
                               part.id),
                   "IHQ 1 to 3 are viscous");
      else if (fluid && one_point && !out.formulation->nodal_pressure && out.viscosity.ihq >= 4)
        deck.warning(diagnostics, part.card, "HGID",
                     fmt::format("the solids of part {} are a fluid, and IHQ "
                                 "{} is a stiffness: elements that flow "
                                 "store energy in it",
                                 part.id, out.viscosity.ihq),
                     "IHQ 1 to 3 are viscous");
    } else if (part.eosid != 0 && !law->second->takes_equation_of_state()) {
      deck.warning(diagnostics, part.card, "EOSID",
                   fmt::format("has no effect: the material of part {} has a "
                               "pressure of its own",
                               part.id),
                   "leave the field blank, or use a material that gives the "
                   "deviator only");
    }
    out.law = law->second;
  }

 private:
  PartEos eos_;
  std::map<Id, std::shared_ptr<StrengthLaw>> laws_;
  std::string known_;
};

}  // namespace

std::vector<SolidPart> find_solid_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  std::vector<SolidPart> out(model.parts.size());
  bool any = false;
  for (const ModelPart& part : model.parts) any = any || (part.has_solid && !part.rigid);
  if (!any) return out;
  check_solid_sections(deck, model, diagnostics);
  const std::vector<SolidViscosity> viscosity = read_solid_viscosity(deck, model, diagnostics);
  const int errors = diagnostics.errors();
  for (const StrengthEntry& kind : strength_registry()) kind.check(deck, model, diagnostics);
  if (diagnostics.errors() > errors) return out;  // a law is made from valid cards
  SolidLaws laws(deck, model);
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const ModelPart& part = model.parts[k];
    if (!part.has_solid || part.rigid) continue;
    out[k].viscosity = viscosity[k], out[k].formulation = &solid_formulation(deck, part);
    laws.take(deck, part, out[k], diagnostics);
    if (out[k].law && out[k].law->axes())
      check_directions(deck, model, static_cast<Index>(k), *out[k].law->axes(), diagnostics);
  }
  return out;
}

SolidControl control_of(const SolidPart& part) {
  SolidControl out{.hourglass = part.viscosity.ihq,
                   .QM = part.viscosity.qm,
                   .Q1 = part.viscosity.q1,
                   .Q2 = part.viscosity.q2,
                   .MU = part.law->viscosity()};
  const Real resolved = part.formulation->resolved_length;
  out.Q1 *= resolved * resolved, out.Q2 *= resolved;
  if (!part.law->bulk_viscosity) out.Q1 = out.Q2 = 0;
  const Real K = part.bulk_modulus(), G = part.law->shear_modulus();
  constexpr Real usual = 13.0 / 6;  // K/G with a Poisson's ratio of 0.3
  if (part.formulation->linear_dilatation && !part.pressure)
    out.dilatation = G > 0 ? std::sqrt(std::min<Real>(1, usual * G / K)) : 1;
  if (!(G > 0)) return out;  // a fluid
  out.G = G, out.E = 9 * K * G / (3 * K + G), out.nu = out.E / (2 * G) - 1;
  out.plate_modulus = out.E / (1 - out.nu * out.nu);
  return out;
}

namespace {

/// Nodes at the corners of a group: ten or twenty, those of a hexahedron, or of these the different ones of
/// pentahedra and tetrahedra.
std::array<Index, 20> corners_of(const ModelSolid& solid, int corners) {
  const std::array<Index, 20> all = solid.all_corners();
  if (corners == 4) return {all[0], all[1], all[2], all[4]};
  if (corners == 6) return {all[0], all[1], all[2], all[3], all[4], all[6]};
  return all;
}

}  // namespace

void build_solids(const Model& model, const std::vector<SolidPart>& parts, const std::vector<Index>& node_of,
                  World& world) {
  std::vector<std::vector<const ModelSolid*>> of_part(model.parts.size());
  for (const ModelSolid& solid : model.solids) of_part[solid.part].push_back(&solid);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (!parts[k].law || of_part[k].empty()) continue;
    FieldSet& set = world.add_set(fmt::format("solids of part {}", model.parts[k].id));
    set.resize(static_cast<Index>(of_part[k].size()));
    const int corners = parts[k].formulation->corners;
    ElementGroup& group =
        *world.groups.emplace_back(std::make_unique<ElementGroup>(set, static_cast<Index>(k), corners));
    if (const auto& shares = parts[k].formulation->mass_shares; shares[0] > 0)
      group.shares.assign(shares, shares + corners);
    for (Index e = 0; e < group.size(); ++e) {
      const ModelSolid& solid = *of_part[k][e];
      group.id[e] = solid.id;
      const std::array<Index, 20> corner = corners_of(solid, corners);
      group.repeats_nodes = group.repeats_nodes || solid.different_nodes() < corners;
      for (int c = 0; c < corners; ++c)
        group.node.data(c)[e] = node_of[static_cast<std::size_t>(corner[static_cast<std::size_t>(c)])];
    }
  }
}

}  // namespace courant
