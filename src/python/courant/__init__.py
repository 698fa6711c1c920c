"""Results of Courant's runs in Python, and the calls `courant post` and `courant verify`.

`courant.open(DIR)` gives the results of a run (see courant.results); `python3 -m courant post RECIPE DIR` and
`python3 -m courant verify SUITE` are the calls.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .optional import lazily

if TYPE_CHECKING:
    from .diagnostics import CourantError
    from .results import Results, open
    from .tables import Table
    from .units import Units

__all__ = ["CourantError", "Results", "Table", "Units", "open"]
# so that the calls start before numpy is there, and can tell where it is missing
__getattr__ = lazily(__name__, {".diagnostics": ["CourantError"], ".results": ["Results", "open"], ".tables": ["Table"], ".units": ["Units"]})
