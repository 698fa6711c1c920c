"""What the tests of `courant verify` share."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[2] / "src" / "python")]


@pytest.fixture
def executable() -> Path:
    """The solver, where COURANT_EXECUTABLE names it."""
    if "COURANT_EXECUTABLE" not in os.environ:
        pytest.skip("COURANT_EXECUTABLE names no program")
    return Path(os.environ["COURANT_EXECUTABLE"])
