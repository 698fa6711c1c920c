"""Inlets and outlets of a scene: entries of `inlets:` and `outlets:` in YAML, `Scene.inlet` and `Scene.outlet` in Python."""
from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..diagnostics import Location
from ..expressions import Formula
from ..key_tables import keys as keys_of_map
from ..yaml_map import Node, is_list, is_scalar
from .numbers import number_text
from .placeholders import PlaceholderFault, substitute

if TYPE_CHECKING:
    from .basin import Basin
    from .model import Model
    from .basin_reader import BasinReader

_OF_INLET = keys_of_map("an inlet", "at vector, direction vector, side text, depth number, width number, radius number, sides list, speed number!, start number, end number")
_OF_OUTLET = keys_of_map("an outlet", "side text!, level number")
_INLET = "- {at: [0, 0.8], direction: [1, 0], width: 0.1, speed: 1.5}"
_OF_CHANNEL = "- {side: left, depth: 0.3, speed: 0.5}"
_OUTLET = "- {side: right}, with level: 0.3 one that keeps a depth"
_BOX_HEAD = "*DEFINE_BOX\n$#   boxid       xmn       xmx       ymn       ymx       zmn       zmx\n"
_GAP = 2.5  # spacings
_BEYOND = 6  # spacings: more than the reach of the kernel
_TIMES = 2001  # at which a formula of the speed is evaluated
FIRST_CURVE, FIRST_SYSTEM, BOX, FIRST_BAND = 981, 981, 981, 982


@dataclass
class Inlet:
    at: np.ndarray  # centre [L]
    direction: np.ndarray  # of the flow, a unit vector
    size: tuple[float, ...]  # radius; two sides of a rectangle; in the plane half of the width [L]
    speed: float  # 0: of the formula [L/T]
    formula: str = ""  # of TIME
    start: float = 0.0
    end: float = 0.0  # 0: that of the run [T]
    surface: float | None = None  # height of the surface of the water that enters under its own pressure; None: a jet [L]
    where: Location = field(default_factory=Location)

    def waits(self, x: np.ndarray, spacing: float, end: float) -> np.ndarray:
        """Which points (n, 3) are behind the inlet, where water waits until it enters before `end` [T]. Shape (n,)."""
        along = (x - self.at) @ self.direction
        beside = x - self.at - along[:, None] * self.direction
        if len(self.size) == 1:
            within = np.linalg.norm(beside, axis=1) < self.size[0] + spacing / 4
        else:
            within = np.all([np.abs(beside @ axis) < size / 2 + spacing / 4 for axis, size in zip(across(self.direction), self.size)], axis=0)
        behind: np.ndarray = within & (along < 0) & (along > -self.length(end))
        return behind

    def length(self, end: float) -> float:
        """Of the water that enters before `end` [L]; infinite where the formula has functions that the program alone knows."""
        if not self.formula:
            return self.speed * ((self.end or end) - self.start)
        times = np.linspace(self.start, self.end or end, _TIMES)
        formula = Formula(self.formula.lower(), ("time",), {"pi": math.pi})
        speed = formula.over({"time": times}, len(times)) if formula.ok else np.full(len(times), np.nan)
        if not np.isfinite(speed).all():
            return math.inf
        return float(np.append(0.0, np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(times))).max())


@dataclass
class Outlet:
    side: str
    level: float = 0.0  # depth of the water; 0: what reaches the side leaves [L]
    where: Location = field(default_factory=Location)


def read_openings(reader: BasinReader, root: Node, basin: Basin) -> None:
    for key, example, read in (("inlets", _INLET, _read_inlet), ("outlets", _OUTLET, _read_outlet)):
        node = reader.get(root, key)
        if node is None:
            continue
        if not is_list(node) or not node.value:
            reader.error(node, f"{key}: expected a list that is not empty", example)
            continue
        for entry in node.value:
            if reader.is_map(entry, example, "an " + key[:-1]):
                read(reader, entry, basin)


