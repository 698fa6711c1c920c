"""The cards of keywords as the program knows them: `courant keywords --markdown`."""
from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass, field
from functools import lru_cache

from ..program import executable

_ROW = re.compile(r"\| (\S+) \| (\d+)-(\d+) \| ([AIF])([^|]*)\| ([^|]*) \|")
_OPTION = re.compile(r"Option _([A-Z]+):")


@dataclass(frozen=True)
class FieldOf:
    name: str
    begin: int  # columns from 0
    end: int
    kind: str  # A, I or F
    listed: bool  # many values in these columns


@dataclass
class CardOf:
    fields: list[FieldOf] = field(default_factory=list)
    optional: bool = False
    conditional: bool = False  # there where fields of other cards ask for it
    repeated: bool = False


@dataclass
class TableOf:
    names: list[str]
    cards: list[CardOf] = field(default_factory=list)
    options: list[str] = field(default_factory=list)  # TITLE, ID: a line that comes first
    heading: bool = False  # before each set of cards


@lru_cache(maxsize=None)
def tables() -> dict[str, TableOf]:
    """Of all keywords by name. Empty where the program is not there."""
    program = executable()
    if not program:
        return {}
    said = subprocess.run([program, "keywords", "--markdown"], capture_output=True, text=True, errors="replace")
    return parse(said.stdout) if said.returncode == 0 else {}


def parse(text: str) -> dict[str, TableOf]:
    out: dict[str, TableOf] = {}
    table: TableOf | None = None
    for line in text.splitlines():
        if line.startswith("## *"):
            table = TableOf([line[4:].strip()])
        elif table is None:
            continue
        elif line.startswith("Also: "):
            table.names += re.findall(r"`\*([^`]+)`", line.partition("`. ")[0] + "`")
        elif line.startswith("Option _") or "a heading line" in line:
            table.options += _OPTION.findall(line)
            table.heading |= line.startswith("Each set begins with a heading line")
        elif match := re.fullmatch(r"Card \d+(.*)", line):
            how = match[1]
            table.cards.append(CardOf(optional="optional" in how, conditional="only where" in how, repeated="repeated" in how))
        elif (match := _ROW.match(line)) and table.cards:
            name = match[1].replace("\\", "")
            table.cards[-1].fields.append(FieldOf(name, int(match[2]) - 1, int(match[3]), match[4], "list" in match[5] or "column" in match[5]))
        if table is not None:
            out |= {name: table for name in table.names if name not in out}
    return out


def without_options(keyword: str) -> tuple[str, list[str]]:
    """A keyword as a deck has it, without *, less the options of its name that its cards do not depend on, and these."""
    known = tables()
    name, options = keyword.upper(), list[str]()
    while name not in known:
        base, _, last = name.rpartition("_")
        if last not in ("TITLE", "ID", "MPP", "COLLECT") or not base:
            base = keyword.upper().removesuffix("_TITLE")  # of a keyword that the program does not know
            return base, ["TITLE"] if base != keyword.upper() else []
        options.insert(0, last)
        name = base
    return name, options


def table_of(keyword: str) -> tuple[TableOf | None, list[str]]:
    """Of a keyword as a deck has it, without *, and the options in its name that put a line first."""
    name, options = without_options(keyword)
    table = tables().get(name)
    return table, [option for option in options if option in ("TITLE", "ID", "MPP")] if table else []


def same_keyword(name: str) -> set[str]:
    """All names that mean the same as this one, without options: of materials and equations of state number and name, of others spellings. One table of
    cards serves several keywords (*LOAD_BODY_X and _Y, most *CONTACT_), which are not the same."""
    name, _ = without_options(name)
    table = tables().get(name)
    return {other for other in (table.names if table else ()) if _same(name, other, table)} | {name}


def _same(one: str, other: str, table: TableOf | None) -> bool:
    if table and one.startswith(("MAT_", "EOS_")):
        return _addition(one, table) == _addition(other, table)
    a, b = _words(one), _words(other)
    return "".join(a) == "".join(b) or sorted(a) == sorted(b)


def _addition(name: str, table: TableOf) -> str:
    """What a name has more than another one of the table: SPALL."""
    return max((name[len(other) + 1 :] for other in table.names if name.startswith(other + "_")), key=len, default="")


_SPELLED = {"TRANSFORM": "TRANSFORMATION", "NODES": "NODE"}


def _words(name: str) -> list[str]:
    words = [_SPELLED.get(word, word) for word in re.split("[_/-]", name)]
    return [word for word in words if word != "LIST" or words[0] != "SET"]
