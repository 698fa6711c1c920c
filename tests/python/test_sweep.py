"""Sweeps over the parameters of scenes and decks."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import courant
import pytest

from test_inside import deck

pytestmark = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


def drop() -> courant.Scene:
    scene = courant.Scene("drop", spacing="0.2 / n", end=0.05, output=0.05, gravity="g", parameters={"n": 2, "g": 10})
    return scene.water(low=(0, 0), high=(0.4, 0.4))


def measure(run: courant.Run) -> dict[str, Any]:
    state = run.states[-1]
    return {"particles": len(state), "fall": -state["velocity"][:, 1].mean() / run.summary["time"]}


def rows(table: Any) -> list[dict[str, Any]]:
    return table if isinstance(table, list) else table.to_dict("records")


def test_a_scene_is_run_for_all_combinations_and_taken_over(tmp_path: Path) -> None:
    said: list[str] = []
    first = rows(courant.sweep(drop(), {"n": [2, 4], "g": [10, 20.5]}, tmp_path / "s", jobs=2, measure=measure, say=said.append))
    assert [(row["n"], row["g"]) for row in first] == [(2, 10), (2, 20.5), (4, 10), (4, 20.5)] and len(said) == 4
    assert [row["particles"] for row in first] == [16, 16, 64, 64]
    assert all(row["fall"] == pytest.approx(row["g"], rel=0.05) and row["termination"] == "normal" and not row["taken_over"] for row in first)
    assert Path(first[1]["folder"]).name == "n=2,g=20.5"
    (tmp_path / "s" / "n=4,g=10" / "sweep.json").unlink()  # as a run that was interrupted
    again = rows(courant.sweep(drop(), {"n": [2, 4], "g": [10, 20.5]}, tmp_path / "s", measure=measure, say=None))
    assert [row["taken_over"] for row in again] == [True, True, False, True]
    assert [row["fall"] for row in again] == [row["fall"] for row in first]
    changed = drop().keywords("*CONTROL_TIMESTEP\n         0       0.5\n")
    assert not any(row["taken_over"] for row in rows(courant.sweep(changed, {"n": [2], "g": [10]}, tmp_path / "s", say=None)))


def test_a_deck_and_what_goes_wrong_in_one_run(tmp_path: Path) -> None:
    file = deck(tmp_path)
    file.write_text(file.read_text().replace("*MAT_ELASTIC\n1,7800", "*PARAMETER\nR ro,7800.\n*MAT_ELASTIC\n1,&ro"))
    table = rows(courant.sweep(file, {"ro": [7800.0, -1.0]}, tmp_path / "s", say=None))
    assert [row["termination"] for row in table] == ["normal", ""] and "(RO" in table[1]["error"] and table[0]["error"] == ""
    wrong = rows(courant.sweep(drop(), {"m": [2]}, tmp_path / "w", say=None))
    assert "--param m: the scene has no such parameter" in wrong[0]["error"]
    with pytest.raises(courant.CourantError, match="cannot read"):
        courant.sweep(tmp_path / "no.k", {"ro": [1]}, tmp_path / "s")
    with pytest.raises(courant.CourantError, match="the same"):
        courant.sweep(file, {"ro": [1.0, 1.0]}, tmp_path / "s")
