"""Expressions of the position of a particle, and files that scenes have in common."""
from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from courant.scene.node_reader import named_places
from courant.scene.places import scattered

from .made import PATCH, replaced, written


def lattice(added: str) -> str:
    return replaced(PATCH, "dx}", f"dx, {added}}}")


@pytest.mark.parametrize("where", ["'0.6^2 - x^2 - y^2'", "x^2 + y^2 < 0.6^2 and x > -1"])
def test_particles_are_kept_where_the_expression_is_positive(tmp_path: Path, where: str) -> None:
    out = written(tmp_path, lattice(f"where: {where}"))
    assert out.messages == ""
    nodes = out.cards("*NODE")
    assert [node[0] for node in nodes] == [1, 2, 3, 4]  # r of the centres: 0.177, 0.395 (twice), 0.530, then 0.637
    assert all(math.hypot(x, y) < 0.6 for _, x, y, _ in nodes)
    assert "$   1 water: 4 particles" in out.deck and len(out.cards("*ELEMENT_SPH")) == 4


def test_each_particle_has_its_velocity_and_pressure(tmp_path: Path) -> None:
    out = written(tmp_path, PATCH + "    velocity: ['U * x / ${dx}', -U * y]\n    pressure: 1000 * (1 - y) + x / 3\n")
    assert out.messages == "" and "*INITIAL_VELOCITY_GENERATION" not in out.deck
    nodes, v, sigma = (np.array(out.cards(name)) for name in ("*NODE", "*INITIAL_VELOCITY_NODE +", "*INITIAL_STRESS_SPH +"))
    assert nodes.shape == v.shape == sigma.shape == (16, 4)
    x, y = nodes[:, 1], nodes[:, 2]
    np.testing.assert_allclose(v, np.stack([nodes[:, 0], 8 * x, -2 * y, 0 * x], axis=1), rtol=0, atol=1e-12)
    np.testing.assert_allclose(sigma[:, 1:], np.stack([-1000 * (1 - y) - x / 3] * 3, axis=1), rtol=1e-12)


def test_one_velocity_of_all_stays_one_card(tmp_path: Path) -> None:
    out = written(tmp_path, PATCH + "    velocity: [U, exp(0)]\n")
    assert "*INITIAL_VELOCITY_GENERATION" in out.deck and "*INITIAL_VELOCITY_NODE" not in out.deck


def test_jitter_shifts_within_its_fraction_and_is_the_same_each_time(tmp_path: Path) -> None:
    out = written(tmp_path, lattice("jitter: 0.2"))
    assert out.deck == written(tmp_path, lattice("jitter: 0.2")).deck
    shift = np.array(out.cards("*NODE")) - np.array(written(tmp_path, PATCH).cards("*NODE"))
    assert np.all(shift[:, 1:3] != 0) and np.all(shift[:, 3] == 0)
    assert 0.04 < np.abs(shift).max() <= 0.05
    cells = np.arange(16)
    expected = 0.2 * 0.25 * np.column_stack([scattered(1000, 3 * cells), scattered(1000, 3 * cells + 1)])  # the decks of all versions
    np.testing.assert_allclose(shift[:, 1:3], expected, rtol=0, atol=1e-12)


def test_scattered_numbers_are_even_and_have_known_bits() -> None:
    n = 20000
    a = scattered(1000, np.arange(n + 1))
    assert np.all((a >= -1) & (a < 1))
    assert abs(a.mean()) < 0.02 and abs((a**2).mean() - 1 / 3) < 0.011 and abs((a[1:] * a[:-1]).mean()) < 0.012  # 5 standard errors
    assert a[0] != scattered(1001, np.arange(1))[0]
    assert a[7] == -0.9127648904505807  # from the generator's published constants


def test_faults_have_their_position(tmp_path: Path) -> None:
    def messages(added: str) -> str:
        return written(tmp_path, lattice(added)).messages

    assert messages("where: '1 / (x - 0.125)'") == \
        "scene.yaml:11:57: error: where: division by zero at x = 0.125, y = 0.125, z = 0, got '1 / (x - 0.125)'\n"
    assert "unknown parameter 'w' at x = 0.125" in messages("where: 'x - w'")
    assert messages("where: '-x'") == \
        "scene.yaml:6:5: error: part 1 has no particles: 'where' leaves none\n  hint: a particle is kept where the expression is > 0\n"
    assert messages("jitter: 0.5") == "scene.yaml:11:58: error: jitter: expected a fraction of the spacing from 0 to below 0.5, got 0.5\n"
    assert "got -0.1" in messages("jitter: -0.1")
    assert written(tmp_path, replaced(PATCH, "U: 2", "x: 2") + "    velocity: [x, 0]\n").messages == \
        "scene.yaml:12:16: error: velocity: x is the place of a particle here, and a parameter of the scene\n  hint: give the parameter another name\n"


