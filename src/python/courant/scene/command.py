"""`courant generate`: a keyword deck from a scene."""
from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path

from ..diagnostics import Diagnostics
from ..files import OutputError, write_file
from ..terminal import EXIT_INPUT, EXIT_OK, Parser, say
from .deck import deck_pieces
from .model import Model
from .reader import SceneReader


def read_model(path: str, overrides: Mapping[str, str], diagnostics: Diagnostics) -> Model:
    """Reads and checks a scene. `overrides` replace values of `parameters`; one that names no parameter is an error."""
    reader = SceneReader(path, overrides, diagnostics)
    try:
        root = reader.load(path)
    except OSError:
        diagnostics.error(path, "the scene cannot be read", "check the name and the permissions")
        return Model()
    return reader.read(root) if root is not None else Model()


def write_deck(model: Model, name: str, deck: str, diagnostics: Diagnostics, of_python: bool = False) -> bool:
    """False, with messages and no file written or changed, where the model is wrong or the file cannot be written."""
    for file in model.files:
        if os.path.exists(file) and os.path.exists(deck) and os.path.samefile(file, deck):
            diagnostics.error(deck, "the deck would take the place of the scene, or of a base of it", "give the deck another name: -o DECK.k")
            return False
    pieces = deck_pieces(model, name, diagnostics, of_python) if diagnostics.ok else []
    if not pieces:
        return False
    try:
        write_file(Path(deck), pieces, named=True)
    except OutputError as fault:
        reason, _, _ = str(fault).removeprefix(f"cannot write '{deck}': ").partition("\n")
        diagnostics.error(deck, f"the deck cannot be written: {reason}", "name a file that can be written, in a folder that exists: -o DECK.k")
        return False
    return True


def overrides_of(words: list[str]) -> dict[str, str] | None:
    """NAME=VALUE each; None, with a message, where one is not."""
    out = {}
    for word in words:
        name, mark, value = word.partition("=")
        if not mark or not name:
            sys.stderr.write(f"error: --param expects NAME=VALUE, got '{word}'\n")
            return None
        out[name] = value
    return out


def main(words: list[str]) -> int:
    parser = Parser(prog="courant generate", description="write a keyword deck from a YAML scene")
    parser.add_argument("SCENE", help="scene.yaml")
    parser.add_argument("-o", "--output", required=True, help="deck to write")
    parser.add_argument("--param", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the scene")
    call = parser.parse_args(words)
    overrides = overrides_of(call.param)
    if overrides is None:
        return EXIT_INPUT
    diagnostics = Diagnostics()
    model = read_model(call.SCENE, overrides, diagnostics)
    written = diagnostics.ok and write_deck(model, Path(call.SCENE).name, call.output, diagnostics)
    sys.stderr.write(diagnostics.text())
    if written:
        say(f"wrote {call.output}\n")
    return EXIT_OK if written else EXIT_INPUT
