"""Observations against their references."""
from __future__ import annotations

import math

import numpy as np

from ..diagnostics import Diagnostics
from ..expressions import ExpressionFault, Formula, constant_value
from .model import Curve, Observation, Observed, Reference, Variables
from .observe import Measured, Window
from .reference import read_table
from .registry import norm
from .series import NoValue, Series, take_number

POINTS_OF_REPORT = 400


class NotComparable(Exception):
    """There is no error; the text states why."""


def _constant(text: str, variables: Variables) -> float:
    try:
        return constant_value(text, variables)
    except ExpressionFault as fault:
        raise NotComparable(fault.message) from None


def scaled_table(reference: Reference, variables: Variables) -> Series:
    """Rows of the table in the units of the observation."""
    faults = Diagnostics()
    if reference.csv is None:
        raise NotComparable("there is no table")
    table = read_table(reference.csv, reference.csv_x, reference.csv_y, faults)
    if not faults.ok:
        raise NotComparable(faults.all[0].text())
    scale_x, scale_y, offset_x, offset_y = (
        _constant(text, variables) for text in (reference.scale_x, reference.scale_y, reference.offset_x, reference.offset_y))
    if scale_x == 0:
        raise NotComparable("scale_x is 0")
    step = -1 if scale_x < 0 else 1
    return Series((scale_x * table.x + offset_x)[::step], (scale_y * table.y + offset_y)[::step])


def merged(series: Series) -> Series:
    """Points at the same location, as particles of a row have them, become their mean."""
    slack = 1e-6 * (series.x[-1] - series.x[0]) if len(series) > 1 else 0.0
    ends: list[int] = []
    at = 0
    while at < len(series):
        at = int(np.searchsorted(series.x, series.x[at] + slack, side="right"))
        ends.append(at)
    begins = np.array([0, *ends[:-1]], dtype=int)
    if not ends:
        return Series()
    counts = np.array(ends) - begins
    return Series(np.add.reduceat(series.x, begins) / counts, np.add.reduceat(series.y, begins) / counts)


def aligned(series: Series, reference: Series, row: int) -> Series:
    """The curve shifted so that it first reaches the y of a row of the reference, counted from 1, at its x."""
    if row > len(reference):
        raise NotComparable(f"'align': the reference has no row {row}")
    level = reference.y[row - 1]
    a, b = series.y[:-1] - level, series.y[1:] - level
    passes = np.flatnonzero((a * b <= 0) & (a != b))
    if len(passes) == 0:
        raise NotComparable(f"the curve never reaches {level:.6g}, row {row} of the reference")
    i = passes[0]
    x = series.x[i] + (series.x[i + 1] - series.x[i]) * a[i] / (a[i] - b[i])
    return Series(series.x + (reference.x[row - 1] - x), series.y)


def _scale_of(o: Observation, variables: Variables, otherwise: float) -> float:
    """What the error is divided by: the scale of the suite, or `otherwise`."""
    scale = abs(_constant(o.scale, variables) if o.scale else otherwise)
    if scale == 0:
        raise NotComparable("'scale' is 0" if o.scale else "the reference is 0: give a 'scale' for its error")
    return scale


def _formula(o: Observation, variables: Variables) -> Formula:
    formula = Formula(o.reference.formula, ["t"], variables)
    if not formula.ok:
        raise NotComparable(formula.error)
    return formula


def _show(out: Observed, reference: Series) -> None:
    out.curve.reference_x, out.curve.reference_y = reference.x, reference.y


def _against_formula(o: Observation, m: Measured, variables: Variables, out: Observed) -> tuple[np.ndarray, np.ndarray]:
    """Values of the observation and of the reference at the same places."""
    reference = m.formula
    if reference is None:
        reference = _formula(o, variables).over({"t": m.series.x}, len(m.series))
    bad = np.flatnonzero(~np.isfinite(reference))
    if len(bad):
        raise NotComparable(f"the reference is not finite at {m.series.x[bad[0]]:.6g}")
    _show(out, Series(m.series.x, reference).thinned(POINTS_OF_REPORT))
    return m.series.y, reference


