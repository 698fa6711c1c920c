"""How long the remaining runs will take, from those that are done."""
from __future__ import annotations

import time
from dataclasses import dataclass


def duration_text(seconds: float) -> str:
    """ "45 s", "3 min 05 s", "2 h 10 min"."""
    s = int(seconds + 0.5)
    if s < 60:
        return f"{s} s"
    return f"{s // 60} min {s % 60:02} s" if s < 3600 else f"{s // 3600} h {s // 60 % 60:02} min"


@dataclass
class _Entry:
    of_case: int
    cost: float
    start: float | None = None  # of a run that is under way [s]
    seconds: float | None = None  # of a run that is done


class RunSchedule:
    """Runs are expected to take as long as their cost (in any unit), in proportion to runs of the same case that
    are done, or to all that are done while there are none of the case."""

    def __init__(self, runs: list[tuple[int, float]], at_once: int) -> None:
        """`runs`: number of the case and cost of each."""
        self._runs = [_Entry(case, cost) for case, cost in runs]
        self._at_once = max(1, at_once)

    def __len__(self) -> int:
        return len(self._runs)

    def started(self, run: int) -> None:
        self._runs[run].start = time.monotonic()

    def ended(self, run: int, wall_seconds: float) -> None:
        self._runs[run].seconds = wall_seconds

    @property
    def done(self) -> int:
        return sum(run.seconds is not None for run in self._runs)

    def _pace(self, of_case: int | None) -> float | None:
        """Seconds for a unit of cost in runs of a case, or in all, that are done."""
        done = [r for r in self._runs if r.seconds is not None and of_case in (None, r.of_case)]
        cost = sum(r.cost for r in done)
        return sum(r.seconds or 0.0 for r in done) / cost if cost > 0 else None

    def seconds_left(self) -> float | None:
        """Until all are done; None while no run is done."""
        overall = self._pace(None)
        if overall is None:
            return None
        pace = {case: self._pace(case) for case in {r.of_case for r in self._runs}}
        work = longest = 0.0
        for run in self._runs:
            if run.seconds is not None:
                continue
            known = pace[run.of_case]
            left = run.cost * (overall if known is None else known)
            if run.start is not None:
                left = max(0.0, left - (time.monotonic() - run.start))
            work += left
            longest = max(longest, left)
        return max(longest, work / self._at_once)
