"""Polygons in space as triangles and quadrangles."""
from __future__ import annotations

import numpy as np

_TINY = 1e-9  # of the area of a polygon, or of the square of its size


def triangulated(points: np.ndarray, polygons: list[list[int]]) -> tuple[dict[str, tuple[np.ndarray, np.ndarray]], int | None]:
    """Triangles and convex quadrangles that cover polygons, convex or not. `points` (n, 3) [L]; `polygons`: numbers of their corners. By name of the
    cell, `triangle` or `quad`: corners (m, 3 or 4) and the polygon of each (m,), in their order; and the first polygon whose sides cross, else None."""
    sizes = np.array([len(one) for one in polygons], dtype=int)
    parts = [(np.zeros((0, n), dtype=int), np.zeros(0, dtype=int)) for n in (3, 4)]
    crossed: list[int] = []
    for n in np.unique(sizes).tolist():
        owner = np.flatnonzero(sizes == n)
        corners = np.array([polygons[k] for k in owner])
        x = points[corners]
        fan = _is_fan(x)
        quad = fan & _is_fan(np.roll(x, 1, axis=1)) & (n == 4)
        parts.append((corners[quad], owner[quad]))
        fan &= ~quad
        parts += [(corners[fan][:, [0, k, k + 1]], owner[fan]) for k in range(1, n - 1)]
        for k in np.flatnonzero(~fan & ~quad):
            has_area = np.linalg.norm(_normal(x[k : k + 1])) > _TINY * float(np.ptp(x[k], axis=0).max()) ** 2
            ears = _ears(_in_its_plane(x[k])) if has_area else None  # both halves of a bow tie are as large
            crossed += [] if ears is not None else [int(owner[k])]
            parts += [] if ears is None else [(corners[k][ears], np.full(len(ears), owner[k]))]
    made = {}
    for name, n in (("triangle", 3), ("quad", 4)):
        corners, owner = (np.concatenate(one) for one in zip(*(part for part in parts if part[0].shape[1] == n)))
        order = np.argsort(owner, kind="stable")
        made[name] = corners[order], owner[order]
    return made, min(crossed, default=None)


def _normal(x: np.ndarray) -> np.ndarray:
    """Twice the area of polygons (m, n, 3) along their normals, (m, 3) [L2]."""
    x = x - x[:, :1]
    return np.asarray(np.cross(x, np.roll(x, -1, axis=1)).sum(axis=1))


def _is_fan(x: np.ndarray) -> np.ndarray:
    """Whether the triangles from the first corner of polygons (m, n, 3) to their sides cover each once, (m,): they do where all turn as the polygon does,
    for their number over a point is its winding number. Also where there is no area to cover."""
    normal, size = _normal(x), np.ptp(x, axis=1).max(axis=1)
    whole = np.einsum("mi,mi->m", normal, normal)
    triangles = np.cross(x[:, 1:-1] - x[:, :1], x[:, 2:] - x[:, :1])
    of_triangles = np.einsum("mki,mi->mk", triangles, normal)
    flat = np.linalg.norm(triangles, axis=2).max(axis=1) <= _TINY * size**2
    return np.asarray((of_triangles > _TINY * whole[:, None]).all(axis=1) | flat | (x.shape[1] == 3))


def _in_its_plane(x: np.ndarray) -> np.ndarray:
    """A polygon (n, 3) seen against its normal, where it turns to the left, (n, 2) [L]."""
    normal = _normal(x[None])[0]
    first = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    axes = np.stack([first, np.cross(normal, first)], axis=1)
    return np.asarray((x - x[0]) @ (axes / np.linalg.norm(axes, axis=0)))


def _ears(x: np.ndarray) -> np.ndarray | None:
    """Triangles of a polygon (n, 2) that turns to the left, (n - 2, 3); None where it crosses itself. A corner is cut off where no other one is in its
    triangle, the one nearest to an equilateral triangle first."""
    n = len(x)
    before, after, alive = np.roll(np.arange(n), 1), np.roll(np.arange(n), -1), np.ones(n, dtype=bool)
    tiny = _TINY * float(np.ptp(x, axis=0).max()) ** 2

    def turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
        return np.asarray((b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0]))

    def shape_of(k: int) -> float:
        """Of the triangle at a corner, twice its area over the square of its longest side; 0 where it cannot be cut off."""
        a, b, c = x[before[k]], x[k], x[after[k]]
        area = float(turn(a, b, c))
        if not alive[k] or area <= tiny:
            return 0.0
        others = x[alive]
        others = others[(others != a).any(axis=1) & (others != b).any(axis=1) & (others != c).any(axis=1)]  # a hole hangs on two sides at the same points
        if ((turn(a, b, others) > -tiny) & (turn(b, c, others) > -tiny) & (turn(c, a, others) > -tiny)).any():
            return 0.0
        return area / max(float(side @ side) for side in (b - a, c - b, a - c))

    found: list[list[int]] = []
    shapes = np.array([shape_of(k) for k in range(n)])
    while len(found) < n - 3:
        k = int(np.argmax(shapes))
        if not shapes[k] > 0:
            shapes = np.array([shape_of(k) for k in range(n)])  # a corner within another triangle may be gone
            k = int(np.argmax(shapes))
            if not shapes[k] > 0:
                return None
        found.append([int(before[k]), k, int(after[k])])
        alive[k], shapes[k] = False, 0.0
        after[before[k]], before[after[k]] = after[k], before[k]
        for near in (int(before[k]), int(after[k])):
            shapes[near] = shape_of(near)
    k = int(np.argmax(alive))
    last = [int(before[k]), k, int(after[k])]
    return np.array([*found, last]) if turn(*x[last]) > -tiny else None
