#!/usr/bin/env python3
"""Seconds and bytes that many shells take before the first step.

usage: shells_set_up.py COURANT [SIDE]

A plate of SIDE x SIDE (default 1000) shells of *MAT_024 with five points runs one step, and one of a single shell: the
difference of wall and processor time is what reading and set-up take, that of the largest memory over the number of
shells what each takes.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time


def write_deck(path, side):
    with open(path, "w", encoding="ascii") as file:
        file.write("*KEYWORD\n*CONTROL_TERMINATION\n       1.0         1\n*PART\nplate\n         1         1         1\n"
                   "*SECTION_SHELL\n         1         2     0.833         5\n     0.001\n"
                   "*MAT_PIECEWISE_LINEAR_PLASTICITY\n         1    7850.0   2.1E+11       0.3   3.0E+08   1.0E+09\n\n\n\n"
                   "*INITIAL_VELOCITY_NODE\n         1       0.0       0.0       1.0\n*NODE\n")
        n = side + 1
        for j in range(n):
            file.writelines(f"{1 + i + n * j:8}{0.01 * i:16.8e}{0.01 * j:16.8e}{0.0:16.8e}\n" for i in range(n))
        file.write("*ELEMENT_SHELL\n")
        for j in range(side):
            first = 1 + n * j
            file.writelines(f"{1 + i + side * j:8}{1:8}{first + i:8}{first + i + 1:8}{first + i + n + 1:8}{first + i + n:8}\n"
                            for i in range(side))
        file.write("*END\n")


def run(courant, deck, out):
    """Wall and processor seconds, and the largest memory in bytes."""
    command = [courant, "run", str(deck), "-o", str(out), "--quiet", "--no-final-dump"]
    start = time.monotonic()
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
        text = process.stdout.read()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = status >> 8
    if status:
        sys.exit(text)
    return time.monotonic() - start, used.ru_utime + used.ru_stime, 1024 * used.ru_maxrss


def main():
    courant, side = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_deck(folder / "one.k", 1)
        write_deck(folder / "many.k", side)
        one = run(courant, folder / "one.k", folder / "results_one")
        many = run(courant, folder / "many.k", folder / "results_many")
    wall, processor, memory = (b - a for a, b in zip(one, many))
    print(f"{side * side} shells: {wall:.1f} s of wall time, {processor:.1f} s of processor time, {memory / side**2:.0f} bytes each")


if __name__ == "__main__":
    main()
