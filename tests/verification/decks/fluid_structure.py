"""Decks of fluid_structure.yaml: water that rests on, runs through and strikes plates, rings, tubes and gates."""
from __future__ import annotations

import numpy as np
from courant import DeckBuilder, grid, join

# h over the spacing, SPHKERN and *COURANT_KERNEL of the kernels that an engineer chooses between
SCHEMES: dict[str, tuple[float, int, str]] = {"cubic": (1.2, 0, ""), "quintic": (1.4, 1, ""), "C2": (1.8, 0, "wendland_c2"), "C4": (2.0, 0, "wendland_c4")}
METHODS = {"images": 1, "ghosts": 2}  # of COURANT_WALL_SUPPORT beside rigid walls; "contact": none


class Flow(DeckBuilder):
    """Part 1 is water of spacing `dx`; part 2 rigid walls that are held; part 3 deforms. In a plane, x along and y up, one deep in z; or in space."""

    def __init__(self, title: str, end: float, dx: float, c0: float, scheme: str, tssfac: float, q1: float, rho: float = 1000.0, mu: float = 0.0, diffusion: float = 0.1,
                 dim: int = 2, sfsa: float = 10.0, soft: int = 0, samples: int = 400, states: int = 0) -> None:
        super().__init__(title, end)
        self.dx, self.rho, self.dim, self.sfsa, self.soft = dx, rho, dim, sfsa, soft
        cslh, sphkern, kernel = SCHEMES[scheme]
        self.card("*CONTROL_TIMESTEP", [0, tssfac]).card("*CONTROL_SPH", [1, 0, 1e20, dim])
        self.card("*SECTION_SPH", [1, cslh, 1.0, 1.0, 0.0, 1e20, 0.0, sphkern])
        if kernel:
            self.card("*COURANT_KERNEL", kernel)
        self.card("*PART", "water", [1, 1, 1, 1, 1]).card("*MAT_NULL", [1, rho, -1e20, mu]).card("*EOS_LINEAR_POLYNOMIAL", [1, 0.0, rho * c0**2])
        self.card("*HOURGLASS", [1, 0, 0.0, 0, 1e-20, max(q1, 1e-20)]).card("*COURANT_DENSITY_DIFFUSION", [diffusion])
        for name in ("GLSTAT", "MATSUM", "RCFORC"):
            self.card(f"*DATABASE_{name}", [end / samples])
        if states:
            self.card("*DATABASE_BINARY_D3PLOT", [end / states])

    def box(self, low: tuple[float, float], high: tuple[float, float], depth: float = 0.0, g: float = 0.0) -> np.ndarray:
        """A lattice of water in the plane; with g at rest under a surface in the height `depth`. Numbers of the particles."""
        x, y = (np.arange(low[k] + 0.5 * self.dx, high[k], self.dx) for k in range(2))
        points = np.array([[a, b, 0.0] for b in y for a in x])
        return self.particles(1, points, self.rho * self.dx**2, self.rho * g * (depth - points[:, 1]) if g else None)

    def along_y(self, g: float, along_x: float = 0.0) -> None:
        """Gravity [L/T2] downwards, and a steady push along x."""
        self.curve(91, [(0.0, g), (1e6, g)])
        self.card("*LOAD_BODY_Y", [91])
        if along_x:
            self.curve(92, [(0.0, -along_x), (1e6, -along_x)])
            self.card("*LOAD_BODY_X", [92])

    def walls(self, method: str, *plates: tuple[tuple[float, float], tuple[float, float]]) -> None:
        """Rigid plates of the plane from one point to another, of about ten shells."""
        sheet = 0.9999 * self.dx * (1 if method == "contact" else 0.4)
        self.card("*PART", "walls", [2, 2, 2]).card("*SECTION_SHELL", [2, 2], [sheet] * 4).card("*MAT_RIGID", [2, 7850.0, 2.1e11, 0.3], [1, 7, 7], "")
        for a, b in plates:
            self.mesh("SHELL", 2, _strip(np.array(a), np.array(b), 10))
        self.contact(2, 0.0)
        if method != "contact":
            self.card("*COURANT_WALL_SUPPORT", [2, 3, 0.0, METHODS[method]])

    def contact(self, part: int, touch: float) -> None:
        """Of the water with a part; `touch`: thickness of the particles."""
        self.card("*CONTACT_AUTOMATIC_NODES_TO_SURFACE", [1, part, 3, 3], [0.0], [self.sfsa, 1000.0 if self.dim == 2 else 10.0, touch], [self.soft])

    def plate(self, kind: str, elform: int, a: tuple[float, float], b: tuple[float, float], h: float, n: int, E: float, nu: float, rho: float,
              clamped: tuple[float, ...], across: int = 2) -> None:
        """Part 3 of the plane between two points, n elements along and `across` solids over its thickness h; clamped at `clamped`, 0 the first end, 1 the
        second one. Its first node, number 1 of a new deck, is in the middle of it if both are clamped, else at its free end."""
        at = 0.5 if len(clamped) == 2 else 1.0 - clamped[0]
        self.material(kind, elform, h, E, nu, rho)
        if kind == "SHELL":
            mesh = _strip(np.array(a), np.array(b), n)
            ids = self.mesh(kind, 3, mesh, [mesh.nearest(at, 0)])
        else:
            along = np.array(b) - np.array(a)
            normal = h * np.array([-along[1], along[0]]) / np.linalg.norm(along)
            mesh = grid([n, across, 1], lambda u: np.column_stack([np.array(a) + u[:, :1] * along + (u[:, 1:2] - 0.5) * normal, u[:, 2] - 0.5]))
            ids = self.mesh(kind, 3, mesh, [mesh.nearest(at, 0.5, 0)])
        for end in clamped:
            self.hold(ids[mesh.where(0, end)], "xyzXYZ" if kind == "SHELL" else "xyz")
        self.contact(3, 0.9999 * self.dx)
        self.card("*DATABASE_HISTORY_NODE", [int(ids.min())]).card("*DATABASE_NODOUT", [self.end / 400])

    def material(self, kind: str, elform: int, h: float, E: float, nu: float, rho: float) -> None:
        """Part 3, elastic; solids of ELFORM 1 bend exactly by IHQ 6 with QM 1."""
        self.card("*PART", "structure", [3, 3, 3, 0, 3]).card("*MAT_ELASTIC", [3, rho, E, nu])
        self.card("*HOURGLASS", [3, 4 if kind == "SHELL" else 6, 0.05 if kind == "SHELL" else 1.0])
        if kind == "SHELL":
            self.card("*SECTION_SHELL", [3, elform, 5 / 6, 3], [h] * 4).card("*CONTROL_SHELL", [20, 0, -1, 0, 2, 1])
        else:
            self.card("*SECTION_SOLID", [3, elform])