def _read_inlet(reader: BasinReader, node: Node, basin: Basin) -> None:
    shapes = ("width",) if basin.dim == 2 else ("radius", "sides")
    reader.check_keys(node, "an inlet", [key for key in _OF_INLET if key in shapes or key not in ("width", "radius", "sides")])
    before = reader.diagnostics.errors
    if reader.get(node, "side") is not None or reader.get(node, "depth") is not None:
        _read_channel(reader, node, basin)
        return
    for key in ("at", "direction"):
        if reader.get(node, key) is None:
            reader.error(node, f"an inlet: '{key}' is missing", f"{_INLET}; at the end of a channel {_OF_CHANNEL}")
    if reader.diagnostics.errors > before:
        return
    vectors = [reader.vector(node, key) for key in ("at", "direction")]
    if any(dim and dim != basin.dim for _, dim in vectors):
        reader.error(node, f"an inlet: at and direction have {basin.dim} components, as the scene", _INLET)
    (at, _), (direction, dim) = vectors
    length = math.hypot(*direction)
    if dim and not length > 0:
        reader.error(node, "direction: expected a direction of the flow that is not zero", _INLET)
    given = [key for key in shapes if reader.get(node, key) is not None]
    if len(given) != 1:
        reader.error(node, f"an inlet: expected {' or '.join(shapes)}", _INLET if basin.dim == 2 else "radius: 0.05, or sides: [0.1, 0.2]")
        return
    size = _size(reader, node, given[0])
    speed, formula, start, end = _course(reader, node)
    if reader.diagnostics.errors == before:
        basin.inlets.append(Inlet(np.array(at), np.array(direction) / length, size, speed, formula, start, end, where=reader.at(node)))


def _read_channel(reader: BasinReader, node: Node, basin: Basin) -> None:
    """The inflow of a channel: water of a depth through an open side of the box."""
    before = reader.diagnostics.errors
    for key in ("at", "direction", "width", "radius", "sides"):
        if (entry := reader.get(node, key)) is not None:
            reader.error(entry, f"'{key}' does not go with 'side' and 'depth', which give it", _OF_CHANNEL)
    entry = reader.get(node, "side")
    ends = {"left": (0, 0), "right": (0, 1)} | ({"front": (1, 0), "back": (1, 1)} if basin.dim == 3 else {})
    side = reader.text(entry) if entry is not None else ""
    if side not in ends:
        reader.error(entry or node, f"side: water enters through {', '.join(ends)}, got '{side}'" if side else "'side' is missing: 'depth' goes with it", _OF_CHANNEL)
    elif basin.box is None:
        reader.error(node, "an inlet on a side of the box, and the scene has no box", "box: {low: [0, 0], high: [4, 1], open: [top, left]}")
    elif side not in basin.open:
        reader.error(node, f"an inlet on the side '{side}', which has a wall", f"open: [{', '.join(sorted(basin.open | {side}))}] of the box")
    if reader.get(node, "depth") is None:
        reader.error(node, "'depth' is missing: of the water that enters through the side", _OF_CHANNEL)
    depth = reader.length(node, "depth") if reader.get(node, "depth") is not None else 0.0
    speed, formula, start, end = _course(reader, node)
    if not basin.gravity > 0:
        reader.error(node, "an inlet with a depth, and there is no gravity", "at, direction and width give a jet")
    if reader.diagnostics.errors > before or basin.box is None:
        return
    low, high, up = np.array(basin.box[0], float), np.array(basin.box[1], float), basin.dim - 1
    axis, which = ends[side]
    at, direction = (low + high) / 2, np.zeros(3)
    at[axis], direction[axis] = (low, high)[which][axis], 1.0 if which == 0 else -1.0
    at[up] = low[up] + depth / 2
    size = (depth / 2,) if basin.dim == 2 else (float((high - low)[1 - axis]), depth)
    if basin.dim == 2:
        at[2] = 0.0
    basin.inlets.append(Inlet(at, direction, size, speed, formula, start, end, float(low[up] + depth), reader.at(node)))


