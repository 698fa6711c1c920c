#!/usr/bin/env python3
"""Restart files as a user meets them: stopping and going on in every way, changed decks, files that are damaged, disks that are full.

usage: restart.py COURANT WORK_DIR
"""
import glob
import os
import pty
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

from checks import check, enter_empty_folder, failures
from restart_scene import arrays, cycle_of, deck, differences, latest, text_of, yaml

courant, work = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "restart")
enter_empty_folder(work)


def call(*words, limit=None):
    """Exit code and both streams together. `limit`: largest file [bytes]."""
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120, stdin=subprocess.DEVNULL,
                          preexec_fn=limit and (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))))
    return done.returncode, done.stdout


def ends(code, *words, says="", **options):
    got, text = call(*words, **options)
    holds = got == code and re.search(says, text) is not None
    check(holds, f"courant {' '.join(words)} -> {code} {says!r}")
    if not holds:
        print(f"        exit code {got}, it said:\n{text[-1500:]}")
    return text


def alike(a, b, text):
    wrong = differences(a, b)
    check(not wrong, f"{text} {wrong[:6]}")


def said(folder):
    with open(f"{folder}/messag") as file:
        return file.read()


def notes(folder):
    with open(f"{folder}/summary.yaml") as file:
        return yaml.safe_load(file).get("restart_notes", [])


deck("flow", runrsf=70, d3dump=120)
ends(0, "run", "flow.k", "-o", "whole", "--quiet", "--threads", "1")
check(sorted(os.listdir("whole/restart")) == ["d3dump01.h5", "d3dump02.h5", "runrsf.h5"], f"restart files: {sorted(os.listdir('whole/restart'))}")
check("write d3dump01 file" in said("whole") and "write runrsf file" in said("whole"), "messag tells of restart files")

# --- from each kind of file; files of the run go on as if nothing had happened
for name, threads in (("d3dump01", "2"), ("runrsf", "1"), ("d3dump02", "4")):
    shutil.rmtree("part", ignore_errors=True)
    shutil.copytree("whole", "part")
    ends(0, "run", "flow.k", "-o", "part", "--restart", f"part/restart/{name}.h5", "--threads", threads, says="restart from part/restart/" + name)
    alike("whole", "part", f"from {name}, on {threads} threads")
shutil.rmtree("part")
ends(0, "run", "flow.k", "-o", "part", "--until", "0.25", "--quiet")
ends(0, "i=flow.k", "r=part", "-o", "part", "ncpu=2", "--quiet")
alike("whole", "part", "a run that ended earlier, by LS-DYNA's words")
ends(0, "run", "flow.k", "-o", "none", "--until", "0.1", "--no-final-dump", "--quiet")
check([os.path.basename(f) for f in glob.glob("none/restart/*")] == [], "no restart file where none is wanted")

# --- another folder: the files there begin at the restart
ends(0, "run", "flow.k", "-o", "other", "--restart", "whole/restart/d3dump01.h5", says="are in another folder")
check(not [d for d in differences("whole", "other") if d.startswith(("state", "summary"))], "the end is the same in another folder")
check(os.path.exists("other/glstat") and text_of("whole/glstat").endswith(text_of("other/glstat")[-2000:]), "its glstat ends like that of the whole run")

# --- changed decks
shutil.copytree("whole", "more")
deck("longer", end=0.7, glstat=0.007, runrsf=50)
ends(0, "run", "longer.k", "-o", "more", "--restart", "more/restart/d3dump01.h5", says=r"changed in the deck: \*CONTROL_TERMINATION ENDTIM: '0.7', was '0.6'")
check("*DATABASE_GLSTAT DT: '0.007', was '0.01'" in said("more"), "a changed interval is told")
check(any("ENDTIM" in note for note in notes("more")) and not notes("part"), f"restart_notes of the summary: {notes('more')}, {notes('part')}")
inlet = "*NODE\n90021,3.,2.5,0.\n90022,3.,2.6,0.\n*PART\ninflow\n4,1,1,1,1\n*DEFINE_SPH_INJECTION\n4,7,0,1.5\n*SET_NODE_LIST\n7\n90021,90022\n"
deck("inflow", end=0.05, histories=False, more=inlet)
deck("more_inflow", end=0.3, histories=False, more=inlet)
ends(0, "run", "inflow.k", "-o", "inflow", "--quiet")
ends(0, "run", "more_inflow.k", "-o", "inflow", "--restart", "inflow", says="changed in the deck: .*ENDTIM")
check(not any("last bits" in note for note in notes("inflow")), f"the summary names no reason for other bits: {notes('inflow')}")
text = open("flow.k").read()
for old, new, message in (("*MAT_NULL\n1,1000.,", "*MAT_NULL\n1,900.,", r"other.k:\d+:\d+: error: \*MAT_NULL field 2 \(RO.*the run so far had '1000', the deck has '900'"),
                          ("1,1.2,0.8,1.2", "1,1.3,0.8,1.2", r"\*SECTION_SPH field 2 \(CSLH"),
                          ("\n1,0.050,0.050,0.", "\n1,0.060,0.050,0.", r"\*NODE field 2 \(X|\*NODE: the .* entries are not those"),
                          ("*DATABASE_HISTORY_SPH\n1,30,200\n", "*BOUNDARY_SPC_NODE\n1,0,1\n", r"\*BOUNDARY_SPC_NODE: the run so far had 0 entries, the deck has 1")):
    with open("other.k", "w") as file:
        assert old in text
        file.write(text.replace(old, new, 1))
    before = open("more/glstat").read()
    ends(1, "run", "other.k", "-o", "more", "--restart", "more/restart/d3dump01.h5", says=message)
    check(open("more/glstat").read() == before, "nothing was written")

