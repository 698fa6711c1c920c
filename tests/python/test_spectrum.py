"""Power spectra of signals whose spectrum is known."""

from __future__ import annotations

import math

import numpy as np
import pytest
from courant.post.spectrum import SpectrumSettings, at_equal_steps, welch
from made_runs import scatter


def wave(f, amplitude, n, dt=0.01):
    return amplitude * np.sin(2 * np.pi * f * dt * np.arange(n) + 0.3)


@pytest.mark.parametrize("f", [1.0, 3.5, 4.27])
def test_frequency_and_variance_of_a_sine(f):
    s = welch(wave(f, 0.01, 1500), 0.01, SpectrumSettings(segment=5))
    assert s.segments == 5  # 15 s in segments of 5 s that overlap by half
    assert s.frequency[1] == pytest.approx(0.2) and s.dominant(0.2, 20) == pytest.approx(f, abs=0.02)  # a tenth of the resolution
    assert s.variance(0, 50) == pytest.approx(0.5e-4, abs=0.01e-4) == s.variance(f - 0.7, f + 0.7)


@pytest.mark.parametrize("window", ["hann", "rectangle"])
@pytest.mark.parametrize("n", [100, 101])
def test_noise_is_flat_and_keeps_its_variance(window, n):
    s = welch(scatter(20000), 0.01, SpectrumSettings(segment=0.01 * n, window=window))
    assert len(s.density) == n // 2 + 1
    assert s.variance(0, 51) == pytest.approx(1 / 12, abs=0.003)
    assert s.variance(10, 20) / s.variance(30, 40) == pytest.approx(1, abs=0.05)


def test_a_parseval_sum_of_one_segment():
    values = scatter(64)
    for n in (63, 64):  # the highest bin of an even n represents itself alone
        s = welch(values[:n], 0.5, SpectrumSettings(segment=1e9, window="rectangle", detrend="mean"))
        assert s.segments == 1 and s.variance(0, 10) == pytest.approx(values[:n].var(), rel=1e-12)


def test_trends_are_taken_away():
    values = wave(3, 0.01, 1000) + 5 + 0.01 * np.arange(1000)
    s = welch(values, 0.01, SpectrumSettings(segment=5))
    assert s.dominant(0, 50) == pytest.approx(3, abs=0.02) and s.variance(0, 50) == pytest.approx(0.5e-4, abs=0.02e-4)
    assert welch(values, 0.01, SpectrumSettings(segment=5, detrend="mean")).variance(0, 50) > 0.1  # the saw teeth of the trend


def test_the_band_chooses_the_peak():
    s = welch(wave(1, 0.02, 2000) + wave(6, 0.01, 2000), 0.01, SpectrumSettings(segment=5))
    assert s.dominant(0, 50) == pytest.approx(1, abs=0.02) and s.dominant(3, 50) == pytest.approx(6, abs=0.02)
    assert s.dominant(3, 5.9) <= 5.9 and s.top(0, 50) > s.top(3, 50) > s.top(20, 50)
    assert math.isnan(welch(np.zeros(100), 0.01, SpectrumSettings(segment=1)).dominant(0, 50))
    assert math.isnan(s.dominant(60, 70))


def test_gaps_and_uneven_times():
    t = 0.01 * np.arange(101)
    t[1:-1] += 0.002 * scatter(99)
    values = np.where(np.arange(101) % 7 == 3, np.nan, 2 + 3 * t)
    assert at_equal_steps(t, values, 0.05) == pytest.approx(2 + 0.03 * np.arange(101), abs=1e-12)
    values[40:50] = np.nan
    assert at_equal_steps(t, values, 0.05) is None and at_equal_steps(t, values, 0.2) is not None
    assert at_equal_steps(t, np.full(101, np.nan), 1) is None
