"""Where the particles of a lattice are, and values of expressions there."""
from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..expressions import ExpressionFault, PlaceFormula
from .model import Fault, Lattice, PlaceExpression, Variables

_GOLDEN, _FIRST, _SECOND = (np.uint64(c) for c in (0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB))


def _mixed(z: np.ndarray) -> np.ndarray:
    """Steele, Lea, Flood 2014, SplitMix64: a bijection whose output bits each depend on all input bits."""
    z = z + _GOLDEN
    z = (z ^ (z >> np.uint64(30))) * _FIRST
    z = (z ^ (z >> np.uint64(27))) * _SECOND
    return z ^ (z >> np.uint64(31))


def scattered(stream: int, index: np.ndarray) -> np.ndarray:
    """Numbers from [-1, 1) that depend on the arguments alone and have the same bits on every machine. Numbers of neighbouring arguments have nothing
    to do with each other."""
    bits = _mixed(_mixed(np.array([stream], dtype=np.uint64)) + index.astype(np.uint64))
    return np.ldexp((bits >> np.uint64(11)).astype(float), -52) - 1  # 53 bits: exact in a double


def values_at(expression: PlaceExpression, what: str, points: Sequence[np.ndarray], variables: Variables) -> np.ndarray:
    """Values at positions, three arrays of shape (n,). Raises Fault at the first that has none."""
    first, size = 0, len(points[0])
    try:
        formula = PlaceFormula(expression.text, variables)
        values = formula.over(points, size)
        bad = np.flatnonzero(np.isnan(values))
        if not len(bad):
            return values
        first = int(bad[0])
        formula.at([float(axis[first]) for axis in points])
        reason = "the result is not a finite number"
    except ExpressionFault as fault:
        reason = fault.message + (f", {fault.hint}" if fault.hint else "")
    x, y, z = (float(axis[first]) if size else 0.0 for axis in points)
    raise Fault(expression.where, f"{what}: {reason} at x = {x:g}, y = {y:g}, z = {z:g}, got '{expression.text}'")


class Axis:
    """One coordinate of many particles: distinct values with the number of each particle's, or one value for each."""

    def __init__(self, values: np.ndarray, codes: np.ndarray | None = None) -> None:
        self.values, self.codes = values, codes

    def all(self) -> np.ndarray:
        return self.values if self.codes is None else self.values[self.codes]


def lattice_points(lattice: Lattice, stream: int, variables: Variables) -> list[Axis]:
    """The centres of a lattice's cells, x outermost, z innermost, without those where `where` is not > 0, and shifted by the jitter (after `where` was
    asked). `stream` tells lattices apart, so that no two of them have the same shifts. [L] Raises Fault."""
    centres = [lattice.low[k] + lattice.spacing * (np.arange(lattice.n[k], dtype=float) + 0.5) for k in range(3)]
    if lattice.dim == 2:
        centres[2] = np.zeros(1)
    shape = lattice.n
    codes = [np.broadcast_to(np.arange(shape[k], dtype=np.int32).reshape([-1 if a == k else 1 for a in range(3)]), shape).ravel() for k in range(3)]
    axes = [Axis(centre, code) for centre, code in zip(centres, codes)]
    cells: np.ndarray | None = None
    if lattice.where or lattice.solids or lattice.without:
        inside = _chosen(lattice, [axis.all() for axis in axes], variables)
        cells = np.flatnonzero(inside)
        axes = [Axis(axis.values, axis.codes[cells]) for axis in axes if axis.codes is not None]
    if lattice.jitter > 0:
        numbers = np.arange(len(codes[0])) if cells is None else cells
        for k in range(lattice.dim):
            axes[k] = Axis(axes[k].all() + lattice.jitter * lattice.spacing * scattered(stream, 3 * numbers + k))
    return axes


def _chosen(lattice: Lattice, points: list[np.ndarray], variables: Variables) -> np.ndarray:
    """Which cells have a particle, shape (n,)."""
    chosen = np.ones(len(points[0]), dtype=bool)
    if lattice.where:
        chosen &= values_at(lattice.where, "where", points, variables) > 0
    for shapes, keep in ((lattice.solids, True), (lattice.without, False)):
        if shapes:
            some = np.flatnonzero(chosen)
            x = np.stack([axis[some] for axis in points], axis=1)
            inside = np.zeros(len(some), dtype=bool)
            for shape in shapes:
                inside |= shape.contains(x)
            chosen[some] = inside == keep
    return chosen
