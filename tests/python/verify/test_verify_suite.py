"""Suites are read whole, and every fault is reported at its location before anything is run."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from courant.diagnostics import Diagnostics
from courant.verify.driver import Options, Verification
from courant.verify.model import Suite
from courant.verify.plan import PlannedRun, folder_name, plan_runs
from courant.verify.reference import read_table
from courant.verify.scene import scene_files, scene_values
from courant.verify.suite import read_suite

SCENE = """
title: a square
parameters: {n: 4, dx: 1 / n, g: 9.81, c0: 10}
parts:
  - {id: 1, section: 1, material: 1, lattices: [{low: [0, 0], high: [1, 1], spacing: dx}]}
"""
HEAD = "cases:\n  - name: one\n    scene: scene.yaml\n"
OBSERVING = HEAD + "    observations:\n      - "
WITH_N = "    resolution: n\n    resolutions: [4, 8]\n"


def read(folder: Path, text: str, executable: Path | None = None) -> tuple[Suite, str, list[PlannedRun]]:
    """The suite, what is said about it without the folder's name, and its runs."""
    (folder / "scene.yaml").write_text(SCENE)
    (folder / "table.csv").write_text("t,y\n0,1\n1,2\n")
    (folder / "suite.yaml").write_text(text)
    diagnostics = Diagnostics()
    suite = read_suite(folder / "suite.yaml", diagnostics)
    runs = []
    if diagnostics.ok:
        made = Verification(suite, Options(folder / "out", executable)) if executable else None
        runs = plan_runs(suite, lambda run, k: made.generate(run, folder / f"{k}.k") if made else [], 2, diagnostics)
    return suite, diagnostics.text().replace(f"{folder}/", ""), runs


def test_all_keys(tmp_path: Path) -> None:
    suite, said, runs = read(
        tmp_path,
        """
title: everything
about: for the test
time_limit: 60
cases:
  - name: one
    title: first
    about: nothing
    scene: scene.yaml
    parameters: {g: 1e-3}
    resolution: n
    resolutions: [2, 4, 8]
    size: dx
    time_limit: 10
    settings:
      - {name: slow, parameters: {c0: 100}, resolutions: [2, 4, 5, 10]}
      - name: fast
    observations:
      - {name: a, title: A, unit: m, of: global/kinetic / 2 + parts/1/mass, take: at, at: 2 * dx, from: 0, to: 1,
         reference: {csv: table.csv, csv_x: t, csv_y: 2, scale_x: g, scale_y: 2, offset_x: 1, offset_y: dx, source: made up},
         scale: g, bound: 0.1, bound_settings: [fast], least_order: 1}
      - {name: b, kind: particles, of: vx * m, where: x - 0.5, reduce: p99, take: curve, norm: linf, reference: t * g}
      - {name: c, kind: profile, of: p, along: y, at: 1, reference: finest}
      - {name: d, of: contacts/1/force.y, take: period, reference: {formula: 2 * pi / g}}
      - {name: e, of: -global/total / 2, take: decay, reference: {finest: true, source: our own}}
    picture_of: p
    picture_title: pressure
    picture_at: 1
    picture_where: 0.5 - y
  - name: two
    scene: scene.yaml
    observations: [{name: growth, of: global/kinetic, take: growth}]
    stability:
      sweep: {c0: [10, 20], n: [2, 4, 8]}
      limits: [{name: energy, value: growth + residual, at_most: 2 * g}]
      must_be_stable: 15 - c0
      must_stop: c0 - 15
""",
    )
    assert said == ""
    one, two = suite.cases
    assert (one.time_limit, two.time_limit, one.parameters, one.picture_where) == (10, 60, {"g": "1e-3"}, "0.5 - y")
    a = one.observations[0]
    assert (a.reference.kind, a.reference.csv.name, a.reference.scale_x, a.reference.offset_y) == ("csv", "table.csv", "g", "dx")
    assert (a.bound, a.least_order, a.bound_settings) == (0.1, 1, ["fast"])
    assert [o.reference.kind for o in one.observations[1:]] == ["formula", "finest", "formula", "finest"]
    assert [o.kind for o in one.observations] == ["history", "particles", "profile", "history", "history"]
    assert two.stability.limits[0].at_most == "2 * g"
    assert len(runs) == 4 + 3 + 6
    assert (runs[0].setting, runs[3].resolution, runs[3].finest, runs[2].finest) == ("slow", "10", True, False)
    assert runs[3].size == pytest.approx(0.1)
    assert runs[3].parameters == {"c0": "100", "g": "1e-3", "n": "10"}
    assert runs[3].variables["g"] == pytest.approx(1e-3)
    assert [run.setting for run in runs[7:9]] == ["c0 = 10, n = 2", "c0 = 10, n = 4"]
    assert len({run.folder for run in runs}) == 13


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("title: x\n", "suite.yaml:1:1: error: 'suite' lacks the key 'cases'\n"),
        ("cases: []\n", "suite.yaml:1:1: error: the suite has no cases\n"),
        (
            OBSERVING + "{name: a, of: global/kinetic, take: finl}\n",
            "suite.yaml:5:45: error: 'observation.take' cannot be 'finl'\n  hint: did you mean final? it is one of curve, final, mean, min, max, at, "
            "period, decay, slope, growth\n",
        ),
        (
            "cases:\n  - name: one\n    scene: secne.yaml\n    observations: [{name: a, of: t}]\n",
            "suite.yaml:3:12: error: 'case.scene': there is no file 'secne.yaml'\n  hint: paths count from the folder of the suite\n",
        ),
        (OBSERVING + "{name: a, of: global/kinetic / rho}\n", "suite.yaml:5:23: error: 'observation.of': unknown name 'rho'\n"),
        (
            OBSERVING + "{name: a, kind: particles, of: p / dz}\n",
            "suite.yaml:5:40: error: 'observation.of': unknown name 'dz'\n  hint: did you mean z?\n",
        ),
        (
            OBSERVING + "{name: a, of: kinetic}\n",
            "suite.yaml:5:23: error: 'observation.of': unknown name 'kinetic'\n  hint: histories are named like global/kinetic, parts/1/mass or "
            "contacts/1/force.y\n",
        ),
    ],
)
def test_faults_have_their_place(tmp_path: Path, text: str, said: str) -> None:
    assert read(tmp_path, text)[1] == said


