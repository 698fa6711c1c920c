"""Points that are one."""
from __future__ import annotations

import numpy as np


class Merger:
    """Numbers of points; points closer than about `grain` get the same one."""

    def __init__(self, grain: float) -> None:
        self.grain, self.known, self.points = grain, dict[tuple[int, int, int], int](), list[np.ndarray]()

    def numbers(self, points: np.ndarray) -> np.ndarray:
        scaled = points / self.grain
        cells = (np.trunc(scaled) + np.where(np.abs(scaled - np.trunc(scaled)) >= 0.5, np.sign(scaled), 0)).astype(np.int64)
        out = np.empty(len(points), dtype=int)
        for k, (a, b, c) in enumerate(map(tuple, cells.tolist())):
            known = self.known.get((a, b, c))
            if known is None:  # a point may round to either side of a cell's border: the neighbours count, too
                known = next((self.known[cell] for n in range(27) if (cell := (a + n // 9 - 1, b + n // 3 % 3 - 1, c + n % 3 - 1)) in self.known), None)
            if known is None:
                known = self.known[a, b, c] = len(self.points)
                self.points.append(points[k])
            out[k] = known
        return out
