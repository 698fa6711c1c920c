"""`courant view`: pictures of runs, decks and scenes by one call."""
from __future__ import annotations

import os
from pathlib import Path

import courant
import pytest
from courant.viewing import main

needs_program = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


@pytest.fixture(autouse=True)
def no_display(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)


def scene() -> courant.Scene:
    return courant.Scene("drop", spacing=0.02, end=0.02, output=0.01).water(low=(0, 0), high=(0.4, 0.4))


@needs_program
def test_states_of_a_run_and_the_first_of_a_deck_and_a_scene(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    run = scene().run(tmp_path / "run", quiet=True)
    (tmp_path / "drop.yaml").write_text(scene().to_yaml())
    scene().write(tmp_path / "drop.k")
    calls = {"last": [run.folder], "first": [run.folder, "--state", "0"], "middle": [run.folder, "--at", "0.01", "--field", "pressure"],
             "scene": [tmp_path / "drop.yaml"], "deck": [tmp_path / "drop.k"]}
    for name, words in calls.items():
        picture = tmp_path / f"{name}.png"
        assert main([*map(str, words), "-o", str(picture)]) == 0, capsys.readouterr().err
        assert picture.stat().st_size > 0
    assert (tmp_path / "first.png").read_bytes() != (tmp_path / "middle.png").read_bytes()


@needs_program
def test_what_is_wrong_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    run = str(scene().run(tmp_path / "run", quiet=True).folder)
    picture = ["-o", str(tmp_path / "x.png")]
    for words, what in (([run, "--state", "99", *picture], "no state 99"), ([run, "--field", "colour", *picture], "colour"),
                        ([run], "no display"), ([str(tmp_path / "none.k"), *picture], "none.k"), ([run, "-o", "x.bmpx"], "cannot end with"),
                        ([str(tmp_path), *picture], "no results here")):
        assert main(words) == 1
        error = capsys.readouterr().err
        assert what in error and "Traceback" not in error, error
    with pytest.raises(SystemExit) as ended:
        main([run, "--state", "1", "--at", "0.1", *picture])
    assert ended.value.code == 1


@needs_program
def test_a_run_without_states_is_no_wrong_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = courant.DeckBuilder("bar", 0.01)
    deck.card("*PART", "bar", [1, 1, 1]).card("*SECTION_SOLID", [1, 1]).card("*MAT_ELASTIC", [1, 1000.0, 1e5, 0.3])
    deck.mesh("SOLID", 1, courant.grid([1, 1, 1], [0.1, 0.1, 0.1]))
    folder = courant.run(deck.write(tmp_path / "bar.k"), tmp_path / "run", quiet=True).folder
    assert courant.open(folder).verdict == "sound"
    assert main([str(folder), "-o", str(tmp_path / "x.png")]) == 1
    assert "*DATABASE_BINARY_D3PLOT" in capsys.readouterr().err
