"""binout and reports of a run with each kind of element, and results of LS-DYNA."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import courant
import numpy as np
import pytest
from courant.ascii_histories import ASCII_NAMES
from courant.binout import BinoutFault, BinoutFile
from mixed_run import COURANT, DECK, needs_courant, run

OF_LSDYNA = Path(os.environ.get("LSDYNA_RESULTS", "/nowhere"))


@pytest.mark.skipif(not OF_LSDYNA.is_dir(), reason="LSDYNA_RESULTS names no folder with results of LS-DYNA, as lasso-python's tests have them")
def test_results_of_lsdyna_are_read_as_lasso_reads_them() -> None:
    lasso = pytest.importorskip("lasso.dyna")
    plots, binouts = sorted(OF_LSDYNA.rglob("d3plot")), sorted(OF_LSDYNA.rglob("binout"))
    assert plots or binouts
    for path in plots:
        theirs, ours = lasso.D3plot(str(path)).arrays, courant.open(path.parent).d3plot
        np.testing.assert_array_equal(theirs["timesteps"], ours.times.astype("f4"), err_msg=str(path))
        state = ours.state(-1)
        pairs = [("node_displacement", state.nodes.get("position")), ("node_velocity", state.nodes.get("velocity"))]
        for kind in ("solid", "shell"):
            table = state.elements(f"{kind}s")
            pairs += [(f"element_{kind}_stress", table.get("stress")), (f"element_{kind}_effective_plastic_strain", table.get("plastic_strain"))]
        if ours.sph_nodes.size:
            particles = state.particles()
            pairs += [(f"sph_{name}", particles[name]) for name in ("pressure", "density", "mass", "stress")]
        for name, mine in pairs:
            if name in theirs:
                np.testing.assert_array_equal(theirs[name][-1].squeeze(), mine.squeeze(), err_msg=f"{name} of {path}")
    for path in binouts:
        lsda, ours = lasso.Binout(str(path)), courant.open(path.parent).binout
        for name in ours:
            with np.errstate(all="ignore"):
                expected = np.asarray(lsda.read(*name.split("/")))
            if expected.dtype.kind not in "US":
                np.testing.assert_array_equal(expected.squeeze(), ours[name].squeeze(), err_msg=f"{name} of {path}")


# ---------------------------------------------------------------------------------------------------------------------------------- binout


def with_binary(text: str, binary: int, but: str = "SPHOUT") -> str:
    """A deck whose histories have this BINARY; one that only binout has."""
    text = re.sub(r"(\*DATABASE_(?:GLSTAT|MATSUM|[A-Z]+(?:OUT|FORC)|TRHIST)\n[0-9e.-]+)\n", rf"\1,{binary}\n", text)
    return re.sub(rf"(\*DATABASE_{but}\n[0-9e.-]+),{binary}\n", r"\1,2\n", text)


@pytest.fixture(scope="module")
def binout_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    at = tmp_path_factory.mktemp("binout")
    (at / "deck.k").write_text(with_binary(DECK.read_text(), 3))
    return run(at / "deck.k", at / "run")


BINOUT_OF_ASCII = {
    ("glstat", "kinetic_energy"): "kinetic_energy",
    ("glstat", "total_energy"): "total_energy",
    ("glstat", "energy_ratio"): "total_energy_initial_energy",
    ("glstat", "external_work"): "external_work",
    ("glstat", "global_z_velocity"): "global_z_velocity",
}
BINOUT_OF_IDS = {
    ("matsum", "internal_energy"): "inten_{}",
    ("matsum", "z_momentum"): "z_mom_{}",
    ("matsum", "x_rbvelocity"): "x_rbv_{}",
    ("nodout", "z_displacement"): "z_disp_{}",
    ("nodout", "x_velocity"): "x_vel_{}",
    ("nodout", "z_acceleration"): "z_accl_{}",
    ("nodout", "y_coordinate"): "y_coor_{}",
    ("sleout", "slave"): "surfa_{}",
    ("rwforc/forces", "z_force"): "z_{}",
    ("rwforc/forces", "normal_force"): "normal_{}",
    ("rbdout", "global_dz"): "displacements_z_{}",
}


@needs_courant
def test_binout_has_the_numbers_of_the_text(binout_folder: Path) -> None:
    ours = courant.open(binout_folder)
    assert not (binout_folder / "sphout").exists() and "sphout" in ours.binout.histories
    for (history, name), column in BINOUT_OF_ASCII.items():
        table = ours.ascii[history]
        np.testing.assert_allclose(ours.binout[f"{history}/{name}"], table[column], rtol=1e-4, atol=1e-30, err_msg=name)
    for (history, name), column in BINOUT_OF_IDS.items():
        table, values = ours.ascii[history.partition("/")[0]], ours.binout[f"{history}/{name}"]
        values = values.reshape(len(values), -1)
        for k, id in enumerate(ours.binout[f"{history}/ids"].tolist()):
            np.testing.assert_allclose(values[:, k], table[column.format(id)], rtol=2e-4, atol=1e-30, err_msg=f"{name} of {id}")
    assert ours.binout.text("nodout/title").startswith("each kind of element")
    assert ours.binout.text("matsum/date") == ours.binout.text("elout/solid/date") and ours.binout["matsum/legend_ids"].tolist() == [1, 2, 3, 4, 5, 6, 7]


POINT_OF = {  # names of binout and of the text, for each point of an element
    "elout/solid": ("solid", {"sig_xx": "sig_xx", "sig_zx": "sig_zx", "effsg": "effsg", "yield": "yield"}),
    "elout/shell": ("shell", {"sig_xx": "sig_xx", "sig_xy": "sig_xy", "plastic_strain": "plastic_strain"}),
    "elout/beam": ("beam", {"sigma_11": "sigma_11", "sigma_31": "sigma_31", "plastic_eps": "plastic_eps"}),
}
WHOLE = {
    ("elout/beam", 51): {"axial": "axial_51_beam", "shear_s": "shear_s_51_beam", "moment_t": "moment_t_51_beam", "torsion": "torsion_51_beam"},
    ("secforc", 1): {"x_force": "x_force_1", "total_force": "resultant_force_1", "y_moment": "y_moment_1", "z_centroid": "z_centroid_1", "area": "area_1"},
    ("deforc", 61): {"x_force": "x_force_61", "resultant_force": "resultant_force_61", "displacement": "change_in_length_61"},
    ("trhist", 1001): {"x": "x_1", "vx": "vx_1", "sx": "sx_1", "rho": "rho_1"},
}


@needs_courant
def test_binout_of_elements_sections_springs_and_tracers(binout_folder: Path) -> None:
    ours = courant.open(binout_folder)
    for folder, (kind, names) in POINT_OF.items():
        (id,) = {int(id) for id in np.ravel(ours.binout[f"{folder}/ids"])}
        table = ours.ascii["elout"]
        for name, column in names.items():
            values = ours.binout.of(f"{folder}/{name}", id)
            values = values.reshape(len(values), -1)
            for point in range(values.shape[1]):
                text = table[f"{column}_{id}_{kind}_point_{point + 1}"]
                np.testing.assert_allclose(values[:, point], text, rtol=1e-4, atol=1e-4 * abs(text).max() + 1e-30, err_msg=f"{folder}/{name} {point}")
    for (folder, id), columns in WHOLE.items():
        for name, column in columns.items():
            text = ours.ascii[folder.partition("/")[0]][column]
            np.testing.assert_allclose(ours.binout.of(f"{folder}/{name}", id), text, rtol=2e-3, atol=1e-4 * abs(text).max() + 1e-30, err_msg=f"{folder}/{name}")
    assert abs(ours.ascii["elout"]["sig_xx_71_solid_point_1"]).max() > 1e6 and abs(ours.ascii["deforc"]["resultant_force_61"]).max() > 0


WELD = """*KEYWORD
*CONTROL_TERMINATION
2e-3
*CONTROL_TIMESTEP
0.0,0.9
*DATABASE_SWFORC
1e-4,3
*PART
weld
1,1,1
*SECTION_BEAM
1,9,1.0
5.0,5.0,0.0,0.0
*MAT_SPOTWELD
1,7.85e-9,205000.0,0.3,1e9,0,0.0,0.0
0.0,6000.0
*NODE
1,0.0,0.0,0.0,7,7
2,0.0,0.0,1.6
*ELEMENT_BEAM
       8       1       1       2
