"""`courant post` as a whole: from field files to results, on any number of processes, and its exit codes."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml
from courant.diagnostics import Diagnostics
from courant.post import run_post
from courant.post.analyses import KINDS
from courant.post.command import main
from courant.post.figures import CHARTS
from made_runs import frame, lattice, write_history, write_run
from test_recipe import DECKS

SOURCES = Path(__file__).resolve().parents[2] / "src" / "python"


def channel(jump_at: float, t: float = 0.0):
    """1.1 m long; the water is at 4 rows upstream of a jump and at 16 rows downstream of it."""
    x = np.concatenate([lattice(x1=1.1, y1=0.02), lattice(x1=1.1, y0=0.02, y1=0.08)])
    x = x[(x[:, 1] < 0.02) | (x[:, 0] >= jump_at)]
    return frame(x, t=t, v=lambda x, y: np.where(x < jump_at, 1.5, 0.35))


def write_jump(folder, states=51):
    """The jump is at x = 1.2 (outside) before 1 s, then goes upstream from 0.9 at 0.1 m/s; a state every 0.1 s."""
    write_run(folder, [channel(1.2 if s < 10 else 0.9 - 0.01 * (s - 10), 0.1 * s) for s in range(states)], "Hydraulic jump d1/4", shells=True)


def post(folder, recipe, threads=1, good=True):
    file = recipe
    if isinstance(recipe, str):
        file = folder / "recipe.yaml"
        file.write_text(recipe)
    diagnostics, said = Diagnostics(), []
    assert run_post(file, folder, said.append, diagnostics, threads=threads) == good, diagnostics.text()
    return "".join(said), diagnostics.text()


def results(folder):
    return yaml.safe_load((folder / "results.yaml").read_text())


def test_a_jump_from_field_files_to_results(tmp_path):
    pytest.importorskip("matplotlib")
    write_jump(tmp_path)
    said, _ = post(tmp_path, DECKS / "post.yaml", threads=2)
    found = results(tmp_path)
    first, second = found["jump"]["intervals"]
    ratio = 0.08 / 0.0863  # 16 rows against Belanger
    assert found["case"] == "d1/4" and first["states"] == 26 and second["states"] == 0
    assert first["A"] == pytest.approx(ratio, abs=0.01) and first["P"] == pytest.approx(1 - ratio, abs=0.01)
    assert first["published"][0]["A"] == 0.969
    assert found["jump"]["front"]["time"] == pytest.approx(1) and found["jump"]["toe_at_end"] == pytest.approx(0.5, abs=0.011)
    assert "Case: d1/4; 51 states" in said
    assert (tmp_path / "depth.csv").read_text().startswith("t,depth,depth_over_theory,toe,front_depth\n")
    assert (tmp_path / "walls.csv").read_text() == "x0,y0,x1,y1\n0,0,0.5,0\n0.5,0,1,0\n"
    for name in ("depth.png", "velocity.png"):
        assert (tmp_path / name).stat().st_size > 10000


def test_a_probe_and_pictures_alone(tmp_path):
    write_run(tmp_path, [channel(0.5)])
    said, _ = post(tmp_path, "probes: [{name: gauge, x: 0.8}]\n")
    assert results(tmp_path)["probes"][0]["last_depth"] == pytest.approx(0.08, abs=5e-4) and "Depth at gauge (x = 0.8 m): 0.08" in said
    post(tmp_path, "snapshots: {times: [0]}\n")
    lines = (tmp_path / "snapshots.csv").read_text().splitlines()
    assert len(lines) == 1 + 100 * 4 + 120 * 16  # the channel has 100 columns of 4 and 120 of 16 particles
    assert lines[1] == "0,0.0025,0.0025,1.5,2.5e-05,0.006"  # x, y, speed, area, h


TABLES = """analyses:
  - {kind: surface, name: s, x: {from: 0.1, to: 1, step: 0.05}, layers: true}
  - {kind: profile, name: u, of: [vx, p], x: [0.3, 0.9], y: {from: 0.01, to: 0.08, step: 0.01}, interpolation: mls}
  - {kind: spectrum, name: f, of: s}
  - {kind: flux, name: q, at: [0.3, 0.9]}
