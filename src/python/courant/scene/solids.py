"""Walls and rigid bodies of a scene, and the cards that they need."""
from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..diagnostics import Location
from ..expressions import Formula
from .model import Part, Vector
from .placeholders import substitute
from .rotations import Rotation, is_oblique, local_axes, rotation_cards
from .shapes import Shape

if TYPE_CHECKING:
    from .basin import Basin
    from .wave_reader import Piston

_TIMES = 2001  # at which motions are evaluated
FREE = ("x", "y", "z", "rx", "ry", "rz")
FIRST_WALL, FIRST_BODY, FIRST_CURVE = 12, 101, 901
SOLIDS, HELD, BODIES, MIRRORS = 2, 3, 4, 5  # sets of parts: all, those that do not move freely, those that do, those that mirror
_HELD_BY = {"": 0, "x": 1, "y": 2, "z": 3, "xy": 4, "yz": 5, "xz": 6, "xyz": 7}  # CON1 and CON2 of *MAT_RIGID


@dataclass
class Solid:
    """A rigid shape, held if nothing else is said."""

    shape: Shape
    closed: bool = True
    motion: dict[str, str | np.ndarray] = field(default_factory=dict)  # displacements by axis, formulas of TIME, or (n, 2) time and displacement [L]
    rotation: Rotation | None = None  # of a wall that turns
    free: bool = False  # moves by the forces on it
    density: float = 0.0  # of a free one [M/L3]
    velocity: Vector | None = None  # of a free one, at the start [L/T]
    hold: set[str] = field(default_factory=set)  # directions and turns that a free one does not take
    where: Location = field(default_factory=Location)
    part: int = 0
    piston: Piston | None = None  # that makes waves
    by_contact: bool = False  # it has too many faces to be a mirror

    @property
    def driven(self) -> bool:
        """A wall whose motion is given."""
        return bool(self.motion) or self.rotation is not None

    def mirrors(self, method: str) -> bool:
        """Whether it is a mirror: of mixed methods, what moves freely, as contact lets bodies sink too deep."""
        return method in ("mirrors", "ghosts") or (method == "mixed" and self.free and not self.by_contact)


_RIGID = """\
*MAT_RIGID
$#     mid        ro         e        pr
${mid:10}${ro:10}${young:10}       0.3
$#     cmo      con1      con2
         1${con1:10}${con2:10}
$#      a1        a2        a3        v1        v2        v3
${a1:10}${a2:10}${a3:10}${v1:10}${v2:10}${v3:10}
"""

_MOTION = """\
*BOUNDARY_PRESCRIBED_MOTION_RIGID
$#     pid       dof       vad      lcid        sf
${pid:10}${dof:10}         2${lcid:10}       1.0
"""

_WAVE_MAKER = """\
*COURANT_WAVE_MAKER
$#     pid      kind      lcid        sf     lceta         d         g     hinge
${pid:10}${flap:10}${lcid:10}       1.0${lceta:10}${depth:10}${g:10}${hinge:10}
$#       x         y         z        vx        vy        vz
${x:10}${y:10}${z:10}${vx:10}${vy:10}${vz:10}
$#  absorb      dist       tau    tdrift      xmax
${absorb:10}${dist:10}${tau:10}${tdrift:10}${xmax:10}
"""

_SERIES = """\
*DEFINE_CURVE
$#    lcid
${lcid:10}
$#                t                   x
"""

_FORMULA = """\
*DEFINE_CURVE_FUNCTION
$#    lcid
${lcid:10}
"""

# A particle's contact stiffness is SLSFAC SFSA = 1 of that of the water itself, rho c^2; walls are stiffer.
_SURFACES = """\
*SECTION_SHELL
$#   secid    elform      shrf       nip
         2         2       1.0         2
$#      t1        t2        t3        t4
${touch:10}${touch:10}${touch:10}${touch:10}
*CONTROL_CONTACT
$#  slsfac    rwpnal    islchk    shlthk    penopt    thkchg     orien
       0.1         0         1         0         1         0         1
*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID
$#     cid title
         1water against walls and bodies
$#   surfa     surfb  surfatyp  surfbtyp
         1         2         3         2
$#      fs        fd        dc        vc       vdc    penchk        bt        dt
         0         0         0         0         0         0         0    1.0e20
$#    sfsa      sfsb
        10${sfsb:10}
*DATABASE_RCFORC
$#      dt
${output / 10:10}
"""

_SUPPORT = """\
$ {what}: pressure is right in the rows beside these walls, too
*COURANT_WALL_SUPPORT
$#   surfb  surfbtyp        cf    method
         5         2       0.0         {method}
"""