def _course(reader: BasinReader, node: Node) -> tuple[float, str, float, float]:
    """Speed, or its formula, and the times between which water enters."""
    speed, formula = _speed(reader, node)
    start = reader.number(reader.get(node, "start"), "start") or 0.0 if reader.get(node, "start") is not None else 0.0  # type: ignore[arg-type]
    end = reader.length(node, "end", "time") if reader.get(node, "end") is not None else 0.0
    if start < 0 or (end and end <= start):
        reader.error(node, "an inlet: 'start' is a time >= 0, 'end' one behind it")
    return speed, formula, start, end


def check_inlets(reader: BasinReader, basin: Basin) -> None:
    """Refuses inlets too near in front of a mirror: the water would be held by its own image; and jets beside inflows of channels."""
    levels = {inlet.surface for inlet in basin.inlets}
    if len(levels) > 1:
        reader.diagnostics.error(basin.inlets[-1].where, "inlets of a scene are all jets, or all have one level of the water",
                                 f"levels: {', '.join('a jet' if one is None else f'{one:g}' for one in sorted(levels, key=str))}")
    for inlet in basin.inlets if basin.box else ():
        for k, half in enumerate(_half_extents(inlet, basin.dim)):
            for end, beyond in enumerate((basin.box[0][k] - (inlet.at[k] - half), inlet.at[k] + half - basin.box[1][k])):  # type: ignore[index]
                side = basin.sides[2 * k + end]
                if beyond > 0.5 * basin.spacing and side not in basin.open:
                    reader.diagnostics.error(inlet.where, f"an inlet reaches {beyond:.4g} beyond the wall '{side}' of the box: that part of the water would fall outside",
                                             "move 'at' into the box, or make the inlet smaller")
    for inlet in basin.inlets if basin.mirrors and basin.box else ():
        for k in range(basin.dim):
            end = 0 if inlet.direction[k] > 0 else 1
            wall = basin.box[end][k]  # type: ignore[index]
            side = basin.sides[2 * k + end]
            gap = (inlet.at[k] - wall) * (1 if end == 0 else -1)
            if abs(inlet.direction[k]) > 0.5 and side not in basin.open and gap < _GAP * basin.spacing * (1 - 1e-6):
                there = inlet.at.copy()
                there[k] = wall + _GAP * basin.spacing * (1 if end == 0 else -1)
                reader.diagnostics.error(inlet.where, f"an inlet {gap:.4g} in front of the wall '{side}' of the box, nearer than "
                                         f"{_GAP:g} spacings: as the wall is a mirror, the water would be held by its image",
                                         f"at: [{', '.join(f'{v:.4g}' for v in there[: basin.dim])}], or wall_method: contact")


def _half_extents(inlet: Inlet, dim: int) -> list[float]:
    """Half of the extents of the mouth of an inlet along the axes [L]."""
    d = inlet.direction
    if dim == 2 or len(inlet.size) == 1:
        return [inlet.size[0] * math.sqrt(max(0.0, 1 - float(d[k]) ** 2)) for k in range(dim)]
    level = np.array([-d[1], d[0], 0.0]) if math.hypot(d[0], d[1]) > 1e-9 else np.array([1.0, 0.0, 0.0])
    level /= np.linalg.norm(level)
    upright = np.cross(d, level)
    return [float(abs(level[k]) * inlet.size[0] + abs(upright[k]) * inlet.size[1]) / 2 for k in range(dim)]


def _size(reader: BasinReader, node: Node, key: str) -> tuple[float, ...]:
    if key != "sides":
        value = reader.length(node, key)
        return (value / 2 if key == "width" else value,)
    entry = reader.get(node, "sides")
    if entry is None or not is_list(entry) or len(entry.value) != 2:
        reader.error(entry or node, "sides: expected two lengths", "sides: [0.1, 0.2], across the direction; the second is the more upright one")
        return (0.0, 0.0)
    return reader.length_of(entry.value[0], "sides"), reader.length_of(entry.value[1], "sides")


