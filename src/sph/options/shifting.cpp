// ISHIFT of *CONTROL_SPH and *COURANT_SHIFTING: particles move from where they stand close to where they
// stand apart.
#include <algorithm>
#include <cmath>

#include "keyword/registry.hpp"
#include "sph/cards.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/kernel/kernel.hpp"
#include "sph/options/drift.hpp"
#include "sph/options/drift_loops.hpp"
#include "sph/options/option_cards.hpp"
#include "sph/sph.hpp"
#include "state/restartable.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantShifting> shifting_keyword{courant_shifting_table()};

/// u_i = -A h |v_i| grad C_i, grad C_i = sum_j V_j (1 + R (W_ij/W(dx))^4) grad W_ij (Lind et al. 2012 with
/// the coefficient of Skillen et al. 2013). What is at a surface is not shifted, by div r = sum_j V_j
/// (x_j - x_i).grad W_ij; what has such a neighbour moves along the surface only, and the less the more it
/// lacks.
class Shifting : public Rate, public Restartable {
 public:
  Shifting(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
           std::shared_ptr<PairVolumes> volumes)
      : rules_(s.shift),
        mirrors_(s.mirrors),
        dim_(s.dim),
        loop_(shifting_loop(s.kernel, s.dim, s.shift.correct)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        drift_(drift_velocity(world.particles, shift_statistics)),
        density_(add_drift_density(world)),
        gradient_(sph_fields::shift_gradient(world.particles)),
        normal_(sph_fields::surface_normal(world.particles)),
        spread_(sph_fields::spread(world.particles)),
        new_spread_(sph_fields::new_spread(world.particles)),
        edge_(sph_fields::surface_near(world.particles)),
        filling_(sph_fields::filling(world.particles)),
        at_spacing_(sph_fields::kernel_at_spacing(world.particles)) {
    a_.kernel = &any_kernel(s.kernel);
    const Particles& p = world.particles;
    for (Index i = 0; i < p.size(); ++i) {
      spread_[i] = dim_;
      const Real R = std::pow(p.m[i] / p.rho[i], 1.0 / dim_) / p.h[i];
      at_spacing_[i] = kernel_at_spacing(s.kernel, R);
    }
    world.maxima.try_emplace(volume_statistic, 0);
    if (!rules_.correct) return;
    for (int k = 0; k < 3; ++k) velocity_gradient_[k] = &sph_fields::velocity_gradient(world.particles, k);
  }
  std::string name() const override { return "shifting (gradient)"; }
  void declare(const World& world, Accesses& a) const override {
    density_->declare_rate(world, a);
    a.reads(world.particles.h).reads(volumes_->before(), Reach::others).writes(drift_);
    a.writes(gradient_).writes(normal_).reads(spread_, Reach::others).writes(new_spread_).writes(edge_);
    a.writes(filling_).reads(at_spacing_);
    if (rules_.correct)
      for (const Field<Real>* gradient : velocity_gradient_) a.writes(*gradient);
  }

  void start(World& world, const Clock& clock) override {
    Particles& p = world.particles;
    density_->take_arrays(p, clock, a_);
    for (int k = 0; k < 3; ++k) {
      a_.gradient[k] = gradient_.data(k), a_.normal[k] = normal_.data(k);
    }
    if (rules_.correct)
      for (int k = 0; k < 3; ++k)
        for (int c = 0; c < 3; ++c) a_.velocity_gradient[c][k] = velocity_gradient_[c]->data(k);
    a_.h = p.h.data(), a_.V = volumes_->current();
    a_.spread = spread_.data(), a_.at_spacing = at_spacing_.data();
    a_.pairing = rules_.pairing, a_.surface = rules_.surface;
    a_.new_spread = new_spread_.data(), a_.edge = edge_.data(), a_.filling = filling_.data();
    inside_.assign(static_cast<std::size_t>(block_count(p.active)), {});
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
    density_->add(world.particles, begin, end);
    Inside& inside = inside_[static_cast<std::size_t>(begin / block_size)];
    const Particles& p = world.particles;
    for (Index i = begin; i < end; ++i) {
      drift_.set(i, known_ ? velocity(p, i) : Vec(Vec::Zero()));
      if (edge_[i] > 0) continue;
      inside.volume += a_.V[i];
      inside.filled += a_.V[i] * filling_[i];
    }
  }
  void finish(World& world, const Clock&) override {
    Inside all;
    for (const Inside& one : inside_) all.volume += one.volume, all.filled += one.filled;
    if (known_ && all.volume > 0) {
      const Real filling = all.filled / all.volume;
      if (first_filling_ == 0) first_filling_ = filling;
      note_farthest(world, volume_statistic, first_filling_ / filling - 1);
    }
    known_ = true;
  }
  void keep(Archive& archive) override {
    archive("known", known_);
    archive("first_filling", first_filling_);
  }

 private:
  struct Inside {
    Real volume = 0, filled = 0;
  };
  Vec velocity(const Particles& p, Index i) const {
    if (new_spread_[i] < rules_.surface) return Vec::Zero();
    const auto vec = [this](const Field<Real>& f, Index k) {
      return Vec(f.data(0)[k], f.data(1)[k], dim_ == 3 ? f.data(2)[k] : 0);
    };
    // before the surface is looked at: a particle and its image push each other off the mirror, hard, and
    // that is not to push along it where the surface stands oblique
    const Vec gradient = along_mirrors(mirrors_, p.x.vec(i), p.h[i], vec(gradient_, i));
    Vec shift = -rules_.strength * p.h[i] * p.v.vec(i).norm() * gradient;
    if (edge_[i] > 0) {
      const Vec n = vec(normal_, i);
      if (n.squaredNorm() > 0) shift -= shift.dot(n) / n.squaredNorm() * n;
      shift *= std::min(Real(1), (new_spread_[i] - rules_.surface) / (dim_ - rules_.surface));
    }
    return shift;
  }

  static constexpr const char* volume_statistic = "shift_volume_drift";
  ShiftRules rules_;
  std::vector<GhostPlane> mirrors_;
  int dim_;
  DriftLoop loop_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>& drift_;
  std::shared_ptr<DriftDensity> density_;
  Field<Real>&gradient_, &normal_, &spread_, &new_spread_, &edge_, &filling_, &at_spacing_;
  std::array<Field<Real>*, 3> velocity_gradient_{};  ///< null: no corrections
  bool known_ = false;                               ///< where surfaces are
  Real first_filling_ = 0;  ///< sum of kernels inside the water, its mean at the start
  std::vector<Inside> inside_;
  DriftArrays a_{};
};

/// Tells neighbours what the rates, in which they look, have found out about surfaces.
class SurfaceNote : public Preparation {
 public:
  explicit SurfaceNote(World& world)
      : spread_(sph_fields::spread(world.particles)), new_spread_(sph_fields::new_spread(world.particles)) {}
  std::string name() const override { return "surfaces"; }
  void declare(const World&, Accesses& a) const override { a.updates(spread_).reads(new_spread_); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    end = std::min(end, world.particles.active);
    for (Index i = begin; i < end; ++i) spread_[i] = new_spread_[i];
  }

 private:
  Field<Real>&spread_, &new_spread_;
};

}  // namespace

void add_shifting(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                  std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<Shifting>(s, world, std::move(neighbours), std::move(volumes)));
  world.passes.add(std::make_shared<SurfaceNote>(world));
}

}  // namespace courant
