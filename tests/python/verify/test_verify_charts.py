"""Charts and maps as SVG."""

from __future__ import annotations

import math
import re
from xml.etree import ElementTree

import pytest
from made_suite import stability, wave

from courant.verify.charts import Chart, Line, Point, stability_map, svg_chart, svg_map, verdict_counts, width_of
from courant.verify.figures import figures
from courant.verify.model import Setting, Verdict
from courant.verify.report import standalone_svg

INF, NAN = math.inf, math.nan


def words(svg: str) -> list[str]:
    """Texts of a drawing."""
    return ["".join(one.itertext()).strip() for one in ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")]


def hovers(svg: str) -> list[str]:
    return [one.text or "" for one in ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}title")]


def chart(*points: Point) -> Chart:
    return Chart(logarithmic=True, lines=[Line("a <b> $x$", list(points))])


@pytest.mark.parametrize(
    ("ends", "expected"),
    [((0.01, 100), {"0.01", "0.1", "1", "10", "100"}), ((0.011, 0.09), {"1 %", "2 %", "5 %", "10 %"}), ((1e-16, 1), {"1e-8", "0.01"}), ((6.1, 6.2), {"5", "6", "9"})],
)
def test_numbers_of_logarithmic_axes_are_round(ends: tuple[float, float], expected: set[str]) -> None:
    c = chart(*(Point(end, end) for end in ends))
    c.percent = any("%" in label for label in expected)
    found = {label.replace("\u00a0", " ") for label in words(svg_chart(c))}
    assert expected <= found and 4 <= len(found) <= 40


@pytest.mark.parametrize("logarithmic", [False, True])
@pytest.mark.parametrize(
    "values",
    [[], [0], [3], [2.5, 2.5], [-1, -1], [1, 1 + 1e-15], [6.1, 6.2], [1e-289], [1e289], [1e-289, 1e289], [NAN, INF], [-INF, 0, 2], [1e9, 1e9 + 1]],
)
def test_whatever_there_is_is_drawn(logarithmic: bool, values: list[float]) -> None:
    svg = svg_chart(Chart(logarithmic=logarithmic, lines=[Line("a", [Point(v, v, f"point {k}") for k, v in enumerate(values)])]))
    assert hovers(svg) == ["a"] * bool(values) + [*(f"point {k}" for k in range(len(values)))]
    assert not re.search(r"\b(nan|inf)\b", re.sub("[↑↓] -?inf", "", svg))


def test_every_point_has_a_mark_that_tells_its_numbers() -> None:
    svg = svg_chart(chart(Point(1, 0.1, "one"), Point(2, 0.05, "two & more")))
    assert hovers(svg) == ["a <b> $x$", "one", "two & more"]
    assert "a <b> $x$" in words(svg) and "a <b>" not in svg


def test_points_without_a_place_stand_at_the_edge() -> None:
    svg = svg_chart(chart(Point(1, 0.1), Point(2, 0, "zero"), Point(3, NAN), Point(4, INF), Point(0, 0.2)))
    assert {"↓ 0", "↑ NaN", "↑ inf", "time 0"} <= set(words(svg))
    assert "zero" in hovers(svg)


def test_lines_break_where_values_are_missing() -> None:
    svg = svg_chart(Chart(lines=[Line("a", [Point(x, y) for x, y in enumerate((0, 1, NAN, 1, 0))], "line")]))
    line = re.search(r"<title>a</title><path d=\"([^\"]*)\"", svg)
    assert line and (line[1].count("M"), line[1].count("L")) == (2, 2)


def test_front_and_bound_are_drawn_and_named() -> None:
    c = chart(Point(1, 0.1), Point(2, 0.05))
    assert "best error for the time" not in words(svg_chart(c))
    c.front, c.levels = c.lines[0].points, [("bound 1 %", 0.01)]
    svg = svg_chart(c)
    assert {"best error for the time", "bound 1 %"} <= set(words(svg)) and "bound 1 %" in hovers(svg)
    assert "#d9b300" in svg and "#b00020" in svg


def test_the_same_numbers_give_the_same_file_without_ids_of_its_own() -> None:
    c = chart(Point(1, 0.1), Point(2, 0.05))
    assert svg_chart(c) == svg_chart(c)
    assert all(re.fullmatch(r"[pm][0-9a-f]{10}", found) for found in re.findall(r' id="([^"]*)"', svg_chart(c)))


def test_all_sorts_of_nothing() -> None:
    assert svg_chart(Chart()).endswith("</svg>") and svg_chart(chart()).endswith("</svg>")
    assert "><style>" in standalone_svg(svg_chart(Chart()))
    ElementTree.fromstring(standalone_svg(svg_chart(Chart(label="<odd> & \x01", x_label="\x02 $", lines=[Line("_\x03", [])]))))


def test_cells_tell_their_verdict_by_a_letter() -> None:
    c = stability(5, 4)
    svg = svg_map(stability_map(c))
    assert (words(svg).count("S"), words(svg).count("X")) == (10, 3)
    assert {"S  stable (10)", "D  degraded (7)"} <= {text.replace("\u00a0", " ") for text in words(svg)}
    assert any("runaway energy" in text for text in hovers(svg)) and any("growth 0.03 > 0.01" in text for text in hovers(svg))
    assert verdict_counts(c) == "10 stable, 7 degraded, 3 stopped"


def test_long_sweeps_stand_in_rows() -> None:
    map_ = stability_map(stability(13, 6))
    assert (len(map_.columns), len(map_.rows), map_.row_name) == (6, 13, "tssfac")
    assert map_.cells[6].hover.startswith("tssfac = 0.2, scale = 1e-3: stable")
    assert width_of(svg_map(map_)) < 1.2 and width_of(svg_map(stability_map(stability(15, 14)))) > 1.2, "it scrolls"


def test_what_is_not_allowed_or_missing_stands_out() -> None:
    svg = svg_map(stability_map(stability(12, 0)))
    assert "! ✗" in words(svg) and svg.count("#b00020") == 2 and "tssfac = 0.12" in hovers(svg)
    assert "#b00020" not in svg_map(stability_map(stability(5, 4)))
    c = stability(3, 2)
    del c.runs[0]
    assert stability_map(c).cells[0].verdict is None
    assert any("no run (1)" in text for text in words(svg_map(stability_map(c))))


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
