#include "contact/tied/springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/rotation.hpp"
#include "contact/nodes/touch_holder.hpp"
#include "contact/tied/turning.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Springs k_t that act on nodes with shares b_tn: no frequency is above max_n (sum_t k_t b_tn sum_j b_tj) /
/// m_n (Gershgorin). Elements leave 1 - TSSFAC^2 of the square of a stable step to others. Nodes of a rigid
/// body that is lighter than they are count as if they were as light.
TimeLimit::Limit limit_of_springs(const std::vector<Tie>& ties, Real tssfac, const WallBodies& bodies,
                                  const World& world) {
  const Nodes& nodes = world.nodes;
  const TieShares shares(ties, true, nodes.size());
  std::vector<std::array<Real, 4>> share(ties.size());
  std::vector<Real> spread(ties.size(), 1);
  for (std::size_t t = 0; t < ties.size(); ++t) {
    share[t] = largest_shares(ties[t].at, nodes.x);
    for (const Real one : share[t]) spread[t] += one;
  }
  std::map<Index, Real> lighter;
  Real most = 0;
  Index stiffest = -1;
  const Field<Real>* const inertia = shared_fields::rotary_inertia.find(nodes.fields);
  for (Index n = 0; n < nodes.size(); ++n) {
    Real sum = 0, turns = 0;
    shares.for_each(n, [&](const TieShares::Share& one) {
      const auto t = static_cast<std::size_t>(one.tie);
      sum += ties[t].k * spread[t] * (one.corner < 0 ? 1 : share[t][static_cast<std::size_t>(one.corner)]);
      turns += 2 * ties[t].turn_k * (one.corner < 0 ? 1 : ties[t].at.N[static_cast<std::size_t>(one.corner)]);
    });
    if (turns > 0 && (*inertia)[n] > 0 && turns > most * (*inertia)[n])
      most = turns / (*inertia)[n], stiffest = n;
    if (!(sum > 0) || nodes.held[n]) continue;
    if (const Index body = bodies.body(n); body >= 0 && bodies.lighter) {
      const auto [known, is_new] = lighter.try_emplace(body, 1);
      if (is_new) known->second = std::max(Real(1), bodies.lighter(body));
      sum *= known->second;
    }
    if (sum > most * nodes.m[n]) most = sum / nodes.m[n], stiffest = n;
  }
  if (stiffest < 0) return {std::numeric_limits<Real>::infinity(), "tied contact"};
  constexpr Real most_of_elements = 0.95;  // else nothing would be left
  const Real s = std::min(tssfac, most_of_elements);
  return {2 / std::sqrt(most) * std::sqrt(1 - s * s),
          fmt::format("tied contact (node {})", nodes.id[stiffest])};
}

