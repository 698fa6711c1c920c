"""Measures what a recipe asks for in the results of a run."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from ..diagnostics import Diagnostics
from ..fields import ParticleFrame, StateFiles, Wanted, open_field, read_particles, read_states, read_walls, slack_of
from ..files import make_folder, write_file
from ..optional import MissingModule
from ..results import Results
from ..units import MODEL_UNITS
from ..variables import wanted_array
from ..yaml_map import YamlMap, is_map, parse_yaml
from .analyses import Analysis, Run
from .figures import figures_json
from .jump import JumpResult, evaluate_jump, find_case, jump_text
from .measured import Measured, measure_depths, no_pictures, results_yaml, snapshot_states, write_measured
from .parallel import in_order
from .recipe import Recipe, read_recipe
from .state import State
from .tables import write_tables_h5, write_vti

Say = Callable[[str], None]


class _Job:
    """What is done with each state, in any process: it is read, and everybody who looks at it measures."""

    def __init__(self, recipe: Recipe, states: list[StateFiles], pictures: dict[int, list[float]]) -> None:
        self.recipe, self.states, self.pictures = recipe, states, pictures
        self.depths = bool(recipe.jump or recipe.probes)
        self.slack = slack_of([state.t for state in states])
        self.analyses = [one for one in recipe.analyses if one.needs_states]
        arrays = [wanted_array("active"), *(array for one in self.analyses for array in one.needs())] if self.analyses else []
        self.arrays = list(dict.fromkeys(sorted(arrays, key=lambda one: one.optional)))  # asked for by anybody: not optional

    def wants(self, s: int) -> bool:
        return self.depths or s in self.pictures or any(one.looks_at(self.states[s].t, self.slack) for one in self.analyses)

    def __call__(self, s: int) -> tuple[Diagnostics, float, Any, list[Any]] | None:
        """Messages, time, depths and what each analysis measured; the time is NaN where the state cannot be read."""
        diagnostics = Diagnostics()
        with_speed = s in self.pictures
        frame = read_particles(self.states[s], [*self.arrays, *([Wanted("velocity", 3)] if with_speed else [])], diagnostics, self.recipe.missing)
        if frame is None:
            return diagnostics, float("nan"), None, []
        depths = measure_depths(frame, self.recipe, with_speed) if self.depths or with_speed else None
        return diagnostics, frame.t, depths, self._measured(frame, diagnostics)

    def _measured(self, frame: ParticleFrame, diagnostics: Diagnostics) -> list[Any]:
        state, out = State(frame, self.slack), []
        for one in self.analyses:
            try:
                out.append(one.measure(state) if one.looks_at(frame.t, self.slack) else None)
            except (MemoryError, MissingModule):
                raise
            except Exception as fault:  # a kind of the user's own may raise anything
                place = traceback.extract_tb(fault.__traceback__)[-1]
                why = f"{type(fault).__name__} at {place.filename}:{place.lineno}: {fault}"
                diagnostics.error(one.where, f"analysis '{one.name}' at t = {frame.t:g}: {why}")
                out.append(None)
        return out


def _stream(job: _Job, threads: int, progress: Say | None, diagnostics: Diagnostics) -> Measured | None:
    """Takes in what was measured, in the order of the states. None where a state cannot be read."""
    out, wanted = Measured(), [s for s in range(len(job.states)) if job.wants(s)]
    if job.analyses:
        from scipy import spatial  # noqa: F401  imported once, for all processes
    for k, (s, (messages, t, depths, measured)) in enumerate(zip(wanted, in_order(job, wanted, threads, few=4), strict=True), 1):
        for message in messages.all:
            diagnostics.add(message)
        if not messages.ok:
            return None
        if depths is not None:
            out.t.append(t)
            out.depths.append(depths._replace(snapshot=None))
            out.snapshots += [(shown, depths.snapshot) for shown in sorted(job.pictures.get(s, []))]
        for one, found in zip(job.analyses, measured, strict=True):
            if one.looks_at(t, job.slack):
                one.take(t, job.slack, found)
        if progress and (k % 16 == 1 or k == len(wanted)):
            progress(f"state {k} of {len(wanted)}, t = {t:.4g}, {100 * k / len(wanted):.0f} %")
    return out


def _finish(recipe: Recipe, folder: Path, out: Path, say: Say, diagnostics: Diagnostics) -> None:
    """Makes the results and writes CSV, HDF5 (tables.h5) and .vti files. Raises OutputError."""
    make_folder(out)
    above: dict[str, Analysis] = {}
    for one in recipe.analyses:
        one.finish(Run(dict(above), folder, out, diagnostics))
        above[one.name] = one
        for table in one.result.tables:
            write_file(out / f"{table.name}.csv", table.csv())
        for image in one.result.images:
            write_vti(out / f"{image.name}.vti", image)
        say(f"{one.name} ({one.kind})\n{one.result.text}")
    write_tables_h5(out / "tables.h5", [table for one in recipe.analyses for table in one.result.tables])


def read_title(folder: Path, diagnostics: Diagnostics) -> str:
    """The title in summary.yaml; a run that still goes on has none yet."""
    file = folder / "summary.yaml"
    try:
        data = file.read_bytes()
    except OSError:
        return ""
    found = Diagnostics()
    root = parse_yaml(data, str(file), found)
    for message in found.all:
        diagnostics.warning(message.where, message.message)
    return YamlMap(root, "summary", str(file), Diagnostics()).text("title") if root is not None and is_map(root) else ""


def _figures(recipe: Recipe, out: Path, title: str, walls: np.ndarray, threads: int, diagnostics: Diagnostics) -> str:
    """Writes figures.json and draws the figures; gives what is to be said of them. Raises OutputError."""
    tables = [table for one in recipe.analyses for table in one.result.tables]
    images = [image for one in recipe.analyses for image in one.result.images]
    json = figures_json(recipe.figures, tables, images, walls, recipe.formats, title, diagnostics)
    write_file(out / "figures.json", json)
    if not diagnostics.ok:
        return ""  # a figure without one of its curves would mislead
    try:
        from .draw import draw_chart, draw_figures

        draw_figures(out, threads)
        for figure in recipe.figures:
            if figure.chart:
                draw_chart(figure, {table.name: table for table in tables}, recipe.formats, title, out)
    except MissingModule as fault:
        no_pictures(fault, diagnostics)
        return ""
    return f"{len(recipe.figures)} figures: {out}\n"


def _views(recipe: Recipe, folder: Path, out: Path, diagnostics: Diagnostics) -> str:
    """Draws the views; gives what is to be said of them. Raises OutputError."""
    from .views import draw_views

    make_folder(out)
    try:
        made = draw_views(Results(folder, recipe.settings.units, recipe.missing), recipe.views, out, diagnostics)
    except MissingModule as fault:
        no_pictures(fault, diagnostics)
        return ""
    return "".join(f"view: {path}\n" for path in made)


def _tell_missing(recipe: Recipe, states: list[StateFiles], say: Say) -> None:
    """Which numbers of the recipe are in for arrays that the files lack."""
    file = open_field(states[0].particles, Diagnostics()) if states and states[0].particles and recipe.missing else None
    if file is not None:
        for name, value in recipe.missing.items():
            if not file.has("PointData", name):
                say(f"the field files have no {name}: {value:g} of the recipe stands in for it\n")


def run_post(
    recipe_file: str | PathLike[str], folder: str | PathLike[str], say: Say, diagnostics: Diagnostics, progress: Say | None = None, threads: int = 1
) -> bool:
    """Measures what the recipe asks for, and returns whether all but the pictures worked.

    Tables go to `say` as text of several lines; into the run's folder go results.yaml, depth.csv (jump and probes over time), and for
    pictures snapshots.csv, walls.csv, plot.json, depth.png and velocity.png; into its subfolder (recipe: folder) CSV, tables.h5 and .vti
    files of the analyses, figures.json and the figures. `progress` gets a status line now and then. Faults of recipe and folder go to
    `diagnostics`, also the warning where pictures could not be drawn. `threads`: processes that work at once; results have the same bits
    for any number. Raises OutputError where a file cannot be written.
    """
    recipe = read_recipe(recipe_file, diagnostics, Results(folder).units if Path(folder).is_dir() else MODEL_UNITS)
    if recipe is None:
        return False
    folder = Path(folder)
    # figures show walls; histories alone need no states
    without_states = not recipe.needs_states and not (recipe.figures and (folder / "fields.pvd").exists())
    states = [] if without_states else read_states(folder, diagnostics, with_particles=recipe.needs_states)
    if not states and not without_states:
        return False
    out = folder / recipe.folder
    for one in recipe.analyses:
        one.out = out
        if states:
            one.begin(states, diagnostics)
    if not diagnostics.ok:
        return False
    _tell_missing(recipe, states, say)
    job = _Job(recipe, states, snapshot_states(recipe, states, diagnostics))
    measured = _stream(job, threads, progress, diagnostics)
    if measured is None:
        return False
    title = read_title(folder, diagnostics)
    jump: JumpResult | None = None
    if recipe.jump:
        case = recipe.case or find_case(title, recipe.jump.published)
        jump = evaluate_jump(recipe.jump, case, measured.series(recipe.jump))
        say(jump_text(recipe.jump, jump))
    if recipe.analyses:
        _finish(recipe, folder, out, say, diagnostics)
    write_file(folder / "results.yaml", results_yaml(recipe, title, measured, jump))
    walls = np.empty((0, 4)) if without_states else read_walls(states[0], diagnostics)
    said = write_measured(recipe, folder, measured, jump, title, walls, diagnostics)
    if recipe.figures:
        said += _figures(recipe, out, title, walls, threads, diagnostics)
    if recipe.views:
        said += _views(recipe, folder, out, diagnostics)
    say(said)
    return diagnostics.ok
