"""Decks of structures.yaml and structures_large.yaml: structures whose answer is known, by any element.

Loads that stay are put on along a smooth curve in a third of the time, with damping near that of the lowest frequency, so that the end is at rest.
"""
from __future__ import annotations

import numpy as np
from courant import DeckBuilder, grid, join

def section(deck: DeckBuilder, kind: str, elform: int, thickness: float, nip: int) -> None:
    if kind == "SHELL":
        deck.card("*SECTION_SHELL", [1, elform, 5 / 6, nip], [thickness] * 4)
    else:
        deck.card("*SECTION_SOLID", [1, elform])


def part(deck: DeckBuilder, title: str, ihq: int, qm: float) -> None:
    """Part 1 of section 1 and material 1, with hourglass control where IHQ is given."""
    deck.card("*PART", title, [1, 1, 1, 0, 1 if ihq else 0])
    if ihq:
        deck.card("*HOURGLASS", [1, ihq, qm])


def of_an_edge(n: int) -> np.ndarray:
    """Shares of a uniform load on an edge of n elements."""
    out = np.ones(n + 1)
    out[[0, -1]] = 0.5
    return out


def rod(deck: DeckBuilder, kind: str, elform: int, n: int, L: float, h: float, nip: int = 2, qr: int = 2, deep: int = 2, finer: int = 4, at: float = 1.0, to=None):
    """Part 1 along x, of length L and square section h: n beams or shells, or `finer` n solids along it and `deep` over its height. Its mesh, numbers of its
    nodes, and shares of a load on an end. Node 1 is at `at` of the length; `to` takes positions along the unit line to others."""
    def along(u: np.ndarray) -> np.ndarray:
        return L * (u[:, 0] if to is None else to(u[:, 0]))

    if kind == "BEAM":
        by_points, resultant = [h] * 4, [h * h, h**4 / 12, h**4 / 12, 0.1406 * h**4, 5 / 6 * h * h]
        deck.card("*SECTION_BEAM", [1, elform, 5 / 6, qr, 0], {1: by_points, 2: resultant, 3: [h * h]}[elform])
        mesh = grid([n], lambda u: np.column_stack([along(u), 0 * u, 0 * u]))
        ids = deck.nodes(mesh.points, [mesh.nearest(at)])
        third = deck.nodes(np.array([[0.5 * L, L, 0]]))
        deck.elements("BEAM", 1, np.column_stack([ids[mesh.cells], np.full(n, third[0])]))
        return mesh, ids, None
    section(deck, kind, elform, h, nip)
    mesh = grid([n, 1] if kind == "SHELL" else [finer * n, 1, deep],
                lambda u: np.column_stack([along(u), h * (u[:, 1] - 0.5), h * (u[:, 2] - 0.5) if kind == "SOLID" else 0 * u[:, 0]]))
    ids = deck.mesh(kind, 1, mesh, [mesh.nearest(*([at, 0] if kind == "SHELL" else [at, 0, 0.5]))])
    return mesh, ids, None if kind == "SHELL" else np.outer(of_an_edge(deep), [1, 1]).ravel()


def cantilever(n: int = 16, kind: str = "SOLID", elform: int = 1, ihq: int = 0, qm: float = 0.1, nip: int = 3, across: int = 2, nu: float = 0.0,
               L: float = 1.0, h: float = 0.1, E: float = 2.1e11, rho: float = 7850.0, P: float = 1000.0) -> DeckBuilder:
    """A square bar that is clamped at one end and bent by a force P at the other; `across` elements over its height and width."""
    deck = DeckBuilder("cantilever", 1)
    omega = 3.516 * np.sqrt(E * h**2 / 12 / rho) / L**2
    part(deck, "bar", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, E, nu])
    if kind == "BEAM":
        deck.card("*SECTION_BEAM", [1, elform, 5 / 6, 2, 0], [h, h, h, h] if elform == 1 else [h * h, h**4 / 12, h**4 / 12, 0.1406 * h**4, 5 / 6 * h * h])
        mesh = grid([n], [L])
        ids = deck.nodes(mesh.points, [n])
        third = deck.nodes(np.array([[0.5 * L, 0, L]]))
        deck.elements("BEAM", 1, np.column_stack([ids[mesh.cells], np.full(n, third[0])]))
        clamped, end, weights = ids[:1], ids[-1:], None
    elif kind == "SHELL":
        section(deck, kind, elform, h, nip)
        mesh = grid([n, across], [L, h])
        ids = deck.mesh(kind, 1, mesh, [mesh.nearest(1, 0.5)])
        clamped, end, weights = ids[mesh.where(0, 0)], ids[mesh.where(0, 1)], of_an_edge(across)
    else:
        section(deck, kind, elform, h, nip)
        mesh = grid([n, across, across], [L, h, h])
        ids = deck.mesh(kind, 1, mesh, [mesh.nearest(1, 0.5, 0.5)])
        clamped, end, weights = ids[mesh.where(0, 0)], ids[mesh.where(0, 1)], np.outer(of_an_edge(across), of_an_edge(across)).ravel()
    deck.hold(clamped, "xyzXYZ" if kind != "SOLID" else "xyz")
    deck.settle(omega)
    deck.load(end, 3, P, weights)
    return deck.history([1], deck.end / 200)


