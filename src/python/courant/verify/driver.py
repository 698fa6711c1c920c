"""`courant verify`: all runs of a suite, what is observed in them, and what that comes to."""
from __future__ import annotations

import fcntl
import os
import platform
import re
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from ..diagnostics import Diagnostics
from ..files import OutputError, make_folder, move, open_for_writing, write_file
from ..terminal import processors
from ..words import nearest_word
from .builders import BuildFault
from .digest import digest, digest_of_build, digest_of_deck, digest_of_files
from .errors import compare_observation
from .judge import check_bounds, judge_stability, measured_orders
from .model import Case, CaseResult, RunResult, Suite, SuiteResult, Verdict
from .observe import Measured, observe_run
from .picture import draw_particles
from .plan import PlannedRun, plan_runs
from .processes import ProcessJob, run_processes
from .record import RunRecord, read_record, result_of_run, says_something_of_the_deck, write_record
from .scene import scene_files
from .schedule import RunSchedule, duration_text


@dataclass
class Options:
    folder: Path  # for runs and results; made if missing
    executable: Path  # that is called as `EXECUTABLE run DECK -o FOLDER ...`
    jobs: int = 0  # runs at once; 0: one per core
    fresh: bool = False  # take over nothing from earlier calls
    only: list[str] = field(default_factory=list)  # names of cases; empty: all
    stopped: Callable[[], bool] = lambda: False
    print: Callable[[str], None] = lambda line: None  # a line per finished run
    progress: Callable[[str], None] | None = None  # a line that replaces the one before


class Refused(Exception):
    """Nothing was run; the diagnostics tell why."""


class Interrupted(Exception):
    """Runs that ended are kept."""


def machine() -> str:
    """ "PROCESSOR, N cores, SYSTEM RELEASE"."""
    try:
        info = Path("/proc/cpuinfo").read_text("utf-8", "replace")
    except OSError:
        info = ""
    model = re.search(r"^model name\s*: (.*)$", info, re.M)
    return f"{model[1] if model else 'unknown processor'}, {os.cpu_count()} cores, {platform.system()} {platform.release()}"


@contextmanager
def _locked(folder: Path, diagnostics: Diagnostics) -> Iterator[None]:
    """Keeps a second call out of the folder, and marks it as ours. Raises Refused, OutputError."""
    file, hint = folder / ".courant_verify", "choose another folder with -o"
    if (folder / "runs").exists() and not file.exists():
        diagnostics.error(folder, "the folder holds something else called 'runs'", hint)
        raise Refused
    descriptor = open_for_writing(file, keep=True)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        diagnostics.error(folder, "another `courant verify` works in this folder", hint)
        raise Refused from None
    try:
        yield
    finally:
        os.close(descriptor)


def _add_keywords(deck: Path, keywords: str) -> None:
    """Puts cards before *END, so that they replace those of the scene."""
    text = deck.read_text()
    at = text.rindex("*END")
    write_file(deck, text[:at] + keywords.rstrip("\n") + "\n" + text[at:])


def _messages(text: str) -> list[str]:
    """What `courant generate` said is wrong: errors with the lines that belong to them."""
    parts = re.split(r"^(?=\S[^\n]*?\b(?:error|warning|note): )", text, flags=re.M)
    return [part.rstrip("\n") for part in parts if re.match(r"[^\n]*\berror: ", part)]


