#!/usr/bin/env python3
"""Draws the section of the bar at five times, coloured by plastic strain, from the field files of a run.

usage: picture.py DIR OUT.png     (python3-matplotlib and python3-vtk9)
"""
import sys
import xml.etree.ElementTree as ElementTree

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader  # noqa: E402

FACES = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
TIMES = (0, 0.012, 0.024, 0.04, 0.08)  # ms


def section(file):
    """Faces in the plane z = 0, four points (r, height above the wall) each, and their plastic strain."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(file)
    reader.Update()
    grid = reader.GetOutput()
    x = vtk_to_numpy(grid.GetPoints().GetData())
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 8)
    strain = vtk_to_numpy(grid.GetCellData().GetArray("plastic_strain"))
    found = [(x[cell[list(face)], :2], value) for cell, value in zip(cells, strain) for face in FACES
             if (abs(x[cell[list(face)], 2]) < 1e-9).all()]
    return [points for points, _ in found], numpy.array([value for _, value in found])


folder, out = sys.argv[1:3]
states = [(float(state.get("timestep")), state.get("file")) for state in ElementTree.parse(f"{folder}/fields.pvd").iter("DataSet")]
figure, axes = plt.subplots(1, len(TIMES), figsize=(9, 4), sharey=True, layout="constrained")
for ax, wanted in zip(axes, TIMES):
    time, file = min(states, key=lambda state: abs(state[0] - wanted))
    polygons, strain = section(f"{folder}/{file}")
    for side in (1, -1):  # the deck holds one quarter of the bar
        faces = PolyCollection([points * (side, 1) for points in polygons], array=strain, cmap="viridis", edgecolors="0.5", linewidths=0.15)
        faces.set_clim(0, 2)
        ax.add_collection(faces)
    ax.axhline(0, color="black", linewidth=1)
    ax.set(xlim=(-8, 8), ylim=(-1, 34), aspect="equal", title=f"{1000 * time:.0f} µs", xlabel="r, mm")
axes[0].set_ylabel("mm above the wall")
figure.colorbar(faces, ax=axes, label="plastic strain", extend="max", shrink=0.8)
figure.savefig(out, dpi=100)
