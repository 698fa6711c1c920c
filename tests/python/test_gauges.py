"""Vorticity, gauges at distances from the toe, correlations, main peaks, balance of mass and soundness, over particles with known fields."""

from __future__ import annotations

import math

import courant
import numpy as np
import pytest
import yaml
from courant.diagnostics import Diagnostics
from courant.fields import read_particles, read_states, Wanted
from courant.post.gradients import gradients, vorticity
from courant.post import run_post
from courant.post.kinds_gauges import correlation
from courant.post.spectrum import Spectrum, main_peak
from courant.post.view_fields import UnknownField, field_names, field_of
from courant.post.view_scene import View, scene_of
from made_runs import DX, block, frame, lattice, scatter, write_run
from test_analyses import analyses, stretched  # noqa: F401

A = np.array([[0.3, -2.0, 0.7], [5.0, -0.3, 1.1], [-0.4, 2.5, 0.1]])  # of v = A x


class TestVorticity:
    @pytest.mark.parametrize("jitter", [0.0, 0.4])
    def test_linear_fields_to_rounding_also_at_the_surface(self, jitter):
        x = lattice(x1=0.1, y1=0.05, jitter=jitter)[:, :2]
        V, h = np.full(len(x), DX**2) * (1 + 0.1 * scatter(len(x))), np.full(len(x), 1.2 * DX)
        g = gradients(x, V, h, x @ A[:2, :2].T + 3)
        assert np.abs(g - A[:2, :2]).max() < 1e-11, "inside, at edges and in corners"
        assert vorticity(x, V, h, x @ A[:2, :2].T) == pytest.approx(np.full(len(x), A[1, 0] - A[0, 1]), abs=1e-11)

    def test_in_space(self):
        x = block(6, 5, 4) + 0.2 * DX * scatter(360).reshape(-1, 3)
        V, h = np.full(len(x), DX**3), np.full(len(x), 1.2 * DX)
        curl = [A[2, 1] - A[1, 2], A[0, 2] - A[2, 0], A[1, 0] - A[0, 1]]
        assert np.abs(vorticity(x, V, h, x @ A.T) - curl).max() < 1e-10

    def test_a_vortex_comes_closer_with_the_spacing(self):
        errors = []
        for dx in (0.01, 0.005, 0.0025):
            x = lattice(-0.1, 0.1, -0.1, 0.1, dx=dx)[:, :2]
            v = np.column_stack((-np.sin(20 * x[:, 1]), np.sin(20 * x[:, 0])))
            inside = np.abs(x).max(axis=1) < 0.07
            exact = 20 * (np.cos(20 * x[:, 0]) + np.cos(20 * x[:, 1]))
            found = vorticity(x, np.full(len(x), dx**2), np.full(len(x), 1.2 * dx), v)
            errors.append(np.abs(found - exact)[inside].max())
        assert errors[0] < 1.5 and errors[0] / errors[1] == pytest.approx(4, abs=0.4) and errors[1] / errors[2] == pytest.approx(4, abs=0.4)

    def test_rows_and_drops_know_no_derivative_across(self):
        row = np.column_stack((np.arange(10) * DX, np.zeros(10)))
        V, h = np.full(10, DX**2), np.full(10, 1.2 * DX)
        g = gradients(row, V, h, np.column_stack((2 * row[:, 0], 5 * row[:, 0])))
        assert np.abs(g[:, :, 0] - [2, 5]).max() < 1e-12 and (g[:, :, 1] == 0).all()
        row[:, 1] = 0.01 * DX * scatter(10)  # hardly off the row: a derivative across would be noise
        assert np.abs(gradients(row, V, h, scatter(30)[20:, None] * DX)[:, :, 1]).max() < 0.1
        apart = np.array([[0.0, 0], [1, 0]])
        assert (gradients(apart, V[:2], h[:2], apart) == 0).all() and (gradients(apart[:1], V[:1], h[:1], apart[:1]) == 0).all()

    def test_in_recipes_and_views(self, analyses, tmp_path):  # noqa: F811
        def shear(x, y):
            return np.column_stack((3 * y, 7 * x, 0 * x))

        state = frame(lattice(x1=0.2, jitter=0.2), v=shear)
        state.arrays["active"][::40] = 0
        state.arrays["velocity"][::40] = 1e3  # what is not active does not count
        run = analyses("kind: grid, name: g, of: [vorticity, {name: w, of: vorticity^2}], x: {from: 0, to: 0.2, step: 0.05}, y: {from: 0, to: 0.1, step: 0.05}")
        run.take(state, 0)
        run.finish()
        assert run.column("g", "vorticity_mean")[run.column("g", "wet") > 0] == pytest.approx(4, abs=1e-9)
        assert "vorticity_mean [1/s]" in (run.out / "g.csv").read_text()
        write_run(tmp_path / "run", [state])
        seen = courant.open(tmp_path / "run").states[-1]
        assert "vorticity" in field_names(seen) and "vorticity.x" not in field_names(seen)
        found = field_of(seen, "vorticity")
        on = state.arrays["active"] > 0
        assert found.unit == "1/s" and found.values[on] == pytest.approx(4, abs=1e-4) and np.isnan(found.values[~on]).all()  # single precision
        both = scene_of(seen, View("v", "vorticity", mirror="x"))
        assert both.values[both.x[:, 0] > 0] == pytest.approx(4, abs=1e-4) and both.values[both.x[:, 0] < 0] == pytest.approx(-4, abs=1e-4)

    def test_views_in_space(self, tmp_path):
        state = frame(block(4, 4, 4), dim=3, v=lambda x, y: np.column_stack((3 * y, 7 * x, 0 * x)))
        write_run(tmp_path, [state])
        seen = courant.open(tmp_path).states[-1]
        assert field_of(seen, "vorticity").values == pytest.approx(4, abs=1e-3) and field_of(seen, "vorticity.x").values == pytest.approx(0, abs=1e-3)
        assert field_of(seen, "vorticity.z").values == pytest.approx(4, abs=1e-3)


