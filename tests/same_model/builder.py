"""One model, written once with dimensions and directions, as many decks: turned, mirrored, shifted, renumbered, in another order, in other units."""
from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

SI = (1.0, 1.0, 1.0)
# What 1 kg, 1 m and 1 s are in each system.
UNITS = {
    "SI": SI,
    "mm-t-s": (1e-3, 1e3, 1.0),
    "mm-kg-ms": (1.0, 1e3, 1e3),
    "cm-g-us": (1e3, 1e2, 1e6),
    "ft-slug-s": (1 / 14.593902937, 1 / 0.3048, 1.0),
}


@dataclass(frozen=True)
class Q:
    """A number with dimensions: value in SI, exponents of mass, length and time."""

    value: float
    m: float = 0
    l: float = 0
    t: float = 0


@dataclass(frozen=True)
class V:
    """A vector, three fields of a card. `kind`: point (shifts, too), polar, or axial (angular velocity, moment)."""

    xyz: Sequence[float]
    kind: str = "polar"
    m: float = 0
    l: float = 0
    t: float = 0


@dataclass(frozen=True)
class Ref:
    """The number of a node, element, part or set."""

    kind: str
    id: int


def length(x): return Q(x, l=1)
def area(x): return Q(x, l=2)
def time(x): return Q(x, t=1)
def mass(x): return Q(x, m=1)
def density(x): return Q(x, m=1, l=-3)
def stress(x): return Q(x, m=1, l=-1, t=-2)
def force(x): return Q(x, m=1, l=1, t=-2)
def moment(x): return Q(x, m=1, l=2, t=-2)
def inertia(x): return Q(x, m=1, l=2)
def speed(x): return Q(x, l=1, t=-1)
def rate(x): return Q(x, t=-1)
def acceleration(x): return Q(x, l=1, t=-2)
def stiffness(x): return Q(x, m=1, t=-2)
def damper(x): return Q(x, m=1, t=-1)
def point(x): return V(x, "point", l=1)
def direction(x): return V(x)
def velocity(x): return V(x, l=1, t=-1)
def spin(x): return V(x, "axial", t=-1)


def N(k): return Ref("node", k)
def E(k): return Ref("element", k)
def P(k): return Ref("part", k)
def S(k): return Ref("set", k)


@dataclass
class Change:
    """How a deck differs from the model as it was written."""

    name: str
    R: np.ndarray = field(default_factory=lambda: np.eye(3))
    shift: np.ndarray = field(default_factory=lambda: np.zeros(3))
    units: tuple = SI
    renumbered: bool = False
    order: int = 0  # seed; 0: as written
    bound: float = 1e-9  # of results, of their size

    @property
    def mirrors(self):
        return np.linalg.det(self.R) < 0

    def id(self, ref: Ref) -> int:
        return ref.id if not self.renumbered or ref.id == 0 else {"node": 100003, "element": 50021, "part": 97, "set": 83}[ref.kind] - 7 * ref.id + 6000

    def number(self, q) -> float:
        m, l, t = self.units
        return q.value * m**q.m * l**q.l * t**q.t

    def vector(self, v: V) -> np.ndarray:
        x = self.R @ np.asarray(v.xyz, float)
        if v.kind == "axial" and self.mirrors:
            x = -x
        if v.kind == "point":
            x = x + self.shift
        m, l, t = self.units
        return x * m**v.m * l**v.l * t**v.t

    def back(self, x: np.ndarray, kind: str, l: float, t: float) -> np.ndarray:
        """Rows of vectors of a run as the model has them."""
        x = x / (self.units[1] ** l * self.units[2] ** t)
        if kind == "point":
            x = x - self.shift
        return x @ self.R