"""


def test_the_same_bits_on_any_number_of_processes(tmp_path):
    write_jump(tmp_path, 12)
    found = []
    for threads in (1, 2, 4):
        post(tmp_path, TABLES, threads)
        found.append({path.name: path.read_bytes() for path in (tmp_path / "post").iterdir()})
    assert found[0] == found[1] == found[2] and len(found[0]) == 9 and min(map(len, found[0].values())) > 50


def test_figures_with_their_numbers(tmp_path):
    pytest.importorskip("matplotlib")
    write_run(tmp_path, [channel(0.5)], "a $title", shells=True)
    recipe = """formats: [png, svg]
analyses:
  - {kind: surface, name: depth, x: [0.2, 0.8]}
  - {kind: grid, name: g, of: [vx], x: {from: 0, to: 1, step: 0.1}, y: {from: 0.01, to: 0.03, step: 0.01}}
figures:
  - name: a
    curves: [{table: depth_mean, x: x, y: mean / 0.08, label: SPH}, {table: g, x: vx_mean, y: y, each: x}]
    references: [{formula: 2 * x, from: 0, to: 1}, {points: [[1, 2]], style: points}, {y: 1, style: dashed}]
    scale: log_y
  - {name: b, map: {image: g, field: vx_mean, streamlines: [vx_mean, wet], range: [0, 2]}, walls: true, equal: true}
"""
    said, _ = post(tmp_path, recipe, threads=2)
    data = json.loads((tmp_path / "post/figures.json").read_text())
    a, b = data["figures"]
    assert data["title"] == "a $title" and data["walls"] == [[0, 0, 0.5, 0], [0.5, 0, 1, 0]] and "2 figures" in said
    assert a["curves"][0]["y"] == pytest.approx([0.25, 1], abs=0.01) and [c.get("each") for c in a["curves"][1:]] == [k / 10 for k in range(11)]
    assert a["curves"][1]["style"] == "line" and a["scale"] == "log_y" and a["references"][2]["across"] == "y"
    assert a["references"][0]["y"][-1] == 2 and len(a["references"][0]["x"]) == 201
    assert (b["map"]["nx"], b["map"]["ny"], b["map"]["dx"]) == (11, 3, 0.1) and b["map"]["field"][0] is not None and b["map"]["field"][22] is None
    for name in ("a.png", "a.svg", "b.png", "b.svg"):
        assert (tmp_path / "post" / name).stat().st_size > 5000
    before = (tmp_path / "post/a.png").stat().st_mtime_ns
    environment = os.environ | {"PYTHONPATH": str(SOURCES)}
    subprocess.run([sys.executable, "-m", "courant.post.draw", str(tmp_path / "post")], check=True, env=environment)
    assert (tmp_path / "post/a.png").stat().st_mtime_ns > before


def test_figures_that_name_what_is_not_there(tmp_path):
    write_run(tmp_path, [channel(0.5)])
    recipe = """analyses: [{kind: surface, name: depth, x: [0.2, 0.8]}]
figures:
  - {name: a, curves: [{table: dept, x: t, y: t}]}
  - {name: b, curves: [{table: depth_mean, x: x, y: meen}]}
  - {name: c, curves: [{table: depth, x: t, y: depth}]}
