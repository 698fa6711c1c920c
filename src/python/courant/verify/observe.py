"""What is observed in the results of a run."""
from __future__ import annotations

import math
from collections.abc import Callable, Generator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from ..diagnostics import Diagnostics
from ..expressions import ExpressionFault, Formula, constant_value
from ..fields import StateFiles, read_states, slack_of
from ..histories import HistoryFile
from ..variables import VARIABLES
from ..words import nearest_word
from .model import Case, Observation, Variables
from .names import HistoryName, find_history_names
from .particles import Selection, StateFault, StateTable, first_error, nearest_state
from .registry import KINDS, observation, reduction
from .series import NoValue, Series, take_number


@dataclass
class Measured:
    """An observation before it is compared; `why`: there is nothing."""

    found: bool = False
    why: str = ""
    series: Series = field(default_factory=Series)  # within the window of the observation
    value: float | None = None  # of scalars
    formula: np.ndarray | None = None  # of profiles with a formula as reference: its values, shape (series)

    @classmethod
    def of(cls, o: Observation, run: Run, series: Series) -> Measured:
        """What an observation takes of a series. Raises NotFound, ExpressionFault."""
        if len(series) == 0:
            raise NotFound("no sample lies in the window")
        value = None
        if o.take != "curve":
            try:
                value = take_number(series, o.take, Window.of(o, run.variables).at)
            except NoValue as fault:
                raise NotFound(str(fault)) from None
            if not math.isfinite(value):
                raise NotFound("the value is not finite")
        return cls(True, series=series, value=value)


class NotFound(Exception):
    """A run has nothing of the kind; the text states why."""


@dataclass
class Window:
    """A window or moment of an observation in its values; infinite where it is open."""

    start: float
    end: float
    at: float | None

    @classmethod
    def of(cls, o: Observation, variables: Variables) -> Window:
        """Raises ExpressionFault where an expression has no value."""
        start, end, at = (None if text is None else constant_value(text, variables) for text in (o.start, o.end, o.at))
        return cls(-math.inf if start is None else start, math.inf if end is None else end, at)

    def widened(self, times: np.ndarray) -> tuple[float, float]:
        """With a slack of a quarter of the mean distance of samples, because a sample is written up to one step early."""
        slack = slack_of(times)
        return self.start - slack, self.end + slack


class Run:
    """What a kind of observation sees of a run."""

    def __init__(self, folder: Path, variables: Variables) -> None:
        self.folder, self.variables = folder, variables
        self.used: set[str] = set()  # variables of particles that the observations name
        self._faults = Diagnostics()

    @cached_property
    def history(self) -> HistoryFile | None:
        return HistoryFile.open(self.folder / "history.h5", self._faults)

    @cached_property
    def states(self) -> list[StateFiles]:
        """In order of time; raises NotFound if there are none."""
        faults = Diagnostics()
        found = read_states(self.folder, faults)
        if not found:
            raise NotFound(first_error(faults))
        return found

    def histories(self) -> HistoryFile:
        """history.h5; raises NotFound."""
        if self.history is None:
            raise NotFound(first_error(self._faults))
        return self.history

    def formula(self, text: str) -> Formula:
        """An expression over particles. Raises NotFound."""
        return self.noted(Formula(text, VARIABLES, self.variables))

    def noted(self, formula: Formula) -> Formula:
        if not formula.ok:
            raise NotFound(formula.error)
        self.used |= formula.used
        return formula

    def garbage(self) -> str:
        """What is not finite in the sums over the whole model; blank: nothing."""
        file = self.history
        for name in file.names if file else ():
            values = file.values(name) if file and name.startswith("/global/") else None
            bad = np.flatnonzero(~np.isfinite(values.ravel(order="F"))) if values is not None else np.empty(0)
            if file and len(bad):
                return f"{name[1:]} is not finite at t = {file.times[bad[0] % len(file.times)]:.6g}"
        return ""


Looking = Generator[int, StateTable, Measured]


