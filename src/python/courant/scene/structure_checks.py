"""What deformable parts of a scene must not be: in a wall, in a body or in each other; and bodies that overlap."""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..diagnostics import Diagnostics
from ..words import shortest
from .basin import Basin
from .meshes import SOLIDS
from .shapes import Shape
from .structures import Structure

_DEPTH = 0.01  # of the spacing of particles: what is less deep touches
_FACES = 20_000  # whose points are examined at once


def check_structures(basin: Basin, diagnostics: Diagnostics) -> None:
    """Refuses nodes that begin in closed walls, bodies and other solids, but for those that are held, and parts that reach through walls of the box."""
    depth, dim = _DEPTH * basin.spacing, basin.dim
    solid = {id(one): one.outline(dim) for one in basin.structures if one.mesh.kind == SOLIDS}
    free_of = [np.delete(one.mesh.points, one.bound, axis=0) for one in basin.structures]
    for k, (one, free) in enumerate(zip(basin.structures, free_of)):
        _check_box(one, free, basin, depth, diagnostics)
        for rigid in basin.solids:
            if not rigid.closed:
                continue
            name = f"'{rigid.shape.name}'" if rigid.shape.name else "a wall or body"
            found = _inside(rigid.shape, free, depth)
            if not len(found) and id(one) in solid:
                found = _inside(solid[id(one)], rigid.shape.points, depth)
            _report(one, found, name, dim, diagnostics)
        for other, free_of_other in zip(basin.structures[:k], free_of):
            found = _inside(solid[id(other)], free, depth) if id(other) in solid else free[:0]
            if not len(found) and id(one) in solid:
                found = _inside(solid[id(one)], free_of_other, depth)
            _report(one, found, f"'{other.title}'", dim, diagnostics)


def check_bodies(basin: Basin, joined: set[str], diagnostics: Diagnostics) -> None:
    """Refuses bodies that overlap each other or, in space, where they touch, closed walls and ground, unless both have joints: they may be parts of one
    thing."""
    titles = basin.rigid_parts()
    bodies = [solid for solid in basin.solids if solid.free]
    linked = [bool({solid.shape.name, str(solid.part)} & joined) for solid in bodies]
    walls = [solid for solid in basin.solids if not solid.free] if basin.dim == 3 else []
    for k, one in enumerate(bodies):
        for wall in walls:
            name = titles[wall.part]
            if (linked[k] and {name, str(wall.part)} & joined) or {"x", "y", "z"} <= one.hold:
                continue
            pieces = (_inside(one.shape, x, _DEPTH * basin.spacing) for x in _points_on(wall.shape, one.shape))
            found = next((x[0] for x in pieces if len(x)), None)
            at = found if found is not None else _common_point(one.shape, wall.shape, _DEPTH * basin.spacing) if wall.closed or wall.shape.ground else None
            if at is None:
                continue
            diagnostics.error(one.where, f"'{titles[one.part]}' begins inside of the wall '{name}' or across it, for example at ({', '.join(f'{v:.4g}' for v in at)})",
                              "move it, or join it to the wall by a joint")
        for other, has_joint in zip(bodies[:k], linked):
            if (has_joint and linked[k]) or (at := _common_point(one.shape, other.shape, _DEPTH * basin.spacing)) is None:
                continue
            names = [f"'{titles[body.part]}'" + (f" ({body.part})" if one.shape.name == other.shape.name else "") for body in (other, one)]
            diagnostics.error(one.where, f"{' and '.join(names)} overlap, for example at ({', '.join(f'{v:.4g}' for v in at[: basin.dim])})",
                              "move one of them, or join them by a joint" + (": bodies of the plane do not touch each other" if basin.dim == 2 else ""))


def _points_on(shape: Shape, other: Shape) -> Iterator[np.ndarray]:
    """Points inside of those faces of a shape in space whose boxes meet that of another shape, in pieces (n, 3) [L]."""
    weights = np.array([(i + 1, j + 1, 7 - i - j) for i in range(7) for j in range(7 - i)]) / 9
    if (shape.low > other.high).any() or (shape.high < other.low).any():
        return
    for begin in range(0, len(shape.faces), _FACES):
        corners = shape.points[shape.faces[begin : begin + _FACES]]
        corners = corners[((corners.min(axis=1) <= other.high) & (corners.max(axis=1) >= other.low)).all(axis=1)]
        if len(corners):
            yield np.einsum("kc,fcd->fkd", weights, corners).reshape(-1, 3)


def _common_point(one: Shape, other: Shape, depth: float) -> np.ndarray | None:
    """A point inside of both shapes, of a lattice over what their boxes have in common; None where that is thinner than `depth` [L]."""
    dim = one.dim
    low, high = np.maximum(one.low, other.low)[:dim], np.minimum(one.high, other.high)[:dim]
    if other.ground:
        low[-1] = one.low[dim - 1]
    if not np.all(high - low > depth):
        return None
    n = 64 if dim == 2 else 16
    x = np.zeros((n**dim, 3))
    x[:, :dim] = low + (high - low) * (np.stack(np.meshgrid(*[np.arange(n)] * dim, indexing="ij"), axis=-1).reshape(-1, dim) + 0.5) / n
    x = x[one.contains(x)]
    x = x[other.contains(x)]
    return x[len(x) // 2] if len(x) else None


def _inside(shape: Shape, x: np.ndarray, depth: float) -> np.ndarray:
    """Those of points (n, 3) that are deeper in a shape than `depth` along each axis [L]."""
    inside = shape.contains(x)
    for axis in range(shape.dim):
        for sign in (-1.0, 1.0):
            some = np.flatnonzero(inside)
            moved = x[some].copy()
            moved[:, axis] += sign * depth
            inside[some] = shape.contains(moved)
    found: np.ndarray = x[inside]
    return found


def _report(one: Structure, found: np.ndarray, name: str, dim: int, diagnostics: Diagnostics) -> None:
    if not len(found):
        return
    at = ", ".join(shortest(round(float(v), 9)) for v in found[0, :dim])
    nodes = "a point" if len(found) == 1 else f"{len(found)} points"
    diagnostics.error(one.where, f"'{one.title}' and {name} overlap: {nodes} of one {'is' if len(found) == 1 else 'are'} inside of the other, the first at ({at})",
                      "let one end at the surface of the other, or hold the nodes that are inside by 'fix'")


def _check_box(one: Structure, free: np.ndarray, basin: Basin, depth: float, diagnostics: Diagnostics) -> None:
    if not basin.box or not len(free):
        return
    for k in range(basin.dim):
        ends = basin.box[0][k], basin.box[1][k]
        low, high = float(free[:, k].min()), float(free[:, k].max())
        if (low < ends[0] - depth and basin.sides[2 * k] not in basin.open) or (high > ends[1] + depth and basin.sides[2 * k + 1] not in basin.open):
            diagnostics.error(one.where, f"'{one.title}' reaches from {low:g} to {high:g} along {'xyz'[k]}, through a wall of the box from {ends[0]:g} to {ends[1]:g}",
                              "let it end at the wall, or hold what is outside by 'fix'")
