"""Analyses of recipes over particles with known fields."""

from __future__ import annotations

import math

import h5py
import numpy as np
import pytest
from courant.diagnostics import Diagnostics
from courant.post.recipe import read_recipe
from courant.post.run import _finish
from courant.post.state import State
from made_runs import DX, block, frame, lattice, write_history

SLACK = 6e-4  # a tenth of h


class Analyses:
    """A recipe that was read and sees states."""

    def __init__(self, folder, text):
        (folder / "recipe.yaml").write_text(text)
        self.folder, self.out, self.diagnostics, self.said = folder, folder / "post", Diagnostics(), ""
        self.recipe = read_recipe(folder / "recipe.yaml", self.diagnostics)
        assert self.recipe, self.diagnostics.text()
        for one in self.recipe.analyses:
            one.out = self.out

    def take(self, state, t, slack=0.0025):
        state.t = t
        seen = State(state, slack)
        for one in self.recipe.analyses:
            if one.needs_states and one.looks_at(t, slack):
                one.take(t, slack, one.measure(seen))

    def finish(self, *, good=True):
        _finish(self.recipe, self.folder, self.out, self._say, self.diagnostics)
        assert self.diagnostics.ok == good, self.diagnostics.text()
        return self.diagnostics.text()

    def _say(self, text):
        self.said += text

    def column(self, table, name):
        (found,) = (one for analysis in self.recipe.analyses for one in analysis.result.tables if one.name == table)
        return found[name]

    def scalar(self, analysis, name):
        (value,) = (s.value for one in self.recipe.analyses if one.name == analysis for s in one.result.scalars if s.name == name)
        return value


@pytest.fixture
def analyses(tmp_path):
    return lambda *entries, head="": Analyses(tmp_path, head + "analyses:\n" + "".join(f"  - {{{entry}}}\n" for entry in entries))


def test_profile_means_leave_out_what_is_not_water(analyses):
    run = analyses("kind: profile, name: u, of: [vx], x: [0.1], y: {from: 0.01, to: 0.09, step: 0.02}, interpolation: mls")
    for s in range(4):  # three states of deep water, one of shallow
        run.take(frame(lattice(x1=0.2, y1=0.04 if s == 2 else 0.1, jitter=0.3), v=lambda x, y: 1 + 10 * y), 0.01 * s)
    run.finish()
    assert run.column("u", "vx_mean") == pytest.approx(1 + 10 * run.column("u", "y"), abs=1e-10)  # no zeros among them
    assert run.column("u", "wet")[[0, 4]].tolist() == [1, 0.75] and run.column("u", "colour")[2] == pytest.approx(0.75, abs=0.05)


def test_points_that_are_rarely_wet_have_no_mean(analyses):
    run = analyses("kind: profile, name: u, of: [vx], x: 0.1, y: [0.01, 0.09], from: 0.02, least_wet: 0.6")
    for s in range(4):
        run.take(frame(lattice(x1=0.2, y1=0.04 if s % 2 else 0.1), v=lambda x, y, s=s: 0 * x + s), 0.01 * s)
    run.finish()
    assert run.column("u", "vx_mean")[0] == pytest.approx(2.5)  # states 2 and 3: the window begins at 0.02
    assert run.column("u", "vx_deviation")[0] == pytest.approx(0.5) and np.isnan(run.column("u", "vx_mean")[1])
    assert run.column("u", "wet")[1] == 0.5


