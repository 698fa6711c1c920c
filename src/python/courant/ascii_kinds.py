"""One reader for each kind of ASCII history. Layouts: those that LS-DYNA R16 prints and those of LSTC's converter from binout."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

_NUMBER = re.compile(
    r"[ \t]*(?:(\*+)"  # stars: the number did not fit
    r"|([+-]?(?:nan|infinity|inf))"
    r"|([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))"
    # E+05, D-100, and +100 without a letter, as Fortran prints three digits into a field for two
    r"(?:[eEdD]([+-]?[0-9]+)|([+-][0-9]{3})(?![0-9.]))?)",
    re.IGNORECASE,
)
_ID = re.compile(r"[ \t]*([0-9]+)(?=[ \t+\-*,]|$)")
_STARS = re.compile(r"[ \t]*\*")


class AsciiFault(Exception):
    """A line that is not what it should be."""


class AsciiKey(NamedTuple):
    """What a series belongs to. `name` as in the file: "kinetic energy", "x-mom"; `id` of part, node, interface or wall, None:
    of the whole; `side`, of rcforc: SURFA, SURFB; of bndout: "velocity nd#"; of spcforc: "setid 3"."""

    name: str
    id: int | None = None
    side: str = ""


def column_name(key: AsciiKey) -> str:
    """ "kinetic energy" of nothing -> kinetic_energy, "x" of 4 SURFA -> x_4_SURFA."""
    words = f"{key.name} {'' if key.id is None else key.id} {key.side}"
    return re.sub("[^A-Za-z0-9]+", "_", words).strip("_")


class AsciiStates:
    """The states of a file as they are read. `sizes`: numbers that each state holds; `dropped`: states that later ones replaced."""

    def __init__(self) -> None:
        self.times: list[float] = []
        self.sizes: list[int] = []
        self.dropped = 0
        self._columns: dict[AsciiKey, list[float]] = {}

    def begin(self, t: float) -> None:
        """A new state. States of later times that were read before are dropped: the run was restarted."""
        if self.times and self.times[-1] > t:
            while self.times and self.times[-1] > t:
                self.times.pop()
                self.sizes.pop()
                self.dropped += 1
            for values in self._columns.values():
                del values[len(self.times) :]
        self.times.append(t)
        self.sizes.append(0)

    def holds(self, key: AsciiKey) -> bool:
        """Whether a value is in the present state."""
        return len(self._columns.get(key, ())) == len(self.times)

    def put(self, key: AsciiKey, value: float) -> None:
        """Into the present state. Raises AsciiFault where there is none, or the value is there already."""
        n = len(self.times)
        if n == 0:
            raise AsciiFault("values stand before the first time")
        values = self._columns.setdefault(key, [])
        missing = n - 1 - len(values)
        if missing:
            if missing < 0:
                whose = "" if key.id is None else f" of {key.id}"
                raise AsciiFault(f"'{key.name}'{whose} stands twice in one state")
            values.extend([math.nan] * missing)
        values.append(value)
        self.sizes[-1] += 1

    def whole_columns(self) -> dict[AsciiKey, list[float]]:
        """All series, one value per time each."""
        n = len(self.times)
        return {key: values + [math.nan] * (n - len(values)) for key, values in self._columns.items()}


Lines = Iterator[str]
Reader = Callable[[Lines, AsciiStates], None]


class AsciiKind(NamedTuple):
    """`told_by`: whether a file of this kind may have a line, and no other; `read`: takes all lines and passes over those that are no data.
    Raises AsciiFault, also behind the last line where something was begun that has no end."""

    name: str
    told_by: Callable[[str], bool]
    read: Reader


ASCII_KINDS: dict[str, AsciiKind] = {}


def ascii_kind(name: str, told_by: Callable[[str], bool]) -> Callable[[Reader], Reader]:
    """Registers the reader of a kind of file."""

    def register(reader: Reader) -> Reader:
        ASCII_KINDS[name] = AsciiKind(name, told_by, reader)
        return reader

    return register


class Text:
    """A line that is read from left to right."""

    def __init__(self, text: str, at: int = 0) -> None:
        self.text, self.at = text, at

    def behind(self, word: str) -> Text:
        """What is behind a word. Raises AsciiFault where it is not there."""
        at = self.text.find(word, self.at)
        if at < 0:
            raise AsciiFault(f"'{word}' is missing")
        return Text(self.text, at + len(word))

    @property
    def rest(self) -> str:
        return self.text[self.at :].strip(" \t")

    def number(self, width: int) -> float | None:
        """The number behind blanks, None where there is none. `width`: of the field, for stars: a run of them may be several fields."""
        found = _NUMBER.match(self.text, self.at)
        if found is None:
            return None
        stars, word, mantissa, letter, sign = found.groups()
        self.at = found.end()
        if stars:
            self.at = found.start(1) + (width if len(stars) % width == 0 else len(stars))
            return math.nan
        exponent = letter or sign
        return float(word or (f"{mantissa}e{exponent}" if exponent else mantissa))

    def numbers(self, width: int) -> list[float]:
        """All numbers up to the first word that is none."""
        out = []
        while (value := self.number(width)) is not None:
            out.append(value)
        return out

    def certain(self, width: int, fault: str) -> float:
        """The number here. Raises AsciiFault with these words where there is none."""
        value = self.number(width)
        if value is None:
            raise AsciiFault(fault)
        return value

    def time(self, width: int, fault: str = "no number for the time") -> float:
        """A time must be a number: else one state could be taken for another."""
        t = self.certain(width, fault)
        if not math.isfinite(t):
            raise AsciiFault("the time is no finite number")
        return t

    def id(self) -> int | None:
        """A whole number behind blanks that ends with the text, a blank or a sign. Raises AsciiFault for stars."""
        if _STARS.match(self.text, self.at):
            raise AsciiFault("an id did not fit into its column: the file has stars in its place")
        found = _ID.match(self.text, self.at)
        if found is None or len(found[1]) > 18:
            return None
        self.at = found.end()
        return int(found[1])

    def id_behind(self, word: str) -> tuple[int, Text]:
        """The id behind a word, and what follows."""
        text = self.behind(word)
        id = text.id()
        if id is None:
            raise AsciiFault(f"no id behind '{word.strip()}'")
        return id, text


def _put_pairs(text: Text, id: int | None, side: str, states: AsciiStates) -> None:
    """`name=number name=number ...` of one entity."""
    while "=" in text.rest:
        name = text.text[text.at : text.text.index("=", text.at)].strip(" \t")
        text = text.behind("=")
        value = text.certain(13, f"no number behind '{name}='")
        if name != "setid":
            states.put(AsciiKey(name, id, side), value)


def _put_row(text: Text, names: Sequence[str], width: int, key: AsciiKey, states: AsciiStates) -> None:
    """Exactly named numbers of one row; more may follow."""
    values = text.numbers(width)
    if len(values) < len(names):
        raise AsciiFault(f"the row has {len(values)} numbers where {len(names)} belong")
    for name, value in zip(names, values, strict=False):
        states.put(AsciiKey(key.name + name, key.id, key.side), value)


@ascii_kind("glstat", lambda line: line.startswith(" dt of cycle"))
def _glstat(lines: Lines, states: AsciiStates) -> None:
    cycle, timed, end = math.nan, False, 32  # a label is one blank, then filled with dots to 31 characters
    for line in lines:
        if line.startswith(" dt of cycle"):
            if not timed and states.times:
                raise AsciiFault("the state before has no time")
            cycle, timed = Text(line).behind("dt of cycle").certain(8, "no number for the cycle"), False
        elif len(line) > end and line[0] == " " and line[end - 1] == ".":
            name, text = line[1:end].rstrip(". "), Text(line, end)
            if name == "time":
                states.begin(text.time(14, "no number for 'time'"))
                states.put(AsciiKey("cycle"), cycle)
                timed = True
                continue
            value = text.certain(14, f"no number for '{name}'")
            if not timed:
                raise AsciiFault(f"'{name}' stands before the time of its state")
            states.put(AsciiKey(name, text.id_behind("wall#")[0] if "wall#" in line else None), value)
    if not timed:
        raise AsciiFault("the file is cut off: its last state has no time")


@ascii_kind("matsum", lambda line: line.startswith(" mat.#="))
def _matsum(lines: Lines, states: AsciiStates) -> None:
    part: int | None = None
    for line in lines:
        if line.startswith(" time ="):
            part = None
            states.begin(Text(line).behind("time =").time(13))
        elif line.startswith(" mat.#="):
            part, text = Text(line).id_behind("mat.#=")
            _put_pairs(text, part, "", states)
        elif part is not None and "=" in line and " " not in line.split("=", 1)[0].strip(" \t"):
            _put_pairs(Text(line), part, "", states)  # notes on added mass have several words before their =


_SIDES = {"SURFA": "SURFA", "slave": "SURFA", "SURFB": "SURFB", "master": "SURFB"}
_COMPONENT = re.compile(r"[^ +\-*0-9]*")


@ascii_kind("rcforc", lambda line: line.strip(" \t").startswith(tuple(f"{side} " for side in _SIDES)) and " time" in line and " x " in line)
def _rcforc(lines: Lines, states: AsciiStates) -> None:
    for line in lines:
        row = line.strip(" \t")
        side, text = _SIDES.get(row.split(" ", 1)[0]), Text(row, len(row.split(" ", 1)[0]))
        id = text.id() if side else None
        if side is None or id is None:  # a legend may have such a title
            continue
        if "time" not in text.rest:
            raise AsciiFault("no time on this line")
        text = text.behind("time")
        t = text.time(12)
        if not states.times or states.times[-1] != t or states.holds(AsciiKey("x", id, side)):
            states.begin(t)
        count = 0
        while rest := text.rest:
            name = _COMPONENT.match(rest)[0]  # type: ignore[index]  # it may be empty
            text = text.behind(name)
            states.put(AsciiKey(name, id, side), text.certain(12, f"no number behind '{name}'"))
            count += 1
        if count < 3:
            raise AsciiFault("a force has three components")


@ascii_kind("sleout", lambda line: "contact interface energy file" in line)
def _sleout(lines: Lines, states: AsciiStates) -> None:
    rows = sums = False
    for line in lines:
        row = line.strip(" \t")
        if "contact interface energy file" in line:
            rows = sums = False
            states.begin(Text(line).behind("time=").time(14))
        elif not states.times:
            continue
        elif "cycle=" in line:
            rows = True
            states.put(AsciiKey("cycle"), Text(line).behind("cycle=").certain(14, "no number for the cycle"))
        elif row.startswith("summary") or (sums and "=" in line):
            rows, sums = False, True
            name = line.split("=", 1)[0].strip(" \t").removeprefix("summary").strip(" \t")
            name = "friction energy" if name == "total friction" else name
            if "=" in line:
                states.put(AsciiKey(name), Text(line).behind("=").certain(14, f"no number for the {name}"))
        elif rows and (id := (text := Text(row)).id()) is not None:
            values = text.numbers(13)
            if len(values) < 2:
                raise AsciiFault("an interface needs the energies of two sides")
            pairs = [("surfa", values[0]), ("surfb", values[1]), *([("frictional", values[-1])] if len(values) > 2 else [])]
            for name, value in pairs:
                states.put(AsciiKey(name, id), value)


def _axes(*quantities: str) -> tuple[str, ...]:
    return tuple(f"{axis}-{quantity}" for quantity in quantities for axis in "xyz")


_MOTION, _ROTATION = _axes("disp", "vel", "accl", "coor"), _axes("rot", "rot vel", "rot acc")


@ascii_kind("nodout", lambda line: "n o d a l   p r i n t   o u t" in line)
def _nodout(lines: Lines, states: AsciiStates) -> None:
    table: tuple[str, ...] = ()
    t, cycle, awaits_table = 0.0, 0.0, False
    for line in lines:
        if "n o d a l   p r i n t" in line:
            t = Text(line).behind("at time").time(14)
            table, cycle, awaits_table = (), Text(line).behind("s t e p").certain(8, "no number for the cycle"), True
        elif "nodal point" in line:
            awaits_table, table = False, _ROTATION if "x-rot" in line else _MOTION
            if table is _MOTION or not states.times or states.times[-1] != t:
                states.begin(t)
                states.put(AsciiKey("cycle"), cycle)
        elif table and line.strip(" \t"):
            text = Text(line)
            id = text.id()
            if id is None:
                table = ()  # whatever follows is no table any more
            else:
                _put_row(text, table, 12, AsciiKey("", id), states)
    if awaits_table:
        raise AsciiFault("the file is cut off: its last state has no table")


_OF_BODIES = re.compile(r"[ \t]*(coordinates|displacements|velocities|accelerations):")


@ascii_kind("rbdout", lambda line: "r i g i d   b o d y   m o t i o n" in line)
def _rbdout(lines: Lines, states: AsciiStates) -> None:
    body: int | None = None
    local = False
    for line in lines:
        if "r i g i d   b o d y   m o t i o n" in line:
            body = None
            states.begin(Text(line).behind("time=").time(15))
            states.put(AsciiKey("cycle"), Text(line).behind("cycle=").certain(8, "no number for the cycle"))
        elif "rigid body" in line and ":" not in line:
            body, local = Text(line).id_behind("rigid body")[0], False
        elif body is None:
            continue
        elif found := _OF_BODIES.match(line):
            axes = list("abc" if local else "xyz")
            names = axes if found[1] == "coordinates" and not local else [*axes, *(f"{axis}-rot" for axis in axes)]
            _put_row(Text(line, found.end()), names, 12, AsciiKey(f"{'local ' if local else ''}{found[1]} ", body), states)
        elif line.strip(" \t").startswith("row"):
            k, text = Text(line).id_behind("row")
            _put_row(text, "abc", 15, AsciiKey(f"row {k} ", body), states)
        local = local or "output in principal" in line


@ascii_kind("bndout", lambda line: "n o d a l   f o r c e/e n e r g y" in line)
def _bndout(lines: Lines, states: AsciiStates) -> None:
    section, side, id = "", "", None
    for line in lines:
        row = line.strip(" \t")
        if "n o d a l   f o r c e/e n e r g y" in line:
            section = "nodal"
            states.begin(Text(line, max(line.rfind("t="), 0)).behind("t=").time(9))
        elif "=" not in row:
            section = row.split(" ", 1)[0] if "forces" in row else section  # "velocity boundary ..."
        elif states.times and (word := row.split("#", 1)[0] + "#") in ("nd#", "mat#"):
            id, text = Text(row).id_behind("#")
            side = f"{section} {word}"
            _put_pairs(text, id, side, states)
        elif states.times and row.startswith("xmoment"):
            _put_pairs(Text(row), id, side, states)
        elif states.times and row.startswith("xtotal"):
            _put_pairs(Text(row), None, section, states)


@ascii_kind("spcforc", lambda line: "output at time =" in line)
def _spcforc(lines: Lines, states: AsciiStates) -> None:
    for line in lines:
        if "output at time =" in line:
            states.begin(Text(line).behind("output at time =").time(14))
        elif states.times and "resultants" in line:
            _put_row(Text(line).behind("="), "xyz", 14, AsciiKey(line.split("=", 1)[0].strip(" \t") + " "), states)
        elif states.times and "node=" in line:
            id, text = Text(line).id_behind("node=")
            side = f"setid {Text(line).id_behind('setid=')[0]}" if "setid=" in line else ""
            if "=" not in text.rest:
                raise AsciiFault("no forces on this line")
            _put_row(text.behind("="), "xyz", 14, AsciiKey("moments " if "moments" in line else "forces ", id, side), states)


@ascii_kind("rwforc", lambda line: "wall#" in line and "normal-force" in line)
def _rwforc(lines: Lines, states: AsciiStates) -> None:
    rows, time = False, math.nan
    for line in lines:
        if "normal-force" in line:
            rows, time = True, math.nan  # a head begins a state
        elif rows and line.strip(" \t"):
            text = Text(line)
            t, wall = text.number(12), text.id()
            if t is None or not math.isfinite(t):
                raise AsciiFault("no time at the begin of a row")
            if wall is None:
                raise AsciiFault("no wall behind the time")
            if t != time:
                states.begin(t)
            time = t
            _put_row(text, ("normal", "x", "y", "z"), 15, AsciiKey("", wall), states)


@ascii_kind("sphout", lambda line: "S P H   o u t p u t" in line)
def _sphout(lines: Lines, states: AsciiStates) -> None:
    names: list[str] = []
    for line in lines:
        row = line.strip(" \t")
        text = Text(row)
        if "S P H   o u t p u t" in line:
            names = []
            states.begin(text.behind("at time").time(11))
            if "step" in row:
                states.put(AsciiKey("cycle"), text.behind("step").certain(10, "no number for the cycle"))
        elif row.startswith("particle"):
            names = row.split()[2:]
            if not names or row.split()[1] != "mat":
                raise AsciiFault("a head of columns that is not known")
        elif names and row:
            id = text.id()
            if id is None:
                names = []
                continue
            if text.id() is None:
                raise AsciiFault("no part behind the particle's id")
            values = text.numbers(12)
            if len(values) + bool(text.rest) < len(names):  # the last one may be a word, "elastic"
                raise AsciiFault("the row has fewer columns than its head")
            for name, value in zip(names, values, strict=False):
                states.put(AsciiKey(name, id), value)