def _strip(a: np.ndarray, b: np.ndarray, n: int):
    """Shells of the plane from a to b, one deep in z."""
    return grid([n, 1], lambda u: np.column_stack([a + u[:, :1] * (b - a), u[:, 1] - 0.5]))


def _quarter(n: int, R: float, turns: float = 0.25) -> tuple[np.ndarray, np.ndarray]:
    """Points (m, 2) and areas (m,) of rings of particles in a sector of a disc of radius R, n over it."""
    dx, points, areas = R / n, [], []
    for k in range(n):
        of = int(round(2 * np.pi * turns * (k + 0.5)))
        angle = 2 * np.pi * turns * (np.arange(of) + 0.5) / of
        points.append((k + 0.5) * dx * np.column_stack([np.cos(angle), np.sin(angle)]))
        areas.append(np.full(of, np.pi * turns * ((k + 1) ** 2 - k**2) * dx**2 / of))
    return np.concatenate(points), np.concatenate(areas)


def _chords(around: int) -> float:
    """Radius of the corners of a polygon over that of the circle with the same area."""
    return float(np.sqrt(2 * np.pi / around / np.sin(2 * np.pi / around)))


def plate(n: int = 8, kind: str = "SHELL", elform: int = 2, scheme: str = "cubic", walls: str = "contact", tssfac: float = 0.9, sfsa: float = 10.0, soft: int = 0,
          q1: float = 0.1, diffusion: float = 0.1, c0: float = 200.0, span: float = 1.0, depth: float = 2.0, h: float = 0.05, E: float = 67.5e9, nu: float = 0.34, rho_s: float = 2700.0,
          g: float = 9.81, T: float = 0.45) -> Flow:
    """Water on an elastic plate, clamped at both ends, that swings about where it rests; n particles and elements over the span."""
    dx = span / n
    deck = Flow("water on a plate", T, dx, c0, scheme, tssfac, q1, sfsa=sfsa, soft=soft, diffusion=diffusion)
    deck.plate(kind, elform, (0, -0.5 * h), (span, -0.5 * h), h, n, E, nu, rho_s, (0.0, 1.0))
    deck.box((0, 0), (span, depth), depth, g)
    deck.walls(walls, ((0, 0), (0, 1.2 * depth)), ((span, 0), (span, 1.2 * depth)))
    deck.along_y(g)
    return deck


