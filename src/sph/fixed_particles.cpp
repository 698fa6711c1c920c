#include "parallel/parallel.hpp"
#include "sph/sph.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

/// BOUNDARY_SPC and TC of *NODE on particles: neither force nor velocity along the fixed directions.
class FixedParticles : public Constraint, public BoundaryForceReporter {
 public:
  FixedParticles(const Model& model, World& world)
      : fixed_(world.particles.fields.add<Index>({.name = "fixed", .dimension = "-"})) {
    for (Index i = 0; i < world.particles.size(); ++i) {
      const auto& fixed = model.nodes[model.sph[i].node].fixed;
      fixed_[i] = fixed[0] + 2 * fixed[1] + 4 * fixed[2];
      for (int k = 0; k < 3; ++k)  // outside the box, too, where the pass below does not come
        if (fixed[k]) world.particles.v.data(k)[i] = 0;
    }
    if (model.output.spcforc.asked())
      support_ = &world.particles.fields.add<Real>(
          {.name = "support_force", .dimension = "ML/T2", .components = 3, .restart = false});
  }
  std::string name() const override { return "fixed particles (SPC)"; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(fixed_).revises(world.particles.f).updates(world.particles.v);
    if (support_) a.writes(*support_);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    if (support_)
      for (Index i = begin; i < end; ++i)
        for (int k = 0; k < 3; ++k) support_->data(k)[i] = fixed_[i] & (1 << k) ? 0 - p.f.data(k)[i] : 0;
    for (Index i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k)
        if (fixed_[i] & (1 << k)) p.f.data(k)[i] = p.v.data(k)[i] = 0;
  }
  void report_forces(const World& world, const Clock&, std::vector<BoundaryForce>& out) const override {
    if (!support_) return;
    const Particles& p = world.particles;
    for (Index i = 0; i < p.active; ++i)
      if (fixed_[i] != 0)
        out.push_back({BoundaryForce::Kind::held_particle, p.id[i], support_->vec(i), Vec::Zero(), 0});
  }

 private:
  Field<Index>& fixed_;
  Field<Real>* support_ = nullptr;  ///< null: nobody asks
};

}  // namespace

std::shared_ptr<Constraint> make_fixed_particles(const Model& model, World& world) {
  for (const ModelSph& s : model.sph) {
    const auto& fixed = model.nodes[s.node].fixed;
    if (fixed[0] || fixed[1] || fixed[2]) return std::make_shared<FixedParticles>(model, world);
  }
  return nullptr;
}

}  // namespace courant
