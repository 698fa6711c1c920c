#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "elements/nodal_rotations.hpp"
#include "elements/shell/distortion.hpp"
#include "elements/shell/facets.hpp"
#include "elements/shell/shells.hpp"
#include "elements/shell_faces/section_shell.hpp"
#include "laws/strength/material_axes.hpp"
#include "state/shared_fields.hpp"
#include "surfaces/contact_offset.hpp"

namespace courant {

namespace {

std::array<Vec, 4> corners_at(const World& world, const std::array<Index, 4>& node) {
  std::array<Vec, 4> x;
  for (std::size_t c = 0; c < 4; ++c) x[c] = world.nodes.x.vec(node[c]);
  return x;
}

/// Degrees between the normals of the triangles on the two sides of a diagonal.
Real warp_angle(const std::array<Vec, 4>& x) {
  const auto normal = [&](std::size_t a, std::size_t b, std::size_t c) -> Vec {
    return (x[b] - x[a]).cross(x[c] - x[a]).normalized();
  };
  const Real cosine = std::min(normal(0, 1, 2).dot(normal(0, 2, 3)), normal(1, 2, 3).dot(normal(1, 3, 0)));
  return std::acos(std::clamp<Real>(cosine, -1, 1)) * 180 / pi;
}

/// Quadrilaterals whose area is turned inwards: at one of 2 x 2 points, which the formulation cannot compute;
/// at a corner, where it is wrong.
void check_corners(const Model& model, const std::vector<ShellPart>& parts, const World& world,
                   Diagnostics& diagnostics) {
  struct Inwards {
    Index count = 0;
    Id first = 0;
  };
  std::vector<Inwards> at_points(parts.size()), at_corners(parts.size());
  for (std::size_t s = 0; s < model.shells.size(); ++s) {
    const auto part = static_cast<std::size_t>(model.shells[s].part);
    const auto node = world.segments.nodes(static_cast<Index>(s));
    if (!parts[part].law || parts[part].null || node[2] == node[3]) continue;
    const std::array<Vec, 4> x = corners_at(world, node);
    if (!turns_inwards(x, false)) continue;
    Inwards& of = parts[part].full && turns_inwards(x, true) ? at_points[part] : at_corners[part];
    if (of.count++ == 0) of.first = model.shells[s].id;
  }
  const auto text = [&](std::size_t k, const Inwards& of, const char* where) {
    return fmt::format("{} {} of part {} {} turned inwards at a {}, the first is shell {}", of.count,
                       of.count == 1 ? "shell" : "shells", model.parts[k].id, of.count == 1 ? "is" : "are",
                       where, of.first);
  };
  const char* hint = "move the node at the corner, or make two triangles of the quadrilateral";
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (at_points[k].count > 0) diagnostics.error(model.parts[k].where, text(k, at_points[k], "point"), hint);
    if (at_corners[k].count > 0)
      diagnostics.warning(model.parts[k].where, text(k, at_corners[k], "corner"), hint);
  }
}

void warn_of_warp(const Model& model, const std::vector<ShellPart>& parts, const World& world,
                  Diagnostics& diagnostics) {
  struct Worst {
    Index count = 0;
    Real angle = 0;
    Id id = 0;
  };
  std::vector<Worst> worst(parts.size());
  for (std::size_t s = 0; s < model.shells.size(); ++s) {
    const auto part = static_cast<std::size_t>(model.shells[s].part);
    const auto node = world.segments.nodes(static_cast<Index>(s));
    if (!parts[part].law || parts[part].null || node[2] == node[3] || parts[part].control.drilling > 0)
      continue;  // that has a stiffness of warping
    const std::array<Vec, 4> x = corners_at(world, node);
    const Real angle = warp_angle(x);
    if (!(angle > parts[part].warp_warning) || turns_inwards(x, false)) continue;
    Worst& w = worst[part];
    ++w.count;
    if (angle > w.angle) w.angle = angle, w.id = model.shells[s].id;
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (worst[k].count > 0)
      diagnostics.warning(
          model.parts[k].where,
          fmt::format(
              "shells of part {} are warped by more than WRPANG = {:g} degrees: {}, and shell {} by {:.3g}; "
              "formulation 2 takes them as flat, and is far too soft there",
              model.parts[k].id, parts[k].warp_warning, worst[k].count, worst[k].id, worst[k].angle),
          "use a finer mesh, or triangles");
}

/// The length by which ISDO gives the step, see shell_loops.cpp. [L]
Real longest_step_length(const std::array<Vec, 4>& x, Real area, int corners, int rule) {
  Real longest = 0, shortest = std::numeric_limits<Real>::infinity();
  for (int c = 0; c < corners; ++c) {
    const Real side =
        (x[static_cast<std::size_t>((c + 1) % corners)] - x[static_cast<std::size_t>(c)]).norm();
    longest = std::max(longest, side), shortest = std::min(shortest, side);
  }
  const Real wide = (corners == 4 ? 1 : 2) * area / longest;
  return rule == 2 ? std::max(shortest, wide) : wide;
}

/// Where the directions of the layers of a part lie in its shells at the start.
class LayerDirections {
 public:
  LayerDirections(const Model& model, const ShellPart& part, const ModelPart& named, ElementGroup& group,
                  Diagnostics& diagnostics)
      : model_(model),
        part_(part),
        named_(named),
        group_(group),
        field_(layer_directions_of(group, part.zeta.size())),
        diagnostics_(diagnostics) {}

  /// `s`: the shell among those of the model, with corners `x`.
  void fill(Index e, Index s, const std::array<Vec, 4>& x) {
    const auto own_layers = model_.shell_layup.find(s);
    const std::vector<ModelPly>* const plies =
        own_layers == model_.shell_layup.end()
            ? nullptr
            : &model_.layups[static_cast<std::size_t>(own_layers->second)].plies;
    const Matrix axes = shell_axes(x, group_.corners(), part_.control.invariant_axes);
    for (std::size_t k = 0; k < part_.zeta.size(); ++k) {
      Vec a = axes.col(0);
      if (const MaterialAxes* of_law = part_.law_of(k).axes()) {
        MaterialAxes turned = *of_law;
        if (const auto own = model_.shell_beta.find(s); own != model_.shell_beta.end())
          turned.beta = own->second;
        if (plies)
          turned.beta += (*plies)[k].angle;
        else if (!part_.angle.empty())
          turned.beta += part_.angle[k];
        if (!direction_in_shell(turned, axes.col(2), x[1] - x[0], a)) refuse(e);
      }
      const int at = 2 * static_cast<int>(k);
      field_.data(at)[e] = a.dot(axes.col(0)), field_.data(at + 1)[e] = a.dot(axes.col(1));
    }
  }

 private:
  void refuse(Index e) {
    if (told_) return;
    told_ = true;
    diagnostics_.error(named_.where,
                       fmt::format("shell {} of part {} is normal to the direction that AOPT of its material "
                                   "gives, so that none follows for it",
                                   group_.id[e], named_.id),
                       "choose another AOPT, A or V");
  }

  const Model& model_;
  const ShellPart& part_;
  const ModelPart& named_;
  ElementGroup& group_;
  Field<Real>& field_;
  Diagnostics& diagnostics_;
  bool told_ = false;
};

constexpr const char* offset_name = "shell_offset";
Field<Real>& add_offset(const ElementGroup& group) {
  return group.fields.add<Real>({.name = offset_name, .dimension = "-", .restart = false});
}

ElementGroup& add_group(World& world, const std::string& name, std::size_t part, int corners, Index size,
                        ElementGroup::Leaves leaves) {
  FieldSet& set = world.add_set(name);
  set.resize(size);
  ElementGroup& group = *world.groups.emplace_back(
      std::make_unique<ElementGroup>(set, static_cast<Index>(part), corners, leaves));
  group.segment = &set.add<Index>({.name = "segment", .dimension = "-"});
  return group;
}

/// Shells of one group: of one shape, part and kind of layers.
struct Alike {
  Index part = 0, layup = -1;
  bool triangles = false;
  std::vector<Index> shells{};  ///< of the model
};

/// The bits of a number, each with two zeros in front.
std::uint64_t spread(std::uint64_t a) {
  constexpr int most = 21;
  std::uint64_t out = 0;
  for (int b = 0; b < most; ++b) out |= (a >> b & 1) << (3 * b);
  return out;
}

/// Neighbours one behind the other, in blocks of few nodes: along Morton's curve through cells as large as
/// shells mostly are.
void sort_by_place(const Model& model, std::vector<Index>& shells) {
  const auto at = [&](Index s, std::size_t c) -> const Vec& {
    const ModelShell& shell = model.shells[static_cast<std::size_t>(s)];
    return model.nodes[static_cast<std::size_t>(shell.node[c])].x;
  };
  std::vector<Vec> middle;
  std::vector<Real> side;
  Vec low = at(shells.front(), 0), high = low;
  for (const Index s : shells) {
    middle.push_back((at(s, 0) + at(s, 1) + at(s, 2) + at(s, 3)) / 4);
    side.push_back((at(s, 2) - at(s, 0)).norm() / std::sqrt(Real(2)));
    low = low.cwiseMin(middle.back()), high = high.cwiseMax(middle.back());
  }
  std::nth_element(side.begin(), side.begin() + static_cast<std::ptrdiff_t>(side.size() / 2), side.end());
  constexpr Real most_cells = (1 << 21) - 2;
  const Real cell = std::max(side[side.size() / 2], (high - low).maxCoeff() / most_cells);
  if (!(cell > 0)) return;
  std::vector<std::pair<std::uint64_t, Index>> keys;
  for (std::size_t k = 0; k < shells.size(); ++k) {
    const auto along = [&](int axis) {
      return spread(static_cast<std::uint64_t>((middle[k][axis] - low[axis]) / cell + 0.5));
    };
    keys.emplace_back(along(0) | along(1) << 1 | along(2) << 2, shells[k]);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t k = 0; k < shells.size(); ++k) shells[k] = keys[k].second;
}

std::vector<Alike> alike_shells(const Model& model, const std::vector<ShellPart>& parts) {
  const std::vector<Index> group_of = layups_of_groups(model);
  std::map<std::tuple<Index, Index, bool>, std::vector<Index>> sorted;
  auto last = sorted.end();
  for (std::size_t s = 0; s < model.shells.size(); ++s) {
    const ModelShell& shell = model.shells[s];
    if (!parts[static_cast<std::size_t>(shell.part)].law) continue;
    const auto own = model.shell_layup.find(static_cast<Index>(s));
    const Index layup = own == model.shell_layup.end() ? -1 : group_of[static_cast<std::size_t>(own->second)];
    const std::tuple key(shell.part, layup, shell.node[2] == shell.node[3]);
    if (last == sorted.end() || last->first != key) last = sorted.try_emplace(key).first;
    last->second.push_back(static_cast<Index>(s));
  }
  std::vector<Alike> out;
  for (auto& [key, shells] : sorted) {
    sort_by_place(model, shells);
    out.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), std::move(shells)});
  }
  return out;
}

