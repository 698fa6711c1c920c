"""What a finished run left behind besides its results: how it ended, and for which deck and build."""
from __future__ import annotations

import math
import signal
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, TypeVar

import yaml

from ..files import CANNOT_WRITE, write_file
from .model import RunNumbers, RunResult, Verdict

_Loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
Value = TypeVar("Value", int, float, str, bool)


@dataclass
class RunRecord:
    """Content of record.yaml in the folder of a run. It is there only if the run has ended."""

    key: str = ""  # of deck, parameters and build; another key: the results are of something else
    scene: str = ""  # of scene, parameters and build: the same ones make the same deck
    exit_code: int = 0
    signal: int = 0  # that ended it; 0: none
    timed_out: bool = False
    time_limit: float = 0.0  # [s]
    wall_seconds: float = 0.0  # of the whole process
    cpu_seconds: float = 0.0
    peak_memory_bytes: int = 0


def _load(file: Path) -> dict[str, Any] | None:
    """The map in a file; None if it is not there or not whole, which is as good."""
    try:
        found = yaml.load(file.read_bytes(), _Loader)
    except (OSError, yaml.YAMLError, ValueError, RecursionError):  # ValueError: a date or number that there is not
        return None
    return found if isinstance(found, dict) else None


def _value(of: Any, key: str, otherwise: Value) -> Value:
    """The value of a key if it is of the kind of `otherwise`."""
    found = of.get(key) if isinstance(of, dict) else None
    kind = type(otherwise)
    if kind is str:
        return otherwise if found is None or isinstance(found, (dict, list)) else kind(found)
    if isinstance(found, bool) != (kind is bool) or isinstance(found, (dict, list)) or found is None:
        return otherwise
    try:
        return kind(found)  # also of 1e-3, which YAML 1.1 takes for a text
    except (TypeError, ValueError, OverflowError):
        return otherwise


def write_record(folder: Path, record: RunRecord) -> None:
    write_file(folder / "record.yaml", yaml.safe_dump(asdict(record), sort_keys=False))


def read_record(folder: Path) -> RunRecord | None:
    """The record in a folder; None if there is none or it cannot be understood."""
    found = _load(folder / "record.yaml")
    if found is None or not _value(found, "key", ""):
        return None
    out = RunRecord(exit_code=-1)
    for one in fields(RunRecord):
        setattr(out, one.name, _value(found, one.name, getattr(out, one.name)))
    return out


def _first_error_line(file: Path) -> str:
    """The first error in what the run said, else its first line."""
    try:
        lines = file.read_text("utf-8", "replace").splitlines()
    except OSError:
        return ""
    return next((line for line in lines if "error: " in line), next((line for line in lines if line), ""))


def _take_summary(summary: dict[str, Any], out: RunResult) -> None:
    for name in ("termination", "reason", "wall_seconds", "cpu_seconds", "particles", "steps", "particle_steps", "peak_memory_bytes"):
        setattr(out, name, _value(summary, name, getattr(out, name)))
    energy = summary.get("energy")
    throughput, residual = _value(energy, "throughput", 0.0), abs(_value(energy, "residual", 0.0))
    out.numbers = RunNumbers(residual=residual / throughput if throughput > 0 else math.nan if residual > 0 else 0.0,
        error=abs(_value(energy, "error", math.nan)), ratio=_value(energy, "ratio", math.nan), leaked=_value(summary, "leaked_particles", 0.0),
        penetration=_value(summary, "max_penetration", 0.0), steps=float(out.steps))
    if out.termination == "normal" and not math.isfinite(_value(energy, "total", math.nan)):
        out.verdict, out.reason = Verdict.broken, "it ended normally, but its energy is not finite"


def result_of_run(folder: Path, record: RunRecord) -> RunResult:
    """A run's result from its record and the files it left, without observations. Termination, reason, times, counts, what limits may name where
    it ended normally, and the verdict as far as it follows from the way it ended (stable, degraded, stopped, refused or broken)."""
    out = RunResult(folder=folder, exit_code=record.exit_code, wall_seconds=record.wall_seconds,
                    cpu_seconds=record.cpu_seconds, peak_memory_bytes=record.peak_memory_bytes)
    summary = _load(folder / "summary.yaml")
    if summary is not None:
        _take_summary(summary, out)
    verdict, reason = _ending(record, out, summary, _first_error_line(folder / "errors.txt"))
    if verdict is not None:
        out.verdict, out.reason = verdict, reason
    return out


def _ending(record: RunRecord, out: RunResult, summary: dict[str, Any] | None, said: str) -> tuple[Verdict | None, str]:
    """The verdict of the way a run ended, and its reason; None where the summary's stand."""
    broken, code = Verdict.broken, record.exit_code
    if record.timed_out:
        return broken, f"ran longer than {record.time_limit:g} s"
    if record.signal:
        return broken, f"ended by signal {record.signal} ({signal.strsignal(record.signal)})"
    if code == 1:
        return (Verdict.refused, said) if said else (broken, "refused without a reason (exit code 1)")
    if code == 2 and out.termination == "normal" and out.verdict != broken:
        # it came to its end: limits and bounds of the suite count, too
        reasons = (summary or {}).get("verdict_reasons")
        first = f": {reasons[0]}" if isinstance(reasons, list) and reasons else ""
        return Verdict.degraded, "its results cannot be trusted" + first
    if code == 2:
        reason = out.reason or said
        if not reason or CANNOT_WRITE in reason:
            return broken, reason or "stopped without a reason (exit code 2)"
        return Verdict.stopped, reason
    if code != 0:
        return broken, f"exit code {code}" + (f": {said}" if said else "")
    if summary is None:
        return broken, "exit code 0, but there is no summary.yaml"
    if out.termination != "normal" and out.verdict != broken:
        return broken, f"exit code 0 with the termination '{out.termination}': {out.reason}"
    return None, ""


def says_something_of_the_deck(record: RunRecord, result: RunResult) -> bool:
    """Whether a run ended for reasons of its own, so that it would end so again: nobody interrupted or killed it, it could be started, and there
    was room for what it wrote."""
    if record.timed_out:
        return True
    return (result.termination != "interrupted" and record.signal == 0 and record.exit_code <= 2 and CANNOT_WRITE not in result.reason)
