"""Scenes without water: what is refused, what a deck holds, and runs against theory. All runs together take 12 s of processor time."""
from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

import courant
import numpy as np
import pytest
from courant.scene import shapes

from .made import written

needs_program = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")
FLOOR: dict[str, Any] = {"box": {"low": (-0.5, -0.5, -0.1), "high": (0.5, 0.5, 0)}, "title": "floor"}
STEEL = {"density": 7850, "young": 210e9, "poisson": 0.3}
PLATE: dict[str, Any] = {"plate": {"origin": (-0.3, -0.3, 0), "edge1": (0.6, 0, 0), "edge2": (0, 0.6, 0)}, "thickness": 0.005, "size": 0.03,
                         "fix": ["left", "right", "front", "back"], "title": "plate", "track": [(0, 0, 0)]}


def drop(**keys: Any) -> courant.Scene:
    return courant.Scene("drop", **({"end": 0.6} | keys)).wall(**FLOOR).body(sphere={"centre": (0, 0, 0.6), "radius": 0.1}, density=7850, title="ball")


def message(scene: courant.Scene) -> str:
    with pytest.raises(courant.CourantError) as fault:
        scene.deck()
    return str(fault.value)


def run(scene: courant.Scene, folder: Path) -> Any:
    found = scene.run(folder, threads=1, quiet=True)
    assert found.verdict == "sound", found.verdict_reasons
    return found


def falls(values: Any, times: Any) -> np.ndarray:
    """Times at which values cross zero, interpolated."""
    k = np.flatnonzero((values[1:] > 0) != (values[:-1] > 0))
    crossed: np.ndarray = times[k] + (times[k + 1] - times[k]) * values[k] / (values[k] - values[k + 1])
    return crossed


# decks

def test_a_deck_has_no_particles_and_contacts_of_all_that_can_touch() -> None:
    scene = drop().body(box={"low": (0.2, 0.2, 0.1), "high": (0.3, 0.3, 0.2)}, density=500, title="block").structure(**PLATE | {"fix": "x < 0"}, material="steel", move=(0, 0, 0.3))
    deck = scene.deck()
    assert not any(word in deck for word in ("SPH", "MAT_NULL", "NODES_TO_SURFACE", "COURANT_"))
    assert [deck.count(kind) for kind in ("SURFACE_TO_SURFACE_ID", "SINGLE_SURFACE_ID", "*MAT_RIGID", "*PART_INERTIA")] == [3, 1, 3, 2]
    explained = scene.explain()
    for text in ("no water", "spacing 0.01", "a tenth of the smallest part", "Young's modulus 2.", "'ball' weighs 32.88", "'floor' is held", "friction 0", "'plate' sets the step", "states each"):
        assert text in explained, text


def test_parts_in_one_joint_do_not_touch() -> None:
    chain = courant.Scene("chain", end=1).wall(box={"low": (-0.1, -0.1, 0), "high": (0.1, 0.1, 0.1)}, title="support")
    for k, title in enumerate(("a", "b", "c")):
        chain.body(box={"low": (-0.02, -0.02, -0.4 * (k + 1)), "high": (0.02, 0.02, -0.4 * k)}, density=7850, title=title)
    for a, b, z in (("a", "support", 0), ("a", "b", -0.4), ("b", "c", -0.8)):
        chain.joint("hinge", [a, b], at=(0, 0, z), axis=(0, 1, 0))
    deck = chain.deck()
    sets = dict(zip((102, 103), [text.split("\n")[3].split() for text in deck.split("*SET_PART_LIST\n")[1:] if text.split("\n")[1].strip() in ("1102", "1103")]))
    assert "      1101\n" not in deck and sets == {102: ["12"], 103: ["12", "101"]}


def test_yaml_and_python_are_the_same(tmp_path: Path) -> None:
    scene = drop(friction=0.2).structure(**PLATE, material={"like": "steel", "yield": 250e6, "tangent": 1e9}, move=(0, 0, 0.2))
    text = scene.to_yaml()
    made = written(tmp_path, text)
    assert made.deck and "water" not in text and made.deck.split("*KEYWORD")[1] == scene.deck().split("*KEYWORD")[1]


