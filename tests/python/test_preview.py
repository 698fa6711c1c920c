"""Pictures of decks before they are run."""
from __future__ import annotations

import importlib.util
import os
from pathlib import Path

import courant
import pytest

needs_program = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


def test_no_call_of_the_package_has_the_name_of_a_module() -> None:
    """Python puts a module that is imported in the place of the call."""
    assert [name for name in courant.__all__ if importlib.util.find_spec(f"courant.{name}")] == []


@needs_program
def test_a_preview_is_drawn_as_often_as_asked(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    scene = courant.Scene("drop", spacing=0.02, end=0.02).water(low=(0, 0), high=(0.4, 0.4))
    scene.preview(tmp_path / "scene.png")
    file = scene.write(tmp_path / "drop.k")
    for k in range(2):
        courant.preview(file, tmp_path / f"{k}.png")
        assert (tmp_path / f"{k}.png").stat().st_size > 0
