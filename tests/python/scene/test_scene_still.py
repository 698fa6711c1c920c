"""Water at rest between walls of any shape: what it leaves free beside them, its pressure at the start, and its wall method."""
from __future__ import annotations

import os
from pathlib import Path

import courant
import numpy as np
import pytest
from courant.scene.distances import distances
from courant.scene.shapes import box, plate, polyline

needs_program = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


def particles(scene: courant.Scene) -> np.ndarray:
    """Positions of the water, (n, 3)."""
    deck = scene.deck()
    count = int(deck.split(": ")[deck[: deck.index(" particles")].count(": ")].split(" particles")[0])
    lines = deck.split("*NODE\n")[1].splitlines()[1 : count + 1]
    return np.array([[float(line[8 + 16 * k : 24 + 16 * k]) for k in range(3)] for line in lines])


def valley(angle: float, rows: int = 24, filled: float = 0.48, **keys: object) -> courant.Scene:
    """Filled up to its walls."""
    half = 0.48 / np.tan(np.radians(angle))
    part = filled / 0.48
    scene = courant.Scene("V tank", **({"spacing": 0.48 / rows, "end": 1, "output": 0.05} | keys))  # type: ignore[arg-type]
    return scene.water([(0, 0), (part * half, filled), (-part * half, filled)]).wall(line=[(-1.5 * half, 0.72), (0, 0), (1.5 * half, 0.72)])


def trough(**keys: object) -> courant.Scene:
    """One in space, of two plates between the open ends of a box."""
    scene = courant.Scene("trough", **({"spacing": 0.04, "end": 0.4, "output": 0.05} | keys))  # type: ignore[arg-type]
    scene.water(low=(0, -0.24, 0), high=(0.16, 0.24, 0.24), where="z > abs(y) + 0.001").box(low=(0, -0.4, -0.04), high=(0.16, 0.4, 0.4), open=["top"])
    for side in (-1, 1):
        scene.wall(plate={"origin": (0, 0, 0), "edge1": (0.16, 0, 0), "edge2": (0, side * 0.4, 0.4)})
    return scene


def test_distances_are_those_from_each_face() -> None:
    random = np.random.default_rng(1)
    x = random.uniform(-0.5, 1.5, (150, 3))
    t = np.linspace(0, 1, 201)
    triangle = plate(np.zeros(3), np.array([1.0, 0, 0.2]), np.array([0.3, 1.0, 0]))
    near = distances(triangle, x, 0.4)
    a, b = np.meshgrid(t, t)
    on = a.reshape(-1, 1) * np.array([1.0, 0, 0.2]) + b.reshape(-1, 1) * np.array([0.3, 1.0, 0])
    brute = np.linalg.norm(x[:, None] - on[None], axis=2).min(axis=1)
    assert np.allclose(near[brute < 0.39], brute[brute < 0.39], atol=6e-3) and np.isinf(near[brute > 0.41]).all()
    flat = x * [1, 1, 0]
    line = distances(polyline(np.array([[0, 0], [1, 0], [1, 1]]), closed=False), flat, 0.4)
    to_first, to_second = (np.linalg.norm(flat[:, None] - np.stack(p, axis=1)[None], axis=2).min(axis=1) for p in ((t, 0 * t, 0 * t), (0 * t + 1, t, 0 * t)))
    brute = np.minimum(to_first, to_second)
    assert np.allclose(line[brute < 0.39], brute[brute < 0.39], atol=3e-3) and np.isinf(line[brute > 0.41]).all()
    assert not len(distances(triangle, x[:0], 0.4)) and np.isinf(distances(box(np.zeros(3), np.ones(3), 3), x + 9, 0.4)).all()


@pytest.mark.parametrize("method,gap", [("mirrors", 0.5), ("contact", 0.5), ("ghosts", 0.2)])
def test_water_keeps_free_of_line_walls(method: str, gap: float) -> None:
    for angle in (20, 26.565, 45, 70):
        x = particles(valley(angle, wall_method=method))
        off = (x[:, 1] * np.cos(np.radians(angle)) - np.abs(x[:, 0]) * np.sin(np.radians(angle))) / 0.02
        assert gap - 1e-5 <= off.min() < gap + 0.51


