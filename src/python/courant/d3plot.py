"""LS-DYNA's d3plot family, of Courant and of LS-DYNA itself: `d3plot` with the model, `d3plot01`, ... with the states.

Nothing in a file is trusted: sizes are held against the length of the file before memory is asked for. Layout: the public description of
the LS-DYNA database. Read are nodes, solids, thick shells, beams, shells, SPH particles, deletion and titles of parts; files with sections
whose size is not known (airbag particles, CFD, adapted meshes, solids of many nodes) are refused by name.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import numpy as np

__all__ = ["D3plotFault", "D3plotFile", "D3plotState"]

_END = -999999.0
_MOST_WORDS = 2**31
_WORDS = {
    "filetype": 11, "ndim": 15, "numnp": 16, "nglbv": 18, "it": 19, "iu": 20, "iv": 21, "ia": 22, "nel8": 23, "nv3d": 27, "nel2": 28, "nv1d": 30,
    "nel4": 31, "nv2d": 33, "neiph": 34, "neips": 35, "maxint": 36, "nmsph": 37, "narbs": 39, "nelt": 40, "nv3dt": 42, "ioshl1": 43, "ioshl2": 44,
    "ioshl3": 45, "ioshl4": 46, "ialemat": 47, "ncfdv1": 48, "nadapt": 50, "nmmat": 51, "npefg": 54, "nel48": 55, "idtdt": 56, "extra": 57,
}  # fmt: skip
_EXTRA = {"nel20": 64, "nt3d": 65, "nel27": 66, "neipb": 67, "nel21p": 68, "nel15t": 69, "nel20t": 71, "nel40p": 72, "nel64": 73}
_SPH = ("smoothing_length", "pressure", "stress", "plastic_strain", "density", "internal_energy", "neighbours", "strain", "mass")
KINDS = ("solids", "tshells", "beams", "shells")


class D3plotFault(Exception):
    """A file that is no d3plot, a damaged one, or one with what is not read."""


class _Reader:
    """Words of a file one after the other. Raises D3plotFault where it ends."""

    def __init__(self, data: bytes, width: int, order: str) -> None:
        self.data, self.width, self.at = data, width, 0
        self.real, self.integer = np.dtype(f"{order}f{width}"), np.dtype(f"{order}i{width}")

    def take(self, words: int, dtype: np.dtype | None = None) -> np.ndarray:
        if words < 0 or words > _MOST_WORDS or self.at + words * self.width > len(self.data):
            raise D3plotFault("it is cut off, or no d3plot")
        values = np.frombuffer(self.data, dtype or self.integer, words, self.at)
        self.at += words * self.width
        return values

    def table(self, rows: int, columns: int) -> np.ndarray:
        return self.take(rows * columns).reshape(rows, columns)

    def left(self) -> int:
        return len(self.data) - self.at


class D3plotFile:
    """A family by the path of its first file. `times`: (states,) [T]; `nodes`, `ids`: numbers of the deck; `parts`: title by part number;
    `warnings`: what is missing of the family, or cut off; the states that are whole count.

    Raises D3plotFault, OSError.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.warnings: list[str] = []
        if not self.path.exists() and (behind := _files_behind(self.path)):
            names = behind[0].name + (f" to {behind[-1].name}" if len(behind) > 1 else "")
            raise D3plotFault(f"it is gone: {names} hold states, but the nodes and elements were in {self.path.name}")
        data = self.path.read_bytes()
        width, order = _layout(data)
        self._words = _Reader(data, width, order)
        self.header = {name: self._word(at) for name, at in _WORDS.items()}
        self.header |= {name: self._word(at) if self.header["extra"] > at - 64 else 0 for name, at in _EXTRA.items()}
        self.title = data[: 10 * width].decode("latin-1").rstrip("\0 ")
        self._check()
        self._read_geometry()
        self._find_states()

    def _word(self, at: int) -> int:
        width = self._words.width
        if (at + 1) * width > len(self._words.data):
            raise D3plotFault("it is cut off, or no d3plot")
        return int(np.frombuffer(self._words.data, self._words.integer, 1, at * width)[0])

    def _check(self) -> None:
        h = self.header
        if h["ndim"] not in (2, 3, 4, 5, 7):
            raise D3plotFault(f"its kind of geometry (NDIM {h['ndim']}) is not read")
        refused = {"nadapt": "an adapted mesh", "npefg": "airbag particles", "ialemat": "fluid materials", "nel48": "shells of eight nodes"}
        refused |= {name: "solids of more than ten nodes" for name in ("nel20", "nel27", "nel21p", "nel15t", "nel20t", "nel40p", "nel64")}
        refused |= {"ncfdv1": "CFD data", "nt3d": "temperatures of solids"}
        for name, what in refused.items():
            if h[name] != 0:
                raise D3plotFault(f"it has {what}, which are not read")
        if min(h[name] for name in ("numnp", "nglbv", "nel2", "nel4", "nelt", "nmsph", "narbs", "nv3d", "nv1d", "nv2d", "nv3dt", "extra", "nmmat")) < 0:
            raise D3plotFault("its control words are damaged")

    def _read_geometry(self) -> None:
        h, words = self.header, self._words
        words.at = (64 + h["extra"]) * words.width
        self.rigid_shells, self.part_types = 0, np.empty(0, int)
        if h["ndim"] in (5, 7):
            self.rigid_shells, some = (int(v) for v in words.take(2))
            self.part_types = words.take(some)
        self._sph = [int(v) for v in words.take(1)] if h["nmsph"] else []
        if self._sph:
            self._sph += [int(v) for v in words.take(self._sph[0] - 1)][:10]
            if min(self._sph) < -6:
                raise D3plotFault("its words of particles are damaged")
        self.places = words.take(3 * h["numnp"], words.real).reshape(-1, 3)
        count = {"solids": abs(h["nel8"]), "tshells": h["nelt"], "beams": h["nel2"], "shells": h["nel4"]}
        columns = {"solids": 9, "tshells": 9, "beams": 6, "shells": 5}
        self.corners: dict[str, np.ndarray] = {}
        self.part_of: dict[str, np.ndarray] = {}
        for kind in KINDS:
            table = words.table(count[kind], columns[kind]).astype(np.int64)
            ends = {"beams": 2}.get(kind, columns[kind] - 1)
            self.corners[kind], self.part_of[kind] = table[:, :ends] - 1, table[:, -1]
            if kind == "solids" and h["nel8"] < 0:
                words.take(2 * count[kind])
            if table.size and (self.corners[kind].min() < 0 or self.corners[kind].max() >= h["numnp"]):
                raise D3plotFault(f"its {kind} name nodes that are not there")
        self._read_numbers(count)
        self.sph_nodes = words.table(h["nmsph"], 2).astype(np.int64) - 1
        if self.sph_nodes.size and (self.sph_nodes[:, 0].min() < 0 or self.sph_nodes[:, 0].max() >= h["numnp"]):
            raise D3plotFault("its particles name nodes that are not there")
        self._read_titles()

    def _read_numbers(self, count: dict[str, int]) -> None:
        h, words = self.header, self._words
        begin = words.at
        self.nodes = np.arange(1, h["numnp"] + 1)
        self.ids = {kind: np.arange(1, count[kind] + 1) for kind in KINDS}
        self.part_ids = np.arange(1, h["nmmat"] + 1)
        if h["narbs"] == 0:
            return
        by_part = int(words.take(10)[0]) < 0
        if by_part:
            words.take(6)
        self.nodes = words.take(h["numnp"])
        self.ids = {kind: words.take(count[kind]) for kind in ("solids", "beams", "shells", "tshells")}
        if by_part:
            self.part_ids = words.take(h["nmmat"])
        words.at = begin
        words.take(h["narbs"])

    def _read_titles(self) -> None:
        """Behind the end mark; a file may have none. Titles have 72 bytes whatever the width of a word."""
        words = self._words
        self.parts: dict[int, str] = {int(id): "" for id in self.part_ids}
        self._states_at = words.at
        if words.left() < 3 * words.width or words.take(1, words.real)[0] != _END:
            return
        kind, count = (int(v) for v in words.take(2))
        if kind != 90001 or count < 0 or count * (72 + words.width) > words.left():
            return
        for _ in range(count):
            id = int(words.take(1)[0])
            self.parts[id] = words.data[words.at : words.at + 72].decode("latin-1").rstrip("\0 ")
            words.at += 72
        self._states_at = len(words.data)

    def _sections(self) -> list[tuple[str, int]]:
        """Of a state behind its time: name and number of words."""
        h = self.header
        nodes, deletion = h["numnp"], h["maxint"]
        count = {kind: len(self.corners[kind]) for kind in KINDS}
        shells = count["shells"] - self.rigid_shells
        thermal = {0: 0, 1: 1, 2: 4, 3: 6}.get(h["it"] % 10, 0) + (h["it"] // 10 % 10 == 1)
        gradient, residual = (h["idtdt"] % 10 == 1), (h["idtdt"] // 10 % 10 == 1)
        out = [("global", h["nglbv"]), ("position", 3 * nodes * (h["iu"] != 0)), ("thermal", nodes * (thermal + gradient + 6 * residual))]
        out += [("velocity", 3 * nodes * (h["iv"] != 0)), ("acceleration", 3 * nodes * (h["ia"] != 0))]
        out += [("solids", count["solids"] * h["nv3d"]), ("tshells", count["tshells"] * h["nv3dt"]), ("beams", count["beams"] * h["nv1d"])]
        out.append(("shells", shells * h["nv2d"]))
        if deletion < -9999 or deletion > 10000:
            out += [(f"alive {kind}", count[kind]) for kind in ("solids", "tshells", "shells", "beams")]
        elif deletion < 0:
            out.append(("alive nodes", nodes))
        if h["nmsph"]:
            out.append(("particles", h["nmsph"] * self.sph_words))
        if h["ndim"] == 7:
            raise D3plotFault("it has road surfaces, which are not read")
        return out

    @property
    def sph_words(self) -> int:
        return 1 + sum(abs(v) for v in self._sph[1:11])  # the eleventh, where there is one, counts history variables

    @property
    def has_strain(self) -> bool:
        """Whether solids and shells have strains: as the file says, or by the words of shells where it does not."""
        h = self.header
        if h["idtdt"] >= 100:
            return h["idtdt"] // 10000 % 10 == 1
        each = 6 * (h["ioshl1"] == 1000) + (h["ioshl2"] == 1000) + h["neips"]
        return h["nv2d"] > 0 and h["nv2d"] - self.layers * each - 8 * (h["ioshl3"] == 1000) - 4 * (h["ioshl4"] == 1000) >= 12

    @property
    def layers(self) -> int:
        """Points of shells through their thickness."""
        maxint = self.header["maxint"]
        return abs(maxint) - 10000 if abs(maxint) > 9999 else abs(maxint)

    def _find_states(self) -> None:
        words, self._offsets = self._words, {}
        at = 1
        for name, count in self._sections():
            self._offsets[name] = (at, count)
            at += count
        self._state_words = at
        self._states: list[tuple[Path, int]] = []
        times: list[float] = []
        size = at * words.width
        behind = _files_behind(self.path)
        self._note_gaps(behind)
        for file, begin in [(self.path, self._states_at), *((file, 0) for file in behind)]:
            length = file.stat().st_size
            with open(file, "rb") as stream:
                while begin + words.width <= length:
                    stream.seek(begin)
                    t = float(np.frombuffer(stream.read(words.width), words.real)[0])
                    if t == _END:
                        break
                    if begin + size > length or not np.isfinite(t):
                        why = "is cut off" if begin + size > length else "has a time that is no number"
                        self.warnings.append(f"{file.name}: a state {why} and is left out")
                        break
                    self._states.append((file, begin))
                    times.append(t)
                    begin += size
        self.times = np.array(times)

    def _note_gaps(self, behind: list[Path]) -> None:
        """Files of the family that are not there."""
        numbers = [int(file.name[len(self.path.name) :]) for file in behind]
        if missing := sorted(set(range(1, max(numbers, default=0))) - set(numbers)):
            names = ", ".join(f"{self.path.name}{number:02d}" for number in missing[:5]) + (", ..." if len(missing) > 5 else "")
            self.warnings.append(f"{names}: not there, so that states are missing")

    def __len__(self) -> int:
        return len(self._states)

    def state(self, index: int) -> D3plotState:
        return D3plotState(self, index)

    def words(self, index: int, section: str) -> np.ndarray:
        """Words of a section of a state."""
        file, begin = self._states[index]
        at, count = self._offsets.get(section, (0, 0))
        with open(file, "rb") as stream:
            stream.seek(begin + at * self._words.width)
            data = stream.read(count * self._words.width)
        if len(data) != count * self._words.width:
            raise D3plotFault("a state is cut off")
        return np.frombuffer(data, self._words.real)

    def has(self, section: str) -> bool:
        return self._offsets.get(section, (0, 0))[1] > 0


class D3plotState:
    """A state: `t` [T]; `nodes` holds position, velocity, acceleration; `elements(kind)` and `particles()` arrays by name."""

    def __init__(self, file: D3plotFile, index: int) -> None:
        self.file, self.index, self.t = file, index, float(file.times[index])

    def _nodal(self, name: str) -> np.ndarray:
        return self.file.words(self.index, name).reshape(-1, 3)

    @property
    def nodes(self) -> dict[str, np.ndarray]:
        """Arrays of nodes, (nodes, 3), and `id`."""
        out: dict[str, np.ndarray] = {"id": self.file.nodes}
        out |= {name: self._nodal(name) for name in ("position", "velocity", "acceleration") if self.file.has(name)}
        if "position" in out:
            out["displacement"] = out["position"] - self.file.places
        return out

    def elements(self, kind: str) -> dict[str, np.ndarray]:
        """Arrays of "solids", "tshells", "beams" or "shells", (elements,) or (elements, ...); layers of shells are the second axis."""
        count = len(self.file.corners[kind])
        part = self.file.part_of[kind]
        ids = self.file.part_ids
        named = np.where((part >= 1) & (part <= len(ids)), ids[np.clip(part, 1, max(len(ids), 1)) - 1] if len(ids) else part, part)
        out: dict[str, Any] = {"id": self.file.ids[kind], "part": named}
        if self.file.has(f"alive {kind}"):
            out["alive"] = self.file.words(self.index, f"alive {kind}") != 0
        if not self.file.has(kind) or count == 0:
            return out
        rows = self.file.words(self.index, kind)
        if kind == "shells" and self.file.rigid_shells:
            rigid = np.isin(part, np.flatnonzero(self.file.part_types == 20) + 1)
            if count - rigid.sum() != count - self.file.rigid_shells:
                raise D3plotFault("its rigid shells are not those of its rigid materials")
            whole = np.zeros((count, self.file.header["nv2d"]), rows.dtype)
            whole[~rigid] = rows.reshape(-1, self.file.header["nv2d"])
            rows = whole
        try:
            return out | getattr(self, f"_of_{kind}")(rows.reshape(count, -1))
        except (IndexError, ValueError) as fault:
            raise D3plotFault(f"its words of {kind} are damaged") from fault

    def _of_solids(self, rows: np.ndarray) -> dict[str, np.ndarray]:
        h = self.file.header
        points = 8 if rows.shape[1] >= 8 * (7 + h["neiph"]) else 1
        rows = rows.reshape(len(rows), points, -1)
        rows = rows[:, 0] if points == 1 else rows
        out = {"stress": rows[..., :6], "plastic_strain": rows[..., 6]}
        numbers = h["neiph"]
        if self.file.has_strain and numbers >= 6:  # the last ones
            numbers -= 6
            out["strain"] = rows[..., 7 + numbers : 13 + numbers]
        return out | ({"history": rows[..., 7 : 7 + numbers]} if numbers else {})

    def _layers(self, rows: np.ndarray) -> tuple[dict[str, np.ndarray], np.ndarray]:
        h, layers = self.file.header, self.file.layers
        stress, plastic = 6 * (h["ioshl1"] == 1000), int(h["ioshl2"] == 1000)
        each = stress + plastic + h["neips"]
        if layers * each > rows.shape[1]:
            raise D3plotFault("its words of shells are damaged")
        part = rows[:, : layers * each].reshape(len(rows), layers, each)
        out = {"stress": part[..., :6]} if stress else {}
        if plastic:
            out["plastic_strain"] = part[..., stress]
        if h["neips"]:
            out["history"] = part[..., stress + plastic :]
        return out, rows[:, layers * each :]

    def _of_tshells(self, rows: np.ndarray) -> dict[str, np.ndarray]:
        return self._layers(rows)[0]

    def _of_shells(self, rows: np.ndarray) -> dict[str, np.ndarray]:
        out, rest = self._layers(rows)
        if self.file.header["ioshl3"] == 1000 and rest.shape[1] >= 8:
            out |= {"bending_moment": rest[:, :3], "shear_force": rest[:, 3:5], "membrane_force": rest[:, 5:8]}
            rest = rest[:, 8:]
        if self.file.header["ioshl4"] == 1000 and rest.shape[1] >= 4:
            out["thickness"] = rest[:, 0]
            out["internal_energy"] = rest[:, 3 if rest.shape[1] < 16 else 15]
            if rest.shape[1] >= 16:
                out["strain"] = rest[:, 3:15].reshape(len(rest), 2, 6)
        elif self.file.has_strain and rest.shape[1] >= 12:
            out["strain"] = rest[:, :12].reshape(len(rest), 2, 6)
        return out

    def _of_beams(self, rows: np.ndarray) -> dict[str, np.ndarray]:
        if rows.shape[1] < 6:
            return {}
        out = {"axial_force": rows[:, 0], "shear_force": rows[:, 1:3], "bending_moment": rows[:, 3:5], "torsion": rows[:, 5]}
        if self.file.header["neipb"] == 0 and rows.shape[1] > 6 and (rows.shape[1] - 6) % 5 == 0:
            points = rows[:, 6:].reshape(len(rows), -1, 5)
            out |= {"beam_stress": points[..., :3], "plastic_strain": points[..., 3], "axial_strain": points[..., 4]}
        return out

    def particles(self) -> dict[str, np.ndarray]:
        """Arrays of SPH particles, (particles,) or (particles, 6); `active`: whether it is not deleted."""
        nodes = self.file.sph_nodes[:, 0]
        rows = self.file.words(self.index, "particles").reshape(len(nodes), self.file.sph_words)
        part = np.abs(rows[:, 0]).astype(np.int64)
        ids = self.file.part_ids
        out: dict[str, np.ndarray] = {"id": self.file.nodes[nodes], "active": rows[:, 0] > 0}
        out["part"] = ids[np.clip(part, 1, len(ids)) - 1] if len(ids) else part
        at = 1
        for name, count in zip(_SPH, self.file._sph[1:10], strict=False):
            if count:
                out[name] = rows[:, at] if abs(count) == 1 else rows[:, at : at + min(abs(count), 6)]
            at += abs(count)
        return out | {name: values[nodes] for name, values in self.nodes.items() if name in ("position", "velocity", "acceleration")}

    def globals(self) -> dict[str, np.ndarray]:
        """Energies, velocity and, by part, energies, velocities and masses, as far as there are words of them."""
        words, parts = self.file.words(self.index, "global"), self.file.header["nmmat"]
        out: dict[str, np.ndarray] = {}
        sizes = [("kinetic", 1), ("internal", 1), ("total", 1), ("velocity", 3), ("part_internal", parts), ("part_kinetic", parts)]
        sizes += [("part_velocity", 3 * parts), ("part_mass", parts), ("part_hourglass", parts)]
        at = 0
        for name, count in sizes:
            if at + count > len(words):
                break
            values = words[at : at + count]
            out[name] = values.reshape(-1, 3) if name == "part_velocity" else values
            at += count
        walls = (len(words) - at) // 4
        if walls > 0 and at == 6 + 7 * parts:
            out |= {"wall_force": words[at : at + walls], "wall_displacement": words[at + walls : at + 4 * walls].reshape(walls, 3)}
        return out


def _layout(data: bytes) -> tuple[int, str]:
    """Width of a word and order of its bytes, by the number of the kind of file."""
    for width, order in ((4, "<"), (8, "<"), (4, ">"), (8, ">")):
        if len(data) < 64 * width:
            continue
        kind = int(np.frombuffer(data, f"{order}i{width}", 1, 11 * width)[0])
        version = float(np.frombuffer(data, f"{order}f{width}", 1, 14 * width)[0])
        if kind % 1000 in (1, 5) and 0 < kind < 2000 and 0 < version < 100000:
            return width, order
    raise D3plotFault("it is no d3plot")


def _files_behind(path: Path) -> list[Path]:
    """d3plot01, d3plot02, ... by number."""
    pattern = re.compile(re.escape(path.name) + r"([0-9]{2,})$")
    found = {int(match[1]): file for file in path.parent.iterdir() if (match := pattern.fullmatch(file.name)) and file.is_file()}
    return [found[number] for number in sorted(found)]
