"""Kinds of analyses of what a run keeps: mass_balance between two planes, and soundness (Mach number, density, leaks)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..fields import Wanted
from ..key_tables import keys as keys_of_map
from ..results import Results
from ..variables import wanted_array
from ..yaml_map import YamlMap
from .analyses import Analysis, Moments, Run, Settings, TimeWindow, analysis
from .particles import pairs_near, spline_norm, spline_shape
from .state import State, read_where, wanted_of
from .tables import Series


class _Seen(NamedTuple):
    dim: int
    inflow: float
    outflow: float
    mass: float


def _share_past(q: np.ndarray) -> np.ndarray:
    """Integral of the one-dimensional cubic spline up to a distance q = x/h: 0 up to -2, 1 from 2 on; (n,)."""
    a = np.abs(q)
    upper = np.where(a < 1, 0.5 + (a - a**3 / 2 + 3 * a**4 / 16) * 2 / 3, 1 - np.maximum(2 - a, 0) ** 4 / 24)
    return np.where(q < 0, 1 - upper, upper)


_MASS_BALANCE = keys_of_map("analysis mass_balance", "kind text!, name text!, normal any, at any, where text, expected any, from number, to number")


@analysis("mass_balance")
class MassBalanceAnalysis(Analysis):
    """Mass that flows in through one plane and out through another one, and what is stored in between."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_MASS_BALANCE)
        self.which, self.window = read_where(keys), TimeWindow.read(keys)
        self.normal = "xyz".index(keys.choice("normal", ("x", "y", "z")))
        self.planes = np.array(keys.range("at", required=True) or (0.0, 1.0))
        self.expected = keys.positive("expected", math.nan) if keys.has("expected") else math.nan
        self.taken: list[_Seen] = []

    def needs(self) -> list[Wanted]:
        return [*wanted_of(self.which.of), wanted_array("velocity"), wanted_array("mass")]

    def measure(self, state: State) -> _Seen:
        some, arrays = state.selection(self.which), state.frame.arrays
        x, m, v = some.x[:, self.normal], arrays["mass"][some.row], arrays["velocity"][some.row, self.normal]
        plane, k = pairs_near(x, np.argsort(x, kind="stable"), self.planes, 2 * some.largest_h)
        weight = spline_norm(some.h[k], 1) * spline_shape(np.abs(x[k] - self.planes[plane]) / some.h[k])
        through = np.bincount(plane, weight * m[k] * v[k], 2)
        # each particle counts as far as its kernel is past a plane: then the rate of this mass is exactly inflow - outflow
        past = [_share_past((x - plane) / some.h) for plane in self.planes]
        return _Seen(state.frame.dim, float(through[0]), float(through[1]), float((m * (past[0] - past[1])).sum()))

    def take(self, t: float, slack: float, measured: _Seen) -> None:
        self.times.append(t)
        self.taken.append(measured)

    def series(self) -> list[Series]:
        if not self.taken:
            return []
        length = -1 if self.taken[0].dim == 2 else 0  # plane flow: per unit of width
        units = (self.unit(1, length, -1), self.unit(1, length, -1), self.unit(1, length, 0))
        names = ("inflow", "outflow", "mass")
        return [Series(name, unit, math.nan, np.array([one[c] for one in self.taken])) for c, (name, unit) in enumerate(zip(names, units, strict=True), 1)]

    def finish(self, run: Run) -> None:
        t = np.array(self.times)
        inside = self.window.within(t)
        if inside.sum() < 2:
            return self.fault(run, "fewer than two states are in its window in time")
        self.table_over_time()
        inflow, outflow, mass = (one.values[inside] for one in self.series())
        long, unit = float(np.ptp(t[inside])), self.series()[0].unit
        into, out = (float(np.trapz(flow, t[inside])) / long for flow in (inflow, outflow))
        stored = float(mass[-1] - mass[0]) / long
        ratio = out / into if into else math.nan
        for name, value in (("inflow_mean", into), ("outflow_mean", out), ("stored", stored), ("missing", into - out - stored)):
            self.add_scalar(name, unit, value)
        self.add_scalar("out_over_in", "-", ratio)
        self.add_scalar("missing_over_in", "-", (into - out - stored) / into if into else math.nan)
        if math.isfinite(self.expected):
            self.add_scalar("in_over_expected", "-", into / self.expected)
        self.say(
            f"  in {into:.5g}, out {out:.5g}, stored {stored:.3g}, missing {into - out - stored:.3g} {unit}: out/in {ratio:.4f}; "
            f"{inside.sum()} states\n"
        )
        return None