def test_water_keeps_free_of_plates_and_thin_lines() -> None:
    x = particles(trough(wall_method="mirrors"))
    assert np.min(x[:, 2] - np.abs(x[:, 1])) / np.sqrt(2) > 0.5 * 0.04 * (1 - 1e-5)
    scene = courant.Scene("baffle", spacing=0.02, end=1).water(low=(0, 0), high=(0.4, 0.2)).box(low=(0, 0), high=(0.4, 0.4))
    whole = len(particles(scene))
    assert len(particles(scene.wall(line=[(0.2, 0), (0.2, 0.1)]))) == whole  # between two columns
    assert len(particles(scene.wall(line=[(0.11, 0.05), (0.11, 0.3)]))) == whole - 8  # on a column, from y 0.05 to 0.2


@needs_program
@pytest.mark.parametrize("angle", [26.565, 45])
def test_a_valley_filled_up_to_its_walls_stays_at_rest(angle: float, tmp_path: Path) -> None:
    """Bounds, set beforehand: rms pressure 3 % of rho g H in the second half, speed after 1 s 0.05 sqrt(gH)."""
    run = valley(angle).run(tmp_path, threads=1, quiet=True)
    assert run.verdict == "sound"
    errors = [state["pressure"] / (9810 * 0.48) - (1 - state.points[:, 1] / 0.48) for state in run.states if state.t > 0.5]
    assert np.sqrt(np.mean(np.concatenate(errors) ** 2)) < 0.03
    assert run.states[-1]["speed"].max() < 0.05 * np.sqrt(9.81 * 0.48)


def test_ghosts_are_for_water_that_nothing_moves() -> None:
    def ghosts(scene: courant.Scene) -> bool:
        return "walls have ghost particles behind them" in scene.explain()

    assert ghosts(valley(45)) and not ghosts(trough()) and ghosts(valley(45).keywords("*CONTROL_TIMESTEP\n         0       0.4\n"))
    assert "nothing moves it" in valley(45).explain() and "9810 * (0.48 - y)" in valley(45).explain()
    assert not ghosts(valley(45, wall_method="mirrors")) and "wall_method: ghosts keeps it at rest" in valley(45, wall_method="mirrors").explain()
    assert not ghosts(valley(45).body(circle={"centre": (0, 0.5), "radius": 0.06}, density=500))
    assert not ghosts(valley(45).keywords("*LOAD_BODY_X\n         1       1.0\n"))
    assert not ghosts(valley(45, velocity=(0.1, 0)))
    assert not ghosts(valley(45).wall(line=[(0, 0.3), (0, 0.6)]))  # water on both sides
    assert not ghosts(courant.Scene("box", spacing=0.02, end=1).water(low=(0, 0), high=(0.4, 0.2)).box(low=(0, 0), high=(0.4, 0.4)))  # no oblique wall


def test_a_slope_with_a_free_side_of_water_has_mirrors_and_no_pressure() -> None:
    half = courant.Scene("release", spacing=0.02, end=1).water([(0, 0), (0, 0.4), (-0.4, 0.4)]).wall(line=[(-0.6, 0.6), (0, 0), (0.6, 0.6)])
    assert "walls are mirrors" in half.explain() and "no pressure at the start" in half.explain()
    drop = courant.Scene("drop", spacing=0.02, end=1).water([(-0.1, 0.3), (0.1, 0.3), (0.1, 0.5), (-0.1, 0.5)]).wall(line=[(-0.6, 0.6), (0, 0), (0.6, 0.6)])
    assert "walls are mirrors" in drop.explain() and "no pressure at the start" in drop.explain()
    heap = courant.Scene("heap", spacing=0.02, end=1).water([(0, 0), (0.4, 0.4), (0, 0.5), (-0.4, 0.4)]).wall(line=[(-0.6, 0.6), (0, 0), (0.6, 0.6)])
    assert "walls are mirrors" in heap.explain() and "no pressure at the start" in heap.explain()


def test_a_covered_step_has_the_pressure_of_its_level() -> None:
    scene = courant.Scene("L tank", spacing=0.02, end=1).water(low=(0, 0), high=(0.6, 0.2)).water(low=(0, 0.2), high=(0.2, 0.6))
    scene.box(low=(0, 0), high=(0.6, 0.8))
    assert "no pressure at the start" in scene.explain()  # the wide part has a surface of its own
    scene.wall(line=[(0.2, 0.2), (0.6, 0.2)]).wall(line=[(0.2, 0.2), (0.2, 0.8)])
    assert "pressure at the start 9810 * (0.6 - y)" in scene.explain() and "walls are mirrors" in scene.explain()
