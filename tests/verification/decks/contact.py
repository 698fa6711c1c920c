"""Decks of contact.yaml and contact_ties.yaml: bodies that slide, bounce and push each other as theory has it."""
from __future__ import annotations

import numpy as np
from courant import DeckBuilder, grid, join


def _contact(deck: DeckBuilder, kind: str, mu: float, soft: int, a: int = 1, b: int = 2, scale: float = 1.0) -> None:
    """Between parts, or of both in a single surface; `scale` of the penalty stiffness."""
    single = kind in ("AUTOMATIC_SINGLE_SURFACE", "AUTOMATIC_GENERAL")
    if single:
        deck.card("*SET_PART_LIST", [1], [a, b])
    rows: list[list[float | int | None]] = [[1, 0, 2, 0] if single else [a, b, 3, 3], [mu, mu], [scale, scale]]
    if kind.startswith("ERODING"):
        rows.append([0, 1, 0])
    deck.card(f"*CONTACT_{kind}", *rows, [soft])


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


def bounce(n: int = 2, kind: str = "AUTOMATIC_SURFACE_TO_SURFACE", soft: int = 0, scale: float = 1.0, tssfac: float = 0.9, degrees: float = 0.0, v0: float = 1.0, L: float = 0.1,
           E: float = 2.1e9) -> DeckBuilder:
    """A rigid cube, turned by an angle about y, flies at a rigid plate; its middle is above the place that it strikes if it is turned by 0 or 45 degrees."""
    deck = DeckBuilder("bouncing cube", 0.1 * L / v0)
    deck.card("*SECTION_SOLID", [1, 1]).card("*SECTION_SHELL", [2, 2], [0.01] * 4).card("*CONTROL_TIMESTEP", [0, tssfac])
    deck.card("*MAT_RIGID", [1, 2000.0, E, 0.3], [0], "").card("*PART", "cube", [1, 1, 1])
    deck.card("*MAT_RIGID", [2, 7850.0, E, 0.3], [1, 7, 7], "").card("*PART", "plate", [2, 2, 2])
    a = np.radians(degrees)
    high = 0.5 * L * (np.cos(a) + np.sin(a)) + 0.005 + 0.02 * L
    turn = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    deck.mesh("SOLID", 1, grid([n, n, n], lambda u: L * (u - 0.5) @ turn.T + [0, 0, high]))
    deck.mesh("SHELL", 2, grid([4, 4], lambda u: np.column_stack([3 * L * (u - 0.51), np.zeros(len(u))])))
    deck.card("*INITIAL_VELOCITY_RIGID_BODY", [1, 0.0, 0.0, -v0])
    _contact(deck, kind, 0.0, soft, scale=scale)
    deck.card("*DATABASE_MATSUM", [deck.end / 200]).card("*DATABASE_RBDOUT", [deck.end / 200]).card("*DATABASE_GLSTAT", [deck.end / 200])
    return deck


def roll(n: int = 8, kind: str = "AUTOMATIC_SURFACE_TO_SURFACE", soft: int = 0, scale: float = 1.0, mu: float = 0.5, degrees: float = 10.0, R: float = 0.05, g: float = 9.81,
         T: float = 0.5, gap: float = 0.0) -> DeckBuilder:
    """A rigid wheel, a polygon of 4 n sides, rolls down a slope, which is turned level: gravity is turned instead. It begins `gap` above it."""
    deck = DeckBuilder("rolling wheel", T)
    deck.card("*SECTION_SOLID", [1, 1]).card("*SECTION_SHELL", [2, 2], [0.01] * 4)
    deck.card("*MAT_RIGID", [1, 2000.0, 2.1e9, 0.3], [1, 2, 6], "").card("*PART", "wheel", [1, 1, 1])
    deck.card("*MAT_RIGID", [2, 7850.0, 2.1e9, 0.3], [1, 7, 7], "").card("*PART", "slope", [2, 2, 2])

    def mapped(u: np.ndarray) -> np.ndarray:
        v = np.tan(0.25 * np.pi * (2 * u[:, :2] - 1))  # equal sides around
        most, length = np.abs(v).max(axis=1), np.maximum(np.linalg.norm(v, axis=1), 1e-12)
        return np.column_stack([R * most * v[:, 0] / length, 0.02 * (u[:, 2] - 0.5), R * most * v[:, 1] / length])

    wheel = grid([n, n, 1], mapped)
    wheel = wheel._replace(points=wheel.points + [0, 0, 0.005 + gap - wheel.points[:, 2].min()], cells=wheel.cells[:, [4, 5, 6, 7, 0, 1, 2, 3]])  # right-handed
    deck.mesh("SOLID", 1, wheel)
    deck.mesh("SHELL", 2, grid([20, 2], lambda u: np.column_stack([0.5 * u[:, 0] - 0.1, 0.1 * (u[:, 1] - 0.5), 0 * u[:, 0]])))
    _contact(deck, kind, mu, soft, scale=scale)
    a = np.radians(degrees)
    deck.gravity(g * float(np.cos(a)))
    deck.card("*LOAD_BODY_X", [91, -g * float(np.sin(a))])
    deck.card("*DATABASE_RBDOUT", [T / 200]).card("*DATABASE_GLSTAT", [T / 200])
    return deck