# --- sense switches and signals
def started(folder, *words):
    process = subprocess.Popen([courant, "run", "long.k", "-o", folder, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               stdin=subprocess.DEVNULL)
    until(lambda: os.path.exists(f"{folder}/glstat") and os.path.getsize(f"{folder}/glstat") > 3000)
    return process


def until(holds):
    end = time.time() + 60
    while not holds() and time.time() < end:
        time.sleep(0.02)
    return holds()


deck("long", end=1000.0, runrsf=0, plot=1.0, glstat=0.1)
for order, where in (("sw1.", "stopped"), ("STOP", "stopped"), ("sw1", ".")):
    shutil.rmtree("stopped", ignore_errors=True)
    process = started("stopped", "--quiet")
    with open(f"{where}/d3kil", "w") as file:
        file.write(order + "\n")
    code = process.wait(60)
    check(code == 0 and not os.path.exists(f"{where}/d3kil"), f"{order} stops the run -> {code}, and d3kil is gone")
    summary = open("stopped/summary.yaml").read()
    check("termination: interrupted" in summary and f"stopped by sense switch {order}" in summary and "--restart" in summary, f"{order}: the summary says so")
    check(len(os.listdir("stopped/restart")) == 1, "one restart file")

process = started("going", "--quiet")
for order in ("sw2.", "sw3.", "sw4.", "swa.", "nonsense"):
    with open("going/d3kil", "w") as file:
        file.write(order)
    check(until(lambda: f"sense switch {order}" in said("going")), f"{order} is heard")
with open("going/d3kil", "w") as file:
    file.write("endtime=1e-3")
check(process.wait(60) == 0 and "termination: normal" in open("going/summary.yaml").read(), "endtime ends the run")
check("'nonsense' is not known" in said("going"), "an unknown order is told")
check("write d3dump01 file" in said("going"), "sw3. writes a restart file")

shutil.rmtree("typed", ignore_errors=True)
process, terminal = pty.fork()
if process == 0:
    os.execv(courant, [courant, "run", "long.k", "-o", "typed"])
typed, text, end = False, b"", time.time() + 60
while time.time() < end:
    try:
        text += os.read(terminal, 65536)
    except OSError:  # it has ended
        break
    if not typed and b"first step" in text:
        os.write(terminal, b"sw1.\n")
        typed = True
code = os.waitpid(process, 0)[1]
check(code == 0 and b"stopped by sense switch sw1." in text and os.path.exists("typed/restart/d3dump01.h5"), f"sw1. typed at the terminal -> {code}")

for number, name in ((signal.SIGINT, "SIGINT"), (signal.SIGTERM, "SIGTERM")):
    shutil.rmtree("signalled", ignore_errors=True)
    process = started("signalled", "--quiet")
    process.send_signal(number)
    check(process.wait(60) == 0 and len(glob.glob("signalled/restart/d3dump01.h5")) == 1, f"{name} leaves a restart file")
cycle = cycle_of("signalled/restart/d3dump01.h5")
call("run", "long.k", "-o", "unsignalled", "--until", str(1.5 * arrays("signalled/restart/d3dump01.h5", "/state")["clock/t"][0]), "--quiet")
call("run", "long.k", "-o", "signalled", "--restart", "signalled", "--until", str(1.5 * arrays("signalled/restart/d3dump01.h5", "/state")["clock/t"][0]), "--quiet")
alike("unsignalled", "signalled", f"after the signal at cycle {cycle}")

# --- two runs in one folder
process = started("locked", "--quiet")
ends(1, "run", "long.k", "-o", "locked", "--quiet", says=rf"another run \(process {process.pid}\) is writing there\n  hint: wait for its end")
process.send_signal(signal.SIGKILL)
process.wait()
ends(0, "run", "flow.k", "-o", "locked", "--until", "0.02", "--quiet")

# --- damaged files
bytes_ = open("whole/restart/d3dump02.h5", "rb").read()
os.makedirs("damaged/restart")
shutil.copy("whole/restart/d3dump01.h5", "damaged/restart/d3dump01.h5")


def damaged(content, why):
    with open("damaged/restart/d3dump02.h5", "wb") as file:
        file.write(content)
    ends(1, "run", "flow.k", "-o", "never", "--restart", "damaged/restart/d3dump02.h5",
         says=rf"error: cannot restart from 'damaged/restart/d3dump02.h5': {why}(.|\n)*hint: 'damaged/restart/d3dump01.h5' is whole")


for length in (0, 1, 8, len(bytes_) // 2, len(bytes_) - 75, len(bytes_) - 1):
    damaged(bytes_[:length], "it is no restart file" if length < 8 else "the file is not whole")
for k in range(12):
    at = (k * 7919 + 13) * (len(bytes_) // 100000 + 1) % (len(bytes_) - 74)
    damaged(bytes_[:at] + bytes([bytes_[at] ^ (1 << k % 8)]) + bytes_[at + 1:], "the file is damaged")
import zlib  # noqa: E402
other = bytes_.replace(b"format     1,", b"format     2,")[:-9]
damaged(other + b"%08x\n" % zlib.crc32(other), "it has format 2; this is courant .*, which reads format 1: use the version")
ends(0, "run", "flow.k", "-o", "damaged", "--restart", "damaged", "--quiet")
check("d3dump02.h5': it has format 2" in said("damaged") and "restart from damaged/restart/d3dump01.h5" in said("damaged"),
      "of a folder the latest whole file is taken")
ends(1, "run", "flow.k", "-o", "never", "--restart", "nowhere.h5", says="No such file")
ends(1, "run", "flow.k", "-o", "never", "--restart", "flow.k", says="it is no restart file")
os.makedirs("empty", exist_ok=True)
ends(1, "run", "flow.k", "-o", "never", "--restart", "empty", says="there is no whole restart file in it")
check(not os.path.exists("never"), "a refused restart makes no folder")

# --- a file that cannot be written: the one before stays, and the run says how to go on
deck("full", runrsf=70, histories=False)
size = os.path.getsize("whole/restart/runrsf.h5")
text = ends(2, "run", "full.k", "-o", "full", says="cannot write 'full/restart/runrsf.h5'", limit=size // 2)
check(not glob.glob("full/restart/*") and "no restart file was written" in text, "nothing of the failed file is left")
shutil.rmtree("full")
deck("full", runrsf=70)
ends(0, "run", "full.k", "-o", "full", "--until", "0.3", "--quiet")
before = cycle_of(latest("full"))
text = ends(2, "run", "full.k", "-o", "full", "--restart", "full", says="cannot write", limit=os.path.getsize("full/history.h5") + 2000)
check("to go on from the latest whole state: courant run full.k -o full --restart full/restart/" in text, "the message says how to go on")
ends(0, "run", "full.k", "-o", "full", "--restart", "full", "--quiet")
ends(0, "run", "full.k", "-o", "room", "--quiet")
alike("room", "full", "after a full disk")
deck("long", end=1000.0, runrsf=20, plot=1.0, glstat=0.1)
process = started("shut")
until(lambda: os.path.exists("shut/restart/runrsf.h5"))
os.rename("shut/restart", "shut/away")
open("shut/restart", "w").close()
text = process.communicate(timeout=60)[0]
check(process.returncode == 2 and re.search(r"cannot write 'shut/restart/runrsf.h5': Not a directory\n  hint: ", text) is not None,
      f"a folder that is lost midway -> {process.returncode} {text[-300:]!r}")
check(cycle_of("shut/away/runrsf.h5") > 0, "the file before it is whole")
os.remove("shut/restart")
os.rename("shut/away", "shut/restart")
ends(0, "run", "long.k", "-o", "shut", "--restart", "shut", "--until", "0.5", "--quiet")

# --- files that were lost in between are told
shutil.rmtree("part")
shutil.copytree("whole", "part")
with open("part/glstat", "r+") as file:
    file.truncate(1000)
os.remove("part/history.h5")
ends(0, "run", "flow.k", "-o", "part", "--restart", "part/restart/d3dump02.h5", says="glstat has lost its end before the restart")
check("history.h5 has lost samples" in said("part"), "a lost history is told")

# --- a new run in the folder moves the restart files of the old one out of the way
ends(0, "run", "flow.k", "-o", "part", "--until", "0.01", "--quiet")
check(sorted(os.listdir("part/restart")) == ["d3dump01.h5"] and "runrsf.h5" in os.listdir("part/restart_old"), "restart files of an older run are set aside")
sys.exit(1 if failures else 0)