def _speed(reader: BasinReader, node: Node) -> tuple[float, str]:
    """A number, or a formula of TIME."""
    entry = reader.get(node, "speed")
    if entry is not None and is_scalar(entry) and "TIME" in entry.value:
        try:
            return 0.0, substitute(entry.value, reader.variables)
        except PlaceholderFault as fault:
            reader.error(entry, fault.message)
            return 0.0, ""
    return reader.length(node, "speed", "speed, or a formula of TIME,"), ""


def _read_outlet(reader: BasinReader, node: Node, basin: Basin) -> None:
    reader.check_keys(node, "an outlet", _OF_OUTLET)
    entry = reader.get(node, "side")
    sides = [side for side in basin.sides if side != "top"]
    side = reader.text(entry) if entry is not None else ""
    if side not in sides:
        what = f"side: '{side}' is no side of the box through which water leaves" if side else "'side' is missing"
        reader.error(entry or node, what, f"sides: {', '.join(sides)}")
        return
    if basin.box is None:
        reader.error(node, "an outlet is an open side of the box, and the scene has no box", "box: {low: [0, 0], high: [2, 1], open: [top, right]}")
        return
    if side not in basin.open:
        reader.error(node, f"an outlet on the side '{side}', which has a wall", f"open: [{', '.join(sorted(basin.open | {side}))}] of the box")
    level = reader.length(node, "level") if reader.get(node, "level") is not None else 0.0
    if level and side == "bottom":
        reader.error(node, "level: of outlets at the ends of a channel", "leave it out")
    if any(one.side == side for one in basin.outlets):
        reader.error(node, f"two outlets on the side '{side}'")
    basin.outlets.append(Outlet(side, level, reader.at(node)))


def add_openings(basin: Basin, model: Model) -> None:
    """Cards of inlets and outlets."""
    for number, inlet in enumerate(basin.inlets):
        model.keywords.append(_inlet_cards(inlet, number, basin))
        how = f"formula {inlet.formula}" if inlet.formula else f"{inlet.speed:g}"
        at = ", ".join(f"{v:g}" for v in inlet.at[: basin.dim])
        model.choices.append((f"water enters at ({at}), speed {how}", "given" if inlet.surface is None else
                              f"given; under the pressure below its surface at {inlet.surface:g}, so that it joins the water of a channel",
                              "*DEFINE_SPH_INJECTION" + ("" if len(inlet.size) > 1 else "_SIMPLIFIED") + ("" if inlet.surface is None else ", *COURANT_INFLOW")))
    if basin.inlets and (surface := basin.inlets[0].surface) is not None:
        point = [0.0, surface, 0.0] if basin.dim == 2 else [0.0, 0.0, surface]
        model.keywords.append("*COURANT_INFLOW\n$#     pid      surf        xs        ys        zs\n" + _row(1, 2, *point))
    if basin.outlets:
        model.keywords.append(_outlet_cards(basin))
        for outlet in basin.outlets:
            model.choices.append((f"water leaves at the side '{outlet.side}'" + (f", which keeps a depth of {outlet.level:g}" if outlet.level else ""),
                                  "what is beyond goes on with its velocity, acts on the water before it while it is near, and is not in the results",
                                  "*CONTROL_SPH BOXID" + (", *COURANT_LEVEL_OUTLET" if outlet.level else "")))


def _row(*values: float | int) -> str:
    return "".join((f"{v:10}" if isinstance(v, int) else number_text(v + 0.0, 10).rjust(10)) for v in values) + "\n"


