#pragma once
// Penalty contact of nodes with faces of elements and rigid bodies. Equations: docs/theory_contact.md.
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "contact/nodes/face.hpp"
#include "contact/nodes/face_bound_loops.hpp"
#include "contact/nodes/face_edges.hpp"
#include "contact/nodes/penalty.hpp"
#include "contact/nodes/touch_holder.hpp"
#include "search/box_grid.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

/// A node that touches faces.
struct ContactNode {
  Index node = 0;             ///< index into World::nodes
  unsigned pass = 0;          ///< 0: of SURFA, on faces of SURFB; 1: the reverse
  Real r = 0;                 ///< half its contact thickness [L]
  Real most_lift = 0;         ///< of its faces, in either direction [L]
  Index first = 0, last = 0;  ///< the faces that it belongs to: of ContactSides::own
};

/// A face that a tracked node belongs to: its stiffness and area are shared by its corners.
struct OwnFace {
  std::array<Index, 4> node{};
  Index segment = 0;  ///< index into World::segments
  bool two_sided = false;
  Real k = 0, area = 0;  ///< share of the node [M/T2], [L2]
  Real lift = 0;         ///< as ContactFace::lift [L]
  int corners() const { return node[2] == node[3] ? 3 : 4; }
};

/// What touches what.
struct ContactSides {
  std::vector<ContactNode> nodes;
  std::vector<OwnFace> own;
  std::vector<ContactFace> faces;
};

