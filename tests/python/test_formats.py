"""Results that other tools open: one run with each kind of element is read by them, and by this package, number by number."""

from __future__ import annotations

import math
import signal
import subprocess
import time
from pathlib import Path

import courant
import numpy as np
import pytest
from courant.ascii_histories import ASCII_NAMES
from courant.d3plot import D3plotFault, D3plotFile
from mixed_run import COURANT, DECK, needs_courant, run

pytestmark = needs_courant


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run(DECK, tmp_path_factory.mktemp("mixed") / "run", "--d3plot")


@pytest.fixture(scope="module")
def results(folder: Path) -> courant.Results:
    return courant.open(folder)


@pytest.fixture(scope="module")
def d3plot(folder: Path) -> D3plotFile:
    return D3plotFile(folder / "d3plot")


def text_files(folder: Path) -> list[str]:
    heads = {file.name: file.read_bytes()[:200].split(b"\n") for file in folder.iterdir() if file.is_file()}
    return sorted(name for name, head in heads.items() if len(head) > 1 and head[1].lstrip().startswith(b"courant "))


# ------------------------------------------------------------------------------------------------------------------------------ histories


def test_every_text_history_of_a_run_is_in_the_table_and_read(folder: Path, results: courant.Results) -> None:
    written = text_files(folder)
    assert sorted(ASCII_NAMES) == written  # the deck asks for all of them
    assert sorted(results.ascii) == written
    times = results.ascii["glstat"]["t"]
    for name in written:
        if name == "jntforc":  # the scene has no joint
            continue
        np.testing.assert_allclose(results.ascii[name]["t"], times, rtol=1e-3, err_msg=name)
        assert all(unit != "?" for column, unit in results.ascii[name].units.items() if "yield" not in column), name


def test_joints_are_read(tmp_path: Path) -> None:
    states = "".join(
        f"\n time..........................{t:15.6E}\n joint ID......................{id:15d}\n x-force.......................{t + id:15.6E}\n"
        for t in (0.0, 0.5)
        for id in (1, 7)
    )
    (tmp_path / "jntforc").write_text(f" title\n                         courant 1\n{states}")
    table = courant.open(tmp_path).ascii["jntforc"]
    np.testing.assert_allclose(table["x_force_7"], [7.0, 7.5])


def test_elements_in_elout_are_those_of_the_field_files(results: courant.Results) -> None:
    elout, last = results.ascii["elout"], results.states[-1]
    solid = last.solids._values("CellData", "id").tolist().index(71)
    names = [f"sig_{axes}_71_solid_point_1" for axes in ("xx", "yy", "zz", "xy", "yz", "zx")]
    # four digits are printed
    np.testing.assert_allclose([elout[n][-1] for n in names], last.solids["stress"][solid], rtol=1e-4, atol=1e-4 * abs(last.solids["stress"]).max())
    shell = last.shells._values("CellData", "id").tolist().index(31)
    names = [f"sig_{axes}_31_shell_point_5" for axes in ("xx", "yy", "zz", "xy", "yz", "zx")]
    stress = last.shells["stress_upper"]
    np.testing.assert_allclose([elout[n][-1] for n in names], stress[shell], rtol=1e-4, atol=1e-4 * abs(stress).max())


def test_velocity_of_a_part_is_momentum_over_mass(results: courant.Results) -> None:
    matsum = results.ascii["matsum"]
    for part in (1, 2, 3, 6):
        mass, momentum = results.histories[f"parts/{part}/mass"], results.histories[f"parts/{part}/momentum"]
        for k, axis in enumerate("xyz"):
            scale = np.abs(momentum / mass[:, None]).max()
            np.testing.assert_allclose(matsum[f"{axis}_rbv_{part}"], momentum[:, k] / mass, rtol=1e-4, atol=1e-4 * scale)
    assert matsum["z_rbv_1"][0] == pytest.approx(-60)


def test_forces_of_a_single_surface_are_in_balance(results: courant.Results) -> None:
    rcforc, sleout = results.ascii["rcforc"], results.ascii["sleout"]
    for name in ("x_1_SURFA", "y_1_SURFA", "z_1_SURFA", "z_1_SURFB"):
        assert not rcforc[name].any()
    assert sleout["surfa_1"].max() > 1  # while there is contact


# ------------------------------------------------------------------------------------------------------------------------------- VTK files


def principal(stress: np.ndarray) -> np.ndarray:
    xx, yy, zz, xy, yz, zx = stress.astype(float).T
    return np.linalg.eigvalsh(np.moveaxis(np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]), -1, 0))[:, ::-1]


