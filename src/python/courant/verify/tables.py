"""The tables of the reports, free of any markup."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from .charts import verdict_counts
from .model import BoundCheck, CaseResult, RunResult, SuiteResult
from .text import integer, megabytes, number, percent, seconds


@dataclass
class Column:
    head: str
    numeric: bool = False


@dataclass
class Row:
    cells: list[str]
    bad: bool = False  # stands out


@dataclass
class Table:
    columns: list[Column] = field(default_factory=list)
    rows: list[Row] = field(default_factory=list)

    @classmethod
    def of(cls, words: Sequence[str], numbers: Sequence[str] = (), last: Sequence[str] = ()) -> Table:
        """Heads of columns of words, then of numbers, then of words again."""
        return cls([Column(head, numeric) for heads, numeric in ((words, False), (numbers, True), (last, False)) for head in heads])

    def add(self, *cells: str, bad: bool = False) -> None:
        self.rows.append(Row(list(cells), bad))

    def only_bad(self) -> Table:
        return Table(self.columns, [row for row in self.rows if row.bad])


def _amounts(check: BoundCheck) -> tuple[str, str]:
    """Bound and what was measured; of a missed bound with so many digits that they differ."""
    if not check.what.startswith("error") and "at most" not in check.what and "at least" not in check.what:
        return "", ""
    as_text = percent if check.what.startswith("error") else number
    for digits in range(2 if as_text is percent else 3, 8):
        bound, measured = as_text(check.bound, digits), as_text(check.measured, digits)
        if check.met or bound != measured:
            break
    return bound, measured


def check_text(check: BoundCheck) -> str:
    """ "cubic, wave speed: error at most 1 %, measured 3.2 %"."""
    place = ", ".join(filter(None, (check.setting, check.observation)))
    text = (f"{place}: " if place else "") + check.what
    bound, measured = _amounts(check)
    return f"{text} {bound}, measured {measured}" if bound else f"{text}: {'yes' if check.met else 'no'}"


def checks_table(case: CaseResult) -> Table:
    """What is bounded, what was measured, and whether that is within the bound."""
    table = Table.of(("setting", "of", "required"), ("bound", "measured"), ("met",))
    for c in case.checks:
        table.add(c.setting or "all", c.observation, c.what, *_amounts(c), "yes" if c.met else "MISSED", bad=not c.met)
    return table


def overview_table(result: SuiteResult) -> Table:
    """One row for each case: title, runs, CPU time, bounds met of all. The first column is the title."""
    table = Table.of(("case", "verdict"), ("bounds met", "runs", "CPU time"))
    for case in result.cases:
        bounds = f"{len(case.checks) - case.missed} of {len(case.checks)}" if case.checks else "none stated"
        word = ("MISSED" if case.missed else "met") if case.checks else ""
        word = "; ".join(filter(None, (word, verdict_counts(case) if case.definition.stability else "")))
        cpu = sum(run.cpu_seconds for run in case.runs)
        table.add(case.title, word, bounds, str(len(case.runs)), seconds(cpu), bad=case.missed > 0)
    return table


def _end_of(run: RunResult) -> str:
    if run.exit_code == 0:
        return "as planned (earlier call)" if run.reused else "as planned"
    return f"exit code {run.exit_code}" + (f", {run.termination}" if run.termination else "") + (f": {run.reason}" if run.reason else "")


def runs_table(case: CaseResult, brief: bool = False) -> Table:
    """All runs of a case: size, cost and what was observed in each. Columns that would be empty are left out. `brief`: for a terminal."""
    d = case.definition
    table = Table(rows=[Row([], not run.as_required or (not d.stability and run.exit_code != 0)) for run in case.runs])

    def column(head: str, cell: Callable[[RunResult], str], numeric: bool = True) -> None:
        cells = [cell(run) for run in case.runs]
        if any(cells):
            table.columns.append(Column(head, numeric))
            for row, text in zip(table.rows, cells, strict=True):
                row.cells.append(text)

    column("setting", lambda r: r.setting, False)
    column(d.resolution or "resolution", lambda r: r.resolution)
    if d.stability:
        column("verdict", lambda r: r.verdict.name + ("" if r.as_required else ", not allowed here"), False)
    column("particles", lambda r: integer(r.particles) if r.particles > 0 else "")
    column("steps", lambda r: integer(r.steps) if r.steps > 0 else "")
    column("CPU time [s]", lambda r: number(r.cpu_seconds, 3))
    if not brief:
        column("wall time [s]", lambda r: number(r.wall_seconds, 3))
        column("CPU ns per particle-step", lambda r: number(1e9 * r.cpu_seconds / r.particle_steps, 3) if r.particle_steps > 0 else "")
    column("memory [MB]", lambda r: megabytes(r.peak_memory_bytes) if r.peak_memory_bytes > 0 else "")
    for k in range(len(d.observations)):
        _add_observation(case, k, column, brief)
    if brief:
        return table
    column("limits exceeded", lambda r: "; ".join(r.exceeded), False)
    if any(run.exit_code != 0 or run.reused for run in case.runs):
        column("end", _end_of, False)
    return table


def _add_observation(case: CaseResult, k: int, column: Callable[..., None], brief: bool) -> None:
    o = case.definition.observations[k]
    unit = f" [{o.unit}]" if o.unit else ""
    last = {run.setting: id(run) for run in case.runs}  # beside it stands the order, which belongs to all of a setting

    def part(run: RunResult, name: str) -> str:
        value = getattr(run.observed[k], name) if k < len(run.observed) else None
        return "" if value is None else number(value, 5)

    def error(run: RunResult) -> str:
        value = run.error_of(k)
        return percent(value) if value is not None else "not found" if k < len(run.observed) and not run.observed[k].found else ""

    def order(run: RunResult) -> str:
        value = case.order_of(run.setting, o.name) if last[run.setting] == id(run) else None
        return "" if value is None else f"{value:.2f}"

    label = o.name if brief else o.label
    column(label + unit, lambda r: part(r, "value"))
    if not brief:
        column(f"{label}: reference{unit}", lambda r: part(r, "reference"))
    column(f"{label}: error", error)
    column(f"{label}: order", order)
