"""Kind of analysis: flux."""

from __future__ import annotations

import numpy as np

from ..fields import Wanted
from ..words import short_number
from ..yaml_map import YamlMap
from .analysis import Analysis, Moments, Run, Settings, TimeWindow, analysis
from .particles import spline_norm, spline_shape
from .state import State, read_where, wanted_array, wanted_arrays
from .tables import Series

_FLUXES = ("mass", "volume", "momentum_x", "momentum_y", "momentum_z", "pressure_force", "kinetic", "potential", "pressure_work")
_FLUX_DIMENSIONS = ((1, 0, -1), (0, 3, -1), *[(1, 1, -2)] * 4, *[(1, 2, -3)] * 3)


@analysis("flux")
class FluxAnalysis(Analysis):
    """What flows through planes across an axis: sums over particles of (m v_n q) W1(distance), W1 the cubic spline in one dimension."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow("kind", "name", "where", "normal", "at", "x", "y", "z", "g", "level", "from", "to")
        self.which = read_where(keys)
        self.normal = "xyz".index(keys.choice("normal", ("x", "y", "z")))
        self.at: np.ndarray = np.array(keys.places("at", required=True))
        self.extent: list[tuple[int, float, float]] = []
        for axis, key in enumerate("xyz"):
            bounds = keys.range(key)
            if bounds and axis == self.normal:
                hint = "extents bound the planes along the other axes"
                keys.error(keys.get(key) or keys.node, f"'{keys.name}.{key}' is the normal of the planes", hint)
            if bounds:
                self.extent.append((axis, *bounds))
        self.g, self.level = keys.number("g", 9.81), keys.number("level")
        self.window = TimeWindow.read(keys)
        self.dim, self.window_states = 2, 0
        self.sums: list[np.ndarray] = []  # shape of each: (planes, fluxes)
        self.moments = Moments((len(self.at), len(_FLUXES)))

    def needs(self) -> list[Wanted]:
        return [*wanted_arrays(self.which.of), wanted_array("velocity"), wanted_array("pressure"), wanted_array("mass")]

    def measure(self, state: State) -> tuple[int, np.ndarray]:
        some, arrays = state.selection(self.which), state.frame.arrays
        inside = np.ones(len(some), dtype=bool)
        for axis, low, high in self.extent:
            inside &= (some.x[:, axis] >= low) & (some.x[:, axis] <= high)
        some = some.part(inside)
        plane, k = self._near(some.x[:, self.normal], 2 * some.largest_h)
        u, p, m = (arrays[name][some.row] for name in ("velocity", "pressure", "mass"))
        apart = np.abs(some.x[k, self.normal] - self.at[plane])
        weight = spline_norm(some.h[k], 1) * spline_shape(apart / some.h[k])
        flow, through = m * u[:, self.normal], some.V * u[:, self.normal]
        energy = 0.5 * flow * (u**2).sum(axis=1), flow * self.g * (some.x[:, self.settings.up] - self.level)
        carried = np.column_stack([flow, through, flow[:, None] * u, some.V * p, *energy, through * p])
        out = [np.bincount(plane, weight * carried[k, c], len(self.at)) for c in range(len(_FLUXES))]
        return state.frame.dim, np.column_stack(out)

    def _near(self, x: np.ndarray, reach: float) -> tuple[np.ndarray, np.ndarray]:
        """Pairs of planes and particles closer than `reach`: index of the plane, of the particle."""
        order = np.argsort(x, kind="stable")
        begin, end = (np.searchsorted(x[order], self.at + side, "left") for side in (-reach, reach))
        count = end - begin
        plane = np.repeat(np.arange(len(self.at)), count)
        return plane, order[np.arange(len(plane)) - np.repeat(np.cumsum(count) - count - begin, count)]

    def take(self, t: float, slack: float, measured: tuple[int, np.ndarray]) -> None:
        self.dim, sums = measured
        self.times.append(t)
        self.sums.append(sums)
        if self.window.holds(t, slack):
            self.window_states += 1
            self.moments.add(sums)

    def _unit_of(self, c: int) -> str:
        M, L, T = _FLUX_DIMENSIONS[c]
        return self.unit(M, L - 1 if self.dim == 2 else L, T)  # plane flow: per unit of width

    def series(self) -> list[Series]:
        values = np.array(self.sums).reshape(len(self.times), len(self.at), len(_FLUXES))
        single = len(self.at) == 1
        return [
            Series(name if single else f"{name}@{short_number(x)}", self._unit_of(c), float(x), values[:, p, c])
            for p, x in enumerate(self.at)
            for c, name in enumerate(_FLUXES)
        ]

    def finish(self, run: Run) -> None:
        if self.window_states == 0:
            return self.fault_no_state(run)
        self.table_over_time()
        table = self.add_table("mean")
        table.add("at", self.unit(L=1), self.at)
        deviations = self.moments.deviation()
        for c, name in enumerate(_FLUXES):
            table.add(f"{name}_mean", self._unit_of(c), self.moments.mean[:, c])
            table.add(f"{name}_deviation", self._unit_of(c), deviations[:, c])
        for at, mass in zip(self.at, self.moments.mean[:, 0], strict=True):
            self.say(f"  at {at:g}: mass {mass:.5g} {self._unit_of(0)}, mean of {self.window_states} states\n")
        return None
