"""Messages about the user's input, as all parts of Courant print them: `FILE:LINE:COLUMN: error: MESSAGE`, then `  hint: ...`."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from os import PathLike

MAX_WARNINGS = 100  # more than these are counted, but not kept
LONGEST_TEXT = 500  # of a message or a hint [bytes]
_MESSAGE = re.compile(r"(?:(?P<file>[^\n]*?)(?::(?P<line>\d+))?(?::(?P<column>\d+))?: )?(?P<severity>error|warning|note): (?P<text>.*)")


@dataclass(frozen=True)
class Location:
    """A line in an input file; line and column count from 1, 0 means "not known"."""

    file: str = ""
    line: int = 0
    column: int = 0

    def __str__(self) -> str:
        return self.file + "".join(f":{number}" for number in (self.line, self.column) if number > 0)


@dataclass
class Diagnostic:
    """One message. `severity`: note, warning or error."""

    severity: str
    where: Location
    message: str
    hint: str = ""

    @property
    def field(self) -> str:
        """Name of the field of a card that the message is about, "" for none."""
        found = re.search(r" field \d+ \((\w+)", self.message)
        return found[1] if found else ""

    def text(self) -> str:
        where = f"{self.where}: " if self.where.file else ""
        return f"{where}{self.severity}: {self.message}" + (f"\n  hint: {self.hint}" if self.hint else "")


def presentable(text: str) -> str:
    """The text without control characters, which could act on a terminal, and cut where it is too long to read.

    Text of several lines (what another program said) keeps all of them.
    """
    if "\n" not in text and len(data := text.encode("utf-8", "replace")) > LONGEST_TEXT:
        text = data[:LONGEST_TEXT].decode("utf-8", "ignore") + "..."
    return "".join("?" if (c < " " and c != "\n") or c == "\x7f" or "\ud800" <= c <= "\udfff" else c for c in text)


@dataclass
class Diagnostics:
    """Collects every message, so that all faults of a file are reported at once."""

    all: list[Diagnostic] = field(default_factory=list)
    errors: int = 0
    warnings: int = 0
    _note_of_more: Diagnostic | None = None

    def add(self, one: Diagnostic) -> None:
        """Takes a message in; of warnings beyond MAX_WARNINGS only their number is kept."""
        self.errors += one.severity == "error"
        self.warnings += one.severity == "warning"
        if one.severity == "warning" and self.warnings > MAX_WARNINGS:
            if self._note_of_more is None:
                self._note_of_more = Diagnostic("note", Location(one.where.file), "")
                self.all.append(self._note_of_more)
            more = self.warnings - MAX_WARNINGS
            self._note_of_more.message = "1 more warning is not shown" if more == 1 else f"{more} more warnings are not shown"
            return
        where = Location(presentable(one.where.file), one.where.line, one.where.column)
        self.all.append(Diagnostic(one.severity, where, presentable(one.message), presentable(one.hint)))

    def error(self, where: Location | str | PathLike[str], message: str, hint: str = "") -> None:
        self.add(Diagnostic("error", as_location(where), message, hint))

    def warning(self, where: Location | str | PathLike[str], message: str, hint: str = "") -> None:
        self.add(Diagnostic("warning", as_location(where), message, hint))

    def note(self, where: Location | str | PathLike[str], message: str, hint: str = "") -> None:
        self.add(Diagnostic("note", as_location(where), message, hint))

    @property
    def ok(self) -> bool:
        return self.errors == 0

    def text(self) -> str:
        """All messages in the order they were found, each with its line end."""
        return "".join(one.text() + "\n" for one in self.all)


def as_location(where: Location | str | PathLike[str]) -> Location:
    return where if isinstance(where, Location) else Location(str(where))


def parse_messages(text: str) -> Diagnostics:
    """Messages as the program prints them, with those lines that belong to the one above."""
    out = Diagnostics()
    for line in text.splitlines():
        found = _MESSAGE.fullmatch(line)
        if found:
            where = Location(found["file"] or "", int(found["line"] or 0), int(found["column"] or 0))
            out.add(Diagnostic(found["severity"], where, found["text"]))
        elif out.all and line.startswith("  hint: "):
            out.all[-1].hint = line[8:]
        elif out.all and line.startswith("  "):
            out.all[-1].message += "\n" + line
    return out


class CourantError(Exception):
    """What keeps a file from being read, with the diagnostics that tell why."""

    def __init__(self, diagnostics: Diagnostics) -> None:
        super().__init__(diagnostics.text().rstrip("\n"))
        self.diagnostics = diagnostics
