"""Meshes of Gmsh, PyVista, meshio and trimesh as geometry of scenes, of real files where these libraries are there."""
from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import courant
import numpy as np
import pytest
from courant.scene.groups import Block, Cells, tidied
from courant.scene.shapes import ShapeFault
from courant.scene.surfaces import shape_of, sound, surface_of

pytest.importorskip("vtkmodules", reason="python3-vtk9 is missing")
CUBE = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
SIDES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


def part(shape: Any, **keys: Any) -> courant.Scene:
    return courant.Scene("part", end=0.1).structure(shape, material="steel", **keys)


def said(scene: courant.Scene) -> str:
    with pytest.raises(courant.CourantError) as fault:
        scene.deck()
    return str(fault.value).partition("error: ")[2]


def test_faces_that_are_not_convex_are_split_within_themselves() -> None:
    """A dart, all four corners as the first one, a polygon with a notch, and a quadrangle with a corner twice: the area of each is its own."""
    x = np.array([[0, 0, 0], [4, 0, 0], [1, 1, 0], [0, 4, 0], [4, 4, 0], [2, 1, 0]], dtype=float)
    for turn in range(4):
        made = tidied(Cells(x, [Block("quad", np.roll([[0, 1, 2, 3]], turn, axis=1))]))
        a, b, c = (x[made.cells[0].data[:, k]] for k in range(3))
        assert np.cross(b - a, c - a)[:, 2].sum() / 2 == pytest.approx(4) and (np.cross(b - a, c - a)[:, 2] > 0).all() and "not convex" in made.notes[0]
    notch = tidied(Cells(x, [Block("polygon5", np.array([[0, 5, 1, 4, 3]]))]))
    assert sum(len(block.data) for block in notch.cells) == 3
    twice = tidied(Cells(x, [Block("quad", np.array([[0, 1, 3, 3], [0, 0, 1, 1]]))], {"one": [np.array([0])]}))
    assert twice.cells[0].type == "triangle" and "1 faces with less than three corners left out" in twice.notes and len(twice.groups["one"][0]) == 1
    with pytest.raises(ShapeFault, match="cross each other"):
        tidied(Cells(x, [Block("quad", np.array([[0, 1, 3, 4]]))]))


def test_elements_of_higher_order_and_unknown_cells() -> None:
    made = tidied(Cells(CUBE, [Block("triangle6", np.array([[0, 1, 2, 3, 4, 5]])), Block("polyhedron6", np.zeros((2, 6), dtype=int))]))
    assert made.cells[0].data.tolist() == [[0, 1, 2]] and len(made.cells) == 1
    assert made.notes == ["2 cells of type polyhedron6 left out", "1 elements of higher order taken by their corners, with straight sides"]
    with pytest.raises(ShapeFault, match="lines in space alone"):
        surface_of(Cells(CUBE, [Block("line", np.array([[0, 1], [1, 7]]))]))


def test_data_sets_of_vtk_are_elements_or_surfaces() -> None:
    """Voxels, hexahedra of a structured grid, a composite of both, and a surface of quadrangles and strips."""
    vtk, common, sources = (pytest.importorskip(f"vtkmodules.{name}") for name in ("vtkCommonDataModel", "vtkCommonCore", "vtkFiltersSources"))
    image = vtk.vtkImageData()
    image.SetDimensions(3, 4, 5)
    assert sound(shape_of(image), True, False).volume() == pytest.approx(2 * 3 * 4)
    assert "24 solids" in part(image, fix="bottom").deck()
    block = vtk.vtkMultiBlockDataSet()
    other = vtk.vtkImageData()
    other.SetDimensions(2, 2, 2)
    other.SetOrigin(10, 0, 0)
    for k, one in enumerate((image, other)):
        block.SetBlock(k, one)
    assert "25 solids" in part(block, fix="bottom").deck()
    cube = sources.vtkCubeSource()
    cube.Update()
    assert "6 shells" in part(cube.GetOutput(), thickness=0.01, fix="bottom").deck()  # which have vertices of their own
    points = common.vtkPoints()
    for x in CUBE:
        points.InsertNextPoint(x)
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.InsertNextCell(15, 10, list(range(8)) + [0, 1])  # a pentagonal prism
    assert "cells of type 15 of VTK are not known here" in said(part(grid))
    assert "expected solids, triangles or quadrangles, got cells of type none" in said(part(vtk.vtkPolyData()))


