// *CONTACT_FORCE_TRANSDUCER_PENALTY: tells the force of all contacts on a surface.
#include "contact/nodes/transducer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "contact/contact_table.hpp"
#include "contact/edges/edge_contact.hpp"
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using T = TransducerCard;

IdSpace space_of_surface(int type) {
  constexpr IdSpace spaces[] = {IdSpace::segment_set, IdSpace::shell_set, IdSpace::part_set, IdSpace::part};
  return type >= 0 && type <= 3 ? spaces[type] : IdSpace::none;
}

constexpr FieldRules time_span{.standard = 1e20, .honour = Honour::output_only};
const RegisterKeyword<T> transducer_keyword{contact_head<T>(
    {"CONTACT_FORCE_TRANSDUCER_PENALTY"},
    "force of all contacts of elements on SURFA, with those of edges, in rcforc; it pushes nothing itself",
    {{.fields =
          {{"SURFA",
            &T::surfa,
            "-",
            "of the kind SURFATYP",
            {},
            [](const T& card) { return space_of_surface(card.surfatyp); }},
           {"SURFB",
            &T::surfb,
            "-",
            "0: all forces on SURFA; else those between SURFA and SURFB alone",
            {},
            [](const T& card) { return space_of_surface(card.surfbtyp); }},
           {"SURFATYP",
            &T::surfatyp,
            "-",
            "0 segment set, 1 shell set, 2 part set, 3 part, 5 all, 6 all but a part set",
            {.allowed = {0, 1, 2, 3, 5, 6}}},
           {"SURFBTYP", &T::surfbtyp, "-", "kind of SURFB, as SURFATYP", {.allowed = {0, 1, 2, 3, 5, 6}}},
           {"SABOXID", &T::saboxid, "-", "box that restricts SURFA at the start",
            rules::optional_id_of(IdSpace::box)},
           {"SBBOXID", &T::sbboxid, "-", "box that restricts SURFB at the start",
            rules::optional_id_of(IdSpace::box)},
           {"SAPR", &T::sapr, "-", "SURFA in interface files", no_effect},
           {"SBPR", &T::sbpr, "-", "SURFB in interface files", no_effect}}},
     {.fields = {{"FS", &T::fs, "-", "friction: none of its own", no_effect},
                 {"FD", &T::fd, "-", "friction", no_effect},
                 {"DC", &T::dc, "T/L", "friction", no_effect},
                 {"VC", &T::vc, "M/LT2", "friction", no_effect},
                 {"VDC", &T::vdc, "-", "damping", no_effect},
                 {"PENCHK", &T::penchk, "-", "release of nodes", no_effect},
                 {"BT", &T::bt, "T", "birth time: it is always active", no_output},
                 {"DT", &T::dt, "T", "death time: it is always active", time_span}},
      .optional = true},
     {.fields = {{"SFSA", &T::sfsa, "-", "stiffness", no_effect},
                 {"SFSB", &T::sfsb, "-", "stiffness", no_effect},
                 {"SAST", &T::sast, "L", "thickness", no_effect},
                 {"SBST", &T::sbst, "L", "thickness", no_effect},
                 {"SFSAT", &T::sfsat, "-", "thickness", no_effect},
                 {"SFSBT", &T::sfsbt, "-", "thickness", no_effect},
                 {"FSF", &T::fsf, "-", "friction", no_effect},
                 {"VSF", &T::vsf, "-", "friction", no_effect}},
      .optional = true}})};

/// Sums what contacts do to nodes. What touches inside of the surface cancels.
class ForceTransducer : public Pass, public InterfaceReporter {
 public:
  ForceTransducer(Id id, std::string title, std::vector<Index> nodes,
                  std::optional<std::array<NodeContact::Surface, 2>> between,
                  std::vector<std::shared_ptr<const NodeContact>> contacts, const World& world)
      : world_(world),
        id_(id),
        title_(std::move(title)),
        nodes_(std::move(nodes)),
        between_(std::move(between)),
        contacts_(std::move(contacts)) {}
  std::string name() const override { return fmt::format("force transducer {}", id_); }
  InterfaceForce report() const override {
    InterfaceForce out{.id = id_, .title = title_};
    for (const auto& contact : contacts_) {
      if (between_)
        out.on_surfa += contact->force_between((*between_)[0], (*between_)[1]);
      else
        for (const Index n : nodes_) contact->add_force_on(n, out.on_surfa);
    }
    if (between_) return out;
    for (const auto* edges : world_.passes.all<const EdgeContact>())
      if (edges->touches_something())
        for (const Index n : nodes_) edges->add_force_on(n, out.on_surfa);
    return out;
  }

