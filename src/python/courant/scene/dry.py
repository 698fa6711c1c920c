"""Scenes without water and gas: rigid bodies, walls and parts that deform, which touch each other."""
from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..diagnostics import Diagnostics
from ..yaml_map import Node, is_list, is_map
from .beams import read_lines
from .basin import FIXED, GRAVITY, Basin
from .explain import explain_output, explain_solids
from .joints import joined_names, joined_pairs
from .model import Model, Part
from .numbers import number_text
from .placeholders import substitute
from .requests import REQUESTS
from .shape_reader import KINDS
from .shapes import Shape, refined, shrunk
from .solids import MOVING, Solid, moving_cards, number_parts, part_of, part_set
from .structure_checks import check_bodies, check_structures
from .structure_reader import read_structures
from .structures import CONTROL, add_structures, touch
from .surfaces import ShapeFault

if TYPE_CHECKING:
    from .reader import SceneReader

_PARTS = ("walls", "bodies", "structures")
_NEED_WATER = ("inlets", "outlets", "wall_method", "damping", "gauges")
# steel in usual units, by the size of gravity in them: density, Young's modulus; SI units are the first
_STEEL = ((9.81, 7850.0, 210e9), (9810.0, 7.85e-9, 210e3), (9810.0, 7.85e-6, 210e6), (9.81e-3, 7.85e-6, 210.0), (981.0, 7.85, 2.1e12))

_THICKNESS = 0.1  # of rigid shells [spacings]
_SLOW = 5e-4  # speed of an impact, of the speed of sound in steel, up to which its stiffness keeps bodies within half of that

_FACES = 1000  # of rigid parts, about, where sizes by the spacing would make more

_CARDS = """\
*CONTROL_TERMINATION
$#  endtim    endcyc     dtmin    endeng    endmas     nosol
${end:10}         0         0         0     1.0e8         0
*CONTROL_TIMESTEP
$#  dtinit    tssfac
         0${tssfac:10}
""" + REQUESTS

_PLANE = """\
*CONTROL_SPH
$#    ncbs     boxid        dt      idim
         1         0    1.0e20         2
"""

# contacts act at half the thickness in front of shells, which closed parts have inside: a node must not cross all of it within a step
_SHELLS = """\
*SECTION_SHELL
$#   secid    elform      shrf       nip
         2         2       1.0         2
$#      t1        t2        t3        t4
${touch:10}${touch:10}${touch:10}${touch:10}
"""


@dataclass
class Dry(Basin):
    """Parts without water; `density`: 1000 in SI units, of rigid walls."""

    wet: bool = False
    young: float = 210e9  # of rigid parts, for their contact [M/LT2]
    spacing_given: bool = True

    def variables(self) -> dict[str, float]:
        return {"end": self.end, "dim": float(self.dim), "rho0": self.density, "young": self.young, "output": self.output, "g": self.gravity,
                "touch": _THICKNESS * self.spacing, "tssfac": self.step}

    @property
    def step(self) -> float:
        """Of the longest stable one: cables that become slack and taut again gain energy in steps near that [-]."""
        return 0.5 if any(one.section is not None and one.section.is_cable for one in self.structures) else 0.9

    @property
    def foreign_units(self) -> str:
        return f"gravity {self.gravity:g} is not" if any(abs(self.gravity / g - 1) < 0.02 for g, _, _ in _STEEL[1:]) else ""

    def shell_density(self, solid: Solid) -> float:
        """With which the shells of a body have its mass: contact counts the masses of nodes, too."""
        return solid.density * solid.shape.volume() / (area_of(solid.shape) * _THICKNESS * self.spacing)

    @property
    def movers(self) -> list[str]:
        """Titles of the parts that move freely or deform."""
        return [one.shape.name for one in self.solids if one.free] + [one.title for one in self.structures]


def area_of(shape: Shape) -> float:
    """Of its faces, in the plane one unit deep [L2]."""
    a = shape.points[shape.faces]
    if shape.dim == 2:
        return float(np.linalg.norm(a[:, 1] - a[:, 0], axis=1).sum())
    return 0.5 * float(np.linalg.norm(np.cross(a[:, 1] - a[:, 0], a[:, 2] - a[:, 0]), axis=1).sum())


