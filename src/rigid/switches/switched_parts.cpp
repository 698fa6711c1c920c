// Parts that are rigid for a while (*DEFORMABLE_TO_RIGID_AUTOMATIC, *RIGID_DEFORMABLE). Their nodes stay
// nodes that move by their forces: while a part is rigid, these are replaced by those that make the nodes
// move as one body, once all forces at t^n and dt are known. So whatever pushes nodes, pushes the body;
// elements turn with it without a strain, and keep their stress.
#include "rigid/switches/switched_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "extension/additions.hpp"
#include "loads/sensors/sensor_force.hpp"
#include "rigid/bodies/body_mass.hpp"
#include "rigid/bodies/held_nodes.hpp"
#include "rigid/bodies/rigid.hpp"
#include "rigid/switches/body_for_a_while.hpp"
#include "rigid/switches/deformable_to_rigid.hpp"
#include "rigid/switches/switch_cards.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Parts that are one body while they are rigid.
struct SwitchedBody : BodyForAWhile {
  std::vector<Index> parts{};
};

/// A switch, with bodies by index.
struct PartSwitch {
  AutomaticSwitch card;
  std::vector<std::size_t> stiffens{}, releases{};
  int related = -1;
  Index acted = 0;  ///< how often
};

class SwitchedParts : public SwitchedNodes,
                      public Impact,
                      public EnergyTerm,
                      public TimeLimit,
                      public Restartable {
 public:
  SwitchedParts(std::vector<SwitchedBody> bodies, std::vector<PartSwitch> switches,
                std::vector<std::size_t> at_start, const World& world)
      : bodies_(std::move(bodies)),
        switches_(std::move(switches)),
        at_start_(std::move(at_start)),
        turns_(world) {}
  std::string name() const override { return "parts that are rigid for a while"; }
  std::vector<std::vector<Index>> nodes_of_bodies() const override {
    std::vector<std::vector<Index>> out;
    for (const SwitchedBody& body : bodies_) out.push_back(body.b.nodes);
    return out;
  }

  void strike(World& world, const Clock& clock) override {
    if (clock.cycle != looked_at_) look(world, clock);
    looked_at_ = clock.cycle;
    for (SwitchedBody& body : bodies_)
      if (body.active != 0) body.move(world, clock, turns_);
  }
  bool rings() const override { return false; }
  Limit limit(const World&, const Clock&) override { return {longest_, "DTMAX of " + name()}; }

  void record(World&, const Clock& clock, EnergyLedger&) override {
    for (SwitchedBody& body : bodies_) body.advance(clock);
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  void keep(Archive& archive) override {
    const auto is_new = [&](const std::string& what) { return archive.loading() && !archive.has(what); };
    if (is_new("looked_at")) return;  // the run so far had no switches
    archive("looked_at", looked_at_), archive("blocked_until", blocked_until_), archive("longest", longest_);
    for (std::size_t k = 0; k < switches_.size(); ++k)
      if (const std::string& name = switches_[k].card.at_restart,
          acted = fmt::format("acted {}", name.empty() ? std::to_string(k) : name);
          !is_new(acted))
        archive(acted, switches_[k].acted);
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const std::string of_body = fmt::format("body {}", k);
      if (is_new(of_body + "/active")) continue;
      const Archive::Group inside(archive, of_body);
      bodies_[k].keep(archive);
    }
  }

 private:
  bool may_act(const PartSwitch& s, const World& world) const {
    if (!s.card.at_restart.empty()) return world.goes_on && s.acted == 0;
    const Index of_related = s.related < 0 ? 0 : switches_[static_cast<std::size_t>(s.related)].acted;
    if (s.card.paired == 1) return s.acted == of_related;
    if (s.card.paired == -1) return s.acted < of_related;
    return s.acted == 0 && (s.related < 0 || of_related > 0);
  }
  static bool holds(const AutomaticSwitch& c, const World& world, Real t) {
    if (t < c.time1) return false;
    if (c.code == 0) return true;
    if (t > c.time2) return false;
    const auto force = c.of_wall() ? force_on_wall(world, c.entno) : force_of_contact(world, c.entno);
    const bool pushes = force.value_or(Vec::Zero()).squaredNorm() > 0;
    return pushes == (c.code == 3 || c.code == 4);
  }

  void look(World& world, const Clock& clock) {
    if (looked_at_ < 0)
      for (const std::size_t k : at_start_) stiffen(world, clock, bodies_[k]);
    for (PartSwitch& s : switches_) {
      if (clock.t < blocked_until_ || !may_act(s, world) || !holds(s.card, world, clock.t)) continue;
      ++s.acted;
      bool any = s.card.at_restart.empty();
      for (const std::size_t k : s.releases) any |= bodies_[k].release(world, clock, turns_);
      for (const std::size_t k : s.stiffens) any |= stiffen(world, clock, bodies_[k]);
      if (s.card.time3 > 0) blocked_until_ = clock.t + s.card.time3;
      if (s.card.at_restart.empty() || s.card.dtmax > 0)
        longest_ = s.card.dtmax > 0 ? s.card.dtmax : std::numeric_limits<Real>::infinity();
      world.counters["rigid_switches"] += any;
    }
  }

  bool stiffen(World& world, const Clock& clock, SwitchedBody& body) const {
    if (body.active != 0 || some_part_is_rigid(body)) return false;
    body.stiffen(world, clock, turns_);
    return true;
  }
  bool some_part_is_rigid(const SwitchedBody& body) const {
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const SwitchedBody& other) {
      return other.active != 0 && std::any_of(body.parts.begin(), body.parts.end(), [&](Index part) {
               return std::find(other.parts.begin(), other.parts.end(), part) != other.parts.end();
             });
    });
  }
  std::vector<SwitchedBody> bodies_;
  std::vector<PartSwitch> switches_;
  std::vector<std::size_t> at_start_;  ///< bodies that are rigid then
  NodalTurns turns_;
  std::int64_t looked_at_ = -1;  ///< cycle
  Real blocked_until_ = 0;       ///< [T]
  Real longest_ = std::numeric_limits<Real>::infinity();
};

