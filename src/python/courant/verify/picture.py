"""A picture of the particles of a run."""
from __future__ import annotations

import math
import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..diagnostics import Diagnostics
from ..expressions import ExpressionFault, Formula, constant_value
from ..fields import read_states
from ..optional import module
from .model import Case, Picture, Variables
from .names import PARTICLE_VARIABLES
from .particles import Selection, StateFault, StateTable, nearest_state
from .series import percentile

_WIDEST, _HIGHEST = 640, 480  # pixels
_SHARE_OF_H = 0.75  # of a dot's radius: just closes the gaps of a square lattice with h = dx
_NEIGHBOURS = 4  # particles that are asked whether they reach a pixel
# From dark to light, so that it reads without colours, too.
_ANCHORS = np.array([[58, 34, 104], [44, 96, 148], [32, 148, 136], [116, 194, 82], [248, 226, 66]], dtype=float)


def _colours(share: np.ndarray) -> np.ndarray:
    """Colours of values from 0 to 1; shape (n, 3) of bytes."""
    place = np.clip(share, 0, 1) * (len(_ANCHORS) - 1)
    colours = np.column_stack([np.interp(place, np.arange(len(_ANCHORS)), channel) for channel in _ANCHORS.T])
    return np.floor(colours + 0.5).astype(np.uint8)


def png_of(pixels: np.ndarray) -> bytes:
    """A PNG file of pixels; shape (rows, columns, 3) of bytes."""
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows, columns, _ = pixels.shape
    lines = np.concatenate([np.zeros((rows, 1), np.uint8), pixels.reshape(rows, -1)], axis=1)
    head = struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines.tobytes(), 9)) + chunk(b"IEND", b"")


def _axes(x: np.ndarray) -> tuple[int, int]:
    """The two axes of the picture, the upright one last: those in which the particles extend most."""
    extent = np.ptp(x, axis=0)
    least = 2 if extent[2] == 0 else int(np.argmin(extent))
    return ((1, 2), (0, 2), (0, 1))[least]


@dataclass
class _Dots:
    """Places in the plane of the picture, (n, 2), radius and value of each particle, (n,)."""

    place: np.ndarray
    radius: np.ndarray
    value: np.ndarray

    def image(self, low: float, high: float) -> np.ndarray:
        """Each pixel has the colour of the nearest particle that reaches it, white where there is none."""
        margin = float(np.max(self.radius))
        left, top = np.min(self.place[:, 0]) - margin, np.max(self.place[:, 1]) + margin
        across, upright = np.ptp(self.place, axis=0) + 2 * margin
        pixel = max(across / _WIDEST, upright / _HIGHEST)
        columns, rows = max(1, math.ceil(across / pixel)), max(1, math.ceil(upright / pixel))
        centres = np.column_stack([(self.place[:, 0] - left) / pixel - 0.5, (top - self.place[:, 1]) / pixel - 0.5])
        radius = np.maximum(0.75, self.radius / pixel)
        asked = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=-1).reshape(-1, 2)
        k = min(_NEIGHBOURS, len(centres))
        tree, reach = module("scipy.spatial").cKDTree(centres), float(np.max(radius)) * (1 + 1e-12)
        distance, index = tree.query(asked, k=np.arange(1, k + 1), distance_upper_bound=reach)
        reaches = distance <= np.append(radius, -1.0)[index]  # the last stands for no particle
        found = np.where(reaches.any(axis=1), index[np.arange(len(index)), np.argmax(reaches, axis=1)], len(radius))
        share = (self.value - low) / (high - low) if high > low else np.full(len(self.value), 0.5)
        palette = np.concatenate([_colours(share), np.full((1, 3), 255, np.uint8)])
        return palette[found].reshape(rows, columns, 3)


def _dots(state: StateTable, of: Formula, where: Selection) -> _Dots:
    """Particles of the state that are to be seen."""
    chosen = where.of(state)
    value = state.values(of, chosen)
    chosen, value = chosen[np.isfinite(value)], value[np.isfinite(value)]
    x = np.column_stack([state.columns[name][chosen] for name in "xyz"])
    place = x[:, _axes(x)] if len(x) else x[:, :2]
    return _Dots(place, _SHARE_OF_H * state.length[chosen], value)


def draw_particles(case: Case, variables: Variables, folder: Path) -> Picture | None:
    """The particles of the state at `picture_at` (the last one if blank), in colours by `picture_of`, seen along -z (in 3D along the direction in
    which they extend least). The scale goes from the 1st to the 99th percentile. None if the run has no such state."""
    states = read_states(folder, Diagnostics())
    of = Formula(case.picture_of, PARTICLE_VARIABLES, variables)
    where = Selection(case.picture_where, of, variables)
    if not states or not of.ok or not where.formula.ok:
        return None
    try:
        index = nearest_state(states, constant_value(case.picture_at, variables)) if case.picture_at else len(states) - 1
        state = StateTable(states[index], of.used | where.formula.used) if index is not None else None
    except (ExpressionFault, StateFault):
        return None
    dots = _dots(state, of, where) if state else None
    if state is None or dots is None or len(dots.value) == 0:
        return None
    low, high = percentile(dots.value, 0.01), percentile(dots.value, 0.99)
    title = f"{case.picture_title or case.picture_of}, t = {state.t:.4g}, {len(dots.value)} particles"
    return Picture(png_of(dots.image(low, high)), title, f"{low:.3g}", f"{high:.3g}")
