// Scenes with every kernel: water stays at rest between mirrors and on plates, and threads do not matter.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "../app/small_scene.hpp"
#include "kernel_scene.hpp"
#include "parallel/parallel.hpp"
#include "sph/core/fields.hpp"

namespace courant {
namespace {

using test::run;

using test::kernel_cards;

const std::string heading =
    "*KEYWORD\n*CONTROL_TERMINATION\n50.\n*CONTROL_SPH\n1,0,1e20,2\n0,0,0,0,0,0,0\n*PART\nwater\n1,1,1,1,1\n"
    "*MAT_NULL\n1,1000.0\n*EOS_LINEAR_POLYNOMIAL\n1,0,4e5\n\n*HOURGLASS\n1,0,0,0,1e-20,0.1\n";

/// 10 x 10 particles 0.1 apart, with the mass that fits.
std::string lattice() {
  std::string nodes = "*NODE\n", elements = "*ELEMENT_SPH\n";
  for (int k = 0; k < 100; ++k) {
    nodes += fmt::format("{},{:.17g},{:.17g},0\n", k + 1, 0.1 * (k % 10) + 0.05, 0.1 * (k / 10) + 0.05);
    elements += fmt::format("{},1,10.\n", k + 1);
  }
  return nodes + elements + "*END\n";
}
const std::string sides = "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,1,0,0\n1,0,0,0,0,0\n";
const std::string bottom = "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,0,1,0\n";
/// Shells whose contact surfaces are at y = 0, x = 0 and x = 1.
const std::string plates =
    "*NODE\n9001,-1,-0.025,-1\n9002,2,-0.025,-1\n9003,2,-0.025,1\n9004,-1,-0.025,1\n"
    "9005,-0.025,-1,-1\n9006,-0.025,3,-1\n9007,-0.025,3,1\n9008,-0.025,-1,1\n"
    "9009,1.025,-1,-1\n9010,1.025,3,-1\n9011,1.025,3,1\n9012,1.025,-1,1\n"
    "*ELEMENT_SHELL\n1,2,9001,9002,9003,9004\n2,2,9005,9006,9007,9008\n3,2,9009,9010,9011,9012\n"
    "*PART\nwalls\n2,2,2\n*SECTION_SHELL\n2,2\n0.05\n*MAT_RIGID\n2,7850.,2.1E11,0.3\n1,7,7\n"
    "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.\n10.\n";

class WithKernel : public testing::TestWithParam<KernelChoice> {};

struct Rest {
  Real kinetic = 0, height = 0;          ///< of the whole, mean of all
  Real mean_error = 0, worst_error = 0;  ///< of the pressure against the weight of the water above
  Vec low = Vec::Constant(1e9), high = -low;
};
Rest rest_of(Simulation& s) {
  const Particles& p = s.world().particles;
  Rest out;
  for (Index i = 0; i < p.active; ++i)
    out.low = out.low.cwiseMin(p.x.vec(i)), out.high = out.high.cwiseMax(p.x.vec(i));
  for (Index i = 0; i < p.active; ++i) {
    const Real error = p.p[i] - 1000 * 9.81 * (out.high[1] + 0.05 - p.x.vec(i)[1]);
    out.mean_error += error / p.active;
    out.worst_error = std::max(out.worst_error, std::abs(error));
    out.height += p.x.vec(i)[1] / p.active;
  }
  out.kinetic = s.sample("").energy.kinetic;
  return out;
}
constexpr Real bottom_pressure = 1000 * 9.81, potential_energy = 1000 * 9.81 * 0.5;

TEST_P(WithKernel, WaterRestsBetweenMirrors) {
  const auto s =
      test::build_deck(heading + kernel_cards(GetParam()) + bottom + sides + test::gravity_cards + lattice());
  run(*s, 30);
  const Rest rest = rest_of(*s);
  EXPECT_LT(rest.kinetic, 1e-4 * potential_energy);
  EXPECT_NEAR(rest.height, 0.5 - 9.81 / (3 * 400), 0.002);  // compressed by its own weight
  EXPECT_LT(std::abs(rest.mean_error), 0.08 * bottom_pressure);
  EXPECT_LT(rest.worst_error, 0.25 * bottom_pressure);  // rows that have moved within a smoothing length
  EXPECT_EQ(s->world().counters.count("mirror_crossings"), 0u);
}

// Plain sums lack neighbours beside a plate: the water sinks in until it is pressed enough there.
TEST_P(WithKernel, WaterRestsOnPlates) {
  const auto s =
      test::build_deck(heading + kernel_cards(GetParam()) + plates + test::gravity_cards + lattice());
  run(*s, 15);
  const Rest rest = rest_of(*s);
  EXPECT_LT(rest.kinetic, 1e-4 * potential_energy);
  EXPECT_GT(rest.height, 0.35);
  EXPECT_LT(std::abs(rest.mean_error), 0.08 * bottom_pressure);
  for (int k = 0; k < 2; ++k) EXPECT_GT(rest.low[k], -0.005) << k;
  EXPECT_LT(rest.high[0], 1.005);
  EXPECT_EQ(s->world().counters.at("leaked_particles"), 0);
}

TEST_P(WithKernel, ImagesReachAsFarAsTheKernel) {  // a lattice under one pressure, mirrors all around it
  std::string pressed = heading;
  pressed.replace(pressed.find("1,0,4e5"), 7, "1,1e4,4e5");
  const auto s = test::build_deck(pressed + kernel_cards(GetParam()) + bottom + sides +
                                  "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,1,0,0,0,0\n" + lattice());
  run(*s, 0.01);
  const Particles& p = s->world().particles;
  for (Index i = 0; i < p.active; ++i) EXPECT_LT(p.f.vec(i).norm(), 1e-9 * 1e4 * 0.1) << p.id[i];
}

TEST_P(WithKernel, TheSameBitsOnAnyNumberOfThreads) {
  for (const std::string bounds : {"1,1", "0.5,2"}) {
    std::vector<Real> reference;
    for (const int n : {1, 2, 4}) {
      set_threads(n);
      const auto s = test::build_deck(heading + kernel_cards(GetParam(), "1.3", bounds) + bottom +
                                      "*INITIAL_VELOCITY\n0\n3,-2,0\n" + test::gravity_cards + lattice());
      run(*s, 0.2);
      const Particles& p = s->world().particles;
      std::vector<Real> state{s->clock().t, s->sample("").energy.dissipated};
      for (const auto* f : {&p.x, &p.v})
        for (int k = 0; k < 2; ++k) state.insert(state.end(), f->data(k), f->data(k) + p.active);
      state.insert(state.end(), p.rho.data(), p.rho.data() + p.active);
      if (reference.empty()) reference = state;
      ASSERT_EQ(state.size(), reference.size());
      EXPECT_EQ(std::memcmp(state.data(), reference.data(), state.size() * sizeof(Real)), 0) << n;
    }
    set_threads(0);
  }
}

TEST_P(WithKernel, VolumeControlKnowsItsSurfaceAndItsLattice) {
  const auto s = test::build_deck(heading + kernel_cards(GetParam()) + "*COURANT_VOLUME_CONTROL\n0.01\n" +
                                  lattice());  // a block in the void
  run(*s, 0.002);
  Particles& p = s->world().particles;
  const Field<Real>& rate = sph_fields::volume_rate(p);
  const int far = static_cast<int>(std::ceil(1.2 * kernel_support(GetParam())));
  for (Index i = 0; i < p.active; ++i) {
    const int column = static_cast<int>(p.id[i] - 1) % 10, row = static_cast<int>(p.id[i] - 1) / 10;
    const int edge = std::min({column, row, 9 - column, 9 - row});
    if (edge == 0) EXPECT_EQ(rate[i], 0) << p.id[i];
    if (edge >= far) EXPECT_LT(std::abs(rate[i]), 1 / 0.01) << p.id[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Every, WithKernel, testing::ValuesIn(every_kernel),
                         [](const auto& test) { return test::kernel_word(test.param); });

/// A run with one kernel does not go on with another: the message names the field or the keyword.
TEST(KernelOfARestart, MayNotChange) {
  const auto refusal = [](KernelChoice before, KernelChoice now) {
    const auto first = test::build_deck(heading + kernel_cards(before) + lattice());
    Diagnostics diagnostics;
    const std::string text = heading + kernel_cards(now) + lattice();
    const auto second = Simulation::build("deck.k", in_memory(text), diagnostics, &first->record());
    EXPECT_FALSE(second);
    return diagnostics.text();
  };
  EXPECT_NE(refusal(KernelChoice::cubic_spline, KernelChoice::quintic_spline).find("SPHKERN"),
            std::string::npos);
  EXPECT_NE(refusal(KernelChoice::wendland_c2, KernelChoice::cubic_spline).find("*COURANT_KERNEL"),
            std::string::npos);
  EXPECT_NE(refusal(KernelChoice::wendland_c2, KernelChoice::wendland_c4).find("NAME"), std::string::npos);
}

}  // namespace
}  // namespace courant
