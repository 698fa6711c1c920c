"""The runs of a suite."""
from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from ..diagnostics import Diagnostics
from ..expressions import ExpressionFault, constant_value
from .model import Case, Parameters, Setting, Suite, Variables
from .record import RunRecord
from .scene import parameter_values

_LONGEST_NAME = 60  # characters, of a folder


@dataclass
class PlannedRun:
    of_case: int  # index in Suite.cases
    setting: str  # name of the setting, and swept values of a stability case
    resolution: str = ""  # blank: none
    parameters: Parameters = field(default_factory=dict)  # overrides handed to scene or deck
    keywords: str = ""  # cards put at the end of the deck of a scene
    finest: bool = True  # of its setting
    folder: Path = Path()  # relative to the folder of results
    variables: Variables = field(default_factory=dict)  # values of all parameters that expressions may name
    size: float = 0.0  # of Case.size; 0: none
    generated: Path | None = None  # the deck made from a scene, not yet instead
    deck: Path = Path()  # that is run
    key: str = ""  # of all that the results follow from
    cost: float = 0.0  # in proportion to the time that it is expected to take
    record: RunRecord | None = None  # of how it ended
    reused: bool = False  # in an earlier call

    def describe(self, case: Case) -> str:
        return f"{self.setting}, {case.resolution} = {self.resolution}" if self.resolution else self.setting


Generate = Callable[[PlannedRun, int], list[str]]
"""(run, its number) -> faults. Writes the deck of a run of a scene and notes where in `run.generated`."""


def overrides_of(case: Case, setting: Setting, resolution: str) -> Parameters:
    """Those of the case, of the setting and the resolution, later ones first."""
    out = {**case.parameters, **setting.parameters, **({case.resolution: resolution} if resolution else {})}
    return dict(sorted(out.items()))


def folder_name(text: str, taken: set[str]) -> str:
    """A name that every file system takes, told apart from those in `taken` by a number; it is added to them."""
    name = re.sub(r"[^A-Za-z0-9.+-]", "_", text.encode()[:_LONGEST_NAME].decode("latin-1"))
    name = re.sub("__+", "_", name)
    if not name or name[0] == ".":
        name = "_" + name
    unique, k = name, 2
    while unique in taken:
        unique, k = f"{name}_{k}", k + 1
    taken.add(unique)
    return unique


def _swept(sweep: list[tuple[str, list[str]]]) -> Iterator[tuple[str, Parameters]]:
    """Sets of swept values and how they are called, "tssfac = 0.9, c0 = 30"; the first parameter outermost."""
    if not sweep:
        yield "", {}
        return
    (name, values), *rest = sweep
    for value in values:
        for more, parameters in _swept(rest):
            yield f"{name} = {value}" + (f", {more}" if more else ""), {name: value, **parameters}


def _runs_of(number: int, case: Case, setting: Setting) -> Iterator[tuple[PlannedRun, str]]:
    """Runs of a setting with the texts that their folders are named by."""
    if case.stability:
        for name, values in _swept(case.stability.sweep):
            alone = name and len(case.settings) == 1
            label = name if alone else ", ".join(filter(None, (setting.name, name)))
            parameters = dict(sorted({**overrides_of(case, setting, ""), **values}.items()))
            yield PlannedRun(number, label, parameters=parameters, keywords=setting.keywords), label
        return
    resolutions = setting.resolutions or case.resolutions or [""]
    for k, resolution in enumerate(resolutions):
        run = PlannedRun(number, setting.name, resolution, overrides_of(case, setting, resolution), setting.keywords, k + 1 == len(resolutions))
        yield run, setting.name + (f"-{resolution}" if resolution else "")


def list_runs(suite: Suite) -> list[PlannedRun]:
    """All runs in the order of the suite: cases, settings, then resolutions from coarse to fine or swept values."""
    out = []
    for number, case in enumerate(suite.cases):
        taken: set[str] = set()
        for setting in case.settings:
            for run, text in _runs_of(number, case, setting):
                run.folder = Path("runs", case.name, folder_name(text, taken))
                out.append(run)
    return out


def plan_runs(suite: Suite, generate: Generate, at_once: int, diagnostics: Diagnostics) -> list[PlannedRun]:
    """All runs, their decks made by `generate`, so many at once. What is wrong goes to `diagnostics`, at the case."""
    runs = list_runs(suite)

    def prepare(number: int) -> list[str]:
        run = runs[number]
        return generate(run, number) if suite.cases[run.of_case].is_made else []

    with ThreadPoolExecutor(max(1, at_once)) as pool:
        faults = list(pool.map(prepare, range(len(runs))))
    before: PlannedRun | None = None
    for run, texts in zip(runs, faults, strict=True):
        case = suite.cases[run.of_case]
        for text in texts:
            diagnostics.error(case.where, f"case {case.name}, {run.describe(case)}: {text}")
        if not texts:
            _take_values(run, case, diagnostics)
        if before and (before.of_case, before.setting) == (run.of_case, run.setting) and before.size > 0 and run.size >= before.size:
            diagnostics.error(case.where, f"case {case.name}: {case.resolution} = {run.resolution} has the size {run.size:.6g}, "
                                          f"not less than {before.size:.6g} before it", "order the resolutions from coarse to fine")
        before = run
    return runs


def _take_values(run: PlannedRun, case: Case, diagnostics: Diagnostics) -> None:
    """Values of the parameters of a run, and its size."""
    values = parameter_values(case, run.parameters)
    if values is None:
        diagnostics.error(case.where, f"case {case.name}, {run.describe(case)}: the values of its parameters are not known")
        return
    run.variables = values
    if not case.size:
        return
    why = ""
    try:
        run.size = constant_value(case.size, values)
    except ExpressionFault as fault:
        why = fault.message
    if not run.size > 0:
        diagnostics.error(case.where, f"case {case.name}, {run.describe(case)}: 'size' must be > 0" + (f": {why}" if why else f", got {run.size:g}"))
