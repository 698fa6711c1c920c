"""Cells of meshes in memory: of VTK and PyVista, meshio, trimesh, and arrays."""
from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..optional import module
from .groups import Block, Cells, cells_of, tidied
from .shapes import ShapeFault

# types of cells of VTK: name, and the order of the corners where it is another one
_VTK_TYPES: dict[int, tuple[str, tuple[int, ...]]] = {
    1: ("vertex", ()), 3: ("line", ()), 5: ("triangle", ()), 7: ("polygon", ()), 8: ("quad", (0, 1, 3, 2)), 9: ("quad", ()), 10: ("tetra", ()),
    11: ("hexahedron", (0, 1, 3, 2, 4, 5, 7, 6)), 12: ("hexahedron", ()), 13: ("wedge", ()), 14: ("pyramid", ()), 21: ("line3", ()), 22: ("triangle6", ()),
    23: ("quad8", ()), 24: ("tetra10", ()), 25: ("hexahedron20", ()), 26: ("wedge15", ()), 27: ("pyramid13", ()), 28: ("quad9", ()), 29: ("hexahedron27", ())}
_STRIPS = {4: 2, 6: 3}  # lines and strips of triangles, with the corners of each piece
_POINTS = 2  # many in one cell


def cells_of_object(thing: Any) -> Cells | None:
    """Of a mesh of PyVista, VTK, meshio or trimesh, the mesh of a model of Gmsh, or (points (n, 3), triangles or quadrangles (m, 3 or 4)); None for
    anything else. Raises ShapeFault, MissingModule."""
    if isinstance(thing, Cells):
        return thing
    if hasattr(thing, "IsA"):
        return tidied(cells_of_vtk(thing))
    if hasattr(thing, "geometry") and hasattr(thing, "dump"):  # a scene of trimesh
        parts = [one for one in thing.dump() if hasattr(one, "faces")]
        if not parts:
            raise ShapeFault("the scene of trimesh has no meshes")
        starts = np.cumsum([0, *(len(one.vertices) for one in parts)])
        return _of_arrays(np.concatenate([one.vertices for one in parts]), np.concatenate([one.faces + start for one, start in zip(parts, starts)]))
    if hasattr(thing, "vertices") and hasattr(thing, "faces"):
        return _of_arrays(thing.vertices, thing.faces)
    if hasattr(thing, "points") and hasattr(thing, "cells"):
        return tidied(cells_of(thing))
    if isinstance(thing, tuple) and len(thing) == 2 and np.ndim(thing[0]) == 2 and np.ndim(thing[1]) == 2 and np.shape(thing[0])[1] == 3 \
            and np.shape(thing[1])[1] in (3, 4):
        return _of_arrays(*thing)
    return None


def _of_arrays(points: Any, faces: Any) -> Cells:
    faces = np.asarray(faces, dtype=int)
    points = np.asarray(points, dtype=float)
    if len(faces) and not (0 <= faces.min() and faces.max() < len(points)):
        raise ShapeFault(f"the corners of faces are numbers of points from 0 to {len(points) - 1}, and there are {faces.min()} to {faces.max()}")
    return tidied(Cells(points, [Block("triangle" if faces.shape[1] == 3 else "quad", faces)] if len(faces) else []))


def _data_sets(thing: Any) -> Iterator[Any]:
    """Those of a composite, or the one itself."""
    if not thing.IsA("vtkCompositeDataSet"):
        yield thing
        return
    walk = thing.NewIterator()
    walk.InitTraversal()
    while not walk.IsDoneWithTraversal():
        yield walk.GetCurrentDataObject()
        walk.GoToNextItem()


def cells_of_vtk(thing: Any) -> Cells:
    """Of a data set of VTK, or of a composite. Raises ShapeFault, MissingModule."""
    append = module("vtkmodules.vtkFiltersCore").vtkAppendFilter()  # makes unstructured grids of all kinds
    count = 0
    for one in _data_sets(thing):
        if one is not None and one.IsA("vtkDataSet") and one.GetNumberOfCells():
            append.AddInputData(one)
            count += 1
    if not count:
        return Cells(np.zeros((0, 3)), [])
    append.Update()
    grid, to_numpy = append.GetOutput(), module("vtkmodules.util.numpy_support").vtk_to_numpy
    points = np.array(to_numpy(grid.GetPoints().GetData()), dtype=float)
    cells = grid.GetCells()
    corners = np.array(to_numpy(cells.GetConnectivityArray()), dtype=int)
    starts = np.array(to_numpy(cells.GetOffsetsArray()), dtype=int)
    types = np.array([grid.GetCellType(k) for k in range(grid.GetNumberOfCells())])
    sizes = np.diff(starts)
    blocks = []
    for kind in np.unique(types).tolist():
        for size in np.unique(sizes[types == kind]).tolist():
            rows = np.flatnonzero((types == kind) & (sizes == size))
            data = corners[starts[rows][:, None] + np.arange(size)]
            if kind in _STRIPS:
                data = np.concatenate([data[:, k : k + _STRIPS[kind]] for k in range(size - _STRIPS[kind] + 1)])
                blocks.append(Block({2: "line", 3: "triangle"}[_STRIPS[kind]], data))
            elif kind in _VTK_TYPES:
                name, order = _VTK_TYPES[kind]
                blocks.append(Block(name, data[:, order] if order else data))
            elif kind != _POINTS and size:
                raise ShapeFault(f"cells of type {kind} of VTK are not known here", "triangulate() of PyVista makes tetrahedra and triangles of them")
    return Cells(points, blocks)
