#include "sph/core/fields.hpp"
#include "sph/core/pair_fields.hpp"
#include "sph/core/pair_passes.hpp"
#include "state/restartable.hpp"

namespace courant {

namespace {

class PairRates : public Rate {
 public:
  PairRates(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry,
            std::shared_ptr<PairVolumes> volumes)
      : name_(rates_name(s)),
        geometry_(std::move(geometry)),
        volumes_(std::move(volumes)),
        fields_(s, world.particles) {
    loop_ = rates_loop({s.dim, s.uniform_h, fields_.viscous(), fields_.gradient(), s.kernel});
  }
  std::string name() const override { return name_; }
  void declare(const World& world, Accesses& a) const override {
    fields_.declare_pairs(world.particles, *volumes_, a);
    geometry_->declare_rates(a);
  }

  void start(World& world, const Clock& clock) override {
    geometry_->prepare();
    geometry_->make_room_for_shares(rates_shares(world.dim, fields_.viscous(), fields_.gradient()),
                                    world.shares);
    a_ = fields_.arrays(world.particles, *volumes_);
    a_.half_step = 0.5 * clock.dt_old;
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    loop_(a_, geometry_->lists(begin, end));
  }

 private:
  std::string name_;
  std::shared_ptr<PairGeometry> geometry_;
  std::shared_ptr<PairVolumes> volumes_;
  RateFields fields_;
  PairLoop loop_;
  PairArrays a_{};
};

/// Keeps q1 c as pair loops read it of neighbours: while threads work on the rates, the sound speed already
/// changes.
class ViscousSpeed : public Preparation, public Refresh, public Restartable {
 public:
  ViscousSpeed(const SphSettings& s, World& world)
      : q_(s.q), speed_(sph_fields::viscous_speed(world.particles)) {}
  std::string name() const override { return "sph viscous speed"; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.particles.c).reads(world.particles.part).writes(speed_);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    work_out_viscous_speed(q_, world.particles, begin, end, speed_.data());
  }
  void refreshed(World& world, const Clock&, std::span<const Index>) override { loaded(world); }
  void keep(Archive&) override {}
  void loaded(World& world) override {
    for_each_block(world.particles.moving, [&](Index begin, Index end) { block(world, {}, begin, end); });
  }

 private:
  std::vector<PartViscosity> q_;
  Field<Real>& speed_;
};

}  // namespace

std::string rates_name(const SphSettings& s) {
  return s.kernel == KernelChoice::cubic_spline ? "sph rates"
                                                : std::string("sph rates, ") + kernel_name(s.kernel);
}

void add_viscous_speed(const SphSettings& s, World& world) {
  if (std::holds_alternative<BulkViscosity>(s.viscosity)) return;
  world.passes.add(std::make_shared<ViscousSpeed>(s, world));
}

std::shared_ptr<Rate> make_rates(const SphSettings& s, World& world, std::shared_ptr<PairGeometry> geometry,
                                 std::shared_ptr<PairVolumes> volumes) {
  add_viscous_speed(s, world);
  return std::make_shared<PairRates>(s, world, std::move(geometry), std::move(volumes));
}

}  // namespace courant
