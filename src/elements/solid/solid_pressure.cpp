#include "elements/solid/solid_pressure.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

namespace {

/// Hooke's law in all but the sound speed, which is that of the reference density.
class Linear : public StrengthLaw {
 public:
  Linear(Real density, Real K, Real G) : K_(K), G_(G) { ro = density; }
  Real bulk_modulus() const override { return K_; }
  Real shear_modulus() const override { return G_; }
  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      const Real trace = block.rate[0][i] + block.rate[1][i] + block.rate[2][i];
      for (std::size_t k = 0; k < 6; ++k)
        block.stress[k][i] +=
            block.dt * (2 * G_ * block.rate[k][i] + (k < 3 ? (K_ - 2 * G_ / 3) * trace : 0));
    }
    keep_stiffness(block, sound_speed());
  }

 private:
  Real K_, G_;
};

}  // namespace

Real SolidPressure::initial_pressure() const {
  return std::max(eos_->pressure(1 / eos_->V0 - 1, eos_->E0), law_->pressure_cutoff());
}

Real SolidPressure::bulk_modulus() const {
  const Real mu = 1 / eos_->V0 - 1;
  return law_->ro * (1 + mu) * eos_->sound_speed2(law_->ro, mu, eos_->E0);
}

Real SolidPressure::initial_sound_speed() const {
  return std::sqrt((bulk_modulus() + 4 * law_->shear_modulus() / 3) * eos_->V0 / law_->ro);
}

void SolidPressure::evaluate(const ElementBlock& block, const SolidState& state, const Real* energy,
                             Real* memory, SolidScratch& scratch, Scratch& own) const {
  const Real* mu = scratch.compression;
  eos_->evaluate({block.count, mu, own.A, own.dA, own.B, own.dB, memory ? memory + block.begin : nullptr});
  const Real shear = 4 * law_->shear_modulus() / 3;
  const Real *V0 = state.V0 + block.begin, *rho0 = state.rho0 + block.begin;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real E = energy[block.begin + i] / V0[i], v = 1 / (1 + mu[i]);
    const Real slope = own.dA[i] + own.dB[i] * E + own.B[i] * (own.A[i] + own.B[i] * E) * v * v;
    own.energy[i] = E;
    own.half_dv[i] = scratch.opened[1][i] / V0[i];
    // of the density that inertia belongs to, which mass scaling makes another than that of the law
    scratch.sound_speed[i] = std::sqrt((std::max(slope, Real(0)) + shear * v) / rho0[i]);
  }
  std::fill_n(own.least_pressure, block.count, law_->pressure_cutoff());
}

void SolidPressure::split(const ElementBlock& block, const SolidState& state, const Real* energy,
                          Real* memory, SolidScratch& scratch, Scratch& own) const {
  evaluate(block, state, energy, memory, scratch, own);
  Real *xx = state.stress[0] + block.begin, *yy = state.stress[1] + block.begin,
       *zz = state.stress[2] + block.begin;
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    const Real p = -(xx[i] + yy[i] + zz[i]) / 3;
    xx[i] += p, yy[i] += p, zz[i] += p;
  }
}

void SolidPressure::begin(const ElementBlock& block, const SolidControl& control, const SolidState& state,
                          const Means& means, SolidScratch& scratch, Scratch& own) const {
  evaluate(block, state, means.energy, means.memory, scratch, own);
  for (Index i = 0; i < block.count; ++i) {
    scratch.work[i] -= means.pressure[i] * scratch.opened[0][i];
    scratch.rate[0][i] = means.trace[i], scratch.rate[1][i] = scratch.rate[2][i] = 0;  // of which q is made
  }
  loops_.viscosity(block, control, state, scratch);
  predict(block, state, scratch, own);
  std::copy_n(scratch.work, block.count, own.counted);
}

SolidPressure::Faults SolidPressure::complete(const ElementBlock& block, const SolidState& state,
                                              Real* pressure, Real* sound_speed, SolidScratch& scratch,
                                              Scratch& own) const {
  const Real *V0 = state.V0 + block.begin, *mu = scratch.compression;
  Faults found;
  for (Index i = 0; i < block.count; ++i) {
    const Real E = own.energy[i] + (scratch.work[i] - own.counted[i]) / V0[i];
    pressure[i] = finish(i, E, mu[i], own, sound_speed[i], found);
    scratch.work[i] -= pressure[i] * scratch.opened[1][i];
    if (!(mu[i] < eos_->mu_limit()) && found.beyond < 0) found.beyond = block.begin + i;
  }
  return found;
}

Real SolidPressure::finish(Index i, Real E, Real mu, const Scratch& own, Real& sound_speed,
                           Faults& found) const {
  const Real p = std::max((own.A[i] + own.B[i] * E) / (1 + own.B[i] * own.half_dv[i]), own.least_pressure[i]);
  E -= own.half_dv[i] * p;
  const Real v = 1 / (1 + mu);
  // where tension is cut off, its work does not soften
  const Real working = p > own.least_pressure[i] ? own.B[i] * p * v * v : 0;
  const Real c2 = (own.dA[i] + own.dB[i] * E + working) / law_->ro;
  sound_speed = std::sqrt(std::max(c2, Real(0)) + sound_speed * sound_speed);
  found.without_speed += c2 < 0;
  return p;
}

void SolidPressure::predict(const ElementBlock& block, const SolidState& state, const SolidScratch& scratch,
                            Scratch& own) const {
  const Real* V0 = state.V0 + block.begin;
  const Real cutoff = law_->pressure_cutoff();
#pragma omp simd
  for (Index i = 0; i < block.count; ++i) {
    own.energy[i] += scratch.work[i] / V0[i];
    own.pressure[i] =
        std::max((own.A[i] + own.B[i] * own.energy[i]) / (1 + own.B[i] * own.half_dv[i]), cutoff);
  }
}

SolidPressure::Faults SolidPressure::complete(const ElementBlock& block, const SolidState& state,
                                              SolidScratch& scratch, Scratch& own) const {
  Real* const* stress = state.stress;
  const Real *V0 = state.V0 + block.begin, *mu = scratch.compression;
  Faults found;
  for (Index i = 0; i < block.count; ++i) {
    const Index e = block.begin + i;
    Real power = 0;
    for (int k = 0; k < 6; ++k) power += (k < 3 ? 1 : 2) * stress[k][e] * scratch.rate[k][i];
    const Real E = own.energy[i] + 0.5 * block.dt * scratch.middle_volume[i] * power / V0[i];
    const Real p = finish(i, E, mu[i], own, scratch.sound_speed[i], found);
    for (int k = 0; k < 3; ++k) stress[k][e] -= p;
    if (!(mu[i] < eos_->mu_limit()) && found.beyond < 0) found.beyond = e;
  }
  return found;
}

std::shared_ptr<StrengthLaw> linear_response(const SolidPressure& pressure, const StrengthLaw& law) {
  return std::make_shared<Linear>(law.ro, pressure.bulk_modulus(), law.shear_modulus());
}

}  // namespace courant
