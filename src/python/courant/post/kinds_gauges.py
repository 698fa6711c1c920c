"""Kinds of analyses at distances from the toe of a jump: gauges, and the correlation of their series."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..diagnostics import Diagnostics
from ..fields import StateFiles, Wanted
from ..key_tables import keys as keys_of_map
from ..words import short_number
from ..yaml_map import Node, YamlMap, as_number, is_list, scalar_text
from .analyses import Analysis, Moments, Run, Settings, TimeWindow, analysis
from .bed import Bed
from .kinds_states import depth_over
from .particles import Points, interpolate, water_on_lines
from .state import State, read_quantities, read_spray, read_where, wanted_of
from .tables import Series


class _Seen(NamedTuple):
    """`values`: (1 + quantities, places), the level of the surface first; NaN where there is no water."""

    values: np.ndarray
    fallbacks: int


_GAUGES = keys_of_map(
    "analysis gauges",
    "kind text!, name text!, of any, toe any, distances positions, x positions, height any, bed text|@bed, surface any, interpolation text, "
    "wet any, where text, link number, share number, from number, to number",
)


@analysis("gauges")
class GaugesAnalysis(Analysis):
    """Level of the surface, and quantities at a height over the bed, at distances from the mean place of the toe, over time.

    As that location is known at the end alone, all of a range of locations is measured, and linear interpolation finds what lies between two of them.
    """

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_GAUGES)
        self.of = read_quantities(keys, self.units) if keys.has("of") else []
        self.which, self.spray, self.window = read_where(keys), read_spray(keys), TimeWindow.read(keys)
        self.toe, self.distances = keys.text("toe", required=True), np.array(keys.places("distances", required=True))
        self.x = np.array(keys.places("x", required=True))
        if len(self.x) < 2 or (np.diff(self.x) <= 0).any():
            hint = "for example {from: -0.3, to: 1.2, step: 0.01}"
            keys.error(keys.get("x") or keys.node, f"'{keys.name}.x' must be two places or more that go upwards", hint)
            self.x = np.array([0.0, 1.0])
        self.height, self.ground = keys.number("height"), Bed.read(keys)
        self.first, self.wet = keys.choice("surface", ("top", "first")) == "first", keys.positive("wet", 0.25)
        self.linear = keys.choice("interpolation", ("mls", "shepard")) == "mls"
        self.bed = np.zeros(len(self.x))
        self.taken: list[np.ndarray] = []
        self.found: list[Series] = []
        self.fallbacks = 0
        if self.ground.known:
            self._lay_bed(keys.diagnostics)

    def _lay_bed(self, diagnostics: Diagnostics) -> None:
        self.bed = self.ground.under(self.x, self.name, self.where, diagnostics)
        self.points = Points(np.column_stack([self.x, self.bed + self.height, np.zeros_like(self.x)]))

    def needs(self) -> list[Wanted]:
        return wanted_of(self.which.of, *(one.of for one in self.of))

    def refers(self) -> list[tuple[str, str]]:
        return [] if as_number(self.toe) is not None else [("toe", self.toe)]

    def begin(self, states: list[StateFiles], diagnostics: Diagnostics) -> None:
        self.ground.find(states, diagnostics)
        if self.ground.parts and diagnostics.ok:
            self._lay_bed(diagnostics)

    def measure(self, state: State) -> _Seen:
        water = state.water(self.which, self.spray)
        places = np.column_stack([self.x, np.zeros_like(self.x), np.zeros_like(self.x)])
        depth = depth_over(water_on_lines(water, places, 1)[0], self.bed, water.largest_h, self.first)
        values = np.full((1 + len(self.of), len(self.x)), np.nan)
        values[0] = np.where(depth > 0, self.bed + depth, np.nan)
        if not self.of:
            return _Seen(values, 0)
        weights = interpolate(water, self.points, self.linear, self.wet)
        wet = weights.colour >= self.wet
        for q, quantity in enumerate(self.of, 1):
            values[q, wet] = weights.of(state.evaluate(quantity.of)[water.row])[wet]
        return _Seen(values, int(weights.fallback.sum()))

    def take(self, t: float, slack: float, measured: _Seen) -> None:
        self.times.append(t)
        self.taken.append(measured.values)
        self.fallbacks += measured.fallbacks

    def series(self) -> list[Series]:
        return self.found

    def _find_toe(self, run: Run) -> float | None:
        """`toe` is a number, or the name of an analysis with a mean toe; a fault is reported, and gives None."""
        number = as_number(self.toe)
        if number is not None:
            return number
        source = self.above(run, self.toe)
        if source is None:
            return None
        mean = next((one.value for one in source.result.scalars if one.name == "toe_mean"), math.nan)
        if math.isfinite(mean):
            return mean
        self.fault(run, f"'{self.toe}' found no toe in its window in time", "kinds toe and jump_type find one")
        return None

    def finish(self, run: Run) -> None:
        inside = self.window.within(np.array(self.times))
        if not inside.any():
            return self.fault_no_state(run)
        toe = self._find_toe(run)
        if toe is None:
            return None
        at = toe + self.distances
        slack = 1e-9 * (self.x[-1] - self.x[0])
        outside = at[(at < self.x[0] - slack) | (at > self.x[-1] + slack)]
        if len(outside):
            message = f"the toe is at x = {toe:.4g} in the mean, so there is a gauge at {outside[0]:.4g}, outside 'x'"
            return self.fault(run, message, f"'x' goes from {self.x[0]:g} to {self.x[-1]:g}")
        self._interpolate(at)
        self.table_over_time()
        return self._write(toe, at, inside)

    def _interpolate(self, at: np.ndarray) -> None:
        k = np.clip(np.searchsorted(self.x, at, "right") - 1, 0, len(self.x) - 2)
        share = np.clip((at - self.x[k]) / (self.x[k + 1] - self.x[k]), 0, 1)
        values = np.array(self.taken)  # (states, 1 + quantities, places)
        between = np.where(share > 0, (1 - share) * values[:, :, k] + share * values[:, :, k + 1], values[:, :, k])
        heads = [("level", self.unit(L=1)), *((one.name, one.unit) for one in self.of)]
        self.found = [
            Series(f"{name}@{short_number(distance)}", unit, float(at[d]), between[:, q, d])
            for q, (name, unit) in enumerate(heads)
            for d, distance in enumerate(self.distances)
        ]

    def _write(self, toe: float, at: np.ndarray, inside: np.ndarray) -> None:
        length, table = self.unit(L=1), self.add_table("mean")
        table.add("distance", length, self.distances)
        table.add("x", length, at)
        for name in dict.fromkeys(one.name.partition("@")[0] for one in self.found):
            some = [one for one in self.found if one.name.partition("@")[0] == name]
            moments = [Moments.of(one.values[inside]) for one in some]
            table.add(f"{name}_mean", some[0].unit, [one.mean_or_nan() for one in moments])
            table.add(f"{name}_deviation", some[0].unit, [one.deviation() for one in moments])
            table.add(f"{name}_wet", "-", [float(one.n) / inside.sum() for one in moments])
        self.add_scalar("toe", length, toe)
        if self.fallbacks:
            self.add_scalar("mls_fallbacks", "-", self.fallbacks)
        self.say(f"  {len(at)} gauges from x = {at.min():.4g} to {at.max():.4g} {length}, toe at {toe:.4g}; means over {inside.sum()} states\n")


_CORRELATION = keys_of_map("analysis correlation", "kind text!, name text!, of any, pairs any, from number, to number")


@analysis("correlation")
class CorrelationAnalysis(Analysis):
    """Pearson's correlation over time between series of another analysis at the same location, over their locations."""

    needs_states = False

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_CORRELATION)
        self.of, self.window = keys.text("of", required=True), TimeWindow.read(keys)
        self.pairs = [self._read_pair(keys, node) for node in keys.list("pairs", required=True)]

    @staticmethod
    def _read_pair(keys: YamlMap, node: Node) -> tuple[str, str]:
        if not is_list(node) or len(node.value) != 2:
            keys.error(node, f"'{keys.name}.pairs': a pair is two names", "for example [[p, vx], [vx, vy]]")
            return "", ""
        return scalar_text(node.value[0]), scalar_text(node.value[1])

    def refers(self) -> list[tuple[str, str]]:
        return [("of", self.of)]

    def finish(self, run: Run) -> None:
        source = self.above(run, self.of)
        if source is None:
            return None
        inside = self.window.within(np.asarray(source.times, dtype=float))
        if not inside.any():
            return self.fault_no_state(run)
        by_place: dict[str, dict[str, Series]] = {}
        for one in source.series():
            name, _, place = one.name.partition("@")
            by_place.setdefault(place, {})[name] = one
        names = list(dict.fromkeys(name for some in by_place.values() for name in some))
        unknown = [name for pair in self.pairs for name in pair if name not in names]
        if unknown:
            return self.fault(run, f"'{self.of}' has no series '{unknown[0]}'", f"it has {', '.join(names)}")
        places = [place for place, some in by_place.items() if all(name in some for pair in self.pairs for name in pair)]
        self._write(places, by_place, inside)
        return None

    def _write(self, places: list[str], by_place: dict[str, dict[str, Series]], inside: np.ndarray) -> None:
        length, table = self.unit(L=1), self.add_table()
        first = self.pairs[0][0]
        table.add("distance", length, [math.nan if (at := as_number(place)) is None else at for place in places])
        table.add("x", length, [by_place[place][first].x for place in places])
        for a, b in self.pairs:
            both = [correlation(by_place[place][a].values[inside], by_place[place][b].values[inside]) for place in places]
            r = np.array([one[0] for one in both])
            table.add(f"r_{a}_{b}", "-", r)
            table.add(f"noise_{a}_{b}", "-", [one[1] for one in both])
            for end, value in (("most", np.nanmax(np.abs(r)) if np.isfinite(r).any() else math.nan), ("first", r[0]), ("last", r[-1])):
                self.add_scalar(f"r_{a}_{b}_{end}", "-", value)
            self.say(f"  {a}, {b}: r = {r[0]:.3f} at {places[0]}, {r[-1]:.3f} at {places[-1]}, at most {np.nanmax(np.abs(r), initial=0):.3f}\n")


