"""Waves of a piston: what theory says of wave numbers, strokes, spectra and limits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from courant.waves import WaveFault, Waves, breaking_height, flap_transfer, piston_transfer, second_order_piston, wave_number


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


def madsen(made: Waves) -> float:
    """Amplitude of the second harmonic of a piston in long waves: Madsen, J. Geophys. Res. 76 (1971), eq. 27."""
    kd = made.wave * made.depth
    return made.height**2 / (32 * made.depth) * (3 * math.cosh(kd) / math.sinh(kd) ** 3 - 2 / float(piston_transfer(kd)))


def test_second_order_adds_a_harmonic_which_for_long_waves_is_that_of_madsen() -> None:
    one, two = Waves("regular", depth=0.4, height=0.002, period=8.0, ramp=0), Waves("second_order", depth=0.4, height=0.002, period=8.0, ramp=0)
    t, x = two.displacement(16).T
    extra = x - one.displacement(16)[:, 1]
    phase = 2 * one.omega * t
    expected = madsen(two) * np.sin(phase)
    assert np.abs(extra - extra.mean() - expected + expected.mean()).max() < 3e-3 * madsen(two)
    with pytest.raises(WaveFault, match="second order holds"):
        Waves("second_order", depth=0.1, height=0.05, period=4.0).displacement(10)


@pytest.mark.parametrize("period", [1.0, 1.6, 2.5])
def test_second_order_leaves_no_free_wave_at_the_piston(period: float) -> None:
    """What the wall condition of second order asks of the free mode, by quadrature over the depth: with X2 nothing."""
    d, g, half_stroke, omega = 0.4, 9.81, 0.03, 2 * math.pi / period
    x2 = second_order_piston(omega, d, half_stroke, g, terms=40)
    k = np.array([float(wave_number(omega, d, g)) + 0j, *(1j * one for one in fading(omega, d, g, 40))])
    s, weights = np.polynomial.legendre.leggauss(400)
    s, weights = 0.5 * d * (s + 1), 0.5 * d * weights  # height above the bed
    shape = np.cosh(k[:, None] * s) / np.cosh(k * d)[:, None]
    stroke = 1j * half_stroke
    # of first order: phi_x = dX/dt at the wall, each mode by its projection
    a = -1j * omega * stroke * (shape @ weights) / (1j * k * ((shape**2) @ weights))
    free = float(wave_number(2 * omega, d, g))
    mode = np.cosh(free * s) / math.cosh(free * d)
    wall = -2j * omega * x2 + 0.5 * stroke * (a * k**2) @ shape
    nu = omega**2 / g
    for i in range(len(k)):
        for j in range(len(k)):
            q = k[i] + k[j]
            # surface condition: phi_tt + g phi_z = - d/dt |grad phi1|^2 - eta1 d/dz (phi1_tt + g phi1_z)
            forced = 1j * omega * a[i] * a[j] * (nu**2 - k[i] * k[j]) - 0.5j * omega * a[i] * a[j] * (k[j] ** 2 - nu**2)
            amplitude = forced / (-4 * omega**2 + g * q * np.tanh(q * d))
            wall = wall - 1j * q * amplitude * np.cosh(q * s) / np.cosh(q * d)
    assert abs((wall * mode) @ weights) < 1e-6 * abs(2 * omega * x2 * (mode @ weights))
    assert abs(x2) > 1.2 * abs(madsen(Waves("regular", d, 2 * half_stroke * float(piston_transfer(k[0].real * d)), period))) or period > 2


def fading(omega: float, d: float, g: float, count: int) -> list[float]:
    """Wave numbers of the modes that fade, by bisection of omega^2 cos(k d) + g k sin(k d)."""
    found = []
    for j in range(1, count + 1):
        low, high = (j - 0.5) * math.pi / d, j * math.pi / d
        for _ in range(100):
            middle = 0.5 * (low + high)
            side = (omega**2 * math.cos(middle * d) + g * middle * math.sin(middle * d)) * (omega**2 * math.cos(high * d) + g * high * math.sin(high * d))
            low, high = (low, middle) if side > 0 else (middle, high)
        found.append(0.5 * (low + high))
    return found


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
