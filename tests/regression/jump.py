#!/usr/bin/env python3
"""The committed hydraulic-jump deck, from the command line as a user runs it: 5 s, then `courant post`.

usage: jump.py COURANT SOURCE_DIR WORK_DIR
Bounds: A and P of the depth at x = 1 m over 2.5-5 s against Belanger, arrival of the wave at the weir, no leak, small
penetration, a closed energy ledger, files that VTK opens with the same values as history.h5.
"""
import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import h5py
import numpy
import yaml

from checks import check, failures

courant, source, work = sys.argv[1:4]
scene = os.path.join(source, "keyword_decks", "hydraulic_jump")
results = os.path.join(work, "jump")


def call(*words):
    print("$", " ".join(words), flush=True)
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        print(done.stdout[-4000:])
        sys.exit(f"{words[1]} ended with exit code {done.returncode}")
    return done.stdout


call(courant, "run", os.path.join(scene, "d4_5s.k"), "-o", results, "--quiet")
print(call(courant, "post", os.path.join(scene, "post.yaml"), results))

summary = yaml.safe_load(open(os.path.join(results, "summary.yaml")))
energy = summary["energy"]
spacing = 0.005
check(summary["termination"] == "normal", f"termination {summary['termination']}")
check(summary["time"] >= 5, f"time {summary['time']}")
check(summary["leaked_particles"] == 0, f"leaked particles {summary['leaked_particles']}")
check(summary["max_penetration"] < 0.1 * spacing, f"largest penetration {summary['max_penetration'] / spacing:.4f} of the spacing, bound 0.1")
residual = abs(energy["residual"]) / energy["throughput"]
check(residual < 0.01, f"energy residual {100 * residual:.3f} % of the energy that passed through, bound 1 %")

found = yaml.safe_load(open(os.path.join(results, "results.yaml")))
interval = found["jump"]["intervals"][0]
check(0.92 <= interval["A"] <= 1.05, f"A = {interval['A']:.4f} over 2.5-5 s, bounds 0.92 to 1.05")
check(interval["P"] <= 0.10, f"P = {interval['P']:.4f} over 2.5-5 s, bound 0.10")
turn = found["jump"]["turn"]
check(1.5 <= turn["time"] <= 2.5, f"the jump has moved to the weir and turns at {turn['time']:.3f} s, toe at {turn['x']:.3f} m, bounds 1.5 to 2.5 s")
first = found["jump"]["front"]["time"]
check(0.5 <= first <= 1.0, f"the first wave is at the weir at {first:.3f} s; the paper's depth at 1 m rises from 0.8 s")

history = h5py.File(os.path.join(results, "history.h5"))
time = history["global/time"][:]
check(abs(time[-1] - 5) < 0.02 and numpy.all(numpy.diff(time) > 0), f"history.h5 ends at {time[-1]:.4f} s with rising times")
check(abs(history["global/kinetic"][-1] - energy["kinetic"]) < 1e-9 * energy["kinetic"], "history.h5 and summary.yaml agree on kinetic energy")

states = [(float(d.get("timestep")), d.get("file")) for d in ElementTree.parse(os.path.join(results, "fields.pvd")).iter("DataSet")]
check(len({t for t, _ in states}) >= 500, f"{len({t for t, _ in states})} states in fields.pvd")
try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    print("skipped: VTK's Python is not here")
else:
    last = [f for t, f in states if f.endswith(".vtp")][-1]
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(results, last))
    reader.Update()
    points = reader.GetOutput().GetPointData()
    fields = {points.GetArrayName(i): vtk_to_numpy(points.GetArray(i)) for i in range(points.GetNumberOfArrays())}
    check({"velocity", "pressure", "density"} <= fields.keys(), f"fields {sorted(fields)}")
    check(reader.GetOutput().GetNumberOfPoints() == summary["active_particles"], "as many points as active particles (ISHOW 1)")
    mass = 1000 * spacing**2
    kinetic = 0.5 * mass * (fields["velocity"].astype(float) ** 2).sum()
    check(abs(kinetic / energy["kinetic"] - 1) < 1e-5, f"kinetic energy from the field file {kinetic:.6g}, from the ledger {energy['kinetic']:.6g}")
    walls = [f for t, f in states if f.endswith(".vtu")][-1]
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(os.path.join(results, walls))
    reader.Update()
    check(reader.GetOutput().GetNumberOfCells() == 1039, f"{reader.GetOutput().GetNumberOfCells()} shells")

sys.exit(1 if failures else 0)
