"""What a suite came to, as files for programs."""
from __future__ import annotations

import csv
import io
import math
import re
from pathlib import Path
from typing import Any

import yaml

from ..files import write_file
from .model import CaseResult, Observed, RunResult, SuiteResult

_Dumper = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
HEAD = ("case,setting,resolution,size,observation,value,reference,error,check,verdict,as_required,wall_seconds,"
        "cpu_seconds,particles,steps,particle_steps,peak_memory_bytes,exit_code,termination,reason,why")


def check_of_row(case: CaseResult, k: int, observation: str) -> str:
    """Whether the checks that belong to run k and an observation are met: "met", "missed", or blank if there are none. Checks of a setting belong
    to its last run."""
    run = case.runs[k]
    if case.definition.stability:
        return "met" if run.as_required else "missed"
    if not case.ends_setting(k):
        return ""
    met = [check.met for check in case.checks if check.setting == run.setting and check.observation in (observation, "")]
    return "" if not met else "met" if all(met) else "missed"


def _in_full(value: float | None) -> str:
    return "" if value is None else f"{value:.10g}"


def _row(case: CaseResult, k: int, o: Observed) -> list[str]:
    run = case.runs[k]
    cells = [case.definition.name, run.setting, run.resolution, _in_full(run.size) if run.size > 0 else "", o.name,
             *map(_in_full, (o.value, o.reference, o.error)), check_of_row(case, k, o.name), run.verdict.name,
             "yes" if run.as_required else "no", f"{run.wall_seconds:.4f}", f"{run.cpu_seconds:.4f}", run.particles, run.steps,
             run.particle_steps, run.peak_memory_bytes, run.exit_code, run.termination, "; ".join(filter(None, [run.reason, *run.exceeded])), o.why]
    return [re.sub("[\n\r]", " ", str(cell)) for cell in cells]


def results_csv(result: SuiteResult) -> str:
    """One row per run and observation, and one for a run without observations."""
    out = io.StringIO()
    rows = csv.writer(out, lineterminator="\n")
    rows.writerow(HEAD.split(","))
    for case in result.cases:
        for k, run in enumerate(case.runs):
            rows.writerows(_row(case, k, o) for o in run.observed or [Observed()])
    return out.getvalue()


def _number(value: float) -> float:
    return float(f"{value:.12g}") if math.isfinite(value) else value


def _map(**entries: Any) -> dict[str, Any]:
    """Entries with a value, numbers with twelve digits."""
    return {key: _number(value) if isinstance(value, float) else value for key, value in entries.items() if value is not None}


def _run(run: RunResult) -> dict[str, Any]:
    return _map(setting=run.setting, resolution=run.resolution, parameters=run.parameters, size=run.size if run.size > 0 else None,
        folder=str(run.folder), verdict=run.verdict.name, as_required=run.as_required, exceeded=run.exceeded,
        exit_code=run.exit_code, termination=run.termination, reason=run.reason, wall_seconds=run.wall_seconds,
        cpu_seconds=run.cpu_seconds, particles=run.particles, steps=run.steps, particle_steps=run.particle_steps,
        peak_memory_bytes=run.peak_memory_bytes, reused=run.reused,
        observed=[_map(name=o.name, found=o.found, why=o.why or None, value=o.value, reference=o.reference, error=o.error) for o in run.observed])


def _case(case: CaseResult) -> dict[str, Any]:
    d = case.definition
    return _map(name=d.name, title=d.title, about=d.about, scene=str(d.scene) if d.scene else None,
        build=f"{d.build.file}:{d.build.function}" if d.build else None, deck=str(d.deck) if d.deck else None, runs=[_run(run) for run in case.runs],
        orders=[_map(setting=m.setting, observation=m.observation, order=m.order) for m in case.orders],
        checks=[_map(setting=c.setting, observation=c.observation, what=c.what, bound=float(c.bound),
                     measured=float(c.measured), met=c.met) for c in case.checks])


def results_yaml(result: SuiteResult) -> str:
    """All of the result but curves and pictures."""
    content = _map(suite=str(result.suite.file), title=result.suite.title, about=result.suite.about, version=result.version,
        machine=result.machine, date=result.date, wall_seconds=result.wall_seconds, jobs=result.jobs, ok=result.ok,
        cases=[_case(case) for case in result.cases])
    return str(yaml.dump(content, Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=1 << 20))


def write_result_files(result: SuiteResult, folder: Path) -> None:
    """Both, each whole or not at all. Raises OutputError."""
    write_file(folder / "results.csv", results_csv(result))
    write_file(folder / "results.yaml", results_yaml(result))
