#include "sph/prescribed_particles.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "parallel/parallel.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

/// Motions of which a particle follows all at once.
using Group = std::vector<std::size_t>;

/// Gives driven particles the velocity of the coming half step before they are kicked and moved, and takes
/// the force along it away. What the drive does of work is external.
class PrescribedParticles : public Drive, public EnergyTerm, public BoundaryForceReporter {
 public:
  PrescribedParticles(std::vector<PrescribedMotion> motions, std::vector<Group> groups, Field<Index>& group,
                      Field<Real>* work)
      : motions_(std::move(motions)), groups_(std::move(groups)), group_(group), work_(work) {}
  std::string name() const override { return "prescribed particles"; }
  void declare(const World& world, Accesses& a) const override {
    a.updates(world.particles.v).updates(world.particles.f).reads(group_);
  }

  void start(World&, const Clock& clock) override { choose(clock); }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Particles& p = world.particles;
    for (Index i = begin; i < std::min(end, p.active); ++i) {
      if (group_[i] == 0) continue;
      for (const Drive* drive : drives_[static_cast<std::size_t>(group_[i])]) {
        const Vec &d = drive->direction, v = p.v.vec(i), f = p.f.vec(i);
        p.v.add(i, (drive->velocity(v) - v.dot(d)) * d);
        p.f.add(i, -f.dot(d) * d);
      }
    }
  }

  /// The force of the drive makes m dv = (f + drive) dt; its work is drive . (v + dv/2) dt.
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    choose(clock);
    const Particles& p = world.particles;
    const Real dt = clock.dt_mean();
    const auto work_on = [&](Index i) {
      Real work = 0;
      if (group_[i] == 0) return work;
      for (const Drive* drive : drives_[static_cast<std::size_t>(group_[i])]) {
        const Vec v = p.v.vec(i);
        const Real before = v.dot(drive->direction), after = drive->velocity(v);
        work += (p.m[i] * (after - before) - p.f.vec(i).dot(drive->direction) * dt) * 0.5 * (before + after);
      }
      return work;
    };
    if (work_)
      for (Index i = 0; i < p.active; ++i) (*work_)[i] += work_on(i);
    ledger.external_work += sum(p.active, work_on);
    ledger.throughput += sum(p.active, [&](Index i) { return std::abs(work_on(i)); });
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  void report_forces(const World& world, const Clock& clock, std::vector<BoundaryForce>& out) const override {
    if (!work_) return;
    const Particles& p = world.particles;
    for (Index i = 0; i < p.active; ++i) {
      if (group_[i] == 0) continue;
      BoundaryForce force{BoundaryForce::Kind::driven_particle, p.id[i], Vec::Zero(), Vec::Zero(),
                          (*work_)[i]};
      for (const std::size_t k : groups_[static_cast<std::size_t>(group_[i])]) {
        const PrescribedMotion& m = motions_[k];
        if (!m.drives(clock.t, clock.dt)) continue;
        const Vec& d = m.direction;
        const Real before = p.v.vec(i).dot(d);
        const Real after = m.velocity(clock.t, clock.dt, clock.dt_old, before);
        force.force += (p.m[i] * (after - before) / clock.dt_mean() - p.f.vec(i).dot(d)) * d;
      }
      out.push_back(force);
    }
  }

 private:
  /// What a motion does in the coming step: v.direction becomes `at_zero` + `keep` v.direction.
  struct Drive {
    Vec direction = Vec::Zero();
    Real at_zero = 0, keep = 0;
    Real velocity(const Vec& v) const { return at_zero + keep * v.dot(direction); }
  };

  void choose(const Clock& clock) {
    all_.assign(motions_.size(), {});
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      const PrescribedMotion& m = motions_[k];
      if (m.drives(clock.t, clock.dt))
        all_[k] = {m.direction, m.velocity(clock.t, clock.dt, clock.dt_old, 0),
                   m.kind == PrescribedMotion::Kind::acceleration ? 1.0 : 0.0};
    }
    drives_.assign(groups_.size(), {});
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const std::size_t k : groups_[g])
        if (motions_[k].drives(clock.t, clock.dt)) drives_[g].push_back(&all_[k]);
  }

  std::vector<PrescribedMotion> motions_;
  std::vector<Group> groups_;                      ///< the first one is empty
  Field<Index>& group_;                            ///< of each particle
  Field<Real>* work_;                              ///< on each particle so far; null: nobody asks
  std::vector<Drive> all_;                         ///< of each motion
  std::vector<std::vector<const Drive*>> drives_;  ///< of each group, those that drive in this step
};

