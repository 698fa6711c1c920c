"""Shapes of a description: files, boxes, cylinders, spheres, lines, plates, meshes of other libraries; brought to size and position and made sound."""
from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import yaml

from ..key_tables import keys as keys_of_map
from ..yaml_map import Node, is_list, is_map
from . import shapes
from .lattice_reader import LatticeReader
from .meshes import Mesh
from .node_reader import OF_PYTHON
from .shapes import Shape
from .surfaces import ShapeFault, read_shape, shape_of, sound

KINDS = keys_of_map("a kind of shape", "file text, mesh any, box @a box, cylinder @a cylinder, sphere @a sphere, circle any, line any, plate @a shape's plate")
SHAPE = (*KINDS, *keys_of_map("of every shape", "title text, group text, scale number|list, turn any, move list, close flag, open flag, ground flag"))
BOX = keys_of_map("a box", "low vector!, high vector!")
CYLINDER = keys_of_map("a cylinder", "base vector!, top vector!, radius number!")
SPHERE = keys_of_map("a sphere", "centre vector!, radius number!")
PLATE = keys_of_map("a shape's plate", "origin vector!, edge1 vector!, edge2 vector!")
_OPEN = ("line", "plate")  # need not be closed
Moved = TypeVar("Moved", Shape, Mesh)


class DataNode(yaml.ScalarNode):
    """A mesh of another library, in a scene that is made in Python."""

    def __init__(self, data: Any, mark: Any) -> None:
        super().__init__(OF_PYTHON, "None" if data is None else f"<{type(data).__name__}>", mark, mark)
        self.data = data


