"""binout and reports of a run with each kind of element, and results of LS-DYNA."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import courant
import numpy as np
import pytest
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


@pytest.fixture(scope="module")
def binout_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    at = tmp_path_factory.mktemp("binout")
    text = DECK.read_text()
    for name in ("GLSTAT", "MATSUM", "NODOUT", "RCFORC", "SLEOUT", "RWFORC", "SPCFORC", "BNDOUT", "RBDOUT"):
        text = text.replace(f"*DATABASE_{name}\n1e-4", f"*DATABASE_{name}\n1e-4,3")
    (at / "deck.k").write_text(text.replace("*DATABASE_SPHOUT\n1e-4", "*DATABASE_SPHOUT\n1e-4,2"))
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


@needs_courant
def test_lasso_reads_binout(binout_folder: Path) -> None:
    lasso = pytest.importorskip("lasso.dyna")
    theirs, ours = lasso.Binout(str(binout_folder / "binout0000")), courant.open(binout_folder).binout
    assert set(theirs.read()) == {name.partition("/")[0] for name in ours.histories}
    for history, name in [*BINOUT_OF_ASCII, *BINOUT_OF_IDS, ("sphout", "density"), ("spcforc", "x_force"), ("rcforc", "x_force")]:
        np.testing.assert_array_equal(np.asarray(theirs.read(*history.split("/"), name)).squeeze(), ours[f"{history}/{name}"].squeeze(), err_msg=name)
    np.testing.assert_array_equal(theirs.read("nodout", "ids"), ours["nodout/ids"])
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
    for _ in range(200):
        damaged = bytearray(data)
        for at in random.integers(0, len(data), 20):
            damaged[at] = int(random.integers(0, 256))
        (tmp_path / "binout0000").write_bytes(damaged)
        try:
            found = courant.open(tmp_path).binout
            [found[name] for name in found]
        except courant.CourantError:
            pass


# ---------------------------------------------------------------------------------------------------------------------------------- report


@needs_courant
def test_a_report_has_all_sections_and_needs_nothing_else(binout_folder: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    page = tmp_path / "page.html"
    subprocess.run([COURANT, "report", str(binout_folder), str(binout_folder), "-o", str(page)], check=True, timeout=300, capture_output=True)
    text = page.read_text()
    for section in ("Verdict", "States", "Energies", "Time step", "Histories", "Warnings", "Timings"):
        assert f"<h2>{section}</h2>" in text
    assert text.count("data:image/png;base64,") >= 12 and "src=\"http" not in text and "href=" not in text
    assert "each kind of element" in text and "beams take no part in contact" in text


def test_a_report_says_what_a_run_did_not_write(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    from courant.report import page_of

    (tmp_path / "summary.yaml").write_text("title: <b>odd</b>\nverdict: healthy\n")
    text = page_of([courant.open(tmp_path)])
    assert "no results here" in text and "<b>odd</b>" not in text and "&lt;b&gt;odd" in text
