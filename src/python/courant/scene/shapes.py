"""Surfaces of triangles in space and polylines in the plane: what is inside, how much it holds, and the shells that they become."""
from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

_SHIFTS = ((1.234567e-7, 2.345678e-7), (-3.1415926e-7, 1.4142135e-7), (2.7182818e-7, -1.7320508e-7))  # of rays, so that they meet no edge, of the size


class ShapeFault(Exception):
    """Why there is no shape, and what to do."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.hint = message, hint


@dataclass
class Shape:
    """`points`: shape (n, 3) [L]; `faces`: numbers of the points of each face, three in space, two in the plane; `dim`: 3 or 2."""

    points: np.ndarray
    faces: np.ndarray
    dim: int
    name: str = ""
    ground: bool = False  # all below is solid, too
    mesh: float = 0.0  # largest side of shells in the plane; 0: the faces as they are [L]
    notes: list[str] = field(default_factory=list)  # what was repaired

    @property
    def low(self) -> np.ndarray:
        return np.asarray(self.points.min(axis=0))

    @property
    def high(self) -> np.ndarray:
        return np.asarray(self.points.max(axis=0))

    def volume(self) -> float:
        """Of a closed shape whose normals point outwards [L3]; in the plane its area."""
        return float(self._moments()[0])

    def inertia(self, density: float) -> tuple[float, np.ndarray, np.ndarray]:
        """Mass [M], centre (3,) [L] and tensor of inertia about it (3, 3) [ML2] of a closed shape; in the plane per unit of depth, from z = -0.5 to 0.5."""
        volume, first, second = self._moments()
        centre = first / volume
        second = second - volume * np.outer(centre, centre)
        return density * volume, centre, density * (np.trace(second) * np.eye(3) - second)

    def _moments(self) -> tuple[float, np.ndarray, np.ndarray]:
        """Integrals of 1, x and x x over the shape: sums over the simplices between an inner point and the faces."""
        middle = (self.low + self.high) / 2
        corners = self.points[self.faces] - middle
        if self.dim == 3:
            share = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
        else:
            share = (corners[:, 0, 0] * corners[:, 1, 1] - corners[:, 0, 1] * corners[:, 1, 0]) / 2
        n = self.dim + 1  # corners of a simplex, one at the middle
        total = corners.sum(axis=1)
        volume = float(share.sum())
        first = np.einsum("i,ij->j", share, total) / n
        second = (np.einsum("i,ij,ik->jk", share, total, total) + np.einsum("i,icj,ick->jk", share, corners, corners)) / (n * (n + 1))
        if self.dim == 2:
            second[2, 2] = volume / 12
        moved = second + np.outer(middle, first) + np.outer(first, middle) + volume * np.outer(middle, middle)
        return volume, first + volume * middle, moved

    def contains(self, x: np.ndarray, margin: float = 0.0) -> np.ndarray:
        """Which points (n, 3) are inside, or nearer to it than `margin` along an axis [L]; of ground, also those below. Shape (n,)."""
        inside = self._inside(x)
        for axis in range(self.dim if margin > 0 else 0):
            for sign in (-1, 1):
                some = np.flatnonzero(~inside)
                moved = x[some].copy()
                moved[:, axis] += sign * margin
                inside[some] = self._inside(moved)
        return inside

    def _inside(self, x: np.ndarray) -> np.ndarray:
        """Rays upwards meet the surface an odd number of times; all points over each other share one."""
        up = self.dim - 1
        near = np.all((x[:, :up] >= self.low[:up]) & (x[:, :up] <= self.high[:up]), axis=1) & (x[:, up] <= self.high[up])
        near &= self.ground | (x[:, up] >= self.low[up])
        out = np.zeros(len(x), dtype=bool)
        if not near.any():
            return out
        feet, column = _unique_rows(x[near][:, :up])
        heights = x[near][:, up]
        odd = np.zeros(len(feet), dtype=bool)
        size = float(np.max(self.high - self.low))
        for shift in _SHIFTS:
            column_of, height_of = self._crossings(feet + size * np.array(shift[:up]))
            odd = np.bincount(column_of, minlength=len(feet)) % 2 == 1
            if self.ground or not odd.any():
                break
        # crossings above each point: of its column, less those below it
        order = np.lexsort((height_of, column_of))
        column_of, height_of = column_of[order], height_of[order]
        low, span = self.low[up] - size, 3 * size
        keys = column_of + np.clip((height_of - low) / span, 0, 1 - 1e-12)
        ends = np.searchsorted(column_of, np.arange(len(feet)), side="right")
        above = ends[column] - np.searchsorted(keys, column + np.clip((heights - low) / span, 0, 1 - 1e-12), side="right")
        out[near] = above % 2 == 1
        return out

    def _crossings(self, feet: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where rays upwards from these feet meet faces: number of the foot and the height, both (k,)."""
        up = self.dim - 1
        corners = self.points[self.faces]
        low, high = corners[:, :, 0].min(axis=1), corners[:, :, 0].max(axis=1)
        order = np.argsort(feet[:, 0], kind="stable")
        sorted_x = feet[order, 0]
        begin, end = np.searchsorted(sorted_x, low), np.searchsorted(sorted_x, high, side="right")
        found: list[tuple[np.ndarray, np.ndarray]] = []
        count = end - begin
        bounds = np.searchsorted(np.cumsum(count), np.arange(0, count.sum() + 4_000_000, 4_000_000))
        for first, last in zip([0, *bounds[1:]], [*bounds[1:], len(count)]):  # so many pairs at once
            if last > first:
                faces = np.repeat(np.arange(first, last), count[first:last])
                slots = np.arange(len(faces)) - np.repeat(np.cumsum(count[first:last]) - count[first:last], count[first:last]) + begin[faces]
                found.append(_meet(corners, faces, feet, order[slots], up))
        columns, heights = zip(*found) if found else ((np.zeros(0, dtype=int),), (np.zeros(0),))
        return np.concatenate(columns), np.concatenate(heights)

    # the shells of a wall

    def nodes(self) -> np.ndarray:
        if self.dim == 3:
            return self.points
        edge = np.concatenate([self._pieces(face)[0] for face in self.faces])
        front, back = edge.copy(), edge.copy()
        front[:, 2], back[:, 2] = -0.5, 0.5
        return np.concatenate([front, back])

    def shells(self) -> np.ndarray:
        if self.dim == 3:
            return np.column_stack([self.faces, self.faces[:, 2]])
        out, begin = [], 0
        counts = [self._pieces(face)[1] for face in self.faces]
        total = sum(counts) + len(counts)
        for n in counts:
            a = begin + np.arange(n)
            out.append(np.stack([a, a + 1, a + 1 + total, a + total], axis=1))
            begin += n + 1
        return np.concatenate(out)

    def _pieces(self, face: np.ndarray) -> tuple[np.ndarray, int]:
        a, b = self.points[face]
        length = float(np.linalg.norm(b - a))
        n = max(1, int(np.ceil(length / self.mesh - 1e-6))) if self.mesh > 0 else 1
        return a + (b - a) * (np.arange(n + 1) / n)[:, None], n

    @property
    def side(self) -> float:
        lengths = [np.linalg.norm(self.points[self.faces[:, k]] - self.points[self.faces[:, k - 1]], axis=1).min() for k in range(self.faces.shape[1])]
        return float(min(lengths)) if self.mesh <= 0 else min(float(min(lengths)), self.mesh)


