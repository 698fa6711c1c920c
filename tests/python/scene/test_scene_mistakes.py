"""Mistakes of scenes: all at once, each once; names of several parts, bodies that overlap, water of a single particle."""
from __future__ import annotations

from pathlib import Path

import courant
import pytest

from .made import written

BOX = "box: {low: [0, 0], high: [1.5, 1]}\n"
WATER = "title: a\nwater: {spacing: 0.05, blocks: [{low: [0, 0], high: [0.5, 0.5]}]}\n" + BOX


def errors(tmp_path: Path, text: str) -> list[str]:
    return [line for line in written(tmp_path, text).messages.splitlines() if ": error: " in line]


@pytest.mark.parametrize(("water", "one"), [
    ("spacing: -0.05, blocks: [{low: [0, 0], high: [0.5, 0.5]}]", "2:18: error: spacing: expected a length > 0, got -0.05"),
    ("spacing: 0.05 m, blocks: [{low: [0, 0], high: [0.5, 0.5]}]", "2:18: error: spacing: 'm' is not understood, got '0.05 m'"),
    ("spaceing: 0.05, blocks: [{low: [0, 0], high: [0.5, 0.5]}]", "2:9: error: water: unknown key 'spaceing'"),
    ("spacing: 0.05, blocks: [{low: [0, 0], hight: [0.5, 0.5]}]", "2:47: error: a block: unknown key 'hight'"),
    ("blocks: [{low: [0, 0], high: [0.5, 0.5]}]", "2:8: error: 'spacing' is missing"),
    ("spacing: 0.05, blocks: [{low: [0, 0]}]", "2:33: error: 'high' is missing"),
    ("spacing: 0.5, blocks: [{low: [0, 0], high: [0.5, 0.5]}]", "2:18: error: spacing: with 0.5 the water is a single particle, which has no neighbours")])
def test_a_mistake_is_one_error(tmp_path: Path, water: str, one: str) -> None:
    found = errors(tmp_path, f"title: a\nwater: {{{water}}}\n" + BOX + "end: 1\n")
    assert len(found) == 1 and found[0].startswith(f"scene.yaml:{one}")


def test_a_box_that_is_misspelt_is_one_error(tmp_path: Path) -> None:
    assert len(errors(tmp_path, WATER.replace("box: {low", "box: {lo") + "end: 1\n")) == 1
    assert len(errors(tmp_path, WATER + "ende: 1\n")) == 1


@pytest.mark.parametrize("key,other", [("force: bdy", "force: the scene has no part 'bdy'"), ("{kind: hinge, between: [bdy, walls], at: [0, 0]}", "there is no body or wall 'bdy'")])
def test_a_body_and_what_names_it_are_reported_at_once(tmp_path: Path, key: str, other: str) -> None:
    named = f"gauges: [{{name: f, {key}}}]\n" if key.startswith("force") else f"joints: [{key}]\n"
    bad = WATER + "bodies:\n  - {box: {low: [2, 0.2], high: [2.2, 0.4]}, density: 500}\n" + named + "end: 1\n"
    found = errors(tmp_path, bad)
    assert len(found) == 2 and "through a wall of the box" in found[0] and other in found[1]
    assert len(errors(tmp_path, bad.replace("bdy", "box"))) == 1  # the body with the mistake is one
    assert len(errors(tmp_path, bad.replace("box: {low: [2, 0.2], high: [2.2, 0.4]}", "file: none.csv").replace("bdy", "none"))) == 1


def two(first: str, second: str, x: float) -> courant.Scene:
    scene = courant.Scene("two", spacing=0.02, end=0.1).water(low=(0, 0), high=(1, 0.4)).box(low=(0, 0), high=(1, 0.8))
    scene.body(box={"low": (0.2, 0.3), "high": (0.4, 0.5)}, density=500, title=first)
    return scene.body(box={"low": (x, 0.3), "high": (x + 0.2, 0.5)}, density=500, title=second)


def test_a_title_of_two_parts_is_refused_where_it_is_named() -> None:
    assert two("A", "A", 0.6).deck()
    for named in (two("A", "A", 0.6).gauge("F", force="A"), two("A", "A", 0.6).joint("hinge", ["A", "walls"], (0.3, 0.4)),
                  two("A", "A", 0.6).gauge("p", point=(0.3, 0.3), body="A"),
                  two("A", "A", 0.6).structure(line=[(0.5, 0.5), (0.5, 0.6)], thickness=0.01, material="rubber", fix="bottom", to="A")):
        with pytest.raises(courant.CourantError, match="'A' is the title of 2 parts, 101, 102\n  hint: give each a title of its own, or write the number"):
            named.deck()
    assert ",102,3," in two("A", "A", 0.6).gauge("F", force=102).deck() and ",102,3," in two("A", "B", 0.6).gauge("F", force="B").deck()
    walls = courant.Scene("walls", spacing=0.02, end=0.1).water(low=(0, 0), high=(1, 0.4))
    walls.wall(line=[(0, 0), (1, 0)]).wall(line=[(0, 0), (0, 1)]).gauge("F", force="line")
    with pytest.raises(courant.CourantError, match="'line' is the title of 2 parts, 12, 13"):
        walls.deck()


def test_bodies_that_overlap_are_refused() -> None:
    for titles, names in ((("A", "B"), "'A' and 'B' overlap"), (("A", "A"), r"'A' \(101\) and 'A' \(102\) overlap")):
        with pytest.raises(courant.CourantError, match=names):
            two(*titles, 0.35).deck()
    assert two("A", "B", 0.4).deck()  # side by side
    assert two("A", "B", 0.35).joint("fixed", ["A", "B"], (0.37, 0.4)).deck()
    cross = courant.Scene("cross", spacing=0.02, end=0.1).water(low=(0, 0), high=(1, 0.2)).box(low=(0, 0), high=(1, 0.8))
    cross.body(box={"low": (0.2, 0.4), "high": (0.8, 0.45)}, density=500).body(box={"low": (0.45, 0.3), "high": (0.5, 0.6)}, density=500)
    with pytest.raises(courant.CourantError, match=r"overlap, for example at \(0.4"):
        cross.deck()  # no corner of one is in the other
    space = courant.Scene("space", spacing=0.05, end=0.1).water(low=(0, 0, 0), high=(1, 1, 0.2)).box(low=(0, 0, 0), high=(1, 1, 1))
    space.body(sphere={"centre": (0.4, 0.4, 0.5), "radius": 0.1}, density=500, title="S")
    space.body(sphere={"centre": (0.53, 0.53, 0.5), "radius": 0.1}, density=500, title="T")
    with pytest.raises(courant.CourantError, match="'S' and 'T' overlap"):
        space.deck()


def test_a_polygon_of_points_is_a_closed_line_in_yaml(tmp_path: Path) -> None:
    scene = courant.Scene("polygon", spacing=0.02, end=0.1).water([(0, 0), (0.4, 0), (0.3, 0.3), (0.1, 0.3)]).box(low=(-0.1, 0), high=(1, 0.8))
    scene.wall([(0.6, 0), (0.8, 0), (0.7, 0.2)], title="wedge").body([(0.1, 0.5), (0.2, 0.5), (0.2, 0.6), (0.1, 0.6)], density=500, hold=["x", "y"])
    text = scene.to_yaml(tmp_path / "scene.yaml")
    assert "line: [[0.6, 0], [0.8, 0], [0.7, 0.2], [0.6, 0]]" in text
    again = courant.Scene.from_yaml(tmp_path / "scene.yaml")
    assert scene.deck().split("\n", 1)[1] == again.deck().split("\n", 1)[1]
