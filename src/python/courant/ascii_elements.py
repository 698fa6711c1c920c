"""Readers of the ASCII histories of elements, sections, springs, joints and welds; imported for the kinds that they register."""

from __future__ import annotations

import re
from typing import Any

from .ascii_kinds import AsciiFault, AsciiKey, AsciiStates, Lines, Text, ascii_kind

_STRESS = tuple(f"sig-{axes}" for axes in ("xx", "yy", "zz", "xy", "yz", "zx"))
_STRAIN = tuple(f"eps-{axes}" for axes in ("xx", "yy", "zz", "xy", "yz", "zx"))
_OF_SOLID, _OF_SHELL = (*_STRESS, "effsg", "yield"), (*_STRESS, "plastic strain")
_RESULTANTS = ("axial", "shear-s", "shear-t", "moment-s", "moment-t", "torsion")
_OF_BEAM = ("sigma 11", "sigma 12", "sigma 31", "plastic eps")
_ELEMENT = re.compile(r"[ \t]*([0-9]+)-[ \t]*[0-9]+[ \t]*$")
_POINT = re.compile(r"[ \t]*([0-9]+)(?:-[ \t]*[0-9]+)?[ \t]+[a-z]+[ \t]")  # number, place in the plane, state of the material
_KIND = re.compile(r"element part ID[ \t]+\(([a-z]+)\)")
_LABEL = re.compile(r" ([a-zA-Z/\- ]+?)\.{2,}(?=[ \t0-9+\-*])")


def _same_or_new_state(states: AsciiStates, t: float) -> None:
    if not states.times or states.times[-1] != t:
        states.begin(t)


class _Elout:
    """Where one is in the file: the kind of elements of a table, its columns, the element of the rows."""

    def __init__(self, states: AsciiStates) -> None:
        self.states, self.kind, self.history = states, "", False
        self.names: tuple[str, ...] = ()
        self.id: int | None = None
        self.points: dict[Any, Any] = {}

    def heading(self, line: str) -> None:
        text = Text(line).behind("at time")
        cycle = Text(line).behind("s t e p").certain(9, "no number for the cycle")
        t = text.time(12)
        if not self.states.times or self.states.times[-1] != t:
            self.states.begin(t)
            self.states.put(AsciiKey("cycle"), cycle)
        self.kind, self.id, self.history = "beam" if "r e s u l t a n t s" in line else "", None, "h i s t" in line
        self.names, self.points = (_STRAIN if "s t r a i n" in line else _OF_SOLID, {})

    def columns(self, line: str) -> bool:
        """Whether a line names the columns of what follows."""
        if found := _KIND.search(line):
            self.kind, self.names = found[1], _OF_SOLID
        elif "materl" in line and "element" in line:
            shell = "(global)" in line or "(local)" in line
            self.kind, self.names = ("shell", _OF_SHELL) if shell else ("solid", _STRAIN if self.names is _STRAIN else _OF_SOLID)
        elif line.startswith(" strains "):
            self.kind, self.names = "shell", _STRAIN
        elif "strain" in line and "eps-xx" in line:
            return True
        elif "ipt" not in line or "stress" not in line:
            return False
        return True

    def row(self, line: str) -> None:
        if found := _ELEMENT.match(line):
            self.id, self.points = int(found[1]), {}
        elif "beam/truss #" in line:
            self.id, self.names = Text(line).id_behind("=")[0], _RESULTANTS
        elif self.id is None:
            return
        elif "integration point stresses" in line:
            self.names = _OF_BEAM
        elif line.lstrip().startswith("resultants") and any(c.isdigit() for c in line):
            self.put(Text(line).behind("resultants"), _RESULTANTS, self.kind)
        elif self.names is _RESULTANTS and self.kind == "beam" and "axial" not in line and line.strip():
            self.put(Text(line), _RESULTANTS, "beam")
        elif self.names is _OF_BEAM and "sigma" not in line and line.strip():
            text = Text(line)
            point = text.id()
            self.put(text, _OF_BEAM, f"beam point {point}")
        elif self.names is _STRAIN and (side := line.strip().partition(" ")[0]) in ("lower", "upper"):
            self.put(Text(line).behind("surface"), _STRAIN, f"shell {side}")
        elif found := _POINT.match(line):
            self.point(int(found[1]), Text(line, found.end()))

    def point(self, number: int, text: Text) -> None:
        side = f"{self.kind} point {number}"
        if not self.history:
            return self.put(text, self.names, side)
        for value in text.numbers(12):
            count = self.points[number] = self.points.get(number, 0) + 1
            self.states.put(AsciiKey(f"history {count}", self.id, side), value)
        return None

    def put(self, text: Text, names: tuple[str, ...], side: str) -> None:
        values = text.numbers(12)
        if len(values) < len(names):
            raise AsciiFault(f"the row has {len(values)} numbers where {len(names)} belong")
        for name, value in zip(names, values, strict=False):
            self.states.put(AsciiKey(name, self.id, side), value)


