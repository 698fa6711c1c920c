"""LS-DYNA's binout (LSDA), of Courant and of LS-DYNA itself: histories as arrays over time.

Nothing in a file is trusted: records are held against the length of the file. A file whose last table of names is cut off is read up to there.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Literal

import numpy as np

__all__ = ["BinoutFault", "BinoutFile", "binout_files"]

_CD, _VARIABLE, _BEGIN, _END, _TABLE_AT = 2, 4, 5, 6, 7
_TYPES = {1: "i1", 2: "i2", 3: "i4", 4: "i8", 5: "u1", 6: "u2", 7: "u4", 8: "u8", 9: "f4", 10: "f8"}
_STATE = re.compile(r"(.*)/d([0-9]+)$")


class BinoutFault(Exception):
    """A file that is no binout, or a damaged one."""


def binout_files(folder: Path) -> list[Path]:
    """binout, binout0000, binout0001, ... of a folder; not their continuations, `binout0000%001`."""
    return sorted(file for file in folder.glob("binout*") if re.fullmatch(r"binout[0-9]*", file.name) and file.is_file())


class _Lsda:
    """One file with its continuations: arrays by path. Raises BinoutFault."""

    def __init__(self, path: Path, arrays: dict[str, np.ndarray]) -> None:
        self._data = path.read_bytes()
        self._arrays = arrays
        if len(self._data) < 8:
            raise BinoutFault("it is no binout")
        head = self._data[:8]
        sizes = head[1:5]
        if head[0] < 8 or sizes[0] not in (4, 8) or sizes[1] not in (4, 8) or sizes[2] != 1 or sizes[3] != 1:
            raise BinoutFault("it is no binout")
        self._length, self._offset = sizes[0], sizes[1]
        self._order: Literal["little", "big"] = "little" if head[5] else "big"
        self._read(head[0])

    def _number(self, at: int, width: int) -> int:
        if at < 0 or at + width > len(self._data):
            raise BinoutFault("it is cut off")
        return int.from_bytes(self._data[at : at + width], self._order)

    def _read(self, at: int) -> None:
        head = self._length + 1
        if self._number(at + self._length, 1) != _TABLE_AT:
            raise BinoutFault("it has no table of names")
        table, seen = self._number(at + head, self._offset), set()
        while table and table not in seen:
            seen.add(table)
            try:
                table = self._read_table(table)
            except BinoutFault:
                if len(seen) == 1:
                    raise
                return  # what was written whole counts

    def _read_table(self, at: int) -> int:
        head, folder = self._length + 1, ""
        if self._number(at + self._length, 1) != _BEGIN:
            raise BinoutFault("a table of names is damaged")
        at += head
        while True:
            length, command = self._number(at, self._length), self._number(at + self._length, 1)
            if length < head or at + length > len(self._data):
                raise BinoutFault("a table of names is damaged")
            if command == _CD:
                folder = _joined(folder, self._data[at + head : at + length].decode("latin-1"))
            elif command == _VARIABLE:
                self._take(folder, at + head, length - head)
            elif command == _END:
                return self._number(at + head, self._offset)
            at += length

    def _take(self, folder: str, at: int, length: int) -> None:
        name_bytes = length - 1 - self._offset - self._length
        if name_bytes < 1 or name_bytes > 255:
            raise BinoutFault("a table of names is damaged")
        name = self._data[at : at + name_bytes].decode("latin-1")
        kind = _TYPES.get(self._data[at + name_bytes])
        record = self._number(at + name_bytes + 1, self._offset)
        count = self._number(at + name_bytes + 1 + self._offset, self._length)
        if kind is None:
            return  # a link
        begin = record + self._length + 1 + 2 + name_bytes
        dtype = np.dtype(kind).newbyteorder("<" if self._order == "little" else ">")
        if begin + count * dtype.itemsize > len(self._data):
            raise BinoutFault("its data are cut off")
        self._arrays[f"{folder}/{name}"] = np.frombuffer(self._data, dtype, count, begin)


def _joined(folder: str, change: str) -> str:
    """A folder after a change: absolute, or relative with `..`."""
    parts = [] if change.startswith("/") else [part for part in folder.split("/") if part]
    for part in change.split("/"):
        if part == "..":
            parts = parts[:-1]
        elif part not in ("", "."):
            parts.append(part)
    return "/" + "/".join(parts)


class BinoutFile(Mapping[str, np.ndarray]):
    """Arrays by path, "nodout/x_displacement": (states,) or (states, ids); "nodout/ids" as they are. Raises BinoutFault, OSError."""

    def __init__(self, *paths: str | os.PathLike[str]) -> None:
        arrays: dict[str, np.ndarray] = {}
        for file in map(Path, paths):
            for part in [file, *sorted(file.parent.glob(f"{file.name}%*"))]:
                _Lsda(part, arrays)
        self._fixed: dict[str, np.ndarray] = {}
        states: dict[str, dict[int, np.ndarray]] = {}
        for path, values in arrays.items():
            folder, _, name = path.rpartition("/")
            if found := _STATE.match(folder):
                states.setdefault(f"{found[1][1:]}/{name}", {})[int(found[2])] = values
            else:
                self._fixed[f"{folder.removesuffix('/metadata')[1:]}/{name}"] = values
        self._states = states

    def _order(self, path: str) -> list[int]:
        """Numbers of the states of an array, by time."""
        rows = self._states[path]
        times = self._states.get(f"{path.rpartition('/')[0]}/time", {})
        return sorted(rows, key=lambda k: (float(times[k][0]) if k in times and len(times[k]) else 0.0, k))

    def of(self, path: str, id: int) -> np.ndarray:
        """An array of one entity, (states,); of elements with several points, as "elout/shell/sig_xx", (states, points). NaN where a state lacks it.
        Raises KeyError."""
        folder, rows = path.rpartition("/")[0], []
        fixed, of_state, counts = self._fixed.get(f"{folder}/ids"), self._states.get(f"{folder}/ids", {}), self._states.get(f"{folder}/nip", {})
        for k in self._order(path):
            values, ids = self._states[path][k], of_state.get(k, fixed)
            if ids is None:
                raise KeyError(f"'{folder}' has no ids")
            nip = counts.get(k, np.empty(0))
            nip = nip.astype(np.int64) if len(values) != len(ids) and len(nip) == len(ids) else np.ones(len(ids), np.int64)
            at, ends = np.flatnonzero(ids == id), np.cumsum(nip)
            whole = len(at) > 0 and len(nip) > 0 and nip.min() >= 0 and ends[-1] <= len(values)
            rows.append(values[ends[at[0]] - nip[at[0]] : ends[at[0]]] if whole else np.empty(0))
        width = max(map(len, rows), default=0)
        if width == 0:
            raise KeyError(f"'{folder}' has no {id}")
        out = np.array([[*row, *[np.nan] * (width - len(row))] for row in rows], dtype=float)
        return out[:, 0] if width == 1 else out

    def __getitem__(self, path: str) -> np.ndarray:
        """Raises KeyError. Ids that are the same in all states come once."""
        if path in self._fixed:
            values = self._fixed[path]
            if any(not np.array_equal(values, row) for row in self._states.get(path, {}).values()):
                return self._matrix(path)
            return values[0:1] if values.dtype.kind == "S" else values
        return self._matrix(path)

    def _matrix(self, path: str) -> np.ndarray:
        rows, order = self._states[path], self._order(path)
        width = max((len(rows[k]) for k in order), default=0)
        out = np.full((len(order), width), np.nan, dtype=float)
        for row, k in enumerate(order):
            out[row, : len(rows[k])] = rows[k]
        return out[:, 0] if width == 1 else out

    def __iter__(self) -> Iterator[str]:
        return iter(sorted({*self._fixed, *self._states}))

    def __len__(self) -> int:
        return len({*self._fixed, *self._states})

    @property
    def histories(self) -> list[str]:
        """ "glstat", "rwforc/forces", ...: folders with states."""
        return sorted({path.rpartition("/")[0] for path in self._states})

    def _lacking(self, history: str, what: str) -> Exception:
        """Why a history cannot be read: KeyError where it is not there, BinoutFault where there is damage."""
        known = self.histories
        if any(f"{name}/".startswith(f"{history}/") for name in known):
            return BinoutFault(f"'{history}' has no {what}: the file is damaged, or was cut off")
        return KeyError(f"binout has no '{history}'; it has {', '.join(known)}")

    def series(self, history: str) -> dict[str, np.ndarray]:
        """Arrays of a history and the folders in it over time, (states,) each: "z_displacement_5", "shell_sig_xx_7_point_2". Raises KeyError
        where there is none, BinoutFault where it is damaged."""
        out: dict[str, np.ndarray] = {}
        paths = [path for path in self._states if path.startswith(f"{history}/") and path.rpartition("/")[2] not in ("ids", "nip", "time")]
        if not paths:
            raise self._lacking(history, "values")
        for path in paths:
            folder, _, name = path.rpartition("/")
            word = "_".join([*folder.split("/")[1:], name])
            ids = self._fixed.get(f"{folder}/ids")
            if ids is None:
                ids = next(iter(self._states.get(f"{folder}/ids", {}).values()), None)
            if ids is None or all(len(row) == 1 for row in self._states[path].values()) and len(ids) != 1:
                values = self._matrix(path)
                out |= {word: values} if values.ndim == 1 else {f"{word}_{k + 1}": values[:, k] for k in range(values.shape[1])}
                continue
            for id in ids.tolist():
                try:
                    values = self.of(path, id)
                except KeyError:
                    continue
                many = values.ndim > 1
                out |= {f"{word}_{id}_point_{k + 1}": values[:, k] for k in range(values.shape[1])} if many else {f"{word}_{id}": values}
        return out

    def times(self, history: str) -> np.ndarray:
        """Times of the states of a history, (states,) [T]; of the first of its folders. Raises KeyError, BinoutFault."""
        path = next((path for path in sorted(self._states) if path.startswith(f"{history}/") and path.endswith("/time")), "")
        if not path:
            raise self._lacking(history, "times")
        return self[path]

    def text(self, path: str) -> str:
        """A title or another text."""
        return self._fixed[path].astype("u1").tobytes().decode("latin-1").rstrip("\0 ")
