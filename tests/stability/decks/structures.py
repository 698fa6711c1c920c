"""Decks of structures.yaml: small meshes that swing, spin, strike and rest, by any element, at the edge of what they bear."""
from __future__ import annotations

import numpy as np
from courant import DeckBuilder, grid

RHO, E = 1000.0, 1e7  # c 100 m/s


def _mesh(deck: DeckBuilder, element: str, size: float, skew: float, offset: float, pieces: int) -> tuple[np.ndarray, np.ndarray]:
    """Part 1 of `element`, "SOLID 1", "SHELL 16", "BEAM 1": numbers of its nodes and their positions."""
    kind, elform = element.split()
    dimensions = {"SOLID": 3, "SHELL": 2, "BEAM": 1}[kind]

    def mapped(u: np.ndarray) -> np.ndarray:
        x = np.zeros((len(u), 3))
        x[:, : u.shape[1]] = u
        inner = np.all(np.abs(u - 0.5) < 1e-9, axis=1)  # the node in the middle
        x[inner, : u.shape[1]] += 0.24 * skew * np.array([1.0, -0.7, 0.4])[: u.shape[1]]
        return size * x + offset

    of = grid([pieces] * dimensions if kind != "BEAM" else [4 * pieces], mapped)
    if kind == "SOLID":
        deck.card("*SECTION_SOLID", [1, int(elform)])
    elif kind == "SHELL":
        deck.card("*SECTION_SHELL", [1, int(elform), 5 / 6, 3], [0.05 * size] * 4)
    else:
        side = 0.05 * size
        deck.card("*SECTION_BEAM", [1, int(elform), 5 / 6, 2, 0],
                  [side] * 4 if elform == "1" else [side**2, side**4 / 12, side**4 / 12, 0.14 * side**4, 5 / 6 * side**2])
    ids = deck.nodes(of.points, [of.nearest(*[1.0] * dimensions)])
    corners = ids[of.cells]
    if kind == "BEAM":
        corners = np.column_stack([corners, np.full(len(corners), deck.nodes(np.array([[0, 0, 10 * size]]) + offset)[0])])
    deck.elements(kind, 1, corners)
    return ids, of.points


def swing(element: str = "SOLID 1", tssfac: float = 0.9, nu: float = 0.3, skew: float = 0.0, size: float = 1.0, offset: float = 0.0, mach: float = 0.01,
          spin: float = 0.0, steps: int = 5000, ihq: int = 0, qm: float = 0.1) -> DeckBuilder:
    """A free mesh, four elements along each side, that is stretched and bent with `mach` times the speed of sound, and turns by `spin` [1/T]."""
    c, pieces = np.sqrt(E / RHO), 4
    deck = DeckBuilder("swing", steps * size / pieces / c * 0.5)
    deck.card("*MAT_ELASTIC", [1, RHO, E, nu]).card("*PART", "mesh", [1, 1, 1, 0, 1 if ihq else 0]).card("*CONTROL_TIMESTEP", [0, tssfac])
    if ihq:
        deck.card("*HOURGLASS", [1, ihq, qm])
    ids, x = _mesh(deck, element, size, skew, offset, pieces)
    u = (x - x.min(axis=0)) / size
    v = mach * c * np.cos(np.pi * u) * (np.ptp(x, axis=0) > 0)
    if not element.startswith("SOLID"):
        v[:, 2] = 0.1 * mach * c * np.cos(2 * np.pi * u[:, 0])
    v += spin * np.cross([0.0, 0.0, 1.0], x - x.mean(axis=0))
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), *map(float, u)] for i, u in zip(ids, v)))
    deck.card("*CONTROL_ENERGY", [2, 2, 2, 2])
    return deck.history([1], deck.end / 200)


def strike(kind: str = "AUTOMATIC_SURFACE_TO_SURFACE", soft: int = 0, stiffness: float = 1.0, density: float = 1.0, mach: float = 0.01, scale: float = 1.0,
           mu: float = 0.0, tssfac: float = 0.9) -> DeckBuilder:
    """A block strikes a larger one, `stiffness` times as stiff and `density` times as dense, that rests and is free. All below the speed of sound of either."""
    c = np.sqrt(E / RHO)
    v = mach * min(c, c * np.sqrt(stiffness / density))
    deck = DeckBuilder("strike", 0.05 / v + 20 * 0.2 / c)
    deck.card("*SECTION_SOLID", [1, 1]).card("*CONTROL_TIMESTEP", [0, tssfac])
    deck.card("*MAT_ELASTIC", [1, RHO, E, 0.3]).card("*MAT_ELASTIC", [2, RHO * density, E * stiffness, 0.3])
    deck.card("*PART", "striker", [1, 1, 1]).card("*PART", "struck", [2, 1, 2]).card("*CONTROL_ENERGY", [2, 2, 2, 2])
    first = deck.mesh("SOLID", 1, grid([2, 2, 2], lambda u: 0.1 * u + [0.05, 0.05, 0.2 + 1e-3]))
    deck.mesh("SOLID", 2, grid([3, 3, 3], lambda u: 0.2 * u))
    deck.card(f"*CONTACT_{kind}", [1, 2, 3, 3], [mu, mu], [scale, scale], [soft])
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.3 * v, 0.1 * v, -v] for i in first))
    return deck.history([1], deck.end / 400)
