"""What is observed in a run, and its error, where both are known.

Histories at t = 0, 0.1, ... 1: kinetic energy t^2, force on contact 7 (t, -2 t, 0) in every second sample only; fields at 0, 0.5, 1: a
column of ten particles, p = g (1 - y) + t, the last one inactive.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from made_results import write_history, write_states

from courant.registry import LoadFault, load_file
from courant.verify.errors import compare_observation, merged
from courant.verify.model import Case, CaseResult, Observation, Observed, Reference, RunResult
from courant.verify.observe import Measured, observe_run
from courant.verify.picture import draw_particles
from courant.verify.registry import CHARTS, KINDS, norm, observation, reduction, take
from courant.verify.series import Series

PARAMETERS = {"g": 10.0, "dx": 0.1, "pi": math.pi}


def column(t: float) -> dict[str, np.ndarray]:
    y = 0.05 + 0.1 * np.arange(10)
    x = np.column_stack([0 * y, y, 0 * y]).astype("f4")
    full = {"mass": 10.0, "density": 1000.0, "smoothing_length": 0.12}
    return {
        "Points": x,
        **{name: np.full(10, value) for name, value in full.items()},
        "pressure": 10 * (1 - y) + t,
        "velocity": np.tile([3.0, 4, 0], (10, 1)),
        "id": np.arange(1, 11, dtype="q"),
        "part": np.full(10, 3, dtype="i"),
        "active": (np.arange(10) < 9).astype("B"),
    }


def histories() -> dict[str, np.ndarray]:
    t = 0.1 * np.arange(11)
    force = np.column_stack([t, -2 * t, 0 * t])
    force[1::2] = np.nan
    return {"/global/time": t, "/global/kinetic": t**2, "/contacts/7/force": force}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_history(tmp_path / "history.h5", histories())
    write_states(tmp_path, {t: column(t) for t in (0.0, 0.5, 1.0)})
    return tmp_path


def measured(folder: Path, *args: str, **more: object) -> Measured:
    """kind, of, take, and other keys of an observation."""
    kind, of, take = args
    return observe_run(Case(observations=[Observation("o", kind=kind, of=of, take=take, **more)]), PARAMETERS, folder, False)[0][0]  # type: ignore[arg-type]


def observed(folder: Path, o: Observation, finest: Measured | None = None) -> Observed:
    return compare_observation(o, observe_run(Case(observations=[o]), PARAMETERS, folder, False)[0][0], PARAMETERS, finest)


def number(folder: Path, *args: str, **more: object) -> float:
    m = measured(folder, *args, **more)
    assert m.found, m.why
    return m.value if m.value is not None else math.nan


def test_histories(folder: Path) -> None:
    assert number(folder, "history", "global/kinetic / 2 + t", "final") == pytest.approx(1.5)
    assert number(folder, "history", "g * contacts/7/force.y", "final") == pytest.approx(-20)
    both = measured(folder, "history", "contacts/7/force.x + 0*global/kinetic", "curve")
    assert len(both.series) == 6, "only samples that have all of them count"
    assert number(folder, "history", "global/kinetic", "mean", start="0.4 + dx - 0.1", end="0.6") == pytest.approx((0.16 + 0.25 + 0.36) / 3)
    for of, why in (
        ("contacts/7/force", "'contacts/7/force' is a vector: add .x, .y or .z"),
        ("contacts/8/force.x", "history.h5 has no 'contacts/8/force'; did you mean contacts/7/force?"),
        ("global/kinetic.x", "'global/kinetic' is no vector"),
        ("1 / t", "not finite at t = 0"),
        ("t + nothing", "unknown name 'nothing'"),
    ):
        assert measured(folder, "history", of, "max").why == why
    assert measured(folder, "history", "t", "max", start="1 / 0").why == "division by zero, got '1 / 0'"
    assert measured(folder, "history", "t", "max", start="5").why == "no sample lies in the window"


def test_a_sample_that_stands_twice_counts_once(tmp_path: Path) -> None:
    t = np.array([0, 1, 2, 2.0])
    write_history(tmp_path / "history.h5", {"/global/time": t, "/global/kinetic": t})
    assert len(measured(tmp_path, "history", "global/kinetic", "curve").series) == 3


def test_particles(folder: Path) -> None:
    assert number(folder, "particles", "p", "final") == pytest.approx(1 + 10 * (1 - 0.45)), "the mean of the nine active ones"
    assert number(folder, "particles", "p", "final", reduce="max", where="y - 0.3") == pytest.approx(1 + 10 * (1 - 0.35))
    assert number(folder, "particles", "p", "final", reduce="count", where="y - 0.3") == 6
    assert number(folder, "particles", "p", "final", reduce="count", where="1 - active") == 1, "who asks for inactive ones gets them"
    assert not measured(folder, "particles", "p", "final", where="y - 5").found
    assert number(folder, "particles", "p", "final", where="y - 5", empty=2.5) == 2.5, "where nothing is"
    assert number(folder, "particles", "p", "final", reduce="max", where="y - 0.3", empty=2.5) == pytest.approx(1 + 10 * (1 - 0.35)), "something is"
    assert number(folder, "particles", "id", "final", reduce="median") == 5
    assert number(folder, "particles", "part * m * speed * (V - 0.01 + 1)", "final", reduce="sum") == pytest.approx(9 * 3 * 10 * 5)
    assert number(folder, "particles", "p", "slope") == pytest.approx(1, abs=1e-5)
    assert number(folder, "particles", "t", "mean", start="0.3") == pytest.approx(0.75)
    assert measured(folder, "particles", "p", "final", where="y - 5").why == "no particle counts at t = 0"
    assert measured(folder, "particles", "1 / x", "final").why == "'of' is not finite for a particle at t = 0"
    assert measured(folder, "particles", "h2", "final").why == "unknown name 'h2'"


def test_surfaces(tmp_path: Path) -> None:
    cells = np.arange(200)
    places = 0.1 * np.column_stack([cells % 20 + 0.5, cells // 20 + 0.5, 0 * cells])
    places = np.vstack([places, [[1, 3, 0]]]).astype("f4")  # and a drop
    full = {"mass": 10.0, "density": 1000.0, "smoothing_length": 0.12}
    block = {"Points": places, **{name: np.full(201, value) for name, value in full.items()}, "active": np.ones(201, "B")}
    write_states(tmp_path, {0.0: block, 1.0: block | {"Points": places + np.array([0, 0.5, 0], "f4")}})
    series = measured(tmp_path, "surface", "", "curve", x="9 * dx", bed="2 * dx").series
    assert series.x == pytest.approx([0, 1])
    assert series.y == pytest.approx([0.8, 1.3], abs=2e-3), "drops are no water"
    assert number(tmp_path, "surface", "", "final", x="1", where="1.0 - y") == pytest.approx(1, abs=2e-3)
    assert number(tmp_path, "surface", "", "final", x="3") == 0, "it is dry there"
    assert measured(tmp_path, "surface", "", "final", x="1 / 0").why == "division by zero, got '1 / 0'"


def test_profiles(folder: Path) -> None:
    o = Observation("o", kind="profile", of="p", along="1 - y", at="0.48", reference=Reference("formula", "g * (1 - y) + t"))
    exact = observed(folder, o)
    assert exact.error is not None and exact.error < 1e-6, exact.why
    assert len(exact.curve.x) == 9 and np.all(np.diff(exact.curve.x) > 0)
    o.reference.formula, o.scale, o.norm = "g * (1 - y) + t + 1", "g", "linf"
    assert observed(folder, o).error == pytest.approx(0.1)
    o.at = "7"
    assert observed(folder, o).why == "there is no field state at t = 7"
    o.at, o.along = None, "1 / x"
    assert observed(folder, o).why == "'along' is not finite for a particle"
    in_bins = measured(folder, "profile", "p", "curve", along="y", bins=3, reduce="max")
    assert in_bins.series.x == pytest.approx(0.05 + 0.8 * np.array([1, 3, 5]) / 6)
    assert in_bins.series.y == pytest.approx(11 - 10 * np.array([0.05, 0.35, 0.65])), "the lowest particle of each third"
    assert number(folder, "profile", "p", "mean", along="y", bins=3, reduce="max") == pytest.approx(11 - 3.5)


def test_references(folder: Path) -> None:
    o = Observation("o", of="global/kinetic", reference=Reference("formula", "t^2 + 1"), norm="l1", scale="2")
    assert observed(folder, o).error == pytest.approx(0.5)
    o.scale, o.norm = "", "linf"
    assert observed(folder, o).error == pytest.approx(1 / 2)
    for formula, why in (("0*t", "the reference is 0: give a 'scale' for its error"), ("1/t", "the reference is not finite at 0")):
        o.reference.formula = formula
        assert (observed(folder, o).why, observed(folder, o).error) == (why, None)
    o.take, o.reference.formula = "final", "2 * t"
    assert observed(folder, o).error == pytest.approx(0.5)


def test_tables_as_references(folder: Path) -> None:
    (folder / "table.csv").write_text("# made up\ntime,  energy\n-1, 0\n0.2, 20\n\n0.4, 40\n")
    o = Observation("o", of="t", reference=Reference("csv", csv=folder / "table.csv", csv_x="time", csv_y="2", scale_y="dx / 10"))
    assert observed(folder, o).curve.reference_y[-1] == pytest.approx(0.4)
    o.norm, o.scale = "linf", "1"
    assert observed(folder, o).error == pytest.approx(0.2 * 5 / 6), "at 0, where the table says 1/6 of the way from -1 to 0.2"
    o.take, o.at = "at", "0.3"
    assert observed(folder, o).reference == pytest.approx(0.3)
    o.take = "final"
    assert observed(folder, o).why == "the reference does not reach 1"
    o.take, o.at, o.align = "curve", None, 2  # t first reaches 0.2 at 0.2: nothing is shifted
    o.reference.offset_x = "5"
    assert observed(folder, o).curve.x[0] == pytest.approx(5), "aligned at the second row, x = 5.2, y = 0.2"
    o.align = 9
    assert observed(folder, o).why == "'align': the reference has no row 9"


def test_the_finest_run_as_reference(folder: Path) -> None:
    o = Observation("o", of="t", reference=Reference("finest"), scale="1")
    assert observed(folder, o).error is None, "the finest run is no reference for itself"
    finer = Measured(True, series=Series([0, 0.5, 0.5], [0.1, 0.6, 0.6]))
    assert observed(folder, o, finer).error == pytest.approx(0.1)
    assert observed(folder, o, Measured(why="it stopped")).why == "the finest run has no value: it stopped"
    rows = merged(Series([0, 0, 1, 1, 1, 2], [1, 3, 1, 2, 3, 9]))
    assert (rows.x.tolist(), rows.y.tolist()) == ([0, 1, 2], [2, 2, 9])


def garbage(folder: Path, every_state: bool = True) -> str:
    return observe_run(Case(), PARAMETERS, folder, every_state)[1]


def test_garbage_is_found(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    assert garbage(folder) == ""
    other = tmp_path_factory.mktemp("other")
    spoilt = column(0)
    spoilt["pressure"][4] = math.nan
    write_states(other, {0.25: spoilt})
    assert "p of a particle is not finite at t = 0.25" in garbage(other)
    datasets = histories()
    datasets["/global/kinetic"][4] = math.nan
    write_history(folder / "history.h5", datasets)
    assert garbage(folder, False) == "global/kinetic is not finite at t = 0.4"
    assert measured(folder, "history", "global/kinetic", "max").why == "not finite at t = 0.4"


@pytest.mark.parametrize("spoilt", [False, True])
def test_files_of_few_arrays_are_no_garbage(tmp_path: Path, spoilt: bool) -> None:
    few = {name: values for name, values in column(0).items() if name not in ("pressure", "id", "part")}
    if spoilt:
        few["velocity"][4, 1] = math.nan
    write_states(tmp_path, {0.25: few})
    assert ("vy of a particle is not finite" in garbage(tmp_path)) == spoilt
    assert bool(garbage(tmp_path)) == spoilt
    assert "pressure" in measured(tmp_path, "particles", "p", "final").why


def test_damaged_states_are_told(folder: Path) -> None:
    file = folder / "fields" / "p1.vtp"
    whole = file.read_bytes()
    chance = np.random.default_rng(3)
    for _ in range(200):
        data = bytearray(whole)
        for at in chance.integers(len(data), size=3):
            data[at] = chance.integers(256)
        file.write_bytes(bytes(data)[: len(data) if chance.random() < 0.8 else int(chance.integers(len(data)))])
        m = measured(folder, "particles", "p", "mean")
        assert m.found or m.why
    file.unlink()
    assert measured(folder, "particles", "p", "mean").why.endswith("p1.vtp: the file is missing")


def test_pictures(folder: Path) -> None:
    case = Case(picture_of="p", picture_title="pressure", picture_at="0.5")
    picture = draw_particles(case, PARAMETERS, folder)
    assert picture is not None
    assert picture.png[1:4] == b"PNG"
    assert picture.title == "pressure, t = 0.5, 9 particles"
    assert picture.low == "2.08", "nine values 2, 3, ... 10: 0.08 of the way to the second"
    case.picture_at = "9"
    assert draw_particles(case, PARAMETERS, folder) is None
    case.picture_at, case.picture_where = "", "-1"
    assert draw_particles(case, PARAMETERS, folder) is None


def test_pixels_have_the_colour_of_the_nearest_particle(tmp_path: Path) -> None:
    import io

    from matplotlib.image import imread

    two = {name: values[:2] for name, values in column(0).items()}
    two["Points"] = np.array([[0, 0, 0], [0.2, 0, 0]], dtype="f4")
    two["smoothing_length"] = np.full(2, 0.2)
    write_states(tmp_path, {0.0: two})
    picture = draw_particles(Case(picture_of="x"), {"pi": math.pi}, tmp_path)
    assert picture is not None
    pixels = imread(io.BytesIO(picture.png))
    middle = pixels[pixels.shape[0] // 2]
    assert np.all(pixels[0, 0] == 1), "white where there is none"
    left, right = middle[len(middle) // 4][:3], middle[3 * len(middle) // 4][:3]
    shaded = (0.78, 1.01)  # between the ends of viridis and those in the shade
    for pixel, end in ((left, (0.267, 0.005, 0.329)), (right, (0.993, 0.906, 0.144))):
        share = pixel[[0, 2]] / np.array(end)[[0, 2]]
        assert shaded[0] <= share.min() and share.max() <= shaded[1], "dark on the left, light on the right"


def test_a_kind_of_ones_own(folder: Path) -> None:
    @observation("states")
    def states(o: Observation, run):  # type: ignore[no-untyped-def]
        times = []
        for i in range(len(run.states)):
            state = yield i
            times.append(state.t)
        return Measured(True, value=float(len(times)), series=Series(times, times))

    @observation("lost")
    def lost(o: Observation, run):  # type: ignore[no-untyped-def]
        yield 99

    try:
        assert measured(folder, "states", "", "final").value == 3
        assert measured(folder, "lost", "", "final").why == "there is no field state number 99"
        with pytest.raises(ValueError, match="already"):
            observation("states")(states)
    finally:
        del KINDS.functions["states"], KINDS.functions["lost"]


def test_the_functions_of_the_page_on_suites(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    guide = (Path(__file__).resolve().parents[3] / "docs" / "suites.md").read_text()
    found = re.search(r"```\n(import numpy as np\nfrom courant\.verify.*?)```", guide, re.S)
    assert found
    own = tmp_path_factory.mktemp("own") / "own.py"
    own.write_text(found[1])
    load_file(own)
    try:
        assert number(folder, "history", "t", "spread") == pytest.approx(1)
        assert number(folder, "particles", "p", "final", reduce="rms") == pytest.approx(
            np.sqrt(np.mean((11 - 10 * column(0)["Points"][:9, 1]) ** 2))
        )
        assert number(folder, "distance", "y", "max") == pytest.approx(0.8)
        o = Observation("o", of="t", reference=Reference("formula", "0 * t"), norm="l4", scale="1")
        assert observed(folder, o).error == pytest.approx(np.mean((0.1 * np.arange(11)) ** 4) ** 0.25)
        assert CHARTS["cost"].function(CaseResult(Case(), [RunResult(cpu_seconds=1.5)]))[0].notes == ["1.5 s in all"]
    finally:
        for registry, names in ((take, ["spread"]), (reduction, ["rms"]), (norm, ["l4"]), (KINDS, ["distance"]), (CHARTS, ["cost"])):
            for name in names:
                registry.functions.pop(name, None)
    faulty = own.with_name("faulty.py")
    for text, why in (("1 +", "SyntaxError"), ("import no_such_module", "ModuleNotFoundError")):
        faulty.write_text(text)
        with pytest.raises(LoadFault, match=why):
            load_file(faulty)
    with pytest.raises(LoadFault, match="is no Python file"):
        load_file(own.with_name("none.py"))