def read_dry(reader: SceneReader, root: Node, model: Model) -> bool:
    """Adds parts and cards of a scene of bodies, walls and parts that deform; whether it is one."""
    if reader.get(root, "water") is not None or all(reader.get(root, key) is None for key in _PARTS):
        return False
    for key in _NEED_WATER:
        if (entry := reader.get(root, key)) is not None:
            reader.error(entry, f"'{key}' needs water, which the scene has not", "run.table('contacts/101') has the forces on body 101, run.track(point) the motion of points"
                         if key == "gauges" else "leave it out")
    before = reader.diagnostics.errors
    basin = Dry()
    reader.basin = basin
    if (gravity := reader.get(root, "gravity")) is not None:
        basin.gravity = reader.number(gravity, "gravity") or 0.0
        if basin.gravity < 0:
            reader.error(gravity, "gravity: expected its size, >= 0; it acts downwards")
    if (friction := reader.get(root, "friction")) is not None:
        basin.friction_of_parts = reader.number(friction, "friction") or 0.0
        if basin.friction_of_parts < 0:
            reader.error(friction, "friction: expected a coefficient >= 0")
    basin.end = reader.length(root, "end", "time")
    basin.output = reader.length(root, "output", "time") if reader.get(root, "output") is not None else basin.end / 100
    if reader.get(root, "spacing") is not None:
        basin.spacing = reader.length(root, "spacing")
    _take_measure(reader, root, basin)
    if reader.diagnostics.errors == before:
        if (box := reader.get(root, "box")) is not None:
            reader.read_box(box, basin)
        reader.read_solids(root, basin)
        read_structures(reader, root, basin)
    if reader.diagnostics.errors == before:
        _check(reader, root, basin)
    reader.complete = reader.diagnostics.errors == before
    if reader.complete:
        _add(reader, root, basin, model)
    return True


def _entries(reader: SceneReader, root: Node) -> Iterator[tuple[str, Shape]]:
    """Shapes of the description with their kind of part, as far as they can be read: mistakes are reported by those that read them for good."""
    kept, reader.diagnostics = reader.diagnostics, Diagnostics()
    try:
        for key in ("structures", "bodies", "walls"):
            node = reader.get(root, key)
            for entry in node.value if node is not None and is_list(node) else ():
                if is_map(entry) and (lines := reader.get(entry, "beam")) is not None:
                    yield from ((key, shape) for shape in _beams(reader, lines))
                    continue
                kind = next((one for one in KINDS if is_map(entry) and reader.get(entry, one) is not None), "")
                try:
                    shape = reader._made(entry, kind, math.inf) if kind else None
                    if shape is not None and len(shape.points):
                        yield key, reader.moved(entry, shape, shape.dim)
                except ShapeFault:
                    continue
    finally:
        reader.diagnostics = kept


def _beams(reader: SceneReader, entry: Node) -> Iterator[Shape]:
    """Lines of an entry `beam`, as shapes of their dimensions."""
    point: Node | None = entry
    while point is not None and is_list(point) and point.value and is_list(point.value[0]):
        point = point.value[0]
    dim = len(point.value) if point is not None and is_list(point) else 0
    for line in (read_lines(reader, entry, dim) or []) if dim in (2, 3) else []:
        yield Shape(line, np.zeros((0, dim), dtype=int), dim)


def _take_measure(reader: SceneReader, root: Node, basin: Dry) -> None:
    """Dimensions of the scene and, where none is given, the spacing: a tenth of the smallest part that moves, at least a two-hundredth of the largest
    part."""
    found = list(_entries(reader, root))
    basin.dim = reader.dim = found[0][1].dim if found else 3
    basin.spacing_given = reader.get(root, "spacing") is not None
    if not basin.spacing_given:
        longest = [float(np.max(shape.high - shape.low)) for _, shape in found]
        moving = [size for size, (key, _) in zip(longest, found) if key != "walls"]
        size = max(min(moving or longest or [1.0]) / 10, max(longest or [1.0]) / 200)
        digit = 10.0 ** math.floor(math.log10(size)) / 10 if 0 < size < math.inf else 1.0
        basin.spacing = round(size / digit) * digit if 0 < size < math.inf else 1.0


