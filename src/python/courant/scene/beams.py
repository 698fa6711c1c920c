"""Beams and cables of a scene: sections by name, elements between nodes, and the cards that they need."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..key_tables import keys as keys_of_map
from ..yaml_map import Node, is_list, is_map
from .materials import Material
from .merger import Merger
from .meshes import Mesh, divided
from .numbers import number_text
from .placeholders import substitute

if TYPE_CHECKING:
    from .basin_reader import BasinReader

_KINDS = keys_of_map("a kind of section", "rod number, tube list, rectangle list, cable number")
_KEYS = (*_KINDS, *keys_of_map("of every section", "up list, tension number"))
_EXAMPLE = "section: {rod: 0.02}, {tube: [0.06, 0.003]}, {rectangle: [0.05, 0.1]} or {cable: 0.01}"
_SAME = 1e-6  # of the size of all beams, within which points are one
_USUAL = 16  # elements of the longest line


@dataclass
class Section:
    """A cross-section with its height along `up`. `sizes` [L]: diameter of a rod or cable; outer diameter and thickness of a tube; width and height of a
    rectangle. `tension` of a cable at the start [ML/T2]."""

    kind: str
    sizes: tuple[float, ...]
    up: np.ndarray | None = None
    tension: float = 0.0

    @property
    def is_cable(self) -> bool:
        return self.kind == "cable"

    @property
    def radius(self) -> float:
        """Of the circle around it [L]."""
        return math.hypot(*self.sizes) / 2 if self.kind == "rectangle" else self.sizes[0] / 2

    @property
    def area(self) -> float:
        """[L2]"""
        a, b = self.sizes[0], self.sizes[-1]
        return a * b if self.kind == "rectangle" else math.pi * b * (a - b) if self.kind == "tube" else math.pi * a * a / 4

    def stiffness(self) -> tuple[float, float, float, float]:
        """Second moments of area about the axis upwards and across it, that of torsion [L4], and the area of shear [L2] (Young and Budynas, Roark's
        Formulas for Stress and Strain, tables 10.7 and A.1)."""
        if self.kind == "rectangle":
            width, height = self.sizes
            long, short = max(self.sizes), min(self.sizes)
            torsion = long * short**3 * (1 / 3 - 0.21 * short / long * (1 - (short / long) ** 4 / 12))
            return height * width**3 / 12, width * height**3 / 12, torsion, 5 / 6 * self.area
        outer = self.sizes[0]
        inner = outer - 2 * self.sizes[1] if self.kind == "tube" else 0.0
        about = math.pi * (outer**4 - inner**4) / 64
        return about, about, 2 * about, (0.5 if self.kind == "tube" else 0.9) * self.area

    def text(self) -> str:
        name = {"rod": "rod of diameter {:g}", "tube": "tube of diameter {:g}, {:g} thick", "rectangle": "rectangle of {:g} x {:g}", "cable": "cable of diameter {:g}"}
        return name[self.kind].format(*self.sizes)


def read_section(reader: BasinReader, node: Node) -> Section | None:
    """Of an entry `section`; None, with a message, where it is wrong."""
    if not is_map(node):
        reader.error(node, "section: expected a map", _EXAMPLE)
        return None
    reader.check_keys(node, "a section", _KEYS)
    before = reader.diagnostics.errors
    given = [kind for kind in _KINDS if reader.get(node, kind) is not None]
    if len(given) != 1:
        reader.error(node, f"section: expected one of {', '.join(_KINDS)}, got {' and '.join(given) or 'none'}", _EXAMPLE)
        return None
    kind, entry = given[0], reader.get(node, given[0])
    assert entry is not None
    if kind in ("tube", "rectangle"):
        what = "outer diameter and thickness" if kind == "tube" else "width and height"
        if not is_list(entry) or len(entry.value) != 2:
            reader.error(entry, f"{kind}: expected {what}", _EXAMPLE)
            return None
        sizes = tuple(reader.length_of(one, kind) for one in entry.value)
        if kind == "tube" and reader.diagnostics.errors == before and 2 * sizes[1] >= sizes[0]:
            reader.error(entry, f"tube: its wall of {sizes[1]:g} is as thick as half of the diameter {sizes[0]:g}", "{rod: 0.02} is a full circle")
    else:
        sizes = (reader.length_of(entry, kind),)
    made = Section(kind, sizes)
    if (up := reader.get(node, "up")) is not None:
        made.up = np.array(reader.vector(node, "up")[0])
        if kind != "rectangle":
            reader.error(up, "up: direction of the height of a rectangle", "leave it out")
        elif reader.diagnostics.errors == before and not np.linalg.norm(made.up) > 0:
            reader.error(up, "up: expected a direction that is not zero", "up: [0, 0, 1]")
    if (tension := reader.get(node, "tension")) is not None:
        if kind != "cable":
            reader.error(tension, "tension: of a cable", "leave it out")
        made.tension = reader.length_of(tension, "tension", "number")
    return made if reader.diagnostics.errors == before else None


def read_lines(reader: BasinReader, entry: Node, dim: int) -> list[np.ndarray] | None:
    """The polyline of an entry `beam`, or several of them, each (n, 3) [L]; None, with a message, where it is wrong."""
    example = "beam: [[0, 0, 0], [0, 0, 3], [4, 0, 3]], or a list of such lines"
    if not is_list(entry) or not entry.value or not all(is_list(one) for one in entry.value):
        reader.error(entry, "beam: expected a list of points", example)
        return None
    several = all(bool(one.value) and all(is_list(point) for point in one.value) for one in entry.value)
    out, before = [], reader.diagnostics.errors
    for line in entry.value if several else [entry]:
        if len(line.value) < 2:
            reader.error(line, "beam: a line has two points or more", example)
            continue
        points = []
        for point in line.value:
            if not is_list(point) or len(point.value) != dim:
                reader.error(point, f"beam: a point has {dim} components in this scene", example)
                return None
            points.append([*(reader.number(v, "beam") or 0.0 for v in point.value), 0.0][:3])
        x = np.array(points)
        if not (np.linalg.norm(np.diff(x, axis=0), axis=1) > 0).all():
            reader.error(line, "beam: two points of the line that follow each other are the same", example)
        out.append(x)
    return out if reader.diagnostics.errors == before else None


def _all(lines: list[np.ndarray]) -> np.ndarray:
    return np.concatenate(lines)


def _cut(lines: list[np.ndarray]) -> list[np.ndarray]:
    """The same lines with a point where a given point of another one, or of their own, lies on them."""
    given = _all(lines)
    tiny = _SAME * float(np.ptp(given, axis=0).max())
    out = []
    for line in lines:
        pieces = [line[:1]]
        for a, b in zip(line[:-1], line[1:]):
            along = b - a
            share = (given - a) @ along / (along @ along)
            off = np.linalg.norm(given - a - share[:, None] * along, axis=1)
            margin = tiny / float(np.linalg.norm(along))
            inner = np.unique(np.round(share[(off < tiny) & (share > margin) & (share < 1 - margin)], 9))
            pieces += [a + share_of * along for share_of in inner[:, None, None]] + [b[None]]
        out.append(np.concatenate(pieces))
    return out


def beam_mesh(lines: list[np.ndarray], size: float) -> Mesh:
    """Elements of two nodes, with sides up to `size` [L] (0: a sixteenth of the longest line); lines share the nodes where they meet at a given point of
    one of them. The groups `start` and `end` are the ends of a single line."""
    if not size > 0:
        size = max(float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum()) for line in lines) / _USUAL
    points, starts = list[np.ndarray](), list[int]()
    for line in _cut(lines):
        pieces = [line[:1]]
        for a, b in zip(line[:-1], line[1:]):
            n = divided(float(np.linalg.norm(b - a)), size)
            pieces.append(a + (b - a) * (np.arange(1, n + 1) / n)[:, None])
        starts.append(sum(len(one) for one in points))
        points.append(np.concatenate(pieces))
    x = np.concatenate(points)
    cells = np.concatenate([start + np.column_stack([np.arange(len(one) - 1), np.arange(1, len(one))]) for start, one in zip(starts, points)])
    tiny = _SAME * float(np.ptp(x, axis=0).max())
    merger = Merger(2 * tiny)  # nodes in the order of the lines
    number = merger.numbers(x - x.min(axis=0))
    nodes = np.array(merger.points) + x.min(axis=0)
    cells = number[cells]
    _, once = np.unique(np.sort(cells, axis=1), axis=0, return_index=True)
    made = Mesh(nodes, cells[np.sort(once)], "beam")
    if len(lines) == 1 and number[0] != number[len(x) - 1]:
        made.groups = {"start": number[:1], "end": number[len(x) - 1 :]}
    return made


def upwards(mesh: Mesh, section: Section, dim: int) -> np.ndarray:
    """Directions of the height of elements, (m, 3): as given, otherwise vertical, of vertical ones along y, in the plane across the beam. A vector of zeros
    where the given one is along the beam."""
    along = mesh.points[mesh.cells[:, 1]] - mesh.points[mesh.cells[:, 0]]
    along /= np.linalg.norm(along, axis=1)[:, None]
    if section.up is not None:
        up = np.broadcast_to(section.up / np.linalg.norm(section.up), along.shape).copy()
        up[np.linalg.norm(np.cross(along, up), axis=1) < 1e-3] = 0.0
        return up
    if dim == 2:
        return np.column_stack([-along[:, 1], along[:, 0], np.zeros(len(along))])
    upright = np.linalg.norm(along[:, :2], axis=1) < 1e-3
    return np.where(upright[:, None], np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]))


_RESULTANT = """\
*SECTION_BEAM
$#   secid    elform
${id:10}         2
$#       a       iss       itt         j        sa
${a:10}${iss:10}${itt:10}${j:10}${sa:10}
"""

_POINTS = """\
*SECTION_BEAM
$#   secid    elform      shrf   qr/irid       cst
${id:10}         1${shrf:10}         4${cst:10}
$#     ts1       ts2       tt1       tt2
${s:10}${s:10}${t:10}${t:10}
"""

_CABLE = """\
*SECTION_BEAM
$#   secid    elform
${id:10}         6
$#     vol      iner       cid        ca    offset
         0         0         0${a:10}         0
