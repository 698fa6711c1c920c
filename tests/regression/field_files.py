#!/usr/bin/env python3
"""Field files as VTK and ParaView read them, however they are packed, against history.h5; the timing table.

usage: field_files.py COURANT SOURCE_DIR WORK_DIR

ParaView is asked where pvbatch is in the PATH and has Python.
"""
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zlib

from checks import check, enter_empty_folder, failures

try:
    import h5py
    import numpy
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"{missing}: field files are not looked at")
    sys.exit(77)

courant, source, work = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), os.path.join(os.path.abspath(sys.argv[3]), "field_files")
enter_empty_folder(work)
messages = vtk.vtkStringOutputWindow()
vtk.vtkOutputWindow.SetInstance(messages)

scene = os.path.join(source, "keyword_decks", "still_water", "scene.yaml")
subprocess.run([courant, "generate", scene, "-o", "still.k", "--param", "resolution=8", "--param", "endtim=0.1", "--param", "dt_plot=0.02"],
               check=True, stdout=subprocess.DEVNULL)
with open("still.k") as file:
    text = file.read().replace("*END", "*DATABASE_SPHOUT\n      0.02\n*DATABASE_HISTORY_SPH\n" + "".join(f"{i:10d}" for i in (1, 20)) + "\n*END")


def run(name, *cards, shift=0):
    deck = text.replace("*END", "\n".join(cards) + "\n*END")
    if shift:
        deck = deck.replace("*END", "*NODE_TRANSFORM\n        77        77\n*SET_NODE_GENERAL\n        77\n       ALL\n*DEFINE_TRANSFORMATION\n"
                            f"        77\n{'TRANSL':10}{shift:10.1f}\n*END")
    with open(name + ".k", "w") as file:
        file.write(deck)
    done = subprocess.run([courant, "run", name + ".k", "-o", name, "--threads", "1", "--quiet"], stderr=subprocess.PIPE, text=True)
    check(done.returncode == 0, f"{name} runs {done.stderr}")
    return name


def states(folder, group):
    return [(float(d.get("timestep")), d.get("file")) for d in ElementTree.parse(os.path.join(folder, "fields.pvd")).iter("DataSet")
            if d.get("name") == group]


def read(path):
    reader = vtk.vtkXMLPolyDataReader() if path.endswith(".vtp") else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    check(reader.GetErrorCode() == 0 and messages.GetOutput() == "", f"VTK reads {path} without a word") if messages.GetOutput() else None
    data = reader.GetOutput()
    arrays = {data.GetPointData().GetArrayName(k): vtk_to_numpy(data.GetPointData().GetArray(k)) for k in range(data.GetPointData().GetNumberOfArrays())}
    arrays["x"] = vtk_to_numpy(data.GetPoints().GetData())
    return arrays


def against_history(folder, places, values):
    """Largest difference of locations and pressures of particles 1 and 20 to those in history.h5."""
    worst_x = worst_p = 0
    with h5py.File(os.path.join(folder, "history.h5")) as h5:
        times = h5["global/time"][:]
        for t, file in states(folder, "particles"):
            row = int(numpy.argmin(abs(times - t)))
            if abs(times[row] - t) > 1e-8:
                continue
            data = read(os.path.join(folder, file))
            for number in (1, 20):
                k = int(numpy.nonzero(data["id"] == number)[0][0])
                worst_x = max(worst_x, abs(data["x"][k] - h5[f"particles/{number}/x"][row]).max())
                worst_p = max(worst_p, abs(data["pressure"][k] - h5[f"particles/{number}/p"][row]))
    check(worst_x <= places and worst_p <= values, f"{folder}: places off by {worst_x:.3g} of {places:.3g}, pressures by {worst_p:.3g} of {values:.3g}")


plain = run("plain")
first = read(os.path.join(plain, states(plain, "particles")[-1][1]))
h, p_range = float(first["smoothing_length"][0]), float(first["pressure"].max() - first["pressure"].min())
check(first["x"].dtype == numpy.float32 and first["pressure"].dtype == numpy.float32, "reals are float32")
for name in ("id", "part", "active", "velocity", "pressure", "density", "internal_energy", "smoothing_length", "mass"):
    check(name in first, f"{name} is written without being asked for")
