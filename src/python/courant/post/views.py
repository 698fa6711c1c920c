"""Pictures of whole states: `views` of a recipe, and `courant.open(DIR).plot(field=...)`."""

from __future__ import annotations

import math
import textwrap
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..diagnostics import CourantError, Diagnostics, Location
from ..files import write_figure
from ..key_tables import keys as keys_of_map
from ..optional import module
from ..style import pyplot
from ..units import Dimension
from ..yaml_map import YamlMap, is_list
from .camera import up_of
from .state import read_expression
from .view_plane import draw_plane, plane_window
from .view_scene import Scene, UnknownField, View, colour_range, scenes_of
from .view_space import camera_of, draw_axes, draw_panel, frame_of, render

# keys that are more than one field, or none as it is
_PARTS = keys_of_map("more of a view", "times list, camera @camera, x list, y list, z list, mirror text|list, columns number, gauges positions, theory @theory")
_CAMERA = keys_of_map("camera", "azimuth number, elevation number")
_THEORY = keys_of_map("theory", "of any!, x list, label text")
_DPI = 120


def read_view(keys: YamlMap) -> View:
    """One entry of `views`. Faults are reported at their location."""
    name, factor = keys.text("name"), keys.number("factor", 1.0)
    if not all(c.isalnum() or c in "-_" for c in name):
        keys.error(keys.get("name") or keys.node, f"'{keys.name}.name': '{name}' is no name of a file", "letters, digits, - and _")
    out: dict[str, Any] = {"times": keys.numbers("times") if keys.has("times") else None, "columns": int(keys.number("columns"))}
    if out["times"] == []:
        keys.error(keys.get("times") or keys.node, f"'{keys.name}.times' is empty", "leave it out for the last state")
    out |= {"window": tuple(keys.range(axis) for axis in "xyz"), "gauges": keys.places("gauges"), "mirror": _read_mirror(keys)}
    if factor != 1 and not keys.has("unit"):
        keys.error(keys.get("factor") or keys.node, f"'{keys.name}.factor' needs the unit that comes of it", "for example {unit: MPa, factor: 1e-6}")
    if camera := keys.map("camera"):
        camera.allow(*_CAMERA)
        out |= {"azimuth": camera.number("azimuth") if camera.has("azimuth") else None, "elevation": camera.number("elevation", 20.0)}
        if not -90 <= out["elevation"] <= 90:
            camera.error(camera.get("elevation") or camera.node, f"'{camera.name}.elevation' must be -90 to 90 degrees")
    if theory := keys.map("theory"):
        theory.allow(*_THEORY)
        node = theory.get("of", required=True)
        out |= {"theory": None if node is None else read_expression(theory, node, "of", ("x",)), "theory_range": theory.range("x")}
        out["theory_label"] = theory.text("label", "theory")
    return keys.read(View, *_PARTS, factor=factor, **out)


def _read_mirror(keys: YamlMap) -> str:
    node = keys.get("mirror")
    if node is None:
        return ""
    words = [one.value for one in node.value] if is_list(node) else [keys.text("mirror")]
    if any(word not in ("x", "y", "z") for word in words) or len(set(words)) != len(words):
        keys.error(node, f"'{keys.name}.mirror' is a list of x, y and z", "for example [x, z]: the planes x = 0 and z = 0")
        return ""
    return "".join(words)


def read_views(keys: YamlMap, up: str) -> list[tuple[View, Location]]:
    """`views` of a recipe, with their locations. `up`: of the recipe, for views that do not tell; "" for that of gravity."""
    out: list[tuple[View, Location]] = []
    for number, node in enumerate(keys.list("views"), 1):
        entry = keys.element(node, f"view {number}")
        view = read_view(entry)
        if any(view.name == other.name for other, _ in out):
            entry.error(entry.get("name") or node, f"two views are named '{view.name}'")
        out.append((view if view.up else replace(view, up=up), entry.where()))
    return out


def _time(scene: Scene, run: Any) -> str:
    """ "t = 0.6 s": states are written up to a step early, so that digits past a hundredth of the run mean little."""
    end = float(run.states.times[-1])
    step = 10.0 ** (math.floor(math.log10(end)) - 2) if end > 0 else 1.0
    return f"t = {round(scene.t / step) * step:.6g} {run.units.time}"


def _spread(count: int, view: View, wide: float) -> tuple[int, int]:
    """Rows and columns of panels; wide pictures (width over height) are below each other."""
    columns = view.columns or (1 if wide > 2.2 else 2 + (count == 3) if wide > 0.8 else 5)
    columns = min(columns, count)
    return math.ceil(count / columns), columns


def _in_plane(run: Any, view: View, scene: Scene) -> bool:
    """Whether the picture is a filled plane: of a plane flow whose y is up, unless there is a camera. Raises UnknownField."""
    up = (view.up or up_of(run, True)) if scene.flat else ""
    if up in ("z", "-z") and view.azimuth is None and view.elevation is None:
        raise UnknownField(f"a plane flow lies in x and y: up cannot be {up}")
    plane = up == "y" and view.azimuth is None and view.elevation is None
    if not plane and (view.depth or view.gauges or view.theory is not None):
        raise UnknownField("depth, gauges and theory need a plane flow whose y is up, and no camera")
    if plane and view.projection == "perspective":
        raise UnknownField("perspective needs a scene in space, or a camera")
    return plane


