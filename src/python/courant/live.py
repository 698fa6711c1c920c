"""The state of a run while it goes on, as a callback of `courant.run` and the loop over `courant.steps` get it.

def follow(state):
    print(state.t, state.particles["pressure"].max(), state.bodies[101].x)
    state.bodies[101].push(force=(0, 0, 50))

All is of one time level t: positions, pressures, forces; velocities are those of half a step before. Views are read-only and without a copy; what
Python keeps of them stays as it was when the run goes on. Changes act from the next step on, and the energy that they bring counts as work from outside.
"""
from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Union

import numpy as np

from .fields import find_ids
from .units import MODEL_UNITS, Units
from .words import Named

_AXES = {3: ("x", "y", "z"), 6: ("xx", "yy", "zz", "xy", "yz", "zx")}
Numbers = Union[np.ndarray, Sequence[float], Sequence[Sequence[float]]]


class LiveSet(Mapping[str, np.ndarray]):
    """The fields of particles, nodes, faces or elements by name. A field of one component, and a component as "velocity.x", is a read-only view (n,)
    without a copy; a field of several is a copy (n, components). Particles are in an order of their own, which changes: `index` finds them by their ids."""

    def __init__(self, state: Any, name: str, units: Units) -> None:
        self.name, self._state, self._units = name, state, units
        self._fields = {field: (dimension, components) for field, dimension, components in state.fields(name)}

    def __len__(self) -> int:
        """How many entities there are."""
        return int(self._state.size(self.name))

    def __iter__(self) -> Iterator[str]:
        return iter(self._fields)

    def __contains__(self, name: object) -> bool:
        return name in self._fields or name == "speed" and "velocity" in self._fields

    def __getitem__(self, name: str) -> np.ndarray:
        """Raises KeyError with the names there are."""
        field, _, axis = name.partition(".")
        if name == "speed" and "velocity" in self._fields:
            return np.sqrt(sum(self[f"velocity.{a}"] ** 2 for a in "xyz"))
        components = self._fields.get(field, ("", 0))[1]
        axes = _AXES.get(components, tuple(str(k) for k in range(components)))
        if not components or (axis and axis not in axes):
            raise KeyError(f"{self.name} have no field '{name}'; they have {', '.join(self)}")
        if axis or components == 1:
            return self._state.array(self.name, field, axes.index(axis) if axis else 0)
        return np.stack([self._state.array(self.name, field, k) for k in range(components)], axis=1)

    def unit(self, name: str) -> str:
        return self._units.of_text(self._fields["velocity" if name == "speed" else name.partition(".")[0]][0])

    @property
    def ids(self) -> np.ndarray:
        """The numbers of the deck, (n,)."""
        return self["id"]

    @property
    def active(self) -> slice:
        """The entities that take part: of particles those inside of the computational box, which are the first ones."""
        return slice(0, self._state.active() if self.name == "particles" else len(self))

    def index(self, ids: int | Sequence[int] | np.ndarray) -> np.ndarray:
        """Where the entities of these numbers are in the arrays now, (m,). Raises KeyError for one that is not there."""
        wanted = np.atleast_1d(np.asarray(ids, dtype=np.int64))
        at, there = find_ids(wanted, self.ids)
        if not there.all():
            raise KeyError(f"{self.name} have no number {wanted[~there][0]}")
        return at

    def set_force(self, force: Numbers, ids: int | Sequence[int] | np.ndarray | None = None) -> None:
        """Force on each of these entities, or of all that are active, (3,) or (m, 3) [ML/T2], from the next step on until it is set again.
        Raises ValueError where one takes none."""
        self._state.set_forces(self.name, *self._rows(force, ids))

    def set_velocity(self, velocity: Numbers, ids: int | Sequence[int] | np.ndarray | None = None) -> None:
        """The same of velocities, (3,) or (m, 3) [L/T], now; along axes that are held they stay 0."""
        self._state.set_velocities(self.name, *self._rows(velocity, ids))

    def _rows(self, values: Numbers, ids: int | Sequence[int] | np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
        at = np.arange(len(self))[self.active] if ids is None else self.index(ids)
        try:
            rows = np.asarray(values, dtype=float)
        except (TypeError, ValueError):
            raise ValueError(f"expected three components, or ({len(at)}, 3) of them, as numbers, got {values!r}") from None
        if rows.shape not in ((3,), (len(at), 3)):
            raise ValueError(f"expected three components, or ({len(at)}, 3) of them, got {rows.shape}")
        return at, np.broadcast_to(rows, (len(at), 3)).ravel()


def _three(name: str, values: Any) -> np.ndarray:
    """A vector; the extension module answers what is none with its own signatures."""
    try:
        vector = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        vector = np.empty(0)
    if vector.shape != (3,):
        raise ValueError(f"{name}={values!r}: expected three numbers; give {name}=(x, y, z), in the plane with z = 0")
    return vector


class LiveBody:
    """A rigid body: `mass` [M], centre `x` [L], `v` [L/T], `omega` [1/T], `force` [ML/T2], `moment` [ML2/T2], `kinetic_energy` [ML2/T2]."""

    def __init__(self, state: Any, body: Any) -> None:
        self._state, self._body = state, body

    def __getattr__(self, name: str) -> Any:
        return getattr(self._body, name)

    def push(self, force: Sequence[float] = (0, 0, 0), moment: Sequence[float] = (0, 0, 0)) -> None:
        """Force and moment about the centre from the next step on, until they are set again; along axes that are held they do nothing."""
        self._state.push_body(self._body.part, _three("force", force), _three("moment", moment))

    def move(self, velocity: Sequence[float] | None = None, omega: Sequence[float] | None = None) -> None:
        """Velocity of the centre and angular velocity, now; what is left out stays. Raises ValueError where the motion is prescribed."""
        given = (self._body.v if velocity is None else _three("velocity", velocity), self._body.omega if omega is None else _three("omega", omega))
        self._state.move_body(self._body.part, *given)


class LiveState:
    """The run at time t [T], in front of a step of dt [T]; `cycle` steps have been taken."""

    def __init__(self, state: Any, units: Units = MODEL_UNITS) -> None:
        self._state, self._units = state, units
        self.t, self.dt, self.cycle = float(state.t), float(state.dt), int(state.cycle)

    def __repr__(self) -> str:
        return f"<courant.LiveState t = {self.t:.6g}, cycle {self.cycle}>"

    @property
    def sets(self) -> list[str]:
        """Names of all sets of entities, "particles", "nodes", "solids of part 1"."""
        return list(self._state.sets())

    def __getitem__(self, name: str) -> LiveSet:
        """A set by its name. Raises KeyError with the names there are."""
        if name not in self.sets:
            raise KeyError(f"the run has no '{name}'; it has {', '.join(self.sets)}")
        return LiveSet(self._state, name, self._units)

    @property
    def particles(self) -> LiveSet:
        return self["particles"]

    @property
    def nodes(self) -> LiveSet:
        """Nodes of elements and bodies."""
        return self["nodes"]

    @property
    def bodies(self) -> dict[int, LiveBody]:
        """Rigid bodies by part."""
        return Named("rigid body", {part: LiveBody(self._state, body) for part, body in self._state.bodies().items()})
