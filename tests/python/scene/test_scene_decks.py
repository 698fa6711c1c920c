"""Scenes in YAML, and the decks that they give."""
from __future__ import annotations

from pathlib import Path

import courant
import numpy as np
import pytest
from courant.diagnostics import Diagnostics
from courant.scene.command import read_model, write_deck

from .made import DECKS, SMALL, replaced, written

WATER = "water: {spacing: 0.1, blocks: [{low: [0, 0], high: [0.4, 0.2]}]}\n"
PLATE = "      - {origin: [0, 0, 0], edge1: [1, 0, 0], edge2: [0, 0, dx], mesh: dx}\n"
LATTICE = "      - {low: [-1, 0], high: [0, dx], spacing: dx}\n"


def test_columns_are_fixed(tmp_path: Path) -> None:
    out = written(tmp_path, SMALL)
    assert out.messages == ""
    assert out.deck == """$ Written by `courant generate scene.yaml`: change the scene, not this file.
$ Parameters:
$   c0 = 10
$   dx = 0.5
$ Parts:
$   3 water: 2 particles
$   7 part 7: 4 shells
*KEYWORD
*TITLE
two by one, c0 = 10
*CONTROL_TERMINATION
$#  endtim
         5
*PART
$# heading
water
$#     pid     secid       mid     eosid      hgid
         3         1         2         4         0
*PART
$# heading
part 7
$#     pid     secid       mid     eosid      hgid
         7         5         6         0         0
*INITIAL_VELOCITY_GENERATION
$#      id      styp     omega        vx        vy        vz     ivatn      icid
         3         2         0         2         0         0         0         0
$#      xc        yc        zc        nx        ny        nz     phase    irigid
         0         0         0         0         0         0         0         0
*NODE
$#   nid               x               y               z      tc      rc
       1           -0.75            0.25               0
       2           -0.25            0.25               0
       3               0               0               0
       4               0               0             0.5
       5             0.5               0               0
       6             0.5               0             0.5
       7               1               0               0
       8               1               0             0.5
       9               1             0.3               0
      10               1             0.3             0.5
      11               1             0.6               0
      12               1             0.6             0.5
*ELEMENT_SPH
$#   nid     pid            mass    nend   (mass < 0: volume)
       1       3           -0.25
       2       3           -0.25
*ELEMENT_SHELL
$#   eid     pid      n1      n2      n3      n4
       1       7       3       5       6       4
       2       7       5       7       8       6
       3       7       7       9      10       8
       4       7       9      11      12      10
*END
"""


def test_parameters_take_other_values_with_what_follows_from_them(tmp_path: Path) -> None:
    assert "$   3 water: 4 particles" in written(tmp_path, SMALL, dx="c0 / 40").deck


@pytest.mark.parametrize(("old", "new", "message"), [
    ("spacing: dx", "spacing: -dx", "scene.yaml:13:48: error: spacing: expected a length > 0, got -0.5"),
    ("high: [0, dx]", "high: [-1, dx]", "scene.yaml:13:9: error: the lattice is empty: its extent along x is 0"),
    ("low: [-1, 0]", "low: [-1.1, 0]", "the extent 1.1 along x is 2.2 spacings, not a whole number"),
    ("eos: 4", "eso: 4", "scene.yaml:10:5: error: a part: unknown key 'eso'\n  hint: did you mean eos? known keys: id, title"),
    ("eos: 4", "section: 4", "scene.yaml:10:5: error: a part: 'section' stands twice"),
    ("dx: 1 / 2", "dx: 1 / resolution", "scene.yaml:4:7: error: parameter dx: unknown parameter 'resolution'"),
    ("${c0 * dx:10}", "${c1 * dx:10}", "scene.yaml:24: error: in '${c1 * dx:10}': unknown parameter 'c1'"),
    ("id: 7", "id: 3", "scene.yaml:14:9: error: part 3 is there already"),
    ("id: 3", "id: 0", "scene.yaml:6:9: error: id: expected a whole number from 1 to 99999999, got 0"),
    ("id: 3", "id: 1.5", "got 1.5"),
    ("    material: 6\n", "", "scene.yaml:14:5: error: 'material' is missing"),
    ("edge2: [0, 0, dx]", "edge2: [2, 0, 0]", "the plate has no area"),
    ("merge: true", "merge: perhaps", "merge: expected true or false"),
    ("merge: true", "first_id: 2", "part 7: ids from 2 on are taken by the parts above"),
    ("merge: true", "first_id: 99999999", "the format ends at 99999999"),
    ("mesh: dx", "mesh: [dx, 0]", "mesh: expected a length > 0, got 0"),
    ("mesh: dx", "mesh: [dx]", "mesh: expected a number"),
    ("spacing: dx", "spacing: 1 / 2^20", "the lattice would have"),
    (LATTICE, 2 * "      - {low: [0, 0], high: [6000, 6000], spacing: 1}\n", "up to here the scene has room for 7.2e+07 particles and shells"),
    (PLATE, 2 * "      - {origin: [0, 0, 0], edge1: [6000, 0, 0], edge2: [0, 0, 6000], mesh: 1}\n", "room for 7.2e+07 particles and shells"),
    (LATTICE, LATTICE + "      - {low: [1, 0, 0], high: [2, dx, 1], spacing: dx}\n", "a lattice of 3 dimensions beside one of 2")])
