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

# the analyses and figures of the paper, over what this short run has of a settled state
recipe = open(os.path.join(scene, "paper_figures.yaml")).read()
for long, short in (("&from 15", "&from 3.5"), ("&to 30", "&to 5"), ("&moment 29.995", "&moment 4.995"), ("segment: 5", "segment: 0.75")):
    check(recipe.count(long) == 1, f"paper_figures.yaml has '{long}' once")
    recipe = recipe.replace(long, short)
open(os.path.join(work, "short.yaml"), "w").write(recipe)
print(call(courant, "post", os.path.join(work, "short.yaml"), results))
tables = h5py.File(os.path.join(results, "paper", "tables.h5"))
mass = tables["fluxes_mean/mass_mean"][:]
unit = tables["fluxes_mean/mass_mean"].attrs["unit"]
check(unit in (b"kg/(m s)", "kg/(m s)"), f"unit of the mass flux {unit}")
inflow = 1000 * 1.5 * 0.02
# x = 0.05 to 0.15 m: the jet is undisturbed there, since the toe is at 0.22 m at the end
check(numpy.all(numpy.abs(mass[:3] / inflow - 1) < 0.01), f"mass flux of the jet {mass[:3] / inflow} of the inflow's, bound 1 %")
kinetic = tables["fluxes_mean/kinetic_mean"][:] + tables["fluxes_mean/potential_mean"][:]
check(kinetic[-1] < 0.9 * kinetic[0], f"kinetic and potential energy flux falls through the jump: {kinetic[0]:.2f} to {kinetic[-1]:.2f} W/m")
depth = yaml.safe_load(open(os.path.join(results, "results.yaml")))["analyses"]["depth"]["depth_mean"]
theirs = interval["mean_depth"]
check(abs(float(depth["value"]) / theirs - 1) < 0.03 and depth["unit"] == "m", f"mean depth {depth['value']} m by the surface without spray, {theirs} m by the first surface over 2.5-5 s")
names = [line.split("name: ")[1].strip() for line in recipe.splitlines() if line.startswith("  - name: ")]
for name in names:
    size = [os.path.getsize(os.path.join(results, "paper", f"{name}.{ending}")) for ending in ("png", "svg")]
    check(min(size) > 5000, f"{name}: {size[0]} and {size[1]} bytes")
try:
    import vtk
except ImportError:
    pass
else:
    reader = vtk.vtkXMLImageDataReader()
    reader.SetFileName(os.path.join(results, "paper", "field.vti"))
    reader.Update()
    u = reader.GetOutput().GetPointData().GetArray("vx_mean")
    check(u is not None and u.GetNumberOfTuples() == 221 * 56, "field.vti opens in VTK with the mean velocity on 221 x 56 points")

sys.exit(1 if failures else 0)
