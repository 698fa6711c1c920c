"""Decks of structures.yaml: small meshes that swing, spin, strike and rest, by any element, at the edge of what they bear."""
from __future__ import annotations

import numpy as np
from courant import DeckBuilder, grid

RHO, E = 1000.0, 1e7  # c 100 m/s


def _mesh(deck: DeckBuilder, element: str, size: float, skew: float, offset: float, pieces: int, thick: float, aspect: float) -> tuple[np.ndarray, np.ndarray]:
    """Part 1 of `element`, "SOLID 1", "SHELL 16", "BEAM 1": numbers of its nodes and their positions."""
    kind, elform = element.split()
    dimensions = {"SOLID": 3, "SHELL": 2, "BEAM": 1}[kind]

    def mapped(u: np.ndarray) -> np.ndarray:
        x = np.zeros((len(u), 3))
        x[:, : u.shape[1]] = u
        x[:, 0] *= aspect
        inner = np.all(np.abs(u - 0.5) < 1e-9, axis=1)  # the node in the middle
        x[inner, : u.shape[1]] += 0.24 * skew * np.array([1.0, -0.7, 0.4])[: u.shape[1]]
        return size * x + offset

    of = grid([pieces] * dimensions if kind != "BEAM" else [4 * pieces], mapped)
    if kind == "SOLID":
        deck.card("*SECTION_SOLID", [1, int(elform)])
    elif kind == "SHELL":
        deck.card("*SECTION_SHELL", [1, int(elform), 5 / 6, 3], [thick * size] * 4)
    else:
        side = thick * size
        deck.card("*SECTION_BEAM", [1, int(elform), 5 / 6, 2, 0],
                  [side] * 4 if elform == "1" else [side**2, side**4 / 12, side**4 / 12, 0.14 * side**4, 5 / 6 * side**2])
    ids = deck.nodes(of.points, [of.nearest(*[1.0] * dimensions)])
    corners = ids[of.cells]
    if kind == "BEAM":
        corners = np.column_stack([corners, np.full(len(corners), deck.nodes(np.array([[0, 0, 10 * size]]) + offset)[0])])
    deck.elements(kind, 1, corners)
    return ids, of.points


def swing(element: str = "SOLID 1", tssfac: float = 0.9, nu: float = 0.3, skew: float = 0.0, size: float = 1.0, offset: float = 0.0, mach: float = 0.01,
          spin: float = 0.0, steps: int = 5000, ihq: int = 0, qm: float = 0.1, thick: float = 0.05, aspect: float = 1.0, pieces: int = 4, damping: float = 0.0,
          scaled: float = 0.0) -> DeckBuilder:
    """A free mesh, `pieces` elements along each side, that is stretched and bent with `mach` times the speed of sound, and turns by `spin` [1/T]. Sides along x are `aspect`
    times as long. `damping` [c/size] of all; mass scaling to a step of `scaled` [size/pieces/c]."""
    c = np.sqrt(E / RHO)
    deck = DeckBuilder("swing", steps * size / pieces / c * 0.5)
    if damping:
        deck.card("*DAMPING_GLOBAL", [0, damping * c / size])
    deck.card("*MAT_ELASTIC", [1, RHO, E, nu]).card("*PART", "mesh", [1, 1, 1, 0, 1 if ihq else 0]).card("*CONTROL_TIMESTEP", [0, tssfac, 0, 0.0, -scaled * size / pieces / c])
    if ihq:
        deck.card("*HOURGLASS", [1, ihq, qm])
    ids, x = _mesh(deck, element, size, skew, offset, pieces, thick, aspect)
    u = (x - x.min(axis=0)) / size / [aspect, 1, 1]
    v = mach * c * np.cos(np.pi * u) * (np.ptp(x, axis=0) > 0)
    if not element.startswith("SOLID"):
        v[:, 2] = 0.1 * mach * c * np.cos(2 * np.pi * u[:, 0])
    v += spin * np.cross([0.0, 0.0, 1.0], x - x.mean(axis=0))
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), *map(float, u)] for i, u in zip(ids, v)))
    deck.card("*CONTROL_ENERGY", [2, 2, 2, 2])
    return deck.history([1], deck.end / 200)


