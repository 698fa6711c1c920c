"""Water with its box, walls and bodies, in a description that needs no cards."""
from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ..diagnostics import Diagnostics
from ..key_tables import keys as keys_of_map
from ..yaml_map import Node, is_list, is_map, is_scalar
from .basin import Basin, add_basin
from .joints import joined_names
from .meshes import BEAMS
from .model import MOST_ENTITIES, Lattice, Model, Near, NearSurface, Vector
from .node_reader import OF_PYTHON
from .openings import check_inlets, read_openings
from .placeholders import PlaceholderFault, substitute
from .rotations import check_swept, read_rotation
from .series import read_series
from .shape_reader import ShapeReader
from .shapes import Shape, faulty_edges
from .solids import FREE, Solid
from .still_water import has_oblique_walls, is_dry_behind, stays_still, still_water
from .structure_checks import check_bodies, check_structures
from .structure_reader import read_structures
from .water_checks import check_overlaps, check_piston, positions
from .wave_reader import Piston, check_reach, read_waves

_WATER = keys_of_map(
    "water",
    "spacing number!, blocks [@a block], bodies [@a body of water], density number, sound_speed number, viscosity number, tension flag, velocity list, "
    "pressure number",
)
_BOX = keys_of_map("box", "low vector!, high vector!, open list, motion @motion")
_MOTION = keys_of_map("motion", "x text|list|@a curve, y text|list|@a curve, z text|list|@a curve, waves @waves, rotation @a rotation")
_OF_WALL = keys_of_map("a wall, besides its shape", "motion @motion")
_OF_BODY = keys_of_map("a body, besides its shape", "density number, mass number, velocity list, hold any")
_GOES_WITH_WATER = ("box", "walls", "bodies", "structures", "joints", "inlets", "outlets", "wall_method", "gravity", "end", "output")
_FEW = 1000  # cells whose particles are counted
_LARGE = 50.0  # times the scene, above which a shape has other units
_NAMES = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?!\s*\(|\w)")  # that are no functions, nor exponents of numbers
MOST_MIRRORS = 12  # lines of a shape in the plane, triangles of a body in space
METHODS = ("contact", "mirrors", "mixed", "ghosts")


