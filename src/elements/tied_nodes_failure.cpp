// *CONSTRAINED_TIED_NODES_FAILURE: nodes at one position that go together until their elements have flowed.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "elements/element_report.hpp"
#include "extension/additions.hpp"
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "state/restartable.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

struct TiedNodesCard : Entry {
  Id nsid = 0;
  Real eppf = 0;
  int etype = 0;
};

const RegisterKeyword<TiedNodesCard> tied_nodes_failure{
    {.names = {"CONSTRAINED_TIED_NODES_FAILURE"},
     .purpose =
         "nodes at one position go together until the plastic strain of their elements reaches a limit",
     .cards = {{.fields = {{"NSID", &TiedNodesCard::nsid, "-",
                            "node set; those of its nodes that start at one position are tied",
                            rules::required_id_of(IdSpace::node_set)},
                           {"EPPF", &TiedNodesCard::eppf, "-",
                            "plastic strain at which they part: the mean over the volume of their elements",
                            rules::required_positive},
                           {"ETYPE",
                            &TiedNodesCard::etype,
                            "-",
                            "elements that count: 0 shells, 1 solids",
                            {.allowed = {0, 1}}}}}}}};

/// What nodes share: force and inertia of displacements, or of rotations.
struct SharedMotion {
  Field<Real>*force, *speed, *inertia;
};

/// Nodes that go together, and elements at them.
struct TiedPoint {
  std::vector<Index> nodes{};  ///< ascending
  struct Element {
    const ElementReporter* reporter;
    Index e;
  };
  std::vector<Element> elements{};
  ElementKind kind = ElementKind::shell;
  Real limit = 0;  ///< plastic strain [-]
};

/// f_i = m_i (sum f / sum m) while a point holds: all have one acceleration, and what ties them does no work.
class TiedPoints : public Constraint, public Impact, public EnergyTerm, public Restartable {
 public:
  TiedPoints(std::vector<TiedPoint> points, World& world)
      : points_(std::move(points)), whole_(points_.size(), 1) {
    FieldSet& set = world.nodes.fields;
    motions_.push_back({&world.nodes.f, &world.nodes.v, &world.nodes.m});
    if (Field<Real>* moment = shared_fields::moment.find(set))
      motions_.push_back(
          {moment, shared_fields::angular_velocity.find(set), shared_fields::rotary_inertia.find(set)});
    mean_.resize(motions_.size(), std::vector<Vec>(points_.size(), Vec::Zero()));
    at_.assign(static_cast<std::size_t>(world.nodes.size()), -1);
    Field<Index>& alike = shared_fields::alike_axes.add(set);
    Field<Index>& joined = shared_fields::joined_nodes.add(set);
    for (std::size_t p = 0; p < points_.size(); ++p)
      for (const Index n : points_[p].nodes) {
        at_[static_cast<std::size_t>(n)] = static_cast<Index>(p), alike[n] |= all_axes;
        joined[n] = 1 + points_[p].nodes.front();
      }
    world.counters["tied_nodes_parted"] += 0;
  }
  std::string name() const override { return "nodes tied until they fail"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World&, Accesses& a) const override {
    for (const SharedMotion& one : motions_) {
      a.in_start().reads(*one.force, Reach::others).reads(*one.inertia, Reach::others);
      a.in_block().revises(*one.force).reads(*one.inertia);
    }
  }
  void start(World&, const Clock&) override { find_means(); }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n) share(n);
  }
  void strike(World&, const Clock&) override {
    find_means();
    for (const TiedPoint& point : points_)
      for (const Index n : point.nodes) share(n);
  }
  void record(World& world, const Clock&, EnergyLedger&) override {
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (whole_[p] != 0 && strain_at(points_[p], world) >= points_[p].limit)
        whole_[p] = 0, world.counters["tied_nodes_parted"] += static_cast<Index>(points_[p].nodes.size());
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}
  void keep(Archive& archive) override { archive("whole", whole_); }

 private:
  static constexpr Index all_axes = 7;  ///< a bit for each

  void find_means() {
    for (std::size_t k = 0; k < motions_.size(); ++k)
      for (std::size_t p = 0; p < points_.size(); ++p) {
        if (whole_[p] == 0) continue;
        Vec force = Vec::Zero();
        Real inertia = 0;
        for (const Index n : points_[p].nodes)
          force += motions_[k].force->vec(n), inertia += (*motions_[k].inertia)[n];
        mean_[k][p] = inertia > 0 ? Vec(force / inertia) : Vec(Vec::Zero());
      }
  }
  void share(Index n) {
    const Index p = at_[static_cast<std::size_t>(n)];
    if (p < 0 || whole_[static_cast<std::size_t>(p)] == 0) return;
    for (std::size_t k = 0; k < motions_.size(); ++k)
      motions_[k].force->set(n, (*motions_[k].inertia)[n] * mean_[k][static_cast<std::size_t>(p)]);
  }
  /// The mean over the volume of the elements that are left; without any, they part. [-]
  static Real strain_at(const TiedPoint& point, const World& world) {
    Real sum = 0, volume = 0;
    for (const TiedPoint::Element& one : point.elements) {
      const ElementReport report = one.reporter->report_element(world, one.e, {});
      if (report.deleted || report.points.empty()) continue;
      Real plastic = 0;
      for (const PointReport& of : report.points) plastic += of.plastic;
      const Real V = one.reporter->reported().V0[one.e];
      sum += V * plastic / static_cast<Real>(report.points.size()), volume += V;
    }
    return volume > 0 ? sum / volume : std::numeric_limits<Real>::infinity();
  }

  std::vector<TiedPoint> points_;
  std::vector<char> whole_;
  std::vector<SharedMotion> motions_;   ///< of displacements; of rotations, if nodes turn
  std::vector<std::vector<Vec>> mean_;  ///< force over inertia of each point [L/T2], [1/T2]
  std::vector<Index> at_;               ///< point of each node of the world; -1: none
};

