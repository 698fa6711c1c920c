"""What analyses of a recipe have in common, and the register of their kinds.

A new kind is one function of a state with a decorator; its parameters are keys of the recipe:

    from courant.post import analysis

    @analysis("fastest")
    def fastest(state, over: float = 0.0):
        speed = state["speed"][state.active]
        return {"speed [m/s]": speed.max(), "share [-]": (speed > over).mean()}

and `{kind: fastest, name: f, over: 1.2}` gives the table f over time with means and deviations, whose series spectra and figures may
take up. Kinds that need more are classes derived from Analysis with the same decorator.
"""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..diagnostics import Diagnostics, Location
from ..fields import StateFiles, Wanted, slack_of
from ..registry import Registry
from ..units import Dimension, Units
from ..variables import wanted_array
from ..words import did_you_mean
from ..yaml_map import YamlMap, as_number, is_list, is_scalar, scalar_text
from .state import State
from .tables import Result, Scalar, Series, Table

_FILE_NAME = re.compile(r"[A-Za-z0-9_-]+")


@dataclass(frozen=True)
class Settings:
    """What all analyses of a recipe share. `up`: the axis against gravity, 1 is y, 2 is z."""

    units: Units = Units()
    up: int = 1


@dataclass(frozen=True)
class TimeWindow:
    """A window in time, both ends with the slack of a quarter of the spacing of states, because a state is written up to one time
    step early. [T]"""

    start: float = -math.inf
    end: float = math.inf

    @classmethod
    def read(cls, keys: YamlMap) -> TimeWindow:
        out = cls(keys.number("from", -math.inf), keys.number("to", math.inf))
        node = keys.get("from")
        if node is not None and not out.start < out.end:
            keys.error(node, f"'{keys.name}.from' must be less than 'to'")
        return out

    def holds(self, t: Any, slack: float) -> Any:
        """Whether it holds a time, or each of an array of times."""
        return (t >= self.start - slack) & (t <= self.end + slack)

    def within(self, times: np.ndarray) -> np.ndarray:
        """Which times it holds, with the slack of these times; shape (n,) of bool."""
        return self.holds(times, slack_of(times))


class Moments:
    """Mean and deviation of arrays of numbers that come one by one; NaN is left out.

    Source: Welford, Technometrics 4 (1962).
    """

    def __init__(self, shape: int | tuple[int, ...] = ()) -> None:
        self.n, self.mean, self.squares = np.zeros(shape), np.zeros(shape), np.zeros(shape)
        self.least, self.most = np.full(shape, np.inf), np.full(shape, -np.inf)

    @classmethod
    def of(cls, values: np.ndarray) -> Moments:
        """Of a series, (n,)."""
        n, mean, squares = 0, 0.0, 0.0
        for value in values.tolist():  # one by one, so that a constant series has no deviation at all
            if value == value:
                n += 1
                before = value - mean
                mean += before / n
                squares += before * (value - mean)
        out = cls()
        out.n, out.mean, out.squares = np.array(float(n)), np.array(mean), np.array(squares)
        if n:
            out.least, out.most = np.nanmin(values), np.nanmax(values)
        return out

    def add(self, values: Any) -> None:
        there = ~np.isnan(values)
        self.n = self.n + there
        before = np.where(there, values - self.mean, 0.0)
        self.mean = self.mean + before / np.maximum(self.n, 1)
        self.squares = self.squares + before * np.where(there, values - self.mean, 0.0)
        self.least, self.most = np.fmin(self.least, values), np.fmax(self.most, values)

    def _or_nan(self, values: np.ndarray) -> Any:
        out = np.where(self.n > 0, values, np.nan)
        return out if out.ndim else float(out)

    def mean_or_nan(self) -> Any:
        return self._or_nan(self.mean)

    def deviation(self) -> Any:
        """Of the population: divided by n; NaN for n = 0."""
        return self._or_nan(np.sqrt(self.squares / np.maximum(self.n, 1)))