def _unique_rows(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distinct rows, and the number of each row's among them."""
    code = np.zeros(len(x), dtype=np.int64)
    for column in x.T:
        values, number = np.unique(column, return_inverse=True)
        code = code * len(values) + number.ravel()
    _, first, which = np.unique(code, return_index=True, return_inverse=True)
    return x[first], which.ravel()


def _meet(corners: np.ndarray, faces: np.ndarray, feet: np.ndarray, at: np.ndarray, up: int) -> tuple[np.ndarray, np.ndarray]:
    """Of pairs of a face and a foot those that meet, and the heights."""
    c, p = corners[faces], feet[at]
    if up == 1:
        a, b = c[:, 0], c[:, 1]
        meets = (a[:, 0] > p[:, 0]) != (b[:, 0] > p[:, 0])
        a, b, p = a[meets], b[meets], p[meets]
        return at[meets], a[:, 1] + (b[:, 1] - a[:, 1]) * (p[:, 0] - a[:, 0]) / (b[:, 0] - a[:, 0])
    kept = np.flatnonzero((c[:, :, 1].min(axis=1) <= p[:, 1]) & (c[:, :, 1].max(axis=1) >= p[:, 1]))
    c, p, at = c[kept], p[kept], at[kept]

    def twice(i: int, j: int) -> np.ndarray:
        return (c[:, i, 0] - p[:, 0]) * (c[:, j, 1] - p[:, 1]) - (c[:, j, 0] - p[:, 0]) * (c[:, i, 1] - p[:, 1])

    w = np.stack([twice(1, 2), twice(2, 0), twice(0, 1)], axis=1)
    meets = np.all(w > 0, axis=1) | np.all(w < 0, axis=1)
    w, c = w[meets], c[meets]
    return at[meets], np.einsum("ij,ij->i", w, c[:, :, 2]) / w.sum(axis=1)


# shapes made here


def box(low: np.ndarray, high: np.ndarray, dim: int) -> Shape:
    """Its six sides in space, its four in the plane."""
    if dim == 2:
        return polyline(np.array([[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]]), closed=True)
    corners = np.array([[(low, high)[k >> a & 1][a] for a in range(3)] for k in range(8)], dtype=float)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return Shape(corners, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]), 3)


