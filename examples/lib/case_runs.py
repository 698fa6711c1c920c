"""Runs of many cases of a scene: decks, estimates of time, taking over what is complete, going on from restart files. What examples/*/paper.py share.

A case is an object with
  name, folder, deck          its folder under the results, and the deck beside it
  summary_file, index         of the folder
  scene                       path of the scene; parameters: as --param of `courant generate`
  cards, replace              cards that the deck has beside those of the scene; [[old, new], ...] texts of it
  water                       [m2] in the box, mean over the run: for the estimate of the time alone
  kind                        cases of one kind take one time per particle and step
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import threading
import time

import yaml

EVALUATED = "evaluated.yaml"
RESTART_WORK = 1.0e9     # particle-steps between restart files: a minute or two


class Failure(Exception):
    """A run or its evaluation did not end well; the text says why."""


def age(path):
    """When a file was written; 0 if it is not there."""
    try:
        return path.stat().st_mtime
    except OSError:
        return 0


class Case:
    """One line of a table of runs with its files, and what is known of its size."""

    def __init__(self, entry, results, scenes):
        self.__dict__.update(cards="", replace=[], kind="all")
        self.__dict__.update(entry)
        self.parameters = dict(entry["parameters"])
        self.scene = scenes / self.scene
        self.folder = results / self.name
        self.deck = results / f"{self.name}.k"
        self.summary_file, self.index = self.folder / "summary.yaml", self.folder / "fields.pvd"
        self.work = self.steps = self.particles = 0  # particle-steps, steps, particles

    def summary(self):
        try:
            return yaml.safe_load(self.summary_file.read_text()) or {}
        except (OSError, yaml.YAMLError):
            return {}


def say(text=""):
    print(text, flush=True)


def duration(seconds):
    if seconds < 90:
        return f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.0f} min"
    return f"{seconds / 3600:.1f} h"


class Program:
    """The courant that runs, with all its files."""

    def __init__(self, courant):
        self.courant = pathlib.Path(courant).resolve()
        self.age = max([age(self.courant)] + [age(lib) for lib in self.courant.parent.glob("libcourant.so*")])

    def call(self, *words):
        """Runs to the end; output as text. An interrupt ends it."""
        with subprocess.Popen([self.courant, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              start_new_session=True) as child:
            try:
                out = child.communicate()[0]
            except BaseException:
                child.kill()
                raise
        if child.returncode != 0:
            raise Failure(f"courant {words[0]} ended with exit code {child.returncode}:\n{out[-2000:]}")
        return out


# ---- decks

def make_deck(run, program):
    """Generates the deck, with the run's own cards and one for restart files; one that is as before keeps its age."""
    run.deck.parent.mkdir(parents=True, exist_ok=True)
    fresh = run.deck.with_suffix(".new")
    words = [f"--param={name}={value}" for name, value in run.parameters.items()]
    program.call("generate", run.scene, "-o", fresh, *words)
    measure(run, program.call("check", fresh))
    cycles = max(1000, round(RESTART_WORK / (run.work / run.steps), -3))
    text = fresh.read_text()
    for old, new in run.replace:
        if text.count(old) != 1:
            raise Failure(f"{run.name}: the deck has these cards {text.count(old)} times, expected once:\n{old}")
        text = text.replace(old, new)
    head, end, tail = text.rpartition("*END")
    if not end:
        raise Failure(f"{fresh} has no *END")
    text = head + run.cards + f"*DATABASE_BINARY_RUNRSF\n$#    cycl        nr\n{cycles:10.0f}         1\n" + end + tail
    fresh.unlink()
    if not run.deck.exists() or run.deck.read_text() != text:
        run.deck.write_text(text)


def measure(run, report):
    """What `courant check` says of the size of a run."""
    size = re.search(r"spacing ([\d.e+-]+) \[L\], (\d+) particles", report)
    steps = re.search(r"(\d+) steps to ENDTIM", report)
    if not size or not steps:
        raise Failure("courant check does not tell spacing, particles and steps:\n" + report[-2000:])
    run.particles, run.steps = int(size[2]), int(steps[1])
    run.work = run.steps * min(run.particles, run.water / float(size[1]) ** 2)