def cook(n: int = 16, elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2) -> DeckBuilder:
    """Cook's membrane of E 1, thickness 1, nu 1/3 under a thousandth of its usual load, along its free edge."""
    deck = DeckBuilder("Cook's membrane", 1)
    section(deck, "SHELL", elform, 1.0, 2)
    part(deck, "membrane", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, 1.0, 1.0, 1 / 3]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])

    def mapped(u: np.ndarray) -> np.ndarray:
        low, high = 44 * u[:, 0], 44 + 16 * u[:, 0]
        return np.column_stack([48 * u[:, 0], low + u[:, 1] * (high - low), np.zeros(len(u))])

    mesh = grid([n, n], mapped)
    ids = deck.mesh("SHELL", 1, mesh, [mesh.nearest(1, 0.5)])
    clamped = mesh.where(0, 0)
    deck.hold(ids, "zXY").hold(ids[clamped], "xyZ")
    deck.settle(0.011)
    deck.load(ids[mesh.where(0, 1)], 2, 1e-3, of_an_edge(n))
    return deck.history([1], deck.end / 200)


def cook_solid(n: int = 16, elform: int = 1, ihq: int = 0, qm: float = 0.1, nu: float = 0.4999) -> DeckBuilder:
    """The same membrane of solids, one over its thickness and strained in the plane, nearly incompressible."""
    deck = DeckBuilder("Cook's membrane in plane strain", 1)
    section(deck, "SOLID", elform, 0, 0)
    part(deck, "membrane", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, 1.0, 1.0, nu])
    mesh = grid([n, n, 1], lambda u: np.column_stack([48 * u[:, 0], 44 * u[:, 0] + u[:, 1] * (44 - 28 * u[:, 0]), u[:, 2]]))
    ids = deck.mesh("SOLID", 1, mesh, [mesh.nearest(1, 0.5, 0)])
    deck.hold(ids, "z").hold(ids[mesh.where(0, 0)], "xy")
    deck.settle(0.011)
    deck.load(ids[mesh.where(0, 1)], 2, 1e-3, np.outer([1, 1], of_an_edge(n)).ravel())
    return deck.history([1], deck.end / 200)


def roof(n: int = 8, elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2) -> DeckBuilder:
    """A quarter of the roof of Scordelis and Lo on diaphragms, under a hundredth of its weight of 90 per area: the reference is linear."""
    R, L, t, angle, rho = 25.0, 50.0, 0.25, np.radians(40), 360.0
    deck = DeckBuilder("Scordelis-Lo roof", 1)
    section(deck, "SHELL", elform, t, 2)
    part(deck, "roof", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, 4.32e8, 0.0]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    mesh = grid([n, n], lambda u: np.column_stack([R * np.sin(angle * u[:, 0]), 0.5 * L * u[:, 1], R * np.cos(angle * u[:, 0])]))
    ids = deck.mesh("SHELL", 1, mesh, [mesh.nearest(1, 1)])
    deck.hold(ids[mesh.where(1, 0)], "xz").hold(ids[mesh.where(1, 1)], "yXZ").hold(ids[mesh.where(0, 0)], "xYZ")
    deck.settle(1.8)
    deck.card("*LOAD_BODY_Z", [90, 0.9 / (rho * t)])  # acts along -z
    return deck.history([1], deck.end / 200)


