"""Expressions over the particles of field states."""
from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..diagnostics import Diagnostics
from ..expressions import Formula
from ..fields import StateFiles, Wanted, read_particles
from .names import PARTICLE_VARIABLES

# The arrays of a field file that scalars come from.
_SOURCES = {"p": "pressure", "rho": "density", "m": "mass", "e": "internal_energy", "part": "part", "id": "id", "active": "active"}
_VELOCITY = ("vx", "vy", "vz", "speed")


class StateFault(Exception):
    """A state that cannot be read, or holds numbers that are not finite."""


def first_error(diagnostics: Diagnostics) -> str:
    """The first error with its file, on one line."""
    return next((f"{d.where.file}: {d.message}" for d in diagnostics.all if d.severity == "error"), "unknown fault")


class StateTable:
    """The columns of PARTICLE_VARIABLES for all particles of a state, each of shape (size,)."""

    def __init__(self, state: StateFiles, used: set[str], everything: bool = False) -> None:
        """Reads the variables in `used`, with `everything` what else the file has. Raises StateFault."""
        used = used | {"active"}
        wanted = [Wanted(array, 1, name not in used) for name, array in _SOURCES.items() if everything or name in used]
        if everything or used.intersection(_VELOCITY):
            wanted.append(Wanted("velocity", 3, not used.intersection(_VELOCITY)))
        faults = Diagnostics()
        frame = read_particles(state, wanted, faults)
        if frame is None:
            raise StateFault(first_error(faults))
        self.t, self.size = frame.t, len(frame)
        self.volume, self.length = frame.V, frame.h
        self.columns: dict[str, np.ndarray] = dict(zip("xyz", frame.x.T, strict=True))
        self.columns |= {"h": frame.h, "V": frame.V}
        self.columns |= {name: frame.arrays[array] for name, array in _SOURCES.items() if array in frame.arrays}
        if "velocity" in frame.arrays:
            v = frame.arrays["velocity"]
            self.columns |= {**dict(zip(_VELOCITY, v.T, strict=False)), "speed": np.sqrt(np.sum(v * v, axis=1))}
        for name in PARTICLE_VARIABLES:
            if name in self.columns and not np.all(np.isfinite(self.columns[name])):
                raise StateFault(f"{state.particles}: {name} of a particle is not finite at t = {self.t:.6g}")

    def values(self, formula: Formula, chosen: np.ndarray) -> np.ndarray:
        """Of a formula over PARTICLE_VARIABLES, for particles with these indices; shape of `chosen`."""
        table: Mapping[str, np.ndarray | float] = {name: self.t if name == "t" else self.columns[name][chosen] for name in formula.used}
        return formula.over(table, len(chosen))


class Selection:
    """Which particles count: those that are active, unless `where` or `of` asks for `active` itself, and for which `where` > 0."""

    def __init__(self, where: str, of: Formula, parameters: Mapping[str, float]) -> None:
        self.formula = Formula(where or "1", PARTICLE_VARIABLES, parameters)
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
