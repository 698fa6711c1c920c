"""What expressions over particles may name, and the arrays of field files that it comes from."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from .expressions import Formula
from .fields import ParticleFrame, Wanted


class _Variable(NamedTuple):
    array: str  # of the field file; "": read anyway
    component: int  # -1: the length of the vector
    dimension: str


_VARIABLES = {axis: _Variable("", a, "L") for a, axis in enumerate("xyz")}
_VARIABLES |= {name: _Variable("velocity", a, "L/T") for name, a in (("vx", 0), ("vy", 1), ("vz", 2), ("speed", -1))}
_VARIABLES |= {"p": _Variable("pressure", 0, "M/LT2"), "rho": _Variable("density", 0, "M/L3"), "h": _Variable("", 0, "L")}
_VARIABLES |= {"m": _Variable("mass", 0, "M"), "V": _Variable("", 0, "L3"), "e": _Variable("internal_energy", 0, "M/LT2")}
_VARIABLES |= {name: _Variable(name, 0, "-") for name in ("part", "id", "active")} | {"t": _Variable("", 0, "T")}
VARIABLES = tuple(_VARIABLES)  # V: m/rho; e: internal energy per reference volume; id of the deck; active: 1 or 0; t: of the state


def dimension_of(name: str) -> str | None:
    """ "L/T"; None of no variable."""
    return _VARIABLES[name].dimension if name in _VARIABLES else None


def wanted_array(name: str, optional: bool = False) -> Wanted:
    """An array of a field file with the components that it has there."""
    return Wanted(name, 3 if name == "velocity" else 1, optional)


def arrays_of(names: Iterable[str], optional: bool = False) -> list[Wanted]:
    """Arrays of a field file that variables need."""
    return [wanted_array(name, optional) for name in sorted({_VARIABLES[variable].array for variable in names} - {""})]


def wanted_arrays(*formulas: Formula) -> list[Wanted]:
    """Arrays of a field file that expressions over particles need."""
    return arrays_of({variable for formula in formulas for variable in formula.used})


def variable_of(frame: ParticleFrame, name: str) -> np.ndarray | float | None:
    """Values of one of VARIABLES for all particles, shape (n,), or one number for all; None where the array was not read."""
    at = _VARIABLES[name]
    if not at.array:
        whole: dict[str, np.ndarray | float] = {"h": frame.h, "V": frame.V, "t": frame.t}
        return whole[name] if name in whole else frame.x[:, at.component]
    values = frame.arrays.get(at.array)
    if values is None or values.ndim == 1:
        return values
    return np.hypot(np.hypot(values[:, 0], values[:, 1]), values[:, 2]) if at.component < 0 else values[:, at.component]
