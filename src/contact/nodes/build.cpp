#include "contact/nodes/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "contact/nodes/transducer.hpp"

namespace courant {

namespace {

/// *CONTROL_CONTACT and the card: what they say of the thickness of shells.
struct ShellThickness {
  bool of_rigid = true, of_others = true;
  bool limited = false;  ///< to 0.4 of the shortest edge
};

class NodeContactBuilder {
 public:
  NodeContactBuilder(const Deck& deck, const Model& model, const NodeContactOptions& options, World& world,
                     Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        options_(options),
        world_(world),
        diagnostics_(diagnostics),
        finder_(deck, model, options.bulk_modulus, world, diagnostics) {
    if (const ControlContact* control = deck.last<ControlContact>()) control_ = *control;
  }

  void add(const ContactCard& c, int number) {
    const int errors = diagnostics_.errors();
    const ContactKind kind = kind_of(c);
    finder_.with_inner(kind.eroding && c.erosop == 1);
    const std::vector<Index> faces_a = finder_.faces(c, ContactSide::a);
    const std::vector<Index> faces_b = kind.single ? faces_a : finder_.faces(c, ContactSide::b);
    const std::vector<Index> nodes_a = finder_.nodes(c, ContactSide::a, faces_a);
    check(c, nodes_a);
    if (finder_.are_stiff(c, faces_a, c.soft != 0) && !kind.single)
      finder_.are_stiff(c, faces_b, c.soft != 0);
    if (diagnostics_.errors() > errors) return;
    ContactSides sides;
    thickness_ = thickness_of(c, kind);
    add_nodes(c, 0, nodes_a, c.surfatyp == 4 ? finder_.faces_around(nodes_a) : faces_a, sides);
    add_faces(c, kind.single ? 0 : 1, 1U, faces_b, sides);
    if (kind.two_way) {
      add_nodes(c, 1, finder_.nodes(c, ContactSide::b, faces_b), faces_b, sides);
      add_faces(c, 0, 2U, faces_a, sides);
    }
    if (!can_touch(sides)) return warn_of_nothing(c, !nodes_a.empty());
    if (world_.dim == 2)
      return diagnostics_.error(deck_.where(c),
                                deck_.keyword(c) + ": elements do not touch each other in a plane scene yet",
                                "leave it out, or make the scene one of three dimensions");
    if (!shells_have_thickness(c, kind, sides)) return;
    warn_of_kind(c, kind);
    NodeContactLaw law = law_of(c);
    if (c.bt > 0 || law.gate.there()) world_.counters["penetrations_at_birth"] += 0;
    auto contact =
        std::make_shared<NodeContact>(std::move(law), std::move(sides), options_.bodies, number, world_);
    report_penetrations(c, contact->penetrations(world_));
    for (const auto& pass : world_.passes.all<TouchHolder>())
      if (pass->of_contact() == c.cid) contact->let_hold(*pass);
    add_node_contact(world_, contact);
    contacts_.push_back(contact);
  }
  const std::vector<std::shared_ptr<const NodeContact>>& contacts() const { return contacts_; }

 private:
  void check(const ContactCard& c, const std::vector<Index>& nodes_a) {
    if (c.surfatyp == 4 && !kind_of(c).nodes)
      deck_.error(diagnostics_, c, "SURFATYP", "a node set is no surface",
                  "use *CONTACT_AUTOMATIC_NODES_TO_SURFACE, or a part, part set or segment set");
    if (nodes_a.empty()) return;
    if (c.fs == 2)
      deck_.error(diagnostics_, c, "FS", "FS = 2 asks for a friction table, which is not supported",
                  "give a coefficient other than 2");
  }

  void warn_of_kind(const ContactCard& c, const ContactKind& kind) {
    if (kind.edges)
      diagnostics_.warning(deck_.where(c),
                           deck_.keyword(c) + ": nodes are kept off faces, edges are not kept off edges",
                           "where edges meet edges only, they go through each other");
    if (c.soft == 2)
      deck_.warning(diagnostics_, c, "SOFT", "2 (faces on faces) runs as 1 (nodes on faces)",
                    "give 1 where that is meant");
    const auto without_effect = [&](const char* field, bool given, const char* why) {
      if (given)
        deck_.warning(diagnostics_, c, field, fmt::format("has no effect: {}", why), "leave it blank");
    };
    if (kind.single) without_effect("SURFB", c.surfb != 0, "a single surface is SURFA alone");
    if (!kind.two_way || kind.single)
      without_effect("SFSB", c.sfsb != 1 && c.sfsb != 0, "nodes of SURFA alone are kept off faces");
  }

  void warn_of_nothing(const ContactCard& c, bool has_nodes) {
    if (options_.with_particles.contains(c.cid)) return;
    diagnostics_.warning(deck_.where(c),
                         fmt::format("{}: nothing of it can touch: {}", deck_.keyword(c),
                                     has_nodes ? "its nodes and faces are held or belong to one rigid body"
                                               : "it has no nodes of elements"),
                         "leave it out, or name other parts");
  }

  ShellThickness thickness_of(const ContactCard& c, const ContactKind& kind) const {
    if (kind.automatic) return {.limited = kind.single && control_.ssthk == 0};
    const int which = c.thkopt == 2 ? 0 : c.thkopt == 1 ? c.shlthk : control_.shlthk;
    return {.of_rigid = which == 2, .of_others = which >= 1, .limited = false};
  }

  // A face without thickness has no two sides that could be told apart.
  bool shells_have_thickness(const ContactCard& c, const ContactKind& kind, const ContactSides& sides) {
    for (const ContactFace& f : sides.faces) {
      if (!f.two_sided || f.r > 0) continue;
      diagnostics_.error(
          deck_.where(c),
          fmt::format("{}: the shells of part {} count without their thickness here, which is not supported",
                      deck_.keyword(c),
                      model_.parts[static_cast<std::size_t>(world_.segments.part[f.segment])].id),
          kind.automatic ? "give them a thickness"
                         : "give SHLTHK 2 in *CONTROL_CONTACT, or use the contact with _AUTOMATIC");
      return false;
    }
    return true;
  }

  Real half_thickness(const ContactCard& c, int side, Index s) const {
    const Segments& g = world_.segments;
    const auto a = g.nodes(s);
    if (g.volume[s] > 0) return 0.5 * c.sldthk;
    const bool rigid = model_.parts[static_cast<std::size_t>(g.part[s])].rigid;
    if (!(rigid ? thickness_.of_rigid : thickness_.of_others)) return 0;
    const Real given = side == 0 ? c.sast : c.sbst, scale = side == 0 ? c.sfsat : c.sfsbt;
    Real t = given > 0 ? given : g.thickness[s] * scale;
    if (thickness_.limited)
      for (std::size_t e = 0; e < 4; ++e) {
        const Index n = a[e], next = a[(e + 1) % 4];
        if (n != next) t = std::min(t, 0.4 * (world_.nodes.x.vec(n) - world_.nodes.x.vec(next)).norm());
      }
    return 0.5 * t;
  }

  Real stiffness(const ContactCard& c, Index s, Real area) const {
    const Segments& g = world_.segments;
    const auto a = g.nodes(s);
    const FaceCorners x{world_.nodes.x.vec(a[0]), world_.nodes.x.vec(a[1]), world_.nodes.x.vec(a[2]),
                        world_.nodes.x.vec(a[3])};
    if (!(g.volume[s] > 0)) return g.K[s] * area / longest_diagonal(x, a[2] == a[3] ? 3 : 4);
    return (c.sldstf > 0 ? c.sldstf : g.K[s]) * area * area / g.volume[s];
  }

  /// Small faces of large solids hold nodes to this depth, of their width.
  static constexpr Real most_widths = 4;

  void add_faces(const ContactCard& c, int side, unsigned pass, const std::vector<Index>& segments,
                 ContactSides& sides) {
    const Segments& g = world_.segments;
    for (const Index s : segments) {
      ContactFace f;
      f.node = g.nodes(s), f.segment = s, f.passes = pass;
      f.corners = f.node[2] == f.node[3] ? 3 : 4;
      f.two_sided = !(g.volume[s] > 0);
      f.area = area_of(corners_of(f, world_.nodes.x));
      f.r = half_thickness(c, side, s);
      f.k = stiffness(c, s, f.area);
      const Real through = c.penmax > 0 ? c.penmax : 1;
      const Real width = std::sqrt(f.area);
      f.depth = f.two_sided ? through * std::max(2 * f.r, 0.5 * width)
                            : through * std::min(0.95 * g.volume[s] / f.area, most_widths * width);
      sides.faces.push_back(f);
    }
  }

  /// `around`: faces that the nodes may belong to.
  void add_nodes(const ContactCard& c, unsigned pass, const std::vector<Index>& nodes,
                 const std::vector<Index>& around, ContactSides& sides) {
    const Segments& g = world_.segments;
    std::vector<std::vector<Index>> faces_of(static_cast<std::size_t>(world_.nodes.size()));
    for (const Index s : around) {
      const auto a = g.nodes(s);
      for (std::size_t e = 0; e < (a[2] == a[3] ? 3U : 4U); ++e)
        faces_of[static_cast<std::size_t>(a[e])].push_back(s);
    }
    for (const Index n : nodes) {
      ContactNode node;
      node.node = n, node.pass = pass;
      node.first = static_cast<Index>(sides.own.size());
      for (const Index s : faces_of[static_cast<std::size_t>(n)]) {
        OwnFace own;
        own.node = g.nodes(s), own.segment = s, own.two_sided = !(g.volume[s] > 0);
        const Real area = area_of({world_.nodes.x.vec(own.node[0]), world_.nodes.x.vec(own.node[1]),
                                   world_.nodes.x.vec(own.node[2]), world_.nodes.x.vec(own.node[3])});
        const int corners = own.node[2] == own.node[3] ? 3 : 4;
        own.area = area / corners, own.k = stiffness(c, s, area) / corners;
        node.r = std::max(node.r, half_thickness(c, static_cast<int>(pass), s));
        sides.own.push_back(own);
      }
      node.last = static_cast<Index>(sides.own.size());
      sides.nodes.push_back(node);
    }
  }

  /// Whether any node may touch any face: not where all are held, or of one rigid body.
  bool can_touch(const ContactSides& sides) const {
    using Kind = std::pair<bool, Index>;  // held, body
    const auto kind = [&](Index n) { return Kind(world_.nodes.held[n] != 0, options_.bodies.body(n)); };
    const auto of_face = [&](const ContactFace& f) {
      Kind out = kind(f.node[0]);
      for (const Index n : f.node) {
        const Kind corner = kind(n);
        out.first = out.first && corner.first;
        if (corner.second != out.second) out.second = -1;
      }
      return out;
    };
    std::set<Kind> nodes[2], faces[2];
    for (const ContactNode& n : sides.nodes) nodes[n.pass].insert(kind(n.node));
    for (const ContactFace& f : sides.faces)
      for (const unsigned pass : {0U, 1U})
        if (f.passes & (1U << pass)) faces[pass].insert(of_face(f));
    for (const int pass : {0, 1})
      for (const Kind& n : nodes[pass])
        for (const Kind& f : faces[pass])
          if (!(n.first && f.first) && (n.second < 0 || n.second != f.second)) return true;
    return false;
  }

  NodeContactLaw law_of(const ContactCard& c) const {
    NodeContactLaw law;
    law.id = c.cid;
    law.title = c.title;
    law.slsfac = control_.slsfac, law.penopt = control_.penopt;
    law.sfs = {c.sfsa, c.sfsb};
    law.fs = c.fs * c.fsf, law.fd = c.fd * c.fsf, law.dc = c.dc, law.vc = c.vc * c.vsf;
    law.vdc = c.vdc;
    law.birth = c.bt, law.death = c.dt;
    if (SensorBoard* const board = sensors_of(deck_, model_, world_, diagnostics_))
      law.gate = board->gate_of_contact(c.cid);
    law.soft = c.soft, law.sofscl = c.sofscl, law.dtstif = c.dtstif;
    law.tssfac = options_.tssfac;
    law.enmass = control_.enmass;
    return law;
  }

  void report_penetrations(const ContactCard& c, const NodeContact::Penetrations& p) {
    world_.counters["initial_penetrations"] += p.count + p.lost;
    if (p.lost > 0)
      deck_.warning(
          diagnostics_, c, "",
          fmt::format("{} nodes start so deep inside other solids that this contact does not hold them",
                      p.lost),
          "move the parts apart: nodes may be inside by some 0.4 of the depth of an element");
    if (p.count == 0) return;
    diagnostics_.warning(
        deck_.where(c),
        fmt::format("{}: {} initial penetrations, deepest {:.4g} [L] at node {}", deck_.keyword(c), p.count,
                    p.deepest, p.node),
        "they give no force until they grow (as IGNORE 1; no node is moved): move the nodes, or reduce the "
        "thickness");
  }

  const Deck& deck_;
  const Model& model_;
  const NodeContactOptions& options_;
  World& world_;
  Diagnostics& diagnostics_;
  FaceFinder finder_;
  ControlContact control_;
  ShellThickness thickness_;
  std::vector<std::shared_ptr<const NodeContact>> contacts_;
};

}  // namespace

void add_node_contacts(const Deck& deck, const Model& model, const NodeContactOptions& options, World& world,
                       Diagnostics& diagnostics) {
  NodeContactBuilder builder(deck, model, options, world, diagnostics);
  int number = 0;
  for (const ContactCard& c : deck.all<ContactCard>()) builder.add(c, ++number);
  add_force_transducers(deck, model, options, builder.contacts(), world, diagnostics);
}

}  // namespace courant
