#include "contact/edges/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "contact/edges/edge_contact.hpp"
#include "contact/nodes/measures.hpp"
#include "contact/nodes/transducer.hpp"
#include "state/shared_fields.hpp"
#include "surfaces/contact_offset.hpp"

namespace courant {

namespace {

/// Edges of solids touch where their faces turn by more than 60 degrees (cosine).
constexpr Real sharp = 0.5;

class EdgeContactBuilder {
 public:
  EdgeContactBuilder(const Deck& deck, const Model& model, const NodeContactOptions& options, World& world,
                     Diagnostics& diagnostics)
      : deck_(deck),
        options_(options),
        world_(world),
        diagnostics_(diagnostics),
        finder_(deck, model, options.bulk_modulus, world, diagnostics),
        measures_(deck, model, options.tssfac, world, diagnostics) {}

  void add(const ContactCard& c, int number, std::shared_ptr<const NodeContact> nodes) {
    const int errors = diagnostics_.errors();
    const ContactKind kind = kind_of(c);
    measures_.take(c);
    NodeContactLaw law = measures_.law();
    std::vector<ContactEdge> edges = edges_of_faces(c, kind, law);
    if (kind.edges) add_beams(c, law, edges);
    if (diagnostics_.errors() > errors) return;
    if (edges.size() < 2) {
      if (!nodes)
        diagnostics_.warning(deck_.where(c), fmt::format("{}: nothing of it can touch", deck_.keyword(c)),
                             "leave it out, or name other parts");
      return;
    }
    if (world_.dim == 2)
      return diagnostics_.error(deck_.where(c),
                                deck_.keyword(c) + ": edges do not touch each other in a plane scene",
                                "leave it out, or make the scene one of three dimensions");
    warn(c, law);
    world_.segments.keep_contact_force();
    if (c.bt > 0 || law.gate.there()) world_.counters["penetrations_at_birth"] += 0;
    const auto contact = std::make_shared<EdgeContact>(std::move(law), std::move(edges), options_.bodies,
                                                       std::move(nodes), number, world_);
    report(c, contact->penetrations(world_));
    add_edge_contact(world_, contact);
  }

 private:
  using Key = std::pair<Index, Index>;
  struct FacesAtEdge {
    std::vector<Index> shells, solids;  ///< segments
    unsigned sides = 0;
  };

  std::vector<ContactEdge> edges_of_faces(const ContactCard& c, const ContactKind& kind,
                                          const NodeContactLaw& law) {
    std::map<Key, FacesAtEdge> found;
    const Segments& g = world_.segments;
    const auto take = [&](const std::vector<Index>& faces, unsigned sides) {
      for (const Index s : faces) {
        const auto a = g.nodes(s);
        for (std::size_t e = 0; e < 4; ++e) {
          const Index n = a[e], next = a[(e + 1) % 4];
          if (n == next) continue;
          FacesAtEdge& one = found[{std::min(n, next), std::max(n, next)}];
          std::vector<Index>& list = g.volume[s] > 0 ? one.solids : one.shells;
          if (std::find(list.begin(), list.end(), s) == list.end()) list.push_back(s);
          one.sides |= sides;
        }
      }
    };
    take(finder_.faces(c, ContactSide::a), kind.single ? 3U : 1U);
    if (!kind.single) take(finder_.faces(c, ContactSide::b), 2U);
    const bool may_erode = shared_fields::eroded.find(g.fields) != nullptr;
    std::vector<ContactEdge> out;
    for (const auto& [key, one] : found) {
      const bool of_shells = kind.inner || may_erode ? !one.shells.empty() : one.shells.size() == 1;
      if (!of_shells && !is_sharp(one.solids)) continue;
      ContactEdge edge;
      edge.node = {key.first, key.second};
      edge.sides = one.sides;
      edge.faces = of_shells ? one.shells : one.solids;
      edge.always = kind.inner || !of_shells;
      const int side = (one.sides & 1U) != 0 ? 0 : 1;
      const Index s = edge.faces.front();
      const auto a = g.nodes(s);
      edge.area = area_of({world_.nodes.x.vec(a[0]), world_.nodes.x.vec(a[1]), world_.nodes.x.vec(a[2]),
                           world_.nodes.x.vec(a[3])});
      edge.r = measures_.half_thickness(side, s);
      if (contact_offset(g, s, edge.r) != 0 && lifted_.insert(&c).second)
        deck_.refuse(
            diagnostics_, c, "SOFT",
            fmt::format("edges of shells whose surface CNTCO of *CONTROL_SHELL puts off their nodes, as "
                        "shell {}, are not supported",
                        g.id[s]),
            "give CNTCO 0, or a contact of nodes with faces alone");
      edge.of_part = g.part[s];
      edge.k = scale(c) * law.sfs[static_cast<std::size_t>(side)] * measures_.stiffness(s, edge.area);
      out.push_back(std::move(edge));
    }
    return out;
  }

