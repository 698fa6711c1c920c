"""What a view shows of one state, gathered: particles with their values, coloured faces, and walls."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..diagnostics import CourantError
from ..optional import module
from ..yaml_map import key
from .camera import AXES, PROJECTIONS
from .figures import COLOURS
from .view_fields import Bars, Faces, FieldValues, UnknownField, bars_of, faces_of, field_names, field_of, joined_faces, mirrored


OF, WALLS = ("", "particles", "elements"), ("transparent", "outlined", "none")


@dataclass(frozen=True)
class View:
    """A picture that is asked for. `field`: "" for speed or else plastic_strain; `of`: "", particles or elements; `times`: [T], None for the
    last state; `range`: of the colours, in the unit shown; `window`: limits of x, y, z [L], None for all; `up`: "" for that of gravity;
    `azimuth`, `elevation`: None for those that suit; `projection`: in space, parallel or perspective; `theory`: an expression of x with `theory_range` and `theory_label`; `unit`, `factor`: shown are
    values times the factor; `mirror`: axes, as "xz"; `animate`: "", gif or mp4 of all states from `times[0]` to `times[-1]`."""

    name: str = key("text", required=True)
    field: str = key("text", "")
    of: str = key("choice", "", words=OF)
    times: list[float] | None = None
    range: tuple[float, float] | None = key("range", None)
    colours: str = key("choice", COLOURS[0], words=COLOURS)
    up: str = key("choice", "", words=("", *AXES))
    azimuth: float | None = None
    elevation: float | None = None
    projection: str = key("choice", PROJECTIONS[0], words=PROJECTIONS)
    window: tuple[tuple[float, float] | None, ...] = (None, None, None)
    walls: str = key("choice", WALLS[0], words=WALLS)
    title: str = key("text", "")
    unit: str = key("text", "")
    factor: float = key("number", 1.0)
    mirror: str = ""
    columns: int = 0
    lines: bool = key("flag", True)
    depth: bool = key("flag", False)
    bed: float = key("number", 0.0)
    gauges: list[float] = dataclasses.field(default_factory=list)
    theory: Any = None
    theory_range: tuple[float, float] | None = None
    theory_label: str = "theory"
    animate: str = key("choice", "", words=("", "gif", "mp4"))
    rate: float = key("positive", 12.0)
    bare: tuple[int, ...] = ()  # parts without colour, as rigid ones, whose stress means nothing

    def __post_init__(self) -> None:
        """Raises ValueError where a word is none of those that there are; recipes have reported before."""
        words = {"of": OF, "walls": WALLS, "up": ("", *AXES), "projection": PROJECTIONS}
        for key, known in words.items():
            if getattr(self, key) not in known:
                raise ValueError(f"'{key}' cannot be '{getattr(self, key)}'; it is one of {', '.join(filter(None, known))}")
        if set(self.mirror) - set("xyz"):
            raise ValueError(f"'mirror' cannot be '{self.mirror}'; it is of x, y and z, as 'xz'")


@dataclass
class Scene:
    """`x`: (n, 3) and `V`: (n,) of the particles, in the plane an area [L2]; `h`: (n,) [L]; `values`: (n,) in the unit shown, None where
    elements are coloured; `faces` with `colours`: (faces, 4) values at their corners; `walls`: faces without colour; `bars`: (bars, 2, 3)
    ends of beams and springs [L] with `bar_values`: (bars,), NaN of those without colour."""

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
    bars: np.ndarray = dataclasses.field(default_factory=lambda: np.empty((0, 2, 3)))
    bar_values: np.ndarray = dataclasses.field(default_factory=lambda: np.empty(0))

    @property
    def shown(self) -> np.ndarray:
        """All values that get colours, (m,)."""
        return np.concatenate([one.ravel() for one in (self.values, self.colours, self.bar_values[np.isfinite(self.bar_values)]) if one is not None])

    def corners(self) -> np.ndarray:
        """All points that must be in the picture, (n, 3) [L]."""
        used = [one.x[np.unique(one.corners)] for one in (self.faces, self.walls) if one is not None and len(one)]
        return np.concatenate([self.x, self.bars.reshape(-1, 3), *used])


def _chosen(state: Any, view: View) -> list[tuple[Any, FieldValues]]:
    """The meshes that get colours, and their values: the particles where they have the field, else all shells and solids that do.

    Raises UnknownField.
    """
    particles, elements = [state.particles] if state.particles is not None else [], list(state.elements)
    kinds = [kind for word, kind in (("particles", particles), ("elements", elements)) if view.of in ("", word) and kind]
    if not kinds:
        raise UnknownField(f"the state at t = {state.t:g} has no {view.of or 'particles or elements'}")
    name = view.field
    if not name:
        name = "plastic_strain" if kinds[0] is elements and any("plastic_strain" in field_names(mesh) for mesh in elements) else "speed"
    for kind in kinds:
        if found := [(mesh, field_of(mesh, name)) for mesh in kind if name in field_names(mesh)]:
            return found
    faults = []
    for mesh in [mesh for kind in kinds for mesh in kind]:
        try:
            field_of(mesh, name)
        except UnknownField as fault:
            faults.append(str(fault))
    raise UnknownField("; ".join(faults))


def spoken(name: str) -> str:
    """ "stress_upper.mises" -> "stress upper, von Mises"."""
    array, _, part = name.partition(".")
    return array.replace("_", " ").replace("von mises", "von Mises") + {"": "", "mises": ", von Mises", "mean": ", mean"}.get(part, f" {part}")


def _within(x: np.ndarray, window: tuple[Any, ...]) -> np.ndarray:
    inside = np.ones(len(x), dtype=bool)
    for axis, limits in enumerate(window):
        if limits is not None:
            inside &= (x[:, axis] >= limits[0]) & (x[:, axis] <= limits[1])
    return inside


def _face_values(found: FieldValues, faces: Faces) -> np.ndarray:
    """Values at the corners of faces, (faces, 4): of elements the same one four times."""
    return found.values[faces.corners] if found.at == "nodes" else np.repeat(found.values[faces.cell][:, None], 4, axis=1)


def _particles(mesh: Any, view: View, values: np.ndarray, flat: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """x, V, h and values of the active particles, in space of those within the window: in the plane their neighbours count, too."""
    if lacking := [name for name in ("mass", "density", "smoothing_length") if name not in mesh]:
        hint = "FIELDS of *COURANT_OUTPUT left them out; `missing` of a recipe may give density and smoothing_length"
        raise UnknownField(f"{mesh.path} lacks {', '.join(lacking)}, without which particles have no size: {hint}")
    with np.errstate(divide="ignore", invalid="ignore"):
        V = mesh["mass"].astype(float) / mesh["density"]
    on = (flat | _within(mesh.points, view.window)) & np.isfinite(V) & (V > 0) & np.isfinite(mesh.points).all(axis=1) & np.isfinite(values)
    if "active" in mesh:
        on &= mesh["active"] > 0
    return mesh.points[on], V[on], mesh["smoothing_length"].astype(float)[on], values[on] * view.factor


def _solid_parts(state: Any, chosen: dict[Any, FieldValues]) -> np.ndarray:
    """Parts whose faces for contact in the file of shells would hide, without a stress, the faces of the solids that they are."""
    shells, solids = state.shells, state.solids
    if shells is None or solids is None or shells.path == solids.path or (shells.path in chosen) > (solids.path in chosen) or "part" not in solids.names:
        return np.empty(0)
    volumes = np.array([len(cell) > 3 for cell in solids.cells], dtype=bool)
    return np.unique(np.asarray(solids["part"])[volumes])


def _elements(state: Any, view: View, chosen: dict[Any, FieldValues], flat: bool) -> tuple[Faces | None, np.ndarray | None, Faces | None]:
    """Faces that get colours, values at their corners, and other faces: walls. Faces without a finite value are walls, too."""
    shown: list[Faces] = []
    values: list[np.ndarray] = []
    others: list[Faces] = []
    solid = _solid_parts(state, chosen)
    for mesh in state.elements:
        every = faces_of(mesh)
        if len(solid) and mesh.path != state.solids.path:
            every = every.part_of(~np.isin(every.part, solid))
        if not flat:
            every = every.part_of(_within(every.x[every.corners].mean(axis=1), view.window))
        if mesh.path not in chosen:
            others.append(every)
            continue
        at = _face_values(chosen[mesh.path], every)
        known = np.isfinite(at).all(axis=1) & ~np.isin(every.part, view.bare)
        shown.append(every.part_of(known))
        values.append(at[known] * view.factor)
        others.append(every.part_of(~known))
    faces = joined_faces(shown)
    return faces, None if faces is None else np.concatenate(values), joined_faces(others)


def _bar_values(found: FieldValues | None, mesh: Any, bars: Bars) -> np.ndarray:
    """(bars,), of nodes the mean of both ends; NaN of files without the field."""
    if found is None:
        return np.full(len(bars), np.nan)
    if found.at == "nodes":
        return np.array([found.values[mesh.cells[k]].mean() for k in bars.cell])
    return found.values[bars.cell]


def _bars(state: Any, view: View, chosen: dict[Any, FieldValues]) -> tuple[np.ndarray, np.ndarray]:
    """Ends of beams and springs within the window, and their values in the unit shown."""
    every = [(mesh, bars_of(mesh)) for mesh in state.elements]
    x = np.concatenate([np.empty((0, 2, 3)), *(bars.x for _, bars in every)])
    values = np.concatenate([np.empty(0), *(_bar_values(chosen.get(mesh.path), mesh, bars) for mesh, bars in every)])
    if view.bare and len(x):
        values[np.isin(np.concatenate([bars.part for _, bars in every]), view.bare)] = np.nan
    inside = _within(x.mean(axis=1), view.window) & np.isfinite(x).all(axis=(1, 2))
    return x[inside], values[inside] * view.factor


def _mirror_sign(name: str, axis: str, flat: bool) -> int:
    """-1 for components that change their sign in a mirror across an axis: "velocity.x" and "stress.xy" across x, "vorticity.z" across x and y."""
    array, _, part = name.partition(".")
    if array == "vorticity":
        part = part or ("z" if flat else "")
        return -1 if part and part != axis else 1
    return -1 if set(part) <= set("xyz") and part.count(axis) % 2 else 1


def scene_of(state: Any, view: View) -> Scene:
    """What the view shows of one state; particles are left out where elements get the colours. Raises UnknownField, CourantError."""
    found = _chosen(state, view)
    label = f"{spoken(found[0][1].name)} [{view.unit or found[0][1].unit}]"
    mesh, of_particles = state.particles, found[0][1].at == "particles"
    flat = of_particles and len(mesh) > 0 and bool((mesh.points[:, 2] == mesh.points[0, 2]).all())
    x, V, h, values = np.empty((0, 3)), np.empty(0), np.empty(0), None
    if of_particles:
        x, V, h, values = _particles(mesh, view, found[0][1].values, flat)
    chosen = {} if of_particles else {one.path: field for one, field in found}
    faces, colours, walls = _elements(state, view, chosen, flat)
    bars, bar_values = (np.empty((0, 2, 3)), np.empty(0)) if flat else _bars(state, view, chosen)
    if not _within(x, view.window).any() and faces is None and not len(bars):
        raise UnknownField(f"nothing is within the window at t = {state.t:g}")
    for axis in view.mirror:
        a, sign = "xyz".index(axis), _mirror_sign(found[0][1].name, axis, flat)
        if faces is not None and colours is not None:
            faces, colours = mirrored(faces, a), np.concatenate((colours, sign * colours))
        if values is not None:
            x, values = np.concatenate((x, x * np.where(np.arange(3) == a, -1, 1))), np.concatenate((values, sign * values))
            V, h = np.concatenate((V, V)), np.concatenate((h, h))
        bars, bar_values = np.concatenate((bars, bars * np.where(np.arange(3) == a, -1, 1))), np.concatenate((bar_values, sign * bar_values))
    return Scene(state.t, flat, x, V, h, values, faces, colours, walls, label, bars, bar_values)


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
