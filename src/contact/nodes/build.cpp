#include "contact/nodes/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "contact/interface_law.hpp"
#include "contact/nodes/measures.hpp"
#include "contact/nodes/solid_stacks.hpp"
#include "contact/nodes/transducer.hpp"
#include "surfaces/contact_offset.hpp"

namespace courant {

namespace {

class NodeContactBuilder {
 public:
  NodeContactBuilder(const Deck& deck, const Model& model, const NodeContactOptions& options, World& world,
                     Diagnostics& diagnostics)
      : deck_(deck),
        options_(options),
        world_(world),
        diagnostics_(diagnostics),
        finder_(deck, model, options.bulk_modulus, world, diagnostics),
        measures_(deck, model, options.tssfac, world, diagnostics) {}

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
    measures_.take(c);
    if (c.penchk != 0 && !kind_of(c).automatic)
      deck_.refuse(diagnostics_, c, "PENCHK", fmt::format("'{}' is not supported", c.penchk),
                   "leave the field blank or 0: PENMAX gives the depth of release");
    add_nodes(0, nodes_a, c.surfatyp == 4 ? finder_.faces_around(nodes_a) : faces_a, sides);
    add_faces(c, kind.single ? 0 : 1, 1U, faces_b, sides);
    if (kind.symmetric) {
      add_nodes(1, finder_.nodes(c, ContactSide::b, faces_b), faces_b, sides);
      add_faces(c, 0, 2U, faces_a, sides);
    }
    if (kind.edges) add_beam_nodes(c, sides);
    if (!can_touch(sides))
      return asks_for_edges(c) ? warn_of_kind(c, kind) : warn_of_nothing(c, !nodes_a.empty());
    if (world_.dim == 2)
      return diagnostics_.error(deck_.where(c),
                                deck_.keyword(c) + ": elements do not touch each other in a plane scene yet",
                                "leave it out, or make the scene one of three dimensions");
    refuse_laws(c);
    warn_of_kind(c, kind);
    NodeContactLaw law = measures_.law();
    if (c.bt > 0 || law.gate.there()) world_.counters["penetrations_at_birth"] += 0;
    auto contact =
        std::make_shared<NodeContact>(std::move(law), std::move(sides), options_.bodies, number, world_);
    report_penetrations(c, contact->penetrations(world_));
    for (const auto& pass : world_.passes.all<TouchHolder>())
      if (pass->of_contact() == c.cid) contact->let_hold(*pass);
    add_node_contact(world_, contact);
    contacts_.push_back(contact);
    of_card_[number] = contact;
  }
  const std::vector<std::shared_ptr<const NodeContact>>& contacts() const { return contacts_; }
  const std::map<int, std::shared_ptr<const NodeContact>>& of_card() const { return of_card_; }

 private:
  void check(const ContactCard& c, const std::vector<Index>& nodes_a) {
    if (c.surfatyp == 4 && !kind_of(c).nodes)
      deck_.error(diagnostics_, c, "SURFATYP", "a node set is no surface",
                  "use *CONTACT_AUTOMATIC_NODES_TO_SURFACE, or a part, part set or segment set");
    if (nodes_a.empty()) return;
    if (c.fs == 2)
      deck_.error(diagnostics_, c, "FS", "FS = 2 asks for a friction table, which is not supported",
                  "give a coefficient other than 2");
    warn_of_sliding(deck_, c, diagnostics_);
  }

  // Laws of users act on particles.
  void refuse_laws(const ContactCard& c) {
    for (const InterfaceLawsOf& laws : interface_law_registry())
      for (const AskedInterfaceLaw& one : laws(deck_))
        if (one.contact == c.cid)
          deck_.error(
              diagnostics_, one.card, "",
              fmt::format("contact {} is one of nodes with faces, to which laws of an interface do not "
                          "apply yet: they act on particles",
                          c.cid),
              "give particles and elements contacts of their own, and the law the id of that of particles");
  }

