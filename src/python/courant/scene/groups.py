"""Named groups of the cells of a mesh: physical groups of Gmsh, sets of Abaqus and others, groups and objects of OBJ."""
from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..words import did_you_mean
from .polygons import triangulated
from .shapes import ShapeFault


@dataclass
class Block:
    """Cells of one type, as meshio names it; `data`: numbers of their nodes (m, corners)."""

    type: str
    data: np.ndarray


@dataclass
class Cells:
    """`points` (n, 3) [L]; `groups`: rows of each block by name."""

    points: np.ndarray
    cells: list[Block]
    groups: dict[str, list[np.ndarray]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)

    def of(self, group: str) -> Cells:
        """The cells of a group alone; all where none is named. Raises ShapeFault."""
        if not group:
            return self
        if group not in self.groups:
            raise ShapeFault(f"group: the mesh has no group '{group}'", f"{did_you_mean(group, self.groups)}its groups: {', '.join(self.groups) or 'none'}")
        kept = [k for k, rows in enumerate(self.groups[group]) if len(rows)]
        blocks = [Block(self.cells[k].type, self.cells[k].data[self.groups[group][k]]) for k in kept]
        return Cells(self.points, blocks, {group: [np.arange(len(one.data)) for one in blocks]}, self.notes)

    def nodes(self) -> dict[str, np.ndarray]:
        """Numbers of the nodes of each group."""
        return {name: np.unique(np.concatenate([np.zeros(0, dtype=int), *(block.data[some].ravel() for block, some in zip(self.cells, rows))]))
                for name, rows in self.groups.items()}


_WHOLE = {"line": 2, "triangle": 3, "quad": 4, "tetra": 4, "hexahedron": 8, "wedge": 6, "pyramid": 5}  # elements by their corners


def tidied(mesh: Cells) -> Cells:
    """With elements of first order, by their corners, and with polygons and quadrangles that are not convex as triangles. Raises ShapeFault."""
    blocks, source, notes, higher = list[Block](), list[tuple[int, np.ndarray]](), list(mesh.notes), 0
    for number, block in enumerate(mesh.cells):
        kind, data = block.type.rstrip("0123456789"), block.data
        if kind in _WHOLE and data.shape[1] > _WHOLE[kind]:
            data, higher = data[:, : _WHOLE[kind]], higher + len(data)
        if kind not in (*_WHOLE, "polygon", "vertex") and len(data):
            notes.append(f"{len(data)} cells of type {block.type} left out")
            continue
        if kind not in ("quad", "polygon") or not len(data):
            blocks.append(Block(kind, data))
            source.append((number, np.arange(len(data))))
            continue
        faces = [list(dict.fromkeys(corners)) for corners in data.tolist()]  # a corner may be there twice
        rows = [k for k, corners in enumerate(faces) if len(corners) > 2]
        made, bad = triangulated(mesh.points, [faces[k] for k in rows])
        if bad is not None:
            at = ", ".join(f"{v:.4g}" for v in mesh.points[faces[rows[bad]]].mean(axis=0))
            raise ShapeFault(f"the sides of a quadrangle or polygon cross each other, at ({at})", "repair the mesh in the program that made it")
        split = len(np.unique(made["triangle"][1])) if kind == "quad" else 0
        if len(rows) < len(faces):
            notes.append(f"{len(faces) - len(rows)} faces with less than three corners left out")
        if split:
            notes.append(f"{split} quadrangles that are not convex, or have a corner twice, taken as triangles")
        for name, (corners, owner) in made.items():
            if len(corners):
                blocks.append(Block(name, corners))
                source.append((number, np.array(rows)[owner]))
    if higher:
        notes.append(f"{higher} elements of higher order taken by their corners, with straight sides")
    groups = {name: [np.flatnonzero(np.isin(owner, rows[number])) for number, owner in source] for name, rows in mesh.groups.items()}
    return Cells(mesh.points, blocks, groups, notes)


def cells_of(mesh: Any) -> Cells:
    """A mesh of meshio."""
    points = np.column_stack([np.asarray(mesh.points, dtype=float), np.zeros((len(mesh.points), 3 - np.shape(mesh.points)[1]))])
    blocks = [Block(block.type, np.asarray(block.data, dtype=int)) for block in mesh.cells]
    sets = getattr(mesh, "cell_sets", None) or {}
    groups = {name: [np.asarray([] if rows is None else rows, dtype=int) for rows in of_blocks] for name, of_blocks in sets.items() if not name.startswith("gmsh:")}
    tags = (getattr(mesh, "cell_data", None) or {}).get("gmsh:physical", [])
    for name, value in (getattr(mesh, "field_data", None) or {}).items():
        if name not in groups and np.shape(value) == (2,) and len(tags):  # number and dimension
            groups[name] = [np.flatnonzero(np.asarray(tag) == value[0]) if _dimension(block.type) == value[1] else np.zeros(0, dtype=int)
                            for block, tag in zip(blocks, tags)]
    named = {int(value[0]) for value in (getattr(mesh, "field_data", None) or {}).values() if np.shape(value) == (2,)}
    for number in sorted({int(k) for tag in tags for k in np.unique(tag)} - named - {0}):  # groups without a name
        groups.setdefault(str(number), [np.flatnonzero(np.asarray(tag) == number) for tag in tags])
    return Cells(points, blocks, groups)


def _dimension(kind: str) -> int:
    return 0 if kind == "vertex" else 1 if kind.startswith("line") else 2 if kind.startswith(("triangle", "quad")) else 3


def read_obj(path: Path) -> Cells:
    """Faces of an OBJ with its groups, objects and materials; polygons that are no convex quadrangles as triangles. Raises ValueError, OSError."""
    points: list[list[float]] = []
    faces: list[list[int]] = []
    lines: list[int] = []  # of the faces
    groups: dict[str, list[int]] = {}  # faces by name
    named: dict[str, list[str]] = {}  # by keyword
    for number, line in enumerate(path.read_text(encoding="utf-8", errors="replace").replace("\\\n", " ").splitlines(), 1):
        words = line.split("#")[0].split()
        if not words:
            continue
        if words[0] in ("o", "g", "usemtl"):
            named[words[0]] = words[1:]
        elif words[0] not in ("v", "f"):
            continue
        else:
            try:
                if words[0] == "v":
                    points.append([float(word) for word in words[1:4]])
                    continue
                corners = [int(word.split("/")[0]) for word in words[1:]]
            except ValueError:
                raise ValueError(f"line {number}: expected numbers, got '{line.strip()[:40]}'") from None
            corners = [at - 1 if at > 0 else len(points) + at for at in corners]
            if len(corners) < 3 or not all(0 <= at < len(points) for at in corners):
                raise ValueError(f"line {number}: a face has three vertices or more, of those above it, got '{line.strip()[:40]}'")
            for name in dict.fromkeys(name for names in named.values() for name in names):
                groups.setdefault(name, []).append(len(faces))
            faces.append(corners)
            lines.append(number)
    if any(len(point) != 3 for point in points):
        raise ValueError("a vertex has three numbers")
    x = np.array(points).reshape(-1, 3)
    made, bad = triangulated(x, faces)
    if bad is not None:
        raise ValueError(f"line {lines[bad]}: the sides of a face cross each other")
    blocks = [(kind, *one) for kind, one in made.items() if len(one[0])]
    return Cells(x, [Block(kind, data) for kind, data, _ in blocks],
                 {name: [np.flatnonzero(np.isin(owner, rows)) for _, _, owner in blocks] for name, rows in groups.items()})