/// NLOC, or OFFSET of the shell, as offset_of_shells has it.
Real offset_of(const Model& model, const ShellPart& part, Index shell, Real t) {
  const auto own = model.shell_offset.find(shell);
  return own == model.shell_offset.end() ? -part.nloc : 2 * own->second / t;
}

bool some_are_offset(const Model& model, const ShellPart& part, const std::vector<Index>& shells) {
  return part.nloc != 0 ||
         std::any_of(shells.begin(), shells.end(), [&](Index s) { return model.shell_offset.contains(s); });
}

/// Mass of an element. Returns its area. [L2]
Real weigh(const ShellPart& part, const std::array<Vec, 4>& x, Real t, Index e, ElementGroup& group) {
  const Real area = 0.5 * (x[2] - x[0]).cross(x[3] - x[1]).norm();
  group.V0[e] = area * t;
  group.mass[e] = (part.density() * t + part.marea) * area;
  return area;
}

/// Rotary inertia of each corner. [ML2]
Real inertia_of_corner(const ShellPart& part, const std::array<Vec, 4>& x, Real t, Real offset, int corners,
                       Real area, Real mass) {
  const ShellControl& c = part.control;
  const Real length = longest_step_length(x, area, corners, c.length_rule);
  const Real modulus = c.length_rule == 2 ? c.E : c.plate_modulus;
  const Real f = std::max(Real(1), 3 * c.shear_factor * c.G / modulus);
  const Real l2 = std::max(area, length * length);
  const Real t2 = t * t * (1 + 3 * offset * offset);
  return part.rotary_scale * mass / corners * (t2 + f * l2) / 12;
}

