"""What got better or worse since an earlier results.csv."""
from __future__ import annotations

import csv
import io
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

from ..diagnostics import Diagnostics
from ..yaml_map import as_number
from .model import SuiteResult, Verdict
from .result_files import results_csv

_LEAST_CHANGE = 0.05  # of an error, relative
_LEAST_COST = 0.3  # of CPU time per particle-step, relative
_SHORTEST = 0.2  # CPU time of a run that says something of its cost [s]

Row = defaultdict[str, str]  # by the names of the head
csv.field_size_limit(1 << 30)  # a reason may be long


@dataclass
class Change:
    text: str
    worse: bool = False


@dataclass
class Comparison:
    earlier: str = ""  # what it is compared with; blank: nothing
    lines: list[Change] = field(default_factory=list)
    compared: int = 0  # rows that are in both
    regressed: bool = False  # a check or verdict that was met is now missed


def _rows(text: str) -> list[Row]:
    rows = list(csv.reader(io.StringIO(text)))
    return [defaultdict(str, zip(rows[0], row, strict=True)) for row in rows[1:] if len(row) == len(rows[0])] if rows else []


def _name(row: Row, with_observation: bool = True) -> str:
    name = f"{row['case']}: {row['setting']}" + (f", {row['resolution']}" if row["resolution"] else "")
    return name + (f", {row['observation']}" if with_observation and row["observation"] else "")


def _key(row: Row) -> tuple[str, ...]:
    return tuple(row[name] for name in ("case", "setting", "resolution", "observation"))


def _cost(row: Row) -> float:
    """ns of CPU time per particle and step; 0 if the run was too short to tell."""
    seconds, steps = as_number(row["cpu_seconds"]) or 0.0, as_number(row["particle_steps"]) or 0.0
    return 1e9 * seconds / steps if seconds >= _SHORTEST and steps > 0 else 0.0


def _rank(verdict: str) -> int:
    return Verdict[verdict] if verdict in Verdict.__members__ else -1


class _Comparer:
    def __init__(self, earlier: str) -> None:
        self.out = Comparison(earlier)
        self.runs: set[str] = set()

    def tell(self, text: str, worse: bool) -> None:
        self.out.lines.append(Change(text, worse))

    def compare(self, before: Row, now: Row) -> None:
        self.out.compared += 1
        run, name = _name(now, False), _name(now)
        if run not in self.runs:
            self.runs.add(run)
            self.compare_runs(run, before, now)
        if before["check"] != now["check"] and before["check"] and now["check"] and before["as_required"] == now["as_required"]:
            self.tell(f"{name}: check {now['check']}, was {before['check']}", now["check"] == "missed")
        if (before["check"], now["check"]) == ("met", "missed"):
            self.out.regressed = True
        old, error = as_number(before["error"]), as_number(now["error"])
        if old is None and error is not None:
            self.tell(f"{name}: error {error:.3g}, there was none", False)
        elif error is None and old is not None:
            self.tell(f"{name}: no error any more ({now['why']}), was {old:.3g}", True)
        elif old is not None and error is not None and abs(error - old) > _LEAST_CHANGE * old + 1e-12:
            self.tell(f"{name}: error {error:.4g}, was {old:.4g}", error > old)

    def compare_runs(self, run: str, before: Row, now: Row) -> None:
        was, is_ = before["as_required"] == "yes", now["as_required"] == "yes"
        if before["verdict"] != now["verdict"]:
            reason = f": {now['reason']}" if now["reason"] else ""
            self.tell(f"{run}: {now['verdict']}, was {before['verdict']}{reason}", _rank(now["verdict"]) > _rank(before["verdict"]))
        elif was != is_:
            self.tell(f"{run}: {now['verdict']}, which is {'now' if is_ else 'no longer'} allowed", not is_)
        if was and not is_:
            self.out.regressed = True
        old, cost = _cost(before), _cost(now)
        if old > 0 and cost > 0 and abs(cost - old) > _LEAST_COST * old:
            self.tell(f"{run}: {cost:.0f} ns of CPU time per particle and step, was {old:.0f}", cost > old)


def compare_with(result: SuiteResult, earlier: Path, diagnostics: Diagnostics) -> Comparison | None:
    """Rows are the same where case, setting, resolution and observation are. Told are errors that changed by more than 5 % and 1e-12, CPU time per
    particle-step that changed by more than 30 % where both runs took 0.2 s or more, verdicts, checks, and rows that are new or gone. A file that
    cannot be read, or is no results.csv, goes to `diagnostics`; then there is None."""
    try:
        before = _rows(earlier.read_text("utf-8", "replace"))
    except (OSError, csv.Error):
        before = []
    now = _rows(results_csv(result))
    if not before or not {"as_required", "observation"} <= before[0].keys():
        diagnostics.error(earlier, "not a results.csv of an earlier `courant verify`, or an empty one")
        return None
    comparer = _Comparer(str(earlier))
    old = {_key(row): row for row in before}
    for row in now:
        if _key(row) in old:
            comparer.compare(old[_key(row)], row)
        else:
            comparer.tell(f"{_name(row)}: new", False)
    cases, seen = {row["case"] for row in now}, {_key(row) for row in now}
    for row in before:  # cases that were not asked for this time are not gone
        if row["case"] in cases and _key(row) not in seen:
            comparer.tell(f"{_name(row)}: no longer there", False)
    return comparer.out
