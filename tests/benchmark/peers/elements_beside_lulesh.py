#!/usr/bin/env python3
"""Times elements beside LULESH 2.0, in turn on one machine: nanoseconds of processor time per element and step.

usage: elements_beside_lulesh.py COURANT LULESH_CHECKOUT [--edge 40] [--steps 100] [--rounds 3] [--threads 2] [--kinds KIND ...]

LULESH_CHECKOUT is your own checkout of https://github.com/LLNL/LULESH; it is built here without MPI, in a temporary folder. It runs EDGE^3 hexahedra,
Courant as many elements of each kind: one-point hexahedra and shells, elastic ones and plastic ones (*MAT_024) that yield throughout.
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

ELASTIC = ["*MAT_ELASTIC", f"{1:10}{1000.0:10.1f}{1e7:10.3g}{0.3:10.2f}"]
PLASTIC = ["*MAT_PIECEWISE_LINEAR_PLASTICITY", f"{1:10}{1000.0:10.1f}{1e7:10.3g}{0.3:10.2f}{1e2:10.3g}{1e5:10.3g}", "", "", ""]
KINDS = {"hexahedra-elastic": ("solid", ELASTIC, 0), "hexahedra-024": ("solid", PLASTIC, 0),
         "shells-elastic-2": ("shell", ELASTIC, 2), "shells-024-5": ("shell", PLASTIC, 5)}


def deck(kind, edge, steps):
    """A cube, or a plate of as many elements, that a velocity field stretches and shears, of steps of a fixed number."""
    element, material, points = KINDS[kind]
    counts = (edge, edge, edge) if element == "solid" else (edge * 5, edge * edge // 5, 0)
    nx, ny, nz = (c + 1 for c in counts)
    places = [(i / edge, j / edge, k / edge) for k in range(nz) for j in range(ny) for i in range(nx)]
    section = f"{1:10}{1:10}" if element == "solid" else f"{1:10}{2:10}{0.833:10.3f}{points:10}\n{0.2 / edge:10.6f}"
    lines = ["*KEYWORD", "*CONTROL_TERMINATION", f"{1e9:10.3g}{steps:10}", "*PART", "elements", f"{1:10}{1:10}{1:10}",
             f"*SECTION_{element.upper()}", section, *material, "*INITIAL_VELOCITY_NODE"]
    lines += [f"{n + 1:10}{0.02 * x * y:10.2e}{0.03 * y:10.2e}{0.1 * x * (x - y):10.2e}" for n, (x, y, _) in enumerate(places)]
    lines.append("*NODE")
    lines += [f"{n + 1:8}{x:16.9e}{y:16.9e}{z:16.9e}" for n, (x, y, z) in enumerate(places)]
    lines.append(f"*ELEMENT_{element.upper()}")
    corners = [(a, b, c) for c in ((0, 1) if element == "solid" else (0,)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    cells = [(i, j, k) for k in range(max(1, nz - 1)) for j in range(ny - 1) for i in range(nx - 1)]
    for e, (i, j, k) in enumerate(cells):
        lines.append(f"{e + 1:8}{1:8}" + "".join(f"{1 + i + a + nx * (j + b + ny * (k + c)):8}" for a, b, c in corners))
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
    options.add_argument("--kinds", nargs="+", choices=list(KINDS), default=list(KINDS))
    a = options.parse_args()
    courant, size = a.courant.resolve(), a.edge ** 3
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder) / "lulesh"
        sources = sorted(a.lulesh.resolve().glob("*.cc"))
        if not sources:
            sys.exit(f"{a.lulesh}: no *.cc of LULESH there")
        subprocess.run(["g++", "-O3", "-march=native", "-DUSE_MPI=0", "-fopenmp", "-w", *sources, "-o", program], check=True)
        for kind in a.kinds:
            for steps in (a.steps, 2 * a.steps):
                (pathlib.Path(folder) / f"{kind}{steps}.k").write_text(deck(kind, a.edge, steps))

        def courant_run(kind):
            return lambda steps, threads: seconds(
                [courant, "run", f"{kind}{steps}.k", "-o", f"out{steps}", "--quiet", "--no-final-dump", "--threads", str(threads)], threads, folder)

        def lulesh_run(steps, threads):
            return seconds([program, "-s", str(a.edge), "-i", str(steps)], threads, folder)

        def per_element(run, threads):
            """(wall, processor) ns per element and step."""
            short, long = run(a.steps, threads), run(2 * a.steps, threads)
            return [1e9 * (more - less) / (a.steps * size) for less, more in zip(short, long)]

        ratios, speedups = {kind: [] for kind in a.kinds}, {kind: [] for kind in a.kinds}
        for number in range(a.rounds):
            for kind in a.kinds:
                ours, theirs = per_element(courant_run(kind), 1), per_element(lulesh_run, 1)
                together = per_element(courant_run(kind), a.threads)
                ratios[kind].append(ours[1] / theirs[1])
                speedups[kind].append(ours[0] / together[0])
                print(f"round {number + 1}, {kind}: courant {ours[1]:.0f} ns, LULESH {theirs[1]:.0f} ns, ratio {ratios[kind][-1]:.3f}; "
                      f"courant on {a.threads} threads {together[0]:.0f} ns of wall time, {speedups[kind][-1]:.2f} times one", flush=True)
        for kind in a.kinds:
            print(f"{kind}: medians: ratio {statistics.median(ratios[kind]):.3f}, {a.threads} threads {statistics.median(speedups[kind]):.2f} times one")


if __name__ == "__main__":
    main()
