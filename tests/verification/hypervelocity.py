#!/usr/bin/env python3
"""A sphere of aluminium through a thin plate, both particles: diameter of the hole and shape of the debris cloud against experiments.

usage: hypervelocity.py COURANT SOURCE_DIR [--all]
Without --all the coarsest runs in the plane and in space, and the first on two threads. --all runs the resolutions and speeds of the tables in
docs/verification_structures.md and prints them.
"""
import os
import re
import sys
import tempfile

import numpy as np

from checks import bound, failures, run_deck

courant, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
sys.path.insert(0, os.path.join(source, "keyword_decks", "hypervelocity"))
sys.path.insert(0, os.path.join(source, "src", "python"))
import deck as impact  # noqa: E402
from courant import open as results_of  # noqa: E402

DIAMETER, THICKNESS = 10.0, 4.0
SOUND = impact.SHOCK[0]


def fitted_hole(speed):
    """mm; Maiden and McMillan 1964, spheres of aluminium on sheets of aluminium."""
    return DIAMETER * (2.4 * speed / SOUND * (THICKNESS / DIAMETER) ** (2 / 3) + 0.9)


def hole(state, speed, dx):
    """Narrowest diameter between the faces of the plate as it was, up to the edges of particles that do not fly."""
    r, y = np.hypot(state.points[:, 0], state.points[:, 2]), state.points[:, 1]
    stays = (y > 0) & (y < THICKNESS) & (np.linalg.norm(state["velocity"], axis=1) < 0.1 * speed)
    return 2 * r[stays].min() - dx


def cloud(state):
    """Length behind the plate and width of the cloud, each of 99 % of its particles."""
    r, y = np.hypot(state.points[:, 0], state.points[:, 2]), state.points[:, 1]
    behind = y > THICKNESS
    return np.quantile(y[behind], 0.99) - THICKNESS, 2 * np.quantile(r[behind], 0.99)


def case(folder, dim, n, speed=6180.0, threads=1, **given):
    fields = given.get("end", 0.02)
    out = run_deck(courant, impact.deck(dim=dim, n=n, speed=speed, fields=fields, **given), os.path.join(folder, f"d{dim}_n{n}_v{speed:g}_{threads}"), threads)
    with open(os.path.join(out, "summary.yaml"), encoding="utf-8") as file:
        text = file.read()

    def number(name):
        return float(re.search(rf"^ *{name}: (\S+)$", text, re.M).group(1))

    run = results_of(out)
    first, last = run.states[0], run.states[-1]
    length, width = cloud(last)
    momentum = [np.sum(s["mass"].astype(float) * s["velocity"][:, 1].astype(float)) for s in (first, last)]
    return {"out": out, "dim": dim, "n": n, "speed": speed, "hole": hole(last, speed, THICKNESS / n), "length": length, "width": width, "ratio": length / width,
            "energy": number("error"), "momentum": momentum[1] / momentum[0] - 1, "particles": number("particles"), "steps": number("steps"),
            "dt": (number("dt_min"), number("dt_max")), "cpu": number("cpu_seconds"), "verdict": re.search(r"^verdict: (\w+)", text, re.M).group(1)}


def check(r, low, high):
    print(f"dim {r['dim']}, n = {r['n']}, {r['speed']:g} m/s: {int(r['particles'])} particles, {int(r['steps'])} steps of {r['dt'][0]:.3g} to {r['dt'][1]:.3g} ms, "
          f"hole {r['hole']:.1f} mm, cloud {r['length']:.1f} x {r['width']:.1f} mm, {r['verdict']}")
    bound("  hole, mm", r["hole"], low, high)
    bound("  created energy", r["energy"], -0.003, 0.003)
    bound("  momentum", r["momentum"], -1e-6, 1e-6)
    bound("  verdict is sound", r["verdict"] == "sound", 1, 1)


def line(r):
    print(f"| {r['dim']} | {r['n']} | {int(r['particles'])} | {int(r['steps'])} | {r['hole']:.1f} | {r['length']:.1f} | {r['width']:.1f} | {r['ratio']:.2f} | {100 * r['energy']:.2f} % | {r['cpu']:.1f} |")


def main():
    with tempfile.TemporaryDirectory() as folder:
        if "--all" in sys.argv:
            rows = [case(folder, 2, n, width=80.0) for n in (8, 16, 24, 32)] + [case(folder, 3, n) for n in (4, 6, 8, 12)]
            fast = [case(folder, 3, 8, speed=v, end=0.03) for v in (2000.0, 3000.0, 4500.0, 7500.0)]
            for r in rows:
                check(r, *((31, 36) if r["dim"] == 2 else (0.9 * fitted_hole(r["speed"]), 1.1 * fitted_hole(r["speed"]))))
                bound("  length over width of the cloud", r["ratio"], 0.9 * 1.39, 1.1 * 1.39)
            for r in fast:
                check(r, 0.9 * fitted_hole(r["speed"]), 1.1 * fitted_hole(r["speed"]))
            for r in rows:
                line(r)
            for r in fast:
                print(f"| {r['speed']:g} | {r['hole']:.1f} | {fitted_hole(r['speed']):.1f} | {100 * r['energy']:.2f} % |")
        else:
            plane, space = case(folder, 2, 8, width=80.0), case(folder, 3, 4)
            check(plane, 31, 36)
            check(space, 0.9 * fitted_hole(6180), 1.1 * fitted_hole(6180))
            for r in (plane, space):
                bound("  length over width of the cloud", r["ratio"], 0.9 * 1.39, 1.1 * 1.39)
            twice = case(folder, 2, 8, width=80.0, threads=2)
            bound("particles elsewhere on two threads", np.count_nonzero(results_of(plane["out"]).states[-1].points != results_of(twice["out"]).states[-1].points), 0, 0)
    for text in failures:
        print("FAILED  " + text)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
