"""LS-DYNA's binout (LSDA), of Courant and of LS-DYNA itself: histories as arrays over time.

Nothing in a file is trusted: records are held against the length of the file. A file whose last table of names is cut off is read up to there.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

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
        self._order = "little" if head[5] else "big"
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
        for path in map(Path, paths):
            for part in [path, *sorted(path.parent.glob(f"{path.name}%*"))]:
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

    def __getitem__(self, path: str) -> np.ndarray:
        if path in self._fixed:
            values = self._fixed[path]
            return values[0:1] if values.dtype.kind == "S" else values
        rows = self._states[path]
        times = self._states.get(f"{path.rpartition('/')[0]}/time", {})
        order = sorted(rows, key=lambda k: (float(times[k][0]) if k in times and len(times[k]) else 0.0, k))
        width = max((len(rows[k]) for k in order), default=0)
        out = np.full((len(order), width), np.nan, dtype=float)
        for row, k in enumerate(order):
            out[row, : len(rows[k])] = rows[k]
        return out[:, 0] if width == 1 else out

    def __iter__(self) -> Iterator[str]:
        return iter(sorted([*self._fixed, *self._states]))

    def __len__(self) -> int:
        return len(self._fixed) + len(self._states)

    @property
    def histories(self) -> list[str]:
        """ "glstat", "rwforc/forces", ...: folders with states."""
        return sorted({path.rpartition("/")[0] for path in self._states})

    def text(self, path: str) -> str:
        """A title or another text."""
        return self._fixed[path].astype("u1").tobytes().decode("latin-1").rstrip("\0 ")
