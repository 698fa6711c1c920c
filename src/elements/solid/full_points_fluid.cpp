// Solids with several points and one pressure, from an equation of state.
#include <algorithm>
#include <array>
#include <cmath>

#include "elements/solid/full_points.hpp"

namespace courant {

namespace {

/// Of the points of a block, until the pressure is known.
struct PointRates {
  std::array<std::array<std::array<Real, block_size>, 6>, PointLoops::most_points> rate;
  std::array<Real, block_size> cutoff;  ///< of the point at work [M/LT2]
};

/// Their deviator: the pressure of an equation of state is separate.
void strip(const PointBlock& at) {
  for (Index i = 0; i < at.count; ++i) {
    const Real mean = (at.stress[0][i] + at.stress[1][i] + at.stress[2][i]) / 3;
    for (std::size_t k = 0; k < 3; ++k) at.stress[k][i] -= mean;
  }
}

}  // namespace

// As SolidPressure has it of one point, the deviators' work being that of all of them. Where one point bears
// less tension (spall), the element does.
StableStep FullPoints::advance(const BlockOfSolids& of, Fluid& fluid, const ElementBlock& block,
                               PointScratch& scratch, const Between& between) const {
  loops_.gather(block, of.mesh, of.state, scratch);
  between.gathered();
  loops_.begin(block, true, scratch);
  SolidPressure::Scratch own;
  Real* p = pressure_->data() + block.begin;
  fluid.law.begin(block, of.control, of.state, {p, fluid.energy, fluid.memory, scratch.mean_trace}, scratch,
                  own);
  SolidState state = of.state;
  state.tensors = static_cast<int>(tensors_.size());
  std::array<Real*, most_history> history{};
  PointRates kept;
  for (int point = 0; point < points_; ++point) {
    PointBlock at = at_point(point, block, scratch, state, history);
    strip(at);
    loops_.strain(block, point, of.control, state, scratch);
    for (std::size_t k = 0; k < 6; ++k)
      std::copy_n(at.rate[k], block.count, kept.rate[static_cast<std::size_t>(point)][k].begin());
    kept.cutoff.fill(of.law.pressure_cutoff());
    at.pressure = own.pressure, at.energy = own.energy, at.least_pressure = kept.cutoff.data();
    of.law.update(at);
    for (Index i = 0; i < block.count; ++i)
      own.least_pressure[i] = std::max(own.least_pressure[i], kept.cutoff[static_cast<std::size_t>(i)]);
    loops_.add(block, point, of.control, state, scratch);
  }
  fluid.found = fluid.law.complete(block, of.state, p, scratch.fastest, scratch, own);
  for (Index i = 0; i < block.count; ++i)  // with the volume that is in the mean of it
    scratch.pressure[i] += p[i] * of.state.V0[block.begin + i] / (1 + scratch.compression[i]);
  for (int point = 0; point < points_; ++point) {
    PointBlock at = at_point(point, block, scratch, state, history);
    for (std::size_t k = 0; k < 6; ++k) at.rate[k] = kept.rate[static_cast<std::size_t>(point)][k].data();
    for (std::size_t k = 0; k < 3; ++k)
      for (Index i = 0; i < block.count; ++i) at.stress[k][i] -= p[i];
    std::copy_n(scratch.fastest, block.count, scratch.sound_speed);
    between.answered(point, at);
  }
  std::copy_n(scratch.sound_speed, block.count, scratch.fastest);
  return loops_.forces(block, of.control, of.state, scratch);
}

}  // namespace courant
