"""Which runs are worth their time: pure functions of what was measured."""
from __future__ import annotations

import math
from dataclasses import dataclass

from .model import CaseResult, RunResult, Verdict
from .text import percent, seconds

_MOST_CHOICES = 6  # in words


@dataclass(frozen=True)
class CostPoint:
    """What a run costs and how wrong it is."""

    run: int  # index in CaseResult.runs
    cost: float  # CPU time [s]
    error: float  # [-]


def pareto_front(points: list[CostPoint]) -> list[CostPoint]:
    """The points that no other one beats: from the cheapest on, each with a smaller error than all cheaper ones. Points whose cost or error is not
    finite or is negative take no part. Of equal points the first one stays."""
    front: list[CostPoint] = []
    good = [p for p in points if all(math.isfinite(v) and v >= 0 for v in (p.cost, p.error))]
    for p in sorted(good, key=lambda p: (p.cost, p.error)):
        if not front or p.error < front[-1].error:
            front.append(p)
    return front


def _round_level(error: float) -> float:
    """The smallest of 1, 2, 5 times a power of ten that is not below `error`."""
    if error <= 0:
        return 0.0
    exponent = math.floor(math.log10(error))
    levels = (float(f"{digit}e{exponent}") for digit in (1, 2, 5))
    return next((level for level in levels if error <= level * (1 + 1e-9)), float(f"1e{exponent + 1}"))


def choices(front: list[CostPoint]) -> list[tuple[float, CostPoint]]:
    """Round error levels and the cheapest run that reaches each, cheapest first; runs that reach no smaller level than a cheaper one are left out.
    Level 0: no error at all."""
    out: list[tuple[float, CostPoint]] = []
    for p in front:
        level = _round_level(p.error)
        if not out or level < out[-1][0]:
            out.append((level, p))
    return out


def _ended_well(run: RunResult) -> bool:
    return run.exit_code == 0 and run.verdict <= Verdict.degraded


def cost_points(case: CaseResult, k: int) -> list[CostPoint]:
    """Runs that ended as they should and have an error of observation k, in the order of the runs. Where the finest run is the reference, a run
    without any error is that run itself, and takes no part."""
    observations = case.definition.observations
    by_finest = k < len(observations) and observations[k].reference.kind == "finest"
    found = ((i, run, run.error_of(k)) for i, run in enumerate(case.runs) if _ended_well(run))
    return [CostPoint(i, run.cpu_seconds, error) for i, run, error in found if error is not None and not (by_finest and error == 0)]


def cheapest_within_bounds(case: CaseResult) -> RunResult | None:
    """The cheapest run that meets the bounds of all observations that have one; None if no run does, or nothing is bounded."""
    bounds = [(k, o.bound) for k, o in enumerate(case.definition.observations) if o.bound is not None]
    within = [run for run in case.runs if _ended_well(run) and math.isfinite(run.cpu_seconds)
              and all((error := run.error_of(k)) is not None and error <= bound for k, bound in bounds)]
    return min(within, key=lambda run: run.cpu_seconds) if bounds and within else None


def recommendation(case: CaseResult, k: int) -> list[str]:
    """The choices in words, for a list of the cheapest runs for an error of: "at most 1 %: cubic at resolution 40, 3.1 s (error 0.8 %)." The time
    is CPU time. At most six, spread along the front. The last one tells the smallest error if it misses the bound of the observation."""
    every = choices(pareto_front(cost_points(case, k)))
    shown = min(len(every), _MOST_CHOICES)
    text = []
    for i in range(shown):
        level, point = every[i * (len(every) - 1) // (shown - 1) if shown > 1 else 0]
        what = f"at most {percent(level)}" if level > 0 else "zero"
        text.append(f"{what}: {case.runs[point.run].name}, {seconds(point.cost)} (error {percent(point.error)}).")
    bound = case.definition.observations[k].bound if k < len(case.definition.observations) else None
    if every and bound is not None and every[-1][1].error > bound:
        text.append(f"No run reaches the bound of {percent(bound)}; the smallest error is {percent(every[-1][1].error)}.")
    return text