class TiedPointReader {
 public:
  TiedPointReader(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (Index n = 0; n < world.nodes.size(); ++n) node_of_id_.emplace(world.nodes.id[n], n);
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      model_node_.emplace(model.nodes[n].id, static_cast<Index>(n));
    Vec low = Vec::Zero(), high = Vec::Zero();
    if (world.nodes.size() > 0) low = high = world.nodes.x.vec(0);
    for (Index n = 0; n < world.nodes.size(); ++n)
      low = low.cwiseMin(world.nodes.x.vec(n)), high = high.cwiseMax(world.nodes.x.vec(n));
    near_ = together * (high - low).norm();
  }

  void add(const TiedNodesCard& card) {
    const auto set = model_.node_sets.find(card.nsid);
    if (set == model_.node_sets.end())
      return error(card, fmt::format("node set {} does not exist", card.nsid), "define it with *SET_NODE");
    std::vector<Index> left;
    for (const Index n : set->second)
      if (!take(card, n, left)) return;
    std::sort(left.begin(), left.end());
    left.erase(std::unique(left.begin(), left.end()), left.end());
    std::size_t alone = 0;
    for (TiedPoint& point : points_of(left)) {
      if (point.nodes.size() < 2) {
        ++alone;
        continue;
      }
      if (!fits(card, point)) return;
      point.limit = card.eppf;
      point.kind = card.etype == 1 ? ElementKind::solid : ElementKind::shell;
      start(point);
      points_.push_back(std::move(point));
    }
    if (alone > 0)
      deck_.warning(diagnostics_, card, "NSID",
                    fmt::format("{} nodes of set {} start where no other of it does: nothing ties them",
                                alone, card.nsid),
                    "name nodes at one position");
  }
  void finish() {
    find_elements();
    if (!points_.empty()) world_.passes.add(std::make_shared<TiedPoints>(std::move(points_), world_));
  }

 private:
  /// Distance below which positions are one, of the extent of all nodes.
  static constexpr Real together = 1e-6;