def test_a_mistake_has_its_position(tmp_path: Path, old: str, new: str, message: str) -> None:
    out = written(tmp_path, replaced(SMALL, old, new))
    assert message in out.messages and not out.deck


@pytest.mark.parametrize(("scene", "message"), [("title: x\n", "the scene has no parts"), ("title: [x\n", "not valid YAML"), ("- x\n", "a scene is a YAML map"),
                                                ("", "a scene is a YAML map"), ("parameters: {pi: 3}\n", "'pi' is there already")])
def test_what_is_no_scene_is_refused(tmp_path: Path, scene: str, message: str) -> None:
    assert message in written(tmp_path, scene).messages


def test_wrong_parameters_of_the_call_are_refused(tmp_path: Path) -> None:
    assert "error: --param c1: the scene has no such parameter\n  hint: its parameters: c0, dx" in written(tmp_path, SMALL, c1="2").messages
    assert "error: --param dx: unknown parameter 'half', got 'half'" in written(tmp_path, SMALL, dx="half").messages


def test_plates_may_have_a_length_for_each_edge(tmp_path: Path) -> None:
    assert "$   7 part 7: 10 shells\n" in written(tmp_path, replaced(SMALL, "mesh: dx", "mesh: [dx / 4, dx]")).deck


def test_nothing_is_left_where_nothing_can_be_written(tmp_path: Path) -> None:
    scene = tmp_path / "scene.yaml"
    scene.write_text(SMALL)

    def fails(target: Path) -> str:
        diagnostics = Diagnostics()
        assert not write_deck(read_model(str(scene), {}, diagnostics), "scene.yaml", str(target), diagnostics)
        return diagnostics.text()

    assert "the deck cannot be written" in fails(tmp_path / "missing" / "deck.k")
    assert "it is no file" in fails(tmp_path)
    assert "would take the place of the scene" in fails(tmp_path / "." / "scene.yaml")
    diagnostics = Diagnostics()
    read_model(str(tmp_path / "none.yaml"), {}, diagnostics)
    assert "the scene cannot be read" in diagnostics.text()
    assert scene.read_text() == SMALL and list(tmp_path.iterdir()) == [scene]


def test_velocities_of_many_digits_have_wide_fields(tmp_path: Path) -> None:
    out = written(tmp_path, replaced(SMALL, "velocity: [c0 / 5, 0]", "velocity: [-1.23456789e-12, 2]"))
    assert "*INITIAL_VELOCITY_GENERATION +\n$#                id" in out.deck and "     -1.23456789e-12                   2" in out.deck
    assert "        -0.00123456                   2" in written(tmp_path, replaced(SMALL, "velocity: [c0 / 5, 0]", "velocity: [-1.23456e-3, 2]")).deck


def test_water_in_a_box_needs_no_cards(tmp_path: Path) -> None:
    out = written(tmp_path, "title: box\nwater: {spacing: 0.1, density: 900, blocks: [{low: [0, 0], high: [0.4, 0.2]}]}\n"
                            "box: {low: [0, 0], high: [1, 0.5], open: [top, right]}\nwall_method: contact\ngravity: 10\nend: 3\n")
    assert "1 water: 8 particles" in out.deck
    assert "11 walls: 30 shells" in out.deck  # floor of 1 and wall of 0.5 in shells of half a spacing
    assert out.has_fields("1", "0", "1440000")  # 20 sqrt(2 * 10 * 0.2) = 40
    assert "*LOAD_BODY_Y" in out.deck


