"""Waves of a driven wall: the keys of `motion: {waves: ...}`."""
from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..diagnostics import Location
from ..key_tables import keys as keys_of_map
from ..waves import KINDS, MAKERS, Absorption, WaveFault, Waves
from ..words import did_you_mean, shortest
from ..yaml_map import Node, is_list, is_scalar
from .series import read_record

if TYPE_CHECKING:
    from .basin_reader import BasinReader

# Keys that each kind uses, beside `kind`, `depth` and `towards`. Any other is refused, as it would be ignored.
_IRREGULAR = ("height", "period", "seed", "components", "ramp")
_USED = {
    "regular": ("height", "period", "ramp"),
    "second_order": ("height", "period", "ramp"),
    "focused": ("height", "period", "focus", "gamma", "components", "ramp"),
    "jonswap": (*_IRREGULAR, "gamma"),
    "pierson_moskowitz": _IRREGULAR,
    "solitary": ("height",),
    "elevation": ("record", "ramp"),
    "displacement": ("record",),
    "still": ("period",),
}
_FLAPS = ("regular", "focused", "jonswap", "pierson_moskowitz", "elevation", "still")
# Periods in which the drift of absorption goes back. Its filter shifts other waves than those of the period: of a spectrum more may be among them.
_DRIFT = {"regular": 1.0, "second_order": 1.0, "still": 1.0}
_DRIFT_OF_OTHERS = 2.0
_AWAY = {"piston": 2.0, "flap": 4.0}  # spacings from the paddle to the level that it measures: h, and the support of the kernel
_KEYS = keys_of_map(
    "waves",
    "kind text, depth number, height number, period number, seed number, gamma number, focus any, components number, ramp number, record text|list, "
    "towards text, maker text, hinge number, absorb number|flag, drift number|flag",
)
_SIDES = {"x": ("x", 1.0), "-x": ("x", -1.0), "y": ("y", 1.0), "-y": ("y", -1.0)}


@dataclass
class Piston:
    """A wall that makes waves. `series`: time and displacement along `axis` (n, 2); `sign`: 1 where the water is towards greater values of it;
    `depth`: 0 where none is given."""

    axis: str
    sign: float
    series: np.ndarray
    depth: float
    where: Location  # of the depth, or of the waves
    where_towards: Location
    maker: str = "piston"
    hinge: float = 0.0  # of a flap, above the bed [L]
    absorb: float = 0.0  # factor of *COURANT_WAVE_MAKER; 0: waves that come back are reflected
    delay: float = 0.0  # of the measured level; 0: that of long waves [T]
    away: float = 0.0  # of the measured level, from the paddle [L]
    drift: float = 0.0  # time constant in which the drift of absorption goes back; 0: it stays [T]
    elevation: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))  # at `away`, of what absorbs
    space: float = 0.0  # for displacements by absorption; 0: not known [L]

    @property
    def own_card(self) -> bool:
        """Whether *COURANT_WAVE_MAKER moves it, not a prescribed motion."""
        return self.maker != "piston" or self.absorb > 0


