"""What the pages show of Python runs as it is printed, on a run of the solver."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import courant
import numpy as np
import pytest
from courant.optional import MissingModule

PROJECT = Path(__file__).resolve().parents[2]
SHOWN = {"docs/post.md": 2, "docs/scenes_in_python.md": 8}  # pages with Python, and how many pieces of it this file runs


def pieces(page: str) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```", (PROJECT / page).read_text(), re.M | re.S)


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """A folder with a run in `jump`, the name that the page has, with the first 0.02 s of a hydraulic jump."""
    if "COURANT_EXECUTABLE" not in os.environ:
        pytest.skip("COURANT_EXECUTABLE names no program")
    folder = tmp_path_factory.mktemp("runs")
    deck = PROJECT / "keyword_decks/hydraulic_jump/d4_5s.k"
    subprocess.run([os.environ["COURANT_EXECUTABLE"], "run", deck, "-o", folder / "jump", "--until", "0.02", "--threads", "1", "--quiet"], check=True)
    return folder


def test_every_page_with_python_is_run():
    pages = [PROJECT / "README.md", *(PROJECT / "docs").glob("*.md"), *(PROJECT / "keyword_decks").glob("*/README.md")]
    found = {str(page.relative_to(PROJECT)): len(pieces(page)) for page in pages}
    assert {page: count for page, count in found.items() if count} == SHOWN


def test_results(runs, monkeypatch):
    monkeypatch.chdir(runs)
    names = {}
    for line in pieces("docs/post.md")[1].splitlines():
        try:
            exec(line, names)  # noqa: S102
        except MissingModule:
            assert ".vtk()" in line or ".plot(" in line  # not of the packages that the page calls needed
    state = names["state"]
    assert state.t == pytest.approx(0.02, rel=0.02) and len(state) > 500 and names["run"].contacts[1]["force.y"][-1] != 0
    assert all(Path(f"{name}.png").stat().st_size > 5000 for name in ("force", "pressure"))


def test_a_scene_from_a_bad_surface(tmp_path, monkeypatch, capfd):
    """The page's house, coarser and for a short time: in millimetres, with vertices for each face, faces turned round and one missing."""
    if "COURANT_EXECUTABLE" not in os.environ:
        pytest.skip("COURANT_EXECUTABLE names no program")
    pytest.importorskip("vtkmodules", reason="python3-vtk9 is missing")
    sys.path.insert(0, str(Path(__file__).parent / "scene"))
    from house import stl

    monkeypatch.chdir(tmp_path)
    stl(Path("house.stl"), turned=(1, 4, 6, 9), left_out=(3,))
    piece = pieces("docs/scenes_in_python.md")[0]
    assert len(piece.splitlines()) <= 15
    Path("house.py").write_text(piece.replace("spacing=0.04, end=1.2", "spacing=0.1, end=0.02"))
    names = {}
    exec(compile(Path("house.py").read_text(), "house.py", "exec"), names)  # noqa: S102
    said = capfd.readouterr().err
    assert (PROJECT / "docs/scenes_in_python.md").read_text().count(said) == 1, said
    assert names["run"].verdict == "sound" and Path("house.png").stat().st_size > 5000


def test_a_mesh_of_gmsh_and_a_surface_of_pyvista(tmp_path, monkeypatch):
    """The page's dam break on a wall, coarser and for a short time."""
    if "COURANT_EXECUTABLE" not in os.environ:
        pytest.skip("COURANT_EXECUTABLE names no program")
    gmsh = pytest.importorskip("gmsh", reason="gmsh is missing")
    pytest.importorskip("pyvista", reason="pyvista is missing")
    monkeypatch.chdir(tmp_path)
    names = {}
    try:
        exec(pieces("docs/scenes_in_python.md")[2].replace("spacing=0.05, end=0.4", "spacing=0.1, end=0.002").replace("0.04)\ngmsh", "0.2)\ngmsh"), names)  # noqa: S102
    finally:
        gmsh.finalize()
    assert names["run"].verdict == "sound"


def test_a_drop_without_water(tmp_path, monkeypatch):
    """The page's drop test, with coarse shells, until the house has struck the plate."""
    if "COURANT_EXECUTABLE" not in os.environ:
        pytest.skip("COURANT_EXECUTABLE names no program")
    pytest.importorskip("vtkmodules", reason="python3-vtk9 is missing")
    sys.path.insert(0, str(Path(__file__).parent / "scene"))
    from house import stl

    monkeypatch.chdir(tmp_path)
    stl(Path("house.stl"))
    piece = pieces("docs/scenes_in_python.md")[3]
    names = {}
    exec(piece.replace("size=0.04", "size=0.1").replace("end=0.02", "end=0.007"), names)  # noqa: S102
    assert names["run"].verdict == "sound" and names["plate"]["displacement.z"].min() < -1e-3 and Path("drop.png").stat().st_size > 5000


def test_units(runs, monkeypatch):
    monkeypatch.chdir(runs)
    (call,) = re.findall(r'`(courant\.open\("jump", .*?\))` names others', (PROJECT / "docs/post.md").read_text())
    assert eval(call).energies.units["kinetic"] == "t mm2/s2"  # noqa: S307


