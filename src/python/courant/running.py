"""Runs of decks from Python, by the program beside this package."""
from __future__ import annotations

import re
import signal
import subprocess
import sys
import threading
from collections.abc import Mapping
from os import PathLike, fspath
from pathlib import Path
from typing import IO, Any

from .diagnostics import CourantError, Diagnostic, Diagnostics, Location
from .program import executable
from .results import Results
from .units import Units

_MESSAGE = re.compile(r"(?:(?P<file>[^\n]*?)(?::(?P<line>\d+))?(?::(?P<column>\d+))?: )?(?P<severity>error|warning|note): (?P<text>.*)")


def parse_messages(text: str) -> Diagnostics:
    """Messages as the program prints them, with those lines that belong to the one above."""
    out = Diagnostics()
    for line in text.splitlines():
        found = _MESSAGE.fullmatch(line)
        if found:
            where = Location(found["file"] or "", int(found["line"] or 0), int(found["column"] or 0))
            out.add(Diagnostic(found["severity"], where, found["text"]))
        elif out.all and line.startswith("  hint: "):
            out.all[-1].hint = line[8:]
        elif out.all and line.startswith("  "):
            out.all[-1].message += "\n" + line
    return out


class Run(Results):
    """The results of a run that `courant.run` made, with its verdict. `diagnostics`: messages about the deck; `exit_code` of the program."""

    def __init__(self, folder: str | PathLike[str], diagnostics: Diagnostics, exit_code: int, units: Units = Units()) -> None:  # noqa: B008  frozen
        super().__init__(folder, units)
        self.diagnostics, self.exit_code = diagnostics, exit_code

    @property
    def verdict(self) -> str:
        """ "sound", "doubtful" or "broken"; "" where the run did not come so far."""
        return str(self.summary.get("verdict", ""))

    @property
    def verdict_reasons(self) -> list[str]:
        return [str(reason) for reason in self.summary.get("verdict_reasons") or []]

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


def run(deck: str | PathLike[str], folder: str | PathLike[str] = "results", *, until: float | None = None, threads: int = 0,
        parameters: Mapping[str, Any] | None = None, restart: str | PathLike[str] | None = None, quiet: bool = False, check: bool = True) -> Run:
    """Runs a deck, or a scene in YAML, with results in `folder`, and waits for its end.

    `until`: end time instead of ENDTIM [T]; `threads`: 0 takes as many as are quickest; `parameters`: values of *PARAMETER or of the scene;
    `restart`: goes on from this file or folder. Ctrl-C ends the run as it ends one on the terminal: with all results so far.
    Raises CourantError with the messages where the deck is wrong (each has `where.file`, `where.line`, `field`, `message`, `hint`), and with `check`
    RunFailed where the run ended in error or its verdict is "broken".
    """
    words = [_program(), "run", fspath(deck), "-o", fspath(folder), "--threads", str(int(threads))]
    words += ["--until", repr(float(until))] if until is not None else []
    words += [word for name, value in (parameters or {}).items() for word in ("--param", f"{name}={value}")]
    words += ["--restart", fspath(restart)] if restart is not None else []
    code, said = _wait(words + (["--quiet"] if quiet else []), quiet)
    diagnostics = parse_messages(said)
    if code == 1 or (code not in (0, 2) and not Path(folder, "summary.yaml").exists()):
        if diagnostics.ok:
            diagnostics.error(fspath(deck), said.strip() or f"the program ended with {code}")
        raise CourantError(diagnostics)
    results = Run(folder, diagnostics, code)
    if code and check:
        raise RunFailed(diagnostics, results)
    return results


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


def _wait(words: list[str], quiet: bool) -> tuple[int, str]:
    """Exit code, and what was said on standard error. Its output goes to that of this process, be it a terminal or a notebook."""
    try:
        terminal = sys.stdout.isatty() and sys.stdout.fileno() == 1
    except (AttributeError, OSError, ValueError):
        terminal = False
    sys.stdout.flush()
    process = subprocess.Popen(words, stdout=None if terminal else subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
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
    while True:
        try:
            for line in process.stdout or ():
                if not quiet:
                    sys.stdout.write(line)
            process.wait()
            break
        except KeyboardInterrupt:
            process.send_signal(signal.SIGINT)
    reader.join()
    return process.returncode, "".join(said)
