#include "time/guard.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/parallel.hpp"
#include "time/step.hpp"

namespace courant {

namespace {

/// Total energy above what came in, as a multiple of it, that no run survives: sound ones stay within a few
/// per cent.
constexpr Real most_energy = 10;
/// Of the sum of all energies: differences below are round-off.
constexpr Real round_off = 1e-9;

/// What there is of energy now, but potential.
Real held_by(const EnergyLedger& e) {
  return std::abs(e.kinetic) + std::abs(e.internal) + std::abs(e.contact) + std::abs(e.hourglass) +
         std::abs(e.bulk_viscosity);
}

bool is_finite(Real a) {
  return a - a == 0;
}

bool all_finite(const Real* a, Index begin, Index end) {
  int bad = 0;
#pragma omp simd reduction(| : bad)
  for (Index i = begin; i < end; ++i) bad |= a[i] - a[i] == 0 ? 0 : 1;
  return bad == 0;
}

struct Checked {
  const Real* values;
  Index count;
};

/// All numbers that a set of fields holds for its first `count` entities.
std::vector<Checked> numbers_of(const FieldSet& fields, Index count) {
  std::vector<Checked> out;
  for (const auto& field : fields.all())
    if (const auto* reals = dynamic_cast<const Field<Real>*>(field.get()))
      for (int k = 0; k < reals->info().components; ++k) out.push_back({reals->data(k), count});
  return out;
}

bool all_finite(const std::vector<Checked>& numbers, Index count) {
  return reduce(
      count, char(true),
      [&](Index begin, Index end) {
        for (const Checked& a : numbers)
          if (!all_finite(a.values, begin, std::min(end, a.count))) return char(false);
        return char(true);
      },
      [](char a, char b) { return char(a && b); });
}

/// "velocity, force": the quantities of an entity that are no finite numbers, with the first such value.
std::string broken_quantities(const FieldSet& fields, Index i, Real& first) {
  std::string names;
  for (const auto& field : fields.all()) {
    const auto* reals = dynamic_cast<const Field<Real>*>(field.get());
    if (!reals) continue;
    for (int k = 0; k < reals->info().components; ++k) {
      if (is_finite(reals->data(k)[i])) continue;
      if (names.empty()) first = reals->data(k)[i];
      names += (names.empty() ? "" : ", ") + reals->info().name;
      break;
    }
  }
  return names;
}

[[noreturn]] void stop_for(const std::string& who, const std::string& names, Real value, const Vec& x,
                           const Clock& clock) {
  throw RunError(
      fmt::format("{} has values that are no finite numbers: {} ({}) at time {:.6g}, cycle {}, x = "
                  "({:.5g}, {:.5g}, {:.5g})",
                  who, names, value, clock.t, clock.cycle, x[0], x[1], x[2]),
      StopCause::not_finite);
}

Real size_of(const EnergyLedger& e) {
  return held_by(e) + std::abs(e.potential) + std::abs(e.dissipated) + std::abs(e.external_work);
}

void note(PartRange& range, Real speed, Real density, Id id, Real t) {
  if (speed > range.speed.value || !range.seen) range.speed = {speed, id, t};
  if (density < range.density_low.value || !range.seen) range.density_low = {density, id, t};
  if (density > range.density_high.value || !range.seen) range.density_high = {density, id, t};
  range.seen = true;
}

}  // namespace

void Guard::look(World& world, const Clock& clock) {
  stop_for_numbers(world, clock);
  note_ranges(world, clock);
  sample_energy(world, clock);
  if (clock.cycle == 0) start(world.energy);
  note_peak(world.energy);
  stop_for_energy(world.energy, clock);
  if (clock.cycle == 0) world.energy.initial = world.energy.total();
}

void Guard::stop_for_numbers(const World& world, const Clock& clock) {
  const Particles& p = world.particles;
  std::vector<Checked> numbers = numbers_of(p.fields, p.active);
  for (const Field<Real>* field : {&p.x, &p.v, &p.h})  // the halo has places and velocities only
    for (int k = 0; k < field->info().components; ++k) numbers.push_back({field->data(k), p.moving});
  if (!all_finite(numbers, p.moving)) {
    for (Index i = 0; i < p.moving; ++i) {
      Real value = 0;
      const std::string names = broken_quantities(p.fields, i, value);
      if (!names.empty())
        stop_for(fmt::format("particle {} of part {}", p.id[i], world.part_id(i)), names, value, p.x.vec(i),
                 clock);
    }
  }
  const Nodes& n = world.nodes;
  if (all_finite(numbers_of(n.fields, n.size()), n.size())) return;
  for (Index k = 0; k < n.size(); ++k) {
    Real value = 0;
    const std::string names = broken_quantities(n.fields, k, value);
    if (!names.empty()) stop_for(fmt::format("node {}", n.id[k]), names, value, n.x.vec(k), clock);
  }
}

void Guard::note_ranges(const World& world, const Clock& clock) {
  const Particles& p = world.particles;
  const auto values = [&](Index i) {
    return std::pair(p.v.vec(i).norm(), p.rho[i] / ranges_[p.part[i]].rho0);
  };
  beaten_.assign(block_count(p.active), 0);
  for_each_block(p.active, [&](Index begin, Index end) {
    bool beaten = false;
    for (Index i = begin; i < end; ++i) {
      const PartRange& r = ranges_[p.part[i]];
      const auto [speed, density] = values(i);
      beaten |= !r.seen | (speed > r.speed.value) | (density < r.density_low.value) |
                (density > r.density_high.value);
    }
    beaten_[begin / block_size] = beaten;
  });
  for (Index b = 0; b < block_count(p.active); ++b) {  // few blocks: a range is seldom beaten
    if (!beaten_[b]) continue;
    for (Index i = b * block_size; i < std::min(p.active, (b + 1) * block_size); ++i) {
      const auto [speed, density] = values(i);
      if (is_finite(speed) && is_finite(density)) note(ranges_[p.part[i]], speed, density, p.id[i], clock.t);
    }
  }
}

namespace {

void keep_extreme(const std::string& name, Extreme& e, Archive& archive) {
  const Archive::Group inside(archive, name);
  archive("value", e.value);
  archive("particle", e.particle);
  archive("t", e.t);
}

}  // namespace

void Guard::keep(Archive& archive) {
  archive("initial_size", initial_size_);
  archive("initial_potential", initial_potential_);
  archive("initial_internal", initial_internal_);
  archive("entered", entered_);
  for (std::size_t k = 0; k < ranges_.size(); ++k) {
    PartRange& r = ranges_[k];
    const Archive::Group inside(archive, fmt::format("part {}", r.part));
    archive("c0", r.c0);
    archive("seen", r.seen);
    keep_extreme("speed", r.speed, archive);
    keep_extreme("density_low", r.density_low, archive);
    keep_extreme("density_high", r.density_high, archive);
  }
}

void Guard::start(EnergyLedger& e) {
  e.peak = least_energy_;
  e.most_internal = std::abs(e.internal);
  initial_size_ = held_by(e);
  initial_potential_ = e.potential;
  initial_internal_ = e.internal;
}

void Guard::note_peak(EnergyLedger& e) const {
  e.most_internal = std::max(e.most_internal, std::abs(e.internal));
  e.peak = std::max(e.peak, held_by(e) + std::max(initial_potential_ - e.potential, Real(0)));
}

// What came in: the energy at the start, work and inflow, and what fell or expanded. Dissipation is part of
// throughput but brings nothing in: without it an instability cannot hide behind its own friction.
void Guard::stop_for_energy(const EnergyLedger& e, const Clock& clock) {
  for (const auto& [name, value] : {std::pair{"energy", e.total()},
                                    {"external work", e.external_work},
                                    {"sum of all work", e.throughput}})
    if (!is_finite(value))
      throw RunError(fmt::format("the {} became {} at time {:.6g}, cycle {}: the run is unstable", name,
                                 value, clock.t, clock.cycle),
                     StopCause::not_finite);
  if (clock.cycle == 0 || clock.cycle % interval != 0) return;  // other checks are those before outputs
  const Real now = least_energy_ + initial_size_ + std::max(e.throughput - e.dissipated, Real(0)) +
                   std::max(initial_potential_ - e.potential, Real(0)) +
                   std::max(initial_internal_ - e.internal, Real(0));
  entered_ = std::max(entered_, now);  // what fell may have risen again
  const Real entered = entered_;
  if (e.unexplained() > most_energy * entered + round_off * size_of(e))
    throw RunError(fmt::format("the energy ran away: {:.4g} [ML2/T2] came from nowhere by time {:.6g}, cycle "
                               "{}, where {:.4g} entered; kinetic {:.4g}, internal {:.4g}, contact {:.4g}",
                               e.residual(), clock.t, clock.cycle, entered, e.kinetic, e.internal, e.contact),
                   StopCause::energy);
  const Real change = energy_ratio_change(e);
  if (endeng_ > 0 && std::abs(change) > endeng_)
    throw RunError(fmt::format("the energy ratio changed by {:.4g} %, more than ENDENG = {:.4g} %, by time "
                               "{:.6g}, cycle {}",
                               change, endeng_, clock.t, clock.cycle),
                   StopCause::energy);
}

Real energy_ratio_change(const EnergyLedger& e) {
  const Real expected = e.initial + e.external_work - e.potential;  // where heights count from cancels
  const Real change = e.unexplained();
  if (std::abs(change) <= round_off * size_of(e)) return 0;
  return 100 * change / expected;
}

}  // namespace courant
