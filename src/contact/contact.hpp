#pragma once
// Penalty contact of SPH particles with shells and exterior faces of solids, in 3D and (walls extruded in z)
// in 2D. See docs/theory_contact.md.
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contact/facet.hpp"
#include "contact/facet_grid.hpp"
#include "contact/friction.hpp"
#include "contact/interface_law.hpp"
#include "contact/push_out.hpp"
#include "contact/wall.hpp"
#include "keyword/deck.hpp"
#include "loads/sensors/sensors.hpp"
#include "model/model.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"
#include "state/wall_bodies.hpp"
#include "state/world.hpp"

namespace courant {

struct ContactOptions {
  bool skip_inactive =
      true;  ///< ICONT 1. Particles outside the box move with constant velocity in either case
  bool thickness_from_volume =
      false;  ///< ITHK 1: contact radius of a particle is 0.5 V^(1/dim) where SAST is 0
  /// Bulk modulus of the law of strength of a part; 0: none, or a law whose pressure is that of an equation
  /// of state. [M/LT2]
  std::function<Real(Index part)> bulk_modulus = [](Index) { return Real(0); };
  WallBodies bodies{};    ///< of the faces of the contact
  Real reach_margin = 0;  ///< particles and nodes move at most half of this between two refreshes [L]
  Real tssfac = 0.9;      ///< fraction of their own step that elements use
  bool shortcuts = true;  ///< off: every candidate is examined in every step, with the same result
};

/// One contact interface as the deck gives it; names and units as on the card and in *CONTROL_CONTACT.
struct ContactLaw : FrictionLaw {
  Id id = 0;
  std::string title;
  Real slsfac = 0.1, sfsa = 1, sfsb = 1;          ///< penalty scales [-]
  Real sast = 0, sbst = 0, sfsat = 1, sfsbt = 1;  ///< thickness overrides [L] and scales [-]
  Real vdc = 0;                                   ///< damping, percent of critical
  Real birth = 0, death = 1e20;                   ///< [T]
  SensorGate gate{};
  Real sofscl = 0.1, dtstif = 0;  ///< SOFT 1: scale [-] and step if given [T]
  int soft = 0, penopt = 1;
  bool literal = false;  ///< only the penalty acts, even if particles leak
};

/// A contact interface. A particle at distance d < r from the walls gets the force k (r - d) along the
/// shortest path out; where several walls meet, towards the nearest position at distance r from all (see
/// push_out.hpp). Each particle has a last admissible position: its own position, unless its path crossed a
/// mid-surface. It is then forced back to the side of that position, which moves around free edges only,
/// never through a wall. Data that survive a neighbour search are in particle fields, so sorting preserves
/// them.
///
/// Most particles near walls do not touch, or touch one fixed flat wall or a corner of few. For these there
/// are shortcuts (quick_touch.cpp) that give the same bits as the full search (touch.cpp).
class Contact : public Force,
                public Refresh,
                public TimeLimit,
                public Impact,
                public EnergyTerm,
                public PointForceReporter,
                public Restartable {
 public:
  /// `tracked`: by particle index. `number` counts interfaces from 1 and keeps their fields apart.
  Contact(ContactLaw law, const ContactOptions& options, int number, const std::vector<Index>& segments,
          const std::vector<bool>& tracked, World& world);

  std::string name() const override;
  /// Adds a law of the interface.
  void add_law(std::shared_ptr<InterfaceLaw> law) { laws_.push_back(std::move(law)), drag_on_ = true; }
  void declare(const World& world, Accesses& a) const override;
  void start(World& world, const Clock& clock) override;
  void block(World& world, const Clock& clock, Index begin, Index end) override;
  void finish(World& world, const Clock& clock) override;
  /// Adds the forces on fixed walls to nodes.f and segments.contact_force-> No motion depends on these, so
  /// they are computed on request, before particles move again.
  void show_forces(World& world);
  /// Reactions on the faces and nodes of moving walls; complete after `finish`.
  const Resource& reactions() const { return reactions_resource_; }
  /// Adds the force of touches on a node, or a segment, of moving walls, in the order of facets and
  /// particles.
  void add_reaction_on_node(Index node, Vec& force) const;
  void add_reaction_on_segment(Index segment, Vec& force) const;
  bool has_moving_walls() const { return !moving_.empty(); }
  void refreshed(World& world, const Clock& clock, std::span<const Index> old_of_new) override;
  bool rings() const override { return false; }
  Limit limit(const World& world, const Clock& clock) override;
  void strike(World& world, const Clock& clock) override;
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override;
  InterfaceForce report() const;
  /// Whether it has exerted a force so far.
  bool has_acted() const { return acted_; }
  void report_point_forces(const World& world, const std::function<void(const PointForce&)>& take) override;

  /// State for a restart besides the particle fields: energies dissipated so far, the step that SOFT 1 uses,
  /// and data of particles near walls since the last neighbour search.
  void keep(Archive& archive) override;
  void loaded(World& world) override { listed_ = world.particles.active; }

  struct Penetrations {
    Index count = 0;
    Real deepest = 0;  ///< [L]
    Id particle = 0;   ///< the deepest
  };
  /// Tracked particles (the active ones, all if none is) nearer to a wall than the contact distance.
  Penetrations penetrations(World& world);
  Index candidates() const;  ///< particle-facet pairs in the list

 private:
  struct Touch {
    Index particle, facet;
    Real share, depth, k;
    Vec n, q;
    Real held = 0;  ///< force of the wall along n beyond the penalty (hold.cpp) [ML/T2]
  };
  struct Drag {        ///< forces of friction and damping in a touch
    Real damping = 0;  ///< damping part of the normal force [ML/T2]
    Vec friction;      ///< force on the particle [ML/T2]
    Vec other;         ///< of interface laws [ML/T2]
  };
  struct Slot {  ///< a particle with walls near it
    Index particle = 0;
    Index first = 0, last = 0;  ///< its candidates: [first, last)
    std::int8_t walls = 0;      ///< planes of all its candidates; 0: too many or not known
    std::array<std::int8_t, 3> side{};
    std::array<Index, 3> facet{};  ///< the last facet below it in each plane, in ascending order
    bool behind = false;           ///< its admissible position is not its own
    bool skipped = false;          ///< sides of candidates are out of date
    std::int8_t joints = 0;        ///< facets of a joint below it at `seen`, if any
    std::array<Index, 4> joint{};
    Real k = 0;       ///< stiffness of the particle [M/T2]
    Real room = 0;    ///< lower bound of the distance to a touch at `seen` [L]
    Real travel = 0;  ///< of the walls at `seen` [L]
    Vec seen = Vec::Zero();
  };
  struct Reaction {  ///< of a touch on a wall that moves
    Index facet = 0;
    Vec force = Vec::Zero();      ///< on it [ML/T2]
    std::array<Real, 4> share{};  ///< of its corners [-]
    Real k = 0;                   ///< [M/T2]
  };
  /// Reactions of all blocks, from which faces and nodes gather: facet moving_[k] has all[order[first[k]]],
  /// ..., all[order[first[k + 1] - 1]], in the order of particles.
  struct Reactions {
    std::vector<Index> begin;  ///< of each block's, and the end
    std::vector<Reaction> all;
    std::vector<Index> key, first, order;
  };
  /// The moving facets of a node or a segment.
  struct Incidence {
    struct Corner {
      Index moving;  ///< in moving_
      int corner;    ///< of a node; -1: of a segment
    };
    std::vector<Index> first;
    std::vector<Corner> corners;
  };
  struct alignas(64) Block {  ///< of particles, for one thread
    std::vector<Slot> slots;
    std::vector<Index> candidate;   ///< facets, ascending for each slot
    std::vector<std::int8_t> side;  ///< of the admissible position, per candidate
    std::vector<Touch> touches;     ///< now, in the order of particles
    std::vector<Drag> drags;        ///< per touch, if there is friction or damping
    std::vector<Index> crossed;     ///< particles whose path goes through a mid-surface now
    std::vector<Index> leapt;  ///< those whose path did in the last step, too far for the wall to hold them
    Real deepest = 0;          ///< touch [L]
    std::vector<Reaction> reactions;
    Real damping_work = 0, friction_work = 0;   ///< dissipated in this step [ML2/T2]
    Real approach_dt = 0;                       ///< longest step until a particle is examined again [T]
    Index approaching = -1;                     ///< that particle
    std::vector<std::pair<Index, Real>> freed;  ///< particles at deleted walls, with their spring energy
    void clear_touches() {
      touches.clear(), drags.clear(), crossed.clear(), reactions.clear();
      deepest = 0, approaching = -1, approach_dt = std::numeric_limits<Real>::infinity();
    }
  };
  struct Near;  ///< scratch of one particle's search

  void keep_slots(Archive& archive);
  void keep_walls(Archive& archive);
  void find_least_distance(const Particles& particles);
  void choose_shortcuts();
  void update_facets(const World& world, const Clock& clock);
  void forget_left(const World& world, std::span<const Index> old_of_new);
  void list_block(World& world, const Clock& clock, Index begin, Index end);
  bool list_candidates(Block& b, const Vec& x, Index& nearest) const;
  bool leapt_over_wall(const Vec& from, const Vec& to) const;
  void count_leaks(World& world, const std::vector<Index>& particles);
  void note_planes(const Block& b, Slot& slot) const;
  void learn_sides(const World& world, const Clock& clock, Block& b, const Slot& slot) const;
  void fall_asleep(World& world);
  bool may_end() const { return law_.death < ContactLaw{}.death || law_.gate.there(); }
  bool is_there(Index facet) const { return !eroded_ || (*eroded_)[facets_[facet].segment] == 0; }
  void leave_deleted(World& world, const Clock& clock);
  void note_freed(World& world, const Clock& clock, Block& b);
  Real let_go(Block& b) const;
  Real stored_in(const World& world, const Slot& slot, const Pushes& pushes) const;
  void touch(World& world, const Clock& clock, Block& b, Slot& slot, Pushes& pushes);
  bool touch_one_wall(const World& world, Block& b, Slot& slot, const Vec& x, Real* const f[]) const;
  bool quick_touch(const Block& b, Slot& slot, const Vec& x, Pushes& pushes) const;
  bool quick_pushes(const Block& b, Slot& slot, const Vec& x, Pushes& pushes) const;
  bool is_at_joint(const Slot& slot, const Vec& x) const;
  bool note_joint(const Block& b, Slot& slot, const Vec& x) const;
  bool joint_pushes(const Slot& slot, const Vec& x, Pushes& pushes) const;
  bool worst_wall(const Block& b, Slot& slot, const Vec& y, const Pushes& pushes, int& worst) const;
  bool find_facet(const Block& b, Slot& slot, int wall, const Vec& y) const;
  void take_facet(Slot& slot, int wall, Index facet) const;
  bool is_far(const Slot& slot, const Vec& x) const;
  void find_pushes(World& world, const Clock& clock, Block& b, Slot& slot, Pushes& pushes);
  bool pull_back(Near& near, const Vec& admissible, Pushes& pushes, Vec& u) const;
  void push_off(Near& near, Pushes& pushes, Vec& u) const;
  Real surely_deepest(const Near& near, const Vec& y, const Pushes& pushes) const;
  bool consider(const Near& near, Index c, const Vec& y, const Pushes& pushes, Push& worst,
                Real& violation) const;
  void forces_of(World& world, const Clock& clock, Block& b, const Slot& slot, const Pushes& pushes);
  void look_further(const World& world);
  void note_approach(const World& world, Block& b, const Slot& slot, Real dt) const;
  Vec in_plane(Vec v) const;
  struct Supports;  ///< free axes of particles and nodes besides supports and curves
  bool balance(World& world, const Clock& clock, const Supports& supports);
  Real correct(World& world, const Clock& clock, const Supports& supports, Touch& touch) const;
  bool join_struck(const World& world, const Clock& clock, Block& b) const;
  Real gap_at_end(const World& world, const Clock& clock, Index particle, const Facet& f, Real side) const;
  Vec wall_kick(const World& world, const Facet& f, const Vec& q, Real time) const;
  void record_held(World& world, const Clock& clock, EnergyLedger& ledger);
  Vec friction_force(const World& world, const Clock& clock, Index i, Index facet, Real fn, const Vec& v,
                     const Vec& n, Real k) const;
  void keep_friction(const Block& b, Index particle, std::size_t first_touch);
  Vec force_of(const Block& b, std::size_t touch) const;
  void give_to_wall(World& world, const Block& b, std::size_t touch, const std::array<Real, 4>& share);
  void find_incidence(const World& world);
  void gather_reactions();
  Real stiffness_of_node(const World& world, Index node) const;
  template <class Add>
  void for_each_reaction(const Incidence& of, Index at, const Add& add) const;
  Vec wall_velocity(const World& world, const Facet& f, const Vec& q) const;
  Real stiffness(Index i, Real kn, Real kf, const Facet& f, const World& world) const;
  const Corners& before(Index facet) const {
    return facets_[facet].moves ? before_[facet] : facets_[facet].x;
  }
  Real contact_distance(Index i, const Wall& w) const {
    return w.r + (radius_ ? (*radius_)[i] : radius_all_);
  }

  ContactLaw law_;
  std::vector<std::shared_ptr<InterfaceLaw>> laws_;
  ContactOptions options_;
  int number_, dim_;
  std::vector<Index> part_of_;  ///< of each facet; empty: friction does not depend on parts
  bool friction_on_, drag_on_, asleep_ = false;
  std::vector<Facet> facets_;
  std::vector<Wall> walls_;             ///< the same facets, for the search
  std::vector<Corners> before_;         ///< corners one step ago, only for facets that move
  std::vector<Index> moving_;           ///< facets
  std::vector<Index> place_in_moving_;  ///< of each facet that moves
  Real travel_ = 0;                     ///< of the corners that move most, summed up [L]
  FacetGrid grid_;
  Real reach_ = 0, radius_all_ = 0;
  Real r_most_ = 0;  ///< largest contact distance [L]
  Real limit_ = 0;
  Real soft_dt_ = 0;          ///< longest step so far [T]
  bool hold_ = true;          ///< whether walls hold particles that the penalty does not
  Real r_least_ = 0;          ///< smallest contact distance [L]
  Real wall_speed_ = 0;       ///< largest, of the corners [L/T]
  Index held_now_ = 0;        ///< held touches in this step
  bool search_less_ = false;  ///< options_.shortcuts, unless round-off forbids them

  Field<Real>* k_particle_ = nullptr;  ///< penalty stiffness of the particle; 0: not tracked
  Field<Real>* radius_ = nullptr;      ///< only if it differs from particle to particle
  Field<Real>* admissible_ = nullptr;  ///< admissible position minus x, 0 for a particle in front
  Field<Index>* near_wall_ =
      nullptr;  ///< 1 where a wall is within reach, if a pass needs it; that pass clears it
  Field<Index>* leaked_ =
      nullptr;  ///< 1 once the particle's path crossed a mid-surface (shared by all interfaces)
  std::array<Field<Real>*, 3> friction_normal_{}, friction_force_{};

  std::vector<Block> blocks_;
  Index listed_ = 0;  ///< particles that were active at the last refresh
  Resource reactions_resource_{"contact reactions"};
  Reactions reactions_;
  Incidence of_node_, of_segment_;
  std::vector<Index> written_;  ///< held facets whose nodes and segments have forces of this interface
  bool shown_ = false;
  bool acted_ = false;
  Real damping_work_ = 0, friction_work_ = 0;
  bool deforms_ = false;           ///< some wall deforms
  Real stiffest_ = 0;              ///< bound of the largest frequency of a node that deforms, squared [1/T2]
  const Field<Index>* eroded_;     ///< of segments; null: nothing fails
  std::int64_t eroded_count_ = 0;  ///< deleted elements when walls were listed
  Real stored_ = 0;                ///< energy in all touches of the last step, where contact may end [ML2/T2]
  Real let_go_ = 0;                ///< energy of springs that ended with their wall, not yet in the ledger
};

/// Adds an interface to the passes of `world`, with the passes that gather its reactions where walls move.
void add_contact(World& world, const std::shared_ptr<Contact>& contact);

/// Reads all *CONTACT_AUTOMATIC_NODES_TO_SURFACE of the deck. Particles and segments must exist (x, v, m,
/// rho, c, part, id; Nodes::held set by the rigid bodies). Reports what is missing or not supported, and
/// initial penetrations as warnings. Creates counters leaked_particles and initial_penetrations and maximum
/// max_penetration if there is any contact.
std::vector<std::shared_ptr<Contact>> build_contacts(const Deck& deck, const Model& model,
                                                     const ContactOptions& options, World& world,
                                                     Diagnostics& diagnostics);

}  // namespace courant
