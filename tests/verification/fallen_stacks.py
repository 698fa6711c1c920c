#!/usr/bin/env python3
"""Stacks of plates that fall and come to rest on each other, and cloths that fall over a ball: heights, energies, leaks.

usage: fallen_stacks.py COURANT [NAME ...] [--end T] [--keep FOLDER]
Not a test: it measures and prints a row for each case (all of them, or those named). *CONTACT_AUTOMATIC_SINGLE_SURFACE, VDC 20. Plates of n x n shells, 0.2 m
wide, each turned and shifted at random, fall by 0.1 m; cloths (0.5 m, 1 mm) fall on a rigid ball of 0.1 m and a floor.
"""
import argparse
import math
import os
import random
import re
import subprocess
import tempfile

G = 9.81
CASES = {  # plates: count, n, thickness, gap, E, density, end; cloths: n, ELFORM, IHQ, end
    "50 plates of 3 GPa, 4 x 4": ("plates", 50, 4, 0.004, 0.004, 3e9, 1200, 0.4),
    "50 plates of 3 GPa, 8 x 8": ("plates", 50, 8, 0.004, 0.004, 3e9, 1200, 0.26),
    "50 plates of aluminium, 4 x 4": ("plates", 50, 4, 0.002, 0.002, 7e10, 2700, 0.4),
    "cloth, 20 x 20": ("cloth", 20, 2, 0, 0.5),
    "cloth, 20 x 20, IHQ 4": ("cloth", 20, 2, 4, 0.5),
    "cloth, 40 x 40, IHQ 4": ("cloth", 40, 2, 4, 0.5),
    "cloth, 40 x 40, ELFORM 16": ("cloth", 40, 16, 0, 0.5),
}


class Deck:
    def __init__(self, end):
        self.nodes, self.shells = [], []
        self.cards = ["*KEYWORD", "*CONTROL_TERMINATION", f"{end:g}", "*CONTROL_TIMESTEP", "0.0,0.9", "*LOAD_BODY_Z", f"1,{G}", "*DEFINE_CURVE", "1", "0.0,1.0", "1000.0,1.0"]

    def sheet(self, part, n, place):
        """n x n shells over the unit square, whose places `place` gives."""
        first = len(self.nodes) + 1
        self.nodes += [place(i / n, j / n) for j in range(n + 1) for i in range(n + 1)]
        for j in range(n):
            for i in range(n):
                a = first + j * (n + 1) + i
                self.shells.append((part, a, a + 1, a + n + 2, a + n + 1))

    def floor(self, part):
        self.sheet(part, 2, lambda a, b: [2 * a - 1, 2 * b - 1, -0.005])
        self.cards += ["*PART", "floor", f"{part},{part},{part}", "*SECTION_SHELL", f"{part},2", "0.01", "*MAT_RIGID", f"{part},7800.0,2.0E11,0.3", "1,7,7"]

    def text(self):
        out = self.cards + ["*NODE"] + [f"{k + 1},{x[0]:.12g},{x[1]:.12g},{x[2]:.12g}" for k, x in enumerate(self.nodes)]
        out += ["*ELEMENT_SHELL"] + [f"{k + 1}," + ",".join(map(str, s)) for k, s in enumerate(self.shells)]
        return "\n".join(out + ["*END", ""])


def plates(count, n, t, gap, E, ro, end):
    deck, dice = Deck(end), random.Random("stack")
    for k in range(count):
        turn, x0, y0 = dice.uniform(0, 2 * math.pi), dice.uniform(-0.01, 0.01), dice.uniform(-0.01, 0.01)
        c, s, z = 0.2 * math.cos(turn), 0.2 * math.sin(turn), 0.1 + 0.5 * t + k * (t + gap)
        deck.sheet(k + 1, n, lambda a, b: [x0 + c * (a - 0.5) - s * (b - 0.5), y0 + s * (a - 0.5) + c * (b - 0.5), z])
        deck.cards += ["*PART", "plate", f"{k + 1},1,1"]
    deck.cards += ["*SECTION_SHELL", "1,2,,3", f"{t}", "*MAT_ELASTIC", f"1,{ro},{E},0.33"]
    deck.floor(1000)
    deck.cards += ["*CONTACT_AUTOMATIC_SINGLE_SURFACE", "0", "0.2,0.2,0.0,0.0,20.0", ""]
    top = range((count - 1) * (n + 1) ** 2 + 1, count * (n + 1) ** 2 + 1)
    deck.cards += ["*DATABASE_HISTORY_NODE"] + [str(i) for i in top] + ["*DATABASE_NODOUT", f"{end / 40:g}"]
    return deck.text()


