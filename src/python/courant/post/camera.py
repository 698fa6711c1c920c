"""The axis against gravity, and parallel and perspective projection: where a point of the scene lies in a picture."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..diagnostics import CourantError

PROJECTIONS = ("parallel", "perspective")
AXES = ("x", "y", "z", "-x", "-y", "-z")
_STATES = 6  # that are looked at for gravity


def axis_of(name: str) -> np.ndarray:
    """ "-z" -> (0, 0, -1)."""
    out = np.zeros(3)
    out["xyz".index(name[-1])] = -1.0 if name.startswith("-") else 1.0
    return out


def up_of_gravity(run: Any) -> str | None:
    """The axis along which the potential energy of history.h5 grows with the height of the particles; None where results do not tell.

    E_pot = -sum m g . x: states are taken between which no particle comes or goes, and an axis that explains the energy to 2 %.
    """
    try:
        potential, t = run.histories["global/potential"], run.histories.t
    except (CourantError, KeyError):
        return None
    if len(t) < 2 or not np.ptp(potential) > 0:
        return None
    energy, moment, mass = [], [], []
    for k in np.unique(np.linspace(0, len(run.states) - 1, _STATES).astype(int)):
        state = run.states[int(k)]
        if state.particles is None:
            return None
        m = state.particles["mass"].astype(float)
        energy.append(np.interp(state.t, t, potential))
        moment.append(m @ state.particles.points)
        mass.append(m.sum())
    same = np.abs(np.array(mass) - mass[0]) < 1e-6 * mass[0]
    E, S = np.array(energy)[same], np.array(moment)[same]
    E, S = E - E[0], S - S[0]
    if len(E) < 3 or not np.abs(E).max() > 0:
        return None
    found = []
    for axis in range(3):
        if (S[:, axis] ** 2).sum() > 0:
            g = (E @ S[:, axis]) / (S[:, axis] ** 2).sum()
            found.append((float(np.abs(E - g * S[:, axis]).max() / np.abs(E).max()), "xyz"[axis] if g > 0 else "-" + "xyz"[axis]))
    rest, name = min(found, default=(1.0, ""))
    return name if rest < 0.02 else None


def up_of(run: Any, flat: bool) -> str:
    """From gravity, else y in the plane and z in space."""
    return up_of_gravity(run) or ("y" if flat else "z")


@dataclass(frozen=True)
class Camera:
    """`right`, `up`, `toward`: unit vectors of the picture's axes and of the path to the eye, (3,). Parallel projection, or, with a `distance` of the
    eye from `centre`, (3,), perspective: lengths are true in the plane through it [L]."""

    right: np.ndarray
    up: np.ndarray
    toward: np.ndarray
    centre: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros(3))
    distance: float = np.inf

    @classmethod
    def looking(cls, up: str, azimuth: float, elevation: float) -> Camera:
        """`up`: one of AXES, upright in the picture; at azimuth 0 the eye is on the side where x goes to the right (y where x is up), it goes
        against the clock around `up` as seen from above, and `elevation` over the horizon [degrees]."""
        above = axis_of(up)
        right = axis_of("y" if up[-1] == "x" else "x")
        front = -np.cross(above, right)  # the path to the eye at azimuth 0
        a, e = np.radians(azimuth), np.radians(elevation)
        across = np.cos(a) * right - np.sin(a) * front
        side = np.cos(a) * front + np.sin(a) * right
        toward = np.cos(e) * side + np.sin(e) * above
        return cls(across, np.cross(toward, across), toward)

    def before(self, corners: np.ndarray) -> Camera:
        """The same in perspective, the eye so far from points, (n, 3) [L], that all are well before it."""
        low, high = corners.min(axis=0), corners.max(axis=0)
        return replace(self, centre=0.5 * (low + high), distance=2.2 * float(np.sqrt(((high - low) ** 2).sum())) or 1.0)

    def turned(self, ways: np.ndarray) -> np.ndarray:
        """Components of vectors to the right, upward and toward the eye; (n, 3)."""
        return ways @ np.column_stack((self.right, self.up, self.toward))

    def enlarged(self, x: np.ndarray) -> np.ndarray:
        """How much larger than in the plane through the centre things at points look; (n, 3) [L] -> (n,)."""
        if np.isinf(self.distance):
            return np.ones(len(x))
        return self.distance / np.maximum(self.distance - (x - self.centre) @ self.toward, 1e-3 * self.distance)

    def project(self, x: np.ndarray) -> np.ndarray:
        """(n, 3) [L] -> (n, 3): to the right, upward, toward the eye [L]; planes stay planes, so that depths may be interpolated in the picture."""
        return self.turned(x - self.centre) * self.enlarged(x)[:, None]

    def sees(self, normals: np.ndarray, x: np.ndarray) -> np.ndarray:
        """Whether faces with outward normals at points turn toward the eye; (n, 3) each -> (n,) of bool."""
        way = self.toward if np.isinf(self.distance) else self.centre + self.distance * self.toward - x
        return (normals * way).sum(axis=1) > 0


def standing_azimuth(extent: np.ndarray, up: str) -> float:
    """An azimuth that shows the longer horizontal side of a scene; extent: (3,) [L]."""
    right = "xyz".index("y" if up[-1] == "x" else "x")
    depth = ({0, 1, 2} - {right, "xyz".index(up[-1])}).pop()
    return 60.0 if extent[depth] > 1.5 * extent[right] else 30.0


def plane_of(corners: np.ndarray, share: float = 1e-3) -> str:
    """The axis along which a scene has no extent next to its others, "z"; "" of scenes in space. corners: (n, 3) [L]."""
    extent = np.ptp(corners, axis=0)
    flat = np.flatnonzero(extent <= share * extent.max())
    return "xyz"[flat[0]] if len(flat) == 1 else ""


def front_of(normal: str, up: str) -> tuple[str, float, float]:
    """Up, azimuth and elevation that show a plane scene from the front. `normal`: of its plane; `up`: kept where it lies in the plane."""
    if up[-1] == normal:
        up = "y" if normal == "z" else "z"
    right = "y" if up[-1] == "x" else "x"
    return up, 90.0 if normal == right else 0.0, 0.0
