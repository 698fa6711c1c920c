"""The description of a scene, a tree of YAML nodes from a file or from calls in Python, becomes a model."""
from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from ..diagnostics import Diagnostics
from ..words import shortest
from ..yaml_map import Node, is_list, is_map, is_scalar
from .basin import Basin, add_basin
from .model import MOST_ENTITIES, MOST_JITTER, ORIGIN, Lattice, Model, Part, Plate, PlaceExpression
from .node_reader import named_places
from .parameters import ParameterReader
from .placeholders import PlaceholderFault, substitute

_SCENE = ("title", "base", "parameters", "water", "box", "gravity", "end", "output", "parts", "keywords")
_PART = ("id", "title", "section", "material", "eos", "hourglass", "velocity", "pressure", "density", "merge", "first_id", "lattices", "plates")


class SceneReader(ParameterReader):
    def __init__(self, path: str, overrides: Mapping[str, str], diagnostics: Diagnostics) -> None:
        super().__init__(path, overrides, diagnostics)
        self.dim = 0  # of all lattices
        self.entities = 0.0  # so far

    def read(self, root: Node) -> Model:
        """Faults go to the diagnostics with their line; the model counts only where there are none."""
        model = Model()
        if not is_map(root):
            self.diagnostics.error(self.at(root), "a scene is a YAML map", "start with 'title: ...'")
            return model
        self.check_keys(root, "the scene", _SCENE)
        self.read_parameters(root)
        model.files = [self.path, *(base.path for base in self.bases)]
        model.parameters, model.variables = self.parameters, self.variables
        title = self.get(root, "title")
        if title is not None:
            model.title = self.text(title)
            if len(model.title.encode()) > 80:
                self.error(title, "title: a deck's title has at most 80 characters")
        self.read_basin(root, model)
        for base in self.of_bases():
            if self.get(base, "parts") is not None:
                self.read_parts(base, model)
        if self.get(root, "parts") is not None or not model.parts:
            self.read_parts(root, model)
        for base in self.of_bases():
            self.read_keywords(base, model)
        self.read_keywords(root, model)
        return model

    # water in a box, with all its cards

    def read_basin(self, root: Node, model: Model) -> None:
        water = self.get(root, "water")
        if water is None:
            for key in ("box", "gravity", "end", "output"):
                if (entry := self.get(root, key)) is not None:
                    self.error(entry, f"'{key}' goes with 'water', which the scene has not")
            return
        before = self.diagnostics.errors
        basin = self.read_water(water)
        if (gravity := self.get(root, "gravity")) is not None:
            basin.gravity = self.number(gravity, "gravity") or 0.0
            if basin.gravity < 0:
                self.error(gravity, "gravity: expected its size, >= 0; it acts downwards")
        basin.end = self.length(root, "end")
        basin.output = self.length(root, "output") if self.get(root, "output") is not None else basin.end / 100
        if (box := self.get(root, "box")) is not None:
            self.read_box(box, basin)
        if self.diagnostics.errors > before:
            return
        if fault := basin.complete():
            self.error(water, fault)
        else:
            add_basin(basin, model)

    def read_water(self, node: Node) -> Basin:
        basin = Basin()
        if not self.is_map(node, "water: {spacing: 0.01, blocks: [{low: [0, 0], high: [1, 1]}]}", "water"):
            return basin
        self.check_keys(node, "water", ("spacing", "blocks", "density", "sound_speed", "viscosity", "tension", "velocity"))
        if self.get(node, "density") is not None:
            basin.density = self.length(node, "density")
        if self.get(node, "sound_speed") is not None:
            basin.sound_speed = self.length(node, "sound_speed")
        if (viscosity := self.get(node, "viscosity")) is not None:
            basin.viscosity = self.number(viscosity, "viscosity") or 0.0
            if basin.viscosity < 0:
                self.error(viscosity, "viscosity: expected a number >= 0")
        basin.tension = self.flag(node, "tension", True)
        basin.water.where = self.at(node)
        if self.get(node, "velocity") is not None:
            self.read_velocity(node, True, basin.water)
        basin.spacing = self.length(node, "spacing")
        blocks = self.get(node, "blocks")
        if blocks is None or not is_list(blocks) or not blocks.value:
            self.error(node if blocks is None else blocks, "water: 'blocks' is a list of {low: [x, y], high: [x, y]}, in 3D with z")
            return basin
        basin.water.lattices = [self.read_lattice(one, basin.spacing) for one in blocks.value if self.is_map(one)]
        basin.dim = self.dim
        return basin

    def read_box(self, node: Node, basin: Basin) -> None:
        if not self.is_map(node, "box: {low: [0, 0], high: [2, 1], open: [top]}", "box"):
            return
        self.check_keys(node, "box", ("low", "high", "open"))
        low, low_dim = self.vector(node, "low")
        high, high_dim = self.vector(node, "high")
        basin.box = (low, high)
        if low_dim != basin.dim or high_dim != basin.dim:
            self.error(node, f"box: the water has {basin.dim} dimensions, and so must low and high")
        opened = self.get(node, "open")
        if opened is not None and not is_list(opened):
            self.error(opened, "open: expected a list of sides", "open: [top]")
        for side in opened.value if opened is not None and is_list(opened) else ():
            name = self.text(side)
            if name not in basin.sides:
                self.error(side, f"open: '{name}' is no side of the box", f"its sides: {', '.join(basin.sides)}")
            basin.open.add(name)

    # parts of any kind

    def read_parts(self, root: Node, model: Model) -> None:
        node = self.get(root, "parts")
        if node is None or not is_list(node) or not node.value:
            self.error(root if node is None else node, "the scene has no parts", "give a list under 'parts:'")
            return
        ids = {part.id for part in model.parts}  # of the water and its box, and of bases
        for entry in node.value:
            if not is_map(entry):
                self.error(entry, "a part is a map", "- id: 1")
                continue
            part = self.read_part(entry)
            model.parts.append(part)
            if part.id in ids:
                self.error(self.get(entry, "id") or entry, f"part {part.id} is there already")
            ids |= {part.id} - {0}

    def read_part(self, node: Node) -> Part:
        self.check_keys(node, "a part", _PART)
        part = Part(where=self.at(node), id=self.id(node, "id", True))
        title = self.get(node, "title")
        part.title = self.text(title) if title is not None else f"part {part.id}"
        if title is not None and len(part.title.encode()) > 70:
            self.error(title, "title: a part's heading has at most 70 characters")
        part.section, part.material = self.id(node, "section", True), self.id(node, "material", True)
        part.eos, part.hourglass, part.first_id = (self.id(node, key) for key in ("eos", "hourglass", "first_id"))
        if (density := self.get(node, "density")) is not None:
            part.density = self.number(density, "density") or 0.0
            if part.density <= 0:
                self.error(density, f"density: expected a number > 0, got {shortest(part.density)}")
        part.merge = self.flag(node, "merge", False)
        lattices, plates = self.get(node, "lattices"), self.get(node, "plates")
        listed = plates if lattices is None else lattices
        if listed is None or (lattices is not None and plates is not None):
            self.error(node, "a part has either 'lattices' (SPH particles) or 'plates' (shells)")
            return part
        if self.get(node, "velocity") is not None:
            self.read_velocity(node, lattices is not None, part)
        if (pressure := self.get(node, "pressure")) is not None:
            part.pressure = self.of_place(pressure, "pressure")
            if lattices is None:
                self.error(pressure, "pressure: only particles have one, and the part has none")
        if not is_list(listed) or not listed.value:
            self.error(listed, "expected a list that is not empty")
            return part
        entries = [entry for entry in listed.value if self.is_map(entry)]
        if lattices is not None:
            part.lattices = [self.read_lattice(entry) for entry in entries]
        else:
            part.plates = [self.read_plate(entry) for entry in entries]
        return part

    def read_velocity(self, node: Node, particles: bool, part: Part) -> None:
        entry = self.get(node, "velocity")
        components: Sequence[Node] = entry.value if entry is not None and is_list(entry) else ()
        of_places = any(is_scalar(one) and named_places(one.value) for one in components)
        if entry is not None and of_places and not particles:
            self.error(entry, "velocity: x, y, z are the place of a particle, and the part has none", "parts of shells move with one velocity")
        if entry is None or not of_places or not 2 <= len(components) <= 3:
            part.velocity = self.vector(node, "velocity")[0]
            return
        given = [self.of_place(one, "velocity") for one in components]
        none = PlaceExpression("0", self.at(entry))
        part.velocity_of_place = [(given[k] if k < len(given) else none) or none for k in range(3)]

    def read_lattice(self, node: Node, spacing: float = 0.0) -> Lattice:
        """`spacing`: of blocks, which have none of their own."""
        block = spacing > 0
        self.check_keys(node, "a block" if block else "a lattice", ("low", "high", *(() if block else ("spacing",)), "where", "jitter"))
        before = self.diagnostics.errors
        (low, dim), (high, high_dim) = self.vector(node, "low"), self.vector(node, "high")
        lattice = Lattice(dim, low, spacing if block else self.length(node, "spacing"), (0, 0, 1))
        if (where := self.get(node, "where")) is not None:
            lattice.where = self.of_place(where, "where")
        if (jitter := self.get(node, "jitter")) is not None:
            lattice.jitter = self.number(jitter, "jitter") or 0.0
            if not 0 <= lattice.jitter < MOST_JITTER:
                self.error(jitter, f"jitter: expected a fraction of the spacing from 0 to below {MOST_JITTER}, got {shortest(lattice.jitter)}")
        if dim != high_dim and dim and high_dim:
            self.error(node, "low and high of a lattice need the same number of components")
        self.dim = self.dim or dim
        if dim != self.dim and dim:
            self.error(node, f"a lattice of {dim} dimensions beside one of {self.dim}", "give low and high as many components in all lattices of a scene")
        if self.diagnostics.errors > before:
            return lattice
        return self._with_cells(node, lattice, [high[k] - low[k] for k in range(dim)])

    def _with_cells(self, node: Node, lattice: Lattice, extents: Sequence[float]) -> Lattice:
        total, counts = 1.0, [0, 0, 1]
        for k, extent in enumerate(extents):
            cells = extent / lattice.spacing
            n = math.floor(abs(cells) + 0.5) * (1 if cells > 0 else -1) if math.isfinite(cells) else 0
            if n < 1:
                self.error(node, f"the lattice is empty: its extent along {'xyz'[k]} is {shortest(extent)}")
                return lattice
            if abs(cells - n) > 1e-6:
                self.error(node, f"the extent {shortest(extent)} along {'xyz'[k]} is {cells:.9g} spacings, not a whole number")
            total *= n
            if total > MOST_ENTITIES:
                self.error(node, f"the lattice would have {total:.3g} particles or more; {MOST_ENTITIES:.0e} are the limit")
                return lattice
            counts[k] = n
        self.add_entities(node, total)
        return replace(lattice, n=(counts[0], counts[1], counts[2]))

    def _mesh_of(self, plate: Node) -> tuple[float, float]:
        """Along edge1 and edge2: two numbers, or one for both [L]."""
        mesh = self.get(plate, "mesh")
        if mesh is not None and is_list(mesh) and len(mesh.value) == 2:
            return self.length_of(mesh.value[0], "mesh"), self.length_of(mesh.value[1], "mesh")
        both = self.length(plate, "mesh")
        return both, both

    def read_plate(self, node: Node) -> Plate:
        self.check_keys(node, "a plate", ("origin", "edge1", "edge2", "mesh"))
        before = self.diagnostics.errors
        origin, edge1, edge2 = (self.vector(node, key)[0] for key in ("origin", "edge1", "edge2"))
        meshes = self._mesh_of(node)
        plate = Plate(origin, edge1, edge2, (1, 1))
        if self.diagnostics.errors > before:
            return plate
        lengths = [norm(edge) for edge in (edge1, edge2)]
        if not norm(cross(edge1, edge2)) > 1e-9 * lengths[0] * lengths[1]:
            self.error(node, "the plate has no area: edge1 and edge2 are zero or parallel")
            return plate
        n = [shells_along(length, mesh) for length, mesh in zip(lengths, meshes)]
        if n[0] * n[1] > MOST_ENTITIES:
            self.error(node, f"the plate would have {n[0] * n[1]:.3g} shells; {MOST_ENTITIES:.0e} are the limit")
            return plate
        self.add_entities(node, n[0] * n[1])
        return replace(plate, n=(int(n[0]), int(n[1])))

    def add_entities(self, node: Node, more: float) -> None:
        told = self.entities > MOST_ENTITIES
        self.entities += more
        if self.entities > MOST_ENTITIES and not told:
            self.error(node, f"up to here the scene has room for {self.entities:.3g} particles and shells; {MOST_ENTITIES:.0e} are the limit")

    # cards

    def read_keywords(self, root: Node, model: Model) -> None:
        node = self.get(root, "keywords")
        if node is None:
            return
        if not is_scalar(node) and not is_list(node):
            if is_map(node):
                self.error(node, "keywords: expected deck text or a list of deck texts")
            return
        for entry in node.value if is_list(node) else [node]:
            if not is_scalar(entry):
                self.error(entry, "keywords: expected deck text")
                continue
            try:
                model.keywords.append(substitute(entry.value, self.variables))
            except PlaceholderFault as fault:  # the text of a block scalar starts on the line below its mark
                self.diagnostics.error(self.at(entry, fault.line + 1), fault.message)


def norm(v: Sequence[float]) -> float:
    return math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])


def cross(a: Sequence[float], b: Sequence[float]) -> tuple[float, float, float]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def shells_along(length: float, mesh: float) -> float:
    """`mesh` is the largest side of a shell; 1e-6 forgives round-off."""
    return max(1.0, float(math.ceil(min(length / mesh, 1e300) - 1e-6)))


__all__ = ["ORIGIN", "SceneReader"]
