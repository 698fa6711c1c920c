#!/usr/bin/env python3
"""Do the unit tests notice broken code? Changes a copy of the sources in some sixty places at once, each change behind a switch, builds it
once, and runs the tests that reach a location with the change of that location switched on.

usage: mutation.py WORK_FOLDER [--changes N] [--seed K] [--jobs J] [--retest] [--write FILE] [-- CMAKE_OPTION...]

WORK_FOLDER gets the copy, its build and state.json. A call that was interrupted goes on where it was. The seed is new each time unless
given. --retest takes the tests as they are now and asks again about the changes that were not noticed; --write puts the table into FILE
(tests/mutation/report.md). Why a change needs no test is in reasons.yaml. Exits with 1 if fewer than 90 % are noticed.
"""
import argparse
import collections
import concurrent.futures
import json
import math
import os
import pathlib
import random
import re
import secrets
import shlex
import shutil
import subprocess
import sys
import time

import yaml

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE))
import places

APART = 4  # lines between two changes of one file
ENOUGH = 0.9
ALONE = ("src/app/main.cpp", "src/app/cli.cpp", "src/app/verify.cpp",  # no part of what unit tests are linked to
         "cubic_spline_loops.cpp", "wendland_c2_loops.cpp")  # nor these, of wide vectors


def tell(text):
    print(time.strftime("%H:%M:%S"), text, file=sys.stderr, flush=True)


