#include "loads/point_motion.hpp"

#include <algorithm>

#include "state/particle_loops.hpp"

namespace courant {

namespace {

class ClearForces : public Rate {
 public:
  explicit ClearForces(Points points) : points_(points) {}
  std::string name() const override { return "clear forces"; }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override { a.writes(*points_.f); }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (int k = 0; k < 3; ++k) std::fill(points_.f->data(k) + begin, points_.f->data(k) + end, 0.0);
  }

 private:
  Points points_;
};

class PointMotion : public Motion {
 public:
  explicit PointMotion(Points points) : points_(points) {}
  std::string name() const override { return "motion of " + points_.name(); }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.reads(*points_.f).reads(*points_.m).updates(*points_.v).updates(*points_.x);
    if (points_.follow) a.reads(*points_.follow);
  }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    // halo particles move on, with no force
    const bool particles = points_.set == &world.particles.fields;
    const Index kicked = particles ? std::min(end, world.particles.active) : end;
    for (int k = 0; k < (particles ? world.dim : 3); ++k) {
      Real *x = points_.x->data(k), *v = points_.v->data(k);
      if (points_.follow) {
        const Real *f = points_.f->data(k), *m = points_.m->data();
        const Index* follow = points_.follow->data();
        for (Index i = begin; i < end; ++i)
          if (!follow[i]) v[i] += f[i] / m[i] * clock.dt_mean(), x[i] += v[i] * clock.dt;
      } else {
        loops_.kick(v, points_.f->data(k), points_.m->data(), clock.dt_mean(), begin, kicked);
        loops_.drift(x, v, clock.dt, begin, end);
      }
    }
  }

 private:
  Points points_;
  ParticleLoops loops_ = particle_loops();
};

class KineticEnergy : public EnergyTerm {
 public:
  explicit KineticEnergy(Points points) : points_(points) {}
  std::string name() const override { return "kinetic energy of " + points_.name(); }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    if (clock.cycle == 0) ledger.below_at_start += below(world, clock.dt);
  }
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override {
    const Real half = 0.5 * clock.dt_old;
    ledger.kinetic +=
        over_own(world, [&](Index i) { return 0.5 * (*points_.m)[i] * points_.v->vec(i).squaredNorm(); });
    ledger.half_step += over_own(world, [&](Index i) {
      const Vec f = points_.f->vec(i);
      return half * f.dot(points_.v->vec(i) + 0.5 * half / (*points_.m)[i] * f);
    });
    ledger.below += below(world, clock.dt_old);
  }

 private:
  template <class F>
  Real over_own(const World& world, const F& value) const {
    const Index count =
        points_.set == &world.particles.fields ? world.particles.active : points_.fields().size();
    return sum(count, [&](Index i) { return points_.follow && (*points_.follow)[i] ? Real(0) : value(i); });
  }
  Real below(const World& world, Real dt) const {
    return 0.125 * dt * dt *
           over_own(world, [&](Index i) { return points_.f->vec(i).squaredNorm() / (*points_.m)[i]; });
  }

  Points points_;
};

}  // namespace

std::shared_ptr<Rate> make_clear_forces(Points points) {
  return std::make_shared<ClearForces>(points);
}
std::shared_ptr<Motion> make_point_motion(Points points) {
  return std::make_shared<PointMotion>(points);
}
std::shared_ptr<EnergyTerm> make_kinetic_energy(Points points) {
  return std::make_shared<KineticEnergy>(points);
}

}  // namespace courant
