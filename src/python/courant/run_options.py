"""Options of runs, checked before anything is read or written."""
from __future__ import annotations

import math
import os
from typing import Any

from .diagnostics import CourantError, Diagnostics

MOST_THREADS_PER_CORE = 4  # more of them wait for each other for minutes


def cores() -> int:
    """The cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def check_options(*, until: Any = None, threads: Any = 0, callback: Any = None, every_steps: Any = 0, every: Any = 0.0) -> None:
    """Raises CourantError with all that is wrong with these options of courant.run."""
    diagnostics = Diagnostics()
    if until is not None and not (_is_number(until) and until > 0):
        diagnostics.error("", f"until={until!r}: expected a time > 0", "leave it out for the end time of the deck")
    _check_threads(threads, diagnostics)
    if callback is not None and not callable(callback):
        diagnostics.error("", f"callback={callback!r}: expected a function", "def follow(state): ..., then callback=follow")
    usual = "leave it out for a call in each step"
    if not _is_whole(every_steps) or every_steps < 0:
        diagnostics.error("", f"every_steps={every_steps!r}: expected a whole number of steps > 0", usual)
    elif every_steps and callback is None:
        diagnostics.error("", f"every_steps={every_steps!r} has no effect without a callback", "give callback=, or loop over courant.steps")
    if not _is_number(every) or every < 0:
        diagnostics.error("", f"every={every!r}: expected a time > 0", usual)
    elif every and callback is None:
        diagnostics.error("", f"every={every!r} has no effect without a callback", "give callback=, or loop over courant.steps")
    if not diagnostics.ok:
        raise CourantError(diagnostics)


def _check_threads(threads: Any, diagnostics: Diagnostics) -> None:
    most = MOST_THREADS_PER_CORE * cores()
    if not _is_whole(threads) or threads < 0:
        diagnostics.error("", f"threads={threads!r}: expected a whole number >= 0", "0, or nothing, takes as many as are quickest")
    elif threads > most:
        diagnostics.error("", f"threads={threads}: expected at most {most}, {MOST_THREADS_PER_CORE} for each core", f"one for each core is quickest: {cores()}")


def _is_number(value: Any) -> bool:
    try:
        return not isinstance(value, (str, bytes)) and math.isfinite(float(value))
    except (TypeError, ValueError, OverflowError):
        return False


def _is_whole(value: Any) -> bool:
    return _is_number(value) and not isinstance(value, bool) and float(value) == int(value)
