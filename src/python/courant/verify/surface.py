"""Depth of the water on an upright line, by the rules of `courant post`."""
from __future__ import annotations

import numpy as np

from ..expressions import Formula, constant_value
from ..post.kinds_states import depth_over
from ..post.particles import ParticleSet, SprayRule, water_body, water_on_lines
from ..variables import VARIABLES
from .model import Observation
from .observe import Looking, Measured, NotFound, Run, Window
from .particles import Selection, StateTable
from .registry import observation
from .series import Series


def _depth(state: StateTable, where: Selection, x: float, bed: float) -> float:
    """The top of the highest piece of water over the bed on the line at x; spray does not count. [L]"""
    counts = np.zeros(state.size, dtype=bool)
    counts[where.of(state)] = True
    water = water_body(ParticleSet.of(state.frame, counts), SprayRule())
    pieces, _ = water_on_lines(water, np.array([[x, 0.0, 0.0]]), 1)
    return float(depth_over(pieces, np.array([bed]), water.largest_h)[0])


@observation("surface")
def surface(o: Observation, run: Run) -> Looking:
    """Depth of the water at `x` over `bed` in each field state of a plane flow, over time; 0 where there is none."""
    x, bed = constant_value(o.x, run.variables), constant_value(o.bed or "0", run.variables)
    where = Selection(o.where, Formula("0", VARIABLES, run.variables), run.variables)
    run.noted(where.formula)
    times = np.array([state.t for state in run.states])
    start, end = Window.of(o, run.variables).widened(times)
    points: list[tuple[float, float]] = []
    for i in np.flatnonzero((times >= start) & (times <= end)).tolist():
        state = yield i
        if state.frame.dim != 2:
            raise NotFound("a surface is observed in plane flows alone")
        points.append((state.t, _depth(state, where, x, bed)))
    return Measured.of(o, run, Series(*np.array(points).reshape(-1, 2).T))
