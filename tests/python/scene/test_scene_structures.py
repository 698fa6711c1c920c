"""Deformable parts, joints, inlets, outlets and gases of scenes: cards, and runs against theory."""
from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

import courant
import numpy as np
import pytest
from courant.scene import meshes
from courant.scene.groups import cells_of, tidied
from courant.scene.model import NearSurface

from .made import written

HERE = Path(__file__).resolve()
needs_program = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


def tank(**keys: Any) -> courant.Scene:
    made = courant.Scene("tank", **({"spacing": 0.02, "end": 0.4, "output": 0.1} | keys))
    return made.water(low=(0, 0), high=(0.2, 0.1)).box(low=(0, 0), high=(2, 1), open=["top"])


def space(**keys: Any) -> courant.Scene:
    made = courant.Scene("space", **({"spacing": 0.05, "end": 0.4} | keys))
    return made.water(low=(0, 0, 0), high=(0.2, 0.2, 0.2)).box(low=(0, 0, 0), high=(1, 1, 1), open=["top"])


def message(scene: courant.Scene) -> str:
    with pytest.raises(courant.CourantError) as fault:
        scene.deck()
    return str(fault.value)


# meshes

@pytest.mark.parametrize(("mesh", "volume"), [
    (meshes.box(np.zeros(3), np.array([1.0, 2.0, 3.0]), np.full(3, 0.3), 3), 6.0), (meshes.box(np.zeros(3), np.array([1.0, 2.0, 0.0]), np.full(3, 0.3), 2), 2.0),
    (meshes.cylinder(np.zeros(3), np.array([0, 0, 2.0]), 0.5, 0.2), math.pi / 2), (meshes.sphere(np.ones(3), 0.7, 0.2), 4 / 3 * math.pi * 0.343)])
def test_solids_hold_the_volume_and_have_a_closed_surface(mesh: meshes.Mesh, volume: float) -> None:
    sizes = mesh.volumes()
    assert abs(sizes.sum() / volume - 1) < 1e-12 and sizes.min() > 0.1 * sizes.max()
    corners = mesh.points[mesh.outer_faces()]
    assert abs(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6 / volume - 1) < 1e-12


class _Cells:
    def __init__(self, points: list[list[float]], **cells: list[list[int]]) -> None:
        self.points, self.cells = np.array(points, dtype=float), [type("Block", (), {"type": kind, "data": data}) for kind, data in cells.items()]


CUBE = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]


@pytest.mark.parametrize(("cells", "volume", "faces"), [
    ({"tetra": [[0, 1, 2, 4]]}, 1 / 6, 4), ({"tetra": [[0, 2, 1, 4]]}, 1 / 6, 4), ({"wedge": [[0, 1, 2, 4, 5, 6]]}, 1 / 2, 8),
    ({"wedge": [[4, 5, 6, 0, 1, 2]]}, 1 / 2, 8), ({"pyramid": [[0, 1, 3, 2, 4]]}, 1 / 3, 6), ({"pyramid": [[0, 2, 3, 1, 4]]}, 1 / 3, 6),
    ({"hexahedron": [[0, 1, 3, 2, 4, 5, 7, 6]]}, 1, 12), ({"hexahedron": [[4, 5, 7, 6, 0, 1, 3, 2]]}, 1, 12), ({"triangle": [[0, 1, 2]], "tetra": [[0, 1, 2, 4]]}, 1 / 6, 4)])
