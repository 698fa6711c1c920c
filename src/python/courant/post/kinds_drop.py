"""Kinds of analyses of a jump at an abrupt drop: jump_type and drop_regime. The rule and the momentum bounds are in post/drop.py."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..diagnostics import Diagnostics
from ..fields import StateFiles, Wanted
from ..key_tables import keys as keys_of_map
from ..variables import wanted_array
from ..yaml_map import YamlMap
from .analyses import Analysis, Moments, Run, Settings, TimeWindow, analysis
from .bed import Bed
from .drop import TYPES, Cycles, TypeRule, cycles_of, momentum_bounds, regime_of, shares_of, types_over_time
from .jump import froude
from .kinds_series import toe_of
from .kinds_states import depth_over
from .particles import ParticleSet, water_on_lines
from .state import State, read_spray, read_where, wanted_of
from .tables import Series

_LAYER = 0.25  # of the depth: what counts as at the bed and at the surface
_LEAST_STRIPS = 0.5  # share of the strips behind the step that must have both layers


class _Seen(NamedTuple):
    """`across`: (strips,) (u_bed - u_surface)/V1 in strips of the length y1 from the step on, NaN where a layer is dry; `level`: (places,) of
    the surface [L], NaN where it is dry."""

    across: np.ndarray
    level: np.ndarray


_JUMP_TYPE = keys_of_map(
    "analysis jump_type",
    "kind text!, name text!, step any, y1 any, v1 any, bed text|@bed, x positions, behind any, toe any, jet any, upstream any, band any, "
    "average any, where text, link number, share number, from number, to number",
)


@analysis("jump_type")
class JumpTypeAnalysis(Analysis):
    """Where the jet goes behind a step and where the toe is, and which type of jump that is, over time."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_JUMP_TYPE)
        self.which, self.spray, self.window = read_where(keys), read_spray(keys), TimeWindow.read(keys)
        self.y1, self.v1 = keys.positive("y1", 1, required=True), keys.positive("v1", 1, required=True)
        self.step, self.ground = keys.number("step"), Bed.read(keys)
        low, high = keys.range("x", required=True) or (0.0, 1.0)
        self.behind = keys.range("behind") or (2.0, 12.0)
        self.threshold = keys.positive("toe", 1.5)
        self.rule = TypeRule(keys.positive("jet", 0.15), keys.number("upstream", 1.0), keys.number("band", 0.25))
        self.average = keys.number("average")
        if not low < self.step < high or self.step + self.behind[1] * self.y1 > high + 1e-9 * self.y1:
            message = f"'{keys.name}.x' must reach from upstream of the step to {self.step + self.behind[1] * self.y1:g}, the end of 'behind'"
            keys.error(keys.get("x") or keys.node, message)
        self.x = np.linspace(low, high, min(100_000, math.ceil((high - low) / (0.25 * self.y1))) + 1)
        self.bed = np.zeros(len(self.x))
        self.taken: list[_Seen] = []
        self.J = self.toe = self.types = np.empty(0)
        if self.ground.known:
            self._lay_bed(keys.diagnostics)

    def _lay_bed(self, diagnostics: Diagnostics) -> None:
        self.bed = self.ground.under(self.x, self.name, self.where, diagnostics)
        self.upper = float(self.ground.at(np.array([self.step - 0.01 * self.y1]))[0])

    def needs(self) -> list[Wanted]:
        return [*wanted_of(self.which.of), wanted_array("velocity")]

    def begin(self, states: list[StateFiles], diagnostics: Diagnostics) -> None:
        self.ground.find(states, diagnostics)
        if self.ground.parts and diagnostics.ok:
            self._lay_bed(diagnostics)

    def measure(self, state: State) -> _Seen:
        water = state.water(self.which, self.spray)
        places = np.column_stack([self.x, np.zeros_like(self.x), np.zeros_like(self.x)])
        depth = depth_over(water_on_lines(water, places, 1)[0], self.bed, water.largest_h)
        across = self._across(water, state.frame.arrays["velocity"][water.row, 0], depth)
        return _Seen(across, np.where(depth > 0, self.bed + depth, np.nan))

    def _across(self, water: ParticleSet, u: np.ndarray, depth: np.ndarray) -> np.ndarray:
        strip = np.floor((water.x[:, 0] - self.step) / self.y1).astype(int)
        count = math.floor((self.x[-1] - self.step) / self.y1 + 1e-9)
        height = np.interp(water.x[:, 0], self.x, depth)
        share = (water.x[:, 1] - self.ground.at(water.x[:, 0])) / np.where(height > 0, height, np.nan)
        means = []
        for layer in (share < _LAYER, share > 1 - _LAYER):
            on = layer & (strip >= 0) & (strip < count)
            V = np.bincount(strip[on], water.V[on], count)
            with np.errstate(invalid="ignore"):
                means.append(np.bincount(strip[on], water.V[on] * u[on], count) / np.where(V > 0, V, np.nan))
        return (means[0] - means[1]) / self.v1

    def _jet(self, across: np.ndarray, toe: float) -> float:
        """J: mean over the strips that begin behind the step and the toe; NaN where too few have water in both layers.

        Upstream of the toe the jet has a surface of its own, fast above and with the dead water of the step below, whichever type it comes to.
        """
        first, last = self.behind
        begin = first if math.isnan(toe) else max(first, (toe - self.step) / self.y1)
        low = round(begin)
        found = across[low : low + max(1, round(last - first))]
        there = ~np.isnan(found)
        return float(found[there].mean()) if there.sum() >= max(1, _LEAST_STRIPS * (last - first)) else math.nan

    def take(self, t: float, slack: float, measured: _Seen) -> None:
        self.times.append(t)
        self.taken.append(measured)

    def series(self) -> list[Series]:
        return [Series("J", "-", math.nan, self.J), Series("toe", self.unit(L=1), math.nan, self.toe)]

    def finish(self, run: Run) -> None:
        t = np.array(self.times)
        inside = self.window.within(t)
        if not inside.any():
            return self.fault_no_state(run)
        level = np.array([one.level for one in self.taken]).T
        self.toe = sustained_toe(self.x, level, self.upper + self.threshold * self.y1, self.y1)
        self.J = np.array([self._jet(one.across, toe) for one, toe in zip(self.taken, self.toe.tolist(), strict=True)])
        J, toe = moving_mean(t, self.J, self.average), moving_mean(t, self.toe, self.average)
        self.types = types_over_time(J, (self.step - toe) / self.y1, self.rule)
        table = self.table_over_time()
        if self.average > 0:
            table.add("J_averaged", "-", J)
            table.add("toe_averaged", self.unit(L=1), toe)
        table.add("type", "-", self.types.astype(float))
        self.add_moments(inside)
        return self._write(t[inside], self.types[inside])

    def _write(self, t: np.ndarray, types: np.ndarray) -> None:
        shares, cycles, time = shares_of(t, types), cycles_of(t, types), self.unit(T=1)
        table = self.add_table("switches")
        for name, unit, k in (("t", time, 0), ("before", "-", 1), ("after", "-", 2)):
            table.add(name, unit, np.array([one[k] for one in cycles.switches], dtype=float))
        for name, share in zip(TYPES, shares, strict=True):
            self.add_scalar(f"share_{name.replace('-', '_')}", "-", share)
        period = Moments.of(cycles.periods)
        for name, unit, value in (
            ("switches", "-", len(cycles.switches)),
            ("cycles", "-", len(cycles.periods)),
            ("period_mean", time, period.mean_or_nan()),
            ("period_deviation", time, period.deviation()),
        ):
            self.add_scalar(name, unit, value)
        self.result.words["regime"] = regime_of(shares)
        self._tell(shares, cycles, period, time)

    def _tell(self, shares: np.ndarray, cycles: Cycles, period: Moments, time: str) -> None:
        parts = ", ".join(f"{name} {100 * share:.0f} %" for name, share in zip(TYPES, shares, strict=True) if share > 0)
        found = {one.name: one.value for one in self.result.scalars}
        self.say(
            f"  {self.result.words['regime']}: {parts}\n  J: mean {found['J_mean']:.3f}, deviation {found['J_deviation']:.3f}; toe at x = "
            f"{found['toe_mean']:.4g} {self.units.length}, deviation {found['toe_deviation']:.3g}\n"
        )
        for one in cycles.switches:
            self.say(f"  t = {one.t:.4g} {time}: {TYPES[one.before]} -> {TYPES[one.after]}\n")
        if len(cycles.periods):
            self.say(f"  {len(cycles.periods)} cycles, period {period.mean_or_nan():.4g} {time}, deviation {period.deviation():.3g}\n")
        else:
            self.say(f"  no whole cycle; a cycle began {len(cycles.starts)} times\n")


