"""Pages on runs: what they show of made runs and of one with each kind of element, and what they refuse."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import courant
import numpy as np
import pytest
from courant.report.command import main, results_of
from courant.report.kinds import KINDS
from courant.report.sources import Sources, thinned
from made_runs import frame, lattice, write_history, write_run
from mixed_run import DECK, needs_courant, run

pytest.importorskip("matplotlib")
T = np.linspace(0.0, 1.0, 11)
ROWS = "force", "ML/T2"


def _vector(x: float, rows: np.ndarray = T) -> np.ndarray:
    return np.column_stack([x * rows, 0 * rows, -2 * x * rows])


def _histories(folder: Path, datasets: dict[str, tuple[np.ndarray, str]]) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    energies = {"kinetic": 3 - T, "internal": T, "hourglass": 0 * T, "total": 3 + 0 * T}
    write_history(folder, {"/global/time": (T, "T"), "/global/dt": (0.1 + 0 * T, "T"), **{f"/global/{k}": (v, "ML2/T2") for k, v in energies.items()}, **datasets})
    (folder / "summary.yaml").write_text("title: made\nversion: 1\nverdict: sound\nsteps: 100\nunits: {mass: t, length: mm, time: s}\n")


def _page(*folders: Path, words: tuple[str, ...] = ()) -> str:
    """The text of the page without its pictures; their captions stay."""
    assert main([*map(str, folders), *words]) == 0
    page = (folders[0] / "report.html").read_text()
    return re.sub(r"<[^>]+>", " ", re.sub(r"<style>.*?</style>", "", page, flags=re.DOTALL))


def test_kinds_have_titles_of_their_own_and_know_every_ascii_history():
    assert len({kind.title for kind in KINDS}) == len(KINDS)
    assert set(courant.ascii_histories.ASCII_NAMES) - {"glstat"} == {kind.file for kind in KINDS} - {""}
    order = [kind.file for kind in KINDS]
    assert order.index("rwforc") < order.index("rcforc") < order.index("spcforc") < order.index("secforc") < order.index("jntforc") < order.index("swforc")
    assert order.index("deforc") < order.index("rbdout") < order.index("nodout")


def test_all_groups_of_the_histories_are_on_the_page(tmp_path, capsys):
    known = {"rigid_walls", "contacts", "held_particles", "sections", "joints", "welds", "springs", "rigid_bodies", "gauges", "nodes"}
    assert known < {group for kind in KINDS for group in kind.groups}
    groups = [group for kind in KINDS for group in kind.groups if kind.file not in ("elout", "trhist", "sphout", "sleout", "swforc", "deforc", "matsum", "")]
    some = {f"/{group}/7/{'moment' if 'rotations' in group else 'force'}": (_vector(5.0), "ML/T2") for group in groups if group not in ("nodes", "rigid_bodies")}
    some |= {f"/{group}/7/displacement": (_vector(5.0), "L") for group in ("nodes", "rigid_bodies")}
    some |= {"/welds/7/axial": (T, "ML/T2"), "/springs/7/resultant": (T, "ML/T2"), "/gauges/wave/time": (T, "T"), "/gauges/wave/level": (T, "L")}
    some |= {"/solids/7/stress": (np.column_stack([T] + 5 * [0 * T]), "M/LT2"), "/particles/7/p": (T, "M/LT2"), "/tracers/7/v": (_vector(1.0), "L/T")}
    some |= {"/parts/7/internal": (T, "ML2/T2"), "/of_my_own/7/thing": (T, "L")}
    _histories(tmp_path / "run", some)
    text = _page(tmp_path / "run")
    for kind in KINDS:
        assert (kind.title in text) == (kind.file != "sleout"), kind.title
    assert "Of my own" in text and "von Mises stress" in text and "The run has written none" not in text
    titles = "Forces on rigid walls", "Contact forces", "Forces of supports", "Forces in joints", "Rigid bodies", "Motion of nodes"
    order = [text.index(f"{title} ") for title in titles]
    assert order == sorted(order)
    assert "11.18" in text and " N " in text and "force [" not in text  # |(5, 0, -10)|, in the units of the run


def test_a_run_without_histories_and_curves_that_are_zero(tmp_path, capsys):
    _histories(tmp_path / "run", {})
    text = _page(tmp_path / "run")
    assert "The run has written none" in text and "zero all the time, and not drawn: hourglass" in text
    _histories(tmp_path / "zero", {"/joints/3/force": (_vector(0.0), "ML/T2"), "/joints/4/force": (_vector(1.0), "ML/T2")})
    text = _page(tmp_path / "zero")
    assert "not drawn: joint 3: force" in text and "joint 4: force" in text


def test_of_many_the_largest_are_drawn_and_the_others_named(tmp_path, capsys):
    _histories(tmp_path / "run", {f"/joints/{k}/force": (_vector(float(k)), "ML/T2") for k in range(1, 31)})
    text = _page(tmp_path / "run")
    assert "joint: of 30 the 4 with the largest values are drawn; all are in history.h5 (/joints)" in text
    assert "joint 30: force" in text and "joint 26: force" not in text


def test_supports_are_summed(tmp_path):
    _histories(tmp_path, {f"/held_particles/{k}/force": (_vector(float(k)), "ML/T2") for k in (1, 2)})
    text = _page(tmp_path)
    assert "all supported nodes (2)" in text


RWFORC = """ a wall
                         courant 0.2.0                             date 12/01/2026

   time        wall#  normal-force     x-force        y-force        z-force
  0.00000E+00      1  0.0000000E+00  0.0000000E+00  0.0000000E+00  0.0000000E+00
   time        wall#  normal-force     x-force        y-force        z-force
  1.00000E+00      1  4.0000000E+00  0.0000000E+00  0.0000000E+00 -4.0000000E+00
