#!/usr/bin/env python3
"""Writes the deck of a square tube of steel that a falling mass crushes along its axis.

usage: deck.py [--h H] [--length L] [--mass M] [--speed V] [--rate C P] [--friction F] [--fields DT] > crush_tube.k
Sides C x C of the middle surface, thickness T; shells of about H. It stands clamped on z = 0; a rigid wall of mass M comes down on its free end.
The deck holds a quarter, of tube and mass, between the planes of symmetry x = 0 and y = 0.
Units: mm, ms, kg, kN, GPa.
"""
import argparse
import math

SIDE, THICKNESS = 37.07, 1.152  # of tubes that Abramowicz and Jones (1984) crushed
STEEL = 7.85e-6, 207.0, 0.3  # RO, E, PR
YIELD, ULTIMATE, EXPONENT = 0.251, 0.339, 0.12  # of mild steel: yield and ultimate stress, hardening sigma = K strain^n


def fold():
    """Half of the length of a fold of the inextensional mode (Wierzbicki and Abramowicz 1983)."""
    return 0.983 * SIDE ** (2 / 3) * THICKNESS ** (1 / 3)


def flow_stress():
    """Of a perfectly plastic steel that takes as much energy (Wierzbicki and Abramowicz)."""
    return math.sqrt(YIELD * ULTIMATE / (1 + EXPONENT))


def hardening():
    """True stress over plastic strain: a tensile test with that law has the ultimate stress K (n/e)^n at the strain n."""
    k = ULTIMATE * (math.e / EXPONENT) ** EXPONENT
    plastic = [0.0] + [0.002 * 1.25 ** i for i in range(33)]
    first = (YIELD / k) ** (1 / EXPONENT)
    return [(p, k * (first + p) ** EXPONENT) for p in plastic]


def mean_force():
    """Of progressive crushing in the inextensional mode, effective crushing distance of 0.73 of the tube."""
    return 38.12 / 0.73 * 0.25 * flow_stress() * THICKNESS ** 2 * (SIDE / THICKNESS) ** (1 / 3)


def rate_factor(speed, rate):
    """By which the force grows: rate of strain 0.33 V/c (Abramowicz and Jones 1984) in the law of Cowper and Symonds."""
    return 1 + (0.33 * speed / (SIDE * rate[0])) ** (1 / rate[1])


def dent(s, z, length):
    """Outward displacement at s along the side from its middle, in one fold below the free end; its neighbours have the opposite."""
    depth = length - z
    if depth > 2 * fold():
        return 0.0
    return 0.3 * THICKNESS * math.sin(0.5 * math.pi * depth / fold()) ** 2 * math.cos(math.pi * s / SIDE)


def tube(h, length):
    """Of the quarter x >= 0, y >= 0: one half side from y = 0 to the corner, the next from there to x = 0."""
    n, m = round(0.5 * SIDE / h), round(length / h)
    nodes, shells = [], []
    for k in range(m + 1):
        z = length * k / m
        first = [(0.5 * SIDE + dent(s, z, length), s) for s in (0.5 * SIDE * i / n for i in range(n + 1))]
        second = [(s, 0.5 * SIDE - dent(s, z, length)) for s in (0.5 * SIDE * i / n for i in range(n - 1, -1, -1))]
        nodes += [(x, y, z) for x, y in first + second]
    around = 2 * n + 1
    for k in range(m):
        for i in range(around - 1):
            shells.append([k * around + i + 1, k * around + i + 2, (k + 1) * around + i + 2, (k + 1) * around + i + 1])
    return nodes, shells


def row(*values):
    return "".join(f"{v:10d}" if isinstance(v, int) else f"{v:10.4g}" if isinstance(v, float) else f"{v:>10}" for v in values)


