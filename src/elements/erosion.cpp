#include "elements/erosion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/eigenvalues.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

constexpr Real infinite = FailureRules::never;

Matrix tensor_at(const std::array<Real*, 6>& s, Index i) {
  Matrix out;
  out << s[0][i], s[3][i], s[5][i], s[3][i], s[1][i], s[4][i], s[5][i], s[4][i], s[2][i];
  return out;
}

Real largest_eigenvalue(const Matrix& M) {
  return -least_eigenvalue(Matrix(-M));
}

/// sqrt(factor dev:dev)
Real effective(const Matrix& M, Real factor) {
  const Matrix dev = M - M.trace() / 3 * Matrix::Identity();
  return std::sqrt(factor * dev.squaredNorm());
}

/// Which criteria hold, in words.
class CriteriaMet {
 public:
  void above(Real value, Real limit, const char* what) {
    if (limit < infinite && value >= limit) tell(value, what);
  }
  void below(Real value, Real limit, const char* what) {
    if (limit > -infinite && value <= limit) tell(value, what);
  }
  int count = 0;
  std::string text;

 private:
  void tell(Real value, const char* what) {
    text += fmt::format("{}{} {:.4g}", count++ == 0 ? "" : ", ", what, value);
  }
};

}  // namespace

bool FailureRules::measures_strain() const {
  return most_strain < never || least_strain > -never || shear_strain < never || effective_strain < never ||
         expansion < never || contraction > -never;
}

bool FailureRules::of_points() const {
  return law_limit < never || law_time < never || measures_strain() || most_pressure < never ||
         least_pressure > -never || principal_stress < never || mises < never || plastic_strain < never ||
         impulse < never || time < never || !deaths.empty();
}

int history_at(const StrengthLaw& law, const std::string& variable) {
  int at = 0;
  for (const HistoryVariable& h : law.history()) {
    if (h.name == variable) return at;
    at += h.components;
  }
  return -1;
}

CornerPush::CornerPush(const ElementGroup& group, Index begin, Real dt) : dt(dt) {
  for (int k = 0; k < 3 * group.corners(); ++k) {
    force[static_cast<std::size_t>(k)] = group.corner_force->data(k) + begin;
    if (group.corner_moment) moment[static_cast<std::size_t>(k)] = group.corner_moment->data(k) + begin;
  }
}

Erosion::Erosion(const FailureRules& rules, const ElementGroup& group, int points, Energies energies,
                 World& world)
    : rules_(rules),
      group_(group),
      points_(points),
      energies_(energies),
      v_(&world.nodes.v),
      w_(shared_fields::angular_velocity.find(world.nodes.fields)),
      eroded_(shared_fields::eroded.add(group.fields)),
      failed_(group.fields.add<Index>(
          {.name = "failed_points", .dimension = "-", .components = points, .may_begin_later = true})) {
  if (rules.measures_strain())
    strain_ =
        &group.fields.add<Real>({.name = "strain_of_points", .dimension = "-", .components = 6 * points});
  if (rules.impulse < infinite)
    impulse_ = &group.fields.add<Real>({.name = "impulse", .dimension = "M2/L2T3", .components = points});
  if (rules.least_step.ratio > 0)
    first_step_ = &group.fields.add<Real>({.name = "first_step", .dimension = "T"});
  if (strain_) vanishes(*strain_);
  shared_fields::eroded.add(world.segments.fields);
  const auto blocks = static_cast<std::size_t>(block_count(group.size()));
  dead_.assign(blocks, 0), newly_.resize(blocks), why_.resize(blocks);
  kept_.resize(static_cast<std::size_t>(group.size()));
  if (!rules.deaths.empty()) death_.assign(static_cast<std::size_t>(group.size()), infinite);
  for (Index e = 0; e < group.size() && !death_.empty(); ++e)
    if (const auto death = rules.deaths.find(group.id[e]); death != rules.deaths.end())
      death_[static_cast<std::size_t>(e)] = death->second;
}

void Erosion::declare(const World&, Accesses& a) const {
  a.updates(eroded_).updates(failed_).reads(*v_, Reach::others);
  if (w_) a.reads(*w_, Reach::others);
  if (strain_) a.updates(*strain_);
  if (impulse_) a.updates(*impulse_);
  if (first_step_) a.updates(*first_step_);
}

void Erosion::declare_booking(Accesses& a) const {
  a.reads(eroded_, Reach::others).reads(group_.id, Reach::others).reads(group_.mass, Reach::others);
  for (const Field<Real>* energy : {energies_.internal, energies_.bulk_viscosity, energies_.hourglass})
    if (energy) a.reads(*energy, Reach::others);
  if (group_.segment) a.reads(*group_.segment, Reach::others);
  for (Field<Real>* field : weakening_) a.updates(*field);
  a.reads(group_.node, Reach::others);
}

