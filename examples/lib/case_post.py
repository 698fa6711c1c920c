"""Measures runs by recipes of `courant post` whose numbers are changed, and reads the tables. What examples/*/paper_evaluate.py share."""
import csv
import math
import re
import shutil

import yaml

from case_runs import EVALUATED, Failure, age


def with_numbers(text, numbers):
    """A recipe with other numbers, texts or lists behind its anchors (&from) or keys (segment:)."""
    for key, value in numbers.items():
        text, count = re.subn(re.escape(key) + r'\s+("[^"]*"|\[[^\]]*\]|[^\s,}\]]+)', f"{key} {value}", text)
        if count != 1:
            raise Failure(f"the recipe has '{key}' {count} times, expected once")
    return text


def read_table(path):
    """Columns of a CSV file by name; heads such as `vx_mean [m/s]` lose their unit."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name.split(" [")[0]: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def mean(values):
    values = [v for v in values if not math.isnan(v)]
    return sum(values) / len(values) if values else math.nan


def at(xs, ys, x):
    """Linear between the points of a table."""
    for a, b, ya, yb in zip(xs, xs[1:], ys, ys[1:]):
        if a <= x <= b:
            return ya + (yb - ya) * (x - a) / (b - a)
    return math.nan


def post(run, program, recipe, numbers, threads):
    """Measures by a recipe with these numbers; its results.yaml."""
    copy = run.folder / f"recipe_{recipe.name}"
    copy.write_text(with_numbers(recipe.read_text(), numbers))
    program.call("post", copy, run.folder, "--threads", threads)
    kept = run.folder / f"results_{recipe.name}"
    shutil.copy(run.folder / "results.yaml", kept)
    return yaml.safe_load(kept.read_text())


def scalars(results):
    """Single numbers of all analyses: {analysis: {name: value}}; words are left out."""
    return {name: {key: float(one["value"]) for key, one in numbers.items() if isinstance(one, dict)} for name, numbers in results["analyses"].items()}


# ---- evaluations that are kept

def evaluated(run):
    """What `evaluate_once` kept, or None."""
    try:
        found = yaml.safe_load((run.folder / EVALUATED).read_text())
    except (OSError, yaml.YAMLError):
        return None
    return found if isinstance(found, dict) else None


def is_fresh(run, program, asked, made_from):
    if age(run.folder / EVALUATED) <= max(program.age, age(run.summary_file), *map(age, made_from)):
        return False
    before = evaluated(run)
    return before is not None and before.get("asked") == asked


def evaluate_once(run, program, asked, made_from, work, say):
    """Keeps what work() finds, {analysis: {name: number}}, with the run's summary in evaluated.yaml; does nothing where that is younger than the files it is
    made from and was asked the same."""
    if is_fresh(run, program, asked, made_from):
        return
    say(f"{run.name}: is evaluated")
    out = work()
    summary = run.summary()
    energy = summary["energy"]
    out["run"] = {key: summary[key] for key in ("version", "threads", "particles", "steps", "particle_steps", "wall_seconds", "cpu_seconds",
                                                "ns_per_particle_step", "leaked_particles", "max_penetration")}
    out["run"]["residual"] = abs(energy["residual"]) / energy["throughput"]
    out["run"]["settled"] = list(run.settled)
    out["asked"] = asked
    half = run.folder / (EVALUATED + ".tmp")  # a full disk or a kill leaves no half of the file under its name
    half.write_text(yaml.safe_dump(out, sort_keys=False))
    half.replace(run.folder / EVALUATED)
