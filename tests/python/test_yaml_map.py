"""Maps of recipes and suites: values, and every fault at its location."""

from __future__ import annotations

import numpy as np
import pytest
from courant.diagnostics import Diagnostic, Diagnostics, Location
from courant.units import Dimension, Units, parse_dimension
from courant.words import nearest_word, short_number, shortest
from courant.yaml_map import YamlMap, load_yaml, parse_yaml


def keys_of(text: str) -> tuple[YamlMap, Diagnostics]:
    diagnostics = Diagnostics()
    return YamlMap(parse_yaml(text, "F", diagnostics), "recipe", "F", diagnostics), diagnostics


def test_values():
    keys, diagnostics = keys_of("{a: 1.5e-3, b: word, c: [1, 2], d: yes, e: {from: 0, to: 1, step: 0.25}, f: ~, g: 3}")
    assert keys.number("a") == 0.0015 and keys.text("b") == "word" and keys.range("c") == (1, 2) and keys.flag("d")
    assert keys.places("e") == [0, 0.25, 0.5, 0.75, 1] and keys.places("g") == [3] and keys.places("c") == [1, 2]
    assert not keys.has("f") and keys.number("f", 7) == 7 and keys.get("nothing") is None
    assert keys.choice("b", ("other", "word")) == "word" and keys.choice("nothing", ("first", "second")) == "first"
    assert diagnostics.ok


@pytest.mark.parametrize("text", ["0x10", "1_0", "nan", ".inf", "1e400", "one", "", "1 2", "١"])
def test_what_is_no_number(text):
    keys, diagnostics = keys_of(f"a: '{text}'")
    assert keys.number("a", 5) == 5
    assert f"F:1:4: error: 'recipe.a' must be a number, got '{text}'" in diagnostics.text()


def test_all_faults_at_once_with_their_places():
    keys, diagnostics = keys_of("x: one\nv: -1\nfolde: 3\nx: 4\nr: [2, 1]\ns: [1]\np: {from: 1, to: 0, step: 0.1}\nl: 3\nc: q\n")
    keys.allow("x", "v", "folder", "r", "s", "p", "l", "c", "z")
    keys.number("x"), keys.positive("v"), keys.range("r"), keys.range("s"), keys.places("p"), keys.list("l"), keys.choice("c", ("a", "b"))
    keys.number("z", required=True)
    text = diagnostics.text()
    for expected in (
        "F:3:1: error: 'recipe' does not know the key 'folde'\n  hint: did you mean folder? known keys: x, v, folder,",
        "F:4:1: error: 'recipe.x' stands twice",
        "F:1:4: error: 'recipe.x' must be a number, got 'one'",
        "F:2:4: error: 'recipe.v' must be greater than 0, got -1",
        "F:5:4: error: 'recipe.r': the first number must be less than the second",
        "F:6:4: error: 'recipe.s' must be two numbers\n  hint: for example [0, 1.1]",
        "F:7:4: error: 'recipe.p' must go upwards in at most 100000 steps",
        "F:8:4: error: 'recipe.l' must be a list\n  hint: write [a, b, ...]",
        "F:9:4: error: 'recipe.c' cannot be 'q'\n  hint: it is one of a, b",
        "F:1:1: error: 'recipe' lacks the key 'z'",
    ):
        assert expected in text, expected


@pytest.mark.parametrize("text", ["[1, 2", "a: b: c", "\x00", "- \x07", "a: &x [*y]", "%%", "[" * 5000])
def test_what_is_no_yaml(text):
    diagnostics = Diagnostics()
    assert parse_yaml(text.encode(), "F", diagnostics) is None
    assert "error: not valid YAML: " in diagnostics.text()


def test_random_bytes_are_told_or_read():
    random, base = np.random.default_rng(11), bytearray(b"analyses:\n  - {kind: surface, name: a, x: [1, 2]}\nfolder: &f post\n")
    told = 0
    for _ in range(500):
        content = bytearray(base)
        for at in random.integers(0, len(content), random.integers(1, 5)):
            content[at] = random.integers(0, 256)
        diagnostics = Diagnostics()
        node = parse_yaml(bytes(content), "F", diagnostics)
        assert (node is None) == (not diagnostics.ok)
        told += node is None
    assert told > 50


def test_files_that_cannot_be_read(tmp_path):
    for file in (tmp_path, tmp_path / "no.yaml"):
        diagnostics = Diagnostics()
        assert load_yaml(file, "recipe", "what it is", diagnostics) is None
        assert diagnostics.text() == f"{file}: error: cannot read the recipe\n  hint: check the path; what it is\n"


def test_messages_are_presentable():
    diagnostics = Diagnostics()
    diagnostics.error(Location("a\x1b", 3), "b\x07" + "ä" * 600)
    assert diagnostics.text() == "a?:3: error: b?" + "ä" * 249 + "...\n"
    for _ in range(102):
        diagnostics.warning("f", "w")
    assert diagnostics.warnings == 102 and "2 more warnings are not shown" in diagnostics.text() and len(diagnostics.all) == 102
    assert Diagnostic("error", Location(), "m", "h").text() == "error: m\n  hint: h"


def test_words():
    assert nearest_word("surfce", ["probe", "surface"]) == "surface" and nearest_word("xyz", ["surface"]) == ""
    assert nearest_word("q", ["x"]) == "" and nearest_word("vx", ["vy"]) == "vy"
    assert (shortest(2.0), shortest(0.1), shortest(1e20)) == ("2", "0.1", "1e+20")
    assert short_number(0.30000000000000004) == "0.3" and short_number(-1e-15) == "0"


def test_units():
    si, other = Units(), Units("g", "mm", "ms")
    assert parse_dimension("ML2/T2") == Dimension(1, 2, -2) and parse_dimension("-") == Dimension()
    assert [si.of_text(d) for d in ("M/LT2", "ML/T2", "M/T2", "1/T", "-", "?", "L/T", "ML2/T2", "1/T2", "M/LT")] == [
        "Pa", "N", "N/m", "Hz", "-", "?", "m/s", "kg m2/s2", "1/s2", "kg/(m s)",
    ]  # fmt: skip
    assert other.of_text("M/LT2") == "g/(mm ms2)" and other.of_text("1/T") == "1/ms"
