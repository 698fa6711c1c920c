"""Finds the histories of a run: in history.h5, else in the ASCII files, else in binout."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ..ascii_histories import ASCII_NAMES, AsciiFile
from ..ascii_kinds import AsciiKey
from ..binout import BinoutFault, binout_files
from ..diagnostics import CourantError, Diagnostics
from ..post.view_fields import mises
from ..results import Results
from ..units import MODEL_UNITS
from .kinds import KINDS, Kind, Quantity, Series

_MOST_ROWS = 4000  # of a curve that is drawn
_BINOUT_IDS = {"Forces of supports": "force_ids", "Moments of supports": "moment_ids"}  # in one folder
_NO_CURVES = ("time", "wet", "active", "deleted", "x", "position", "centroid", "area", "neighbours", "h", "E")
_STRESS = tuple(f"sig{{}}{axes}" for axes in ("xx", "yy", "zz", "xy", "yz", "zx"))
_LEGEND = re.compile(r"[ \t]*([0-9]+)[ \t]+(\S.*)")


@dataclass
class Lines:
    """Curves of one picture: (label, (rows,)); `unit_of`: their dimension."""

    label: str
    dimension: str
    curves: list[tuple[str, np.ndarray]]
    vector: bool = False

    @cached_property
    def size(self) -> np.ndarray:
        """The length of a vector, else the largest size of the curves; (rows,), NaN where there is none."""
        table = np.array([values for _, values in self.curves], dtype=float)
        if self.vector:
            return np.sqrt((table**2).sum(axis=0))
        return np.fmax.reduce(np.abs(table))

    @cached_property
    def peak(self) -> float:
        finite = self.size[np.isfinite(self.size)]
        return float(finite.max()) if len(finite) else 0.0


@dataclass
class Entity:
    """A wall, joint, node, ...: `t`: (rows,) [T]; `lines`: its pictures by label."""

    id: str
    title: str
    t: np.ndarray
    lines: dict[str, Lines]

    @property
    def peak(self) -> float:
        """Of its first picture."""
        return next((one.peak for one in self.lines.values()), 0.0)


@dataclass
class Found:
    """What a run has of a kind. `where`: the file, for the reader; `note`: what could not be read, or is empty."""

    kind: Kind
    entities: list[Entity] = field(default_factory=list)
    where: str = ""
    note: str = ""


def _whole(entity: Entity) -> Entity | None:
    """Without pictures that have no number at all; None where none is left."""
    entity.lines = {key: one for key, one in entity.lines.items() if np.isfinite(one.size).any()}
    return entity if entity.lines else None


def _component(values: np.ndarray, component: int | None) -> np.ndarray | None:
    if component is None:
        return values if values.ndim == 1 else None
    return values[:, component] if values.ndim == 2 and component < values.shape[1] else None


def _lines(quantity: Quantity, get: Callable[[Series], np.ndarray | None]) -> Lines | None:
    found = [(series.label, values) for series in quantity.series if (values := get(series)) is not None]
    if not found or (quantity.vector and len(found) < 3):
        return None
    return Lines(quantity.label, quantity.dimension, found, quantity.vector)


def _mean_force(t: np.ndarray, impulse: np.ndarray) -> Lines:
    """Between a row and the one before, which misses no impact."""
    mean = np.diff(impulse, axis=0) / np.maximum(np.diff(t), 1e-300)[:, None]
    return Lines("mean force from row to row", "ML/T2", [(axis, np.append(np.nan, mean[:, k])) for k, axis in enumerate("xyz")], True)


def _spoken(name: str) -> str:
    return name.replace("_", " ").strip()


_OF_GAUGES = {"pressure": "M/LT2", "velocity": "L/T", "density": "M/L3", "level": "L", "force": "ML/T2", "moment": "ML2/T2", "energy": "ML2/T3",
              "volume": "L3/T", "mass": "M/T", "momentum": "ML/T2", "pressure_force": "ML/T2"}  # fmt: skip


def _gauge_of(file: Path) -> Entity:
    """Raises ValueError, OSError."""
    rows = file.read_text(errors="replace").splitlines()
    head = rows[0].split(",") if rows else []
    whole = [row for row in rows[1:] if row.count(",") == len(head) - 1]
    values = np.array([[float(one) for one in row.split(",")] for row in whole]).reshape(len(whole), len(head))
    lines: dict[str, Lines] = {}
    if head[:1] != ["time"]:
        raise ValueError("it is no table of a gauge")
    for k, name in enumerate(head[1:], 1):
        base, _, axis = name.partition(".")
        if base not in _NO_CURVES:
            lines.setdefault(base, Lines(_spoken(base), _OF_GAUGES.get(base, "?"), [])).curves.append((axis or _spoken(base), values[:, k]))
    for one in lines.values():
        one.vector = [axis for axis, _ in one.curves] == ["x", "y", "z"]
    return Entity(file.stem, "", values[:, 0], lines)


def _singular(name: str) -> str:
    """ "driven_bodies" -> "driven body"."""
    return _spoken(name).removesuffix("s").replace("bodie", "body")


class Sources:
    """The files of a run, each opened once; `faults`: those that could not be read."""

    def __init__(self, run: Results) -> None:
        self.run = run
        self.faults: list[str] = []
        self._ascii: dict[str, AsciiFile | None] = {}
        self.notes: dict[str, str] = {}
        self._found: dict[str, Found] = {}

    def _try(self, read: Callable[[], object], file: str) -> object | None:
        try:
            return read()
        except CourantError as fault:
            self.faults.append(str(fault).splitlines()[0])
        except (KeyError, ValueError, OSError, BinoutFault) as fault:
            self.faults.append(f"{self.run.folder / file}: {fault}")
        return None

    @cached_property
    def h5(self):  # type: ignore[no-untyped-def]
        """courant.results.Histories, None where there is none."""
        return self._try(lambda: self.run.histories, "history.h5") if (self.run.folder / "history.h5").is_file() else None

    @cached_property
    def binout(self):  # type: ignore[no-untyped-def]
        return self._try(lambda: self.run.binout, "binout0000") if binout_files(self.run.folder) else None

    def ascii(self, name: str) -> AsciiFile | None:
        """None where it is not there, has no state yet, or is damaged, which `notes` says."""
        if name and name not in self._ascii:
            self._ascii[name] = None
            if name in ASCII_NAMES and (self.run.folder / name).is_file():
                diagnostics = Diagnostics()
                self._ascii[name] = AsciiFile.open(self.run.folder / name, diagnostics)
                if self._ascii[name] is None:
                    said = diagnostics.all[0].message if diagnostics.all else "it cannot be read"
                    self.notes[name] = f"{name} is there, but it has no rows" if "no state" in said else f"{name}: {said}"
        return self._ascii.get(name)

    # history.h5

    @cached_property
    def _names(self) -> dict[str, list[str]]:
        """Data sets of each group of history.h5."""
        out: dict[str, list[str]] = {}
        for path in self.h5:
            group, _, name = path.rpartition("/")
            out.setdefault(group, []).append(name)
        return out

    def _title(self, group: str) -> str:
        try:
            title = self.h5._file._h5[group].attrs.get("title", b"")
        except (KeyError, OSError, RuntimeError):
            return ""
        return (title.decode("utf-8", "replace") if isinstance(title, bytes) else str(title)).strip("\0 ")

    def _of_group(self, kind: Kind | None, group: str) -> Entity | None:
        h5 = self.h5
        names = self._names[group]
        known: dict[str, Lines] = {}
        for quantity in kind.quantities if kind else ():
            if made := _lines(quantity, lambda s: _component(h5[f"{group}/{s.h5}"], s.component) if s.h5 in names else None):
                known[quantity.label] = made
        if kind and kind.file in ("rwforc", "rcforc") and "impulse" in names and len(h5.t_of(group)) > 2:
            known["mean force from row to row"] = _mean_force(h5.t_of(group), h5[f"{group}/impulse"])
        if kind is None or kind.file == "elout" or not kind.quantities:
            known |= self._any_of(group, names, {s.h5 for q in (kind.quantities if kind else ()) for s in q.series})
        number = group.rpartition("/")[2]
        return _whole(Entity(number, self._title(group), np.asarray(h5.t_of(group)), known))

    def _any_of(self, group: str, names: list[str], known: set[str]) -> dict[str, Lines]:
        """Every data set: of stresses that of von Mises, points of a section in one picture."""
        out: dict[str, Lines] = {}
        for name in names:
            values, dimension = self.h5[f"{group}/{name}"], self.h5._file.dimension(f"/{group}/{name}")
            base, _, point = name.partition("_of_point_")
            if name in known or base in _NO_CURVES or not np.issubdtype(values.dtype, np.number):
                continue
            if values.ndim == 2 and values.shape[1] == 3 and not point:
                out[_spoken(name)] = Lines(_spoken(name), dimension, [(axis, values[:, k]) for k, axis in enumerate("xyz")], True)
                continue
            if values.ndim == 2:
                if values.shape[1] != 6:
                    continue
                values, base = mises(values), "von Mises " + base
            label = _spoken(base)
            out.setdefault(label, Lines(label, dimension, [])).curves.append((f"point {point}" if point else label, values))
        return out

    def _of_h5(self, kind: Kind) -> list[Entity]:
        groups = [group for group in self._names if group.partition("/")[0] in kind.groups and "/" in group]
        made = [self._of_group(kind, group) for group in groups]
        if len(kind.groups) > 1:
            for one, group in zip(made, groups, strict=True):
                if one is not None:
                    one.title = f"{_singular(group.partition('/')[0])} {one.id}" + (f": {one.title}" if one.title else "")
        return [one for one in made if one is not None]

    # ASCII

    def legend(self, name: str) -> dict[str, str]:
        """Titles by number from the legend of an ASCII history."""
        try:
            head = (self.run.folder / name).read_bytes()[:65536].decode("latin-1")
        except OSError:
            return {}
        begin, end = head.find("{BEGIN LEGEND}"), head.find("{END LEGEND}")
        rows = head[begin:end].splitlines() if 0 <= begin < end else []
        return {found[1]: found[2].strip() for row in rows if (found := _LEGEND.fullmatch(row.rstrip()))}

    def _of_ascii(self, kind: Kind) -> list[Entity]:
        file = self.ascii(kind.file)
        if file is None:
            return []
        titles, out = self.legend(kind.file), []
        owners: dict[int, dict[tuple[str, str], np.ndarray]] = {}
        for key, values in file.columns.items():
            if key.id is not None:
                owners.setdefault(key.id, {})[key.name, key.side] = values
        for id, mine in owners.items():

            def get(s: Series, mine: dict[tuple[str, str], np.ndarray] = mine) -> np.ndarray | None:
                return next((values for (name, side), values in mine.items() if name == s.ascii and s.ascii and s.side in ("", side)), None)

            known = {q.label: made for q in kind.quantities if (made := _lines(q, get))}
            if kind.file == "elout":
                known |= _points_of({AsciiKey(name, id, side): values for (name, side), values in mine.items()})
            if (entity := _whole(Entity(str(id), titles.get(str(id), ""), file.times, known))) is not None:
                out.append(entity)
        return out

    def _of_csv(self) -> list[Entity]:
        """Gauges of a run that has no history.h5 yet: a table each."""
        out: list[Entity] = []
        for file in sorted((self.run.folder / "gauges").glob("*.csv")):
            read = self._try(lambda file=file: _gauge_of(file), f"gauges/{file.name}")  # type: ignore[misc]
            out += [read] if isinstance(read, Entity) and _whole(read) is not None else []
        return out

    # binout

    def _of_binout(self, kind: Kind) -> list[Entity]:
        file, out = self.binout, list[Entity]()
        for folder in kind.binout:
            if not any(path.startswith(f"{folder}/") for path in file):
                continue
            read = self._try(lambda folder=folder: self._of_folder(kind, folder), "binout0000")  # type: ignore[misc]
            out += read if isinstance(read, list) else []
        return out

    def _of_folder(self, kind: Kind, folder: str) -> list[Entity]:
        file, out = self.binout, []
        paths = set(file)
        t = file[f"{folder}/time"]
        ids_of = next((name for name in (_BINOUT_IDS.get(kind.title, "ids"), "ids") if f"{folder}/{name}" in paths), "")
        ids = np.atleast_1d(file[f"{folder}/{ids_of}"]).ravel() if ids_of else np.empty(0)
        tables = {path: file[path] for path in paths if path.rpartition("/")[0] == folder}

        def one_of(path: str, id: int) -> np.ndarray:
            """A column of the table where all states have the same entities."""
            found = tables[path].reshape(len(t), -1) if tables[path].size == len(t) * len(ids) and len(t) else np.empty((0, 0))
            return found[:, int(np.flatnonzero(ids == id)[0])] if found.size else file.of(path, id)
        titles = self._binout_titles(folder)
        for id in dict.fromkeys(int(one) for one in ids[np.isfinite(ids)]):

            def get(s: Series, id: int = id) -> np.ndarray | None:
                if not s.binout or f"{folder}/{s.binout}" not in paths:
                    return None
                values = one_of(f"{folder}/{s.binout}", id)
                return values if values.ndim == 1 else values[:, 0]

            known = {q.label: made for q in kind.quantities if (made := _lines(q, get))}
            names = [name.format("_") for name in _STRESS]
            if kind.file == "elout" and all(f"{folder}/{name}" in paths for name in names):
                tensor = np.stack([file.of(f"{folder}/{name}", id).reshape(len(t), -1) for name in names], axis=-1)
                curves = [(f"point {k + 1}", mises(tensor[:, k])) for k in range(tensor.shape[1])]
                known["von Mises stress"] = Lines("von Mises stress", "M/LT2", curves)
            if (entity := _whole(Entity(str(id), titles.get(id, ""), t, known))) is not None:
                out.append(entity)
        return out

    def _binout_titles(self, folder: str) -> dict[int, str]:
        file = self.binout
        if f"{folder}/legend" not in file or f"{folder}/legend_ids" not in file:
            return {}
        ids = np.atleast_1d(file[f"{folder}/legend_ids"]).astype(int)
        text = file.text(f"{folder}/legend").ljust(70 * len(ids))
        width = max(len(text) // max(len(ids), 1), 1)
        return {int(id): text[k * width : (k + 1) * width].strip("\0 ") for k, id in enumerate(ids)}

    # all

    def find(self, kind: Kind) -> Found:
        """The first source that has the kind."""
        if kind.title not in self._found:
            self._found[kind.title] = self._find(kind)
        return self._found[kind.title]

    def _find(self, kind: Kind) -> Found:
        if self.h5 is not None and (some := self._of_h5(kind)):
            return Found(kind, some, f"history.h5 (/{', /'.join(kind.groups)})")
        if "gauges" in kind.groups and (some := self._of_csv()):
            return Found(kind, some, "gauges/NAME.csv")
        if some := self._of_ascii(kind):
            return Found(kind, some, kind.file)
        if self.binout is not None and (some := self._of_binout(kind)):
            return Found(kind, some, f"binout ({', '.join(kind.binout)})")
        return Found(kind, [], "", self.notes.get(kind.file, ""))

    def others(self) -> list[Found]:
        """Groups of history.h5 that no kind takes, as those of histories of one's own."""
        if self.h5 is None:
            return []
        known = {"global", *(group for kind in KINDS for group in kind.groups)}
        by_name: dict[str, list[Entity]] = {}
        for group in self._names:
            name = group.partition("/")[0]
            if name not in known and (made := self._of_group(None, group)) is not None:
                by_name.setdefault(name, []).append(made)
        kinds = [Kind(_spoken(name).capitalize(), _singular(name), "", (name,), ()) for name in by_name]
        return [Found(kind, some, f"history.h5 (/{name})") for kind, (name, some) in zip(kinds, by_name.items(), strict=True)]

    def not_shown(self) -> list[str]:
        """Histories of binout that no kind takes."""
        if self.binout is None:
            return []
        known = {folder for kind in KINDS for folder in kind.binout} | {"glstat"}
        return [name for name in self.binout.histories if not any(name == one or name.startswith(f"{one}/") for one in known)]

    @cached_property
    def energies(self) -> tuple[np.ndarray, dict[str, np.ndarray], str]:
        """Times, energies of the whole by name, and the file."""
        if self.h5 is not None and (table := self._try(lambda: self.run.energies, "history.h5")) is not None:
            return table["t"], {name: table[name] for name in table.names if name != "t"}, "history.h5"  # type: ignore[index, attr-defined]
        if (file := self.ascii("glstat")) is not None:
            names: dict[str, np.ndarray] = {}
            for key, values in file.columns.items():
                if file.dimension(key) == "ML2/T2":
                    label = key.name.removesuffix(" energy")
                    names[label] = names[label] + values if label in names else values  # stonewall energies have a wall each
            return file.times, names, "glstat"
        if self.binout is not None and "glstat/time" in self.binout:
            file = self.binout
            names = {path.rpartition("/")[2]: file[path] for path in file if re.fullmatch(r"glstat/(\w*_energy|external_work)", path)}
            t = file["glstat/time"]
            return t, {name.removesuffix("_energy").replace("_", " "): v for name, v in names.items() if v.shape == t.shape}, "binout (glstat)"
        return np.empty(0), {}, ""

    @cached_property
    def steps(self) -> tuple[np.ndarray, np.ndarray]:
        """Times and time steps, (rows,) [T]."""
        if self.h5 is not None and "global/dt" in list(self.h5):
            return np.asarray(self.h5.t), self.h5["global/dt"]
        if (file := self.ascii("glstat")) is not None:
            return file.times, next((values for key, values in file.columns.items() if key.name == "time step"), np.full(len(file.times), np.nan))
        if self.binout is not None and "glstat/time_step" in self.binout:
            return self.binout["glstat/time"], self.binout["glstat/time_step"]
        return np.empty(0), np.empty(0)