def test_gauges_follow_the_mean_toe(analyses):  # noqa: F811
    """A level 0.06 + x/10 and a pressure 1e4 (0.1 - y) + 100 x: the gauges find them at toe + distance, over a bed of one's own."""
    toe = "kind: surface, name: surface, x: {from: 0.05, to: 0.45, step: 0.05}", "kind: toe, name: toe, of: surface, depth: 0.072"
    keys = "of: [p, vx], toe: toe, distances: [0.07, 0.2], x: {from: 0.04, to: 0.46, step: 0.02}"
    run = analyses(*toe, f"kind: gauges, name: g, {keys}", f"kind: gauges, name: up, {keys}, height: 0.01, bed: 0.01")
    for k in range(3):
        state = stretched(lambda x: 1 + x / 0.6)
        state.arrays["pressure"][:] = 1e4 * (0.1 - state.x[:, 1]) + 100 * state.x[:, 0] + k
        state.arrays["velocity"][:, 0] = state.x[:, 0]
        run.take(state, 0.1 * k)
    run.finish()
    at = run.scalar("toe", "toe_mean") + np.array([0.07, 0.2])
    assert run.scalar("toe", "toe_mean") == pytest.approx(0.12, abs=0.005) and run.column("g_mean", "x") == pytest.approx(at)
    assert run.column("g_mean", "level_mean") == pytest.approx(0.06 + at / 10, abs=6e-4)
    assert run.column("up_mean", "level_mean") == pytest.approx(run.column("g_mean", "level_mean"), abs=1e-9), "a level, no depth"
    assert run.column("g_mean", "p_mean") == pytest.approx(1001 + 100 * at, abs=0.01), "at the bed, by a linear field"
    assert run.column("up_mean", "p_mean") == pytest.approx(801 + 100 * at, abs=0.01) and run.column("up", "vx@0.2") == pytest.approx([at[1]] * 3)
    assert run.column("g_mean", "p_deviation") == pytest.approx([math.sqrt(2 / 3)] * 2) and run.column("g_mean", "p_wet").tolist() == [1, 1]