def deck(h=3.0, length=100.0, mass=100.0, speed=8.0, rate=(0.0, 0.0), friction=0.1, points=5, end=9.0, hourglass=(4, 0.02), fields=0.0, elform=2):
    nodes, shells = tube(h, length)

    def node_set(number, where):
        ids = [i + 1 for i, x in enumerate(nodes) if where(x)]
        return ["*SET_NODE_LIST", row(number)] + ["".join(f"{i:10d}" for i in ids[k:k + 8]) for k in range(0, len(ids), 8)]

    tiny = 1e-6
    out = ["*KEYWORD", "*TITLE", f"square tube crushed by {mass:g} kg at {speed:g} m/s, {len(shells)} shells, mm ms kg kN GPa",
           "*CONTROL_TERMINATION", row(end),
           "*CONTROL_TIMESTEP", row(0.0, 0.9),
           "*CONTROL_ENERGY", row(2, 2, 2),
           "*DATABASE_GLSTAT", row(end / 1000),
           "*DATABASE_MATSUM", row(end / 1000),
           "*DATABASE_RWFORC", row(end / 1000)]
    if fields > 0:
        out += ["*DATABASE_BINARY_D3PLOT", row(fields)]
    out += ["*PART", "tube", row(1, 1, 1, 0, 1),
            "*SECTION_SHELL", row(1, elform, 0.833333, points), row(THICKNESS),
            "*HOURGLASS", row(1, *hourglass),
            "*MAT_PIECEWISE_LINEAR_PLASTICITY", row(1, *STEEL, YIELD), row(float(rate[0]), float(rate[1]), 1), row(0.0), row(0.0),
            "*DEFINE_CURVE", row(1)] + [f"{p:20.6g}{s:20.6g}" for p, s in hardening()]
    out += ["*RIGIDWALL_PLANAR_MOVING_ID", f"{1:10d}mass", row(0), row(0.0, 0.0, length, 0.0, 0.0, 0.0, friction), row(0.25 * mass, speed),
            "*BOUNDARY_SPC_SET", row(1, 0, 1, 1, 1, 1, 1, 1), row(2, 0, 1, 0, 0, 0, 1, 1), row(3, 0, 0, 1, 0, 1, 0, 1),
            "*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID", f"{1:10d}folds", row(1, 0, 3), row(friction, friction), row(0.0)]
    out += node_set(1, lambda x: x[2] < tiny) + node_set(2, lambda x: x[0] < tiny) + node_set(3, lambda x: x[1] < tiny)
    out += ["*NODE"] + [f"{i + 1:8d}{x:16.9e}{y:16.9e}{z:16.9e}" for i, (x, y, z) in enumerate(nodes)]
    out += ["*ELEMENT_SHELL"] + [f"{e + 1:8d}{1:8d}" + "".join(f"{i:8d}" for i in s) for e, s in enumerate(shells)]
    return "\n".join(out + ["*END", ""])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--h", type=float, default=3.0, help="side of a shell, mm")
    parser.add_argument("--length", type=float, default=100.0, help="of the tube, mm")
    parser.add_argument("--mass", type=float, default=100.0, help="that falls, kg")
    parser.add_argument("--speed", type=float, default=8.0, help="of it, m/s")
    parser.add_argument("--rate", type=float, nargs=2, default=[0.0, 0.0], metavar=("C", "P"), help="of Cowper and Symonds, 1/ms; none")
    parser.add_argument("--friction", type=float, default=0.1)
    parser.add_argument("--elform", type=int, default=2, help="of *SECTION_SHELL")
    parser.add_argument("--points", type=int, default=5, help="through the thickness")
    parser.add_argument("--hourglass", nargs=2, default=["4", "0.02"], metavar=("IHQ", "QM"))
    parser.add_argument("--end", type=float, default=9.0, help="ms")
    parser.add_argument("--fields", type=float, default=0.0, help="interval of field files, ms")
    a = parser.parse_args()
    print(deck(a.h, a.length, a.mass, a.speed, a.rate, a.friction, a.points, a.end, (int(a.hourglass[0]), float(a.hourglass[1])), a.fields, a.elform), end="")
