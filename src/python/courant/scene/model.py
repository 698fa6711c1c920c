"""A scene as its description gives it, checked and with all expressions evaluated."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..diagnostics import Diagnostics, Location
from .distances import distances

LARGEST_ID = 99999999  # ids of nodes and elements have eight columns
MOST_ENTITIES = 5e7  # a typing error in a spacing should not fill the memory
MOST_JITTER = 0.5  # from there on two particles may meet

Variables = dict[str, float]
Vector = tuple[float, float, float]
ORIGIN: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class PlaceExpression:
    """An expression that may use the position x, y, z of a particle beside the scene's parameters; `where`: in the scene, for messages."""

    text: str
    where: Location


@dataclass
class Lattice:
    """A box filled with particles at the centres of cubes (squares in 2D) of side `spacing`."""

    dim: int  # 2: low and high have two components, particles lie in the plane z = 0
    low: Vector  # [L]
    spacing: float  # [L]
    n: tuple[int, int, int]  # cells along x, y, z
    where: PlaceExpression | None = None  # if given, only cells whose centre has a value > 0 have a particle
    jitter: float = 0.0  # largest shift along each axis, of the spacing [-]
    solids: list[Any] = field(default_factory=list)  # closed shapes that the particles fill; none: all of the box
    without: list[Any] = field(default_factory=list)  # closed shapes that the particles keep out of
    location: Location = field(default_factory=Location)  # of its entry, for messages

    @property
    def volume(self) -> float:
        """Of a cell [L3], in 2D per depth."""
        return self.spacing * self.spacing if self.dim == 2 else self.spacing * self.spacing * self.spacing


@dataclass
class Near:
    """What is inside a closed shape or nearer to it than a margin [L]."""

    shape: Any
    margin: float = 0.0

    def contains(self, x: np.ndarray) -> np.ndarray:
        inside: np.ndarray = self.shape.contains(x, self.margin)
        return inside


@dataclass
class NearSurface(Near):
    """What is nearer than the margin to a surface, on both sides."""

    def contains(self, x: np.ndarray) -> np.ndarray:
        return distances(self.shape, x, self.margin) < self.margin


@dataclass
class Plate:
    """A parallelogram of four-noded shells, so many along its edges."""

    origin: Vector  # [L]
    edge1: Vector
    edge2: Vector
    n: tuple[int, int]

    def nodes(self) -> np.ndarray:
        """Positions, those along edge2 first, shape ((n1 + 1) (n2 + 1), 3) [L]."""
        i, j = (np.arange(n + 1) / n for n in self.n)
        origin, edge1, edge2 = (np.array(v, dtype=float) for v in (self.origin, self.edge1, self.edge2))
        points: np.ndarray = (origin + edge1 * i[:, None, None]) + edge2 * j[None, :, None]
        return points.reshape(-1, 3)

    def shells(self) -> np.ndarray:
        """Numbers of their nodes, shape (n1 n2, 4)."""
        row = self.n[1] + 1
        a = (np.arange(self.n[0])[:, None] * row + np.arange(self.n[1])[None, :]).ravel()
        return np.stack([a, a + row, a + row + 1, a + 1], axis=1)

    @property
    def side(self) -> float:
        """The shortest side of its shells [L]."""
        return min(float(np.linalg.norm(edge)) / n for edge, n in zip((self.edge1, self.edge2), self.n))


@dataclass
class Part:
    """What a *PART and the elements of it say."""

    id: int = 0
    title: str = ""
    section: int = 0
    material: int = 0
    eos: int = 0
    hourglass: int = 0
    velocity: Vector | None = None  # initial [L/T]
    velocity_of_place: list[PlaceExpression] = field(default_factory=list)  # three, where one of them names x, y or z [L/T]
    pressure: PlaceExpression | None = None  # initial [M/LT2]
    density: float = 0.0  # > 0: elements carry a mass [M/L3]; 0: a volume, and RO of the material counts
    empty: bool = False  # it may begin without particles
    merge: bool = False  # plates of the part share the nodes they have in common
    first_id: int = 0  # of nodes and elements; 0: the next free one
    lattices: list[Lattice] = field(default_factory=list)
    plates: list[Any] = field(default_factory=list)  # Plate, Shape, Mesh: nodes(), shells(), side
    solids: list[Any] = field(default_factory=list)  # Mesh, beside plates or alone
    fixed: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=int))  # nodes, from 0, that are held
    carried: list[tuple[int, np.ndarray]] = field(default_factory=list)  # rigid parts, and the nodes that go with each
    shared: list[tuple[int, int, int]] = field(default_factory=list)  # a node, and the part and node that it is
    ties: list[Any] = field(default_factory=list)  # Tie: nodes that go with elements of other parts
    upwards: np.ndarray | None = None  # directions of the height of beams (m, 3)
    tracked: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=int))  # nodes with a history
    inertia: tuple[float, np.ndarray, np.ndarray] | None = None  # of a rigid part: mass, centre, tensor about it, for *PART_INERTIA
    where: Location = field(default_factory=Location)


@dataclass
class Model:
    """All that a deck is written from."""

    title: str = "untitled scene"
    parameters: list[tuple[str, float]] = field(default_factory=list)  # in the order of the file, after overrides
    variables: Variables = field(default_factory=dict)  # the same by name, and pi
    parts: list[Part] = field(default_factory=list)
    keywords: list[str] = field(default_factory=list)  # deck text, placeholders filled
    files: list[str] = field(default_factory=list)  # that it was read from
    choices: list[tuple[str, str, str]] = field(default_factory=list)  # what was chosen, the reason, the cards: for `Scene.explain`


@dataclass
class Fault(Exception):
    """A fault of an expression or a shape at a position in the scene."""

    where: Location
    message: str
    hint: str = ""

    def tell(self, diagnostics: Diagnostics) -> None:
        diagnostics.error(self.where, self.message, self.hint)
