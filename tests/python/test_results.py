"""`courant.open`: the results of a run with their units, as numpy, pandas, xarray, VTK and PyVista know them."""

from __future__ import annotations

import courant
import numpy as np
import pytest
from made_runs import frame, lattice, write_history, write_run
from test_ascii_histories import HEAD, glstat_state


@pytest.fixture
def run(tmp_path):
    t = np.arange(5.0)
    write_run(tmp_path, [frame(lattice(x1=0.2), t=one, v=lambda x, y, s=one: s + x) for one in t], "a title", shells=True)
    force = np.column_stack([t, 2 * t, 0 * t])
    datasets = {"global/time": (t, "T"), "global/total": (3 + 0 * t, "ML2/T2"), "global/kinetic": (t**2, "ML2/T2"), "global/dt": (0 * t, "T")}
    write_history(tmp_path, datasets | {"contacts/12/force": (force, "ML/T2"), "contacts/3/force": (-force, "ML/T2")})
    (tmp_path / "glstat").write_text(HEAD + glstat_state() + glstat_state(t="   1.00000E+00"))
    return courant.open(tmp_path)


def test_histories(run):
    assert np.array_equal(run.histories["global/kinetic"], np.arange(5.0) ** 2) and run.histories["contacts/3/force"].shape == (5, 3)
    assert run.histories.unit("contacts/3/force") == "N" and run.histories.groups == ["contacts/12", "contacts/3", "global"]
    assert run.energies.names == ["t", "kinetic", "total"] and run.energies.units["kinetic"] == "kg m2/s2" and len(run.energies) == 5
    assert list(run.contacts) == [3, 12] and np.array_equal(run.contacts[3]["force.y"], -2 * np.arange(5.0))
    with pytest.raises(KeyError, match="history.h5 has no dataset 'global/kin'; it has contacts/12/force, "):
        run.histories["global/kin"]
    with pytest.raises(KeyError, match="'energies' has no column 'kin'; it has t, kinetic, total"):
        run.energies["kin"]


def test_ascii_histories(run):
    assert list(run.ascii) == ["glstat"]
    table = run.ascii["glstat"]
    assert table["t"].tolist() == [0, 1] and table["stonewall_energy_2"].tolist() == [2, 2] and table.units["time_step"] == "s"
    with pytest.raises(KeyError, match="no history 'matsum'; it has glstat"):
        run.ascii["matsum"]


def test_a_table_is_a_mapping_of_its_columns(run):
    table = run.energies
    assert "kinetic" in table and "kin" not in table and 0 not in table
    assert list(table) == list(table.keys()) == table.names == ["t", "kinetic", "total"] and len(table) == table.rows
    assert all((values == table[name]).all() for name, values in dict(table).items())


def test_states(run):
    assert len(run.states) == 5 and run.states.times.tolist() == [0, 1, 2, 3, 4] and run.states.at(2.9).t == 3 and len(run.states[1:3]) == 2
    state = run.states[-1]
    assert state["velocity"][:, 0] == pytest.approx(4 + state.points[:, 0], rel=1e-6) and state["speed"].shape == (800,)
    assert state.units["velocity"] == "m/s" and state.unit("pressure") == "Pa" and state.unit("part") == "?" and len(state) == 800
    assert [one.tolist() for one in state.shells.cells] == [[0, 1, 2, 3], [1, 4, 5, 2]] and state.shells.points.shape == (6, 3)
    with pytest.raises(KeyError, match="has no array 'v'; it has velocity, "):
        state["v"]


def test_other_units(run):
    other = courant.open(run.folder, courant.Units("t", "mm", "s"))
    assert other.states[0].unit("velocity") == "mm/s" and other.energies.units["total"] == "t mm2/s2"


def test_summary(run):
    assert run.summary["title"] == "a title"
    (run.folder / "summary.yaml").write_text("[1")
    with pytest.raises(courant.CourantError, match="summary.yaml: error: not valid YAML"):
        courant.open(run.folder).summary  # noqa: B018


def test_what_is_not_there(tmp_path, run):
    with pytest.raises(courant.CourantError, match="no such folder"):
        courant.open(tmp_path / "nowhere")
    empty = tmp_path / "empty"
    empty.mkdir()
    for what in ("states", "histories", "energies", "contacts"):
        with pytest.raises(courant.CourantError, match="the file is missing"):
            getattr(courant.open(empty), what)
    assert courant.open(empty).summary == {} and len(courant.open(empty).ascii) == 0
    path = run.folder / "fields/particles_0000.vtp"
    path.write_bytes(path.read_bytes()[:-100])
    with pytest.raises(courant.CourantError, match="not a field file of `courant run`"):
        run.states[0].points  # noqa: B018


def test_pandas(run):
    pytest.importorskip("pandas")
    frame_of = run.energies.to_pandas()
    assert frame_of["kinetic"].loc[2.0] == 4 and frame_of.attrs["units"]["t"] == "s"
    points = run.states[1].to_pandas()
    assert points["velocity.x"].to_numpy() == pytest.approx(1 + points["x"].to_numpy(), rel=1e-6) and len(points) == 800
    assert run.histories.to_pandas("contacts/3")["force.y"].loc[1.0] == -2


def test_xarray(run):
    pytest.importorskip("xarray")
    data = run.energies.to_xarray()
    assert float(data["kinetic"].sel(t=3)) == 9 and data["kinetic"].attrs["units"] == "kg m2/s2"


def test_vtk(run):
    pytest.importorskip("vtkmodules.vtkIOXML")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    state = run.states[2]
    try:
        data = state.vtk()
    except courant.CourantError as fault:
        pytest.skip(str(fault))  # ParaView's VTK in Debian 12
    assert np.array_equal(vtk_to_numpy(data.GetPointData().GetArray("velocity")), state["velocity"])
    assert state.shells.vtk().GetNumberOfCells() == 2
    path = run.folder / "fields/particles_0002.vtp"
    content = bytearray(path.read_bytes())
    at = content.index(b"\n_") + 2
    content[at + 4 : at + 8] = bytes(4)  # blocks of nothing, by which VTK's reader divides
    path.write_bytes(content)
    with pytest.raises(courant.CourantError, match="damaged|too large"):
        courant.open(run.folder).states[2].vtk()


def test_pyvista(run):
    pytest.importorskip("pyvista")
    assert run.states[0].pyvista().n_points == 800


def test_plots(run, tmp_path):
    pytest.importorskip("matplotlib")
    run.plot(file=tmp_path / "a.png")
    run.plot("contacts/12", "force.x", file=tmp_path / "b.png")
    run.ascii["glstat"].plot("kinetic_energy", file=tmp_path / "c.png")
    picture = run.states[0].plot("pressure", file=tmp_path / "d.png", range=(0, 1))
    assert picture.axes[0].images and picture.axes[0].get_title(loc="right").startswith("t = 0")
    with pytest.raises(KeyError, match="did you mean pressure"):
        run.states[0].plot("presure")
    assert all((tmp_path / f"{name}.png").stat().st_size > 5000 for name in "abcd")
    with pytest.raises(KeyError, match="no column 'q'"):
        run.plot("energies", "q")


def test_a_missing_module_names_its_package(run, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="the Python module 'pandas' is missing.*: apt-get install python3-pandas"):
        run.energies.to_pandas()