def _against_curve(series: Series, reference: Series, out: Observed) -> tuple[np.ndarray, np.ndarray]:
    """Values of the observation and of the reference at the locations that both have."""
    values = reference.values_at(series.x)
    known = ~np.isnan(values)
    shown = reference.window(series.x[0], series.x[-1]).thinned(POINTS_OF_REPORT)
    _show(out, shown if len(shown) else reference.thinned(POINTS_OF_REPORT))
    if not np.any(known):
        raise NotComparable(f"the reference, from {reference.x[0]:.6g} to {reference.x[-1]:.6g}, and the observation, from "
                            f"{series.x[0]:.6g} to {series.x[-1]:.6g}, have no place in common")
    return series.y[known], values[known]


def _compare_curve(o: Observation, m: Measured, variables: Variables, finest: Measured | None, out: Observed) -> None:
    if o.reference.kind == "formula":
        y, reference = _against_formula(o, m, variables, out)
    elif o.reference.kind == "csv":
        table = scaled_table(o.reference, variables)
        series = aligned(m.series, table, o.align) if o.align > 0 else m.series
        shown = series.thinned(POINTS_OF_REPORT)
        out.curve.x, out.curve.y = shown.x, shown.y
        y, reference = _against_curve(series, table, out)
    else:
        y, reference = _against_curve(m.series, merged(finest.series if finest else m.series), out)
    size = norm[o.norm]
    out.error = size(y - reference) / _scale_of(o, variables, size(reference))


def _number_of_table(o: Observation, m: Measured, variables: Variables) -> float:
    table, window = scaled_table(o.reference, variables), Window.of(o, variables)
    if o.take in ("final", "at"):
        x = float(m.series.x[-1]) if o.take == "final" or window.at is None else window.at
        value = table.value_at(x)
        if value is None:
            raise NotComparable(f"the reference does not reach {x:.6g}")
        return value
    if o.take == "mean" and len(table) > 1:  # its points need not be even
        value = table.mean_between(window.start, window.end)
        if math.isnan(value):
            raise NotComparable("the reference does not reach there")
        return value
    try:
        return take_number(table.window(window.start, window.end), o.take, window.at)
    except NoValue as fault:
        raise NotComparable(f"reference: {fault}") from None


def _compare_number(o: Observation, m: Measured, variables: Variables, finest: Measured | None, out: Observed) -> None:
    if o.reference.kind == "formula":
        at = Window.of(o, variables).at if o.take == "at" else None
        out.reference = _formula(o, variables)(float(m.series.x[-1]) if at is None else at)
        if not math.isfinite(out.reference):
            out.reference = None
            raise NotComparable("the reference is not finite")
    elif o.reference.kind == "csv":
        out.reference = _number_of_table(o, m, variables)
    else:
        out.reference = finest.value if finest else None
    if out.reference is None or m.value is None:
        return
    out.error = abs(m.value - out.reference) / _scale_of(o, variables, out.reference)


def compare_observation(o: Observation, m: Measured, variables: Variables, finest: Measured | None) -> Observed:
    """Compares with the reference. `finest`: the same observation in the finest run of the setting, if this is another run."""
    out = Observed(o.name, m.found, m.why)
    if not m.found:
        return out
    shown = m.series.thinned(POINTS_OF_REPORT)
    out.curve, out.value = Curve(shown.x, shown.y), m.value
    if o.reference.kind == "none" or (o.reference.kind == "finest" and finest is None):
        return out
    if o.reference.kind == "finest" and finest and not finest.found:
        out.why = f"the finest run has no value: {finest.why}"
        return out
    try:
        (_compare_curve if o.take == "curve" else _compare_number)(o, m, variables, finest, out)
    except NotComparable as fault:
        out.why = str(fault)
    return out
