"""Expressions over the particles of field states."""
from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..diagnostics import Diagnostics
from ..expressions import Formula
from ..fields import StateFiles, read_particles
from ..variables import VARIABLES, arrays_of, variable_of

class StateFault(Exception):
    """A state that cannot be read, or holds numbers that are not finite."""


def first_error(diagnostics: Diagnostics) -> str:
    """The first error with its file, on one line."""
    return next((f"{d.where.file}: {d.message}" for d in diagnostics.all if d.severity == "error"), "unknown fault")


class StateTable:
    """VARIABLES of all particles of a state, each of shape (size,)."""

    def __init__(self, state: StateFiles, used: set[str], everything: bool = False) -> None:
        """Reads the variables in `used`, with `everything` what else the file has. Raises StateFault."""
        wanted, faults = arrays_of(used | {"active"}), Diagnostics()
        named = {one.name for one in wanted}
        wanted += [one for one in arrays_of(VARIABLES, optional=True) if everything and one.name not in named]
        frame = read_particles(state, wanted, faults)
        if frame is None:
            raise StateFault(first_error(faults))
        self.frame, self.t, self.size = frame, frame.t, len(frame)
        self.volume, self.length = frame.V, frame.h
        found = {name: variable_of(frame, name) for name in VARIABLES}
        self.columns = {name: np.broadcast_to(values, (self.size,)) for name, values in found.items() if values is not None}
        for name, values in self.columns.items():
            if not np.all(np.isfinite(values)):
                raise StateFault(f"{state.particles}: {name} of a particle is not finite at t = {self.t:.6g}")

    def values(self, formula: Formula, chosen: np.ndarray) -> np.ndarray:
        """Of a formula over VARIABLES, for particles with these indices; shape of `chosen`."""
        return formula.over({name: self.columns[name][chosen] for name in formula.used}, len(chosen))


class Selection:
    """Which particles count: those that are active, unless `where` or `of` asks for `active` itself, and for which `where` > 0."""

    def __init__(self, where: str, of: Formula, parameters: Mapping[str, float]) -> None:
        self.formula = Formula(where or "1", VARIABLES, parameters)
        self._inactive = self.formula.uses("active") or of.uses("active")
        self._everything = not where

    def of(self, state: StateTable) -> np.ndarray:
        """Indices of the particles that count, rising."""
        chosen = np.arange(state.size) if self._inactive else np.flatnonzero(state.columns["active"] > 0)
        if self._everything:
            return chosen
        return chosen[state.values(self.formula, chosen) > 0]


def nearest_state(states: Sequence[StateFiles], t: float) -> int | None:
    """Index of the state whose time is nearest to t, None if one is missing there: |t_state - t| is at most half the largest distance of two
    states."""
    if not states:
        return None
    times = np.array([state.t for state in states])
    best = int(np.argmin(np.abs(times - t)))
    gap = float(np.max(np.diff(times))) if len(times) > 1 else 0.0
    return best if abs(times[best] - t) <= max(gap / 2, 1e-9 * abs(t)) else None
