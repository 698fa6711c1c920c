#!/usr/bin/env python3
"""The histories as a reader of LS-DYNA's files meets them: columns, and values against closed forms and history.h5.

usage: histories.py COURANT SOURCE_DIR WORK_DIR

The parsers know LS-DYNA's layouts only: fixed columns, spaced headings, labels. They stop at a line that they do not expect.
"""
import math
import os
import re
import subprocess
import sys

from checks import check, enter_empty_folder, failures

try:
    import h5py
except ImportError:
    h5py = None
    print("Python's h5py is not here: history.h5 is not compared")

courant, source, work = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), os.path.join(os.path.abspath(sys.argv[3]), "histories")
enter_empty_folder(work)


def run(deck, folder):
    done = subprocess.run([courant, "run", os.path.join(source, deck), "-o", folder, "--threads", "1", "--quiet"], timeout=300)
    check(done.returncode == 0, f"{deck} runs")


def number(text):
    """A field of a Fortran format: blanks are no number."""
    return float(text) if text.strip() else math.nan


def columns(line, first, width, count):
    return [number(line[first + k * width:first + (k + 1) * width]) for k in range(count)]


class Lines:
    def __init__(self, path):
        with open(path) as file:
            self.all = file.read().split("\n")
        self.at = 0
        title, program = self.take(), self.take()
        check(title.startswith(" ") and len(title) == 73, f"{path}: a title of 72 characters behind a blank")
        check(re.fullmatch(r" {25}\S.*date \d\d/\d\d/\d{4}", program) is not None, f"{path}: program and date on the second line")
        self.legend = {}
        if self.peek() == "{BEGIN LEGEND}":
            self.take()
            assert self.take() == " Entity #        Title"
            while self.peek() != "{END LEGEND}":
                line = self.take()
                self.legend[int(line[:9])] = line[14:84].rstrip()
            self.take()

    def skip_blank(self):
        while self.at < len(self.all) and self.all[self.at].strip() == "":
            self.at += 1

    def peek(self):
        self.skip_blank()
        return self.all[self.at] if self.at < len(self.all) else None

    def take(self):
        line = self.peek()
        self.at += 1
        return line

    def match(self, pattern):
        line = self.take()
        found = re.fullmatch(pattern, line)
        if not found:
            raise SystemExit(f"FAILED  line {self.at}: {line!r} is not {pattern!r}")
        return found.groups()


def glstat(path):
    lines, states = Lines(path), []
    while lines.peek():
        cycle, _ = lines.match(r" dt of cycle(.{8}) is controlled by (.*)")
        state = {"cycle": int(cycle)}
        while lines.peek() and not lines.peek().startswith(" dt of cycle"):
            line = lines.take()
            assert line[0] == " " and len(line) == 46, line
            state[line[1:32].rstrip(".").strip()] = float(line[32:46])
        states.append(state)
    return states


def matsum(path):
    lines, states = Lines(path), []
    while lines.peek():
        (t,) = lines.match(r" time =(.{13})")
        parts = {}
        while lines.peek() and lines.peek().startswith(" mat.#="):
            text = "".join(lines.take() for _ in range(4))
            values = dict((name, float(value)) for name, value in re.findall(r"([+\w-]+)=(.{13})", text[12:]))
            parts[int(text[7:12])] = values
        states.append((float(t), parts))
    return lines.legend, states


def rcforc(path):
    lines, states = Lines(path), []
    while lines.peek():
        line = lines.take()
        side, number_, rest = line[2:7], int(line[8:19]), line[19:]
        values = dict((name, float(value)) for name, value in re.findall(r" (time|[xyz]|mass) ?(.{12})", rest))
        states.append((side, number_, values))
    return lines.legend, states


def sleout(path):
    lines, states = Lines(path), []
    while lines.peek():
        (t,) = lines.match(r" contact interface energy file, time=(.{14})")
        lines.match(r"    # {13}surfa {7}surfb {8}cycle=(.{14})    frictional")
        interfaces = {}
        while not lines.peek().startswith(" summary"):
            line = lines.take()
            interfaces[int(line[:10])] = columns(line, 10, 13, 2) + [float(line[-13:])]
        totals = [float(lines.match(p)[0]) for p in (r" summary   total surfa side=(.{14})", r" {11}total surfb side=(.{14})",
                                                     r" {11}total energy    =(.{14})", r" {11}total friction  =(.{14})")]
        states.append((float(t), interfaces, totals))
    return states


