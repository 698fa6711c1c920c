"""Sweeps over the parameters of scenes and decks."""
from __future__ import annotations

import os
import re
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
    with pytest.raises(courant.CourantError, match="cannot read"):
        courant.sweep(tmp_path / "no.k", {"ro": [1]}, tmp_path / "s")
    with pytest.raises(courant.CourantError, match="the same"):
        courant.sweep(file, {"ro": [1.0, 1.0]}, tmp_path / "s")


@pytest.mark.parametrize(("values", "message"), [
    ({"m": [2]}, r"no parameter 'm'\n  hint: its parameters: n, g"),
    ({"n": 3}, r"values of n: expected a list, got 3\n  hint: give {\"n\": \[3\]}"),
    ({"n": "12"}, "values of n: expected a list, got '12'\n  hint: give"),
    ([1, 2], "expected a dictionary of lists")])
def test_wrong_values_are_refused_before_the_first_run(tmp_path: Path, values: Any, message: str) -> None:
    file = tmp_path / "drop.yaml"
    drop().to_yaml(file)
    for what in (drop(), file):
        with pytest.raises(courant.CourantError, match=message):
            courant.sweep(what, values, tmp_path / "s", say=None)
    assert not (tmp_path / "s").exists()


def test_threads_of_a_sweep_are_refused_before_the_first_run(tmp_path: Path) -> None:
    with pytest.raises(courant.CourantError, match="threads='two'"):
        courant.sweep(drop(), {"n": [2]}, tmp_path / "s", threads="two", say=None)  # type: ignore[arg-type]
    assert not (tmp_path / "s").exists()


def test_an_exception_in_measure_names_the_run(tmp_path: Path) -> None:
    def fail(run: courant.Run) -> dict[str, Any]:
        return {"one": 1 / 0}

    with pytest.raises(courant.CourantError, match=re.escape("measure fails for n = 2, g = 20.5: ZeroDivisionError: division by zero")) as fault:
        courant.sweep(drop(), {"n": [2], "g": [20.5]}, tmp_path / "s", measure=fail, say=None)
    assert isinstance(fault.value.__cause__, ZeroDivisionError) and "n=2,g=20.5" in str(fault.value)
    assert rows(courant.sweep(drop(), {"n": [2], "g": [20.5]}, tmp_path / "s", measure=measure, say=None))[0]["taken_over"]
    missing = rows(courant.sweep(drop(), {"n": [2], "g": [20.5]}, tmp_path / "s", measure=lambda run: {"n": run.d3plot.times}, say=None))
    assert "no d3plot here" in missing[0]["error"]


def test_a_script_of_another_name_takes_runs_over(tmp_path: Path) -> None:
    for name, taken_over in (("first.py", False), ("second.py", True)):
        scene = drop()
        scene._name = name  # of the script, which the deck has in its first comment
        assert rows(courant.sweep(scene, {"n": [2]}, tmp_path / "s", say=None))[0]["taken_over"] == taken_over
    assert len(list((tmp_path / "s" / "n=2").glob("scene_*.k"))) == 1
    file = deck(tmp_path)
    for text, taken_over in (("", False), ("$ a remark\n", True), ("*CONTROL_TIMESTEP\n,0.5\n", False)):
        file.write_text(file.read_text().replace("*END\n", text + "*END\n"))
        assert rows(courant.sweep(file, {}, tmp_path / "d", say=None))[0]["taken_over"] == taken_over