def test_grid_files_for_paraview(analyses):
    run = analyses(
        "kind: grid, name: field, of: [vx, {name: q, of: 0.5 * rho * speed^2, unit: Pa}], x: {from: 0, to: 0.2, step: 0.02}, "
        "y: {from: 0.01, to: 0.15, step: 0.02}, states: true",
        head="units: {length: mm, mass: g, time: ms}\n",
    )
    for s in range(2):
        run.take(frame(lattice(x1=0.2), v=lambda x, y: 0 * x + 2), 0.01 * s)
    run.finish()
    head = (run.out / "field.csv").read_text().split("\n")[0]
    assert head == "x [mm],y [mm],vx_mean [mm/ms],vx_deviation [mm/ms],q_mean [Pa],q_deviation [Pa],wet [-],colour [-]"
    assert run.column("field", "q_mean")[5] == pytest.approx(2000)
    assert 'timestep="0.01" part="0" file="field/field_0001.vti"' in (run.out / "field.pvd").read_text()
    with h5py.File(run.out / "tables.h5") as h5:
        assert np.array_equal(h5["field/q_mean"][:], run.column("field", "q_mean"), equal_nan=True) and h5["field/x"].attrs["unit"] == b"mm"
    vtk = pytest.importorskip("vtkmodules.vtkIOXML")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    for name in ("field.vti", "field/field_0000.vti", "field/field_0001.vti"):
        reader = vtk.vtkXMLImageDataReader()
        reader.SetFileName(str(run.out / name))
        reader.Update()
        image = reader.GetOutput()
        assert image.GetDimensions() == (11, 8, 1) and image.GetSpacing()[:2] == pytest.approx((0.02, 0.02)) and image.GetOrigin()[1] == 0.01
    assert image.GetFieldData().GetArray("TimeValue").GetValue(0) == 0.01
    reader.SetFileName(str(run.out / "field.vti"))
    reader.Update()
    found = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("q_mean"))
    assert np.array_equal(found, run.column("field", "q_mean").astype("f4"), equal_nan=True)


def test_surface_over_a_bed_without_spray(analyses):
    keys = "x: {from: 0.1, to: 0.4, step: 0.1}, bed: 0.01 + 0 * x"
    run = analyses(
        f"kind: surface, name: top, layers: true, {keys}", f"kind: surface, name: first, surface: first, {keys}", f"kind: surface, name: all, share: 0, {keys}"
    )
    drop, tongue = lattice(x0=0.19, x1=0.21, y0=0.07, y1=0.08), lattice(x0=0.29, x1=0.43, y0=0.08, y1=0.10)
    run.take(frame(lattice(x1=0.5, y0=0.01, y1=0.05), drop, tongue, lattice(x0=0.42, x1=0.43, y0=0.05, y1=0.08)), 0)
    run.finish()
    top, first, everything = (run.column(f"{name}_mean", "mean") for name in ("top", "first", "all"))
    assert top[:3] == pytest.approx([0.04, 0.04, 0.09], abs=SLACK)  # the drop over 0.2 is spray
    assert first[2] == pytest.approx(0.04, abs=SLACK) and everything[1] == pytest.approx(0.07, abs=2 * SLACK)
    assert len(run.column("top_layers", "low")) == 6  # four locations, two with two pieces
    assert len(run.column("top", "depth@0.3")) == 1


def stretched(of):
    """Columns of particles up to y = 0.06 times of(x)."""
    x, k = (one.ravel() for one in np.meshgrid((np.arange(50) + 0.5) * 0.01, np.arange(12), indexing="ij"))
    s = of(x)
    return frame(np.column_stack([x, (k + 0.5) * DX * s, 0 * x]), dx=DX * np.sqrt(2 * s))


def test_spectrum_of_a_travelling_wave(analyses):
    run = analyses("kind: surface, name: gauges, x: [0.2, 0.3, 0.4]", "kind: spectrum, name: spectra, of: gauges, segment: 1.5, band: [0.7, 15]")
    f, k, amplitude = 2.6, 2 * np.pi / 0.4, 0.01
    for t in 0.025 * np.arange(120):
        run.take(stretched(lambda x, t=t: 1 + amplitude / 0.06 * np.sin(k * x - 2 * np.pi * f * t)), t)
    run.finish()
    assert run.column("spectra_peaks", "f") == pytest.approx([f] * 3, abs=0.05)
    assert run.column("gauges_mean", "deviation") == pytest.approx([amplitude / math.sqrt(2)] * 3, abs=0.08 * amplitude)
    assert run.scalar("spectra", "dominant_of_mean") == pytest.approx(f, abs=0.05)
    assert run.scalar("spectra", "resolution") == pytest.approx(1 / 1.5, abs=0.01)


def test_flux_of_a_uniform_stream(analyses):
    run = analyses("kind: flux, name: through, at: [0.3, 0.503], g: 10, level: -1")
    state = frame(lattice(y1=0.1), v=lambda x, y: np.column_stack([0 * x + 2, 0 * x - 1]) @ np.eye(2, 3))
    state.arrays["pressure"][:] = 500
    run.take(state, 0)
    run.finish()
    m = 1000 * 2 * 0.1
    exact = {"mass": m, "volume": 0.2, "momentum_x": 2 * m, "momentum_y": -m, "pressure_force": 50, "kinetic": 2.5 * m}
    for name, value in (exact | {"potential": m * 10 * 1.05, "pressure_work": 100}).items():
        assert run.column("through_mean", f"{name}_mean") == pytest.approx([value] * 2, rel=0.002), name  # of the kernel's sum over a lattice
    head = (run.out / "through_mean.csv").read_text().split("\n")[0]
    assert "mass_mean [kg/(m s)]" in head and "momentum_x_mean [N/m]" in head and "kinetic_mean [W/m]" in head