def nodout(path):
    lines, states = Lines(path), []
    heading = r" n o d a l   p r i n t   o u t   f o r   t i m e  s t e p(.{8}) {30}\( at time(.{14}) \)"
    while lines.peek():
        _, t = lines.match(heading)
        what = lines.match(r" nodal point  x-(disp|rot) .*")[0]
        width = 12 if what == "disp" else 9
        nodes = {}
        while lines.peek() and not lines.peek().startswith(" n o d a l"):
            line = lines.take()
            assert len(line) == 10 + 12 * width, line
            nodes[int(line[:9])] = columns(line, 10, 12, width)
        if what == "disp":
            states.append((float(t), nodes, {}))
        else:
            assert float(t) == states[-1][0]
            states[-1] = (float(t), states[-1][1], nodes)
    return lines.legend, states


def rbdout(path):
    lines, states = Lines(path), []
    row = r"(.{12})"
    while lines.peek():
        lines.match("1")
        _, t = lines.match(r"  r i g i d   b o d y   m o t i o n   a t  cycle=(.{8})    time=(.{15})")
        bodies = {}
        while lines.peek() and lines.peek().startswith(" rigid body"):
            (part,) = lines.match(r" rigid body(.{8})")
            lines.match(r"   global             x           y           z          x-rot       y-rot       z-rot")
            body = {"x": [float(v) for v in lines.match(r"   coordinates:  " + 3 * row)]}
            for name, label in (("d", " displacements:  "), ("v", "    velocities:  "), ("a", " accelerations:  ")):
                body[name] = [float(v) for v in lines.match(label + 6 * row)]
            lines.match(r"principal or user defined local coordinate direction vectors")
            lines.match(r" {21}a           b           c")
            body["axes"] = [[float(v) for v in lines.match(rf"     row {k}" + 3 * r"(.{15})")] for k in (1, 2, 3)]
            lines.match(r" output in principal or user defined local coordinate directions")
            lines.match(r" {22}a           b           c          a-rot       b-rot       c-rot")
            for name, label in (("ld", " displacements:  "), ("lv", "    velocities:  "), ("la", " accelerations:  ")):
                body[name] = [float(v) for v in lines.match(label + 6 * row)]
            bodies[int(part)] = body
        states.append((float(t), bodies))
    return states


def bndout(path):
    lines, states = Lines(path), []
    forces = r"  xforce=(.{13})   yforce=(.{13})  zforce=(.{13})   energy=(.{13})"
    while lines.peek():
        (t,) = lines.match(r" n o d a l   f o r c e/e n e r g y    o u t p u t   t=(.{9})")
        lines.match(r" velocity boundary condition forces/rigid body moments ")
        found = {}
        while not lines.peek().startswith("              xtotal="):
            who, number_, *values = lines.match(r"( nd#|mat#)(.{8})" + forces)
            found[who.strip(), int(number_)] = [float(v) for v in values]
            if who == "mat#":
                lines.match(r"             xmoment=(.{13})  ymoment=(.{13}) zmoment=(.{13})")
        total = [float(v) for v in lines.match(r"              xtotal=(.{13})   ytotal=(.{13})  ztotal=(.{13})   etotal=(.{13})")]
        states.append((float(t), found, total))
    return states


def spcforc(path):
    lines, states = Lines(path), []
    three = 3 * r"(.{14})"
    while lines.peek():
        (t,) = lines.match(r" output at time =(.{14})")
        nodes = {}
        while lines.peek().startswith(" node="):
            node, *force = lines.match(r" node=(.{8}) local x,y,z forces =" + three)
            nodes[int(node)] = [float(f) for f in force]
        total = [float(f) for f in lines.match(r"             force resultants   =" + three)]
        states.append((float(t), nodes, total))
    return states