def _is_elout(line: str) -> bool:
    return "f o r   t i m e  s t e p" in line and ("e l e m e n t" in line or "r e s u l t a n t s" in line)


@ascii_kind("elout", _is_elout)
def _elout(lines: Lines, states: AsciiStates) -> None:
    at = _Elout(states)
    for line in lines:
        if _is_elout(line):
            at.heading(line)
        elif states.times and not at.columns(line):
            at.row(line)


_OF_SECTION = (
    ("x-force", "y-force", "z-force", "resultant force"),
    ("x-moment", "y-moment", "z-moment", "resultant moment"),
    ("x-centroid", "y-centroid", "z-centroid", "area"),
)


@ascii_kind("secforc", lambda line: line.startswith(" line#1  section#"))
def _secforc(lines: Lines, states: AsciiStates) -> None:
    rows, section = 3, None
    for line in lines:
        if not line.strip() or "line#" in line:
            continue
        text = Text(line)
        if rows == 3:
            section = text.id()
            if section is None:
                continue  # of the head
            t = text.time(15)
            _same_or_new_state(states, t)
            rows = 0
        elif rows == 1:
            text = Text(line, 27) if "system" in line else Text(line).behind("ID =")
            if "system" not in line:
                text.id()
        if section is None:
            continue
        values = text.numbers(12)
        if len(values) < 4:
            raise AsciiFault("a section has rows of four numbers")
        for name, value in zip(_OF_SECTION[rows], values, strict=False):
            states.put(AsciiKey(name, section), value)
        rows += 1
    if rows != 3:
        raise AsciiFault("the file is cut off: its last section has no centroid")


def _labelled(lines: Lines, states: AsciiStates, id_label: str) -> None:
    """` label......number` of one entity after the other; a time begins a state where it is another one."""
    id: int | None = None
    for line in lines:
        found = _LABEL.match(line)
        if found is None:
            continue
        name, text = found[1].strip(), Text(line, found.end())
        if name == "time":
            t = text.time(14)
            _same_or_new_state(states, t)
            id = None
        elif name == id_label:
            id = text.id()
        elif states.times and id is not None:
            states.put(AsciiKey(name, id), text.certain(14, f"no number for '{name}'"))


@ascii_kind("deforc", lambda line: line.startswith(" spring/damper number."))
def _deforc(lines: Lines, states: AsciiStates) -> None:
    _labelled(lines, states, "spring/damper number")


@ascii_kind("jntforc", lambda line: line.startswith(" joint ID."))
def _jntforc(lines: Lines, states: AsciiStates) -> None:
    _labelled(lines, states, "joint ID")


_OF_TRACER = ("x", "y", "z", "vx", "vy", "vz", "sx", "sy", "sz", "sxy", "syz", "szx", "efp", "rho", "rvol", "active")


@ascii_kind("trhist", lambda line: line.split() == ["efp", "rho", "rvol", "active"])
def _trhist(lines: Lines, states: AsciiStates) -> None:
    """The file has no ids: tracers count from 1 on."""
    head, row, tracer = True, 0, 0
    for line in lines:
        if head or not line.strip():
            head = head and line.split() != ["efp", "rho", "rvol", "active"]
            continue
        values = Text(line).numbers(13)
        if len(values) == 1 and row == 0:
            states.begin(Text(line).time(13))
            tracer = 1
            continue
        if len(values) != 4 or tracer == 0:
            raise AsciiFault("a tracer has rows of four numbers")
        for name, value in zip(_OF_TRACER[4 * row : 4 * row + 4], values, strict=True):
            states.put(AsciiKey(name, tracer), value)
        row, tracer = (row + 1) % 4, tracer + (row == 3)
    if row:
        raise AsciiFault("the file is cut off: its last tracer lacks rows")


_OF_WELD = ("axial", "shear", "failure", "length", "moment", "torsion")


@ascii_kind("swforc", lambda line: "spotweld forces (t=" in line)
def _swforc(lines: Lines, states: AsciiStates) -> None:
    for line in lines:
        if "spotweld forces (t=" in line:
            states.begin(Text(line).behind("t=").time(14))
        elif states.times and "weld id" not in line and line.strip():
            text = Text(line)
            id = text.id()
            if id is None:
                continue
            words = text.rest.split(None, 1)
            values = Text(words[1] if len(words) > 1 else "").numbers(14)
            if len(values) < len(_OF_WELD):
                raise AsciiFault(f"the row has {len(values)} numbers where {len(_OF_WELD)} belong")
            for name, value in zip(_OF_WELD, values, strict=False):
                states.put(AsciiKey(name, id), value)