/// Elements of `group`, which are these shells of the model.
void fill_group(const Model& model, const ShellPart& part, const std::vector<Index>& shells,
                const std::vector<Index>& node_of, World& world, ElementGroup& group,
                Diagnostics& diagnostics) {
  Field<Real>* const corner_inertia = part.null ? nullptr : &corner_inertia_of(group);
  Field<Real>* const of_nodes = part.null ? nullptr : &NodalRotations(world.nodes.fields).inertia;
  Field<Real>* const offset = some_are_offset(model, part, shells) ? &add_offset(group) : nullptr;
  std::optional<LayerDirections> directions;
  if (part.has_axes())
    directions.emplace(model, part, model.parts[static_cast<std::size_t>(group.part)], group, diagnostics);
  for (Index e = 0; e < group.size(); ++e) {
    const Index s = shells[static_cast<std::size_t>(e)];
    const ModelShell& shell = model.shells[static_cast<std::size_t>(s)];
    group.id[e] = shell.id, (*group.segment)[e] = s;
    std::array<Vec, 4> x;
    for (std::size_t c = 0; c < 4; ++c)
      x[c] = world.nodes.x.vec(node_of[static_cast<std::size_t>(shell.node[c])]);
    if (directions) directions->fill(e, s, x);
    const Real t = world.segments.thickness[s], off = offset ? offset_of(model, part, s, t) : 0;
    if (offset) (*offset)[e] = off;
    if (part.contact_plane != 0 && off != 0) {
      const bool at_middle = part.contact_plane == 1;
      shared_fields::contact_offset.add(world.segments.fields).data(at_middle ? 1 : 0)[s] =
          at_middle ? 0.5 * t * off : off;
    }
    const Real area = weigh(part, x, t, e, group);
    if (corner_inertia)
      (*corner_inertia)[e] = inertia_of_corner(part, x, t, off, group.corners(), area, group.mass[e]);
    for (int corner = 0; corner < group.corners(); ++corner) {
      const Index n = node_of[static_cast<std::size_t>(shell.node[static_cast<std::size_t>(corner)])];
      group.node.data(corner)[e] = n;
      if (corner_inertia) (*of_nodes)[n] += (*corner_inertia)[e];
    }
  }
  if (group.pushes) group.sums = std::make_unique<BlockSums>(group.node, group.size(), group.fields.name());
}

}  // namespace