class TiedSprings : public Force, public EnergyTerm, public InterfaceReporter, public Restartable {
 public:
  TiedSprings(TiedSpringsLaw law, std::vector<Tie> ties, World& world)
      : law_(std::move(law)),
        ties_(std::move(ties)),
        broken_(ties_.size(), 0),
        now_(ties_.size()),
        nodes_(world.nodes.size()),
        shares_(ties_, true, nodes_),
        eroded_(shared_fields::eroded.find(world.segments.fields)) {
    if (std::any_of(ties_.begin(), ties_.end(), [](const Tie& tie) { return tie.turn_k > 0; })) {
      spin_ = shared_fields::angular_velocity.find(world.nodes.fields);
      moment_ = shared_fields::moment.find(world.nodes.fields);
      turn_.assign(3 * ties_.size(), 0);
    }
    if (law_.strength.breaks()) world.counters.try_emplace("broken_ties", 0);
    if (law_.strength.opening > 0) onset_.assign(ties_.size(), 0), widest_ = onset_;
    if (law_.cohesive.holds()) {
      world.counters.try_emplace("broken_ties", 0);
      damage_.assign(ties_.size(), 0), whole_ = damage_;
    }
  }
  std::string name() const override { return fmt::format("tied contact {}", law_.id); }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_start().reads(world.nodes.x, Reach::others);
    if (spin_) a.reads(*spin_, Reach::others);
    if (eroded_) a.reads(*eroded_, Reach::others);
    a.in_block().updates(world.nodes.f);
    if (moment_) a.updates(*moment_);
  }

  void start(World& world, const Clock& clock) override {
    if (clock.t >= law_.death) return end();
    for_each(static_cast<Index>(ties_.size()), [&](Index t) {
      look(world, static_cast<std::size_t>(t));
      if (spin_) turn(clock.dt_old, static_cast<std::size_t>(t));
    });
    for (std::size_t t = 0; t < ties_.size(); ++t) {
      lost_ += now_[t].lost, now_[t].lost = 0;
      if (!now_[t].breaks) continue;
      broken_[t] = 1, now_[t].breaks = false;
      lost_ += now_[t].stored;
      now_[t] = {};
      ++world.counters["broken_ties"];
    }
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n) {
      Vec force = Vec::Zero(), moment = Vec::Zero();
      bool any = false;
      shares_.for_each(n, [&](const TieShares::Share& share) {
        const auto t = static_cast<std::size_t>(share.tie), e = static_cast<std::size_t>(share.corner);
        force += share.corner < 0 ? now_[t].force : now_[t].on[e];
        moment += share.corner < 0 ? now_[t].moment : Vec(-ties_[t].at.N[e] * now_[t].moment);
        any = true;
      });
      if (!any) continue;
      world.nodes.f.add(n, force);
      if (moment_) moment_->add(n, moment);
    }
  }
  void record(World&, const Clock&, EnergyLedger& ledger) override {
    ledger.dissipated += lost_, ledger.throughput += lost_;
    lost_so_far_ += lost_, lost_ = 0;
  }
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    for (const SpringState& one : now_) ledger.contact += one.stored;
  }
  InterfaceForce report() const override {
    InterfaceForce out{.id = law_.id, .title = law_.title};
    for (const SpringState& one : now_) out.on_surfa += one.force, out.energy_stored += one.stored;
    out.energy_damping = lost_so_far_;
    return out;
  }
  void keep(Archive& archive) override {
    archive("broken", broken_), archive("over", over_);
    if (spin_) archive("turn", turn_);
    if (law_.strength.opening > 0) archive("onset", onset_), archive("widest", widest_);
    if (law_.cohesive.holds()) archive("damage", damage_), archive("whole", whole_);
    archive("lost", lost_);
    archive("lost_so_far", lost_so_far_);
  }

 protected:
  /// After a change of ties_.
  void fit() {
    broken_.resize(ties_.size(), 0), now_.resize(ties_.size());
    shares_ = TieShares(ties_, true, nodes_);
  }

  TiedSpringsLaw law_;
  std::vector<Tie> ties_;
  Index over_ = 0;  ///< past their death

 private:
  /// What they hold is lost.
  void end() {
    for (std::size_t t = 0; t < ties_.size(); ++t) lost_ += now_[t].stored, now_[t] = {}, broken_[t] = 1;
    over_ = 1;
  }

  struct SpringState {
    Vec force = Vec::Zero(), moment = Vec::Zero();  ///< on the node [ML/T2], [ML2/T2]
    std::array<Vec, 4> on{Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()};
    Real stored = 0;  ///< [ML2/T2]
    Real lost = 0;    ///< in this step, to damage [ML2/T2]
    bool breaks = false;
  };

  /// By how much the node has turned against the face, in axes that turn with this.
  void turn(Real dt, std::size_t t) {
    const Tie& tie = ties_[t];
    if (broken_[t] || now_[t].breaks || !(tie.turn_k > 0)) return;
    Real* const kept = turn_.data() + 3 * t;
    const Vec of_face = mean_of(tie.at, *spin_), before(kept[0], kept[1], kept[2]);
    const Vec now = turned_by(dt * of_face, Eigen::Quaterniond::Identity()) * before +
                    dt * (spin_->vec(tie.node) - of_face);
    std::copy_n(now.data(), 3, kept);
    now_[t].moment = -tie.turn_k * now;
    now_[t].stored += 0.5 * tie.turn_k * now.squaredNorm();
  }

  void look(const World& world, std::size_t t) {
    const Tie& tie = ties_[t];
    SpringState& now = now_[t];
    if (broken_[t]) return;
    const Field<Real>& x = world.nodes.x;
    const Vec away = x.vec(tie.node) - place_of(tie.at, x);
    const bool face_is_gone = eroded_ && (*eroded_)[tie.segment] != 0;
    const bool softens = !onset_.empty() && onset_[t] > 0;
    if (softens || law_.cohesive.holds()) {
      softens ? soften(t, away, x) : open(t, away, x);
      now.breaks = now.breaks || face_is_gone;
      return;
    }
    now.force = -tie.k * away;
    now.stored = 0.5 * tie.k * away.squaredNorm();
    now.on = on_corners(tie.at, x, -now.force);
    now.breaks = face_is_gone;
    if (face_is_gone || !is_beyond(tie, x, now.force)) return;
    now.breaks = !(law_.strength.opening > away.norm());
    if (!now.breaks) onset_[t] = widest_[t] = away.norm();
  }
  /// A spring whose strength was reached. To widen it from c1 to c2, where it holds with f1 and f2, takes
  /// (f1 + f2)(c2 - c1)/2, of which f2 c2/2 - f1 c1/2 can be had back.
  void soften(std::size_t t, const Vec& away, const Field<Real>& x) {
    const Real none = law_.strength.opening, c = away.norm(), before = widest_[t];
    const auto held_at = [&](Real wide) {
      return ties_[t].k * onset_[t] * (none - wide) / (none - onset_[t]);
    };
    SpringState& now = now_[t];
    if (c >= none) {
      now.stored = 0.5 * held_at(before) * none;
      now.breaks = true;
      return;
    }
    if (c > before) {
      widest_[t] = c;
      now.lost = 0.5 * (held_at(before) * c - held_at(c) * before);
    }
    const Real k = held_at(widest_[t]) / widest_[t];
    now.force = -k * away;
    now.stored = 0.5 * k * c * c;
    now.on = on_corners(ties_[t].at, x, -now.force);
  }
  /// A tie of the cohesive law. What it stores is (1 - D) w, w of the whole joint; where D grows, w dD is
  /// lost.
  void open(std::size_t t, const Vec& away, const Field<Real>& x) {
    const CohesiveLaw& law = law_.cohesive;
    const Tie& tie = ties_[t];
    const Vec n = tie.side * normal_of(tie.at, x);
    const Real wide = away.dot(n), opens = std::max(wide, Real(0)), closes = wide - opens;
    const Vec across = away - wide * n;
    const Real before = damage_[t], now_at = std::max(before, law.damage(wide, across.norm()));
    const Real kn = tie.area * law.normal_stiffness, ks = tie.area * law.shear_stiffness;
    const Real whole = 0.5 * (kn * opens * opens + ks * across.squaredNorm());
    SpringState& now = now_[t];
    now.lost = 0.5 * (whole + whole_[t]) * (now_at - before);
    damage_[t] = now_at, whole_[t] = whole;
    if (now_at >= 1) {
      now.stored = 0;
      now.breaks = true;
      return;
    }
    now.force = -(1 - now_at) * (kn * opens * n + ks * across) - kn * closes * n;
    now.stored = (1 - now_at) * whole + 0.5 * kn * closes * closes;
    now.on = on_corners(tie.at, x, -now.force);
  }
  /// Whether the stress breaks the spring.
  bool is_beyond(const Tie& tie, const Field<Real>& x, const Vec& force) const {
    if (!law_.strength.breaks()) return false;
    const Vec n = normal_of(tie.at, x);
    const Real along = -force.dot(n) * tie.side;  // > 0: the node is pulled off the face
    const Vec across = force - force.dot(n) * n;
    const TieStrength& most = law_.strength;
    const Real area = most.stress ? tie.area : 1;
    return std::pow(std::max(along, Real(0)) / (area * most.normal), most.n) +
               std::pow(across.norm() / (area * most.shear), most.m) >=
           1;
  }

  std::vector<Index> broken_;
  std::vector<Real> onset_, widest_;  ///< distances where damage began and has come to, 0: not yet [L]
  std::vector<Real> damage_, whole_;  ///< of the cohesive law [-], [ML2/T2]
  std::vector<Real> turn_;            ///< x, y, z of each tie [-]
  std::vector<SpringState> now_;
  const Field<Real>* spin_ = nullptr;  ///< of nodes; null: no rotation is held
  Field<Real>* moment_ = nullptr;
  Index nodes_;  ///< of the world
  TieShares shares_;
  const Field<Index>* eroded_;       ///< of segments; null: nothing fails
  Real lost_ = 0, lost_so_far_ = 0;  ///< stored in springs that broke [ML2/T2]
};

