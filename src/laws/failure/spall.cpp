#include "laws/failure/spall.hpp"

#include "base/eigenvalues.hpp"

namespace courant {

namespace {

Real largest_principal(const PointBlock& block, Index i) {
  const auto& s = block.stress;
  Matrix minus;
  minus << -s[0][i], -s[3][i], -s[5][i], -s[3][i], -s[1][i], -s[4][i], -s[5][i], -s[4][i], -s[2][i];
  return -least_eigenvalue(minus);
}

}  // namespace

void Spall::look(const PointBlock& block, Real* spalled) const {
  for (Index i = 0; i < block.count; ++i) {
    const Real p = block.pressure ? block.pressure[i] : 0;
    if (spalled[i] == 0 && (option == 3 ? p < limit : largest_principal(block, i) - p > -limit))
      spalled[i] = 1;
    if (spalled[i] == 0) continue;
    for (Real* stress : block.stress) stress[i] = 0;
    if (block.least_pressure) block.least_pressure[i] = 0;
    if (block.sound_speed) block.sound_speed[i] = 0;
  }
}

}  // namespace courant
