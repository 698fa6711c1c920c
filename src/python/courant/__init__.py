"""Scenes, runs and results of Courant in Python, and the calls `courant generate`, `courant post` and `courant verify`.

`courant.Scene` sets up a run and writes its deck (see courant.scene.scene); `courant.run(DECK)` runs one, `courant.check(DECK)` looks at it alone;
`courant.open(DIR)` gives the results of a run (see courant.results).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .optional import lazily

if TYPE_CHECKING:
    from .deck.builder import DeckBuilder, grid, join
    from .deck.deck import Deck
    from .diagnostics import CourantError
    from .previewing import preview
    from .results import Results, open
    from .running import Run, RunFailed, check, run
    from .live import LiveState
    from .scene.scene import Scene
    from .stepping import Steps, steps
    from .sweeping import sweep
    from .tables import Table
    from .units import Units

__all__ = ["CourantError", "Deck", "DeckBuilder", "LiveState", "Results", "Run", "RunFailed", "Scene", "Steps", "Table", "Units", "check", "grid", "join", "open", "preview", "run", "steps", "sweep"]
# so that the calls start before numpy is there, and can tell where it is missing
__getattr__ = lazily(__name__, {".diagnostics": ["CourantError"], ".deck.builder": ["DeckBuilder", "grid", "join"], ".deck.deck": ["Deck"], ".results": ["Results", "open"],
                                ".running": ["Run", "RunFailed", "check", "run"], ".live": ["LiveState"], ".scene.scene": ["Scene"], ".stepping": ["Steps", "steps"],
                                ".previewing": ["preview"], ".sweeping": ["sweep"], ".tables": ["Table"], ".units": ["Units"]})