/// Those of nodes that are held where they touch, too, each once.
class StickingSprings : public TiedSprings, public TouchHolder, public TimeLimit {
 public:
  StickingSprings(TiedSpringsLaw law, std::vector<Tie> ties, LaterTies later, World& world)
      : TiedSprings(std::move(law), std::move(ties), world),
        later_(std::move(later)),
        at_start_(ties_.size()) {
    for (const TieNode& n : later_.nodes) node_.emplace(n.node, &n);
    for (const TieFace& f : later_.faces) face_.emplace(f.segment, &f);
    take_nodes();
    world.counters.try_emplace("tied_nodes", 0);
  }
  std::string name() const override { return TiedSprings::name(); }
  Id of_contact() const override { return later_.contact; }
  void touched(World& world, Index node, Index segment) override {
    if (over_ != 0 || held_.contains(node)) return;
    const auto n = node_.find(node);
    const auto f = face_.find(segment);
    if (n == node_.end() || f == face_.end()) return;
    const Field<Real>& x = world.nodes.x;
    const TieFace& face = *f->second;
    const Projection at = project(corners_of(face, x), face.corners, x.vec(node));
    constexpr Real rounding = 1e-6;
    if (*std::min_element(at.N.begin(), at.N.end()) < -rounding) return;  // it may come to be over a face
    held_.insert(node);
    ties_.push_back(tie_at(*n->second, face, at, x));
    ties_.back().k *= later_.scale;
    grown_ = true;
    ++world.counters["tied_nodes"];
    known_ = false;
  }
  void start(World& world, const Clock& clock) override {
    if (grown_) fit();
    grown_ = false;
    TiedSprings::start(world, clock);
  }
  /// Of all of them, whenever there are more.
  Limit limit(const World& world, const Clock&) override {
    if (!known_) limit_ = limit_of_springs(ties_, later_.tssfac, later_.bodies, world);
    if (!known_)
      limit_.dt *= std::sqrt(0.5);  // contact, which pushes held nodes, too, asks for the other half
    known_ = true;
    return limit_;
  }
  /// Those that came later are in the state.
  void keep(Archive& archive) override {
    if (grown_) fit();
    grown_ = false;
    std::vector<Index> whole;
    std::vector<Real> real;
    for (std::size_t t = at_start_; t < ties_.size(); ++t) {
      const Tie& tie = ties_[t];
      whole.insert(whole.end(), {tie.node, tie.segment, tie.at.corners});
      whole.insert(whole.end(), tie.at.node.begin(), tie.at.node.end());
      for (const auto& numbers : {tie.at.N, tie.at.by_s, tie.at.by_t})
        real.insert(real.end(), numbers.begin(), numbers.end());
      real.insert(real.end(), {tie.at.gap, tie.area, tie.k, tie.side});
    }
    archive("later_nodes", whole), archive("later_numbers", real);
    if (archive.loading()) load(whole, real);
    Index known = known_;
    archive("limit", limit_.dt), archive("limit_of", limit_.who), archive("limit_known", known);
    known_ = known != 0;
    TiedSprings::keep(archive);
  }