def test_flux_across_the_flow_within_an_extent_and_outside(analyses):
    run = analyses("kind: flux, name: across, normal: y, at: 0.05, x: [0.25, 0.75]", "kind: flux, name: outside, at: 3")
    run.take(frame(lattice(y1=0.1), v=lambda x, y: np.column_stack([0 * x + 2, 0 * x - 1, 0 * x])), 0)
    run.finish()
    assert run.column("across_mean", "mass_mean") == pytest.approx([-500], abs=1.5)
    assert run.column("outside_mean", "mass_mean")[0] == 0


def test_the_flux_over_all_planes_is_the_sum_over_the_particles(analyses):
    run = analyses("kind: flux, name: q, at: {from: -0.05, to: 0.25, step: 0.001}")
    state = frame(lattice(x1=0.2, jitter=0.8), v=lambda x, y: 1 + x)
    run.take(state, 0)
    run.finish()
    exact = (state.arrays["mass"] * state.arrays["velocity"][:, 0]).sum()
    assert run.column("q_mean", "mass_mean").sum() * 0.001 == pytest.approx(exact, rel=1e-4)


def test_inactive_particles_do_not_count(analyses):
    run = analyses("kind: flux, name: q, at: 0.5", "kind: surface, name: s, x: 0.5")
    state = frame(lattice(y1=0.1), v=lambda x, y: 0 * x + 2)
    state.arrays["active"][state.x[:, 1] >= 0.05] = 0
    run.take(state, 0)
    run.finish()
    assert run.column("q_mean", "mass_mean") == pytest.approx([100], abs=0.2) and run.column("s", "depth") == pytest.approx([0.05], abs=SLACK)


def test_probe_over_time_and_selection(analyses):
    run = analyses("kind: probe, name: p, of: [vx, vx * y], at: [[0.1, 0.05], [0.1, 0.3]], interpolation: mls, where: 0.08 - y")
    for s in range(3):
        run.take(frame(lattice(x1=0.2), v=lambda x, y, s=s: s + x), 0.1 * s)
    run.finish()
    assert run.column("p", "vx_1") == pytest.approx([0.1, 1.1, 2.1], abs=1e-10) and np.isnan(run.column("p", "vx_2")).all()
    assert run.scalar("p", "vx_1_mean") == pytest.approx(1.1) and run.column("p", "vx*y_1") == pytest.approx([0.005, 0.055, 0.105], abs=1e-10)


def test_up_is_z(analyses):
    run = analyses("kind: surface, name: s, x: [0.02], across: 0.03, bed: 0.01", "kind: flux, name: q, at: 0.03, g: 10", head="up: z\n")
    run.take(frame(block(12, 12, 8), dim=3, v=lambda x, y: 0 * x + 3), 0)
    run.finish()
    mass = 1000 * 3 * 0.06 * 0.04
    assert run.column("s", "depth") == pytest.approx([0.03], abs=SLACK)
    assert run.column("q_mean", "mass_mean") == pytest.approx([mass], rel=0.002)
    assert run.column("q_mean", "potential_mean") == pytest.approx([mass * 10 * 0.02], abs=0.002 * mass * 0.2)
    assert "mass_mean [kg/s]" in (run.out / "q_mean.csv").read_text()


def test_toe_follows_a_step(analyses):
    run = analyses("kind: surface, name: s, x: {from: 0.05, to: 0.95, step: 0.01}", "kind: toe, name: toe, of: s, depth: 0.05, from: 0.1")
    for s in range(5):
        at = 0.9 if s == 0 else 0.7 - 0.1 * s
        run.take(frame(lattice(x1=at, y1=0.02), lattice(x0=at, y1=0.08)), 0.1 * s)
    run.finish()
    assert run.column("toe", "toe")[1:] == pytest.approx([0.6, 0.5, 0.4, 0.3], abs=0.006)  # half an h and a bit
    assert run.scalar("toe", "toe_speed") == pytest.approx(-1, abs=0.01) and run.scalar("toe", "toe_mean") == pytest.approx(0.45, abs=0.006)