  void warn_of_kind(const ContactCard& c, const ContactKind& kind) {
    if (kind.runs_as[0] != 0)
      diagnostics_.warning(deck_.where(c), fmt::format("{} runs as {}", deck_.keyword(c), kind.runs_as),
                           "give the name of that contact to say so");
    if (c.soft == 2)
      deck_.warning(diagnostics_, c, "SOFT",
                    asks_for_edges(c) ? "2 (faces on faces) runs as 1 (nodes on faces, edges on edges)"
                                      : "2 (faces on faces) runs as 1 (nodes on faces)",
                    "give 1 where that is meant");
    const auto* control = deck_.last<ControlContact>();
    if (c.soft == 2 && (c.shledg == 1 || (c.shledg == 0 && control && control->shledg == 1)))
      deck_.warning(diagnostics_, c, "SHLEDG", "1 asks for square edges of shells: they are round",
                    "0 says the same without this warning");
    const auto without_effect = [&](const char* field, bool given, const char* why) {
      if (given)
        deck_.warning(diagnostics_, c, field, fmt::format("has no effect: {}", why), "leave it blank");
    };
    if (kind.single) without_effect("SURFB", c.surfb != 0, "a single surface is SURFA alone");
    if (!asks_for_edges(c)) {
      without_effect("DEPTH", c.depth == 5 || c.depth >= 15,
                     "edges touch edges with SOFT 2 and DEPTH 5, 15, 25, 35 in AUTOMATIC contacts of one or "
                     "two surfaces alone");
      without_effect("EDGEK", c.edgek != 0, "it is of edges that touch edges");
    }
    if (!kind.symmetric || kind.single)
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
      f.r = measures_.half_thickness(side, s);
      f.lift = lift_of(c, s, f.r);
      f.k = measures_.stiffness(s, f.area);
      const Real through = c.penmax > 0 ? c.penmax : 1;
      const Real width = std::sqrt(f.area);
      f.depth = f.two_sided ? through * std::max(2 * f.r, 0.5 * width)
                            : through * std::min(0.95 * g.volume[s] / f.area, most_widths * width);
      f.through = f.two_sided
                      ? f.depth
                      : through * std::min(0.95 * stacks().behind(s, f.area, most_widths * width / 0.95),
                                           most_widths * width);
      sides.faces.push_back(f);
    }
  }

  /// Beyond half the thickness a node would be behind the nodes of a face before it touches that.
  Real lift_of(const ContactCard& c, Index s, Real half) {
    constexpr Real rounding = 1e-9;
    const Real lift = contact_offset(world_.segments, s, half);
    if (std::abs(lift) <= (1 + rounding) * half) return lift;
    if (lifted_too_far_.insert(&c).second)
      deck_.error(diagnostics_, c, "",
                  fmt::format("CNTCO of *CONTROL_SHELL puts the surface of shell {} by {:.4g} [L] off its "
                              "nodes, which is more than half its thickness in this contact, {:.4g}",
                              world_.segments.id[s], std::abs(lift), half),
                  "give CNTCO 2, NLOC from -1 to 1, or a contact that counts thickness (_AUTOMATIC, SHLTHK)");
    return 0;
  }

  const SolidStacks& stacks() {
    if (!stacks_) stacks_.emplace(world_);
    return *stacks_;
  }

  /// `around`: faces that the nodes may belong to.
  void add_nodes(unsigned pass, const std::vector<Index>& nodes, const std::vector<Index>& around,
                 ContactSides& sides) {
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
        own.area = area / own.corners(), own.k = measures_.stiffness(s, area) / own.corners();
        const Real half = measures_.half_thickness(static_cast<int>(pass), s);
        own.lift = contact_offset(g, s, half);
        node.r = std::max(node.r, half), node.most_lift = std::max(node.most_lift, std::abs(own.lift));
        sides.own.push_back(own);
      }
      node.last = static_cast<Index>(sides.own.size());
      sides.nodes.push_back(node);
    }
  }

  /// Nodes of beams that no face has, as balls of their radius.
  void add_beam_nodes(const ContactCard& c, ContactSides& sides) {
    std::map<Index, Real> radius;
    for (const BeamEdge& beam : finder_.beams(c))
      for (const Index n : beam.node)
        radius[n] = std::max(radius[n], measures_.beam_radius(world_.groups[beam.group]->part, beam.area));
    for (const ContactNode& node : sides.nodes) radius.erase(node.node);
    for (const auto& [n, r] : radius) {
      ContactNode node;
      node.node = n, node.r = r;
      node.first = node.last = static_cast<Index>(sides.own.size());
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

  void report_penetrations(const ContactCard& c, const NodeContact::Penetrations& p) {
    world_.counters["initial_penetrations"] += p.count + p.lost;
    if (p.undecided > 0)
      diagnostics_.error(
          deck_.where(c),
          fmt::format(
              "{}: {} nodes start on shells that count without their thickness here, as node {}: which "
              "side is theirs is not known",
              deck_.keyword(c), p.undecided, p.undecided_node),
          kind_of(c).automatic ? "give them a thickness"
                               : "give SHLTHK 2 in *CONTROL_CONTACT, or use the contact with _AUTOMATIC");
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
  const NodeContactOptions& options_;
  World& world_;
  Diagnostics& diagnostics_;
  FaceFinder finder_;
  ContactMeasures measures_;
  std::optional<SolidStacks> stacks_;
  std::set<const ContactCard*> lifted_too_far_;  ///< reported
  std::vector<std::shared_ptr<const NodeContact>> contacts_;
  std::map<int, std::shared_ptr<const NodeContact>> of_card_;
};

}  // namespace

NodeContactsByCard add_node_contacts(const Deck& deck, const Model& model, const NodeContactOptions& options,
                                     World& world, Diagnostics& diagnostics) {
  NodeContactBuilder builder(deck, model, options, world, diagnostics);
  int number = 0;
  for (const ContactCard& c : deck.all<ContactCard>()) builder.add(c, ++number);
  add_force_transducers(deck, model, options, builder.contacts(), world, diagnostics);
  return builder.of_card();
}

}  // namespace courant
