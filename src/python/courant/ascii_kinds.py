"""One reader for each kind of ASCII history. Layouts: those that LS-DYNA R16 prints and those of LSTC's converter from binout."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
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


class AsciiReader:
    """Takes the lines of a file one by one."""

    def line(self, text: str, states: AsciiStates) -> None:
        """Lines that are no data are passed over. Raises AsciiFault."""
        raise NotImplementedError

    def end(self) -> None:
        """After the last line. Raises AsciiFault where something was begun that has no end."""


class AsciiKind(NamedTuple):
    """`told_by`: whether a file of this kind may have a line, and no other."""

    name: str
    told_by: Callable[[str], bool]
    make: type[AsciiReader]


ASCII_KINDS: dict[str, AsciiKind] = {}


def ascii_kind(name: str, told_by: Callable[[str], bool]) -> Callable[[type[AsciiReader]], type[AsciiReader]]:
    """Registers the reader of a kind of file."""

    def register(reader: type[AsciiReader]) -> type[AsciiReader]:
        ASCII_KINDS[name] = AsciiKind(name, told_by, reader)
        return reader

    return register


def take_number(text: str, at: int, width: int) -> tuple[float, int] | None:
    """A number behind blanks at a place, and where it ends; None where there is none.

    `width`: of the field, for stars: a run of them may be several fields.
    """
    found = _NUMBER.match(text, at)
    if found is None:
        return None
    stars, word, mantissa, letter, sign = found.groups()
    if mantissa:
        exponent = letter or sign
        return float(f"{mantissa}e{exponent}" if exponent else mantissa), found.end()
    if word:
        return float(word), found.end()
    return math.nan, found.start(1) + (width if len(stars) % width == 0 else len(stars))


def take_numbers(text: str, at: int, width: int) -> tuple[list[float], int]:
    """All numbers up to the first word that is none, and where that begins."""
    out = []
    while found := take_number(text, at, width):
        out.append(found[0])
        at = found[1]
    return out, at


def take_id(text: str, at: int) -> tuple[int, int] | None:
    """A whole number behind blanks that ends with the text, a blank or a sign. Raises AsciiFault for stars."""
    if _STARS.match(text, at):
        raise AsciiFault("an id did not fit into its column: the file has stars in its place")
    found = _ID.match(text, at)
    if found is None or len(found[1]) > 18:
        return None
    return int(found[1]), found.end()


def _behind(text: str, word: str) -> int:
    at = text.find(word)
    if at < 0:
        raise AsciiFault(f"'{word}' is missing")
    return at + len(word)


def _number_behind(text: str, word: str, width: int, what: str) -> float:
    found = take_number(text, _behind(text, word), width)
    if found is None:
        raise AsciiFault(f"no number for the {what}")
    return found[0]


def _time_behind(text: str, word: str, width: int) -> float:
    """A time must be a number: states could not be told apart."""
    t = _number_behind(text, word, width, "time")
    if not math.isfinite(t):
        raise AsciiFault("the time is no finite number")
    return t


def _id_behind(text: str, word: str) -> tuple[int, int]:
    found = take_id(text, _behind(text, word))
    if found is None:
        raise AsciiFault(f"no id behind '{word.strip()}'")
    return found


def _put_pairs(text: str, id: int | None, side: str, states: AsciiStates) -> None:
    """`name=number name=number ...` of one entity."""
    at = 0
    while (equal := text.find("=", at)) >= 0:
        name = text[at:equal].strip(" \t")
        found = take_number(text, equal + 1, 13)
        if found is None:
            raise AsciiFault(f"no number behind '{name}='")
        value, at = found
        if name != "setid":
            states.put(AsciiKey(name, id, side), value)


def _put_row(text: str, at: int, names: tuple[str, ...], width: int, key: AsciiKey, states: AsciiStates) -> None:
    """Exactly named numbers of one row; more may follow."""
    values, _ = take_numbers(text, at, width)
    if len(values) < len(names):
        raise AsciiFault(f"the row has {len(values)} numbers where {len(names)} belong")
    for name, value in zip(names, values, strict=False):
        states.put(AsciiKey(key.name + name, key.id, key.side), value)


@ascii_kind("glstat", lambda line: line.startswith(" dt of cycle"))
class _Glstat(AsciiReader):
    cycle = math.nan
    awaits_time = True

    def line(self, text: str, states: AsciiStates) -> None:
        if text.startswith(" dt of cycle"):
            if self.awaits_time and states.times:
                raise AsciiFault("the state before has no time")
            self.cycle = _number_behind(text, "dt of cycle", 8, "cycle")
            self.awaits_time = True
            return
        end = 32  # one blank, a label filled with dots to 31 characters
        if len(text) <= end or text[0] != " " or text[end - 1] != ".":
            return
        name = text[1:end].rstrip(". ")
        found = take_number(text, end, 14)
        if found is None:
            raise AsciiFault(f"no number for '{name}'")
        if name == "time":
            if not math.isfinite(found[0]):
                raise AsciiFault("the time is no finite number")
            states.begin(found[0])
            states.put(AsciiKey("cycle"), self.cycle)
            self.awaits_time = False
            return
        if self.awaits_time:
            raise AsciiFault(f"'{name}' stands before the time of its state")
        wall = _id_behind(text[end:], "wall#")[0] if "wall#" in text[end:] else None
        states.put(AsciiKey(name, wall), found[0])

    def end(self) -> None:
        if self.awaits_time:
            raise AsciiFault("the file is cut off: its last state has no time")


@ascii_kind("matsum", lambda line: line.startswith(" mat.#="))
class _Matsum(AsciiReader):
    part: int | None = None

    def line(self, text: str, states: AsciiStates) -> None:
        if text.startswith(" time ="):
            self.part = None
            states.begin(_time_behind(text, "time =", 13))
        elif text.startswith(" mat.#="):
            self.part, at = _id_behind(text, "mat.#=")
            _put_pairs(text[at:], self.part, "", states)
        elif self.part is not None and "=" in text and " " not in text.split("=", 1)[0].strip(" \t"):
            # notes on added mass have several words before their =
            _put_pairs(text, self.part, "", states)


_SIDES = {"SURFA": "SURFA", "slave": "SURFA", "SURFB": "SURFB", "master": "SURFB"}


def _is_force_on_side(line: str) -> bool:
    row = line.strip(" \t")
    return row.startswith(tuple(f"{side} " for side in _SIDES)) and " time" in row and " x " in row


@ascii_kind("rcforc", _is_force_on_side)
class _Rcforc(AsciiReader):
    component = re.compile(r"[ \t]*([^ +\-*0-9]*)")

    def line(self, text: str, states: AsciiStates) -> None:
        row = text.strip(" \t")
        word = row.split(" ", 1)[0]
        side = _SIDES.get(word)
        owner = take_id(row, len(word)) if side else None
        if side is None or owner is None:  # a legend may have such a title
            return
        id, at = owner
        row = row[at:]
        if "time" not in row:
            raise AsciiFault("no time on this line")
        t = _time_behind(row, "time", 12)
        at = _behind(row, "time")
        at = (take_number(row, at, 12) or (t, at))[1]
        if not states.times or states.times[-1] != t or states.holds(AsciiKey("x", id, side)):
            states.begin(t)
        count = 0
        while row[at:].strip(" \t"):
            name = self.component.match(row, at)
            assert name is not None  # it may be empty
            found = take_number(row, name.end(), 12)
            if found is None:
                raise AsciiFault(f"no number behind '{name[1]}'")
            states.put(AsciiKey(name[1], id, side), found[0])
            at = found[1]
            count += 1
        if count < 3:
            raise AsciiFault("a force has three components")


@ascii_kind("sleout", lambda line: "contact interface energy file" in line)
class _Sleout(AsciiReader):
    rows = sums = False

    def line(self, text: str, states: AsciiStates) -> None:
        if "contact interface energy file" in text:
            self.rows = self.sums = False
            return states.begin(_time_behind(text, "time=", 14))
        if not states.times:
            return None
        if "cycle=" in text:
            self.rows = True
            return states.put(AsciiKey("cycle"), _number_behind(text, "cycle=", 14, "cycle"))
        if text.strip(" \t").startswith("summary"):
            self.rows, self.sums = False, True
        if self.sums and "=" in text:
            name = text.split("=", 1)[0].strip(" \t").removeprefix("summary").strip(" \t")
            name = "friction energy" if name == "total friction" else name
            return states.put(AsciiKey(name), _number_behind(text, "=", 14, name))
        found = take_id(text, 0) if self.rows and text.strip(" \t") else None
        if found is None:
            return None
        values, _ = take_numbers(text, found[1], 13)
        if len(values) < 2:
            raise AsciiFault("an interface needs the energies of two sides")
        for name, value in zip(("surfa", "surfb"), values, strict=False):
            states.put(AsciiKey(name, found[0]), value)
        if len(values) > 2:
            states.put(AsciiKey("frictional", found[0]), values[-1])
        return None


def _axes(*quantities: str) -> tuple[str, ...]:
    return tuple(f"{axis}-{quantity}" for quantity in quantities for axis in "xyz")


@ascii_kind("nodout", lambda line: "n o d a l   p r i n t   o u t" in line)
class _Nodout(AsciiReader):
    motion, rotation = _axes("disp", "vel", "accl", "coor"), _axes("rot", "rot vel", "rot acc")
    table: tuple[str, ...] = ()
    t = cycle = 0.0
    awaits_table = False

    def line(self, text: str, states: AsciiStates) -> None:
        if "n o d a l   p r i n t" in text:
            self.table = ()
            self.t = _time_behind(text, "at time", 14)
            self.cycle = _number_behind(text, "s t e p", 8, "cycle")
            self.awaits_table = True
        elif "nodal point" in text:
            self.awaits_table = False
            self.table = self.rotation if "x-rot" in text else self.motion
            if self.table is self.rotation and states.times and states.times[-1] == self.t:
                return
            states.begin(self.t)
            states.put(AsciiKey("cycle"), self.cycle)
        elif self.table and text.strip(" \t"):
            found = take_id(text, 0)
            if found is None:
                self.table = ()  # whatever follows is no table any more
            else:
                _put_row(text, found[1], self.table, 12, AsciiKey("", found[0]), states)

    def end(self) -> None:
        if self.awaits_table:
            raise AsciiFault("the file is cut off: its last state has no table")


@ascii_kind("rbdout", lambda line: "r i g i d   b o d y   m o t i o n" in line)
class _Rbdout(AsciiReader):
    body: int | None = None
    local = False
    quantity = re.compile(r"[ \t]*(coordinates|displacements|velocities|accelerations):")

    def line(self, text: str, states: AsciiStates) -> None:
        if "r i g i d   b o d y   m o t i o n" in text:
            self.body = None
            states.begin(_time_behind(text, "time=", 15))
            return states.put(AsciiKey("cycle"), _number_behind(text, "cycle=", 8, "cycle"))
        if "rigid body" in text and ":" not in text:
            self.body, self.local = _id_behind(text, "rigid body")[0], False
            return None
        if self.body is None:
            return None
        if "output in principal" in text:
            self.local = True
        if found := self.quantity.match(text):
            name, axes = found[1], "abc" if self.local else "xyz"
            names = tuple(axes)
            if self.local or name != "coordinates":
                names += tuple(f"{axis}-rot" for axis in axes)
            key = AsciiKey(f"{'local ' if self.local else ''}{name} ", self.body)
            return _put_row(text, found.end(), names, 12, key, states)
        row = text.strip(" \t")
        if row.startswith("row"):
            k, at = _id_behind(row, "row")
            _put_row(row, at, ("a", "b", "c"), 15, AsciiKey(f"row {k} ", self.body), states)
        return None


@ascii_kind("bndout", lambda line: "n o d a l   f o r c e/e n e r g y" in line)
class _Bndout(AsciiReader):
    section = side = ""
    id: int | None = None

    def line(self, text: str, states: AsciiStates) -> None:
        if "n o d a l   f o r c e/e n e r g y" in text:
            self.section = "nodal"
            return states.begin(_time_behind(text[max(text.rfind("t="), 0) :], "t=", 9))
        row = text.strip(" \t")
        if "=" not in row:
            if "forces" in row:
                self.section = row.split(" ", 1)[0]  # "velocity boundary ..."
            return None
        if not states.times:
            return None
        for word in ("nd#", "mat#"):
            if row.startswith(word):
                self.id, at = _id_behind(row, "#")
                self.side = f"{self.section} {word}"
                return _put_pairs(row[at:], self.id, self.side, states)
        if row.startswith("xmoment"):
            return _put_pairs(row, self.id, self.side, states)
        if row.startswith("xtotal"):
            return _put_pairs(row, None, self.section, states)
        return None


@ascii_kind("spcforc", lambda line: "output at time =" in line)
class _Spcforc(AsciiReader):
    def line(self, text: str, states: AsciiStates) -> None:
        if "output at time =" in text:
            return states.begin(_time_behind(text, "output at time =", 14))
        if not states.times:
            return None
        if "resultants" in text:
            name = text.split("=", 1)[0].strip(" \t")
            return _put_row(text, _behind(text, "="), ("x", "y", "z"), 14, AsciiKey(name + " "), states)
        if "node=" not in text:
            return None
        side = f"setid {_id_behind(text, 'setid=')[0]}" if "setid=" in text else ""
        key = AsciiKey("moments " if "moments" in text else "forces ", _id_behind(text, "node=")[0], side)
        rest = text[_behind(text, "node=") :]
        if "=" not in rest:
            raise AsciiFault("no forces on this line")
        return _put_row(rest, _behind(rest, "="), ("x", "y", "z"), 14, key, states)


@ascii_kind("rwforc", lambda line: "wall#" in line and "normal-force" in line)
class _Rwforc(AsciiReader):
    rows, first, time = False, True, 0.0

    def line(self, text: str, states: AsciiStates) -> None:
        if "normal-force" in text:
            self.rows = self.first = True
            return
        if not self.rows or not text.strip(" \t"):
            return
        found = take_number(text, 0, 12)
        if found is None or not math.isfinite(found[0]):
            raise AsciiFault("no time at the begin of a row")
        wall = take_id(text, found[1])
        if wall is None:
            raise AsciiFault("no wall behind the time")
        if self.first or found[0] != self.time:
            states.begin(found[0])
        self.first, self.time = False, found[0]
        _put_row(text, wall[1], ("normal", "x", "y", "z"), 15, AsciiKey("", wall[0]), states)


@ascii_kind("sphout", lambda line: "S P H   o u t p u t" in line)
class _Sphout(AsciiReader):
    names: tuple[str, ...] = ()

    def line(self, text: str, states: AsciiStates) -> None:
        if "S P H   o u t p u t" in text:
            self.names = ()
            states.begin(_time_behind(text, "at time", 11))
            if "step" in text:
                states.put(AsciiKey("cycle"), _number_behind(text, "step", 10, "cycle"))
            return
        row = text.strip(" \t")
        if row.startswith("particle"):
            words = tuple(row.split())
            if len(words) < 3 or words[1] != "mat":
                raise AsciiFault("a head of columns that is not known")
            self.names = words[2:]
            return
        particle = take_id(row, 0) if self.names and row else None
        if particle is None:
            self.names = self.names if not row else ()
            return
        part = take_id(row, particle[1])
        if part is None:
            raise AsciiFault("no part behind the particle's id")
        values, at = take_numbers(row, part[1], 12)
        word = bool(row[at:].strip(" \t"))  # the state, "elastic"
        if len(values) + word < len(self.names):
            raise AsciiFault("the row has fewer columns than its head")
        for name, value in zip(self.names, values, strict=False):
            states.put(AsciiKey(name, particle[0]), value)
