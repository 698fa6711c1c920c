"""Which runs are worth their time."""

from __future__ import annotations

import math

import pytest
from made_suite import all_stopped, one_run, wave

from courant.verify.model import Verdict
from courant.verify.pareto import CostPoint, cheapest_within_bounds, choices, cost_points, pareto_front, recommendation

INF, NAN = math.inf, math.nan


@pytest.mark.parametrize(
    ("points", "front"),
    [
        ([(4, 0.1), (1, 0.5), (2, 0.6), (2, 0.2), (8, 0.1)], [1, 3, 0]),
        ([], []),
        ([(1, 1)], [0]),
        ([(1, 0.5), (1, 0.5)], [0]),
        ([(1, 0.5), (1, 0.4)], [1]),
        ([(2, 0.5), (1, 0.5)], [1]),
        ([(1, NAN), (NAN, 0.1), (1, INF), (5, 0.3), (-1, 0.1), (1, -0.1)], [3]),
        ([(0, 0.1), (1, 0)], [0, 1]),
    ],
)
def test_the_front_holds_what_nothing_else_beats(points: list[tuple[float, float]], front: list[int]) -> None:
    assert [p.run for p in pareto_front([CostPoint(i, *p) for i, p in enumerate(points)])] == front


def test_choices_are_round_levels_each_with_its_cheapest_run() -> None:
    found = choices([CostPoint(i, i + 1, e) for i, e in enumerate((0.3, 0.21, 0.2, 0.0011, 0))])
    assert [(level, p.run) for level, p in found] == [(0.5, 0), (0.2, 2), (0.002, 3), (0, 4)]


@pytest.mark.parametrize("level", [1e-7, 2e-5, 5e-3, 0.01, 0.02, 0.05, 0.1, 1.0, 5.0])
def test_levels_are_exact_at_their_ends(level: float) -> None:
    assert choices([CostPoint(0, 1, level)])[0][0] == level
    assert choices([CostPoint(0, 1, 0.0501)])[0][0] == 0.1


def test_recommendations_name_setting_resolution_time_and_error() -> None:
    text = recommendation(wave(), 0)
    assert len(text) == 4
    assert text[1] == "at most 1\u00a0%: Wendland C2, h/dx = 1.6 at resolution 20, 1.7\u00a0s (error 0.8\u00a0%)."
    assert recommendation(wave(), 1)[-1] == "No run reaches the bound of 0.1\u00a0%; the smallest error is 0.15\u00a0%."
    assert recommendation(all_stopped(), 0) == []


def test_recommendations_are_short() -> None:
    c = one_run()
    for i in range(1, 20):
        c.runs.append(one_run().runs[0])
        c.runs[-1].resolution, c.runs[-1].cpu_seconds, c.runs[-1].observed[0].error = str(i), 2.0 * i, 0.1**i
    text = recommendation(c, 0)
    assert len(text) == 6
    assert "the run, 1.5" in text[0] and "resolution 19" in text[-1]


def test_never_a_run_that_stopped_or_is_the_reference() -> None:
    c = one_run()
    c.runs.append(one_run().runs[0])
    c.runs[1].cpu_seconds, c.runs[1].exit_code = 0.1, 2
    assert [p.run for p in pareto_front(cost_points(c, 0))] == [0]
    c.runs[1].exit_code = 0
    assert [p.run for p in pareto_front(cost_points(c, 0))] == [1]
    c.runs[1].verdict = Verdict.broken
    assert [p.run for p in pareto_front(cost_points(c, 0))] == [0]
    c.runs.pop()
    c.runs[0].observed[0].error = 0
    assert len(cost_points(c, 0)) == 1
    c.definition.observations[0].reference.kind = "finest"
    assert cost_points(c, 0) == []


def test_the_cheapest_within_bounds_meets_all_of_them() -> None:
    c = wave()
    assert cheapest_within_bounds(c) is None, "the second bound is out of reach"
    c.definition.observations[1].bound = None
    assert cheapest_within_bounds(c) is c.runs[5], "Wendland at 20: 0.8 %"
    c.runs[5].observed[0].error = None
    assert cheapest_within_bounds(c) is c.runs[6]
    c.definition.observations[0].bound = None
    assert cheapest_within_bounds(c) is None, "nothing is bounded"