@pytest.mark.parametrize("kind, suffix", [("solids", ""), ("shells", "_lower"), ("shells", "_middle"), ("shells", "_upper")])
def test_invariants_are_those_of_the_stress(results: courant.Results, kind: str, suffix: str) -> None:
    mesh = getattr(results.states[-1], kind)
    stress, scale = mesh[f"stress{suffix}"].astype(float), float(np.abs(mesh[f"stress{suffix}"]).max())
    assert scale > 1e6
    deviator = stress - np.pad(np.repeat(stress[:, :3].mean(axis=1)[:, None], 3, axis=1), ((0, 0), (0, 3)))
    mises = np.sqrt(1.5 * ((deviator[:, :3] ** 2).sum(axis=1) + 2 * (deviator[:, 3:] ** 2).sum(axis=1)))
    np.testing.assert_allclose(mesh[f"von_mises{suffix}"], mises, rtol=1e-5, atol=1e-6 * scale)
    np.testing.assert_allclose(mesh[f"pressure{suffix}"], -stress[:, :3].mean(axis=1), rtol=1e-5, atol=1e-6 * scale)
    np.testing.assert_allclose(mesh[f"principal_stress{suffix}"], principal(stress), rtol=1e-5, atol=1e-6 * scale)


@pytest.mark.parametrize("kind", ["solids", "shells"])
def test_displacement_is_how_far_nodes_went(results: courant.Results, kind: str) -> None:
    first, last = getattr(results.states[0], kind), getattr(results.states[-1], kind)
    moved = {id: x for id, x in zip(last["id"].tolist(), last.points, strict=False)}
    start = {id: x for id, x in zip(first["id"].tolist(), first.points, strict=False)}
    for id, u in zip(last["id"].tolist(), last["displacement"], strict=False):
        np.testing.assert_allclose(u, moved[id] - start[id], atol=1e-6)
    assert np.abs(last["displacement"]).max() > 0.01


def names_of_parts(field_data: dict[str, np.ndarray]) -> dict[int, str]:
    return {int(np.ravel(value)[0]): name.partition(": ")[2] for name, value in field_data.items() if name.startswith("part ")}


TITLE = 'plate of <two> & "more" layers'


def test_meshio_reads_grids(folder: Path, results: courant.Results) -> None:
    meshio = pytest.importorskip("meshio")
    for kind in ("solids", "shells"):
        for k in (0, 5):
            mesh, ours = meshio.read(folder / f"fields/{kind}_{k:04d}.vtu"), getattr(results.states[k], kind)
            np.testing.assert_array_equal(mesh.points, ours.points)
            np.testing.assert_array_equal(mesh.point_data["displacement"], ours["displacement"])
            name = "von_mises" if kind == "solids" else "von_mises_upper"
            assert math.isclose(max(block.max() for block in mesh.cell_data[name]), ours[name].max())
            assert names_of_parts(mesh.field_data)[2] == TITLE


def test_pyvista_reads_states_by_the_one_index(folder: Path, results: courant.Results) -> None:
    pyvista = pytest.importorskip("pyvista")
    reader = pyvista.get_reader(folder / "fields.pvd")
    np.testing.assert_allclose(reader.time_values, results.states.times)
    reader.set_active_time_value(reader.time_values[4])
    blocks = reader.read()
    assert blocks.n_blocks == 3  # particles, shells, solids
    ours = results.states[4]
    for block, mesh in zip((blocks[0], blocks[1], blocks[2]), (ours, ours.shells, ours.solids), strict=True):
        np.testing.assert_array_equal(block.points, mesh.points)
        assert names_of_parts(dict(block.field_data))[2] == TITLE


@pytest.mark.parametrize("packing", [0, 1, 2])
def test_vtk_and_meshio_read_every_packing(tmp_path: Path, packing: int) -> None:
    vtk = pytest.importorskip("vtkmodules.vtkIOXML")
    support = pytest.importorskip("vtkmodules.util.numpy_support")
    deck = tmp_path / "packed.k"
    deck.write_text(DECK.read_text().replace("*END", f"*COURANT_OUTPUT\n0,64,{packing}\n*END"))
    ours = courant.open(run(deck, tmp_path / "run")).states[-1].solids
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(ours.path))
    reader.Update()
    grid = reader.GetOutput()
    np.testing.assert_array_equal(support.vtk_to_numpy(grid.GetPoints().GetData()), ours.points)
    np.testing.assert_array_equal(support.vtk_to_numpy(grid.GetCellData().GetArray("stress")), ours["stress"])
    try:
        import meshio
    except ImportError:
        return
    np.testing.assert_array_equal(meshio.read(ours.path).points, ours.points)