def test_roller_length_and_decay(analyses):
    """Mean velocity 1.5 m/s exp(-0.028 (x - x1)/d1) at the bed and a straight line to a surface velocity that changes its sign at 0.25."""
    run = analyses(
        "kind: profile, name: u, of: [vx], x: {from: 0.025, to: 0.6, step: 0.025}, y: {from: 0.0025, to: 0.0775, step: 0.0125}, interpolation: mls",
        "kind: roller, name: jump, profile: u, toe: 0.05, v1: 1.5, d1: 0.02",
    )

    def u(x, y):
        bed = 1.5 * np.exp(-0.028 * (x - 0.05) / 0.02)
        return bed + (x - 0.25 - bed) * (y - 0.0025) / 0.075

    run.take(frame(lattice(x1=0.7, y1=0.08), v=u), 0)
    run.finish()
    assert run.scalar("jump", "roller_length") == pytest.approx(10, abs=0.05) == run.scalar("jump", "roller_length_surface")
    assert run.scalar("jump", "roller_length_reference") == pytest.approx(14.8355, abs=1e-3) and run.scalar("jump", "decay_rms") < 0.002


def test_roller_frequency_of_most_gauges_over_it(analyses):
    """A slow swing at one gauge over the roller and at one behind it outweighs the rest: it is the dominant one of the mean spectrum, but
    not of the median over the roller."""
    run = analyses(
        "kind: surface, name: gauges, x: [0.12, 0.2, 0.3, 0.45, 0.48]",
        "kind: spectrum, name: spectra, of: gauges, segment: 3, band: [0.5, 15]",
        "kind: roller, name: jump, spectrum: spectra, toe: 0.1, v1: 1.5, d1: 0.02",
    )
    fast, slow = 2.6, 1.0
    for t in 0.025 * np.arange(240):

        def of(x, t=t):
            swings = (np.abs(x - 0.2) < 0.04) | (x > 0.4)
            return 1 + np.where(swings, 0.3 * np.sin(2 * np.pi * slow * t), 0.1 * np.sin(2 * np.pi * fast * t))

        run.take(stretched(of), t)
    run.finish()
    assert run.scalar("jump", "strouhal") == pytest.approx(slow * 0.02 / 1.5, rel=0.02)
    assert run.scalar("jump", "strouhal_median") == pytest.approx(fast * 0.02 / 1.5, rel=0.02)


def history(folder, states=11, gap=()):
    s = np.arange(states)
    force = np.column_stack([np.ones(states), -1.0 * s, np.zeros(states)])
    force[list(gap)] = np.nan
    write_history(
        folder,
        {
            "global/time": (0.1 * s, "T"),
            "global/kinetic": (3 + np.sin(0.1 * s), "ML2/T2"),
            "global/dt": (0.01 + 0.001 * np.sin(0.2 * s), "T"),
            "global/velocity": (np.tile([0.0, 4, 0], (states, 1)), "L/T"),
            "contacts/7/force": (force, "ML/T2"),
        },
    )


def test_force_on_the_walls_from_histories(analyses, tmp_path):
    run = analyses(
        "kind: force, name: wall, contacts: [7], from: 0.5",
        "kind: history, name: h, of: [global/kinetic, {name: v, of: global/velocity.y, factor: 2, unit: mm/s}]",
    )
    history(tmp_path)
    run.finish()
    assert run.column("wall", "force_y_contact7")[4] == pytest.approx(4)  # on the wall: against that on the particles
    assert run.scalar("wall", "force_y_contact7_mean") == pytest.approx(7.5)
    assert run.scalar("wall", "force_y_contact7_integral") == pytest.approx(3.75)
    assert (run.column("h", "v") == 8).all() and "force_y_contact7 [N]" in (run.out / "wall.csv").read_text()


def test_a_gap_is_no_force_of_0(analyses, tmp_path):
    run = analyses("kind: force, name: before, contacts: [7], to: 2", "kind: force, name: over, contacts: [7]")
    history(tmp_path, 51, range(30, 41))
    run.finish()
    assert run.scalar("before", "force_x_contact7_integral") == pytest.approx(-2)
    assert run.scalar("over", "force_x_contact7_mean") == pytest.approx(-1) and math.isnan(run.scalar("over", "force_x_contact7_integral"))


