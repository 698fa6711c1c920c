"""The language server: what it says of decks, by a client that speaks the protocol, and on texts of any kind."""

from __future__ import annotations

import random
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from courant.deck.tables import tables
from courant.lsp.deck_text import DeckText, Workspace
from courant.lsp.features import completions, definitions, hover, outline
from lsp_client import SOURCES, Client
from mixed_run import DECK, needs_courant

PLATE = """*KEYWORD
*TITLE
a block of \u00fcsual steel
*CONTROL_TERMINATION
     0.001
*PART
block
         1         3         2
*SECTION_SOLID
         3         1
*MAT_ELASTIC_TITLE
steel
         2   7.85e-9     2.1e5       0.3
*NODE
$#   nid               x               y               z
       1             0.0             0.0             0.0
       2             1.0             0.0             0.0
       3             1.0             1.0             0.0
       4             0.0             1.0             0.0
       5             0.0             0.0             1.0
       6             1.0             0.0             1.0
       7             1.0             1.0             1.0
       8             0.0             1.0             1.0
*ELEMENT_SOLID
       1       1       1       2       3       4       5       6       7       8
*INITIAL_VELOCITY
         4
       1.0
*SET_NODE_LIST
         4
         1         2         3         4
*LOAD_NODE_SET
         4         1         9
*DEFINE_CURVE
         9
                 0.0                 0.0
                 1.0                 1.0
*END
"""
LINES = PLATE.splitlines()


def at(text: str, words: str, k: int = 0) -> tuple[int, int]:
    """Line and column of some words."""
    line = [n for n, one in enumerate(text.splitlines()) if words in one][k]
    return line, text.splitlines()[line].index(words)


@pytest.fixture
def deck() -> DeckText:
    if not tables():
        pytest.skip("the program is not there")
    return DeckText(PLATE, "/nowhere/plate.k")


def test_hover_gives_meaning_dimension_and_state(deck: DeckText) -> None:
    known = Workspace()
    line, _ = at(PLATE, "7.85e-9")
    assert "RO" in hover(known, deck, line, 15) and "M/L3" in hover(known, deck, line, 15)
    line, _ = at(PLATE, "*MAT_ELASTIC_TITLE")
    assert "State: partly" in hover(known, deck, line, 3) and "Card 1" in hover(known, deck, line, 3)
    line, _ = at(PLATE, "         1         3         2")
    assert "material 2" in hover(known, deck, line, 27) and "MID" in hover(known, deck, line, 27)
    assert hover(known, deck, *at(PLATE, "block", 1)) == ""


@pytest.mark.parametrize(
    ("words", "column", "defined"),
    [
        ("         1         3         2", 15, "*SECTION_SOLID"),
        ("         1         3         2", 25, "*MAT_ELASTIC_TITLE"),
        ("       1       1       1       2", 12, "*PART"),
        ("       1       1       1       2", 20, "*NODE"),
        ("         4         1         9", 5, "*SET_NODE_LIST"),
        ("         4         1         9", 29, "*DEFINE_CURVE"),
    ],
)
def test_ids_lead_to_their_definition(deck: DeckText, words: str, column: int, defined: str) -> None:
    line, _ = at(PLATE, words)
    found = definitions(Workspace(), deck, line, column)
    assert len(found) == 1
    keyword = next(k for k in range(found[0].line, -1, -1) if LINES[k].startswith("*"))
    assert LINES[keyword] == defined


def test_definitions_in_included_files(deck: DeckText, tmp_path: Path) -> None:
    (tmp_path / "materials.inc").write_text("*MAT_ELASTIC\n         7   7.85e-9     2.1e5       0.3\n")
    text = "*KEYWORD\n*INCLUDE\nmaterials.inc\n*PART\nblock\n         1         3         7\n"
    main = DeckText(text, str(tmp_path / "main.k"))
    (found,) = definitions(Workspace(), main, 5, 28)
    assert found.file == str(tmp_path / "materials.inc") and found.line == 1


def test_keywords_and_fields_are_completed(deck: DeckText) -> None:
    offers = completions(Workspace(), DeckText("*MAT_PIECE", "a.k"), 0, 10)
    assert offers[0].text.startswith("*MAT_PIECEWISE_LINEAR_PLASTICITY") and (offers[0].begin, offers[0].end) == (0, 10)
    line, _ = at(PLATE, "         1         3         2")
    values = completions(Workspace(), deck, line, 30)
    assert any(one.text.strip() == "2" and "steel" in one.label for one in values)
    text = "*KEYWORD\n*MAT_ELASTIC\n\n"
    header = completions(Workspace(), DeckText(text, "a.k"), 2, 0)[0]
    assert header.text.split() == ["$#", "mid", "ro", "e", "pr", "da", "db"] or header.text.startswith("$#")
    choices = completions(Workspace(), DeckText("*KEYWORD\n*DATABASE_GLSTAT\n     0.001         2\n", "a.k"), 2, 20)
    assert [one.text.strip() for one in choices] == ["0", "1", "2", "3"]


def test_outline_is_by_keyword(deck: DeckText) -> None:
    symbols = outline(deck)
    assert [one.name for one in symbols] == [line.split()[0] for line in LINES if line.startswith("*")]
    nodes = next(one for one in symbols if one.name == "*NODE")
    assert nodes.detail == "8 of node" and len(nodes.children) == 8 and nodes.begin <= nodes.children[0].begin <= nodes.end


