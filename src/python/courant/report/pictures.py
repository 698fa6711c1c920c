"""First, middle and last state in the pictures of `courant view`: the same camera, axes and colours for all three."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..post.view_fields import UnknownField, field_names, field_of
from ..post.view_scene import View, scene_of
from ..post.views import draw_view
from ..results import Results
from .html import paragraph, picture
from .sources import unit_names

_DPI = 90
_APART = 30.0  # a scene that has grown so many times has flown apart
_STRESS = ("von_mises", "plastic_strain")
_CAPTIONS = {"particles": "particles by speed", "von_mises": "von Mises stress (of shells the largest of their layers)"}
_UNITS = {"von_mises": "M/LT2", "axial_force": "ML/T2"}


def _extent(state: Any) -> float:
    """Of the points of a state, without the farthest hundredth [L]; infinite where one is no number."""
    meshes = [*state.elements, *([state.particles] if state.particles is not None else [])]
    x = np.concatenate([mesh.points for mesh in meshes])
    if not np.isfinite(x).all():
        return np.inf
    low, high = np.percentile(x, (1, 99), axis=0)
    return float((high - low).max())


def _chosen(run: Results) -> tuple[list[float], str]:
    """Times of the first, a middle and the last state that has not flown apart, and a word where that is not the last one."""
    states = run.states
    first, last = _extent(states[0]) or 1.0, len(states) - 1
    while last > 0 and not _extent(states[last]) <= _APART * first:
        last -= 1
    said = ""
    if apart := len(states) - 1 - last:
        said = f"{apart} later states are not drawn: they have flown apart, to more than {_APART:g} times the size"
    return [float(states.times[k]) for k in dict.fromkeys((0, last // 2, last))], said


def _values(state: Any, field: str) -> dict[int, float]:
    """Largest size of a field by part; nothing where the files lack it."""
    out: dict[int, float] = {}
    for mesh in state.elements:
        if field not in field_names(mesh):
            continue
        found = field_of(mesh, field)
        if found.at != "elements" or "part" not in mesh.names:
            out[-1] = max(out.get(-1, 0.0), float(np.nanmax(np.abs(found.values), initial=0.0)))
            continue
        part = np.asarray(mesh["part"])
        for one in np.unique(part):
            mine = found.values[part == one]
            out[int(one)] = max(out.get(int(one), 0.0), float(np.nanmax(np.abs(mine), initial=0.0)))
    return out


def _views(run: Results, times: list[float]) -> list[View]:
    """Of particles by speed; of elements by von Mises stress, and by plastic strain where there is any, else by axial force or speed."""
    states = [run.states.at(t) for t in times]
    views, unit = [], unit_names(run)
    if any(one.particles is not None and len(one.particles) for one in states):
        views.append(View("particles", "speed" if states[0].particles is not None and "velocity" in states[0].particles else "", of="particles", times=times, title=" "))
    if not any(one.elements for one in states):
        return views
    walls_only = bool(views) and _are_walls(states)
    for field in () if walls_only else (*_STRESS, "axial_force"):
        found = [_values(one, field) for one in states]
        parts = {part for one in found for part in one}
        bare = tuple(part for part in parts if not any(one.get(part, 0.0) > 0 for one in found))
        if len(bare) < len(parts) and not (field == "axial_force" and len(views) > 1):
            name = unit(_UNITS[field]) if field in _UNITS else ""
            views.append(View(field, field, of="elements", times=times, title=" ", bare=bare, unit=name))
    if not views and not walls_only:
        views.append(View("speed", "speed", of="elements", times=times, title=" "))
    return views


def _are_walls(states: list[Any]) -> bool:
    """Whether elements beside particles have no stress: rigid walls, which the picture of the particles shows."""
    return not any(value > 0 for one in states for field in _STRESS for value in _values(one, field).values())


def pictures(run: Results) -> str:
    """A row of three pictures for each field. Raises CourantError where there are no states."""
    times, said = _chosen(run)
    out = ""
    for view in _views(run, times):
        try:
            scenes = [scene_of(run.states.at(t), view) for t in times]
            figure = draw_view(run, view, scenes, dpi=_DPI)
        except UnknownField as fault:
            out += paragraph(f"{view.name}: {fault}")
            continue
        count = len(run.states)
        what = _CAPTIONS.get(view.name, view.name.replace("_", " "))
        grey = f"; grey: without it (part {', '.join(map(str, sorted(p for p in view.bare if p >= 0)))})" if any(p >= 0 for p in view.bare) else ""
        width = figure.get_figwidth()
        out += picture(figure, f"{what}; first, middle and last of {count} states{grey}", "states" if width > 6 else "states narrow", _DPI)
    return out + (paragraph(said) if said else "")
