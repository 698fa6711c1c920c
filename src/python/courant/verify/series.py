"""Numbers out of curves, and differences between curves."""
from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from .registry import norm, reduction, take

FEWEST_OF_PERIOD = 8  # samples


class NoValue(Exception):
    """There is no number; the text states why."""


@dataclass
class Series:
    """A curve; x rises. Shape of both: (n,)."""

    x: np.ndarray = field(default_factory=lambda: np.empty(0))
    y: np.ndarray = field(default_factory=lambda: np.empty(0))

    def __post_init__(self) -> None:
        self.x, self.y = np.asarray(self.x, dtype=float), np.asarray(self.y, dtype=float)

    def __len__(self) -> int:
        return len(self.x)

    def window(self, start: float, end: float) -> Series:
        """Points with start <= x <= end."""
        inside = (self.x >= start) & (self.x <= end)
        return Series(self.x[inside], self.y[inside])

    def mean_between(self, start: float, end: float) -> float:
        """Of the lines through the points, over what of start <= x <= end they cover, however dense they stand; NaN where that is nothing."""
        start, end = max(start, float(self.x[0])), min(end, float(self.x[-1]))
        if not end > start:
            return math.nan
        x = np.concatenate([[start], self.x[(self.x > start) & (self.x < end)], [end]])
        y = self.values_at(x)
        return sum_of(0.5 * (y[1:] + y[:-1]) * np.diff(x)) / (end - start)

    def thinned(self, most: int) -> Series:
        """At most `most` points, evenly chosen, the ends among them."""
        if len(self) <= most:
            return self
        chosen = np.arange(most) * (len(self) - 1) // (most - 1)
        return Series(self.x[chosen], self.y[chosen])

    def values_at(self, x: np.ndarray) -> np.ndarray:
        """y at x by linear interpolation; NaN outside the range. A location beyond an end by 1e-6 of the range is that end. Shape of x."""
        if len(self) == 0:
            return np.full(np.shape(x), np.nan)
        slack = 1e-6 * (self.x[-1] - self.x[0])
        outside = (x < self.x[0] - slack) | (x > self.x[-1] + slack)
        return np.where(outside, np.nan, np.interp(x, self.x, self.y))

    def value_at(self, x: float) -> float | None:
        """y at x, None outside the range."""
        value = float(self.values_at(np.array([x]))[0])
        return None if math.isnan(value) else value


def sum_of(values: np.ndarray) -> float:
    """One after the other: what cancels does so to the same bits wherever numpy was built."""
    return float(np.cumsum(values)[-1]) if len(values) else 0.0


def slope_of(x: np.ndarray, y: np.ndarray) -> float | None:
    """Slope of the straight line by least squares; None with fewer than two different x."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if len(x) < 2:
        return None
    dx, dy = x - x.mean(), y - y.mean()
    square = float(dx @ dx)
    return float(dx @ dy) / square if square > 0 else None


norm.add("l1", lambda differences: float(np.mean(np.abs(differences))))
norm.add("l2", lambda differences: math.sqrt(float(np.mean(np.square(differences)))))
norm.add("linf", lambda differences: float(np.max(np.abs(differences))))
take.add("final", lambda series, at: float(series.y[-1]))
take.add("mean", lambda series, at: sum_of(series.y) / len(series))
take.add("min", lambda series, at: float(np.min(series.y)))
take.add("max", lambda series, at: float(np.max(series.y)))


@take("at")
def at_moment(series: Series, at: float | None) -> float:
    value = None if at is None else series.value_at(at)
    if value is None:
        raise NoValue("the moment lies outside the samples")
    return value


def upward_crossings(x: np.ndarray, distance: np.ndarray, margin: float) -> list[float]:
    """Where `distance`, shape (n,), rises through 0, each crossing from below -margin to above margin once. Several crossings on the way (noise)
    count as one, in their middle."""
    out: list[float] = []
    on_the_way: list[float] = []  # crossings since it was below -margin
    below, before, x_before = False, 0.0, 0.0
    for i, (place, d) in enumerate(zip(x.tolist(), distance.tolist(), strict=True)):
        if d < -margin:
            below = True
            on_the_way.clear()
        if i > 0 and below and before < 0 <= d:
            on_the_way.append(x_before + (place - x_before) * before / (before - d))
        if below and d > margin and on_the_way:
            out.append((on_the_way[0] + on_the_way[-1]) / 2)
            below = False
            on_the_way.clear()
        before, x_before = d, place
    return out


def _trend(series: Series, period: float) -> np.ndarray:
    """The line in the least squares fit of line + sine of this period, at the samples. Shape (n,)."""
    # about the middle and in units of the range, for the conditioning of the fit
    across = (series.x - (series.x[0] + series.x[-1]) / 2) / (series.x[-1] - series.x[0])
    phase = 2 * math.pi * series.x / period
    terms = np.column_stack([np.ones_like(across), across, np.cos(phase), np.sin(phase)])
    fit = np.linalg.solve(terms.T @ terms, terms.T @ series.y)
    return fit[0] + fit[1] * across


@take("period")
def period_of(series: Series, at: float | None = None) -> float:
    """Mean distance of the upward crossings of the trend [x]. The trend is a straight line, fitted together with a sine of the period found so
    far, so that a part of an oscillation at the ends does not tilt it. A crossing counts where the series goes from a quarter of its standard
    deviation below the trend to as much above it: noise about the trend does not. Needs two crossings."""
    none = NoValue("a period needs two upward crossings of the mean")
    margin = 0.25 * float(np.std(series.y)) if len(series) >= FEWEST_OF_PERIOD else 0.0
    if not margin > 0:
        raise none
    line = np.full_like(series.y, np.mean(series.y))
    period = 0.0
    for _ in range(6):
        crossings = upward_crossings(series.x, series.y - line, margin)
        if len(crossings) < 2:
            raise none
        period = (crossings[-1] - crossings[0]) / (len(crossings) - 1)
        try:
            line = _trend(series, period)
        except np.linalg.LinAlgError:
            raise none from None
    return period


def _top_of(x: np.ndarray, y: np.ndarray, i: int) -> tuple[float, float]:
    """Place and height of the parabola's top through a largest sample and its neighbours."""
    h1, h2 = x[i] - x[i - 1], x[i + 1] - x[i]
    a, b = y[i - 1] - y[i], y[i + 1] - y[i]
    curvature = (a / h1 + b / h2) / (h1 + h2)
    slope = b / h2 - curvature * h2
    if not curvature < 0:
        return float(x[i]), float(y[i])
    d = min(max(-slope / (2 * curvature), -h1), h2)
    return float(x[i] + d), float(y[i] + d * (slope + curvature * d))