*LOAD_NODE_POINT
2,3,1,6000.0
*DEFINE_CURVE
1
0.0,0.0
1.0e-3,1.0
1.0,1.0e3
*END
"""
JOINT = f"*KEYWORD\n*INCLUDE\n{Path(__file__).resolve().parents[1] / 'decks/base/two_bodies.inc'}\n*CONSTRAINED_JOINT_SPHERICAL_ID\n         5neck\n"
JOINT += "        21        22                                               0.1      0.01\n*DATABASE_JNTFORC\n1e-2,3\n*INITIAL_VELOCITY_GENERATION\n2,2,0.,0.,0.,1.\n0\n*END\n"


@needs_courant
def test_binout_of_welds_and_joints(tmp_path: Path) -> None:
    pairs = {"swforc": {"axial": "axial", "shear": "shear", "resultant_moment": "moment", "torsion": "torsion", "length": "length", "failure_time": "failure"}}
    pairs["jntforc/joints"] = {"x_force": "x_force", "z_force": "z_force", "y_moment": "y_moment", "resultant_force": "resultant_force"}
    for (folder, names), text, id in zip(pairs.items(), (WELD, JOINT), (8, 5), strict=True):
        name = folder.partition("/")[0]
        (tmp_path / f"{name}.k").write_text(text)
        ours = courant.open(run(tmp_path / f"{name}.k", tmp_path / name))
        assert np.ravel(ours.binout[f"{folder}/ids"]).tolist() == [id]
        for in_binout, column in names.items():
            printed = ours.ascii[name][f"{column}_{id}"]
            np.testing.assert_allclose(np.ravel(ours.binout[f"{folder}/{in_binout}"]), printed, rtol=1e-4, atol=1e-5 * abs(printed).max() + 1e-30, err_msg=in_binout)
        if name == "swforc":
            failed = ours.binout["swforc/failure_flag"]
            assert failed[0] == 0 and failed[-1] == 1 and 0.9e-3 < ours.binout["swforc/failure_time"][-1] < 1.2e-3
            assert ours.histories["welds/8/axial"].max() > 3000
        else:
            assert ours.histories["joints/5/force"].shape[1] == 3 and abs(ours.histories["joints/5/force"]).max() > 1


@needs_courant
def test_history_h5_has_elements_sections_and_springs(binout_folder: Path) -> None:
    ours = courant.open(binout_folder)
    for path, column in (
        ("solids/71/stress", ("elout/solid/sig_xx", 0)), ("solids/71/stress", ("elout/solid/sig_zx", 5)), ("beams/51/axial", ("elout/beam/axial", None)),
        ("shells/31/stress_of_point_1", None), ("sections/1/force", ("secforc/z_force", 2)), ("sections/1/area", ("secforc/area", None)),
        ("springs/61/change_in_length", ("deforc/displacement", None)), ("tracers/1001/v", ("trhist/vx", 0)),
    ):  # fmt: skip
        values = ours.histories[path]
        assert len(values) == len(ours.histories.t) and np.isfinite(values).all(), path
        if column is not None:
            name, k = column
            id = int(path.split("/")[1])
            np.testing.assert_array_equal(values if k is None else values[:, k], ours.binout.of(name, id), err_msg=path)
    assert ours.histories.table("solids/71").names.count("stress.yz") == 1
    assert ours.histories.unit("sections/1/force") == ours.histories.unit("contacts/1/force")


def test_every_history_of_the_sources_is_read() -> None:
    """The histories that register themselves in the program, and the table of the package."""
    sources = Path(__file__).resolve().parents[2] / "src"
    found = set()
    for file in sources.rglob("*.cpp"):
        text = file.read_text()
        found |= set(re.findall(r'RegisterTextHistory \w+\{\s*\{"(\w+)"', text))
        if "RegisterAsciiHistory" in text and "additions.cpp" not in file.name:
            found |= set(re.findall(r'\.name = "(\w+)"', text))
    assert len(found) > 14 and sorted(found) == sorted(ASCII_NAMES)


@needs_courant
def test_a_restart_goes_on_in_binout(tmp_path: Path) -> None:
    deck = tmp_path / "restart.k"
    deck.write_text(with_binary(DECK.read_text(), 2).replace("*END", "*DATABASE_BINARY_D3DUMP\n300\n*END"))
    whole, parts = run(deck, tmp_path / "whole"), run(deck, tmp_path / "parts")
    dump = sorted((parts / "restart").glob("d3dump*"))[0]
    run(deck, parts, "--restart", str(dump))
    assert (whole / "binout0000").read_bytes() == (parts / "binout0000").read_bytes()
    written = (parts / "binout0000").read_bytes()  # once in front of its values, once in the table of names
    assert written.count(b"/glstat/metadata") == written.count(b"/elout/shell/metadata") == 2
    assert not (whole / "elout").exists() and len(courant.open(whole).binout["elout/shell/time"]) > 10
    table = courant.open(whole).table("secforc")
    assert table["x_force_1"].shape == table["t"].shape
    (parts / "binout0000").write_bytes((parts / "binout0000").read_bytes()[:1000])  # lost since the restart file was written
    run(deck, parts, "--restart", str(dump))
    assert "binout0000 has lost its end" in (parts / "messag").read_text()
    later = courant.open(parts).binout["glstat/time"]
    assert 0 < later[0] and later[-1] == courant.open(whole).binout["glstat/time"][-1]


@needs_courant
def test_binout_does_not_change_the_run(binout_folder: Path, tmp_path: Path) -> None:
    other = run(DECK, tmp_path / "plain")
    for name in ASCII_NAMES:
        if name != "sphout":
            of = [(at / name).read_bytes().split(b"\n") for at in (binout_folder, other)]
            assert [line for line in of[0] if b"nanosec" not in line] == [line for line in of[1] if b"nanosec" not in line], name


@needs_courant
def test_lasso_reads_binout(binout_folder: Path) -> None:
    lasso = pytest.importorskip("lasso.dyna")
    theirs, ours = lasso.Binout(str(binout_folder / "binout0000")), courant.open(binout_folder).binout
    assert set(theirs.read()) == {name.partition("/")[0] for name in ours.histories}
    for history, name in [*BINOUT_OF_ASCII, *BINOUT_OF_IDS, ("sphout", "density"), ("spcforc", "x_force"), ("rcforc", "x_force")]:
        np.testing.assert_array_equal(np.asarray(theirs.read(*history.split("/"), name)).squeeze(), ours[f"{history}/{name}"].squeeze(), err_msg=name)
    np.testing.assert_array_equal(theirs.read("nodout", "ids"), ours["nodout/ids"])
    for folder, name in (("elout/solid", "sig_xx"), ("elout/shell", "sig_xx"), ("elout/beam", "axial"), ("secforc", "x_force"), ("deforc", "resultant_force"), ("trhist", "vx")):
        mine = np.asarray(theirs.read(*folder.split("/"), name), float)
        np.testing.assert_array_equal(mine.squeeze(), ours[f"{folder}/{name}"].squeeze(), err_msg=f"{folder}/{name}")
    assert [str(name) for name in theirs.as_df("secforc", "x_force").columns] == ["1"] if theirs.read("secforc", "x_force").ndim > 1 else True
    frame = theirs.as_df("nodout", "z_displacement")
    assert list(frame.columns) == [str(id) for id in ours["nodout/ids"]]


@needs_courant
@pytest.mark.parametrize("cut", [0, 7, 20, 100, 5000])
def test_a_cut_binout_is_a_message_or_shorter(binout_folder: Path, tmp_path: Path, cut: int) -> None:
    data = (binout_folder / "binout0000").read_bytes()
    (tmp_path / "binout0000").write_bytes(data[:cut] if cut < 1000 else data[:-cut])
    try:
        assert len(BinoutFile(tmp_path / "binout0000")["glstat/time"]) > 3
        assert cut == 5000
    except BinoutFault:
        assert cut < 1000


@needs_courant
def test_damaged_binout_never_crashes(binout_folder: Path, tmp_path: Path) -> None:
    data, random = (binout_folder / "binout0000").read_bytes(), np.random.default_rng(2)
    for _ in range(60):
        damaged = bytearray(data)
        for at in random.integers(0, len(data), 20):
            damaged[at] = int(random.integers(0, 256))
        (tmp_path / "binout0000").write_bytes(damaged)
        try:
            found = courant.open(tmp_path).binout
            [found[name] for name in found]
            [found.series(name.partition("/")[0]) for name in found.histories]
        except (courant.CourantError, KeyError):
            pass


@needs_courant
def test_points_of_elements_with_odd_counts(binout_folder: Path) -> None:
    """Counts of points that do not fit their arrays give no values, and no exception but KeyError."""
    ours = BinoutFile(binout_folder / "binout0000")
    counts = ours._states["elout/shell/nip"]
    for odd in (-1, 0, 10**12, -(2**62)):
        ours._states["elout/shell/nip"] = {k: np.full_like(row, odd) for k, row in counts.items()}
        with pytest.raises(KeyError):
            ours.of("elout/shell/sig_xx", 31)
    ours._states["elout/shell/nip"] = counts
    with pytest.raises(KeyError):
        ours.of("elout/shell/sig_xx", 99)
    assert ours.of("elout/shell/sig_xx", 31).shape[1] == 5


# ---------------------------------------------------------------------------------------------------------------------------------- report


@needs_courant
def test_reports_of_one_folder_and_of_two(binout_folder: Path, tmp_path: Path) -> None:
    """Of runs without states and histories, whose pictures take longest; test_report.py has those."""
    pytest.importorskip("matplotlib")
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "summary.yaml").write_bytes((binout_folder / "summary.yaml").read_bytes())
    made = subprocess.run([COURANT, "post", str(tmp_path / "one")], check=True, timeout=300, capture_output=True, text=True)
    assert made.stdout == f"report: {tmp_path / 'one' / 'report.html'}\n"
    assert "<h2>Verdict</h2>" in (tmp_path / "one" / "report.html").read_text()
    nothing = subprocess.run([COURANT, "post", str(tmp_path / "none")], timeout=60, capture_output=True, text=True)
    assert nothing.returncode == 1 and "no such folder" in nothing.stderr
    words = [COURANT, "report", str(tmp_path / "one"), str(tmp_path / "other"), "-o", str(tmp_path / "page.html")]
    subprocess.run(words, check=True, timeout=300, capture_output=True)
    text = (tmp_path / "page.html").read_text()
    assert "<h2>Verdict</h2>" in text and "other" in text


def test_a_report_says_what_a_run_did_not_write(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    from courant.report import page_of

    (tmp_path / "summary.yaml").write_text("title: <b>odd</b>\nverdict: healthy\n")
    text = page_of([courant.open(tmp_path)])
    assert "the run has written no states" in text and "<b>odd</b>" not in text and "&lt;b&gt;odd" in text