def _fault_of(name: HistoryName, file: HistoryFile) -> str:
    components = file.components(name.path)
    if components == 0:
        near = nearest_word(name.path, file.names)
        return f"history.h5 has no '{name.path[1:]}'" + (f"; did you mean {near[1:]}?" if near else "")
    if components == 1 and name.component is not None:
        return f"'{name.path[1:]}' is no vector"
    if components > 1 and name.component is None:
        return f"'{name.path[1:]}' is a vector: add .x, .y or .z"
    return ""


@observation("history", of="histories")
def history(o: Observation, run: Run) -> Measured:
    """Datasets of history.h5 over time."""
    file = run.histories()
    text = find_history_names(o.of)
    formula = Formula(text.text, [*text.words, "t"], run.variables)
    if not formula.ok:
        raise NotFound(formula.error)
    window = Window.of(o, run.variables)
    there = np.ones(len(file.times), dtype=bool)
    columns = {"t": file.times}
    for word, name in zip(text.words, text.names, strict=True):
        if fault := _fault_of(name, file):
            raise NotFound(fault)
        column = file.column(name.path, name.component or 0)
        columns[word] = np.full(len(there), np.nan) if column is None else column
        there &= file.sampled(name.path)
    # the last sample may stand twice
    rising = there & (file.times > np.maximum.accumulate(np.concatenate([[-np.inf], np.where(there, file.times, -np.inf)[:-1]])))
    t = file.times[rising]
    series = Series(t, formula.over({name: column[rising] for name, column in columns.items()}, len(t)))
    series = series.window(*window.widened(t)) if len(t) else series
    bad = np.flatnonzero(~np.isfinite(series.y))
    if len(bad):
        raise NotFound(f"not finite at t = {series.x[bad[0]]:.6g}")
    return Measured.of(o, run, series)


def _values_of(state: StateTable, of: Formula, where: Selection) -> tuple[np.ndarray, np.ndarray]:
    """Indices of the particles that count and the values of `of`. Raises NotFound."""
    chosen = where.of(state)
    values = state.values(of, chosen)
    if not np.all(np.isfinite(values)):
        raise NotFound(f"'of' is not finite for a particle at t = {state.t:.6g}")
    return chosen, values


@observation("particles")
def particles(o: Observation, run: Run) -> Looking:
    """A number from all particles of each field state, over time."""
    of = run.formula(o.of)
    where = Selection(o.where, of, run.variables)
    run.noted(where.formula)
    window = Window.of(o, run.variables)
    times = np.array([state.t for state in run.states])
    start, end = window.widened(times)
    points: list[tuple[float, float]] = []
    for i in np.flatnonzero((times >= start) & (times <= end)).tolist():
        state = yield i
        chosen, values = _values_of(state, of, where)
        value = o.empty if o.empty is not None and len(chosen) == 0 else reduction[o.reduce](values, state.volume[chosen])
        if not math.isfinite(value):
            raise NotFound(f"no particle counts at t = {state.t:.6g}")
        points.append((state.t, value))
    return Measured.of(o, run, Series(*np.array(points).reshape(-1, 2).T))


@observation("profile")
def profile(o: Observation, run: Run) -> Looking:
    """`of` over `along` of all particles of one state, or `reduce` of them in each of `bins` equal parts."""
    of, along = run.formula(o.of), run.formula(o.along or "0")
    compared = run.formula(o.reference.formula) if o.reference.kind == "formula" and o.take == "curve" else None
    where = Selection(o.where, of, run.variables)
    run.noted(where.formula)
    window = Window.of(o, run.variables)
    index = nearest_state(run.states, window.at) if window.at is not None else len(run.states) - 1
    if index is None:
        raise NotFound(f"there is no field state at t = {window.at:.6g}")
    state = yield index
    chosen, values = _values_of(state, of, where)
    x = state.values(along, chosen)
    if not np.all(np.isfinite(x)):
        raise NotFound("'along' is not finite for a particle")
    if len(chosen) == 0:
        raise NotFound("no particle counts")
    columns = [values] + ([state.values(compared, chosen)] if compared else [])
    if o.bins > 0:
        x, columns = _in_bins(o, x, columns, state.volume[chosen])
    order = np.argsort(x, kind="stable")
    series = Series(x[order], columns[0][order])
    if o.take != "curve":
        return Measured.of(o, run, series)
    return Measured(True, series=series, formula=columns[1][order] if compared else None)


