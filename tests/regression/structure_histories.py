#!/usr/bin/env python3
"""elout, secforc, nodout and spcforc of structures as a reader of LS-DYNA's files meets them, and fields of points.

usage: structure_histories.py COURANT WORK_DIR

A cantilever of each kind (solids, shells, beams) under a load at its end. The parsers know LS-DYNA's columns only and stop at a
line that they do not expect. Values are held against statics; files of a run that was restarted, and on two threads, against
those of one that was not.
"""
import math
import os
import re
import subprocess
import sys

from checks import check, enter_empty_folder, failures

courant, work = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "structure_histories")
enter_empty_folder(work)
heading = r" e l e m e n t   s t r e s s   c a l c u l a t i o n s   f o r   t i m e  s t e p(.{9})   \( at time (.{12}) \)"


def deck(more="", end=0.2):
    out = ["*KEYWORD", "*TITLE", "strips", "*CONTROL_TERMINATION", str(end), "*MAT_ELASTIC", "1,7850.0,2.1E11,0.0", "*DEFINE_CURVE", "1",
           "0.0,0.0", "0.01,1.0", "9.0,1.0", "*DAMPING_GLOBAL", "0,250.0",
           "*PART", "solids", "1,1,1", "*PART", "shells", "2,2,1", "*PART", "beams", "3,3,1",
           "*SECTION_SOLID", "1,2", "*SECTION_SHELL", "2,2,1.0,3", "0.02", "*SECTION_BEAM", "3,1,1.0,2", "0.02,0.02,0.02,0.02", "*NODE"]
    for i in range(11):
        held = "7,7" if i == 0 else "0,0"
        for k in range(4):
            out.append(f"{100 * i + k + 1},{0.1 * i},{0.1 * (k % 3 != 0)},{0.1 * (k > 1)},{held}")
        for k in range(2):
            out.append(f"{100 * i + k + 11},{0.1 * i},{0.3 + 0.1 * k},0.0,{held}")
        out.append(f"{100 * i + 21},{0.1 * i},0.6,0.0,{held}")
    out += ["9999,0.0,5.0,0.0,7,7", "*ELEMENT_SOLID"]
    row = lambda *numbers: "".join(f"{n:8}" for n in numbers)
    for i in range(10):
        a, b = 100 * i, 100 * i + 100
        out.append(row(i + 1, 1, a + 1, b + 1, b + 2, a + 2, a + 4, b + 4, b + 3, a + 3))
    out += ["*ELEMENT_SHELL"] + [row(i + 1, 2, 100 * i + 11, 100 * i + 111, 100 * i + 112, 100 * i + 12) for i in range(10)]
    out += ["*ELEMENT_BEAM"] + [row(i + 1, 3, 100 * i + 21, 100 * i + 121, 9999) for i in range(10)]
    out += ["*LOAD_NODE_POINT", "1001,1,1,250.0", "1002,1,1,250.0", "1003,1,1,250.0", "1004,1,1,250.0", "1011,3,1,0.5", "1012,3,1,0.5", "1021,3,1,1.0"]
    out += ["*DATABASE_ELOUT", "0.05", "*DATABASE_SECFORC", "0.05", "*DATABASE_NODOUT", "0.05", "*DATABASE_SPCFORC", "0.05",
            "*DATABASE_HISTORY_SOLID_ID", "         6a solid", "*DATABASE_HISTORY_SHELL", "5,6", "*DATABASE_HISTORY_BEAM_SET", "3",
            "*SET_BEAM", "3", "6,7", "*DATABASE_HISTORY_NODE", "1001,1011,1021",
            "*DATABASE_CROSS_SECTION_PLANE_ID", "         8through the shells", "2,0.55,0.0,0.0,1.0,0.0,0.0", "0.0", "*SET_PART_LIST", "2", "2",
            "*DATABASE_BINARY_D3PLOT", "0.1", "*DATABASE_EXTENT_BINARY", "0,0,3"]
    return "\n".join(out) + "\n" + more + "*END\n"


