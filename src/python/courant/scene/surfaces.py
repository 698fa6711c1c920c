"""Surfaces from files and from objects of other libraries, made sound: one vertex for each point, normals outwards, closed or refused with the position
of the hole."""
from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..files import note_input
from ..optional import MissingModule, module
from .groups import Cells, tidied
from .mesh_files import MESH_FILES, WITHOUT_GROUPS, check_file, read_cells
from .mesh_objects import cells_of_object, cells_of_vtk
from .outlines import OUTLINES, read_outline
from .shapes import Shape, ShapeFault, faulty_edges, holes, merged, oriented, polyline

KNOWN = (*MESH_FILES, *OUTLINES)
_TOLERANCE = 1e-6  # of the size, within which vertices are the same


def read_shape(path: Path, group: str = "") -> Shape:
    """The surface or polyline of a file, or of one of its groups, as it is. Raises ShapeFault."""
    end = check_file(path, KNOWN, group, (*OUTLINES, *WITHOUT_GROUPS))
    if end in OUTLINES:
        note_input(path)
        try:
            return read_outline(path)
        except ShapeFault:
            raise
        except Exception as fault:
            raise ShapeFault(f"'{path}' cannot be read: {' '.join(str(fault).split())[:200]}") from None
    shape = surface_of(read_cells(path, group).of(group))
    if not len(shape.faces):
        raise ShapeFault(f"'{path}' holds no faces", "is it whole, and of the format that its name tells?")
    return replace(shape, name=path.stem)


def shape_of(thing: Any, group: str = "") -> Shape:
    """The surface of a mesh of PyVista, VTK, meshio or trimesh, of (points, triangles), or of points (n, 2) of a closed polyline; of a mesh of meshio
    also that of one of its groups. Raises ShapeFault."""
    try:
        cells = cells_of_object(thing)
    except MissingModule as fault:
        raise ShapeFault(str(fault)) from None
    if group and (cells is None or not cells.groups):
        raise ShapeFault(f"group: a {type(thing).__name__} has none", "meshes of meshio and models of Gmsh have groups")
    if cells is not None:
        return surface_of(cells.of(group))
    if (xy := polygon_of(thing)) is not None:
        return replace(polyline(xy, closed=len(xy) > 2), name="line")
    raise ShapeFault(f"a {type(thing).__name__} is no surface", "give a file, a mesh of PyVista, VTK, meshio or trimesh, (points, triangles), or points (n, 2)")


def polygon_of(thing: Any) -> np.ndarray | None:
    """Points (n, 2) of a polyline; None for anything else."""
    try:
        xy = np.asarray(thing, dtype=float)
    except (TypeError, ValueError):
        return None
    return xy if xy.ndim == 2 and xy.shape[1] == 2 and len(xy) > 1 else None


def surface_of(mesh: Cells) -> Shape:
    """The outer faces of its solids, whose sides may be there as well; where it has none, its triangles and quadrangles; where it has neither, its lines in
    the plane. Raises ShapeFault."""
    blocks = [(block.type, block.data) for block in mesh.cells]
    faces = _outer([data[:, corners] for kind, data in blocks for corners in _SIDES.get(kind, ())])
    if not len(faces):
        flat = [_fan(data, {"triangle": 3, "quad": 4}[kind]) for kind, data in blocks if kind in ("triangle", "quad")]
        faces = np.concatenate(flat) if flat else faces
    if len(faces):
        return replace(_used(mesh.points, faces, 3), notes=list(mesh.notes))
    lines = [data for kind, data in blocks if kind == "line"]
    if not lines:
        return Shape(np.zeros((0, 3)), np.zeros((0, 3), dtype=int), 3)
    shape = replace(_used(mesh.points, np.concatenate(lines), 2), notes=list(mesh.notes))
    if np.ptp(shape.points[:, 2]) > _TOLERANCE * np.ptp(shape.points, axis=0).max():
        raise ShapeFault("the mesh has lines in space alone, which bound nothing", "a structure with a 'section' takes lines as beams")
    return shape


_SIDES = {"tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
          "hexahedron": ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6), (0, 4, 7, 3), (1, 2, 6, 5)),
          "wedge": ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2)), "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))}


def _fan(faces: np.ndarray, corners: int) -> np.ndarray:
    return np.concatenate([faces[:, [0, k, k + 1]] for k in range(1, corners - 1)])


