"""Kind of analysis: toe."""

from __future__ import annotations

import math

import numpy as np

from ..yaml_map import YamlMap
from .analysis import Analysis, Moments, Run, Settings, TimeWindow, analysis
from .tables import Series


@analysis("toe")
class ToeAnalysis(Analysis):
    """Where the surface first rises over a threshold, over time."""

    needs_states = False

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow("kind", "name", "of", "depth", "x", "from", "to")
        self.of, self.depth = keys.text("of", required=True), keys.positive("depth", required=True)
        self.range = keys.range("x") or (-math.inf, math.inf)
        self.window = TimeWindow.read(keys)
        self.toe = np.empty(0)

    def refers(self) -> list[tuple[str, str]]:
        return [("of", self.of)]

    def series(self) -> list[Series]:
        return [Series("toe", self.unit(L=1), math.nan, self.toe)]

    def finish(self, run: Run) -> None:
        source = self.above(run, self.of)
        if source is None:
            return None
        if source.kind != "surface":
            return self.fault(run, f"'{self.of}' is no surface but a {source.kind}")
        self.times = np.array(source.times)
        if not self.window.within(self.times).any():
            return self.fault_no_state(run)
        used = [one for one in source.series() if self.range[0] <= one.x <= self.range[1]]
        self.toe = toe_of(np.array([one.x for one in used]), np.array([one.values for one in used]), self.depth, len(self.times))
        return self._write()

    def _write(self) -> None:
        length, speed = self.unit(L=1), self.unit(L=1, T=-1)
        table = self.add_table()
        table.add("t", self.unit(T=1), self.times)
        table.add("toe", length, self.toe)
        used = self.window.within(self.times) & ~np.isnan(self.toe)
        x, t = Moments.of(self.toe[used]), Moments.of(self.times[used])
        product = ((self.toe[used] - x.mean) * (self.times[used] - t.mean)).sum()
        slope = product / float(t.squares) if t.squares > 0 else math.nan
        for name, unit, value in (("toe_mean", length, x.mean_or_nan()), ("toe_deviation", length, x.deviation()), ("toe_speed", speed, slope)):
            self.add_scalar(name, unit, value)
        self.say(
            f"  toe (depth over {self.depth:g} {length}): mean x = {x.mean_or_nan():.4g} {length}, deviation {x.deviation():.3g}, "
            f"drift {slope:.3g} {speed}\n"
        )


def toe_of(x: np.ndarray, depth: np.ndarray, threshold: float, states: int) -> np.ndarray:
    """The first crossing of a threshold along x in each state, linear between the places; NaN: nowhere. Shape (states,) [L].

    x: (places,), depth: (places, states) [L].
    """
    out = np.full(states, np.nan)
    if len(x) == 0:
        return out
    over = depth > threshold
    first, state = over.argmax(axis=0), np.arange(states)
    met = over.any(axis=0)
    out[met & (first == 0)] = x[0]
    between = np.flatnonzero(met & (first > 0))
    k = first[between]
    a, b = depth[k - 1, state[between]], depth[k, state[between]]
    out[between] = x[k - 1] + (threshold - a) / (b - a) * (x[k] - x[k - 1])
    return out