class Builder {
 public:
  Builder(const Deck& deck, const Model& model, const SphSettings& settings,
          std::span<const ImagePlane> planes, Diagnostics& diagnostics)
      : deck_(deck), model_(model), settings_(settings), planes_(planes), diagnostics_(diagnostics) {
    particle_of_node_.assign(model.nodes.size(), -1);
    for (std::size_t i = 0; i < model.sph.size(); ++i)
      particle_of_node_[static_cast<std::size_t>(model.sph[i].node)] = static_cast<Index>(i);
    motions_of_.resize(model.sph.size());
  }

  void add(const PrescribedMotion& motion) {
    if (settings_.dim == 2 && motion.direction[2] != 0)
      return error(motion, "DOF", "in 2D particles stay in their plane, so nothing moves along z",
                   "use DOF 1 or 2");
    if (settings_.region)
      return error(motion, "DOF",
                   "prescribed motions and the box BOXID of *CONTROL_SPH exclude each other: outside of it "
                   "particles keep their velocity",
                   "leave BOXID blank");
    constexpr Real along = 1e-9;  // cosine
    for (const ImagePlane& plane : planes_)
      if (plane.kind == ImagePlane::Kind::mirror && std::abs(plane.normal.dot(motion.direction)) > along)
        return error(
            motion, "DOF",
            "the direction is not along a symmetry plane, which would reflect what is driven through it",
            "drive along the plane, or use a driven rigid plate as the wall");
    motions_.push_back(motion);
    for (const Index n : motion.nodes)
      if (!add(motion, n)) return;  // one message for each card
  }

  bool any() const { return !motions_.empty(); }

  std::shared_ptr<PrescribedParticles> finish(World& world) {
    auto& group = world.particles.fields.add<Index>({.name = "prescribed_motion", .dimension = "-"});
    std::map<Group, Index> known{{Group(), 0}};
    std::vector<Group> groups{Group()};
    for (std::size_t i = 0; i < motions_of_.size(); ++i) {
      const auto [it, is_new] = known.try_emplace(motions_of_[i], static_cast<Index>(groups.size()));
      if (is_new) groups.push_back(motions_of_[i]);
      group[static_cast<Index>(i)] = it->second;
    }
    Field<Real>* work = nullptr;
    if (model_.output.bndout.asked())
      work = &world.particles.fields.add<Real>({.name = "drive_work", .dimension = "ML2/T2"});
    return std::make_shared<PrescribedParticles>(std::move(motions_), std::move(groups), group, work);
  }

 private:
  void error(const PrescribedMotion& motion, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, motion.card, field, std::move(message), std::move(hint));
  }

  bool add(const PrescribedMotion& motion, Index n) {
    const ModelNode& node = model_.nodes[static_cast<std::size_t>(n)];
    const Index i = particle_of_node_[static_cast<std::size_t>(n)];
    if (i < 0) {
      error(motion, "DOF",
            fmt::format("node {} is no particle: only particles and rigid bodies can be driven", node.id),
            "drive rigid bodies by *BOUNDARY_PRESCRIBED_MOTION_RIGID");
      return false;
    }
    for (int k = 0; k < 3; ++k)
      if (node.fixed[static_cast<std::size_t>(k)] && motion.direction[k] != 0) {
        error(motion, "DOF",
              fmt::format("particle {} is held in {} by *BOUNDARY_SPC or TC", node.id, "xyz"[k]),
              "leave out one of the two");
        return false;
      }
    Group& mine = motions_of_[static_cast<std::size_t>(i)];
    for (const std::size_t other : mine)
      if (const std::string why = clash(motions_[other], motion); !why.empty()) {
        error(motion, "DOF",
              fmt::format("of particle {}, {} {}", node.id, deck_.place(motions_[other].card), why),
              "let one end (DEATH) before the other starts (BIRTH), or leave it out");
        return false;
      }
    mine.push_back(motions_.size() - 1);
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  const SphSettings& settings_;
  std::span<const ImagePlane> planes_;
  Diagnostics& diagnostics_;
  std::vector<Index> particle_of_node_;
  std::vector<PrescribedMotion> motions_;
  std::vector<Group> motions_of_;  ///< of each particle
};

}  // namespace

bool add_prescribed_particles(const std::vector<PrescribedMotion>& motions, const Deck& deck,
                              const Model& model, const SphSettings& settings,
                              std::span<const ImagePlane> planes, World& world, Diagnostics& diagnostics) {
  bool any = false;
  for (const PrescribedMotion& motion : motions) any = any || motion.part < 0;
  if (!any) return false;
  Builder builder(deck, model, settings, planes, diagnostics);
  for (const PrescribedMotion& motion : motions)
    if (motion.part < 0) builder.add(motion);
  if (!builder.any() || !diagnostics.ok()) return false;
  world.passes.add(builder.finish(world));
  return true;
}

}  // namespace courant
