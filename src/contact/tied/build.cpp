#include "contact/tied/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string_view>

#include "contact/nodes/build.hpp"
#include "contact/nodes/transducer.hpp"
#include "contact/tied/constraint.hpp"
#include "contact/tied/not_exact.hpp"
#include "contact/tied/on_bodies.hpp"
#include "contact/tied/sides.hpp"
#include "contact/tied/springs.hpp"
#include "contact/tied/tied_card.hpp"
#include "state/shared_fields.hpp"
#include "state/step_share.hpp"

namespace courant {

namespace {

class TiedBuilder {
 public:
  TiedBuilder(const Deck& deck, const Model& model, const TiedOptions& options, World& world,
              Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        options_(options),
        world_(world),
        diagnostics_(diagnostics),
        finder_(deck, model, options.bulk_modulus, world, diagnostics),
        sides_(world) {
    if (const ControlContact* control = deck.last<ControlContact>()) slsfac_ = control->slsfac;
    for (const ModelNode& node : model.nodes) node_of_id_[node.id] = &node;
    for (Index n = 0; n < world.nodes.size(); ++n) of_world_.insert(world.nodes.id[n]);
    for (const ContactCard& c : deck.all<ContactCard>()) taken_.insert(c.cid);
    for (const TiedCard& c : deck.all<TiedCard>()) taken_.insert(c.cid);
    for (const TransducerCard& c : deck.all<TransducerCard>()) taken_.insert(c.cid);
  }

  void add(const TiedCard& c) {
    std::vector<Tie> ties;
    const TiedKind kind = kind_of(c);
    const bool by_part = c.surfatyp == 2 || c.surfatyp == 3;
    const bool of_beams = kind.turns && finder_.has_no_faces(c, ContactSide::a);
    if (!find(c, ties, (kind.welds && by_part) || of_beams)) return;
    if (kind.welds) drop_of_bodies(c, ties);
    if (kind.form != TieForm::spring) drop_tied(c, ties);
    bool exact = kind.form != TieForm::spring;
    if (const auto why =
            exact ? why_not_exact(c, ties, tied_, corners_, model_, options_, world_) : std::nullopt) {
      exact = false;
      if (kind.form == TieForm::exact) {
        for (Tie& tie : ties) tie.k *= stiff / slsfac_;
        warning(c, why->field, why->text + ": springs hold nodes and faces, as stiff as a row of elements",
                why->hint);
      } else
        diagnostics_.note(deck_.where(c), fmt::format("{}: springs hold displacements and rotations, as {}",
                                                      deck_.keyword(c), why->text));
    }
    if (exact) drop_held(c, ties);
    if (ties.empty()) return;
    world_.counters["tied_nodes"] += static_cast<std::int64_t>(ties.size());
    const Id id = c.cid;
    if (exact) return add_exact(c, id, kind.turns, ties);
    if (kind.turns) give_turn_springs(c, ties);
    if (!finder_.are_stiff(c, finder_.faces(c, ContactSide::b, false), false)) return;
    TieStrength strength;
    if (kind.fails) strength.normal = c.fs, strength.shear = c.fd;
    hold_by_springs({.id = id, .title = c.title, .strength = strength, .death = death_of(c)},
                    std::move(ties));
  }

  /// Stiffness of springs for ties that should be exact, over that of a penalty with SLSFAC 1: about that of
  /// elements, with which the step of the elements beside them falls to about half.
  static constexpr Real stiff = 3;

  /// Relaxation in front of the run has a time of its own, in which nothing dies.
  Real death_of(const ContactCard& c) const {
    return model_.phase == RunPhase::relaxation ? std::numeric_limits<Real>::infinity() : c.dt;
  }

  /// Contacts that hold until they break; what they do then is another pass.
  void add_tiebreak(const ContactCard& c) {
    if (!check_tiebreak(c)) return;
    const Tiebreak kind = kind_of(c).tiebreak;
    const bool by_option = kind == Tiebreak::by_option;
    LaterTies later{.contact = c.cid, .scale = slsfac_, .tssfac = options_.tssfac, .bodies = options_.bodies};
    const bool sticks = by_option && (c.option == 1 || c.option == 3);
    std::vector<Tie> ties;
    if (!find(c, ties, false, sticks ? &later : nullptr) || (ties.empty() && !sticks)) return;
    if (!finder_.are_stiff(c, finder_.faces(c, ContactSide::b, false), false)) return;
    if (softens(c)) warn_of_soft(c, ties);
    CohesiveLaw cohesive;
    const auto fault = [&](auto at, std::string what, auto hint) { error(c, at, what, hint); };
    if (is_cohesive(c) && !read_cohesive(c, slsfac_, ties, cohesive, fault)) return;
    world_.counters["tied_nodes"] += static_cast<std::int64_t>(ties.size());
    Id id = c.cid;  // which contact itself has
    while (taken_.contains(id)) ++id;
    taken_.insert(id);
    TiedSpringsLaw law{
        .id = id,
        .title = (c.title.empty() ? fmt::format("contact {}", c.cid) : c.title) + " until it breaks",
        .strength = {by_option && c.option == 1 ? 0 : c.nfls, c.sfls, c.nen, c.mes, kind != Tiebreak::force,
                     softens(c) ? c.param : 0},
        .cohesive = cohesive,
        .death = death_of(c)};
    if (!sticks) return hold_by_springs(std::move(law), std::move(ties));
    for (Tie& tie : ties) tie.k *= slsfac_;
    add_springs(std::move(law), std::move(ties), std::move(later), world_);
  }

  /// Those that tie exactly, all at once. What they leave of the step of elements. [-]
  Real finish() {
    add_spring_limit(springs_, options_.tssfac, options_.bodies, world_);
    if (!first_card_) return 1;
    const HeldAxes held = [this](Index n, bool turns) { return held_axes(n, turns); };
    const Real share = share_of_step(growth_of_frequencies(*exact_, held, world_));
    const MassesOfBodies bodies(*exact_, options_, world_);
    const TiedStart start = start_constraint(*exact_, held, world_);
    if (const Real lost = bodies.give(world_); lost > 0)
      diagnostics_.warning(
          deck_.where(*first_card_),
          fmt::format("{}: {:.4g} [M] of nodes that are tied to rigid bodies count for nothing: the mass of "
                      "these is given",
                      deck_.keyword(*first_card_), lost),
          "add it to what the cards of the bodies give");
    constexpr Real rounding = 1e-6;
    if (start.before - start.after > rounding * start.before)
      diagnostics_.warning(
          deck_.where(*first_card_),
          fmt::format(
              "{}: velocities at the start do not fit: {:.4g} of {:.4g} of kinetic energy [ML2/T2] of the "
              "nodes and their faces is lost, as in a plastic impact",
              deck_.keyword(*first_card_), start.before - start.after, start.before),
          "give what is tied the same velocities");
    add_constraint(exact_, world_);
    return share;
  }

 private:
  static bool softens(const ContactCard& c) {
    return kind_of(c).tiebreak == Tiebreak::by_option && (c.option == 6 || c.option == 8);
  }
  bool check_tiebreak(const ContactCard& c) {
    const int errors = diagnostics_.errors();
    const bool by_option = kind_of(c).tiebreak == Tiebreak::by_option;
    if (by_option && (c.option < 1 || (c.option > 3 && !softens(c) && !is_cohesive(c))))
      error(c, "OPTION", fmt::format("{} is not supported", c.option),
            "1 holds nodes that touch, at the start or later, for ever, 3 until the stress is reached; 2, 6, "
            "8, 9 and 11 hold those that touch at the start");
    for (const auto& [field, value] : {std::pair("NFLS", c.nfls), std::pair("SFLS", c.sfls)})
      if (by_option && c.option != 1 && !(value > 0))
        error(c, field, fmt::format("expected a number > 0, got '{:g}'", value),
              "only OPTION 1 holds for ever");
    // with OPTION 2 and 4: no offset by thickness; other values, and those of OPTION 1 and 3, change nothing
    if (is_cohesive(c) ? false
        : softens(c)   ? !(c.param > 0)
        : by_option    ? c.option == 2 && c.param == 1
                       : c.param != 0)
      error(c, "PARAM", fmt::format("expected {}, got '{:g}'", softens(c) ? "an opening > 0" : "0", c.param),
            "with OPTION 6 and 8 the opening at which nothing holds any more, else none");
    if (by_option && !is_cohesive(c)) warn_of_cohesive_fields(c, deck_, diagnostics_);
    if (c.bt > 0) error(c, "BT", "what holds from the start has no birth", "leave it blank");
    if (world_.particles.size() > 0 && kind_of(c).nodes)
      error(c, "SURFA", "particles cannot be held at faces", "use the contact without _TIEBREAK");
    return diagnostics_.errors() == errors;
  }
  void hold_by_springs(TiedSpringsLaw law, std::vector<Tie> ties) {
    for (Tie& tie : ties) tie.k *= slsfac_, tie.turn_k *= slsfac_;
    springs_.insert(springs_.end(), ties.begin(), ties.end());
    add_springs(std::move(law), std::move(ties), world_);
  }

  std::array<bool, 3> held_axes(Index n, bool turns) const {
    const ModelNode& node = *node_of_id_.at(world_.nodes.id[n]);
    if (!turns) return node.fixed;
    const auto held = model_.held_rotations.find(static_cast<Index>(&node - model_.nodes.data()));
    return held == model_.held_rotations.end() ? std::array<bool, 3>{} : held->second;
  }

  /// `growth`: of the largest frequency.
  Real share_of_step(Real growth) {
    const Real share = step_share(options_.tssfac, growth);
    if (share == 1) return 1;
    diagnostics_.warning(
        deck_.where(*first_card_),
        fmt::format("{}: nodes are so far beside small or light faces, which rotate them, that the step "
                    "is {:.3g} of that of the elements",
                    deck_.keyword(*first_card_), share),
        "leave out nodes that are far from their faces, or make these larger or thicker");
    return share;
  }

  void error(const ContactCard& c, const char* field, std::string message, std::string hint) {
    if (field[0] != 0) return deck_.error(diagnostics_, c, field, std::move(message), std::move(hint));
    diagnostics_.error(deck_.where(c), deck_.keyword(c) + ": " + message, std::move(hint));  // of the whole
  }

  void warning(const ContactCard& c, const char* field, std::string message, std::string hint) {
    if (field[0] != 0) return deck_.warning(diagnostics_, c, field, std::move(message), std::move(hint));
    diagnostics_.warning(deck_.where(c), deck_.keyword(c) + ": " + message, std::move(hint));
  }

  /// Which nodes are next to which faces, with what is to be reported of that.
  /// `of_elements`: SURFA names parts, whose elements need no faces. `later`: gets nodes and faces, which may
  /// be tied where they come to touch.
  bool find(const ContactCard& c, std::vector<Tie>& ties, bool of_elements = false,
            LaterTies* later = nullptr) {
    const int errors = diagnostics_.errors();
    if (world_.dim == 2) {
      error(c, "", "tied contact needs a scene of three dimensions", "leave it out");
      return false;
    }
    if (c.bt > 0 && c.bt < model_.endtim)
      error(c, "BT", "what is tied is so from the start", "leave it blank");
    const std::vector<Index> faces_a =
        of_elements ? std::vector<Index>{} : finder_.faces(c, ContactSide::a, false);
    const std::vector<Index> faces_b = finder_.faces(c, ContactSide::b, false);
    const std::vector<Index> nodes_a = of_elements ? finder_.nodes_of_elements(c, ContactSide::a)
                                                   : finder_.nodes(c, ContactSide::a, faces_a);
    check_set(c);
    if (diagnostics_.errors() > errors) return false;
    const bool of_nodes = of_elements || c.surfatyp == 4;
    std::vector<Index> of_both;
    std::vector<TieNode> nodes = sides_.nodes(c, nodes_a, of_nodes ? finder_.faces_around(nodes_a) : faces_a);
    std::vector<TieFace> faces = sides_.faces(c, faces_b);
    ties = find_ties(nodes, faces, TieSides::tolerance(c), world_.nodes.x, &of_both);
    if (later) later->nodes = std::move(nodes), later->faces = std::move(faces);
    if (later && !nodes_a.empty()) return true;
    warn_of_free(c, nodes_a, faces_b, ties);
    warn_of_both(c, of_both);
    warn_of_coarse(c, ties);
    return true;
  }
  /// What a node set names that is no node of elements.
  void check_set(const ContactCard& c) {
    const auto set = model_.node_sets.find(c.surfa);
    if (c.surfatyp != 4 || set == model_.node_sets.end()) return;
    if (particles_.empty())
      for (const ModelSph& s : model_.sph) particles_.insert(s.node);
    std::size_t count = 0;
    Id first = 0;
    for (const Index n : set->second) {
      const Id id = model_.nodes[static_cast<std::size_t>(n)].id;
      if (particles_.contains(n))
        return error(c, "SURFA", fmt::format("node {} is a particle, which cannot be tied", id),
                     "name nodes of elements alone");
      if (!of_world_.contains(id) && count++ == 0) first = id;
    }
    if (count > 0)
      deck_.warning(diagnostics_, c, "SURFA",
                    fmt::format("{} nodes, the first is {}, belong to no element: they stay where they are",
                                count, first),
                    "leave them out");
  }

  /// Springs of rotations that are as fast as those of displacements, by inertia and mass of node and
  /// corners.
  void give_turn_springs(const ContactCard& c, std::vector<Tie>& ties) {
    const Field<Real>* const inertia = shared_fields::rotary_inertia.find(world_.nodes.fields);
    const Field<Index>* const none = shared_fields::no_rotation.find(world_.nodes.fields);
    std::size_t hinges = 0;
    for (Tie& tie : ties) {
      const auto turns = [&](Index n) { return none && ((*none)[n] == 0 || world_.nodes.follow[n] == 1); };
      if (!turns(tie.node)) continue;
      const auto corners = std::span(tie.at.node).first(static_cast<std::size_t>(tie.at.corners));
      if (!std::all_of(corners.begin(), corners.end(), turns)) {
        ++hinges;
        continue;
      }
      Real least = std::numeric_limits<Real>::infinity();
      const auto take = [&](Index n) {
        if ((*inertia)[n] > 0 && world_.nodes.m[n] > 0)
          least = std::min(least, (*inertia)[n] / world_.nodes.m[n]);
      };
      take(tie.node);
      for (const Index n : corners) take(n);
      if (std::isfinite(least)) tie.turn_k = tie.k * least;
    }
    warn_of_hinges(c, hinges);
  }

  /// Takes ties away for which `is` holds, and states why.
  template <class F>
  void drop(const ContactCard& c, std::vector<Tie>& ties, const F& is, std::string_view why,
            const char* hint) {
    std::size_t count = 0;
    Id first = 0;
    std::erase_if(ties, [&](const Tie& tie) {
      if (!is(tie)) return false;
      if (count++ == 0) first = world_.nodes.id[tie.node];
      return true;
    });
    if (count > 0)
      deck_.warning(diagnostics_, c, "SURFA", fmt::format("{} nodes, the first is {}, {}", count, first, why),
                    hint);
  }

  /// Ends of welds that belong to rigid bodies go with these.
  void drop_of_bodies(const ContactCard& c, std::vector<Tie>& ties) {
    drop(
        c, ties, [&](const Tie& tie) { return options_.bodies.body(tie.node) >= 0; },
        "belong to rigid bodies, with which they go: they are not tied", "leave them out");
  }

  /// A node goes with one face.
  void drop_tied(const ContactCard& c, std::vector<Tie>& ties) {
    drop(
        c, ties, [&](const Tie& tie) { return tied_.contains(tie.node); },
        "are tied by an earlier contact already: they stay with its faces",
        "leave them out of one of the two, or use it with _OFFSET");
  }

  /// Nodes that SPC hold go with a face only if that is held alike.
  void drop_held(const ContactCard& c, std::vector<Tie>& ties) {
    const auto held_more = [&](const Tie& tie) {
      constexpr Real none = 1e-9;
      const ModelNode& node = *node_of_id_.at(world_.nodes.id[tie.node]);
      for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e) {
        const ModelNode& corner = *node_of_id_.at(world_.nodes.id[tie.at.node[e]]);
        for (std::size_t k = 0; k < 3; ++k)
          if (node.fixed[k] && !corner.fixed[k] && (std::abs(tie.at.N[e]) > none || tie.at.gap != 0))
            return true;
      }
      return false;
    };
    drop(c, ties, held_more, "are held by *BOUNDARY_SPC or TC, and their faces are not: they are not tied",
         "hold the corners of the faces, too, or free the nodes");
  }

