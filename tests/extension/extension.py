#!/usr/bin/env python3
"""Laws, a load, an element, an interface law and a history of one file each, brought in by `courant run --load` and held against theory.

usage: extension.py COURANT FOLDER_OF_SHARED_OBJECTS SOURCE_DIR
"""
import glob
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.abspath(sys.argv[3]), "tests", "regression"))
from checks import check, enter_empty_folder, failures  # noqa: E402
from restart_scene import arrays, differing, field_values, latest, text_of  # noqa: E402

import numpy  # noqa: E402  (restart_scene has made sure that it is there)

courant, objects, source = (os.path.abspath(word) for word in sys.argv[1:4])
decks = os.path.join(source, "tests", "extension")
enter_empty_folder(os.path.join(objects, "runs"))


def call(*words):
    """Exit code and both streams together."""
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=200, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout


def fine(*words):
    code, text = call(*words)
    check(code == 0, f"courant {' '.join(words)}")
    if code != 0:
        print(text[-2000:])
        sys.exit(1)
    return text


def loads(*names):
    return [word for name in names for word in ("--load", f"{objects}/{name}.so")]


def near(value, theory, tolerance, text):
    check(abs(value - theory) <= tolerance * abs(theory), f"{text}: {value:.6g}, theory {theory:.6g}, error {abs(value / theory - 1):.2e} of {tolerance:g}")


def glstat(folder, label):
    with open(f"{folder}/glstat") as file:
        text = file.read()
    return numpy.array([float(v) for v in re.findall(rf"^ {label}\.+ *(\S+)$", text, re.M)])


def history(folder, path):
    return arrays(f"{folder}/history.h5")[path]


def table(file):
    """The lines of four numbers."""
    with open(file) as stream:
        return numpy.array([[float(word) for word in line.split()] for line in stream if re.match(r"\d\S* \S+ \S+ \S+$", line)])


def alike(a, b, text):
    wrong = differing(arrays(latest(a), "/state"), arrays(latest(b), "/state"))
    for name in ("glstat", "matsum", "momentum", "rcforc"):
        if os.path.exists(f"{a}/{name}") and text_of(f"{a}/{name}") != text_of(f"{b}/{name}"):
            wrong.append(name)
    check(not wrong, f"{text} {wrong[:6]}")


def same_bits(name, deck, names, dump):
    """On two threads, and when the run goes on from its first restart file."""
    with open(deck) as file:
        text = file.read().replace("*END", f"*DATABASE_BINARY_D3DUMP\n{dump}\n*END")
    with open(f"{name}_dumps.k", "w") as file:
        file.write(text)
    run = ["run", f"{name}_dumps.k", "--quiet", *loads(*names)]
    fine(*run, "-o", f"{name}_whole", "--threads", "1")
    fine(*run, "-o", f"{name}_two", "--threads", "2")
    alike(f"{name}_whole", f"{name}_two", f"{name}: the same bits on two threads")
    shutil.copytree(f"{name}_whole", f"{name}_part")
    fine(*run, "-o", f"{name}_part", "--restart", f"{name}_part/restart/d3dump01.h5")
    alike(f"{name}_whole", f"{name}_part", f"{name}: the same bits after a restart")
    code, said = call("run", f"{name}_dumps.k", "-o", f"{name}_without")
    check(code == 1 and "EXAMPLE" in said and not os.path.exists(f"{name}_without"), f"{name}: refused without its file")


def period(t, values):
    """Of values that swing as a + b cos + c sin."""
    def misfit(T):
        A = numpy.stack([numpy.ones_like(t), numpy.cos(2 * numpy.pi * t / T), numpy.sin(2 * numpy.pi * t / T)], 1)
        return numpy.linalg.lstsq(A, values, rcond=None)[1][0]
    low, high = numpy.log((t[-1] - t[0]) / 40), numpy.log((t[-1] - t[0]) / 2)
    for _ in range(4):
        tries = numpy.linspace(low, high, 801)
        best = tries[numpy.argmin([misfit(T) for T in numpy.exp(tries)])]
        width = (high - low) / 400
        low, high = best - width, best + width
    return float(numpy.exp(best))