def ring(n: int = 8, kind: str = "SHELL", elform: int = 2, scheme: str = "cubic", tssfac: float = 0.9, sfsa: float = 100.0, soft: int = 0, q1: float = 0.1, diffusion: float = 0.1,
         c0: float = 100.0, a: float = 0.1, h: float = 0.005, E: float = 4.1e8, rho_s: float = 2700.0, p0: float = 1e5, T: float = 0.01) -> Flow:
    """An elastic ring full of water, which begins with the pressure p0 and stretches the ring, at rest by damping; n particles over the radius a."""
    deck = Flow("ring full of water", T, a / n, c0, scheme, tssfac, q1, sfsa=sfsa, soft=soft, diffusion=diffusion, states=20)
    deck.material(kind, elform, h, E, 0.0, rho_s)
    around = 4 * int(np.ceil(0.5 * np.pi * n))

    def mapped(u: np.ndarray) -> np.ndarray:
        turn = 2 * np.pi * (u[:, 0] if kind == "SHELL" else -u[:, 0])  # solids are right-handed so
        r = _chords(around) * (a + h * (0.5 if kind == "SHELL" else u[:, 1]))
        return np.column_stack([r * np.cos(turn), r * np.sin(turn), u[:, -1] - 0.5])

    mesh = join(grid([around, 1] if kind == "SHELL" else [around, 2, 1], mapped))
    four = [int(np.argmin(np.linalg.norm(mesh.points - (a + 0.5 * h) * np.array([x, y, -0.5 / (a + 0.5 * h)]), axis=1))) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    ids = deck.mesh(kind, 3, mesh, four)
    for axis, pair in ((1, (0, 2)), (0, (1, 3))):
        deck.hold(ids[[four[k] for k in pair]], "xy"[axis])
    deck.contact(3, 0.9999 * deck.dx)
    points, areas = _quarter(n, a, 1.0)
    deck.particles(1, np.column_stack([points, np.zeros(len(points))]), deck.rho * areas * (1 + p0 / (deck.rho * c0**2)), np.full(len(points), p0))
    deck.card("*DAMPING_GLOBAL", [0, c0 / a])
    deck.card("*DATABASE_HISTORY_NODE", [int(ids[k]) for k in four]).card("*DATABASE_NODOUT", [deck.end / 400])
    return deck


def hammer(n: int = 6, scheme: str = "cubic", tssfac: float = 0.9, sfsa: float = 100.0, soft: int = 0, q1: float = 0.1, diffusion: float = 0.1, elform: int = 2, c0: float = 1000.0,
           a: float = 0.05, h: float = 0.005, L: float = 1.0, E: float = 2.1e10, rho_s: float = 2700.0, v0: float = 1.0,
           T: float = 1.2e-3) -> Flow:
    """Water in a tube runs against its closed end, z = 0; a quarter of the tube, whose rings move by themselves (nu 0, held along z)."""
    dx = a / n
    deck = Flow("water hammer", T, dx, c0, scheme, tssfac, q1, dim=3, sfsa=sfsa, soft=soft, diffusion=diffusion, states=40)
    points, areas = _quarter(n, a)
    layers = (np.arange(int(round(L / dx))) + 0.5) * dx
    ids = deck.particles(1, np.array([[x, y, z] for z in layers for x, y in points]), deck.rho * dx * np.tile(areas, len(layers)))
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.0, 0.0, -v0] for i in ids))
    for normal in np.eye(3):
        deck.card("*BOUNDARY_SPH_SYMMETRY_PLANE", [0.0, 0.0, 0.0, *map(float, normal)])
    deck.material("SHELL", elform, h, E, 0.0, rho_s)
    around = int(np.ceil(0.5 * np.pi * n))
    r = _chords(4 * around) * (a + 0.5 * h)
    mesh = grid([around, len(layers) + 4],
                lambda u: np.column_stack([r * np.cos(0.5 * np.pi * u[:, 0]), r * np.sin(0.5 * np.pi * u[:, 0]), (L + 4 * dx) * u[:, 1]]))
    shell = deck.mesh("SHELL", 3, mesh)
    deck.hold(shell, "z").hold(shell[mesh.where(0, 0)], "yXZ").hold(shell[mesh.where(0, 1)], "xYZ")
    deck.contact(3, 0.9999 * dx)
    return deck


