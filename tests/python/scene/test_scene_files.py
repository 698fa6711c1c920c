"""Files that scenes take: groups of meshes, OBJ, DXF, CSV, curves of motions; and checks of sizes, units and positions."""
from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import courant
import numpy as np
import pytest
from courant.scene.groups import cells_of, read_obj
from courant.scene.outlines import read_outline, two_columns
from courant.scene.polygons import triangulated
from courant.scene.shapes import Shape, ShapeFault, box
from courant.scene.structure_checks import _points_on
from courant.scene.surfaces import read_shape, shape_of, sound

from .house import FACES, stl
from .made import written


def space(**keys: Any) -> courant.Scene:
    made = courant.Scene("space", **({"spacing": 0.05, "end": 0.1} | keys))
    return made.water(low=(0, 0, 0), high=(1, 0.5, 0.2)).box(low=(0, 0, 0), high=(1, 0.5, 0.6), open="top")


def plane(**keys: Any) -> courant.Scene:
    made = courant.Scene("plane", **({"spacing": 0.02, "end": 0.5} | keys))
    return made.water(low=(0, 0), high=(0.4, 0.2)).box(low=(0, 0), high=(2, 0.5), open=["top"])


def said(scene: courant.Scene) -> str:
    with pytest.raises(courant.CourantError) as fault:
        scene.deck()
    return str(fault.value)


def warnings(scene: courant.Scene, folder: Path, capsys: pytest.CaptureFixture[str]) -> str:
    scene.write(folder / "x.k")
    return capsys.readouterr().err


# meshes with groups: two cubes side by side, whose base has quadrangles, as Gmsh writes them

POINTS = [[x, y, z] for z in (0.0, 0.2) for y in (0.0, 0.2) for x in (0.0, 0.2, 0.4)]
CUBES = [[0, 1, 4, 3, 6, 7, 10, 9], [1, 2, 5, 4, 7, 8, 11, 10]]
BASE = [[0, 1, 4, 3], [1, 2, 5, 4]]


def gmsh(**keys: Any) -> SimpleNamespace:
    cells = [SimpleNamespace(type="hexahedron", data=CUBES), SimpleNamespace(type="quad", data=BASE)]
    return SimpleNamespace(points=POINTS, cells=cells, cell_data={"gmsh:physical": [np.array([1, 2]), np.array([3, 3])]},
                           field_data={"left half": np.array([1, 3]), "right half": np.array([2, 3]), "base": np.array([3, 2])}, **keys)


def test_sides_beside_solids_leave_no_hole() -> None:
    assert abs(sound(shape_of(gmsh()), closed=True, close=False).volume() - 0.4 * 0.2 * 0.2) < 1e-12


def test_a_group_is_a_shape_or_a_part_or_nodes_that_are_held() -> None:
    assert abs(sound(shape_of(gmsh(), "right half"), True, False).volume() - 0.008) < 1e-12
    at = {"move": (0.3, 0.1, 0.3), "material": "rubber"}
    decks = [space().structure(gmsh(), fix=fix, **at).deck() for fix in ("base", "bottom", "top")]
    assert decks[0] == decks[1] != decks[2]
    assert "201 mesh: 1 solid" in space().structure(gmsh(), group="left half", **at).deck()
    assert "the mesh has no group 'left'\n  hint: its groups: left half" in said(space().structure(gmsh(), group="left", **at))
    assert "a group, base" in said(space().structure(gmsh(), fix="basis", **at))
    assert "group: of a 'file' or a mesh" in said(space().wall(box={"low": (0.4, 0.1, 0), "high": (0.5, 0.2, 0.3)}, group="a"))
    sets = SimpleNamespace(points=POINTS, cells=[SimpleNamespace(type="hexahedron", data=CUBES)], cell_sets={"one": [[0]], "none": [None]})
    assert len(cells_of(sets).of("one").cells[0].data) == 1 and not cells_of(sets).of("none").cells
    assert cells_of(sets).nodes()["none"].size == 0


