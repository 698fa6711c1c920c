"""Scenes that are made in Python: shapes from files and objects, walls and bodies, and the errors that name the line of the call."""
from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import courant
import numpy as np
import pytest
from courant.scene import shapes
from courant.scene.surfaces import ShapeFault, read_shape, shape_of, sound

from .house import CORNERS, FACES, VOLUME, stl

pytest.importorskip("vtkmodules", reason="python3-vtk9 is missing")

def scene(**keys: Any) -> courant.Scene:
    made = courant.Scene("house", **({"spacing": 0.05, "end": 0.1} | keys))
    return made.water(low=(0, 0, 0), high=(1, 0.6, 0.3)).box(low=(0, 0, 0), high=(1, 0.6, 0.6), open=["top"])


def fails(call: Any) -> courant.CourantError:
    with pytest.raises(courant.CourantError) as fault:
        call()
    return fault.value


def particles(deck: str) -> int:
    return int(deck.split("$   1 water: ")[1].split()[0])


# shapes

def test_a_bad_surface_is_made_sound(tmp_path: Path) -> None:
    raw = read_shape(stl(tmp_path / "house.stl", turned=(1, 4, 6, 9)))
    assert len(raw.points) >= len(CORNERS)
    good = sound(raw, closed=True, close=False)
    assert len(good.points) == len(CORNERS) and abs(good.volume() / VOLUME - 1) < 1e-6
    assert any("4 of 16 faces turned" in note for note in good.notes)
    inside_out = sound(read_shape(stl(tmp_path / "out.stl", turned=range(99))), closed=True, close=False)
    assert abs(inside_out.volume() / VOLUME - 1) < 1e-6


def test_a_hole_is_refused_with_its_position_or_closed(tmp_path: Path) -> None:
    file = stl(tmp_path / "house.stl", turned=(1, 4), left_out=(3,))
    x, y, z = CORNERS[FACES[3]].mean(axis=0)
    with pytest.raises(ShapeFault) as fault:
        sound(read_shape(file), closed=True, close=False)
    assert f"a hole at x = {x:.4g}, y = {y:.4g}, z = {z:.4g}" in fault.value.message
    closed = sound(read_shape(file), closed=True, close=True)
    assert abs(closed.volume() / VOLUME - 1) < 1e-6 and any("1 hole closed" in note for note in closed.notes)
    assert not any("closed" in note for note in sound(read_shape(stl(file)), closed=True, close=True).notes)


def test_a_file_in_millimetres_is_named(tmp_path: Path) -> None:
    file = stl(tmp_path / "house.stl")
    fault = fails(lambda: scene().wall(file, scale=1000, move=(-3000, -3000, -3000)).deck())
    assert "covers all the water" in str(fault) and "scale: 0.001" in str(fault)


def test_a_body_that_begins_in_a_wall_is_refused() -> None:
    def with_body(x: float) -> courant.Scene:
        return scene().body(box={"low": [x, 0.2, 0.2], "high": [x + 0.2, 0.4, 0.4]}, density=500)

    assert "through a wall of the box from 0 to 1" in str(fails(lambda: with_body(0.9).deck()))
    assert "*ELEMENT_SPH" in with_body(0.7).deck()


def test_a_cavity_is_empty() -> None:
    outer, inner = (shapes.box(np.array([a] * 3), np.array([3.0 - a] * 3), 3) for a in (0.0, 1.0))
    both = shapes.Shape(np.concatenate([outer.points, inner.points]), np.concatenate([outer.faces, inner.faces + 8]), 3)
    good = sound(both, closed=True, close=False)
    assert abs(good.volume() - 26) < 1e-12
    assert good.contains(np.array([[0.5, 1.5, 1.5], [1.5, 1.5, 1.5], [-1, 1.5, 1.5]])).tolist() == [True, False, False]


@pytest.mark.parametrize(("shape", "volume"), [
    (shapes.box(np.zeros(3), np.array([1.0, 2.0, 3.0]), 3), 6.0), (shapes.cylinder(np.zeros(3), np.array([0, 1.0, 1.0]), 0.5, 0.1), math.pi * 0.25 * math.sqrt(2)),
    (shapes.sphere(np.array([1.0, 2.0, 3.0]), 0.7, 0.1, 3), 4 / 3 * math.pi * 0.343), (shapes.sphere(np.array([1.0, 2.0, 0.0]), 0.7, 0.1, 2), math.pi * 0.49)])
