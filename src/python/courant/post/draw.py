"""Draws the figures of a recipe in a folder that `courant post` wrote, and the pictures of a jump.

usage: python3 -m courant.post.draw FOLDER      (needs FOLDER/figures.json, which has all numbers)
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..files import write_figure
from ..optional import module
from ..style import FIELD_COLOURS, LOOKS, MARKERS, SPEED_COLOURS, WALLS, pyplot
from .figures import CHARTS, Figure
from .jump import JumpRecipe, JumpResult
from .parallel import in_order
from .recipe import SnapshotRecipe
from .tables import Table
from .view_plane import fill


def plain(title: str) -> str:
    """No formula in a deck's title."""
    return title.replace("$", "\\$")


def _numbers(values: Sequence[float | None]) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def _segments(axes: Any, walls: Any) -> None:
    """Traces of the shells: x0, y0, x1, y1 each."""
    lines = module("matplotlib.collections").LineCollection(np.reshape(np.asarray(walls, dtype=float), (-1, 2, 2)), **WALLS)
    axes.add_collection(lines)


# ---- figures of a recipe


def _draw_map(figure: Any, axes: Any, one: dict[str, Any]) -> None:
    """Colours of a field, and its streamlines."""
    nx, ny = one["nx"], one["ny"]
    x, y = one["x0"] + one["dx"] * np.arange(nx), one["y0"] + one["dy"] * np.arange(ny)
    field, *along = (np.ma.masked_invalid(_numbers(one[key]).reshape(ny, nx)) for key in ("field", "u", "v") if key in one)
    low, high = one["range"] or (None, None)
    colours = axes.pcolormesh(x, y, field, cmap=one.get("colours") or FIELD_COLOURS, vmin=low, vmax=high, shading="nearest", rasterized=True)
    figure.colorbar(colours, ax=axes, label=one["label"], pad=0.01, aspect=20, shrink=0.8)
    if along:
        axes.streamplot(x, y, *along, density=(3.0, 1.2), color="white", linewidth=0.6, arrowsize=0.6)


def _draw_curves(axes: Any, curves: Sequence[dict[str, Any]]) -> None:
    families = sum("each" in curve for curve in curves)
    shades = iter(module("matplotlib.pyplot").get_cmap("viridis")(np.linspace(0, 0.92, max(1, families))))
    for curve in curves:
        look = dict(LOOKS[curve["style"]])
        if "each" in curve:
            look.update(color=next(shades), linewidth=0.9)
        named = curve["style"] == "named"
        x, y = _numbers(curve["x"]), _numbers(curve["y"])
        axes.plot(x, y, label=None if named else curve["label"] or None, **look)
        if named:
            axes.annotate(curve["label"], (x[0], y[0]), xytext=(4, 2), textcoords="offset points", fontsize=7)


def _draw_references(axes: Any, references: Sequence[dict[str, Any]]) -> None:
    for k, one in enumerate(references):
        look = LOOKS[one["style"]] | {"color": ("black", "tab:red", "tab:green", "tab:purple")[k % 4]}
        if "marker" in look:
            look.update(marker=MARKERS[k % len(MARKERS)], markersize=6, markerfacecolor="none")
        label = one["label"] or None
        if one["across"] == "x":
            axes.axvline(one["x"][0], label=label, **look)
        elif one["across"] == "y":
            axes.axhline(one["y"][0], label=label, **look)
        else:
            axes.plot(_numbers(one["x"]), _numbers(one["y"]), label=label, **look)


def _finish_axes(axes: Any, one: dict[str, Any], title: str) -> None:
    axes.set_xlabel(one["x_label"])
    axes.set_ylabel(one["y_label"])
    axes.set_title(one["title"] or plain(title))
    for axis in "xy":
        if one["scale"] in (f"log_{axis}", "log"):
            axes.set(**{f"{axis}scale": "log"})
        if one[f"{axis}_range"]:
            axes.set(**{f"{axis}lim": one[f"{axis}_range"]})
    if one["equal"]:
        axes.set_aspect("equal")
    if not one["map"]:
        axes.grid(True)
    if axes.get_legend_handles_labels()[1]:
        axes.legend()


def draw_figure(data: dict[str, Any], one: dict[str, Any], folder: Path, fill: Callable[[Any], None] | None = None) -> None:
    """One figure of figures.json in all its formats. `fill`: draws what is not in the numbers."""
    plt = pyplot()
    figure, axes = plt.subplots(figsize=(10, 3.2) if one["equal"] else (7.2, 4.4), constrained_layout=True)
    if one["map"]:
        _draw_map(figure, axes, one["map"])
    if one["walls"]:
        _segments(axes, data["walls"])
    _draw_curves(axes, one["curves"])
    _draw_references(axes, one["references"])
    if fill:
        fill(axes)
    _finish_axes(axes, one, data["title"])
    for ending in data["formats"]:
        write_figure(figure, folder / f"{one['name']}.{ending}")
    plt.close(figure)


