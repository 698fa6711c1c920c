"""Axes, charts and maps as SVG."""

from __future__ import annotations

import math
import re
from xml.etree import ElementTree

import pytest
from made_suite import stability, wave

from courant.verify.figures import figures
from courant.verify.model import Setting, Verdict
from courant.verify.report import standalone_svg
from courant.verify.svg import Axis, Chart, Line, Point, svg_chart
from courant.verify.svg_map import stability_map, svg_map, verdict_counts

INF, NAN = math.inf, math.nan


def labels(logarithmic: bool, values: list[float], percentages: bool = False) -> list[str]:
    return [label for _, label in Axis(logarithmic, values, percentages).ticks]


@pytest.mark.parametrize(
    ("logarithmic", "values", "expected"),
    [
        (False, [0, 4], "0 1 2 3 4"),
        (False, [-0.1, 0.3], "-0.1 0 0.1 0.2 0.3"),
        (False, [1000.001, 1000.003], "1000.001 1000.0015 1000.002 1000.0025 1000.003"),
        (False, [101324.99991, 101325.00009], "101324.9999 101324.99995 101325 101325.00005 101325.0001"),
        (False, [1.0e8, 1.02e8], "1e8 1.005e8 1.01e8 1.015e8 1.02e8"),
        (False, [0, 2e-5], "0 5e-6 1e-5 1.5e-5 2e-5"),
        (True, [0.01, 100], "0.01 0.1 1 10 100"),
    ],
)
def test_ticks_are_round(logarithmic: bool, values: list[float], expected: str) -> None:
    assert labels(logarithmic, values) == expected.split()


def test_percentages_and_wide_ranges() -> None:
    assert labels(True, [0.011, 0.09], True) == ["1 %", "2 %", "5 %", "10 %"]
    wide = labels(True, [1e-16, 1], True)
    assert 4 <= len(wide) <= 7
    assert not any("%" in label for label in wide), "1e-14 % helps nobody"


@pytest.mark.parametrize("logarithmic", [False, True])
@pytest.mark.parametrize(
    "values",
    [
        [],
        [0],
        [3],
        [2.5, 2.5],
        [-1, -1],
        [1, 1 + 1e-15],
        [6.1, 6.2],
        [1e-290],
        [1e299],
        [1e-299, 1e299],
        [NAN, INF],
        [-INF, 0, 2],
        [1e9, 1e9 + 1],
    ],
)
def test_an_axis_has_two_ticks_whatever_it_shows(logarithmic: bool, values: list[float]) -> None:
    axis = Axis(logarithmic, values)
    assert 2 <= len(axis.ticks) <= 10
    assert axis.start < axis.end
    assert all(-1e-9 <= axis.place(v) <= 1 + 1e-9 for v in values if axis.shows(v))


def test_places_are_proportional_to_the_value_or_its_logarithm() -> None:
    linear, logarithmic = Axis(False, [0, 4]), Axis(True, [0.01, 100])
    assert (linear.place(1), logarithmic.place(1)) == pytest.approx((0.25, 0.5))
    assert linear.shows(0) and not logarithmic.shows(0)


def chart(*points: Point) -> Chart:
    return Chart(logarithmic=True, lines=[Line("a <b>", list(points))])


def drawn(c: Chart) -> str:
    svg = svg_chart(c)
    ElementTree.fromstring(svg)  # raises where it is not XML
    return svg


def test_every_point_has_a_mark_that_tells_its_numbers() -> None:
    svg = drawn(chart(Point(1, 0.1, "one"), Point(2, 0.05, "two & more")))
    assert svg.count('class="mark"') == 3, "and one in the legend"
    for text in ("<title>one</title>", "<title>two &amp; more</title>", "a &lt;b&gt;"):
        assert text in svg
    assert "a <b>" not in svg