def test_a_file_of_ones_own(runs):
    """The analysis and the chart, with the recipes that are in their comments."""
    own = pieces("docs/post.md")[0]
    analysis, figure = re.findall(r"# (\{.*\})$", own, re.M)
    (runs / "my.py").write_text(own)
    (runs / "own.yaml").write_text(f"analyses:\n  - {analysis.replace('from: 2', 'from: 0')}\nfigures:\n  - {figure}\n")
    post = [sys.executable, "-B", "-m", "courant", "post", "--load", "my.py", "own.yaml", "jump"]
    done = subprocess.run(post, cwd=runs, env=os.environ | {"PYTHONPATH": str(PROJECT / "src/python")}, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    table = np.genfromtxt(runs / "jump/post/f.csv", delimiter=",", names=True, deletechars="")
    speeds = [np.max(state["speed"][state["active"] > 0]) for state in courant.open(runs / "jump").states]
    assert table["speed_[m/s]"] == pytest.approx(speeds, rel=1e-5)
    assert (runs / "jump/post/h.png").stat().st_size > 5000


def test_the_call_of_the_first_page(runs):
    (call,) = re.findall(r"^/usr/bin/python3 (-c '.*')$", (PROJECT / "README.md").read_text(), re.M)
    call = call.replace("results/hydraulic_jump", str(runs / "jump"))
    done = subprocess.run(f"{sys.executable} -B {call}", shell=True, env=os.environ | {"PYTHONPATH": str(PROJECT / "src/python")}, capture_output=True, text=True)
    assert re.fullmatch(r"\d+\.\d+ kg m2/s2 \(\d+, 3\)\n", done.stdout), done.stdout + done.stderr


def test_a_part_that_deforms(tmp_path, monkeypatch, capsys):
    if "COURANT_EXECUTABLE" not in os.environ:
        pytest.skip("COURANT_EXECUTABLE names no program")
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(pieces("docs/scenes_in_python.md")[1], names)  # noqa: S102
    assert names["run"].verdict == "sound" and abs(names["end"]["displacement.x"].max() / 0.0491 - 1) < 0.01  # as the page says
    assert Path("plate.png").stat().st_size > 5000


PLATES = """*KEYWORD
*PARAMETER
R       dx      0.01
*CONTROL_TERMINATION
       1.0
*PART
lower
         1         1         3
*PART
upper
         2         1         3
*SECTION_SHELL
         1         2       1.0         3
       &dx       &dx       &dx       &dx
*MAT_ELASTIC
         3    2700.0     2.e10       0.3
*MAT_PLASTIC_KINEMATIC
         4    7850.0   2.1e+11       0.3     2.5e8
*NODE
       1             0.0             0.0             0.0
       2             1.0             0.0             0.0
       3             1.0             1.0             0.0
       4             0.0             1.0             0.0
       5             0.0             0.0             2.0
       6             1.0             0.0             2.0
       7             1.0             1.0             2.0
       8             0.0             1.0             2.0
*ELEMENT_SHELL
       1       1       1       2       3       4
       2       2       5       6       7       8
*END
"""


def test_a_deck_is_changed(tmp_path, monkeypatch):
    if "COURANT_EXECUTABLE" not in os.environ:
        pytest.skip("COURANT_EXECUTABLE names no program")
    monkeypatch.chdir(tmp_path)
    Path("plate.k").write_text(PLATES)
    names = {"courant": courant}
    exec(pieces("docs/scenes_in_python.md")[4].replace("until=0.1", "until=0.001, quiet=True"), names)  # noqa: S102
    deck = names["deck"]
    assert deck["MAT_ELASTIC"]["E"] == 70e9 and deck.parts[2]["MID"] == 4 and deck.parameters["dx"] == 0.005
    written = courant.Deck("thicker/plate.k")
    assert written.points[:, 2].tolist() == [0, 0, 0, 0, 2.1, 2.1, 2.1, 2.1] and "DATABASE_GLSTAT" in written and names["run"].termination == "normal"


def test_steps_callbacks_sweeps_and_ctrl_c(tmp_path, monkeypatch, capsys):
    from courant.native import native

    if native() is None:
        pytest.skip("the extension module is missing: apt-get install pybind11-dev")
    monkeypatch.chdir(tmp_path)
    scene = courant.Scene("tow", parameters={"n": 4}, spacing="0.4 / n", end=0.05)
    scene.water(low=(0, 0), high=(1.2, 0.4)).box(low=(0, 0), high=(2, 0.8))
    scene.body(box={"low": (1.4, 0.1), "high": (1.6, 0.3)}, density=500, title="house")
    names = {"courant": courant, "scene": scene}
    steps, sweep, ctrl_c = pieces("docs/scenes_in_python.md")[5:]
    exec(steps, names)  # noqa: S102
    assert names["state"].t > 0 and courant.open("towed").states[-1].t == pytest.approx(0.05, rel=0.1)
    exec(sweep.replace("[20, 40, 80]", "[4, 8]"), names)  # noqa: S102
    assert len(names["table"]) == 2 and Path("convergence/n=8/summary.yaml").is_file()
    exec(ctrl_c, names)  # noqa: S102
    assert capsys.readouterr().out.endswith("normal\n")