class Run:
    def __init__(self, arguments):
        self.work = pathlib.Path(arguments.folder).resolve()
        self.source, self.build, self.original = self.work / "source", self.work / "source/build/release", self.work / "original"
        self.file = self.work / "state.json"
        self.jobs, self.options = arguments.jobs, arguments.options
        self.environment = {**os.environ, "OMP_NUM_THREADS": "2", "OMP_WAIT_POLICY": "passive"}
        if self.file.exists():
            self.state = json.loads(self.file.read_text())
            return
        self.work.mkdir(parents=True, exist_ok=True)
        seed = arguments.seed if arguments.seed is not None else secrets.randbelow(10**9)
        self.state = {"seed": seed, "changes": arguments.changes, "chosen": None, "built": False, "tests": {}, "unsteady": [], "first": {},
                      "now": {}}
        self.save()

    def save(self):
        new = self.file.with_suffix(".new")
        new.write_text(json.dumps(self.state, indent=1))
        new.replace(self.file)

    # --- the changes -------------------------------------------------------------------------------------------------------------------

    def candidates(self):
        """For each room, its locations in the order in which the seed takes them: a kind at random first, so that no kind prevails."""
        rooms = {}
        chance = random.Random(self.state["seed"])
        for room in sorted(p for p in (self.original / "src").iterdir() if p.is_dir()):
            kinds, lines = collections.defaultdict(list), 0
            for file in sorted(room.rglob("*.[ch]pp")):
                name = str(file.relative_to(self.original))
                if name.endswith(ALONE):
                    continue
                text = file.read_text()
                lines += text.count("\n")
                for kind, begin, end, new in places.places(text):
                    kinds[kind].append({"file": name, "kind": kind, "begin": begin, "end": end, "new": new})
            order = []
            for kind in sorted(kinds):
                chance.shuffle(kinds[kind])
            while any(kinds.values()) and len(order) < 40 * self.state["changes"]:
                order.append(kinds[chance.choice(sorted(k for k in kinds if kinds[k]))].pop())
            rooms[room.name] = (lines, order)
        return rooms

    def choose(self):
        """As many of each room as the root of its lines asks for; what does not compile is replaced by the room's next."""
        rooms = {name: (lines, order) for name, (lines, order) in self.candidates().items() if order}
        total, weights = self.state["changes"], {name: math.sqrt(lines) for name, (lines, _) in rooms.items()}
        exact = {name: total * w / sum(weights.values()) for name, w in weights.items()}
        quota = {name: int(e) for name, e in exact.items()}
        for name in sorted(exact, key=lambda n: quota[n] - exact[n])[:total - sum(quota.values())]:
            quota[name] += 1
        chosen, dropped = [], []
        for name, (_, order) in rooms.items():
            order = list(order)
            while quota[name] > 0 and order:
                change = order.pop(0)
                text = (self.original / change["file"]).read_text()
                change["line"] = text.count("\n", 0, change["begin"]) + 1
                change["room"] = name
                if any(c["file"] == change["file"] and abs(c["line"] - change["line"]) < APART for c in chosen):
                    continue
                change["number"] = len(chosen) + len(dropped)
                if self.compiles(change):
                    chosen.append(change)
                    quota[name] -= 1
                else:
                    dropped.append(change)
        self.state["chosen"], self.state["dropped"] = chosen, dropped
        tell(f"seed {self.state['seed']}: {len(chosen)} changes, {len(dropped)} that do not compile were left out")
        self.save()

    def compiles(self, change):
        """Checks the file, or for a header a file that includes it, with this change alone."""
        command = self.command_of(change["file"])
        if command is None:
            return False
        text = (self.original / change["file"]).read_text()
        self.put(change["file"], changed(text, [change]))
        done = subprocess.run([*command, "-fsyntax-only", "-w", "-O0"], cwd=self.work / "check", stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              text=True)
        self.put(change["file"], text)
        tell(f"{'+' if done.returncode == 0 else '-'} {change['kind']} {change['file']}:{change['line']}")
        return done.returncode == 0

    def command_of(self, name):
        if not hasattr(self, "commands"):
            entries = json.loads((self.work / "check/compile_commands.json").read_text())
            self.commands = {str(pathlib.Path(e["file"]).relative_to(self.source)): e["command"] for e in entries
                             if e["file"].startswith(str(self.source / "src"))}
        if name.endswith(".hpp"):
            include = f'#include "{name[len("src/"):]}"'
            own = name[:-4] + ".cpp"
            users = [n for n in self.commands if include in (self.original / n).read_text()]
            name = own if own in self.commands else users[0] if users else None
        if name not in self.commands:
            return None
        words = shlex.split(self.commands[name])
        at = words.index("-o")
        return words[:at] + words[at + 2:]

    # --- the copy ----------------------------------------------------------------------------------------------------------------------

    def put(self, name, text):
        target = self.source / name
        if target.is_file() and target.read_text() == text:
            return
        target.write_text(text)

    def copy(self, only=""):
        names = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard"], check=True, stdout=subprocess.PIPE,
                               text=True).stdout.splitlines()
        for name in names:
            if name.startswith(only) and (ROOT / name).is_file():
                target, content = self.source / name, (ROOT / name).read_bytes()
                if not target.is_file() or target.read_bytes() != content:
                    target.parent.mkdir(parents=True, exist_ok=True)
                    target.write_bytes(content)
        self.put("tests/unit/base/reached_test.cpp", (HERE / "reached_test.cpp").read_text())

    def configure(self, build, *options):
        flags = f"-Og -include {self.source}/tests/mutation/mutants.hpp"
        subprocess.run(["cmake", "-S", self.source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=None", f"-DCMAKE_CXX_FLAGS={flags}",
                        "-DCOURANT_LEAVE_OUT=avx2;avx512", "-DCOURANT_TESTS=ON", *options, *self.options], check=True, stdout=subprocess.DEVNULL)

    def make(self):
        """Builds all changes at once; those at which the compiler stops after all are left out."""
        while True:
            files = collections.defaultdict(list)
            for change in self.state["chosen"]:
                files[change["file"]].append(change)
            for name in {c["file"] for c in self.state["chosen"] + self.state["dropped"]}:
                self.put(name, changed((self.original / name).read_text(), files[name]))
            tell("building")
            done = subprocess.run(["ninja", "-C", self.build, "-j", str(self.jobs), "-k", "0", "unit_tests", "courant"], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
            (self.work / "build.log").write_text(done.stdout)
            if done.returncode == 0:
                break
            at = {(m[1], int(m[2])) for m in re.finditer(rf"{re.escape(str(self.source))}/(src/[\w/.]+):(\d+)", done.stdout)}
            out = [c for c in self.state["chosen"] if (c["file"], c["line"]) in at] or \
                [c for c in self.state["chosen"] if any(c["file"] == name for name, _ in at)]
            if not out:
                sys.exit(f"mutation.py: the copy cannot be built: see {self.work / 'build.log'}")
            tell(f"left out: {', '.join(where(c) for c in out)}")
            self.state["dropped"] += out
            self.state["chosen"] = [c for c in self.state["chosen"] if c not in out]
            self.save()
        self.state["built"] = True
        self.save()

    # --- the tests ---------------------------------------------------------------------------------------------------------------------

    def run_tests(self, names, mutant=None, seconds=60.0, extra=None):
        """The first test that failed, "" if none, and how the program ended."""
        environment = {**self.environment, "GTEST_FAIL_FAST": "1", **(extra or {})}
        if mutant is not None:
            environment["COURANT_MUTANT"] = str(mutant)
        if names is not None:
            environment["GTEST_FILTER"] = ":".join(names)
        folder = self.work / "runs" / str(mutant)
        folder.mkdir(parents=True, exist_ok=True)
        environment["TMPDIR"] = str(folder)
        log = folder / "log"
        with open(log, "w") as out:
            program = subprocess.Popen([self.build / "tests/unit_tests"], stdout=out, stderr=subprocess.STDOUT, env=environment, cwd=folder)
            try:
                code = program.wait(seconds)
            except subprocess.TimeoutExpired:
                program.kill()
                program.wait()
                code = "time"
        text = log.read_text(errors="replace")
        begun = re.findall(r"^\[ RUN      \] (\S+)", text, re.M)
        failed = re.findall(r"^\[  FAILED  \] (\S+?),? .*\(\d+ ms\)$", text, re.M)
        if code == 0:
            return "", code
        return (failed or begun[-1:] or ["before any test"])[0], code

    def reach(self, late):
        """Runs all tests that are not known yet once, and notes which locations each of them reaches. `late`: they were added for --retest."""
        listed = subprocess.run([self.build / "tests/unit_tests", "--gtest_list_tests"], check=True, stdout=subprocess.PIPE, text=True).stdout
        names, suite = [], ""
        for line in listed.splitlines():
            word = line.split("#")[0].strip()
            if line.startswith(" "):
                names.append(suite + word)
            elif word.endswith("."):
                suite = word
        known = self.state["tests"]
        new = [n for n in names if n not in known and n not in self.state["unsteady"]]
        notes, map_ = self.work / "tests.txt", self.work / "reached"
        if new:
            tell(f"running {len(new)} tests without a change")
        parts = [new[at:at + 400] for at in range(0, len(new), 400)]
        while parts:
            part = parts.pop(0)
            notes.write_text("")
            map_.write_bytes(bytes(4096))
            extra = {"COURANT_MUTANTS_TESTS": str(notes), "COURANT_MUTANTS_REACHED": str(map_), "GTEST_FAIL_FAST": "0"}
            last, code = self.run_tests(part, seconds=3600, extra=extra)
            for line in notes.read_text().splitlines():
                name, milliseconds, file, numbers = line.split("\t")
                room = re.search(r"tests/unit/(\w+)/", file)
                known[name] = {"seconds": float(milliseconds) / 1000, "room": room[1] if room else "", "reached": [int(n) for n in numbers.split()],
                               "late": late}
            missing = [n for n in part if n not in known]
            if code in (0, 1) or last not in missing:
                self.state["unsteady"] += missing
            else:  # one ended the program: the others once more
                self.state["unsteady"] += [n for n in missing if n == last]
                parts.insert(0, [n for n in missing if n != last])
            self.save()
        if self.state["unsteady"]:
            tell(f"left out, as they fail without a change: {', '.join(self.state['unsteady'])}")

    def ask(self, change, order, most):
        """Runs tests with the change, until so many seconds of them have passed; those are taken off the list. None: not noticed so far."""
        tests = self.state["tests"]
        seconds = 0.0
        while order and seconds < most:
            part, sum_ = [], 0.0
            while order and len(part) < 400 and (not part or sum_ + tests[order[0]]["seconds"] < 10):
                sum_ += tests[order[0]]["seconds"]
                part.append(order.pop(0))
            seconds += sum_
            name, code = self.run_tests(part, change["number"], 60 + 20 * sum_)
            if not name:
                continue
            if code == "time":
                return {"noticed": True, "by": name, "how": "no end"}
            if name in tests and self.run_tests([name], -1 - change["number"], 60 + 20 * tests[name]["seconds"])[0]:
                order += [n for n in part if n != name]  # fails without a change, too
                continue
            return {"noticed": True, "by": name, "how": "fails" if code == 1 else "crashes"}
        return None

    def reaching(self, change, late):
        """Tests that reach its location, those that --retest found or the others."""
        tests = self.state["tests"]
        always = change["number"] in tests.get("before", {"reached": []})["reached"]
        return [n for n in tests if n != "before" and tests[n].get("late", False) == late and (always or change["number"] in tests[n]["reached"])]

    def ask_all(self, key):
        """In rounds, so that what is noticed soon is known soon."""
        tests, answers, waiting = self.state["tests"], self.state[key], []
        for change in self.state["chosen"]:
            if str(change["number"]) not in answers:
                names = sorted(self.reaching(change, key == "now"), key=lambda n: (tests[n]["room"] != change["room"], tests[n]["seconds"]))
                waiting.append((change, names, len(names)))
        for most in (10, 40, math.inf):
            with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
                asked = {pool.submit(self.ask, one[0], one[1], most): one for one in waiting}
                for done in concurrent.futures.as_completed(asked):
                    change, left, all_ = one = asked[done]
                    answer = done.result()
                    if answer is None and left:
                        continue
                    waiting.remove(one)
                    answers[str(change["number"])] = answer or {"noticed": False, "by": "", "how": "", "asked": all_}
                    self.save()
                    tell(f"{where(change)} {change['kind']}: " + (f"noticed by {answer['by']} ({answer['how']})" if answer else "NOT NOTICED"))


def where(change):
    return f"{change['file']}:{change['line']}"


def changed(text, changes):
    for change in sorted(changes, key=lambda c: -c["begin"]):
        text = text[:change["begin"]] + change["new"].format(n=change["number"]) + text[change["end"]:]
    return text


def shown(change, text):
    """The line, and what it becomes, as one would write it."""
    begin, end = text.rfind("\n", 0, change["begin"]) + 1, text.find("\n", change["begin"])
    before, old, after = text[begin:change["begin"]], text[change["begin"]:change["end"]], text[change["end"]:max(end, change["end"])]
    n, kind = change["number"], change["kind"]
    new = change["new"].format(n=n)
    if kind == "deletion":
        becomes = "(deleted)"
    elif kind == "sign":
        becomes = "the other sign of what follows" if not old.strip() in "+-" else {"+": "-", "-": "+"}[old.strip()]
    elif kind == "factor":
        becomes = "the factor behind it left out" if "*" in old else "* for /"
    elif kind == "comparison":
        becomes = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}[old]
    elif kind == "condition":
        becomes = "true" if "!" not in new.split("courant_mutants")[0] else "false"
    elif kind == "negation":
        becomes = "!(" + " ".join(old.split()) + ")"
    elif kind == "least":
        becomes = "std::max" if "min" in old else "std::min"
    elif kind == "truth":
        becomes = {"true": "false", "false": "true"}[old]
    else:
        becomes = f"2 * {old}" if "?" in new else str(int(old) + 1)
    old = " ".join(old.split()) or "?"
    line = " ".join((before + old + after).split())
    return f"`{line}`: `{old}` becomes {becomes}".replace("|", "\\|")