def median(values: Sequence[float] | np.ndarray) -> float:
    """NaN is left out; NaN if nothing is left."""
    there = np.asarray(values, dtype=float)
    there = there[~np.isnan(there)]
    return float(np.median(there)) if len(there) else math.nan


@dataclass
class Run:
    """What an analysis finishes with. `above`: the analyses that are above it in the recipe, by name; `folder`: of the run;
    `out`: for what analyses write."""

    above: dict[str, Analysis]
    folder: Path
    out: Path
    diagnostics: Diagnostics


class Analysis:
    """One analysis: it reads its keys, measures single states, takes what was measured in their order, then gives a Result.

    Several processes may measure at once: `measure` changes nothing.
    """

    kind = ""
    needs_states = True

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        self.name = keys.text("name", required=True)
        self.where: Location = keys.where()
        self.units, self.settings = settings.units, settings
        self.result = Result()
        self.times: Any = []  # (n,), a list or an array
        self.out = Path()  # for files of single states
        node = keys.get("name")
        if node is not None and is_scalar(node) and not _FILE_NAME.fullmatch(self.name):
            message = f"the name '{self.name}' of an analysis must be of letters, digits, - and _"
            keys.error(node, message, "files are named after it")

    def needs(self) -> list[Wanted]:
        """Arrays that it needs of each state."""
        return []

    def refers(self) -> list[tuple[str, str]]:
        """Analyses that must be above it: the key of the recipe and the name there."""
        return []

    def begin(self, states: list[StateFiles], diagnostics: Diagnostics) -> None:
        """Takes what it needs of the scene as a whole, before states are measured."""

    def looks_at(self, t: float, slack: float) -> bool:
        return True

    def measure(self, state: State) -> Any:
        """What it needs of one state."""

    def take(self, t: float, slack: float, measured: Any) -> None:
        """Takes in what was measured at a time; called in the order of the states."""

    def finish(self, run: Run) -> None:
        """Makes the result. Faults are reported at `where`."""
        raise NotImplementedError

    def series(self) -> list[Series]:
        """Series over `times`; complete when it has finished."""
        return []

    # of use to all kinds
    def unit(self, M: int = 0, L: int = 0, T: int = 0) -> str:
        return self.units.of(Dimension(M, L, T))

    def add_table(self, suffix: str = "") -> Table:
        self.result.tables.append(Table(f"{self.name}_{suffix}" if suffix else self.name))
        return self.result.tables[-1]

    def add_scalar(self, name: str, unit: str, value: float) -> None:
        self.result.scalars.append(Scalar(name, unit, float(value)))

    def add_moments(self, inside: np.ndarray) -> list[tuple[Series, Moments]]:
        """Mean and deviation of each series over the times for which `inside` holds, as single numbers."""
        found = [(one, Moments.of(one.values[inside])) for one in self.series()]
        for one, moments in found:
            self.add_scalar(f"{one.name}_mean", one.unit, moments.mean_or_nan())
            self.add_scalar(f"{one.name}_deviation", one.unit, moments.deviation())
        return found

    def say(self, text: str) -> None:
        self.result.text += text

    def fault(self, run: Run, message: str, hint: str = "") -> None:
        run.diagnostics.error(self.where, f"analysis '{self.name}': {message}", hint)

    def fault_no_state(self, run: Run) -> None:
        self.fault(run, "the results have no state in its window in time")

    def above(self, run: Run, name: str) -> Analysis | None:
        """The analysis above with a name; a fault is reported, and gives None."""
        if name in run.above:
            return run.above[name]
        hint = f"above it stand {', '.join(run.above)}" if run.above else "it must stand above the one that uses it"
        self.fault(run, f"there is no analysis '{name}' above it", hint)
        return None

    def table_over_time(self) -> Table:
        """The main table: times, and all series."""
        table = self.add_table()
        table.add("t", self.unit(T=1), self.times)
        for one in self.series():
            table.add(one.name, one.unit, one.values)
        return table