def test_particles_hold_what_a_shape_holds(shape: shapes.Shape, volume: float) -> None:
    assert abs(shape.volume() / volume - 1) < 1e-12
    assert not len(shapes.faulty_edges(shape).free) and not len(shapes.faulty_edges(shape).crowded)
    dx = 0.05
    axes = [np.arange(shape.low[k] + dx / 2, shape.high[k], dx) if k < shape.dim else np.zeros(1) for k in range(3)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    assert abs(shape.contains(grid).sum() * dx**shape.dim / volume - 1) < 0.01


def test_masses_and_inertia_are_those_of_the_solid() -> None:
    mass, centre, tensor = shapes.box(np.array([1.0, 1, 1]), np.array([2.0, 3, 4]), 3).inertia(2.0)
    np.testing.assert_allclose([mass, *centre], [12, 1.5, 2, 2.5])
    np.testing.assert_allclose(tensor, np.diag([13.0, 10, 5]), atol=1e-12)  # m (b^2 + c^2) / 12
    mass, _, tensor = shapes.sphere(np.zeros(3), 0.5, 0.02, 3).inertia(3.0)
    np.testing.assert_allclose(np.diag(tensor), 0.4 * mass * 0.25, rtol=3e-3)
    mass, centre, tensor = shapes.box(np.array([1.0, 1]), np.array([2.0, 3]), 2).inertia(2.0)
    np.testing.assert_allclose([mass, *centre], [4, 1.5, 2, 0])
    np.testing.assert_allclose(tensor, 4 / 12 * np.diag([2**2 + 1, 1 + 1, 1 + 2**2]), atol=1e-12)  # one unit deep


def test_outlines_are_read(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("x,y\n0,0\n2,0\n2,1\n0,1\n")
    (tmp_path / "a.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 h2 v-1 H0 z"/></svg>')
    pairs = [("0", "SECTION"), ("2", "ENTITIES"), *[("0", "LWPOLYLINE"), ("70", "1")], *[p for x, y in ((0, 0), (2, 0), (2, 1), (0, 1)) for p in (("10", f"{x}"), ("20", f"{y}"))],
             ("0", "ENDSEC"), ("0", "EOF")]
    (tmp_path / "a.dxf").write_text("".join(f"{code}\n{value}\n" for code, value in pairs))
    lines = [((0, 0), (2, 0)), ((2, 1), (2, 0)), ((2, 1), (0, 1)), ((0, 0), (0, 1))]
    (tmp_path / "b.dxf").write_text("".join(f"0\nLINE\n10\n{a[0]}\n20\n{a[1]}\n11\n{b[0]}\n21\n{b[1]}\n" for a, b in lines) + "0\nEOF\n")
    for name in ("a.csv", "a.svg", "a.dxf", "b.dxf"):
        assert abs(sound(read_shape(tmp_path / name), closed=True, close=False).volume() - 2) < 1e-12, name
    (tmp_path / "bad.csv").write_text("0,0\n1,a\n")
    with pytest.raises(ShapeFault, match="line 2"):
        read_shape(tmp_path / "bad.csv")


def test_meshes_of_other_libraries_are_taken() -> None:
    class Mesh:
        vertices, faces = CORNERS, FACES

    class Block:
        def __init__(self, kind: str, data: np.ndarray) -> None:
            self.type, self.data = kind, data

    class Meshio:
        points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=float)
        cells = [Block("hexahedron", np.arange(8)[None])]

    assert abs(sound(shape_of(Mesh()), True, False).volume() / VOLUME - 1) < 1e-12
    assert abs(sound(shape_of((CORNERS, FACES)), True, False).volume() / VOLUME - 1) < 1e-12
    assert abs(sound(shape_of(Meshio()), True, False).volume() - 1) < 1e-12
    from vtkmodules.vtkFiltersSources import vtkCubeSource
    cube = vtkCubeSource()
    cube.Update()
    assert abs(sound(shape_of(cube.GetOutput()), True, False).volume() - 1) < 1e-6
    with pytest.raises(ShapeFault, match="a dict is no surface"):
        shape_of({})


# scenes

def test_water_keeps_out_of_a_wall(tmp_path: Path) -> None:
    without = particles(scene().deck())
    assert without == 20 * 12 * 6
    deck = scene().wall(stl(tmp_path / "house.stl"), scale=0.001, move=(0.4, 0.1, 0)).deck()
    assert "$   12 house: 16 shells" in deck and "*COURANT_WALL_SUPPORT" in deck
    gone = (without - particles(deck)) * 0.05**3
    under_water = 0.4 * 0.3 * 0.2 + 0.4 * 0.1 * (0.3 + 0.05) / 2  # the house below 0.3
    assert 0.97 * under_water <= gone <= 0.45 * 0.35 * 0.3  # and half a spacing beside it


def test_a_body_of_water_holds_its_volume(tmp_path: Path) -> None:
    made = courant.Scene("pool", spacing=0.01, end=0.1).water(stl(tmp_path / "house.stl", turned=(2,)), scale=0.001)
    assert abs(particles(made.deck()) * 0.01**3 / (VOLUME * 1e-9) - 1) < 0.01


def test_particles_that_do_not_hold_a_shape_are_a_warning(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    house = stl(tmp_path / "house.stl")
    for spacing, warned in ((0.01, False), (0.09, True)):
        courant.Scene("pool", spacing=spacing, end=0.1).water(house, scale=0.001).write(tmp_path / "pool.k")
        assert ("warning: the particles of 'house' hold" in capsys.readouterr().err) == warned


def test_walls_bodies_and_motions_become_cards(tmp_path: Path) -> None:
    made = courant.Scene("plane", spacing=0.05, end=1).water(low=(0, 0), high=(1, 0.5)).box(low=(0, 0), high=(1, 1), open=["top", "left"])
    made.wall(line=[[0, 0], [0, 1]], motion={"x": "0.05*sin(2*PI*TIME)"}, title="piston")
    made.body(box={"low": [0.4, 0.4], "high": [0.6, 0.6]}, density=500, velocity=(0, -1), hold=["x"])
    deck = made.deck()
    assert "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n$#     pid       dof       vad      lcid        sf\n        12         1         2       901       1.0\n" in deck
    assert "*DEFINE_CURVE_FUNCTION\n$#    lcid\n       901\n0.05*sin(2*PI*TIME)\n" in deck
    assert "*PART_INERTIA\n$# heading\nbox\n" in deck
    assert "       0.5       0.5         0        20\n" in deck  # centre, and mass per unit of depth
    assert "\n       101       500" in deck and "\n         1         6         4\n" in deck  # holds x and z, turns about x and y
    assert particles(deck) == 20 * 10 - 4 * 2
    assert "9810" not in deck and "*INITIAL_STRESS_SPH" in deck


def test_yaml_is_the_same_scene_written_down(tmp_path: Path) -> None:
    file = stl(tmp_path / "house.stl")
    made = scene(parameters={"n": 4, "x0": "0.1 * n"}).wall(file, scale=1e-3, move=("x0", 0.1, 0)).keywords("*CONTROL_TIMESTEP\n         0       0.5")
    text = made.to_yaml(tmp_path / "scene.yaml")
    again = courant.Scene.from_yaml(tmp_path / "scene.yaml")
    first, second = made.deck().split("\n", 1)[1], again.deck().split("\n", 1)[1]
    assert first == second and again.to_yaml() == text
    assert "0.1 * n" in text and "scale: 0.001" in text
    assert courant.Scene.from_yaml(tmp_path / "scene.yaml", n=5).deck() != again.deck()
    assert "no such parameter" in str(fails(lambda: courant.Scene.from_yaml(tmp_path / "scene.yaml", m=5)))
    assert "a mesh in memory" in str(fails(scene().wall((CORNERS, FACES)).to_yaml))


def test_mistakes_name_the_line_of_the_call(tmp_path: Path) -> None:
    made = scene().wall(stl(tmp_path / "house.stl", left_out=(0,)), scale=0.001)
    line = fails.__code__.co_firstlineno
    fault = fails(made.deck)
    where = fault.diagnostics.all[0].where
    assert where.file.endswith("test_scene_python.py") and where.line > line
    assert "a hole at" in str(fault) and "close=True" in fault.diagnostics.all[0].hint
    for bad, message in ((scene().wall("none.stl"), "'none.stl' is not there"), (scene().wall("a.xyz"), "files that end with '.xyz'"),
                         (scene().wall(spere={"centre": [0, 0, 0], "radius": 1}), "unknown key 'spere'\n  hint: did you mean sphere?"),
                         (scene().body(sphere={"centre": [0.5, 0.3, 0.3], "radius": 0.1}), "expected its 'density' or its 'mass'"),
                         (scene().wall(circle={"centre": [0.5, 0.3], "radius": 0.1}), "a shape of 2 dimensions in a scene of 3"),
                         (scene(wall_method="mirror"), "wall_method: 'mirror' is none"), (scene(spacing="dy"), "unknown parameter 'dy'")):
        text = str(fails(bad.deck))
        assert message in text and "test_scene_python.py:" in text, text


@pytest.mark.parametrize(("make", "message"), [
    (lambda: courant.Scene(spacing=0.1, end=-1).water((0, 0), (1, 1)), "end: expected a time > 0, got -1"),
    (lambda: courant.Scene(spacing=0.1, end=1, output=-1).water((0, 0), (1, 1)), "output: expected a time > 0, got -1"),
    (lambda: courant.Scene(spacing=0.1, end=1, density=-1).water((0, 0), (1, 1)), "density: expected a number > 0, got -1"),
    (lambda: courant.Scene(spacing=0.1, end=1).water((0, None), (1, 1)), "low: expected a number, got None\n  hint: a number, or a text"),
    (lambda: courant.Scene(spacing=0.1, end=1, parameters={"n": None}).water((0, 0), (1, 1)), "parameter n: expected a number, got None\n  hint: "),
    (lambda: courant.Scene(spacing=0.1, end=1).with_parameters(n=None), "parameter n: expected a number or an expression, got None\n  hint: "),
    (lambda: courant.Scene(spacing=0.1, end=1).water(None, (1, 1)), "'low' is missing")])
def test_messages_have_the_kind_of_the_number(make: Any, message: str) -> None:
    assert message in str(fails(lambda: make().deck()))


def test_none_is_what_is_not_given() -> None:
    sphere = {"centre": [0.5, 0.3, 0.45], "radius": 0.1}
    assert scene().body(sphere=sphere, density=500, mass=None).deck().replace(",", "") == scene().body(sphere=sphere, density=500).deck().replace(",", "")


def test_a_damaged_file_is_told(tmp_path: Path) -> None:
    for name, data in (("a.stl", b"\0" * 200), ("b.stl", b"solid x\nfacet"), ("c.ply", b"ply\nx"), ("d.obj", b"v 1"), ("e.dxf", b"0\nLINE"), ("f.svg", b"<svg")):
        (tmp_path / name).write_bytes(data)
        assert name in str(fails(scene().wall(tmp_path / name).deck)), name


def test_choices_are_explained() -> None:
    text = scene().explain()
    for word in ("sound speed 49", "walls are mirrors", "9810 * (0.3 - z)", "*CONTROL_SPH", "states each 0.001"):
        assert word in text, text


def test_methods_of_walls_are_those_asked_for(tmp_path: Path) -> None:
    house = stl(tmp_path / "house.stl")

    def deck(**keys: Any) -> str:
        made = scene(**keys).wall(house, scale=0.0005, move=(0.7, 0.1, 0))
        return made.body(sphere={"centre": [0.3, 0.3, 0.3], "radius": 0.12}, density=500).deck()

    def mirrors(text: str) -> list[int]:
        return [int(word) for word in text.split("\n         5\n")[1].splitlines()[1].split()]

    mixed, plain, all_of = deck(wall_method="mixed"), deck(wall_method="contact"), deck(wall_method="mirrors")
    assert mirrors(mixed) == [11, 101] and "\n        12         2         2" in mixed and "\n       101         2       101" in mixed
    assert mirrors(all_of) == [11, 12, 101] and "\n        12         2         2" in all_of
    assert "*COURANT_WALL_SUPPORT" not in plain and "\n       101         2       101" in plain
    assert particles(plain) == particles(mixed) == particles(all_of)
    assert "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE" in mixed
