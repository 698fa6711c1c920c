"""Runs in the process of Python, by the extension module."""
from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable, Mapping
from os import PathLike, fspath
from typing import Any

from .diagnostics import Diagnostic, Diagnostics, Location, parse_messages
from .live import LiveState
from .native import native
from .units import MODEL_UNITS, Units
from .words import shortest


class _Talk:
    """What a run says, as the program says it on a terminal, in a file or a notebook: lines, a status line, warnings on standard error."""

    def __init__(self, progress: Callable[[str], object] | None) -> None:
        self._given = progress
        self._terminal = bool(getattr(sys.stdout, "isatty", lambda: False)())
        self._start, self._next, self._gap = time.monotonic(), 2.0, 2.0

    def line(self, text: str) -> None:
        if self._given is None:
            sys.stdout.write(("\r\033[K" if self._terminal else "") + text + "\n")

    def status(self, text: str) -> None:
        if self._given is not None:
            self._given(text)
        elif self._terminal:
            sys.stdout.write("\r\033[K" + text)
            sys.stdout.flush()
        elif (now := time.monotonic() - self._start) >= self._next:
            while self._next <= now:
                self._next += self._gap
                self._gap = min(2 * self._gap, 60.0)
            self.line(text)

    @staticmethod
    def messages(text: str) -> None:
        for line in text.splitlines(keepends=True):
            if "warning: " in line:
                sys.stderr.write(line)


def _word(value: Any) -> str:
    return shortest(float(value)) if isinstance(value, float) else str(value)


def run_inside(deck: str | PathLike[str], folder: str | PathLike[str], *, until: float | None = None, threads: int = 0,
               parameters: Mapping[str, Any] | None = None, restart: str | PathLike[str] | None = None, quiet: bool = False,
               progress: Callable[[str], object] | None = None, callback: Callable[[LiveState], object] | None = None, every_steps: int = 0,
               every: float = 0.0, stop: Any = None) -> tuple[int, str, Diagnostics]:
    """As courant.run; gives the exit code of the program, how the run ended in words, and the messages about the deck. `stop`: ends it when it is asked."""
    module = native()
    options = module.Options()
    options.deck, options.folder, options.restart = fspath(deck), fspath(folder), fspath(restart) if restart is not None else ""
    options.until, options.threads = float(until or 0.0), int(threads)
    options.parameters = {str(name): _word(value) for name, value in (parameters or {}).items()}
    options.words = [f"{name}={value}" for name, value in options.parameters.items()]
    options.every_steps, options.every_time = int(every_steps) if every_steps or every else int(callback is not None), float(every)
    options.interrupts = threading.current_thread() is threading.main_thread()
    talk = _Talk(progress)
    following = (lambda state: callback(LiveState(state, Units(*names) if (names := state.units()) else MODEL_UNITS))) if callback else None
    sys.stdout.flush()
    code, error, messages = module.run(options, stop or module.Stop(), None if quiet else talk.messages, None if quiet else talk.line,
                                       None if quiet and not progress else talk.status, following)
    if code in (0, 2) and not quiet and os.path.exists(os.path.join(options.folder, "summary.yaml")):
        talk.line(f"results are in {options.folder}")
    diagnostics = Diagnostics()
    for severity, file, line, column, text, hint, included in messages:
        more = f"\n  included from {included}" if included else ""
        diagnostics.add(Diagnostic(severity, Location(os.fsdecode(file), line, column), text + more, hint))
    for one in parse_messages(error).all:
        diagnostics.add(one)
    return code, error, diagnostics