def ball(deck, part, radius, n):
    """Six sheets of a cube, blown up, centre at z = radius."""
    for axis in range(3):
        for sign in (-1, 1):
            def place(a, b):
                x = [0.0] * 3
                x[axis], x[(axis + 1) % 3], x[(axis + 2) % 3] = sign, math.tan(math.pi / 4 * (2 * a - 1)), math.tan(math.pi / 4 * (2 * b - 1)) * sign
                size = math.sqrt(sum(v * v for v in x))
                return [radius * x[0] / size, radius * x[1] / size, radius * (1 + x[2] / size) + 1e-4]
            deck.sheet(part, n, place)
    deck.cards += ["*PART", "ball", f"{part},{part},{part}", "*SECTION_SHELL", f"{part},2", "0.001", "*MAT_RIGID", f"{part},7800.0,2.0E11,0.3", "1,7,7"]


def cloth(n, elform, ihq, end):
    deck = Deck(end)
    deck.sheet(1, n, lambda a, b: [0.5 * a - 0.25, 0.5 * b - 0.25, 0.21])
    deck.cards += ["*PART", "cloth", "1,1,1,0,1", "*HOURGLASS", f"1,{ihq},0.05", "*SECTION_SHELL", f"1,{elform},,3", "0.001", "*MAT_ELASTIC", "1,300.0,1.0E6,0.3", "*DAMPING_GLOBAL", "0,2.0"]
    ball(deck, 2, 0.1, 12)
    deck.floor(1000)
    deck.cards += ["*CONTACT_AUTOMATIC_SINGLE_SURFACE", "0", "0.3,0.3,0.0,0.0,20.0", ""]
    return deck.text()


def values_of(out):
    with open(os.path.join(out, "summary.yaml"), encoding="utf-8") as file:
        text = file.read()
    found = re.findall(r"^ *(\w+): ([-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?)$", text, re.M)
    values = {name: float(value) for name, value in reversed(found)}
    values["verdict"] = re.search(r"^verdict: (\w+)", text, re.M).group(1)
    values["reasons"] = re.findall(r'^  - "(.*)"$', text.split("verdict_reasons:")[1].split("time:")[0], re.M)
    return values


def top_of(out, nodes):
    """Mean height of the nodes of nodout at its last time."""
    last = {}
    with open(os.path.join(out, "nodout"), encoding="utf-8") as file:
        for line in file:
            if len(row := line.split()) == 13 and row[0].isdigit():
                last[int(row[0])] = float(row[12])
    return sum(last.values()) / len(last) if len(last) == nodes else math.nan


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("courant")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--end", type=float, help="end time of all cases")
    parser.add_argument("--keep", help="folder in which the results stay")
    a = parser.parse_args()
    print("| case | steps | top above its place, µm | kinetic, of what passed | created energy | hourglass over internal | leaks | verdict | s |\n|---|---:|---:|---:|---:|---:|---:|---|---:|")
    with tempfile.TemporaryDirectory() as scratch:
        folder = a.keep or scratch
        os.makedirs(folder, exist_ok=True)
        for name, (kind, *given) in CASES.items():
            if a.names and name not in a.names:
                continue
            if a.end:
                given[-1] = a.end
            path, out = (os.path.join(folder, re.sub(r"\W+", "_", name) + end) for end in (".k", ""))
            with open(path, "w", encoding="utf-8") as file:
                file.write({"plates": plates, "cloth": cloth}[kind](*given))
            subprocess.run([os.path.abspath(a.courant), "run", path, "-o", out, "--threads", "1", "--quiet"], check=False, cwd=folder,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            v = values_of(out)
            above = f"{1e6 * (top_of(out, (given[1] + 1) ** 2) - (given[0] - 0.5) * given[2]):.0f}" if kind == "plates" else ""
            print(f"| {name} | {v['steps']:.0f} | {above} | {v['kinetic'] / v['scale']:.1e} | {v['error']:.1e} | {v['hourglass'] / max(v['internal'], 1e-300):.2f} | "
                  f"{v['leaked_nodes']:.0f} | {v['verdict']} | {v['cpu_seconds']:.0f} |", flush=True)
            for reason in v["reasons"]:
                print(f"  {name}: {reason}", flush=True)


if __name__ == "__main__":
    main()