class ShapeReader(LatticeReader):
    def read_shape(self, node: Node, what: str, spacing: float, others: tuple[str, ...] = (), closed: bool = True) -> Shape | None:
        """The shape of an entry; None, with a message, where there is none. `spacing` of the particles, which the sides of round shapes follow;
        `closed`: whether a surface must be."""
        if not self.is_map(node, "{file: house.stl, scale: 0.001}", what):
            return None
        self.check_keys(node, what, (*SHAPE, *others))
        given = [kind for kind in KINDS if self.get(node, kind) is not None]
        if len(given) != 1:
            return self._refuse(node, f"{what}: expected one of {', '.join(KINDS)}, got {' and '.join(given) or 'none'}")
        before = self.diagnostics.errors
        try:
            shape = self._made(node, given[0], spacing)
            if shape is None or self.diagnostics.errors > before:
                return None
            shape = self.moved(node, replace(shape, ground=self.flag(node, "ground", False)), shape.dim)
            close = self.flag(node, "close", False)
            free = self.flag(node, "open", given[0] in _OPEN) or shape.ground or not closed
            shape = sound(shape, closed=not free or close, close=close)
        except ShapeFault as fault:
            return self._refuse(self.get(node, given[0]) or node, f"{what}: {fault.message}", fault.hint)
        if self.diagnostics.errors > before:
            return None
        title = self.get(node, "title")
        shape.name = self.text(title) if title is not None else shape.name or given[0]
        if self.dim and shape.dim != self.dim:
            return self._refuse(node, f"{what}: a shape of {shape.dim} dimensions in a scene of {self.dim}")
        for note in shape.notes:
            self.diagnostics.note(self.at(node), f"{shape.name}: {note}")
        return shape

    def _refuse(self, node: Node, message: str, hint: str = "") -> Any:  # None, for those that return a shape
        self.error(node, message, hint)

    def _made(self, node: Node, kind: str, spacing: float) -> Shape | None:
        entry = self.get(node, kind)
        assert entry is not None
        named = self.get(node, "group")
        group = self.text(named) if named is not None else ""
        if kind == "mesh":
            return shape_of(entry.data, group) if isinstance(entry, DataNode) else self._refuse(entry, "mesh: given in Python alone", "file: names a file")
        if kind == "file":
            return read_shape(Path(self.folder, self.text(entry)), group)
        if group:
            return self._refuse(self.get(node, "group") or node, "group: of a 'file' or a mesh")
        if kind == "line":
            return self._line(entry)
        if not is_map(entry):
            examples = {"box": "{low: [0, 0, 0], high: [1, 1, 1]}", "cylinder": "{base: [0, 0, 0], top: [0, 0, 1], radius: 0.1}",
                        "plate": "{origin: [0, 0, 0], edge1: [1, 0, 0], edge2: [0, 1, 0]}"}
            return self._refuse(entry, f"{kind}: expected a map", f"{kind}: " + examples.get(kind, "{centre: [0, 0, 0], radius: 0.1}"))
        return getattr(self, f"_{kind}")(entry, spacing)  # type: ignore[no-any-return]

    def _line(self, entry: Node) -> Shape | None:
        if not is_list(entry) or len(entry.value) < 2:
            return self._refuse(entry, "line: expected a list of points", "line: [[0, 0], [1, 0], [1, 0.5]]")
        points = []
        for one in entry.value:
            if not is_list(one) or len(one.value) != 2:
                return self._refuse(one, "line: a point is [x, y]")
            points.append([self.number(v, "line") or 0.0 for v in one.value])
        return shapes.polyline(np.array(points), closed=len(points) > 3 and points[0] == points[-1])

    def _points(self, entry: Node, kind: str, *keys: str) -> tuple[list[np.ndarray], int]:
        read = [self.vector(entry, key) for key in keys]
        dims = {dim for _, dim in read if dim}
        if len(dims) > 1:
            self.error(entry, f"{kind}: {' and '.join(keys)} need the same number of components")
        return [np.array(v) for v, _ in read], min(dims) if dims else 0

    def _box(self, entry: Node, spacing: float) -> Shape | None:
        self.check_keys(entry, "box", BOX)
        (low, high), dim = self._points(entry, "box", "low", "high")
        if dim and not np.all(high[:dim] > low[:dim]):
            return self._refuse(entry, "box: high must be above low along each axis")
        return shapes.box(low, high, dim) if dim else None

    def _cylinder(self, entry: Node, spacing: float) -> Shape | None:
        self.check_keys(entry, "cylinder", CYLINDER)
        (base, top), dim = self._points(entry, "cylinder", "base", "top")
        radius = self.length(entry, "radius")
        if dim == 2 or not np.linalg.norm(top - base) > 0:
            return self._refuse(entry, "cylinder: base and top are two points in space", "in the plane a cylinder is a circle: {centre: [x, y], radius: r}")
        return shapes.cylinder(base, top, radius, spacing) if radius > 0 else None

    def _sphere(self, entry: Node, spacing: float) -> Shape | None:
        self.check_keys(entry, "sphere", SPHERE)
        (centre,), dim = self._points(entry, "sphere", "centre")
        radius = self.length(entry, "radius")
        return shapes.sphere(centre, radius, spacing, dim) if radius > 0 and dim else None

    _circle = _sphere

    def _plate(self, entry: Node, spacing: float) -> Shape | None:
        self.check_keys(entry, "plate", PLATE)
        (origin, edge1, edge2), dim = self._points(entry, "plate", "origin", "edge1", "edge2")
        if dim == 2 or not np.linalg.norm(np.cross(edge1, edge2)) > 0:
            return self._refuse(entry, "plate: edge1 and edge2 span an area in space", "in the plane a plate is a line: [[x, y], [x, y]]")
        return shapes.plate(origin, edge1, edge2)

    def moved(self, node: Node, shape: Moved, dim: int) -> Moved:
        """A shape or mesh scaled, turned about its origin, by degrees about x, y and z or, in the plane, one angle, and moved."""
        points = shape.points
        if (scale := self.get(node, "scale")) is not None:
            points = points * (self.length_of(scale, "scale", "number") or 1.0)
        if (turn := self.get(node, "turn")) is not None:
            angles = [self.number(one, "turn") or 0.0 for one in turn.value] if is_list(turn) else [0.0, 0.0, self.number(turn, "turn") or 0.0]
            if len(angles) != 3 or (dim == 2 and any(angles[:2])):
                self.error(turn, "turn: expected degrees about x, y and z, in the plane one angle", "turn: [0, 0, 90]")
            else:
                for axis, angle in enumerate(angles):
                    a, b, c, s = (axis + 1) % 3, (axis + 2) % 3, np.cos(np.radians(angle)), np.sin(np.radians(angle))
                    points = points.copy()
                    points[:, a], points[:, b] = c * points[:, a] - s * points[:, b], s * points[:, a] + c * points[:, b]
        if self.get(node, "move") is not None:
            by, components = self.vector(node, "move")
            if components and components != dim:
                self.error(self.get(node, "move") or node, f"move: expected {dim} components")
            points = points + np.array(by)
        return replace(shape, points=points)