class Verification:
    """One call, from the suite to its result."""

    def __init__(self, suite: Suite, options: Options) -> None:
        self.suite, self.options = suite, options
        self.jobs = processors(options.jobs)
        self.start = time.monotonic()
        self.build = digest_of_build(options.executable)
        self.runs: list[PlannedRun] = []  # planned by verify_suite
        self.scenes: dict[Path, str] = {}  # digests

    def version(self) -> str:
        try:
            said = subprocess.run([self.options.executable, "--version"], capture_output=True, text=True, timeout=60, check=False).stdout
        except (OSError, subprocess.TimeoutExpired):
            said = ""
        words = said.partition("\n")[0].split()  # the second line is how it was built
        return f"Courant {words[-1] if words else '?'} (build {self.build[:8]})"

    def scene_of(self, run: PlannedRun) -> str:
        """Digest of all that the deck of a run is made of; blank where the deck is given."""
        case = self.suite.cases[run.of_case]
        if not case.is_made:
            return ""
        source, function = (case.build.file, case.build.function) if case.build else (case.scene or Path(), "")
        if source not in self.scenes:
            self.scenes[source] = digest_of_files([source] if case.build else scene_files(source))
        return digest(self.build, self.scenes[source], source.name + function, *(f"{name}={value}" for name, value in run.parameters.items()), run.keywords)

    def generate(self, run: PlannedRun, deck: Path) -> list[str]:
        """Writes the deck of a run of a scene or builder, unless an earlier call has made the same one; returns what is wrong."""
        folder, case = self.options.folder / run.folder, self.suite.cases[run.of_case]
        before = None if self.options.fresh or case.build else read_record(folder)  # a deck is built in no time
        if self.options.stopped() or (before is not None and before.scene == self.scene_of(run)
                                      and before.key == self.key_of(run, folder / "deck.k")):
            return []
        if case.build:
            try:
                write_file(deck, case.build.deck(run.parameters))
            except BuildFault as fault:
                return [f"error: {fault}"]
            run.generated = deck
            if run.keywords:
                _add_keywords(deck, run.keywords)
            return []
        words = [str(self.options.executable), "generate", str(case.scene), "-o", str(deck)]
        for name, value in run.parameters.items():
            words += ["--param", f"{name}={value}"]
        try:
            done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", check=False, process_group=0)
        except OSError as fault:
            return [f"error: the program '{self.options.executable}' cannot be started: {fault.strerror}"]
        run.generated = deck
        if done.returncode == 0 and deck.is_file():
            if run.keywords:
                _add_keywords(deck, run.keywords)
            return []
        return _messages(done.stderr) or [f"error: `courant generate` ended with {done.returncode}: {done.stderr.strip()}"]

    def key_of(self, run: PlannedRun, deck: Path) -> str:
        """Digest of all that the results of a run follow from."""
        parameters = run.parameters if self.suite.cases[run.of_case].deck else {}
        return digest(self.build, "".join(f"{name}={value}\n" for name, value in parameters.items()), digest_of_deck(deck, parameters))

    def prepare(self, diagnostics: Diagnostics) -> None:
        """Puts the decks where they belong and finds what need not be run again. Raises Refused, OutputError."""
        for run in self.runs:
            case = self.suite.cases[run.of_case]
            run.folder = self.options.folder / run.folder
            make_folder(run.folder)
            run.deck = case.deck or run.folder / "deck.k"
            run.key = self.key_of(run, run.generated or run.deck)
            record = None if self.options.fresh else read_record(run.folder)
            if record is not None and record.key != run.key:
                record = None
            if case.is_made and run.generated is None and record is None:
                diagnostics.error(run.folder, "another call has changed the folder meanwhile", "call again")
                raise Refused
            if run.generated:
                move(run.generated, run.deck)
            bytes_ = run.deck.stat().st_size if run.deck.is_file() else 0
            # the number of steps grows with the resolution, in 2D like the root of the number of particles
            run.cost = bytes_**1.5 / (run.size**3 if case.deck and run.size > 0 else 1)
            if record is None or (record.timed_out and record.time_limit < case.time_limit):
                continue
            run.record, run.reused = record, True
            if record.scene != self.scene_of(run):  # another scene that makes the same deck
                record.scene = self.scene_of(run)
                write_record(run.folder, record)

    def execute(self) -> None:
        """Raises Interrupted."""
        order = sorted((run for run in self.runs if run.record is None), key=lambda run: -run.cost)
        if len(order) < len(self.runs):
            self.options.print(f"{len(self.runs) - len(order)} of {len(self.runs)} runs are taken over from an earlier call")
        schedule = RunSchedule([(run.of_case, run.cost) for run in order], self.jobs)

        def ended(job: int, record: RunRecord) -> None:
            schedule.ended(job, record.wall_seconds)
            self.ended(order[job], record, f"[{schedule.done}/{len(schedule)}]")

        def waiting() -> None:
            if self.options.progress:
                left = schedule.seconds_left()
                when = "time left not known yet" if left is None else f"about {duration_text(left)} left"
                self.options.progress(f"{schedule.done} of {len(schedule)} runs done, {when}")

        jobs = [self.job_of(run) for run in order]
        if not run_processes(jobs, self.jobs, self.options.stopped, schedule.started, ended, waiting):
            raise Interrupted

    def job_of(self, run: PlannedRun) -> ProcessJob:
        case = self.suite.cases[run.of_case]
        _clear(run)
        words = [str(self.options.executable), "run", str(run.deck), "-o", str(run.folder), "--threads", "1", "--no-final-dump", "--quiet"]
        for name, value in run.parameters.items() if case.deck else ():
            words += ["--param", f"{name}={value}"]
        return ProcessJob(words, run.folder, case.time_limit)

    def ended(self, run: PlannedRun, record: RunRecord, count: str) -> None:
        record.key, record.scene = run.key, self.scene_of(run)
        result = result_of_run(run.folder, record)
        if says_something_of_the_deck(record, result):
            write_record(run.folder, record)
        run.record = record
        case = self.suite.cases[run.of_case]
        verdict = "" if result.verdict == Verdict.stable else f", {result.verdict.name}: {result.reason}"
        self.options.print(f"{count} {case.name}: {run.describe(case)}: {result.wall_seconds:.1f} s, {result.steps} steps{verdict}")

    def result(self) -> SuiteResult:
        out = SuiteResult(self.suite, self.version(), machine(), time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()), jobs=self.jobs)
        for number, case in enumerate(self.suite.cases):
            if self.options.progress:
                self.options.progress(f"reading the results of {case.name}")
            out.cases.append(self.result_of_case(case, [run for run in self.runs if run.of_case == number]))
        out.wall_seconds = time.monotonic() - self.start
        return out

    def result_of_case(self, case: Case, runs: list[PlannedRun]) -> CaseResult:
        out = CaseResult(case)
        measured = []
        for run in runs:
            out.runs.append(self.result_of_run(run))
            measured.append(_measure(case, run, out.runs[-1]))
        for k, (run, result) in enumerate(zip(runs, out.runs, strict=True)):
            finest = _finest_of(runs, k)
            for o, m, best in zip(case.observations, measured[k], measured[finest], strict=True):
                result.observed.append(compare_observation(o, m, run.variables, None if finest == k else best))
            if case.stability:
                out.checks.append(judge_stability(case.stability, run.variables, result))
            else:
                result.as_required = result.verdict == Verdict.stable
        out.orders = measured_orders(case, out.runs)
        if not case.stability:
            out.checks = check_bounds(case, out.runs, out.orders)
        if case.picture_of and runs:
            shown = runs[_finest_of(runs, 0)]
            out.picture = draw_particles(case, shown.variables, shown.folder)
        return out

    def result_of_run(self, run: PlannedRun) -> RunResult:
        out = result_of_run(run.folder, run.record or RunRecord())
        out.setting, out.resolution, out.parameters = run.setting, run.resolution, run.parameters
        out.size, out.reused = run.size, run.reused
        return out


