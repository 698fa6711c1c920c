#include "post/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "particle_sets.hpp"

namespace courant {
namespace {

std::vector<Real> wave(Real f, Real amplitude, Real dt, int n) {
  std::vector<Real> out;
  for (int i = 0; i < n; ++i) out.push_back(amplitude * std::sin(2 * pi * f * i * dt + 0.3));
  return out;
}

TEST(Welch, FrequencyAndVarianceOfASine) {
  for (Real f : {1.0, 3.5, 4.27}) {
    const Spectrum s = welch(wave(f, 0.01, 0.01, 1500), 0.01, {.segment = 5});
    EXPECT_EQ(s.segments, 5);  // 15 s in segments of 5 s that overlap by half
    EXPECT_NEAR(s.frequency[1], 0.2, 1e-12);
    EXPECT_NEAR(s.dominant(0.2, 20).value(), f, 0.02) << f;  // a tenth of the resolution
    EXPECT_NEAR(s.variance(0, 50), 0.5e-4, 0.01e-4) << f;
    EXPECT_NEAR(s.variance(f - 0.7, f + 0.7), 0.5e-4, 0.01e-4) << f;
  }
}

TEST(Welch, NoiseIsFlatAndKeepsItsVariance) {
  std::vector<Real> noise;
  for (std::size_t i = 0; i < 20000; ++i) noise.push_back(test::scatter(i));
  for (SpectrumWindow window : {SpectrumWindow::hann, SpectrumWindow::rectangle}) {
    const Spectrum s = welch(noise, 0.01, {.segment = 1, .window = window});
    EXPECT_NEAR(s.variance(0, 50), 1.0 / 12, 0.003);
    EXPECT_NEAR(s.variance(10, 20) / s.variance(30, 40), 1, 0.05);
  }
}

TEST(Welch, TrendsAreTakenAway) {
  std::vector<Real> values = wave(3, 0.01, 0.01, 1000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += 5 + 0.01 * static_cast<Real>(i);
  const Spectrum s = welch(values, 0.01, {.segment = 5});
  EXPECT_NEAR(s.dominant(0, 50).value(), 3, 0.02);
  EXPECT_NEAR(s.variance(0, 50), 0.5e-4, 0.02e-4);
  const Spectrum with = welch(values, 0.01, {.segment = 5, .detrend = Detrend::mean});
  EXPECT_GT(with.variance(0, 50), 0.1);  // the saw teeth of the trend
}

TEST(Welch, TheBandChoosesThePeak) {
  std::vector<Real> values = wave(1, 0.02, 0.01, 2000), fast = wave(6, 0.01, 0.01, 2000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += fast[i];
  const Spectrum s = welch(values, 0.01, {.segment = 5});
  EXPECT_NEAR(s.dominant(0, 50).value(), 1, 0.02);
  EXPECT_NEAR(s.dominant(3, 50).value(), 6, 0.02);
  EXPECT_FALSE(welch(std::vector<Real>(100, 0.0), 0.01, {.segment = 1}).dominant(0, 50));
}

TEST(EqualSteps, GapsAndUnevenTimes) {
  std::vector<Real> t, values;
  for (int i = 0; i <= 100; ++i) {
    t.push_back(0.01 * i + (i > 0 && i < 100 ? 0.002 * test::scatter(static_cast<std::size_t>(i)) : 0));
    values.push_back(i % 7 == 3 ? std::nan("") : 2 + 3 * t.back());
  }
  const auto even = at_equal_steps(t, values, 0.05);
  ASSERT_TRUE(even);
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR((*even)[static_cast<std::size_t>(i)], 2 + 0.03 * i, 1e-12);
  for (std::size_t i = 40; i < 50; ++i) values[i] = std::nan("");
  EXPECT_FALSE(at_equal_steps(t, values, 0.05));
  EXPECT_TRUE(at_equal_steps(t, values, 0.2));
}

}  // namespace
}  // namespace courant