class SwitchReader {
 public:
  SwitchReader(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (const auto& group : world.groups)
      if (group->part >= 0 && group->corners() > 1)
        for (int c = 0; c < group->corners(); ++c)
          nodes_of_[group->part].insert(group->node.data(c), group->node.data(c) + group->size());
    for (Index n = 0; n < world.nodes.size(); ++n) node_of_id_[world.nodes.id[n]] = n;
    for (const ModelNode& node : model.nodes)
      if (const auto n = node_of_id_.find(node.id); n != node_of_id_.end() && is_constrained(model, node))
        held_.insert(n->second);
    for (const ModelInertia& one : model.inertias)
      if (const auto n = node_of_id_.find(model.nodes[static_cast<std::size_t>(one.node)].id);
          n != node_of_id_.end() && one.turns())
        heavy_.insert(n->second);
  }

  void add_start() {
    const std::vector<SwitchedLead> static_ones = released_later(deck_, model_);
    std::vector<PartAndLead> list;
    for (const SwitchedLead& one : static_ones)
      if (const auto part = model_.part_of_id.find(one.part); part != model_.part_of_id.end())
        list.push_back({part->second, one.lead});
    if (!list.empty()) at_start_ = add_bodies(static_ones.front().card, "PID", list);
  }
  void add(const AutomaticSwitch& card) {
    PartSwitch s{.card = card};
    s.stiffens = add_bodies(card, "D2R", parts_to_rigid(deck_, model_, card, diagnostics_));
    if (card.of_wall() || card.of_contact()) {
      if (card.entno == 0) error(card, "ENTNO", "no wall or contact is named", "give its number");
    } else if (card.paired != 0) {
      error(card, "PAIRED", "a switch by time (CODE 0) cannot act again",
            "leave it blank, or choose another CODE");
    }
    if (card.d2r == 0 && card.r2d == 0)
      deck_.warning(diagnostics_, card, "D2R", "the switch names no part: it does nothing", "leave it out");
    switches_.push_back(std::move(s));
  }
  void add_at_restart(const AutomaticSwitch& card) {
    switches_.push_back(
        {.card = card,
         .stiffens = add_bodies(card, card.d2r_field, parts_to_rigid(deck_, model_, card, diagnostics_))});
  }
  void finish() {
    for (PartSwitch& s : switches_) {
      relate(s);
      const std::vector<Index> soft = parts_to_deformable(deck_, model_, s.card, diagnostics_);
      for (const Index part : soft) {
        if (model_.parts[static_cast<std::size_t>(part)].rigid)
          error(s.card, s.card.r2d_field,
                fmt::format(
                    "part {} is {}", id_of(part),
                    !s.card.at_restart.empty() ? "rigid for good" : "a *MAT_RIGID, which cannot deform"),
                !s.card.at_restart.empty()
                    ? "let the run that comes before name it in R2D of a "
                      "*DEFORMABLE_TO_RIGID_AUTOMATIC, if with a TIME1 behind its end"
                    : "give it a material with strength, and make it rigid by *DEFORMABLE_TO_RIGID");
        else if (std::none_of(bodies_.begin(), bodies_.end(),
                              [&](const SwitchedBody& b) { return has(b, part); }))
          deck_.warning(diagnostics_, s.card, s.card.r2d_field,
                        fmt::format("part {} is never rigid before", id_of(part)),
                        "make it rigid by another switch, or by *DEFORMABLE_TO_RIGID");
      }
      for (std::size_t k = 0; k < bodies_.size(); ++k) find_released(s, k, soft);
    }
    if (!world_.passes.all<const RigidWallReporter>().empty() && !bodies_.empty())
      deck_.warning(
          diagnostics_, switches_.front().card, switches_.front().card.d2r_field,
          "rigid walls stop the nodes of a part that is rigid for a while one by one: the body gets a "
          "little behind them, and what it loses there is not the walls' account",
          "let it be deformable where it meets a wall: CODE 3 with R2D");
    if (diagnostics_.ok() && !switches_.empty())
      world_.passes.add(std::make_shared<SwitchedParts>(std::move(bodies_), std::move(switches_),
                                                        std::move(at_start_), world_));
  }