 private:
  static constexpr std::size_t whole_each = 7, real_each = 16;
  void load(const std::vector<Index>& whole, const std::vector<Real>& real) {
    ties_.resize(at_start_);
    for (std::size_t k = 0; k < whole.size() / whole_each; ++k) {
      const Index* n = whole.data() + whole_each * k;
      const Real* r = real.data() + real_each * k;
      Tie tie{.node = n[0], .segment = n[1], .area = r[13], .k = r[14], .side = r[15]};
      tie.at.corners = n[2], tie.at.gap = r[12];
      std::copy_n(n + 3, 4, tie.at.node.begin());
      std::copy_n(r, 4, tie.at.N.begin());
      std::copy_n(r + 4, 4, tie.at.by_s.begin()), std::copy_n(r + 8, 4, tie.at.by_t.begin());
      ties_.push_back(tie);
    }
    fit();
    take_nodes();
  }
  void take_nodes() {
    held_.clear();
    for (const Tie& tie : ties_) held_.insert(tie.node);
  }

  LaterTies later_;
  std::map<Index, const TieNode*> node_;
  std::map<Index, const TieFace*> face_;  ///< by segment
  std::size_t at_start_;
  std::set<Index> held_;  ///< nodes, also those whose springs broke
  Limit limit_{std::numeric_limits<Real>::infinity(), "tied contact"};
  bool known_ = false;  ///< `limit_` is of all ties
  bool grown_ = false;  ///< ties came since the last step
};

/// Of springs whose nodes are known at the start.
class SpringLimit : public TimeLimit {
 public:
  explicit SpringLimit(Limit limit) : limit_(std::move(limit)) {}
  std::string name() const override { return "tied contact (step)"; }
  Limit limit(const World&, const Clock&) override { return limit_; }

 private:
  Limit limit_;
};

}  // namespace

void add_springs(TiedSpringsLaw law, std::vector<Tie> ties, World& world) {
  world.passes.add(std::make_shared<TiedSprings>(std::move(law), std::move(ties), world));
}

void add_springs(TiedSpringsLaw law, std::vector<Tie> ties, LaterTies later, World& world) {
  world.passes.add(
      std::make_shared<StickingSprings>(std::move(law), std::move(ties), std::move(later), world));
}

void add_spring_limit(const std::vector<Tie>& ties, Real tssfac, const WallBodies& bodies, World& world) {
  if (!ties.empty())
    world.passes.add(std::make_shared<SpringLimit>(limit_of_springs(ties, tssfac, bodies, world)));
}

}  // namespace courant