def test_faults_begin_with_their_place(tmp_path: Path) -> None:
    assert read(tmp_path, "cases: [")[1].startswith("suite.yaml:")
    assert read(tmp_path, OBSERVING + "{name: a, of: global/kinetic, refernce: 1}\n")[1].startswith(
        "suite.yaml:5:39: error: 'observation' does not know the key 'refernce'\n  hint: did you mean reference? known keys: name, title, "
    )


FAULTS = [
    (HEAD, "the case observes nothing"),
    (OBSERVING + "{name: a b, of: t}\n", "'observation.name' is a word"),
    (OBSERVING + "{name: a, of: t}\n      - {name: a, of: t}\n", "two observations are called 'a'"),
    (OBSERVING + "{name: a, of: t}\n" + HEAD[7:] + "    observations: [{name: a, of: t}]\n", "two cases are called 'one'"),
    (OBSERVING + "{name: a, of: t, where: x}\n", "'where' belongs to particles"),
    (OBSERVING + "{name: a, of: t, along: x}\n", "'along' belongs to profiles"),
    (OBSERVING + "{name: a, of: t, reduce: sum}\n", "'reduce' belongs to kind: particles"),
    (OBSERVING + "{name: a, of: t, empty: 0}\n", "'empty' belongs to kind: particles"),
    (OBSERVING + "{name: a, of: t, bins: 4}\n", "'bins' belongs to profiles"),
    (OBSERVING + "{name: a, of: t, bed: 1}\n", "'bed' belongs to kind: surface"),
    (OBSERVING + "{name: a, kind: particles, of: t, x: 1}\n", "'x' belongs to kind: surface"),
    (OBSERVING + "{name: a, kind: surface}\n", "lacks the key 'x'"),
    (OBSERVING + "{name: a, kind: surface, x: 1, of: t}\n", "'of' belongs to other kinds"),
    (OBSERVING + "{name: a, kind: surface, x: vx}\n", "unknown name 'vx'"),
    (OBSERVING + "{name: a, kind: profile, of: p, along: x, bins: 2.5}\n", "must be a whole number"),
    (OBSERVING + "{name: a, kind: profile, of: p, along: x, bins: 4, take: max, reference: y}\n", "unknown name 'y'"),
    (OBSERVING + "{name: a, of: t, reference: 1, align: 1}\n", "'align' belongs to curves against a csv"),
    (OBSERVING + "{name: a, kind: profile, of: p}\n", "lacks the key 'along'"),
    (OBSERVING + "{name: a, kind: profile, of: p, along: x, take: max}\n", "can only be taken as a curve"),
    (OBSERVING + "{name: a, of: t, take: at}\n", "needs the moment 'at'"),
    (OBSERVING + "{name: a, of: t, at: 1}\n", "'at' belongs to 'take: at'"),
    (OBSERVING + "{name: a, of: t, bound: 1}\n", "'bound' needs a 'reference'"),
    (OBSERVING + "{name: a, of: t, reference: 1, bound: -1}\n", "must be greater than 0"),
    (OBSERVING + "{name: a, of: t, reference: 1, bound: 1, bound_settings: [x]}\n", "which is no setting"),
    (OBSERVING + "{name: a, of: t, take: max, reference: t}\n", "unknown name 't'"),
    (OBSERVING + "{name: a, of: t, reference: finest}\n", "has one run"),
    (OBSERVING + "{name: a, of: t, reference: {formula: 1, finest: true}}\n", "has one of"),
    (OBSERVING + "{name: a, of: t, reference: {formula: 1, csv_x: 2}}\n", "'reference.csv_x' belongs to a csv"),
    (OBSERVING + "{name: a, of: t, reference: {csv: table.csv, csv_x: T}}\n", "has no column 'T'"),
    (OBSERVING + "{name: a, of: t, reference: 1, least_order: 1}\n", "needs 2 resolutions"),
    (OBSERVING + "{name: a, of: t}\n    picture_title: x\n", "needs 'picture_of'"),
    (OBSERVING + "{name: a, of: t}\n    resolutions: [1]\n", "the parameter that they are values of"),
    (OBSERVING + "{name: a, of: t}\n    resolution: n\n", "has no resolutions"),
    (OBSERVING + "{name: a, of: t}\n    resolution: n\n    resolutions: [8, 4]\n    size: dx\n", "not less than"),
    (OBSERVING + "{name: a, of: t}\n    resolution: n\n    resolutions: [4]\n    size: dx - 1\n", "'size' must be > 0, got -0.75"),
    (OBSERVING + "{name: a, of: t}\n    settings: [{name: a}, {name: a}]\n", "two settings are called 'a'"),
    (OBSERVING + "{name: a, of: t}\n    title: x\n    title: y\n", "stands twice"),
    (OBSERVING + "{name: a, of: t, reference: 1, least_order: 1}\n" + WITH_N, "needs the 'size'"),
    (HEAD + "    stability: {}\n", "needs a 'sweep' or several settings"),
    (HEAD + "    stability: {sweep: {n: [2]}}\n" + WITH_N, "has no 'resolution'"),
    (HEAD + "    stability: {sweep: {n: []}}\n", "swept over no values"),
    (HEAD + "    stability: {sweep: {n: [2], g: [1], c0: [1]}}\n", "at most two"),
    (HEAD + "    stability: {sweep: {n: [2]}, limits: [{name: a, value: residua, at_most: 1}]}\n", "did you mean residual?"),
    (
        OBSERVING + "{name: a, of: t, reference: 1, bound: 1}\n    stability: {sweep: {n: [2]}}\n",
        "bounds of a stability case are its limits",
    ),
]


