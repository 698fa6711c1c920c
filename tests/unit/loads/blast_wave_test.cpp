// The fits of Kingery and Bulmash, against those of Swisdak, which are independent of them, and themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "loads/blast/blast_cards.hpp"
#include "loads/blast/blast_wave.hpp"

using namespace courant;

namespace {

constexpr Real pound = 0.45359237, foot = 0.3048, psi = 6.894757293168361;  // [kg], [m], [kPa]

/// exp of a polynomial in ln Z, Z in m/kg^(1/3). M. M. Swisdak, Simplified Kingery airblast calculations
/// (1994): fits of his own to the data of hemispheres on the ground, in kPa, kPa ms/kg^(1/3) and ms/kg^(1/3).
Real swisdak(Real z, const std::vector<Real>& c) {
  Real sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * std::log(z) + c[k];
  return std::exp(sum);
}

}  // namespace

TEST(BlastWave, HemispheresAreAsSwisdakFittedThem) {
  for (const Real z : {0.25, 0.5, 0.8, 1.2, 2.0, 4.0, 8.0, 15.0, 22.0, 35.0}) {
    const Real mass = 8, distance = z * std::cbrt(mass);  // kg, m
    const BlastWave w = blast_wave(BlastKind::surface, mass / pound, distance / foot);
    const Real incident = z <= 2.9    ? swisdak(z, {7.2106, -2.1069, -0.3229, 0.1117, 0.0685})
                          : z <= 23.8 ? swisdak(z, {7.5938, -3.0523, 0.40977, 0.0261, -0.01267})
                                      : swisdak(z, {6.0536, -1.4066});
    const Real reflected = z <= 2 ? swisdak(z, {9.006, -2.6893, -0.6295, 0.1011, 0.29255, 0.13505, 0.019736})
                                  : swisdak(z, {8.8396, -1.733, -2.64, 2.293, -0.8232, 0.14247, -0.0099});
    const Real arrival = z <= 1.5 ? swisdak(z, {-0.7604, 1.8058, 0.1257, -0.0437, -0.0310, -0.00669})
                                  : swisdak(z, {-0.7137, 1.5732, 0.5561, -0.4213, 0.1054, -0.00929});
    const Real impulse = z <= 0.96   ? swisdak(z, {5.522, 1.117, 0.6, -0.292, -0.087})
                         : z <= 2.38 ? swisdak(z, {5.465, -0.308, -1.464, 1.362, -0.432})
                                     : swisdak(z, {5.2749, -0.4677, -0.2499, 0.0588, -0.00554});
    EXPECT_NEAR(w.incident * psi / incident, 1, 0.01) << z;
    EXPECT_NEAR(w.reflected * psi / reflected, 1, 0.01) << z;
    EXPECT_NEAR(w.arrival / (arrival * std::cbrt(mass)), 1, 0.01) << z;
    EXPECT_NEAR(w.incident_impulse * psi / (impulse * std::cbrt(mass)), 1, 0.01) << z;
    EXPECT_NEAR(
        w.reflected_impulse * psi / (swisdak(z, {6.7853, -1.3466, 0.101, -0.01123}) * std::cbrt(mass)), 1,
        0.01)
        << z;
  }
}

// Far away a wave is a sound wave: it is reflected twice as strong and runs at 1.1 ft/ms; near the charge the
// reflection is many times as strong, but less than fourteen times. Pieces of the fits meet.
TEST(BlastWave, FitsMeetAndBecomeSound) {
  for (const BlastKind kind : {BlastKind::surface, BlastKind::air}) {
    const BlastWave far = blast_wave(kind, 1, 60), further = blast_wave(kind, 1, 100);
    EXPECT_NEAR(further.reflected / further.incident, 2, 0.1);
    EXPECT_NEAR(40 / (further.arrival - far.arrival), 1.13, 0.04);
    for (const Real z : {2.0, 2.24, 2.41, 2.54, 5.75, 7.0}) {
      const BlastWave below = blast_wave(kind, 1, z * 0.999), above = blast_wave(kind, 1, z * 1.001);
      EXPECT_NEAR(above.duration / below.duration, 1, 0.025) << z;
      EXPECT_NEAR(above.incident_impulse / below.incident_impulse, 1, 0.015) << z;
    }
    for (Real z = blast_range(kind).least; z < 100; z *= 1.1) {
      const BlastWave w = blast_wave(kind, 1, z);
      EXPECT_GT(w.reflected / w.incident, 1.95) << z;
      EXPECT_LT(w.reflected / w.incident, 14) << z;
    }
  }
}