*MAT_CABLE_DISCRETE_BEAM
$#     mid        ro         e      lcid        f0    tmaxf0     tramp
${id:10}${ro:10}${e:10}         0${f0:10}         0         0
"""


def section_cards(part: int, section: Section, material: Material) -> str:
    """*SECTION_BEAM, of cables with their material: resultants of elastic beams, points in the section of those that yield."""
    values = {"id": float(part), "a": section.area, "ro": material.density, "e": material.young, "f0": section.tension}
    if section.is_cable:
        return substitute(_CABLE, values)
    about_up, across, torsion, shear = section.stiffness()
    if not material.yield_stress:
        return substitute(_RESULTANT, values | {"iss": about_up, "itt": across, "j": torsion, "sa": shear})
    hollow = section.sizes[0] - 2 * section.sizes[1] if section.kind == "tube" else 0.0
    s, t = (section.sizes[1], section.sizes[0]) if section.kind == "rectangle" else (section.sizes[0], hollow)
    return substitute(_POINTS, values | {"s": s, "t": t, "cst": float(section.kind != "rectangle"), "shrf": shear / section.area})


def element_cards(first: int, part: int, nodes: np.ndarray, up: np.ndarray | None) -> str:
    """Elements between nodes (m, 2); `up`: directions of their height (m, 3)."""
    if up is None:
        return "*ELEMENT_BEAM\n$#   eid     pid      n1      n2\n" + "".join(f"{first + k:8}{part:8}{a:8}{b:8}\n" for k, (a, b) in enumerate(nodes.tolist()))
    out = "*ELEMENT_BEAM_ORIENTATION\n$#   eid     pid      n1      n2\n$#      vx        vy        vz\n"
    return out + "".join(f"{first + k:8}{part:8}{a:8}{b:8}\n" + "".join(number_text(v, 10).rjust(10) for v in axis) + "\n"
                         for k, ((a, b), axis) in enumerate(zip(nodes.tolist(), up.tolist())))