/// The interface at work, see docs/theory_contact.md. A node gets into touch with a face when it passes from
/// in front of it to behind it, and stays in touch, whatever else is near, until it is in front again or goes
/// on to a neighbour of the face; so no thickness of a body and no speed makes it go on the wrong side. Up to
/// three faces at once hold it in corners. What survives a step are the touches, in fields of a set of its
/// own.
///
/// Forces go to a list of touches, from which each node gathers its own in a fixed order.
class NodeContact : public Force,
                    public TimeLimit,
                    public EnergyTerm,
                    public Restartable,
                    public InterfaceReporter,
                    public PointForceReporter {
 public:
  static constexpr int most_touches = 3;
  /// A node behind a face and no further behind it a step ago than this has come through it, of the depth at
  /// which a node counts as through; and how far behind it is looked for.
  static constexpr Real arrival_tolerance = 0.02, late_reach = 1.5 * arrival_tolerance;

  /// `number` counts interfaces from 1 and keeps their sets apart. Adds a set of fields to `world`.
  NodeContact(NodeContactLaw law, ContactSides sides, WallBodies bodies, int number, World& world);

  std::string name() const override;
  const FieldSet& over(const World& world) const override;
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
  /// Tells `holder`, a pass of the same world, of nodes that touch from now on.
  void let_hold(TouchHolder& holder) { holder_ = &holder; }
  /// How deep a node was in its touches a step ago. [L]
  Real depth_at(Index node) const {
    const Index p = place_[static_cast<std::size_t>(node)];
    return p < 0 || depths_.empty() ? Real(0) : depths_[static_cast<std::size_t>(p)];
  }
  bool touches_something() const { return !shares_.empty(); }
  /// Adds what a node got from all touches, in the order of touches [ML/T2]; false: there was none.
  bool add_force_on(Index node, Vec& force) const;
  const std::vector<Index>& involved() const { return involved_; }  ///< nodes that may get some, ascending
  /// Nodes and segments of the world, 1 for those of a surface.
  struct Surface {
    std::vector<char> node, segment;
    bool has_segment(Index s) const {
      return s < static_cast<Index>(segment.size()) && segment[static_cast<std::size_t>(s)] != 0;
    }
  };
  /// Whether a touch pushes the node off the face of a segment of the world, or is about to.
  bool holds(Index node, Index segment) const;
  /// What touches between nodes of one and faces of the other do to `a`. [ML/T2]
  Vec force_between(const Surface& a, const Surface& b) const;

  struct Penetrations {
    Index count = 0;
    Real deepest = 0;       ///< [L]
    Id node = 0;            ///< the deepest
    Index lost = 0;         ///< nodes that start too deep inside another part to be held
    Index undecided = 0;    ///< nodes that start on shells, where neither has a thickness
    Id undecided_node = 0;  ///< the first of them
  };
  /// Nodes that are behind faces now and would be pushed off them.
  Penetrations penetrations(World& world);
  Index tracked() const { return static_cast<Index>(nodes_.size()); }
  Index candidates() const;  ///< pairs of node and face in the lists

 private:
  struct Slot {  ///< a touch, as its fields hold it
    Index face = -1;
    Real side = 1;               ///< of the face that the node is on [-]
    Real k = 0;                  ///< [M/T2]
    Real slack = 0;              ///< depth that gives no force: the node was there from the start [L]
    Real area = 0;               ///< of the node, for VC [L2]
    Vec friction = Vec::Zero();  ///< [ML/T2]
    Vec n = Vec::Zero();         ///< towards the node, now
    Real beyond = 0;             ///< an outer edge of the face, now [L]
    Vec aside = Vec::Zero();     ///< unit vector away from that edge
    Projection at{};             ///< now
    Real gap = 0;                ///< now; < 0: in touch [L]
    bool late = false;           ///< it was behind the face a step ago, touched by nothing
  };
  using Slots = std::array<Slot, most_touches>;

  struct Touch {
    Index node = 0, face = 0;  ///< of World::nodes; of faces_
    unsigned pass = 0;
    Real k = 0, depth = 0;  ///< [M/T2], below `slack` [L]
    Real faded = 1;         ///< force beside an outer edge, of that of the depth [-]
    Vec n = Vec::Zero();    ///< along the push, towards the node
    std::array<Real, 4> N{};
    Real due = 0;                       ///< > 0: no touch yet, but after this time [T]
    std::array<Index, 2> body{-1, -1};  ///< of the node, of the face
    std::array<Real, 2> gives{};        ///< along n there, of those [1/M]
    Real stored = 0;                    ///< [ML2/T2]
    Real spread = 0;                    ///< sum of the shares of what can move, 1 for the node [-]
    Real damping = 0;                   ///< along n [ML/T2]
    Vec friction = Vec::Zero();
    Vec lever = Vec::Zero();     ///< normal of the face where `tilt` acts
    std::array<Real, 4> tilt{};  ///< on the corners besides their shares, along it; sums to 0 [ML/T2]
    Vec force = Vec::Zero();     ///< all of it, on the node [ML/T2]
  };
  struct Seen {  ///< the present candidate
    Index face = 0;
    Projection at;
    Real d = 0;        ///< distance along the normal [L]
    bool sure = true;  ///< not beyond an edge over which the face does not reach
  };
  struct alignas(64) Block {           ///< of tracked nodes
    std::vector<Index> first;          ///< of each node's candidates, and the end
    std::vector<Index> candidate;      ///< ascending
    std::vector<float> clear, beside;  ///< of those: a node that touches nothing may meet the face once
                                       ///< travelled_ + closing_, be over it once travelled_ is this [L]
    std::vector<Real> bounded, wake;   ///< of each node: travelled_ when those were found; the least [L]
    std::vector<unsigned char> left;   ///< of each node: faces that it might meet then
    Real first_wake = 0;               ///< of all nodes [L]
    bool idle = false;                 ///< none of its nodes touches or meets anything
    std::vector<Index> touching;       ///< tracked nodes, ascending
    std::vector<Touch> touches;
    std::vector<Index> leaked;                           ///< tracked nodes
    Index jumped = 0;                                    ///< touches that were suddenly deeper
    std::vector<Seen> seen;                              ///< scratch
    std::vector<std::array<Index, most_touches>> known;  ///< of each node: touched faces all around which
                                                         ///< are candidates, if nodes may touch them
    std::vector<Index> faces;                            ///< scratch: that may matter
    std::vector<Index> chosen;                           ///< scratch: positions in `candidate`
    std::vector<const Index*> corners;                   ///< scratch: of those, and their bounds
    std::vector<Real> distance;
    Real damping_work = 0, friction_work = 0;
    Real let_go = 0;  ///< energy of touches that end by a leak or with faces that are deleted [ML2/T2]
  };
  struct Share {  ///< of a touch
    Index touch = 0;
    int corner = -1;  ///< -1: the node itself
  };

  void follow(World& world, const Clock& clock);
  void list(World& world);
  bool touches_any(Index i) const {
    for (int k = 0; k < most_touches; ++k)
      if (in_touch_->data(k)[i] != 0) return true;
    return false;
  }
  Real idle_reach(const ContactFace& f) const;
  void list_block(const World& world, Index begin, Index end);
  void take_involved(const World& world);
  void find_sizes();
  void find_parts(const World& world);
  bool may_touch(const World& world, const ContactNode& node, const ContactFace& face) const;
  void touch(World& world, const Clock& clock, Block& b, Index i);
  void look(const World& world, Block& b, Index i, const Vec& x, const Slots& slots) const;
  void choose(Block& b, Index i, const Slots& slots, bool idle, bool around) const;
  void add_missing(const World& world, Block& b, Index i, const Slots& slots) const;
  void see(const World& world, Block& b, Index i, const Vec& x, const Slots& slots, bool around) const;
  void bound(const World& world, Block& b, Index i, const Vec& x) const;
  Real next_wake(const Block& b, std::size_t k) const;
  bool is_lost(const World& world, const Block& b, Index i) const;
  bool is_undecided(const Block& b, Index i) const;
  bool hold(const World& world, Block& b, Index i, const Vec& x, const Slots& slots, Slot& slot) const;
  bool past_edge(const World& world, const Vec& x, bool wedge, Real r, Slot& slot) const;
  bool move_on(const World& world, const Block& b, Index i, const Vec& x, const Slots& slots, Slot& slot,
               bool inside) const;
  bool go_along_edge(const World& world, const Block& b, const Vec& x, const Slots& slots, Slot& slot) const;
  Projection rim_of(const World& world, const ContactFace& f, const Vec& x) const;
  void find_touches(const World& world, const Clock& clock, const Block& b, Index i, Slots& slots) const;
  bool arrives(const World& world, const Clock& clock, Index i, const Seen& seen, Slot& slot) const;
  bool is_smooth_at(const World& world, Index f, unsigned e) const;
  bool overlaps(const World& world, Index i, Index f) const;
  bool is_over(const World& world, Index i, Index f, const Projection& p) const;
  Vec normal_of(const World& world, const OwnFace& own) const;
  Vec smooth_normal(const World& world, const ContactNode& n) const;
  bool looks_at(const World& world, const ContactNode& n, const Vec& normal) const;
  bool is_of_solids(const ContactNode& n) const;
  bool grazes(const World& world, Index i, Index touched, const Vec& q, const Vec& normal) const;
  template <class Face>
  bool is_there(const Face& f) const {
    return !eroded_ || (*eroded_)[f.segment] == 0;
  }
  Real lift(const World& world, Index i, const ContactFace& f, Real side, const Vec& n) const;
  /// At which a node touches a side of a face whose normal towards it is n. [L]
  Real distance(const World& world, Index i, const ContactFace& f, Real side, const Vec& n) const {
    return f.r + node(i).r + lift(world, i, f, side, n);
  }
  /// `d`: from the nodes of the face. [L]
  Real gap_at(const World& world, Index i, const ContactFace& f, Real side, const Vec& n, Real d) const {
    return d - f.r - node(i).r - lift(world, i, f, side, n);
  }
  Real most_distance(Index i, const ContactFace& f) const {
    return f.r + std::abs(f.lift) + node(i).r + node(i).most_lift;
  }
  bool has_faces(const ContactNode& n) const;
  void let_go(const World& world, Block& b, Index i, const Vec& x, Slots& slots) const;
  bool take(const World& world, Index i, const Slot& slot, Slots& slots) const;
  bool jumps(const World& world, const Clock& clock, Index i, const Slot& slot, Index face_before) const;
  bool is_taken(const Slots& slots, Index face) const {
    for (const Slot& slot : slots)
      if (slot.face == face) return true;
    return false;
  }
  bool goes_on(const Slots& slots, const Seen& seen) const;
  void give_stiffness(const World& world, Index i, Slot& slot) const;
  void fade(const World& world, const Slot& slot, Touch& touch) const;
  void push(const World& world, const Clock& clock, Block& b, Index i, Slot& slot) const;
  void fill(const World& world, const Clock& clock, Slot& slot, Touch& touch) const;
  const Friction& friction_at(const Touch& touch) const;
  void expect(const World& world, const Clock& clock, Block& b, Index i, const Slots& slots) const;
  Index body_under(const ContactFace& f) const;
  void find_bodies(const World& world, Touch& touch) const;
  void sum_springs_of_bodies(const World& world, const Clock& clock);
  Real part_of(const World& world, const Clock& clock, const Touch& touch, Real speed,
               const std::array<Real, 2>& mobility) const;
  Vec velocity_of_face(const World& world, const ContactFace& f, const std::array<Real, 4>& N) const {
    Vec v = Vec::Zero();
    for (std::size_t e = 0; e < static_cast<std::size_t>(f.corners); ++e)
      v += N[e] * world.nodes.v.vec(f.node[e]);
    return v;
  }
  Real mass_of(const World& world, Index n) const {
    return world.nodes.held[n] ? std::numeric_limits<Real>::infinity() : world.nodes.m[n];
  }
  Real share_of(const Share& share) const;
  Vec force_of(const Share& share) const;
  Slot load(Index i, int k) const;
  void store(Index i, int k, const Slot& slot);
  void gather(const World& world);
  StiffestContact pull_on(const World& world, Index p) const;
  void tell_holder(World& world);
  const ContactFace& face(Index f) const { return faces_[static_cast<std::size_t>(f)]; }
  const ContactNode& node(Index i) const { return nodes_[static_cast<std::size_t>(i)]; }

  NodeContactLaw law_;
  WallBodies bodies_;
  TouchHolder* holder_ = nullptr;  ///< null: nodes touch and leave
  int number_;
  bool friction_on_, drag_on_;
  std::vector<Index> part_of_node_,
      part_of_face_;  ///< of World::nodes, of faces_; empty: not needed by friction
  std::vector<ContactNode> nodes_;
  std::vector<OwnFace> own_;
  std::vector<ContactFace> faces_;
  FaceEdges edges_;  ///< of faces_
  FieldSet* set_;
  Field<Index>*in_touch_, *leaked_;  ///< by slot: face + 1, or 0; by node
  Field<Real>*side_, *k_, *slack_, *area_, *friction_;
  Field<Real>* depth_;  ///< by node: of its deepest touch [L]

  BoxGrid search_;
  Real r_most_ = 0;        ///< largest, of the nodes [L]
  Real size_ = 0;          ///< usual, of a face [L]
  Real reach_ = 0;         ///< faces further away than the contact distance and this are left alone [L]
  Real listed_reach_ = 0;  ///< of the lists [L]
  Real closing_ = 0;       ///< no node and face come nearer within a step [L]
  Real travelled_ = 0;     ///< no node and face came nearer by more since lists were made [L]
  Real most_depth_ = 0;    ///< of faces [L]
  FaceBoundLoops loops_ = face_bound_loops();
  std::vector<Index> involved_;  ///< nodes of World, tracked or corners, ascending
  std::vector<Index> place_;     ///< of each node of World in involved_, or -1
  // by body, of touches a step ago, and of those due soon: stiffness; along their pushes; its moment about 0
  std::vector<Real> body_springs_;          ///< [M/T2]
  std::vector<Vec> body_push_, body_turn_;  ///< [M/T2], [ML/T2]
  std::vector<Real> depths_;                ///< of those nodes, a step ago [L]
  std::vector<char> touched_;               ///< of those: a tracked node that touched something a step ago
  std::vector<Vec> listed_at_;              ///< where those were when lists were made
  std::vector<Vec> last_at_;                ///< and a step ago
  bool listed_once_ = false;
  bool listed_deep_ = false;  ///< all faces as far as they are deep, not those around touched ones alone
  bool fresh_ = true;         ///< nodes may be behind faces without having come through them
  bool asleep_ = false;
  Real soft_dt_ = 0;         ///< longest step so far [T]
  bool first_step_ = false;  ///< of the run: from now on SOFT 1 has a step

  std::vector<Block> blocks_;
  std::vector<Touch> touches_;  ///< of all blocks
  std::vector<Share> shares_;
  std::vector<Index> key_, first_, order_;  ///< shares_ by position in involved_
  StiffestContact stiffest_;
  Real due_ = 0;  ///< until the next node comes through a face [T]
  Resource touches_resource_{"touches of nodes"};
  bool acted_ = false;
  Real damping_work_ = 0, friction_work_ = 0;
  const Field<Index>* eroded_;     ///< of segments; null: nothing fails
  std::vector<char> may_touch_;    ///< by tracked node: some face of its own is there
  std::int64_t eroded_count_ = 0;  ///< deleted elements when lists were made
  Real stored_ = 0;                ///< in all touches of the last step [ML2/T2]
  Real let_go_ = 0;  ///< energy of touches that ended with the contact's life, not yet in the ledger [ML2/T2]
};

/// Adds an interface to the passes of `world`, with the one that gathers its forces.
void add_node_contact(World& world, const std::shared_ptr<NodeContact>& contact);

}  // namespace courant