def test_elements_of_other_programs_are_turned_the_right_side_out(cells: dict[str, Any], volume: float, faces: int) -> None:
    mesh = meshes.of_cells(cells_of(_Cells(CUBE, **cells)))
    assert mesh and abs(mesh.volumes().sum() - volume) < 1e-12
    triangles = mesh.points[mesh.outer_faces()]
    assert len(triangles) == faces
    assert abs(np.einsum("ij,ij->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6 - volume) < 1e-12


STEEL = {"material": "steel", "fix": "bottom"}


def test_parts_that_begin_in_each_other_are_refused() -> None:
    post: dict[str, Any] = {"box": {"low": (1, 0), "high": (1.1, 0.3)}, "title": "post", **STEEL}
    beside: dict[str, Any] = {"box": {"low": (1.1, 0), "high": (1.2, 0.2)}, "title": "beside", **STEEL}
    tank().structure(**post).structure(**beside).wall(box={"low": (0.8, 0), "high": (1.0, 0.2)}).deck()  # these touch
    inside: dict[str, Any] = {"box": {"low": (1.05, 0.05), "high": (1.2, 0.2)}}
    assert "'inside' and 'post' overlap" in message(tank().structure(**post).structure(**inside, title="inside", material="steel"))
    assert "'post' and 'box' overlap" in message(tank().structure(**post).wall(**inside))
    assert "'post' and 'block' overlap" in message(tank().structure(**post).body(**inside, density=500, title="block"))
    # a corner of the other is in it, none of its nodes in the other
    assert "'post' and 'spike' overlap: a point of one" in message(tank().structure(**post, size=0.1).body([(1.05, 0.25), (1.2, 0.1), (1.2, 0.28)], density=500, title="spike"))
    assert "'shelf' and 'post' overlap" in message(tank().structure(**post).structure(line=[(1.05, 0.1), (1.3, 0.1)], thickness=0.01, material="steel", title="shelf"))


def test_nodes_that_are_held_may_be_in_a_wall() -> None:
    tank().wall(box={"low": (0.9, 0), "high": (1.2, 0.1)}).structure(box={"low": (1, 0.05), "high": (1.1, 0.4)}, material="steel", fix="y <= 0.11").deck()


def test_parts_do_not_reach_through_walls_of_the_box() -> None:
    assert "through a wall of the box from 0 to 2" in message(tank().structure(box={"low": (1.8, 0.1), "high": (2.1, 0.2)}, material="steel", title="beam"))
    tank().structure(box={"low": (1.8, 0.5), "high": (2.0, 1.5)}, material="steel").deck()  # out of the open top


def test_overlaps_in_space() -> None:
    post: dict[str, Any] = {"box": {"low": (0.5, 0.4, 0), "high": (0.6, 0.6, 0.4)}, "size": 0.05, "title": "post", **STEEL}
    assert "'post' and 'ball' overlap" in message(space().structure(**post).body(sphere={"centre": (0.7, 0.5, 0.3), "radius": 0.12}, density=500, title="ball"))
    space().structure(**post).body(sphere={"centre": (0.8, 0.5, 0.3), "radius": 0.12}, density=500).deck()


def test_elements_with_nodes_on_their_sides_are_taken_by_their_corners() -> None:
    mixed = _Cells(CUBE, tetra=[[0, 1, 2, 4]], tetra10=[[0, 1, 2, 4, 3, 3, 3, 3, 3, 3]])
    made = meshes.of_cells(tidied(cells_of(mixed)))
    assert made is not None and len(made.cells) == 2 and "1 elements of higher order taken by their corners" in made.notes[0]
    line = _Cells(CUBE, line=[[0, 1]])
    assert meshes.of_cells(cells_of(line)) is None
    assert "expected solids, triangles or quadrangles, got cells of type line\n  hint: a 'section' makes beams" in message(space().structure(line, material="steel"))


def test_gmsh_fills_a_closed_surface(tmp_path: Path) -> None:
    pytest.importorskip("gmsh", reason="gmsh is missing")
    pytest.importorskip("vtkmodules", reason="python3-vtk9 is missing")
    from .house import VOLUME, stl

    file = stl(tmp_path / "house.stl", turned=(1, 4))  # in millimetres
    scene = space().structure(file, scale=0.001, move=(0.5, 0.3, 0), material="wood", fix="bottom", size=0.05)
    made = scene._model().parts[-1].solids[0]
    assert abs(made.volumes().sum() / (VOLUME * 1e-9) - 1) < 0.01 and made.volumes().min() > 0
    assert scene.deck() == scene.deck()


def test_a_surface_without_gmsh_or_thickness_is_refused_with_both_hints(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    from .house import stl

    pytest.importorskip("vtkmodules", reason="python3-vtk9 is missing")
    monkeypatch.setitem(sys.modules, "gmsh", None)
    text = message(space().structure(stl(tmp_path / "house.stl"), scale=0.001, move=(0.5, 0.3, 0), material="wood"))
    assert "pip install gmsh" in text and "a surface with a 'thickness' is of shells" in text


def test_water_keeps_out_of_the_thickness_of_shells() -> None:
    plate = meshes.plate(np.zeros(3), np.array([1.0, 0, 0]), np.array([0, 1.0, 0]), np.full(3, 0.25))
    x = np.array([[0.5, 0.5, 0.05], [0.5, 0.5, -0.12], [1.05, 0.5, 0], [1.2, 0.5, 0], [1.08, 1.08, 0], [0.3, 0.9, 0.099]])
    assert NearSurface(plate.surface(), 0.1).contains(x).tolist() == [True, False, True, False, False, True]
    deck = tank().structure(line=[(0.1, 0), (0.1, 0.2)], thickness=0.04, material="rubber", fix="bottom").deck()
    assert "$   1 water: 40 particles" in deck  # ten columns less the two within 0.02 + 0.01 of the middle


# cards

def test_a_structure_is_a_part_with_section_material_and_contact() -> None:
    scene = tank().structure(box={"low": (1, 0), "high": (1.03, 0.3)}, material={"like": "steel", "yield": 3e8}, fix="bottom", track=[(1, 0.3)], title="post")
    deck = scene.deck()
    for text in ("$ Deformable parts", "*MAT_PLASTIC_KINEMATIC", "*SECTION_SOLID", "water against deformable parts", "*BOUNDARY_SPC_NODE", "*DATABASE_HISTORY_NODE", "*NODOUT"[1:]):
        assert text in deck
    explained = scene.explain()
    assert "'post': 45 solids, 8 nodes held" in explained and "makes steps shorter" in explained
    assert "yields at 3e+08" in explained


def test_yaml_and_python_are_the_same(tmp_path: Path) -> None:
    scene = space().structure(plate={"origin": (0.5, 0, 0), "edge1": (0, 1, 0), "edge2": (0, 0, 0.4)}, thickness=0.01, material="steel", fix="bottom")
    scene.body(sphere={"centre": (0.8, 0.5, 0.5), "radius": 0.1}, density=500, title="ball").joint("hinge", ["ball", "walls"], at=(0.8, 0.5, 0.9), axis=(0, 1, 0))
    scene.inlet(at=(0.2, 0.5, 0.8), direction=(1, 0, 0), speed="0.5 * sin(TIME)", radius=0.1)
    scene.to_yaml(tmp_path / "scene.yaml")
    text = (tmp_path / "scene.yaml").read_text().replace("spacing: 0.05", "spacing: 0.05\n  sound_speed: 50")
    made = written(tmp_path, text)
    assert made.deck, made.messages
    assert "*CONSTRAINED_JOINT_REVOLUTE" in made.deck and "*DEFINE_CURVE_FUNCTION" in made.deck and "*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID" in made.deck


@pytest.mark.parametrize(("keys", "said"), [
    ({"box": {"low": (1, 0), "high": (1.1, 0.3)}, "material": "stel"}, "material: 'stel' is not known\n  hint: did you mean steel?"),
    ({"box": {"low": (1, 0), "high": (1.1, 0.3)}}, "'material' is missing"),
    ({"box": {"low": (1, 0), "high": (1.1, 0.3)}, "material": "steel", "fix": "x > 3"}, "fix: no node of 'box' is there\n  hint: its nodes reach from (1, 0) to (1.1, 0.3)"),
    ({"box": {"low": (1, 0), "high": (1.1, 0.3)}, "material": "steel", "fix": "botom"}, "fix: unknown"),
    ({"box": {"low": (1, 0), "high": (1.1, 0.3)}, "material": "steel", "thickness": 0.1}, "thickness: of shells, and these are solids"),
    ({"box": {"low": (1, 0), "high": (1.1, 0.3)}, "material": "steel", "to": "walls"}, "'to' goes with 'fix'"),
    ({"box": {"low": (1, 0), "high": (1.1, 0.3)}, "material": "steel", "fix": "top", "to": "wals"}, "there is no wall or body 'wals'\n  hint: there are walls"),
    ({"line": [(1, 0), (1, 0.3)], "material": "steel"}, "'thickness' is missing"),
    ({"line": [(1, 0), (1, 0.3)], "thickness": 0.1, "material": {"density": 1000, "young": 1e6, "poisson": 0.5}}, "poisson: expected a number from 0 to below 0.5"),
    ({"line": [(1, 0), (1, 0.3)], "thickness": 0.1, "material": {"young": 1e6}}, "a material: 'density' is missing"),
    ({"cylinder": {"base": (0, 0, 0), "top": (0, 0, 1), "radius": 0.1}, "material": "steel"}, "deformable parts of the plane are boxes and lines"),
    ({"box": {"low": (1, 0, 0), "high": (1.1, 0.3, 1)}, "material": "steel"}, "low and high have 2 components"),
    ({"material": "steel"}, "expected one of box, cylinder")])
def test_mistakes_of_structures_are_named(keys: dict[str, Any], said: str) -> None:
    text = message(tank().structure(**keys))
    assert said in text and "test_scene_structures.py:" in text


@pytest.mark.parametrize(("kind", "between", "keys", "said"), [
    ("hnge", ["ball", "walls"], {"axis": (0, 1, 0)}, "did you mean hinge?"), ("hinge", ["ball", "walls"], {}, "'axis' is missing"),
    ("ball", ["ball", "wall"], {}, "there is no body or wall 'wall'"), ("ball", ["ball", "walls"], {"axis": (0, 1, 0)}, "a ball joint has none"),
    ("slider", ["ball", "ball"], {"axis": (0, 0, 1)}, "two different parts"), ("ball", ["ball", "walls"], {"stiffness": 3}, "'stiffness' goes with a hinge"),
    ("hinge", ["ball", "walls"], {"axis": (0, 0, 0)}, "expected a direction that is not zero")])
def test_mistakes_of_joints_are_named(kind: str, between: list[str], keys: dict[str, Any], said: str) -> None:
    scene = space().body(sphere={"centre": (0.5, 0.5, 0.5), "radius": 0.1}, density=500, title="ball")
    assert said in message(scene.joint(kind, between, at=(0.5, 0.5, 0.8), **keys))


def test_a_mistake_of_a_shape_or_a_joint_is_reported_alone() -> None:
    """What could not be read is not missing for joints and gauges as well."""
    ball = space().wall(title="ball", sphere={"centre": (0.5, 0.5, 0.3)}).gauge("f", force="ball").gauge("g", force="walls")
    assert message(ball).count("error") == 1 and "'radius' is missing" in message(ball)
    gate = {"title": "gate", "box": {"low": (0.2, 0.2, 0.5), "high": (0.4, 0.4, 0.7)}}
    at = {"between": ["gate", "walls"], "at": [0.2, 0.2, 0.5]}
    light = space().body(**gate).joint(kind="hinge", axis=[0, 1, 0], **at)
    assert message(light).count("error") == 1 and "its 'density'" in message(light)
    hing = space().body(**gate, density=500).joint(kind="hing", **at)
    assert message(hing).count("error") == 1 and "did you mean hinge" in message(hing)


@pytest.mark.parametrize(("scene", "said"), [
    (lambda: tank().inlet(at=(0.1, 0.5), direction=(1, 0), speed=1, radius=0.1), "unknown key 'radius'"),
    (lambda: tank().inlet(at=(0.1, 0.5), direction=(0, 0), speed=1, width=0.1), "a direction of the flow that is not zero"),
    (lambda: tank().inlet(at=(0.1, 0.5, 0), direction=(1, 0, 0), speed=1, width=0.1), "at and direction have 2 components"),
    (lambda: tank().inlet(at=(0.1, 0.5), direction=(1, 0), speed=0, width=0.1), "expected a speed, or a formula of TIME, > 0"),
    (lambda: tank().inlet(at=(0.1, 0.5), direction=(1, 0), speed="sin(TIME)", width=0.1), "'sound_speed' is missing"),
    (lambda: tank().inlet(at=(0.02, 0.5), direction=(1, 0), speed=1, width=0.1), "nearer than 2.5 spacings"),
    (lambda: tank().inlet(at=(1.98, 0.5), direction=(-1, 0), speed=1, width=0.1), "hint: at: [1.95, 0.5]"),
    (lambda: tank().outlet("right"), "an outlet on the side 'right', which has a wall"),
    (lambda: tank().outlet("rigth"), "side: 'rigth' is no side of the box"),
    (lambda: courant.Scene("x", spacing=0.1, end=1).water(low=(0, 0), high=(1, 1)).outlet("right"), "the scene has no box"),
    (lambda: tank().gas(low=(0, 0), high=(1, 1), density=1, pressure=1e5), "gases and water in one scene are not there"),
    (lambda: courant.Scene("x", spacing=0.1, end=1).gas(low=(0, 0), high=(1, 1), density=1, pressure=1, gamma=1), "gamma: expected a ratio"),
    (lambda: courant.Scene("x", spacing=0.1, end=1).gas(low=(0, 0), high=(1, 1), density=1, pressure=1).wall(line=[(0, 0), (1, 0)]), "'walls' beside gases")])
def test_mistakes_of_openings_and_gases_are_named(scene: Any, said: str) -> None:
    assert said in message(scene())


# runs

@needs_program
@pytest.mark.parametrize("kind", ["solids", "shells"])
def test_a_cantilever_bends_by_its_weight(tmp_path: Path, kind: str) -> None:
    length, thick, young, rho, g = 0.5, 0.05, 2e7, 1200.0, 9.81
    keys: dict[str, Any] = {"box": {"low": (1, 0.5), "high": (1 + length, 0.5 + thick)}} if kind == "solids" else {"line": [(1, 0.5), (1 + length, 0.5)], "thickness": thick}
    # Euler and Bernoulli's beam in plane strain, nu 0, and Timoshenko's shear: let go, its end moves between 0 and twice the deflection at rest
    rest = rho * g * length**4 / (8 * young * thick**2 / 12) + rho * g * length**2 / (2 * 5 / 6 * young / 2)
    period = 2 * math.pi * length**2 / 3.516 * math.sqrt(12 * rho / (young * thick**2))
    scene = tank(end=2 * period, output=period / 10).structure(material={"density": rho, "young": young, "poisson": 0}, fix="left", track=[(1 + length, 0.5)], **keys)
    run = scene.run(tmp_path / kind, threads=1, quiet=True)
    assert run.verdict == "sound", run.verdict_reasons
    end = run.track((1 + length, 0.5))
    assert abs(-end["displacement.y"].min() / (2 * rest) - 1) < 0.05
    assert abs(-np.trapz(end["displacement.y"], end["t"]) / end["t"][-1] / rest - 1) < 0.05


@needs_program
def test_dam_break_on_an_elastic_plate(tmp_path: Path) -> None:
    # Walhorn et al. 2005, Idelsohn et al. 2008: the end moves by 45 to 50 mm near 0.25 s
    scene = courant.Scene("dam break on an elastic plate", spacing=0.0073, end=0.3, output=0.05)
    scene.water(low=(0, 0), high=(0.146, 0.292)).box(low=(0, 0), high=(0.584, 0.45), open=["top"])
    scene.structure(box={"low": (0.292, 0), "high": (0.304, 0.08)}, material={"density": 2500, "young": 1e6, "poisson": 0}, fix="bottom", track=[(0.292, 0.08)])
    run = scene.run(tmp_path / "plate", threads=1, quiet=True)
    assert run.verdict == "sound", run.verdict_reasons
    moved = run.track((0.292, 0.08))
    most = int(np.argmax(moved["displacement.x"]))
    assert abs(moved["displacement.x"][most] / 0.0475 - 1) < 0.1 and 0.2 < moved["t"][most] < 0.3


@needs_program
def test_still_water_weighs_on_a_plate(tmp_path: Path) -> None:
    # the plate is half a spacing away, so the level falls by up to 2.5 %: rho g h^2 / 2 is known within 5 %
    scene = courant.Scene("still water against a plate", spacing=0.02, end=0.6, output=0.1).water(low=(0, 0), high=(0.4, 0.2))
    scene.box(low=(0, 0), high=(0.8, 0.4), open=["top"]).gauge("load", force="plate")
    scene.structure(box={"low": (0.41, 0), "high": (0.45, 0.3)}, material={"density": 2000, "young": 1e7}, fix="bottom", title="plate")
    run = scene.run(tmp_path / "still", threads=1, quiet=True)
    load = run.gauges["load"]["force.x"]
    assert run.verdict == "sound" and abs(load[len(load) // 2 :].mean() / (0.5 * 9810 * 0.2**2) - 1) < 0.05


@needs_program
def test_a_body_on_a_hinge_swings_as_a_pendulum(tmp_path: Path) -> None:
    # a rod of length L, hinged at one end, let go at a small angle: T = 2 pi sqrt(2 L / 3 g)
    length, angle = 0.4, 0.1
    period = 2 * math.pi * math.sqrt(2 * length / (3 * 9.81))
    scene = tank(end=1.1 * period, output=period / 20).body(box={"low": (-0.005, -length), "high": (0.005, 0)}, density=2000, title="rod", turn=math.degrees(angle), move=(1, 0.9))
    scene.joint("hinge", ["rod", "walls"], at=(1, 0.9))
    run = scene.run(tmp_path / "rod", threads=1, quiet=True)
    assert not run.diagnostics.all  # of bodies that fall through the floor, which this one does not
    x = run.histories.table("rigid_bodies/101")
    side = x["x.x"] - 1
    assert abs(side[0] - length / 2 * math.sin(angle)) < 1e-3
    turns = np.flatnonzero((side[1:] > 0) != (side[:-1] > 0))
    half = x["t"][turns[1]] - x["t"][turns[0]]
    assert abs(half / (period / 2) - 1) < 0.02


@needs_program
def test_a_hinge_with_a_spring(tmp_path: Path) -> None:
    # the rod of the pendulum with a spring that is slack at the start: omega^2 = (k + m g L / 2) / (m L^2 / 3)
    length, angle, k = 0.4, 0.1, 40.0
    m = 2000 * 0.01 * length
    period = 2 * math.pi / math.sqrt((k + m * 9.81 * length / 2) / (m * length**2 / 3))
    scene = tank(end=1.1 * period, output=period / 20).body(box={"low": (-0.005, -length), "high": (0.005, 0)}, density=2000, title="rod", turn=math.degrees(angle), move=(1, 0.9))
    run = scene.joint("hinge", ["rod", "walls"], at=(1, 0.9), stiffness=k).run(tmp_path / "rod", threads=1, quiet=True)
    omega = run.histories.table("rigid_bodies/101")
    back = np.flatnonzero((omega["omega.z"][2:] > 0) != (omega["omega.z"][1:-1] > 0))  # where it turns back
    assert abs(omega["t"][back[0] + 2] / (period / 2) - 1) < 0.02


@needs_program
def test_water_enters_in_space(tmp_path: Path) -> None:
    def entering(**keys: Any) -> float:
        scene = courant.Scene("jet", spacing=0.025, end=0.2, output=0.1).box(low=(0, 0, 0), high=(1, 0.5, 0.8), open=["top"])
        run = scene.inlet(at=(0.1, 0.25, 0.6), direction=(1, 0, 0), speed=1.0, **keys).run(tmp_path / "jet", threads=1, quiet=True)
        return float(run.summary["active_particles"] * 0.025**3)

    assert abs(entering(sides=(0.1, 0.2)) / (0.02 * 0.2) - 1) < 0.15  # one layer in eight
    assert abs(entering(radius=0.1) / (math.pi * 0.01 * 0.2) - 1) < 0.2  # and the squares of a circle


@needs_program
def test_a_part_goes_with_a_driven_wall(tmp_path: Path) -> None:
    scene = tank(end=0.5).wall(line=[(1, 0.6), (1.2, 0.6)], motion={"y": "0.05 * (1 - COS(2*PI*TIME/0.5))"}, title="driven")
    keys = {"thickness": 0.01, "material": {"density": 1000, "young": 5e7, "poisson": 0}}
    scene.structure(line=[(1.2, 0.6), (1.4, 0.6)], fix="left", to="driven", track=[(1.2, 0.6)], **keys)  # type: ignore[arg-type]
    held = scene.run(tmp_path / "strip", threads=1, quiet=True).track((1.2, 0.6))
    assert np.abs(held["displacement.y"] - 0.05 * (1 - np.cos(2 * math.pi * held["t"] / 0.5))).max() < 1e-6


@needs_program
def test_an_inlet_fills_a_tank(tmp_path: Path) -> None:
    scene = courant.Scene("filling", spacing=0.02, end=0.6, output=0.1).box(low=(0, 0), high=(1, 0.6), open=["top"])
    run = scene.inlet(at=(0.05, 0.4), direction=(1, 0), width=0.1, speed=1.0).run(tmp_path / "filling", threads=1, quiet=True)
    area = run.summary["active_particles"] * 0.02**2
    assert abs(area - 0.1 * 1.0 * 0.6) <= 0.1 * 0.02 + 1e-9  # one layer
    assert run.verdict == "sound", run.verdict_reasons


@needs_program
def test_water_leaves_by_an_outlet(tmp_path: Path) -> None:
    scene = courant.Scene("leaving", spacing=0.02, end=1.2, output=0.1, velocity=(1, 0)).water(low=(0, 0), high=(0.4, 0.1))
    run = scene.box(low=(0, 0), high=(0.6, 0.4), open=["top", "left", "right"]).outlet("right").run(tmp_path / "leaving", threads=1, quiet=True)
    assert len(run.states[0].points) == 100 and len(run.states[-1].points) < 50
    assert run.states[-1].points[:, 0].max() < 0.62


@needs_program
def test_still_water_keeps_the_level_of_an_outlet(tmp_path: Path) -> None:
    scene = courant.Scene("level", spacing=0.02, end=1.5, output=0.1).water(low=(0, 0), high=(1, 0.2))
    scene.box(low=(0, 0), high=(1, 0.4), open=["top", "right"]).outlet("right", level=0.2).gauge("depth", level=[(0.5, 0), (0.5, 0.4)])
    run = scene.run(tmp_path / "level", threads=1, quiet=True)
    assert abs(run.gauges["depth"]["level"][-20:].mean() / 0.2 - 1) < 0.05
    assert not [one for one in run.diagnostics.all if one.severity == "warning"]


@needs_program
def test_shock_tube(tmp_path: Path) -> None:
    scene = courant.Scene("shock tube", spacing=0.005, end=0.2, output=0.2)
    scene.gas(low=(-0.5, 0), high=(0, 0.04), density=1, pressure=1).gas(low=(0, 0), high=(0.5, 0.04), density=0.125, pressure=0.1)
    run = scene.box(low=(-0.5, 0), high=(0.5, 0.04)).run(tmp_path / "tube", threads=1, quiet=True)
    exact = np.loadtxt(HERE.parents[2] / "verification" / "data" / "sod_exact_t0.2.csv", delimiter=",", skiprows=2)
    last = run.states[-1]
    x = last.points[:, 0]
    # bounds of tests/verification/suite.yaml: mean error of the density, pressure behind the shock
    assert np.abs(last["density"] - np.interp(x, exact[:, 0], exact[:, 1])).mean() < 0.012
    behind = last["pressure"][(x > 0.22) & (x < 0.30)]
    assert abs(behind.mean() / 0.303130 - 1) < 0.02


@needs_program
def test_water_that_falls_out_of_the_scene_is_reported(tmp_path: Path) -> None:
    def falling() -> courant.Scene:
        made = courant.Scene("falling", spacing=0.05, end=1, output=0.5, sound_speed=60)
        return made.water(low=(0, 0), high=(0.5, 0.5)).box(low=(0, 0), high=(0.5, 1), open=["top", "bottom"])

    run = falling().run(tmp_path / "hole", threads=1, quiet=True)
    assert run.verdict == "doubtful" and run.summary["counters"]["outside_the_scene"] == 100
    assert "100 particles left the scene" in "".join(run.verdict_reasons)
    ended = falling().outlet("bottom").run(tmp_path / "outlet", threads=1, quiet=True)
    assert "outside_the_scene" not in ended.summary["counters"] and ended.summary["active_particles"] == 0


# pages

def _examples() -> list[str]:
    text = (HERE.parents[3] / "docs" / "scenes.md").read_text()
    return [block.split("```")[0] for block in text.split("```yaml\n")[1:] if block.startswith("title:") and "file:" not in block.split("```")[0]]


@pytest.mark.parametrize("scene", _examples(), ids=lambda scene: scene.split("\n")[0][7:])
def test_scenes_of_the_page_become_decks(tmp_path: Path, scene: str) -> None:
    made = written(tmp_path, scene)
    assert made.deck and "warning" not in made.messages, made.messages
    if os.environ.get("COURANT_EXECUTABLE"):
        assert courant.check(tmp_path / "deck.k").errors == 0
