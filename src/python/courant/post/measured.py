"""The parts of a recipe that are no analyses: the jump, depth probes and snapshots of the speed, and the files of them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import yaml

from ..diagnostics import Diagnostics, Location
from ..fields import ParticleFrame, StateFiles
from ..files import write_file
from ..optional import MissingModule
from .jump import JumpRecipe, JumpResult, froude
from .particles import ParticleSet, first_surface
from .recipe import Recipe


class Depths(NamedTuple):
    """What the jump and the probes need of one state; NaN where it is not asked for. `snapshot`: (particles, 5): x, y, speed, area, h."""

    jump: float
    toe: float
    front: float
    probes: list[float]
    snapshot: np.ndarray | None


@dataclass
class Measured:
    """Over all states."""

    t: list[float] = field(default_factory=list)
    depths: list[Depths] = field(default_factory=list)
    snapshots: list[tuple[float, np.ndarray]] = field(default_factory=list)  # the time that the picture shows, and its particles

    def series(self, jump: JumpRecipe) -> JumpResult:
        toe = np.array([one.toe for one in self.depths]) if jump.toe_range else None
        front = np.array([one.front for one in self.depths]) if jump.front_x is not None else None
        return JumpResult(np.array(self.t), np.array([one.jump for one in self.depths]), toe, front)


def measure_depths(frame: ParticleFrame, recipe: Recipe, with_speed: bool) -> Depths:
    everything = ParticleSet.of(frame, np.ones(len(frame), dtype=bool))
    jump, wanted = recipe.jump, [(one.x, one.z, one.bed) for one in recipe.probes]
    if jump is not None:
        wanted += [(jump.x, jump.z, jump.bed), (jump.x if jump.front_x is None else jump.front_x, jump.z, jump.bed)]
    depths = np.zeros(len(wanted))
    for bed in {one[2] for one in wanted}:
        rows = [k for k, one in enumerate(wanted) if one[2] == bed]
        depths[rows] = first_surface(everything, np.array([(x, 0, z) for x, z, _ in (wanted[k] for k in rows)]), bed)
    probes, snapshot = depths[: len(recipe.probes)].tolist(), None
    if with_speed and recipe.snapshots:
        v = frame.arrays["velocity"]
        inside = _within(frame.x[:, 0], recipe.snapshots.x) & _within(frame.x[:, 1], recipe.snapshots.y)
        area = frame.V if frame.dim == 2 else frame.V ** (2 / 3)
        snapshot = np.column_stack([frame.x[:, :2], np.sqrt((v**2).sum(axis=1)), area, frame.h])[inside]
    if jump is None:
        return Depths(math.nan, math.nan, math.nan, probes, snapshot)
    return Depths(float(depths[-2]), _toe(everything, jump), float(depths[-1]), probes, snapshot)


def _within(values: np.ndarray, bounds: tuple[float, float] | None) -> np.ndarray:
    return np.ones(len(values), dtype=bool) if bounds is None else (values >= bounds[0]) & (values <= bounds[1])


def _toe(particles: ParticleSet, jump: JumpRecipe, at_once: int = 8) -> float:
    """The first x, on steps of d1/4, where the depth is over the threshold; NaN: none. [L]"""
    if jump.toe_range is None:
        return math.nan
    start, end = jump.toe_range
    threshold = jump.toe_threshold * jump.d1
    step = 0.25 * jump.d1
    x = start + np.arange(math.floor((end - start) / step * (1 + 1e-12)) + 1) * step
    for low in range(0, len(x), at_once):
        part = x[low : low + at_once]
        places = np.column_stack([part, np.zeros_like(part), np.full_like(part, jump.z)])
        over = np.flatnonzero(first_surface(particles, places, jump.bed, threshold) > threshold)
        if len(over):
            return float(part[over[0]])
    return math.nan


def snapshot_states(recipe: Recipe, states: list[StateFiles], diagnostics: Diagnostics) -> dict[int, list[float]]:
    """Which states show which wanted times: the nearest one. Where that is off by more than a tenth of what lies between states, the
    picture has the state's own time."""
    out: dict[int, list[float]] = {}
    if recipe.snapshots is None or not states:
        return out
    t = np.array([state.t for state in states])
    spacing = (t[-1] - t[0]) / (len(t) - 1) if len(t) > 1 else 0.0
    for wanted in recipe.snapshots.times:
        nearest = int(np.argmin(np.abs(t - wanted)))
        off = abs(t[nearest] - wanted)
        if off <= 0.1 * spacing + 1e-12:
            out.setdefault(nearest, []).append(wanted)
        elif off <= spacing:
            out.setdefault(nearest, [float(t[nearest])])
        else:
            message = f"no picture of t = {wanted:g}: the results go from {t[0]:g} to {t[-1]:g}"
            diagnostics.warning(Location(recipe.file), message)
    return out


# ---- files in the run's folder


class _Plain(str):
    """A text that YAML shows as it is, without quotes: a number."""


class _Dumper(yaml.SafeDumper):
    pass


def _represent_plain(dumper: yaml.SafeDumper, text: _Plain) -> yaml.ScalarNode:
    return dumper.represent_scalar(dumper.resolve(yaml.ScalarNode, str(text), (True, False)), str(text))


_Dumper.add_representer(_Plain, _represent_plain)


