"""The description of a scene, a tree of YAML nodes from a file or from calls in Python, becomes a model."""
from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from ..key_tables import keys as keys_of_map
from ..words import shortest
from ..yaml_map import Node, is_list, is_map, is_scalar
from .basin_reader import BasinReader
from .damping import read_damping
from .dry import read_dry
from .gases import read_gases
from .gauges import read_gauges
from .joints import read_joints
from .model import MOST_ENTITIES, Model, Part, Plate
from .placeholders import PlaceholderFault, substitute

_SCENE = keys_of_map(
    "the scene",
    "title text, base text|list, parameters map, spacing number, water @water, gases [@a gas], box @box, walls [@a wall], bodies [@a body], "
    "structures [@a structure], joints [@a joint], inlets [@an inlet], outlets [@an outlet], wall_method text, gravity number, friction number, end number, output number, "
    "parts [@a part], gauges [@a gauge], damping [@a damping zone], keywords text|list",
)
_PART = keys_of_map(
    "a part",
    "id number!, title text, section number!, material number!, eos number, hourglass number, velocity list, pressure number, density number, merge flag, "
    "first_id number, lattices [@a lattice], plates [@a plate]",
)
_PLATE = keys_of_map("a plate", "origin vector!, edge1 vector!, edge2 vector!, mesh number|list!")


class SceneReader(BasinReader):
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
        if not read_gases(self, root, model) and not read_dry(self, root, model):
            self.read_basin(root, model)
        for base in self.of_bases():
            if self.get(base, "parts") is not None:
                self.read_parts(base, model)
        if self.get(root, "parts") is not None or (not model.parts and self.basin is None and self.get(root, "gases") is None):
            self.read_parts(root, model)
        for base in self.of_bases():
            self.read_keywords(base, model)
        self.read_keywords(root, model)
        read_joints(self, root, model, self.basin)
        if self.basin is None or self.basin.wet:
            read_gauges(self, root, model)
            read_damping(self, root, model)
        return model

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

    def _mesh_of(self, plate: Node) -> tuple[float, float]:
        """Along edge1 and edge2: two numbers, or one for both [L]."""
        mesh = self.get(plate, "mesh")
        if mesh is not None and is_list(mesh) and len(mesh.value) == 2:
            return self.length_of(mesh.value[0], "mesh"), self.length_of(mesh.value[1], "mesh")
        both = self.length(plate, "mesh")
        return both, both

    def read_plate(self, node: Node) -> Plate:
        self.check_keys(node, "a plate", _PLATE)
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