def correlation(a: np.ndarray, b: np.ndarray) -> tuple[float, float]:
    """Pearson's r = mean (a - mean a)(b - mean b) / (s_a s_b) over the times at which both have a value, and the standard deviation that r of
    two series without any relation would have, as their values are not independent of each other: the root of 1/N sum_k r_aa(k) r_bb(k).

    a, b: (n,). NaN where fewer than three values are left or one is constant. Source: Bartlett, J. R. Stat. Soc. 98 (1935).
    """
    there = ~(np.isnan(a) | np.isnan(b))
    a, b = a[there] - a[there].mean() if there.any() else a[there], b[there] - b[there].mean() if there.any() else b[there]
    n, scale = len(a), math.sqrt(float((a**2).sum() * (b**2).sum()))
    if n < 3 or not scale > 0:
        return math.nan, math.nan
    r = min(1.0, max(-1.0, float((a * b).sum()) / scale))  # beyond by rounding alone
    own = [np.fft.irfft(np.abs(np.fft.rfft(one, 2 * n)) ** 2, 2 * n)[:n] / (one**2).sum() for one in (a, b)]
    reach = n // 4  # lags beyond are noise
    return r, math.sqrt(max(1.0, 1 + 2 * float((own[0] * own[1])[1:reach].sum())) / n)
