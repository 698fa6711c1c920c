#include "sph/fields.hpp"
#include "sph/pair_geometry.hpp"
#include "sph/pair_volumes.hpp"
#include "sph/sph.hpp"
#include "sph/view.hpp"

namespace courant {

namespace {

/// Pressure and viscous stress of eq. 7, and what density diffusion will do; artificial viscosity comes with
/// the rates.
class PairForces : public Force {
 public:
  PairForces(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry,
             std::shared_ptr<PairVolumes> volumes)
      : geometry_(std::move(geometry)), volumes_(std::move(volumes)) {
    Particles& p = world.particles;
    if (std::holds_alternative<BulkViscosity>(s.viscosity)) total_pressure_ = &sph_fields::pressure_plus_q(p);
    if (!s.mu.empty()) tau_ = &sph_fields::stress(p);
    if (s.density_diffusion > 0) {
      diffusion_ = &sph_fields::density_diffusion(p);
      potential_ = &sph_fields::potential(p);
    }
    delta_ = s.density_diffusion;
    ForcesChoice choice{s.dim,   s.uniform_h, !s.mu.empty(), diffusion_ != nullptr, Geometry::compute,
                        s.kernel};
    compute_ = forces_loop(choice);
    choice.geometry = Geometry::load;
    load_ = forces_loop(choice);
  }
  std::string name() const override { return "sph forces"; }

  void start(World& world, const Clock&) override {
    a_ = particle_arrays(world.particles);
    a_.V = volumes_->current();
    a_.p = total_pressure_ ? total_pressure_->data() : world.particles.p.data();
    if (diffusion_) {
      a_.c = world.particles.c.data();
      a_.diffusion = diffusion_->data();
      a_.delta = delta_;
      a_.potential = potential_->data();
    }
    for (int k = 0; k < 6; ++k) a_.tau[k] = tau_ ? tau_->data(k) : nullptr;
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    (geometry_->kept() ? load_ : compute_)(a_, geometry_->lists(begin, end));
  }

 private:
  std::shared_ptr<PairGeometry> geometry_;
  std::shared_ptr<PairVolumes> volumes_;
  Field<Real>* total_pressure_ = nullptr;
  Field<Real>* tau_ = nullptr;
  Field<Real>*diffusion_ = nullptr, *potential_ = nullptr;
  Real delta_ = 0;
  PairLoop compute_, load_;
  PairArrays a_{};
};

}  // namespace

std::shared_ptr<Force> make_forces(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry,
                                   std::shared_ptr<PairVolumes> volumes) {
  return std::make_shared<PairForces>(s, world, std::move(geometry), std::move(volumes));
}

}  // namespace courant
