"""Kind of analysis: roller. The inside and the surface of a hydraulic jump against the empirical equations of Jonsson et al. (2016),
eqs 2 to 5 (post/jump.py)."""

from __future__ import annotations

import math

import numpy as np

from ..key_tables import keys as keys_of_map
from ..yaml_map import YamlMap, as_number
from .analyses import Analysis, Moments, Run, Settings, analysis, median
from .jump import froude, largest_deviation_over_d1, roller_length_over_d1, surface_strouhal, velocity_decay


def zero_behind(x: np.ndarray, values: np.ndarray, x1: float) -> float:
    """Where values on lines at x go from below 0 to 0 or more for the first time behind x1, linear in between; NaN: nowhere."""
    a, b = values[:-1], values[1:]
    found = np.flatnonzero((x[1:] > x1) & (a < 0) & (b >= 0))
    if len(found) == 0:
        return math.nan
    k = found[0]
    return float(x[k] + a[k] / (a[k] - b[k]) * (x[k + 1] - x[k]))


_ROLLER = keys_of_map(
    "analysis roller",
    "kind text!, name text!, profile any, velocity any, surface any, spectrum any, toe any, v1 any, d1 any, g any, "
    "decay_to any",
)


@analysis("roller")
class RollerAnalysis(Analysis):
    """A jump against equations 2 to 5."""

    needs_states = False

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_ROLLER)
        self.profile, self.velocity = keys.text("profile"), keys.text("velocity", "vx_mean")
        self.surface, self.spectrum = keys.text("surface"), keys.text("spectrum")
        self.toe = keys.text("toe", required=True)
        self.v1, self.d1 = keys.positive("v1", 1, required=True), keys.positive("d1", 1, required=True)
        self.g = keys.positive("g", 9.81)
        self.decay_to = keys.positive("decay_to", 20)  # up to that distance the decay is compared [d1]
        self.x1 = self.Fr1 = math.nan
        if not (self.profile or self.surface or self.spectrum):
            keys.error(keys.node, f"'{keys.name}' names no analysis to look at", "add some of: profile, surface, spectrum")

    def refers(self) -> list[tuple[str, str]]:
        out = [(key, name) for key in ("profile", "surface", "spectrum") if (name := getattr(self, key))]
        return out if as_number(self.toe) is not None else [*out, ("toe", self.toe)]

    def finish(self, run: Run) -> None:
        if not self._find_toe(run):
            return
        self.Fr1 = froude(self.v1, self.d1, self.g)
        self.add_scalar("Fr1", "-", self.Fr1)
        self.add_scalar("toe", self.unit(L=1), self.x1)
        self.say(f"  Fr1 = {self.Fr1:.3f}, toe at x1 = {self.x1:.4g} {self.units.length}\n  {'':<44}{'here':>10}{'reference':>12}{'':>9}\n")
        if self.profile:
            self._look_inside(run)
        if self.surface:
            self._look_at_surface(run)
        if self.spectrum:
            self._look_at_spectrum(run)
        numbers = self.add_table("numbers")  # one row, for figures over the Froude number
        for one in self.result.scalars:
            numbers.add(one.name, one.unit, [one.value])

    def _find_toe(self, run: Run) -> bool:
        """`toe` is a number, or the name of an analysis of kind toe, whose mean counts."""
        number = as_number(self.toe)
        if number is not None:
            self.x1 = number
            return True
        source = self.above(run, self.toe)
        if source is None:
            return False
        self.x1 = next((one.value for one in source.result.scalars if one.name == "toe_mean"), math.nan)
        if source.kind == "toe" and math.isfinite(self.x1):
            return True
        self.fault(run, f"'{self.toe}' found no toe in its window in time")
        return False

    def _columns(self, run: Run, name: str, table_name: str, wanted: tuple[str, ...]) -> list[np.ndarray] | None:
        """Columns of a table of an analysis above; None if it is not there or lacks one, which is reported."""
        source = self.above(run, name)
        if source is None:
            return None
        table = next((one for one in source.result.tables if one.name == table_name), None)
        if table is None:
            self.fault(run, f"the analysis '{name}' has no table '{table_name}'")
            return None
        missing = [one for one in wanted if table.find(one) is None]
        if missing:
            self.fault(run, f"the table '{table_name}' has no column '{missing[0]}'", f"it has {', '.join(table.names)}")
            return None
        return [column.values for one in wanted if (column := table.find(one))]

    def _compare(self, name: str, title: str, here: float, reference: float, equation: str) -> None:
        self.add_scalar(name, "-", here)
        self.add_scalar(f"{name}_reference", "-", reference)
        number, error = ("none", "") if math.isnan(here) else (f"{here:.4g}", f"{100 * (here / reference - 1):+.0f} %")
        self.say(f"  {title:<44}{number:>10}{reference:>12.4g}{error:>9}  {equation}\n")

    def _look_inside(self, run: Run) -> None:
        found = self._columns(run, self.profile, self.profile, ("x", "y", self.velocity))
        if found is None:
            return
        x, largest, least, top = _lines(*found)
        distance = (x - self.x1) / self.d1
        decay = velocity_decay(distance)
        table = self.add_table()
        for name, values in zip(
            ("x", "distance", "largest", "least", "top", "decay"),
            (x, distance, largest / self.v1, least / self.v1, top / self.v1, decay),
            strict=True,
        ):
            table.add(name, self.units.length if name == "x" else "-", values)
        compared = (distance > 0) & (distance <= self.decay_to)
        rms = math.sqrt(Moments.of((largest[compared] / self.v1 / decay[compared] - 1) ** 2).mean_or_nan())
        theory = roller_length_over_d1(self.Fr1)
        for name, title, values in (
            ("roller_length", "roller: mean velocity nowhere negative, Lr/d1", least),
            ("roller_length_surface", "roller: stagnation point at the surface, Lr/d1", top),
        ):
            self._compare(name, title, (zero_behind(x, values, self.x1) - self.x1) / self.d1, theory, "eq. 2")
        self.add_scalar("decay_rms", "-", rms)
        title = f"Vmax against its decay, rms up to {self.decay_to:g} d1"
        self.say(f"  {title:<44}{100 * rms:>9.1f} %{'0 %':>12}{'':>9}  eq. 3\n")

    def _look_at_surface(self, run: Run) -> None:
        found = self._columns(run, self.surface, f"{self.surface}_mean", ("x", "mean", "deviation"))
        if found is None:
            return
        distance, mean, deviation = (found[0] - self.x1) / self.d1, found[1] / self.d1, found[2] / self.d1
        table = self.add_table("surface")
        for name, values in (("distance", distance), ("mean", mean), ("deviation", deviation)):
            table.add(name, "-", values)
        behind = np.flatnonzero((distance >= 0) & ~np.isnan(deviation))
        at = behind[np.argmax(deviation[behind])] if len(behind) else None
        largest, place = (math.nan, math.nan) if at is None else (float(deviation[at]), float(distance[at]))
        self._compare("deviation_largest", "largest deviation of the surface, eta'/d1", largest, largest_deviation_over_d1(self.Fr1), "eq. 4")
        self.add_scalar("deviation_largest_at", "-", place)
        self.say(f"  {'  found at (x - x1)/d1':<44}{place:>10.3g}\n")

    def _look_at_spectrum(self, run: Run) -> None:
        found = self._columns(run, self.spectrum, f"{self.spectrum}_peaks", ("x", "f"))
        if found is None:
            return
        distance, f = (found[0] - self.x1) / self.d1, found[1]
        strouhal, hertz = f * self.d1 / self.v1, self.unit(T=-1)
        table = self.add_table("frequency")
        for name, unit, values in (("distance", "-", distance), ("f", hertz, f), ("strouhal", "-", strouhal)):
            table.add(name, unit, values)
        scalars = run.above[self.spectrum].result.scalars
        dominant = next((one.value for one in scalars if one.name == "dominant_of_mean"), math.nan)
        self.add_scalar("frequency", hertz, dominant)
        theory = surface_strouhal(self.Fr1)
        self._compare("strouhal", "Strouhal number of the mean spectrum, f d1/v1", dominant * self.d1 / self.v1, theory, "eq. 5")
        self.say(f"  {'  as a frequency':<44}{dominant:>10.3g}{theory * self.v1 / self.d1:>12.3g}{'':>9}  {hertz}\n")
        # eq. 2's roller, so that it does not hang on what was found of one. A gauge past which the toe drifts slowly swings more than all
        # others: in the mean spectrum it decides, in the median it counts once.
        over_roller = strouhal[(distance > 0) & (distance <= roller_length_over_d1(self.Fr1))]
        self._compare("strouhal_median", "Strouhal number, median over the roller", median(over_roller), theory, "eq. 5")


def _lines(x: np.ndarray, y: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """What upright lines of mean velocities tell: their x, the largest and the least velocity, and that at the highest point; NaN where
    a line has none. Shapes: (lines,)."""
    places, line = np.unique(x, return_inverse=True)
    there = ~np.isnan(u)
    largest, least, top = np.full(len(places), -np.inf), np.full(len(places), np.inf), np.full(len(places), np.nan)
    np.maximum.at(largest, line[there], u[there])
    np.minimum.at(least, line[there], u[there])
    for row in np.flatnonzero(there)[np.argsort(y[there], kind="stable")]:
        top[line[row]] = u[row]
    return places, np.where(np.isinf(largest), np.nan, largest), np.where(np.isinf(least), np.nan, least), top
