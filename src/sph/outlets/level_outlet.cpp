// *COURANT_LEVEL_OUTLET: draws water out of the end of a channel so that it keeps a level.
#include "sph/outlets/level_outlet.hpp"
#include "sph/boundaries/boundary_cards.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "model/definitions/named_curve.hpp"
#include "parallel/parallel.hpp"
#include "state/restartable.hpp"

namespace courant {

namespace {

using C = CourantLevelOutlet;

const RegisterKeyword<C> level_outlet_keyword{courant_level_outlet_table()};

/// What a card means.
struct Outlet {
  Id id = 0;                                  ///< of the box
  Vec low = Vec::Zero(), high = Vec::Zero();  ///< of the box [L]
  int axis = 0, up = 1;                       ///< of the flow, and the one along which gravity is
  Real sign = 1;                              ///< -1: the flow is against the axis
  Real width = 1;                             ///< of the channel [L], 1 in 2D
  Real level = 0, tau = 0, gain = 1, tint = 0;
  Curve factor{};                       ///< on the level over time; empty: 1
  std::function<Real(Real t)> gravity;  ///< along `up` [L/T2]

  Real length() const { return high[axis] - low[axis]; }
  Real level_at(Real t) const { return factor.abscissa.empty() ? level : factor(t) * level; }
  /// How far `x` is from the upstream end, of the length of the band.
  Real along(Real x) const { return (sign > 0 ? x - low[axis] : high[axis] - x) / length(); }
};

/// 0 at the ends of [0, 1/2] and beyond, with a mean of 1 in it.
Real gauge_weight(Real s) {
  const Real root = std::sin(2 * pi * s);
  return s < 0.5 ? 2 * root * root : 0;
}
/// From 0 at s = 0 to 1 at s = 1/2 and beyond.
Real draw_weight(Real s) {
  const Real root = std::sin(pi * s);
  return s < 0.5 ? root * root : 1;
}

/// Each particle of the band is accelerated by w (U - v)/TAU. A wave that goes out changes velocity and depth
/// by sqrt(g/LEVEL) of each other: with just that between U and the depth, it goes out and leaves no other
/// (Flather 1976). The velocity of the flow about which it swings is not known and is found by the integral
/// of what the depth lacks, so that the mean depth is LEVEL whatever flows in.
class LevelOutlet : public Force, public TimeLimit, public EnergyTerm, public Restartable {
 public:
  explicit LevelOutlet(Outlet outlet) : o_(std::move(outlet)), name_(fmt::format("level outlet {}", o_.id)) {}
  std::string name() const override { return name_; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x).reads(p.v).reads(p.m).reads(p.rho).updates(p.f);
  }

  void start(World& world, const Clock&) override {
    U_ = next_U_, works_ = next_works_;
    gauge_.assign(static_cast<std::size_t>(block_count(world.particles.active)), {});
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    const Real *v = p.v.data(o_.axis), *m = p.m.data();
    Real* f = p.f.data(o_.axis);
    Gauge sum;
    for_each_in_band(p, begin, end, [&](Index i, Real s) {
      const Real volume = gauge_weight(s) * m[i] / p.rho[i];
      sum.volume += volume, sum.flow += volume * o_.sign * v[i], sum.in_band = true;
      if (works_) f[i] += force(p, i, s);
    });
    gauge_[static_cast<std::size_t>(begin / block_size)] = sum;
  }
  /// The velocity of the next step.
  void finish(World&, const Clock& clock) override {
    Gauge all;
    for (const Gauge& g : gauge_) all.volume += g.volume, all.flow += g.flow;
    if (!next_works_ && !(all.volume > 0)) return;  // no water has come yet
    const Real depth = all.volume / (0.5 * o_.length() * o_.width);
    const Real level = o_.level_at(clock.t);
    const Real excess = o_.gain * std::sqrt(o_.gravity(clock.t) / level) * (depth - level);
    const Real mean = next_works_ ? mean_ + excess * clock.dt_old / o_.tint : all.flow / all.volume;
    mean_ = std::max(Real(0), mean);
    next_U_ = std::max(Real(0), mean_ + excess);
    next_works_ = true;
  }

  bool rings() const override { return false; }
  Limit limit(const World&, const Clock&) override { return {o_.tau, "TAU of " + name_}; }