def _points_of(columns: dict[AsciiKey, np.ndarray]) -> dict[str, Lines]:
    """Von Mises stress and plastic strain of an element at its points."""
    sides: dict[str, dict[str, np.ndarray]] = {}
    for key, values in columns.items():
        if "point" in key.side:
            sides.setdefault(key.side, {})[key.name] = values
    stress, strain = [], []
    for side, some in sides.items():
        names = [name.format("-") for name in _STRESS]
        if all(name in some for name in names):
            stress.append((side, mises(np.column_stack([some[name] for name in names]))))
        strain += [(side, some[name]) for name in ("plastic strain", "yield", "plastic eps") if name in some]
    made = [Lines("von Mises stress", "M/LT2", stress), Lines("plastic strain", "-", strain)]
    return {one.label: one for one in made if one.curves}


def thinned(t: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest value of groups of rows, in order, where there are more rows than a picture can show: no peak is lost."""
    if len(t) <= _MOST_ROWS:
        return t, values
    size = -(-2 * len(t) // _MOST_ROWS)
    pad = -len(t) % size
    table = np.append(values, np.full(pad, np.nan)).reshape(-1, size)
    with np.errstate(invalid="ignore"):
        low, high = (find(np.nan_to_num(table, nan=fill), axis=1) for find, fill in ((np.argmin, np.inf), (np.argmax, -np.inf)))
    at = np.unique(np.concatenate([low, high]) + np.tile(np.arange(len(table)) * size, 2))
    at = at[at < len(t)]
    return t[at], values[at]


def summary_of(run: Results) -> dict[str, Any]:
    """summary.yaml; nothing where there is none, or a damaged one."""
    try:
        return run.summary
    except CourantError:
        return {}


_USUAL = {  # of a system: force, stress, energy, moment
    ("kg", "m", "s"): ("N", "Pa", "J", "N m"), ("t", "mm", "s"): ("N", "MPa", "mJ", "N mm"),
    ("kg", "mm", "ms"): ("kN", "GPa", "J", "kN mm"), ("g", "mm", "ms"): ("N", "MPa", "mJ", "N mm"),
}  # fmt: skip


def unit_names(run: Results) -> Callable[..., str]:
    """The unit of a dimension, "ML/T2", by its usual name where it has one: N, kN, MPa, J; the dimension itself where the
    units are not known. `label`: of the quantity; a moment is no energy."""
    usual = _USUAL.get((run.units.mass, run.units.length, run.units.time))

    def name(dimension: str, label: str = "") -> str:
        if usual and dimension in ("ML/T2", "M/LT2", "ML2/T2"):
            turning = "moment" in label or "torsion" in label
            return usual[("ML/T2", "M/LT2", "ML2/T2").index(dimension) + (turning and dimension == "ML2/T2")]
        if run.units == MODEL_UNITS and dimension not in ("-", "?", "%", "ns"):
            return dimension
        return run.units.of_text(dimension)

    return name


def time_unit(run: Results) -> str:
    return unit_names(run)("T")
