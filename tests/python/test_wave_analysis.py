"""Numbers of waves out of levels that are known."""
from __future__ import annotations

import math

import numpy as np
import pytest
from courant import wave_analysis as analysis
from courant.waves import Waves, flap_transfer, near_field, piston_transfer, wave_number

T, D = 1.5, 0.4
OMEGA = 2 * math.pi / T
K, FREE = (float(wave_number(n * OMEGA, D)) for n in (1, 2))
X = np.array([2.0, 2.3, 2.7, 3.2, 3.8, 4.5])


def levels(t: np.ndarray, k: float = K, free: float = 0.001) -> np.ndarray:
    return np.array([0.4 + 0.03 * np.cos(OMEGA * t - k * x) + 0.002 * np.cos(OMEGA * t + k * x + 0.3) + 0.004 * np.cos(2 * (OMEGA * t - k * x))
                     + free * np.cos(2 * OMEGA * t - FREE * x + 1) for x in X])


def test_waves_in_both_directions_and_their_harmonics() -> None:
    t = np.arange(0, 6, 0.02)
    both, second, k = analysis.regular(X, t, levels(t, 0.99 * K), T, D)
    assert abs(both.incident) == pytest.approx(0.03, rel=1e-4) and both.reflection == pytest.approx(1 / 15, rel=1e-3)
    assert k / K == pytest.approx(0.99, abs=1e-5)
    assert second is not None and second.bound == pytest.approx(0.004, rel=1e-3) and second.free == pytest.approx(0.001, rel=1e-2)


def test_gauges_that_do_not_separate_waves() -> None:
    with pytest.raises(analysis.WaveFaultInRecord, match="half a wave length"):
        analysis.separated(np.array([0, math.pi / K]), np.ones(2), K)
    with pytest.raises(analysis.WaveFaultInRecord, match="shorter than a period"):
        analysis.amplitudes(np.linspace(0, 1, 50), np.zeros((1, 50)), OMEGA)
    with pytest.raises(analysis.WaveFaultInRecord, match="four gauges"):
        analysis.second_harmonic(X[:3], np.ones(3), K, FREE)


def test_height_and_period_of_a_spectrum() -> None:
    made = Waves("jonswap", depth=0.5, height=0.1, period=1.6, seed=5)
    t = np.arange(0, 400, 0.05)
    level = made.elevation(0, t)
    assert analysis.significant_height(level) == pytest.approx(0.1, rel=0.03)
    assert analysis.peak_period(t, level, 0.2, 3) == pytest.approx(1.6, rel=0.03)


def test_stokes_waves() -> None:
    """Low ones are linear; in deep water the celerity grows by (k a)^2/2, and nothing flows back."""
    assert analysis.stokes_wave_number(1e-6, T, D) == pytest.approx(K, rel=1e-8)
    k = float(wave_number(OMEGA, 50))
    assert k / analysis.stokes_wave_number(0.1, T, 50) == pytest.approx(1 + (k * 0.05) ** 2, rel=1e-3)  # of k at one period: twice that of c at one length


@pytest.mark.parametrize("kd", [0.3, 1.0, 2.0])
def test_transfer_of_flaps(kd: float) -> None:
    """A hinge far below the bed is a piston; low hinges in shallow water move half the water."""
    omega = math.sqrt(9.81 / D * kd * math.tanh(kd))
    assert flap_transfer(kd, -1e5) == pytest.approx(float(piston_transfer(kd)), rel=1e-4)
    assert near_field(omega, D, hinge=-1e5 * D)[0] == pytest.approx(float(near_field(omega, D)[0]), rel=1e-3)
    assert flap_transfer(0.01) == pytest.approx(0.005, rel=1e-3)