def sustained_toe(x: np.ndarray, level: np.ndarray, threshold: float, over: float) -> np.ndarray:
    """Most upstream place from which on the surface is over a level for a distance `over` [L]: a drop over the jet is no toe.

    x: (places,) at equal steps; level: (places, states), NaN where it is dry. Linear in between; NaN: nowhere. Shape (states,).
    """
    long = max(1, round(over / (x[1] - x[0])))
    high = np.nan_to_num(level, nan=-np.inf) > threshold
    stays = high.copy()
    for k in range(1, long):
        stays[:-k] &= high[k:]
    # before the location where it stays over the level it is under it, so that the first crossing of what is left is the toe
    kept = np.where(np.logical_or.accumulate(stays, axis=0), level, np.fmin(np.nan_to_num(level, nan=threshold), threshold))
    return toe_of(x, kept, threshold, level.shape[1])


def moving_mean(t: np.ndarray, values: np.ndarray, width: float) -> np.ndarray:
    """Mean of the values within width/2 to both sides; NaN is left out, and stays NaN. Shapes: (n,)."""
    if not width > 0 or len(t) < 2:
        return values
    there = ~np.isnan(values)
    low, high = np.searchsorted(t, t - 0.5 * width - 1e-9 * width), np.searchsorted(t, t + 0.5 * width + 1e-9 * width)
    sums, count = np.append(0, np.cumsum(np.where(there, values, 0))), np.append(0, np.cumsum(there))
    out = np.full(len(t), np.nan)
    out[there] = ((sums[high] - sums[low]) / np.maximum(1, count[high] - count[low]))[there]
    return out


