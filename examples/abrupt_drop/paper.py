#!/usr/bin/env python3
"""
Runs and evaluates the seven tests of De Padova, Mossa and Sibilla (2017) and writes docs/abrupt_drop_paper.md.

usage: bash examples/abrupt_drop/paper.sh [options]

  --jobs N          runs at a time (1): two runs on a thread each take less time than one after the other on two
  --threads N       threads of each run (all cores, shared among the jobs)
  --only NAME,...   these runs of paper_runs.yaml (T1, T4, T1_mixing, ...) alone
  --study           also test T1 at more spacings, and the level at the end swept up and down: hours
  --results FOLDER  where runs go (results/abrupt_drop_paper)
  --page FILE       the page (docs/abrupt_drop_paper.md); beside it go figures/abrupt_drop
  --quick           0.5 s instead of each run, to try the script: results/abrupt_drop_quick, and the page in there

A complete run that is younger than its deck and the program is taken over. One that was stopped (Ctrl-C) or killed goes on from its
restart file. A run that fails is reported, the others go on. The page shows all runs that are complete in the folder.
Exit code: 0 all is done, 1 a run or its evaluation failed, 2 the call was wrong, 130 interrupted.

"""
import pathlib
import sys

import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "lib"))
import paper_page  # noqa: E402
from case_post import evaluate_once, post, read_table, scalars  # noqa: E402
from case_runs import Case, Failure, Program, carry_out, interruptible, named, read_options, say  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
SCENES = PROJECT / "keyword_decks" / "abrupt_drop"
RECIPE = SCENES / "post.yaml"
FIRST_GUESS = {"mixing length": 2500, "others": 1000}  # ns per particle and step on one thread, until a run has reported
QUICK = {"endtim": 0.5, "settled": [0.1, 0.5], "times": [0.1, 0.2, 0.3, 0.5]}


class Run(Case):
    """A line of paper_runs.yaml."""

    def __init__(self, entry, tests, results, quick):
        test = tests[entry["test"]]
        parameters = {key: test[key] for key in ("y1", "yt", "v1")} | entry.get("parameters", {})
        super().__init__({"group": "tests", "water": 0.3, "notes": "", "level": None} | entry | {"parameters": parameters}, results, SCENES)
        self.experiment = test["type"]
        if quick:
            self.parameters["endtim"] = QUICK["endtim"]
            self.settled, self.times = QUICK["settled"], QUICK["times"]
        self.kind = "mixing length" if "mixing" in str(entry["scene"]) else "others"

    def spacing(self):
        return self.parameters["y1"] / self.parameters["n"]


def numbers(run):
    """What the recipe has for T1, for this run."""
    p, (begin, end) = run.parameters, run.settled
    q = 1000 * p["v1"] * p["y1"]
    return {"&h": round(1.2 * run.spacing(), 6), "&y1": p["y1"], "&v1": p["v1"], "&yt": p["yt"], "&q": round(q, 3), "inflow /": round(q, 3), "outflow /": round(q, 3),
            "&half": p["y1"] / 2, "&c0": p.get("c0", 30), "&from": begin, "&to": end, "&segment": round(min(25, (end - begin) / 2), 3), "&times": run.times}


def measure(run, program, threads):
    """results.yaml of the recipe; where the jump has run up to the inlet, without the gauge upstream of its toe."""
    try:
        return post(run, program, RECIPE, numbers(run), threads)
    except Failure as error:
        if "@-0.1" not in RECIPE.read_text() or "level" not in str(error):
            raise
    say(f"{run.name}: is evaluated without the gauge upstream of the toe, where no water is")
    short = run.folder / "without_upstream_gauge.yaml"
    short.write_text("".join(line.replace("distances: [-0.1, ", "distances: [") for line in RECIPE.read_text().splitlines(True) if "@-0.1" not in line))
    return post(run, program, short, numbers(run), threads)


def evaluate(run, program, threads):
    asked = {"settled": list(run.settled), "times": list(run.times), "test": run.test}

    def work():
        results = measure(run, program, threads)
        out = scalars(results)
        out["regime_word"] = results["analyses"]["types"].get("regime", "")
        switches = run.folder / "abrupt_drop" / "types_switches.csv"
        out["switches"] = read_table(switches) if switches.is_file() else {}
        return out

    evaluate_once(run, program, asked, [pathlib.Path(__file__), *SCENES.glob("*.yaml")], work, say)


def choose(runs, options):
    if options.only:
        return named(runs, options.only, lambda run: (run.name,), lambda run: run.name)
    return [run for run in runs if run.group != "study" or options.study]


def main():
    options = read_options(__doc__, PROJECT, "abrupt_drop", ("study",))
    interruptible()
    table = yaml.safe_load((HERE / "paper_runs.yaml").read_text())
    options.results.mkdir(parents=True, exist_ok=True)
    runs = [Run(entry, table["tests"], options.results, options.quick) for entry in table["runs"]]
    program = Program(options.courant)
    return carry_out(choose(runs, options), program, options, FIRST_GUESS, lambda run: evaluate(run, program, options.threads),
                     lambda: [paper_page.write(options, runs, program, PROJECT)])


if __name__ == "__main__":
    sys.exit(main())
