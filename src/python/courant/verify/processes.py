"""Runs as child processes, several at once."""
from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..files import open_for_writing
from .record import RunRecord

PATIENCE = 5.0  # with a run beyond its limit, to write its last state [s]
_PR_SET_PDEATHSIG = 1
_LIBC = ctypes.CDLL(None)


@dataclass
class ProcessJob:
    """One call of a program. Its stdout and stderr go to `errors.txt` in `folder`."""

    words: list[str]
    folder: Path
    time_limit: float  # [s]


@dataclass
class _Child:
    number: int
    job: ProcessJob
    pid: int = 0
    start: float = field(default_factory=time.monotonic)
    asked_to_end: bool = False

    def launch(self) -> bool:
        """False where the program cannot be started."""
        parent = os.getpid()

        def die_with_the_parent() -> None:  # nobody would collect what it computes
            _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
            if os.getppid() != parent:  # the parent was gone before that
                os._exit(127)

        with open(open_for_writing(self.job.folder / "errors.txt"), "wb") as log:
            try:  # a group of its own: an interrupt from the terminal is ours to hand on
                process = subprocess.Popen(self.job.words, stdin=subprocess.DEVNULL, stdout=log, stderr=log, process_group=0,
                                           preexec_fn=die_with_the_parent)
            except OSError as fault:
                log.write(f"error: the program cannot be started: {fault.strerror}\n".encode())
                return False
        process.returncode = 0  # it is waited for here, with its use of resources
        self.pid = process.pid
        return True

    def ended(self) -> RunRecord | None:
        """None while it runs; one beyond its limit is asked to end, then made to."""
        pid, status, usage = os.wait4(self.pid, os.WNOHANG)
        elapsed, limit = time.monotonic() - self.start, self.job.time_limit
        if pid == 0:
            if elapsed > limit + PATIENCE or (elapsed > limit and not self.asked_to_end):
                os.kill(self.pid, signal.SIGKILL if self.asked_to_end else signal.SIGTERM)
                self.asked_to_end = True
            return None
        code = os.waitstatus_to_exitcode(status)
        return RunRecord(exit_code=max(code, -1), signal=max(0, -code), timed_out=self.asked_to_end, time_limit=limit, wall_seconds=elapsed,
                         cpu_seconds=usage.ru_utime + usage.ru_stime, peak_memory_bytes=usage.ru_maxrss * 1024)


def run_processes(jobs: Sequence[ProcessJob], at_once: int, stopped: Callable[[], bool], started: Callable[[int], None],
                  ended: Callable[[int, RunRecord], None], waiting: Callable[[], None]) -> bool:
    """Runs all jobs in their order, at most `at_once` side by side. A job beyond its limit gets SIGTERM, and SIGKILL five seconds later. Children
    end with this process, however it ends. `started(job)`; `ended(job, record)`, the record without a key; `waiting()` about ten times a second.
    False if `stopped()` was true: children were killed, and `ended` was not called for them."""
    coming, running, told = [_Child(number, job) for number, job in enumerate(jobs)][::-1], list[_Child](), time.monotonic()
    try:
        while coming or running:
            if stopped():
                return False
            while coming and len(running) < max(1, at_once):
                child = coming.pop()
                child.start = time.monotonic()
                running += [child] if child.launch() else []
                started(child.number)
                if not child.pid:
                    ended(child.number, RunRecord(exit_code=127))
            for child in list(running):
                record = child.ended()
                if record is not None:
                    running.remove(child)
                    ended(child.number, record)
            if time.monotonic() - told > 0.1:
                told = time.monotonic()
                waiting()
            time.sleep(0.005)
        return True
    finally:  # a callback has raised, or the user has had enough
        for child in running:
            os.kill(child.pid, signal.SIGKILL)
            os.waitpid(child.pid, 0)
