"""One run of decks/mixed.k, with each kind of element, that several tests look at."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

DECK = Path(__file__).parent / "decks" / "mixed.k"
COURANT = os.environ.get("COURANT_EXECUTABLE", "")
needs_courant = pytest.mark.skipif(not COURANT, reason="COURANT_EXECUTABLE names no program")


def run(deck: Path, to: Path, *words: str) -> Path:
    subprocess.run([COURANT, "run", str(deck), "-o", str(to), "--quiet", "--threads", "1", *words], check=True, timeout=300, capture_output=True)
    return to
