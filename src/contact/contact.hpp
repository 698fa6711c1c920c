#pragma once
// Penalty contact of SPH particles with shell segments, in 3D and (walls extruded in z) in 2D. See
// docs/theory.md.
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "contact/facet.hpp"
#include "contact/facet_grid.hpp"
#include "contact/push_out.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

struct ContactOptions {
  bool skip_inactive = true;  ///< ICONT 1. Particles outside the box move with constant velocity either way
  bool thickness_from_volume =
      false;              ///< ITHK 1: contact radius of a particle is 0.5 V^(1/dim) where SAST is 0
  Real reach_margin = 0;  ///< particles and nodes move at most half of this between two refreshes [L]
};

/// One contact interface as the deck gives it; names and units as on the card and in *CONTROL_CONTACT.
struct ContactLaw {
  Id id = 0;
  std::string title;
  Real slsfac = 0.1, sfsa = 1, sfsb = 1;          ///< penalty scales [-]
  Real sast = 0, sbst = 0, sfsat = 1, sfsbt = 1;  ///< thickness overrides [L] and scales [-]
  Real fs = 0, fd = 0, dc = 0, vc = 0;            ///< friction [-, -, T/L, M/LT2]
  Real vdc = 0;                                   ///< damping, percent of critical
  Real birth = 0, death = 1e20;                   ///< [T]
  Real sofscl = 0.1, dtstif = 0;                  ///< SOFT 1: scale [-] and step if given [T]
  int soft = 0, penopt = 1;
};

/// The interface at work. A particle with distance d < r to the walls is pushed by k (r - d) along the
/// shortest way out; where several walls meet, to the nearest place that keeps distance r from all (see
/// push_out.hpp). Each particle has a place in front of the walls that its path belongs to, its ghost: the
/// particle itself, unless its path went through a mid-surface. It is then pulled back to the ghost's side,
/// which the ghost only leaves around a free edge, never through a wall. All memory is in particle fields, so
/// sorting and restart keep it.
class Contact : public Force, public Refresh, public TimeLimit, public EnergyTerm {
 public:
  /// `tracked`: by particle index. `number` counts interfaces from 1 and keeps their fields apart.
  Contact(ContactLaw law, const ContactOptions& options, int number, const std::vector<Index>& segments,
          const std::vector<bool>& tracked, World& world);

  std::string name() const override;
  void start(World& world, const Clock& clock) override;
  void block(World&, const Clock&, Index, Index) override {}
  void refreshed(World& world, const Clock& clock, std::span<const Index> old_of_new) override;
  Limit limit(const World& world, const Clock& clock) override;
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override;
  InterfaceForce report() const;

  /// What a restart needs besides the particle fields: energies dissipated so far and the step that SOFT 1
  /// uses.
  std::vector<Real> state() const;
  void set_state(std::span<const Real> state);

  struct Penetrations {
    Index count = 0;
    Real deepest = 0;  ///< [L]
    Id particle = 0;   ///< the deepest
  };
  /// Tracked particles (the active ones, all if none is) nearer to a wall than the contact distance.
  Penetrations penetrations(World& world);
  Index candidates() const { return Index(candidate_.size()); }  ///< particle-facet pairs in the list

 private:
  struct Touch {
    Index facet;
    Vec n, q;
    Real depth, share, k;
    Real damping;  ///< part of the normal force that is damping [ML/T2]
    Vec friction;  ///< force on the particle [ML/T2]
    Vec force;     ///< total on the particle [ML/T2]
  };
  struct Slot {  ///< a particle with walls near it
    Index particle = 0;
    Index count = 0;  ///< touches now
    bool crossed = false;
    Real stored_friction = 0;
  };
  struct Near;  ///< scratch of one particle's search

  void update_facets(const World& world, const Clock& clock);
  void learn_sides(const World& world, const Clock& clock);
  void touch(World& world, const Clock& clock, Index s);
  void find_pushes(World& world, const Clock& clock, Index s, Pushes& pushes);
  bool pull_back(Near& near, const Vec& ghost, Pushes& pushes, Vec& u);
  void push_off(Near& near, Pushes& pushes, Vec& u) const;
  bool consider(const Near& near, Index c, const Vec& y, const Pushes& pushes, Push& worst,
                Real& violation) const;
  void forces_of(World& world, const Clock& clock, Index s, const Pushes& pushes);
  Vec friction_force(const World& world, const Clock& clock, Index i, Real fn, const Vec& v, const Vec& n,
                     Real k) const;
  void keep_friction(World& world, Index s);
  void scatter(World& world);
  Vec wall_velocity(const World& world, const Facet& f, const Vec& q) const;
  Real stiffness(Index i, const Facet& f, const World& world) const;
  const Corners& before(Index facet) const {
    return facets_[facet].moves ? before_[facet] : facets_[facet].x;
  }
  Real contact_distance(Index i, const Facet& f) const {
    return f.r + (radius_ ? (*radius_)[i] : radius_all_);
  }

  ContactLaw law_;
  ContactOptions options_;
  int number_;
  bool friction_on_, asleep_ = false;
  std::vector<Facet> facets_;
  std::vector<Corners> before_;  ///< corners one step ago, only for facets that move
  bool any_moves_ = false;
  FacetGrid grid_;
  Real reach_ = 0, radius_all_ = 0;
  Real limit_ = 0, soft_dt_ = 0;

  Field<Real>* k_particle_ = nullptr;  ///< penalty stiffness of the particle; 0: not tracked
  Field<Real>* radius_ = nullptr;      ///< only if it differs from particle to particle
  Field<Real>* ghost_ = nullptr;       ///< ghost minus position, 0 for a particle in front
  Field<Index>* leaked_ =
      nullptr;  ///< 1 once the particle's path crossed a mid-surface (shared by all interfaces)
  std::array<Field<Real>*, 3> friction_normal_{}, friction_force_{};

  std::vector<Slot> slots_;
  std::vector<Index> first_;       ///< candidates of slot s: [first_[s], first_[s+1])
  std::vector<Index> candidate_;   ///< facets
  std::vector<std::int8_t> side_;  ///< of the ghost, per candidate
  std::vector<Touch> touches_;     ///< Pushes::capacity per slot
  Vec total_ = Vec::Zero();
  Real stored_ = 0, stored_friction_ = 0, damping_work_ = 0, friction_work_ = 0;
};

/// Reads all *CONTACT_AUTOMATIC_NODES_TO_SURFACE of the deck. Particles and segments must exist (x, v, m,
/// rho, c, part, id; Nodes::held set by the rigid bodies). Reports what is missing or not supported, and
/// initial penetrations as warnings. Creates counters leaked_particles and initial_penetrations and maximum
/// max_penetration if there is any contact.
std::vector<std::shared_ptr<Contact>> build_contacts(const Deck& deck, const Model& model,
                                                     const ContactOptions& options, World& world,
                                                     Diagnostics& diagnostics);

}  // namespace courant
