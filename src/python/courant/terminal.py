"""What is said on the terminal: results, and a status line that is written over."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable


def clear_status_line() -> None:
    if sys.stdout.isatty():
        sys.stdout.write("\r\033[K")


def say(text: str) -> None:
    """A text for the user, behind the status line if there is one."""
    clear_status_line()
    sys.stdout.write(text)
    sys.stdout.flush()


def status_line() -> Callable[[str], None] | None:
    """Writes over the last line of a terminal; None where the output is none."""
    if not sys.stdout.isatty():
        return None

    def show(line: str) -> None:
        sys.stdout.write("\r\033[K" + line)
        sys.stdout.flush()

    return show


def processors(wanted: int) -> int:
    """How many processes work at once: as many as wanted, or, for 0, one for each core that this process may use."""
    return wanted or len(os.sched_getaffinity(0))
