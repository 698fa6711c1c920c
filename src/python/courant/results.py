"""The results of a run as numpy, pandas, xarray, VTK and PyVista know them.

import courant

run = courant.open("jump")
run.energies["kinetic"]                     # numpy, (rows,); run.energies.units["kinetic"]
run.contacts[1].to_pandas()
run.histories["parts/2/momentum"]           # numpy, (rows, 3)
run.ascii["glstat"].plot("kinetic_energy")
state = run.states[-1]
state["velocity"], state.points, state.shells["contact_force"]
state.pyvista().plot(scalars="pressure")
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any, NoReturn, overload

import numpy as np

from .ascii_histories import ASCII_NAMES, AsciiFile
from .ascii_kinds import column_name
from .binout import BinoutFault, BinoutFile, binout_files
from .d3plot import D3plotFault, D3plotFile
from .diagnostics import CourantError, Diagnostics
from .fields import FieldFault, FieldFile, StateFiles, find_ids, read_states
from .files import write_figure
from .histories import HistoryFile
from .optional import module
from .summary_file import read_summary
from .surface_mesh import NoSurface, SurfaceMesh, surface_mesh
from .tables import Table, table_of
from .units import MODEL_UNITS, Dimension, Units, units_of_summary
from .words import Named


def open(folder: str | PathLike[str], units: Units | None = None) -> Results:  # noqa: A001  as gzip.open
    """The results that `courant run -o DIR` wrote, or a folder of LS-DYNA's ASCII histories.

    Files are read when they are asked for. `units`: what the deck's units are called; if not given, those that its numbers look like as the run found,
    or "model units". Raises CourantError where the folder is missing.
    """
    return Results(folder, units)


def _raised(diagnostics: Diagnostics) -> None:
    if not diagnostics.ok:
        raise CourantError(diagnostics)


def _raised_of(file: Path, message: str, fault: Exception) -> NoReturn:
    diagnostics = Diagnostics()
    diagnostics.error(file, message)
    raise CourantError(diagnostics) from fault


class Mesh:
    """Particles or shells of one state, from a .vtp or .vtu file. Raises CourantError where it is damaged."""

    def __init__(self, path: Path, units: Units, missing: Mapping[str, float] | None = None, start: Path | None = None) -> None:
        """`start`: the file of the first state, from which displacements count."""
        self.path, self._units, self._missing, self._start = path, units, missing or {}, start
        try:
            self._file = FieldFile(path)
        except FieldFault as fault:
            raise self._error(str(fault)) from fault

    def _error(self, why: str, what: str = "not a field file of `courant run`: ", hint: str = "it may be truncated; run the deck again") -> CourantError:
        diagnostics = Diagnostics()
        diagnostics.error(self.path, what + why, hint)
        return CourantError(diagnostics)

    def _values(self, section: str, name: str) -> np.ndarray:
        try:
            return self._file.values(section, name, self._file.points if section in ("PointData", "Points") else self._file.cells)
        except FieldFault as fault:
            raise self._error(str(fault)) from fault
        except KeyError as fault:
            raise self._error(f"it has no array '{name}' in <{section}>") from fault

    @property
    def names(self) -> list[str]:
        """Names of the arrays, of points first, then of cells."""
        return [*self._file.names("PointData"), *self._file.names("CellData")]

    def __contains__(self, name: object) -> bool:
        return name in self.names or name in self._missing or (name == "displacement" and self.has_displacement)

    @property
    def has_displacement(self) -> bool:
        """Whether displacements can be made: points have numbers, and the first state is there."""
        return self._start is not None and self._file.has("PointData", "id") and "displacement" not in self.names

    @cached_property
    def _displacement(self) -> np.ndarray:
        """Since the first state, (points, 3) [L]; NaN of points that it has not."""
        assert self._start is not None
        first = self if self._start == self.path else Mesh(self._start, self._units)
        at, same = find_ids(np.asarray(self["id"]), np.asarray(first["id"]))
        out = np.full((len(at), 3), np.nan)
        out[same] = self.points[same] - first.points[at[same]]
        return out

    def __getitem__(self, name: str) -> np.ndarray:
        """An array, (points or cells,) or (points or cells, components); "speed" is the length of "velocity", "displacement" counts from the first
        state. Raises KeyError with the names that there are."""
        if name == "displacement" and self.has_displacement:
            return self._displacement
        if name == "speed" and name not in self.names:
            return np.sqrt((self["velocity"].astype(float) ** 2).sum(axis=1))
        for section in ("PointData", "CellData"):
            if self._file.has(section, name):
                return self._values(section, name)
        if name in self._missing:
            return np.full(len(self), self._missing[name])
        raise KeyError(f"{self.path} has no array '{name}'; it has {', '.join(self.names)}")

    def __len__(self) -> int:
        """How many points there are."""
        return self._file.points

    def unit(self, name: str) -> str:
        """ "m/s"; "?" where the file does not tell."""
        name = "velocity" if name == "speed" and name not in self.names else name
        if name == "displacement" and self.has_displacement:
            return self._units.of(Dimension(L=1))
        array = self._file.arrays.get(("PointData", name)) or self._file.arrays.get(("CellData", name))
        return "?" if array is None else self._units.of_text(array.dimension)

    @property
    def units(self) -> dict[str, str]:
        return {name: self.unit(name) for name in self.names}

    @cached_property
    def points(self) -> np.ndarray:
        """Positions, (points, 3) [L]."""
        return self._values("Points", "Points").astype(float)

    @cached_property
    def cells(self) -> list[np.ndarray]:
        """Indices of the points of each cell; none of particles."""
        if self._file.cells == 0:
            return []
        try:
            corners, ends = self._file.corners()
        except FieldFault as fault:
            raise self._error(str(fault)) from fault
        return np.split(corners, ends[:-1])

    def vtk(self) -> Any:
        """A vtkPolyData or vtkUnstructuredGrid, of whatever vtk module is there: Debian's python3-vtk9, ParaView's own, or PyPI's wheel.

        Raises MissingModule, and CourantError where the file is damaged, as VTK's own reader would crash, or where that reader gives nothing.
        """
        for section, name in self._file.arrays:
            if section in ("PointData", "Points", "CellData"):
                self._values(section, name)
        io = module("vtkmodules.vtkIOXML")
        reader = io.vtkXMLPolyDataReader() if self.path.suffix == ".vtp" else io.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(self.path))
        reader.Update()
        if reader.GetOutput().GetNumberOfPoints() != self._file.points:
            hint = "that of Debian 12's ParaView reads no raw data beside libexpat1 2.5.0-1+deb12u2 and later; python3-vtk9 does"
            raise self._error("this VTK does not read it", "", hint)
        return reader.GetOutput()

    def pyvista(self) -> Any:
        """A pyvista.PolyData or pyvista.UnstructuredGrid. Raises MissingModule and CourantError."""
        return module("pyvista").wrap(self.vtk())

    def to_pandas(self) -> Any:
        """A pandas.DataFrame of the points: x, y, z and the arrays of points, "velocity.x" of vectors. Raises MissingModule."""
        columns = {axis: self.points[:, a] for a, axis in enumerate("xyz")}
        for name in self._file.names("PointData"):
            values = self[name]
            parts = {name: values} if values.ndim == 1 else {f"{name}.{'xyz'[a] if a < 3 else a}": part for a, part in enumerate(values.T)}
            columns |= parts
        return module("pandas").DataFrame(columns)


class RunState(Mesh):
    """One state at a time t [T]: its particles or, where it has none, its shells, which are `shells` in any case."""

    def __init__(self, files: StateFiles, run: Results, first: StateFiles | None = None) -> None:
        path = files.particles or files.shells
        assert path is not None  # fields.pvd names one of them
        self.t, self._files, self._run, self._first = files.t, files, run, first or files
        super().__init__(path, run.units, run.missing if files.particles else None, self._first.particles if files.particles else self._first.shells)

    @cached_property
    def shells(self) -> Mesh | None:
        """Shells, solids and other cells."""
        return Mesh(self._files.shells, self._units, start=self._first.shells) if self._files.shells else None

    @cached_property
    def solids(self) -> Mesh | None:
        """Solids, which are `shells`, too, where a run has no shells."""
        return Mesh(self._files.solids, self._units, start=self._first.solids) if self._files.solids else None

    @property
    def particles(self) -> Mesh | None:
        """The state itself, where it has particles."""
        return self if self._files.particles else None

    @property
    def elements(self) -> list[Mesh]:
        """Shells and solids, each file once."""
        found = {mesh.path: mesh for mesh in (self.shells, self.solids) if mesh is not None}
        return list(found.values())

    def surface_mesh(self, values: Sequence[str] = (), where: np.ndarray | None = None, *, cell: float | None = None, level: float = 0.5) -> SurfaceMesh:
        """The surface of the water: triangles in space, lines in the plane. `values`: arrays whose means it gets at its points; `where`: (particles,) of
        bool, which of them are water; `cell` of the grid [L]; `level`: share of the water at the surface. Raises NoSurface, MissingModule, KeyError."""
        if self.particles is None:
            raise NoSurface("the state has no particles")
        V, dim = self["mass"] / self["density"], 2 if np.ptp(self.points[:, 2]) == 0 else 3
        some = np.ones(len(self), dtype=bool) if "active" not in self.names else self["active"] > 0
        some &= True if where is None else np.asarray(where, dtype=bool)
        given = {name: np.asarray(self[name], dtype=float)[some] for name in values}
        x = self.points[some]
        x[:, 2] *= dim == 3
        return surface_mesh(x, V[some].astype(float), self["smoothing_length"][some].astype(float), dim, cell=cell, level=level, values=given, t=self.t)

    def plot(self, field: str = "", file: str | Path | None = None, **keys: Any) -> Any:
        """A picture of the state by a field: plane flows filled, scenes in space rendered. `keys`: as of Results.plot. Gives matplotlib's figure, and
        writes it to `file`. Raises MissingModule, KeyError with the names there are."""
        return self._run.plot(field=field, t=self.t, file=file, **keys)

    def show(self, field: str = "speed", file: str | Path | None = None) -> Any:
        """A window of PyVista that turns with the mouse, see courant.window.show. Raises MissingModule, KeyError with the names there are."""
        from .window import show

        return show(self, field, file)


class States(Sequence[RunState]):
    """The states of a run in order of time; each is read when it is asked for."""

    def __init__(self, files: list[StateFiles], run: Results, first: StateFiles | None = None) -> None:
        self._files, self._run, self._first = files, run, first or (files[0] if files else None)
        self.times = np.array([one.t for one in files])

    def __len__(self) -> int:
        return len(self._files)

    @overload
    def __getitem__(self, index: int) -> RunState: ...
    @overload
    def __getitem__(self, index: slice) -> States: ...
    def __getitem__(self, index: int | slice) -> RunState | States:
        if isinstance(index, slice):
            return States(self._files[index], self._run, self._first)
        return RunState(self._files[index], self._run, self._first)

    def at(self, t: float) -> RunState:
        """The state nearest to a time [T]."""
        return self[int(np.argmin(np.abs(self.times - t)))]


class Histories(Mapping[str, np.ndarray]):
    """The datasets of history.h5 by path, "contacts/1/force": (rows,) or (rows, 3)."""

    def __init__(self, file: HistoryFile, units: Units) -> None:
        self._file, self._units = file, units

    @property
    def t(self) -> np.ndarray:
        """Times of the rows, (rows,) [T]."""
        return self._file.times

    def __getitem__(self, path: str) -> np.ndarray:
        values = self._file.values("/" + path.lstrip("/"))
        if values is None:
            raise KeyError(f"history.h5 has no dataset '{path}'; it has {', '.join(self)}")
        return values[:, 0] if values.shape[1] == 1 else values

    def __iter__(self) -> Iterator[str]:
        return (name[1:] for name in self._file.names)

    def __len__(self) -> int:
        return len(self._file.names)

    def unit(self, path: str) -> str:
        return self._units.of_text(self._file.dimension("/" + path.lstrip("/")))

    def t_of(self, path: str) -> np.ndarray:
        """Times of the rows of a dataset or group: those of a gauge are its own. (rows,) [T]"""
        return self._file.times_of(path)

    @property
    def groups(self) -> list[str]:
        """ "global", "contacts/1", "parts/2", ..."""
        return list(dict.fromkeys(path.rpartition("/")[0] for path in self))

    def table(self, group: str) -> Table:
        """The datasets of a group over time; vectors as "force.x", "force.y", "force.z". Raises KeyError with the groups there are."""
        paths = [path for path in self if path.rpartition("/")[0] == group]
        if not paths:
            raise KeyError(f"history.h5 has no group '{group}'; it has {', '.join(self.groups)}")
        columns = [("t", self._units.of(Dimension(T=1)), self._file.times_of(group))]
        for path in paths:
            name, values = path.rpartition("/")[2], self[path]
            axes = "xyz" if values.ndim == 1 or values.shape[1] == 3 else ("xx", "yy", "zz", "xy", "yz", "zx")
            parts = [(name, values)] if values.ndim == 1 else [(f"{name}.{axis}", values[:, a]) for a, axis in enumerate(axes)]
            columns += [(part, self.unit(path), one) for part, one in parts if name != "time"]
        return table_of(group, columns)

    def to_pandas(self, group: str = "global") -> Any:
        return self.table(group).to_pandas()

    def to_xarray(self, group: str = "global") -> Any:
        return self.table(group).to_xarray()


class AsciiTables(Mapping[str, Table]):
    """The ASCII histories of a folder by name, "glstat"; columns are called kinetic_energy, x_1_SURFB."""

    def __init__(self, folder: Path, units: Units) -> None:
        self._folder, self._units = folder, units

    def __getitem__(self, name: str) -> Table:
        if name not in list(self):
            raise KeyError(f"{self._folder} has no history '{name}'; it has {', '.join(self)}")
        diagnostics = Diagnostics()
        file = AsciiFile.open(self._folder / name, diagnostics)
        if file is None:
            raise CourantError(diagnostics)
        series = [(column_name(key), self._units.of_text(file.dimension(key)), values) for key, values in file.columns.items()]
        return table_of(name, [("t", self._units.of(Dimension(T=1)), file.times), *series])

    def __iter__(self) -> Iterator[str]:
        return (name for name in ASCII_NAMES if (self._folder / name).is_file())

    def __len__(self) -> int:
        return len(list(iter(self)))


class Results:
    """The results in a folder. What a run did not write raises CourantError when it is asked for."""

    def __init__(self, folder: str | PathLike[str], units: Units | None = None, missing: Mapping[str, float] | None = None) -> None:
        """`missing`: numbers for arrays of particles that the field files may lack, {"density": 1000}."""
        self.folder, self.missing = Path(folder), missing or {}
        if not self.folder.is_dir():
            diagnostics = Diagnostics()
            diagnostics.error(self.folder, "no such folder", "DIR must be the folder that `courant run -o DIR` wrote")
            raise CourantError(diagnostics)
        self.units = units or self._found_units()
        self.ascii = AsciiTables(self.folder, self.units)

    def _found_units(self) -> Units:
        try:
            units = units_of_summary(self.summary)
        except CourantError:  # reported where the summary is asked for
            return MODEL_UNITS
        if not self.summary:
            del self.summary  # the run goes on
        return units

    def __repr__(self) -> str:
        return f"<courant.Results {self.folder}>"

    @cached_property
    def histories(self) -> Histories:
        diagnostics = Diagnostics()
        file = HistoryFile.open(self.folder / "history.h5", diagnostics)
        if file is None:
            raise CourantError(diagnostics)
        return Histories(file, self.units)

    @cached_property
    def states(self) -> States:
        """Those of the field files; of a folder without them, those of its d3plot."""
        diagnostics = Diagnostics()
        files = read_states(self.folder, diagnostics, with_particles=False)
        if not files and any(self.folder.glob("d3plot*")):
            from .d3plot_states import D3plotStates

            if len(self.d3plot):
                return D3plotStates(self.d3plot, self)
        _raised(diagnostics)
        return States(files, self)

    @cached_property
    def d3plot(self) -> D3plotFile:
        """The d3plot family of the folder, of Courant or LS-DYNA: `len(d3plot)`, `d3plot.times`, `d3plot.state(-1).nodes["position"]`.
        What its family lacks is a warning on standard error, and in `d3plot.warnings`."""
        file = self._read(self.folder / "d3plot", D3plotFile, "no d3plot here", "`courant run --d3plot` writes one")
        sys.stderr.write("".join(f"{self.folder / 'd3plot'}: warning: {one}\n" for one in file.warnings))
        return file

    @cached_property
    def binout(self) -> BinoutFile:
        """The binout of the folder, of Courant or LS-DYNA, by path: `binout["nodout/x_displacement"]`."""
        files = binout_files(self.folder) or [self.folder / "binout0000"]
        return self._read(files[0], lambda _: BinoutFile(*files), "no binout here", "BINARY 2 or 3 of *DATABASE cards asks for one")

    def _read(self, file: Path, read: Callable[[Path], Any], missing: str, hint: str) -> Any:
        diagnostics = Diagnostics()
        try:
            if file.is_file() or any(self.folder.glob(f"{file.name}[0-9][0-9]")):  # of a family without its first file the reader says why
                return read(file)
            diagnostics.error(file, missing, hint)
        except (D3plotFault, BinoutFault) as fault:
            diagnostics.error(file, f"it cannot be read: {fault}")
        except (OSError, ValueError, OverflowError, MemoryError) as fault:
            diagnostics.error(file, f"it cannot be read: {' '.join(str(fault).split())}")
        raise CourantError(diagnostics)

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.yaml: how the run ended, its steps, energies and warnings; empty while it goes on."""
        file = self.folder / "summary.yaml"
        if not file.is_file():
            return {}
        return read_summary(file)

    @property
    def verdict(self) -> str:
        """ "sound", "doubtful" or "broken"; "" where the run did not come so far."""
        return str(self.summary.get("verdict", ""))

    @property
    def verdict_reasons(self) -> list[str]:
        return [str(reason) for reason in self.summary.get("verdict_reasons") or []]

    @property
    def energies(self) -> Table:
        """The energy ledger over time: what has the unit of the total energy."""
        table, file = self.histories.table("global"), self.histories._file
        of_energy = [column for column in table.columns if column.name == "t" or file.dimension(f"/global/{column.name}") == file.dimension("/global/total")]
        return Table("energies", of_energy)

    @cached_property
    def contacts(self) -> dict[int, Table]:
        """Force on the particles or nodes, and energies, of each contact over time, by its id."""
        groups = [group for group in self.histories.groups if re.fullmatch(r"contacts/\d+", group)]
        return Named("contact", {int(group.partition("/")[2]): self.histories.table(group) for group in sorted(groups, key=lambda g: int(g[9:]))})

    def wall_force(self, *ids: int) -> Table:
        """Total force that contacts exert on their walls over time: of those with these ids (0 are the mirrors), or of all. In a scene with bodies, whose
        contact with walls is 2, `wall_force(0, 1)` is the force of the water on walls and bodies. `force.x` is the value of one moment; `mean.x` that over
        the interval before it and `impulse.x` [ML/T] that so far are integrals over all steps, and miss no impact. Raises KeyError with the ids there are."""
        chosen = ids or tuple(self.contacts)
        for one in chosen:
            if one not in self.contacts and one != 0:
                raise KeyError(f"the run has no contact {one}; it has {', '.join(map(str, self.contacts))}")
        some = [self.contacts[one] for one in chosen if one in self.contacts]
        if not some:
            raise KeyError("the run has no contacts")
        t = some[0]["t"]
        columns = [(name, some[0].units[name], -np.sum([one[name] for one in some], axis=0)) for name in ("force.x", "force.y", "force.z")]
        for axis, (_, unit, force) in zip("xyz", list(columns)):
            if all(f"impulse.{axis}" in one for one in some):  # runs of earlier versions have none
                impulse = -np.sum([one[f"impulse.{axis}"] for one in some], axis=0)
                mean = np.append(force[:1], np.diff(impulse) / np.maximum(np.diff(t), 1e-300))
                columns += [(f"mean.{axis}", unit, mean), (f"impulse.{axis}", some[0].units[f"impulse.{axis}"], impulse)]
        return table_of("wall force", [("t", some[0].units["t"], t), *columns])

    @cached_property
    def gauges(self) -> dict[str, Table]:
        """What each gauge measured over its own times, by the gauge's name; empty where a run has no gauges."""
        names = [group.partition("/")[2] for group in self.histories.groups if group.startswith("gauges/")]
        return Named("gauge", {name: self.histories.table(f"gauges/{name}") for name in names})

    def track(self, point: Sequence[float]) -> Table:
        """Motion over time of the node with a history that is nearest to a point at the start, in the plane of two components [L]: displacement.x,
        v.x, a.x, x.x and so on. Raises KeyError where no node has one."""
        groups = [group for group in self.histories.groups if re.fullmatch(r"nodes/\d+", group)]
        if not groups:
            raise KeyError("the run has no histories of nodes: track=[point] of a deformable part, or *DATABASE_HISTORY_NODE and *DATABASE_NODOUT")
        first = np.array([self.histories[f"{group}/x"][0] - self.histories[f"{group}/displacement"][0] for group in groups])
        nearest = int(np.argmin(np.linalg.norm((first - [*point, 0.0][:3])[:, : len(point)], axis=1)))
        return self.histories.table(groups[nearest])

    def table(self, name: str) -> Table:
        """ "energies", a group of history.h5 ("contacts/1"), the name of a gauge, or a history ("glstat"): its text, else what binout has of it."""
        if name == "energies":
            return self.energies
        if name not in ASCII_NAMES and name not in self.histories.groups and f"gauges/{name}" in self.histories.groups:
            return self.gauges[name]
        if name not in ASCII_NAMES:
            return self.histories.table(name)
        return self.ascii[name] if name in list(self.ascii) or not binout_files(self.folder) else self.binout_table(name)

    def binout_table(self, name: str) -> Table:
        """A history of binout over time; columns are named as binout and the ids have them: z_displacement_5. Raises KeyError, CourantError."""
        file = self.binout
        try:
            t, series = file.times(name), file.series(name)
            for key, values in series.items():
                if len(values) != len(t):
                    raise BinoutFault(f"'{name}' has {len(t)} times and {len(values)} values of '{key}': the file is damaged, or was cut off")
        except BinoutFault as fault:
            _raised_of(binout_files(self.folder)[0], f"it cannot be read: {fault}", fault)
        return table_of(name, [("t", self.units.of(Dimension(T=1)), t), *((key, self.units.of_text("?"), values) for key, values in series.items())])

    def plot(
        self, what: str = "energies", *names: str, field: str | None = None, t: float | None = None, file: str | Path | None = None, **keys: Any
    ) -> Any:
        """A table, as `table` takes its name, over time; or with `field` or `t` a picture of the state nearest to t, of the last one if not given.

        `field`: of particles, nodes or elements: "speed", "stress.mises". `keys`: others of a view (docs/post.md), as range=(0, 2), up="z",
        azimuth=60. Gives matplotlib's figure, and writes it to `file`. Raises OutputError, MissingModule, KeyError with the names there are.
        """
        if field is None and t is None and not keys:
            return self.table(what).plot(*names, file=file)
        from .post.views import View, draw_view

        made = draw_view(self, View("plot", field or "", times=None if t is None else [t], **keys))
        if file is not None:
            write_figure(made, Path(file), named=True)
        return made
