"""A picture of the particles of a run."""
from __future__ import annotations

import io
import math
from pathlib import Path

import numpy as np

from ..diagnostics import Diagnostics
from ..expressions import ExpressionFault, Formula, constant_value
from ..fields import read_states
from ..optional import module
from ..style import FIELD_COLOURS
from ..variables import VARIABLES
from .model import Case, Picture, Variables
from .particles import Selection, StateFault, StateTable, nearest_state
from .series import percentile

_WIDEST, _HIGHEST = 640, 480  # pixels
_SHARE = 0.72  # of the spacing of particles, a ball's radius: just closes the gaps of a square lattice


def _axes(x: np.ndarray) -> tuple[int, int]:
    """The two axes of the picture, the upright one last: those in which the particles extend most."""
    extent = np.ptp(x, axis=0)
    least = 2 if extent[2] == 0 else int(np.argmin(extent))
    return ((1, 2), (0, 2), (0, 1))[least]


def _png(place: np.ndarray, radius: np.ndarray, value: np.ndarray, low: float, high: float) -> bytes:
    """A PNG file of balls, the nearest in front. place: (n, 3), right, upward and toward the eye; radius: (n,) [L]; value: (n,)."""
    from ..post.raster import Raster

    margin = float(np.max(radius))
    across, upright = np.ptp(place[:, :2], axis=0) + 2 * margin
    pixel = max(across / _WIDEST, upright / _HIGHEST)
    size = max(1, math.ceil(across / pixel)), max(1, math.ceil(upright / pixel))
    raster = Raster(np.min(place[:, 0]) - margin, np.max(place[:, 1]) + margin, *size, 1 / pixel)
    share = np.clip((value - low) / (high - low), 0, 1) if high > low else np.full(len(value), 0.5)
    raster.spheres(place, radius, module("matplotlib.pyplot").get_cmap(FIELD_COLOURS)(share)[:, :3])
    file = io.BytesIO()
    module("matplotlib.pyplot").imsave(file, np.clip(raster.colour, 0, 1), format="png")
    return file.getvalue()


def draw_particles(case: Case, variables: Variables, folder: Path) -> Picture | None:
    """The particles of the state at `picture_at` (the last one if blank), in colours by `picture_of`, seen along -z (in 3D along the direction in
    which they extend least). The scale goes from the 1st to the 99th percentile. None if the run has no such state."""
    states = read_states(folder, Diagnostics())
    of = Formula(case.picture_of, VARIABLES, variables)
    where = Selection(case.picture_where, of, variables)
    if not states or not of.ok or not where.formula.ok:
        return None
    try:
        index = nearest_state(states, constant_value(case.picture_at, variables)) if case.picture_at else len(states) - 1
        state = StateTable(states[index], of.used | where.formula.used) if index is not None else None
    except (ExpressionFault, StateFault):
        return None
    if state is None:
        return None
    chosen = where.of(state)
    value = state.values(of, chosen)
    chosen, value = chosen[np.isfinite(value)], value[np.isfinite(value)]
    if len(value) == 0:
        return None
    low, high = percentile(value, 0.01), percentile(value, 0.99)
    x = state.frame.x[chosen]
    right, upright = _axes(x)
    title = f"{case.picture_title or case.picture_of}, t = {state.t:.4g}, {len(value)} particles"
    png = _png(x[:, [right, upright, 3 - right - upright]], _SHARE * state.volume[chosen] ** (1 / state.frame.dim), value, low, high)
    return Picture(png, title, f"{low:.3g}", f"{high:.3g}")