def rotation(axis: Sequence[float], angle: float) -> np.ndarray:
    a = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def changes(size: float) -> list[Change]:
    """All of them, for a scene of a size."""
    out = [
        Change("turned a little", rotation((1, 2, 3), 0.3)),
        Change("turned far", rotation((-2, 1, 0.5), 2.4)),
        Change("axes in turn", np.eye(3)[[1, 2, 0]], bound=1e-10),
        Change("mirrored", np.diag([1.0, -1, 1]), bound=1e-10),
        Change("mirrored and turned", rotation((3, 1, 1), 1.1) @ np.diag([-1.0, 1, 1])),
        Change("shifted", shift=1000 * size * np.array([1, -0.7, 0.4]), bound=1e-6),
        Change("renumbered", renumbered=True, bound=1e-9),
        Change("in another order", order=1),
        Change("in another order, renumbered", order=2, renumbered=True),
    ]
    out += [Change(name, units=units) for name, units in UNITS.items() if name != "SI"]
    return out


@dataclass
class Model:
    """A scene. Elements that contact sees as sides keep them when it is mirrored: corners are named reversed."""

    name: str = ""
    steps: int = 200
    dt: float = 1e-5
    size: float = 1.0
    free: bool = False  # nothing acts from outside: momenta must stay
    planar_axes: bool = False  # written in global axes that cannot be turned
    skip: tuple = ()  # names of changes that the deck cannot express
    loose: dict = field(default_factory=dict)  # bounds of changes other than the usual ones, with a reason in the scene
    nodes: dict = field(default_factory=dict)
    blocks: list = field(default_factory=list)  # (keyword, lines, may be shuffled)
    joins: list = field(default_factory=list)  # keywords that join bodies: left out to find masses
    bodies: dict = field(default_factory=dict)  # of rigid ones: part to nodes
    riders: int = 0  # the rigid part that has the masses of all tied nodes

    def node(self, k: int, x: Sequence[float]):
        self.nodes[k] = np.asarray(x, float)

    def card(self, keyword: str, *lines, shuffled: bool = False, join: bool = False):
        self.blocks.append((keyword, [list(line) if not isinstance(line, str) else line for line in lines], shuffled))
        if join:
            self.joins.append(keyword)

    def solids(self, part: int, cells: dict):
        self.card("ELEMENT_SOLID", *([E(e), P(part), ("solid", [N(n) for n in c])] for e, c in cells.items()), shuffled=True)

    def shells(self, part: int, cells: dict):
        self.card("ELEMENT_SHELL", *([E(e), P(part), ("face", [N(n) for n in c])] for e, c in cells.items()), shuffled=True)

    def part(self, part: int, *more, section: int | None = None, material: int | None = None):
        self.card("PART", f"part {part}", [P(part), section or part, material or part, *more])

    def node_set(self, k: int, nodes: Iterable[int]):
        nodes = list(nodes)
        self.card("SET_NODE_LIST", [S(k)], *([N(n) for n in nodes[i : i + 8]] for i in range(0, len(nodes), 8)), shuffled=False)

    def segment_set(self, k: int, faces: Iterable[Sequence[int]]):
        self.card("SET_SEGMENT", [S(k)], *([("face", [N(n) for n in f])] for f in faces))

    def curve(self, k: int, pairs, of_x=lambda x: Q(x, t=1), of_y=lambda y: Q(y)):
        self.card("DEFINE_CURVE", [k], *([of_x(x), of_y(y)] for x, y in pairs))

    def moves(self, v: Callable, nodes: Iterable[int] | None = None):
        """Velocities at the start, of positions."""
        which = self.nodes if nodes is None else nodes
        self.card("INITIAL_VELOCITY_NODE", *([N(n), velocity(v(self.nodes[n]))] for n in which), shuffled=True)

    def spins(self, omega: Sequence[float], v: Sequence[float] = (0, 0, 0), nodes: Iterable[int] | None = None, centre=None):
        which = list(self.nodes if nodes is None else nodes)
        c = np.mean([self.nodes[n] for n in which], axis=0) if centre is None else np.asarray(centre)
        self.moves(lambda x: np.asarray(v) + np.cross(omega, x - c), which)

    def box(self, part: int, corner, size, cells, first: int, shells: bool = False) -> np.ndarray:
        """A block of solids, numbered from `first` on; returns nodes by (i, j, k)."""
        n = np.zeros([c + 1 for c in cells], int)
        k = first
        for index in np.ndindex(*n.shape):
            n[index] = k
            self.node(k, np.asarray(corner) + np.asarray(size) * np.array(index) / np.asarray(cells))
            k += 1
        e = {}
        for i, j, l in np.ndindex(*cells):
            a, b = n[i : i + 2, j : j + 2, l], n[i : i + 2, j : j + 2, l + 1]
            e[first + len(e)] = [int(q) for s in (a, b) for q in (s[0, 0], s[1, 0], s[1, 1], s[0, 1])]
        self.solids(part, e)
        return n

    def plate(self, part: int, corner, along, across, cells, first: int, triangles: bool = False) -> np.ndarray:
        n = np.zeros([c + 1 for c in cells], int)
        k = first
        for i, j in np.ndindex(*n.shape):
            n[i, j] = k
            self.node(k, np.asarray(corner) + np.asarray(along) * i / cells[0] + np.asarray(across) * j / cells[1])
            k += 1
        e = {}
        for i, j in np.ndindex(*cells):
            q = [int(n[i, j]), int(n[i + 1, j]), int(n[i + 1, j + 1]), int(n[i, j + 1])]
            for c in ([[q[0], q[1], q[2], q[2]], [q[0], q[2], q[3], q[3]]] if triangles else [q]):
                e[first + len(e)] = c
        self.shells(part, e)
        return n

    def water(self, part: int, corner, count, dx: float, rho: float, first: int):
        k = first
        rows = []
        for index in np.ndindex(*count):
            self.node(k, np.asarray(corner) + dx * (np.array(index) + 0.5))
            rows.append([N(k), P(part), mass(rho * dx**3)])
            k += 1
        self.card("ELEMENT_SPH", *rows, shuffled=True)
        return range(first, k)

    # -- as a deck ---------------------------------------------------------------------------------------------
    def line(self, tokens, c: Change) -> str:
        out = []
        for token in tokens:
            if isinstance(token, tuple):
                kind, refs = token
                refs = list(refs)
                if c.mirrors:
                    refs = mirrored_solid(refs) if kind == "solid" else mirrored_face(refs)
                out += [str(c.id(r)) for r in refs]
            elif isinstance(token, V):
                out += [f"{x:.17g}" for x in c.vector(token)]
            elif isinstance(token, Q):
                out.append(f"{c.number(token):.17g}")
            elif isinstance(token, Ref):
                out.append(str(c.id(token)))
            else:
                out.append("" if token is None else str(token))
        return ",".join(out) + ","  # without a comma a line has columns

    def deck(self, c: Change, steps: int | None = None, joined: bool = True) -> str:
        n = self.steps if steps is None else steps
        blocks = [("CONTROL_TERMINATION", [[time((n - 0.5) * self.dt)]], False),
                  ("CONTROL_TIMESTEP", [[0, 0.9, 0, 0, 0, 9001]], False),
                  ("DEFINE_CURVE", [[9001], [time(0), time(self.dt)], [time(1e3), time(self.dt)]], False),
                  ("NODE", [[N(k), V(x, "point", l=1)] for k, x in self.nodes.items()], True)]
        blocks += [b for b in self.blocks if joined or b[0] not in self.joins]
        if c.order:
            rng = random.Random(c.order)
            rng.shuffle(blocks)
            blocks = [(k, rng.sample(lines, len(lines)) if may else lines, may) for k, lines, may in blocks]
        text = "*KEYWORD\n"
        for keyword, lines, _ in blocks:
            text += f"*{keyword}\n" + "".join((l if isinstance(l, str) else self.line(l, c)) + "\n" for l in lines)
        return text + "*END\n"


def mirrored_face(refs):
    """Sides 1-2, along which shells have their axis, stay what they are."""
    return [refs[1], refs[0], *(refs[2:] if refs[2] == refs[3] else refs[:1:-1])]


def mirrored_solid(refs):
    if len(refs) == 8 and refs[3] == refs[4]:  # a tetrahedron
        return [refs[0], refs[2], refs[1], *refs[3:]]
    return [*refs[4:], *refs[:4]]  # the axes that IHQ 6 takes from the corners stay
