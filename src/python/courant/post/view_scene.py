"""What a view shows of one state, gathered: particles with their values, coloured faces, and walls."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..diagnostics import CourantError
from ..optional import module
from .view_fields import Faces, FieldValues, UnknownField, faces_of, field_names, field_of, mirrored


@dataclass(frozen=True)
class View:
    """A picture that is asked for. `field`: "" for speed or else plastic_strain; `of`: "", particles or elements; `times`: [T], None for the
    last state; `range`: of the colours, in the unit shown; `window`: limits of x, y, z [L], None for all; `up`: "" for that of gravity;
    `azimuth`: None for one that suits; `theory`: an expression of x with `theory_range` and `theory_label`; `unit`, `factor`: shown are
    values times the factor; `mirror`: axes, as "xz"; `animate`: "", gif or mp4 of all states from `times[0]` to `times[-1]`."""

    name: str
    field: str = ""
    of: str = ""
    times: list[float] | None = None
    range: tuple[float, float] | None = None
    colours: str = "viridis"
    up: str = ""
    azimuth: float | None = None
    elevation: float = 20.0
    window: tuple[tuple[float, float] | None, ...] = (None, None, None)
    walls: str = "transparent"
    title: str = ""
    unit: str = ""
    factor: float = 1.0
    mirror: str = ""
    columns: int = 0
    lines: bool = True
    depth: bool = False
    bed: float = 0.0
    gauges: list[float] = dataclasses.field(default_factory=list)
    theory: Any = None
    theory_range: tuple[float, float] | None = None
    theory_label: str = "theory"
    animate: str = ""
    rate: float = 12.0


@dataclass
class Scene:
    """`x`: (n, 3) and `V`: (n,) of the particles, in the plane an area [L2]; `h`: (n,) [L]; `values`: (n,) in the unit shown, None where
    elements are coloured; `faces` with `colours`: (faces, 4) values at their corners; `walls`: faces without colour."""

    t: float
    flat: bool
    x: np.ndarray
    V: np.ndarray
    h: np.ndarray
    values: np.ndarray | None
    faces: Faces | None
    colours: np.ndarray | None
    walls: Faces | None
    label: str

    @property
    def shown(self) -> np.ndarray:
        """All values that get colours, (m,)."""
        parts = [one.ravel() for one in (self.values, self.colours) if one is not None]
        out = np.concatenate(parts) if parts else np.empty(0)
        return out[np.isfinite(out)]

    def corners(self) -> np.ndarray:
        """All points that must be in the picture, (n, 3) [L]."""
        used = [one.x[np.unique(one.corners)] for one in (self.faces, self.walls) if one is not None and len(one)]
        return np.concatenate([self.x, *used])


def _chosen(state: Any, view: View) -> FieldValues:
    """The field, of the particles where they have it, else of nodes or elements. Raises UnknownField."""
    meshes = {"particles": state.particles, "elements": state.shells}
    if view.of and meshes[view.of] is None:
        raise UnknownField(f"the state at t = {state.t:g} has no {view.of}")
    found = [mesh for key, mesh in meshes.items() if mesh is not None and view.of in ("", key)]
    if not view.field:
        names = field_names(found[0])
        return field_of(found[0], "speed" if found[0] is state.particles else "plastic_strain" if "plastic_strain" in names else "speed")
    for mesh in found:
        if view.field in field_names(mesh):
            return field_of(mesh, view.field)
    faults = []
    for mesh in found:
        try:
            field_of(mesh, view.field)
        except UnknownField as fault:
            faults.append(str(fault))
    raise UnknownField("; ".join(faults))


def spoken(name: str) -> str:
    """ "stress_upper.mises" -> "stress upper, von Mises"."""
    array, _, part = name.partition(".")
    return array.replace("_", " ") + {"": "", "mises": ", von Mises", "mean": ", mean"}.get(part, f" {part}")


def _within(x: np.ndarray, window: tuple[Any, ...]) -> np.ndarray:
    inside = np.ones(len(x), dtype=bool)
    for axis, limits in enumerate(window):
        if limits is not None:
            inside &= (x[:, axis] >= limits[0]) & (x[:, axis] <= limits[1])
    return inside


def _face_values(found: FieldValues, faces: Faces) -> np.ndarray:
    """Values at the corners of faces, (faces, 4): of elements the same one four times."""
    return found.values[faces.corners] if found.at == "nodes" else np.repeat(found.values[faces.cell][:, None], 4, axis=1)


def scene_of(state: Any, view: View) -> Scene:
    """What the view shows of one state. Raises UnknownField, CourantError."""
    found = _chosen(state, view)
    label = f"{spoken(found.name)} [{view.unit or found.unit}]"
    x, V, h, values = np.empty((0, 3)), np.empty(0), np.empty(0), None
    faces = walls = colours = None
    mesh = state.particles
    flat = mesh is not None and len(mesh) > 0 and bool((mesh.points[:, 2] == mesh.points[0, 2]).all())
    if mesh is not None:
        on = np.ones(len(mesh), dtype=bool) if "active" not in mesh else mesh["active"] > 0
        on &= _within(mesh.points, view.window)
        with np.errstate(divide="ignore", invalid="ignore"):
            V_all = mesh["mass"].astype(float) / mesh["density"]
        on &= np.isfinite(V_all) & (V_all > 0) & np.isfinite(mesh.points).all(axis=1)
        x, V, h = mesh.points[on], V_all[on], mesh["smoothing_length"].astype(float)[on]
        values = found.values[on] * view.factor if found.at == "particles" else None
    if state.shells is not None:
        every = faces_of(state.shells)
        middle = every.x[every.corners].mean(axis=1)
        every = every.part_of(_within(middle, view.window)) if not flat else every
        if found.at == "particles":
            walls = every
        else:
            known = np.isfinite(_face_values(found, every)).all(axis=1)
            faces, walls = every.part_of(known), every.part_of(~known)
            colours = _face_values(found, faces) * view.factor
    for axis in view.mirror:
        a = "xyz".index(axis)
        if faces is not None:
            faces, _ = mirrored(faces, None, a)
            colours = np.concatenate((colours, colours)) if colours is not None else None
        x = np.concatenate((x, x * np.where(np.arange(3) == a, -1, 1)))
        V, h = np.concatenate((V, V)), np.concatenate((h, h))
        values = None if values is None else np.concatenate((values, values))
    return Scene(state.t, flat, x, V, h, values, faces, colours, walls if walls is not None and len(walls) else None, label)


def scenes_of(run: Any, view: View, times: list[float] | None = None) -> list[Scene]:
    """The states nearest to the wanted times, each once, the last one if none are named. Raises UnknownField, CourantError."""
    wanted = view.times if times is None else times
    states = [run.states[-1]] if wanted is None else [run.states.at(t) for t in wanted]
    once = {state.t: state for state in states}
    return [scene_of(state, view) for state in once.values()]


def colour_range(scenes: list[Scene], view: View) -> tuple[float, float, str]:
    """Lowest and highest value of the colour bar, and at which ends values lie beyond: neither, min, max or both.

    If the view does not tell: between the percentiles 1 and 99 of what is shown, from 0 where that is near.
    """
    values = np.concatenate([one.shown for one in scenes])
    if len(values) == 0:
        return *(view.range or (0.0, 1.0)), "neither"
    if view.range:
        low, high = view.range
    else:
        low, high = (float(one) for one in np.percentile(values, (1, 99)))
        if 0 <= low < 0.3 * high:
            low = 0.0
        if not high > low:
            low, high = float(values.min()), float(values.max())
        if not high > low:
            low, high = low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
        step = 10.0 ** (np.floor(np.log10(high - low)) - 1)  # two digits
        low, high = float(np.floor(low / step + 1e-6) * step), float(np.ceil(high / step - 1e-6) * step)
    below, above = bool((values < low - 1e-6 * (high - low)).any()), bool((values > high + 1e-6 * (high - low)).any())
    return low, high, {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[below, above]


def colours_of(values: np.ndarray, low: float, high: float, colours: str) -> np.ndarray:
    """RGB of values by a colour map of matplotlib, shape of values + (3,)."""
    shades = module("matplotlib.pyplot").get_cmap(colours)
    return shades(np.clip((values - low) / (high - low), 0, 1))[..., :3]


__all__ = ["CourantError", "Scene", "UnknownField", "View", "colour_range", "colours_of", "scene_of", "scenes_of"]