def write(name, text):
    with open(name, "w") as file:
        file.write(text)


def run(*arguments):
    done = subprocess.run([courant, "run", *arguments, "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
    check(done.returncode == 0, f"courant run {' '.join(arguments)}" if done.returncode == 0 else done.stdout)


class Lines:
    """The lines of a file behind its head, blank ones left out."""

    def __init__(self, path):
        with open(path) as file:
            text = file.read()
        head, _, rest = text.partition("{END LEGEND}\n")
        self.legend = {int(line[:9]): line[14:84].rstrip() for line in head.split(" Entity #        Title\n")[1].splitlines()} if rest else {}
        self.all = [line for line in (rest or text).split("\n") if line.strip()]
        if not rest:
            self.all = self.all[2:]
        self.at = 0

    def more(self, start=""):
        return self.at < len(self.all) and self.all[self.at].startswith(start)

    def match(self, pattern):
        line = self.all[self.at]
        self.at += 1
        found = re.fullmatch(pattern, line)
        if not found:
            raise SystemExit(f"FAILED  {line!r} is not {pattern!r}")
        return found.groups()


def numbers(texts):
    return [float(t) for t in texts]


def elout(path):
    """States: time, {kind: {element: [values of each point]}}, and of beams resultants in front."""
    lines, states = Lines(path), []
    point = r"%s (elastic|plastic|failed ) " + 6 * "(.{12})"
    while lines.more():
        if lines.more(" r e s u l t a n t s"):
            _, t = lines.match(r" r e s u l t a n t s   a n d   s t r e s s e s   f o r   t i m e  s t e p(.{9})   \( at time(.{12}) \)")
            found = {}
            while lines.more(" beam/truss"):
                element, part, material = map(int, lines.match(r" beam/truss # =(.{8})      part ID  =(.{10})      material type=(.{8})"))
                assert (part, material) == (3, 1), (part, material)
                lines.match(r" resultants      axial    shear-s    shear-t    moment-s   moment-t   torsion")
                found[element] = [numbers(lines.match(" {11}" + 6 * "(.{11})"))]
                lines.match(" integration point stresses")
                lines.match(" {23}sigma 11       sigma 12       sigma 31   plastic  eps")
                while lines.more("    ") and re.match(r" {4}\d {11}", lines.all[lines.at]):
                    found[element].append(numbers(lines.match(r" {4}\d {11}" + 4 * "(.{15})")))
            kind = "beam"
        else:
            _, t = lines.match(heading)
            shells = "(global)" in lines.all[lines.at] or "(local)" in lines.all[lines.at]
            kind = "shell" if shells else "solid"
            if shells:
                lines.match(r" element  materl\((?:global\)|local\) )")
                lines.match(r" ipt-shl  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx       plastic")
                lines.match(r" {11}state {81}strain ")
            else:
                lines.match(r" element  materl")
                lines.match(r"     ipt  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx {23}yield")
                lines.match(r" {11}state {82}effsg      function")
            found = {}
            while lines.more() and re.fullmatch(r"[ \d]{8}-[ \d]{7}", lines.all[lines.at]):
                element, part = map(int, lines.match("(.{8})-(.{7})"))
                assert part == (2 if shells else 1)
                found[element] = []
                number = len(found[element]) + 1
                while lines.more() and re.match(r"[ \d]{4}[- ][ \d]{3} [epf]", lines.all[lines.at]):
                    row = lines.match(point % (rf"{number:4d}-  1" if shells else f"{number:8d}") + ("(.{14})" if shells else "(.{14})(.{14})"))
                    found[element].append(numbers(row[1:]))
                    number += 1
        if not states or states[-1][0] != float(t):
            states.append((float(t), {}))
        states[-1][1][kind] = found
    return lines.legend, states


def secforc(path):
    lines, states = Lines(path), []
    lines.match(r" line#1  section#     time        x-force     y-force     z-force    magnitude")
    lines.match(r" line#2  resultant  moments       x-moment    y-moment    z-moment   magnitude")
    lines.match(r" line#3  centroids                x           y           z            area  ")
    four = "(.{15})" + 3 * "(.{12})"
    while lines.more():
        section, t, *force = lines.match("(.{12})(.{15})" + four)
        moment = lines.match("global system              " + four)
        centroid = lines.match(" {27}" + four)
        states.append((int(section), float(t), numbers(force), numbers(moment), numbers(centroid)))
    return lines.legend, states


def near(found, theory, what, relative=2e-3, absolute=0.0):
    pairs = list(zip(found, theory)) if isinstance(theory, (list, tuple)) else [(found, theory)]
    check(all(abs(a - b) <= relative * abs(b) + absolute for a, b in pairs), f"{what}: {found}, by statics {theory}")


write("strips.k", deck())
run("strips.k", "-o", "one", "--threads", "1")
legend, states = elout("one/elout")
check(legend == {6: "a solid"}, f"legend of elout: {legend}")
check([t for t, _ in states][0] == 0 and len(states) >= 5 and all(set(s) == {"solid", "shell", "beam"} for _, s in states), "elout has all kinds at all times")
last = states[-1][1]
check({kind: sorted(found) for kind, found in last.items()} == {"solid": [6], "shell": [5, 6], "beam": [6, 7]}, "the elements asked for, and no others")
near(last["solid"][6][0][:1] + last["solid"][6][0][6:], [1e5, 1e5, 0], "stress of the solid, effective, plastic strain", absolute=1e-9)
check(len(last["solid"][6]) == 1 and len(last["shell"][6]) == 3 and len(last["beam"][6]) == 5, "one point of solids, three of shells, four of beams")
moment = 1.0 * 0.45
outer = moment * 0.01 / (0.1 * 0.02**3 / 12) * math.sqrt(0.6)
near([p[0] for p in last["shell"][6]], [outer, 0, -outer], "bending stress of the shell", absolute=2e-3 * outer)
near(last["beam"][6][0], [0, 0, 1, -moment, 0, 0], "resultants of the beam", absolute=2e-3)
fibre = moment / (0.02**4 / 12) * 0.01 / math.sqrt(3)
near(sorted(p[0] for p in last["beam"][6][1:]), [-fibre, -fibre, fibre, fibre], "stress at the points of the beam")

legend, states = secforc("one/secforc")
check(legend == {8: "through the shells"}, f"legend of secforc: {legend}")
section, t, force, bending, centroid = states[-1]
near(force, [0, 0, 1, 1], "force through the shells", absolute=2e-3)
near(bending, [0, -moment, 0, moment], "moment through the shells", absolute=2e-3)
near(centroid, [0.55, 0.35, moment * 0, 0.002], "centroid and area", absolute=1e-3)

# --- rotations of nodes and moments of supports
with open("one/nodout") as file:
    blocks = file.read().split(" n o d a l   p r i n t   o u t")
turning = [line for line in blocks[-1].splitlines() if re.match(r" *\d+ ", line)]
check("x-rot " in blocks[-1] and len(turning) == 3 and all(len(line) == 10 + 9 * 12 for line in turning), "nodout has rotations of three nodes")
angles = {int(line[:9]): numbers([line[10 + 12 * k:22 + 12 * k] for k in range(9)]) for line in turning}
near(angles[1011][1], -1 / (2 * 2.1e11 * 0.1 * 0.02**3 / 12), "slope at the end of the shells")
near(angles[1021][1], -1 / (2 * 2.1e11 * 0.02**4 / 12), "slope at the end of the beams")
check(angles[1001] == [0] * 9, "a node of solids does not turn")
with open("one/spcforc") as file:
    last_state = file.read().split(" output at time =")[-1]
rows = re.findall(r" node=(.{8}) local x,y,z (forces |moments)=(.{14})(.{14})(.{14})", last_state)
nodes = [int(node) for node, *_ in rows]
check(nodes == sorted(nodes) and len(rows) == 7 + 3, f"reactions by node, of 7 nodes forces and of 3 moments: {len(rows)} rows")
moments = {int(node): numbers(values) for node, what, *values in rows if what == "moments"}
forces = {int(node): numbers(values) for node, what, *values in rows if what == "forces "}
near(forces[21][2], -1, "reaction of the beams")
near(moments[21][1], 1, "moment of their support")
near(moments[11][1] + moments[12][1], 1, "moment of the support of the shells", 5e-3)

# --- more points, history variables, local axes
write("more.k", deck("*DATABASE_EXTENT_BINARY\n0,1,5\n0,0,4\n8\n*CONTROL_OUTPUT\n0\n0,0,0,0,0,0.0,0,1\n", 0.05))
run("more.k", "-o", "more", "--threads", "1")
_, states = elout("more/elout")


def arrays_of(folder, kind):
    """Names and values of the cells in the last state."""
    name = sorted(f for f in os.listdir(f"{folder}/fields") if f.startswith(kind))[-1]
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(f"{folder}/fields/{name}")
    reader.Update()
    data = reader.GetOutput().GetCellData()
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}


try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    print("Python's vtk is not here: fields of points are not compared")
else:
    shells, solids = arrays_of("one", "shells_"), arrays_of("one", "solids_")
    shown = lambda arrays: {name for name in arrays if re.search("_(lower|middle|upper|of_point_.)$", name)
                            and not name.startswith(("von_mises", "pressure", "principal_stress"))}  # which follow from the stress
    check(shown(shells) == {"stress_lower", "stress_middle", "stress_upper", "plastic_strain_lower", "plastic_strain_middle", "plastic_strain_upper"},
          f"MAXINT 3: lower, middle, upper: {sorted(shown(shells))}")
    check(not shown(solids), "solids and beams tell of no points unless asked to")
    near([float(shells[f"stress_{side}"][5][0]) for side in ("lower", "middle", "upper")], [outer, 0, -outer], "stress of the shell in the field files", absolute=2e-3 * outer)
    shells, solids = arrays_of("more", "shells_"), arrays_of("more", "solids_")
    check(shown(shells) == {"stress_lower", "stress_upper"} | {f"{what}_of_point_{k}" for k in (1, 2, 3) for what in ("stress", "plastic_strain", "history_1")},
          f"MAXINT 5 and NEIPS 1: all points of three: {sorted(shown(shells))}")
    check(shown(solids) == {f"beam_stress_of_point_{k}" for k in (1, 2, 3, 4)} | {f"{what}_of_point_{k}" for k in range(1, 9) for what in ("stress", "plastic_strain")},
          f"BEAMIP 4, NINTSLD 8: {sorted(shown(solids))}")
check(len(states[-1][1]["solid"][6]) == 8, "NINTSLD 8: eight points of solids")
check("materl(local) " in open("more/elout").read() and "materl(global)" in open("one/elout").read(), "EOCS tells the axes")
write("history.k", deck("*DATABASE_ELOUT\n0.05,0,0,1,1,1,0,1\n", 0.05))
run("history.k", "-o", "history", "--threads", "1")
text = open("history/elout").read()
check(all(f" element part ID   ({kind})" in text for kind in ("solid", "shell", "beam")) and "h i s t r y" in text and "      resultants " in text, "OPTION1, 2, 4: layout with history")

# --- the same on two threads and over a restart
run("strips.k", "-o", "two", "--threads", "2")
run("strips.k", "-o", "part", "--until", "0.12", "--threads", "1")
run("strips.k", "-o", "part", "--restart", "part", "--threads", "2")
for name in ("elout", "secforc", "nodout", "spcforc"):
    whole = open(f"one/{name}").read()
    check(open(f"two/{name}").read() == whole, f"{name} is the same on two threads")
    check(open(f"part/{name}").read() == whole, f"{name} goes on behind a restart")
sys.exit(1 if failures else 0)