def cylinder(base: np.ndarray, top: np.ndarray, radius: float, side: float) -> Shape:
    """Closed, its sides as long as `side` at most and twelve at least [L]."""
    axis = (top - base) / np.linalg.norm(top - base)
    first = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    first /= np.linalg.norm(first)
    n = max(12, int(np.ceil(2 * np.pi * radius / side)))
    angle = 2 * np.pi * np.arange(n) / n
    fit = radius * np.sqrt((2 * np.pi / n) / np.sin(2 * np.pi / n))  # the polygon has the area of the circle
    ring = fit * (np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * np.cross(axis, first))
    k, after = np.arange(n), np.roll(np.arange(n), -1)
    sides = [np.stack([k, after, after + n], axis=1), np.stack([k, after + n, k + n], axis=1)]
    ends = [np.stack([np.full(n, 2 * n), after, k], axis=1), np.stack([np.full(n, 2 * n + 1), k + n, after + n], axis=1)]
    return Shape(np.concatenate([base + ring, top + ring, base[None], top[None]]), np.concatenate([*sides, *ends]), 3)


def sphere(centre: np.ndarray, radius: float, side: float, dim: int) -> Shape:
    """A circle in the plane. The polygon or polyhedron has its area or volume."""
    if dim == 2:
        n = max(12, int(np.ceil(2 * np.pi * radius / side)))
        fit = radius * np.sqrt((2 * np.pi / n) / np.sin(2 * np.pi / n))
        angle = 2 * np.pi * np.arange(n) / n
        return polyline(centre[:2] + fit * np.column_stack([np.cos(angle), np.sin(angle)]), closed=True)
    m = max(6, int(np.ceil(np.pi * radius / side)))
    n = 2 * m
    theta = np.pi * np.arange(1, m) / m
    phi = 2 * np.pi * np.arange(n) / n
    rings = np.stack([np.outer(np.sin(theta), np.cos(phi)), np.outer(np.sin(theta), np.sin(phi)), np.outer(np.cos(theta), np.ones(n))], axis=2)
    points = np.concatenate([rings.reshape(-1, 3), [[0, 0, 1.0], [0, 0, -1.0]]])
    k, after = np.arange(n), np.roll(np.arange(n), -1)
    faces = [np.stack([np.full(n, len(points) - 2), k, after], axis=1)]
    for ring in range(m - 2):
        a, b = ring * n, (ring + 1) * n
        faces += [np.stack([a + k, b + k, b + after], axis=1), np.stack([a + k, b + after, a + after], axis=1)]
    last = (m - 2) * n
    faces.append(np.stack([np.full(n, len(points) - 1), last + after, last + k], axis=1))
    unit = Shape(points, np.concatenate(faces), 3)
    return Shape(centre + points * radius * (4 / 3 * np.pi / unit.volume()) ** (1 / 3), unit.faces, 3)


def polyline(xy: np.ndarray, closed: bool) -> Shape:
    """Through points (n, 2) or (n, 3); closed ones turn to the left."""
    xy = np.asarray(xy, dtype=float)[:, :2]
    size = float(np.max(np.ptp(xy, axis=0))) if len(xy) else 0.0
    keep = np.ones(len(xy), dtype=bool)
    keep[1:] = np.linalg.norm(np.diff(xy, axis=0), axis=1) > 1e-9 * size
    xy = xy[keep]
    if closed and len(xy) > 1 and np.linalg.norm(xy[0] - xy[-1]) <= 1e-6 * size:
        xy = xy[:-1]
    points = np.column_stack([xy, np.zeros(len(xy))])
    k = np.arange(len(xy))
    faces = np.column_stack([k, np.roll(k, -1)]) if closed else np.column_stack([k[:-1], k[1:]])
    shape = Shape(points, faces, 2)
    if closed and shape.volume() < 0:
        shape.faces = faces[:, ::-1].copy()
    return shape