def cross(n: int = 4, kind: str = "AUTOMATIC_GENERAL", soft: int = 0, scale: float = 1.0, tssfac: float = 0.9, L: float = 0.2, h: float = 0.01, v0: float = 1.0) -> DeckBuilder:
    """A rigid strip on edge falls across an equal one and strikes its edge in the middle; both are free."""
    deck = DeckBuilder("edge on edge", 0.5 * h / v0)
    deck.card("*SECTION_SHELL", [1, 2], [h] * 4).card("*CONTROL_TIMESTEP", [0, tssfac])
    for part, low, middle in ((1, 1.05 * h, 0.49), (2, -0.05, 0.51)):
        deck.card("*MAT_RIGID", [part, 2000.0, 2.1e9, 0.3], [0], "").card("*PART", "strip", [part, 1, part])
        along = np.eye(3)[part - 1]
        deck.mesh("SHELL", part, grid([n, 1], lambda u: L * (u[:, :1] - middle) * along + np.column_stack([0 * u, low + 0.05 * u[:, 1]])))
    deck.card("*INITIAL_VELOCITY_RIGID_BODY", [1, 0.0, 0.0, -v0])
    _contact(deck, kind, 0.0, soft, scale=scale)
    deck.card("*DATABASE_MATSUM", [deck.end / 200]).card("*DATABASE_GLSTAT", [deck.end / 200])
    return deck