def _check(reader: SceneReader, root: Node, basin: Dry) -> None:
    joined = joined_names(reader, root)
    if not basin.movers:
        reader.error(reader.get(root, "walls") or root, "nothing moves: the scene has walls alone, without bodies, structures and water")
    if reader.pistons:
        reader.error(reader.get(root, "walls") or root, "waves need water, which the scene has not", "motion: a formula of TIME, or a curve")
    if basin.box and (len(basin.open) == len(basin.sides) or any(not basin.box[1][k] > basin.box[0][k] for k in range(basin.dim))):
        reader.error(reader.get(root, "box") or root, "box: it has no walls", "'high' is above 'low' along each axis, and one side is closed")
    titles = basin.rigid_parts()
    tied = {part for one in basin.structures for part, _ in one.carried}
    loose = [one.where for one in basin.solids
             if one.free and one.part not in tied and not {titles[one.part], str(one.part)} & joined and not {"x", "y"} <= one.hold]
    loose += [one.where for one in basin.structures if not len(one.bound)]
    if basin.dim == 2 and loose and len(titles) + len(basin.structures) > 1:
        reader.diagnostics.error(loose[0], "parts of the plane do not touch each other, and this one is neither fixed nor in a joint",
                                 "give points of three components: in space all parts touch")
    density = max([one.density for one in basin.solids if one.free] + [one.material.density for one in basin.structures], default=7850.0)
    _choose_units(reader, root, basin, density)
    reader.check_solids(basin)
    check_structures(basin, reader.diagnostics)
    check_bodies(basin, joined, reader.diagnostics)


def _choose_units(reader: SceneReader, root: Node, basin: Dry, density: float) -> None:
    """Steel in the units of the scene: those of its gravity, and of these those of the heaviest part."""
    def away(value: float, usual: float) -> float:
        return abs(math.log(value / usual)) if value > 0 else 0.0

    gravity = reader.get(root, "gravity")
    known = basin.gravity if gravity is not None else 0.0
    _, steel, basin.young = min(_STEEL, key=lambda one: (away(known, one[0]), away(density, one[1])))
    basin.density = steel / 7.85
    up = basin.dim - 1
    ends = [float(end[up]) for one in basin.solids for end in (one.shape.low, one.shape.high)]
    ends += [float(end[up]) for part in basin.structures for end in (part.mesh.low, part.mesh.high)]
    given = [one.velocity for one in basin.solids] + [part.velocity for part in basin.structures]
    squared = max(float(np.dot(v, v)) if v else 0.0 for v in given) + 2 * basin.gravity * (max(ends) - min(ends)) if ends else 0.0
    basin.young *= max(1.0, squared * steel / basin.young / _SLOW**2)
    if gravity is None and density < 0.01:
        reader.diagnostics.warning(reader.at(root), f"density {density:g} is that of other units than kg and metres, and gravity {basin.gravity:g} that of metres",
                                   "gravity: 9810 in mm and seconds, 0 for none")
    elif gravity is not None and known in (981.0, 9810.0) and density > 50:
        reader.diagnostics.warning(reader.at(gravity), f"gravity {known:g} is that of other units than metres, and density {density:g} that of kg and metres",
                                   "density: 7.85e-9 of steel in tonnes and mm")


def _add(reader: SceneReader, root: Node, basin: Dry, model: Model) -> None:
    variables = basin.variables()
    model.keywords.append(substitute(_CARDS + (_PLANE if basin.dim == 2 else "") + CONTROL, variables))
    if basin.gravity > 0:
        model.keywords.append(substitute(GRAVITY.format(axis="Y" if basin.dim == 2 else "Z"), variables))
    number_parts(basin.solids)
    walls = _walls(basin)
    rigid = ([walls] if walls else []) + [_rigid(solid, basin) for solid in basin.solids]
    model.parts += rigid
    if rigid:
        moving, moves = moving_cards(basin, walls)  # which gives a box that moves a material of its own
        fixed = FIXED if any(part.material == 2 for part in rigid) else ""
        model.keywords += ["$ Rigid parts\n" + substitute(_SHELLS + fixed, variables), *moving] + ([substitute(MOVING, variables)] if moves else [])
    if basin.dim == 3:
        model.keywords += _contacts(reader, root, basin, rigid)
    _explain(basin, model)
    add_structures(basin, model, [part.id for part in rigid])


