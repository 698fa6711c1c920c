"""JSON schemas: all scenes, recipes and suites of the tree are valid, and wrong keys are found."""

from __future__ import annotations

import copy
import json
import random
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml
from courant.diagnostics import Diagnostics
from courant.key_tables import TABLES, keys
from courant.post.recipe import read_recipe
from courant.schema import schema
from courant.verify.suite import read_suite
from lsp_client import SOURCES

jsonschema = pytest.importorskip("jsonschema", reason="jsonschema is not there: apt-get install python3-jsonschema")
TREE = Path(__file__).resolve().parents[2]
FOLDERS = ("keyword_decks", "examples", "tests/verification", "tests/python")


def kind_of(content: Any) -> str:
    """By its keys; "" for another file."""
    if not isinstance(content, dict):
        return ""
    if "cases" in content:
        return "suite"
    if {"analyses", "probes", "jump", "snapshots", "views"} & set(content):
        return "recipe"
    return "scene" if {"water", "gases", "parts", "base"} & set(content) else ""


def content_of(file: Path) -> Any:
    try:
        return yaml.safe_load(file.read_text())
    except (yaml.YAMLError, UnicodeError):
        return None


FILES = [(kind, file) for folder in FOLDERS for file in sorted((TREE / folder).rglob("*.yaml")) if (kind := kind_of(content_of(file)))]


@pytest.fixture(scope="module")
def validators() -> dict[str, Any]:
    made = {kind: schema(kind) for kind in ("scene", "recipe", "suite")}
    for one in made.values():
        jsonschema.validators.validator_for(one).check_schema(one)
    return {kind: jsonschema.validators.validator_for(one)(one) for kind, one in made.items()}


def test_there_are_files_of_each_kind() -> None:
    counts = {kind: sum(one == kind for one, _ in FILES) for kind in ("scene", "recipe", "suite")}
    assert counts["scene"] > 30 and counts["recipe"] > 10 and counts["suite"] > 3, counts


@pytest.mark.parametrize(("kind", "file"), FILES, ids=lambda one: one.name if isinstance(one, Path) else one)
def test_files_of_the_tree_are_valid(validators: dict[str, Any], kind: str, file: Path) -> None:
    faults = [f"{'/'.join(map(str, one.absolute_path))}: {one.message[:300]}" for one in validators[kind].iter_errors(content_of(file))]
    assert not faults


def maps_of(content: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Paths of all maps in a file but free ones."""
    out = []
    if isinstance(content, dict):
        out.append(path)
        for key, value in content.items():
            out += maps_of(value, (*path, key)) if key not in FREE else []
    elif isinstance(content, list):
        for k, value in enumerate(content):
            out += maps_of(value, (*path, k))
    return out


# maps whose keys a user chooses, and values of several forms that the readers alone know
FREE = {"parameters", "sweep", "of", "at", "where", "surface", "layers", "behind", "toe", "jet", "upstream", "band", "average", "profile",
        "velocity", "spectrum", "pairs", "window", "fix", "to", "track", "hold", "turn", "scale", "force", "focus", "circle", "line", "mesh", "with", "about",
        "level", "runup", "flux", "plate", "gauges_of", "types", "tests", "keywords", "only", "normal", "decay_to", "cell"}  # fmt: skip


@pytest.mark.parametrize(("kind", "file"), FILES, ids=lambda one: one.name if isinstance(one, Path) else one)
def test_a_wrong_key_is_found_in_every_map(validators: dict[str, Any], kind: str, file: Path) -> None:
    content = content_of(file)
    for path in maps_of(content):
        changed = copy.deepcopy(content)
        inner = changed
        for step in path:
            inner = inner[step]
        if kind == "recipe" and "figures" in path and "chart" in inner:
            continue  # a chart has keys of its own
        inner["densty"] = 1
        assert not validators[kind].is_valid(changed), path


def test_what_the_schema_refuses_the_reader_refuses(tmp_path: Path, validators: dict[str, Any]) -> None:
    """A key taken from its map and misspelt: both find it, in recipes and suites."""
    random.seed(7)
    for kind, file in FILES:
        if kind == "scene":
            continue
        content = content_of(file)
        top = random.choice([key for key in content])
        content[f"{top}s_"] = content.pop(top)
        assert not validators[kind].is_valid(content)
        copy_of = file.parent / file.name
        text = yaml.safe_dump(content)
        other = tmp_path / copy_of.name
        other.write_text(text)
        diagnostics = Diagnostics()
        if kind == "recipe":
            read_recipe(other, diagnostics)
        else:
            read_suite(other, diagnostics)
        assert not diagnostics.ok


def test_every_table_is_reached() -> None:
    """A table that no schema leads to would go unnoticed."""
    text = "".join(json.dumps(schema(kind)) for kind in ("scene", "recipe", "suite"))
    for name, table in TABLES.items():
        assert all(f'"{key}"' in text for key in table), name


def test_two_tables_of_one_map_are_refused() -> None:
    keys("map of a test", "one text, two number!")
    with pytest.raises(ValueError, match="two tables"):
        keys("map of a test", "one text")
    del TABLES["map of a test"]


def test_the_call(tmp_path: Path) -> None:
    call = [sys.executable, "-m", "courant", "schema"]
    env = {"PYTHONPATH": str(SOURCES), "PATH": "/usr/bin:/bin"}
    made = subprocess.run([*call, "scene"], capture_output=True, text=True, env=env, timeout=60)
    assert made.returncode == 0 and json.loads(made.stdout)["title"] == "Courant scene"
    wrong = subprocess.run([*call, "scenes"], capture_output=True, text=True, env=env, timeout=60)
    assert wrong.returncode == 1 and "did you mean scene?" in wrong.stderr
    written = subprocess.run([*call, "suite", "-o", str(tmp_path / "suite.json")], capture_output=True, text=True, env=env, timeout=60)
    assert written.returncode == 0 and json.loads((tmp_path / "suite.json").read_text())["$defs"]["case"]