 private:
  const World& world_;
  Id id_;
  std::string title_;
  std::vector<Index> nodes_;
  std::optional<std::array<NodeContact::Surface, 2>> between_;  ///< SURFA and SURFB; nothing: all on SURFA
  std::vector<std::shared_ptr<const NodeContact>> contacts_;
};

NodeContact::Surface surface_of(const World& world, const std::vector<Index>& faces) {
  NodeContact::Surface out{std::vector<char>(static_cast<std::size_t>(world.nodes.size()), 0),
                           std::vector<char>(static_cast<std::size_t>(world.segments.size()), 0)};
  for (const Index s : faces) {
    out.segment[static_cast<std::size_t>(s)] = 1;
    for (const Index n : world.segments.nodes(s)) out.node[static_cast<std::size_t>(n)] = 1;
  }
  return out;
}

/// How many of the nodes belong to faces of other parts, too.
std::ptrdiff_t shared_nodes(const World& world, const std::vector<Index>& nodes,
                            const std::vector<Index>& faces) {
  std::set<Index> parts, of_others;
  for (const Index s : faces) parts.insert(world.segments.part[s]);
  for (Index s = 0; s < world.segments.size(); ++s)
    if (!parts.contains(world.segments.part[s]))
      for (const Index n : world.segments.nodes(s)) of_others.insert(n);
  return std::count_if(nodes.begin(), nodes.end(), [&](Index n) { return of_others.contains(n); });
}

}  // namespace

void add_force_transducers(const Deck& deck, const Model& model, const NodeContactOptions& options,
                           const std::vector<std::shared_ptr<const NodeContact>>& contacts, World& world,
                           Diagnostics& diagnostics) {
  FaceFinder finder(deck, model, options.bulk_modulus, world, diagnostics);
  const auto& others = deck.all<ContactCard>();
  const bool holds = std::any_of(others.begin(), others.end(),
                                 [](const ContactCard& c) { return kind_of(c).tiebreak != Tiebreak::none; });
  for (const T& card : deck.all<T>()) {
    const int errors = diagnostics.errors();
    const std::vector<Index> faces = finder.faces(card, ContactSide::a);
    const std::vector<Index> nodes = finder.nodes(card, ContactSide::a, faces);
    std::optional<std::array<NodeContact::Surface, 2>> between;
    if (card.surfb != 0 || card.surfbtyp == 5) {
      const std::vector<Index> of_b = finder.faces(card, ContactSide::b);
      between = {surface_of(world, faces), surface_of(world, of_b)};
    }
    if (diagnostics.errors() > errors) continue;
    if (const auto shared = between ? 0 : shared_nodes(world, nodes, faces); shared > 0)
      deck.warning(
          diagnostics, card, "SURFA",
          fmt::format(
              "{} of its {} nodes also belong to other parts: all of the force on them is included, also "
              "what "
              "faces of those parts get, so that adjacent transducers sum to more than the contact has",
              shared, nodes.size()),
          "name the parts that hang together as one SURFA");
    if (!options.with_particles.empty())
      deck.error(diagnostics, card, "SURFA", "the forces of particles are not in transducers",
                 "leave it out, or the contacts of particles: their own forces are in rcforc");
    if (between && std::any_of(others.begin(), others.end(), asks_for_edges))
      deck.warning(diagnostics, card, "SURFB", "the forces between edges of SURFA and SURFB are not in it",
                   "leave SURFB out: all forces on SURFA have those of edges, too");
    if (holds)
      deck.warning(
          diagnostics, card, "SURFA",
          "the force with which contacts with _TIEBREAK hold nodes is not in it: rcforc has that under "
          "a number of its own",
          "add both where they act on the same nodes");
    if (nodes.empty() || contacts.empty())
      deck.warning(diagnostics, card, "SURFA",
                   contacts.empty() ? "there is no contact of elements whose force it could measure"
                                    : "it has no nodes of elements",
                   "leave it out");
    world.passes.add(
        std::make_shared<ForceTransducer>(card.cid, card.title, nodes, std::move(between), contacts, world));
  }
}

}  // namespace courant
