#include "elements/solid/nodal_pressure.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "state/pass.hpp"

namespace courant {

namespace {

Real mean_stress(const SolidState& state, Index e) {
  return (state.stress[0][e] + state.stress[1][e] + state.stress[2][e]) / 3;
}

/// Half a step's work of the mean stress through `opened`, less that of the trace of D, which is counted.
void add_work(const ElementBlock& block, Index i, Real trace, const SolidState& state, SolidScratch& scratch,
              const NodalPressure::Scratch& own) {
  scratch.work[i] += 0.5 * mean_stress(state, block.begin + i) *
                     (own.opened[i] - block.dt * scratch.middle_volume[i] * trace);
}

}  // namespace

NodalPressure::NodalPressure(const ElementGroup& group, Real relative_volume, World& world)
    : group_(group),
      first_(static_cast<std::size_t>(world.nodes.size()) + 1, 0),
      volume_(group.fields.add<Real>({.name = "volumes", .dimension = "L3", .components = 2})),
      counted_(group.fields.add<Real>({.name = "counted_volume", .dimension = "L3"})),
      pressure_(
          group.fields.add<Real>({.name = "pressure_times_volume", .dimension = "ML2/T2", .restart = false})),
      ratio_(world.nodes.fields.add<Real>({.name = fmt::format("volume_ratio of {}", group.fields.name()),
                                           .dimension = "-",
                                           .components = 2,
                                           .restart = false})),
      nodal_pressure_(
          world.nodes.fields.add<Real>({.name = fmt::format("pressure of {}", group.fields.name()),
                                        .dimension = "M/LT2",
                                        .restart = false})) {
  const auto n = static_cast<std::size_t>(group.size());
  for (auto& corner : corner_) corner.resize(n);
  for (Index e = 0; e < group.size(); ++e) {
    counted_[e] = group.V0[e];
    volume_.data(0)[e] = volume_.data(1)[e] = relative_volume * group.V0[e];
    int found = 0;
    for (int c = 0; c < group.corners(); ++c) {
      if (!group.is_first(e, c)) continue;
      if (found == corners) throw std::logic_error("pressures of nodes are for tetrahedra");
      corner_[found++][static_cast<std::size_t>(e)] = c;
    }
    if (found != corners) throw std::logic_error("pressures of nodes are for tetrahedra");
  }
  const auto node = [&](Index e, int c) {
    return static_cast<std::size_t>(group_.node.data(corner_[c][static_cast<std::size_t>(e)])[e]);
  };
  for (Index e = 0; e < group.size(); ++e)
    for (int c = 0; c < corners; ++c) ++first_[node(e, c) + 1];
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  element_.resize(corners * n);
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (Index e = 0; e < group.size(); ++e)
    for (int c = 0; c < corners; ++c) element_[static_cast<std::size_t>(next[node(e, c)]++)] = e;
}

Real NodalPressure::sum_at(Index node, const Real* of_element) const {
  Real out = 0;
  for (Index k = first_[static_cast<std::size_t>(node)]; k < first_[static_cast<std::size_t>(node) + 1]; ++k)
    out += of_element[element_[static_cast<std::size_t>(k)]];
  return out;
}

Real NodalPressure::mean(Index e, const Real* of_node) const {
  Real out = 0;
  for (const auto& corner : corner_) out += of_node[group_.node.data(corner[static_cast<std::size_t>(e)])[e]];
  return out / corners;
}

Real NodalPressure::edges(const World& world, Index e, Vec b[3]) const {
  const auto place = [&](int c) {
    return world.nodes.x.vec(group_.node.data(corner_[c][static_cast<std::size_t>(e)])[e]);
  };
  const Vec start = place(0), r1 = place(1) - start, r2 = place(2) - start, r3 = place(3) - start;
  b[0] = r2.cross(r3), b[1] = r3.cross(r1), b[2] = r1.cross(r2);
  return r1.dot(b[0]);
}

void NodalPressure::declare(Accesses& a) const {
  a.reads(ratio_, Reach::others).updates(counted_).writes(pressure_);
}

void NodalPressure::strain(const ElementBlock& block, const SolidState& state, SolidScratch& scratch,
                           Scratch& own) const {
  for (Index i = 0; i < block.count; ++i) {
    const Index e = block.begin + i;
    const bool counts = counted_[e] > 0;
    const Real now = counts ? mean(e, ratio_.data(0)) : 1, before = counts ? mean(e, ratio_.data(1)) : 1;
    const Real trace = scratch.rate[0][i] + scratch.rate[1][i] + scratch.rate[2][i];
    const Real wanted = block.dt > 0 ? 2 * (now - before) / (block.dt * (now + before)) : 0;
    for (int k = 0; k < 3; ++k) scratch.rate[k][i] += (wanted - trace) / 3;
    scratch.compression[i] = 1 / now - 1;
    own.opened[i] = group_.V0[e] * (now - before);
    if (!state.heats) {
      add_work(block, i, trace, state, scratch, own);
      continue;
    }
    scratch.work[i] += mean_stress(state, e) * (0.5 * own.opened[i] - scratch.opened[0][i]);
    scratch.opened[0][i] = scratch.opened[1][i] = 0.5 * own.opened[i];
  }
}

void NodalPressure::work(const ElementBlock& block, const SolidState& state, SolidScratch& scratch,
                         const Scratch& own) const {
  for (Index i = 0; i < block.count; ++i) {
    const Real trace = scratch.rate[0][i] + scratch.rate[1][i] + scratch.rate[2][i];
    add_work(block, i, trace, state, scratch, own);
  }
}

void NodalPressure::keep(const ElementBlock& block, const SolidState& state, const Erosion* erosion) const {
  for (Index e = block.begin; e < block.begin + block.count; ++e) {
    if (erosion && erosion->dead(e)) counted_[e] = 0;
    pressure_[e] = counted_[e] * (state.viscous_pressure[e] - mean_stress(state, e));
  }
}

/// A pass on behalf of one part.
struct NodalPressure::Pass : Material {
  Pass(std::shared_ptr<NodalPressure> whose, const char* what, bool of_nodes)
      : of(std::move(whose)),
        name_(fmt::format("{} of {}", what, of->group_.fields.name())),
        of_nodes_(of_nodes) {}
  std::string name() const override { return name_; }
  const FieldSet& over(const World& world) const override {
    return of_nodes_ ? world.nodes.fields : of->group_.fields;
  }
  std::shared_ptr<NodalPressure> of;