def test_spectrum_of_series_of_different_units_has_no_mean(analyses, tmp_path):
    run = analyses("kind: history, name: h, of: [global/kinetic, global/dt], to: 5", "kind: spectrum, name: s, of: h, segment: 2")
    history(tmp_path, 51)
    assert "have different units: they have no mean" in run.finish()
    assert math.isnan(run.scalar("s", "dominant_of_mean")) and np.isnan(run.column("s", "mean")).all()
    assert run.column("s", "global/kinetic")[1] > 0


def test_spectrum_leaves_out_a_series_with_a_gap(analyses, tmp_path):
    run = analyses("kind: history, name: h, of: [global/kinetic, contacts/7/force.y]", "kind: spectrum, name: s, of: h")
    history(tmp_path, 51, range(20, 33))
    assert "the series contacts/7/force.y of 'h' has a gap of more than 10 states and is left out" in run.finish()
    assert len(run.column("s_peaks", "f")) == 1


def test_ascii_histories_here_and_elsewhere(analyses, tmp_path):
    run = analyses(
        "kind: history, name: ours, file: rcforc, id: 7, of: [{name: push, of: y, side: SURFB, factor: 2}, {name: x, of: x, side: SURFA, unit: lbf}]",
        "kind: history, name: theirs, file: lsdyna/rcforc_of_mine, side: SURFA, of: [y, mx], from: 0.15",
    )

    def lines(t, y, more=""):
        sides = ("SURFA", 1.0, y), ("SURFB", -1.0, -y)
        return "".join(f"  {side}           7 time {t:11.5E}  x {x:12.5E}  y {f:12.5E}  z  0.00000E+00{more}\n" for side, x, f in sides)

    (tmp_path / "rcforc").write_text(" title\n  date\n" + "".join(lines(0.1 * s, -s) for s in range(3)))
    (tmp_path / "lsdyna").mkdir()
    (tmp_path / "lsdyna/rcforc_of_mine").write_text(" title\n  date\n" + "".join(lines(0.05 * s, s, "  mx  2.50000E+00") for s in range(5)))
    run.finish()
    assert run.column("ours", "push").tolist() == [0, 2, 4] and run.column("theirs", "y_SURFA").tolist() == [0, 1, 2, 3, 4]
    assert run.column("theirs", "t")[3] == 0.15 and run.scalar("theirs", "y_SURFA_mean") == pytest.approx(3.5)
    assert (run.out / "ours.csv").read_text().startswith("t [s],push [N],x [lbf]")


@pytest.mark.parametrize(
    "entry, fault",
    [
        ("kind: surface, name: s, x: 0.1, from: 5", "recipe.yaml:2:5: error: analysis 's': the results have no state in its window in time"),
        ("kind: force, name: f, contacts: [7], from: 5.5, to: 7", "analysis 'f': the results have no state in its window"),
        ("kind: force, name: f, contacts: [3]", "analysis 'f': history.h5 has no dataset '/contacts/3/force' with component 0\n  hint: did you mean"),
        ("kind: history, name: h, file: nowhere, of: [x]", "nowhere: error: cannot read the history"),
        ("kind: history, name: h, file: glstat, of: [kinetic energi]", "glstat has no 'kinetic energi'\n  hint: did you mean 'kinetic energy'?"),
        ("kind: history, name: h, file: glstat, id: 3, of: [kinetic energy]", "has no 'kinetic energy' of 3\n  hint: it belongs to the whole"),
    ],
)
def test_faults_of_results_name_the_analysis(analyses, tmp_path, entry, fault):
    run = analyses(entry)
    history(tmp_path)
    (tmp_path / "glstat").write_text(
        " dt of cycle       1 is controlled by sph 1\n time...........................   0.00000E+00\n kinetic energy.................   1.00000E+00\n"
    )
    run.take(frame(lattice(x1=0.2)), 0)
    assert fault in run.finish(good=False)


def test_what_stands_on_a_fault_is_told_too(analyses):
    run = analyses("kind: surface, name: s, x: 0.1", "kind: toe, name: toe, of: s, depth: 0.05, from: 5", "kind: spectrum, name: spectra, of: toe")
    for s in range(9):
        run.take(frame(lattice(x1=0.2)), 0.1 * s)
    assert "analysis 'toe': the results have no state in its window" in run.finish(good=False)