def test_arrays_and_objects_with_faces() -> None:
    quads = np.array(SIDES)
    assert sound(shape_of((CUBE, quads)), True, False).volume() == pytest.approx(1)
    with pytest.raises(ShapeFault, match="from 0 to 7, and there are -1 to 7"):
        shape_of((CUBE, np.array([[0, 1, -1], [0, 1, 7]])))

    class Trimesh:
        vertices, faces = CUBE, np.array([[a, b, c] for s in SIDES for a, b, c in (s[:3], (s[0], s[2], s[3]))])

    class Scene:
        geometry: dict[str, Any] = {}

        def dump(self) -> list[Any]:
            moved = type("Moved", (), {"vertices": CUBE + [3, 0, 0], "faces": Trimesh.faces})
            return [Trimesh, moved, object()]

    assert sound(shape_of(Trimesh()), True, False).volume() == pytest.approx(1)
    assert sound(shape_of(Scene()), True, False).volume() == pytest.approx(2)
    assert "12 shells" in part(Trimesh(), thickness=0.01, fix="bottom").deck()
    assert "mesh: expected a mesh of PyVista" in said(part(object()))


def test_shells_of_faces_with_vertices_of_their_own_are_joined(tmp_path: Path) -> None:
    corners = [CUBE[k] for s in SIDES for k in (*s[:3], s[0], s[2], s[3])]
    text = "".join(f"facet normal 0 0 0\nouter loop\n{''.join(f'vertex {x} {y} {z}{chr(10)}' for x, y, z in corners[k : k + 3])}endloop\nendfacet\n" for k in range(0, 36, 3))
    (tmp_path / "a.stl").write_text(f"solid a\n{text}endsolid a\n")
    deck = part(tmp_path / "a.stl", thickness=0.01, fix="bottom").deck()
    assert "12 shells" in deck and deck.partition("*NODE\n")[2].partition("*")[0].count("\n") == 1 + 8


def test_files_that_are_damaged_or_of_another_kind(tmp_path: Path) -> None:
    for name in ("a.stl", "a.vtu", "a.msh", "a.ply", "a.vtk"):
        (tmp_path / name).write_bytes(b"nothing of that kind\x00\xff")
        assert "cannot be read" in (text := said(part(tmp_path / name))) or "holds no" in text or "meshio" in text, name
    assert "files that end with '.step' are not read here" in said(part(tmp_path / "a.step"))
    assert "is not there" in said(part(tmp_path / "b.msh"))


@pytest.mark.parametrize(("version", "binary", "order"), itertools.chain(itertools.product((2.2, 4.1), (0, 1), (1, 2)), [(4.0, 0, 1)]))
def test_files_of_gmsh(version: float, binary: int, order: int, tmp_path: Path) -> None:
    gmsh = pytest.importorskip("gmsh", reason="gmsh is missing")
    pytest.importorskip("meshio", reason="meshio is missing")
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        face = gmsh.model.occ.addRectangle(0, 0, 0, 0.2, 0.2)
        gmsh.model.occ.extrude([(2, face)], 0, 0, 0.3, numElements=[3], recombine=True)  # prisms
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(3, [1], name="block")
        gmsh.model.addPhysicalGroup(2, [face], name="foot")
        gmsh.model.addPhysicalGroup(1, [1, 2], tag=7)
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.1)
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(order)
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        gmsh.write(str(tmp_path / "a.msh"))
        in_memory = part(gmsh.model, group="block", fix="foot").deck()
        assert gmsh.model.getCurrent() == ""  # and the mesh of the user remains
        assert len(gmsh.model.mesh.getElements(3)[1][0]) > 3
    finally:
        gmsh.finalize()
    deck = part(tmp_path / "a.msh", group="block", fix="foot").deck()
    assert sum(line.startswith("$   201 a:") for line in deck.splitlines()) == 1
    for keyword in ("*BOUNDARY_SPC_NODE", "*ELEMENT_SOLID"):
        assert deck.partition(keyword)[2].partition("*")[0].count("\n") == in_memory.partition(keyword)[2].partition("*")[0].count("\n") > 5
    assert "beams" in part(tmp_path / "a.msh", group="7", section={"rod": 0.01}, fix="left").deck()
    assert "group: the mesh has no group 'blok'\n  hint: did you mean block?" in said(part(tmp_path / "a.msh", group="blok"))


def test_objects_of_pyvista_and_trimesh() -> None:
    pyvista, trimesh = (pytest.importorskip(name, reason=f"{name} is missing") for name in ("pyvista", "trimesh"))
    grid = pyvista.ImageData(dimensions=(3, 3, 3)).cast_to_unstructured_grid()
    assert "8 solids" in part(grid, fix="bottom").deck() and "8 solids" in part(pyvista.MultiBlock([grid]), fix="bottom").deck()
    assert sound(shape_of(pyvista.Sphere()), True, False).volume() == pytest.approx(0.52, rel=0.02)
    assert "shells" in part(pyvista.Plane(), thickness=0.01, fix="left").deck()
    assert sound(shape_of(trimesh.creation.box()), True, False).volume() == pytest.approx(1)
    assert "beams" in part(pyvista.Line(), section={"rod": 0.01}, fix="left").deck()