# ---------------------------------------------------------------------------------------------------------------------------------- d3plot


def test_d3plot_holds_what_the_field_files_hold(results: courant.Results, d3plot: D3plotFile) -> None:
    np.testing.assert_allclose(d3plot.times, results.states.times, rtol=1e-7)
    assert d3plot.parts == {1: "steel block", 2: TITLE, 3: "bars", 4: "rigid brick", 5: "rigid plate", 6: "water", 7: "spring"}
    for k, state in enumerate(results.states):
        nodes = d3plot.state(k).nodes
        place = {id: n for n, id in enumerate(d3plot.nodes.tolist())}
        for mesh in (state, state.shells, state.solids):
            at = [place[id] for id in mesh["id"].tolist()]
            np.testing.assert_array_equal(nodes["position"][at], mesh.points.astype("f4"))
            np.testing.assert_array_equal(nodes["velocity"][at], mesh["velocity"])


def cells_by_id(mesh: courant.results.Mesh, name: str) -> dict[int, np.ndarray]:
    return dict(zip(mesh._values("CellData", "id").tolist(), mesh[name], strict=True))


def test_d3plot_of_elements_is_that_of_the_field_files(results: courant.Results, d3plot: D3plotFile) -> None:
    for k, state in enumerate(results.states):
        ours, parts = d3plot.state(k), cells_by_id(state.solids, "part")
        solids = ours.elements("solids")
        for id, stress, plastic in zip(solids["id"].tolist(), solids["stress"], solids["plastic_strain"], strict=True):
            assert plastic == 0
            expected = cells_by_id(state.solids, "stress")[id] if id in parts and parts[id] == 1 else np.zeros(6)
            np.testing.assert_array_equal(stress, expected)
        shells = ours.elements("shells")
        for layer, suffix in enumerate(("_middle", "_lower", "_upper")):
            stress, strain = cells_by_id(state.shells, f"stress{suffix}"), cells_by_id(state.shells, f"plastic_strain{suffix}")
            history = cells_by_id(state.shells, f"history_1{suffix}")
            for row, id in enumerate(shells["id"].tolist()):
                if id == 34 or not shells["alive"][row]:
                    continue
                np.testing.assert_allclose(shells["stress"][row, layer], stress[id], rtol=1e-6, atol=1e-6 * np.abs(stress[id]).max())
                assert shells["plastic_strain"][row, layer] == strain[id]
                assert shells["history"][row, layer, 0] == history[id]
        thickness, moment = cells_by_id(state.shells, "shell_thickness"), cells_by_id(state.shells, "bending_moment")
        for row, id in enumerate(shells["id"].tolist()):
            if id != 34 and shells["alive"][row]:
                assert shells["thickness"][row] == thickness[id]
                np.testing.assert_array_equal(shells["bending_moment"][row], moment[id])
        force = cells_by_id(state.solids, "axial_force")
        beams = ours.elements("beams")
        spring = beams["id"] == 61
        np.testing.assert_allclose(beams["axial_force"][~spring], [force[id] for id in beams["id"][~spring].tolist()], rtol=1e-6)
        row = int(np.argmin(abs(results.ascii["deforc"]["t"] - ours.t)))
        np.testing.assert_allclose(beams["axial_force"][spring], results.ascii["deforc"]["resultant_force_61"][row], rtol=1e-5, atol=1e-30)
        assert beams["part"][spring].tolist() == [7] and not beams["torsion"][spring].any()


def test_d3plot_knows_which_elements_are_deleted(results: courant.Results, d3plot: D3plotFile) -> None:
    deleted = set()
    for k, state in enumerate(results.states):
        shells = d3plot.state(k).elements("shells")
        there = set(state.shells._values("CellData", "id").tolist())
        assert all((id in there) == alive for id, alive in zip(shells["id"].tolist(), shells["alive"], strict=True))
        deleted |= set(shells["id"][~shells["alive"]].tolist())
        assert d3plot.state(k).elements("solids")["alive"].all()
    assert deleted  # the deck's FAIL tears some


