#include <fmt/format.h>

#include <algorithm>

#include "contact/nodes/build.hpp"
#include "model/mesh/named_parts.hpp"
#include "state/shared_fields.hpp"
#include "surfaces/skin.hpp"

namespace courant {

namespace {

enum SideType { segment_set, shell_set, part_set, part, node_set, all, all_but_parts };

struct SideFields {
  const char* field;
  Id id;
  int type;
  Id box;
  const char* box_field;
};

SideFields fields_of(const ContactCard& c, ContactSide side) {
  if (side == ContactSide::a) return {"SURFA", c.surfa, c.surfatyp, c.saboxid, "SABOXID"};
  return {"SURFB", c.surfb, c.surfbtyp, c.sbboxid, "SBBOXID"};
}

}  // namespace

const std::map<Id, Index>& FaceFinder::node_of_id() {
  if (node_of_id_.empty())
    for (Index n = 0; n < world_.nodes.size(); ++n) node_of_id_[world_.nodes.id[n]] = n;
  return node_of_id_;
}

// Of shells and the skins of all solids.
const std::map<FaceFinder::Key, Index>& FaceFinder::face_of_corners() {
  if (!face_of_corners_.empty()) return face_of_corners_;
  of_parts(std::vector<char>(model_.parts.size(), 1));
  for (Index s = 0; s < world_.segments.size(); ++s) {
    if (!is_hidden(s)) face_of_corners_.emplace(sorted_corners(world_.segments.nodes(s)), s);
  }
  return face_of_corners_;
}

std::vector<Index> FaceFinder::of_parts(const std::vector<char>& chosen) {
  const Segments& g = world_.segments;
  std::vector<Index> out;
  for (std::size_t k = 0; k < chosen.size(); ++k)
    if (chosen[k] && model_.parts[k].has_solid)
      add_skin(world_, {static_cast<Index>(k), bulk_modulus_(static_cast<Index>(k))});
  for (Index s = 0; s < g.size(); ++s)
    if (chosen[static_cast<std::size_t>(g.part[s])] && (inner_ || !is_hidden(s))) out.push_back(s);
  return out;
}

bool FaceFinder::is_hidden(Index s) const {
  const Field<Index>* eroded = shared_fields::eroded.find(world_.segments.fields);
  return eroded && (*eroded)[s] == shared_fields::hidden;
}

std::vector<Index> FaceFinder::of_parts(const ContactCard& card, const char* field,
                                        const std::vector<char>& chosen) {
  const std::vector<Index> out = of_parts(chosen);
  std::vector<char> found(chosen.size(), 0);
  for (const Index s : out) found[static_cast<std::size_t>(world_.segments.part[s])] = 1;
  for (std::size_t k = 0; k < chosen.size(); ++k)
    if (chosen[k] && model_.parts[k].has_solid && !found[k])
      deck_.error(diagnostics_, card, field,
                  fmt::format("the solids of part {} have no faces that contact knows", model_.parts[k].id),
                  "leave the part out");
  return out;
}

std::vector<char> FaceFinder::parts_of(const ContactCard& card, const char* field, Id id, int type) {
  std::vector<char> out(model_.parts.size(), type == all || type == all_but_parts);
  if (type == all) return out;
  const int named_as = type == all_but_parts ? part_set : type;
  for (const Index k : parts_named(deck_, model_, card, field, id, named_as, diagnostics_)) {
    const ModelPart& named = model_.parts[static_cast<std::size_t>(k)];
    out[static_cast<std::size_t>(k)] = type != all_but_parts;
    if (type != all_but_parts && !named.has_shell && !named.has_solid &&
        !(kind_of(card).nodes && field[4] == 'A') && !(kind_of(card).edges && named.has_beam))
      deck_.error(diagnostics_, card, field, fmt::format("part {} has no shells and no solids", named.id),
                  named.has_sph ? "particles can be SURFA of *CONTACT_AUTOMATIC_NODES_TO_SURFACE"
                                : "name parts of shells or solids");
  }
  return out;
}

std::vector<Index> FaceFinder::of_segment_set(const ContactCard& card, const char* field, Id id) {
  std::vector<Index> out;
  const auto set = model_.segment_sets.find(id);
  if (set == model_.segment_sets.end()) {
    deck_.error(diagnostics_, card, field, fmt::format("segment set {} does not exist", id),
                "define it with *SET_SEGMENT");
    return out;
  }
  for (const Index k : set->second) {
    Key key;
    std::string ids;
    bool known = true;
    for (std::size_t e = 0; e < key.size(); ++e) {
      const Index corner = model_.segments[static_cast<std::size_t>(k)].node[e];
      const Id node = model_.nodes[static_cast<std::size_t>(corner)].id;
      const auto at = node_of_id().find(node);
      known = known && at != node_of_id().end();
      key[e] = known ? at->second : 0;
      ids += fmt::format("{}{}", e == 0 ? "" : ", ", node);
    }
    key = sorted_corners(key);
    const auto face = known ? face_of_corners().find(key) : face_of_corners().end();
    if (face == face_of_corners().end()) {
      deck_.error(diagnostics_, card, field,
                  fmt::format("segment ({}) of set {} is no shell and no outer face of a solid", ids, id),
                  "leave it out");
      break;
    }
    out.push_back(face->second);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<Index> FaceFinder::of_shell_set(const ContactCard& card, const char* field, Id id) {
  std::vector<Index> out;
  const auto set = model_.shell_sets.find(id);
  if (set == model_.shell_sets.end()) {
    deck_.error(diagnostics_, card, field, fmt::format("shell set {} does not exist", id),
                "define it with *SET_SHELL");
    return out;
  }
  std::vector<Id> ids;
  for (const Index k : set->second) ids.push_back(model_.shells[static_cast<std::size_t>(k)].id);
  std::sort(ids.begin(), ids.end());
  const Segments& g = world_.segments;
  for (Index s = 0; s < g.size(); ++s)
    if (!(g.volume[s] > 0) && std::binary_search(ids.begin(), ids.end(), g.id[s])) out.push_back(s);
  return out;
}

std::vector<Index> FaceFinder::faces(const ContactCard& card, ContactSide side, bool blank_is_all) {
  const SideFields f = fields_of(card, side);
  const bool everything = f.type == all || (f.id == 0 && blank_is_all);
  std::vector<Index> out;
  if (f.type == node_set) return out;
  if (f.id == 0 && !everything) {
    deck_.error(diagnostics_, card, f.field, "names no surface",
                "give the id of a part, or of a set; for all parts use *CONTACT_AUTOMATIC_SINGLE_SURFACE");
    return out;
  }
  if (!everything && f.type == segment_set)
    out = of_segment_set(card, f.field, f.id);
  else if (!everything && f.type == shell_set)
    out = of_shell_set(card, f.field, f.id);
  else
    out = of_parts(card, f.field, parts_of(card, f.field, f.id, everything ? all : f.type));
  leave_out_symmetric(card, out);
  keep_in_box(card, side, out);
  return out;
}

const Box* FaceFinder::box_of(const ContactCard& card, ContactSide side) const {
  const SideFields f = fields_of(card, side);
  if (f.box == 0) return nullptr;
  const auto box = model_.boxes.find(f.box);
  if (box != model_.boxes.end()) return &box->second;
  deck_.error(diagnostics_, card, f.box_field, fmt::format("box {} does not exist", f.box),
              "define it with *DEFINE_BOX");
  return nullptr;
}

void FaceFinder::keep_in_box(const ContactCard& card, ContactSide side, std::vector<Index>& faces) const {
  const Box* const box = box_of(card, side);
  if (!box) return;
  std::erase_if(faces, [&](Index s) {
    const auto corners = world_.segments.nodes(s);
    return !std::all_of(corners.begin(), corners.end(),
                        [&](Index n) { return box->contains(world_.nodes.x.vec(n)); });
  });
}

void FaceFinder::leave_out_symmetric(const ContactCard& card, std::vector<Index>& faces) const {
  if (card.erode_isym != 1) return;
  std::map<Id, std::array<bool, 3>> fixed;
  for (const ModelNode& node : model_.nodes) fixed[node.id] = node.fixed;
  constexpr Real along = 1 - 1e-6;  // cosine
  const Nodes& nodes = world_.nodes;
  std::erase_if(faces, [&](Index s) {
    const auto a = world_.segments.nodes(s);
    const auto x = [&](std::size_t c) { return nodes.x.vec(a[c]); };
    const Vec n = (x(2) - x(0)).cross(x(3) - x(1)).normalized();
    Eigen::Index axis = 0;
    if (!(world_.segments.volume[s] > 0) || n.cwiseAbs().maxCoeff(&axis) < along) return false;
    return std::all_of(a.begin(), a.end(),
                       [&](Index corner) { return fixed[nodes.id[corner]][static_cast<std::size_t>(axis)]; });
  });
}

bool FaceFinder::are_stiff(const ContactCard& card, const std::vector<Index>& faces, bool by_mass) {
  const Segments& g = world_.segments;
  const auto soft = std::find_if(faces.begin(), faces.end(), [&](Index s) {
    return model_.parts[static_cast<std::size_t>(g.part[s])].null && !(g.K[s] > 0);
  });
  if (soft == faces.end() || by_mass) return true;
  diagnostics_.error(
      deck_.where(card),
      fmt::format("{}: the shells of part {} are of a *MAT_NULL without YM: contact has no "
                  "stiffness there",
                  deck_.keyword(card), model_.parts[static_cast<std::size_t>(g.part[*soft])].id),
      "give YM and PR of what they cover");
  return false;
}

std::vector<Index> FaceFinder::nodes(const ContactCard& card, ContactSide side,
                                     const std::vector<Index>& faces) {
  const SideFields f = fields_of(card, side);
  std::vector<Index> out;
  if (f.type != node_set) {
    for (const Index s : faces)
      for (const Index n : world_.segments.nodes(s)) out.push_back(n);
  } else if (const auto set = model_.node_sets.find(f.id); set != model_.node_sets.end()) {
    for (const Index n : set->second) {
      const auto at = node_of_id().find(model_.nodes[static_cast<std::size_t>(n)].id);
      if (at != node_of_id().end()) out.push_back(at->second);
    }
  } else if (world_.particles.size() == 0) {  // else the contact of particles reports it
    deck_.error(diagnostics_, card, f.field, fmt::format("node set {} does not exist", f.id),
                "define it with *SET_NODE_LIST");
  }
  keep_in_box(f.box, out);
  return out;
}

std::vector<Index> FaceFinder::nodes_of_elements(const ContactCard& card, ContactSide side) {
  const SideFields f = fields_of(card, side);
  std::vector<Index> out;
  for (const Index k : parts_named(deck_, model_, card, f.field, f.id, f.type, diagnostics_))
    for (const auto& group : world_.groups)
      for (int c = 0; group->part == k && c < group->corners(); ++c)
        out.insert(out.end(), group->node.data(c), group->node.data(c) + group->size());
  box_of(card, side);  // reports one that does not exist
  keep_in_box(f.box, out);
  return out;
}

bool FaceFinder::has_no_faces(const ContactCard& card, ContactSide side) const {
  const SideFields f = fields_of(card, side);
  if (f.id == 0 || (f.type != part_set && f.type != part)) return false;
  Diagnostics unheard;  // what is wrong with the parts is reported with their nodes
  const auto parts = parts_named(deck_, model_, card, f.field, f.id, f.type, unheard);
  return !parts.empty() && std::none_of(parts.begin(), parts.end(), [&](Index k) {
    const ModelPart& p = model_.parts[static_cast<std::size_t>(k)];
    return p.has_shell || p.has_solid;
  });
}

std::vector<BeamEdge> FaceFinder::beams(const ContactCard& card) {
  const SideFields f = fields_of(card, ContactSide::a);
  std::vector<BeamEdge> out;
  if (f.type == segment_set || f.type == shell_set || f.type == node_set) {
    if (f.id != 0) return out;
  }
  const auto chosen = parts_of(card, f.field, f.id, f.id == 0 ? static_cast<int>(all) : f.type);
  const auto box = model_.boxes.find(f.box);
  for (std::size_t g = 0; g < world_.groups.size(); ++g) {
    const ElementGroup& group = *world_.groups[g];
    if (group.corners() != 2 || !chosen[static_cast<std::size_t>(group.part)]) continue;
    for (Index e = 0; e < group.size(); ++e) {
      BeamEdge beam{.group = g, .element = e, .node = {group.node.data(0)[e], group.node.data(1)[e]}};
      const std::array<Vec, 2> x{world_.nodes.x.vec(beam.node[0]), world_.nodes.x.vec(beam.node[1])};
      beam.length = (x[1] - x[0]).norm();
      if (!(beam.length > 0 && group.V0[e] > 0)) continue;
      if (f.box != 0 && box != model_.boxes.end() &&
          !(box->second.contains(x[0]) && box->second.contains(x[1])))
        continue;
      beam.area = group.V0[e] / beam.length;
      out.push_back(beam);
    }
  }
  return out;
}

/// Sorted, each once.
void FaceFinder::keep_in_box(Id id, std::vector<Index>& nodes) const {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (const auto box = model_.boxes.find(id); id != 0 && box != model_.boxes.end())
    std::erase_if(nodes, [&](Index n) { return !box->second.contains(world_.nodes.x.vec(n)); });
}

std::vector<Index> FaceFinder::faces_around(const std::vector<Index>& nodes) {
  std::vector<char> chosen(model_.parts.size(), 0);
  for (const Index n : nodes)
    if (const Index k = world_.nodes.part[n]; k >= 0) chosen[static_cast<std::size_t>(k)] = 1;
  return of_parts(chosen);
}

}  // namespace courant
