"""Runs of scenes and decks from Python."""
from __future__ import annotations

import os
from pathlib import Path

import courant
import numpy as np
import pytest
from courant.running import parse_messages

pytestmark = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")


def tank(**keys: object) -> courant.Scene:
    made = courant.Scene("still water", **({"spacing": 0.02, "end": 1, "output": 0.05} | keys))  # type: ignore[arg-type]
    return made.water(low=(0, 0), high=(0.4, 0.2)).box(low=(0, 0), high=(0.4, 0.4), open=["top"])


def test_still_water_has_its_pressure_in_the_lowest_row(tmp_path: Path) -> None:
    run = tank().run(tmp_path / "mirrors", threads=1, quiet=True)
    assert (run.verdict, run.termination, run.exit_code) == ("sound", "normal", 0)
    y = run.states[0].points[:, 1]
    lowest = y < 0.02
    pressure = np.mean([state["pressure"][lowest].mean() for state in list(run.states)[-8:]])
    assert abs(pressure / (9810 * (0.2 - 0.01)) - 1) < 0.03
    assert run.states[-1]["speed"].max() < 0.02 * np.sqrt(2 * 9.81 * 0.2)


def test_bits_are_those_of_the_command_line(tmp_path: Path) -> None:
    scene = tank(end=0.1)
    scene.to_yaml(tmp_path / "tank.yaml")
    first = scene.run(tmp_path / "a", threads=1, quiet=True)
    second = courant.run(tmp_path / "tank.yaml", tmp_path / "b", threads=1, quiet=True)
    assert first.states[-1]["velocity"].tobytes() == second.states[-1]["velocity"].tobytes()


def test_a_wrong_deck_is_an_exception_with_its_position(tmp_path: Path) -> None:
    deck = tank().write(tmp_path / "tank.k")
    text = deck.read_text()
    deck.write_text(text.replace("         1       2.0       1.0       1.0", "         1       q.0       1.0       1.0"))
    line = next(k for k, one in enumerate(deck.read_text().splitlines(), 1) if "q.0" in one)
    for call in (lambda: courant.run(deck, tmp_path / "never"), lambda: courant.check(deck)):
        with pytest.raises(courant.CourantError) as fault:
            call()
        one = fault.value.diagnostics.all[0]
        assert (one.severity, one.where.line, one.field) == ("error", line, "CSLH") and one.where.file.endswith("tank.k")
        assert "expected a number" in one.message
    assert not (tmp_path / "never").exists()
    deck.write_text(text)
    assert courant.check(deck).errors == 0


def test_a_run_that_ends_in_error_is_told_with_what_there_is(tmp_path: Path) -> None:
    scene = tank().keywords("*CONTROL_TERMINATION\n       1.0         0     1.001\n")  # DTMIN above any step
    with pytest.raises(courant.RunFailed) as fault:
        scene.run(tmp_path / "short", threads=1, quiet=True)
    assert fault.value.results.exit_code == 2 and fault.value.diagnostics.errors


def test_options_are_those_of_the_call(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run = tank().run(tmp_path / "out", threads=1, until=0.05)
    assert abs(run.summary["time"] - 0.05) < 0.01
    assert "results are in" in capsys.readouterr().out
    with pytest.raises(courant.CourantError, match="until=-1: expected a time > 0"):
        tank().run(tmp_path / "no", until=-1)


def test_messages_are_read_as_they_are_printed() -> None:
    found = parse_messages("a b.k:3:11: error: *MAT_NULL field 2 (RO, density [M/L3]): wrong\n  hint: do\nerror: no deck\nscene.yaml: note: c: d\n")
    assert [(one.severity, one.where.file, one.where.line, one.where.column, one.message, one.hint, one.field) for one in found.all] == [
        ("error", "a b.k", 3, 11, "*MAT_NULL field 2 (RO, density [M/L3]): wrong", "do", "RO"), ("error", "", 0, 0, "no deck", "", ""),
        ("note", "scene.yaml", 0, 0, "c: d", "", "")]


def test_the_total_force_on_walls_is_the_weight_of_the_water(tmp_path: Path) -> None:
    run = tank().run(tmp_path / "out", threads=1, quiet=True)
    force = run.wall_force()
    water = sum(run.states[-1]["mass"].astype(float))
    late = force["t"] > 0.5 * force["t"][-1]
    assert force["force.y"][late].mean() == pytest.approx(-9.81 * water, rel=0.02) and force.units["force.y"] == "N"
    with pytest.raises(KeyError, match="no contact 7"):
        run.wall_force(7)
