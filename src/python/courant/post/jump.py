"""A hydraulic jump against theory.

Source of the measures: Jonsson, Jonsen, Andreasson, Lundstrom and Hellstrom, "Smoothed Particle Hydrodynamics Modelling of Hydraulic
Jumps", J. Appl. Math. Phys. (2016); equation numbers from there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ..fields import slack_of
from ..yaml_map import key

INTERVAL = "for example [2.5, 5.0]"


def froude(v1: float, d1: float, g: float) -> float:
    """v1 / sqrt(g d1)."""
    return v1 / math.sqrt(g * d1)


def belanger_depth(v1: float, d1: float, g: float) -> float:
    """Belanger's conjugate depth d2 = d1/2 (sqrt(1 + 8 Fr1^2) - 1), eq. 1. [L]"""
    return 0.5 * d1 * (math.sqrt(1 + 8 * froude(v1, d1, g) ** 2) - 1)


def roller_length_over_d1(Fr1: float) -> float:
    """Length of the roller over d1, eq. 2, for 2 < Fr1 < 16. Source there: Hager, Bremen and Kawagoshi (1990)."""
    return 160 * math.tanh(Fr1 / 20) - 12


def velocity_decay(distance_over_d1: np.ndarray) -> np.ndarray:
    """Largest mean velocity over v1 at a distance (x - x1) / d1 from the toe, eq. 3. Source there: Chanson (2010)."""
    return np.exp(-0.028 * distance_over_d1)


def largest_deviation_over_d1(Fr1: float) -> float:
    """Largest standard deviation of the surface over d1, eq. 4; NaN for Fr1 < 1. Source there: Murzyn and Chanson (2009)."""
    return 0.116 * (Fr1 - 1) ** 1.235 if Fr1 >= 1 else math.nan


def surface_strouhal(Fr1: float) -> float:
    """Strouhal number f d1 / v1 of the surface's fluctuations, eq. 5, for 2.4 < Fr1 < 6.5. Source there: Chachereau and Chanson (2011)."""
    return 0.143 * math.exp(-0.27 * Fr1)


def agreement_A(depth: np.ndarray, theory: float) -> float:
    """A = sqrt(sum d^2 / sum d_theory^2), eq. 19; 1 is agreement. depth: (N,) [L]; NaN for N = 0."""
    return math.sqrt((depth**2).sum() / (len(depth) * theory**2)) if len(depth) else math.nan


def agreement_P(depth: np.ndarray, theory: float) -> float:
    """P = sqrt(sum (d - d_theory)^2 / sum d_theory^2), eq. 20; 0 is agreement. depth: (N,) [L]; NaN for N = 0."""
    return agreement_A(depth - theory, theory)


@dataclass(frozen=True)
class PublishedRow:
    """A row of published values to print beside ours. `case`: "d1/4", compared with the recipe's case or the title of the run."""

    case: str = key("text", required=True)
    interval: tuple[float, float] = key("range", (0.0, 0.0), required=True, example=INTERVAL)
    A: float = key("number", 0.0, required=True)
    P: float = key("number", 0.0, required=True)


@dataclass(frozen=True)
class JumpRecipe:
    """Depth behind a hydraulic jump against Belanger's conjugate depth.

    `x`, `z`, `bed`: where depth is taken [L]; `v1`, `d1`, `g`: inflow; `intervals`: over which A and P are taken [T]; `toe_range`: x
    between which the toe is looked for [L]; `toe_threshold`, `front_threshold`: depths in d1; `front_x`: where the wave is timed [L].
    """

    x: float = key("number", 0.0, required=True)
    z: float = key("number", 0.0)
    bed: float = key("number", 0.0)
    v1: float = key("positive", 0.0, required=True)
    d1: float = key("positive", 0.0, required=True)
    g: float = key("positive", 9.81)
    intervals: list[tuple[float, float]] = field(default_factory=list)
    published: list[PublishedRow] = field(default_factory=list)
    toe_range: tuple[float, float] | None = None
    toe_threshold: float = 1.5
    front_x: float | None = None
    front_threshold: float = 1.3

    @property
    def theory(self) -> float:
        return belanger_depth(self.v1, self.d1, self.g)


@dataclass
class IntervalResult:
    """`states`: in the interval, 0 where the results do not reach it; `complete`: the results cover the whole interval; `published`: of
    that interval and of this case, of all cases if the case is unknown."""

    interval: tuple[float, float]
    states: int
    complete: bool
    A: float
    P: float
    mean_depth: float
    published: list[PublishedRow] = field(default_factory=list)


@dataclass
class JumpResult:
    """What was measured at each state, all (states,): `t` [T]; `depth` at the recipe's x [L]; `toe`: most upstream x deeper than its
    threshold, NaN: none, or None where it was not asked for; `front`: depth where the wave's arrival is timed, or None. `turn`: when and
    where the toe stood furthest downstream, the jump has reached the weir and turns back."""

    t: np.ndarray
    depth: np.ndarray
    toe: np.ndarray | None
    front: np.ndarray | None
    case: str = ""
    intervals: list[IntervalResult] = field(default_factory=list)
    front_time: float | None = None
    turn: tuple[float, float] | None = None


