#!/usr/bin/env python3
"""Bodies of four shapes with random meshes, thrown at each other in twelve orientations: who leaks, what energy the contact loses or makes.

usage: pressed_shapes.py COURANT [--meshes N] [--orientations N] [--speed V] [--list] [--soft]
Not a test: it measures and prints a row for each shape. Elastic blocks (E 1e7, density 1000, c 100 m/s), 0.1 m wide, of 4 to 7 one-point hexahedra a
side whose inner nodes are off by up to a tenth of a cell; each comes with V, 0.5 m/s. Both sides push (`*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE`).
"""
import argparse
import math
import os
import random
import re
import subprocess
import tempfile


def cube(x):
    return x


def rounded(x):
    """Most of the path to a ball: all of it would make the angles of elements at the edges flat."""
    far, size = max(abs(v) for v in x), math.sqrt(sum(v * v for v in x))
    scale = 0.3 + 0.7 * far / size if size > 0 else 1
    return [v * scale for v in x]


def cylinder(x):
    far, size = max(abs(x[0]), abs(x[1])), math.hypot(x[0], x[1])
    scale = 0.3 + 0.7 * far / size if size > 0 else 1
    return [x[0] * scale, x[1] * scale, x[2]]


def frustum(x):
    scale = 0.65 - 0.35 * x[2]
    return [x[0] * scale, x[1] * scale, x[2]]


SHAPES = {"cube": cube, "rounded cube": rounded, "rounded cylinder": cylinder, "frustum": frustum}


def turned(q, x):
    w, u = q[0], q[1:]
    size = math.sqrt(sum(v * v for v in q))
    w, u = w / size, [v / size for v in u]

    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

    t = [2 * v for v in cross(u, x)]
    return [a + w * b + c for a, b, c in zip(x, t, cross(u, t))]


def mesh(shape, dice, first):
    """Nodes within a cube of side 0.1 before they are turned, and hexahedra by node number."""
    n = [dice.randint(4, 7) for _ in range(3)]
    nodes, solids = [], []
    for k in range(n[2] + 1):
        for j in range(n[1] + 1):
            for i in range(n[0] + 1):
                x = [2 * a / b - 1 + (dice.uniform(-0.2, 0.2) / b if 0 < a < b else 0) for a, b in zip((i, j, k), n)]
                nodes.append([0.05 * v for v in SHAPES[shape](x)])

    def at(i, j, k):
        return first + (k * (n[1] + 1) + j) * (n[0] + 1) + i

    for k in range(n[2]):
        for j in range(n[1]):
            for i in range(n[0]):
                solids.append([at(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
    return nodes, solids


def deck(shape, number, orientation, speed, soft):
    meshes, turns = random.Random(f"{shape} {number}"), random.Random(f"turn {orientation}")
    out = ["*KEYWORD", "*CONTROL_TERMINATION", f"{0.15 / speed:.6g}", "*CONTROL_TIMESTEP", "0.0,0.9", "*CONTROL_ENERGY", "2,2,2", "*SECTION_SOLID", "1,1",
           "*MAT_ELASTIC", "1,1000.0,1.0E7,0.3", "*HOURGLASS", "1,5,0.1", "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "1,2,3,3", "0.0", ""]
    if soft:
        out += ["1"]
    nodes, solids = [], []
    for part, sign in ((1, 1), (2, -1)):
        places, cells = mesh(shape, meshes, len(nodes) + 1)
        q = [turns.gauss(0, 1) for _ in range(4)]
        off = [0.0, 0.0, 0.0] if part == 1 else [turns.uniform(-0.02, 0.02), turns.uniform(-0.02, 0.02), 0.18]
        nodes += [[a + b for a, b in zip(turned(q, x), off)] for x in places]
        solids += [(part, c) for c in cells]
        out += ["*PART", f"body {part}", f"{part},1,1,0,1", "*INITIAL_VELOCITY_GENERATION", f"{part},2,0.0,0.0,0.0,{sign * speed}", ""]
    out += ["*NODE"] + [f"{i + 1},{x[0]:.12g},{x[1]:.12g},{x[2]:.12g}" for i, x in enumerate(nodes)]
    out += ["*ELEMENT_SOLID"] + [f"{i + 1},{p}," + ",".join(map(str, c)) for i, (p, c) in enumerate(solids)]
    return "\n".join(out + ["*END", ""])


def case(courant, folder, shape, number, orientation, speed, soft):
    """What the energy balance lacks, of the energy at the start; nodes that went through faces."""
    path, out = (os.path.join(folder, f"{shape.replace(' ', '_')}_{number}_{orientation}{end}") for end in (".k", ""))
    with open(path, "w", encoding="utf-8") as file:
        file.write(deck(shape, number, orientation, speed, soft))
    subprocess.run([os.path.abspath(courant), "run", path, "-o", out, "--threads", "1", "--quiet"], check=False, cwd=folder,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(os.path.join(out, "summary.yaml"), encoding="utf-8") as file:
        values = {k: float(v) for k, v in re.findall(r"^ *(residual|initial|leaked_nodes): (\S+)$", file.read(), re.M)}
    return abs(values["residual"]) / values["initial"], int(values["leaked_nodes"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("courant")
    parser.add_argument("--meshes", type=int, default=10)
    parser.add_argument("--orientations", type=int, default=12)
    parser.add_argument("--speed", type=float, default=0.5)
    parser.add_argument("--list", action="store_true", help="each run that is off by more than 2 %%, or leaks")
    parser.add_argument("--soft", action="store_true", help="SOFT 1")
    a = parser.parse_args()
    print("| shape | runs | runs with leaks | energy off by more than 2 % | more than 1 % | median | largest |\n|---|---:|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        for shape in SHAPES:
            errors, leaks, worst = [], 0, ""
            for number in range(a.meshes):
                for orientation in range(a.orientations):
                    error, leaked = case(a.courant, folder, shape, number, orientation, a.speed, a.soft)
                    if not errors or error > max(errors):
                        worst = f"mesh {number}, orientation {orientation}"
                    if a.list and (error > 0.02 or leaked):
                        print(f"{shape}, mesh {number}, orientation {orientation}: {100 * error:.1f} %, {leaked} leaked", flush=True)
                    errors.append(error)
                    leaks += leaked > 0
            errors.sort()
            print(f"| {shape} | {len(errors)} | {leaks} | {sum(e > 0.02 for e in errors)} | {sum(e > 0.01 for e in errors)} | {100 * errors[len(errors) // 2]:.2f} % | "
                  f"{100 * errors[-1]:.1f} % ({worst}) |", flush=True)


if __name__ == "__main__":
    main()