def hertz(n: int = 6, kind: str = "RIGIDWALL", soft: int = 0, scale: float = 1.0, ihq: int = 5, qm: float = 0.05, R: float = 0.01, E: float = 2.1e11, nu: float = 0.3, rho: float = 7800.0,
          v0: float = 10.0) -> DeckBuilder:
    """An elastic ball of n^3 elements in its middle and six caps flies against a rigid plane, z = 0; node 1 is its middle."""
    m = 4 / 3 * np.pi * R**3 * rho
    deck = DeckBuilder("ball on a plane", 1.25 * 1.4716 / v0 * (15 * m * v0**2 * (1 - nu**2) / (16 * E * np.sqrt(R))) ** 0.4)
    deck.card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, rho, E, nu]).card("*PART", "ball", [1, 1, 1, 0, 1]).card("*HOURGLASS", [1, ihq, qm])

    def on_sphere(v: np.ndarray) -> np.ndarray:
        s = np.tan(0.25 * np.pi * v / np.abs(v).max(axis=1, keepdims=True))
        return s / np.linalg.norm(s, axis=1, keepdims=True)

    def core(u: np.ndarray) -> np.ndarray:
        v = np.sign(u - 0.5) * np.abs(2 * u - 1) ** 1.3  # smaller towards the middle of each cap
        most = np.abs(v).max(axis=1, keepdims=True)
        return 0.45 * R * ((1 - 0.35 * most) * v + 1.25 * 0.35 * most**2 * on_sphere(np.where(most > 0, v, 1.0)))

    def cap(axis: int, side: int):
        def mapped(u: np.ndarray) -> np.ndarray:
            v = np.empty((len(u), 3))
            v[:, axis], v[:, (axis + 1) % 3], v[:, (axis + 2) % 3] = (side + 1) / 2, u[:, 0] if side > 0 else 1 - u[:, 0], u[:, 1]
            inner = core(v)
            return inner + (R * on_sphere(np.sign(v - 0.5) * np.abs(2 * v - 1) ** 1.3) - inner) * u[:, 2:]
        return grid([n, n, max(n // 2, 2)], mapped)

    mesh = join(grid([n, n, n], core), *(cap(axis, side) for axis in range(3) for side in (-1, 1)))
    mesh = mesh._replace(points=mesh.points + [0, 0, R])
    ids = deck.mesh("SOLID", 1, mesh, [int(np.argmin(np.linalg.norm(mesh.points - [0, 0, R], axis=1)))])
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.0, 0.0, -v0] for i in ids))
    if kind == "RIGIDWALL":
        deck.card("*RIGIDWALL_PLANAR", [0], [0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    else:
        deck.card("*SECTION_SHELL", [2, 2], [1e-5] * 4).card("*MAT_RIGID", [2, rho, E, nu], [1, 7, 7], "").card("*PART", "plane", [2, 2, 2])
        deck.mesh("SHELL", 2, grid([4, 4], lambda u: np.column_stack([2 * R * (u - 0.5), np.full(len(u), -0.5e-5)])))
        _contact(deck, kind, 0.0, soft, scale=scale)
    deck.card("*DATABASE_MATSUM", [deck.end / 400])
    return deck.history([1], deck.end / 400)


def sleeves(n: int = 4, kind: str = "AUTOMATIC_SURFACE_TO_SURFACE", soft: int = 0, scale: float = 1.0, ratio: float = 1.0, a: float = 1.0, b: float = 1.5,
            c: float = 2.0, gap: float = 1e-4, E: float = 2.1e11, nu: float = 0.3, p: float = 4e7) -> DeckBuilder:
    """A quarter of a tube, pressed by a pressure from inside against a second one around it, which it reaches across a gap; strained in the plane."""
    deck, rho = DeckBuilder("tube in a tube", 1), 7850.0
    deck.card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, rho, E, nu]).card("*PART", "inner", [1, 1, 1]).card("*PART", "outer", [2, 1, 1])

    def ring(inner: float, outer: float, across: int, around: int):
        def mapped(u: np.ndarray) -> np.ndarray:
            r, turn = inner + (outer - inner) * u[:, 0], 0.5 * np.pi * u[:, 1]
            return np.column_stack([r * np.cos(turn), r * np.sin(turn), 0.1 * u[:, 2]])
        return grid([across, around, 1], mapped)

    outside = ring(b + gap, c + gap, n, int(round(4 * n * ratio)))
    inside = ring(a, b, n, 4 * n)
    outer = deck.mesh("SOLID", 2, outside, [outside.nearest(1, 0, 0)])
    inner = deck.mesh("SOLID", 1, inside)
    for mesh, ids in ((outside, outer), (inside, inner)):
        deck.hold(ids, "z").hold(ids[mesh.where(1, 0)], "y").hold(ids[mesh.where(1, 1)], "x")
    deck.settle(float(0.5 * np.sqrt(E / rho) / c))
    faces = [inner[cell[[0, 4, 7, 3]]] for cell in inside.cells if inside.unit[cell[0], 0] < 1e-9]
    deck.card("*SET_SEGMENT", [1], *([int(k) for k in corners] for corners in faces)).card("*LOAD_SEGMENT_SET", [1, 90, p])
    _contact(deck, kind, 0.0, soft, scale=scale)
    return deck.history([1], deck.end / 200)


