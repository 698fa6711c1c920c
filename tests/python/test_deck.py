"""Decks in Python: fields by name, meshes as arrays, and files that stay as they are but for what is changed."""
from __future__ import annotations

import difflib
import os
from pathlib import Path

import courant
import numpy as np
import pytest
from courant.deck import blocks, tables

DECKS = Path(__file__).resolve().parents[1] / "decks" / "accept"

PLATE = """$ a plate that falls
*KEYWORD
*TITLE
plate
*PARAMETER
R        e      70e9I        n         2
*PARAMETER_EXPRESSION
R half    &e/2
*CONTROL_TERMINATION
$#  endtim    endcyc
       0.1         0
*PART
$ heading
plate
         1         1         3
upper plate
         2         1         4
*SECTION_SHELL
         1         2       1.0         3
     0.002     0.002     0.002     0.002
*MAT_ELASTIC_TITLE
aluminium
         3    2700.0        &e       0.3
*MAT_024
$    steel
         4,7850.,2.1e11,0.3,2.5e8
$ nodes
*NODE
       1             0.0             0.0             0.0       7
       2             1.0             0.0             0.0
       3             1.0             1.0             0.0
       4             0.0             1.0             0.0
*ELEMENT_SHELL
       1       1       1       2       3       4
*SET_NODE_LIST
         5
         1         2         3
*DEFINE_CURVE
         7
                 0.0                 1.0
                 2.0                 3.0
*END
"""


@pytest.fixture(autouse=True)
def _program() -> None:
    if not tables.tables():
        pytest.skip("needs the program")


def deck(folder: Path, text: str = PLATE) -> courant.Deck:
    (folder / "plate.k").write_bytes(text.encode())
    return courant.Deck(folder / "plate.k")


def changed(before: str, after: str) -> list[str]:
    return [line for line in difflib.ndiff(before.splitlines(), after.splitlines()) if line[0] in "+-"]


def test_fields_have_names(tmp_path: Path) -> None:
    plate = deck(tmp_path)
    assert plate["MAT_ELASTIC"]["RO"] == 2700 and plate["MAT_ELASTIC"]["E"] == "&e" and plate["MAT_ELASTIC"]["DA"] is None
    assert plate["mat_piecewise_linear_plasticity"]["SIGY"] == 2.5e8 and plate["*MAT_024"][0].line == 24
    assert [one.title for one in plate["PART"][0].sets] == ["plate", "upper plate"] and plate.parts[2]["MID"] == 4
    assert plate.find("PART", PID=1)["MID"] == 3 and plate["MAT_ELASTIC"][0].title == "aluminium"
    assert plate["SECTION_SHELL"]["T2"] == 0.002


def test_only_what_is_changed_changes(tmp_path: Path) -> None:
    plate = deck(tmp_path)
    assert plate.text == PLATE
    plate["CONTROL_TERMINATION"]["ENDTIM"] = 0.25
    plate["MAT_024"]["E"] = 2.05e11
    plate["MAT_024"]["LCSS"] = 7  # on a card that the deck leaves out
    plate.find("PART", PID=2).title = "another"
    plate.points[2] += (0, 0, 0.125)
    assert changed(PLATE, plate.text) == [
        "-        0.1         0", "+       0.25         0", "- upper plate", "+ another",
        "-          4,7850.,2.1e11,0.3,2.5e8", "+          4,7850.,205000000000,0.3,2.5e8",
        "+                              7",
        "-        3             1.0             1.0             0.0", "+        3               1               1           0.125"]
    again = courant.Deck(plate.write(tmp_path / "again.k"))
    assert again["MAT_024"]["LCSS"] == 7 and again.points[2, 2] == 0.125


def test_parameters(tmp_path: Path) -> None:
    plate = deck(tmp_path)
    assert dict(plate.parameters) == {"e": 70e9, "n": 2, "half": "&e/2"}
    plate.parameters["E"], plate.parameters["half"] = 1.5e11, "&e/3"
    assert changed(PLATE, plate.text) == ["- R        e      70e9I        n         2", "+ R        e    1.5e11I        n         2", "- R half    &e/2", "+ R half    &e/3"]
    with pytest.raises(courant.CourantError, match="parameter n is a whole number, got 2.5"):
        plate.parameters["n"] = 2.5
    with pytest.raises(courant.CourantError, match="no parameter 'm'"):
        plate.parameters["m"] = 1


def test_arrays(tmp_path: Path) -> None:
    plate = deck(tmp_path)
    assert plate.ids.tolist() == [1, 2, 3, 4] and plate.points.shape == (4, 3)
    shells = plate.elements["SHELL"]
    assert (shells.ids.tolist(), shells.parts.tolist(), shells.nodes.tolist()) == ([1], [1], [[1, 2, 3, 4]])
    assert plate.sets["NODE", 5].tolist() == [1, 2, 3] and plate.curves[7].tolist() == [[0, 1], [2, 3]]