def plate(origin: np.ndarray, edge1: np.ndarray, edge2: np.ndarray) -> Shape:
    points = np.array([origin, origin + edge1, origin + edge1 + edge2, origin + edge2])
    return Shape(points, np.array([[0, 1, 2], [0, 2, 3]]), 3)


def merged(shape: Shape, tolerance: float) -> Shape:
    """Points nearer to each other than `tolerance` of the size become one; faces that vanish with them go."""
    size = float(np.max(shape.high - shape.low)) or 1.0
    cells = np.round((shape.points - shape.low) / (tolerance * size)).astype(np.int64)
    _, first, number = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    faces = number.ravel()[shape.faces]
    good = np.all(np.sort(faces, axis=1)[:, 1:] != np.sort(faces, axis=1)[:, :-1], axis=1)
    _, once = np.unique(np.sort(faces[good], axis=1), axis=0, return_index=True)  # faces that stand twice
    kept = np.flatnonzero(good)[np.sort(once)]
    out = Shape(shape.points[first], faces[kept], shape.dim, shape.name, shape.ground, shape.mesh, list(shape.notes))
    if len(first) < len(shape.points):
        out.notes.append(f"{len(shape.points) - len(first)} duplicate vertices merged")
    if len(kept) < len(shape.faces):
        out.notes.append(f"{len(shape.faces) - len(kept)} faces without area, or that stood twice, left out")
    return out


def refined(shape: Shape, size: float) -> Shape:
    """The same surface of triangles with no side longer than `size` [L]: the longest side of a face is halved, alike in both its faces, until there
    are none. By Rivara angles do not fall below half of the first ones."""
    points, faces = shape.points, shape.faces
    while True:
        sides = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        edges, of_side = np.unique(sides, axis=0, return_inverse=True)
        of_side, length = of_side.reshape(-1, 3), np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
        turn = (np.argmax(length[of_side], axis=1)[:, None] + np.arange(3)) % 3  # the longest side first
        faces, of_side = np.take_along_axis(faces, turn, axis=1), np.take_along_axis(of_side, turn, axis=1)
        long = np.zeros(len(edges), dtype=bool)
        long[of_side[:, 0]] = length[of_side[:, 0]] > size
        while not long[also := of_side[long[of_side].any(axis=1), 0]].all():
            long[also] = True
        if not long.any():
            return replace(shape, points=points, faces=faces)
        (a, b, c), (ab, bc, ca) = faces.T, np.where(long, len(points) + np.cumsum(long) - 1, -1)[of_side].T
        points = np.concatenate([points, points[edges[long]].mean(axis=1)])
        none, p, q = ab < 0, (ab >= 0) & (ca >= 0), (ab >= 0) & (bc >= 0)
        parts = [((a, b, c), none), ((a, ab, ca), p), ((ca, ab, c), p), ((a, ab, c), ~none & ~p), ((ab, b, bc), q), ((ab, bc, c), q), ((ab, b, c), ~none & ~q)]
        faces = np.concatenate([np.stack(corners, axis=1)[some] for corners, some in parts])


def shrunk(shape: Shape, depth: float) -> Shape:
    """A closed surface of triangles whose faces are moved inwards by `depth` [L], as far as their corners allow."""
    corners = shape.points[shape.faces]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal = area / np.linalg.norm(area, axis=1)[:, None]
    matrix, side = np.zeros((len(shape.points), 3, 3)), np.zeros((len(shape.points), 3))
    for k in range(3):  # least squares: n d = -depth of all faces around a point
        np.add.at(matrix, shape.faces[:, k], normal[:, :, None] * normal[:, None, :])
        np.add.at(side, shape.faces[:, k], -depth * normal)
    by = np.einsum("pab,pb->pa", np.linalg.pinv(matrix, rcond=1e-3, hermitian=True), side)
    by *= np.minimum(1.0, 2 * depth / np.maximum(np.linalg.norm(by, axis=1), 1e-300))[:, None]
    return replace(shape, points=shape.points + by)


@dataclass
class Edges:
    """Edges that keep a surface from being closed."""

    free: np.ndarray  # with one face: numbers of their points, (k, 2)
    crowded: np.ndarray  # with three faces or more, (k, 2)


