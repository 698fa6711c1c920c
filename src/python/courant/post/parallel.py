"""Work on several processes at once, whose results come in the order of the work."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator, Sequence
from typing import Any

_function: Callable[[Any], Any] | None = None  # of this process and of those that it forks: it need not be copied to them


class ProcessLost(Exception):
    """A process was ended from outside, as the system does where no memory is left."""


def _call(item: Any) -> Any:
    assert _function is not None
    return _function(item)


def _follow_the_first() -> None:
    """Ctrl-C is for the process that forked this one, and where that is gone this one ends, too."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    import ctypes

    ends_with_parent = 1  # PR_SET_PDEATHSIG of Linux
    ctypes.CDLL(None).prctl(ends_with_parent, signal.SIGKILL)


def in_order(function: Callable[[Any], Any], items: Sequence[Any], processes: int, few: int = 1) -> Iterator[Any]:
    """function(item) for each item, in their order. `few`: so many items are not worth a second process.

    Raises what the function raises, and ProcessLost.
    """
    global _function
    if processes <= 1 or len(items) <= few:
        yield from map(function, items)
        return
    import multiprocessing
    from concurrent.futures import BrokenExecutor, ProcessPoolExecutor

    _function = function
    context = multiprocessing.get_context("fork")
    pool = ProcessPoolExecutor(min(processes, len(items)), mp_context=context, initializer=_follow_the_first)
    try:
        yield from pool.map(_call, items, chunksize=max(1, min(8, len(items) // (8 * processes))))
    except BrokenExecutor as fault:
        raise ProcessLost from fault
    finally:
        pool.shutdown(cancel_futures=True)