def _simplified(text: str) -> str:
    return "".join(text.split()).lower()


def find_case(title: str, published: list[PublishedRow]) -> str:
    """The case that a title names: the published case whose name is in it, blanks and case of letters aside; a digit may not follow
    ("d1/1" is not in "d1/10"). "" if none."""
    text = _simplified(title)
    for row in published:
        name = _simplified(row.case)
        at = text.find(name) if name else -1
        while at >= 0:
            if not text[at + len(name) : at + len(name) + 1].isdigit():
                return row.case
            at = text.find(name, at + 1)
    return ""


def evaluate_jump(recipe: JumpRecipe, case: str, series: JumpResult) -> JumpResult:
    """Statistics of a measured series, put into it.

    States belong to an interval with a slack of a quarter of their spacing, because a state is written up to one time step early.
    """
    t = series.t
    series.case = case
    slack = slack_of(t)
    for start, end in recipe.intervals:
        depth = series.depth[(t >= start - slack) & (t <= end + slack)]
        complete = len(t) > 0 and t[-1] >= end - 6 * slack and t[0] <= start + 6 * slack
        A, P = agreement_A(depth, recipe.theory), agreement_P(depth, recipe.theory)
        same_case = [row for row in recipe.published if not case or _simplified(row.case) == _simplified(case)]
        published = [row for row in same_case if row.interval == (start, end)]
        mean = float(depth.mean()) if len(depth) else 0.0
        series.intervals.append(IntervalResult((start, end), len(depth), bool(complete), A, P, mean, published))
    if series.front is not None:
        passed = np.flatnonzero(series.front > recipe.front_threshold * recipe.d1)
        series.front_time = float(t[passed[0]]) if len(passed) else None
    if series.toe is not None and not np.isnan(series.toe).all():
        k = int(np.nanargmax(series.toe))
        series.turn = float(t[k]), float(series.toe[k])
    return series


def jump_text(recipe: JumpRecipe, result: JumpResult) -> str:
    """The table that users see, several lines."""
    t = result.t
    out = (
        f"Depth at x = {recipe.x:g} m against Belanger (eq. 1): d2 = {recipe.theory:.4f} m   (v1 = {recipe.v1:g} m/s, d1 = {recipe.d1:g} m, "
        f"Fr1 = {froude(recipe.v1, recipe.d1, recipe.g):.2f})\n"
        f"Case: {result.case or 'unknown'}; {len(t)} states from {t[0]:.3g} s to {t[-1]:.3g} s\n"
        f"  {'interval [s]':<18}{'states':>7}{'mean d2 [m]':>12}{'A':>9}{'P':>9}   {'published':<24}{'A':>9}{'P':>9}\n"
    )
    for one in result.intervals:
        name = f"{one.interval[0]:g} - {one.interval[1]:g}"
        line = f"  {name:<18}{one.states:>7}" + (f"{one.mean_depth:>12.4f}{one.A:>9.3f}{one.P:>9.3f}" if one.states else f"{'-':>12}{'-':>9}{'-':>9}")
        beside = [f"   {row.case:<24}{row.A:>9.3f}{row.P:>9.3f}" for row in one.published] or [""]
        out += "".join((line if k == 0 else " " * len(line)) + text + "\n" for k, text in enumerate(beside))
        if not one.complete:
            out += f"  {'':<18}the results {'cover only a part of' if one.states else 'do not reach'} this interval\n"
    if recipe.front_x is not None and result.front_time is not None:
        where = f"The first wave passes x = {recipe.front_x:g} m at t = {result.front_time:.3f} s"
        out += f"{where} (depth > {recipe.front_threshold:g} d1)\n"
    elif recipe.front_x is not None:
        out += f"The wave does not reach x = {recipe.front_x:g} m by t = {t[-1]:.3g} s\n"
    if result.toe is not None:
        out += _toe_text(recipe, t, result.toe)
    if result.turn is not None:
        out += f"The jump is furthest downstream at t = {result.turn[0]:.3f} s, toe at x = {result.turn[1]:.3f} m\n"
    return out


def _toe_text(recipe: JumpRecipe, t: np.ndarray, toe: np.ndarray) -> str:
    end = t[-1]
    step = math.ceil(end / 10) if end > 12 else 1 if end > 2 else end / 5
    times, places, k = "  toe at t [s]    ", "         x [m]    ", 1
    while step > 0 and k * step <= end * (1 + 1e-3):
        here = toe[np.argmin(np.abs(t - k * step))]
        times += f"{k * step:8.3g}"
        places += f"{'-':>8}" if math.isnan(here) else f"{here:8.3f}"
        k += 1
    return f"Toe of the jump (most upstream depth > {recipe.toe_threshold:g} d1)\n{times}\n{places}\n"