"""
    _, faults = post(tmp_path, recipe, good=False)
    assert ":3:24: error: there is no table 'dept' for the figure\n  hint: there are: depth, depth_mean" in faults
    assert ":4:24: error: 'y' of a curve from 'depth_mean': unknown name 'meen'" in faults
    assert "unknown name 'depth'\n  hint: the table has t, depth@0.2, depth@0.8; a name like depth@0.2 must be all of 'y'" in faults
    assert (tmp_path / "post/depth_mean.csv").stat().st_size > 50


def test_without_matplotlib_there_is_a_warning(tmp_path, monkeypatch):
    write_run(tmp_path, [channel(0.5)])
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    _, warned = post(tmp_path, "snapshots: {times: [0]}\n")
    assert warned == "warning: no pictures were drawn: python3 with matplotlib was not found\n  hint: apt-get install python3-matplotlib\n"


def test_a_recipe_of_histories_needs_no_states(tmp_path):
    write_history(tmp_path, {"global/time": (np.arange(4.0), "T"), "global/kinetic": (np.arange(4.0), "ML2/T2")})
    said, _ = post(tmp_path, "analyses: [{kind: history, name: h, of: [global/kinetic]}]\n")
    assert said.startswith("h (history)\n  global/kinetic: mean 1.5 model units, deviation 1.12, 0 to 3\n")
    assert results(tmp_path)["analyses"]["h"]["global/kinetic_integral"] == {"value": 4.5, "unit": "model units"}


def test_a_history_of_gauges_has_their_times(tmp_path):
    own = np.arange(0.0, 4.5, 0.5)
    gauge = {"gauges/p/time": (own, "T"), "gauges/p/pressure": (own**2, "M/LT2")}
    write_history(tmp_path, {"global/time": (np.arange(4.0), "T"), "global/kinetic": (np.arange(4.0), "ML2/T2")} | gauge)
    post(tmp_path, "analyses: [{kind: history, name: h, of: [gauges/p/pressure]}]\n")
    rows = np.genfromtxt(tmp_path / "post/h.csv", delimiter=",", skip_header=1)
    assert rows[:, 0].tolist() == own.tolist() and rows[:, 1].tolist() == (own**2).tolist()
    _, faults = post(tmp_path, "analyses: [{kind: history, name: h, of: [gauges/p/pressure, global/kinetic]}]\n", good=False)
    assert "'/global/kinetic' and '/gauges/p/pressure' have different times" in faults


def test_numbers_that_are_none(tmp_path):
    write_run(tmp_path, [channel(0.5, t) for t in (0.0, 1.0)])
    post(tmp_path, "analyses: [{kind: probe, name: p, of: [vx], at: [[0.5, 5]]}]\n")
    assert math.isnan(results(tmp_path)["analyses"]["p"]["vx_mean"]["value"])
    assert (tmp_path / "post/p.csv").read_text() == "t [s],vx [m/s]\n0,nan\n1,nan\n"


def test_an_analysis_and_a_chart_of_ones_own(tmp_path, monkeypatch):
    for registry in (KINDS, CHARTS):
        monkeypatch.setattr(registry, "functions", dict(registry.functions))  # other tests do not know it
    write_run(tmp_path, [channel(0.5, 0.1 * s) for s in range(3)])
    (tmp_path / "mine.py").write_text(
        "from courant.post import analysis, chart\n\n@analysis('fastest_of_tests')\ndef fastest(state, over: float = 0.0):\n"
        "    speed = state['speed'][state.active]\n    if over > 9:\n        raise ValueError('too fast')\n"
        "    return {'speed [m/s]': speed.max(), 'share [-]': (speed > over).mean()}\n\n"
        "@chart('histogram_of_tests')\ndef histogram(axes, tables, table, of, bins=20):\n    axes.hist(tables[table].find(of).values, int(bins))\n"
    )
    recipe = (
        "analyses: [{kind: fastest_of_tests, name: f, over: %s}]\n"
        "figures: [{name: h, chart: histogram_of_tests, table: f, of: speed, bins: 5}]\n"
    )
    (tmp_path / "r.yaml").write_text(recipe % 1)
    assert main([str(tmp_path / "r.yaml"), str(tmp_path), "--load", str(tmp_path / "mine.py"), "--threads", "1"]) == 0
    assert results(tmp_path)["analyses"]["f"]["speed_mean"] == {"value": 1.5, "unit": "m/s"}
    assert results(tmp_path)["analyses"]["f"]["share_mean"]["value"] == pytest.approx(400 / (400 + 120 * 16))
    assert (tmp_path / "post/h.png").stat().st_size > 5000
    _, faults = post(tmp_path, recipe % 10, good=False)
    assert "analysis 'f' at t = 0: ValueError at " in faults and "mine.py:7: too fast" in faults
    _, faults = post(tmp_path, (recipe % 1).replace("over", "ovr"), good=False)
    assert "'f' does not know the key 'ovr'\n  hint: did you mean over? known keys: kind, name, from, to, over" in faults


class TestCall:
    def ends(self, capsys, code, *words):
        assert main([str(word) for word in words]) == code
        return capsys.readouterr()

    def test_codes_and_messages(self, tmp_path, capsys):
        assert "no.yaml: error: cannot read the recipe" in self.ends(capsys, 1, tmp_path / "no.yaml", tmp_path).err
        assert f"{tmp_path}/fields.pvd: error: no results here" in self.ends(capsys, 1, DECKS / "post.yaml", tmp_path).err
        assert "--load: " in self.ends(capsys, 1, "--load", tmp_path / "no.py", DECKS / "post.yaml", tmp_path).err
        write_run(tmp_path, [channel(0.5)])
        (tmp_path / "r.yaml").write_text("analyses: [{kind: surface, name: s, x: 0.5}]\n")
        found = self.ends(capsys, 0, tmp_path / "r.yaml", tmp_path)
        assert found.out == "s (surface)\n  1 places, 1 states; mean of 1 states\n" and found.err == ""

    def test_results_that_cannot_be_written(self, tmp_path, capsys):
        write_run(tmp_path, [channel(0.5)])
        (tmp_path / "r.yaml").write_text("analyses: [{kind: surface, name: s, x: 0.5}]\n")
        (tmp_path / "post").write_text("a file where a folder belongs")
        found = self.ends(capsys, 2, tmp_path / "r.yaml", tmp_path)
        assert f"error: cannot write '{tmp_path}/post': " in found.err and "\n  hint: " in found.err

    @pytest.mark.parametrize("words", [[], ["a", "b", "--threads", "-1"], ["a", "b", "--thread", "x"]])
    def test_wrong_calls(self, words):
        with pytest.raises(SystemExit) as end:
            main(words)
        assert end.value.code == 1


def test_a_process_that_is_ended_from_outside(tmp_path, capsys, monkeypatch):
    for registry in (KINDS, CHARTS):
        monkeypatch.setattr(registry, "functions", dict(registry.functions))
    write_run(tmp_path, [channel(0.5, 0.1 * s) for s in range(8)])
    (tmp_path / "mine.py").write_text(
        "import os, signal\nfrom courant.post import analysis\n\n@analysis('deadly')\ndef deadly(state):\n    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    (tmp_path / "r.yaml").write_text("analyses: [{kind: deadly, name: d}]\n")
    assert main([str(tmp_path / "r.yaml"), str(tmp_path), "--load", str(tmp_path / "mine.py"), "--threads", "2"]) == 3
    assert "a process was ended from outside" in capsys.readouterr().err


def test_damaged_states(tmp_path):
    write_run(tmp_path, [channel(0.5, 0.1 * s) for s in range(8)])
    path = tmp_path / "fields/particles_0006.vtp"
    path.write_bytes(path.read_bytes()[:-300])
    for threads in (1, 2):
        _, faults = post(tmp_path, "analyses: [{kind: surface, name: s, x: 0.5}]\n", threads, good=False)
        assert "particles_0006.vtp: error: not a field file" in faults and faults.count("error") == 1