def test_d3plot_of_particles_and_sums(results: courant.Results, d3plot: D3plotFile) -> None:
    for k in (0, len(d3plot) - 1):
        state, particles = results.states[k], d3plot.state(k).particles()
        np.testing.assert_array_equal(particles["id"], state["id"])
        assert set(particles["part"].tolist()) == {6}
        for name in ("pressure", "density", "mass", "smoothing_length"):
            np.testing.assert_array_equal(particles[name], state[name], err_msg=name)
        np.testing.assert_allclose(particles["internal_energy"], state["internal_energy"] * 8e-3 / 1000, rtol=1e-6)
        np.testing.assert_array_equal(particles["active"], state["active"] != 0)
        np.testing.assert_array_equal(particles["stress"][:, 0], -state["pressure"])
        row = int(np.argmin(abs(results.histories["global/time"] - state.t)))
        sums = d3plot.state(k).globals()
        for n, part in enumerate(d3plot.part_ids.tolist()):
            np.testing.assert_allclose(sums["part_mass"][n], results.histories[f"parts/{part}/mass"][row], rtol=1e-6)
    assert results.states[0].t == 0


def test_d3plot_has_the_force_of_walls(results: courant.Results, d3plot: D3plotFile) -> None:
    rwforc = results.ascii["rwforc"]
    force = np.array([d3plot.state(k).globals()["wall_force"][0] for k in range(len(d3plot))])
    rows = [int(np.argmin(abs(rwforc["t"] - t))) for t in d3plot.times]
    np.testing.assert_allclose(force, rwforc["normal_1"][rows], rtol=1e-5, atol=1e-3)
    assert force.max() > 1e3


def test_d3plot_does_not_change_the_run(folder: Path, tmp_path: Path) -> None:
    other = run(DECK, tmp_path / "plain")
    for name in ("glstat", "nodout", "matsum", "elout", "sphout"):
        of = [(at / name).read_bytes().split(b"\n") for at in (folder, other)]
        assert [line for line in of[0] if b"nanosec" not in line] == [line for line in of[1] if b"nanosec" not in line], name
    assert (folder / "fields/solids_0009.vtu").read_bytes() == (other / "fields/solids_0009.vtu").read_bytes()
    assert not (other / "d3plot").exists()


def small_files(tmp_path: Path, size: str = "0.02", vtk: int = 0, bits: int = 32) -> Path:
    deck = tmp_path / "small.k"
    deck.write_text(DECK.read_text().replace("*END", f"*COURANT_D3PLOT\n{vtk},{bits},{size}\n*END"))
    return deck


def test_a_family_of_several_files_without_vtk(d3plot: D3plotFile, tmp_path: Path) -> None:
    to = run(small_files(tmp_path), tmp_path / "run")
    files = sorted(file.name for file in to.glob("d3plot*"))
    assert len(files) > 3 and files[1] == "d3plot01"
    assert not (to / "fields.pvd").exists() and not list((to / "fields").iterdir())
    ours = courant.open(to).d3plot
    np.testing.assert_array_equal(ours.times, d3plot.times)
    for k in range(len(d3plot)):
        np.testing.assert_array_equal(ours.state(k).nodes["position"], d3plot.state(k).nodes["position"])


def test_double_precision(results: courant.Results, tmp_path: Path) -> None:
    ours = courant.open(run(small_files(tmp_path, "0", 0, 64), tmp_path / "run")).d3plot
    assert ours.state(3).nodes["position"].dtype == np.float64
    np.testing.assert_array_equal(ours.state(3).particles()["pressure"].astype("f4"), results.states[3]["pressure"])
    assert ours.parts[2] == TITLE


def test_a_restart_goes_on_in_the_family(tmp_path: Path) -> None:
    text = small_files(tmp_path).read_text().replace("*END", "*DATABASE_BINARY_D3DUMP\n300\n*END")
    deck = tmp_path / "restart.k"
    deck.write_text(text)
    whole, parts = run(deck, tmp_path / "whole"), run(deck, tmp_path / "parts")
    dump = sorted((parts / "restart").glob("d3dump*"))[0]
    run(deck, parts, "--restart", str(dump))
    names = sorted(file.name for file in whole.glob("d3plot*"))
    assert names == sorted(file.name for file in parts.glob("d3plot*"))
    for name in names:
        assert (whole / name).read_bytes() == (parts / name).read_bytes(), name


@pytest.mark.parametrize(("gone", "says"), [("d3plot", "the file d3plot is missing"), ("d3plot01", "files of d3plot are missing")])
def test_a_restart_without_a_file_of_the_family_leaves_a_readable_one(tmp_path: Path, gone: str, says: str) -> None:
    deck = tmp_path / "restart.k"
    deck.write_text(small_files(tmp_path).read_text().replace("*END", "*DATABASE_BINARY_D3DUMP\n300\n*END"))
    to = run(deck, tmp_path / "run")
    before, names = D3plotFile(to / "d3plot").times, sorted(to.glob("d3plot*"))
    (to / gone).unlink()
    run(deck, to, "--restart", str(sorted((to / "restart").glob("d3dump*"))[0]))
    assert says in (to / "summary.yaml").read_text()
    assert sorted(to.glob("d3plot*")) == [name for name in names if name.name != gone or gone == "d3plot"], "no other file is deleted"
    if gone == "d3plot":
        np.testing.assert_array_equal(D3plotFile(to / gone).times, before)


