"""What gauges of level measured of waves: heights, periods, waves that come back, free and bound harmonics.

All take series on a common axis of times; `level`: (gauges, times) [L].
"""
from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .waves import wave_number


class WaveFaultInRecord(ValueError):
    """A record that has no such number; the text says why."""


def amplitudes(t: np.ndarray, level: np.ndarray, omega: float, harmonics: int = 3) -> np.ndarray:
    """Complex amplitudes A_n of level = mean + Re sum A_n exp(-i n omega t), by least squares, (gauges, harmonics) [L]."""
    t, level = np.asarray(t, dtype=float), np.atleast_2d(level)
    if len(t) < 2 * harmonics + 2 or not np.ptp(t) > 0.99 * 2 * math.pi / omega:
        raise WaveFaultInRecord("the record is shorter than a period of the waves")
    n = np.arange(1, harmonics + 1)
    phase = omega * t[:, None] * n[None]
    terms = np.hstack([np.ones((len(t), 1)), np.cos(phase), np.sin(phase)])
    fit = np.linalg.lstsq(terms, level.T, rcond=None)[0]
    found: np.ndarray = (fit[1 : harmonics + 1] + 1j * fit[harmonics + 1 :]).T
    return found


class Separated(NamedTuple):
    """Complex amplitudes of waves along x and against it, at x = 0 [L]."""

    incident: complex
    reflected: complex

    @property
    def reflection(self) -> float:
        return abs(self.reflected) / abs(self.incident)


def separated(x: np.ndarray, amplitude: np.ndarray, k: float) -> Separated:
    """Waves of one frequency in both directions, by least squares over the gauges at x, (n,) [L].

    Source: Mansard and Funke, Proc. 17th Int. Conf. Coastal Eng. (1980), 154.
    """
    x = np.asarray(x, dtype=float)
    terms = np.column_stack([np.exp(1j * k * x), np.exp(-1j * k * x)])
    if len(x) < 2 or np.linalg.cond(terms) > 1e3:
        raise WaveFaultInRecord("the gauges are half a wave length apart, or there is but one: they do not separate the waves")
    a, b = np.linalg.lstsq(terms, np.asarray(amplitude), rcond=None)[0]
    return Separated(complex(a), complex(b))


def measured_wave_number(x: np.ndarray, amplitude: np.ndarray, guess: float) -> float:
    """The wave number within a fifth of `guess` at which waves in both directions explain the gauges best. [1/L]"""
    x = np.asarray(x, dtype=float)

    def lacks(k: float) -> float:
        terms = np.column_stack([np.exp(1j * k * x), np.exp(-1j * k * x)])
        fit = np.linalg.lstsq(terms, amplitude, rcond=None)[0]
        return float((np.abs(terms @ fit - amplitude) ** 2).sum())

    tried = np.linspace(0.8 * guess, 1.2 * guess, 801)
    sizes = np.array([lacks(float(k)) for k in tried])
    best = int(np.argmin(sizes))
    if len(x) < 3 or best in (0, len(tried) - 1):
        raise WaveFaultInRecord("no wave number near that of linear theory: three gauges or more within a wave length show one")
    a, b, c = sizes[best - 1 : best + 2]
    return float(tried[best] + 0.5 * (tried[1] - tried[0]) * (a - c) / (a - 2 * b + c))


class SecondHarmonic(NamedTuple):
    """Amplitudes at twice the frequency: bound to the wave, and free along x and against it [L]."""

    bound: float
    free: float
    free_back: float


def second_harmonic(x: np.ndarray, amplitude: np.ndarray, k: float, k_free: float) -> SecondHarmonic:
    """`amplitude`: (n,) of the second harmonic; `k`: wave number of the first, whose bound harmonic has 2 k; `k_free`: that of waves of twice the frequency."""
    x = np.asarray(x, dtype=float)
    terms = np.column_stack([np.exp(2j * k * x), np.exp(1j * k_free * x), np.exp(-1j * k_free * x)])
    if len(x) < 4 or np.linalg.cond(terms) > 1e3:
        raise WaveFaultInRecord("free and bound harmonics need four gauges or more over a beat of theirs")
    return SecondHarmonic(*np.abs(np.linalg.lstsq(terms, np.asarray(amplitude), rcond=None)[0]).tolist())


def significant_height(level: np.ndarray) -> float:
    """H_m0, four standard deviations of the level. [L]"""
    return 4 * float(np.std(level))


def peak_period(t: np.ndarray, level: np.ndarray, lowest: float = 0.0, highest: float = math.inf) -> float:
    """T_p of the centroid of the spectrum to its fourth power, within frequencies `lowest` to `highest`. [T]

    Source: Young, Ocean Eng. 22 (1995), eq. 3.
    """
    t = np.asarray(t, dtype=float)
    n = len(t)
    even = np.linspace(t[0], t[-1], n)
    values = np.interp(even, t, level)
    values = (values - values.mean()) * np.hanning(n)
    f, density = np.fft.rfftfreq(n, even[1] - even[0]), np.abs(np.fft.rfft(values)) ** 2
    width = max(1, n // 2 // 400)
    bands = max(1, round(0.0 + 5 * width))
    density = np.convolve(density, np.ones(bands) / bands, "same")
    some = (f >= max(lowest, f[1])) & (f <= highest)
    weights = density[some] ** 4
    if not weights.sum() > 0:
        raise WaveFaultInRecord("the level does not change")
    return float(weights.sum() / (f[some] * weights).sum())


def stokes_wave_number(height: float, period: float, depth: float, g: float = 9.81) -> float:
    """Wave number by Stokes' third order in a closed flume, where no volume flows in the mean: c = omega/k - g a^2/(2 c d) in water that moves. [1/L]

    Source: Dean and Dalrymple (1991), eq. 11.37 for the dispersion; section 10.2 for the mass transport that flows back.
    """
    omega, a = 2 * math.pi / period, height / 2
    k = float(wave_number(omega, depth, g))
    for _ in range(100):
        kd, tanh = k * depth, math.tanh(k * depth)
        third = (k * a) ** 2 * (8 + math.cosh(4 * kd) - 2 * tanh**2) / (8 * math.sinh(kd) ** 4)
        c = math.sqrt(g * tanh / k) * math.sqrt(1 + third)
        back = g * a * a / (2 * c * depth)
        k += 0.5 * (omega / (c - back) - k)
    return k


def regular(x: np.ndarray, t: np.ndarray, level: np.ndarray, period: float, depth: float, g: float = 9.81) -> tuple[Separated, SecondHarmonic | None, float]:
    """First harmonic in both directions, the second one, and the wave number measured, of regular waves of a known period."""
    omega = 2 * math.pi / period
    found = amplitudes(t, level, omega, 2)
    linear = float(wave_number(omega, depth, g))
    k = measured_wave_number(x, found[:, 0], linear)
    try:
        second = second_harmonic(x, found[:, 1], k, float(wave_number(2 * omega, depth, g)))
    except WaveFaultInRecord:
        second = None
    return separated(x, found[:, 0], k), second, k