def _inlet_cards(inlet: Inlet, number: int, basin: Basin) -> str:
    curve, out = FIRST_CURVE + number, "$ Inlet\n"
    end = inlet.end or 1e20
    if inlet.formula:
        out += f"*DEFINE_CURVE_FUNCTION\n$#    lcid\n{curve:10}\n{inlet.formula}\n"
    if len(inlet.size) == 1:
        speed = -float(curve) if inlet.formula else inlet.speed
        return (out + "*DEFINE_SPH_INJECTION_SIMPLIFIED\n$#     pid       vel    radius     psize     offst       cid       nid\n"
                + _row(1, speed, inlet.size[0], basin.spacing, 0.0, 0, 0) + "$#      xc        yc        zc       dnx       dny       dnz      tbeg      tend\n"
                + _row(*inlet.at.tolist(), *inlet.direction.tolist(), inlet.start, end))
    first, second = across(inlet.direction)
    velocity = inlet.direction * (1.0 if inlet.formula else inlet.speed)
    system = FIRST_SYSTEM + number
    out += "*DEFINE_COORDINATE_SYSTEM\n$#     cid        xo        yo        zo        xl        yl        zl\n"
    out += _row(system, *inlet.at.tolist(), *(inlet.at + first).tolist()) + "$#      xp        yp        zp\n" + _row(*(inlet.at + second).tolist())
    return (out + "*DEFINE_SPH_INJECTION\n$#     pid      nsid       cid        vx        vy        vz      area      vmag\n"
            + _row(1, 0, system, *velocity.tolist(), 0.0, -curve if inlet.formula else 0)
            + "$#    tbeg      tend       nid    radius      xlen      ylen     psize\n"
            + _row(inlet.start, end, 0, 0.0, *inlet.size, basin.spacing))


def across(direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors across a flow, so that the third axis is the flow: the first is level, the second the more upright one."""
    level = np.cross([0.0, 0.0, 1.0], direction)
    if np.linalg.norm(level) < 1e-6:
        level = np.array([1.0, 0.0, 0.0])
    level = level / np.linalg.norm(level)
    return level, np.cross(direction, level)


def _outlet_cards(basin: Basin) -> str:
    """A computational box that ends at outlets, and is far beyond the scene elsewhere."""
    assert basin.box
    low, high = (np.array(v, dtype=float) for v in basin.box)
    far = 10 * float((high - low)[: basin.dim].max())
    ends = [[low[k] - far, high[k] + far] for k in range(3)]
    out = "$ Outlets: particles outside of this box keep their state and velocity\n"
    names = {"left": (0, 0), "right": (0, 1), "bottom": (basin.dim - 1, 0)} | ({"front": (1, 0), "back": (1, 1)} if basin.dim == 3 else {})
    for number, outlet in enumerate(basin.outlets):
        axis, end = names[outlet.side]
        ends[axis][end] = edge = (low, high)[end][axis]
        if outlet.level:
            # water beyond the end of the box holds the one before it from the first step on
            ends[axis][end] = edge = edge + (-1 if end else 1) * _BEYOND * basin.spacing
            # a band of six spacings or half a depth, which takes the velocity within the time that waves need through it
            wide = max(6 * basin.spacing, outlet.level / 2)
            band = [[low[k], high[k]] for k in range(3)]
            band[axis] = [edge - wide, edge] if end else [edge, edge + wide]
            if basin.dim == 2:
                band[2] = [-1.0, 1.0]
            out += _BOX_HEAD + _row(FIRST_BAND + number, *(float(v) for pair in band for v in pair))
            out += "*COURANT_LEVEL_OUTLET\n$#   boxid     level       tau       dir\n"
            out += _row(FIRST_BAND + number, outlet.level, wide / math.sqrt(basin.gravity * outlet.level), (axis + 1) * (1 if end else -1))
    out += _BOX_HEAD + _row(BOX, *(float(v) for pair in ends for v in pair))
    return out


def with_outlets(cards: str, basin: Basin) -> str:
    """The cards of the water, with *CONTROL_SPH of a scene with outlets: what is outside of the box is not in the results and touches nothing."""
    if not basin.outlets:
        return cards
    usual = "         1         0    1.0e20" + _row(basin.dim)
    assert usual in cards
    return cards.replace(usual, _row(1, BOX, 1e20, basin.dim) + "$#    cont     deriv       ini     ishow     ierod     icont\n" + _row(0, 0, 0, 1, 0, 1))
