#!/usr/bin/env python3
"""Writes the deck of a hypervelocity impact: a sphere of aluminium goes through a thin plate of aluminium; both are particles.

usage: deck.py [--dim D] [--n N] [--speed V] [--diameter D] [--thickness T] [--width W] [--end MS] [--fields DT] > hypervelocity.k
N rows of particles on a square lattice go through the plate. In space the deck holds a quarter: x = 0 and z = 0 are planes of symmetry. In
the plane (--dim 2) the sphere is a cylinder, and the deck holds a half. The sphere flies along y, the plate stands between y = 0 and T. Units: mm, ms, kg, kN, GPa.
"""
import argparse

# 2024-T351
DENSITY, SHEAR, HEAT = 2.785e-6, 27.6, 875.0  # RO, G, CP
FLOW = 0.265, 0.426, 0.34, 0.015, 1.0, 775.0, 293.0, 0.001  # A, B, N, C, M, TM, TR, EPSO
SHOCK = 5328.0, 1.338, 0.0, 0.0, 2.0  # C, S1, S2, S3, GAMMA0
SPALL = -1.2  # PC


def row(*values):
    return "".join(f"{v:10d}" if isinstance(v, int) else f"{v:10.4g}" for v in values)


def places(dim, n, diameter, thickness, width):
    """Of the particles of the sphere and of the plate, and their spacing."""
    dx = thickness / n
    half, radius = round(0.5 * width / dx), 0.5 * diameter / dx
    across = [(i + 0.5, k + 0.5 if dim == 3 else 0.0) for k in range(half if dim == 3 else 1) for i in range(half)]
    plate = [(x * dx, (j + 0.5) * dx, z * dx) for x, z in across for j in range(n)]
    rows = round(radius)
    sphere = [(x * dx, (j - 0.5 - rows) * dx, z * dx) for x, z in across for j in range(-rows, rows)
              if x * x + (j + 0.5) ** 2 + z * z <= radius * radius]
    return sphere, plate, dx


def deck(dim=3, n=6, speed=6180.0, diameter=10.0, thickness=4.0, width=64.0, end=0.02, fields=0.0):
    sphere, plate, dx = places(dim, n, diameter, thickness, width)
    mass = DENSITY * dx ** dim
    out = ["*KEYWORD", "*TITLE", f"{diameter:g} mm of aluminium on {thickness:g} mm, {speed:g} m/s, {len(sphere) + len(plate)} particles, mm ms kg kN GPa",
           "*CONTROL_TERMINATION", row(end),
           "*CONTROL_SPH", row(1, 0, 1e20, dim),
           "*DATABASE_GLSTAT", row(end / 100),
           "*DATABASE_MATSUM", row(end / 100)]
    if fields > 0:
        out += ["*DATABASE_BINARY_D3PLOT", row(fields)]
    out += ["*PART", "sphere", row(1, 1, 1, 1, 1), "*PART", "plate", row(2, 1, 1, 1, 1),
            "*SECTION_SPH", row(1, 1.2, 0.2, 2.0),
            "*MAT_JOHNSON_COOK", row(1, DENSITY, SHEAR), row(*FLOW), row(HEAT, SPALL, 3), row(0.0),
            "*EOS_GRUNEISEN", row(1, *SHOCK), row(1.0),
            "*HOURGLASS", row(1, 0, 0, 0, 1.0, 0.5),
            "*BOUNDARY_SPH_SYMMETRY_PLANE", row(0.0, 0.0, 0.0, 1.0, 0.0, 0.0)]
    if dim == 3:
        out += [row(0.0, 0.0, 0.0, 0.0, 0.0, 1.0)]
    out += ["*INITIAL_VELOCITY_GENERATION", row(1, 2, 0.0, 0.0, speed, 0.0), ""]
    out += ["*NODE"] + [f"{i + 1:8d}{x:16.9e}{y:16.9e}{z:16.9e}" for i, (x, y, z) in enumerate(sphere + plate)]
    out += ["*ELEMENT_SPH"] + [f"{i + 1:8d}{1 if i < len(sphere) else 2:8d}{mass:16.9e}" for i in range(len(sphere) + len(plate))]
    return "\n".join(out + ["*END", ""])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dim", type=int, default=3, choices=(2, 3))
    parser.add_argument("--n", type=int, default=6, help="rows of particles through the plate")
    parser.add_argument("--speed", type=float, default=6180.0, help="m/s")
    parser.add_argument("--diameter", type=float, default=10.0, help="of the sphere, mm")
    parser.add_argument("--thickness", type=float, default=4.0, help="of the plate, mm")
    parser.add_argument("--width", type=float, default=64.0, help="of the square plate, mm")
    parser.add_argument("--end", type=float, default=0.02, help="ms")
    parser.add_argument("--fields", type=float, default=0.0, help="interval of field files, ms")
    print(deck(**vars(parser.parse_args())), end="")
