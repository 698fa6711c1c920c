"""Gauges of a run against theory, against the states of the same run, and through a restart."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import courant
import numpy as np
import pytest
from courant.diagnostics import Diagnostics
from courant.histories import HistoryFile
from courant.post.particles import ParticleSet, Points, first_surface, interpolate
from made_runs import write_history
from mixed_run import COURANT, needs_courant, run
from scene.made import written

RHO, G = 1000.0, 9.81


def tank(**keys: Any) -> courant.Scene:
    made = courant.Scene("still water", **({"spacing": 0.01, "end": 1.2, "output": 0.05} | keys))
    return made.water(low=(0, 0), high=(0.2, 0.2)).box(low=(0, 0), high=(0.2, 0.3), open=["top"])


def mean_of_end(values: np.ndarray) -> float:
    """Of the last half: the sound of the start is gone."""
    return float(values[len(values) // 2 :].mean())


@pytest.fixture(scope="module")
def still(tmp_path_factory: Any) -> courant.Results:
    if not COURANT:
        pytest.skip("COURANT_EXECUTABLE names no program")
    scene = tank(wall_method="mirrors")
    for name, at in {"open": (0.1, 0.1), "wall": (0.0, 0.1), "corner": (0.2, 0.0)}.items():
        scene.gauge(name, point=at, interval=0.002)
    for x in (0.06, 0.1, 0.14):
        scene.gauge(f"bed{x}", point=(x, 0.0), interval=0.002)
    scene.gauge("above", point=(0.1, 0.28))
    scene.gauge("middle", level=[(0.1, 0), (0.1, 0.3)]).gauge("edge", level=[(0, 0), (0, 0.3)])
    scene.gauge("walls", force="walls", interval=0.002, about=(0.1, 0, 0))
    return scene.run(tmp_path_factory.mktemp("still"), threads=1, quiet=True)


def test_pressure_of_still_water_at_twenty_rows(still: courant.Results) -> None:
    for name, y in {"open": 0.1, "wall": 0.1, "corner": 0.0}.items():
        gauge = still.gauges[name]
        assert np.all(gauge["wet"] == 1)
        assert mean_of_end(gauge["pressure"]) == pytest.approx(RHO * G * (0.2 - y), rel=0.01), name
    # the scheme has 0.9 % too much in the lowest row; single points have the noise of it besides
    bed = np.mean([mean_of_end(still.gauges[f"bed{x}"]["pressure"]) for x in (0.06, 0.1, 0.14)])
    assert bed == pytest.approx(RHO * G * 0.2, rel=0.01)
    assert np.all(still.gauges["above"]["wet"] == 0) and np.all(np.isnan(still.gauges["above"]["pressure"]))


def test_a_gauge_that_is_not_there_is_refused_with_those_there_are(still: courant.Results) -> None:
    with pytest.raises(KeyError, match="the run has no gauge 'opn'; did you mean open\\? it has .*open.*"):
        still.gauges["opn"]
    with pytest.raises(KeyError, match="the run has no contact 77; it has"):
        still.contacts[77]
    assert "opn" not in still.gauges and still.gauges.get("opn") is None


def test_level_of_still_water(still: courant.Results) -> None:
    for name in ("middle", "edge"):
        assert mean_of_end(still.gauges[name]["level"]) == pytest.approx(0.2, abs=0.002), name


def test_force_is_the_weight_and_that_of_the_histories(still: courant.Results) -> None:
    gauge = still.gauges["walls"]
    assert mean_of_end(gauge["force.y"]) == pytest.approx(-RHO * G * 0.04, rel=0.01)
    assert abs(mean_of_end(gauge["moment.z"])) < 0.01 * RHO * G * 0.04 * 0.1
    history = still.histories
    on_water = sum(history[f"contacts/{k}/force"][:, 1] for k in (0, *(k for k in still.contacts if k)))
    rows = np.isin(np.round(history.t, 9), np.round(gauge["t"], 9))
    same = np.isin(np.round(gauge["t"], 9), np.round(history.t, 9))
    assert same.sum() > 50
    np.testing.assert_allclose(gauge["force.y"][same], -on_water[rows], rtol=1e-9, atol=1e-6)


@needs_courant
def test_force_on_one_wall(tmp_path: Path) -> None:
    scene = courant.Scene("two walls", spacing=0.01, end=0.6, wall_method="mirrors").water(low=(0, 0), high=(0.2, 0.2))
    scene.box(low=(0, 0), high=(0.2, 0.3), open=["top", "left"]).wall(line=[[0, 0], [0, 0.3]], title="left wall")
    scene.gauge("left", force="left wall", interval=0.002)
    made = scene.run(tmp_path / "run", threads=1, quiet=True)
    # pairs with images under the bed carry 0.7 spacings of the thrust in the corner: 3.5 % at 20 rows
    assert mean_of_end(made.gauges["left"]["force.x"]) == pytest.approx(-0.5 * RHO * G * 0.04, rel=0.05)
    # the lever of the pressure is a third of the depth
    assert mean_of_end(made.gauges["left"]["moment.z"]) == pytest.approx(0.5 * RHO * G * 0.04 * 0.2 / 3, rel=0.05)


@pytest.fixture(scope="module")
def dam(tmp_path_factory: Any) -> courant.Results:
    if not COURANT:
        pytest.skip("COURANT_EXECUTABLE names no program")
    scene = courant.Scene("dam break", spacing=0.01, end=0.5, output=0.02, wall_method="mirrors")
    scene.water(low=(0, 0), high=(0.2, 0.3)).box(low=(0, 0), high=(0.8, 0.5), open=["top"])
    for x in (0.05, 0.3, 0.5):
        scene.gauge(f"level{x}", level=[(x, 0), (x, 0.5)], interval=0.02)
        scene.gauge(f"point{x}", point=(x, 0.03), interval=0.02)
    for x in (0.1, 0.3, 0.4):
        scene.gauge(f"gate{x}", flux=[(x, 0), (x, 0.5)], interval=0.002)
    scene.gauge("front", runup=[(0, 0), (0.8, 0)], interval=0.02)
    return scene.run(tmp_path_factory.mktemp("dam"), threads=1, quiet=True)


def particles(state: Any) -> ParticleSet:
    V = np.asarray(state["mass"] / state["density"], float)
    x = state.points.copy()
    return ParticleSet(state.t, 2, x, V, np.asarray(state["smoothing_length"], float), np.arange(len(x)))


def test_gauges_are_what_analysis_finds_in_the_states(dam: courant.Results) -> None:
    compared = 0
    for x in (0.05, 0.3, 0.5):
        level, point = dam.gauges[f"level{x}"], dam.gauges[f"point{x}"]
        for state in list(dam.states)[1:]:
            row = int(np.argmin(np.abs(level["t"] - state.t)))
            assert abs(level["t"][row] - state.t) < 1e-3
            water = particles(state)
            depth = first_surface(water, np.array([[x, 0, 0]]), 0.0)[0]
            if depth > 0.06:
                assert level["level"][row] == pytest.approx(depth, abs=0.005), (x, state.t)
                weights = interpolate(water, Points(np.array([[x, 0.03, 0.0]])), True, 0.25)
                speed = weights.of(state["velocity"][:, 0].astype(float))[0]
                assert point["velocity.x"][row] == pytest.approx(speed, abs=0.05)
                compared += 1
            elif state.t < 0.03 and x > 0.25:
                assert level["wet"][row] == 0
    assert compared > 25


def test_flux_is_the_change_of_volume(dam: courant.Results) -> None:
    states = list(dam.states)
    last = next(state for state in states if state.t > 0.4)
    first, water = particles(states[0]), particles(last)
    for x in (0.1, 0.3, 0.4):
        gauge = dam.gauges[f"gate{x}"]
        until = gauge["t"] <= last.t + 1e-9
        t, q = gauge["t"][until], gauge["volume"][until]
        through = float(np.sum(0.5 * np.diff(t) * (q[1:] + q[:-1])))
        beyond = float(water.V[water.x[:, 0] > x].sum() - first.V[first.x[:, 0] > x].sum())
        # a slope of the surface within the reach of the kernel counts on one side; that is four spacings
        assert beyond > 0.01 and through == pytest.approx(beyond, rel=0.01 if x == 0.1 else 0.006), x


def test_the_front_goes_on(dam: courant.Results) -> None:
    front = dam.gauges["front"]
    assert front["level"][0] == pytest.approx(0.2, abs=0.006)
    state = dam.states.at(0.2)
    ahead = state.points[state.points[:, 1] < 0.01, 0].max()
    row = int(np.argmin(np.abs(front["t"] - state.t)))
    assert front["level"][row] == pytest.approx(ahead + 0.005, abs=0.03)


@needs_courant
def test_a_restart_keeps_the_bytes(tmp_path: Path) -> None:
    scene = tank(end=0.05, spacing=0.02).gauge("p", point=(0.1, 0.1), interval=0.0007).gauge("l", level=[(0.1, 0), (0.1, 0.3)], interval=0.003)
    scene.keywords("*DATABASE_BINARY_D3DUMP\n60\n")
    deck = scene.write(tmp_path / "tank.k")
    whole, parts = run(deck, tmp_path / "whole"), run(deck, tmp_path / "parts")
    dump = sorted((parts / "restart").glob("d3dump*"))[0]
    run(deck, parts, "--restart", str(dump))
    for name in ("p", "l"):
        assert (whole / "gauges" / f"{name}.csv").read_bytes() == (parts / "gauges" / f"{name}.csv").read_bytes()
    one, other = courant.open(whole), courant.open(parts)
    for name in ("p", "l"):
        for a, b in zip(one.gauges[name].columns, other.gauges[name].columns, strict=True):
            np.testing.assert_array_equal(a.values, b.values)
    assert len(one.gauges["p"]["t"]) > 60 and len(one.histories.t) < len(one.gauges["p"]["t"])


@needs_courant
def test_the_file_has_what_the_history_has(tmp_path: Path) -> None:
    deck = tank(end=0.02, spacing=0.02).gauge("p", point=(0.1, 0.1), interval=0.002).write(tmp_path / "tank.k")
    deck.write_text(re.sub(r"\*DATABASE_(GLSTAT|MATSUM|RCFORC)[^*]*", "", deck.read_text()))
    made = run(deck, tmp_path / "run")
    rows = np.genfromtxt(made / "gauges" / "p.csv", delimiter=",", names=True)
    gauge = courant.open(made).gauges["p"]
    assert rows.dtype.names == ("time", "wet", "pressure", "velocityx", "velocityy", "velocityz", "density")
    np.testing.assert_allclose(rows["pressure"], gauge["pressure"], rtol=1e-8)
    np.testing.assert_allclose(rows["time"], gauge["t"], rtol=1e-8)
    assert gauge.units["pressure"] == "Pa" and gauge.units["velocity.x"] == "m/s"


def test_gauges_have_times_of_their_own(tmp_path: Path) -> None:
    t, own = np.arange(5.0), np.arange(0.0, 4.5, 0.5)
    data = {"global/time": (t, "T"), "global/kinetic": (t, "ML2/T2"), "gauges/p/time": (own, "T"), "gauges/p/pressure": (own**2, "M/LT2")}
    write_history(tmp_path, data)
    made = courant.open(tmp_path)
    assert made.gauges["p"]["t"].tolist() == own.tolist() and made.gauges["p"]["pressure"].tolist() == (own**2).tolist()
    assert made.table("p").names == ["t", "pressure"] and len(made.histories.table("global")) == 5
    file = HistoryFile.open(tmp_path / "history.h5", Diagnostics())
    assert file is not None and file.column("/gauges/p/pressure").tolist() == (own**2).tolist()


# scenes


def cards(scene: courant.Scene) -> list[str]:
    text = scene.deck()
    return text[text.index("*COURANT_GAUGE") :].splitlines()


def test_cards_of_a_scene() -> None:
    assert cards(tank().gauge("a", point=(0.1, 0.05)))[:3] == ["*COURANT_GAUGE_POINT_TITLE", "a", "1,0.005,0.1,0.05,0,0"]
    assert cards(tank().gauge("b", flux=[(0.1, 0), (0.1, 0.3)], interval=0.01))[:4] == ["*COURANT_GAUGE_FLUX_TITLE", "b", "1,0.01", "0.1,0,0,0.1,0.3,0"]
    assert cards(tank().gauge("c", force="walls", about=(0.1, 0, 0)))[:3] == ["*COURANT_GAUGE_FORCE_TITLE", "c", "1,0.005,11,3,0.1,0,0"]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"point": (0, 0), "level": [(0, 0), (0, 1)]}, "a gauge has one of point, level"),
        ({"level": [(0, 0)]}, "level: expected two points"),
        ({"flux": [(0, 0), (0, 1), (1, 1)]}, r"flux: expected two points \[x, y\] in the plane"),
        ({"force": "wals"}, "the scene has no part 'wals'"),
        ({"point": (0, 0), "about": (0, 0)}, "'about' goes with 'force'"),
        ({"point": (0, 0), "body": 9}, r"with: the scene has no part '9'\n  hint: its parts: water \(1\), walls \(11\)"),
        ({"force": 99}, "force: the scene has no part '99'"),
        ({"force": "water"}, "force: part 'water' has particles alone"),
        ({"level": [(0.1, 0), (0.1, 0)]}, "level: start and end are the same point"),
        ({"runup": [(0.1, 0), (0.1, 0)]}, "runup: start and end are the same point"),
        ({"flux": [(0.1, 0), (0.1, 0)]}, "flux: start and end are the same point"),
        ({"point": (0, 0), "interval": -1}, "interval: expected a time > 0, got -1"),
    ],
)
def test_faults_of_a_scene(keys: dict[str, Any], message: str) -> None:
    with pytest.raises(courant.CourantError, match=message):
        tank().gauge("g", **keys).deck()


def test_two_gauges_of_one_name_are_refused() -> None:
    with pytest.raises(courant.CourantError, match="two gauges are called 'g'"):
        tank().gauge("g", point=(0, 0)).gauge("g", point=(0, 0)).deck()


def test_parts_of_keywords_are_left_to_the_program() -> None:
    made = tank().keywords("*PART\nmine\n        50         2         2").gauge("a", force=50)
    assert cards(made)[2] == "1,0.005,50,3,0,0,0"


def test_names_of_gauges_are_those_of_the_files() -> None:
    for given, name in (("wave 1", "wave_1"), ("at the wall, left", "at_the_wall__left"), (".hidden", "_hidden"), ("-a.b", "-a.b"), ("$x", "_x")):
        assert cards(tank().gauge(given, point=(0.1, 0.05)))[1] == name
    with pytest.raises(courant.CourantError, match="two gauges are called 'a_b'\n  hint: other characters"):
        tank().gauge("a_b", point=(0, 0)).gauge("a b", point=(0, 0)).deck()
    with pytest.raises(courant.CourantError, match="name: '' has 0 characters"):
        tank().gauge("", point=(0, 0)).deck()


GAUGES = """title: tank
water: {spacing: 0.02, blocks: [{low: [0, 0], high: [0.2, 0.2]}]}
box: {low: [0, 0], high: [0.2, 0.3], open: [top]}
end: 1
gauges:
  - {name: p, point: [0.1, 0.1]}
  - GAUGE
"""


@pytest.mark.parametrize(
    ("gauge", "position", "message"),
    [
        ("{point: [0.1, 0.1]}", "7:5", "a gauge: 'name' is missing"),
        ("{name: a, point: [0.1, 0.1], with: 9}", "7:40", "with: the scene has no part '9'"),
        ("{name: a, force: 99}", "7:22", "force: the scene has no part '99'"),
        ("{name: a, level: [[0.1, 0], [0.1, 0]]}", "7:22", "level: start and end are the same point"),
    ],
)
def test_faults_have_the_line_of_the_scene(tmp_path: Path, gauge: str, position: str, message: str) -> None:
    out = written(tmp_path, GAUGES.replace("GAUGE", gauge))
    assert out.messages.startswith(f"scene.yaml:{position}: error: {message}") and not out.deck, out.messages


def test_a_flux_through_corners_on_a_line_is_refused() -> None:
    made = courant.Scene("tank", spacing=0.1, end=1).water(low=(0, 0, 0), high=(1, 1, 1)).gauge("f", flux=[(0, 0, 0), (0, 0, 0.5), (0, 0, 1)])
    with pytest.raises(courant.CourantError, match="flux: the corners are on a line"):
        made.deck()
