#include "elements/stiffness_damping.hpp"
#include "elements/element_cards.hpp"

#include <fmt/format.h>

#include <cmath>

#include "keyword/registry.hpp"
#include "laws/objective.hpp"

namespace courant {

namespace {

struct DampingPartStiffness : DampingPartStiffnessFields {
  bool of_sets() const { return name == 1; }
};

using S = DampingPartStiffness;

const RegisterKeyword<S> damping_part_stiffness_keyword{damping_part_stiffness_table()};

class StiffnessReader {
 public:
  StiffnessReader(const Deck& deck, const Model& model, const std::vector<std::shared_ptr<StrengthLaw>>& laws,
                  const std::vector<bool>& by_pressure, Diagnostics& diagnostics)
      : deck_(deck), model_(model), laws_(laws), by_pressure_(by_pressure), diagnostics_(diagnostics) {
    coef_.assign(model.parts.size(), 0);
    seen_.assign(model.parts.size(), false);
  }
  void add(const S& card) {
    if (card.coef >= 1)
      return error(card, "COEF",
                   fmt::format("expected a fraction of critical damping below 1, got {:g}", card.coef),
                   "0.01 to 0.25 is usual; minus a time is beta of Rayleigh");
    if (card.of_sets()) {
      const auto set = model_.part_sets.find(card.pid);
      if (set == model_.part_sets.end())
        return error(card, "PID", fmt::format("part set {} does not exist", card.pid),
                     "define it with *SET_PART");
      for (const Index part : set->second) take(card, static_cast<std::size_t>(part));
      return;
    }
    const auto part = model_.part_of_id.find(card.pid);
    if (part == model_.part_of_id.end())
      return error(card, "PID", fmt::format("part {} does not exist", card.pid), "define it with *PART");
    take(card, static_cast<std::size_t>(part->second));
  }
  std::vector<Real> finish() { return std::move(coef_); }

