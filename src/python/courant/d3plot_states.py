"""States of a d3plot family as those of field files: `courant.open(DIR).states` of a folder that has no others, of Courant or LS-DYNA."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from .d3plot import D3plotFault, D3plotFile
from .diagnostics import CourantError, Diagnostics
from .fields import FieldArray, StateFiles
from .post.view_fields import mises
from .results import Mesh, Results, RunState, States

_UNITS = {"velocity": "L/T", "acceleration": "L/T2", "displacement": "L", "stress": "M/LT2", "von_mises": "M/LT2", "pressure": "M/LT2", "density": "M/L3"}
_UNITS |= {"mass": "M", "smoothing_length": "L", "section_thickness": "L", "axial_force": "ML/T2", "plastic_strain": "-"}
_LINE, _TRIANGLE, _QUAD, _TETRA, _HEXAHEDRON = 3, 5, 9, 10, 12


class _Arrays:
    """What Mesh asks of a field file, from arrays in memory: `sections`: arrays by section and name; `cells_of`: corners of each cell."""

    def __init__(self, sections: dict[str, dict[str, np.ndarray]], cells_of: list[np.ndarray]) -> None:
        self.points, self.cells, self._cells = len(sections["Points"]["Points"]), len(cells_of), cells_of
        self._values = {(section, name): np.asarray(values) for section, some in sections.items() for name, values in some.items()}
        self.arrays = {key: FieldArray(v.dtype.str, v.shape[1] if v.ndim > 1 else 1, 0, _UNITS.get(key[1], "?")) for key, v in self._values.items()}

    def has(self, section: str, name: str) -> bool:
        return (section, name) in self.arrays

    def names(self, section: str = "PointData") -> list[str]:
        return [name for where, name in self.arrays if where == section]

    def values(self, section: str, name: str, tuples: int | None = None) -> np.ndarray:
        return self._values[section, name]

    def corners(self) -> tuple[np.ndarray, np.ndarray]:
        if not self._cells:
            return np.empty(0, np.int64), np.empty(0, np.int64)
        return np.concatenate(self._cells), np.cumsum([len(one) for one in self._cells])


class D3plotMesh(Mesh):
    """Particles (`path` ends with .vtp), shells or solids (.vtu) of a state of d3plot. No such file is there."""

    def __init__(self, path: Path, units: Any, arrays: _Arrays) -> None:
        self.path, self._units, self._missing, self._start, self._file = path, units, {}, None, arrays  # type: ignore[assignment]

    def vtk(self) -> Any:
        raise self._error("a state of d3plot has no VTK file", "", "`courant.open(DIR).d3plot` has its arrays; VTK 1 of *COURANT_D3PLOT writes VTK files, too")


def _cell(kind: str, nodes: np.ndarray) -> tuple[int, np.ndarray]:
    """VTK's type and corners: LS-DYNA repeats nodes of tetrahedra and triangles."""
    if kind == "beams":
        return _LINE, nodes
    if kind == "shells":
        return (_TRIANGLE, nodes[:3]) if nodes[2] == nodes[3] else (_QUAD, nodes)
    once = list(dict.fromkeys(nodes.tolist()))
    return (_TETRA, np.array(once)) if len(once) == 4 else (_HEXAHEDRON, nodes)


def _largest(values: np.ndarray) -> np.ndarray:
    """Over layers or points, where there are any; (elements,)."""
    return values if values.ndim == 1 else values.max(axis=1)


def _of_kind(kind: str, found: dict[str, np.ndarray], rigid: np.ndarray) -> dict[str, np.ndarray]:
    """Arrays of elements that all kinds share, NaN of those without."""
    count = len(found["id"])
    nothing = np.full(count, np.nan)
    stress = found.get("stress")
    of_stress = nothing if stress is None else _largest(mises(stress.reshape(-1, 6)).reshape(stress.shape[:-1])).astype(float)
    plastic = _largest(found["plastic_strain"]).astype(float) if "plastic_strain" in found else nothing
    body = np.isin(found["part"], rigid)
    thick = np.where(body, 0.0, np.asarray(found.get("thickness", np.ones(count)), dtype=float))
    out = {"id": found["id"], "part": found["part"], "von_mises": np.where(body, np.nan, of_stress), "plastic_strain": np.where(body, np.nan, plastic)}
    out["axial_force"] = found["axial_force"].astype(float) if kind == "beams" and "axial_force" in found else nothing
    return out | ({"section_thickness": thick} if kind == "shells" else {})