class _Extremes(NamedTuple):
    mach: float
    low: float
    high: float


_SOUNDNESS = keys_of_map("analysis soundness", "kind text!, name text!, c0 any, rho0 any, x positions, where text, from number, to number")


@analysis("soundness")
class SoundnessAnalysis(Analysis):
    """Largest Mach number and the range of the density over time, and what the run says of itself: its largest Mach number, leaks, verdict."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_SOUNDNESS)
        self.which, self.window = read_where(keys), TimeWindow.read(keys)
        self.c0, self.rho0 = keys.positive("c0", 1, required=True), keys.positive("rho0", 1, required=True)
        self.range = keys.range("x") or (-math.inf, math.inf)
        self.taken: list[_Extremes] = []

    def needs(self) -> list[Wanted]:
        return [*wanted_of(self.which.of), wanted_array("velocity"), wanted_array("density", optional=True)]

    def measure(self, state: State) -> _Extremes:
        some, arrays = state.selection(self.which), state.frame.arrays
        on = (some.x[:, 0] >= self.range[0]) & (some.x[:, 0] <= self.range[1])
        if not on.any():
            return _Extremes(math.nan, math.nan, math.nan)
        speed = np.sqrt((arrays["velocity"][some.row[on]] ** 2).sum(axis=1))
        density = arrays["density"][some.row[on]] / self.rho0 if "density" in arrays else np.array([math.nan])
        return _Extremes(float(speed.max()) / self.c0, float(density.min()), float(density.max()))

    def take(self, t: float, slack: float, measured: _Extremes) -> None:
        self.times.append(t)
        self.taken.append(measured)

    def series(self) -> list[Series]:
        values = np.array(self.taken).reshape(-1, 3)
        return [Series(name, "-", math.nan, values[:, c]) for c, name in enumerate(("mach", "density_low", "density_high"))]

    def finish(self, run: Run) -> None:
        inside = self.window.within(np.array(self.times))
        if not inside.any():
            return self.fault_no_state(run)
        self.table_over_time()
        moments = [Moments.of(one.values[inside]) for one in self.series()]
        for name, value in zip(("mach_most", "density_least", "density_most"), (moments[0].most, moments[1].least, moments[2].most), strict=True):
            self.add_scalar(name, "-", float(value) if np.isfinite(value) else math.nan)
        density = f"density {moments[1].least:.4f} to {moments[2].most:.4f} rho0" if moments[1].n else "density unknown, not in the files"
        self.say(f"  Mach at most {moments[0].most:.4f}, {density}, in {inside.sum()} states\n")
        self._take_summary(run)
        return None

    def _take_summary(self, run: Run) -> None:
        """What summary.yaml has of the whole run, between states, too; a run that still goes on has none."""
        summary = Results(run.folder).summary
        if not summary:
            return self.say("  there is no summary.yaml: the run goes on, or was copied without it\n")
        ranges, before = summary.get("ranges") or [], len(self.result.scalars)
        found: dict[str, float] = {}
        if ranges:
            found["mach_of_run"] = max(float(part["speed"]["value"]) for part in ranges) / self.c0
            found["density_of_run_least"] = min(float(part["density_ratio_low"]["value"]) for part in ranges)
            found["density_of_run_most"] = max(float(part["density_ratio_high"]["value"]) for part in ranges)
        found |= {"leaked_particles": float(summary["leaked_particles"])} if "leaked_particles" in summary else {}
        for name, value in found.items():
            self.add_scalar(name, "-", value)
        if "max_penetration" in summary:
            self.add_scalar("max_penetration", self.unit(L=1), float(summary["max_penetration"]))
        self.result.words |= {name: str(summary[name]) for name in ("verdict", "termination") if name in summary}
        told = "".join(f"{one.name} {one.value:.4g}, " for one in self.result.scalars[before:])
        return self.say(f"  of the whole run: {told}verdict {self.result.words.get('verdict', 'unknown')}\n")