def hemisphere(n: int = 16, elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2) -> DeckBuilder:
    """A quarter of a hemisphere with a hole of 18 degrees, drawn apart along x and pressed together along y by forces of 2."""
    R, t, rho = 10.0, 0.04, 1.0
    deck = DeckBuilder("hemisphere with a hole", 1)
    section(deck, "SHELL", elform, t, 2)
    part(deck, "shell", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, 6.825e7, 0.3]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])

    def mapped(u: np.ndarray) -> np.ndarray:
        around, up = 0.5 * np.pi * u[:, 0], np.radians(72) * u[:, 1]
        return R * np.column_stack([np.cos(around) * np.cos(up), np.sin(around) * np.cos(up), np.sin(up)])

    mesh = grid([n, n], mapped)
    ids = deck.mesh("SHELL", 1, mesh, [mesh.nearest(0, 0), mesh.nearest(1, 0)])
    deck.hold(ids[mesh.where(0, 0)], "yXZ").hold(ids[mesh.where(0, 1)], "xYZ")
    first, second = ids[mesh.nearest(0, 0)], ids[mesh.nearest(1, 0)]
    deck.hold(np.array([ids[mesh.nearest(0.5, 1)]]), "z")
    deck.settle(2.3)
    deck.load(np.array([first]), 1, 1.0)
    deck.load(np.array([second]), 2, -1.0)
    return deck.history([1, 2], deck.end / 200)


def twisted(n: int = 24, kind: str = "SHELL", elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2, direction: int = 3) -> DeckBuilder:
    """A strip that is twisted by 90 degrees from its clamped end on, with a unit force at the other in the plane of that end (3) or across it (2)."""
    L, w, t = 12.0, 1.1, 0.32
    deck = DeckBuilder("twisted beam", 1)
    section(deck, kind, elform, t, 2)
    part(deck, "strip", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, 1.0, 2.9e7, 0.22]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    across = max(n // 6, 1)

    def mapped(u: np.ndarray) -> np.ndarray:
        turn = 0.5 * np.pi * u[:, 0]
        y, z = w * (u[:, 1] - 0.5), t * (u[:, 2] - 0.5) if u.shape[1] == 3 else np.zeros(len(u))
        return np.column_stack([L * u[:, 0], y * np.cos(turn) - z * np.sin(turn), y * np.sin(turn) + z * np.cos(turn)])

    mesh = grid([n, across] if kind == "SHELL" else [n, across, 2], mapped)
    ids = deck.mesh(kind, 1, mesh, [mesh.nearest(*([1, 0.5] if kind == "SHELL" else [1, 0.5, 0.5]))])
    deck.hold(ids[mesh.where(0, 0)], "xyzXYZ" if kind == "SHELL" else "xyz")
    deck.settle(10.0)
    edge = of_an_edge(across)
    deck.load(ids[mesh.where(0, 1)], direction, 1.0, edge if kind == "SHELL" else np.outer(of_an_edge(2), edge).ravel())
    return deck.history([1], deck.end / 200)


def plate(n: int = 16, elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2, a: float = 1.0, h: float = 0.01, E: float = 2.1e11, rho: float = 7850.0,
          nu: float = 0.3) -> DeckBuilder:
    """A square plate, simply supported, that begins to swing in its first mode."""
    deck = DeckBuilder("plate", 0.06)
    section(deck, "SHELL", elform, h, 3)
    part(deck, "plate", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, E, nu]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    mesh = grid([n, n], [a, a])
    ids = deck.mesh("SHELL", 1, mesh, [mesh.nearest(0.5, 0.5)])
    rim = np.unique(np.concatenate([mesh.where(k, end) for k in (0, 1) for end in (0, 1)]))
    deck.hold(ids[rim], "xyz")
    speed = 0.01 * np.prod(np.sin(np.pi * mesh.unit), axis=1)
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.0, 0.0, float(v)] for i, v in zip(ids, speed) if v > 1e-9))
    return deck.history([1], 1e-4)


