"""Charts of the package: drop_regimes, jump_types."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..style import MARKERS, PALETTE
from .figures import chart
from .drop import TYPES
from .kinds_drop import REGIMES


_SPOKEN = {"undecided": "", "A": "A-jump", "B": "B-jump", "A-wave": "wave, toe upstream (A-wave)", "B-wave": "wave, toe behind (B-wave)"}


@chart("drop_regimes")
def drop_regimes(axes: Any, tables: dict[str, Any], table: str, labels: list[str] | None = None, here: str = "this run") -> None:
    """Froude number against tailwater depth: the momentum bounds of B-jump and A-jump, tests by type, and the run. `labels`: of the tests."""
    bounds, tests, run = tables[f"{table}_bounds"], tables[f"{table}_tests"], tables[table]
    axes.fill_between(bounds["F1"], bounds["Y_B"], bounds["Y_A"], color="0.9", linewidth=0)
    s = float(run["s_y1"][0])
    axes.plot(bounds["F1"], bounds["Y_A"], color="0.25", linestyle="-", label=f"$Y_A$, momentum, $s/y_1$ = {s:.2f}")
    axes.plot(bounds["F1"], bounds["Y_B"], color="0.25", linestyle="--", label=f"$Y_B$, momentum, $s/y_1$ = {s:.2f}")
    for k, number in enumerate(np.unique(tests["type"]) if len(tests["type"]) else ()):
        on = tests["type"] == number
        look = {"linestyle": "none", "marker": MARKERS[k % len(MARKERS)], "color": PALETTE[k % len(PALETTE)], "markersize": 6, "markerfacecolor": "none"}
        axes.plot(tests["F1"][on], tests["Y"][on], label=f"test, {REGIMES[int(number)]}", **look)
    for name, x, y in zip(labels or [], tests["F1"], tests["Y"], strict=False):
        axes.annotate(str(name), (x, y), xytext=(5, 3), textcoords="offset points", fontsize=8)
    regime = REGIMES[int(run["type"][0])]
    axes.plot(run["F1"], run["Y"], linestyle="none", marker="*", markersize=17, markerfacecolor="none", markeredgewidth=1.4, color="black", zorder=5, label=f"{here}: {regime}")


@chart("jump_types")
def jump_types(axes: Any, tables: dict[str, Any], table: str, y1: float | None = None, step: float = 0.0) -> None:
    """J over time before the colours of the types, and the location of the toe behind the step on the right [y1, or as it is]."""
    of = tables[table]
    t, J, toe, types = (of[name] for name in ("t", "J", "toe", "type"))
    ends = np.concatenate(([t[0]], 0.5 * (t[1:] + t[:-1]), [t[-1]])) if len(t) else np.empty(0)
    begins = np.flatnonzero(np.append(True, types[1:] != types[:-1])) if len(t) else np.empty(0, int)
    shown: set[int] = set()
    for begin, end in zip(begins, [*begins[1:], len(t)], strict=True):
        number = int(types[begin])
        label = None if number in shown else _SPOKEN[TYPES[number]]
        shown.add(number)
        if number:
            axes.axvspan(ends[begin], ends[end], color=PALETTE[(number + 1) % len(PALETTE)], alpha=0.22, linewidth=0, label=label)
    axes.axhline(0, color="0.5", linewidth=0.8)
    axes.plot(t, J, color="black", linewidth=1.2, label="$J$ = ($u_{bed}$ - $u_{surface}$) / $V_1$")
    right = axes.twinx()
    unit = next((column.unit for column in of.columns if column.name == "toe"), "?")
    right.plot(t, (toe - step) / (y1 or 1), color=PALETTE[1], linewidth=1.0, linestyle="--")
    axes.plot([], [], color=PALETTE[1], linewidth=1.0, linestyle="--", label="toe")
    right.set_ylabel("toe behind the step " + ("/ $y_1$ [-]" if y1 else f"[{unit}]"), color=PALETTE[1])
    low, high = min(-1.0, np.nanmin(J, initial=0)), max(0.6, np.nanmax(J, initial=0))
    axes.set_ylim(low - 0.05, high + 0.45)  # room for the legend