@pytest.mark.parametrize(("gravity", "density", "young"), [(None, 7850, "2.1e11"), (9810, 7.85e-9, "210000"), (9810, 7.85e-6, "210000000"), (9.81e-3, 7.85e-6, "210"),
                                                           (981, 7.85, "2.1e12"), (0, 2700, "2.1e11"), (1.62, 2700, "2.1e11")])
def test_rigid_parts_are_steel_in_the_units_of_the_scene(gravity: float | None, density: float, young: str) -> None:
    scene = courant.Scene("units", end=1, gravity=gravity).wall(plate={"origin": (0, 0, 0), "edge1": (1, 0, 0), "edge2": (0, 1, 0)})
    deck = scene.body(box={"low": (0.3, 0.3, 0.001), "high": (0.4, 0.4, 0.01)}, density=density, title="block").deck()
    assert deck.count(young.rjust(10) + "       0.3\n") == 2


@pytest.mark.parametrize(("scene", "said"), [
    (lambda: drop(density=1000), "leave out 'density'"), (lambda: drop(sound_speed=30, viscosity=0.1), "leave out 'sound_speed', 'viscosity'"),
    (lambda: drop(wall_method="ghosts"), "'wall_method' needs water"), (lambda: drop().gauge("p", point=(0, 0, 0)), "'gauges' needs water"),
    (lambda: drop().damping((0, 0, 0), (1, 0, 0), 5), "'damping' needs water"), (lambda: drop().outlet("top"), "'outlets' needs water"),
    (lambda: drop(friction=-1), "friction: expected a coefficient >= 0"), (lambda: drop(gravity=-1), "gravity: expected its size"),
    (lambda: drop().body(box={"low": (0, 0, 0.55), "high": (0.3, 0.3, 0.7)}, density=500, title="block"), "'ball' and 'block' overlap"),
    (lambda: drop(gravity=9810).structure(**PLATE, material="steel"), "numbers of 'steel' are those of SI units, and gravity 9810 is not"),
    (lambda: drop().structure(**PLATE, material="stel"), "did you mean steel"),
    (lambda: drop().box(low=(0, 0, 0), high=(1, 1, 0)), "box: it has no walls"),
    (lambda: drop().body(box={"low": (0, 0), "high": (1, 1)}, density=500), "a shape of 2 dimensions in a scene of 3"),
    (lambda: courant.Scene("walls", end=1).wall(**FLOOR), "nothing moves"),
    (lambda: drop(end=-1), "end: expected a time > 0"),
    (lambda: courant.Scene("plane", end=1).wall(line=[(0, 0), (1, 0)]).body(circle={"centre": (0.5, 0.5), "radius": 0.1}, density=500), "give points of three components"),
    (lambda: drop().wall(plate={"origin": (2, 0, 0), "edge1": (0, 1, 0), "edge2": (0, 0, 1)}, motion={"waves": {"kind": "regular", "depth": 0.5, "height": 0.1, "period": 1}}), "waves need water"),
    (lambda: courant.Scene("wet", spacing=0.1, end=1, friction=0.1).water(low=(0, 0), high=(1, 1)), "friction: of parts in scenes without water")])
def test_mistakes_are_named_with_their_line(scene: Any, said: str) -> None:
    text = message(scene())
    assert said in text and "test_scene_dry.py:" in text


def test_water_without_blocks_is_no_dry_scene(tmp_path: Path) -> None:
    made = written(tmp_path, "water: {spacing: 0.1}\nbodies: [{box: {low: [0, 0, 0], high: [1, 1, 1]}, density: 500}]\nend: 1\n")
    assert not made.deck and "scene.yaml:1:" in made.messages and "the scene has none" in made.messages