def _outer(sides: list[np.ndarray]) -> np.ndarray:
    """Triangles of those sides of solids that only one of them has."""
    out = []
    for corners in {side.shape[1] for side in sides}:
        faces = np.concatenate([side for side in sides if side.shape[1] == corners])
        _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
        out.append(_fan(faces[first[count == 1]], corners))
    return np.concatenate(out) if out else np.zeros((0, 3), dtype=int)


def _used(points: np.ndarray, faces: np.ndarray, dim: int) -> Shape:
    used, numbers = np.unique(faces, return_inverse=True)
    return Shape(points[used], numbers.reshape(faces.shape), dim)


def sound(shape: Shape, closed: bool, close: bool) -> Shape:
    """With one vertex for each point; where it must be `closed`, without holes, which are filled where `close` asks for it, and with its normals
    outwards. Raises ShapeFault."""
    if not np.isfinite(shape.points).all():
        raise ShapeFault("the shape has coordinates that are no numbers")
    shape = merged(shape, _TOLERANCE)
    if not len(shape.faces):
        raise ShapeFault("the shape has no faces with an area")
    edges = faulty_edges(shape)
    if len(edges.free) and close:
        shape = _filled(shape)
        edges = faulty_edges(shape)
    if closed and len(edges.free):
        found = holes(shape, edges.free)
        centre, size, count = found[0]
        where = ", ".join(f"{axis} = {v:.4g}" for axis, v in zip("xyz", centre[: shape.dim]))
        what = "a hole" if len(found) == 1 else f"{len(found)} holes, the largest"
        of = f", {size:.3g} across, of {count} edges" if shape.dim == 3 else ""
        raise ShapeFault(f"the {'surface' if shape.dim == 3 else 'line'} is not closed: {what} at {where}{of}", "close: true, in Python close=True, fills holes; open: true takes it as thin" + ("; ground: true takes a terrain as solid below" if shape.dim == 3 else ""))
    if closed and len(edges.crowded):
        a = shape.points[edges.crowded[0]].mean(axis=0)
        where = ", ".join(f"{axis} = {v:.4g}" for axis, v in zip("xyz", a[: shape.dim]))
        raise ShapeFault(f"{len(edges.crowded)} edges have more than two faces, the first at {where}: inside and outside are not clear there",
                         "unite overlapping bodies in the program that made the file")
    if not closed:
        return shape
    shape = oriented(shape)
    size = float(np.prod((shape.high - shape.low)[: shape.dim]))
    if not shape.volume() > 1e-9 * size:
        raise ShapeFault("the closed shape has no volume")
    return shape


def _filled(shape: Shape) -> Shape:
    """With its holes closed: by VTK in space, by one line in the plane."""
    free = faulty_edges(shape).free
    found = holes(shape, free) if shape.dim == 3 else []
    if shape.dim == 2:
        if len(free) != 2:
            raise ShapeFault(f"the line has {len(free)} open ends, which cannot be joined", "give one closed line")
        faces = np.concatenate([shape.faces, [[free[0, 0], free[1, 0]]]])
        return replace(shape, faces=faces, notes=[*shape.notes, "the line closed from its end to its begin"])
    try:
        core, data_model = module("vtkmodules.vtkFiltersModeling"), module("vtkmodules.vtkCommonDataModel")
        support, common = module("vtkmodules.util.numpy_support"), module("vtkmodules.vtkCommonCore")
    except MissingModule as fault:
        raise ShapeFault(str(fault)) from None
    data, points, cells = data_model.vtkPolyData(), common.vtkPoints(), data_model.vtkCellArray()
    points.SetData(support.numpy_to_vtk(np.ascontiguousarray(shape.points), deep=True))
    data.SetPoints(points)
    cells.SetData(3, support.numpy_to_vtkIdTypeArray(np.ascontiguousarray(shape.faces).ravel().astype(np.int64), deep=True))
    data.SetPolys(cells)
    fill = core.vtkFillHolesFilter()
    fill.SetInputData(data)
    fill.SetHoleSize(1e3 * float(np.max(shape.high - shape.low)))
    fill.Update()
    made = merged(surface_of(tidied(cells_of_vtk(fill.GetOutput()))), _TOLERANCE)
    centres = "; ".join("(" + ", ".join(f"{v:.4g}" for v in centre) + f"), {size:.3g} across" for centre, size, _ in found[:3])
    return replace(shape, points=made.points, faces=made.faces, notes=[*shape.notes, f"{len(found)} hole{'s' * (len(found) > 1)} closed: {centres}"])


__all__ = ["KNOWN", "ShapeFault", "read_shape", "shape_of", "sound"]