def test_a_killed_run_leaves_a_readable_family(tmp_path: Path) -> None:
    deck = tmp_path / "long.k"
    deck.write_text(small_files(tmp_path).read_text().replace("*CONTROL_TERMINATION\n2e-3", "*CONTROL_TERMINATION\n20.").replace("*DATABASE_BINARY_D3PLOT\n1e-4", "*DATABASE_BINARY_D3PLOT\n1e-5"))
    to = tmp_path / "run"
    call = subprocess.Popen([COURANT, "run", str(deck), "-o", str(to), "--quiet", "--threads", "1"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for _ in range(600):
        if (to / "d3plot04").exists() or call.poll() is not None:
            break
        time.sleep(0.05)
    call.send_signal(signal.SIGKILL)
    call.wait()
    ours = D3plotFile(to / "d3plot")
    assert len(ours) > 5 and (np.diff(ours.times) > 0).all()
    assert np.isfinite(ours.state(len(ours) - 1).nodes["position"]).all()


@pytest.fixture(scope="module")
def strained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same run with strains and eight points of solids, of ELFORM 2, and an elastic plate."""
    at = tmp_path_factory.mktemp("strained")
    text = DECK.read_text().replace("*DATABASE_EXTENT_BINARY\n0,2,3,0,1,1,1,1\n0,0,2,1,1,1", "*DATABASE_EXTENT_BINARY\n2,2,3,1,1,1,1,1\n0,0,2,1,1,1\n8")
    text = text.replace("*MAT_PIECEWISE_LINEAR_PLASTICITY\n2,7850.,2.1e11,.3,1e8,1e9,.002", "*MAT_ELASTIC\n2,7850.,2.1e11,.3")
    text = text.replace("*SECTION_SOLID\n1,1", "*SECTION_SOLID\n1,2").replace("*PART\nrigid brick\n4,1,4", "*PART\nrigid brick\n4,8,4")
    text = text.replace("0.,0.,.015,0.,0.,.1", "0.,0.,-1.,0.,0.,.1")  # the block falls on the plate, not on the wall
    (at / "deck.k").write_text(text.replace("*SECTION_BEAM", "*SECTION_SOLID\n8,1\n*SECTION_BEAM"))
    return run(at / "deck.k", at / "run", "--d3plot")


def hooke(strain: np.ndarray, E: float = 2.1e11, nu: float = 0.3) -> np.ndarray:
    out = E / (1 + nu) * strain
    out[..., :3] += E * nu / ((1 + nu) * (1 - 2 * nu)) * strain[..., :3].sum(axis=-1, keepdims=True)
    return out


def test_strains_are_those_of_the_stress(strained: Path) -> None:
    """Stress and strain turn alike, so that Hooke's law ties them at every time however far the body has turned."""
    ours = courant.open(strained)
    state = ours.d3plot.state(-1)
    solids, shells = state.elements("solids"), state.elements("shells")
    block = solids["part"] == 1
    stress, strain = solids["stress"][block].astype(float), solids["strain"][block].astype(float)
    assert stress.shape == strain.shape == (2, 8, 6) and solids["history"].shape[-1] == 2
    assert abs(stress).max() > 1e7 and not np.allclose(stress[0, 0], stress[0, 7])
    np.testing.assert_allclose(hooke(strain), stress, rtol=1e-4, atol=1e-5 * abs(stress).max())
    plate = shells["part"] == 2
    strain, outer = shells["strain"][plate].astype(float), shells["stress"][plate][:, 1:].astype(float)
    assert abs(outer).max() > 1e7
    in_plane = hooke(strain)[..., [0, 1, 3]]
    np.testing.assert_allclose(in_plane, outer[..., [0, 1, 3]], atol=2e-2 * abs(outer).max())  # the plate has turned a little, and shear is softer by 5/6
    last, table = ours.states[-1], ours.histories
    row = last.solids._values("CellData", "id").tolist().index(71)
    np.testing.assert_allclose(last.solids["strain_tensor"][row], solids["strain"][solids["id"] == 71][0].mean(axis=0), rtol=1e-4, atol=1e-9)
    assert last.shells["strain_lower"].shape[1] == 6
    at = int(np.argmin(abs(table.t - state.t)))
    np.testing.assert_allclose(table["shells/31/strain_upper"][at], shells["strain"][shells["id"] == 31][0, 1], rtol=1e-5, atol=1e-9)
    text = ours.ascii["elout"]
    eps = [text[f"eps_{axes}_71_solid_point_3"][at] for axes in ("xx", "yy", "zz", "xy", "yz", "zx")]
    np.testing.assert_allclose(eps, solids["strain"][solids["id"] == 71][0, 2], rtol=1e-3, atol=1e-7)
    assert text["eps_xx_31_shell_lower"].shape == text["t"].shape


def test_strains_do_not_change_the_run(strained: Path, tmp_path: Path) -> None:
    text = (strained.parent / "deck.k").read_text().replace("2,2,3,1,1,1,1,1\n0,0,2,1,1,1\n8", "2,2,3,0,1,1,1,1\n0,0,2,1,1,1\n1")
    (tmp_path / "deck.k").write_text(text)
    other = run(tmp_path / "deck.k", tmp_path / "run")
    for name in ("glstat", "nodout", "matsum", "rcforc", "deforc"):
        of = [(at / name).read_bytes().split(b"\n") for at in (strained, other)]
        assert [line for line in of[0] if b"nanosec" not in line] == [line for line in of[1] if b"nanosec" not in line], name


def test_strains_go_on_after_a_restart(strained: Path, tmp_path: Path) -> None:
    deck = tmp_path / "deck.k"
    deck.write_text((strained.parent / "deck.k").read_text().replace("*END", "*DATABASE_BINARY_D3DUMP\n300\n*END"))
    parts = run(deck, tmp_path / "parts", "--d3plot")
    run(deck, parts, "--d3plot", "--restart", str(sorted((parts / "restart").glob("d3dump*"))[0]))
    for file in sorted(strained.glob("d3plot*")):
        assert file.read_bytes() == (parts / file.name).read_bytes(), file.name


def test_a_criterion_of_strain_leaves_that_of_the_law_alone(tmp_path: Path) -> None:
    """A cube of honeycomb that is torn fails at its own strain (TSEF 0.5), whatever *MAT_ADD_EROSION and STRFLG measure beside it."""
    text = (Path(__file__).resolve().parents[1] / "decks/accept/whole_honeycomb.k").read_text()
    text = text[: text.index("*INITIAL_VELOCITY")].replace("    1.0E-4\n", "    5.0E-2\n", 1) + (
        "*SET_NODE_LIST\n1\n2,3,6,7\n*SET_NODE_LIST\n2\n1,4,5,8\n*BOUNDARY_SPC_SET\n2,0,1,1,1\n*BOUNDARY_PRESCRIBED_MOTION_SET\n1,1,0,77,1.0\n"
        "*DEFINE_CURVE\n77\n0.0,20.0\n1.0,20.0\n"
    )
    failed = []
    for k, more in enumerate(("", "*MAT_ADD_EROSION\n1,0.,0.,0.\n0.,0.,0.,10.\n", "*DATABASE_EXTENT_BINARY\n0,0,3,1\n")):
        (tmp_path / f"{k}.k").write_text(text + more + "*END\n")
        said = (run(tmp_path / f"{k}.k", tmp_path / str(k)) / "messag").read_text()
        failed += [line.partition("time ")[2] for line in said.splitlines() if "failed at time" in line]
    assert len(failed) == 3 and len(set(failed)) == 1, failed


def test_lasso_reads_strains_and_points(strained: Path) -> None:
    lasso = pytest.importorskip("lasso.dyna")
    theirs, ours = lasso.D3plot(str(strained / "d3plot")).arrays, courant.open(strained).d3plot
    for k in range(len(ours)):
        solids, shells = ours.state(k).elements("solids"), ours.state(k).elements("shells")
        np.testing.assert_array_equal(theirs["element_solid_stress"][k], solids["stress"])
        np.testing.assert_array_equal(theirs["element_solid_strain"][k], solids["strain"])
        np.testing.assert_array_equal(theirs["element_shell_strain"][k], shells["strain"])
        np.testing.assert_array_equal(theirs["element_shell_internal_energy"][k], shells["internal_energy"])
        np.testing.assert_array_equal(theirs["node_displacement"][k], ours.state(k).nodes["position"])


def test_vtk_reads_strains(strained: Path, tmp_path: Path) -> None:
    """Of one point of solids: VTK 9.1 does not know NINTSLD 8, neither in files of LS-DYNA."""
    vtk = pytest.importorskip("vtkmodules.vtkIOLSDyna")
    support = pytest.importorskip("vtkmodules.util.numpy_support")
    (tmp_path / "deck.k").write_text((strained.parent / "deck.k").read_text().replace("0,0,2,1,1,1\n8", "0,0,2,1,1,1\n1"))
    of_one = run(tmp_path / "deck.k", tmp_path / "run", "--d3plot")
    ours = courant.open(of_one).d3plot
    assert ours.state(4).elements("solids")["strain"].shape == (3, 6)
    reader = vtk.vtkLSDynaReader()
    reader.SetFileName(str(of_one / "d3plot"))
    reader.UpdateInformation()
    reader.SetRemoveDeletedCells(0)
    reader.SetTimeStep(4)
    reader.UpdateTimeStep(float(ours.times[4]))
    reader.Update()
    for block, kind in ((0, "solids"), (1, "shells")):
        grid, table = reader.GetOutput().GetBlock(block), ours.state(4).elements(kind)
        rows, cells = table["part"] == block + 1, grid.GetCellData()
        array = {cells.GetArrayName(i): support.vtk_to_numpy(cells.GetArray(i)) for i in range(cells.GetNumberOfArrays())}
        np.testing.assert_array_equal(array["UserIds"], table["id"][rows])
        strains = sorted(name for name in array if name.startswith("Strain"))
        if kind == "shells":
            assert strains == ["StrainInnerSurf", "StrainOuterSurf"]
            np.testing.assert_array_equal(array["StrainInnerSurf"], table["strain"][rows, 0])
            np.testing.assert_array_equal(array["StrainOuterSurf"], table["strain"][rows, 1])
        else:
            np.testing.assert_array_equal(array["Strain"], table["strain"][rows])


def test_lasso_reads_d3plot(folder: Path, d3plot: D3plotFile) -> None:
    lasso = pytest.importorskip("lasso.dyna")
    theirs = lasso.D3plot(str(folder / "d3plot")).arrays
    np.testing.assert_array_equal(theirs["timesteps"], d3plot.times.astype("f4"))
    assert [title.decode().strip() for title in theirs["part_titles"]] == list(d3plot.parts.values())
    np.testing.assert_array_equal(theirs["node_ids"], d3plot.nodes)
    for kind in ("solid", "shell", "beam"):
        np.testing.assert_array_equal(theirs[f"element_{kind}_ids"], d3plot.ids[f"{kind}s"])
        np.testing.assert_array_equal(theirs[f"element_{kind}_node_indexes"][:, : d3plot.corners[f"{kind}s"].shape[1]], d3plot.corners[f"{kind}s"])
    for k in range(len(d3plot)):
        ours = d3plot.state(k)
        np.testing.assert_array_equal(theirs["node_displacement"][k], ours.nodes["position"])
        np.testing.assert_array_equal(theirs["node_velocity"][k], ours.nodes["velocity"])
        np.testing.assert_array_equal(theirs["node_acceleration"][k], ours.nodes["acceleration"])
        solids, shells, beams, particles = ours.elements("solids"), ours.elements("shells"), ours.elements("beams"), ours.particles()
        np.testing.assert_array_equal(theirs["element_solid_stress"][k, :, 0], solids["stress"])
        np.testing.assert_array_equal(theirs["element_shell_stress"][k], shells["stress"])
        np.testing.assert_array_equal(theirs["element_shell_effective_plastic_strain"][k], shells["plastic_strain"])
        np.testing.assert_array_equal(theirs["element_shell_history_vars"][k], shells["history"])
        np.testing.assert_array_equal(theirs["element_shell_thickness"][k], shells["thickness"])
        np.testing.assert_array_equal(theirs["element_shell_bending_moment"][k], shells["bending_moment"])
        np.testing.assert_array_equal(theirs["element_shell_normal_force"][k], shells["membrane_force"])
        np.testing.assert_array_equal(theirs["element_shell_is_alive"][k] != 0, shells["alive"])
        np.testing.assert_array_equal(theirs["element_beam_axial_force"][k], beams["axial_force"])
        np.testing.assert_array_equal(theirs["element_beam_axial_stress"][k], beams["beam_stress"][..., 0])
        for name, ours_name in (("sph_pressure", "pressure"), ("sph_density", "density"), ("sph_mass", "mass"), ("sph_stress", "stress")):
            np.testing.assert_array_equal(theirs[name][k], particles[ours_name], err_msg=name)
        sums = ours.globals()
        np.testing.assert_array_equal(theirs["part_mass"][k], sums["part_mass"])


def test_vtk_reads_d3plot(folder: Path, d3plot: D3plotFile) -> None:
    vtk = pytest.importorskip("vtkmodules.vtkIOLSDyna")
    support = pytest.importorskip("vtkmodules.util.numpy_support")
    model = pytest.importorskip("vtkmodules.vtkCommonExecutionModel").vtkStreamingDemandDrivenPipeline
    reader = vtk.vtkLSDynaReader()
    reader.SetFileName(str(folder / "d3plot"))
    reader.UpdateInformation()
    assert reader.GetNumberOfTimeSteps() == len(d3plot)
    assert [reader.GetPartArrayName(k) for k in range(reader.GetNumberOfPartArrays())] == list(d3plot.parts.values())
    times = [reader.GetOutputInformation(0).Get(model.TIME_STEPS(), k) for k in range(len(d3plot))]
    np.testing.assert_allclose(times, d3plot.times.astype("f4"))
    reader.SetRemoveDeletedCells(0)
    reader.SetDeformedMesh(1)
    for k in (0, 4, len(d3plot) - 1):
        reader.SetTimeStep(k)
        reader.UpdateTimeStep(times[k])
        reader.Update()
        ours, blocks = d3plot.state(k), reader.GetOutput()
        for b, part in enumerate(d3plot.part_ids.tolist()):
            grid = blocks.GetBlock(b)
            array = {}
            for data in (grid.GetCellData(), grid.GetPointData()):
                array |= {data.GetArrayName(i): support.vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
            kind = {1: "solids", 2: "shells", 3: "beams", 4: "solids", 5: "shells", 7: "beams"}.get(part)
            # VTK 9.1 reads numbers of nodes in pairs; its points are those of the part in the order of the file
            nodes = d3plot.sph_nodes[:, 0] if kind is None else np.unique(d3plot.corners[kind][ours.elements(kind)["part"] == part])
            np.testing.assert_allclose(support.vtk_to_numpy(grid.GetPoints().GetData()), ours.nodes["position"][nodes], rtol=1e-7)
            np.testing.assert_array_equal(support.vtk_to_numpy(grid.GetPointData().GetArray("Velocity")), ours.nodes["velocity"][nodes])
            if kind is None:
                particles = ours.particles()
                assert len(array["Pressure"]) == 9
                for name, mine in (("Pressure", "pressure"), ("Density", "density"), ("InfluenceRadius", "smoothing_length"), ("Mass", "mass")):
                    np.testing.assert_array_equal(array[name], particles[mine], err_msg=name)
                continue
            table = ours.elements(kind)
            rows = table["part"] == part
            np.testing.assert_array_equal(support.vtk_to_numpy(grid.GetCellData().GetArray("UserIds")), table["id"][rows])
            if kind == "beams":
                np.testing.assert_array_equal(array["AxialForce"], table["axial_force"][rows])
            else:
                stress = table["stress"][rows] if kind == "solids" else table["stress"][rows, 0]
                np.testing.assert_array_equal(array["Stress"], stress)
            if kind == "shells":
                np.testing.assert_array_equal(array["StressOuterSurf"], table["stress"][rows, 2])
                np.testing.assert_array_equal(array["Thickness"], table["thickness"][rows])
    reader = vtk.vtkLSDynaReader()  # which removes deleted cells
    reader.SetFileName(str(folder / "d3plot"))
    reader.UpdateInformation()
    reader.SetTimeStep(len(d3plot) - 1)
    reader.Update()
    shells = d3plot.state(len(d3plot) - 1).elements("shells")
    assert reader.GetOutput().GetBlock(1).GetNumberOfCells() == (shells["alive"] & (shells["part"] == 2)).sum() < 4


@pytest.mark.parametrize("cut", [0, 10, 255, 400, 900])
def test_a_cut_d3plot_is_a_message(folder: Path, tmp_path: Path, cut: int) -> None:
    data = (folder / "d3plot").read_bytes()
    (tmp_path / "d3plot").write_bytes(data[:cut])
    with pytest.raises(D3plotFault):
        D3plotFile(tmp_path / "d3plot")


def test_damaged_d3plot_never_crashes(folder: Path, tmp_path: Path) -> None:
    data, random = bytearray((folder / "d3plot").read_bytes()), np.random.default_rng(1)
    (tmp_path / "d3plot01").write_bytes((folder / "d3plot01").read_bytes())
    for _ in range(300):
        damaged = bytearray(data)
        for at in random.integers(0, 300, 3):
            damaged[at] = int(random.integers(0, 256))
        (tmp_path / "d3plot").write_bytes(damaged)
        try:
            found = courant.open(tmp_path).d3plot
            for k in range(min(len(found), 2)):
                found.state(k).elements("shells"), found.state(k).nodes
        except (courant.CourantError, D3plotFault):
            pass
