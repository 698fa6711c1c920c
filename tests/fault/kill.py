#!/usr/bin/env python3
"""Kills a run at random moments and lets it go on from its latest whole restart file, each time; the end must be that of a run that was
left alone, bit by bit.

usage: kill.py COURANT WORK_DIR [KILLS [SEED]]
"""
import os
import pathlib
import random
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "regression"))
from checks import check, enter_empty_folder, failures  # noqa: E402
from restart_scene import deck, differences  # noqa: E402

courant, work = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "kill")
kills = int(sys.argv[3]) if len(sys.argv) > 3 else 6
rest = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
enter_empty_folder(work)
deck("flow", runrsf=20, d3dump=300, end=2.0)

start = time.time()
subprocess.run([courant, "run", "flow.k", "-o", "whole", "--quiet", "--threads", "2"], check=True, timeout=600)
whole = time.time() - start
print(f"a run takes {whole:.1f} s")

done, runs, from_start = 0, 0, 0
ended = False
while done < kills:
    has_state = os.path.isdir("killed/restart") and any(name.endswith(".h5") for name in os.listdir("killed/restart"))
    if ended or not has_state:
        from_start += 1
        has_state = False
    words = [courant, "run", "flow.k", "-o", "killed", "--quiet", "--threads", rest.choice("124")]
    words += ["--restart", "killed"] if has_state else []
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    runs += 1
    try:
        process.wait(rest.uniform(0, min(1.0, whole)))
        ended = process.returncode == 0
        if not ended:
            check(False, f"a run ended with {process.returncode}: {process.stderr.read()}")
            break
        wrong = differences("whole", "killed")
        check(not wrong, f"after {done} kills, {runs} parts: as if never stopped {wrong[:5]}")
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
        process.wait()
        done += 1
        ended = False

words = [courant, "run", "flow.k", "-o", "killed", "--quiet", "--threads", "2"]
if os.listdir("killed/restart") and not ended:
    words += ["--restart", "killed"]
last = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600)
check(last.returncode == 0, f"the last part -> {last.returncode} {last.stderr}")
wrong = differences("whole", "killed")
check(not wrong, f"killed {done} times in {runs} parts, {from_start} from the start: as if never stopped {wrong[:8]}")
sys.exit(1 if failures else 0)