def taylor(n: int = 8, elform: int = 1, ihq: int = 0, qm: float = 0.1) -> DeckBuilder:
    """A copper rod of 3.2 mm radius and 32.4 mm length that strikes a rigid wall with 227 m/s; n elements over its diameter."""
    R, L = 3.2e-3, 32.4e-3
    deck = DeckBuilder("Taylor bar", 8e-5)
    section(deck, "SOLID", elform, 0, 0)
    part(deck, "rod", ihq, qm)
    deck.card("*MAT_PLASTIC_KINEMATIC", [1, 8930.0, 117e9, 0.35, 400e6, 100e6, 1.0])

    def mapped(u: np.ndarray) -> np.ndarray:
        x, y = 2 * u[:, 0] - 1, 2 * u[:, 1] - 1  # a square to a disc
        return np.column_stack([R * x * np.sqrt(1 - y**2 / 2), R * y * np.sqrt(1 - x**2 / 2), L * u[:, 2]])

    mesh = grid([n, n, int(round(4.5 * n))], mapped)
    ids = deck.mesh("SOLID", 1, mesh, [mesh.nearest(0.5, 0.5, 1), mesh.nearest(1, 0.5, 0)])
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.0, 0.0, -227.0] for i in ids))
    deck.card("*RIGIDWALL_PLANAR", [0], [0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    return deck.history([1, 2], 1e-6)


def tube(n: int = 8, elform: int = 1, ihq: int = 0, qm: float = 0.1, nu: float = 0.3, a: float = 1.0, b: float = 2.0, E: float = 2.1e11,
         p: float = 1e7, SIGY: float = 0.0) -> DeckBuilder:
    """A quarter of a thick tube under pressure from inside, strained in the plane; n elements over the wall. It yields at SIGY, where given."""
    deck, rho = DeckBuilder("thick tube", 1), 7850.0
    section(deck, "SOLID", elform, 0, 0)
    part(deck, "tube", ihq, qm)
    deck.card(*(("*MAT_PLASTIC_KINEMATIC", [1, rho, E, nu, SIGY, 0.0, 1.0]) if SIGY else ("*MAT_ELASTIC", [1, rho, E, nu])))

    def mapped(u: np.ndarray) -> np.ndarray:
        r, turn = a + (b - a) * u[:, 0], 0.5 * np.pi * u[:, 1]
        return np.column_stack([r * np.cos(turn), r * np.sin(turn), 0.1 * u[:, 2]])

    mesh = grid([n, 2 * n, 1], mapped)
    ids = deck.mesh("SOLID", 1, mesh, [mesh.nearest(0, 0, 0)])
    deck.hold(ids, "z").hold(ids[mesh.where(1, 0)], "y").hold(ids[mesh.where(1, 1)], "x")
    deck.settle(float(np.sqrt(E / rho) / b))
    inner = [ids[cell[[0, 4, 7, 3]]] for cell in mesh.cells if mesh.unit[cell[0], 0] < 1e-9]
    deck.card("*SET_SEGMENT", [1], *([int(k) for k in corners] for corners in inner))
    deck.card("*LOAD_SEGMENT_SET", [1, 90, p])
    return deck.history([1], deck.end / 200)


def pinched(n: int = 8, elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2) -> DeckBuilder:
    """An eighth of a cylinder on diaphragms that two opposite unit forces pinch in its middle."""
    R, L, h, rho = 300.0, 600.0, 3.0, 1.0
    deck = DeckBuilder("pinched cylinder", 1)
    section(deck, "SHELL", elform, h, 2)
    part(deck, "cylinder", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, 3e6, 0.3]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    mesh = grid([n, n], lambda u: np.column_stack([R * np.sin(0.5 * np.pi * u[:, 0]), 0.5 * L * u[:, 1], R * np.cos(0.5 * np.pi * u[:, 0])]))
    ids = deck.mesh("SHELL", 1, mesh, [mesh.nearest(0, 1)])
    deck.hold(ids[mesh.where(1, 0)], "xz").hold(ids[mesh.where(1, 1)], "yXZ").hold(ids[mesh.where(0, 0)], "xYZ").hold(ids[mesh.where(0, 1)], "zXY")
    deck.settle(0.68)
    deck.load(ids[[mesh.nearest(0, 1)]], 3, -0.25)
    return deck.history([1], deck.end / 200)


def elastica(n: int = 8, kind: str = "SHELL", elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2, L: float = 1.0, h: float = 0.02, E: float = 2e9,
             rho: float = 1000.0, load: float = 10.0) -> DeckBuilder:
    """A thin cantilever that a force at its end bends by more than its length; P L^2/(E I) = `load`."""
    deck = DeckBuilder("elastica", 1)
    part(deck, "strip", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, E, 0.0]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    mesh, ids, weights = rod(deck, kind, elform, n, L, h)
    deck.hold(ids[mesh.where(0, 0)], "xyz" if kind == "SOLID" else "xyzXYZ")
    deck.settle(3.516 * np.sqrt(E * h**2 / 12 / rho) / L**2)
    deck.load(ids[mesh.where(0, 1)], 3, load * E * h**4 / 12 / L**2, weights)
    return deck.history([1], deck.end / 200)


def membrane(n: int = 8, elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2, a: float = 1.0, h: float = 0.01, E: float = 2.1e11, rho: float = 7850.0,
             nu: float = 0.3, q: float = 5e4) -> DeckBuilder:
    """A quarter of a clamped disc that a pressure bends by more than its thickness, so that it is stretched, too."""
    deck = DeckBuilder("disc under pressure", 1)
    section(deck, "SHELL", elform, h, 2)
    part(deck, "disc", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, E, nu]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])

    def mapped(u: np.ndarray) -> np.ndarray:
        x, y = u[:, 0], u[:, 1]
        return a * np.column_stack([x * np.sqrt(1 - y**2 / 2), y * np.sqrt(1 - x**2 / 2), 0 * x])

    mesh = grid([n, n], mapped)
    ids = deck.mesh("SHELL", 1, mesh, [mesh.nearest(0, 0)])
    deck.hold(ids[mesh.where(0, 0)], "xYZ").hold(ids[mesh.where(1, 0)], "yXZ").hold(ids[np.union1d(mesh.where(0, 1), mesh.where(1, 1))], "xyzXYZ")
    deck.settle(10.21 * np.sqrt(E * h**2 / 12 / (1 - nu**2) / rho) / a**2)
    deck.card("*SET_SHELL_LIST", [1], *([*range(k, min(k + 8, n * n + 1))] for k in range(1, n * n + 1, 8))).card("*LOAD_SHELL_SET", [1, 90, -q])
    return deck.history([1], deck.end / 200)