@pytest.mark.parametrize("change", [
    lambda one: one.curves.__setitem__(3, [[0, 0]]), lambda one: one.sets.__setitem__(("NODE", 5), [1]), lambda one: one.parts.__setitem__(1, None),
    lambda one: one.elements.__setitem__("SHELL", None), lambda one: one.elements["SHELL"].nodes.__setitem__((0, 0), 99),
    lambda one: one.sets["NODE", 5].__setitem__(0, 9), lambda one: one.curves[7].__setitem__((0, 0), 9), lambda one: one.ids.__setitem__(0, 9)])
def test_what_would_not_be_written_is_read_only(tmp_path: Path, change: object) -> None:
    plate = deck(tmp_path)
    with pytest.raises((TypeError, ValueError, AttributeError)):
        change(plate)  # type: ignore[operator]
    assert plate.text == PLATE


def test_keywords_are_added_and_taken_out(tmp_path: Path) -> None:
    plate = deck(tmp_path)
    plate.add("*DATABASE_GLSTAT\n0.001")
    assert plate.remove("SET_NODE_LIST") == 1 and "SET_NODE_LIST" not in plate
    assert plate.text.endswith("*DATABASE_GLSTAT\n0.001\n*END\n") and "MAT_ELASTIC" in plate
    with pytest.raises(courant.CourantError, match="expected keywords"):
        plate.add("0.001")


def test_keywords_with_the_same_cards_are_not_the_same(tmp_path: Path) -> None:
    some = deck(tmp_path, """*KEYWORD
*DATABASE_GLSTAT
0.001
*DATABASE_MATSUM
0.002
*LOAD_BODY_X
         1      9.81
*LOAD_BODY_Z
         1      1.62
*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID
         1 all
         0         0
*CONTACT_AUTOMATIC_GENERAL
         0         0
*MAT_010
         1
*MAT_ELASTIC_PLASTIC_HYDRO_SPALL
         2
*MAT_ELASTIC
         3
*MAT_ELASTIC_TITLE
elastic
         4
*SET_NODE
         5
*CONTROL_TIME_STEP
         0
*END
""")
    names = [block.name for block in some]
    assert "LOAD_BODY_Y" not in some and some["LOAD_BODY_Z"]["SF"] == 1.62
    some["LOAD_BODY_X"]["SF"] = 55
    assert some["LOAD_BODY_Z"]["SF"] == 1.62 and some["LOAD_BODY_X"]["SF"] == 55
    assert [some.remove(name) for name in ("DATABASE_GLSTAT", "LOAD_BODY_X", "CONTACT_AUTOMATIC_SINGLE_SURFACE", "MAT_ELASTIC_PLASTIC_HYDRO")] == [1] * 4
    assert [block.name for block in some] == [name for name in names if name not in ("DATABASE_GLSTAT", "LOAD_BODY_X", "CONTACT_AUTOMATIC_SINGLE_SURFACE_ID", "MAT_010")]
    assert some["MAT_010_SPALL"]["MID"] == 2 and "CONTACT_SINGLE_SURFACE" not in some
    assert [block["MID"] for block in some["MAT_001"]] == [3, 4] and some["MAT_001_TITLE"]["MID"] == 4
    assert "SET_NODE_LIST" in some and "SET_NODE_LIST_GENERATE" not in some and "CONTROL_TIMESTEP" in some
    with pytest.raises(courant.CourantError, match="no \\*LOAD_BODY_X\n  hint: did you mean LOAD_BODY_Z"):
        some["LOAD_BODY_X"]


@pytest.mark.parametrize(("change", "message"), [
    (lambda one: one["MAT_ELASTC"], r"no \*MAT_ELASTC\n  hint: did you mean MAT_ELASTIC"),
    (lambda one: one["MAT_ELASTIC"]["EE"], r"plate.k:21: error: \*MAT_ELASTIC_TITLE: it has no field 'EE'\n  hint: did you mean E\?"),
    (lambda one: one["PART"]["MID"], "it has 2 sets of cards"),
    (lambda one: one["MAT_ELASTIC"].__setitem__("MID", 1.5), "MID is a whole number"),
    (lambda one: one["MAT_ELASTIC"].__setitem__("E", float("nan")), "E is a number, got nan"),
    (lambda one: one["MAT_ELASTIC"].__setitem__("MID", float("inf")), "MID is a number, got inf"),
    (lambda one: one["MAT_ELASTIC"].__setitem__("E", "abc"), "E is a number, got 'abc'"),
    (lambda one: one.parameters.__setitem__("e", float("nan")), "parameter e is a number, got nan"),
    (lambda one: one.parameters.__setitem__("e", "abc"), "parameter e is a number, got 'abc'"),
    (lambda one: one["PART"][0].sets[0].__setitem__("PID", 12345678901), "does not fit 10 columns"),
    (lambda one: one["SET_NODE_LIST"]["NID"], "NID is a list"),
    (lambda one: one.find("PART", MID=9), r"no sets of cards of \*PART have MID=9")])
