"""Wave makers of scenes: their curves, and what is refused."""
from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import courant
import numpy as np
import pytest
from courant.diagnostics import Diagnostics, Location
from courant.scene.model import Lattice, PlaceExpression
from courant.scene.water_checks import check_overlaps
from courant.waves import Waves

from .made import written

FLUME = """title: flume
water: {spacing: 0.05, blocks: [{low: [0, 0], high: [4, 0.5]}]}
box: {low: [-0.3, 0], high: [4, 1], open: [top, left]}
end: 6
walls:
  - {line: [[0, 0], [0, 1]], motion: {MOTION}}
"""


SPACING = 0.05
REGULAR = {"kind": "regular", "depth": 0.5, "height": 0.08, "period": 1.4}
IRREGULAR = {"kind": "jonswap", "height": 0.08, "period": 1.4}


def flume(low: float = -0.3, wall: float = 0.0, motion: dict[str, Any] | None = None, **waves: Any) -> courant.Scene:
    """Keys that are None are left out."""
    made = courant.Scene("flume", spacing=SPACING, end=6, wall_method="mirrors").water(low=(0, 0), high=(4, 0.5))
    made.box(low=(low, 0), high=(max(4, wall + 0.5), 1), open=["top", "left"])
    given = {key: value for key, value in (REGULAR | waves).items() if value is not None}
    return made.wall(line=[[wall, 0], [wall, 1]], title="piston", motion={"waves": given} | (motion or {}))


def curve(scene: courant.Scene) -> np.ndarray:
    lines = scene.deck().split("*BOUNDARY_PRESCRIBED_MOTION_RIGID")[1].split("*DEFINE_CURVE\n")[1].splitlines()
    rows = []
    for line in lines[3:]:
        if line.startswith(("*", "$")):
            break
        rows.append([float(line[:20]), float(line[20:])])
    return np.array(rows)


