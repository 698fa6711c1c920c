"""Filled pictures of plane flows: the field within the water, walls, the surface, gauges and a theory's curve."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..optional import module
from .particles import ParticleSet, SprayRule, spline_norm, spline_shape, water_body, water_on_lines
from .view_fields import Faces
from .view_scene import Scene, View

_WALL = {"edgecolor": "black", "linewidth": 1.6, "capstyle": "butt", "fill": False}
_PIXELS_PER_H, _MOST_PIXELS = 8, 4000
_BOX = {"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 0.8}


def plane_window(scenes: list[Scene], view: View) -> tuple[float, float, float, float]:
    """Left, right, bottom, top [L]: what the view tells, else particles and walls with a margin."""
    corners = np.concatenate([one.corners() for one in scenes])
    out: list[float] = []
    for axis in (0, 1):
        limits = view.window[axis]
        margin = 0.03 * float(np.ptp(corners[:, axis])) or 1.0
        out += limits or (float(corners[:, axis].min()) - margin, float(corners[:, axis].max()) + margin)
    return out[0], out[1], out[2], out[3]


def fill(x: np.ndarray, V: np.ndarray, h: np.ndarray, values: np.ndarray, window: tuple[float, ...], width: int) -> np.ndarray:
    """Values on pixels, row 0 at the bottom, NaN outside the water; (height, width). `width`: at least so many pixels.

    x: (n, 2) or more columns [L]; V: (n,) m/rho, an area [L2]; h: (n,) [L]; window: left, right, bottom, top [L].

    There is water where the colour C = sum V W is at least 1/2, as the surface is found, in discs of the area m/rho of drops, and in gaps thinner
    than h; there values are Shepard's sum V W f / sum V W. Sums are taken at points h/8 apart or closer and are linear between them.
    """
    left, right, bottom, top = window
    if len(h):
        width = max(width, min(_MOST_PIXELS, round(_PIXELS_PER_H * (right - left) / float(np.median(h)))))  # to see gaps as they are
    dx = (right - left) / width
    height = max(1, round((top - bottom) / dx))
    per_point = max(1, int(float(h.min()) / (_PIXELS_PER_H * dx))) if len(h) else 1
    reach = -(-(int(np.ceil(2 * h.max(initial=0.0) / dx)) + 1) // per_point)  # of kernels, in points
    pad = reach * per_point  # kernels reach over the edges of the picture
    high, wide = (-(-(count + 2 * pad) // per_point) for count in (height, width))  # of points
    column, row = np.floor((x[:, 0] - left) / dx).astype(int) + pad, np.floor((x[:, 1] - bottom) / dx).astype(int) + pad
    inside = (column >= 0) & (column < wide * per_point) & (row >= 0) & (row < high * per_point)
    if not inside.any():
        return np.full((height, width), np.nan)
    (x, y), V, h, values, column, row = x[inside, :2].T, V[inside], h[inside], values[inside], column[inside], row[inside]
    factor, across, up = V * spline_norm(h, 2), x - left + pad * dx, y - bottom + pad * dx
    C, f = np.zeros(wide * high), np.zeros(wide * high)
    for q, i, p, r in _points_near(across, up, column // per_point, row // per_point, 2 * h, per_point * dx, reach, (wide, high)):
        weight = factor[i] * spline_shape(r / h[i])
        _add(C, q * wide + p, weight)
        _add(f, q * wide + p, weight * values[i])
    C, f = (_finer(one.reshape(high, wide), per_point) for one in (C, f))
    drop = np.flatnonzero(C[row, column] < 0.6)  # particles that are alone, or nearly: the colour at the surface of water is more
    radius = np.maximum(np.sqrt(V[drop] / np.pi), 0.71 * dx)
    near = np.full(C.shape, False)
    most = int(radius.max(initial=0.0) / dx) + 1
    for q, _, p, _ in _points_near(across[drop], up[drop], column[drop], row[drop], radius, dx, most, (C.shape[1], C.shape[0])):
        near[q, p] = True
    wet = _closed((C >= 0.5) | near, 0.5 * float(np.median(h)) / dx) & (C > 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        field = np.where(wet, f / C, np.nan)
    return field[pad : pad + height, pad : pad + width]


def _points_near(x: np.ndarray, y: np.ndarray, column: np.ndarray, row: np.ndarray, radius: np.ndarray, dx: float, reach: int,
                 size: tuple[int, int]) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]]:
    """Centres of cells of a grid within a radius of particles, a row of cells of all particles at a time: row, particle, column, distance [L].

    x, y: (n,) from the corner of the grid [L]; column, row: (n,) of the particles; reach: of the radii, in cells; size: columns, rows."""
    p = column[:, None] + np.arange(-reach, reach + 1)  # (particles, columns)
    across2 = ((p + 0.5) * dx - x[:, None]) ** 2
    for dr in range(-reach, reach + 1):
        q = row + dr
        r2 = across2 + (((q + 0.5) * dx - y) ** 2)[:, None]
        i, j = np.nonzero((r2 < (radius**2)[:, None]) & (p >= 0) & (p < size[0]) & ((q >= 0) & (q < size[1]))[:, None])
        yield q[i], i, p[i, j], np.sqrt(r2[i, j])


def _finer(values: np.ndarray, factor: int) -> np.ndarray:
    """Values at the centres of cells, linear between these, at the centres of factor x factor parts of each cell."""
    for axis in (0, 1) if factor > 1 else ():
        at = np.clip((np.arange(values.shape[axis] * factor) + 0.5) / factor - 0.5, 0, values.shape[axis] - 1)
        low = np.minimum(at.astype(int), max(0, values.shape[axis] - 2))
        share = np.expand_dims(at - low, 1 - axis)
        high = np.minimum(low + 1, values.shape[axis] - 1)
        values = (1 - share) * values.take(low, axis) + share * values.take(high, axis)
    return values


def _add(total: np.ndarray, at: np.ndarray, more: np.ndarray) -> None:
    """Sums of `more` by point; of few ones without a pass over all of them, which takes minutes where few particles fill it. The bits are the same."""
    if 20 * len(at) > len(total):
        total += np.bincount(at, more, len(total))
    elif len(at):
        points, number = np.unique(at, return_inverse=True)
        total[points] += np.bincount(number.ravel(), more, len(points))


def _closed(wet: np.ndarray, radius: float) -> np.ndarray:
    """Gaps thinner than 2 radius [pixels] filled; distances, not shapes, so that a large radius costs no more."""
    distance = module("scipy.ndimage").distance_transform_edt
    grown = np.pad(distance(~wet) <= radius, int(radius) + 2, mode="edge")
    back = distance(grown) > radius
    edge = int(radius) + 2
    return wet | back[edge:-edge, edge:-edge]


def _sections(walls: Faces) -> np.ndarray:
    """Which faces, those of solids, are seen from in front, (faces,)."""
    return np.abs(walls.normals()[:, 2]) > 0.5


def wall_traces(scene: Scene) -> np.ndarray:
    """Sides of the walls as seen along z, the longest of each face; (faces, 2, 2) [L]."""
    if scene.walls is None:
        return np.empty((0, 2, 2))
    corners = scene.walls.x[scene.walls.corners[~_sections(scene.walls)]][:, :, :2]
    sides = np.stack((corners, np.roll(corners, -1, axis=1)), axis=2)  # (faces, 4, 2, 2)
    length = np.hypot(*np.moveaxis(sides[:, :, 1] - sides[:, :, 0], -1, 0))
    return sides[np.arange(len(sides)), length.argmax(axis=1)]


def surface_line(scene: Scene, window: tuple[float, ...], bed: float) -> tuple[np.ndarray, np.ndarray]:
    """x and height of the surface, the top of the highest water over the bed without spray (`surface: top`); NaN where it is dry. [L]"""
    places = scene.x.copy()
    places[:, 2] = 0
    water = water_body(ParticleSet(scene.t, 2, places, scene.V, scene.h, np.arange(len(places))), SprayRule())
    low, high = max(window[0], float(places[:, 0].min())), min(window[1], float(places[:, 0].max()))
    x = np.linspace(low, high, max(2, min(600, round(2 * (high - low) / water.largest_h))))
    pieces, _ = water_on_lines(water, np.column_stack((x, 0 * x, 0 * x)), 1)
    level, over = np.full(len(x), np.nan), pieces.high > bed
    level[pieces.line[over]] = pieces.high[over]  # of a line's pieces the last one is the highest
    return x, level


def _draw_marks(axes: Any, scene: Scene, view: View, window: tuple[float, ...], length: str) -> None:
    """Surface, theory and gauges, as far as the view asks for them."""
    if (view.depth or view.gauges) and len(scene.x):
        x, level = surface_line(scene, window, view.bed)
        if view.depth:
            axes.plot(x, level, color="#d55e00", linewidth=1.0, label="surface")
        for k, gauge in enumerate(view.gauges):
            here = float(np.interp(gauge, x, level))
            axes.plot([gauge, gauge], [view.bed, window[3]], color="#d55e00", linewidth=0.8, linestyle=":")
            if np.isfinite(here):
                depth = f"{here - view.bed:.3g} {length}"
                axes.plot([gauge], [here], marker="v", markersize=5, color="#d55e00", linestyle="none", label="gauge" if k == 0 else None)
                beside = {"xytext": (-4, 5), "textcoords": "offset points", "ha": "right"}
                axes.annotate(depth, (gauge, here), fontsize=7, color="0.15", bbox=_BOX, zorder=5, **beside)
    if view.theory is not None:
        low, high = view.theory_range or window[:2]
        x = np.linspace(low, high, 200)
        axes.plot(x, view.theory.over({"x": x}, len(x)), color="0.15", linewidth=1.1, linestyle="--", label=view.theory_label)


def draw_plane(axes: Any, scene: Scene, view: View, window: tuple[float, ...], limits: tuple[float, float], width: int, length: str) -> None:
    """One state in a pair of axes with equal scales."""
    values = np.empty(0) if scene.values is None else scene.values
    field = fill(scene.x, scene.V, scene.h, values, window, width)
    look = {"cmap": view.colours, "vmin": limits[0], "vmax": limits[1], "interpolation": "nearest", "aspect": "equal"}
    axes.imshow(np.ma.masked_invalid(field), origin="lower", extent=window, **look)
    if view.walls != "none":
        if scene.walls is not None and (front := _sections(scene.walls)).any():
            solids = scene.walls.x[scene.walls.corners[front]][:, :, :2]
            axes.add_collection(module("matplotlib.collections").PolyCollection(list(solids), facecolors="0.7", edgecolors="0.7", linewidths=0.5))
        traces, path = wall_traces(scene).reshape(-1, 2), module("matplotlib.path").Path
        stroke = path(traces, np.tile([path.MOVETO, path.LINETO], len(traces) // 2))  # one stroke: its pieces do not darken each other
        axes.add_patch(module("matplotlib.patches").PathPatch(stroke, snap=True, **_WALL))
    _draw_marks(axes, scene, view, window, length)
    axes.set(xlim=window[:2], ylim=window[2:])