def strike(kind: str = "AUTOMATIC_SURFACE_TO_SURFACE", soft: int = 0, stiffness: float = 1.0, density: float = 1.0, mach: float = 0.01, scale: float = 1.0,
           mu: float = 0.0, tssfac: float = 0.9, size: float = 1.0, offset: float = 0.0) -> DeckBuilder:
    """A block of 0.1 `size` strikes a larger one, `stiffness` times as stiff and `density` times as dense, that rests and is free. All below the speed of sound of either."""
    c = np.sqrt(E / RHO)
    v = mach * min(c, c * np.sqrt(stiffness / density))
    deck = DeckBuilder("strike", size * (0.05 / v + 20 * 0.2 / c))
    deck.card("*SECTION_SOLID", [1, 1]).card("*CONTROL_TIMESTEP", [0, tssfac])
    deck.card("*MAT_ELASTIC", [1, RHO, E, 0.3]).card("*MAT_ELASTIC", [2, RHO * density, E * stiffness, 0.3])
    deck.card("*PART", "striker", [1, 1, 1]).card("*PART", "struck", [2, 1, 2]).card("*CONTROL_ENERGY", [2, 2, 2, 2])
    first = deck.mesh("SOLID", 1, grid([2, 2, 2], lambda u: size * (offset + 0.1 * u + [0.05, 0.05, 0.2 + 1e-3])))
    deck.mesh("SOLID", 2, grid([3, 3, 3], lambda u: size * (offset + 0.2 * u)))
    single = kind in ("AUTOMATIC_SINGLE_SURFACE", "AUTOMATIC_GENERAL")
    if single:
        deck.card("*SET_PART_LIST", [1], [1, 2])
    deck.card(f"*CONTACT_{kind}", [1, 0, 2, 0] if single else [1, 2, 3, 3], [mu, mu], [scale, scale], [soft])
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.3 * v, 0.1 * v, -v] for i in first))
    return deck.history([1], deck.end / 400)


def tie(kind: str = "SURFACE_TO_SURFACE", stiffness: float = 1.0, density: float = 1.0, scale: float = 1.0, mach: float = 0.01, steps: int = 2000, fine: int = 4,
        coarse: int = 3) -> DeckBuilder:
    """Two blocks of `fine` and `coarse` elements along each side that are tied, the second `stiffness` times as stiff and `density` times as dense, fly apart, askew, with `mach` times the smaller speed of sound."""
    c, faster = np.sqrt(E / RHO), np.sqrt(max(1.0, stiffness / density))
    deck = DeckBuilder("tied blocks", steps * 0.2 / fine / c / faster * 0.5)
    deck.card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, RHO, E, 0.3]).card("*MAT_ELASTIC", [2, RHO * density, E * stiffness, 0.3])
    deck.card("*PART", "first", [1, 1, 1]).card("*PART", "second", [2, 1, 2]).card("*CONTROL_ENERGY", [2, 2, 2, 2])
    first = deck.mesh("SOLID", 1, grid([fine] * 3, lambda u: 0.2 * (u + [0, 0, 1])))
    deck.mesh("SOLID", 2, grid([coarse] * 3, lambda u: 0.3 * u - [0.05, 0.05, 0.1]))
    v = mach * c * min(1.0, np.sqrt(stiffness / density))
    deck.card(f"*CONTACT_TIED_{kind}", [1, 2, 3, 3], [None], [scale, scale] if kind.endswith("FACE_OFFSET") else [None])
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.3 * v, 0.1 * v, v] for i in first))
    return deck.history([1], deck.end / 400)


def pendulums(joint: str = "REVOLUTE", mass: float = 1.0, slender: float = 1.0, tssfac: float = 0.9, L: float = 1.0, g: float = 9.81, turns: float = 1.0, offset: float = 0.0) -> DeckBuilder:
    """Two pendulums on each other, the lower one `mass` times as heavy; a moment of inertia of L^2/100 times `slender` of their masses; they begin level, `offset` lengths away
    from the origin."""
    deck = DeckBuilder("two pendulums", turns * 2 * np.pi * np.sqrt(L / g))
    deck.card("*SECTION_SOLID", [1, 1]).card("*CONTROL_TIMESTEP", [0, tssfac])
    cube = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]) - 0.5
    for part, (x, m) in enumerate(((0.0, 1.0), (0.5 * L, 1.0), (1.5 * L, mass)), 1):
        deck.elements("SOLID", part, deck.nodes(0.02 * L * cube + [x, 0, 0] + offset * L)[None, :])
        J = 0.01 * slender * m * L**2
        deck.card("*PART_INERTIA", "body", [part, 1, part], [x + offset * L, offset * L, offset * L, m], [J, 0.0, 0.0, J, 0.0, J], [0.0] * 6)
        deck.card("*MAT_RIGID", [part, 1000.0, 1e9, 0.3], [1, 7, 7] if part == 1 else [0], "")
    for a, b, x in ((1, 2, 0.0), (2, 3, L)):
        points = [np.array([x, 0, 0])] + ([np.array([x, 0.1 * L, 0])] if joint == "REVOLUTE" else [])
        ids = []
        for at in points:
            ids += [int(k) for k in deck.nodes(np.array([at, at]) + offset * L)]
            deck.card("*CONSTRAINED_EXTRA_NODES_NODE", [a, ids[-2]], [b, ids[-1]])
        deck.card(f"*CONSTRAINED_JOINT_{joint}", ids)
    deck.gravity(g)
    deck.card("*DATABASE_RBDOUT", [deck.end / 400]).card("*DATABASE_GLSTAT", [deck.end / 400])
    return deck