def digits(value: float) -> str:
    """A number with the digits that mean something."""
    return _Plain(".nan" if math.isnan(value) else f"{value:.9g}")


def results_yaml(recipe: Recipe, title: str, measured: Measured, jump: JumpResult | None) -> str:
    """All single numbers of a call."""
    out: dict[str, Any] = {"recipe": recipe.file, "title": title}
    if jump is not None and recipe.jump is not None:
        out |= {"case": jump.case, "jump": _jump_node(recipe.jump, jump)}
    probes = [
        {"name": probe.name, "x": digits(probe.x), "last_depth": digits(measured.depths[-1].probes[k])} for k, probe in enumerate(recipe.probes)
    ]
    if probes:
        out["probes"] = probes
    analyses = {
        one.name: one.result.words | {scalar.name: {"value": digits(scalar.value), "unit": scalar.unit} for scalar in one.result.scalars}
        for one in recipe.analyses
        if one.result.scalars
    }
    if analyses:
        out["analyses"] = analyses
    return yaml.dump(out, Dumper=_Dumper, sort_keys=False, allow_unicode=True, default_flow_style=False, width=10**6)


def _jump_node(recipe: JumpRecipe, jump: JumpResult) -> dict[str, Any]:
    out: dict[str, Any] = {"x": digits(recipe.x), "Fr1": digits(froude(recipe.v1, recipe.d1, recipe.g)), "d2_theory": digits(recipe.theory)}
    for one in jump.intervals:
        row: dict[str, Any] = {"from": digits(one.interval[0]), "to": digits(one.interval[1]), "states": one.states, "complete": one.complete}
        if one.states:
            row |= {"A": digits(one.A), "P": digits(one.P), "mean_depth": digits(one.mean_depth)}
        published = [{"case": other.case, "A": digits(other.A), "P": digits(other.P)} for other in one.published]
        out.setdefault("intervals", []).append(row | ({"published": published} if published else {}))
    front = {} if recipe.front_x is None else {"x": digits(recipe.front_x)}
    if jump.front_time is not None:
        front["time"] = digits(jump.front_time)
    if front:
        out["front"] = front
    if jump.turn is not None:
        out["turn"] = {"time": digits(jump.turn[0]), "x": digits(jump.turn[1])}
    if jump.toe is not None and len(jump.toe) and not math.isnan(jump.toe[-1]):
        out["toe_at_end"] = digits(jump.toe[-1])
    return out


def depth_csv(recipe: Recipe, measured: Measured, jump: JumpResult | None) -> str:
    """Jump and probes over time."""
    columns: dict[str, Any] = {}
    if jump is not None and recipe.jump is not None:
        columns = {"depth": jump.depth, "depth_over_theory": jump.depth / recipe.jump.theory}
        columns |= {name: values for name, values in (("toe", jump.toe), ("front_depth", jump.front)) if values is not None}
    names = [*columns, *(probe.name for probe in recipe.probes)]
    rows = zip(measured.t, *columns.values(), *zip(*(one.probes for one in measured.depths), strict=True), strict=True)
    line = "%.9g" + ",%.6g" * len(names) + "\n"
    return ",".join(["t", *names]) + "\n" + "".join([line % row for row in rows])


def _snapshots_csv(measured: Measured) -> str:
    lines = [f"{t:g},%.6g,%.6g,%.5g,%.5g,%.5g\n" % row for t, particles in measured.snapshots for row in map(tuple, particles.tolist())]
    return "t,x,y,speed,area,h\n" + "".join(lines)


def _walls_csv(walls: np.ndarray) -> str:
    lines = ["%.6g,%.6g,%.6g,%.6g\n" % tuple(wall) for wall in walls.tolist()]
    return "x0,y0,x1,y1\n" + "".join(dict.fromkeys(lines))  # shells side by side in z have the same trace


def write_measured(
    recipe: Recipe, folder: Path, measured: Measured, jump: JumpResult | None, title: str, walls: np.ndarray, diagnostics: Diagnostics
) -> str:
    """Files of the jump, the probes and the snapshots in the run's folder; gives what is to be said of them. Raises OutputError."""
    said = "".join(
        f"Depth at {probe.name} (x = {probe.x:g} m): {measured.depths[-1].probes[k]:.4f} m at t = {measured.t[-1]:.3g} s, see depth.csv\n"
        for k, probe in enumerate(recipe.probes)
    )
    if jump is not None or recipe.probes:
        write_file(folder / "depth.csv", depth_csv(recipe, measured, jump))
    if recipe.snapshots:
        write_file(folder / "snapshots.csv", _snapshots_csv(measured))
        write_file(folder / "walls.csv", _walls_csv(walls))
    if jump is not None or recipe.snapshots:
        try:
            from .draw import draw_depth, draw_velocity

            if jump is not None and recipe.jump is not None:
                draw_depth(folder, title, recipe.jump, jump)
            if recipe.snapshots:
                draw_velocity(folder, title, recipe.snapshots, dict(measured.snapshots), walls)
            said += f"Pictures: {folder}/*.png\n"
        except MissingModule as fault:
            no_pictures(fault, diagnostics)
    return said


def no_pictures(fault: MissingModule, diagnostics: Diagnostics) -> None:
    """Numbers and tables do not depend on pictures: a warning."""
    diagnostics.warning("", "no pictures were drawn: python3 with matplotlib was not found", str(fault).rpartition(": ")[2])
