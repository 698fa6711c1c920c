"""The one plotting style of Courant: `courant post`, `courant verify` and `.plot()` draw with it."""

from __future__ import annotations

from types import ModuleType
from typing import Any

from .optional import module

# Okabe and Ito's colours, which people who do not see all of them distinguish
PALETTE = ("#0072b2", "#d55e00", "#008060", "#b0518a", "#b87a00", "#3a9bdc", "#666666")
MARKERS = "s^Dv*P"
LOOKS: dict[str, dict[str, Any]] = {
    "line": {"linestyle": "-", "linewidth": 1.3},
    "dashed": {"linestyle": "--", "linewidth": 1.3},
    "points": {"linestyle": "none", "marker": "o", "markersize": 4},
    "line+points": {"linestyle": "-", "linewidth": 1.1, "marker": "o", "markersize": 3.5},
}
LOOKS["named"] = LOOKS["points"]  # the name is beside the point
FIELD_COLOURS = SPEED_COLOURS = "viridis"  # even in brightness, and for people who do not see all colours
WALLS = {"colors": "black", "linewidths": 1.6, "capstyle": "projecting"}


def pyplot() -> ModuleType:
    """matplotlib.pyplot without a screen, in our style. Raises MissingModule."""
    matplotlib = module("matplotlib")
    plt = module("matplotlib.pyplot")
    plt.switch_backend("Agg")
    matplotlib.rcParams.update(
        {
            "axes.titlesize": 10,
            "axes.prop_cycle": matplotlib.cycler(color=PALETTE),
            "legend.fontsize": 9,
            "grid.alpha": 0.3,
            "savefig.dpi": 160,
            "svg.hashsalt": "courant",  # the same file from the same numbers
        }
    )
    return plt


def figure(width: float = 7.2, height: float = 4.4) -> tuple[Any, Any]:
    """A figure with one pair of axes and a grid. Sizes in inches."""
    made, axes = pyplot().subplots(figsize=(width, height), constrained_layout=True)
    axes.grid(True)
    return made, axes