  /// What the force does on the mean of the velocities before and after the kick.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    if (!works_) return;
    const Particles& p = world.particles;
    for (std::size_t b = 0; b < gauge_.size(); ++b) {
      if (!gauge_[b].in_band) continue;
      const Index begin = static_cast<Index>(b) * block_size, end = std::min(p.active, begin + block_size);
      for_each_in_band(p, begin, end, [&](Index i, Real s) {
        const Real v = p.v.data(o_.axis)[i] + 0.5 * p.f.data(o_.axis)[i] / p.m[i] * clock.dt_mean();
        const Real work = force(p, i, s) * v * clock.dt_mean();
        ledger.external_work += work, ledger.throughput += std::abs(work);
      });
    }
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  void keep(Archive& archive) override {
    archive("velocity", next_U_);
    archive("mean", mean_);
    archive("works", next_works_);
  }

 private:
  /// Of a block.
  struct Gauge {
    Real volume = 0, flow = 0;  ///< sums over the upstream half of the band [L3], [L4/T]
    bool in_band = false;       ///< any of its particles
  };

  template <class F>
  void for_each_in_band(const Particles& p, Index begin, Index end, F&& f) const {
    const Real* x = p.x.data(o_.axis);
    for (Index i = begin; i < end; ++i) {
      const Real s = o_.along(x[i]);
      if (!(s > 0 && s < 1)) continue;
      const Vec place = p.x.vec(i);
      if ((place.array() >= o_.low.array()).all() && (place.array() <= o_.high.array()).all()) f(i, s);
    }
  }
  Real force(const Particles& p, Index i, Real s) const {
    return p.m[i] * draw_weight(s) * (o_.sign * U_ - p.v.data(o_.axis)[i]) / o_.tau;
  }

  Outlet o_;
  std::string name_;
  std::vector<Gauge> gauge_;
  Real U_ = 0;  ///< velocity of the outlet in this step [L/T]
  Real next_U_ = 0, mean_ = 0;
  bool works_ = false, next_works_ = false;  ///< false until water has come
};

class LevelOutletBuilder {
 public:
  LevelOutletBuilder(const Deck& deck, const Model& model, const SphSettings& settings,
                     std::span<const GhostPlane> planes, const World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), settings_(settings), planes_(planes), diagnostics_(diagnostics) {
    if (world.particles.size() > 0) plane_z_ = world.particles.x.vec(0)[2];
  }

  /// Checked; what cannot be one is reported.
  std::vector<Outlet> build() {
    std::vector<Outlet> outlets;
    for (const C& card : deck_.all<C>()) {
      Outlet o;
      if (!read_box(card, o) || !read_axes(card, o) || !read_curve(card, o) || !check_place(card, o))
        continue;
      for (const Outlet& other : outlets)
        if (overlap(o, other))
          refuse(card, "BOXID", fmt::format("its band overlaps that of the outlet with box {}", other.id),
                 "give each outlet a band of its own");
      outlets.push_back(std::move(o));
    }
    return outlets;
  }

 private:
  bool refuse(const C& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    return false;
  }

  bool read_box(const C& card, Outlet& o) {
    const auto box = model_.boxes.find(card.boxid);
    if (box == model_.boxes.end())
      return refuse(card, "BOXID", fmt::format("box {} does not exist", card.boxid),
                    "define it with *DEFINE_BOX");
    if (box->second.local)
      return refuse(card, "BOXID",
                    fmt::format("box {} has axes of its own, which is not supported here", card.boxid),
                    "use a *DEFINE_BOX along the global axes");
    o.id = card.boxid, o.low = box->second.low, o.high = box->second.high;
    if (settings_.dim == 2) o.low[2] = o.high[2] = plane_z_;
    return true;
  }

