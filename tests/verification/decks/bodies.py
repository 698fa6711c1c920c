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

    def joint(self, kind: str, a: int, b: int, *points: np.ndarray, more: list[float | int | None] | None = None) -> None:
        """Between bodies, with a node of each at every point, or, of a pair of points, of each at its own; `more`: the second card."""
        ids = []
        for x in points:
            pair = self.nodes(x if np.ndim(x) == 2 else np.array([x, x]))
            ids += [int(k) for k in pair]
            self.card("*CONSTRAINED_EXTRA_NODES_NODE", [a, ids[-2]], [b, ids[-1]])
        self.card(f"*CONSTRAINED_JOINT_{kind}", ids, *([more] if more else []))


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


def crank(n: int = 100, r: float = 0.1, l: float = 0.3, omega: float = 10.0, m: float = 2.0) -> Bodies:
    """A motor turns a crank, which drives a slider along x by a rod of length l; n steps in a turn, two turns."""
    deck = Bodies("slider crank", 2 * 2 * np.pi / omega, 2 * np.pi / omega / n)
    y, ends = np.array([0.0, 1.0, 0.0]), (np.zeros(3), np.array([r, 0.0, 0.0]), np.array([r + l, 0.0, 0.0]))
    wheel = deck.body(ends[0], m, np.full(3, 0.5 * m * r * r), omega=-omega * y, v=np.zeros(3))
    rod = deck.body(0.5 * (ends[1] + ends[2]), m, np.full(3, m * l * l / 12), omega=r / l * omega * y, v=np.array([0.0, 0.0, 0.5 * r * omega]))
    slider = deck.body(ends[2], m, np.full(3, 1e-3 * m))
    for a, b, x in ((1, wheel, ends[0]), (wheel, rod, ends[1]), (rod, slider, ends[2])):
        deck.joint("REVOLUTE", a, b, x, x + 0.1 * y)
    deck.joint("CYLINDRICAL", 1, slider, ends[2], ends[2] + np.array([0.1, 0.0, 0.0]))
    deck.curve(91, [(0.0, -omega), (2 * deck.end, -omega)])
    deck.joint("ROTATIONAL_MOTOR", 1, wheel, ends[0], 0.1 * y, more=[None, 91, 0])
    return deck


def gears(n: int = 100, ratio: float = 3.0, r: float = 0.1, torque: float = 1.0, J: float = 0.01, T: float = 0.5) -> Bodies:
    """A moment turns a wheel, which turns a second one, `ratio` times as large and slower; n steps in a radian of its start."""
    deck = Bodies("gears", T, np.sqrt(J / torque) / n)
    z = np.array([0.0, 0.0, 0.1])
    first = deck.body(np.zeros(3), 1.0, np.full(3, J))
    second = deck.body(np.array([(1 + ratio) * r, 0.0, 0.0]), 1.0, np.full(3, J * ratio**2))
    for body, x in ((first, np.zeros(3)), (second, np.array([(1 + ratio) * r, 0.0, 0.0]))):
        deck.joint("REVOLUTE", 1, body, x, x + z)
    at, touch = np.array([(1 + ratio) * r, 0.0, 0.0]), np.array([r, 0.0, 0.0])
    deck.joint("GEARS", first, second, np.array([np.zeros(3), at]), np.array([z, at + z]), touch, more=[ratio])
    deck.curve(91, [(0.0, 1.0), (2 * T, 1.0)])
    deck.card("*LOAD_RIGID_BODY", [first, 7, 91, torque])
    return deck


def swing(n: int = 100, k: float = 100.0, J: float = 0.5, omega: float = 1.0, stop: float = 0.0) -> Bodies:
    """A body that a spring of a joint turns back, or, behind `stop` degrees to each side, its stops; n steps in a period of the spring."""
    period = 2 * np.pi * np.sqrt(J / k)
    turn = np.radians(stop)
    deck = Bodies("turning on a spring", 4 * (period + 4 * turn / omega), period / n)
    body = deck.body(np.zeros(3), 1.0, np.full(3, J), omega=np.array([omega, 0.0, 0.0]))
    deck.joint("REVOLUTE", 1, body, np.zeros(3), np.array([0.1, 0.0, 0.0]))
    deck.curve(91, [(-4.0, -4.0 * k), (4.0, 4.0 * k)])
    deck.card("*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", [1, 1, body], [None if stop else 91], [k if stop else 0.0], [-stop, stop])
    return deck


def chain(n: int = 8, L: float = 1.0, m: float = 1.0, g: float = 9.81, joint: str = "SPHERICAL") -> Bodies:
    """A hanging chain of n links that begins to swing in the first mode of a string."""
    k = 1.2024127788478
    period = 2 * np.pi / (k * np.sqrt(g / L))
    deck = Bodies("hanging chain", 2.4 * period, period / 200 / n)
    l = L / n

    def shape(s: np.ndarray) -> np.ndarray:
        """J0 of the distance s from the lower end, by its series."""
        x = (k * np.sqrt(s / L)) ** 2
        return sum((-x) ** j / float(np.prod(np.arange(1.0, j + 1))) ** 2 for j in range(12))

    above, y = 1, np.array([0.0, 0.1, 0.0])
    for link in range(n):
        top, bottom = -l * link, -l * (link + 1)
        v = 1e-3 * shape(np.array([L + top, L + bottom]))
        body = deck.body(np.array([0.0, 0.0, 0.5 * (top + bottom)]), m / n, np.array([1.0, 1.0, 1e-2]) * m / n * l * l / 12, v=np.array([v.mean(), 0.0, 0.0]),
                         omega=np.array([0.0, (v[0] - v[1]) / l, 0.0]))
        deck.joint(joint, above, body, *([np.array([0.0, 0.0, top])] + ([np.array([0.0, 0.0, top]) + y] if joint == "REVOLUTE" else [])))
        above = body
    deck.gravity(g)
    return deck