def test_gauges_out_of_reach(analyses):  # noqa: F811
    run = analyses("kind: gauges, name: g, toe: 0.3, distances: [0.5], x: {from: 0, to: 0.4, step: 0.02}")
    run.take(frame(lattice(x1=0.4)), 0)
    assert "outside 'x'" in run.finish(good=False)


class TestCorrelation:
    def test_known_values(self):
        a, b = scatter(4000), scatter(9000)[5000:]
        assert correlation(a, 3 * a + 1)[0] == pytest.approx(1, abs=1e-14) and correlation(a, -a)[0] == pytest.approx(-1, abs=1e-14)
        r, noise = correlation(a, b)
        assert abs(r) < 4 * noise and noise == pytest.approx(1 / math.sqrt(4000), rel=0.2)
        assert correlation(a, 0.6 * a + 0.8 * b)[0] == pytest.approx(np.corrcoef(a, 0.6 * a + 0.8 * b)[0, 1], abs=1e-14)
        assert all(abs(correlation(scale * a, a / scale)[0]) <= 1 for scale in (1e-7, 1 / 3, 1e9))

    def test_gaps_and_constants(self):
        a = scatter(50)
        b = np.where(np.arange(50) % 7 == 0, np.nan, 2 * a)
        assert correlation(a, b)[0] == pytest.approx(1, abs=1e-14) and math.isnan(correlation(a, np.ones(50))[0])
        assert math.isnan(correlation(a[:2], a[:2])[0]) and math.isnan(correlation(a, np.full(50, np.nan))[0])

    def test_slow_series_have_more_noise(self):
        t = np.linspace(0, 4, 2000)
        assert correlation(np.sin(2 * np.pi * t), np.sin(2.3 * np.pi * t))[1] > 5 / math.sqrt(2000)

    def test_over_distance(self, analyses):  # noqa: F811
        gauges = "kind: gauges, name: g, of: [p, vx, vy], toe: 0.1, distances: [0.05, 0.2], x: {from: 0.1, to: 0.4, step: 0.05}, height: 0.02"
        run = analyses(gauges, "kind: correlation, name: c, of: g, pairs: [[p, vx], [p, vy], [vx, vy]], from: 0.1")
        for k, (s, q) in enumerate(zip(scatter(40), scatter(100)[60:], strict=True)):
            state = frame(lattice(x1=0.5, y1=0.06))
            x = state.x[:, 0]
            state.arrays["pressure"][:] = s
            state.arrays["velocity"][:, 0] = np.where(x < 0.25, 2 * s, q)  # follows the pressure near the toe alone
            state.arrays["velocity"][:, 1] = -s + (1e3 if k < 10 else 0) * (x > 2)
            run.take(state, 0.01 * k)
        run.finish()
        assert run.column("c", "r_p_vx")[0] == pytest.approx(1) and abs(run.column("c", "r_p_vx")[1]) < 0.5
        assert run.column("c", "r_p_vy") == pytest.approx([-1, -1]) and run.column("c", "r_vx_vy")[0] == pytest.approx(-1)
        assert run.column("c", "distance").tolist() == [0.05, 0.2] and run.scalar("c", "r_p_vy_most") == pytest.approx(1)

    def test_unknown_series(self, analyses):  # noqa: F811
        run = analyses("kind: gauges, name: g, toe: 0.1, distances: [0], x: [0, 0.2]", "kind: correlation, name: c, of: g, pairs: [[p, vx]]")
        run.take(frame(lattice(x1=0.3)), 0)
        assert "no series 'p'" in run.finish(good=False)


