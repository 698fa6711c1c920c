"""Reads history.h5 of a run."""

from __future__ import annotations

import re
import zlib
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import h5py
import numpy as np

from .diagnostics import Diagnostics

_LAST_LINE = re.compile(rb"\ncourant history file, crc32 ([0-9a-f]{8})\n\Z")


def is_whole(data: bytes) -> bool:
    """Whether the bytes of a history.h5 are those that were written: their CRC-32 stands behind them.

    HDF5's own library crashes on damaged files, so it is handed no others.
    """
    found = _LAST_LINE.search(data[-64:])
    if found is None:
        return False
    length = len(data) - (found.end() - found.start())
    return zlib.crc32(memoryview(data)[:length]) == int(found[1], 16)


@dataclass
class HistoryDataset:
    """Values of a dataset as they lie in the file, (rows, components), and their dimension, "ML/T2"; "-" where there is none."""

    values: np.ndarray
    dimension: str


class HistoryFile:
    """A history.h5 that was read whole. Row i of every dataset belongs to /global/time[i].

    A quantity that was not there at a sample is NaN in all datasets of its group: `sampled` tells those apart from numbers
    that went wrong.
    """

    def __init__(self, datasets: dict[str, HistoryDataset]) -> None:
        self.datasets = dict(sorted(datasets.items()))
        self.times = datasets["/global/time"].values.ravel()

    @classmethod
    def open(cls, file: str | PathLike[str], diagnostics: Diagnostics) -> HistoryFile | None:
        """Faults are told; then there is None."""
        path = Path(file)
        if not path.is_file():
            diagnostics.error(path, "no histories here: the file is missing", "the deck needs a *DATABASE_GLSTAT card")
            return None
        try:
            data = path.read_bytes()
        except OSError:
            data = b""
        if not is_whole(data):
            diagnostics.error(
                path,
                "not a history file of `courant run`, or a damaged one: its checksum is not that of its content",
                "run the deck again",
            )
            return None
        try:
            with h5py.File(path, "r") as h5:
                datasets = _load(h5)
        except (OSError, RuntimeError, TypeError, ValueError, KeyError):
            datasets = {}
        if "/global/time" not in datasets:
            diagnostics.error(path, "not a history file of `courant run`", "run the deck again")
            return None
        return cls(datasets)

    @property
    def names(self) -> list[str]:
        """Paths of all datasets, "/contacts/1/force", sorted."""
        return list(self.datasets)

    def components(self, path: str) -> int:
        """Components of a dataset, 1 or 3; 0 where there is none of that name."""
        found = self.datasets.get(path)
        return found.values.shape[1] if found else 0

    def dimension(self, path: str) -> str:
        """Dimension of a dataset in M, L, T as the file names it, "ML/T2"; "-" where there is none."""
        found = self.datasets.get(path)
        return found.dimension if found else "-"

    def values(self, path: str) -> np.ndarray | None:
        """All components of a dataset, shape (rows, components); rows before it was there are NaN. None if there is none."""
        found = self.datasets.get(path)
        if found is None:
            return None
        out = np.full((len(self.times), found.values.shape[1]), np.nan)
        rows = min(len(out), len(found.values))
        out[:rows] = found.values[:rows]
        return out

    def column(self, path: str, component: int = 0) -> np.ndarray | None:
        """One component of a dataset, shape (rows,). None if there is none."""
        values = self.values(path)
        return None if values is None or not 0 <= component < values.shape[1] else values[:, component]

    def sampled(self, path: str) -> np.ndarray:
        """Whether the group of a dataset was sampled, shape (rows,) of bool."""
        out = np.zeros(len(self.times), dtype=bool)
        group = path[: path.rfind("/") + 1]
        for name, dataset in self.datasets.items():
            if name.startswith(group):
                rows = min(len(out), len(dataset.values))
                out[:rows] |= ~np.isnan(dataset.values[:rows]).all(axis=1)
        return out


def _load(h5: h5py.File) -> dict[str, HistoryDataset]:
    out: dict[str, HistoryDataset] = {}

    def visit(name: str, item: h5py.HLObject) -> None:
        if not isinstance(item, h5py.Dataset):
            return
        if item.ndim not in (1, 2):
            raise ValueError(f"{name} has {item.ndim} dimensions")
        text = item.attrs.get("dimension", b"-")
        dimension = text.decode("utf-8", "replace") if isinstance(text, bytes) else "-"
        values = item[()].astype(np.float64)
        out["/" + name] = HistoryDataset(values.reshape(len(values), -1), dimension.rstrip("\0"))

    h5.visititems(visit)
    return out
