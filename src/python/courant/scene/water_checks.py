"""What the water of a scene must not be: in two blocks at once, or of another depth or side than a wave maker expects."""
from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..diagnostics import Diagnostics
from ..words import shortest
from .model import Fault, Lattice, Variables
from .places import lattice_points
from .solids import Solid
from .wave_reader import Piston

_TINY = 1e-6  # of a spacing, for round-off
_NEAR = 4  # spacings beside a wall in which its water is


def cropped(lattice: Lattice, low: np.ndarray, high: np.ndarray) -> tuple[Lattice, np.ndarray] | None:
    """The cells whose centres are from `low` to `high` (3,), without jitter, and the indices of the first of them; None where there are none."""
    origin, n = np.array(lattice.low), np.array(lattice.n)
    first = np.maximum(np.ceil((low - origin) / lattice.spacing - 0.5 - _TINY), 0)
    last = np.minimum(np.floor((high - origin) / lattice.spacing - 0.5 + _TINY), n - 1)
    if lattice.dim == 2:
        first[2], last[2] = 0, 0
    if not (last >= first).all():
        return None
    corner, count = origin + lattice.spacing * first, (last - first + 1).astype(int)
    part = replace(lattice, low=(float(corner[0]), float(corner[1]), float(corner[2])), n=(int(count[0]), int(count[1]), int(count[2])), jitter=0.0)
    return part, first.astype(int)


def positions(lattice: Lattice, variables: Variables) -> np.ndarray:
    """Particles of a lattice (n, 3) [L]; none where an expression has no value there, which the deck reports."""
    try:
        return np.stack([axis.all() + np.zeros(len(axis.values if axis.codes is None else axis.codes)) for axis in lattice_points(lattice, 0, variables)], axis=1)
    except Fault:
        return np.zeros((0, 3))


def check_overlaps(lattices: list[Lattice], variables: Variables, diagnostics: Diagnostics) -> None:
    """Refuses water that is in two blocks: a particle of one is in the cell of a particle of the other. Boxes are compared first, so that blocks beside
    each other cost nothing."""
    low = np.array([one.low for one in lattices]).reshape(-1, 3)
    high = low + np.array([one.spacing * np.array(one.n) for one in lattices]).reshape(-1, 3)
    for b in range(1, len(lattices)):
        grain = (0.5 + _TINY) * lattices[b].spacing  # less than half a spacing is the round-off of corners, or a seam
        dim = lattices[b].dim
        common = (np.minimum(high[:b], high[b]) - np.maximum(low[:b], low[b]))[:, :dim]
        for a in np.flatnonzero((common > grain).all(axis=1)):
            found = _in_cells_of(lattices[b], lattices[a], variables)
            if len(found):
                at = ", ".join(shortest(round(float(v), 9)) for v in found[0, :dim])
                count = "1 particle" if len(found) == 1 else f"{len(found)} particles"
                diagnostics.error(lattices[b].location, f"the water is in two blocks: {count} of this one {'is' if len(found) == 1 else 'are'} in the block of line "
                                  f"{lattices[a].location.line}, the first at {at}", "end one block where the other begins, or cut it by 'where'")
                break


def _in_cells_of(inner: Lattice, outer: Lattice, variables: Variables) -> np.ndarray:
    """Particles of `inner` in cells of `outer` that have a particle, (n, 3) [L]."""
    dx, origin = outer.spacing, np.array(outer.low)
    region = cropped(inner, origin, origin + dx * np.array(outer.n))
    x = positions(region[0], variables) if region else np.zeros((0, 3))
    if not len(x):
        return x
    margin = 0.5 * dx * (1 + _TINY)
    other = cropped(outer, x.min(axis=0) - margin, x.max(axis=0) + margin)
    if other is None:
        return x[:0]
    y, corner = positions(other[0], variables), np.array(other[0].low)
    taken = np.zeros(other[0].n, dtype=bool)
    cells = np.floor((y - corner) / dx).astype(int)
    at = np.floor((x - corner) / dx).astype(int)
    if outer.dim == 2:
        cells[:, 2] = at[:, 2] = 0
    taken[tuple(cells.T)] = True
    kept = np.flatnonzero(((at >= 0) & (at < taken.shape)).all(axis=1))
    found: np.ndarray = x[kept[taken[tuple(at[kept].T)]]]
    return found


def check_piston(piston: Piston, solid: Solid, lattices: list[Lattice], variables: Variables, diagnostics: Diagnostics) -> None:
    """The water beside a wave maker is on the side that `towards` names, and as deep as `depth`."""
    dim, a = lattices[0].dim, "xyz".index(piston.axis)
    dx = lattices[0].spacing
    ahead, behind = (_column(solid, a, sign * piston.sign, lattices, variables) for sign in (1.0, -1.0))
    name = solid.shape.name or "the wall"
    if not len(ahead):
        side, other = (piston.axis, "-" + piston.axis)[:: 1 if piston.sign > 0 else -1]
        if len(behind):
            diagnostics.error(piston.where_towards, f"waves: '{name}' moves towards {side}, but its water is towards {other}", f"towards: {other}")
        else:
            diagnostics.warning(piston.where_towards, f"waves: no water is within {_NEAR} spacings of '{name}' towards {side}", "let the water begin at the wall")
        return
    up = dim - 1
    found = float(np.ptp(ahead[:, up])) + dx
    if piston.depth > 0 and abs(found - piston.depth) > dx * (1 + _TINY):
        diagnostics.warning(piston.where, f"waves: the depth is {shortest(piston.depth)}, but the water beside '{name}' is {shortest(round(found, 6))} deep: "
                            "the waves have another height", f"depth: {shortest(round(found, 6))}")


def _column(solid: Solid, axis: int, sign: float, lattices: list[Lattice], variables: Variables) -> np.ndarray:
    """Particles within some spacings of a wall on one side of it, of any height, (n, 3) [L]."""
    dim, dx = lattices[0].dim, lattices[0].spacing
    low, high = np.full(3, -np.inf), np.full(3, np.inf)
    for k in range(dim - 1):  # upwards is free: waves need all of the depth
        low[k], high[k] = solid.shape.low[k] - dx, solid.shape.high[k] + dx
    face = float(solid.shape.high[axis] if sign > 0 else solid.shape.low[axis])
    low[axis], high[axis] = (face, face + _NEAR * dx) if sign > 0 else (face - _NEAR * dx, face)
    parts = [part for one in lattices if (part := cropped(one, low, high)) is not None]
    return np.concatenate([positions(part, variables) for part, _ in parts]) if parts else np.zeros((0, 3))
