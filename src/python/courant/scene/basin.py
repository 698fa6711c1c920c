"""Water in a box with all cards that it needs, so that a scene need not write them: what most free-surface flows begin with. Defaults are those with
which still water neither leaks nor moves."""
from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .explain import explain_basin
from .model import Model, Part, PlaceExpression, Plate, Variables, Vector
from .numbers import number_text
from .placeholders import substitute
from .requests import REQUESTS
from .solids import Solid, cards_of_solids, fastest_of, number_parts, part_of
from .openings import Inlet, Outlet, add_openings, with_outlets
from .structures import Structure, add_structures

WATER_PART, WALL_PART = 1, 11
_REACH = 6  # spacings: more than that of the kernel

# Filled like the keywords of a scene; the names are those of `Basin.variables`.
_CARDS = """\
*CONTROL_TERMINATION
$#  endtim    endcyc     dtmin    endeng    endmas     nosol
${end:10}         0         0         0     1.0e8         0
*CONTROL_TIMESTEP
$#  dtinit    tssfac
         0       0.5
*CONTROL_SPH
$#    ncbs     boxid        dt      idim
         1         0    1.0e20${dim:10}
$ Water: p = C1 (rho/RO - 1) with C1 = RO c0^2 of the sound speed c0 = ${c0}; PC is the largest tension
*MAT_NULL
$#     mid        ro        pc        mu
         1${rho0:10}${pc:10}         0
*EOS_LINEAR_POLYNOMIAL
$#   eosid        c0        c1        c2        c3        c4        c5        c6
         1         0${rho0 * c0^2:10}         0         0         0         0         0
$#      e0        v0
         0       1.0
*SECTION_SPH
$#   secid      cslh      hmin      hmax
         1       2.0       1.0       1.0
$ A smooth, wide kernel: gentle waves keep their height, bodies afloat feel no lattice
*COURANT_KERNEL
wendland_c4
$ Diffusion of density, which leaves hydrostatic pressure alone
*COURANT_DENSITY_DIFFUSION
$#   delta
       0.1
$ Artificial viscosity: Q1 is the quadratic coefficient, off, Q2 the linear one
*HOURGLASS
$#    hgid       ihq        qm       ibq        q1        q2
         1         0         0         0   1.0e-20${q:10}
""" + REQUESTS

GRAVITY = """\
$ Gravity: LOAD_BODY gives the acceleration of the base, so +g pushes the water down
*LOAD_BODY_{axis}
$#    lcid        sf
         1       1.0
*DEFINE_CURVE
$#    lcid
         1
$#                a1                  o1
                 0.0${{g:20}}
${{10 * end + 1:20}}${{g:20}}
"""

# A particle's contact stiffness is SLSFAC SFSA = 1 of that of the water itself, rho c^2; walls are stiffer.
_SHELLS = "$ Walls: fixed rigid shells; contact acts at half their thickness, which particles half a spacing off just touch\n"

FIXED = """\
*MAT_RIGID
$#     mid        ro         e        pr
         2${7.85 * rho0:10}${young:10}       0.3
$#     cmo      con1      con2
         1         7         7
$#      a1        a2        a3        v1        v2        v3
         0         0         0         0         0         0
"""

_BOX = """\
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
         1water against walls
$#   surfa     surfb  surfatyp  surfbtyp
         1        11         3         3
$#      fs        fd        dc        vc       vdc    penchk        bt        dt
         0         0         0         0         0         0         0    1.0e20
$#    sfsa      sfsb
        10${sfsb:10}
*DATABASE_RCFORC
$#      dt
${output / 10:10}
"""