def test_texts_of_any_kind_have_answers(deck: DeckText) -> None:
    """Half-typed, damaged and foreign texts: no exception, and no position outside of the text."""
    random.seed(3)
    alphabet = "*$&<>,.+-eE 0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ_\n\t\r\x00\u00fc\U0001f600%="
    sources = [PLATE, DECK.read_text(errors="replace")]
    for _ in range(60):
        text = list(random.choice(sources)[: random.randrange(1, 4000)])
        for _ in range(random.randrange(40)):
            k = random.randrange(len(text))
            text[k : k + random.randrange(3)] = random.choices(alphabet, k=random.randrange(4))
            text = text or ["*"]
        made = DeckText("".join(text), "/nowhere/fuzz.k")
        known = Workspace()
        known.open[made.file] = made
        for symbol in outline(made):
            assert 0 <= symbol.begin <= symbol.end
        for _ in range(25):
            line, column = random.randrange(len(made.lines) + 2), random.randrange(90)
            hover(known, made, line, column)
            definitions(known, made, line, column)
            written = made.lines[line] if line < len(made.lines) else ""
            assert all(0 <= one.begin <= max(one.end, 0) and one.begin <= max(len(written), 0) for one in completions(known, made, line, column))


# ------------------------------------------------------------------------------------------------------------------------------ by the protocol


@pytest.fixture
def client(tmp_path: Path) -> Iterator[Client]:
    pytest.importorskip("pygls", reason="pygls is not there: pip install pygls")
    made = Client(tmp_path)
    yield made
    assert made.close() == 0


@needs_courant
def test_an_editor_is_served(client: Client, tmp_path: Path) -> None:
    path = tmp_path / "plate.k"
    path.write_text("*KEYWORD\n*END\n")  # what is checked is the text of the editor
    client.open(path, PLATE)
    assert [one for one in client.diagnostics(path) if one["severity"] == 1] == []
    wrong = PLATE.replace("         1         3         2", "         1         3        22")
    client.change(path, wrong, 2)
    faults = [one for one in client.diagnostics(path) if one["severity"] == 1]
    line, _ = at(wrong, "        22")
    assert faults and faults[0]["range"]["start"]["line"] == line and "22" in faults[0]["message"] and faults[0]["source"] == "courant"
    client.change(path, PLATE, 3)
    assert [one for one in client.diagnostics(path) if one["severity"] == 1] == []
    line, _ = at(PLATE, "7.85e-9")
    assert "M/L3" in client.at("hover", path, line, 15)["contents"]["value"]
    line, _ = at(PLATE, "         1         3         2")
    (where,) = client.at("definition", path, line, 28)
    assert where["uri"] == path.as_uri() and LINES[where["range"]["start"]["line"]].startswith("         2   7.85e-9")
    assert any("steel" in one["label"] for one in client.at("completion", path, line, 30))
    assert [one["name"] for one in client.symbols(path)][:2] == ["*KEYWORD", "*TITLE"]


@needs_courant
def test_messages_of_included_files_are_theirs(client: Client, tmp_path: Path) -> None:
    part = tmp_path / "materials.inc"
    part.write_text("*MAT_ELASTIC_TITLE\nsteel\n         2   7.85e-9     2.1e5       0.3\n")
    text = PLATE.replace("*MAT_ELASTIC_TITLE\nsteel\n         2   7.85e-9     2.1e5       0.3\n", "*INCLUDE\nmaterials.inc\n")
    main = tmp_path / "main.k"
    main.write_text(text)
    client.open(main, text)
    assert [one for one in client.diagnostics(main) if one["severity"] == 1] == []
    client.open(part, part.read_text().replace("0.3", "0.9"))
    faults = client.diagnostics(part)
    assert any(one["severity"] == 1 and one["range"]["start"]["line"] == 2 for one in faults)


def test_half_typed_decks_never_end_the_server(client: Client, tmp_path: Path) -> None:
    path = tmp_path / "typed.k"
    random.seed(5)
    client.open(path, "")
    for version, end in enumerate(sorted(random.sample(range(len(PLATE)), 20)), 2):
        text = PLATE[:end] + random.choice(["", "\x00", "*", ",,,", "&x", "\ud83d\ude00", "*INCLUDE\n/\n", "*" * 5000])
        client.change(path, text, version)
        line = text.count("\n")
        for what in ("hover", "definition", "completion"):
            client.at(what, path, line, len(text.rpartition("\n")[2]))
        client.symbols(path)
    assert client.process.poll() is None
    assert not [line for line in client.errors if "Traceback" in line], "".join(client.errors)


def test_without_pygls_there_is_a_message() -> None:
    code = "import sys; sys.modules['pygls'] = None; sys.path.insert(0, sys.argv[1]); from courant.lsp.command import main; sys.exit(main([]))"
    made = subprocess.run([sys.executable, "-c", code, str(SOURCES)], capture_output=True, text=True, timeout=60)
    assert made.returncode == 3 and "pip install pygls" in made.stderr and "COURANT_PYTHON" in made.stderr