"""


def _killed(folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "rwforc").write_text(RWFORC)
    log = "Courant 0.2.0\ndeck d.k: a wall\nd.k:3:1: warning: something\n  hint: do it\n     100 t 5.0E-01 dt 1.0E-02 write field state 1\n"
    (folder / "messag").write_text(log)
    return folder


def test_a_killed_run_shows_its_text_files(tmp_path):
    text = _page(_killed(tmp_path / "run"))
    assert "it goes on, or was killed. messag ends at step 100, t = 0.5 T" in text and "no restart file" in text
    assert "wall 1: force" in text and "from rwforc" in text and "hint: do it" in text
    assert "the run has written no states" in text and "fields.pvd names" not in text
    (tmp_path / "run/restart").mkdir()
    (tmp_path / "run/restart/d3dump01.h5").write_text("")
    assert "goes on from restart/d3dump01.h5" in _page(tmp_path / "run")
    with pytest.raises(courant.CourantError, match="killed"):
        _ = courant.open(tmp_path / "run").histories


_FOREIGN = [{}, {"a.txt": "x"}, {"messag": "Nov 3 kernel: x"}, {"summary.yaml": "a: 1"}, {"d3plot": "", "binout0000": "", "history.h5": "x"}]


@pytest.mark.parametrize("content", _FOREIGN)
def test_empty_and_foreign_folders_are_refused(tmp_path, capsys, content):
    for name, text in content.items():
        (tmp_path / name).write_text(text)
    assert main([str(tmp_path)]) == 1
    assert "no results of a run here" in capsys.readouterr().err
    assert {file.name for file in tmp_path.iterdir()} == set(content)


@pytest.mark.parametrize("wrong", ["warnings: 5", "passes: {a: 1}", "energy: [1]", "verdict_reasons: yes", "time: soon", "counters: 3", "- a list", "5"])
def test_a_summary_of_wrong_types_is_a_message(tmp_path, capsys, wrong):
    _killed(tmp_path)
    (tmp_path / "summary.yaml").write_text(wrong + "\n")
    run = courant.open(tmp_path)
    with pytest.raises(courant.CourantError, match="not the summary of a run"):
        _ = run.verdict
    assert "not the summary of a run" in _page(tmp_path)
    (tmp_path / "summary.yaml").write_text("dt_min: 1e-06\ntime: 1.5\nwarnings:\ncounters: {}\n")
    assert courant.open(tmp_path).summary["time"] == 1.5


def test_two_runs_are_compared(tmp_path):
    for name, force in (("a", 1.0), ("b", 2.0)):
        _histories(tmp_path / name, {"/joints/1/force": (_vector(force), "ML/T2"), f"/nodes/{name == 'b':d}/displacement": (_vector(1.0), "L")})
    _histories(tmp_path / "b", {"/joints/1/force": (_vector(2.0), "ML/T2"), "/sections/1/force": (_vector(1.0), "ML/T2")})
    text = _page(tmp_path / "a", tmp_path / "b")
    assert "Differences" in text and re.search(r"joint 1: largest force\s+2.2361\s+4.4721\s+N\s+\+100 %", text)
    assert "Forces in cross sections: only in b" in text and re.search(r"verdict\s+sound\s+sound", text)


def test_gauges_of_a_killed_run(tmp_path):
    folder = _killed(tmp_path / "run")
    (folder / "gauges").mkdir()
    (folder / "gauges/p.csv").write_text("time,wet,pressure,velocity.x,velocity.y,velocity.z\n0,0,nan,nan,nan,nan\n1,1,30,3,0,4\n2,1,20,0,0,0\n3,1,2")
    (folder / "gauges/bad.csv").write_text("what,is\n1,2\n")
    text = _page(folder)
    assert re.search(r"gauge p\s+pressure\s+30\s+1\s+20", text) and re.search(r"gauge p\s+velocity\s+5\s+1\s+0", text) and "no table of a gauge" in text


def test_thinned_curves_keep_their_peaks():
    t = np.arange(100001.0)
    values = np.sin(t)
    values[54321], values[777], values[888] = 9.0, -9.0, np.nan
    x, y = thinned(t, values)
    assert len(x) <= 4002 and np.nanmax(y) == 9 and np.nanmin(y) == -9 and (np.diff(x) > 0).all() and x[np.nanargmax(y)] == 54321


def test_states_of_particles_are_drawn(tmp_path):
    write_run(tmp_path, [frame(lattice(0.0, 0.2 + 0.1 * k), t=float(k)) for k in range(3)], shells=True)
    (tmp_path / "summary.yaml").write_text("title: pool\nverdict: sound\nunits: {mass: kg, length: m, time: s}\n")
    assert "particles by speed; first, middle and last of 3 states" in _page(tmp_path)


@pytest.fixture(scope="module")
def mixed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from test_binout import with_binary

    at = tmp_path_factory.mktemp("report")
    (at / "deck.k").write_text(with_binary(DECK.read_text(), 3))
    return run(at / "deck.k", at / "run", "--d3plot")


@needs_courant
def test_a_run_with_each_kind_of_element(mixed):
    text = _page(mixed)
    for title in ("Forces on rigid walls", "Contact forces", "Forces of supports", "Rigid bodies", "Motion of nodes", "Energies of parts"):
        assert title in text, title
    assert "von Mises stress (of shells the largest of their layers); first, middle and last" in text and "grey: without it (part" in text
    assert "first time step" in text and "the step is set by" in text and "particles by speed" in text
    assert "each kind of element" in text and "beams take no part in contact" in text
    page = (mixed / "report.html").read_text()
    for section in ("Verdict", "States", "Energies", "Time step", "Histories", "Warnings", "Timings"):
        assert f"<h2>{section}</h2>" in page
    assert page.count("data:image/png;base64,") >= 12 and "src=\"http" not in page and "href=" not in page


@needs_courant
def test_states_of_d3plot_where_there_are_no_others(mixed, tmp_path):
    for file in mixed.glob("d3plot*"):
        shutil.copy(file, tmp_path)
    theirs, ours = courant.open(mixed).states, courant.open(tmp_path).states
    assert len(ours) == len(theirs) and np.allclose(ours.times, theirs.times, atol=1e-9) and len(ours[1:]) == len(ours) - 1
    mine, other = ours[-1].solids, theirs[-1].solids
    of_one = [float(one["von_mises"][np.asarray(one["part"]) == 1].max()) for one in (mine, other)]
    assert of_one[0] == pytest.approx(of_one[1], rel=1e-4) and of_one[0] > 0
    assert len(ours[-1].particles) == len(theirs[-1].particles) and ours[0].elements[0].unit("von_mises") != "?"
    text = _page(tmp_path)
    assert "von Mises stress" in text and "particles by speed" in text
    ours[-1].plot("von_mises", tmp_path / "a.png", of="elements")
    with pytest.raises(courant.CourantError, match="no VTK file"):
        ours[-1].vtk()


@needs_courant
@pytest.mark.parametrize("binary", [False, True])
def test_every_source_gives_the_same_peaks(mixed, tmp_path, binary):
    """history.h5 is the first source, text files the second, binout the last."""
    for file in mixed.iterdir():
        if file.is_file() and file.name != "history.h5" and file.name.startswith("binout") == binary:
            shutil.copy(file, tmp_path)
    first, second = Sources(courant.open(mixed)), Sources(courant.open(tmp_path))
    compared, kinds = 0, set()
    for kind in KINDS:
        a, b = first.find(kind), second.find(kind)
        for one in b.entities:
            other = next((e for e in a.entities if e.id == one.id), None)
            for label, lines in one.lines.items():
                if other is not None and label in other.lines:
                    compared += 1
                    kinds.add(kind.title)
                    assert lines.peak == pytest.approx(other.lines[label].peak, rel=1e-3, abs=1e-6 * max(lines.peak, 1e-3)), (kind.title, one.id, label)
    without = {"Forces in joints", "Forces in welds", "Gauges"} | (set() if binary else {"Tracers"})  # not in the deck; trhist has no ids
    without |= set() if binary else {"Particles"}  # in binout alone
    assert kinds == {kind.title for kind in KINDS} - without and compared > 40


@needs_courant
def test_a_family_of_d3plot_with_holes(mixed, tmp_path, capsys):
    whole = mixed / "d3plot01"
    shutil.copy(mixed / "d3plot", tmp_path)
    (tmp_path / "d3plot01").write_bytes(whole.read_bytes()[:-400])
    (tmp_path / "d3plot03").write_bytes(whole.read_bytes())
    found = courant.open(tmp_path).d3plot
    assert len(found) > 0 and any("d3plot01" in one and "cut off" in one for one in found.warnings) and any("d3plot02: not there" in one for one in found.warnings)
    assert "warning: d3plot02: not there" in capsys.readouterr().err
    (tmp_path / "d3plot").unlink()
    with pytest.raises(courant.CourantError, match="it is gone: d3plot01 to d3plot03 hold states"):
        _ = courant.open(tmp_path).d3plot
    assert courant.open(mixed).d3plot.warnings == []


def test_particles_without_points_are_a_message(tmp_path, capsys):
    from courant.post.command import main as post
    from courant.viewing import main as view

    write_run(tmp_path, [frame(lattice())])
    file = tmp_path / "fields/particles_0000.vtp"
    data = file.read_bytes()
    file.write_bytes(data.replace(b'Name="Points"', b'Name="Pointz"'))
    for call in (lambda: post(["--view", "speed", str(tmp_path)]), lambda: view([str(tmp_path), "-o", str(tmp_path / "a.png")])):
        assert call() == 1 and "it has no array 'Points'" in capsys.readouterr().err


def test_results_of_names_the_folder(tmp_path):
    with pytest.raises(courant.CourantError, match="no such folder"):
        results_of(str(tmp_path / "none"))