@dataclass
class Basin:
    dim: int = 2  # 2: y is up, 3: z is up
    water: Part = field(default_factory=Part)  # lattices and velocity; the rest is filled in
    spacing: float = 0.0  # of the particles [L]
    density: float = 1000.0  # [M/L3]
    sound_speed: float = 0.0  # 0: by complete() [L/T]
    speed_given: bool = False
    viscosity: float | None = None  # linear coefficient of the artificial viscosity; None: 0 [-]
    tension: bool = True  # the water may pull
    gravity: float = 9.81  # downwards [L/T2]
    end: float = 0.0  # [T]
    output: float = 0.0  # interval of field states [T]
    box: tuple[Vector, Vector] | None = None  # corners [L]
    open: set[str] = field(default_factory=set)  # sides without a wall
    box_motion: dict[str, str | np.ndarray] = field(default_factory=dict)  # displacements of the box by axis, formulas of TIME [L]
    fills: list[tuple[Any, Any]] = field(default_factory=list)  # shapes that are filled with water, and their entries
    solids: list[Solid] = field(default_factory=list)
    structures: list[Structure] = field(default_factory=list)  # parts that deform
    inlets: list[Inlet] = field(default_factory=list)
    outlets: list[Outlet] = field(default_factory=list)
    method: str = "contact"  # how walls act on the water: by contact, as mirrors, by ghost particles, or mixed: box and bodies as mirrors, other walls by contact
    level: float | None = None  # of water at rest between walls [L]
    still: bool = False  # it stays so, and walls have ghosts for that
    wet: bool = True  # there is water
    friction_of_parts: float = 0.0  # coefficient, where they touch each other

    @property
    def sides(self) -> tuple[str, ...]:
        """left and right along x, bottom and top, in 3D front and back along y."""
        return ("left", "right", "bottom", "top") if self.dim == 2 else ("left", "right", "front", "back", "bottom", "top")

    def complete(self) -> str:
        """Fills in the sound speed, twenty times the speed that the water gets; what is wrong, or nothing."""
        up = self.dim - 1
        bottom, top = min([self.box[0][up] if self.box else math.inf, *(float(solid.shape.low[up]) for solid in self.solids)]), -math.inf
        for k in range(self.dim if self.box else 0):
            if not self.box[1][k] > self.box[0][k]:  # type: ignore[index]
                return f"the box has no extent along {'xyz'[k]}"
        for block in self.water.lattices:
            corner = [block.low[k] + block.spacing * block.n[k] for k in range(3)]
            if block.solids:
                corner = [min(corner[k], float(block.solids[0].shape.high[k])) for k in range(3)]
            bottom, top = min(bottom, block.low[up]), max(top, corner[up])
            for k in range(self.dim if self.box else 0):
                low, high = self.box[0][k], self.box[1][k]  # type: ignore[index]
                if block.low[k] < low - 1e-6 * self.spacing or corner[k] > high + 1e-6 * self.spacing:
                    return f"a block reaches from {block.low[k]:g} to {corner[k]:g} along {'xyz'[k]}, beyond the box from {low:g} to {high:g}"
        for inlet in self.inlets:
            top = max(top, float(inlet.at[up]) + inlet.size[-1] / (2 if len(inlet.size) == 2 else 1))
            bottom = min(bottom, float(inlet.at[up]))
        if len(self.open) == len(self.sides):
            return "a box with all sides open: leave it out"
        self.speed_given = self.sound_speed > 0
        if self.speed_given:
            return ""
        factor = 20.0  # a blow squeezes the liquid by speed / sound speed
        v = self.water.velocity or (0.0, 0.0, 0.0)
        squares = [v[0] * v[0] + v[1] * v[1] + v[2] * v[2], *(inlet.speed**2 for inlet in self.inlets), *(speed**2 for speed in self.speeds_of_walls()),
                   *(float(np.dot(solid.velocity or (0.0, 0.0, 0.0), solid.velocity or (0.0, 0.0, 0.0))) + self.falls(solid, top, bottom) for solid in self.solids if solid.free)]
        speed = math.sqrt(2 * self.gravity * max(0.0, top - bottom) + max(squares))
        if not speed > 0 or self.water.velocity_of_place or any(inlet.formula for inlet in self.inlets) or not np.isfinite(squares).all():
            return "'sound_speed' is missing: it follows only from gravity, one velocity of all the water and steady inlets; give twenty times the largest speed"
        digits = math.pow(10, math.floor(math.log10(factor * speed)) - 1)  # two of them
        self.sound_speed = math.ceil(factor * speed / digits - 1e-9) * digits
        return ""

    def speeds_of_walls(self) -> list[float]:
        """Largest speeds of walls with a motion: of walls that turn, of the points farthest from their axes [L/T]."""
        moved = [motion for motion in (self.box_motion, *(solid.motion for solid in self.solids)) if motion]
        return [*(solid.rotation.fastest(solid.shape, self.end) for solid in self.solids if solid.rotation is not None), *(fastest_of(motion, self.end) for motion in moved)]

    def falls(self, solid: Solid, top: float, bottom: float) -> float:
        """2 g times how much farther a body falls than the water [L2/T2]."""
        return 2 * self.gravity * max(0.0, float(solid.shape.low[self.dim - 1]) - max(top, bottom))

    def variables(self) -> Variables:
        """Of the cards."""
        return {"end": self.end, "dim": self.dim, "c0": self.sound_speed, "rho0": self.density, "young": 5e4 * self.density * self.sound_speed**2, "pc": -1e20 if self.tension else 0.0,
                "q": max(self.friction, 1e-20),  # 0 would be the default
                "output": self.output, "g": self.gravity, "touch": (0.4 if self.method == "ghosts" else 0.9999) * self.spacing,
                "sfsb": 1000.0 if self.dim == 2 and not self.whole_depth else 1.0}  # in 2D walls of a box are narrow strips

    @property
    def foreign_units(self) -> str:
        """What shows that numbers are not those of SI units."""
        return "" if 500 <= self.density <= 2000 else f"the water's density {self.density:g} is not"

    def shell_density(self, solid: Solid) -> float:
        """Of the material of a body [M/L3]."""
        return solid.density

    @property
    def mirrors(self) -> bool:
        """Whether there are any."""
        return self.method != "contact"

    @property
    def whole_depth(self) -> bool:
        """Walls of the plane are one unit deep, as bodies are whose mass counts per unit of depth."""
        return self.mirrors or bool(self.solids) or bool(self.structures)

    def rigid_parts(self) -> dict[int, str]:
        """Titles of the parts of the box, walls and bodies by their numbers, in this order."""
        number_parts(self.solids)
        box = {WALL_PART: "walls"} if self.box and len(self.open) < len(self.sides) else {}
        return box | {solid.part: solid.shape.name for solid in self.solids}

    @property
    def friction(self) -> float:
        """Linear coefficient of the artificial viscosity: none, as it damps waves."""
        return self.viscosity or 0.0

    @property
    def starts_at_rest(self) -> bool:
        return not self.water.velocity and not self.water.velocity_of_place

    def start(self) -> PlaceExpression | None:
        """Hydrostatic pressure of water at rest on the floor of its box, or between walls of any shape, all of it with one surface."""
        up = self.dim - 1
        level = self.level if self.level is not None else self._level_in_box()
        flows = bool(self.inlets) and self.inlets[0].surface is not None and not self.water.velocity_of_place  # a channel
        if level is None or not self.mirrors or self.gravity == 0 or not (self.starts_at_rest or flows):
            return None
        return PlaceExpression(f"{number_text(self.density * self.gravity)} * ({number_text(level)} - {'xyz'[up]})", self.water.where)

    def _level_in_box(self) -> float | None:
        """Of the blocks, where they all have it and the lowest is on the floor [L]."""
        up, dx = self.dim - 1, self.spacing
        if not self.box or not self.water.lattices:
            return None
        tops = [min(one.low[up] + dx * one.n[up], float(one.solids[0].shape.high[up]) if one.solids else math.inf) for one in self.water.lattices]
        if max(tops) - min(tops) > 1e-6 * dx or min(one.low[up] for one in self.water.lattices) > self.box[0][up] + dx / 2:
            return None
        return max(tops)

    def plate(self, axis: int, at: float, mesh: float) -> Plate:
        """One side of the box, across `axis`."""
        assert self.box
        low, high = self.box
        origin, edges, k = [*low], [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], 0
        origin[axis] = at
        for other in range(self.dim):
            if other != axis:
                edges[k][other] = high[other] - low[other]
                k += 1
        n = [max(1, math.ceil(math.sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) / mesh - 1e-6)) for e in edges]
        if self.dim == 2:  # one shell wide
            wide = 1.0 if self.whole_depth else mesh
            edges[1][2], origin[2], n[1] = wide, -wide / 2, 1
        return Plate((origin[0], origin[1], origin[2]), (edges[0][0], edges[0][1], edges[0][2]), (edges[1][0], edges[1][1], edges[1][2]), (n[0], n[1]))

    def _with_reaches(self) -> tuple[Vector, Vector]:
        """The box, longer where a channel begins: its bed and banks act on the water that comes in as on that before it."""
        assert self.box
        low, high = list(self.box[0]), list(self.box[1])
        for inlet in self.inlets:
            if inlet.surface is not None:
                axis = int(np.argmax(np.abs(inlet.direction)))
                end = low if inlet.direction[axis] > 0 else high
                end[axis] -= _REACH * self.spacing * inlet.direction[axis]
        return (low[0], low[1], low[2]), (high[0], high[1], high[2])

    def walls(self) -> Part:
        assert self.box
        mesh = self.spacing / 2 if self.dim == 2 and not self.whole_depth else 2 * self.spacing
        given = self.box
        self.box = self._with_reaches()
        plates = [self.plate(k // 2, self.box[k % 2][k // 2], mesh) for k, side in enumerate(self.sides) if side not in self.open]
        self.box = given
        return Part(id=WALL_PART, title="walls", section=2, material=2, merge=True, plates=[*plates])


def add_basin(basin: Basin, model: Model) -> None:
    """Adds the parts 1 (water) and 11 (walls of the box), those of walls and bodies, and their keywords. The basin must be complete."""
    variables = basin.variables()
    water = basin.water
    water.id, water.title = WATER_PART, "water"
    water.empty = bool(basin.inlets)
    water.section = water.material = water.eos = water.hourglass = 1
    if not water.pressure:
        water.pressure = basin.start()
    model.parts.append(water)
    model.keywords.append(with_outlets(substitute(_CARDS, variables), basin))
    if basin.gravity > 0:
        model.keywords.append(substitute(GRAVITY.format(axis="Y" if basin.dim == 2 else "Z"), variables))
    walls = basin.walls() if basin.box else None
    if walls and walls.plates:
        model.parts.append(walls)
    if basin.solids or (basin.mirrors and basin.box):
        number_parts(basin.solids)
        model.parts += [part_of(solid) for solid in basin.solids]
        model.keywords.append("$ Fixed walls: rigid shells\n" + substitute(FIXED, variables))
        model.keywords += cards_of_solids(basin, walls if walls and walls.plates else None)
    elif basin.box:
        model.keywords.append(_SHELLS + substitute(FIXED + _BOX, variables))
    rigid = [part.id for part in model.parts if part.id != WATER_PART]
    add_openings(basin, model)
    explain_basin(basin, model)
    add_structures(basin, model, rigid)