Field<Real>& corner_inertia_of(const ElementGroup& group) {
  return group.fields.add<Real>({.name = "corner_inertia", .dimension = "ML2", .restart = false});
}

Field<Real>* offset_of_shells(const ElementGroup& group) {
  return dynamic_cast<Field<Real>*>(group.fields.find(offset_name));
}

Field<Real>& layer_directions_of(const ElementGroup& group, std::size_t layers) {
  return group.fields.add<Real>({.name = "layer_directions",
                                 .dimension = "-",
                                 .components = 2 * static_cast<int>(layers),
                                 .restart = false});
}

Matrix shell_axes(const std::array<Vec, 4>& x, int corners, bool invariant) {
  const Vec e3 = (x[2] - x[0]).cross(x[3] - x[1]).normalized();
  Vec e1 = x[1] - x[0];
  if (invariant && corners == 4) {
    const Vec xi = (x[1] + x[2] - x[0] - x[3]).normalized(), eta = (x[2] + x[3] - x[0] - x[1]).normalized();
    e1 = (xi + eta).normalized();
    e1 = Vec(e1 - e3.cross(e1));
  }
  e1 = Vec(e1 - e1.dot(e3) * e3).normalized();
  Matrix out;
  out.col(0) = e1, out.col(1) = e3.cross(e1), out.col(2) = e3;
  return out;
}

// A rotation of all corners alike meets the shear stiffness K G t A alone, K the shear factor: with rotary
// inertia m (t^2 + f l^2)/12 its frequency is sqrt(12 K G/(f rho))/l at most. With the l of the step's rule,
// dt = l sqrt(rho/M), and f = 3 K G/M or more that is 2/dt at most: neither shear nor bending sets the step.
void build_shells(const Model& model, const std::vector<ShellPart>& parts, const std::vector<Index>& node_of,
                  World& world, Diagnostics& diagnostics) {
  if (std::none_of(parts.begin(), parts.end(), [](const ShellPart& p) { return p.law != nullptr; })) return;
  for (const Alike& alike : alike_shells(model, parts)) {
    const auto part = static_cast<std::size_t>(alike.part);
    const std::string kind = alike.triangles ? "triangles" : "shells";
    const std::string own = alike.layup < 0 ? "" : fmt::format(" with layers {}", alike.layup + 1);
    ElementGroup& group =
        add_group(world, fmt::format("{} of part {}{}", kind, model.parts[part].id, own), part,
                  alike.triangles ? 3 : 4, static_cast<Index>(alike.shells.size()),
                  parts[part].null ? ElementGroup::Leaves::nothing : ElementGroup::Leaves::sums);
    group.layup = alike.layup;
    fill_group(model, parts[part].of(alike.layup), alike.shells, node_of, world, group, diagnostics);
  }
  check_corners(model, parts, world, diagnostics);
  warn_of_warp(model, parts, world, diagnostics);
  note_facets(model, parts, world, diagnostics);
}

}  // namespace courant