_BODIES = """\
*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID
$#     cid title
         2bodies against walls
$#   surfa     surfb  surfatyp  surfbtyp
         4         3         2         2
$#      fs        fd        dc        vc       vdc    penchk        bt        dt
         0         0         0         0         0         0         0    1.0e20
$#    sfsa      sfsb
       1.0       1.0
"""

MOVING = """\
*DATABASE_RBDOUT
$#      dt
${output / 10:10}
"""


def _held(directions: Iterable[str]) -> int:
    return _HELD_BY["".join(sorted(directions))]


def part_set(number: int, parts: list[int]) -> str:
    rows = [parts[k : k + 8] for k in range(0, len(parts), 8)]
    return f"*SET_PART_LIST\n$#     sid\n{number:10}\n$#    pid1      pid2      pid3      pid4      pid5      pid6      pid7      pid8\n" \
        + "".join("".join(f"{pid:10}" for pid in row) + "\n" for row in rows)


def number_parts(solids: list[Solid]) -> None:
    wall, body = FIRST_WALL, FIRST_BODY
    for solid in solids:
        if solid.free:
            solid.part, body = body, body + 1
        else:
            solid.part, wall = wall, wall + 1


def part_of(solid: Solid) -> Part:
    """Fixed walls share material 2; what moves has one of its own, with the number of the part."""
    moves = solid.free or solid.driven
    part = Part(id=solid.part, title=solid.shape.name[:70], section=2, material=solid.part if moves else 2, merge=True, plates=[solid.shape], where=solid.where)
    if solid.free:
        part.inertia, part.velocity = solid.shape.inertia(solid.density), solid.velocity
    elif solid.rotation is not None:
        part.inertia = solid.rotation.inertia(solid.shape, 1000.0)
    return part


def material(basin: Basin, part: int, held: set[str], density: float = 0.0, axes: tuple[np.ndarray, np.ndarray] | None = None) -> str:
    """Of what moves but in the directions that are held; `density`: 0 for walls, whose mass does not matter; `axes`: vectors of a system of its own."""
    variables = basin.variables() | {"mid": float(part), "ro": density or 7.85 * basin.density, "con1": float(_held(held & {"x", "y", "z"})),
                                     "con2": float(_held(one[1] for one in held if one[0] == "r"))}
    names = ("a1", "a2", "a3", "v1", "v2", "v3")
    return substitute(_RIGID, variables | dict(zip(names, np.concatenate(axes).tolist() if axes is not None else [0.0] * 6)))


def motion_cards(part: int, motion: dict[str, str | np.ndarray], first_curve: int) -> str:
    out = ""
    for k, (axis, given) in enumerate(motion.items()):
        out += substitute(_MOTION, {"pid": float(part), "dof": float("xyz".index(axis) + 1), "lcid": float(first_curve + k)})
        if isinstance(given, str):
            out += substitute(_FORMULA, {"lcid": float(first_curve + k)}) + given + "\n"
        else:
            out += substitute(_SERIES, {"lcid": float(first_curve + k)}) + "".join(f"{t:20.9e}{x:20.9e}\n" for t, x in given)
    return out


def _series_cards(lcid: int, series: np.ndarray) -> str:
    return substitute(_SERIES, {"lcid": float(lcid)}) + "".join(f"{t:20.9e}{x:20.9e}\n" for t, x in series)


def wave_maker_cards(basin: Basin, solid: Solid, first_curve: int) -> tuple[str, int]:
    """Of a wave maker that absorbs or turns, and the number of its curves."""
    piston = solid.piston
    assert piston is not None
    a, up = "xyz".index(piston.axis), basin.dim - 1
    at = [0.5 * float(low + high) for low, high in zip(solid.shape.low, solid.shape.high, strict=True)]
    at[a] = float(solid.shape.high[a] if piston.sign > 0 else solid.shape.low[a])
    at[up] = basin.box[0][up] if basin.box else float(solid.shape.low[up])
    if basin.dim == 2:
        at[2] = 0.0
    towards = [piston.sign if k == a else 0.0 for k in range(3)]
    curves, lcid, lceta = "", 0, 0
    if np.ptp(piston.series[:, 1]) > 0:
        lcid = first_curve
        curves += _series_cards(lcid, piston.series * [1.0, piston.sign])
    if piston.absorb > 0 and len(piston.elevation):
        lceta = first_curve + 1
        curves += _series_cards(lceta, piston.elevation)
    card = substitute(_WAVE_MAKER, {
        "pid": float(solid.part), "flap": float(piston.maker == "flap"), "lcid": float(lcid), "lceta": float(lceta), "depth": piston.depth, "g": basin.gravity,
        "hinge": piston.hinge, "x": at[0], "y": at[1], "z": at[2], "vx": towards[0], "vy": towards[1], "vz": towards[2], "absorb": piston.absorb,
        "dist": piston.away if piston.absorb > 0 else 0.0, "tau": piston.delay,
        "tdrift": piston.drift if piston.absorb > 0 else 0.0, "xmax": min(piston.space, piston.depth) if piston.space > 0 else 0.0})
    return card + curves, 2


