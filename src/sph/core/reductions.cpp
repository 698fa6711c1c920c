// Each pair is evaluated once, for its first particle; contributions to the second, the partner, are
// scattered to an accumulation buffer of the task. These passes reduce the buffers, in the order of tasks.
#include <type_traits>

#include "sph/core/pair_fields.hpp"
#include "sph/core/pair_passes.hpp"
#include "sph/core/reduction_loops.hpp"
#include "sph/core/view.hpp"

namespace courant {

namespace {

/// `Kind`: Rate or Force; `Fields`: its fields.
template <class Kind, class Fields>
class PairReduction : public Kind {
 public:
  PairReduction(std::string name, KernelChoice kernel, Fields fields, std::shared_ptr<PairGeometry> geometry,
                std::shared_ptr<PairVolumes> volumes, ReductionLoop loop)
      : name_(std::move(name)),
        kernel_(kernel),
        fields_(std::move(fields)),
        geometry_(std::move(geometry)),
        volumes_(std::move(volumes)),
        loop_(loop) {}
  std::string name() const override { return name_; }
  void declare(const World& world, Accesses& a) const override {
    fields_.declare_reduction(world.particles, a);
    a.reads(turn());
    geometry_->declare_reduction(a);
  }

  void start(World& world, const Clock&) override {
    a_ = fields_.arrays(world.particles, *volumes_);
    norm_ = gradient_norm(kernel_, world.dim, a_.h0);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    PairGeometry::Sources sources;
    loop_(a_, geometry_->shares(begin, end, sources), norm_);
  }

 private:
  const Resource& turn() const { return std::is_same_v<Kind, Rate> ? volumes_->before() : volumes_->now(); }
  std::string name_;
  KernelChoice kernel_;
  Fields fields_;
  std::shared_ptr<PairGeometry> geometry_;
  std::shared_ptr<PairVolumes> volumes_;
  ReductionLoop loop_;
  PairArrays a_{};
  Real norm_ = 0;
};

}  // namespace

std::shared_ptr<Rate> make_rates_reduction(const SphSettings& s, World& world,
                                           std::shared_ptr<PairGeometry> geometry,
                                           std::shared_ptr<PairVolumes> volumes) {
  const RateFields fields(s, world.particles);
  const ReductionLoop loop =
      rates_reduction_loop({s.dim, s.uniform_h, fields.viscous(), fields.gradient(), s.kernel});
  return std::make_shared<PairReduction<Rate, RateFields>>("sph rates, reduction", s.kernel, fields,
                                                           std::move(geometry), std::move(volumes), loop);
}

std::shared_ptr<Force> make_forces_reduction(const SphSettings& s, World& world,
                                             std::shared_ptr<PairGeometry> geometry,
                                             std::shared_ptr<PairVolumes> volumes) {
  const ForceFields fields(s, world.particles);
  const ReductionLoop loop = forces_reduction_loop(
      {s.dim, s.uniform_h, fields.stress(), fields.diffusion(), Geometry::compute, s.kernel});
  return std::make_shared<PairReduction<Force, ForceFields>>("sph forces, reduction", s.kernel, fields,
                                                             std::move(geometry), std::move(volumes), loop);
}

}  // namespace courant
