#!/usr/bin/env python3
"""Do the tests notice broken structures? Puts every change of structures.yaml and structures_ROOM.yaml behind a switch into the tree that BUILD
belongs to, builds its tests once, and runs those that a change names with the change switched on. Then the tree is as before.

usage: structures.py BUILD [--only TEXT] [--jobs J]

BUILD is the build folder of a tree that nobody works in (`git worktree add ../mutants`), configured with COURANT_TESTS. Exits with 1 if
a test fails without a change, or a change without a `reason` is not noticed.
"""
import argparse
import collections
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

import yaml

HERE = pathlib.Path(__file__).resolve().parent
LONGEST = 600  # seconds
PROGRAMS = ("unit_tests", "verification_tests")


def declared():
    """Changes of structures.yaml and of the rooms beside it, structures_ROOM.yaml; each knows its room."""
    out = []
    for file in sorted(HERE.glob("structures*.yaml")):
        room = file.stem.partition("_")[2] or "structures"
        out += [{**change, "name": f"{room}: {change['name']}" if file.stem != "structures" else change["name"], "room": room}
                for change in yaml.safe_load(file.read_text())]
    return out


def misfit(change, root):
    """Empty where what a change replaces stands exactly once in its file."""
    count = (root / change["file"]).read_text().count(change["find"])
    return "" if count == 1 else f"'{change['find']}' stands {count} times in {change['file']}, not once"


def switched(change, number):
    """`instead` replaces an expression, `replace` of any text; {on} in it is true where the change is on."""
    on = f"courant_mutants::on({number})"
    return f"({on} ? ({change['instead']}) : ({change['find']}))" if "instead" in change else change["replace"].replace("{on}", on)


def run(program, tests, number=None):
    environment = {**os.environ, "GTEST_FAIL_FAST": "1", "OMP_NUM_THREADS": "2", "GTEST_FILTER": tests}
    if number is not None:
        environment["COURANT_MUTANT"] = str(number)
    try:
        done = subprocess.run([program], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                              timeout=LONGEST, check=False)
    except subprocess.TimeoutExpired:
        return "no end"
    failed = re.findall(r"^\[  FAILED  \] (\S+?),? .*\(\d+ ms\)$", done.stdout, re.M)
    return "" if done.returncode == 0 else failed[0] if failed else f"ended with {done.returncode}"


def suites(program):
    listed = subprocess.run([program, "--gtest_list_tests"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return {line.split("#")[0].strip()[:-1] for line in listed.splitlines() if line and not line.startswith(" ")}


def noticed(build, of_program, change, number=None):
    """By which test, "" if by none."""
    for program, known in of_program.items():
        tests = ":".join(t for t in change["tests"] if t.partition(".")[0] in known)
        if tests and (who := run(build / "tests" / program, tests, number)):
            return who
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", default="", help="changes whose name or file contains this")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    cache = (build / "CMakeCache.txt").read_text()
    root = pathlib.Path(re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache, re.M)[1])
    changes = [c for c in declared() if arguments.only in c["name"] or arguments.only in c["file"]]
    if faults := [f"{c['name']}: {fault}" for c in changes if (fault := misfit(c, root))]:
        sys.exit("\n".join(faults))
    before = {name: (root / name).read_text() for name in {c["file"] for c in changes}}
    targets = ["ninja", "-C", build, f"-j{arguments.jobs}", "-k0", "verification_tests", "unit_tests"]
    try:
        for name, text in before.items():
            for number, change in enumerate(changes):
                if change["file"] == name:
                    text = text.replace(change["find"], switched(change, number))
            (root / name).write_text(f'#include "{HERE}/mutants.hpp"\n{text}')
        made = subprocess.run(targets, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if made.returncode != 0:
            sys.exit("\n".join(line for line in made.stdout.splitlines() if "error" in line) or made.stdout)
        of_program = {name: suites(build / "tests" / name) for name in PROGRAMS}
        of_tests = collections.defaultdict(list)
        for change in changes:
            of_tests[tuple(change["tests"])].append(change)
        for tests, same in of_tests.items():
            if who := noticed(build, of_program, same[0]):
                sys.exit(f"{who} fails without a change")
        unnoticed, rooms = 0, collections.defaultdict(lambda: [0, 0])
        with concurrent.futures.ThreadPoolExecutor(max(1, arguments.jobs // 2)) as pool:
            for change, who in zip(changes, pool.map(lambda pair: noticed(build, of_program, pair[1], pair[0]), enumerate(changes))):
                reason = change.get("reason", "")
                unnoticed += not who and not reason
                rooms[change["room"]][0] += bool(who)
                rooms[change["room"]][1] += 1
                print(f"{change['name']}: {who or 'NOT NOTICED' + (': ' + reason if reason else '')}", flush=True)
        for room, (seen, all_) in sorted(rooms.items()):
            print(f"{room}: {seen} of {all_} are noticed")
        print(f"{len(changes) - unnoticed} of {len(changes)} are noticed, or need not be")
        return 1 if unnoticed else 0
    finally:
        for name, text in before.items():
            (root / name).write_text(text)


if __name__ == "__main__":
    sys.exit(main())
