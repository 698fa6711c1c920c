// *COURANT_LEVEL_OUTLET lets a solitary wave out: what comes back of it, against the same channel so long
// that nothing can have come back yet.
#include <algorithm>
#include <cmath>
#include <vector>

#include "same_bits.hpp"
#include "scenes.hpp"

using namespace courant;

namespace level_outlet_test {
namespace {

constexpr Real d = 0.1, a = 0.02, gauge = 2, half = 0.05, past = 1.8, end = 3.4;

/// Depth that the water's volume fills about the gauge, every 0.02 s from when the wave has passed.
std::vector<Real> depths(const std::map<std::string, std::string>& parameters) {
  const auto s = test::simulation_of(test::deck_of_scene("solitary_wave_out", parameters));
  std::vector<Real> out;
  if (!s) return out;
  Real highest = 0;
  for (int k = 0; s->clock().t < end;) {
    s->step([](World&, const Clock&, const std::string&) {});
    if (s->clock().t < 0.02 * k) continue;
    ++k;
    const Particles& p = s->world().particles;
    Real depth = 0;
    for (Index i = 0; i < p.active; ++i)
      depth += p.m[i] / p.rho[i] * std::max(Real(0), 1 - std::abs(p.x.vec(i)[0] - gauge) / half) / half;
    highest = std::max(highest, depth);
    if (s->clock().t > past) out.push_back(depth);
  }
  EXPECT_NEAR(highest, d + a, 0.25 * a);  // the wave has been there
  return out;
}

Real reflected(const std::vector<Real>& depth, const std::vector<Real>& without) {
  Real most = 0;
  for (std::size_t k = 0; k < std::min(depth.size(), without.size()); ++k)
    most = std::max(most, std::abs(depth[k] - without[k]));
  return most / a;
}

TEST(LevelOutlet, LetsASolitaryWaveOut) {
  const auto without = depths({{"length", "5"}});
  const Real by_default = reflected(depths({}), without),
             slow = reflected(depths({{"tint", "60 * sqrt(d / g)"}}), without);
  RecordProperty("reflected", std::to_string(by_default));
  RecordProperty("reflected_tint_60", std::to_string(slow));
  EXPECT_LT(by_default, 0.08);  // what the integral of the level takes from the passing wave comes back
  EXPECT_LT(slow, 0.05);
}

}  // namespace
}  // namespace level_outlet_test