def test_refined_surfaces_are_the_same_closed_surfaces() -> None:
    for shape in (shapes.box(np.zeros(3), np.array([1.0, 2.0, 0.1]), 3), shapes.sphere(np.zeros(3), 1.0, 0.5, 3)):
        fine = shapes.refined(shape, 0.17)
        sides = np.linalg.norm(fine.points[fine.faces] - fine.points[np.roll(fine.faces, 1, axis=1)], axis=2)
        assert sides.max() <= 0.17 and sides.min() > 0.005 and abs(fine.volume() / shape.volume() - 1) < 1e-12
        assert not len(shapes.faulty_edges(fine).free) and not len(shapes.faulty_edges(fine).crowded)
        inner = shapes.shrunk(fine, 0.002)
        assert np.abs((fine.high - inner.high) - 0.002).max() < 1e-4 and np.abs((fine.low - inner.low) + 0.002).max() < 1e-4


# runs

@needs_program
def test_a_ball_falls_and_rebounds(tmp_path: Path) -> None:
    ball = run(drop(output=0.02), tmp_path / "ball").histories.table("rigid_bodies/101")
    flying = ball["t"] < 0.3
    fallen = 0.6 - ball["x.z"][flying]
    assert np.abs(fallen - 9.81 / 2 * ball["t"][flying] ** 2).max() <= 1e-3 * fallen.max()
    assert abs(ball["v.z"].max() / -ball["v.z"].min() - 1) < 0.02
    assert ball["x.z"].min() > 0.09 and ball["x.z"][-1] > 0.4  # neither through the floor nor held by it


@needs_program
@pytest.mark.parametrize("kind", ["solids", "shells"])
def test_a_cantilever_in_space_has_its_period(tmp_path: Path, kind: str) -> None:
    # first frequency of Euler's beam with 20 elements along it; let go, its end moves to twice the deflection at rest
    length, thick = 1.0, 0.05
    keys: dict[str, Any] = {"box": {"low": (0, 0, 0), "high": (length, thick, thick)}, "size": (0.05, 0.025, 0.0125)}
    if kind == "shells":
        keys = {"plate": {"origin": (0, 0, 0), "edge1": (length, 0, 0), "edge2": (0, thick, 0)}, "size": 0.05, "thickness": thick}
    period = 2 * math.pi * length**2 / 3.516 * math.sqrt(12 * 7850 / (210e9 * thick**2))
    scene = courant.Scene("cantilever", end=3.2 * period, output=period / 10).structure(**keys, material=STEEL, fix="left", track=[(length, 0, 0)])
    end = run(scene, tmp_path / kind).track((length, 0, 0))
    crossed = falls(end["displacement.z"] - end["displacement.z"].mean(), end["t"])
    assert abs(2 * np.diff(crossed).mean() / period - 1) < 0.03
    rest = 7850 * 9.81 * length**4 / (8 * 210e9 * thick**2 / 12)
    assert abs(-end["displacement.z"].min() / (2 * rest) - 1) < 0.03


@needs_program
def test_a_cantilever_of_the_plane(tmp_path: Path) -> None:
    scene = courant.Scene("plane", end=0.03, output=0.003)
    scene.structure(box={"low": (0, 0), "high": (1, 0.05)}, size=(0.05, 0.0125), material=STEEL | {"poisson": 0}, fix="left", track=[(1, 0)])
    rest = 7850 * 9.81 / (8 * 210e9 * 0.05**2 / 12)
    assert abs(-run(scene, tmp_path / "plane").track((1, 0))["displacement.y"].min() / (2 * rest) - 1) < 0.03


@needs_program
@pytest.mark.parametrize("material", ["steel", {"like": "steel", "yield": 250e6, "tangent": 1e9}])
def test_a_block_strikes_a_clamped_plate(tmp_path: Path, material: Any) -> None:
    scene = courant.Scene("block", end=0.003, output=0.0003).structure(**PLATE, material=material)
    scene.structure(box={"low": (-0.05, -0.05, 0.01), "high": (0.05, 0.05, 0.11)}, size=0.025, material="steel", velocity=(0, 0, -10), title="block")
    found = run(scene, tmp_path / "block")
    energy = found.summary["energy"]
    assert abs(energy["residual"]) < 0.01 * energy["initial"]
    assert found.track((0, 0, 0))["displacement.z"].min() < -0.005  # it was struck


