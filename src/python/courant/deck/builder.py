"""Decks written by a program: meshes as arrays, cards as rows of values."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..files import write_file

Value = int | float | str | None
Map = Callable[[np.ndarray], np.ndarray]


class Grid(NamedTuple):
    """A regular mesh. `points` (n, 3) [L]; `cells` (m, corners): rows of `points`; `unit` (n, dimensions): where a point is in the unit cube, square or
    line from which it was mapped."""

    points: np.ndarray
    cells: np.ndarray
    unit: np.ndarray

    def where(self, axis: int, value: float) -> np.ndarray:
        """Rows of the points with this coordinate in the unit cube, (k,)."""
        return np.flatnonzero(np.abs(self.unit[:, axis] - value) < 1e-9)

    def nearest(self, *point: float) -> int:
        """Row of the point nearest to coordinates in the unit cube."""
        return int(np.argmin(np.linalg.norm(self.unit - np.array(point), axis=1)))


_CORNERS: dict[int, list[tuple[int, ...]]] = {1: [(0,), (1,)], 2: [(0, 0), (1, 0), (1, 1), (0, 1)],
            3: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]}


def grid(counts: Sequence[int], to: Map | Sequence[float]) -> Grid:
    """Lines, quadrilaterals or hexahedra, so many along each direction, of the unit line, square or cube. `to` takes points there (n, dimensions) to
    their positions (n, 3) [L]; or it is the size along each axis [L]. Points count along the first direction first. Raises ValueError."""
    n = [int(count) for count in counts]
    if len(n) not in _CORNERS or min(n) < 1 or n != list(counts):
        raise ValueError(f"counts: one to three whole numbers of at least 1, not {list(counts)}")
    if not callable(to) and len(to) < len(n):
        raise ValueError(f"to: a size along each of {len(n)} directions, not {list(to)}")
    axes = np.meshgrid(*(np.linspace(0, 1, count + 1) for count in n), indexing="ij")
    unit = np.stack([axis.ravel(order="F") for axis in axes], axis=1)
    number = np.arange(len(unit)).reshape([count + 1 for count in n], order="F")
    cells = np.stack([number[tuple(slice(o, o + count) for o, count in zip(corner, n))].ravel(order="F") for corner in _CORNERS[len(n)]], axis=1)
    if callable(to):
        points = np.asarray(to(unit), dtype=float)
        if points.shape != (len(unit), 3):
            raise ValueError(f"to: positions of {len(unit)} points, ({len(unit)}, 3), not {points.shape}")
    else:
        points = np.zeros((len(unit), 3))
        points[:, : len(n)] = unit * np.array(to, dtype=float)[: len(n)]
    return Grid(points, cells, unit)


def join(*grids: Grid) -> Grid:
    """One mesh of several, or of one that closes: points nearer than 1e-7 of the whole are one."""
    points, starts = np.concatenate([g.points for g in grids]), np.cumsum([0, *(len(g.points) for g in grids)])
    key = np.round((points - points.min(axis=0)) / (1e-7 * np.ptp(points, axis=0).max())).astype(np.int64)
    _, first, to = np.unique(key, axis=0, return_index=True, return_inverse=True)
    cells = np.concatenate([g.cells + start for g, start in zip(grids, starts)])
    return Grid(points[first], to.ravel()[cells], np.concatenate([g.unit for g in grids])[first])


def _text(value: Value) -> str:
    if value is None:
        return ""
    if isinstance(value, (bool, np.bool_)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        if not np.isfinite(value):
            raise ValueError(f"cards take finite numbers, not {value}")
        return repr(float(value))
    return str(value)


_NODES_OF = {"SOLID": (4, 6, 8, 10), "TSHELL": (6, 8), "SHELL": (3, 4), "BEAM": (2, 3), "DISCRETE": (1, 2)}
"""How many nodes an element of a kind has; what comes behind _ in the name does not change it."""


class DeckBuilder:
    """Cards and meshes one after the other; `text()` is the deck. Values are separated by commas, so that no column counts."""

    def __init__(self, title: str, end: float) -> None:
        """`end`: ENDTIM [T], which may be changed later."""
        self.end = end
        self._lines = ["*KEYWORD", "*TITLE", title]
        self._nodes, self._elements, self._sets = 0, 0, 0

    def card(self, keyword: str, *rows: str | Sequence[Value]) -> DeckBuilder:
        """A keyword and its cards: texts as they are, values with commas between; None is blank."""
        if not keyword.startswith("*"):
            raise ValueError(f"keywords begin with '*': '*{keyword}'")
        self._lines.append(keyword)
        self._lines += [row if isinstance(row, str) else ",".join([*map(_text, row), ""]) for row in rows]  # a comma after one value, too
        return self

    def nodes(self, points: np.ndarray, first: Sequence[int] = ()) -> np.ndarray:
        """Adds nodes at positions (n, 3) [L]; their numbers, (n,). Rows `first` get the lowest ones, which then do not depend on the mesh. Raises
        ValueError."""
        points = np.asarray(points, dtype=float)
        if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
            raise ValueError(f"points: finite positions, (n, 3), not {points.shape}")
        order = np.concatenate([np.asarray(first, dtype=int), np.setdiff1d(np.arange(len(points)), first)]).astype(int)
        ids = np.empty(len(points), dtype=int)
        ids[order] = self._nodes + 1 + np.arange(len(points))
        self._nodes += len(points)
        self.card("*NODE", *([int(ids[k]), *map(float, points[k])] for k in order))
        return ids

    def elements(self, kind: str, part: int, nodes: np.ndarray) -> np.ndarray:
        """Adds elements of `kind` ("SOLID", "TSHELL", "SHELL", "BEAM", "DISCRETE") with these numbers of nodes, (m, corners); their numbers, (m,).
        Raises ValueError."""
        counts = _NODES_OF.get(kind.partition("_")[0])
        if counts is None:
            raise ValueError(f"kind: one of {', '.join(_NODES_OF)}, not {kind!r}")
        nodes = np.asarray(nodes)
        if nodes.ndim != 2 or nodes.shape[1] not in counts:
            raise ValueError(f"nodes: {' or '.join(map(str, counts))} numbers for each {kind}, not {nodes.shape}")
        if nodes.size and not 1 <= nodes.min() <= nodes.max() <= self._nodes:
            raise ValueError(f"nodes: numbers from 1 to {self._nodes}, as `nodes` has given them, not {nodes.min()} to {nodes.max()}")
        ids = self._elements + 1 + np.arange(len(nodes))
        self._elements += len(nodes)
        self.card(f"*ELEMENT_{kind}", *([int(i), part, *map(int, row)] for i, row in zip(ids, nodes)))
        return ids

    def mesh(self, kind: str, part: int, of: Grid, first: Sequence[int] = ()) -> np.ndarray:
        """Nodes and elements of a grid; numbers of its nodes, (n,); `first` as of `nodes`."""
        ids = self.nodes(of.points, first)
        self.elements(kind, part, ids[of.cells])
        return ids

    def particles(self, part: int, points: np.ndarray, masses: np.ndarray | float, pressures: np.ndarray | None = None) -> np.ndarray:
        """Adds particles at positions (n, 3) [L] with their masses [M], of a plane flow per unit of depth, and pressures at the start, (n,) [M/LT2];
        their numbers, (n,)."""
        ids = self.nodes(points)
        self.card("*ELEMENT_SPH", *([int(i), part, float(m)] for i, m in zip(ids, np.broadcast_to(masses, len(ids)))))
        if pressures is not None:
            self.card("*INITIAL_STRESS_SPH", *([int(i), *[-float(p)] * 3] for i, p in zip(ids, pressures)))
        return ids

    def node_set(self, ids: np.ndarray) -> int:
        """Its number."""
        self._sets += 1
        self.card("*SET_NODE_LIST", [self._sets], *([int(i) for i in ids[k : k + 8]] for k in range(0, len(ids), 8)))
        return self._sets

    def hold(self, ids: np.ndarray, directions: str) -> DeckBuilder:
        """Holds nodes in "x", "y", "z", and against turns "X", "Y", "Z". Raises ValueError."""
        if not directions or set(directions) - set("xyzXYZ"):
            raise ValueError(f"directions: letters of xyzXYZ, not {directions!r}")
        return self.card("*BOUNDARY_SPC_SET", [self.node_set(ids), 0, *(int(d in directions) for d in "xyzXYZ")])

    def gravity(self, g: float, curve: int = 91) -> DeckBuilder:
        """Along -z from the start on, by a curve of this number. [L/T2]"""
        self.curve(curve, [(0.0, 1.0), (1e6, 1.0)])
        return self.card("*LOAD_BODY_Z", [curve, g])

    def curve(self, number: int, points: Sequence[tuple[float, float]]) -> int:
        """*DEFINE_CURVE; its number."""
        self.card("*DEFINE_CURVE", [number], *points)
        return number

    def settle(self, omega: float, number: int = 90, periods: float = 12.0) -> DeckBuilder:
        """Damping of a structure of lowest frequency `omega` [1/T], a curve (its number) that rises smoothly to 1 in a third of the time, and an end that
        leaves 1e-4 of a motion."""
        self.end = 1.5 * periods / omega
        t = np.linspace(0, self.end / 3, 21)
        self.curve(number, [*((float(a), 0.5 - 0.5 * float(np.cos(np.pi * a / t[-1]))) for a in t), (2 * self.end, 1.0)])
        return self.card("*DAMPING_GLOBAL", [0, 2 * omega])

    def load(self, ids: np.ndarray, direction: int, force: float, weights: np.ndarray | None = None, number: int = 90) -> DeckBuilder:
        """A force in all [ML/T2], shared by nodes, along 1, 2 or 3, by a curve of this number."""
        share = np.full(len(ids), 1 / len(ids)) if weights is None else weights / weights.sum()
        return self.card("*LOAD_NODE_POINT", *([int(n), direction, number, float(force * w)] for n, w in zip(ids, share)))

    def history(self, ids: Sequence[int] | np.ndarray, interval: float) -> DeckBuilder:
        """Motion of nodes, energies and others at an interval [T]."""
        self.card("*DATABASE_HISTORY_NODE", *([int(i) for i in ids[k : k + 8]] for k in range(0, len(ids), 8)))
        self.card("*DATABASE_NODOUT", [interval])
        return self.card("*DATABASE_GLSTAT", [interval])

    def text(self) -> str:
        return "\n".join([*self._lines, "*CONTROL_TERMINATION", f"{float(self.end)!r},", "*END", ""])

    def write(self, file: str | PathLike[str]) -> Path:
        """Raises OutputError."""
        path = Path(file)
        write_file(path, self.text())
        return path
