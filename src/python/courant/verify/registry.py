"""What a suite can name, each one function with a decorator; `--load my.py` adds more.

    from courant.verify import take

    @take("spread")
    def spread(series, at):
        return series.y.max() - series.y.min()

`observation`: a kind of observation; `take`: a number out of a curve; `reduction`: a number out of particles;
`norm`: a size of differences; `chart`: a figure of the reports. A name that stands twice is refused.
"""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..registry import Function, Registry

take: Registry[Callable[..., float]] = Registry("take")
"""(series, at) -> number; raises `NoValue` where there is none. `at`: the moment of the observation, or None."""

reduction: Registry[Callable[..., float]] = Registry("reduction")
"""(values, volumes), shapes (n) -> number; NaN where there is none."""

norm: Registry[Callable[..., float]] = Registry("norm")
"""(differences), shape (n), n > 0 -> number."""


@dataclass(frozen=True)
class Kind:
    """A kind of observation.

    `over`: what `of` is an expression of, "histories" or "particles". `measure(observation, run)` returns a
    `Measured`, or is a generator that yields indices of field states, is sent their tables, and returns one.
    """

    over: str
    measure: Callable[..., Any]


KINDS: dict[str, Kind] = {}


def observation(name: str, over: str = "particles") -> Callable[[Function], Function]:
    """Adds a kind of observation; see `Kind`."""
    def add(function: Function) -> Function:
        if name in KINDS:
            raise ValueError(f"there is a kind of observation '{name}' already")
        KINDS[name] = Kind(over, function)
        return function
    return add


@dataclass(frozen=True)
class ChartKind:
    """A figure of the reports. `of`: "observation", drawn for each as f(case, index) -> Figure or None; "case": once as f(case) -> figures."""

    of: str
    draw: Callable[..., Any]


CHARTS: dict[str, ChartKind] = {}


def chart(name: str, of: str = "observation") -> Callable[[Function], Function]:
    """Adds a figure of the reports; see `ChartKind`."""
    def add(function: Function) -> Function:
        if name in CHARTS:
            raise ValueError(f"there is a chart '{name}' already")
        CHARTS[name] = ChartKind(of, function)
        return function
    return add
