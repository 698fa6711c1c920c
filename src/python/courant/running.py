"""Runs of decks from Python, by the program beside this package."""
from __future__ import annotations

import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import IO, Any

from .diagnostics import CourantError, Diagnostics, parse_messages
from .live import LiveState
from .native import native
from .program import executable
from .results import Results
from .run_options import check_options
from .units import Units

class Run(Results):
    """The results of a run that `courant.run` made, with its verdict. `diagnostics`: messages about the deck; `exit_code` of the program."""

    def __init__(self, folder: str | PathLike[str], diagnostics: Diagnostics, exit_code: int, units: Units | None = None) -> None:
        super().__init__(folder, units)
        self.diagnostics, self.exit_code = diagnostics, exit_code

    @property
    def termination(self) -> str:
        """ "normal", "interrupted" or "error"."""
        return str(self.summary.get("termination", ""))


class RunFailed(CourantError):
    """A run that ended in error, or whose results cannot be trusted; `results`: what there is of them."""

    def __init__(self, diagnostics: Diagnostics, results: Run) -> None:
        super().__init__(diagnostics)
        self.results = results


def _program() -> str:
    program = executable()
    if program:
        return program
    diagnostics = Diagnostics()
    diagnostics.error("", "the program courant is not found", "install it beside this package, or name it in COURANT_EXECUTABLE")
    raise CourantError(diagnostics)


Callback = Callable[[LiveState], object]


def run(deck: str | PathLike[str], folder: str | PathLike[str] = "results", *, until: float | None = None, threads: int = 0,
        parameters: Mapping[str, Any] | None = None, restart: str | PathLike[str] | None = None, quiet: bool = False, check: bool = True,
        progress: Callable[[str], object] | None = None, callback: Callback | None = None, every_steps: int = 0, every: float = 0.0,
        in_process: bool | None = None, stop: Any = None) -> Run:
    """Runs a deck, or a scene in YAML, with results in `folder`, and waits for its end.

    `until`: end time instead of ENDTIM [T]; `threads`: 0 takes as many as are quickest; `parameters`: values of *PARAMETER or of the scene;
    `restart`: goes on from this file or folder. `progress` gets the status lines instead of the terminal. `callback` gets the state (courant.live) once
    in `every_steps` steps, each `every` time units and at the end, or in each step if neither is given; an exception in it ends the run cleanly, with all
    results so far, and is raised here. So does Ctrl-C: KeyboardInterrupt is raised once the results are written, and `courant.open` reads them.
    `stop`: an object of the extension module, whose `ask()` ends the run from another thread; Ctrl-C, too, then gives the results without an exception.
    `in_process`: None takes this process where the extension module is there, False a process of its own; the bits are the same.
    Raises CourantError with the messages where an option or the deck is wrong (each has `where.file`, `where.line`, `field`, `message`, `hint`), and with `check`
    RunFailed where the run ended in error or its verdict is "broken".
    """
    check_options(until=until, threads=threads, callback=callback, every_steps=every_steps, every=every)
    options: dict[str, Any] = dict(until=until, threads=threads, parameters=parameters, restart=restart, quiet=quiet, progress=progress)
    inside = _may_run_inside(deck, callback is not None, in_process)
    if fspath(deck).endswith((".yaml", ".yml")) and inside:
        from .scene.scene import Scene

        scene = Scene.from_yaml(deck, **{name: str(value) for name, value in (parameters or {}).items()})
        return scene.run(folder, **options | {"parameters": None}, check=check, callback=callback, every_steps=every_steps, every=every, in_process=True, stop=stop)
    if inside:
        from .inside import run_inside

        code, said, diagnostics = run_inside(deck, folder, **options, callback=callback, every_steps=every_steps, every=every, stop=stop)
        pressed = False
    else:
        code, said, diagnostics, pressed = _run_outside(deck, folder, **options)
    if code == 1 or (code not in (0, 2) and not Path(folder, "summary.yaml").exists()):
        if diagnostics.ok:
            diagnostics.error(fspath(deck), said.strip() or f"the program ended with {code}")
        if pressed:
            raise KeyboardInterrupt
        raise CourantError(diagnostics)
    results = Run(folder, diagnostics, code)
    # in this process nothing but Ctrl-C, or `stop`, is a signal
    if pressed or (inside and stop is None and str(results.summary.get("reason", "")).startswith("stopped by a signal")):
        raise KeyboardInterrupt(f"the run has ended; its results so far: courant.open({fspath(folder)!r})")
    if code and check:
        raise RunFailed(diagnostics, results)
    return results