def test_an_obj_with_polygons_textures_and_groups(tmp_path: Path) -> None:
    file = tmp_path / "house.obj"
    corners = "".join(f"v {x} {y} {z}\n" for z in (0, 1) for y in (0, 1) for x in (0, 1))
    file.write_text(corners + "vt 0 0\nvn 0 0 1\ng floor\nf 1/1/1 3/1/1 4/1/1 2/1/1\ng sides\nf 1//1 2//1 6//1 5//1\nf 2/1 4/1 8/1 6/1\nf -5 -6 -2 -1\n"
                    "f 3 1 5 \\\n7\ng roof top\nf 5 6 8 7\n")
    assert abs(sound(read_shape(file), closed=True, close=False).volume() - 1) < 1e-12
    assert len(read_shape(file, "floor").faces) == 2 and set(read_obj(file).groups) == {"floor", "sides", "roof", "top"}
    with pytest.raises(ShapeFault, match="no group 'rof'"):
        read_shape(file, "rof")
    for bad, why in (("f 1 2 99", "line 9: a face has three vertices"), ("f 1 2 x", "line 9: expected numbers")):
        file.write_text(corners + bad + "\n")
        with pytest.raises(ShapeFault, match=why):
            read_shape(file)
    with pytest.raises(ShapeFault, match="have none"):
        read_shape(stl(tmp_path / "a.stl"), "floor")


# polygons that are not convex, and what they enclose

ELL = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
TEE = [(0, 0), (3, 0), (3, 1), (2, 1), (2, 3), (1, 3), (1, 1), (0, 1)]
ARROW = [(0, 0), (2, 0), (0.5, 0.5), (0, 2)]
FRAME = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)]  # the hole hangs on a cut
HALVED = [(0, 0), (0.5, 0), (1, 0), (1, 1), (0, 1)]


def prism(file: Path, outline: list[tuple[float, float]], head: str = "") -> Path:
    """One unit high, its ends of one polygon each."""
    n = len(outline)
    corners = "".join(f"v {x} {y} {z}\n" for z in (0, 1) for x, y in outline)
    sides = "".join(f"f {k + 1} {(k + 1) % n + 1} {(k + 1) % n + n + 1} {k + n + 1}\n" for k in range(n))
    ends = f"g bottom\nf {' '.join(str(k) for k in range(n, 0, -1))}\ng top\nf {' '.join(str(k + n) for k in range(1, n + 1))}\n"
    file.write_text(f"{head}{corners}g sides\n{sides}{ends}")
    return file


@pytest.mark.parametrize(("outline", "volume", "area"), [(ELL, 3, 14), (TEE, 5, 22), (ARROW, 1, 6 + math.sqrt(10)), (HALVED, 1, 6)])
def test_a_prism_on_any_polygon_has_its_area_and_volume(tmp_path: Path, outline: list[tuple[float, float]], volume: float, area: float) -> None:
    for start in range(len(outline)):
        shape = sound(read_shape(prism(tmp_path / "a.obj", outline[start:] + outline[:start])), closed=True, close=False)
        corners = shape.points[shape.faces]
        areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
        assert abs(shape.volume() - volume) < 1e-12 and abs(areas.sum() - area) < 1e-12 and areas.min() > 1e-3 and not shape.notes


def test_polygons_with_cuts_and_many_corners_are_covered_once() -> None:
    angle = 2 * np.pi * np.arange(80) / 80
    star = (1 + 0.6 * np.cos(7 * angle))[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    for outline in (FRAME, TEE[::-1], star):
        x = np.column_stack([outline, np.asarray(outline) @ [0.3, -2.0]])  # in a slope
        made, crossed = triangulated(x, [list(range(len(x)))])
        faces = made["triangle"][0]
        flat = x[faces][:, :, :2]
        areas = np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0])
        whole = sum(np.cross(a[:2], b[:2]) for a, b in zip(x, np.roll(x, -1, axis=0)))
        assert crossed is None and len(faces) == len(x) - 2 and (areas * np.sign(whole) > 0).all() and abs(areas.sum() - whole) < 1e-12
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    assert triangulated(square, [[0, 1, 2, 3], [2, 1, 0]])[0]["quad"][0].tolist() == [[0, 1, 2, 3]]
    dart = np.column_stack([ARROW, np.zeros(4)])
    assert not any(len(triangulated(dart, [[k, (k + 1) % 4, (k + 2) % 4, (k + 3) % 4]])[0]["quad"][0]) for k in range(4))  # no shell of four corners


