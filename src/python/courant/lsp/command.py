"""The call `courant lsp`."""
from __future__ import annotations

import logging
import sys
from collections.abc import Sequence

from ..optional import MissingModule
from ..terminal import EXIT_OK, EXIT_OTHER, Parser


def main(words: Sequence[str]) -> int:
    """The exit code: 0, 3 where pygls is missing."""
    parser = Parser("courant lsp", allow_abbrev=False, description="language server for keyword decks, on standard input and output")
    parser.add_argument("--stdio", action="store_true", help="the default; editors add it")
    parser.parse_args(list(words))
    logging.basicConfig(stream=sys.stderr, level=logging.WARNING)
    from .server import DeckServer

    try:
        server = DeckServer()
    except MissingModule as fault:
        sys.stderr.write(f"error: {fault}\n  hint: the language server needs pygls; COURANT_PYTHON names a Python that has it\n")
        return EXIT_OTHER
    server.serve()
    return EXIT_OK