def test_shells_have_no_pressure_and_one_velocity(tmp_path: Path) -> None:
    plate = "title: plate\nparts:\n  - id: 1\n    section: 1\n    material: 1\n    plates:\n" \
            "      - {origin: [0, 0, 0], edge1: [1, 0, 0], edge2: [0, 0, 1], mesh: 1}\n"
    assert written(tmp_path, plate + "    pressure: 1\n").messages == "scene.yaml:8:15: error: pressure: only particles have one, and the part has none\n"
    assert "parts of shells move with one velocity" in written(tmp_path, plate + "    velocity: [x, 0]\n").messages


def test_names_are_whole_words() -> None:
    assert named_places("max(x1, exp(2)) * dy") == set() and named_places("${x} - 2*z") == {"x", "z"}


def test_a_base_gives_parameters_and_keywords_below_the_scenes_own(tmp_path: Path) -> None:
    base = tmp_path / "base.yaml"
    scene = "base: base.yaml\n" + PATCH
    base.write_text("parameters:\n  U: 7\n  c0: 10 * U\nkeywords: |\n  *COMMENT\n  ${U} ${c0}\n")
    out = written(tmp_path, scene + "keywords: |\n  *END_OF_OWN\n")
    assert out.messages == "" and out.model.variables["c0"] == 20
    assert out.model.keywords == ["*COMMENT\n2 20\n", "*END_OF_OWN\n"]
    base.write_text("parameters:\n  c0: 10 * V\nbox: 1\n")
    messages = written(tmp_path, scene).messages
    assert "base.yaml:3:1: error: a base: unknown key 'box'" in messages and "base.yaml:2:7: error: parameter c0: unknown parameter 'V'" in messages
    base.write_text("parameters: [\n")
    assert "base.yaml:2:1: error: not valid" in written(tmp_path, scene).messages
    base.unlink()
    assert "cannot be read" in written(tmp_path, scene).messages


def test_bases_may_have_bases(tmp_path: Path) -> None:
    deep, base = tmp_path / "deep.yaml", tmp_path / "base.yaml"
    deep.write_text("parameters:\n  U: 7\n  c0: 10 * U\n  last: 2 * width\nkeywords: |\n  *COMMENT\n  deep ${c0} ${last}\n")
    base.write_text("base: deep.yaml\nparameters:\n  U: 3 * speed\n  width: U + own\nkeywords: |\n  *COMMENT\n  base\n")
    scene = "base: base.yaml\n" + replaced(PATCH, "U: 2", "speed: 2\n  own: 1\n  seen: last") + "keywords: |\n  *COMMENT\n  own ${seen}\n"
    out = written(tmp_path, scene)
    assert out.messages == ""
    assert out.model.keywords == ["*COMMENT\ndeep 60 14\n", "*COMMENT\nbase\n", "*COMMENT\nown 14\n"]
    assert written(tmp_path, replaced(scene, "base.yaml", "[base.yaml, deep.yaml]")).model.keywords == out.model.keywords  # each once
    deep.write_text("base: base.yaml\n")
    assert "is a base of itself" in written(tmp_path, "base: base.yaml\n" + PATCH).messages


def test_a_fault_in_the_parts_of_a_base_names_its_file(tmp_path: Path) -> None:
    base = tmp_path / "base.yaml"

    def plate(part: int, edge: str) -> str:
        return f"  - id: {part}\n    section: 1\n    material: 1\n    plates:\n      - {{origin: [0, 0, 0], edge1: [{edge}, 0, 0], edge2: [0, 1, 0], mesh: 1}}\n"

    own = "base: base.yaml\nparameters:\n  length: 3\n"
    base.write_text("parts:\n" + plate(8, "length"))
    assert [part.id for part in written(tmp_path, own).model.parts] == [8]
    assert [part.id for part in written(tmp_path, own + "parts:\n" + plate(9, "1")).model.parts] == [8, 9]
    assert "scene.yaml:5:9: error: part 8 is there already" in written(tmp_path, own + "parts:\n" + plate(8, "1")).messages
    base.write_text("parts:\n" + plate(8, "width"))
    assert "base.yaml:6:37: error: edge1: unknown parameter 'width'" in written(tmp_path, own).messages
    base.write_text("parameters: {a: 1}\n")  # messages name the scene again behind the bases
    assert "scene.yaml:4:8: error: the scene has no parts" in written(tmp_path, own + "parts: []\n").messages