class BasinReader(ShapeReader):
    def __init__(self, path: str, overrides: Mapping[str, str], diagnostics: Diagnostics) -> None:
        super().__init__(path, overrides, diagnostics)
        self.pistons: list[Piston] = []  # in the order of the scene
        self.of_inlets = 0  # dimensions of the scene by its first inlet
        self.basin: Basin | None = None
        self.complete = True  # what was read of the basin; else parts that others name may be missing

    def read_basin(self, root: Node, model: Model) -> None:
        water = self.get(root, "water")
        if (spacing := self.get(root, "spacing")) is not None:
            self.error(spacing, "'spacing' of the scene is that of gases; of water it is under 'water'", "water: {spacing: 0.01, blocks: [...]}")
        if water is None:
            for key in _GOES_WITH_WATER:
                if (entry := self.get(root, key)) is not None:
                    self.error(entry, f"'{key}' goes with 'water', which the scene has not")
            return
        before = self.diagnostics.errors
        if (friction := self.get(root, "friction")) is not None:
            self.error(friction, "friction: of parts in scenes without water", "*CONTACT_... cards under 'keywords' have FS and FD")
        inlets = self.get(root, "inlets")
        first = inlets.value[0] if inlets is not None and is_list(inlets) and inlets.value else None
        at = self.get(first, "at") if first is not None else None
        if at is None and first is not None and (box := self.get(root, "box")) is not None:
            at = self.get(box, "low")
        self.of_inlets = len(at.value) if at is not None and is_list(at) and len(at.value) in (2, 3) else 0
        basin = self.basin = self.read_water(water)
        if (gravity := self.get(root, "gravity")) is not None:
            basin.gravity = self.number(gravity, "gravity") or 0.0
            if basin.gravity < 0:
                self.error(gravity, "gravity: expected its size, >= 0; it acts downwards")
        self._check_units(root, water, basin)
        basin.end = self.length(root, "end", "time")
        basin.output = self.length(root, "output", "time") if self.get(root, "output") is not None else basin.end / 100
        if (box := self.get(root, "box")) is not None:
            self.read_box(box, basin)
        if self.diagnostics.errors == before:
            self.read_solids(root, basin)
            read_structures(self, root, basin)
            read_openings(self, root, basin)
            self.read_method(root, basin)
            check_inlets(self, basin)
        if self.diagnostics.errors == before:
            self.fill(basin)
            self.keep_out(basin)
            if self.diagnostics.errors == before:
                self.examine_rest(root, basin)
            self.check_solids(basin)
            check_structures(basin, self.diagnostics)
            self.check_water(basin, self.get(water, "spacing") or water)
            self.check_bodies_of_the_plane(basin, joined_names(self, root))
            check_bodies(basin, joined_names(self, root), self.diagnostics)
        self.complete = self.diagnostics.errors == before
        if not self.complete:
            return
        if fault := basin.complete():
            self.error(water, fault)
            self.complete = False
        else:
            add_basin(basin, model)

    def _check_units(self, root: Node, water: Node, basin: Basin) -> None:
        """Of density and gravity one is in other units where the other has its default."""
        gravity, density = self.get(root, "gravity"), self.get(water, "density")
        if gravity is not None and density is None and any(abs(basin.gravity / size - 1) < 0.02 for size in (981, 9810)):
            self.diagnostics.warning(self.at(gravity), f"gravity {basin.gravity:g} is that of other units than metres, and the density that of kg and metres",
                                     "density: 1.0e-9 in tonnes and mm, 1.0e-6 in kg and mm, 1 in g and cm")
        elif density is not None and gravity is None and 0 < basin.density < 0.01:
            self.diagnostics.warning(self.at(density), f"density {basin.density:g} is that of other units than kg and metres, and gravity {basin.gravity:g} that of metres",
                                     "gravity: 9810 in mm and seconds, 0 for none")

    def read_water(self, node: Node) -> Basin:
        basin = Basin()
        if not self.is_map(node, "water: {spacing: 0.01, blocks: [{low: [0, 0], high: [1, 1]}]}", "water"):
            return basin
        self.check_keys(node, "water", _WATER)
        if self.get(node, "density") is not None:
            basin.density = self.length(node, "density", "number")
        if self.get(node, "sound_speed") is not None:
            basin.sound_speed = self.length(node, "sound_speed", "speed")
        if (viscosity := self.get(node, "viscosity")) is not None:
            basin.viscosity = self.number(viscosity, "viscosity") or 0.0
            if basin.viscosity < 0:
                self.error(viscosity, "viscosity: expected a number >= 0")
        basin.tension = self.flag(node, "tension", True)
        basin.water.where = self.at(node)
        if self.get(node, "velocity") is not None:
            self.read_velocity(node, True, basin.water)
        if (pressure := self.get(node, "pressure")) is not None:
            basin.water.pressure = self.of_place(pressure, "pressure")
        basin.spacing = self.length(node, "spacing")
        blocks, bodies = self.get(node, "blocks"), self.get(node, "bodies")
        if blocks is None and bodies is None and self.of_inlets:
            basin.dim = self.dim = self.of_inlets
            return basin
        if bodies is None and (blocks is None or not is_list(blocks) or not blocks.value):
            given = ", ".join(repr(str(key.value)) for key, _ in node.value if key.value != "spacing")
            self.error(node if blocks is None else blocks, "water: the scene has none: 'blocks' is a list of {low: [x, y], high: [x, y]}, in 3D with z",
                       "a scene of bodies and parts that deform alone has no 'water'" + (f": leave out {given}" if given else ", and 'spacing' by itself"))
            return basin
        entries = blocks.value if blocks is not None and is_list(blocks) else []
        basin.water.lattices = [self.read_lattice(one, basin.spacing) for one in entries if self.is_map(one)]
        for one in self._list(bodies, "bodies") if bodies is not None else ():
            if basin.spacing > 0 and (shape := self.read_shape(one, "a body of water", basin.spacing)) is not None:
                self.dim = self.dim or shape.dim
                basin.fills.append((shape, one))
        basin.dim = self.dim
        return basin

    def _list(self, node: Node, name: str) -> list[Node]:
        if is_list(node) and node.value:
            return list(node.value)
        self.error(node, f"{name}: expected a list that is not empty", f"{name}: [{{file: house.stl, scale: 0.001}}]")
        return []

    def read_box(self, node: Node, basin: Basin) -> None:
        if not self.is_map(node, "box: {low: [0, 0], high: [2, 1], open: [top]}", "box"):
            return
        self.check_keys(node, "box", _BOX)
        low, low_dim = self.vector(node, "low")
        high, high_dim = self.vector(node, "high")
        basin.box = (low, high)
        if self.dim and low_dim and high_dim and (low_dim != basin.dim or high_dim != basin.dim):
            self.error(node, f"box: the {'water has' if basin.wet else 'parts have'} {basin.dim} dimensions, and so must low and high")
        opened = self.get(node, "open")
        if opened is not None and is_map(opened):
            self.error(opened, "open: expected a list of sides", "open: [top]")
        for side in () if opened is None or is_map(opened) else opened.value if is_list(opened) else [opened]:
            name = self.text(side)
            if name not in basin.sides:
                self.error(side, f"open: '{name}' is no side of the box", f"its sides: {', '.join(basin.sides)}")
            basin.open.add(name)
        before = len(self.pistons)
        basin.box_motion = self.read_motion(node, basin)
        motion = self.get(node, "motion")
        if motion is not None and is_map(motion) and self.get(motion, "rotation") is not None:
            self.error(motion, "rotation: of a wall, and the box does not turn", "walls: [{box: {low: [0, 0], high: [1, 1]}, open: true, motion: {rotation: ...}}]")
        if any(piston.own_card for piston in self.pistons[before:]):
            self.error(self.get(node, "motion") or node, "box: a box neither turns as a flap nor absorbs waves", "make the wave maker a wall of its own")

    def read_motion(self, node: Node, basin: Basin) -> dict[str, str | np.ndarray]:
        """Displacements along axes [L]: formulas of TIME, or of waves numbers over time."""
        entry = self.get(node, "motion")
        if entry is None or not self.is_map(entry, "motion: {x: 0.05 * sin(2 * PI * TIME / 1.2)}", "motion"):
            return {}
        axes = _MOTION[: self.dim or 3]
        self.check_keys(entry, "motion", (*axes, "waves", "rotation"))
        if self.get(entry, "rotation") is not None:
            return {}  # which `read_solids` reads
        out: dict[str, str | np.ndarray] = {}
        made: str | np.ndarray
        before = len(self.pistons)
        for key, value in entry.value:
            axis = str(key.value)
            if axis == "waves":
                piston = read_waves(self, value, basin.gravity, basin.end, basin.spacing)
                if piston is None:
                    continue
                axis, made = piston.axis, piston.series
                self.pistons.append(piston)
            elif (motion := self._curve(value, basin.end) if not is_scalar(value) else self._formula(value)) is None:
                continue
            else:
                made = motion
            if axis in out and (key.value == "waves" or not isinstance(out[axis], str)):
                self.error(value, f"motion: the waves and a formula both move the wall along {axis}", f"leave out the waves or '{axis}'")
            out[axis] = made
        if len(out) > 1 and any(piston.own_card for piston in self.pistons[before:]):
            self.error(entry, "motion: a flap, and a wave maker that absorbs, has no other motion", "leave out the formulas")
        return out

    def _rotation(self, entry: Node, solid: Solid, basin: Basin) -> None:
        """Of a wall."""
        motion = self.get(entry, "motion")
        node = self.get(motion, "rotation") if motion is not None and is_map(motion) else None
        if node is None or motion is None:
            return
        if len(motion.value) > 1:
            self.error(motion, "motion: a wall that turns has no other motion", "rotation: {about: [1, 0.5], speed: 90}")
        solid.rotation = read_rotation(self, node, basin)
        if solid.rotation is not None:
            check_swept(self, node, solid.rotation, solid.shape, basin)

    def _formula(self, node: Node, key: str = "motion") -> str | None:
        """Of TIME. Functions are those of *DEFINE_CURVE_FUNCTION, which the program knows; names are checked here."""
        example = "0.05 * sin(2 * PI * TIME / 1.2), or {file: motion.csv}"
        if node.tag == OF_PYTHON:
            self.error(node, f"{key}: expected a formula of TIME, got {node.value}", example)
            return None
        try:
            made = substitute(node.value, self.variables)
        except PlaceholderFault as fault:
            self.error(node, fault.message)
            return None
        odd = [name for name in _NAMES.findall(made) if name.upper() not in ("TIME", "PI")]
        if odd:
            self.error(node, f"{key}: unknown name '{odd[0]}' in the formula '{made}'", f"names are TIME and PI, and of parameters ${{name}}: {example}")
        elif made.count("(") != made.count(")"):
            self.error(node, f"{key}: as many '(' as ')' are needed in the formula '{made}'")
        else:
            return made
        return None

    def _curve(self, node: Node, end: float) -> np.ndarray | None:
        """A displacement over time [L], which is kept where the curve ends before the run."""
        rows = read_series(self, self.folder, node, "motion")
        if rows is None:
            return None
        begin = max(rows[0, 0], 0.0)
        at_begin = np.interp(begin, *rows.T)
        if abs(at_begin) > 1e-6 * np.abs(rows[:, 1]).max() or begin > 0:
            self.error(node, f"motion: the curve begins with {at_begin:g} at {begin:g}: a displacement counts from the position at the start and begins "
                       "with 0 at 0", "subtract its first value from all")
            return None
        return np.vstack([rows, [[2 * end, rows[-1, 1]]]]) if rows[-1, 0] < end else rows

    def read_solids(self, root: Node, basin: Basin) -> None:
        """Walls that are held or driven, and bodies that move freely."""
        for key, what, others in (("walls", "a wall", _OF_WALL), ("bodies", "a body", _OF_BODY)):
            node = self.get(root, key)
            for entry in self._list(node, key) if node is not None else ():
                shape = self.read_shape(entry, what, basin.spacing, others)
                if shape is None:
                    continue
                shape.mesh = 2 * basin.spacing
                self.add_entities(entry, len(shape.faces))
                solid = Solid(shape, closed=self._is_closed(shape) and not self.flag(entry, "open", False), where=self.at(entry))
                if key == "walls":
                    before = len(self.pistons)
                    solid.motion = self.read_motion(entry, basin)
                    self._rotation(entry, solid, basin)
                    solid.piston = self.pistons[-1] if len(self.pistons) > before else None
                    for axis, series in solid.motion.items():
                        if basin.box and not isinstance(series, str):
                            at = "xyz".index(axis)
                            check_reach(self, entry, axis, series, shape.points, basin.box[0][at], basin.box[1][at], solid.piston)
                else:
                    self.read_body(entry, solid)
                basin.solids.append(solid)

    def check_water(self, basin: Basin, spacing: Node) -> None:
        check_overlaps(basin.water.lattices, self.variables, self.diagnostics)
        if basin.water.lattices and not basin.inlets and sum(np.prod(one.n, dtype=float) for one in basin.water.lattices) < _FEW \
                and sum(len(positions(one, self.variables)) for one in basin.water.lattices) == 1:
            self.error(spacing, f"spacing: with {basin.spacing:g} the water is a single particle, which has no neighbours", "a tenth of the depth of the water or less")
        for inlet in basin.inlets:
            behind = sum(int(inlet.waits(positions(one, self.variables), basin.spacing, basin.end).sum()) for one in basin.water.lattices)
            if behind:
                report = self.diagnostics.error if np.isfinite(inlet.length(basin.end)) else self.diagnostics.warning
                report(inlet.where, f"an inlet inside of the water: {behind} particles are behind it, where those wait that enter",
                       "an inlet is a jet into air; of a channel, side: left, depth: 0.3 lets water in through an end of it")
        for solid in basin.solids:
            if solid.piston is not None and basin.water.lattices:
                check_piston(solid.piston, solid, basin.water.lattices, self.variables, self.diagnostics)

    def check_bodies_of_the_plane(self, basin: Basin, joined: set[str]) -> None:
        """Bodies of the plane touch no wall: one that sinks and has no joint would leave the box unseen."""
        basin.rigid_parts()  # numbers them
        held = basin.box is not None or any(not solid.free for solid in basin.solids)
        tied = {part for one in basin.structures for part, _ in one.carried}
        falling = next((solid for solid in basin.solids if solid.free and solid.part not in tied and not {"x", "y"} <= solid.hold
                        and not {solid.shape.name, str(solid.part)} & joined), None)
        if basin.dim == 2 and held and falling is not None:
            self.diagnostics.warning(falling.where, f"'{falling.shape.name or 'a body'}' passes through walls and falls through the floor: bodies of the plane "
                                     "do not touch walls", "only the water acts on it; a scene in space has this contact, and hold: [x, y] keeps a body")

    def check_solids(self, basin: Basin) -> None:
        """Refuses what covers all the water, as a file in other units does, and bodies that begin in a wall of the box."""
        scene = max((float(np.max(np.subtract(high, low))) for low, high in self._extents(basin)), default=0.0)
        for solid in basin.solids:
            low, high = np.array(solid.shape.low, float)[:basin.dim], np.array(solid.shape.high, float)[:basin.dim]
            name = solid.shape.name or "a solid"
            longest = float(np.max(high - low))
            if (large := longest > _LARGE * scene > 0) or longest < basin.spacing / 2:
                self.diagnostics.warning(solid.where, f"'{name}' is {longest:g} long, " + (f"and the scene {scene:g}" if large else f"less than half of the spacing {basin.spacing:g}"),
                                         "is it a file in millimetres? 'scale: 0.001' makes metres of them" if large else "is its 'scale' that of the file?")
            if solid.closed and self._covers(solid.shape, basin):
                size = " x ".join(f"{length:g}" for length in high - low)
                self.diagnostics.error(solid.where, f"'{name}', {size}, is solid and covers all the water", "of a tank, 'open: true' takes the surface alone; "
                                       "is it a file in millimetres? 'scale: 0.001' makes metres of them")
            for k in range(basin.dim if solid.free and basin.box else 0):
                ends = basin.box[0][k], basin.box[1][k]  # type: ignore[index]
                tiny = 1e-6 * basin.spacing
                beyond = (low[k] < ends[0] - tiny and basin.sides[2 * k] not in basin.open) or (high[k] > ends[1] + tiny and basin.sides[2 * k + 1] not in basin.open)
                if beyond:
                    self.diagnostics.error(solid.where, f"'{name}' reaches from {low[k]:g} to {high[k]:g} along {'xyz'[k]}, through a wall of the box from "
                                           f"{ends[0]:g} to {ends[1]:g}", "a body that begins in a wall is not held by it")

    @staticmethod
    def _extents(basin: Basin) -> list[tuple[Vector, Vector]]:
        """Corners of the box, or of the blocks of water."""
        return [basin.box] if basin.box else [(one.low, tuple(np.add(one.low, one.spacing * np.array(one.n)))) for one in basin.water.lattices]

    def _covers(self, shape: Shape, basin: Basin) -> bool:
        """Whether all particles would be inside of it, were it not there."""
        some = False
        for one in basin.water.lattices:  # boxes are compared first, with a cell more, which a body of water may cut
            low, high = np.array(one.low), np.array(one.low) + one.spacing * np.array(one.n)
            if not all(shape.low[k] <= low[k] + one.spacing and shape.high[k] >= high[k] - one.spacing for k in range(basin.dim)):
                return False
            cells = positions(replace(one, without=[], jitter=0.0), self.variables)
            some |= len(cells) > 0
            if not shape.contains(cells).all():
                return False
        return some

    @staticmethod
    def _is_closed(shape: Shape) -> bool:
        edges = faulty_edges(shape)
        return not len(edges.free) and not len(edges.crowded)

    def read_body(self, entry: Node, solid: Solid) -> None:
        if not solid.closed:
            self.error(entry, "a body: only a closed shape has a mass")
            return
        mass, density = self.get(entry, "mass"), self.get(entry, "density")
        if (mass is None) == (density is None):
            self.error(entry, "a body: expected its 'density' or its 'mass'")
            return
        solid.density = self.length(entry, "density", "number") if mass is None else self.length(entry, "mass", "number") / solid.shape.volume()
        solid.free = True
        if self.get(entry, "velocity") is not None:
            solid.velocity = self.vector(entry, "velocity")[0]
        hold = self.get(entry, "hold")
        for one in self._list(hold, "hold") if hold is not None else ():
            name = self.text(one)
            if name not in FREE:
                self.error(one, f"hold: '{name}' is no direction", f"directions: {', '.join(FREE)}; r is a turn")
            solid.hold.add(name)

    def read_method(self, root: Node, basin: Basin) -> None:
        node = self.get(root, "wall_method")
        asked = self.text(node) if node is not None else "auto"
        # mirrors of many faces take most of the time of a run
        shaped = any(not solid.free and (basin.dim == 3 or len(solid.shape.faces) > MOST_MIRRORS) for solid in basin.solids)
        for solid in basin.solids if asked == "auto" and basin.dim == 3 else ():
            faces = len(solid.shape.faces)
            if solid.free and faces > MOST_MIRRORS:
                solid.by_contact = shaped = True
                self.diagnostics.warning(solid.where, f"'{solid.shape.name or 'a body'}' acts on the water by contact and floats one to three spacings too deep: "
                                         f"a mirror of its {faces} faces takes more than all else of the run",
                                         f"a box or a body of at most {MOST_MIRRORS} triangles is a mirror; wall_method: ghosts suits calm water and bodies without thin edges")
        basin.method = asked if asked != "auto" else "mixed" if shaped else "mirrors"
        if node is not None:
            if asked not in (*METHODS, "auto"):
                self.error(node, f"wall_method: '{asked}' is none", f"it is one of {', '.join(METHODS)}, auto")

    def fill(self, basin: Basin) -> None:
        """Lattices of the bodies of water, cells beside each other over all of the scene; water keeps out of what is solid."""
        dx, origin = basin.spacing, self._origin(basin)
        for shape, node in basin.fills:
            low, high = (np.array(v) for v in (shape.low, shape.high))
            if basin.box:
                low, high = np.maximum(low, basin.box[0]), np.minimum(high, basin.box[1])
            first = np.floor((low - origin) / dx + 1e-6)
            n = np.maximum(np.ceil((high - origin) / dx - 1e-6) - first, 0)
            if shape.dim == 2:
                n[2] = 1
            if not np.all(n > 0) or float(np.prod(n)) > MOST_ENTITIES:
                self.error(node, f"the lattice of '{shape.name}' would have {float(np.prod(n)):.3g} cells; 1 to {MOST_ENTITIES:.0e} are possible")
                continue
            corner = origin + first * dx
            lattice = Lattice(shape.dim, (float(corner[0]), float(corner[1]), float(corner[2])), dx, (int(n[0]), int(n[1]), int(n[2])))
            lattice.solids, lattice.location = [Near(shape)], self.at(node)
            self.add_entities(node, float(np.prod(n)))
            basin.water.lattices.append(lattice)

    @staticmethod
    def keep_out(basin: Basin) -> None:
        """Water keeps half a spacing free beside solids and thin walls, where contact acts; before ghosts less, so that points of the lattice on both
        sides of a wall are water or ghosts."""
        inside, beside = (0.25, 0.2) if basin.method == "ghosts" else (0.5, 0.5)  # along an axis, and across a wall
        dx = basin.spacing * (1 - 1e-6)
        out = [Near(one.shape, inside * dx) if one.closed or one.shape.ground else NearSurface(one.shape, beside * dx) for one in basin.solids]
        out += [one.keeps_out(basin.dim, basin.spacing) for one in basin.structures if one.mesh.kind != BEAMS]
        for lattice in basin.water.lattices:
            lattice.without = out

    def examine_rest(self, root: Node, basin: Basin) -> None:
        """Of water at rest between walls: its pressure follows from its level, and in the plane, where walls are oblique and nothing
        will move it, they have ghosts."""
        node = self.get(root, "wall_method")
        oblique = basin.dim == 2 and (node is None or self.text(node) == "auto") and has_oblique_walls(basin) and stays_still(basin, self._cards(root))
        unknown = basin.mirrors and basin.start() is None
        if not (basin.box or basin.solids) or not (oblique or unknown) or (water := still_water(basin, self.variables)) is None:
            return
        if unknown:
            basin.level = water.level
        if oblique and is_dry_behind(basin, water.points):
            basin.method, basin.still = "ghosts", True
            self.keep_out(basin)

    def _cards(self, root: Node) -> list[str]:
        """Deck text beside that of the scene, and of its bases."""
        nodes = [self.get(one, "keywords") for one in (root, *(base.node for base in self.bases))]
        return [str(one.value) for node in nodes if node is not None for one in (node.value if is_list(node) else [node]) if is_scalar(one)]

    @staticmethod
    def _origin(basin: Basin) -> np.ndarray:
        if basin.box:
            return np.array(basin.box[0])
        if basin.water.lattices:
            return np.array(basin.water.lattices[0].low)
        return np.array(basin.fills[0][0].low) if basin.fills else np.zeros(3)


