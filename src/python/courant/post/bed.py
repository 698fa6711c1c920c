"""The bed under a plane flow: its height over x, from a number, an expression, a polyline or the scene's shells."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..diagnostics import Diagnostics, Location
from ..expressions import Formula
from ..fields import StateFiles, open_field, read_walls
from ..key_tables import keys as keys_of_map
from ..yaml_map import YamlMap, is_list, is_map
from .state import read_expression

_HINT = "for example 0.032, 0.1 * x, [[-1, 0.032], [0, 0.032], [0, 0], [2, 0]] or {parts: [11]}"

_BED = keys_of_map("bed", "parts list!")


@dataclass
class Bed:
    """Height of the bed over x. One of: `of`, an expression of x; `pieces`, (n, 4) x0, y0, x1, y1 [L], of which the highest at an x counts;
    `parts`: of shells whose traces become the pieces once the states are known."""

    of: Formula | None = None
    pieces: np.ndarray = field(default_factory=lambda: np.empty((0, 4)))
    parts: list[int] = field(default_factory=list)
    where: Location = field(default_factory=Location)

    @classmethod
    def read(cls, keys: YamlMap, key: str = "bed") -> Bed:
        """The level 0 if it is not there. Faults are reported."""
        node = keys.get(key)
        if node is None:
            return cls(Formula("0", ("x",)))
        if is_map(node):
            entry = keys.element(node, f"{keys.name}.{key}")
            entry.allow(*_BED)
            parts = [int(one) for one in entry.numbers("parts", required=True)]
            return cls(parts=parts, where=keys.where(node))
        if not is_list(node):
            of = read_expression(keys, node, key, ("x",))
            return cls(of if of.ok else Formula("0", ("x",)))
        points = [[keys.scalar(one, key) or 0.0 for one in point.value] if is_list(point) and len(point.value) == 2 else None for point in node.value]
        if len(points) < 2 or None in points:
            keys.error(node, f"'{keys.name}.{key}' must be two points or more of two numbers", _HINT)
            return cls(Formula("0", ("x",)))
        line = np.array(points)
        return cls(pieces=np.column_stack((line[:-1], line[1:])))

    @property
    def known(self) -> bool:
        return not self.parts or len(self.pieces) > 0

    def find(self, states: list[StateFiles], diagnostics: Diagnostics) -> None:
        """Takes the traces of the shells of its parts, which must be at rest. Faults are reported."""
        if not self.parts or not states:
            return
        first, last = (_traces(one, self.parts, diagnostics) for one in (states[0], states[-1]))
        if len(first) == 0:
            if diagnostics.ok:
                words = ", ".join(map(str, self.parts))
                diagnostics.error(self.where, f"the results have no shells of the parts {words} to be a bed", _HINT)
            return
        if first.shape != last.shape or np.abs(first - last).max() > 1e-5 * np.ptp(first, axis=0).max():
            diagnostics.error(self.where, "the shells that are to be the bed move", "give the bed as a polyline or an expression of x")
        self.pieces = first

    def under(self, x: np.ndarray, name: str, where: Location, diagnostics: Diagnostics) -> np.ndarray:
        """Height over x for an analysis that needs it everywhere: a gap is a fault."""
        bed = self.at(x)
        if np.isnan(bed).any():
            diagnostics.error(where, f"analysis '{name}': there is no bed at x = {x[np.isnan(bed)][0]:g}", "the bed must reach as far as 'x'")
        return bed

    def at(self, x: np.ndarray) -> np.ndarray:
        """Height over x, (n,) [L]; NaN where there is no bed. At an upright face the height is that of its top."""
        if self.of is not None:
            return self.of.over({"x": x}, len(x))
        out = np.full(len(x), -np.inf)
        x0, y0, x1, y1 = np.where((self.pieces[:, 0] <= self.pieces[:, 2])[:, None], self.pieces, self.pieces[:, [2, 3, 0, 1]]).T
        slack = 1e-6 * float(np.ptp(np.concatenate((x0, x1)))) if len(x0) else 0.0  # files have single precision
        order = np.argsort(x, kind="stable")
        begin, end = np.searchsorted(x[order], x0 - slack, "left"), np.searchsorted(x[order], x1 + slack, "right")
        for k in np.flatnonzero(end > begin):
            rows = order[begin[k] : end[k]]
            wide = x1[k] - x0[k] > slack
            height = y0[k] + (y1[k] - y0[k]) * np.clip((x[rows] - x0[k]) / (x1[k] - x0[k]), 0, 1) if wide else max(y0[k], y1[k])
            out[rows] = np.maximum(out[rows], height)
        return np.where(np.isfinite(out), out, np.nan)


def _traces(state: StateFiles, parts: list[int], diagnostics: Diagnostics) -> np.ndarray:
    """Traces of the shells of some parts, (shells, 4) [L]; none where the state has none."""
    file = open_field(state.shells, diagnostics) if state.shells else None
    if file is None:
        return np.empty((0, 4))
    walls = read_walls(state, diagnostics)
    if len(walls) == 0 or not file.has("CellData", "part"):
        return np.empty((0, 4))
    return walls[np.isin(file.values("CellData", "part", file.cells), parts)]
