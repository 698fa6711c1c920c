#!/usr/bin/env python3
"""Draws depth.png and velocity.png in a run's folder from the files that `courant post` wrote there.

usage: plot.py DIR      (needs plot.json; depth.csv, snapshots.csv and walls.csv as far as plot.json asks for them)
"""
import csv
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection


def read_columns(path):
    """Columns of a CSV file with a head line, as lists of numbers by name."""
    with open(path, newline="") as file:
        rows = csv.reader(file)
        names = next(rows)
        values = [[float(cell) for cell in row] for row in rows]
    return {name: [row[k] for row in values] for k, name in enumerate(names)}


def plot_depth(folder, settings):
    jump = settings["jump"]
    data = read_columns(folder / "depth.csv")
    figure, axes = plt.subplots(figsize=(8, 4.2), constrained_layout=True)
    axes.axhline(1, color="0.3", linestyle="--", linewidth=1, label=f"Bélanger, $d_2$ = {1000 * jump['d2_theory']:.1f} mm")
    name = "SPH " + jump["case"].replace("d1", "$d_1$") if jump["case"] else "SPH"
    axes.plot(data["t"], data["depth_over_theory"], color="tab:blue", linewidth=1.2, label=name)
    for k, part in enumerate(jump["intervals"]):
        label = f"{part['from']:g}–{part['to']:g} s: $A$ = {part['A']:.3f}, $P$ = {part['P']:.3f}"
        axes.axvspan(part["from"], part["to"], color=f"C{k + 1}", alpha=0.15, linewidth=0, label=label)
    axes.set_xlabel("time $t$ [s]")
    axes.set_ylabel("$d_{2,SPH}\\,/\\,d_{2,THEORY}$ [-]")
    axes.set_title(f"Depth at x = {jump['x']:g} m. {settings['title']}", fontsize=10)
    axes.set_xlim(min(data["t"]), max(max(data["t"]), min(data["t"]) + 1e-9))
    axes.set_ylim(0, max(1.3, 1.05 * max(data["depth_over_theory"])))
    axes.grid(alpha=0.3)
    axes.legend(loc="lower right", fontsize=9)
    figure.savefig(folder / "depth.png", dpi=160)
    plt.close(figure)


def window(limits, values):
    if limits:
        return limits
    low, high = min(values), max(values)
    margin = 0.03 * (high - low) or 1
    return low - margin, high + margin


def point_area(xs, ys, width_in_points, x_range):
    """Area of a marker [pt2] that just covers a particle's share of the plane."""
    x_sorted = sorted(zip(xs, ys))
    nearest = []
    for i in range(0, len(x_sorted), max(1, len(x_sorted) // 200)):
        x, y = x_sorted[i]
        distances = [math.hypot(x - a, y - b) for a, b in x_sorted[max(0, i - 200) : i + 200]]
        distances = [d for d in distances if d > 0]
        if distances:
            nearest.append(min(distances))
    if not nearest:
        return 4.0
    spacing = sorted(nearest)[len(nearest) // 2]
    return max(0.3, (1.35 * spacing * width_in_points / (x_range[1] - x_range[0])) ** 2)


def plot_velocity(folder, settings):
    data = read_columns(folder / "snapshots.csv")
    if not data["t"]:
        return
    wall = read_columns(folder / "walls.csv")
    segments = [[(a, b), (c, d)] for a, b, c, d in zip(wall["x0"], wall["y0"], wall["x1"], wall["y1"])]
    view = settings["snapshots"]
    x_range, y_range = window(view["x"], data["x"]), window(view["y"], data["y"])
    v_range = view["speed"] or (0, max(data["speed"]))
    times = sorted(set(data["t"]))

    width = 9.0
    height = width * (y_range[1] - y_range[0]) / (x_range[1] - x_range[0])
    figure, panels = plt.subplots(
        len(times), 1, figsize=(width + 1.2, len(times) * (min(max(height, 0.6), 8) + 0.12) + 1.0), sharex=True, squeeze=False,
        constrained_layout=True,
    )
    rows = {t: [i for i, u in enumerate(data["t"]) if u == t] for t in times}
    last = rows[times[-1]]
    area = point_area([data["x"][i] for i in last], [data["y"][i] for i in last], 72 * 0.9 * width, x_range)
    for axes, t in zip(panels[:, 0], times):
        x, y, speed = ([data[k][i] for i in rows[t]] for k in ("x", "y", "speed"))
        dots = axes.scatter(x, y, c=speed, s=area, cmap="jet", vmin=v_range[0], vmax=v_range[1], linewidths=0, rasterized=True)
        axes.add_collection(LineCollection(segments, colors="black", linewidths=1.6, capstyle="projecting"))
        axes.set_xlim(x_range)
        axes.set_ylim(y_range)
        axes.set_aspect("equal")
        axes.set_ylabel("y [m]")
        axes.text(0.99, 0.9, f"t = {t:g} s", transform=axes.transAxes, ha="right", va="top", fontsize=10, fontweight="bold")
    panels[-1, 0].set_xlabel("x [m]")
    figure.suptitle(settings["title"], fontsize=10)
    figure.colorbar(dots, ax=panels[:, 0].tolist(), label="velocity |v| [m/s]", shrink=0.6, aspect=30, pad=0.01)
    figure.savefig(folder / "velocity.png", dpi=160)
    plt.close(figure)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    settings = json.loads((folder / "plot.json").read_text())
    settings["title"] = settings["title"].replace("$", "\\$")  # no formula in a deck's title
    if "jump" in settings:
        plot_depth(folder, settings)
    if "snapshots" in settings:
        plot_velocity(folder, settings)


if __name__ == "__main__":
    main()