def copies(deck, name, count):
    """The solids and springs of a deck `count` times beside each other: more than one block of elements."""
    with open(deck) as file:
        lines = file.read().splitlines()
    ids = {"*NODE": 1, "*ELEMENT_SOLID": -1, "*ELEMENT_EXAMPLE_SPRING": 3, "*INITIAL_VELOCITY_NODE": 1, "*SET_NODE_LIST": 0}
    out, keyword, first = [], "", False
    for line in lines:
        if line.startswith("*"):
            keyword, first = line, True
        elif keyword in ids and not line.startswith("$") and not (keyword == "*SET_NODE_LIST" and first):
            words = line.split(",")
            for k in range(count):
                moved = list(words)
                for w in range(len(words)):
                    place = keyword == "*ELEMENT_SOLID" and w == 1
                    if not place and (ids[keyword] <= 0 or w < ids[keyword]):
                        moved[w] = str(int(words[w]) + 1000 * k)
                if keyword == "*NODE":
                    moved[3] = f"{float(words[3]) + k:g}"
                out.append(",".join(moved))
            continue
        elif keyword == "*SET_NODE_LIST":
            first = False
        out.append(line)
    with open(name, "w") as file:
        file.write("\n".join(out) + "\n")


# --- a strength law: the stress of a cube that is sheared within t1 and then held
deck = f"{decks}/strength_law.k"
fine("run", deck, "-o", "strength", "--quiet", *loads("strength_law"))
G, tau, t1, shear = 1e6 / 2.5, 0.1, 0.02, 1e-3
with open("strength/fields.pvd") as file:
    states = re.findall(r'timestep="([^"]+)"[^>]*file="([^"]+)"', file.read())
for t, name in states[2::3]:
    stress = field_values(f"strength/{name}")["cell stress"]
    held = float(t) - t1
    theory = G * shear / t1 * tau * (1 - numpy.exp(-t1 / tau)) * numpy.exp(-held / tau)
    near(stress[0][3], theory, 0.005, f"Maxwell: shear stress at {float(t):.3f} s")
copies(deck, "strength_many.k", 70)
same_bits("strength_many", "strength_many.k", ["strength_law"], 100)

# --- a formulation of solids: what the library computes of the same tetrahedra
deck = f"{decks}/solid_formulation.k"
fine("run", deck, "-o", "four_corners", "--quiet", *loads("solid_formulation"))
fine("run", deck, "-o", "eight_corners", "--quiet", "--param", "ELFORM=10")
for label in ("kinetic energy", "internal energy", "time step"):
    own, other = glstat("four_corners", label), glstat("eight_corners", label)
    check(len(own) > 15 and numpy.allclose(own, other, rtol=1e-6), f"tetrahedron of four corners: {label} of glstat as that of ELFORM 10")

# --- an equation of state: a standing wave
fine("generate", f"{decks}/equation_of_state.yaml", "-o", "gas.k")
fine("run", "gas.k", "-o", "gas", "--quiet", *loads("equation_of_state"))
near(period(glstat("gas", "time"), glstat("gas", "kinetic energy")), 0.05, 0.005, "stiffened gas: period of the kinetic energy")
with open("gas.k") as file, open("free_gas.k", "w") as out:  # with a surface, so that energy and density change much
    out.write(re.sub(r"^\*BOUNDARY_SPH_PERIODIC\n.*\n.*\n", "", file.read(), flags=re.M))
same_bits("free_gas", "free_gas.k", ["equation_of_state"], 100)

# --- a load: exponential approach of particles and solids to the wind, and its work
fine("run", f"{decks}/load.k", "-o", "wind", "--quiet", *loads("load", "ascii_history"))
t, x, y, _ = table("wind/momentum").T
for part, mass, speed, momentum in (("particles", 3, 2, x), ("solids", 1, 1, y)):
    near(momentum[-1], mass * speed * (1 - numpy.exp(-2 * t[-1])), 0.002, f"wind: momentum of {part} at {t[-1]:.3g} s")
    error = numpy.abs(momentum - mass * speed * (1 - numpy.exp(-2 * t))).max()
    check(error < 0.002 * mass * speed, f"wind: momentum of {part} at all times, error {error / mass / speed:.1e} of 2e-3")