void Erosion::begin_block(Index begin, Index count) {
  why_[static_cast<std::size_t>(begin / block_size)].clear();
  for (Index e = begin; e < begin + count; ++e) {
    const auto of = [&](const Field<Real>* energy) { return energy ? (*energy)[e] : 0; };
    kept_[static_cast<std::size_t>(e)] = {of(energies_.internal), of(energies_.bulk_viscosity),
                                          of(energies_.hourglass)};
    if (dead(e)) clear(e);
  }
}

void Erosion::clear(Index e) const {
  for (Field<Real>* field : vanishing_)
    for (int k = 0; k < field->info().components; ++k) field->data(k)[e] = 0;
}

void Erosion::weaken(Index e) const {
  if (dead(e)) return;
  for (Field<Real>* field : weakening_)
    if ((*field)[e] == 0) (*field)[e] = 1;  // laws may count on from there
}

std::string Erosion::failure_of(const FailingPoints& p, Index i) const {
  CriteriaMet held;
  const Matrix s = tensor_at(p.stress, i);
  const Real pressure = -s.trace() / 3;
  held.above(pressure, rules_.most_pressure, "pressure");
  held.below(pressure, rules_.least_pressure, "pressure");
  if (rules_.principal_stress < infinite)
    held.above(largest_eigenvalue(s), rules_.principal_stress, "principal stress");
  if (rules_.mises < infinite) held.above(effective(s, 1.5), rules_.mises, "effective stress");
  if (p.plastic) held.above(p.plastic[i], rules_.plastic_strain, "plastic strain");
  if (strain_) {
    std::array<Real*, 6> at{};
    for (int k = 0; k < 6; ++k) at[static_cast<std::size_t>(k)] = strain_->data(6 * p.point + k) + p.begin;
    const Matrix strain = tensor_at(at, i);
    const Real most = largest_eigenvalue(strain), least = least_eigenvalue(strain);
    held.above(most, rules_.most_strain, "principal strain");
    held.below(least, rules_.least_strain, "principal strain");
    held.above(0.5 * (most - least), rules_.shear_strain, "shear strain");
    held.above(effective(strain, 2.0 / 3), rules_.effective_strain, "effective strain");
    held.above(strain.trace(), rules_.expansion, "volume strain");
    held.below(strain.trace(), rules_.contraction, "volume strain");
  }
  if (impulse_) held.above(impulse_->data(p.point)[p.begin + i], rules_.impulse, "impulse");
  held.above(p.t, rules_.time, "time");
  return held.count >= rules_.conditions ? held.text : std::string();
}

void Erosion::look(const FailingPoints& p) {
  Index* failed = failed_.data(p.point) + p.begin;
  if (strain_)
    for (int k = 0; k < 6; ++k) {
      Real* strain = strain_->data(6 * p.point + k) + p.begin;
      const Real* rate = p.rate[static_cast<std::size_t>(k)];
      for (Index i = 0; i < p.count; ++i) strain[i] += dead(p.begin + i) ? 0 : rate[i] * p.dt;
    }
  if (impulse_)
    for (Index i = 0; i < p.count; ++i) {
      const Real over = std::max(largest_eigenvalue(tensor_at(p.stress, i)) - rules_.threshold, Real(0));
      impulse_->data(p.point)[p.begin + i] += over * over * p.dt;
    }
  FailureRules of_card = rules_;
  of_card.law_limit = of_card.law_time = infinite;
  const bool has_card = of_card.of_points();
  const Real law_limit = p.law_limit < infinite ? p.law_limit : rules_.law_limit;
  for (Index i = 0; i < p.count; ++i) {
    if (dead(p.begin + i)) continue;
    if ((p.by_law && p.by_law[i] >= law_limit) || p.t >= rules_.law_time) failed[i] |= by_law;
    if (has_card && !(failed[i] & by_card)) {
      std::string why = failure_of(p, i);
      if (!death_.empty() && p.t >= death_[static_cast<std::size_t>(p.begin + i)])
        why = fmt::format("time {:.4g}", p.t);
      if (!why.empty()) {
        failed[i] |= by_card;
        why_[static_cast<std::size_t>(p.begin / block_size)].push_back({p.begin + i, std::move(why)});
      }
    }
    if (failed[i] == 0) continue;
    for (Real* stress : p.stress) stress[i] = 0;
  }
}

std::string Erosion::why_by_law() const {
  std::string variable = rules_.law_variable, out;
  std::replace(variable.begin(), variable.end(), '_', ' ');
  if (rules_.law_limit < infinite) out = fmt::format("{} {:.4g}", variable, rules_.law_limit);
  if (rules_.law_time < infinite)
    out += fmt::format("{}time {:.4g}", out.empty() ? "" : " or ", rules_.law_time);
  return out;
}

/// Empty: the step of the element is large enough.
std::string Erosion::why_by_step(Index e, Real step) const {
  if (!rules_.of_step()) return {};
  if (first_step_ && (*first_step_)[e] == 0) (*first_step_)[e] = step;
  const bool short_one =
      step < rules_.least_step.step || (first_step_ && step < rules_.least_step.ratio * (*first_step_)[e]);
  return short_one ? fmt::format("step {:.4g}", step) : std::string();
}