# ---- what is there already

def is_complete(run, program):
    return run.summary().get("termination") == "normal" and age(run.summary_file) > max(age(run.deck), program.age)


def can_go_on(run, program):
    """A run of this deck by this program was stopped or killed and left a restart file."""
    files = list((run.folder / "restart").glob("*.h5"))
    newest = max(map(age, files), default=0)
    return newest > max(age(run.deck), program.age) and run.summary().get("termination") in (None, "interrupted")


# ---- running

class Clock:
    """Estimates: particles x steps x ns per particle and step, the last one from runs of the kind that are done.

    first_guess: ns by kind on one thread, until a run has reported."""

    def __init__(self, runs, threads, first_guess):
        self.threads, self.first_guess, self.rates, self.ratios = threads, first_guess, {kind: [] for kind in first_guess}, []
        for run in runs:
            self.learn(run)

    def learn(self, run):
        summary = run.summary()
        if summary.get("termination") != "normal" or summary.get("threads") != self.threads or not run.work:
            return
        self.rates[run.kind].append(summary["elapsed_ns_per_particle_step"])
        self.ratios.append(summary["particle_steps"] / run.work)

    def seconds(self, run):
        rates = self.rates[run.kind]
        ns = statistics.median(rates) if rates else self.first_guess[run.kind] / self.threads**0.8
        work = statistics.median(self.ratios) if self.ratios else 1
        return run.work * work * ns * 1e-9


def reached(run):
    """The time of the last field state."""
    times = re.findall(r'timestep="([^"]*)"', run.index.read_text()) if run.index.is_file() else []
    return float(times[-1]) if times else 0.0


class Queue:
    """The runs that are still to do, which jobs take one after the other; `stop`: an interrupt has come."""

    def __init__(self, runs, clock, jobs):
        self.left, self.clock, self.jobs, self.stop = list(runs), clock, jobs, threading.Event()

    def seconds(self):
        """What those that nobody has taken yet will need."""
        return sum(map(self.clock.seconds, self.left)) / self.jobs


def watch(child, run, queue, clock):
    """Tells now and then how far a run is, until it ends."""
    end, begin, start = run.parameters["endtim"], reached(run), time.time()
    terminal, told = sys.stdout.isatty() and queue.jobs == 1, start
    while True:
        if queue.stop.is_set():
            raise KeyboardInterrupt
        try:
            child.wait(0.1)  # an interrupt must not wait for long, either
            break
        except subprocess.TimeoutExpired:
            pass
        if time.time() - told < (5 if terminal else 120):
            continue
        told, t = time.time(), reached(run)
        if t <= begin + 0.02 * end:
            left = clock.seconds(run) * (1 - begin / end) - (told - start)
        else:
            left = (told - start) * (end - t) / (t - begin)
        text = f"  {run.name}: t = {t:.2f} of {end:g} s, {duration(max(0, left))} left; all runs {duration(max(0, left) + queue.seconds())}"
        print(f"\r{text:<78}" if terminal else text, end="" if terminal else "\n", flush=True)
    if terminal and told != start:
        print("\r" + " " * 78 + "\r", end="")


