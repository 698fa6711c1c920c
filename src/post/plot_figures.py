#!/usr/bin/env python3
"""Draws the figures of a recipe in a folder that `courant post` wrote.

usage: plot_figures.py FOLDER      (needs FOLDER/figures.json, which has all numbers)
"""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy
from matplotlib.collections import LineCollection

LOOKS = {
    "line": {"linestyle": "-", "linewidth": 1.3},
    "dashed": {"linestyle": "--", "linewidth": 1.3},
    "points": {"linestyle": "none", "marker": "o", "markersize": 4},
    "line+points": {"linestyle": "-", "linewidth": 1.1, "marker": "o", "markersize": 3.5},
}
LOOKS["named"] = LOOKS["points"]  # the name stands beside the point
MARKERS = "s^Dv*P"


def numbers(values):
    return numpy.array([numpy.nan if value is None else value for value in values], dtype=float)


def draw_map(figure, axes, field):
    """Colours of a field, and its streamlines."""
    nx, ny = field["nx"], field["ny"]
    x, y = field["x0"] + field["dx"] * numpy.arange(nx), field["y0"] + field["dy"] * numpy.arange(ny)
    values = numpy.ma.masked_invalid(numbers(field["field"]).reshape(ny, nx))
    low, high = field["range"] or (None, None)
    colours = axes.pcolormesh(x, y, values, cmap="turbo", vmin=low, vmax=high, shading="nearest", rasterized=True)
    figure.colorbar(colours, ax=axes, label=field["label"], pad=0.01, aspect=20, shrink=0.8)
    if "u" in field:
        u, v = (numpy.ma.masked_invalid(numbers(field[key]).reshape(ny, nx)) for key in "uv")
        axes.streamplot(x, y, u, v, density=(3.0, 1.2), color="white", linewidth=0.6, arrowsize=0.6)


def draw(data, one, folder):
    wide = one["equal"]
    figure, axes = plt.subplots(figsize=(10, 3.2) if wide else (7.2, 4.4), constrained_layout=True)
    if one["map"]:
        draw_map(figure, axes, one["map"])
    if one["walls"]:
        segments = [[(a, b), (c, d)] for a, b, c, d in data["walls"]]
        axes.add_collection(LineCollection(segments, colors="black", linewidths=1.6, capstyle="projecting"))
    families = [curve for curve in one["curves"] if "each" in curve]
    shades = iter(plt.get_cmap("viridis")(numpy.linspace(0, 0.92, max(1, len(families)))))
    for curve in one["curves"]:
        look = dict(LOOKS[curve["style"]])
        if "each" in curve:
            look.update(color=next(shades), linewidth=0.9)
        named = curve["style"] == "named"
        x, y = numbers(curve["x"]), numbers(curve["y"])
        axes.plot(x, y, label=None if named else curve["label"] or None, **look)
        if named:
            axes.annotate(curve["label"], (x[0], y[0]), xytext=(4, 2), textcoords="offset points", fontsize=7)
    for k, reference in enumerate(one["references"]):
        look = dict(LOOKS[reference["style"]])
        look["color"] = ("black", "tab:red", "tab:green", "tab:purple")[k % 4]
        if "marker" in look:
            look.update(marker=MARKERS[k % len(MARKERS)], markersize=6, markerfacecolor="none")
        label = reference["label"] or None
        if reference["across"] == "x":
            axes.axvline(reference["x"][0], label=label, **look)
        elif reference["across"] == "y":
            axes.axhline(reference["y"][0], label=label, **look)
        else:
            axes.plot(numbers(reference["x"]), numbers(reference["y"]), label=label, **look)
    axes.set_xlabel(one["x_label"])
    axes.set_ylabel(one["y_label"])
    axes.set_title(one["title"] or data["title"], fontsize=10)
    if one["scale"] in ("log_x", "log"):
        axes.set_xscale("log")
    if one["scale"] in ("log_y", "log"):
        axes.set_yscale("log")
    if one["x_range"]:
        axes.set_xlim(one["x_range"])
    if one["y_range"]:
        axes.set_ylim(one["y_range"])
    if wide:
        axes.set_aspect("equal")
    if not one["map"]:
        axes.grid(alpha=0.3)
    if axes.get_legend_handles_labels()[1]:
        axes.legend(fontsize=9)
    for ending in data["formats"]:
        figure.savefig(folder / f"{one['name']}.{ending}", dpi=160)
    plt.close(figure)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    data = json.loads((folder / "figures.json").read_text())
    data["title"] = data["title"].replace("$", "\\$")  # no formula in a deck's title
    for one in data["figures"]:
        draw(data, one, folder)


if __name__ == "__main__":
    main()