def _walls(basin: Dry) -> Part | None:
    """Those of the box, whose inner faces are where it ends."""
    if not basin.box:
        return None
    half, (low, high) = _THICKNESS / 2 * basin.spacing, basin.box
    basin.box = ((low[0] - half, low[1] - half, low[2] - half), (high[0] + half, high[1] + half, high[2] + half))
    walls = basin.walls()
    basin.box = (low, high)
    return walls


def _rigid(solid: Solid, basin: Dry) -> Part:
    """The part of a wall or body, whose outer faces are those of its shape; nodes along edges find faces of other parts."""
    part = part_of(solid)
    if basin.dim == 3:
        fine = refined(solid.shape, max(4 * basin.spacing, math.sqrt(area_of(solid.shape) / _FACES)))
        part.plates = [shrunk(fine, _THICKNESS / 2 * basin.spacing) if solid.closed else fine]
    return part


def _contacts(reader: SceneReader, root: Node, basin: Dry, rigid: list[Part]) -> list[str]:
    """Of each body with walls and the bodies before it, but for those to which a joint binds it. Sets and contacts have the number of the body."""
    pairs, out = joined_pairs(reader, root), list[str]()
    names = {part.id: {part.title, str(part.id)} for part in rigid}
    bodies = [solid.part for solid in basin.solids if solid.free]
    for body in bodies:
        others = [one for one in names if (one not in bodies or one < body) and not any(pair & names[one] and pair & names[body] for pair in pairs)]
        if others:
            title = f"{basin.rigid_parts()[body]} against walls and bodies"[:60]
            out += [part_set(body, [body]) + part_set(1000 + body, others),
                    touch("SURFACE_TO_SURFACE", body, title, body, 1000 + body, friction=basin.friction_of_parts)]
    return out


def _explain(basin: Dry, model: Model) -> None:
    def add(choice: str, reason: str, cards: str) -> None:
        model.choices.append((choice, reason, cards))

    add(f"{basin.dim} dimensions, {'xyz'[basin.dim - 1]} upwards, no water", "points have two components in the plane, three in space",
        "none" if basin.dim == 3 else "*CONTROL_SPH IDIM: plane strain, one unit deep")
    add(f"spacing {number_text(basin.spacing)}", "given" if basin.spacing_given else
        "a tenth of the smallest part that moves, at least a two-hundredth of the largest part; round shapes, faces of rigid parts (four spacings) and meshes "
        "without a 'size' follow it", "*NODE")
    add(f"gravity {number_text(basin.gravity)}", "its default, or given", f"*LOAD_BODY_{'XYZ'[basin.dim - 1]}" if basin.gravity > 0 else "none")
    add(f"steps of {basin.step:g} of the longest stable ones", "usual for parts that deform; contacts shorten steps where they need it"
        if basin.step == 0.9 else "cables that become slack and taut again gain energy in longer ones", "*CONTROL_TIMESTEP TSSFAC")
    add("no damping", "free vibration goes on", "none")
    if basin.rigid_parts():
        add(f"rigid parts touch with Young's modulus {basin.young:.4g}", "that of steel, in units that follow from gravity and the heaviest part; it "
            "grows with the square of the speed of impacts above 2.6 m/s", "*MAT_RIGID E")
    explain_solids(basin, model)
    if basin.dim == 3:
        add(f"all parts touch each other, friction {basin.friction_of_parts:g}", "parts in one joint do not; closed walls and bodies touch at their faces, thin ones a twentieth of "
            "a spacing in front, shells that deform at half their thickness", "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE" + (", _SINGLE_SURFACE" if basin.structures else ""))
    else:
        add("parts do not touch", "the program knows no contact of elements in the plane", "none")
    for one in sorted(basin.structures, key=lambda one: one.mesh.side / one.sound_speed)[:1]:
        add(f"'{one.title}' sets the step: about {basin.step * one.mesh.side / one.sound_speed:.2g}", "sound crosses its shortest element in that time",
            "*CONTROL_TIMESTEP; a larger 'size' makes longer steps")
    explain_output(basin, model)
