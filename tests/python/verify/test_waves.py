"""Observations of kind waves: numbers out of gauges of level in history.h5."""
from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from courant.verify.model import Observation
from courant.verify.observe import NotFound, Run
from courant.verify.registry import KINDS
from courant.waves import wave_number
from made_runs import write_history

T, D = 1.5, 0.4
K = float(wave_number(2 * math.pi / T, D))
X = (1.0, 1.3, 1.7, 4.0, 4.3, 4.7)


def run_of(folder: Path, **variables: float) -> Run:
    t = np.arange(0, 12, 0.03)
    datasets: dict[str, tuple[np.ndarray, str]] = {}
    for k, x in enumerate(X, 1):
        a = 0.03 * 0.98 ** (x * K / (2 * math.pi))  # 2 % go on a length of the wave
        level = D + a * np.cos(2 * math.pi * t / T - K * x) + 0.0015 * np.cos(2 * math.pi * t / T + K * x)
        datasets |= {f"gauges/w{k}/time": (t, "T"), f"gauges/w{k}/level": (level, "L"), f"gauges/w{k}/position": (np.column_stack([np.full_like(t, x), level, 0 * t]), "L")}
    write_history(folder, {"global/time": (t, "T"), **datasets})
    return Run(folder, {"period": T, "depth": D, "g": 9.81} | variables)


def value(run: Run, of: str, **keys: str) -> float:
    measured = KINDS["waves"].function(Observation("n", kind="waves", of=of, take="final", **keys), run)
    assert measured.found and measured.value is not None
    return float(measured.value)


def test_numbers_of_regular_waves(tmp_path: Path) -> None:
    run = run_of(tmp_path)
    everything = "(w1, w2, w3, w4, w5, w6)"
    assert value(run, "height(w1, w2, w3)", start="3") == pytest.approx(0.06 * 0.98 ** (1.3 * K / (2 * math.pi)), rel=2e-3)
    assert value(run, "reflection" + everything) == pytest.approx(0.05, rel=0.1)  # waves that lose height are not in the fit
    assert value(run, "kept" + everything) == pytest.approx(0.98, abs=2e-3)
    assert value(run, "celerity" + everything) == pytest.approx(1, abs=0.01)
    both = abs(0.03 * 0.98 ** (K / (2 * math.pi)) + 0.0015 * np.exp(2j * K))
    assert value(run, "crest(w1)", end="6") == pytest.approx(both, rel=2e-3)


@pytest.mark.parametrize(
    ("of", "message"),
    [("height", "is no NUMBER"), ("hight(w1)", "is no NUMBER"), ("height(w9)", "no gauge 'w9': there are w1, w2"), ("height(w1)", "half a wave length apart")],
)
def test_faults(tmp_path: Path, of: str, message: str) -> None:
    with pytest.raises(NotFound, match=message):
        value(run_of(tmp_path), of)


def test_a_window_without_rows_and_a_scene_without_a_period(tmp_path: Path) -> None:
    run = run_of(tmp_path)
    with pytest.raises(NotFound, match="fewer than eight rows"):
        value(run, "crest(w1)", start="11.9")
    del run.variables["period"]
    with pytest.raises(NotFound, match="needs the parameter 'period'"):
        value(run, "height(w1, w2)")