@pytest.mark.parametrize(("text", "words"), FAULTS)
def test_keys_that_do_not_fit(tmp_path: Path, text: str, words: str) -> None:
    said = read(tmp_path, text)[1]
    assert words in said
    assert said.startswith(("suite.yaml:", "table.csv:"))


@pytest.mark.parametrize(("parameters", "words"), [("{gg: 1}", "no such parameter"), ("{n: 4.5}", "not a whole number")])
def test_faults_of_the_scene_are_those_of_generate(tmp_path: Path, executable: Path, parameters: str, words: str) -> None:
    said = read(tmp_path, OBSERVING + f"{{name: a, of: t}}\n    parameters: {parameters}\n", executable)[1]
    assert said.startswith("suite.yaml:2:5: error: case one, default: ")
    assert words in said


def test_parameters_of_scenes_and_bases(tmp_path: Path) -> None:
    (tmp_path / "base.yaml").write_text("parameters: {a: 2, b: a * own, c: 7}\n")
    scene = tmp_path / "scene.yaml"
    scene.write_text("base: base.yaml\nparameters: {own: a + 1, c: own * 2, d: 1e-3}\n")
    values = scene_values(scene, {})
    assert values is not None
    del values["pi"]
    assert values == pytest.approx({"a": 2, "own": 3, "b": 6, "c": 6, "d": 1e-3})
    assert scene_values(scene, {"own": "10"})["b"] == 20, "what is given goes before what stands in the file"
    assert scene_values(scene, {"x": "1"}) is None
    scene.write_text("base: none.yaml\n")
    assert scene_values(scene, {}) is None


