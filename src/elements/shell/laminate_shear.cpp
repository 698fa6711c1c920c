#include "elements/shell/laminate_shear.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "elements/shell/layer_axes.hpp"

namespace courant {

namespace {

/// Of a layer along one direction: modulus of a side that is held, shear modulus across the plane. [M/LT2]
struct LayerModuli {
  Real E = 0, G = 0;
};

/// Stress component `k` that a layer at rest answers a small strain of that component with, over the strain.
Real stiffness_of(const ShellPart& part, std::size_t layer, std::size_t k) {
  constexpr Real strain = 1e-9, time = 1;
  const StrengthLaw& law = part.law_of(layer);
  std::array<Real, 6> rate{}, stress{};
  rate[k] = strain / time;
  Real speed = 0, rate_zz = 0;
  std::vector<Real> history;
  for (const HistoryVariable& one : law.history())
    history.resize(history.size() + static_cast<std::size_t>(one.components), 0);
  std::vector<Real*> kept;
  for (Real& value : history) kept.push_back(&value);
  PointBlock block{.count = 1, .dt = time, .sound_speed = &speed, .history = kept};
  for (std::size_t c = 0; c < 6; ++c) block.rate[c] = &rate[c], block.stress[c] = &stress[c];
  const Real angle = part.angle.empty() ? 0 : part.angle[layer] * pi / 180;
  const Real cosine = std::cos(angle), sine = std::sin(angle);
  update_along_axes(law, &cosine, &sine, block, &rate_zz);
  return stress[k] / strain;
}

/// K over the thickness of layers from the lower to the upper face. [M/LT2]
Real equilibrium_stiffness(const std::vector<LayerModuli>& layers, const std::vector<Real>& share) {
  Real first = 0, second = 0, z = -0.5;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    first += layers[k].E * share[k], second += layers[k].E * share[k] * (z + 0.5 * share[k]);
    z += share[k];
  }
  const Real neutral = second / first;
  Real bending = 0, flexibility = 0, S = 0;
  z = -0.5;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Real low = z - neutral, t = share[k], middle = low + 0.5 * t;
    bending += layers[k].E * (t * middle * middle + t * t * t / 12);
    const Real at = std::sqrt(0.6);  // Gauss: exact for polynomials of fifth degree
    for (const auto& [point, weight] : {std::pair{-at, 5.0 / 18}, {Real(0), 8.0 / 18}, {at, 5.0 / 18}}) {
      const Real y = middle + 0.5 * t * point;
      const Real here = S + 0.5 * layers[k].E * (y * y - low * low);
      flexibility += weight * t * here * here / layers[k].G;
    }
    S += layers[k].E * t * middle;
    z += t;
  }
  return bending * bending / flexibility;
}

}  // namespace

LaminateShear laminate_shear(const ShellPart& part) {
  std::vector<std::size_t> order(part.zeta.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return part.zeta[a] < part.zeta[b]; });
  std::array<std::vector<LayerModuli>, 2> layers;
  std::vector<Real> share;
  std::array<Real, 2> alike{};
  for (const std::size_t k : order) {
    share.push_back(part.share[k]);
    for (std::size_t d = 0; d < 2; ++d) {  // xx with zx, yy with yz
      layers[d].push_back({stiffness_of(part, k, d), 0.5 * stiffness_of(part, k, d == 0 ? 5 : 4)});
      alike[d] += share.back() * layers[d].back().G;
    }
  }
  const std::array<Real, 2> K{equilibrium_stiffness(layers[0], share),
                              equilibrium_stiffness(layers[1], share)};
  return {K[0] / alike[0], K[1] / alike[1], (K[0] + K[1]) / (alike[0] + alike[1])};
}

}  // namespace courant
