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


def table_of(keyword: str) -> tuple[TableOf | None, list[str]]:
    """Of a keyword as a deck has it, without *, and the options in its name that put a line first."""
    known = tables()
    name, options = keyword.upper(), list[str]()
    while name not in known:
        base, _, last = name.rpartition("_")
        if last not in ("TITLE", "ID", "MPP", "COLLECT") or not base:
            return None, []
        options.insert(0, last)
        name = base
    return known[name], [option for option in options if option in ("TITLE", "ID", "MPP")]


def same_keyword(name: str) -> set[str]:
    """All names of a keyword, of materials number and name."""
    table, _ = table_of(name)
    return set(table.names) if table else {name.upper()}
