#!/usr/bin/env python3
"""Times one-point solids with *MAT_ELASTIC beside LULESH 2.0, in turn on one machine: nanoseconds of processor time per element and step.

usage: solids_beside_lulesh.py COURANT LULESH_CHECKOUT [--edge 40] [--steps 200] [--rounds 3] [--threads 2]

LULESH_CHECKOUT is your own checkout of https://github.com/LLNL/LULESH; it is built here without MPI, in a temporary folder. Both run EDGE^3 hexahedra.
What takes time besides the steps (reading, set-up, files) is taken out by runs of STEPS and of twice as many.
"""
import argparse
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time


def deck(edge, steps):
    """A cube that a gentle velocity field stretches, of steps of a fixed number."""
    n = edge + 1
    lines = ["*KEYWORD", "*CONTROL_TERMINATION", f"{1e9:10.3g}{steps:10}", "*PART", "cube", f"{1:10}{1:10}{1:10}", "*SECTION_SOLID", f"{1:10}{1:10}",
             "*MAT_ELASTIC", f"{1:10}{1000.0:10.1f}{1e7:10.3g}{0.3:10.2f}", "*INITIAL_VELOCITY", f"{0:10}", f"{0.1:10.2f}{0.2:10.2f}{0.3:10.2f}", "*NODE"]
    lines += [f"{1 + i + n * (j + n * k):8}{i / edge:16.9e}{j / edge:16.9e}{k / edge:16.9e}" for k in range(n) for j in range(n) for i in range(n)]
    lines.append("*ELEMENT_SOLID")
    element = 0
    for k in range(edge):
        for j in range(edge):
            for i in range(edge):
                at = [1 + i + a + n * (j + b + n * (k + c)) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                element += 1
                lines.append(f"{element:8}{1:8}" + "".join(f"{one:8}" for one in at))
    return "\n".join(lines + ["*END", ""])


def seconds(command, threads, cwd):
    """Wall and processor seconds of a command."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env={**os.environ, "OMP_NUM_THREADS": str(threads)})
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout[-2000:]}")
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("courant", type=pathlib.Path)
    options.add_argument("lulesh", type=pathlib.Path)
    for name, value in (("edge", 40), ("steps", 100), ("rounds", 3), ("threads", 2)):
        options.add_argument(f"--{name}", type=int, default=value)
    a = options.parse_args()
    courant, size = a.courant.resolve(), a.edge ** 3
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder) / "lulesh"
        sources = sorted(a.lulesh.resolve().glob("*.cc"))
        if not sources:
            sys.exit(f"{a.lulesh}: no *.cc of LULESH there")
        subprocess.run(["g++", "-O3", "-march=native", "-DUSE_MPI=0", "-fopenmp", "-w", *sources, "-o", program], check=True)
        for steps in (a.steps, 2 * a.steps):
            (pathlib.Path(folder) / f"cube{steps}.k").write_text(deck(a.edge, steps))

        def courant_run(steps, threads):
            return seconds([courant, "run", f"cube{steps}.k", "-o", f"out{steps}", "--quiet", "--no-final-dump", "--threads", str(threads)], threads, folder)

        def lulesh_run(steps, threads):
            return seconds([program, "-s", str(a.edge), "-i", str(steps)], threads, folder)

        def per_element(run, threads):
            """(wall, processor) ns per element and step."""
            short, long = run(a.steps, threads), run(2 * a.steps, threads)
            return [1e9 * (more - less) / (a.steps * size) for less, more in zip(short, long)]

        ratios, speedups = [], []
        for number in range(a.rounds):
            ours, theirs = per_element(courant_run, 1), per_element(lulesh_run, 1)
            together = per_element(courant_run, a.threads)
            ratios.append(ours[1] / theirs[1])
            speedups.append(ours[0] / together[0])
            print(f"round {number + 1}: courant {ours[1]:.0f} ns, LULESH {theirs[1]:.0f} ns, ratio {ratios[-1]:.3f}; "
                  f"courant on {a.threads} threads {together[0]:.0f} ns of wall time, {speedups[-1]:.2f} times one", flush=True)
        print(f"medians: ratio {statistics.median(ratios):.3f}, {a.threads} threads {statistics.median(speedups):.2f} times one")


if __name__ == "__main__":
    main()
