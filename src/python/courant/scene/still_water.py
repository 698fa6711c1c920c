"""Water that is at rest between walls from the start: its level, and whether these walls may have fixed ghost particles behind them."""
from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from . import shapes
from .distances import distances
from .model import Variables
from .shapes import Shape
from .water_checks import positions

if TYPE_CHECKING:
    from .basin import Basin

_BESIDE = 0.8  # spacings from a wall within which the lattice may end
_ALIGNED = 1e-3  # of a spacing: lattices that differ by less are one
_REACH = 4.0  # spacings of the kernel, h of two spacings
_MOST_FACES = 2000  # of walls that are examined
# Keywords other than those of control and output
_MAY_MOVE = re.compile(r"^\*(?!CONTROL_TERMINATION|CONTROL_TIMESTEP|CONTROL_OUTPUT|DATABASE|COURANT_GAUGE|TITLE|KEYWORD|END|COMMENT)", re.MULTILINE | re.IGNORECASE)


@dataclass
class StillWater:
    """Positions of its particles (n, 3) and the level of its surface [L]."""

    points: np.ndarray
    level: float


def still_water(basin: Basin, variables: Variables) -> StillWater | None:
    """The water of a scene where it has one level surface and ends everywhere else at a wall; None otherwise."""
    water, dx, up = basin.water, basin.spacing, basin.dim - 1
    if not water.lattices or not basin.starts_at_rest or basin.inlets or basin.structures:
        return None
    points = np.concatenate([positions(replace(one, jitter=0.0), variables) for one in water.lattices])
    if not len(points):
        return None
    cells = (points - points[0]) / dx
    code = np.rint(cells).astype(np.int64)
    if np.abs(cells - code).max() > _ALIGNED:
        return None
    code -= code.min(axis=0) - 1
    size = code.max(axis=0) + 2
    number = np.ravel_multi_index(tuple(code.T), tuple(size))
    walls = [*_sides(basin), *(solid.shape for solid in basin.solids)]
    filled = np.zeros(int(np.prod(size)), dtype=bool)
    filled[number] = True
    free = []  # upwards
    for axis in range(basin.dim):
        step = np.zeros(3)
        step[axis] = dx
        for sign in (-1, 1):
            ends = ~filled[number + sign * int(np.prod(size[axis + 1 :]))]
            bare = _bare(points[ends] + sign * step, walls, _BESIDE * dx)
            if axis == up and sign > 0:
                free = points[ends][bare][:, up]
            elif bare.any():
                return None
    if not len(free) or np.ptp(free) > _ALIGNED * dx:
        return None
    return StillWater(points, float(free[0]) + dx / 2)


def _bare(x: np.ndarray, walls: list[Shape], within: float) -> np.ndarray:
    """Which points (n, 3) have no wall near."""
    out = np.ones(len(x), dtype=bool)
    for shape in walls:
        some = np.flatnonzero(out)
        out[some] = distances(shape, x[some], within) > within
    return out


def _sides(basin: Basin) -> list[Shape]:
    """The walls of the box."""
    if not basin.box:
        return []
    low, high = np.array(basin.box[0]), np.array(basin.box[1])
    extent = np.diag(high - low)
    out = []
    for k, side in enumerate(basin.sides):
        if side in basin.open:
            continue
        origin = low.copy()
        origin[k // 2] = (low, high)[k % 2][k // 2]
        edges = [extent[a] for a in range(basin.dim) if a != k // 2]
        out.append(shapes.polyline(np.array([origin, origin + edges[0]]), closed=False) if basin.dim == 2 else shapes.plate(origin, *edges))
    return out


def stays_still(basin: Basin, keywords: list[str]) -> bool:
    """Whether nothing of the scene moves the water. Cards beside those of the scene may."""
    driven = basin.box_motion or any(solid.free or solid.driven for solid in basin.solids)
    return not driven and basin.gravity > 0 and not basin.outlets and not any(_MAY_MOVE.search(text) for text in keywords)


def has_oblique_walls(basin: Basin) -> bool:
    return any(bool((np.abs(_normals(solid.shape)).max(axis=1) < 1 - 1e-6).any()) for solid in basin.solids)


def is_dry_behind(basin: Basin, points: np.ndarray) -> bool:
    """Whether each face of the walls has water on one side only, as far as the kernel reaches: no thin plate, no edge of a ridge."""
    dim, reach = basin.dim, _REACH * basin.spacing
    if sum(len(solid.shape.faces) for solid in basin.solids) > _MOST_FACES:
        return False
    order = np.argsort(points[:, 0], kind="stable")
    points = points[order, :dim]
    for solid in basin.solids:
        corners = solid.shape.points[solid.shape.faces][:, :, :dim]
        for face, normal in zip(corners, _normals(solid.shape)):
            begin, end = np.searchsorted(points[:, 0], [face[:, 0].min() - reach, face[:, 0].max() + reach])
            some = points[begin:end]
            height = (some - face[0]) @ normal
            some, height = some[np.abs(height) < reach], height[np.abs(height) < reach]
            inside = np.ones(len(some), dtype=bool)
            for k in range(dim):  # beside each corner of the face, seen along its normal
                a, b = face[k], face[(k + 1) % dim]
                across = b - a if dim == 2 else np.cross(normal, b - a)
                inside &= (some - a) @ across >= 0
            sides = height[inside] > 0
            if sides.any() and not sides.all():
                return False
    return True


def _normals(shape: Shape) -> np.ndarray:
    """Unit vectors (m, dim)."""
    corners = shape.points[shape.faces][:, :, : shape.dim]
    along = corners[:, 1] - corners[:, 0]
    out = np.column_stack([along[:, 1], -along[:, 0]]) if shape.dim == 2 else np.cross(along, corners[:, 2] - corners[:, 0])
    lengths: np.ndarray = np.linalg.norm(out, axis=1)[:, None]
    result: np.ndarray = out / np.maximum(lengths, 1e-300)
    return result
