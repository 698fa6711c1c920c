"""Reads LS-DYNA's ASCII histories, of Courant and of LS-DYNA itself.

Read are those of ASCII_NAMES: every one that `courant run` writes. The kind follows from the content, not from the name. Taken as they come: titles, legends, columns that newer versions append, slave and master for SURFA and
SURFB, exponents without E (0.1-100), stars for numbers that did not fit. Where a run was restarted and its times go back,
the later states count.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from os import PathLike
from pathlib import Path

import numpy as np

from . import ascii_elements  # noqa: F401  registers kinds
from .ascii_kinds import ASCII_KINDS, AsciiFault, AsciiKey, AsciiKind, AsciiStates
from .diagnostics import Diagnostics, Location
from .words import nearest_word

__all__ = ["ASCII_NAMES", "AsciiFile", "AsciiKey"]

ASCII_NAMES = tuple(ASCII_KINDS)
"""Names of the files, the table that all of the package shares."""

_KNOWN = f"{', '.join(ASCII_NAMES[:-1])} and {ASCII_NAMES[-1]} are read"
_ENERGY, _FORCE = "ML2/T2", "ML/T2"
# of a kind ("": any), the end of a name and its dimension; the first that fits counts
_DIMENSIONS = [
    ("", "cycle", "-"),
    ("glstat", "time step", "T"),
    ("glstat", "nanosec)", "ns"),
    ("glstat", "initial energy", "-"),
    ("glstat", "w/o eroded energy", "-"),
    ("glstat", "energy", _ENERGY),
    ("glstat", "work", _ENERGY),
    ("glstat", "velocity", "L/T"),
    ("glstat", "added mass", "M"),
    ("glstat", "percentage increase", "%"),
    ("matsum", "-mom", "ML/T"),
    ("matsum", "-rbv", "L/T"),
    ("matsum", "+mass", "M"),
    *(("matsum", name, _ENERGY) for name in ("inten", "kinen", "hgeng", "eroded_ie", "eroded_ke", "eroded_he")),
    ("rcforc", "mass", "M"),
    *(("rcforc", name, _ENERGY) for name in ("mx", "my", "mz")),
    *(("rcforc", name, _FORCE) for name in "xyz"),
    ("sleout", "", _ENERGY),
    ("nodout", "-disp", "L"),
    ("nodout", "-vel", "L/T"),
    ("nodout", "-accl", "L/T2"),
    ("nodout", "-coor", "L"),
    ("nodout", "-rot", "-"),
    ("nodout", "-rot vel", "1/T"),
    ("nodout", "-rot acc", "1/T2"),
    *(("bndout", name, _ENERGY) for name in ("moment", "energy", "etotal")),
    ("bndout", "", _FORCE),
    ("rwforc", "", _FORCE),
    ("sphout", "density", "M/L3"),
    ("sphout", "smooth", "L"),
    *(("sphout", name, "-") for name in ("neigh", "act")),
    *(("sphout", name, "M/LT2") for name in ("yield", "effsg")),
    *(("elout", name, _FORCE) for name in ("axial", "shear-s", "shear-t")),
    *(("elout", name, _ENERGY) for name in ("moment-s", "moment-t", "torsion")),
    *(("elout", name, "-") for name in ("strain", "eps")),
    *(("elout", name, "M/LT2") for name in ("effsg", "sigma 11", "sigma 12", "sigma 31")),
    ("secforc", "area", "L2"),
    ("secforc", "centroid", "L"),
    ("deforc", "change in length", "L"),
    ("deforc", "relative rotation", "-"),
    *((kind, "force", _FORCE) for kind in ("secforc", "deforc", "jntforc")),
    *((kind, "moment", _ENERGY) for kind in ("secforc", "deforc", "jntforc", "swforc")),
    *(("swforc", name, _FORCE) for name in ("axial", "shear")),
    ("swforc", "failure", "T"),
    ("swforc", "length", "L"),
    ("swforc", "torsion", _ENERGY),
    *(("trhist", name, "-") for name in ("efp", "rvol", "active")),
    ("trhist", "rho", "M/L3"),
    *(("trhist", name, "L/T") for name in ("vx", "vy", "vz")),
    *(("trhist", name, "M/LT2") for name in ("sx", "sy", "sz", "sxy", "syz", "szx")),
    *(("trhist", name, "L") for name in "xyz"),
]
# of what a name holds: dimension, and that of rotations
_HELD = {
    "spcforc": [("moment", _ENERGY, _ENERGY), ("", _FORCE, _FORCE)],
    "sphout": [("sig-", "M/LT2", "M/LT2"), ("eps-", "-", "-")],
    "elout": [("sig-", "M/LT2", "M/LT2"), ("eps-", "-", "-")],
    "rbdout": [
        ("coordinates", "L", "L"),
        ("displacements", "L", "-"),
        ("velocities", "L/T", "1/T"),
        ("accelerations", "L/T2", "1/T2"),
        ("", "-", "-"),  # directions
    ],
}


def dimension_of(kind: str, name: str) -> str:
    """Dimension of a series in M, L, T, "ML/T2"; "-" for a pure number, "?" where it is not known."""
    for of, ending, dimension in _DIMENSIONS:
        if of in ("", kind) and name.endswith(ending):
            return dimension
    for word, plain, turning in _HELD.get(kind, []):
        if word in name:
            return turning if name.endswith("-rot") else plain
    return "?"


class AsciiFile:
    """A history that was read whole. `kind`: "glstat", ...; `times`: (n,) as printed [T]; `columns`: (n,) by AsciiKey,
    NaN where a value is not there or has stars."""

    def __init__(self, kind: str, states: AsciiStates) -> None:
        self.kind = kind
        self.times = np.array(states.times)
        self.columns: dict[AsciiKey, np.ndarray] = {key: np.array(values) for key, values in states.whole_columns().items()}

    @classmethod
    def open(cls, file: str | PathLike[str], diagnostics: Diagnostics) -> AsciiFile | None:
        """Faults are reported with file and line; then there is None."""
        path = str(file)
        text = _read_text(path, diagnostics)
        if text is None:
            return None
        lines = [line[:-1] if line.endswith("\r") else line for line in text.split("\n")]
        ends_whole = lines[-1] == ""
        if ends_whole:
            lines.pop()
        kind = _kind_of(lines)
        if kind is None:
            diagnostics.error(Location(path, len(lines)), "up to its end the file has no state of a history", _KNOWN)
            return None
        states = AsciiStates()
        at = [0]
        try:
            _read_states(lines, ends_whole, kind, states, at)
        except AsciiFault as fault:
            hint = "if the run that writes it goes on, wait for its end; else take off the last, broken state"
            diagnostics.error(Location(path, at[0] + 1), f"not a line of a whole {kind.name}: {fault}", hint)
            return None
        if states.dropped:
            back = "times go back, as where a run was restarted"
            diagnostics.warning(path, f"{back}: {states.dropped} states before that were replaced by later ones")
        return cls(kind.name, states)

    def find(self, asked: AsciiKey) -> tuple[AsciiKey | None, str, str]:
        """The one series with this name; id and side may be left out where they leave no doubt. A side is found by any of its
        words. Otherwise None; the texts tell why, and give a hint."""
        if self.kind == "sleout" and asked.name == "total friction":
            asked = asked._replace(name="friction energy")
        asked = asked._replace(side={"slave": "SURFA", "master": "SURFB"}.get(asked.side, asked.side))
        found = [key for key in self.columns if _fits(asked, key)]
        if len(found) == 1:
            return found[0], "", ""
        whose = f" of {_owner(asked)}" if _owner(asked) else ""
        if found:
            owners = {_owner(key) for key in found}
            return None, f"{self.kind} has several '{asked.name}'{whose}", f"tell id, or side: {_some(owners)}"
        owners = {_owner(key) for key in self.columns if key.name == asked.name}
        if owners:
            hint = "it belongs to the whole: without id and side" if owners == {""} else f"it has that of {_some(owners)}"
            return None, f"{self.kind} has no '{asked.name}' of {_owner(asked)}", hint
        names = {key.name for key in self.columns}
        near = nearest_word(asked.name, sorted(names))
        return None, f"{self.kind} has no '{asked.name}'", f"did you mean '{near}'?" if near else f"it has {_some(names)}"

    def dimension(self, key: AsciiKey) -> str:
        """Dimension of a series in M, L, T; "-", "?", "ns" and "%" represent themselves."""
        return dimension_of(self.kind, key.name)


def _read_text(path: str, diagnostics: Diagnostics) -> str | None:
    try:
        if not Path(path).is_file():  # nothing waits for a pipe
            raise FileNotFoundError(path)
        text = Path(path).read_bytes().decode("latin-1")
    except OSError:
        hint = "a name alone is a file in the folder of results; a path counts from the recipe's folder"
        diagnostics.error(path, "cannot read the history", hint)
        return None
    if (at := text.find("\0")) >= 0:
        diagnostics.error(Location(path, text.count("\n", 0, at) + 1), "this is no text file", _KNOWN)
        return None
    return text


def _kind_of(lines: list[str]) -> AsciiKind | None:
    return next((kind for line in lines for kind in ASCII_KINDS.values() if kind.told_by(line)), None)


def _read_states(lines: list[str], ends_whole: bool, kind: AsciiKind, states: AsciiStates, at: list[int]) -> None:
    """Raises AsciiFault. `at`: the line that is being read, for the message."""

    def data() -> Iterator[str]:
        legend = False
        for k, line in enumerate(lines):
            at[0] = k
            legend = legend or line.startswith("{BEGIN LEGEND}")
            if not ends_whole and k == len(lines) - 1:
                raise AsciiFault("the file is cut off within this line")
            if not legend:
                yield line
            legend = legend and not line.startswith("{END LEGEND}")

    kind.read(data(), states)
    sizes = states.sizes
    if len(sizes) > 1 and sizes[-1] < sizes[-2]:
        last = f"its last state, at time {states.times[-1]:.6g}, has {sizes[-1]} numbers, the one before it {sizes[-2]}"
        raise AsciiFault(f"the file is cut off: {last}")


def _fits(asked: AsciiKey, key: AsciiKey) -> bool:
    if asked.name != key.name or (asked.id is not None and asked.id != key.id):
        return False
    return asked.side in ("", key.side) or f" {asked.side} " in f" {key.side} "


def _owner(key: AsciiKey) -> str:
    """ "1 SURFA", "12", "velocity": what a series belongs to."""
    return " ".join(word for word in ("" if key.id is None else str(key.id), key.side) if word)


def _some(names: Iterable[str]) -> str:
    """A few of many names."""
    all_names, most = sorted(names), 12
    return ", ".join([name for name in all_names if name][:most]) + (", ..." if len(all_names) > most else "")