 private:
  void take(const S& card, std::size_t part) {
    const Id id = model_.parts[part].id;
    if (model_.parts[part].rigid)
      return deck_.warning(diagnostics_, card, "PID",
                           fmt::format("part {} is rigid: damping by stiffness does nothing to it", id));
    if (model_.parts[part].null)
      return deck_.warning(
          diagnostics_, card, "PID",
          fmt::format("part {} is of *MAT_NULL: damping by stiffness does nothing to it", id));
    if (!laws_[part] && model_.parts[part].has_beam)
      return error(card, "PID",
                   fmt::format("the cables or discrete beams of part {} know no damping by stiffness", id),
                   "*MAT_066 to _068 have dampers; *DAMPING_PART_MASS or *DAMPING_GLOBAL damp cables");
    if (!laws_[part])
      return error(card, "PID", fmt::format("part {} has no solids, shells or beams that deform", id),
                   "name parts of elements with a material of strength");
    if (by_pressure_[part])
      return error(
          card, "PID",
          fmt::format("the pressure of part {} is that of an equation of state, or of nodes (ELFORM 13), "
                      "which know no damping by stiffness",
                      id),
          "*CONTROL_BULK_VISCOSITY damps its waves");
    if (laws_[part]->axes())
      return error(
          card, "PID",
          fmt::format("the material of part {} has directions, whose stiffness damping does not know", id),
          "*DAMPING_PART_MASS or *DAMPING_GLOBAL damp it");
    if (seen_[part])
      return error(card, "PID", fmt::format("part {} is damped twice", id), "name each part once");
    seen_[part] = true;
    coef_[part] = card.coef;
  }
  void error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  const Deck& deck_;
  const Model& model_;
  const std::vector<std::shared_ptr<StrengthLaw>>& laws_;
  const std::vector<bool>& by_pressure_;
  Diagnostics& diagnostics_;
  std::vector<Real> coef_;
  std::vector<bool> seen_;
};

}  // namespace

/// A fraction has no unit, beta has.
std::string convert_beta(DampingPartStiffnessFields& card, const Conversion& conversion) {
  if (card.coef < 0) card.coef *= conversion.units.time;
  return {};
}

std::vector<Real> stiffness_damping(const Deck& deck, const Model& model,
                                    const std::vector<std::shared_ptr<StrengthLaw>>& laws,
                                    const std::vector<bool>& by_pressure, Diagnostics& diagnostics) {
  StiffnessReader reader(deck, model, laws, by_pressure, diagnostics);
  for (const S& card : deck.all<S>()) reader.add(card);
  return reader.finish();
}

std::vector<FrequencyRange> stress_ranges(const Deck& deck, const Model& model,
                                          const std::vector<std::shared_ptr<StrengthLaw>>& laws,
                                          const std::vector<bool>& by_pressure, Diagnostics& diagnostics) {
  const auto why_not = [&](std::size_t part) -> std::string {
    if (model.parts[part].null) return "*MAT_NULL has no elastic stiffness";
    if (!laws[part]) return "it has no solids, shells or beams with a material of strength";
    if (by_pressure[part]) return "its pressure is that of an equation of state, or of nodes (ELFORM 13)";
    if (laws[part]->axes()) return "its material has directions, whose stiffness damping does not know";
    return {};
  };
  return frequency_ranges(deck, model, true, why_not, diagnostics);
}

Real damped_share(Real beta, Real undamped) {
  const Real z = beta / undamped;
  return 1 / (std::sqrt(1 + z * z) + z);
}

Real stiffened_share(const FrequencyRange& range) {
  return range.any() ? 1 / std::sqrt(1 + range.sum()) : 1;
}

StiffnessDamping::StiffnessDamping(Real coef, FrequencyRange range, const ElementGroup& group, int points,
                                   int tensors)
    : coef_(coef),
      range_(std::move(range)),
      beta_(group.fields.add<Real>({.name = "stiffness_damping_time", .dimension = "T"})),
      damped_(
          group.fields.add<Real>({.name = "damped_stress", .dimension = "M/LT2", .components = 6 * points})) {
  if (tensors > 0)
    damping_ =
        &group.fields.add<Real>({.name = "damping_stress", .dimension = "M/LT2", .components = 6 * tensors});
  const int of_mechanisms = 6 * std::max(points, tensors) * static_cast<int>(range_.time.size());
  if (range_.any())
    mechanisms_ = &group.fields.add<Real>(
        {.name = "stress_of_mechanisms", .dimension = "M/LT2", .components = of_mechanisms});
  beta_.fill(coef < 0 ? -coef : 0);  // > 0: nothing in the first evaluation, which finds the steps
}

void StiffnessDamping::declare(Accesses& a) const {
  a.updates(beta_).updates(damped_);
  if (damping_) a.updates(*damping_);
  if (mechanisms_) a.updates(*mechanisms_);
}

void StiffnessDamping::turn_mechanisms(int point, Index e, const Vec& half_turn) const {
  for (std::size_t k = 0; k < range_.time.size(); ++k)
    turn_tensor(half_turn[0], half_turn[1], half_turn[2], mechanism(point, k, 0, e),
                mechanism(point, k, 1, e), mechanism(point, k, 2, e), mechanism(point, k, 3, e),
                mechanism(point, k, 4, e), mechanism(point, k, 5, e));
}

Real StiffnessDamping::damping_stress(int point, int component, Index e, Real elastic_rate,
                                      const FrequencyRange::Step& step, Real dt) const {
  Real sum = beta_[e] * elastic_rate;
  for (std::size_t k = 0; k < range_.time.size(); ++k) {
    Real& s = mechanism(point, k, component, e);
    s = step.left[k] * s + range_.share[k] * step.mean[k] * dt * elastic_rate;
    sum += s;
  }
  return sum;
}

void StiffnessDamping::add(const StrengthLaw& law, int point, const PointBlock& points,
                           const SolidBlock& of) const {
  const FrequencyRange::Step step = range_.step(points.dt);
  const Real G = law.shear_modulus(), lambda = law.bulk_modulus() - 2.0 / 3 * G;
  for (Index i = 0; i < points.count; ++i) {
    const Index e = of.begin + i;
    Real old[6], D[6];
    for (int k = 0; k < 6; ++k) {
      old[k] = damping_->data(6 * point + k)[e];
      D[k] = points.rate[static_cast<std::size_t>(k)][i];
    }
    turn_tensor(of.half_turn[0][i], of.half_turn[1][i], of.half_turn[2][i], old[0], old[1], old[2], old[3],
                old[4], old[5]);
    const Real power =
        old[0] * D[0] + old[1] * D[1] + old[2] * D[2] + 2 * (old[3] * D[3] + old[4] * D[4] + old[5] * D[5]);
    of.work[i] += 0.5 * points.dt * of.volume[i] * power;
    turn_mechanisms(point, e, {of.half_turn[0][i], of.half_turn[1][i], of.half_turn[2][i]});
    const Real pressure = lambda * (D[0] + D[1] + D[2]);
    for (int k = 0; k < 6; ++k) {
      const Real s = damping_stress(point, k, e, (k < 3 ? pressure : 0) + 2 * G * D[k], step, points.dt);
      damping_->data(6 * point + k)[e] = s;
      damped_.data(k)[e] = points.stress[static_cast<std::size_t>(k)][i] + s;
    }
  }
}

void StiffnessDamping::add_in_plane(const StrengthLaw& law, int point, const PointBlock& points,
                                    Index begin) const {
  const FrequencyRange::Step step = range_.step(points.dt);
  const Real G = law.shear_modulus(), K = law.bulk_modulus();
  const Real along = 4 * G * (3 * K + G) / (3 * K + 4 * G);  // E/(1 - nu^2)
  const Real across = along - 2 * G;                         // nu E/(1 - nu^2)
  for (Index i = 0; i < points.count; ++i) {
    const auto D = [&](std::size_t k) { return points.rate[k][i]; };
    const Real s[6] = {along * D(0) + across * D(1),
                       along * D(1) + across * D(0),
                       0,
                       2 * G * D(3),
                       2 * G * D(4),
                       2 * G * D(5)};
    for (int k = 0; k < 6; ++k)
      damped(point, k)[begin + i] = points.stress[static_cast<std::size_t>(k)][i] +
                                    damping_stress(point, k, begin + i, s[k], step, points.dt);
  }
}

void StiffnessDamping::shorten(Index begin, Index count, const Real* undamped, Real* step_limit) const {
  for (Index i = 0; i < count; ++i) {
    Real& beta = beta_[begin + i];
    beta = coef_ > 0 ? coef_ * undamped[i] : -coef_;
    if (undamped[i] > 0) step_limit[i] *= damped_share(beta, undamped[i]);
    step_limit[i] *= stiffened_share(range_);
  }
}

}  // namespace courant