def test_mistakes_are_named(tmp_path: Path, change: object, message: str) -> None:
    with pytest.raises(courant.CourantError, match=message):
        change(deck(tmp_path))  # type: ignore[operator]


def test_a_number_that_its_columns_cannot_hold_is_refused(tmp_path: Path) -> None:
    plate = deck(tmp_path, PLATE.replace("R        e      70e9I", "R        e      70e9I"))
    plate["CONTROL_TERMINATION"]["ENDTIM"] = 0.123456789
    assert abs(float(plate["CONTROL_TERMINATION"]["ENDTIM"]) / 0.123456789 - 1) < 1e-6
    with pytest.raises(courant.CourantError, match="does not fit 10 columns"):
        plate["CONTROL_TERMINATION"]["ENDTIM"] = -1.234567891e-123


@pytest.mark.parametrize(("lines", "columns"), [("*KEYWORD LONG=Y\n*MAT_ELASTIC", 20), ("*KEYWORD\n*MAT_ELASTIC +", 20), ("*KEYWORD I10=Y\n*MAT_ELASTIC", 10)])
def test_long_formats(tmp_path: Path, lines: str, columns: int) -> None:
    long = deck(tmp_path, lines + "\n" + "".join(word.rjust(columns) for word in ("3", "2700", "7e10", "0.3")) + "\n*END\n")
    assert long["MAT_ELASTIC"]["PR"] == 0.3
    long["MAT_ELASTIC"]["PR"] = 0.33
    assert "".join(word.rjust(columns) for word in ("3", "2700", "7e10", "0.33")) in long.text


@pytest.mark.parametrize("file", sorted(DECKS.glob("*.k")), ids=lambda file: file.stem)
def test_every_deck_comes_back_with_its_bytes(tmp_path: Path, file: Path) -> None:
    one = courant.Deck(file)
    assert one.text.encode("utf-8", "surrogateescape") == file.read_bytes()
    for block in one:
        if block.table:
            [dict(cards.items()) for cards in block.sets]


def test_includes_are_found_from_another_folder(tmp_path: Path) -> None:
    (tmp_path / "mesh.inc").write_text("*NODE\n       1             0.0             0.0             0.0\n")
    one = deck(tmp_path, "*KEYWORD\n*INCLUDE\nmesh.inc\n*END\n")
    assert one.includes[0].ids.tolist() == [1]
    (tmp_path / "run").mkdir()
    text = one.write(tmp_path / "run" / "plate.k").read_text()
    assert f"*INCLUDE_PATH\n{tmp_path}"[:60] in text and one.text == "*KEYWORD\n*INCLUDE\nmesh.inc\n*END\n"
    (tmp_path / "mesh.inc").unlink()
    with pytest.raises(courant.CourantError, match=r"plate.k:2: error: \*INCLUDE: 'mesh.inc' is not there"):
        one.includes


def test_values_of_fields() -> None:
    values = [blocks.value_of(text) for text in ("", " 3 ", "1.5", "5.0-1", "5.d-1", ".25E+0", "&e", "-7", "1e3")]
    assert values == [None, 3, 1.5, 0.5, 0.5, 0.25, "&e", -7, 1000.0]


@pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")
def test_a_changed_deck_runs(tmp_path: Path) -> None:
    scene = courant.Scene("drop", spacing=0.1, end=0.02).water(low=(0, 0), high=(0.4, 0.4))
    tank = courant.Deck(scene.write(tmp_path / "drop.k"))
    tank["CONTROL_TERMINATION"]["ENDTIM"] = 0.01
    assert tank.check().errors == 0
    run = tank.run(tmp_path / "out", threads=1, quiet=True)
    assert abs(run.summary["time"] - 0.01) < 0.005 and run.termination == "normal"
    tank.add("*PARAMETER\nR    steps      0.01")
    tank["CONTROL_TERMINATION"]["ENDTIM"] = "&steps"
    table = courant.sweep(tank, {"steps": [0.005, 0.01]}, tmp_path / "sweep", measure=lambda one: {"time": one.summary["time"]}, say=None)
    times = [row["time"] for row in table] if isinstance(table, list) else list(table["time"])
    assert times[0] < times[1] <= 0.012
    # particles that fall freely: the deck's gravity, doubled, over times that differ by a step
    tank["DEFINE_CURVE"][0].lines[-2:] = [line.replace("9.81", "19.62") for line in tank["DEFINE_CURVE"][0].lines[-2:]]
    twice = tank.run(tmp_path / "twice", threads=1, quiet=True)
    v = [np.mean(one.states[-1]["velocity"][:, 1]) for one in (run, twice)]
    assert v[0] < 0 and abs(v[1] / v[0] - 2) < 0.02