@take("decay")
def decay_of(series: Series, at: float | None = None) -> float:
    """Rate b of the exponential a exp(-b x) fitted by least squares to the logarithms of the peaks of |y| [1/x]; b < 0 is growth. A peak counts
    where |y| falls by a quarter of it on both sides. Needs two peaks."""
    size = np.abs(series.y)
    places: list[float] = []
    logarithms: list[float] = []
    top, rising = 0, False
    valley = float(size[0]) if len(size) else 0.0  # smallest since the last peak
    for i, value in enumerate(size.tolist()):
        if i == 0:
            continue
        if not rising:
            # a rise counts when it is a third of what it started from, or a quarter of the last peak's fall
            valley = min(valley, value)
            last = math.exp(logarithms[-1]) if logarithms else float(size[0])
            if value > valley + 0.25 * abs(last - valley) and value > valley * 4 / 3:
                rising, top = True, i
        elif value > size[top]:
            top = i
        elif value < 0.75 * size[top]:
            place, height = _top_of(series.x, size, top)
            places.append(place)
            logarithms.append(math.log(height))
            rising, valley = False, value
    slope = slope_of(np.array(places), np.array(logarithms))
    if slope is None:
        raise NoValue("a decay needs two peaks")
    return -slope


@take("slope")
def slope(series: Series, at: float | None) -> float:
    value = slope_of(series.x, series.y)
    if value is None:
        raise NoValue("a slope needs two samples")
    return value


@take("growth")
def growth(series: Series, at: float | None) -> float:
    if series.y[0] == 0:
        raise NoValue("growth needs a first value that is not 0")
    return float(np.max(series.y) / series.y[0])


def take_number(series: Series, how: str, at: float | None = None) -> float:
    """The number that `how` names. Raises `NoValue`."""
    if len(series) == 0:
        raise NoValue("the window holds no sample")
    return float(take[how](series, at))


def percentile(values: np.ndarray, share: float) -> float:
    """Interpolated between neighbours in order; NaN of none."""
    return float(np.quantile(values, share)) if len(values) else math.nan


reduction.add("mean", lambda values, volumes: sum_of(volumes * values) / sum_of(volumes) if len(values) else math.nan)
reduction.add("sum", lambda values, volumes: sum_of(values))
reduction.add("min", lambda values, volumes: float(np.min(values, initial=math.inf)))
reduction.add("max", lambda values, volumes: float(np.max(values, initial=-math.inf)))
reduction.add("count", lambda values, volumes: float(len(values)))
reduction.add("median", lambda values, volumes: percentile(values, 0.5))
reduction.add("p01", lambda values, volumes: percentile(values, 0.01))
reduction.add("p99", lambda values, volumes: percentile(values, 0.99))
