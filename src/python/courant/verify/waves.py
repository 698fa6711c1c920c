"""Numbers of waves out of gauges of level: `kind: waves`, `of: height(w1, w2, w3)`."""
from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np

from .. import wave_analysis as analysis
from ..waves import wave_number
from .model import Observation
from .observe import Measured, NotFound, Run, Window
from .registry import observation
from .series import Series

_FORM = re.compile(r"\s*(\w+)\s*\(([^()]*)\)\s*")


class _Gauges:
    """Levels of gauges in a window: x (n,), t (times,), level (n, times); period, depth and g of the scene."""

    def __init__(self, names: list[str], o: Observation, run: Run) -> None:
        file = run.histories()
        window = Window.of(o, run.variables)
        self.x, self.level, self.t = np.zeros(len(names)), np.zeros((len(names), 0)), np.empty(0)
        rows: list[np.ndarray] = []
        for k, name in enumerate(names):
            path = f"/gauges/{name}/level"
            level, position = file.column(path, 0), file.column(f"/gauges/{name}/position", 0)
            if level is None or position is None:
                there = sorted({one.split("/")[2] for one in file.names if one.startswith("/gauges/")})
                raise NotFound(f"no gauge '{name}': there are {', '.join(there) or 'none'}")
            t = file.times_of(path)
            if k == 0:
                some = (t >= window.start) & (t <= window.end)
                self.t = t[some]
            if len(self.t) < 8 or t[0] > self.t[0] or t[-1] < self.t[-1]:
                raise NotFound(f"gauge '{name}' has fewer than eight rows in the window")
            if np.isnan(level[(t >= self.t[0]) & (t <= self.t[-1])]).any():
                raise NotFound(f"gauge '{name}' falls dry in the window")
            rows.append(np.interp(self.t, t, level))
            self.x[k] = float(np.nanmean(position))
        self.level = np.array(rows)
        self.g = float(run.variables.get("g", 9.81))
        self.variables = run.variables

    def number(self, name: str) -> float:
        if name not in self.variables:
            raise NotFound(f"kind waves needs the parameter '{name}' of the scene")
        return float(self.variables[name])

    def first(self) -> tuple[np.ndarray, float]:
        """Amplitudes of two harmonics, and the wave number of the first as measured by three gauges or more, else of linear theory."""
        omega = 2 * math.pi / self.number("period")
        found = analysis.amplitudes(self.t, self.level, omega, 2)
        k = float(wave_number(omega, self.number("depth"), self.g))
        return found, analysis.measured_wave_number(self.x, found[:, 0], k) if len(self.x) > 2 else k


def _height(of: _Gauges) -> float:
    found, k = of.first()
    return 2 * abs(analysis.separated(of.x, found[:, 0], k).incident)


def _reflection(of: _Gauges) -> float:
    found, k = of.first()
    return analysis.separated(of.x, found[:, 0], k).reflection


def _celerity(of: _Gauges) -> float:
    """Over that of Stokes' third order for the height measured."""
    found, k = of.first()
    height = 2 * abs(analysis.separated(of.x, found[:, 0], k).incident)
    return analysis.stokes_wave_number(height, of.number("period"), of.number("depth"), of.g) / k


def _free_second(of: _Gauges) -> float:
    found, k = of.first()
    free = float(wave_number(4 * math.pi / of.number("period"), of.number("depth"), of.g))
    second = analysis.second_harmonic(of.x, found[:, 1], k, free)
    return second.free / second.bound


def _kept(of: _Gauges) -> float:
    """Of the height, in one wave length: from the first half of the gauges to the second."""
    found, k = of.first()
    half = len(of.x) // 2
    first, last = (analysis.separated(of.x[some], found[some, 0], k) for some in (slice(None, half), slice(half, None)))
    apart = (of.x[half:].mean() - of.x[:half].mean()) * k / (2 * math.pi)
    return float((abs(last.incident) / abs(first.incident)) ** (1 / apart))


_NUMBERS: dict[str, Callable[[_Gauges], float]] = {
    "height": _height,
    "reflection": _reflection,
    "celerity": _celerity,
    "free_second": _free_second,
    "kept": _kept,
    "significant_height": lambda of: analysis.significant_height(of.level[0]),
    "peak_period": lambda of: analysis.peak_period(of.t, of.level[0], 0.4 / of.number("period"), 4 / of.number("period")),
    "crest": lambda of: float(of.level[0].max()) - of.number("depth"),
}


@observation("waves", of="gauges")
def waves(o: Observation, run: Run) -> Measured:
    """A number out of the levels of gauges in the window."""
    form = _FORM.fullmatch(o.of)
    if not form or form[1] not in _NUMBERS:
        raise NotFound(f"'{o.of}' is no NUMBER(GAUGE, ...) with a number of {', '.join(_NUMBERS)}")
    names = [one.strip() for one in form[2].split(",") if one.strip()]
    of = _Gauges(names, o, run)
    try:
        value = _NUMBERS[form[1]](of)
    except analysis.WaveFaultInRecord as fault:
        raise NotFound(str(fault)) from None
    return Measured(True, series=Series(np.array([of.t[-1]]), np.array([value])), value=value)
