"""Cells of mesh files: STL, PLY, VTK by VTK, OBJ here, others by meshio and, where it fails, by Gmsh."""
from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ..files import note_input
from ..optional import MissingModule, module
from .groups import Block, Cells, cells_of, read_obj, tidied
from .mesh_objects import cells_of_vtk
from .shapes import ShapeFault

_READERS = {".stl": ("vtkIOGeometry", "vtkSTLReader"), ".ply": ("vtkIOPLY", "vtkPLYReader"), ".vtp": ("vtkIOXML", "vtkXMLPolyDataReader"),
            ".vtu": ("vtkIOXML", "vtkXMLUnstructuredGridReader"), ".vtk": ("vtkIOLegacy", "vtkDataSetReader"), ".vts": ("vtkIOXML", "vtkXMLStructuredGridReader")}
_OF_MESHIO = (".msh", ".vtk", ".vtu", ".inp", ".med", ".off", ".bdf", ".nas", ".mesh", ".su2", ".xdmf")
_OF_GMSH = (".msh", ".unv", ".bdf", ".nas", ".mesh", ".off", ".inp", ".su2")
MESH_FILES = tuple(dict.fromkeys((*_READERS, ".obj", *_OF_MESHIO, *_OF_GMSH)))
WITHOUT_GROUPS = (".stl", ".ply", ".vtp", ".vts")
# numbers of element types of Gmsh by their names here
_GMSH_TYPES = {1: "line", 2: "triangle", 3: "quad", 4: "tetra", 5: "hexahedron", 6: "wedge", 7: "pyramid", 8: "line3", 9: "triangle6", 10: "quad9", 11: "tetra10",
               12: "hexahedron27", 13: "wedge18", 14: "pyramid14", 15: "vertex", 16: "quad8", 17: "hexahedron20", 18: "wedge15", 19: "pyramid13"}


def check_file(path: Path, known: tuple[str, ...], group: str, without: tuple[str, ...]) -> str:
    """The end of the name of a file that is there and that is read here, and that may have a `group`, if one is named. Raises ShapeFault."""
    end = path.suffix.lower()
    if end not in known:
        raise ShapeFault(f"'{path}': files that end with '{end}' are not read here", f"known: {', '.join(known)}")
    if not os.path.isfile(path):
        raise ShapeFault(f"'{path}' is not there", "paths of a scene begin at its folder")
    if group and end in without:
        raise ShapeFault(f"group: files that end with '{end}' have none", "OBJ, and meshes of Gmsh, Abaqus and others, have groups")
    return end


def read_cells(path: Path, group: str = "") -> Cells:
    """All cells of a file with their groups, among which may be one that is asked for. Raises ShapeFault."""
    end = check_file(path, MESH_FILES, group, WITHOUT_GROUPS)
    note_input(path)
    try:
        if end == ".obj":
            return tidied(read_obj(path))
        with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:  # libraries print what they find
            mesh = _read(path, end, lambda: f"{out.getvalue()} {err.getvalue()}")
        return tidied(mesh)
    except MissingModule as fault:
        raise ShapeFault(str(fault)) from None
    except ShapeFault:
        raise
    except (Exception, SystemExit) as fault:  # libraries announce faults of files in many ways
        raise ShapeFault(f"'{path}' cannot be read: {' '.join(str(fault).split())[:200]}") from None


def _read(path: Path, end: str, printed: Any) -> Cells:
    """By the first library that reads it; the fault of the first one that is there."""
    faults: list[str] = []
    missing: list[MissingModule] = []
    for read, ends in ((_by_vtk, _READERS), (_by_meshio, _OF_MESHIO), (_by_gmsh, _OF_GMSH)):
        if end not in ends:
            continue
        try:
            mesh = read(path)
            if len(mesh.cells):
                return mesh
            faults.append("it holds no cells")
        except MissingModule as fault:
            missing.append(fault)
        except (Exception, SystemExit) as fault:
            faults.append(printed() if isinstance(fault, SystemExit) else str(fault))
    if not faults:
        raise missing[0]
    known = [part.strip() for part in faults if part.strip()]
    hint = "is it whole, and of the format of its name?"
    if end in _OF_GMSH and missing:
        hint = f"Gmsh may read it ({str(missing[-1]).rpartition(': ')[2]}); of .msh, versions 2.2 and 4.1 are read without it"
    raise ShapeFault(f"'{path}' cannot be read: {' '.join((known or ['it is damaged'])[0].split())[:200]}", hint)


