"""Damping zones of scenes, and the warning about bodies of the plane."""
from __future__ import annotations

from pathlib import Path
from typing import Any

import courant
import pytest
from mixed_run import needs_courant

from .made import written


def tank(**keys: Any) -> courant.Scene:
    made = courant.Scene("tank", **({"spacing": 0.05, "end": 1} | keys)).water(low=(0, 0), high=(2, 0.5))
    return made.box(low=(0, 0), high=(2, 1), open=["top"])


def test_the_card_of_a_zone() -> None:
    assert "*COURANT_DAMPING_ZONE\n1.5,0,0,2,0,0,5\n2\n" in tank().damping((1.5, 0), (2, 0), 5).deck()
    two = tank().damping((1.5, 0), (2, 0), rate=3, exponent=1).damping((0.5, 0), (0, 0), rate=3)
    assert "*COURANT_DAMPING_ZONE\n1.5,0,0,2,0,0,3\n1\n" in two.deck() and two.deck().count("*COURANT_DAMPING_ZONE") == 2
    assert "water is slowed down from (1.5, 0) to (2, 0) and beyond" in two.explain()
    space = courant.Scene("tank", spacing=0.1, end=1).water(low=(0, 0, 0), high=(1, 1, 1)).damping((0, 0, 0), (0, 1, 0), 2)
    assert "*COURANT_DAMPING_ZONE\n0,0,0,0,1,0,2\n2\n" in space.deck()


def test_a_zone_in_yaml(tmp_path: Path) -> None:
    tank().damping((1.5, 0), (2, 0), 5).to_yaml(tmp_path / "tank.yaml")
    assert "damping:" in (tmp_path / "tank.yaml").read_text() and "1.5,0,0,2,0,0,5" in courant.Scene.from_yaml(tmp_path / "tank.yaml").deck()


@needs_courant
def test_the_program_takes_the_card(tmp_path: Path) -> None:
    deck = tank().damping((1.5, 0), (2, 0), 5).write(tmp_path / "tank.k")
    assert courant.check(deck).ok


@pytest.mark.parametrize(
    ("zone", "message"),
    [
        ("[]", "7:10: error: damping: expected a list that is not empty"),
        ("[{start: [1, 0], end: [2, 0]}]", "7:11: error: 'rate' is missing"),
        ("[{start: [1, 0], end: [2, 0], rate: -5}]", "7:46: error: rate: expected a number > 0, got -5"),
        ("[{start: [1, 0], end: [2, 0], rate: 5, exponent: 0}]", "exponent: expected a number > 0, got 0"),
        ("[{start: [1, 0], end: [1, 0], rate: 5}]", "start and end are the same point"),
        ("[{start: [1, 0], end: [2, 0, 1], rate: 5}]", "as many components as the scene has dimensions, 2"),
        ("[{low: [1, 0], end: [2, 0], rate: 5}]", "a damping zone: unknown key 'low'"),
    ],
)
def test_faults_of_zones(tmp_path: Path, zone: str, message: str) -> None:
    scene = "title: tank\nwater: {spacing: 0.05, blocks: [{low: [0, 0], high: [2, 0.5]}]}\nbox:\n  low: [0, 0]\n  high: [2, 1]\nend: 1\n"
    out = written(tmp_path, f"{scene}damping: {zone}\n")
    assert message in out.messages and not out.deck, out.messages


def test_bodies_of_the_plane_fall_through_the_floor(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shape = {"low": [0.4, 0.4], "high": [0.6, 0.6]}
    made = tank().body(box=shape, density=500)
    made.write(tmp_path / "tank.k")
    assert "warning: 'box' passes through walls and falls through the floor" in capsys.readouterr().err
    assert "bodies pass through walls and fall through the floor" in made.explain()
    tank().body(box=shape, density=500, hold=["x", "y"]).write(tmp_path / "tank.k")
    courant.Scene("sea", spacing=0.05, end=1, gravity=0, sound_speed=20).water(low=(0, 0), high=(1, 1)).body(box=shape, density=500).write(tmp_path / "sea.k")
    space = courant.Scene("tank", spacing=0.1, end=1).water(low=(0, 0, 0), high=(1, 1, 0.5)).box(low=(0, 0, 0), high=(1, 1, 1))
    space.body(box={"low": [0.2, 0.2, 0.3], "high": [0.6, 0.6, 0.7]}, density=500).write(tmp_path / "space.k")
    assert "falls through" not in capsys.readouterr().err
