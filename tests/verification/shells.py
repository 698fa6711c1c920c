#!/usr/bin/env python3
"""Frequencies of plates and the impulsive strip on several meshes, as a table for docs/verification_structures.md.

usage: shells.py COURANT
"""
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

STEEL = "*MAT_ELASTIC\n         1    7850.0   2.1E+11       0.3\n"
ALUMINIUM = "*MAT_PLASTIC_KINEMATIC\n         1  2.61E-04    1.04E7       0.3   41400.0       0.0       1.0\n"


def grid(a, b, nx, ny):
    return [(a * i / nx, b * j / ny) for j in range(ny + 1) for i in range(nx + 1)]


def elements(nx, ny, triangles):
    out = []
    for j in range(ny):
        for i in range(nx):
            a = j * (nx + 1) + i + 1
            b, c, d = a + 1, a + nx + 2, a + nx + 1
            if not triangles:
                out.append((a, b, c, d))
            elif (i + j) % 2 == 0:
                out += [(a, b, c, c), (c, d, a, a)]
            else:
                out += [(b, c, d, d), (d, a, b, b)]
    return "*ELEMENT_SHELL\n" + "".join(
        f"{e + 1:8}{1:8}" + "".join(f"{n:8}" for n in s) + "\n" for e, s in enumerate(out)), len(out)


def hold(number, code, nodes, where):
    ids = [k + 1 for k, x in enumerate(nodes) if where(*x)]
    text = f"*SET_NODE_LIST\n{number:10}\n"
    for k in range(0, len(ids), 8):
        text += "".join(f"{n:10}" for n in ids[k:k + 8]) + "\n"
    return text + f"*BOUNDARY_SPC_SET\n{number:10}         0" + "".join(f"{c:>10}" for c in code) + "\n"


def deck(nodes, end, dt, watched, thickness, points, material, holds, velocity, mesh, elform=2):
    text = (f"*KEYWORD\n*CONTROL_TERMINATION\n{end:10.3e}\n*DATABASE_NODOUT\n{dt:10.3e}\n*DATABASE_GLSTAT\n{end / 200:10.3e}\n"
            f"*DATABASE_HISTORY_NODE\n{watched:10}\n*PART\nplate\n         1         1         1         0         1\n"
            f"*SECTION_SHELL\n         1{elform:10}  0.833333{points:10}\n{thickness:10.4f}\n{material}"
            f"*HOURGLASS\n         1         {8 if elform == 16 else 4}      0.05\n" + "".join(holds) + "*INITIAL_VELOCITY_NODE\n")
    for k, x in enumerate(nodes):
        if abs(v := velocity(*x)) > 1e-15:
            text += f"{k + 1:10}{0.0:10}{0.0:10}{v:10.3e}\n"
    text += "*NODE\n" + "".join(f"{k + 1:8}{x:16.9e}{y:16.9e}{0.0:16}\n" for k, (x, y) in enumerate(nodes))
    return text + mesh + "*END\n"


def run(courant, text, watched):
    """Times and z displacements of a node, steps, seconds, energy ratio."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "deck.k").write_text(text)
        start = time.process_time()
        subprocess.run([courant, "run", str(folder / "deck.k"), "-o", str(folder / "results")], check=True,
                       capture_output=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
        children = os.times()
        out, t = [], None
        for line in (folder / "results" / "nodout").read_text().splitlines():
            found = re.search(r"at time\s+([\d.E+-]+)", line)
            t = float(found.group(1)) if found else t
            words = line.split()
            if len(words) > 6 and words[0] == str(watched):
                out.append((t, float(words[3])))
        seen = {}
        for t, z in out:  # rotations follow under the same number
            seen.setdefault(t, z)
        glstat = (folder / "results" / "glstat").read_text()
        ratios = [float(r) for r in re.findall(r"total energy / initial energy\.+\s+([\d.E+-]+)", glstat)]
        return sorted(seen.items()), max(ratios, key=lambda r: abs(r - 1)), children.children_user


def frequency(history):
    at = [t0 + z0 / (z0 - z1) * (t1 - t0) for (t0, z0), (t1, z1) in zip(history, history[1:]) if z0 * z1 < 0]
    return (len(at) - 1) / (2 * (at[-1] - at[0]))


def plate(courant, n, clamped, triangles=False, elform=2):
    nodes, (mesh, _) = grid(1, 1, n, n), elements(n, n, triangles)
    rim = lambda x, y: min(x, y, 1 - x, 1 - y) < 1e-9
    shape = (lambda a: math.sin(math.pi * a)**2) if clamped else (lambda a: math.sin(math.pi * a))
    watched = (n + 1) * (n // 2) + n // 2 + 1
    text = deck(nodes, 0.08, 2e-5, watched, 0.01, 2, STEEL, [hold(1, "111111" if clamped else "001000", nodes, rim)],
                lambda x, y: 0.01 * shape(x) * shape(y), mesh, elform)
    history, ratio, _ = run(courant, text, watched)
    closed = 89.6407 if clamped else 49.1715
    f = frequency(history)
    kind = "triangles" if triangles else "quadrilaterals" + (", ELFORM 16" if elform == 16 else "")
    print(f"| {'clamped' if clamped else 'simply supported'} | {kind} | {n} x {n} | {f:.3f} | {closed:.3f} | "
          f"{100 * (f / closed - 1):+.2f} % | {ratio:.4f} |")


def strip(courant, n, points, elform=2):
    nodes, (mesh, _) = grid(5, 0.6, n, 2), elements(n, 2, False)
    holds = [hold(1, "111111", nodes, lambda x, y: x > 5 - 1e-9), hold(2, "100011", nodes, lambda x, y: x < 1e-9),
             hold(3, "010101", nodes, lambda x, y: y < 1e-9)]
    text = deck(nodes, 8e-4, 1e-6, 1, 0.125, points, ALUMINIUM, holds, lambda x, y: -5000 if x < 1 + 1e-9 else 0, mesh, elform)
    history, ratio, _ = run(courant, text, 1)
    t, z = min(history, key=lambda p: p[1])
    print(f"| {n} | {points}{', ELFORM 16' if elform == 16 else ''} | {-z:.4f} | {1e6 * t:.0f} | {ratio:.4f} |")


def main():
    courant = sys.argv[1]
    print("| edges | elements | mesh | frequency, Hz | closed form | error | energy ratio furthest from 1 |\n|---|---|---|---:|---:|---:|---:|")
    for clamped in (False, True):
        for n in (10, 20, 40):
            plate(courant, n, clamped)
    plate(courant, 20, False, True)
    for clamped in (False, True):
        for n in (10, 20, 40):
            plate(courant, n, clamped, elform=16)
    print("\n| elements along half of the span | points | peak, in | at, µs | energy ratio furthest from 1 |\n|---:|---:|---:|---:|---:|")
    for n, points in ((20, 2), (20, 3), (20, 5), (40, 5)):
        strip(courant, n, points)
    for n in (20, 40):
        strip(courant, n, 5, elform=16)


if __name__ == "__main__":
    main()