def sphout(path):
    lines, states = Lines(path), []
    while lines.peek():
        t, _ = lines.match(r" S P H   o u t p u t       at time(.{11})     for  time  step(.{10})")
        tables = []
        for head in ("sig-xx", "eps-xx", "density     smooth     neigh   act", "yield       effsg       state"):
            lines.match(r" particle  mat    " + head + ".*")
            rows = {}
            while lines.peek() and re.match(r" *\d+ +\d+ *-?\d\.", lines.peek()):
                line = lines.take()
                count = 6 if head[3:] == "-xx" else 2
                rows[int(line[:8])] = [int(line[8:14])] + columns(line, 14, 12, count) + line[14 + 12 * count:].split()
            tables.append(rows)
        states.append((float(t), tables))
    return states


def near(a, b, what, relative=2e-4, absolute=1e-12):
    pairs = list(zip(a, b)) if isinstance(a, (list, tuple)) else [(a, b)]
    holds = all(abs(x - y) <= relative * max(abs(x), abs(y)) + absolute for x, y in pairs)
    check(holds, what if holds else f"{what}: {a} against {b}")


# --- motions with a closed form. Velocities are those of the half step before, so that v(t - dt/2) is what a file holds.
run("tests/decks/accept/whole_histories.k", "closed")
g, m = 9.81, 50.0
energies = glstat("closed/glstat")
check([s["time"] for s in energies][:3] == [0.0] + [s["time"] for s in energies][1:3] and len(energies) == 12, "glstat has 0, 0.05 ... and the end")
near(energies[-1]["total energy / initial energy"], 1, "energy ratio of glstat", 5e-3)
legend, states = matsum("closed/matsum")
check(legend == {1: "water", 5: "plate that falls and spins", 6: "plate that is driven up"}, f"legend of matsum: {legend}")
due = [0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5]
check(len(states) == 9 and all(0 <= d - t < 5e-3 for d, (t, _) in zip(due, states)), f"a curve tells when matsum is due: {[t for t, _ in states]}")
last_t = states[-1][0]
dt = energies[-1]["time step"]
near(states[-1][1][5]["z-mom"], -m * g * (last_t - dt / 2), "momentum of the plate that falls", 2e-3)
near(states[-1][1][5]["x-rbv"], 1, "its velocity")
legend, nodes = nodout("closed/nodout")
check(legend == {101: "corner of the plate that falls"}, "legend of nodout")
t, at, turning = nodes[-1]
check(sorted(at) == [20, 30, 101, 999] == sorted(turning), "nodes of nodout")
near(at[30][0], 1.5 * t * t, "a driven particle moves by a t^2 / 2")
near(at[30][6:9], [3, 0, -g], "its acceleration")
near(at[20][:9], [0] * 9, "a held particle rests")
near(at[999][9:], [7, 8, 9], "a node that nothing uses keeps its place")
angle = 2 * t
corner = [1.5 + t - 0.5 - 0.5 + 0.5 * math.cos(angle) + 0.5 * math.sin(angle), 0.5 + 0.5 * math.sin(angle) - 0.5 * math.cos(angle)]
near(at[101][9:11], corner, "the corner of the plate turns and moves", 1e-3)
near(at[101][11], 20 - g * t * t / 2, "and falls")
near(turning[101][:6], [0, 0, angle, 0, 0, 2], "rotation of the plate")
radius = [corner[0] - 0.5 - t, corner[1] - 0.5]
near(at[101][6:9], [-4 * radius[0], -4 * radius[1], -g], "centripetal acceleration", 3e-3)
t, bodies = rbdout("closed/rbdout")[-1]
near(bodies[5]["d"], [t, 0, -g * t * t / 2, 0, 0, angle], "rbdout: displacement of the plate")
near(bodies[5]["a"], [0, 0, -g, 0, 0, 0], "rbdout: acceleration")
near(bodies[5]["ld"][:2], [t * math.cos(angle), -t * math.sin(angle)], "rbdout: in axes that turn with it")
near(bodies[6]["d"][2], 2 * t * t, "rbdout: displacement of the plate that is driven")
t, forces, total = bndout("closed/bndout")[-1]
v = t - dt / 2
near(forces["nd#", 30], [30, 0, 0, 5 * (3 * v) ** 2], "bndout: force and work of a driven particle")
near(forces["mat#", 6], [0, 0, m * (4 + g), m * (4 + g) * 2 * v * v], "bndout: force and work of a driven body")
near(total[:3], [30, 0, m * (4 + g)], "bndout: sum")
for t, held, total in spcforc("closed/spcforc"):
    near(held[20], [0, 0, 10 * g], f"spcforc carries the particle's weight at {t}")