 private:
  std::string name_;
  bool of_nodes_;
};

struct NodalPressure::Volumes : Pass {
  explicit Volumes(std::shared_ptr<NodalPressure> whose) : Pass(std::move(whose), "volumes", false) {}
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(of->group_.node);
    a.reads_before(of->counted_).updates(of->volume_);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    Real *now = of->volume_.data(0), *before = of->volume_.data(1);
    const Real* counts = of->counted_.data();
    Vec b[3];
    for (Index e = begin; e < end; ++e) {
      const bool alive = counts[e] > 0;
      before[e] = alive ? now[e] : 0, now[e] = alive ? of->edges(world, e, b) / 6 : 0;
    }
  }
};

struct NodalPressure::NodalVolumes : Pass {
  explicit NodalVolumes(std::shared_ptr<NodalPressure> whose)
      : Pass(std::move(whose), "volumes at nodes", true) {}
  void declare(const World&, Accesses& a) const override {
    a.reads(of->volume_, Reach::others).reads_before(of->counted_, Reach::others).writes(of->ratio_);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    const Real *now = of->volume_.data(0), *before = of->volume_.data(1), *V0 = of->counted_.data();
    for (Index n = begin; n < end; ++n) {
      const Real whole = of->sum_at(n, V0);
      of->ratio_.data(0)[n] = whole > 0 ? of->sum_at(n, now) / whole : 1;
      of->ratio_.data(1)[n] = whole > 0 ? of->sum_at(n, before) / whole : 1;
    }
  }
};

struct NodalPressure::NodalPressures : Pass {
  explicit NodalPressures(std::shared_ptr<NodalPressure> whose)
      : Pass(std::move(whose), "pressures at nodes", true) {}
  void declare(const World&, Accesses& a) const override {
    a.reads(of->pressure_, Reach::others).reads(of->counted_, Reach::others).writes(of->nodal_pressure_);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    const Real *pressure = of->pressure_.data(), *V0 = of->counted_.data();
    for (Index n = begin; n < end; ++n) {
      const Real whole = of->sum_at(n, V0);
      of->nodal_pressure_[n] = whole > 0 ? of->sum_at(n, pressure) / whole : 0;
    }
  }
};

/// What the means push the corners more than the pressures of the elements did.
struct NodalPressure::Push : Pass {
  explicit Push(std::shared_ptr<NodalPressure> whose) : Pass(std::move(whose), "means of pressures", false) {}
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.nodes.x, Reach::others).reads(of->group_.node).reads(of->nodal_pressure_, Reach::others);
    a.reads(of->pressure_).reads(of->counted_).updates(*of->group_.corner_force);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    const Real* V0 = of->counted_.data();
    Vec b[3];
    for (Index e = begin; e < end; ++e) {
      if (!(V0[e] > 0)) continue;
      of->edges(world, e, b);
      const Real more = (of->mean(e, of->nodal_pressure_.data()) - of->pressure_[e] / V0[e]) / 6;
      push(e, 0, -more * (b[0] + b[1] + b[2]));
      for (int c = 1; c < corners; ++c) push(e, c, more * b[c - 1]);
    }
  }
  void push(Index e, int c, const Vec& f) const {
    const int corner = of->corner_[c][static_cast<std::size_t>(e)];
    for (int k = 0; k < 3; ++k) of->group_.corner_force->data(3 * corner + k)[e] += f[k];
  }
};

std::shared_ptr<NodalPressure> NodalPressure::add(const ElementGroup& group, Real relative_volume,
                                                  World& world) {
  const auto of = std::make_shared<NodalPressure>(group, relative_volume, world);
  world.passes.add(std::make_shared<Volumes>(of));
  world.passes.add(std::make_shared<NodalVolumes>(of));
  world.passes.add(std::make_shared<NodalPressures>(of));
  world.passes.add(std::make_shared<Push>(of));
  return of;
}

}  // namespace courant