residual = numpy.abs(history("wind", "global/residual")).max() / history("wind", "global/kinetic").max()
check(residual < 1e-10, f"wind: energy ledger closes to {residual:.1e} of the kinetic energy")
code, text = call("run", f"{decks}/load.k", "-o", "still", "--param", "COEFF=0", *loads("load", "ascii_history"))
check(code == 1 and re.search(r"load\.k:\d+:.*\*LOAD_EXAMPLE_WIND field 2 \(COEFF", text) is not None, "wind: COEFF = 0 is refused by field")
same_bits("wind", f"{decks}/load.k", ["load", "ascii_history"], 1000)

# --- an interface law: slip over a floor
deck = f"{decks}/interface_law.k"
fine("run", deck, "-o", "slip", "--quiet", *loads("interface_law"))
t, momentum = history("slip", "global/time"), history("slip", "parts/1/momentum")[:, 0] / 30
error = numpy.abs(momentum - numpy.exp(-4 * t)).max()
check(error < 0.005, f"viscous slip: v = exp(-4 t) at all times, error {error:.1e} of 5e-3")

# nodes with faces take no such laws
nodes = """*KEYWORD
*NODE
1,0.,0.,0.
2,1.,0.,0.
3,1.,1.,0.
4,0.,1.,0.
11,0.4,0.4,0.06
12,0.5,0.4,0.06
13,0.5,0.5,0.06
14,0.4,0.5,0.06
*ELEMENT_SHELL
1,1,1,2,3,4
2,2,11,12,13,14
*PART
floor
1,1,1
*PART
plate
2,1,2
*SECTION_SHELL
1,2
0.05
*MAT_RIGID
1,1000.,1.E6,0.25
1.,7,7
*MAT_ELASTIC
2,1000.,1.E6,0.25
*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID
5,slide
2,1,3,3


*CONTACT_EXAMPLE_VISCOUS_SLIP
5,50.
*CONTROL_TERMINATION
0.4
*END
"""
with open("nodes_slip.k", "w") as file:
    file.write(nodes)
code, text = call("run", "nodes_slip.k", "-o", "nodes_slip", *loads("interface_law"))
check(code == 1 and "nodes_slip.k:34:1: error: *CONTACT_EXAMPLE_VISCOUS_SLIP: contact 5 is one of nodes with faces" in text, f"a law on a contact of nodes is refused: {text[-300:]}")
lost = history("slip", "contacts/7/energy_friction")[-1]
near(lost, 0.5 * 30 * (1 - numpy.exp(-8 * t[-1])), 0.005, "viscous slip: energy taken")
with open(deck) as file, open("no_contact.k", "w") as out:
    out.write(file.read().replace("\n7,4.\n", "\n8,4.\n"))
code, text = call("run", "no_contact.k", "-o", "no_contact", *loads("interface_law"))
check(code == 1 and "*CONTACT_EXAMPLE_VISCOUS_SLIP: contact 8 does not exist" in text, "viscous slip: refused for a contact that is not there")
same_bits("slip", deck, ["interface_law"], 300)

# --- an element: two blocks on springs
deck = f"{decks}/element.k"
fine("run", deck, "-o", "springs", "--quiet", *loads("element"))
near(period(history("springs", "global/time"), history("springs", "global/kinetic")), numpy.pi / numpy.sqrt(2000), 0.01, "springs: period of the kinetic energy")
energy = history("springs", "global/total")
# kinetic energy is that of half a step earlier: the sum swings by omega dt / 2 of the energy of the oscillation, and drifts not at all
swing = 0.25 * 0.3**2 * numpy.sqrt(2000) * history("springs", "global/dt").max() / 2
check(numpy.abs(energy - energy[0]).max() < 1.1 * swing, f"springs: total energy within {numpy.abs(energy - energy[0]).max() / swing:.2f} of omega dt / 2, bound 1.1")
drift = abs(energy[:70].mean() / energy[-70:].mean() - 1)  # two whole periods each
check(drift < 1e-3, f"springs: drift of the energy {drift:.1e} of 1e-3")
cells = field_values(sorted(glob.glob("springs/fields/*.vtu"))[-1])
check(cells["cell part"].tolist() == [1, 1, 0, 0, 0, 0] and cells["cell stress"].shape == (6, 6) and not cells["cell stress"][2:].any()
      and cells["cell stress"][:2].any() and cells["cell internal_energy"][2:].min() > 0, "springs: shown beside the solids, whose fields stay")
