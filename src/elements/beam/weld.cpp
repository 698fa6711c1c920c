#include "elements/beam/weld.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace courant {

bool WeldStrength::fails() const {
  return std::any_of(most.begin(), most.end(), [](Real one) { return one > 0; });
}

Real WeldStrength::used(const SectionForces& forces) const {
  Real sum = 0;
  for (std::size_t k = 0; k < most.size(); ++k) {
    if (!(most[k] > 0)) continue;
    const Real share = (k == 0 ? std::max(forces[k], Real(0)) : forces[k]) / most[k];
    sum += share * share;
  }
  return sum;
}

WeldStrength weld_strength(const MatSpotweld& card) {
  return {
      .most = {card.nrr, card.mrr, card.mss, card.mtt, card.nrs, card.nrt}, .filter = card.nf, .dt = card.dt};
}

WeldSections::WeldSections(const WeldStrength& strength, ElementGroup& group)
    : strength_(strength),
      forces_(group.fields.add<Real>({.name = "weld_forces", .dimension = "-", .components = 6})),
      failure_time_(group.fields.add<Real>({.name = "failure_time", .dimension = "T"})) {
  if (strength.filter < 2 || !strength.fails()) return;
  kept_ = &group.fields.add<Real>(
      {.name = "weld_forces_kept", .dimension = "-", .components = 6 * strength.filter});
  count_ = &group.fields.add<Index>({.name = "weld_forces_count", .dimension = "-"});
}

void WeldSections::declare(Accesses& a) const {
  a.updates(forces_).updates(failure_time_);
  if (kept_) a.updates(*kept_).updates(*count_);
}

SectionForces WeldSections::forces(Index e) const {
  SectionForces out;
  for (int k = 0; k < 6; ++k) out[static_cast<std::size_t>(k)] = forces_.data(k)[e];
  return out;
}

WeldForce WeldSections::report(Index e, Id id, Real length) const {
  const SectionForces f = forces(e);
  return {.id = id,
          .axial = f[0],
          .shear = std::hypot(f[4], f[5]),
          .moment = std::hypot(f[2], f[3]),
          .torsion = f[1],
          .length = length,
          .failure_time = failure_time(e)};
}

SectionForces WeldSections::mean(Index e, const SectionForces& forces) {
  const Index at = (*count_)[e]++ % strength_.filter;
  const Index have = std::min<Index>((*count_)[e], strength_.filter);
  SectionForces sum{};
  for (int k = 0; k < 6; ++k) {
    kept_->data(6 * static_cast<int>(at) + k)[e] = forces[static_cast<std::size_t>(k)];
    for (Index step = 0; step < have; ++step)
      sum[static_cast<std::size_t>(k)] +=
          kept_->data(6 * static_cast<int>(step) + k)[e] / static_cast<Real>(have);
  }
  return sum;
}

std::string WeldSections::look(Index e, const SectionForces& forces, Real t) {
  for (int k = 0; k < 6; ++k) forces_.data(k)[e] = forces[static_cast<std::size_t>(k)];
  if (!strength_.fails()) return {};
  const SectionForces compared = kept_ ? mean(e, forces) : forces;
  if (!(strength_.used(compared) >= 1)) return {};
  failed(e, t);
  std::string out = "section forces";
  const char* const names[] = {"Nrr", "Mrr", "Mss", "Mtt", "Nrs", "Nrt"};
  for (std::size_t k = 0; k < compared.size(); ++k)
    if (strength_.most[k] > 0) out += fmt::format(" {} {:.4g}", names[k], compared[k]);
  return out;
}

}  // namespace courant
