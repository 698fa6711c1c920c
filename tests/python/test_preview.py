"""Pictures of decks before they are run."""
from __future__ import annotations

import importlib.util
import os
from pathlib import Path

import courant
import pytest

needs_program = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


def test_no_call_of_the_package_has_the_name_of_a_module() -> None:
    """A module that is imported would hide the call."""
    assert [name for name in courant.__all__ if importlib.util.find_spec(f"courant.{name}")] == []


@needs_program
def test_a_preview_is_drawn_as_often_as_asked(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    scene = courant.Scene("drop", spacing=0.02, end=0.02).water(low=(0, 0), high=(0.4, 0.4))
    scene.preview(tmp_path / "scene.png")
    courant.preview(scene.write(tmp_path / "drop.k"), tmp_path / "deck.png")
    for name in ("scene", "deck"):
        assert (tmp_path / f"{name}.png").stat().st_size > 0


STILL = """*KEYWORD
*CONTROL_TERMINATION
0.2
*PART
brick
1,1,1
*SECTION_SOLID
1,1
*MAT_ELASTIC
1,7850.0,2.1e11,0.3
*NODE
1,0,0,0,7,0
2,1,0,0,7,0
3,1,1,0,7,0
4,0,1,0,7,0
5,0,0,1
6,1,0,1
7,1,1,1
8,0,1,1
*ELEMENT_SOLID
1,1,1,2,3,4,5,6,7,8
*END
"""


@needs_program
def test_a_deck_that_asks_for_no_states_has_a_preview(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    (tmp_path / "still.k").write_text(STILL)
    courant.preview(tmp_path / "still.k", tmp_path / "still.png")
    assert (tmp_path / "still.png").stat().st_size > 0 and (tmp_path / "still.k").read_text() == STILL


@needs_program
@pytest.mark.parametrize(("file", "field", "said"), [
    ("still.xyz", "", "still.xyz: error: preview: pictures cannot end with '.xyz'"), ("none/still.png", "", "none/still.png': No such file"),
    ("still.png", "matrial", "still.k: error: preview: the first state has no field 'matrial'; it has speed")])
def test_mistakes_of_a_preview_are_named(tmp_path: Path, file: str, field: str, said: str) -> None:
    pytest.importorskip("matplotlib")
    (tmp_path / "still.k").write_text(STILL)
    with pytest.raises(courant.CourantError) as fault:
        courant.preview(tmp_path / "still.k", tmp_path / file, field)
    assert said in str(fault.value) and "/courant_" not in str(fault.value) and not (tmp_path / file).exists()


@needs_program
def test_mistakes_of_the_preview_of_a_scene_name_no_copy() -> None:
    scene = courant.Scene("drop", spacing=0.02, end=0.02).water(low=(0, 0), high=(0.4, 0.4))
    with pytest.raises(courant.CourantError, match="has no field 'matrial'") as fault:
        scene.preview(field="matrial")
    assert "/courant_" not in str(fault.value)
