"""Solids within a closed surface, by Gmsh."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..optional import MissingModule
from .mesh_files import gmsh_model
from .meshes import Mesh
from .shapes import Shape
from .surfaces import ShapeFault

_SHARP = math.radians(40)  # edges of the geometry, between faces that turn by more


def tetrahedra(shape: Shape, size: float) -> Mesh:
    """Tetrahedra of four nodes with sides up to about `size` [L]. Raises MissingModule, ShapeFault."""
    try:
        with gmsh_model("courant surface") as gmsh:
            tags, points, corners = _filled(gmsh, shape, size)
    except MissingModule:
        raise
    except Exception as fault:  # gmsh raises plain ones
        raise ShapeFault(f"Gmsh finds no mesh within the surface: {' '.join(str(fault).split())[:200]}",
                         "repair the surface, or mesh it in Gmsh's window") from None
    if not len(corners):
        raise ShapeFault("Gmsh made no tetrahedra within the surface", "another 'size', or mesh it in Gmsh's window")
    row = np.zeros(int(tags.max()) + 1, dtype=int)
    row[tags.astype(int)] = np.arange(len(tags))
    cells = row[corners.astype(int)].reshape(-1, 4)
    used, numbers = np.unique(cells, return_inverse=True)
    return Mesh(points.reshape(-1, 3)[used], numbers.reshape(-1, 4)[:, [0, 1, 2, 3, 3, 3, 3, 3]])


def _filled(gmsh: Any, shape: Shape, size: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Numbers and positions of the nodes, and the corners of the tetrahedra."""
    surface = gmsh.model.addDiscreteEntity(2)
    ids = np.arange(1, len(shape.points) + 1)
    gmsh.model.mesh.addNodes(2, surface, ids, shape.points.ravel())
    gmsh.model.mesh.addElementsByType(surface, 2, [], (shape.faces + 1).ravel())
    gmsh.model.mesh.classifySurfaces(_SHARP, True, True, math.pi)
    gmsh.model.mesh.createGeometry()
    loop = gmsh.model.geo.addSurfaceLoop([tag for _, tag in gmsh.model.getEntities(2)])
    gmsh.model.geo.addVolume([loop])
    gmsh.model.geo.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size / 3)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.model.mesh.generate(3)
    tags, points, _ = gmsh.model.mesh.getNodes()
    _, corners = gmsh.model.mesh.getElementsByType(4)
    return tags, points, corners