def test_main_peak_weighs_all_series_alike():
    f = np.arange(41) * 0.05

    def peak(at, height, floor=0.0):
        return Spectrum(f, height * np.exp(-((f - at) ** 2) / 0.005) + floor + 1e-12, 1)

    assert main_peak([peak(0.5, 1e6), peak(1.0, 1e-3), peak(1.0, 2.0)], 0.1, 2) == pytest.approx(1.0, abs=0.01)
    assert math.isnan(main_peak([Spectrum(f, np.zeros(41), 1)], 0.1, 2))


def test_same_peak_of_surface_and_pressure(analyses):  # noqa: F811
    """A surface and a pressure that swing with 0.5 Hz, and a velocity that does not: judged by bins."""
    keys = "segment: 8, band: [0.2, 5]"
    run = analyses(
        "kind: gauges, name: g, of: [p, vx], toe: 0.1, distances: [0.05, 0.2], x: {from: 0.1, to: 0.4, step: 0.05}, height: 0.02",
        f"kind: spectrum, name: same, of: g, only: [level, p], {keys}",
        f"kind: spectrum, name: all, of: g, only: [level, p, vx@0.05], {keys}",
    )
    for k in range(160):
        t = 0.1 * k
        state = stretched(lambda x, t=t: 1 + 0.2 * np.sin(np.pi * t) + 0 * x)
        state.arrays["pressure"][:] = 1e3 + 50 * np.sin(np.pi * t + 1) + 5 * np.sin(6 * np.pi * t)
        state.arrays["velocity"][:, 0] = np.sin(4 * np.pi * t)
        run.take(state, t, slack=0.025)
    run.finish()
    assert run.scalar("same", "main_peak") == pytest.approx(0.5, abs=0.03) and run.scalar("same", "same_peak_share") == 1
    assert len(run.column("same_peaks", "f")) == 4 and len(run.column("all_peaks", "f")) == 5
    assert run.scalar("all", "same_peak_share") == 0.8 and run.column("all_peaks", "bins_off")[-1] == pytest.approx((2 - 0.5) * 8, abs=0.5)


def test_mass_balance_of_a_filling_basin(analyses):  # noqa: F811
    """In with 2 m/s over 0.1 m, out with 1.5 m/s: half a cubic metre per second and metre stays."""
    run = analyses("kind: mass_balance, name: m, at: [0.2, 0.8], expected: 200")
    for k in range(5):
        state = frame(lattice(y1=0.1), v=lambda x, y: np.where(x < 0.5, 2.0, 1.5))
        state.arrays["mass"][(state.x[:, 0] > 0.3) & (state.x[:, 0] < 0.7)] *= 1 + 0.025 * k  # 40 kg become 50 * 0.025 * k more each 0.02 s
        state.arrays["mass"][state.x[:, 0] > 0.9] *= 1 - 0.1 * k  # beyond the planes
        run.take(state, 0.02 * k)
    run.finish()
    assert run.scalar("m", "inflow_mean") == pytest.approx(200, rel=0.002) and run.scalar("m", "outflow_mean") == pytest.approx(150, rel=0.002)
    assert run.scalar("m", "stored") == pytest.approx(0.025 * 40 / 0.02, rel=1e-6)
    assert run.scalar("m", "missing") == pytest.approx(0, abs=0.5) and run.scalar("m", "out_over_in") == pytest.approx(0.75, abs=0.003)
    assert run.scalar("m", "in_over_expected") == pytest.approx(1, abs=0.002)


def test_what_is_stored_is_what_flows(analyses):  # noqa: F811
    """A body of water that comes in and is still inside: nothing is missing, at whatever place its front stands."""
    run = analyses("kind: mass_balance, name: m, at: [0.2, 0.8], from: 0, to: 0.1")
    for k in range(101):
        run.take(frame(lattice(x1=0.3, y1=0.05) + [0.003 * k, 0, 0], v=lambda x, y: 0 * x + 3), 0.001 * k, slack=2.5e-4)
    run.finish()
    assert run.column("m", "mass")[[0, -1]] == pytest.approx([5, 15], abs=0.01), "the front at 0.3 and at 0.6"
    assert run.scalar("m", "stored") == pytest.approx(100, abs=0.1) and run.scalar("m", "missing") == pytest.approx(0, abs=0.05)


