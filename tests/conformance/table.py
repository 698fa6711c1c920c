#!/usr/bin/env python3
"""What becomes of decks that others wrote: accepted, run, verdict, energy, and why not; and what to honour next.

usage: table.py COURANT FOLDER... [--seconds N] [--no-runs] [--write FILE]

Every file of the folders that ends a keyword deck (`*CONTROL_TERMINATION` in it) is checked as it is, and run for N seconds at most (60). The table
has a line for each. Below it stand the reasons of refusals in a greedy order: each one is that which, together with those above it, opens most decks.
Ends with 1 where a deck neither is accepted nor names an error, or where a run ends without a verdict.
"""
import argparse
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

SUFFIXES = {".k", ".key", ".dyn", ".inp"}


def decks_in(folders):
    for folder in map(pathlib.Path, folders):
        for path in sorted(p for p in folder.rglob("*") if p.suffix.lower() in SUFFIXES):
            text = path.read_text(encoding="latin-1", errors="replace")
            if re.search(r"^\*CONTROL_TERMINATION", text, re.M | re.I):
                yield folder, path


def reasons_of(messages):
    """Errors of a deck without places and numbers: the keyword, the field, what is wrong with it."""
    out = []
    for text in re.findall(r"error: (.*)", messages):
        field = re.match(r"\*?(\S+?)(?: card \d+)?(?: field \d+)? \((\S+?),.*?\[.*?\]\): (.*)", text)
        text = f"*{field.group(1)} {field.group(2)}: {field.group(3)}" if field else text
        text = re.sub(r"'[^']*'", "'...'", text)
        out.append(re.sub(r"(?<![\w*])-?\d+(\.\d+)?([eE][+-]?\d+)?", "N", text))
    return sorted(set(out))


def call(command, seconds, **more):
    try:
        done = subprocess.run(command, text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds, **more)
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired as late:
        return None, (late.stdout or b"").decode(errors="replace") if isinstance(late.stdout, bytes) else late.stdout or ""


def look_at(courant, path, seconds, runs):
    """One line of the table: a dictionary."""
    code, text = call([courant, "check", path.name], 60, cwd=path.parent)
    row = {"accepted": code == 0, "reasons": reasons_of(text), "runs": "", "verdict": "", "energy": "", "fault": ""}
    if code is None or (code != 0 and not row["reasons"]):
        row["fault"] = "check ends without a word" if code is not None else "check hangs"
    if not row["accepted"] or not runs:
        return row
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "run"
        code, text = call([courant, "run", path.name, "-o", str(out), "--threads", "1", "--no-final-dump"], seconds, cwd=path.parent)
        summary = out / "summary.yaml"
        if code is None:
            row["runs"] = f"still running after {seconds} s"
        elif not summary.exists():
            row["runs"], row["fault"] = f"ends with {code}", "no summary"
        else:
            found = yaml.safe_load(summary.read_text())
            energy = found.get("energy") or {}
            row["runs"], row["verdict"] = found["termination"], found.get("verdict", "")
            row["energy"] = f"{100 * float(energy.get('error', 0)):.3g} %"
            if row["verdict"] not in ("sound", "doubtful", "broken"):
                row["fault"] = "no verdict"
    return row


def next_to_honour(rows):
    """(reason, decks opened with it and those above it, decks it stops), the most useful first."""
    stopped = [set(row["reasons"]) for row in rows if not row["accepted"] and row["reasons"]]
    count = collections.Counter(reason for reasons in stopped for reason in reasons)
    done, out = set(), []
    while len(done) < len(count):
        def use(reason):
            return sum(reasons <= done | {reason} and not reasons <= done for reasons in stopped), count[reason], reason
        best = max((r for r in count if r not in done), key=use)
        out.append((best, use(best)[0], count[best]))
        done.add(best)
    return out


def report(found):
    accepted = sum(row["accepted"] for _, row in found)
    ended = [row for _, row in found if row["runs"] == "normal"]
    sound = sum(row["verdict"] == "sound" for row in ended)
    lines = [f"{len(found)} decks: {accepted} are accepted as they are, {len(ended)} of these run to their end, {sound} of those sound.", "",
             "| deck | accepted | runs | verdict | energy from nowhere | why not |", "|---|---|---|---|---|---|"]
    for name, row in found:
        why = "; ".join(row["reasons"][:3]) + (f"; and {len(row['reasons']) - 3} more" if len(row["reasons"]) > 3 else "")
        why = why if not row["accepted"] else row["fault"]
        lines.append(f"| {name} | {'yes' if row['accepted'] else 'no'} | {row['runs']} | {row['verdict']} | {row['energy']} | {why.replace('|', '/')} |")
    ranking = next_to_honour([row for _, row in found])
    if ranking:
        lines += ["", "What to honour next: each reason opens so many decks once those above it are honoured, and stops so many.", "",
                  "| reason | opens | stops |", "|---|---|---|"]
        lines += [f"| {reason.replace('|', '/')} | {opens} | {stops} |" for reason, opens, stops in ranking]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("courant")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--no-runs", action="store_true")
    parser.add_argument("--write")
    args = parser.parse_args()
    there = [folder for folder in args.folders if pathlib.Path(folder).is_dir()]
    if not there:
        print("skipped: none of the folders is there")
        return 77
    courant = str(pathlib.Path(args.courant).resolve())
    found = [(str(path.relative_to(folder.parent)), look_at(courant, path, args.seconds, not args.no_runs)) for folder, path in decks_in(there)]
    text = report(found)
    print(text)
    if args.write:
        pathlib.Path(args.write).write_text(text)
    faults = [name for name, row in found if row["fault"]]
    print("\n".join(f"fault: {name}" for name in faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
