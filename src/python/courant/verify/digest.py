"""What tells runs apart: digests of decks with all that they include, and of a build of Courant."""
from __future__ import annotations

import hashlib
import os
import re
import subprocess
from collections.abc import Iterable, Mapping
from pathlib import Path

from ..files import note_input

_BLOCK = re.compile(r"^\*(INCLUDE|PARAMETER)\S*[^\n]*\n((?:(?!\*)[^\n]*(?:\n|$))*)", re.I | re.M)


def digest(*parts: str | bytes) -> str:
    """16 hexadecimal digits that tell sequences of texts apart (BLAKE2)."""
    out = hashlib.blake2b(digest_size=8)
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        out.update(b"%d:" % len(data) + data)
    return out.hexdigest()


def digest_of_files(files: Iterable[Path]) -> str:
    """Of the content of files, which are inputs; one that cannot be read counts by its name."""
    files = list(files)
    for file in files:
        note_input(file)
    return digest(*(file.read_bytes() if file.is_file() else str(file) for file in files))


def _read_blocks(text: str, given: Mapping[str, str], texts: dict[str, set[str]]) -> set[str]:
    """Data lines of *INCLUDE and its kin: names of files and folders. Texts that *PARAMETER defines (C NAME TEXT, in columns of ten or twenty, or
    between commas) go to `texts`."""
    names: set[str] = set()
    for keyword, block in _BLOCK.findall(text):
        lines = [line.rstrip() for line in block.split("\n") if line.strip() and line[0] != "$"]
        if keyword.upper() == "INCLUDE":  # ' +' at the end of a line continues a name; it may be in quotes
            names |= {line.strip().strip("\"'").strip() for line in re.sub(r" \+\s*\n\s*", "", "\n".join(lines)).split("\n")}
            continue
        for cells in (cells for line in lines for cells in (line.split(","), re.findall(".{1,10}", line), re.findall(".{1,20}", line))):
            for declaration, value in zip(cells[::2], cells[1::2], strict=False):
                name = declaration.strip()[1:].strip().upper()
                if declaration.strip()[:1] in ("C", "c") and name and name not in given:
                    texts.setdefault(name, set()).add(value.strip())
    return names


def without_comments(text: bytes) -> bytes:
    """A deck without its lines of comment, which change no result."""
    return b"".join(line for line in text.splitlines(keepends=True) if not line.startswith(b"$"))


def digest_of_deck(deck: Path, parameters: Mapping[str, str] | None = None, comments: bool = True) -> str:
    """Of a deck with the files that a run with these parameters may read: rather one too many than one too few, as of parameters that have several
    values in it, or of several folders that hold a file of the name. `comments`: whether those of the deck itself count."""
    given = {name.upper(): text for name, text in (parameters or {}).items()}
    texts = {name: {text} for name, text in given.items()}
    names, found, waiting = set[str](), set[Path](), {deck}
    while waiting and len(found) < 10000:
        found |= waiting
        for file in waiting:
            data = file.read_bytes() if file.is_file() else b""
            names |= _read_blocks(data.decode("latin-1"), given, texts) if re.search(rb"^\*INCLUDE", data, re.I | re.M) or file != deck else set()
        for name, values in [*texts.items()] * 3:  # also those that are made of others
            names |= {re.sub(f"&{name}", text.replace("\\", r"\\"), one, flags=re.I) for one in names if "&" in one for text in values}
        names |= {name.replace("\\", "/") for name in names}
        folders = {Path(), *(file.parent for file in found), *(folder / name for folder in (Path(), deck.parent) for name in names)}
        paths = {Path(os.path.normpath(folder / name)) for folder in folders if folder.is_dir() for name in names}
        waiting = {path for path in paths if path.is_file()} - found
    if comments or not deck.is_file():
        return digest_of_files(sorted(found))
    note_input(deck)
    return digest(without_comments(deck.read_bytes()), digest_of_files(sorted(found - {deck})))


def digest_of_build(executable: Path) -> str:
    """Of a program and the libraries of Courant that it loads; of a script, also of the programs that it names and the libraries beside them."""
    files, waiting = list[Path](), [executable]
    while waiting:
        file = waiting.pop()
        if file in files or not file.is_file():
            continue
        files.append(file)
        data = file.read_bytes()
        if data.startswith(b"#!"):
            named = [Path(word) for word in re.findall(r"/[\w./+-]+", data.partition(b"\n")[2].decode("utf-8", "replace"))]
            waiting += [path for path in named if path.is_file()]
            waiting += sorted(library for path in named if path.is_dir() for library in path.glob("libcourant*.so*"))
        elif data.startswith(b"\x7fELF") and ".so" not in file.name:  # the loader lists what it would load
            told = subprocess.run([file], env=dict(os.environ, LD_TRACE_LOADED_OBJECTS="1"), capture_output=True, text=True, check=False).stdout
            waiting += [Path(name) for name in re.findall(r"libcourant\S* => (/\S+)", told)]
    return digest(digest_of_files(files or [executable]), os.environ.get("COURANT_SIMD", ""))
