"""What a view shows of one state: a field by its name at particles, nodes or elements, and the faces of shells and solids."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..words import did_you_mean
from .gradients import vorticity_of_active

_VECTOR, _TENSOR = ("x", "y", "z"), ("xx", "yy", "zz", "xy", "yz", "zx")
_RESULTANT = ("xx", "yy", "xy")  # of shells, per length of their edge
_RESULTANTS = ("membrane_force", "bending_moment")
_NO_FIELDS = ("id", "part")
_OF_VORTICITY = ("velocity", "mass", "density", "smoothing_length")  # arrays of particles that it is made of
# corners of the faces of VTK's cells, seen from outside against the clock, by the number of corners of a solid
_SOLID_FACES: dict[int, tuple[tuple[int, ...], ...]] = {
    4: ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    6: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    8: ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    10: tuple(tri for a, b, c, ab, bc, ca in ((0, 2, 1, 6, 5, 4), (0, 1, 3, 4, 8, 7), (1, 2, 3, 5, 9, 8), (2, 0, 3, 6, 7, 9))
              for tri in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))),
    20: tuple(face for a, b, c, d, ab, bc, cd, da in ((0, 3, 2, 1, 11, 10, 9, 8), (4, 5, 6, 7, 12, 13, 14, 15), (0, 1, 5, 4, 8, 17, 12, 16),
                                                      (1, 2, 6, 5, 9, 18, 13, 17), (2, 3, 7, 6, 10, 19, 14, 18), (3, 0, 4, 7, 11, 16, 15, 19))
              for face in ((ab, bc, cd, da), (a, ab, da), (b, bc, ab), (c, cd, bc), (d, da, cd))),
}
_SOLID_TYPES = {10: 4, 12: 8, 13: 6, 24: 10, 25: 20}
# VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_QUADRATIC_TETRA, VTK_QUADRATIC_HEXAHEDRON


class UnknownField(KeyError):
    """A field that the results do not have; the message has the names that exist."""

    def __str__(self) -> str:
        return str(self.args[0])


class FieldValues(NamedTuple):
    """`values`: (points,) or (cells,); `unit`: "m/s"; `at`: particles, nodes or elements."""

    name: str
    values: np.ndarray
    unit: str
    at: str


def mises(stress: np.ndarray) -> np.ndarray:
    """The equivalent stress after von Mises of tensors xx yy zz xy yz zx, (n, 6) -> (n,), in their unit."""
    xx, yy, zz, xy, yz, zx = stress.T
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + yz**2 + zx**2))


def _parts(name: str, components: int) -> tuple[str, ...]:
    """What may follow the name of an array and a dot."""
    if components == 6:
        return (*_TENSOR, "mises", "mean")
    if components == 3:
        return _RESULTANT if name in _RESULTANTS else _VECTOR
    return ()


def field_names(mesh: Any) -> list[str]:
    """All names that `field_of` takes: arrays, components of vectors and tensors, "speed"."""
    out: list[str] = []
    for (section, name), array in mesh._file.arrays.items():
        if section not in ("PointData", "CellData") or name in _NO_FIELDS:
            continue
        parts = [f"{name}.{part}" for part in _parts(name, array.components)]
        whole = array.components == 1 or (array.components == 3 and name not in _RESULTANTS)
        out += ["speed"] * (name == "velocity") + [name] * whole + parts
    if mesh.has_displacement:
        out += ["displacement", *(f"displacement.{axis}" for axis in _VECTOR)]
    if _layers_of_mises(mesh):
        out.append("von_mises")
    if _has_vorticity(mesh):
        out += ["vorticity"] + [f"vorticity.{axis}" for axis in _VECTOR if not _is_flat(mesh)]
    return list(dict.fromkeys(out))


def _layers_of_mises(mesh: Any) -> list[str]:
    """Arrays from which the largest von Mises stress of a cell follows, where the file has none: of the layers of shells, else stress tensors."""
    cells = mesh._file.names("CellData")
    if "von_mises" in cells or mesh.path.suffix == ".vtp":
        return []
    return [name for name in cells if name.startswith("von_mises_")] or [name for name in cells if name.partition("_")[0] == "stress"]


def _largest_mises(mesh: Any) -> np.ndarray:
    """(cells,), NaN where no layer has one."""
    some = [np.asarray(mesh[name], dtype=float) for name in _layers_of_mises(mesh)]
    with np.errstate(invalid="ignore"):
        return np.fmax.reduce([mises(one) if one.ndim > 1 else one for one in some])


def _has_vorticity(mesh: Any) -> bool:
    """Whether the vorticity can be made of what the file has, and is not in it."""
    return mesh.path.suffix == ".vtp" and "vorticity" not in mesh.names and all(name in mesh for name in _OF_VORTICITY)


def _is_flat(mesh: Any) -> bool:
    return len(mesh) > 0 and bool((mesh.points[:, 2] == mesh.points[0, 2]).all())


def _vorticity(mesh: Any) -> np.ndarray:
    """Of the active particles, else NaN: (n,) about z in the plane, (n, 3) in space."""
    v, m, rho, h = (mesh[name].astype(float) for name in _OF_VORTICITY)
    active = mesh["active"] > 0 if "active" in mesh else np.ones(len(mesh), dtype=bool)
    with np.errstate(divide="ignore", invalid="ignore"):
        return vorticity_of_active(mesh.points, m / rho, h, v, active)


def field_of(mesh: Any, name: str) -> FieldValues:
    """A field of particles (.vtp), nodes or elements (.vtu) by name, of vectors alone their length. Raises UnknownField."""
    names = field_names(mesh)
    if name not in names:
        whole = [other for other in names if other.startswith(f"{name}.")]
        hint = f"choose a component: {', '.join(whole)}" if whole else f"{did_you_mean(name, names)}it has {', '.join(names)}"
        lacking = [one for one in _OF_VORTICITY if one not in mesh] if name.partition(".")[0] == "vorticity" and mesh.path.suffix == ".vtp" else []
        if lacking:
            hint = f"it is made of {', '.join(_OF_VORTICITY)}, and the file lacks {', '.join(lacking)}: `missing` of a recipe may give density and smoothing_length"
        raise UnknownField(f"{mesh.path} has no field '{name}'; {hint}")
    if name == "von_mises" and (layers := _layers_of_mises(mesh)):
        return FieldValues(name, _largest_mises(mesh), mesh.unit(layers[0]), "elements")
    array, _, part = ("velocity" if name == "speed" else name).partition(".")
    made = array == "vorticity" and _has_vorticity(mesh)
    values = _vorticity(mesh) if made else mesh[array].astype(float)
    if part:
        parts = _parts(array, values.shape[1])
        values = mises(values) if part == "mises" else values[:, :3].mean(axis=1) if part == "mean" else values[:, parts.index(part)]
    elif values.ndim > 1:
        values = np.sqrt((values**2).sum(axis=1))
    at_nodes = ("PointData", array) in mesh._file.arrays or array == "displacement"
    section = "particles" if mesh.path.suffix == ".vtp" else "nodes" if at_nodes else "elements"
    return FieldValues(name, values, mesh._units.per_time if made else mesh.unit(array), section)


@dataclass
class Faces:
    """Faces of shells, and those of solids that no other solid shares. `x`: (points, 3) [L]; `corners`: (faces, 4), of triangles the last
    one twice; `cell`: (faces,) the cell of each; `part`: (faces,); `solid`, `deforms`: (faces,) of bool."""

    x: np.ndarray
    corners: np.ndarray
    cell: np.ndarray
    part: np.ndarray
    solid: np.ndarray
    deforms: np.ndarray

    def __len__(self) -> int:
        return len(self.corners)

    def part_of(self, taken: np.ndarray) -> Faces:
        return Faces(self.x, self.corners[taken], *(one[taken] for one in (self.cell, self.part, self.solid, self.deforms)))

    def normals(self) -> np.ndarray:
        """Unit normals, (faces, 3), 0 of faces without area."""
        a, b, c, d = (self.x[self.corners[:, k]] for k in range(4))
        normal = np.cross(c - a, d - b)
        triangle = self.corners[:, 2] == self.corners[:, 3]
        normal[triangle] = np.cross(b - a, c - a)[triangle]
        length = np.sqrt((normal**2).sum(axis=1, keepdims=True))
        return np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)


def shells_that_deform(mesh: Any) -> np.ndarray:
    """Which cells are shells that deform, (cells,) of bool: the thickness of their section is 0 of rigid ones."""
    name = next((name for name in mesh.names if name.endswith("_thickness")), "")
    return np.asarray(mesh[name]) > 0 if name else np.zeros(len(mesh.cells), dtype=bool)


def faces_of(mesh: Any) -> Faces:
    """The faces of a .vtu file that can be seen: inner faces between solids are left out."""
    cells = mesh.cells
    types = mesh._values("Cells", "types") if cells else np.empty(0, np.uint8)
    corners: list[list[int]] = []
    cell: list[int] = []
    solid: list[bool] = []
    for k, (of, kind) in enumerate(zip(cells, types.tolist(), strict=True)):
        shape = _SOLID_FACES[_SOLID_TYPES[kind]] if kind in _SOLID_TYPES else (tuple(range(len(of))),)
        for face in shape:
            if len(face) > 2:
                at = [int(of[j]) for j in face]
                corners.append(at if len(at) == 4 else [*at[:3], at[2]])
                cell.append(k)
                solid.append(kind in _SOLID_TYPES)
    table, owner, inside = np.array(corners, dtype=int).reshape(-1, 4), np.array(cell, dtype=int), np.array(solid, dtype=bool)
    part = mesh["part"] if "part" in mesh.names else np.zeros(len(cells))
    thick = shells_that_deform(mesh)
    empty = np.empty(0)
    out = Faces(mesh.points, table, owner, np.asarray(part)[owner] if len(owner) else empty, inside, thick[owner] | inside if len(owner) else empty.astype(bool))
    if inside.any():
        _, first, times = np.unique(np.sort(table, axis=1), axis=0, return_inverse=True, return_counts=True)
        out = out.part_of(~inside | (times[first] == 1))
    return out


@dataclass
class Bars:
    """Beams, trusses and springs: `x`: (bars, 2, 3) [L]; `cell`, `part`: (bars,)."""

    x: np.ndarray
    cell: np.ndarray
    part: np.ndarray

    def __len__(self) -> int:
        return len(self.x)


def bars_of(mesh: Any) -> Bars:
    """The cells of two corners of a .vtu file."""
    cells = [(k, of) for k, of in enumerate(mesh.cells) if len(of) == 2 and of[0] != of[1]]
    at = np.array([k for k, _ in cells], dtype=int)
    part = np.asarray(mesh["part"])[at] if "part" in mesh.names else np.zeros(len(at))
    return Bars(mesh.points[np.array([of for _, of in cells], dtype=int).reshape(-1, 2)], at, part)


def joined_faces(some: list[Faces]) -> Faces | None:
    """Faces of several files as one; None of none."""
    some = [one for one in some if len(one)]
    if len(some) < 2:
        return some[0] if some else None
    points = np.cumsum([0, *(len(one.x) for one in some[:-1])])
    corners = np.concatenate([one.corners + begin for one, begin in zip(some, points, strict=True)])
    rest = (np.concatenate([getattr(one, key) for one in some]) for key in ("cell", "part", "solid", "deforms"))
    return Faces(np.concatenate([one.x for one in some]), corners, *rest)


def outlines(faces: Faces, sharp: float = 30.0) -> np.ndarray:
    """Edges of an outline, (edges, 2) indices of points: those of one face alone, or between faces more than `sharp` degrees apart."""
    if len(faces) == 0:
        return np.empty((0, 2), dtype=int)
    sides = np.concatenate([faces.corners[:, [k, (k + 1) % 4]] for k in range(4)])
    face = np.tile(np.arange(len(faces)), 4)
    real = sides[:, 0] != sides[:, 1]
    sides, face = np.sort(sides[real], axis=1), face[real]
    edges, of = np.unique(sides, axis=0, return_inverse=True)
    order = np.argsort(of, kind="stable")
    count = np.bincount(of)
    begin = np.cumsum(count) - count
    normal = faces.normals()
    shown = count != 2
    pairs = np.flatnonzero(count == 2)
    a, b = normal[face[order[begin[pairs]]]], normal[face[order[begin[pairs] + 1]]]
    shown[pairs] = np.abs((a * b).sum(axis=1)) < np.cos(np.radians(sharp))  # shells may be turned in either case
    return edges[shown]


def mirrored(faces: Faces, axis: int) -> Faces:
    """Faces and their mirror image in the plane where the coordinate is 0."""
    triangle = faces.corners[:, 2] == faces.corners[:, 3]
    turned = faces.corners[:, [1, 0, 3, 2]]
    turned[triangle] = faces.corners[triangle][:, [1, 0, 2, 2]]
    both = [np.concatenate((one, one)) for one in (faces.cell, faces.part, faces.solid, faces.deforms)]
    x = faces.x * np.where(np.arange(3) == axis, -1, 1)
    return Faces(np.concatenate((faces.x, x)), np.concatenate((faces.corners, turned + len(faces.x))), *both)
