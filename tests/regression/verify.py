#!/usr/bin/env python3
"""`courant verify` as a user meets it: a tiny suite end to end, interrupted, resumed, wrong, missed, unstable.

usage: verify.py COURANT SOURCE_DIR WORK_DIR
"""
import csv
import os
import re
import shutil
import signal
import subprocess
import sys
import time

from checks import check, enter_empty_folder, failures

courant, source, work = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), os.path.join(os.path.abspath(sys.argv[3]), "verify")
enter_empty_folder(work)

SCENE = os.path.relpath(os.path.join(source, "keyword_decks", "still_water", "scene.yaml"), work)
SUITE = f"""
title: still water, tiny
cases:
  - name: still
    title: Still water
    scene: {SCENE}
    parameters: {{endtim: 0.2, dt_plot: 0.1, c0: 20}}
    resolution: resolution
    resolutions: [6, 12]
    size: dx
    settings:
      - {{name: damped, parameters: {{vdc: 20}}}}
      - {{name: stiff, parameters: {{sfsa: 20}}}}
    observations:
      - {{name: mass, of: parts/1/mass, take: final, reference: rho0 * width * depth, bound: 1e-9}}
      - {{name: top, kind: particles, of: y + dx / 2, reduce: max, take: mean, reference: depth, bound: 0.05}}
      - {{name: pressure, kind: profile, of: p, along: y, at: 0.2, reference: rho0 * g * (depth - y)}}
      - {{name: kinetic, of: global/kinetic, take: max, reference: finest, scale: rho0 * g * depth ^ 2}}
    picture_of: p
  - name: map
    scene: {SCENE}
    parameters: {{endtim: 0.1, resolution: 6, c0: 20}}
    observations:
      - {{name: kinetic, of: global/kinetic / (rho0 * g * depth ^ 2), take: max}}
    stability:
      sweep: {{tssfac: [0.5, 3], sfsa: [1, 10]}}
      must_be_stable: min(1 - tssfac, sfsa - 5)
      limits:
        - {{name: kinetic, value: kinetic, at_most: 1}}
        - {{name: leaked, value: leaked, at_most: 0}}
"""


