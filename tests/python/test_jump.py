"""The measures of a hydraulic jump against hand calculation and made signals."""

from __future__ import annotations

import math

import numpy as np
import pytest
from courant.post.jump import (
    JumpRecipe,
    JumpResult,
    PublishedRow,
    agreement_A,
    agreement_P,
    belanger_depth,
    evaluate_jump,
    find_case,
    froude,
    jump_text,
    largest_deviation_over_d1,
    roller_length_over_d1,
    surface_strouhal,
    velocity_decay,
)

ROWS = [PublishedRow("d1/4", (2.5, 5), 0.969, 0.049), PublishedRow("d1/10", (2.5, 5), 0.936, 0.119), PublishedRow("d1/4", (15, 30), 1.041, 0.045)]
RECIPE = JumpRecipe(1, 0, 0, 1.5, 0.02, 9.81, [(2.5, 5), (15, 30)], ROWS, toe_range=(0, 1.1), front_x=1.08)


def test_the_papers_jump():
    assert froude(1.5, 0.02, 9.81) == pytest.approx(3.3864, abs=1e-4)
    assert belanger_depth(1.5, 0.02, 9.81) == pytest.approx(0.08630, abs=1e-5)
    assert belanger_depth(math.sqrt(9.81 * 0.02), 0.02, 9.81) == pytest.approx(0.02, abs=1e-15)  # Fr = 1: no jump


def test_the_papers_equations():
    """Against hand calculation with tables of tanh and exp."""
    assert 0.02 * roller_length_over_d1(3.4) == pytest.approx(0.2988, rel=5e-3)  # the number in the paper
    assert velocity_decay(np.array([0.0, 10.0])) == pytest.approx([1, 0.75578], abs=1e-5)
    assert largest_deviation_over_d1(2) == pytest.approx(0.116) and math.isnan(largest_deviation_over_d1(0.5))
    assert surface_strouhal(0) == pytest.approx(0.143) and surface_strouhal(3.4) * 1.5 / 0.02 == pytest.approx(4.28, abs=0.01)


def test_agreement_of_made_signals():
    exact, scaled, mixed = np.array([2.0, 2, 2]), np.array([1.8, 1.8]), np.array([1.0, 3])
    assert (agreement_A(exact, 2), agreement_P(exact, 2)) == (1, 0)
    assert agreement_A(scaled, 2) == pytest.approx(0.9) and agreement_P(scaled, 2) == pytest.approx(0.1)
    assert agreement_A(mixed, 2) == pytest.approx(math.sqrt(10 / 8)) and agreement_P(mixed, 2) == pytest.approx(0.5)
    assert math.isnan(agreement_A(np.empty(0), 2))


def series(before, after, end):
    """Depth `before` d2 up to 2.5 s, `after` d2 from then on; states up to one step early."""
    i = np.arange(round(end / 0.01) + 1)
    t = np.where(i == 0, 0, 0.01 * i - 2e-6)
    depth = np.where(i < 250, before, after) * RECIPE.theory
    toe = np.where(i < 80, np.nan, 0.9 - 1e-4 * np.abs(i - 200))
    return JumpResult(t, depth, toe, np.where(i < 80, 0.02, 0.03))


def test_only_the_interval_counts():
    found = evaluate_jump(RECIPE, "d1/4", series(9, 0.95, 5))
    first, second = found.intervals
    assert (first.states, first.complete, second.states) == (251, True, 0)
    assert first.A == pytest.approx(0.95) and first.P == pytest.approx(0.05) and first.mean_depth == pytest.approx(0.95 * RECIPE.theory)
    assert [row.A for row in first.published] == [0.969]
    assert found.front_time == pytest.approx(0.8, abs=1e-5) and found.turn == pytest.approx((2.0, 0.9), abs=1e-5)
    text = jump_text(RECIPE, found)
    assert "0.950    0.050   d1/4" in text and "do not reach this interval" in text and "furthest downstream at t = 2.000 s" in text


def test_part_of_an_interval_is_told_and_an_unknown_case_shows_all_rows():
    found = evaluate_jump(RECIPE, "", series(1, 1, 4))
    assert not found.intervals[0].complete and found.intervals[0].states == 151
    assert [len(one.published) for one in found.intervals] == [2, 1]
    assert "cover only a part" in jump_text(RECIPE, found) and "Case: unknown" in jump_text(RECIPE, found)


def test_a_wave_that_does_not_arrive():
    found = evaluate_jump(RECIPE, "", series(1, 1, 0.5))
    assert found.front_time is None and found.turn is None
    assert "The wave does not reach x = 1.08 m by t = 0.5 s" in jump_text(RECIPE, found)


@pytest.mark.parametrize(
    "title, case", [("Hydraulic jump, D1 / 10", "d1/10"), ("jump d1/4, 30 s", "d1/4"), ("jump d1/40", ""), ("", ""), ("d1/40 d1/4", "d1/4")]
)
def test_the_case_in_the_title(title, case):
    assert find_case(title, ROWS) == case
