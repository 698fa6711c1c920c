#include "contact/tied/springs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

class TiedSprings : public Force,
                    public TimeLimit,
                    public EnergyTerm,
                    public InterfaceReporter,
                    public Restartable {
 public:
  TiedSprings(TiedSpringsLaw law, std::vector<Tie> ties, World& world)
      : law_(std::move(law)),
        ties_(std::move(ties)),
        broken_(ties_.size(), 0),
        now_(ties_.size()),
        shares_(ties_, true, world.nodes.size()),
        eroded_(shared_fields::eroded.find(world.segments.fields)) {
    find_limit(world);
    if (law_.strength.breaks()) world.counters.try_emplace("broken_ties", 0);
  }
  std::string name() const override { return fmt::format("tied contact {}", law_.id); }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_start().reads(world.nodes.x, Reach::others);
    if (eroded_) a.reads(*eroded_, Reach::others);
    a.in_block().updates(world.nodes.f);
  }

  void start(World& world, const Clock&) override {
    for_each(static_cast<Index>(ties_.size()), [&](Index t) { look(world, static_cast<std::size_t>(t)); });
    for (std::size_t t = 0; t < ties_.size(); ++t) {
      if (!now_[t].breaks) continue;
      broken_[t] = 1, now_[t].breaks = false;
      lost_ += now_[t].stored;
      now_[t] = {};
      ++world.counters["broken_ties"];
    }
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n) {
      Vec force = Vec::Zero();
      bool any = false;
      shares_.for_each(n, [&](const TieShares::Share& share) {
        const Now& one = now_[static_cast<std::size_t>(share.tie)];
        force += share.corner < 0 ? one.force : one.on[static_cast<std::size_t>(share.corner)];
        any = true;
      });
      if (any) world.nodes.f.add(n, force);
    }
  }
  Limit limit(const World&, const Clock&) override { return {limit_, who_}; }
  void record(World&, const Clock&, EnergyLedger& ledger) override {
    ledger.dissipated += lost_, ledger.throughput += lost_;
    lost_so_far_ += lost_, lost_ = 0;
  }
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    for (const Now& one : now_) ledger.contact += one.stored;
  }
  InterfaceForce report() const override {
    InterfaceForce out{.id = law_.id, .title = law_.title};
    for (const Now& one : now_) out.on_surfa += one.force, out.energy_stored += one.stored;
    out.energy_damping = lost_so_far_;
    return out;
  }
  void keep(Archive& archive) override {
    archive("broken", broken_);
    archive("lost", lost_);
    archive("lost_so_far", lost_so_far_);
  }

 private:
  struct Now {
    Vec force = Vec::Zero();  ///< on the node [ML/T2]
    std::array<Vec, 4> on{Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()};
    Real stored = 0;  ///< [ML2/T2]
    bool breaks = false;
  };

  void look(const World& world, std::size_t t) {
    const Tie& tie = ties_[t];
    Now& now = now_[t];
    if (broken_[t]) return;
    const Field<Real>& x = world.nodes.x;
    const Vec away = x.vec(tie.node) - place_of(tie.at, x);
    now.force = -tie.k * away;
    now.stored = 0.5 * tie.k * away.squaredNorm();
    now.on = on_corners(tie.at, x, -now.force);
    now.breaks = (eroded_ && (*eroded_)[tie.segment] != 0) || is_beyond(tie, x, now.force);
  }
  /// Whether the stress breaks the spring. The normal of the face points at the side of the node where there
  /// is a gap, else out of solids, and away from the other side of shells.
  bool is_beyond(const Tie& tie, const Field<Real>& x, const Vec& force) const {
    if (!law_.strength.breaks()) return false;
    const Vec n = normal_of(tie.at, x);
    const Real along = -force.dot(n) * (tie.at.gap < 0 ? -1 : 1);  // > 0: the node is pulled off the face
    const Vec across = force - force.dot(n) * n;
    const TieStrength& most = law_.strength;
    const Real area = most.stress ? tie.area : 1;
    return std::pow(std::max(along, Real(0)) / (area * most.normal), most.n) +
               std::pow(across.norm() / (area * most.shear), most.m) >=
           1;
  }

  // Springs k_t that act on nodes with shares b_tn: no frequency is above max_n (sum_t k_t b_tn sum_j b_tj) /
  // m_n (Gershgorin). Elements leave 1 - TSSFAC^2 of the square of a stable step to others.
  void find_limit(const World& world) {
    const Nodes& nodes = world.nodes;
    std::vector<std::array<Real, 4>> share(ties_.size());
    std::vector<Real> spread(ties_.size(), 1);
    for (std::size_t t = 0; t < ties_.size(); ++t) {
      share[t] = largest_shares(ties_[t].at, nodes.x);
      for (const Real one : share[t]) spread[t] += one;
    }
    Real most = 0;
    Index stiffest = -1;
    for (Index n = 0; n < nodes.size(); ++n) {
      Real sum = 0;
      shares_.for_each(n, [&](const TieShares::Share& one) {
        const auto t = static_cast<std::size_t>(one.tie);
        sum += ties_[t].k * spread[t] * (one.corner < 0 ? 1 : share[t][static_cast<std::size_t>(one.corner)]);
      });
      if (sum > 0 && !nodes.held[n] && sum > most * nodes.m[n]) most = sum / nodes.m[n], stiffest = n;
    }
    if (stiffest < 0) return;
    constexpr Real most_of_elements = 0.95;  // else nothing would be left
    const Real s = std::min(law_.tssfac, most_of_elements);
    limit_ = 2 / std::sqrt(most) * std::sqrt(1 - s * s);
    who_ = fmt::format("{} (node {})", name(), nodes.id[stiffest]);
  }

  TiedSpringsLaw law_;
  std::vector<Tie> ties_;
  std::vector<Index> broken_;
  std::vector<Now> now_;
  TieShares shares_;
  const Field<Index>* eroded_;  ///< of segments; null: nothing fails
  Real limit_ = std::numeric_limits<Real>::infinity();
  std::string who_ = "tied contact";
  Real lost_ = 0, lost_so_far_ = 0;  ///< stored in springs that broke [ML2/T2]
};

}  // namespace

void add_springs(TiedSpringsLaw law, std::vector<Tie> ties, World& world) {
  world.passes.add(std::make_shared<TiedSprings>(std::move(law), std::move(ties), world));
}

}  // namespace courant