def _in_bins(o: Observation, x: np.ndarray, columns: list[np.ndarray], volumes: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
    """One point for each bin in which there are particles: its middle, and the reduced values of each column."""
    first, width = float(np.min(x)), float(np.max(x) - np.min(x)) / o.bins
    if not width > 0:
        return x, columns
    of_bin = np.minimum(o.bins - 1, ((x - first) / width).astype(int))
    filled = np.unique(of_bin)
    members = [np.flatnonzero(of_bin == k) for k in filled]
    reduced = [np.array([reduction[o.reduce](column[m], volumes[m]) for m in members]) for column in columns]
    return first + (filled + 0.5) * width, reduced


def _attempt(step: Callable[[], int | Measured | Looking]) -> int | Measured | Looking:
    """A step of an observation; what it lacks becomes its result."""
    try:
        return step()
    except StopIteration as end:
        return end.value if isinstance(end.value, Measured) else Measured(why="the observation has returned nothing")
    except (NotFound, ExpressionFault) as fault:
        return Measured(why=str(fault))


@dataclass
class _Task:
    """An observation on its path through the states: `next` is the state that it waits for."""

    result: Measured = field(default_factory=Measured)
    looking: Looking | None = None
    next: int = -1

    def take(self, came: int | Measured | Looking) -> None:
        if isinstance(came, Measured):
            self.result, self.looking = came, None
        elif isinstance(came, int):
            self.next = came
        else:
            self.looking = came
            self.take(_attempt(lambda: next(came)))

    def send(self, state: StateTable) -> None:
        looking = self.looking
        if looking is not None:
            self.take(_attempt(lambda: looking.send(state)))


def _look_through(tasks: list[_Task], run: Run, every_state: bool) -> str:
    """Reads each state once for all that wait for it. What is wrong in states; blank: nothing."""
    garbage = ""
    try:
        states = run.states
    except NotFound:
        return ""
    unseen = 0 if every_state else len(states)
    while True:
        for task in tasks:
            if task.looking is not None and not 0 <= task.next < len(states):
                task.take(Measured(why=f"there is no field state number {task.next}"))
        index = min([task.next for task in tasks if task.looking is not None] + [unseen])
        if index == len(states):
            return garbage
        unseen += index == unseen
        try:
            state = StateTable(states[index], run.used, every_state)
        except StateFault as fault:
            garbage = garbage or str(fault)
            for task in tasks:
                if task.looking is not None and task.next == index:
                    task.take(Measured(why=str(fault)))
            continue
        for task in tasks:
            if task.looking is not None and task.next == index:
                task.send(state)


def observe_run(case: Case, variables: Variables, folder: Path, every_state: bool) -> tuple[list[Measured], str]:
    """Observations of a case in history.h5 and the field states in `folder`, in their order; and what is not finite in histories or field states,
    blank if nothing. With `every_state`, each state is looked through for numbers that are not finite, else those that are observed."""
    run = Run(folder, variables)
    tasks = [_Task() for _ in case.observations]
    for task, o in zip(tasks, case.observations, strict=True):
        used = set(run.used)
        task.take(_attempt(lambda o=o: KINDS[o.kind].function(o, run)))  # type: ignore[misc]
        if task.looking is None:
            run.used = used  # no state needs to hold what nobody looks at
    garbage = run.garbage()
    if every_state or any(task.looking for task in tasks):
        of_states = _look_through(tasks, run, every_state)
        garbage = garbage or of_states
    return [task.result for task in tasks], garbage

