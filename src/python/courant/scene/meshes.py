"""Meshes of deformable parts: boxes, cylinders, spheres, tubes, plates and lines made here, and those of files and other libraries."""
from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .groups import Cells
from .shapes import Shape

SOLIDS, SHELLS, BEAMS = "solids", "shells", "beams"
# corners of the sides of hexahedra, pyramids and wedges with repeated nodes, and of tetrahedra, seen from outside against the clock
_SIDES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
_SIDES_OF_TETRA = ((0, 2, 1, 1), (0, 1, 3, 3), (1, 2, 3, 3), (2, 0, 3, 3))


@dataclass
class Mesh:
    """`points` (n, 3) [L]; `cells`: numbers of the nodes of each element, (m, 8) of solids, (m, 4) of shells and (m, 2) of beams, with
    repeated nodes of others."""

    points: np.ndarray
    cells: np.ndarray
    name: str = ""
    notes: list[str] = field(default_factory=list)
    name_of_kind: str = ""  # "box", "plate", "file": how it was given
    groups: dict[str, np.ndarray] = field(default_factory=dict)  # numbers of the nodes of named groups

    @property
    def kind(self) -> str:
        return {8: SOLIDS, 4: SHELLS, 2: BEAMS}[self.cells.shape[1]]

    def nodes(self) -> np.ndarray:
        return self.points

    def shells(self) -> np.ndarray:
        return self.cells

    @property
    def low(self) -> np.ndarray:
        return np.asarray(self.points.min(axis=0))

    @property
    def high(self) -> np.ndarray:
        return np.asarray(self.points.max(axis=0))

    @property
    def side(self) -> float:
        """The shortest side of its elements [L]."""
        corners = self.points[self.cells]
        lengths = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
        return float(lengths[lengths > 0].min())

    def _sides(self) -> tuple[np.ndarray, np.ndarray]:
        """All sides of solids, nodes (k, 4) and the element of each (k,)."""
        tetra = self.cells[:, 3] == self.cells[:, 4]
        found = [(self.cells[some][:, side], np.flatnonzero(some)) for some, sides in ((~tetra, _SIDES), (tetra, _SIDES_OF_TETRA)) for side in sides]
        return np.concatenate([nodes for nodes, _ in found]), np.concatenate([owner for _, owner in found])

    def volumes(self) -> np.ndarray:
        """Of solids, (m,) [L3]; < 0 where an element is inside out."""
        nodes, owner = self._sides()
        p = self.points[nodes] - self.points[self.cells[owner, 0]][:, None]
        centre = p.mean(axis=1)
        part = sum(np.einsum("ij,ij->i", centre, np.cross(p[:, k], p[:, (k + 1) % 4])) for k in range(4)) / 6
        return np.bincount(owner, weights=part, minlength=len(self.cells))

    def outer_faces(self) -> np.ndarray:
        """Triangles of the surface of solids, normals outwards, (k, 3)."""
        nodes, _ = self._sides()
        sorted_nodes = np.sort(nodes, axis=1)
        for row in sorted_nodes:  # the same side of two elements may repeat another node
            distinct = np.unique(row)
            row[:] = np.append(distinct, [-1] * (4 - len(distinct)))
        _, first, count = np.unique(sorted_nodes, axis=0, return_index=True, return_counts=True)
        return _triangles(nodes[first[count == 1]])

    def surface(self) -> Shape:
        """Of solids their outer faces; of shells their middle."""
        return Shape(self.points, self.outer_faces() if self.kind == SOLIDS else _triangles(self.cells), 3)


def _triangles(sides: np.ndarray) -> np.ndarray:
    """Of quadrangles (m, 4), which may have repeated nodes, (k, 3)."""
    triangles = np.concatenate([sides[:, [0, 1, 2]], sides[:, [0, 2, 3]]])
    kept = (triangles[:, 0] != triangles[:, 1]) & (triangles[:, 1] != triangles[:, 2]) & (triangles[:, 2] != triangles[:, 0])
    return triangles[kept]


def divided(length: float, size: float) -> int:
    """So many sides of up to `size`."""
    return max(1, int(np.ceil(length / size - 1e-6)))


