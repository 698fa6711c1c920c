"""Particles of one state: those that count, the connected body of water, its surface on lines, and values between particles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..fields import ParticleFrame

_STEPS_PER_H = 16  # of the search for surfaces
_MOST_STEPS = 4_000_000  # of all lines that are looked at together
_PAIRS_AT_ONCE = 512  # whose columns stay in the processor's cache


def spline_shape(q: np.ndarray) -> np.ndarray:
    """The cubic spline kernel W(q = r/h) without its factor: 1 - 1.5 q^2 + 0.75 q^3 up to q = 1, (2 - q)^3 / 4 up to 2, 0 beyond.

    Source: Monaghan, Annu. Rev. Astron. Astrophys. 30 (1992), eq. 2.6 (there for all dimensions).
    """
    outer, inner = np.maximum(2 - q, 0), np.maximum(1 - q, 0)
    return 0.25 * outer * outer * outer - inner * inner * inner


def spline_norm(h: np.ndarray, dim: int) -> np.ndarray:
    """The factor of the cubic spline in one, two or three dimensions. [1/L^dim]"""
    return {1: 2 / 3, 2: 10 / (7 * math.pi), 3: 1 / math.pi}[dim] / h**dim


class SprayRule(NamedTuple):
    """What counts as spray.

    `link`: two particles belong together where they are closer than link times their mean h, up to 2. `share`: a group with less
    than this share of the volume is spray, unless it is the largest.
    """

    link: float = 1.5
    share: float = 0.02


@dataclass(frozen=True)
class ParticleSet:
    """A selection of the particles of a state. `x`: (n, 3) [L], with z = 0 in the plane; `V`: m/rho (n,) [L3, in the plane L2];
    `h`: (n,) [L]; `row`: (n,) in the frame."""

    t: float
    dim: int
    x: np.ndarray
    V: np.ndarray
    h: np.ndarray
    row: np.ndarray

    @classmethod
    def of(cls, frame: ParticleFrame, taken: np.ndarray) -> ParticleSet:
        """The particles for which `taken` holds; shape of taken: (len(frame),) of bool."""
        row = np.flatnonzero(taken)
        x = frame.x[row]
        if frame.dim == 2:
            x[:, 2] = 0  # in a plane flow z does not matter
        return cls(frame.t, frame.dim, x, frame.V[row], frame.h[row], row)

    def part(self, taken: np.ndarray) -> ParticleSet:
        """The particles for which `taken` holds; shape of taken: (len(self),) of bool."""
        return ParticleSet(self.t, self.dim, self.x[taken], self.V[taken], self.h[taken], self.row[taken])

    def __len__(self) -> int:
        return len(self.row)

    @cached_property
    def largest_h(self) -> float:
        return float(self.h.max()) if len(self.h) else 0.0

    @cached_property
    def factor(self) -> np.ndarray:
        """V times the factor of the kernel, (n,)."""
        return self.V * spline_norm(self.h, self.dim)

    @cached_property
    def by_axis(self) -> list[np.ndarray]:
        """Indices of the particles in the order of x and of y, (n,) each."""
        return [np.argsort(self.x[:, axis], kind="stable") for axis in (0, 1)]

    @cached_property
    def tree(self) -> Any:  # a scipy.spatial.cKDTree, which is imported where it is needed
        from scipy.spatial import cKDTree

        return cKDTree(self.x[:, : self.dim])


def water_body(particles: ParticleSet, rule: SprayRule) -> ParticleSet:
    """The particles that are no spray.

    The rule is about groups of particles that hang together, so a drop belongs to the water again once it touches it.
    """
    n = len(particles)
    if n == 0:
        return particles
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import connected_components

    reach = rule.link * particles.largest_h
    a, b = particles.tree.query_pairs(reach * (1 + 1e-12), output_type="ndarray").T
    apart = particles.x[a] - particles.x[b]
    distance = np.hypot(np.hypot(apart[:, 0], apart[:, 1]), apart[:, 2])
    linked = distance < rule.link * 0.5 * (particles.h[a] + particles.h[b])
    graph = csr_matrix((np.ones(int(linked.sum()), dtype=bool), (a[linked], b[linked])), shape=(n, n))
    count, group = connected_components(graph, directed=False)
    volume = np.bincount(group, particles.V, count)
    least = min(volume.max(), rule.share * volume.sum())
    return particles.part(volume[group] >= least)


class Pieces(NamedTuple):
    """Pieces of water on lines, ordered by line, then from low to high; all shapes (pieces,). `low`, `high`: [L]."""

    line: np.ndarray
    low: np.ndarray
    high: np.ndarray


def pairs_near(x: np.ndarray, order: np.ndarray, at: np.ndarray, reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of locations and coordinates at most `reach` apart: index into `at`, rising, and into x. `order`: of x, from low to high."""
    begin, end = np.searchsorted(x[order], at - reach, "left"), np.searchsorted(x[order], at + reach, "right")
    count = end - begin
    place = np.repeat(np.arange(len(at)), count)
    return place, order[np.arange(len(place)) - np.repeat(np.cumsum(count) - count - begin, count)]


