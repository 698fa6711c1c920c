// METHOD 1 of *COURANT_WALL_SUPPORT: walls as mirrors of the water beside them.
#include <cmath>

#include "search/neighbours.hpp"
#include "sph/boundaries/wall_images.hpp"
#include "sph/core/fields.hpp"

namespace courant {

WallImages::WallImages(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                       std::shared_ptr<PairVolumes> volumes, std::shared_ptr<WallSupport> support)
    : dim_(s.dim),
      delta_(s.density_diffusion),
      loads_(s.loads),
      table_(s.kernel, s.dim),
      neighbours_(std::move(neighbours)),
      volumes_(std::move(volumes)),
      support_(std::move(support)),
      pressure_(std::holds_alternative<BulkViscosity>(s.viscosity)
                    ? sph_fields::pressure_plus_q(world.particles)
                    : world.particles.p),
      force_(sph_fields::wall_force(world.particles)),
      diffusion_(s.density_diffusion > 0 ? &sph_fields::density_diffusion(world.particles) : nullptr),
      paths_from_(support_->surface(), s.dim, WallPaths::usual_width * s.spacing) {}

Real WallImages::slope(Real h, const Vec& d) const {
  const Real r = std::max(d.norm(), 1e-9 * h);
  return table_.slope(r / h) / (r * h * (dim_ == 2 ? power<2>(h) : power<3>(h)));
}

Real WallImages::kernel(Real h, const Vec& d) const {
  return table_.kernel(d.norm() / h) / (dim_ == 2 ? power<2>(h) : power<3>(h));
}

void WallImages::refreshed(World& world, const Clock&, std::span<const Index>) {
  look(world);
}

void WallImages::look(World& world) {
  const Particles& p = world.particles;
  sheets_.assign(p.active, {});
  for_each(p.active, [&](Index i) {
    if (support_->is_near(i)) sheets_[i] = paths_from_.seen_from(p.x.vec(i));
    force_.set(i, Vec::Zero());
  });
}

void WallImages::declare(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads(p.h);
  a.reads(volumes_->before(), Reach::others).reads_before(p.rho).updates(p.drhodt);
}

void WallImages::start(World& world, const Clock& clock) {
  half_step_ = 0.5 * clock.dt_old;
  paths_.resize(static_cast<std::size_t>(block_count(world.particles.active)));
}

void WallImages::block(World& world, const Clock&, Index begin, Index end) {
  auto& paths = paths_[static_cast<std::size_t>(begin / block_size)];
  paths.clear();
  for (Index i = begin; i < end; ++i) {
    if (sheets_[i].empty()) continue;
    for (const Index j : neighbours_->of_group(i / Neighbours::lanes)) add_ways(world.particles, i, j, paths);
  }
}

/// Ways are looked for in the middle of the step, where its rates belong, and taken along to its end, where
/// forces act; those on their way over an edge are looked at there again.
void WallImages::add_ways(Particles& p, Index i, Index j, std::vector<WallPath>& paths) const {
  const auto in_the_middle = [&](Index k) { return Vec(p.x.vec(k) - half_step_ * p.v.vec(k)); };
  const Real reach = table_.support() * p.h[i];
  const std::size_t first = paths.size();
  paths_from_.add(sheets_[i], i, in_the_middle(i), j, in_the_middle(j), reach, paths);
  bool at_edge = false;
  for (std::size_t k = first; k < paths.size(); ++k) {
    add_rate(p, paths[k]);
    at_edge |= std::abs(paths[k].weight) < 1;
    paths[k].d += half_step_ * speed(p, paths[k]);
  }
  if (!at_edge) return;
  paths.resize(first);
  paths_from_.add(sheets_[i], i, p.x.vec(i), j, p.x.vec(j), reach, paths);
}

/// Of particle i over the image of j. [L/T]
Vec WallImages::speed(const Particles& p, const WallPath& path) const {
  return p.v.vec(path.i) - path.turn * p.v.vec(path.j);
}

void WallImages::add_rate(Particles& p, const WallPath& path) const {
  const Real h = p.h[path.i];
  p.drhodt[path.i] += p.rho[path.i] * volumes_->current()[path.j] *
                      (path.weight * slope(h, path.d) * speed(p, path).dot(path.d) +
                       kernel(h, path.d) * (path.by_i.dot(p.v.vec(path.i)) + path.by_j.dot(p.v.vec(path.j))));
}

void WallImages::declare_forces(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(p.x, Reach::others).reads(pressure_, Reach::others).reads(volumes_->now(), Reach::others);
  a.reads(p.h).reads(p.rho).reads(p.c).reads(p.part).updates(p.f).updates(force_);
  if (diffusion_) a.updates(*diffusion_);
}

void WallImages::start_forces(const Clock& clock) {
  now_ = loads_.at(clock.t);
}

void WallImages::forces(World& world, Index begin, Index end) {
  Particles& p = world.particles;
  const Real* V = volumes_->current();
  for (Index i = begin; i < end; ++i)
    if (!sheets_[i].empty()) force_.set(i, Vec::Zero());
  for (const WallPath& path : paths_[static_cast<std::size_t>(begin / block_size)]) {
    const Index i = path.i, j = path.j;
    const Real share = path.weight * V[j] * slope(p.h[i], path.d);
    const Vec force =
        -V[i] * (pressure_[i] + pressure_[j]) * (share * path.d + V[j] * kernel(p.h[i], path.d) * path.by_i);
    p.f.add(i, force);
    if (path.weight > 0) force_.add(i, force);
    if (!diffusion_) continue;
    // behind the wall pressure goes on as at rest, so what it differs by is the same as without the wall
    const Vec x = p.x.vec(i);
    const Real rise = now_.rise(x, p.x.vec(j) - x, p.part[i]);
    (*diffusion_)[i] -=
        2 * delta_ * p.h[i] / p.c[i] * share * (pressure_[j] - pressure_[i] + p.rho[i] * rise);
  }
}

namespace {

class WallImageForces : public Force {
 public:
  explicit WallImageForces(std::shared_ptr<WallImages> images) : images_(std::move(images)) {}
  std::string name() const override { return "wall images (forces)"; }
  void declare(const World& world, Accesses& a) const override { images_->declare_forces(world, a); }
  void start(World&, const Clock& clock) override { images_->start_forces(clock); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    images_->forces(world, begin, end);
  }

 private:
  std::shared_ptr<WallImages> images_;
};

}  // namespace

std::shared_ptr<Force> make_wall_image_forces(std::shared_ptr<WallImages> images) {
  return std::make_shared<WallImageForces>(std::move(images));
}

}  // namespace courant
