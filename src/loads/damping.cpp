// *DAMPING_GLOBAL and *DAMPING_PART_MASS: forces against the velocity, in proportion to the mass.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "loads/idle_parts.hpp"
#include "loads/load_cards.hpp"
#include "loads/loads.hpp"
#include "loads/middle_velocity.hpp"
#include "model/definitions/named_curve.hpp"
#include "model/transforms/transformation.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

struct DampingCard : DampingFields {
  Vec scale() const { return {stx, sty, stz}; }
  Vec turn_scale() const { return {srx, sry, srz}; }
};
struct DampingGlobal : DampingCard {};
struct DampingPartMass : DampingCard {
  bool of_sets() const { return name == 1; }
};

const RegisterKeyword<DampingGlobal> damping_global_keyword{damping_global_table()};
const RegisterKeyword<DampingPartMass> damping_part_mass_keyword{damping_part_mass_table()};

class DampingReader {
 public:
  DampingReader(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (Index i = 0; i < world.nodes.size(); ++i) {
      const Index part = world.nodes.part[i];  // extra nodes of a body are those of deformable parts
      if (part >= 0) parts_.insert(part);
      if (world.nodes.follow[i] == 2 && part >= 0) tied_parts_.insert(part);
      if (world.nodes.follow[i] != 1 || world.nodes.held[i] || part < 0) continue;
      if (!model.parts[static_cast<std::size_t>(part)].rigid) ++joined_[part];
    }
  }

  void add(const DampingGlobal& card) {
    Damping d{
        .curve = {}, .sf = card.valdmp, .scale = card.scale(), .turn_scale = card.turn_scale(), .parts = {}};
    if (d.scale.isZero(0) && d.turn_scale.isZero(0)) d.scale = d.turn_scale = Vec::Ones();
    if (card.lcid != 0) d.sf = 1;
    if (!read_curve(card, d)) return;
    damping_.push_back(std::move(d));
  }
  void add(const DampingPartMass& card) {
    Damping d{.curve = {}, .sf = card.sf, .parts = {}};
    if (card.flag == 1) d.scale = card.scale(), d.turn_scale = card.turn_scale();
    if (!read_curve(card, d)) return;
    if (card.of_sets()) {
      const auto set = model_.part_sets.find(card.pid);
      if (set == model_.part_sets.end())
        return error(card, "PID", fmt::format("part set {} does not exist", card.pid),
                     "define it with *SET_PART");
      d.parts = set->second;
    } else {
      const auto part = model_.part_of_id.find(card.pid);
      if (part == model_.part_of_id.end())
        return error(card, "PID", fmt::format("part {} does not exist", card.pid), "define it with *PART");
      d.parts = {part->second};
    }
    std::sort(d.parts.begin(), d.parts.end());
    warn_of_idle_parts(deck_, card, "PID", d.parts, model_, world_, diagnostics_);
    for (const Index p : d.parts) {
      const ModelPart& part = model_.parts[static_cast<std::size_t>(p)];
      if (!seen_.insert(p).second)
        return error(card, "PID", fmt::format("part {} is damped twice", part.id), "name each part once");
      if (const auto joined = joined_.find(p); joined != joined_.end())
        deck_.warning(diagnostics_, card, "PID",
                      fmt::format("{} nodes of part {} go with rigid bodies and are not damped",
                                  joined->second, part.id),
                      "none is needed where the others bring all to rest");
    }
    const bool of_all = std::includes(d.parts.begin(), d.parts.end(), parts_.begin(), parts_.end());
    if (!of_all && !tied_parts_.empty())
      deck_.warning(
          diagnostics_, card, "PID",
          fmt::format("nodes of part {} that are tied to faces are damped as the corners of these are",
                      model_.parts[static_cast<std::size_t>(*tied_parts_.begin())].id),
          "damp all parts alike, or tie by a contact with _OFFSET");
    if (!d.parts.empty()) damping_.push_back(std::move(d));
  }
  std::vector<Damping> finish() { return std::move(damping_); }

 private:
  void error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  bool read_curve(const DampingCard& card, Damping& d) {
    if (card.lcid != 0) {
      const Curve* curve = curve_named(deck_, model_, card, "LCID", card.lcid, diagnostics_);
      if (!curve) return false;
      d.curve = *curve;
    }
    const auto& values = d.curve.ordinate;
    const Real least = values.empty() ? 1 : *std::min_element(values.begin(), values.end());
    const Real most = values.empty() ? 1 : *std::max_element(values.begin(), values.end());
    if (std::min(least * d.sf, most * d.sf) >= 0 &&
        std::min(d.scale.minCoeff(), d.turn_scale.minCoeff()) >= 0)
      return true;
    error(card, "", "the damping constant gets below 0, which would drive what it acts on",
          "give curves and scales that are not negative");
    return false;
  }

  const Deck& deck_;
  const Model& model_;
  const World& world_;
  Diagnostics& diagnostics_;
  std::set<Index> parts_, tied_parts_;  ///< with nodes, with such that faces carry
  std::map<Index, Index> joined_;       // nodes of deformable parts that rigid bodies move
  std::set<Index> seen_;
  std::vector<Damping> damping_;
};

