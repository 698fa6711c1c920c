"""Kinds of analyses that look at states: probe, surface, grid, profile and flux."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..diagnostics import Diagnostics
from ..fields import StateFiles, Wanted
from ..files import make_folder, write_file
from ..key_tables import keys as keys_of_map
from ..units import Units
from ..variables import wanted_array
from ..words import short_number
from ..yaml_map import Node, YamlMap, is_list, is_map
from .analyses import Analysis, Moments, Run, Settings, TimeWindow, analysis
from .bed import Bed
from .particles import Pieces, Points, interpolate, joined, pairs_near, spline_norm, spline_shape, water_on_lines
from .state import State, read_quantities, read_spray, read_where, wanted_of
from .tables import Column, Image, Series, write_vti


_PROBE = keys_of_map(
    "analysis probe",
    "kind text!, name text!, of any, where text, link number, share number, interpolation text, wet any, at any, from number, "
    "to number",
)


@analysis("probe")
class ProbeAnalysis(Analysis):
    """Quantities at points over time."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_PROBE)
        self.sampler = Sampler(keys, self.units)
        self.window = TimeWindow.read(keys)
        self.points = Points(np.array([self._point(keys, node) for node in keys.list("at", required=True)]).reshape(-1, 3))
        self.taken: list[np.ndarray] = []  # shape of each: (points, quantities)
        self.fallbacks = 0

    @staticmethod
    def _point(keys: YamlMap, node: Node) -> list[float]:
        if not is_list(node) or not 2 <= len(node.value) <= 3:
            keys.error(node, f"'{keys.name}.at': a point has two or three coordinates", "for example [[0.5, 0.02], [0.6, 0.02]]")
            return [0.0, 0.0, 0.0]
        return ([keys.scalar(one, "at") or 0.0 for one in node.value] + [0.0])[:3]

    def needs(self) -> list[Wanted]:
        return self.sampler.needs()

    def measure(self, state: State) -> Sample:
        return self.sampler.at(state, self.points)

    def take(self, t: float, slack: float, measured: Sample) -> None:
        self.times.append(t)
        self.taken.append(measured.values.T)
        self.fallbacks += measured.fallbacks

    def _columns(self) -> list[tuple[str, str, float]]:
        """Name, unit and x of each column: quantities of the first point, of the second, ..."""
        single = len(self.points.x) == 1
        return [
            (one.name if single else f"{one.name}_{p + 1}", one.unit, float(x[0])) for p, x in enumerate(self.points.x) for one in self.sampler.of
        ]

    def series(self) -> list[Series]:
        values = np.array(self.taken).reshape(len(self.times), -1)
        return [Series(*column, values[:, c]) for c, column in enumerate(self._columns())]

    def finish(self, run: Run) -> None:
        inside = self.window.within(np.array(self.times))
        if not inside.any() or not self._columns():
            return self.fault_no_state(run)
        self.table_over_time()
        self.say(f"  {len(self.points.x)} points, {len(self.times)} states; means over {inside.sum()} states\n")
        self.add_moments(inside)
        if self.fallbacks:
            self.add_scalar("mls_fallbacks", "-", self.fallbacks)
        return None


def depth_over(pieces: Pieces, bed: np.ndarray, h: float, first: bool = False) -> np.ndarray:
    """The top of the highest piece of water over the bed, or (`first`) of the lowest one that touches the bed; 0 if there is none. [L]

    Gaps thinner than h are within a piece, and water whose underside is within 2h of the bed touches it. bed: (lines,) [L].
    """
    pieces = joined(pieces, h)
    depth = np.zeros(len(bed))
    wet = pieces.high > bed[pieces.line]
    line, low, high = pieces.line[wet], pieces.low[wet], pieces.high[wet]
    if not first:
        depth[line] = high - bed[line]  # of a line's pieces the last one is the highest
        return depth
    line, at = np.unique(line, return_index=True)
    touches = low[at] <= bed[line] + 2 * h
    depth[line] = np.where(touches, high[at] - bed[line], 0)
    return depth


_SURFACE = keys_of_map(
    "analysis surface",
    "kind text!, name text!, where text, link number, share number, x positions, across any, bed text|@bed, surface any, layers any, "
    "from number, to number",
)


