"""`courant run SCENE.yaml` and `courant check SCENE.yaml`: the deck of the scene, then the program with it."""
from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from ..diagnostics import Diagnostics
from ..files import OutputError, make_folder
from ..program import executable
from ..terminal import EXIT_INPUT, EXIT_OTHER
from .command import overrides_of, read_model, write_deck


def _parted(words: list[str]) -> tuple[str, list[str], str, list[str]]:
    """The scene, words of --param, the folder for results, and all other words."""
    scene, params, folder, rest = "", [], ".", []
    at = iter(words)
    for word in at:
        option, mark, value = word.partition("=")
        if option == "--param":
            params.append(value if mark else next(at, ""))
        elif not scene and word.endswith((".yaml", ".yml")) and not word.startswith("-"):
            scene = word
        else:
            rest.append(word)
            if word in ("-o", "--output", "--threads", "--until", "--restart", "--load", "--case"):
                rest.append(next(at, ""))
            if option in ("-o", "--output"):
                folder = value if mark else rest[-1]
    return scene, params, folder, rest


def main(call: str, words: list[str]) -> int:
    scene, params, folder, rest = _parted(words)
    overrides = overrides_of(params)
    if overrides is None:
        return EXIT_INPUT
    program = executable()
    if not program:
        sys.stderr.write("error: the program courant is not found\n  hint: name it in COURANT_EXECUTABLE\n")
        return EXIT_OTHER
    diagnostics = Diagnostics()
    model = read_model(scene, overrides, diagnostics)
    name = Path(scene).stem + ".k"
    if call == "check":
        with tempfile.TemporaryDirectory(prefix="courant_") as made:
            if _written(model, scene, Path(made, name), diagnostics):
                return subprocess.run([program, call, name, *rest], cwd=made).returncode
        return EXIT_INPUT
    if diagnostics.ok:
        try:
            make_folder(Path(folder))
        except OutputError as fault:
            sys.stderr.write(f"error: {fault}\n")
            return EXIT_INPUT
    deck = Path(folder, name)
    if not _written(model, scene, deck, diagnostics):
        return EXIT_INPUT
    sys.stdout.flush()
    os.execv(program, [program, call, str(deck), *rest])


def _written(model, scene: str, deck: Path, diagnostics: Diagnostics) -> bool:  # type: ignore[no-untyped-def]
    made = diagnostics.ok and write_deck(model, Path(scene).name, str(deck), diagnostics)
    sys.stderr.write(diagnostics.text())
    return made