def test_a_slope_up_to_the_walls_of_the_box_covers_a_part_of_the_water() -> None:
    scene = courant.Scene("valley", spacing=0.02, end=1).water(low=(0, 0), high=(0.6, 0.3)).box(low=(0, 0), high=(0.6, 0.6), open=["top"])
    wet = int(courant.Scene.deck(scene).split(" particles")[0].rsplit(" ", 1)[1])
    scene.wall(line=[[0, 0], [0.6, 0.4], [0.6, 0], [0, 0]])
    left = int(scene.deck().split(" particles")[0].rsplit(" ", 1)[1])
    assert wet == 450 and abs(left - 0.3 * 0.45 / 2 / 0.02**2) < 15  # the triangle above the slope, less half a spacing beside it


TANK = """title: tank
water: {spacing: 0.05, bodies: [{cylinder: {base: [0, 0, 0], top: [0, 0, 0.5], radius: 0.5}}]}
walls:
  - {cylinder: {base: [0, 0, 0], top: [0, 0, 0.8], radius: 0.5}OPEN}
end: 1
"""


def test_a_closed_shape_around_all_the_water_is_a_tank_if_it_is_open(tmp_path: Path) -> None:
    solid = written(tmp_path, replaced(TANK, "OPEN", ""))
    assert "scene.yaml:4:5: error: 'cylinder'" in solid.messages and "is solid and covers all the water" in solid.messages and "open: true" in solid.messages
    deck = written(tmp_path, replaced(TANK, "OPEN", ", open: true")).deck
    count = int(deck.split(" particles")[0].rsplit(" ", 1)[1])
    assert 0.85 < count * 0.05**3 / (np.pi * 0.5**2 * 0.5) < 1.0  # less a layer beside the wall


def test_walls_that_cover_the_water_together_are_named(tmp_path: Path) -> None:
    out = written(tmp_path, WATER + "walls:\n  - {box: {low: [-1, -1], high: [0.2, 1]}}\n  - {box: {low: [0.2, -1], high: [1, 1]}}\nend: 1\n")
    assert "part 1 has no particles: walls and bodies cover all of it" in out.messages


def test_an_inlet_needs_neither_water_nor_a_box(tmp_path: Path) -> None:
    out = written(tmp_path, "title: jet\nwater: {spacing: 0.02}\ninlets:\n  - {at: [0, 0], direction: [1, 0], width: 0.1, speed: 1}\nend: 0.1\n")
    assert out.messages == "" and "*DEFINE_SPH_INJECTION" in out.deck and "*NODE" not in out.deck  # a keyword without cards is an error


@pytest.mark.parametrize(("method", "mirrors"), [("", True), ("wall_method: auto\n", True), ("wall_method: contact\n", False)])
def test_walls_are_mirrors_if_nothing_else_is_said(tmp_path: Path, method: str, mirrors: bool) -> None:
    out = written(tmp_path, "title: box\nwater: {spacing: 0.1, blocks: [{low: [0, 0], high: [0.4, 0.2]}]}\nbox: {low: [0, 0], high: [1, 0.5]}\n" + method + "end: 3\n")
    assert ("*COURANT_WALL_SUPPORT" in out.deck) == mirrors


def test_walls_with_ghosts_are_method_2_and_leave_the_water_to_them(tmp_path: Path) -> None:
    out = written(tmp_path, "title: box\nwater: {spacing: 0.1, blocks: [{low: [0, 0], high: [0.4, 0.2]}]}\nbox: {low: [0, 0], high: [1, 0.5]}\n"
                            "walls:\n  - {box: {low: [0.6, 0.1], high: [0.9, 0.4]}}\nwall_method: ghosts\nend: 3\n")
    assert out.has_fields("5", "2", "0.0", "2")  # *COURANT_WALL_SUPPORT on the set of box and wall
    assert out.has_fields(*["0.04"] * 4)  # shells of 0.4 spacings: contact acts at 0.2


def test_water_of_three_dimensions_falls_along_z(tmp_path: Path) -> None:
    out = written(tmp_path, "title: box\nwater: {spacing: 0.1, blocks: [{low: [0, 0, 0], high: [0.2, 0.2, 0.2]}], velocity: [3, 0, 4]}\n"
                            "box: {low: [0, 0, 0], high: [0.4, 0.4, 0.4]}\ngravity: 0\nend: 3\n")
    assert "11 walls: 24 shells" in out.deck and out.has_fields("1", "0", "10000000")  # 1000 (20 * 5)^2
    assert "*LOAD_BODY" not in out.deck
    falls = written(tmp_path, "title: drop\nwater: {spacing: 0.1, blocks: [{low: [0, 0, 0], high: [0.2, 0.2, 0.2]}]}\nend: 3\n")
    assert "*LOAD_BODY_Z" in falls.deck and "*CONTACT" not in falls.deck


