"""Power spectra of series over time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class SpectrumSettings:
    """`segment`: length of a segment [T]; `overlap`: share of a segment that the next one repeats; `window`: hann or rectangle;
    `detrend`: linear or mean."""

    segment: float = 0.0
    overlap: float = 0.5
    window: str = "hann"
    detrend: str = "linear"


@dataclass(frozen=True)
class Spectrum:
    """One-sided power spectral density; its integral over the frequency is the variance of the segments.

    `frequency`: k / segment, k = 0 ... n/2 [1/T]; `density`: [unit^2 T]; `segments`: how many there were.
    """

    frequency: np.ndarray
    density: np.ndarray
    segments: int = 0

    def in_band(self, low: float, high: float) -> np.ndarray:
        """The bins of a band, which leaves out f = 0."""
        inside = (self.frequency >= low) & (self.frequency <= high)
        inside[0] = False
        return inside

    def dominant(self, low: float, high: float) -> float:
        """Frequency of the largest density within a band, refined by a parabola through the logarithms of its neighbours; NaN if all
        densities there are 0. [1/T]"""
        d, f = self.density, self.frequency
        best = int(np.argmax(np.where(self.in_band(low, high) & (d > 0), d, -1.0)))
        if best == 0 or not d[best] > 0 or not self.in_band(low, high)[best]:
            return math.nan
        if best < 2 or best + 1 >= len(d) or not d[best - 1] > 0 or not d[best + 1] > 0:
            return float(f[best])
        a, b, c = np.log(d[best - 1 : best + 2])
        curvature = a - 2 * b + c
        # a band may end beside the top of its slope: then there is no top to refine
        if not curvature < 0 or a > b or c > b:
            return float(f[best])
        return float(f[best] + 0.5 * (a - c) / curvature * f[1])

    def variance(self, low: float, high: float) -> float:
        """Integral of the density over the bins in a band."""
        return float(self.density[self.in_band(low, high)].sum() * self.frequency[1])

    def top(self, low: float, high: float) -> float:
        """The largest density in a band, 0 without one."""
        return max(0.0, float(self.density[self.in_band(low, high)].max(initial=0.0)))


def main_peak(spectra: list[Spectrum], low: float, high: float) -> float:
    """Dominant frequency in a band of the mean of spectra, each over its own variance in the band: series of any units, and those that swing
    little, count as much as others. NaN where none has a variance. [1/T]"""
    whole = np.array([one.variance(low, high) for one in spectra])
    some = [one.density / variance for one, variance in zip(spectra, whole, strict=True) if variance > 0]
    return Spectrum(spectra[0].frequency, np.mean(some, axis=0)).dominant(low, high) if some else math.nan


def _rounded(x: float) -> int:
    """The nearest whole number, halves away from 0."""
    return math.floor(x + 0.5)


def welch(values: np.ndarray, dt: float, settings: SpectrumSettings) -> Spectrum:
    """Welch's method: segments that overlap, each without its trend, times a window; mean of their periodograms.

    values: (n,), dt apart; n must be at least 4. Segments longer than the series are shortened to it. Source: Welch, IEEE Trans.
    Audio Electroacoust. 15 (1967).
    """
    from scipy import signal

    n = min(max(_rounded(settings.segment / dt), 4), len(values))
    step = max(1, _rounded((1 - settings.overlap) * n))
    window, detrend = ("hann" if settings.window == "hann" else "boxcar"), ("linear" if settings.detrend == "linear" else "constant")
    frequency, density = signal.welch(values, 1 / dt, window, nperseg=n, noverlap=n - step, detrend=detrend)
    return Spectrum(frequency, density, (len(values) - n) // step + 1)


def at_equal_steps(t: np.ndarray, values: np.ndarray, longest_gap: float) -> np.ndarray | None:
    """Values at equal steps between the first and the last time, linear between neighbours; NaN are left out.

    None if fewer than four numbers are there or a gap is longer than `longest_gap` [T]. Shapes: (n,).
    """
    there = ~np.isnan(values)
    if there.sum() < 4:
        return None
    times = t[there]
    if max(times[0] - t[0], t[-1] - times[-1], np.diff(times).max()) > longest_gap:
        return None
    at = t[0] + np.arange(len(t)) * ((t[-1] - t[0]) / (len(t) - 1))
    return np.interp(at, times, values[there])
