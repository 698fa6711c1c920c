"""A jump at an abrupt drop: momentum bounds, types of made-up flows over time, and beds."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np
import pytest
import yaml
from courant.diagnostics import Diagnostics
from courant.fields import StateFiles
from courant.post import read_recipe, run_post
from courant.post.bed import Bed
from courant.post.drop import TYPES, TypeRule, cycles_of, momentum_bounds, regime_of, shares_of, types_over_time
from courant.post.jump import belanger_depth
from courant.post.kinds_drop import moving_mean, sustained_toe
from courant.yaml_map import YamlMap, parse_yaml
from made_runs import frame, lattice, write_fields, write_run
from test_analyses import analyses  # noqa: F401

Y1, V1, S, DX = 0.04, 2.0, 0.03, 0.01
TESTS = Path(__file__).parents[2].parent / "shared/reference/data/depadova_tests.csv"


@pytest.mark.parametrize(("F1", "s", "B", "A"), [(3.293736, 0.91428571, 4.5364005, 5.2202084), (2.9394943, 0.84656085, 4.0530587, 4.6644632)])
def test_momentum_bounds(F1, s, B, A):
    assert momentum_bounds(F1, s) == pytest.approx((B, A), rel=1e-7)
    for Y, force in zip(momentum_bounds(F1, s), (s * (1 + s / 2), s * (A - s / 2)), strict=True):  # rho q (Vt - V1) = (1 - Y^2)/2 + force
        assert F1**2 * (1 / Y - 1) == pytest.approx((1 - Y**2) / 2 + force, abs=1e-6)


def test_momentum_bounds_without_a_step_and_without_a_jump():
    assert momentum_bounds(3.0, 0) == pytest.approx([belanger_depth(3.0, 1, 1)] * 2)
    assert all(math.isnan(one) for one in momentum_bounds(1.0, 0.5))


@pytest.mark.skipif(not TESTS.is_file(), reason="the table of tests is not here")
def test_momentum_bounds_of_all_tests():
    with open(TESTS, newline="") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            assert momentum_bounds(float(row["F1"]), float(row["s_y1"])) == pytest.approx((float(row["Y_B"]), float(row["Y_A"])), rel=1e-6), row["test"]


class TestRule:
    def test_each_type(self):
        J, ahead = np.array([0.3, 0.3, -0.5, -0.5, 0.0]), np.array([3.0, -1.0, 3.0, -1.0, 3.0])
        found = [TYPES[types_over_time(J[k : k + 1], ahead[k : k + 1], TypeRule())[0]] for k in range(5)]
        assert found == ["A", "B", "A-wave", "B-wave", "A"]  # a roller over the step is an A-jump wherever its jet goes

    def test_a_jump_that_has_run_up_its_bed_is_no_wave(self):
        J = np.array([-0.4, -0.2, -0.1, -0.06, -0.04, -0.1, -0.2])
        assert types_over_time(J, np.full(7, 9.0), TypeRule()).tolist() == [3, 3, 3, 3, 1, 1, 3]
        assert types_over_time(J, np.full(7, -1.0), TypeRule()).tolist() == [4] * 7  # at the step it stays what it was

    def test_hysteresis(self):
        J = np.array([0.0, 0.2, 0.1, -0.1, -0.14, -0.2, -0.1, 0.14, 0.16, 0.0])
        assert types_over_time(J, np.zeros(10), TypeRule()).tolist() == [0, 2, 2, 2, 2, 4, 4, 4, 2, 2]
        ahead = np.array([0.9, 1.2, 1.3, 1.0, 0.8, 0.7, 1.0])
        assert types_over_time(np.full(7, 0.5), ahead, TypeRule()).tolist() == [2, 2, 1, 1, 1, 2, 2]

    def test_what_cannot_be_judged_changes_nothing(self):
        J, ahead = np.array([0.3, np.nan, 0.0, 0.0]), np.array([0, 0, np.nan, 0.0])
        assert types_over_time(J, ahead, TypeRule()).tolist() == [2, 0, 0, 2]

    def test_cycles_shares_and_regime(self):
        t = 0.1 * np.arange(1001)
        J = 0.6 * np.sin(2 * np.pi * t / 14) - 0.1
        types = types_over_time(J, np.zeros(1001), TypeRule())
        found = cycles_of(t, types)
        assert len(found.periods) == 6 and found.periods == pytest.approx([14.0] * 6, abs=0.11)
        assert found.starts[0] == pytest.approx(14 * (0.5 - math.asin(-0.05 / 0.6) / (2 * np.pi)) , abs=0.11)  # J = -0.15 on its way down
        shares = shares_of(t, types)
        assert shares.sum() == pytest.approx(1) and shares[2] + shares[4] > 0.95 and regime_of(shares) == "B-wave"

    def test_without_a_wave_a_cycle_is_from_A_to_B(self):
        types = np.array([1, 1, 2, 2, 0, 2, 1, 2, 1, 1, 2])
        found = cycles_of(np.arange(11.0), types)
        assert found.starts.tolist() == [2, 7, 10] and [one.after for one in found.switches] == [2, 1, 2, 1, 2]

    def test_a_toe_that_swings_past_the_step_begins_no_cycle(self):
        assert cycles_of(np.arange(7.0), np.array([2, 4, 3, 4, 2, 3, 4])).starts.tolist() == [1, 5]

    def test_states_stand_for_the_time_around_them(self):
        assert shares_of(np.array([0.0, 1, 2, 10]), np.array([2, 2, 4, 4])) == pytest.approx([0, 0, 0.15, 0, 0.85])
        assert shares_of(np.array([3.0]), np.array([1])).tolist() == [0, 1, 0, 0, 0]

    @pytest.mark.parametrize(
        ("shares", "regime"),
        [([0, 1, 0, 0, 0], "A-jump"), ([0, 0, 0.95, 0, 0.05], "B-jump"), ([0, 0, 0, 0.5, 0.5], "wave jump"), ([0, 0.5, 0, 0.5, 0], "A-wave")]
        + [([0, 0.3, 0.3, 0.2, 0.2], "A-B-wave"), ([0, 0.5, 0.5, 0, 0], "A-B"), ([1, 0, 0, 0, 0], "undecided")],
    )
    def test_regime(self, shares, regime):
        assert regime_of(np.array(shares)) == regime


def test_a_drop_over_the_jet_is_no_toe():
    x, level = np.linspace(0, 1, 101), np.full((101, 3), 0.5)
    level[60:] = 1.5  # the jump
    level[20:23, 1] = 2.0
    level[59, 2] = np.nan
    assert sustained_toe(x, level, 1.0, 0.1) == pytest.approx([0.595] * 3, abs=0.0051)
    assert np.isnan(sustained_toe(x, level[:, :1] - 2, 1.0, 0.1)[0])


def test_moving_mean():
    t, values = np.arange(5.0), np.array([0, 3, np.nan, 6, 9])
    assert moving_mean(t, values, 2).tolist()[:2] == [1.5, 1.5] and np.isnan(moving_mean(t, values, 2)[2]) and moving_mean(t, values, 0) is values


def made(kind: str, dx: float = DX):
    """A jet over the step at x = 0, and behind it, or upstream, what makes the type."""
    toe = -0.3 if kind.startswith("A") else 0.1
    jet, deep = lattice(-1.0, 0.0, S, S + Y1, dx=dx), lattice(0, 1.0, 0.0, 0.15, dx=dx)
    roller = lattice(toe, 0.0, S + Y1, 0.15, dx=dx) if toe < 0 else np.empty((0, 3))
    deep = deep[(deep[:, 0] > toe) | (deep[:, 1] < S + Y1)]

    def u(x, y):
        share = np.where(x > toe, y / 0.15, 0)
        below = V1 * (1 - share) if "wave" not in kind else V1 * share
        return np.where(x > max(0.0, toe), below, V1)

    return frame(jet, roller, deep, dx=dx, v=u)


KEYS = f"kind: jump_type, name: types, step: 0, y1: {Y1}, v1: {V1}, x: [-0.8, 0.8], bed: [[-1, {S}], [0, {S}], [0, 0], [1, 0]]"


@pytest.mark.parametrize("kind", ["A", "B", "A-wave", "B-wave"])
@pytest.mark.parametrize("dx", [0.01, 0.005])
def test_types_of_made_up_flows(analyses, kind, dx):  # noqa: F811
    run = analyses(KEYS)
    for k in range(3):
        run.take(made(kind, dx), 0.1 * k)
    run.finish()
    assert [TYPES[int(one)] for one in run.column("types", "type")] == [kind] * 3
    assert run.scalar("types", "toe_mean") == pytest.approx(-0.3 if kind.startswith("A") else 0.1, abs=0.02)
    assert abs(run.scalar("types", "J_mean")) == pytest.approx(0.75, abs=0.05)  # u falls from V1 to 0: layers of a quarter are 0.75 apart
    assert run.scalar("types", f"share_{kind.replace('-', '_')}") == 1 and run.scalar("types", "cycles") == 0


def test_a_cycle_of_made_up_flows(analyses, tmp_path):  # noqa: F811
    test = "{name: a, y1: 0.035, yt: 0.1663, v1: 1.93, height: 0.032, type: B-wave}"
    entries = f"kind: drop_regime, name: regime, y1: {Y1}, yt: 0.15, v1: {V1}, height: {S}, types: types, tests: [{test}]"
    run = analyses(KEYS, entries)
    for k in range(12):
        run.take(made("B-wave" if k % 6 < 3 else "B"), 1.0 * k)
    run.finish()
    assert run.column("types_switches", "t").tolist() == [3, 6, 9] and run.scalar("types", "switches") == 3
    assert run.scalar("types", "cycles") == 0 and math.isnan(run.scalar("types", "period_mean"))  # one start alone is no cycle
    assert "B-wave: B 50 %" in run.said or "B-wave: B 4" in run.said
    assert run.column("regime", "type") == [4] and run.scalar("regime", "F1") == pytest.approx(V1 / math.sqrt(9.81 * Y1))
    assert run.column("regime_tests", "place") == pytest.approx([0.31436], abs=1e-4)
    bounds = np.array([run.column("regime_bounds", name) for name in ("Y_B", "Y_A")])
    assert (np.diff(bounds, axis=1) > 0).all() and (bounds[1] > bounds[0]).all()


def test_upstream_of_the_toe_the_jet_does_not_count(analyses):  # noqa: F811
    """The free jet behind the step is fast above and slow below; what is behind the toe is a B-jump all the same."""
    run = analyses(KEYS)
    state = made("B")
    x, y = state.x[:, 0], state.x[:, 1]
    state.x[:, 0] = np.where(x > 0.1, x + 0.2, x)  # the toe at 0.3
    gap = lattice(0.1, 0.3, 0, S + Y1, dx=DX)
    free = frame(gap, dx=DX, v=lambda x, y: np.where(y > S, V1, 0))
    both = frame(np.concatenate((state.x, free.x)), dx=DX)
    both.arrays["velocity"] = np.concatenate((state.arrays["velocity"], free.arrays["velocity"]))
    run.take(both, 0)
    run.finish()
    assert run.column("types", "type") == [2] and run.column("types", "J")[0] > 0.5 and run.column("types", "toe")[0] == pytest.approx(0.3, abs=0.02)


class TestBed:
    @staticmethod
    def read(text):
        diagnostics = Diagnostics()
        keys = YamlMap(parse_yaml(f"bed: {text}" if text else "{}", "recipe", diagnostics), "a", "recipe", diagnostics)
        return Bed.read(keys), diagnostics

    def test_numbers_expressions_and_lines(self):
        x = np.array([-0.5, 0.0, 0.5])
        assert self.read("")[0].at(x).tolist() == [0, 0, 0] and self.read("0.1 * x")[0].at(x) == pytest.approx(0.1 * x)
        bed, _ = self.read("[[-1, 0.2], [0, 0.2], [0, 0], [1, 0.1]]")
        assert bed.at(np.array([-1, -0.5, 0, 1e-3, 0.5, 1])) == pytest.approx([0.2, 0.2, 0.2, 1e-4, 0.05, 0.1], abs=1e-9)  # of a face the top
        assert np.isnan(bed.at(np.array([-1.1, 1.1]))).all()

    @pytest.mark.parametrize("text", ["[[0, 1]]", "[1, 2]", "[[0, 1], [2]]", "{part: 11}"])
    def test_faults(self, text):
        assert not self.read(text)[1].ok

    def test_shells_of_parts(self, tmp_path):
        def shells(name, lift=0.0):
            line = [(-1, 0.2), (0, 0.2), (0, 0.0), (1, 0.0), (-0.5, 0.5), (-0.5, 0.9)]
            x = np.array([[a, b + lift, z] for a, b in line for z in (-1, 1)])
            corners = [[2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1] for k in (0, 1, 2, 4)]
            cells = {"connectivity": np.array(corners, "<i8").ravel(), "offsets": 4 * np.arange(1, 5, dtype="<i8"), "types": np.full(4, 9, "<u1")}
            part = {"part": np.array([11, 11, 11, 12], "<i8")}
            sections = [("PointData", {}), ("CellData", part), ("Points", {"Points": x.astype("<f4")}), ("Cells", cells)]
            write_fields(tmp_path / name, sections, len(x), 4)
            return StateFiles(0.0, shells=tmp_path / name)

        still, moved = shells("a.vtu"), shells("b.vtu", lift=0.01)
        bed, diagnostics = self.read("{parts: [11]}")
        assert not bed.known
        bed.find([still, still], diagnostics)
        assert diagnostics.ok and bed.at(np.array([-0.5, 0, 0.5])) == pytest.approx([0.2, 0.2, 0]), "the gate above is another part"
        bed.find([still, moved], diagnostics)
        assert "move" in diagnostics.text()
        other, told = self.read("{parts: [7]}")
        other.find([still], told)
        assert "no shells of the parts 7" in told.text()


def test_faults_of_recipes(analyses):  # noqa: F811
    for bad, words in ((KEYS.replace("[-0.8, 0.8]", "[-0.8, 0.2]"), "must reach"), (KEYS.replace("[1, 0]]", "[0.5, 0]]"), "no bed at x")):
        with pytest.raises(AssertionError, match=words):
            analyses(bad)


def test_the_whole_way_on_any_number_of_processes(tmp_path):
    """Recipe, states and shells in files; charts; the same bits on one and two processes."""
    pytest.importorskip("matplotlib")
    states = [made("B-wave" if k % 4 < 2 else "B") for k in range(9)]
    for k, state in enumerate(states):
        state.t = 0.5 * k
    write_run(tmp_path, states, title="made up")
    recipe = tmp_path / "recipe.yaml"
    recipe.write_text(
        f"""analyses:
  - {{{KEYS}, average: 0.1}}
  - {{kind: gauges, name: g, of: [p, vx, vy], toe: types, distances: [0.1, 0.2], x: {{from: 0, to: 0.8, step: 0.02}}, height: 0.02}}
  - {{kind: correlation, name: c, of: g, pairs: [[vx, vy]]}}
  - {{kind: mass_balance, name: m, at: [-0.8, 0.8]}}
  - kind: drop_regime
    name: regime
    y1: {Y1}
    yt: 0.15
    v1: {V1}
    height: {S}
    types: types
    tests: [{{name: a, y1: 0.035, yt: 0.1663, v1: 1.93, type: B-wave}}]