def column(n: int = 8, kind: str = "BEAM", elform: int = 1, ihq: int = 0, qm: float = 0.1, bwc: int = 2, L: float = 1.0, h: float = 0.02, E: float = 2.1e11,
           rho: float = 7850.0, part_of_euler: float = 0.75) -> DeckBuilder:
    """A column on hinges that swings under a share of Euler's load, which makes it slower."""
    omega = np.pi**2 * np.sqrt(E * h**2 / 12 / rho) / L**2
    deck = DeckBuilder("column", 2.4 * 2 * np.pi / omega / np.sqrt(1 - part_of_euler))
    part(deck, "column", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, E, 0.0]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    mesh, ids, _ = rod(deck, kind, elform, n, L, h, at=0.5)
    if kind == "BEAM":
        deck.hold(ids, "yXZ")
    deck.hold(ids[mesh.where(0, 0)], "xyz").hold(ids[mesh.where(0, 1)], "yz")
    deck.curve(90, [(0.0, 1.0), (1e6, 1.0)])
    deck.load(ids[mesh.where(0, 1)], 1, -part_of_euler * np.pi**2 * E * h**4 / 12 / L**2)
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.0, 0.0, float(1e-3 * L * omega * np.sin(np.pi * u))] for i, u in zip(ids, mesh.unit[:, 0])))
    return deck.history([1], deck.end / 400)


def torsion(n: int = 16, elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2, R: float = 0.1, L: float = 0.4, h: float = 0.002, E: float = 2.1e11,
            rho: float = 7850.0, nu: float = 0.3, M: float = 1e3) -> DeckBuilder:
    """A thin round tube, clamped at one end and twisted by a moment M at the other; n shells around."""
    deck = DeckBuilder("tube in torsion", 1)
    section(deck, "SHELL", elform, h, 2)
    part(deck, "tube", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, E, nu]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    mesh = join(grid([n, int(round(n * L / (2 * np.pi * R)))],
                     lambda u: np.column_stack([R * np.cos(2 * np.pi * u[:, 0]), R * np.sin(2 * np.pi * u[:, 0]), L * u[:, 1]])))
    ids = deck.mesh("SHELL", 1, mesh, [int(np.argmin(np.linalg.norm(mesh.points - [R, 0, L], axis=1)))])
    deck.hold(ids[mesh.where(1, 0)], "xyzXYZ")
    deck.settle(float(0.5 * np.pi * np.sqrt(E / (2 + 2 * nu) / rho) / L))
    end = mesh.where(1, 1)
    for axis, across in ((1, -mesh.points[end, 1]), (2, mesh.points[end, 0])):
        rows = [[int(i), axis, 90, float(M / R / n * c / R)] for i, c in zip(ids[end], across) if abs(c) > 1e-9]
        deck.card("*LOAD_NODE_POINT", *rows)
    return deck.history([1], deck.end / 200)


