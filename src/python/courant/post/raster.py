"""Pictures of particles, faces and lines by a depth buffer in numpy: no screen, no GPU."""

from __future__ import annotations

import numpy as np

LIGHT = np.array([-0.35, 0.55, 0.76])  # in the picture's axes: from the upper left, behind the eye
LIGHT /= np.sqrt((LIGHT**2).sum())
_MANY, _SMALL = 20000, 6.0  # faces from which on those of less than so many pixels are drawn together
_AMBIENT = 0.78  # of the brightness, so that colours stay those of the colour bar


class Raster:
    """A picture with a depth buffer. `colour`: (height, width, 3) in 0 to 1, row 0 on top; `depth`: (height, width) toward the eye [L],
    -inf where there is nothing. Pixel (row, column) has its centre at u = left + (column + 1/2) / scale, v = top - (row + 1/2) / scale."""

    def __init__(self, left: float, top: float, width: int, height: int, scale: float) -> None:
        self.left, self.top, self.scale = left, top, scale  # scale: [pixels/L]
        self.colour = np.ones((height, width, 3), dtype=np.float32)
        self.depth = np.full((height, width), -np.inf)
        self.lit = np.zeros((height, width), dtype=bool)  # pixels of solid bodies, which get shadows

    @property
    def size(self) -> tuple[int, int]:
        """Height and width [pixels]."""
        return self.depth.shape[0], self.depth.shape[1]

    def pixels(self, uvw: np.ndarray) -> np.ndarray:
        """(n, 3) projected [L] -> column, row [pixels], and depth as it is [L]."""
        return np.column_stack(((uvw[:, 0] - self.left) * self.scale, (self.top - uvw[:, 1]) * self.scale, uvw[:, 2]))

    def spheres(self, uvw: np.ndarray, radius: np.ndarray, colour: np.ndarray) -> None:
        """Shaded spheres. uvw: (n, 3), radius: (n,) [L]; colour: (n, 3)."""
        height, width = self.size
        order = np.argsort(uvw[:, 2], kind="stable")  # of those that meet in a pixel the last one, the nearest, is kept
        at, r, colour = self.pixels(uvw[order]), radius[order], colour[order].astype(np.float32)
        reach = np.maximum(r * self.scale, 0.71)  # no sphere falls between pixels
        column, row = np.floor(at[:, 0]).astype(int), np.floor(at[:, 1]).astype(int)
        most = int(np.ceil(reach.max(initial=0.0)))
        for dr in range(-most, most + 1):
            for dc in range(-most, most + 1):
                p, q = column + dc, row + dr
                x, y = (p + 0.5 - at[:, 0]) / reach, (at[:, 1] - q - 0.5) / reach
                z2 = 1 - x * x - y * y
                seen = np.flatnonzero((z2 > 0) & (p >= 0) & (p < width) & (q >= 0) & (q < height))
                z = np.sqrt(z2[seen])
                depth = at[seen, 2] + r[seen] * z
                nearer = depth > self.depth[q[seen], p[seen]]
                seen, z, depth = seen[nearer], z[nearer], depth[nearer]
                shine = _AMBIENT + (1 - _AMBIENT) * np.clip(LIGHT[0] * x[seen] + LIGHT[1] * y[seen] + LIGHT[2] * z, 0, 1)
                self.depth[q[seen], p[seen]] = depth
                self.colour[q[seen], p[seen]] = colour[seen] * shine[:, None].astype(np.float32)
                self.lit[q[seen], p[seen]] = True

    def _cover(self, corners: np.ndarray) -> tuple[tuple[slice, slice], np.ndarray, np.ndarray] | None:
        """Rows and columns around a triangle, the weights of its corners there (3, rows, columns), and which pixels are inside."""
        height, width = self.size
        low, high = np.floor(corners[:, :2].min(axis=0)).astype(int), np.ceil(corners[:, :2].max(axis=0)).astype(int)
        c0, r0, c1, r1 = max(low[0], 0), max(low[1], 0), min(high[0], width), min(high[1], height)
        (ax, ay), (bx, by), (cx, cy) = corners[:, :2]
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if c0 >= c1 or r0 >= r1 or abs(area) < 1e-12:
            return None
        x, y = np.arange(c0, c1) + 0.5, (np.arange(r0, r1) + 0.5)[:, None]
        weight = np.empty((3, r1 - r0, c1 - c0))
        weight[1] = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
        weight[2] = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
        weight[0] = 1 - weight[1] - weight[2]
        return (slice(r0, r1), slice(c0, c1)), weight, (weight >= -1e-9).all(axis=0)

    def faces(self, uvw: np.ndarray, corners: np.ndarray, colour: np.ndarray, normals: np.ndarray, lines: bool = True) -> None:
        """Opaque faces. uvw: (points, 3) [L]; corners: (faces, 4) of points; colour: (faces, 3) or, one for each corner, (faces, 4, 3); normals:
        (faces, 3) in the picture's axes, turned in either case. `lines`: the sides of faces are darker."""
        at = self.pixels(uvw)
        toward = np.where(normals[:, 2:] < 0, -1, 1) * normals
        shine = _AMBIENT + (1 - _AMBIENT) * np.clip(toward @ LIGHT, 0, 1)
        each = np.broadcast_to(colour[:, None], (len(corners), 4, 3)) if colour.ndim == 2 else colour
        if len(corners) > _MANY:
            small = np.ptp(at[corners, :2], axis=1).max(axis=1) < _SMALL
            self._small_faces(at[corners[small]], each[small] * shine[small, None, None])
            corners, shine, each = corners[~small], shine[~small], each[~small]
        for face, (points, light) in enumerate(zip(corners, shine, strict=True)):
            for three in ((0, 1, 2), (0, 2, 3)):
                found = self._cover(at[points[list(three)]])
                if found is None:
                    continue
                where, weight, inside = found
                depth = np.tensordot(at[points[list(three)], 2], weight, 1)
                inside &= depth > self.depth[where]
                shade = np.tensordot(weight, each[face, list(three)], ((0,), (0,))) * light
                if lines:
                    shade *= self._side_shade(weight, at[points[list(three)]], three, points[2] == points[3])[..., None]
                self.depth[where][inside] = depth[inside]
                self.colour[where][inside] = shade[inside]
                self.lit[where][inside] = True

    def _small_faces(self, at: np.ndarray, colour: np.ndarray) -> None:
        """All faces of a few pixels at once, without their sides. at: (n, 4, 3) [pixels, depth L]; colour: (n, 4, 3)."""
        order = np.argsort(at[..., 2].mean(axis=1), kind="stable")  # of those that meet in a pixel the nearest one is kept
        at, colour, (height, width) = at[order], colour[order], self.size
        for three in ([0, 1, 2], [0, 2, 3]):
            x, y = at[:, three, 0], at[:, three, 1]
            (ax, bx, cx), (ay, by, cy) = x.T, y.T
            area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            first, steps = np.floor(np.stack((x.min(axis=1), y.min(axis=1)))).astype(int), range(int(_SMALL) + 2)
            for dr in steps:
                for dc in steps:
                    column, row = first[0] + dc, first[1] + dr
                    px, py = column + 0.5, row + 0.5
                    with np.errstate(divide="ignore", invalid="ignore"):
                        second = ((px - ax) * (cy - ay) - (py - ay) * (cx - ax)) / area
                        third = ((bx - ax) * (py - ay) - (by - ay) * (px - ax)) / area
                    weight = np.stack((1 - second - third, second, third), axis=1)
                    inside = (weight >= -1e-9).all(axis=1) & (np.abs(area) > 1e-12) & (column >= 0) & (column < width) & (row >= 0) & (row < height)
                    seen = np.flatnonzero(inside)
                    depth = (weight[seen] * at[seen][:, three, 2]).sum(axis=1)
                    nearer = depth > self.depth[row[seen], column[seen]]
                    seen, depth = seen[nearer], depth[nearer]
                    to = row[seen], column[seen]
                    self.depth[to] = depth
                    self.colour[to] = (weight[seen][..., None] * colour[seen][:, three]).sum(axis=1)
                    self.lit[to] = True

    @staticmethod
    def _side_shade(weight: np.ndarray, corners: np.ndarray, three: tuple[int, ...], triangle: bool) -> np.ndarray:
        """1, and less within a pixel of the sides of the face, which are those of the triangle but for a quad's diagonal."""
        shade = np.ones(weight.shape[1:])
        a, b, c = corners[:, :2]
        area = abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        inner = set() if triangle else {1} if three == (0, 1, 2) else {2}  # opposite the diagonal from corner 0 to corner 2
        for k, (p, q) in enumerate(((b, c), (c, a), (a, b))):
            length = float(np.hypot(*(q - p)))
            if k in inner or length == 0:
                continue
            away = weight[k] * area / length  # [pixels]
            shade = np.where(away < 1.0, np.minimum(shade, 0.8), shade)
        return shade

    def veil(self, uvw: np.ndarray, corners: np.ndarray, colour: np.ndarray, share: float) -> None:
        """One transparent patch of faces over what lies behind it; where they overlap they count once."""
        at, height, width = self.pixels(uvw), *self.size
        cover, near = np.zeros((height, width), dtype=bool), np.full((height, width), -np.inf)
        for points in corners:
            for three in ((0, 1, 2), (0, 2, 3)):
                found = self._cover(at[points[list(three)]])
                if found is not None:
                    where, weight, inside = found
                    cover[where] |= inside
                    near[where] = np.where(inside, np.tensordot(at[points[list(three)], 2], weight, 1), near[where])
        cover &= near > self.depth
        self.colour[cover] = (1 - share) * self.colour[cover] + share * colour.astype(np.float32)

    def seen(self, uvw: np.ndarray, slack: float) -> np.ndarray:
        """Which points have nothing in front of them by more than `slack` [L]; uvw: (n, 3) -> (n,) of bool."""
        at, (height, width) = self.pixels(uvw), self.size
        column, row = np.clip(np.floor(at[:, 0]).astype(int), 0, width - 1), np.clip(np.floor(at[:, 1]).astype(int), 0, height - 1)
        return uvw[:, 2] + slack >= self.depth[row, column]

    def shadows(self, thick: float, strength: float = 0.45, reach: int = 4) -> None:
        """Darker where neighbours lie nearer to the eye by `thick` [L] or more: edges and folds stand out (eye-dome lighting; Boucheny 2009)."""
        if not self.lit.any():
            return
        rows, columns = (slice(int(some[0]), int(some[-1]) + 1) for some in (np.flatnonzero(self.lit.any(axis=axis)) for axis in (1, 0)))
        lit, drawn = self.lit[rows, columns], np.isfinite(self.depth[rows, columns])
        height, width = lit.shape
        around = np.pad(np.where(drawn, self.depth[rows, columns], -np.inf), reach, constant_values=-np.inf)
        near = np.where(drawn, self.depth[rows, columns], np.inf)
        dark, more = np.zeros(lit.shape), np.empty(lit.shape)
        sides = [(0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)]
        for step in (1, reach):
            for dr, dc in sides:
                top, left = reach - dr * step, reach - dc * step
                np.subtract(around[top : top + height, left : left + width], near, out=more)
                more /= thick
                more -= 0.25
                dark += np.clip(more, 0, 1.0, out=more)
        shade = 1 - strength * np.clip(dark / (2 * len(sides)) * 2, 0, 1)
        self.colour[rows, columns][lit] *= shade[lit, None].astype(np.float32)

    def smaller(self, by: int) -> np.ndarray:
        """The picture with `by` x `by` pixels averaged, (height / by, width / by, 3)."""
        height, width = (n // by for n in self.size)
        return self.colour[: height * by, : width * by].reshape(height, by, width, by, 3).mean(axis=(1, 3))