@pytest.mark.parametrize(("scene", "message"), [
    ("title: x\nend: 1\nparts: []\n", "scene.yaml:2:6: error: 'end' goes with 'water', which the scene has not"),
    (WATER, "'end' is missing"),
    (WATER + "end: 1\nbox: {low: [0, 0], high: [0.3, 1]}\n", "a block reaches from 0 to 0.4 along x, beyond the box from 0 to 0.3"),
    (WATER + "end: 1\nbox: {low: [0, 0], high: [0.4, 0]}\n", "the box has no extent along y"),
    (WATER + "end: 1\nbox: {low: [0, 0, 0], high: [1, 1, 1]}\n", "the water has 2 dimensions, and so must low and high"),
    (WATER + "end: 1\nbox: {low: [0, 0], high: [1, 1], open: [front]}\n", "'front' is no side of the box\n  hint: its sides: left, right, bottom, top"),
    (WATER + "end: 1\ngravity: 0\n", "'sound_speed' is missing"),
    ("water: {spacing: 0.1, block: []}\nend: 1\n", "unknown key 'block'"),
    (WATER + "end: 1\nparts:\n  - id: 1\n    section: 1\n    material: 1\n    lattices: [{low: [0, 0], high: [1, 1], spacing: 1}]\n", "part 1 is there already")])
def test_faults_of_water_are_told(tmp_path: Path, scene: str, message: str) -> None:
    assert message in written(tmp_path, scene).messages


@pytest.mark.parametrize(("scene", "parameters", "count"), [
    ("hydraulic_jump/scene", {"resolution": "4", "endtim": "30"}, 36880), ("hydraulic_jump/scene", {"resolution": "5"}, 10750),
    ("hydraulic_jump/scene", {"resolution": "10"}, 43000), ("hydraulic_jump/scene", {}, 6880), ("dam_break_3d/scene", {}, 16000),
    ("still_water/scene", {}, 2500)])
def test_scenes_have_the_particles_of_their_geometry(scene: str, parameters: dict[str, str], count: int) -> None:
    diagnostics = Diagnostics()
    model = read_model(str(DECKS / f"{scene}.yaml"), parameters, diagnostics)
    assert diagnostics.text() == ""
    assert sum(one.n[0] * one.n[1] * one.n[2] for part in model.parts for one in part.lattices) == count


def test_the_committed_jump_is_that_of_its_scene(tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    assert write_deck(read_model(str(DECKS / "hydraulic_jump/scene.yaml"), {}, diagnostics), "scene.yaml", str(tmp_path / "jump.k"), diagnostics)
    assert (tmp_path / "jump.k").read_bytes() == (DECKS / "hydraulic_jump/d4_5s.k").read_bytes(), \
        "run: courant generate keyword_decks/hydraulic_jump/scene.yaml -o keyword_decks/hydraulic_jump/d4_5s.k"


@pytest.mark.parametrize("name", ["hydraulic_jump/scene", "hydraulic_jump/supported_bed", "hydraulic_jump/smooth_bed", "hydraulic_jump/standing_level",
                                  "dam_break_3d/scene", "still_water/scene"])
def test_cards_fit_their_columns(tmp_path: Path, name: str) -> None:
    """Data lines fit 80 columns, and the numbers of a card end where their headings end."""
    diagnostics = Diagnostics()
    assert write_deck(read_model(str(DECKS / f"{name}.yaml"), {}, diagnostics), name, str(tmp_path / "scene.k"), diagnostics)
    heads: set[int] = set()
    checked = 0

    def ends(line: str) -> set[int]:
        return {i for i in range(1, len(line) + 1) if line[i - 1] != " " and (i == len(line) or line[i] == " ")}

    for line in (tmp_path / "scene.k").read_text().splitlines():
        if line.startswith("$#"):
            heads = set() if line.endswith(("heading", "title")) else ends(line)
        elif line[0] == "*":
            heads = set()
        elif line[0] != "$":
            assert len(line) <= 80
            assert not heads or ends(line) <= heads, line
            checked += bool(heads)
    assert checked > 1000