def _may_run_inside(deck: str | PathLike[str], must: bool, asked: bool | None) -> bool:
    """Whether a run goes on in this process. Raises CourantError where it must and cannot."""
    module = native() if asked is not False else None
    cases = module is not None and module.has_cases(fspath(deck))  # each is a run of its own
    if module is not None and not cases:
        return True
    if must or asked:
        diagnostics = Diagnostics()
        if cases:
            diagnostics.error(fspath(deck), "a deck with *CASE is several runs, which do not go on in this process", "give the case a deck of its own")
        else:
            diagnostics.error(fspath(deck), "the extension module, which runs in this process and callbacks need, is not there",
                              "leave out in_process=False" if asked is False else "apt-get install pybind11-dev, and build Courant again")
        raise CourantError(diagnostics)
    return False


def _run_outside(deck: str | PathLike[str], folder: str | PathLike[str], *, until: float | None, threads: int, parameters: Mapping[str, Any] | None,
                 restart: str | PathLike[str] | None, quiet: bool, progress: Callable[[str], object] | None) -> tuple[int, str, Diagnostics, bool]:
    words = [_program(), "run", fspath(deck), "-o", fspath(folder), "--threads", str(int(threads))]
    words += ["--until", repr(float(until))] if until is not None else []
    words += [word for name, value in (parameters or {}).items() for word in ("--param", f"{name}={value}")]
    words += ["--restart", fspath(restart)] if restart is not None else []
    code, said, pressed = _wait(words + (["--quiet"] if quiet else []), quiet, progress)
    return code, said, parse_messages(said), pressed


def check(deck: str | PathLike[str], *, parameters: Mapping[str, Any] | None = None) -> Diagnostics:
    """Reads a deck or scene and builds what it describes, as `courant check` does. Returns its notes and warnings; raises CourantError with its errors."""
    words = [_program(), "check", fspath(deck), *(word for name, value in (parameters or {}).items() for word in ("--param", f"{name}={value}"))]
    done = subprocess.run(words, capture_output=True, text=True, errors="replace")
    diagnostics = parse_messages(done.stderr)
    if done.returncode:
        if diagnostics.ok:
            diagnostics.error(fspath(deck), done.stderr.strip() or f"the program ended with {done.returncode}")
        raise CourantError(diagnostics)
    return diagnostics


def _wait(words: list[str], quiet: bool, progress: Callable[[str], object] | None = None) -> tuple[int, str, bool]:
    """Exit code, what was said on standard error, and whether Ctrl-C ended it. Its output goes to that of this process, be it a terminal or a notebook."""
    try:
        terminal = sys.stdout.isatty() and sys.stdout.fileno() == 1
    except (AttributeError, OSError, ValueError):
        terminal = False
    sys.stdout.flush()
    process = subprocess.Popen(words, stdout=None if terminal and not progress else subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                               text=True, errors="replace")
    said: list[str] = []

    def collect(stream: IO[str]) -> None:
        for line in stream:
            said.append(line)
            if not quiet and "warning: " in line:
                sys.stderr.write(line)

    assert process.stderr
    reader = threading.Thread(target=collect, args=(process.stderr,), daemon=True)
    reader.start()
    pressed = False
    while True:
        try:
            for line in process.stdout or ():
                if progress:
                    progress(line.rstrip("\n"))
                elif not quiet:
                    sys.stdout.write(line)
            process.wait()
            break
        except KeyboardInterrupt:
            pressed = True
            process.send_signal(signal.SIGINT)
    reader.join()
    return process.returncode, "".join(said), pressed
