"""A keyword deck: its keywords as records, its mesh as arrays; changed, written and run.

deck = courant.Deck("plate.k")
deck["MAT_ELASTIC"]["E"] = 70e9                     # the only one; deck.find("MAT_ELASTIC", MID=3) one of several
deck.parameters["dx"] = 0.005
deck.points[:, 2] += 0.1                            # after deck.ids; written with the deck
deck.write("stiffer.k"); run = deck.run("results", until=0.1)
"""
from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from os import PathLike, fspath, path
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from ..diagnostics import CourantError, Diagnostics, Location
from ..files import OutputError, make_folder, write_file
from ..words import did_you_mean
from .blocks import Block, CardSet, Value
from .mesh import Elements, curves_of, elements_of, fixed, nodes_of, sets_of, write_points
from .parameters import Parameters
from .tables import same_keyword, without_options

_LONG = re.compile(r"long\s*=\s*(\w)", re.IGNORECASE)
_I10 = re.compile(r"i10\s*=\s*y", re.IGNORECASE)
_COLUMNS = 78  # of a line that names a folder


def split_deck(text: str, file: str, first_line: int = 1) -> tuple[str, list[Block]]:
    """What is in front of the first keyword, and the blocks."""
    head: list[str] = []
    found: list[tuple[str, int, list[str]]] = []
    for number, line in enumerate(text.splitlines(keepends=True) if "\r" not in text else re.findall(r"[^\n]*\n|[^\n]+", text), first_line):
        if line.startswith("*"):
            found.append((line[1:].split("$")[0].strip(), number, [line]))
        elif found:
            found[-1][2].append(line)
        else:
            head.append(line)
    usual = 0
    for name, _, _ in found:
        if name.upper().startswith("KEYWORD"):
            long = _LONG.search(name)
            usual = 20 if long and long[1].upper() == "Y" else 10 if _I10.search(name) else usual
    return "".join(head), [_block(name, lines, file, number, usual) for name, number, lines in found]


def _block(name: str, lines: list[str], file: str, number: int, usual: int) -> Block:
    word = name.split()[0] if name.split() else ""
    mark = name.split()[-1] if len(name.split()) > 1 else ""
    if word and word[-1] in "+-%":
        word, mark = word[:-1], word[-1]
    wide = {"+": 20, "%": 10, "-": 0}.get(mark, usual)
    return Block(word.upper(), lines, file, number, wide)


class Found(list[Block]):
    """Blocks of one keyword. `deck["MAT_ELASTIC"]["E"]` is a field of the only one."""

    def __init__(self, blocks: list[Block], what: str) -> None:
        super().__init__(blocks)
        self._what = what

    def __getitem__(self, key: Any) -> Any:
        return self._only()[key] if isinstance(key, str) else super().__getitem__(key)

    def __setitem__(self, key: Any, value: Any) -> None:
        if isinstance(key, str):
            self._only()[key] = value
        else:
            super().__setitem__(key, value)

    def _only(self) -> Block:
        if len(self) == 1:
            return self[0]  # type: ignore[no-any-return]
        raise self[0].fault(f"the deck has {len(self)} of {self._what}", "take one by its index, or deck.find(KEYWORD, FIELD=VALUE)")