against_history(plain, 1e-7 * max(1, abs(first["x"]).max()), 1e-6 * p_range + 1e-3)

for folder, card in (("stored", "         0        64         0"), ("packed", "         0        64         1         9"), ("xz", "         0        64         2         3")):
    run(folder, "*COURANT_OUTPUT", card)
    against_history(folder, 1e-12, 1e-8)
check(read(os.path.join("xz", states("xz", "particles")[0][1]))["x"].dtype == numpy.float64, "BITS 64 is float64")

small = run("small", "*COURANT_OUTPUT\n         1")
last = read(os.path.join(small, states(small, "particles")[-1][1]))
check(sorted(last) == sorted(["id", "part", "active", "velocity", "density", "pressure", "mass", "smoothing_length", "x"]), f"SMALL writes {sorted(last)}")
spread = max(float(numpy.ptp(read(os.path.join(small, f))["pressure"])) for _, f in states(small, "particles"))
against_history(small, h / 64, 1.05 * spread / 256)
shells = [f for _, f in states(small, "shells")]
check(len(shells) > 2 and set(shells) == {"fields/shells_0000.vtu"}, f"shells that rest are written once: {sorted(set(shells))}")
check("contact_force" not in str(read(os.path.join(small, shells[0]))), "and without forces")

chosen = run("chosen", "*COURANT_OUTPUT", "", "            velocity        acceleration                  id", "*DATABASE_EXTENT_BINARY\n         1")
last = read(os.path.join(chosen, states(chosen, "particles")[-1][1]))
check(set(last) == {"x", "id", "velocity", "acceleration", "sound_speed", "density_rate"}, f"FIELDS and NEIPH choose: {sorted(last)}")
box = run("box", "*DEFINE_BOX\n         9      -9.0       0.3      -9.0       9.0      -9.0       9.0\n*COURANT_OUTPUT\n" + 70 * " " + "         9")
last = read(os.path.join(box, states(box, "particles")[-1][1]))
check(0 < len(last["x"]) < len(first["x"]) and last["x"][:, 0].max() <= 0.3, f"BOXID keeps {len(last['x'])} of {len(first['x'])} particles")
far = run("far", shift=100000)
last = read(os.path.join(far, states(far, "particles")[0][1]))
check(last["x"].dtype == numpy.float64, "far from the origin places are float64")
near = read(os.path.join(plain, states(plain, "particles")[0][1]))
check(abs(last["x"] - near["x"] - [100000, 0, 0]).max() < 1e-6, "and keep their digits")

# --- the timing table adds up, and the summary states what output costs
with open("plain/messag") as file:
    messag = file.read()
table = re.search(r"T i m i n g   i n f o r m a t i o n.*\n((?:  .*\n)+)", messag).group(1)
rows = {m[0].strip(): float(m[1]) for m in re.findall(r"^  (.{38}) *([-\d.]+) +[-\d.]+$", table, re.M)}
total = rows.pop("T o t a l")
check({"keyword reader", "set-up", "output", "neighbours", "rest"} <= set(rows), f"rows of the table: {sorted(rows)}")
with open("plain/summary.yaml") as file:
    summary = file.read()
elapsed = sum(float(re.search(rf"^{key}: (.*)$", summary, re.M).group(1)) for key in ("wall_seconds", "read_seconds"))
check(abs(total - elapsed) <= 0.02 * elapsed + 1e-3 and abs(sum(rows.values()) - total) <= 0.02 * total + 1e-3 * len(rows),
      f"the rows add up to {sum(rows.values()):.3f} s, the total is {total:.3f} s, elapsed {elapsed:.3f} s")