Index Erosion::points_needed() const {
  if (rules_.points > 0) return std::min<Index>(rules_.points, points_);
  return std::max<Index>(1, static_cast<Index>(std::ceil(-0.01 * rules_.points * points_ - 1e-9)));
}

void Erosion::strike(Index begin, Index e, std::string why) {
  eroded_[e] = 1;
  ++dead_[static_cast<std::size_t>(begin / block_size)];
  newly_[static_cast<std::size_t>(begin / block_size)].push_back({e, std::move(why)});
  clear(e);
}

void Erosion::judge(Index begin, Index count, Real share, Real* step_limit, Real* wave_time, Real* volume,
                    const CornerPush& push) {
  const auto block = static_cast<std::size_t>(begin / block_size);
  for (Index i = 0; i < count; ++i) {
    const Index e = begin + i;
    if (dead(e)) continue;
    Index of_law = 0, of_card = 0;
    for (int p = 0; p < points_; ++p)
      of_law += (failed_.data(p)[e] & by_law) != 0, of_card += (failed_.data(p)[e] & by_card) != 0;
    const bool inside_out = turned_inside_out(volume, i);
    if (of_card >= points_needed()) {
      const auto why = std::find_if(why_[block].begin(), why_[block].end(),
                                    [&](const Failed& one) { return one.element == e; });
      strike(begin, e, why == why_[block].end() ? "failed points" : why->why);
    } else if (of_law >= (rules_.law_points > 0 ? rules_.law_points : points_)) {
      strike(begin, e, why_by_law());
    } else if (volume && (volume[i] > rules_.most_volume || volume[i] < rules_.least_volume) && !inside_out) {
      strike(begin, e, fmt::format("volume {:.4g} of the reference", volume[i]));
    } else if (inside_out) {
      strike(begin, e, "it turned inside out");
    } else if (rules_.small_step && share * step_limit[i] < least_step_) {
      strike(begin, e, fmt::format("step {:.4g}", share * step_limit[i]));
    } else if (std::string why = why_by_step(e, share * step_limit[i]); !why.empty()) {
      strike(begin, e, std::move(why));
    }
  }
  for (const Failed& failed : newly_[block]) {
    const Index e = failed.element;
    take_back(e, e - begin, push);
    if (turned_inside_out(volume, e - begin) || !std::isfinite(energy_of(e)))
      put_back(e, kept_[static_cast<std::size_t>(e)]);
  }
  if (dead_[block] == 0) return;
  for (Index i = 0; i < count; ++i) {
    const Index e = begin + i;
    if (!dead(e)) continue;
    step_limit[i] = wave_time[i] = infinite;
    if (volume) volume[i] = 1;
    clear(e);
    for (int k = 0; group_.corner_force && k < 3 * group_.corners(); ++k) {
      group_.corner_force->data(k)[e] = 0;
      if (group_.corner_moment) group_.corner_moment->data(k)[e] = 0;
    }
  }
}

std::vector<Erosion::Failed> Erosion::take_failed() {
  std::vector<Failed> out;
  for (std::vector<Failed>& newly : newly_) {
    out.insert(out.end(), newly.begin(), newly.end());
    newly.clear();
  }
  return out;
}

void Erosion::put_back(Index e, const std::array<Real, 3>& kept) const {
  Field<Real>* const fields[] = {energies_.internal, energies_.bulk_viscosity, energies_.hourglass};
  for (std::size_t k = 0; k < kept.size(); ++k)
    if (fields[k]) (*fields[k])[e] = kept[k];
}

// The old forces push through the first half of the step, the new ones would through the second.
void Erosion::take_back(Index e, Index i, const CornerPush& push) const {
  Real power = 0;
  for (int c = 0; c < group_.corners(); ++c) {
    const Index n = group_.node.data(c)[e];
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(3 * c + k);
      power += push.force[at][i] * v_->data(k)[n];
      if (w_ && push.moment[at]) power += push.moment[at][i] * w_->data(k)[n];
    }
  }
  (*energies_.internal)[e] += 0.5 * push.dt * power;
}

Real Erosion::energy_of(Index e) const {
  Real sum = 0;
  for (const Field<Real>* energy : {energies_.internal, energies_.bulk_viscosity, energies_.hourglass})
    if (energy) sum += (*energy)[e];
  return sum;
}

bool Erosion::all_dead() const {
  Index count = 0;
  for (const Index dead : dead_) count += dead;
  return count == group_.size();
}

void Erosion::loaded() {
  for (std::size_t b = 0; b < dead_.size(); ++b) dead_[b] = 0;
  for (Index e = 0; e < group_.size(); ++e) dead_[static_cast<std::size_t>(e / block_size)] += dead(e);
}

}  // namespace courant