@analysis("surface")
class SurfaceAnalysis(Analysis):
    """Depth of the water over time on lines against gravity."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        # across: the second coordinate that lies in the bed
        keys.allow(*_SURFACE)
        self.which, self.spray, self.window = read_where(keys), read_spray(keys), TimeWindow.read(keys)
        self.x: np.ndarray = np.array(keys.places("x", required=True))
        across = keys.number("across")
        self.first = keys.choice("surface", ("top", "first")) == "first"
        self.layers = keys.flag("layers")
        self.ground = Bed.read(keys)
        self.bed = self.ground.at(self.x)
        up = settings.up
        self.places = np.column_stack([self.x, np.full_like(self.x, 0 if up == 1 else across), np.full_like(self.x, across if up == 1 else 0)])
        self.depths: list[np.ndarray] = []  # shape of each: (places,)
        self.found: list[tuple[float, Any]] = []  # pieces of water, where they are asked for
        self.moments, self.filled, self.wet = Moments(len(self.x)), np.zeros(len(self.x)), np.zeros(len(self.x))
        self.window_states = 0

    def needs(self) -> list[Wanted]:
        return wanted_of(self.which.of)

    def begin(self, states: list[StateFiles], diagnostics: Diagnostics) -> None:
        self.ground.find(states, diagnostics)
        self.bed = self.ground.at(self.x)

    def measure(self, state: State) -> tuple[np.ndarray, np.ndarray, Any]:
        water = state.water(self.which, self.spray)
        pieces, filled = water_on_lines(water, self.places, self.settings.up)
        return self._depth(pieces, water.largest_h), filled, pieces if self.layers else None

    def _depth(self, pieces: Pieces, h: float) -> np.ndarray:
        return depth_over(pieces, self.bed, h, self.first)

    def take(self, t: float, slack: float, measured: tuple[np.ndarray, np.ndarray, Any]) -> None:
        depth, filled, pieces = measured
        self.times.append(t)
        self.depths.append(depth)
        if pieces is not None:
            self.found.append((t, pieces))
        if self.window.holds(t, slack):
            self.window_states += 1
            self.moments.add(depth)
            self.filled += filled
            self.wet += depth > 0

    def series(self) -> list[Series]:
        names = ["depth"] if len(self.x) == 1 else [f"depth@{short_number(x)}" for x in self.x]
        values = np.array(self.depths).reshape(len(self.times), -1)
        return [Series(name, self.unit(L=1), float(x), values[:, k]) for k, (name, x) in enumerate(zip(names, self.x, strict=True))]

    def finish(self, run: Run) -> None:
        if self.window_states == 0:
            return self.fault_no_state(run)
        length = self.unit(L=1)
        self.table_over_time()
        deviation, filled = self.moments.deviation(), self.filled / self.window_states
        if len(self.x) == 1:
            for name, value in (("depth_mean", self.moments.mean), ("depth_deviation", deviation), ("filled_mean", filled)):
                self.add_scalar(name, length, value[0])
        table = self.add_table("mean")
        columns = {"x": self.x, "bed": self.bed, "mean": self.moments.mean, "deviation": deviation}
        columns |= {"least": self.moments.least, "most": self.moments.most, "wet": self.wet / self.window_states, "filled": filled}
        for name, values in columns.items():
            table.add(name, "-" if name == "wet" else length, values)
        if self.layers:
            table = self.add_table("layers")
            table.add("t", self.unit(T=1), np.concatenate([np.full(len(pieces.line), t) for t, pieces in self.found]))
            table.add("x", length, np.concatenate([self.x[pieces.line] for _, pieces in self.found]))
            table.add("low", length, np.concatenate([pieces.low for _, pieces in self.found]))
            table.add("high", length, np.concatenate([pieces.high for _, pieces in self.found]))
        self.say(f"  {len(self.x)} places, {len(self.times)} states; mean of {self.window_states} states\n")
        return None


class Sample(NamedTuple):
    """Quantities at points of one state. `values`: (quantities, points), NaN outside the water; `wet`: (points,) of bool; `colour`:
    (points,); `fallbacks`: points in the water where MLS had to be Shepard."""

    values: np.ndarray
    wet: np.ndarray
    colour: np.ndarray
    fallbacks: int


class Sampler:
    """How an analysis looks at points: keys `of`, `where`, `link`, `share`, `interpolation`, `wet`."""

    def __init__(self, keys: YamlMap, units: Units) -> None:
        self.of = read_quantities(keys, units)
        self.where, self.spray = read_where(keys), read_spray(keys)
        self.linear = keys.choice("interpolation", ("shepard", "mls")) == "mls"
        self.wet = keys.positive("wet", 0.5)

    def needs(self) -> list[Wanted]:
        return wanted_of(self.where.of, *(one.of for one in self.of))

    def at(self, state: State, points: Points) -> Sample:
        water = state.water(self.where, self.spray)
        weights = interpolate(water, points, self.linear, self.wet)
        wet = weights.colour >= self.wet
        values = np.full((len(self.of), len(wet)), np.nan)
        for q, quantity in enumerate(self.of):
            values[q, wet] = weights.of(state.evaluate(quantity.of)[water.row])[wet]
        return Sample(values, wet, weights.colour, int(weights.fallback.sum()))


_GRID = keys_of_map(
    "analysis grid",
    "kind text!, name text!, of any, where text, link number, share number, interpolation text, wet any, least_wet any, x positions, "
    "y positions, z positions, from number, to number, states any",
)


@analysis("grid")
class GridAnalysis(Analysis):
    """Means and deviations of quantities on points, over the states that have water there."""

    is_grid = True
    most_points = 5_000_000

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_GRID)
        self.sampler = Sampler(keys, self.units)
        self.window = TimeWindow.read(keys)
        self.least_wet = keys.number("least_wet", 0.5)  # share of the states that must have water at a point
        self.axes = [self._axis(keys, axis) for axis in "xyz"]
        x, y, z = self.axes
        if len(x) * len(y) * len(z) > self.most_points:
            keys.error(keys.node, f"'{keys.name}' has more than {self.most_points} points")
            x, y, z = x[:1], y[:1], z[:1]
        along = np.meshgrid(z, y, x, indexing="ij")  # x runs fastest
        self.points = Points(np.column_stack([one.ravel() for one in reversed(along)]))
        count = len(self.points.x)
        self.moments, self.wet, self.colour = Moments((len(self.sampler.of), count)), np.zeros(count), np.zeros(count)
        self.fallbacks = 0
        message = "must be true or false, and of a grid"
        self.states = keys.flag("states", message=message)
        if (node := keys.get("states")) is not None and not self.is_grid:
            keys.error(node, f"'{keys.name}.states' {message}")
        self.pvd = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'

    def _axis(self, keys: YamlMap, key: str) -> np.ndarray:
        places = keys.places(key, required=key != "z")
        node = keys.get(key)
        if self.is_grid and node is not None and len(places) > 1 and not is_map(node):
            keys.error(node, f"'{keys.name}.{key}' of a grid must be {{from, to, step}} or one number")
        return np.array(places or [0.0])

    def needs(self) -> list[Wanted]:
        return self.sampler.needs()

    def looks_at(self, t: float, slack: float) -> bool:
        return bool(self.window.holds(t, slack))

    def measure(self, state: State) -> Sample:
        return self.sampler.at(state, self.points)

    def take(self, t: float, slack: float, measured: Sample) -> None:
        self.times.append(t)
        self.wet += measured.wet
        self.colour += measured.colour
        self.moments.add(measured.values)
        self.fallbacks += measured.fallbacks
        if self.states:
            self._write_state(t, measured)

    def finish(self, run: Run) -> None:
        if not self.times:
            return self.fault_no_state(run)
        states, table = len(self.times), self.add_table()
        for a, axis in enumerate("xyz"):
            if a < 2 or len(self.axes[2]) > 1:
                table.add(axis, self.unit(L=1), self.points.x[:, a])
        wet = self.wet / states
        means, deviations = self.moments.mean_or_nan(), self.moments.deviation()
        for one, mean, deviation in zip(self.sampler.of, means, deviations, strict=True):
            table.add(f"{one.name}_mean", one.unit, np.where(wet >= self.least_wet, mean, np.nan))
            table.add(f"{one.name}_deviation", one.unit, np.where(wet >= self.least_wet, deviation, np.nan))
        table.add("wet", "-", wet)
        table.add("colour", "-", self.colour / states)
        size = " x ".join(str(len(axis)) for axis in self.axes)
        self.say(f"  {size} points, mean of {states} states from t = {self.times[0]:.4g} to {self.times[-1]:.4g}\n")
        self.add_scalar("states", "-", states)
        if self.fallbacks:
            self.add_scalar("mls_fallbacks", "-", self.fallbacks)
            self.say(f"  {self.fallbacks} of {states * len(wet)} values by Shepard where MLS was not possible\n")
        if self.is_grid:
            self.result.images.append(self._image(self.name, self.times[-1], [c for c in table.columns if c.name not in "xyz"]))
        if self.states:
            write_file(self.out / f"{self.name}.pvd", self.pvd + "</Collection>\n</VTKFile>\n")
        return None

    def _image(self, name: str, t: float, fields: list[Column]) -> Image:
        n, origin = tuple(len(axis) for axis in self.axes), tuple(float(axis[0]) for axis in self.axes)
        spacing = tuple(float(axis[1] - axis[0]) if len(axis) > 1 else 1.0 for axis in self.axes)
        return Image(name, t, n, origin, spacing, fields)

    def _write_state(self, t: float, sample: Sample) -> None:
        name = f"{self.name}_{len(self.times) - 1:04d}"
        fields = [Column(one.name, one.unit, values) for one, values in zip(self.sampler.of, sample.values, strict=True)]
        make_folder(self.out / self.name)
        write_vti(self.out / self.name / f"{name}.vti", self._image(name, t, [*fields, Column("wet", "-", sample.wet)]))
        self.pvd += f'<DataSet timestep="{t:.9g}" part="0" file="{self.name}/{name}.vti"/>\n'


@analysis("profile")
class ProfileAnalysis(GridAnalysis):
    """The same on lines, whose places may be lists."""

    is_grid = False


_FLUXES = ("mass", "volume", "momentum_x", "momentum_y", "momentum_z", "pressure_force", "kinetic", "potential", "pressure_work")
_FLUX_DIMENSIONS = ((1, 0, -1), (0, 3, -1), *[(1, 1, -2)] * 4, *[(1, 2, -3)] * 3)


_FLUX = keys_of_map("analysis flux", "kind text!, name text!, where text, normal any, at any, x positions, y positions, z positions, g any, level any, from number, to number")


@analysis("flux")
class FluxAnalysis(Analysis):
    """What flows through planes across an axis: sums over particles of (m v_n q) W1(distance), W1 the cubic spline in one dimension."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_FLUX)
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
        return [*wanted_of(self.which.of), wanted_array("velocity"), wanted_array("pressure"), wanted_array("mass")]

    def measure(self, state: State) -> tuple[int, np.ndarray]:
        some, arrays = state.selection(self.which), state.frame.arrays
        inside = np.ones(len(some), dtype=bool)
        for axis, low, high in self.extent:
            inside &= (some.x[:, axis] >= low) & (some.x[:, axis] <= high)
        some = some.part(inside)
        x = some.x[:, self.normal]
        plane, k = pairs_near(x, np.argsort(x, kind="stable"), self.at, 2 * some.largest_h)
        u, p, m = (arrays[name][some.row] for name in ("velocity", "pressure", "mass"))
        apart = np.abs(x[k] - self.at[plane])
        weight = spline_norm(some.h[k], 1) * spline_shape(apart / some.h[k])
        flow, through = m * u[:, self.normal], some.V * u[:, self.normal]
        energy = 0.5 * flow * (u**2).sum(axis=1), flow * self.g * (some.x[:, self.settings.up] - self.level)
        carried = np.column_stack([flow, through, flow[:, None] * u, some.V * p, *energy, through * p])
        out = [np.bincount(plane, weight * carried[k, c], len(self.at)) for c in range(len(_FLUXES))]
        return state.frame.dim, np.column_stack(out)

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