tables = sphout("closed/sphout")
check([round(s[0], 2) for s in tables] == [0.03, 0.11, 0.37, 0.5], f"sphout at the abscissae of its curve, and the end: {[s[0] for s in tables]}")
check(tables[0][1][2][1][1:] == [1000, 0.1, "0", "1"], f"density, h, neighbours, active: {tables[0][1][2][1]}")

# --- water in a box: contact, and the sums that two files share
deck = os.path.join(work, "still.k")
scene = os.path.join(source, "keyword_decks", "still_water", "scene.yaml")
subprocess.run([courant, "generate", scene, "-o", deck, "--param", "resolution=8", "--param", "endtim=0.1", "--param", "dt_plot=0.05"],
               check=True, stdout=subprocess.DEVNULL)
with open(deck) as file:
    text = file.read()
with open(deck, "w") as file:
    file.write(text.replace("*END", "*DATABASE_SLEOUT\n      0.01\n*DATABASE_SPHOUT\n      0.01\n*DATABASE_HISTORY_SPH\n         1         2\n*END"))
run(deck, "still")
energies, slides = glstat("still/glstat"), sleout("still/sleout")
of_time = {round(s["time"], 7): s for s in energies}
shared = 0
for t, interfaces, totals in slides:
    near(sum(v[0] + v[1] for v in interfaces.values()), totals[2], f"sleout adds up at {t}", absolute=1e-9)
    if round(t, 7) in of_time:
        shared += 1
        near(totals[2], of_time[round(t, 7)]["sliding interface energy"], f"and is the sliding energy of glstat at {t}", absolute=1e-9)
check(shared > 0, "sleout and glstat share times")
_, contact = rcforc("still/rcforc")
for (a, _, on_a), (b, _, on_b) in zip(contact[::2], contact[1::2]):
    if (a, b) != ("SURFA", "SURFB") or any(on_a[k] != -on_b[k] for k in "xyz"):
        check(False, f"rcforc: {on_a} and {on_b} are opposite")
check(len(contact) > 4, "rcforc holds both sides")
tables = sphout("still/sphout")

# --- courant post reads all of these files, and gives what history.h5 has, to the digits that they print
ASKED = (  # folder, file, id, side, name in the file, the same in history.h5, component, digits, factor
    ("closed", "glstat", None, None, "kinetic energy", "global/kinetic", None, 6, 1),
    ("closed", "glstat", None, None, "global z velocity", "global/velocity", 2, 6, 1),
    ("closed", "matsum", 5, None, "z-mom", "parts/5/momentum", 2, 5, 1),
    ("closed", "matsum", 1, None, "kinen", "parts/1/kinetic", None, 5, 1),
    ("closed", "nodout", 101, None, "y-disp", "nodes/101/displacement", 1, 5, 1),
    ("closed", "nodout", 101, None, "z-rot vel", "nodes/101/omega", 2, 5, 1),
    ("closed", "rbdout", 5, None, "accelerations z", "rigid_bodies/5/a", 2, 5, 1),
    ("closed", "rbdout", 6, None, "velocities z", "rigid_bodies/6/v", 2, 5, 1),
    ("closed", "bndout", 30, "nd#", "energy", "driven_particles/30/work", None, 5, 1),
    ("closed", "bndout", 6, "mat#", "zforce", "driven_bodies/6/force", 2, 5, 1),
    ("closed", "spcforc", 20, None, "forces z", "held_particles/20/force", 2, 5, 1),
    ("still", "rcforc", 1, "SURFB", "y", "contacts/1/force", 1, 6, -1),
    ("still", "sleout", 1, None, "frictional", "contacts/1/energy_friction", None, 5, 1),
    ("still", "sphout", 1, None, "density", "particles/1/rho", None, 5, 1),
    ("still", "sphout", 2, None, "smooth", "particles/2/h", None, 5, 1))


