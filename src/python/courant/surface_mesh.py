"""The surface of the water as a mesh: a density of particles on a grid, and its contour, by VTK's own filters."""
from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from .files import OutputError, write_file
from .optional import module

_CELL = 0.7  # of the grid over the smallest spacing of the particles, if no cell is given
_WIDEST = 1.0  # scale of the Gaussian over the spacing: wider ones round corners off, narrower ones show each particle
_CUT = 2.75  # scales
_MOST_CELLS = 200_000_000  # of the grid: a typing error in a cell does not fill the memory


class NoSurface(ValueError):
    """There is no water, or the grid would be too large; the text says why."""


@dataclass
class SurfaceMesh:
    """`points`: (n, 3) [L]; `cells`: (m, 3) triangles turned outwards in space, (m, 2) segments in the plane, with the water on their left. `values`:
    fields at the points by name."""

    points: np.ndarray
    cells: np.ndarray
    values: dict[str, np.ndarray]
    t: float = 0.0

    @property
    def dim(self) -> int:
        return 2 if self.cells.shape[1] == 2 else 3

    def volume(self) -> float:
        """Inside the surface [L3]; in the plane the area [L2]."""
        corner = self.points[self.cells]
        if self.dim == 2:
            a, b = corner[:, 0], corner[:, 1]
            return 0.5 * float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum())
        return float(np.einsum("ij,ij->i", corner[:, 0], np.cross(corner[:, 1], corner[:, 2])).sum()) / 6

    def size(self) -> float:
        """Area of the surface [L2]; in the plane its length [L]."""
        corner = self.points[self.cells]
        across = corner[:, 1] - corner[:, 0]
        if self.dim == 3:
            across = 0.5 * np.cross(across, corner[:, 2] - corner[:, 0])
        return float(np.sqrt((across**2).sum(axis=1)).sum())

    def vtk(self) -> Any:
        """A vtkPolyData with the values at its points. Raises MissingModule."""
        support, model, core = module("vtkmodules.util.numpy_support"), module("vtkmodules.vtkCommonDataModel"), module("vtkmodules.vtkCommonCore")
        out, points, cells = model.vtkPolyData(), core.vtkPoints(), model.vtkCellArray()
        points.SetData(support.numpy_to_vtk(self.points, deep=True))
        each = self.cells.shape[1]
        table = np.column_stack([np.full(len(self.cells), each), self.cells]).astype(np.int64)
        cells.ImportLegacyFormat(support.numpy_to_vtkIdTypeArray(table.ravel(), deep=True))
        out.SetPoints(points)
        (out.SetLines if each == 2 else out.SetPolys)(cells)
        for name, values in self.values.items():
            array = support.numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True)
            array.SetName(name)
            out.GetPointData().AddArray(array)
        time = support.numpy_to_vtk(np.array([self.t]), deep=True)
        time.SetName("TimeValue")
        out.GetFieldData().AddArray(time)
        return out

    def pyvista(self) -> Any:
        """A pyvista.PolyData. Raises MissingModule."""
        return module("pyvista").wrap(self.vtk())

    def write(self, file: str | PathLike[str]) -> None:
        """A .vtp file. Raises MissingModule, OutputError."""
        writer = module("vtkmodules.vtkIOXML").vtkXMLPolyDataWriter()
        writer.SetInputData(self.vtk())
        writer.WriteToOutputStringOn()
        if not writer.Write():
            raise OutputError(Path(file), OSError("VTK's writer failed"))
        write_file(Path(file), writer.GetOutputString().encode())


def surface_mesh(x: np.ndarray, volume: np.ndarray, h: np.ndarray, dim: int, *, cell: float | None = None, level: float = 0.5, width: float = 0.75,
                 values: dict[str, np.ndarray] | None = None, t: float = 0.0) -> SurfaceMesh:
    """Where sum V W falls to `level` of what it is inside the water. W is a Gaussian exp(-r^2/s^2) with s = `width` h, at most the spacing V^(1/dim).

    x: (n, 3), volume, h: (n,) [L]; `cell`: of the grid, 0.7 of the smallest spacing if not given; `values`: of the particles, means of which are given at
    the points of the surface. Walls cut the kernel off as the air does: the surface of water at a wall is closed. Raises NoSurface, MissingModule.
    """
    if not len(x):
        raise NoSurface("there is no particle")
    if not 0 < level < 1:
        raise NoSurface(f"the level is {level:g}: it must be between 0 and 1")
    spacing = np.asarray(volume, dtype=float) ** (1 / dim)
    scale = np.minimum(width * h, _WIDEST * spacing)
    cell = _CELL * float(spacing.min()) if cell is None else float(cell)
    if not 0 < cell <= 2 * float(spacing.max()):
        raise NoSurface(f"cells of {cell:g} do not fit particles {float(spacing.max()):g} apart: give a length above 0 and below twice that")
    reach = _CUT * float(scale.max())
    low, high = x.min(axis=0) - reach - cell, x.max(axis=0) + reach + cell
    n = np.ceil((high - low) / cell).astype(int) + 1
    if dim == 2:
        low[2], n[2] = 0.0, 1
    if float(np.prod(n.astype(float))) > _MOST_CELLS:
        raise NoSurface(f"a grid of cells of {cell:g} would have {float(np.prod(n.astype(float))):.3g} points; {_MOST_CELLS:.0e} are the limit: give a larger cell")
    colour, sums = _splatted(x, volume, scale, dim, low, n, cell, values or {})
    inside = float(np.median(colour[colour > 0.9 * np.quantile(colour[colour > 0], 0.95)]))
    points, cells = _contour(colour, n, low, cell, level * min(inside, 1.0), dim)
    return SurfaceMesh(points, cells, {name: _at(points, total, colour, n, low, cell, dim) for name, total in sums.items()}, t)