  void error(const TiedNodesCard& card, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, "NSID", std::move(message), std::move(hint));
  }
  bool take(const TiedNodesCard& card, Index of_model, std::vector<Index>& out) {
    const Id id = model_.nodes[static_cast<std::size_t>(of_model)].id;
    const auto found = node_of_id_.find(id);
    const char* wrong = nullptr;
    if (found == node_of_id_.end())
      wrong = "belongs to no element";
    else if (world_.nodes.follow[found->second] != 0)
      wrong = "goes with a rigid body, or with a face to which it is tied";
    else if (!taken_.emplace(found->second, card.nsid).second && taken_[found->second] != card.nsid)
      wrong = "is in another *CONSTRAINED_TIED_NODES_FAILURE";
    if (wrong) {
      error(card, fmt::format("node {} {}", id, wrong),
            "name nodes of shells and solids that deform, each once");
      return false;
    }
    out.push_back(found->second);
    return true;
  }
  std::vector<TiedPoint> points_of(const std::vector<Index>& nodes) const {
    std::vector<Index> order = nodes;
    const auto along = [&](Index n) { return world_.nodes.x.vec(n)[0]; };
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return along(a) < along(b); });
    std::vector<char> done(order.size(), 0);
    std::vector<TiedPoint> out;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (done[i] != 0) continue;
      TiedPoint& point = out.emplace_back();
      for (std::size_t k = i; k < order.size() && along(order[k]) <= along(order[i]) + near_; ++k)
        if (done[k] == 0 && (world_.nodes.x.vec(order[k]) - world_.nodes.x.vec(order[i])).norm() <= near_)
          done[k] = 1, point.nodes.push_back(order[k]);
      std::sort(point.nodes.begin(), point.nodes.end());
    }
    return out;
  }
  /// What else moves or holds one node of a point must do so with all.
  bool fits(const TiedNodesCard& card, const TiedPoint& point) {
    const auto* driven = shared_fields::prescribed_motion.find(world_.nodes.fields);
    const auto* carries = shared_fields::tied_mass.find(world_.nodes.fields);
    const auto state = [&](Index n) {
      return std::array<bool, 5>{world_.nodes.held[n] != 0, driven && (*driven)[n] != 0, fixed(n, 0),
                                 fixed(n, 1), fixed(n, 2)};
    };
    for (const Index n : point.nodes) {
      if (carries && (*carries)[n] > 0) {
        error(
            card,
            fmt::format("node {} is a corner of a face to which others are tied exactly", world_.nodes.id[n]),
            "use that contact with _OFFSET, whose springs may act beside it");
        return false;
      }
      if (state(n) == state(point.nodes.front())) continue;
      error(card,
            fmt::format("node {} is not held or driven as node {}, to which it is tied", world_.nodes.id[n],
                        world_.nodes.id[point.nodes.front()]),
            "hold or drive all nodes at one position alike");
      return false;
    }
    return true;
  }
  bool fixed(Index n, std::size_t axis) const {
    return model_.nodes[static_cast<std::size_t>(model_node_.at(world_.nodes.id[n]))].fixed[axis];
  }
  void find_elements() {
    std::unordered_map<Index, std::size_t> at;
    for (std::size_t p = 0; p < points_.size(); ++p)
      for (const Index n : points_[p].nodes) at.emplace(n, p);
    for (const auto* reporter : world_.passes.all<const ElementReporter>())
      for (Index e = 0; e < reporter->reported().size(); ++e)
        for (int c = 0; c < reporter->reported().corners(); ++c) {
          const auto found = at.find(reporter->reported().node.data(c)[e]);
          if (found == at.end() || !reporter->reported().is_first(e, c)) continue;
          TiedPoint& point = points_[found->second];
          if (point.kind == reporter->kind()) point.elements.push_back({reporter, e});
        }
  }
  /// One velocity, with the momentum that they have.
  void start(const TiedPoint& point) {
    Vec momentum = Vec::Zero();
    Real mass = 0;
    for (const Index n : point.nodes)
      momentum += world_.nodes.m[n] * world_.nodes.v.vec(n), mass += world_.nodes.m[n];
    for (const Index n : point.nodes) world_.nodes.v.set(n, momentum / mass);
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  std::unordered_map<Id, Index> node_of_id_, model_node_;  ///< of the world, of the model
  std::map<Index, Id> taken_;
  Real near_ = 0;  ///< [L]
  std::vector<TiedPoint> points_;
};

const RegisterAddition tied_nodes{"nodes tied until they fail", [](const Deck& deck, const Model& model,
                                                                   World& world, Diagnostics& diagnostics) {
                                    if (deck.all<TiedNodesCard>().empty()) return;
                                    TiedPointReader reader(deck, model, world, diagnostics);
                                    for (const TiedNodesCard& card : deck.all<TiedNodesCard>())
                                      reader.add(card);
                                    reader.finish();
                                  }};

}  // namespace

}  // namespace courant
