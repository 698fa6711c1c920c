"""Many runs of one scene or deck with other values of its parameters: `courant.sweep(scene, {"n": [20, 40, 80]}, jobs=2)`."""
from __future__ import annotations

import itertools
import json
import re
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from .deck.deck import Deck
from .diagnostics import CourantError, Diagnostics
from .files import make_folder, write_file
from .optional import MissingModule, module
from .program import executable
from .run_options import check_options
from .running import Run, run
from .scene.scene import Scene
from .verify.digest import digest, digest_of_build, digest_of_deck, without_comments
from .words import did_you_mean, shortest

Measure = Callable[[Run], Mapping[str, Any]]
_RECORD = "sweep.json"  # in the folder of a run: what it was made from, once it has ended


class MeasureFailed(CourantError):
    """An exception in `measure`, which is its `__cause__`."""


def sweep(what: Scene | Deck | str | PathLike[str], values: Mapping[str, Sequence[Any]], folder: str | PathLike[str] = "sweep", *, jobs: int = 1,
          measure: Measure | None = None, threads: int = 1, until: float | None = None, say: Callable[[str], object] | None = print) -> Any:
    """Runs a scene, a scene in YAML or a deck with all combinations of `values` of its parameters, `jobs` at once, each in a folder of its own in `folder`.

    `measure` takes the results of a run and gives columns of the table, {"height": 0.2}; an exception in it ends the sweep. A later call takes over runs that ended normally, unless deck,
    parameters, `until` or the program have changed; so an interrupted call goes on. Gives a pandas.DataFrame, or a list of dictionaries where pandas is
    missing, with a row for each combination, in order: parameters, folder, verdict, termination, measures, and `error`, the first line of what went wrong in that run.
    Raises CourantError before the first run where a parameter is not one of the scene, values are not a list, or the deck is missing, and where `measure`
    fails, with the parameters of that run.
    """
    check_options(until=until, threads=threads)
    if isinstance(what, Deck):
        make_folder(Path(folder))
        what = what.write(Path(folder, what.path.name))
    names, lists = _lists(values)
    combinations = [dict(zip(names, chosen)) for chosen in itertools.product(*lists)]
    _check(what, names, combinations, folder)
    rows: list[dict[str, Any]] = [{} for _ in combinations]
    with ThreadPoolExecutor(max(1, jobs)) as pool:
        waiting = {pool.submit(_one, what, chosen, Path(folder), threads, until, measure): k for k, chosen in enumerate(combinations)}
        try:
            for done, future in enumerate(as_completed(waiting), 1):
                k = waiting[future]
                rows[k] = future.result()
                if say:
                    say(f"{done} of {len(rows)}: {_said(combinations[k])}: {rows[k]['error'] or rows[k]['verdict']}{' (taken over)' if rows[k]['taken_over'] else ''}")
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)  # runs that go on end as on the terminal
            raise
    try:
        return module("pandas").DataFrame(rows)
    except MissingModule:
        return rows


def _text(value: Any) -> str:
    return shortest(value) if isinstance(value, float) else str(value)


def _said(chosen: Mapping[str, Any]) -> str:
    return ", ".join(f"{name} = {_text(value)}" for name, value in chosen.items())


def _lists(values: Mapping[str, Sequence[Any]]) -> tuple[list[str], list[list[Any]]]:
    """Names of the parameters, and the values of each."""
    diagnostics = Diagnostics()
    if not isinstance(values, Mapping):
        diagnostics.error("", f"values of a sweep: expected a dictionary of lists, got {values!r}", 'give them as {"n": [20, 40]}')
        raise CourantError(diagnostics)
    lists = []
    for name, given in values.items():
        try:
            if isinstance(given, (str, bytes, Mapping)):
                raise TypeError
            lists.append(list(given))
        except TypeError:
            diagnostics.error("", f"values of {name}: expected a list, got {given!r}", f'give {{"{name}": [{given!r}]}}, also of one value')
    if not diagnostics.ok:
        raise CourantError(diagnostics)
    return list(values), lists