def draw_view(
    run: Any, view: View, scenes: list[Scene] | None = None, limits: tuple[float, float, str] | None = None, others: list[Scene] | None = None,
    dpi: int = _DPI,
) -> Any:
    """Draws a view of a run that `courant.open` gave. Gives matplotlib's figure. Raises UnknownField, CourantError, MissingModule.

    `scenes`, `limits`: the states and the range of the colours, where they are known; `others`: scenes that must fit into the window, too; `dpi`:
    pixels per inch of what is rendered.
    """
    plt = pyplot()
    scenes = scenes_of(run, view) if scenes is None else scenes
    low, high, beyond = limits or colour_range(scenes, view)
    flat, length = _in_plane(run, view, scenes[0]), run.units.of(Dimension(L=1))
    camera = None if flat else camera_of(run, view, scenes + (others or []))
    frame = plane_window(scenes + (others or []), view) if camera is None else frame_of(camera, scenes + (others or []))
    wide = (frame[1] - frame[0]) / (frame[3] - frame[2])
    rows, columns = _spread(len(scenes), view, wide)
    panel = 9.0 / columns if wide >= 1 else min(9.0 / columns, 4.5 * wide)
    height = min(panel / wide, 8.0)
    size = (panel * columns + 1.3, (height + 0.25) * rows + 0.7)
    figure, grid = plt.subplots(rows, columns, figsize=size, squeeze=False, sharex=flat, sharey=flat, constrained_layout=True)
    panels = list(grid.ravel())
    width = max(200, round(panel * dpi))
    for axes, scene in zip(panels, scenes, strict=False):
        if camera is None:
            draw_plane(axes, scene, view, frame, (low, high), width, length)
        else:
            draw_panel(axes, render(scene, view, camera, frame, low, high, width), frame)
        axes.set_title(_time(scene, run), loc="right", fontsize=9, fontweight="bold", pad=2)
    for axes in panels[len(scenes) :]:
        axes.set_visible(False)
    _finish(figure, grid, panels, view, scenes, run, flat, length)
    if camera is not None:
        draw_axes(panels[0], camera, frame, length)
    _colour_bar(figure, panels, view, scenes[0].label, (low, high, beyond))
    return figure


def _finish(figure: Any, grid: Any, panels: list[Any], view: View, scenes: list[Scene], run: Any, flat: bool, length: str) -> None:
    """Labels of plane pictures, the legend and the title."""
    if flat:
        for axes in grid[:, 0]:
            axes.set_ylabel(f"y [{length}]")
        for axes in grid[-1]:
            axes.set_xlabel(f"x [{length}]")
        if panels[0].get_legend_handles_labels()[1]:
            panels[0].legend(loc="upper left", fontsize=8, ncol=3, framealpha=0.75)
    title = view.title or str(run.summary.get("title", ""))
    if title.strip():
        figure.suptitle(textwrap.fill(title.replace("$", "\\$"), max(20, int(12 * figure.get_figwidth()))), fontsize=10)


def _colour_bar(figure: Any, panels: list[Any], view: View, label: str, limits: tuple[float, float, str]) -> None:
    matplotlib = module("matplotlib")
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(limits[0], limits[1]), view.colours)
    figure.colorbar(scale, ax=panels, label=label, extend=limits[2], shrink=0.8, aspect=25, pad=0.01)


def save_view(figure: Any, path: Path) -> None:
    write_figure(figure, path, dpi=_DPI, pil_kwargs={"optimize": True})
    module("matplotlib.pyplot").close(figure)


def _of_times_that_are_there(view: View, where: Location, states: np.ndarray, diagnostics: Diagnostics) -> View:
    """Without the times that no state is near to, which are reported: a run that goes on has none yet."""
    if view.times is None:
        return view
    spacing = (states[-1] - states[0]) / max(1, len(states) - 1)
    late = [t for t in view.times if np.abs(states - t).min() > spacing + 1e-12]
    for t in late:
        diagnostics.warning(where, f"view '{view.name}': no state near t = {t:g}: the results go from {states[0]:g} to {states[-1]:g}")
    return replace(view, times=[t for t in view.times if t not in late])


def draw_views(run: Any, views: list[tuple[View, Location]], out: Path, diagnostics: Diagnostics) -> list[Path]:
    """NAME.png of each view, and NAME.gif or NAME.mp4 where it is asked for. Faults of fields and files are reported; raises MissingModule."""
    from .animation import MissingProgram, animate

    made: list[Path] = []
    for view, where in views:
        try:
            view = _of_times_that_are_there(view, where, run.states.times, diagnostics)
            if view.times == []:
                continue
            save_view(draw_view(run, view), out / f"{view.name}.png")
            made.append(out / f"{view.name}.png")
            if view.animate:
                made.append(animate(run, view, out / f"{view.name}.{view.animate}"))
        except MissingProgram as fault:
            what, _, how = str(fault).partition(": ")
            diagnostics.warning(where, f"view '{view.name}': {what}", how)
        except UnknownField as fault:
            diagnostics.error(where, f"view '{view.name}': {fault}")
        except CourantError as fault:
            for message in fault.diagnostics.all:
                diagnostics.add(message)
    return made


__all__ = ["View", "draw_view", "draw_views", "read_view", "read_views", "save_view"]
