// Cards of rigid bodies of nodes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "model/mesh/inertia_table.hpp"
#include "model/transforms/transformation.hpp"
#include "rigid/bodies/nodal_bodies.hpp"
#include "rigid/bodies/rigid_cards.hpp"
#include "rigid/switches/failing_welds.hpp"

namespace courant {

namespace {

struct NodalBodyCard : PartInertiaCard {
  Id out_cid = 0, nsid = 0, pnode = 0;
  int iprt = 0, drflag = 0, rrflag = 0;
  Real cmo = 0, con1 = 0, con2 = 0;
};
using NB = NodalBodyCard;

/// In the order of the names.
struct NodalBodyOptions {
  bool spc = false, inertia = false;
};
constexpr NodalBodyOptions nodal_options[] = {
    {}, {.spc = true}, {.inertia = true}, {.spc = true, .inertia = true}, {.spc = true, .inertia = true}, {}};
bool has_spc(const NB& card) {
  return nodal_options[card.name].spc;
}
bool has_inertia(const NB& card) {
  return nodal_options[card.name].inertia;
}

std::string move_nodal_body(NB& card, const Affine& motion) {
  if (card.cmo == 1)
    for (Real* code : {&card.con1, &card.con2}) {
      if (!(*code > 0 && *code < 7 && *code == std::floor(*code))) continue;
      auto held = axes_of_code(static_cast<int>(*code));
      std::string reason = move_held_axes(held, motion);
      if (!reason.empty()) return reason;
      *code = code_of_axes(held);
    }
  return has_inertia(card) ? turn_inertia(card, motion) : std::string();
}

CardOf<NB> first_card() {
  return {.fields = {{"PID", &NB::pid, "-", "id of the body, among the parts", rules::required_id},
                     {"CID",
                      &NB::out_cid,
                      "-",
                      "system of the output",
                      {.honour = Honour::output_only, .refers = IdSpace::coordinate_system}},
                     {"NSID", &NB::nsid, "-", "node set, 0: that with the id of the body",
                      rules::optional_id_of(IdSpace::node_set)},
                     {"PNODE", &NB::pnode, "-", "node at the centre of mass, which goes with the body",
                      rules::id_of(IdSpace::node)},
                     {"IPRT", &NB::iprt, "-", "print flag", no_effect},
                     {"DRFLAG", &NB::drflag, "-", "released translations", unsupported},
                     {"RRFLAG", &NB::rrflag, "-", "released rotations", unsupported}}};
}
CardOf<NB> spc_card() {
  return {
      .fields = {{"CMO", &NB::cmo, "-", "0 free, 1 constrained along the global axes", {}},
                 {"CON1", &NB::con1, "-", "held translations: 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 all", {}},
                 {"CON2", &NB::con2, "-", "held rotations: 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 all", {}}},
      .when = has_spc};
}
KeywordOf<NB> nodal_body_keyword() {
  KeywordOf<NB> out{
      .names = {"CONSTRAINED_NODAL_RIGID_BODY", "CONSTRAINED_NODAL_RIGID_BODY_SPC",
                "CONSTRAINED_NODAL_RIGID_BODY_INERTIA", "CONSTRAINED_NODAL_RIGID_BODY_SPC_INERTIA",
                "CONSTRAINED_NODAL_RIGID_BODY_INERTIA_SPC", "CONSTRAINED_NODAL_RIGIDBODY"},
      .purpose = "nodes of elements that move as one rigid body; its mass is theirs, or with _INERTIA given",
      .id_space = IdSpace::part,
      .title_option = true,
      .id_may_repeat = true,
      .title = &NB::title,
      .cards = {first_card(), spc_card()},
      .move = move_nodal_body};
  for (CardOf<NB>& card : inertia_cards<NB>("CID2")) {
    card.when = has_inertia;
    out.cards.push_back(std::move(card));
  }
  out.cards.back().when = [](const NB& card) { return has_inertia(card) && card.ircs == 1; };
  return out;
}
const RegisterKeyword<NB> nodal_body{nodal_body_keyword()};

using SW = SpotweldCard;
const RegisterKeyword<SW> spotweld_keyword{constrained_spotweld_table()};

using WS = WeldSpotCard;
const RegisterKeyword<WS> weld_spot_keyword{constrained_generalized_weld_spot_table()};

class NodalBodyReader {
 public:
  NodalBodyReader(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics) {
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      node_of_id_[model.nodes[n].id] = static_cast<Index>(n);
    for (const ModelSph& s : model.sph) particles_.insert(s.node);
    for (const ModelPart& part : model.parts)
      next_id_ = std::max(next_id_, part.id + 1), taken_.insert(part.id);
    for (const NB& card : deck.all<NB>()) next_id_ = std::max(next_id_, card.pid + 1);
  }

