#!/usr/bin/env python3
"""Short scenes of water in a box with walls by contact: what their defaults give, against the weight of the water.

usage: scenes.py COURANT SOURCE_DIR WORK_DIR
"""
import os
import re
import subprocess
import sys

from checks import check, enter_empty_folder, failures

courant, source, work = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), os.path.join(os.path.abspath(sys.argv[3]), "scenes")
enter_empty_folder(work)
RHO, G = 1000, 9.81


def call(*words):
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
    return done.returncode, done.stdout


def computed(name, scene, *words):
    """Generates a scene, checks it strictly and runs it; (what check says, scalars of the summary)."""
    if not os.path.exists(scene):
        with open(f"{name}.yaml", "w") as file:
            file.write(scene)
        scene = f"{name}.yaml"
    code, said = call("generate", scene, "-o", f"{name}.k", *words)
    check(code == 0, f"{name}: generate -> {code} {said}")
    code, said = call("check", f"{name}.k", "--strict")
    check(code == 0, f"{name}: check --strict -> {code}")
    code, out = call("run", f"{name}.k", "-o", name, "--threads", "1", "--quiet")
    check(code == 0, f"{name}: run -> {code} {out}")
    with open(f"{name}/summary.yaml") as file:
        scalars = dict(m.groups() for m in re.finditer(r'^ *(\w+): "?([^"\n]+)', file.read(), re.M))
    check(scalars["leaked_particles"] == "0", f"{name}: {scalars['leaked_particles']} particles leaked")
    check(scalars["verdict"] == "sound", f"{name}: {scalars['verdict']}")
    return said, scalars


def force(name, axis, begin):
    """Mean force on the walls along an axis from a time on."""
    rows = re.findall(r"SURFB +\d+ time +(\S+) +x +(\S+) +y +(\S+) +z +(\S+)", open(f"{name}/rcforc").read())
    values = [float(row[1 + axis]) for row in rows if float(row[0]) >= begin]
    check(len(values) >= 20, f"{name}: {len(values)} samples of the force")
    return sum(values) / len(values)


# --- the scene that users begin with
first = os.path.join(source, "keyword_decks", "first_scene", "scene.yaml")
lines = open(first).read().splitlines()
check(len(lines) < 40 and not any(line.lstrip(" -").startswith("*") for line in lines), f"the first scene has {len(lines)} lines and no cards")
said, end = computed("dam_break", first)
check(end["particles"] == "400" and "Choices to look at" not in said, "400 particles, and nothing to look at")

# --- still water, open and closed, in 2D and 3D: it stays, and its weight is on the floor
_, end = computed("still", "title: still water\nwater: {spacing: 0.025, blocks: [{low: [0, 0], high: [0.5, 0.5]}]}\n"
                  "box: {low: [0, 0], high: [0.5, 0.7], open: [top]}\nwall_method: contact\nend: 5\noutput: 0.1\n")
weight = RHO * G * 0.5 * 0.5
down, aside = force("still", 1, 3), force("still", 0, 3)
# of the walls' force a mean over two seconds: some periods of the sloshing that is left
check(abs(down / -weight - 1) < 0.01 and abs(aside) < 0.01 * weight, f"weight on the floor {-down:.1f} of {weight:.1f} N/m, aside {aside:.1f}")
check(float(end["kinetic"]) < 1e-3 * weight * 0.25, f"kinetic energy {end['kinetic']} of the {weight * 0.25:.0f} J/m that the water has above the floor")
_, end = computed("still_3d", "title: still water\nwater: {spacing: 0.05, blocks: [{low: [0, 0, 0], high: [0.5, 0.3, 0.4]}]}\n"
                  "box: {low: [0, 0, 0], high: [0.5, 0.3, 0.6]}\nwall_method: contact\nend: 2\noutput: 0.1\n")
weight = RHO * G * 0.5 * 0.3 * 0.4
down = force("still_3d", 2, 1)
check(abs(down / -weight - 1) < 0.01, f"weight on the floor {-down:.1f} of {weight:.1f} N")

# --- other units: the same water in tonnes and mm
said, end = computed("still_mm", "title: still water\nwater: {spacing: 25, density: 1.0e-9, blocks: [{low: [0, 0], high: [500, 500]}]}\n"
                     "box: {low: [0, 0], high: [500, 700], open: [top]}\nwall_method: contact\ngravity: 9810\nend: 2\noutput: 0.1\n")
check("Units: tonne-mm-s" in said, "the units are seen")

# --- LS-DYNA's defaults are reported, and what to type
deck = open("dam_break.k").read()
usual = re.sub(r"(\*MAT_NULL\n.*\n.{20}).{10}", r"\g<1>       0.0", deck)
usual = re.sub(r"(sfsa      sfsb\n).{10}", r"\g<1>       1.0", usual)
with open("usual.k", "w") as file:
    file.write(usual)
code, said = call("check", "usual.k")
said = re.sub(r"\s+", " ", said)
check(code == 0 and "type SFSA = 10" in said and "type PC = -1.0E20 in *MAT_NULL" in said, f"SFSA 1 and PC 0 are told: {said[said.find('Choices'):][:600]}")
check(call("run", "usual.k", "-o", "usual", "--threads", "1", "--quiet")[0] == 0, "it runs")
check("leaked_particles: 0" in open("usual/summary.yaml").read(), "and no particle leaks")

sys.exit(f"{len(failures)} failed" if failures else 0)