def lines_near(particles: ParticleSet, places: np.ndarray, axis: int, flat: bool | None = None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Which particles reach lines along an axis: index of the line, of the particle, and how far it is aside [L].

    places: (lines, 3) points of the lines. Ordered by line. `flat`: distances in the plane x, y.
    """
    flat = particles.dim == 2 and axis != 2 if flat is None else flat
    across = [a for a in ((0, 1) if flat else (0, 1, 2)) if a != axis]
    line, k = pairs_near(particles.x[:, across[0]], particles.by_axis[across[0]], places[:, across[0]], 2 * particles.largest_h)
    aside = np.abs(particles.x[k, across[0]] - places[line, across[0]])
    for a in across[1:]:
        aside = np.hypot(aside, particles.x[k, a] - places[line, a])
    near = aside < 2 * particles.h[k]
    return line[near], k[near], aside[near]


def colour_columns(
    particles: ParticleSet, line: np.ndarray, k: np.ndarray, aside: np.ndarray, above: np.ndarray, shape: tuple[int, int], dy: float
) -> np.ndarray:
    """The colour C = sum_j V_j W on steps of dy along lines; shape (lines, steps).

    line, k, aside: as from lines_near; above: (pairs,) the particle's height over the begin of its line [L].
    """
    lines, steps = shape
    width = math.ceil(4 * particles.largest_h / dy) + 2
    out = np.zeros(lines * (steps + 2 * width))  # room for kernels that begin before, or end behind, the steps
    h, one_h = particles.h[k], bool((particles.h == particles.h[:1]).all())
    first = np.clip(np.ceil((above - 2 * h) / dy).astype(np.int64), -width, steps)
    factor = particles.factor[k]
    start, across, step = (first * dy - above) / h, (aside / h) ** 2, dy / h
    at = line * (steps + 2 * width) + first + width
    ahead = np.arange(width)
    for low in range(0, len(k), _PAIRS_AT_ONCE):
        part = slice(low, low + _PAIRS_AT_ONCE)
        q = start[part, None] + (ahead * step[0] if one_h else ahead * step[part, None])
        q *= q
        q += across[part, None]
        np.sqrt(q, out=q)
        outer = np.subtract(2, q)
        np.maximum(outer, 0, out=outer)
        np.subtract(1, q, out=q)
        np.maximum(q, 0, out=q)
        cube = outer * outer
        cube *= outer
        cube *= 0.25
        np.multiply(q, q, out=outer)
        outer *= q
        cube -= outer
        cube *= factor[part, None]
        lowest = int(at[part].min())
        index = (at[part] - lowest)[:, None] + ahead
        sums = np.bincount(index.ravel(), cube.ravel())
        out[lowest : lowest + len(sums)] += sums
    return out.reshape(lines, steps + 2 * width)[:, width : width + steps]


def water_on_lines(water: ParticleSet, places: np.ndarray, axis: int) -> tuple[Pieces, np.ndarray]:
    """All pieces of water on lines along an axis: where the colour C is at least 1/2; and the integral of C over each line, (lines,).

    places: (lines, 3) points of the lines [L]. Ends are found on steps of h/16, linear in between. Pieces thinner than half an h
    are none.
    """
    filled = np.zeros(len(places))
    line, k, aside = lines_near(water, places, axis)
    if len(k) == 0:
        return Pieces(*(np.empty(0, dtype) for dtype in (np.int64, float, float))), filled
    height, h = water.x[k, axis], water.largest_h
    low, high = np.full(len(places), np.inf), np.full(len(places), -np.inf)
    np.minimum.at(low, line, height)
    np.maximum.at(high, line, height)
    met = np.isfinite(low)
    dy = h / _STEPS_PER_H
    start = np.where(met, low - 2 * h - dy, 0)
    steps = math.ceil(((high - start)[met].max() + 2 * h) / dy) + 2
    if len(places) > 1 and len(places) * steps > _MOST_STEPS:  # a particle that flew far away must not cost all lines that much
        halves = [water_on_lines(water, half, axis) for half in np.array_split(places, 2)]
        pieces = zip(*(one for one, _ in halves), strict=True)
        lines, low, high = (np.concatenate(both) for both in pieces)
        lines[len(halves[0][0].line) :] += len(halves[0][1])
        return Pieces(lines, low, high), np.concatenate([one for _, one in halves])
    C = colour_columns(water, line, k, aside, height - start[line], (len(places), steps), dy)
    filled = dy * C.sum(axis=1)
    found = _wet_pieces(C, start, dy)
    thick = found.high - found.low >= 0.5 * h
    return Pieces(*(one[thick] for one in found)), filled


def _wet_pieces(C: np.ndarray, start: np.ndarray, dy: float) -> Pieces:
    """Where the colour is at least 1/2, linear between steps. C: (lines, steps), under 1/2 at both ends; start: (lines,) height of step 0 [L]."""
    wet = C >= 0.5
    where, before = np.nonzero(wet[:, 1:] != wet[:, :-1])  # by turns into the water and out of it
    a, b = C[where, before], C[where, before + 1]
    crossing = start[where] + (before + (0.5 - a) / (b - a)) * dy
    return Pieces(where[::2], crossing[::2], crossing[1::2])


def joined(pieces: Pieces, gap: float) -> Pieces:
    """Pieces with gaps thinner than `gap` [L] between them as one: a crack between two rows of particles is no cavity."""
    line, low, high = pieces
    begins = np.ones(len(line), dtype=bool)
    begins[1:] = (line[1:] != line[:-1]) | (low[1:] - high[:-1] >= gap)
    first = np.flatnonzero(begins)
    last = np.append(first[1:], len(line))[: len(first)] - 1
    return Pieces(line[first], low[first], high[last])


def first_surface(particles: ParticleSet, places: np.ndarray, bed: float, over: float = 0.0) -> np.ndarray:
    """Depth of the water over the bed on upright lines (y is up), 0 where it is dry; shape (lines,) [L].

    The surface is where C falls below 1/2 above the bed and stays there for h or more: spray and water above such a cavity do not
    count, a thinner gap between two rows of particles is no surface. Nor does water count whose underside is more than 2h above the
    bed: the bed is dry there. Resolution h/16, linear in between. places: (lines, 3) [L]. `over`: lines whose depth cannot be more
    may be given 0.
    """
    depth, h = np.zeros(len(places)), particles.largest_h
    line, k, aside = lines_near(particles, places, 1, flat=particles.dim == 2)
    if over > 0:
        top = np.full(len(places), -np.inf)
        np.maximum.at(top, line, particles.x[k, 1])
        deep = (top - bed + 2 * h > over)[line]  # above all kernels there is no colour
        line, k, aside = line[deep], k[deep], aside[deep]
    if len(k) == 0:
        return depth
    dy = h / _STEPS_PER_H
    above = particles.x[k, 1] - bed
    steps = math.ceil((max(0.0, above.max()) + 2 * h) / dy) + 34
    C = np.zeros((len(places), steps + 1))  # step 0 is dry: under the bed there is no water
    C[:, 1:] = colour_columns(particles, line, k, aside, above, (len(places), steps), dy)
    water = joined(_wet_pieces(C, np.full(len(places), -dy), dy), h)
    rows, lowest = np.unique(water.line, return_index=True)
    touches = water.low[lowest] <= 2 * h
    depth[rows[touches]] = water.high[lowest[touches]]
    return depth


class Weights(NamedTuple):
    """What particles contribute to the values at points.

    `point`, `k`, `weight`: (pairs,) index of the point and of the particle, and the weight, whose sum at a point is 1; `colour`:
    (points,) C = sum_j V_j W_j, 1 in water, about 1/2 at its surface and at walls; `fallback`: (points,) of bool, where MLS was asked
    for, but the particles lie (nearly) in a line: Shepard.
    """

    point: np.ndarray
    k: np.ndarray
    weight: np.ndarray
    colour: np.ndarray
    fallback: np.ndarray

    def of(self, values: np.ndarray) -> np.ndarray:
        """Weighted sums at the points; values: one per particle of the set."""
        return np.bincount(self.point, self.weight * values[self.k], len(self.colour))


class Points:
    """Points at which values are looked for, sorted once for all states. `x`: (points, 3) [L]."""

    def __init__(self, x: np.ndarray) -> None:
        self.x = x
        self._trees: dict[int, Any] = {}

    def tree(self, dim: int) -> Any:
        from scipy.spatial import cKDTree

        if dim not in self._trees:
            self._trees[dim] = cKDTree(self.x[:, :dim])
        return self._trees[dim]


def interpolate(water: ParticleSet, points: Points, linear: bool, wet: float) -> Weights:
    """Weights at points, with the cubic spline kernel and the particles' own h.

    `linear`: moving least squares with a linear base, exact for linear fields; else Shepard's sum V W f / sum V W, exact for
    constants. Only points whose colour is at least `wet` get weights. Sources: Shepard (1968); moving least squares: Belytschko,
    Krongauz, Organ, Fleming and Krysl, Comput. Methods Appl. Mech. Eng. 139 (1996), section 2.2.
    """
    count, dim = len(points.x), water.dim
    fallback = np.zeros(count, dtype=bool)
    if len(water) == 0:
        return Weights(np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0), np.zeros(count), fallback)
    pairs = points.tree(dim).sparse_distance_matrix(water.tree, 2 * water.largest_h, output_type="ndarray")
    point, k = pairs["i"], pairs["j"]
    weight = water.factor[k] * spline_shape(pairs["v"] / water.h[k])
    colour = np.bincount(point, weight, count)
    used = (weight > 0) & (colour[point] >= wet)
    point, k, weight = point[used], k[used], weight[used]
    if linear:
        inside = np.flatnonzero(colour >= wet)
        number = np.empty(count, np.int64)
        number[inside] = np.arange(len(inside))  # of the points in the water
        base = [np.ones(len(k)), *((water.x[k, a] - points.x[point, a]) / water.largest_h for a in range(dim))]
        coefficients, possible = _linear_base(number[point], weight, base, len(inside))
        coefficients[~possible] = 0
        coefficients[~possible, 0] = 1 / colour[inside[~possible]]
        fallback[inside] = ~possible
        weight = weight * sum(of * coefficients[number[point], a] for a, of in enumerate(base))
    else:
        weight = weight / colour[point]
    return Weights(point, k, weight, colour, fallback)


def _linear_base(point: np.ndarray, weight: np.ndarray, base: list[np.ndarray], count: int) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients a, (points, n), for which V W (a . p), p = (1, (x_j - x)/h, ...), sums linear fields exactly; and whether the
    moments allow it, (points,) of bool."""
    most = 1e4  # of the condition: particles in a line, or on one side only of a thin sheet
    M = np.empty((count, len(base), len(base)))
    for i, weighted in enumerate(weight * of for of in base):
        for j in range(i, len(base)):
            M[:, i, j] = M[:, j, i] = np.bincount(point, weighted * base[j], count)
    with np.errstate(all="ignore"):
        possible = np.linalg.cond(M, 1) < most  # false for NaN, too
    return np.linalg.inv(np.where(possible[:, None, None], M, np.eye(len(base))))[:, 0], possible