  bool read_axes(const C& card, Outlet& o) {
    o.axis = std::abs(card.dir) - 1, o.sign = card.dir > 0 ? 1 : -1;
    if (o.axis >= settings_.dim)
      return refuse(card, "DIR", "in 2D nothing flows along z", "use 1, -1, 2 or -2");
    const BodyAcceleration loads = acceleration_of_particles(model_);
    if (!loads.uniform())
      return refuse(
          card, "DIR",
          "body loads that turn, or act on some of the SPH parts, leave no depth of the water to keep",
          "give gravity by *LOAD_BODY, and leave those loads or the outlet out");
    const Vec g = loads.at(0).everywhere();
    int across = 0;
    for (int k = 0; k < settings_.dim; ++k)
      if (k != o.axis && g[k] != 0) o.up = k, ++across;
    if (across != 1)
      return refuse(
          card, "DIR",
          fmt::format("gravity at the start has {} across the flow, and the level is "
                      "measured along one",
                      across == 0 ? "no component" : "two components"),
          "give gravity by one *LOAD_BODY across the flow; one more along it may represent a slope");
    const Real down = g[o.up] < 0 ? -1 : 1;
    o.gravity = [loads, up = o.up, down](Real t) {
      return std::max(Real(0), down * loads.at(t).everywhere()[up]);
    };
    for (int k = 0; k < settings_.dim; ++k)
      if (k != o.axis && k != o.up) o.width = o.high[k] - o.low[k];
    o.level = card.level, o.tau = card.tau, o.gain = card.gain;
    o.tint = card.tint > 0 ? card.tint : 20 * std::sqrt(o.level / o.gravity(0));
    return true;
  }

  bool read_curve(const C& card, Outlet& o) {
    if (card.lclev == 0) return true;
    const Curve* curve = curve_named(deck_, model_, card, "LCLEV", card.lclev, diagnostics_);
    if (!curve) return false;
    o.factor = *curve;
    if (*std::min_element(o.factor.ordinate.begin(), o.factor.ordinate.end()) > 0) return true;
    return refuse(card, "LCLEV",
                  fmt::format("curve {} falls to 0 or below: no water would be left", card.lclev),
                  "let it stay above 0");
  }

  bool check_place(const C& card, const Outlet& o) {
    const Real slack = 1e-6 * o.length();  // ends that decks write with few digits
    Real highest = o.level;
    for (const Real f : o.factor.ordinate) highest = std::max(highest, f * o.level);
    if (!(o.length() > 0 && o.width > 0))
      return refuse(card, "BOXID", fmt::format("box {} has no length along the flow, or no width", o.id),
                    "correct the *DEFINE_BOX");
    if (highest >= o.high[o.up] - o.low[o.up])
      return refuse(
          card, "LEVEL",
          fmt::format(
              "expected less than the height {:g} of box {}, in which the water is measured, got '{:g}'",
              o.high[o.up] - o.low[o.up], o.id, highest),
          "let the box reach well above the water");
    if (settings_.region && (o.low[o.axis] < settings_.region->low[o.axis] - slack ||
                             o.high[o.axis] > settings_.region->high[o.axis] + slack))
      return refuse(card, "BOXID",
                    fmt::format("box {} reaches out of the computational box, where nothing is solved", o.id),
                    "let it end where the BOXID of *CONTROL_SPH does");
    for (const GhostPlane& plane : planes_)
      if (behind(plane, o, slack))
        return refuse(
            card, "BOXID",
            fmt::format("box {} reaches behind a symmetry or periodic plane, so that the level would "
                        "be measured from where no water is",
                        o.id),
            "let it end at the plane");
    return true;
  }

  static bool behind(const GhostPlane& plane, const Outlet& o, Real slack) {
    for (int corner = 0; corner < 8; ++corner) {
      Vec x;
      for (int k = 0; k < 3; ++k) x[k] = corner & (1 << k) ? o.high[k] : o.low[k];
      const Real d = depth(plane, x);
      if (d < -slack || (plane.kind == GhostPlane::Kind::periodic && d > plane.period + slack)) return true;
    }
    return false;
  }

  bool overlap(const Outlet& a, const Outlet& b) const {
    for (int k = 0; k < settings_.dim; ++k)
      if (a.high[k] <= b.low[k] || b.high[k] <= a.low[k]) return false;
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  const SphSettings& settings_;
  std::span<const GhostPlane> planes_;
  Diagnostics& diagnostics_;
  Real plane_z_ = 0;  ///< where all particles are in 2D
};

}  // namespace

std::string keep_direction(CourantLevelOutlet&, const Affine& motion) {
  if (motion.linear() == Matrix::Identity()) return {};
  return "its direction is an axis, which a transformation that turns or stretches the file would change";
}

bool add_level_outlets(const Deck& deck, const Model& model, const SphSettings& settings,
                       std::span<const GhostPlane> planes, World& world, Diagnostics& diagnostics) {
  const std::vector<Outlet> outlets =
      LevelOutletBuilder(deck, model, settings, planes, world, diagnostics).build();
  for (const Outlet& outlet : outlets) {
    world.passes.add(std::make_shared<LevelOutlet>(outlet));
  }
  return !outlets.empty();
}

}  // namespace courant
