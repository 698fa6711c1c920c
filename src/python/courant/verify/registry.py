"""What a suite can name, each one function with a decorator; `--load my.py` adds more."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from ..registry import Registry

Function = TypeVar("Function", bound=Callable[..., Any])

take: Registry[Callable[..., float]] = Registry("take")
"""A number out of a curve: (series, at) -> number; raises `NoValue` where there is none. `at`: the moment of the observation, or None."""

reduction: Registry[Callable[..., float]] = Registry("reduction")
"""A number out of particles: (values, volumes), shapes (n) -> number; not finite where there is none."""

norm: Registry[Callable[..., float]] = Registry("norm")
"""A size of differences: (differences), shape (n), n > 0 -> number."""


@dataclass(frozen=True)
class Kind:
    """A kind of observation, or of chart. Observations: `of` is what their expressions are of, "histories" or "particles". function(observation,
    run) returns a `Measured`, or is a generator that yields indices of field states, is sent their tables, and returns one. Charts: `of` is
    "observation", then function(case, index) -> `Figure` or None, or "case", then function(case) -> figures."""

    of: str
    function: Callable[..., Any]


KINDS: Registry[Kind] = Registry("kind of observation")
CHARTS: Registry[Kind] = Registry("chart")


def _adder(registry: Registry[Kind], name: str, of: str) -> Callable[[Function], Function]:
    def add(function: Function) -> Function:
        registry.add(name, Kind(of, function))
        return function
    return add


def observation(name: str, of: str = "particles") -> Callable[[Function], Function]:
    """Adds a kind of observation; see `Kind`."""
    return _adder(KINDS, name, of)


def chart(name: str, of: str = "observation") -> Callable[[Function], Function]:
    """Adds a figure of the reports; see `Kind`."""
    return _adder(CHARTS, name, of)
