"""Reads history.h5 of a run."""

from __future__ import annotations

import re
import zlib
from os import PathLike
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from .diagnostics import Diagnostics

_LAST_LINE = re.compile(rb"\ncourant history file, crc32 ([0-9a-f]{8})\n\Z")


def is_whole(data: bytes) -> bool:
    """Whether the bytes of a history.h5 are those that were written: their CRC-32 is behind them.

    HDF5's own library crashes on damaged files, so it is handed no others.
    """
    found = _LAST_LINE.search(data[-64:])
    return found is not None and zlib.crc32(memoryview(data)[: len(data) - len(found[0])]) == int(found[1], 16)


class HistoryFile:
    """A history.h5 in memory, whose datasets are unpacked when they are asked for. Row i of every dataset belongs to /global/time[i].

    A quantity that was not there at a sample is NaN in all datasets of its group: `sampled` tells those apart from numbers that went
    wrong. Datasets of a gauge, "/gauges/NAME/level", have times of their own: `times_of`. `names`: paths of all datasets, "/contacts/1/force", sorted; `times`: (rows,) [T]. Raises ValueError where it is none.
    """

    def __init__(self, data: bytes) -> None:
        self._h5 = h5py.File(h5py.h5f.open_file_image(data))
        found: list[str] = []

        def note(name: bytes, info: Any) -> None:
            if info.type == h5py.h5o.TYPE_DATASET:
                found.append(f"/{name.decode()}")

        h5py.h5o.visit(self._h5.id, note, info=True)  # without opening each
        self.names = sorted(found)
        self._known: dict[str, np.ndarray] = {}
        if not any(name == "/global/time" or name.startswith("/gauges/") for name in self.names):
            raise ValueError("it has no times")
        self.times = self._read("/global/time").ravel() if "/global/time" in self.names else np.empty(0)

    @classmethod
    def open(cls, file: str | PathLike[str], diagnostics: Diagnostics) -> HistoryFile | None:
        """Faults are reported; then there is None."""
        path = Path(file)
        if not path.is_file():
            killed = (path.parent / "messag").is_file() and not (path.parent / "summary.yaml").is_file()
            hint = "it comes at intervals and at the end of a run: this one goes on, or was killed; text files and binout have the rows so far"
            diagnostics.error(path, "no histories here: the file is missing", hint if killed else "the deck needs a *DATABASE_GLSTAT card")
            return None
        try:
            data = path.read_bytes()
            if is_whole(data):
                return cls(data)
            why = ", or a damaged one: its checksum is not that of its content"
        except (OSError, RuntimeError, TypeError, ValueError, KeyError):  # what h5py raises
            why = ""
        diagnostics.error(path, f"not a history file of `courant run`{why}", "run the deck again")
        return None

    def _read(self, path: str) -> np.ndarray:
        """Values as they lie in the file, (rows, components)."""
        if path not in self._known:
            values = self._h5[path][()].astype(np.float64)
            self._known[path] = values.reshape(len(values), -1)
        return self._known[path]

    def components(self, path: str) -> int:
        """Components of a dataset, 1 or 3; 0 where there is none of that name."""
        return self._read(path).shape[1] if path in self.names else 0

    def dimension(self, path: str) -> str:
        """Dimension of a dataset in M, L, T as the file names it, "ML/T2"; "-" where there is none."""
        text = self._h5[path].attrs.get("dimension", b"-") if path in self.names else b"-"
        return text.decode("utf-8", "replace").rstrip("\0") if isinstance(text, bytes) else "-"

    def times_of(self, path: str) -> np.ndarray:
        """Times of the rows of a dataset or of the datasets of a group, (rows,) [T]."""
        parts = path.strip("/").split("/")
        own = "/".join(["", *parts[:2], "time"])
        return self._read(own).ravel() if parts[0] == "gauges" and own in self.names else self.times

    def values(self, path: str) -> np.ndarray | None:
        """All components of a dataset, shape (rows, components); rows before it was there are NaN. None if there is none."""
        if path not in self.names:
            return None
        found = self._read(path)
        wanted = len(self.times_of(path))
        rows = min(wanted, len(found))
        return np.concatenate([found[:rows], np.full((wanted - rows, found.shape[1]), np.nan)])

    def column(self, path: str, component: int = 0) -> np.ndarray | None:
        """One component of a dataset, shape (rows,). None if there is none."""
        values = self.values(path)
        return None if values is None or not 0 <= component < values.shape[1] else values[:, component]

    def sampled(self, path: str) -> np.ndarray:
        """Whether the group of a dataset was sampled, shape (rows,) of bool."""
        group = path[: path.rfind("/") + 1]
        beside = [self.values(name) for name in self.names if name.startswith(group)]
        return np.any([~np.isnan(one).all(axis=1) for one in beside if one is not None] or [np.zeros(len(self.times_of(path)), bool)], axis=0)
