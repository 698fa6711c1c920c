"""Deformable parts of a scene, and the cards that they need."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..diagnostics import Location
from .materials import Material, material_cards, material_text
from .beams import Section, section_cards, upwards
from .joins import Tie
from .meshes import BEAMS, SOLIDS, Mesh
from .model import Near, NearSurface, Part, Vector
from .placeholders import substitute
from .shapes import Shape, polyline
from .solids import part_set

if TYPE_CHECKING:
    from .basin import Basin
    from .model import Model

FIRST_STRUCTURE = 201
STRUCTURES, OTHERS = 6, 7  # sets of parts: all that deform, and all rigid ones that they may touch


@dataclass
class Structure:
    """A part that deforms. Numbers of its nodes: `fixed` are held, `carried` go with rigid parts, `shared` are those of another deformable part, `ties` go
    with elements of others, `tracked` have a history."""

    mesh: Mesh
    material: Material
    thickness: float = 0.0  # of shells [L]
    fixed: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=int))
    carried: list[tuple[int, np.ndarray]] = field(default_factory=list)
    shared: list[tuple[int, int, int]] = field(default_factory=list)
    ties: list[Tie] = field(default_factory=list)
    section: Section | None = None  # of beams
    tracked: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=int))
    velocity: Vector | None = None  # at the start [L/T]
    where: Location = field(default_factory=Location)
    part: int = 0

    @property
    def title(self) -> str:
        return self.mesh.name

    @property
    def bound(self) -> np.ndarray:
        """Numbers of all nodes that do not move by themselves."""
        nodes = [self.fixed, *(some for _, some in self.carried), np.array([one for one, _, _ in self.shared] + [tie.node for tie in self.ties], dtype=int)]
        return np.unique(np.concatenate(nodes).astype(int))

    @property
    def sound_speed(self) -> float:
        """That limits the step [L/T]."""
        return self.material.bar_speed if self.mesh.kind == BEAMS else self.material.sound_speed

    def keeps_out(self, dim: int, spacing: float) -> Near:
        """What has no water: the solid with half a spacing beside it, or the layer of a shell."""
        if self.mesh.kind != SOLIDS:
            return NearSurface(self.mesh.surface(), (self.thickness + spacing) / 2 * (1 - 1e-6))
        return Near(self.outline(dim), 0.5 * spacing * (1 - 1e-6))

    def outline(self, dim: int) -> Shape:
        """The surface of solids, in the plane its section."""
        return _section(self.mesh) if dim == 2 else self.mesh.surface()


def _section(mesh: Mesh) -> Shape:
    """The outline of solids of the plane."""
    front = mesh.points[:, 2] < 0
    faces = mesh.outer_faces()
    lines = set()
    for triangle in faces[~front[faces].all(axis=1) & front[faces].any(axis=1)]:
        some = [int(k) for k in triangle if front[k]]
        if len(some) == 2:
            lines.add(tuple(some))
    after = {a: b for a, b in lines}
    order = [next(iter(after))]
    while after[order[-1]] != order[0] and len(order) <= len(after):
        order.append(after[order[-1]])
    return polyline(mesh.points[order], closed=True)


_SHELLS = """\
*SECTION_SHELL
$#   secid    elform      shrf       nip
${id:10}${elform:10}  0.833333${nip:10}
$#      t1        t2        t3        t4
${t:10}${t:10}${t:10}${t:10}
"""

_SOLIDS = """\
*SECTION_SOLID
$#   secid    elform
${id:10}${elform:10}
"""

_HOURGLASS = """\
*HOURGLASS
$#    hgid       ihq        qm
${id:10}${ihq:10}${qm:10}
"""

# as of walls: SLSFAC SFSA = 1, a particle's stiffness is that of the water; SAST keeps particles half a spacing off faces
_WATER = """\
*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID
$#     cid title
         3water against deformable parts
$#   surfa     surfb  surfatyp  surfbtyp
         1         6         3         2
$#      fs        fd        dc        vc       vdc    penchk        bt        dt
         0         0         0         0         0         0         0    1.0e20
$#    sfsa      sfsb      sast
        10    1000.0${0.9999 * spacing:10}
"""

CONTROL = """\
*CONTROL_CONTACT
$#  slsfac    rwpnal    islchk    shlthk    penopt    thkchg     orien
       0.1         0         1         0         1         0         1
*DATABASE_RCFORC
$#      dt
${output / 10:10}
"""

# IGNORE: parts begin where they are, also clamped in a wall; walls are thinner here, as their thickness is that of water, but thicker than
# the path of a step, within which a node that leaves a face would be taken for one that comes from behind
_TOUCH = """\
*CONTACT_AUTOMATIC_{kind}_ID
$#     cid title
{cid:10}{title}
$#   surfa     surfb  surfatyp  surfbtyp
{surfa:10}{surfb:10}         2{surfbtyp:10}
$#      fs        fd        dc        vc       vdc    penchk        bt        dt
{friction:>10}{friction:>10}         0         0         0         0         0    1.0e20
$#    sfsa      sfsb      sast      sbst
       1.0       1.0         0{sbst:>10}
$#    soft    sofscl
         1       0.1
$#  penmax
         0
$#    igap    ignore
         1         1
