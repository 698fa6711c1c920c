#include "search/ghosts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

class Mirrors : public Relocation {
 public:
  Mirrors(std::vector<GhostPlane> mirrors, Acceleration loads)
      : mirrors_(std::move(mirrors)), loads_(std::move(loads)) {}
  std::string name() const override { return "mirrors"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.revises(p.x).revises(p.v).reads(p.part).reads(p.state);
    if (const auto* pull = shared_fields::mirror_pull.find(p.fields)) a.reads(*pull);
  }
  void start(World& world, const Clock& clock) override {
    t_ = clock.t;
    pull_ = shared_fields::mirror_pull.find(world.particles.fields);
    crossings_.assign(block_count(world.particles.moving), 0);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (const GhostPlane& plane : mirrors_) reflect(world.particles, plane, begin, end);
  }
  void finish(World& world, const Clock&) override {
    for (const Index n : crossings_)
      if (n > 0) world.counters["mirror_crossings"] += n;
  }

 private:
  // What loads did behind the mirror is taken back twice, which errs by half a step of it, m g v dt/2, to
  // the safe side: without that a lattice that trembles on a mirror gains energy.
  void reflect(Particles& p, const GhostPlane& plane, Index begin, Index end) {
    if (!(depth_range(loops_, plane, p, begin, end).least < 0)) return;
    for (Index i = begin; i < end; ++i) {
      const Real d = depth(plane, p.x.vec(i));
      if (!(d < 0) || p.state[i] == particle_waiting) continue;
      const Real pull = -loads_(p.x.vec(i), t_, p.part[i]).dot(plane.normal);
      const Real across = -p.v.vec(i).dot(plane.normal);  // outwards
      const Real back =
          i < p.active && across > 0
              ? std::sqrt(std::max(across * across + 4 * (pull + (pull_ ? (*pull_)[i] : 0)) * d, Real(0)))
              : std::abs(across);
      p.x.add(i, -2 * d * plane.normal);
      p.v.add(i, (across + back) * plane.normal);
      ++crossings_[begin / block_size];
    }
  }
  ParticleLoops loops_ = particle_loops();
  std::vector<GhostPlane> mirrors_;
  Acceleration loads_;
  Real t_ = 0;
  const Field<Real>* pull_ = nullptr;  ///< of others than body loads
  std::vector<Index> crossings_;       ///< in each block
};

}  // namespace

ParticleLoops::Range depth_range(const ParticleLoops& loops, const GhostPlane& plane, const Particles& p,
                                 Index begin, Index end) {
  const Real* const x[3] = {p.x.data(0), p.x.data(1), p.x.data(2)};
  return loops.depths(plane.normal.data(), plane.point.data(), x, begin, end);
}

GhostParticles::GhostParticles(std::vector<GhostPlane> planes, std::shared_ptr<const Ghosts> of)
    : planes_(std::move(planes)), of_(std::move(of)), narrowest_(std::numeric_limits<Real>::infinity()) {
  for (const GhostPlane& a : planes_) {
    if (a.period > 0) narrowest_ = std::min(narrowest_, a.period);
    for (const GhostPlane& b : planes_)
      if (a.normal.dot(b.normal) < -0.5) narrowest_ = std::min(narrowest_, std::abs(depth(a, b.point)));
  }
  for (const GhostPlane& plane : planes_) {
    Motion m;
    if (plane.kind == GhostPlane::Kind::mirror) {
      m.A = Matrix::Identity() - 2 * plane.normal * plane.normal.transpose();
      m.b = 2 * plane.point.dot(plane.normal) * plane.normal;
    } else {
      m.b = plane.period * plane.normal;
    }
    mirror_.push_back(m);
  }
}

std::shared_ptr<Relocation> GhostParticles::make_mirrors(Acceleration loads) const {
  std::vector<GhostPlane> mirrors;
  for (const GhostPlane& plane : planes_)
    if (plane.kind == GhostPlane::Kind::mirror) mirrors.push_back(plane);
  if (mirrors.empty()) return nullptr;
  return std::make_shared<Mirrors>(std::move(mirrors), std::move(loads));
}

template <class Wanted>
void GhostParticles::find(const GhostPlane& plane, const Particles& p, Index first, Index last,
                          const Wanted& is_wanted) {
  collect(last - first, scratch_, [&](Index begin, Index end, std::vector<Index>& found) {
    begin += first, end += first;
    const auto [least, most, broken] = depth_range(loops_, plane, p, begin, end);
    if (!is_wanted(least) && !is_wanted(most)) return;
    for (Index i = begin; i < end; ++i)
      if (is_wanted(depth(plane, p.x.vec(i)))) found.push_back(i);
  });
}