def brick(n: tuple[int, int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Nodes (n, 3), in a cube from 0 to 1, and hexahedra (m, 8) of so many cells."""
    i, j, k = np.meshgrid(*(np.arange(count + 1) for count in n), indexing="ij")
    points = np.stack([i.ravel() / n[0], j.ravel() / n[1], k.ravel() / n[2]], axis=1)
    number = np.arange(len(points)).reshape(i.shape)
    a, b = number[:-1, :-1], number[1:, :-1]
    c, d = number[1:, 1:], number[:-1, 1:]
    cells = [one[:, :, :-1].ravel() for one in (a, b, c, d)] + [one[:, :, 1:].ravel() for one in (a, b, c, d)]
    return points, np.stack(cells, axis=1)


def box(low: np.ndarray, high: np.ndarray, sizes: np.ndarray, dim: int) -> Mesh:
    """Hexahedra; in the plane one unit deep, from z = -0.5 to 0.5."""
    if dim == 2:
        low, high, sizes = np.append(low[:2], -0.5), np.append(high[:2], 0.5), np.append(sizes[:2], 1.0)
    n = [divided(float(high[k] - low[k]), float(sizes[k])) for k in range(3)]
    points, cells = brick((n[0], n[1], n[2]))
    return Mesh(low + points * (high - low), cells, "box")


def _disc(unit: np.ndarray) -> np.ndarray:
    """Points (n, 2) of the square from -1 to 1 on the disc of radius 1: rings of the square become circles, rounder farther out."""
    x, y = unit.T
    ring = np.maximum(np.abs(x), np.abs(y))
    radius = np.hypot(x, y)
    round_off = np.where(radius > 0, ring / np.where(radius > 0, radius, 1), 1)
    weight = 0.4 + 0.6 * ring  # of the circle
    return unit * ((1 - weight) * np.sqrt(0.5) + weight * round_off)[:, None]


def _ball(unit: np.ndarray) -> np.ndarray:
    """The same of a cube and a ball."""
    ring = np.abs(unit).max(axis=1)
    radius = np.linalg.norm(unit, axis=1)
    round_off = np.where(radius > 0, ring / np.where(radius > 0, radius, 1), 1)
    weight = 0.4 + 0.6 * ring
    return unit * ((1 - weight) * np.sqrt(1 / 3) + weight * round_off)[:, None]


def _axes(axis: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    along = axis / np.linalg.norm(axis)
    first = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
    first /= np.linalg.norm(first)
    return first, np.cross(along, first), along


def cylinder(base: np.ndarray, top: np.ndarray, radius: float, size: float) -> Mesh:
    """Hexahedra, of the volume of the cylinder."""
    first, second, along = _axes(top - base)
    length = float(np.linalg.norm(top - base))
    across = max(4, divided(2 * radius, size))
    points, cells = brick((across, across, divided(length, size)))
    flat = _disc(2 * points[:, :2] - 1) * radius
    made = Mesh(base + flat[:, :1] * first + flat[:, 1:] * second + (points[:, 2:] * length) * along, cells, "cylinder")
    fit = np.sqrt(np.pi * radius**2 * length / made.volumes().sum())
    flat = flat * fit
    made.points = base + flat[:, :1] * first + flat[:, 1:] * second + (points[:, 2:] * length) * along
    return made


def sphere(centre: np.ndarray, radius: float, size: float) -> Mesh:
    """Hexahedra, of the volume of the sphere."""
    across = max(4, divided(2 * radius, size))
    points, cells = brick((across, across, across))
    unit = Mesh(_ball(2 * points - 1), cells)
    return Mesh(centre + unit.points * radius * (4 / 3 * np.pi / unit.volumes().sum()) ** (1 / 3), cells, "sphere")


def tube(base: np.ndarray, top: np.ndarray, radius: float, size: float) -> Mesh:
    """The side of a cylinder, open at both ends, of shells."""
    first, second, along = _axes(top - base)
    length = float(np.linalg.norm(top - base))
    n, m = max(8, divided(2 * np.pi * radius, size)), divided(length, size)
    angle, height = np.meshgrid(2 * np.pi * np.arange(n) / n, length * np.arange(m + 1) / m, indexing="ij")
    points = base + radius * (np.cos(angle.ravel())[:, None] * first + np.sin(angle.ravel())[:, None] * second) + height.ravel()[:, None] * along
    number = np.arange(n * (m + 1)).reshape(n, m + 1)
    after = np.roll(number, -1, axis=0)
    cells = np.stack([number[:, :-1].ravel(), after[:, :-1].ravel(), after[:, 1:].ravel(), number[:, 1:].ravel()], axis=1)
    return Mesh(points, cells, "tube")


def plate(origin: np.ndarray, edge1: np.ndarray, edge2: np.ndarray, sizes: np.ndarray) -> Mesh:
    n, m = divided(float(np.linalg.norm(edge1)), float(sizes[0])), divided(float(np.linalg.norm(edge2)), float(sizes[1]))
    i, j = np.meshgrid(np.arange(n + 1) / n, np.arange(m + 1) / m, indexing="ij")
    points = origin + i.ravel()[:, None] * edge1 + j.ravel()[:, None] * edge2
    number = np.arange(len(points)).reshape(n + 1, m + 1)
    cells = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    return Mesh(points, np.stack([one.ravel() for one in cells], axis=1), "plate")


def line(points: np.ndarray, size: float) -> Mesh:
    """A polyline (n, 2) of the plane, of shells one unit deep."""
    pieces = [points[:1]]
    for a, b in zip(points[:-1], points[1:]):
        n = divided(float(np.linalg.norm(b - a)), size)
        pieces.append(a + (b - a) * (np.arange(1, n + 1) / n)[:, None])
    xy = np.concatenate(pieces)
    front = np.column_stack([xy, np.full(len(xy), -0.5)])
    back = np.column_stack([xy, np.full(len(xy), 0.5)])
    at = np.arange(len(xy) - 1)
    return Mesh(np.concatenate([front, back]), np.stack([at, at + 1, at + 1 + len(xy), at + len(xy)], axis=1), "line")


# cells of meshio: which corners make a hexahedron or a quadrangle with repeated nodes
_OF_MESHIO = {"hexahedron": (0, 1, 2, 3, 4, 5, 6, 7), "wedge": (0, 1, 4, 3, 2, 2, 5, 5), "pyramid": (0, 1, 2, 3, 4, 4, 4, 4), "tetra": (0, 1, 2, 3, 3, 3, 3, 3)}
_FLAT = {"quad": (0, 1, 2, 3), "triangle": (0, 1, 2, 2)}
_LINES = {"line": (0, 1)}


def of_cells(whole: Cells, group: str = "", lines: bool = False) -> Mesh | None:
    """The solids of a mesh or of one of its groups; where it has none its triangles and quadrangles; or its `lines` alone. None where it has none of them.
    Raises ShapeFault."""
    mesh, groups = whole.of(group), whole.nodes()
    for table in (_LINES,) if lines else (_OF_MESHIO, _FLAT):
        found = [block.data[:, table[block.type]] for block in mesh.cells if block.type in table]
        if found:
            used, numbers = np.unique(np.concatenate(found), return_inverse=True)
            made = Mesh(mesh.points[used], numbers.reshape(-1, len(next(iter(table.values())))), notes=list(mesh.notes))
            made.groups = {name: np.flatnonzero(np.isin(used, nodes)) for name, nodes in groups.items()}
            if made.kind == SOLIDS:
                _turn(made)
            return made
    return None


def with_one_node_a_point(mesh: Mesh) -> Mesh:
    """Shells of a surface, or beams, which may each have vertices of their own; elements that vanish with them, or are there twice, go."""
    tiny = 1e-6 * float(np.max(mesh.high - mesh.low))
    _, first, number = np.unique(np.round((mesh.points - mesh.low) / tiny).astype(np.int64), axis=0, return_index=True, return_inverse=True)
    cells = number.ravel()[mesh.cells]
    kept = np.array([len(set(row)) > min(2, cells.shape[1] - 1) for row in cells.tolist()], dtype=bool)
    _, once = np.unique(np.sort(cells[kept], axis=1), axis=0, return_index=True)
    rows = np.flatnonzero(kept)[np.sort(once)]
    notes = [f"{len(mesh.points) - len(first)} duplicate vertices merged"] if len(first) < len(mesh.points) else []
    notes += [f"{len(cells) - len(rows)} {'faces without area' if cells.shape[1] > 2 else 'lines without length'}, or that are there twice, left out"] if len(rows) < len(cells) else []
    groups = {name: np.unique(number.ravel()[nodes]) for name, nodes in mesh.groups.items()}
    return Mesh(mesh.points[first], cells[rows], mesh.name, [*mesh.notes, *notes], mesh.name_of_kind, groups)


def _turn(mesh: Mesh) -> None:
    """Turns solids that are inside out."""
    wrong = np.flatnonzero(mesh.volumes() < 0)
    if not len(wrong):
        return
    cells = mesh.cells
    tetra, pyramid, wedge = cells[:, 3] == cells[:, 4], cells[:, 4] == cells[:, 6], cells[:, 4] == cells[:, 5]
    for row in wrong:
        order = [0, 2, 1, 3, 4, 5, 6, 7] if tetra[row] else [0, 3, 2, 1, 4, 5, 6, 7] if pyramid[row] else [1, 0, 3, 2, 4, 5, 6, 7] if wedge[row] \
            else [4, 5, 6, 7, 0, 1, 2, 3]
        cells[row] = cells[row, order]
    mesh.notes.append(f"{len(wrong)} elements were inside out, and were turned")
