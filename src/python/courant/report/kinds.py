"""The one table of what histories a page shows, forces first, and where each is found."""

from __future__ import annotations

from dataclasses import dataclass

_FORCE, _ENERGY, _LENGTH = "ML/T2", "ML2/T2", "L"
_AXES = "xyz"


@dataclass(frozen=True)
class Series:
    """A curve: `h5`: data set, with `component` of a vector; `ascii`: column, and `side` its side; `binout`: array."""

    label: str
    h5: str
    component: int | None
    ascii: str
    binout: str
    side: str = ""


@dataclass(frozen=True)
class Quantity:
    """Curves of one picture. `vector`: they are the components, and their length is drawn, too."""

    label: str
    dimension: str
    series: tuple[Series, ...]
    vector: bool = False


@dataclass(frozen=True)
class Kind:
    """`groups`: of history.h5, before the id; `file`: the ASCII history; `binout`: its folders; `each`: most entities that get pictures of their own;
    `together`: all entities in one picture; `sum`: what the sum over all entities is called."""

    title: str
    noun: str
    file: str
    groups: tuple[str, ...]
    quantities: tuple[Quantity, ...]
    binout: tuple[str, ...] = ()
    each: int = 4
    together: bool = False
    sum: str = ""


def _vector(label: str, dimension: str, h5: str, ascii: str, binout: str, side: str = "") -> Quantity:
    """`{}` in names is the axis."""
    some = (Series(axis, h5, k, ascii.format(axis), binout.format(axis), side) for k, axis in enumerate(_AXES))
    return Quantity(label, dimension, tuple(some), True)


def _scalars(label: str, dimension: str, *names: tuple[str, str, str, str]) -> Quantity:
    return Quantity(label, dimension, tuple(Series(name, h5, None, ascii, binout) for name, h5, ascii, binout in names))


KINDS = (
    Kind("Forces on rigid walls", "wall", "rwforc", ("rigid_walls",), (_vector("force", _FORCE, "force", "{}", "{}_force"),), ("rwforc/forces",)),
    Kind("Contact forces", "contact", "rcforc", ("contacts",), (_vector("force", _FORCE, "force", "{}", "{}_force", "SURFA"),), ("rcforc",)),
    Kind("Contact energies", "contact", "sleout", ("contacts",), (_scalars(
        "energy", _ENERGY, ("stored", "energy_stored", "surfa", "slave"), ("friction", "energy_friction", "frictional", "friction_energy"),
        ("damping", "energy_damping", "", "")),), ("sleout",)),
    Kind("Forces of supports", "node", "spcforc", ("held_particles",), (_vector("force", _FORCE, "force", "forces {}", "{}_force"),), ("spcforc",),
         each=2, sum="all supported nodes"),
    Kind("Moments of supports", "node", "spcforc", ("held_rotations",), (_vector("moment", _ENERGY, "moment", "moments {}", "{}_moment"),), ("spcforc",),
         each=2, sum="all supported nodes"),
    Kind("Forces of prescribed motions", "", "bndout", ("driven_bodies", "driven_particles"), (
        _vector("force", _FORCE, "force", "{}force", "{}_force"), _vector("moment", _ENERGY, "moment", "{}moment", "{}_moment"),
        _scalars("work", _ENERGY, ("work", "work", "energy", "energy"))), ("bndout/velocity/nodes", "bndout/velocity/rigidbodies"), each=3),
    Kind("Forces in cross sections", "section", "secforc", ("sections",), (
        _vector("force", _FORCE, "force", "{}-force", "{}_force"), _vector("moment", _ENERGY, "moment", "{}-moment", "{}_moment")), ("secforc",)),
    Kind("Forces in joints", "joint", "jntforc", ("joints",), (
        _vector("force", _FORCE, "force", "{}-force", "{}_force"), _vector("moment", _ENERGY, "moment", "{}-moment", "{}_moment")), ("jntforc/joints",)),
    Kind("Forces in welds", "weld", "swforc", ("welds",), (
        _scalars("force", _FORCE, ("axial", "axial", "axial", "axial"), ("shear", "shear", "shear", "shear")),
        _scalars("moment", _ENERGY, ("bending", "resultant_moment", "moment", "resultant_moment"), ("torsion", "torsion", "torsion", "torsion")),
        _scalars("length", _LENGTH, ("length", "length", "length", "length"))), ("swforc",)),
    Kind("Springs and dampers", "spring", "deforc", ("springs",), (
        _scalars("force", _FORCE, ("force", "resultant", "resultant force", "resultant_force")),
        _scalars("change in length", _LENGTH, ("change", "change_in_length", "change in length", "displacement")),
        _scalars("moment", _ENERGY, ("moment", "resultant_moment", "resultant moment", "")),
        _scalars("rotation", "-", ("rotation", "relative_rotation", "relative rotation", ""))), ("deforc",)),
    Kind("Rigid bodies", "body", "rbdout", ("rigid_bodies",), (
        _vector("displacement", _LENGTH, "displacement", "displacements {}", "global_d{}"),
        _vector("velocity", "L/T", "v", "velocities {}", "global_v{}"),
        _vector("force", _FORCE, "force", "", "")), ("rbdout",), each=3),
    Kind("Gauges", "gauge", "", ("gauges",), (), each=12),
    Kind("Stresses and forces in elements", "element", "elout", ("solids", "shells", "beams"), (
        _scalars("axial force", _FORCE, ("axial", "axial", "axial", "axial")),
        _scalars("shear force", _FORCE, ("s", "shear_s", "shear-s", "shear_s"), ("t", "shear_t", "shear-t", "shear_t")),
        _scalars("moment", _ENERGY, ("s", "moment_s", "moment-s", "moment_s"), ("t", "moment_t", "moment-t", "moment_t"),
                 ("torsion", "torsion", "torsion", "torsion"))), ("elout/solid", "elout/shell", "elout/beam")),
    Kind("Particles", "particle", "sphout", ("particles",), (
        _scalars("pressure", "M/LT2", ("pressure", "p", "", "")), _vector("velocity", "L/T", "v", "", ""),
        _scalars("density", "M/L3", ("density", "rho", "density", "density"))), ("sphout",), each=3),
    Kind("Tracers", "tracer", "trhist", ("tracers",), (
        _vector("velocity", "L/T", "v", "v{}", "v{}"), _vector("position", _LENGTH, "x", "{}", "{}"),
        _scalars("density", "M/L3", ("density", "rho", "rho", "rho"))), ("trhist",), each=3),
    Kind("Motion of nodes", "node", "nodout", ("nodes",), (
        _vector("displacement", _LENGTH, "displacement", "{}-disp", "{}_displacement"), _vector("velocity", "L/T", "v", "{}-vel", "{}_velocity"),
        _vector("acceleration", "L/T2", "a", "{}-accl", "{}_acceleration")), ("nodout",), each=3),
    Kind("Energies of parts", "part", "matsum", ("parts",), (
        _scalars("internal energy", _ENERGY, ("internal", "internal", "inten", "internal_energy")),
        _scalars("kinetic energy", _ENERGY, ("kinetic", "kinetic", "kinen", "kinetic_energy")),
        _scalars("hourglass energy", _ENERGY, ("hourglass", "hourglass", "hgeng", "hourglass_energy"))), ("matsum",), each=10, together=True),
)  # fmt: skip
