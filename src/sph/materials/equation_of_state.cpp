#include "sph/materials/equation_of_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/run_error.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

void stop_for_density(const World& world, const Clock& clock, Index i, Real rho_limit) {
  const ReadsForMessage unchecked;
  const Particles& p = world.particles;
  const Vec x = p.x.vec(i);
  const std::string beyond =
      p.rho[i] >= rho_limit && std::isfinite(p.rho[i])
          ? fmt::format(": its equation of state ends at {:.4g}, where the pressure becomes infinite",
                        rho_limit)
          : std::string();
  throw RunError(
      fmt::format("density of particle {} of part {} became {:.4g} [M/L3] at time {:.6g}, cycle "
                  "{}, x = ({:.5g}, {:.5g}, {:.5g}){}",
                  p.id[i], world.part_id(i), p.rho[i], clock.t, clock.cycle, x[0], x[1], x[2], beyond),
      std::isfinite(p.rho[i]) ? StopCause::density : StopCause::not_finite);
}

EquationOfState::EquationOfState(std::shared_ptr<const EosLaw> law, EosParts parts,
                                 std::vector<const Field<Real>*> heat, World& world)
    : law_(std::move(law)),
      parts_(std::move(parts)),
      heat_(std::move(heat)),
      reference_volume_(shared_fields::reference_volume.add(world.particles.fields)),
      mu_limit_(law_->mu_limit()) {
  same_for_all_ = parts_.all_parts;
  for (std::size_t k = 1; k < parts_.rho0.size(); ++k)
    same_for_all_ = same_for_all_ && parts_.rho0[k] == parts_.rho0[0] && parts_.pc[k] == parts_.pc[0];
  if (!law_->memory()) return;
  memory_ = &world.particles.fields.add<Real>({.name = law_->memory(), .dimension = "-", .output = true});
  for (Index i = 0; i < world.particles.size(); ++i)
    if (parts_.mine[world.particles.part[i]]) (*memory_)[i] = law_->memory_at_start();
}

void EquationOfState::declare(const World& world, Accesses& a) const {
  const Particles& p = world.particles;
  a.reads(p.drhodt).updates(p.rho).updates(p.p).updates(p.E).updates(p.c);
  if (!same_for_all_) a.reads(p.part);
  if (memory_) a.updates(*memory_);
  if (!law_->uses_energy()) return;
  if (parts_.burnt) a.reads(*parts_.burnt);
  if (parts_.least_pressure) a.reads_before(*parts_.least_pressure);
  if (heat_.empty()) return;
  a.reads(reference_volume_);
  for (const Field<Real>* heat : heat_) a.reads_before(*heat);
}

void EquationOfState::block(World& world, const Clock& clock, Index begin, Index end) {
  EosFaults& found = found_[begin / block_size] = {};
  if (same_for_all_) return advance(world.particles, clock.dt_old, begin, end, 0, found);
  const Index* part = world.particles.part.data();
  for (Index i = begin, next = i; i < end; i = next) {  // particles of one part in a row
    while (next < end && part[next] == part[i]) ++next;
    if (parts_.mine[part[i]]) advance(world.particles, clock.dt_old, i, next, part[i], found);
  }
}

void EquationOfState::finish(World& world, const Clock& clock) {
  std::int64_t without_speed = 0;
  for (const EosFaults& found : found_) without_speed += found.without_speed;
  if (without_speed > 0) world.counters["sound_speed_clamped"] += without_speed;
  for (std::size_t b = 0; b < found_.size(); ++b) {
    if (found_[b].lowest > 0) continue;
    const ReadsForMessage unchecked;
    for (Index i = static_cast<Index>(b) * block_size; i < world.particles.active; ++i)
      if (parts_.mine[world.particles.part[i]] && !holds(world.particles, i))
        stop_for_density(world, clock, i, rho_limit(world.particles.part[i]));
  }
}

void EquationOfState::advance(Particles& p, Real dt, Index begin, Index end, Index part,
                              EosFaults& found) const {
  if (law_->uses_energy())
    advance_with_energy(p, dt, begin, end, part, found);
  else
    advance_without(p, dt, begin, end, part, found);
}

void EquationOfState::advance_with_energy(Particles& p, Real dt, Index begin, Index end, Index part,
                                          EosFaults& found) const {
  const Real rho0 = parts_.rho0[part], pc = parts_.pc[part], limit = rho_limit(part);
  std::array<Real, block_size> mu, dv, A, dA, B, dB;
  for (Index i = begin; i < end; ++i) {
    const Real v_old = rho0 / p.rho[i];
    p.rho[i] += p.drhodt[i] * dt;
    dv[i - begin] = rho0 / p.rho[i] - v_old, mu[i - begin] = p.rho[i] / rho0 - 1;
  }
  law_->evaluate({end - begin, mu.data(), A.data(), dA.data(), B.data(), dB.data(), memory(begin)});
  for (Index i = begin, k = 0; i < end; ++i, ++k) {
    Real E = p.E[i] - 0.5 * dv[k] * p.p[i];
    Real power = 0;
    for (const Field<Real>* heat : heat_) power += (*heat)[i];
    if (!heat_.empty() && reference_volume_[i] > 0) E += power * dt / reference_volume_[i];
    const Real least = parts_.least_pressure ? (*parts_.least_pressure)[i] : pc;
    const Real burnt = parts_.burnt ? (*parts_.burnt)[i] : 1;
    const Real pressure = std::max(burnt * (A[k] + B[k] * E) / (1 + 0.5 * burnt * B[k] * dv[k]), least);
    E -= 0.5 * dv[k] * pressure;
    p.p[i] = pressure;
    p.E[i] = E;
    // where tension is cut off, its work does not soften
    const Real working = pressure > least ? B[k] * pressure / ((1 + mu[k]) * (1 + mu[k])) : 0;
    const Real c2 = (dA[k] + dB[k] * E + working) / rho0;
    p.c[i] = std::sqrt(std::max(c2, Real(0)));
    found.without_speed += c2 < 0;
    if (!(p.rho[i] >= found.lowest * rho0)) found.lowest = p.rho[i] / rho0;  // also where it is not a number
    if (!(p.rho[i] < limit)) found.lowest = 0;
  }
}

void EquationOfState::advance_without(Particles& p, Real dt, Index begin, Index end, Index part,
                                      EosFaults& found) const {
  const Real rho0 = parts_.rho0[part];
  std::array<Real, block_size> mu, half_dv, A, dA;
  loops_.compress(p.drhodt.data(), dt, rho0, p.rho.data(), mu.data(), half_dv.data(), begin, end);
  law_->evaluate({end - begin, mu.data(), A.data(), dA.data(), nullptr, nullptr, memory(begin)});
  Index without_speed = 0;
#pragma omp simd reduction(+ : without_speed)
  for (Index k = 0; k < end - begin; ++k) without_speed += dA[k] < 0;
  found.without_speed += without_speed;
  loops_.load({A.data(), dA.data(), half_dv.data(), rho0, parts_.pc[part]}, p.p.data(), p.E.data(),
              p.c.data(), begin, end);
  const ParticleLoops::Range range = loops_.range(p.rho.data(), begin, end);
  if (range.broken || !(range.most < rho_limit(part)))
    found.lowest = 0;
  else
    found.lowest = std::min(found.lowest, range.least / rho0);
}

}  // namespace courant
