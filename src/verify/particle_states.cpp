#include "verify/particle_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {
namespace {

enum Column {
  x_,
  y_,
  z_,
  vx_,
  vy_,
  vz_,
  speed_,
  p_,
  rho_,
  h_column,
  m_,
  V_,
  e_,
  part_,
  id_,
  active_,
  t_column
};

/// The arrays of a field file that scalars come from.
struct Source {
  Column column;
  const char* array;
};
constexpr Source sources[] = {{p_, "pressure"},        {rho_, "density"}, {m_, "mass"},
                              {e_, "internal_energy"}, {part_, "part"},   {id_, "id"},
                              {active_, "active"}};

}  // namespace

StateTable::StateTable(const StateFiles& state, const Used& used_, bool all, Diagnostics& diagnostics) {
  Used used = used_;
  used[active_] = true;
  std::vector<ParticleArray> arrays;
  for (const Source& source : sources)
    if (all || used[source.column]) arrays.push_back({source.array, 1, !used[source.column]});
  const bool velocity = used[vx_] || used[vy_] || used[vz_] || used[speed_];
  if (all || velocity) arrays.push_back({"velocity", 3, !velocity});
  const auto frame = read_particles(state, false, arrays, diagnostics);
  if (!frame) return;
  n_ = frame->size();
  t_ = frame->t;
  fill(*frame);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    for (std::size_t i = 0; i < columns_[k].size(); ++i) {
      if (std::isfinite(columns_[k][i])) continue;
      diagnostics.error(
          {state.particles.string()},
          fmt::format("{} of a particle is not finite at t = {:.6g}", particle_variables()[k], t_));
      return;
    }
  }
}

void StateTable::fill(const ParticleFrame& frame) {
  columns_[x_] = frame.x, columns_[y_] = frame.y, columns_[z_] = frame.z;
  columns_[h_column] = frame.h, columns_[V_] = frame.V;
  volume_ = frame.V, h_ = frame.h;
  for (const Source& source : sources)
    if (const auto found = frame.arrays.find(source.array); found != frame.arrays.end())
      columns_[source.column] = found->second;
  if (const auto v = frame.arrays.find("velocity"); v != frame.arrays.end()) {
    for (std::size_t i = 0; i < n_; ++i) {
      const Real* a = &v->second[3 * i];
      for (int k = 0; k < 3; ++k) columns_[static_cast<std::size_t>(vx_ + k)].push_back(a[k]);
      columns_[speed_].push_back(std::hypot(a[0], a[1], a[2]));
    }
  }
}

std::array<Real, particle_variable_count> StateTable::row(std::size_t i) const {
  std::array<Real, particle_variable_count> out{};
  for (std::size_t k = 0; k < out.size(); ++k)
    if (!columns_[k].empty()) out[k] = columns_[k][i];
  out[t_column] = t_;
  return out;
}

void note_used(const Formula& formula, StateTable::Used& used) {
  for (std::size_t k = 0; k < used.size(); ++k) used[k] = used[k] || formula.uses(k);
}

Selection::Selection(const std::string& where, const Formula& of, const Variables& variables)
    : where_(where.empty() ? "1" : where, particle_variables(), variables),
      all_(where_.uses(active_) || of.uses(active_)) {}

bool Selection::counts(const StateTable& state, std::size_t i, const Real* row) {
  return (all_ || state.active(i)) && where_(row) > 0;
}

Real reduce(const std::string& how, std::vector<Real> values, const std::vector<Real>& volumes) {
  if (how == "count") return static_cast<Real>(values.size());
  Real sum = 0, weighted = 0, volume = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += values[i];
    weighted += volumes[i] * values[i];
    volume += volumes[i];
  }
  if (how == "sum") return sum;
  if (values.empty()) return std::numeric_limits<Real>::quiet_NaN();
  if (how == "mean") return weighted / volume;
  std::sort(values.begin(), values.end());
  if (how == "min") return values.front();
  if (how == "max") return values.back();
  const Real share = how == "median" ? 0.5 : how == "p01" ? 0.01 : 0.99;
  const Real place = share * static_cast<Real>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<Real>(below)) * (values[above] - values[below]);
}

int nearest_state(const std::vector<StateFiles>& states, Real t) {
  int best = -1;
  Real gap = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i > 0) gap = std::max(gap, states[i].t - states[i - 1].t);
    if (best < 0 || std::abs(states[i].t - t) < std::abs(states[static_cast<std::size_t>(best)].t - t))
      best = static_cast<int>(i);
  }
  if (best < 0) return -1;
  const Real slack = std::max(gap / 2, 1e-9 * std::abs(t));
  return std::abs(states[static_cast<std::size_t>(best)].t - t) <= slack ? best : -1;
}

}  // namespace courant
