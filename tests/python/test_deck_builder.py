"""Decks made of grids and cards."""
from __future__ import annotations

import os
from pathlib import Path

import courant
import numpy as np
import pytest

needs_program = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


def test_grids_have_the_volume_of_their_size() -> None:
    line, plane, block = courant.grid([4], [2.0]), courant.grid([3, 2], [2.0, 1.0]), courant.grid([2, 3, 4], [1.0, 2.0, 3.0])
    assert [len(one.points) for one in (line, plane, block)] == [5, 12, 60] and [len(one.cells) for one in (line, plane, block)] == [4, 6, 24]
    x = plane.points[plane.cells]
    assert np.allclose(np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])[:, 2] / 2, 2 / 6)
    corners = block.points[block.cells]
    first = corners[:, [1, 3, 4]] - corners[:, :1]
    assert np.allclose(np.linalg.det(first), 6 / 24)
    assert list(block.points[block.where(2, 1)][:, 2]) == [3.0] * 12 and np.allclose(block.points[block.nearest(1, 1, 1)], [1, 2, 3])


def test_grids_follow_a_map() -> None:
    ring = courant.grid([4, 1], lambda u: np.column_stack([(1 + u[:, 1]) * np.cos(u[:, 0]), (1 + u[:, 1]) * np.sin(u[:, 0]), 0 * u[:, 0]]))
    assert np.allclose(np.linalg.norm(ring.points[ring.where(1, 1)], axis=1), 2)


def test_numbers_of_chosen_nodes_do_not_depend_on_the_mesh() -> None:
    for n in (2, 5):
        deck, of = courant.DeckBuilder("bar", 1.0), courant.grid([n, 1, 1], [1.0, 0.1, 0.1])
        ids = deck.mesh("SOLID", 1, of, [of.nearest(1, 1, 1)])
        assert ids[of.nearest(1, 1, 1)] == 1 and sorted(ids) == list(range(1, len(ids) + 1))


def test_arguments_without_a_meaning_are_refused() -> None:
    deck, of = courant.DeckBuilder("bar", 1.0), courant.grid([2, 1, 1], [1.0, 0.1, 0.1])
    ids = deck.mesh("SOLID", 1, of)
    for call, word in [(lambda: courant.grid([2, 0], [1.0, 1.0]), "counts"), (lambda: courant.grid([1, 1, 1, 1], [1.0] * 4), "counts"),
                       (lambda: courant.grid([1.5], [1.0]), "counts"), (lambda: courant.grid([2, 2], [1.0]), "to: a size"),
                       (lambda: courant.grid([2, 2], lambda u: u), "to: positions"), (lambda: deck.nodes(of.points[:, :2]), "points"),
                       (lambda: deck.nodes(np.full((1, 3), np.nan)), "points"), (lambda: deck.elements("BRICK", 1, ids[of.cells]), "kind"),
                       (lambda: deck.elements("SHELL", 1, ids[of.cells]), "nodes: 3 or 4"), (lambda: deck.elements("SOLID", 1, of.cells), "nodes: numbers"),
                       (lambda: deck.hold(ids, "xw"), "directions"), (lambda: deck.card("*MAT_ELASTIC", [1, float("nan")]), "finite")]:
        with pytest.raises(ValueError, match=word):
            call()
    assert deck.card("*PART", [1, True, None]).text().splitlines()[-4] == "1,1,,"


def test_meshes_are_joined_where_their_points_coincide() -> None:
    def ring(u: np.ndarray) -> np.ndarray:
        return np.column_stack([np.cos(2 * np.pi * u[:, 0]), np.sin(2 * np.pi * u[:, 0]), u[:, 1]])

    closed = courant.join(courant.grid([8, 2], ring))
    assert len(closed.points) == 8 * 3 and len(closed.cells) == 16 and np.all(np.bincount(closed.cells.ravel()) >= 2)
    two = courant.join(courant.grid([1, 1, 1], [1, 1, 1]), courant.grid([1, 1, 1], lambda u: u + [1, 0, 0]))
    assert len(two.points) == 12 and len(set(two.cells[0]) & set(two.cells[1])) == 4
    assert np.allclose(np.ptp(two.points[two.cells[1]], axis=0), 1)


def test_forces_are_shared_and_grow_until_a_third_of_the_end() -> None:
    deck = courant.DeckBuilder("load", 1.0).settle(2.0)
    assert deck.end == 9.0
    deck.load(np.array([3, 4]), 2, 8.0, np.array([1.0, 3.0]))
    assert "3,2,90,2.0," in deck.text() and "4,2,90,6.0," in deck.text() and "3.0,1.0," in deck.text() and "0,4.0," in deck.text()


@needs_program
def test_particles_weigh_and_press_as_given(tmp_path: Path) -> None:
    deck = courant.DeckBuilder("drop", 1e-4)
    deck.card("*PART", "water", [1, 1, 1, 1]).card("*SECTION_SPH", [1, 1.2]).card("*MAT_NULL", [1, 1000.0]).card("*EOS_LINEAR_POLYNOMIAL", [1, 0.0, 1e5])
    deck.card("*CONTROL_SPH", [1, 0, 1e20, 2]).card("*DATABASE_MATSUM", [1e-5]).card("*DATABASE_BINARY_D3PLOT", [1e-4])
    points = np.array([[0.1 * i, 0.1 * j, 0.0] for i in range(4) for j in range(4)])
    ids = deck.particles(1, points, 10.0, np.arange(16.0))
    assert sorted(ids) == list(range(1, 17))
    run = courant.run(deck.write(tmp_path / "drop.k"), tmp_path / "run", quiet=True)
    first = run.states[0]
    assert np.isclose(run.histories["parts/1/mass"][0], 160) and np.allclose(np.sort(first["pressure"]), np.arange(16.0), atol=1e-6)


@needs_program
def test_a_deck_runs(tmp_path: Path) -> None:
    """A bar that flies; a value alone on its card has more digits than a column."""
    deck = courant.DeckBuilder("flight", 1 / 3)
    deck.card("*PART", "bar", [1, 1, 1]).card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, 1000.0, 1e5, 0.3])
    of = courant.grid([3, 1, 1], [0.3, 0.1, 0.1])
    ids = deck.mesh("SOLID", 1, of, [0])
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 3.0, None, None] for i in ids)).history([1], 1 / 30)
    run = courant.run(deck.write(tmp_path / "flight.k"), tmp_path / "run", quiet=True)
    assert run.verdict == "sound"
    t = run.histories.t_of("nodes/1/displacement")
    assert abs(t[-1] - 1 / 3) < 0.01 and np.allclose(run.histories["nodes/1/displacement"][:, 0], 3 * t, atol=1e-9)
