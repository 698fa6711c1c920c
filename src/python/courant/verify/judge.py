"""Orders of convergence, bounds and verdicts of a case."""
from __future__ import annotations

import math

import numpy as np

from ..expressions import ExpressionFault, Formula, constant_value
from .model import BoundCheck, Case, MeasuredOrder, RunResult, Stability, Variables, Verdict
from .names import OUTCOMES
from .series import slope_of


def measured_orders(case: Case, runs: list[RunResult]) -> list[MeasuredOrder]:
    """Slopes of log(error) over log(size), for every setting and observation with a reference."""
    out: list[MeasuredOrder] = []
    if not case.size or case.stability:
        return out
    for setting in case.settings:
        of_setting = [run for run in runs if run.setting == setting.name]
        for k, o in enumerate(case.observations):
            if o.reference.kind == "none":
                continue
            points = [(run.size, error) for run in of_setting if (error := run.observed[k].error) and error > 0]
            size, error = np.log(np.array(points).reshape(-1, 2)).T
            out.append(MeasuredOrder(setting.name, o.name, slope_of(size, error)))
    return out


def check_bounds(case: Case, runs: list[RunResult], orders: list[MeasuredOrder]) -> list[BoundCheck]:
    """Bounds of an accuracy case: errors and orders, and that every run came to its end with a scale for its errors. A bound without an error to
    compare is missed."""
    out = []
    for run in runs:
        if run.verdict != Verdict.stable:
            what = f"{case.resolution} = {run.resolution} runs to its end" if run.resolution else "runs to its end"
            out.append(BoundCheck(run.setting, "", what, 1, 0, False))
    for setting in case.settings:
        of_setting = [run for run in runs if run.setting == setting.name]
        for k, o in enumerate(case.observations):
            for run in of_setting:
                observed = run.observed[k]
                if run.exit_code == 0 and observed.found and observed.error is None and observed.why:
                    out.append(BoundCheck(setting.name, o.name, f"an error to compare: {observed.why}", 0, math.nan, False))
            if not o.counts_for(setting.name):
                continue
            if o.bound is not None:  # the finest run is no judge of itself
                found = of_setting[-2 if o.reference.kind == "finest" else -1].observed[k].error
                error = math.nan if found is None else found
                out.append(BoundCheck(setting.name, o.name, "error at most", o.bound, error, error <= o.bound))
            if o.least_order is not None:
                known = [m.order for m in orders if (m.setting, m.observation) == (setting.name, o.name)]
                order = known[0] if known and known[0] is not None else math.nan
                out.append(BoundCheck(setting.name, o.name, "order at least", o.least_order, order, order >= o.least_order))
    return out


def _value(text: str, names: list[str], values: list[float], variables: Variables) -> float:
    formula = Formula(text, names, variables)
    return formula(*values) if formula.ok else math.nan


def _take_limits(stability: Stability, variables: Variables, run: RunResult) -> None:
    """Limits that a run exceeds make it degraded."""
    numbers = run.numbers
    spacing = variables.get("dx", 0.0)
    penetration = numbers.penetration / spacing if spacing > 0 else numbers.penetration
    names = [*OUTCOMES, *(o.name for o in run.observed)]
    values = [numbers.residual, numbers.error, numbers.ratio, numbers.leaked, penetration, numbers.steps,
              *(o.value if o.found and o.value is not None else math.nan for o in run.observed)]
    for limit in stability.limits:
        if run.verdict > Verdict.degraded:
            return
        value, bound = (_value(text, names, values, variables) for text in (limit.value, limit.at_most))
        if value <= bound:
            continue
        why = "".join(f" ({o.name}: {o.why})" for o in run.observed if not o.found and o.name in limit.value)
        run.exceeded.append(f"{limit.name} = {value:.4g} > {bound:.4g}{why}")
        run.verdict = Verdict.degraded


def judge_stability(stability: Stability, variables: Variables, run: RunResult) -> BoundCheck:
    """Completes the verdict of a run of a stability case by its limits, and says whether it is as required. Returns the check of that."""
    _take_limits(stability, variables, run)
    try:
        must_stop = constant_value(stability.must_stop, variables) > 0
        must_be_stable = constant_value(stability.must_be_stable, variables) > 0 and not must_stop
    except ExpressionFault as fault:
        run.as_required = False
        return BoundCheck(run.setting, "", f"what is required: {fault.message}", 1, 0, False)
    run.as_required = run.verdict != Verdict.broken
    if must_be_stable:
        run.as_required = run.verdict == Verdict.stable
    if must_stop:
        run.as_required = run.verdict in (Verdict.stopped, Verdict.refused)
    what = "stopped or refused" if must_stop else "stable" if must_be_stable else "anything but broken"
    return BoundCheck(run.setting, "", what, 1, float(run.as_required), run.as_required)
