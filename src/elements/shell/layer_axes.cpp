#include "elements/shell/layer_axes.hpp"

#include <algorithm>

#include "parallel/parallel.hpp"

namespace courant {

void update_along_axes(const StrengthLaw& law, const Real* cosine, const Real* sine, const PointBlock& points,
                       Real* rate_zz) {
  alignas(64) Real rate[6][block_size], stress[6][block_size];
  const auto turn = [&](const auto& from, auto& to, Real sign) {
    for (Index i = 0; i < points.count; ++i) {
      const Real C = cosine[i], S = sign * sine[i];
      const Real xx = from[0][i], yy = from[1][i], xy = from[3][i], yz = from[4][i], zx = from[5][i];
      to[0][i] = C * C * xx + S * S * yy + 2 * C * S * xy;
      to[1][i] = S * S * xx + C * C * yy - 2 * C * S * xy;
      to[3][i] = C * S * (yy - xx) + (C * C - S * S) * xy;
      to[4][i] = C * yz - S * zx, to[5][i] = C * zx + S * yz;
    }
  };
  turn(points.rate, rate, 1), turn(points.stress, stress, 1);
  std::fill(stress[2], stress[2] + points.count, 0);
  PointBlock turned = points;
  for (std::size_t k = 0; k < 6; ++k) turned.rate[k] = rate[k], turned.stress[k] = stress[k];
  turned.rate[2] = points.rate[2];
  law.update_in_plane_stress(turned, rate_zz);
  turn(stress, points.stress, -1);
}

}  // namespace courant
