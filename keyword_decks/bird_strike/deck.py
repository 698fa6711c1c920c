#!/usr/bin/env python3
"""Writes the deck of a bird strike: a cylinder of gelatine hits a clamped square plate of aluminium in its middle; a quarter of both.

usage: deck.py [--speed V] [--thickness T] [--n N] [--mesh H] [--rigid] [--end MS] [--fields DT] > bird_strike.k
The bird has N particles over its radius, on a square lattice in layers along its axis; the plate has shells with sides H. Units: mm, ms, kg, kN, GPa.
x = 0 and y = 0 are planes of symmetry; the bird flies along -z, the plate lies in z = 0.
"""
import argparse
import math

RADIUS, LENGTH, SIDE = 50.0, 200.0, 300.0  # of the bird; half the side of the plate
BIRD = 0.95e-6, 1482.9  # density, speed of sound
SLOPE = 2.0  # of the shock's speed over that of the bird: c1, c2, c3 of the polynomial follow
PLATE = 2.77e-6, 72.4, 0.33, 0.345, 0.77, 0.18  # 2024-T3: RO, E, PR, SIGY, ETAN, FAIL


def row(*values):
    return "".join(f"{v:10d}" if isinstance(v, int) else f"{v:10.4g}" if isinstance(v, float) else f"{v:>10}" for v in values)


def bird(n, gap):
    """Places of particles on a lattice of spacing dx, and dx; the column that stands on a quarter disc of that many cells."""
    dx = RADIUS / n
    cells = [((i + 0.5) * dx, (j + 0.5) * dx) for i in range(n) for j in range(n) if (i + 0.5) ** 2 + (j + 0.5) ** 2 < n * n]
    layers = round(LENGTH / dx)
    return [(x, y, gap + (k + 0.5) * dx) for k in range(layers) for x, y in cells], dx


def plate(h):
    n = round(SIDE / h)
    nodes = [(SIDE * i / n, SIDE * j / n, 0.0) for j in range(n + 1) for i in range(n + 1)]
    shells = [[j * (n + 1) + i + 1, j * (n + 1) + i + 2, (j + 1) * (n + 1) + i + 2, (j + 1) * (n + 1) + i + 1] for j in range(n) for i in range(n)]
    return nodes, shells


def node_set(number, ids):
    return ["*SET_NODE_LIST", f"{number:10d}"] + ["".join(f"{i:10d}" for i in ids[k:k + 8]) for k in range(0, len(ids), 8)]


def deck(speed, thickness, n, h, rigid, end, fields):
    rho, c = BIRD
    k = SLOPE
    nodes, shells = plate(h)
    dx = RADIUS / n
    particles, dx = bird(n, 0.5 * thickness)
    first = len(nodes) + 1

    def of(where):
        return [i + 1 for i, x in enumerate(nodes) if where(x)]

    tiny = 1e-6
    c1 = rho * c * c
    out = ["*KEYWORD", "*TITLE", f"bird of {4e0 * len(particles) * dx ** 3 * rho:.3f} kg at {speed:g} m/s on a plate of {thickness:g} mm, {len(particles)} particles, mm ms kg kN GPa",
           "*CONTROL_TERMINATION", row(end),
           "*CONTROL_TIMESTEP", row(0.0, 0.9),
           "*CONTROL_SPH", row(1, 0, 1e20, 3),
           "*DATABASE_GLSTAT", row(end / 400),
           "*DATABASE_MATSUM", row(end / 400),
           "*DATABASE_RCFORC", row(end / 400)]
    if fields > 0:
        out += ["*DATABASE_BINARY_D3PLOT", row(fields)]
    if not rigid:
        out += ["*DATABASE_NODOUT", row(end / 400), "*DATABASE_HISTORY_NODE", row(1)]
    out += ["*PART", "bird", row(1, 1, 1, 1, 1),
            "*SECTION_SPH", row(1, 1.2, 0.2, 2.0),
            "*MAT_NULL", row(1, rho),
            "*EOS_LINEAR_POLYNOMIAL", row(1, 0.0, c1, (2 * k - 1) * c1, (k - 1) * (3 * k - 1) * c1), row(0.0, 1.0),
            "*HOURGLASS", row(1, 0, 0, 0, 1.5, 0.06),
            "*PART", "plate", row(2, 2, 2),
            "*SECTION_SHELL", row(2, 2, 0.833333, 5), row(thickness)]
    if rigid:
        out += ["*MAT_RIGID", row(2, PLATE[0], PLATE[1], PLATE[2]), row(1.0, 7, 7), row(0.0)]
    else:
        out += ["*MAT_PIECEWISE_LINEAR_PLASTICITY", row(2, *PLATE), row(0.0), row(0.0), row(0.0),
                "*BOUNDARY_SPC_SET", row(1, 0, 1, 0, 0, 0, 1, 1), row(2, 0, 0, 1, 0, 1, 0, 1), row(3, 0, 1, 1, 1, 1, 1, 1)]
        out += node_set(1, of(lambda x: x[0] < tiny)) + node_set(2, of(lambda x: x[1] < tiny))
        out += node_set(3, of(lambda x: max(x[0], x[1]) > SIDE - tiny))
    out += ["*BOUNDARY_SPH_SYMMETRY_PLANE", row(0.0, 0.0, 0.0, 1.0, 0.0, 0.0), row(0.0, 0.0, 0.0, 0.0, 1.0, 0.0),
            "*INITIAL_VELOCITY_GENERATION", row(1, 2, 0.0, 0.0, 0.0, -speed), "",
            "*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID", f"{1:10d}bird on plate", row(1, 2, 3, 3), row(0.0), row(10.0, 10.0, 0.9999 * dx)]
    out += ["*NODE"] + [f"{i + 1:8d}{x:16.9e}{y:16.9e}{z:16.9e}" for i, (x, y, z) in enumerate(nodes + particles)]
    out += ["*ELEMENT_SHELL"] + [f"{e + 1:8d}{2:8d}" + "".join(f"{i:8d}" for i in s) for e, s in enumerate(shells)]
    out += ["*ELEMENT_SPH"] + [f"{first + i:8d}{1:8d}{rho * dx ** 3:16.9e}" for i in range(len(particles))]
    return "\n".join(out + ["*END", ""])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--speed", type=float, default=116.0, help="m/s")
    parser.add_argument("--thickness", type=float, default=4.0, help="of the plate, mm")
    parser.add_argument("--n", type=int, default=10, help="particles over the radius of the bird")
    parser.add_argument("--mesh", type=float, default=10.0, help="side of a shell, mm")
    parser.add_argument("--rigid", action="store_true", help="a plate that is rigid and held")
    parser.add_argument("--end", type=float, default=4.0, help="ms")
    parser.add_argument("--fields", type=float, default=0.0, help="interval of field files, ms")
    a = parser.parse_args()
    print(deck(a.speed, a.thickness, a.n, a.mesh, a.rigid, a.end, a.fields), end="")