def test_points_without_a_place_stand_at_the_edge() -> None:
    svg = drawn(chart(Point(1, 0.1), Point(2, 0, "zero"), Point(3, NAN), Point(4, INF), Point(0, 0.2)))
    assert (svg.count('class="mark"'), svg.count('class="arrow"')) == (6, 3)
    for text in (">NaN</text>", ">inf</text>", ">time 0</text>", "<title>zero</title>"):
        assert text in svg
    assert "nan" not in svg and '"inf' not in svg, "no coordinate is one"


def test_lines_break_where_values_are_missing() -> None:
    svg = drawn(Chart(lines=[Line("a", [Point(x, y) for x, y in enumerate((0, 1, NAN, 1, 0))], "line")]))
    path = re.search(r'class="line" d="([^"]*)"', svg)
    assert path and (path[1].count("M"), path[1].count("L")) == (2, 2)


def test_front_and_bound_are_drawn_and_named() -> None:
    c = chart(Point(1, 0.1), Point(2, 0.05))
    assert 'class="front"' not in drawn(c)
    c.front, c.levels = c.lines[0].points, [("bound 1 %", 0.01)]
    svg = drawn(c)
    assert (svg.count('class="front"'), svg.count('r="9"'), svg.count('class="bound"')) == (2, 2, 2)
    assert ">bound 1 %</text>" in svg


def test_all_sorts_of_nothing() -> None:
    assert drawn(Chart()).endswith("</svg>") and drawn(chart()).endswith("</svg>")
    assert "><style>" in standalone_svg(svg_chart(Chart()))
    ElementTree.fromstring(standalone_svg(svg_chart(Chart(label="<odd> & \x01"))))


def test_cells_tell_their_verdict_by_a_letter() -> None:
    c = stability(5, 4)
    svg = svg_map(stability_map(c))
    ElementTree.fromstring(svg)
    assert (svg.count(">S</text>"), svg.count(">X</text>")) == (11, 4), "cells and the legend"
    for text in ("stable (10)", "runaway energy", "growth 0.03 &gt; 0.01"):
        assert text in svg
    assert verdict_counts(c) == "10 stable, 7 degraded, 3 stopped"


def test_long_sweeps_stand_in_rows() -> None:
    map_ = stability_map(stability(13, 6))
    assert (len(map_.columns), len(map_.rows), map_.row_name) == (6, 13, "tssfac")
    assert map_.cells[6].hover.startswith("tssfac = 0.2, scale = 1e-3: stable")


def test_what_is_not_allowed_or_missing_stands_out() -> None:
    svg = svg_map(stability_map(stability(12, 0)))
    assert svg.count('class="fault"') == 2 and ">! ✗</text>" in svg
    assert 'class="fault"' not in svg_map(stability_map(stability(5, 4)))
    c = stability(3, 2)
    del c.runs[0]
    assert stability_map(c).cells[0].verdict is None
    assert "no run (1)" in svg_map(stability_map(c))


def test_of_several_runs_the_worst_stands_in_the_cell() -> None:
    c = stability(2, 0)
    for verdict in (Verdict.stopped, Verdict.stable):
        c.runs.append(stability(2, 0).runs[0])
        c.runs[-1].verdict = verdict
        assert stability_map(c).cells[0].verdict == Verdict.stopped


def test_settings_have_maps_of_their_own() -> None:
    c = stability(2, 0)
    for run in c.runs:
        run.setting = "cubic, " + run.setting
    c.runs.append(stability(2, 0).runs[0])
    c.runs[-1].setting, c.runs[-1].verdict = "cubic spline, tssfac = 0.1", Verdict.broken
    assert stability_map(c, "cubic").cells[0].verdict == Verdict.stable
    assert stability_map(c, "cubic spline").cells[0].verdict == Verdict.broken
    c.definition.settings = [Setting("cubic"), Setting("cubic spline")]
    assert len(figures(c)) == 2


def test_a_case_without_sweep_shows_its_runs() -> None:
    c = stability(2, 0)
    c.definition.stability.sweep = []
    assert stability_map(c).columns[1] == "tssfac = 0.2"
    assert stability_map(wave()) is None
