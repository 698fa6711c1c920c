"""A picture of a deck before it is run: the state from which the run begins, as pictures of its results show it."""
from __future__ import annotations

import re
import tempfile
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from .diagnostics import CourantError, Diagnostics

_NO_TIME = 1e-12  # of a run that only writes its first state [T]
_OPTIONS = dict(until=_NO_TIME, threads=1, quiet=True, check=False)


def preview(deck: str | PathLike[str], file: str | PathLike[str] | None = None, field: str = "", **keys: Any) -> Any:
    """Draws the first state of a deck or scene by a field ("pressure"; speed, if not given), and writes it to `file`. `keys`: as of Results.plot. Gives
    matplotlib's figure. Raises CourantError with what is wrong with the deck, the field or the file."""
    return preview_of(deck, fspath(deck), file, field, **keys)


def preview_of(deck: str | PathLike[str], name: str, file: str | PathLike[str] | None, field: str, **keys: Any) -> Any:
    """The same of a deck that messages call `name`."""
    from .files import OutputError

    if file is not None:
        check_ending(Path(file))
    with tempfile.TemporaryDirectory(prefix="courant_") as folder:
        first = first_state(deck, name, Path(folder))
        try:
            return first.plot(field, None if file is None else Path(file), **keys)
        except KeyError as fault:  # UnknownField, too, whose message has the file of the results
            raise fault_of(name, "preview: " + re.sub(rf"{re.escape(folder)}\S*", "the first state", str(fault.args[0]))) from None
        except OutputError as fault:
            message, _, hint = str(fault).partition("\n  hint: ")
            raise fault_of("", message, hint) from None


def fault_of(name: str, message: str, hint: str = "") -> CourantError:
    diagnostics = Diagnostics()
    diagnostics.error(name, message, hint)
    return CourantError(diagnostics)


def check_ending(file: Path) -> None:
    from .optional import module

    known = sorted(module("matplotlib.backend_bases").FigureCanvasBase.get_supported_filetypes())
    if file.suffix and file.suffix[1:].lower() not in known:
        raise fault_of(fspath(file), f"preview: pictures cannot end with '{file.suffix}'", f"endings: {', '.join(known)}")


def first_state(deck: str | PathLike[str], name: str, folder: Path) -> Any:
    from .deck import Deck
    from .running import run

    first = run(deck, folder / "first", **_OPTIONS)  # type: ignore[arg-type]
    if not (folder / "first" / "fields.pvd").exists() and Path(deck).suffix not in (".yaml", ".yml"):
        asked = Deck(deck)  # it asks for no states: a copy does
        asked.add("*DATABASE_BINARY_D3PLOT\n1.0")
        first = run(asked.write(folder / "asked.k"), folder / "second", **_OPTIONS)  # type: ignore[arg-type]
    if not (Path(first.folder) / "fields.pvd").exists():
        raise fault_of(name, "preview: the deck has no state that could be drawn", "of *CASE, each case is a run of its own")
    return first.states[0]