def write(run, file):
    state = run.state
    reasons = {(r["file"], r["line"]): r["reason"] for r in yaml.safe_load((HERE / "reasons.yaml").read_text() or "[]") or []} \
        if (HERE / "reasons.yaml").exists() else {}
    chosen, now = state["chosen"], {**state["first"], **state["now"]}
    first = sum(a["noticed"] for a in state["first"].values())
    noticed = sum(now[str(c["number"])]["noticed"] for c in chosen)
    out = ["# Mutation run of the unit tests", "",
           f"Written by `tests/mutation/mutation.py`. Seed {state['seed']}: {len(chosen)} changes of `src/`, one at a time; {first} were noticed by the",
           f"unit tests as they stood, {noticed} once tests had been added. {len(state['dropped'])} more of the list did not compile.", "",
           "| room | changes | noticed | at first |", "|---|---|---|---|"]
    rooms = collections.defaultdict(list)
    for change in chosen:
        rooms[change["room"]].append(change)
    for room, changes in rooms.items():
        out.append(f"| {room} | {len(changes)} | {sum(now[str(c['number'])]['noticed'] for c in changes)} | "
                   f"{sum(state['first'][str(c['number'])]['noticed'] for c in changes)} |")
    out += ["", "## Not noticed", "", "| place | change | reason |", "|---|---|---|"]
    for change in chosen:
        if not now[str(change["number"])]["noticed"]:
            reached = "" if now[str(change["number"])].get("asked") else "no unit test reaches it"
            text = (run.original / change["file"]).read_text()
            line = text[text[:change["begin"]].rfind("\n") + 1:].split("\n")[0].strip()
            out.append(f"| `{change['file']}` | {shown(change, text)} | {reasons.get((change['file'], line), reached)} |")
    out += ["", "## Noticed", "", "| place | change | by |", "|---|---|---|"]
    for change in chosen:
        answer = now[str(change["number"])]
        if answer["noticed"]:
            late = "" if state["first"][str(change["number"])]["noticed"] else ", a new test"
            text = (run.original / change["file"]).read_text()
            out.append(f"| `{change['file']}` | {shown(change, text)} | {answer['by']}{' (' + answer['how'] + ')' if answer['how'] != 'fails' else ''}{late} |")
    pathlib.Path(file).write_text("\n".join(out) + "\n")
    return noticed >= ENOUGH * len(chosen)