Factory = Callable[[YamlMap, Settings], Analysis]
_OF_MODULES = {"kinds_states": "probe surface grid profile flux", "kinds_series": "spectrum history force toe", "kinds_roller": "roller"}
_OF_MODULES |= {"kinds_drop": "jump_type drop_regime", "kinds_gauges": "gauges correlation", "kinds_balance": "mass_balance soundness", "kinds_mesh": "surface_mesh"}
_ORDER = "probe surface grid profile spectrum flux history force toe roller".split()  # as messages name them
_ORDER += "jump_type drop_regime gauges correlation mass_balance soundness surface_mesh".split()
KINDS: Registry[Factory] = Registry(
    "kind of analysis", {kind: f"{__package__}.{home}" for kind in _ORDER for home, kinds in _OF_MODULES.items() if kind in kinds.split()}
)


def analysis(kind: str, needs: Sequence[str] | None = None) -> Callable[[Any], Any]:
    """Registers a kind of analysis: a class derived from Analysis, or a function of a state.

    The function's further parameters are keys of the recipe; it gives a number for each name "column [unit]". `needs`: arrays of the
    field files ("velocity", ...); all that expressions may use, as far as the files have them, if not given.
    """

    def register(made: Any) -> Any:
        is_class = inspect.isclass(made) and issubclass(made, Analysis)
        KINDS.add(kind, made if is_class else lambda keys, settings: FunctionAnalysis(keys, settings, made, needs))
        return made

    return register


def read_analysis(keys: YamlMap, settings: Settings) -> Analysis | None:
    """Makes the analysis of one entry of `analyses`. Faults are reported; then there may be None."""
    word = keys.text("kind", required=True)
    if word in KINDS:
        made = KINDS[word](keys, settings)
        made.kind = word
        return made
    node = keys.get("kind")
    if node is not None and is_scalar(node):
        keys.error(node, f"there is no kind of analysis '{word}'", f"{did_you_mean(word, KINDS.names())}kinds: {', '.join(KINDS.names())}")
    return None


class FunctionAnalysis(Analysis):
    """A kind of analysis that is a function of a state; numbers over time, their means and deviations."""

    def __init__(self, keys: YamlMap, settings: Settings, function: Callable[..., dict[str, float]], needs: Sequence[str] | None) -> None:
        super().__init__(keys, settings)
        parameters = list(inspect.signature(function).parameters.values())[1:]
        keys.allow("kind", "name", "from", "to", *(one.name for one in parameters))
        self.window = TimeWindow.read(keys)
        self.function, self._needs = function, needs
        self.arguments: dict[str, Any] = {}
        for one in parameters:
            node = keys.get(one.name, required=one.default is one.empty)
            if node is None:
                continue
            texts = [scalar_text(n) for n in (node.value if is_list(node) else [node])]
            values = [text if as_number(text) is None else as_number(text) for text in texts]
            self.arguments[one.name] = values if is_list(node) else values[0]
        self.taken: list[dict[str, float]] = []

    def needs(self) -> list[Wanted]:
        if self._needs is not None:
            return [wanted_array(name) for name in self._needs]
        return [wanted_array(name, optional=True) for name in ("velocity", "pressure", "density", "mass", "internal_energy", "part", "id")]

    def measure(self, state: State) -> dict[str, float]:
        return {name: float(value) for name, value in self.function(state, **self.arguments).items()}

    def take(self, t: float, slack: float, measured: dict[str, float]) -> None:
        self.times.append(t)
        self.taken.append(measured)

    def series(self) -> list[Series]:
        out = []
        for head in self.taken[0] if self.taken else ():
            name, _, unit = head.partition(" [")
            values = np.array([one.get(head, math.nan) for one in self.taken])
            out.append(Series(name.replace(" ", "_").replace(",", ";"), unit.rstrip("]") or "?", math.nan, values))
        return out

    def finish(self, run: Run) -> None:
        inside = self.window.within(np.array(self.times))
        if not inside.any():
            return self.fault_no_state(run)
        self.table_over_time()
        for one, moments in self.add_moments(inside):
            self.say(f"  {one.name}: mean {moments.mean_or_nan():.5g} {one.unit}, deviation {moments.deviation():.3g}\n")
        return None
