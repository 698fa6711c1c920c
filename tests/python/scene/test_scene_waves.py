"""Wave makers of scenes: their curves, and what is refused."""
from __future__ import annotations

from pathlib import Path
from typing import Any

import courant
import numpy as np
import pytest
from courant.waves import Waves


def flume(low: float = -0.3, **waves: Any) -> courant.Scene:
    made = courant.Scene("flume", spacing=0.05, end=6, wall_method="mirrors").water(low=(0, 0), high=(4, 0.5))
    made.box(low=(low, 0), high=(4, 1), open=["top", "left"])
    return made.wall(line=[[0, 0], [0, 1]], title="piston", motion={"waves": {"kind": "regular", "depth": 0.5, "height": 0.08, "period": 1.4} | waves})


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
    np.testing.assert_allclose(curve(flume(low=-0.5, towards="-x"))[:, 1], -made[:, 1], rtol=1e-9, atol=1e-12)
    assert "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n$#     pid       dof       vad      lcid        sf\n        12         1         2" in flume().deck()


def test_records(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rows = np.column_stack([np.linspace(0, 6, 61), 0.02 * np.sin(np.linspace(0, 9, 61))])
    np.savetxt(tmp_path / "piston.csv", rows, delimiter=",")
    name = str(tmp_path / "piston.csv")
    np.testing.assert_allclose(curve(flume(kind="displacement", record=name)), rows, atol=1e-9)
    elevation = curve(flume(kind="elevation", record=name))
    assert len(elevation) > 61 and 0.02 < np.ptp(elevation[:, 1]) < 0.3


@pytest.mark.parametrize(
    ("waves", "message"),
    [
        ({"period": 0}, "waves: the period of the waves is 0"),
        ({"height": 0.5}, "break in a depth of 0.5"),
        ({"kind": "regula"}, "no kind of waves 'regula'\n  hint: did you mean regular"),
        ({"low": -0.01}, "leaves the box, which is from -0.01 to 4"),
        ({"kind": "elevation"}, "'record' is missing"),
        ({"kind": "displacement", "record": "nothing.csv"}, "record: 'nothing.csv' cannot be read"),
        ({"towards": "up"}, "towards: 'up' is no direction"),
        ({"heigth": 0.1}, "waves: unknown key 'heigth'"),
    ],
)
def test_faults(waves: dict[str, Any], message: str) -> None:
    with pytest.raises(courant.CourantError, match=message):
        flume(**waves).deck()
