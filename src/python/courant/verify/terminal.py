"""What a suite came to, as text for the terminal."""
from __future__ import annotations

from .model import BoundCheck, CaseResult, SuiteResult, Verdict

_LETTERS = "SDXRB"  # of verdicts


def _aligned(rows: list[list[str]], left: int) -> str:
    """Columns as wide as their longest entry, the first `left` of them flush left."""
    widths = [max(len(row[k]) for row in rows if k < len(row)) for k in range(max(map(len, rows)))]
    lines = ("".join("  " + (cell.ljust if k < left else cell.rjust)(widths[k]) for k, cell in enumerate(row)) for row in rows)
    return "".join(line.rstrip(" ") + "\n" for line in lines)


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.4g}"


def _percent(error: float) -> str:
    if error == 0:
        return "0 %"
    return f"{100 * error:.3g} %" if 1e-4 <= error < 100 else f"{error:.1e}"


def _cpu(seconds: float) -> str:
    return f"{seconds:.2f}" if seconds < 100 else f"{seconds:.0f}"


def _accuracy_table(case: CaseResult) -> str:
    d = case.definition
    head = ["setting", *([d.resolution] if d.resolution else []), "particles", "steps", "cpu s", "memory"]
    for o in d.observations:
        if o.take != "curve":
            head.append(o.name + (f" [{o.unit}]" if o.unit else ""))
        if o.reference.kind != "none":
            head.append(f"{o.name}: error" if o.take == "curve" else "error")
            head += ["order"] if d.size else []
    rows = [head]
    for k, run in enumerate(case.runs):
        row = [run.setting, *([run.resolution] if d.resolution else []), str(run.particles), str(run.steps),
               _cpu(run.cpu_seconds), f"{run.peak_memory_bytes / 1e6:.0f} MB"]
        for o, observed in zip(d.observations, run.observed, strict=False):
            if o.take != "curve":
                row.append(_number(observed.value))
            if o.reference.kind != "none":
                row.append("-" if observed.error is None else _percent(observed.error))
                order = case.order_of(run.setting, o.name)
                row += [("-" if order is None else f"{order:.2f}") if case.ends_setting(k) else ""] if d.size else []
        rows.append(row)
    return _aligned(rows, 1)


def _stability_table(case: CaseResult) -> str:
    shown = [k for k, o in enumerate(case.definition.observations) if o.take != "curve"]
    rows = [["run", "verdict", "required", "particles", "steps", "cpu s", *(case.definition.observations[k].name for k in shown)]]
    for run in case.runs:
        rows.append([run.setting, run.verdict.name, "yes" if run.as_required else "NO", str(run.particles), str(run.steps),
                     _cpu(run.cpu_seconds), *(_number(run.observed[k].value) for k in shown if k < len(run.observed))])
    return _aligned(rows, 3)


def _map_text(case: CaseResult) -> str:
    """A letter for every verdict, the first swept parameter across, the second downwards."""
    sweep = case.definition.stability.sweep if case.definition.stability else []
    if len(sweep) != 2 or len(case.definition.settings) > 1:
        return ""
    (across, columns), (down, lines) = sweep
    if len(case.runs) != len(columns) * len(lines):
        return ""
    rows = [[f"{down} \\ {across}", *columns]]
    for j, value in enumerate(lines):
        rows.append([value, *(_LETTERS[case.runs[i * len(lines) + j].verdict] for i in range(len(columns)))])
    return "  map: S stable, D degraded, X stopped, R refused, B broken\n" + _aligned(rows, 1)


def _remarks(case: CaseResult) -> str:
    """What the numbers in the table do not say."""
    out = []
    for run in case.runs:
        name = f"  {run.setting}" + (f", {run.resolution}" if run.resolution else "") + ": "
        if run.verdict > Verdict.degraded:
            out.append(f"{name}{run.verdict.name}: {run.reason}\n")
        out += [f"{name}{exceeded}\n" for exceeded in run.exceeded]
        if run.verdict == Verdict.stable:
            out += [f"{name}{o.name}: {o.why}\n" for o in run.observed if o.why]
    return "".join(out)


def _check_text(case: CaseResult, check: BoundCheck) -> str:
    out = f"{case.definition.name}: {check.setting}" + (f", {check.observation}" if check.observation else "") + f": {check.what}"
    if check.what == "error at most":
        out += f" {_percent(check.bound)}: {_percent(check.measured)}"
    if check.what == "order at least":
        out += f" {check.bound:g}: {check.measured:.2f}"
    return out + (" is required" if case.definition.stability else "")


def case_table(case: CaseResult) -> str:
    """A table of the runs of a case; of a stability case also the map of verdicts."""
    table = _stability_table(case) + _map_text(case) if case.definition.stability else _accuracy_table(case)
    return f"{case.definition.name}: {case.definition.title}\n" + table + _remarks(case)


def checks_text(result: SuiteResult) -> str:
    """The checks that were missed, and how many were met."""
    checks = [(case, check) for case in result.cases for check in case.checks]
    if not checks:
        return "The suite states no bounds.\n"
    missed = [f"  MISSED  {_check_text(case, check)}\n" for case, check in checks if not check.met]
    return "".join(missed) + f"{len(checks) - len(missed)} of {len(checks)} checks met, {len(missed)} missed\n"