check(rows["rest"] >= -1e-3, f"nothing is counted twice: rest {rows['rest']} s")
size = sum(os.path.getsize(os.path.join("plain", "fields", f)) for f in os.listdir("plain/fields"))
check(int(re.search(r"field_bytes: (\d+)", summary).group(1)) == size, "summary.yaml tells the size of the field files")
check(re.search(r"^ output: \d+ field states", messag, re.M) is not None, "and messag")
check(re.search(r"^ N o r m a l    t e r m i n a t i o n +\d\d/\d\d/\d\d \d\d:\d\d:\d\d$", messag, re.M) is not None, "the banner has its time")

pvbatch = shutil.which("pvbatch")
if pvbatch:
    script = "\n".join(["import zlib", "from paraview.simple import PVDReader", "from paraview import servermanager",
                        "from vtkmodules.util.numpy_support import vtk_to_numpy", "def leaves(d):",
                        "    return [d] if d.IsA('vtkDataSet') else [one for k in range(d.GetNumberOfBlocks()) for one in leaves(d.GetBlock(k))]",
                        "for name in ('plain', 'small', 'xz', 'stored'):",
                        "    r = PVDReader(FileName=name + '/fields.pvd')", "    r.UpdatePipelineInformation()",
                        "    t = list(r.TimestepValues)", "    r.UpdatePipeline(t[-1])", "    data = servermanager.Fetch(r)",
                        "    n = r.GetDataInformation().GetNumberOfPoints()",
                        "    water = next(d for d in leaves(data) if d.GetPointData().HasArray('pressure'))",
                        "    arrays = [water.GetPoints().GetData(), water.GetPointData().GetArray('pressure')]",
                        "    print('read', name, len(t), n, data.GetNumberOfBlocks(), *(zlib.crc32(vtk_to_numpy(a).tobytes()) for a in arrays))"])
    with open("look.py", "w") as file:
        file.write(script)
    done = subprocess.run([pvbatch, "look.py"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
    without_python = "No module named 'paraview'" in done.stdout  # Debian's paraview alone; python3-paraview brings it
    if without_python:
        print("ParaView is here without its Python: it is not asked")
    for name in () if without_python else ("plain", "small", "xz", "stored"):
        found = re.search(rf"read {name} (\d+) (\d+) 2 (\d+) (\d+)", done.stdout)
        last = read(os.path.join(name, states(name, "particles")[-1][1]))
        same = [zlib.crc32(last[array].tobytes()) for array in ("x", "pressure")]
        check(found is not None and int(found.group(1)) == len(states(name, "particles")) and int(found.group(2)) >= len(first["x"]) and
              [int(found.group(3)), int(found.group(4))] == same, f"ParaView opens {name}, with VTK's places and pressures: {found and found.group(0)}")
    check("WARN" not in done.stdout and "ERR" not in done.stdout, f"without a warning: {done.stdout[-500:]}")

    def draws(environment):
        """What the script for ParaView says without a screen, and how many pixels of its picture are in colour left of the colour bar."""
        if os.path.exists("plain.png"):
            os.remove("plain.png")
        environment = environment | {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        drawing = [pvbatch, os.path.join(source, "examples", "results", "paraview_jump.py"), "plain", "plain.png", "--colour", "pressure"]
        said = subprocess.run(drawing, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300, env=environment)
        if not os.path.exists("plain.png"):
            return said, 0
        reader = vtk.vtkPNGReader()
        reader.SetFileName("plain.png")
        reader.Update()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)
        return said, int((numpy.ptp(pixels, axis=1) > 40).reshape(500, 1600)[:, :1000].sum())

    virtual = shutil.which("xvfb-run") and shutil.which("xauth")
    for environment in () if without_python else ({"UNDER_XVFB": "1"}, {}):  # as if the virtual screen did not answer; as it is here
        done, coloured = draws(environment)
        drawn = done.returncode == 0 and 9 * 64 <= coloured <= 25 * 64  # 64 points of 4 x 4 pixels, a row more or less
        in_words = done.returncode == 1 and "apt-get install xvfb xauth" in done.stdout
        check(drawn if virtual and not environment else drawn or in_words,
              f"no screen: ParaView draws ({coloured} pixels in colour) or says what it needs: {done.stdout[-300:]}")
else:
    print("pvbatch is not here: ParaView is not asked")

sys.exit(1 if failures else 0)
