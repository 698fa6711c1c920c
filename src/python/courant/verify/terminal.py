"""What a suite came to, as text for the terminal."""
from __future__ import annotations

from .charts import LETTERS
from .model import CaseResult, SuiteResult, Verdict
from .tables import Table, check_text, runs_table


def _aligned(table: Table) -> str:
    """Columns as wide as their longest entry, numbers flush right."""
    rows = [[column.head for column in table.columns], *(row.cells for row in table.rows)]
    widths = [max(map(len, cells)) for cells in zip(*rows, strict=True)]
    lines = (zip(row, widths, table.columns, strict=True) for row in rows)
    text = ("".join("  " + (cell.rjust if column.numeric else cell.ljust)(width) for cell, width, column in line) for line in lines)
    return "".join(line.rstrip(" ") + "\n" for line in text).replace("\u00a0", " ")


def _map_text(case: CaseResult) -> str:
    """A letter for every verdict, the first swept parameter across, the second downwards."""
    sweep = case.definition.stability.sweep if case.definition.stability else []
    if len(sweep) != 2 or len(case.definition.settings) > 1:
        return ""
    (across, columns), (down, lines) = sweep
    if len(case.runs) != len(columns) * len(lines):
        return ""
    table = Table.of((f"{down} \\ {across}", *columns))
    for j, value in enumerate(lines):
        table.add(value, *(LETTERS[case.runs[i * len(lines) + j].verdict] for i in range(len(columns))))
    return "  map: " + ", ".join(f"{LETTERS[verdict]} {verdict.name}" for verdict in Verdict) + "\n" + _aligned(table)


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


def case_table(case: CaseResult) -> str:
    """A table of the runs of a case; of a stability case also the map of verdicts."""
    return f"{case.definition.name}: {case.definition.title}\n" + _aligned(runs_table(case, brief=True)) + _map_text(case) + _remarks(case)


def checks_text(result: SuiteResult) -> str:
    """The checks that were missed, and how many were met."""
    checks = [(case.definition, check) for case in result.cases for check in case.checks]
    if not checks:
        return "The suite states no bounds.\n"
    missed = [f"  MISSED  {d.name}: {check_text(check).removesuffix(': no')}{' is required' if d.stability else ''}\n" for d, check in checks if not check.met]
    return "".join(missed).replace("\u00a0", " ") + f"{len(checks) - len(missed)} of {len(checks)} checks met, {len(missed)} missed\n"