void GhostParticles::bring_back(World& world, Index n) {
  Particles& p = world.particles;
  brought_back_.clear();
  if (of_) return;
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const GhostPlane& plane = planes_[k];
    const bool mirror = plane.kind == GhostPlane::Kind::mirror;
    const auto is_outside = [&](Real d) { return d < 0 || (!mirror && d >= plane.period); };
    find(plane, p, 0, n, is_outside);
    for (const Index i : scratch_) {
      const Vec before = p.x.vec(i);
      if (p.state[i] == particle_deactivated || p.state[i] == particle_waiting || !before.allFinite())
        continue;
      if (mirror) {
        p.x.set(i, mirror_[k].of(before));
        p.v.set(i, mirror_[k].A * p.v.vec(i));
        ++world.counters["mirror_crossings"];
      } else {  // far out after a step that was much too long: the run stops for other reasons soon
        p.x.set(i, before - std::floor(depth(plane, before) / plane.period) * mirror_[k].b);
        if (i < p.active)
          brought_back_.try_emplace(p.part[i], Vec::Zero()).first->second += p.m[i] * (p.x.vec(i) - before);
      }
    }
  }
}

void GhostParticles::build(World& world, Real support, Real skin) {
  const Real reach = support + skin;
  if (support > narrowest_)
    throw RunError(fmt::format("planes with ghost particles are {:.4g} [L] apart, and particles now reach "
                               "{:.4g}: they would see "
                               "ghost particles twice",
                               narrowest_, support),
                   "make the domain wider, or limit h by HMAX of *SECTION_SPH");
  Particles& p = world.particles;
  const Index begin = of_ ? of_->first() : 0, end = of_ ? begin + of_->count() : p.moving;
  source_.clear();
  motion_.clear();
  motions_.assign(1, Motion{});
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const GhostPlane& plane = planes_[k];
    const Index before = count();
    const auto add = [&](const Motion& motion, const auto& is_near) {
      std::vector<Index> composed(motions_.size(), -1);
      const auto ghost = [&](Index source, Index first) {
        if (composed[first] < 0) {
          composed[first] = static_cast<Index>(motions_.size());
          motions_.push_back(motion.after(motions_[first]));
        }
        source_.push_back(source);
        motion_.push_back(composed[first]);
      };
      find(plane, p, begin, end, is_near);
      for (const Index i : scratch_) ghost(i, 0);
      for (Index m = 0; m < before; ++m)  // corners: copies of copies
        if (is_near(depth(plane, motions_[motion_[m]].of(p.x.vec(source_[m])))))
          ghost(source_[m], motion_[m]);
    };
    add(mirror_[k], [&](Real d) { return d < reach; });
    if (plane.kind == GhostPlane::Kind::periodic)
      add(Motion{Matrix::Identity(), -mirror_[k].b}, [&](Real d) { return plane.period - d < reach; });
  }
  allocate(world);
  for_each_block(count(), [&](Index from, Index to) {  // positions are what ghosts are sorted by
    copy_block(p.x, true, from, to);
  });
}

void GhostParticles::sort(World& world, std::span<const Index> order) {
  for (auto* list : {&source_, &motion_}) {
    scratch_.resize(list->size());
    for (std::size_t k = 0; k < order.size(); ++k) scratch_[k] = (*list)[order[k]];
    list->swap(scratch_);
  }
  exchange_all(world);
}

void GhostParticles::exchange(World& world, std::span<const FieldBase* const> fields) {
  Particles& p = world.particles;
  std::vector<Field<Real>*> reals;
  for (const auto& field : p.fields.all())
    if (std::find(fields.begin(), fields.end(), field.get()) != fields.end())
      reals.push_back(&dynamic_cast<Field<Real>&>(*field));
  for_each_block(count(), [&](Index begin, Index end) {
    for (Field<Real>* field : reals) copy_block(*field, field == &p.x, begin, end);
  });
}

void GhostParticles::exchange_all(World& world) {
  std::vector<const FieldBase*> fields;
  for (const auto& field : world.particles.fields.all())
    if (field->info().exchange) fields.push_back(field.get());
  exchange(world, fields);
}

void GhostParticles::copy_block(Field<Real>& field, bool place, Index begin, Index end) const {
  const Index to = first();
  for (Index k = begin; k < end; ++k) {
    const Index source = source_[k];
    const Motion& m = motions_[motion_[k]];
    switch (field.info().components) {
      case 1:
        field[to + k] = field[source];
        break;
      case 3: {
        const Vec value = field.vec(source);
        field.set(to + k, place ? m.of(value) : Vec(m.A * value));
        break;
      }
      default:
        field.set_tensor(to + k, m.A * field.tensor(source) * m.A.transpose());
    }
  }
}

}  // namespace courant