def draw_figures(folder: Path, threads: int = 1) -> None:
    """All figures of FOLDER/figures.json, on several processes at once."""
    data = json.loads((folder / "figures.json").read_text(encoding="utf-8"))
    pyplot()  # imported once, for all
    for _ in in_order(lambda one: draw_figure(data, one, folder), data["figures"], threads):
        pass


def draw_chart(figure: Figure, tables: dict[str, Table], formats: Sequence[str], title: str, folder: Path) -> None:
    """A figure of a chart of one's own."""
    one = vars(figure) | {"curves": [], "references": [], "map": None, "walls": False}
    data = {"title": title, "formats": formats, "walls": []}
    draw_figure(data, one, folder, lambda axes: CHARTS[figure.chart](axes, tables, **figure.keys))


# ---- the depth behind a jump, and pictures of the speed


def draw_depth(folder: Path, title: str, recipe: JumpRecipe, jump: JumpResult) -> None:
    """depth.png: the depth behind a jump over time, and over which intervals it was compared."""
    plt, t, ratio = pyplot(), jump.t, jump.depth / recipe.theory
    figure, axes = plt.subplots(figsize=(8, 4.2), constrained_layout=True)
    axes.axhline(1, color="0.3", linestyle="--", linewidth=1, label=f"Bélanger, $d_2$ = {1000 * recipe.theory:.1f} mm")
    axes.plot(t, ratio, linewidth=1.2, label="SPH " + jump.case.replace("d1", "$d_1$") if jump.case else "SPH")
    for k, part in enumerate(one for one in jump.intervals if one.states):
        label = f"{part.interval[0]:g}–{part.interval[1]:g} s: $A$ = {part.A:.3f}, $P$ = {part.P:.3f}"
        axes.axvspan(*part.interval, color=f"C{k + 1}", alpha=0.15, linewidth=0, label=label)
    axes.set(xlabel="time $t$ [s]", ylabel="$d_{2,SPH}\\,/\\,d_{2,THEORY}$ [-]", title=f"Depth at x = {recipe.x:g} m. {plain(title)}")
    axes.set(xlim=(t.min(), max(t.max(), t.min() + 1e-9)), ylim=(0, max(1.3, 1.05 * ratio.max())))
    axes.grid(True)
    axes.legend(loc="lower right")
    write_figure(figure, folder / "depth.png")
    plt.close(figure)


def _window(limits: tuple[float, float] | None, values: np.ndarray) -> tuple[float, float]:
    margin = 0.03 * float(np.ptp(values)) or 1.0
    return limits or (float(values.min()) - margin, float(values.max()) + margin)


def draw_velocity(folder: Path, title: str, recipe: SnapshotRecipe, snapshots: dict[float, np.ndarray], walls: np.ndarray) -> None:
    """velocity.png: filled by the speed, one panel for each time. snapshots: (particles, 5) each, x, y, speed, area and h."""
    snapshots = {t: snapshots[t] for t in sorted(snapshots) if len(snapshots[t])}
    if not snapshots:
        return
    plt, everything, width = pyplot(), np.concatenate(list(snapshots.values())), 9.0
    x_range, y_range = _window(recipe.x, everything[:, 0]), _window(recipe.y, everything[:, 1])
    low, high = recipe.speed or (0, everything[:, 2].max())
    height = min(max(width * (y_range[1] - y_range[0]) / (x_range[1] - x_range[0]), 0.6), 8) + 0.12
    rows, size = len(snapshots), (width + 1.2, len(snapshots) * height + 1.0)
    figure, panels = plt.subplots(rows, 1, figsize=size, sharex=True, squeeze=False, constrained_layout=True)
    for axes, (t, particles) in zip(panels[:, 0], snapshots.items(), strict=True):
        x, y, speed, area, h = particles.T
        field = fill(np.column_stack((x, y)), area, h, speed, (*x_range, *y_range), round(160 * width))
        look = {"cmap": SPEED_COLOURS, "vmin": low, "vmax": high, "interpolation": "nearest"}
        dots = axes.imshow(np.ma.masked_invalid(field), origin="lower", extent=(*x_range, *y_range), **look)
        _segments(axes, walls)
        axes.set(xlim=x_range, ylim=y_range, ylabel="y [m]")
        axes.set_aspect("equal")
        axes.text(0.99, 0.9, f"t = {t:g} s", transform=axes.transAxes, ha="right", va="top", fontsize=10, fontweight="bold")
    panels[-1, 0].set_xlabel("x [m]")
    figure.suptitle(plain(title), fontsize=10)
    figure.colorbar(dots, ax=panels[:, 0].tolist(), label="velocity |v| [m/s]", shrink=0.6, aspect=30, pad=0.01)
    write_figure(figure, folder / "velocity.png")
    plt.close(figure)


if __name__ == "__main__":
    if len(sys.argv) != 2 or not (Path(sys.argv[1]) / "figures.json").is_file():
        sys.exit(__doc__)
    draw_figures(Path(sys.argv[1]))