def main():
    words = sys.argv[1:]
    at = words.index("--") if "--" in words else len(words)
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--changes", type=int, default=60)
    parser.add_argument("--seed", type=int)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--retest", action="store_true")
    parser.add_argument("--write")
    arguments = parser.parse_args(words[:at])
    arguments.options = words[at + 1:]
    run = Run(arguments)
    if not run.state["built"]:
        run.copy()
        if not run.original.exists():
            shutil.copytree(ROOT / "src", run.original / "src")
        run.configure(run.work / "check", "-DCOURANT_UNITY=OFF", "-DCOURANT_PRECOMPILED_HEADERS=OFF")
        run.configure(run.build, "-DCOURANT_UNITY=ON", "-DCOURANT_PRECOMPILED_HEADERS=ON")
        if run.state["chosen"] is None:
            run.choose()
        run.make()
    if arguments.retest:
        run.copy("tests/")
        run.make()
    run.reach(arguments.retest)
    if arguments.retest:
        run.state["now"] = {n: a for n, a in {**run.state["first"], **run.state["now"]}.items() if a["noticed"]}
        run.ask_all("now")
    else:
        run.ask_all("first")
    first = sum(a["noticed"] for a in run.state["first"].values())
    tell(f"seed {run.state['seed']}: {first} of {len(run.state['first'])} noticed at first")
    enough = write(run, arguments.write or run.work / "report.md")
    sys.exit(0 if enough else 1)


if __name__ == "__main__":
    main()
