"""Walls of scenes that turn, gauges of several parts, and inflows of channels: cards, mistakes and short runs."""
from __future__ import annotations

import math
import os
from typing import Any

import courant
import numpy as np
import pytest

needs_program = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


def said(scene: courant.Scene) -> str:
    with pytest.raises(courant.CourantError) as fault:
        scene.deck()
    return str(fault.value).partition("error: ")[2]


def mixer(**rotation: Any) -> courant.Scene:
    scene = courant.Scene("mixer", spacing=0.05, end=1).water(low=(0, 0), high=(1, 0.5)).box(low=(0, 0), high=(1, 1), open="top")
    return scene.wall(line=[[0.3, 0.3], [0.7, 0.3]], title="blade", motion={"rotation": {"about": [0.5, 0.3]} | rotation})


@pytest.mark.parametrize(("keys", "text"), [
    ({}, "rotation: expected one of angle, speed, rpm, got none"), ({"speed": 3, "rpm": 2}, "got speed and rpm"), ({"angle": 30}, "angle: a constant one, 30, is no motion"),
    ({"angle": "30 + TIME"}, "angle: it is 30 at the start"), ({"speed": 3, "axis": [0, 0, 1]}, "axis: in the plane walls turn about z"),
    ({"speed": "3 * TIMES"}, "speed: unknown name 'TIMES'"), ({"angle": "sin(TIME)", "ramp": 1}, "ramp: the time in which a constant"),
    ({"speed": 3, "about": [0.5, 0.3, 0]}, "about: expected 2 components"), ({"speed": 360, "about": [0.4, 0.2]}, "rotation: the wall goes through the side 'bottom'")])
def test_mistakes(keys: dict[str, Any], text: str) -> None:
    assert text in said(mixer(**keys))


def test_cards_and_choices() -> None:
    scene = mixer(rpm=15, ramp=0.5)
    cards = scene.deck()
    assert "*PART_INERTIA" in cards and f"{12:10}{7:10}{0:10}" in cards and "'blade' turns about (0.5, 0.3, 0)" in scene.explain()
    assert said(scene.gauge("t", force=["blade", "bucket"])).startswith("force: the scene has no part 'bucket'")
    assert "rotation: of a wall, and the box does not turn" in said(
        courant.Scene("box", spacing=0.1, end=1).water(low=(0, 0), high=(1, 1)).box(low=(0, 0), high=(1, 2), motion={"rotation": {"about": [0, 0], "speed": 1}}))
    assert "motion: a wall that turns has no other motion" in said(
        courant.Scene("w", spacing=0.1, end=1).water(low=(0, 0), high=(1, 1)).wall(line=[[3, 0], [4, 0]], motion={"x": "TIME", "rotation": {"about": [3, 0], "speed": 1}}))


@needs_program
@pytest.mark.parametrize("axis", [(0, 1, 0), (0, 0, -1), (1, 1, 0.5)])
def test_a_wall_turns_about_any_axis(axis: tuple[float, ...], tmp_path) -> None:  # type: ignore[no-untyped-def]
    """A plate, off its axis, by 40 degrees in 0.1 s: its corners are where a rotation brings them, within 1e-5."""
    scene = courant.Scene("turn", end=0.1, output=0.1, gravity=0)
    scene.wall(title="gate", plate={"origin": (0.2, 0, 0), "edge1": (0.5, 0, 0), "edge2": (0, 0.5, 0)},
               motion={"rotation": {"about": [0, 0, 0.1], "axis": list(axis), "angle": "4000 * TIME^2"}})
    scene.body(title="ball", sphere={"centre": (5, 5, 5), "radius": 0.1}, density=1000)
    run = scene.run(tmp_path, quiet=True)
    first, last = (np.asarray(state.points) for state in (run.states[0], run.states[-1]))
    near = np.flatnonzero(np.linalg.norm(first, axis=1) < 2)
    unit = np.array(axis) / np.linalg.norm(axis)
    arm, angle = first[near] - [0, 0, 0.1], math.radians(4000 * run.states[-1].t ** 2)
    along = (arm @ unit)[:, None] * unit
    expected = [0, 0, 0.1] + along + (arm - along) * math.cos(angle) + np.cross(unit, arm) * math.sin(angle)
    assert len(near) >= 4 and np.abs(last[near] - expected).max() < 1e-5


@needs_program
def test_a_mixer_carries_water_and_feels_it(tmp_path) -> None:  # type: ignore[no-untyped-def]
    """The water around the blades turns with them, and its moment is against them."""
    scene = courant.Scene("mixer", spacing=0.04, end=0.2, output=0.1).water(low=(0, 0), high=(1, 0.6)).box(low=(0, 0), high=(1, 1), open="top")
    for name, line in (("level", [[0.3, 0.3], [0.7, 0.3]]), ("upright", [[0.5, 0.1], [0.5, 0.5]])):
        scene.wall(line=line, title=name, motion={"rotation": {"about": [0.5, 0.3], "rpm": 30, "ramp": 0.1}})
    scene.gauge("torque", force=["level", "upright"], about=(0.5, 0.3))
    run = scene.run(tmp_path, quiet=True)
    torque, state = run.gauges["torque"], run.states[-1]
    assert np.mean(np.asarray(torque["moment.z"])) < 0
    water = np.asarray(state["velocity"]), np.asarray(state.points)
    arm = water[1][: len(water[0])] - [0.5, 0.3, 0]
    near = np.linalg.norm(arm, axis=1) < 0.2
    turn = arm[near, 0] * water[0][near, 1] - arm[near, 1] * water[0][near, 0]
    assert turn.mean() > 0.2 * math.pi * 0.1**2


@needs_program
def test_a_channel_that_begins_filled_keeps_its_depth(tmp_path) -> None:  # type: ignore[no-untyped-def]
    """Depth 0.2 m and 0.5 m/s, half a second: the level in the middle within 1 %, the discharge within 2 %."""
    scene = courant.Scene("channel", spacing=0.025, end=0.5, output=0.1, velocity=(0.5, 0)).water(low=(0, 0), high=(1, 0.2))
    scene.box(low=(0, 0), high=(1, 0.4), open=["top", "left", "right"]).inlet(side="left", depth=0.2, speed=0.5).outlet("right", level=0.2)
    scene.gauge("level", level=[(0.4, 0), (0.4, 0.4)]).gauge("flow", flux=[(0.4, 0), (0.4, 0.4)])
    run = scene.run(tmp_path, quiet=True)
    assert np.asarray(run.gauges["level"]["level"]) == pytest.approx(0.2, rel=0.01)
    assert np.asarray(run.gauges["flow"]["volume"])[-1] == pytest.approx(0.1, rel=0.02)


@pytest.mark.parametrize(("keys", "text"), [
    ({"side": "left"}, "'depth' is missing"), ({"depth": 0.2}, "'side' is missing"), ({"side": "top", "depth": 0.2}, "side: water enters through left, right, got 'top'"),
    ({"side": "right", "depth": 0.2}, "an inlet on the side 'right', which has a wall"), ({"side": "left", "depth": 0.2, "width": 1}, "'width' does not go with 'side' and 'depth'"),
    ({}, "an inlet: 'at' is missing")])
def test_mistakes_of_inlets(keys: dict[str, Any], text: str) -> None:
    scene = courant.Scene("channel", spacing=0.025, end=0.5).water(low=(0, 0), high=(1, 0.2)).box(low=(0, 0), high=(1, 0.4), open=["top", "left"])
    assert text in said(scene.inlet(speed=0.5, **keys))