def read_waves(reader: BasinReader, node: Node, gravity: float, end: float, spacing: float) -> Piston | None:
    """The motion of a wall; None, with a message, where there is none."""
    if not reader.is_map(node, "waves: {kind: regular, depth: 0.5, height: 0.1, period: 1.4}", "waves"):
        return None
    reader.check_keys(node, "waves", _KEYS)
    before = reader.diagnostics.errors
    kind_node = reader.get(node, "kind")
    kind = reader.text(kind_node) if kind_node is not None else "regular"
    if kind not in (*KINDS, "displacement", "still"):
        reader.error(kind_node or node, f"no kind of waves '{kind}'", f"{did_you_mean(kind, KINDS)}{', '.join(KINDS)}, displacement, still")
        return None
    maker, hinge, absorbs = _read_maker(reader, node, kind)
    of_maker = (*(("maker",) if kind in _FLAPS else ()), *(("hinge",) if maker == "flap" else ()), *(("absorb",) if kind != "displacement" else ()), *(("drift",) if absorbs else ()))
    for key in _KEYS:
        if (entry := reader.get(node, key)) is not None and key not in ("kind", "depth", "towards", *of_maker, *_USED[kind]):
            reader.error(entry, f"waves: '{key}' has no effect on kind {kind}", f"its keys: {', '.join(('depth', *_USED[kind], 'towards', *of_maker))}")
    towards_node = reader.get(node, "towards")
    towards = reader.text(towards_node) if towards_node is not None else "x"
    sides = [side for side in _SIDES if reader.dim != 2 or side.endswith("x")]  # y is upwards in the plane
    if towards not in sides:
        reader.error(towards_node or node, f"towards: '{towards}' is no direction", ", ".join(sides))
        return None
    numbers = {key: value for key in ("depth", "height", "period", "gamma", "ramp", "drift") if (value := _number(reader, node, key)) is not None}
    whole = {key: value for key in ("seed", "components") if (value := _whole(reader, node, key)) is not None}
    record = _record(reader, node, kind, end) if kind in ("elevation", "displacement") else None
    focus_node = reader.get(node, "focus")
    focus = None
    if focus_node is not None:
        if not is_list(focus_node) or len(focus_node.value) != 2:
            reader.error(focus_node, "focus: expected [distance from the wall, time]", "focus: [4, 12]")
        else:
            focus = (reader.number(focus_node.value[0], "focus") or 0.0, reader.number(focus_node.value[1], "focus") or 0.0)
    if numbers.get("drift", 0.0) < 0:
        reader.error(reader.get(node, "drift") or node, f"drift: expected a time of 0 or more, got {shortest(numbers['drift'])}")
    if reader.diagnostics.errors > before:
        return None
    axis, sign = _SIDES[towards]
    depth, drift = numbers.get("depth", 0.0), numbers.pop("drift", None)
    where, where_towards = reader.at(reader.get(node, "depth") or node), reader.at(towards_node or node)
    if kind == "displacement":
        if record is None:
            return None
        return Piston(axis, sign, np.column_stack([record[:, 0], sign * record[:, 1]]), depth, where, where_towards)
    away = _AWAY[maker] * spacing
    if kind == "still":
        if not depth > 0:
            reader.error(node, "waves: 'depth' is missing: the level that a still paddle keeps", "depth: 0.5")
            return None
        try:  # of waves that come there; without a period: long ones
            period = numbers.get("period", 0.0)
            back = _DRIFT[kind] * period if drift is None else drift
            absorption = Absorption(1.0, 0.0)
            if "period" in numbers:
                absorption = Waves("regular", depth, 1e-6 * depth, period, gravity, maker=maker, hinge=hinge).absorption(away, back)
        except WaveFault as fault:
            reader.error(reader.get(node, fault.key) or node, f"waves: {fault}", fault.hint)
            return None
        series = np.array([[0.0, 0.0], [end, 0.0]])
        return Piston(axis, sign, series, depth, where, where_towards, maker, hinge, absorption.factor, absorption.delay, away, back)
    try:
        waves = Waves(kind, g=gravity, focus=focus, record=record if record is not None else np.empty((0, 2)), maker=maker, hinge=hinge,
                      **({"depth": 0.0} | numbers), **whole)  # type: ignore[arg-type]
        made = waves.displacement(end)
        elevation = waves.at_paddle(end, away) if absorbs else np.empty((0, 2))
        if focus is not None and focus[0] > (gone := waves.group_velocity() * focus[1]):
            what = f"focus: waves of the period go {gone:.3g} in the time {shortest(focus[1])}: they do not meet at {shortest(focus[0])}"
            reader.diagnostics.warning(reader.at(focus_node or node), what, "a later time, or a smaller distance")
    except WaveFault as fault:
        reader.error(reader.get(node, fault.key) or node, f"waves: {fault}", fault.hint)
        return None
    back = _DRIFT.get(kind, _DRIFT_OF_OTHERS) * waves.period if drift is None else drift
    absorption = waves.absorption(away, back) if absorbs else Absorption(0.0, 0.0)
    return Piston(axis, sign, np.column_stack([made[:, 0], sign * made[:, 1]]), depth, where, where_towards, maker, hinge, absorption.factor, absorption.delay, away,
                  back, elevation)