def test_the_curve_is_the_displacement_of_the_waves() -> None:
    made = Waves("regular", depth=0.5, height=0.08, period=1.4).displacement(6)
    np.testing.assert_allclose(curve(flume()), made, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(curve(flume(wall=4, towards="-x"))[:, 1], -made[:, 1], rtol=1e-9, atol=1e-12)
    assert "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n$#     pid       dof       vad      lcid        sf\n        12         1         2" in flume().deck()


def test_records(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rows = np.column_stack([np.linspace(0, 6, 61), 0.02 * np.sin(np.linspace(0, 9, 61))])
    np.savetxt(tmp_path / "piston.csv", rows, delimiter=",")
    name = str(tmp_path / "piston.csv")
    none = {"height": None, "period": None}
    np.testing.assert_allclose(curve(flume(kind="displacement", record=name, **none)), rows, atol=1e-9)
    elevation = curve(flume(kind="elevation", record=name, **none))
    assert len(elevation) > 61 and 0.02 < np.ptp(elevation[:, 1]) < 0.3


@pytest.mark.parametrize("kind", ["elevation", "displacement"])
@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "two rows of time and value or more.*there are 0"),
        ("time,level\n0,0\n1\n", "r.csv' cannot be read: line 3: two numbers are expected, got '1'"),
        ("0,0\n1,nan\n2,0\n", "row 2 has no finite numbers"),
        ("0,0\n1,1\n0.5,0\n", "row 3 has time 0.5 after 1"),
        ("0,0\n1,x\n", "line 2: two numbers are expected, got '1,x'"),
        (b"\x80\x81", "r.csv' cannot be read: it is no text"),
    ],
)
def test_faults_of_records(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str, text: str | bytes, message: str) -> None:
    (tmp_path / "r.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
    monkeypatch.chdir(tmp_path)
    with pytest.raises(courant.CourantError, match=message):
        flume(kind=kind, record=str(tmp_path / "r.csv"), height=None, period=None).deck()


@pytest.mark.parametrize("text", ["time,level\n{rows}", "{rows}", "# measured\n\ntime;level\n{rows}"])
@pytest.mark.parametrize("between", [",", ";", " ", "\t", ", "])
def test_records_as_loggers_write_them(tmp_path: Path, text: str, between: str) -> None:
    rows = np.column_stack([np.linspace(0, 6, 13), 0.02 * np.sin(np.linspace(0, 9, 13))])
    (tmp_path / "r.csv").write_text(text.format(rows="\n".join(f"{t:.6f}{between}{x:.6f}" for t, x in rows)), encoding="utf-8")
    np.testing.assert_allclose(curve(flume(kind="displacement", record=str(tmp_path / "r.csv"), height=None, period=None)), rows, atol=1e-6)


def test_warnings_of_what_records_and_foci_leave_out(tmp_path: Path) -> None:
    (tmp_path / "r.csv").write_text("2,0\n3,0.01\n", encoding="utf-8")
    out = written(tmp_path, FLUME.replace("{MOTION}", "{waves: {kind: displacement, record: r.csv}}"))
    assert "has times 2 to 3, the run 0 to 6: its first and last value hold" in out.messages and out.deck
    focused = "{waves: {kind: focused, depth: 0.5, height: 0.1, period: 1.4, focus: [FOCUS]}}"
    out = written(tmp_path, FLUME.replace("{MOTION}", focused.replace("FOCUS", "50, 4")))
    assert "in the time 4: they do not meet at 50" in out.messages and out.deck
    assert "do not meet" not in written(tmp_path, FLUME.replace("{MOTION}", focused.replace("FOCUS", "3, 5"))).messages



@pytest.mark.parametrize(
    ("waves", "message"),
    [
        ({"period": 0}, "waves: the period of the waves is 0"),
        ({"height": 0.5}, "break in a depth of 0.5"),
        ({"kind": "regula"}, "no kind of waves 'regula'\n  hint: did you mean regular"),
        ({"low": -0.01}, "leaves the box, which is from -0.01 to 4"),
        ({"kind": "elevation", "height": None, "period": None}, "'record' is missing"),
        ({"kind": "displacement", "record": "nothing.csv", "height": None, "period": None}, "record: 'nothing.csv' cannot be read"),
        ({"motion": {"x": "0.1*TIME"}}, "the waves and a formula both move the wall along x\n  hint: leave out the waves or 'x'"),
        ({"towards": "-x", "low": -0.6}, "'piston' moves towards -x, but its water is towards x\n  hint: towards: x"),
        ({"towards": "y"}, "towards: 'y' is no direction\n  hint: x, -x"),
        ({"kind": "focused"}, r"focused waves need 'focus'\n  hint: focus: \[distance"),
        ({"kind": "focused", "focus": [-1, 3]}, "expected a distance of 0 or more and a time above 0"),
        ({"kind": "solitary"}, "waves: 'period' has no effect on kind solitary\n  hint: its keys: depth, height, towards"),
        ({"kind": "displacement"}, "'height' has no effect on kind displacement"),
        ({"kind": "pierson_moskowitz", "gamma": 2}, "'gamma' has no effect on kind pierson_moskowitz"),
        ({"seed": 3}, "'seed' has no effect on kind regular"),
        (IRREGULAR | {"seed": 1.5}, "seed: expected a whole number, got 1.5"),
        (IRREGULAR | {"seed": -1}, "seed is -1: expected a whole number from 0"),
        (IRREGULAR | {"components": 0}, "components is 0: expected a whole number from 2 to 10000"),
        (IRREGULAR | {"components": -3}, "components is -3: expected"),
        (IRREGULAR | {"gamma": -3}, "gamma is -3: expected 1 to 20"),
        ({"ramp": -1}, "the ramp is -1: it must be 0 or more periods\n  hint: ramp: 2"),
        ({"period": 1e9}, "too long for a depth of 0.5"),
        ({"period": 1e-4, "height": 1e-10}, "the displacement would have 4.8e.06 rows"),
        ({"towards": "up"}, "towards: 'up' is no direction"),
        ({"heigth": 0.1}, "waves: unknown key 'heigth'"),
        ({"maker": "flapp"}, "no wave maker 'flapp'\n  hint: did you mean flap"),
        ({"maker": "flap", "kind": "second_order"}, "a flap makes no waves of kind second_order"),
        ({"maker": "flap", "hinge": 0.48}, "must be below 0.9 of the depth"),
        ({"hinge": 0.1}, "waves: 'hinge' has no effect on kind regular"),
        ({"absorb": 2}, "waves: 'absorb' is true or false"),
        ({"absorb": True, "drift": -1}, "drift: expected a time of 0 or more, got -1"),
        ({"drift": 3}, "waves: 'drift' has no effect on kind regular"),
        ({"kind": "displacement", "record": "x.csv", "height": None, "period": None, "absorb": True}, "'absorb' has no effect on kind displacement"),
        ({"kind": "still", "height": None}, "a still paddle without 'absorb: true' is a wall"),
        ({"kind": "still", "height": None, "depth": None, "absorb": True}, "'depth' is missing: the level that a still paddle keeps"),
        ({"absorb": True, "motion": {"y": "0.1*TIME"}}, "has no other motion\n  hint: leave out the formulas"),
        ({"maker": "flap", "low": -0.1}, "leaves the box, which is from -0.1 to 4"),
    ],
)
def test_faults(waves: dict[str, Any], message: str) -> None:
    with pytest.raises(courant.CourantError, match=message):
        flume(**waves).deck()


def wave_maker(scene: courant.Scene) -> tuple[list[float], list[np.ndarray]]:
    """Numbers of the card, and its curves."""
    cards, *curves = scene.deck().split("*COURANT_WAVE_MAKER\n")[1].split("*DEFINE_CURVE\n")
    numbers = [float(line[k : k + 10]) for line in cards.split("*")[0].splitlines() if not line.startswith("$") for k in range(0, len(line), 10)]
    rows = [[line for line in curve.split("*")[0].splitlines()[3:] if not line.startswith("$")] for curve in curves]
    return numbers, [np.array([[float(line[:20]), float(line[20:])] for line in some]) for some in rows]


def test_wave_makers_that_turn_or_absorb_have_a_card_of_their_own() -> None:
    made = Waves("regular", depth=0.5, height=0.08, period=1.4, maker="flap", hinge=0.1)
    numbers, curves = wave_maker(flume(maker="flap", hinge=0.1, absorb=True))
    np.testing.assert_allclose(curves[0], made.displacement(6), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(curves[1], made.at_paddle(6, 4 * SPACING), rtol=1e-9, atol=1e-12)
    assert numbers[:8] == [12, 1, 901, 1, 902, 0.5, 9.81, 0.1] and numbers[8:14] == [0, 0, 0, 1, 0, 0]
    absorption = made.absorption(4 * SPACING, 1.4)
    assert numbers[14:18] == pytest.approx([absorption.factor, 4 * SPACING, absorption.delay, 1.4], rel=1e-6)
    top = (1 - 0.1) / 0.4  # the upper edge goes farther than the still level
    assert numbers[18] == pytest.approx(0.3 / top + made.displacement(6)[:, 1].min(), rel=1e-6)
    deck = flume(maker="flap", hinge=0.1, absorb=True).deck()
    assert "*BOUNDARY_PRESCRIBED_MOTION_RIGID" not in deck and "         1         3         4" in deck  # free along x, y and about z
    towards, back = wave_maker(flume(wall=4, towards="-x", absorb=True))
    assert towards[8:14] == [4, 0, 0, -1, 0, 0]
    np.testing.assert_allclose(back[0], Waves("regular", depth=0.5, height=0.08, period=1.4).displacement(6), rtol=1e-9, atol=1e-12)


def test_drift_goes_back_within_a_period_and_two_of_a_spectrum() -> None:
    for waves, drift in ((REGULAR, 1.4), (REGULAR | {"kind": "second_order"}, 1.4), (IRREGULAR, 2.8), (REGULAR | {"drift": 5}, 5)):
        assert wave_maker(flume(**waves, absorb=True))[0][17] == pytest.approx(drift)


def test_a_paddle_at_rest_absorbs() -> None:
    numbers, curves = wave_maker(flume(kind="still", height=None, absorb=True))
    assert numbers[:6] == [12, 0, 0, 1, 0, 0.5] and not curves
    absorption = Waves("regular", depth=0.5, height=0.01, period=1.4).absorption(2 * SPACING, 1.4)
    assert numbers[14:18] == pytest.approx([absorption.factor, 2 * SPACING, absorption.delay, 1.4], rel=1e-6)
    assert wave_maker(flume(kind="still", height=None, period=None, absorb=True))[0][14:18] == pytest.approx([1, 2 * SPACING, 0, 0])


def test_the_box_itself_is_no_wave_maker_that_absorbs(tmp_path: Path) -> None:
    text = FLUME.replace("open: [top, left]}", "open: [top], motion: {waves: {kind: regular, depth: 0.5, height: 0.01, period: 1.4, absorb: true}}}")
    out = written(tmp_path, text[: text.index("walls:")])
    assert "a box neither turns as a flap nor absorbs waves" in out.messages and not out.deck


def test_a_formula_before_or_behind_the_waves_is_refused(tmp_path: Path) -> None:
    waves = "waves: {kind: regular, depth: 0.5, height: 0.08, period: 1.4}"
    for motion in (f"{waves}, x: 0.1*TIME", f"x: 0.1*TIME, {waves}"):
        out = written(tmp_path, FLUME.replace("MOTION", motion))
        assert out.deck == "" and "scene.yaml:6:" in out.messages and "both move the wall along x" in out.messages, motion
    assert written(tmp_path, FLUME.replace("MOTION", waves)).messages == ""


def test_the_depth_is_compared_with_the_water(tmp_path: Path) -> None:
    for depth, warned in ((0.5, False), (0.53, False), (0.8, True), (0.4, True)):
        out = written(tmp_path, FLUME.replace("MOTION", f"waves: {{kind: regular, depth: {depth}, height: 0.08, period: 1.4}}"))
        assert out.deck and ("warning: waves: the depth is" in out.messages) == warned, depth
        assert not warned or ("scene.yaml:6:" in out.messages and "hint: depth: 0.5\n" in out.messages), out.messages
    dry = written(tmp_path, FLUME.replace("MOTION", "waves: {kind: regular, depth: 0.5, height: 0.08, period: 1.4}").replace("low: [0, 0], high: [4, 0.5]", "low: [1, 0], high: [4, 0.5]"))
    assert "no water is within 4 spacings of 'line' towards x" in dry.messages


def test_faults_have_the_line_of_their_key(tmp_path: Path) -> None:
    keys = ["kind: jonswap", "depth: 0.5", "height: 0.08", "period: 1.4", "gamma: -3"]
    wall = "line: [[0, 0], [0, 1]]\n    motion:\n      waves:\n" + "".join(f"        {key}\n" for key in keys)
    out = written(tmp_path, FLUME.replace("{line: [[0, 0], [0, 1]], motion: {MOTION}}", wall))
    assert out.messages.startswith("scene.yaml:13:16: error: waves: gamma is -3"), out.messages


BLOCKS = """title: blocks
water:
  spacing: 0.05
  blocks:
    - {low: [0, 0], high: [0.5, 0.5]}
    - BLOCK
end: 1
"""


@pytest.mark.parametrize(
    ("block", "count"),
    [
        ("{low: [0.27, 0], high: [0.77, 0.25]}", 25),
        ("{low: [0.25, 0], high: [0.75, 0.25]}", 25),
        ("{low: [0.275, 0.025], high: [0.775, 0.275]}", 20),
        ("{low: [0.25, 0], high: [0.75, 0.25], where: x < 0.3}", 5),
        ("{low: [0.5, 0], high: [1, 0.25]}", 0),
        ("{low: [0, 0.5], high: [0.5, 0.75]}", 0),
        ("{low: [0.25, 0], high: [0.75, 0.25], where: x > 0.5}", 0),
        ("{low: [0.25, 0], high: [0.75, 0.25], jitter: 0.4, where: x > 0.5}", 0),
    ],
)
def test_water_in_two_blocks_is_refused(tmp_path: Path, block: str, count: int) -> None:
    out = written(tmp_path, BLOCKS.replace("BLOCK", block))
    if count:
        assert out.messages.startswith(f"scene.yaml:6:7: error: the water is in two blocks: {count} particles of this one are in the block of line 5") and not out.deck
    else:
        assert out.messages == "" and out.deck


def test_two_million_particles_in_blocks_beside_each_other_are_not_compared() -> None:
    blocks = [Lattice(3, (float(k), 0.0, 0.0), 0.01, (100, 100, 100), where=PlaceExpression("1 / 0", Location())) for k in range(2)]
    begin, diagnostics = time.process_time(), Diagnostics()
    check_overlaps(blocks, {}, diagnostics)
    assert diagnostics.ok and time.process_time() - begin < 0.1
