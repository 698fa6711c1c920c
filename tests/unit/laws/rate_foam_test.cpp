// Which rate counts for *MAT_083 along each of two axes.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "law_from_cards.hpp"

using namespace courant;

TEST(RateFoam, RflagTellsWhichRateCounts) {
  const Real rate[6] = {-2e-3, -1e-3, 0, 0, 0, 0};
  constexpr int steps = 100;
  for (const auto& [rflag, of_x, of_y] :
       {std::tuple{0, 2e-3, 2e-3}, std::tuple{1, 2e-3, 1e-3}, std::tuple{2, 3e-3, 3e-3}}) {
    const auto law = test::law_from_cards(
        "MAT_FU_CHANG_FOAM",
        fmt::format(
            "1,1.0,10.0,,,,,7\n0.0,0.0,{}\n*DEFINE_CURVE\n5\n0.0,0.0\n1.0,4.0\n*DEFINE_CURVE\n6\n0.0,0.0\n"
            "1.0,8.0\n*DEFINE_TABLE_2D\n7\n0.0,5\n0.004,6\n",
            rflag));
    std::vector<Real> history(12, 0);
    std::vector<Real*> kept;
    for (Real& number : history) kept.push_back(&number);
    Real stress[6] = {}, c = 0;
    PointBlock block;
    block.count = 1, block.dt = 1, block.sound_speed = &c, block.history = kept;
    for (std::size_t k = 0; k < 6; ++k) block.rate[k] = &rate[k], block.stress[k] = &stress[k];
    for (int n = 0; n < steps; ++n) law->update(block);
    const Real lx = std::exp(-0.2), ly = std::exp(-0.1);
    EXPECT_NEAR(stress[0], -4 * (1 - lx) * (1 + of_x / 4e-3) / ly, 1e-5) << rflag;
    EXPECT_NEAR(stress[1], -4 * (1 - ly) * (1 + of_y / 4e-3) / lx, 1e-5) << rflag;
    EXPECT_NEAR(c, std::sqrt(10.0), 1e-9);  // E is more than the slope, 8
  }
}
