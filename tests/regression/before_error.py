#!/usr/bin/env python3
"""The restart file that a stop in error leaves: it is a state of the run, the run goes on from it with shorter steps, and nothing of the
run depends on it.

usage: before_error.py COURANT WORK_DIR
"""
import os
import re
import shutil
import subprocess
import sys

from checks import check, enter_empty_folder, failures
from restart_scene import arrays, cycle_of, deck, differing, text_of

courant, work = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "before_error")
enter_empty_folder(work)


def holds(what, text, said):
    """A check, which shows what was said only where it fails."""
    check(what, text if what else f"{text}: {said[-900:]}")


def call(*words):
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout


def write(name, tssfac, **settings):
    """A deck whose steps are short up to time 2, then as long as TSSFAC allows."""
    deck(name, more="*DEFINE_CURVE\n9\n0.,0.002\n2.,0.002\n2.001,1.\n30.,1.\n", **settings)
    with open(name + ".k") as file:
        text = file.read()
    assert "*CONTROL_TIMESTEP\n0.,0.9\n" in text
    with open(name + ".k", "w") as file:
        file.write(text.replace("*CONTROL_TIMESTEP\n0.,0.9\n", f"*CONTROL_TIMESTEP\n0.,{tssfac},0,0,0.,9\n"))


def same(a, b):
    """Alike behind the titles, in which the decks differ."""
    return text_of(a).split("\n", 1)[1] == text_of(b).split("\n", 1)[1]


# About a thousand good cycles, then steps so long that the run stops within a few whatever the last bits are.
TSSFAC, END = 3, 20
write("long", TSSFAC, runrsf=0, end=END)
code, text = call("run", "long.k", "-o", "long", "--threads", "1")
file = "long/restart/before_error.h5"
check(code == 2 and os.listdir("long/restart") == ["before_error.h5"], f"a stop in error leaves a restart file -> {code} {os.listdir('long/restart')}")
told = re.search(r"before_error.h5 has the state at time (\S+), cycle (\d+),.* to go on with a smaller TSSFAC in the deck: courant (run long.k -o long --restart " + file + ")", text)
holds(told is not None and int(told.group(2)) == cycle_of(file), "and names it", text)
if failures:
    sys.exit(1)
cycle = cycle_of(file)
last = int(re.search(r"^steps: (\d+)", open("long/summary.yaml").read(), re.M).group(1))
check(cycle % 64 == 1 and 0 < last - cycle, f"of cycle {cycle}, {last - cycle} steps before the end")
check(f"restart_file: {file}" in open("long/summary.yaml").read(), "the summary names it")

# --- it is the state that a run which dumps there would have written
write("dumps", TSSFAC, runrsf=0, d3dump=cycle, end=END)
call("run", "dumps.k", "-o", "dumps", "--threads", "2", "--quiet")
a, b = arrays(file, "/state"), arrays("dumps/restart/d3dump01.h5", "/state")
check(len(a) > 20 and not differing(a, b), f"the state of cycle {cycle} bit by bit {differing(a, b)[:5]}")
check(same("long/glstat", "dumps/glstat"), "and the runs stop alike")

# --- whether copies are made changes nothing
write("none", TSSFAC, runrsf=0, end=END)
code, text = call("run", "none.k", "-o", "none", "--threads", "1", "--no-final-dump")
check(code == 2 and os.listdir("none/restart") == [] and "no restart file was written" in text, f"none with --no-final-dump -> {code}")
for name in ("glstat", "matsum", "rcforc", "sphout"):
    check(same(f"none/{name}", f"long/{name}"), f"{name} is the same without copies")
wrong = differing(arrays("none/history.h5"), arrays("long/history.h5"))
check(not wrong, f"history.h5, too {wrong[:5]}")

# --- from there again with the same deck: the same end, and a warning
shutil.copytree("long", "again")
code, text = call("run", "long.k", "-o", "again", "--restart", "again", "--threads", "1")
check(code == 2 and "Warning: after this state the run stopped in error, and the deck is the same" in text, f"the same deck stops again -> {code}")
check(text_of("again/glstat") == text_of("long/glstat"), "at the same place, with the same histories")
wrong = differing(arrays("again/history.h5"), arrays("long/history.h5"))
check(not wrong, f"history.h5 goes on as if never stopped {wrong[:5]}")

# --- with a smaller TSSFAC the run goes on
write("slower", 0.8, runrsf=0, end=arrays(file, "/state")["clock/t"][0] + 0.2)
code, text = call("run", "slower.k", "-o", "long", "--restart", "long", "--threads", "1")
holds(code == 0 and "changed in the deck: *CONTROL_TIMESTEP TSSFAC: '0.8', was '3'" in text, f"with TSSFAC 0.8 it goes on -> {code}", text)
check("Warning: after this state" not in text, "without that warning")
code, text = call("run", "slower.k", "-o", "long", "--restart", "long/restart/before_error.h5", "--threads", "1")
check(code == 0, f"the file is still there, and can be named -> {code}")

# --- a regular restart file that is newer is the one that a folder represents
write("both", TSSFAC, runrsf=0, d3dump=(last - 10), end=END)
code, text = call("run", "both.k", "-o", "both", "--threads", "1")
check(code == 2 and sorted(os.listdir("both/restart")) == ["before_error.h5", "d3dump01.h5"], f"both files -> {sorted(os.listdir('both/restart'))}")
holds("before_error.h5 has the state" in text and "latest whole state: courant run both.k -o both --restart both/restart/d3dump01.h5" in text,
      "both are told", text)
write("both", 0.8, runrsf=0, d3dump=(last - 10), end=0.1)
code, text = call("run", "both.k", "-o", "both", "--restart", "both", "--until", "0.01")
check("restart from both/restart/d3dump01.h5" in text, "the newest is taken")

# --- a new run in the folder sets it aside
call("run", "slower.k", "-o", "long", "--until", "0.01", "--quiet")
check("before_error.h5" in os.listdir("long/restart_old") and "before_error.h5" not in os.listdir("long/restart"), "set aside by a new run")
sys.exit(1 if failures else 0)