def stack(n: int = 2, kind: str = "AUTOMATIC_SINGLE_SURFACE", soft: int = 0, scale: float = 1.0, L: float = 0.1, E: float = 1e7, rho: float = 1000.0,
          g: float = 9.81) -> DeckBuilder:
    """Four cubes on each other and on a floor that is held, meshes of n and n + 1 in turn, come to rest under their weight."""
    deck = DeckBuilder("stack", 1)
    deck.card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, rho, E, 0.0])
    for k in range(5):  # the top one first, whose upper middle is node 1; the floor last
        deck.card("*PART", "cube" if k < 4 else "floor", [k + 1, 1, 1])
        side = 1.0 if k < 4 else 2.0
        pieces = (n if k % 2 else n + 1) if k < 4 else 2
        low = np.array([-0.5 * side, -0.5 * side, 3.0 - k])
        mesh = grid([pieces, pieces, n if k < 4 else 1], lambda u: L * (low + u * [side, side, 1.0]))
        ids = deck.mesh("SOLID", k + 1, mesh, [mesh.nearest(0.5, 0.5, 1)] if k == 0 else [])
        if k == 4:
            deck.hold(ids, "xyz")
        else:
            deck.hold(ids[mesh.where(0, 0)], "x").hold(ids[mesh.where(1, 0)], "y")
    if kind == "AUTOMATIC_SINGLE_SURFACE":
        deck.card("*SET_PART_LIST", [1], [1, 2, 3, 4, 5])
        deck.card(f"*CONTACT_{kind}", [1, 0, 2, 0], [0.0], [scale, scale], [soft])
    else:
        for k in range(4):
            _contact(deck, kind, 0.0, soft, k + 1, k + 2, scale)
    deck.settle(float(0.06 * np.pi * np.sqrt(E / rho) / (4 * L)))
    deck.card("*LOAD_BODY_Z", [90, g])
    return deck.history([1], deck.end / 200)


def tied(n: int = 4, kind: str = "SURFACE_TO_SURFACE", ratio: float = 2.0, wave: int = 1, scale: float = 1.0, L: float = 1.0, h: float = 0.25, E: float = 2.1e11,
         rho: float = 7850.0, P: float = 1e6) -> DeckBuilder:
    """A bar of two halves of n and `ratio` n cells that are tied, the finer nodes on the coarser faces: free and swinging along its axis, or pulled at its end."""
    deck = DeckBuilder("tied bar", 2.4 * 2 * L / np.sqrt(E / rho))
    deck.card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, rho, E, 0.0]).card("*PART", "coarse", [1, 1, 1]).card("*PART", "fine", [2, 1, 1])
    ends = []
    for part, cells in ((2, int(round(ratio * n))), (1, n)):
        across = max(cells // 2, 1)
        mesh = grid([cells, across, across], lambda u: (u + [part - 1, 0, 0]) * [0.5 * L, h, h])
        ids = deck.mesh("SOLID", part, mesh, [mesh.nearest(1, 0.5, 0.5)] if part == 2 else [])
        ends.append((mesh, ids))
    deck.card(f"*CONTACT_TIED_{kind}", [2, 1, 3, 3], [None], [scale, scale] if "OFFSET" in kind and "CONSTRAINED" not in kind else [None])
    if wave:
        deck.card("*INITIAL_VELOCITY_NODE", *([int(i), float(np.cos(np.pi * x / L)), 0.0, 0.0] for mesh, ids in ends for i, x in zip(ids, mesh.points[:, 0])))
    else:
        (fine, pulled), (coarse, held) = ends
        deck.hold(held[coarse.where(0, 0)], "xyz").settle(0.5 * np.pi * np.sqrt(E / rho) / L)
        edge = np.ones(int(round(np.sqrt(len(fine.where(0, 1))))))
        edge[[0, -1]] = 0.5
        deck.load(pulled[fine.where(0, 1)], 1, P, np.outer(edge, edge).ravel())
    return deck.history([1], deck.end / 400)


def tiebreak(n: int = 2, kind: str = "AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK", option: int = 2, L: float = 0.1, E: float = 1e8, rho: float = 1000.0,
             NFLS: float = 1e5) -> DeckBuilder:
    """Two cubes that are glued; the upper one is drawn off by its upper face, slowly, until the glue breaks."""
    T = 200 * L / np.sqrt(E / rho)
    deck = DeckBuilder("tiebreak", T)
    deck.card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, rho, E, 0.0]).card("*PART", "upper", [1, 1, 1]).card("*PART", "lower", [2, 1, 1])
    upper, lower = grid([2 * n, 2 * n, n], lambda u: L * (u + [0, 0, 1])), grid([n, n, n], lambda u: L * u)
    first, second = deck.mesh("SOLID", 1, upper), deck.mesh("SOLID", 2, lower)
    deck.hold(second[lower.where(2, 0)], "xyz").hold(first[upper.where(2, 1)], "xy")
    strain = 2.5 * NFLS / E
    deck.curve(90, [(0.0, 0.0), (T, 2 * L * strain)])
    deck.card("*BOUNDARY_PRESCRIBED_MOTION_SET", [deck.node_set(first[upper.where(2, 1)]), 3, 2, 90])
    deck.card(f"*CONTACT_{kind}", [1, 2, 3, 3], [None], [10.0, 10.0], [option, NFLS, NFLS, 0.2 * L * strain if option in (6, 8) else None])
    deck.card("*DATABASE_RCFORC", [T / 1000])
    return deck.history([1], T / 400)


