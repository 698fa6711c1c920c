#include "laws/discrete/discrete_beam_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/definitions/named_curve.hpp"

namespace courant {

ForceCurve::ForceCurve(const Curve& curve)
    : pieces_(curve.abscissa, curve.ordinate), mirrored_(curve.abscissa[0] == 0 && curve.ordinate[0] == 0) {}

Real ForceCurve::operator()(Real x) const {
  return mirrored_ ? std::copysign(1, x) * pieces_(std::abs(x)) : pieces_(x);
}

Real ForceCurve::steepest(Real x, Real reach) const {
  const Real middle = mirrored_ ? std::abs(x) : x;
  return pieces_.steepest(mirrored_ ? std::max(middle - reach, Real(0)) : middle - reach, middle + reach);
}

// Piece by piece: |force| - k p = yield(before + p).
Real YieldCurve::flow(Real force, Real k, Real before) const {
  Real p = 0;
  for (std::size_t piece = piece_of(x_, before);; ++piece) {
    const Real slope = slope_of_piece(x_, y_, piece), at = before + p;
    const Real beyond = std::abs(force) - k * p - (y_[piece] + slope * (at - x_[piece]));
    if (!(beyond > 0)) return p;
    const Real more = beyond / (k + slope);
    if (piece + 2 == x_.size() || at + more <= x_[piece + 1]) return p + more;
    p = x_[piece + 1] - before;
  }
}

SpringAnswer BeamSpring::answer(const SpringMotion& m, Real* state) const {
  constexpr Real ahead = 2;  // stretches that the next step may reach, too
  SpringAnswer out{k * m.stretch + preload, k, c};
  if (!force.empty()) {
    out.force = force(m.stretch) + preload;
    out.stiffness = force.steepest(m.stretch, ahead * std::abs(m.change));
  } else if (!yield.empty()) {
    const Real trial = preload + state[0] + k * m.change;
    const Real p = yield.flow(trial, k, state[1]);
    out.force = trial - std::copysign(k * p, trial);
    state[0] = out.force - preload, state[1] += p;
  }
  if (damping.empty()) {
    out.force += c * m.rate;
  } else {
    out.force += damping(m.rate);
    out.damping = damping.steepest(m.rate, ahead * std::abs(m.rate));
  }
  return out;
}

std::string BeamLimits::failure(const SixOfBeam& forces, const SixOfBeam& displacements) const {
  const SixOfBeam none{};
  const auto used = [](const SixOfBeam& of, const SixOfBeam& most, const SixOfBeam& least) {
    Real sum = 0;
    for (std::size_t k = 0; k < of.size(); ++k)
      if (const Real limit = of[k] < 0 ? least[k] : most[k]; limit > 0)
        sum += of[k] / limit * (of[k] / limit);
    return sum;
  };
  if (const Real sum = used(forces, force, force); sum >= 1) return fmt::format("forces, {:.4g} of 1", sum);
  const Real sum =
      apart ? std::max(used(displacements, displacement, none), used(displacements, none, negative))
            : used(displacements, displacement, negative);
  if (sum >= 1) return fmt::format("displacements, {:.4g} of 1", sum);
  return {};
}

std::vector<DiscreteBeamKind>& discrete_beam_kinds() {
  static std::vector<DiscreteBeamKind> all;
  return all;
}

DiscreteBeamLaws find_discrete_beam_laws(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  DiscreteBeamLaws out;
  for (const DiscreteBeamKind& kind : discrete_beam_kinds()) kind.add(deck, model, out, diagnostics);
  return out;
}

bool is_discrete_beam_material(const Deck& deck, Id mid) {
  const auto& kinds = discrete_beam_kinds();
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](const DiscreteBeamKind& kind) { return kind.has(deck, mid); });
}

const Curve* beam_curve(const Deck& deck, const Model& model, const Entry& card, const char* field, Id id,
                        Diagnostics& diagnostics) {
  const Curve* curve = curve_named(deck, model, card, field, id, diagnostics);
  if (!curve) return nullptr;
  const std::vector<Real>& x = curve->abscissa;
  const auto error = [&](std::string what, const char* hint) {
    deck.error(diagnostics, card, field, std::move(what), hint);
    return nullptr;
  };
  if (x.size() < 2) return error(fmt::format("curve {} has one point", id), "a spring needs two or more");
  if (std::adjacent_find(x.begin(), x.end(), [](Real a, Real b) { return !(b > a); }) != x.end())
    return error(fmt::format("curve {} jumps: a spring would be infinitely stiff there", id),
                 "give its points increasing abscissae");
  return curve;
}

}  // namespace courant