"""

_NODES = """\
*DATABASE_NODOUT
$#      dt
${output / 10:10}
"""


def touch(kind: str, cid: int, title: str, surfa: int, surfb: int, *, sbst: float = 0.0, friction: float = 0.0) -> str:
    """A contact between two sets of parts, or of one with itself where `surfb` is 0; `sbst`: thickness of the second one [L], 0 for that of its
    shells."""
    return _TOUCH.format(kind=kind, cid=cid, title=title, surfa=surfa, surfb=surfb, surfbtyp=2 if surfb else 0, sbst=f"{sbst:.3g}", friction=f"{friction:.6g}")


def _section_cards(one: Structure) -> tuple[str, bool]:
    """The section, with hourglass control where it has one."""
    if one.section is not None:
        return section_cards(one.part, one.section, one.material), False
    tetra = one.mesh.kind == SOLIDS and bool((one.mesh.cells[:, 3] == one.mesh.cells[:, 4]).all())
    plastic = one.material.yield_stress > 0
    values = {"id": float(one.part), "t": one.thickness, "nip": 5.0 if plastic else 3.0, "qm": 1.0, "ihq": 6.0}
    if one.mesh.kind != SOLIDS:
        flat = one.mesh.name_of_kind in ("line", "plate")
        values |= {"elform": 2.0 if flat else 16.0, "ihq": 4.0, "qm": 0.1}
        return substitute(_SHELLS + (_HOURGLASS if flat else ""), values), flat
    whole = bool((one.mesh.cells[:, 4] != one.mesh.cells[:, 5]).all())  # hexahedra
    elastic = whole and not plastic
    values["elform"] = 13.0 if tetra else 1.0 if elastic else 2.0
    return substitute(_SOLIDS + (_HOURGLASS if elastic else ""), values), elastic


def add_structures(basin: Basin, model: Model, rigid: list[int]) -> None:
    """Parts, sections, materials and contacts. `rigid`: parts of walls and bodies."""
    if not basin.structures:
        return
    text, variables = "", basin.variables() | {"spacing": basin.spacing}
    for one in basin.structures:
        section, controlled = _section_cards(one)
        text += section + ("" if one.section is not None and one.section.is_cable else material_cards(one.part, one.material))
        part = Part(id=one.part, title=one.title[:70], section=one.part, material=one.part, hourglass=one.part if controlled else 0, velocity=one.velocity,
                    where=one.where, fixed=one.fixed, carried=one.carried, shared=one.shared, ties=one.ties, tracked=one.tracked)
        if one.section is not None and not one.section.is_cable:
            part.upwards = upwards(one.mesh, one.section, basin.dim)
        (part.solids if one.mesh.kind == SOLIDS else part.plates).append(one.mesh)
        model.parts.append(part)
    faces = [one.part for one in basin.structures if one.mesh.kind != BEAMS]
    text += part_set(STRUCTURES, faces) if faces else ""
    if faces and basin.wet and not basin.box and not basin.solids:
        text += substitute(CONTROL, variables)
    text += substitute(_WATER, variables) if basin.wet and faces else ""
    if basin.dim == 3 and rigid and faces:
        text += part_set(OTHERS, rigid)
        text += touch("SURFACE_TO_SURFACE", 4, "deformable parts against walls and bodies", STRUCTURES, OTHERS, sbst=0.1 * basin.spacing,
                      friction=basin.friction_of_parts)
    if basin.dim == 3 and faces:
        text += touch("SINGLE_SURFACE", 5, "deformable parts against each other", STRUCTURES, 0, friction=basin.friction_of_parts)
    if any(len(one.tracked) for one in basin.structures):
        text += substitute(_NODES, variables)
    model.keywords.append("$ Deformable parts\n" + text)
    _explain(basin, model)


def _explain(basin: Basin, model: Model) -> None:
    for one in basin.structures:
        what = "solids" if one.mesh.kind == SOLIDS else f"beams, {one.section.text()}" if one.section is not None else f"shells {one.thickness:g} thick"
        bound = [f"{len(one.fixed)} nodes held"] if len(one.fixed) else []
        bound += [f"{len(nodes)} nodes go with part {part}" for part, nodes in one.carried]
        bound += [f"{len(one.shared) + len(one.ties)} nodes joined to other structures"] if one.shared or one.ties else []
        held = f", {', '.join(bound or ['free'])}"
        model.choices.append((f"'{one.title}': {len(one.mesh.cells)} {what}{held}", material_text(one.material),
                              f"*PART {one.part}, *SECTION_{one.mesh.kind.upper()[:-1]}, "
                              f"*MAT_{'CABLE_DISCRETE_BEAM' if one.section is not None and one.section.is_cable else 'PLASTIC_KINEMATIC' if one.material.yield_stress else 'ELASTIC'}"))
        if one.mesh.kind == BEAMS:
            model.choices.append((f"'{one.title}' touches nothing" + (", water flows through it" if basin.wet else ""), "beams have no faces", "none"))
        if not basin.wet:
            continue
        wave = one.mesh.side / one.sound_speed
        limit = basin.spacing / basin.sound_speed
        if wave < 0.5 * limit:
            model.choices.append((f"'{one.title}' makes steps shorter: {wave:.2g} in its shortest element, {limit:.2g} in the water",
                                  "the time that sound takes through it limits the step", "*CONTROL_TIMESTEP; a larger 'size' makes longer steps"))
    if not basin.wet or all(one.mesh.kind == BEAMS for one in basin.structures):
        return
    model.choices.append(("water touches deformable parts" if basin.dim == 2 else "deformable parts touch water, walls, bodies and each other",
                          "the program knows no contact of elements in the plane" if basin.dim == 2 else "all that can touch does",
                          "*CONTACT_AUTOMATIC_NODES_TO_SURFACE 3" + ("" if basin.dim == 2 else ", *CONTACT_AUTOMATIC_SURFACE_TO_SURFACE 4, _SINGLE_SURFACE 5")))
