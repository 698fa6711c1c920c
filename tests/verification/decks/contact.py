"""Decks of contact.yaml: bodies that slide, bounce and push each other as theory has it."""
from __future__ import annotations

import numpy as np
from courant import DeckBuilder, grid


def _contact(deck: DeckBuilder, kind: str, mu: float, soft: int, a: int = 1, b: int = 2) -> None:
    """Between parts, or of both in a single surface."""
    single = kind in ("AUTOMATIC_SINGLE_SURFACE", "AUTOMATIC_GENERAL")
    if single:
        deck.card("*SET_PART_LIST", [1], [a, b])
    rows: list[list[float | int | None]] = [[1, 0, 2, 0] if single else [a, b, 3, 3], [mu, mu], [None], [soft]]
    deck.card(f"*CONTACT_{kind}", *rows)


def _block(deck: DeckBuilder, n: int, size: tuple[float, float, float], E: float, rho: float, turn: np.ndarray, rigid: bool) -> np.ndarray:
    """Part 1 on a floor of shells, part 2, that is rigid or of rubber on a rigid base. Numbers of the nodes of the block."""
    deck.card("*SECTION_SOLID", [1, 1]).card("*SECTION_SHELL", [2, 2], [0.01] * 4)
    deck.card("*MAT_ELASTIC", [1, rho, E, 0.3]).card("*PART", "block", [1, 1, 1]).card("*PART", "floor", [2, 2 if rigid else 1, 2])
    of = grid([n, n, n], lambda u: (np.array([0.2, 0.05, 0.0]) + u * np.array(size)) @ turn.T)
    ids = deck.mesh("SOLID", 1, of, [of.nearest(0.5, 0.5, 0)])
    lower = -0.005 if rigid else -0.1
    if rigid:
        deck.card("*MAT_RIGID", [2, 7850.0, 2.1e11, 0.3], [1, 7, 7], "")
        deck.mesh("SHELL", 2, grid([12, 3], lambda u: np.column_stack([1.2 * u[:, 0], 0.2 * u[:, 1], np.full(len(u), lower)]) @ turn.T))
    else:
        deck.card("*MAT_ELASTIC", [2, 1000.0, 1e8, 0.3])
        floor = grid([24, 4, 2], lambda u: np.column_stack([1.2 * u[:, 0], 0.2 * u[:, 1], 0.1 * (u[:, 2] - 1)]) @ turn.T)
        below = deck.mesh("SOLID", 2, floor)
        deck.hold(below[floor.where(2, 0)], "xyz")
    return ids


def slide(n: int = 2, kind: str = "AUTOMATIC_SURFACE_TO_SURFACE", soft: int = 0, mu: float = 0.3, v0: float = 1.0, g: float = 9.81, rigid: int = 1,
          E: float = 1e9) -> DeckBuilder:
    """A block that slides on a floor until friction stops it."""
    deck = DeckBuilder("sliding block", 1.5 * v0 / (mu * g))
    ids = _block(deck, n, (0.1, 0.1, 0.1), E, 2000.0, np.eye(3), bool(rigid))
    _contact(deck, kind, mu, soft)
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), v0, 0.0, 0.0] for i in ids))
    deck.gravity(g)
    return deck.history([1], deck.end / 100)


def incline(n: int = 2, kind: str = "AUTOMATIC_SURFACE_TO_SURFACE", soft: int = 0, mu: float = 0.2, degrees: float = 20.0, g: float = 9.81, rigid: int = 1,
            E: float = 1e9, T: float = 0.4) -> DeckBuilder:
    """A block that begins to slide down a slope."""
    deck = DeckBuilder("block on a slope", T)
    a = np.radians(degrees)
    turn = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])  # x goes down
    _block(deck, n, (0.1, 0.1, 0.1), E, 2000.0, turn, bool(rigid))
    _contact(deck, kind, mu, soft)
    deck.gravity(g)
    return deck.history([1], T / 100)


def bars(n: int = 20, kind: str = "AUTOMATIC_SURFACE_TO_SURFACE", soft: int = 0, L: float = 1.0, h: float = 0.05, E: float = 2.1e11, rho: float = 7850.0,
         v0: float = 1.0) -> DeckBuilder:
    """A bar strikes an equal one that rests, end on: they exchange their speeds."""
    c = np.sqrt(E / rho)
    deck = DeckBuilder("bars", 3 * L / c)
    deck.card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, rho, E, 0.0])
    deck.card("*PART", "striker", [1, 1, 1]).card("*PART", "struck", [2, 1, 1])
    across = max(1, n // 20)
    first = deck.mesh("SOLID", 1, grid([n, across, across], lambda u: u * [L, h, h]))
    deck.mesh("SOLID", 2, grid([n, across, across], lambda u: u * [L, h, h] + [L + 1e-6, 0, 0]))
    _contact(deck, kind, 0.0, soft)
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), v0, 0.0, 0.0] for i in first))
    deck.card("*DATABASE_MATSUM", [deck.end / 200])
    return deck.history([1], deck.end / 200)
