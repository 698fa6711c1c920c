#!/usr/bin/env python3
"""Runs the decks of structures by others to their ends, beside facts that were counted without a solver.

usage: deck_runs.py COURANT SOURCE_DIR [--write] [--only WORD] [--limit SECONDS]

The decks are in structures/ of the folder COURANT_CORPUS, else of ../shared/decks beside the project, with FACTS.yaml: masses, kinetic energies and
first steps by the nodes and elements alone. A deck passes if its run ends at its end time with a verdict that is not *broken*, with the mass, where it asks for histories, within 0.1 %.
A first step above the one counted is a fault, too: below it may be, where contact, viscosity or the mesh's frequency shorten it. --write
makes the last section of docs/conformance.md. Takes minutes, so ctest leaves it out.
"""
import argparse
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import h5py
import yaml

HEADING = "## Runs of decks of structures"


def run(courant, deck, folder, limit):
    """(summary, first step, seconds, what went wrong)"""
    start = time.monotonic()
    command = [courant, "run", deck.name, "-o", str(folder), "--no-final-dump", "--threads", "1"]
    try:
        done = subprocess.run(command, cwd=deck.parent, text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=limit)
    except subprocess.TimeoutExpired:
        return {}, None, limit, f"still running after {limit} s"
    seconds = time.monotonic() - start
    summary = folder / "summary.yaml"
    first = re.search(r"first step ([\d.E+-]+)", done.stdout)
    if done.returncode or not summary.exists() or not first:
        errors = [line for line in done.stdout.splitlines() if "error: " in line]
        return {}, None, seconds, errors[0].split("error: ")[-1] if errors else done.stdout[-300:]
    return yaml.safe_load(summary.read_text()), float(first.group(1)), seconds, ""


def start_of(folder):
    """Mass and kinetic energy; not a number where the deck asks for no history."""
    if not (folder / "history.h5").exists():
        return math.nan, math.nan
    with h5py.File(folder / "history.h5") as file:
        return float(file["global/mass"][0]), float(file["global/kinetic"][0])


def judge(name, fact, summary, first, found, wrong):
    """Row of the table and whether the deck passes."""
    if wrong:
        return [wrong], False
    faults = []
    mass, kinetic = found
    if not fact.get("mass_by_card") and abs(mass / fact["mass"] - 1) > 1e-3:
        faults.append(f"mass is {mass:.6g}")
    counted = (fact.get("first_step") or {}).get("times_tssfac")
    if counted and first > 1.0001 * counted:
        faults.append("first step is longer than counted")
    if summary["verdict"] == "broken" or summary["termination"] != "normal":
        faults.append(f"ended: {summary['reason']}, verdict {summary['verdict']}")
    energy = summary["energy"]
    reasons = "; ".join(str(r).split(":")[0] for r in summary.get("verdict_reasons") or [])
    found_or_not = lambda value: "-" if math.isnan(value) else f"{value:.5g}"
    row = [f"{found_or_not(mass)} / {fact['mass']:.5g}", f"{found_or_not(kinetic)} / {fact.get('kinetic_energy_0') or 0:.5g}",
           f"{first:.4g} / {counted:.4g}" if counted else f"{first:.4g} /", f"{summary['time']:.4g} / {fact['end_time']:.4g}",
           f"{100 * energy['error']:.2g} %", summary["verdict"] + (f": {reasons}" if reasons else "") + ("; **" + ", ".join(faults) + "**" if faults else "")]
    return row, not faults


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("courant", type=pathlib.Path)
    options.add_argument("source", type=pathlib.Path)
    options.add_argument("--write", action="store_true")
    options.add_argument("--only", default="")
    options.add_argument("--limit", type=float, default=600)
    a = options.parse_args()
    decks = pathlib.Path(os.environ.get("COURANT_CORPUS", a.source.resolve().parent / "shared" / "decks")) / "structures"
    if not (decks / "FACTS.yaml").exists():
        print(f"no {decks / 'FACTS.yaml'}: skipped")
        return 77
    facts = yaml.safe_load((decks / "FACTS.yaml").read_text())
    rows, failed = [], 0
    for name, fact in facts.items():
        if a.only not in name:
            continue
        fact["mass_by_card"] = bool(re.search(r"(?m)^\*PART_INERTIA", (decks / name).read_text(errors="replace")))
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "out"
            summary, first, seconds, wrong = run(a.courant.resolve(), decks / name, out, a.limit)
            row, passes = judge(name, fact, summary, first, None if wrong else start_of(out), wrong)
        failed += not passes
        rows.append([f"`{name}`", *row, f"{seconds:.1f}"])
        print(("ok      " if passes else "FAILED  ") + " | ".join(rows[-1]), flush=True)
    if a.write:
        page = a.source / "docs" / "conformance.md"
        before = page.read_text().split(HEADING)[0].rstrip("\n")
        head = ["deck", "mass / counted", "kinetic energy at the start / counted", "first step / counted", "end / asked for", "energy from nowhere", "verdict", "s"]
        table = ["| " + " | ".join(line) + " |" for line in [head, ["---"] * len(head), *rows]]
        page.write_text(before + f"\n\n{HEADING}\n\nMade by `tests/regression/deck_runs.py --write`, on one thread of a busy machine, in the units of each deck. What is counted is counted from nodes and "
                        "elements alone, without contact,\nviscosity and rigid parts, which shorten first steps, and without `*INITIAL_VELOCITY_RIGID_BODY`.\n\n" + "\n".join(table) + "\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
