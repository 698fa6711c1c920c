"""`courant post`: measures in the results of a run what a recipe asks for. See docs/post.md.

`analysis` and `chart` register kinds of one's own; all names are imported when they are asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..optional import lazily

if TYPE_CHECKING:
    from ..tables import Column, Table
    from .analyses import Analysis, Run, Settings, TimeWindow, analysis
    from .figures import chart
    from .recipe import Recipe, read_recipe
    from .run import run_post
    from .tables import Image, Result, Scalar, Series

_HOMES = {
    "..tables": ("Column", "Table"),
    ".analyses": ("Analysis", "Run", "Settings", "TimeWindow", "analysis"),
    ".figures": ("chart",),
    ".recipe": ("Recipe", "read_recipe"),
    ".run": ("run_post",),
    ".tables": ("Image", "Result", "Scalar", "Series"),
}
__all__ = ["Analysis", "Column", "Image", "Recipe", "Result", "Run", "Scalar", "Series", "Settings", "Table", "TimeWindow"]
__all__ += ["analysis", "chart", "read_recipe", "run_post"]
__getattr__ = lazily(__name__, _HOMES)
