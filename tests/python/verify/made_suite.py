"""Results of a suite that never ran: numbers from formulas, with everything in them that reports have to cope with."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from courant.verify.model import (
    BoundCheck,
    Case,
    CaseResult,
    Curve,
    MeasuredOrder,
    Observation,
    Observed,
    Picture,
    Reference,
    RunResult,
    Setting,
    Stability,
    Suite,
    SuiteResult,
    Verdict,
)

PICTURE = bytes.fromhex(  # a PNG file of 8 x 4 pixels
    "89504e470d0a1a0a0000000d49484452000000080000000408020000003cafe9a7000000494944415478da0dc9310100410803"
    "c188410c069041bf36ce0602108399fc4f3b120a94a8d1438b0e194954504935f5a8a58e32f5c704934c338f59e618337f3870"
    "e2c60f2f3e6cfc0192632ed5249431da0000000049454e44ae426082"
)


def observation(name: str, kind: str) -> Observation:
    return Observation(name, reference=Reference(kind))


def run(setting: str, resolution: str, cpu: float) -> RunResult:
    particles = int(400 * (1 + cpu))
    return RunResult(
        setting,
        resolution,
        cpu_seconds=cpu,
        wall_seconds=0.6 * cpu,
        particles=particles,
        steps=1200,
        particle_steps=particles * 1200,
        peak_memory_bytes=48_000_000,
        termination="normal",
    )


def error(name: str, value: float) -> Observed:
    return Observed(name, True, error=value)


def stopped(r: RunResult, observations: int) -> RunResult:
    """A run that stopped before there was anything to observe."""
    r.exit_code, r.termination, r.reason = 2, "error", "runaway energy at t = 0.012 in part 2 <water>"
    r.observed = [Observed(why="the run stopped at t = 0.012") for _ in range(observations)]
    return r


def wave() -> CaseResult:
    """Three settings, four resolutions, a number and a curve; one bound is missed."""
    period, height = observation("period", "formula"), observation("height", "csv")
    period.title, period.unit, period.take, period.bound, period.least_order = "period", "s", "period", 0.01, 1.0
    period.reference = Reference("formula", "2*pi/sqrt(g*k*tanh(k*d))", source="Lamb 1932, art. 228")
    height.title, height.unit, height.bound, height.reference.csv = "height at the wall", "m", 0.001, Path("data/height.csv")
    d = Case(
        "wave",
        'Standing wave <in> a "tank" & more',
        resolution="n",
        resolutions=["10", "20", "40", "80"],
        observations=[period, height],
        about="A wave of small amplitude: period and decay.\n\nThe period follows from the dispersion relation; what is lost to "
        "viscosity shows in the decay. <script>document.title = 'injected'</script>",
    )
    c = CaseResult(d, picture=Picture(PICTURE, "speed at t = 1 s", "0 m/s", "0.5 m/s"))
    t = 0.02 * np.arange(200)
    for s, (name, pace, order) in enumerate(
        (("cubic, h/dx = 1.2", 0.1, 1.0), ("Wendland C2, h/dx = 1.6", 0.21, 2.0), ("cubic, c0 halved", 0.05, 0.61))
    ):
        d.settings.append(Setting(name))
        for n in (10.0, 20.0, 40.0, 80.0):
            e = (0.5 / n, 3.2 / n**2, 0.01 + 0.4 / n)[s]
            curve = Curve(t, 0.1 * np.exp(-e * t) * np.cos(4.95 * t * (1 - e)), t[::8], 0.1 * np.cos(4.95 * t[::8]))
            one = run(name, f"{n:.0f}", (n / 10) ** 3 * pace)
            one.observed = [Observed("period", True, "", 1.27 * (1 + e), 1.27, e), Observed("height", True, error=3 * e, curve=curve)]
            c.runs.append(one)
        c.orders += [MeasuredOrder(name, "period", order), MeasuredOrder(name, "height", None)]
        c.checks += [
            BoundCheck(name, "period", "error at most", 0.01, e, s != 2),
            BoundCheck(name, "period", "order at least", 1, order, s != 2),
        ]
    return c


def strange() -> CaseResult:
    """Errors that have no location on a logarithmic axis, a run that stopped, and more settings than colours."""
    c = CaseResult(Case("strange", "Strange errors", resolution="n", observations=[observation("mass", "formula")]))
    c.definition.observations[0].bound = 0.1
    for i, e in enumerate((0.0, math.nan, math.inf, 0.02, 0.05, 0.004, 0.3, 0.15, 0.06, 0.011)):
        c.runs.append(run(f"setting {i + 1}", "20", 0.3 * (i + 1)))
        c.runs[-1].observed = [error("mass", e)]
    c.runs += [stopped(run("setting 11", "20", 0.01), 1), run("without time", "20", 0.0)]
    c.runs[-1].observed = [error("mass", 0.01)]
    return c


def one_run() -> CaseResult:
    c = CaseResult(Case("one", "One run", observations=[observation("mass", "formula")]), [run("", "", 1.5)])
    c.runs[0].observed = [error("mass", 0.012)]
    return c


def no_reference() -> CaseResult:
    c = one_run()
    c.definition.name, c.definition.title, c.definition.observations = "free", "No reference", [observation("kinetic", "none")]
    c.runs[0].observed = [Observed("kinetic", True, curve=Curve(np.arange(4.0), np.array([0, 1, math.nan, 2])))]
    return c


def all_stopped() -> CaseResult:
    c = one_run()
    c.definition.name, c.definition.title = "stopped", "All runs stopped"
    c.runs = [stopped(run("a", "10", 1.0), 1), stopped(run("b", "10", 2.0), 1)]
    c.checks = [BoundCheck("a", "mass", "error at most", 0.1, math.nan, False)]
    return c


def stability(columns: int, rows: int) -> CaseResult:
    """Verdicts over one or two swept parameters."""
    sweep = [("tssfac", [f"0.{i + 1}" for i in range(columns)])] + ([("scale", [f"1e{i - 3}" for i in range(rows)])] if rows else [])
    c = CaseResult(Case(f"map{columns}x{rows}", f"Where it breaks, {columns} by {rows}", stability=Stability(sweep)))
    for k in range(columns * max(rows, 1)):
        i, j = k % columns, k // columns
        r = run(f"tssfac = {sweep[0][1][i]}" + (f", scale = {sweep[1][1][j]}" if rows else ""), "", 0.1)
        r.parameters = {"tssfac": sweep[0][1][i], **({"scale": sweep[1][1][j]} if rows else {})}
        badness = 10 * (i + j) // (columns + rows)
        r.verdict = Verdict(sum(badness >= limit for limit in (4, 6, 8, 9)))
        r.as_required = r.verdict != Verdict.broken
        r.exceeded = ["growth 0.03 > 0.01"] if r.verdict == Verdict.degraded else []
        r = stopped(r, 0) if r.verdict == Verdict.stopped else r
        r.observed = [Observed("ratio", True, value=1 + 0.01 * k)] if r.verdict <= Verdict.degraded else []
        c.runs.append(r)
        c.checks.append(BoundCheck(r.setting, "", "verdict allowed", 1, float(r.as_required), r.as_required))
    return c


def suite(*cases: CaseResult) -> SuiteResult:
    return SuiteResult(
        Suite(Path("suites/made.yaml"), "Made <suite>", "Numbers from formulas."),
        "0.1.0 (release)",
        "a processor, 2 cores, Debian 12",
        "2026-01-02T03:04:05Z",
        754,
        2,
        list(cases),
    )


def whole_suite() -> SuiteResult:
    return suite(
        wave(), strange(), one_run(), no_reference(), all_stopped(), stability(13, 6), stability(12, 0), stability(5, 4), stability(10, 9)
    )
