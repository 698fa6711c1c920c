"""A picture of a deck before it is run: the state from which the run begins, as pictures of its results show it."""
from __future__ import annotations

import tempfile
from os import PathLike
from pathlib import Path
from typing import Any

_NO_TIME = 1e-12  # of a run that only writes its first state [T]


def preview(deck: str | PathLike[str], file: str | PathLike[str] | None = None, field: str = "", **keys: Any) -> Any:
    """Draws the first state of a deck or scene by a field ("pressure"; speed, if not given), and writes it to `file`. `keys`: as of Results.plot. Gives
    matplotlib's figure. Raises CourantError with what is wrong with the deck."""
    from .running import run

    with tempfile.TemporaryDirectory(prefix="courant_") as folder:
        first = run(deck, Path(folder, "first"), until=_NO_TIME, threads=1, quiet=True, check=False)
        return first.states[0].plot(field, None if file is None else Path(file), **keys)
