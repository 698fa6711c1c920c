#!/usr/bin/env python3
"""Runs scenes in all ways in which the same model can be written, and compares; and looks at momenta where nothing outside acts.

usage: run.py COURANT [--quick] [--keep FOLDER] [--change TEXT] [scene ...]

--quick: for each scene the changes that its number picks; all scenes together have all of them many times. Scenes are chosen by parts of their names.
"""
from __future__ import annotations

import argparse
import concurrent.futures
import glob
import os
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy as np
except ImportError as error:
    print(f"not tested: {error}")
    sys.exit(77)

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from builder import Change, Model, changes  # noqa: E402
from scenes import scenes  # noqa: E402

AS_WRITTEN = Change("as written")


class Failed(Exception):
    pass


def run(courant: str, folder: str, deck: str) -> dict:
    """The state at the end, as the restart file has it."""
    os.makedirs(folder, exist_ok=True)
    with open(f"{folder}/a.k", "w") as file:
        file.write(deck)
    done = subprocess.run([courant, "run", "a.k", "-o", "out"], cwd=folder, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    files = glob.glob(f"{folder}/out/restart/*.h5")
    if not files or done.returncode not in (0, 2):
        raise Failed((done.stderr or done.stdout)[-800:])
    out = {}
    with h5py.File(max(files, key=os.path.getmtime)) as h5:
        h5["state"].visititems(lambda path, item: out.__setitem__(path, item[()]) if isinstance(item, h5py.Dataset) else None)
    return out


def motion(state: dict, model: Model, c: Change) -> dict:
    """Places and velocities by number in the model, in its frame; and energies."""
    number = {c.id(ref): ref.id for ref in (type_ref(k) for k in model.nodes)}
    out = {}
    for kind in ("nodes", "particles"):
        ids = state.get(f"{kind}/id", np.zeros(0, int))
        if not len(ids):
            continue
        x = c.back(state[f"{kind}/position"].T, "point", 1, 0)
        v = c.back(state[f"{kind}/velocity"].T, "polar", 1, -1)
        for k, one in enumerate(ids):
            out[number[int(one)]] = (x[k], v[k])
    m, l, t = c.units
    energy = {name: float(state[f"energy/{name}"][0]) / (m * l * l / t / t) for name in ("kinetic", "internal", "contact", "dissipated", "external_work", "hourglass")}
    return {"points": out, "energy": energy, "cycle": int(state["clock/cycle"][0])}


def type_ref(k: int):
    from builder import N

    return N(k)


def difference(a: dict, b: dict, model: Model) -> float:
    """Largest of positions and velocities, of how far and how fast things moved; and of energies."""
    if a["cycle"] != b["cycle"] or set(a["points"]) != set(b["points"]):
        return np.inf
    ids = sorted(a["points"])
    xa, xb, va, vb = (np.array([s["points"][k][i] for k in ids]) for i in (0, 1) for s in (a, b))
    moved = np.abs(xa - np.array([model.nodes[k] for k in ids])).max()
    fastest = np.abs(va).max()
    out = max(np.abs(xa - xb).max() / max(moved, 1e-3 * model.size), np.abs(va - vb).max() / max(fastest, 1e-12))
    scale = max(abs(e) for e in a["energy"].values())
    return float(max(out, max(abs(a["energy"][k] - b["energy"][k]) for k in a["energy"]) / max(scale, 1e-300)))


def momenta(state: dict, bare: dict, model: Model) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Momentum, angular momentum, centre of mass: each mass where it is, as it is without what joins it."""
    P, L, C, M = np.zeros(3), np.zeros(3), np.zeros(3), 0.0
    of_body = {}
    for part, nodes in model.bodies.items():
        of_body.update(dict.fromkeys(nodes, part))
    bodies = {}
    own = {int(i): k for k, i in enumerate(bare["nodes/id"])} if "nodes/id" in bare else {}
    for k, one in enumerate(state.get("nodes/id", [])):
        i = own[int(one)]
        m, x, v = bare["nodes/mass"][i], state["nodes/position"][:, k], state["nodes/velocity"][:, k]
        turns = "nodes/rotary_inertia" in bare
        if int(one) in of_body:
            bodies[of_body[int(one)]] = bodies.get(of_body[int(one)], 0.0) + m
            continue
        if model.riders and state["nodes/follow"][k] == 2:
            bodies[model.riders] = bodies.get(model.riders, 0.0) + m
            continue
        P, C, M = P + m * v, C + m * x, M + m
        L = L + m * np.cross(x, v)
        if turns and "nodes/angular_velocity" in state:
            L = L + bare["nodes/rotary_inertia"][i] * state["nodes/angular_velocity"][:, k]
    for part, m in bodies.items():
        group = next(g[: -len("/L")] for g in state if g.endswith(f"part {part}/L"))
        x, v = np.ravel(state[group + "/x"]), np.ravel(state[group + "/v"])
        P, C, M, L = P + m * v, C + m * x, M + m, L + np.ravel(state[group + "/L"]) + m * np.cross(x, v)
    for k in range(len(state.get("particles/id", []))):
        m, x, v = state["particles/mass"][k], state["particles/position"][:, k], state["particles/velocity"][:, k]
        P, C, M, L = P + m * v, C + m * x, M + m, L + m * np.cross(x, v)
    return P, L, C / M


def conserved(courant: str, folder: str, model: Model) -> list[str]:
    bare = run(courant, folder + "/bare", model.deck(AS_WRITTEN, steps=2, joined=False))
    first = run(courant, folder + "/first", model.deck(AS_WRITTEN, steps=2))
    last = run(courant, folder + "/last", model.deck(AS_WRITTEN))
    (P, L, C), (P1, L1, C1) = (momenta(s, bare, model) for s in (first, last))
    sizes = [0.0, 0.0]
    for k in range(len(last.get("nodes/id", []))):
        p = last["nodes/mass"][k] * np.linalg.norm(last["nodes/velocity"][:, k])
        sizes = [sizes[0] + p, sizes[1] + p * model.size]
    for k in range(len(last.get("particles/id", []))):
        p = last["particles/mass"][k] * np.linalg.norm(last["particles/velocity"][:, k])
        sizes = [sizes[0] + p, sizes[1] + p * model.size]
    M = sum(bare.get("nodes/mass", [])) + sum(last.get("particles/mass", []))
    t = float(last["clock/t"][0] - first["clock/t"][0])
    found = {"momentum": np.linalg.norm(P1 - P) / sizes[0], "angular momentum": np.linalg.norm(L1 - L) / sizes[1], "centre of mass": np.linalg.norm(C1 - C - t * P / M) / model.size}
    bounds = {"momentum": 1e-12, "angular momentum": 1e-11, "centre of mass": 1e-11} | model.loose
    return [f"{model.name}: {what} {value:.2g} (bound {bounds[what]:.0e})" for what, value in found.items() if not value <= bounds[what]]


def look_at(job) -> tuple[str, list[str], float]:
    courant, folder, model, some = job
    faults, worst = [], 0.0
    folder = f"{folder}/{model.name}"
    try:
        reference = motion(run(courant, folder + "/as written", model.deck(AS_WRITTEN)), model, AS_WRITTEN)
    except Failed as error:
        return model.name, [f"{model.name}: does not run: {error}"], np.inf
    for c in some:
        bound = model.loose.get(c.name, c.bound)
        try:
            d = difference(reference, motion(run(courant, f"{folder}/{c.name}", model.deck(c)), model, c), model)
        except Failed as error:
            faults.append(f"{model.name}: {c.name}: does not run: {error}")
            continue
        worst = max(worst, d / bound)
        if not d <= bound:
            faults.append(f"{model.name}: {c.name}: differs by {d:.2g} (bound {bound:.0e})")
    if model.free:
        try:
            faults += conserved(courant, folder, model)
        except Failed as error:
            faults.append(f"{model.name}: does not run: {error}")
    return model.name, faults, worst


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("courant")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--keep")
    parser.add_argument("--change", default="")
    parser.add_argument("--jobs", type=int, default=1)
    a = parser.parse_args()
    courant = os.path.abspath(a.courant)
    folder = a.keep or tempfile.mkdtemp()
    jobs = []
    for k, model in enumerate(scenes()):
        some = [c for c in changes(model.size) if c.name not in model.skip and a.change in c.name]
        if a.quick:
            some = [c for i, c in enumerate(some) if (i + k) % 4 == 0]
        if not a.scenes or any(part in model.name for part in a.scenes):
            jobs.append((courant, folder, model, some))
    faults = 0
    with concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
        for name, found, worst in pool.map(look_at, jobs):
            print(f"{'FAULT' if found else 'ok':6}{name} ({worst:.2g} of the bounds)", flush=True)
            for text in found:
                print("      " + text.replace("\n", "\n        "), flush=True)
            faults += len(found)
    print(f"{len(jobs)} scenes, {sum(len(job[3]) for job in jobs)} pairs, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
