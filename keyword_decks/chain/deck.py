#!/usr/bin/env python3
"""Writes the deck of a chain of rigid links on joints: it falls from level, held at one end, or hangs between two points.

usage: deck.py [--links N] [--catenary SPAN] [--step DT] [--end S] [--fields DT] > chain.k
The chain is 1 m long and weighs 5 kg; links are thin rods. Units: m, s, kg, N. It moves in the plane y = 0; gravity acts along -z.
"""
import argparse
import math

LENGTH, MASS, GRAVITY = 1.0, 5.0, 9.81
WIDTH = 0.018  # of the bars that stand for the rods in pictures


def inertia(links):
    """Of a rod about its middle, and a little along it, where nothing turns it."""
    m, l = MASS / links, LENGTH / links
    return m * l * l / 12, 1e-2 * m * l * l / 12


def hanging(links, span):
    """Angles of the links over the level when the chain hangs still: the force along the chain turns by a link's weight at each link."""
    def slopes(pull):  # pull: level force, in weights of a link
        return [math.atan((k - 0.5 * (links - 1)) / pull) for k in range(links)]

    low, high = 1e-3, 1e6
    for _ in range(200):
        middle = math.sqrt(low * high)
        width = sum(math.cos(a) for a in slopes(middle)) * LENGTH / links
        low, high = (middle, high) if width < span else (low, middle)
    return slopes(low), low * MASS / links * GRAVITY


def row(*values):
    return ",".join(f"{v}" if isinstance(v, int) else f"{v:.16g}" for v in values)


def deck(links=50, span=0.0, step=0.0, end=0.6, fields=0.0, kind="REVOLUTE", history=200, disturbed=0.0):
    l, m = LENGTH / links, MASS / links
    angles = [0.0] * links
    if span > 0:
        angles = [a + disturbed * math.sin(2 * math.pi * (k + 0.5) / links) for k, a in enumerate(hanging(links, span)[0])]
    places = [(0.0, 0.0)]
    for a in angles:
        places.append((places[-1][0] + l * math.cos(a), places[-1][1] + l * math.sin(a)))
    along, across = inertia(links)[1], inertia(links)[0]
    nodes, parts, solids, extra, joints = [], [], [], [], []

    def bar(part, x, a, half, mass, fixed):
        c, s = math.cos(a), math.sin(a)
        first = len(nodes) + 1
        for u, v, w in ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)):
            nodes.append((x[0] + half * u * c - 0.5 * WIDTH * w * s, 0.5 * WIDTH * v, x[1] + half * u * s + 0.5 * WIDTH * w * c))
        solids.append(row(part, part, *range(first, first + 8)))
        xx, zz, xz = along * c * c + across * s * s, along * s * s + across * c * c, (along - across) * c * s
        parts.extend(["*PART_INERTIA", f"link {part}", row(part, 1, 2 if fixed else 1), row(x[0], 0.0, x[1], mass), row(xx, 0.0, xz, across, 0.0, zz), row(0.0, 0.0, 0.0)])

    def joint(a, b, x):
        ids = []
        for k in range(2 if kind == "REVOLUTE" else 1):
            for part in (a, b):
                nodes.append((x[0], 0.01 * k, x[1]))
                extra.append(row(part, len(nodes)))
                ids.append(len(nodes))
        joints.extend([f"*CONSTRAINED_JOINT_{kind}_ID", f"{len(joints) // 3 + 1:10d}joint", row(*ids)])
        return ids[0]

    for k, a in enumerate(angles):
        middle = [0.5 * (places[k][i] + places[k + 1][i]) for i in (0, 1)]
        bar(k + 1, middle, a, 0.5 * l, m, False)
    ends = [places[0]] + ([places[-1]] if span > 0 else [])
    for k, x in enumerate(ends):
        bar(links + 1 + k, (x[0], x[1] + 1.5 * WIDTH), 0.0, WIDTH, m, True)
    traced = [joint(links + 1, 1, places[0])] + [joint(k, k + 1, places[k]) for k in range(1, links)]
    if span > 0:
        traced.append(joint(links, links + 2, places[-1]))
    else:
        nodes.append((places[-1][0], 0.0, places[-1][1]))
        extra.append(row(links, len(nodes)))
        traced.append(len(nodes))
    out = ["*KEYWORD", "*TITLE", f"chain of {links} links" + (f" hanging between points {span:g} m apart" if span > 0 else " falling from level") + ", m s kg N",
           "*CONTROL_TERMINATION", row(end), "*DATABASE_GLSTAT", row(end / history), "*DATABASE_NODOUT", row(end / history), "*DATABASE_JNTFORC", row(end / history),
           "*DATABASE_HISTORY_NODE"] + [row(*traced[k:k + 8]) for k in range(0, len(traced), 8)]
    if step > 0:
        out += ["*CONTROL_TIMESTEP", row(0.0, 0.9, 0, 0.0, 0.0, 2), "*DEFINE_CURVE", "2", row(0.0, step), row(1000.0, step)]
    if fields > 0:
        out += ["*DATABASE_BINARY_D3PLOT", row(fields)]
    out += ["*SECTION_SOLID", "1,1", "*MAT_RIGID", "1,7850.0,2.0E11,0.3", "0.0", "", "*MAT_RIGID", "2,7850.0,2.0E11,0.3", "1.0,7,7", ""] + parts
    out += ["*LOAD_BODY_Z", row(1, GRAVITY), "*DEFINE_CURVE", "1", "0.0,1.0", "1000.0,1.0"] + joints + ["*CONSTRAINED_EXTRA_NODES_NODE"] + extra
    out += ["*NODE"] + [row(i + 1, *x) for i, x in enumerate(nodes)] + ["*ELEMENT_SOLID"] + solids
    return "\n".join(out + ["*END", ""])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--links", type=int, default=50)
    parser.add_argument("--catenary", type=float, default=0.0, metavar="SPAN", help="hangs between two points so far apart, m")
    parser.add_argument("--step", type=float, default=0.0, help="time step, s; 1/1000 of the end")
    parser.add_argument("--end", type=float, default=0.6, help="s")
    parser.add_argument("--fields", type=float, default=0.0, help="interval of field files, s")
    a = parser.parse_args()
    print(deck(a.links, a.catenary, a.step, a.end, a.fields), end="")