def _read_maker(reader: BasinReader, node: Node, kind: str) -> tuple[str, float, bool]:
    """Piston or flap, the height of its hinge, and whether it absorbs."""
    entry = reader.get(node, "maker")
    maker = reader.text(entry) if entry is not None else "piston"
    if maker not in MAKERS:
        reader.error(entry or node, f"no wave maker '{maker}'", f"{did_you_mean(maker, MAKERS)}{', '.join(MAKERS)}")
    elif maker == "flap" and kind in KINDS and kind not in _FLAPS:
        reader.error(entry or node, f"waves: a flap makes no waves of kind {kind}: their theory is that of a piston", "maker: piston")
    absorb = reader.get(node, "absorb")
    if absorb is not None and (not is_scalar(absorb) or absorb.value not in ("true", "false")):
        reader.error(absorb, "waves: 'absorb' is true or false")
    absorbs = absorb is not None and absorb.value == "true"
    if kind == "still" and not absorbs:
        reader.error(absorb or node, "waves: a still paddle without 'absorb: true' is a wall", "leave out its motion, or absorb: true")
    return maker, _number(reader, node, "hinge") or 0.0, absorbs


def check_reach(reader: BasinReader, node: Node, axis: str, series: np.ndarray, points: np.ndarray, low: float, high: float, piston: Piston | None = None) -> None:
    """A wall that leaves the box lets its water out beside it. Notes how far absorption may move a wave maker."""
    a = "xyz".index(axis)
    top = 1.0
    if piston is not None and piston.maker == "flap":  # its upper edge goes farther than the still level
        up = points[:, reader.dim - 1]
        top = max(1.0, (float(np.ptp(up)) - piston.hinge) / (piston.depth - piston.hinge))
    least, most = float(points[:, a].min() + top * series[:, 1].min()), float(points[:, a].max() + top * series[:, 1].max())
    if piston is not None:
        piston.space = min(least - low, high - most) / top
    if least < low - 1e-9 or most > high + 1e-9:
        reader.error(node, f"waves: the wall goes from {axis} = {shortest(round(least, 6))} to {shortest(round(most, 6))}, and leaves the box, which is from {shortest(low)} to "
                     f"{shortest(high)}", "make the box wider on that side, or the waves lower or shorter")


def _number(reader: BasinReader, node: Node, key: str) -> float | None:
    entry = reader.get(node, key)
    return None if entry is None else reader.number(entry, key)


def _whole(reader: BasinReader, node: Node, key: str) -> int | None:
    entry = reader.get(node, key)
    value = _number(reader, node, key)
    if entry is None or value is None:
        return None
    if value != math.floor(value):
        reader.error(entry, f"{key}: expected a whole number, got {shortest(value)}")
        return None
    return int(value)


def _record(reader: BasinReader, node: Node, kind: str, end: float) -> np.ndarray | None:
    entry = reader.get(node, "record")
    if entry is None:
        reader.error(node, "'record' is missing: a file of time and value, two numbers a line")
        return None
    rows = read_record(reader, reader.folder, entry, "record")
    if rows is not None and (rows[0, 0] > 0 or end > rows[-1, 0]):
        kept = "the record repeats before and after" if kind == "elevation" else "its first and last value hold before and after"
        times = f"{shortest(rows[0, 0])} to {shortest(rows[-1, 0])}"
        text = f"record: '{reader.text(entry)}' has times {times}, the run 0 to {shortest(end)}: {kept}"
        reader.diagnostics.warning(reader.at(entry), text, "a record from 0 to the end of the run")
    return rows