REGIMES = ("undecided", "A-jump", "B-jump", "A-wave", "B-wave", "wave jump", "A-B", "A-B-wave")  # their locations are the numbers in tables


_TEST = keys_of_map("test of a drop", "name text!, y1 number!, yt number!, v1 number!, height number, type text")
_DROP_REGIME = keys_of_map("analysis drop_regime", "kind text!, name text!, y1 any, yt any, v1 any, height any, g any, types any, tests any, F1 any")


@analysis("drop_regime")
class DropRegimeAnalysis(Analysis):
    """Froude number and tailwater depth of a run, and of tests beside it, between the momentum bounds of a B-jump and an A-jump."""

    needs_states = False

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_DROP_REGIME)
        self.y1, self.yt, self.v1 = (keys.positive(key, 1, required=True) for key in ("y1", "yt", "v1"))
        self.height, self.g = keys.positive("height", 1, required=True), keys.positive("g", 9.81)
        self.types, self.range = keys.text("types"), keys.range("F1") or (2.0, 5.0)
        self.tests = [self._read_test(keys.element(node, "tests")) for node in keys.list("tests")]

    def _read_test(self, keys: YamlMap) -> list[float]:
        keys.allow(*_TEST)
        y1, yt, v1 = (keys.positive(key, 1, required=True) for key in ("y1", "yt", "v1"))
        return [*self._numbers(y1, yt, v1, keys.positive("height", self.height)), float(REGIMES.index(keys.choice("type", REGIMES)))]

    def refers(self) -> list[tuple[str, str]]:
        return [("types", self.types)] if self.types else []

    def _numbers(self, y1: float, yt: float, v1: float, height: float) -> list[float]:
        F1 = froude(v1, y1, self.g)
        B, A = momentum_bounds(F1, height / y1)
        return [F1, yt / y1, height / y1, B, A, (yt / y1 - B) / (A - B)]

    def finish(self, run: Run) -> None:
        heads = ("F1", "Y", "s_y1", "Y_B", "Y_A", "place")
        here, regime = self._numbers(self.y1, self.yt, self.v1, self.height), "undecided"
        if self.types:
            source = self.above(run, self.types)
            if source is None:
                return
            regime = source.result.words.get("regime", regime)
        table = self.add_table()
        for name, value in (*zip(heads, here, strict=True), ("type", float(REGIMES.index(regime)))):
            table.add(name, "-", [value])
            if name != "type":
                self.add_scalar(name, "-", value)
        table, F1 = self.add_table("bounds"), np.linspace(*self.range, 101)
        both = np.array([momentum_bounds(F, self.height / self.y1) for F in F1])
        for name, values in (("F1", F1), ("Y_B", both[:, 0]), ("Y_A", both[:, 1])):
            table.add(name, "-", values)
        table, rows = self.add_table("tests"), np.array(self.tests).reshape(len(self.tests), 7)
        for c, name in enumerate((*heads, "type")):
            table.add(name, "-", rows[:, c])
        self.say(
            f"  F1 = {here[0]:.3f}, yt/y1 = {here[1]:.3f}: momentum asks {here[3]:.3f} of a B-jump and {here[4]:.3f} of an A-jump, so it is at "
            f"{here[5]:.2f} of the way from B to A; {regime}\n"
        )
