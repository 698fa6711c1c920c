#!/usr/bin/env python3
"""The script behind examples/hydraulic_jump/paper.sh on runs cut to 0.2 s: page and figures, taking over, going on, a run that fails.

usage: paper.py COURANT SOURCE_DIR WORK_DIR
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

import yaml

from checks import check, enter_empty_folder, failures
sys.path[:0] = [str(pathlib.Path(sys.argv[2]) / "examples" / folder) for folder in ("lib", "hydraulic_jump")]
import paper_evaluate  # noqa: E402

courant, source = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
work = pathlib.Path(sys.argv[3]).resolve() / "paper"
enter_empty_folder(str(work))
results = work / "results"
try:
    import matplotlib  # noqa: F401
    pictures = True
except ImportError:
    pictures = False
    print("matplotlib is not here: figures are not looked for")


def words(only, program=courant):
    return [sys.executable, str(source / "examples/hydraulic_jump/paper.py"), "--courant", str(program), "--quick", "--only", only,
            "--threads", "1", "--results", str(results)]


def call(only, program=courant):
    done = subprocess.run(words(only, program), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(done.stdout)
    return done.returncode, done.stdout


def termination(name):
    return yaml.safe_load((results / name / "summary.yaml").read_text())["termination"]


# ---- the loss-free bound of V_max: none of the energy is height, a half of it, all of it, where eq. 3 asks for 1 and for 1/2
(work / "surface").mkdir()
for height, decay, expected in ((0, 1, 0), (0.5, 1, 1 - 0.5**0.5), (1, 1, 1), (0.5, 0.5, 0)):
    (work / "surface" / "roller_surface.csv").write_text("distance [-],mean [-]\n" + "".join(f"{x},{1 + height * 2.4**2 / 2}\n" for x in (0, 30)))
    (work / "surface" / "roller.csv").write_text("distance [-],decay [-]\n" + f"-5,9\n10,{decay}\n20,{decay}\n25,9\n")
    rms = paper_evaluate.least_decay_rms(work / "surface", 2.4)
    check(abs(rms - expected) < 1e-12, f"water that has turned {height} of its energy into height is {rms:.3f} off at least")

# ---- a run, its numbers and its figures
code, out = call("d4_better,d4")
check(code == 0, f"exit code {code}")
page = (results / "page.md").read_text()
check("These numbers mean nothing" in page, "the page tells that it is a trial")
check(re.search(r"\| d1/4 \| better \| 0\.2 \| 36879 \| 1120 \| 8 \| 1 \| 114 h \|", page) is not None,
      "Table 1: 1120 particles, (1.1 m + 1.5 m/s x 0.2 s) x d1 in squares of d1/4, on one thread, beside the paper's 36879 on 8 cores in 114 h")
check("11.18 (section 3, Figure 6)" in page, "the paper's roller of 0.2235 m is 11.18 d1")
check("14.84 (eq. 2)" in page, "eq. 2 at Fr1 = 3.386 gives 14.84 d1")
found = yaml.safe_load((results / "d4_better" / "evaluated.yaml").read_text())
check(0.3 < found["bed"]["row1"] < 1.5 and 0.3 < found["bed"]["row2"] < 1.6, f"jet at x = 0.1 m: {found['bed']['row1']:.2f} m/s in the row at the bed, {found['bed']['row2']:.2f} m/s in the next")
check(abs(found["bed"]["filled"] / 0.02 - 1) < 0.02, f"water at rest at x = 1 m fills {1000 * found['bed']['filled']:.2f} mm of 20 mm")
if pictures:
    shown = re.findall(r"\]\((figures/[^)]+)\)", page)
    check(len(shown) == 20, f"{len(shown)} figures: 4 and 3 of the runs, their speeds, for each the depth of all cases, 9 of both settings")
    check(all((results / name).stat().st_size > 3000 for name in shown), "they are there")

# ---- a second call takes everything over
before = (results / "d4_better" / "summary.yaml").stat().st_mtime_ns, (results / "d4_better" / "evaluated.yaml").stat().st_mtime_ns
code, out = call("d4_better")
after = (results / "d4_better" / "summary.yaml").stat().st_mtime_ns, (results / "d4_better" / "evaluated.yaml").stat().st_mtime_ns
check(code == 0 and before == after and "is complete" in out, "a complete run is neither run nor evaluated again")

# ---- standing jumps have a page of their own
code, out = call("fr24")
page = (results / "page_standing.md").read_text()
check(code == 0 and page.startswith("# Jumps that stand still") and "| 2.4 | d1/8 | 22 |" in page, "Fr1 = 2.4 with its Reynolds number")
check("Not run: fr34, fr31" in page and "d4" not in page.split("Not run:")[1].split("\n")[0], "and what was not run of its kind")
check("| 2.4 |" not in (results / "page.md").read_text(), "not on the page of the paper's cases")

# ---- the study: several runs of each variant, which differ, and the base is what others are measured by
code, out = call("base,better")
page = (results / "page_study.md").read_text()
rows = {line.split(" | ")[0].removeprefix("| "): line.split(" | ") for line in page.splitlines() if line.startswith("| ")}
base, better = (next(row for name, row in rows.items() if name.startswith(start)) for start in ("nothing", "*better*"))
check(code == 0 and base[1] == better[1] == "3" and base[-1].startswith("1.00"), f"three runs of each, the first costs {base[-1]} of itself")
check("Not run: " in page and "shifting" in page.split("Not run:")[1], "and what was not run of it")
decks = [(results / "study" / f"base.{k}.k").read_text() for k in (1, 2)]
check(decks[0] != decks[1] and "v1 = 1.4999985" in decks[1], "the runs differ in v1 by a millionth")

# ---- interrupted, and gone on with
# the slowest loops: the run, else over in two seconds, must not end before the interrupt reaches it
running = subprocess.Popen(words("d10"), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
                           env=os.environ | {"COURANT_SIMD": "baseline"})
end = time.time() + 120
while time.time() < end and len(list((results / "d10" / "fields").glob("*.vtp"))) < 2 and running.poll() is None:
    time.sleep(0.01)
os.killpg(running.pid, signal.SIGINT)  # as Ctrl-C at a terminal
out = running.communicate()[0]
print(out)
check(running.returncode == 130 and "Interrupted" in out, f"interrupted: exit code {running.returncode}")
check(termination("d10") == "interrupted", f"the run was stopped: {termination('d10')}")
code, out = call("d10")
check(code == 0 and "goes on from its restart file" in out and termination("d10") == "normal", "the same command goes on")
check(yaml.safe_load((results / "d10" / "summary.yaml").read_text())["restarts"] == 1, "in one further part")

# ---- a run that fails does not keep others from running
broken = work / "courant_broken"
broken.write_text(f'#!/bin/sh\ncase "$1 $2" in "run "*/d5.k) echo broken on purpose; exit 2 ;; esac\nexec "{courant}" "$@"\n')
broken.chmod(0o755)
code, out = call("d5,d6", broken)
check(code == 1 and "FAILED d5: the run ended with exit code 2: broken on purpose" in out, f"a failed run is told, exit code {code}")
check(termination("d6") == "normal" and "| d1/6 |" in (results / "page.md").read_text(), "the next run was run all the same")
not_run = [line for line in (results / "page.md").read_text().splitlines() if line.startswith("Not run: ")]
names = not_run[0].removeprefix("Not run: ").rstrip(".").split(", ") if not_run else []
check("d5" in names and "d6" not in names and "d10" not in names, f"the page tells what was not run: {', '.join(names)}")
code, out = call("nothing")
check(code == 2 and "there is no run nothing" in out, f"an unknown name is refused, exit code {code}")

sys.exit(1 if failures else 0)