def _clear(run: PlannedRun) -> None:
    """Results of another deck or build must not pass for those of this one."""
    for path in sorted(run.folder.iterdir(), key=lambda path: path.name != "record.yaml"):
        if path == run.deck:
            continue
        try:
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            else:
                path.unlink()
        except OSError as fault:
            raise OutputError(path, fault) from fault


def _measure(case: Case, run: PlannedRun, result: RunResult) -> list[Measured]:
    """Observations of a run that came to its end; also finds garbage in its results."""
    if result.verdict <= Verdict.degraded:
        out, garbage = observe_run(case, run.variables, run.folder, case.stability is not None)
        if not garbage:
            return out
        result.verdict, result.reason = Verdict.broken, f"it ended normally, but {garbage}"
    why = f"the run was {result.verdict.name}: {result.reason}"
    return [Measured(why=why) for _ in case.observations]


def _finest_of(runs: list[PlannedRun], k: int) -> int:
    """The last run of the same setting."""
    return next((i for i in range(k, len(runs)) if runs[i].finest), len(runs) - 1)


def chosen_cases(suite: Suite, only: list[str], diagnostics: Diagnostics) -> Suite:
    """The suite with the cases asked for alone."""
    names = [case.name for case in suite.cases]
    for name in only:
        if name not in names:
            near = nearest_word(name, names)
            diagnostics.error(suite.file, f"the suite has no case '{name}'", f"did you mean {near}?" if near else f"its cases: {', '.join(names)}")
    return Suite(suite.file, suite.title, suite.about, [case for case in suite.cases if not only or case.name in only])


def verify_suite(suite: Suite, options: Options, diagnostics: Diagnostics) -> SuiteResult:
    """Generates the decks, runs them, observes and judges. Runs that an earlier call has finished in this folder, of the same deck and build, are
    taken over. Raises Refused, with messages in `diagnostics` and nothing run, if the suite is wrong or another call works in the folder;
    Interrupted; OutputError."""
    wanted = chosen_cases(suite, options.only, diagnostics)
    if not diagnostics.ok:
        raise Refused
    verification = Verification(wanted, options)
    with tempfile.TemporaryDirectory(prefix="courant_verify_") as decks:  # the folder is not touched by a wrong suite
        def generate(run: PlannedRun, number: int) -> list[str]:
            return verification.generate(run, Path(decks, f"{number}.k"))

        verification.runs = plan_runs(wanted, generate, verification.jobs, diagnostics)
        if options.stopped():
            raise Interrupted
        if not diagnostics.ok:
            raise Refused
        make_folder(options.folder)
        with _locked(options.folder, diagnostics):
            verification.prepare(diagnostics)
            verification.execute()
            return verification.result()