def gate(n: int = 28, kind: str = "SHELL", elform: int = 2, scheme: str = "cubic", walls: str = "contact", tssfac: float = 0.9, q1: float = 0.05, c0: float = 20.0,
         shells: int = 16, depth: float = 0.14, width: float = 0.1, high: float = 0.079, h: float = 0.005, E: float = 7.8e6, nu: float = 0.47, g: float = 9.81) -> Flow:
    """Water bends a gate of rubber, clamped at its upper end, and flows out under it; n particles deep, a multiple of 7."""
    dx = depth / n
    deck = Flow("elastic gate", 0.2, dx, c0, scheme, tssfac, q1)
    x = width + 0.5 * h
    deck.plate(kind, elform, (x, 0), (x, high), h, shells, E, nu, 1100.0, (1.0,))
    deck.box((0, 0), (width, depth), depth, g)
    deck.walls(walls, ((0, 0), (0.6, 0)), ((0, 0), (0, 1.2 * depth)), ((x, high), (x, 1.2 * depth)))
    deck.along_y(g)
    return deck


def dam(n: int = 20, kind: str = "SHELL", elform: int = 2, scheme: str = "cubic", walls: str = "contact", tssfac: float = 0.9, q1: float = 0.05, c0: float = 35.0,
        shells: int = 16, width: float = 0.146, high: float = 0.08, h: float = 0.012, E: float = 1e6, g: float = 9.81) -> Flow:
    """A column of water, twice as high as wide, collapses and strikes a plate clamped at its foot; n particles over its width."""
    deck = Flow("dam break on a plate", 0.35, width / n, c0, scheme, tssfac, q1)
    x = 2 * width + 0.5 * h
    deck.plate(kind, elform, (x, 0), (x, high), h, shells, E, 0.0, 2500.0, (0.0,))
    deck.box((0, 0), (width, 2 * width), 2 * width)
    deck.walls(walls, ((0, 0), (4 * width, 0)), ((0, 0), (0, 3 * width)), ((4 * width, 0), (4 * width, 3 * width)))
    deck.along_y(g)
    return deck