def _splatted(x: np.ndarray, volume: np.ndarray, scale: np.ndarray, dim: int, low: np.ndarray, n: np.ndarray, cell: float,
              values: dict[str, np.ndarray]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """sum V W and sum V W value on the grid, flat, x fastest. In the order of the particles, so that the bits are the same each time."""
    total = np.zeros(int(np.prod(n)))
    sums = {name: np.zeros((len(total), *one.shape[1:])) for name, one in values.items()}
    most = int(np.ceil(_CUT * float(scale.max()) / cell)) + 1
    at = np.rint((x - low) / cell).astype(int)
    steps = [np.arange(-most, most + 1)] * dim
    factor = volume / (np.sqrt(np.pi) * scale) ** dim
    stride = np.array([1, n[0], n[0] * n[1]])
    for offset in np.stack(np.meshgrid(*steps, indexing="ij"), -1).reshape(-1, dim):
        to = at.copy()
        to[:, :dim] += offset
        r2 = (((low + to * cell - x)[:, :dim] / scale[:, None]) ** 2).sum(axis=1)
        some = np.flatnonzero((r2 < _CUT**2) & (to[:, :dim] >= 0).all(axis=1) & (to[:, :dim] < n[:dim]).all(axis=1))
        if not len(some):
            continue
        w = factor[some] * np.exp(-r2[some])
        index = to[some, :dim] @ stride[:dim]
        total += np.bincount(index, w, len(total))
        for name, one in values.items():
            flat = sums[name].reshape(len(total), -1)
            for c, part in enumerate(one.reshape(len(x), -1)[some].T):
                flat[:, c] += np.bincount(index, w * part, len(total))
    return total, sums


def _contour(colour: np.ndarray, n: np.ndarray, low: np.ndarray, cell: float, level: float, dim: int) -> tuple[np.ndarray, np.ndarray]:
    support, model, filters = module("vtkmodules.util.numpy_support"), module("vtkmodules.vtkCommonDataModel"), module("vtkmodules.vtkFiltersCore")
    image = model.vtkImageData()
    image.SetDimensions(*(int(one) for one in n))
    image.SetOrigin(*(float(one) for one in low))
    image.SetSpacing(cell, cell, cell)
    array = support.numpy_to_vtk(colour, deep=True)
    array.SetName("colour")
    image.GetPointData().SetScalars(array)
    contour = filters.vtkFlyingEdges2D() if dim == 2 else filters.vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, level)
    if dim == 3:
        contour.ComputeNormalsOff()
        contour.ComputeGradientsOff()
    contour.Update()
    out = contour.GetOutput()
    if not out.GetNumberOfPoints():
        raise NoSurface("the water has no surface at this level")
    points = support.vtk_to_numpy(out.GetPoints().GetData()).astype(float)
    each = dim
    cells = support.vtk_to_numpy((out.GetLines() if dim == 2 else out.GetPolys()).GetData()).reshape(-1, each + 1)[:, 1:].astype(int)
    mesh = SurfaceMesh(points, cells, {})
    return (points, cells) if mesh.volume() >= 0 else (points, cells[:, ::-1].copy())


def _at(points: np.ndarray, total: np.ndarray, colour: np.ndarray, n: np.ndarray, low: np.ndarray, cell: float, dim: int) -> np.ndarray:
    """Means of the particles at points of the surface, by linear interpolation of both sums."""
    at = (points - low)[:, :dim] / cell
    first = np.clip(np.floor(at).astype(int), 0, np.maximum(n[:dim] - 2, 0))
    share = at - first
    stride = np.array([1, n[0], n[0] * n[1]])[:dim]
    top, bottom = np.zeros((len(points), *total.shape[1:])), np.zeros(len(points))
    for corner in range(1 << dim):
        bits = np.array([corner >> k & 1 for k in range(dim)])
        w = np.prod(np.where(bits, share, 1 - share), axis=1)
        index = (first + bits) @ stride
        bottom += w * colour[index]
        top += w.reshape(-1, *[1] * (total.ndim - 1)) * total[index]
    return top / bottom.reshape(-1, *[1] * (total.ndim - 1))