def faulty_edges(shape: Shape) -> Edges:
    """In the plane: points that do not end two lines, as pairs of themselves."""
    if shape.dim == 2:
        count = np.bincount(shape.faces.ravel(), minlength=len(shape.points))
        free, crowded = np.flatnonzero(count == 1), np.flatnonzero(count > 2)
        return Edges(np.column_stack([free, free]), np.column_stack([crowded, crowded]))
    edges = np.sort(np.concatenate([shape.faces[:, [0, 1]], shape.faces[:, [1, 2]], shape.faces[:, [2, 0]]]), axis=1)
    which, count = np.unique(edges, axis=0, return_counts=True)
    return Edges(which[count == 1], which[count > 2])


def holes(shape: Shape, edges: np.ndarray) -> list[tuple[np.ndarray, float, int]]:
    """Connected groups of edges: centre (3,), size [L] and number of edges, the largest first."""
    group = {int(p): int(p) for p in np.unique(edges)}

    def root(p: int) -> int:
        while group[p] != p:
            group[p] = group[group[p]]
            p = group[p]
        return p

    for a, b in edges.tolist():
        group[root(a)] = root(b)
    roots = np.array([root(int(p)) for p in edges[:, 0]])
    out = []
    for one in np.unique(roots):
        x = shape.points[np.unique(edges[roots == one])]
        out.append((x.mean(axis=0), float(np.linalg.norm(np.ptp(x, axis=0))), int((roots == one).sum())))
    return sorted(out, key=lambda hole: -hole[1])


def _is_within(x: np.ndarray, others: Shape) -> bool:
    """Whether the points (n, 3) of a closed surface are within others. Raises ShapeFault where some clearly are and some are not."""
    inside = others.contains(x)
    if inside.any() and not inside.all():
        size = 1e-4 * float(np.max(others.high - others.low))
        deep = inside.copy()
        for axis in range(3):
            for sign in (-size, size):
                deep &= others.contains(x + sign * np.eye(3)[axis])
        if deep.any() and not others.contains(x, size).all():
            at = x[np.argmax(deep)]
            raise ShapeFault(f"closed surfaces overlap at x = {at[0]:.4g}, y = {at[1]:.4g}, z = {at[2]:.4g}: inside and outside are not clear there",
                             "unite overlapping bodies in the program that made the file, or give each as a shape of its own")
    return bool(inside[0])


def oriented(shape: Shape) -> Shape:
    """A closed surface with all normals outwards: faces turn like their neighbours; closed parts within others are cavities. Raises ShapeFault."""
    if shape.dim == 2:
        return shape
    faces = shape.faces.copy()
    sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    owner = np.tile(np.arange(len(faces)), 3)
    order = np.lexsort(np.sort(sides, axis=1).T[::-1])
    pairs = order.reshape(-1, 2) if len(order) % 2 == 0 else order[:-1].reshape(-1, 2)
    same = sides[pairs[:, 0], 0] == sides[pairs[:, 1], 0]  # neighbours that run along their edge alike: one of them is turned
    neighbours: list[list[tuple[int, bool]]] = [[] for _ in faces]
    for (a, b), turned in zip(owner[pairs].tolist(), same.tolist()):
        neighbours[a].append((b, turned))
        neighbours[b].append((a, turned))
    state = np.full(len(faces), -1)
    body = np.zeros(len(faces), dtype=int)
    for start in range(len(faces)):
        if state[start] >= 0:
            continue
        state[start], stack = 0, [start]
        body[start] = start
        while stack:
            a = stack.pop()
            for b, turned in neighbours[a]:
                if state[b] < 0:
                    state[b], body[b] = state[a] ^ turned, start
                    stack.append(b)
    turn = state == 1
    faces[turn] = faces[turn][:, ::-1]
    for one in np.unique(body):
        part = body == one
        cavity = not part.all() and _is_within(shape.points[np.unique(faces[part])], Shape(shape.points, faces[~part], 3))
        if (Shape(shape.points, faces[part], 3).volume() < 0) != cavity:
            faces[part] = faces[part][:, ::-1]
    turned = int(np.any(faces != shape.faces, axis=1).sum())
    notes = [*shape.notes, f"{turned} of {len(faces)} faces turned, so that normals point outwards"] if turned else list(shape.notes)
    return Shape(shape.points, faces, 3, shape.name, shape.ground, shape.mesh, notes)
