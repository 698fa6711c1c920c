#include "elements/solid/full_points.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "elements/stiffness_damping.hpp"

namespace courant {

FullPoints::FullPoints(const SolidFormulation& formulation, const ElementGroup& group, const StrengthLaw& law)
    : group_(group),
      points_(formulation.points),
      loops_(formulation.several()),
      stress_(group.fields.add<Real>(
          {.name = "stress_of_points", .dimension = "M/LT2", .components = 6 * points_})) {
  for (const HistoryVariable& h : law.history()) {
    history_.push_back(&group.fields.add<Real>(
        {.name = h.name + "_of_points", .dimension = h.dimension, .components = points_ * h.components}));
    if (h.is_tensor()) tensors_.push_back(history_.back());
  }
}

void FullPoints::declare(Accesses& a) const {
  a.updates(stress_);
  if (pressure_) a.updates(*pressure_);
  for (const Field<Real>* h : history_) a.updates(*h);
}

PointBlock FullPoints::at_point(int p, const ElementBlock& block, PointScratch& scratch, SolidState& state,
                                std::array<Real*, most_history>& history) const {
  PointBlock at;
  at.count = block.count, at.dt = block.dt;
  for (int k = 0; k < 6; ++k) {
    const auto c = static_cast<std::size_t>(k);
    state.stress[k] = stress_.data(6 * p + k);
    at.rate[c] = scratch.rate[k], at.stress[c] = state.stress[k] + block.begin;
    for (std::size_t t = 0; t < tensors_.size(); ++t) state.tensor[t][k] = tensors_[t]->data(6 * p + k);
  }
  std::size_t numbers = 0;
  for (Field<Real>* h : history_) {
    const int n = h->info().components / points_;
    for (int k = 0; k < n; ++k) history[numbers++] = h->data(n * p + k) + block.begin;
  }
  at.history = {history.data(), numbers};
  at.compression = scratch.compression, at.sound_speed = scratch.sound_speed;
  return at;
}

void FullPoints::measure(const BlockOfSolids& of, const ElementBlock& block, Real sound_speed,
                         PointScratch& scratch) const {
  loops_.gather(block, of.mesh, of.state, scratch);
  loops_.begin(block, false, scratch);
  std::fill_n(scratch.fastest, block.count, sound_speed);
  loops_.forces(block, of.control, of.state, scratch);
}

StableStep FullPoints::advance(const BlockOfSolids& of, const ElementBlock& block, PointScratch& scratch,
                               const Between& between) const {
  loops_.gather(block, of.mesh, of.state, scratch);
  between.gathered();
  loops_.begin(block, false, scratch);
  SolidState state = of.state;
  state.tensors = static_cast<int>(tensors_.size());
  std::array<Real*, most_history> history{};
  for (int p = 0; p < points_; ++p) {
    PointBlock at = at_point(p, block, scratch, state, history);
    loops_.strain(block, p, of.control, state, scratch);
    of.law.update(at);
    between.answered(p, at);
    if (damping_) {
      damping_->add(of.law, p, at,
                    {block.begin,
                     {scratch.half_turn[0], scratch.half_turn[1], scratch.half_turn[2]},
                     scratch.weight,
                     scratch.work});
      for (int k = 0; k < 6; ++k) state.stress[k] = damping_->damped(0, k);
    }
    loops_.add(block, p, of.control, state, scratch);
  }
  return loops_.forces(block, of.control, of.state, scratch);
}

void FullPoints::reset() {
  stress_.fill(0);
  for (Field<Real>* h : history_) h->fill(0);
  if (pressure_) pressure_->fill(0);
}

void FullPoints::start_pressure(Real p) {
  pressure_ = &group_.fields.add<Real>({.name = "pressure_of_points", .dimension = "M/LT2"});
  pressure_->fill(p);
  for (int point = 0; point < points_; ++point)
    for (int k = 0; k < 3; ++k) std::fill_n(stress_.data(6 * point + k), group_.size(), -p);
}

void FullPoints::set_tensor(std::size_t number, Index e, const std::array<Real, 6>& tensor) {
  for (int p = 0; p < points_; ++p)
    for (int k = 0; k < 6; ++k) history_[number]->data(6 * p + k)[e] = tensor[static_cast<std::size_t>(k)];
}

void FullPoints::set_number(std::size_t number, const Field<Real>& value) {
  for (int p = 0; p < points_; ++p) std::copy_n(value.data(), group_.size(), history_[number]->data(p));
}

void FullPoints::average(Field<Real>& stress, const std::vector<Field<Real>*>& history) const {
  const auto mean = [&](const Field<Real>& from, Field<Real>& to) {
    const int n = to.info().components;
    for (int k = 0; k < n; ++k)
      for (Index e = 0; e < group_.size(); ++e) {
        Real sum = 0;
        for (int p = 0; p < points_; ++p) sum += from.data(n * p + k)[e];
        to.data(k)[e] = sum / points_;
      }
  };
  mean(stress_, stress);
  for (std::size_t h = 0; h < history_.size(); ++h) mean(*history_[h], *history[h]);
}

std::vector<PointReport> FullPoints::report(Index e, bool all_points, const PointStrains* strains) const {
  std::vector<PointReport> out(points_);
  for (std::size_t p = 0; p < out.size(); ++p) {
    const int at = static_cast<int>(p);
    if (strains) out[p].strain = strains->at(at, e);
    for (int k = 0; k < 6; ++k) out[p].stress[static_cast<std::size_t>(k)] = stress_.data(6 * at + k)[e];
    for (const Field<Real>* h : history_) {
      const int n = h->info().components / points_;
      for (int k = 0; k < n; ++k) out[p].history.push_back(h->data(n * at + k)[e]);
    }
  }
  if (!all_points) out = {mean_of(out)};
  return out;
}

std::vector<Field<Real>*> FullPoints::of_deleted() const {
  std::vector<Field<Real>*> out{&stress_};
  if (pressure_) out.push_back(pressure_);
  for (Field<Real>* h : history_)
    if (h->info().components == 6 * points_) out.push_back(h);
  return out;
}

}  // namespace courant
