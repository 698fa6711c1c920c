#!/usr/bin/env python3
"""Writes the deck of a Taylor bar: a quarter of a copper cylinder that hits a rigid wall along its axis.

usage: deck.py [--n N] [--layers L] [--hourglass IHQ QM] [--tssfac F] [--fields DT] > taylor_bar.k
The section is a square of N x N hexahedra in the middle and two rings of N x N around it, 3 N^2; along the bar there are L layers, or 13.5 N,
half as long again as they are across. Units: mm, ms, kg, kN, GPa. x = 0 and z = 0 are planes of symmetry, the wall is y = 0.
"""
import argparse
import math

LENGTH, RADIUS, SPEED, END = 32.4, 3.2, 227.0, 0.08
MATERIAL = (1, 8.93e-6, 117.0, 0.35, 0.4, 0.1, 1.0)  # MID, RO, E, PR, SIGY, ETAN, BETA
SQUARE = 0.55  # half diagonal of the square over the radius


def section(n):
    """Nodes (x, z) of a quarter of the section, and its quadrilaterals, counter-clockwise seen along +y turned to the viewer."""
    places, index, cells = [], {}, []

    def node(x, z):
        key = (round(x * 1e9), round(z * 1e9))
        if key not in index:
            index[key] = len(places)
            places.append((x, z))
        return index[key]

    def edge(s):
        """Of the square's outer border, s from 0 (on x) over 1 (its corner) to 2 (on z), bulged a little."""
        t = s if s <= 1 else 2 - s
        a = (SQUARE * (0.85 + (math.sqrt(0.5) - 0.85) * t), SQUARE * math.sqrt(0.5) * t)
        return a if s <= 1 else (a[1], a[0])

    def inner(u, v):
        """In the square: transfinite interpolation between its borders; what those on the axes add cancels with the corners."""
        right, top, far = edge(v), edge(2 - u), edge(1)
        return v * top[0] + u * right[0] - u * v * far[0], v * top[1] + u * right[1] - u * v * far[1]

    def ring(k, m):
        """From the square (m = 0) to the circle (m = n), k from 0 on x to 2 n on z."""
        a, angle = edge(k / n), math.pi / 4 * k / n
        b, w = (math.cos(angle), math.sin(angle)), m / n
        return (1 - w) * a[0] + w * b[0], (1 - w) * a[1] + w * b[1]

    for i in range(n):
        for j in range(n):
            cells.append([node(*inner((i + a) / n, (j + b) / n)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
    for k in range(2 * n):
        for m in range(n):
            cells.append([node(*ring(k + a, m + b)) for a, b in ((0, 0), (0, 1), (1, 1), (1, 0))])
    return places, cells


def deck(n, layers=0, hourglass=(1, 0.1), tssfac=0.9, fields=0.0):
    places, cells = section(n)
    layers = layers or round(13.5 * n)
    per_layer = len(places)
    nodes, elements = [], []
    for k in range(layers + 1):
        for x, z in places:
            nodes.append((RADIUS * x, LENGTH * k / layers, RADIUS * z))
    for k in range(layers):
        for c in cells:  # x towards z is right-handed about -y: the upper layer comes first
            low, high = [k * per_layer + i + 1 for i in c], [(k + 1) * per_layer + i + 1 for i in c]
            elements.append(high + low)

    def of(where):
        return [i + 1 for i, x in enumerate(nodes) if where(x)]

    def node_set(number, ids):
        rows = ["".join(f"{i:10d}" for i in ids[k:k + 8]) for k in range(0, len(ids), 8)]
        return ["*SET_NODE_LIST", f"{number:10d}"] + rows

    tiny = 1e-6
    out = ["*KEYWORD", "*TITLE", f"Taylor bar of copper, {len(elements)} solids, mm ms kg kN GPa",
           "*CONTROL_TERMINATION", f"{END:10.4g}",
           "*CONTROL_TIMESTEP", f"{0:10.1f}{tssfac:10.4g}",
           "*DATABASE_GLSTAT", f"{END / 80:10.4g}",
           "*DATABASE_MATSUM", f"{END / 80:10.4g}",
           "*DATABASE_RWFORC", f"{END / 80:10.4g}",
           "*DATABASE_NODOUT", f"{END:10.4g}",
           "*DATABASE_HISTORY_NODE_SET", f"{4:10d}"]
    if fields > 0:
        out += ["*DATABASE_BINARY_D3PLOT", f"{fields:10.4g}"]
    out += ["*PART", "bar", f"{1:10d}{1:10d}{1:10d}{0:10d}{1:10d}",
            "*SECTION_SOLID", f"{1:10d}{1:10d}",
            "*HOURGLASS", f"{1:10d}{hourglass[0]:10d}{hourglass[1]:10.4g}",
            "*MAT_PLASTIC_KINEMATIC", f"{MATERIAL[0]:10d}" + "".join(f"{v:10.4g}" for v in MATERIAL[1:]),
            "*RIGIDWALL_PLANAR_ID", f"{1:10d}anvil", f"{0:10d}", f"{0.0:10.1f}{0.0:10.1f}{0.0:10.1f}{0.0:10.1f}{1.0:10.1f}{0.0:10.1f}{0.0:10.1f}",
            "*INITIAL_VELOCITY_GENERATION", f"{1:10d}{2:10d}{0.0:10.1f}{0.0:10.1f}{-SPEED:10.1f}{0.0:10.1f}", "",
            "*BOUNDARY_SPC_SET", f"{2:10d}{0:10d}{1:10d}{0:10d}{0:10d}", f"{3:10d}{0:10d}{0:10d}{0:10d}{1:10d}"]
    out += node_set(2, of(lambda x: x[0] < tiny)) + node_set(3, of(lambda x: x[2] < tiny)) + node_set(4, of(lambda x: True))
    out += ["*NODE"] + [f"{i + 1:8d}{x:16.9e}{y:16.9e}{z:16.9e}" for i, (x, y, z) in enumerate(nodes)]
    out += ["*ELEMENT_SOLID"] + [f"{e + 1:8d}{1:8d}" + "".join(f"{i:8d}" for i in c) for e, c in enumerate(elements)]
    return "\n".join(out + ["*END", ""])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--n", type=int, default=4, help="elements across the square in the middle of the section")
    parser.add_argument("--layers", type=int, default=0, help="elements along the bar; 0: 13.5 N")
    parser.add_argument("--hourglass", nargs=2, default=["1", "0.1"], metavar=("IHQ", "QM"))
    parser.add_argument("--tssfac", type=float, default=0.9)
    parser.add_argument("--fields", type=float, default=0.0, help="interval of field files, ms")
    a = parser.parse_args()
    print(deck(a.n, a.layers, (int(a.hourglass[0]), float(a.hourglass[1])), a.tssfac, a.fields), end="")
