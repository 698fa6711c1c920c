"""Differences of two runs: how they ended, energies at the end, peaks of their histories."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .curves import Gallery, name_of
from .html import paragraph, table
from .sources import Sources, summary_of, unit_names

_WORDS = {"verdict": "verdict", "termination": "ended", "time": "end time", "steps": "steps", "dt_min": "smallest step", "particles": "particles",
          "elements": "elements that deform", "wall_seconds": "elapsed [s]", "cpu_seconds": "processor time [s]"}  # fmt: skip
_EACH = 6  # entities of a kind


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
    only, left = [], 0
    if sources[0].run.units != sources[1].run.units:
        only.append("the units of the two runs differ: numbers are compared as they are, under the units of the first")
    for found in Gallery(sources, names).all_found():
        title = found[0][1].kind.title
        if len(found) < 2:
            only.append(f"{title}: only in {names[found[0][0]]}")
            continue
        mine, other = ({(e.id, label): (e, lines) for e in one.entities for label, lines in e.lines.items()} for _, one in found)
        both = [key for key in mine if key in other and (mine[key][1].peak > 0 or other[key][1].peak > 0)]
        largest = list(dict.fromkeys(id for id, _ in sorted(both, key=lambda key: -mine[key][0].peak)))[:_EACH]
        left += sum(id not in largest for id, _ in both)
        for id, label in both:
            if id in largest:
                lines, word = mine[id, label][1], name_of(found[0][1].kind.noun, mine[id, label][0])
                peaks = lines.peak, other[id, label][1].peak
                rows.append([f"{word}: largest {label}", *peaks, unit(lines.dimension, label), _change(*peaks)])
        lone = len(set(mine) ^ set(other))
        if lone:
            only.append(f"{title}: {lone} quantities are in one run only")
    if left:
        only.append(f"of each kind the {_EACH} with the largest values are listed; peaks of {left} more quantities are not")
    return table(rows, ("", names[0], names[1], "unit", "change")) + "".join(paragraph(one) for one in only)
