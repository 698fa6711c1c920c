"""Differences of two runs: how they ended, energies at the end, peaks of their histories."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .curves import Gallery
from .html import paragraph, table
from .sources import Sources, summary_of, unit_names

_WORDS = {"verdict": "verdict", "termination": "ended", "time": "end time", "steps": "steps", "dt_min": "smallest step", "particles": "particles",
          "elements": "elements that deform", "wall_seconds": "elapsed [s]", "cpu_seconds": "processor time [s]"}  # fmt: skip
_MOST = 40


def _change(a: object, b: object) -> str:
    """ "+3.2 %", of numbers."""
    if not isinstance(a, (int, float)) or not isinstance(b, (int, float)) or isinstance(a, bool):
        return "" if a == b else "differs"
    if a == b:
        return "equal"
    return f"{100 * (b - a) / abs(a):+.3g} %" if a else "from 0"


def _number(value: object) -> object:
    try:
        return float(value) if isinstance(value, str) else value  # type: ignore[arg-type]
    except ValueError:
        return value


def differences(sources: Sequence[Sources], names: Sequence[str]) -> str:
    a, b = (summary_of(one.run) for one in sources)
    rows: list[list[object]] = []
    for key, label in _WORDS.items():
        if key in a or key in b:
            left, right = _number(a.get(key, "none")), _number(b.get(key, "none"))
            rows.append([label, left, right, "", _change(left, right)])
    unit = unit_names(sources[0].run)
    (_, left_energies, _), (_, right_energies, _) = (one.energies for one in sources)
    for name in left_energies:
        if name in right_energies and name != "throughput":
            left, right = (float(one[name][np.flatnonzero(np.isfinite(one[name]))[-1]]) if np.isfinite(one[name]).any() else float("nan")
                           for one in (left_energies, right_energies))
            if left or right:
                rows.append([f"{name.replace('_', ' ')} energy at the end" if "work" not in name else f"{name.replace('_', ' ')} at the end", left, right,
                             unit("ML2/T2"), _change(left, right)])
    only, peaks = [], 0
    for found in Gallery(sources, names).all_found():
        title = found[0][1].kind.title
        if len(found) < 2:
            only.append(f"{title}: only in {names[found[0][0]]}")
            continue
        mine, other = ({(e.id, label): (e, lines) for e in one.entities for label, lines in e.lines.items()} for _, one in found)
        for key, (entity, lines) in mine.items():
            if key in other and (lines.peak > 0 or other[key][1].peak > 0):
                peaks += 1
                if peaks <= _MOST:
                    word = f"{found[0][1].kind.noun} {entity.id}".strip()
                    rows.append([f"{word}: largest {lines.label}", lines.peak, other[key][1].peak, unit(lines.dimension, lines.label), _change(lines.peak, other[key][1].peak)])
        lone = len(set(mine) ^ set(other))
        if lone:
            only.append(f"{title}: {lone} quantities are in one run only")
    if peaks > _MOST:
        only.append(f"peaks of {peaks - _MOST} more quantities are not listed")
    return table(rows, ("", names[0], names[1], "unit", "change")) + "".join(paragraph(one) for one in only)
