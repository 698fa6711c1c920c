"""`courant post`: measures in the results of a run what a recipe asks for. See docs/post.md.

Importing it registers the kinds of analyses; `analysis` and `chart` register more.
"""

from . import kinds_fields, kinds_spectrum, kinds_flux, kinds_history, kinds_toe, kinds_roller  # isort: skip  # as messages name them
from .analysis import Analysis, Run, Settings, TimeWindow, analysis
from .figures import chart
from .recipe import Recipe, read_recipe
from .run import run_post
from ..tables import Column, Table
from .tables import Image, Result, Scalar, Series

__all__ = [
    "Analysis", "Column", "Image", "Recipe", "Result", "Run", "Scalar", "Series", "Settings", "Table", "TimeWindow",
    "analysis", "chart", "kinds_fields", "kinds_flux", "kinds_history", "kinds_roller", "kinds_spectrum", "kinds_toe",
    "read_recipe", "run_post",
]  # fmt: skip