def test_near_field_is_what_the_paddle_lacks() -> None:
    """The wave and the near field together have the velocity of the paddle all over the depth."""
    omega = OMEGA
    ratio = omega**2 * D / 9.81
    roots = []
    for j in range(1, 2001):
        k = j * math.pi
        for _ in range(30):
            k = j * math.pi - math.atan(ratio / k)
        roots.append(k)
    k = np.array(roots)
    assert near_field(omega, D, terms=2000)[0] == pytest.approx(float((4 * np.sin(k) ** 2 / (2 * k + np.sin(2 * k))).sum()), rel=1e-6)
    z = np.linspace(0, 1, 11)
    kd = K * D
    u = piston_transfer(kd) * np.cosh(kd * z) / np.sinh(kd)
    u = u + (4 * np.sin(k) / (2 * k + np.sin(2 * k)) * np.cos(np.outer(z, k))).sum(axis=1)
    np.testing.assert_allclose(u[:-1], 1, atol=2e-3)


def test_elevation_at_the_paddle() -> None:
    made = Waves("regular", depth=0.5, height=0.08, period=1.4, ramp=0)
    t, eta = made.at_paddle(10).T
    beside = float(near_field(made.omega, 0.5)[0]) * 0.04 / float(piston_transfer(made.wave * 0.5))
    np.testing.assert_allclose(eta, 0.04 * np.cos(made.omega * t) + beside * np.sin(made.omega * t), atol=1e-12)
    assert Waves("solitary", depth=0.5, height=0.1).at_paddle(20)[:, 1].max() == pytest.approx(0.1, rel=1e-3)
    away = Waves("solitary", depth=0.5, height=0.1).at_paddle(20, away=2)
    assert away[:, 1].max() == pytest.approx(0.1, rel=1e-3) and away[away[:, 1].argmax(), 0] > 0.5 * 2 / math.sqrt(9.81 * 0.6)


def test_elevation_away_from_the_paddle_is_that_of_the_wave() -> None:
    for maker in ("piston", "flap"):
        made = Waves("regular", depth=0.5, height=0.08, period=1.4, ramp=0, maker=maker)
        t, eta = made.at_paddle(10, away=2.5).T
        np.testing.assert_allclose(eta, made.elevation(2.5, t), atol=1e-5)


def test_absorption_of_long_waves_needs_no_correction() -> None:
    found = Waves("regular", depth=0.5, height=0.01, period=30).absorption()
    assert found.factor == pytest.approx(1, abs=2e-3) and found.delay == pytest.approx(0, abs=1e-3)
    assert Waves("solitary", depth=0.5, height=0.1).absorption(0.1, 3) == (1, 0)


@pytest.mark.parametrize("maker", ["piston", "flap"])
def test_absorption_leaves_nothing_of_a_wave_of_the_period(maker: str) -> None:
    """The loop of the wave maker at its frequency: what comes back, the wave that a wall sends on, that of the paddle, and its near field."""
    for drift, away in ((0.0, 0.1), (2.8, 0.2), (14.0, 0.15)):
        made = Waves("regular", depth=0.5, height=0.01, period=1.4, maker=maker)
        factor, delay = made.absorption(away, drift)
        w, k = made.omega, made.wave
        c0 = float(made.transfer(k * 0.5))
        gain = factor * math.sqrt(9.81 * 0.5) / (0.5 if maker == "piston" else 0.25)
        back = 1j * w / drift + 0.5 / drift**2 if drift else 0.0
        filtered = gain / (1 + 1j * w * delay) * (1j * w) ** 2 / ((1j * w) ** 2 + back)
        beside = float(near_field(w, 0.5, hinge=None if maker == "piston" else 0.0, away=away)[0])
        there, on = np.exp(1j * k * away), np.exp(-1j * k * away)
        # u = - filtered (there + (1 + made) on + beside u/(i w)), made = c0 u/w
        u = -filtered * (there + on) / (1 + filtered * (c0 / w * on + beside / (1j * w)))
        assert abs(1 + c0 * u / w) < 1e-9, (drift, away)