  void warn_of_free(const ContactCard& c, const std::vector<Index>& nodes, const std::vector<Index>& faces,
                    const std::vector<Tie>& ties) {
    std::set<Index> there;
    for (const Tie& tie : ties) there.insert(tie.node);
    for (const Index s : faces)  // corners are joined already
      for (const Index n : world_.segments.nodes(s)) there.insert(n);
    std::size_t count = 0;
    Id first = 0;
    for (const Index n : nodes)
      if (!there.contains(n) && count++ == 0) first = world_.nodes.id[n];
    if (count == 0 && !nodes.empty()) return;
    const bool by_parts = c.surfatyp == 2 || c.surfatyp == 3 || c.surfatyp == 5;
    if (by_parts && !ties.empty())  // most nodes of a part are elsewhere
      return diagnostics_.note(deck_.where(c),
                               fmt::format("{}: {} of the {} nodes of SURFA are tied", deck_.keyword(c),
                                           nodes.size() - count, nodes.size()),
                               "if more should be, give the largest distance by negative SAST and SBST: 0.6 "
                               "(|SAST| + |SBST|)");
    deck_.warning(
        diagnostics_, c, "SURFA",
        nodes.empty() ? std::string("it has no nodes of elements, so nothing is tied")
                      : fmt::format("{} of {} nodes, the first is {}, are not tied: they are not over "
                                    "a face, or too far from it",
                                    count, nodes.size(), first),
        "leave them out, or give the largest distance by negative SAST and SBST: 0.6 (|SAST| + |SBST|)");
  }