 private:
  void error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  Id id_of(Index part) const { return model_.parts[static_cast<std::size_t>(part)].id; }
  static bool has(const SwitchedBody& body, Index part) {
    return std::find(body.parts.begin(), body.parts.end(), part) != body.parts.end();
  }

  void relate(PartSwitch& s) {
    if (s.card.relsw == 0) {
      if (s.card.paired != 0) error(s.card, "RELSW", "a paired switch needs the other one", "give its SWSET");
      return;
    }
    for (std::size_t k = 0; k < switches_.size(); ++k)
      if (switches_[k].card.swset == s.card.relsw) s.related = static_cast<int>(k);
    if (s.related < 0)
      return error(s.card, "RELSW", fmt::format("switch {} does not exist", s.card.relsw),
                   "give the SWSET of another");
    if (const PartSwitch& other = switches_[static_cast<std::size_t>(s.related)];
        s.card.paired != 0 && (other.card.relsw != s.card.swset || other.card.paired != -s.card.paired))
      error(s.card, "PAIRED", fmt::format("switch {} is not the other one of the pair", s.card.relsw),
            "let each name the other in RELSW, one with PAIRED 1, one with -1");
  }
  void find_released(PartSwitch& s, std::size_t k, const std::vector<Index>& soft) {
    const auto& parts = bodies_[k].parts;
    const auto count = std::count_if(parts.begin(), parts.end(), [&](Index part) {
      return std::find(soft.begin(), soft.end(), part) != soft.end();
    });
    if (count == static_cast<std::ptrdiff_t>(parts.size())) return s.releases.push_back(k);
    if (count > 0)
      error(s.card, s.card.r2d_field,
            fmt::format("part {} is one rigid body with parts that stay rigid", id_of(soft.front())),
            "release all parts of a body at once");
  }

