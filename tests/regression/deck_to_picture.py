#!/usr/bin/env python3
"""The numbers of docs/from_deck_to_picture.md and its figure are those of a run, and the stages in the pages are those that are printed.

usage: deck_to_picture.py COURANT SOURCE_DIR WORK_DIR
"""
import os
import re
import subprocess
import sys

from checks import check, enter_empty_folder, failures

try:
    import h5py
except ImportError:
    print("skipped: Python's h5py is not here")
    sys.exit(77)

courant, source, work = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), os.path.join(os.path.abspath(sys.argv[3]), "deck_to_picture")
enter_empty_folder(work)


def page(name):
    with open(os.path.join(source, "docs", name), encoding="utf-8") as file:
        return file.read()


def call(*words):
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
    check(done.returncode == 0, f"courant {words[0]} ends well")
    return done.stdout


def states():
    """Particle 41 and node 119 after each of the first three steps: field to value or list of components."""
    out = []
    for n in (1, 2, 3):
        with h5py.File(f"out/restart/d3dump0{n}.h5") as file:
            row = {"dt": file["state/clock/dt"][0], "rebuilds": file["state/neighbours/rebuilds"][0], "skin": file["state/neighbours/skin"][0]}
            for of, who in (("particles", 41), ("nodes", 119)):
                fields = file["state"][of]
                at = list(fields["id"][:]).index(who)
                row[of] = {name: f[at] if f.ndim == 1 else [c[at] for c in f] for name, f in fields.items()}
                row[of]["index"] = at
            out.append(row)
    return out


text, figure = page("from_deck_to_picture.md"), page("figures/from_deck_to_picture/way.svg")
call("generate", os.path.join(source, "keyword_decks/still_water/scene.yaml"), "-o", "still.k", "--param", "resolution=10", "--param", "endtim=0.007",
     "--param", "dt_plot=1e-4")
with open("still.k", encoding="utf-8") as file:
    deck = file.read()
with open("still.k", "w", encoding="utf-8") as file:
    file.write(deck.replace("*PART\n", "*DATABASE_BINARY_D3DUMP\n         1\n*DATABASE_HISTORY_SPH\n        41\n*DATABASE_SPHOUT\n    1.0e-4\n*PART\n", 1))
said = call("check", "still.k")
call("run", "still.k", "-o", "out", "--threads", "1", "--quiet")

stages = re.search(r"  stage 1\n.*?(?=  time limit)", said, re.S).group()
for name in ("from_deck_to_picture.md", "architecture.md", "user_guide.md"):
    check(stages in page(name), f"{name} shows the stages as they are printed")

one, two, three = states()
first, last = one["particles"], three["particles"]
before = two["particles"]
dt_mean = 0.5 * (two["dt"] + three["dt"])
force = last["mass"] * (last["velocity"][1] - before["velocity"][1]) / dt_mean
contact = first["contact_1_stiffness"] * (0.5 * 0.04999500 - before["position"][1])
neighbours = re.search(r"neigh +act\n +41 +\d+ +\S+ +\S+ +(\d+)", open("out/sphout", encoding="utf-8").read()).group(1)
for what, shown in {
        "position of the particle among all": f"**index {first['index']}**",
        "neighbours": f"**{neighbours} neighbours**",
        "skin": f"{one['skin']:.3f} = 0.1 h",
        "smoothing length and density": f"{first['smoothing_length']:.2f} = CSLH",
        "mass of the particle": f"{first['mass']:g} = 0.0025",
        "mass of the node": f"{one['nodes']['mass']:.5f} = two shells",
        "node that follows a held body": f"`follow` {one['nodes']['follow']}: a rigid body moves it; `held` {one['nodes']['held']}",
        "second position": f"{first['position'][1]:.7f} |",
        "rate of density": f"{last['density_rate']:.4f} |",
        "density": f"{last['density']:.5f} | {last['pressure']:.4f} | {before['position'][1]:.8f} |",
        "pressure force": f"| {force - contact + 9.81 * last['mass']:.2f} |",
        "contact force": f"| +{contact:.3f} |",
        "sum of the forces": f"| +{force:.2f} |",
        "time step": f"= {1e3 * three['dt']:.5f} ms",
        "kick": f"= {last['velocity'][1]:.8f}",
        "drift": f"=  {last['position'][1]:.8f}"}.items():
    check(shown in text, f"{what}: the page has '{shown}'")
for shown in (f"index {first['index']},", f"drhodt {last['density_rate']:.2f}", f"contact +{contact:.3f}", f"v {last['velocity'][1]:.6f}"):
    check(shown in figure, f"the figure has '{shown}'")
check(one["rebuilds"] == three["rebuilds"] == 1, "lists are built once in three steps")
sys.exit(f"{len(failures)} failed" if failures else 0)
