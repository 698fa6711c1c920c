"""What tells runs apart: digests of decks with all that they include, and of a build of Courant."""
from __future__ import annotations

import hashlib
import os
import re
import shlex
import subprocess
from collections.abc import Iterator, Mapping
from pathlib import Path

_LONGEST_NAME = 1000  # characters, of a file: texts made of texts must not fill the memory
_MOST_FILES = 10000


def digest(*parts: str | bytes) -> str:
    """16 hexadecimal digits that tell sequences of texts apart (BLAKE2)."""
    sum_ = hashlib.blake2b(digest_size=8)
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        sum_.update(f"{len(data)}:".encode())
        sum_.update(data)
    return sum_.hexdigest()


def _content(file: Path) -> bytes | None:
    try:
        return file.read_bytes()
    except OSError:
        return None


def _blocks(text: str) -> Iterator[tuple[str, list[str]]]:
    """Keyword in capital letters and its data lines, of those keywords that tell which files are read."""
    for block in re.finditer(r"^\*((?:INCLUDE|PARAMETER)\S*)[^\n]*\n((?:(?!\*)[^\n]*(?:\n|$))*)", text, re.I | re.M):
        yield block[1].upper(), [line.rstrip("\r") for line in block[2].split("\n") if line and not line.startswith("$")]


def _names(lines: list[str]) -> list[str]:
    """File names, perhaps in quotes; ' +' at the end of a line continues one."""
    joined = re.sub(r"[ \t]+\+[ \t]*\n[ \t]*", "", "\n".join(lines))
    return [re.sub(r"""^(["'])(.*)\1$""", r"\2", name).strip() for line in joined.split("\n") if (name := line.strip())]


class _Files:
    """Collects the files that a deck may read: rather one too many than one too few, as of parameters that have
    several values in it, or of several folders that hold a file of the name."""

    def __init__(self, deck: Path, parameters: Mapping[str, str]) -> None:
        self.deck = deck
        self.given = {name.upper(): text for name, text in parameters.items()}
        self.texts: dict[str, set[str]] = {name: {text} for name, text in self.given.items()}
        self.folders: list[Path] = [Path()]
        self.found: dict[Path, bytes] = {}

    def collect(self) -> None:
        """Until nothing more is found: a parameter or a folder may be told in a file that is read later."""
        before = (-1, -1, -1)
        now = (0, 0, 0)
        while now != before:
            before = now
            for file in [self.deck, *self.found]:
                self.read(file)
            now = (len(self.found), len(self.folders), sum(map(len, self.texts.values())))

    def read(self, file: Path) -> None:
        data = self.found.get(file) or _content(file)
        if data is None:
            return
        self.found[file] = data
        for keyword, lines in _blocks(data.decode("latin-1")):
            if keyword.startswith("PARAMETER"):
                self.take_parameters(lines)
            elif keyword.startswith("INCLUDE_PATH"):
                for name in self.meanings(_names(lines)):
                    for folder in (Path(name), self.deck.parent / name):
                        if folder not in self.folders:
                            self.folders.append(folder)
            else:
                for name in self.meanings(_names(lines)[:1 if "TRANSFORM" in keyword else None]):
                    self.include(name, file)

    def take_parameters(self, lines: list[str]) -> None:
        """Texts: `C name value`, in columns of ten or twenty, or between commas."""
        for line in lines:
            for cells in ([line.split(",")] if "," in line else
                          [[line[k:k + n] for k in range(0, len(line), n)] for n in (10, 20)]):
                for declaration, value in zip(cells[::2], cells[1::2], strict=False):
                    name = declaration.strip()[1:].strip().upper()
                    if declaration.strip()[:1] in ("C", "c") and name and name not in self.given:
                        self.texts.setdefault(name, set()).add(value.strip())

    def meanings(self, names: list[str]) -> Iterator[str]:
        """The names with each value of the parameters in them."""
        for name in names:
            waiting, done = [name], set[str]()
            while waiting and len(done) < _MOST_FILES:
                one = waiting.pop()
                if one in done or len(one) > _LONGEST_NAME:
                    continue
                done.add(one)
                yield one
                for word in re.finditer(r"&([A-Za-z0-9_]+)", one):
                    for length in range(len(word[1]), 0, -1):  # the longest name that is one
                        for text in sorted(self.texts.get(word[1][:length].upper(), ())):
                            waiting.append(one[:word.start()] + text + one[word.start() + 1 + length:])

    def include(self, name: str, by: Path) -> None:
        for one in {name, name.replace("\\", "/")}:
            for folder in (by.parent, *self.folders):
                file = Path(os.path.normpath(folder / one))
                if len(self.found) < _MOST_FILES and file not in self.found and file.is_file():
                    self.read(file)


def digest_of_deck(deck: Path, parameters: Mapping[str, str] | None = None) -> str:
    """Of a deck with the files that a run with these parameters would read; one that cannot be read counts by its name."""
    data = _content(deck)
    if data is None:
        return digest(str(deck))
    if b"*INCLUDE" not in data.upper():
        return digest(data)
    files = _Files(deck, parameters or {})
    files.collect()
    return digest(*(part for file in sorted(files.found) for part in (str(file), files.found[file])))


def digest_of_files(files: list[Path]) -> str:
    """Of the content of files; one that cannot be read counts as none."""
    return digest(*(_content(file) or b"" for file in files))


def _libraries(program: Path) -> list[Path]:
    """Libraries of Courant that a program loads."""
    environment = dict(os.environ, LD_TRACE_LOADED_OBJECTS="1")
    try:
        told = subprocess.run([program], env=environment, capture_output=True, text=True, timeout=60, check=False).stdout
    except (OSError, subprocess.TimeoutExpired):
        return []
    return [Path(name) for name in re.findall(r"libcourant\S* => (/\S+)", told)]


def digest_of_build(executable: Path) -> str:
    """Of a program and the libraries of Courant that it loads; of a script, also of the programs that it names."""
    files, waiting = list[Path](), [executable]
    while waiting:
        file = waiting.pop()
        data = _content(file)
        if file in files or data is None:
            continue
        files.append(file)
        if data.startswith(b"#!") and len(data) < 1 << 20:
            try:
                words = shlex.split(data.decode("utf-8", "replace"), comments=True)
            except ValueError:  # a quote without its end
                words = data.decode("utf-8", "replace").split()
            waiting += [Path(word) for word in words if word.startswith("/") and Path(word).is_file()]
            waiting += sorted(library for word in list(waiting) for library in word.parent.glob("libcourant*.so*"))
        elif data.startswith(b"\x7fELF") and ".so" not in file.name:
            waiting += _libraries(file)
    return digest(str(executable) if not files else digest_of_files(files), os.environ.get("COURANT_SIMD", ""))