def peg(n: int = 2, kind: str = "AUTOMATIC_SURFACE_TO_SURFACE", soft: int = 0, scale: float = 1.0, L: float = 0.1, play: float = 2e-3, v0: float = 10.0,
        E: float = 2.1e9, rho: float = 2000.0) -> DeckBuilder:
    """A square peg flies through a square hole with play, and bounces between its walls without friction."""
    deck = DeckBuilder("peg with play", 0.05)
    deck.card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, rho, E, 0.3]).card("*PART", "peg", [1, 1, 1])
    deck.card("*MAT_RIGID", [2, 7850.0, 2.1e11, 0.3], [1, 7, 7], "").card("*PART", "hole", [2, 1, 2])
    ids = deck.mesh("SOLID", 1, grid([2 * n, n, n], lambda u: L * (u * [2, 1, 1] - [0, 0.5, 0.5])))
    half, wall = 0.5 * L + play, 0.2 * L
    for axis in (1, 2):
        for side in (-1, 1):
            low, size = np.array([-L, -half - wall, -half - wall]), np.array([12 * L, 2 * (half + wall), 2 * (half + wall)])
            low[axis] = half if side > 0 else -half - wall
            size[axis] = wall
            deck.mesh("SOLID", 2, grid([24, 3 if axis == 2 else 1, 3 if axis == 1 else 1], lambda u: low + u * size))
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), v0, 0.3 * v0, 0.2 * v0] for i in ids))
    _contact(deck, kind, 0.0, soft, scale=scale)
    deck.card("*DATABASE_MATSUM", [deck.end / 400])
    return deck.history([1], deck.end / 400)


def pellet(n: int = 2, kind: str = "ERODING_SURFACE_TO_SURFACE", soft: int = 0, scale: float = 1.0, v0: float = 600.0, L: float = 0.01) -> DeckBuilder:
    """A cube flies through a free plate of the same metal; solids of both are deleted by their strain."""
    deck = DeckBuilder("eroding pellet", 8 * L / v0)
    deck.card("*SECTION_SOLID", [1, 1]).card("*MAT_PLASTIC_KINEMATIC", [1, 2770.0, 72.4e9, 0.33, 345e6, 100e6, 1.0], [0.0, 0.0, 0.3])
    deck.card("*PART", "pellet", [1, 1, 1]).card("*PART", "plate", [2, 1, 1])
    ids = deck.mesh("SOLID", 1, grid([2 * n, 2 * n, 2 * n], lambda u: L * (u - [0.5, 0.5, 0]) + [0, 0, 1e-5]))
    deck.mesh("SOLID", 2, grid([6 * n, 6 * n, n], lambda u: L * (u * [3, 3, 0.5] - [1.53, 1.47, 0.5])))
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.0, 0.0, -v0] for i in ids))
    _contact(deck, kind, 0.0, soft, scale=scale)
    deck.card("*DATABASE_MATSUM", [deck.end / 400])
    return deck.history([1], deck.end / 400)
