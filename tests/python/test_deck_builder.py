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
