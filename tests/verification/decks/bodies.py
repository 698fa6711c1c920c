"""Decks of bodies.yaml: rigid bodies and joints whose motion is known, in steps of a given size."""
from __future__ import annotations

import numpy as np
from courant import DeckBuilder

_CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]) - 0.5


class Bodies(DeckBuilder):
    """Bodies of given mass and inertia, joined at points. Body 1 is the ground."""

    def __init__(self, title: str, end: float, step: float, samples: int = 2000) -> None:
        super().__init__(title, end)
        self._parts, self._joints = 0, 0
        self.card("*SECTION_SOLID", [1, 1])
        self.curve(90, [(0.0, step), (2 * end, step)])
        self.card("*CONTROL_TIMESTEP", [0, 0.9, 0, 0, 0, 90])
        self.card("*DATABASE_RBDOUT", [end / samples]).card("*DATABASE_GLSTAT", [end / samples])
        self.body(np.zeros(3), 1.0, np.ones(3), held=True)

    def body(self, x: np.ndarray, m: float, J: np.ndarray, v: np.ndarray | None = None, omega: np.ndarray | None = None, held: bool = False) -> int:
        """A body with its centre at x, mass m and principal moments J about the axes. Its part."""
        self._parts += 1
        part = self._parts
        self.elements("SOLID", part, self.nodes(x + 0.02 * _CUBE)[None, :])
        self.card("*PART_INERTIA", "body", [part, 1, part], [*map(float, x), m], [float(J[0]), 0.0, 0.0, float(J[1]), 0.0, float(J[2])],
                  [*map(float, np.zeros(3) if v is None else v), *map(float, np.zeros(3) if omega is None else omega)])
        self.card("*MAT_RIGID", [part, 1000.0, 1e9, 0.3], [1, 7, 7] if held else [0], "")
        return part

    def joint(self, kind: str, a: int, b: int, *points: np.ndarray) -> None:
        """Between bodies, with a node of each at every point."""
        ids = []
        for x in points:
            pair = self.nodes(np.array([x, x]))
            ids += [int(k) for k in pair]
            self.card("*CONSTRAINED_EXTRA_NODES_NODE", [a, ids[-2]], [b, ids[-1]])
        self.card(f"*CONSTRAINED_JOINT_{kind}", ids)


def pendulum(n: int = 100, joint: str = "REVOLUTE", degrees: float = 60.0, L: float = 1.0, m: float = 2.0, J: float = 0.05, g: float = 9.81) -> Bodies:
    """A body on a bar of length L that falls from an angle; n steps in a period of small swings."""
    omega = np.sqrt(m * g * L / (J + m * L * L))
    deck = Bodies("pendulum", 4 * 2 * np.pi / omega, 2 * np.pi / omega / n)
    turn = np.radians(degrees)
    body = deck.body(np.array([L * np.sin(turn), 0.0, -L * np.cos(turn)]), m, np.full(3, J))
    deck.joint(joint, 1, body, *([np.zeros(3), np.array([0.0, 1.0, 0.0])] if joint == "REVOLUTE" else [np.zeros(3)]))
    deck.gravity(g)
    return deck


def top(n: int = 100, spin: float = 60.0, r: float = 0.5, m: float = 1.0, J1: float = 0.03, J3: float = 0.05, g: float = 9.81) -> Bodies:
    """A top with its axis level, held at one end, in regular precession; n steps in a turn of the spin."""
    drift = m * g * r / (J3 * spin)  # of the axis, exact where it is level
    deck = Bodies("top", 2 * np.pi / drift, 2 * np.pi / spin / n)
    body = deck.body(np.array([r, 0.0, 0.0]), m, np.array([J3, J1, J1]), v=np.array([0.0, drift * r, 0.0]), omega=np.array([spin, 0.0, drift]))
    deck.joint("SPHERICAL", 1, body, np.zeros(3))
    deck.gravity(g)
    return deck


def free(n: int = 100, m: float = 1.0, A: float = 0.1, B: float = 0.07, C: float = 0.04, spin: float = 10.0) -> Bodies:
    """A body without forces that turns about its middle axis and turns over; n steps in a turn."""
    deck = Bodies("free body", 40 * 2 * np.pi / spin, 2 * np.pi / spin / n)
    deck.body(np.zeros(3), m, np.array([A, B, C]), omega=np.array([0.01 * spin, spin, 0.01 * spin]))
    return deck