// A hemisphere on the ground does what a sphere of some 1.8 times its mass (1.7 to 2, as the ground gives
// way) does in free air: pressures go with the mass to the power of two thirds or less.
TEST(BlastWave, TheGroundReflects) {
  for (const Real z : {3.0, 6.0, 12.0, 30.0}) {
    const BlastWave ground = blast_wave(BlastKind::surface, 1, z), air = blast_wave(BlastKind::air, 1.8, z);
    EXPECT_NEAR(ground.incident / air.incident, 1, 0.08) << z;
    EXPECT_NEAR(ground.arrival / air.arrival, 1, 0.05) << z;
  }
}

// Far away the wave hardly decays over its duration, and the suction that goes with that would take back many
// times what the wave gave.
TEST(BlastWave, SuctionTakesBackNoMoreThanTheWaveGave) {
  for (const BlastKind kind : {BlastKind::surface, BlastKind::air})
    for (Real z = blast_range(kind).least; z < blast_range(kind).most; z *= 1.01) {
      const BlastWave w = blast_wave(kind, 8, 2 * z);
      for (const Real cosine : {1.0, 0.3, 0.0}) {
        const Real late = w.impulse(w.arrival + 1e3 * w.duration, cosine, false);
        const Real most = w.impulse(w.arrival + w.duration, cosine, true);
        EXPECT_GE(late, -1e-9 * most) << z;
        EXPECT_NEAR(w.pressure(w.arrival + 1e3 * w.duration, cosine, false), 0, 1e-9 * w.incident) << z;
        Real sum = 0;
        constexpr int n = 4000;
        for (int k = 0; k < n; ++k)
          sum += w.pressure(w.arrival + (k + 0.5) * 20 / n * w.duration, cosine, false) * 20 / n * w.duration;
        EXPECT_NEAR(sum, w.impulse(w.arrival + 20 * w.duration, cosine, false), 0.01 * most) << z;
      }
    }
}

// Impulses of the fits are integrals of the pressure; 1 and 0 of the cosine.
TEST(BlastWave, ImpulsesAreIntegrals) {
  for (const BlastKind kind : {BlastKind::surface, BlastKind::air})
    for (const Real z : {0.5, 1.0, 2.3, 6.0, 40.0}) {
      const BlastWave w = blast_wave(kind, 27, 3 * z);
      for (const Real cosine : {1.0, 0.0, -0.5}) {
        constexpr int n = 20000;
        Real sum = 0;
        for (int k = 0; k < n; ++k)
          sum += w.pressure(w.arrival + (k + 0.5) / n * w.duration, cosine, false) * w.duration / n;
        EXPECT_NEAR(sum / (cosine > 0 ? w.reflected_impulse : w.incident_impulse), 1, 2e-3) << z;
      }
      for (const Real cosine : {1.0, 0.6, -0.5}) {
        const Real t = w.arrival + 0.3 * w.duration, dt = 1e-4 * w.duration;
        const Real slope = (w.impulse(t + dt, cosine, false) - w.impulse(t - dt, cosine, false)) / (2 * dt);
        EXPECT_NEAR(slope / w.pressure(t, cosine, false), 1, 1e-6);
        EXPECT_NEAR(w.impulse(w.arrival + w.duration, cosine > 0.9 ? 1 : -1, false),
                    w.impulse(w.arrival + 9 * w.duration, cosine > 0.9 ? 1 : -1, true),
                    1e-12 * w.reflected_impulse);
      }
      EXPECT_NEAR(w.impulse(w.arrival + w.duration, 1, true) / w.reflected_impulse, 1, 1e-9);
      EXPECT_EQ(w.pressure(0.99 * w.arrival, 1, false), 0);
      EXPECT_LT(w.pressure(w.arrival + 1.5 * w.duration, 1, false), 0);
      EXPECT_EQ(w.pressure(w.arrival + 1.5 * w.duration, 1, true), 0);
      // between them as the square of the cosine, with 1 + c - 2 c^2 of the wave that passes
      EXPECT_NEAR(w.pressure(w.arrival, 0.5, false), 0.25 * w.reflected + w.incident, 1e-9 * w.reflected);
    }
}
