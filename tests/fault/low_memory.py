#!/usr/bin/env python3
"""Runs that get less and less memory (addresses, as ulimit -v): each ends by itself with a message and exit code 1, 2 or 3, or well; none crashes or waits.

usage: low_memory.py COURANT WORK_DIR [LIMITS]      LIMITS: how many sizes are tried for each number of threads, 12 if not given
"""
import os
import resource
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "regression"))
from checks import check, enter_empty_folder, failures  # noqa: E402

courant, work = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "low_memory")
limits = int(sys.argv[3]) if len(sys.argv) > 3 else 12
enter_empty_folder(work)

SIDE = 11  # nodes of a plate
with open("plate.k", "w") as file:
    file.write("*KEYWORD\n*NODE\n" + "".join(f"{1 + i + SIDE * j},{0.01 * i},{0.01 * j},0.\n" for j in range(SIDE) for i in range(SIDE)))
    file.write("*ELEMENT_SHELL\n" + "".join(f"{1 + i + SIDE * j},1,{1 + i + SIDE * j},{2 + i + SIDE * j},{2 + i + SIDE * (j + 1)},{1 + i + SIDE * (j + 1)}\n"
                                            for j in range(SIDE - 1) for i in range(SIDE - 1)))
    file.write("*PART\nplate\n1,1,1\n*SECTION_SHELL\n1,2\n.001\n*MAT_ELASTIC\n1,7850.,2.1e11,.3\n*INITIAL_VELOCITY_NODE\n61,0.,0.,10.\n"
               "*CONTROL_TERMINATION\n4.e-4\n*DATABASE_BINARY_D3PLOT\n6.67e-5\n*DATABASE_BINARY_RUNRSF\n40\n")
    file.write("".join(f"*DATABASE_{name}\n1.33e-5\n" for name in ("GLSTAT", "MATSUM", "NODOUT", "RBDOUT", "SPCFORC", "BNDOUT")))
    file.write("*DATABASE_HISTORY_NODE\n" + "".join(",".join(str(8 * k + i) for i in range(1, 9)) + "\n" for k in range(5)) + "*END\n")


def run(megabytes, threads):
    """Exit code and text; -1 where it does not end."""
    try:
        done = subprocess.run([courant, "run", "plate.k", "-o", f"run{threads}", "--quiet", "--threads", str(threads)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, timeout=60, stdin=subprocess.DEVNULL,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (int(megabytes * 1e6), int(megabytes * 1e6))))
    except subprocess.TimeoutExpired:
        return -1, "it does not end"
    return done.returncode, done.stdout


for threads in (1, 4):
    enough = 64.0
    while run(enough, threads)[0] != 0 and enough < 8000:
        enough *= 1.3
    codes = {}
    for k in range(limits):
        megabytes = enough * (0.55 + 0.45 * k / limits)
        code, said = run(megabytes, threads)
        codes[round(megabytes)] = code
        check(code in (0, 1, 2, 3, 127), f"{threads} threads, {megabytes:.1f} MB: exit code {code}")
        # 127: the system could not load the program
        check(code in (0, 127) or "memory" in said or "thread" in said.lower(), f"{threads} threads, {megabytes:.1f} MB: says why: {said.strip()[-200:]!r}")
    print(f"{threads} threads: enough are {enough:.0f} MB; {codes}")
sys.exit(1 if failures else 0)