class Deck:
    """The file of a deck. Included files are decks of their own: `deck.includes`. Raises CourantError where the file cannot be read."""

    def __init__(self, file: str | PathLike[str]) -> None:
        self.path = Path(file)
        try:
            text = self.path.read_bytes().decode("utf-8", "surrogateescape")
        except OSError as fault:
            raise self._error(f"the deck cannot be read: {fault.strerror}", "check the name and the permissions") from None
        self.head, self.blocks = self._split(text)
        self._points: np.ndarray | None = None
        self._read_points: np.ndarray | None = None

    def __repr__(self) -> str:
        return f"<courant.Deck {self.path}: {len(self.blocks)} keywords>"

    def _error(self, message: str, hint: str = "") -> CourantError:
        diagnostics = Diagnostics()
        diagnostics.error(Location(fspath(self.path)), message, hint)
        return CourantError(diagnostics)

    def _split(self, text: str, first_line: int = 1) -> tuple[str, list[Block]]:
        return split_deck(text, fspath(self.path), first_line)

    # keywords

    def __iter__(self) -> Iterator[Block]:
        return iter(self.blocks)

    def __contains__(self, keyword: str) -> bool:
        return bool(self._of(keyword))

    def _of(self, keyword: str) -> list[Block]:
        name = keyword.lstrip("*").upper()
        wanted, options = same_keyword(name), set(without_options(name)[1])
        named = [(block, *without_options(block.name)) for block in self.blocks]
        return [block for block, base, own in named if base in wanted and options <= set(own)]

    def __getitem__(self, keyword: str) -> Found:
        """All blocks of a keyword, by any of its names (MAT_024 is MAT_PIECEWISE_LINEAR_PLASTICITY), also with _TITLE or _ID; of a name with such an option
        only those that have it. Raises CourantError."""
        found = self._of(keyword)
        if not found:
            names = sorted({block.name.removesuffix("_TITLE").removesuffix("_ID") for block in self.blocks})
            raise self._error(f"the deck has no *{keyword.lstrip('*').upper()}", f"{did_you_mean(keyword.upper(), names)}it has {', '.join(names)}")
        return Found(found, f"*{keyword.lstrip('*').upper()}")

    def find(self, keyword: str, **fields: Value) -> CardSet:
        """The set of cards with these values: deck.find("PART", PID=3). Raises CourantError."""
        some = [one for block in self[keyword] for one in block.sets if all(one[name] == value for name, value in fields.items())]
        if len(some) != 1:
            what = ", ".join(f"{name}={value}" for name, value in fields.items())
            raise self._error(f"{len(some) or 'no'} sets of cards of *{keyword.lstrip('*').upper()} have {what}", "name fields that only one has")
        return some[0]

    def add(self, text: str) -> list[Block]:
        """Adds keywords, as text, in front of *END, parameters, which count from there on, behind *KEYWORD. Of a control
        card that is there twice, the last counts."""
        head, made = self._split(text if text.endswith("\n") else text + "\n", 0)
        if head.strip() or not made:
            raise self._error("add: expected keywords, each on a line that begins with *", "deck.add('*CONTROL_TERMINATION\\n0.5')")
        at = next((k for k, block in enumerate(self.blocks) if block.name == "END"), len(self.blocks))
        if at == len(self.blocks) and at and not self.blocks[-1].lines[-1].endswith("\n"):
            self.blocks[-1].lines[-1] += "\n"
        first = [block for block in made if block.name.startswith("PARAMETER")]
        self.blocks[at:at] = [block for block in made if block not in first]
        begin = next((k + 1 for k, block in enumerate(self.blocks) if block.name == "KEYWORD"), 0)
        self.blocks[begin:begin] = first
        return made

    def remove(self, what: str | Block) -> int:
        """Takes out a block, or all of a keyword; returns how many."""
        some = [what] if isinstance(what, Block) else list(self[what])
        self.blocks = [block for block in self.blocks if not any(block is one for one in some)]
        return len(some)

    @property
    def parameters(self) -> Parameters:
        """Values of *PARAMETER by name: deck.parameters["dx"] = 0.01."""
        return Parameters([block for block in self.blocks if block.name.startswith("PARAMETER")], self._error)

    @property
    def includes(self) -> list[Deck]:
        """The decks that this one includes, beside it or in the folders of *INCLUDE_PATH. Raises CourantError where one is not there."""
        folders = [self.path.parent]
        for block in self.blocks:
            if block.name in ("INCLUDE_PATH", "INCLUDE_PATH_RELATIVE"):
                folders += [self.path.parent / name for name in _names(block)]
        several, one = ([block for block in self.blocks if block.name == name] for name in ("INCLUDE", "INCLUDE_TRANSFORM"))
        files = [(name, block) for block in several for name in _names(block)] + [(name, block) for block in one for name in _names(block)[:1]]
        out = []
        for name, block in files:
            there = next((folder / name for folder in folders if (folder / name).is_file()), None)
            if there is None:
                raise block.fault(f"'{name}' is not there")
            out.append(Deck(there))
        return out

    # the mesh

    @property
    def ids(self) -> np.ndarray:
        """Numbers of the nodes of this file, (n,)."""
        return fixed(nodes_of(self.blocks)[0])

    @property
    def points(self) -> np.ndarray:
        """Their positions, (n, 3) [L]. Changes are written with the deck."""
        if self._points is None:
            self._points = nodes_of(self.blocks)[1]
            self._read_points = self._points.copy()
        return self._points

    @property
    def elements(self) -> Mapping[str, Elements]:
        """Elements of this file by kind, "SHELL": ids (m,), parts (m,), nodes (m, corners). Read-only, as `sets` and `curves` are."""
        return MappingProxyType(elements_of(self.blocks))

    @property
    def parts(self) -> Mapping[int, CardSet]:
        """Sets of cards of *PART and its like by the number of the part."""
        out: dict[int, CardSet] = {}
        for block in self.blocks:
            if block.name.split("_")[0] == "PART" and "PID" in block:
                out |= {number: one for one in block.sets if isinstance(number := one["PID"], int)}
        return MappingProxyType(out)

    @property
    def sets(self) -> Mapping[tuple[str, int], np.ndarray]:
        """Numbers in sets that list them, ("NODE", 3), ("PART", 2); sets by rules (_GENERAL, _ADD) are not among them."""
        return MappingProxyType(sets_of(self.blocks))

    @property
    def curves(self) -> Mapping[int, np.ndarray]:
        """Points of *DEFINE_CURVE by number, (n, 2), without its scales and offsets."""
        return MappingProxyType(curves_of(self.blocks))

    # what becomes of it

    @property
    def text(self) -> str:
        """The deck as it is now."""
        if self._points is not None and self._read_points is not None and not np.array_equal(self._points, self._read_points):
            write_points(self.blocks, self._points, self._read_points)
            self._read_points = self._points.copy()
        return self.head + "".join(block.text for block in self.blocks)

    def write(self, file: str | PathLike[str]) -> Path:
        """Writes the deck. In another folder than its own, a deck with includes gets an *INCLUDE_PATH of that folder. Raises CourantError."""
        target, text = Path(file), self.text
        home = path.abspath(self.path.parent)
        if "INCLUDE" in {block.name.split("_")[0] for block in self.blocks} and path.abspath(target.parent) != home:
            lines = [home[k : k + _COLUMNS] + (" +" if k + _COLUMNS < len(home) else "") for k in range(0, len(home), _COLUMNS)]
            first = next((k for k, block in enumerate(self.blocks) if block.name == "KEYWORD"), -1)
            before = self.head + "".join(block.text for block in self.blocks[: first + 1])
            text = before + "*INCLUDE_PATH\n" + "\n".join(lines) + "\n" + "".join(block.text for block in self.blocks[first + 1 :])
        try:
            write_file(target, text.encode("utf-8", "surrogateescape"), named=True)
        except OutputError as fault:
            raise self._error(str(fault)) from None
        return target

    def run(self, folder: str | PathLike[str] = "results", **options: Any) -> Any:
        """Writes the deck as it is now into the folder, and runs it: courant.run has the options and what is raised."""
        from ..running import run

        return run(self._written_to(folder), folder, **options)

    def steps(self, folder: str | PathLike[str] = "results", **options: Any) -> Any:
        """The same as a loop over the states, see courant.steps."""
        from ..stepping import steps

        return steps(self._written_to(folder), folder, **options)

    def check(self) -> Diagnostics:
        """Notes and warnings of the deck as it is now; raises CourantError with its errors."""
        import tempfile

        from ..running import check

        with tempfile.TemporaryDirectory() as folder:
            return check(self.write(Path(folder, self.path.name)))

    def _written_to(self, folder: str | PathLike[str]) -> Path:
        target = Path(folder, self.path.name)
        try:
            make_folder(Path(folder))
        except OutputError as fault:
            raise self._error(str(fault)) from None
        if target.exists() and target.samefile(self.path):
            target = target.with_stem(target.stem + "_changed")
        return self.write(target)


def _names(block: Block) -> list[str]:
    """File names of an include: a line that ends with " +" goes on."""
    out, before = [], ""
    for row in block.rows:
        line = block.lines[row].strip()
        if line.endswith(" +"):
            before += line[:-2]
        elif line:
            out.append(before + line)
            before = ""
    return out