def _by_vtk(path: Path) -> Cells:
    home, name = _READERS[path.suffix.lower()]
    reader = getattr(module(f"vtkmodules.{home}"), name)()
    module("vtkmodules.vtkCommonCore").vtkObject.GlobalWarningDisplayOff()
    reader.SetFileName(str(path))
    reader.Update()
    if reader.GetErrorCode():
        raise ValueError(module("vtkmodules.vtkCommonCore").vtkErrorCode.GetStringFromErrorCode(reader.GetErrorCode()))
    return cells_of_vtk(reader.GetOutput())


def _by_meshio(path: Path) -> Cells:
    return cells_of(module("meshio").read(path))


@contextlib.contextmanager
def gmsh_model(name: str) -> Iterator[Any]:
    """Gmsh with an empty model, which is gone afterwards; what the script of a user has in Gmsh stays as it is. Raises MissingModule."""
    gmsh = module("gmsh")
    own = not gmsh.isInitialized()
    before = "" if own else gmsh.model.getCurrent()
    if own:
        gmsh.initialize(interruptible=False)
    names = ("General.Terminal", "General.NumThreads", "Mesh.MeshSizeExtendFromBoundary", "Mesh.MeshSizeMin", "Mesh.MeshSizeMax")
    options = {} if own else {one: gmsh.option.getNumber(one) for one in names}
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.NumThreads", 1)  # the same mesh each time
        gmsh.model.add(name)
        yield gmsh
    finally:
        if own:
            gmsh.finalize()
        else:
            gmsh.model.setCurrent(name)
            gmsh.model.remove()
            gmsh.model.setCurrent(before)
            for one, value in options.items():
                gmsh.option.setNumber(one, value)


def _by_gmsh(path: Path) -> Cells:
    with gmsh_model("courant file") as gmsh:
        gmsh.merge(str(path))
        return cells_of_gmsh(gmsh.model)


def cells_of_gmsh(model: Any) -> Cells:
    """The mesh of the current model of Gmsh, with its physical groups by name, or by number where they have none."""
    tags, points, _ = model.mesh.getNodes()
    row = np.zeros(int(tags.max()) + 1 if len(tags) else 1, dtype=int)
    row[tags.astype(int)] = np.arange(len(tags))
    blocks: list[Block] = []
    owner: list[tuple[int, int]] = []  # the entity of each block
    for dim, entity in model.getEntities():
        for kind, _, nodes in zip(*model.mesh.getElements(dim, entity)):
            if kind not in _GMSH_TYPES:
                raise ValueError(f"elements '{model.mesh.getElementProperties(kind)[0]}' are not known here")
            corners = int(model.mesh.getElementProperties(kind)[3])
            blocks.append(Block(_GMSH_TYPES[kind], row[np.asarray(nodes, dtype=int)].reshape(-1, corners)))
            owner.append((dim, entity))
    groups: dict[str, list[np.ndarray]] = {}
    for dim, tag in model.getPhysicalGroups():
        members = {(dim, int(entity)) for entity in model.getEntitiesForPhysicalGroup(dim, tag)}
        name = model.getPhysicalName(dim, tag) or str(tag)
        new = [np.arange(len(block.data) if entity in members else 0) for block, entity in zip(blocks, owner)]
        groups[name] = [np.concatenate(both) for both in zip(groups[name], new)] if name in groups else new
    return Cells(np.asarray(points, dtype=float).reshape(-1, 3), blocks, groups)
