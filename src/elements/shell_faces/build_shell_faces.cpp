#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "elements/shell_faces/section_shell.hpp"
#include "elements/shell_faces/shell_faces.hpp"
#include "state/shared_fields.hpp"

namespace courant {
namespace {

struct WallPart {
  bool usable = false;
  ShellMaterial material;
  Real thickness = 0;  ///< [L]
  Real marea = 0;      ///< [M/L2]
};

void check_rigid_layups(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  for (const ModelLayup& layup : model.layups) {
    const ModelPart& part = model.parts[layup.part];
    if (part.rigid && std::any_of(layup.plies.begin(), layup.plies.end(),
                                  [&](const ModelPly& ply) { return ply.mid != part.mid; }))
      deck.error(diagnostics, layup.card, "MID1",
                 fmt::format("part {} is rigid, and a layer of this shell is not of its material", part.id),
                 "give all layers the *MAT_RIGID of the part, or the part another material");
  }
}

void warn_of_offsets(const Deck& deck, const Model& model, const ShellSections& sections,
                     Diagnostics& diagnostics) {
  std::set<Index> offset;
  for (const auto& [shell, height] : model.shell_offset)
    if (height != 0) offset.insert(model.shells[shell].part);
  for (Index k = 0; k < Index(model.parts.size()); ++k) {
    const ModelPart& part = model.parts[k];
    const SectionShell* const s = part.has_shell && part.rigid ? sections.of(part) : nullptr;
    if (s && (s->nloc != 0 || offset.contains(k)))
      deck.warning(diagnostics, *s, "NLOC",
                   fmt::format("the shells of part {} are rigid: their mass and their faces stay where the "
                               "nodes are",
                               part.id),
                   "offsets are for shells that deform");
  }
}

std::vector<WallPart> read_parts(const Deck& deck, const Model& model,
                                 const std::function<std::optional<ShellMaterial>(Index, Index)>& material,
                                 Diagnostics& diagnostics) {
  const ShellSections sections(deck, model);
  for (const SectionShell& s : deck.all<SectionShell>()) {
    if (s.user_defined())
      deck.error(diagnostics, s, "ELFORM",
                 fmt::format("user-defined shells ({}) are not supported", s.elform),
                 "use 2 (Belytschko-Tsay)");
    if (s.of_plane_solids())
      deck.error(diagnostics, s, "ELFORM", fmt::format("{} is a 2D solid, not a shell", s.elform),
                 "use 2 (Belytschko-Tsay)");
  }
  check_rigid_layups(deck, model, diagnostics);
  warn_of_offsets(deck, model, sections, diagnostics);
  const std::vector<bool> by_part = parts_with_own_layers(model);
  std::vector<WallPart> out(model.parts.size());
  std::set<const SectionShell*> told;  // several parts may name one
  for (Index k = 0; k < Index(model.parts.size()); ++k) {
    const ModelPart& part = model.parts[k];
    if (!part.has_shell || part.has_sph) continue;  // a part of both kinds was refused by the model
    const SectionShell* const section = sections.of(part);
    if (!section)
      deck.error(diagnostics, part.card, "SECID",
                 fmt::format("the shells of part {} need a *SECTION_SHELL with id {}; {}", part.id,
                             part.secid, deck.found_instead(IdSpace::section, part.secid)),
                 "add the section, or correct the id here");
    if (part.rigid && std::any_of(part.plies.begin(), part.plies.end(),
                                  [&](const ModelPly& ply) { return ply.mid != part.mid; }))
      deck.error(diagnostics, part.card, "MID1",
                 fmt::format("the first layer of part {} is rigid, and others are not", part.id),
                 "give all layers the *MAT_RIGID, or none");
    const auto m = material(k, -1);
    if (!m)
      deck.error(
          diagnostics, part.card, "MID",
          fmt::format("the shells of part {} need a *MAT_RIGID, or a material with strength, with id {}; {}",
                      part.id, part.mid, deck.found_instead(IdSpace::material, part.mid)),
          "*MAT_RIGID makes them rigid walls; with a material as *MAT_ELASTIC they deform");
    if (!m || !section) continue;
    const SectionShell& s = *section;
    // rigid ones may have their mass from elsewhere, or need none
    if (!(s.t1 > 0) && !part.rigid && part.plies.empty() && by_part[k] && told.insert(&s).second)
      deck.error(diagnostics, s, "T1", fmt::format("the shells of part {} have no thickness", part.id),
                 "give a thickness > 0");
    const auto corner = [&](Real t) { return t > 0 ? t : s.t1; };
    out[k] = {true, *m, 0.25 * (s.t1 + corner(s.t2) + corner(s.t3) + corner(s.t4)), s.marea};
  }
  return out;
}

/// That of its own layers, or the mean of its corners' own thicknesses; else that of the section.
Real thickness_of(const Model& model, Index shell, Real of_section) {
  if (const auto layup = model.shell_layup.find(shell); layup != model.shell_layup.end())
    return model.layups[layup->second].thickness();
  const auto own = model.shell_thickness.find(shell);
  if (own == model.shell_thickness.end()) return of_section;
  const auto& node = model.shells[shell].node;
  const int corners = node[2] == node[3] ? 3 : 4;
  Real sum = 0;
  for (int c = 0; c < corners; ++c) sum += own->second[c] > 0 ? own->second[c] : of_section;
  return sum / corners;
}

/// That of *PART_CONTACT, where it is another one than the shell's.
void give_contact_thickness(const ModelPart& part, Index s, Segments& g) {
  const Real t = part.optt > 0 ? part.optt : part.sft * g.thickness[s];
  if (t != g.thickness[s]) shared_fields::contact_thickness.add(g.fields)[s] = t;
}

std::vector<std::optional<ShellMaterial>> materials_of_layups(
    const Model& model, const std::function<std::optional<ShellMaterial>(Index, Index)>& material) {
  const std::vector<Index> group_of = layups_of_groups(model);
  std::vector<std::optional<ShellMaterial>> out;
  for (Index k = 0; k < Index(group_of.size()); ++k)
    out.push_back(group_of[k] == k ? material(model.layups[k].part, k) : out[group_of[k]]);
  return out;
}

}  // namespace

void build_segments(const Deck& deck, const Model& model,
                    const std::function<std::optional<ShellMaterial>(Index part, Index layup)>& material,
                    const std::vector<Index>& node_of, World& world, Diagnostics& diagnostics) {
  const std::vector<WallPart> parts = read_parts(deck, model, material, diagnostics);
  const std::vector<std::optional<ShellMaterial>> of_layup = materials_of_layups(model, material);
  Nodes& nodes = world.nodes;
  Segments& g = world.segments;
  g.fields.resize(Index(model.shells.size()));
  for (Index s = 0; s < g.size(); ++s) {
    const ModelShell& shell = model.shells[s];
    const WallPart& part = parts[shell.part];
    std::array<Index, 4> a;
    for (int e = 0; e < 4; ++e) a[e] = node_of[shell.node[e]];
    g.node0[s] = a[0], g.node1[s] = a[1], g.node2[s] = a[2], g.node3[s] = a[3];
    g.part[s] = shell.part;
    g.id[s] = shell.id;
    const auto x = [&](int e) { return nodes.x.vec(a[e]); };
    const Real area = 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
    if (!(area > 0))
      diagnostics.error(
          model.parts[shell.part].where,
          fmt::format("*ELEMENT_SHELL {} of part {} has no area", shell.id, model.parts[shell.part].id),
          "its nodes coincide or lie on a line");
    if (!part.usable) continue;
    g.thickness[s] = thickness_of(model, s, part.thickness);
    give_contact_thickness(model.parts[shell.part], s, g);
    const auto layup = model.shell_layup.find(s);
    const ShellMaterial own =
        layup == model.shell_layup.end() ? part.material : of_layup[layup->second].value_or(part.material);
    g.K[s] = model.parts[shell.part].ssf * own.E / (3 * (1 - 2 * own.pr));
    const int corners = a[2] == a[3] ? 3 : 4;
    const Real m = (own.ro * g.thickness[s] + part.marea) * area / corners;
    for (int e = 0; e < corners; ++e) nodes.m[a[e]] += m;
  }
}

}  // namespace courant
