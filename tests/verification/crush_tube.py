#!/usr/bin/env python3
"""A square tube of steel that a falling mass crushes along its axis: mean force against theory, folds in contact with each other.

usage: crush_tube.py COURANT SOURCE_DIR [--all]
Without --all the coarsest mesh, and a short run on one thread and two. --all runs the meshes of the table in
docs/verification_structures.md and prints it.
"""
import os
import re
import sys
import tempfile

from checks import bound, failures, run_deck

courant, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
sys.path.insert(0, os.path.join(source, "keyword_decks", "crush_tube"))
import deck as tube  # noqa: E402

MASS, SPEED = 25.0, 8.0  # of the quarter that the deck holds, kg; m/s


def run(text, folder, threads=1):
    return run_deck(courant, text, folder, threads, may_fail=True)


def values_of(out):
    with open(os.path.join(out, "summary.yaml"), encoding="utf-8") as file:
        text = file.read()
    found = re.findall(r"^ *(\w+): ([-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?)$", text, re.M)
    values = {name: float(value) for name, value in reversed(found)}
    share = {name: float(s) for name, s in re.findall(r"name: ([^,]+), seconds: ([-+.e\d]+)", text)}
    values["contact_share"] = sum(s for name, s in share.items() if name.startswith("contact")) / sum(share.values())
    values["verdict"] = re.search(r"^verdict: (\w+)", text, re.M).group(1)
    return values


def force_of(out):
    """Times and forces on the wall."""
    rows = []
    with open(os.path.join(out, "rwforc"), encoding="utf-8") as file:
        for line in file:
            if len(row := line.split()) == 6 and row[1] == "1":
                rows.append((float(row[0]), float(row[2])))
    return rows


def crush(out):
    """Way of the wall and the mean force over it, of the whole tube: forces are means over the intervals of rwforc."""
    rows = force_of(out)
    v, way, work = SPEED, 0.0, 0.0
    for (t0, f0), (t1, f1) in zip(rows, rows[1:]):
        f, dt = 0.5 * (f0 + f1), t1 - t0
        ds = (v - 0.5 * f * dt / MASS) * dt
        v, way, work = v - f * dt / MASS, way + ds, work + f * ds
    return way, 4 * work / way, v


def case(h, folder, **given):
    out = run(tube.deck(h=h, **given), os.path.join(folder, f"h{h}" + "".join(f"_{k}{v}" for k, v in given.items())))
    values = values_of(out)
    way, force, speed = crush(out)
    taken = values["internal"] + values["hourglass"] + values["contact"]
    return {"h": h, "way": way, "force": force, "of_theory": force / tube.mean_force(), "taken": taken, "work": 0.25 * force * way,
            "hourglass": values["hourglass"] / values["internal"], **{k: values.get(k, 0) for k in ("elements", "steps", "ratio", "contact_share", "leaked_nodes", "max_penetration", "verdict", "cpu_seconds")}}


def check(r, low, high):
    print(f"h = {r['h']}: {int(r['elements'])} shells, {int(r['steps'])} steps, crushed by {r['way']:.1f} mm, {r['force']:.2f} kN, of theory {r['of_theory']:.3f}")
    bound("  mean force over theory", r["of_theory"], low, high)
    bound("  energy ratio", r["ratio"], 0.999, 1.001)
    bound("  hourglass over internal energy", r["hourglass"], 0, 0.12 if r["h"] > 2.5 else 0.1)
    bound("  nodes through faces", r["leaked_nodes"], 0, 0)


def main():
    with tempfile.TemporaryDirectory() as folder:
        if "--all" in sys.argv:
            rows = [case(h, folder) for h in (3.0, 2.0, 1.5)]
            for r in rows:
                check(r, 0.9, 1.25 if r["h"] > 2.5 else 1.1)
                print(f"| {r['h']} | {int(r['elements'])} | {int(r['steps'])} | {r['way']:.1f} | {r['force']:.2f} | {r['of_theory']:.3f} | {r['ratio']:.5f} | "
                      f"{r['hourglass']:.3f} | {r['contact_share']:.2f} | {r['cpu_seconds']:.0f} |")
        else:
            coarse = case(3.0, folder, end=5.0)
            check(coarse, 1.0, 1.3)
            bound("  energy that the tube took, of the wall's work", coarse["taken"] / coarse["work"], 0.95, 1.01)
            bound("  deepest that one fold stands in another, of the thickness", coarse["max_penetration"] / tube.THICKNESS, 0.01, 0.5)
            same = [force_of(run(tube.deck(end=0.8), os.path.join(folder, f"threads{n}"), n)) for n in (1, 2)]
            bound("forces that differ on two threads", sum(a != b for a, b in zip(*same)) + abs(len(same[0]) - len(same[1])), 0, 0)
    for text in failures:
        print("FAILED  " + text)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