def series_of_post(folder):
    """Times and values of each of the ASKED, as courant post gives them."""
    recipe = "analyses:\n"
    for k, (where, name, id_, side, of, *_) in enumerate(ASKED):
        if where == folder:
            recipe += f"  - {{kind: history, name: a{k}, file: {name}, of: [{{name: value, of: {of}"
            recipe += (f", id: {id_}" if id_ else "") + (f", side: {side}" if side else "") + "}]}\n"
    with open("recipe.yaml", "w") as file:
        file.write(recipe)
    done = subprocess.run([courant, "post", "recipe.yaml", folder], stdout=subprocess.DEVNULL, timeout=120)
    check(done.returncode == 0, f"courant post of {folder}")
    found = {}
    for k, (where, *_) in enumerate(ASKED):
        if where == folder:
            with open(f"{folder}/post/a{k}.csv") as file:
                found[k] = [[float(word) for word in line.split(",")] for line in file.read().splitlines()[1:]]
    return found


if h5py:
    for folder in ("closed", "still"):
        with h5py.File(f"{folder}/history.h5") as h5:
            times = h5["global/time"][:]
            for k, rows in series_of_post(folder).items():
                _, name, id_, _, of, dataset, component, digits, factor = ASKED[k]
                values = h5[dataset][:] if component is None else h5[dataset][:, component]
                pairs = [(a, factor * values[j]) for t, a in rows for j in [int(abs(times - t).argmin())] if abs(times[j] - t) <= 1e-4 * t]
                # half of the last digit; courant post prints nine, and the momenta of what rests are round-off
                wrong = [(a, b) for a, b in pairs if not abs(a - b) <= 0.501 * 10.0 ** (1 - digits) * max(abs(a), abs(b)) + 1e-15]
                check(len(pairs) > 2 and not wrong, f"courant post, {of} of {name} {id_ or ''}: {len(pairs)} of {len(rows)} times {wrong[:2]}")

    def compare(folder, name, t, value, what):
        with h5py.File(f"{folder}/history.h5") as h5:
            times = h5["global/time"][:]
            row = min(range(len(times)), key=lambda k: abs(times[k] - t))
            found = h5[name][row] if name in h5 else math.nan
            near(list(value) if hasattr(value, "__len__") else float(value), [float(v) for v in found] if hasattr(found, "__len__") else float(found),
                 f"{what} is that of history.h5", 1e-4, 1e-9)
    t = energies[-1]["time"]
    compare("still", "global/kinetic", t, energies[-1]["kinetic energy"], "glstat")
    compare("still", "contacts/1/force", contact[-2][2]["time"], [contact[-2][2][k] for k in "xyz"], "rcforc")
    compare("still", "particles/1/rho", tables[-1][0], tables[-1][1][2][1][1], "sphout, density")
    compare("still", "particles/1/p", tables[-1][0], -tables[-1][1][0][1][1], "sphout, pressure")
    t, at, turning = nodes[-1]
    compare("closed", "nodes/101/displacement", t, at[101][:3], "nodout")
    compare("closed", "nodes/101/rotation", t, turning[101][:3], "nodout, rotation")
    compare("closed", "rigid_bodies/5/a", t, bodies[5]["a"][:3], "rbdout")
    compare("closed", "driven_particles/30/work", t, forces["nd#", 30][3], "bndout")
    compare("closed", "held_particles/20/force", t, held[20], "spcforc")
    with h5py.File("closed/history.h5") as h5:
        unnamed = []
        h5.visititems(lambda name, item: unnamed.append(name) if isinstance(item, h5py.Dataset) and "dimension" not in item.attrs else None)
        check(not unnamed, f"each dataset of history.h5 tells its dimension: {unnamed}")

# --- the example that reads them all
done = subprocess.run([sys.executable, os.path.join(source, "examples/results/histories.py"), "closed"], stdout=subprocess.PIPE, text=True, timeout=60)
if h5py:
    told = {name: value for name, value in re.findall(r"^  (\S+) +(\S+) \S.*$", done.stdout, re.M)}
    kinds = ("matsum, 9 times", "nodout, ", "rbdout, ", "bndout, ", "spcforc, ", "sphout, ", "  nodes/101/displacement ")
    check(done.returncode == 0 and all(kind in done.stdout for kind in kinds), f"the example reads all of it: {done.stdout[:600]}")
    t, at, turning = nodes[-1]
    for name, value in {"x_disp_101": at[101][0], "x_rot_101": turning[101][0], "forces_x_20": held[20][0], "energy_30_velocity_nd": forces["nd#", 30][3]}.items():
        near(float(told.get(name, "nan")), value, f"the example's {name}", 1e-5, 1e-30)

sys.exit(1 if failures else 0)
