"""Walls of a scene that are turned about an axis: `motion: {rotation: ...}`, by an angle or a speed over time."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..expressions import Formula
from ..key_tables import keys as keys_of_map
from ..yaml_map import Node, is_map, is_scalar
from .placeholders import substitute
from .series import read_series

if TYPE_CHECKING:
    from .basin import Basin
    from .basin_reader import BasinReader
    from .shapes import Shape

_BY = keys_of_map("how a wall is turned", "angle number|text|list|@a curve, speed number|text|list|@a curve, rpm number")
_KEYS = (*_BY, *keys_of_map("of every rotation", "about vector!, axis vector, ramp number"))
_EXAMPLE = "rotation: {about: [1, 0.5], speed: 90}, in degrees and degrees over time, or rpm: 15; angle: 30 * sin(2 * PI * TIME)"
_TIMES = 1001  # at which formulas are evaluated
_DEGREE = math.pi / 180


@dataclass
class Rotation:
    """About the unit vector `axis` through the point `about` [L]; `given`: a formula of TIME, or times and values (n, 2), of the angle [degrees] or, where
    `is_speed`, of its rate [degrees/T]."""

    about: np.ndarray
    axis: np.ndarray
    given: str | np.ndarray
    is_speed: bool

    def angles(self, end: float) -> tuple[np.ndarray, np.ndarray]:
        """Times and angles [radians] of the run; NaN where a formula has functions that the program alone knows."""
        t = np.linspace(0, end, _TIMES)
        if isinstance(self.given, str):
            formula = Formula(self.given.lower(), ("time",), {"pi": math.pi})
            value = formula.over({"time": t}, len(t)) if formula.ok else np.full(len(t), np.nan)
        else:
            value = np.interp(t, *self.given.T)
        if self.is_speed:
            value = np.append(0.0, np.cumsum((value[1:] + value[:-1]) / 2 * np.diff(t)))
        return t, np.asarray(value) * _DEGREE

    def radius(self, shape: Shape) -> float:
        """Of the point farthest from the axis [L]."""
        arm = shape.points - self.about
        return float(np.linalg.norm(arm - (arm @ self.axis)[:, None] * self.axis, axis=1).max())

    def fastest(self, shape: Shape, end: float) -> float:
        """Speed of that point [L/T], NaN where it is not known."""
        t, angle = self.angles(end)
        return float(np.abs(np.diff(angle) / np.diff(t)).max()) * self.radius(shape)

    def turned(self, points: np.ndarray, angle: float) -> np.ndarray:
        """Points (n, 3) turned by an angle [radians]."""
        arm = points - self.about
        along = (arm @ self.axis)[:, None] * self.axis
        moved: np.ndarray = self.about + along + (arm - along) * math.cos(angle) + np.cross(self.axis, arm) * math.sin(angle)
        return moved

    def inertia(self, shape: Shape, density: float) -> tuple[float, np.ndarray, np.ndarray]:
        """Mass, centre on the axis, and tensor, none of which matters, as the motion is given."""
        size = max(self.radius(shape), float(np.max(shape.high - shape.low)))
        mass = density * size**3
        return mass, self.about, mass * size**2 * np.eye(3)

    def text(self) -> str:
        where = ", ".join(f"{v:g}" for v in self.about)
        return f"turns about ({where})"


def read_rotation(reader: BasinReader, node: Node, basin: Basin) -> Rotation | None:
    """Of an entry `rotation`; None, with a message, where it is wrong."""
    if not is_map(node):
        reader.error(node, "rotation: expected a map", _EXAMPLE)
        return None
    reader.check_keys(node, "a rotation", _KEYS)
    before, dim = reader.diagnostics.errors, reader.dim or 3
    about, components = reader.vector(node, "about")
    if components and components != dim:
        reader.error(reader.get(node, "about") or node, f"about: expected {dim} components", _EXAMPLE)
    given = [key for key in _BY if reader.get(node, key) is not None]
    if len(given) != 1:
        reader.error(node, f"rotation: expected one of {', '.join(_BY)}, got {' and '.join(given) or 'none'}", _EXAMPLE)
        return None
    axis = _axis(reader, node, dim)
    key, entry = given[0], reader.get(node, given[0])
    assert entry is not None
    value = _value(reader, entry, key, basin.end)
    ramp = reader.get(node, "ramp")
    if ramp is not None:
        time = reader.length_of(ramp, "ramp", "time")
        if key == "angle" or not isinstance(value, float):
            reader.error(ramp, "ramp: the time in which a constant 'speed' or 'rpm' grows from 0", "a formula of TIME grows by itself")
        elif time:
            value = np.array([[0.0, 0.0], [time, value], [max(2 * basin.end, 2 * time), value]])
    if value is None or reader.diagnostics.errors > before:
        return None
    if isinstance(value, float):
        value = np.array([[0.0, value], [2 * basin.end, value]])
    made = Rotation(np.array(about), axis, value, key != "angle")
    first = made.angles(basin.end)[1][0] if basin.end > 0 else 0.0
    if abs(first) > 1e-9:
        reader.error(entry, f"angle: it is {first / _DEGREE:g} at the start, from where it counts: it begins with 0", "'turn' brings a shape to its first position")
        return None
    return made


def _axis(reader: BasinReader, node: Node, dim: int) -> np.ndarray:
    entry = reader.get(node, "axis")
    if dim == 2:
        if entry is not None:
            reader.error(entry, "axis: in the plane walls turn about z", "leave it out; a negative speed turns with the clock")
        return np.array([0.0, 0.0, 1.0])
    if entry is None:
        reader.error(node, "'axis' is missing: in space a wall turns about one", "axis: [0, 1, 0]")
        return np.array([0.0, 0.0, 1.0])
    axis = np.array(reader.vector(node, "axis")[0])
    if not np.linalg.norm(axis) > 0:
        reader.error(entry, "axis: expected a direction that is not zero", "axis: [0, 1, 0]")
        return np.array([0.0, 0.0, 1.0])
    unit: np.ndarray = axis / np.linalg.norm(axis)
    return unit


def _value(reader: BasinReader, entry: Node, key: str, end: float) -> float | str | np.ndarray | None:
    """A number, a formula of TIME, or times and values."""
    if not is_scalar(entry):
        rows = read_series(reader, reader.folder, entry, key)
        return None if rows is None else np.vstack([rows, [[2 * end, rows[-1, 1]]]]) if rows[-1, 0] < end else rows
    if "TIME" in entry.value.upper() and key != "rpm":
        return reader._formula(entry, key)
    value = reader.number(entry, key)
    if value is None:
        return None
    if key == "angle":
        reader.error(entry, f"angle: a constant one, {value:g}, is no motion", "turn: 30 turns a shape; angle: 30 * TIME, or speed: 30")
        return None
    return value * (6 if key == "rpm" else 1)


def check_swept(reader: BasinReader, node: Node, rotation: Rotation, shape: Shape, basin: Basin) -> None:
    """Refuses a wall that is turned through a closed side of the box."""
    if basin.box is None:
        return
    _, angles = rotation.angles(basin.end)
    if not np.isfinite(angles).all():
        return
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for angle in np.unique(np.round(np.mod(angles, 2 * math.pi), 2)).tolist():
        x = rotation.turned(shape.points, angle)
        low, high = np.minimum(low, x.min(axis=0)), np.maximum(high, x.max(axis=0))
    for k in range(basin.dim):
        for end, beyond in ((0, basin.box[0][k] - low[k]), (1, high[k] - basin.box[1][k])):
            side = basin.sides[2 * k + end]
            if side not in basin.open and beyond > 0.01 * basin.spacing + 1e-3 * rotation.radius(shape):
                reader.error(node, f"rotation: the wall goes through the side '{side}' of the box, to {'xyz'[k]} = {(low, high)[end][k]:.4g}",
                             "make the box wider there, or the wall smaller")


_DRIVEN = """\
*BOUNDARY_PRESCRIBED_MOTION_RIGID{local}
$#     pid       dof       vad      lcid        sf
${{pid:10}}${{dof:10}}${{vad:10}}${{lcid:10}}${{sf:10}}
"""


def rotation_cards(part: int, rotation: Rotation, curve: int, series: str, formula: str) -> str:
    """Prescribed motion about an axis, and its curve, of which `series` and `formula` are the headings. About another axis than x, y and z it is the third
    one of a coordinate system of the material, about whose others the body does not turn."""
    values = {"pid": float(part), "vad": 0.0 if rotation.is_speed else 2.0, "lcid": float(curve)}
    k = int(np.argmax(np.abs(rotation.axis)))
    if abs(rotation.axis[k]) > 1 - 1e-9:
        out = substitute(_DRIVEN.format(local=""), values | {"dof": 5.0 + k, "sf": math.copysign(1.0, rotation.axis[k])})
    else:
        out = substitute(_DRIVEN.format(local="_LOCAL"), values | {"dof": 7.0, "sf": 1.0})
        for dof in (5.0, 6.0):
            out += substitute(_DRIVEN.format(local="_LOCAL"), values | {"vad": 0.0, "dof": dof, "sf": 1e-30})
    head = substitute(formula if isinstance(rotation.given, str) else series, {"lcid": float(curve)})
    if isinstance(rotation.given, str):  # radians: the field SF has too few digits for that
        return out + head + f"{_DEGREE!r} * ({rotation.given})\n"
    return out + head + "".join(f"{t:20.12e}{v * _DEGREE:20.12e}\n" for t, v in rotation.given)


def local_axes(rotation: Rotation) -> tuple[np.ndarray, np.ndarray]:
    """Vectors of the first axis and of the plane of the first two of a system whose third one is the axis of rotation."""
    first = np.cross(rotation.axis, np.eye(3)[int(np.argmin(np.abs(rotation.axis)))])
    first /= np.linalg.norm(first)
    return first, np.cross(rotation.axis, first)


def is_oblique(rotation: Rotation) -> bool:
    return bool(np.abs(rotation.axis).max() <= 1 - 1e-9)