/// With d = D dt/2: v+ = ((1 - d) v- + f dt/m)/(1 + d), which damps at any step; so f becomes
/// (f - D m v-)/(1 + d). The step is not known yet: the one before represents it, what is taken from the
/// energy is counted with the kick that is done, and no step may be so much longer that v+ turns round.
/// Nothing acts along axes that SPC hold, nor along directions of prescribed motions: their reaction is that
/// of the forces alone.
class MassDamping : public Constraint, public TimeLimit, public EnergyTerm {
 public:
  MassDamping(std::vector<Damping> damping, Points points)
      : damping_(std::move(damping)), points_(points), driven_(points) {
    for (const Damping& d : damping_) by_parts_ = by_parts_ || !d.parts.empty();
    held_axes_ = points_.held().find(*points_.set);
  }
  std::string name() const override { return "damping of " + points_.name(); }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.reads(*points_.v).reads(*points_.m).revises(*points_.f);
    if (points_.follow) a.reads(*points_.follow);
    if (by_parts_ && points_.part) a.reads(*points_.part);
    driven_.declare(a);
    if (held_axes_) a.reads(*held_axes_);
  }

  void start(World&, const Clock& clock) override {
    constants_.clear();
    for (const Damping& d : damping_)
      constants_.push_back(d.at(clock.t) * (points_.turns ? d.turn_scale : d.scale));
    half_ = 0.5 * clock.dt_old;
    if (driven_.any()) taken_.resize(static_cast<std::size_t>(points_.fields().size()), Vec::Zero());
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i) {
      if (points_.follow && (*points_.follow)[i]) continue;
      const Vec D = constant(i);
      const bool driven = driven_.any(i);
      const Vec before = driven ? points_.f->vec(i) : Vec(Vec::Zero());
      for (int k = 0; k < 3; ++k) {
        Real& f = points_.f->data(k)[i];
        f = (f - D[k] * (*points_.m)[i] * points_.v->data(k)[i]) / (1 + D[k] * half_);
      }
      if (!driven) continue;
      taken_[static_cast<std::size_t>(i)] = driven_.across(i, points_.f->vec(i) - before);
      points_.f->set(i, before + taken_[static_cast<std::size_t>(i)]);
    }
  }

  bool rings() const override { return false; }
  Limit limit(const World&, const Clock& clock) override {
    Real most = 0;
    for (const Vec& d : constants_) most += d.maxCoeff();
    return {most > 0 ? clock.dt_old + 2 / most : std::numeric_limits<Real>::infinity(), name()};
  }

  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const MiddleVelocity v(points_, clock);
    const Real lost = sum(loaded_points(points_, world), [&](Index i) -> Real {
      if (points_.follow && (*points_.follow)[i]) return 0;
      const Vec D = constant(i);
      const Vec force = D.cwiseProduct((*points_.m)[i] * points_.v->vec(i) + half_ * points_.f->vec(i));
      return (driven_.any(i) ? Vec(-taken_[static_cast<std::size_t>(i)]) : force).dot(v(i)) * clock.dt_mean();
    });
    ledger.dissipated += lost;
    ledger.throughput += std::abs(lost);
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  /// Of each axis [1/T]
  Vec constant(Index i) const {
    Vec sum = Vec::Zero();
    const Index part = by_parts_ && points_.part ? (*points_.part)[i] : -1;
    for (std::size_t k = 0; k < damping_.size(); ++k) {
      if (damping_[k].acts_on(part)) sum += constants_[k];
    }
    for (int k = 0; held_axes_ && k < 3; ++k)
      if ((*held_axes_)[i] & (1 << k)) sum[k] = 0;
    return sum;
  }

  std::vector<Damping> damping_;
  Points points_;
  DrivenPoints driven_;
  std::vector<Vec> taken_;  ///< of driven points: what damping added to their forces [ML/T2]
  bool by_parts_ = false;
  const Field<Index>* held_axes_ = nullptr;  ///< null: there are none
  std::vector<Vec> constants_;               ///< of each of them now [1/T]
  Real half_ = 0;                            ///< half of a step [T]
};

}  // namespace

std::string keep_scales(DampingFields& fields, const Affine& motion) {
  const auto& card = static_cast<const DampingCard&>(fields);
  const Vec scale = card.scale(), turn_scale = card.turn_scale();
  const bool even = scale == Vec::Constant(scale[0]) && turn_scale == Vec::Constant(turn_scale[0]);
  if (even || motion.linear() == Matrix::Identity()) return {};
  return "its scales are along axes, which a transformation that turns or stretches the file would change";
}

std::vector<Damping> damping_of(const Deck& deck, const Model& model, const World& world,
                                Diagnostics& diagnostics) {
  DampingReader reader(deck, model, world, diagnostics);
  for (const DampingGlobal& card : deck.all<DampingGlobal>()) reader.add(card);
  for (const DampingPartMass& card : deck.all<DampingPartMass>()) reader.add(card);
  return reader.finish();
}

std::shared_ptr<Constraint> make_damping(std::vector<Damping> damping, Points points, World&) {
  if (damping.empty()) return nullptr;
  return std::make_shared<MassDamping>(std::move(damping), points);
}

}  // namespace courant