def spin(n: int = 8, elform: int = 1, ihq: int = 0, qm: float = 0.1, R: float = 0.1, h: float = 0.01, E: float = 2.1e11, rho: float = 7850.0, nu: float = 0.3,
         omega: float = 3000.0) -> DeckBuilder:
    """A free disc that spins and swings about the radius to which its own weight draws it."""
    c = np.sqrt(E / rho / (1 - nu**2))
    deck = DeckBuilder("spinning disc", 40 * R / c)
    section(deck, "SOLID", elform, 0, 0)
    part(deck, "disc", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, E, nu])

    def mapped(u: np.ndarray) -> np.ndarray:
        x, y = 2 * u[:, 0] - 1, 2 * u[:, 1] - 1
        return np.column_stack([R * x * np.sqrt(1 - y**2 / 2), R * y * np.sqrt(1 - x**2 / 2), h * (u[:, 2] - 0.5)])

    mesh = grid([n, n, 1], mapped)
    ids = deck.mesh("SOLID", 1, mesh, [mesh.nearest(1, 0.5, 0)])
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), float(-omega * y), float(omega * x), 0.0] for i, (x, y, _) in zip(ids, mesh.points)))
    return deck.history([1], deck.end / 400)


def rubber(n: int = 4, elform: int = 1, ihq: int = 0, qm: float = 0.1, a: float = 1.0, b: float = 1.5, mu: float = 1e6, nu: float = 0.499, stretch: float = 1.3,
           rho: float = 1000.0) -> DeckBuilder:
    """A hollow sphere of rubber (neo-Hooke) under the pressure that stretches its inside by `stretch`, if it is incompressible; six caps of n x n x n/2 solids."""
    deck = DeckBuilder("sphere of rubber", 1)
    section(deck, "SOLID", elform, 0, 0)
    part(deck, "sphere", ihq, qm)
    deck.card("*MAT_MOONEY-RIVLIN_RUBBER", [1, rho, nu, mu / 2, 0.0])
    out = np.cbrt(1 + (a / b) ** 3 * (stretch**3 - 1))
    p = mu * ((2 / out + 1 / (2 * out**4)) - (2 / stretch + 1 / (2 * stretch**4)))

    def cap(axis: int, side: int):
        def mapped(u: np.ndarray) -> np.ndarray:
            v = np.empty((len(u), 3))
            v[:, axis], v[:, (axis + 1) % 3], v[:, (axis + 2) % 3] = side, (2 * u[:, 0] - 1) * side, 2 * u[:, 1] - 1
            v = np.tan(0.25 * np.pi * v)
            return v / np.linalg.norm(v, axis=1, keepdims=True) * (a + (b - a) * u[:, 2:])
        return grid([n, n, max(n // 2, 1)], mapped)

    mesh = join(*(cap(axis, side) for axis in range(3) for side in (-1, 1)))
    ids = deck.mesh("SOLID", 1, mesh, [int(np.argmin(np.linalg.norm(mesh.points - [a, 0, 0], axis=1)))])
    for axis in range(3):  # nodes on the axes keep to them; n is even
        others = np.linalg.norm(np.delete(mesh.points, axis, axis=1), axis=1)
        deck.hold(ids[others < 1e-9], "xyz".replace("xyz"[axis], ""))
    deck.settle(float(np.sqrt(mu / rho) / b))
    inside = np.linalg.norm(mesh.points, axis=1) < a + 1e-9
    faces = [cell[[0, 3, 2, 1]] for cell in mesh.cells if inside[cell].sum() == 4]
    deck.card("*SET_SEGMENT", [1], *([int(ids[k]) for k in face] for face in faces)).card("*LOAD_SEGMENT_SET", [1, 90, float(p)])
    return deck.history([1], deck.end / 200)


def wave(n: int = 50, elform: int = 1, ihq: int = 0, qm: float = 0.1, q1: float = 1.5, q2: float = 0.06, L: float = 1.0, h: float = 0.02, E: float = 2.1e11,
         rho: float = 7850.0, SIGY: float = 4e8, ETAN: float = 2.1e10, v0: float = 30.0, T: float = 1.5e-4) -> DeckBuilder:
    """A thin bar of width h (0: of cubes) strikes a rigid wall; an elastic wave runs ahead of a plastic one."""
    deck = DeckBuilder("plastic wave", T)
    section(deck, "SOLID", elform, 0, 0)
    part(deck, "bar", ihq, qm)
    deck.card("*MAT_PLASTIC_KINEMATIC", [1, rho, E, 0.0, SIGY, ETAN, 1.0]).card("*CONTROL_BULK_VISCOSITY", [q1, q2, 1])
    mesh = grid([n, 1, 1], [L, h or L / n, h or L / n])
    ids = deck.mesh("SOLID", 1, mesh, [mesh.nearest(1, 0, 0)])
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), -v0, 0.0, 0.0] for i in ids)).card("*RIGIDWALL_PLANAR", [0], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0])
    deck.card("*DATABASE_MATSUM", [T / 300])
    return deck.history([1], T / 300)