  /// Springs that open further than PARAM before the stress is there have nothing to soften.
  void warn_of_soft(const ContactCard& c, const std::vector<Tie>& ties) {
    Real widest = 0;
    for (const Tie& tie : ties)
      widest = std::max(widest, std::min(c.nfls, c.sfls) * tie.area / (slsfac_ * tie.k));
    if (widest < c.param) return;
    deck_.warning(
        diagnostics_, c, "PARAM",
        fmt::format("the springs are {:.3g} long where the stress is reached, so that they break at once",
                    widest),
        "raise SFSA and SFSB, or PARAM");
  }

  void warn_of_both(const ContactCard& c, const std::vector<Index>& nodes) {
    if (nodes.empty()) return;
    deck_.warning(
        diagnostics_, c, "SURFA",
        fmt::format("{} nodes, the first is {}, are next to faces of SURFB and are corners of others of "
                    "its faces: they are not tied",
                    nodes.size(), world_.nodes.id[nodes.front()]),
        "let SURFB be one side of the joint alone, and SURFA the other");
  }

  // Corners between nodes that are further apart than faces are wide would hang free.
  void warn_of_coarse(const ContactCard& c, const std::vector<Tie>& ties) {
    Real of_nodes = 0, of_faces = 0;
    for (const Tie& tie : ties) of_nodes += tie.cell, of_faces += sides_.area(tie.segment);
    constexpr Real coarser = 1.5;
    if (of_nodes > coarser * of_faces)
      deck_.warning(
          diagnostics_, c, "SURFA",
          fmt::format(
              "its faces are {:.2g} times as large as those next to them: nodes of SURFB in between are "
              "not held, and the joint is too soft",
              of_nodes / of_faces),
          "exchange SURFA and SURFB: the finer mesh should be SURFA");
  }