check(history("springs", "global/internal").max() > 0.9 * 0.25 * 0.3**2, "springs: their energy is in the ledger")
text = fine("check", deck, *loads("element"))
with open(deck) as file, open("no_node.k", "w") as out:
    out.write(file.read().replace("101,12,21,250.", "101,12,99,250."))
code, text = call("run", "no_node.k", "-o", "no_node", *loads("element"))
check(code == 1 and "(N2" in text and "ELEMENT_EXAMPLE_SPRING" in text, "springs: refused between nodes of nothing")
lone = """*KEYWORD
*NODE
1,0.,0.,0.
2,0.1,0.,0.
*ELEMENT_EXAMPLE_SPRING
1,1,2,1000.,2.
*INITIAL_VELOCITY_NODE
1,0.1
2,-0.1
*CONTROL_TIMESTEP
0.,0.05
*CONTROL_TERMINATION
1.
*DATABASE_GLSTAT
0.002
*END
"""
for name, text in (("lone", lone), ("massless", lone.replace("1000.,2.", "1000."))):
    with open(f"{name}.k", "w") as file:
        file.write(text)
fine("run", "lone.k", "-o", "lone", "--quiet", *loads("element"))
near(period(history("lone", "global/time"), history("lone", "global/kinetic")), numpy.pi / numpy.sqrt(2000), 0.002, "springs: between nodes of nothing else, period")
code, text = call("run", "massless.k", "-o", "massless", *loads("element"))
check(code == 1 and "node 1 moves by its forces and has no mass" in text, "springs: nodes without mass are refused")
copies(deck, "springs_many.k", 20)
same_bits("springs_many", "springs_many.k", ["element"], 1000)

# --- a history: the same sum as that of the parts
deck = f"{decks}/ascii_history.k"
fine("run", deck, "-o", "momentum", "--quiet", *loads("element", "ascii_history"))
rows = table("momentum/momentum")
parts = history("momentum", "parts/1/momentum")
check(len(rows) == len(parts) > 400, f"momentum: {len(rows)} states")
check(numpy.abs(rows[:, 1:] - parts).max() < 1e-8, f"momentum: sum of m v, difference {numpy.abs(rows[:, 1:] - parts).max():.1e}")
near(rows[-1, 1], 0.1, 1e-6, "momentum: kept by the springs")
same_bits("momentum", deck, ["element", "ascii_history"], 1000)
fine("keywords", "DATABASE_EXAMPLE_MOMENTUM", *loads("ascii_history"))

# --- files that cannot be loaded
deck = f"{decks}/element.k"
with open("text.so", "w") as file:
    file.write("no shared object\n")
for file, says in (("missing.so", "the file missing.so does not exist"), ("text.so", "text.so cannot be loaded: .*invalid ELF header|text.so cannot be loaded: .*file too short"),
                   (f"{objects}/throws.so", "throws.so failed while it was loaded: no licence for this law"),
                   (f"{objects}/twice.so", r"twice.so registers \*MAT_ELASTIC, which is there already"),
                   (f"{objects}/nothing.so", "nothing.so registers nothing"),
                   (f"{objects}/other_headers.so", "other_headers.so was compiled against the headers of another Courant"),
                   (f"{objects}/unstamped.so", "unstamped.so does not say which headers it was compiled against"), (".", "is no file")):
    code, text = call("run", deck, "-o", "wrong", "--load", file)
    check(code == 1 and re.search("^error: --load: .*" + f"(?:{says})", text, re.M) is not None and not os.path.exists("wrong"), f"--load {os.path.basename(file)}: {text.strip()[:200]}")

print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