def vibration(n: int = 8, kind: str = "SHELL", elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2, tssfac: float = 0.9, short: float = 1.0, scaled: int = 0,
              L: float = 1.0, h: float = 0.04, E: float = 2.1e11, rho: float = 7850.0) -> DeckBuilder:
    """A cantilever that begins to swing in its first mode. Its first element is `short` times as long as the others, whose step mass scaling keeps where `scaled`."""
    c = np.sqrt(E / rho)
    omega = 3.516 * c * h / np.sqrt(12) / L**2
    deck = DeckBuilder("swinging cantilever", 2.4 * 2 * np.pi / omega)
    part(deck, "strip", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, E, 0.0]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    deck.card("*CONTROL_TIMESTEP", [0, tssfac, 0, 0.0, -0.9 * min(L / (n - 1 + short), h) / c if scaled else 0.0])
    mesh, ids, _ = rod(deck, kind, elform, n, L, h, to=lambda u: np.maximum(0.0, (u * n - 1 + short) / (n - 1 + short)) * (u > 1e-9))
    deck.hold(ids[mesh.where(0, 0)], "xyz" if kind == "SOLID" else "xyzXYZ")
    k, ratio = 1.8751041, 0.7340955
    x = mesh.points[:, 0] / L
    shape = np.cosh(k * x) - np.cos(k * x) - ratio * (np.sinh(k * x) - np.sin(k * x))
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.0, 0.0, float(5e-4 * omega * L * s)] for i, s in zip(ids, shape) if s > 1e-9))
    return deck.history([1], deck.end / 400)


def struck(n: int = 20, kind: str = "SOLID", elform: int = 1, ihq: int = 0, qm: float = 0.1, q1: float = 1.5, q2: float = 0.06, tssfac: float = 0.9, L: float = 1.0,
           h: float = 0.05, E: float = 2.1e11, rho: float = 7850.0, v0: float = 1.0, heavy: float = 1.0) -> DeckBuilder:
    """A mass, `heavy` times that of a rod, strikes its end; the other one is held."""
    deck = DeckBuilder("struck rod", 1.95 * L / np.sqrt(E / rho))
    part(deck, "rod", ihq, qm)
    deck.card("*MAT_ELASTIC", [1, rho, E, 0.0]).card("*CONTROL_BULK_VISCOSITY", [q1, q2, 1]).card("*CONTROL_TIMESTEP", [0, tssfac])
    mesh, ids, weights = rod(deck, kind, elform, n, L, h, deep=1, finer=1)
    deck.hold(ids[mesh.where(0, 0)], "xyz" if kind == "SOLID" else "xyzXYZ")
    end = ids[mesh.where(0, 1)]
    deck.card("*ELEMENT_MASS", *([100000 + k, int(i), heavy * rho * h * h * L / len(end)] for k, i in enumerate(end)))
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), -v0, 0.0, 0.0] for i in end))
    return deck.history([1], deck.end / 400)


