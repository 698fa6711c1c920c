"""Forces on walls over the whole of an interval."""
from __future__ import annotations

import os
from pathlib import Path

import courant
import numpy as np
import pytest

pytestmark = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


def falling(method: str, **keys: object) -> courant.Scene:
    """A block of water that strikes the floor."""
    made = courant.Scene("falling", **({"spacing": 0.02, "end": 0.2, "output": 0.05, "wall_method": method} | keys))  # type: ignore[arg-type]
    return made.water(low=(0.2, 0.02), high=(0.4, 0.22), velocity=None).box(low=(0, 0), high=(0.6, 0.4), open=["top"])


@pytest.mark.parametrize("method", ["mirrors", "contact", "mixed"])
def test_impulses_are_what_the_momentum_of_the_water_lacks(method: str, tmp_path: Path) -> None:
    """m v = -m g t + impulse of the walls on the water: nothing between the rows of the history is missing."""
    run = falling(method, velocity=(0.3, -0.5)).run(tmp_path, threads=1, quiet=True)
    force, water = run.wall_force(), run.histories.table("parts/1")
    mass = water["mass"][0]
    t = force["t"]
    gained = water["momentum.y"] - water["momentum.y"][0] + force["impulse.y"]
    assert np.abs(gained + mass * 9.81 * t).max() < mass * 9.81 * 6e-4  # velocities are half a step old
    assert np.abs(water["momentum.x"] - water["momentum.x"][0] + force["impulse.x"]).max() < 1e-5 * abs(water["momentum.x"][0])
    assert force["mean.y"][1:] @ np.diff(t) == pytest.approx(force["impulse.y"][-1]) and force.units["mean.y"] == "N"
    assert force["impulse.y"][-1] < -0.5 * mass * 0.5


def test_means_of_long_intervals_are_those_of_short_ones(tmp_path: Path) -> None:
    coarse, fine = (falling("mirrors", output=output, end=0.1).run(tmp_path / str(output), threads=1, quiet=True).wall_force() for output in (0.2, 0.002))
    assert len(coarse["t"]) < 8 < 200 < len(fine["t"])
    assert np.interp(coarse["t"], fine["t"], fine["impulse.y"]) == pytest.approx(coarse["impulse.y"], rel=0.01, abs=0.05)


def test_impulses_go_on_after_a_restart(tmp_path: Path) -> None:
    scene = falling("mirrors", end=0.1)
    whole = scene.run(tmp_path / "whole", threads=1, quiet=True).wall_force()
    scene.run(tmp_path / "half", threads=1, quiet=True, until=0.06)
    rest = scene.run(tmp_path / "rest", threads=1, quiet=True, restart=tmp_path / "half").wall_force()
    assert rest["impulse.y"][-1] == whole["impulse.y"][-1] != 0