def test_soundness(analyses, tmp_path):  # noqa: F811
    run = analyses("kind: soundness, name: s, c0: 20, rho0: 1000, from: 0.1")
    for k, speed in enumerate((9.0, 1.0, 2.0)):
        state = frame(lattice(x1=0.1), v=lambda x, y, speed=speed: np.where(x < 0.01, speed, 0))
        state.arrays["density"][0] = 990 + 10 * k
        run.take(state, 0.1 * k)
    (tmp_path / "summary.yaml").write_text(
        "verdict: sound\nleaked_particles: 3\nranges:\n  - {part: 1, speed: {value: 4}, density_ratio_low: {value: 0.9}, density_ratio_high: {value: 1.1}}\n"
    )
    run.finish()
    assert run.scalar("s", "mach_most") == pytest.approx(0.1) and run.scalar("s", "mach_of_run") == pytest.approx(0.2)
    assert run.scalar("s", "density_least") == 1 and run.scalar("s", "density_most") == pytest.approx(1.01)
    assert run.scalar("s", "leaked_particles") == 3 and run.scalar("s", "density_of_run_least") == 0.9
    assert run.recipe.analyses[0].result.words == {"verdict": "sound"}


def test_arrays_that_the_files_lack(tmp_path, monkeypatch):
    """Field files without density and smoothing length: refused, unless the recipe tells them, and then said."""
    import made_runs

    whole = made_runs.write_fields

    def without(path, sections, points, cells=0, packing="zlib"):
        lacking = [(name, {k: v for k, v in arrays.items() if k not in ("density", "smoothing_length")}) for name, arrays in sections]
        whole(path, lacking, points, cells, packing)

    monkeypatch.setattr(made_runs, "write_fields", without)
    write_run(tmp_path, [frame(lattice(x1=0.2), t=0.1 * k, v=lambda x, y: 7 * y) for k in range(2)], title="small files")
    recipe = tmp_path / "recipe.yaml"
    text = "analyses: [{kind: surface, name: s, x: 0.1}, {kind: soundness, name: sound, c0: 20, rho0: 1000}]\n"
    views = "views: [{name: w, field: vorticity}]\n"
    for head, good in (("", False), (f"missing: {{density: 1000, smoothing_length: {1.2 * DX}}}\n", True)):
        recipe.write_text(head + text + views)
        said: list[str] = []
        told = Diagnostics()
        assert run_post(recipe, tmp_path, said.append, told) == good, told.text()
        assert ("`missing: {density: 1000}`" in told.text()) != good
    with pytest.raises(UnknownField, match="the file lacks density, smoothing_length: `missing` of a recipe"):
        field_of(courant.open(tmp_path).states[-1], "vorticity")
    with pytest.raises(UnknownField, match="lacks density, smoothing_length"):
        scene_of(courant.open(tmp_path).states[-1], View("p", "pressure"))
    assert "no density: 1000 of the recipe" in "".join(said) and "density unknown" in "".join(said)
    found = yaml.safe_load((tmp_path / "results.yaml").read_text())["analyses"]
    assert found["s"]["depth_mean"]["value"] == pytest.approx(0.1, abs=6e-4) and (tmp_path / "post/w.png").is_file()
    assert math.isnan(found["sound"]["density_least"]["value"])
    frames = read_particles(read_states(tmp_path, told)[0], [Wanted("density", optional=True)], told, {"density": 900, "smoothing_length": 0.01})
    monkeypatch.undo()
    write_run(tmp_path / "whole", [frame(lattice(x1=0.2))])
    state = read_states(tmp_path / "whole", told)[0]
    assert read_particles(state, [], told, {"density": 900}).V[0] == pytest.approx(DX**2), "what the files have is taken"
    assert "density" not in frames.arrays and frames.V[0] == pytest.approx(1000 * DX**2 / 900)