def baffle(n: int = 8, kind: str = "SHELL", elform: int = 2, scheme: str = "cubic", walls: str = "contact", tssfac: float = 0.9, q1: float = 0.02, c0: float = 15.0,
           shells: int = 12, depth: float = 0.06, wide: float = 0.3, high: float = 0.072, h: float = 0.004, E: float = 6e6, g: float = 9.81, push: float = 0.2) -> Flow:
    """Oil on both sides of an elastic plate that is clamped at the floor, under a steady push sideways; n particles over the depth."""
    dx = depth / n
    deck = Flow("sloshing beside a baffle", 2.1, dx, c0, scheme, tssfac, q1, rho=917.0, mu=0.0459)
    end, x = 2 * wide + h, wide + 0.5 * h
    deck.plate(kind, elform, (x, 0), (x, high), h, shells, E, 0.0, 1100.0, (0.0,))
    deck.box((0, 0), (wide, depth), depth, g)
    deck.box((wide + h, 0), (end, depth), depth, g)
    deck.walls(walls, ((0, 0), (end, 0)), ((0, 0), (0, 1.5 * depth)), ((end, 0), (end, 1.5 * depth)))
    deck.along_y(g, push)
    return deck


def bird(n: int = 6, scheme: str = "cubic", tssfac: float = 0.9, sfsa: float = 10.0, soft: int = 0, riemann: int = 0, linear: float = 0.06, quadratic: float = 1.5,
         V: float = 116.0, R: float = 0.05, L: float = 0.2, rho0: float = 950.0, c: float = 1482.9, k: float = 2.0,
         T: float = 2.3e-3) -> DeckBuilder:
    """A cylinder of gelatine flies end on against a rigid plate in z = 0; a quarter of it, n particles over its radius."""
    dx = R / n
    deck = DeckBuilder("bird strike", T)
    cslh, sphkern, kernel = SCHEMES[scheme]
    deck.card("*CONTROL_TIMESTEP", [0, tssfac]).card("*CONTROL_SPH", [1, 0, 1e20, 3]).card("*SECTION_SPH", [1, cslh, 0.2, 2.0, 0.0, 1e20, 0.0, sphkern])
    if kernel:
        deck.card("*COURANT_KERNEL", kernel)
    deck.card("*PART", "bird", [1, 1, 1, 1, 0 if riemann else 1]).card("*MAT_NULL", [1, rho0])
    c1 = rho0 * c * c
    deck.card("*EOS_LINEAR_POLYNOMIAL", [1, 0.0, c1, (2 * k - 1) * c1, (k - 1) * (3 * k - 1) * c1])
    if riemann:
        deck.card("*COURANT_RIEMANN", [float(riemann)])
    else:
        deck.card("*HOURGLASS", [1, 0, 0.0, 0, quadratic, linear])
    points, areas = _quarter(n, R)
    layers = (np.arange(int(round(L / dx))) + 0.5) * dx
    ids = deck.particles(1, np.array([[x, y, z + 1e-6] for z in layers for x, y in points]), rho0 * dx * np.tile(areas, len(layers)))
    deck.card("*INITIAL_VELOCITY_NODE", *([int(i), 0.0, 0.0, -V] for i in ids))
    for normal in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)):
        deck.card("*BOUNDARY_SPH_SYMMETRY_PLANE", [0.0, 0.0, 0.0, *normal])
    deck.card("*PART", "plate", [2, 2, 2]).card("*SECTION_SHELL", [2, 2], [0.002] * 4).card("*MAT_RIGID", [2, 2770.0, 72.4e9, 0.33], [1, 7, 7], "")
    deck.mesh("SHELL", 2, grid([12, 12], lambda u: np.column_stack([6 * R * u[:, 0] - 0.001, 6 * R * u[:, 1] - 0.001, np.full(len(u), -0.001)])))
    deck.card("*CONTACT_AUTOMATIC_NODES_TO_SURFACE", [1, 2, 3, 3], [0.0], [sfsa, 10.0, 0.9999 * dx], [soft])
    for name in ("GLSTAT", "MATSUM", "RCFORC"):
        deck.card(f"*DATABASE_{name}", [deck.end / 500])
    return deck
