"""Recipes: what they hold, and their faults with locations and hints."""

from __future__ import annotations

from pathlib import Path

import pytest
from courant.diagnostics import Diagnostics
from courant.post.recipe import read_recipe

DECKS = Path(__file__).resolve().parents[2] / "keyword_decks" / "hydraulic_jump"
RECIPES = ("bed_and_volume", "paper_figures", "post", "standing_figures", "study")


def messages(folder, text: str) -> str:
    file = folder / "recipe.yaml"
    file.write_text(text)
    diagnostics = Diagnostics()
    assert read_recipe(file, diagnostics) is None
    return diagnostics.text().replace(str(file), "R")


@pytest.mark.parametrize("name", RECIPES)
def test_the_recipes_of_the_jump_are_sound(name):
    diagnostics = Diagnostics()
    assert read_recipe(DECKS / f"{name}.yaml", diagnostics), diagnostics.text()


def test_the_papers_recipes():
    recipe = read_recipe(DECKS / "paper_figures.yaml", Diagnostics())
    assert len(recipe.analyses) == 11 and len(recipe.figures) == 13 and recipe.folder == "paper" and recipe.formats == ["png", "svg"]
    recipe = read_recipe(DECKS / "post.yaml", Diagnostics())
    assert len(recipe.jump.published) == 5 and recipe.jump.published[3].A == 0.936 and recipe.jump.published[4].interval == (15, 30)
    assert recipe.snapshots.times == [0, 1, 2, 3, 4, 5] and recipe.jump.toe_threshold == 2.5


def test_all_faults_at_once_with_their_places(tmp_path):
    text = messages(tmp_path, "jump:\n  x: one\n  v1: -1.5\n  dd1: 0.02\n  intervals: [[5, 2.5]]\nsnapshots: {times: 3}\n")
    for expected in (
        "R:2:6: error: 'jump.x' must be a number, got 'one'",
        "R:3:7: error: 'jump.v1' must be greater than 0",
        "R:4:3: error: 'jump' does not know the key 'dd1'",
        "'jump' lacks the key 'd1'",
        "R:5:15: error: 'jump.intervals': the first number must be less",
        "R:6:20: error: 'snapshots.times' must be a list",
    ):
        assert expected in text, expected


KINDS = "probe, surface, grid, profile, spectrum, flux, history, force, toe, roller, jump_type, drop_regime, gauges, correlation, mass_balance, soundness, surface_mesh"


@pytest.mark.parametrize(
    "entry, expected",
    [
        ("kind: surface, x: 1", "R:2:5: error: 'analyses' lacks the key 'name'\n"),
        ("kind: surfce, name: a, x: 1", f"R:2:12: error: there is no kind of analysis 'surfce'\n  hint: did you mean surface? kinds: {KINDS}\n"),
        (
            "kind: surface, name: a/b, x: 1",
            "R:2:27: error: the name 'a/b' of an analysis must be of letters, digits, - and _\n  hint: files are named after it\n",
        ),
        ("kind: surface, name: a, x: {from: 1, to: 0, step: 0.1}", "R:2:33: error: 'a.x' must go upwards in at most 100000 steps\n"),
        (
            "kind: spectrum, name: s, of: depth",
            "R:2:35: error: 's.of': there is no analysis 'depth' above it\n  hint: analyses are worked through from top to bottom\n",
        ),
        (
            "kind: profile, name: p, of: [u], x: 1, y: 1",
            "R:2:35: error: 'p.of': unknown name 'u'\n  hint: it may use x, y, z, vx, vy, vz, speed, p, rho, h, m, V, e, part, id, active, t, vorticity\n",
        ),
        (
            "kind: profile, name: p, of: [p], x: 1, y: 1, interpolation: msl",
            "R:2:66: error: 'p.interpolation' cannot be 'msl'\n  hint: did you mean mls? it is one of shepard, mls\n",
        ),
        (
            "kind: surface, name: a, x: 1, link: 3",
            "R:2:42: error: 'a.link' must be at most 2, got 3\n  hint: particles further apart than 2 h do not know each other\n",
        ),
        ("kind: surface, name: a, x: 1, from: 2, to: 2", "R:2:42: error: 'a.from' must be less than 'to'\n"),
        ("kind: force, name: f", "R:2:5: error: 'f' names neither contacts nor bodies\n  hint: for example contacts: [1]\n"),
        (
            "kind: history, name: h, of: [contacts/1/force.w]",
            "R:2:35: error: 'h.of' must name a dataset of history.h5, got 'contacts/1/force.w'\n  hint: for example contacts/1/force.x or global/kinetic\n",
        ),
        ("kind: profile, name: p, of: [p], x: 1, y: 1, states: true", "R:2:59: error: 'p.states' must be true or false, and of a grid\n"),
    ],
)
def test_faults_of_analyses_with_their_places(tmp_path, entry, expected):
    assert messages(tmp_path, "analyses:\n  - {" + entry + "}\n") == expected


@pytest.mark.parametrize(
    "text, expected",
    [
        (
            "folder: ../out\nanalyses: [{kind: surface, name: a, x: 1}]\n",
            "R:1:9: error: 'recipe.folder' must be a folder within the run's\n  hint: for example post\n",
        ),
        ("jump: [1, 2\n", "error: not valid YAML: "),
        ("case: d1/4\n", "R:1:1: error: the recipe asks for nothing\n  hint: add one of: probes, jump, snapshots, analyses, views\n"),
        ("", "'recipe' must be a map of keys and values"),
        ("analyses: [{kind: toe, name: a, of: a, depth: 1}, {kind: force, name: a, bodies: [1]}]", "two analyses are named 'a'"),
        ("figures: [{name: f}]\nformats: [gif]\nanalyses: [{kind: force, name: a, bodies: [1]}]", "the figure 'f' shows nothing\n  hint: add curves"),
        ("formats: [gif]\nanalyses: [{kind: force, name: a, bodies: [1]}]", "R:1:11: error: 'recipe.formats' cannot be 'gif'"),
        ("figures: [{name: f, chart: pie}]", "R:1:28: error: there is no chart 'pie'"),
        ("figures: [{name: f, curves: [{table: t, x: a, y: b}], references: [{x: 1, y: 2}]}]", "'references' needs one of formula, points, x and y"),
    ],
)
def test_faults_of_the_whole(tmp_path, text, expected):
    assert expected in messages(tmp_path, text)


def test_files_that_are_none(tmp_path):
    for file in (tmp_path, tmp_path / "no.yaml"):
        diagnostics = Diagnostics()
        assert read_recipe(file, diagnostics) is None
        assert f"{file}: error: cannot read the recipe" in diagnostics.text()
