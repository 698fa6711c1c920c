"""Results of Courant's runs in Python, and the calls `courant post` and `courant verify`.

`courant.open(DIR)` gives the results of a run (see courant.results); `python3 -m courant post RECIPE DIR` and
`python3 -m courant verify SUITE` are the calls.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .diagnostics import CourantError
    from .results import Results, open
    from .tables import Table
    from .units import Units

__all__ = ["CourantError", "Results", "Table", "Units", "open"]
_HOME = {"CourantError": "diagnostics", "Results": "results", "open": "results", "Table": "tables", "Units": "units"}


def __getattr__(name: str) -> Any:
    """Imports what is asked for, so that the calls start before numpy is there, and can tell where it is missing."""
    if name not in _HOME:
        raise AttributeError(f"module 'courant' has no attribute '{name}'")
    from importlib import import_module

    return getattr(import_module(f".{_HOME[name]}", __name__), name)
