"""Numbers out of curves, against their theory."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from courant.verify.registry import norm, reduction
from courant.verify.series import NoValue, Series, slope_of, take_number


def sampled(start: float, end: float, n: int, f: Callable[[np.ndarray], np.ndarray]) -> Series:
    t = np.linspace(start, end, n + 1)
    return Series(t, f(t))


def test_simple_takes() -> None:
    s = sampled(0, 2, 4, lambda t: 3 - 2 * t)  # 3 2 1 0 -1
    found = {how: take_number(s, how) for how in ("final", "mean", "min", "max", "slope", "growth")}
    assert found == pytest.approx({"final": -1, "mean": 1, "min": -1, "max": 3, "slope": -2, "growth": 1})
    assert take_number(s, "at", 0.75) == pytest.approx(1.5)
    assert take_number(s, "at", 2.000001) == -1, "a state may be written a little early"
    for series, how, at in (
        (s, "at", 2.1),
        (s, "at", -0.1),
        (Series(), "mean", None),
        (Series([0], [1]), "slope", None),
        (Series([0, 1], [0, 1]), "growth", None),
    ):
        with pytest.raises(NoValue):
            take_number(series, how, at)


def test_mean_of_a_curve_does_not_weigh_dense_points_more() -> None:
    s = Series([0, 0.1, 0.2, 0.3, 1.3], [0, 1, 2, 3, 3])
    assert s.mean_between(-math.inf, math.inf) == pytest.approx((0.45 + 3) / 1.3)
    assert s.mean_between(0.15, 0.8) == pytest.approx((0.15 * 2.25 + 0.5 * 3) / 0.65), "ends between points"
    assert math.isnan(s.mean_between(1.5, 2))


@pytest.mark.parametrize("cycles", [2.2, 3.0, 3.7, 10.4])
@pytest.mark.parametrize("phase", [0.0, 1.0, 2.5, 4.0])
def test_period_of_a_sine(cycles: float, phase: float) -> None:
    s = sampled(0, cycles * 1.3, 400, lambda t: 5 + np.sin(2 * math.pi * t / 1.3 + phase))
    assert take_number(s, "period") == pytest.approx(1.3, rel=2e-3)


def test_period_over_a_trend_with_decay_and_noise() -> None:
    noise = np.random.default_rng(1).normal(0, 0.05, 1001)
    s = sampled(0, 5, 1000, lambda t: 2 + 0.3 * t + np.exp(-0.1 * t) * np.sin(2 * math.pi * t / 0.8 + 0.7) + noise)
    assert take_number(s, "period") == pytest.approx(0.8, abs=0.01)


@pytest.mark.parametrize("f", [lambda t: t, lambda t: 1 + 0 * t, lambda t: np.sin(math.pi * t)])
def test_no_period(f: Callable[[np.ndarray], np.ndarray]) -> None:
    with pytest.raises(NoValue):
        take_number(sampled(0, 1, 100, f), "period")


@pytest.mark.parametrize(
    ("f", "end", "rate"),
    [
        (lambda t: np.exp(-0.4 * t) * np.cos(5 * t), 6, 0.4),
        (lambda t: (np.exp(-0.4 * t) * np.cos(5 * t)) ** 2, 6, 0.8),  # as of a kinetic energy: it decays twice as fast
        (lambda t: np.exp(0.2 * t) * np.sin(9 * t), 3, -0.2),
    ],
)
def test_decay_of_peaks(f: Callable[[np.ndarray], np.ndarray], end: float, rate: float) -> None:
    assert take_number(sampled(0, end, 200 * end, f), "decay") == pytest.approx(rate, abs=4e-3)


def test_no_decay() -> None:
    with pytest.raises(NoValue):
        take_number(sampled(0, 1, 50, lambda t: np.exp(-t)), "decay")


def test_norms_and_reductions() -> None:
    d = np.array([3.0, -4, 0, 0])
    assert (norm["l1"](d), norm["l2"](d), norm["linf"](d)) == pytest.approx((7 / 4, 2.5, 4))
    values, volumes = np.array([4.0, 1, 2, 3]), np.array([3.0, 1, 1, 1])
    found = {name: reduction[name](values, volumes) for name in ("mean", "sum", "min", "max", "count", "median", "p01", "p99")}
    assert found == pytest.approx({"mean": 3, "sum": 10, "min": 1, "max": 4, "count": 4, "median": 2.5, "p01": 1.03, "p99": 3.97})
    none = np.empty(0)
    assert (reduction["sum"](none, none), reduction["count"](none, none)) == (0, 0)
    assert not any(math.isfinite(reduction[name](none, none)) for name in ("mean", "min", "max", "median", "p01", "p99"))


def test_window_thinning_and_interpolation() -> None:
    s = sampled(0, 1, 1000, lambda t: t)
    assert len(s.window(0.25, 0.5)) == 251
    thin = s.thinned(400)
    assert (len(thin), thin.x[0], thin.x[-1], len(s.thinned(2000))) == (400, 0, 1, 1001)
    two = Series([0, 2], [1, 5])
    assert two.values_at(np.array([-1, 0, 0.5, 2, 2.0000001, 3])) == pytest.approx([math.nan, 1, 2, 5, 5, math.nan], nan_ok=True)
    assert Series().value_at(0) is None


def test_slope() -> None:
    assert slope_of(np.array([0, 1, 2]), np.array([1, 3, 5])) == pytest.approx(2)
    assert slope_of(np.array([1, 1]), np.array([0, 1])) is None
    assert slope_of(np.array([1]), np.array([1])) is None