def test_the_group_of_a_structure_is_the_surface_that_is_filled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    both = prism(tmp_path / "a.obj", ELL, "o ell\n")
    far = [line.split() for line in prism(tmp_path / "b.obj", [(x + 5, y) for x, y in TEE], "o tee\n").read_text().splitlines()]
    both.write_text(both.read_text() + "".join(" ".join([word, *(str(int(k) + 12) for k in rest)] if word == "f" else [word, *rest]) + "\n" for word, *rest in far))
    filled: list[float] = []

    def tetrahedra(shape: Shape, size: float) -> None:
        filled.append(shape.volume())
        raise ShapeFault("enough")

    monkeypatch.setattr("courant.scene.structure_reader.tetrahedra", tetrahedra)
    for keys in ({"group": "ell"}, {"group": "tee"}, {}):
        assert "enough" in said(space().structure(both, material="rubber", **keys))
    assert np.abs(np.array(filled) - [3, 5, 8]).max() < 1e-12


def test_a_face_that_crosses_itself_is_refused_at_its_line(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1.2 0\nf 1 2 3\nf 1 2 3 4\n")
    with pytest.raises(ShapeFault, match="line 6: the sides of a face cross each other"):
        read_shape(tmp_path / "a.obj")


def test_groups_of_structures_are_read_or_refused_at_their_line(tmp_path: Path) -> None:
    file = prism(tmp_path / "a.obj", ELL)
    at = {"scale": 0.1, "move": (0.3, 0.1, 0.25), "material": "rubber"}
    shells = space().structure(file, thickness=0.01, group="sides", title="whole", **at).deck()
    assert "201 whole: 6 shells" in shells and "whole: 14 shells" in space().structure(file, thickness=0.01, title="whole", **at).deck()
    prism(file, ELL[:2] + [(2, 2), (0, 2)])
    assert "whole: 6 shells" in space().structure(file, thickness=0.01, title="whole", fix="bottom", **at).deck()  # quadrangles remain
    text = said(space().structure(file, thickness=0.01, group="side", **at))
    assert "error: group: the mesh has no group 'side'\n  hint: did you mean sides? its groups: sides, bottom, top" in text
    assert "error: group: the mesh has no group 'side'" in said(space().structure(file, group="side", **at))  # before Gmsh fills it
    assert "error: group: files that end with '.stl' have none" in said(space().structure(stl(tmp_path / "h.stl"), group="a", **at))
    surface = SimpleNamespace(vertices=np.eye(3), faces=[[0, 1, 2]])
    assert "error: group: a SimpleNamespace has none" in said(space().structure(surface, group="a", **at))
    block: dict[str, Any] = {"box": {"low": (0.4, 0.1, 0.3), "high": (0.5, 0.2, 0.4)}, "material": "rubber"}
    assert "error: group: of a 'file' or a mesh" in said(space().structure(**block, group="a"))
    text = written(tmp_path, "title: a\nwater: {spacing: 0.05, blocks: [{low: [0, 0, 0], high: [1, 0.5, 0.2]}]}\nend: 1\nstructures:\n  - file: h.stl\n"
                   "    material: rubber\n    group: a\n").messages
    assert "scene.yaml:7:12: error: group: files that end with '.stl' have none" in text


def test_closed_surfaces_that_overlap_in_one_file_are_refused() -> None:
    one, other = box(np.zeros(3), np.ones(3), 3), box(np.full(3, 0.5), np.full(3, 1.5), 3)
    with pytest.raises(ShapeFault, match="closed surfaces overlap at x = "):
        sound(shape_of((np.concatenate([one.points, other.points]), np.concatenate([one.faces, other.faces + 8]))), True, False)


# outlines

def test_arcs_of_a_dxf_polyline(tmp_path: Path) -> None:
    file = tmp_path / "a.dxf"
    file.write_text("0\nSECTION\n2\nBLOCKS\n0\nLINE\n10\n9\n20\n9\n11\n8\n21\n8\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
                    "0\nLWPOLYLINE\n70\n1\n10\n0\n20\n0\n42\n1\n10\n1\n20\n0\n10\n1\n20\n1\n10\n0\n20\n1\n0\nENDSEC\n0\nEOF\n")
    outline = sound(read_outline(file), closed=True, close=False)
    assert abs(outline.volume() - (1 + math.pi / 8)) < 2e-3 and outline.low[1] == pytest.approx(-0.5, abs=2e-3)
    file.write_text(file.read_text().replace("42\n1\n", f"42\n{-math.tan(math.pi / 8)}\n"))  # a quarter of a circle, inwards
    assert abs(sound(read_outline(file), closed=True, close=False).volume() - (1 - (math.pi / 2 - 1) / 4)) < 2e-3
    file.write_text("0\nSPLINE\n10\n0\n20\n0\n0\nEOF\n")
    with pytest.raises(ShapeFault, match="a SPLINE is not read here"):
        read_shape(file)


def test_an_ellipse_of_an_svg(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"><ellipse cx="1" cy="1" rx="2" ry="1"/></svg>')
    assert abs(sound(read_shape(tmp_path / "a.svg"), True, False).volume() / (2 * math.pi) - 1) < 1e-3


def test_columns_of_numbers() -> None:
    assert two_columns("x;y\n1,5;2\n0,25; 3,0\n").tolist() == [[1.5, 2], [0.25, 3]]
    assert two_columns("# a\nx,y,z\n1,2,0\n3 4\n").tolist() == [[1, 2], [3, 4]]
    assert two_columns("0 0 # start\n  # a, b\n1 2# end\n").tolist() == [[0, 0], [1, 2]]
    assert two_columns('Time (s), Gauge 1\n"[s]","[m]"\n\n0,1\n').tolist() == two_columns("t,I\n0 1").tolist() == [[0, 1]]
    for text, line in (("1,2\n1,2,3\n", 2), ("1,5\t2,5\n", 1), ("1,2\n3\n", 2), ("1,2\nx,y\n", 2), ("O.0 0.5\n1 2\n", 1), ("x y\n1.O 0.5\n1 2\n", 2), ("O.0,O.5\n1,2", 1),
                       ("x;y\n0,5;O,5\n1;2", 2), ("1 # 2\n", 1)):
        with pytest.raises(ValueError, match=f"line {line}: two numbers"):
            two_columns(text)


def test_an_outline_with_a_mark_of_its_encoding(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("0,0\n1,0\n1,1\n0,1\n", encoding="utf-8-sig")
    assert len(read_outline(tmp_path / "a.csv").points) == 4


# motions

def test_a_motion_from_a_file_or_a_list(tmp_path: Path) -> None:
    (tmp_path / "m.csv").write_text("t,x\n0,0\n0.1,20\n0.2,40\n")
    wall: dict[str, Any] = {"line": [(0.5, 0), (0.5, 0.3)]}
    of_file = plane().wall(motion={"x": {"file": str(tmp_path / "m.csv"), "scale": 0.001}}, **wall).deck()
    of_list = plane().wall(motion={"x": np.array([[0, 0], [0.1, 0.02], [0.2, 0.04]])}, **wall).deck()
    assert of_file.split("\n", 1)[1] == of_list.split("\n", 1)[1]
    rows = [[float(v) for v in line.split()] for line in of_file.split("\n       901\n")[1].splitlines()[1:5]]
    assert rows == [[0, 0], [0.1, 0.02], [0.2, 0.04], [1, 0.04]]  # the last value is kept
    plane().wall(motion={"x": {"file": str(tmp_path / "m.csv"), "scale": 0.001}}, **wall).to_yaml(tmp_path / "scene.yaml")
    assert courant.Scene.from_yaml(tmp_path / "scene.yaml").deck().split("\n", 1)[1] == of_file.split("\n", 1)[1]
    text = "title: a\nwater: {spacing: 0.02, blocks: [{low: [0, 0], high: [0.4, 0.2]}]}\nbox: {low: [0, 0], high: [0.4, 0.4], open: top, motion: {x: {file: m.csv}}}\nend: 1\n"
    assert "*DEFINE_CURVE\n" in written(tmp_path, text).deck  # beside the scene


@pytest.mark.parametrize(("motion", "what"), [
    ("0.1 * time_of_day", "unknown name 'time_of_day' in the formula"), ("motion.csv", "unknown name 'motion' in the formula"), ("sin(TIME", "as many '(' as ')'"),
    (lambda t: t, "expected a formula of TIME, got <function>"), ([(0, 0.5), (1, 0.6)], "begins with 0.5 at 0"),
    ([(-1, 0), (1, 0.1)], "begins with 0.05 at 0"), ([(0.1, 0), (1, 0.1)], "begins with 0 at 0.1"), ([(-2, 0.1), (-1, 0.2)], "begins with 0.2 at 0"), ([(0, 0), (0, 1)], "times that go upwards"),
    ([(0, 0)], "two rows"), ([1, 2, 3], "expected a list of [time, value]"), ({"file": "none.csv"}, "'none.csv' cannot be read: No such file"),
    ({"fil": "a.csv"}, "unknown key 'fil'\n  hint: did you mean file?"), (float("nan"), "unknown name 'nan'")])
def test_mistakes_of_motions_are_named(motion: Any, what: str) -> None:
    text = said(plane().wall(line=[(0.5, 0), (0.5, 0.3)], motion={"x": motion}))
    assert what in text and "test_scene_files.py:" in text and text.count("error") == 1, text


def test_names_of_formulas_are_those_of_the_cards() -> None:
    for formula in ("0.05*sin(2*PI*TIME/1.3)", "1.5e-3 * TIME", "step(TIME, 0, 0, 1, 0.1)", "if (TIME - 1, 0, 1, 2) * pi", "1d-3*time"):
        assert formula in plane().wall(line=[(0.5, 0), (0.5, 0.3)], motion={"x": formula}).deck()


# sizes, units, positions

def test_files_in_other_units_are_a_warning(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("vtkmodules", reason="python3-vtk9 is missing")
    house = stl(tmp_path / "house.stl")
    assert "'house' is 400 long, and the scene 1\n  hint: is it a file in millimetres?" in warnings(space().wall(house, move=(0.5, 0.2, 0.19)), tmp_path, capsys)
    assert "less than half of the spacing 0.05" in warnings(space().wall(house, scale=1e-5, move=(0.5, 0.2, 0.4)), tmp_path, capsys)
    assert "long" not in warnings(space().wall(house, scale=1e-3, move=(0.5, 0.1, 0)), tmp_path, capsys)
    assert "density: 1.0e-9 in tonnes and mm" in warnings(plane(gravity=9810), tmp_path, capsys)
    assert "gravity: 9810" in warnings(plane(density=1e-9), tmp_path, capsys)
    assert not warnings(plane(density=1e-9, gravity=9810), tmp_path, capsys) + warnings(plane(gravity=1.62), tmp_path, capsys)


def test_a_body_that_begins_in_a_wall_or_across_it_is_refused() -> None:
    body: dict[str, Any] = {"box": {"low": (0.4, 0.2, 0.3), "high": (0.6, 0.3, 0.5)}, "density": 500, "title": "body"}
    block, plate = {"box": {"low": (0.3, 0.1, 0), "high": (0.5, 0.4, 0.4)}}, {"plate": {"origin": (0.3, 0.1, 0.4), "edge1": (0.4, 0, 0), "edge2": (0, 0.3, 0)}}
    assert "'body' begins inside of the wall 'box' or across it" in said(space().wall(**block).body(**body))
    assert "'body' begins inside of the wall 'plate' or across it" in said(space().wall(**plate).body(**body))
    space().wall(**block, move=(0, 0, -0.1)).body(**body).deck()  # it is on the wall
    space().wall(**block, title="post").body(**body).joint("hinge", ["body", "post"], at=(0.5, 0.25, 0.35), axis=(0, 1, 0)).deck()


def test_a_body_is_compared_with_near_faces_of_a_wall_alone() -> None:
    x, n = np.linspace(0, 10, 101), 101
    k = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    ground = Shape(np.array([[a, b, 0.3 * a] for a in x for b in x]), np.concatenate([np.stack([k, k + n, k + n + 1], 1), np.stack([k, k + n + 1, k + 1], 1)]), 3)
    body, beside = box(np.array([1, 1, 0.2]), np.array([1.2, 1.2, 0.5]), 3), box(np.full(3, 11.0), np.full(3, 12.0), 3)
    points = np.concatenate(list(_points_on(ground, body)))
    assert 36 * 8 <= len(points) <= 36 * 4 * 4 * 2 and np.abs(points[:, :2] - 1.1).max() < 0.2 and not list(_points_on(ground, beside))
    assert body.contains(points).any()  # the slope passes through it
    assert not list(_points_on(ground, replace(body, points=body.points + (0, 0, 0.5))))


def test_bodies_of_many_faces_are_no_mirrors_unless_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A hull of 130 faces took 37 ms per particle and step as a mirror, a cube 0.2, by contact 0.001."""
    ball: dict[str, Any] = {"sphere": {"centre": (0.5, 0.25, 0.25), "radius": 0.12}, "density": 500, "title": "ball"}
    cube: dict[str, Any] = {"box": {"low": (0.4, 0.2, 0.1), "high": (0.6, 0.3, 0.3)}, "density": 500}

    def mirrors(scene: courant.Scene) -> list[str]:
        return scene.deck().split("\n         5\n")[1].splitlines()[1].split()

    assert "'ball' acts on the water by contact and floats one to three spacings too deep" in warnings(space().body(**ball), tmp_path, capsys)
    assert mirrors(space().body(**ball)) == ["11"] and mirrors(space().body(**cube)) == ["11", "101"]
    assert mirrors(space(wall_method="mirrors").body(**ball)) == ["11", "101"] and mirrors(space(wall_method="mixed").body(**ball)) == ["11", "101"]
    assert "other walls act by contact, 'ball', too" in space().body(**ball).explain()
    assert not warnings(space().body(**cube), tmp_path, capsys) and len(FACES) == 16


def test_an_inlet_inside_of_the_water_is_refused_at_its_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def basin() -> courant.Scene:
        return courant.Scene("far", spacing=0.02, end=0.5, sound_speed=20).water(low=(0, 0), high=(0.2, 0.2))

    assert "an inlet inside of the water: " in said(plane().inlet(at=(0.2, 0.1), direction=(1, 0), width=0.1, speed=1))
    assert "test_scene_files.py:" in said(space().inlet(at=(0.5, 0.2, 0.1), direction=(1, 0, 0), sides=(0.1, 0.1), speed=1))
    plane().inlet(at=(0.2, 0.3), direction=(1, 0), width=0.1, speed=1).deck()
    plane().inlet(at=(0.5, 0.1), direction=(1, 0), width=0.1, speed=0.1).deck()  # what waits does not reach the water
    with pytest.raises(courant.CourantError, match="an inlet inside of the water"):
        plane(sound_speed=20).inlet(at=(0.5, 0.1), direction=(1, 0), width=0.1, speed="1 - TIME").deck()
    far: dict[str, Any] = {"at": (3, 0.1), "direction": (1, 0), "width": 0.1, "end": 0.1}
    for speed in ("1 + 0*TIME", "28 - 0 * time * TIME", "2*PI*sin(TIME)"):
        basin().inlet(**far, speed=speed).deck()
    assert "an inlet inside of the water" in said(basin().inlet(**far, speed="1000 * TIME * 2 * 30"))  # 300
    assert not warnings(basin().inlet(**far, speed="1 + 0*TIME"), tmp_path, capsys)
    assert "warning: an inlet inside of the water" in warnings(basin().inlet(**far, speed="step(TIME, 0, 0, 1, 1)"), tmp_path, capsys)  # of the program alone
    courant.Scene("ahead", spacing=0.02, end=1).water(low=(0.2, 0), high=(0.4, 0.2)).inlet(at=(0.1, 0.1), direction=(1, 0), width=0.1, speed=1).deck()


def test_gases_need_some_width() -> None:
    def tube(width: float, open: Any) -> courant.Scene:
        made = courant.Scene("tube", spacing=0.01, end=0.1).gas(low=(0, 0), high=(0.5, width), density=1, pressure=1)
        return made.box(low=(0, 0), high=(0.5, width), open=open)

    assert "box: 0.04 along y are 4 spacings" in said(tube(0.04, ())) and "hint: 0.06 as the upper end" in said(tube(0.04, ()))
    assert tube(0.06, ()).deck().count("\n         0         0         0") and tube(0.04, "top").deck() and "'tp' is no side" in said(tube(0.06, "tp"))


def test_a_scene_without_water_says_so() -> None:
    text = said(courant.Scene("drop", spacing=0.05, end=0.1).box(low=(0, 0, 0), high=(1, 1, 1)))
    assert text.count("error") == 1 and "the scene has none" in text and "a scene of bodies and parts that deform alone has no 'water'" in text


def test_numbers_that_are_none_are_named_once(tmp_path: Path) -> None:
    assert "spacing: expected a finite number, got 'nan'" in said(plane(spacing=float("nan")))
    text = "title: a\nwater: {spacing: 0.05, blocks: [{low: [0, 0], high: [0.5, 0.5]}]}\nend: .inf\n"
    assert "scene.yaml:3:6: error: end: expected a finite number, got '.inf'\n" in written(tmp_path, text).messages


PARTS = """title: hull
parameters: {n: 4}
water: {spacing: 0.5 / n, blocks: [{low: [0, 0], high: [2, 0.5]}]}
box: {low: [0, 0], high: [2, 1], open: [top], motion: {x: [[0, 0], [1, 0.1]]}}
walls: [{line: [[1.5, 0], [1.6, 0.3]], title: weir, motion: {y: 0.1 * TIME}}]
bodies: [{box: {low: [0.5, 0.4], high: [0.8, 0.7]}, density: 500, title: raft}]
structures: [{box: {low: [1, 0.6], high: [1.1, 0.9]}, material: rubber, fix: top}]
joints: [{kind: hinge, between: [raft, walls], at: [0.5, 0.5]}]
gauges: [{name: a, point: [0.1, 0.1]}]
end: 1
"""
VALUES = ["[]", "{}", "-1", "x", "[1]", "{a: 1}", ".nan", "1e400", "null", "[[0, 0], [1, 1]]", "true", "TIME", "[[]]", "{file: x}"]


def test_a_wrong_value_anywhere_has_its_line(tmp_path: Path) -> None:
    spots, random = [found.span() for found in re.finditer(r"[\w./*]+|\[[^\[\]]*\]|\{[^{}]*\}", PARTS)], np.random.default_rng(1)
    assert written(tmp_path, PARTS).deck
    refused = 0
    for _ in range(200):
        begin, end = spots[random.integers(len(spots))]
        text = PARTS[:begin] + VALUES[random.integers(len(VALUES))] + PARTS[end:]
        made = written(tmp_path, text)
        refused += not made.deck
        assert made.deck or "scene.yaml:" in made.messages, text
    assert refused > 100


def test_hints_of_extents_and_gauges() -> None:
    assert "hint: 0.18 or 0.2 as the upper end" in said(courant.Scene("a", spacing=0.02, end=1).water(low=(0, 0), high=(0.4, 0.19)))
    assert "point: expected 3 components, got 2" in said(space().gauge("g", point=(0.1, 0.1)))
    assert "level: expected 2 components, got 3" in said(plane().gauge("g", level=[(0.1, 0, 0), (0.1, 0, 1)]))
