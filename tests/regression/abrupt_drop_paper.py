#!/usr/bin/env python3
"""The script behind examples/abrupt_drop/paper.sh on runs cut to 0.5 s: every scene of the tests, page and figures, taking over.

usage: abrupt_drop_paper.py COURANT SOURCE_DIR WORK_DIR
"""
import pathlib
import re
import subprocess
import sys

import yaml

from checks import check, enter_empty_folder, failures

courant, source = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
work = pathlib.Path(sys.argv[3]).resolve() / "abrupt_drop_paper"
enter_empty_folder(str(work))
results = work / "results"


def call(only):
    done = subprocess.run([sys.executable, str(source / "examples/abrupt_drop/paper.py"), "--courant", str(courant), "--quick", "--only", only, "--threads", "1",
                           "--results", str(results)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(done.stdout)
    return done.returncode, done.stdout


# ---- the printed tests are those of the paper's table
table = yaml.safe_load((source / "examples/abrupt_drop/paper_runs.yaml").read_text())
for name, test in table["tests"].items():
    q1, froude = test["v1"] * test["y1"], test["v1"] / (9.81 * test["y1"]) ** 0.5
    check(0.0645 < q1 < 0.0690 and 2.9 < froude < 3.8, f"{name}: a discharge of {q1:.4f} m2/s at a Froude number of {froude:.2f}")

# ---- one run of each scene, its numbers and its figures
names = ["T6", "T1_mixing", "T1_frozen"]
code, out = call(",".join(names))
check(code == 0, f"exit code {code}")
page = (results / "page.md").read_text()
check("These numbers mean nothing" in page, "the page tells that it is a trial")
check("Types as in the experiment:" in page, "the page counts the types that are right")
for name in names:
    row = next((line for line in page.splitlines() if line.startswith(f"| {name} |")), "")
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    check(len(cells) >= 15, f"the page has a row of {name}: {row}")
    if len(cells) >= 15:
        check(0 < float(cells[12]) < 0.15, f"{name}: Mach number {cells[12]}")
        check(cells[13] == "0", f"{name}: {cells[13]} particles leaked")
    deck = (results / f"{name}.k").read_text()
    check(("*COURANT_FROZEN_OUTLET" in deck) == (name == "T1_frozen"), f"{name} has the outlet of its scene")
    check((results / name / "abrupt_drop" / "types.csv").is_file(), f"{name} has types over time")
check(re.search(r"figures/abrupt_drop/T1_mixing_types\.png", page) is not None, "the page shows the figures of T1_mixing")

# ---- the paper's own form is a deck that can be run
deck = work / "printed.k"
for words in (["generate", source / "keyword_decks/abrupt_drop/printed_form_drop.yaml", "-o", deck, "--param", "n=2"], ["check", deck]):
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    check(done.returncode == 0, f"courant {words[0]} of the printed form: {done.stdout[-300:]}")

# ---- taking over: nothing is run or evaluated again
code, out = call("T6")
check(code == 0 and "is complete" in out and "is evaluated" not in out, "a complete run is taken over")
code, out = call("T9")
check(code == 2 and "there is no run T9" in out, "an unknown run is told")
sys.exit(1 if failures else 0)
