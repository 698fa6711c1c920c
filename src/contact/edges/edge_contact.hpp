#pragma once
// Penalty contact of edges of shells and solids, and of beams, with each other. Equations:
// docs/theory_contact.md.
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "contact/edges/edge.hpp"
#include "contact/nodes/node_contact.hpp"
#include "search/box_grid.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

/// The interface at work, see docs/theory_contact.md. Edges that cross touch where they are nearest to each
/// other; along a line of edges the nearest pair has the touch, and hands it on. Edges that begin to touch
/// side by side have two touches, at Gauss points of the length that they share. A touch stores its side of
/// origin, so neither thin beams nor speed give a wrong side.
///
/// Forces go to a list of touches, from which each node gathers its own in a fixed order. What survives a
/// step is that list.
class EdgeContact : public Force,
                    public TimeLimit,
                    public EnergyTerm,
                    public Restartable,
                    public InterfaceReporter,
                    public PointForceReporter {
 public:
  /// `nodes`: of the same card, null: none. A pair begins no touch while that holds a node of one edge at a
  /// face of the other.
  EdgeContact(NodeContactLaw law, std::vector<ContactEdge> edges, WallBodies bodies,
              std::shared_ptr<const NodeContact> nodes, int number, World& world);

  std::string name() const override;
  const FieldSet& over(const World&) const override { return *set_; }
  void declare(const World& world, Accesses& a) const override;
  void start(World& world, const Clock& clock) override;
  void block(World& world, const Clock& clock, Index begin, Index end) override;
  void finish(World& world, const Clock& clock) override;
  Limit limit(const World& world, const Clock& clock) override;
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override;
  InterfaceForce report() const override;
  bool has_acted() const override { return acted_; }
  void report_point_forces(const World& world, const std::function<void(const PointForce&)>& take) override;
  void keep(Archive& archive) override;

  /// What touches leave for all nodes; complete after `finish`.
  const Resource& touches() const { return touches_resource_; }
  bool touches_something() const { return !key_.empty(); }
  /// Adds what a node got from all touches, in the order of touches [ML/T2]; false: there was none.
  bool add_force_on(Index node, Vec& force) const;
  const std::vector<Index>& involved() const { return involved_; }  ///< nodes that may get some, ascending

  struct Penetrations {
    Index count = 0;
    Real deepest = 0;  ///< [L]
    Id node = 0;       ///< of the deepest
  };
  /// Pairs that are in each other now.
  Penetrations penetrations(World& world);

 private:
  enum Place { crossing, along_first, along_last };
  struct Touch {
    Index a = 0, b = 0;  ///< of edges_, a < b
    Index place = crossing;
    Vec n = Vec::Zero();  ///< unit vector from b to a, on the side that a came from
    Real k = 0;           ///< of the whole pair [M/T2]
    Real slack = 0;       ///< depth without a force; less than 0 by how pairs changed within steps [L]
    Vec friction = Vec::Zero();
    // of this step
    NearestPoints at;
    Real gap = 0;    ///< [L]
    Real part = 1;   ///< of k: along edges half of what they share
    Real depth = 0;  ///< below slack [L]
    Real due = 0;    ///< > 0: no touch yet, but after this time [T]
    Real stored = 0, spread = 0, damping = 0;
    Vec force = Vec::Zero();  ///< on a [ML/T2]
    Real stiffness() const { return part * k; }
    bool before(const Touch& o) const { return a != o.a ? a < o.a : b != o.b ? b < o.b : place < o.place; }
  };
  struct alignas(64) Block {              ///< of edges
    std::vector<Index> first, candidate;  ///< of each edge, those behind it, ascending
    std::vector<Touch> touches;
    std::int64_t leaked = 0;  ///< crossings too deep to be held
  };
  struct Pair {
    Index a = 0, b = 0;  ///< a < b
    NearestPoints at;
    bool turned = false;  ///< a represents the b of another pair
  };

  void follow(World& world, const Clock& clock);
  void list(World& world);
  bool is_there(const ContactEdge& e) const;
  bool may_touch(const World& world, Index a, Index b) const;
  bool held_by_nodes(Index a, Index b) const;
  EdgeEnds ends(const World& world, Index e) const { return ends_of(edge(e), world.nodes.x); }
  EdgeEnds ends_before(const World& world, const Clock& clock, Index e) const;
  void go_on(const World& world, const Clock& clock);
  void hand_on(const World& world, const Clock& clock, Touch& touch) const;
  Real gap_of(Touch& touch) const;
  bool is_too_deep(const Touch& touch) const;
  bool find_nearer(const World& world, const Pair& pair, bool ties, Pair& best) const;
  void begin_touches(const World& world, const Clock& clock, Block& b, Index i, Index j) const;
  void begin_crossing(const World& world, const Clock& clock, const Pair& pair, Block& b) const;
  void begin_along(const World& world, const Clock& clock, const Pair& pair, Place place, Block& b) const;
  bool grazes(const World& world, const Pair& pair) const;
  bool crossed(const World& world, const Clock& clock, const Pair& pair) const;
  void begin(const World& world, Touch& touch, bool through, const NearestPoints& old) const;
  void expect(const World& world, const Pair& pair, Block& b) const;
  bool place_along(const World& world, Touch& touch) const;
  Real stiffness_of(const World& world, Index a, Index b) const;
  Real longest_step(const Clock& clock) const { return std::max(clock.dt_old, soft_dt_); }
  void push(const World& world, const Clock& clock, Touch& touch) const;
  Real mobility(const World& world, const Touch& touch, int side) const;
  Real mobility_of_body(const World& world, const Touch& touch, int side, Real of_nodes) const;
  Real pulled_by_others(const World& world, const Touch& touch) const;
  Vec velocity(const std::function<Vec(Index)>& of_node, const Touch& touch) const;
  void gather(const World& world);
  StiffestContact pull_on(const World& world, Index p) const;
  Index node_of(const Touch& touch, int corner) const;
  static Real share_of(const Touch& touch, int corner);
  const ContactEdge& edge(Index e) const { return edges_[static_cast<std::size_t>(e)]; }
  Real reach_of(Index a, Index b) const { return edge(a).r + edge(b).r; }

  NodeContactLaw law_;
  WallBodies bodies_;
  std::shared_ptr<const NodeContact> nodes_;
  int number_;
  bool friction_on_, drag_on_;
  std::vector<ContactEdge> edges_;
  std::vector<std::array<std::vector<Index>, 2>> next_;  ///< by edge and end: edges that continue there
  std::vector<Index> chain_;                             ///< by edge: of edges that hang together the first
  std::vector<EdgeEnds> start_;                          ///< where edges are at the start
  FieldSet* set_;
  const Field<Index>* eroded_;  ///< of segments; null: none fails

  BoxGrid search_;
  Real size_ = 0;                ///< usual length of an edge [L]
  Real reach_ = 0;               ///< pairs further apart than their radii and this are left alone [L]
  Real listed_reach_ = 0;        ///< of the lists [L]
  std::vector<Index> involved_;  ///< nodes of World, ascending
  std::vector<Index> place_;     ///< of each node of World in involved_, or -1
  std::vector<Vec> listed_at_;   ///< where those were when lists were made
  std::int64_t eroded_count_ = 0;
  bool listed_once_ = false, fresh_ = true, asleep_ = false;
  Real soft_dt_ = 0;         ///< longest step so far [T]
  bool first_step_ = false;  ///< of the run: from now on SOFT 1 has a step

  std::vector<Block> blocks_;
  std::vector<Touch> touches_;             ///< sorted; in `block` those that continue
  std::set<std::array<Index, 2>> parted_;  ///< pairs whose touches ended in this step
  std::vector<Real> springs_;  ///< by position in involved_: stiffness of touches a step ago [M/T2]
  std::vector<Index> key_, first_, order_;  ///< four for each touch, by position in involved_
  StiffestContact stiffest_;
  Real due_ = 0;
  Resource touches_resource_{"touches of edges"};
  bool acted_ = false;
  Real damping_work_ = 0, friction_work_ = 0;
  std::int64_t leaked_ = 0;  ///< touches that ended by going through, not yet counted
  Real let_go_ = 0;          ///< energy of touches that ended at once, not yet in the ledger [ML2/T2]
};

/// Adds an interface to the passes of `world`, with the one that gathers its forces.
void add_edge_contact(World& world, const std::shared_ptr<EdgeContact>& contact);

}  // namespace courant
