#include "search/images.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "parallel/parallel.hpp"

namespace courant {

namespace {

class Mirrors : public Motion {
 public:
  Mirrors(std::vector<ImagePlane> mirrors, std::function<Vec(Real)> gravity)
      : mirrors_(std::move(mirrors)), gravity_(std::move(gravity)) {}
  std::string name() const override { return "mirrors"; }
  void start(World& world, const Clock& clock) override {
    g_ = gravity_(clock.t);
    pull_ = dynamic_cast<const Field<Real>*>(world.particles.fields.find("mirror_pull"));
    crossings_.assign(block_count(world.particles.moving), 0);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    for (const ImagePlane& plane : mirrors_) reflect(world.particles, plane, begin, end);
  }
  void finish(World& world, const Clock&) override {
    for (const Index n : crossings_)
      if (n > 0) world.counters["mirror_crossings"] += n;
  }

 private:
  // What gravity did behind the mirror is taken back twice, which errs by half a step of it, m g v dt/2, to
  // the safe side: without that a lattice that trembles on a mirror gains energy.
  void reflect(Particles& p, const ImagePlane& plane, Index begin, Index end) {
    if (!(least_depth(plane, p, begin, end) < 0)) return;
    const Real pull = -g_.dot(plane.normal);
    for (Index i = begin; i < end; ++i) {
      const Real d = depth(plane, p.x.vec(i));
      if (!(d < 0)) continue;
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
  std::vector<ImagePlane> mirrors_;
  std::function<Vec(Real)> gravity_;
  Vec g_ = Vec::Zero();
  const Field<Real>* pull_ = nullptr;  ///< of others than gravity
  std::vector<Index> crossings_;       ///< in each block
};

}  // namespace

Real least_depth(const ImagePlane& plane, const Particles& p, Index begin, Index end) {
  const Real *x = p.x.data(0), *y = p.x.data(1), *z = p.x.data(2);
  Real least = std::numeric_limits<Real>::infinity();
#pragma omp simd reduction(min : least)
  for (Index i = begin; i < end; ++i) least = std::min(least, depth(plane, x[i], y[i], z[i]));
  return least;
}

Images::Images(std::vector<ImagePlane> planes) : planes_(std::move(planes)) {
  for (const ImagePlane& plane : planes_) {
    Motion m;
    if (plane.kind == ImagePlane::Kind::mirror) {
      m.A = Matrix::Identity() - 2 * plane.normal * plane.normal.transpose();
      m.b = 2 * plane.point.dot(plane.normal) * plane.normal;
    } else {
      m.b = plane.period * plane.normal;
    }
    mirror_.push_back(m);
  }
}

std::shared_ptr<::courant::Motion> Images::make_mirrors(std::function<Vec(Real)> gravity) const {
  std::vector<ImagePlane> mirrors;
  for (const ImagePlane& plane : planes_)
    if (plane.kind == ImagePlane::Kind::mirror) mirrors.push_back(plane);
  if (mirrors.empty()) return nullptr;
  return std::make_shared<Mirrors>(std::move(mirrors), std::move(gravity));
}

void Images::bring_back(World& world, Index n) {
  Particles& p = world.particles;
  brought_back_.setZero();
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const ImagePlane& plane = planes_[k];
    const bool mirror = plane.kind == ImagePlane::Kind::mirror;
    for (Index i = 0; i < n; ++i) {
      const Vec before = p.x.vec(i);
      const Real d = depth(plane, before);
      const bool outside = mirror ? d < 0 : d < 0 || d >= plane.period;
      if (!outside || p.state[i] == particle_deactivated || !before.allFinite()) continue;
      if (mirror) {
        p.x.set(i, mirror_[k].of(before));
        p.v.set(i, mirror_[k].A * p.v.vec(i));
      } else {  // far out after a step that was much too long: the run stops for other reasons soon
        p.x.set(i, before - std::floor(d / plane.period) * mirror_[k].b);
      }
      if (mirror) ++world.counters["mirror_crossings"];
      if (!mirror && i < p.active) brought_back_ += p.m[i] * (p.x.vec(i) - before);
    }
  }
}

void Images::build(World& world, Real reach) {
  Particles& p = world.particles;
  source_.clear();
  motion_.clear();
  motions_.assign(1, Motion{});
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const Index before = count();
    const auto add = [&](const Motion& motion, auto&& wanted) {
      std::vector<Index> composed(motions_.size(), -1);
      const auto image = [&](Index source, Index first) {
        if (!wanted(motions_[first].of(p.x.vec(source)))) return;
        if (composed[first] < 0) {
          composed[first] = static_cast<Index>(motions_.size());
          motions_.push_back(motion.after(motions_[first]));
        }
        source_.push_back(source);
        motion_.push_back(composed[first]);
      };
      for (Index i = 0; i < p.moving; ++i) image(i, 0);
      for (Index m = 0; m < before; ++m) image(source_[m], motion_[m]);  // corners: images of images
    };
    const ImagePlane& plane = planes_[k];
    const auto near = [&](const Vec& x) { return depth(plane, x) < reach; };
    const auto near_other = [&](const Vec& x) { return plane.period - depth(plane, x) < reach; };
    add(mirror_[k], near);
    if (plane.kind == ImagePlane::Kind::periodic) add(Motion{Matrix::Identity(), -mirror_[k].b}, near_other);
  }
  p.fields.make_room_for_images(count());
  copy_field(p.x, p.size(), true);  // places are what images are sorted by
}

void Images::sort(World& world, std::span<const Index> order) {
  for (auto* list : {&source_, &motion_}) {
    scratch_.resize(list->size());
    for (std::size_t k = 0; k < order.size(); ++k) scratch_[k] = (*list)[order[k]];
    list->swap(scratch_);
  }
  before_rates(world);
}

void Images::copy(World& world, Exchange when) const {
  Particles& p = world.particles;
  for (const auto& field : p.fields.all()) {
    if (field->info().exchange != when && field->info().exchange != Exchange::always) continue;
    auto& values = dynamic_cast<Field<Real>&>(*field);
    copy_field(values, p.size(), &values == &p.x);
  }
}

void Images::copy_field(Field<Real>& field, Index first, bool place) const {
  const Index n = count();
  if (field.info().components == 1)
    return for_each(n, [&, values = field.data()](Index k) { values[first + k] = values[source_[k]]; });
  if (field.info().components == 3)
    return for_each(n, [&](Index k) {
      const Motion& m = motions_[motion_[k]];
      const Vec value = field.vec(source_[k]);
      field.set(first + k, place ? m.of(value) : Vec(m.A * value));
    });
  for_each(n, [&](Index k) {
    const Matrix& A = motions_[motion_[k]].A;
    field.set_tensor(first + k, A * field.tensor(source_[k]) * A.transpose());
  });
}

}  // namespace courant
