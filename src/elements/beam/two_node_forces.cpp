#include "elements/beam/two_node_forces.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace courant {

TwoNodeForces::TwoNodeForces(ElementGroup& group, Id part_id, Real tssfac, std::string what)
    : group_(group),
      energy_(add("internal_energy", "ML2/T2", 1, true)),
      steps_(at(group.size())),
      part_id_(part_id),
      tssfac_(tssfac),
      what_(std::move(what)) {}

void TwoNodeForces::may_fail(Field<Real>& force, ElementOptions& options, World& world) {
  erosion_ = std::make_shared<Erosion>(FailureRules{}, group_, 1,
                                       Erosion::Energies{&energy_, nullptr, nullptr}, world);
  erosion_->vanishes(force);
  options.eroding.push_back(erosion_);
}

void TwoNodeForces::block(World& world, const Clock& clock, Index begin, Index end) {
  if (erosion_) erosion_->begin_block(begin, end - begin);
  for (Index e = begin; e < end; ++e)
    if (!dead(e)) advance(world, clock, begin, e);  // of the others who judges takes the forces
  if (!erosion_) return;
  std::array<Real, block_size> unused{};
  erosion_->judge(begin, end - begin, tssfac_, steps_.data() + begin, unused.data(), nullptr,
                  {group_, begin, clock.dt_old});
}

TimeLimit::Limit TwoNodeForces::limit(const World&, const Clock&) {
  const Index least = least_of(steps_.data(), group_.size());
  return {tssfac_ * steps_[at(least)], fmt::format("{} {} of part {}", what_, group_.id[least], part_id_)};
}

void TwoNodeForces::report_part(const World& world, std::vector<PartSums>& parts) const {
  PartSums& out = parts[at(group_.part)];
  out.internal += total();
  for (Index e = 0; e < group_.size(); ++e) {
    out.mass += group_.mass[e];
    if (dead(e)) out.eroded_internal += energy_[e];
    for (int c = 0; c < 2; ++c) {
      const Index n = group_.node.data(c)[e];
      const Vec v = world.nodes.v.vec(n);
      out.momentum += group_.mass[e] / 2 * v;
      out.kinetic += group_.mass[e] / 4 * v.squaredNorm();
      out.kinetic += turning_energy(e, n);
    }
  }
}

Real TwoNodeForces::total() const {
  return sum(group_.size(), [&](Index e) { return dead(e) ? 0 : energy_[e]; });
}

}  // namespace courant