def execute(run, program, threads, queue, clock):
    if queue.stop.is_set():
        raise KeyboardInterrupt
    queue.left.remove(run)
    words = [program.courant, "run", run.deck, "-o", run.folder, "--threads", threads, "--quiet"]
    if can_go_on(run, program):
        words += ["--restart", run.folder]
        say(f"{run.name}: goes on from its restart file at t = {reached(run):.2f} s")
    else:
        for stale in (run.summary_file, run.folder / EVALUATED, run.index):
            stale.unlink(missing_ok=True)
        say(f"{run.name}: runs, {run.particles} particles, {run.steps} steps, about {duration(clock.seconds(run))}")
    run.folder.mkdir(parents=True, exist_ok=True)
    # a session of its own: Ctrl-C reaches it once, through us
    log = open(run.folder / "messages.txt", "w")
    child = subprocess.Popen(list(map(str, words)), stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
    try:
        watch(child, run, queue, clock)
    except KeyboardInterrupt:
        child.send_signal(signal.SIGINT)
        child.wait()
        raise
    finally:
        log.close()
    summary = run.summary()
    if child.returncode != 0 or summary.get("termination") != "normal":
        reason = summary.get("reason") or (run.folder / "messages.txt").read_text()[-2000:].strip()
        raise Failure(f"the run ended with exit code {child.returncode}: {reason}")
    clock.learn(run)
    say(f"  {run.name}: done in {duration(summary['wall_seconds'])}, {summary['elapsed_ns_per_particle_step']:.0f} ns per particle and step")


# ---- the whole

def work_through(chosen, program, options, first_guess, evaluate):
    """Runs and evaluates; names of what failed. options: threads, jobs; evaluate(run): what is done with one that is complete."""
    failed = []
    clock = Clock(chosen, options.threads, first_guess)
    waiting = [run for run in chosen if not is_complete(run, program)]
    for run in chosen:
        say(f"  {run.name:<10} " + ("is complete" if run not in waiting else f"about {duration(clock.seconds(run))} on {options.threads} thread(s)"))
    if waiting:
        say(f"  all together about {duration(sum(map(clock.seconds, waiting)) / options.jobs)}; Ctrl-C stops, the same command goes on")
    queue = Queue(waiting, clock, options.jobs)
    order = list(chosen)
    if options.jobs > 1:  # the longest first, so that none is alone at the end
        order.sort(key=lambda run: clock.seconds(run) if run in waiting else 0, reverse=True)

    def work(run):
        if run in waiting:
            execute(run, program, options.threads, queue, clock)
        evaluate(run)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        try:
            jobs = {pool.submit(work, run): run for run in order}
            for job in concurrent.futures.as_completed(jobs):
                try:
                    job.result()
                except (Failure, OSError) as error:
                    failed.append(jobs[job].name)
                    say(f"FAILED {jobs[job].name}: {error}")
        except BaseException:
            queue.stop.set()
            raise
    return failed


def interruptible():
    """Signals to end become KeyboardInterrupt; SIGINT, too: it is ignored where a shell started us behind itself."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.default_int_handler)


def read_options(usage, project, name, groups=()):
    """Options that all scripts have, and a flag for each of `groups`; results and page are called by `name` unless they are reported."""
    parser = argparse.ArgumentParser(usage=usage, add_help=False)
    parser.add_argument("--courant", required=True)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--threads", type=int)
    parser.add_argument("--only", default="")
    for group in groups:
        parser.add_argument(f"--{group}", action="store_true")
    parser.add_argument("--results", type=pathlib.Path)
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    if options.threads is None:
        options.threads = max(1, os.cpu_count() // max(1, options.jobs))
    if options.threads < 1 or options.jobs < 1:
        parser.error("--threads and --jobs need a number from 1 on")
    options.results = (options.results or project / "results" / (f"{name}_quick" if options.quick else f"{name}_paper")).resolve()
    options.page = (options.page or (options.results / "page.md" if options.quick else project / "docs" / f"{name}_paper.md")).resolve()
    return options


def named(runs, only, names_of, shown):
    """Runs of which one of names_of(run) is among `only`, separated by commas; ends the script where a name is unknown. shown(run): the name to tell then."""
    names = set(only.split(","))
    unknown = names - {name for run in runs for name in names_of(run)}
    if unknown:
        say(f"--only: there is no run {', '.join(sorted(unknown))}; there are {', '.join(dict.fromkeys(map(shown, runs)))}")
        sys.exit(2)
    return [run for run in runs if set(names_of(run)) & names]


def carry_out(chosen, program, options, first_guess, evaluate, write):
    """Makes decks, runs and evaluates; write(): the pages. The exit code."""
    try:
        for run in chosen:
            make_deck(run, program)
        failed = work_through(chosen, program, options, first_guess, evaluate)
        pages = write()
    except Failure as error:
        say(f"Stopped: {error}")
        return 1
    except KeyboardInterrupt:
        say("\nInterrupted; the same command goes on from here.")
        return 130
    for page in pages:
        say(f"Page: {page}")
    if failed:
        say(f"{len(failed)} of {len(chosen)} runs failed: {', '.join(failed)}")
    return 1 if failed else 0
