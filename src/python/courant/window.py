"""A window of PyVista with one state: particles as spheres, coloured by a field, and the elements beside them."""
from __future__ import annotations

from os import PathLike, fspath
from typing import Any

import numpy as np

from .optional import module
from .post.view_fields import shells_that_deform


def show(state: Any, field: str = "speed", file: str | PathLike[str] | None = None) -> Any:
    """Opens the window and waits until it is closed; with `file` it draws off the screen into that picture. `field`: of the particles, "pressure".
    Gives the plotter. Raises MissingModule; KeyError with the names there are."""
    pyvista = module("pyvista")
    plotter = pyvista.Plotter(off_screen=file is not None)
    particles = state.particles
    shown = np.asarray(particles[field]) if particles is not None and len(particles) else np.empty(0)
    flat = len(shown) > 0 and not np.ptp(particles.points[:, 2])
    if len(shown):
        on = np.asarray(particles["active"]) > 0 if "active" in particles.names else np.ones(len(shown), dtype=bool)
        cloud = pyvista.PolyData(np.asarray(particles.points)[on])
        cloud[field] = shown[on]
        volume = float(np.median(particles["mass"] / particles["density"]))
        size = np.sqrt(volume) if flat else np.cbrt(volume)
        ball = pyvista.Sphere(radius=0.56 * float(size), theta_resolution=10, phi_resolution=10)
        plotter.add_mesh(cloud.glyph(geom=ball, scale=False, orient=False), scalars=field, cmap="viridis")
    for mesh in state.elements:
        rigid = ~shells_that_deform(mesh) & ("solids" not in mesh.path.name)
        for some, opacity in ((rigid, 0.25), (~rigid, 1.0)):
            if some.any():
                plotter.add_mesh(mesh.pyvista().extract_cells(np.flatnonzero(some)), color="lightgrey", opacity=opacity, show_edges=opacity == 1.0)
    plotter.add_axes()
    if flat:
        plotter.view_xy()
    if file is None:
        plotter.show()
    else:
        plotter.screenshot(fspath(file))
    return plotter