  void add_exact(const ContactCard& c, Id id, bool turns, const std::vector<Tie>& ties) {
    for (const Tie& tie : ties) {
      tied_.insert(tie.node);
      corners_.insert(tie.at.node.begin(), tie.at.node.end());
    }
    const std::size_t first = exact_->ties.size();
    exact_->ties.insert(exact_->ties.end(), ties.begin(), ties.end());
    exact_->turns.resize(exact_->ties.size(), 0);
    for (const Tie& tie : ties) exact_->on_body.push_back(is_on_body(tie, options_.bodies));
    exact_->contacts.push_back({id, c.title, first, exact_->ties.size(), death_of(c)});
    if (turns) take_turns(c, first);
    if (!first_card_) first_card_ = &c;
  }

  bool turns_less_than_face(const Tie& tie) const {
    const std::array<bool, 3> held = held_axes(tie.node, true);
    for (std::size_t e = 0; e < static_cast<std::size_t>(tie.at.corners); ++e) {
      const std::array<bool, 3> corner = held_axes(tie.at.node[e], true);
      for (std::size_t k = 0; k < 3; ++k)
        if (held[k] && !corner[k]) return true;
    }
    return false;
  }

  /// Rotations go with faces whose corners have some.
  void take_turns(const ContactCard& c, std::size_t first) {
    const Field<Index>* none = shared_fields::no_rotation.find(world_.nodes.fields);
    std::size_t hinges = 0, count = 0;
    Id first_held = 0;
    for (std::size_t t = first; none && t < exact_->ties.size(); ++t) {
      const Tie& tie = exact_->ties[t];
      if ((*none)[tie.node] != 0) continue;
      if (turns_less_than_face(tie)) {
        if (count++ == 0) first_held = world_.nodes.id[tie.node];
        continue;
      }
      const bool turns = std::all_of(tie.at.node.begin(), tie.at.node.end(), [&](Index n) {
        return (*none)[n] == 0 || world_.nodes.follow[n] == 1;  // bodies turn their nodes
      });
      exact_->turns[t] = turns, hinges += !turns;
    }
    if (count > 0)
      deck_.warning(
          diagnostics_, c, "SURFA",
          fmt::format("rotations of {} nodes, the first is {}, are held by *BOUNDARY_SPC or RC, and those of "
                      "their faces are not: they stay held, and no moment goes to the faces",
                      count, first_held),
          "hold the corners of the faces, too, or free the nodes");
    warn_of_hinges(c, hinges);
  }

