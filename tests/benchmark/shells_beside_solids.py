#!/usr/bin/env python3
"""Seconds per element and step of shells and of hexahedra in one run, on one thread.

usage: shells_beside_solids.py COURANT [ROUNDS]

A plate of 100 x 100 shells (elastic, 2 points) and a block of 20 x 20 x 25 hexahedra (elastic) move freely for 300
steps. What each pass took comes from the timing table of the run; the least of the rounds counts.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SIDE, BLOCK, STEPS = 100, (20, 20, 25), 300


def deck(points):
    nodes, shells, solids = [], [], []
    for j in range(SIDE + 1):
        for i in range(SIDE + 1):
            nodes.append((0.01 * i, 0.01 * j, 1.0))
    for j in range(SIDE):
        for i in range(SIDE):
            a = j * (SIDE + 1) + i + 1
            shells.append((a, a + 1, a + SIDE + 2, a + SIDE + 1))
    first = len(nodes) + 1
    nx, ny, nz = BLOCK
    for k in range(nz + 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                nodes.append((0.02 * i, 0.02 * j, 0.02 * k - 2))
    at = lambda i, j, k: first + i + (nx + 1) * (j + (ny + 1) * k)
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                solids.append([at(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
    out = [f"*KEYWORD\n*CONTROL_TERMINATION\n       1.0{STEPS:10}\n"]
    out.append(f"*PART\nplate\n         1         1         1\n*SECTION_SHELL\n         1         2     0.833{points:10}\n"
               "     0.005\n*PART\nblock\n         2         2         1\n*SECTION_SOLID\n         2         1\n"
               "*MAT_ELASTIC\n         1    7850.0   2.1E+11       0.3\n"
               "*INITIAL_VELOCITY_NODE\n         1       0.0       0.0       1.0\n"
               f"{first:10}       0.0       0.0       1.0\n*NODE\n")
    out += [f"{n + 1:8}{x:16.8e}{y:16.8e}{z:16.8e}\n" for n, (x, y, z) in enumerate(nodes)]
    out.append("*ELEMENT_SHELL\n")
    out += [f"{e + 1:8}{1:8}" + "".join(f"{n:8}" for n in s) + "\n" for e, s in enumerate(shells)]
    out.append("*ELEMENT_SOLID\n")
    out += [f"{e + 1:8}{2:8}" + "".join(f"{n:8}" for n in s) + "\n" for e, s in enumerate(solids)]
    return "".join(out) + "*END\n"


def seconds_of_passes(courant, folder):
    env = {**os.environ, "OMP_NUM_THREADS": "1"}
    run = subprocess.run([courant, "run", str(folder / "deck.k"), "-o", str(folder / "results")], env=env, text=True,
                         capture_output=True, check=False)
    text = run.stdout + run.stderr
    found = {}
    for name in ("shells of part 1", "solids of part 2", "assembly of nodal forces", "assembly of nodal moments"):
        row = re.search(rf"{name}\s+([\d.]+)", text)
        if not row:
            sys.exit(text + f"\nno time of '{name}'")
        found[name] = float(row.group(1))
    return found


def main():
    courant, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    for points in (2, 5):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "deck.k").write_text(deck(points))
            all_rounds = [seconds_of_passes(courant, folder) for _ in range(rounds)]
        least = {key: min(one[key] for one in all_rounds) for key in all_rounds[0]}
        shells, solids = least["shells of part 1"] / SIDE**2, least["solids of part 2"] / (BLOCK[0] * BLOCK[1] * BLOCK[2])
        print(f"{points} points: shells {1e9 * shells / STEPS:.0f} ns, hexahedra {1e9 * solids / STEPS:.0f} ns per "
              f"element and step, ratio {shells / solids:.2f}; assembly of moments "
              f"{1e9 * least['assembly of nodal moments'] / SIDE**2 / STEPS:.0f} ns per shell")


if __name__ == "__main__":
    main()