  /// One for each lead; those that share nodes are one.
  std::vector<std::size_t> add_bodies(const Entry& card, const char* field,
                                      const std::vector<PartAndLead>& list) {
    std::vector<SwitchedBody> bodies;
    for (const PartAndLead& one : list) {
      if (!check_part(card, field, one.part)) return {};
      const auto lead = model_.part_of_id.find(one.lead);
      const Index of_lead = one.lead == 0 || lead == model_.part_of_id.end() ? one.part : lead->second;
      if (std::none_of(list.begin(), list.end(), [&](const PartAndLead& p) { return p.part == of_lead; }) ||
          (one.lead != 0 && lead == model_.part_of_id.end())) {
        error(card, field,
              fmt::format("LRB {} of part {} is not in the same list", one.lead, id_of(one.part)),
              "name a part that becomes rigid with it; to join a *MAT_RIGID is not supported");
        return {};
      }
      SwitchedBody body;
      body.parts = {one.part};
      std::set<Index> nodes = nodes_of_[one.part];
      for (auto other = bodies.begin(); other != bodies.end();) {
        const bool joined = has(*other, of_lead) || shares(other->b.nodes, nodes) ||
                            std::any_of(list.begin(), list.end(), [&](const PartAndLead& p) {
                              return has(*other, p.part) && p.lead == id_of(one.part);
                            });
        if (!joined) {
          ++other;
          continue;
        }
        body.parts.insert(body.parts.end(), other->parts.begin(), other->parts.end());
        nodes.insert(other->b.nodes.begin(), other->b.nodes.end());
        other = bodies.erase(other);
      }
      body.b.nodes.assign(nodes.begin(), nodes.end());
      bodies.push_back(std::move(body));
    }
    std::vector<std::size_t> out;
    for (SwitchedBody& body : bodies) {
      if (!check_body(card, field, body)) return {};
      out.push_back(bodies_.size());
      bodies_.push_back(std::move(body));
    }
    return out;
  }
  static bool shares(const std::vector<Index>& some, const std::set<Index>& others) {
    return std::any_of(some.begin(), some.end(), [&](Index n) { return others.contains(n); });
  }

  bool check_part(const Entry& card, const char* field, Index part) {
    const ModelPart& p = model_.parts[static_cast<std::size_t>(part)];
    const char* const why = p.has_sph                    ? "has particles, which are no rigid body"
                            : p.rigid                    ? "is rigid from the start, for good"
                            : nodes_of_.count(part) == 0 ? "has no elements that deform"
                                                         : nullptr;
    if (!why) return true;
    error(card, field, fmt::format("part {} {}", p.id, why), "name parts of elements that deform");
    return false;
  }
  bool check_body(const Entry& card, const char* field, SwitchedBody& body) {
    const Id part = id_of(body.parts.front());
    const auto* driven = shared_fields::prescribed_motion.find(world_.nodes.fields);
    for (const Index n : body.b.nodes) {
      const char* const why = world_.nodes.follow[n] == 1   ? "goes with another rigid body"
                              : world_.nodes.follow[n] == 2 ? "is tied to a face"
                              : held_.contains(n)           ? "is held by SPC"
                              : driven && (*driven)[n] != 0 ? "is driven by a prescribed motion"
                              : heavy_.contains(n)          ? "has an inertia by *ELEMENT_INERTIA"
                                                            : nullptr;
      if (!why) continue;
      error(card, field,
            fmt::format("node {} of part {} {}, so that the part cannot become rigid for a while",
                        world_.nodes.id[n], part, why),
            "leave the part out of the switch");
      return false;
    }
    RigidBody probe;
    take_mass(probe, lumped(body.b.nodes, world_));
    if (can_turn(probe)) return true;
    error(card, field,
          fmt::format("the nodes of part {} lie on a line, so it has no inertia about that", part),
          "make it one body with another part by LRB");
    return false;
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  std::map<Index, std::set<Index>> nodes_of_;  ///< of the world, by part
  std::map<Id, Index> node_of_id_;
  std::set<Index> held_, heavy_;
  std::vector<SwitchedBody> bodies_;
  std::vector<PartSwitch> switches_;
  std::vector<std::size_t> at_start_;
};

const RegisterAddition switched_parts{
    "*DEFORMABLE_TO_RIGID_AUTOMATIC",
    [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      const auto& cards = deck.all<AutomaticSwitch>();
      const std::vector<AutomaticSwitch> at_restart = switches_at_restart(deck);
      if (cards.empty() && at_restart.empty()) return;
      const AutomaticSwitch& first = cards.empty() ? at_restart.front() : cards.front();
      if (world.dim == 2)
        return deck.error(diagnostics, first, first.first_field,
                          "parts of a plane scene cannot become rigid for a while",
                          "make the scene three-dimensional");
      SwitchReader reader(deck, model, world, diagnostics);
      reader.add_start();
      for (const AutomaticSwitch& card : cards) reader.add(card);
      for (const AutomaticSwitch& card : at_restart) reader.add_at_restart(card);
      reader.finish();
    }};

}  // namespace

}  // namespace courant