def splash(density: float = 1.0, thickness: float = 0.5, stiffness: float = 1.0, soft: int = 0, scale: float = 10.0, mach: float = 0.05, tssfac: float = 0.9,
           scheme: str = "cubic", dx: float = 0.01, c0: float = 50.0) -> DeckBuilder:
    """A block of water, 8 x 8 particles, falls on a strip of shells that is clamped at both ends, in the plane. The shells are `density` times as dense as water,
    `thickness` particles thick and E is `stiffness` times the bulk modulus of the water."""
    deck = DeckBuilder("splash", 30 * 8 * dx / c0)
    rho, h = 1000.0, thickness * dx
    deck.card("*CONTROL_TIMESTEP", [0, tssfac]).card("*CONTROL_SPH", [1, 0, 1e20, 2]).card("*SECTION_SPH", [1, 1.2 if scheme == "cubic" else 2.0, 1.0, 1.0])
    if scheme != "cubic":
        deck.card("*COURANT_KERNEL", "wendland_c4")
    deck.card("*PART", "water", [1, 1, 1, 1, 1]).card("*MAT_NULL", [1, rho]).card("*EOS_LINEAR_POLYNOMIAL", [1, 0.0, rho * c0**2])
    deck.card("*HOURGLASS", [1, 0, 0.0, 0, 1e-20, 0.1]).card("*COURANT_DENSITY_DIFFUSION", [0.1])
    deck.card("*PART", "strip", [2, 2, 2]).card("*SECTION_SHELL", [2, 2, 5 / 6, 3], [h] * 4).card("*MAT_ELASTIC", [2, rho * density, stiffness * rho * c0**2, 0.3])
    mesh = grid([16, 1], lambda u: np.column_stack([16 * dx * u[:, 0], 0 * u[:, 0], u[:, 1] - 0.5]))
    ids = deck.mesh("SHELL", 2, mesh, [mesh.nearest(0.5, 0)])
    deck.hold(ids[np.union1d(mesh.where(0, 0), mesh.where(0, 1))], "xyzXYZ")
    water = np.array([[(4.5 + i) * dx, 0.5 * h + (0.6 + j) * dx, 0.0] for j in range(8) for i in range(8)])
    falling = deck.particles(1, water, rho * dx**2)
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.0, -mach * c0, 0.0] for i in falling))
    deck.card("*CONTACT_AUTOMATIC_NODES_TO_SURFACE", [1, 2, 3, 3], [0.0], [scale, 1000.0, 0.9999 * dx], [soft])
    return deck.history([1], deck.end / 400)


def wheel(joint: str = "REVOLUTE", spin: float = 100.0, tssfac: float = 0.9, slender: float = 1.0, turns: float = 1.0, g: float = 9.81) -> DeckBuilder:
    """A wheel with a level axis that spins on a revolute joint of an arm, which hangs level on a spherical one and precesses; the time is that of `turns` small
    swings of the arm or of 20 turns of the wheel, the longer one."""
    L, m = 1.0, 1.0
    deck = DeckBuilder("wheel on an arm", max(turns * 2 * np.pi * np.sqrt(L / g), 20 * 2 * np.pi / spin))
    deck.card("*SECTION_SOLID", [1, 1]).card("*CONTROL_TIMESTEP", [0, tssfac])
    cube = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]) - 0.5
    for part, (x, omega) in enumerate(((0.0, 0.0), (0.5 * L, 0.0), (L, spin)), 1):
        deck.elements("SOLID", part, deck.nodes(0.02 * cube + [x, 0, 0])[None, :])
        J = 0.02 * slender * m * L**2
        deck.card("*PART_INERTIA", "body", [part, 1, part], [x, 0.0, 0.0, m], [J, 0.0, 0.0, 0.6 * J, 0.0, 0.6 * J], [0.0, 0.0, 0.0, float(omega), 0.0, 0.0])
        deck.card("*MAT_RIGID", [part, 1000.0, 1e9, 0.3], [1, 7, 7] if part == 1 else [0], "")
    for a, b, kind, points in ((1, 2, "SPHERICAL", [np.zeros(3)]), (2, 3, joint, [np.array([L, 0, 0]), np.array([1.1 * L, 0, 0])][: 1 if joint == "SPHERICAL" else 2])):
        ids = []
        for at in points:
            ids += [int(k) for k in deck.nodes(np.array([at, at]))]
            deck.card("*CONSTRAINED_EXTRA_NODES_NODE", [a, ids[-2]], [b, ids[-1]])
        deck.card(f"*CONSTRAINED_JOINT_{kind}", ids)
    deck.gravity(g)
    deck.card("*DATABASE_RBDOUT", [deck.end / 400]).card("*DATABASE_GLSTAT", [deck.end / 400])
    return deck
