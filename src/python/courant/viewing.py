"""`courant view`: a state of a run, or the first one of a deck or scene before it is run, in a window or as a picture."""
from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .optional import MissingModule
from .previewing import check_ending, fault_of, first_state
from .results import Results
from .terminal import Parser, exit_code_of, say


def _chosen(folder: str, number: int | None, t: float | None) -> Any:
    states = Results(folder).states
    if t is not None:
        return states.at(t)
    number = -1 if number is None else number
    if not -len(states) <= number < len(states):
        raise fault_of(folder, f"there is no state {number}: the run has {len(states)}", f"from 0 to {len(states) - 1}; -1 is the last")
    return states[number]


def _has_display() -> bool:
    return not sys.platform.startswith("linux") or any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY"))


def main(words: Sequence[str]) -> int:
    """The exit code: 0, 1 where the input has faults, 2 where the picture could not be written, 3 where a module is missing."""
    parser = Parser("courant view", allow_abbrev=False, description="a state of a run, or the first one of a deck, in a window or as a picture")
    parser.add_argument("target", metavar="DIR|DECK", help="folder of a run, keyword deck, or scene.yaml")
    parser.add_argument("--state", type=int, metavar="N", help="number of the state, from 0; -1, the last, if not given")
    parser.add_argument("--at", type=float, metavar="T", help="the state nearest to this time")
    parser.add_argument("--field", default="", metavar="F", help="colours: speed if not given")
    parser.add_argument("-o", "--output", metavar="FILE", help="a picture instead of a window: PNG, PDF, SVG")
    call = parser.parse_args(list(words))
    if call.state is not None and call.at is not None:
        parser.error("--state or --at, not both")
    is_run = Path(call.target).is_dir()
    if not is_run and (call.state is not None or call.at is not None):
        parser.error("--state and --at choose among the states of a run; a deck has its first one alone")

    def draw() -> None:
        if call.output:
            check_ending(Path(call.output))
        with tempfile.TemporaryDirectory(prefix="courant_") as folder:
            state = _chosen(call.target, call.state, call.at) if is_run else first_state(call.target, call.target, Path(folder))
            try:
                _show(state, call.field, call.output)
            except KeyError as fault:  # a field that is not there
                raise fault_of("", str(fault.args[0])) from None

    return exit_code_of(draw)


def _show(state: Any, field: str, output: str | None) -> None:
    if output:
        state.plot(field, Path(output))
        say(f"view: {output}\n")
    elif not _has_display():
        raise fault_of("", "there is no display for a window", "-o FILE.png draws a picture")
    else:
        try:
            state.show(field or "speed")
        except MissingModule as fault:
            raise MissingModule(f"{fault}\n  hint: -o FILE.png draws a picture without it") from None
