#include "elements/shell_faces/section_shell.hpp"

#include <map>
#include <utility>

#include "keyword/registry.hpp"
#include "model/mesh/part_composite.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

Real SectionShell::angle(int layer) const {
  const std::vector<Real>* const column[] = {&b1, &b2, &b3, &b4, &b5, &b6, &b7, &b8};
  const std::vector<Real>& b = *column[layer % angles_on_card];
  const auto row = static_cast<std::size_t>(layer / angles_on_card);
  return row < b.size() ? b[row] : 0;
}

ShellSections::ShellSections(const Deck& deck, const Model& model) {
  for (const SectionShell& s : deck.all<SectionShell>()) sections_[s.secid] = &s;
  for (const PartCompositeCard& card : deck.all<PartCompositeCard>()) {
    SectionShell s;
    static_cast<Entry&>(s) = card;
    s.elform = card.elform, s.shrf = card.shrf, s.marea = card.marea, s.nloc = card.nloc;
    const auto part = model.part_of_id.find(card.pid);
    if (part == model.part_of_id.end()) continue;
    const std::vector<ModelPly>& plies = model.parts[static_cast<std::size_t>(part->second)].plies;
    s.nip = static_cast<int>(plies.size());
    for (const ModelPly& ply : plies) s.t1 += ply.thickness;
    of_composite_.emplace(card.pid, std::move(s));
  }
}

const SectionShell* ShellSections::of(const ModelPart& part) const {
  if (!part.plies.empty()) {
    const auto own = of_composite_.find(part.id);
    return own == of_composite_.end() ? nullptr : &own->second;
  }
  const auto found = sections_.find(part.secid);
  return found == sections_.end() ? nullptr : found->second;
}

std::vector<bool> parts_with_own_layers(const Model& model) {
  std::vector<bool> out(model.parts.size(), model.layups.empty());
  if (model.layups.empty()) return out;
  for (Index s = 0; s < Index(model.shells.size()); ++s)
    if (!model.shell_layup.contains(s)) out[model.shells[s].part] = true;
  return out;
}

std::vector<Index> layups_of_groups(const Model& model) {
  using Kind = std::pair<Index, std::vector<std::pair<Id, Real>>>;
  std::map<Kind, Index> first;
  std::vector<Index> out;
  for (const ModelLayup& layup : model.layups) {
    Kind kind{layup.part, {}};
    for (const ModelPly& ply : layup.plies) kind.second.emplace_back(ply.mid, ply.thickness);
    out.push_back(first.try_emplace(std::move(kind), Index(out.size())).first->second);
  }
  return out;
}

namespace {

/// Line `card` of the angles of layers is there.
template <int card>
bool has_angles(const SectionShell& s) {
  return s.icomp != 0 && s.layers() > card * SectionShell::angles_on_card;
}
template <int card>
CardOf<SectionShell> angle_card() {
  using S = SectionShell;
  return {.fields = {{"B1", &S::b1, "-", "angle of the material of layer 1, 9, ..., degrees"},
                     {"B2", &S::b2, "-", "of layer 2, 10, ..."},
                     {"B3", &S::b3, "-", "of layer 3, 11, ..."},
                     {"B4", &S::b4, "-", "of layer 4, 12, ..."},
                     {"B5", &S::b5, "-", "of layer 5, 13, ..."},
                     {"B6", &S::b6, "-", "of layer 6, 14, ..."},
                     {"B7", &S::b7, "-", "of layer 7, 15, ..."},
                     {"B8", &S::b8, "-", "of layer 8, 16, ..."}},
          .when = &has_angles<card>};
}

using S = SectionShell;
constexpr Honour no = Honour::no, ignored = Honour::ignored;

const RegisterKeyword<S> section_shell{
    {.names = {"SECTION_SHELL"},
     .purpose = "thickness of shells; formulation and points of those that deform",
     .id_space = IdSpace::section,
     .title_option = true,
     .title = &S::title,
     .cards =
         {{.fields = {{"SECID",
                       &S::secid,
                       "-",
                       "id that *PART refers to",
                       {.required = true, .check = Check::positive}},
                      {"ELFORM", &S::elform, "-",
                       "formulation of shells that deform: 2 Belytschko-Tsay, 4 flat triangle, 5 membrane, "
                       "16 2 x 2 points; "
                       "0: THEORY of *CONTROL_SHELL"},
                      {"SHRF", &S::shrf, "-", "factor of transverse shear", {.standard = 1}},
                      {"NIP", &S::nip, "-", "points through the thickness", {.standard = 2}},
                      {"PROPT", &S::propt, "-", "print option", {.standard = 1, .honour = ignored}},
                      {"QR/IRID", &S::irid, "-", "quadrature rule: 0, or minus an *INTEGRATION_SHELL"},
                      {"ICOMP",
                       &S::icomp,
                       "-",
                       "1: each layer has an angle of its material, on cards behind these",
                       {.allowed = {0, 1}}},
                      {"SETYP", &S::setyp, "-", "type of 2D solids", {.standard = 1, .honour = ignored}}}},
          {.fields =
               {{"T1", &S::t1, "L", "thickness at corner 1", {.check = Check::not_negative}},
                {"T2", &S::t2, "L", "thickness at corner 2, 0: T1", {.check = Check::not_negative}},
                {"T3", &S::t3, "L", "thickness at corner 3, 0: T1", {.check = Check::not_negative}},
                {"T4", &S::t4, "L", "thickness at corner 4, 0: T1", {.check = Check::not_negative}},
                {"NLOC", &S::nloc, "-", "position of the nodes: 1 upper face, -1 lower, 0 middle"},
                {"MAREA", &S::marea, "M/L2", "mass per area besides RO t", {.check = Check::not_negative}},
                {"IDOF", &S::idof, "-", "thickness strain: not 3"},
                {"EDGSET", &S::edgset, "-", "edge set of seat belts", {.honour = no}}}},
          angle_card<0>(),
          angle_card<1>(),
          angle_card<2>(),
          angle_card<3>(),
          angle_card<4>(),
          // how many lines these have, their own numbers tell; such sections are refused
          {.fields = {{"USER", &S::user, "-", "user-defined formulation (ELFORM 101 to 105)"}},
           .repeat = true,
           .when = [](const S& s) { return s.user_defined(); }}},
     .move = turn_height<&S::nloc>}};

}  // namespace
}  // namespace courant
