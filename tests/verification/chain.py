#!/usr/bin/env python3
"""A chain of 50 rigid links: its fall against the equations of the multiple pendulum in absolute angles, its rest against the discrete catenary.

usage: chain.py COURANT SOURCE_DIR
Needs numpy; prints the table of docs/verification_structures.md.
"""
import math
import os
import re
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("skipped: this Python has no numpy")
    sys.exit(77)

from checks import bound, failures, run_deck

courant, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
sys.path.insert(0, os.path.join(source, "keyword_decks", "chain"))
import deck as chain  # noqa: E402


def run(text, folder, threads=1):
    return run_deck(courant, text, folder, threads)


def places_of(out):
    """Times, and the positions (x, z) of the joints and of the end at each."""
    times, states, now = [], [], 0.0
    with open(os.path.join(out, "nodout"), encoding="utf-8") as file:
        for line in file:
            if m := re.search(r"at time\s+([-+.\deE]+)", line):
                now = float(m.group(1))
            elif "x-disp" in line:  # rotations have a table of their own
                times.append(now)
                states.append([])
            elif len(words := line.split()) == 13 and words[0].isdigit():
                states[-1].append((float(words[10]), float(words[12])))
    return np.array(times), np.array(states)


def forces_of(out):
    """Of the joints in each state: (x, z)."""
    with open(os.path.join(out, "jntforc"), encoding="utf-8") as file:
        text = file.read()
    numbers = {axis: [float(v) for v in re.findall(rf"{axis}-force\.+ +(\S+)", text)] for axis in "xz"}
    count = max(int(n) for n in re.findall(r"joint ID\.+ +(\d+)", text))
    return np.array([numbers["x"], numbers["z"]]).T.reshape(-1, count, 2)


def energy_of(out, places):
    """Largest change of kinetic energy and height together, of m g L/2."""
    with open(os.path.join(out, "glstat"), encoding="utf-8") as file:
        kinetic = np.array([float(v) for v in re.findall(r"^ kinetic energy\.+ +(\S+)", file.read(), re.M)])
    height = 0.5 * (places[:, 1:, 1] + places[:, :-1, 1]).mean(1)
    weight = chain.MASS * chain.GRAVITY
    energy = kinetic[:len(height)] + weight * height
    return np.abs(energy - energy[0]).max() / (0.5 * weight * chain.LENGTH)


def pendulum(links, times, dt):
    """Ends of a chain of rods that starts level: sum_j a_ij (cos(t_i - t_j) t_j'' + sin(t_i - t_j) t_j'^2) + b_i sin t_i = 0, angles t from straight down."""
    m, l = chain.MASS / links, chain.LENGTH / links
    k = np.arange(links)
    beyond = links - 1 - np.maximum.outer(k, k)
    a = m * l * l * (beyond + 0.5)
    a[k, k] = m * l * l * (links - 1 - k + 0.25) + chain.inertia(links)[0]
    b = m * chain.GRAVITY * l * (links - 1 - k + 0.5)

    def rates(y):
        t, w = y
        apart = np.subtract.outer(t, t)
        return np.array([w, np.linalg.solve(a * np.cos(apart), -(a * np.sin(apart)) @ (w * w) - b * np.sin(t))])

    y, now, ends = np.array([np.full(links, 0.5 * math.pi), np.zeros(links)]), 0.0, []
    for until in times:
        steps = max(1, math.ceil((until - now) / dt - 1e-9))
        h = (until - now) / steps
        for _ in range(steps if until > now else 0):
            p = rates(y)
            q = rates(y + 0.5 * h * p)
            r = rates(y + 0.5 * h * q)
            y = y + h / 6 * (p + 2 * q + 2 * r + rates(y + h * r))
        now = until
        places = np.concatenate([[[0.0, 0.0]], np.cumsum(np.stack([l * np.sin(y[0]), -l * np.cos(y[0])], 1), 0)])
        ends.append(places)
    return np.array(ends)


def check_fall(folder):
    rows = []
    for step in (6e-4, 3e-4, 1.5e-4):
        out = run(chain.deck(step=step, end=0.6, history=60), os.path.join(folder, f"fall{step}"))
        times, places = places_of(out)
        exact = pendulum(50, times, 2e-4)
        if not rows:
            finer = np.abs(exact - pendulum(50, times, 1e-4)).max()
            print(f"two integrations of the pendulum's equations differ by {finer:.1e} m")
        apart = np.linalg.norm(places - exact, axis=2).max(1)
        rows.append((step, apart[times <= 0.4].max(), apart.max(), energy_of(out, places)))
        print(f"| {step * 1e3:g} | {rows[-1][1]:.1e} | {rows[-1][2]:.1e} | {rows[-1][3]:.1e} |")
    for step, early, late, energy in rows:
        bound(f"step {step * 1e3:g} ms: energy, of m g L/2", energy, 0, 1e-3)
        bound("  joints from the pendulum's until 0.4 s, of L", early, 0, 1e-4)
        bound("  until 0.6 s", late, 0, 2e-4)
    same = [places_of(run(chain.deck(end=0.1), os.path.join(folder, f"threads{n}"), n))[1] for n in (1, 2)]
    bound("places on two threads, difference", float(np.abs(same[0] - same[1]).max()), 0, 0)


def check_catenary(folder):
    for span in (0.3, 0.6, 0.9):
        out = run(chain.deck(span=span, end=0.5, history=20), os.path.join(folder, f"hanging{span}"))
        places, forces = places_of(out)[1], forces_of(out)
        pull = chain.hanging(50, span)[1]
        weight = chain.MASS * chain.GRAVITY
        bound(f"catenary over {span} m: motion in 0.5 s, of L", float(np.abs(places - places[0]).max()), 0, 1e-5)
        level = np.abs(np.abs(forces[:, :, 0]) / pull - 1).max()
        upright = np.abs(np.abs(forces[:, :, 1]) - np.abs(0.5 - np.arange(51) / 50) * weight).max() / weight
        bound("  level force in each joint, of that of the catenary, off 1", level, 0, 1e-5)
        bound("  upright force, of the weight, off what hangs below", upright, 0, 1e-5)


def main():
    with tempfile.TemporaryDirectory() as folder:
        check_fall(folder)
        check_catenary(folder)
    for text in failures:
        print("FAILED  " + text)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