def fastest_of(motion: dict[str, str | np.ndarray], end: float) -> float:
    """Largest speed of a motion by displacements, from 0 to `end` [L/T]. A formula with functions that the program alone knows does not count."""
    times = np.linspace(0.0, end, _TIMES)
    square = np.zeros(len(times))
    for displacement in motion.values():
        if isinstance(displacement, str):
            formula = Formula(displacement.lower(), ("time",), {"pi": math.pi})
            path = formula.over({"time": times}, len(times)) if formula.ok else np.zeros(len(times))
        else:
            path = np.interp(times, displacement[:, 0], displacement[:, 1])
        if end > 0 and np.isfinite(path).all():
            square += np.gradient(path, times) ** 2
    return float(np.sqrt(square.max()))


def moving_cards(basin: Basin, walls: Part | None) -> tuple[list[str], bool]:
    """Materials of all that moves, and motions; whether there is any."""
    flat = {"z", "rx", "ry"} if basin.dim == 2 else set[str]()
    out = [material(basin, solid.part, solid.hold | flat, basin.shell_density(solid)) for solid in basin.solids if solid.free]
    curve = FIRST_CURVE
    makers = [solid for solid in basin.solids if solid.piston is not None and solid.piston.own_card]
    motions = [(solid.part, solid.motion) for solid in basin.solids if solid.motion and not (solid.piston is not None and solid.piston.own_card)]
    if walls and basin.box_motion:
        walls.material = walls.id
        motions.append((walls.id, basin.box_motion))
    for part, motion in motions:
        out.append(material(basin, part, set(FREE) - set(motion)))
        out.append(motion_cards(part, motion, curve))
        curve += len(motion)
    for solid in basin.solids:
        if (rotation := solid.rotation) is None:
            continue
        oblique = is_oblique(rotation)
        turns = FREE[3:] if oblique else ("r" + "xyz"[int(np.argmax(np.abs(rotation.axis)))],)
        out.append(material(basin, solid.part, set(FREE) - set(turns), axes=local_axes(rotation) if oblique else None))
        out.append(rotation_cards(solid.part, rotation, curve, _SERIES, _FORMULA))
        curve += 1
    for solid in makers:
        piston = solid.piston
        assert piston is not None
        up = "xyz"[basin.dim - 1]
        turn = {"rz" if basin.dim == 2 else "ry" if piston.axis == "x" else "rx"}
        out.append(material(basin, solid.part, set(FREE) - {piston.axis} - ({up} | turn if piston.maker == "flap" else set())))
        cards, count = wave_maker_cards(basin, solid, curve)
        out.append(cards)
        curve += count
    return out, bool(out)


def cards_of_solids(basin: Basin, walls: Part | None) -> list[str]:
    """All that walls and bodies need beside the material of fixed walls, which `basin` has written."""
    held = ([walls.id] if walls else []) + [solid.part for solid in basin.solids if not solid.free]
    bodies = [solid.part for solid in basin.solids if solid.free]
    out, moves = moving_cards(basin, walls)
    out.append(part_set(SOLIDS, held + bodies))
    variables = basin.variables()
    out.append(substitute(_SURFACES, variables))
    mirrors = [walls.id] if walls and basin.mirrors else []
    mirrors += [solid.part for solid in basin.solids if solid.mirrors(basin.method)]
    if mirrors:
        what = "Fixed ghost particles behind walls (METHOD 2)" if basin.method == "ghosts" else "Mirrors of the water beside them (METHOD 1)"
        out += [part_set(MIRRORS, mirrors), _SUPPORT.format(what=what, method=2 if basin.method == "ghosts" else 1)]
    if bodies and held and basin.dim == 3:  # elements of the plane do not touch each other
        out += [part_set(HELD, held), part_set(BODIES, bodies), _BODIES]
    if moves:
        out.append(substitute(MOVING, variables))
    return out

