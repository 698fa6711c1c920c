"""Waves of a piston: what theory says of wave numbers, strokes, spectra and limits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from courant.waves import WaveFault, Waves, breaking_height, flap_transfer, piston_transfer, wave_number


def test_dispersion() -> None:
    for omega in (0.3, 2.0, 6.0, 30.0):
        k = float(wave_number(omega, 0.7))
        assert 9.81 * k * math.tanh(0.7 * k) == pytest.approx(omega**2, rel=1e-12)
    assert float(wave_number(0.01, 1.0)) == pytest.approx(0.01 / math.sqrt(9.81), rel=1e-4)
    assert float(wave_number(50.0, 5.0)) == pytest.approx(2500 / 9.81, rel=1e-9)


def test_transfer_functions() -> None:
    # shallow water: a piston raises kd of its stroke, a flap half of that; deep water: 2
    assert float(piston_transfer(0.01)) == pytest.approx(0.01, rel=1e-3) and float(flap_transfer(0.01)) == pytest.approx(0.005, rel=1e-3)
    assert float(piston_transfer(20)) == pytest.approx(2, rel=1e-6) and float(flap_transfer(200)) == pytest.approx(2, rel=0.01)
    # Dean and Dalrymple (1991), figure 6.3: kd = 1.5
    assert float(piston_transfer(1.5)) == pytest.approx(2 * (math.cosh(3) - 1) / (math.sinh(3) + 3))


def test_a_regular_stroke_makes_its_height() -> None:
    waves = Waves("regular", depth=0.5, height=0.08, period=1.4)
    t, x = waves.displacement(20).T
    late = t > 5
    assert x[late].max() - x[late].min() == pytest.approx(0.08 / float(piston_transfer(waves.wave * 0.5)), rel=1e-3)
    assert x[0] == 0 and abs(x[1]) < 1e-5 and t[-1] == 20
    eta = waves.elevation(0, t)
    assert eta.max() == pytest.approx(0.04, rel=1e-3)
    # linear theory: elevation goes with the velocity of the piston
    assert np.corrcoef(np.gradient(x[late], t[late]), eta[late])[0, 1] > 0.999


def test_second_order_adds_the_harmonic_of_madsen() -> None:
    one, two = Waves("regular", depth=0.4, height=0.06, period=2.0), Waves("second_order", depth=0.4, height=0.06, period=2.0)
    t, x = two.displacement(24).T
    late = t >= 8
    parts = np.fft.rfft((x - one.displacement(24)[:, 1])[late][:-1])
    amplitude = 2 * np.abs(parts) / late.sum()
    kd = one.wave * 0.4
    expected = 0.06**2 / (32 * 0.4) * (3 * math.cosh(kd) / math.sinh(kd) ** 3 - (math.sinh(2 * kd) + 2 * kd) / (math.cosh(2 * kd) - 1))
    assert int(np.argmax(amplitude)) == 16 and amplitude.max() == pytest.approx(expected, rel=0.01)
    with pytest.raises(WaveFault, match="second order holds up to"):
        Waves("second_order", depth=0.1, height=0.05, period=4.0).displacement(10)


def test_solitary_stroke_of_goring() -> None:
    waves = Waves("solitary", depth=0.4, height=0.12)
    t, x = waves.displacement(15).T
    assert x[-1] == pytest.approx(math.sqrt(16 * 0.12 * 0.4 / 3), rel=1e-3) and (np.diff(x) >= 0).all() and x[0] == 0
    # the volume pushed is that of the wave
    eta = waves.elevation(0, t)
    c = math.sqrt(9.81 * 0.52)
    volume = float(np.sum(0.5 * np.diff(t) * (eta[1:] + eta[:-1]))) * c
    assert volume == pytest.approx(0.4 * x[-1], rel=0.01) and eta.max() == pytest.approx(0.12, rel=1e-3)


def test_the_crest_leaves_the_piston_where_the_piston_is() -> None:
    waves = Waves("solitary", depth=0.4, height=0.12)
    t, x = waves.displacement(15).T
    reach = 0.12 / (math.sqrt(0.75 * 0.12 / 0.4**3) * 0.4)
    # the piston is fastest, and half of its stroke ahead, when the crest is at its face
    at = int(np.argmax(np.gradient(x, t)))
    assert x[at] == pytest.approx(reach, abs=0.01) and x[at] == pytest.approx(x[-1] / 2, abs=0.01)
    eta = waves.elevation(float(x[at]), t)
    assert t[np.argmax(eta)] == pytest.approx(t[at], abs=0.03)
    # the water at the piston moves with it: u = c eta / (depth + eta) at its face
    c = math.sqrt(9.81 * 0.52)
    for k in range(20, len(t) - 20, 20):
        face = float(waves.elevation(float(x[k]), t[k : k + 1])[0])
        assert (x[k + 1] - x[k - 1]) / (t[k + 1] - t[k - 1]) == pytest.approx(c * face / (0.4 + face), abs=3e-3)


@pytest.mark.parametrize("kind", ["jonswap", "pierson_moskowitz"])
def test_spectra(kind: str) -> None:
    waves = Waves(kind, depth=1.0, height=0.1, period=1.6, seed=5)
    t = np.linspace(0, 1600, 40001)
    eta = waves.elevation(2.0, t)
    assert 4 * eta.std() == pytest.approx(0.1, rel=0.02)
    power = np.abs(np.fft.rfft(eta)) ** 2
    f = np.fft.rfftfreq(len(t), t[1] - t[0])
    smooth = np.convolve(power, np.ones(81) / 81, "same")
    assert 1 / f[np.argmax(smooth)] == pytest.approx(1.6, rel=0.05)
    same, other = Waves(kind, depth=1.0, height=0.1, period=1.6, seed=5), Waves(kind, depth=1.0, height=0.1, period=1.6, seed=6)
    assert np.array_equal(waves.displacement(10), same.displacement(10)) and not np.array_equal(waves.displacement(10), other.displacement(10))


def test_gamma_sharpens_the_peak() -> None:
    of = {gamma: Waves("jonswap", depth=1.0, height=0.1, period=1.6, gamma=gamma).spectrum().amplitude.max() for gamma in (1.0, 3.3)}
    assert of[3.3] > 1.2 * of[1.0]


def test_focused_waves_meet() -> None:
    waves = Waves("focused", depth=1.0, height=0.08, period=1.5, focus=(4.0, 12.0))
    t = np.linspace(0, 24, 4801)
    eta = waves.elevation(4.0, t)
    assert eta.max() == pytest.approx(0.08, rel=1e-6) and t[np.argmax(eta)] == pytest.approx(12, abs=0.006)
    assert np.abs(waves.elevation(0.0, t[:200])).max() < 0.03


def test_a_recorded_elevation_comes_back() -> None:
    t = np.linspace(0, 20, 801)
    eta = 0.02 * np.sin(2 * math.pi * t / 2) + 0.01 * np.cos(2 * math.pi * t / 1.25 + 0.3)
    waves = Waves("elevation", depth=0.6, record=np.column_stack([t, eta]))
    np.testing.assert_allclose(waves.elevation(0.0, t), eta, atol=2e-4)
    _, x = waves.displacement(20).T
    assert 0.02 < x.max() - x.min() < 0.2


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"kind": "regular", "depth": 0.5, "height": 0.1, "period": 0.0}, "the period of the waves is 0"),
        ({"kind": "regular", "depth": 0.5, "height": 0.4, "period": 1.0}, "break in a depth of 0.5"),
        ({"kind": "solitary", "depth": 0.5, "height": 0.45}, "breaks: at most 0.78"),
        ({"kind": "regular", "depth": 0.0, "height": 0.1, "period": 1.0}, "the depth of the water is 0"),
        ({"kind": "regular", "depth": 0.5, "height": 0.0, "period": 1.0}, "the height of the waves is 0"),
        ({"kind": "tsunami", "depth": 0.5, "height": 0.1, "period": 1.0}, "no kind of waves 'tsunami'"),
        ({"kind": "elevation", "depth": 0.5}, "eight rows or more"),
        ({"kind": "elevation", "depth": 0.5, "record": np.column_stack([np.arange(9.0), np.ones(9)])}, "it has no waves"),
        ({"kind": "elevation", "depth": 0.5, "record": np.column_stack([np.arange(9.0), np.full(9, np.nan)])}, "eight rows or more"),
        ({"kind": "regular", "depth": 0.5, "height": 0.1, "period": math.inf}, "the period of the waves is inf"),
        ({"kind": "regular", "depth": 0.5, "height": 0.1, "period": math.nan}, "the period of the waves is nan"),
        ({"kind": "jonswap", "depth": 0.5, "height": 1e-300, "period": 1.4}, "the height of the waves is 1e-300: it must be above 0, from 1e-12"),
        ({"kind": "solitary", "depth": 1e300, "height": 0.1}, "the depth of the water is 1e.300"),
        ({"kind": "regular", "depth": math.inf, "height": 0.1, "period": 1.0}, "the depth of the water is inf"),
        ({"kind": "solitary", "depth": 0.5, "height": math.nan}, "the height of the waves is nan"),
        ({"kind": "regular", "depth": 0.5, "height": 0.1, "period": 1.4, "g": 0.0}, "gravity is 0"),
        ({"kind": "regular", "depth": 0.5, "height": 0.1, "period": 1.4, "ramp": -1.0}, "the ramp is -1"),
        ({"kind": "focused", "depth": 0.5, "height": 0.1, "period": 1.4}, "focused waves need 'focus'"),
        ({"kind": "jonswap", "depth": 0.5, "height": 0.1, "period": 1.4, "components": 1}, "components is 1"),
        ({"kind": "jonswap", "depth": 0.5, "height": 0.1, "period": 1.4, "seed": 1.5}, "seed is 1.5"),
        ({"kind": "jonswap", "depth": 0.5, "height": 0.1, "period": 1.4, "gamma": math.inf}, "gamma is inf"),
    ],
)
def test_waves_that_cannot_be(keys: dict, message: str) -> None:
    with pytest.raises(WaveFault, match=message):
        Waves(**keys)


def test_the_limit_of_miche() -> None:
    assert breaking_height(2 * math.pi, 100.0) == pytest.approx(0.142) and breaking_height(0.01, 1.0) == pytest.approx(0.892, rel=0.01)


def test_second_order_in_deep_water_stays_finite() -> None:
    assert np.isfinite(Waves("second_order", depth=1e4, height=0.05, period=1.4).displacement(3)).all()
