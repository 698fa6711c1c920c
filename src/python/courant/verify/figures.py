"""What of a case is drawn, for the HTML report and the Markdown page alike."""
from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from .charts import Chart, Line, Point, stability_map, svg_chart, svg_map, verdict_counts
from .model import CaseResult, Curve, Observation, RunResult
from .pareto import cost_points, pareto_front, recommendation
from .registry import CHARTS, chart
from .text import integer, number, percent, seconds

_MOST_SINGLE_POINTS = 40  # of a reference that is drawn as points


@dataclass
class Figure:
    stem: str  # part of a file's name, unique within the case
    title: str  # above the figure
    svg: str = ""  # empty: there is nothing to draw, the notes say why
    notes: list[str] = field(default_factory=list)  # below it: what could not be drawn and why
    advice: list[str] = field(default_factory=list)  # which run to choose, in sentences


def _hover(run: RunResult, error: float) -> str:
    text = f"{run.name}: error {percent(error)}, {seconds(run.cpu_seconds)} of CPU time"
    return text + (f", {integer(run.particles)} particles" if run.particles > 0 else "")


def _why_no_error(run: RunResult, k: int) -> str:
    if run.exit_code != 0:
        return run.reason or "stopped"
    return (run.observed[k].why or "no reference") if k < len(run.observed) else "not observed"


def _error_chart(case: CaseResult, k: int, o: Observation) -> Chart:
    norm = f" ({o.norm})" if o.take == "curve" or o.is_profile else ""
    out = Chart(f"{case.definition.title}: error of {o.label} against CPU time", "CPU time [s]", f"relative error{norm}",
                logarithmic=True, percent=True)
    for setting in dict.fromkeys(run.setting for run in case.runs):
        order = case.order_of(setting, o.name)
        name = (setting or "measured") + (f" (order {order:.2f})" if order is not None else "")
        points = [Point(run.cpu_seconds, error, _hover(run, error)) for run in case.runs
                  if run.setting == setting and (error := run.error_of(k)) is not None]
        if points:
            out.lines.append(Line(name, points))
    out.front = [Point(p.cost, p.error) for p in pareto_front(cost_points(case, k))]
    out.levels = [(f"bound {percent(o.bound)}", o.bound)] if o.bound is not None else []
    return out


@chart("error")
def error_figure(case: CaseResult, k: int) -> Figure | None:
    """Error against CPU time; None for an observation without reference."""
    o = case.definition.observations[k]
    drawn = _error_chart(case, k, o)
    if not drawn.lines and o.reference.kind == "none":
        return None
    figure = Figure(f"{o.name}-error", f"Error of {o.label} against run time", advice=recommendation(case, k))
    for run in case.runs:
        error = run.error_of(k)
        if error is None:
            figure.notes.append(f"{run.name} has no error: {_why_no_error(run, k)}.")
        elif not 0 < error < math.inf:
            figure.notes.append(f"{run.name}: error {number(error)}, drawn at the edge.")
    if drawn.lines:
        figure.svg = svg_chart(drawn)
    else:
        figure.notes.insert(0, "There is nothing to draw.")
    return figure


def _line(figure: Figure, name: str, x: np.ndarray, y: np.ndarray, style: str) -> Line:
    """The line of a curve; what is not finite in it is reported."""
    gaps = int(np.count_nonzero(~(np.isfinite(x) & np.isfinite(y))))
    if gaps:
        figure.notes.append(f"{name}: {gaps} of {len(x)} values are not finite numbers and are left out.")
    return Line(name, [Point(a, b, f"{number(a)}, {number(b)}") for a, b in zip(x.tolist(), y.tolist(), strict=True)], style)


@chart("curve")
def curve_figure(case: CaseResult, k: int) -> Figure | None:
    """The curves of the first setting that has some, one for each resolution, with the reference of the finest."""
    if case.definition.stability:
        return None  # each run is a setting of its own: a chart of the first one alone would say little
    o = case.definition.observations[k]
    with_curve = [run for run in case.runs if k < len(run.observed) and len(run.observed[k].curve.x) > 1]  # a single number is no curve
    if not with_curve:
        return None
    setting = with_curve[0].setting
    figure = Figure(f"{o.name}-curve", o.label + (f", {setting}" if setting else ""))
    drawn = Chart(f"{case.definition.title}: {o.label}", o.along if o.is_profile else "t", o.label + (f" [{o.unit}]" if o.unit else ""))
    finest: Curve | None = None
    for run in with_curve:
        if run.setting != setting:
            continue
        curve = run.observed[k].curve
        name = f"{case.definition.resolution} {run.resolution}" if run.resolution else run.name
        drawn.lines.append(_line(figure, name, curve.x, curve.y, "line"))
        finest = curve if len(curve.reference_x) else finest
    if finest is not None:
        few = len(finest.reference_x) <= _MOST_SINGLE_POINTS and o.reference.kind == "csv"
        drawn.lines.append(_line(figure, "reference", finest.reference_x, finest.reference_y, "dots" if few else "reference"))
    figure.svg = svg_chart(drawn)
    return figure


@chart("map", of="case")
def map_figures(case: CaseResult) -> list[Figure]:
    """One map of a stability case, or one for each of several settings."""
    settings = case.definition.settings
    out = []
    for setting in [s.name for s in settings] if len(settings) > 1 else [""]:
        map_ = stability_map(case, setting)
        if map_ is None:
            return []
        figure = Figure(f"map-{setting}" if setting else "map", "Stability map" + (f", {setting}" if setting else ""), svg_map(map_))
        if map_.value_name:
            figure.notes.append(f"Numbers in the cells: {map_.value_name}.")
        out.append(figure)
    out[-1].notes.append(f"{verdict_counts(case)}.")
    out[-1].notes += [f"{run.name} is {run.verdict.name}, which the suite does not allow." for run in case.runs if not run.as_required]
    return out


def _drawn(case: CaseResult) -> Iterator[Figure]:
    kinds = list(CHARTS.functions.values())
    for k in range(len(case.definition.observations)):
        yield from filter(None, (kind.function(case, k) for kind in kinds if kind.of == "observation"))
    for kind in kinds:
        yield from kind.function(case) if kind.of == "case" else ()


def figures(case: CaseResult) -> list[Figure]:
    """Per observation: error against CPU time, then the curves of the first setting against the reference; last the stability map. Never an empty
    list for a case with runs."""
    out = list(_drawn(case))
    if not out and case.runs:
        out.append(Figure("none", "Charts", notes=["Nothing is observed that could be drawn."]))
    return out