figures:
  - {{name: types_chart, chart: jump_types, table: types, y1: {Y1}}}
  - {{name: regime_chart, chart: drop_regimes, table: regime, labels: [a]}}
"""
    )
    kept = []
    for threads in (1, 2):
        told = Diagnostics()
        assert run_post(recipe, tmp_path, lambda text: None, told, threads=threads), told.text()
        kept.append({path.name: path.read_bytes() for path in sorted((tmp_path / "post").glob("*.csv")) + [tmp_path / "results.yaml"]})
    assert kept[0] == kept[1] and len(kept[0]) == 10
    found = yaml.safe_load((tmp_path / "results.yaml").read_text())["analyses"]["types"]
    assert found["regime"] == "B-wave" and found["cycles"]["value"] == 1 and found["period_mean"]["value"] == pytest.approx(2)
    assert all((tmp_path / f"post/{name}.png").stat().st_size > 5000 for name in ("types_chart", "regime_chart"))


def test_the_recipe_of_the_scene_has_no_faults():
    told = Diagnostics()
    recipe = read_recipe(Path(__file__).parents[2] / "keyword_decks/abrupt_drop/post.yaml", told)
    assert told.ok and recipe and {"jump_type", "gauges", "correlation", "drop_regime", "mass_balance", "soundness"} <= {one.kind for one in recipe.analyses}
