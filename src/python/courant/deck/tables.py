"""The cards of keywords as the program knows them: `courant keywords --json`."""
from __future__ import annotations

import json
import re
import subprocess
from dataclasses import dataclass, field
from functools import lru_cache

from ..program import executable


@dataclass(frozen=True)
class FieldOf:
    name: str
    begin: int  # columns from 0
    end: int
    kind: str  # A, I or F
    listed: bool  # many values in these columns
    meaning: str = ""
    dimension: str = ""  # in M, L, T
    default: str = ""
    accepted: str = ""
    refers: str = ""  # what its ids number: "curve"; "varies": other fields decide; "": no ids
    allowed: tuple[int, ...] = ()  # the only values, where there are few


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
    many: bool = True  # a block may have several sets of cards
    purpose: str = ""
    state: str = ""  # "honoured", "partly", "no effect", "refused"
    support: str = ""  # that in full
    defines: str = ""  # what its ids number: "part"; "": nothing


@lru_cache(maxsize=None)
def tables() -> dict[str, TableOf]:
    """Of all keywords by name. Empty where the program is not there."""
    program = executable()
    if not program:
        return {}
    said = subprocess.run([program, "keywords", "--json"], capture_output=True, text=True, errors="replace")
    return parse(said.stdout) if said.returncode == 0 else {}


def parse(text: str) -> dict[str, TableOf]:
    out: dict[str, TableOf] = {}
    for one in json.loads(text):
        keys = ("names", "options", "heading", "many", "purpose", "state", "support", "defines")
        table = TableOf(cards=[_card(card) for card in one["cards"]], **{key: one[key] for key in keys})
        out |= {name: table for name in table.names if name not in out}
    return out


def _card(card: dict) -> CardOf:
    fields = [
        FieldOf(f["name"], f["column"], f["column"] + f["width"], f["type"], f["list"], f["meaning"], f["dimension"], f["default"], f["accepted"],
                f["refers"], tuple(f["allowed"]))
        for f in card["fields"]
    ]
    return CardOf(fields, card["optional"], card["conditional"], card["repeated"])


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