  /// Whether two faces of solids meet at an outer edge.
  bool is_sharp(const std::vector<Index>& faces) const {
    if (faces.size() != 2) return false;
    std::array<Vec, 2> n, centre;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto a = world_.segments.nodes(faces[k]);
      const FaceCorners x{world_.nodes.x.vec(a[0]), world_.nodes.x.vec(a[1]), world_.nodes.x.vec(a[2]),
                          world_.nodes.x.vec(a[3])};
      n[k] = plane_normal(x), centre[k] = centre_of(x, a[2] == a[3] ? 3 : 4);
    }
    return n[0].dot(n[1]) < sharp && n[0].dot(centre[1] - centre[0]) < 0;
  }

  /// EDGEK scales edges by DEPTH alone.
  static Real scale(const ContactCard& c) { return kind_of(c).edges || !(c.edgek > 0) ? Real(1) : c.edgek; }

  void add_beams(const ContactCard& c, const NodeContactLaw& law, std::vector<ContactEdge>& edges) {
    for (const BeamEdge& beam : finder_.beams(c)) {
      const ElementGroup& group = *world_.groups[beam.group];
      const Real K = options_.bulk_modulus(group.part);
      if (!(K > 0) && law.soft == 0)
        return diagnostics_.error(deck_.where(c),
                                  fmt::format("{}: the material of beam {} gives contact no stiffness",
                                              deck_.keyword(c), group.id[beam.element]),
                                  "give SOFT 1, which takes it from masses, or of a *MAT_NULL YM and PR");
      ContactEdge edge;
      edge.node = beam.node;
      edge.r = measures_.beam_radius(group.part, beam.area);
      edge.of_part = group.part;
      edge.k = law.sfs[0] * K * beam.area / beam.length;
      edge.area = 2 * edge.r * beam.length;
      edge.eroded = shared_fields::eroded.find(group.fields);
      edge.element = beam.element;
      edges.push_back(std::move(edge));
    }
  }

  void warn(const ContactCard& c, const NodeContactLaw& law) {
    if (law.penopt != 1)
      diagnostics_.warning(
          deck_.where(c),
          fmt::format("{}: edges on edges take the smaller stiffness of both, PENOPT {} or not",
                      deck_.keyword(c), law.penopt),
          "scale it by SFSA");
    if (c.edgek > 0 && kind_of(c).edges)
      deck_.warning(diagnostics_, c, "EDGEK", "has no effect here: it scales edges by SOFT 2 and DEPTH",
                    "scale the stiffness by SFSA");
    if (!deck_.all<TransducerCard>().empty())
      diagnostics_.warning(
          deck_.where(c),
          fmt::format("{}: force transducers do not include forces between edges", deck_.keyword(c)),
          "rcforc has them, in a second line of this contact");
  }

  void report(const ContactCard& c, const EdgeContact::Penetrations& p) {
    world_.counters["initial_penetrations"] += p.count;
    if (p.count == 0) return;
    diagnostics_.warning(
        deck_.where(c),
        fmt::format("{}: {} initial penetrations of edges, deepest {:.4g} [L] at node {}", deck_.keyword(c),
                    p.count, p.deepest, p.node),
        "they give no force until they grow (as IGNORE 1; no node is moved): move the nodes, or reduce the "
        "thickness");
  }

  const Deck& deck_;
  const NodeContactOptions& options_;
  World& world_;
  Diagnostics& diagnostics_;
  FaceFinder finder_;
  ContactMeasures measures_;
  std::set<const ContactCard*> lifted_;  ///< reported
};

}  // namespace

void add_edge_contacts(const Deck& deck, const Model& model, const NodeContactOptions& options,
                       const NodeContactsByCard& nodes, World& world, Diagnostics& diagnostics) {
  EdgeContactBuilder builder(deck, model, options, world, diagnostics);
  int number = 0;
  for (const ContactCard& c : deck.all<ContactCard>()) {
    ++number;
    if (!asks_for_edges(c) || !diagnostics.ok()) continue;
    const auto of_card = nodes.find(number);
    builder.add(c, number, of_card == nodes.end() ? nullptr : of_card->second);
  }
}

}  // namespace courant