def yielding(n: int = 16, kind: str = "SHELL", elform: int = 2, ihq: int = 0, qm: float = 0.1, bwc: int = 2, nip: int = 5, qr: int = 5, deep: int = 4, finer: int = 2,
             L: float = 1.0, h: float = 0.05, E: float = 2.1e11, rho: float = 7850.0, SIGY: float = 2.1e8, load: float = 1.3) -> DeckBuilder:
    """A cantilever without hardening under a force at its end, `load` times that at which it begins to yield; it would collapse at 1.5."""
    deck = DeckBuilder("yielding cantilever", 1)
    part(deck, "strip", ihq, qm)
    deck.card("*MAT_PLASTIC_KINEMATIC", [1, rho, E, 0.0, SIGY, 0.0, 1.0]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    mesh, ids, weights = rod(deck, kind, elform, n, L, h, nip=nip, qr=qr, deep=deep, finer=finer)
    deck.hold(ids[mesh.where(0, 0)], "xyz" if kind == "SOLID" else "xyzXYZ")
    deck.settle(3.516 * np.sqrt(E * h**2 / 12 / rho) / L**2)
    deck.load(ids[mesh.where(0, 1)], 3, load * SIGY * h**3 / 6 / L, weights)
    return deck.history([1], deck.end / 200)


def laminate(n: int = 8, elform: int = 2, layers: int = 1, bwc: int = 1, L: float = 1.0, h: float = 0.02, E: float = 7e10, core: float = 0.1, rho: float = 2700.0,
             w: float = 0.1, P: float = 500.0) -> DeckBuilder:
    """A strip of three layers, the middle half of its height `core` times as stiff, bent by a force at its end; each layer in `layers` pieces, of one point each."""
    deck = DeckBuilder("laminate", 1)
    deck.card("*PART_COMPOSITE", "strip", [1, elform, 5 / 6], *([2 if k in (1, 2) else 1, h / 4 / layers, 0.0, None] for k in range(4) for _ in range(layers)))
    deck.card("*MAT_ELASTIC", [1, rho, E, 0.0]).card("*MAT_ELASTIC", [2, rho, core * E, 0.0]).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, bwc])
    mesh = grid([n, 1], lambda u: np.column_stack([L * u[:, 0], w * (u[:, 1] - 0.5), 0 * u[:, 0]]))
    ids = deck.mesh("SHELL", 1, mesh, [mesh.nearest(1, 0)])
    deck.hold(ids[mesh.where(0, 0)], "xyzXYZ")
    deck.settle(3.516 * np.sqrt(E * (7 + core) / 8 * h**2 / 12 / rho) / L**2)
    deck.load(ids[mesh.where(0, 1)], 3, P)
    return deck.history([1], deck.end / 200)


def shock(n: int = 50, elform: int = 1, q1: float = 1.5, q2: float = 0.06, tssfac: float = 0.9, L: float = 0.1, rho: float = 8930.0, C: float = 3940.0,
          S1: float = 1.489, GAMMA0: float = 2.0, v0: float = 500.0) -> DeckBuilder:
    """A column of metal without strength, which cannot widen, runs against a rigid wall."""
    deck = DeckBuilder("shock", 0.7 * L / (C + S1 * v0))
    deck.card("*SECTION_SOLID", [1, elform]).card("*PART", "column", [1, 1, 1, 1]).card("*MAT_NULL", [1, rho, -1e20])
    deck.card("*EOS_GRUNEISEN", [1, C, S1, 0.0, 0.0, GAMMA0], [1.0]).card("*CONTROL_BULK_VISCOSITY", [q1, q2, 1]).card("*CONTROL_TIMESTEP", [0, tssfac])
    mesh = grid([n, 1, 1], [L, L / n, L / n])
    ids = deck.mesh("SOLID", 1, mesh, [mesh.nearest(0.3, 0, 0)])
    deck.hold(ids, "yz").hold(ids[mesh.where(0, 0)], "x")
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), -v0, 0.0, 0.0] for i, x in zip(ids, mesh.unit[:, 0]) if x > 1e-9))
    deck.card("*DATABASE_MATSUM", [deck.end / 400])
    return deck.history([1], deck.end / 400)
