"""Rendered pictures of scenes in space: shaded particles, faces with light, walls as a veil with outlines, axes and a scale."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..optional import module
from .camera import Camera, front_of, plane_of, standing_azimuth, up_of
from .raster import Raster
from .view_fields import Faces, outlines
from .view_scene import Scene, View, colours_of

_FINER = 2  # pixels that are averaged along each side
_ROD = 1.6  # half the thickness of beams [pixels]
_ARROW = {"arrowstyle": "-|>", "color": "0.2", "linewidth": 1, "mutation_scale": 7, "shrinkA": 0, "shrinkB": 0}
_GREY = np.array([0.62, 0.66, 0.70])  # of the veil that walls are


class Picture(NamedTuple):
    """`image`: (height, width, 3) in 0 to 1; `lines`: edges of walls, (2, 2) [L] each, and whether they are seen."""

    image: np.ndarray
    lines: list[tuple[np.ndarray, bool]]


def camera_of(run: Any, view: View, scenes: list[Scene]) -> Camera:
    """The camera of a view: what the view does not tell, gravity and the shape of the scene do."""
    flat = scenes[0].flat
    up = view.up or up_of(run, flat)
    corners = np.concatenate([one.corners() for one in scenes])
    azimuth, elevation = (0.0, 0.0) if flat else (standing_azimuth(np.ptp(corners, axis=0), up), 20.0)
    if not flat and view.azimuth is None and view.elevation is None and (normal := plane_of(corners)):
        up, azimuth, elevation = front_of(normal, view.up or up)
    camera = Camera.looking(up, azimuth if view.azimuth is None else view.azimuth, elevation if view.elevation is None else view.elevation)
    return camera.before(corners) if view.projection == "perspective" else camera


def frame_of(camera: Camera, scenes: list[Scene]) -> tuple[float, float, float, float]:
    """Left, right, bottom, top of what the camera sees of all scenes, with a margin [L]."""
    seen = np.concatenate([camera.project(one.corners()) for one in scenes])
    radius = max((float(np.cbrt(one.V.max())) for one in scenes if len(one.V)), default=0.0)
    low, high = seen[:, :2].min(axis=0) - radius, seen[:, :2].max(axis=0) + radius
    margin = 0.02 * float((high - low).max()) or 1.0
    return low[0] - margin, high[0] + margin, low[1] - margin - 0.11 * float((high - low).max()), high[1] + margin  # room for the axes


def _patches(walls: Faces, camera: Camera) -> list[np.ndarray]:
    """Faces of walls in groups that lie in one plane and belong to one part, from far to near; indices of faces."""
    normal = walls.normals()
    first = np.abs(normal).argmax(axis=1)
    normal *= np.sign(normal[np.arange(len(normal)), first])[:, None]
    middle = walls.x[walls.corners].mean(axis=1)
    size = float(np.ptp(walls.x, axis=0).max()) or 1.0
    keys = np.column_stack((walls.part, np.round(20 * normal), np.round(200 * (middle * normal).sum(axis=1) / size)))
    _, group = np.unique(keys, axis=0, return_inverse=True)
    toward = camera.project(middle)[:, 2]
    groups = [np.flatnonzero(group == k) for k in range(int(group.max()) + 1)]
    return sorted(groups, key=lambda faces: float(toward[faces].mean()))


def bodies_among(walls: Faces, x: np.ndarray) -> np.ndarray:
    """Faces that are drawn opaque, (faces,): of solids, of shells that deform, and of closed rigid shells that do not hold most of the particles x (n, 3)."""
    out = walls.deforms.copy()
    for part in np.unique(walls.part[~out]):
        mine = np.flatnonzero((walls.part == part) & ~out)
        sides = np.sort(np.concatenate([walls.corners[mine][:, [k, (k + 1) % 4]] for k in range(4)]), axis=1)
        _, number = np.unique(walls.x, axis=0, return_inverse=True)  # shells need not share their nodes
        sides = np.sort(number.ravel()[sides[sides[:, 0] != sides[:, 1]]], axis=1)
        _, count = np.unique(sides, axis=0, return_counts=True)
        points = walls.x[walls.corners[mine]].reshape(-1, 3)
        within = ((x >= points.min(axis=0)) & (x <= points.max(axis=0))).all(axis=1)
        out[mine] = bool((count == 2).all()) and within.sum() < 0.5 * max(len(x), 1)
    return out


def _draw_bars(raster: Raster, scene: Scene, view: View, camera: Camera, low: float, high: float) -> None:
    """Beams and springs as rods a few pixels thick, whatever their section."""
    if not len(scene.bars):
        return
    ends = camera.project(scene.bars.reshape(-1, 3)).reshape(-1, 2, 3)
    pixels = np.ceil(np.hypot(*(ends[:, 1] - ends[:, 0])[:, :2].T) * raster.scale).astype(int)
    steps = np.clip(pixels, 1, 4 * max(raster.size)) + 1
    bar = np.repeat(np.arange(len(ends)), steps)
    share = (np.arange(len(bar)) - np.repeat(np.cumsum(steps) - steps, steps)) / np.repeat(steps - 1, steps)
    at = ends[bar, 0] + share[:, None] * (ends[bar, 1] - ends[bar, 0])
    colour = np.where(np.isfinite(scene.bar_values)[:, None], colours_of(np.nan_to_num(scene.bar_values), low, high, view.colours), _GREY)
    raster.spheres(at, np.full(len(at), _ROD * _FINER / raster.scale), colour[bar])


def _draw_bodies(raster: Raster, scene: Scene, view: View, camera: Camera) -> None:
    if scene.walls is None or view.walls != "transparent":
        return
    bodies = scene.walls.part_of(bodies_among(scene.walls, scene.x))
    if len(bodies):
        colour = np.broadcast_to(_GREY, (len(bodies), 4, 3))
        raster.faces(camera.project(bodies.x), bodies.corners, colour, camera.turned(bodies.normals()), False)


def _veils(raster: Raster, scene: Scene, view: View, camera: Camera) -> None:
    if scene.walls is not None and view.walls == "transparent":
        walls = scene.walls.part_of(~bodies_among(scene.walls, scene.x))
        uvw = camera.project(walls.x)
        for patch in _patches(walls, camera) if len(walls) else ():
            raster.veil(uvw, walls.corners[patch], _GREY, 0.10)


def _outline(raster: Raster, scene: Scene, view: View, camera: Camera) -> list[tuple[np.ndarray, bool]]:
    """Edges of the walls in pieces, (2, 2) [L] each, and whether they are seen or lie behind something."""
    if scene.walls is None or view.walls == "none":
        return []
    walls, out = scene.walls, []
    uvw, size = camera.project(walls.x), float(np.ptp(walls.x, axis=0).max())
    for part in np.unique(walls.part):
        for a, b in outlines(walls.part_of(walls.part == part)):
            steps = max(2, int(np.hypot(*(uvw[b] - uvw[a])[:2]) * raster.scale / 4))
            points = uvw[a] + np.linspace(0, 1, steps + 1)[:, None] * (uvw[b] - uvw[a])
            seen = raster.seen(0.5 * (points[1:] + points[:-1]), 0.006 * size)
            cuts = np.flatnonzero(np.diff(seen)) + 1
            ends = [0, *cuts.tolist(), steps]
            out += [(points[[begin, end], :2], bool(seen[begin])) for begin, end in zip(ends[:-1], ends[1:], strict=True)]
    return out


def render(scene: Scene, view: View, camera: Camera, frame: tuple[float, ...], low: float, high: float, width: int) -> Picture:
    """The picture of one state."""
    left, right, bottom, top = frame
    scale = _FINER * width / (right - left)
    raster = Raster(left, top, _FINER * width, _FINER * max(1, round(width * (top - bottom) / (right - left))), scale)
    thick = 0.01 * (right - left)
    if scene.faces is not None and scene.colours is not None:
        faces = scene.faces
        normals = camera.turned(faces.normals())
        front = ~faces.solid | camera.sees(faces.normals(), faces.x[faces.corners].mean(axis=1))  # the backs of solids are behind their fronts
        colour = colours_of(scene.colours[front], low, high, view.colours)
        raster.faces(camera.project(faces.x), faces.corners[front], colour, normals[front], view.lines)
    if scene.values is not None and len(scene.x):
        size = np.sqrt(scene.V) if scene.flat else np.cbrt(scene.V)
        radius = 0.56 * size  # a little more than touching, so that no gaps show
        raster.spheres(camera.project(scene.x), radius * camera.enlarged(scene.x), colours_of(scene.values, low, high, view.colours))
        thick = 2.5 * float(np.median(size))
    _draw_bodies(raster, scene, view, camera)
    _draw_bars(raster, scene, view, camera, low, high)
    raster.shadows(thick)
    _veils(raster, scene, view, camera)
    return Picture(np.clip(raster.smaller(_FINER), 0, 1), _outline(raster, scene, view, camera))


def nice_length(most: float) -> float:
    """1, 2 or 5 times a power of ten, at most `most`."""
    power = 10.0 ** np.floor(np.log10(most))
    return float(next(n for n in (5, 2, 1) if n * power <= most * (1 + 1e-9)) * power)


def draw_axes(axes: Any, camera: Camera, frame: tuple[float, ...], unit: str) -> None:
    """The three axes as arrows in the lower left corner, and in parallel projection, which keeps lengths across the line of sight, a scale."""
    left, right, bottom, top = frame
    size = 0.045 * max(right - left, top - bottom)
    at = np.array([left + 1.6 * size, bottom + 1.1 * size])
    for k, name in enumerate("xyz"):
        way = camera.turned(np.eye(3)[k][None])[0, :2] * size
        if np.hypot(*way) < 0.3 * size:  # it points at the eye, or away
            continue
        axes.annotate("", at + way, at, arrowprops=_ARROW)
        label = at + way * (1 + 0.4 * size / np.hypot(*way))
        axes.text(*label, name, fontsize=8, color="0.2", ha="center", va="center")
    if camera.distance < np.inf:
        return
    length = nice_length(0.25 * (right - left))
    begin, y = right - 0.03 * (right - left) - length, bottom + 0.3 * size
    axes.plot([begin, begin + length], [y, y], color="0.2", linewidth=2, solid_capstyle="butt")
    axes.text(begin + length / 2, y + 0.2 * size, f"{length:g} {unit}", fontsize=8, color="0.2", ha="center", va="bottom")


def draw_panel(axes: Any, picture: Picture, frame: tuple[float, ...]) -> None:
    """A rendered picture in axes whose units are lengths."""
    for seen, look in ((True, {"alpha": 0.9}), (False, {"alpha": 0.25})):
        lines = [ends for ends, visible in picture.lines if visible == seen]
        axes.add_collection(module("matplotlib.collections").LineCollection(lines, colors="0.25", linewidths=0.9, **look))
    axes.imshow(picture.image, extent=frame, interpolation="nearest", aspect="equal")
    axes.set(xlim=frame[:2], ylim=frame[2:])
    axes.set_axis_off()