class D3plotRunState(RunState):
    """One state; `d3plot`: its D3plotState."""

    def __init__(self, file: D3plotFile, index: int, run: Results) -> None:
        self.d3plot, self.t, self._run = file.state(index), float(file.times[index]), run
        self._files = self._first = StateFiles(self.t)
        self._units, self._missing, self._start = run.units, {}, None
        first = next((one for one in (self._particle_mesh, self.shells, self.solids) if one is not None), None)
        if first is None:
            raise self._fault("it has neither elements nor particles")
        self.path, self._file = first.path, first._file

    def _fault(self, why: str) -> CourantError:
        diagnostics = Diagnostics()
        diagnostics.error(self.d3plot.file.path, f"it cannot be read: {why}")
        return CourantError(diagnostics)

    def _name(self, kind: str) -> Path:
        return self.d3plot.file.path.with_name(f"d3plot_{kind}_{self.d3plot.index:04d}.{'vtp' if kind == 'particles' else 'vtu'}")

    @cached_property
    def _nodes(self) -> dict[str, np.ndarray]:
        try:
            return self.d3plot.nodes
        except D3plotFault as fault:
            raise self._fault(str(fault)) from fault

    @cached_property
    def _particle_mesh(self) -> D3plotMesh | None:
        if not len(self.d3plot.file.sph_nodes):
            return None
        try:
            found = self.d3plot.particles()
        except D3plotFault as fault:
            raise self._fault(str(fault)) from fault
        points = found.pop("position")
        found["active"] = found["active"].astype(np.uint8)
        return D3plotMesh(self._name("particles"), self._units, _Arrays({"PointData": found, "Points": {"Points": points}}, []))

    def _elements_of(self, name: str, kinds: tuple[str, ...]) -> D3plotMesh | None:
        file, cells, types, arrays = self.d3plot.file, [], [], []
        rigid = np.asarray(file.part_ids)[np.flatnonzero(file.part_types == 20)] if len(file.part_types) else np.empty(0)
        for kind in kinds:
            if not len(file.corners[kind]):
                continue
            try:
                found = self.d3plot.elements(kind)
            except D3plotFault as fault:
                raise self._fault(str(fault)) from fault
            alive = np.flatnonzero(found.get("alive", np.ones(len(found["id"]), dtype=bool)))
            made = [_cell(kind, file.corners[kind][k]) for k in alive]
            types += [one for one, _ in made]
            cells += [corners for _, corners in made]
            arrays.append({key: values[alive] for key, values in _of_kind(kind, found, rigid).items()})
        if not cells:
            return None
        data = {key: np.concatenate([one[key] for one in arrays]) for key in arrays[0] if all(key in one for one in arrays)}
        nodes = {key: values for key, values in self._nodes.items() if key != "position"}
        if (at := self._nodes.get("position")) is None:
            raise self._fault("its states have no positions of nodes")
        sections = {"PointData": nodes, "CellData": data, "Points": {"Points": at}, "Cells": {"types": np.array(types, np.uint8)}}
        return D3plotMesh(self._name(name), self._units, _Arrays(sections, cells))

    @cached_property
    def solids(self) -> Mesh | None:  # type: ignore[override]
        return self._elements_of("solids", ("solids", "tshells", "beams"))

    @cached_property
    def shells(self) -> Mesh | None:  # type: ignore[override]
        return self._elements_of("shells", ("shells",)) or self.solids

    @property
    def particles(self) -> Mesh | None:
        return self._particle_mesh

    def vtk(self) -> Any:
        return D3plotMesh.vtk(self)  # type: ignore[arg-type]


class D3plotStates(States):
    """The states of a family in order of time."""

    def __init__(self, file: D3plotFile, run: Results, which: list[int] | None = None) -> None:
        self._d3plot, self._run, self._which = file, run, list(range(len(file))) if which is None else which
        self.times = file.times[self._which]

    def __len__(self) -> int:
        return len(self._which)

    def __getitem__(self, index: int | slice) -> Any:
        if isinstance(index, slice):
            return D3plotStates(self._d3plot, self._run, self._which[index])
        return D3plotRunState(self._d3plot, self._which[index], self._run)
