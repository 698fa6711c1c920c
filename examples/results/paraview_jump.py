#!/usr/bin/env pvbatch
"""Draws a run in ParaView: particles coloured by speed or pressure, walls, time, a fixed camera.

    pvbatch paraview_jump.py RESULTS [PICTURE.png] [--colour velocity|pressure|density] [--time T] [--movie FOLDER]

Without a screen the script starts itself again on a virtual one, if xvfb-run is there (Debian: xvfb, xauth). In ParaView's
window: Tools > Python Shell > Run Script, after setting RESULTS in the environment (not `paraview --script`, which runs it
before there is a window to draw in: an empty picture). Works with ParaView 5.11 (Debian 12).
"""
import argparse
import ctypes
import os
import shutil
import subprocess
import sys

try:
    from paraview import servermanager
except ImportError:
    sys.exit("ParaView's Python is missing: apt-get install python3-paraview (in place of python3-vtk9, which cannot stand beside it), then "
             "pvbatch paraview_jump.py ...")
from paraview.simple import (_DisableFirstRenderCameraReset, AnnotateTimeFilter, ColorBy, CreateRenderView, GetAnimationScene, GetColorTransferFunction,
                             GetScalarBar, PVDReader, ExtractBlock, Render, SaveAnimation, SaveScreenshot, Show, UpdatePipeline)

from vtkmodules.vtkRenderingCore import vtkRenderWindow

UNITS = {"velocity": "m/s", "pressure": "Pa", "density": "kg/m3"}  # of the jump's deck


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="?", default=os.environ.get("RESULTS", "."), help="folder with fields.pvd")
    parser.add_argument("picture", nargs="?", default="jump.png")
    parser.add_argument("--colour", default="velocity", choices=sorted(UNITS))
    parser.add_argument("--time", type=float, help="the last state if not given")
    parser.add_argument("--range", type=float, nargs=2, help="of the colours; that of the state shown if not given")
    parser.add_argument("--window", type=float, nargs=4, metavar=("X0", "X1", "Y0", "Y1"), help="what the camera sees")
    parser.add_argument("--movie", help="folder for one picture per state")
    return parser.parse_args()


def find_screen():
    """Ends the script in words, or starts it again on a virtual screen, where this ParaView can draw on an X server only, and none answers: it would abort.

    Debian's is of this kind (--force-offscreen-rendering only hides its window); others bring EGL or OSMesa. The connection is left open: Xvfb without
    -noreset starts again when its last client leaves, and turns away ParaView, which looks at what the server can and then comes a second time.
    """
    if vtkRenderWindow().GetClassName() != "vtkXOpenGLRenderWindow":
        return
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    if x11.XOpenDisplay(None):
        return
    if "UNDER_XVFB" in os.environ or not (shutil.which("xvfb-run") and shutil.which("xauth")):
        display = os.environ.get("DISPLAY")
        sys.exit(f"There is no screen to draw on ({f'DISPLAY {display} does not answer' if display else 'DISPLAY is not set'}), which this ParaView needs. Log in "
                 "with one (ssh -X), or install a virtual one, which this script then starts by itself: apt-get install xvfb xauth")
    again = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", os.readlink("/proc/self/exe"), *sys.argv]
    sys.exit(subprocess.run(again, env=os.environ | {"UNDER_XVFB": "1"}).returncode)


def part_of(reader, name, time):
    """The particles or the shells: fields.pvd names its parts. Without shells the particles are all there is."""
    if not servermanager.Fetch(reader).IsA("vtkMultiBlockDataSet"):
        return reader if name == "particles" else None
    one = ExtractBlock(Input=reader, Selectors=[f"/Root/{name}"])
    UpdatePipeline(time=time, proxy=one)
    return one if one.GetDataInformation().GetNumberOfPoints() > 0 else None


def main():
    wanted = arguments()
    find_screen()
    reader = PVDReader(FileName=os.path.join(wanted.results, "fields.pvd"))
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    if not times:
        sys.exit(f"no states in {wanted.results}/fields.pvd")
    time = min(times, key=lambda t: abs(t - wanted.time)) if wanted.time is not None else times[-1]
    UpdatePipeline(time=time, proxy=reader)

    _DisableFirstRenderCameraReset()
    view = CreateRenderView()
    view.ViewSize = [1600, 500]
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    view.ViewTime = time

    particles = part_of(reader, "particles", time)
    if not particles or particles.GetDataInformation().GetNumberOfPoints() == 0:
        sys.exit(f"ParaView read no particles at t = {time:g}; what it says above tells why. That of Debian 12 (5.11.0) reads no raw data beside libexpat1 "
                 "2.5.0-1+deb12u2 and later: take a newer one from paraview.org")
    water = Show(particles, view)
    water.Representation = "Points"
    water.PointSize = 4
    ColorBy(water, ("POINTS", wanted.colour, "Magnitude") if wanted.colour == "velocity" else ("POINTS", wanted.colour))
    colours = GetColorTransferFunction(wanted.colour)
    colours.ApplyPreset("Viridis (matplotlib)", True)
    if wanted.range:
        colours.RescaleTransferFunction(*wanted.range)
    else:
        water.RescaleTransferFunctionToDataRange(False)
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = f"{'speed' if wanted.colour == 'velocity' else wanted.colour} [{UNITS[wanted.colour]}]", ""
    bar.Orientation, bar.WindowLocation = "Horizontal", "Upper Right Corner"
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    water.SetScalarBarVisibility(view, True)

    shells = part_of(reader, "shells", time)
    if shells:
        walls = Show(shells, view)
        walls.Representation = "Wireframe"
        walls.AmbientColor = walls.DiffuseColor = [0.3, 0.3, 0.3]
        walls.ColorArrayName = [None, ""]

    clock = Show(AnnotateTimeFilter(Input=reader, Format="t = {time:.2f}"), view)
    clock.Color, clock.FontSize, clock.WindowLocation = [0, 0, 0], 18, "Upper Left Corner"

    x0, x1, y0, y1 = wanted.window or window_of(particles)
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [(x0 + x1) / 2, (y0 + y1) / 2, 0]
    view.CameraPosition = [(x0 + x1) / 2, (y0 + y1) / 2, 10 * max(x1 - x0, y1 - y0)]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = max((x1 - x0) / 2 * view.ViewSize[1] / view.ViewSize[0], (y1 - y0) / 2)
    Render(view)
    SaveScreenshot(wanted.picture, view, ImageResolution=list(view.ViewSize))
    print(f"{wanted.picture}: t = {time:g}, one of {len(times)} states")
    if wanted.movie:
        os.makedirs(wanted.movie, exist_ok=True)
        scene = GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        SaveAnimation(os.path.join(wanted.movie, "jump.png"), view, ImageResolution=list(view.ViewSize))


def window_of(particles):
    x0, x1, y0, y1, _, _ = particles.GetDataInformation().GetBounds()
    return x0 - 0.02 * (x1 - x0), x1 + 0.02 * (x1 - x0), y0 - 0.5 * (y1 - y0), y1 + 1.0 * (y1 - y0)


main()
