"""Runs in a loop: `for state in courant.steps(DECK, every=0.01)`."""
from __future__ import annotations

import threading
from collections.abc import Iterator
from os import PathLike
from queue import SimpleQueue
from typing import Any

from .live import LiveState
from .native import native
from .running import Run, run


class Steps:
    """The states of a run while it goes on. The run waits while the body of the loop examines a state, which is valid until the next one; leaving the
    loop early ends the run cleanly. `result`: the results of the run once it has ended."""

    def __init__(self, deck: str | PathLike[str], folder: str | PathLike[str] = "results", *, every: float = 0.0, every_steps: int = 0, **options: Any) -> None:
        self.result: Run | None = None
        self._call = (deck, folder)
        self._options = options | {"every": every, "every_steps": every_steps}

    def __iter__(self) -> Iterator[LiveState]:
        states: SimpleQueue[LiveState | None] = SimpleQueue()
        go_on, left = threading.Event(), threading.Event()
        end: list[BaseException] = []

        def show(state: LiveState) -> None:
            states.put(state)
            go_on.wait()
            go_on.clear()
            if left.is_set():
                raise _Left

        def work() -> None:
            try:
                self.result = run(*self._call, callback=show, stop=stop, **self._options)
            except BaseException as fault:  # noqa: BLE001  it is raised in the loop
                end.append(fault)
            states.put(None)

        module = native()
        stop = module.Stop() if module else None
        waits = False  # the run, for the body of the loop
        worker = threading.Thread(target=work, name="courant run")
        worker.start()
        try:
            while (state := states.get()) is not None:
                waits = True
                yield state
                waits = False
                go_on.set()
        finally:
            left.set()
            if stop is not None and not waits and worker.is_alive():  # Ctrl-C; a run that waits ends by the exception of its callback
                stop.ask()
            go_on.set()
            worker.join()
        if end and not isinstance(end[0], _Left):
            raise end[0]


class _Left(Exception):
    """The loop was left: the run ends."""


def steps(deck: str | PathLike[str], folder: str | PathLike[str] = "results", *, every: float = 0.0, every_steps: int = 0, **options: Any) -> Steps:
    """A run as a loop over its states, each `every` time units and at the end, or once in `every_steps` steps: `for state in courant.steps(DECK, every=0.01)`.

    `options`: others of courant.run, whose errors are raised in the loop. Raises CourantError where the extension module is missing.
    """
    return Steps(deck, folder, every=every, every_steps=every_steps, **options)
