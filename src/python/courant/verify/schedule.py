"""How long the remaining runs will take, from those that are done."""
from __future__ import annotations

import time


def duration_text(seconds: float) -> str:
    """ "45 s", "3 min 05 s", "2 h 10 min"."""
    s = int(seconds + 0.5)
    if s < 60:
        return f"{s} s"
    return f"{s // 60} min {s % 60:02} s" if s < 3600 else f"{s // 3600} h {s // 60 % 60:02} min"


class RunSchedule:
    """Runs are expected to take as long as their cost (in any unit), in proportion to runs of the same case that are done, or to all that are done
    while there are none of the case."""

    def __init__(self, runs: list[tuple[int, float]], at_once: int) -> None:
        """`runs`: number of the case and cost of each."""
        self._runs, self._at_once = runs, max(1, at_once)
        self._starts: dict[int, float] = {}
        self._seconds: dict[int, float] = {}  # of runs that are done

    def __len__(self) -> int:
        return len(self._runs)

    @property
    def done(self) -> int:
        return len(self._seconds)

    def started(self, run: int) -> None:
        self._starts[run] = time.monotonic()

    def ended(self, run: int, wall_seconds: float) -> None:
        self._seconds[run] = wall_seconds

    def _pace(self, of_case: int | None) -> float | None:
        """Seconds for a unit of cost in runs of a case, or in all, that are done."""
        done = [run for run in self._seconds if of_case in (None, self._runs[run][0])]
        cost = sum(self._runs[run][1] for run in done)
        return sum(self._seconds[run] for run in done) / cost if cost > 0 else None

    def seconds_left(self) -> float | None:
        """Until all are done; None while no run is done."""
        overall = self._pace(None)
        if overall is None:
            return None
        paces = {case: self._pace(case) for case in {case for case, _ in self._runs}}
        left = []
        for run, (case, cost) in enumerate(self._runs):
            if run not in self._seconds:
                pace = paces[case]
                gone = time.monotonic() - self._starts[run] if run in self._starts else 0.0
                left.append(max(0.0, cost * (overall if pace is None else pace) - gone))
        return max([sum(left) / self._at_once, *left])