def _check(what: Scene | str | PathLike[str], names: list[str], combinations: list[dict[str, Any]], folder: str | PathLike[str]) -> None:
    diagnostics = Diagnostics()
    if not isinstance(what, Scene) and not Path(what).is_file():
        diagnostics.error(fspath(what), "cannot read the deck", "is the name right, and is it a readable file?")
    elif _is_scene(what):
        scene = what if isinstance(what, Scene) else Scene._loaded(what, {})
        known = scene.parameters
        for name in names:
            if name not in known:
                hint = f"{did_you_mean(name, known)}its parameters: {', '.join(known) or 'none'}"
                diagnostics.error(scene._path, f"the scene has no parameter '{name}'", hint)
    labels = [_label(chosen) for chosen in combinations]
    if len(set(labels)) != len(labels):
        diagnostics.error(fspath(folder), "two combinations of values are the same", "give each value once")
    if not diagnostics.ok:
        raise CourantError(diagnostics)


def _is_scene(what: Scene | str | PathLike[str]) -> bool:
    return isinstance(what, Scene) or fspath(what).endswith((".yaml", ".yml"))


def _label(chosen: Mapping[str, Any]) -> str:
    """Name of the folder of a run: "n=20,height=0.5"."""
    text = ",".join(f"{name}={_text(value)}" for name, value in chosen.items()) or "run"
    plain = re.sub(r"[^\w.,=+-]+", "_", text)
    return plain if plain == text and len(plain) < 100 else f"{plain[:80]}_{digest(text)}"


def _one(what: Scene | str | PathLike[str], chosen: dict[str, Any], root: Path, threads: int, until: float | None, measure: Measure | None) -> dict[str, Any]:
    """The row of one run."""
    folder = root / _label(chosen)
    row = {**chosen, "folder": str(folder), "verdict": "", "termination": "", "error": "", "taken_over": False}
    make_folder(folder)
    try:
        deck, parameters = _deck(what, chosen, folder)
        made_from = {"deck": digest_of_deck(deck, parameters, comments=False), "parameters": parameters, "until": until, "program": digest_of_build(Path(executable()))}
        results = _earlier(folder, made_from)
        row["taken_over"] = results is not None
        if results is None:
            (folder / _RECORD).unlink(missing_ok=True)
            results = run(deck, folder, parameters=parameters, until=until, threads=threads, quiet=True, check=False, in_process=False)
            if results.termination == "normal":
                write_file(folder / _RECORD, json.dumps(made_from))
        row |= {"verdict": results.verdict, "termination": results.termination}
        if results.termination == "error":
            row["error"] = str(results.summary.get("reason", ""))
        elif measure is not None:
            row |= _measured(measure, results, chosen)
    except MeasureFailed:
        raise
    except CourantError as fault:
        row["error"] = str(fault).partition("\n")[0]
    return row


def _measured(measure: Measure, results: Run, chosen: Mapping[str, Any]) -> dict[str, Any]:
    try:
        return dict(measure(results))
    except CourantError:  # something that this run has not written: the row has it as its error
        raise
    except Exception as fault:
        diagnostics = Diagnostics()
        diagnostics.error("", f"measure fails for {_said(chosen) or 'the run'}: {type(fault).__name__}: {fault}",
                          f"the results are in {results.folder}; once measure is right, the same call takes over what has been run")
        raise MeasureFailed(diagnostics) from fault


def _deck(what: Scene | str | PathLike[str], chosen: Mapping[str, Any], folder: Path) -> tuple[Path, dict[str, str]]:
    """The deck of a run, and the parameters that it still has."""
    given = {name: _text(value) for name, value in chosen.items()}
    if not isinstance(what, Scene) and not _is_scene(what):
        return Path(fspath(what)), given
    scene = what.with_parameters(**given) if isinstance(what, Scene) else Scene.from_yaml(what, **given)
    text = scene.deck()
    file = folder / f"scene_{digest(without_comments(text.encode('utf-8', 'surrogateescape')))}.k"  # another scene has another file, as decks are inputs, which nothing is written over
    if not file.is_file():
        write_file(file, text)
    return file, {}


def _earlier(folder: Path, made_from: dict[str, Any]) -> Run | None:
    """The results of an earlier call that were made from the same."""
    try:
        same = json.loads((folder / _RECORD).read_text()) == made_from
    except (OSError, ValueError):
        return None
    return Run(folder, Diagnostics(), 0) if same and (folder / "summary.yaml").is_file() else None
