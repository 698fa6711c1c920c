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

from .record import RunRecord

PATIENCE = 5.0  # of a run beyond its limit, to write its last state [s]
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
    job: int
    pid: int
    start: float = field(default_factory=time.monotonic)
    asked_to_end: bool = False


def _start(job: ProcessJob) -> int:
    """Process id of the program."""
    parent = os.getpid()

    def die_with_the_parent() -> None:  # nobody would collect what it computes
        _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:  # the parent was gone before that
            os._exit(127)

    with open(job.folder / "errors.txt", "wb") as log:
        try:
            process = subprocess.Popen(job.words, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                       preexec_fn=die_with_the_parent,  # one thread, and nothing is locked
                                       process_group=0)  # an interrupt from the terminal is ours to hand on
        except OSError as fault:
            log.write(f"error: the program cannot be started: {fault.strerror}\n".encode())
            return 0
    process.returncode = 0  # it is waited for here, with its use of resources
    return process.pid


class _Processes:
    def __init__(self, jobs: Sequence[ProcessJob], started: Callable[[int], None],
                 ended: Callable[[int, RunRecord], None]) -> None:
        self.jobs, self.started, self.ended = jobs, started, ended
        self.running: list[_Child] = []

    def begin(self, job: int) -> None:
        pid = _start(self.jobs[job])
        self.started(job)
        if pid > 0:
            self.running.append(_Child(job, pid))
        else:
            self.ended(job, RunRecord(exit_code=127))

    def collect(self) -> None:
        for child in list(self.running):
            pid, status, usage = os.wait4(child.pid, os.WNOHANG)
            if pid == 0:
                self._limit(child)
                continue
            self.running.remove(child)
            code = os.waitstatus_to_exitcode(status)
            self.ended(child.job, RunRecord(
                exit_code=code if code >= 0 else -1, signal=max(0, -code), timed_out=child.asked_to_end,
                time_limit=self.jobs[child.job].time_limit, wall_seconds=time.monotonic() - child.start,
                cpu_seconds=usage.ru_utime + usage.ru_stime, peak_memory_bytes=usage.ru_maxrss * 1024))

    def _limit(self, child: _Child) -> None:
        elapsed, limit = time.monotonic() - child.start, self.jobs[child.job].time_limit
        if elapsed > limit + PATIENCE:
            os.kill(child.pid, signal.SIGKILL)
        elif elapsed > limit and not child.asked_to_end:
            os.kill(child.pid, signal.SIGTERM)
            child.asked_to_end = True

    def kill(self) -> None:
        for child in self.running:
            os.kill(child.pid, signal.SIGKILL)
            os.waitpid(child.pid, 0)
        self.running.clear()


def run_processes(jobs: Sequence[ProcessJob], at_once: int, stopped: Callable[[], bool], started: Callable[[int], None],
                  ended: Callable[[int, RunRecord], None], waiting: Callable[[], None]) -> bool:
    """Runs all jobs in their order, at most `at_once` side by side.

    A job beyond its limit gets SIGTERM, and SIGKILL five seconds later. Children end with this process, however it
    ends. `started(job)`; `ended(job, record)`, the record without a key; `waiting()` about ten times a second. False
    if `stopped()` was true: children were killed, and `ended` was not called for them.
    """
    processes, following, told = _Processes(jobs, started, ended), 0, time.monotonic()
    try:
        while following < len(jobs) or processes.running:
            if stopped():
                return False
            while following < len(jobs) and len(processes.running) < max(1, at_once):
                following += 1
                processes.begin(following - 1)
            processes.collect()
            if time.monotonic() - told > 0.1:
                told = time.monotonic()
                waiting()
            time.sleep(0.005)
        return True
    finally:  # a callback has raised, or the user has had enough
        processes.kill()
