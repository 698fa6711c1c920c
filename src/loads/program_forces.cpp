// *COURANT_PROGRAM_FORCES: forces and velocities that a program sets while the run goes on.
#include "loads/program_forces.hpp"

#include <cmath>

#include <fmt/format.h>

#include "extension/builders.hpp"
#include "keyword/registry.hpp"
#include "loads/load_cards.hpp"
#include "loads/loads.hpp"
#include "loads/middle_velocity.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

const RegisterKeyword<ProgramForcesCard> program_forces_keyword{courant_program_forces_table()};

class ChangedPoints : public PointChanges, public Force, public EnergyTerm {
 public:
  explicit ChangedPoints(Points points)
      : points_(points),
        // a program that goes on from a restart file sets its forces again
        wanted_(points_.set->add<Real>(of("wanted_program_force"))),
        force_(points_.set->add<Real>(of("program_force"))) {}

  std::string name() const override { return "forces of a program on " + points_.name(); }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.updates(*points_.f).reads(wanted_).writes(force_);
  }
  void start(World&, const Clock&) override { any_ = set_; }
  void block(World&, const Clock&, Index begin, Index end) override {
    if (!any_) return;
    for (Index i = begin; i < end; ++i) {
      force_.set(i, wanted_.vec(i));
      points_.f->add(i, force_.vec(i));
    }
  }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    ledger.external_work += work_, ledger.throughput += moved_;
    work_ = moved_ = 0;
    if (!any_) return;
    const MiddleVelocity v(points_, clock);
    const auto work = [&](Index i) -> Real { return force_.vec(i).dot(v(i)) * clock.dt_mean(); };
    const Index n = loaded_points(points_, world);
    ledger.external_work += sum(n, work);
    ledger.throughput += sum(n, [&](Index i) { return std::abs(work(i)); });
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

  std::string why_not(const World& world, Index i) const override {
    const bool of_particles = points_.set == &world.particles.fields;
    if (of_particles && i >= world.particles.active)
      return fmt::format("particle {} is outside of the computational box", (*points_.id)[i]);
    if (points_.follow && (*points_.follow)[i] != 0)
      return fmt::format("node {} goes with a rigid body or a face: change that", (*points_.id)[i]);
    return {};
  }
  void set_force(Index i, const Vec& force) override {
    wanted_.set(i, force);
    set_ = true;
  }
  std::string set_velocity(World& world, Index i, const Vec& v) override {
    const Field<Index>* driven = points_.driven().find(*points_.set);
    if (driven && (*driven)[i] != 0)
      return fmt::format("the motion of point {} is prescribed", (*points_.id)[i]);
    const Field<Index>* held = points_.held().find(*points_.set);
    const Vec before = points_.v->vec(i);
    Vec now = v;
    for (int k = 0; k < 3; ++k)
      if ((held && (*held)[i] & (1 << k)) || (k == 2 && world.dim == 2)) now[k] = before[k];
    points_.v->set(i, now);
    const Real gained = 0.5 * (*points_.m)[i] * (now.squaredNorm() - before.squaredNorm());
    work_ += gained, moved_ += std::abs(gained);
    return {};
  }

 private:
  static FieldInfo of(const char* name) {
    return {.name = name, .dimension = "ML/T2", .components = 3, .restart = false};
  }
  Points points_;
  Field<Real>& wanted_;        ///< by the program, since the last time level
  Field<Real>& force_;         ///< that acts in this step
  bool any_ = false;           ///< of the forces is in this step's sum
  bool set_ = false;           ///< by the program so far
  Real work_ = 0, moved_ = 0;  ///< by changes of velocities since the last entry of the ledger [ML2/T2]
};

std::shared_ptr<PointChanges> changes_of(World& world, Points points) {
  return world.passes.add(std::make_shared<ChangedPoints>(points));
}

void let_a_program_push(const Deck& deck, World& world, ProgramForces& forces) {
  if (deck.all<ProgramForcesCard>().empty()) return;
  if (world.particles.size() > 0) forces.on_particles = changes_of(world, points_of(world.particles));
  if (!world.groups.empty()) forces.on_nodes = changes_of(world, points_of(world.nodes));
}

const RegisterBuilder program(BuildPhase::checks, "forces of a program", let_a_program_push);

}  // namespace

}  // namespace courant