  void warn_of_hinges(const ContactCard& c, std::size_t hinges) {
    if (hinges > 0)
      deck_.warning(
          diagnostics_, c, "SURFB",
          fmt::format("rotations of {} of the tied nodes stay free, as at a hinge: the faces next to "
                      "them belong to elements without rotations",
                      hinges),
          "tie more than one row of nodes to solids, or a shell that lies on them");
  }

  const Deck& deck_;
  const Model& model_;
  const TiedOptions& options_;
  World& world_;
  Diagnostics& diagnostics_;
  FaceFinder finder_;
  TieSides sides_;
  Real slsfac_ = 0.1;
  std::map<Id, const ModelNode*> node_of_id_;
  std::set<Id> taken_;         // ids of contacts
  std::set<Id> of_world_;      // nodes that are there
  std::set<Index> particles_;  // indices into Model::nodes
  std::shared_ptr<TiedConstraint> exact_ = std::make_shared<TiedConstraint>();
  const ContactCard* first_card_ = nullptr;  // of an exact contact
  std::set<Index> tied_, corners_;           // of all exact contacts so far
  std::vector<Tie> springs_;                 // of all others
};

}  // namespace

Real add_tied_contacts(const Deck& deck, const Model& model, const TiedOptions& options, World& world,
                       Diagnostics& diagnostics) {
  const auto& cards = deck.all<TiedCard>();
  const auto& others = deck.all<ContactCard>();
  const bool any = std::any_of(others.begin(), others.end(),
                               [](const ContactCard& c) { return kind_of(c).tiebreak != Tiebreak::none; });
  if (cards.empty() && !any) return 1;
  TiedBuilder builder(deck, model, options, world, diagnostics);
  for (const ContactCard& c : others)
    if (kind_of(c).tiebreak != Tiebreak::none) builder.add_tiebreak(c);
  for (const TiedCard& c : cards) builder.add(c);
  return diagnostics.ok() ? builder.finish() : 1;
}

}  // namespace courant