  void add(const NB& card) {
    const bool is_new = taken_.insert(card.pid).second;
    const Id id = is_new ? card.pid : next_id_++;
    if (!is_new)
      deck_.warning(
          diagnostics_, card, "PID",
          fmt::format("part {} is defined already: this body is {} in outputs, and nothing in the deck "
                      "can name it",
                      card.pid, id),
          "give it an id that no part has");
    NodalBody b{.id = id, .name = fmt::format("nodal rigid body {}", id), .card = card};
    if (!add_set(card, card.nsid == 0 ? "PID" : "NSID", card.nsid == 0 ? card.pid : card.nsid, b)) return;
    if (card.pnode != 0) {
      const auto node = node_of_id_.find(std::abs(card.pnode));
      if (node == node_of_id_.end() || particles_.contains(node->second))
        return error(card, "PNODE", fmt::format("node {} does not exist", std::abs(card.pnode)),
                     "define it with *NODE");
      b.output_node = node->second;
    }
    if (!read_constraints(card, b)) return;
    if (has_inertia(card)) b.given = card;
    bodies_.push_back(std::move(b));
  }
  void add(const SW& card) {
    NodalBody b{
        .id = next_id_++, .name = fmt::format("spotweld of nodes {} and {}", card.n1, card.n2), .card = card};
    for (const auto& [field, id] : {std::pair("N1", card.n1), std::pair("N2", card.n2)}) {
      const auto node = node_of_id_.find(id);
      if (node == node_of_id_.end())
        return error(card, field, fmt::format("node {} does not exist", id), "define it with *NODE");
      if (!add_node(card, field, node->second, b)) return;
    }
    finish(std::move(b), card, "N2");
  }
  void add(const WS& card) {
    NodalBody b{.id = next_id_++, .name = fmt::format("weld of node set {}", card.nsid), .card = card};
    if (add_set(card, "NSID", card.nsid, b)) bodies_.push_back(std::move(b));
  }
  std::vector<NodalBody> bodies() { return std::move(bodies_); }

 private:
  void error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  void finish(NodalBody b, const Entry& card, const char* field) {
    std::sort(b.nodes.begin(), b.nodes.end());
    if (b.nodes.front() == b.nodes.back())
      return error(card, field, "the same node twice", "a weld is between two nodes");
    bodies_.push_back(std::move(b));
  }
  bool add_node(const Entry& card, const char* field, Index node, NodalBody& b) {
    const Id id = model_.nodes[static_cast<std::size_t>(node)].id;
    if (particles_.contains(node)) {
      error(card, field, fmt::format("node {} is a particle", id), "name nodes of elements");
      return false;
    }
    b.nodes.push_back(node);
    return true;
  }
  bool add_set(const Entry& card, const char* field, Id id, NodalBody& b) {
    const auto set = model_.node_sets.find(id);
    if (set == model_.node_sets.end() || set->second.empty()) {
      error(card, field,
            fmt::format("node set {} {}", id, set == model_.node_sets.end() ? "does not exist" : "is empty"),
            "define it with *SET_NODE");
      return false;
    }
    for (const Index n : set->second)
      if (!add_node(card, field, n, b)) return false;
    std::sort(b.nodes.begin(), b.nodes.end());
    b.nodes.erase(std::unique(b.nodes.begin(), b.nodes.end()), b.nodes.end());
    return true;
  }
  bool read_constraints(const NB& card, NodalBody& b) {
    if (!has_spc(card) || card.cmo == 0) return true;
    if (card.cmo != 1) {
      error(card, "CMO", fmt::format("'{:g}' (a constraint along local axes) is not supported", card.cmo),
            "use CMO = 1 with CON1 and CON2 along the global axes");
      return false;
    }
    for (const auto& [field, value, axes] :
         {std::tuple("CON1", card.con1, &b.held), std::tuple("CON2", card.con2, &b.no_turn)}) {
      if (!(value >= 0 && value <= 7 && value == std::floor(value))) {
        error(card, field, fmt::format("expected a code 0 to 7, got '{:g}'", value), "7 holds all axes");
        return false;
      }
      *axes = axes_of_code(static_cast<int>(value));
    }
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::map<Id, Index> node_of_id_;
  std::set<Index> particles_;
  std::set<Id> taken_;
  Id next_id_ = 1;
  std::vector<NodalBody> bodies_;
};

}  // namespace

std::set<Id> nodal_body_ids(const Deck& deck, const Model& model) {
  std::set<Id> out;
  for (const NB& card : deck.all<NB>())
    if (!model.part_of_id.contains(card.pid)) out.insert(card.pid);
  return out;
}

std::vector<NodalBody> nodal_bodies(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  const auto& cards = deck.all<NB>();
  const auto& spots = deck.all<SW>();
  const auto& sets = deck.all<WS>();
  if (cards.empty() && spots.empty() && sets.empty()) return {};
  NodalBodyReader reader(deck, model, diagnostics);
  for (const NB& card : cards) reader.add(card);
  for (const SW& card : spots)
    if (!may_fail(card)) reader.add(card);
  for (const WS& card : sets)
    if (!may_fail(card)) reader.add(card);
  return reader.bodies();
}

}  // namespace courant