@needs_program
def test_a_rod_on_a_hinge_has_the_period_of_a_pendulum(tmp_path: Path) -> None:
    length, wide, angle = 0.4, 0.02, 0.1
    about_end = (length**2 + wide**2) / 12 + length**2 / 4
    period = 2 * math.pi * math.sqrt(about_end / (9.81 * length / 2)) * (1 + angle**2 / 16)
    scene = courant.Scene("pendulum", end=1.4 * period, output=period / 20).wall(box={"low": (-0.1, -0.1, -0.005), "high": (0.1, 0.1, 0.1)}, title="support")
    scene.body(box={"low": (-wide / 2, -wide / 2, -length), "high": (wide / 2, wide / 2, 0)}, density=7850, title="rod", turn=(0, math.degrees(angle), 0))
    rod = run(scene.joint("hinge", ["rod", "support"], at=(0, 0, 0), axis=(0, 1, 0)), tmp_path / "rod").histories.table("rigid_bodies/101")
    assert abs(2 * np.diff(falls(rod["x.x"], rod["t"])).mean() / period - 1) < 0.005


@needs_program
@pytest.mark.parametrize("friction", [0.0, 0.2, 0.7])
def test_a_block_on_an_incline(tmp_path: Path, friction: float) -> None:
    scene = courant.Scene("incline", end=0.2, output=0.02, friction=friction, spacing=0.04).wall(box={"low": (-1, -0.5, -0.1), "high": (0.5, 0.5, 0)}, turn=(0, -30, 0), title="incline")
    block = run(scene.body(box={"low": (-0.1, -0.1, 0), "high": (0.1, 0.1, 0.1)}, density=7850, turn=(0, -30, 0), title="block"), tmp_path / "slide")
    x = block.histories.table("rigid_bodies/101")
    path = math.hypot(x["x.x"][-1] - x["x.x"][0], x["x.z"][-1] - x["x.z"][0])
    expected = max(0.0, 9.81 / 2 * 0.2**2 * (math.sin(math.radians(30)) - friction * math.cos(math.radians(30))))
    assert abs(path - expected) < 0.01 * 9.81 / 2 * 0.2**2


@needs_program
def test_a_house_of_stl_falls_on_a_plate(tmp_path: Path) -> None:
    from .house import VOLUME, stl

    pytest.importorskip("vtkmodules", reason="python3-vtk9 is missing")
    mass, speed = 500 * VOLUME * 1e-9, 5.0
    scene = courant.Scene("house", end=0.01, output=0.001).structure(**PLATE | {"thickness": 0.01, "size": 0.06}, material={"like": "aluminium", "yield": 100e6, "tangent": 0.7e9})
    scene.body(stl(tmp_path / "house.stl"), scale=0.001, move=(-0.2, -0.15, 0.02), density=500, velocity=(0, 0, -speed), title="house")
    found = run(scene, tmp_path / "house")
    house, energy = found.histories.table("rigid_bodies/101"), found.summary["energy"]
    assert abs(energy["initial"] / (mass * (speed**2 / 2 + 9.81 * house["x.z"][0])) - 1) < 1e-3
    assert house["v.z"].max() > -0.5 * speed and found.track((0, 0, 0))["displacement.z"].min() < -0.002
    assert house["x.z"].min() > 0.1  # it is on the plate
    assert abs(energy["residual"]) < 0.01 * energy["initial"]


@needs_program
def test_a_driven_wall_pushes_a_block(tmp_path: Path) -> None:
    # an elastic impact at 0.2 doubles the speed of the wall, and friction slows the block
    scene = courant.Scene("pusher", spacing=0.04, end=0.35, output=0.02, friction=0.3).wall(**FLOOR)
    scene.wall(box={"low": (-0.4, -0.2, 0.01), "high": (-0.3, 0.2, 0.1)}, motion={"x": "0.5 * TIME"}, title="pusher")
    scene.body(box={"low": (-0.2, -0.1, 0), "high": (0, 0.1, 0.1)}, density=1000, title="block")
    block = run(scene, tmp_path / "pusher").histories.table("rigid_bodies/101")
    moved = 2 * 0.5 * 0.15 - 0.3 * 9.81 / 2 * 0.15**2
    assert abs(block["x.x"][-1] - (-0.1 + moved)) < 0.05 * moved