def write(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def ends(code, *words, err="", out="", what=None):
    """One call that must end with `code` and say `err` and `out` (regular expressions)."""
    done = subprocess.run([courant, "verify", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120)
    holds = done.returncode == code and re.search(err, done.stderr) is not None and re.search(out, done.stdout) is not None
    check(holds, what or f"courant verify {' '.join(words)} -> {code}")
    if not holds:
        print(f"        exit code {done.returncode}, expected {code}\n        stdout: {done.stdout[-2500:]}\n"
              f"        expected {out!r}\n        stderr: {done.stderr[-800:]} expected {err!r}")
    return done.stdout


def rows(folder):
    with open(os.path.join(folder, "results.csv"), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


# --- a suite whose bounds are met
write("suite.yaml", SUITE)
said = ends(0, "suite.yaml", out=r"8 of 8 checks met, 0 missed")
check(len(re.findall(r"^\[\d+/8\] ", said, re.M)) == 8, "one line per run")
check(re.search(r"damped +12 +144 ", said) is not None, "the table has particles and steps")
check(re.search(r"sfsa \\ tssfac +0\.5 +3\n +1 +\w +\w\n +10 +S +\w\n", said) is not None, "the map of verdicts")
for name in ("report.html", "results.csv", "results.yaml"):
    check(os.path.getsize(os.path.join("suite_verify", name)) > 500, f"{name} is there")
all_rows = rows("suite_verify")
check(len(all_rows) == 4 * 4 + 4, "a row per run and observation")
mass = [r for r in all_rows if r["observation"] == "mass"]
check(all(abs(float(r["value"]) - 250) < 1e-6 and float(r["particle_steps"]) > 0 and float(r["peak_memory_bytes"]) > 1e6
          for r in mass), "mass, particle-steps and memory are recorded")
check([r["check"] for r in mass] == ["", "met", "", "met"], "checks stand at the finest runs")
finest = [r["error"] for r in all_rows if r["case"] == "still" and r["observation"] == "kinetic"]
check([e != "" for e in finest] == [True, False, True, False], "the finest run is the reference of the others")

# --- nothing is run again, unless asked for or something has changed
said = ends(0, "suite.yaml", out="8 of 8 runs are taken over")
check(not re.search(r"^\[", said, re.M), "nothing is run twice")
ends(0, "suite.yaml", "--only", "still", "--fresh", out=r"\[4/4\]")
ends(1, "suite.yaml", "--only", "stil", err="no case 'stil'\n  hint: did you mean still")
write("suite.yaml", SUITE.replace("endtim: 0.1", "endtim: 0.11"))
said = ends(0, "suite.yaml", out="4 of 8 runs are taken over")
check(len(re.findall(r"^\[\d/4\] map", said, re.M)) == 4, "runs of another deck are run")

# --- compared with an earlier call
write("suite.yaml", SUITE)
shutil.copy("suite_verify/results.csv", "old.csv")
ends(0, "suite.yaml", "--compare", "old.csv", "--page", "page.md", out=r"Against old\.csv \(20 rows in both\)")
check(os.path.exists("page.md") and os.path.isdir("page"), "--page writes a page and its pictures")
ends(1, "suite.yaml", "--compare", "none.csv", err="none.csv: error: cannot read the earlier results")
write("tight.yaml", SUITE.replace("bound: 0.05", "bound: 1e-6"))
ends(2, "tight.yaml", "-o", "suite_verify", out=r"MISSED  still: damped, top: error at most", what="a bound that is missed -> 2")
ends(2, "tight.yaml", "-o", "suite_verify", "--compare", "old.csv", out=r"WORSE  still: damped, 12, top: check missed, was met")
ends(0, "tight.yaml", "-o", "suite_verify", "--compare", "suite_verify/results.csv", out="nothing has changed",
     what="what was missed before does not fail a comparison")

# --- wrong suites: nothing is run, nothing written
for old, new, err in ((r"take: final", "take: finl", r"wrong\.yaml:15:\d+: error: 'observation\.take' cannot be 'finl'\n  hint: did you mean final"),
                      ("c0: 20}}".replace("}}", "}"), "c00: 20}", r"wrong\.yaml:4:\d+: error: case still, .*--param c00"),
                      (SCENE, "nowhere.yaml", r"wrong\.yaml:6:\d+: error: 'case\.scene': there is no file"),
                      ("global/kinetic", "global/kinetic * h", r"wrong\.yaml:18:\d+: error: 'observation\.of': unknown name 'h'")):
    write("wrong.yaml", SUITE.replace(old, new))
    ends(1, "wrong.yaml", err="(?s)" + err + ".*nothing was run", what=f"a suite with '{new}' is wrong")
check(not os.path.exists("wrong_verify"), "a wrong suite leaves no folder")
ends(1, "missing.yaml", err="missing.yaml: error: cannot read the suite")

# --- runs that are unstable, refused, hang or have nothing to observe
def unstable(body):
    write("bad.yaml", f"cases:\n  - name: bad\n    scene: {SCENE}\n    parameters: {{resolution: 6, endtim: 0.3, c0: 20, sfsa: 1}}\n" + body)


unstable("    stability:\n      sweep: {tssfac: [0.9, 3]}\n      must_stop: tssfac - 1\n")
said = ends(0, "bad.yaml", "--fresh", out="2 of 2 checks met")
check(re.search(r"tssfac = 3: stopped: .* time [\d.]+", said) is not None, "a run that blows up is stopped, with its reason")
unstable("    observations: [{name: k, of: global/kinetic, take: max}]\n    settings: [{name: wild, parameters: {tssfac: 3}}]\n")
ends(2, "bad.yaml", out="(?s)wild: stopped: .* time [\\d.]+.*MISSED  bad: wild: runs to its end", what="an accuracy case must run to its end")
unstable("    stability:\n      sweep: {rho0: [-1]}\n      must_stop: 1\n")
ends(0, "bad.yaml", out=r"rho0 = -1: refused: .*deck\.k:\d+:\d+: error: ")
unstable("    time_limit: 0.2\n    settings: [{name: long, parameters: {endtim: 1e6}}]\n    observations: [{name: k, of: t}]\n")
ends(2, "bad.yaml", out=r"long: broken: ran longer than 0\.2 s")
unstable("    observations: [{name: k, of: contacts/5/force.x, take: max, reference: 1, bound: 1}]\n")
ends(2, "bad.yaml", out=r"(?s)k: history.h5 has no 'contacts/5/force'; did you mean contacts/1/force.*MISSED")

# --- a deck that is given, with parameters, beside the suite
os.makedirs("given")
subprocess.run([courant, "generate", SCENE, "-o", "given/deck.k", "--param", "resolution=6", "--param", "endtim=0.05"], check=True,
               stdout=subprocess.DEVNULL)
text = open("given/deck.k").read()
at = text.index("\n", text.index("*CONTROL_TERMINATION\n") + 22) + 1
with open("given/deck.k", "w") as file:
    file.write(text[:at].replace("*KEYWORD\n", "*KEYWORD\n*PARAMETER\nR     tend      0.05\n") + "     &tend" + text[at + 10:])
write("given/suite.yaml", "cases:\n  - name: given\n    deck: deck.k\n    resolution: tend\n    resolutions: [1e-2, 0.03]\n"
      "    observations: [{name: end, of: t, take: final, reference: tend, bound: 0.2}]\n")
ends(0, "given/suite.yaml", "-o", "given/out", out="1 of 1 checks met")
check([round(float(r["reference"]), 6) for r in rows("given/out")] == [0.01, 0.03], "--param reaches the deck, also as 1e-2")

# --- killed, interrupted, and gone on
# its runs take longer than it takes to stop the call after the first
long = SUITE.replace("endtim: 0.2,", "endtim: 10,").replace("at: 0.2", "at: 10")


def started(*words):
    process = subprocess.Popen([courant, "verify", "long.yaml", "--jobs", "1", *words], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    for line in process.stdout:
        if line.startswith("[1/"):
            return process
    check(False, "the long suite is under way")
    return process


def children_of(pid):
    found = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], stdout=subprocess.PIPE, text=True)
    return [int(word) for word in found.stdout.split()]


def gone(pids):
    end = time.time() + 10
    while time.time() < end and any(os.path.exists(f"/proc/{p}") for p in pids):
        time.sleep(0.02)
    return not any(os.path.exists(f"/proc/{p}") for p in pids)


write("long.yaml", long)
process = started()
process.send_signal(signal.SIGSTOP)  # however long the second call takes, runs are left
children = children_of(process.pid)
for child in children:
    os.kill(child, signal.SIGSTOP)
ends(1, "long.yaml", err="another `courant verify` works in this folder")
process.kill()
process.wait()
check(gone(children), "children end with a killed call")
said = ends(0, "long.yaml", out=r"[1-7] of 8 runs are taken over", what="a killed call goes on")
process = started("--fresh")
process.send_signal(signal.SIGINT)
_, err = process.communicate(timeout=20)
check(process.returncode == 2 and "interrupted; the runs that ended are kept" in err, "SIGINT ends with 2")
ends(0, "long.yaml", out=r"[1-7] of 8 runs are taken over", what="an interrupted call goes on")
write("notours.yaml", SUITE)
os.makedirs("notours/runs")
ends(1, "notours.yaml", "-o", "notours", err="something else called 'runs'")

print(f"{len(failures)} failures" if failures else "courant verify behaves")
sys.exit(1 if failures else 0)
