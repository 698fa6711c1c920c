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


REGULAR = {"kind": "regular", "depth": 0.5, "height": 0.08, "period": 1.4}
IRREGULAR = {"kind": "jonswap", "height": 0.08, "period": 1.4}


def flume(low: float = -0.3, wall: float = 0.0, motion: dict[str, Any] | None = None, **waves: Any) -> courant.Scene:
    """Keys that are None are left out."""
    made = courant.Scene("flume", spacing=0.05, end=6, wall_method="mirrors").water(low=(0, 0), high=(4, 0.5))
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
    ],
)
def test_faults(waves: dict[str, Any], message: str) -> None:
    with pytest.raises(courant.CourantError, match=message):
        flume(**waves).deck()


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