def test_bases_of_bases(tmp_path: Path) -> None:
    (tmp_path / "lowest.yaml").write_text("parameters: {a: 2, b: a * own, c: 7}\n")
    (tmp_path / "base.yaml").write_text("base: lowest.yaml\nparameters: {c: 5, e: b + late}\n")
    (tmp_path / "other.yaml").write_text("base: lowest.yaml\nparameters: {f: a}\n")
    scene = tmp_path / "scene.yaml"
    scene.write_text("base: [base.yaml, other.yaml]\nparameters: {own: 3, late: b + c}\n")
    values = scene_values(scene, {})
    assert values is not None
    del values["pi"]
    assert values == pytest.approx({"a": 2, "b": 6, "c": 5, "own": 3, "late": 11, "e": 17, "f": 2})
    assert [file.name for file in scene_files(scene)] == ["scene.yaml", "lowest.yaml", "base.yaml", "other.yaml"]
    (tmp_path / "lowest.yaml").write_text("base: base.yaml\n")
    assert scene_values(scene, {}) is None, "a base of itself"


SUITES = [file for file in sorted(Path(__file__).parents[2].glob("verification/*.yaml")) if "\ncases:" in file.read_text()]


@pytest.mark.parametrize("file", SUITES, ids=lambda file: file.stem)
def test_suites_of_the_project_can_be_read(file: Path) -> None:
    diagnostics = Diagnostics()
    suite = read_suite(file, diagnostics)
    assert diagnostics.ok, diagnostics.text()
    assert plan_runs(suite, lambda run, k: [], 1, diagnostics) and diagnostics.ok, diagnostics.text()


def test_folders_have_names_of_their_own() -> None:
    taken: set[str] = set()
    assert [folder_name(text, taken) for text in ("h/dx 2, a", "h dx 2; a", ".", "")] == ["h_dx_2_a", "h_dx_2_a_2", "_.", "_"]


@pytest.mark.parametrize(
    ("text", "x", "y", "said"),
    [
        ("a,b\n1,2\n3,4\n", "a", "b", ""),
        ("1 2\n3 4\n", "1", "2", ""),
        ("a,b\n1,2\n3,4\n", "a", "c", "the table has no column 'c'"),
        ("1,2\n3,4\n", "1", "3", "the table has no column '3'"),
        ("a,b\n1,x\n3,4\n", "a", "b", "expected a number, got 'x'"),
        ("a,b\n1,2\n3,\n", "a", "b", "the table has fewer than two rows with both columns"),
    ],
)
def test_tables_and_their_faults(tmp_path: Path, text: str, x: str, y: str, said: str) -> None:
    (tmp_path / "t.csv").write_text(text)
    diagnostics = Diagnostics()
    read_table(tmp_path / "t.csv", x, y, diagnostics)
    assert "".join(one.message for one in diagnostics.all[:1]) == said


def test_rows_of_a_table_are_sorted_and_averaged(tmp_path: Path) -> None:
    (tmp_path / "u.csv").write_text("kind,x,y\nA,2,5\nB,2,7\nC,1,0\n")
    table = read_table(tmp_path / "u.csv", "x", "y", Diagnostics())
    assert (table.x.tolist(), table.y.tolist()) == ([1, 2], [0, 6])
    missing = Diagnostics()
    assert len(read_table(tmp_path / "none.csv", "1", "2", missing)) == 0
    assert not missing.ok


def test_damaged_suites_and_tables_are_told_not_crashed_on(tmp_path: Path) -> None:
    chance = random.Random(7)
    whole = OBSERVING + "{name: a, of: global/kinetic, take: at, at: 2 * dx, reference: {csv: table.csv}, bound: 0.1}\n" + WITH_N
    for _ in range(300):
        data = bytearray(whole.encode())
        for _ in range(chance.randrange(1, 6)):
            at = chance.randrange(len(data))
            data[at : at + chance.randrange(3)] = chance.choice(
                [b"", b"{", b"]", b":", b"\x00", b"\xff", b"&a", b"*a", b"1e999", b"\n", b"'"]
            )
        (tmp_path / "suite.yaml").write_bytes(bytes(data))
        (tmp_path / "scene.yaml").write_text(SCENE)
        table = bytearray(b"t,y\n0,1\n1,2\n")
        table[chance.randrange(len(table))] = chance.randrange(256)
        (tmp_path / "table.csv").write_bytes(bytes(table))
        diagnostics = Diagnostics()
        suite = read_suite(tmp_path / "suite.yaml", diagnostics)
        if diagnostics.ok:
            plan_runs(suite, lambda run, k: [], 1, diagnostics)
        assert all(one.message for one in diagnostics.all)
