#include "sph/core/pair_fields.hpp"
#include "sph/core/pair_passes.hpp"

namespace courant {

namespace {

class PairForces : public Force {
 public:
  PairForces(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry,
             std::shared_ptr<PairVolumes> volumes)
      : geometry_(std::move(geometry)), volumes_(std::move(volumes)), fields_(s, world.particles) {
    ForcesChoice choice{s.dim,   s.uniform_h, fields_.stress(), fields_.diffusion(), Geometry::compute,
                        s.kernel};
    compute_ = forces_loop(choice);
    choice.geometry = Geometry::load;
    load_ = forces_loop(choice);
  }
  std::string name() const override { return "sph forces"; }
  void declare(const World& world, Accesses& a) const override {
    fields_.declare_pairs(world.particles, *volumes_, a);
    geometry_->declare_forces(a);
  }

  void start(World& world, const Clock&) override {
    geometry_->make_room_for_shares(forces_shares(world.dim, fields_.diffusion()), world.shares);
    a_ = fields_.arrays(world.particles, *volumes_);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    (geometry_->kept() ? load_ : compute_)(a_, geometry_->lists(begin, end));
  }

 private:
  std::shared_ptr<PairGeometry> geometry_;
  std::shared_ptr<PairVolumes> volumes_;
  ForceFields fields_;
  PairLoop compute_, load_;
  PairArrays a_{};
};

}  // namespace

std::shared_ptr<Force> make_forces(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry,
                                   std::shared_ptr<PairVolumes> volumes) {
  return std::make_shared<PairForces>(s, world, std::move(geometry), std::move(volumes));
}

}  // namespace courant
